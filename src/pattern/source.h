/* source.h -- which vertex, edge and face of the file each of ours is, so that its numbers, and what it says of them,
 * hold.
 * Uses  planar.h lines/lines.h        Used by  pattern.c, mesh/facets.c, motion, files/convert.c, write/foldfile.c */
#ifndef RG_SOURCE_H
#define RG_SOURCE_H

#include "pattern/planar.h"

/* Numbers the vertices of a graph that was read from a FOLD file as the file does: those that the file does not have
 * come last. Other files number no vertices. RG_ENOMEM. */
rg_status rg_source_sort(rg_graph *g, const rg_lines *lines);
/* of[nv]: out, the vertex of the file that each of the graph is, of several the lowest; -1: none. */
void rg_source_vertices(const rg_graph *g, const rg_lines *lines, int32_t *of);
/* Fills s: for every vertex the one of the file, -1 for none; for every edge the line of the drawing that it is (a part
 * of), from 0. Takes lines->frame over. RG_ENOMEM. Owner: the caller, rg_source_free. */
rg_status rg_source_init(rg_source *s, const rg_graph *g, rg_lines *lines);
/* A copy with an allocator of its own; the frame is shared. RG_ENOMEM leaves *out empty. */
rg_status rg_source_copy(const rg_source *s, const rg_memory *mem, rg_source *out);
/* Of a finer pattern: vertex[nv], edge[ne]: which of ours each of its vertices is, and which each of its edges is a
 * part of; -1: none. RG_ENOMEM leaves *s as it was. */
rg_status rg_source_follow(rg_source *s, int32_t nv, const int32_t *vertex, int32_t ne, const int32_t *edge);
void rg_source_free(rg_source *s);
/* source[nf]: out, the face of the file that has the vertices of each facet, -1: none. RG_ENOMEM. */
rg_status rg_source_faces(const rg_source *s, int32_t nf, const int32_t *facet_start, const int32_t *facet_vertex,
                          int32_t *source);

#endif
