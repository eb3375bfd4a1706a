#include "fold/path.h"

#include <assert.h>
#include <math.h>
#include <string.h>

rg_status rg_path_init(rg_path *p, const rg_memory *mem, int32_t N)
{
    memset(p, 0, sizeof *p);
    p->mem = *mem;
    p->N = N;
    const size_t room = ((size_t)N + 3) / 4 * 4;
    for (int32_t i = 0; i < RG_PATH_NODES; i++) {
        p->node[i].rho = rg_mem_array(mem, room, sizeof(double));
        p->node[i].t = rg_mem_array(mem, room, sizeof(double));
        if (!p->node[i].rho || !p->node[i].t) {
            rg_path_free(p);
            return RG_ENOMEM;
        }
    }
    return RG_OK;
}

void rg_path_free(rg_path *p)
{
    if (!p->mem.resize) return;
    for (int32_t i = 0; i < RG_PATH_NODES; i++) {
        rg_mem_free(&p->mem, p->node[i].rho);
        rg_mem_free(&p->mem, p->node[i].t);
    }
    memset(p, 0, sizeof *p);
}

void rg_path_clear(rg_path *p) { p->count = 0; }

void rg_path_insert(rg_path *p, double s, const double *rho, const double *t)
{
    const size_t bytes = (size_t)p->N * sizeof(double);
    if (p->count == RG_PATH_NODES) { /* the oldest node's arrays become the last one's */
        rg_node oldest = p->node[0];
        memmove(p->node, p->node + 1, (RG_PATH_NODES - 1) * sizeof *p->node);
        p->node[--p->count] = oldest;
    }
    rg_node fresh = p->node[p->count];
    int32_t at = p->count++;
    for (; at > 0 && p->node[at - 1].s > s; at--) p->node[at] = p->node[at - 1];
    p->node[at] = fresh;
    p->node[at].s = s;
    p->node[at].has_t = t != NULL;
    memcpy(p->node[at].rho, rho, bytes);
    if (t) memcpy(p->node[at].t, t, bytes);
}

/* Hermite's polynomials in Lagrange's form: with q_i(s) = prod over j != i of ((s - s_j) / (s_i - s_j))^m_j, m_j
 * conditions at node j, and c = q_i'(s_i), the polynomial is
 *     sum of rho_i q_i (1 - c (s - s_i)) + t_i q_i (s - s_i)      where t is known, else rho_i q_i.
 * a, b: their values at s; da, db: their slopes. */
static void hermite(const rg_node *node, int32_t n, double s, double *a, double *b, double *da, double *db)
{
    for (int32_t i = 0; i < n; i++) {
        double q = 1, log_slope = 0, c = 0, x = s - node[i].s;
        for (int32_t j = 0; j < n; j++) {
            if (j == i) continue;
            double u = (s - node[j].s) / (node[i].s - node[j].s);
            q *= node[j].has_t ? u * u : u;
            log_slope += (1 + node[j].has_t) / (s - node[j].s);
            c += (1 + node[j].has_t) / (node[i].s - node[j].s);
        }
        double dq = q * log_slope;
        a[i] = node[i].has_t ? q * (1 - c * x) : q;
        b[i] = node[i].has_t ? q * x : 0;
        da[i] = node[i].has_t ? dq * (1 - c * x) - q * c : dq;
        db[i] = node[i].has_t ? dq * x + q : 0;
    }
}

/* out = sum of a_i rho_i + b_i t_i */
static void combine(const rg_path *p, int32_t first, int32_t n, const double *a, const double *b, double *out)
{
    for (int32_t k = 0; k < p->N; k++) out[k] = 0;
    for (int32_t i = 0; i < n; i++) {
        const double *rho = p->node[first + i].rho, *t = p->node[first + i].t;
        if (b[i] == 0)
            for (int32_t k = 0; k < p->N; k++) out[k] += a[i] * rho[k];
        else
            for (int32_t k = 0; k < p->N; k++) out[k] += a[i] * rho[k] + b[i] * t[k];
    }
}

void rg_path_evaluate(const rg_path *p, int32_t first, int32_t n, double s, double *rho, double *t)
{
    double a[RG_PATH_NODES], b[RG_PATH_NODES], da[RG_PATH_NODES], db[RG_PATH_NODES];
    for (int32_t i = first; i < first + n; i++)
        if (s == p->node[i].s) { /* the slope's formula has no value there, and none is needed */
            if (rho) memcpy(rho, p->node[i].rho, (size_t)p->N * sizeof *rho);
            if (t) memcpy(t, p->node[i].t, (size_t)p->N * sizeof *t);
            return;
        }
    hermite(p->node + first, n, s, a, b, da, db);
    if (rho) combine(p, first, n, a, b, rho);
    if (t) combine(p, first, n, da, db, t);
}

void rg_path_around(const rg_path *p, double s, int32_t *first, int32_t *n)
{
    *first = 0;
    while (*first + 2 < p->count && p->node[*first + 1].s < s) ++*first;
    *n = p->count - *first < 2 ? p->count - *first : 2;
}

void rg_path_cut(rg_path *p, double s)
{
    while (p->count > 2 && p->node[p->count - 1].s > s) p->count--;
}

void rg_path_window(const rg_path *p, double s, int32_t *first, int32_t *n)
{
    int32_t at = 0;
    while (at + 1 < p->count && p->node[at + 1].s < s) at++; /* s is behind node `at` and not beyond the next one */
    *n = p->count < RG_PATH_WINDOW ? p->count : RG_PATH_WINDOW;
    *first = at - (*n / 2 - 1);
    if (*first > p->count - *n) *first = p->count - *n;
    if (*first < 0) *first = 0;
}

double rg_path_reach(const rg_path *p, int32_t first, int32_t n, double s, int conditions)
{
    double reach = 1;
    for (int32_t i = first; i < first + n; i++) {
        double d = fabs(s - p->node[i].s);
        reach *= conditions == 2 && p->node[i].has_t ? d * d : d;
    }
    return reach;
}

void rg_path_integral(const rg_path *p, int32_t first, int32_t n, double from, double to, double *w)
{
    /* Gauss and Legendre's five points: exact up to degree 9. */
    static const double x[5] = {-0.90617984593866399280, -0.53846931010568309104, 0, 0.53846931010568309104,
                                0.90617984593866399280};
    static const double g[5] = {0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889,
                                0.47862867049936646804, 0.23692688505618908751};
    assert(n <= 9);
    for (int32_t i = 0; i < n; i++) w[i] = 0;
    for (int32_t k = 0; k < 5; k++) {
        double s = (from + to) / 2 + x[k] * (to - from) / 2;
        for (int32_t i = 0; i < n; i++) {
            double l = 1;
            for (int32_t j = 0; j < n; j++)
                if (j != i) l *= (s - p->node[first + j].s) / (p->node[first + i].s - p->node[first + j].s);
            w[i] += g[k] * l * (to - from) / 2;
        }
    }
}
