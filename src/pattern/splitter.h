/* splitter.h -- a drawing that is being made plane: what its rounds of looking and cutting hand to each other.
 * Used by  planar.c crossings.c cuts.c */
#ifndef RG_SPLITTER_H
#define RG_SPLITTER_H

#include "base/order.h"
#include "pattern/graph.h"
#include "pattern/points.h"

/* A vertex's cell, by its column and row, and whether it is so near the next one that its edges are looked for there
 * as well: twice the first column or row that they are in, and one more if it is in two. column < 0: it is in more. */
typedef struct rg_cell_place { int16_t column, row; } rg_cell_place;

/* The edges of cell c are edge[start[c]] ... edge[start[c + 1] - 1], in ascending order. */
typedef struct rg_cell_edges { int32_t *start, *edge; size_t room; } rg_cell_edges;

typedef struct rg_splitter {
    rg_memory mem;
    rg_points points;
    rg_edge *E;
    int32_t ne;
    size_t room;
    unsigned char *fresh; /* [ne] not looked at yet: what was, crosses nothing that was */
    size_t fresh_room;
    int32_t fresh_count;
    /* [vertices] an edge was cut there, or one that was cut ends there, in this round; NULL: all may be */
    unsigned char *touched;
    size_t touched_room;
    double exact;      /* a cut that is no farther off its line than this leaves it where it was */
    int32_t looked_at; /* vertices below this one as well */
    rg_keyed *cuts;    /* of edge w at vertex v, key: how far along it */
    size_t cut_count, cut_room;
    /* Of vertices from `looked_at` on: the two edges that it was found to be the crossing of, which are cut. */
    int32_t (*parent)[2];
    size_t parent_room;
    const char *too_many;  /* of what: RG_EFORMAT */
    const rg_reading *ask; /* its progress, whether to go on; NULL: nobody */
    double progress;
    int64_t work;          /* since it was asked last */
    /* search grid: */
    rg_vec2 origin;
    double cell, per_cell; /* a cell's side, and one over it */
    int32_t side[2];
    rg_cell_edges all, news;  /* edges that are in any cell where something is to be looked at; those that are fresh */
    unsigned char *wanted;    /* [cells] something is to be looked at there */
    rg_cell_place *place;     /* [placed] of vertices */
    int32_t placed;
    size_t place_room;
} rg_splitter;

/* Cuts of one round: more than any drawing has that is not made to cost hours. */
enum { RG_MOST_CUTS = 1 << 24 };
/* Pairs, edges or vertices that are looked at before it is asked again whether to go on: a millisecond or less. */
enum { RG_SPLITTER_WORK = 10000 };

/* So much was done. RG_ECANCELLED: it is to end. */
static inline rg_status rg_splitter_done(rg_splitter *s, int64_t work)
{
    s->work += work;
    if (s->work < RG_SPLITTER_WORK) return RG_OK;
    s->work = 0;
    return s->ask && s->ask->progress && s->ask->progress(s->ask->progress_ctx, s->progress) ? RG_ECANCELLED : RG_OK;
}

#endif
