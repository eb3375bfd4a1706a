#include "layers/layers.h"
#include "base/status.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Words and cases that finding an order may look at, and counting orders: a few seconds. The most that a real pattern
 * took, of 541 facets with 7,662,993,408 orders, is 130 million. */
static const int64_t MOST_WORK = 200000000;
/* Facets that a reason names in words: what fits in a line. */
enum { IN_WORDS = 4 };

void rg_layers_destroy(rg_layers *l)
{
    if (!l) return;
    const rg_memory mem = l->mem;
    rg_mesh_free(&l->mesh);
    rg_flat_free(&l->flat);
    rg_cells_free(&l->cells);
    rg_pairs_free(&l->pairs);
    rg_constraints_free(&l->constraints);
    rg_orders_free(&l->orders);
    rg_parts_free(&l->parts);
    RG_MEM_FREE(&mem, l->count, l);
}

const rg_layers_info *rg_layers_get_info(const rg_layers *l) { return &l->info; }

static const char *rule_name(rg_rule rule)
{
    switch (rule) {
    case RG_RULE_HINGE: return "mountain and valley";
    case RG_RULE_TACO_TACO: return "taco-taco";
    case RG_RULE_TACO_TORTILLA: return "taco-tortilla";
    case RG_RULE_TORTILLA_TORTILLA: return "tortilla-tortilla";
    case RG_RULE_TRANSITIVITY: return "transitivity";
    }
    return "";
}

/* The same for who knows no such names. */
static const char *in_words(const char *rule)
{
    static const char *const words[][2] = {
        {"mountain and valley", "mountain and valley contradict each other there"},
        {"taco-taco", "two folds lie in each other, and would cross"},
        {"taco-tortilla", "a fold would go through the paper beside it"},
        {"tortilla-tortilla", "one layer would go through another along a line"},
        {"transitivity", "each would lie on the next, round in a circle"},
    };
    for (size_t k = 0; k < sizeof words / sizeof *words; k++)
        if (strcmp(rule, words[k][0]) == 0) return words[k][1];
    return "none of all the orders fits";
}

/* ------------------------------------------------------------------------------------------- what it is ---- */

static void say_unsolved(rg_layers *l, const char *words)
{
    l->info.state = RG_LAYERS_UNSOLVED;
    rg_text(l->info.reason, sizeof l->info.reason, "%s", words);
}

/* As the file has it; what rounding leaves of 0 is 0 for people. */
static rg_vec2 own(const rg_layers *l, rg_vec2 x)
{
    const double least = 1e-12 * l->mesh.size, y = l->y_down ? -x.y : x.y;
    return (rg_vec2){fabs(x.x) < least ? 0 : x.x, fabs(y) < least ? 0 : y};
}

/* More of the reason. */
static void say_more(rg_layers *l, const char *format, ...)
{
    const size_t used = strlen(l->info.reason);
    va_list args;
    va_start(args, format);
    rg_text_with(l->info.reason + used, sizeof l->info.reason - used, format, args);
    va_end(args);
}

/* "the facets at (x, y), ... cannot be put in order: WHY": as many as are named, and how many more. */
static void name_facets(rg_layers *l, const int32_t *facet, int32_t n)
{
    rg_layers_info *i = &l->info;
    const int32_t named = n < RG_LAYERS_NAMED ? n : RG_LAYERS_NAMED;
    rg_text(i->reason, sizeof i->reason, "the facets at");
    for (int32_t k = 0; k < named; k++) {
        const rg_vec2 at = l->flat.middle[facet[k]], x = own(l, at);
        l->where[k] = facet[k];
        l->where_at[k][0] = at.x, l->where_at[k][1] = l->y_down ? 0 - at.y : at.y;
        if (k < IN_WORDS) say_more(l, "%s (%.6g, %.6g)", k ? "," : "", x.x, x.y);
    }
    if (n > IN_WORDS) say_more(l, " and %d more", (int)(n - IN_WORDS));
    say_more(l, " cannot be put in order: %s", in_words(i->rule));
    i->where_count = named;
    i->where = l->where;
    i->where_at = (const double(*)[2])l->where_at;
}

/* There is none, as showed first at these facets: a few that have none by themselves, or if they are not found,
 * these. */
static rg_status say_none(rg_layers *l, const char *rule, const int32_t *facet, int32_t n)
{
    rg_blame b = {.facet = rg_mem_array(&l->mem, (size_t)l->flat.nf, sizeof *b.facet)};
    if (!b.facet) return RG_ENOMEM;
    const rg_status s = rg_blame_find(&b, &l->mem, &l->mesh, &l->flat, &l->cells, facet, n);
    l->info.state = RG_LAYERS_NONE;
    l->info.rule = b.count == 0 ? rule : b.by_trying ? "all together" : rule_name(b.rule);
    name_facets(l, b.count ? b.facet : facet, b.count ? b.count : n);
    rg_mem_free(&l->mem, b.facet);
    return s;
}

/* The sheet does not lie flat as its creases say: facets about a vertex stand for it. */
static void say_open(rg_layers *l)
{
    const rg_mesh *m = &l->mesh;
    const rg_vec2 x = own(l, m->X[l->flat.at_vertex]);
    int32_t facet[RG_LAYERS_NAMED], n = 0;
    for (int32_t i = 0; i < m->nf; i++)
        for (int32_t j = m->facet_start[i]; j < m->facet_start[i + 1] && n < RG_LAYERS_NAMED; j++) {
            const int32_t g = l->flat.facet_of[i];
            int is_there = 0;
            for (int32_t k = 0; k < n; k++) is_there |= facet[k] == g;
            if (m->facet_vertex[j] == l->flat.at_vertex && !is_there) facet[n++] = g;
        }
    l->info.state = RG_LAYERS_NONE;
    l->info.rule = "closing";
    name_facets(l, facet, n);
    rg_text(l->info.reason, sizeof l->info.reason, "folded flat, the facets round (%.6g, %.6g) do not meet", x.x, x.y);
}

static void say_not_flat(rg_layers *l)
{
    const int32_t *v = l->mesh.edge[l->flat.at_edge];
    const rg_vec2 a = own(l, l->mesh.X[v[0]]), b = own(l, l->mesh.X[v[1]]);
    l->info.state = RG_LAYERS_NOT_FLAT;
    rg_text(l->info.reason, sizeof l->info.reason,
            "the crease from (%.6g, %.6g) to (%.6g, %.6g) ends neither flat nor folded by half a turn", a.x, a.y,
            b.x, b.y);
}

/* The product of the parts as decimal digits. */
static rg_status write_count(rg_layers *l)
{
    static const char at_least[] = "at least ";
    enum { DIGITS_A_PART = 20 };
    const rg_parts *q = &l->parts;
    const size_t room = sizeof at_least + 2 + DIGITS_A_PART * (size_t)q->count;
    char *digit = rg_mem_array(&l->mem, 2 * room, 1); /* values, the last one first, and the next ones */
    l->count = rg_mem_array(&l->mem, room, 1);
    if (!digit || !l->count) {
        rg_mem_free(&l->mem, digit);
        return RG_ENOMEM;
    }
    char *next = digit + room;
    size_t n = 1;
    int more = 0;
    digit[0] = 1;
    for (int32_t i = 0; i < q->count; i++) {
        memset(next, 0, room);
        size_t shift = 0;
        for (uint64_t factor = q->counted[i]; factor; factor /= 10, shift++) {
            int carry = 0;
            for (size_t j = 0; j < n || carry; j++) {
                carry += next[j + shift] + (j < n ? digit[j] * (int)(factor % 10) : 0);
                next[j + shift] = (char)(carry % 10);
                carry /= 10;
            }
        }
        n += shift;
        while (n > 1 && !next[n - 1]) n--;
        memcpy(digit, next, n);
        more |= q->more[i];
    }
    char *to = l->count;
    if (more) to += rg_text(to, room, "%s", at_least);
    while (n) *to++ = (char)('0' + digit[--n]);
    rg_mem_free(&l->mem, digit);
    l->info.count = l->count;
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------------- finding ---- */

static rg_status solve(rg_layers *l)
{
    rg_status s = rg_orders_init(&l->orders, &l->mem, &l->pairs, &l->constraints);
    rg_count_result result;
    int32_t part = 0;
    if (s != RG_OK) return s;
    if (!rg_orders_set_hinges(&l->orders) || !rg_orders_propagate(&l->orders)) {
        const rg_conflict *c = &l->orders.conflict;
        return say_none(l, rule_name(c->rule), c->facet, c->n);
    }
    l->settled = l->info.settled = l->orders.known;
    s = rg_parts_init(&l->parts, &l->mem, &l->orders, MOST_WORK, &result, &part);
    if (s != RG_OK) return s;
    l->info.parts = l->parts.count;
    if (result == RG_COUNT_NONE) {
        const int32_t first = l->parts.pair[l->parts.start[part]];
        return say_none(l, "all together", l->pairs.facet[first], 2);
    }
    if (result != RG_COUNT_UNSOLVED) return write_count(l);
    say_unsolved(l, "the orders are too many to look through");
    return RG_OK;
}

rg_status rg_layers_of_mesh(const rg_mesh *m, const double *angle, int y_down, const rg_memory *mem,
                            const rg_stop *stop, rg_layers **layers, rg_diag *why)
{
    rg_layers *l = rg_mem_array(mem, 1, sizeof *l);
    rg_diag close = {0, ""};
    if (!l) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    l->mem = *mem;
    l->info.count = l->info.rule = "";
    l->y_down = y_down;
    rg_status s = rg_mesh_copy(m, &l->mesh);
    if (s == RG_OK) s = rg_flat_init(&l->flat, mem, &l->mesh, angle);
    l->info.facets = l->flat.nf;
    if (s == RG_OK && l->flat.state == RG_FLAT_ANGLE) say_not_flat(l);
    else if (s == RG_OK && l->flat.state == RG_FLAT_OPEN) say_open(l);
    else if (s == RG_OK && l->flat.state == RG_FLAT_UNTOLD)
        say_unsolved(l, "which of the undriven creases fold could not be told");
    else if (s == RG_OK) {
        s = rg_cells_init(&l->cells, mem, &l->mesh, &l->flat, stop, &close);
        if (s == RG_OK) s = rg_pairs_init(&l->pairs, mem, &l->cells, l->flat.nf, stop);
        if (s == RG_OK && rg_stop_asked(stop)) s = RG_EFORMAT;
        if (s == RG_OK) s = rg_constraints_init(&l->constraints, mem, &l->mesh, &l->flat, &l->cells, &l->pairs);
        l->info.pairs = l->pairs.count;
        if (s == RG_OK) s = solve(l);
        if (s == RG_EFORMAT) {
            s = RG_OK;
            const char *crowded = "folded flat, lines are too many or too close together to tell what lies on what";
            say_unsolved(l, rg_stop_asked(stop) ? "interrupted" : crowded);
        }
    }
    if (s != RG_OK) {
        rg_layers_destroy(l);
        return rg_fail(s, why, 0, "out of memory");
    }
    *layers = l;
    return RG_OK;
}

rg_status rg_layers_create(const rg_pattern *p, const rg_memory *memory, rg_layers **layers, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(memory);
    rg_mesh m;
    rg_status s = rg_mesh_from_pattern(p, &mem, &m, why);
    if (s != RG_OK) return s;
    double *angle = rg_mem_array(&mem, (size_t)m.N, sizeof *angle);
    if (!angle) s = rg_fail(RG_ENOMEM, why, 0, "out of memory");
    for (int32_t i = 0; s == RG_OK && i < m.N; i++) angle[i] = m.target[m.crease_edge[i]];
    if (s == RG_OK) s = rg_layers_of_mesh(&m, angle, p->lines.y_down, &mem, NULL, layers, why);
    rg_mem_free(&mem, angle);
    rg_mesh_free(&m);
    return s;
}

/* ------------------------------------------------------------------------------------- one of the orders ---- */

uint64_t rg_layers_part(const rg_layers *l, int32_t i)
{
    return l->info.state == RG_LAYERS_VALID && i >= 0 && i < l->parts.count ? l->parts.orders[i] : 0;
}

rg_status rg_layers_which(const rg_layers *l, uint64_t index, uint64_t *which)
{
    uint64_t rest = index;
    if (l->info.state != RG_LAYERS_VALID) return RG_EARG;
    for (int32_t i = 0; i < l->parts.count; i++) rest /= l->parts.orders[i];
    if (rest) return RG_EARG;
    for (int32_t i = 0; i < l->parts.count; i++) {
        which[i] = index % l->parts.orders[i];
        index /= l->parts.orders[i];
    }
    return RG_OK;
}

rg_status rg_layers_choose(rg_layers *l, const uint64_t *which)
{
    rg_status s = RG_OK;
    if (l->info.state != RG_LAYERS_VALID) return RG_EARG;
    for (int32_t i = 0; which && i < l->parts.count; i++)
        if (which[i] >= l->parts.orders[i]) return RG_EARG;
    rg_orders_undo(&l->orders, l->settled);
    for (int32_t i = 0; s == RG_OK && i < l->parts.count; i++)
        s = rg_parts_choose(&l->parts, &l->orders, i, which ? which[i] : 0);
    return s;
}

rg_status rg_layers_choose_near(rg_layers *l, const double *wish)
{
    rg_status s = l->info.state == RG_LAYERS_VALID ? RG_OK : RG_EARG;
    if (s == RG_OK) rg_orders_undo(&l->orders, l->settled);
    for (int32_t i = 0; s == RG_OK && i < l->parts.count; i++) s = rg_parts_choose_near(&l->parts, &l->orders, i, wish);
    return s;
}

rg_status rg_layers_order(rg_layers *l, const uint64_t *which, rg_layers_pair *pair)
{
    const rg_status s = rg_layers_choose(l, which);
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < l->pairs.count; i++) {
        const int32_t f = l->pairs.facet[i][1], g = l->pairs.facet[i][0];
        pair[i] = (rg_layers_pair){f, g, l->orders.value[i] * l->flat.up[g]};
    }
    return RG_OK;
}

/* ------------------------------------------------------------------------------------- looking at it ---- */

/* How far apart two facets of the mesh are across a side of the first one, negative: they are not. */
static double apart(const rg_layers *l, int32_t i, int32_t j)
{
    const rg_mesh *m = &l->mesh;
    const rg_vec2 *x = l->flat.x;
    const int32_t *v = m->facet_vertex + m->facet_start[i], n = m->facet_start[i + 1] - m->facet_start[i];
    double most = -INFINITY;
    for (int32_t k = 0; k < n; k++) {
        const rg_vec2 a = x[v[k]], d = rg_vec2_sub(x[v[(k + 1) % n]], a);
        const double length = rg_vec2_length(d), out = -l->flat.up[l->flat.facet_of[i]] / length;
        double least = INFINITY;
        for (int32_t q = m->facet_start[j]; q < m->facet_start[j + 1]; q++)
            least = fmin(least, out * rg_vec2_cross(d, rg_vec2_sub(x[m->facet_vertex[q]], a)));
        most = fmax(most, least);
    }
    return most;
}

/* Facets that were drawn whole are as the pair says. Triangles of cut ones may lie beside each other. */
int rg_layers_above_of_mesh(const rg_layers *l, int32_t i, int32_t j)
{
    const int32_t f = l->flat.facet_of[i], g = l->flat.facet_of[j];
    const int above = rg_layers_above(l, f, g);
    const int32_t *part = l->flat.part_start;
    const int whole = part[f + 1] - part[f] == 1 && part[g + 1] - part[g] == 1;
    return above && (whole || (apart(l, i, j) < -l->cells.tol && apart(l, j, i) < -l->cells.tol)) ? above : 0;
}

typedef struct climb {
    const rg_layers *l;
    int32_t *under;  /* [nf] facets right under each that have no level yet; -1: it has one */
    int32_t *queue;  /* [nf] those with a level, and those that can get one */
    int32_t *ring;   /* [nf] scratch: facets of a circle */
    int32_t *mark;   /* [nf] */
    /* [pairs] one of the two is the topmost or the lowest facet somewhere where both are: a mistake would be seen */
    unsigned char *seen;
    int32_t head, tail;
} climb;

/* Of the facets over a cell the one on top (side 1) or lowest (-1). */
static int32_t outermost(const rg_layers *l, const int32_t *facet, int32_t n, int side)
{
    int32_t best = facet[0];
    for (int32_t i = 1; i < n; i++)
        if (rg_layers_above(l, best, facet[i]) == side) best = facet[i];
    return best;
}

static void mark_seen(const rg_layers *l, unsigned char *seen)
{
    const rg_cells *c = &l->cells;
    for (int32_t i = 0; i < c->faces.count; i++) {
        const int32_t *facet = c->over + c->over_start[i], n = c->over_start[i + 1] - c->over_start[i];
        for (int side = -1; side <= 1 && n > 1; side += 2) {
            const int32_t f = outermost(l, facet, n, side);
            for (int32_t j = 0; j < n; j++)
                if (facet[j] != f) seen[rg_pairs_find(&l->pairs, f, facet[j])] = 1;
        }
    }
}

/* Goes from facet f to what lies above it (below: -1) and has no level, over facets with one mark, which get another.
 * Returns how many it found, in c->ring. */
static int32_t spread(climb *c, int32_t f, int side, int32_t from, int32_t to)
{
    const rg_pairs *p = &c->l->pairs;
    int32_t n = 0;
    c->ring[n++] = f;
    c->mark[f] = to;
    for (int32_t i = 0; i < n; i++)
        for (int32_t j = p->start[c->ring[i]]; j < p->start[c->ring[i] + 1]; j++) {
            const int32_t *of = p->facet[p->number[j]], g = of[of[0] == c->ring[i]];
            if (c->mark[g] != from || rg_layers_above(c->l, c->ring[i], g) != side) continue;
            c->mark[g] = to;
            c->ring[n++] = g;
        }
    return n;
}

/* Which facet to let through where all that wait lie on one that waits: of a circle with nothing but itself under it,
 * the one that has least of it below, what would be seen first. */
static int32_t cut_circle(climb *c)
{
    const int32_t nf = c->l->flat.nf;
    const rg_pairs *p = &c->l->pairs;
    int32_t root = -1, best = -1;
    int64_t least = 0;
    for (int32_t f = 0; f < nf; f++) c->mark[f] = c->under[f] > 0;
    /* Whoever lies under the last root of all has been reached from it: they are in one circle. */
    for (int32_t f = 0; f < nf; f++)
        if (c->mark[f] == 1) spread(c, root = f, 1, 1, 2);
    const int32_t n = spread(c, root, -1, 2, 3);
    for (int32_t i = 0; i < n; i++) {
        const int32_t f = c->ring[i];
        int64_t below = 0;
        for (int32_t j = p->start[f]; j < p->start[f + 1]; j++) {
            const int32_t *of = p->facet[p->number[j]], g = of[of[0] == f];
            if (c->mark[g] == 3 && rg_layers_above(c->l, f, g) < 0) below += c->seen[p->number[j]] ? nf : 1;
        }
        if (best >= 0 && below >= least) continue;
        best = f, least = below;
    }
    return best;
}

/* Gives facet f its turn: what lies on it comes higher, and what should lie under it but has not had its turn yet
 * too. */
static void climb_over(climb *c, int32_t f, int32_t *level)
{
    const rg_pairs *p = &c->l->pairs;
    for (int32_t j = p->start[f]; j < p->start[f + 1]; j++) {
        const int32_t *of = p->facet[p->number[j]], g = of[of[0] == f];
        if (c->under[g] < 0) continue;
        if (level[g] <= level[f]) level[g] = level[f] + 1;
        if (rg_layers_above(c->l, f, g) > 0 && --c->under[g] == 0) c->queue[c->tail++] = g;
    }
}

int32_t rg_layers_levels(const rg_layers *l, int32_t *level, int32_t *cuts)
{
    const rg_pairs *p = &l->pairs;
    const size_t nf = (size_t)l->flat.nf;
    int32_t *room = rg_mem_array(&l->mem, 4 * nf, sizeof *room), top = 0, cut = 0;
    unsigned char *seen = rg_mem_array(&l->mem, (size_t)p->count, 1);
    if (!room || !seen) {
        RG_MEM_FREE(&l->mem, room, seen);
        return -1;
    }
    climb c = {l, room, room + nf, room + 2 * nf, room + 3 * nf, seen, 0, 0};
    mark_seen(l, c.seen);
    for (int32_t i = 0; i < p->count; i++) c.under[p->facet[i][l->orders.value[i] > 0]]++;
    for (int32_t f = 0; f < l->flat.nf; f++) {
        level[f] = 0;
        if (!c.under[f]) c.queue[c.tail++] = f;
    }
    for (; c.head < l->flat.nf; c.head++) {
        if (c.head == c.tail) {
            c.queue[c.tail++] = cut_circle(&c);
            cut++;
        }
        const int32_t f = c.queue[c.head];
        c.under[f] = -1;
        if (level[f] > top) top = level[f];
        climb_over(&c, f, level);
    }
    RG_MEM_FREE(&l->mem, room, c.seen);
    if (cuts) *cuts = cut;
    return top + 1;
}

const char *rg_layers_state_name(rg_layers_state s)
{
    switch (s) {
    case RG_LAYERS_VALID: return "valid";
    case RG_LAYERS_NONE: return "none";
    case RG_LAYERS_UNSOLVED: return "unsolved";
    case RG_LAYERS_NOT_FLAT: return "not flat";
    }
    return "";
}
