/* unit.h -- units of length, as FOLD calls them.
 * Used by  read/fold.c, save, write */
#ifndef RG_UNIT_H
#define RG_UNIT_H

/* Metres in the unit of that name; 0: no length (or NULL). */
double rg_unit_metres(const char *name);
/* The name of a unit of so many metres; NULL: it has none. */
const char *rg_unit_name(double metres);

#endif
