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
    static const int wish[] = {OSMESA_FORMAT,  OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_STENCIL_BITS, 8,
                               OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
    (void)width, (void)height;
    c->handle = OSMesaCreateContextAttribs(wish, NULL);
    return c->handle ? RG_OK : rg_fail(RG_EABSENT, why, 0, "OSMesa gives no OpenGL context, so no pictures can be made");
}

static int context_begin(context *c, unsigned char *rgba, int32_t width, int32_t height)
{
    return OSMesaMakeCurrent(c->handle, rgba, GL_UNSIGNED_BYTE, width, height) == GL_TRUE;
}

/* OSMesa draws into the array itself. */
static void context_fetch(unsigned char *rgba, int32_t width, int32_t height)
{
    (void)rgba, (void)width, (void)height;
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
    return rg_fail(RG_EABSENT, why, 0, "EGL gives no %s (error 0x%x), so no pictures can be made", what,
                   (unsigned)eglGetError());
}

static rg_status context_open(context *c, int32_t width, int32_t height, rg_diag *why)
{
    static const EGLint wish[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                  EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8,
                                  EGL_DEPTH_SIZE, 24, EGL_STENCIL_SIZE, 8, EGL_NONE};
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

static int context_begin(context *c, unsigned char *rgba, int32_t width, int32_t height)
{
    (void)rgba, (void)width, (void)height;
    return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(c->display, c->surface, c->surface, c->handle);
}

static void context_fetch(unsigned char *rgba, int32_t width, int32_t height)
{
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
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
    unsigned char *rgba; /* [height][width][4] */
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
    g->rgba = rg_mem_array(&mem, (size_t)width * (size_t)height, 4);
    rg_status s = g->rgba ? RG_OK : rg_fail(RG_ENOMEM, why, 0, "out of memory for the picture");
    if (s == RG_OK) s = context_open(&g->context, width, height, why);
    if (s == RG_OK && !context_begin(&g->context, g->rgba, width, height))
        s = rg_fail(RG_EABSENT, why, 0, "OpenGL cannot draw on %d x %d samples", (int)width, (int)height);
    if (s == RG_OK) {
        GLint most[2] = {0, 0}, stencil = 0, depth = 0;
        glGetIntegerv(GL_MAX_VIEWPORT_DIMS, most);
        glGetIntegerv(GL_STENCIL_BITS, &stencil);
        glGetIntegerv(GL_DEPTH_BITS, &depth);
        if (most[0] < g->width) g->width = most[0];
        if (most[1] < g->height) g->height = most[1];
        if (stencil < 8 || depth < 24 || g->width < 1 || g->height < 1)
            s = rg_fail(RG_EABSENT, why, 0, "OpenGL has %d bits of depth and %d of stencil; 24 and 8 are needed",
                        (int)depth, (int)stencil);
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

/* Faces by depth, each leaving its mark in the stencil where it is on top; then its lines exactly there, whatever their
 * depth: a line can neither shine through a layer above nor sink into its own. 255 marks, then they start anew. */
static void draw_pieces(const rg_gl_scene *scene)
{
    enum { MARKS = 255 };
    glEnable(GL_STENCIL_TEST);
    for (int32_t i = 0; i < scene->pieces; i++) {
        const int32_t *at = scene->start + 2 * (size_t)i;
        const GLint mark = 1 + i % MARKS;
        if (mark == 1 && i > 0) glClear(GL_STENCIL_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glStencilFunc(GL_ALWAYS, mark, 0xff);
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
        glDrawArrays(GL_TRIANGLES, at[0], at[1] - at[0]);
        if (at[2] == at[1]) continue;
        glDisable(GL_DEPTH_TEST);
        glStencilFunc(GL_EQUAL, mark, 0xff);
        glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        glDrawArrays(GL_TRIANGLES, at[1], at[2] - at[1]);
    }
}

rg_status rg_gl_draw(rg_gl *g, const rg_gl_scene *scene, int32_t x, int32_t y, int32_t width, int32_t height,
                     const unsigned char **rgba, int32_t *pitch, rg_diag *why)
{
    if (!context_begin(&g->context, g->rgba, g->width, g->height))
        return rg_fail(RG_EWRITE, why, 0, "OpenGL lost its canvas");
    const unsigned char *b = scene->background;
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
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glStencilMask(0xff);
    glClearColor((float)b[0] / 255, (float)b[1] / 255, (float)b[2] / 255, 1);
    glClearDepth(1);
    glClearStencil(0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(3, GL_FLOAT, sizeof *scene->vertex, &scene->vertex->x);
    glColorPointer(4, GL_UNSIGNED_BYTE, sizeof *scene->vertex, scene->vertex->rgba);
    draw_pieces(scene);
    context_fetch(g->rgba, g->width, g->height);
    const GLenum error = glGetError();
    context_end(&g->context);
    if (error != GL_NO_ERROR) return rg_fail(RG_EWRITE, why, 0, "OpenGL fails with error 0x%x", (unsigned)error);
    *rgba = g->rgba;
    *pitch = g->width;
    return RG_OK;
}

void rg_gl_destroy(rg_gl *g)
{
    if (!g) return;
    context_close(&g->context);
    rg_mem_free(&g->mem, g->rgba);
    rg_mem_free(&g->mem, g);
}

#else

rg_status rg_gl_check(rg_diag *why)
{
    return rg_fail(RG_EABSENT, why, 0, "this build makes no pictures: it was made without OpenGL (GL=none)");
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
                     const unsigned char **rgba, int32_t *pitch, rg_diag *why)
{
    (void)gl, (void)scene, (void)x, (void)y, (void)width, (void)height, (void)rgba, (void)pitch;
    return rg_gl_check(why);
}

void rg_gl_destroy(rg_gl *gl) { (void)gl; }

#endif
