#include "kinematics/coupled.h"
#include "kinematics/loop.h"

#include <string.h>

/* A vertex counts as flat-foldable when Kawasaki's sum is off by no more (radians, 1.15 degrees): twice what drawings by hand are. */
static const double FLAT_FOLDABLE = 0.02;

static int32_t other_end(const rg_mesh *m, int32_t crease, int32_t v)
{
    const int32_t *e = m->edge[m->crease_edge[crease]];
    return e[e[0] == v];
}

static int is_drawn(const rg_mesh *m, int32_t crease) { return crease < m->N - m->added; }

int32_t rg_coupled_alternate(const rg_coupled *J, int32_t k, double *sum, double *sign)
{
    const rg_mesh *m = J->mesh;
    const int32_t first = m->loop_start[k], last = m->loop_start[k + 1];
    int32_t n = 0, start = -1, before = -1;
    double turn = 1, angle = 0, total = 0;
    for (int32_t j = first; j < last; j++) {
        if (sign) sign[j - first] = 0;
        if (is_drawn(m, m->loop_crease[j]) && start < 0) start = j;
    }
    for (int32_t i = 0; start >= 0 && i <= last - first; i++) {
        const int32_t j = first + (start - first + i) % (last - first);
        if (is_drawn(m, m->loop_crease[j])) {
            if (before >= 0) {
                total += turn * angle;
                if (sign) sign[j - first] += turn, sign[before - first] -= turn;
                turn = -turn;
                n++;
            }
            before = j;
            angle = 0;
        }
        angle += J->theta[j];
    }
    *sum = total; /* eq. (18) */
    return n;
}

static void number_rows(rg_coupled *J, int kawasaki)
{
    for (int32_t k = 0; k < J->M; k++) {
        double sum;
        J->kawasaki[k] = -1;
        if (!kawasaki || !J->U) continue;
        const int32_t n = rg_coupled_alternate(J, k, &sum, NULL);
        if (n >= 4 && n % 2 == 0 && fabs(sum) <= FLAT_FOLDABLE) J->kawasaki[k] = 3 * J->M + J->K++; /* eq. (16) */
    }
}

/* Reserves the entries of one column in rows of vertex k; fill NULL: only counts them in start. */
static int32_t reserve(const rg_coupled *J, int32_t k, int32_t column, int32_t *start, int32_t *fill, int32_t *row)
{
    const int with_kawasaki = column >= J->N && J->kawasaki[k] >= 0;
    if (!fill) {
        start[column + 1] += 3 + with_kawasaki;
        return 0;
    }
    const int32_t at = fill[column];
    for (int i = 0; i < 3; i++) row[fill[column]++] = 3 * k + i;
    if (with_kawasaki) row[fill[column]++] = J->kawasaki[k];
    return at;
}

static void lay_out(rg_coupled *J, int32_t *start, int32_t *fill, int32_t *row)
{
    const rg_mesh *m = J->mesh;
    for (int32_t k = 0; k < J->M; k++) {
        const int32_t *own = J->freedom->way[m->inner_vertex[k]];
        for (int i = 0; i < 2; i++) J->at_own[k][i] = own[i] < 0 ? -1 : reserve(J, k, J->N + own[i], start, fill, row);
        for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
            const int32_t *far = J->freedom->way[J->far[j]];
            J->at[j] = reserve(J, k, m->loop_crease[j], start, fill, row);
            for (int i = 0; i < 2; i++) J->at_far[j][i] = far[i] < 0 ? -1 : reserve(J, k, J->N + far[i], start, fill, row);
        }
    }
}

static rg_status make_pattern(rg_coupled *J)
{
    const int32_t rows = 3 * J->M + J->K, columns = J->N + J->U;
    int32_t *start = rg_mem_array(&J->mem, (size_t)columns + 1, sizeof *start), *row = NULL;
    int32_t *fill = rg_mem_array(&J->mem, (size_t)columns, sizeof *fill);
    rg_status s = start && fill ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) {
        lay_out(J, start, NULL, NULL);
        for (int32_t i = 0; i < columns; i++) start[i + 1] += start[i];
        memcpy(fill, start, (size_t)columns * sizeof *fill);
        row = rg_mem_array(&J->mem, (size_t)start[columns], sizeof *row);
        s = row ? RG_OK : RG_ENOMEM;
    }
    if (s == RG_OK) {
        lay_out(J, start, fill, row);
        s = rg_least_init(&J->A, &J->mem, rows, columns, start, row);
    }
    rg_mem_free(&J->mem, start);
    rg_mem_free(&J->mem, fill);
    rg_mem_free(&J->mem, row);
    return s;
}

rg_status rg_coupled_init(rg_coupled *J, const rg_memory *mem, const rg_mesh *m, const rg_freedom *f, int kawasaki)
{
    memset(J, 0, sizeof *J);
    J->mem = *mem;
    J->mesh = m;
    J->freedom = f;
    J->N = m->N;
    J->M = m->M;
    J->U = f->U;
    const size_t spokes = (size_t)m->loop_start[m->M], M = (size_t)m->M;
    J->X = rg_mem_array(mem, (size_t)m->nv, sizeof *J->X);
    J->theta = rg_mem_array(mem, spokes, sizeof *J->theta);
    J->r = rg_mem_array(mem, 4 * M, sizeof *J->r);
    J->far = rg_mem_array(mem, spokes, sizeof *J->far);
    J->kawasaki = rg_mem_array(mem, M, sizeof *J->kawasaki);
    J->direction = rg_mem_array(mem, spokes, sizeof *J->direction);
    J->normal = rg_mem_array(mem, spokes, sizeof *J->normal);
    J->sign = rg_mem_array(mem, spokes, sizeof *J->sign);
    J->at = rg_mem_array(mem, spokes, sizeof *J->at);
    J->at_own = rg_mem_array(mem, M, sizeof *J->at_own);
    J->at_far = rg_mem_array(mem, spokes, sizeof *J->at_far);
    rg_status s = J->X && J->theta && J->r && J->far && J->kawasaki && J->direction && J->normal && J->sign && J->at && J->at_own &&
                          J->at_far ? RG_OK : RG_ENOMEM;
    if (s == RG_OK) {
        memcpy(J->X, m->X, (size_t)m->nv * sizeof *J->X);
        memcpy(J->theta, m->loop_theta, spokes * sizeof *J->theta);
        for (int32_t k = 0; k < m->M; k++)
            for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++)
                J->far[j] = other_end(m, m->loop_crease[j], m->inner_vertex[k]);
        number_rows(J, kawasaki);
    }
    if (s == RG_OK) s = make_pattern(J);
    if (s != RG_OK) rg_coupled_free(J);
    return s;
}

void rg_coupled_free(rg_coupled *J)
{
    if (!J->mem.resize) return;
    rg_least_free(&J->A);
    void *block[] = {J->X, J->theta, J->r, J->far, J->kawasaki, J->direction, J->normal, J->sign, J->at, J->at_own, J->at_far};
    for (int i = 0; i < 11; i++) rg_mem_free(&J->mem, block[i]);
    memset(J, 0, sizeof *J);
}

/* Returns the rotation angle of F at interior vertex k. */
static double assemble_vertex(rg_coupled *J, int32_t k, const double *rho)
{
    const rg_mesh *m = J->mesh;
    rg_mat3 A = rg_mat3_identity();
    for (int32_t j = m->loop_start[k]; j < m->loop_start[k + 1]; j++) {
        const double angle = rho[m->loop_crease[j]], theta = J->theta[j];
        J->direction[j] = A.c[0];
        A = rg_loop_advance(A, (rg_turn){cos(angle), sin(angle)}, (rg_turn){cos(theta), sin(theta)}); /* eq. (1) */
        J->normal[j] = A.c[2]; /* turning by theta is about the facet's normal, which it leaves as it is */
    }
    const rg_vec3 r = rg_loop_residual(A);
    J->r[3 * k] = r.x, J->r[3 * k + 1] = r.y, J->r[3 * k + 2] = r.z; /* eq. (12) */
    return rg_loop_angle(A);
}

double rg_coupled_assemble_some(rg_coupled *J, const int32_t *vertex, int32_t count, const double *rho, const double *u, double *off)
{
    double worst = 0, most = 0;
    if (J->U) rg_freedom_move(J->freedom, u, J->X);
    for (int32_t n = 0; n < count; n++) {
        const int32_t k = vertex ? vertex[n] : n;
        if (J->U) rg_mesh_sectors_at(J->mesh, k, J->X, J->theta);
        const double angle = assemble_vertex(J, k, rho);
        if (!(angle <= worst)) worst = angle;
        if (J->kawasaki[k] < 0) continue;
        double *sum = &J->r[J->kawasaki[k]];
        rg_coupled_alternate(J, k, sum, NULL);
        if (!(fabs(*sum) <= most)) most = fabs(*sum);
    }
    if (off) *off = most;
    return worst;
}

double rg_coupled_assemble(rg_coupled *J, const double *rho, const double *u, double *off)
{
    return rg_coupled_assemble_some(J, NULL, J->M, rho, u, off);
}

void rg_coupled_turn(const rg_coupled *J, int32_t k, int32_t j, rg_vec2 *g, rg_vec3 *normal)
{
    const int32_t first = J->mesh->loop_start[k], last = J->mesh->loop_start[k + 1];
    const rg_vec2 d = rg_vec2_sub(J->X[J->far[j]], J->X[J->mesh->inner_vertex[k]]);
    const double squared = rg_vec2_dot(d, d);
    *g = (rg_vec2){-d.y / squared, d.x / squared};
    /* Turning this direction takes from the sector behind it what it gives to the one before. */
    *normal = rg_vec3_sub(J->normal[j > first ? j - 1 : last - 1], J->normal[j]);
}

/* The direction of loop entry j turns by g . (dX of its far end - dX of the vertex): adds what that does to the rows. */
static void add_turn(rg_coupled *J, const int32_t at[2], const int32_t way[2], rg_vec2 g, rg_vec3 normal, double sign,
                     const double *scale)
{
    for (int i = 0; i < 2; i++) {
        if (at[i] < 0) continue;
        const double turn = scale[J->N + way[i]] * rg_vec2_dot(g, J->freedom->direction[way[i]]);
        double *x = J->A.x + at[i];
        x[0] += turn * normal.x, x[1] += turn * normal.y, x[2] += turn * normal.z;
        if (sign != 0) x[3] += turn * sign; /* eq. (17) */
    }
}

void rg_coupled_renew(rg_coupled *J, const double *scale)
{
    const rg_mesh *m = J->mesh;
    memset(J->A.x, 0, (size_t)J->A.start[J->A.columns] * sizeof *J->A.x);
    for (int32_t k = 0; k < J->M; k++) {
        const int32_t first = m->loop_start[k], last = m->loop_start[k + 1], v = m->inner_vertex[k];
        for (int32_t j = first; j < last; j++) {
            const int32_t i = m->loop_crease[j];
            const double of = m->still && m->still[m->crease_edge[i]] ? 0 : scale[i];
            double *x = J->A.x + J->at[j];
            x[0] = of * J->direction[j].x, x[1] = of * J->direction[j].y, x[2] = of * J->direction[j].z;
        }
        if (!J->U) continue;
        const int kept = J->kawasaki[k] >= 0;
        double sum;
        if (kept) rg_coupled_alternate(J, k, &sum, J->sign);
        for (int32_t j = first; j < last; j++) {
            rg_vec2 g;
            rg_vec3 normal;
            rg_coupled_turn(J, k, j, &g, &normal);
            const double part = kept ? J->sign[j - first] : 0;
            add_turn(J, J->at_far[j], J->freedom->way[J->far[j]], g, normal, part, scale);
            add_turn(J, J->at_own[k], J->freedom->way[v], (rg_vec2){-g.x, -g.y}, normal, part, scale);
        }
    }
    rg_least_renew(&J->A);
}
