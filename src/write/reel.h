/* reel.h -- pictures kept to be shown again backwards: runs of one colour, as drawings mostly are.
 * Uses  base        Used by  film.c */
#ifndef RG_REEL_H
#define RG_REEL_H

#include "base/memory.h"

typedef struct rg_reel {
    size_t pixels;        /* of each picture */
    unsigned char *bytes; /* runs: how long, 1 ... 255, then red, green, blue */
    size_t used, room;
    size_t *start;        /* [count] */
    size_t start_room;
    int32_t count;
} rg_reel;

/* *r is zeroed but for pixels at first. RG_ENOMEM: the picture is not kept. Owner: the caller, rg_reel_free. */
rg_status rg_reel_keep(rg_reel *r, const rg_memory *mem, const unsigned char *rgb);
/* rgb[3 pixels]: out, the i-th that was kept. */
void rg_reel_show(const rg_reel *r, int32_t i, unsigned char *rgb);
void rg_reel_free(rg_reel *r, const rg_memory *mem);

#endif
