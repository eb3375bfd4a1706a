/* colour.h -- the colours that programs draw crease patterns in.
 * Used by  dxf.c kinds.c paint.h
 *
 * All draw mountains red, valleys blue and the border black. Yellow is a facet's diagonal (Origami Simulator), gray and
 * cyan are auxiliary (ORIPA, Flat-Folder, Oriedita); magenta is a crease that is not driven (Origami Simulator), orange
 * one that is not assigned (ORIPA); green is a cut in the paper (Origami Simulator). */
#ifndef RG_COLOUR_H
#define RG_COLOUR_H

typedef struct rg_colour { double r, g, b; } rg_colour; /* 0 ... 1 */

/* The assignment drawn in that colour, by its hue; 'B' for a cut, which is a border inside. */
char rg_colour_assignment(rg_colour c);
/* A colour as CSS writes it: a name, #rgb, #rrggbb (with or without alpha), rgb(), rgba(), hsl(), hsla(). *alpha is set
 * in any case. 0: none of these. */
int rg_colour_parse(const char *s, rg_colour *c, double *alpha);
/* A colour of AutoCAD's index, 1 ... 255. */
char rg_colour_index_assignment(int index);

#endif
