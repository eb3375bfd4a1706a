/* Folding against what is known without folding: closed forms, closure from scratch, orders, the same bits twice. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "counted.h"
#include "folded.h"
#include "folding.h"
#include "fold/straight.h"
#include "fold/system.h"
#include "generate/generate.h"

static rg_pattern *generated(const char *kind, int32_t n, double degrees)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    rg_diag why = {0, ""};
    if (rg_generate_lines(kind, n, 0, degrees * RG_DEG, &mem, &l, &why) != RG_OK) fail_msg("%s %d: %s", kind, (int)n, why.text);
    return pattern_of(&l);
}

/* One vertex in the middle of a round sheet, creases in the directions given in degrees. */
static rg_pattern *star(int32_t n, const double *degrees, const char *assignment)
{
    rg_lines l = drawing();
    rg_vec2 rim[16];
    for (int32_t i = 0; i < n; i++) {
        rim[i] = (rg_vec2){cos(degrees[i] * RG_DEG), sin(degrees[i] * RG_DEG)};
        draw(&l, assignment[i], 0, 0, rim[i].x, rim[i].y);
    }
    draw_polygon(&l, RG_BORDER, rim, n);
    return pattern_of(&l);
}

/* --------------------------------------------------------------------------------------- closed forms ---- */

/* Of a Miura-ori's three directions the one with most creases is that of the straight ones. */
static int is_straight(const rg_mesh *m, int32_t i)
{
    double direction[2];
    int32_t count = 0, edge[2] = {m->crease_edge[i], 0};
    for (int32_t k = 0; k < m->N; k++) {
        edge[1] = m->crease_edge[k];
        for (int e = 0; e < 2; e++) {
            rg_vec2 d = rg_vec2_sub(m->X[m->edge[edge[e]][1]], m->X[m->edge[edge[e]][0]]);
            direction[e] = fmod(atan2(d.y, d.x) + 2 * RG_PI + 1e-6, RG_PI);
        }
        count += fabs(direction[0] - direction[1]) < 1e-4;
    }
    return 3 * count > m->N; /* about a half, against a quarter each of the zigzags */
}

static void miura_keeps_its_closed_form(int32_t n, rg_method method, double off, double *worst)
{
    const double alpha = 60 * RG_DEG;
    rg_settings s = rg_settings_default();
    s.method = method;
    rg_pattern *p = generated("miura", n, 60);
    rg_straight *f = fold_of(p, &s);
    int32_t straight = -1, zigzag = -1, frames = 0;
    static char kind[4000];
    assert_in_range(f->mesh.N, 1, 4000);
    for (int32_t i = 0; i < f->mesh.N; i++) {
        kind[i] = (char)is_straight(&f->mesh, i);
        if (kind[i]) straight = i;
        else zigzag = i;
    }
    *worst = 0;
    for (rg_step_info i; next_frame(f, &i); frames++) {
        const double z = fabs(f->rho[zigzag]);
        const double both = 2 * atan(cos(alpha) * tan(z / 2));
        for (int32_t k = 0; k < f->mesh.N; k++) {
            const double want = kind[k] ? (z < RG_PI ? both : RG_PI) : z;
            if (!(fabs(fabs(f->rho[k]) - want) <= *worst)) *worst = fabs(fabs(f->rho[k]) - want);
            assert_true(f->rho[k] * f->drive.target[k] >= 0);
        }
        near(rg_drive_progress(&f->drive, f->rho), (double)i.frame / (s.frames - 1), 1e-9);
        below(unclosed(&f->mesh, f->mesh.X, f->rho), 1e-10);
    }
    assert_true(straight >= 0);
    assert_int_equal(frames, s.frames);
    assert_int_equal(f->outcome, RG_FOLDED);
    for (int32_t k = 0; k < f->mesh.N; k++) near(f->rho[k], f->drive.target[k], 0); /* the folded state itself */
    below(*worst, off);
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
}

static void miura_32_is_exact_by_default(void **state)
{
    (void)state;
    double worst;
    miura_keeps_its_closed_form(32, RG_METHOD_AUTO, 1e-9, &worst);
    print_message("Miura 32 x 32 by default: angles off by at most %.1e rad\n", worst);
}

static void miura_is_exact_by_every_method_that_closes(void **state)
{
    (void)state;
    double worst;
    for (rg_method m = RG_METHOD_NEWTON; m <= RG_METHOD_ADAPTIVE; m++) miura_keeps_its_closed_form(6, m, 1e-9, &worst);
}

/* Sectors a, b, pi - a, pi - b: opposite creases turn alike, the half-angle tangents of the pairs keep one ratio. */
static void a_vertex_of_four_keeps_its_ratio(void **state)
{
    (void)state;
    const double a = 65, b = 80, degrees[] = {0, a, a + b, 180 + b};
    for (rg_solver solver = RG_SOLVER_CG; solver <= RG_SOLVER_SVD; solver++) {
        if (solver == RG_SOLVER_SVD && !rg_pinv_built()) continue;
        rg_settings s = rg_settings_default();
        s.solver = solver;
        rg_pattern *p = star(4, degrees, "VMMM");
        rg_straight *f = fold_of(p, &s);
        double ratio = 0;
        for (rg_step_info i; next_frame(f, &i);) {
            const double *rho = f->rho;
            int32_t at[4]; /* creases by direction */
            for (int32_t k = 0; k < 4; k++) at[k] = f->mesh.loop_crease[k];
            near(fabs(rho[at[0]]), fabs(rho[at[2]]), 1e-9);
            near(fabs(rho[at[1]]), fabs(rho[at[3]]), 1e-9);
            if (i.frame == 0 || i.frame == s.frames - 1) continue;
            double now = tan(fabs(rho[at[0]]) / 2) / tan(fabs(rho[at[1]]) / 2);
            if (now > 1) now = 1 / now;
            if (ratio == 0) ratio = now;
            near(now, ratio, 1e-8);
        }
        double one = fabs(sin((a - b) / 2 * RG_DEG) / sin((a + b) / 2 * RG_DEG));
        double other = fabs(cos((a + b) / 2 * RG_DEG) / cos((a - b) / 2 * RG_DEG));
        assert_true(fabs(ratio - one) < 1e-8 || fabs(ratio - other) < 1e-8);
        assert_int_equal(f->outcome, RG_FOLDED);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
    }
}

static void all_mountain_does_not_fold_and_says_so(void **state)
{
    (void)state;
    const double degrees[] = {0, 65, 145, 260};
    for (rg_method m = RG_METHOD_NEWTON; m <= RG_METHOD_ADAPTIVE; m++) {
        rg_settings s = rg_settings_default();
        s.method = m;
        rg_pattern *p = star(4, degrees, "MMMM");
        rg_straight *f = fold_of(p, &s);
        rg_step_info i;
        while (next_frame(f, &i)) below(unclosed(&f->mesh, f->mesh.X, f->rho), 1e-9);
        assert_int_equal(f->outcome, RG_STOPPED);
        assert_true(f->reason[0] != 0);
        below(unclosed(&f->mesh, f->mesh.X, f->rho), 1e-9);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
    }
}

/* ------------------------------------------------------------------------------------------- many ways ---- */

static const double SIX[] = {0, 52, 118, 171, 247, 301};

/* From the state `from` at progress 0.25 on to 0.5, in steps of `degrees`. */
static void go_on(const rg_pattern *p, rg_method method, double degrees, const double *from, double *to)
{
    rg_settings s = rg_settings_default();
    s.method = method;
    s.step = degrees * RG_DEG;
    s.frames = 3;
    s.to = 0.5;
    s.tol = 1e-13;
    rg_straight *f = fold_of(p, &s);
    rg_step_info i;
    if (from) {
        assert_int_equal(rg_straight_step(f, &i), RG_OK);
        rg_straight_stand(f, from, 0.25, 2);
    }
    do assert_int_equal(rg_straight_step(f, &i), RG_OK);
    while (i.frame != (from ? 2 : 1) && i.outcome == RG_RUNNING);
    assert_int_equal(i.frame, from ? 2 : 1);
    memcpy(to, f->rho, (size_t)f->mesh.N * sizeof *to);
    rg_straight_destroy(f);
}

static double distance(const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < 6; i++) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/* Six creases at one vertex: three ways to go, so the order of a method shows along the sheet's freedoms. */
static void methods_are_of_their_order(void **state)
{
    (void)state;
    rg_pattern *p = star(6, SIX, "MVMMVM");
    double from[6], exact[6], at[6], finer[6];
    go_on(p, RG_METHOD_RK4, 0.5, NULL, from);
    go_on(p, RG_METHOD_RK4, 0.25, from, exact);
    go_on(p, RG_METHOD_RK4, 0.125, from, finer);
    below(distance(exact, finer), 1e-12); /* the reference has converged */
    const struct { rg_method method; double order, step; } is[] = {
        {RG_METHOD_NEWTON, 1, 1}, {RG_METHOD_HEUN, 2, 2}, {RG_METHOD_RK4, 4, 6}};
    for (int k = 0; k < 3; k++) {
        double e[2];
        for (int half = 0; half < 2; half++) {
            go_on(p, is[k].method, is[k].step / (1 + half), from, at);
            e[half] = distance(at, finer);
        }
        double order = log2(e[0] / e[1]);
        print_message("order %.2f, %.1f expected (%.1e, %.1e)\n", order, is[k].order, e[0], e[1]);
        near(order, is[k].order, 0.2);
    }
    rg_pattern_destroy(p);
}

static void adaptive_follows_the_same_motion(void **state)
{
    (void)state;
    rg_pattern *p = star(6, SIX, "MVMMVM");
    rg_settings s = rg_settings_default();
    s.to = 0.5;
    s.frames = 11;
    s.method = RG_METHOD_RK4;
    s.step = 0.1 * RG_DEG;
    rg_straight *fine = fold_of(p, &s);
    s.method = RG_METHOD_ADAPTIVE;
    s.step = 5 * RG_DEG;
    rg_straight *f = fold_of(p, &s);
    for (rg_step_info i, j; next_frame(f, &i);) {
        assert_true(next_frame(fine, &j));
        below(distance(f->rho, fine->rho), 2e-5);
        near(rg_drive_progress(&f->drive, f->rho), 0.05 * i.frame, 1e-9);
        below(unclosed(&f->mesh, f->mesh.X, f->rho), 1e-10);
    }
    assert_int_equal(f->outcome, RG_FOLDED);
    rg_straight_destroy(f);
    rg_straight_destroy(fine);
    rg_pattern_destroy(p);
}

/* --------------------------------------------------------------------------------- promises of the loop ---- */

static void the_same_bits_twice(void **state)
{
    (void)state;
    static const char *const kinds[] = {"miura", "waterbomb", "frog"};
    for (int k = 0; k < 3; k++) {
        rg_settings s = rg_settings_default();
        s.frames = 17;
        rg_pattern *p = generated(kinds[k], k < 2 ? 5 : 0, 0);
        rg_straight *a = fold_of(p, &s), *b = fold_of(p, &s);
        for (rg_step_info i, j; next_frame(a, &i);) {
            assert_true(next_frame(b, &j));
            assert_memory_equal(a->rho, b->rho, (size_t)a->mesh.N * sizeof *a->rho);
        }
        rg_straight_destroy(a);
        rg_straight_destroy(b);
        rg_pattern_destroy(p);
    }
}

/* With ever more frames: at the same percent the same bits, and from one to the next no more than so many parts of a whole turn as
 * there are frames, times three. Patterns that leave flat in several ways, that one way, that come in parts. */
static void frames_are_read_off_a_path_that_knows_nothing_of_them(void **state)
{
    (void)state;
    static const struct { const char *kind; int32_t n; rg_triangulation triangulate; } of[] = {
        {"preliminary", 0, RG_TRIANGULATE_NONE}, {"bird", 0, RG_TRIANGULATE_NONE}, {"miura", 4, RG_TRIANGULATE_NONE},
        {"miura", 4, RG_TRIANGULATE_ALL}, {"waterbomb", 2, RG_TRIANGULATE_NONE}};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        double *kept = NULL;
        for (int32_t many = 1; many <= 100; many *= 10) { /* of them each tenth is a frame of the one before */
            rg_settings s = rg_settings_default();
            s.triangulate = of[k].triangulate;
            s.frames = 24 * many + 1;
            rg_pattern *p = generated(of[k].kind, of[k].n, 0);
            rg_straight *f = fold_of(p, &s);
            const int32_t N = f->mesh.N;
            const size_t row = (size_t)N * sizeof(double);
            double *now = calloc((size_t)s.frames, row), most = 0;
            for (rg_step_info i; next_frame(f, &i);) {
                near(f->s, (double)i.frame / (s.frames - 1), 1e-9);
                memcpy(now + i.frame * N, f->rho, row);
                for (int32_t c = 0; c < N && i.frame > 0; c++)
                    most = fmax(most, fabs(now[i.frame * N + c] - now[(i.frame - 1) * N + c]));
            }
            assert_int_equal(f->outcome, RG_FOLDED);
            below(most, 3 * RG_PI / (s.frames - 1));
            for (int32_t i = 0; kept && i < s.frames; i += 10)
                assert_memory_equal(now + i * N, kept + i / 10 * N, row);
            free(kept);
            kept = now;
            rg_straight_destroy(f);
            rg_pattern_destroy(p);
        }
        free(kept);
    }
}

static void steps_allocate_nothing(void **state)
{
    (void)state;
    rg_pattern *p = generated("waterbomb", 3, 0), *q = generated("miura", 6, 0);
    for (rg_method m = RG_METHOD_AUTO; m <= RG_METHOD_ADAPTIVE; m++)
        for (int k = 0; k < 2; k++) {
            counted c = {1000000, 0, 0};
            const rg_memory mem = {counted_resize, &c};
            rg_settings s = rg_settings_default();
            s.memory = &mem;
            s.method = m;
            s.frames = 9;
            rg_straight *f = fold_of(k ? q : p, &s);
            long asked = c.asked;
            for (rg_step_info i; next_frame(f, &i);) {}
            assert_int_equal(c.asked, asked);
            rg_straight_destroy(f);
            assert_int_equal(c.out, 0);
        }
    rg_pattern_destroy(p);
    rg_pattern_destroy(q);
}

static void memory_may_be_short(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 3, 0);
    rg_settings s = rg_settings_default();
    s.solver = RG_SOLVER_CHOLESKY;
    starves_cleanly(p, s);
    rg_pattern_destroy(p);
}

/* Patterns that get stuck: every frame on the way closes, and so does the state where it ends. */
static void what_stops_is_closed(void **state)
{
    (void)state;
    static const char *const kinds[] = {"frog", "resch", "hypar"};
    for (int k = 0; k < 3; k++) {
        rg_settings s = rg_settings_default();
        rg_pattern *p = generated(kinds[k], 0, 0);
        rg_straight *f = fold_of(p, &s);
        for (rg_step_info i; next_frame(f, &i);) below(unclosed(&f->mesh, f->mesh.X, f->rho), 2e-10);
        assert_int_equal(f->outcome, RG_STOPPED);
        below(unclosed(&f->mesh, f->mesh.X, f->rho), 2e-10);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
    }
}

static void solvers_say_the_same(void **state)
{
    (void)state;
    if (!rg_pinv_built()) {
        print_message("SKIPPED: built with GPL=0, without one of the solvers\n");
        skip();
    }
    rg_pattern *p = generated("waterbomb", 2, 0), *q = generated("miura", 5, 0);
    for (int k = 0; k < 2; k++) {
        rg_settings s = rg_settings_default();
        s.frames = 7;
        s.method = RG_METHOD_NEWTON;
        rg_straight *f[3];
        for (int i = 0; i < 3; i++) {
            s.solver = (rg_solver)(RG_SOLVER_CG + i);
            f[i] = fold_of(k ? q : p, &s);
        }
        for (rg_step_info i; next_frame(f[0], &i);)
            for (int j = 1; j < 3; j++) {
                assert_true(next_frame(f[j], &i));
                for (int32_t c = 0; c < f[0]->mesh.N; c++) near(f[j]->rho[c], f[0]->rho[c], 1e-6);
            }
        for (int i = 0; i < 3; i++) rg_straight_destroy(f[i]);
    }
    rg_pattern_destroy(p);
    rg_pattern_destroy(q);
}

/* What the exit status 0 promises, of every crease: within 1 % of its target, on either side of it, and on the way to the end. */
static void one_percent_is_one_percent(void **state)
{
    (void)state;
    static const struct { double part; rg_outcome outcome; } all[] = {{1, RG_FOLDED}, {0.9901, RG_FOLDED}, {0.9899, RG_STOPPED},
        {0.97, RG_STOPPED}, {0.951, RG_STOPPED}, {1.0099, RG_FOLDED}, {1.0101, RG_STOPPED}, {1.04, RG_STOPPED}, {-1, RG_STOPPED}};
    rg_settings s = rg_settings_default();
    rg_pattern *p = generated("bird", 0, 0);
    rg_straight *f = fold_of(p, &s);
    assert_int_equal(f->apart.parts, 0);
    for (int k = 0; k < 9; k++)
        for (int32_t short_of = -1; short_of < f->mesh.N; short_of++) { /* -1: all of them */
            for (int32_t i = 0; i < f->mesh.N; i++) f->rho[i] = (short_of < 0 || i == short_of ? all[k].part : 1) * f->drive.target[i];
            rg_straight_stop(f, "");
            const int counts = short_of < 0 || rg_drive_is_driven(&f->drive, short_of);
            assert_int_equal(f->outcome, counts ? all[k].outcome : RG_FOLDED);
        }
    /* A motion that was not to go to the end has not come there. */
    for (int32_t i = 0; i < f->mesh.N; i++) f->rho[i] = f->drive.target[i];
    f->s_end = 0.999;
    rg_straight_stop(f, "");
    assert_int_equal(f->outcome, RG_STOPPED);
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
}

/* What a fold costs is counted, never backwards. */
static void what_it_cost(void **state)
{
    (void)state;
    for (int k = RG_METHOD_EULER; k <= RG_METHOD_ADAPTIVE; k++) {
        rg_settings s = rg_settings_default();
        rg_pattern *p = generated("bird", 0, 0);
        s.method = (rg_method)k;
        s.frames = 7;
        rg_straight *f = fold_of(p, &s);
        rg_cost was = rg_straight_cost(f);
        rg_step_info i;
        do {
            assert_int_equal(rg_straight_step(f, &i), RG_OK);
            const rg_cost is = rg_straight_cost(f);
            assert_true(is.seconds >= was.seconds && is.steps >= was.steps && is.solves >= was.solves && is.assemblies >= was.assemblies);
            assert_int_equal(is.solves - was.solves, i.solves);
            was = is;
        } while (i.outcome == RG_RUNNING);
        assert_true(was.steps > 5 && was.solves > 5);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
    }
    /* Nothing to fold is no work, and all frames are there. */
    rg_settings s = rg_settings_default();
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 2, 1);
    draw(&l, 'U', 1, 0, 1, 1);
    s.frames = 5;
    rg_pattern *p = pattern_of(&l);
    rg_straight *f = fold_of(p, &s);
    rg_step_info i;
    for (int k = 0; k < 5; k++) {
        assert_true(next_frame(f, &i));
        assert_int_equal(i.frame, k);
        near(i.progress, k / 4.0, 1e-12);
    }
    assert_int_equal(rg_straight_cost(f).solves, 0);
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
}

/* It gives up after as many steps as it is allowed, whether its creases hang together or not. */
static void steps_run_out(void **state)
{
    (void)state;
    for (int apart = 0; apart < 2; apart++) {
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 3, 1);
        draw(&l, RG_VALLEY, 1, 0, 1, 1);
        draw(&l, RG_MOUNTAIN, 2, 0, 2.2, 1);
        rg_pattern *p = apart ? pattern_of(&l) : generated("miura", 4, 60);
        if (!apart) rg_lines_free(&l);
        rg_settings s = rg_settings_default();
        s.method = RG_METHOD_NEWTON;
        s.step = 0.5 * RG_DEG; /* some hundred steps */
        rg_straight *f = fold_of(p, &s);
        rg_step_info i = {.outcome = RG_RUNNING};
        int steps = 0;
        rg_straight_set_most_steps(f, 20);
        for (; i.outcome == RG_RUNNING && steps < 1000; steps++) assert_int_equal(rg_straight_step(f, &i), RG_OK);
        assert_int_equal(i.outcome, RG_STOPPED);
        assert_non_null(strstr(i.reason, "number of steps ran out"));
        assert_true(steps > 15 && steps < 30);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
    }
}

/* A crease that stays as it is neither wishes nor leans. */
static void what_stays_has_no_lean(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_pattern *p = generated("miura", 4, 60);
    const rg_plane *plane = rg_pattern_get_plane(p);
    for (int32_t e = 0; e < plane->edges; e += 2)
        if (plane->assignment[e] != RG_BORDER) assert_int_equal(rg_pattern_pin(p, e), RG_OK);
    rg_mesh m = mesh_of(p);
    rg_drive d;
    int still = 0;
    assert_non_null(m.still);
    assert_int_equal(rg_drive_init(&d, &mem, &m, 1), RG_OK);
    for (int32_t i = 0; i < m.N; i++) {
        const int is_still = m.still[m.crease_edge[i]] != 0;
        still += is_still;
        assert_int_equal(d.lean[i] == 0, is_still);
        assert_int_equal(rg_drive_is_driven(&d, i), !is_still);
    }
    assert_true(still > 3 && still < m.N - 3);
    rg_drive_free(&d);
    rg_mesh_free(&m);
    rg_pattern_destroy(p);
}

/* The paper's own method takes what a step gives as it is: its frames are off by what its steps are, those of all others
 * close. */
static void only_euler_is_left_as_it_is(void **state)
{
    (void)state;
    for (rg_method method = RG_METHOD_EULER; method <= RG_METHOD_ADAPTIVE; method++) {
        double off[2] = {0, 0};
        for (int fine = 0; fine < 2; fine++) {
            rg_pattern *p = generated("bird", 0, 0);
            rg_settings s = rg_settings_default();
            s.method = method;
            s.step = (fine ? 1.25 : 5) * RG_DEG;
            s.frames = 7;
            s.to = 0.7;
            rg_straight *f = fold_of(p, &s);
            rg_step_info i;
            while (next_frame(f, &i)) off[fine] = fmax(off[fine], i.closure);
            rg_straight_destroy(f);
            rg_pattern_destroy(p);
        }

        if (method == RG_METHOD_EULER) assert_true(off[0] > 1e-4 && off[1] > 1e-6 && off[1] < off[0] / 2);
        else below(fmax(off[0], off[1]), 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_run_out), cmocka_unit_test(only_euler_is_left_as_it_is),
        cmocka_unit_test(what_stays_has_no_lean),
        cmocka_unit_test(miura_32_is_exact_by_default),
        cmocka_unit_test(miura_is_exact_by_every_method_that_closes),
        cmocka_unit_test(a_vertex_of_four_keeps_its_ratio),
        cmocka_unit_test(all_mountain_does_not_fold_and_says_so),
        cmocka_unit_test(methods_are_of_their_order),
        cmocka_unit_test(adaptive_follows_the_same_motion),
        cmocka_unit_test(the_same_bits_twice),
        cmocka_unit_test(frames_are_read_off_a_path_that_knows_nothing_of_them),
        cmocka_unit_test(steps_allocate_nothing),
        cmocka_unit_test(memory_may_be_short),
        cmocka_unit_test(what_stops_is_closed),
        cmocka_unit_test(solvers_say_the_same),
        cmocka_unit_test(one_percent_is_one_percent),
        cmocka_unit_test(what_it_cost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
