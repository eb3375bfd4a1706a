#include "layers/simple.h"
#include "base/classes.h"

#include <string.h>

/* Points are on a line, and facets on one side of it, within this many tolerances of the cells: a line is drawn through
 * the ends of one crease, and the others' ends are as far off again. */
static const double ON_LINE = 4;
/* Facets, and neighbours of them in the pile, that may be looked at: some seconds. The most that a real pattern took,
 * of 1089 facets and 64 simple folds, is 6 million. */
static const int64_t MOST_LOOKS = 200000000;
/* Who lies on whom is a table of the facets squared, of no more than 400 megabytes. */
static const int32_t MOST_FACETS = 20000;
enum { NO_SIDE = 2 };

void rg_simple_free(rg_simple *q)
{
    if (!q->mem.resize) return;
    for (int32_t k = 0; k < q->folds; k++) rg_mem_free(&q->mem, q->fold[k].moves);
    RG_MEM_FREE(&q->mem, q->fold, q->stage, q->above);
    memset(q, 0, sizeof *q);
}

/* ------------------------------------------------------------------------------------------ one flat state ---- */

/* Folded flat with some of the creases. */
typedef struct state {
    rg_flat flat;
    rg_cells cells;
    rg_pairs pairs;
} state;

static void state_free(state *s)
{
    rg_flat_free(&s->flat);
    rg_cells_free(&s->cells);
    rg_pairs_free(&s->pairs);
}

/* *good: zero: it cannot be told what lies on what. */
static rg_status state_init(state *s, const rg_memory *mem, const rg_mesh *m, const double *angle, const rg_stop *stop,
                            int *good)
{
    rg_diag why;
    memset(s, 0, sizeof *s);
    rg_status status = rg_flat_init(&s->flat, mem, m, angle);
    *good = status == RG_OK && s->flat.state == RG_FLAT_END;
    if (!*good) return status;
    status = rg_cells_init(&s->cells, mem, m, &s->flat, stop, &why);
    if (status == RG_OK) status = rg_pairs_init(&s->pairs, mem, &s->cells, s->flat.nf, stop);
    *good = status == RG_OK;
    return status == RG_EFORMAT ? RG_OK : status;
}

/* ---------------------------------------------------------------------------------------------- candidates ---- */

typedef struct search {
    const rg_layers *l;
    rg_simple *q;
    const rg_stop *stop;
    int stopped;          /* or the looks ran out */
    int64_t looks;
    double *angle;        /* [N] of the state now */
    state now;
    double tol;
    /* of a line: */
    double *off;          /* [nv] signed distance from it */
    int32_t *body;        /* [nf] facets that are joined otherwise than over the line */
    int32_t *first, *next; /* [nf] the facets of each body: the first, and after each the next; -1: no more */
    signed char *side;    /* [nf] of each body, by its name: +1, -1; 0: on both */
    unsigned char *in;    /* [nf] of a candidate: bodies that turn */
    int32_t *queue;       /* [nf] facets of these */
    unsigned char *taken; /* [nf] facets that turn in this stage, or that creases of it go to */
    rg_simple_fold *found; /* candidates in this state */
    int32_t count;
    size_t room;
} search;

static const rg_vec2 *ends(const search *s, int32_t e, rg_vec2 x[2])
{
    const int32_t *v = s->l->mesh.edge[e];
    x[0] = s->now.flat.x[v[0]], x[1] = s->now.flat.x[v[1]];
    return x;
}

static int on_line(const search *s, int32_t e)
{
    const int32_t *v = s->l->mesh.edge[e];
    return fabs(s->off[v[0]]) <= s->tol && fabs(s->off[v[1]]) <= s->tol;
}

static int is_cut(const search *s, int32_t e) { return s->now.flat.turn[e] != 0 && on_line(s, e); }

/* Bodies about the line through edge `of`, and their sides. */
static void part(search *s, int32_t of)
{
    const rg_mesh *m = &s->l->mesh;
    const rg_flat *f = &s->now.flat;
    rg_vec2 x[2];
    ends(s, of, x);
    const rg_vec2 d = rg_vec2_sub(x[1], x[0]);
    const double length = rg_vec2_length(d);
    for (int32_t v = 0; v < m->nv; v++) s->off[v] = rg_vec2_cross(d, rg_vec2_sub(f->x[v], x[0])) / length;
    for (int32_t g = 0; g < f->nf; g++) s->body[g] = g;
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t *g = f->beside[e];
        if (g[0] >= 0 && g[1] >= 0 && !is_cut(s, e)) rg_class_join(s->body, g[0], g[1]);
    }
    for (int32_t g = f->nf - 1; g >= 0; g--) s->first[g] = -1;
    for (int32_t g = f->nf - 1; g >= 0; g--) {
        const int32_t b = s->body[g] = rg_class_of(s->body, g);
        s->next[g] = s->first[b];
        s->first[b] = g;
    }
    memset(s->side, NO_SIDE, (size_t)f->nf);
    for (int32_t g = 0; g < f->nf; g++) {
        double low = 0, high = 0;
        for (int32_t j = m->facet_start[g]; j < m->facet_start[g + 1]; j++) {
            low = fmin(low, s->off[m->facet_vertex[j]]);
            high = fmax(high, s->off[m->facet_vertex[j]]);
        }
        const int mine = low < -s->tol && high > s->tol ? 0 : high > -low ? 1 : -1;
        signed char *its = &s->side[s->body[g]];
        *its = (signed char)(*its == NO_SIDE || *its == mine ? mine : 0);
    }
}

static int above(const search *s, int32_t f, int32_t g)
{
    return s->q->above[(size_t)f * (size_t)s->q->nf + (size_t)g];
}

static int32_t put_in(search *s, int32_t body, int32_t n)
{
    s->in[body] = 1;
    for (int32_t g = s->first[body]; g >= 0; g = s->next[g]) s->queue[n++] = g;
    return n;
}

/* The least set of bodies that turns `up` with that one: with all that lies over it. Returns how many facets these are;
 * 0: something is in the way. */
static int32_t close(search *s, int32_t body, int up)
{
    const rg_pairs *p = &s->now.pairs;
    memset(s->in, 0, (size_t)s->now.flat.nf);
    int32_t n = put_in(s, body, 0);
    s->looks += s->now.flat.nf;
    for (int32_t i = 0; i < n; i++) {
        const int32_t f = s->queue[i];
        s->looks += p->start[f + 1] - p->start[f];
        for (int32_t j = p->start[f]; j < p->start[f + 1]; j++) {
            const int32_t *of = p->facet[p->number[j]], g = of[of[0] == f];
            if (above(s, f, g) != up || s->in[s->body[g]]) continue;
            if (s->side[s->body[g]] != s->side[body]) return 0;
            n = put_in(s, s->body[g], n);
        }
    }
    return n < s->now.flat.nf ? n : 0;
}

/* Does edge e part what turns from what does not? */
static int opens(const search *s, const unsigned char *moves, int32_t e)
{
    const int32_t *g = s->now.flat.beside[e];
    return g[0] >= 0 && g[1] >= 0 && moves[g[0]] != moves[g[1]];
}

static rg_status keep(search *s, int up)
{
    const int32_t nf = s->now.flat.nf;
    const rg_mesh *m = &s->l->mesh;
    rg_simple_fold c = {.up = up, .moves = rg_mem_array(&s->q->mem, (size_t)nf, 1)};
    rg_status status = c.moves ? RG_MEM_GROW(&s->q->mem, s->found, s->room, (size_t)s->count + 1) : RG_ENOMEM;
    if (status != RG_OK) {
        rg_mem_free(&s->q->mem, c.moves);
        return status;
    }
    for (int32_t g = 0; g < nf; g++) c.moves[g] = s->in[s->body[g]];
    double least = INFINITY, most = -INFINITY;
    rg_vec2 x[2], d = {0, 0};
    for (int32_t e = 0; e < m->ne; e++) {
        if (!opens(s, c.moves, e)) continue;
        ends(s, e, x);
        if (c.creases++ == 0) d = rg_vec2_sub(x[1], x[0]);
        for (int k = 0; k < 2; k++) {
            const double at = rg_vec2_dot(d, x[k]);
            if (at < least) least = at, c.a = x[k];
            if (at > most) most = at, c.b = x[k];
        }
    }
    for (int32_t k = 0; k < s->count; k++)
        if (s->found[k].up == up && memcmp(s->found[k].moves, c.moves, (size_t)nf) == 0) {
            rg_mem_free(&s->q->mem, c.moves); /* the same body, about the same line */
            return RG_OK;
        }
    s->found[s->count++] = c;
    return RG_OK;
}

static int go_on(search *s)
{
    s->stopped = s->stopped || s->looks > MOST_LOOKS || rg_stop_asked(s->stop);
    return !s->stopped;
}

/* All candidates of the state. */
static rg_status gather(search *s)
{
    const rg_mesh *m = &s->l->mesh;
    const rg_flat *f = &s->now.flat;
    rg_status status = RG_OK;
    unsigned char *done = rg_mem_array(&s->q->mem, (size_t)m->ne, 1);
    if (!done) return RG_ENOMEM;
    s->tol = ON_LINE * s->now.cells.tol;
    for (int32_t e = 0; status == RG_OK && !s->stopped && e < m->ne; e++) {
        if (f->turn[e] == 0 || done[e]) continue;
        part(s, e);
        for (int32_t i = e; i < m->ne; i++) done[i] |= (unsigned char)is_cut(s, i);
        for (int32_t g = 0; status == RG_OK && g < f->nf; g++) {
            if (s->body[g] != g || s->side[g] == 0) continue;
            if (!go_on(s)) break;
            for (int up = -1; status == RG_OK && up <= 1; up += 2)
                if (close(s, g, up)) status = keep(s, up);
        }
    }
    rg_mem_free(&s->q->mem, done);
    return status;
}

/* ----------------------------------------------------------------------------------------------- one stage ---- */

static int32_t size_of(const search *s, const rg_simple_fold *c)
{
    int32_t n = 0;
    for (int32_t g = 0; g < s->now.flat.nf; g++) n += c->moves[g];
    return n;
}

/* First what makes most creases, then what turns fewest layers. */
static int is_better(const search *s, const rg_simple_fold *c, const rg_simple_fold *old)
{
    if (c->creases != old->creases) return c->creases > old->creases;
    return size_of(s, c) < size_of(s, old);
}

/* Ways of a body's points, seen from above: straight across the line, to where they are mirrored. Do those of both lie
 * on the two sides of some line? Directions to try: along and across the creases of both, and the sheet's border where
 * it turns. */
static int parted_along(const search *s, const rg_simple_fold *const c[2], rg_vec2 d)
{
    const rg_mesh *m = &s->l->mesh;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int k = 0; k < 2; k++) {
        const rg_vec2 t = rg_vec2_sub(c[k]->b, c[k]->a);
        const double n = rg_vec2_dot(t, t);
        for (int32_t g = 0; g < s->now.flat.nf; g++)
            for (int32_t j = m->facet_start[g]; c[k]->moves[g] && j < m->facet_start[g + 1]; j++) {
                const rg_vec2 x = s->now.flat.x[m->facet_vertex[j]], r = rg_vec2_sub(x, c[k]->a);
                const double across = 2 * rg_vec2_cross(t, r) / n;
                const rg_vec2 y = {x.x + across * t.y, x.y - across * t.x};
                low[k] = fmin(low[k], fmin(rg_vec2_dot(d, x), rg_vec2_dot(d, y)));
                high[k] = fmax(high[k], fmax(rg_vec2_dot(d, x), rg_vec2_dot(d, y)));
            }
    }
    return high[0] <= low[1] + s->tol || high[1] <= low[0] + s->tol;
}

static int are_parted(const search *s, const rg_simple_fold *p, const rg_simple_fold *q)
{
    const rg_simple_fold *const c[2] = {p, q};
    const rg_mesh *m = &s->l->mesh;
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t *g = s->now.flat.beside[e];
        const int on_rim = g[0] < 0 || g[1] < 0;
        const int32_t h = g[g[0] < 0];
        if (!opens(s, p->moves, e) && !opens(s, q->moves, e) && !(on_rim && (p->moves[h] || q->moves[h]))) continue;
        rg_vec2 x[2];
        ends(s, e, x);
        rg_vec2 d = rg_vec2_sub(x[1], x[0]);
        const double n = rg_vec2_length(d);
        d = (rg_vec2){d.x / n, d.y / n};
        if (parted_along(s, c, d) || parted_along(s, c, (rg_vec2){-d.y, d.x})) return 1;
    }
    return 0;
}

/* May it go at once with those that the stage has? Bodies that turn up and down never meet; others do not where one
 * line parts their ways. No crease may join two that turn. */
static int goes_with(const search *s, const rg_simple_fold *c, int32_t first)
{
    for (int32_t k = first; k < s->q->folds; k++)
        if (c->up == s->q->fold[k].up && !are_parted(s, c, &s->q->fold[k])) return 0;
    for (int32_t e = 0; e < s->l->mesh.ne; e++) {
        const int32_t *g = s->now.flat.beside[e];
        if (!opens(s, c->moves, e)) continue;
        if (s->taken[g[0]] & 1 || s->taken[g[1]] & 1) return 0;
    }
    for (int32_t g = 0; g < s->now.flat.nf; g++)
        if (c->moves[g] && s->taken[g]) return 0;
    return 1;
}

/* Undoes it: its creases are flat, and what it turns lies the other way round, on top or at the bottom. */
static rg_status undo(search *s, rg_simple_fold *c)
{
    rg_simple *q = s->q;
    const rg_mesh *m = &s->l->mesh;
    const size_t nf = (size_t)q->nf;
    const rg_status status = RG_MEM_GROW(&q->mem, q->fold, q->room, (size_t)q->folds + 1);
    if (status != RG_OK) return status;
    c->stage = q->stages;
    c->over = c->up * q->up;
    q->fold[q->folds++] = *c;
    for (int32_t e = 0; e < m->ne; e++) {
        if (!opens(s, c->moves, e)) continue;
        q->stage[e] = q->stages;
        s->angle[m->edge_crease[e]] = 0;
        for (int k = 0; k < 2; k++) s->taken[s->now.flat.beside[e][k]] |= 2;
    }
    for (size_t f = 0; f < nf; f++) {
        if (c->moves[f]) s->taken[f] |= 1;
        for (size_t g = 0; g < nf; g++) {
            signed char *o = &q->above[f * nf + g];
            if (c->moves[f] && c->moves[g]) *o = (signed char)-*o;
            else if (c->moves[f] != c->moves[g]) *o = (signed char)(c->moves[g] ? c->up : -c->up);
        }
    }
    if (c->moves[s->l->flat.root]) q->up = -q->up;
    c->moves = NULL;
    return RG_OK;
}

/* One stage of undoing; *more: zero where there was none. */
static rg_status take_apart(search *s, int *more)
{
    const int32_t first = s->q->folds;
    *more = 0;
    s->count = 0;
    rg_status status = state_init(&s->now, &s->q->mem, &s->l->mesh, s->angle, s->stop, more);
    if (status == RG_OK && *more) status = gather(s);
    *more = *more && s->count > 0 && go_on(s);
    if (*more) s->q->stages++;
    memset(s->taken, 0, (size_t)s->q->nf);
    for (int32_t left = *more ? s->count : 0; status == RG_OK && left > 0; left--) {
        rg_simple_fold *best = NULL;
        for (int32_t k = 0; k < s->count; k++)
            if (s->found[k].moves && (!best || is_better(s, &s->found[k], best))) best = &s->found[k];
        if (!best) break;
        if (first == s->q->folds || goes_with(s, best, first)) status = undo(s, best);
        rg_mem_free(&s->q->mem, best->moves);
        best->moves = NULL;
    }
    for (int32_t k = 0; k < s->count; k++) rg_mem_free(&s->q->mem, s->found[k].moves);
    state_free(&s->now);
    return status;
}

/* ------------------------------------------------------------------------------------------------- all of it ---- */

static rg_status begin(search *s, const rg_memory *mem)
{
    rg_simple *q = s->q;
    const rg_layers *l = s->l;
    const rg_mesh *m = &l->mesh;
    const size_t nf = (size_t)l->flat.nf;
    q->mem = *mem;
    q->nf = l->flat.nf, q->ne = m->ne;
    q->up = 1;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(q->stage, (size_t)m->ne), RG_ARRAY(q->above, nf * nf),
                      RG_ARRAY(s->angle, (size_t)m->N), RG_ARRAY(s->off, (size_t)m->nv), RG_ARRAY(s->body, nf),
                      RG_ARRAY(s->first, nf), RG_ARRAY(s->next, nf), RG_ARRAY(s->side, nf), RG_ARRAY(s->in, nf),
                      RG_ARRAY(s->taken, nf), RG_ARRAY(s->queue, nf)) != RG_OK) return RG_ENOMEM;
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t *g = l->flat.beside[e];
        int turn = l->flat.turn[e];
        if (turn == RG_TURN_EITHER) turn = -l->flat.up[g[1]] * rg_layers_above(l, g[0], g[1]);
        q->stage[e] = turn ? 0 : -1;
        if (m->edge_crease[e] >= 0) s->angle[m->edge_crease[e]] = turn * RG_PI;
    }
    for (int32_t i = 0; i < l->pairs.count; i++) {
        const size_t f = (size_t)l->pairs.facet[i][0], g = (size_t)l->pairs.facet[i][1];
        q->above[f * nf + g] = l->orders.value[i];
        q->above[g * nf + f] = (signed char)-l->orders.value[i];
    }
    return RG_OK;
}

/* Undoing counts stages from the end, folding from the beginning. */
static void turn_round(rg_simple *q)
{
    for (int32_t i = 0, j = q->folds - 1; i < j; i++, j--) {
        const rg_simple_fold c = q->fold[i];
        q->fold[i] = q->fold[j];
        q->fold[j] = c;
    }
    for (int32_t k = 0; k < q->folds; k++) q->fold[k].stage = q->stages + 1 - q->fold[k].stage;
    for (int32_t e = 0; e < q->ne; e++) {
        if (q->stage[e] > 0) q->stage[e] = q->stages + 1 - q->stage[e];
        q->base += q->stage[e] == 0;
    }
}

rg_status rg_simple_find(rg_simple *q, const rg_memory *mem, const rg_layers *l, const rg_stop *stop)
{
    search s = {.l = l, .q = q, .stop = stop};
    int more = 1;
    memset(q, 0, sizeof *q);
    q->mem = *mem;
    if (l->flat.nf > MOST_FACETS) return RG_OK;
    rg_status status = begin(&s, mem);
    while (status == RG_OK && more) status = take_apart(&s, &more);
    if (status == RG_OK) turn_round(q);
    for (go_on(&s); s.stopped && q->folds > 0; q->folds--) rg_mem_free(mem, q->fold[q->folds - 1].moves);
    RG_MEM_FREE(mem, s.angle, s.off, s.body, s.first, s.next, s.side, s.in, s.taken, s.queue, s.found);
    return status;
}
