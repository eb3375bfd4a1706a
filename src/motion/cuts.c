#include "motion/cuts.h"

#include <string.h>

rg_status rg_cuts_init(rg_cuts *c, const rg_memory *mem, const rg_mesh *none, const rg_take *all)
{
    memset(c, 0, sizeof *c);
    c->mem = *mem;
    c->none = none;
    c->which = rg_mem_array(mem, (size_t)none->nf, sizeof *c->which);
    c->bend = rg_mem_array(mem, (size_t)none->nf, sizeof *c->bend);
    if (!c->which || !c->bend) {
        rg_cuts_free(c);
        return RG_ENOMEM;
    }
    memset(c->which, 1, (size_t)none->nf);
    rg_cuts_measure(c, all);
    return RG_OK;
}

void rg_cuts_free(rg_cuts *c)
{
    if (!c->mem.resize) return;
    rg_mem_free(&c->mem, c->which);
    rg_mem_free(&c->mem, c->bend);
    memset(c, 0, sizeof *c);
}

void rg_cuts_measure(rg_cuts *c, const rg_take *t)
{
    const rg_mesh *none = c->none;
    const size_t N = (size_t)t->mesh.N;
    int32_t i = t->mesh.N - t->mesh.added; /* added creases come facet by facet */
    c->bends = 0;
    for (int32_t f = 0; f < none->nf; f++) {
        const int32_t corners = none->facet_start[f + 1] - none->facet_start[f];
        c->bend[f] = c->which[f] && corners > 3 ? 0 : -1;
        c->bends += c->bend[f] >= 0;
        for (int32_t k = 3; c->bend[f] >= 0 && k < corners && i < t->mesh.N; k++, i++)
            for (int32_t frame = 0; frame < t->count; frame++)
                c->bend[f] = fmax(c->bend[f], fabs(t->rho[(size_t)frame * N + (size_t)i]));
    }
}

void rg_cuts_bending(rg_cuts *c, double least)
{
    c->cut = 0;
    for (int32_t f = 0; f < c->none->nf; f++) c->cut += c->which[f] = c->bend[f] >= least;
}

void rg_cuts_all_but(rg_cuts *c, int32_t n)
{
    rg_cuts_bending(c, 0);
    for (; n > 0 && c->cut > 0; n--, c->cut--) {
        int32_t least = -1;
        for (int32_t f = 0; f < c->none->nf; f++)
            if (c->which[f] && (least < 0 || c->bend[f] < c->bend[least])) least = f;
        c->which[least] = 0;
    }
}

void rg_cuts_around(rg_cuts *c, const int32_t *vertex, int32_t vertices)
{
    const rg_mesh *none = c->none;
    c->cut = 0;
    for (int32_t f = 0; f < none->nf; f++) {
        int is_at = 0;
        for (int32_t k = none->facet_start[f]; k < none->facet_start[f + 1]; k++)
            for (int32_t i = 0; i < vertices; i++) is_at |= none->facet_vertex[k] == vertex[i];
        c->cut += c->which[f] = is_at && c->bend[f] >= 0;
    }
}
