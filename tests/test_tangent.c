/* kinematics/tangent.c by rigami.h: C, its rank, what it leaves free, and the nearest velocity that it allows, each found again by other means. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "rigami.h"

/* At a part of the way of a generated pattern. */
static rg_fold *fold_at(const char *kind, int32_t n, double percent, rg_triangulation t)
{
    rg_settings s = rg_settings_default();
    rg_pattern *p = NULL;
    rg_fold *f = NULL;
    s.triangulate = t;
    s.frames = 9;
    s.contact = RG_CONTACT_IGNORE;
    assert_int_equal(rg_generate_pattern(kind, n, 0, 0, NULL, &p, NULL), RG_OK);
    assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f, NULL), RG_OK);
    assert_int_equal(rg_fold_go_to(f, percent), RG_OK);
    rg_pattern_destroy(p);
    return f;
}

static void mul(const rg_tangent_info *i, const double *x, double *y)
{
    for (int32_t r = 0; r < i->rows; r++) {
        y[r] = 0;
        for (int32_t k = i->row_start[r]; k < i->row_start[r + 1]; k++) y[r] += i->value[k] * x[i->column[k]];
    }
}

static double length(const double *x, int32_t n)
{
    double sum = 0;
    for (int32_t i = 0; i < n; i++) sum += x[i] * x[i];
    return sqrt(sum);
}

/* The rank of C by elimination with complete pivoting: shares nothing with projections. */
static int32_t rank_of(const rg_tangent_info *t)
{
    const int32_t m = t->rows, n = t->columns;
    double *A = calloc((size_t)m * (size_t)n + 1, sizeof *A);
    int32_t rank = 0;
    for (int32_t r = 0; r < m; r++)
        for (int32_t k = t->row_start[r]; k < t->row_start[r + 1]; k++) A[r * n + t->column[k]] = t->value[k];
    for (; rank < m && rank < n; rank++) {
        int32_t pr = rank, pc = rank;
        for (int32_t r = rank; r < m; r++)
            for (int32_t c = rank; c < n; c++)
                if (fabs(A[r * n + c]) > fabs(A[pr * n + pc])) pr = r, pc = c;
        if (!(fabs(A[pr * n + pc]) > 1e-9)) break;
        for (int32_t c = 0; c < n; c++) {
            const double x = A[rank * n + c];
            A[rank * n + c] = A[pr * n + c], A[pr * n + c] = x;
        }
        for (int32_t r = 0; r < m; r++) {
            const double x = A[r * n + rank];
            A[r * n + rank] = A[r * n + pc], A[r * n + pc] = x;
        }
        for (int32_t r = rank + 1; r < m; r++) {
            const double by = A[r * n + rank] / A[rank * n + rank];
            for (int32_t c = rank; c < n; c++) A[r * n + c] -= by * A[rank * n + c];
        }
    }
    free(A);
    return rank;
}

static const struct { const char *kind; int32_t n; double percent; rg_triangulation t; } STATES[] = {
    {"miura", 4, 0, RG_TRIANGULATE_NONE}, {"miura", 4, 40, RG_TRIANGULATE_NONE}, {"miura", 4, 40, RG_TRIANGULATE_ALL},
    {"waterbomb", 2, 30, RG_TRIANGULATE_AUTO}, {"bird", 0, 55, RG_TRIANGULATE_AUTO}, {"random", 5, 70, RG_TRIANGULATE_AUTO}};
enum { STATES_HERE = sizeof STATES / sizeof *STATES };

static void rank_and_basis(void **state)
{
    (void)state;
    for (int k = 0; k < STATES_HERE; k++) {
        rg_fold *f = fold_at(STATES[k].kind, STATES[k].n, STATES[k].percent, STATES[k].t);
        rg_tangent *t = NULL;
        assert_int_equal(rg_fold_tangent(f, &t), RG_OK);
        const rg_tangent_info *i = rg_tangent_get_info(t);
        const rg_sheet *s = rg_motion_get_sheet(rg_fold_motion(f));
        int32_t freedoms;
        const double *basis;
        assert_int_equal(i->columns, s->creases);
        assert_int_equal(rg_tangent_basis(t, &freedoms, &basis), RG_OK);
        assert_int_equal(freedoms, i->columns - rank_of(i));
        if (STATES[k].percent > 0) {
            int32_t ways; /* another factorisation, of the nearest frame */
            assert_int_equal(rg_motion_mobility(rg_fold_motion(f), 4, &ways), RG_OK);
            assert_int_equal(freedoms, ways);
        }
        double *y = malloc((size_t)i->rows * sizeof *y);
        for (int32_t a = 0; a < freedoms; a++) {
            mul(i, basis + (size_t)a * (size_t)i->columns, y);
            below(length(y, i->rows), 1e-9);
            for (int32_t b = 0; b <= a; b++) {
                double dot = 0;
                for (int32_t c = 0; c < i->columns; c++) dot += basis[a * i->columns + c] * basis[b * i->columns + c];
                near(dot, a == b, 1e-12);
            }
        }
        free(y);
        rg_tangent_destroy(t);
        rg_fold_destroy(f);
    }
}

/* The step is allowed, what was taken from the wish is square to all that is allowed, and is C^T times the reaction. */
static void projections(void **state)
{
    (void)state;
    unsigned seed = 3;
    for (int k = 0; k < STATES_HERE; k++) {
        rg_fold *f = fold_at(STATES[k].kind, STATES[k].n, STATES[k].percent, STATES[k].t);
        rg_tangent *t = NULL;
        assert_int_equal(rg_fold_tangent(f, &t), RG_OK);
        const rg_tangent_info *i = rg_tangent_get_info(t);
        const int32_t N = i->columns;
        double *wish = malloc((size_t)N * sizeof *wish), *step = malloc((size_t)N * sizeof *step), *back = calloc((size_t)N, sizeof *back);
        double *y = malloc((size_t)i->rows * sizeof *y), dot = 0;
        for (int32_t c = 0; c < N; c++) wish[c] = noise(&seed);
        assert_int_equal(rg_tangent_project(t, wish, step, y), RG_OK);
        for (int32_t r = 0; r < i->rows; r++)
            for (int32_t j = i->row_start[r]; j < i->row_start[r + 1]; j++) back[i->column[j]] += i->value[j] * y[r];
        for (int32_t c = 0; c < N; c++) {
            dot += step[c] * (wish[c] - step[c]);
            near(wish[c] - step[c], back[c], 1e-6);
        }
        near(dot, 0, 1e-9);
        mul(i, step, y);
        below(length(y, i->rows), 1e-9);
        assert_int_equal(rg_tangent_project(t, step, wish, NULL), RG_OK);
        for (int32_t c = 0; c < N; c++) near(wish[c], step[c], 1e-9);
        free(wish), free(step), free(back), free(y);
        rg_tangent_destroy(t);
        rg_fold_destroy(f);
    }
}

/* A projection is linear, also where squares are endless or nothing; what is no number is refused. */
static void wishes_of_any_size(void **state)
{
    (void)state;
    static const double sizes[] = {1e-300, 1e-160, 1e-90, 1e90, 1e155, 1e300};
    for (int k = 0; k < STATES_HERE; k++) {
        rg_fold *f = fold_at(STATES[k].kind, STATES[k].n, STATES[k].percent, STATES[k].t);
        rg_tangent *t = NULL;
        unsigned seed = 5;
        assert_int_equal(rg_fold_tangent(f, &t), RG_OK);
        const int32_t N = rg_tangent_get_info(t)->columns, rows = rg_tangent_get_info(t)->rows;
        double *wish = malloc(4 * (size_t)N * sizeof *wish), *step = wish + N, *large = step + N, *other = large + N;
        double *y = malloc(2 * (size_t)rows * sizeof *y), *z = y + rows;
        for (int32_t c = 0; c < N; c++) wish[c] = noise(&seed);
        assert_int_equal(rg_tangent_project(t, wish, step, y), RG_OK);
        for (int i = 0; i < 6; i++) {
            for (int32_t c = 0; c < N; c++) large[c] = sizes[i] * wish[c];
            assert_int_equal(rg_tangent_project(t, large, other, z), RG_OK);
            for (int32_t c = 0; c < N; c++) near(other[c] / sizes[i], step[c], 1e-12);
            for (int32_t r = 0; r < rows; r++) near(z[r] / sizes[i], y[r], 1e-4);
        }
        memcpy(other, step, (size_t)N * sizeof *other);
        static const double none[] = {NAN, INFINITY, -INFINITY};
        for (int i = 0; i < 3; i++) {
            wish[N - 1] = none[i];
            assert_int_equal(rg_tangent_project(t, wish, other, z), RG_EARG);
            assert_memory_equal(other, step, (size_t)N * sizeof *other);
        }
        free(wish), free(y);
        rg_tangent_destroy(t);
        rg_fold_destroy(f);
    }
}

/* C is the change of r with the angles: by central differences; columns rise; what closes has angle 0. */
static void derivatives(void **state)
{
    (void)state;
    rg_fold *f = fold_at("miura", 3, 35, RG_TRIANGULATE_ALL);
    rg_tangent *t = NULL;
    assert_int_equal(rg_fold_tangent(f, &t), RG_OK);
    const rg_tangent_info *i = rg_tangent_get_info(t);
    for (int32_t r = 0; r < i->rows; r++) {
        near(i->residual[r], 0, 1e-9);
        for (int32_t k = i->row_start[r] + 1; k < i->row_start[r + 1]; k++) assert_true(i->column[k] > i->column[k - 1]);
    }
    for (int32_t k = 0; k < i->rows / 3; k++) below(i->angle[k], 1e-9);
    /* A column is a unit vector, where the crease points, at each of its inner ends. */
    const rg_sheet *s = rg_motion_get_sheet(rg_fold_motion(f));
    for (int32_t c = 0; c < i->columns; c++) {
        double sum = 0;
        int inner = 0;
        for (int32_t r = 0; r < i->rows; r++)
            for (int32_t j = i->row_start[r]; j < i->row_start[r + 1]; j++) sum += i->column[j] == c ? i->value[j] * i->value[j] : 0;
        for (int32_t k = 0; k < i->rows / 3; k++)
            inner += s->ends[s->crease_edge[c]][0] == i->vertex[k] || s->ends[s->crease_edge[c]][1] == i->vertex[k];
        near(sum, inner, 1e-12);
    }
    rg_tangent_destroy(t);
    assert_int_equal(rg_motion_tangent(rg_fold_motion(f), 99, &t), RG_EARG);
    rg_fold_destroy(f);
    rg_tangent_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rank_and_basis), cmocka_unit_test(projections), cmocka_unit_test(wishes_of_any_size),
                                       cmocka_unit_test(derivatives)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
