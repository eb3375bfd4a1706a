#include "motion/diagnose.h"
#include "fold/blame.h"
#include "fold/tuning.h"

#include <string.h>

/* A crease that is let this much of its wish or less, and is short of its target by more than 1 %, is blocked. */
static const double HELD = 0.01;

/* Is crease i short of its target and not let any nearer? */
static int is_blocked(double rho, double from, double target, double wish, double step)
{
    const double way = target - from;
    if (isnan(way) || way == 0) return 0;
    return 1 - (rho - from) / way > ARRIVED && step / wish <= HELD;
}

/* Of one system. */
static rg_status diagnose(rg_straight *f, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases)
{
    const rg_sparse *C = &f->K.C;
    rg_cg_report rep;
    *vertices = *creases = 0;
    rg_force *by = rg_mem_array(&f->mem, (size_t)C->M, sizeof *by);
    if (!by) return RG_ENOMEM;

    rg_constraint_assemble(&f->K, f->rho);
    rg_project_renew(&f->P);
    rg_drive_wish(&f->drive, f->rho, fmin(f->s, 0.999), f->wish);
    memset(f->P.y, 0, 3 * (size_t)C->M * sizeof *f->P.y);
    rg_status s = rg_project_step(&f->P, &f->K, f->wish, 0, NULL, f->t, DIRECTION_SOLVED, &rep); /* eq. (9) */
    if (s == RG_OK) {
        *vertices = rg_blame_vertices(&f->mesh, C->x, f->P.y, by, vertex);
        for (int32_t i = 0; i < f->mesh.N; i++)
            if (rg_drive_is_driven(&f->drive, i) && is_blocked(f->rho[i], 0, f->drive.target[i], f->wish[i], f->t[i]))
                crease[(*creases)++] = i;
    }
    rg_mem_free(&f->mem, by);
    return s;
}

rg_status rg_diagnose_blocking(rg_straight *f, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases)
{
    rg_straight *const *system;
    rg_status s = RG_OK;
    *vertices = *creases = 0;
    for (int32_t p = 0, n = rg_straight_systems(f, &system), v, c; p < n && s == RG_OK; p++) {
        if (n > 1 && system[p]->outcome == RG_FOLDED) continue;
        int32_t *mine = crease + *creases;
        s = diagnose(system[p], vertex + *vertices, &v, mine, &c);
        for (int32_t i = 0; s == RG_OK && n > 1 && i < c; i++) mine[i] = f->apart.crease[f->apart.start[p] + mine[i]];
        if (s == RG_OK) *vertices += v, *creases += c;
    }
    return s;
}

rg_status rg_diagnose_relaxed(rg_relax *F, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases)
{
    const rg_mesh *m = &F->mesh;
    *vertices = *creases = 0;
    rg_force *by = rg_mem_array(&F->mem, (size_t)m->M, sizeof *by);
    if (!by) return RG_ENOMEM;
    rg_relax_wish_and_step(F);
    *vertices = rg_blame_vertices(m, F->K.C.x, F->J.A.y, by, vertex);
    for (int32_t i = 0; i < F->limit.first_added; i++)
        if (is_blocked(F->z[i], F->from[i], F->target[i], F->wish[i], F->dz[i])) crease[(*creases)++] = i;
    rg_mem_free(&F->mem, by);
    return RG_OK;
}
