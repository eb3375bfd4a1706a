#include "render/gl.h"
#include "base/status.h"

#if defined(RG_GL_osmesa)
#include <GL/osmesa.h>
#include <dlfcn.h>
#define RG_GL 1
#elif defined(RG_GL_egl)
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <string.h>
#define RG_GL 1
#endif

#ifdef RG_GL

/* What is called of OpenGL, by address: its library is opened only where something is drawn, so that a program that
 * draws nothing does not carry a compiler with it, and one in which the library is missing draws all the same
 * (render/canvas.h). */
#define CALLS(X)                                                               \
    X(void, Clear, (GLbitfield))                                               \
    X(void, ClearColor, (GLclampf, GLclampf, GLclampf, GLclampf))              \
    X(void, ClearDepth, (GLclampd))                                            \
    X(void, ColorPointer, (GLint, GLenum, GLsizei, const GLvoid *))            \
    X(void, DepthFunc, (GLenum))                                               \
    X(void, Disable, (GLenum))                                                 \
    X(void, DrawElements, (GLenum, GLsizei, GLenum, const GLvoid *))           \
    X(void, Enable, (GLenum))                                                  \
    X(void, EnableClientState, (GLenum))                                       \
    X(void, Finish, (void))                                                    \
    X(GLenum, GetError, (void))                                                \
    X(void, GetIntegerv, (GLenum, GLint *))                                    \
    X(void, LoadIdentity, (void))                                              \
    X(void, MatrixMode, (GLenum))                                              \
    X(void, Ortho, (GLdouble, GLdouble, GLdouble, GLdouble, GLdouble, GLdouble)) \
    X(void, PixelStorei, (GLenum, GLint))                                      \
    X(void, ReadPixels, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, GLvoid *)) \
    X(void, ShadeModel, (GLenum))                                              \
    X(void, VertexPointer, (GLint, GLenum, GLsizei, const GLvoid *))           \
    X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))

typedef struct calls {
#define X(type, name, args) type(*name) args;
    CALLS(X)
#undef X
} calls;

#endif

#if defined(RG_GL_osmesa)

typedef struct context {
    OSMesaContext handle;
    void *library;
    GLboolean (*make_current)(OSMesaContext, void *, GLenum, GLsizei, GLsizei);
    void (*destroy)(OSMesaContext);
} context;

/* dlsym gives an object's address for a function's: POSIX says that it may be read so. */
static void find(void *library, const char *name, void *to)
{
    *(void **)to = dlsym(library, name);
}

static rg_status context_open(context *c, calls *gl, int32_t width, int32_t height, rg_diag *why)
{
    static const int wish[] = {OSMESA_FORMAT,  OSMESA_RGBA, OSMESA_DEPTH_BITS, 24,
                               OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    OSMesaContext (*create)(const int *, OSMesaContext) = NULL;
    OSMESAproc (*address)(const char *) = NULL;
    (void)width, (void)height;
    for (size_t i = 0; !c->library && i < sizeof names / sizeof *names; i++)
        c->library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
    if (!c->library) return rg_fail(RG_EABSENT, why, 0, "OSMesa cannot be loaded");
    find(c->library, "OSMesaCreateContextAttribs", &create);
    find(c->library, "OSMesaMakeCurrent", &c->make_current);
    find(c->library, "OSMesaDestroyContext", &c->destroy);
    find(c->library, "OSMesaGetProcAddress", &address);
    int all = create && c->make_current && c->destroy && address;
#define X(type, name, args) if (all) all = (gl->name = (type(*) args)(void (*)(void))address("gl" #name)) != NULL;
    CALLS(X)
#undef X
    if (all) c->handle = create(wish, NULL);
    return c->handle ? RG_OK : rg_fail(RG_EABSENT, why, 0, "OSMesa gives no OpenGL context");
}

static int context_begin(context *c, uint32_t *rgba, int32_t width, int32_t height)
{
    return c->make_current(c->handle, rgba, GL_UNSIGNED_BYTE, width, height) == GL_TRUE;
}

/* OSMesa puts it into the array itself. */
static void context_fetch(const calls *gl, uint32_t *rgba, int32_t pitch, int32_t width, int32_t height)
{
    (void)rgba, (void)pitch, (void)width, (void)height;
    gl->Finish();
}

static void context_end(context *c)
{
    c->make_current(NULL, NULL, 0, 0, 0);
}

/* The library stays: it keeps threads. */
static void context_close(context *c)
{
    if (c->handle) c->destroy(c->handle);
}

#elif defined(RG_GL_egl)

typedef struct context {
    EGLDisplay display;
    EGLSurface surface;
    EGLContext handle;
} context;

static rg_status absent(const char *what, rg_diag *why)
{
    return rg_fail(RG_EABSENT, why, 0, "EGL gives no %s (error 0x%x)", what,
                   (unsigned)eglGetError());
}

static rg_status context_open(context *c, calls *gl, int32_t width, int32_t height, rg_diag *why)
{
    static const EGLint wish[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8,
                                  EGL_DEPTH_SIZE, 24, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
    const char *can = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!can || !strstr(can, "EGL_MESA_platform_surfaceless")) return absent("display without a screen", why);
    c->display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (c->display == EGL_NO_DISPLAY || !eglInitialize(c->display, NULL, NULL)) return absent("display", why);
    EGLConfig config;
    EGLint configs = 0;
    if (!eglChooseConfig(c->display, wish, &config, 1, &configs) || configs < 1) return absent("fitting format", why);
    if (!eglBindAPI(EGL_OPENGL_API)) return absent("OpenGL", why);
    c->handle = eglCreateContext(c->display, config, EGL_NO_CONTEXT, NULL);
    if (c->handle == EGL_NO_CONTEXT) return absent("OpenGL context", why);
#define X(type, name, args)                                                                                            \
    if (!(gl->name = (type(*) args)(void (*)(void))eglGetProcAddress("gl" #name))) return absent("gl" #name, why);
    CALLS(X)
#undef X
    c->surface = eglCreatePbufferSurface(c->display, config, size);
    return c->surface != EGL_NO_SURFACE ? RG_OK : absent("canvas", why);
}

static int context_begin(context *c, uint32_t *rgba, int32_t width, int32_t height)
{
    (void)rgba, (void)width, (void)height;
    return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(c->display, c->surface, c->surface, c->handle);
}

static void context_fetch(const calls *gl, uint32_t *rgba, int32_t pitch, int32_t width, int32_t height)
{
    gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl->PixelStorei(GL_PACK_ROW_LENGTH, pitch);
    gl->ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

static void context_end(context *c)
{
    eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

/* The display is shared by the whole process: ending it would pull it from under other handles. */
static void context_close(context *c)
{
    if (c->surface) eglDestroySurface(c->display, c->surface);
    if (c->handle) eglDestroyContext(c->display, c->handle);
}

#endif

#ifdef RG_GL

struct rg_gl {
    rg_memory mem;
    context context;
    calls call;
    int32_t width, height;
    uint32_t *mark; /* [height][width] */
};

rg_status rg_gl_check(rg_diag *why)
{
    (void)why;
    return RG_OK;
}

/* Two sizes are tried: what was asked for, and what GL says that it can do. */
rg_status rg_gl_create(const rg_memory *memory, int32_t width, int32_t height, rg_gl **gl, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(memory);
    rg_gl *g = rg_mem_array(&mem, 1, sizeof *g);
    if (!g) return rg_fail(RG_ENOMEM, why, 0, "out of memory for the picture");
    *g = (rg_gl){.mem = mem, .width = width, .height = height};
    g->mark = rg_mem_array(&mem, (size_t)width * (size_t)height, sizeof *g->mark);
    rg_status s = g->mark ? RG_OK : rg_fail(RG_ENOMEM, why, 0, "out of memory for the picture");
    if (s == RG_OK) s = context_open(&g->context, &g->call, width, height, why);
    if (s == RG_OK && !context_begin(&g->context, g->mark, width, height))
        s = rg_fail(RG_EABSENT, why, 0, "OpenGL cannot draw on %d x %d samples", (int)width, (int)height);
    if (s == RG_OK) {
        GLint most[2] = {0, 0}, depth = 0, alpha = 0;
        g->call.GetIntegerv(GL_MAX_VIEWPORT_DIMS, most);
        g->call.GetIntegerv(GL_DEPTH_BITS, &depth);
        g->call.GetIntegerv(GL_ALPHA_BITS, &alpha);
        if (most[0] < g->width) g->width = most[0];
        if (most[1] < g->height) g->height = most[1];
        if (alpha < 8 || depth < 24 || g->width < 1 || g->height < 1)
            s = rg_fail(RG_EABSENT, why, 0, "OpenGL has %d bits of depth and %d of alpha; 24 and 8 are needed",
                        (int)depth, (int)alpha);
        context_end(&g->context);
    }
    if (s != RG_OK) {
        rg_gl_destroy(g);
        return s;
    }
    *gl = g;
    return RG_OK;
}

void rg_gl_size(const rg_gl *g, int32_t *width, int32_t *height)
{
    *width = g->width;
    *height = g->height;
}

/* A mark goes through GL as the four bytes of a colour, which come back as they are. */
rg_status rg_gl_draw(rg_gl *g, const rg_gl_scene *scene, int32_t x, int32_t y, int32_t width, int32_t height,
                     uint32_t **mark, int32_t *pitch, rg_diag *why)
{
    const calls *gl = &g->call;
    if (!context_begin(&g->context, g->mark, g->width, g->height))
        return rg_fail(RG_EWRITE, why, 0, "OpenGL lost its canvas");
    gl->Viewport(0, 0, width, height);
    gl->MatrixMode(GL_PROJECTION);
    gl->LoadIdentity();
    /* Row 0 of the canvas is GL's lowest: y down turns it into the picture's top. Depth z lands on z. */
    gl->Ortho(x, (double)x + width, y, (double)y + height, 0, -1);
    gl->MatrixMode(GL_MODELVIEW);
    gl->LoadIdentity();
    gl->Disable(GL_DITHER);
    gl->Disable(GL_CULL_FACE);
    gl->ShadeModel(GL_FLAT);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->ClearColor(0, 0, 0, 0);
    gl->ClearDepth(1);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->EnableClientState(GL_VERTEX_ARRAY);
    gl->EnableClientState(GL_COLOR_ARRAY);
    gl->VertexPointer(3, GL_FLOAT, sizeof *scene->vertex, &scene->vertex->x);
    gl->ColorPointer(4, GL_UNSIGNED_BYTE, sizeof *scene->vertex, &scene->vertex->mark);
    gl->DrawElements(GL_TRIANGLES, scene->corners, GL_UNSIGNED_INT, scene->corner);
    context_fetch(&g->call, g->mark, g->width, width, height);
    const GLenum error = gl->GetError();
    context_end(&g->context);
    if (error != GL_NO_ERROR) return rg_fail(RG_EWRITE, why, 0, "OpenGL fails with error 0x%x", (unsigned)error);
    *mark = g->mark;
    *pitch = g->width;
    return RG_OK;
}

void rg_gl_destroy(rg_gl *g)
{
    if (!g) return;
    context_close(&g->context);
    RG_MEM_FREE(&g->mem, g->mark, g);
}

#else

rg_status rg_gl_check(rg_diag *why)
{
    return rg_fail(RG_EABSENT, why, 0, "this build is made without OpenGL (GL=none)");
}

rg_status rg_gl_create(const rg_memory *mem, int32_t width, int32_t height, rg_gl **gl, rg_diag *why)
{
    (void)mem, (void)width, (void)height, (void)gl;
    return rg_gl_check(why);
}

void rg_gl_size(const rg_gl *gl, int32_t *width, int32_t *height)
{
    (void)gl;
    *width = *height = 0;
}

rg_status rg_gl_draw(rg_gl *gl, const rg_gl_scene *scene, int32_t x, int32_t y, int32_t width, int32_t height,
                     uint32_t **mark, int32_t *pitch, rg_diag *why)
{
    (void)gl, (void)scene, (void)x, (void)y, (void)width, (void)height, (void)mark, (void)pitch;
    return rg_gl_check(why);
}

void rg_gl_destroy(rg_gl *gl) { (void)gl; }

#endif
