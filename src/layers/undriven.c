#include "layers/undriven.h"

/* Angles of one vertex that should cancel, radians: more than drawings by eye are off, less than a sector. What is
 * really off then shows where the facets are put together. */
static const double CANCEL = 1 * RG_DEG;
/* Creases without a target at one vertex: 2^12 ways are looked at; a vertex with more is left flat. */
enum { MOST_UNTOLD = 12 };

typedef struct choice { int32_t edge[MOST_UNTOLD], n; unsigned any, all, fewest, ways; } choice;

static int bits(unsigned x) { return __builtin_popcount(x); }

/* By how much vertex k does not close with the creases folded that are, and of those untold the ones in `folded`. */
static double off_by(const rg_mesh *m, int32_t k, const signed char *turn, unsigned folded)
{
    double sum = 0;
    int sign = 1, next = 0, folds = 0;
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
        const int t = turn[m->crease_edge[m->loop_crease[j]]];
        if (t == RG_TURN_UNTOLD ? folded >> next++ & 1 : t != 0) sign = -sign, folds++;
        sum += sign * m->loop_theta[j];
    }
    return sign < 0 ? INFINITY : folds ? fabs(sum) : 0; /* no fold: once round, in the plane */
}

double rg_undriven_off(const rg_mesh *m, int32_t k, const signed char *turn) { return off_by(m, k, turn, 0); }

/* The ways in which vertex k can close: creases folded in any, in all of them, and the way with the fewest. 0: too many
 * creases. */
static int look(const rg_mesh *m, int32_t k, const signed char *turn, choice *c)
{
    *c = (choice){.all = ~0u};
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
        const int32_t e = m->crease_edge[m->loop_crease[j]];
        if (turn[e] != RG_TURN_UNTOLD) continue;
        if (c->n == MOST_UNTOLD) return 0;
        c->edge[c->n++] = e;
    }
    for (unsigned folded = 0; folded < 1u << c->n; folded++) {
        if (!(off_by(m, k, turn, folded) <= CANCEL)) continue;
        if (!c->ways++ || bits(folded) < bits(c->fewest)) c->fewest = folded;
        c->any |= folded;
        c->all &= folded;
    }
    return 1;
}

/* Settles what all ways of a vertex agree on, or the way with the fewest folds. Returns how many creases it settled. */
static int settle(const choice *c, int guess, signed char *turn)
{
    int settled = 0;
    for (int32_t i = 0; i < c->n; i++) {
        const unsigned bit = 1u << i;
        if (guess ? c->fewest & bit : c->all & bit) turn[c->edge[i]] = RG_TURN_EITHER;
        else if (guess || !(c->any & bit)) turn[c->edge[i]] = 0;
        else continue;
        settled++;
    }
    return settled;
}

/* More creases than can be looked at stay flat. */
static void leave_flat(const rg_mesh *m, int32_t k, signed char *turn)
{
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
        const int32_t e = m->crease_edge[m->loop_crease[j]];
        if (turn[e] == RG_TURN_UNTOLD) turn[e] = 0;
    }
}

rg_status rg_undriven_decide(const rg_mesh *m, signed char *turn, int32_t *at, int *guessed)
{
    /* Vertices with creases untold, or not looked at yet. */
    unsigned char *open = rg_mem_array(&m->mem, (size_t)m->M, 1);
    if (!open) return RG_ENOMEM;
    *at = -1, *guessed = 0;
    for (int32_t k = 0; k < m->M; k++) open[k] = 1;
    for (int guess = 0, left = m->M; *at < 0 && left > 0;) {
        int done = 0;
        for (int32_t k = 0; k < m->M && *at < 0; k++) {
            choice c;
            if (!open[k]) continue;
            if (!look(m, k, turn, &c)) {
                if (!guess) continue;
                leave_flat(m, k, turn);
                look(m, k, turn, &c);
                *guessed = 1;
            }
            if (!c.ways) {
                *at = m->inner_vertex[k];
                break;
            }
            *guessed |= guess && c.n > 0;
            const int settled = settle(&c, guess, turn);
            done += settled;
            if (settled == c.n) open[k] = 0, left--, done++;
            if (guess) break; /* what follows from it comes first */
        }
        guess = !done;
    }
    for (int32_t e = 0; e < m->ne; e++)
        if (turn[e] == RG_TURN_UNTOLD) turn[e] = 0;
    rg_mem_free(&m->mem, open);
    return RG_OK;
}
