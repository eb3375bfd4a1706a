#include "fold/relax.h"
#include "fold/tuning.h"

#include <stdio.h>
#include <string.h>

static double way(const rg_relax *F, int32_t i) { return F->target[i] - F->from[i]; }
static int is_driven(const rg_relax *F, int32_t i) { return F->slope[i] != 0; }

static void stop(rg_relax *F, const char *why);

/* -------------------------------------------------------------------------------------------- making one ---- */

/* Mean part of the creases' ways, none counted for more than the whole of it: who goes too far may come back. */
static double progress(const rg_relax *F, const double *rho, double *least)
{
    double sum = 0;
    *least = F->driven ? INFINITY : 1;
    for (int32_t i = 0; i < F->N; i++) {
        if (!is_driven(F, i)) continue;
        const double part = fmin(1, (rho[i] - F->from[i]) * F->slope[i]);
        sum += part;
        *least = fmin(*least, part);
    }
    return F->driven ? sum / F->driven : 1;
}

static rg_status make_room(rg_relax *F)
{
    const size_t N = (size_t)F->N, n = (size_t)F->n;
    F->room = (int32_t)fmin(MOST_NODES, MOST_STEPS / F->share) + 2 * END_NODES + 6;
    const size_t room = (size_t)F->room;
    double **of_creases[] = {&F->from, &F->target, &F->slope, &F->end, &F->pull};
    double **of_both[] = {&F->z, &F->trial, &F->wish, &F->dz, &F->scale, &F->chord, &F->g, &F->t};
    int ok = (F->held = rg_mem_array(&F->mem, N, 1)) != NULL;
    ok &= (F->node = rg_mem_array(&F->mem, room * n, sizeof *F->node)) != NULL;
    ok &= (F->node_s = rg_mem_array(&F->mem, room, sizeof *F->node_s)) != NULL;
    ok &= (F->spare = rg_mem_array(&F->mem, (size_t)F->mesh.nv, sizeof *F->spare)) != NULL;
    for (int i = 0; i < 5; i++) ok &= (*of_creases[i] = rg_mem_array(&F->mem, N, sizeof(double))) != NULL;
    for (int i = 0; i < 8; i++) ok &= (*of_both[i] = rg_mem_array(&F->mem, n, sizeof(double))) != NULL;
    return ok ? RG_OK : RG_ENOMEM;
}

static void add_node(rg_relax *F, const double *z, double s)
{
    memcpy(F->node + (size_t)F->nodes * (size_t)F->n, z, (size_t)F->n * sizeof *z);
    F->node_s[F->nodes++] = s;
}

/* Is every crease flat or at half a turn? Closure is of second order there. */
static int is_singular(const double *rho, int32_t N)
{
    for (int32_t i = 0; i < N; i++)
        if (rho[i] != 0 && !(fabs(fabs(rho[i]) - RG_PI) <= END_OFF)) return 0;
    return 1;
}

rg_status rg_relax_init(rg_relax *F, const rg_mesh *m, const rg_settings *s, const rg_relaxation *how, const double *from,
                        const double *target)
{
    const rg_memory mem = rg_mem_default(s->memory);
    memset(F, 0, sizeof *F);
    F->mem = mem;
    F->mesh = *m;
    m = &F->mesh;
    F->how = *how;
    F->step = fmin(s->step, MOST_STEP);
    F->share = fmin(1, F->step / USUAL_STEP);
    F->foresees = 1;
    F->tol = s->tol;
    F->s_end = fabs(s->to);
    F->N = m->N;
    rg_status status = rg_freedom_init(&F->freedom, &mem, m, how->gain > 0 || how->compliance > 0);
    F->U = F->freedom.U;
    F->n = F->N + F->U;
    if (status == RG_OK) status = rg_coupled_init(&F->J, &mem, m, &F->freedom, how->kawasaki);
    if (status == RG_OK) status = rg_adjust_init(&F->adjust, &mem, &F->freedom);
    if (status == RG_OK) status = rg_limit_init(&F->limit, &mem, m);
    if (status == RG_OK) status = make_room(F);
    if (status != RG_OK) {
        rg_relax_free(F);
        return status;
    }
    if (from) memcpy(F->from, from, (size_t)F->N * sizeof *from);
    memcpy(F->target, target, (size_t)F->N * sizeof *target);
    for (int32_t i = 0; i < F->U; i++) F->scale[F->N + i] = fmax(how->compliance, 1e-6) * F->freedom.reach[i];
    for (int32_t i = 0; i < F->N; i++) F->end[i] = isnan(F->target[i]) ? F->from[i] : F->target[i];
    F->end_is_closed = rg_relax_close_on_pattern(F, F->end);
    int closes = 1;
    for (int32_t i = 0; i < F->N && closes > 0; i++) closes = F->from[i] == 0 ? closes : -1;
    if (closes < 0 && !rg_relax_close_on_pattern(F, F->from)) stop(F, "the state to start from does not close");
    memcpy(F->z, F->from, (size_t)F->N * sizeof *F->z);
    F->from_is_singular = is_singular(F->from, F->N);
    for (int32_t i = 0; i < F->N; i++) {
        F->slope[i] = isnan(F->target[i]) || way(F, i) == 0 ? 0 : 1 / way(F, i);
        F->driven += is_driven(F, i);
    }
    add_node(F, F->z, 0);
    F->h = 1;
    return RG_OK;
}

rg_status rg_relax_keep(rg_relax *F, const rg_symmetry *G)
{
    F->symmetry = G;
    F->by_orbits = OF_THE_DRAWING * G->off <= F->tol;
    const rg_status s = F->by_orbits ? rg_orbits_init(&F->orbits, &F->J, G) : RG_OK;
    if (s != RG_OK) F->symmetry = NULL;
    return s;
}

void rg_relax_free(rg_relax *F)
{
    if (!F->mem.resize) return;
    rg_orbits_free(&F->orbits);
    rg_freedom_free(&F->freedom);
    rg_coupled_free(&F->J);
    rg_adjust_free(&F->adjust);
    rg_limit_free(&F->limit);
    void *block[] = {F->from, F->target, F->slope, F->end, F->pull, F->z, F->trial, F->wish, F->dz, F->scale, F->chord,
                     F->g, F->t, F->held, F->node, F->node_s, F->spare};
    for (int i = 0; i < 17; i++) rg_mem_free(&F->mem, block[i]);
    memset(F, 0, sizeof *F);
}

/* A step, or a state before it is closed: what the symmetry leaves of it. Of steps that an even state allows the mean is allowed
 * as well. */
static void even_out(rg_relax *F, double *z)
{
    if (!F->symmetry) return;
    rg_symmetry_mean(F->symmetry, z);
    rg_freedom_mean(&F->freedom, F->symmetry, z + F->N, F->spare);
}

/* -------------------------------------------------- the constraint; evenly: one of each orbit, if that tells all ---- */

static double assemble(rg_relax *F, const double *z, int evenly, double *off)
{
    F->assemblies++;
    return evenly && F->by_orbits ? rg_orbits_assemble(&F->orbits, z, z + F->N, off) : rg_coupled_assemble(&F->J, z, z + F->N, off);
}

static void renew(rg_relax *F, int evenly, double damping)
{
    const int by_orbits = evenly && F->by_orbits;
    const rg_least *A = by_orbits ? &F->orbits.A : &F->J.A;
    /* A factorisation is worth its flops; filling and solving go with the entries. */
    F->work += 1.5e-9 * A->L.S.flops + 6e-7 * A->start[A->columns];
    for (int32_t i = 0; evenly && i < F->N; i++) F->scale[i] = F->scale[F->symmetry->crease_orbit[i]];
    F->orbits.A.damping = F->J.A.damping = damping;
    if (by_orbits) rg_orbits_renew(&F->orbits, F->scale);
    else rg_coupled_renew(&F->J, F->scale);
}

/* x = A^+ (A y + r) in scaled unknowns; y, r NULL: nothing. eqs. (14), (15), (19) */
static void solve(rg_relax *F, int evenly, const double *y, const double *r, double *x)
{
    double *b = F->J.A.q;
    if (evenly && F->by_orbits) {
        rg_orbits_solve(&F->orbits, y, r, x);
        return;
    }
    if (y) rg_least_mul(&F->J.A, y, b);
    for (int32_t i = 0; r && i < F->J.A.rows; i++) F->J.r[i] = r[i] + (y ? b[i] : 0);
    for (int32_t i = 0; !r && i < F->J.A.rows; i++) F->J.r[i] = b[i];
    rg_least_solve(&F->J.A, F->J.r, x);
}

/* ---------------------------------------------------------------------------------------------- closing ---- */

/* Works off r and r' as assembled, to first order: eqs. (14), (19) with no wish. */
static void correct_once(rg_relax *F, double *z, int evenly)
{
    renew(F, evenly, F->damping * F->closure);
    solve(F, evenly, NULL, F->J.r, F->dz);
    for (int32_t i = 0; i < F->n; i++) F->dz[i] *= F->scale[i];
    if (evenly && !F->by_orbits) even_out(F, F->dz);
    for (int32_t i = 0; i < F->n; i++) z[i] -= F->dz[i];
}

static void stiffen(rg_relax *F, double by)
{
    for (int32_t i = 0; i < F->N; i++) F->scale[i] *= by;
}

/* F->t: what A leaves over of the slope of progress at z, F->g, in scaled unknowns; A is renewed. Returns how much that is. */
static double project_slope(rg_relax *F, const double *z, int evenly)
{
    double left = 0, all = 0;
    for (int32_t i = 0; i < F->n; i++) {
        const int counts = i < F->N && is_driven(F, i) && (z[i] - F->from[i]) * F->slope[i] < 1;
        F->g[i] = counts ? F->scale[i] * F->slope[i] / F->driven : 0;
    }
    solve(F, evenly, F->g, NULL, F->t);
    for (int32_t i = 0; i < F->n; i++) {
        F->t[i] = F->g[i] - F->t[i];
        left += F->t[i] * F->g[i];
        all += F->g[i] * F->g[i];
    }
    return left > LEAST_LEFT * all ? left : 0;
}

/* Works off r and what progress is off s by, as one more row: eq. (14), with the wish along the part of the slope of progress
 * that the constraint leaves over. */
static void correct_held(rg_relax *F, double s, double *z, int evenly)
{
    double least, along = 0;
    renew(F, evenly, F->damping * F->closure);
    solve(F, evenly, NULL, F->J.r, F->dz);
    const double left = project_slope(F, z, evenly);
    for (int32_t i = 0; i < F->n; i++) along += F->g[i] * F->dz[i];
    const double by = left > 0 ? (s - progress(F, z, &least) + along) / left : 0;
    for (int32_t i = 0; i < F->n; i++) F->dz[i] = F->scale[i] * (by * F->t[i] - F->dz[i]);
    if (evenly && !F->by_orbits) even_out(F, F->dz);
    for (int32_t i = 0; i < F->n; i++) z[i] += F->dz[i];
}

/* Part f of the chord from z, which a correction may change by so much, radians; NULL: by anything. */
typedef struct leash { double f, farthest; } leash;

static int is_within(const rg_relax *F, const leash *by)
{
    double far = 0;
    for (int32_t i = 0; by && i < F->N; i++) far = fmax(far, fabs(F->trial[i] - F->z[i] - by->f * F->chord[i]));
    return !by || far <= by->farthest;
}

/* The same until it closes, s NAN: whatever becomes of progress. Zero: it does not close, or not within its leash. What a drawing is
 * uneven by is left to each vertex, where even corrections get no further. */
static int correct(rg_relax *F, double *z, double s, int32_t most, const leash *by)
{
    double before = INFINITY;
    int poor = 0, evenly = F->symmetry != NULL, closes = 0, stiff = 0;
    for (int32_t n = 0;; n++) {
        double off;
        F->closure = assemble(F, z, evenly, &off);
        closes = F->closure <= F->tol && off <= F->tol;
        if (closes || n >= most || !(F->closure <= 2.5) || !is_within(F, by)) break;
        if (evenly && F->closure > STILL_CLOSES * before) {
            evenly = F->by_orbits;
            if (!stiff && F->U > 0) stiffen(F, STIFF);
            stiff = F->U > 0;
        }
        poor = F->closure > 0.7 * before && F->closure > 100 * F->tol ? poor + 1 : 0;
        if (poor >= 3) break;
        before = F->closure;
        if (isnan(s)) correct_once(F, z, evenly);
        else correct_held(F, s, z, evenly);
    }
    if (stiff) stiffen(F, 1 / STIFF);
    return closes && is_within(F, by);
}

/* Once more, for z, which closes, to close better; taken back where it does not: near singular states more corrections chase
 * rounding. spare[n]: scratch. */
static void polish(rg_relax *F, double *z, double *spare)
{
    const double before = F->closure;
    const int evenly = F->by_orbits;
    if (before <= CLOSE_ENOUGH * F->tol) return;
    memcpy(spare, z, (size_t)F->n * sizeof *z);
    correct_once(F, z, evenly);
    F->closure = assemble(F, z, evenly, NULL);
    if (F->closure < before) return;
    memcpy(z, spare, (size_t)F->n * sizeof *z);
    F->closure = assemble(F, z, evenly, NULL);
}

int rg_relax_close_on_pattern(rg_relax *F, double *rho)
{
    double *z = F->trial;
    memcpy(z, rho, (size_t)F->N * sizeof *rho);
    memset(z + F->N, 0, (size_t)F->U * sizeof *z);
    if (assemble(F, z, 0, NULL) <= F->tol) return 1;
    for (int32_t i = 0; i < F->N; i++) F->scale[i] = 1;
    for (int32_t i = F->N; i < F->n; i++) F->scale[i] *= FIXED;
    int closed = correct(F, z, NAN, CORRECTIONS, NULL);
    for (int32_t i = F->N; i < F->n; i++) F->scale[i] /= FIXED;
    memset(z + F->N, 0, (size_t)F->U * sizeof *z);
    closed = closed && assemble(F, z, 0, NULL) <= F->tol;
    for (int32_t i = 0; i < F->N; i++) closed = closed && fabs(z[i] - rho[i]) <= END_OFF;
    if (closed) memcpy(rho, z, (size_t)F->N * sizeof *rho);
    return closed;
}

/* ----------------------------------------------------------------------------------------------- a step ---- */

static int is_limited(const rg_relax *F) { return F->s >= FREE_UNTIL; }

static void make_wish(rg_relax *F)
{
    const double ds = F->step * F->h / RG_PI, part = F->share; /* ways back are paced by the step, too */
    rg_limit_pull(&F->limit, F->z, F->pull);
    for (int32_t i = 0; i < F->N; i++) {
        F->scale[i] = 1;
        F->held[i] = 0;
        F->wish[i] = 0;
        if (isnan(F->target[i]) || i >= F->limit.first_added) {
            F->wish[i] = BACK * part * F->pull[i];
            continue;
        }
        const double left = F->target[i] - F->z[i], all = way(F, i);
        const int on_the_way = left * all > 0 && fabs(left) > NEAR;
        F->wish[i] = on_the_way ? ds * all : NEAR_PART * F->h * left;
        if (F->s >= WRONG_FROM && left * all > 0 && fabs(left) > fabs(all)) F->scale[i] = WRONG_GIVES;
        if (is_limited(F) && F->pull[i] != 0) {
            F->wish[i] = BACK * part * F->pull[i];
            F->scale[i] = BEYOND_GIVES;
        }
    }
    rg_freedom_room(&F->freedom, F->J.X, LEAST_AREA, F->wish + F->N);
    for (int32_t i = F->N; i < F->n; i++)
        F->scale[i] = fmax(F->how.compliance, 1e-6) * F->freedom.reach[i - F->N] * sqrt(fmax(LEAST_READY * LEAST_READY, F->wish[i]));
    rg_adjust_wish(&F->adjust, F->z, F->how.gain, F->wish + F->N);
    for (int32_t i = F->N; i < F->n; i++) F->wish[i] = RETURN * part * (F->wish[i] - F->z[i]);
}

static void hold(rg_relax *F, int32_t i)
{
    F->held[i] = 1;
    F->scale[i] = HELD_GIVES;
    F->wish[i] = copysign(RG_PI, F->z[i]) - F->z[i];
}

/* Holds the creases that z + dz, or trial where dz is NULL, takes beyond half a turn; how many are new. */
static int32_t hold_what_overfolds(rg_relax *F, const double *dz, double beyond)
{
    int32_t more = 0;
    for (int32_t i = 0; i < F->N && is_limited(F); i++) {
        const double then = dz ? F->z[i] + dz[i] : F->trial[i];
        if (F->held[i] || !(fabs(then) > RG_PI + beyond)) continue;
        hold(F, i);
        more++;
    }
    return more;
}

/* Where dz loses progress: the least change of it that gains some, which is progress as one more row. A is renewed. */
static void keep_gaining(rg_relax *F, int evenly)
{
    const double least = LEAST_GAIN * F->step * F->h / RG_PI, left = project_slope(F, F->z, evenly);
    double gain = 0;
    for (int32_t i = 0; i < F->N; i++) gain += F->g[i] / F->scale[i] * F->dz[i];
    if (!(left > 0 && gain < least)) return;
    for (int32_t i = 0; i < F->n; i++) F->dz[i] += F->scale[i] * (least - gain) / left * F->t[i];
}

/* wish - W A^T (A W A^T)^+ (A wish + r), the columns of A scaled by the root of W: eqs. (14), (19). */
static void project(rg_relax *F, int evenly)
{
    double *y = F->chord;
    renew(F, evenly, 0);
    for (int32_t i = 0; i < F->n; i++) y[i] = F->wish[i] / F->scale[i];
    solve(F, evenly, y, F->J.r, F->dz);
    for (int32_t i = 0; i < F->n; i++) F->dz[i] = F->wish[i] - F->scale[i] * F->dz[i];
    if (is_limited(F)) keep_gaining(F, evenly);
    if (evenly) even_out(F, F->dz);
}

/* Largest change of a crease from a to b. */
static double turned(const rg_relax *F, const double *a, const double *b)
{
    double far = 0;
    for (int32_t i = 0; i < F->N; i++) far = fmax(far, fabs(a[i] - b[i]));
    return far;
}

/* z + f dz, closed, in F->trial: is it a state to go on from? chord keeps dz, as correcting uses dz. */
static int try_step(rg_relax *F, double f, double longest)
{
    const leash by = {f, (is_limited(F) ? FARTHEST_CORRECTION : FARTHEST_AT_START) * f * longest + LITTLE};
    double least;
    for (int32_t i = 0; i < F->n; i++) F->trial[i] = F->z[i] + f * F->chord[i];
    even_out(F, F->trial);
    const double s = progress(F, F->trial, &least);
    if (!correct(F, F->trial, is_limited(F) && s > F->s ? s : NAN, CORRECTIONS, &by)) return 0;
    if (!rg_freedom_room(&F->freedom, F->J.X, LEAST_AREA, NULL)) return 0;
    return !is_limited(F) || progress(F, F->trial, &least) >= F->s;
}

/* Does F->trial go past half a turn farther than F->z does? */
static int goes_beyond(const rg_relax *F)
{
    for (int32_t i = 0; i < F->N && is_limited(F); i++)
        if (!(fabs(F->trial[i]) <= fmax(RG_PI + BEYOND, fabs(F->z[i])))) return 1;
    return 0;
}

void rg_relax_wish_and_step(rg_relax *F)
{
    F->h = 1;
    assemble(F, F->z, 0, NULL);
    make_wish(F);
    project(F, 0);
}

static int close_at(rg_relax *F, const double *a, const double *b, double s, double *z, double *best);

/* Does the path stay on its branch between its states a and b, parts `from` and `to` of the chord from z to trial? Its middle, closed,
 * must lie as near to the chord as a step to its prediction. What is smooth lies a quarter as near to the chord of each half, and so on,
 * while a leap to another branch stays in one of the halves as large as it is. */
static int is_smooth(rg_relax *F, double s, double size, const double *a, double from, const double *b, double to, int32_t halved)
{
    const size_t n = (size_t)F->n;
    double *best = F->node + (size_t)(F->nodes + 1) * n, *middle = best + (size_t)(halved + 1) * n, off = 0, far = 0;
    const double part = (from + to) / 2;
    for (size_t i = 0; i < n; i++) middle[i] = (1 - part) * F->z[i] + part * F->trial[i];
    if (!close_at(F, F->z, F->trial, (1 - part) * F->s + part * s, middle, best)) return 0;
    for (int32_t i = 0; i < F->N; i++) {
        far = fmax(far, fabs(middle[i] - (1 - part) * F->z[i] - part * F->trial[i]));
        off = fmax(off, fabs(middle[i] - (a[i] + b[i]) / 2));
    }
    if (!(far <= FARTHEST_CORRECTION * size / 2 + LITTLE)) return 0;
    if (off <= SMOOTH * size) return 1;
    return halved < MOST_HALVES && is_smooth(F, s, size, a, from, middle, part, halved + 1) &&
           is_smooth(F, s, size, middle, part, b, to, halved + 1);
}

/* Where states between z and trial are not shown to be of one branch, the step is too long. */
static int chord_holds(rg_relax *F)
{
    const size_t n = (size_t)F->n;
    double *scale = F->node + (size_t)F->nodes * n, least;
    if (F->nodes < 2) return 1; /* the path has not begun */
    memcpy(scale, F->scale, n * sizeof *scale);
    const int holds = is_smooth(F, progress(F, F->trial, &least), turned(F, F->z, F->trial), F->z, 0, F->trial, 1, 0);
    memcpy(F->scale, scale, n * sizeof *scale);
    return holds;
}

static int advance(rg_relax *F)
{
    const int evenly = F->symmetry != NULL;
    assemble(F, F->z, evenly, NULL);
    make_wish(F);
    for (int32_t round = 0; round < ROUNDS; round++) {
        const int is_last = round + 1 == ROUNDS;
        if (round) assemble(F, F->z, evenly, NULL);
        project(F, evenly);
        if (!is_last && hold_what_overfolds(F, F->dz, BEYOND / 10)) continue;
        double longest = 0;
        memcpy(F->chord, F->dz, (size_t)F->n * sizeof *F->dz);
        for (int32_t i = 0; i < F->N; i++) longest = fmax(longest, fabs(F->chord[i]));
        if (!(longest > LEAST_STEP)) return 0;
        const double most = 1.5 * F->step * F->h;
        double f = longest > most ? most / longest : 1;
        int32_t halving = 0;
        while (!try_step(F, f, longest) || (is_last && goes_beyond(F)) || !chord_holds(F)) {
            if (++halving > HALVINGS) return 0;
            f /= 2;
        }
        if (!is_last && hold_what_overfolds(F, NULL, BEYOND)) continue;
        F->h = fmax(LEAST_H, fmin(1, 1.3 * F->h * sqrt(f)));
        return 1;
    }
    return 0;
}

/* --------------------------------------------------------------------------------------- starts and ends ---- */

/* Closes F->trial, which a chord or its correction may have taken past half a turn: such creases are put back there and held, and
 * the others make up for it. Zero: it does not close. */
static int close_within_half_turns(rg_relax *F)
{
    for (int32_t i = 0; i < F->N; i++) F->scale[i] = 1;
    for (int32_t round = 0; round < ROUNDS; round++) {
        int32_t held = 0;
        if (!correct(F, F->trial, NAN, CORRECTIONS_AT_END, NULL)) return 0;
        for (int32_t i = 0; i < F->N && is_limited(F); i++) {
            if (!(fabs(F->trial[i]) > RG_PI + BEYOND / 10)) continue;
            F->trial[i] = copysign(RG_PI, F->trial[i]);
            F->scale[i] = HELD_GIVES;
            held++;
        }
        if (!held) return 1;
    }
    return correct(F, F->trial, NAN, CORRECTIONS_AT_END, NULL);
}

/* Nodes from z down to the singular state `at`, nearer and nearer: what closes there is homogeneous, u of second order where rho
 * is of first. node, s: out, the nearest last. Zero: the branch of z does not lead there. */
static int approach(rg_relax *F, const double *z, const double *at, double *node, double *s)
{
    double least;
    const double *last = z;
    for (int32_t k = 0; k < END_NODES; k++, node += F->n) {
        for (int32_t i = 0; i < F->N; i++) F->trial[i] = at[i] + NEARER * (last[i] - at[i]);
        for (int32_t i = F->N; i < F->n; i++) F->trial[i] = NEARER * NEARER * last[i];
        even_out(F, F->trial);
        memcpy(F->chord, F->trial, (size_t)F->n * sizeof *F->trial);
        const double size = turned(F, last, at);
        const int closed = close_within_half_turns(F);
        if (!closed) return 0;
        if (!(turned(F, F->trial, F->chord) <= FARTHEST_CORRECTION * NEARER * size)) return 0;
        polish(F, F->trial, F->chord);
        memcpy(node, F->trial, (size_t)F->n * sizeof *node);
        s[k] = progress(F, node, &least);
        last = node;
    }
    return 1;
}

static void swap_nodes(rg_relax *F, int32_t a, int32_t b)
{
    double *x = F->node + (size_t)a * (size_t)F->n, *y = F->node + (size_t)b * (size_t)F->n, s = F->node_s[a];
    for (int32_t i = 0; i < F->n; i++) {
        const double t = x[i];
        x[i] = y[i];
        y[i] = t;
    }
    F->node_s[a] = F->node_s[b];
    F->node_s[b] = s;
}

/* The first state past the free start that keeps the limits begins the path: from the start straight to it. Where both a way
 * of first and one of second order lie near a singular start, the nodes tell which is which. */
static int begin_path(rg_relax *F)
{
    for (int32_t i = 0; i < F->N; i++)
        if (!(fabs(F->z[i]) <= RG_PI + BEYOND)) return 0;
    if (!is_limited(F)) return 0;
    if (F->from_is_singular) {
        if (!approach(F, F->z, F->from, F->node + F->n, F->node_s + 1)) return 0;
        F->nodes += END_NODES;
        for (int32_t a = 1, b = END_NODES; a < b; a++, b--) swap_nodes(F, a, b);
        for (int32_t k = 1; k < F->nodes; k++)
            if (!(F->node_s[k] >= F->node_s[k - 1])) F->node_s[k] = F->node_s[k - 1];
    }
    add_node(F, F->z, F->s);
    return 1;
}

static int has_returned(const rg_relax *F)
{
    for (int32_t i = 0; i < F->U; i++)
        if (!(fabs(F->z[F->N + i]) <= RETURNED * F->freedom.reach[i])) return 0;
    return 1;
}

static void stop(rg_relax *F, const char *why)
{
    double least;
    progress(F, F->z, &least);
    const int arrived = least >= 1 - ARRIVED && F->s_end >= 1 && F->nodes > 1, moved = arrived && !has_returned(F);
    F->outcome = arrived && !moved ? RG_FOLDED : RG_STOPPED;
    snprintf(F->reason, sizeof F->reason, "%s", moved ? "folded, but with no way back to the pattern given" : why);
}

/* The folded state itself, where everything is near it and the branch leads there. */
static int land(rg_relax *F, double least)
{
    if (F->s_end < 1 || !(least >= 1 - LANDS_FROM) || !has_returned(F) || F->nodes < 2) return 0;
    for (int32_t i = 0; i < F->N; i++)
        if (!isnan(F->target[i]) && !(fabs(F->z[i] - F->target[i]) <= F->step)) return 0;
    double *node = F->node + (size_t)F->nodes * (size_t)F->n;
    if (F->end_is_closed && approach(F, F->z, F->end, node, F->node_s + F->nodes)) {
        for (int32_t k = 0; k < END_NODES; k++, F->nodes++)
            if (!(F->node_s[F->nodes] >= F->node_s[F->nodes - 1])) F->node_s[F->nodes] = F->node_s[F->nodes - 1];
        memcpy(F->z, F->end, (size_t)F->N * sizeof *F->z);
        memset(F->z + F->N, 0, (size_t)F->U * sizeof *F->z);
        F->s = 1;
        add_node(F, F->z, F->s);
        F->landed = 1;
    } else if (F->end_is_closed && F->share * F->idle <= MOST_IDLE) {
        return 0;
    }
    stop(F, F->landed ? "folded" : "folded, as far as the pattern closes at its end");
    return 1;
}

static void accept(rg_relax *F)
{
    double least;
    memcpy(F->z, F->trial, (size_t)F->n * sizeof *F->z);
    F->s = progress(F, F->z, &least);
    F->idle++;
    if (F->s > F->best_s + BETTER_MEAN || least > F->best_least + BETTER_LEAST) F->idle = 0;
    if (F->s > F->best_s + BETTER_MEAN) F->best_s = F->s;
    if (least > F->best_least + BETTER_LEAST) F->best_least = least;
    if (F->nodes == 1) begin_path(F);
    else add_node(F, F->z, F->s);
}

/* Has it fallen behind an even pace from its start to the last step that there may be? */
static int is_slow(const rg_relax *F)
{
    return F->share * F->steps - SLOW_FROM > F->s / F->s_end * (MOST_STEPS - SLOW_FROM);
}

/* Is the work that there is too little, if every step is to make as much progress as it wishes for? */
static int will_run_out(const rg_relax *F)
{
    const double more = (F->s_end - F->s) * RG_PI / F->step;
    return F->budget > 0 && F->steps > KNOWN_FROM && F->work * (1 + more / F->steps) > F->budget / F->share;
}

void rg_relax_go_on(rg_relax *F, double work)
{
    F->waits = F->foresees = 0;
    F->budget = F->work + work;
    F->outcome = RG_RUNNING;
}

void rg_relax_step(rg_relax *F)
{
    double least;
    if (F->outcome != RG_RUNNING) return;
    F->steps++;
    progress(F, F->z, &least);
    if (F->driven == 0 || F->s_end == 0) {
        F->s = F->s_end;
        add_node(F, F->z, F->s);
        F->outcome = RG_FOLDED;
        snprintf(F->reason, sizeof F->reason, "nothing to fold");
    } else if (F->s >= F->s_end && F->s_end < 1 && F->nodes > 1) {
        F->outcome = RG_FOLDED;
        snprintf(F->reason, sizeof F->reason, "as far as was asked for");
    } else if (land(F, least)) {
        return;
    } else if (F->nodes + END_NODES + 4 > F->room || (F->budget > 0 && F->work > F->budget / F->share)) {
        stop(F, "the effort ran out");
    } else if (F->foresees && (is_slow(F) || will_run_out(F))) {
        F->waits = 1;
        stop(F, "the effort would run out");
    } else if (!advance(F)) {
        stop(F, "the facets leave no way on");
    } else {
        accept(F);
        if (F->how.farthest > 0 && F->nodes > 1 && rg_freedom_farthest(&F->freedom, F->z + F->N) > F->how.farthest)
            stop(F, "it moves the pattern farther than one that folds");
        else if (F->share * F->idle > MOST_IDLE) stop(F, "no motion that the facets allow folds any further");
    }
}

/* --------------------------------------------------------------------------------------------- reading off ---- */

/* The last node with progress at most s, and not the last of all. */
static int32_t node_before(const rg_relax *F, double s)
{
    int32_t low = 0, high = F->nodes - 1;
    while (high - low > 1) {
        const int32_t middle = (low + high) / 2;
        if (F->node_s[middle] <= s) low = middle;
        else high = middle;
    }
    return low;
}

/* Creases past half a turn, farther than they are at a and b, are put back and give way less than the others. What is allowed there is
 * allowed between, else states near them would not come nearer to them. */
static void put_back(rg_relax *F, const double *a, const double *b, double *z)
{
    for (int32_t i = 0; i < F->N; i++) {
        const double most = fmax(RG_PI, fmax(fabs(a[i]), fabs(b[i]))) + BEYOND / 10;
        if (!(fabs(z[i]) > most)) continue;
        z[i] = copysign(most, z[i]);
        F->scale[i] = HELD_GIVES;
    }
}

/* z, between nodes a and b, closed as well as rounding lets it, at progress s; s NAN: whatever becomes of progress. best[n]: scratch.
 * Zero: it does not close. */
static int close_at(rg_relax *F, const double *a, const double *b, double s, double *z, double *best)
{
    double least_closure = INFINITY, before = INFINITY, off, least;
    int evenly = F->symmetry != NULL;
    for (int32_t i = 0; i < F->N; i++) F->scale[i] = 1;
    for (int32_t i = F->N; i < F->n; i++) F->scale[i] = fmax(F->how.compliance, 1e-6) * F->freedom.reach[i - F->N];
    F->damping = DAMPING;
    for (int32_t n = 0; n < CORRECTIONS_AT_END; n++) {
        put_back(F, a, b, z);
        const double closure = F->closure = assemble(F, z, evenly, &off);
        if (!(closure <= 2.5)) break;
        if (off <= F->tol && (isnan(s) || fabs(progress(F, z, &least) - s) <= SAME_PROGRESS)) {
            const int no_better = closure <= F->tol && closure > 0.5 * least_closure;
            if (closure < least_closure) {
                memcpy(best, z, (size_t)F->n * sizeof *z);
                least_closure = closure;
            }
            if (closure <= CLOSE_ENOUGH * F->tol || no_better) break;
        }
        if (evenly && !F->by_orbits && closure > STILL_CLOSES * before) {
            evenly = 0;
            if (F->U > 0) stiffen(F, STIFF);
        }
        before = closure;
        if (isnan(s)) correct_once(F, z, evenly);
        else correct_held(F, s, z, evenly);
    }
    F->damping = 0;
    if (!(least_closure <= F->tol)) return 0;
    memcpy(z, best, (size_t)F->n * sizeof *z);
    F->closure = least_closure;
    return 1;
}

/* Part t of the chord from node k to the next one. */
static void take_chord(rg_relax *F, int32_t k, double t, double *z)
{
    const double *a = F->node + (size_t)k * (size_t)F->n, *b = a + F->n;
    const int at_start = k == 0 && F->from_is_singular, at_end = F->landed && k == F->nodes - 2;
    for (int32_t i = 0; i < F->n; i++) {
        const double part = i < F->N ? t : at_start ? t * t : at_end ? 1 - (1 - t) * (1 - t) : t;
        z[i] = (1 - part) * a[i] + part * b[i];
    }
    even_out(F, z);
}

double rg_relax_at(rg_relax *F, double s, double *z)
{
    const size_t n = (size_t)F->n;
    const int32_t last = F->nodes - 1, k = last > 0 ? node_before(F, s) : 0;
    const double s0 = F->node_s[k], s1 = last > 0 ? F->node_s[k + 1] : s0;
    const double t = s >= F->node_s[last] ? 1 : s1 > s0 ? fmin(1, fmax(0, (s - s0) / (s1 - s0))) : 1;
    if (t > 0 && t < 1) {
        const double *a = F->node + (size_t)k * n;
        take_chord(F, k, t, z);
        if (close_at(F, a, a + n, s0 + t * (s1 - s0), z, F->trial)) return F->closure;
        take_chord(F, k, t, z);
        if (close_at(F, a, a + n, NAN, z, F->trial)) return F->closure;
    }
    /* A node, closed as it is; or the nearer one, where nothing between closes. */
    const int32_t at = s >= F->node_s[last] ? last : last > 0 && t >= 0.5 ? k + 1 : k;
    memcpy(z, F->node + (size_t)at * n, n * sizeof *z);
    return assemble(F, z, 0, NULL);
}
