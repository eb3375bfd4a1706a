/* planar.h -- lines as drawn to a plane graph: gaps closed, crossings and T-junctions split, doubles merged.
 * Uses  graph.h loose.h points.h overlap.h lines/lines.h        Used by  layers, pattern */
#ifndef RG_PLANAR_H
#define RG_PLANAR_H

#include "pattern/graph.h"

/* The graph of the lines that are part of the sheet: cuts of the folded model are left out, auxiliary lines too unless
 * they shall be creases, loose ends as well; what is left out is told in the lines' warnings.
 * Near-linear time in lines and crossings. RG_EFORMAT: the lines are too many or too close to tell apart, why->text.
 * s->progress is asked every millisecond or so; RG_ECANCELLED where it ends it.
 * Owner: the caller, rg_graph_free, also after a failure. */
rg_status rg_planar_from_lines(rg_lines *lines, const rg_reading *s, rg_graph *g, rg_diag *why);
/* The same of every line, with its own assignment and with loose ends, for whoever keeps the drawing: only doubles and
 * lines without length are left out. merge: as in rg_reading. Only the progress of `ask` counts; NULL: nobody is
 * asked. */
rg_status rg_planar_from_all_lines(rg_lines *lines, double merge, const rg_reading *ask, rg_graph *g, rg_diag *why);

#endif
