/* aims.h -- what single creases are to do: --drive, --pin, --free.
 * Uses  options.h        Used by  fold */
#ifndef AIMS_H
#define AIMS_H

#include "options.h"

/* Pins and frees creases of the pattern; driven[o->aims]: out, those to be driven, *count of them. Returns an exit
 * status; what is wrong has been said. */
int aims_set(const options *o, const char *name, rg_pattern *p, rg_driven *driven, int32_t *count);

#endif
