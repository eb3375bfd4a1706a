#include "pattern/closed.h"
#include "pattern/check.h"

/* Two sector angles of a drawing are equal when they differ by no more. */
static const double EQUAL = 0.01 * RG_DEG;

static int folds(char assignment) { return assignment == RG_MOUNTAIN || assignment == RG_VALLEY; }

int rg_closed_inside(char a, char c, char b, double ac, double cb)
{
    if (!folds(a) || !folds(c) || !folds(b) || a == b || !(fabs(ac - cb) <= EQUAL)) return 0;
    return a != c ? 1 : 2;
}

static void far_end(const struct rg_pattern *p, int32_t v, int32_t e, double x[2])
{
    const rg_vec2 at = p->X[p->E[e].v[p->E[e].v[0] == v]];
    x[0] = at.x;
    x[1] = at.y;
}

/* As rg_closed_inside, of edges a, c, b with these angles between them. */
static int inside_of(const struct rg_pattern *p, int32_t a, int32_t c, int32_t b, double ac, double cb)
{
    return rg_closed_inside(p->E[a].assignment, p->E[c].assignment, p->E[b].assignment, ac, cb);
}

/* Whether the assignments alone leave it possible: the angles of most vertices are not asked for. */
static int may_close(const struct rg_pattern *p, const int32_t *star, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        if (inside_of(p, star[i], star[(i + 1) % n], star[(i + 2) % n], 0, 0)) return 1;
    return 0;
}

rg_status rg_closed_find(struct rg_pattern *p)
{
    size_t room = 0;
    rg_status s = RG_OK;
    double *theta = rg_mem_array(&p->mem, (size_t)rg_check_most_edges(p), sizeof *theta);
    if (!theta) return RG_ENOMEM;
    for (int32_t v = 0; s == RG_OK && v < p->nv; v++) {
        const int32_t *star = p->star + p->star_start[v], n = p->star_start[v + 1] - p->star_start[v];
        for (int32_t i = 0; i < n && p->star_start[v] + i + RG_SOON < p->star_start[p->nv]; i++)
            rg_mem_soon(&p->E[star[i + RG_SOON]]);
        if (p->rim[v] || n < 3 || !may_close(p, star, n)) continue;
        rg_check_sectors(p, v, theta);
        int found = 0;
        for (int32_t i = 0; s == RG_OK && i < n; i++) {
            const int32_t next = (i + 1) % n, a = star[i], c = star[next], b = star[(i + 2) % n];
            const int inside = inside_of(p, a, c, b, theta[i], theta[next]);
            if (!inside) continue;
            s = RG_MEM_GROW(&p->mem, p->closed, room, (size_t)p->closed_triples + 1);
            if (s != RG_OK) break;
            rg_closed *closed = &p->closed[p->closed_triples++];
            *closed = (rg_closed){.vertex = v, .x = p->X[v].x, .y = p->X[v].y,
                                  .inside_angle = inside == 1 ? theta[i] : theta[next]};
            far_end(p, v, a, closed->a);
            far_end(p, v, c, closed->c);
            far_end(p, v, b, closed->b);
            found = 1;
        }
        p->info.closed_vertices += found;
    }
    rg_mem_free(&p->mem, theta);
    return s;
}
