/* write/film.c and what it writes with: files read back by other means, names, errors, what is left behind. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "motions.h"
#include "write/film.h"
#include "write/palette.h"

#include <dirent.h>
#include <gif_lib.h>
#include <png.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

enum { WIDTH = 121, HEIGHT = 90, FRAMES = 7 }; /* odd on purpose */
/* There and back: all frames, then those between the ends; the end is held for a second, the beginning for half of one. */
enum { SHOWN = 2 * FRAMES - 2, RATE = 30, LASTING = SHOWN + RATE + RATE / 2 };
static int frame_shown(int k) { return k < FRAMES ? k : 2 * FRAMES - 2 - k; }

/* A folder of its own for each test; file names in it are made by in(). */
static char folder[200];

static int make_folder(void **state)
{
    (void)state;
    const char *under = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%s/rigami-film-XXXXXX", under && *under ? under : "/tmp");
    return mkdtemp(folder) ? 0 : -1;
}

static void empty(const char *path)
{
    DIR *d = opendir(path);
    char name[600];
    for (struct dirent *e; d && (e = readdir(d));) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
        snprintf(name, sizeof name, "%s/%s", path, e->d_name);
        struct stat is;
        if (lstat(name, &is) == 0 && S_ISDIR(is.st_mode)) empty(name);
        else unlink(name);
    }
    if (d) closedir(d);
    rmdir(path);
}

static int remove_folder(void **state)
{
    (void)state;
    empty(folder);
    return 0;
}

static const char *in(const char *name)
{
    static char path[8][400];
    static int next;
    char *p = path[next++ % 8];
    snprintf(p, sizeof path[0], "%s/%s", folder, name);
    return p;
}

static int entries(const char *path)
{
    DIR *d = opendir(path);
    int n = 0;
    for (struct dirent *e; d && (e = readdir(d));) n += e->d_name[0] != '.';
    if (d) closedir(d);
    return n;
}

static int exists(const char *path)
{
    struct stat is;
    return lstat(path, &is) == 0;
}

typedef struct bytes { unsigned char *at; size_t n; } bytes;

static bytes slurp(const char *path)
{
    bytes b = {NULL, 0};
    FILE *f = fopen(path, "rb");
    if (!f) fail_msg("%s is not there", path);
    fseek(f, 0, SEEK_END);
    b.n = (size_t)ftell(f);
    rewind(f);
    b.at = malloc(b.n + 1);
    assert_non_null(b.at);
    assert_int_equal(fread(b.at, 1, b.n, f), b.n);
    b.at[b.n] = 0;
    fclose(f);
    return b;
}

static void spill(const char *path, const char *text)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

static void assert_same_file(const char *a, const char *b)
{
    bytes x = slurp(a), y = slurp(b);
    assert_int_equal(x.n, y.n);
    assert_memory_equal(x.at, y.at, x.n);
    free(x.at);
    free(y.at);
}

static rg_motion *some_motion(int32_t frames)
{
    static double alpha = 60 * RG_DEG;
    rg_lines l = miura(4, 3, 1, 1.25, alpha);
    return motion_by(&l, frames, miura_folds, &alpha);
}

static rg_picture small_picture(void)
{
    rg_picture p = rg_picture_default();
    p.width = WIDTH;
    p.height = HEIGHT;
    return p;
}

static void write_by(const rg_motion *m, const char *path, int32_t threads)
{
    const rg_picture p = small_picture();
    rg_diag why = {0, ""};
    if (rg_film_write_by(m, path, &p, threads, &why) != RG_OK) fail_msg("%s", why.text);
}

static void refuse(const rg_motion *m, const char *path, rg_status expected, const char *says)
{
    const rg_picture p = small_picture();
    rg_diag why = {0, ""};
    const rg_status s = rg_film_write(m, path, &p, &why);
    if (s != expected || !strstr(why.text, says)) fail_msg("%s: status %d, \"%s\"", path, s, why.text);
}

/* rgb of a PNG, by libpng's own simple reader. */
static unsigned char *decode_png(const char *path)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    unsigned char *rgb = malloc(3 * WIDTH * HEIGHT);
    assert_non_null(rgb);
    if (!png_image_begin_read_from_file(&image, path)) fail_msg("%s: %s", path, image.message);
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    image.format = PNG_FORMAT_RGB;
    if (!png_image_finish_read(&image, NULL, rgb, 0, NULL)) fail_msg("%s: %s", path, image.message);
    return rgb;
}

static uint32_t number(const unsigned char *at) { return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3]; }

/* --------------------------------------------------------------------------------------------- the forms ---- */

static void forms_are_told_by_their_names(void **state)
{
    (void)state;
    static const char *const forms[] = {"a/", "x.png", "X.PNG", "n-%04d.png", "%d.png", "x.gif", "a.b/x.apng", "x.mp4", "x.webm", "/"};
    static const char *const others[] = {"x.obj", "x", ".png", "a.png/x", "x.png.fold", "", "png", "x-%04d.obj", "a/.gif"};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (!rg_film_is_form(forms[i])) fail_msg("%s is one", forms[i]);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (rg_film_is_form(others[i])) fail_msg("%s is none", others[i]);
    assert_true(rg_film_is_form(folder));
    rg_diag why = {0, ""};
    assert_int_equal(rg_film_check("x-%d-%04d.png", &why), RG_EARG);
    assert_int_equal(rg_film_check("x-%d.gif", &why), RG_EARG);
    assert_int_equal(rg_film_check("x.obj", &why), RG_EARG);
    assert_non_null(strstr(why.text, "x.obj"));
    assert_int_equal(rg_film_check("x.png", &why), RG_OK);
}

/* ------------------------------------------------------------------------------------------------ frames ---- */

static void frames_are_numbered(void **state)
{
    (void)state;
    rg_motion *m = some_motion(FRAMES);
    write_by(m, in("made/"), 0);
    assert_int_equal(entries(in("made")), FRAMES);
    mkdir(in("there"), 0777);
    write_by(m, in("there"), 0);
    write_by(m, in("n-%04d.png"), 0);
    write_by(m, in("%d.png"), 0);
    write_by(m, in("100%-%02d%s.png"), 0);
    write_by(m, in("last.png"), 0);
    for (int k = 0; k < FRAMES; k++) {
        char made[40], other[40];
        snprintf(made, sizeof made, "made/%04d.png", k);
        snprintf(other, sizeof other, "there/%04d.png", k);
        assert_same_file(in(made), in(other));
        snprintf(other, sizeof other, "n-%04d.png", k);
        assert_same_file(in(made), in(other));
        snprintf(other, sizeof other, "%d.png", k);
        assert_same_file(in(made), in(other));
        snprintf(other, sizeof other, "100%%-%02d%%s.png", k);
        assert_same_file(in(made), in(other));
    }
    assert_same_file(in("last.png"), in("n-0006.png"));
    unsigned char *first = decode_png(in("0.png")), *last = decode_png(in("6.png"));
    assert_memory_not_equal(first, last, 3 * WIDTH * HEIGHT);
    free(first);
    free(last);
    rg_motion_destroy(m);
}

static void a_shorter_run_leaves_no_frames_of_a_longer_one(void **state)
{
    (void)state;
    rg_motion *longer = some_motion(FRAMES), *shorter = some_motion(3);
    write_by(longer, in("d/"), 0);
    spill(in("d/0008.png"), "somebody's own");
    spill(in("d/notes.txt"), "somebody's own");
    write_by(shorter, in("d/"), 0);
    assert_int_equal(entries(in("d")), 5);
    assert_true(exists(in("d/0002.png")) && exists(in("d/0008.png")) && exists(in("d/notes.txt")));
    /* What was not made here stays, whatever its number, and so does all after it. */
    write_by(longer, in("d/"), 0);
    spill(in("d/0003.png"), "somebody's own");
    write_by(shorter, in("d/"), 0);
    assert_int_equal(entries(in("d")), FRAMES + 2);
    /* Other names are other films. */
    write_by(longer, in("a-%04d.png"), 0);
    write_by(shorter, in("b-%04d.png"), 0);
    assert_true(exists(in("a-0006.png")));
    rg_motion_destroy(longer);
    rg_motion_destroy(shorter);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    static const char *const names[] = {"%d.gif", "%d.apng", "%d.png", "%d/0000.png", "%d/0003.png", "%d/0006.png"};
    rg_motion *m = some_motion(FRAMES);
    for (int threads = 1; threads <= 5; threads += 2) {
        char name[40];
        snprintf(name, sizeof name, "%d/", threads);
        write_by(m, in(name), threads);
        for (int i = 0; i < 3; i++) {
            snprintf(name, sizeof name, names[i], threads);
            if (i < 2) write_by(m, in(name), threads);
        }
        for (int i = 0; i < 6; i++) {
            char one[40];
            if (i == 2) continue;
            snprintf(one, sizeof one, names[i], 1);
            snprintf(name, sizeof name, names[i], threads);
            assert_same_file(in(one), in(name));
        }
    }
    rg_motion_destroy(m);
}

/* -------------------------------------------------------------------------------------------- animations ---- */

/* An APNG taken apart by hand: chunks and their sums, control blocks, zlib streams, filters. Each frame has to be the very
 * picture that the PNG of that frame is. */
static void apng_frames_are_the_pictures(void **state)
{
    (void)state;
    rg_motion *m = some_motion(FRAMES);
    write_by(m, in("x.apng"), 0);
    write_by(m, in("f%d.png"), 0);
    bytes b = slurp(in("x.apng"));
    assert_memory_equal(b.at, "\x89PNG\r\n\x1a\n", 8);
    unsigned char *canvas = calloc(3, WIDTH * HEIGHT), *raw = malloc(4 * WIDTH * HEIGHT);
    assert_true(canvas && raw);
    uint32_t sequence = 0, w = 0, h = 0, x = 0, y = 0;
    int shown = 0, ended = 0, smaller = 0;
    double seconds = 0;
    for (size_t at = 8; at < b.n;) {
        const uint32_t n = number(b.at + at);
        const unsigned char *kind = b.at + at + 4, *data = b.at + at + 8;
        assert_true(at + 12 + n <= b.n);
        assert_int_equal(crc32(0, kind, 4 + n), number(data + n));
        if (memcmp(kind, "IHDR", 4) == 0) {
            assert_int_equal(number(data), WIDTH);
            assert_int_equal(number(data + 4), HEIGHT);
        } else if (memcmp(kind, "acTL", 4) == 0) {
            assert_int_equal(number(data), SHOWN);
            assert_int_equal(number(data + 4), 0);
        } else if (memcmp(kind, "fcTL", 4) == 0) {
            assert_int_equal(number(data), sequence++);
            w = number(data + 4), h = number(data + 8), x = number(data + 12), y = number(data + 16);
            assert_true(w > 0 && h > 0 && x + w <= WIDTH && y + h <= HEIGHT);
            smaller += w * h < WIDTH * HEIGHT;
            seconds += (data[20] * 256.0 + data[21]) / (data[22] * 256.0 + data[23]);
        } else if (memcmp(kind, "IDAT", 4) == 0 || memcmp(kind, "fdAT", 4) == 0) {
            const int later = kind[0] == 'f' ? 4 : 0;
            if (later) assert_int_equal(number(data), sequence++);
            else assert_true(shown == 0 && w == WIDTH && h == HEIGHT);
            uLongf size = 4 * WIDTH * HEIGHT;
            assert_int_equal(uncompress(raw, &size, data + later, n - (uLong)later), Z_OK);
            assert_int_equal(size, (1 + 3 * w) * h);
            for (uint32_t r = 0; r < h; r++) {
                unsigned char *row = raw + r * (1 + 3 * w);
                assert_true(row[0] == 0 || row[0] == 2);
                for (uint32_t i = 1; r > 0 && row[0] == 2 && i <= 3 * w; i++) row[i] = (unsigned char)(row[i] + row[(long)i - 1 - 3 * (long)w]);
                memcpy(canvas + 3 * ((y + r) * WIDTH + x), row + 1, 3 * w);
            }
            char name[40];
            snprintf(name, sizeof name, "f%d.png", frame_shown(shown++));
            unsigned char *rgb = decode_png(in(name));
            assert_memory_equal(canvas, rgb, 3 * WIDTH * HEIGHT);
            free(rgb);
        } else if (memcmp(kind, "IEND", 4) == 0) {
            ended = at + 12 == b.n;
        }
        at += 12 + n;
    }
    assert_true(ended);
    assert_int_equal(shown, SHOWN);
    assert_int_equal(smaller, SHOWN - 1);
    near(seconds, (double)LASTING / RATE, 1e-9);
    /* Readers that know nothing of animations show the first frame. */
    unsigned char *first = decode_png(in("x.apng")), *rgb = decode_png(in("f0.png"));
    assert_memory_equal(first, rgb, 3 * WIDTH * HEIGHT);
    free(first);
    free(rgb);
    free(canvas);
    free(raw);
    free(b.at);
    rg_motion_destroy(m);
}

/* A GIF, by giflib's reader: composed frame by frame, it is the pictures to within what 255 colours can do. */
static void gif_frames_are_near_the_pictures(void **state)
{
    (void)state;
    rg_motion *m = some_motion(FRAMES);
    write_by(m, in("x.gif"), 0);
    write_by(m, in("f%d.png"), 0);
    int error = 0, hundredths = 0;
    GifFileType *g = DGifOpenFileName(in("x.gif"), &error);
    assert_non_null(g);
    assert_int_equal(DGifSlurp(g), GIF_OK);
    assert_int_equal(g->SWidth, WIDTH);
    assert_int_equal(g->SHeight, HEIGHT);
    assert_int_equal(g->ImageCount, SHOWN);
    unsigned char canvas[3 * WIDTH * HEIGHT];
    memset(canvas, 0, sizeof canvas);
    int forever = 0;
    for (int k = 0; k < SHOWN; k++) {
        const SavedImage *s = &g->SavedImages[k];
        GraphicsControlBlock control;
        assert_int_equal(DGifSavedExtensionToGCB(g, k, &control), GIF_OK);
        assert_true(control.DisposalMode == DISPOSE_DO_NOT || control.DisposalMode == DISPOSAL_UNSPECIFIED);
        hundredths += control.DelayTime;
        for (int i = 0; i < s->ExtensionBlockCount; i++)
            forever |= s->ExtensionBlocks[i].ByteCount == 11 && memcmp(s->ExtensionBlocks[i].Bytes, "NETSCAPE2.0", 11) == 0;
        for (int i = 0; i < s->ImageDesc.Width * s->ImageDesc.Height; i++) {
            const int at = (s->ImageDesc.Top + i / s->ImageDesc.Width) * WIDTH + s->ImageDesc.Left + i % s->ImageDesc.Width;
            if (s->RasterBits[i] == control.TransparentColor) continue;
            const GifColorType c = g->SColorMap->Colors[s->RasterBits[i]];
            canvas[3 * at] = c.Red, canvas[3 * at + 1] = c.Green, canvas[3 * at + 2] = c.Blue;
        }
        char name[40];
        double off = 0;
        snprintf(name, sizeof name, "f%d.png", frame_shown(k));
        unsigned char *rgb = decode_png(in(name));
        for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) off += abs(rgb[i] - canvas[i]);
        below(off / (3 * WIDTH * HEIGHT), 1.5);
        assert_memory_equal(canvas, rgb, 3); /* the background is exact */
        free(rgb);
    }
    assert_true(forever);
    assert_int_equal(hundredths, 100 * LASTING / RATE);
    DGifCloseFile(g, NULL);
    rg_motion_destroy(m);
}

/* What goes round forwards has each frame once; what is shown once is not told to go round. */
static void films_go_as_they_are_told(void **state)
{
    (void)state;
    rg_motion *m = some_motion(FRAMES);
    static const rg_loop loops[] = {RG_LOOP_BACK, RG_LOOP_FORWARD, RG_LOOP_ONCE};
    static const int images[] = {SHOWN, FRAMES, FRAMES}, last[] = {SHOWN + 3, FRAMES + 3, FRAMES + 2};
    for (int i = 0; i < 3; i++) {
        rg_picture p = small_picture();
        rg_diag why = {0, ""};
        p.loop = loops[i];
        p.hold = 2 / p.fps; /* two frames more at the end, one at the beginning of what comes again */
        if (rg_film_write(m, in("x.gif"), &p, &why) != RG_OK) fail_msg("%s", why.text);
        if (rg_film_write(m, in("x.apng"), &p, &why) != RG_OK) fail_msg("%s", why.text);
        GifFileType *g = DGifOpenFileName(in("x.gif"), NULL);
        int hundredths = 0, forever = 0;
        assert_non_null(g);
        assert_int_equal(DGifSlurp(g), GIF_OK);
        assert_int_equal(g->ImageCount, images[i]);
        for (int k = 0; k < g->ImageCount; k++) {
            GraphicsControlBlock control;
            assert_int_equal(DGifSavedExtensionToGCB(g, k, &control), GIF_OK);
            hundredths += control.DelayTime;
            for (int j = 0; j < g->SavedImages[k].ExtensionBlockCount; j++) {
                const ExtensionBlock *b = &g->SavedImages[k].ExtensionBlocks[j];
                forever |= b->ByteCount >= 8 && memcmp(b->Bytes, "NETSCAPE", 8) == 0;
            }
        }
        near(hundredths, 100.0 * last[i] / RATE, 1);
        assert_int_equal(forever, loops[i] != RG_LOOP_ONCE);
        DGifCloseFile(g, NULL);
        bytes b = slurp(in("x.apng"));
        const unsigned char *control = b.at + 8 + 25; /* after the signature and the header: acTL */
        assert_memory_equal(control + 4, "acTL", 4);
        assert_int_equal(number(control + 8), images[i]);
        assert_int_equal(number(control + 12), loops[i] == RG_LOOP_ONCE);
        free(b.at);
    }
    rg_motion_destroy(m);
}

/* Up to 255 colours are shown as they are; of more, the mean error is small, and every colour is some colour. */
static void palettes_are_close(void **state)
{
    (void)state;
    rg_palette p;
    const rg_memory mem = rg_mem_default(NULL);
    unsigned char few[250][3], many[5000][3];
    for (int i = 0; i < 250; i++) few[i][0] = (unsigned char)i, few[i][1] = (unsigned char)(255 - i), few[i][2] = (unsigned char)(7 * i);
    for (int i = 0; i < 5000; i++) many[i][0] = (unsigned char)(i % 50 * 5), many[i][1] = (unsigned char)(i / 50 * 2), many[i][2] = 40;
    assert_int_equal(rg_palette_init(&p, &mem), RG_OK);
    rg_palette_see(&p, few[0], 250);
    assert_int_equal(rg_palette_choose(&p), RG_OK);
    for (int i = 0; i < 250; i++) /* colours of one tint share theirs */
        for (int k = 0; k < 3; k++) near(p.colour[rg_palette_index(&p, few[i])][k], few[i][k], 4);
    rg_palette_free(&p);
    assert_int_equal(rg_palette_init(&p, &mem), RG_OK);
    rg_palette_see(&p, many[0], 5000);
    assert_int_equal(rg_palette_choose(&p), RG_OK);
    assert_int_equal(p.colours, RG_PALETTE_COLOURS);
    double off = 0;
    for (int i = 0; i < 5000; i++)
        for (int k = 0; k < 3; k++) off += abs(p.colour[rg_palette_index(&p, many[i])][k] - many[i][k]);
    below(off / 5000, 12);
    const unsigned char unseen[3] = {1, 250, 250};
    assert_true(rg_palette_index(&p, unseen) < p.colours);
    rg_palette_free(&p);
    assert_int_equal(rg_palette_init(&p, &mem), RG_OK);
    assert_int_equal(rg_palette_choose(&p), RG_OK); /* nothing seen */
    assert_int_equal(p.colours, 0);
    rg_palette_free(&p);
}

static void a_film_is_not_large(void **state)
{
    (void)state;
    rg_motion *m = some_motion(60);
    rg_picture p = rg_picture_default();
    struct stat is;
    rg_diag why = {0, ""};
    p.width = 640;
    p.height = 480;
    if (rg_film_write(m, in("x.gif"), &p, &why) != RG_OK) fail_msg("%s", why.text);
    assert_int_equal(stat(in("x.gif"), &is), 0);
    assert_true(is.st_size < 3 << 20);
    rg_motion_destroy(m);
}

static void one_frame_and_still_frames_are_films_too(void **state)
{
    (void)state;
    rg_motion *one = some_motion(1), *still = some_motion(4);
    for (int32_t i = 0; i < 4 * still->mesh.N; i++) still->rho[i] = 0;
    write_by(one, in("one.gif"), 0);
    write_by(one, in("one.apng"), 0);
    write_by(one, in("one/"), 3);
    assert_int_equal(entries(in("one")), 1);
    write_by(still, in("still.gif"), 0);
    write_by(still, in("still.apng"), 0);
    GifFileType *g = DGifOpenFileName(in("still.gif"), NULL);
    assert_non_null(g);
    assert_int_equal(DGifSlurp(g), GIF_OK);
    assert_int_equal(g->ImageCount, 6);
    assert_int_equal(g->SavedImages[1].ImageDesc.Width * g->SavedImages[1].ImageDesc.Height, 1);
    DGifCloseFile(g, NULL);
    rg_motion_destroy(one);
    rg_motion_destroy(still);
}

/* ------------------------------------------------------------------------------------------------- video ---- */

/* A program in place of ffmpeg: tells its arguments, one a line, and how much came in. */
static void with_program(const char *script)
{
    char path[500];
    mkdir(in("bin"), 0777);
    spill(in("bin/ffmpeg"), script);
    assert_int_equal(chmod(in("bin/ffmpeg"), 0755), 0);
    snprintf(path, sizeof path, "%s:/bin:/usr/bin", in("bin"));
    setenv("PATH", path, 1);
}

static void videos_go_through_a_program(void **state)
{
    (void)state;
    char *path = strdup(getenv("PATH")), script[1000], expected[40], here[4096];
    rg_motion *m = some_motion(FRAMES);
    rg_diag why = {0, ""};

    setenv("PATH", folder, 1);
    assert_int_equal(rg_film_check("x.mp4", &why), RG_EABSENT);
    assert_non_null(strstr(why.text, "ffmpeg"));
    refuse(m, in("x.mp4"), RG_EABSENT, "ffmpeg");
    unsetenv("PATH");
    assert_int_equal(rg_film_check("x.webm", &why), RG_EABSENT);

    snprintf(script, sizeof script, "#!/bin/sh\nfor a; do echo \"$a\"; done >%s\nfor a; do last=$a; done\n"
             "wc -c >\"${last#file:}\"\n", in("arguments"));
    with_program(script);
    static const char *const names[] = {"x.mp4", "-y.webm", "a b'$(touch oops)\";.mp4", "http:x.mp4"};
    assert_non_null(getcwd(here, sizeof here));
    assert_int_equal(chdir(folder), 0);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(rg_film_check(names[i], &why), RG_OK);
        write_by(m, names[i], 0);
        bytes got = slurp(names[i]), said = slurp(in("arguments"));
        snprintf(expected, sizeof expected, "%d\n", 3 * WIDTH * HEIGHT * LASTING);
        assert_string_equal((char *)got.at, expected);
        snprintf(expected, sizeof expected, "\n%dx%d\n", WIDTH, HEIGHT);
        assert_non_null(strstr((char *)said.at, expected));
        assert_non_null(strstr((char *)said.at, "\n30000/1000\n"));
        assert_non_null(strstr((char *)said.at, i == 1 ? "\nwebm\n" : "\nmp4\n"));
        assert_null(strstr((char *)said.at, i == 1 ? "\nmp4\n" : "\nwebm\n"));
        free(got.at);
        free(said.at);
    }
    assert_false(exists("oops"));
    assert_int_equal(chdir(here), 0);

    /* What it complains of is told, no file is left, and the one that was there stays. */
    spill(in("old.mp4"), "what was there");
    with_program("#!/bin/sh\necho 'no such codec' >&2\nexit 1\n");
    refuse(m, in("old.mp4"), RG_EWRITE, "no such codec");
    refuse(m, in("new.mp4"), RG_EWRITE, "new.mp4");
    with_program("#!/bin/sh\ncat >/dev/null\nexit 3\n");
    refuse(m, in("old.mp4"), RG_EWRITE, "ffmpeg");
    with_program("#!/bin/sh\ncat >/dev/null\nkill -9 $$\n");
    refuse(m, in("old.mp4"), RG_EWRITE, "ffmpeg");
    bytes old = slurp(in("old.mp4"));
    assert_string_equal((char *)old.at, "what was there");
    free(old.at);
    assert_false(exists(in("new.mp4")));
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(entries(folder), 3 + 4); /* bin, arguments, old.mp4; the four */
    rg_motion_destroy(m);
}

static void videos_are_videos(void **state)
{
    (void)state;
    rg_diag why = {0, ""};
    if (rg_film_check("x.mp4", &why) != RG_OK) {
        printf("SKIPPED: %s\n", why.text);
        skip();
    }
    rg_motion *m = some_motion(FRAMES);
    write_by(m, in("x.mp4"), 0);
    write_by(m, in("x.webm"), 1);
    bytes mp4 = slurp(in("x.mp4")), webm = slurp(in("x.webm"));
    assert_true(mp4.n > 1000 && webm.n > 500);
    assert_memory_equal(mp4.at + 4, "ftyp", 4);
    assert_memory_equal(webm.at, "\x1a\x45\xdf\xa3", 4);
    assert_int_equal(entries(folder), 2);
    free(mp4.at);
    free(webm.at);

    /* No file may be longer, which is like a disk that is full; ffmpeg by itself is content with that. */
    struct rlimit was, small;
    void (*before)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &was), 0);
    small = was;
    small.rlim_cur = 400;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    refuse(m, in("short.mp4"), RG_EWRITE, "short.mp4");
    refuse(m, in("short.webm"), RG_EWRITE, "short.webm");
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &was), 0);
    signal(SIGXFSZ, before);
    assert_int_equal(entries(folder), 2);
    rg_motion_destroy(m);
}

/* ------------------------------------------------------------------------------------------------ errors ---- */

static void what_cannot_be_written_is_named(void **state)
{
    (void)state;
    rg_motion *m = some_motion(3);
    spill(in("file"), "");
    refuse(m, in("no/such/"), RG_EWRITE, "no/such/");
    refuse(m, in("no/x.png"), RG_EWRITE, "no/x.png");
    refuse(m, in("no/x-%d.png"), RG_EWRITE, "no/x-");
    refuse(m, in("no/x.gif"), RG_EWRITE, "no/x.gif");
    refuse(m, in("file/"), RG_EWRITE, "file/");
    refuse(m, in("file/x.apng"), RG_EWRITE, "file/x.apng");
    assert_int_equal(entries(folder), 1);
    if (exists("/dev/full")) {
        static const char *const names[] = {"full.png", "full.gif", "full.apng", "full-2.png"};
        for (int i = 0; i < 4; i++) {
            assert_int_equal(symlink("/dev/full", in(names[i])), 0);
            refuse(m, in(i < 3 ? names[i] : "full-%d.png"), RG_EWRITE, "full");
        }
        assert_int_equal(entries(folder), 7); /* with full-0.png and full-1.png */
    } else {
        printf("no /dev/full here\n");
    }
    rg_picture p = small_picture();
    rg_diag why = {0, ""};
    p.width = 1 << 20;
    assert_int_equal(rg_film_write(m, in("huge/"), &p, &why), RG_EARG);
    assert_false(exists(in("huge")));
    p = small_picture();
    p.fps = -1;
    assert_int_equal(rg_film_write(m, in("slow.gif"), &p, &why), RG_EARG);
    assert_false(exists(in("slow.gif")));
    rg_motion_destroy(m);
}

/* The k-th allocation fails: the right status, no leak, no file. Under AddressSanitizer, where each takes ten times as long, each fourth one. */
static void shortage_leaves_nothing(void **state)
{
    (void)state;
    static const char *const names[] = {"x.gif", "x.apng", "d/"};
    rg_picture p = small_picture();
    p.width = 32;
    p.height = 24;
    for (int i = 0; i < 3; i++) {
        rg_motion *m = some_motion(3);
        const rg_memory mem = m->mem;
        rg_status s = RG_ENOMEM;
        for (long k = 0; s != RG_OK; k += WITH_ASAN ? 4 : 1) {
            counted count = {k, 0, 0};
            rg_diag why = {0, ""};
            m->mem = m->mesh.mem = m->tree.mem = (rg_memory){counted_resize, &count};
            s = rg_film_write_by(m, in(names[i]), &p, 1, &why);
            m->mem = m->mesh.mem = m->tree.mem = mem;
            assert_int_equal(count.out, 0);
            if (s == RG_OK) break;
            assert_int_equal(s, RG_ENOMEM);
            assert_true(strlen(why.text) > 0);
            if (i < 2) assert_int_equal(entries(folder), i);
            assert_true(k < 1000);
        }
        rg_motion_destroy(m);
    }
}

#define in_a_folder(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_a_folder(forms_are_told_by_their_names),
        in_a_folder(frames_are_numbered),
        in_a_folder(a_shorter_run_leaves_no_frames_of_a_longer_one),
        in_a_folder(threads_change_nothing),
        in_a_folder(apng_frames_are_the_pictures),
        in_a_folder(gif_frames_are_near_the_pictures),
        in_a_folder(films_go_as_they_are_told),
        cmocka_unit_test(palettes_are_close),
        in_a_folder(a_film_is_not_large),
        in_a_folder(one_frame_and_still_frames_are_films_too),
        in_a_folder(videos_go_through_a_program),
        in_a_folder(videos_are_videos),
        in_a_folder(what_cannot_be_written_is_named),
        in_a_folder(shortage_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
