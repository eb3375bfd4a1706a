#include "contact/front.h"

#include <string.h>

/* Of the sheet's area: a triangle of less has none, its corners are in line. */
static const double NO_AREA = 1e-12;
/* Of the sheet's size: border lines nearer than this may touch, for all that rounding lets us know. */
static const double TOUCHES = 1e-10;
/* How often the direction is turned towards the facet that shows least: what cannot be seen from one side takes for
 * ever. */
enum { TURNS = 16 };
/* Normals whose sines are below this are of one plane: the sheet is folded flat. */
static const double ONE_PLANE = 1e-6;

rg_status rg_front_work_init(const rg_plates *p, rg_front_work *w)
{
    memset(w, 0, sizeof *w);
    w->mem = p->mem;
    const size_t nf = (size_t)p->mesh->nf, nv = (size_t)p->mesh->nv, n = (size_t)p->borders;
    const rg_status s = RG_MEM_ARRAYS(&p->mem, RG_ARRAY(w->normal, nf), RG_ARRAY(w->from, nv), RG_ARRAY(w->to, nv),
                                      RG_ARRAY(w->order, n), RG_ARRAY(w->low, n), RG_ARRAY(w->high, n));
    for (int32_t i = 0; s == RG_OK && i < p->borders; i++) w->order[i] = i;
    return s;
}

void rg_front_work_free(rg_front_work *w)
{
    if (!w->mem.resize) return;
    RG_MEM_FREE(&w->mem, w->normal, w->from, w->to, w->order, w->low, w->high);
    memset(w, 0, sizeof *w);
}

/* ----------------------------------------------------------------------------- direction ---- */

/* The normal that shows least of its front along d. */
static double least_shown(const rg_vec3 *normal, int32_t n, rg_vec3 d, int32_t *who)
{
    double least = INFINITY;
    for (int32_t i = 0; i < n; i++) {
        const double c = rg_vec3_dot(normal[i], d);
        if (!(c >= least)) least = c, *who = i;
    }
    return least;
}

/* What the sheet shows as a whole: the sum of its facets' normals times their areas is an integral along the border. */
static rg_vec3 whole_front(const rg_plates *p, const rg_vec3 *x)
{
    rg_vec3 sum = {0, 0, 0};
    const rg_vec3 origin = x[0];
    for (int32_t b = 0; b < p->borders; b++) {
        const int32_t e = p->border[b], left = p->mesh->edge_facet[e][0] >= 0, *v = p->mesh->edge[e];
        sum = rg_vec3_add(sum, rg_vec3_cross(rg_vec3_sub(x[v[!left]], origin), rg_vec3_sub(x[v[left]], origin)));
    }
    return sum;
}

/* From there towards the normal that shows least, by less and less, which ends at the middle of the smallest ball about
 * all normals (Badoiu and Clarkson 2003), and so at the direction that shows most of the least. Zero: none was
 * found. */
static int find_direction(rg_vec3 start, const rg_vec3 *normal, int32_t n, rg_vec3 *d)
{
    int32_t who = 0;
    rg_vec3 middle = start;
    for (int turn = 0; turn < TURNS; turn++) {
        const double length = rg_vec3_length(middle);
        if (!(length > 0)) return 0;
        *d = rg_vec3_scale(1 / length, middle);
        if (least_shown(normal, n, *d, &who) > 0) return 1;
        const double by = 1.0 / (turn + 2);
        middle = rg_vec3_axpy(1 - by, turn ? middle : *d, rg_vec3_scale(by, normal[who]));
    }
    return 0;
}

/* A sheet that is folded flat shows its front nowhere, but all of it edge on from within its plane: the direction there
 * that comes nearest to d. Zero: it is not flat. */
static int within_plane(const rg_vec3 *normal, int32_t n, rg_vec3 *d)
{
    for (int32_t i = 1; i < n; i++)
        if (!(rg_vec3_length(rg_vec3_cross(normal[0], normal[i])) <= ONE_PLANE)) return 0;
    const rg_vec3 flat = rg_vec3_axpy(-rg_vec3_dot(normal[0], *d), normal[0], *d);
    const double length = rg_vec3_length(flat);
    if (!(length > ONE_PLANE)) return 0;
    *d = rg_vec3_scale(1 / length, flat);
    return 1;
}

/* Two directions across d, so that (u, v, d) is right-handed. */
static void across(rg_vec3 d, rg_vec3 *u, rg_vec3 *v)
{
    const rg_vec3 any = fabs(d.x) < 0.6 ? (rg_vec3){1, 0, 0} : (rg_vec3){0, 1, 0};
    *u = rg_vec3_cross(any, d);
    *u = rg_vec3_scale(1 / rg_vec3_length(*u), *u);
    *v = rg_vec3_cross(d, *u);
}

/* The view from later.c[2] that is turned least from the first: about the line across both directions. */
static void turn_view(const rg_mat3 *view, rg_mat3 *later)
{
    const rg_vec3 d = view->c[2], e = later->c[2], axis = rg_vec3_cross(d, e);
    const double c = rg_vec3_dot(d, e);
    if (!(c > -0.9)) {
        across(e, &later->c[0], &later->c[1]); /* no view to keep */
        return;
    }
    for (int k = 0; k < 2; k++) {
        const rg_vec3 u = view->c[k];
        later->c[k] = rg_vec3_axpy(c, u, rg_vec3_axpy(rg_vec3_dot(axis, u) / (1 + c), axis, rg_vec3_cross(axis, u)));
    }
}

/* Of all vertices if `whole`, else of the border's; about the middle of these, so that it goes no farther than it
 * must. */
static void picture_of(const rg_plates *p, const rg_vec3 *x, rg_vec3 u, rg_vec3 v, int whole, rg_vec2 *to)
{
    rg_vec3 middle = {0, 0, 0};
    for (int32_t b = 0; b < p->borders; b++) middle = rg_vec3_add(middle, x[p->mesh->edge[p->border[b]][0]]);
    if (p->borders) middle = rg_vec3_scale(1.0 / p->borders, middle);
    const int32_t n = whole ? p->mesh->nv : 2 * p->borders;
    for (int32_t i = 0; i < n; i++) {
        const int32_t k = whole ? i : p->mesh->edge[p->border[i / 2]][i % 2];
        const rg_vec3 d = rg_vec3_sub(x[k], middle);
        to[k] = (rg_vec2){rg_vec3_dot(u, d), rg_vec3_dot(v, d)};
    }
}

/* -------------------------------------------------------------------------------- border ---- */

static double least4(double a, double b, double c, double d) { return fmin(fmin(a, b), fmin(c, d)); }

/* Quadratic in time from 0 to 1, in Bernstein's form: between the ends it is positive if the middle coefficient is and
 * the outer ones are not negative. */
static int stays_above(double at_0, double middle, double at_1, double limit)
{
    return at_0 >= -limit && middle > limit && at_1 >= -limit;
}

/* For all the time, all of segment c lies on the left of the line of segment a, or on its right. */
static int lies_beside(const rg_vec2 *x, const rg_vec2 *y, const int32_t *a, const int32_t *c, double limit)
{
    int left = 1, right = 1;
    const rg_vec2 e = rg_vec2_sub(x[a[1]], x[a[0]]), g = rg_vec2_sub(y[a[1]], y[a[0]]);
    for (int k = 0; k < 2; k++) {
        const rg_vec2 r = rg_vec2_sub(x[c[k]], x[a[0]]), s = rg_vec2_sub(y[c[k]], y[a[0]]);
        const double b[3] = {rg_vec2_cross(e, r), (rg_vec2_cross(e, s) + rg_vec2_cross(g, r)) / 2, rg_vec2_cross(g, s)};
        left = left && stays_above(b[0], b[1], b[2], limit);
        right = right && stays_above(-b[0], -b[1], -b[2], limit);
    }
    return left || right;
}

/* Neighbours on the border: they meet beyond their corner only where one is folded back onto the other. */
static int stays_spread(const rg_vec2 *x, const rg_vec2 *y, const int32_t *a, const int32_t *c, double limit)
{
    const int32_t mid = a[0] == c[0] || a[0] == c[1] ? a[0] : a[1], p = a[mid == a[0]], q = c[mid == c[0]];
    const rg_vec2 e = rg_vec2_sub(x[p], x[mid]), f = rg_vec2_sub(x[q], x[mid]);
    const rg_vec2 g = rg_vec2_sub(y[p], y[mid]), h = rg_vec2_sub(y[q], y[mid]);
    const double across[3] = {rg_vec2_cross(e, f), (rg_vec2_cross(e, h) + rg_vec2_cross(g, f)) / 2,
                              rg_vec2_cross(g, h)};
    const double along[3] = {rg_vec2_dot(e, f), (rg_vec2_dot(e, h) + rg_vec2_dot(g, f)) / 2, rg_vec2_dot(g, h)};
    return stays_above(-along[0], -along[1], -along[2], limit) || stays_above(across[0], across[1], across[2], limit) ||
           stays_above(-across[0], -across[1], -across[2], limit);
}

/* For all the time, c is farther along u than a. Ways are straight, so the ends tell. */
static int stays_beyond(const rg_vec2 *x, const rg_vec2 *y, const int32_t *a, const int32_t *c, rg_vec2 u)
{
    return fmax(rg_vec2_dot(u, x[a[0]]), rg_vec2_dot(u, x[a[1]])) < fmin(rg_vec2_dot(u, x[c[0]]),
                                                                         rg_vec2_dot(u, x[c[1]])) &&
           fmax(rg_vec2_dot(u, y[a[0]]), rg_vec2_dot(u, y[a[1]])) < fmin(rg_vec2_dot(u, y[c[0]]),
                                                                         rg_vec2_dot(u, y[c[1]]));
}

static int apart(const rg_plates *p, const rg_vec2 *x, const rg_vec2 *y, int32_t i, int32_t k)
{
    const int32_t *a = p->mesh->edge[p->border[i]], *c = p->mesh->edge[p->border[k]];
    const double limit = TOUCHES * p->size * p->size;
    if (a[0] == c[0] || a[0] == c[1] || a[1] == c[0] || a[1] == c[1]) return stays_spread(x, y, a, c, limit);
    const rg_vec2 middle = {x[c[0]].x + x[c[1]].x - x[a[0]].x - x[a[1]].x,
                            x[c[0]].y + x[c[1]].y - x[a[0]].y - x[a[1]].y};
    if (stays_beyond(x, y, a, c, middle) || stays_beyond(x, y, a, c, (rg_vec2){0, middle.y})) return 1;
    return lies_beside(x, y, a, c, limit) || lies_beside(x, y, c, a, limit);
}

/* Is the picture of the border simple for all the time from x to y? Sorted by where an edge begins, as it was last
 * time. */
static int is_simple(const rg_plates *p, const rg_vec2 *x, const rg_vec2 *y, rg_front_work *w)
{
    for (int32_t i = 0; i < p->borders; i++) {
        const int32_t *a = p->mesh->edge[p->border[i]];
        w->low[i] = least4(x[a[0]].x, x[a[1]].x, y[a[0]].x, y[a[1]].x);
        w->high[i] = -least4(-x[a[0]].x, -x[a[1]].x, -y[a[0]].x, -y[a[1]].x);
    }
    for (int32_t i = 1; i < p->borders; i++)
        for (int32_t k = i, moved = w->order[i]; k > 0 && w->low[w->order[k - 1]] > w->low[moved]; k--) {
            w->order[k] = w->order[k - 1];
            w->order[k - 1] = moved;
        }
    for (int32_t i = 0; i < p->borders; i++)
        for (int32_t k = i + 1; k < p->borders && w->low[w->order[k]] <= w->high[w->order[i]]; k++)
            if (!apart(p, x, y, w->order[i], w->order[k])) return 0;
    return 1;
}

/* ----------------------------------------------------------------------------------- all ---- */

int rg_front_shows(const rg_plates *p, const rg_vec3 *x, const rg_vec3 *normal, int32_t n, rg_front_work *w)
{
    rg_vec3 d, u, v;
    if (!find_direction(whole_front(p, x), normal, n, &d)) return 0;
    across(d, &u, &v);
    picture_of(p, x, u, v, 0, w->from);
    return is_simple(p, w->from, w->from, w);
}

/* The triangle a b c, from x to y, is never turned over. */
static int never_turns(const rg_vec2 *x, const rg_vec2 *y, int32_t a, int32_t b, int32_t c, double none)
{
    const rg_vec2 e = rg_vec2_sub(x[b], x[a]), f = rg_vec2_sub(x[c], x[a]), g = rg_vec2_sub(y[b], y[a]),
        h = rg_vec2_sub(y[c], y[a]);
    const double at_0 = rg_vec2_cross(e, f), at_1 = rg_vec2_cross(g, h),
        middle = (rg_vec2_cross(e, h) + rg_vec2_cross(g, f)) / 2;
    return stays_above(at_0, middle, at_1, none);
}

double rg_front_angle(const rg_mat3 *R, const rg_mat3 *S)
{
    double sum = 0; /* |R - S|^2 = 8 sin^2 (angle / 2) */
    for (int k = 0; k < 3; k++) {
        const rg_vec3 d = rg_vec3_sub(S->c[k], R->c[k]);
        sum += rg_vec3_dot(d, d);
    }
    return 2 * asin(fmin(1, sqrt(sum / 8)));
}

/* The direction of a state, `like` being that of the state before; NULL: none. */
static int direction_of(const rg_plates *p, const rg_plates_state *s, const rg_vec3 *like, rg_front_work *w, rg_vec3 *d)
{
    const int32_t nf = p->mesh->nf;
    for (int32_t f = 0; f < nf; f++) w->normal[f] = s->place[f].R.c[2];
    if (find_direction(whole_front(p, s->x), w->normal, nf, d)) return 1;
    if (!like) return 0;
    *d = *like;
    return within_plane(w->normal, nf, d);
}

/* With (u, v, d) turned to (q, r, e), how far a corner can be from its straight way while its facet turns about the
 * middle of its box: half of the box' diagonal times the height of the arc; and what a change of shape adds. */
static double off_straight(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to,
                           const rg_mat3 *view,
                           const rg_mat3 *later)
{
    const rg_mesh *m = p->mesh;
    double most = 0;
    for (int32_t f = 0; f < m->nf; f++) {
        rg_mat3 R, S;
        for (int k = 0; k < 3; k++) {
            const rg_vec3 r = from->place[f].R.c[k], s = to->place[f].R.c[k];
            R.c[k] = (rg_vec3){rg_vec3_dot(view->c[0], r), rg_vec3_dot(view->c[1], r), rg_vec3_dot(view->c[2], r)};
            S.c[k] = (rg_vec3){rg_vec3_dot(later->c[0], s), rg_vec3_dot(later->c[1], s), rg_vec3_dot(later->c[2], s)};
        }
        const double angle = rg_front_angle(&R, &S);
        rg_vec2 low = from->X[m->facet_vertex[m->facet_start[f]]], high = low;
        double change = 0; /* squared */
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const rg_vec2 c = from->X[m->facet_vertex[j]], e = rg_vec2_sub(to->X[m->facet_vertex[j]], c);
            low = (rg_vec2){c.x < low.x ? c.x : low.x, c.y < low.y ? c.y : low.y};
            high = (rg_vec2){c.x > high.x ? c.x : high.x, c.y > high.y ? c.y : high.y};
            change = rg_vec2_dot(e, e) > change ? rg_vec2_dot(e, e) : change;
        }
        const double arm = hypot(high.x - low.x, high.y - low.y) / 2,
            off = arm * angle * angle / 8 + sqrt(change) * angle / 2;
        if (!(off <= most)) most = off;
    }
    return most;
}

/* Where the sheet shows its front along straight ways, no surface that is off them by less than e crosses itself deeper
 * than 2 e: of two plates that cross by D, the differences of their points fill a ball of radius D; moved by up to 2 e
 * < D, they still cover its middle, by Brouwer's theorem. */
int rg_front_shows_moving(const rg_plates *p, const rg_plates_state *from, const rg_plates_state *to, double depth,
                          rg_front_work *w)
{
    const double none = NO_AREA * p->size * p->size;
    const rg_vec2 *X = p->mesh->X;
    rg_mat3 view, later;
    if (!direction_of(p, from, NULL, w, &view.c[2]) || !direction_of(p, to, &view.c[2], w, &later.c[2])) return 0;
    across(view.c[2], &view.c[0], &view.c[1]);
    turn_view(&view, &later);
    if (!(2 * off_straight(p, from, to, &view, &later) <= depth)) return 0;
    picture_of(p, from->x, view.c[0], view.c[1], 1, w->from);
    picture_of(p, to->x, later.c[0], later.c[1], 1, w->to);
    for (int32_t a = 0; a < p->parts; a++) {
        const int32_t *corner = p->vertex + p->start[a], corners = p->start[a + 1] - p->start[a];
        for (int32_t k = 1; k + 1 < corners; k++)
            if (rg_vec2_turn(X[corner[0]], X[corner[k]], X[corner[k + 1]]) > none &&
                !never_turns(w->from, w->to, corner[0], corner[k], corner[k + 1], none))
                return 0;
    }
    return is_simple(p, w->from, w->to, w);
}
