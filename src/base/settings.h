/* settings.h -- what callers set: taken as far as they know it, and refused in one place.
 * Used by  every public function that takes rg_settings, rg_reading or rg_drawing; picture.c */
#ifndef RG_SETTINGS_H
#define RG_SETTINGS_H

#include "rigami.h"

/* A copy of what the caller gave, the usual values (NULL: all of them) for what it does not know. RG_EARG: a size that
 * is none, or something out of range, why->text says which; *out is then untouched. */
rg_status rg_settings_take(const rg_settings *given, rg_settings *out, rg_diag *why);
rg_status rg_reading_take(const rg_reading *given, rg_reading *out, rg_diag *why);
rg_status rg_drawing_take(const rg_drawing *given, rg_drawing *out, rg_diag *why);

/* The same of any struct that begins with its size: *out, of `own` bytes, holds the usual values and gets those of
 * `given`, which is `its` bytes long there and was at least `least` in the first version. */
rg_status rg_take(void *out, size_t own, const void *given, size_t its, size_t least, rg_diag *why);
/* The usual values, as many as fit into `size` bytes, and that size in front. */
void rg_give(void *out, size_t size, const void *usual, size_t own);

#endif
