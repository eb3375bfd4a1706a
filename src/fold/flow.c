#include "fold/flow.h"

#include <stdio.h>
#include <string.h>

/* Progress below which creases may be beyond a limit or on the wrong side: the flat start, where the linear step must be
 * free to be wrong for a moment. */
static const double FREE_UNTIL = 0.03, WRONG_FROM = 0.02;
/* A crease this near its target (radians) slows down; how much of what is left it wishes for in a full step. */
static const double NEAR = 0.03, NEAR_PART = 0.9;
/* Part of the way back to where it wishes to be that the pattern goes in a step. */
static const double RETURN = 0.5;
/* What a held crease gives way, against any other; how far beyond half a turn one may be, radians. */
static const double HELD_GIVES = 3e-4, BEYOND = 0.05 * RG_DEG;
/* How readily a crease beyond its limit gives way, and the part of the way back it wishes for. */
static const double BEYOND_GIVES = 0.1, BACK = 0.3;
/* So many halvings end, from flat paper, in a step so short that it closes to tolerance as it is: what is wrong with its
 * direction is of second order there, and is worked off by the steps that follow. */
static const int32_t ROUNDS = 6, HALVINGS = 16, CORRECTIONS = 12;
/* Whatever step is asked for: a longer one would find closed states that nothing leads to. */
static const double MOST_STEP = 10 * RG_DEG;
/* Below this progress no crease has won or lost. */
static const double AT_FLAT = 0.005;
/* No facet shrinks below this part of its area. */
static const double LEAST_AREA = 0.1;
/* A correction this much longer than the step it corrects, plus a little, has left the branch. */
static const double FARTHEST_CORRECTION = 0.7, LITTLE = 1e-3;
/* Even corrections go on while each leaves at most this part of what was open: they converge quadratically until what is left is
 * what the drawing is uneven by. That is then closed plainly, with creases that give way this much less than the vertices:
 * those move by what the drawing is off, too little to be seen, while near flat creases would turn by its square root. */
static const double STILL_CLOSES = 0.1, STIFF = 0.01;
static const double LEAST_STEP = 1e-7, LEAST_H = 1e-4;
/* A run that for so many steps betters neither the mean nor the least by so much is stuck. */
static const int32_t MOST_IDLE = 80, MOST_STEPS = 1500;
static const double BETTER_MEAN = 0.002, BETTER_LEAST = 0.01;
/* Where the signs are judged, and how much louder the losers are asked. */
static const double JUDGED_AT = 0.2, LOUDER = 1.6;
/* Arrived: every crease within this part of its way, the pattern within that part of its reach. */
static const double ARRIVED = 0.007, RETURNED = 0.05;
/* Exactness of the progress of a state that is asked for, and how often it is looked for. */
static const double SAME_PROGRESS = 1e-5;
static const int32_t SECANTS = 5;
/* Part of the tolerance that it is closed to. */
static const double CLOSE_ENOUGH = 0.01;

/* Ways of the pattern that count as none; and how far from where it should be a crease may end for the pattern to close. */
static const double FIXED = 1e-12, END_OFF = 1 * RG_DEG;

static double way(const rg_flow *F, int32_t i) { return F->target[i] - F->from[i]; }
static int is_driven(const rg_flow *F, int32_t i) { return way(F, i) != 0 && !isnan(F->target[i]); }

static int correct(rg_flow *F, double *rho, double *u);
static void stop(rg_flow *F, const char *why);

/* rho, which should close on the pattern given, closed on it: a drawing's rounding is made up for by the creases, a
 * little. Zero: it is off by more than that. */
static int close_on_pattern(rg_flow *F, double *rho)
{
    memcpy(F->trial, rho, (size_t)F->N * sizeof *rho);
    memset(F->trial_u, 0, (size_t)F->U * sizeof *F->trial_u);
    if (rg_joint_assemble(&F->J, rho, F->trial_u, NULL) <= F->tol) return 1;
    for (int32_t i = 0; i < F->N; i++) F->scale[i] = 1;
    for (int32_t i = 0; i < F->U; i++) F->scale[F->N + i] *= FIXED;
    int closed = correct(F, F->trial, F->trial_u);
    for (int32_t i = 0; i < F->U; i++) F->scale[F->N + i] /= FIXED;
    memset(F->trial_u, 0, (size_t)F->U * sizeof *F->trial_u);
    closed = closed && rg_joint_assemble(&F->J, F->trial, F->trial_u, NULL) <= F->tol;
    for (int32_t i = 0; i < F->N; i++) closed = closed && fabs(F->trial[i] - rho[i]) <= END_OFF;
    if (closed) memcpy(rho, F->trial, (size_t)F->N * sizeof *rho);
    return closed;
}

static double progress(const rg_flow *F, const double *rho, double *least)
{
    double sum = 0;
    *least = F->driven ? INFINITY : 1;
    for (int32_t i = 0; i < F->N; i++) {
        if (!is_driven(F, i)) continue;
        const double part = (rho[i] - F->from[i]) / way(F, i);
        sum += part;
        *least = fmin(*least, part);
    }
    return F->driven ? sum / F->driven : 1;
}

rg_status rg_flow_init(rg_flow *F, const rg_mesh *m, const rg_settings *s, const rg_flow_law *law, const double *from,
                       const double *target)
{
    const rg_memory mem = rg_mem_default(s->memory);
    memset(F, 0, sizeof *F);
    F->mem = mem;
    F->mesh = m;
    F->law = *law;
    F->step = fmin(s->step, MOST_STEP);
    F->tol = s->tol;
    F->s_end = fabs(s->to);
    F->N = m->N;
    rg_status status = rg_freedom_init(&F->freedom, &mem, m, law->gain > 0 || law->give > 0);
    F->U = F->freedom.U;
    if (status == RG_OK) status = rg_joint_init(&F->J, &mem, m, &F->freedom, law->kawasaki);
    if (status == RG_OK) status = rg_adjust_init(&F->adjust, &mem, &F->freedom);
    if (status == RG_OK) status = rg_limit_init(&F->limit, &mem, m);
    const size_t n = (size_t)F->N, u = (size_t)F->U;
    double **of_creases[] = {&F->from, &F->target, &F->end, &F->rho, &F->old_rho, &F->trial, &F->loud, &F->pull};
    double **of_ways[] = {&F->u, &F->old_u, &F->trial_u};
    double **of_both[] = {&F->wish, &F->z, &F->scale, &F->dz};
    int ok = (F->held = rg_mem_array(&mem, n, 1)) != NULL;
    ok &= (F->spare = rg_mem_array(&mem, (size_t)m->nv, sizeof *F->spare)) != NULL;
    for (int i = 0; i < 8; i++) ok &= (*of_creases[i] = rg_mem_array(&mem, n, sizeof(double))) != NULL;
    for (int i = 0; i < 3; i++) ok &= (*of_ways[i] = rg_mem_array(&mem, u, sizeof(double))) != NULL;
    for (int i = 0; i < 4; i++) ok &= (*of_both[i] = rg_mem_array(&mem, n + u, sizeof(double))) != NULL;
    if (status == RG_OK && !ok) status = RG_ENOMEM;
    if (status != RG_OK) {
        rg_flow_free(F);
        return status;
    }
    if (from) memcpy(F->from, from, n * sizeof *from);
    memcpy(F->target, target, n * sizeof *target);
    F->from_flat = 1;
    for (int32_t i = 0; i < F->U; i++) F->scale[F->N + i] = fmax(law->give, 1e-6) * F->freedom.reach[i];
    for (int32_t i = 0; i < F->N; i++) {
        F->from_flat &= F->from[i] == 0;
        F->end[i] = isnan(F->target[i]) ? F->from[i] : F->target[i];
        F->loud[i] = 1;
    }
    F->end_is_closed = close_on_pattern(F, F->end);
    memcpy(F->rho, F->from, n * sizeof *from);
    if (!F->from_flat && !close_on_pattern(F, F->rho)) stop(F, "the state to start from does not close");
    memcpy(F->from, F->rho, n * sizeof *from);
    memcpy(F->old_rho, F->rho, n * sizeof *from);
    for (int32_t i = 0; i < F->N; i++) F->driven += is_driven(F, i);
    F->h = 1;
    return RG_OK;
}

void rg_flow_free(rg_flow *F)
{
    if (!F->mem.resize) return;
    rg_freedom_free(&F->freedom);
    rg_joint_free(&F->J);
    rg_adjust_free(&F->adjust);
    rg_limit_free(&F->limit);
    void *block[] = {F->from, F->target, F->end, F->rho, F->old_rho, F->trial, F->loud, F->pull, F->u, F->old_u, F->trial_u,
                     F->wish, F->z, F->scale, F->dz, F->held, F->spare};
    for (int i = 0; i < 17; i++) rg_mem_free(&F->mem, block[i]);
    memset(F, 0, sizeof *F);
}

static void renew(rg_flow *F)
{
    /* A factorisation is worth its flops; filling and solving go with the entries. */
    F->work += 1.5e-9 * F->J.A.L.S.flops + 6e-7 * F->J.A.start[F->J.A.columns];
    rg_joint_renew(&F->J, F->scale);
}

/* A step, or a state before it is closed: what the symmetry leaves of it. Of steps that an even state allows the mean is
 * allowed as well. */
static void even_out(const rg_flow *F, double *rho, double *u)
{
    if (!F->symmetry) return;
    rg_symmetry_mean(F->symmetry, rho);
    rg_freedom_mean(&F->freedom, F->symmetry, u, F->spare);
}

/* Works off r and r' as assembled, to first order: eqs. (14), (19) with no wish. */
static void correct_once(rg_flow *F, double *rho, double *u, int evenly)
{
    const int32_t n = F->N + F->U;
    renew(F);
    rg_step_solve(&F->J.A, F->J.r, F->dz); /* eqs. (14), (15), (19) */
    for (int32_t i = 0; i < n; i++) F->dz[i] *= F->scale[i];
    if (evenly) even_out(F, F->dz, F->dz + F->N);
    for (int32_t i = 0; i < F->N; i++) rho[i] -= F->dz[i];
    for (int32_t i = 0; i < F->U; i++) u[i] -= F->dz[F->N + i];
}

static void stiffen(rg_flow *F, double by)
{
    for (int32_t i = 0; i < F->N; i++) F->scale[i] *= by;
}

/* The same until it closes. Zero: it does not. As the mean of even steps is a step, so is that of corrections; only what
 * the drawing itself is uneven by is left to each vertex. */
static int correct(rg_flow *F, double *rho, double *u)
{
    double before = INFINITY;
    int poor = 0, evenly = F->symmetry != NULL, closes = 0, stiff = 0;
    for (int32_t n = 0;; n++) {
        double off;
        F->closure = rg_joint_assemble(&F->J, rho, u, &off);
        F->assemblies++;
        closes = F->closure <= F->tol && off <= F->tol;
        if (closes || n >= CORRECTIONS || !(F->closure <= 2.5)) break;
        if (evenly && F->closure > STILL_CLOSES * before) {
            evenly = 0;
            stiff = F->U > 0;
            if (stiff) stiffen(F, STIFF);
        }
        poor = F->closure > 0.7 * before && F->closure > 100 * F->tol ? poor + 1 : 0;
        if (poor >= 3) break;
        before = F->closure;
        correct_once(F, rho, u, evenly);
    }
    if (stiff) stiffen(F, 1 / STIFF);
    return closes;
}

/* Once more, for F->trial, which closes, to close better; taken back where it does not: near singular states more
 * corrections chase rounding. */
static void polish(rg_flow *F)
{
    const double before = F->closure;
    double *spare = F->wish, *spare_u = F->wish + F->N;
    if (before <= CLOSE_ENOUGH * F->tol) return;
    memcpy(spare, F->trial, (size_t)F->N * sizeof *spare);
    memcpy(spare_u, F->trial_u, (size_t)F->U * sizeof *spare);
    correct_once(F, F->trial, F->trial_u, 0);
    F->closure = rg_joint_assemble(&F->J, F->trial, F->trial_u, NULL);
    F->assemblies++;
    if (F->closure < before) return;
    memcpy(F->trial, spare, (size_t)F->N * sizeof *spare);
    memcpy(F->trial_u, spare_u, (size_t)F->U * sizeof *spare);
    F->closure = rg_joint_assemble(&F->J, F->trial, F->trial_u, NULL);
}

static int is_limited(const rg_flow *F) { return F->s >= FREE_UNTIL; }

static void make_wish(rg_flow *F)
{
    const double ds = F->step * F->h / RG_PI;
    rg_limit_pull(&F->limit, F->rho, F->pull);
    for (int32_t i = 0; i < F->N; i++) {
        F->scale[i] = 1;
        F->held[i] = 0;
        F->wish[i] = 0;
        if (isnan(F->target[i]) || i >= F->limit.first_added) {
            F->wish[i] = BACK * F->pull[i];
            continue;
        }
        const double left = F->target[i] - F->rho[i], all = way(F, i);
        const int on_the_way = left * all > 0 && fabs(left) > NEAR;
        if (!on_the_way) F->wish[i] = NEAR_PART * F->h * left;
        else if (F->law.together) F->wish[i] = ds * left / (1 - fmin(F->s, 0.97));
        else F->wish[i] = ds * all;
        if (on_the_way) F->wish[i] *= F->loud[i];
        if (F->s >= WRONG_FROM && left * all > 0 && fabs(left) > fabs(all)) F->scale[i] = F->law.stubborn;
        if (is_limited(F) && F->pull[i] != 0) {
            F->wish[i] = BACK * F->pull[i];
            F->scale[i] = BEYOND_GIVES;
        }
    }
    rg_adjust_wish(&F->adjust, F->rho, F->law.gain, F->wish + F->N);
    for (int32_t i = 0; i < F->U; i++) F->wish[F->N + i] = RETURN * (F->wish[F->N + i] - F->u[i]);
}

static void hold(rg_flow *F, int32_t i)
{
    F->held[i] = 1;
    F->scale[i] = HELD_GIVES;
    F->wish[i] = copysign(RG_PI, F->rho[i]) - F->rho[i];
}

/* Holds the creases that rho + f dz, or trial where dz is NULL, takes beyond half a turn; how many are new. */
static int32_t hold_what_overfolds(rg_flow *F, const double *dz, double beyond)
{
    int32_t more = 0;
    for (int32_t i = 0; i < F->N && is_limited(F); i++) {
        const double then = dz ? F->rho[i] + dz[i] : F->trial[i];
        if (F->held[i] || !(fabs(then) > RG_PI + beyond)) continue;
        hold(F, i);
        more++;
    }
    return more;
}

/* wish - A^+ (A wish + r), with the columns of A scaled: eqs. (14), (19). */
static void project(rg_flow *F)
{
    const int32_t n = F->N + F->U;
    renew(F);
    for (int32_t i = 0; i < n; i++) F->z[i] = F->wish[i] / F->scale[i];
    rg_step_mul(&F->J.A, F->z, F->J.A.q);
    memcpy(F->J.A.z, F->J.A.q, (size_t)F->J.A.rows * sizeof *F->J.A.z);
    for (int32_t i = 0; i < F->J.A.rows; i++) F->J.r[i] += F->J.A.z[i];
    rg_step_solve(&F->J.A, F->J.r, F->dz);
    for (int32_t i = 0; i < n; i++) F->dz[i] = F->wish[i] - F->scale[i] * F->dz[i];
    even_out(F, F->dz, F->dz + F->N);
}

/* rho + f dz, closed, in F->trial: is it a state to go on from? z keeps dz, as correcting uses dz. */
static int try_step(rg_flow *F, double f, double longest)
{
    for (int32_t i = 0; i < F->N; i++) F->trial[i] = F->rho[i] + f * F->z[i];
    for (int32_t i = 0; i < F->U; i++) F->trial_u[i] = F->u[i] + f * F->z[F->N + i];
    even_out(F, F->trial, F->trial_u);
    if (!correct(F, F->trial, F->trial_u) || !rg_freedom_is_proper(&F->freedom, F->J.X, LEAST_AREA)) return 0;
    double far = 0;
    for (int32_t i = 0; i < F->N; i++) far = fmax(far, fabs(F->trial[i] - F->rho[i] - f * F->z[i]));
    return far <= FARTHEST_CORRECTION * f * longest + LITTLE;
}

/* Does F->trial go past half a turn farther than F->rho does? */
static int goes_beyond(const rg_flow *F)
{
    for (int32_t i = 0; i < F->N && is_limited(F); i++)
        if (!(fabs(F->trial[i]) <= fmax(RG_PI + BEYOND, fabs(F->rho[i])))) return 1;
    return 0;
}

static int has_returned(const rg_flow *F)
{
    for (int32_t i = 0; i < F->U; i++)
        if (!(fabs(F->u[i]) <= RETURNED * F->freedom.reach[i])) return 0;
    return 1;
}

/* Any pattern that obeys Kawasaki's theorem closes with all creases at half a turn: only the one given counts as folded. */
/* Does the pattern say of every crease where it ends? Unassigned ones, such as those that a pleated hypar bends along, may
 * end anywhere, so nobody knows whether the pattern closes there as it was given. */
static int end_is_definite(const rg_flow *F)
{
    for (int32_t i = 0; i < F->limit.first_added; i++)
        if (isnan(F->target[i])) return 0;
    return 1;
}

static void stop(rg_flow *F, const char *why)
{
    double least;
    progress(F, F->rho, &least);
    const int arrived = least >= 0.99 && F->s_end >= 1, moved = arrived && !has_returned(F);
    F->outcome = arrived && (!moved || !end_is_definite(F)) ? RG_FOLDED : RG_STOPPED;
    if (moved) why = F->outcome == RG_FOLDED ? "folded, on a pattern moved a little: unassigned creases leave open where it ends"
                                             : "folded, but with no way back to the pattern given";
    snprintf(F->reason, sizeof F->reason, "%s", why);
}

/* From the start again, with the creases that lost asked for more loudly; zero: that was tried often enough. */
static int begin_again(rg_flow *F)
{
    if (F->attempt >= F->law.attempts) return 0;
    /* Off flat no crease has won or lost: then each gets a voice of its own, the same in every run. */
    const int none = F->s < AT_FLAT;
    uint32_t dice = 2463534242u + 7919u * (uint32_t)F->attempt;
    for (int32_t i = 0; i < F->N; i++) {
        dice ^= dice << 13, dice ^= dice >> 17, dice ^= dice << 5;
        if (!is_driven(F, i)) continue;
        if (none) F->loud[i] *= exp2((double)(dice >> 8) / (1 << 24) - 0.5);
        else if (!((F->rho[i] - F->from[i]) / way(F, i) > 0)) F->loud[i] *= LOUDER;
    }
    for (int32_t i = 0; F->symmetry && i < F->N; i++) F->loud[i] = F->loud[F->symmetry->crease_orbit[i]];
    memcpy(F->rho, F->from, (size_t)F->N * sizeof *F->rho);
    memset(F->u, 0, (size_t)F->U * sizeof *F->u);
    memcpy(F->old_rho, F->from, (size_t)F->N * sizeof *F->rho);
    memset(F->old_u, 0, (size_t)F->U * sizeof *F->u);
    F->proper = 0;
    F->attempt++;
    F->s = F->old_s = F->best_s = F->best_least = 0;
    F->idle = 0;
    F->h = 1;
    return 1;
}

static int signs_are_wrong(const rg_flow *F)
{
    for (int32_t i = 0; i < F->N; i++)
        if (is_driven(F, i) && (F->rho[i] - F->from[i]) / way(F, i) < 0) return 1;
    return 0;
}

/* The folded state itself, where everything is near it. */
static int land(rg_flow *F, double least)
{
    if (F->s_end < 1 || !(least >= 1 - ARRIVED)) return 0;
    if (!has_returned(F)) return 0;
    for (int32_t i = 0; i < F->N; i++) {
        const double target = isnan(F->target[i]) ? F->from[i] : F->target[i];
        if (!isnan(F->target[i]) && !(fabs(F->rho[i] - target) <= F->step)) return 0;
    }
    if (F->end_is_closed) {
        memcpy(F->rho, F->end, (size_t)F->N * sizeof *F->rho);
        memset(F->u, 0, (size_t)F->U * sizeof *F->u);
        F->landed = 1;
    }
    F->s = 1;
    stop(F, F->landed ? "folded" : "folded, as far as the pattern closes at its end");
    return 1;
}

/* The first state past the free start that keeps the limits: what lies between is taken straight from the start to it,
 * as what closes near flat and near folded paper is homogeneous in the distance. */
static int is_proper(const rg_flow *F)
{
    for (int32_t i = 0; i < F->N; i++)
        if (!(fabs(F->trial[i]) <= RG_PI + BEYOND)) return 0;
    return is_limited(F);
}

static void accept(rg_flow *F)
{
    double least;
    if (F->proper) {
        memcpy(F->old_rho, F->rho, (size_t)F->N * sizeof *F->rho);
        memcpy(F->old_u, F->u, (size_t)F->U * sizeof *F->u);
        F->old_s = F->s;
    }
    F->proper = F->proper || is_proper(F);
    memcpy(F->rho, F->trial, (size_t)F->N * sizeof *F->rho);
    memcpy(F->u, F->trial_u, (size_t)F->U * sizeof *F->u);
    F->s = progress(F, F->rho, &least);
    F->idle++;
    if (F->s > F->best_s + BETTER_MEAN || least > F->best_least + BETTER_LEAST) F->idle = 0;
    if (F->s > F->best_s + BETTER_MEAN) F->best_s = F->s;
    if (least > F->best_least + BETTER_LEAST) F->best_least = least;
    if (F->s > JUDGED_AT && F->attempt < F->law.attempts) {
        if (signs_are_wrong(F)) begin_again(F);
        else F->law.attempts = F->attempt; /* this start is the right one */
    }
}

void rg_flow_wish_and_step(rg_flow *F)
{
    F->h = 1;
    rg_joint_assemble(&F->J, F->rho, F->u, NULL);
    make_wish(F);
    project(F);
}

static int advance(rg_flow *F)
{
    rg_joint_assemble(&F->J, F->rho, F->u, NULL);
    F->assemblies++;
    make_wish(F);
    for (int32_t round = 0; round < ROUNDS; round++) {
        const int is_last = round + 1 == ROUNDS;
        if (round) rg_joint_assemble(&F->J, F->rho, F->u, NULL);
        project(F);
        if (!is_last && hold_what_overfolds(F, F->dz, BEYOND / 10)) continue;
        double longest = 0;
        memcpy(F->z, F->dz, (size_t)(F->N + F->U) * sizeof *F->z);
        for (int32_t i = 0; i < F->N; i++) longest = fmax(longest, fabs(F->z[i]));
        if (!(longest > LEAST_STEP)) return 0;
        const double most = 1.5 * F->step * F->h;
        double f = longest > most ? most / longest : 1;
        int32_t halving = 0;
        while (!try_step(F, f, longest) || (is_last && goes_beyond(F))) {
            if (++halving > HALVINGS) return 0;
            f /= 2;
        }
        if (!is_last && hold_what_overfolds(F, NULL, BEYOND)) continue;
        F->h = fmax(LEAST_H, fmin(1, 1.3 * F->h * sqrt(f)));
        return 1;
    }
    return 0;
}

void rg_flow_step(rg_flow *F)
{
    double least;
    if (F->outcome != RG_RUNNING) return;
    F->steps++;
    progress(F, F->rho, &least);
    if (F->driven == 0 || F->s_end == 0) {
        F->s = F->s_end;
        F->outcome = RG_FOLDED;
        snprintf(F->reason, sizeof F->reason, "nothing to fold");
    } else if (F->s >= F->s_end && F->s_end < 1) {
        F->outcome = RG_FOLDED;
        snprintf(F->reason, sizeof F->reason, "as far as was asked for");
    } else if (land(F, least)) {
        return;
    } else if (F->steps > MOST_STEPS * (1 + F->attempt) || (F->budget > 0 && F->work > F->budget)) {
        stop(F, "the effort ran out");
    } else if (!advance(F)) {
        if (!begin_again(F)) stop(F, "the facets leave no way on");
    } else {
        accept(F);
        if (F->idle > MOST_IDLE && !begin_again(F)) stop(F, "no motion that the facets allow folds any further");
    }
}

/* Closes F->trial, F->trial_u, which a chord or its correction may have taken past half a turn: such creases are put back
 * there and held, and the others make up for it. Zero: it does not close. */
static int close_within_half_turns(rg_flow *F)
{
    for (int32_t round = 0; round < ROUNDS; round++) {
        int32_t held = 0;
        if (!correct(F, F->trial, F->trial_u)) return 0;
        for (int32_t i = 0; i < F->N && is_limited(F); i++) {
            if (!(fabs(F->trial[i]) > RG_PI + BEYOND / 10)) continue;
            F->trial[i] = copysign(RG_PI, F->trial[i]);
            F->scale[i] = HELD_GIVES;
            held++;
        }
        if (!held) return 1;
    }
    return correct(F, F->trial, F->trial_u);
}

/* The state at part t of the chord from the state before, closed; zero: it does not close. */
static int close_chord(rg_flow *F, double t)
{
    for (int32_t i = 0; i < F->N; i++) F->trial[i] = (1 - t) * F->old_rho[i] + t * F->rho[i];
    for (int32_t i = 0; i < F->U; i++) F->trial_u[i] = (1 - t) * F->old_u[i] + t * F->u[i];
    even_out(F, F->trial, F->trial_u);
    return close_within_half_turns(F);
}

int rg_flow_at(rg_flow *F, double s)
{
    if (F->landed && s >= 1) {
        memcpy(F->trial, F->rho, (size_t)F->N * sizeof *F->rho);
        memcpy(F->trial_u, F->u, (size_t)F->U * sizeof *F->u);
        F->closure = rg_joint_assemble(&F->J, F->trial, F->trial_u, NULL);
        return 1;
    }
    /* Secants on the progress of what closing makes of the chord's points. */
    double t0 = 0, s0 = F->old_s, t1 = 1, s1 = F->s, good = -1, least;
    for (int32_t n = 0; n < SECANTS; n++) {
        const double t = fabs(s1 - s0) > 1e-14 ? fmin(1, fmax(0, t0 + (t1 - t0) * (s - s0) / (s1 - s0))) : t1;
        if (!close_chord(F, t)) {
            if (good < 0 || !close_chord(F, good)) return 0;
            break;
        }
        good = t;
        const double is = progress(F, F->trial, &least);
        if (fabs(is - s) <= SAME_PROGRESS || t == 1) break;
        if (is > s) t1 = t, s1 = is;
        else t0 = t, s0 = is;
    }
    polish(F);
    return 1;
}
