#include "mesh/inside.h"
#include "pattern/closed.h"

/* The creases around a vertex as drawn: added ones left out, the angle to the next one, and whether that sector is
 * whole. */
typedef struct spoke { int32_t crease; double theta; int whole; } spoke;

static int32_t drawn_spokes(const rg_mesh *m, int32_t k, spoke *s)
{
    const int32_t first = m->loop_start[k], last = m->loop_start[k + 1];
    int32_t n = 0, start = first;
    while (start < last && m->loop_crease[start] >= m->N - m->added) start++;
    for (int32_t i = 0; start < last && i < last - first; i++) {
        const int32_t j = first + (start - first + i) % (last - first);
        if (m->loop_crease[j] < m->N - m->added) s[n++] = (spoke){m->loop_crease[j], m->loop_theta[j], 1};
        else s[n - 1].theta += m->loop_theta[j], s[n - 1].whole = 0;
    }
    return n;
}

static char assignment(const rg_mesh *m, spoke s) { return m->assignment[m->crease_edge[s.crease]]; }

/* Flags the corner at v that lies counter-clockwise of a crease. */
static void flag_corner(const rg_mesh *m, int32_t v, int32_t crease, unsigned char *flag)
{
    const int32_t e = m->crease_edge[crease], f = m->edge_facet[e][m->edge[e][0] != v];
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) flag[j] |= m->facet_edge[j] == e;
}

rg_status rg_inside_find(const rg_mesh *m, unsigned char *flag)
{
    spoke *s = rg_mem_array(&m->mem, (size_t)m->N, sizeof *s);
    if (!s) return RG_ENOMEM;
    for (int32_t j = 0; j < m->facet_start[m->nf]; j++) flag[j] = 0;
    for (int32_t k = 0; k < m->M; k++) {
        const int32_t n = drawn_spokes(m, k, s);
        for (int32_t i = 0; n >= 3 && i < n; i++) {
            const spoke a = s[i], c = s[(i + 1) % n], b = s[(i + 2) % n];
            const int which = rg_closed_inside(assignment(m, a), assignment(m, c), assignment(m, b), a.theta, c.theta);
            const spoke inside = which == 1 ? a : c;
            if (which && inside.whole) flag_corner(m, m->inner_vertex[k], inside.crease, flag);
        }
    }
    rg_mem_free(&m->mem, s);
    return RG_OK;
}
