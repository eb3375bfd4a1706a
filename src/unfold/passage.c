#include "unfold/passage.h"
#include "contact/course.h"
#include "unfold/home.h"
#include "unfold/landing.h"
#include "unfold/seen.h"

#include <string.h>

static const double CLOSED = 1e-9, LEAST_AREA = 0.1;
/* From this progress on the order of layers is to be seen, where it is. */
static const double NEAR_THE_END = 0.98;
/* And on the way from this progress on pairs are followed. */
static const double FOLLOWED_FROM = 0.7;
/* So far the end's pattern may be from the one drawn, lengths of the sheet, and so much it may be open, radians. */
static const double END_MOVES = 1e-2, END_CLOSES = 1e-8, END_CLOSED = 1e-13;
static const int NEWTON = 12;
/* From where creases are unfolded by this part, in the mean, they may go straight home. */
static const double NEARLY_HOME = 0.9;
/* States that are looked at for an order, and the rows by which it is landed in: all first. */
enum { SEEN = 12, LANDINGS = 2 };
static const rg_end_rules LANDING[LANDINGS] = {{1, 1}, {0, 0}};
/* Folding leaves flat with creases folded by this part. */
static const int OFF_FLAT_ITERATIONS = 60;
static const double OFF_FLAT = 0.03, OFF_FLAT_LARGEST = 0.35, OFF_FLAT_STILL = 1e-8, OFF_FLAT_CLOSED = 1e-11;

/* ---- the flat end */

static int lies_over(void *ctx, int32_t f, int32_t g)
{
    const rg_passage *w = ctx;
    const rg_flat *flat = &w->layers->flat;
    /* Positions are seen with the front of the linkage's first facet up, layers with that of flat.root. */
    const int turned = flat->up[flat->facet_of[w->P.tree.order[0]]];
    return -turned * rg_layers_above(w->layers, flat->facet_of[f], flat->facet_of[g]);
}

/* Drawings are rounded: the pattern nearest to the one drawn on which the flat end closes. Where there is none as
 * near as END_MOVES it stays as drawn. A vertex at which many creases meet at half a turn comes to END_CLOSES only. */
static void close_end(rg_passage *w)
{
    const int32_t N = w->P.N, U = w->P.U;
    double *move = w->track.end + N, *best = w->track.scratch, least = INFINITY, most = 0;
    memset(move, 0, (size_t)U * sizeof *move);
    rg_stride_scale(&w->P, 1, w->q.scale);
    memset(w->q.scale, 0, (size_t)N * sizeof *w->q.scale);
    for (int k = 0; k < NEWTON && least > END_CLOSED; k++) {
        rg_stride_close(&w->P, &w->q, w->track.end, END_CLOSED, 1);
        const double angle = rg_coupled_assemble(&w->P.J, w->track.end, move, NULL);
        if (!(angle < least)) continue;
        least = angle;
        memcpy(best, move, (size_t)U * sizeof *move);
    }
    for (int32_t i = 0; least <= END_CLOSES && i < U; i++) most = fmax(most, fabs(best[i]));
    const int use = least <= END_CLOSES && most <= END_MOVES;
    for (int32_t i = 0; i < U; i++) move[i] = use ? best[i] : 0;
}

/* Fold angles at the end: what is aimed at, and what a crease without target folds to there. */
static void find_end(rg_passage *w)
{
    const rg_flat *flat = &w->layers->flat;
    for (int32_t i = 0; i < w->P.N; i++) {
        const int32_t e = w->mesh.crease_edge[i];
        int turn = flat->turn[e];
        const int32_t *beside = flat->beside[e];
        if (turn == 2) turn = -flat->up[beside[1]] * rg_layers_above(w->layers, beside[0], beside[1]);
        w->track.end[i] = turn * RG_PI;
    }
    close_end(w);
}

static int is_stopped(const rg_passage *w, double done) { return w->stop && w->stop(w->ctx, done); }

static int asked(void *passage) { return is_stopped(passage, 0); }

static rg_status find_layers(rg_passage *w, double sign)
{
    const rg_stop stop = {asked, w};
    rg_diag why;
    double *rho = w->track.scratch;
    const int32_t drawn = w->P.N - w->mesh.added;
    for (int32_t i = 0; i < w->P.N; i++) rho[i] = i < drawn ? sign * w->mesh.target[w->mesh.crease_edge[i]] : 0;
    const rg_status s = rg_layers_of_mesh(&w->mesh, rho, 0, &w->mem, &stop, &w->layers, &why);
    return s == RG_EFORMAT || s == RG_ESHEET ? RG_OK : s;
}

rg_status rg_passage_init(rg_passage *w, const rg_memory *mem, const rg_mesh *none, double sign, int shorter,
                          int (*stop)(void *ctx, double done), void *ctx)
{
    memset(w, 0, sizeof *w);
    w->mem = *mem;
    w->stop = stop;
    w->ctx = ctx;
    rg_status s = shorter ? rg_triangulate_short(none, &w->mesh) : rg_triangulate_all(none, &w->mesh);
    if (s != RG_OK) return s;
    for (int32_t v = 0; v < w->mesh.nv; v++) {
        const rg_vec2 X = w->mesh.X[v];
        w->mesh.X[v] = (rg_vec2){X.x / none->size, X.y / none->size};
    }
    w->mesh.size = 1;
    s = rg_linkage_init(&w->P, mem, &w->mesh);
    if (s == RG_OK) s = rg_nearest_init(&w->q, mem, &w->P);
    if (s == RG_OK) s = rg_track_init(&w->track, mem, &w->P, &w->q);
    w->crossed.plates = &w->track.plates;
    w->crossed.look = &w->track.look;
    return s == RG_OK ? find_layers(w, sign) : s;
}

void rg_passage_free(rg_passage *w)
{
    if (!w->mem.resize) return;
    rg_layers_destroy(w->layers);
    rg_track_free(&w->track);
    rg_nearest_free(&w->q);
    rg_linkage_free(&w->P);
    rg_mesh_free(&w->mesh);
    memset(w, 0, sizeof *w);
}

/* ---- work */

/* What this try has spent: what was counted, and by w->q since. */
static void count(rg_passage *w)
{
    w->spent += rg_nearest_work(&w->q);
    w->q.work = w->q.q.work = 0;
}

static double left(rg_passage *w)
{
    count(w);
    return w->until - w->spent;
}

/* `budget` ends also one long solve, and so does who watches. */
static void watch(const rg_passage *w, rg_nearest *q, double budget)
{
    q->q.most_work = fmax(budget, 1);
    q->q.stop = w->stop;
    q->q.ctx = w->ctx;
}

static void begin(rg_passage *w, double budget)
{
    count(w);
    w->spent = 0;
    w->until = budget;
    w->as_seen = 0;
    w->landed = 0;
    w->track.count = 0;
    watch(w, &w->q, budget);
}

/* A stride from z. */
static rg_status set_out(rg_passage *w, const rg_end *end, const double *z, const double *target, double budget,
                         rg_stride *s)
{
    const rg_status status = rg_stride_init(s, &w->mem, &w->P, &w->crossed, end, z, target);
    s->budget = budget;
    watch(w, &s->q, budget);
    return status;
}

static void put_away(rg_passage *w, rg_stride *s)
{
    w->spent += rg_nearest_work(&s->q);
    w->steps += s->steps;
    rg_stride_free(s);
}

/* ---- landing */

/* In some state near the end layers are not in its order. */
static int is_upset(rg_passage *w, const rg_end *end)
{
    for (int32_t k = 0; k + 1 < w->track.count; k++) {
        if (w->track.progress[k] < NEAR_THE_END) continue;
        rg_linkage_put(&w->P, w->track.z + (size_t)k * (size_t)w->P.n);
        if (rg_end_is_upset(end, &w->P)) return 1;
    }
    return 0;
}

/* A state more of the course. */
static rg_status look_at(rg_passage *w, const double *z, rg_course *course)
{
    rg_linkage_put(&w->P, z);
    return rg_course_add(course, &(rg_plates_state){w->P.X, w->P.place, w->P.p}, 1);
}

/* Of a course that has come to the end: nothing crosses, and each pair comes in on the side that it has there. */
static rg_status ends_in_order(rg_passage *w, rg_course *course, int *yes)
{
    const rg_status s = course->found.first < 0 ? rg_course_end(course) : RG_OK;
    *yes = s == RG_OK && course->found.first < 0;
    for (int32_t i = 0; *yes && i < course->sweep.n_before; i++) {
        int32_t facet[2];
        const int before = rg_course_side(course, i, facet);
        const int up = w->layers->flat.up[w->layers->flat.facet_of[facet[0]]];
        *yes = rg_layers_above_of_mesh(w->layers, facet[0], facet[1]) * before * up >= 0;
    }
    return s;
}

/* Followed from where facets are well apart: layers that are all but on each other may pass through each other where no
 * state shows it. *yes: out. */
static rg_status comes_in_order(rg_passage *w, int *yes)
{
    const rg_track *p = &w->track;
    rg_course course = {0};
    rg_status s = rg_course_init(&w->mesh, &course);
    for (int32_t k = 0; s == RG_OK && k < p->count && course.found.first < 0; k++)
        if (p->progress[k] >= FOLLOWED_FROM) s = look_at(w, p->z + (size_t)k * (size_t)w->P.n, &course);
    if (s == RG_OK) s = ends_in_order(w, &course, yes);
    rg_course_free(&course);
    return s;
}

/* In the order that was chosen, all the way, and nothing crosses. */
static rg_status is_good(rg_passage *w, const rg_end *end, int *yes)
{
    *yes = !is_upset(w, end) && !rg_track_crosses_between(&w->track);
    return *yes ? comes_in_order(w, yes) : RG_OK;
}

/* The order of layers that the states up to now show, as far as there is one. */
static rg_status choose_as_seen(rg_passage *w)
{
    const int32_t N = w->P.N, count = w->track.count < SEEN ? w->track.count : SEEN;
    const size_t nv = (size_t)w->mesh.nv, n = (size_t)w->P.n;
    rg_tree tree = {0};
    double *wish, *rho;
    rg_vec2 *X;
    rg_status s = RG_MEM_ARRAYS(&w->mem, RG_ARRAY(wish, (size_t)w->layers->pairs.count),
                                RG_ARRAY(rho, ((size_t)count + 1) * (size_t)N), RG_ARRAY(X, ((size_t)count + 1) * nv));
    if (s == RG_OK) s = rg_tree_init(&w->mesh, -1, &tree);
    if (s == RG_OK) {
        for (int32_t k = 0; k <= count; k++) {
            const double *z = k < count ? w->track.z + (size_t)(w->track.count - count + k) * n : w->track.end;
            memcpy(rho + (size_t)k * (size_t)N, z, (size_t)N * sizeof *rho);
            rg_freedom_move(&w->P.freedom, z + N, X + (size_t)k * nv);
        }
        const rg_seen_frames seen = {&w->mesh, &tree, rho, X, count + 1};
        s = rg_seen_order(w->layers, &seen, wish);
    }
    if (s == RG_OK) s = rg_layers_choose_near(w->layers, wish);
    if (s == RG_OK) find_end(w);
    if (tree.mem.resize) rg_tree_free(&tree);
    RG_MEM_FREE(&w->mem, wish, rho, X);
    return s;
}

/* From where it was opened back towards the end, state by state, and the end. */
static rg_status land(rg_passage *w, const rg_end *end, const double *z, const double *target, double budget)
{
    rg_stride s;
    double open = 1;
    rg_status status = set_out(w, end, z, target, budget, &s);
    if (status == RG_OK) status = rg_landing_run(&s, end->z, rg_track_keep, &w->track, &open);
    put_away(w, &s);
    if (status != RG_OK) return status;
    w->landed = w->track.progress[w->track.count - 1];
    return rg_track_keep(&w->track, end->z);
}

/* Layers may come in another order than was begun from, or without one: then the end is the one that the states
 * show. What leads there from state `at` on is found anew. */
static rg_status land_as_seen(rg_passage *w, int32_t at, int *through)
{
    const size_t n = (size_t)w->P.n;
    double *z, *target;
    rg_status s = RG_MEM_ARRAYS(&w->mem, RG_ARRAY(z, n), RG_ARRAY(target, n));
    *through = 0;
    if (s == RG_OK) {
        w->track.count = at + 1;
        memcpy(z, w->track.z + (size_t)at * n, n * sizeof *z);
        s = choose_as_seen(w);
        for (int32_t i = 0; i < w->P.N; i++) target[i] = w->track.end[i] == 0 ? NAN : 0;
    }
    const rg_stop stop = {asked, w};
    for (int k = 0; s == RG_OK && !*through && k < LANDINGS && !rg_stop_asked(&stop); k++) {
        rg_end end = {0};
        w->track.count = at + 1;
        s = rg_end_init(&end, &w->mem, &w->P, w->track.end, &LANDING[k], &(rg_end_order){lies_over, w, &stop});
        if (rg_stop_asked(&stop)) {
            rg_end_free(&end);
            break;
        }
        rg_linkage_put(&w->P, z);
        const int upset = s == RG_OK && w->track.progress[at] > NEAR_THE_END && rg_end_is_upset(&end, &w->P);
        if (s == RG_OK && !upset) s = land(w, &end, z, target, left(w) / (LANDINGS - k));
        if (s == RG_OK && !upset) s = is_good(w, &end, through);
        rg_end_free(&end);
    }
    RG_MEM_FREE(&w->mem, z, target);
    return s;
}

/* ---- from the end */

/* From z to flat, state by state: the path goes on from the end. */
static rg_status unfold(rg_passage *w, const rg_end *end, const double *z, const double *target, int *flat)
{
    rg_stride s;
    rg_status status = set_out(w, end, z, target, left(w), &s);
    *flat = 0;
    if (status == RG_OK && !rg_track_crosses(&w->track, w->P.p)) {
        while (status == RG_OK && s.state == RG_STRIDE_GOES && !is_stopped(w, s.mean)) {
            const int32_t steps = s.steps;
            status = rg_stride_take(&s);
            if (status != RG_OK || s.steps == steps) continue;
            if (rg_track_crosses(&w->track, w->P.p)) break; /* sides of layers on each other did not tell */
            status = rg_track_keep(&w->track, s.z);
        }
        *flat = status == RG_OK && s.state == RG_STRIDE_ARRIVED;
        if (*flat) status = rg_home_finish(&w->track, s.z);
        else if (status == RG_OK && s.state != RG_STRIDE_GOES && s.mean > NEARLY_HOME)
            status = rg_home_go(&w->track, s.z, flat);
    }
    put_away(w, &s);
    return status;
}

/* Unfolds z: the path from flat to the end. Where z was opened slowly, the way there is kept already, from the end
 * on. */
static rg_status walk(rg_passage *w, const rg_end *end, const double *z, const double *target, int slowly, int *through)
{
    rg_track *p = &w->track;
    rg_status status = RG_OK;
    *through = 0;
    if (!slowly) p->count = 0;
    if (p->count < 2) status = rg_track_keep(p, z);
    if (status != RG_OK) return status;
    if (slowly) w->landed = p->progress[1];
    const int32_t opening = p->count - 1;
    status = unfold(w, end, z, target, through);
    if (status != RG_OK || !*through) return status;
    rg_track_reverse(p);
    const int32_t at = p->count - 1 - opening;
    if (!slowly) status = land(w, end, z, target, left(w));
    if (status == RG_OK) status = is_good(w, end, through);
    if (status == RG_OK && !*through && w->any_order) {
        status = land_as_seen(w, at, through);
        w->as_seen = *through;
    }
    return status;
}

/* A state that a motion may begin from. */
static int is_open(const rg_opening *o)
{
    const int apart = o->worst >= -RG_TRACK_WRONG && rg_linkage_past_half_turn(o->P, o->z) <= RG_STRIDE_OVER;
    return o->angle <= CLOSED && (o->way->grow || apart) && rg_linkage_least_area(o->P, o->z + o->P->N) >= LEAST_AREA;
}

rg_status rg_passage_from_end(rg_passage *w, const rg_passage_way *way, double budget, int *through)
{
    rg_end end = {0};
    rg_proximity near = {0};
    rg_opening o = {.P = &w->P, .end = &end, .way = &way->open, .crossed = &w->crossed, .near = &near, .q = &w->q,
                    .keep = rg_track_keep, .ctx = &w->track};
    const size_t n = (size_t)w->P.n;
    double *target;
    *through = 0;
    begin(w, budget);
    find_end(w);
    rg_status s = RG_MEM_ARRAYS(&w->mem, RG_ARRAY(o.z, n), RG_ARRAY(target, n));
    const rg_stop stop = {asked, w};
    if (s == RG_OK)
        s = rg_end_init(&end, &w->mem, &w->P, w->track.end, &way->rules, &(rg_end_order){lies_over, w, &stop});
    if (s == RG_OK) s = rg_proximity_init(&near, &w->mem, &w->mesh);
    if (s == RG_OK) s = rg_track_keep(&w->track, end.z);
    const int goes_on = s == RG_OK && !rg_stop_asked(&stop);
    if (goes_on) {
        for (int32_t i = 0; i < w->P.N; i++) target[i] = w->track.end[i] == 0 ? NAN : 0;
        o.until = left(w); /* w->q has been counted */
        s = rg_open(&o);
    }
    rg_proximity_free(&near);
    if (goes_on && s == RG_OK && is_open(&o)) s = walk(w, &end, o.z, target, way->open.grow, through);
    count(w);
    rg_end_free(&end);
    RG_MEM_FREE(&w->mem, o.z, target);
    return s;
}

/* ---- from flat */

/* The closed state nearest to all creases a little folded. Zero: there is none. */
static int leave_flat(rg_passage *w, double *z)
{
    const int32_t N = w->P.N, n = w->P.n;
    rg_nearest *q = &w->q;
    rg_stride_scale(&w->P, 1, q->scale);
    for (int k = 0; k < OFF_FLAT_ITERATIONS; k++) {
        double most = 0;
        rg_coupled_assemble(&w->P.J, z, z + N, NULL);
        rg_coupled_renew(&w->P.J, q->scale);
        rg_linkage_put(&w->P, z);
        for (int32_t i = 0; i < n; i++) q->wish[i] = (i < N ? OFF_FLAT * w->track.end[i] : 0) - z[i];
        rg_nearest_project(q, q->wish, w->P.K.r);
        for (int32_t i = 0; i < N; i++) most = fmax(most, fabs(q->dz[i]));
        for (int32_t i = 0; i < n; i++) z[i] += fmin(1, OFF_FLAT_LARGEST / fmax(most, 1e-12)) * q->dz[i];
        if (most < OFF_FLAT_STILL) break;
    }
    return rg_stride_close(&w->P, q, z, OFF_FLAT_CLOSED, NEWTON);
}

/* From z on, state by state: *folded, out: to the end. */
static rg_status fold(rg_passage *w, const double *z, const double *target, int *folded)
{
    rg_stride s;
    rg_status status = set_out(w, NULL, z, target, left(w), &s);
    if (status == RG_OK) status = rg_track_keep(&w->track, z);
    while (status == RG_OK && s.state == RG_STRIDE_GOES && !is_stopped(w, s.mean)) {
        const int32_t steps = s.steps;
        status = rg_stride_take(&s);
        if (status == RG_OK && s.steps > steps) status = rg_track_keep(&w->track, s.z);
    }
    *folded = status == RG_OK && s.state == RG_STRIDE_ARRIVED;
    put_away(w, &s);
    return status;
}

rg_status rg_passage_from_flat(rg_passage *w, double budget, int *through)
{
    rg_track *p = &w->track;
    double *z, *target;
    rg_status status = RG_MEM_ARRAYS(&w->mem, RG_ARRAY(z, (size_t)w->P.n), RG_ARRAY(target, (size_t)w->P.N));
    *through = 0;
    begin(w, budget);
    if (status == RG_OK) {
        find_end(w);
        status = rg_track_keep(p, z);
        for (int32_t i = 0; i < w->P.N; i++) target[i] = p->end[i] == 0 ? NAN : p->end[i];
    }
    if (status == RG_OK && leave_flat(w, z)) status = fold(w, z, target, through);
    const int32_t folded = p->count;
    const int nearly = *through || (status == RG_OK && folded > 1 && p->progress[folded - 1] > NEARLY_HOME);
    if (*through) {
        w->landed = p->progress[folded - 1];
        status = rg_track_keep(p, p->end);
        *through = status == RG_OK && !rg_track_crosses_between(p);
    }
    if (status == RG_OK && nearly && !*through) status = land_as_seen(w, folded - 1, through);
    count(w);
    RG_MEM_FREE(&w->mem, z, target);
    return status;
}
