#include "motion/diagnose.h"

#include <stdlib.h>
#include <string.h>

/* Vertices that resist at least half as hard as the hardest, and no list too long to read. */
static const double STRONG = 0.5;
static const int32_t MOST_VERTICES = 12;
/* A crease that is let this much of its wish or less, and is short of its target by more than 1 %, is blocked. */
static const double HELD = 0.01, ARRIVED = 0.01;
static const double SOLVE_TOLERANCE = 1e-8;

typedef struct force { double size; int32_t k; } force;

static int stronger(const void *a, const void *b)
{
    const force *p = a, *q = b;
    if (p->size != q->size) return p->size > q->size ? -1 : 1;
    return p->k < q->k ? -1 : p->k > q->k;
}

rg_status rg_diagnose_blocking(rg_fold *f, int32_t *vertex, int32_t *vertices, int32_t *crease, int32_t *creases)
{
    const rg_sparse *C = &f->K.C;
    rg_cg_report rep;
    *vertices = *creases = 0;
    force *by = rg_mem_array(&f->mem, (size_t)C->M, sizeof *by);
    if (!by) return RG_ENOMEM;

    rg_constraint_assemble(&f->K, f->rho);
    rg_project_renew(&f->P);
    rg_drive_wish(&f->drive, f->rho, fmin(f->s, 0.999), f->wish);
    memset(f->P.y, 0, 3 * (size_t)C->M * sizeof *f->P.y);
    rg_status s = rg_project_step(&f->P, &f->K, f->wish, 0, NULL, f->t, SOLVE_TOLERANCE, &rep); /* eq. (9) */
    if (s == RG_OK) {
        for (int32_t k = 0; k < C->M; k++) {
            double sum = 0;
            const double *y = f->P.y + 3 * k;
            for (int32_t j = C->start[k]; j < C->start[k + 1]; j++)
                sum += fabs(C->x[j].x * y[0] + C->x[j].y * y[1] + C->x[j].z * y[2]);
            by[k] = (force){sum, k};
        }
        qsort(by, (size_t)C->M, sizeof *by, stronger);
        for (int32_t k = 0; k < C->M && k < MOST_VERTICES; k++)
            if (by[k].size > 0 && by[k].size >= STRONG * by[0].size) vertex[(*vertices)++] = f->mesh.inner_vertex[by[k].k];
        for (int32_t i = 0; i < f->mesh.N; i++) {
            if (!rg_drive_is_driven(&f->drive, i)) continue;
            double target = f->drive.target[i], short_of = 1 - f->rho[i] / target;
            if (short_of > ARRIVED && f->t[i] / f->wish[i] <= HELD) crease[(*creases)++] = i;
        }
    }
    rg_mem_free(&f->mem, by);
    return s;
}

static int32_t root(int32_t *up, int32_t i)
{
    while (up[i] != i) i = up[i] = up[up[i]];
    return i;
}

rg_status rg_diagnose_components(const rg_mesh *m, const rg_memory *mem, int32_t *components)
{
    int32_t *up = rg_mem_array(mem, (size_t)m->N, sizeof *up);
    if (!up) return RG_ENOMEM;
    for (int32_t i = 0; i < m->N; i++) up[i] = i;
    *components = m->N;
    for (int32_t k = 0; k < m->M; k++)
        for (int32_t j = m->loop_start[k] + 1; j < m->loop_start[k + 1]; j++) {
            int32_t a = root(up, m->loop_crease[j - 1]), b = root(up, m->loop_crease[j]);
            if (a == b) continue;
            up[a] = b;
            --*components;
        }
    rg_mem_free(mem, up);
    return RG_OK;
}
