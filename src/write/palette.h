/* palette.h -- the few colours that show a whole film best.
 * Uses  base        Used by  gif.c */
#ifndef RG_PALETTE_H
#define RG_PALETTE_H

#include "base/memory.h"

enum { RG_PALETTE_COLOURS = 255 };

typedef struct rg_palette {
    rg_memory mem;
    unsigned char colour[RG_PALETTE_COLOURS][3];
    int32_t colours;        /* chosen */
    struct rg_tint *tint;   /* what was seen, by its upper bits */
    unsigned char *nearest; /* number of the colour to show a tint in, found when it is asked for */
} rg_palette;

/* RG_ENOMEM. Owner: the caller, rg_palette_free, also after a failure. */
rg_status rg_palette_init(rg_palette *p, const rg_memory *mem);
/* Looks at a picture. */
void rg_palette_see(rg_palette *p, const unsigned char *rgb, size_t pixels);
/* Chooses the colours, from all that was seen. RG_ENOMEM. */
rg_status rg_palette_choose(rg_palette *p);
/* The number of the colour that is nearest, the same for all colours of one tint. */
int rg_palette_index(rg_palette *p, const unsigned char rgb[3]);
void rg_palette_free(rg_palette *p);

#endif
