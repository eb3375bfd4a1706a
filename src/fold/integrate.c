#include "fold/integrate.h"
#include "base/lanes.h"
#include "fold/newton.h"
#include "fold/tuning.h"

#include <string.h>

/* t's in Adams's formula at the most, the new one among them. */
enum { ADAMS_NODES = 8 };

static double good_set_right(const rg_straight *f)
{
    return fmin(GOOD_SET_RIGHT * sqrt(f->settings.tol), MOST_SET_RIGHT);
}

double rg_integrate_tangent(rg_straight *f, const double *rho, double s, int near, double *t)
{
    const int32_t N = f->mesh.N;
    rg_cg_report rep;
    if (!near) {
        rg_constraint_assemble(&f->K, rho);
        f->assemblies++;
        rg_project_renew(&f->P);
    }
    rg_drive_wish(&f->drive, rho, s, f->wish);
    const int free = f->smooth && !f->one_way && N > 3 * f->mesh.M;
    /* the last answer may be of a frame, of which a node knows nothing */
    memset(f->P.y, 0, 3 * (size_t)f->mesh.M * sizeof *f->P.y);
    const double solved = free ? FREE_SOLVE_PART * good_set_right(f) : DIRECTION_SOLVED;
    if (rg_project_tangent(&f->P, &f->K, f->wish, t, solved, &rep) != RG_OK) return 0; /* eq. (9) */
    double along = rg_drive_progress(&f->drive, t);
    if (!(along > LEAST_EFFICIENCY)) return 0;
    for (int32_t i = 0; i < N; i++) t[i] /= along;
    return along;
}

/* ------------------------------------------------------------------------------------------- fixed order ---- */

/* k = t at rho + ds (part of `from`), once that is closed. */
static int stage(rg_straight *f, double ds, const double *from, double *k)
{
    for (int32_t i = 0; i < f->mesh.N; i++) f->trial[i] = f->rho[i] + ds * from[i];
    if (!rg_newton_correct(f, f->s + ds, CORRECTIONS)) return 0;
    return rg_integrate_tangent(f, f->trial, f->s + ds, 1, k) > 0;
}

int rg_integrate_heun(rg_straight *f, double ds)
{
    double *k2 = f->k[0];
    if (!stage(f, ds, f->t, k2)) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++) f->trial[i] = f->rho[i] + ds / 2 * (f->t[i] + k2[i]);
    return rg_newton_correct(f, f->s + ds, CORRECTIONS);
}

int rg_integrate_rk4(rg_straight *f, double ds)
{
    double *k2 = f->k[0], *k3 = f->k[1], *k4 = f->k[2];
    if (!stage(f, ds / 2, f->t, k2) || !stage(f, ds / 2, k2, k3) || !stage(f, ds, k3, k4)) return 0;
    for (int32_t i = 0; i < f->mesh.N; i++)
        f->trial[i] = f->rho[i] + ds / 6 * (f->t[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    return rg_newton_correct(f, f->s + ds, CORRECTIONS);
}

/* ---------------------------------------------------------------------------------------------- adaptive ---- */

/* The last nodes, as many as a window takes. */
static int32_t last_nodes(const rg_path *p, int32_t *first)
{
    int32_t n = p->count < RG_PATH_WINDOW ? p->count : RG_PATH_WINDOW;
    *first = p->count - n;
    return n;
}

/* The last nodes where t is known, `most` at the most. */
static int32_t adams_nodes(const rg_path *p, int32_t most, int32_t *first)
{
    *first = p->count;
    while (*first > 0 && p->node[*first - 1].has_t && p->count - *first < most) --*first;
    return p->count - *first;
}

/* out = rho at node `from` + the integral of t up to s, by the polynomial through n t's from `first` on. */
static void adams(const rg_path *p, int32_t first, int32_t n, int32_t from, double s, double *out)
{
    double w[RG_PATH_NODES];
    rg_path_integral(p, first, n, p->node[from].s, s, w);
    memcpy(out, p->node[from].rho, (size_t)p->N * sizeof *out);
    for (int32_t j = 0; j < n; j++) rg_lanes_add(p->N, w[j], p->node[first + j].t, out);
}

/* f->trial moves to where Adams and Moulton's formula leads from the last node, f->t being t at f->trial. Returns how
 * far the farthest crease moves; where it was is in f->k[0]. */
static double set_right(rg_straight *f, double s)
{
    rg_path *p = &f->path;
    double far = 0;
    int32_t first;
    memcpy(f->k[0], f->trial, (size_t)p->N * sizeof *f->trial);
    rg_path_insert(p, s, f->trial, f->t); /* for a moment */
    int32_t n = adams_nodes(p, f->order < ADAMS_NODES ? f->order + 1 : ADAMS_NODES, &first);
    adams(p, first, n, p->count - 2, s, f->trial);
    p->count--;
    for (int32_t i = 0; i < p->N; i++)
        if (!(fabs(f->trial[i] - f->k[0][i]) <= far)) far = fabs(f->trial[i] - f->k[0][i]);
    return far;
}

/* f->trial at s, beyond the last node. Where the sheet can go one way only, whatever is off is off across the path and
 * closing takes it away: the polynomial of the highest degree is best. Elsewhere what is off along the sheet's freedoms
 * would stay and be amplified, and Adams and Bashforth's formula is what does not do that. */
static void predict(rg_straight *f, double s)
{
    const rg_path *p = &f->path;
    int32_t first, n;
    if (f->one_way) {
        n = last_nodes(p, &first);
        rg_path_evaluate(p, first, n, s, f->trial, NULL);
    } else {
        n = adams_nodes(p, f->order, &first);
        adams(p, first, n, p->count - 1, s, f->trial);
    }
}

/* The order that would have predicted the last node best is taken for the next one: where a freedom of the sheet is
 * stiff the higher orders are the first to be unstable, and it shows in them. All orders are tried in one walk over the
 * creases. */
RG_WIDE static void choose_order(rg_straight *f)
{
    const rg_path *p = &f->path;
    const int32_t last = p->count - 1;
    const double *from = p->node[last - 1].rho, *now = p->node[last].rho, *t[ADAMS_NODES];
    double weight[ADAMS_NODES][ADAMS_NODES], least = INFINITY;
    rg_quad off[ADAMS_NODES] = {{0}};
    int32_t orders = 0;
    for (; orders < ADAMS_NODES && orders < last && p->node[last - 1 - orders].has_t; orders++) {
        t[orders] = p->node[last - 1 - orders].t;
        rg_path_integral(p, last - 1 - orders, orders + 1, p->node[last - 1].s, p->node[last].s, weight[orders]);
    }
    for (int32_t i = 0; i < p->N; i += 4) {
        const rg_quad way = *(const rg_quad_anywhere *)(now + i) - *(const rg_quad_anywhere *)(from + i);
        rg_quad u[ADAMS_NODES];
        for (int32_t k = 0; k < orders; k++) {
            rg_quad e = -way;
            u[k] = *(const rg_quad_anywhere *)(t[k] + i);
            for (int32_t j = 0; j <= k; j++) e += weight[k][k - j] * u[j];
            off[k] += e * e;
        }
    }
    for (int32_t k = 0; k < orders; k++) {
        const double e = (off[k][0] + off[k][1]) + (off[k][2] + off[k][3]);
        if (e < least) least = e, f->order = k + 1;
    }
}

/* What the error of a prediction at s is proportional to. */
static double reach(const rg_straight *f, double s)
{
    const rg_path *p = &f->path;
    int32_t first, n;
    if (f->one_way) {
        n = last_nodes(p, &first);
        return rg_path_reach(p, first, n, s, 2);
    }
    n = adams_nodes(p, f->order, &first);
    return (s - p->node[p->count - 1].s) * rg_path_reach(p, first, n, s, 1);
}

static double close_enough(const rg_straight *f)
{
    return fmax(f->settings.tol * (f->one_way || !f->smooth ? READ_OFF_MARGIN_ONE_WAY : READ_OFF_MARGIN), ROUNDING);
}

/* How much longer a step may be if it makes an error of e, may make one of `most`, and is of that order. */
static double scale(double e, double most, int order)
{
    return pow(most / fmax(e, 1e-3 * most), 1.0 / order);
}

/* The next step. h: the one just made, `rate`: error of closure of its prediction over its reach, far: see
 * set_right. */
static double next_step(rg_straight *f, double h, double rate, double far)
{
    const rg_path *p = &f->path;
    const double last = p->node[p->count - 1].s, goal = STEP_MARGIN * close_enough(f);
    double longest = LARGEST_GROWTH * h, spacing = f->s_end / GRID;
    if (f->one_way && p->count > RG_PATH_WINDOW) {
        /* Of twelve conditions at even distance, half way between the middle two: (1/2 3/2 5/2)^4 = 12.36. */
        longest = fmin(longest, pow(goal / (12.36 * fmax(rate, 1e-300)), 1.0 / 12));
    } else if (!f->one_way && p->count <= RG_PATH_WINDOW) {
        longest = fmin(longest, spacing);
    } else if (p->count > RG_PATH_WINDOW) {
        double between = p->node[p->count - 3].s - p->node[p->count - 4].s;
        const double middle = p->node[p->count - 4].s + between / 2;
        rg_path_evaluate(p, p->count - RG_PATH_WINDOW, RG_PATH_WINDOW, middle, f->k[0], NULL);
        between *= scale(rg_constraint_closure(&f->K, f->k[0], NULL), goal, 12);
        longest = fmin(longest, between < 1.5 * spacing ? spacing : between);
    }
    if (!f->one_way) longest = fmin(longest, h * scale(far, good_set_right(f), f->order + 1));
    double x = longest;
    while (x > LARGEST_CUT * h && rate * reach(f, last + x) > GOOD_PREDICTION) x *= 0.95;
    return fmax(x, LARGEST_CUT * h);
}

static int land(rg_straight *f)
{
    for (int32_t i = 0; i < f->mesh.N; i++)
        if (!(fabs(f->trial[i] - f->end[i]) <= LANDING)) return 0;
    rg_path_insert(&f->path, 1, f->end, NULL);
    return 1;
}

/* With more creases than equations t is known beside the path as well as on it, and a good prediction need not be
 * closed to ask for it there. */
static int make_node_at_once(rg_straight *f, double s, double *far)
{
    if (!(rg_integrate_tangent(f, f->trial, s, 0, f->t) > 0)) return 0;
    *far = f->moved = set_right(f, s);
    return *far <= FARTHEST_SET_RIGHT * good_set_right(f) && rg_newton_close(f, s, CORRECTIONS, 1, f->t);
}

/* A node at s from the prediction in f->trial, which closes to `error`. far: see set_right. Non-zero: it is made, in
 * f->trial and f->t. */
static int make_node(rg_straight *f, double s, double error, double *far)
{
    const int32_t N = f->mesh.N;
    if (!f->one_way && N > 3 * f->mesh.M && error <= GOOD_PREDICTION && f->path.count >= RG_PATH_WINDOW)
        return make_node_at_once(f, s, far) && !(rg_limit_pull(&f->limit, f->trial, f->pull) > 0);
    if (!rg_newton_close(f, s, CORRECTIONS, 0, NULL)) return 0;
    if (!(rg_integrate_tangent(f, f->trial, s, 1, f->t) > 0)) return 0;
    *far = 0;
    if (!f->one_way || f->path.count < RG_PATH_WINDOW || f->nodes % ASK_AGAIN == 0) {
        *far = set_right(f, s);
        f->moved += *far;
        if (!(*far <= FARTHEST_SET_RIGHT * good_set_right(f))) return 0;
        if (*far > SET_RIGHT_FROM) {
            if (!rg_newton_close(f, s, CORRECTIONS, 1, NULL)) return 0;
            double moved = 0;
            for (int32_t i = 0; i < N; i++) moved = fmax(moved, fabs(f->trial[i] - f->k[0][i]));
            f->one_way = moved <= ONE_WAY * *far;
            if (moved > SAME_DIRECTION && !(rg_integrate_tangent(f, f->trial, s, 1, f->t) > 0)) return 0;
        }
    }
    return !(rg_limit_pull(&f->limit, f->trial, f->pull) > 0);
}

/* Where the next node is put for a step of h: the end if that is near, the last place of the grid that is within
 * reach. */
static double snap(const rg_straight *f, double from, double h)
{
    if (from + 1.2 * h >= f->s_end) return f->s_end;
    double s = f->s_end * (int32_t)((from + 1.3 * h) / f->s_end * GRID) / GRID;
    return !f->one_way && s - from >= 0.4 * h ? s : from + h;
}

int rg_integrate_advance(rg_straight *f)
{
    rg_path *p = &f->path;
    const double from = p->node[p->count - 1].s;
    for (double h = f->h;; h /= 2) {
        if (!(h > SHORTEST)) return 0;
        double s = snap(f, from, h), far;
        h = s - from;
        predict(f, s);
        if (s >= 1) {
            if (f->end_is_closed && land(f)) return 1;
            continue; /* the wish has no direction at the end itself */
        }
        double error = rg_constraint_closure(&f->K, f->trial, NULL), rate = error / reach(f, s);
        if (!(error <= POOR_PREDICTION) || !make_node(f, s, error, &far)) continue;
        rg_path_insert(p, s, f->trial, f->t);
        f->nodes++;
        if (!f->one_way) choose_order(f);
        f->h = next_step(f, h, rate, far);
        return 1;
    }
}

/* The state at s by the polynomial through n nodes, closed. */
static int read_through(rg_straight *f, int32_t first, int32_t n, double s)
{
    const rg_path *p = &f->path;
    const int is_euler = f->settings.method == RG_METHOD_EULER;
    rg_path_evaluate(p, first, n, s, f->trial, f->t);
    /* so near flat what closes is homogeneous: a ray */
    if (!is_euler && p->count > 1 && p->node[0].s == 0 && s < p->node[1].s)
        for (int32_t i = 0; i < p->N; i++) {
            f->t[i] = p->node[1].rho[i] / p->node[1].s;
            f->trial[i] = s * f->t[i];
        }
    f->closure = rg_constraint_closure(&f->K, f->trial, NULL);
    if (is_euler || f->closure <= close_enough(f)) return 1;
    const int free = f->smooth && !f->one_way && f->mesh.N > 3 * f->mesh.M && p->node[first].has_t;
    if (free && rg_newton_close(f, s, 1, 0, f->t)) return 1;
    return rg_newton_close(f, s, CORRECTIONS, 0, NULL);
}

/* Is f->trial between the nodes on either side of s, as far as a smooth way strays from its chord? */
static int is_between(const rg_straight *f, double s)
{
    int32_t first, n;
    rg_path_around(&f->path, s, &first, &n);
    if (n < 2) return 1;
    const rg_node *a = &f->path.node[first], *b = a + 1;
    const double part = (s - a->s) / (b->s - a->s);
    double off = 0, size = 0;
    for (int32_t i = 0; i < f->path.N; i++) {
        const double way = b->rho[i] - a->rho[i], d = fabs(f->trial[i] - a->rho[i] - part * way);
        if (!(d <= off)) off = d;
        if (fabs(way) > size) size = fabs(way);
    }
    return off <= FARTHEST_CORRECTION * size + LITTLE;
}

int rg_integrate_read_off(rg_straight *f, double s)
{
    int32_t first, n;
    if (f->smooth) {
        rg_path_window(&f->path, s, &first, &n);
        if (read_through(f, first, n, s) && is_between(f, s)) return 1;
    }
    /* Where nodes lie unevenly, as before a place that steps cannot pass, a polynomial through many is led astray. */
    rg_path_around(&f->path, s, &first, &n);
    return read_through(f, first, n, s) && (f->settings.method == RG_METHOD_EULER || is_between(f, s));
}
