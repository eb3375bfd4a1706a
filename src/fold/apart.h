/* apart.h -- independent components of a sheet, each a fold of its own: a system, steps and an end of its own.
 * Paper    eq. (11): the blocks that the constraint falls into
 * Uses  system.h components.h        Used by  chart, fold
 *
 * Each component goes evenly from 0 to 100 % of its own way, frame by frame with the others. One that is done, or was
 * never asked to move, is not solved any more; one that is held stays where it is, and the others go on. */
#ifndef RG_APART_H
#define RG_APART_H

#include "fold/system.h"

/* What a component is made, stepped, read off and destroyed by: those who know how have components themselves. */
typedef struct rg_apart_of {
    /* takes *m over, also on failure */
    rg_status (*make)(rg_mesh *m, const rg_settings *s, rg_straight **part, rg_diag *why);
    rg_status (*step)(rg_straight *part, rg_step_info *info);
    /* [part N] at a progress that it has passed; NULL: not known */
    const double *(*between)(rg_straight *part, double s);
    void (*destroy)(rg_straight *part);
} rg_apart_of;

/* `of` is borrowed. RG_ENOMEM, RG_EABSENT. Owner: the caller, rg_apart_free, also after a failure. */
rg_status rg_apart_init(rg_apart *a, const rg_apart_of *of, const rg_memory *mem, const rg_mesh *m,
                        const rg_settings *s, rg_diag *why);
void rg_apart_free(rg_apart *a);

/* Each part that has not reached that frame yet makes a step. *reached: whether all that can have. *outcome: RG_RUNNING
 * as long as a part is. */
void rg_apart_step(rg_apart *a, int32_t frame, int *reached, rg_outcome *outcome);
/* rho[N]: out. closure: out, the largest. Returns the progress of the whole. */
double rg_apart_gather(const rg_apart *a, double *rho, double *closure);
/* rho[N]: out, all at progress s, a little before the last frame; what is held stays. Zero: not known. */
int rg_apart_between(const rg_apart *a, double s, double *rho);
/* How it ended, in words. */
void rg_apart_tell(const rg_apart *a, char *text, size_t room);

#endif
