/* apng.h -- an animation as APNG: true colour, and of each picture only the rectangle that changed.
 * Uses  base        Used by  film.c */
#ifndef RG_APNG_H
#define RG_APNG_H

#include "base/memory.h"
#include <stdio.h>

typedef struct rg_apng rg_apng;

/* `frames` pictures will be added, at least 1. for_ever: it goes round, else it is shown once.
 * RG_EWRITE, RG_ENOMEM: why->text says why; the file is then of no use. It stays open and the caller's.
 * Owner: the caller, rg_apng_destroy (NULL is fine). */
rg_status rg_apng_create(const rg_memory *mem, FILE *file, int32_t width, int32_t height, double fps, int32_t frames,
                         int for_ever, rg_apng **apng, rg_diag *why);
/* rgb: rows of pixels of 3 bytes, top row first. times: how long it is shown, over what fps says. */
rg_status rg_apng_add(rg_apng *a, const unsigned char *rgb, double times, rg_diag *why);
/* The end of the file; nothing can be added after it. */
rg_status rg_apng_finish(rg_apng *a, rg_diag *why);
void rg_apng_destroy(rg_apng *a);

#endif
