#include "kinematics/orbits.h"

#include <string.h>

/* What is left of a unit vector that no more than rounding is. */
static const double NOTHING = 1e-9;

void rg_orbits_free(rg_orbits *O)
{
    if (!O->mem.resize) return;
    const rg_memory mem = O->mem;
    rg_least_free(&O->A);
    void *block[] = {O->vertex, O->kawasaki, O->column, O->part, O->way, O->direction, O->at, O->at_own, O->at_far, O->b, O->y};
    for (int i = 0; i < 11; i++) rg_mem_free(&mem, block[i]);
    memset(O, 0, sizeof *O);
}

/* --------------------------------------------------------------------------------------------- columns of Q ---- */

static int32_t number_creases(rg_orbits *O)
{
    const rg_symmetry *G = O->G;
    int32_t columns = 0;
    for (int32_t i = 0; i < G->N; i++) O->part[G->crease_orbit[i]]++; /* how many they are */
    for (int32_t i = 0; i < G->N; i++) {
        const int32_t first = G->crease_orbit[i];
        O->column[i] = first == i ? columns++ : O->column[first];
        O->part[i] = first == i ? 1 / sqrt(O->part[i]) : O->part[first];
    }
    return columns;
}

static rg_vec2 turned(const rg_symmetry *G, int32_t g, rg_vec2 d)
{
    return (rg_vec2){G->A[g][0][0] * d.x + G->A[g][0][1] * d.y, G->A[g][1][0] * d.x + G->A[g][1][1] * d.y};
}

/* Of d, what every element that leaves v where it is leaves as it is. *orbit: out, the size of v's. */
static rg_vec2 own_image(const rg_symmetry *G, int32_t v, rg_vec2 d, int32_t *orbit)
{
    rg_vec2 sum = {0, 0};
    int32_t n = 0;
    for (int32_t g = 0; g < G->order; g++) {
        if (G->vertex[(size_t)g * (size_t)G->nv + (size_t)v] != v) continue;
        const rg_vec2 image = turned(G, g, d);
        sum.x += image.x, sum.y += image.y;
        n++;
    }
    *orbit = G->order / n;
    return (rg_vec2){sum.x / n, sum.y / n};
}

/* Of d, what the ways of v allow. */
static rg_vec2 allowed(const rg_freedom *f, int32_t v, rg_vec2 d)
{
    rg_vec2 sum = {0, 0};
    for (int i = 0; i < 2; i++) {
        if (f->way[v][i] < 0) continue;
        const rg_vec2 along = f->direction[f->way[v][i]];
        const double part = rg_vec2_dot(d, along);
        sum.x += part * along.x, sum.y += part * along.y;
    }
    return sum;
}

static int32_t number_ways(rg_orbits *O, int32_t columns)
{
    const rg_symmetry *G = O->G;
    const rg_freedom *f = O->J->freedom;
    for (int32_t v = 0; v < G->nv; v++) O->way[v][0] = O->way[v][1] = -1;
    for (int32_t v = 0; v < G->nv; v++) {
        if (G->vertex_orbit[v] != v) continue;
        int32_t found = 0, size;
        rg_vec2 first = {0, 0};
        for (int i = 0; i < 2; i++) {
            if (f->way[v][i] < 0) continue;
            rg_vec2 d = own_image(G, v, f->direction[f->way[v][i]], &size);
            const double before = rg_vec2_dot(d, first);
            d = rg_vec2_sub(d, (rg_vec2){before * first.x, before * first.y});
            const double length = rg_vec2_length(d);
            if (length <= NOTHING) continue;
            d = (rg_vec2){d.x / length, d.y / length};
            for (int32_t g = 0; g < G->order; g++) {
                const int32_t w = G->vertex[(size_t)g * (size_t)G->nv + (size_t)v];
                const rg_vec2 there = allowed(f, w, turned(G, g, d));
                O->way[w][found] = columns;
                O->direction[w][found] = (rg_vec2){there.x / sqrt(size), there.y / sqrt(size)};
            }
            first = d;
            found++;
            columns++;
        }
    }
    return columns;
}

/* ------------------------------------------------------------------------------------------ entries of R A Q ---- */

/* Where the next entries of each column go, in rows of the vertex that is being laid out. */
typedef struct filler { int32_t *start, *fill, *row, *seen, *where; } filler;

/* Entries of one column in the rows of vertex number n, once for each column; fill->row NULL: counts them. */
static int32_t reserve(const rg_orbits *O, filler *f, int32_t n, int32_t column, int is_way)
{
    const int with_kawasaki = is_way && O->kawasaki[n] >= 0;
    if (f->seen[column] == n + 1) return f->where[column];
    f->seen[column] = n + 1;
    if (!f->row) {
        f->start[column + 1] += 3 + with_kawasaki;
        return 0;
    }
    f->where[column] = f->fill[column];
    for (int i = 0; i < 3; i++) f->row[f->fill[column]++] = 3 * n + i;
    if (with_kawasaki) f->row[f->fill[column]++] = O->kawasaki[n];
    return f->where[column];
}

static void lay_out(rg_orbits *O, filler *f)
{
    const rg_mesh *m = O->J->mesh;
    for (int32_t n = 0; n < O->count; n++) {
        const int32_t k = O->vertex[n], v = m->inner_vertex[k];
        for (int i = 0; i < 2; i++) O->at_own[k][i] = O->way[v][i] < 0 ? -1 : reserve(O, f, n, O->way[v][i], 1);
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
            const int32_t *far = O->way[O->J->far[j]];
            O->at[j] = reserve(O, f, n, O->column[m->loop_crease[j]], 0);
            for (int i = 0; i < 2; i++) O->at_far[j][i] = far[i] < 0 ? -1 : reserve(O, f, n, far[i], 1);
        }
    }
}

static rg_status make_pattern(rg_orbits *O, int32_t rows, int32_t columns)
{
    const size_t n = (size_t)columns;
    filler f = {rg_mem_array(&O->mem, n + 1, sizeof(int32_t)), rg_mem_array(&O->mem, n, sizeof(int32_t)), NULL,
                rg_mem_array(&O->mem, n, sizeof(int32_t)), rg_mem_array(&O->mem, n, sizeof(int32_t))};
    rg_status s = f.start && f.fill && f.seen && f.where ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) {
        lay_out(O, &f);
        for (int32_t i = 0; i < columns; i++) f.start[i + 1] += f.start[i];
        memcpy(f.fill, f.start, n * sizeof *f.fill);
        memset(f.seen, 0, n * sizeof *f.seen);
        f.row = rg_mem_array(&O->mem, (size_t)f.start[columns], sizeof *f.row);
        s = f.row ? RG_OK : RG_ENOMEM;
    }
    if (s == RG_OK) {
        lay_out(O, &f);
        s = rg_least_init(&O->A, &O->mem, rows, columns, f.start, f.row);
    }
    void *block[] = {f.start, f.fill, f.row, f.seen, f.where};
    for (int i = 0; i < 5; i++) rg_mem_free(&O->mem, block[i]);
    return s;
}

rg_status rg_orbits_init(rg_orbits *O, rg_coupled *J, const rg_symmetry *G)
{
    const rg_mesh *m = J->mesh;
    const rg_memory *mem = &J->mem;
    const size_t N = (size_t)m->N, nv = (size_t)m->nv, M = (size_t)m->M, spokes = (size_t)m->loop_start[m->M];
    memset(O, 0, sizeof *O);
    O->mem = *mem;
    O->J = J;
    O->G = G;
    O->vertex = rg_mem_array(mem, M, sizeof *O->vertex);
    O->kawasaki = rg_mem_array(mem, M, sizeof *O->kawasaki);
    O->column = rg_mem_array(mem, N, sizeof *O->column);
    O->part = rg_mem_array(mem, N, sizeof *O->part);
    O->way = rg_mem_array(mem, nv, sizeof *O->way);
    O->direction = rg_mem_array(mem, nv, sizeof *O->direction);
    O->at = rg_mem_array(mem, spokes, sizeof *O->at);
    O->at_own = rg_mem_array(mem, M, sizeof *O->at_own);
    O->at_far = rg_mem_array(mem, spokes, sizeof *O->at_far);
    O->b = rg_mem_array(mem, 4 * M, sizeof *O->b);
    O->y = rg_mem_array(mem, N + (size_t)J->U, sizeof *O->y);
    rg_status s = O->vertex && O->kawasaki && O->column && O->part && O->way && O->direction && O->at && O->at_own && O->at_far &&
                          O->b && O->y ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) {
        int32_t rows = 0;
        for (int32_t k = 0; k < m->M; k++)
            if (G->vertex_orbit[m->inner_vertex[k]] == m->inner_vertex[k]) O->vertex[O->count++] = k;
        rows = 3 * O->count;
        for (int32_t n = 0; n < O->count; n++) O->kawasaki[n] = J->kawasaki[O->vertex[n]] < 0 ? -1 : rows++; /* eq. (16) */
        s = make_pattern(O, rows, number_ways(O, number_creases(O)));
    }
    if (s != RG_OK) rg_orbits_free(O);
    return s;
}

/* -------------------------------------------------------------------------------------------------- numbers ---- */

double rg_orbits_assemble(rg_orbits *O, const double *rho, const double *u, double *off)
{
    return rg_coupled_assemble_some(O->J, O->vertex, O->count, rho, u, off);
}

/* How much the unknowns of vertex v's ways are scaled. */
static double scale_of(const rg_orbits *O, int32_t v, const double *scale)
{
    return scale[O->J->N + O->J->freedom->way[O->G->vertex_orbit[v]][0]];
}

/* As in coupled.c: the direction of a loop entry turns by g . (dX of its far end - dX of the vertex). */
static void add_turn(rg_orbits *O, const int32_t at[2], int32_t v, rg_vec2 g, rg_vec3 normal, double sign, const double *scale)
{
    for (int i = 0; i < 2; i++) {
        if (at[i] < 0) continue;
        const double turn = scale_of(O, v, scale) * rg_vec2_dot(g, O->direction[v][i]);
        double *x = O->A.x + at[i];
        x[0] += turn * normal.x, x[1] += turn * normal.y, x[2] += turn * normal.z;
        if (sign != 0) x[3] += turn * sign; /* eq. (17) */
    }
}

void rg_orbits_renew(rg_orbits *O, const double *scale)
{
    rg_coupled *J = O->J;
    const rg_mesh *m = J->mesh;
    memset(O->A.x, 0, (size_t)O->A.start[O->A.columns] * sizeof *O->A.x);
    for (int32_t n = 0; n < O->count; n++) {
        const int32_t k = O->vertex[n], v = m->inner_vertex[k], first = m->loop_start[k];
        const int kept = O->kawasaki[n] >= 0;
        double sum;
        if (kept && J->U) rg_coupled_alternate(J, k, &sum, J->sign);
        for (int32_t j = first; j < m->loop_start[k + 1]; j++) {
            const int32_t i = m->loop_crease[j];
            const double of = m->still && m->still[m->crease_edge[i]] ? 0 : O->part[i] * scale[O->G->crease_orbit[i]];
            double *x = O->A.x + O->at[j];
            x[0] += of * J->direction[j].x, x[1] += of * J->direction[j].y, x[2] += of * J->direction[j].z;
            if (!J->U) continue;
            rg_vec2 g;
            rg_vec3 normal;
            rg_coupled_turn(J, k, j, &g, &normal);
            const double part = kept ? J->sign[j - first] : 0;
            add_turn(O, O->at_far[j], J->far[j], g, normal, part, scale);
            add_turn(O, O->at_own[k], v, (rg_vec2){-g.x, -g.y}, normal, part, scale);
        }
    }
    rg_least_renew(&O->A);
}

/* y = Q^T z */
static void gather(const rg_orbits *O, const double *z, double *y)
{
    const rg_freedom *f = O->J->freedom;
    memset(y, 0, (size_t)O->A.columns * sizeof *y);
    for (int32_t i = 0; i < O->J->N; i++) y[O->column[i]] += O->part[i] * z[i];
    for (int32_t w = 0; w < f->U; w++)
        for (int i = 0; i < 2; i++) {
            const int32_t v = f->vertex[w];
            if (O->way[v][i] >= 0) y[O->way[v][i]] += rg_vec2_dot(O->direction[v][i], f->direction[w]) * z[O->J->N + w];
        }
}

/* x = Q y */
static void scatter(const rg_orbits *O, const double *y, double *x)
{
    const rg_freedom *f = O->J->freedom;
    for (int32_t i = 0; i < O->J->N; i++) x[i] = O->part[i] * y[O->column[i]];
    for (int32_t w = 0; w < f->U; w++) {
        const int32_t v = f->vertex[w];
        double sum = 0;
        for (int i = 0; i < 2; i++)
            if (O->way[v][i] >= 0) sum += rg_vec2_dot(O->direction[v][i], f->direction[w]) * y[O->way[v][i]];
        x[O->J->N + w] = sum;
    }
}

void rg_orbits_solve(rg_orbits *O, const double *z, const double *r, double *x)
{
    memset(O->b, 0, (size_t)O->A.rows * sizeof *O->b);
    if (z) {
        gather(O, z, O->y);
        rg_least_mul(&O->A, O->y, O->b);
    }
    for (int32_t n = 0; r && n < O->count; n++) {
        const int32_t k = O->vertex[n];
        for (int i = 0; i < 3; i++) O->b[3 * n + i] += r[3 * k + i];
        if (O->kawasaki[n] >= 0) O->b[O->kawasaki[n]] += r[O->J->kawasaki[k]];
    }
    rg_least_solve(&O->A, O->b, O->y); /* eqs. (14), (15), (19) */
    scatter(O, O->y, x);
}
