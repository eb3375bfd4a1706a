/* tint.h -- facets in colours that tell what they do: strain, roll, speed, layer.
 * Uses  motion.h        Used by  frames.c html.c */
#ifndef RG_TINT_H
#define RG_TINT_H

#include "motion/motion.h"

/* By what facets are coloured, and from where to where the colours go. */
typedef struct rg_tint_scale {
    rg_colouring by;
    double most; /* what the last colour stands for: the largest in the motion; the first stands for 0 */
} rg_tint_scale;

rg_tint_scale rg_tint_of(const rg_motion *m, rg_colouring by);
/* Of frame k. lift[nf]: how far facets are moved for their layers, on the stage. rgb[nf]: out. */
void rg_tint_facets(const rg_tint_scale *t, const rg_motion *m, int32_t k, const rg_vec3 *lift,
                    unsigned char (*rgb)[3]);
/* "strain up to 0.12 %", "" for paper. */
void rg_tint_words(const rg_tint_scale *t, char *text, size_t room);

#endif
