#include "render/gl.h"
#include "base/status.h"

#if defined(RG_GL_osmesa)

#include <GL/osmesa.h>
#define RG_GL 1

typedef struct context {
    OSMesaContext handle;
} context;

static rg_status context_open(context *c, int32_t width, int32_t height, rg_diag *why)
{
    static const int wish[] = {OSMESA_FORMAT,  OSMESA_RGBA, OSMESA_DEPTH_BITS, 24,
                               OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
    (void)width, (void)height;
    c->handle = OSMesaCreateContextAttribs(wish, NULL);
    return c->handle ? RG_OK : rg_fail(RG_EABSENT, why, 0, "OSMesa gives no OpenGL context");
}

static int context_begin(context *c, uint32_t *rgba, int32_t width, int32_t height)
{
    return OSMesaMakeCurrent(c->handle, rgba, GL_UNSIGNED_BYTE, width, height) == GL_TRUE;
}

/* OSMesa puts it into the array itself. */
static void context_fetch(uint32_t *rgba, int32_t pitch, int32_t width, int32_t height)
{
    (void)rgba, (void)pitch, (void)width, (void)height;
    glFinish();
}

static void context_end(context *c)
{
    (void)c;
    OSMesaMakeCurrent(NULL, NULL, 0, 0, 0);
}

static void context_close(context *c)
{
    if (c->handle) OSMesaDestroyContext(c->handle);
}

#elif defined(RG_GL_egl)

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <string.h>
#define RG_GL 1

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

static rg_status context_open(context *c, int32_t width, int32_t height, rg_diag *why)
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
    c->surface = eglCreatePbufferSurface(c->display, config, size);
    return c->surface != EGL_NO_SURFACE ? RG_OK : absent("canvas", why);
}

static int context_begin(context *c, uint32_t *rgba, int32_t width, int32_t height)
{
    (void)rgba, (void)width, (void)height;
    return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(c->display, c->surface, c->surface, c->handle);
}

static void context_fetch(uint32_t *rgba, int32_t pitch, int32_t width, int32_t height)
{
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, pitch);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
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
    if (s == RG_OK) s = context_open(&g->context, width, height, why);
    if (s == RG_OK && !context_begin(&g->context, g->mark, width, height))
        s = rg_fail(RG_EABSENT, why, 0, "OpenGL cannot draw on %d x %d samples", (int)width, (int)height);
    if (s == RG_OK) {
        GLint most[2] = {0, 0}, depth = 0, alpha = 0;
        glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most);
        glGetIntegerv(GL_DEPTH_BITS, &depth);
        glGetIntegerv(GL_ALPHA_BITS, &alpha);
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
    if (!context_begin(&g->context, g->mark, g->width, g->height))
        return rg_fail(RG_EWRITE, why, 0, "OpenGL lost its canvas");
    glViewport(0, 0, width, height);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    /* Row 0 of the canvas is GL's lowest: y down turns it into the picture's top. Depth z lands on z. */
    glOrtho(x, (double)x + width, y, (double)y + height, 0, -1);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glDisable(GL_DITHER);
    glDisable(GL_CULL_FACE);
    glShadeModel(GL_FLAT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearColor(0, 0, 0, 0);
    glClearDepth(1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof *scene->vertex, &scene->vertex->x);
    glColorPointer(4, GL_UNSIGNED_BYTE, sizeof *scene->vertex, &scene->vertex->mark);
    glDrawElements(GL_TRIANGLES, scene->corners, GL_UNSIGNED_INT, scene->corner);
    context_fetch(g->mark, g->width, width, height);
    const GLenum error = glGetError();
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
    rg_mem_free(&g->mem, g->mark);
    rg_mem_free(&g->mem, g);
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
