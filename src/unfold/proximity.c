#include "unfold/proximity.h"

#include <string.h>

/* An advance goes this part of what is safe, so that rounding can't make it unsafe; and ends when of the room that
 * there was this part is left. Layers that are very near each other and move together take many advances. */
static const double SAFE = 0.9, MET = 0.05;
static const int ADVANCES = 3000;

unsigned char *rg_proximity_flags(rg_proximity *n, int32_t kind, int32_t i, int32_t j)
{
    return kind ? n->edge + (size_t)i * (size_t)n->mesh->ne + (size_t)j
                : n->corner + (size_t)i * (size_t)n->mesh->nf + (size_t)j;
}

static void set(rg_proximity *n, int32_t kind, int32_t i, int32_t j)
{
    *rg_proximity_flags(n, kind, i, j) |= RG_PROXIMITY_APART;
}

static void set_edges(rg_proximity *n, int32_t i, int32_t j)
{
    set(n, 1, i, j);
    set(n, 1, j, i);
}

static void leave_out(rg_proximity *n)
{
    const rg_mesh *m = n->mesh;
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) set(n, 0, m->facet_vertex[j], f);
    for (int32_t e = 0; e < m->ne; e++)
        for (int32_t f = 0; f <= e; f++) {
            const int32_t *a = m->edge[e], *b = m->edge[f];
            if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) set_edges(n, e, f);
        }
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t f = m->edge_facet[e][0], g = m->edge_facet[e][1];
        if (f < 0 || g < 0) continue;
        const int32_t a = m->edge[e][0], b = m->edge[e][1];
        const int32_t x = rg_mesh_opposite(m, f, e), y = rg_mesh_opposite(m, g, e);
        set(n, 0, x, g);
        set(n, 0, y, f);
        set_edges(n, rg_mesh_edge_between(m, f, a, x), rg_mesh_edge_between(m, g, b, y));
        set_edges(n, rg_mesh_edge_between(m, f, b, x), rg_mesh_edge_between(m, g, a, y));
    }
}

rg_status rg_proximity_init(rg_proximity *n, const rg_memory *mem, const rg_mesh *m)
{
    memset(n, 0, sizeof *n);
    n->mem = *mem;
    n->mesh = m;
    const size_t nf = (size_t)m->nf, ne = (size_t)m->ne;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(n->corner, (size_t)m->nv * nf), RG_ARRAY(n->edge, ne * ne));
    if (s == RG_OK) s = rg_plates_init(m, &n->plates);
    if (s == RG_OK) s = rg_near_work_init(&n->plates, &n->work);
    if (s == RG_OK) leave_out(n);
    else rg_proximity_free(n);
    return s;
}

void rg_proximity_free(rg_proximity *n)
{
    if (!n->mem.resize) return;
    rg_near_work_free(&n->work);
    rg_plates_free(&n->plates);
    RG_MEM_FREE(&n->mem, n->corner, n->edge, n->pair);
    memset(n, 0, sizeof *n);
}

static rg_close_pair pair_of(const rg_mesh *m, int32_t kind, int32_t i, int32_t j)
{
    if (kind) {
        const int32_t *e = m->edge[i], *f = m->edge[j];
        return (rg_close_pair){.kind = 1, .i = i, .j = j, .v = {e[0], e[1], f[0], f[1]}};
    }
    const int32_t *c = m->facet_vertex + m->facet_start[j];
    return (rg_close_pair){.i = i, .j = j, .v = {i, c[0], c[1], c[2]}};
}

static void measure(rg_close_pair *at, const rg_vec3 *p)
{
    const int32_t *v = at->v;
    if (at->kind == 0) {
        double w[3];
        at->d = rg_near_triangle(p[v[0]], p[v[1]], p[v[2]], p[v[3]], w, &at->n);
        at->weight[0] = 1;
        for (int k = 0; k < 3; k++) at->weight[k + 1] = -w[k];
    } else {
        double s, t;
        at->d = rg_near_segments(p[v[0]], p[v[1]], p[v[2]], p[v[3]], &s, &t, &at->n);
        at->weight[0] = 1 - s, at->weight[1] = s, at->weight[2] = t - 1, at->weight[3] = -t;
    }
}

double rg_proximity_distance(const rg_proximity *n, int32_t kind, int32_t i, int32_t j, const rg_vec3 *p,
                             rg_close_pair *at)
{
    *at = pair_of(n->mesh, kind, i, j);
    measure(at, p);
    return at->d;
}

rg_vec3 rg_proximity_apart(const rg_close_pair *at, const rg_vec3 *p)
{
    rg_vec3 d = {0, 0, 0};
    for (int i = 0; i < 4; i++) d = rg_vec3_axpy(at->weight[i], p[at->v[i]], d);
    return d;
}

rg_vec3 rg_proximity_direction(const rg_close_pair *at, const rg_vec3 *p)
{
    rg_vec3 n = {0, 0, 0};
    for (int i = 0; i < 4; i++) n = rg_vec3_axpy(at->weight[i] / fmax(at->d, 1e-300), p[at->v[i]], n);
    return n;
}

static rg_status keep(rg_proximity *n, const rg_close_pair *at)
{
    const rg_status s = RG_MEM_GROW(&n->mem, n->pair, n->room, (size_t)n->count + 1);
    if (s == RG_OK) n->pair[n->count++] = *at;
    return s;
}

int rg_proximity_is_inside(const rg_close_pair *at)
{
    return at->weight[0] > 0 && at->weight[1] > 0 && at->weight[2] < 0 && at->weight[3] < 0;
}

/* The pair of two features as near.h tells of them; its flags. */
static rg_close_pair pair_told(rg_proximity *n, rg_near_kind kind, int32_t i, int32_t j, unsigned char *flags)
{
    rg_close_pair at;
    /* A triangle is its only part. */
    if (kind == RG_NEAR_CORNER) at = pair_of(n->mesh, 0, i, n->plates.facet[j]);
    else at = pair_of(n->mesh, 1, i > j ? i : j, i > j ? j : i);
    *flags = *rg_proximity_flags(n, at.kind, at.i, at.j);
    return at;
}

typedef struct finding { rg_proximity *n; const rg_vec3 *p; double least, touching; rg_status status; } finding;

static void find(void *ctx, rg_near_kind kind, int32_t i, int32_t j)
{
    finding *f = ctx;
    unsigned char flags;
    rg_close_pair at = pair_told(f->n, kind, i, j, &flags);
    if (f->status != RG_OK || flags & RG_PROXIMITY_APART) return;
    measure(&at, f->p);
    if (!(at.d < f->least)) return;
    if (at.kind == 0 || at.d < f->touching || rg_proximity_is_inside(&at)) f->status = keep(f->n, &at);
}

rg_status rg_proximity_find(rg_proximity *n, const rg_vec3 *p, double least, double touching)
{
    finding f = {n, p, least, touching, RG_OK};
    n->count = 0;
    rg_near_candidates(&n->plates, p, NULL, least, &n->work, find, &f);
    return f.status;
}

static double far_from(rg_vec3 a, rg_vec3 b) { return rg_vec3_length(rg_vec3_sub(a, b)); }

/* No point of the one goes to or from a point of the other by more than this while all go from p to q: the largest
 * distance of their own moves from the mean move, on either side. */
static double closing(const rg_close_pair *at, const rg_vec3 *p, const rg_vec3 *q)
{
    const int split = at->kind == 0 ? 1 : 2;
    rg_vec3 move[4], mean = {0, 0, 0};
    double first = 0, second = 0;
    for (int k = 0; k < 4; k++) {
        move[k] = rg_vec3_sub(q[at->v[k]], p[at->v[k]]);
        mean = rg_vec3_axpy(0.25, move[k], mean);
    }
    for (int k = 0; k < 4; k++) {
        const double d = far_from(move[k], mean);
        if (k < split) first = fmax(first, d);
        else second = fmax(second, d);
    }
    return first + second;
}

/* The part of p ... q, at most `most`, that the pair can go. */
static double advance(const rg_close_pair *from, const rg_vec3 *p, const rg_vec3 *q, double gap, double most)
{
    const double speed = closing(from, p, q);
    rg_vec3 x[4];
    rg_close_pair at = *from;
    measure(&at, p);
    const double floor = gap * at.d, room = at.d - floor;
    if (speed * most <= room) return most;
    double t = SAFE * room / speed;
    for (int k = 0; k < 4; k++) at.v[k] = k;
    for (int n = 0; t < most; n++) {
        for (int k = 0; k < 4; k++)
            x[k] = rg_vec3_axpy(t, rg_vec3_sub(q[from->v[k]], p[from->v[k]]), p[from->v[k]]);
        measure(&at, x);
        if (!(at.d - floor > MET * room) || n == ADVANCES) return t;
        t += SAFE * (at.d - floor) / speed;
    }
    return most;
}

typedef struct meeting { rg_proximity *n; const rg_vec3 *p, *q; double gap, most; } meeting;

static void meet(void *ctx, rg_near_kind kind, int32_t i, int32_t j)
{
    meeting *m = ctx;
    unsigned char flags;
    const rg_close_pair at = pair_told(m->n, kind, i, j, &flags);
    if (flags & (RG_PROXIMITY_APART | RG_PROXIMITY_GLUED)) return;
    const double t = advance(&at, m->p, m->q, m->gap, m->most);
    if (t < m->most) m->most = t;
}

double rg_proximity_meet(rg_proximity *n, const rg_vec3 *p, const rg_vec3 *q, double gap)
{
    meeting m = {n, p, q, gap, 1};
    rg_near_candidates(&n->plates, p, q, 0, &n->work, meet, &m);
    return m.most;
}
