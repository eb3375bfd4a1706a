#include "fold/trace.h"
#include "fold/apart.h"
#include "fold/integrate.h"

#include <string.h>

enum { HAS_T = 1, ONE_WAY = 2 };
/* So many nodes lie at or beyond the place where something is read off: half a window. */
enum { BEYOND = RG_PATH_WINDOW / 2 };

rg_status rg_trace_init(rg_trace *q, const rg_memory *mem, const rg_straight *f)
{
    rg_straight *const *system;
    *q = (rg_trace){.mem = *mem, .settings = f->settings, .parts = rg_straight_systems(f, &system)};
    q->part = rg_mem_array(mem, (size_t)q->parts, sizeof *q->part);
    if (!q->part) return RG_ENOMEM;
    for (int32_t p = 0; p < q->parts; p++) q->part[p] = (rg_trace_part){.N = system[p]->mesh.N};
    return RG_OK;
}

void rg_trace_free(rg_trace *q)
{
    if (!q->mem.resize) return;
    for (int32_t p = 0; q->part && p < q->parts; p++) {
        void *block[] = {q->part[p].s, q->part[p].rho, q->part[p].t, q->part[p].told};
        for (int i = 0; i < 4; i++) rg_mem_free(&q->mem, block[i]);
    }
    rg_mem_free(&q->mem, q->part);
    rg_straight_destroy(q->reader);
    memset(q, 0, sizeof *q);
}

static rg_status add(rg_trace_part *a, const rg_memory *mem, const rg_node *node, int one_way)
{
    const size_t k = (size_t)a->count, N = (size_t)a->N;
    rg_status s = rg_mem_grow(mem, (void **)&a->s, &a->room[0], k + 1, sizeof *a->s);
    if (s == RG_OK) s = rg_mem_grow(mem, (void **)&a->rho, &a->room[1], (k + 1) * N, sizeof *a->rho);
    if (s == RG_OK) s = rg_mem_grow(mem, (void **)&a->t, &a->room[2], (k + 1) * N, sizeof *a->t);
    if (s == RG_OK) s = rg_mem_grow(mem, (void **)&a->told, &a->room[3], k + 1, sizeof *a->told);
    if (s != RG_OK) return s;
    a->s[k] = node->s;
    memcpy(a->rho + k * N, node->rho, N * sizeof *a->rho);
    if (node->has_t) memcpy(a->t + k * N, node->t, N * sizeof *a->t);
    a->told[k] = (unsigned char)((node->has_t ? HAS_T : 0) | (one_way ? ONE_WAY : 0));
    a->count++;
    return RG_OK;
}

rg_status rg_trace_follow(rg_trace *q, const rg_straight *f)
{
    rg_straight *const *system;
    rg_status s = RG_OK;
    rg_straight_systems(f, &system);
    for (int32_t p = 0; s == RG_OK && p < q->parts; p++) {
        const rg_straight *g = system[p];
        rg_trace_part *a = &q->part[p];
        if (!g->smooth) continue;
        for (int32_t k = 0; s == RG_OK && k < g->path.count; k++)
            if (a->count == 0 || g->path.node[k].s > a->s[a->count - 1])
                s = add(a, &q->mem, &g->path.node[k], g->one_way);
        a->until = g->s;
        if (g->path_ended && !a->ended) a->ended = 1, a->ended_one_way = g->one_way;
    }
    return s;
}

/* ------------------------------------------------------------------------------------------------ reading ---- */

rg_status rg_trace_open(rg_trace *q, const rg_mesh *m)
{
    rg_mesh copy = {0};
    if (q->reader) return RG_OK;
    const rg_status s = rg_mesh_copy(m, &copy);
    return s == RG_OK ? rg_straight_from_mesh(&copy, &q->settings, &q->reader, NULL) : s;
}

/* How many nodes there were when s could first be read off; 0: it never could. */
static int32_t nodes_then(const rg_trace_part *a, double s, double s_end)
{
    for (int32_t n = BEYOND + 1; n <= a->count; n++)
        if (s <= a->s[n - BEYOND]) return n;
    const int ended = a->ended || (a->count > 0 && a->s[a->count - 1] >= s_end);
    return ended && a->count > 1 && s <= a->s[a->count - 1] ? a->count : 0;
}

/* The state of one system, its own scratch; NULL: it is not kept. */
static const double *read(const rg_trace_part *a, rg_straight *g, double s, double *closure)
{
    const int32_t n = nodes_then(a, s, g->s_end), first = n > RG_PATH_WINDOW ? n - RG_PATH_WINDOW : 0;
    if (n == 0 || !(s <= a->until)) return NULL;
    const int is_ended = n == a->count && a->ended && !(n > BEYOND && s <= a->s[n - BEYOND]);
    rg_path_clear(&g->path);
    for (int32_t k = first; k < n; k++) {
        const double *t = a->t + (size_t)k * (size_t)a->N;
        rg_path_insert(&g->path, a->s[k], a->rho + (size_t)k * (size_t)a->N, a->told[k] & HAS_T ? t : NULL);
    }
    g->smooth = 1;
    g->one_way = is_ended ? a->ended_one_way : (a->told[n - 1] & ONE_WAY) != 0;
    if (!rg_integrate_read_off(g, s)) return NULL;
    if (!(g->closure <= *closure)) *closure = g->closure;
    return g->trial;
}

double rg_trace_read(rg_trace *q, double s, double *rho)
{
    rg_straight *const *system;
    const rg_straight *f = q->reader;
    double closure = 0;
    rg_straight_systems(f, &system);
    for (int32_t p = 0; p < q->parts; p++) {
        rg_straight *g = system[p];
        /* what nobody drives stays flat */
        const double *at = g->drive.count == 0 ? g->rho : read(&q->part[p], g, s, &closure);
        if (!at) return NAN;
        for (int32_t i = 0; i < g->mesh.N; i++)
            rho[f->apart.parts ? f->apart.crease[f->apart.start[p] + i] : i] = at[i];
    }
    return closure;
}
