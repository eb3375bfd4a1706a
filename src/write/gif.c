#include "write/gif.h"
#include "base/status.h"
#include "write/change.h"

#include <errno.h>
#include <gif_lib.h>
#include <math.h>
#include <string.h>

enum { CLEAR = 255 }; /* the colour that shows what was there */
/* Hundredths of a second, the unit of GIF. */
static const double LEAST_DELAY = 2, MOST_DELAY = 65535;

struct rg_gif {
    rg_memory mem;
    GifFileType *gif;
    FILE *file;
    rg_palette *palette;
    int32_t width, height, frames;
    double fps, shown; /* what was added so far, in frames of that rate */
    unsigned char *now, *before; /* [height][width] colour numbers */
    unsigned char *row;          /* [width] */
};

static int put(GifFileType *gif, const GifByteType *bytes, int n)
{
    const rg_gif *g = gif->UserData;
    return (int)fwrite(bytes, 1, (size_t)n, g->file);
}

static rg_status failed(const rg_gif *g, rg_diag *why)
{
    return rg_fail(RG_EWRITE, why, 0, "%s", ferror(g->file) && errno ? strerror(errno) : GifErrorString(g->gif->Error));
}

/* Size, palette, and whether it goes round for ever. */
static int put_head(rg_gif *g, int for_ever)
{
    GifColorType colour[256];
    memset(colour, 0, sizeof colour);
    for (int i = 0; i < g->palette->colours; i++)
        colour[i] = (GifColorType){g->palette->colour[i][0], g->palette->colour[i][1], g->palette->colour[i][2]};
    ColorMapObject *map = GifMakeMapObject(256, colour);
    if (!map) return GIF_ERROR;
    EGifSetGifVersion(g->gif, true);
    int ok = EGifPutScreenDesc(g->gif, g->width, g->height, 8, 0, map);
    GifFreeMapObject(map);
    if (!for_ever) return ok;
    if (ok == GIF_OK) ok = EGifPutExtensionLeader(g->gif, APPLICATION_EXT_FUNC_CODE);
    if (ok == GIF_OK) ok = EGifPutExtensionBlock(g->gif, 11, "NETSCAPE2.0");
    if (ok == GIF_OK) ok = EGifPutExtensionBlock(g->gif, 3, "\1\0\0");
    if (ok == GIF_OK) ok = EGifPutExtensionTrailer(g->gif);
    return ok;
}

rg_status rg_gif_create(const rg_memory *mem, FILE *file, int32_t width, int32_t height, double fps, int for_ever,
                        rg_palette *p, rg_gif **gif, rg_diag *why)
{
    const size_t pixels = (size_t)width * (size_t)height;
    rg_gif *g = rg_mem_array(mem, 1, sizeof *g);
    if (!g) return rg_fail(RG_ENOMEM, why, 0, "out of memory for the GIF");
    *g = (rg_gif){.mem = *mem, .file = file, .palette = p, .width = width, .height = height, .fps = fps};
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(g->now, pixels), RG_ARRAY(g->before, pixels),
                                RG_ARRAY(g->row, (size_t)width));
    if (s == RG_OK) g->gif = EGifOpen(g, put, NULL);
    if (!g->gif) s = rg_fail(RG_ENOMEM, why, 0, "out of memory for the GIF");
    errno = 0;
    if (s == RG_OK && put_head(g, for_ever) != GIF_OK) s = failed(g, why);
    if (s != RG_OK) {
        rg_gif_destroy(g);
        return s;
    }
    *gif = g;
    return RG_OK;
}

/* Delays are whole hundredths; what rounding takes from one frame the next ones give back. */
static int delay_of(const rg_gif *g, double times)
{
    const double ends = floor((g->shown + times) * 100 / g->fps + 0.5), begins = floor(g->shown * 100 / g->fps + 0.5);
    return (int)fmin(MOST_DELAY, fmax(LEAST_DELAY, ends - begins));
}

static int put_frame(rg_gif *g, const rg_change *c, double times)
{
    const GraphicsControlBlock control = {DISPOSE_DO_NOT, false, delay_of(g, times),
                                          g->frames > 0 ? CLEAR : NO_TRANSPARENT_COLOR};
    GifByteType block[4];
    EGifGCBToExtension(&control, block);
    int ok = EGifPutExtension(g->gif, GRAPHICS_EXT_FUNC_CODE, sizeof block, block);
    if (ok == GIF_OK) ok = EGifPutImageDesc(g->gif, c->left, c->top, c->width, c->height, false, NULL);
    for (int32_t y = c->top; ok == GIF_OK && y < c->top + c->height; y++) {
        const size_t at = (size_t)y * (size_t)g->width + (size_t)c->left;
        for (int32_t x = 0; x < c->width; x++) {
            const unsigned char now = g->now[at + (size_t)x];
            g->row[x] = g->frames > 0 && now == g->before[at + (size_t)x] ? CLEAR : now;
        }
        ok = EGifPutLine(g->gif, g->row, c->width);
    }
    return ok;
}

rg_status rg_gif_add(rg_gif *g, const unsigned char *rgb, double times, rg_diag *why)
{
    const size_t pixels = (size_t)g->width * (size_t)g->height;
    for (size_t i = 0; i < pixels; i++) g->now[i] = (unsigned char)rg_palette_index(g->palette, rgb + 3 * i);
    const rg_change c = rg_change_find(g->now, g->frames > 0 ? g->before : NULL, g->width, g->height, 1);
    errno = 0;
    if (put_frame(g, &c, times) != GIF_OK) return failed(g, why);
    unsigned char *swap = g->now;
    g->now = g->before;
    g->before = swap;
    g->frames++;
    g->shown += times;
    return RG_OK;
}

rg_status rg_gif_finish(rg_gif *g, rg_diag *why)
{
    int error = 0;
    errno = 0;
    const int ok = EGifCloseFile(g->gif, &error);
    g->gif = NULL;
    if (ok == GIF_OK) return RG_OK;
    return rg_fail(RG_EWRITE, why, 0, "%s", ferror(g->file) && errno ? strerror(errno) : GifErrorString(error));
}

void rg_gif_destroy(rg_gif *g)
{
    if (!g) return;
    if (g->gif) EGifCloseFile(g->gif, NULL);
    RG_MEM_FREE(&g->mem, g->now, g->before, g->row, g);
}
