#include "motion/gaps.h"

#include <string.h>

/* The most that a crease turns from one state to the next. Half a sheet that turns by so much lies nowhere farther from
 * its chord than twice RG_CONTACT_BETWEEN of the sheet: what is not proved is no thicker than that. */
static const double MOST_TURN = 5 * RG_DEG;
/* The most of the way from one to the next: what turns out and back between two frames does not show in them. */
static const double MOST_WAY = 0.02;
/* Ways are halved so often at most: where a crease turns faster still, halving finds no end. */
enum { DEEPEST = 13 };

void rg_gaps_free(rg_gaps *g, const rg_memory *mem)
{
    RG_MEM_FREE(mem, g->after, g->rho, g->flat);
    memset(g, 0, sizeof *g);
}

rg_status rg_gaps_add(rg_gaps *g, const rg_memory *mem, const rg_mesh *m, int32_t after, const double *rho,
                      const rg_vec2 *X)
{
    const size_t k = (size_t)g->count, N = (size_t)m->N, nv = (size_t)m->nv;
    rg_status s = RG_MEM_GROW(mem, g->after, g->room[0], k + 1);
    /* One more than there is, so that there is a place where a sheet has no crease. */
    if (s == RG_OK) s = RG_MEM_GROW(mem, g->rho, g->room[1], (k + 1) * N + 1);
    if (s == RG_OK && X) s = RG_MEM_GROW(mem, g->flat, g->room[2], (k + 1) * nv);
    if (s != RG_OK) return s;
    g->after[k] = after;
    if (N > 0) memcpy(g->rho + k * N, rho, N * sizeof *rho);
    if (X) memcpy(g->flat + k * nv, X, nv * sizeof *X);
    g->count++;
    return RG_OK;
}

const double *rg_gaps_angles(const rg_gaps *g, const rg_mesh *m, int32_t j)
{
    return g->rho + (size_t)j * (size_t)m->N;
}

const rg_vec2 *rg_gaps_pattern(const rg_gaps *g, const rg_mesh *m, int32_t j)
{
    return g->flat ? g->flat + (size_t)j * (size_t)m->nv : m->X;
}

double rg_gaps_turn(int32_t N, const double *a, const double *b)
{
    double most = 0;
    for (int32_t i = 0; i < N; i++) most = fmax(most, fabs(b[i] - a[i]));
    return most;
}

int32_t rg_gaps_leader(int32_t N, const double *a, const double *b)
{
    int32_t c = 0;
    for (int32_t i = 1; i < N; i++)
        if (fabs(b[i] - a[i]) > fabs(b[c] - a[c])) c = i;
    return c;
}

int32_t rg_gaps_parts(int32_t ways, double whole, double angle)
{
    const double parts = fmax(whole / MOST_WAY, angle / MOST_TURN) / ways;
    return parts > 1 ? (int32_t)fmin(1 << DEEPEST, ceil(parts)) : 1; /* 1 of NaN, too: who is asked next refuses it */
}

rg_status rg_gap_filler_init(rg_gap_filler *q, const rg_memory *mem, const rg_mesh *m, rg_gaps *g, int moves,
                             rg_path_reader *read, void *ctx)
{
    *q = (rg_gap_filler){.mem = *mem, .m = m, .gaps = g, .read = read, .ctx = ctx, .moves = moves};
    return RG_MEM_ARRAYS(mem, RG_ARRAY(q->rho, (size_t)DEEPEST * (size_t)m->N),
                         RG_ARRAY(q->flat, (size_t)DEEPEST * (size_t)m->nv));
}

void rg_gap_filler_free(rg_gap_filler *q)
{
    if (!q->mem.resize) return;
    RG_MEM_FREE(&q->mem, q->rho, q->flat);
    memset(q, 0, sizeof *q);
}

/* Between two states at s0 and s1, after so many halvings. Where the path has nothing between them there is no more to
 * be had. */
static rg_status halve(rg_gap_filler *q, int32_t after, double s0, const double *a, double s1, const double *b,
                       int halvings)
{
    const int32_t N = q->m->N;
    const int is_short = fabs(s1 - s0) <= MOST_WAY;
    if (halvings == DEEPEST || (is_short && rg_gaps_turn(N, a, b) <= MOST_TURN)) return RG_OK;
    const double s = s0 + (s1 - s0) / 2;
    double *rho = q->rho + (size_t)halvings * (size_t)N;
    rg_vec2 *X = q->flat + (size_t)halvings * (size_t)q->m->nv;
    if (!q->read(q->ctx, s, rho, X)) return RG_OK;
    if (is_short && (rg_gaps_turn(N, a, rho) == 0 || rg_gaps_turn(N, b, rho) == 0)) return RG_OK;
    rg_status status = halve(q, after, s0, a, s, rho, halvings + 1);
    if (status == RG_OK) status = rg_gaps_add(q->gaps, &q->mem, q->m, after, rho, q->moves ? X : NULL);
    return status == RG_OK ? halve(q, after, s, rho, s1, b, halvings + 1) : status;
}

rg_status rg_gap_fill(rg_gap_filler *q, int32_t after, double s0, const double *a, double s1, const double *b)
{
    return halve(q, after, s0, a, s1, b, 0);
}
