#include "write/paced.h"
#include "motion/between.h"
#include "motion/measure.h"

#include <string.h>

typedef struct pacer {
    const rg_motion *m;
    rg_between *way[2]; /* where the pattern stays, where it moves; NULL: not needed yet */
} pacer;

/* How far the crease goes that turns most from frame k to the next. */
static double turn(const rg_motion *m, int32_t k)
{
    return rg_gaps_turn(m->mesh.N, rg_motion_angles(m, k), rg_motion_angles(m, k + 1));
}

static rg_status way_of(pacer *p, int moves, rg_between **way)
{
    const rg_memory *mem = &p->m->mem;
    if (!p->way[moves]) {
        if (!(p->way[moves] = rg_mem_array(mem, 1, sizeof **way))) return RG_ENOMEM;
        const rg_status s = rg_between_init(p->way[moves], mem, &p->m->mesh, moves, &p->m->settings);
        if (s != RG_OK) return s;
    }
    *way = p->way[moves];
    return RG_OK;
}

static void copy(const rg_motion *from, int32_t k, rg_motion *to, int32_t f)
{
    const size_t N = (size_t)from->mesh.N, nv = (size_t)from->mesh.nv;
    memcpy(to->rho + (size_t)f * N, rg_motion_angles(from, k), N * sizeof *to->rho);
    if (to->flat) memcpy(to->flat + (size_t)f * nv, rg_motion_pattern(from, k), nv * sizeof *to->flat);
    to->frame[f] = from->frame[k];
}

/* Frame f, a part of the way from frame k to the next; where nothing closes there, the nearer of the two. */
static rg_status put(pacer *p, int32_t k, double part, rg_motion *to, int32_t f)
{
    const rg_motion *m = p->m;
    const size_t N = (size_t)m->mesh.N, nv = (size_t)m->mesh.nv;
    const rg_motion_state a = {rg_motion_angles(m, k), rg_motion_pattern(m, k), k, 0};
    const rg_motion_state b = {rg_motion_angles(m, k + 1), rg_motion_pattern(m, k + 1), k + 1, 0};
    const int32_t c = rg_gaps_leader(m->mesh.N, a.rho, b.rho);
    rg_between *way;
    const rg_status s = way_of(p, memcmp(a.X, b.X, nv * sizeof *a.X) != 0, &way);
    if (s != RG_OK) return s;
    const double closure = rg_between_at(way, &a, &b, part, c, a.rho[c] + part * (b.rho[c] - a.rho[c]));
    if (isnan(closure)) {
        copy(m, part < 0.5 ? k : k + 1, to, f);
        return RG_OK;
    }
    memcpy(to->rho + (size_t)f * N, way->z, N * sizeof *to->rho);
    if (to->flat) memcpy(to->flat + (size_t)f * nv, way->flat, nv * sizeof *to->flat);
    to->frame[f] = (rg_frame){.percent = rg_measure_percent(m, way->z, 100), .closure_residual = closure};
    return RG_OK;
}

static rg_status pace(pacer *p, rg_motion *to)
{
    const rg_motion *m = p->m;
    const int32_t last = m->report.frame_count - 1;
    double whole = 0, before = 0;
    rg_status s = RG_OK;
    for (int32_t k = 0; k < last; k++) whole += turn(m, k);
    copy(m, 0, to, 0);
    copy(m, last, to, last);
    for (int32_t f = 1, k = 0; s == RG_OK && f < last; f++) {
        const double due = whole * f / last;
        while (k < last - 1 && before + turn(m, k) < due) before += turn(m, k++);
        const double way = turn(m, k);
        s = put(p, k, way > 0 ? fmin(1, (due - before) / way) : 0, to, f);
    }
    return s;
}

rg_status rg_paced_init(rg_motion *paced, const rg_motion *m)
{
    const size_t frames = (size_t)m->report.frame_count, N = (size_t)m->mesh.N;
    *paced = *m;
    if (m->space || frames < 3 || N == 0) return RG_OK;
    pacer p = {.m = m};
    paced->rho = rg_mem_array(&m->mem, frames * N, sizeof *paced->rho);
    paced->flat = m->flat ? rg_mem_array(&m->mem, frames * (size_t)m->mesh.nv, sizeof *paced->flat) : NULL;
    paced->frame = rg_mem_array(&m->mem, frames, sizeof *paced->frame);
    rg_status s = paced->rho && paced->frame && (paced->flat || !m->flat) ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) s = pace(&p, paced);
    paced->report.frames = paced->frame;
    for (int i = 0; i < 2; i++) {
        if (p.way[i]) rg_between_free(p.way[i]);
        rg_mem_free(&m->mem, p.way[i]);
    }
    return s;
}

void rg_paced_free(rg_motion *paced, const rg_motion *m)
{
    if (paced->rho != m->rho) rg_mem_free(&m->mem, paced->rho);
    if (paced->flat != m->flat) rg_mem_free(&m->mem, paced->flat);
    if (paced->frame != m->frame) rg_mem_free(&m->mem, paced->frame);
}
