/* paint.h -- how the lines of an SVG drawing are painted, and so what they are.
 * Uses  affine.h colour.h css.h ids.h kinds.h        Used by  svg.c */
#ifndef RG_PAINT_H
#define RG_PAINT_H

#include "read/affine.h"
#include "read/colour.h"
#include "read/css.h"
#include "read/ids.h"

/* What paint is understood by. */
typedef struct rg_painting {
    const rg_reading *s;
    rg_css css;
    rg_ids ids;
} rg_painting;

/* What an element hands down to those inside it. Texts are as long as a value of a style may be. */
typedef struct rg_paint {
    int stroked, hidden, known; /* known: `stroke` is its colour */
    rg_colour stroke;
    char paint[RG_CSS_VALUE], color[RG_CSS_VALUE], dash[RG_CSS_VALUE];
    const char *layer; /* what the inmost group around is called; NULL: nothing */
    char named;        /* what some name around says that it is; 0: nothing */
    char letter;       /* what data-assignment says; 0: nothing */
    int kind;          /* which of the user's kinds some name around is of; -1: none */
    double angle;      /* what data-foldAngle says, radians; NAN: nothing */
    double alpha, stroke_opacity, opacity; /* opacity: of all groups around too */
    double w, h;                           /* of the viewport, NAN: not known */
    rg_affine m;
} rg_paint;

/* What n is painted with, after what is around it. 0: it is not there at all. */
int rg_paint_inherit(rg_painting *w, const rg_xml_node *n, rg_paint *p);
/* The colour's name, the same for all ways to write it. */
const char *rg_paint_name(const rg_paint *p, char text[RG_CSS_VALUE]);
/* What a line that is painted so stands for: as the user says, by its own data, by its colour; by a name where the
 * colour says no more than that it is a line. *kind: which of the user's kinds, -1: none. */
char rg_paint_kind(const rg_painting *w, const rg_paint *p, int *kind);

#endif
