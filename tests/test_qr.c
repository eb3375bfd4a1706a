/* linalg/qr.c: ranks that are known by how the rows were made, and those that SuiteSparse's SPQR finds in folded sheets. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "draw.h"
#include "generate/generate.h"
#include "kinematics/constraint.h"
#include "linalg/qr.h"
#include "linalg/scale.h"
#include "motion/motion.h"

#ifdef RG_GPL
#include <SuiteSparseQR_C.h>
#endif

static const double CUT = 1e-7;

static rg_sparse sparse(int32_t M, int32_t N, const int32_t *start, const int32_t *col)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_sparse C;
    assert_int_equal(rg_sparse_init(&C, &mem, M, N, start, col), RG_OK);
    return C;
}

static int32_t rank_of(const rg_sparse *B)
{
    int32_t rank = -1;
    assert_int_equal(rg_qr_rank(B, CUT, &rank), RG_OK);
    return rank;
}

/* ------------------------------------------------------------------------------------------------- known ranks ---- */

/* A ring of M vertices, each of which shares a crease with both neighbours and has `own` ones of its own. */
static rg_sparse ring(int32_t M, int32_t own, unsigned seed)
{
    enum { MOST = 40 };
    int32_t start[MOST + 1], col[MOST * 8], n = 0;
    for (int32_t k = 0; k < M; k++) {
        start[k] = n;
        col[n++] = k;
        col[n++] = (k + 1) % M;
        for (int32_t i = 0; i < own; i++) col[n++] = M + k * own + i;
    }
    start[M] = n;
    rg_sparse C = sparse(M, M * (1 + own), start, col);
    for (int32_t j = 0; j < n; j++) C.x[j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
    return C;
}

/* Numbers by chance are independent, as far as there is room: three rows a vertex, or as many as there are creases. Creases of its own of
 * a vertex that are none take a row each. */
static void rows_by_chance(void **state)
{
    (void)state;
    for (int32_t own = 0; own < 5; own++)
        for (int32_t M = 3; M < 40; M += 6) {
            rg_sparse C = ring(M, own, 17u + (unsigned)M);
            const int32_t room = C.N < 3 * M ? C.N : 3 * M;
            assert_int_equal(rank_of(&C), room);
            for (int32_t j = C.start[1]; j < C.start[2]; j++) C.x[j] = (rg_vec3){0, 0, 0};
            if (own >= 2) assert_int_equal(rank_of(&C), 3 * M - 3);
            /* The rows of one plane only, and the third that of the second over again but for rounding. */
            for (int32_t j = 0; j < C.start[M]; j++) C.x[j].z = C.x[j].y * (1 + 1e-16 * (j % 3));
            if (own >= 2) assert_int_equal(rank_of(&C), 2 * M - 2);
            rg_sparse_free(&C);
        }
}

/* Two vertices on the same creases that ask the same; and what is nearly the same, on either side of the cut. */
static void rows_said_twice(void **state)
{
    (void)state;
    const int32_t start[] = {0, 8, 16}, col[] = {0, 1, 2, 3, 4, 5, 6, 7, 7, 6, 5, 4, 3, 2, 1, 0};
    static const double off[] = {0, 1e-13, 1e-9, 1e-5, 0.1};
    for (int k = 0; k < 5; k++) {
        rg_sparse C = sparse(2, 8, start, col);
        unsigned seed = 5;
        for (int32_t j = 0; j < 8; j++) C.x[j] = C.x[15 - j] = (rg_vec3){noise(&seed), noise(&seed), noise(&seed)};
        for (int32_t j = 8; j < 16; j++) C.x[j].x += off[k] * noise(&seed);
        assert_int_equal(rank_of(&C), off[k] < CUT ? 3 : 4);
        rg_sparse_free(&C);
    }
}

static void nothing(void **state)
{
    (void)state;
    const int32_t start[] = {0, 3}, col[] = {0, 1, 2};
    rg_sparse C = sparse(1, 3, start, col);
    assert_int_equal(rank_of(&C), 0);
    rg_sparse_free(&C);
    C = sparse(0, 3, start, col);
    assert_int_equal(rank_of(&C), 0);
    rg_sparse_free(&C);
}

/* ------------------------------------------------------------------------------------------------ against SPQR ---- */

#ifdef RG_GPL
static int32_t rank_by_spqr(const rg_sparse *B)
{
    cholmod_common cc;
    cholmod_l_start(&cc);
    const size_t blocks = (size_t)B->start[B->M];
    cholmod_triplet *T = cholmod_l_allocate_triplet((size_t)B->N, 3 * (size_t)B->M, 3 * blocks, 0, CHOLMOD_REAL, &cc);
    assert_non_null(T);
    SuiteSparse_long *i = T->i, *j = T->j;
    for (size_t b = 0; b < blocks; b++) {
        const double v[3] = {B->x[b].x, B->x[b].y, B->x[b].z};
        for (size_t a = 0; a < 3; a++) i[3 * b + a] = B->col[b], j[3 * b + a] = 3 * B->row[b] + (int)a, ((double *)T->x)[3 * b + a] = v[a];
    }
    T->nnz = 3 * blocks;
    cholmod_sparse *A = cholmod_l_triplet_to_sparse(T, 0, &cc);
    const SuiteSparse_long rank = SuiteSparseQR_C(SPQR_ORDERING_COLAMD, CUT, 0, 0, A, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, &cc);
    assert_true(rank >= 0);
    cholmod_l_free_triplet(&T, &cc);
    cholmod_l_free_sparse(&A, &cc);
    cholmod_l_finish(&cc);
    return (int32_t)rank;
}

static rg_motion *motion_of(const char *kind, int32_t n, rg_triangulation triangulate)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_settings s = rg_settings_default();
    rg_lines l;
    rg_motion *m = NULL;
    s.triangulate = triangulate;
    s.frames = 5;
    s.effort = RG_EFFORT_FAST;
    s.contact = RG_CONTACT_IGNORE;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    rg_pattern *p = pattern_of(&l);
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &m, NULL), RG_OK);
    rg_pattern_destroy(p);
    return m;
}
#endif

/* Flat, on the way, folded flat; plates that go one way though they have more equations than creases, sheets cut up, some that stop. */
static void folded_sheets_have_the_rank_that_spqr_finds(void **state)
{
    (void)state;
#ifndef RG_GPL
    print_message("SKIPPED: built with GPL=0, no SPQR to compare with\n");
    skip();
#else
    static const struct { const char *kind; int32_t n; rg_triangulation triangulate; } run[] = {
        {"miura", 7, RG_TRIANGULATE_NONE}, {"miura", 30, RG_TRIANGULATE_NONE}, {"miura", 20, RG_TRIANGULATE_ALL}, {"waterbomb", 8, RG_TRIANGULATE_NONE},
        {"random", 9, RG_TRIANGULATE_NONE}, {"hypar", 0, RG_TRIANGULATE_AUTO}, {"frog", 0, RG_TRIANGULATE_AUTO}, {"boxpleat", 0, RG_TRIANGULATE_AUTO},
        {"yoshimura", 5, RG_TRIANGULATE_NONE}, {"kresling", 6, RG_TRIANGULATE_ALL}, {"closed-adjust", 0, RG_TRIANGULATE_NONE}};
    for (size_t k = 0; k < sizeof run / sizeof *run; k++) {
        rg_motion *m = motion_of(run[k].kind, run[k].n, run[k].triangulate);
        for (int32_t f = 0; f < m->report.frame_count; f++) {
            rg_constraint K = {0};
            rg_scale S = {0};
            assert_int_equal(rg_constraint_init(&K, &m->mem, &m->mesh), RG_OK);
            assert_int_equal(rg_scale_init(&S, &m->mem, &K.C), RG_OK);
            if (m->flat) {
                double *theta = malloc((size_t)m->mesh.loop_start[m->mesh.M] * sizeof *theta);
                rg_mesh_sectors(&m->mesh, rg_motion_pattern(m, f), theta);
                rg_constraint_set_theta(&K, theta);
                free(theta);
            }
            rg_constraint_assemble(&K, rg_motion_angles(m, f));
            rg_scale_update(&S, &K.C);
            const int32_t own = rank_of(&S.B), theirs = rank_by_spqr(&S.B);
            if (own != theirs) fail_msg("%s %d, frame %d: rank %d, by SPQR %d", run[k].kind, (int)run[k].n, (int)f, (int)own, (int)theirs);
            rg_scale_free(&S);
            rg_constraint_free(&K);
        }
        rg_motion_destroy(m);
    }
#endif
}

static void want_of_memory_is_told(void **state)
{
    (void)state;
    rg_sparse C = ring(6, 2, 3);
    const rg_memory mem = C.mem;
    for (long left = 0;; left++) {
        counted c = {left, 0, 0};
        int32_t rank = -1;
        C.mem = (rg_memory){counted_resize, &c};
        const rg_status s = rg_qr_rank(&C, CUT, &rank);
        assert_int_equal(c.out, 0);
        if (s == RG_OK) {
            assert_int_equal(rank, 18);
            break;
        }
        assert_int_equal(s, RG_ENOMEM);
    }
    C.mem = mem;
    rg_sparse_free(&C);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_by_chance), cmocka_unit_test(rows_said_twice), cmocka_unit_test(nothing),
        cmocka_unit_test(folded_sheets_have_the_rank_that_spqr_finds), cmocka_unit_test(want_of_memory_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
