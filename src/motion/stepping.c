/* stepping.c -- a motion state by state, for callers that own the loop: rigami.h, rg_fold.
 *
 * The search happens in create: what folds a pattern is known only when it has come to its end. A step then goes to the
 * next frame of the motion that was found, which is the one that rg_motion_create finds, to the bit; or, where somebody
 * has steered, one state further. */
#include "base/settings.h"
#include "base/status.h"
#include "fold/chord.h"
#include "fold/tuning.h"
#include "motion/fold.h"

#include <string.h>

/* Progress between two states is met to this, or an angle; what is off by more, at a leap of the path, is not it. */
static const double SAME_PLACE = 1e-13, NOT_THERE = 1e-11;
static const int32_t SECANTS = 40;
/* What went straight on has frames where progress was held to so much; a place between them is where one would be. */
static const double HELD = 1e-10;

/* ------------------------------------------------------------------------------------------- making one ---- */

void rg_shared_let_go(const rg_memory *mem, rg_shared *s)
{
    if (!s || atomic_fetch_sub(&s->holders, 1) > 1) return;
    rg_attempt_free(&s->path); /* on the motion's mesh */
    pthread_mutex_destroy(&s->reading);
    rg_motion_destroy(s->motion);
    rg_mem_free(mem, s);
}

void rg_fold_destroy(rg_fold *f)
{
    if (!f) return;
    const rg_memory mem = f->mem;
    if (f->steer) rg_steer_free(f->steer);
    for (int i = 0; i < 2; i++)
        if (f->way[i]) rg_between_free(f->way[i]);
    RG_MEM_FREE(&mem, f->rho, f->flat, f->place, f->x, f->theta, f->track.rho, f->track.flat, f->track.progress,
                f->track.closure, f->ending.vertex, f->ending.crease, f->read, f->guess, f->steer, f->way[0],
                f->way[1]);
    rg_shared_let_go(&mem, f->shared);
    rg_mem_free(&mem, f);
}

rg_status rg_fold_on(rg_shared *shared, const rg_memory *mem, const rg_settings *s, rg_fold **fold)
{
    rg_fold *f = rg_mem_array(mem, 1, sizeof *f);
    if (!f) return RG_ENOMEM;
    const rg_mesh *m = &shared->motion->mesh;
    const size_t N = (size_t)m->N, nv = (size_t)m->nv, M = (size_t)m->M;
    f->mem = *mem;
    f->settings = *s;
    const rg_status status = RG_MEM_ARRAYS(mem, RG_ARRAY(f->rho, N), RG_ARRAY(f->flat, nv),
                                           RG_ARRAY(f->place, (size_t)m->nf), RG_ARRAY(f->x, nv),
                                           RG_ARRAY(f->theta, (size_t)m->loop_start[m->M]),
                                           RG_ARRAY(f->ending.vertex, M), RG_ARRAY(f->ending.crease, N));
    if (status != RG_OK) {
        rg_fold_destroy(f);
        return status;
    }
    f->shared = shared;
    atomic_fetch_add(&shared->holders, 1);
    rg_fold_stand(f, 0);
    *fold = f;
    return RG_OK;
}

/* Takes motion and path over, also on failure. */
static rg_status take_over(rg_motion *motion, rg_attempt *path, const rg_settings *settings, rg_fold **fold)
{
    const rg_memory own = rg_mem_default(settings->memory), *mem = &own;
    rg_shared *shared = rg_mem_array(mem, 1, sizeof *shared);
    if (!shared || pthread_mutex_init(&shared->reading, NULL) != 0) {
        rg_attempt_free(path);
        rg_motion_destroy(motion);
        rg_mem_free(mem, shared);
        return RG_ENOMEM;
    }
    shared->motion = motion;
    shared->path = *path;
    atomic_init(&shared->holders, 1);
    const rg_status s = rg_fold_on(shared, mem, settings, fold);
    rg_shared_let_go(mem, shared);
    return s;
}

rg_status rg_fold_create(const rg_pattern *p, const rg_settings *given, rg_progress progress, void *ctx, rg_fold **fold,
                         rg_diag *why)
{
    rg_settings settings;
    rg_motion *motion = NULL;
    rg_status s = rg_settings_take(given, &settings, why);
    rg_attempt path = {0};
    if (s == RG_OK) s = rg_motion_with_path(p, &settings, progress, ctx, &motion, &path, why);
    if (s != RG_OK) return s;
    s = take_over(motion, &path, &settings, fold);
    return s == RG_OK ? s : rg_fail(s, why, 0, "%s", rg_status_text(s));
}

rg_status rg_fold_create_flat(const rg_pattern *p, const rg_settings *given, rg_fold **fold, rg_diag *why)
{
    rg_settings settings;
    rg_motion *motion = NULL;
    rg_attempt none = {0};
    rg_fold *f = NULL;
    rg_status s = rg_settings_take(given, &settings, why);
    if (s == RG_OK) s = rg_motion_unfolded(p, &settings, &motion, why);
    if (s != RG_OK) return s;
    s = take_over(motion, &none, &settings, &f);
    if (s == RG_OK) s = rg_fold_make_steer(f);
    if (s == RG_OK) s = rg_fold_own_track(f, 1);
    if (s != RG_OK) {
        rg_fold_destroy(f);
        return rg_fail(s, why, 0, "%s", rg_status_text(s));
    }
    f->aimed = 1;
    f->ending.outcome = RG_RUNNING;
    f->ending.reason = "";
    rg_fold_stand(f, 0);
    *fold = f;
    return RG_OK;
}

/* ------------------------------------------------------------------------------------------------ moving ---- */

const rg_step_info *rg_fold_get_info(const rg_fold *f) { return &f->info; }

const rg_step_info *rg_fold_step(rg_fold *f)
{
    if (f->at == rg_fold_states(f) - 1 && rg_fold_has_more(f)) rg_fold_advance(f);
    return rg_fold_stand(f, f->at < rg_fold_states(f) - 1 ? f->at + 1 : f->at);
}

const rg_step_info *rg_fold_step_back(rg_fold *f)
{
    return rg_fold_stand(f, f->between ? f->at : f->at > 0 ? f->at - 1 : 0);
}

/* -------------------------------------------------------------------------------------- between two states ---- */

/* How far a state is, within the last leg: the mean part of the ways of the creases that it is counted by. */
static double progress_of(const rg_fold *f, const double *rho)
{
    const rg_motion *m = f->shared->motion;
    const int32_t N = m->mesh.N;
    const double *from = f->steered ? f->steer->from : m->from, *target = f->steered ? f->steer->target : m->target;
    double sum = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < N; i++) {
        const double way = target[i] - from[i];
        const int counts = !f->steered || f->steer->role[i] == (f->steer->driven ? RG_ROLE_DRIVEN : RG_ROLE_WISHES);
        if (!counts || isnan(way) || way == 0) continue;
        sum += fmin(1, (rho[i] - from[i]) / way);
        n++;
    }
    return n ? sum / n : 1;
}

/* The engine for the states between k and k + 1; NULL: memory is short. */
static rg_between *way_between(rg_fold *f, int32_t k)
{
    const rg_mesh *m = rg_fold_mesh(f);
    const size_t bytes = (size_t)m->nv * sizeof(rg_vec2);
    const int moves = memcmp(rg_fold_pattern(f, k), rg_fold_pattern(f, k + 1), bytes) != 0;
    if (f->way[moves]) return f->way[moves];
    if (!f->guess) f->guess = rg_mem_array(&f->mem, (size_t)m->N, sizeof *f->guess);
    rg_between *b = f->guess ? rg_mem_array(&f->mem, 1, sizeof *b) : NULL;
    if (!b) return NULL;
    if (rg_between_init(b, &f->mem, m, moves, &f->settings) == RG_OK) return f->way[moves] = b;
    rg_between_free(b);
    rg_mem_free(&f->mem, b);
    return NULL;
}

/* Does the track bend nowhere, so that more than two of its states tell where it goes between them? */
static int is_smooth(const rg_fold *f)
{
    const rg_report *r = &f->shared->motion->report;
    return f->steered || (strcmp(r->method, "adaptive") == 0 && r->stages == 0);
}

static int rises(const rg_fold *f, int32_t k) { return rg_fold_progress(f, k) < rg_fold_progress(f, k + 1); }

/* f->guess: the polynomial through the states about k and k + 1, SIDE of them on each side, as far as progress rises,
 * at that part of the way between them. Zero: it strays from their chord, which is better then, or a leg ends. */
static int follow(rg_fold *f, int32_t k, double part)
{
    enum { SIDE = 3 };
    const int32_t N = rg_fold_mesh(f)->N;
    const double *a = rg_fold_state(f, k), *b = rg_fold_state(f, k + 1);
    const double s = rg_fold_progress(f, k) + part * (rg_fold_progress(f, k + 1) - rg_fold_progress(f, k));
    int32_t first = k, last = k + 1;
    if (!rises(f, k)) return 0;
    while (first > 0 && k - first < SIDE - 1 && rises(f, first - 1)) first--;
    while (last < rg_fold_states(f) - 1 && last - k < SIDE && rises(f, last)) last++;
    for (int32_t i = 0; i < N; i++) f->guess[i] = 0;
    for (int32_t j = first; j <= last; j++) {
        const double *rho = rg_fold_state(f, j);
        double w = 1;
        for (int32_t l = first; l <= last; l++)
            if (l != j) w *= (s - rg_fold_progress(f, l)) / (rg_fold_progress(f, j) - rg_fold_progress(f, l));
        for (int32_t i = 0; i < N; i++) f->guess[i] += w * rho[i];
    }
    const double turn = rg_gaps_turn(N, a, b);
    for (int32_t i = 0; i < N; i++)
        if (!(fabs(f->guess[i] - (a[i] + part * (b[i] - a[i]))) <= turn)) return 0;
    return 1;
}

/* The crease that turns most from state k to the next. */
static int32_t leader(const rg_fold *f, int32_t k)
{
    return rg_gaps_leader(rg_fold_mesh(f)->N, rg_fold_state(f, k), rg_fold_state(f, k + 1));
}

/* What closes far from both states is on no way from one to the other: a crease farther past half a turn than in both
 * of them tells. */
static int overfolds(const rg_fold *f, const double *rho, const double *from, const double *to)
{
    for (int32_t i = 0; i < rg_fold_mesh(f)->N; i++)
        if (!(fabs(rho[i]) <= fmax(RG_PI, fmax(fabs(from[i]), fabs(to[i]))) + MOST_OVER)) return 1;
    return 0;
}

static rg_motion_state state(const rg_fold *f, int32_t k)
{
    return (rg_motion_state){rg_fold_state(f, k), rg_fold_pattern(f, k), k, 0};
}

/* The state at that part of the way from k to k + 1 in which crease c has the angle, NAN: that which it has there.
 * Returns its closure; NAN: none was found. */
static double at_part(rg_fold *f, rg_between *b, int32_t k, double part, int32_t c, double angle)
{
    const rg_motion_state from = state(f, k), to = state(f, k + 1), guess = {f->guess, from.X, k, 1};
    double closure;
    if (!b->moves && is_smooth(f) && follow(f, k, part)) {
        closure = rg_between_at(b, &guess, &guess, 0, c, isnan(angle) ? f->guess[c] : angle);
    } else {
        const double there = from.rho[c] + part * (to.rho[c] - from.rho[c]);
        closure = rg_between_at(b, &from, &to, part, c, isnan(angle) ? there : angle);
    }
    return overfolds(f, b->z, from.rho, to.rho) ? NAN : closure;
}

rg_status rg_fold_read_between(rg_fold *f, int32_t k, double part, double *rho, rg_vec2 *X, int *closes)
{
    rg_between *way = way_between(f, k);
    if (!way) return RG_ENOMEM;
    *closes = !isnan(at_part(f, way, k, part, leader(f, k), NAN));
    memcpy(rho, way->z, (size_t)rg_fold_mesh(f)->N * sizeof *rho);
    memcpy(X, way->flat, (size_t)rg_fold_mesh(f)->nv * sizeof *X);
    return RG_OK;
}

/* Of a leg that is over it is not known any more whose ways counted: as the states on both sides tell. Its last state
 * has no progress but that of the leg which begins there. */
static double progress_before(const rg_fold *f, int32_t k, double part)
{
    const double from = rg_fold_progress(f, k), to = rg_fold_progress(f, k + 1);
    return from + part * ((to > from ? to : 1) - from);
}

/* What is now the present state, at that part of the way from state k to the next. */
static void stand_at(rg_fold *f, int32_t k, double part, double closure)
{
    f->at = k;
    f->between = 1;
    f->closure = closure;
    f->progress = f->steered && k < f->first ? progress_before(f, k, part) : progress_of(f, f->rho);
    f->progress = fmin(1, fmax(0, f->progress)); /* of a way that is next to nothing, rounding is many times as much */
    rg_fold_look(f);
}

/* What is in b becomes the present state; where it did not close, the nearer one of the track. */
static void stand_between(rg_fold *f, const rg_between *b, int32_t k, double part, double closure)
{
    const rg_mesh *m = rg_fold_mesh(f);
    if (isnan(closure)) {
        rg_fold_stand(f, part < 0.5 ? k : k + 1);
        return;
    }
    memcpy(f->rho, b->z, (size_t)m->N * sizeof *f->rho);
    memcpy(f->flat, b->flat, (size_t)m->nv * sizeof *f->flat);
    stand_at(f, k, part, closure);
}

/* What reads the path of a motion is made when it is first asked for. */
static rg_status open_path(rg_shared *of)
{
    if (!of->path.trace) return RG_OK;
    pthread_mutex_lock(&of->reading);
    const rg_status s = rg_trace_open(of->path.trace, &of->motion->mesh);
    pthread_mutex_unlock(&of->reading);
    return s;
}

/* rho[N], and what else a relaxed state has: out. Returns its closure, NAN: there is none. */
static double read_path(rg_shared *of, double s, double *rho)
{
    pthread_mutex_lock(&of->reading);
    const double closure = of->path.trace ? rg_trace_read(of->path.trace, s, rho) : rg_chord_at(of->path.relax, s, rho);
    pthread_mutex_unlock(&of->reading);
    return closure;
}

/* What is off by off_low at `low` and by off_high at `high`, which are on both sides of where it is off by nothing. */
typedef struct bracket { double low, off_low, high, off_high; } bracket;

/* By the secant; now and then the middle, where that creeps. */
static double next_guess(const bracket *b, int32_t n)
{
    return n % 4 == 3 ? (b->low + b->high) / 2 : b->low - b->off_low * (b->high - b->low) / (b->off_high - b->off_low);
}

static void narrow(bracket *b, double x, double off)
{
    if (off * b->off_low > 0) b->low = x, b->off_low = off;
    else b->high = x, b->off_high = off;
}

/* f->read: the state on the path itself, between frames k and k + 1, where crease c has the angle `goal`; c -1: where
 * that is progress. Returns its closure; NAN: the path leaps over that place. */
static double look_on_path(rg_fold *f, int32_t k, int32_t c, double goal)
{
    rg_shared *of = f->shared;
    const rg_relax *F = of->path.relax;
    const double tol = F ? F->tol : f->settings.tol, *due = of->path.due;
    const double a = c < 0 ? rg_fold_progress(f, k) : rg_fold_state(f, k)[c];
    const double b = c < 0 ? rg_fold_progress(f, k + 1) : rg_fold_state(f, k + 1)[c];
    const double even = of->path.backwards ? 1 - goal : goal; /* where frames are, if they are even in it */
    const int tries_even = c < 0 && (even - due[k]) * (due[k + 1] - even) > 0;
    bracket on = {due[k], a - goal, due[k + 1], b - goal};
    double off = NAN, closure = NAN;
    for (int32_t n = 0; n < SECANTS && !(fabs(off) <= SAME_PLACE); n++) {
        const double s = n == 0 && tries_even ? even : next_guess(&on, n);
        closure = read_path(of, s, f->read);
        off = (c < 0 ? progress_of(f, f->read) : f->read[c]) - goal;
        if (!(closure <= tol) || s == on.low || s == on.high) break;
        if (n == 0 && s == even && !F && fabs(off) <= HELD) break;
        narrow(&on, s, off);
    }
    return closure <= tol && fabs(off) <= (F ? NOT_THERE : HELD) ? closure : NAN;
}

/* Stands there, where there is such a place: *found. What is read depends on the place alone, not on where frames are.
 * RG_ENOMEM. */
static rg_status find_on_path(rg_fold *f, int32_t k, int32_t c, double goal, int *found)
{
    rg_shared *of = f->shared;
    const rg_relax *F = of->path.relax;
    const size_t N = (size_t)rg_fold_mesh(f)->N;
    *found = 0;
    if (f->steered || !of->path.due) return RG_OK;
    if (!f->read && !(f->read = rg_mem_array(&f->mem, F ? (size_t)F->n : N, sizeof *f->read))) return RG_ENOMEM;
    const rg_status status = open_path(of);
    if (status != RG_OK) return status;
    const double closure = look_on_path(f, k, c, goal);
    if (isnan(closure)) return RG_OK;
    *found = 1;
    for (int32_t j = k; j <= k + 1 && !F; j++)
        if (memcmp(f->read, rg_fold_state(f, j), N * sizeof *f->read) == 0) {
            rg_fold_stand(f, j);
            return RG_OK;
        }
    memcpy(f->rho, f->read, N * sizeof *f->rho);
    if (F && F->U > 0) rg_freedom_move(&F->freedom, f->read + F->N, f->flat);
    else memcpy(f->flat, rg_fold_pattern(f, k), (size_t)rg_fold_mesh(f)->nv * sizeof *f->flat);
    stand_at(f, k, 0, closure);
    return RG_OK;
}

/* Between states k and k + 1, at that progress: the crease that turns most leads. */
static rg_status find_progress(rg_fold *f, int32_t k, double goal)
{
    double low = 0, high = 1, at_low = rg_fold_progress(f, k), at_high = rg_fold_progress(f, k + 1);
    double part = 0, closure = NAN;
    const int32_t c = leader(f, k);
    int found;
    if (rg_fold_mesh(f)->N == 0) { /* no crease leads: the sheet is the same in both */
        rg_fold_stand(f, goal - at_low < at_high - goal ? k : k + 1);
        return RG_OK;
    }
    const rg_status s = find_on_path(f, k, -1, goal, &found);
    if (s != RG_OK || found) return s;
    rg_between *way = way_between(f, k);
    if (!way) return RG_ENOMEM;
    for (int32_t n = 0; n < SECANTS; n++) {
        part = low + (high - low) * (goal - at_low) / (at_high - at_low);
        if (n % 4 == 3) part = (low + high) / 2; /* where the secant creeps */
        closure = at_part(f, way, k, part, c, NAN);
        const double is = isnan(closure) ? NAN : progress_of(f, way->z);
        if (!(fabs(is - goal) > SAME_PLACE)) break;
        if (is < goal) low = part, at_low = is;
        else high = part, at_high = is;
    }
    stand_between(f, way, k, part, closure);
    return RG_OK;
}

rg_status rg_fold_go_to(rg_fold *f, double percent)
{
    const double goal = percent / 100;
    if (!(goal >= 0 && goal <= 1)) return RG_EARG;
    if (f->aimed) rg_fold_advance(f);
    for (int32_t k = f->first;; k++) {
        if (fabs(rg_fold_progress(f, k) - goal) <= SAME_PLACE) {
            rg_fold_stand(f, k);
            return RG_OK;
        }
        if (k == rg_fold_states(f) - 1 && rg_fold_has_more(f)) rg_fold_advance(f);
        if (k == rg_fold_states(f) - 1) break;
        if ((rg_fold_progress(f, k) - goal) * (rg_fold_progress(f, k + 1) - goal) < 0) return find_progress(f, k, goal);
    }
    rg_fold_stand(f, goal <= rg_fold_progress(f, f->first) ? f->first : rg_fold_states(f) - 1);
    return RG_OK;
}

/* Does crease c pass that angle from state k to the next? */
static int passes(const rg_fold *f, int32_t k, int32_t c, double angle)
{
    const double a = rg_fold_state(f, k)[c], b = rg_fold_state(f, k + 1)[c];
    return (a - angle) * (b - angle) <= 0 && a != b;
}

/* Which part of the way from k to k + 1 that is, of which the chord says `part`. */
static double part_at(rg_fold *f, int32_t k, int32_t c, double angle, double part)
{
    bracket on = {0, rg_fold_state(f, k)[c] - angle, 1, rg_fold_state(f, k + 1)[c] - angle};
    double x = part;
    for (int32_t n = 0; n < SECANTS && is_smooth(f) && follow(f, k, x); n++) {
        const double off = f->guess[c] - angle;
        if (fabs(off) <= SAME_PLACE) break;
        narrow(&on, x, off);
        x = next_guess(&on, n);
    }
    return x;
}

static rg_status stand_at_angle(rg_fold *f, int32_t k, int32_t c, double angle)
{
    const double a = rg_fold_state(f, k)[c], b = rg_fold_state(f, k + 1)[c], part = (angle - a) / (b - a);
    if (angle == a || angle == b) {
        rg_fold_stand(f, angle == a ? k : k + 1);
        return RG_OK;
    }
    int found;
    const rg_status s = find_on_path(f, k, c, angle, &found);
    rg_between *way = s == RG_OK ? way_between(f, k) : NULL;
    if (!way) return RG_ENOMEM;
    if (found) { /* and by rounding to the angle itself */
        const rg_motion_state here = {f->rho, f->flat, k, 1};
        const double closure = rg_between_at(way, &here, &here, 0, c, angle);
        if (!isnan(closure)) stand_between(f, way, k, part, closure);
        return RG_OK;
    }
    stand_between(f, way, k, part, at_part(f, way, k, part_at(f, k, c, angle, part), c, angle));
    return RG_OK;
}

rg_status rg_fold_go_to_angle(rg_fold *f, int32_t c, double angle)
{
    if (c < 0 || c >= rg_fold_mesh(f)->N || !isfinite(angle)) return RG_EARG;
    for (int32_t k = f->at;; k++) {
        if (k == rg_fold_states(f) - 1 && rg_fold_has_more(f)) rg_fold_advance(f);
        if (k == rg_fold_states(f) - 1) break;
        if (passes(f, k, c, angle)) return stand_at_angle(f, k, c, angle);
    }
    for (int32_t k = f->at - 1; k >= 0; k--)
        if (passes(f, k, c, angle)) return stand_at_angle(f, k, c, angle);
    rg_fold_look(f); /* more of the track may be known now */
    return RG_EARG;
}

/* ------------------------------------------------------------------------------------- the present state ---- */

const rg_motion *rg_fold_motion(const rg_fold *f) { return f->shared->motion; }

const double *rg_fold_angles(const rg_fold *f, int32_t *creases)
{
    if (creases) *creases = rg_fold_mesh(f)->N;
    return f->rho;
}

const double (*rg_fold_positions(const rg_fold *f, int32_t *vertices))[3]
{
    if (vertices) *vertices = rg_fold_mesh(f)->nv;
    return (const double(*)[3])f->x;
}

const double (*rg_fold_flat(const rg_fold *f, int32_t *vertices))[2]
{
    if (vertices) *vertices = rg_fold_mesh(f)->nv;
    return (const double(*)[2])f->flat;
}

const rg_transform *rg_fold_transforms(const rg_fold *f, int32_t *facets)
{
    if (facets) *facets = rg_fold_mesh(f)->nf;
    return (const rg_transform *)(const void *)f->place;
}
