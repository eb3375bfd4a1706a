/* fold.h -- a crease pattern to FOLD 1.2.
 * Uses  base/json.h read/value.h        Used by  files/convert.c write/foldfile.c */
#ifndef RG_SAVE_FOLD_H
#define RG_SAVE_FOLD_H

#include "base/json.h"
#include "base/file.h"
#include "lines/lines.h"

/* The lines as a plane graph, with faces; all lent. */
typedef struct rg_fold_sheet {
    int32_t nv, ne, nf;
    const rg_vec2 *X;          /* [nv] */
    const int32_t *E;          /* [2 ne] */
    const char *letter;        /* [ne] FOLD's */
    const double *angle;       /* [ne] degrees */
    const int32_t *face_start; /* [nf + 1] into the two that follow */
    const int32_t *face_vertex, *face_edge;    /* edge k runs from vertex k to the next one */
    const int32_t *vertex_source, *edge_source; /* [nv], [ne] their numbers in lines.frame, -1: none; NULL: the same */
    int same_vertices, same_edges, same_faces; /* numbered as in lines.frame: what else is said there of them holds */
} rg_fold_sheet;

/* What a frame that was read says besides, as members of the object that is open: all of its keys but those named in
 * `ours` (ended by NULL) that still hold on a sheet so numbered. Returns how many do not. */
int32_t rg_fold_put_rest(rg_json *j, const rg_value *frame, const rg_fold_sheet *sheet, const char *const *ours);

/* Their numbers in the file that was read, null for what it does not have: of the first `known` of n, source[known]. */
void rg_fold_put_source(rg_json *j, const char *key, const int32_t *source, int32_t known, int32_t n);

/* Writes all or nothing. Every number reads back as the same double. What
 * l->frame says besides is written too where it still holds; *lost: out, how many of its keys are not. RG_EWRITE,
 * RG_ENOMEM: why->text. */
rg_status rg_fold_write(const rg_lines *l, const rg_fold_sheet *sheet, const rg_dest *to, int32_t *lost, rg_diag *why);

#endif
