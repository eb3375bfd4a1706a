/* unfold/: derivatives by differences, multipliers by trying all sets of active rows, distances by sampling; and motions without
 * contact, looked at by a test of segments against triangles of its own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "corpus.h"
#include "near.h"

#include "counted.h"
#include "unfold/unfold.h"

static void mesh_of(const char *path, rg_mesh *m)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_pattern *p = NULL;
    rg_diag why;
    assert_int_equal(rg_pattern_read(path, NULL, &p, &why), RG_OK);
    assert_int_equal(rg_mesh_from_pattern(p, &mem, m, &why), RG_OK);
    rg_pattern_destroy(p);
}

/* ------------------------------------------------------------------------------------------------------ linkage ---- */

/* Velocities against central differences, at a state that need not close. */
static void derivatives(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh none, m;
    rg_linkage P;
    unsigned seed = 5;
    mesh_of("patterns/frog.opx", &none);
    assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
    assert_int_equal(rg_linkage_init(&P, &mem, &m), RG_OK);
    double *z = calloc((size_t)P.n, sizeof *z), *dz = calloc((size_t)P.n, sizeof *dz);
    rg_vec3 *x = calloc((size_t)m.nv, sizeof *x), *y = calloc((size_t)m.nv, sizeof *y), *dp = calloc((size_t)m.nv, sizeof *dp);
    assert_true(z && dz && x && y && dp);
    for (int32_t i = 0; i < P.n; i++) {
        z[i] = (i < P.N ? 1.5 : 0.02 * m.size) * noise(&seed);
        dz[i] = noise(&seed) * (i < P.N ? 1 : m.size);
    }
    const rg_vec3 c = {0.3, -0.7, 1.1};
    rg_linkage_put(&P, z);
    rg_linkage_velocity(&P, dz, dp);
    for (int32_t v = 0; v < m.nv; v++) {
        double along = 0;
        for (int32_t i = 0; i < P.n; i++) {
            const double h = i < P.N ? 1e-5 : 1e-6 * m.size, was = z[i];
            z[i] = was + h;
            rg_linkage_positions(&P, z, x);
            z[i] = was - h;
            rg_linkage_positions(&P, z, y);
            z[i] = was;
            const double slope = rg_vec3_dot(c, rg_vec3_sub(x[v], y[v])) / (2 * h);
            along += slope * dz[i];
        }
        near(rg_vec3_dot(c, dp[v]), along, 1e-5 * m.size);
    }
    free(z), free(dz), free(x), free(y), free(dp);
    rg_linkage_free(&P);
    rg_mesh_free(&m);
    rg_mesh_free(&none);
}

/* ----------------------------------------------------------------------------------------------------- interior ---- */

enum { ROWS = 6, WAYS = 5, ALL = WAYS + 1 + ROWS };

/* A x = b by Gauss, with pivots. Zero: singular. */
static int solve(int n, double A[ALL][ALL], double *b)
{
    for (int i = 0; i < n; i++) {
        int p = i;
        for (int k = i + 1; k < n; k++)
            if (fabs(A[k][i]) > fabs(A[p][i])) p = k;
        if (fabs(A[p][i]) < 1e-13) return 0;
        for (int j = 0; j < n; j++) {
            const double was = A[i][j];
            A[i][j] = A[p][j], A[p][j] = was;
        }
        const double was = b[i];
        b[i] = b[p], b[p] = was;
        for (int k = i + 1; k < n; k++) {
            const double f = A[k][i] / A[i][i];
            for (int j = i; j < n; j++) A[k][j] -= f * A[i][j];
            b[k] -= f * b[i];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) b[i] -= A[i][j] * b[j];
        b[i] /= A[i][i];
    }
    return 1;
}

typedef struct program {
    double J[WAYS][WAYS], E[WAYS], g[WAYS], R[ROWS][WAYS], c[ROWS], d[ROWS];
} program;

/* The one set of active rows whose multipliers are positive and whose other rows are kept: v. */
static int by_trying(const program *p, double *v)
{
    for (int set = 0; set < 1 << ROWS; set++) {
        double A[ALL][ALL] = {{0}}, b[ALL] = {0};
        int at[ROWS], m = 0, right = 1;
        for (int i = 0; i < ROWS; i++)
            if (set >> i & 1) at[m++] = i;
        for (int j = 0; j < WAYS; j++) {
            A[j][j] = p->g[j];
            for (int k = 0; k < WAYS; k++)
                for (int i = 0; i < WAYS; i++) A[j][k] += p->J[i][j] * p->J[i][k];
            A[j][WAYS] = A[WAYS][j] = p->E[j];
            for (int i = 0; i < m; i++) A[j][WAYS + 1 + i] = A[WAYS + 1 + i][j] = p->R[at[i]][j];
        }
        for (int i = 0; i < m; i++) A[WAYS + 1 + i][WAYS + 1 + i] = -p->c[at[i]], b[WAYS + 1 + i] = p->d[at[i]];
        if (!solve(WAYS + 1 + m, A, b)) continue;
        for (int i = 0; i < m; i++) right &= b[WAYS + 1 + i] <= 0; /* the multiplier, its sign turned */
        for (int i = 0; i < ROWS; i++) {
            double kept = -p->d[i];
            for (int j = 0; j < WAYS; j++) kept += p->R[i][j] * b[j];
            right &= set >> i & 1 || kept >= -1e-9;
        }
        if (!right) continue;
        memcpy(v, b, WAYS * sizeof *v);
        return 1;
    }
    return 0;
}

/* Against all sets of active rows; copies of rows among them. A row taken many times, each as many times as
 * compliant, is the same row. */
static void multipliers(void **state)
{
    (void)state;
    const int32_t col[] = {0, 1, 2, 3, 4};
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 11;
    for (int trial = 0; trial < 120; trial++) {
        program p;
        rg_interior q;
        double best[WAYS];
        const int times = trial % 2 ? 7 : 1;
        for (int i = 0; i < WAYS; i++) {
            for (int j = 0; j < WAYS; j++) p.J[i][j] = noise(&seed);
            p.E[i] = noise(&seed);
            p.g[i] = 1.5 + noise(&seed);
        }
        for (int i = 0; i < ROWS; i++) {
            const int copy = trial % 3 == 0 && i == ROWS - 1;
            for (int j = 0; j < WAYS; j++) p.R[i][j] = copy ? p.R[0][j] : noise(&seed);
            p.d[i] = copy ? p.d[0] : noise(&seed);
            p.c[i] = 1e-6 * (1.5 + noise(&seed));
        }
        assert_true(by_trying(&p, best));
        assert_int_equal(rg_interior_init(&q, &mem, WAYS), RG_OK);
        assert_int_equal(rg_interior_reserve(&q, ROWS * times), RG_OK);
        memcpy(q.g, p.g, sizeof p.g);
        for (int i = 0; i < WAYS; i++) assert_int_equal(rg_rows_add(&q.J, WAYS, col, p.J[i]), RG_OK);
        assert_int_equal(rg_rows_add(&q.E, WAYS, col, p.E), RG_OK);
        for (int i = 0; i < ROWS; i++) {
            assert_int_equal(rg_rows_add(&q.R, WAYS, col, p.R[i]), RG_OK);
            for (int k = 0; k < times; k++) {
                const int at = i * times + k;
                q.of[at] = i, q.c[at] = p.c[i] * times, q.d[at] = p.d[i];
            }
        }
        assert_int_equal(rg_interior_solve(&q, ROWS * times), RG_OK);
        for (int j = 0; j < WAYS; j++) near(q.v[j], best[j], 1e-5 * (1 + fabs(best[j])));
        for (int i = 0; i < ROWS * times; i++) assert_true(q.x[i] >= 0);
        rg_interior_free(&q);
    }
}

/* A program too large to try: what makes a solution one is looked at instead, in numbers of its own. */
static void many_rows(void **state)
{
    (void)state;
    enum { N = 90, M = 400 };
    const rg_memory mem = rg_mem_default(NULL);
    rg_interior q;
    unsigned seed = 17;
    assert_int_equal(rg_interior_init(&q, &mem, N), RG_OK);
    assert_int_equal(rg_interior_reserve(&q, M), RG_OK);
    for (int round = 0; round < 4; round++) {
        double (*G)[N] = calloc(N, sizeof *G), (*E)[N] = calloc(N, sizeof *E), off[N] = {0};
        assert_true(G && E);
        rg_interior_clear(&q);
        for (int32_t j = 0; j < N; j++) {
            const int32_t fold[] = {j, (j + 1) % N, (j + 5) % N}, rigid[] = {j, (j + 1) % N};
            const double a[] = {noise(&seed), noise(&seed), noise(&seed)}, e[] = {1.5 + noise(&seed), noise(&seed)};
            G[j][j] += q.g[j] = j % 3 ? 1 : 0.2;
            assert_int_equal(rg_rows_add(&q.J, 3, fold, a), RG_OK);
            if (j % 3 == 0) assert_int_equal(rg_rows_add(&q.E, 2, rigid, e), RG_OK);
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++) G[fold[i]][fold[k]] += a[i] * a[k];
        }
        const int32_t some = round % 2 ? M : 16; /* these are solved by rows */
        for (int32_t i = 0; i < some; i++) {
            const int32_t at = (i * 37 + round * 11) % N, touched[] = {at, (at + 2) % N, (at + 40 + i % (3 + round)) % N};
            const double a[] = {noise(&seed), noise(&seed), noise(&seed)};
            if (i % 2 == 0) assert_int_equal(rg_rows_add(&q.R, 3, touched, a), RG_OK);
            q.of[i] = i / 2;
            q.c[i] = i % 2 ? 1e-2 : 1e-9;
            q.d[i] = 0.1 * noise(&seed) - (i % 2 ? 0 : 0.2);
        }
        const int64_t before = q.many.analyses;
        assert_int_equal(rg_interior_solve(&q, some), RG_OK);
        if (round < 2) assert_int_equal(q.many.analyses - before, round);
        for (int32_t i = 0; i < N; i++)
            for (int32_t k = 0; k < N; k++) off[i] += G[i][k] * q.v[k];
        for (int32_t i = 0; i < q.E.count; i++) {
            near(rg_rows_dot(&q.E, i, q.v), 0, 1e-8);
            for (int32_t j = 0; j < N; j++) E[i][j] = 0;
            rg_rows_gather(&q.E, i, 1, E[i]);
        }
        for (int32_t i = 0; i < some; i++) {
            const double kept = rg_rows_dot(&q.R, q.of[i], q.v) + q.c[i] * q.x[i] - q.d[i];
            assert_true(q.x[i] >= 0 && kept >= -1e-7);
            near(fmin(q.x[i], kept), 0, 1e-4);
            rg_rows_gather(&q.R, q.of[i], -q.x[i], off);
        }
        for (int32_t i = 0; i < q.E.count; i++) /* no force but along rows of E: off less its part along them, Gram and Schmidt */
            for (int32_t k = 0; k <= q.E.count; k++) {
                double *of = i < k ? (k < q.E.count ? E[k] : off) : NULL, part = 0, whole = 0;
                for (int32_t j = 0; of && j < N; j++) part += of[j] * E[i][j], whole += E[i][j] * E[i][j];
                for (int32_t j = 0; of && j < N; j++) of[j] -= part / whole * E[i][j];
            }
        for (int32_t i = 0; i < N; i++) near(off[i], 0, 1e-6);
        free(G), free(E);
    }
    assert_true(q.many.analyses >= 1 && q.many.analyses <= 4);
    rg_interior_free(&q);
}

/* A program of M rows that comes again: whatever has been as large asks for no memory, and the same numbers give the same bits. */
static void again(void **state)
{
    (void)state;
    enum { N = 60, M = 300 };
    counted c = {.left = 1L << 30};
    const rg_memory mem = {counted_resize, &c};
    rg_interior q;
    double first[N];
    long asked = 0;
    assert_int_equal(rg_interior_init(&q, &mem, N), RG_OK);
    for (int round = 0; round < 4; round++) {
        unsigned seed = 31;
        if (round == 1) asked = c.asked;
        rg_interior_clear(&q);
        for (int32_t j = 0; j < N; j++) {
            const int32_t fold[] = {j, (j + 1) % N, (j + 7) % N};
            const double a[] = {noise(&seed), noise(&seed), noise(&seed)};
            q.g[j] = 0.5;
            assert_int_equal(rg_rows_add(&q.J, 3, fold, a), RG_OK);
            if (j % 4 == 0) assert_int_equal(rg_rows_add(&q.E, 2, fold, a), RG_OK);
        }
        assert_int_equal(rg_interior_reserve(&q, M), RG_OK);
        for (int32_t i = 0; i < M; i++) {
            const int32_t col[] = {i % N, (i * 7 + 3) % N == i % N ? (i + 1) % N : (i * 7 + 3) % N};
            const double a[] = {noise(&seed), noise(&seed)};
            assert_int_equal(rg_rows_add(&q.R, 2, col, a), RG_OK);
            q.of[i] = i, q.c[i] = 1e-6, q.d[i] = 0.1 * noise(&seed);
        }
        assert_int_equal(rg_interior_solve(&q, round % 2 ? 10 : M), RG_OK); /* by ways, by rows, by ways ... */
        if (round == 0) memcpy(first, q.v, sizeof first);
        if (round == 1) asked = c.asked;
        if (round == 2) q.largest = 0;
    }
    assert_int_equal(c.asked, asked);
    q.largest = 0;
    assert_int_equal(rg_interior_solve(&q, M), RG_OK);
    assert_memory_equal(first, q.v, sizeof first);
    rg_interior_free(&q);
    assert_int_equal(c.out, 0);
}

/* The places of a closed sheet and its fold angles move alike: what creases turn by, and that edges keep their length. */
static void places(void **state)
{
    (void)state;
    const char *file[] = {"patterns/frog.opx", "patterns/crane.opx", "patterns/boxpleat.opx"};
    const rg_memory mem = rg_mem_default(NULL);
    unsigned seed = 23;
    for (int k = 0; k < 3; k++)
        for (int flat = 0; flat < 2; flat++) {
            rg_mesh none, m;
            rg_linkage P;
            rg_nearest q;
            rg_rows fold, rigid;
            mesh_of(file[k], &none);
            assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
            for (int32_t v = 0; v < m.nv; v++) m.X[v] = (rg_vec2){m.X[v].x / none.size, m.X[v].y / none.size};
            assert_int_equal(rg_linkage_init(&P, &mem, &m), RG_OK);
            assert_int_equal(rg_nearest_init(&q, &mem, &P), RG_OK);
            rg_stride_scale(&P, 0.7, q.scale);
            double *z = calloc((size_t)P.n, sizeof *z), *v = calloc((size_t)rg_places_count(&P), sizeof *v);
            assert_true(z && v);
            for (int32_t i = 0; i < P.N; i++) z[i] = flat ? 0 : 0.3 * noise(&seed);
            assert_true(rg_stride_close(&P, &q, z, 1e-12, 40));
            rg_coupled_assemble(&P.J, z, z + P.N, NULL);
            rg_coupled_renew(&P.J, q.scale);
            rg_linkage_put(&P, z);
            for (int32_t i = 0; i < P.n; i++) q.wish[i] = noise(&seed) * q.scale[i];
            rg_nearest_project(&q, q.wish, P.K.r);
            assert_int_equal(rg_rows_init(&fold, &mem), RG_OK);
            assert_int_equal(rg_rows_init(&rigid, &mem), RG_OK);
            assert_int_equal(rg_places_rows(&P, q.scale, &fold, &rigid), RG_OK);
            for (int32_t p = 0; p < m.nv; p++) v[3 * p] = q.dp[p].x, v[3 * p + 1] = q.dp[p].y, v[3 * p + 2] = q.dp[p].z;
            for (int32_t i = 0; i < P.U; i++) v[3 * m.nv + i] = q.dz[P.N + i] / q.scale[P.N + i];
            double most = 0;
            for (int32_t i = 0; i < P.N; i++) {
                near(rg_rows_dot(&fold, i, v), q.dz[i] / q.scale[i], 1e-8);
                most = fmax(most, fabs(q.dz[i]));
            }
            assert_true(most > 0.1); /* it does move */
            for (int32_t i = 0; i < rigid.count; i++) near(rg_rows_dot(&rigid, i, v), 0, 1e-8);
            free(z), free(v);
            rg_rows_free(&fold);
            rg_rows_free(&rigid);
            rg_nearest_free(&q);
            rg_linkage_free(&P);
            rg_mesh_free(&m);
            rg_mesh_free(&none);
        }
}

/* ---------------------------------------------------------------------------------------------------- proximity ---- */

/* No sampled point of the two parts is nearer than the distance told, and one is hardly farther. */
static void distances(void **state)
{
    (void)state;
    enum { FINE = 60 };
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh none, m;
    rg_proximity n;
    rg_close_pair at;
    unsigned seed = 3;
    mesh_of("patterns/waterbomb-base.opx", &none);
    assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
    assert_int_equal(rg_proximity_init(&n, &mem, &m), RG_OK);
    rg_vec3 *p = calloc((size_t)m.nv, sizeof *p);
    for (int32_t v = 0; v < m.nv; v++) p[v] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
    for (int32_t v = 0; v < m.nv; v++)
        for (int32_t f = 0; f < m.nf; f++) {
            const int32_t *c = m.facet_vertex + m.facet_start[f];
            double least = INFINITY;
            for (int i = 0; i <= FINE; i++)
                for (int j = 0; i + j <= FINE; j++) {
                    const double a = (double)i / FINE, b = (double)j / FINE;
                    const rg_vec3 x = rg_vec3_axpy(a, p[c[0]], rg_vec3_axpy(b, p[c[1]], rg_vec3_scale(1 - a - b, p[c[2]])));
                    least = fmin(least, rg_vec3_length(rg_vec3_sub(x, p[v])));
                }
            const double d = rg_proximity_distance(&n, 0, v, f, p, &at);
            assert_true(d <= least + 1e-12);
            near(d, least, 0.05);
        }
    for (int32_t e = 0; e < m.ne; e++)
        for (int32_t f = 0; f < e; f++) {
            double least = INFINITY;
            for (int i = 0; i <= FINE; i++)
                for (int j = 0; j <= FINE; j++) {
                    const double s = (double)i / FINE, t = (double)j / FINE;
                    const rg_vec3 x = rg_vec3_axpy(s, p[m.edge[e][1]], rg_vec3_scale(1 - s, p[m.edge[e][0]]));
                    const rg_vec3 y = rg_vec3_axpy(t, p[m.edge[f][1]], rg_vec3_scale(1 - t, p[m.edge[f][0]]));
                    least = fmin(least, rg_vec3_length(rg_vec3_sub(x, y)));
                }
            const double d = rg_proximity_distance(&n, 1, e, f, p, &at);
            assert_true(d <= least + 1e-12);
            near(d, least, 0.05);
        }
    free(p);
    rg_proximity_free(&n);
    rg_mesh_free(&m);
    rg_mesh_free(&none);
}

/* A corner that goes through a triangle is met; one that stays on its side is not. */
/* What the tree finds is what all pairs of features give, each once, on straight ways too. */
static void all_near(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh none, m;
    rg_proximity n;
    unsigned seed = 37;
    mesh_of("patterns/frog.opx", &none);
    assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
    assert_int_equal(rg_proximity_init(&n, &mem, &m), RG_OK);
    rg_vec3 *p = calloc((size_t)m.nv, sizeof *p), *q = calloc((size_t)m.nv, sizeof *q), *x = calloc((size_t)m.nv, sizeof *x);
    assert_true(p && q && x);
    for (int trial = 0; trial < 5; trial++) {
        const double reach = 0.4 * m.size;
        int32_t found = 0;
        for (int32_t v = 0; v < m.nv; v++) {
            p[v] = (rg_vec3){m.X[v].x, m.X[v].y, 0.1 * m.size * noise(&seed)};
            q[v] = (rg_vec3){m.X[v].x, m.X[v].y, 0.1 * m.size * noise(&seed)};
        }
        assert_int_equal(rg_proximity_find(&n, p, reach, 0), RG_OK);
        double most = 1;
        for (int kind = 0; kind < 2; kind++)
            for (int32_t i = 0; i < (kind ? m.ne : m.nv); i++)
                for (int32_t j = 0; j < (kind ? i : m.nf); j++) {
                    rg_close_pair at, then;
                    const size_t flag = (size_t)i * (size_t)(kind ? m.ne : m.nf) + (size_t)j;
                    if ((kind ? n.edge : n.corner)[flag] & RG_PROXIMITY_APART) continue;
                    const double d = rg_proximity_distance(&n, kind, i, j, p, &at);
                    for (int step = 1; step <= 20; step++) { /* on the way */
                        for (int k = 0; k < 4; k++) x[at.v[k]] = rg_vec3_axpy(step / 20.0, rg_vec3_sub(q[at.v[k]], p[at.v[k]]), p[at.v[k]]);
                        if (rg_proximity_distance(&n, kind, i, j, x, &then) < 0.1 * d) most = fmin(most, step / 20.0);
                    }
                    if (!(d < reach) || (kind && !(at.weight[0] > 0 && at.weight[1] > 0 && at.weight[2] < 0 && at.weight[3] < 0))) continue;
                    int times = 0;
                    for (int32_t k = 0; k < n.count; k++)
                        times += n.pair[k].kind == kind && n.pair[k].i == i && n.pair[k].j == j && n.pair[k].d == d;
                    assert_int_equal(times, 1);
                    found++;
                }
        assert_int_equal(found, n.count);
        assert_true(found > 20);
        assert_true(rg_proximity_meet(&n, p, q, 0.1) <= most);
    }
    free(p), free(q), free(x);
    rg_proximity_free(&n);
    rg_mesh_free(&m);
    rg_mesh_free(&none);
}

static void meetings(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh none, m;
    rg_proximity n;
    rg_linkage P;
    mesh_of("patterns/preliminary.opx", &none);
    assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
    assert_int_equal(rg_proximity_init(&n, &mem, &m), RG_OK);
    assert_int_equal(rg_linkage_init(&P, &mem, &m), RG_OK);
    double *z = calloc((size_t)P.n, sizeof *z);
    rg_vec3 *q = calloc((size_t)m.nv, sizeof *q);
    rg_linkage_put(&P, z);
    int32_t v = 0, f = 0;
    while (n.corner[(size_t)v * (size_t)m.nf + (size_t)f]) f++; /* a corner and a facet it is not part of */
    const int32_t *c = m.facet_vertex + m.facet_start[f];
    const rg_vec3 middle = rg_vec3_scale(1 / 3.0, rg_vec3_add(P.p[c[0]], rg_vec3_add(P.p[c[1]], P.p[c[2]])));
    P.p[v] = rg_vec3_add(middle, (rg_vec3){0, 0, 0.1});
    memcpy(q, P.p, (size_t)m.nv * sizeof *q);
    q[v].z = -0.1;
    const double part = rg_proximity_meet(&n, P.p, q, 0.1);
    below(part, 0.5); /* it would be in the facet half way */
    assert_true(part > 0);
    q[v].z = 0.05;
    near(rg_proximity_meet(&n, P.p, q, 0.1), 1, 0);
    free(z), free(q);
    rg_linkage_free(&P);
    rg_proximity_free(&n);
    rg_mesh_free(&m);
    rg_mesh_free(&none);
}

/* ------------------------------------------------------------------------------------------------------- unfold ---- */

/* Deeper than that an edge goes through a facet that it has no corner in common with (of the sheet): as far as it would have to be
 * moved, along the normal or past one of the facet's edges, until they only touch. */
static const double DEEP = 1e-4;

static int pierces(const rg_mesh *m, const rg_vec3 *x, double deep)
{
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t *c = m->facet_vertex + m->facet_start[f];
        const rg_vec3 a = x[c[0]], b = x[c[1]], d = x[c[2]], across = rg_vec3_cross(rg_vec3_sub(b, a), rg_vec3_sub(d, a));
        const rg_vec3 n = rg_vec3_scale(1 / rg_vec3_length(across), across);
        for (int32_t e = 0; e < m->ne; e++) {
            const int32_t i = m->edge[e][0], j = m->edge[e][1];
            int joined = 0;
            for (int k = 0; k < 3; k++) joined |= c[k] == i || c[k] == j;
            const double p = rg_vec3_dot(n, rg_vec3_sub(x[i], a)), q = rg_vec3_dot(n, rg_vec3_sub(x[j], a));
            if (joined || !(p * q < 0) || fabs(p) < deep || fabs(q) < deep) continue;
            const rg_vec3 at = rg_vec3_axpy(p / (p - q), rg_vec3_sub(x[j], x[i]), x[i]);
            int in = 1;
            for (int k = 0; k < 3; k++) {
                const rg_vec3 from = x[c[k]], edge = rg_vec3_sub(x[c[(k + 1) % 3]], from), to = rg_vec3_sub(at, from);
                const rg_vec3 past = rg_vec3_cross(edge, rg_vec3_sub(x[j], x[i])); /* square to both */
                in &= rg_vec3_dot(rg_vec3_cross(n, edge), to) > 0 && fabs(rg_vec3_dot(past, to)) > deep * rg_vec3_length(past);
            }
            if (in) return 1;
        }
    }
    return 0;
}

/* over: radians that a crease may be past half a turn; deep: of the sheet, that counts as a crossing. */
static void unfolds_mesh(const rg_mesh *none, double sign, double over, double deep)
{
    const rg_memory mem = rg_mem_default(NULL);
    const rg_unfold_wish wish = {sign, -1, 0, 5e10, NULL, NULL, NULL};
    rg_unfold u;
    assert_int_equal(rg_unfold_run(&u, &mem, none, &wish), RG_OK);
    assert_int_equal(u.outcome, RG_UNFOLD_FREE);
    below(0.99, u.pass.landed);
    for (int32_t k = 1; k < u.pass.track.count; k++) below(u.pass.track.progress[k - 1], u.pass.track.progress[k]);
    double *rho = calloc((size_t)u.pass.P.N, sizeof *rho);
    rg_vec2 *X = calloc((size_t)u.pass.mesh.nv, sizeof *X);
    rg_place *place = calloc((size_t)u.pass.mesh.nf, sizeof *place);
    rg_vec3 *x = calloc((size_t)u.pass.mesh.nv, sizeof *x);
    rg_tree tree;
    assert_int_equal(rg_tree_init(&u.pass.mesh, 0, &tree), RG_OK);
    for (int k = 0; k <= 150; k++) {
        double sum = 0;
        int n = 0;
        rg_unfold_read(&u, k / 150.0, rho, X);
        for (int32_t i = 0; i < u.pass.P.N - u.pass.mesh.added; i++) {
            const double target = u.pass.mesh.target[u.pass.mesh.crease_edge[i]];
            if (isnan(target) || target == 0) continue;
            sum += rho[i] / (sign * target);
            n++;
            below(fabs(rho[i]), RG_PI + over);
        }
        near(sum / n, k / 150.0, 1e-3);
        rg_pose_facets(&u.pass.mesh, X, &tree, rho, place);
        rg_pose_vertices(&u.pass.mesh, X, &tree, place, x);
        below(rg_pose_gap(X, &tree, place), 1e-9 * none->size);
        for (int32_t v = 0; v < u.pass.mesh.nv; v++) x[v] = rg_vec3_scale(1 / none->size, x[v]);
        assert_false(pierces(&u.pass.mesh, x, deep));
    }
    for (int32_t v = 0; v < u.pass.mesh.nv; v++) { /* the end is of the pattern given */
        near(X[v].x, u.pass.mesh.X[v].x * none->size, 1e-12 * none->size);
        near(X[v].y, u.pass.mesh.X[v].y * none->size, 1e-12 * none->size);
    }
    free(rho), free(X), free(place), free(x);
    rg_tree_free(&tree);
    rg_unfold_free(&u);
}

static void unfolds(const char *path, double sign, double over, double deep)
{
    rg_mesh none;
    mesh_of(path, &none);
    unfolds_mesh(&none, sign, over, deep);
    rg_mesh_free(&none);
}

/* Creases of grids, each vertex of which folds flat: 1 border, 2 mountain, 3 valley, and two ends. Of many orders none that is begun
 * from is the one that a motion comes to. */
static void lands_as_it_shows(void **state)
{
    (void)state;
    static const char *const creases[] = {
        "1 0 0 3 0\n1 0 3 3 3\n1 0 0 0 3\n1 3 0 3 3\n3 0 0 1 1\n2 0 1 1 1\n2 0 2 1 2\n3 1 0 1 1\n2 1 1 1 2\n3 1 1 2 1\n3 1 1 2 2\n"
        "3 1 2 1 3\n2 1 2 2 2\n3 2 0 2 1\n2 2 1 2 2\n3 2 1 3 1\n2 2 2 2 3\n3 2 2 3 1\n2 2 2 3 2\n",
        "1 0 0 4 0\n1 0 4 4 4\n1 0 0 0 4\n1 4 0 4 4\n2 0 2 1 1\n3 0 2 1 3\n2 0 3 1 3\n2 1 0 1 1\n2 1 1 2 1\n3 1 1 2 2\n2 1 3 1 4\n"
        "2 1 3 2 2\n2 2 0 2 1\n2 2 1 2 2\n3 2 1 3 1\n2 2 2 3 2\n2 2 4 3 3\n3 3 0 3 1\n3 3 1 3 2\n2 3 1 4 1\n2 3 2 3 3\n2 3 2 4 2\n"
        "3 3 3 4 3\n2 3 3 4 4\n"
    };
    for (int k = 0; k < 2; k++) {
        rg_pattern *p = NULL;
        rg_mesh none;
        rg_diag why;
        const rg_memory mem = rg_mem_default(NULL);
        assert_int_equal(rg_pattern_parse(creases[k], strlen(creases[k]), NULL, &p, &why), RG_OK);
        assert_int_equal(rg_mesh_from_pattern(p, &mem, &none, &why), RG_OK);
        rg_pattern_destroy(p);
        unfolds_mesh(&none, 1, 1.1e-4, RG_CONTACT_TOLERANCE);
        rg_mesh_free(&none);
    }
}

static void free_motions(void **state)
{
    (void)state;
    static const char *const files[] = {"bird", "fish", "preliminary", "waterbomb-base", "tatou", "open-sink", "frog"};
    for (int k = 0; k < 7; k++) {
        char path[64];
        snprintf(path, sizeof path, "patterns/%s.opx", files[k]);
        unfolds(path, 1, 1e-6, DEEP);
    }
    unfolds("patterns/bird.opx", -1, 1e-6, DEEP);
}

/* Many of its creases cannot open to first order. */
static void locked_end(void **state)
{
    (void)state;
    char path[512];
    unfolds(corpus("foldability/114-brown-4x4-a92.fold", path, sizeof path), 1, 1.1e-4, RG_CONTACT_TOLERANCE);
}

/* Layers that slide on each other while they turn: the crane of this project. */
static void crane(void **state)
{
    (void)state;
    unfolds("patterns/crane.opx", 1, 1.1e-4, RG_CONTACT_TOLERANCE);
}

/* The rows by which facets stay as large as they have to: by differences of the area, and kept where the wish would break them. */
static void small_facets(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh none, m;
    rg_linkage P;
    rg_nearest q;
    mesh_of("patterns/frog.opx", &none);
    assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
    for (int32_t v = 0; v < m.nv; v++) m.X[v] = (rg_vec2){m.X[v].x / m.size, m.X[v].y / m.size};
    m.size = 1;
    assert_int_equal(rg_linkage_init(&P, &mem, &m), RG_OK);
    assert_int_equal(rg_nearest_init(&q, &mem, &P), RG_OK);
    double *z = calloc((size_t)P.n, sizeof *z), *wish = calloc((size_t)P.n, sizeof *wish);
    rg_vec2 *X = calloc((size_t)m.nv, sizeof *X);
    assert_true(z && wish && X);
    rg_stride_scale(&P, 1, q.scale);
    rg_coupled_assemble(&P.J, z, z + P.N, NULL);
    rg_coupled_renew(&P.J, q.scale);
    rg_linkage_put(&P, z);
    rg_nearest_clear(&q);
    int32_t rows = 0;
    for (int32_t f = 0; f < m.nf; f++) {
        rg_row *row = rg_nearest_add(&q, 0, NULL, NULL, (rg_vec3){0, 0, 0});
        assert_non_null(row);
        near(rg_linkage_area(&P, f, P.X), 1, 1e-12);
        rg_stride_area(&P, f, row);
        assert_int_equal(row->facet, f);
        row->b = -0.02;
        for (int32_t i = 0; i < row->terms; i++) {
            const double h = 1e-6;
            z[P.N + row->v[i]] = h;
            rg_freedom_move(&P.freedom, z + P.N, X);
            const double more = rg_linkage_area(&P, f, X);
            z[P.N + row->v[i]] = -h;
            rg_freedom_move(&P.freedom, z + P.N, X);
            near(row->weight[i], (more - rg_linkage_area(&P, f, X)) / (2 * h), 1e-6);
            z[P.N + row->v[i]] = 0;
            if (f % 3 == 0) wish[P.N + row->v[i]] -= 0.1 * row->weight[i];
        }
        rows += row->terms > 0;
    }
    assert_true(rows > 0);
    rg_nearest_project(&q, wish, P.K.r);
    double least = 0;
    for (int32_t k = 0; k < q.count; k++) least = fmin(least, rg_nearest_value(&q, &q.row[k]));
    below(least, -0.1); /* the wish alone breaks them */
    assert_int_equal(rg_nearest_solve(&q, wish, P.K.r, 1), RG_OK);
    for (int32_t k = 0; k < q.count; k++) below(-0.0201, rg_nearest_value(&q, &q.row[k]));
    /* Rows that wait until they are broken, and are remembered: the same step; and those that push are the ones that are remembered. */
    double *step = calloc((size_t)P.n, sizeof *step);
    unsigned char *pushed = calloc((size_t)q.count, 1);
    assert_true(step && pushed);
    memcpy(step, q.dz, (size_t)P.n * sizeof *step);
    for (int32_t k = 0; k < q.count; k++) q.row[k].pushed = &pushed[k], q.row[k].pushed_by = k % 2 ? 4 : 0; /* 0: never remembered */
    q.all = 1;
    for (int round = 0; round < 2; round++) {
        int remembered = 0;
        assert_int_equal(rg_nearest_solve(&q, wish, P.K.r, 1), RG_OK);
        for (int32_t i = 0; i < P.n; i++) near(q.dz[i], step[i], 1e-6);
        for (int32_t k = 0; k < q.count; k++) {
            if (pushed[k]) near(rg_nearest_value(&q, &q.row[k]), -0.02, 1e-4);
            assert_true(pushed[k] == 0 || (k % 2 && pushed[k] == 4));
            remembered += pushed[k] != 0;
        }
        assert_true(remembered > 0);
    }
    free(step), free(pushed);
    free(z), free(wish), free(X);
    rg_nearest_free(&q);
    rg_linkage_free(&P);
    rg_mesh_free(&m);
    rg_mesh_free(&none);
}

/* What crosses gets a row that is as far off as it crosses deep, and whose parts are glued. */
static void crossed_rows(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_mesh none, m;
    rg_linkage P;
    rg_proximity near_;
    rg_nearest q;
    rg_plates plates;
    rg_contact_work look;
    mesh_of("patterns/frog.opx", &none);
    assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
    for (int32_t v = 0; v < m.nv; v++) m.X[v] = (rg_vec2){m.X[v].x / m.size, m.X[v].y / m.size};
    m.size = 1;
    assert_int_equal(rg_linkage_init(&P, &mem, &m), RG_OK);
    assert_int_equal(rg_proximity_init(&near_, &mem, &m), RG_OK);
    assert_int_equal(rg_nearest_init(&q, &mem, &P), RG_OK);
    assert_int_equal(rg_plates_init(&m, &plates), RG_OK);
    assert_int_equal(rg_contact_work_init(&plates, &look), RG_OK);
    rg_crossed *c = calloc(1, sizeof *c);
    double *z = calloc((size_t)P.n, sizeof *z);
    assert_true(c && z);
    c->plates = &plates, c->look = &look;
    rg_linkage_put(&P, z);
    rg_nearest_clear(&q);
    assert_int_equal(rg_crossed_add(c, &P, &near_, &q), RG_OK);
    assert_int_equal(q.count, 0); /* a flat sheet */
    const int32_t *corner = m.facet_vertex + m.facet_start[0];
    for (int32_t e = 0; e < m.ne; e++) { /* an edge elsewhere is put through the first facet, by so much */
        int joined = 0;
        for (int k = 0; k < 3; k++) joined |= corner[k] == m.edge[e][0] || corner[k] == m.edge[e][1];
        if (joined) continue;
        const rg_vec3 middle = rg_vec3_scale(1 / 3.0, rg_vec3_add(P.p[corner[0]], rg_vec3_add(P.p[corner[1]], P.p[corner[2]])));
        P.p[m.edge[e][0]] = rg_vec3_add(middle, (rg_vec3){0, 0, 0.2});
        P.p[m.edge[e][1]] = rg_vec3_add(middle, (rg_vec3){0.01, 0, -1e-3});
        break;
    }
    assert_int_equal(rg_crossed_add(c, &P, &near_, &q), RG_OK);
    assert_true(q.count > 0);
    for (int32_t k = 0; k < q.count; k++) {
        const rg_row *row = &q.row[k];
        double gap = 0;
        for (int32_t i = 0; i < row->terms; i++) gap += row->weight[i] * rg_vec3_dot(row->n, P.p[row->v[i]]);
        below(gap, 0);
        near(gap, row->floor, 1e-9);
        assert_true(row->soft_b > 0);
    }
    int glued = 0;
    for (size_t i = 0; i < (size_t)m.nv * (size_t)m.nf; i++) glued += (near_.corner[i] & RG_PROXIMITY_GLUED) != 0;
    for (size_t i = 0; i < (size_t)m.ne * (size_t)m.ne; i++) glued += (near_.edge[i] & RG_PROXIMITY_GLUED) != 0;
    assert_true(glued > 0);
    free(c), free(z);
    rg_contact_work_free(&look);
    rg_plates_free(&plates);
    rg_nearest_free(&q);
    rg_proximity_free(&near_);
    rg_linkage_free(&P);
    rg_mesh_free(&m);
    rg_mesh_free(&none);
}

/* The check can fail: the frog folds through itself where it is folded straight at its angles. */
static void the_check_sees(void **state)
{
    (void)state;
    rg_mesh none, m;
    rg_tree tree;
    mesh_of("patterns/preliminary.opx", &none);
    assert_int_equal(rg_triangulate_all(&none, &m), RG_OK);
    assert_int_equal(rg_tree_init(&m, 0, &tree), RG_OK);
    rg_vec3 *x = calloc((size_t)m.nv, sizeof *x);
    for (int32_t v = 0; v < m.nv; v++) x[v] = (rg_vec3){m.X[v].x / m.size, m.X[v].y / m.size, 0};
    assert_false(pierces(&m, x, DEEP));
    const int32_t *c = m.facet_vertex + m.facet_start[0];
    for (int32_t e = 0; e < m.ne; e++) { /* an edge elsewhere is put through the first facet */
        int joined = 0;
        for (int k = 0; k < 3; k++) joined |= c[k] == m.edge[e][0] || c[k] == m.edge[e][1];
        if (joined) continue;
        const rg_vec3 middle = rg_vec3_scale(1 / 3.0, rg_vec3_add(x[c[0]], rg_vec3_add(x[c[1]], x[c[2]])));
        x[m.edge[e][0]] = rg_vec3_add(middle, (rg_vec3){0, 0, 0.2});
        x[m.edge[e][1]] = rg_vec3_add(middle, (rg_vec3){0.01, 0, -0.2});
        assert_true(pierces(&m, x, DEEP));
        break;
    }
    free(x);
    rg_tree_free(&tree);
    rg_mesh_free(&m);
    rg_mesh_free(&none);
}

static void no_end(void **state)
{
    (void)state;
    static const char *const files[] = {"patterns/hypar.opx", "patterns/closed-split.opx", "patterns/closed-adjust.opx"};
    const rg_memory mem = rg_mem_default(NULL);
    const rg_unfold_wish wish = {1, -1, 0, 5e10, NULL, NULL, NULL};
    for (int k = 0; k < 3; k++) {
        rg_mesh none;
        rg_unfold u;
        mesh_of(files[k], &none);
        assert_int_equal(rg_unfold_run(&u, &mem, &none, &wish), RG_OK);
        assert_int_equal(u.outcome, RG_UNFOLD_NO_END);
        rg_unfold_free(&u);
        rg_mesh_free(&none);
    }
}

static void same_bits(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    const rg_unfold_wish wish = {1, -1, 0, 5e10, NULL, NULL, NULL};
    rg_mesh none;
    rg_unfold u[2];
    mesh_of("patterns/open-sink.opx", &none);
    for (int k = 0; k < 2; k++) assert_int_equal(rg_unfold_run(&u[k], &mem, &none, &wish), RG_OK);
    assert_int_equal(u[0].pass.track.count, u[1].pass.track.count);
    assert_memory_equal(u[0].pass.track.z, u[1].pass.track.z, (size_t)u[0].pass.track.count * (size_t)u[0].pass.P.n * sizeof(double));
    for (int k = 0; k < 2; k++) rg_unfold_free(&u[k]);
    rg_mesh_free(&none);
}

static void without_memory(void **state)
{
    (void)state;
    rg_mesh none;
    long refused = 0;
    rg_status s = RG_ENOMEM;
    mesh_of("patterns/waterbomb-base.opx", &none);
    for (long k = 0; s != RG_OK; k++) {
        counted c = {.left = k};
        const rg_memory mem = {counted_resize, &c};
        const rg_memory was = none.mem;
        const rg_unfold_wish wish = {1, -1, 0, 5e10, NULL, NULL, NULL};
        rg_unfold u;
        none.mem = mem; /* of it copies are made */
        s = rg_unfold_run(&u, &mem, &none, &wish);
        none.mem = was;
        assert_true(s == RG_OK || s == RG_ENOMEM);
        refused += s == RG_ENOMEM;
        rg_unfold_free(&u);
        assert_int_equal(c.out, 0);
    }
    assert_true(refused > 50);
    rg_mesh_free(&none);
}

/* Who asks to stop is heard. */
static int at_once(void *ctx, double done)
{
    (void)done;
    ++*(int *)ctx;
    return 1;
}

static void stopped(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    int asked = 0;
    const rg_unfold_wish wish = {1, -1, 0, 5e10, at_once, NULL, &asked};
    rg_mesh none;
    rg_unfold u;
    mesh_of("patterns/frog.opx", &none);
    assert_int_equal(rg_unfold_run(&u, &mem, &none, &wish), RG_OK);
    assert_int_equal(u.outcome, RG_UNFOLD_FAILED);
    assert_int_equal(u.tries, 0);
    assert_true(asked > 0);
    rg_unfold_free(&u);
    rg_mesh_free(&none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives),  cmocka_unit_test(multipliers),
        cmocka_unit_test(many_rows), cmocka_unit_test(again), cmocka_unit_test(all_near),
        cmocka_unit_test(places), cmocka_unit_test(distances),      cmocka_unit_test(meetings),
        cmocka_unit_test(free_motions), cmocka_unit_test(lands_as_it_shows), cmocka_unit_test(the_check_sees), cmocka_unit_test(no_end),      cmocka_unit_test(same_bits),
        cmocka_unit_test(without_memory), cmocka_unit_test(stopped), cmocka_unit_test(locked_end), cmocka_unit_test(crossed_rows),
        cmocka_unit_test(crane), cmocka_unit_test(small_facets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
