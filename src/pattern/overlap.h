/* overlap.h -- lines drawn over each other: each stretch between two ends becomes that of one of them.
 * Uses  pattern.h lines/lines.h        Used by  planar.c
 *
 * Without this, n lines nested in one line are cut into n^2 pieces before all but n of them are dropped. */
#ifndef RG_OVERLAP_H
#define RG_OVERLAP_H

#include "pattern/pattern.h"

/* 0 border, 1 mountain and valley, 2 the rest: of edges in one place the lowest stays, and of those the first. */
int rg_overlap_rank(char assignment);
/* Warns where a mountain and a valley lie on each other; does nothing for other edges. The first few are told (`told`
 * counts all). */
rg_status rg_overlap_warn(rg_lines *lines, const rg_vec2 *X, const rg_edge *keep, const rg_edge *other, int *told);
/* Warns of those that were not told. */
rg_status rg_overlap_warn_more(rg_lines *lines, int told);

/* Cuts edges that overlap along a line, as far as they are within the tolerance of it, at each other's ends, and keeps
 * one for each stretch. *E, *ne, *room: the edges, put anew in their order. X: vertices. n log n. RG_ENOMEM leaves *E
 * as it was. */
rg_status rg_overlap_resolve(rg_lines *lines, const rg_vec2 *X, double tol, double size, rg_edge **E, int32_t *ne,
                             size_t *room);

#endif
