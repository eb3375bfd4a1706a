/* steer.h -- from any state on: some creases are driven, some stay, some have a wish, and the others follow.
 * Paper    eqs. (9), (10), (14)        Uses  straight.h        Used by  motion
 *
 * Driven creases D turn evenly from where they are to where they shall be; the columns of C of D and of those that stay
 * are not asked:
 *
 *     drho_F = drho0_F - C_F^+ (r + C_D drho_D + C_F drho0_F)        F: all others;  drho0: 0, or what they wish
 *
 * the least motion that the facets allow. Progress s is the part of the driven creases' way; where none is driven it is
 * the mean part of the ways of those that have targets, and steps hold it as straight.h does. Steps are of order four,
 * each closed. */
#ifndef RG_STEER_H
#define RG_STEER_H

#include "fold/blame.h"
#include "fold/straight.h"

typedef enum rg_role { RG_ROLE_FREE, RG_ROLE_WISHES, RG_ROLE_DRIVEN, RG_ROLE_STILL } rg_role;

typedef struct rg_steer {
    rg_memory mem;
    rg_mesh mesh;          /* its arrays are borrowed */
    double step, tol;      /* radians */
    rg_constraint K;
    rg_project P;
    rg_limit limit;
    rg_straight *start;    /* to leave flat paper by; owned */
    unsigned char *role;   /* [N] rg_role, set by the owner */
    double *target;        /* [N] of those that are driven or wish, radians, set by the owner */
    double *from;          /* [N] where the leg begins */
    double *gradient, *along; /* [N] of progress where none is driven; the same over its length */
    double steepness;
    int32_t driven, wishing;
    double *ray, ray_s;    /* [N] the state at which flat paper was left, and its progress; 0: it does not begin flat */
    double *rho, s;        /* [N] the state that steps go on from, closed */
    double *out;           /* [N] the state that was asked for, closed */
    double h;              /* of the next step, in s */
    double *trial, *wish, *t, *pull, *k[3]; /* [N] */
    unsigned char *held;   /* [N] at its limit in this step */
    rg_force *force; /* [M] scratch */
    double closure;
    int64_t steps;
    rg_outcome outcome;
    const char *reason;
} rg_steer;

/* What a leg is at, to come back to. */
typedef struct rg_steer_kept {
    double *number;        /* [5 N] target, from, ray, rho, out */
    unsigned char *role;   /* [N] */
    double ray_s, s, h, closure;
    rg_outcome outcome;
    const char *reason;
} rg_steer_kept;

/* m's arrays are borrowed. RG_ENOMEM, RG_EABSENT. Owner: the caller, rg_steer_free, also after a failure. */
rg_status rg_steer_init(rg_steer *F, const rg_memory *mem, const rg_mesh *m, const rg_settings *s);
void rg_steer_free(rg_steer *F);

/* Stands at rho[N], closed on a pattern with sector angles theta (in the order of loop_theta; NULL: those of the mesh),
 * at the beginning of a leg with the roles and targets that are set now. Allocates nothing. */
void rg_steer_begin(rg_steer *F, const double *theta, const double *rho);
/* On to progress s, at most 1 and never less than before: F->out is the state there, or F->outcome says that it
 * stopped, and F->out is as far as it came. Allocates nothing. */
void rg_steer_to(rg_steer *F, double s);
/* rho[N]: closed with crease c as it is. Returns the closure; NAN: it does not close. Allocates nothing. */
double rg_steer_close(rg_steer *F, const double *theta, int32_t c, double *rho);
/* What holds it at F->rho: vertex[M], vertex numbers that resist most, the strongest first; crease[N], those short of
 * their targets. Allocates nothing. */
void rg_steer_blame(rg_steer *F, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases);

/* RG_ENOMEM. Owner: the caller, rg_steer_kept_free. */
rg_status rg_steer_kept_init(rg_steer_kept *k, const rg_memory *mem, int32_t N);
void rg_steer_kept_free(rg_steer_kept *k, const rg_memory *mem);
/* Out of the leg, and back into one on the same mesh; theta as in rg_steer_begin. Allocate nothing. */
void rg_steer_keep(const rg_steer *F, rg_steer_kept *k);
void rg_steer_return(rg_steer *F, const double *theta, const rg_steer_kept *k);

#endif
