/* scenarios.h -- hard places for a folding method, and what becomes of it there.  Include after cmocka.h, near.h, draw.h.
 *
 * A cell is one scenario by one method. Its verdict, by what was written out, not by what the method says of itself:
 *   diverged  not a number; or a crease more than 5 degrees beyond half a turn; or a vertex open by more than 0.1 rad; or an edge
 *             stretched by more than 1e-6 while all vertices close, and by more than closing to the tolerance can leave over:
 *             the tolerance times the sheet's size over the edge's length; or a state that should have come back and did not
 *   drifted   a vertex open by more than the tolerance asked for, in some frame
 *   stopped   short of the end, and said so
 *   reached */
#ifndef SCENARIOS_H
#define SCENARIOS_H

#include "base/clock.h"
#include "chart/exact.h"
#include "chart/run.h"
#include "draw.h"
#include "fold/integrate.h"
#include "fold/newton.h"
#include "motion/attempt.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { METHODS = 6 }; /* AUTO ... ADAPTIVE, as rg_method counts them; AUTO is the program as it comes */

typedef enum verdict { REACHED, STOPPED, DRIFTED, DIVERGED, NONE } verdict;

typedef struct cell {
    verdict verdict;
    double percent, closure, strain, beyond; /* of 100; rad; 1; degrees */
    double off;                              /* from where it should be, rad; NAN: not looked at */
    double seconds;
    double slenderness;                      /* the sheet's size over its shortest edge */
    char note[400];
} cell;

typedef struct scenario {
    const char *name, *what;
    rg_pattern *(*draw)(void);
    void (*run)(rg_pattern *p, rg_method method, cell *c);
    int must_not_fold;
} scenario;

static const double STABLE_TOL = 1e-10;

/* ---------------------------------------------------------------------------------------------- patterns ---- */

static inline rg_pattern *of_kind(const char *kind, int32_t n)
{
    char path[] = "/tmp/rigami-stability-XXXXXX";
    rg_reading s = rg_reading_default();
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    s.merge = 1e-9;
    const int fd = mkstemp(path);
    if (fd < 0 || rg_generate(kind, n, 0, 0, path, &why) != RG_OK || rg_pattern_read(path, &s, &p, &why) != RG_OK) {
        fprintf(stderr, "%s: %s\n", kind, why.text);
        exit(1);
    }
    close(fd);
    remove(path);
    return p;
}

/* Rays of a vertex at 0, `at[n]` degrees, `a[n]` M or V, on a disk of n corners between them. */
static inline rg_pattern *vertex(int n, const double *at, const char *a)
{
    rg_lines l = drawing();
    for (int i = 0; i < n; i++) {
        const double t = at[i] * RG_DEG, next = at[(i + 1) % n] * RG_DEG;
        draw(&l, RG_BORDER, cos(t), sin(t), cos(next), sin(next));
        draw(&l, a[i] == 'M' ? RG_MOUNTAIN : RG_VALLEY, 0, 0, cos(t), sin(t));
    }
    rg_reading s = rg_reading_default();
    s.merge = 1e-9;
    return pattern_with(&l, &s);
}

/* Miura-ori of n x n, columns `width` wide but for every third one, `narrow`; each vertex moved by up to `noise_size` of the sheet,
 * coordinates rounded to `digits` decimals (negative: not). */
static inline rg_pattern *bent_miura(int n, double width, double narrow, double noise_size, int digits)
{
    enum { MOST = 12 };
    rg_vec2 X[MOST + 1][MOST + 1];
    unsigned seed = 7;
    const double lean = 1 / tan(62.3 * RG_DEG), unit = digits < 0 ? 0 : pow(10, -digits);
    for (int r = 0; r <= n; r++) {
        double x = r % 2 * lean;
        for (int c = 0; c <= n; c++) {
            const double dx = noise_size * n * noise(&seed), dy = noise_size * n * noise(&seed);
            /* Askew, or rounding would make another Miura-ori of it. */
            X[r][c] = (rg_vec2){cos(0.3) * (x + dx) - sin(0.3) * (r + dy), sin(0.3) * (x + dx) + cos(0.3) * (r + dy)};
            if (unit > 0) X[r][c] = (rg_vec2){unit * round(X[r][c].x / unit), unit * round(X[r][c].y / unit)};
            x += c % 3 == 1 ? narrow : width;
        }
    }
    rg_lines l = drawing();
    for (int r = 0; r <= n; r++)
        for (int c = 0; c <= n; c++) {
            const int zigzag = c % 2 ? -1 : 1, right = r % 2 ? zigzag : -zigzag;
            if (c < n) draw(&l, r == 0 || r == n ? RG_BORDER : right > 0 ? RG_VALLEY : RG_MOUNTAIN, X[r][c].x, X[r][c].y, X[r][c + 1].x, X[r][c + 1].y);
            if (r < n) draw(&l, c == 0 || c == n ? RG_BORDER : zigzag > 0 ? RG_VALLEY : RG_MOUNTAIN, X[r][c].x, X[r][c].y, X[r + 1][c].x, X[r + 1][c].y);
        }
    rg_reading s = rg_reading_default();
    s.merge = 1e-9;
    return pattern_with(&l, &s);
}

static inline rg_pattern *draw_bird(void) { return of_kind("bird", 0); }
static inline rg_pattern *draw_crane(void) { return of_kind("crane", 0); }
static inline rg_pattern *draw_waterbomb(void) { return of_kind("waterbomb-base", 0); }
static inline rg_pattern *draw_miura8(void) { return bent_miura(8, 1.25, 1.25, 0, -1); }
static inline rg_pattern *draw_noisy(void) { return bent_miura(8, 1.25, 1.25, 1e-5, -1); }
static inline rg_pattern *draw_rounded(void) { return bent_miura(8, 1.25, 1.25, 0, 3); }
static inline rg_pattern *draw_slivers(void) { return bent_miura(6, 1e-3, 1e-3, 0, -1); }
static inline rg_pattern *draw_small_edges(void) { return bent_miura(6, 1.25, 1e-6, 0, -1); }
static inline rg_pattern *draw_degree4(void) { return vertex(4, (double[]){5.7, 58, 135.1, 262.8}, "MVVV"); }
static inline rg_pattern *draw_closed(void) { return vertex(4, (double[]){10, 100, 190, 280}, "VVVM"); }
static inline rg_pattern *draw_mountains(void) { return vertex(4, (double[]){5.7, 58, 135.1, 262.8}, "MMMM"); }
static inline rg_pattern *draw_not_flat(void) { return vertex(4, (double[]){5.7, 71, 152.1, 249}, "MVVV"); }
static inline rg_pattern *draw_narrow(void) { return vertex(4, (double[]){5.7, 5.8, 85.8, 265.7}, "VMVV"); }
static inline rg_pattern *draw_48(void)
{
    double at[48];
    char a[49];
    for (int i = 0; i < 48; i++) at[i] = 3.1 + 7.5 * i, a[i] = i % 2 || i == 0 ? 'M' : 'V';
    a[48] = 0;
    return vertex(48, at, a);
}

/* ---------------------------------------------------------------------------------------------- verdicts ---- */

static inline void judge(cell *c, int reached)
{
    const int open = !(c->closure <= STABLE_TOL);
    if (!(c->closure <= 0.1) || !(c->beyond <= 5) || !(c->strain <= fmax(1e-6, STABLE_TOL * c->slenderness) || open) || isnan(c->percent)) c->verdict = DIVERGED;
    else if (open) c->verdict = DRIFTED;
    else c->verdict = reached ? REACHED : STOPPED;
}

/* The settings of a column: a method and nothing else, or the program as it comes, but for what it does about facets that cross, which
 * is another matter. */
static inline rg_settings column(rg_method method, rg_triangulation t)
{
    rg_settings s = rg_settings_default();
    s.method = method;
    s.tol = STABLE_TOL;
    s.triangulate = t;
    s.contact = RG_CONTACT_REPORT;
    if (method != RG_METHOD_AUTO) s.adjust = 0;
    return s;
}

static inline void of_motion(cell *c, const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    c->percent = r->least_folded_percent;
    c->closure = r->max_closure_residual;
    c->strain = r->max_edge_strain;
    c->beyond = r->max_overfold_deg;
    c->seconds = r->seconds_total;
    judge(c, r->outcome == RG_FOLDED);
    if (r->outcome == RG_FOLDED && r->max_adjustment > 0)
        snprintf(c->note, sizeof c->note, "%.90s: by %.1e of the sheet", r->strategy, r->max_adjustment);
    else
        snprintf(c->note, sizeof c->note, "%.380s", r->outcome == RG_FOLDED ? r->strategy : r->reason);
}

static inline void fold_with(rg_pattern *p, const rg_settings *s, cell *c)
{
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    if (rg_motion_create(p, s, NULL, NULL, &m, &why) != RG_OK) {
        c->verdict = NONE;
        snprintf(c->note, sizeof c->note, "%.150s", why.text);
        return;
    }
    of_motion(c, m);
    rg_motion_destroy(m);
}

static inline void run_plain(rg_pattern *p, rg_method method, cell *c)
{
    const rg_settings s = column(method, RG_TRIANGULATE_AUTO);
    fold_with(p, &s, c);
}

static inline void run_untriangulated(rg_pattern *p, rg_method method, cell *c)
{
    const rg_settings s = column(method, RG_TRIANGULATE_NONE);
    fold_with(p, &s, c);
}

static inline void run_huge_steps(rg_pattern *p, rg_method method, cell *c)
{
    rg_settings s = column(method, RG_TRIANGULATE_AUTO);
    s.step = 30 * RG_DEG;
    s.frames = 7;
    fold_with(p, &s, c);
}

/* Twice, and the other way up: is it the same to the bit, and is the other the mirror image? */
static inline void run_twice(rg_pattern *p, rg_method method, cell *c)
{
    rg_settings s = column(method, RG_TRIANGULATE_AUTO);
    rg_motion *m[3] = {NULL, NULL, NULL};
    rg_diag why = {0, ""};
    int done = 1;
    for (int i = 0; i < 3; i++) {
        s.to = i == 2 ? -1 : 1;
        done &= rg_motion_create(p, &s, NULL, NULL, &m[i], &why) == RG_OK;
    }
    rg_sheet sheet = {0};
    if (done) sheet = *rg_motion_get_sheet(m[0]);
    int same = done;
    c->off = 0;
    for (int32_t k = 0; done && k < s.frames; k++) {
        const double *a = rg_motion_angles(m[0], k), *b = rg_motion_angles(m[1], k), *d = rg_motion_angles(m[2], k);
        if (!a || !b || !d) { same = 0; break; }
        same &= memcmp(a, b, (size_t)sheet.creases * sizeof *a) == 0;
        for (int32_t i = 0; i < sheet.creases; i++) c->off = fmax(c->off, fabs(a[i] + d[i]));
    }
    if (done) of_motion(c, m[0]);
    else c->verdict = NONE;
    snprintf(c->note, sizeof c->note, "%s; %d creases on the wrong side; mirrored off by %.0e", same ? "same bits twice" : "NOT the same twice",
             done ? (int)rg_motion_report(m[0])->wrong_side_creases : -1, c->off);
    if (done && !same) c->verdict = DIVERGED;
    for (int i = 0; i < 3; i++) rg_motion_destroy(m[i]);
}

/* ---------------------------------------------------------------------------- from and to where rg_straight is ---- */

static inline double largest_angle(const rg_straight *f)
{
    double far = 0;
    for (int32_t i = 0; i < f->mesh.N; i++) far = fmax(far, fabs(f->rho[i]));
    return far;
}

/* What a state of f's adds to the cell. */
static inline void look(cell *c, rg_straight *f)
{
    const double closure = rg_constraint_closure(&f->K, f->rho, NULL);
    if (!(closure <= c->closure)) c->closure = closure;
    c->beyond = fmax(c->beyond, (largest_angle(f) - RG_PI) / RG_DEG);
    if (isnan(closure)) c->percent = NAN;
}

static inline rg_straight *fold_of(const rg_pattern *p, rg_method method, int32_t frames)
{
    rg_settings s = column(method, RG_TRIANGULATE_NONE);
    rg_straight *f = NULL;
    rg_diag why = {0, ""};
    s.frames = frames;
    if (rg_straight_create(p, &s, &f, &why) != RG_OK) {
        fprintf(stderr, "%s\n", why.text);
        exit(1);
    }
    return f;
}

/* On from where f is. Non-zero: to its end. */
static inline int run_on(rg_straight *f, cell *c)
{
    rg_step_info info = {0};
    while (info.outcome == RG_RUNNING) {
        rg_straight_step(f, &info);
        if (info.frame >= 0) look(c, f);
    }
    return info.outcome == RG_FOLDED;
}

/* Starts not at flat but 1e-6 rad from it, on the exact path; frames against the closed form. */
static inline void run_near_flat(rg_pattern *p, rg_method method, cell *c)
{
    rg_straight *f = fold_of(p, method, 60);
    rg_exact x;
    const double begun = rg_seconds(), s0 = 1e-6 / RG_PI;
    double *truth = calloc((size_t)f->mesh.N, sizeof *truth);
    assert_true(truth && rg_exact_init(&x, &f->mem, &f->mesh) == RG_OK && x.found);
    rg_exact_at(&x, &f->drive, s0, f->rho);
    f->s = rg_drive_progress(&f->drive, f->rho);
    f->steps = 2;
    f->frame = 1;
    if (f->smooth && rg_integrate_tangent(f, f->rho, f->s, 0, f->t) > 0) {
        rg_path_insert(&f->path, f->s, f->rho, f->t);
        f->h = f->s;
        f->order = 1;
    } else {
        f->smooth = 0;
    }
    rg_step_info info = {0};
    while (info.outcome == RG_RUNNING) {
        rg_straight_step(f, &info);
        if (info.frame < 0) continue;
        look(c, f);
        rg_exact_at(&x, &f->drive, rg_straight_frame_progress(f, info.frame), truth);
        if (isnan(c->off)) c->off = 0;
        for (int32_t i = 0; i < f->mesh.N; i++) c->off = fmax(c->off, fabs(f->rho[i] - truth[i]));
    }
    c->percent = 100 * f->s;
    c->seconds = rg_seconds() - begun;
    judge(c, info.outcome == RG_FOLDED);
    if (c->verdict == REACHED && !(c->off <= 1e-6)) c->verdict = DIVERGED;
    snprintf(c->note, sizeof c->note, "off the closed form by %.1e rad", c->off);
    free(truth);
    rg_exact_free(&x);
    rg_straight_destroy(f);
}

/* One step back from f->rho by ds, by the method's formula. Zero: it does not close. */
static inline int step_back(rg_straight *f, double ds)
{
    const int32_t N = f->mesh.N;
    const double s = f->s - ds;
    rg_cg_report rep;
    if (f->s > 1 - 1e-9) { /* folded flat is as singular as flat: the wish, projected there, and closed */
        rg_constraint_assemble(&f->K, f->rho);
        rg_project_renew(&f->P);
        if (rg_project_step(&f->P, &f->K, f->rho, 0, NULL, f->t, 1e-10, &rep) != RG_OK) return 0;
        const double along = rg_drive_progress(&f->drive, f->t);
        for (int32_t i = 0; i < N; i++) f->t[i] /= along;
    } else if (!(rg_integrate_tangent(f, f->rho, f->s, 0, f->t) > 0)) {
        return 0;
    }
    if (f->settings.method != RG_METHOD_EULER && s <= 0) { /* as rg_straight lands on the folded state if that is straight ahead */
        double missed = 0, left = 0;
        for (int32_t i = 0; i < N; i++) {
            missed += (f->rho[i] - f->s * f->t[i]) * (f->rho[i] - f->s * f->t[i]);
            left += f->rho[i] * f->rho[i];
        }
        if (missed <= 0.01 * left) {
            memset(f->rho, 0, (size_t)N * sizeof *f->rho);
            f->s = 0;
            return 1;
        }
    }
    if (f->settings.method == RG_METHOD_EULER) { /* eq. (14): the residual is fed back, nothing is closed */
        for (int32_t i = 0; i < N; i++) f->wish[i] = -ds * f->t[i];
        if (rg_project_step(&f->P, &f->K, f->wish, 1, NULL, f->t, 1e-10, &rep) != RG_OK) return 0;
        for (int32_t i = 0; i < N; i++) f->rho[i] += f->t[i];
        f->s = rg_drive_progress(&f->drive, f->rho);
        return fabs(f->s - s) <= 0.5 * ds;
    }
    const int higher = f->s > 1 - 1e-9 || s <= 0 ? 0 : f->settings.method == RG_METHOD_HEUN ? rg_integrate_heun(f, -ds)
                       : f->settings.method == RG_METHOD_RK4 ? rg_integrate_rk4(f, -ds) : 0;
    if (!higher) {
        for (int32_t i = 0; i < N; i++) f->trial[i] = f->rho[i] - ds * f->t[i];
        if (!rg_newton_correct(f, fmax(s, 0), 24)) return 0;
    }
    memcpy(f->rho, f->trial, (size_t)N * sizeof *f->rho);
    f->s = s;
    return 1;
}

/* From folded to flat: by the method's own steps, or, for those that have none backwards, as the program goes between
 * states. mid[N]: out, half way, where that is passed. Non-zero: flat was reached; f->rho is what it is there. */
static inline int go_back(rg_straight *f, int steps, double *mid, cell *c)
{
    if (f->settings.method == RG_METHOD_ADAPTIVE) {
        rg_attempt t;
        rg_mesh m;
        rg_watch watch = {0};
        rg_diag why = {0, ""};
        double *flat = calloc((size_t)f->mesh.N, sizeof *flat);
        const rg_relaxed_try stiff = {.from = f->rho, .target = flat, .budget = 60};
        rg_settings s = f->settings;
        s.frames = steps + 1;
        int there = flat && rg_mesh_copy(&f->mesh, &m) == RG_OK &&
                    rg_attempt_relaxed(&t, &m, &s, &stiff, &watch, &why) == RG_OK;
        there = there && rg_attempt_read(&t, &s) == RG_OK;
        free(flat);
        if (!there) return 0;
        for (int32_t k = 0; k < t.count; k++) {
            memcpy(f->rho, t.rho + (size_t)k * (size_t)f->mesh.N, (size_t)f->mesh.N * sizeof *f->rho);
            if (k == steps / 2) memcpy(mid, f->rho, (size_t)f->mesh.N * sizeof *mid);
            look(c, f);
        }
        there = t.outcome == RG_FOLDED;
        rg_attempt_free(&t);
        return there;
    }
    for (int k = steps - 1; k >= 0; k--) {
        const double s = (double)k / steps;
        if (!step_back(f, f->s - s)) return 0;
        if (k == steps / 2) memcpy(mid, f->rho, (size_t)f->mesh.N * sizeof *mid);
        look(c, f);
    }
    return 1;
}

static inline void cycle(rg_pattern *p, rg_method method, int cycles, cell *c)
{
    const double begun = rg_seconds();
    const int steps = 24;
    rg_straight *f = fold_of(p, method, steps + 1);
    const size_t bytes = (size_t)f->mesh.N * sizeof(double);
    double *mid = calloc(1, bytes), *first = calloc(1, bytes);
    double flat = 0;
    int n = 0, good = mid && first;
    c->off = 0;
    for (; good && n < cycles; n++) {
        if (n > 0) { /* from the flat state that came back, whatever it is */
            rg_straight *next = fold_of(p, method, steps + 1);
            memcpy(next->rho, f->rho, bytes);
            rg_straight_destroy(f);
            f = next;
        }
        if (!run_on(f, c)) break;
        c->percent = 100 * rg_drive_progress(&f->drive, f->rho);
        if (!go_back(f, steps, mid, c)) break;
        if (n == 0) memcpy(first, mid, bytes);
        flat = fmax(flat, largest_angle(f));
        for (int32_t i = 0; i < f->mesh.N; i++) c->off = fmax(c->off, fabs(mid[i] - first[i]));
    }
    c->seconds = rg_seconds() - begun;
    judge(c, n == cycles);
    if (n == cycles && c->verdict == REACHED && (flat > 1e-6 || c->off > 1e-6)) c->verdict = DIVERGED;
    if (n < cycles) c->percent = 100.0 * n / cycles;
    snprintf(c->note, sizeof c->note, "%d of %d there and back; flat to %.0e rad; half way the same to %.0e rad", n, cycles, flat, c->off);
    free(mid);
    free(first);
    rg_straight_destroy(f);
}

static inline void run_back(rg_pattern *p, rg_method method, cell *c) { cycle(p, method, 1, c); }
static inline void run_500(rg_pattern *p, rg_method method, cell *c) { cycle(p, method, 500, c); }

static const scenario scenarios[] = {
    {"flat start", "bird base, exactly flat: C loses a rank at every vertex", draw_bird, run_plain, 0},
    {"flat start, over-constrained", "Miura 8 x 8: 147 equations for 112 angles", draw_miura8, run_plain, 0},
    {"1e-6 from flat", "Miura 8 x 8, from 1e-6 rad on the exact path", draw_miura8, run_near_flat, 0},
    {"flat-folded and back", "bird base, folded and unfolded", draw_bird, run_back, 0},
    {"closed vertex", "right angles, valley valley valley mountain (section 3.1)", draw_closed, run_plain, 0},
    {"all mountains", "four creases, all mountain: cannot fold", draw_mountains, run_plain, 1},
    {"bifurcation", "waterbomb base: one way of two, twice and mirrored", draw_waterbomb, run_twice, 0},
    {"over-constrained", "crane, no creases added: cannot fold rigidly", draw_crane, run_untriangulated, 1},
    {"not flat-foldable", "four creases against Kawasaki's theorem: cannot fold flat", draw_not_flat, run_plain, 1},
    {"noise 1e-5", "Miura 8 x 8, every vertex moved by 1e-5 of the sheet", draw_noisy, run_plain, 0},
    {"three decimals", "Miura 8 x 8, coordinates rounded to 3 decimals", draw_rounded, run_plain, 0},
    {"sectors of 0.1 degree", "a vertex of 0.1, 80, 179.9, 100 degrees", draw_narrow, run_plain, 0},
    {"48 creases", "a vertex of 48 creases", draw_48, run_plain, 0},
    {"slivers", "Miura 6 x 6, facets a thousand times as long as wide", draw_slivers, run_plain, 0},
    {"edges of 1e-6", "Miura 6 x 6, columns 1e-6 wide beside columns of 1.25", draw_small_edges, run_plain, 0},
    {"steps of 30 degrees", "bird base in 6 steps", draw_bird, run_huge_steps, 0},
    {"500 cycles", "a vertex of four creases folded and unfolded 500 times", draw_degree4, run_500, 0},
};
enum { SCENARIOS = sizeof scenarios / sizeof *scenarios };

static inline cell try_cell(const scenario *s, rg_method method)
{
    cell c = {.verdict = NONE, .off = NAN};
    rg_pattern *p = s->draw();
    rg_mesh m = {0};
    rg_memory mem = rg_mem_default(NULL);
    rg_diag why = {0, ""};
    if (rg_mesh_from_pattern(p, &mem, &m, &why) == RG_OK)
        for (int32_t e = 0; e < m.ne; e++)
            c.slenderness = fmax(c.slenderness, m.size / rg_vec2_length(rg_vec2_sub(m.X[m.edge[e][0]], m.X[m.edge[e][1]])));
    rg_mesh_free(&m);
    s->run(p, method, &c);
    rg_pattern_destroy(p);
    return c;
}

static inline const char *verdict_name(verdict v)
{
    static const char *const names[] = {"reached", "stopped", "drifted", "diverged", "no run"};
    return names[v];
}

#endif
