#include "unfold/unfold.h"
#include "unfold/landing.h"
#include "unfold/open.h"
#include "unfold/seen.h"

#include <stdio.h>
#include <string.h>

/* A try: how the end is opened, and which rows it has. They fail on different patterns; the first frees most. */
typedef struct try_ {
    rg_open_way open;
    rg_end_rules rules;
} try_;

static const try_ TRIES[] = {
    /* part  give hard  margin scaled grow repair    round corners keep apart */
    {{0.03, 0.2, 1e-9, 1e-4, 0, 0, 6}, {0, 0, 0, 0}},
    {{0.2, 0.2, 1e-9, 0, 1, 1, 0}, {1, 1, 1, 1}},
    {{0.06, 0.2, 1e-9, 0, 1, 1, 0}, {1, 1, 1, 1}},
    {{0.1, 0.2, 1e-9, 0, 1, 1, 0}, {0, 0, 0, 0}},
    {{0.03, 0.2, 1e-8, 0, 0, 0, 0}, {1, 1, 0, 1}},
    {{0.03, 0.2, 1e-9, 1e-4, 1, 1, 0}, {0, 0, 0, 0}},
    {{0.03, 0.2, 1e-6, 1e-4, 0, 0, 6}, {0, 0, 0, 0}},
};
/* An opened state whose layers are farther on the wrong side is not one (lengths of the sheet): less than what counts as a crossing. */
static const double WRONG = 8e-5;
static const double CLOSED = 1e-9, LEAST_AREA = 0.1;
static const double OVER = 1e-4; /* radians: what rounding and closing may put a crease past half a turn, as in stride.c */
/* Between two states so many places are looked at, less one, that the way between two of them is straight to BENT (lengths of the sheet). */
enum { LEAST_BETWEEN = 4, MOST_BETWEEN = 40 };
static const double BENT = 2e-5;
/* From this progress on the order of layers is to be seen, where it is. */
static const double NEAR_THE_END = 0.98;
/* So far the end's pattern may be from the one drawn, lengths of the sheet, and so much it may be open, radians. */
static const double END_MOVES = 1e-2, END_CLOSES = 1e-8;
/* Closing a state that is read off. */
static const double READ_CLOSED = 1e-13, NEAR_DUE = 1e-6;
static const int READ_NEWTON = 12, SECANTS = 8;
/* Going home: from where creases are unfolded by this part, in the mean; less is next to flat; and steps, in radians. */
static const double NEARLY_HOME = 0.9, NEXT_TO_FLAT = 2 * RG_DEG, HOME_STEP = 6 * RG_DEG, HOME_CLOSED = 1e-11;
/* Radians: a sheet whose creases are all folded by less lies all but flat, its facets side by side. */
static const double LIES_NEARLY = 20 * RG_DEG;
/* What is tried, one after the other: a way of opening, and the number of an order; way -1: forwards. Another order does more than
 * another way. */
typedef struct step_of_plan { int way; int32_t order; } step_of_plan;
static const step_of_plan PLAN[] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {-1, 0}, {2, 0}, {3, 0}, {4, 0}, {0, 2}, {1, 2}, {2, 1}, {3, 1},
                                    {5, 0}, {0, 3}, {1, 3}, {2, 2}, {4, 1}, {5, 1}, {6, 0}, {0, 4}, {1, 4}, {0, 5}, {1, 5}, {0, 6}, {1, 6},
                                    {0, 7}, {1, 7}, {0, 8}, {1, 8}, {0, 9}, {1, 9}, {0, 10}, {1, 10}, {0, 11}, {1, 11}};
/* States that are looked at for an order, and the rows by which it is landed in: all first. */
enum { SEEN = 12, LANDINGS = 2 };
static const rg_end_rules LANDING[LANDINGS] = {{1, 1, 1, 1}, {0, 0, 0, 0}};
enum { PLAN_COUNT = sizeof PLAN / sizeof *PLAN };
/* Folding forwards leaves flat with creases folded by this part. */
static const int OFF_FLAT_ITERATIONS = 60;
static const double OFF_FLAT = 0.03, OFF_FLAT_LARGEST = 0.35;
/* No try may cost more than this part of what is left. */
static const double PART_OF_BUDGET = 0.4;

void rg_unfold_free(rg_unfold *u)
{
    if (!u->mem.resize) return;
    rg_linkage_free(&u->P);
    rg_nearest_free(&u->q);
    rg_contact_work_free(&u->look);
    rg_plates_free(&u->plates);
    rg_mesh_free(&u->mesh);
    rg_layers_destroy(u->layers);
    void *block[] = {u->z, u->progress, u->end, u->scratch, u->which, u->x};
    for (int i = 0; i < 6; i++) rg_mem_free(&u->mem, block[i]);
    memset(u, 0, sizeof *u);
}

/* ---- the flat end */

static int lies_over(void *ctx, int32_t f, int32_t g)
{
    const rg_unfold *u = ctx;
    const rg_flat *flat = &u->layers->flat;
    /* Positions are seen with the front of the linkage's first facet up, layers with that of flat.root. */
    const int turned = flat->up[flat->facet_of[u->P.tree.order[0]]];
    return -turned * rg_layers_above(u->layers, flat->facet_of[f], flat->facet_of[g]);
}

/* Drawings are rounded: the pattern nearest to the one drawn on which the flat end closes. Where there is none as near as END_MOVES it
 * stays as drawn. A vertex at which many creases meet at half a turn comes to END_CLOSES only. */
static void close_end(rg_unfold *u)
{
    const int32_t N = u->P.N;
    double *move = u->end + N, *best = u->scratch, least = INFINITY, most = 0;
    memset(move, 0, (size_t)u->P.U * sizeof *move);
    rg_stride_scale(&u->P, 1, u->q.scale);
    memset(u->q.scale, 0, (size_t)N * sizeof *u->q.scale);
    for (int k = 0; k < READ_NEWTON && least > READ_CLOSED; k++) {
        rg_stride_close(&u->P, &u->q, u->end, READ_CLOSED, 1);
        const double angle = rg_coupled_assemble(&u->P.J, u->end, move, NULL);
        if (!(angle < least)) continue;
        least = angle;
        memcpy(best, move, (size_t)u->P.U * sizeof *move);
    }
    for (int32_t i = 0; least <= END_CLOSES && i < u->P.U; i++) most = fmax(most, fabs(best[i]));
    const int use = least <= END_CLOSES && most <= END_MOVES;
    for (int32_t i = 0; i < u->P.U; i++) move[i] = use ? best[i] : 0;
    memset(u->scratch, 0, (size_t)u->P.n * sizeof *u->scratch);
}

/* Fold angles at the end: what is aimed at, and what a crease without target folds to there. */
static void find_end(rg_unfold *u)
{
    const rg_flat *flat = &u->layers->flat;
    for (int32_t i = 0; i < u->P.N; i++) {
        const int32_t e = u->mesh.crease_edge[i];
        int turn = flat->turn[e];
        if (turn == 2) turn = -flat->up[flat->beside[e][1]] * rg_layers_above(u->layers, flat->beside[e][0], flat->beside[e][1]);
        u->end[i] = turn * RG_PI;
    }
    close_end(u);
}

static rg_status find_layers(rg_unfold *u, double sign)
{
    rg_diag why;
    for (int32_t i = 0; i < u->P.N; i++) {
        const double target = u->mesh.target[u->mesh.crease_edge[i]];
        u->end[i] = i < u->P.N - u->mesh.added ? sign * target : 0;
    }
    const rg_status s = rg_layers_of_mesh(&u->mesh, u->end, 0, &u->mem, NULL, &u->layers, &why);
    if (s == RG_EFORMAT || s == RG_ESHEET) return RG_OK;
    if (s != RG_OK) return s;
    u->which = rg_mem_array(&u->mem, (size_t)u->layers->parts.count + 1, sizeof *u->which);
    return u->which ? RG_OK : RG_ENOMEM;
}

/* The n-th order to be tried. Zero: there are no more. */
static int number_order(rg_unfold *u, const rg_unfold_wish *wish, int32_t n)
{
    const rg_parts *q = &u->layers->parts;
    if (wish->order >= 0) return n == 0 && rg_layers_which(u->layers, (uint64_t)wish->order, u->which) == RG_OK;
    memset(u->which, 0, (size_t)q->count * sizeof *u->which);
    if (n == 0) return 1;
    for (int32_t i = 0; i < q->count; i++)
        if (q->orders[i] > 1 && --n == 0) {
            u->which[i] = 1;
            return 1;
        }
    /* Then, by their numbers, some that differ in more. */
    return rg_layers_which(u->layers, (uint64_t)q->count + (uint64_t)n, u->which) == RG_OK;
}

/* ---- the path */

static double progress_of(const rg_unfold *u, const double *z)
{
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < u->P.N - u->mesh.added; i++) {
        const double target = u->mesh.target[u->mesh.crease_edge[i]];
        if (isnan(target) || target == 0) continue;
        sum += z[i] / u->end[i];
        n++;
    }
    return n ? sum / n : 1;
}

static rg_status keep(void *ctx, const double *z)
{
    rg_unfold *u = ctx;
    const size_t n = (size_t)u->P.n, at = (size_t)u->count;
    rg_status s = rg_mem_grow(&u->mem, (void **)&u->z, &u->z_room, (at + 1) * n, sizeof *z);
    if (s == RG_OK) s = rg_mem_grow(&u->mem, (void **)&u->progress, &u->progress_room, at + 1, sizeof *z);
    if (s != RG_OK) return s;
    memcpy(u->z + at * n, z, n * sizeof *z);
    u->progress[at] = progress_of(u, z);
    u->count++;
    return RG_OK;
}

/* States from `first` on, the other way round. */
static void turn_round(rg_unfold *u, int32_t first)
{
    const size_t n = (size_t)u->P.n;
    for (int32_t i = first, j = u->count - 1; i < j; i++, j--) {
        const double was = u->progress[i];
        u->progress[i] = u->progress[j];
        u->progress[j] = was;
        memcpy(u->scratch, u->z + (size_t)i * n, n * sizeof *u->z);
        memcpy(u->z + (size_t)i * n, u->z + (size_t)j * n, n * sizeof *u->z);
        memcpy(u->z + (size_t)j * n, u->scratch, n * sizeof *u->z);
    }
}

/* Facets cross in the state whose positions are x. */
static int crosses(rg_unfold *u, const rg_vec3 *x)
{
    rg_contact_hit hit;
    return rg_contact_deepest(&u->plates, x, WRONG, &u->look, &hit);
}

static void between(rg_unfold *u, int32_t k, double t);

/* Parts of the way from state k to the next, so many that each is all but straight: how far off the chord's middle its middle is
 * goes with the square. */
static int parts_between(rg_unfold *u, int32_t k)
{
    const size_t n = (size_t)u->P.n;
    const int32_t nv = u->mesh.nv;
    double most = 0;
    rg_linkage_positions(&u->P, u->z + (size_t)k * n, u->x);
    rg_linkage_positions(&u->P, u->z + (size_t)(k + 1) * n, u->x + nv);
    between(u, k, 0.5);
    rg_linkage_put(&u->P, u->scratch);
    for (int32_t v = 0; v < nv; v++) {
        const rg_vec3 middle = rg_vec3_scale(0.5, rg_vec3_add(u->x[v], u->x[nv + v]));
        most = fmax(most, rg_vec3_length(rg_vec3_sub(u->P.p[v], middle)));
    }
    return (int)fmin(MOST_BETWEEN, fmax(LEAST_BETWEEN, ceil(sqrt(most / BENT))));
}

/* Between any two states, where frames may be. */
static int crosses_between(rg_unfold *u)
{
    rg_stride_scale(&u->P, 1, u->q.scale);
    for (int32_t k = 0; k + 1 < u->count; k++) {
        const int parts = parts_between(u, k);
        for (int part = 1; part < parts; part++) {
            between(u, k, (double)part / parts);
            rg_linkage_put(&u->P, u->scratch);
            if (crosses(u, u->P.p)) return 1;
        }
    }
    return 0;
}

/* In some state near the end layers are not in its order. */
static int is_upset(rg_unfold *u, const rg_end *end)
{
    for (int32_t k = 0; k + 1 < u->count; k++) {
        if (u->progress[k] < NEAR_THE_END) continue;
        rg_linkage_put(&u->P, u->z + (size_t)k * (size_t)u->P.n);
        if (rg_end_is_upset(end, &u->P)) return 1;
    }
    return 0;
}

/* ---- one try */

static int is_stopped(const rg_unfold_wish *wish, double done) { return wish->stop && wish->stop(wish->ctx, done); }

/* From near flat on nothing can be met: half of it, and flat. */
static rg_status finish(rg_unfold *u, const double *z)
{
    rg_stride_scale(&u->P, 1, u->q.scale);
    for (int32_t i = 0; i < u->P.n; i++) u->scratch[i] = z[i] / 2;
    rg_status s = rg_stride_close(&u->P, &u->q, u->scratch, READ_CLOSED, READ_NEWTON) ? keep(u, u->scratch) : RG_OK;
    memset(u->scratch, 0, (size_t)u->P.n * sizeof *u->scratch);
    return s == RG_OK ? keep(u, u->scratch) : s;
}

/* The crease that meets crease i at a corner v where no other that is still folded does; -1: it is none, or there are more. */
static int32_t goes_on_as(const rg_unfold *u, const double *z, int32_t i, int32_t v)
{
    int32_t found = -1;
    for (int32_t k = 0; k < u->P.N; k++) {
        const int32_t *ends = u->mesh.edge[u->mesh.crease_edge[k]];
        if (k == i || z[k] == 0 || (ends[0] != v && ends[1] != v)) continue;
        if (found >= 0) return -1;
        found = k;
    }
    return found;
}

/* Creases that are next to flat are flat, of the pattern as given; what is left of straight folds is folded evenly. Returns how
 * far the most of them is. */
static double tidy(const rg_unfold *u, const double *z, double *out)
{
    const int32_t N = u->P.N;
    double most = 0;
    memset(out, 0, (size_t)u->P.n * sizeof *out);
    for (int32_t i = 0; i < N; i++) out[i] = fabs(z[i]) < NEXT_TO_FLAT ? 0 : z[i];
    for (int32_t i = 0; i < N; i++) {
        if (out[i] == 0) continue;
        for (int end = 0; end < 2; end++) {
            const int32_t k = goes_on_as(u, out, i, u->mesh.edge[u->mesh.crease_edge[i]][end]);
            if (k >= 0 && fabs(out[k] - out[i]) < NEXT_TO_FLAT && k > i) out[k] = out[i];
        }
        most = fmax(most, fabs(out[i]));
    }
    return most;
}

/* Where all but some creases are flat, closure is all but singular, and steps fail: creases that are next to flat are made so, and
 * the rest goes home straight, as long as it closes and nothing crosses. *home: out. */
static rg_status go_home(rg_unfold *u, const double *z, int *home)
{
    const int32_t n = u->P.n;
    double *from = rg_mem_array(&u->mem, (size_t)n, sizeof *from);
    if (!from) return RG_ENOMEM;
    rg_stride_scale(&u->P, 1, u->q.scale);
    const int steps = (int)ceil(tidy(u, z, from) / HOME_STEP);
    rg_status s = RG_OK;
    *home = 1;
    for (int k = 0; s == RG_OK && *home && k < steps; k++) {
        const double left = 1 - (double)k / steps;
        for (int32_t i = 0; i < n; i++) u->scratch[i] = left * from[i];
        *home = rg_stride_close(&u->P, &u->q, u->scratch, HOME_CLOSED, READ_NEWTON);
        for (int32_t i = 0; i < u->P.N; i++) *home &= fabs(u->scratch[i] - left * from[i]) < NEXT_TO_FLAT;
        if (!*home) break;
        rg_linkage_put(&u->P, u->scratch);
        *home = !crosses(u, u->P.p);
        if (*home) s = keep(u, u->scratch);
    }
    rg_mem_free(&u->mem, from);
    memset(u->scratch, 0, (size_t)n * sizeof *u->scratch);
    return s == RG_OK && *home ? keep(u, u->scratch) : s;
}

/* Another way home: flat, any pattern closes, and what the pattern gave by holds it back. All creases go home straight, as it is now;
 * once the sheet lies flat its creases are those of the drawing. */
static rg_status lie_down(rg_unfold *u, const double *z, int *home)
{
    const int32_t N = u->P.N, n = u->P.n, first = u->count;
    double most = 0;
    for (int32_t i = 0; i < N; i++) most = fmax(most, fabs(z[i]));
    rg_stride_scale(&u->P, 1, u->q.scale);
    const int steps = (int)ceil(most / HOME_STEP);
    rg_status s = RG_OK;
    *home = most < LIES_NEARLY;
    for (int k = 1; s == RG_OK && *home && k < steps; k++) {
        const double left = 1 - (double)k / steps;
        for (int32_t i = 0; i < n; i++) u->scratch[i] = i < N ? left * z[i] : z[i];
        *home = rg_stride_close(&u->P, &u->q, u->scratch, HOME_CLOSED, READ_NEWTON);
        for (int32_t i = 0; i < N; i++) *home &= fabs(u->scratch[i] - left * z[i]) < NEXT_TO_FLAT;
        *home = *home && rg_linkage_least_area(&u->P, u->scratch + N) >= LEAST_AREA / 2;
        if (!*home) break;
        rg_linkage_put(&u->P, u->scratch);
        *home = !crosses(u, u->P.p);
        if (*home) s = keep(u, u->scratch);
    }
    if (s != RG_OK || !*home) {
        u->count = first;
        return s;
    }
    for (int32_t i = 0; i < n; i++) u->scratch[i] = i < N ? 0 : z[i];
    s = keep(u, u->scratch);
    memset(u->scratch, 0, (size_t)n * sizeof *u->scratch);
    return s == RG_OK ? keep(u, u->scratch) : s;
}

/* What ends it: the budget, also within one long solve, and who watches. */
static void watch(rg_stride *s, double budget, const rg_unfold_wish *wish)
{
    s->budget = budget;
    s->q.q.most_work = s->q.q.work + fmax(budget, 1);
    s->q.q.stop = wish->stop;
    s->q.q.ctx = wish->ctx;
}

/* The order of layers that the states up to now show, as far as there is one. */
static rg_status choose_as_seen(rg_unfold *u)
{
    const int32_t N = u->P.N, count = u->count < SEEN ? u->count : SEEN;
    const size_t nv = (size_t)u->mesh.nv;
    rg_tree tree = {0};
    double *wish = rg_mem_array(&u->mem, (size_t)u->layers->pairs.count, sizeof *wish);
    double *rho = rg_mem_array(&u->mem, ((size_t)count + 1) * (size_t)N, sizeof *rho);
    rg_vec2 *X = rg_mem_array(&u->mem, ((size_t)count + 1) * nv, sizeof *X);
    rg_status s = wish && rho && X ? rg_tree_init(&u->mesh, -1, &tree) : RG_ENOMEM;
    if (s == RG_OK) {
        for (int32_t k = 0; k < count; k++) {
            const double *z = u->z + (size_t)(u->count - count + k) * (size_t)u->P.n;
            memcpy(rho + (size_t)k * (size_t)N, z, (size_t)N * sizeof *rho);
            rg_freedom_move(&u->P.freedom, z + N, X + (size_t)k * nv);
        }
        memcpy(rho + (size_t)count * (size_t)N, u->end, (size_t)N * sizeof *rho);
        memcpy(X + (size_t)count * nv, u->mesh.X, nv * sizeof *X);
        const rg_seen_frames seen = {&u->mesh, &tree, rho, X, count + 1};
        s = rg_seen_order(u->layers, &seen, wish);
    }
    if (s == RG_OK) s = rg_layers_choose_near(u->layers, wish);
    if (s == RG_OK) find_end(u);
    if (tree.mem.resize) rg_tree_free(&tree);
    rg_mem_free(&u->mem, wish);
    rg_mem_free(&u->mem, rho);
    rg_mem_free(&u->mem, X);
    return s;
}

/* From where it was opened back towards the end, state by state, and the end. */
static rg_status land(rg_unfold *u, const rg_end *end, const double *z, const double *target, double budget, const rg_unfold_wish *wish)
{
    rg_stride s;
    double left = 1;
    rg_status status = rg_stride_init(&s, &u->mem, &u->P, &end->sides, end, z, target);
    watch(&s, budget, wish);
    s.crossed = &u->crossed;
    if (status == RG_OK) status = rg_landing_run(&s, end->z, keep, u, &left);
    u->work += s.work + s.q.work + s.q.q.work;
    rg_stride_free(&s);
    if (status != RG_OK) return status;
    u->landed = u->progress[u->count - 1];
    return keep(u, end->z);
}

/* Layers may come in another order than was begun from, or without one: then the end is the one that the states show. What leads there
 * from state `at` on is found anew. */
static rg_status land_as_seen(rg_unfold *u, int32_t at, double budget, const rg_unfold_wish *wish, int *through)
{
    const size_t n = (size_t)u->P.n;
    double *z = rg_mem_array(&u->mem, n, sizeof *z), *target = rg_mem_array(&u->mem, n, sizeof *target);
    rg_status s = z && target ? RG_OK : RG_ENOMEM;
    *through = 0;
    if (s == RG_OK) {
        u->count = at + 1;
        memcpy(z, u->z + (size_t)at * n, n * sizeof *z);
        u->opened = u->progress[at];
        s = choose_as_seen(u);
        for (int32_t i = 0; i < u->P.N; i++) target[i] = u->end[i] == 0 ? NAN : 0;
    }
    for (int k = 0; s == RG_OK && !*through && k < LANDINGS; k++) {
        rg_end end = {0};
        u->count = at + 1;
        s = rg_end_init(&end, &u->mem, &u->P, u->end, &LANDING[k], lies_over, u);
        rg_linkage_put(&u->P, z);
        const int upset = s == RG_OK && u->progress[at] > NEAR_THE_END && rg_end_is_upset(&end, &u->P);
        if (s == RG_OK && !upset) s = land(u, &end, z, target, budget / LANDINGS, wish);
        if (s == RG_OK && !upset) *through = !is_upset(u, &end) && !crosses_between(u);
        rg_end_free(&end);
    }
    rg_mem_free(&u->mem, z);
    rg_mem_free(&u->mem, target);
    return s;
}

/* Unfolds z: the path from flat to the end. Where z was opened slowly, the way there is kept already, from the end on. */
static rg_status walk(rg_unfold *u, const rg_end *end, const double *z, const double *target, double budget, int slowly,
                      const rg_unfold_wish *wish, int *through)
{
    rg_stride s;
    *through = 0;
    if (!slowly) u->count = 0;
    rg_status status = rg_stride_init(&s, &u->mem, &u->P, &end->sides, end, z, target);
    watch(&s, budget, wish);
    s.crossed = &u->crossed;
    if (status == RG_OK && u->count < 2) status = keep(u, z);
    u->opened = progress_of(u, z);
    if (status == RG_OK && slowly) u->landed = u->progress[1];
    const int32_t opening = u->count - 1;
    int right = status == RG_OK && !crosses(u, u->P.p);
    while (status == RG_OK && right && s.state == RG_STRIDE_GOES && !is_stopped(wish, s.mean)) {
        const int32_t steps = s.steps;
        status = rg_stride_take(&s);
        if (status != RG_OK || s.steps == steps) continue;
        if (crosses(u, u->P.p)) break; /* the sides of layers that lay on each other did not tell */
        status = keep(u, s.z);
    }
    u->steps += s.steps;
    for (int i = 0; i < RG_REFUSALS; i++) u->refused += s.refused[i];
    *through = status == RG_OK && s.state == RG_STRIDE_ARRIVED;
    if (*through) status = finish(u, s.z);
    else if (status == RG_OK && s.state != RG_STRIDE_GOES && s.mean > NEARLY_HOME) {
        const int32_t count = u->count;
        status = go_home(u, s.z, through);
        if (status == RG_OK && !*through) {
            u->count = count;
            status = lie_down(u, s.z, through);
        }
    }
    const double spent = s.work + s.q.work + s.q.q.work;
    u->work += spent;
    rg_stride_free(&s);
    if (!*through || status != RG_OK) return status;
    turn_round(u, 0);
    const int32_t walked = u->count;
    if (!slowly) status = land(u, end, z, target, budget - spent, wish);
    if (status == RG_OK) *through = !is_upset(u, end) && !crosses_between(u);
    if (status == RG_OK && !*through && wish->order < 0) {
        const int32_t at = slowly ? u->count - 1 - opening : walked - 1;
        status = land_as_seen(u, at, budget - spent, wish, through);
        u->as_seen = *through;
    }
    return status;
}

/* The second way: from flat, without an order. */
static rg_status forwards(rg_unfold *u, double budget, const rg_unfold_wish *wish, int *through)
{
    const int32_t N = u->P.N, n = u->P.n;
    rg_stride s = {0};
    double *z = rg_mem_array(&u->mem, (size_t)n, sizeof *z), *target = rg_mem_array(&u->mem, (size_t)n, sizeof *target);
    rg_status status = z && target ? RG_OK : RG_ENOMEM;
    *through = 0;
    u->count = 0;
    u->tries++;
    if (status == RG_OK) {
        find_end(u);
        status = keep(u, z);
        rg_stride_scale(&u->P, 1, u->q.scale);
        for (int32_t i = 0; i < N; i++) target[i] = u->end[i] == 0 ? NAN : u->end[i];
    }
    /* Off flat: the closed state nearest to all creases a little folded. */
    for (int k = 0; status == RG_OK && k < OFF_FLAT_ITERATIONS; k++) {
        double most = 0;
        rg_coupled_assemble(&u->P.J, z, z + N, NULL);
        rg_coupled_renew(&u->P.J, u->q.scale);
        rg_linkage_put(&u->P, z);
        for (int32_t i = 0; i < n; i++) u->q.wish[i] = (i < N ? OFF_FLAT * u->end[i] : 0) - z[i];
        rg_nearest_project(&u->q, u->q.wish, u->P.J.r);
        for (int32_t i = 0; i < N; i++) most = fmax(most, fabs(u->q.dz[i]));
        for (int32_t i = 0; i < n; i++) z[i] += fmin(1, OFF_FLAT_LARGEST / fmax(most, 1e-12)) * u->q.dz[i];
        if (most < 1e-8) break;
    }
    if (status == RG_OK && rg_stride_close(&u->P, &u->q, z, 1e-11, READ_NEWTON)) {
        status = rg_stride_init(&s, &u->mem, &u->P, NULL, NULL, z, target);
        if (status == RG_OK) status = keep(u, z);
        watch(&s, budget, wish);
    s.crossed = &u->crossed;
        while (status == RG_OK && s.state == RG_STRIDE_GOES && !is_stopped(wish, s.mean)) {
            const int32_t steps = s.steps;
            status = rg_stride_take(&s);
            if (status == RG_OK && s.steps > steps) status = keep(u, s.z);
        }
        u->steps += s.steps;
        u->work += s.q.work + s.q.q.work;
        *through = status == RG_OK && s.state == RG_STRIDE_ARRIVED;
        rg_stride_free(&s);
    }
    const int nearly = *through || (status == RG_OK && u->count > 1 && u->progress[u->count - 1] > NEARLY_HOME);
    const int32_t folded = u->count;
    if (*through) {
        u->opened = u->landed = u->progress[u->count - 1];
        memset(z, 0, (size_t)n * sizeof *z);
        memcpy(z, u->end, (size_t)n * sizeof *z);
        status = keep(u, z);
        *through = status == RG_OK && !crosses_between(u);
    }
    if (status == RG_OK && nearly && !*through) status = land_as_seen(u, folded - 1, budget, wish, through);
    rg_mem_free(&u->mem, z);
    rg_mem_free(&u->mem, target);
    return status;
}

/* The farthest that a crease is past half a turn. */
static double over(const rg_unfold *u, const double *z)
{
    double most = 0;
    for (int32_t i = 0; i < u->P.N; i++) most = fmax(most, fabs(z[i]) - RG_PI);
    return most;
}

static rg_status attempt(rg_unfold *u, const try_ *t, double budget, const rg_unfold_wish *wish, int *through)
{
    rg_end end = {0};
    rg_proximity near = {0};
    rg_open_result opened = {0};
    const size_t n = (size_t)u->P.n;
    double *z = rg_mem_array(&u->mem, n, sizeof *z), *target = rg_mem_array(&u->mem, n, sizeof *target);
    *through = 0;
    u->tries++;
    find_end(u);
    rg_status s = z && target ? rg_end_init(&end, &u->mem, &u->P, u->end, &t->rules, lies_over, u) : RG_ENOMEM;
    if (s == RG_OK) s = rg_proximity_init(&near, &u->mem, &u->mesh);
    if (s == RG_OK) {
        for (int32_t i = 0; i < u->P.N; i++) target[i] = u->end[i] == 0 ? NAN : 0;
        const double before = u->q.work + u->q.q.work;
        u->q.q.most_work = u->q.q.work + fmax(budget, 1);
        u->count = 0;
        s = keep(u, end.z);
        if (s == RG_OK) s = rg_open(&u->P, &end, &t->open, budget, &u->crossed, &near, &u->q, z, keep, u, &opened);
        const double spent = u->q.work + u->q.q.work - before;
        u->work += spent;
        budget -= spent;
    }
    rg_proximity_free(&near);
    if (s == RG_OK && opened.angle <= CLOSED && (t->open.grow || (opened.worst >= -WRONG && over(u, z) <= OVER)) &&
        rg_linkage_least_area(&u->P, z + u->P.N) >= LEAST_AREA)
        s = walk(u, &end, z, target, budget, t->open.grow, wish, through);
    rg_end_free(&end);
    rg_mem_free(&u->mem, z);
    rg_mem_free(&u->mem, target);
    return s;
}

/* One entry of the plan; *is_free: out. */
static rg_status go_by(rg_unfold *u, const step_of_plan *p, const rg_unfold_wish *wish, int *is_free)
{
    const double budget = PART_OF_BUDGET * (u->most - u->work);
    const int forward = p->way < 0;
    *is_free = u->as_seen = 0;
    if (forward ? wish->order >= 0 : !number_order(u, wish, p->order)) return RG_OK;
    rg_status s = rg_layers_choose(u->layers, forward ? NULL : u->which);
    if (s == RG_OK) s = forward ? forwards(u, budget, wish, is_free) : attempt(u, &TRIES[p->way], budget, wish, is_free);
    if (s != RG_OK || !*is_free) return s;
    if (forward) snprintf(u->how, sizeof u->how, "folded from flat with contacts");
    else if (u->as_seen)
        snprintf(u->how, sizeof u->how, "unfolded from the flat end, way of opening %d, and landed in the order of layers that it came to", p->way + 1);
    else
        snprintf(u->how, sizeof u->how, "unfolded from the flat end: order of layers %d of those tried, way of opening %d",
                 (int)p->order + 1, p->way + 1);
    return wish->accept ? wish->accept(wish->ctx, u, is_free) : RG_OK;
}

static rg_status search(rg_unfold *u, const rg_unfold_wish *wish)
{
    u->outcome = RG_UNFOLD_FAILED;
    for (int k = 0; k < PLAN_COUNT; k++) {
        int is_free;
        if (!(u->work < u->most) || is_stopped(wish, 0)) return RG_OK;
        const rg_status s = go_by(u, &PLAN[k], wish, &is_free);
        if (s != RG_OK) return s;
        if (!is_free) continue;
        u->outcome = RG_UNFOLD_FREE;
        return RG_OK;
    }
    return RG_OK;
}

rg_status rg_unfold_run(rg_unfold *u, const rg_memory *mem, const rg_mesh *none, const rg_unfold_wish *wish)
{
    memset(u, 0, sizeof *u);
    u->mem = *mem;
    u->size = none->size;
    u->most = wish->budget;
    u->outcome = RG_UNFOLD_NO_END;
    rg_status s = wish->shorter ? rg_triangulate_short(none, &u->mesh) : rg_triangulate_all(none, &u->mesh);
    if (s != RG_OK) return s;
    for (int32_t v = 0; v < u->mesh.nv; v++) u->mesh.X[v] = (rg_vec2){u->mesh.X[v].x / u->size, u->mesh.X[v].y / u->size};
    u->mesh.size = 1;
    s = rg_linkage_init(&u->P, mem, &u->mesh);
    if (s == RG_OK) s = rg_nearest_init(&u->q, mem, &u->P);
    u->q.q.stop = wish->stop, u->q.q.ctx = wish->ctx;
    if (s == RG_OK) s = rg_plates_init(&u->mesh, &u->plates);
    if (s == RG_OK) s = rg_contact_work_init(&u->plates, &u->look);
    if (s != RG_OK) return s;
    u->crossed.plates = &u->plates;
    u->crossed.look = &u->look;
    u->end = rg_mem_array(mem, (size_t)u->P.n, sizeof *u->end);
    u->scratch = rg_mem_array(mem, (size_t)u->P.n, sizeof *u->scratch);
    u->x = rg_mem_array(mem, 2 * (size_t)u->mesh.nv, sizeof *u->x);
    s = u->end && u->scratch && u->x ? find_layers(u, wish->sign) : RG_ENOMEM;
    if (s != RG_OK || !u->layers || u->layers->info.state != RG_LAYERS_VALID || u->P.N == 0) return s;
    return search(u, wish);
}

/* ---- reading off */

/* The state a part t from node k to the next, closed: u->scratch. */
static void between(rg_unfold *u, int32_t k, double t)
{
    const size_t n = (size_t)u->P.n;
    const double *a = u->z + (size_t)k * n, *b = a + n;
    const int last = k + 2 == u->count; /* into the end: angles by e, pattern by e^2 */
    for (int32_t i = 0; i < u->P.n; i++) {
        const double part = last && i >= u->P.N ? 1 - (1 - t) * (1 - t) : t;
        u->scratch[i] = a[i] + part * (b[i] - a[i]);
    }
    rg_stride_close(&u->P, &u->q, u->scratch, READ_CLOSED, READ_NEWTON);
}

void rg_unfold_read(rg_unfold *u, double due, double *rho, rg_vec2 *X)
{
    const size_t n = (size_t)u->P.n;
    int32_t k = 0;
    while (k + 2 < u->count && u->progress[k + 1] < due) k++;
    rg_stride_scale(&u->P, 1, u->q.scale);
    const double from = u->progress[k], to = u->progress[k + 1];
    if (due <= from || due >= to) {
        memcpy(u->scratch, u->z + (size_t)(due >= to ? k + 1 : k) * n, n * sizeof *u->scratch);
    } else {
        double low = 0, high = 1, at_low = from, at_high = to;
        for (int i = 0; i < SECANTS; i++) {
            const double t = low + (high - low) * (due - at_low) / (at_high - at_low);
            between(u, k, t);
            const double at = progress_of(u, u->scratch);
            if (fabs(at - due) <= NEAR_DUE || !(t > low && t < high)) break;
            if (at < due) low = t, at_low = at;
            else high = t, at_high = at;
        }
    }
    memcpy(rho, u->scratch, (size_t)u->P.N * sizeof *rho);
    rg_freedom_move(&u->P.freedom, u->scratch + u->P.N, X);
    for (int32_t v = 0; v < u->mesh.nv; v++) X[v] = (rg_vec2){X[v].x * u->size, X[v].y * u->size};
}
