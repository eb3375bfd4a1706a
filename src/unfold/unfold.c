#include "unfold/unfold.h"

#include <stdio.h>
#include <string.h>

/* They fail on different patterns; the first frees most. */
static const rg_passage_way WAYS[] = {
    /* part  hard  margin grow repair    more keep */
    {{0.03, 1e-9, 1e-4, 0, 6}, {0, 0}},
    {{0.2, 1e-9, 0, 1, 0}, {1, 1}},
    {{0.06, 1e-9, 0, 1, 0}, {1, 1}},
    {{0.1, 1e-9, 0, 1, 0}, {0, 0}},
    {{0.03, 1e-8, 0, 0, 0}, {1, 0}},
    {{0.03, 1e-9, 1e-4, 1, 0}, {0, 0}},
    {{0.03, 1e-6, 1e-4, 0, 6}, {0, 0}},
};
/* What is tried, one after the other: a way of opening, and the number of an order; way -1: from flat. Another order
 * does more than another way. */
typedef struct step_of_plan { int way; int32_t order; } step_of_plan;
static const step_of_plan PLAN[] = {
    {0, 0}, {1, 0}, {0, 1}, {1, 1}, {-1, 0}, {2, 0}, {3, 0}, {4, 0}, {0, 2}, {1, 2}, {2, 1}, {3, 1},
    {5, 0}, {0, 3}, {1, 3}, {2, 2}, {4, 1}, {5, 1}, {6, 0}, {0, 4}, {1, 4}, {0, 5}, {1, 5}, {0, 6},
    {1, 6}, {0, 7}, {1, 7}, {0, 8}, {1, 8}, {0, 9}, {1, 9}, {0, 10}, {1, 10}, {0, 11}, {1, 11}
};
enum { PLAN_COUNT = sizeof PLAN / sizeof *PLAN };
/* No try may cost more than this part of what is left. */
static const double PART_OF_BUDGET = 0.5;

void rg_unfold_free(rg_unfold *u)
{
    if (!u->mem.resize) return;
    rg_mem_free(&u->mem, u->which);
    rg_passage_free(&u->pass);
    memset(u, 0, sizeof *u);
}

/* The n-th order to be tried. Zero: there are no more. */
static int number_order(rg_unfold *u, const rg_unfold_wish *wish, int32_t n)
{
    const rg_layers *l = u->pass.layers;
    const rg_parts *q = &l->parts;
    if (wish->order >= 0) return n == 0 && rg_layers_which(l, (uint64_t)wish->order, u->which) == RG_OK;
    memset(u->which, 0, (size_t)q->count * sizeof *u->which);
    if (n == 0) return 1;
    for (int32_t i = 0; i < q->count; i++)
        if (q->orders[i] > 1 && --n == 0) {
            u->which[i] = 1;
            return 1;
        }
    /* Then, by their numbers, some that differ in more. */
    return rg_layers_which(l, (uint64_t)q->count + (uint64_t)n, u->which) == RG_OK;
}

/* One entry of the plan; *is_free: out. */
static rg_status go_by(rg_unfold *u, const step_of_plan *p, const rg_unfold_wish *wish, int *is_free)
{
    const double budget = PART_OF_BUDGET * (u->most - u->work);
    const int from_flat = p->way < 0;
    *is_free = 0;
    if (from_flat ? wish->order >= 0 : !number_order(u, wish, p->order)) return RG_OK;
    rg_status s = rg_layers_choose(u->pass.layers, from_flat ? NULL : u->which);
    if (s != RG_OK) return s;
    if (from_flat) s = rg_passage_from_flat(&u->pass, budget, is_free);
    else s = rg_passage_from_end(&u->pass, &WAYS[p->way], budget, is_free);
    u->tries++;
    u->work += u->pass.spent;
    u->steps = u->pass.steps;
    if (s != RG_OK || !*is_free) return s;
    rg_track_rise(&u->pass.track);
    if (from_flat) snprintf(u->how, sizeof u->how, "folded from flat with contacts");
    else if (u->pass.as_seen)
        snprintf(u->how, sizeof u->how,
                 "unfolded from the flat end, way of opening %d, and landed in the order of layers that it came to",
                 p->way + 1);
    else
        snprintf(u->how, sizeof u->how,
                 "unfolded from the flat end: order of layers %d of those tried, way of opening %d", (int)p->order + 1,
                 p->way + 1);
    return wish->accept ? wish->accept(wish->ctx, u, is_free) : RG_OK;
}

static rg_status search(rg_unfold *u, const rg_unfold_wish *wish)
{
    u->outcome = RG_UNFOLD_FAILED;
    for (int k = 0; k < PLAN_COUNT; k++) {
        int is_free;
        if (!(u->work < u->most) || (wish->stop && wish->stop(wish->ctx, 0))) return RG_OK;
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
    rg_status s = rg_passage_init(&u->pass, mem, none, wish->sign, wish->shorter, wish->stop, wish->ctx);
    const rg_layers *l = u->pass.layers;
    if (l && l->info.state == RG_LAYERS_UNSOLVED) u->outcome = RG_UNFOLD_FAILED; /* ended, or too much work */
    if (s != RG_OK || !l || l->info.state != RG_LAYERS_VALID || u->pass.P.N == 0) return s;
    u->pass.any_order = wish->order < 0;
    u->which = rg_mem_array(mem, (size_t)l->parts.count + 1, sizeof *u->which);
    return u->which ? search(u, wish) : RG_ENOMEM;
}

void rg_unfold_read(rg_unfold *u, double due, double *rho, rg_vec2 *X)
{
    rg_passage *w = &u->pass;
    rg_track_read(&w->track, due);
    memcpy(rho, w->track.scratch, (size_t)w->P.N * sizeof *rho);
    rg_freedom_move(&w->P.freedom, w->track.scratch + w->P.N, X);
    for (int32_t v = 0; v < w->mesh.nv; v++) X[v] = (rg_vec2){X[v].x * u->size, X[v].y * u->size};
}
