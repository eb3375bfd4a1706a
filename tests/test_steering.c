/* motion/steering.c, stepping.c, keeping.c: a fold that is driven, taken back, kept and cloned. */
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

static rg_pattern *generated(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines l;
    assert_int_equal(rg_generate_lines(kind, n, 0, 0, &mem, &l, NULL), RG_OK);
    return pattern_of(&l);
}

static rg_fold *flat_fold(const rg_pattern *p, int32_t frames)
{
    rg_settings s = rg_settings_default();
    rg_fold *f = NULL;
    s.frames = frames;
    assert_int_equal(rg_fold_create_flat(p, &s, &f, NULL), RG_OK);
    return f;
}

static rg_fold *found_fold(const rg_pattern *p, int32_t frames)
{
    rg_settings s = rg_settings_default();
    rg_fold *f = NULL;
    s.frames = frames;
    s.contact = RG_CONTACT_REPORT;
    assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f, NULL), RG_OK);
    return f;
}

static char letter(const rg_fold *f, int32_t c)
{
    const rg_sheet *s = rg_motion_get_sheet(rg_fold_motion(f));
    return s->assignment[s->crease_edge[c]];
}

/* ------------------------------------------------------------------------------------------ against the closed form ---- */

/* Zigzag creases of a Miura-ori turn by one angle, straight ones by another: tan(straight / 2) = cos(60 degrees) tan(zigzag / 2). Which is
 * which is told by the largest angle of the first frame. */
static void follows_the_closed_form(const rg_fold *f, int32_t driven, double angle, int driven_is_steep)
{
    int32_t N;
    const double *rho = rg_fold_angles(f, &N);
    const double own = tan(fabs(angle) / 2), steep = driven_is_steep ? own : 2 * own, shallow = steep / 2;
    int32_t of_each[2] = {0, 0};
    near(rho[driven], angle, 1e-15);
    for (int32_t i = 0; i < N; i++) {
        const double t = fabs(rho[i]), is_steep = fabs(t - 2 * atan(steep)) < fabs(t - 2 * atan(shallow));
        near(t, 2 * atan(is_steep ? steep : shallow), 1e-10);
        assert_true(rho[i] * angle * (letter(f, i) == letter(f, driven) ? 1 : -1) > 0);
        of_each[is_steep != 0]++;
    }
    assert_true(of_each[0] > 0 && of_each[1] > 0);
}

static void one_crease_of_a_miura_ori(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 6);
    for (int32_t driven = 0; driven < 60; driven += 7)
        for (int against = 0; against < 2; against++) {
            rg_fold *f = flat_fold(p, 61);
            const double sign = (letter(f, driven) == 'V') != against ? 1 : -1, to = sign * 60 * RG_DEG;
            assert_int_equal(rg_fold_drive(f, 1, &driven, &to), RG_OK);
            int32_t frames = 1;
            const rg_step_info *i;
            int steep = -1;
            do {
                i = rg_fold_step(f);
                const double angle = to * i->frame / 60;
                assert_int_equal(i->frame, frames++);
                near(i->progress, i->frame / 60.0, 1e-15);
                below(i->closure, 1e-10);
                if (steep < 0) {
                    double most = 0;
                    for (int32_t c = 0; c < 60; c++) most = fmax(most, fabs(rg_fold_angles(f, NULL)[c]));
                    steep = most < 1.5 * fabs(angle);
                }
                follows_the_closed_form(f, driven, angle, steep);
            } while (i->outcome == RG_RUNNING);
            assert_int_equal(i->outcome, RG_FOLDED);
            assert_int_equal(frames, 61);
            rg_fold_destroy(f);
        }
    rg_pattern_destroy(p);
}

/* There and back to flat by driving, and on to the other side of the paper. */
static void back_through_flat(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    rg_fold *f = flat_fold(p, 21);
    const int32_t c = 0;
    const double there = 50 * RG_DEG, half = 20 * RG_DEG;
    assert_int_equal(rg_fold_drive(f, 1, &c, &there), RG_OK);
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    assert_int_equal(rg_fold_drive(f, 1, &c, &half), RG_OK);
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    near(rg_fold_angles(f, NULL)[c], half, 1e-15);
    follows_the_closed_form(f, c, half, rg_fold_angles(f, NULL)[c] > fabs(rg_fold_angles(f, NULL)[6]) - 1e-9);
    assert_int_equal(rg_fold_get_info(f)->frames, 41);
    for (int k = 0; k < 40; k++) rg_fold_step_back(f);
    int32_t N, nv;
    const double *rho = rg_fold_angles(f, &N);
    for (int32_t i = 0; i < N; i++) near(rho[i], 0, 0);
    const double (*x)[3] = rg_fold_positions(f, &nv);
    for (int32_t v = 0; v < nv; v++) near(x[v][2], 0, 0);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* To and fro with a slider, for as long as it likes: nothing is kept, and nothing is asked for, of all that was passed. */
static void to_and_fro(void **state)
{
    (void)state;
    counted c = {1000000000, 0, 0};
    const rg_memory mem = {counted_resize, &c};
    rg_settings s = rg_settings_default();
    rg_pattern *p = generated("miura", 4);
    rg_fold *f = NULL;
    const int32_t crease = 0;
    s.frames = 2;
    s.memory = &mem;
    assert_int_equal(rg_fold_create_flat(p, &s, &f, NULL), RG_OK);
    long asked = 0;
    for (int k = 0; k < 200; k++) {
        const double to = (letter(f, crease) == 'V' ? 1 : -1) * (35 - 30 * cos(0.3 * k)) * RG_DEG;
        assert_int_equal(rg_fold_drive(f, 1, &crease, &to), RG_OK);
        while (rg_fold_step(f)->outcome == RG_RUNNING) {}
        assert_int_equal(rg_fold_get_info(f)->outcome, RG_FOLDED);
        near(rg_fold_angles(f, NULL)[crease], to, 1e-15);
        follows_the_closed_form(f, crease, to, fabs(to) > fabs(rg_fold_angles(f, NULL)[6]) - 1e-9);
        const double *now = rg_fold_angles(f, NULL), before = now[6];
        assert_int_equal(rg_fold_forget(f), RG_OK);
        near(now[6], before, 0);
        assert_int_equal(rg_fold_get_info(f)->frames, 1);
        assert_int_equal(rg_fold_get_info(f)->frame, 0);
        if (k == 1) asked = c.asked;
    }
    assert_int_equal(c.asked, asked);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* Nothing was set: what the pattern aims at leads to its end, folded flat, whatever the last step takes past half a turn. */
static void flat_paper_to_its_end(void **state)
{
    (void)state;
    static const char *const kinds[] = {"miura", "bird", "fish", "yoshimura", "waterbomb-base"};
    for (int k = 0; k < 5; k++)
        for (int32_t frames = 11; frames <= 61; frames += 50) {
            rg_pattern *p = generated(kinds[k], 0);
            rg_fold *f = flat_fold(p, frames);
            while (rg_fold_step(f)->outcome == RG_RUNNING) below(rg_fold_get_info(f)->closure, 1e-10);
            assert_int_equal(rg_fold_get_info(f)->outcome, RG_FOLDED);
            assert_int_equal(rg_fold_get_info(f)->frames, frames);
            int32_t N;
            const double *rho = rg_fold_angles(f, &N);
            for (int32_t i = 0; i < N; i++) near(rho[i], letter(f, i) == 'V' ? RG_PI : -RG_PI, 1e-12);
            rg_fold_destroy(f);
            rg_pattern_destroy(p);
        }
}

/* Two creases of a waterbomb that cannot go together while a third is held: a crease turned right round closes as well, and is no way off the flat sheet. */
static void not_by_a_whole_turn(void **state)
{
    (void)state;
    rg_pattern *p = generated("waterbomb", 2);
    rg_fold *f = flat_fold(p, 10);
    const int32_t both[2] = {28, 13};
    const double to[2] = {-0.86637, 2.56752};
    int32_t N;
    assert_int_equal(rg_fold_drive(f, 2, both, to), RG_OK);
    assert_int_equal(rg_fold_pin(f, 8), RG_OK);
    do {
        const double *rho = rg_fold_angles(f, &N);
        for (int32_t i = 0; i < N; i++) below(fabs(rho[i]), RG_PI + 1e-9);
    } while (rg_fold_step(f)->outcome == RG_RUNNING);
    const double *rho = rg_fold_angles(f, &N);
    for (int32_t i = 0; i < N; i++) below(fabs(rho[i]), RG_PI + 1e-9);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* Forgotten on the way, between two states and of a motion that was found: it goes on to what it aimed at. */
static void forgotten_on_the_way(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    for (int found = 0; found < 2; found++) {
        rg_fold *f = found ? found_fold(p, 11) : flat_fold(p, 11);
        const int32_t crease = 0;
        const double to = (letter(f, crease) == 'V' ? 1 : -1) * 70 * RG_DEG;
        if (!found) assert_int_equal(rg_fold_drive(f, 1, &crease, &to), RG_OK);
        assert_int_equal(rg_fold_go_to(f, 37), RG_OK);
        const double there = rg_fold_angles(f, NULL)[crease];
        assert_int_equal(rg_fold_forget(f), RG_OK);
        near(rg_fold_angles(f, NULL)[crease], there, 0);
        rg_fold_step_back(f);
        near(rg_fold_angles(f, NULL)[crease], there, 0);
        while (rg_fold_step(f)->outcome == RG_RUNNING) below(rg_fold_get_info(f)->closure, 1e-10);
        assert_int_equal(rg_fold_get_info(f)->outcome, RG_FOLDED);
        if (!found) near(rg_fold_angles(f, NULL)[crease], to, 1e-15);
        assert_int_equal(rg_fold_get_info(f)->frames, 11);
        rg_fold_destroy(f);
    }
    rg_pattern_destroy(p);
}

/* ---------------------------------------------------------------------------------------------- aims and pins ---- */

static void targets_pins_and_free_creases(void **state)
{
    (void)state;
    rg_pattern *p = generated("waterbomb", 2);
    rg_fold *f = flat_fold(p, 11);
    int32_t N;
    const double *rho = rg_fold_angles(f, &N);
    assert_int_equal(rg_fold_set_target(f, N, 1), RG_EARG);
    assert_int_equal(rg_fold_set_target(f, 0, 4), RG_EARG);
    assert_int_equal(rg_fold_set_target(f, 0, NAN), RG_EARG);
    assert_int_equal(rg_fold_pin(f, -1), RG_EARG);
    assert_int_equal(rg_fold_drive(f, 0, NULL, NULL), RG_EARG);
    for (int k = 0; k < 4; k++) rg_fold_step(f);
    assert_true(rg_fold_get_info(f)->outcome == RG_RUNNING);
    const double kept = rho[3];
    assert_true(fabs(kept) > 0.1);
    assert_int_equal(rg_fold_pin(f, 3), RG_OK);
    for (int32_t i = 0; i < N; i++)
        if (i != 3) assert_int_equal(rg_fold_set_target(f, i, i % 2 ? RG_FREE : rho[i] + 0.05 * (rho[i] > 0 ? 1 : -1)), RG_OK);
    const double before = rg_fold_angles(f, NULL)[0];
    while (rg_fold_step(f)->outcome == RG_RUNNING) {
        near(rg_fold_angles(f, NULL)[3], kept, 0);
        below(rg_fold_get_info(f)->closure, 1e-10);
    }
    assert_true(fabs(rg_fold_angles(f, NULL)[0] - before) > 1e-3);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* Two at once: as the sheet has them they go; otherwise they stop where the facets no longer give, and say what is held. */
static void a_group(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    for (int fits = 0; fits < 2; fits++) {
        rg_fold *f = flat_fold(p, 13);
        int32_t both[2] = {0, 1};
        const rg_step_info *i;
        const double first = 40 * RG_DEG;
        assert_int_equal(rg_fold_drive(f, 1, both, &first), RG_OK);
        rg_fold_step(f);
        for (int32_t c = 1; c < 24; c++) /* one that turns as far */
            if (fabs(fabs(rg_fold_angles(f, NULL)[c]) - fabs(rg_fold_angles(f, NULL)[0])) < 1e-6) both[1] = c;
        const double side = rg_fold_angles(f, NULL)[both[1]] > 0 ? 1 : -1, to[2] = {first, side * (fits ? 40 : 15) * RG_DEG};
        rg_fold_step_back(f);
        assert_int_equal(rg_fold_drive(f, 2, both, to), RG_OK);
        while ((i = rg_fold_step(f))->outcome == RG_RUNNING) {
            for (int k = 0; k < 2; k++) near(rg_fold_angles(f, NULL)[both[k]], to[k] * i->progress, 1e-15);
            below(i->closure, 1e-10);
        }
        assert_int_equal(i->outcome, fits ? RG_FOLDED : RG_STOPPED);
        if (!fits) assert_true(i->reason[0] && i->blocking_crease_count == 2 && i->blocking_vertex_count > 0);
        rg_fold_destroy(f);
    }
    rg_pattern_destroy(p);
}

/* From the middle of a motion on whose way the pattern moved: the crease goes where it is driven, on the pattern as it is there. */
static void from_a_moved_pattern(void **state)
{
    (void)state;
    rg_pattern *p = generated("closed-adjust", 0);
    rg_settings s = rg_settings_default();
    rg_fold *f = NULL;
    s.frames = 11;
    s.contact = RG_CONTACT_REPORT;
    s.triangulate = RG_TRIANGULATE_NONE;
    assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f, NULL), RG_OK);
    for (int k = 0; k < 4; k++) rg_fold_step(f);
    int32_t N, nv;
    const double *rho = rg_fold_angles(f, &N);
    const double (*X)[2] = rg_fold_flat(f, &nv);
    double *was = malloc((size_t)nv * sizeof *X);
    memcpy(was, X, (size_t)nv * sizeof *X);
    int32_t c = 0;
    for (int32_t i = 0; i < N; i++)
        if (fabs(rho[i]) > fabs(rho[c])) c = i;
    const double to = 0.9 * rho[c];
    assert_int_equal(rg_fold_drive(f, 1, &c, &to), RG_OK);
    while (rg_fold_step(f)->outcome == RG_RUNNING) below(rg_fold_get_info(f)->closure, 1e-10);
    if (rg_fold_get_info(f)->outcome == RG_FOLDED) near(rg_fold_angles(f, NULL)[c], to, 1e-15);
    assert_memory_equal(rg_fold_flat(f, NULL), was, (size_t)nv * sizeof *X);
    assert_true(rg_fold_get_info(f)->frame > 4);
    free(was);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* A crease that cannot turn says so, with what holds it. */
static void a_locked_crease(void **state)
{
    (void)state;
    rg_pattern *p = generated("closed-adjust", 0);
    rg_fold *f = flat_fold(p, 11);
    const rg_sheet *s = rg_motion_get_sheet(rg_fold_motion(f));
    const rg_closed *closed;
    const rg_step_info *i;
    assert_true(rg_pattern_closed(p, &closed) > 0);
    int32_t c = -1;
    for (int32_t k = 0; k < s->creases && c < 0; k++)
        if (s->ends[s->crease_edge[k]][0] == closed[0].vertex || s->ends[s->crease_edge[k]][1] == closed[0].vertex) c = k;
    const double to = letter(f, c) == 'V' ? 1 : -1;
    assert_int_equal(rg_fold_drive(f, 1, &c, &to), RG_OK);
    while ((i = rg_fold_step(f))->outcome == RG_RUNNING) {}
    assert_int_equal(i->outcome, RG_STOPPED);
    assert_true(i->reason[0] && i->blocking_crease_count == 1 && i->blocking_creases[0] == c);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* Pinned in the pattern, a crease stays flat whatever folds it: straight on, or with facets cut. */
static void pinned_before_the_search(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 3);
    const rg_plane *plane = rg_pattern_get_plane(p);
    int32_t e = 0;
    while (plane->assignment[e] == 'B') e++;
    assert_int_equal(rg_pattern_pin(p, e), RG_OK);
    rg_fold *f = found_fold(p, 9);
    const int32_t c = rg_motion_get_sheet(rg_fold_motion(f))->edge_crease[e];
    int32_t N;
    double moved = 0;
    for (const rg_step_info *i = rg_fold_get_info(f);; i = rg_fold_step(f)) {
        const double *rho = rg_fold_angles(f, &N);
        near(rho[c], 0, 0);
        for (int32_t k = 0; k < N; k++) moved = fmax(moved, fabs(rho[k]));
        if (i->outcome != RG_RUNNING) break;
    }
    assert_true(moved > 0.5);
    rg_fold_destroy(f);
    /* Free, it follows. */
    assert_int_equal(rg_pattern_set_target(p, e, RG_FREE), RG_OK);
    f = found_fold(p, 9);
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    assert_int_equal(rg_fold_get_info(f)->outcome, RG_FOLDED);
    near(fabs(rg_fold_angles(f, NULL)[c]), RG_PI, 1e-6);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* --------------------------------------------------------------------------------------------- anywhere on the track ---- */

static const char *const KINDS[] = {"miura", "bird", "frog", "closed-adjust", "hypar"};

static void between_frames(void **state)
{
    (void)state;
    for (int kind = 0; kind < 5; kind++) {
        rg_pattern *p = generated(KINDS[kind], 0);
        rg_fold *f = found_fold(p, 30);
        const rg_report *r = rg_motion_report(rg_fold_motion(f));
        int32_t N;
        for (double percent = 1.3; percent < r->folded_percent; percent += 9.7) {
            assert_int_equal(rg_fold_go_to(f, percent), RG_OK);
            near(rg_fold_get_info(f)->progress, percent / 100, 1e-11);
            below(rg_fold_get_info(f)->closure, 1e-10);
            assert_int_equal(rg_fold_get_info(f)->frame, -1);
            const double *rho = rg_fold_angles(f, &N);
            double *kept = malloc((size_t)N * sizeof *kept);
            memcpy(kept, rho, (size_t)N * sizeof *kept);
            /* And by the angle of the crease that turns most there, from the beginning. */
            int32_t c = 0, k = 0;
            while (r->frames[k + 1].percent < percent) k++;
            const double *a = rg_motion_angles(rg_fold_motion(f), k), *b = rg_motion_angles(rg_fold_motion(f), k + 1);
            for (int32_t i = 0; i < N; i++)
                if (fabs(b[i] - a[i]) > fabs(b[c] - a[c])) c = i;
            assert_int_equal(rg_fold_go_to(f, 0), RG_OK);
            assert_int_equal(rg_fold_get_info(f)->frame, 0);
            assert_int_equal(rg_fold_go_to_angle(f, c, kept[c]), RG_OK);
            near(rg_fold_angles(f, NULL)[c], kept[c], 1e-14);
            below(rg_fold_get_info(f)->closure, 1e-10);
            free(kept);
        }
        assert_int_equal(rg_fold_go_to(f, 100.0 * r->frames[7].percent / 100), RG_OK);
        assert_int_equal(rg_fold_go_to(f, -1), RG_EARG);
        assert_int_equal(rg_fold_go_to(f, 100.1), RG_EARG);
        assert_int_equal(rg_fold_go_to(f, NAN), RG_EARG);
        assert_int_equal(rg_fold_go_to_angle(f, 0, 3.2), RG_EARG);
        rg_fold_destroy(f);
        rg_pattern_destroy(p);
    }
}

/* Where frames are does not matter between them: 37 % is what a motion with a frame there has, off the same path to the bit, where that knows
 * of progress as it is counted here, and to rounding where it has to be looked for. */
static void frames_do_not_matter(void **state)
{
    (void)state;
    static const struct { const char *kind; double off; } of[] = {{"tatou", 0}, {"closed-split", 0}, {"closed-adjust", 1e-10}, {"frog", 1e-9},
                                                                    {"miura", 0}, {"bird", 0}, {"fish", 0}, {"waterbomb", 0}, {"hypar", 1e-11}};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        rg_settings s = rg_settings_default();
        rg_pattern *p = generated(of[k].kind, 0);
        rg_fold *f[2] = {NULL, NULL};
        s.contact = RG_CONTACT_REPORT;
        for (int i = 0; i < 2; i++) {
            s.frames = i ? 101 : 60;
            assert_int_equal(rg_fold_create(p, &s, NULL, NULL, &f[i], NULL), RG_OK);
        }
        for (int percent = 11; percent < 60; percent += 13) {
            int32_t N;
            for (int i = 0; i < 2; i++) assert_int_equal(rg_fold_go_to(f[i], percent), RG_OK);
            assert_int_equal(rg_fold_get_info(f[0])->frame, -1);
            if (of[k].off == 0) assert_int_equal(rg_fold_get_info(f[1])->frame, percent);
            const double *a = rg_fold_angles(f[0], &N), *b = rg_fold_angles(f[1], &N);
            for (int32_t i = 0; i < N; i++) near(a[i], b[i], of[k].off);
        }
        for (int i = 0; i < 2; i++) rg_fold_destroy(f[i]);
        rg_pattern_destroy(p);
    }
}

static double *angles(const rg_fold *f, size_t *bytes)
{
    int32_t N;
    const double *rho = rg_fold_angles(f, &N);
    *bytes = (size_t)N * sizeof *rho;
    double *copy = malloc(*bytes + 1);
    memcpy(copy, rho, *bytes);
    return copy;
}

/* To 37 %, kept, to the end, back to flat, restored: the same bits, and the same bits after it. */
static void kept_states(void **state)
{
    (void)state;
    for (int k = 0; k < 5; k++)
        for (int steered = 0; steered < 2; steered++) {
            rg_pattern *p = generated(KINDS[k], 0);
            rg_fold *f = found_fold(p, 30), *other = NULL;
            rg_snapshot *s = NULL;
            size_t bytes;
            int32_t nv;
            for (int n = 0; steered && n < 5; n++) rg_fold_step(f);
            for (int32_t i = 0; steered && i < 2; i++) assert_int_equal(rg_fold_set_target(f, i, RG_FREE), RG_OK);
            assert_int_equal(rg_fold_go_to(f, 37), RG_OK);
            double *then = angles(f, &bytes);
            assert_int_equal(rg_fold_snapshot(f, &s), RG_OK);
            assert_int_equal(rg_fold_clone(f, &other), RG_OK);
            while (rg_fold_step(f)->outcome == RG_RUNNING) {}
            double *end = angles(f, &bytes);
            for (int n = 0; n < 100; n++) rg_fold_step_back(f);
            const double *rho = rg_fold_angles(f, NULL);
            for (size_t i = 0; i < bytes / sizeof *rho; i++) near(rho[i], 0, 1e-12);
            const double (*x)[3] = rg_fold_positions(f, &nv), (*X)[2] = rg_fold_flat(f, &nv);
            for (int32_t v = 0; v < nv; v++)
                for (int i = 0; i < 3; i++) near(x[v][i], i < 2 ? X[v][i] : 0, 1e-12);
            for (int again = 0; again < 2; again++) {
                assert_int_equal(rg_fold_restore(f, s), RG_OK);
                assert_memory_equal(rg_fold_angles(f, NULL), then, bytes);
                while (rg_fold_step(f)->outcome == RG_RUNNING) {}
                assert_memory_equal(rg_fold_angles(f, NULL), end, bytes);
            }
            rg_fold_destroy(f);
            rg_pattern_destroy(p);
            assert_memory_equal(rg_fold_angles(other, NULL), then, bytes);
            while (rg_fold_step(other)->outcome == RG_RUNNING) {}
            assert_memory_equal(rg_fold_angles(other, NULL), end, bytes);
            p = generated("miura", 2);
            f = found_fold(p, 5);
            assert_int_equal(rg_fold_restore(f, s), RG_EARG);
            rg_fold_destroy(f);
            rg_fold_destroy(other);
            rg_snapshot_destroy(s);
            rg_pattern_destroy(p);
            free(then);
            free(end);
        }
    rg_snapshot_destroy(NULL);
}

/* Restored, a fold knows nothing of what was set since: it was found, and never steered. */
static void restored_to_before_it_was_steered(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    rg_fold *f = found_fold(p, 9), *other = NULL;
    rg_snapshot *s = NULL;
    const int32_t N = rg_motion_get_sheet(rg_fold_motion(f))->creases;
    size_t bytes;
    assert_int_equal(rg_fold_go_to(f, 50), RG_OK);
    assert_int_equal(rg_fold_snapshot(f, &s), RG_OK);
    assert_int_equal(rg_fold_clone(f, &other), RG_OK);
    for (int32_t c = 2; c < N; c++) assert_int_equal(rg_fold_set_target(f, c, RG_FREE), RG_OK);
    assert_int_equal(rg_fold_pin(f, 1), RG_OK);
    assert_int_equal(rg_fold_restore(f, s), RG_OK);
    rg_fold *const both[] = {f, other};
    for (int k = 0; k < 2; k++) {
        assert_int_equal(rg_fold_set_target(both[k], 0, letter(f, 0) == 'V' ? 0.7 : -0.7), RG_OK);
        while (rg_fold_step(both[k])->outcome == RG_RUNNING) {}
    }
    assert_int_equal(rg_fold_get_info(f)->outcome, rg_fold_get_info(other)->outcome);
    assert_int_equal(rg_fold_get_info(f)->frame, rg_fold_get_info(other)->frame);
    double *there = angles(other, &bytes);
    assert_memory_equal(rg_fold_angles(f, NULL), there, bytes);
    free(there);
    rg_snapshot_destroy(s);
    rg_fold_destroy(f);
    rg_fold_destroy(other);
    rg_pattern_destroy(p);
}

/* A sheet without creases has states, and a place between two of them is one of the two. */
static void nothing_to_fold(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 3, 1);
    rg_pattern *p = pattern_of(&l);
    rg_fold *f = found_fold(p, 5);
    for (double percent = 0; percent <= 100; percent += 12.5) {
        assert_int_equal(rg_fold_go_to(f, percent), RG_OK);
        assert_in_range(rg_fold_get_info(f)->frame, 0, 4);
    }
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* Where all are that shall move, the way is over at once, and all of it done: not the part that a step would be. */
static void sent_to_where_it_is(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    rg_fold *f = flat_fold(p, 9);
    const int32_t twice[] = {0, 0}, last = rg_motion_get_sheet(rg_fold_motion(f))->creases - 1;
    const double to = letter(f, 0) == 'V' ? 1 : -1, angle[] = {0, to};
    for (int round = 0; round < 2; round++) {
        assert_int_equal(rg_fold_drive(f, 1, twice, &angle[round]), RG_OK);
        const rg_step_info *i = rg_fold_step(f);
        while (i->outcome == RG_RUNNING) i = rg_fold_step(f);
        assert_int_equal(i->outcome, RG_FOLDED);
        near(i->progress, 1, 0);
        assert_int_equal(rg_fold_drive(f, 1, twice, &angle[round]), RG_OK);
        i = rg_fold_step(f);
        assert_int_equal(i->outcome, RG_FOLDED);
        near(i->progress, 1, 0);
    }
    /* of a crease that is there twice the last angle counts, however often it is */
    int32_t *many = calloc((size_t)last + 3, sizeof *many);
    double *all = calloc((size_t)last + 3, sizeof *all);
    all[last + 2] = to / 2;
    assert_int_equal(rg_fold_drive(f, last + 3, many, all), RG_OK);
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    near(rg_fold_angles(f, NULL)[0], to / 2, 1e-15);
    free(many), free(all);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* A way so short that rounding is longer has a progress like any other. */
static void next_to_no_way(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    rg_fold *f = flat_fold(p, 5);
    rg_snapshot *s = NULL;
    const int32_t N = rg_motion_get_sheet(rg_fold_motion(f))->creases, first = 0;
    const double to = letter(f, first) == 'V' ? 1.25 : -1.25;
    assert_int_equal(rg_fold_drive(f, 1, &first, &to), RG_OK);
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    assert_int_equal(rg_fold_snapshot(f, &s), RG_OK);
    for (int32_t c = 0; c < N; c++)
        for (int way = -1; way <= 1; way += 2) {
            assert_int_equal(rg_fold_restore(f, s), RG_OK);
            const double is = rg_fold_angles(f, NULL)[c], aim = nextafter(is, 4.0 * way);
            assert_int_equal(rg_fold_drive(f, 1, &c, &aim), RG_OK);
            for (double percent = 12.5; percent < 100; percent += 12.5) {
                assert_int_equal(rg_fold_go_to(f, percent), RG_OK);
                const double progress = rg_fold_get_info(f)->progress;
                if (!(progress >= 0 && progress <= 1)) fail_msg("crease %d at %g %%: %g", (int)c, percent, progress);
            }
        }
    rg_snapshot_destroy(s);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

typedef struct patience { double last; int left, fell; } patience;

static int lose_patience(void *ctx, double progress)
{
    patience *q = ctx;
    q->fell += !(progress >= q->last && progress <= 1);
    q->last = progress;
    return --q->left == 0;
}

/* A driven motion that somebody ends is what there was by then, and says so, as any other; what is told never falls,
 * though a second try, with facets cut, begins anew. */
static void driven_and_ended(void **state)
{
    (void)state;
    static const struct { const char *kind; int left, tries, frames; } runs[] = {
        {"preliminary", 3, 1, 2}, {"preliminary", 0, 1, 11}, {"tatou", 3, 1, 1}, {"tatou", 0, 2, 11}};
    for (int k = 0; k < 4; k++) {
        rg_pattern *p = generated(runs[k].kind, 0);
        const rg_plane *plane = rg_pattern_get_plane(p);
        rg_settings s = rg_settings_default();
        rg_driven one = {0, 0};
        patience q = {0, runs[k].left, 0};
        rg_motion *m = NULL;
        s.frames = 11;
        while (plane->assignment[one.edge] == 'B') one.edge++;
        one.radians = plane->assignment[one.edge] == 'V' ? 3 : -3;
        assert_int_equal(rg_motion_create_driven(p, 1, &one, &s, lose_patience, &q, &m, NULL), RG_OK);
        const rg_report *r = rg_motion_report(m);
        assert_int_equal(r->outcome, runs[k].left ? RG_STOPPED : RG_FOLDED);
        if (runs[k].left) assert_string_equal(r->reason, "interrupted");
        assert_int_equal(r->frame_count, runs[k].frames);
        assert_int_equal(r->tries, runs[k].tries);
        assert_int_equal(q.fell, 0);
        rg_motion_destroy(m);
        rg_pattern_destroy(p);
    }
}

/* A search that goes on with other ways, unfolding among them, tells no less than it did. */
static void what_is_told_rises(void **state)
{
    (void)state;
    rg_pattern *p = generated("frog", 0);
    rg_settings s = rg_settings_default();
    patience q = {0, 0, 0};
    rg_motion *m = NULL;
    s.frames = 5;
    assert_int_equal(rg_motion_create(p, &s, lose_patience, &q, &m, NULL), RG_OK);
    assert_string_equal(rg_motion_report(m)->rung, "unfolded without contact");
    assert_int_equal(q.fell, 0);
    near(q.last, 1, 0);
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
}

/* What is lent of a state is that of the frame that it is. */
static void positions_and_transforms(void **state)
{
    (void)state;
    rg_pattern *p = generated("bird", 0);
    rg_fold *f = found_fold(p, 12);
    const rg_motion *m = rg_fold_motion(f);
    const rg_sheet *s = rg_motion_get_sheet(m);
    double (*xyz)[3] = calloc((size_t)s->vertices, sizeof *xyz);
    for (const rg_step_info *i = rg_fold_get_info(f);; i = rg_fold_step(f)) {
        int32_t nv, nf;
        const double (*x)[3] = rg_fold_positions(f, &nv), (*X)[2] = rg_fold_flat(f, NULL);
        const rg_transform *T = rg_fold_transforms(f, &nf);
        assert_int_equal(nv, s->vertices);
        assert_int_equal(nf, s->facets);
        assert_int_equal(rg_motion_pose(m, i->frame, xyz), RG_OK);
        assert_memory_equal(x, xyz, (size_t)nv * sizeof *xyz);
        for (int32_t g = 0; g < nf; g++)
            for (int32_t j = s->facet_start[g]; j < s->facet_start[g + 1]; j++)
                for (int k = 0; k < 3; k++) {
                    const int32_t v = s->facet_vertex[j];
                    near(T[g].column[0][k] * X[v][0] + T[g].column[1][k] * X[v][1] + T[g].column[3][k], x[v][k], 1e-9);
                }
        if (i->outcome != RG_RUNNING) break;
    }
    free(xyz);
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* The track as a motion: driven frames, measured. */
static void recorded(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    const rg_plane *plane = rg_pattern_get_plane(p);
    rg_driven one = {0, 0};
    rg_settings s = rg_settings_default();
    rg_motion *m = NULL;
    while (plane->assignment[one.edge] == 'B') one.edge++;
    one.radians = plane->assignment[one.edge] == 'V' ? 1 : -1;
    s.frames = 11;
    assert_int_equal(rg_motion_create_driven(p, 1, &one, &s, NULL, NULL, &m, NULL), RG_OK);
    const rg_report *r = rg_motion_report(m);
    const int32_t c = rg_motion_get_sheet(m)->edge_crease[one.edge];
    assert_int_equal(r->frame_count, 11);
    assert_int_equal(r->outcome, RG_FOLDED);
    below(r->max_closure_residual, 1e-10);
    assert_int_equal(r->contact, RG_CONTACT_FREE);
    for (int32_t k = 0; k < 11; k++) {
        near(rg_motion_angles(m, k)[c], one.radians * k / 10, 1e-15);
        near(r->frames[k].percent, 10 * k, 1e-9);
    }
    rg_motion_destroy(m);
    one.edge = -1;
    assert_int_equal(rg_motion_create_driven(p, 1, &one, &s, NULL, NULL, &m, NULL), RG_EARG);
    assert_int_equal(rg_motion_create_driven(p, 0, &one, &s, NULL, NULL, &m, NULL), RG_EARG);
    rg_pattern_destroy(p);
}

/* Percents of a record, and that the last is the report's. */
static void has_percents(const rg_fold *f, int32_t count, const double *percent)
{
    rg_motion *m = NULL;
    assert_int_equal(rg_fold_record(f, &m, NULL), RG_OK);
    const rg_report *r = rg_motion_report(m);
    assert_int_equal(r->frame_count, count);
    for (int32_t k = 0; k < count; k++) near(r->frames[k].percent, percent[k], 1e-9);
    near(r->folded_percent, percent[count - 1], 1e-9);
    near(r->least_folded_percent, percent[count - 1], 1e-9);
    rg_motion_destroy(m);
}

/* A leg that was set and has not begun counts for nothing of its own way, and for a leg: what was passed before it is
 * not measured by where it is to go. */
static void recorded_before_it_begins(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    rg_fold *f = flat_fold(p, 5);
    const int32_t first = 0, second = 5;
    const double to = letter(f, first) == 'V' ? 1 : -1, back = letter(f, second) == 'V' ? 0.2 : -0.2;
    has_percents(f, 1, (const double[]){0});
    assert_int_equal(rg_fold_drive(f, 1, &first, &to), RG_OK);
    has_percents(f, 1, (const double[]){0});
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    has_percents(f, 5, (const double[]){0, 25, 50, 75, 100});
    assert_int_equal(rg_fold_drive(f, 1, &second, &back), RG_OK);
    has_percents(f, 5, (const double[]){0, 12.5, 25, 37.5, 50});
    rg_fold_step(f);
    has_percents(f, 6, (const double[]){0, 12.5, 25, 37.5, 50, 62.5});
    assert_int_equal(rg_fold_forget(f), RG_OK);
    has_percents(f, 1, (const double[]){0});
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

/* Bytes that a sink was handed. */
typedef struct handed { char *bytes; size_t size; } handed;

static int hand(void *ctx, const void *bytes, size_t size)
{
    handed *h = ctx;
    char *more = realloc(h->bytes, h->size + size);
    if (!more) return 1;
    memcpy(more + h->size, bytes, size);
    *h = (handed){more, h->size + size};
    return 0;
}

/* A motion that is verified has no fault, whatever it was steered by: what lies between its frames is in its file. */
static void is_verified(const rg_fold *f, int32_t frames, int legs)
{
    handed w = {0};
    const rg_sink sink = {hand, &w};
    rg_motion *m = NULL;
    rg_certificate *c = NULL;
    const rg_fault *fault;
    rg_diag why = {0, ""};
    if (rg_fold_record(f, &m, &why) != RG_OK) fail_msg("%s", why.text);
    const rg_report *r = rg_motion_report(m);
    assert_int_equal(r->frame_count, frames);
    near(r->folded_percent, 100, 1e-9);
    for (int32_t k = 0; k < frames; k++) {
        near(r->frames[k].percent, legs > 1 ? 100.0 * k / (frames - 1) : r->frames[k].percent, 1e-9);
        if (k) assert_true(r->frames[k].percent >= r->frames[k - 1].percent);
    }
    assert_int_equal(rg_motion_write_to(m, ".fold", -1, &sink, NULL, NULL), RG_OK);
    assert_int_equal(rg_certificate_parse(w.bytes, w.size, NULL, NULL, &c, &why), RG_OK);
    const rg_certificate_info *i = rg_certificate_get_info(c);
    assert_int_equal(i->frames, frames);
    assert_true(i->between > 0);
    below(i->max_leap_deg, 5.001);
    if (rg_certificate_faults(c, &fault) > 0) fail_msg("frame %d: %s", (int)fault->frame, fault->text);
    rg_certificate_destroy(c);
    rg_motion_destroy(m);
    free(w.bytes);
}

/* One leg after the other, each a single step, there and back; and a motion that was found, left half way. */
static void records_are_verified(void **state)
{
    (void)state;
    static const double way[] = {1, 2, 0.3};
    rg_pattern *p = generated("miura", 6);
    rg_fold *f = flat_fold(p, 2);
    const int32_t crease = 0;
    const double side = letter(f, crease) == 'V' ? 1 : -1;
    for (int k = 0; k < 3; k++) {
        const double to = side * way[k];
        assert_int_equal(rg_fold_drive(f, 1, &crease, &to), RG_OK);
        while (rg_fold_step(f)->outcome == RG_RUNNING) {}
        is_verified(f, k + 2, k + 1);
    }
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
    for (int kind = 0; kind < 2; kind++) { /* straight on; relaxed, on a pattern that moves */
        p = generated(kind ? "frog" : "bird", 0);
        f = found_fold(p, 9);
        for (int k = 0; k < 4; k++) rg_fold_step(f);
        int32_t c = 0, N;
        const double *rho = rg_fold_angles(f, &N);
        for (int32_t i = 0; i < N; i++)
            if (fabs(rho[i]) > fabs(rho[c])) c = i;
        /* back, or on to what it aimed at anyway */
        const double back = 0.99 * rho[c], on = copysign(RG_PI, rho[c]);
        assert_int_equal(kind ? rg_fold_drive(f, 1, &c, &back) : rg_fold_set_target(f, c, on), RG_OK);
        while (rg_fold_step(f)->outcome == RG_RUNNING) {}
        assert_int_equal(rg_fold_get_info(f)->outcome, RG_FOLDED);
        is_verified(f, 4 + 9, 1);
        rg_fold_destroy(f);
        rg_pattern_destroy(p);
    }
}

/* Steps of a driven leg, and back, and to the snapshot, ask for no memory. */
static void steps_ask_for_nothing(void **state)
{
    (void)state;
    counted count = {1000000000, 0, 0};
    const rg_memory mem = {counted_resize, &count};
    rg_pattern *p = generated("miura", 4);
    rg_settings s = rg_settings_default();
    rg_fold *f = NULL;
    rg_snapshot *kept = NULL;
    const int32_t c = 2;
    const double to = 1;
    s.memory = &mem;
    s.frames = 20;
    assert_int_equal(rg_fold_create_flat(p, &s, &f, NULL), RG_OK);
    assert_int_equal(rg_fold_drive(f, 1, &c, &to), RG_OK);
    assert_int_equal(rg_fold_snapshot(f, &kept), RG_OK);
    assert_int_equal(rg_fold_restore(f, kept), RG_OK);
    const long asked = count.asked;
    count.left = 0;
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    for (int k = 0; k < 12; k++) rg_fold_step_back(f);
    assert_int_equal(rg_fold_restore(f, kept), RG_OK);
    while (rg_fold_step(f)->outcome == RG_RUNNING) {}
    assert_int_equal(count.asked, asked);
    rg_snapshot_destroy(kept);
    rg_fold_destroy(f);
    assert_int_equal(count.out, 0);
    rg_pattern_destroy(p);
}

/* ------------------------------------------------------------------------------------------------- landing, blame ---- */

/* Aimed at a state that closes, it ends there to the bit; aimed beside one, where angles as they are asked for do not close, at what does. */
static void it_lands_only_where_the_sheet_closes(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    const int32_t c = 0;
    for (int beside = 0; beside < 2; beside++) {
        rg_fold *f = flat_fold(p, 11), *there = flat_fold(p, 11);
        const double sign = letter(f, c) == 'V' ? 1 : -1, from = sign * 30 * RG_DEG, to = sign * 50 * RG_DEG;
        int32_t N;
        double target[100];
        assert_int_equal(rg_fold_drive(there, 1, &c, &to), RG_OK);
        while (rg_fold_step(there)->outcome == RG_RUNNING) {}
        assert_int_equal(rg_fold_drive(f, 1, &c, &from), RG_OK);
        while (rg_fold_step(f)->outcome == RG_RUNNING) {}
        const double *rho = rg_fold_angles(there, &N);
        assert_true(N <= 100);
        for (int32_t i = 0; i < N; i++) {
            target[i] = beside ? 1e-5 * round(1e5 * rho[i]) : rho[i];
            assert_int_equal(rg_fold_set_target(f, i, target[i]), RG_OK);
        }
        const rg_step_info *now = rg_fold_step(f);
        for (int k = 0; now->outcome == RG_RUNNING && k < 100; k++) now = rg_fold_step(f);
        rho = rg_fold_angles(f, NULL);
        for (int32_t i = 0; i < N; i++) near(rho[i], target[i], beside ? 1e-4 : 0);
        below(now->closure, 1e-9);
        if (!beside) assert_int_not_equal(now->outcome, RG_RUNNING);
        rg_fold_destroy(there);
        rg_fold_destroy(f);
    }
    rg_pattern_destroy(p);
}

/* Of two vertices that have nothing to do with each other, the one whose creases are driven against each other is to blame. */
static void who_resists_is_to_blame(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        const int at = k % 2, little = k / 2; /* three creases a little, or two as far as two neighbours cannot */
        rg_lines l = drawing();
        draw_box(&l, 0, 0, 4, 2);
        for (int v = 0; v < 2; v++) {
            const double x = 1 + 2 * v;
            draw(&l, RG_VALLEY, x, 1, x - 0.4, 0);
            draw(&l, RG_VALLEY, x, 1, x + 0.6, 0);
            draw(&l, RG_VALLEY, x, 1, x + 0.5, 2);
            draw(&l, RG_MOUNTAIN, x, 1, x - 0.3, 2);
        }
        rg_pattern *p = pattern_of(&l);
        rg_fold *f = flat_fold(p, 31);
        const rg_sheet *sheet = rg_motion_get_sheet(rg_fold_motion(f));
        const double middle = 1 + 2 * at;
        const double ends[3][2] = {{middle - 0.2, 0.5}, {middle + 0.3, 0.5}, {middle + 0.25, 1.5}};
        int32_t driven[3];
        for (int c = 0; c < 3; c++) driven[c] = rg_motion_crease_at(rg_fold_motion(f), ends[c]);
        for (int c = 0; c < 3; c++) assert_true(driven[c] >= 0 && driven[c] != driven[(c + 1) % 3]);
        const double far = (little ? 10 : 170) * RG_DEG, to[3] = {far, far, far};
        assert_int_equal(rg_fold_drive(f, little ? 3 : 2, driven, to), RG_OK);
        const rg_step_info *now = rg_fold_step(f);
        while (now->outcome == RG_RUNNING) now = rg_fold_step(f);
        assert_int_equal(now->outcome, RG_STOPPED);
        assert_true(now->blocking_vertex_count >= 1);
        near(sheet->flat[now->blocking_vertices[0]][0], middle, 1e-12);
        near(sheet->flat[now->blocking_vertices[0]][1], 1, 1e-12);
        rg_fold_destroy(f);
        rg_pattern_destroy(p);
    }
}

/* What there is to say of a fold before it has moved, on its way, and of each move: no text is missing, and what a move
 * cost is its own. */
static void what_is_said_on_the_way(void **state)
{
    (void)state;
    rg_pattern *p = generated("miura", 4);
    rg_fold *f = flat_fold(p, 9);
    const rg_report *r = rg_motion_report(rg_fold_motion(f));
    const char *const texts[] = {r->method, r->solver,       r->rung,         r->direction,
                                 r->layers, r->layer_orders, r->layers_reason};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) assert_string_equal(texts[k], "");
    assert_int_equal(r->outcome, RG_RUNNING);
    const int32_t c = 0;
    const double to = (letter(f, c) == 'V' ? 1 : -1) * 60 * RG_DEG;
    for (int round = 0; round < 2; round++) {
        const double aim = round ? to / 2 : to;
        assert_int_equal(rg_fold_drive(f, 1, &c, &aim), RG_OK);
        const rg_step_info *i = rg_fold_get_info(f);
        assert_int_equal(i->outcome, RG_RUNNING);
        assert_string_equal(i->reason, "");
        int moves = 0;
        do {
            i = rg_fold_step(f);
            assert_in_range(i->solves, 1, 1000);
            assert_in_range(i->iterations, 0, 1000000);
            moves++;
        } while (i->outcome == RG_RUNNING);
        assert_true(moves > 3);
        assert_string_not_equal(i->reason, "");
        assert_int_equal(rg_fold_step_back(f)->solves, 0); /* it is known already */
        rg_fold_step(f);
    }
    rg_fold_destroy(f);
    rg_pattern_destroy(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_said_on_the_way), cmocka_unit_test(it_lands_only_where_the_sheet_closes),
        cmocka_unit_test(who_resists_is_to_blame),
        cmocka_unit_test(one_crease_of_a_miura_ori), cmocka_unit_test(back_through_flat), cmocka_unit_test(targets_pins_and_free_creases),
        cmocka_unit_test(a_locked_crease), cmocka_unit_test(a_group), cmocka_unit_test(from_a_moved_pattern), cmocka_unit_test(pinned_before_the_search), cmocka_unit_test(between_frames), cmocka_unit_test(frames_do_not_matter), cmocka_unit_test(to_and_fro), cmocka_unit_test(forgotten_on_the_way), cmocka_unit_test(flat_paper_to_its_end), cmocka_unit_test(not_by_a_whole_turn),
        cmocka_unit_test(kept_states), cmocka_unit_test(positions_and_transforms), cmocka_unit_test(recorded),
        cmocka_unit_test(records_are_verified), cmocka_unit_test(restored_to_before_it_was_steered),
        cmocka_unit_test(nothing_to_fold), cmocka_unit_test(sent_to_where_it_is), cmocka_unit_test(driven_and_ended), cmocka_unit_test(next_to_no_way), cmocka_unit_test(recorded_before_it_begins), cmocka_unit_test(what_is_told_rises),
        cmocka_unit_test(steps_ask_for_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
