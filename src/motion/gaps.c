#include "motion/gaps.h"

#include <math.h>
#include <string.h>

/* The most that a crease turns from one state to the next. Half a sheet that turns by so much lies nowhere farther from its chord than
 * RG_CONTACT_BETWEEN of the sheet, twice: 2 (5 deg)^2 / 8 / 2 = 9.5e-4; so that all that is not proved there is that thin. */
static const double MOST_TURN = 5 * RG_DEG;
/* The most of the way from one to the next: what turns out and back between two frames would not be seen by its ends. */
static const double MOST_WAY = 0.02;
/* Ways are halved so often at most: where a crease turns faster still, halving finds no end. */
enum { DEEPEST = 13 };

void rg_gaps_free(rg_gaps *g, const rg_memory *mem)
{
    RG_MEM_FREE(mem, g->after, g->rho, g->flat);
    memset(g, 0, sizeof *g);
}

rg_status rg_gaps_add(rg_gaps *g, const rg_memory *mem, int32_t N, int32_t nv, int32_t after, const double *rho, const rg_vec2 *X)
{
    const size_t k = (size_t)g->count;
    rg_status s = RG_MEM_GROW(mem, g->after, g->room[0], k + 1);
    /* One more than there is, so that there is a place where a sheet has no crease. */
    if (s == RG_OK) s = RG_MEM_GROW(mem, g->rho, g->room[1], (k + 1) * (size_t)N + 1);
    if (s == RG_OK && X) s = RG_MEM_GROW(mem, g->flat, g->room[2], (k + 1) * (size_t)nv);
    if (s != RG_OK) return s;
    g->after[k] = after;
    if (N > 0) memcpy(g->rho + k * (size_t)N, rho, (size_t)N * sizeof *rho);
    if (X) memcpy(g->flat + k * (size_t)nv, X, (size_t)nv * sizeof *X);
    g->count++;
    return RG_OK;
}

rg_status rg_gaps_copy(rg_gaps *g, const rg_memory *mem, int32_t N, int32_t nv, const rg_gaps *from)
{
    rg_status s = RG_OK;
    for (int32_t k = 0; s == RG_OK && k < from->count; k++)
        s = rg_gaps_add(g, mem, N, nv, from->after[k], from->rho + (size_t)k * (size_t)N,
                        from->flat ? from->flat + (size_t)k * (size_t)nv : NULL);
    return s;
}

static double turn(int32_t N, const double *a, const double *b)
{
    double most = 0;
    for (int32_t i = 0; i < N; i++) most = fmax(most, fabs(b[i] - a[i]));
    return most;
}

static int are_near(int32_t N, const double *a, const double *b, double s0, double s1)
{
    return turn(N, a, b) <= MOST_TURN && fabs(s1 - s0) <= MOST_WAY;
}

int32_t rg_gaps_parts(int32_t ways, double whole, double angle)
{
    const double parts = fmax(whole / MOST_WAY, angle / MOST_TURN) / ways;
    return parts > 1 ? (int32_t)fmin(1 << DEEPEST, ceil(parts)) : 1; /* 1 of NaN, too: who is asked next refuses it */
}

rg_status rg_gap_filler_init(rg_gap_filler *q, const rg_memory *mem, int32_t N, int32_t nv, int moves, rg_path_reader *read, void *ctx)
{
    *q = (rg_gap_filler){.mem = *mem, .N = N, .nv = nv, .read = read, .ctx = ctx, .moves = moves};
    return RG_MEM_ARRAYS(mem, RG_ARRAY(q->rho, (size_t)DEEPEST * (size_t)N),
                         RG_ARRAY(q->flat, (size_t)DEEPEST * (size_t)nv));
}

void rg_gap_filler_free(rg_gap_filler *q)
{
    if (!q->mem.resize) return;
    RG_MEM_FREE(&q->mem, q->rho, q->flat);
    memset(q, 0, sizeof *q);
}

/* Between two states at s0 and s1, after so many halvings. Where the path has nothing between them there is no more to be had. */
static rg_status halve(rg_gap_filler *q, rg_gaps *g, int32_t after, double s0, const double *a, double s1, const double *b, int halvings)
{
    if (halvings == DEEPEST || are_near(q->N, a, b, s0, s1)) return RG_OK;
    double *rho = q->rho + (size_t)halvings * (size_t)q->N, s = s0 + (s1 - s0) / 2;
    rg_vec2 *X = q->flat + (size_t)halvings * (size_t)q->nv;
    if (!q->read(q->ctx, s, rho, X)) return RG_OK;
    if (fabs(s1 - s0) <= MOST_WAY && (turn(q->N, a, rho) == 0 || turn(q->N, b, rho) == 0)) return RG_OK;
    rg_status status = halve(q, g, after, s0, a, s, rho, halvings + 1);
    if (status == RG_OK) status = rg_gaps_add(g, &q->mem, q->N, q->nv, after, rho, q->moves ? X : NULL);
    return status == RG_OK ? halve(q, g, after, s, rho, s1, b, halvings + 1) : status;
}

rg_status rg_gap_fill(rg_gap_filler *q, rg_gaps *g, int32_t after, double s0, const double *a, double s1, const double *b)
{
    return halve(q, g, after, s0, a, s1, b, 0);
}

rg_status rg_gaps_fill(rg_gap_filler *q, rg_gaps *g, const double *rho, const double *due, int32_t frames)
{
    rg_status s = RG_OK;
    for (int32_t k = 0; s == RG_OK && k + 1 < frames; k++)
        s = rg_gap_fill(q, g, k, due[k], rho + (size_t)k * (size_t)q->N, due[k + 1], rho + (size_t)(k + 1) * (size_t)q->N);
    return s;
}
