/* motion/steering.c, stepping.c, keeping.c: folds that are moved, steered, kept and taken back in any order. Whatever was asked for, the
 * present state closes, what is told of it fits, and a clone goes the same way. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"
#include "rigami.h"

/* Within the engine's own bound past half a turn, radians. */
static const double MOST = 3.14159265358979323846 * (1 + 1.01 / 180);

enum { WALKS = 400, MOVES = 60, CREASES = 200 };

typedef struct walk {
    uint64_t random; /* xorshift's state */
    rg_fold *f;
    rg_snapshot *kept;
    int32_t N;
    double then[CREASES]; /* the angles that were kept */
    char told[8 * MOVES]; /* the moves so far */
} walk;

static int32_t draw(walk *w, int32_t n)
{
    w->random ^= w->random << 13, w->random ^= w->random >> 7, w->random ^= w->random << 17;
    return (int32_t)((w->random >> 33) % (uint64_t)n);
}

static double part(walk *w) { return draw(w, 1000001) / 1e6; }

static size_t bytes(const walk *w) { return (size_t)w->N * sizeof(double); }

static void as_the_clone(walk *w)
{
    rg_fold *g = NULL;
    assert_int_equal(rg_fold_clone(w->f, &g), RG_OK);
    for (int k = 0; k < 2; k++) {
        if (memcmp(rg_fold_angles(g, NULL), rg_fold_angles(w->f, NULL), bytes(w)) != 0) fail_msg("the clone is elsewhere:%s", w->told);
        rg_fold_step(g);
        rg_fold_step(w->f);
    }
    rg_fold_destroy(g);
}

static void as_the_record(walk *w)
{
    rg_motion *m = NULL;
    assert_int_equal(rg_fold_record(w->f, &m, NULL), RG_OK);
    const rg_report *r = rg_motion_report(m);
    if (r->frame_count != rg_fold_get_info(w->f)->frames || !(r->max_closure_residual <= 1.01e-10)) fail_msg("the record is another:%s", w->told);
    for (int32_t k = 1; strcmp(r->method, "steered") == 0 && k < r->frame_count; k++)
        if (!(r->frames[k].percent <= 100 + 1e-9)) fail_msg("%g %%:%s", r->frames[k].percent, w->told);
    rg_motion_destroy(m);
}

static void keep(walk *w)
{
    rg_snapshot_destroy(w->kept);
    w->kept = NULL;
    assert_int_equal(rg_fold_snapshot(w->f, &w->kept), RG_OK);
    memcpy(w->then, rg_fold_angles(w->f, NULL), bytes(w));
}

static void move(walk *w)
{
    static const char *const names[] = {"step", "back", "ten", "go", "angle", "drive", "near", "target", "pin", "forget", "keep", "restore", "clone", "record"};
    const int what = draw(w, 14);
    const int32_t c[3] = {draw(w, w->N), draw(w, w->N), draw(w, w->N)};
    const double a[3] = {6.28 * (part(w) - 0.5), 6.28 * (part(w) - 0.5), 3 * (part(w) - 0.5)};
    strcat(strcat(w->told, " "), names[what]);
    switch (what) {
    case 0: rg_fold_step(w->f); break;
    case 1: rg_fold_step_back(w->f); break;
    case 2: for (int k = 0; k < 10; k++) rg_fold_step(w->f); break;
    case 3: assert_int_equal(rg_fold_go_to(w->f, 100 * part(w)), RG_OK); break;
    case 4: assert_in_range(rg_fold_go_to_angle(w->f, c[0], a[0]), RG_OK, RG_EARG); break;
    case 5: assert_int_equal(rg_fold_drive(w->f, 1 + draw(w, 3), c, a), RG_OK); break;
    case 6: assert_int_equal(rg_fold_drive(w->f, 1, c, (const double[]){0.9 * rg_fold_angles(w->f, NULL)[c[0]]}), RG_OK); break;
    case 7: assert_int_equal(rg_fold_set_target(w->f, c[0], draw(w, 2) ? RG_FREE : a[0]), RG_OK); break;
    case 8: if (draw(w, 3) == 0) assert_int_equal(rg_fold_pin(w->f, c[0]), RG_OK); break;
    case 9: if (draw(w, 3) == 0) assert_int_equal(rg_fold_forget(w->f), RG_OK); break;
    case 10: keep(w); break;
    case 11:
        if (w->kept) assert_int_equal(rg_fold_restore(w->f, w->kept), RG_OK);
        if (w->kept && memcmp(w->then, rg_fold_angles(w->f, NULL), bytes(w)) != 0) fail_msg("restored otherwise:%s", w->told);
        break;
    case 12: as_the_clone(w); break;
    default: if (draw(w, 4) == 0) as_the_record(w);
    }
}

static void look(const walk *w)
{
    const rg_step_info *i = rg_fold_get_info(w->f);
    const double *rho = rg_fold_angles(w->f, NULL);
    if (!(i->closure <= 1.01e-10)) fail_msg("closed to %g:%s", i->closure, w->told);
    if (i->frame < -1 || i->frame >= i->frames || !(i->progress >= -1 && i->progress <= 1 + 1e-12))
        fail_msg("frame %d of %d, progress %g:%s", (int)i->frame, (int)i->frames, i->progress, w->told);
    if ((i->outcome == RG_RUNNING) != (i->reason[0] == 0)) fail_msg("outcome %d, reason \"%s\":%s", i->outcome, i->reason, w->told);
    for (int32_t k = 0; k < w->N; k++)
        if (!(fabs(rho[k]) <= MOST)) fail_msg("crease %d at %g:%s", (int)k, rho[k], w->told);
}

static void in_any_order(void **state)
{
    (void)state;
    static const struct { const char *kind; int32_t n; } of[] = {{"miura", 3}, {"bird", 0}, {"fish", 0}, {"waterbomb", 2}, {"closed-split", 0},
                                                                 {"waterbomb-base", 0}, {"tatou", 0}, {"preliminary", 0}};
    for (int k = 0; k < WALKS; k++) {
        walk w = {.random = 88172645463325252u + 7919u * (uint64_t)k};
        rg_settings s = rg_settings_default();
        rg_pattern *p = NULL;
        for (int j = 0; j < 20; j++) draw(&w, 2);
        s.frames = 2 + draw(&w, 15);
        s.contact = RG_CONTACT_IGNORE;
        s.effort = RG_EFFORT_FAST;
        if (draw(&w, 4) == 0) s.triangulate = RG_TRIANGULATE_ALL;
        const int which = draw(&w, sizeof of / sizeof *of);
        assert_int_equal(rg_generate_pattern(of[which].kind, of[which].n, 0, 0, NULL, &p, NULL), RG_OK);
        assert_int_equal(draw(&w, 3) ? rg_fold_create_flat(p, &s, &w.f, NULL) : rg_fold_create(p, &s, NULL, NULL, &w.f, NULL), RG_OK);
        rg_pattern_destroy(p);
        w.N = rg_motion_get_sheet(rg_fold_motion(w.f))->creases;
        assert_in_range(w.N, 1, CREASES);
        for (int j = 0; j < MOVES; j++) {
            move(&w);
            look(&w);
        }
        rg_snapshot_destroy(w.kept);
        rg_fold_destroy(w.f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(in_any_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
