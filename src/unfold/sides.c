#include "unfold/sides.h"

#include <string.h>

/* Edges that are nearer to parallel (sine) have no normal to be told sides by. */
static const double PARALLEL = 1e-3;
/* The facets at two edges say which way is up as long as they are within 25 degrees of facing each other. */
static const double FACING = 0.9;
/* Where the closest point is on the rim of the facet, its normal tells the side if it is within 60 degrees of the
 * shortest line, or if that is too short to have a direction. */
static const double ACROSS = 0.5, NO_DIRECTION = 2e-5;

rg_status rg_sides_init(rg_sides *s, const rg_memory *mem, const rg_mesh *m)
{
    memset(s, 0, sizeof *s);
    s->mem = *mem;
    s->mesh = m;
    const size_t nf = (size_t)m->nf, nv = (size_t)m->nv, ne = (size_t)m->ne;
    return RG_MEM_ARRAYS(mem, RG_ARRAY(s->up, nf), RG_ARRAY(s->over, nf * nf), RG_ARRAY(s->corner, nv * nf),
                         RG_ARRAY(s->edge, ne * ne), RG_ARRAY(s->corner_behind, nv * nf),
                         RG_ARRAY(s->edge_behind, ne * ne));
}

void rg_sides_free(rg_sides *s)
{
    if (!s->mem.resize) return;
    RG_MEM_FREE(&s->mem, s->up, s->over, s->corner, s->edge, s->corner_behind, s->edge_behind);
    memset(s, 0, sizeof *s);
}

static signed char over(const rg_sides *s, int32_t f, int32_t g)
{
    return s->over[(size_t)f * (size_t)s->mesh->nf + (size_t)g];
}

/* What s->corner says from these values on: over the facet, or under it, and inside its folded edge; outside its
 * edge. */
enum { OVER_INSIDE = 10, UNDER_INSIDE = 13, ROUND_EDGE = 16 };
/* A corner is on the rim of a facet within this (lengths of the sheet): drawings are rounded. */
static const double ON_RIM = 1e-4;

/* One of several that all say the same, or say nothing: 2 once they differ. */
static signed char both(signed char a, signed char b) { return a == 0 ? b : b == 0 || a == b ? a : 2; }

static signed char settled(signed char a) { return a == 2 ? 0 : a; }

/* How far outside facet f's k-th edge x is, in the plane, and where along it, 0 ... 1. */
static double outside(const rg_mesh *m, int32_t f, int k, const rg_vec2 *x, rg_vec2 at, double *along)
{
    const int32_t *v = m->facet_vertex + m->facet_start[f];
    const rg_vec2 a = x[v[k]], d = rg_vec2_sub(x[v[(k + 1) % 3]], a), to = rg_vec2_sub(at, a);
    const double length = rg_vec2_length(d), area = rg_vec2_turn(x[v[0]], x[v[1]], x[v[2]]);
    *along = rg_vec2_dot(d, to) / (length * length);
    return -rg_vec2_cross(d, to) / length * (area > 0 ? 1 : -1);
}

/* Which of edges k and l of f, at its corner v, a direction at v leaves f across. */
static int across_which(const rg_mesh *m, int32_t f, int k, int l, const rg_vec2 *x, rg_vec2 from, rg_vec2 to)
{
    double along;
    const rg_vec2 d = rg_vec2_sub(to, from);
    const double length = rg_vec2_length(d);
    const rg_vec2 ahead = {from.x + d.x / length, from.y + d.y / length};
    return outside(m, f, k, x, ahead, &along) - outside(m, f, k, x, from, &along) >=
                   outside(m, f, l, x, ahead, &along) - outside(m, f, l, x, from, &along) ? k : l;
}

/* The edge of facet g at v that is not e. */
static int32_t other_edge(const rg_mesh *m, int32_t g, int32_t v, int32_t e)
{
    for (int32_t j = m->facet_start[g]; j < m->facet_start[g + 1]; j++) {
        const int32_t i = m->facet_edge[j];
        if (i != e && (m->edge[i][0] == v || m->edge[i][1] == v)) return i;
    }
    return -1;
}

/* v is at the corner of f between its edges k and l: which of them its facets go round, from one over f to one under
 * it, past some that are beside f. All ways from over to under must say the same; else -1. */
static int round_which(const rg_sides *s, int32_t v, int32_t f, int k, int l, const rg_vec2 *x)
{
    const rg_mesh *m = s->mesh;
    int found = -1;
    for (int32_t e = 0; e < m->ne; e++) {
        if (m->edge[e][0] != v && m->edge[e][1] != v) continue;
        for (int side = 0; side < 2; side++) {
            int32_t g = m->edge_facet[e][side], via = e;
            if (g < 0 || over(s, g, f) != 1) continue;
            for (;;) {
                g = m->edge_facet[via][m->edge_facet[via][0] == g];
                if (g < 0 || over(s, g, f) != 0) break;
                via = other_edge(m, g, v, via);
            }
            if (g < 0 || over(s, g, f) != -1) continue;
            for (int i = 0; i < 2; i++) {
                const int32_t *ends = m->edge[i ? via : e];
                const int which = across_which(m, f, k, l, x, x[v], x[ends[0] == v ? ends[1] : ends[0]]);
                if (found >= 0 && which != found) return -1;
                found = which;
            }
        }
    }
    return found;
}

/* A corner whose facets are partly over and partly under f goes round the edge of f that it lies on: ROUND_EDGE and
 * which. */
static signed char goes_round(const rg_sides *s, int32_t v, int32_t f, const rg_vec2 *x)
{
    const rg_mesh *m = s->mesh;
    for (int k = 0; k < 3; k++) {
        const rg_vec2 d = rg_vec2_sub(x[m->facet_vertex[m->facet_start[f] + (k + 1) % 3]], x[v]);
        if (rg_vec2_length(d) > ON_RIM) continue;
        const int which = round_which(s, v, f, k, (k + 1) % 3, x);
        return (signed char)(which < 0 ? 0 : ROUND_EDGE + which);
    }
    for (int k = 0; k < 3; k++) {
        double along;
        const double out = outside(m, f, k, x, x[v], &along);
        if (fabs(out) <= ON_RIM && along >= 0 && along <= 1) return (signed char)(ROUND_EDGE + k);
    }
    return 0;
}

/* v is over f, or under it, and lies on a folded edge of f, with facets between the two of that edge: it stays
 * inside. */
static signed char lies_inside(const rg_sides *s, int32_t v, int32_t f, signed char side, const rg_vec2 *x)
{
    const rg_mesh *m = s->mesh;
    for (int k = 0; k < 3; k++) {
        double along;
        const int32_t e = m->facet_edge[m->facet_start[f] + k];
        const int32_t other = m->edge_facet[e][m->edge_facet[e][0] == f];
        if (other < 0 || over(s, other, f) != side) continue;
        const rg_vec2 d = rg_vec2_sub(x[m->edge[e][0]], x[m->edge[e][1]]);
        const double beyond = ON_RIM / rg_vec2_length(d);
        if (fabs(outside(m, f, k, x, x[v], &along)) > ON_RIM || along < -beyond || along > 1 + beyond) continue;
        for (int32_t g = 0; g < m->nf; g++) {
            if (over(s, g, f) != side || over(s, g, other) != -side) continue;
            const int32_t *c = m->facet_vertex + m->facet_start[g];
            if (c[0] == v || c[1] == v || c[2] == v) return (signed char)((side > 0 ? OVER_INSIDE : UNDER_INSIDE) + k);
        }
    }
    return side;
}

void rg_sides_finish(rg_sides *s, const rg_vec2 *x, const rg_stop *stop)
{
    const rg_mesh *m = s->mesh;
    const size_t nf = (size_t)m->nf;
    memset(s->corner, 0, (size_t)m->nv * nf);
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
            for (int32_t g = 0; g < m->nf; g++) {
                signed char *c = &s->corner[(size_t)m->facet_vertex[j] * nf + (size_t)g];
                *c = both(*c, over(s, f, g));
            }
    for (int32_t v = 0; v < m->nv && !rg_stop_asked(stop); v++)
        for (int32_t f = 0; f < m->nf; f++) {
            signed char *c = &s->corner[(size_t)v * nf + (size_t)f];
            *c = *c == 2 ? goes_round(s, v, f, x) : *c == 0 ? 0 : lies_inside(s, v, f, *c, x);
        }
    for (int32_t e = 0; e < m->ne; e++)
        for (int32_t f = 0; f < m->ne; f++) {
            signed char c = 0;
            for (int i = 0; i < 4; i++) {
                const int32_t a = m->edge_facet[e][i / 2], b = m->edge_facet[f][i % 2];
                if (a >= 0 && b >= 0) c = both(c, over(s, a, b));
            }
            s->edge[(size_t)e * (size_t)m->ne + (size_t)f] = settled(c);
        }
}

/* The normal of a facet that points up at the flat end. */
static rg_vec3 upwards(const rg_sides *s, const rg_linkage *P, int32_t f)
{
    return rg_vec3_scale(s->up[f], P->place[f].R.c[2]);
}

/* A corner that is to stay on one side, +1 outside, -1 inside, of edge k of the facet, in the facet's plane. */
static int tell_in_plane(const rg_linkage *P, rg_close_pair *at, int k, int side, rg_vec3 *n, double *d)
{
    const int i = 1 + k, j = 1 + (k + 1) % 3;
    const rg_vec3 a = P->p[at->v[i]], along = rg_vec3_sub(P->p[at->v[j]], a), to = rg_vec3_sub(P->p[at->v[0]], a);
    const double squared = rg_vec3_dot(along, along), t = fmin(1, fmax(0, rg_vec3_dot(along, to) / squared));
    const rg_vec3 out = rg_vec3_scale(side / sqrt(squared), rg_vec3_cross(along, P->place[at->j].R.c[2]));
    const rg_vec3 apart = rg_vec3_axpy(-t, along, to);
    const double across = rg_vec3_dot(out, apart), length = rg_vec3_length(apart);
    if (fabs(across) < ACROSS * length && length > NO_DIRECTION) return 0;
    for (int w = 1; w < 4; w++) at->weight[w] = 0;
    at->weight[i] = t - 1, at->weight[j] = -t;
    *n = out;
    *d = across;
    return 1;
}

int rg_sides_tell(const rg_sides *s, const rg_linkage *P, rg_close_pair *at, rg_vec3 *n, double *d)
{
    const rg_mesh *m = s->mesh;
    const rg_vec3 apart = rg_proximity_apart(at, P->p);
    if (at->kind == 0) {
        int side = s->corner[(size_t)at->i * (size_t)m->nf + (size_t)at->j], inside = -1;
        if (side == 0) return 0;
        if (side >= ROUND_EDGE) return tell_in_plane(P, at, side - ROUND_EDGE, 1, n, d);
        if (side >= OVER_INSIDE) {
            inside = side - (side >= UNDER_INSIDE ? UNDER_INSIDE : OVER_INSIDE);
            side = side >= UNDER_INSIDE ? -1 : 1;
        }
        const rg_vec3 up = rg_vec3_scale(side, upwards(s, P, at->j));
        const int rim = at->weight[1] == 0 || at->weight[2] == 0 || at->weight[3] == 0;
        if (rim && fabs(rg_vec3_dot(apart, up)) < ACROSS * at->d && at->d > NO_DIRECTION) /* past the rim */
            return inside >= 0 && tell_in_plane(P, at, inside, -1, n, d);
        *n = up;
    } else {
        const signed char side = s->edge[(size_t)at->i * (size_t)m->ne + (size_t)at->j];
        if (side == 0) return 0;
        const rg_vec3 a = rg_vec3_sub(P->p[at->v[1]], P->p[at->v[0]]), b = rg_vec3_sub(P->p[at->v[3]], P->p[at->v[2]]);
        rg_vec3 c = rg_vec3_cross(a, b);
        const double length = rg_vec3_length(c);
        if (length < PARALLEL * rg_vec3_length(a) * rg_vec3_length(b)) return 0;
        c = rg_vec3_scale(1 / length, c);
        double sense = 0;
        for (int i = 0; i < 4; i++) {
            const int32_t f = m->edge_facet[i < 2 ? at->i : at->j][i % 2];
            if (f < 0) continue;
            const double facing = rg_vec3_dot(upwards(s, P, f), c);
            if (fabs(facing) < FACING || facing * sense < 0) return 0;
            sense = facing;
        }
        *n = rg_vec3_scale(side * (sense > 0 ? 1 : -1), c);
    }
    *d = rg_vec3_dot(*n, apart);
    return 1;
}

int rg_sides_is_behind(const rg_sides *s, const rg_close_pair *at)
{
    const size_t i = (size_t)at->i, j = (size_t)at->j;
    return at->kind ? s->edge_behind[i * (size_t)s->mesh->ne + j] : s->corner_behind[i * (size_t)s->mesh->nf + j];
}
