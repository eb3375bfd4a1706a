#include "motion/cuts.h"

#include <string.h>

rg_status rg_cuts_init(rg_cuts *c, const rg_memory *mem, const rg_mesh *none, const rg_symmetry *G,
                       const rg_attempt *all)
{
    *c = (rg_cuts){.mem = *mem, .none = none, .G = G};
    const rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(c->which, (size_t)none->nf), RG_ARRAY(c->bend, (size_t)none->nf),
                                      RG_ARRAY(c->piece_of, (size_t)none->facet_start[none->nf]));
    if (s != RG_OK) return s;
    memset(c->which, 1, (size_t)none->nf);
    rg_cuts_measure(c, all);
    return RG_OK;
}

void rg_cuts_free(rg_cuts *c)
{
    if (!c->mem.resize) return;
    RG_MEM_FREE(&c->mem, c->which, c->bend, c->piece_of);
    memset(c, 0, sizeof *c);
}

static int32_t orbit(const rg_cuts *c, int32_t f) { return c->G ? c->G->facet_orbit[f] : f; }

void rg_cuts_measure(rg_cuts *c, const rg_attempt *t)
{
    const rg_mesh *none = c->none, *m = &t->mesh;
    for (int32_t f = 0; f < none->nf; f++) c->bend[f] = -1;
    rg_triangulate_trace(none, m, c->piece_of);
    for (int32_t i = none->N; i < m->N; i++) {
        double *of = &c->bend[orbit(c, c->piece_of[m->edge_facet[m->crease_edge[i]][0]])];
        *of = fmax(*of, rg_attempt_largest_angle(t, i));
    }
    c->bends = 0;
    for (int32_t f = 0; f < none->nf; f++) c->bends += (c->bend[f] = c->bend[orbit(c, f)]) >= 0;
}

void rg_cuts_bending(rg_cuts *c, double least)
{
    c->cut = 0;
    for (int32_t f = 0; f < c->none->nf; f++) c->cut += c->which[f] = c->bend[f] >= least;
}

void rg_cuts_all_but(rg_cuts *c, int32_t n)
{
    rg_cuts_bending(c, 0);
    while (n > 0 && c->cut > 0) {
        int32_t least = -1;
        for (int32_t f = 0; f < c->none->nf; f++)
            if (c->which[f] && (least < 0 || c->bend[f] < c->bend[least])) least = f;
        for (int32_t f = 0, first = orbit(c, least); f < c->none->nf; f++) {
            if (!c->which[f] || orbit(c, f) != first) continue;
            c->which[f] = 0;
            c->cut--;
            n--;
        }
    }
}

void rg_cuts_around(rg_cuts *c, const int32_t *vertex, int32_t vertices)
{
    const rg_mesh *none = c->none;
    memset(c->which, 0, (size_t)none->nf);
    for (int32_t f = 0; f < none->nf; f++)
        for (int32_t k = none->facet_start[f]; k < none->facet_start[f + 1]; k++)
            for (int32_t i = 0; i < vertices; i++) c->which[orbit(c, f)] |= none->facet_vertex[k] == vertex[i];
    c->cut = 0;
    for (int32_t f = 0; f < none->nf; f++) c->cut += c->which[f] = c->which[orbit(c, f)] && c->bend[f] >= 0;
}
