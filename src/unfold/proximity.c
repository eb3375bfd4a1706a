#include "unfold/proximity.h"

#include <string.h>

/* An advance goes this part of what is safe, so that rounding can't make it unsafe; and ends when of the room that there was
 * this part is left. Layers that are very near each other and move together take many advances. */
static const double SAFE = 0.9, MET = 0.05;
static const int ADVANCES = 3000;

static void set(unsigned char *flag, size_t width, int32_t i, int32_t j) { flag[(size_t)i * width + (size_t)j] |= RG_PROXIMITY_APART; }

static void set_edges(rg_proximity *n, int32_t i, int32_t j)
{
    const size_t ne = (size_t)n->mesh->ne;
    set(n->edge, ne, i, j);
    set(n->edge, ne, j, i);
}

/* The corner of facet f that is not on edge e, and the edge from the other end than v of e to it. */
static int32_t tip(const rg_mesh *m, int32_t f, int32_t e)
{
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++)
        if (m->facet_vertex[j] != m->edge[e][0] && m->facet_vertex[j] != m->edge[e][1]) return m->facet_vertex[j];
    return -1;
}

static int32_t edge_between(const rg_mesh *m, int32_t f, int32_t a, int32_t b)
{
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
        const int32_t *v = m->edge[m->facet_edge[j]];
        if ((v[0] == a && v[1] == b) || (v[0] == b && v[1] == a)) return m->facet_edge[j];
    }
    return -1;
}

static void leave_out(rg_proximity *n)
{
    const rg_mesh *m = n->mesh;
    const size_t nf = (size_t)m->nf;
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) set(n->corner, nf, m->facet_vertex[j], f);
    for (int32_t e = 0; e < m->ne; e++)
        for (int32_t f = 0; f <= e; f++) {
            const int32_t *a = m->edge[e], *b = m->edge[f];
            if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) set_edges(n, e, f);
        }
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t f = m->edge_facet[e][0], g = m->edge_facet[e][1];
        if (f < 0 || g < 0) continue;
        const int32_t a = m->edge[e][0], b = m->edge[e][1], x = tip(m, f, e), y = tip(m, g, e);
        set(n->corner, nf, x, g);
        set(n->corner, nf, y, f);
        set_edges(n, edge_between(m, f, a, x), edge_between(m, g, b, y));
        set_edges(n, edge_between(m, f, b, x), edge_between(m, g, a, y));
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

static void corner_pair(const rg_mesh *m, int32_t v, int32_t f, rg_close_pair *at)
{
    const int32_t *c = m->facet_vertex + m->facet_start[f];
    *at = (rg_close_pair){0, v, f, {v, c[0], c[1], c[2]}, {1, 0, 0, 0}, 0, {0, 0, 0}};
}

static void edge_pair(const rg_mesh *m, int32_t e, int32_t f, rg_close_pair *at)
{
    *at = (rg_close_pair){1, e, f, {m->edge[e][0], m->edge[e][1], m->edge[f][0], m->edge[f][1]}, {0, 0, 0, 0}, 0, {0, 0, 0}};
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

double rg_proximity_distance(const rg_proximity *n, int32_t kind, int32_t i, int32_t j, const rg_vec3 *p, rg_close_pair *at)
{
    rg_close_pair mine;
    if (!at) at = &mine;
    if (kind == 0) corner_pair(n->mesh, i, j, at);
    else edge_pair(n->mesh, i, j, at);
    measure(at, p);
    return at->d;
}

static rg_status keep(rg_proximity *n, const rg_close_pair *at)
{
    const rg_status s = rg_mem_grow(&n->mem, (void **)&n->pair, &n->room, (size_t)n->count + 1, sizeof *n->pair);
    if (s == RG_OK) n->pair[n->count++] = *at;
    return s;
}

int rg_proximity_is_inside(const rg_close_pair *at)
{
    return at->weight[0] > 0 && at->weight[1] > 0 && at->weight[2] < 0 && at->weight[3] < 0;
}

/* The pair of two features, if it is one that is looked at; *flag: out. */
static int pair_of(const rg_proximity *n, rg_near_kind kind, int32_t i, int32_t j, rg_close_pair *at, unsigned char *flag)
{
    const rg_mesh *m = n->mesh;
    if (kind == RG_NEAR_CORNER) {
        j = n->plates.facet[j]; /* of a triangle that is the only part */
        *flag = n->corner[(size_t)i * (size_t)m->nf + (size_t)j];
        if (!(*flag & RG_PROXIMITY_APART)) corner_pair(m, i, j, at);
    } else {
        const int32_t high = i > j ? i : j, low = i > j ? j : i;
        *flag = n->edge[(size_t)high * (size_t)m->ne + (size_t)low];
        if (!(*flag & RG_PROXIMITY_APART)) edge_pair(m, high, low, at);
    }
    return !(*flag & RG_PROXIMITY_APART);
}

typedef struct finding { rg_proximity *n; const rg_vec3 *p; double least, touching; rg_status status; } finding;

static void find(void *ctx, rg_near_kind kind, int32_t i, int32_t j, int32_t a, int32_t b)
{
    finding *f = ctx;
    rg_close_pair at;
    unsigned char flag;
    (void)a, (void)b;
    if (f->status != RG_OK || !pair_of(f->n, kind, i, j, &at, &flag)) return;
    measure(&at, f->p);
    if (at.d < f->least && (at.kind == 0 || at.d < f->touching || rg_proximity_is_inside(&at))) f->status = keep(f->n, &at);
}

rg_status rg_proximity_find(rg_proximity *n, const rg_vec3 *p, double least, double touching)
{
    finding f = {n, p, least, touching, RG_OK};
    n->count = 0;
    rg_near_candidates(&n->plates, p, NULL, least, &n->work, find, &f);
    return f.status;
}

static double far_from(rg_vec3 a, rg_vec3 b) { return rg_vec3_length(rg_vec3_sub(a, b)); }

/* No point of the one goes to or from a point of the other by more than this while all go from p to q: the largest distance of
 * their own moves from the mean move, on either side. */
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

typedef struct meeting { rg_proximity *n; const rg_vec3 *p, *q; double gap, most; rg_close_pair *who; } meeting;

static void meet(void *ctx, rg_near_kind kind, int32_t i, int32_t j, int32_t a, int32_t b)
{
    meeting *m = ctx;
    rg_close_pair at;
    unsigned char flag;
    (void)a, (void)b;
    if (!pair_of(m->n, kind, i, j, &at, &flag) || flag & RG_PROXIMITY_GLUED) return;
    const double t = advance(&at, m->p, m->q, m->gap, m->most);
    if (!(t < m->most)) return;
    m->most = t;
    if (m->who) *m->who = at;
}

double rg_proximity_meet(rg_proximity *n, const rg_vec3 *p, const rg_vec3 *q, double gap, rg_close_pair *who)
{
    meeting m = {n, p, q, gap, 1, who};
    if (who) who->kind = -1;
    rg_near_candidates(&n->plates, p, q, 0, &n->work, meet, &m);
    return m.most;
}
