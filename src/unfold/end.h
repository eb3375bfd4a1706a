/* end.h -- what must hold where the flat-folded end begins to open: rows from its order of layers.
 * Uses  linkage.h sides.h nearest.h        Used by  open.c stride.c
 *
 * At the flat end all facets lie in one plane, and only the order tells them apart. To first order in how far creases
 * are open, what must hold is linear in positions; rows that lie in the plane speak at second order. With A under B the
 * facets of a folded crease K, m in the plane, across K, into the paper:
 *
 *   LAYER   two facets overlap                               up . (upper - lower) >= 0   at the corners of what they
 *                                                            share, unless a third facet lies between them there
 *   INSIDE  a folded crease, border or corner on K, with     m . (it - K) >= 0
 *           facets between A and B
 *   ROUND   a corner on K with facets over B and under A     m . (K - it) >= 0
 *   BESIDE  paper on the two sides of one line, and no       m . (K - it) >= 0           (a choice: that they pass
 *           third facet that lies between them               over each other is as well possible)
 *
 * What a crease's two facets ask of a facet over or under both follows from LAYER. Vectors are carried by a facet, as a
 * stack whose creases are still closed turns as a whole. */
#ifndef RG_END_H
#define RG_END_H

#include "base/stop.h"
#include "unfold/linkage.h"
#include "unfold/nearest.h"
#include "unfold/sides.h"

/* ROUND counts as INSIDE. */
typedef enum rg_end_kind { RG_END_LAYER, RG_END_INSIDE, RG_END_BESIDE } rg_end_kind;

typedef struct rg_end_row {
    rg_end_kind kind;
    int32_t terms, v[RG_ROW_TERMS];
    double weight[RG_ROW_TERMS];
    int32_t frame, other; /* the facet that carries n, and one of the other side */
    rg_vec3 n;            /* unit, in the facet's own coordinates */
    int32_t i, j;         /* LAYER: the pair of proximity.h that it is about, a corner and a facet or two edges */
    int edges;            /* which of them; i negative: neither */
} rg_end_row;

typedef struct rg_end_rules {
    int more; /* rows that are sufficient but not always needed: ROUND, and BESIDE for corners, too; and BESIDE of edges
               * is left out where LAYER keeps the two apart */
    int keep; /* the rows are kept while it unfolds, as long as they are of what lies there */
} rg_end_rules;

typedef struct rg_end {
    rg_memory mem;
    double *z;           /* [n] the flat end: fold angles, and its pattern */
    rg_end_row *row;
    size_t room;
    int32_t count;
    rg_sides sides;
    int keep;            /* of the rules */
    rg_vec2 *x;          /* [nv] positions in the plane */
} rg_end;

/* The order between facets of the linkage's mesh. */
typedef struct rg_end_order {
    /* +1: f lies over g, seen with the front of the linkage's first facet up; 0: no overlap */
    int (*above)(void *ctx, int32_t f, int32_t g);
    void *ctx;
    const rg_stop *stop; /* NULL: nobody can end it; once it was asked for, not all of the end is there */
} rg_end_order;

/* z[n]: the flat end, fold angles 0 or half a turn. RG_ENOMEM. Owner: the caller, rg_end_free, also after a failure. */
rg_status rg_end_init(rg_end *e, const rg_memory *mem, rg_linkage *P, const double *z, const rg_end_rules *rules,
                      const rg_end_order *order);
void rg_end_free(rg_end *e);

/* Rows are of fixed places, which slide on each other later: they speak as long as what they are about still lies
 * there. */
int rg_end_is_live(const rg_end_row *row, const rg_linkage *P);
/* Non-zero: where P is put, a facet lies under one that it is over at the end, all over their common place: it has gone
 * round it, and could come back only through it. */
int rg_end_is_upset(const rg_end *e, const rg_linkage *P);
/* n of a row where the linkage is put now, and how far apart it says its parts are. */
rg_vec3 rg_end_normal(const rg_end_row *row, const rg_place *place);
double rg_end_gap(const rg_end_row *row, const rg_place *place, const rg_vec3 *p);

#endif
