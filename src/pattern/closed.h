/* closed.h -- closed vertices: creases made by folding through two layers at once, which lock a rigid sheet.
 * Paper    section 3.1, Fig. 7        Uses  check.h
 * Used by  adjust.c inside.c build.c svgfile.c */
#ifndef RG_CLOSED_H
#define RG_CLOSED_H

#include "pattern/pattern.h"

/* Creases a, c, b that follow each other around a vertex, by assignment and by the angles between them: are they
 * closed, and which angle is the inside one? 1: that of a and c; 2: that of c and b; 0: they are not closed. */
int rg_closed_inside(char a, char c, char b, double ac, double cb);

/* Fills p->closed with every closed triple of creases, by vertex, and p->info.closed_vertices. RG_ENOMEM. */
rg_status rg_closed_find(struct rg_pattern *p);

#endif
