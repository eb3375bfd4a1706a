/* frames.c -- frames read off the path of an attempt, evenly in progress or in how far creases turn: attempt.h. */
#include "fold/chord.h"
#include "motion/attempt.h"
#include "motion/forth.h"

#include <string.h>

/* At a steady pace no way from frame to frame turns a crease by more than so many times the mean: even enough. */
static const double UNEVEN = 1.1;
/* How often it is set right. */
static const int TIMES_SET_RIGHT = 5;

const double *rg_attempt_angles(const rg_attempt *t, int32_t k) { return t->rho + (size_t)k * (size_t)t->mesh.N; }

const rg_vec2 *rg_attempt_pattern(const rg_attempt *t, int32_t k)
{
    return t->flat ? t->flat + (size_t)k * (size_t)t->mesh.nv : t->mesh.X;
}

int32_t rg_attempt_states(const rg_attempt *t) { return t->relax ? t->relax->nodes : t->count; }

const double *rg_attempt_state(const rg_attempt *t, int32_t k)
{
    return t->relax ? t->relax->node + (size_t)k * (size_t)t->relax->n : rg_attempt_angles(t, k);
}

static rg_status make_frames(rg_attempt *t, int32_t frames, int moves)
{
    const size_t n = (size_t)frames + 1;
    rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(t->rho, n * (size_t)t->mesh.N));
    if (s == RG_OK && moves) s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(t->flat, n * (size_t)t->mesh.nv));
    return s;
}

/* All frames, at due[t->count]. */
static void read_off(rg_attempt *t, const double *due, rg_path_reader *read, void *ctx)
{
    const size_t N = (size_t)t->mesh.N, nv = (size_t)t->mesh.nv;
    for (size_t k = 0; k < (size_t)t->count; k++)
        read(ctx, due[k], t->rho + k * N, t->flat ? t->flat + k * nv : NULL);
}

static rg_status fill_gaps(rg_attempt *t, const double *due, rg_path_reader *read, void *ctx)
{
    rg_gap_filler q;
    rg_status s = rg_gap_filler_init(&q, &t->mem, &t->mesh, &t->gaps, t->flat != NULL, read, ctx);
    for (int32_t k = 0; s == RG_OK && k + 1 < t->count; k++)
        s = rg_gap_fill(&q, k, due[k], rg_attempt_angles(t, k), due[k + 1], rg_attempt_angles(t, k + 1));
    rg_gap_filler_free(&q);
    return s;
}

/* ------------------------------------------------------------------------------------------- a steady pace ---- */

/* sum[t->count]: out, how far creases have turned at each frame, by the most that one turns from frame to frame.
 * Returns the largest of these. */
static double add_up(const rg_attempt *t, double *sum)
{
    double most = 0;
    sum[0] = 0;
    for (int32_t k = 1; k < t->count; k++) {
        const double turned = rg_gaps_turn(t->mesh.N, rg_attempt_angles(t, k - 1), rg_attempt_angles(t, k));
        most = fmax(most, turned);
        sum[k] = sum[k - 1] + turned;
    }
    return most;
}

/* Which part of the way from k - 1 to k it is where the sum comes to `want`; k rises to that place. */
static double part_at(const double *sum, int32_t last, double want, int32_t *k)
{
    while (*k < last && sum[*k] < want) ++*k;
    return sum[*k] > sum[*k - 1] ? (want - sum[*k - 1]) / (sum[*k] - sum[*k - 1]) : 1;
}

/* Frames read off tell how fast the path really goes between its nodes: due[t->count] is set right by it. Zero: it was
 * even enough. was[t->count], sum[t->count]: scratch. */
static int set_right(const rg_attempt *t, double *due, double *was, double *sum)
{
    const int32_t last = t->count - 1;
    if (!(add_up(t, sum) * last > UNEVEN * sum[last])) return 0;
    memcpy(was, due, (size_t)t->count * sizeof *due);
    for (int32_t j = 1, k = 1; j < last; j++) {
        const double part = part_at(sum, last, sum[last] * j / last, &k);
        due[j] = was[k - 1] + (was[k] - was[k - 1]) * part;
    }
    return 1;
}

/* Frames at due[t->count], which is set right so often at the most. */
static rg_status read_evenly(rg_attempt *t, double *due, int times, rg_path_reader *read, void *ctx)
{
    double *was, *sum;
    const rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(was, (size_t)t->count), RG_ARRAY(sum, (size_t)t->count));
    if (s != RG_OK) return s;
    read_off(t, due, read, ctx);
    for (int n = 0; n < times && set_right(t, due, was, sum); n++) read_off(t, due, read, ctx);
    RG_MEM_FREE(&t->mem, was, sum);
    return RG_OK;
}

rg_status rg_attempt_run(rg_attempt *t, rg_straight *f, int32_t parts, rg_trace *trace, rg_watch *watch)
{
    rg_forth r = {.f = f, .parts = parts, .trace = trace, .rho = t->rho, .due = t->due, .gaps = &t->gaps};
    rg_gaps_free(&t->gaps, &t->mem);
    const rg_status s = rg_forth_run(&r, &t->mem, watch);
    t->count = r.count;
    t->outcome = watch->cancelled ? RG_STOPPED : r.outcome;
    return s;
}

/* Progress at frames that are even in the largest angle that a crease turns; the frames that there are, at even
 * progress 0 ... to, tell it. due[frames]: out. sum[t->count]: scratch. */
static void pace_by_frames(const rg_attempt *t, double to, int32_t frames, double *sum, double *due)
{
    const int32_t last = t->count - 1;
    add_up(t, sum);
    for (int32_t j = 1, k = 1; j < frames; j++) {
        const double part = part_at(sum, last, sum[last] * j / (frames - 1), &k);
        due[j] = to * (k - 1 + fmin(1, part)) / last;
    }
    due[frames - 1] = to;
}

/* What went straight on knows its frames only. They tell how fast it goes; with frames that are due accordingly it goes
 * the same way again. */
static rg_status go_again_steadily(rg_attempt *t, const rg_settings *settings)
{
    rg_settings mine = *settings;
    const int32_t frames = settings->frames, parts = rg_forth_parts(settings);
    double *sum, *due;
    rg_mesh copy = {0};
    rg_straight *f = NULL;
    rg_watch nobody = {0};
    const rg_outcome outcome = t->outcome;
    mine.to = t->to;
    mine.frames = (frames - 1) * parts + 1;
    rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(sum, (size_t)t->count), RG_ARRAY(due, (size_t)mine.frames));
    if (s == RG_OK) s = rg_mesh_copy(&t->mesh, &copy);
    if (s == RG_OK) {
        pace_by_frames(t, fabs(t->to), frames, sum, due);
        for (int32_t k = frames - 1; k > 0; k--) /* from the last on, none is in another one's place */
            for (int32_t i = parts; i > 0; i--)
                due[(k - 1) * parts + i] = due[k - 1] + (due[k] - due[k - 1]) * ((double)i / parts);
        s = rg_straight_from_mesh(&copy, &mine, &f, NULL);
    }
    if (s == RG_OK) rg_straight_set_due(f, due);
    if (s == RG_OK) s = rg_attempt_run(t, f, parts, NULL, &nobody);
    t->outcome = outcome;
    rg_straight_destroy(f);
    RG_MEM_FREE(&t->mem, sum, due);
    return s;
}

/* ---------------------------------------------------------------------------------------------- of any path ---- */

rg_status rg_attempt_read_path(rg_attempt *t, const rg_settings *settings, rg_path_reader *read, void *ctx)
{
    const int32_t frames = settings->frames;
    double *due = rg_mem_array(&t->mem, (size_t)frames, sizeof *due);
    rg_status s = due ? make_frames(t, frames, 1) : RG_ENOMEM;
    t->count = frames;
    for (int32_t k = 0; s == RG_OK && k < frames; k++) due[k] = fabs(settings->to) * ((double)k / (frames - 1));
    if (s == RG_OK) s = read_evenly(t, due, settings->pace == RG_PACE_STEADY ? TIMES_SET_RIGHT : 0, read, ctx);
    if (s == RG_OK) s = fill_gaps(t, due, read, ctx);
    rg_mem_free(&t->mem, due);
    return s;
}

/* ----------------------------------------------------------------------------------------- of a relaxation ---- */

/* What reads states off it; z[n]: scratch. */
typedef struct chord_reader { rg_attempt *t; double *z; } chord_reader;

static int read_chord(void *ctx, double progress, double *rho, rg_vec2 *X)
{
    const chord_reader *c = ctx;
    rg_relax *F = c->t->relax;
    rg_chord_at(F, progress, c->z);
    memcpy(rho, c->z, (size_t)F->N * sizeof *rho);
    if (c->t->flat) rg_freedom_move(&F->freedom, c->z + F->N, X);
    return 1;
}

/* Progress at frames that are even in the largest angle that a crease turns, from s0 to s1, as the nodes tell it. */
static void pace_by_nodes(const rg_attempt *t, double s0, double s1, double *due)
{
    const rg_relax *F = t->relax;
    const int32_t last = t->count - 1;
    const double low = fmin(s0, s1), high = fmax(s0, s1);
    double all = 0, done = 0;
    for (int pass = 0, next = 1; pass < 2; pass++)
        for (int32_t k = 1; k < F->nodes; k++) {
            const double from = F->node_s[k - 1], to = F->node_s[k], a = fmax(low, from), b = fmin(high, to);
            if (!(b > a)) continue;
            double turned = rg_gaps_turn(F->N, rg_attempt_state(t, k - 1), rg_attempt_state(t, k));
            turned *= (b - a) / (to - from);
            if (pass == 0) {
                all += turned;
                continue;
            }
            for (; next < last && done + turned >= all * next / last; next++)
                due[next] = a + (b - a) * (turned > 0 ? (all * next / last - done) / turned : 1);
            done += turned;
        }
    due[0] = low;
    due[last] = high;
    for (int32_t i = 0, j = last; s0 > s1 && i < j; i++, j--) {
        const double d = due[i];
        due[i] = due[j];
        due[j] = d;
    }
}

/* t->count and due[], evenly in progress; where it stopped short, at the pace that the whole way would have had, and
 * the last state. From s0 to s1. */
static void share_out(rg_attempt *t, int32_t frames, double to, double s0, double s1)
{
    const rg_relax *F = t->relax;
    const double last = F->node_s[F->nodes - 1];
    for (t->count = 0; t->count < frames; t->count++) {
        const double d = s0 + (t->backwards ? -to : to) * ((double)t->count / (frames - 1));
        if (!t->backwards && t->outcome != RG_FOLDED && !(d < last)) break;
        t->due[t->count] = fmin(d, last);
    }
    if (t->count < frames) t->due[t->count++] = s1;
    else if (to == 1) t->due[t->backwards ? 0 : frames - 1] = last; /* the end itself */
}

static rg_status read_relaxed(rg_attempt *t, const rg_settings *settings)
{
    const rg_relax *F = t->relax;
    const double to = fabs(settings->to), last = F->node_s[F->nodes - 1];
    const double end = t->outcome == RG_FOLDED ? fmin(last, to) : last;
    const double s0 = t->backwards ? 1 : 0, s1 = t->backwards ? 1 - to : end;
    rg_status s = RG_MEM_ARRAYS(&t->mem, RG_ARRAY(t->due, (size_t)settings->frames + 1));
    if (s == RG_OK) s = make_frames(t, settings->frames, F->U > 0);
    if (s != RG_OK) return s;
    share_out(t, settings->frames, to, s0, s1);
    const int steady = settings->pace == RG_PACE_STEADY && t->count > 1;
    if (steady) pace_by_nodes(t, s0, s1, t->due);
    chord_reader c = {t, rg_mem_array(&t->mem, (size_t)F->n, sizeof *c.z)};
    s = c.z ? read_evenly(t, t->due, steady ? TIMES_SET_RIGHT : 0, read_chord, &c) : RG_ENOMEM;
    if (s == RG_OK) s = fill_gaps(t, t->due, read_chord, &c);
    rg_mem_free(&t->mem, c.z);
    return s;
}

/* ---------------------------------------------------------------------------------------------------- any ---- */

rg_status rg_attempt_read(rg_attempt *t, const rg_settings *settings)
{
    if (t->is_read || (t->relax && t->rho)) return RG_OK;
    if (t->relax) return read_relaxed(t, settings);
    const int steady = settings->pace == RG_PACE_STEADY && t->outcome != RG_STOPPED && t->count == settings->frames;
    return steady ? go_again_steadily(t, settings) : RG_OK;
}

void rg_attempt_forget_frames(rg_attempt *t)
{
    if (!t->relax) return;
    RG_MEM_FREE(&t->mem, t->rho, t->flat, t->due);
    t->rho = t->due = NULL, t->flat = NULL, t->count = 0;
    rg_gaps_free(&t->gaps, &t->mem);
}
