#include "fold/relax.h"
#include "fold/chord.h"
#include "fold/closing.h"
#include "fold/tuning.h"

#include <stdio.h>
#include <string.h>

static double way(const rg_relax *F, int32_t i) { return F->target[i] - F->from[i]; }

static void stop(rg_relax *F, const char *why);

/* -------------------------------------------------------------------------------------------- making one ---- */

static rg_status make_room(rg_relax *F)
{
    const size_t N = (size_t)F->N, n = (size_t)F->n;
    F->room = (int32_t)fmin(MOST_NODES, MOST_STEPS / F->share) + 2 * END_NODES + RG_CHORD_SPARE + 2;
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

rg_status rg_relax_init(rg_relax *F, const rg_mesh *m, const rg_settings *s, const rg_relaxation *how,
                        const double *from, const double *target)
{
    const rg_memory mem = rg_mem_default(s->memory);
    memset(F, 0, sizeof *F);
    F->mem = mem;
    F->mesh = *m;
    m = &F->mesh;
    F->how = *how;
    F->how.compliance = fmax(how->compliance, LEAST_COMPLIANCE);
    F->step = fmin(s->step, MOST_STEP);
    F->share = fmin(1, F->step / USUAL_STEP);
    F->foresees = 1;
    F->tol = s->tol;
    F->s_end = fabs(s->to);
    F->N = m->N;
    rg_status status = rg_freedom_init(&F->freedom, &mem, m, how->gain > 0 || how->compliance > 0);
    F->U = F->freedom.U;
    F->n = F->N + F->U;
    if (status == RG_OK) status = rg_constraint_init_moving(&F->K, &mem, m, &F->freedom, how->kawasaki);
    if (status == RG_OK) status = rg_coupled_init(&F->J, &mem, &F->K, NULL);
    F->J.A.tolerance = SOLVED;
    if (status == RG_OK) status = rg_adjust_init(&F->adjust, &mem, &F->freedom);
    if (status == RG_OK) status = rg_limit_init(&F->limit, &mem, m);
    if (status == RG_OK) status = make_room(F);
    if (status != RG_OK) {
        rg_relax_free(F);
        return status;
    }
    if (from) memcpy(F->from, from, (size_t)F->N * sizeof *from);
    memcpy(F->target, target, (size_t)F->N * sizeof *target);
    for (int32_t i = 0; i < F->U; i++) F->scale[F->N + i] = F->how.compliance * F->freedom.reach[i];
    for (int32_t i = 0; i < F->N; i++) F->end[i] = isnan(F->target[i]) ? F->from[i] : F->target[i];
    F->end_is_closed = rg_closing_on_pattern(F, F->end);
    int closes = 1;
    for (int32_t i = 0; i < F->N && closes > 0; i++) closes = F->from[i] == 0 ? closes : -1;
    if (closes < 0 && !rg_closing_on_pattern(F, F->from)) stop(F, "the state to start from does not close");
    memcpy(F->z, F->from, (size_t)F->N * sizeof *F->z);
    F->from_is_singular = is_singular(F->from, F->N);
    for (int32_t i = 0; i < F->N; i++) {
        F->slope[i] = isnan(F->target[i]) || way(F, i) == 0 ? 0 : 1 / way(F, i);
        F->driven += F->slope[i] != 0;
    }
    add_node(F, F->z, 0);
    F->h = 1;
    return RG_OK;
}

rg_status rg_relax_keep(rg_relax *F, const rg_symmetry *G)
{
    F->symmetry = G;
    F->by_orbits = OF_THE_DRAWING * G->off <= F->tol;
    const rg_status s = F->by_orbits ? rg_coupled_init(&F->orbits, &F->mem, &F->K, G) : RG_OK;
    F->orbits.A.tolerance = SOLVED;
    if (s != RG_OK) F->symmetry = NULL;
    return s;
}

void rg_relax_free(rg_relax *F)
{
    if (!F->mem.resize) return;
    rg_coupled_free(&F->orbits);
    rg_freedom_free(&F->freedom);
    rg_coupled_free(&F->J);
    rg_constraint_free(&F->K);
    rg_adjust_free(&F->adjust);
    rg_limit_free(&F->limit);
    void *block[] = {F->from, F->target, F->slope, F->end, F->pull, F->z, F->trial, F->wish, F->dz, F->scale, F->chord,
                     F->g, F->t, F->held, F->node, F->node_s, F->spare};
    for (int i = 0; i < 17; i++) rg_mem_free(&F->mem, block[i]);
    memset(F, 0, sizeof *F);
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
    rg_freedom_room(&F->freedom, F->K.X, LEAST_AREA, F->wish + F->N);
    for (int32_t i = F->N; i < F->n; i++)
        F->scale[i] = F->how.compliance * F->freedom.reach[i - F->N] * fmax(LEAST_READY, sqrt(F->wish[i]));
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
    const double least = LEAST_GAIN * F->step * F->h / RG_PI, left = rg_closing_project_slope(F, F->z, evenly);
    double gain = 0;
    for (int32_t i = 0; i < F->N; i++) gain += F->g[i] / F->scale[i] * F->dz[i];
    if (!(left > 0 && gain < least)) return;
    for (int32_t i = 0; i < F->n; i++) F->dz[i] += F->scale[i] * (least - gain) / left * F->t[i];
}

/* wish - W A^T (A W A^T)^+ (A wish + r), the columns of A scaled by the root of W: eqs. (14), (19). */
static void project(rg_relax *F, int evenly)
{
    double *y = F->chord;
    rg_closing_renew(F, evenly, 0);
    for (int32_t i = 0; i < F->n; i++) y[i] = F->wish[i] / F->scale[i];
    rg_closing_solve(F, evenly, y, F->K.r, F->dz);
    for (int32_t i = 0; i < F->n; i++) F->dz[i] = F->wish[i] - F->scale[i] * F->dz[i];
    if (is_limited(F)) keep_gaining(F, evenly);
    if (evenly) rg_closing_even_out(F, F->dz);
}

/* z + f dz, closed, in F->trial: is it a state to go on from? chord keeps dz, as correcting uses dz. */
static int try_step(rg_relax *F, double f, double longest)
{
    const rg_leash by = {f, (is_limited(F) ? FARTHEST_CORRECTION : FARTHEST_AT_START) * f * longest + LITTLE};
    double least;
    for (int32_t i = 0; i < F->n; i++) F->trial[i] = F->z[i] + f * F->chord[i];
    rg_closing_even_out(F, F->trial);
    const double s = rg_closing_progress(F, F->trial, &least);
    if (!rg_closing_correct(F, F->trial, is_limited(F) && s > F->s ? s : NAN, CORRECTIONS, &by)) return 0;
    if (!rg_freedom_room(&F->freedom, F->K.X, LEAST_AREA, NULL)) return 0;
    return !is_limited(F) || rg_closing_progress(F, F->trial, &least) >= F->s;
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
    rg_closing_assemble(F, F->z, 0, NULL);
    make_wish(F);
    project(F, 0);
}

/* Does the path go on smoothly to F->trial, once it has begun? */
static int leads_on(rg_relax *F)
{
    return F->nodes < 2 || rg_chord_holds(F, F->z, F->trial, F->node + (size_t)F->nodes * (size_t)F->n);
}

static int advance(rg_relax *F)
{
    const int evenly = F->symmetry != NULL;
    rg_closing_assemble(F, F->z, evenly, NULL);
    make_wish(F);
    for (int32_t round = 0; round < ROUNDS; round++) {
        const int is_last = round + 1 == ROUNDS;
        if (round) rg_closing_assemble(F, F->z, evenly, NULL);
        project(F, evenly);
        if (!is_last && hold_what_overfolds(F, F->dz, BEYOND / 10)) continue;
        double longest = 0;
        memcpy(F->chord, F->dz, (size_t)F->n * sizeof *F->dz);
        for (int32_t i = 0; i < F->N; i++) longest = fmax(longest, fabs(F->chord[i]));
        if (!(longest > LEAST_STEP)) return 0;
        const double most = 1.5 * F->step * F->h;
        double f = longest > most ? most / longest : 1;
        int32_t halving = 0;
        while (!try_step(F, f, longest) || (is_last && goes_beyond(F)) || !leads_on(F)) {
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

/* Nodes from z down to the singular state `at`, nearer and nearer: what closes there is homogeneous, u of second order
 * where rho is of first. node, s: out, the nearest last. Returns how many; zero: the branch of z does not lead
 * there. */
static int32_t approach(rg_relax *F, const double *z, const double *at, double *node, double *s)
{
    double least, nearer = NEARER;
    const double *last = z;
    int32_t k = 0;
    for (double near = 1; near > NEAR_ENOUGH;) {
        for (int32_t i = 0; i < F->N; i++) F->trial[i] = at[i] + nearer * (last[i] - at[i]);
        for (int32_t i = F->N; i < F->n; i++) F->trial[i] = nearer * nearer * last[i];
        rg_closing_even_out(F, F->trial);
        memcpy(F->chord, F->trial, (size_t)F->n * sizeof *F->trial);
        const double most = FARTHEST_CORRECTION * (1 - nearer) * rg_chord_size(F, last, at) + sqrt(F->tol);
        if (rg_closing_between(F, at, at, NAN, CORRECTIONS_TOWARDS, F->trial, node) &&
            rg_chord_size(F, F->trial, F->chord) <= most &&
            rg_chord_holds(F, last, F->trial, node)) {
            if (++k > END_NODES) return 0;
            memcpy(node, F->trial, (size_t)F->n * sizeof *node);
            *s++ = rg_closing_progress(F, node, &least);
            near *= nearer;
            last = node;
            node += F->n;
            nearer = fmax(NEARER, 2 * nearer - 1);
        } else if ((nearer = (1 + nearer) / 2) > HARDLY_NEARER) {
            return 0;
        }
    }
    return k;
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

/* To see whether a branch leads to a singular state costs as much as many steps: each time that it does not, twice as
 * many are left out. */
static int may_look(rg_relax *F)
{
    if (F->steps < F->look_after) return 0;
    F->look_pause = 2 * F->look_pause + 1;
    F->look_after = F->steps + F->look_pause;
    return 1;
}

/* The first state past the free start that keeps the limits begins the path: from the start straight to it. Where both
 * a way of first and one of second order lie near a singular start, the nodes tell which is which. */
static int begin_path(rg_relax *F)
{
    for (int32_t i = 0; i < F->N; i++)
        if (!(fabs(F->z[i]) <= RG_PI + BEYOND)) return 0;
    if (!is_limited(F)) return 0;
    if (F->from_is_singular) {
        if (!may_look(F)) return 0;
        const int32_t more = approach(F, F->z, F->from, F->node + F->n, F->node_s + 1);
        if (!more) return 0;
        F->nodes += more;
        for (int32_t a = 1, b = more; a < b; a++, b--) swap_nodes(F, a, b);
        for (int32_t k = 1; k < F->nodes; k++)
            if (!(F->node_s[k] >= F->node_s[k - 1])) F->node_s[k] = F->node_s[k - 1];
    }
    F->look_after = F->steps;
    F->look_pause = 0;
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
    rg_closing_progress(F, F->z, &least);
    const int arrived = least >= 1 - ARRIVED && F->s_end >= 1 && F->nodes > 1, moved = arrived && !has_returned(F);
    F->outcome = arrived && !moved ? RG_FOLDED : RG_STOPPED;
    if (arrived)
        why = moved ? "folded, but with no way back to the pattern given" : F->landed ? "folded"
            : "folded, as far as the pattern closes at its end";
    snprintf(F->reason, sizeof F->reason, "%s", why);
}

/* The folded state itself, where everything is near it and the branch leads there. */
static int land(rg_relax *F, double least)
{
    if (F->s_end < 1 || !(least >= 1 - LANDS_FROM) || !has_returned(F) || F->nodes < 2) return 0;
    for (int32_t i = 0; i < F->N; i++)
        if (!isnan(F->target[i]) && !(fabs(F->z[i] - F->target[i]) <= F->step)) return 0;
    const int idles = F->share * F->idle > MOST_IDLE;
    if (F->end_is_closed && !idles && !may_look(F)) return 0;
    double *node = F->node + (size_t)F->nodes * (size_t)F->n;
    const int32_t more = F->end_is_closed ? approach(F, F->z, F->end, node, F->node_s + F->nodes) : 0;
    if (more) {
        for (int32_t k = 0; k < more; k++, F->nodes++)
            if (!(F->node_s[F->nodes] >= F->node_s[F->nodes - 1])) F->node_s[F->nodes] = F->node_s[F->nodes - 1];
        memcpy(F->z, F->end, (size_t)F->N * sizeof *F->z);
        memset(F->z + F->N, 0, (size_t)F->U * sizeof *F->z);
        F->s = 1;
        add_node(F, F->z, F->s);
        F->landed = 1;
    } else if (!idles) { /* what the pattern does not close by is left as small as it gets */
        return 0;
    }
    stop(F, "folded");
    return 1;
}

static void accept(rg_relax *F)
{
    double least;
    memcpy(F->z, F->trial, (size_t)F->n * sizeof *F->z);
    F->s = rg_closing_progress(F, F->z, &least);
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
    rg_closing_progress(F, F->z, &least);
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
    } else if (F->nodes + END_NODES + RG_CHORD_SPARE + 1 > F->room ||
               (F->budget > 0 && F->work > F->budget / F->share)) {
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
