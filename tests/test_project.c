/* Wished steps to allowed steps, eqs. (9) and (14), by each solver, at flat, folded and unclosed states of sheets with more
 * creases than equations and with fewer. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "draw.h"
#include "generate/generate.h"
#include "kinematics/project.h"

enum { MOST = 400 };

typedef struct sheet { rg_pattern *p; rg_mesh m; rg_constraint K; } sheet;

static void sheet_init(sheet *s, const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    rg_diag why = {0, ""};
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, &why), RG_OK);
    s->p = pattern_of(&l);
    assert_int_equal(rg_mesh_from_pattern(s->p, &mem, &s->m, &why), RG_OK);
    assert_int_equal(rg_constraint_init(&s->K, &mem, &s->m), RG_OK);
    assert_in_range(s->m.N, 1, MOST);
    assert_in_range(3 * s->m.M, 1, MOST);
}

static void sheet_free(sheet *s)
{
    rg_constraint_free(&s->K);
    rg_mesh_free(&s->m);
    rg_pattern_destroy(s->p);
}

static double length(int32_t n, const double *a)
{
    double sum = 0;
    for (int32_t i = 0; i < n; i++) sum += a[i] * a[i];
    return sqrt(sum);
}

static int built(rg_solver s) { return s != RG_SOLVER_SVD || rg_pinv_built(); }

/* On the way of the Miura-ori, exactly closed: straight creases follow the zigzag ones. */
static void fold_miura(const sheet *s, double zigzag, double *rho)
{
    for (int32_t i = 0; i < s->m.N; i++) {
        const int32_t *e = s->m.edge[s->m.crease_edge[i]];
        rg_vec2 d = rg_vec2_sub(s->m.X[e[1]], s->m.X[e[0]]);
        int32_t alike = 0;
        for (int32_t k = 0; k < s->m.N; k++) {
            const int32_t *g = s->m.edge[s->m.crease_edge[k]];
            rg_vec2 c = rg_vec2_sub(s->m.X[g[1]], s->m.X[g[0]]);
            alike += fabs(rg_vec2_cross(c, d)) < 1e-6 * rg_vec2_length(c) * rg_vec2_length(d);
        }
        double sign = s->m.target[s->m.crease_edge[i]] > 0 ? 1 : -1;
        rho[i] = sign * (3 * alike > s->m.N ? 2 * atan(cos(60 * RG_DEG) * tan(zigzag / 2)) : zigzag);
    }
}

/* t = (I - C^+ C) w: C t = 0, and w - t is orthogonal to all that moves, in particular to t. */
static void wishes_are_projected(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; kind++)
        for (int folded = 0; folded < 2; folded++) {
            sheet s;
            double rho[MOST] = {0}, wish[MOST], t[3][MOST], c[MOST], x[MOST];
            sheet_init(&s, kind ? "miura" : "waterbomb", kind ? 6 : 3);
            if (folded && !kind) {
                sheet_free(&s);
                continue; /* no closed form */
            }
            if (folded) fold_miura(&s, 1.25, rho);
            below(rg_constraint_assemble(&s.K, rho), 1e-13);
            unsigned seed = 19;
            for (int32_t i = 0; i < s.m.N; i++) wish[i] = noise(&seed);
            for (rg_solver solver = RG_SOLVER_CG; solver <= RG_SOLVER_SVD; solver++) {
                if (!built(solver)) continue;
                const rg_memory mem = rg_mem_default(NULL);
                rg_project P;
                rg_cg_report rep;
                double *mine = t[solver - RG_SOLVER_CG];
                assert_int_equal(rg_project_init(&P, &mem, &s.K, solver), RG_OK);
                assert_int_equal(rg_project_step(&P, &s.K, wish, 0, NULL, mine, 1e-12, &rep), RG_OK);
                rg_sparse_mul(&s.K.C, mine, c);
                below(length(3 * s.m.M, c), 1e-9);
                double along = 0;
                for (int32_t i = 0; i < s.m.N; i++) along += mine[i] * (wish[i] - mine[i]);
                near(along, 0, 1e-8);
                assert_true(length(s.m.N, mine) > 0.01);
                rg_sparse_mul_t(&s.K.C, P.y, x); /* w - t = C^T y */
                for (int32_t i = 0; i < s.m.N; i++) near(x[i], wish[i] - mine[i], 1e-5);
                for (int32_t i = 0; i < s.m.N; i++) near(mine[i], t[0][i], 1e-7);
                assert_int_equal(rg_project_tangent(&P, &s.K, wish, x, 1e-12, &rep), RG_OK);
                for (int32_t i = 0; i < s.m.N; i++) near(x[i], mine[i], 1e-8);
                rg_project_free(&P);
            }
            sheet_free(&s);
        }
}

/* r worked off while one direction is obeyed to the letter, off the path of an over-constrained sheet. */
static void residuals_are_worked_off_and_progress_is_held(void **state)
{
    (void)state;
    sheet s;
    sheet_init(&s, "miura", 6);
    double on[MOST], rho[MOST], hold[MOST], step[MOST], first[MOST] = {0};
    fold_miura(&s, 1.25, on);
    for (int32_t i = 0; i < s.m.N; i++) hold[i] = s.m.target[s.m.crease_edge[i]];
    double size = length(s.m.N, hold);
    for (int32_t i = 0; i < s.m.N; i++) hold[i] /= size;
    for (rg_solver solver = RG_SOLVER_CG; solver <= RG_SOLVER_SVD; solver++) {
        if (!built(solver)) continue;
        const rg_memory mem = rg_mem_default(NULL);
        rg_project P;
        rg_cg_report rep;
        unsigned seed = 29;
        for (int32_t i = 0; i < s.m.N; i++) rho[i] = on[i] + 1e-3 * noise(&seed);
        assert_int_equal(rg_project_init(&P, &mem, &s.K, solver), RG_OK);
        double closure = rg_constraint_assemble(&s.K, rho);
        assert_true(closure > 1e-4);
        for (int n = 0; n < 6; n++) {
            if (n == 0) rg_project_renew(&P);
            else rg_project_renew_near(&P); /* whoever keeps a factor must come to the same end */
            assert_int_equal(rg_project_step(&P, &s.K, NULL, 1, hold, step, 1e-8, &rep), RG_OK);
            double along = 0;
            for (int32_t i = 0; i < s.m.N; i++) along += hold[i] * step[i];
            near(along, 0, 1e-12);
            for (int32_t i = 0; i < s.m.N; i++) rho[i] += step[i];
            closure = rg_constraint_assemble(&s.K, rho);
        }
        below(closure, 1e-12);
        if (solver == RG_SOLVER_CG) memcpy(first, rho, sizeof first);
        for (int32_t i = 0; i < s.m.N; i++) near(rho[i], first[i], 1e-9);
        rg_project_free(&P);
    }
    sheet_free(&s);
}

static void absent_solvers_say_so(void **state)
{
    (void)state;
    sheet s;
    sheet_init(&s, "miura", 3);
    for (rg_solver solver = RG_SOLVER_CG; solver <= RG_SOLVER_SVD; solver++) {
        const rg_memory mem = rg_mem_default(NULL);
        rg_project P;
        assert_int_equal(rg_project_init(&P, &mem, &s.K, solver), built(solver) ? RG_OK : RG_EABSENT);
        rg_project_free(&P);
    }
    sheet_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wishes_are_projected),
        cmocka_unit_test(residuals_are_worked_off_and_progress_is_held),
        cmocka_unit_test(absent_solvers_say_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
