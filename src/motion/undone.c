#include "motion/undone.h"
#include "motion/rectify.h"
#include "unfold/seen.h"

#include <string.h>

/* Several orders of layers are taken apart, and the one that leaves fewest creases is folded: so many, and facets of
 * all of them. */
static const int32_t MOST_TRIES = 64, MOST_FACETS = 20000;
static const uint64_t MOST_OF_A_PART = 24;

static rg_status take_apart(rg_undone *u, rg_simple *now)
{
    const rg_status s = rg_layers_choose(u->layers, u->which);
    memset(now, 0, sizeof *now);
    return s == RG_OK ? rg_simple_find(now, &u->mem, u->layers, u->stop) : s;
}

/* The order u->which is kept where `now`, which is taken over, is better. */
static void keep_if(rg_undone *u, rg_simple *now, int better)
{
    rg_simple *gone = better ? &u->simple : now;
    rg_simple_free(gone);
    if (better) u->simple = *now;
}

static int leaves_less(const rg_simple *now, const rg_simple *old)
{
    return !old->mem.resize || now->base < old->base || (now->base == old->base && now->stages < old->stages);
}

/* Part by part, the order that leaves least. */
static rg_status find_folds(rg_undone *u, int32_t order)
{
    const rg_parts *p = &u->layers->parts;
    int32_t tries = 1;
    rg_simple now;
    if (!u->chooses && rg_layers_which(u->layers, (uint64_t)order, u->which) != RG_OK) return RG_OK;
    rg_status s = take_apart(u, &u->simple);
    for (int32_t i = 0; i < p->count && u->chooses; i++)
        for (uint64_t k = 1; s == RG_OK && k < p->orders[i] && k < MOST_OF_A_PART; k++) {
            if (tries++ >= MOST_TRIES || (int64_t)tries * u->layers->flat.nf > MOST_FACETS) return RG_OK;
            const uint64_t was = u->which[i];
            u->which[i] = k;
            s = take_apart(u, &now);
            const int better = s == RG_OK && leaves_less(&now, &u->simple);
            keep_if(u, &now, better);
            if (!better) u->which[i] = was;
        }
    return s;
}

static rg_status find_layers(rg_undone *u, int32_t order)
{
    rg_diag why;
    u->angle = rg_mem_array(&u->mem, (size_t)u->none->N, sizeof *u->angle);
    if (!u->angle) return RG_ENOMEM;
    for (int32_t i = 0; i < u->none->N; i++) u->angle[i] = u->sign * u->none->target[u->none->crease_edge[i]];
    rg_status s = rg_layers_of_mesh(u->none, u->angle, 0, &u->mem, u->stop, &u->layers, &why);
    if (s != RG_OK || u->layers->info.state != RG_LAYERS_VALID) return s;
    u->which = rg_mem_array(&u->mem, (size_t)u->layers->parts.count + 1, sizeof *u->which);
    s = u->which ? find_folds(u, order) : RG_ENOMEM;
    if (s == RG_OK) s = rg_layers_choose(u->layers, u->which);
    for (int32_t e = 0; s == RG_OK && e < u->none->ne; e++) { /* creases without a target, too, are folded one way */
        const rg_flat *f = &u->layers->flat;
        const int32_t i = u->none->edge_crease[e], *beside = f->beside[e];
        if (f->turn[e] == RG_TURN_EITHER)
            u->angle[i] = -RG_PI * f->up[beside[1]] * rg_layers_above(u->layers, beside[0], beside[1]);
        else if (i >= 0)
            u->angle[i] = RG_PI * f->turn[e];
    }
    return s;
}

rg_status rg_undone_init(rg_undone *u, const rg_mesh *none, const rg_settings *settings, const rg_stop *stop)
{
    *u = (rg_undone){.mem = rg_mem_default(settings->memory), .none = none, .sign = settings->to < 0 ? -1 : 1,
                     .chooses = settings->layer_order < 0, .stop = stop};
    rg_status s = find_layers(u, settings->layer_order);
    if (s != RG_OK || u->simple.folds == 0) return s;
    s = rg_mesh_copy(none, &u->drawn);
    if (s == RG_OK) s = rg_rectify(none, &u->simple, u->drawn.X, &u->moved, &u->off);
    if (s == RG_OK) rg_mesh_sectors(&u->drawn, u->drawn.X, u->drawn.loop_theta);
    return s;
}

void rg_undone_free(rg_undone *u)
{
    rg_layers_destroy(u->layers);
    rg_simple_free(&u->simple);
    if (u->drawn.mem.resize) rg_mesh_free(&u->drawn);
    RG_MEM_FREE(&u->mem, u->angle, u->which);
}

/* ------------------------------------------------------------------------------------ the order that is needed ---- */

/* The facet of a mesh that a point of the pattern is in; -1: none. */
static int32_t facet_at(const rg_mesh *m, rg_vec2 x)
{
    for (int32_t f = 0; f < m->nf; f++) {
        int odd = 0;
        for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
            const rg_vec2 a = m->X[m->edge[m->facet_edge[j]][0]], b = m->X[m->edge[m->facet_edge[j]][1]];
            if ((a.y > x.y) != (b.y > x.y)) odd ^= x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x);
        }
        if (odd) return f;
    }
    return -1;
}

/* A point of the pattern well inside the facet that stays where it is. */
static rg_vec2 inside_root(const rg_layers *l)
{
    const rg_cells *c = &l->cells;
    for (int32_t i = 0; i < c->faces.count; i++)
        for (int32_t j = c->over_start[i]; j < c->over_start[i + 1]; j++)
            if (c->over[j] == l->flat.root) return c->point[i];
    return l->flat.middle[l->flat.root];
}

/* wish[l->pairs.count]: out, the order that the simple folds of p go on from, for layers of the first stage. */
static void order_needed(const rg_undone *u, const rg_simple *p, const rg_layers *l, double *wish)
{
    const rg_cells *c = &l->cells;
    const rg_flat *f = &l->flat;
    const size_t nf = (size_t)p->nf;
    /* The first stage's own root looks up in its plane; the sheet's looks as taking apart left it. */
    const int32_t g = facet_at(&l->mesh, inside_root(u->layers));
    const int turned = g < 0 ? 0 : f->up[f->facet_of[g]] * p->up;
    memset(wish, 0, (size_t)l->pairs.count * sizeof *wish);
    for (int32_t i = 0; i < c->faces.count; i++) {
        const int32_t *over = c->over + c->over_start[i], n = c->over_start[i + 1] - c->over_start[i];
        for (int32_t j = 0; j < n; j++)
            for (int32_t k = j + 1; k < n; k++) {
                int32_t of[2];
                for (int side = 0; side < 2; side++) {
                    const rg_isometry *q = &f->place[over[side ? k : j]];
                    const rg_vec2 r = rg_vec2_sub(c->point[i], q->t);
                    of[side] = facet_at(&u->drawn, (rg_vec2){rg_vec2_dot(q->c[0], r), rg_vec2_dot(q->c[1], r)});
                }
                if (of[0] < 0 || of[1] < 0) continue;
                const int32_t pair = rg_pairs_find(&l->pairs, over[j], over[k]);
                wish[pair] += turned * p->above[(size_t)of[0] * nf + (size_t)of[1]];
            }
    }
}

static rg_status layers_of(const rg_undone *u, const rg_mesh *m, rg_layers **l)
{
    rg_diag why;
    double *angle = rg_mem_array(&u->mem, (size_t)m->N, sizeof *angle);
    if (!angle) return RG_ENOMEM;
    for (int32_t i = 0; i < m->N; i++) angle[i] = i < m->N - m->added ? u->sign * m->target[m->crease_edge[i]] : 0;
    const rg_status s = rg_layers_of_mesh(m, angle, 0, &u->mem, u->stop, l, &why);
    rg_mem_free(&u->mem, angle);
    return s;
}

/* The number that an order of the layers has; -1: there is none such, or it is not among those that are looked at. */
static rg_status number_of(rg_layers *l, const double *wish, int64_t *number)
{
    const rg_parts *p = &l->parts;
    uint64_t all = 0, radix = 1;
    *number = -1;
    for (int32_t i = 0; i < p->count; i++) {
        uint64_t k = 0;
        int same = 0;
        for (; !same && k < p->orders[i] && k < (uint64_t)MOST_FACETS; k++) {
            rg_orders_undo(&l->orders, l->settled);
            const rg_status s = rg_parts_choose(p, &l->orders, i, k);
            if (s != RG_OK) return s;
            same = 1;
            for (int32_t j = p->start[i]; j < p->start[i + 1]; j++)
                same &= wish[p->pair[j]] * l->orders.value[p->pair[j]] > 0;
        }
        if (!same || radix > INT64_MAX / p->orders[i]) return RG_OK;
        all += (k - 1) * radix;
        radix *= p->orders[i];
    }
    *number = all <= INT64_MAX ? (int64_t)all : -1;
    return RG_OK;
}

/* Pairs of the first stage that the simple folds of p need in another order than they have come to, is[]. */
static int32_t differ(const rg_undone *u, const rg_simple *p, const rg_layers *l, const double *is, double *want)
{
    int32_t n = 0;
    order_needed(u, p, l, want);
    for (int32_t i = 0; i < l->pairs.count; i++) n += !(is[i] == 0 || want[i] * is[i] > 0);
    return n;
}

static int is_same_base(const rg_simple *p, const rg_simple *q)
{
    for (int32_t e = 0; e < p->ne; e++)
        if ((p->stage[e] == 0) != (q->stage[e] == 0)) return 0;
    return 1;
}

/* An order of the end whose simple folds go on from what the first stage came to, is[]: part by part, while it differs
 * less. */
static rg_status follow(rg_undone *u, const rg_layers *l, const double *is, double *want, int *does)
{
    const rg_parts *p = &u->layers->parts;
    int32_t least = differ(u, &u->simple, l, is, want), tries = 0;
    rg_status s = RG_OK;
    for (int32_t i = 0; least > 0 && i < p->count && u->chooses; i++)
        for (uint64_t k = 0; s == RG_OK && least > 0 && k < p->orders[i] && k < MOST_OF_A_PART; k++) {
            rg_simple now;
            const uint64_t was = u->which[i];
            if (k == was) continue;
            if (tries++ >= MOST_TRIES || (int64_t)tries * u->layers->flat.nf > MOST_FACETS) return RG_OK;
            u->which[i] = k;
            s = take_apart(u, &now);
            if (rg_stop_asked(u->stop)) {
                rg_simple_free(&now);
                return s;
            }
            const int32_t n = s == RG_OK && is_same_base(&now, &u->simple) ? differ(u, &now, l, is, want) : least;
            keep_if(u, &now, n < least);
            if (n < least) least = n;
            else u->which[i] = was;
        }
    *does = s == RG_OK && least == 0;
    return s;
}

rg_status rg_undone_go_on(rg_undone *u, const rg_attempt *t, int *do_they)
{
    rg_layers *l = NULL;
    rg_tree tree = {0};
    double *want = NULL, *is = NULL;
    *do_they = 0;
    rg_status s = layers_of(u, &t->mesh, &l);
    if (s == RG_OK && l->info.state == RG_LAYERS_VALID) {
        const rg_seen_frames seen = {&t->mesh, &tree, t->rho, t->flat, t->count};
        const size_t pairs = (size_t)l->pairs.count;
        s = RG_MEM_ARRAYS(&u->mem, RG_ARRAY(want, pairs), RG_ARRAY(is, pairs));
        if (s == RG_OK) s = rg_tree_init(&t->mesh, -1, &tree);
        if (s == RG_OK) s = rg_seen_order(l, &seen, is);
        /* What shows only nearly is made a whole order. */
        if (s == RG_OK) s = rg_layers_choose_near(l, is);
        for (int32_t i = 0; s == RG_OK && i < l->pairs.count; i++) is[i] = l->orders.value[i];
        if (s == RG_OK) s = follow(u, l, is, want, do_they);
    }
    rg_layers_destroy(l);
    if (tree.mem.resize) rg_tree_free(&tree);
    RG_MEM_FREE(&u->mem, want, is);
    return s;
}

rg_status rg_undone_number(const rg_undone *u, const rg_mesh *base, int64_t *number)
{
    rg_layers *l = NULL;
    rg_mesh triangles;
    double *wish = NULL;
    *number = -1;
    rg_status s = rg_triangulate_all(base, &triangles);
    if (s != RG_OK) return s;
    s = layers_of(u, &triangles, &l);
    if (s == RG_OK && l->info.state == RG_LAYERS_VALID) {
        wish = rg_mem_array(&u->mem, (size_t)l->pairs.count, sizeof *wish);
        if (wish) order_needed(u, &u->simple, l, wish);
        s = wish ? number_of(l, wish, number) : RG_ENOMEM;
    }
    if (*number > INT32_MAX) *number = -1;
    rg_layers_destroy(l);
    rg_mesh_free(&triangles);
    rg_mem_free(&u->mem, wish);
    return s;
}
