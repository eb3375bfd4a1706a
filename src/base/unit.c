#include "base/unit.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const struct { const char *name; double metres; } UNITS[] = {
    {"m", 1}, {"cm", 0.01}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}, {"in", 0.0254}, {"pt", 0.0254 / 72}};
/* Rounding of a computed one. */
static const double SAME = 1e-12;

double rg_unit_metres(const char *name)
{
    for (size_t i = 0; name && i < sizeof UNITS / sizeof *UNITS; i++)
        if (strcmp(name, UNITS[i].name) == 0) return UNITS[i].metres;
    return 0;
}

const char *rg_unit_name(double metres)
{
    for (size_t i = 0; i < sizeof UNITS / sizeof *UNITS; i++)
        if (fabs(metres - UNITS[i].metres) <= SAME * UNITS[i].metres) return UNITS[i].name;
    return NULL;
}
