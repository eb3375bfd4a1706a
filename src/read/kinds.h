/* kinds.h -- what the user says of a drawing's colours, layers, names and dashes: `KEY=KIND`.
 * Uses  colour.h lines.h        Used by  paint.c svg.c dxf.c read.c
 *
 * KEY is what the drawing has: a colour (as CSS writes it, or AutoCAD's number or name of it), a layer, group or class,
 * a pattern of dashes (AutoCAD's name of it, or the lengths of a stroke-dasharray; solid). `colour:`, `layer:` or
 * `dash:` before it says which of these is meant. KIND: border, cut, mountain, valley, unassigned, aux, none. Of
 * several that fit a line the last counts. */
#ifndef RG_KINDS_H
#define RG_KINDS_H

#include "lines/lines.h"

/* A line that is left out, as its user wants it. */
#define RG_LEFT_OUT '-'

/* RG_EARG: one of s->kind says nothing, or there are more than RG_MOST_KINDS. */
rg_status rg_kinds_check(const rg_reading *s, rg_diag *why);
/* The last of s->kind that fits, -1: none. */
int rg_kinds_find(const rg_reading *s, rg_trait_sort sort, const char *name, size_t n);
/* What number i says: an assignment or RG_LEFT_OUT. */
char rg_kinds_letter(const rg_reading *s, int i);
/* Warns of those that no line was of. */
rg_status rg_kinds_warn_unused(const rg_reading *s, rg_lines *l);
/* What a layer's or group's name says by itself: mountain, valley, cut, border, aux ...; 0: nothing. */
char rg_kinds_of_name(const char *name, size_t n);

#endif
