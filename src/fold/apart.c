#include "fold/apart.h"
#include "mesh/components.h"

#include <stdio.h>
#include <string.h>

/* Parts of one sheet, counted out: the part of each crease and its number there, how many vertices and corners there
 * are before each part. */
typedef struct deal {
    int32_t *part, *local;                       /* [N] */
    int32_t *count, *vertex_start, *corner_start; /* [parts + 1] */
} deal;

static int32_t part_of_vertex(const rg_mesh *m, const deal *d, int32_t k)
{
    return d->part[m->loop_crease[m->loop_start[k]]];
}

static void deal_out(const rg_mesh *m, rg_apart *a, deal *d)
{
    for (int32_t i = 0; i < m->N; i++) a->start[d->part[i] + 1]++;
    for (int32_t k = 0; k < m->M; k++) {
        const int32_t p = part_of_vertex(m, d, k);
        d->vertex_start[p + 1]++;
        d->corner_start[p + 1] += m->loop_start[k + 1] - m->loop_start[k];
    }
    for (int32_t p = 0; p < a->parts; p++) {
        a->start[p + 1] += a->start[p];
        d->vertex_start[p + 1] += d->vertex_start[p];
        d->corner_start[p + 1] += d->corner_start[p];
    }
    for (int32_t i = 0; i < m->N; i++) d->local[i] = d->count[d->part[i]]++;
    for (int32_t i = 0; i < m->N; i++) a->crease[a->start[d->part[i]] + d->local[i]] = i;
}

/* What the time loop takes of a mesh, for one part: creases' assignments and targets, the loops round their vertices,
 * and the two triangles at each added crease. Edge i is crease i, edge N stands for all of the perimeter. Vertices keep
 * their numbers. */
static rg_status make_room(rg_mesh *out, const rg_memory *mem, int32_t N, int32_t M, int32_t added, int32_t corners)
{
    memset(out, 0, sizeof *out);
    out->mem = *mem;
    out->N = N, out->M = M, out->added = added, out->ne = N + 1, out->nf = 2 * added;
    out->target = rg_mem_array(mem, (size_t)out->ne, sizeof *out->target);
    out->assignment = rg_mem_array(mem, (size_t)out->ne, 1);
    out->still = rg_mem_array(mem, (size_t)out->ne, 1);
    out->edge_facet = rg_mem_array(mem, (size_t)out->ne, sizeof *out->edge_facet);
    out->edge_crease = rg_mem_array(mem, (size_t)out->ne, sizeof *out->edge_crease);
    out->crease_edge = rg_mem_array(mem, (size_t)N, sizeof *out->crease_edge);
    out->facet_start = rg_mem_array(mem, (size_t)out->nf + 1, sizeof *out->facet_start);
    out->facet_edge = rg_mem_array(mem, 3 * (size_t)out->nf, sizeof *out->facet_edge);
    out->inner_vertex = rg_mem_array(mem, (size_t)M, sizeof *out->inner_vertex);
    out->loop_start = rg_mem_array(mem, (size_t)M + 1, sizeof *out->loop_start);
    out->loop_crease = rg_mem_array(mem, (size_t)corners, sizeof *out->loop_crease);
    out->loop_theta = rg_mem_array(mem, (size_t)corners, sizeof *out->loop_theta);
    return out->target && out->assignment && out->still && out->edge_facet && out->edge_crease && out->crease_edge &&
        out->facet_start &&
                   out->facet_edge && out->inner_vertex && out->loop_start && out->loop_crease && out->loop_theta
               ? RG_OK
               : RG_ENOMEM;
}

static void take_crease(const rg_mesh *m, const deal *d, int32_t whole, int32_t i, rg_mesh *out)
{
    const int32_t e = m->crease_edge[whole], facet = 2 * (i - (out->N - out->added));
    out->target[i] = m->target[e];
    out->assignment[i] = m->assignment[e];
    out->still[i] = m->still && m->still[e];
    out->edge_crease[i] = out->crease_edge[i] = i;
    for (int side = 0; side < 2; side++) {
        out->edge_facet[i][side] = facet >= 0 ? facet + side : -1;
        for (int j = 0; facet >= 0 && j < 3; j++) {
            const int32_t crease = m->edge_crease[m->facet_edge[m->facet_start[m->edge_facet[e][side]] + j]];
            out->facet_edge[3 * (facet + side) + j] = crease >= 0 ? d->local[crease] : out->N;
        }
    }
}

static rg_status cut(const rg_mesh *m, const rg_apart *a, const deal *d, int32_t p, rg_mesh *out)
{
    const int32_t *crease = a->crease + a->start[p], N = a->start[p + 1] - a->start[p];
    int32_t added = 0;
    for (int32_t i = 0; i < N; i++) added += crease[i] >= m->N - m->added;
    const rg_status s = make_room(out, &m->mem, N, d->vertex_start[p + 1] - d->vertex_start[p], added,
                                  d->corner_start[p + 1] - d->corner_start[p]);
    if (s != RG_OK) return s;
    for (int32_t f = 0; f <= out->nf; f++) out->facet_start[f] = 3 * f;
    for (int32_t i = 0; i < N; i++) take_crease(m, d, crease[i], i, out);
    out->target[N] = NAN, out->edge_crease[N] = out->edge_facet[N][0] = out->edge_facet[N][1] = -1;
    return RG_OK;
}

/* The loops of all parts, in one walk over the sheet's vertices. */
static void deal_loops(const rg_mesh *m, const deal *d, int32_t parts, rg_mesh *piece)
{
    for (int32_t p = 0; p < parts; p++) piece[p].M = 0;
    for (int32_t k = 0; k < m->M; k++) {
        rg_mesh *out = &piece[part_of_vertex(m, d, k)];
        int32_t at = out->loop_start[out->M];
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++, at++) {
            out->loop_crease[at] = d->local[m->loop_crease[j]];
            out->loop_theta[at] = m->loop_theta[j];
        }
        out->inner_vertex[out->M++] = m->inner_vertex[k];
        out->loop_start[out->M] = at;
    }
}

static rg_status make_parts(rg_apart *a, const rg_mesh *m, deal *d, const rg_settings *settings, rg_diag *why)
{
    const size_t parts = (size_t)a->parts;
    rg_mesh *piece = rg_mem_array(&a->mem, parts, sizeof *piece);
    a->part = rg_mem_array(&a->mem, parts, sizeof *a->part);
    a->start = rg_mem_array(&a->mem, parts + 1, sizeof *a->start);
    a->crease = rg_mem_array(&a->mem, (size_t)m->N, sizeof *a->crease);
    d->count = rg_mem_array(&a->mem, parts + 1, sizeof *d->count);
    d->vertex_start = rg_mem_array(&a->mem, parts + 1, sizeof *d->vertex_start);
    d->corner_start = rg_mem_array(&a->mem, parts + 1, sizeof *d->corner_start);
    d->local = rg_mem_array(&a->mem, (size_t)m->N, sizeof *d->local);
    const int has_room = piece && a->part && a->start && a->crease && d->count && d->vertex_start && d->corner_start &&
                         d->local;
    rg_status s = has_room ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) deal_out(m, a, d);
    for (int32_t p = 0; p < a->parts && s == RG_OK; p++) s = cut(m, a, d, p, &piece[p]);
    if (s == RG_OK) deal_loops(m, d, a->parts, piece);
    for (int32_t p = 0; p < a->parts && s == RG_OK; p++) s = a->of->make(&piece[p], settings, &a->part[p], why);
    for (int32_t p = 0; piece && p < a->parts; p++) rg_mesh_free(&piece[p]);
    rg_mem_free(&a->mem, piece);
    return s;
}

rg_status rg_apart_init(rg_apart *a, const rg_apart_of *of, const rg_memory *mem, const rg_mesh *m,
                        const rg_settings *settings, rg_diag *why)
{
    deal d = {0};
    int32_t count = 0;
    memset(a, 0, sizeof *a);
    a->mem = *mem;
    a->of = of;
    d.part = rg_mem_array(mem, (size_t)m->N, sizeof *d.part);
    rg_status s = d.part ? rg_components_find_coarse(m, d.part, &count) : RG_ENOMEM;
    if (s == RG_OK && count > 1) {
        a->parts = count;
        s = make_parts(a, m, &d, settings, why);
    }
    int32_t *block[] = {d.part, d.local, d.count, d.vertex_start, d.corner_start};
    for (int i = 0; i < 5; i++) rg_mem_free(mem, block[i]);
    return s;
}

void rg_apart_free(rg_apart *a)
{
    if (!a->mem.resize) return;
    for (int32_t p = 0; a->part && p < a->parts; p++) a->of->destroy(a->part[p]);
    rg_mem_free(&a->mem, a->part);
    rg_mem_free(&a->mem, a->start);
    rg_mem_free(&a->mem, a->crease);
    memset(a, 0, sizeof *a);
}

void rg_apart_step(rg_apart *a, int32_t frame, int *reached, rg_outcome *outcome)
{
    rg_step_info info;
    int running = 0, stopped = 0, behind = 0, there = 0;
    for (int32_t p = 0; p < a->parts; p++) {
        rg_straight *f = a->part[p];
        if (f->outcome == RG_RUNNING && f->frame <= frame) a->of->step(f, &info);
        running |= f->outcome == RG_RUNNING;
        stopped |= f->outcome == RG_STOPPED;
        behind |= f->outcome == RG_RUNNING && f->frame <= frame;
        there |= f->frame > frame;
    }
    *reached = !behind && there;
    *outcome = running ? RG_RUNNING : stopped ? RG_STOPPED : RG_FOLDED;
}

double rg_apart_gather(const rg_apart *a, double *rho, double *closure)
{
    double sum = 0, driven = 0;
    *closure = 0;
    for (int32_t p = 0; p < a->parts; p++) {
        const rg_straight *f = a->part[p];
        for (int32_t i = 0; i < f->mesh.N; i++) rho[a->crease[a->start[p] + i]] = f->rho[i];
        sum += f->drive.count * f->s;
        driven += f->drive.count;
        if (!(f->closure <= *closure)) *closure = f->closure;
    }
    return driven > 0 ? sum / driven : 1;
}

int rg_apart_between(const rg_apart *a, double s, double *rho)
{
    for (int32_t p = 0; p < a->parts; p++) {
        rg_straight *f = a->part[p];
        const double *at = f->drive.count == 0 || s >= f->s ? f->rho : a->of->between(f, s);
        if (!at) return 0;
        for (int32_t i = 0; i < f->mesh.N; i++) rho[a->crease[a->start[p] + i]] = at[i];
    }
    return 1;
}

void rg_apart_tell(const rg_apart *a, char *text, size_t room)
{
    const rg_straight *first = NULL;
    int stopped = 0;
    for (int32_t p = a->parts; p-- > 0;) {
        if (a->part[p]->outcome != RG_STOPPED) continue;
        first = a->part[p];
        stopped++;
    }
    if (stopped)
        snprintf(text, room, "%d of %d independent parts stop short: %s", stopped, (int)a->parts, first->reason);
    else snprintf(text, room, "all parts are folded");
}
