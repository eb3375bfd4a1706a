#include "motion/rest.h"

/* How much stiffer undriven creases are. With 2 pleated hypars rest as saddles, at 60 and 56 %. */
static const double UNDRIVEN = 2;
/* Halvings of the way between two nodes. */
static const int32_t HALVINGS = 40;

/* It is to follow the others, or is held: nothing pulls it to flat. */
static int is_free(const rg_mesh *m, int32_t i)
{
    const int32_t e = m->crease_edge[i];
    const char a = m->assignment[e];
    return isnan(m->target[e]) && (a == RG_MOUNTAIN || a == RG_VALLEY || (m->still && m->still[e]));
}

int rg_rest_is_open(const rg_mesh *m)
{
    for (int32_t i = 0; i < m->N - m->added; i++)
        if (isnan(m->target[m->crease_edge[i]]) && !is_free(m, i)) return 1;
    return 0;
}

/* dE/ds along t. */
static double slope(const rg_straight *f, const double *rho, const double *t)
{
    const rg_mesh *m = &f->mesh;
    double sum = 0;
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t *e = m->edge[m->crease_edge[i]];
        const double l = rg_vec2_length(rg_vec2_sub(m->X[e[1]], m->X[e[0]]));
        if (rg_drive_is_driven(&f->drive, i)) sum += l * (rho[i] - f->drive.target[i]) * t[i];
        else if (!is_free(m, i)) sum += UNDRIVEN * l * rho[i] * t[i];
    }
    return sum;
}

int rg_rest_find(const rg_straight *f, double *rho, double *t, double *s)
{
    const rg_path *p = &f->path;
    const rg_node *b = p->count > 1 ? &p->node[p->count - 1] : NULL, *a = b ? b - 1 : NULL;
    if (f->apart.parts || !f->smooth || !b || !a->has_t || !b->has_t) return 0;
    if (!(slope(f, a->rho, a->t) < 0 && slope(f, b->rho, b->t) >= 0)) return 0;
    double low = a->s, high = b->s;
    for (int32_t n = 0; n < HALVINGS; n++) {
        int32_t first, count;
        *s = (low + high) / 2;
        rg_path_window(p, *s, &first, &count);
        rg_path_evaluate(p, first, count, *s, rho, t);
        if (slope(f, rho, t) < 0) low = *s;
        else high = *s;
    }
    return 1;
}
