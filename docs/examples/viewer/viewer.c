/* What a viewer of one's own needs: the fold is found in a thread, which the user may end; then each state becomes the
 * two arrays that OpenGL, Direct3D or WebGL draw: triangles with normals, and the creases as lines.  ./viewer
 * pattern.opx [PERCENT at which the user loses patience] */
#include <math.h>
#include <pthread.h>
#include <rigami.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

/* What the thread and the window share. */
typedef struct search {
    const rg_pattern *pattern;
    atomic_int cancel, percent;
    int patience;
    rg_fold *fold;
    rg_status status;
    rg_diag why;
} search;

/* In the thread that searches. */
static int watch(void *ctx, double progress)
{
    search *q = ctx;
    atomic_store(&q->percent, (int)(100 * progress));
    if (100 * progress >= q->patience) atomic_store(&q->cancel, 1); /* which a button would do */
    return atomic_load(&q->cancel);
}

static void *look(void *ctx)
{
    search *q = ctx;
    rg_settings settings = rg_settings_default();
    settings.effort = RG_EFFORT_FAST; /* somebody waits */
    q->status = rg_fold_create(q->pattern, &settings, watch, q, &q->fold, &q->why);
    return NULL;
}

typedef struct corner { float at[3], normal[3]; } corner;

/* Facets are flat, so that each triangle has a normal of its own and corners are not shared. */
static void fill_triangles(const rg_fold *fold, const rg_sheet *sheet, corner *out)
{
    const double(*x)[3] = rg_fold_positions(fold, NULL);
    const rg_transform *place = rg_fold_transforms(fold, NULL);
    for (int32_t f = 0; f < sheet->facets; f++)
        for (int32_t t = sheet->facet_triangle[f]; t < sheet->facet_triangle[f + 1]; t++)
            for (int k = 0; k < 3; k++, out++)
                for (int a = 0; a < 3; a++) {
                    out->at[a] = (float)x[sheet->triangle[t][k]][a];
                    out->normal[a] = (float)place[f].column[2][a]; /* where the front's +z goes */
                }
}

/* Two points a line: border and drawn creases, without those that were added. */
static size_t fill_lines(const rg_fold *fold, const rg_sheet *sheet, float (*out)[3])
{
    const double(*x)[3] = rg_fold_positions(fold, NULL);
    size_t n = 0;
    for (int32_t e = 0; e < sheet->edges; e++)
        for (int end = 0; end < 2 && sheet->assignment[e] != 'F'; end++, n++)
            for (int a = 0; a < 3; a++) out[n][a] = (float)x[sheet->ends[e][end]][a];
    return n;
}

int main(int argc, char **argv)
{
    if (argc < 2) return fprintf(stderr, "usage: %s pattern [percent]\n", argv[0]), 2;
    rg_pattern *pattern = NULL;
    rg_diag why = {0};
    if (rg_pattern_read(argv[1], NULL, &pattern, &why) != RG_OK)
        return fprintf(stderr, "%s:%d: %s\n", argv[1], why.line, why.text), 1;
    search q = {.pattern = pattern, .patience = argc > 2 ? atoi(argv[2]) : 101};
    pthread_t thread;
    if (pthread_create(&thread, NULL, look, &q) != 0) look(&q);
    else pthread_join(thread, NULL); /* a window would go on drawing, and show q.percent */
    if (q.status == RG_OK && !atomic_load(&q.cancel)) {
        const rg_sheet *sheet = rg_motion_get_sheet(rg_fold_motion(q.fold));
        corner *triangles = malloc(3 * (size_t)sheet->triangles * sizeof *triangles);
        float(*lines)[3] = malloc(2 * (size_t)sheet->edges * sizeof *lines);
        for (const rg_step_info *i = rg_fold_get_info(q.fold); triangles && lines; i = rg_fold_step(q.fold)) {
            fill_triangles(q.fold, sheet, triangles); /* glBufferSubData(GL_ARRAY_BUFFER, 0, bytes, triangles) */
            const size_t points = fill_lines(q.fold, sheet, lines);
            if (i->frame % 20 == 0)
                printf("%5.1f %%  %d triangles, %d lines, a corner at (%.1f %.1f %.1f)\n", 100 * i->progress,
                       (int)sheet->triangles, (int)(points / 2),
                       triangles[1].at[0], triangles[1].at[1], triangles[1].at[2]);
            if (i->outcome != RG_RUNNING) break;
        }
        free(triangles);
        free(lines);
    } else if (q.status == RG_OK) {
        printf("ended at %d %%: there are %d frames all the same\n", (int)atomic_load(&q.percent),
               (int)rg_motion_report(rg_fold_motion(q.fold))->frame_count);
    } else
        fprintf(stderr, "%s\n", q.why.text);
    rg_fold_destroy(q.fold);
    rg_pattern_destroy(pattern);
    return q.status != RG_OK;
}
