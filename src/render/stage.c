#include "render/stage.h"
#include "pattern/maps.h"

#include <string.h>

/* How much staying as it is counts beside the fit, in parts of the sheet's own inertia: it decides only where the fit
 * does not care, as for a sheet that has become a line. */
static const double STAY = 1e-6;
/* So much of where the sheet lay when it was flat has a say too, shared out over the frames: what one half of it did
 * alone does not leave the model aslant. */
static const double UPRIGHT_PULL = 6;
/* The rim is below the middle by more than that part of the sheet's size: then the sheet is put on its other side. */
static const double FALLS = 0.01;
/* Views that are tried: from where one sees the paper's face at first, and still sees it when it has come to stand. */
static const double LOWEST = 25, HIGHEST = 50, STEP = 5, USUAL = 35, AROUND = 15;
/* From the side that the file has below one knows one's drawing again, and from a plane of symmetry both halves are
 * seen alike: so much these views are preferred. */
static const double UPRIGHT = 0.1, ALIKE = 0.4;
/* The end is to fill at least that part of the picture, by the box around it, before margins are taken from it and the
 * camera has come near: less of it counts as so much less seen. */
static const double FILLED = 0.3;
/* What stands or lies as a stick is seen across the picture by a camera that is held aslant; the floor is then aslant
 * too. */
static const double ROLLS[] = {0, -15, 15, -30, 30};
static const double LEVEL = 0.1; /* so much less is liked of it for each STEEP of roll */
static const double STEEP = 15;

/* ---- turning as little as possible */

/* The eigenvector of the largest eigenvalue, by Jacobi's rotations: each makes one entry off the diagonal zero. */
static void largest_eigenvector(double A[4][4], double q[4])
{
    double V[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    enum { SWEEPS = 30 }; /* it converges quadratically: six do for doubles */
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int i = 0; i < 3; i++)
            for (int j = i + 1; j < 4; j++) {
                if (A[i][j] == 0) continue;
                const double theta = 0.5 * (A[j][j] - A[i][i]) / A[i][j];
                const double t = (theta < 0 ? -1 : 1) / (fabs(theta) + hypot(theta, 1)), c = 1 / hypot(t, 1), s = t * c;
                for (int k = 0; k < 4; k++) {
                    const double a = A[i][k], b = A[j][k];
                    A[i][k] = c * a - s * b, A[j][k] = s * a + c * b;
                }
                for (int k = 0; k < 4; k++) {
                    const double a = A[k][i], b = A[k][j], v = V[k][i], w = V[k][j];
                    A[k][i] = c * a - s * b, A[k][j] = s * a + c * b;
                    V[k][i] = c * v - s * w, V[k][j] = s * v + c * w;
                }
            }
    int best = 0;
    for (int i = 1; i < 4; i++)
        if (A[i][i] > A[best][best]) best = i;
    for (int k = 0; k < 4; k++) q[k] = V[k][best];
}

static rg_mat3 turn_of(const double q[4])
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    return (rg_mat3){{{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
                      {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
                      {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}}};
}

/* The rotation that takes x[], about its middle, nearest to `before` and, `pull` times as much, to `flat`; their
 * middles are the origin. weight[nv]: sum 1. */
static rg_place nearest(const double *weight, const rg_vec3 *x, const rg_vec3 *before, const rg_vec3 *flat, double pull,
                        int32_t nv)
{
    rg_vec3 middle = {0, 0, 0};
    for (int32_t v = 0; v < nv; v++) middle = rg_vec3_axpy(weight[v], x[v], middle);
    double S[3][3] = {{0}}, inertia = 0;
    for (int32_t v = 0; v < nv; v++) {
        const rg_vec3 d = rg_vec3_sub(x[v], middle);
        const double a[3] = {d.x, d.y, d.z},
                     b[3] = {before[v].x + pull * flat[v].x, before[v].y + pull * flat[v].y, before[v].z};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) S[i][j] += weight[v] * a[i] * b[j];
        inertia += weight[v] * rg_vec3_dot(d, d);
    }
    double N[4][4] = {
        {S[0][0] + S[1][1] + S[2][2] + STAY * inertia, S[1][2] - S[2][1], S[2][0] - S[0][2], S[0][1] - S[1][0]},
        {0, S[0][0] - S[1][1] - S[2][2], S[0][1] + S[1][0], S[2][0] + S[0][2]},
        {0, 0, S[1][1] - S[0][0] - S[2][2], S[1][2] + S[2][1]},
        {0, 0, 0, S[2][2] - S[0][0] - S[1][1]}};
    for (int i = 1; i < 4; i++)
        for (int j = 0; j < i; j++) N[i][j] = N[j][i];
    double q[4];
    largest_eigenvector(N, q);
    const rg_mat3 R = turn_of(q);
    return (rg_place){R, rg_vec3_scale(-1, rg_mat3_mul_vec(R, middle))};
}

/* ---- what is seen */

/* Of the motion, and of its end: sum of area * normal * normal. d' paper d is the paper that faces direction d, by its
 * cosine. */
typedef struct show {
    double paper[2][3][3];
    double rise;            /* of the rim over the middle, over the sheet's size, in the mean */
    const rg_vec3 *x;       /* [nv] the end */
    double wide, high;      /* of the picture */
} show;

static void look_at(const rg_mesh *m, const rg_vec3 *x, int last, show *s)
{
    double rim = 0, rise = 0;
    for (int32_t f = 0; f < m->nf; f++) {
        const rg_vec3 n = rg_pose_area(m, f, x);
        const double a = rg_vec3_length(n), c[3] = {n.x, n.y, n.z};
        for (int i = 0; a > 0 && i < 3; i++)
            for (int j = 0; j < 3; j++) {
                s->paper[0][i][j] += c[i] * c[j] / a;
                if (last) s->paper[1][i][j] += c[i] * c[j] / a;
            }
    }
    for (int32_t e = 0; e < m->ne; e++) {
        if (m->edge_crease[e] >= 0) continue;
        const double length = rg_vec2_length(rg_vec2_sub(m->X[m->edge[e][0]], m->X[m->edge[e][1]]));
        rim += length;
        rise += length * 0.5 * (x[m->edge[e][0]].z + x[m->edge[e][1]].z);
    }
    if (rim > 0) s->rise += rise / rim / m->size;
}

/* About the x axis. x[nv]: the end. */
static void turn_over(rg_stage *s, show *seen, rg_vec3 *x)
{
    for (int32_t k = 0; k < s->motion->report.frame_count; k++) {
        rg_place *p = &s->place[k];
        for (int i = 0; i < 3; i++) p->R.c[i].y = -p->R.c[i].y, p->R.c[i].z = -p->R.c[i].z;
        p->t.y = -p->t.y, p->t.z = -p->t.z;
    }
    for (int32_t v = 0; v < s->motion->mesh.nv; v++) x[v].y = -x[v].y, x[v].z = -x[v].z;
    for (int k = 0; k < 2; k++) {
        double(*T)[3] = seen->paper[k];
        T[0][1] = -T[0][1], T[0][2] = -T[0][2], T[1][0] = -T[1][0], T[2][0] = -T[2][0];
    }
    s->turned = 1;
}

/* How the pattern as it is drawn, without added creases, is like itself. */
static rg_status find_maps(const rg_mesh *m, const rg_memory *mem, rg_maps *maps)
{
    int32_t n = 0;
    rg_edge *E = rg_mem_array(mem, (size_t)m->ne, sizeof *E);
    if (!E) return RG_ENOMEM;
    for (int32_t e = 0; e < m->ne; e++)
        if (m->edge_crease[e] < m->N - m->added)
            E[n++] =
                (rg_edge){.v = {m->edge[e][0], m->edge[e][1]}, .assignment = m->assignment[e], .target = m->target[e]};
    const rg_status s = rg_maps_find(maps, mem, m->nv, m->X, n, E, RG_SAME_PLACE * m->size);
    rg_mem_free(mem, E);
    return s;
}

/* The geometric mean of what is seen of the motion and of its end, as neither replaces the other. */
static double paper_seen(const show *s, rg_vec3 d)
{
    const double c[3] = {d.x, d.y, d.z};
    double sum[2] = {0, 0};
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) sum[k] += c[i] * s->paper[k][i][j] * c[j];
    return sqrt(fmax(0, sum[0] * sum[1]));
}

/* Of the picture, by the box around the end. */
static double filled(const show *s, int32_t nv, rg_vec3 back, double roll)
{
    const double level = hypot(back.x, back.y), c = cos(roll), si = sin(roll);
    const rg_vec3 right = {-back.y / level, back.x / level, 0}, up = rg_vec3_cross(back, right);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int32_t v = 0; v < nv; v++) {
        const double r = rg_vec3_dot(right, s->x[v]), u = rg_vec3_dot(up, s->x[v]),
                     at[2] = {c * r + si * u, c * u - si * r};
        for (int i = 0; i < 2; i++) low[i] = fmin(low[i], at[i]), high[i] = fmax(high[i], at[i]);
    }
    const double w = (high[0] - low[0]) / s->wide, h = (high[1] - low[1]) / s->high;
    return w > 0 && h > 0 ? fmin(w, h) / fmax(w, h) : 0;
}

static void try_view(rg_stage *s, const show *seen, double azimuth, double elevation, double favour, double *best)
{
    const double a = azimuth * RG_DEG, e = elevation * RG_DEG;
    const rg_vec3 back = {cos(e) * cos(a), cos(e) * sin(a), sin(e)};
    const double paper = favour * (1 - UPRIGHT * sin(a)) * cos(e - USUAL * RG_DEG) * paper_seen(seen, back);
    for (size_t i = 0; i < sizeof ROLLS / sizeof *ROLLS; i++) {
        const double roll = ROLLS[i] * RG_DEG, level = 1 - LEVEL * fabs(ROLLS[i]) / STEEP;
        if (!(level * paper > *best * (1 + 1e-9))) continue;
        const double score = level * paper * fmin(1, filled(seen, s->motion->mesh.nv, back, roll) / FILLED);
        if (!(score > *best * (1 + 1e-9))) continue;
        *best = score;
        s->azimuth = a, s->elevation = e, s->roll = roll;
    }
}

static void try_azimuth(rg_stage *s, const show *seen, double azimuth, double favour, double *best)
{
    for (double up = LOWEST; up <= HIGHEST; up += STEP) try_view(s, seen, azimuth, up, favour, best);
}

/* x[nv]: the end. */
static rg_status choose_view(rg_stage *s, show *seen, rg_vec3 *x)
{
    rg_maps maps;
    double best = 0;
    if (seen->rise / s->motion->report.frame_count < -FALLS) turn_over(s, seen, x);
    seen->x = x;
    const rg_status status = find_maps(&s->motion->mesh, &s->mem, &maps);
    if (status != RG_OK) return status;
    for (int32_t i = 0; i < maps.count; i++) {
        if (!maps.map[i].mirror || !maps.map[i].keeps) continue;
        const double line = (s->turned ? -0.5 : 0.5) * atan2(maps.map[i].s, maps.map[i].c) / RG_DEG;
        try_azimuth(s, seen, line, 1 + ALIKE, &best);
        try_azimuth(s, seen, line + 180, 1 + ALIKE, &best);
    }
    rg_maps_free(&maps);
    for (double around = -90; around < 270; around += AROUND) try_azimuth(s, seen, around, 1, &best);
    return RG_OK;
}

/* ---- the stage */

/* Each vertex by the paper around it. */
static void weigh(const rg_mesh *m, double *weight)
{
    double sum = 0;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t first = m->facet_start[f], last = m->facet_start[f + 1];
        double area = 0;
        for (int32_t j = first + 1; j + 1 < last; j++)
            area += rg_vec2_turn(m->X[m->facet_vertex[first]], m->X[m->facet_vertex[j]], m->X[m->facet_vertex[j + 1]]);
        for (int32_t j = first; j < last; j++) weight[m->facet_vertex[j]] += area / (last - first);
        sum += area;
    }
    for (int32_t v = 0; v < m->nv; v++) weight[v] /= sum;
}

static rg_status put_all(rg_stage *s, const double *weight, rg_vec3 *x, rg_vec3 *before, rg_vec3 *flat, show *seen)
{
    const rg_motion *m = s->motion;
    const int32_t nv = m->mesh.nv, last = m->report.frame_count - 1;
    rg_vec3 middle = {0, 0, 0};
    for (int32_t v = 0; v < nv; v++)
        middle = rg_vec3_axpy(weight[v], (rg_vec3){m->mesh.X[v].x, m->mesh.X[v].y, 0}, middle);
    for (int32_t v = 0; v < nv; v++) before[v] = rg_vec3_sub((rg_vec3){m->mesh.X[v].x, m->mesh.X[v].y, 0}, middle);
    memcpy(flat, before, (size_t)nv * sizeof *flat);
    for (int32_t k = 0; k <= last; k++) {
        const rg_status status = rg_motion_place(m, k, x);
        if (status != RG_OK) return status;
        s->place[k] = nearest(weight, x, before, flat, UPRIGHT_PULL / (last + 1), nv);
        rg_stage_put(s, k, x, nv);
        look_at(&m->mesh, x, k == last, seen);
        memcpy(before, x, (size_t)nv * sizeof *x);
    }
    return RG_OK;
}

rg_status rg_stage_init(const rg_memory *mem, const rg_motion *m, const rg_picture *p, rg_stage *s)
{
    const size_t nv = (size_t)m->mesh.nv;
    show seen = {.wide = p->width, .high = p->height};
    *s = (rg_stage){.mem = *mem, .motion = m, .azimuth = p->azimuth, .elevation = p->elevation};
    double *weight;
    rg_vec3 *x;
    rg_status status = RG_MEM_ARRAYS(mem, RG_ARRAY(s->place, (size_t)m->report.frame_count), RG_ARRAY(weight, nv),
                                     RG_ARRAY(x, 3 * nv));
    if (status == RG_OK) {
        weigh(&m->mesh, weight);
        status = put_all(s, weight, x, x + nv, x + 2 * nv, &seen);
    }
    if (status == RG_OK && !p->aimed) status = choose_view(s, &seen, x);
    RG_MEM_FREE(mem, weight, x);
    return status;
}

void rg_stage_free(rg_stage *s)
{
    if (s->mem.resize) rg_mem_free(&s->mem, s->place);
    s->place = NULL;
}

void rg_stage_put(const rg_stage *s, int32_t frame, rg_vec3 *x, int32_t n)
{
    const rg_place p = s->place[frame];
    for (int32_t i = 0; i < n; i++) x[i] = rg_vec3_add(rg_mat3_mul_vec(p.R, x[i]), p.t);
}

void rg_stage_turn(const rg_stage *s, int32_t frame, rg_vec3 *d, int32_t n)
{
    for (int32_t i = 0; i < n; i++) d[i] = rg_mat3_mul_vec(s->place[frame].R, d[i]);
}
