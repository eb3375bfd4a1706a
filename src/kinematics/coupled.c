#include "kinematics/coupled.h"
#include "kinematics/kawasaki.h"

#include <string.h>

/* What is left of a unit vector that no more than rounding is. */
static const double NOTHING = 1e-9;

void rg_coupled_free(rg_coupled *J)
{
    if (!J->mem.resize) return;
    const rg_memory mem = J->mem;
    rg_least_free(&J->A);
    rg_fours_free(&J->some, &mem);
    RG_MEM_FREE(&mem, J->vertex, J->kawasaki, J->column, J->part, J->way, J->direction, J->at, J->at_own, J->at_far,
                J->sign, J->b, J->y);
    memset(J, 0, sizeof *J);
}

/* --------------------------------------------------------------------------------------------- columns of Q ---- */

static int32_t number_creases(rg_coupled *J)
{
    const rg_symmetry *G = J->G;
    const int32_t N = J->K->C.N;
    int32_t columns = 0;
    for (int32_t i = 0; i < N; i++) J->part[G ? G->crease_orbit[i] : i]++; /* how many they are */
    for (int32_t i = 0; i < N; i++) {
        const int32_t first = G ? G->crease_orbit[i] : i;
        J->column[i] = first == i ? columns++ : J->column[first];
        J->part[i] = first == i ? 1 / sqrt(J->part[i]) : J->part[first];
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

/* Every way by itself. */
static int32_t number_all_ways(rg_coupled *J, int32_t columns)
{
    const rg_freedom *f = J->K->freedom;
    for (int32_t v = 0; v < J->K->mesh->nv; v++)
        for (int i = 0; i < 2; i++) {
            const int32_t way = f->way[v][i];
            J->way[v][i] = way < 0 ? -1 : columns + way;
            if (way >= 0) J->direction[v][i] = f->direction[way];
        }
    return columns + f->U;
}

static int32_t number_ways(rg_coupled *J, int32_t columns)
{
    const rg_symmetry *G = J->G;
    const rg_freedom *f = J->K->freedom;
    for (int32_t v = 0; v < G->nv; v++) J->way[v][0] = J->way[v][1] = -1;
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
                J->way[w][found] = columns;
                J->direction[w][found] = (rg_vec2){there.x / sqrt(size), there.y / sqrt(size)};
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
static int32_t reserve(const rg_coupled *J, filler *f, int32_t n, int32_t column, int is_way)
{
    const int with_kawasaki = is_way && J->kawasaki[n] >= 0;
    if (f->seen[column] == n + 1) return f->where[column];
    f->seen[column] = n + 1;
    if (!f->row) {
        f->start[column + 1] += 3 + with_kawasaki;
        return 0;
    }
    f->where[column] = f->fill[column];
    for (int i = 0; i < 3; i++) f->row[f->fill[column]++] = 3 * n + i;
    if (with_kawasaki) f->row[f->fill[column]++] = J->kawasaki[n];
    return f->where[column];
}

static void lay_out(rg_coupled *J, filler *f)
{
    const rg_mesh *m = J->K->mesh;
    for (int32_t n = 0; n < J->count; n++) {
        const int32_t k = J->vertex[n], v = m->inner_vertex[k];
        for (int i = 0; i < 2; i++) J->at_own[k][i] = J->way[v][i] < 0 ? -1 : reserve(J, f, n, J->way[v][i], 1);
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
            const int32_t *far = J->way[J->K->far[j]];
            J->at[j] = reserve(J, f, n, J->column[m->loop_crease[j]], 0);
            for (int i = 0; i < 2; i++) J->at_far[j][i] = far[i] < 0 ? -1 : reserve(J, f, n, far[i], 1);
        }
    }
}

static rg_status make_pattern(rg_coupled *J, int32_t rows, int32_t columns)
{
    const size_t n = (size_t)columns;
    filler f = {rg_mem_array(&J->mem, n + 1, sizeof(int32_t)), rg_mem_array(&J->mem, n, sizeof(int32_t)), NULL,
                rg_mem_array(&J->mem, n, sizeof(int32_t)), rg_mem_array(&J->mem, n, sizeof(int32_t))};
    rg_status s = f.start && f.fill && f.seen && f.where ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) {
        lay_out(J, &f);
        for (int32_t i = 0; i < columns; i++) f.start[i + 1] += f.start[i];
        memcpy(f.fill, f.start, n * sizeof *f.fill);
        memset(f.seen, 0, n * sizeof *f.seen);
        f.row = rg_mem_array(&J->mem, (size_t)f.start[columns], sizeof *f.row);
        s = f.row ? RG_OK : RG_ENOMEM;
    }
    if (s == RG_OK) {
        lay_out(J, &f);
        s = rg_least_init(&J->A, &J->mem, rows, columns, f.start, f.row);
    }
    RG_MEM_FREE(&J->mem, f.start, f.fill, f.row, f.seen, f.where);
    return s;
}

rg_status rg_coupled_init(rg_coupled *J, const rg_memory *mem, rg_constraint *K, const rg_symmetry *G)
{
    const rg_mesh *m = K->mesh;
    const size_t N = (size_t)m->N, nv = (size_t)m->nv, M = (size_t)m->M, spokes = (size_t)m->loop_start[m->M];
    memset(J, 0, sizeof *J);
    J->mem = *mem;
    J->K = K;
    J->G = G;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(J->vertex, M), RG_ARRAY(J->kawasaki, M), RG_ARRAY(J->column, N),
                                RG_ARRAY(J->part, N), RG_ARRAY(J->way, nv), RG_ARRAY(J->direction, nv),
                                RG_ARRAY(J->at, spokes), RG_ARRAY(J->at_own, M), RG_ARRAY(J->at_far, spokes),
                                RG_ARRAY(J->sign, spokes), RG_ARRAY(J->b, 4 * M),
                                RG_ARRAY(J->y, N + (size_t)K->freedom->U));
    if (s == RG_OK) {
        for (int32_t k = 0; k < m->M; k++)
            if (!G || G->vertex_orbit[m->inner_vertex[k]] == m->inner_vertex[k]) J->vertex[J->count++] = k;
        int32_t rows = 3 * J->count;
        for (int32_t n = 0; n < J->count; n++)
            J->kawasaki[n] = K->kawasaki[J->vertex[n]] < 0 ? -1 : rows++; /* eq. (16) */
        const int32_t creases = number_creases(J);
        s = make_pattern(J, rows, G ? number_ways(J, creases) : number_all_ways(J, creases));
    }
    if (s == RG_OK && G) s = rg_fours_init(&J->some, mem, &K->C, J->vertex, J->count);
    if (s != RG_OK) rg_coupled_free(J);
    return s;
}

/* -------------------------------------------------------------------------------------------------- numbers ---- */

double rg_coupled_assemble(rg_coupled *J, const double *rho, const double *u, double *off)
{
    return rg_constraint_assemble_at(J->K, J->G ? &J->some : NULL, rho, u, off);
}

/* The direction of a loop entry turns by g . (dX of its far end - dX of the vertex): adds what that of v does to the
 * rows. Turning it takes from the sector behind it what it gives to the one before. */
static void add_turn(rg_coupled *J, const int32_t at[2], int32_t v, rg_vec2 g, rg_vec3 normal, double sign,
                     const double *scale)
{
    const int32_t *of = J->K->freedom->way[J->G ? J->G->vertex_orbit[v] : v];
    for (int i = 0; i < 2; i++) {
        if (at[i] < 0) continue;
        const double turn = scale[J->K->C.N + of[J->G ? 0 : i]] * rg_vec2_dot(g, J->direction[v][i]);
        double *x = J->A.x + at[i];
        x[0] += turn * normal.x, x[1] += turn * normal.y, x[2] += turn * normal.z;
        if (sign != 0) x[3] += turn * sign; /* eq. (17) */
    }
}

void rg_coupled_renew(rg_coupled *J, const double *scale)
{
    const rg_constraint *K = J->K;
    const rg_mesh *m = K->mesh;
    memset(J->A.x, 0, (size_t)J->A.start[J->A.columns] * sizeof *J->A.x);
    for (int32_t n = 0; n < J->count; n++) {
        const int32_t k = J->vertex[n], v = m->inner_vertex[k], first = m->loop_start[k], last = m->loop_start[k + 1];
        const int kept = J->kawasaki[n] >= 0;
        double sum;
        if (kept) rg_kawasaki_alternate(m, k, K->sector, &sum, J->sign);
        for (int32_t j = first; j < last; j++) {
            const int32_t i = m->loop_crease[j];
            const double of = J->part[i] * scale[J->G ? J->G->crease_orbit[i] : i];
            double *x = J->A.x + J->at[j];
            x[0] += of * K->C.x[j].x, x[1] += of * K->C.x[j].y, x[2] += of * K->C.x[j].z; /* C        eq. (8) */
            if (!K->freedom->U) continue;
            const rg_vec2 g = K->turning[j];
            const rg_vec3 normal = rg_vec3_sub(K->normal[j > first ? j - 1 : last - 1], K->normal[j]);
            const double part = kept ? J->sign[j - first] : 0;
            add_turn(J, J->at_far[j], K->far[j], g, normal, part, scale); /* D, G */
            add_turn(J, J->at_own[k], v, (rg_vec2){-g.x, -g.y}, normal, part, scale);
        }
    }
    rg_least_renew(&J->A);
}

/* y = Q^T z */
static void gather(const rg_coupled *J, const double *z, double *y)
{
    const rg_freedom *f = J->K->freedom;
    memset(y, 0, (size_t)J->A.columns * sizeof *y);
    for (int32_t i = 0; i < J->K->C.N; i++) y[J->column[i]] += J->part[i] * z[i];
    for (int32_t w = 0; w < f->U; w++)
        for (int i = 0; i < 2; i++) {
            const int32_t v = f->vertex[w];
            if (J->way[v][i] >= 0)
                y[J->way[v][i]] += rg_vec2_dot(J->direction[v][i], f->direction[w]) * z[J->K->C.N + w];
        }
}

/* x = Q y */
static void scatter(const rg_coupled *J, const double *y, double *x)
{
    const rg_freedom *f = J->K->freedom;
    for (int32_t i = 0; i < J->K->C.N; i++) x[i] = J->part[i] * y[J->column[i]];
    for (int32_t w = 0; w < f->U; w++) {
        const int32_t v = f->vertex[w];
        double sum = 0;
        for (int i = 0; i < 2; i++)
            if (J->way[v][i] >= 0) sum += rg_vec2_dot(J->direction[v][i], f->direction[w]) * y[J->way[v][i]];
        x[J->K->C.N + w] = sum;
    }
}

void rg_coupled_solve(rg_coupled *J, const double *z, const double *r, double *x)
{
    memset(J->b, 0, (size_t)J->A.rows * sizeof *J->b);
    if (z) {
        gather(J, z, J->y);
        rg_least_mul(&J->A, J->y, J->b);
    }
    for (int32_t n = 0; r && n < J->count; n++) {
        const int32_t k = J->vertex[n];
        for (int i = 0; i < 3; i++) J->b[3 * n + i] += r[3 * k + i];
        if (J->kawasaki[n] >= 0) J->b[J->kawasaki[n]] += r[J->K->kawasaki[k]];
    }
    rg_least_solve(&J->A, J->b, J->y); /* eqs. (14), (15), (19) */
    scatter(J, J->y, x);
}
