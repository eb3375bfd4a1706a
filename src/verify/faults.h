/* faults.h -- what is wrong with a motion, one plain sentence each.
 * Used by  every file of verify/ */
#ifndef RG_FAULTS_H
#define RG_FAULTS_H

#include "base/memory.h"

/* More are only counted. */
enum { RG_FAULTS_KEPT = 200 };

typedef struct rg_faults {
    int32_t count; /* found */
    rg_fault list[RG_FAULTS_KEPT];
} rg_faults;

/* frame -1: of the pattern; f, g -1: of no facet. `format` as printf's: what is wrong, without full stop. */
#if defined(__GNUC__)
__attribute__((format(printf, 5, 6)))
#endif
void rg_faults_add(rg_faults *all, int32_t frame, int32_t f, int32_t g, const char *format, ...);

#endif
