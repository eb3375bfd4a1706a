/* picture.h -- what callers ask of pictures, and what cannot be asked.
 * Uses  settings.h        Used by  render, write */
#ifndef RG_PICTURE_H
#define RG_PICTURE_H

#include "rigami.h"

#define RG_MAX_PICTURE 16384 /* pixels; a picture's side, so that its bytes and its samples fit in 32 bits */

/* As rg_settings_take. */
rg_status rg_picture_take(const rg_picture *given, rg_picture *out, rg_diag *why);
/* RG_EARG: a size, an angle, the zoom or the rate is out of range, why->text says which. */
rg_status rg_picture_check(const rg_picture *p, rg_diag *why);
/* Does who watches end it? done: 0 ... 1. */
static inline int rg_picture_ended(const rg_picture *p, double done)
{
    return p->progress && p->progress(p->progress_ctx, done) != 0;
}

#endif
