/* pictures -- what drawing a motion and writing it costs, part by part, beside folding it.
 *
 * One row a pattern: 60 frames of 960 x 720. Parts are seconds of the processor, those of OpenGL's threads included, one
 * frame after the other; "_wall" are seconds on the clock of all of it by as many threads as there are processors, the
 * files going to a folder that is removed afterwards. Each is the best of a few. */
#include "motion/measure.h"
#include "render/frames.h"
#include "render/lift.h"
#include "render/render.h"
#include "write/film.h"
#include "write/png.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { TIMES = 3 };

static double by(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
static double cpu(void) { return by(CLOCK_PROCESS_CPUTIME_ID); }
static double wall(void) { return by(CLOCK_MONOTONIC); }

static void give_up(const char *what, const char *why)
{
    fprintf(stderr, "bench: %s: %s\n", what, why);
    exit(1);
}

static void must(rg_status s, const char *what, const rg_diag *why)
{
    if (s != RG_OK) give_up(what, why->text[0] ? why->text : rg_status_text(s));
}

/* Seconds of each part; drawing, by a process of its own, and the last three on the wall. */
enum { FOLDING, MEASURING, FRAMING, LAYERS, DRAWING, PACKING, FOLDER, LAST, GIF, PARTS };
static const char *const NAMES[PARTS] = {"folding",       "measuring",     "framing", "layers", "drawing_wall",
                                         "packing_png", "folder_wall", "last_png_wall", "gif_wall"};

typedef struct bill {
    double seconds[PARTS];
    double png_bytes, gif_bytes;
} bill;

static void least(bill *b, int part, double seconds) { b->seconds[part] = fmin(b->seconds[part], seconds); }

static rg_motion *fold(const char *path, const char *kind, int32_t n, bill *b)
{
    rg_diag why = {0, ""};
    rg_settings s = rg_settings_default();
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    if (kind) must(rg_generate(kind, n, 0, 0, path, &why), kind, &why);
    must(rg_pattern_read(path, NULL, &p, &why), path, &why);
    if (kind) unlink(path);
    for (int k = 0; k < TIMES; k++) {
        rg_motion_destroy(m);
        double from = cpu();
        must(rg_motion_create(p, &s, NULL, NULL, &m, &why), path, &why);
        const double all = cpu() - from;
        from = cpu();
        must(rg_measure_frames(m, NULL), path, &why);
        const double measuring = cpu() - from;
        least(b, FOLDING, all - measuring);
        least(b, MEASURING, measuring);
    }
    rg_pattern_destroy(p);
    return m;
}

/* One painter, part after part; the file is the null device. */
static void paint(const rg_motion *m, const rg_picture *p, bill *b)
{
    rg_diag why = {0, ""};
    rg_triangles t;
    rg_lift *layers = NULL;
    rg_render *render = NULL;
    rg_stage stage;
    rg_camera *camera = calloc((size_t)m->report.frame_count, sizeof *camera);
    double sum[PARTS] = {0}, from = cpu();
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x), *lift = calloc((size_t)m->mesh.nf, sizeof *lift);
    unsigned char *rgb = calloc((size_t)p->width * (size_t)p->height, 3);
    FILE *null = fopen("/dev/null", "wb");
    if (!x || !lift || !rgb || !null || !camera) give_up("pictures", "out of memory");
    must(rg_stage_init(&m->mem, m, p, &stage), "stage", &why);
    must(rg_camera_follow(&stage, p, camera, &why), "camera", &why);
    sum[FRAMING] = cpu() - from;
    must(rg_triangles_init(&m->mem, &m->mesh, &t), "triangles", &why);
    must(rg_lift_create(&m->mem, m, &t, &layers), "layers", &why);
    must(rg_render_create(&m->mem, &m->mesh, &t, p, NULL, &render, &why), "render", &why);
    for (int32_t f = 0; f < m->report.frame_count; f++) {
        const double begun = cpu();
        must(rg_lift_next(layers, x, lift), "layers", &why);
        const double laid = cpu(), from_wall = wall();
        rg_stage_put(&stage, f, x, m->mesh.nv);
        rg_stage_turn(&stage, f, lift, m->mesh.nf);
        const rg_shot shot = {x, lift, &camera[f], NULL, NULL};
        rg_render_frame(render, &shot, rgb);
        sum[DRAWING] += wall() - from_wall;
        const double drawn = cpu();
        must(rg_png_write(null, p->width, p->height, rgb, NULL, &why), "png", &why);
        sum[LAYERS] += laid - begun, sum[PACKING] += cpu() - drawn;
    }
    for (int part = FRAMING; part <= PACKING; part++) least(b, part, sum[part]);
    rg_render_destroy(render);
    rg_lift_destroy(layers);
    rg_triangles_free(&t);
    rg_stage_free(&stage);
    fclose(null);
    free(x), free(lift), free(rgb), free(camera);
}

static double bytes_of(const char *path)
{
    struct stat is;
    return stat(path, &is) == 0 ? (double)is.st_size : 0;
}

static void clear(const char *folder, int32_t frames, bill *b)
{
    char path[600];
    b->png_bytes = 0;
    for (int32_t f = 0; f < frames; f++) {
        snprintf(path, sizeof path, "%s/%04d.png", folder, (int)f);
        b->png_bytes += bytes_of(path);
        unlink(path);
    }
}

static void write_films(const rg_motion *m, const rg_picture *p, const char *folder, bill *b)
{
    rg_diag why = {0, ""};
    char path[600];
    double from = wall();
    must(rg_film_write(m, folder, p, &why), folder, &why);
    least(b, FOLDER, wall() - from);
    clear(folder, m->report.frame_count, b);
    snprintf(path, sizeof path, "%s/x.png", folder);
    from = wall();
    must(rg_film_write(m, path, p, &why), path, &why);
    least(b, LAST, wall() - from);
    unlink(path);
    snprintf(path, sizeof path, "%s/x.gif", folder);
    from = wall();
    must(rg_film_write(m, path, p, &why), path, &why);
    least(b, GIF, wall() - from);
    b->gif_bytes = bytes_of(path);
    unlink(path);
}

static void row(const char *name, const char *kind, int32_t n, const char *folder)
{
    bill b = {{0}, 0, 0};
    char path[600];
    for (int i = 0; i < PARTS; i++) b.seconds[i] = INFINITY;
    snprintf(path, sizeof path, kind ? "%s/pattern.opx" : "%s", kind ? folder : name);
    const rg_picture p = rg_picture_default();
    rg_motion *m = fold(path, kind, n, &b);
    for (int k = 0; k < TIMES; k++) paint(m, &p, &b);
    for (int k = 0; k < TIMES; k++) write_films(m, &p, folder, &b);
    printf("%s,%d,%d", kind ? kind : name, (int)n, (int)m->report.unknowns);
    for (int i = 0; i < PARTS; i++) printf(",%.3g", b.seconds[i]);
    printf(",%.2f,%.2f,%.1f,%.1f\n", b.png_bytes / 1048576, b.gif_bytes / 1048576, b.seconds[FOLDER] / b.seconds[FOLDING],
           b.seconds[GIF] / b.seconds[FOLDING]);
    fflush(stdout);
    rg_motion_destroy(m);
}

int main(int argc, char **argv)
{
    const char *under = getenv("TMPDIR");
    char folder[300];
    snprintf(folder, sizeof folder, "%s/rigami-bench-XXXXXX", under && *under ? under : "/tmp");
    if (!mkdtemp(folder)) give_up(folder, strerror(errno));
    printf("\npattern,n,creases");
    for (int i = 0; i < PARTS; i++) printf(",%s_s", NAMES[i]);
    printf(",folder_mib,gif_mib,folder_over_folding,gif_over_folding\n");
    row("patterns/bird.opx", NULL, 0, folder);
    row("miura", "miura", 16, folder);
    row("waterbomb", "waterbomb", 8, folder);
    if (argc < 2 || strcmp(argv[1], "small") != 0) {
        row("miura", "miura", 64, folder);
        row("waterbomb", "waterbomb", 32, folder);
    }
    rmdir(folder);
    return 0;
}
