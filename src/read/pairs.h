/* pairs.h -- group codes and values, of which a DXF file is made: a line each.
 * Uses  number.h        Used by  dxf.c tables.h */
#ifndef RG_PAIRS_H
#define RG_PAIRS_H

#include "lines/lines.h"

typedef struct rg_slice { const char *s; size_t n; } rg_slice; /* of the file's text */

typedef struct rg_pairs {
    const char *s, *end;
    int32_t line;  /* of the value of the last pair */
    long code;
    rg_slice value;
    int pending;   /* the last pair is to be read again */
    rg_diag *why;
    rg_lines *out; /* whose stop is asked */
} rg_pairs;

/* On to the next pair. A file that just ends is refused: it says EOF where it ends. RG_EFORMAT, RG_ECANCELLED. */
rg_status rg_pairs_next(rg_pairs *p);
/* What the last value says. RG_EFORMAT: no whole number; no finite number. */
rg_status rg_pairs_whole(const rg_pairs *p, long *x);
rg_status rg_pairs_number(const rg_pairs *p, double *x);

int rg_slice_is(rg_slice s, const char *word);
/* Names that are the same in small and capital letters; by what is in front in the order of letters. */
int rg_slice_compare(rg_slice a, rg_slice b);
/* As many of its bytes as a message shows, for "%.*s". */
#define RG_SHOWN(slice) (slice).n < 40 ? (int)(slice).n : 40, (slice).s

#endif
