/* assemble.h -- attempts on meshes of their own to one motion on one mesh.
 * Uses  states.h measure.h        Used by  assemble.c, rigami.h's rg_motion_create_states
 *
 * The mesh of the motion has the lines of all states and all attempts. An attempt's facets are rigid: a line of others
 * that crosses one of them stays flat in it, and goes with it where the pattern moves. */
#ifndef RG_ASSEMBLE_H
#define RG_ASSEMBLE_H

#include "motion/motion.h"
#include "motion/states.h"

/* Fills m->mesh, the frames, what was aimed at and what blocks; the report but for measurements. */
rg_status rg_assemble_frames(rg_motion *m, const rg_states *q, rg_diag *why);

#endif
