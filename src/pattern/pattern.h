/* pattern.h -- a crease pattern as a plane graph, and what is known of it before folding.
 * Paper    sections 1, 2, 3.1        Uses  lines/lines.h        Used by  mesh, write */
#ifndef RG_PATTERN_H
#define RG_PATTERN_H

#include "base/memory.h"
#include "base/vec.h"
#include "lines/lines.h"

typedef struct rg_edge {
    int32_t v[2];
    char assignment;   /* 'B' exactly on the sheet's outer border, found topologically */
    double target;     /* wished final fold angle, radians: +pi valley, -pi mountain or as given; NAN: none (U, F) */
    int32_t where;     /* line of the file, 0: none */
    int32_t line;      /* of the drawing, from 0: that it is or is a part of */
} rg_edge;

/* Where our numbers come from, as pattern/source.h finds it. */
typedef struct rg_source {
    rg_memory mem;
    int32_t nv, ne, lines; /* lines: of the drawing */
    int32_t *vertex;       /* [nv] number in the file, -1: none; NULL: nothing is known */
    int32_t *edge, *where; /* [ne] line of the drawing, from 0, and of the file, 0: none */
    int y_down;            /* as in rg_lines */
    char *memo;            /* NULL: none */
    int32_t faces, *face_start, *face_vertex; /* that a FOLD file lists, as in rg_lines */
    rg_value *frame;       /* FOLD: all that the file says; NULL: no such file */
    const rg_keeper *keeper; /* of that */
} rg_source;

/* The graph after merging, splitting, dropping loose ends and dissolving straight-through vertices: what is folded.
 * Star of vertex v: star[star_start[v]] ... star[star_start[v+1] - 1], edge numbers counter-clockwise by direction. */
struct rg_pattern {
    rg_memory mem;
    int32_t nv, ne;
    rg_vec2 *X;           /* [nv] */
    rg_edge *E;           /* [ne] */
    int32_t *star_start;  /* [nv + 1] */
    int32_t *star;        /* [2 ne] */
    unsigned char *rim;   /* [nv] non-zero: on the outer border */
    rg_pattern_info info; /* info.title, info.author point into `lines` */
    double merge;         /* as it was asked for: rg_reading.merge */
    unsigned char *still; /* [ne] non-zero: its crease stays flat; NULL: none does */
    rg_plane plane;       /* what is lent of all this; its arrays: */
    int32_t (*ends)[2];   /* [ne] */
    char *letter;         /* [ne] */
    double *target;       /* [ne] */
    int32_t *where;       /* [ne] */
    int32_t *facet_start, *facet_vertex, *facet_edge; /* facet_edge[j] joins facet_vertex[j] to the facet's next one */
    rg_closed *closed;    /* every closed triple, by vertex */
    int32_t closed_triples;
    rg_unfoldable *unfoldable;
    int32_t unfoldables;
    rg_source source;
    rg_piece *piece;      /* [info.sheets] */
    rg_lines lines;       /* only its metadata and warnings are kept */
};

#endif
