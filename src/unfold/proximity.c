#include "unfold/proximity.h"

#include <string.h>

/* Edges whose directions differ by less (square of the sine) are taken for parallel: the closest points are then not unique. */
static const double PARALLEL = 1e-14;
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
    n->corner = rg_mem_array(mem, (size_t)m->nv * nf, 1);
    n->edge = rg_mem_array(mem, ne * ne, 1);
    n->low = rg_mem_array(mem, nf + ne, sizeof *n->low);
    n->high = rg_mem_array(mem, nf + ne, sizeof *n->high);
    if (!n->corner || !n->edge || !n->low || !n->high) {
        rg_proximity_free(n);
        return RG_ENOMEM;
    }
    leave_out(n);
    return RG_OK;
}

void rg_proximity_free(rg_proximity *n)
{
    if (!n->mem.resize) return;
    void *block[] = {n->corner, n->edge, n->low, n->high, n->pair};
    for (int i = 0; i < 5; i++) rg_mem_free(&n->mem, block[i]);
    memset(n, 0, sizeof *n);
}

/* Weights of a, b, c at the point of triangle a b c closest to p. */
static void closest_on_triangle(rg_vec3 p, rg_vec3 a, rg_vec3 b, rg_vec3 c, double w[3])
{
    const rg_vec3 ab = rg_vec3_sub(b, a), ac = rg_vec3_sub(c, a);
    const rg_vec3 ap = rg_vec3_sub(p, a), bp = rg_vec3_sub(p, b), cp = rg_vec3_sub(p, c);
    const double a1 = rg_vec3_dot(ab, ap), a2 = rg_vec3_dot(ac, ap), b1 = rg_vec3_dot(ab, bp), b2 = rg_vec3_dot(ac, bp);
    const double c1 = rg_vec3_dot(ab, cp), c2 = rg_vec3_dot(ac, cp);
    const double at_c = a1 * b2 - b1 * a2, at_b = c1 * a2 - a1 * c2, at_a = b1 * c2 - c1 * b2;
    w[0] = w[1] = w[2] = 0;
    if (a1 <= 0 && a2 <= 0) w[0] = 1;
    else if (b1 >= 0 && b2 <= b1) w[1] = 1;
    else if (c2 >= 0 && c1 <= c2) w[2] = 1;
    else if (at_c <= 0 && a1 >= 0 && b1 <= 0) w[1] = a1 / (a1 - b1), w[0] = 1 - w[1];
    else if (at_b <= 0 && a2 >= 0 && c2 <= 0) w[2] = a2 / (a2 - c2), w[0] = 1 - w[2];
    else if (at_a <= 0 && b2 >= b1 && c1 >= c2) w[2] = (b2 - b1) / ((b2 - b1) + (c1 - c2)), w[1] = 1 - w[2];
    else {
        const double sum = at_a + at_b + at_c;
        w[1] = at_b / sum, w[2] = at_c / sum, w[0] = 1 - w[1] - w[2];
    }
}

static double within(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

/* Where along a b (s) and along c d (t) the segments are closest. */
static void closest_on_segments(rg_vec3 a, rg_vec3 b, rg_vec3 c, rg_vec3 d, double *s, double *t)
{
    const rg_vec3 x = rg_vec3_sub(b, a), y = rg_vec3_sub(d, c), r = rg_vec3_sub(a, c);
    const double xx = rg_vec3_dot(x, x), yy = rg_vec3_dot(y, y), xy = rg_vec3_dot(x, y);
    const double xr = rg_vec3_dot(x, r), yr = rg_vec3_dot(y, r), det = xx * yy - xy * xy;
    *s = det > PARALLEL * xx * yy ? within((xy * yr - xr * yy) / det) : 0;
    *t = (xy * *s + yr) / yy;
    if (*t < 0 || *t > 1) {
        *t = within(*t);
        *s = within((xy * *t - xr) / xx);
    }
}

static double spread(const rg_close_pair *at, const rg_vec3 *p)
{
    rg_vec3 d = {0, 0, 0};
    for (int k = 0; k < 4; k++) d = rg_vec3_axpy(at->weight[k], p[at->v[k]], d);
    return rg_vec3_length(d);
}

static void corner_pair(const rg_mesh *m, int32_t v, int32_t f, rg_close_pair *at)
{
    const int32_t *c = m->facet_vertex + m->facet_start[f];
    *at = (rg_close_pair){0, v, f, {v, c[0], c[1], c[2]}, {1, 0, 0, 0}, 0};
}

static void edge_pair(const rg_mesh *m, int32_t e, int32_t f, rg_close_pair *at)
{
    *at = (rg_close_pair){1, e, f, {m->edge[e][0], m->edge[e][1], m->edge[f][0], m->edge[f][1]}, {0, 0, 0, 0}, 0};
}

static void measure(rg_close_pair *at, const rg_vec3 *p)
{
    const int32_t *v = at->v;
    if (at->kind == 0) {
        double w[3];
        closest_on_triangle(p[v[0]], p[v[1]], p[v[2]], p[v[3]], w);
        at->weight[0] = 1;
        for (int k = 0; k < 3; k++) at->weight[k + 1] = -w[k];
    } else {
        double s, t;
        closest_on_segments(p[v[0]], p[v[1]], p[v[2]], p[v[3]], &s, &t);
        at->weight[0] = 1 - s, at->weight[1] = s, at->weight[2] = t - 1, at->weight[3] = -t;
    }
    at->d = spread(at, p);
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

/* Boxes round n points each, grown by `more` on all sides. */
static void box(const int32_t *v, int32_t n, const rg_vec3 *p, const rg_vec3 *q, double more, rg_vec3 *low, rg_vec3 *high)
{
    rg_vec3 l = p[v[0]], h = l;
    for (int32_t i = 0; i < n; i++)
        for (int k = 0; k < 2; k++) {
            const rg_vec3 x = k ? q[v[i]] : p[v[i]];
            l = (rg_vec3){fmin(l.x, x.x), fmin(l.y, x.y), fmin(l.z, x.z)};
            h = (rg_vec3){fmax(h.x, x.x), fmax(h.y, x.y), fmax(h.z, x.z)};
        }
    *low = (rg_vec3){l.x - more, l.y - more, l.z - more};
    *high = (rg_vec3){h.x + more, h.y + more, h.z + more};
}

static void boxes(rg_proximity *n, const rg_vec3 *p, const rg_vec3 *q, double more)
{
    const rg_mesh *m = n->mesh;
    for (int32_t f = 0; f < m->nf; f++) box(m->facet_vertex + m->facet_start[f], 3, p, q, more, &n->low[f], &n->high[f]);
    for (int32_t e = 0; e < m->ne; e++) box(m->edge[e], 2, p, q, more / 2, &n->low[m->nf + e], &n->high[m->nf + e]);
}

static int apart(rg_vec3 l, rg_vec3 h, rg_vec3 low, rg_vec3 high)
{
    return l.x > high.x || h.x < low.x || l.y > high.y || h.y < low.y || l.z > high.z || h.z < low.z;
}

static rg_status keep(rg_proximity *n, const rg_close_pair *at)
{
    const rg_status s = rg_mem_grow(&n->mem, (void **)&n->pair, &n->room, (size_t)n->count + 1, sizeof *n->pair);
    if (s == RG_OK) n->pair[n->count++] = *at;
    return s;
}

/* Both ends of the shortest line are inside their edges; else a corner is as near. */
static int inside(const rg_close_pair *at)
{
    return at->weight[0] > 0 && at->weight[1] > 0 && at->weight[2] < 0 && at->weight[3] < 0;
}

rg_status rg_proximity_find(rg_proximity *n, const rg_vec3 *p, double least)
{
    const rg_mesh *m = n->mesh;
    const rg_vec3 *low = n->low, *high = n->high;
    rg_close_pair at;
    rg_status s = RG_OK;
    n->count = 0;
    boxes(n, p, p, least);
    for (int32_t f = 0; f < m->nf; f++)
        for (int32_t v = 0; v < m->nv; v++) {
            if (apart(p[v], p[v], low[f], high[f]) || (n->corner[(size_t)v * (size_t)m->nf + (size_t)f] & RG_PROXIMITY_APART)) continue;
            corner_pair(m, v, f, &at);
            measure(&at, p);
            if (at.d < least && (s = keep(n, &at)) != RG_OK) return s;
        }
    low += m->nf, high += m->nf;
    for (int32_t e = 0; e < m->ne; e++)
        for (int32_t f = 0; f < e; f++) {
            if (apart(low[e], high[e], low[f], high[f]) || (n->edge[(size_t)e * (size_t)m->ne + (size_t)f] & RG_PROXIMITY_APART)) continue;
            edge_pair(m, e, f, &at);
            measure(&at, p);
            if (at.d < least && inside(&at) && (s = keep(n, &at)) != RG_OK) return s;
        }
    return s;
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

double rg_proximity_meet(rg_proximity *n, const rg_vec3 *p, const rg_vec3 *q, double gap, rg_close_pair *who)
{
    const rg_mesh *m = n->mesh;
    double most = 1;
    rg_close_pair at;
    if (who) who->kind = -1;
    boxes(n, p, q, 0);
    for (int kind = 0; kind < 2; kind++)
        for (int32_t i = 0; i < (kind ? m->ne : m->nv); i++)
            for (int32_t j = 0; j < (kind ? i : m->nf); j++) {
                const rg_vec3 *l = kind ? &n->low[m->nf + i] : &p[i], *h = kind ? &n->high[m->nf + i] : &p[i];
                rg_vec3 low = *l, high = *h;
                if (!kind) {
                    low = (rg_vec3){fmin(p[i].x, q[i].x), fmin(p[i].y, q[i].y), fmin(p[i].z, q[i].z)};
                    high = (rg_vec3){fmax(p[i].x, q[i].x), fmax(p[i].y, q[i].y), fmax(p[i].z, q[i].z)};
                }
                const int32_t other = kind ? m->nf + j : j;
                if (apart(low, high, n->low[other], n->high[other])) continue;
                if (kind ? n->edge[(size_t)i * (size_t)m->ne + (size_t)j] : n->corner[(size_t)i * (size_t)m->nf + (size_t)j]) continue;
                if (kind) edge_pair(m, i, j, &at);
                else corner_pair(m, i, j, &at);
                const double t = advance(&at, p, q, gap, most);
                if (!(t < most)) continue;
                most = t;
                if (who) *who = at;
            }
    return most;
}
