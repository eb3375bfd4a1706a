#include "layers/flat.h"
#include "base/classes.h"

#include <string.h>

/* A fold angle that is meant to be 0 or half a turn: files give degrees with a few digits. */
static const double MEANT = 0.01 * RG_DEG;
/* How far apart facets may put a vertex, in parts of the sheet's size: what is deeper counts as paper in paper
 * (docs/corpus.md). Drawings that are meant to fold flat come to 1e-5, one drawn by eye to 3e-4. */
static const double CLOSED = 1e-4;

/* Sector angles of a vertex that fail to cancel by less, radians, are rounding. */
static const double BLAME = 1e-6;

void rg_flat_free(rg_flat *f)
{
    if (!f->mem.resize) return;
    const rg_memory mem = f->mem;
    RG_MEM_FREE(&mem, f->facet_of, f->part_start, f->part, f->start, f->edge, f->beside, f->up, f->turn, f->place, f->x,
                f->middle);
    memset(f, 0, sizeof *f);
}

/* An added crease is one if it is folded; else it parts nothing. */
static int parts(const rg_mesh *m, const double *angle, int32_t i)
{
    return i < m->N - m->added || fabs(fabs(angle[i]) - RG_PI) <= MEANT;
}

/* Facets of the mesh on both sides of an added crease that is not folded are one. */
static void number_facets(rg_flat *f, const rg_mesh *m, const double *angle)
{
    for (int32_t i = 0; i < m->nf; i++) f->facet_of[i] = i;
    for (int32_t i = m->N - m->added; i < m->N; i++) {
        const int32_t *side = m->edge_facet[m->crease_edge[i]];
        if (!parts(m, angle, i)) rg_class_join(f->facet_of, side[0], side[1]);
    }
    for (int32_t i = 0; i < m->nf; i++) f->facet_of[i] = rg_class_of(f->facet_of, i);
    for (int32_t i = 0; i < m->nf; i++) f->facet_of[i] = f->facet_of[i] == i ? f->nf++ : f->facet_of[f->facet_of[i]];
    for (int32_t i = 0; i < m->nf; i++) f->part_start[f->facet_of[i] + 2]++; /* as in list_edges */
    for (int32_t g = 2; g <= f->nf; g++) f->part_start[g] += f->part_start[g - 1];
    for (int32_t i = 0; i < m->nf; i++) f->part[f->part_start[f->facet_of[i] + 1]++] = i;
}

static void list_edges(rg_flat *f, const rg_mesh *m)
{
    for (int32_t e = 0; e < m->ne; e++)
        for (int side = 0; side < 2; side++)
            f->beside[e][side] = m->edge_facet[e][side] < 0 ? -1 : f->facet_of[m->edge_facet[e][side]];
    for (int pass = 0; pass < 2; pass++) { /* counted one to the right; then each start moves to its end, again so */
        for (int32_t e = 0; e < m->ne; e++) {
            if (f->beside[e][0] == f->beside[e][1]) continue;
            for (int side = 0; side < 2; side++) {
                const int32_t g = f->beside[e][side];
                if (g < 0) continue;
                if (pass == 0) f->start[g + 2]++;
                else f->edge[f->start[g + 1]++] = e;
            }
        }
        for (int32_t g = 2; pass == 0 && g <= f->nf; g++) f->start[g] += f->start[g - 1];
    }
}

/* Centroids, from the mesh's facets; and the facet nearest the middle of the sheet, from which paths are short. */
static rg_status find_middles(rg_flat *f, const rg_mesh *m)
{
    double *area = rg_mem_array(&f->mem, (size_t)f->nf, sizeof *area);
    if (!area) return RG_ENOMEM;
    rg_vec2 all = {0, 0};
    double whole = 0, best = INFINITY;
    for (int32_t i = 0; i < m->nf; i++) {
        const int32_t *v = m->facet_vertex + m->facet_start[i], n = m->facet_start[i + 1] - m->facet_start[i];
        const int32_t g = f->facet_of[i];
        for (int32_t j = 2; j < n; j++) {
            const rg_vec2 a = m->X[v[0]], b = m->X[v[j - 1]], c = m->X[v[j]];
            const double w = rg_vec2_turn(a, b, c) / 2;
            area[g] += w;
            f->middle[g].x += w * (a.x + b.x + c.x) / 3;
            f->middle[g].y += w * (a.y + b.y + c.y) / 3;
        }
    }
    for (int32_t g = 0; g < f->nf; g++) {
        all.x += f->middle[g].x, all.y += f->middle[g].y, whole += area[g];
        f->middle[g] = (rg_vec2){f->middle[g].x / area[g], f->middle[g].y / area[g]};
    }
    all = (rg_vec2){all.x / whole, all.y / whole};
    for (int32_t g = 0; g < f->nf; g++) {
        const double d = rg_vec2_length(rg_vec2_sub(f->middle[g], all));
        if (!(d < best)) continue;
        best = d;
        f->root = g;
    }
    rg_mem_free(&f->mem, area);
    return RG_OK;
}

/* Which creases fold, as far as they are driven; returns how many are not. */
static int32_t find_turns(rg_flat *f, const rg_mesh *m, const double *angle)
{
    int32_t untold = 0;
    f->state = RG_FLAT_END;
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t i = m->edge_crease[e];
        f->turn[e] = 0;
        if (i < 0 || !parts(m, angle, i)) continue;
        if (isnan(angle[i])) f->turn[e] = RG_TURN_UNTOLD, untold++;
        else if (fabs(fabs(angle[i]) - RG_PI) <= MEANT) f->turn[e] = angle[i] > 0 ? 1 : -1;
        else if (!(fabs(angle[i]) <= MEANT) && f->state == RG_FLAT_END) {
            f->state = RG_FLAT_ANGLE;
            f->at_edge = e;
        }
    }
    return untold;
}

/* After q, reflected at the crease from a to b of the pattern. */
static rg_isometry reflected(const rg_isometry *q, rg_vec2 a, rg_vec2 b)
{
    const rg_vec2 d = rg_vec2_sub(b, a);
    const double n = rg_vec2_dot(d, d), cos2 = (d.x * d.x - d.y * d.y) / n, sin2 = 2 * d.x * d.y / n;
    const rg_vec2 t = {a.x - cos2 * a.x - sin2 * a.y, a.y - sin2 * a.x + cos2 * a.y};
    const rg_isometry mirror = {{{cos2, sin2}, {sin2, -cos2}}, t};
    rg_isometry r;
    r.t = rg_isometry_apply(q, mirror.t);
    for (int k = 0; k < 2; k++) /* without q->t, which may be so long that it leaves nothing of a unit vector */
        r.c[k] = rg_isometry_apply(&(rg_isometry){{q->c[0], q->c[1]}, {0, 0}}, mirror.c[k]);
    return r;
}

/* Breadth first from the root, so that paths are short and errors of the drawing add up least. */
static void place_facets(rg_flat *f, const rg_mesh *m, int32_t *queue)
{
    int32_t n = 0;
    memset(f->up, 0, (size_t)f->nf);
    f->place[f->root] = (rg_isometry){{{1, 0}, {0, 1}}, {0, 0}};
    f->up[f->root] = 1;
    queue[n++] = f->root;
    for (int32_t i = 0; i < n; i++) {
        const int32_t g = queue[i];
        for (int32_t j = f->start[g]; j < f->start[g + 1]; j++) {
            const int32_t e = f->edge[j], h = f->beside[e][f->beside[e][0] == g];
            if (h < 0 || f->up[h]) continue;
            const int folds = f->turn[e] != 0;
            f->place[h] = folds ? reflected(&f->place[g], m->X[m->edge[e][0]], m->X[m->edge[e][1]]) : f->place[g];
            f->up[h] = (signed char)(folds ? -f->up[g] : f->up[g]);
            queue[n++] = h;
        }
    }
}

/* Vertices where their facets put them, and how far these are apart. count: scratch. A crease whose facets have the
 * same side up although it folds, or not although it does not, does not close either. */
static void place_vertices(rg_flat *f, const rg_mesh *m, int32_t *count)
{
    memset(count, 0, (size_t)m->nv * sizeof *count);
    memset(f->x, 0, (size_t)m->nv * sizeof *f->x);
    f->gap = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int32_t i = 0; i < m->nf; i++)
            for (int32_t j = m->facet_start[i]; j < m->facet_start[i + 1]; j++) {
                const int32_t v = m->facet_vertex[j];
                const rg_vec2 x = rg_isometry_apply(&f->place[f->facet_of[i]], m->X[v]);
                if (pass == 0) {
                    count[v]++;
                    f->x[v].x += (x.x - f->x[v].x) / count[v];
                    f->x[v].y += (x.y - f->x[v].y) / count[v];
                    continue;
                }
                const double d = rg_vec2_length(rg_vec2_sub(x, f->x[v]));
                if (d <= f->gap) continue;
                f->gap = d;
                f->at_vertex = v;
            }
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t g = f->beside[e][0], h = f->beside[e][1];
        if (g < 0 || h < 0 || (f->up[g] == f->up[h]) == (f->turn[e] == 0)) continue;
        f->gap = INFINITY;
        f->at_vertex = m->edge[e][0];
    }
    if (f->gap <= CLOSED * m->size) return;
    f->state = RG_FLAT_OPEN;
    /* The vertex that is to blame most, if one is: errors add up far from where they are made. */
    double worst = BLAME;
    for (int32_t k = 0; k < m->M; k++) {
        const double off = rg_undriven_off(m, k, f->turn);
        if (!(off > worst)) continue;
        worst = off;
        f->at_vertex = m->inner_vertex[k];
    }
}

rg_status rg_flat_init(rg_flat *f, const rg_memory *mem, const rg_mesh *m, const double *angle)
{
    memset(f, 0, sizeof *f);
    f->mem = *mem;
    const size_t nf = (size_t)m->nf, ne = (size_t)m->ne, nv = (size_t)m->nv;
    int32_t *scratch;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(scratch, nf + nv), RG_ARRAY(f->facet_of, nf),
                                RG_ARRAY(f->part_start, nf + 2), RG_ARRAY(f->part, nf), RG_ARRAY(f->start, nf + 2),
                                RG_ARRAY(f->edge, 2 * ne), RG_ARRAY(f->beside, ne), RG_ARRAY(f->up, nf),
                                RG_ARRAY(f->turn, ne), RG_ARRAY(f->place, nf), RG_ARRAY(f->x, nv),
                                RG_ARRAY(f->middle, nf));
    if (s == RG_OK) {
        number_facets(f, m, angle);
        list_edges(f, m);
        s = find_middles(f, m);
    }
    if (s == RG_OK && find_turns(f, m, angle) && f->state == RG_FLAT_END) {
        int guessed;
        s = rg_undriven_decide(m, f->turn, &f->at_vertex, &guessed);
        if (s == RG_OK && f->at_vertex >= 0) f->state = guessed ? RG_FLAT_UNTOLD : RG_FLAT_OPEN;
    }
    if (s == RG_OK && f->state == RG_FLAT_END) {
        place_facets(f, m, scratch);
        place_vertices(f, m, scratch);
    }
    rg_mem_free(mem, scratch);
    return s;
}
