/* pieces.h -- facets as convex pieces.
 * Uses  record.h faults.h        Used by  apart.c through.c pile.c certificate.c */
#ifndef RG_PIECES_H
#define RG_PIECES_H

#include "verify/faults.h"
#include "verify/record.h"

/* Corners of one piece, and of what two of them have in common. */
enum { RG_PIECE_MOST = 24, RG_PIECE_COMMON = 2 * RG_PIECE_MOST };

/* A facet that is convex on the pattern of frame 0 is one piece, any other is cut into triangles. */
typedef struct rg_pieces {
    rg_memory mem;
    int32_t n;
    int32_t *facet;          /* [n], in order */
    int32_t *first;          /* [nf + 1] */
    int32_t *start, *corner; /* [n + 1], vertex numbers */
} rg_pieces;

/* RG_ENOMEM: *p is zeroed. */
rg_status rg_pieces_init(const rg_record *r, rg_pieces *p);
/* Faults: facets that are no simple polygons, and those that lie over each other in the pattern, which one flat sheet
 * has none of. */
rg_status rg_pieces_check(const rg_record *r, const rg_pieces *p, rg_faults *all);
void rg_pieces_free(rg_pieces *p);

/* What two convex polygons in a plane have in common, counter-clockwise; either way round they may be given. Returns
 * how many corners it has. */
int32_t rg_pieces_common(const rg_vec2 *a, int32_t na, const rg_vec2 *b, int32_t nb, rg_vec2 common[RG_PIECE_COMMON]);
double rg_pieces_area(const rg_vec2 *a, int32_t n);
/* As wide as twice the area over the half of the length round it. */
double rg_pieces_width(const rg_vec2 *a, int32_t n);

#endif
