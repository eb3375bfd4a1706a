#include "write/png.h"
#include "base/status.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <string.h>

/* What libpng says, kept for the caller instead of printed. */
typedef struct trouble {
    rg_diag *why;
    FILE *file;
    rg_status status;
} trouble;

static void on_error(png_structp png, png_const_charp words)
{
    trouble *t = png_get_error_ptr(png);
    if (t->status == RG_OK) t->status = rg_fail(RG_EWRITE, t->why, 0, "%s", words);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp words) { (void)png, (void)words; }

static void write_bytes(png_structp png, png_bytep bytes, size_t n)
{
    trouble *t = png_get_io_ptr(png);
    if (fwrite(bytes, 1, n, t->file) == n) return;
    t->status = rg_fail(RG_EWRITE, t->why, 0, "%s", strerror(errno));
    png_error(png, "write");
}

static void flush(png_structp png) { (void)png; }

/* Everything that libpng may jump out of is in here, so that nothing of the caller's is clobbered by the jump. */
static rg_status write_all(png_structp png, png_infop info, int32_t width, int32_t height, const unsigned char *rgb,
                           const char *run)
{
    if (setjmp(png_jmpbuf(png))) return RG_EWRITE;
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    /* Rows as they are: flat areas are found as well, in half the time. */
    png_set_compression_level(png, RG_PNG_EFFORT);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    /* Not const in libpng, and not changed by it. */
    static char keyword[] = "Software", program[] = RG_PNG_SOFTWARE, what[] = "Run";
    char word[80];
    snprintf(word, sizeof word, "%s", run ? run : "");
    const png_text by[] = {{.compression = PNG_TEXT_COMPRESSION_NONE, .key = keyword, .text = program},
                           {.compression = PNG_TEXT_COMPRESSION_NONE, .key = what, .text = word}};
    png_set_text(png, info, by, run ? 2 : 1);
    png_write_info(png, info);
    for (int32_t y = 0; y < height; y++) png_write_row(png, rgb + 3 * (size_t)width * (size_t)y);
    png_write_end(png, info);
    return RG_OK;
}

rg_status rg_png_write(FILE *file, int32_t width, int32_t height, const unsigned char *rgb, const char *run,
                       rg_diag *why)
{
    if (width < 1 || height < 1)
        return rg_fail(RG_EARG, why, 0, "a picture of %d x %d pixels", (int)width, (int)height);
    trouble t = {why, file, RG_OK};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &t, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_write_struct(&png, NULL);
        return rg_fail(RG_ENOMEM, why, 0, "out of memory for the PNG");
    }
    png_set_write_fn(png, &t, write_bytes, flush);
    const rg_status s = write_all(png, info, width, height, rgb, run);
    png_destroy_write_struct(&png, &info);
    return s;
}

/* ---- reading */

/* Larger ones are no pictures to be printed on a sheet: 64 million pixels. */
enum { LARGEST = 1 << 26 };

/* Everything that libpng may jump out of; *rgba is the caller's, whatever happens. */
static rg_status read_all(png_structp png, png_infop info, FILE *file, const rg_memory *mem, int32_t *width,
                          int32_t *height, unsigned char **rgba)
{
    if (setjmp(png_jmpbuf(png))) return RG_EREAD;
    png_init_io(png, file);
    png_read_info(png, info);
    const png_uint_32 w = png_get_image_width(png, info), h = png_get_image_height(png, info);
    if ((uint64_t)w * h > LARGEST) png_error(png, "too large");
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    *rgba = rg_mem_array(mem, (size_t)w * h, 4);
    if (!*rgba) return RG_ENOMEM;
    for (int pass = 0; pass < passes; pass++)
        for (png_uint_32 y = 0; y < h; y++) png_read_row(png, *rgba + 4 * (size_t)w * y, NULL);
    *width = (int32_t)w, *height = (int32_t)h;
    return RG_OK;
}

static void on_read_error(png_structp png, png_const_charp words)
{
    trouble *t = png_get_error_ptr(png);
    t->status = rg_fail(RG_EREAD, t->why, 0, "no PNG that can be read: %s", words);
    png_longjmp(png, 1);
}

rg_status rg_png_read(const rg_memory *mem, const char *path, int32_t *width, int32_t *height, unsigned char **rgba,
                      rg_diag *why)
{
    errno = 0;
    FILE *file = fopen(path, "rb");
    if (!file) return rg_fail(RG_EREAD, why, 0, "%s", strerror(errno));
    trouble t = {why, file, RG_OK};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &t, on_read_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    unsigned char *pixels = NULL;
    rg_status s = info ? read_all(png, info, file, mem, width, height, &pixels) : RG_ENOMEM;
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
    if (s == RG_ENOMEM) rg_fail(s, why, 0, "out of memory for the picture");
    if (s != RG_OK) rg_mem_free(mem, pixels);
    else *rgba = pixels;
    return s;
}

rg_status rg_png_load(const rg_memory *mem, const char *path, unsigned char **bytes, size_t *n, rg_diag *why)
{
    unsigned char *rgba = NULL, *all = NULL;
    int32_t width, height;
    rg_status s = rg_png_read(mem, path, &width, &height, &rgba, why);
    if (s != RG_OK) return s;
    rg_mem_free(mem, rgba);
    FILE *file = fopen(path, "rb");
    if (!file) return rg_fail(RG_EREAD, why, 0, "%s", strerror(errno));
    enum { PIECE = 65536 };
    size_t room = 0, used = 0;
    for (size_t got = 1; s == RG_OK && got > 0; used += got) {
        s = RG_MEM_GROW(mem, all, room, used + PIECE);
        got = s == RG_OK ? fread(all + used, 1, PIECE, file) : 0;
    }
    if (s == RG_ENOMEM) rg_fail(s, why, 0, "out of memory for the picture");
    else if (ferror(file)) s = rg_fail(RG_EREAD, why, 0, "%s", strerror(errno));
    fclose(file);
    if (s != RG_OK) rg_mem_free(mem, all);
    else *bytes = all, *n = used;
    return s;
}
