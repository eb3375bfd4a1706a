/* motions.h -- motions made by hand, whose fold angles are known.  Include after cmocka.h, near.h and draw.h. */
#ifndef MOTIONS_H
#define MOTIONS_H

#include "draw.h"
#include "motion/motion.h"

#include <string.h>

/* rho[m->N]: out, at time t = 0 ... 1 */
typedef void (*folding)(const rg_mesh *m, double t, double *rho, void *ctx);

/* Takes the lines over. Frame k is at time k / (frames - 1). */
static inline rg_motion *motion_by(rg_lines *l, int32_t frames, folding fold, void *ctx)
{
    rg_pattern *p = pattern_of(l);
    const rg_memory mem = rg_mem_default(NULL);
    rg_motion *m = rg_mem_array(&mem, 1, sizeof *m);
    rg_diag why = {0, ""};
    assert_non_null(m);
    m->mem = mem;
    m->settings = rg_settings_default();
    if (rg_mesh_from_pattern(p, &mem, &m->mesh, &why) != RG_OK) fail_msg("%s", why.text);
    assert_int_equal(rg_tree_init(&m->mesh, 0, &m->tree), RG_OK);
    m->rho = rg_mem_array(&mem, (size_t)frames * (size_t)m->mesh.N, sizeof *m->rho);
    m->frame = rg_mem_array(&mem, (size_t)frames, sizeof *m->frame);
    assert_true(m->rho && m->frame);
    for (int32_t k = 0; k < frames; k++) {
        const double t = frames > 1 ? (double)k / (frames - 1) : 1;
        fold(&m->mesh, t, m->rho + (size_t)k * (size_t)m->mesh.N, ctx);
        m->frame[k].percent = 100 * t;
    }
    m->info = *rg_pattern_get_info(p);
    m->info.title = m->info.author = "";
    m->report.pattern = &m->info;
    m->report.frame_count = frames;
    m->report.frames = m->frame;
    rg_pattern_destroy(p);
    return m;
}

static inline double mountain_or_valley(const rg_mesh *m, int32_t i)
{
    const char a = m->assignment[m->crease_edge[i]];
    return a == RG_MOUNTAIN ? -1 : a == RG_VALLEY ? 1 : 0;
}

/* All creases go to +-180 degrees at the same pace: for patterns without interior vertices. */
static inline void all_alike(const rg_mesh *m, double t, double *rho, void *ctx)
{
    (void)ctx;
    for (int32_t i = 0; i < m->N; i++) rho[i] = t * RG_PI * mountain_or_valley(m, i);
}

/* Crease after crease, so that what lies flat stays so for many frames: creases[i] moves in part i of the time. */
static inline void one_by_one(const rg_mesh *m, double t, double *rho, void *ctx)
{
    (void)ctx;
    for (int32_t i = 0; i < m->N; i++) {
        const double x = m->X[m->edge[m->crease_edge[i]][0]].x; /* creases at 1, 2, 3 */
        rho[i] = RG_PI * mountain_or_valley(m, i) * fmin(1, fmax(0, 3 * t - (x - 1)));
    }
}

/* A strip along x of panels that are width[i] wide, joined by creases of the assignments given. */
static inline rg_lines strip(int panels, const double *width, const char *assignment, double height)
{
    rg_lines l = drawing();
    double x = 0;
    for (int i = 0; i < panels; i++) {
        draw(&l, RG_BORDER, x, 0, x + width[i], 0);
        draw(&l, RG_BORDER, x, height, x + width[i], height);
        if (i > 0) draw(&l, assignment[i - 1], x, 0, x, height);
        x += width[i];
    }
    draw(&l, RG_BORDER, 0, 0, 0, height);
    draw(&l, RG_BORDER, x, 0, x, height);
    return l;
}

/* The facet that has a point of the pattern inside; convex ones only. */
static inline int32_t facet_at(const rg_mesh *m, double x, double y)
{
    for (int32_t f = 0; f < m->nf; f++) {
        int inside = 1;
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const int32_t next = j + 1 < m->facet_start[f + 1] ? j + 1 : m->facet_start[f];
            inside &= rg_vec2_turn(m->X[m->facet_vertex[j]], m->X[m->facet_vertex[next]], (rg_vec2){x, y}) > 0;
        }
        if (inside) return f;
    }
    return -1;
}

/* Miura-ori of n x m parallelograms with sides a (across) and b (along) and the angle alpha between them. The zigzag
 * lines' creases go by `t` from flat to folded flat, the straight ones' follow so that each vertex closes. */
static inline rg_lines miura(int n, int m, double a, double b, double alpha)
{
    rg_lines l = drawing();
    const double dx = b * cos(alpha), dy = b * sin(alpha);
    for (int j = 0; j <= m; j++)
        for (int i = 0; i <= n; i++) {
            const double x = i * a + (j & 1) * dx, y = j * dy;
            if (i < n) draw(&l, j == 0 || j == m ? RG_BORDER : (i + j) & 1 ? RG_VALLEY : RG_MOUNTAIN, x, y, x + a, y);
            if (j < m) draw(&l, i == 0 || i == n ? RG_BORDER : i & 1 ? RG_MOUNTAIN : RG_VALLEY, x, y, x + (j & 1 ? -dx : dx), y + dy);
        }
    return l;
}

/* Tangents of half the angles are in the ratio cos(alpha), the straight lines' the smaller ones. ctx: alpha. */
static inline void miura_folds(const rg_mesh *m, double t, double *rho, void *ctx)
{
    const double alpha = *(const double *)ctx;
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t *v = m->edge[m->crease_edge[i]];
        const int straight = fabs(m->X[v[0]].y - m->X[v[1]].y) < 1e-9 * m->size;
        const double zigzag = t * RG_PI;
        rho[i] = mountain_or_valley(m, i) * (straight ? 2 * atan2(cos(alpha) * sin(0.5 * zigzag), cos(0.5 * zigzag)) : zigzag);
    }
}

#endif
