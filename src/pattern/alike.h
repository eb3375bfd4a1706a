/* alike.h -- how a pattern is like itself: turned, and mirrored.
 * Uses  maps.h        Used by  write/info.c chart.c */
#ifndef RG_ALIKE_H
#define RG_ALIKE_H

#include "pattern/pattern.h"

enum { RG_MOST_MIRRORS = 24 };

/* About the mean of the vertices; a line through it is at 0 ... 180 degrees from the x axis, counter-clockwise. */
typedef struct rg_likeness {
    int32_t turns; /* how many turns take the pattern to itself, the one by nothing among them */
    int32_t mirrors;
    double mirror[RG_MOST_MIRRORS]; /* lines, degrees, rising; of more, the first ones */
} rg_likeness;

typedef struct rg_alike {
    rg_likeness same;      /* every crease to one that folds alike */
    rg_likeness exchanged; /* mountains to valleys and the other way round; its turns do not count the one by nothing */
    int32_t order;              /* how many of both, the one by nothing among them */
    int32_t creases, vertices;  /* orbits: of creases, and of vertices inside the sheet */
} rg_alike;

/* RG_ENOMEM. */
rg_status rg_alike_find(const rg_pattern *p, rg_alike *a);

#endif
