/* kinds.h -- the patterns that can be drawn, one function each.
 * Uses  drawing.h        Used by  generate
 *
 * Each draws in units of its own; its file says which theorems hold where and what the numbers mean. */
#ifndef RG_KINDS_H
#define RG_KINDS_H

#include "generate/drawing.h"

/* Tessellations */
void rg_miura_draw(rg_sketch *d);
void rg_random_draw(rg_sketch *d);
void rg_waterbomb_draw(rg_sketch *d);
void rg_yoshimura_draw(rg_sketch *d);
void rg_kresling_draw(rg_sketch *d);
void rg_resch_draw(rg_sketch *d);

/* Concentric squares */
void rg_hypar_draw(rg_sketch *d);
void rg_boxpleat_draw(rg_sketch *d);

/* Traditional models */
void rg_preliminary_draw(rg_sketch *d);
void rg_waterbomb_base_draw(rg_sketch *d);
void rg_fish_draw(rg_sketch *d);
void rg_bird_draw(rg_sketch *d);
void rg_frog_draw(rg_sketch *d);
void rg_four_crane_draw(rg_sketch *d);
void rg_open_sink_draw(rg_sketch *d);
void rg_crane_draw(rg_sketch *d);
void rg_tatou_draw(rg_sketch *d);

/* Vertices that wait for each other */
void rg_closed_split_draw(rg_sketch *d);
void rg_closed_adjust_draw(rg_sketch *d);

#endif
