/* motion/states.c, motion/assemble.c, motion/overlay.c, pattern/same.c: from one folded state to the next. The oracle for
 * folded states is the pattern alone, reflected facet by facet. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

#include "counted.h"
#include "folded.h"
#include "motion/motion.h"
#include "motion/overlay.h"

/* ------------------------------------------------------------------------------------------------- running ---- */

enum { MOST_STATES = 4 };

static rg_pattern *read_pattern(const char *name)
{
    char path[200];
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    snprintf(path, sizeof path, "patterns/%s.opx", name);
    if (rg_pattern_read(path, NULL, &p, &why) != RG_OK) fail_msg("%s: %s", path, why.text);
    return p;
}

typedef struct walk { rg_pattern *state[MOST_STATES]; int32_t count; rg_motion *m; const rg_report *r; } walk;

static walk walk_of(rg_pattern *const *state, int32_t count, const rg_settings *s)
{
    walk w = {.count = count};
    rg_diag why = {0, ""};
    memcpy(w.state, state, (size_t)count * sizeof *state);
    if (rg_motion_create_states((const rg_pattern *const *)w.state, count, s, NULL, NULL, &w.m, &why) != RG_OK) fail_msg("%s", why.text);
    w.r = rg_motion_report(w.m);
    if (count > 1) {
        assert_string_equal(w.r->triangulation, w.r->added_creases > 0 ? "all" : "none");
        assert_string_equal(w.r->why_triangulated,
                            w.r->added_creases > 0 ? "stops short without added creases" : "goes without added creases");
    }
    return w;
}

#define COUNT(...) ((int32_t)(sizeof((const char *[]){__VA_ARGS__}) / sizeof(char *)))
#define walk_through(s, ...) walk_names(s, COUNT(__VA_ARGS__), (const char *[]){__VA_ARGS__})

static walk walk_names(const rg_settings *s, int32_t count, const char *const *name)
{
    rg_pattern *state[MOST_STATES];
    for (int32_t k = 0; k < count; k++) state[k] = read_pattern(name[k]);
    return walk_of(state, count, s);
}

static void walk_free(walk *w)
{
    rg_motion_destroy(w->m);
    for (int32_t k = 0; k < w->count; k++) rg_pattern_destroy(w->state[k]);
}

static rg_settings with_frames(int32_t frames)
{
    rg_settings s = rg_settings_default();
    s.frames = frames;
    return s;
}

typedef double point[3];

/* Free what is returned. */
static point *pose(const rg_motion *m, int32_t frame)
{
    rg_sheet sheet;
    sheet = *rg_motion_get_sheet(m);
    point *x = calloc((size_t)sheet.vertices, sizeof *x);
    assert_non_null(x);
    assert_int_equal(rg_motion_pose(m, frame, x), RG_OK);
    return x;
}

static double apart(const double *a, const double *b) { return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]); }

/* The same up to one rigid motion: every two points are as far apart. */
static void same_shape(int32_t n, point *a, point *b, double tol)
{
    for (int32_t i = 0; i < n; i++)
        for (int32_t j = 0; j < i; j++) near(apart(a[i], a[j]), apart(b[i], b[j]), tol);
}

/* Frame j of b is frame i of a, at all places that are vertices of b and thus of a. */
static void same_pose(const rg_motion *a, int32_t i, const rg_motion *b, int32_t j)
{
    rg_sheet of_a, of_b;
    of_a = *rg_motion_get_sheet(a);
    of_b = *rg_motion_get_sheet(b);
    point *x = pose(a, i), *y = pose(b, j), *same = calloc((size_t)of_b.vertices, sizeof *same);
    assert_non_null(same);
    for (int32_t v = 0; v < of_b.vertices; v++) {
        int32_t at = 0;
        while (at < of_a.vertices && hypot(of_a.flat[at][0] - of_b.flat[v][0], of_a.flat[at][1] - of_b.flat[v][1]) > 1e-9) at++;
        assert_true(at < of_a.vertices);
        memcpy(same[v], x[at], sizeof *same);
    }
    same_shape(of_b.vertices, same, y, 1e-9 * a->report.pattern->size);
    free(x);
    free(y);
    free(same);
}

/* -------------------------------------------------------------------------------------------- reflections ---- */

/* x -> a x + b y + c, by rows */
typedef struct affine { double x[3], y[3]; } affine;

static affine after(affine f, affine g) /* f after g */
{
    affine h;
    for (int i = 0; i < 3; i++) {
        h.x[i] = f.x[0] * g.x[i] + f.x[1] * g.y[i] + (i == 2) * f.x[2];
        h.y[i] = f.y[0] * g.x[i] + f.y[1] * g.y[i] + (i == 2) * f.y[2];
    }
    return h;
}

static affine reflection(rg_vec2 p, rg_vec2 q)
{
    const double dx = q.x - p.x, dy = q.y - p.y, l = dx * dx + dy * dy, c = (dx * dx - dy * dy) / l, s = 2 * dx * dy / l;
    return (affine){{c, s, p.x - c * p.x - s * p.y}, {s, -c, p.y - s * p.x + c * p.y}};
}

static int is_in(const rg_mesh *m, int32_t f, const double *x)
{
    int odd = 0;
    for (int32_t j = m->facet_start[f]; j < m->facet_start[f + 1]; j++) {
        const int32_t *e = m->edge[m->facet_edge[j]];
        const rg_vec2 a = m->X[e[0]], b = m->X[e[1]];
        const double l = hypot(b.x - a.x, b.y - a.y), t = ((x[0] - a.x) * (b.x - a.x) + (x[1] - a.y) * (b.y - a.y)) / (l * l);
        if (t > -1e-9 && t < 1 + 1e-9 && fabs((b.x - a.x) * (x[1] - a.y) - (b.y - a.y) * (x[0] - a.x)) / l < 1e-9 * m->size) return 1;
        if ((a.y > x[1]) != (b.y > x[1]) && x[0] < a.x + (x[1] - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    }
    return odd;
}

/* Where points of the sheet lie when every crease of the state is folded flat; the facet at its first face stays. */
static void reflect(const rg_pattern *state, int32_t n, const double (*flat)[2], point *x)
{
    rg_mesh m = mesh_of(state);
    affine *place = calloc((size_t)m.nf, sizeof *place);
    int *known = calloc((size_t)m.nf, sizeof *known);
    assert_true(place && known);
    place[0] = (affine){{1, 0, 0}, {0, 1, 0}};
    known[0] = 1;
    for (int32_t round = 0; round < m.nf; round++)
        for (int32_t i = 0; i < m.N; i++)
            for (int way = 0; way < 2; way++) {
                const int32_t e = m.crease_edge[i], from = m.edge_facet[e][way], to = m.edge_facet[e][!way];
                if (!known[from] || known[to]) continue;
                place[to] = after(place[from], reflection(m.X[m.edge[e][0]], m.X[m.edge[e][1]]));
                known[to] = 1;
            }
    for (int32_t v = 0; v < n; v++) {
        int32_t f = 0;
        while (f < m.nf && !is_in(&m, f, flat[v])) f++;
        assert_true(f < m.nf && known[f]);
        x[v][0] = place[f].x[0] * flat[v][0] + place[f].x[1] * flat[v][1] + place[f].x[2];
        x[v][1] = place[f].y[0] * flat[v][0] + place[f].y[1] * flat[v][1] + place[f].y[2];
        x[v][2] = 0;
    }
    free(place);
    free(known);
    rg_mesh_free(&m);
}

/* Frame `frame` is that state, folded flat, to 1e-6 of the sheet; `state` NULL: it is flat. */
static void is_state(const walk *w, int32_t frame, const rg_pattern *state)
{
    rg_sheet sheet;
    sheet = *rg_motion_get_sheet(w->m);
    point *ours = pose(w->m, frame), *truth = calloc((size_t)sheet.vertices, sizeof *truth);
    assert_non_null(truth);
    for (int32_t v = 0; v < sheet.vertices; v++) memcpy(truth[v], sheet.flat[v], sizeof sheet.flat[v]);
    if (state) reflect(state, sheet.vertices, sheet.flat, truth);
    same_shape(sheet.vertices, ours, truth, 1e-6 * w->r->pattern->size);
    free(ours);
    free(truth);
}

/* Exact in every frame, never backwards, from nothing to all. */
static void is_sound(const walk *w, int32_t frames)
{
    const rg_report *r = w->r;
    assert_int_equal(r->frame_count, frames);
    below(r->max_closure_residual, 1e-8);
    below(r->max_edge_strain, 1e-8);
    below(r->max_facet_gap, 1e-8);
    below(r->max_overfold_deg, 0.1);
    near(r->frames[0].percent, 0, 1e-9);
    for (int32_t k = 0; k < frames; k++) {
        below(r->frames[k].closure_residual, 1e-8);
        if (k) below(r->frames[k - 1].percent, r->frames[k].percent + 1e-6); /* what stops where it began is there to rounding */
    }
}

static void is_folded(const walk *w, int32_t frames)
{
    is_sound(w, frames);
    if (w->r->outcome != RG_FOLDED) fail_msg("%s", w->r->reason);
    near(w->r->folded_percent, 100, 1e-9);
    near(w->r->least_folded_percent, 100, 1e-6);
    near(w->r->frames[frames - 1].percent, 100, 1e-9);
    assert_int_equal(w->r->states, w->count);
    assert_int_equal(w->r->states_reached, w->count);
    assert_int_equal(w->r->state_frame[0], 0);
    assert_int_equal(w->r->state_frame[w->count - 1], frames - 1);
}

/* ---------------------------------------------------------------------------------------------------- ways ---- */

static void petal_fold(void **state)
{
    (void)state;
    const rg_settings s = with_frames(60);
    walk w = walk_through(&s, "preliminary", "bird");
    is_folded(&w, 60);
    is_state(&w, 0, w.state[0]);
    is_state(&w, 59, w.state[1]);
    assert_int_equal(w.r->by_flat_count, 0);
    assert_int_equal(w.r->added_creases, 0);
    assert_true(w.r->max_adjustment == 0);
    below(w.r->max_strain_from_original, 1e-8);
    for (int32_t k = 0; k < 60; k++) near(w.r->frames[k].percent, 100.0 * k / 59, 1e-2);
    /* A petal fold leaves shut what holds the layers of the base together: four halves of midlines, a diagonal. */
    for (int32_t k = 0; k < 60; k++) {
        int32_t shut = 0;
        for (int32_t i = 0; i < w.m->mesh.N; i++) shut += fabs(fabs(rg_motion_angles(w.m, k)[i]) - RG_PI) < 1e-3;
        assert_true(shut >= 6);
    }
    walk_free(&w);
}

static void back_again(void **state)
{
    (void)state;
    const rg_settings s = with_frames(31);
    walk w = walk_through(&s, "preliminary", "bird", "preliminary");
    is_folded(&w, 31);
    assert_int_equal(w.r->state_frame[1], 15);
    is_state(&w, 0, w.state[0]);
    is_state(&w, 15, w.state[1]);
    is_state(&w, 30, w.state[2]);
    near(w.r->frames[15].percent, 50, 1e-9);
    walk_free(&w);
}

/* Foreign lines cross every facet there is: what a state has no crease for stays flat. */
static void states_of_little_in_common(void **state)
{
    (void)state;
    const rg_settings s = with_frames(13);
    walk w = walk_through(&s, "fish", "bird", "preliminary", "waterbomb-base");
    is_folded(&w, 13);
    for (int32_t k = 0; k < 4; k++) is_state(&w, w.r->state_frame[k], w.state[k]);
    walk_free(&w);
}

static void open_sink_through_flat(void **state)
{
    (void)state;
    const rg_settings s = with_frames(61);
    walk w = walk_through(&s, "waterbomb-base", "open-sink");
    is_folded(&w, 61);
    is_state(&w, 0, w.state[0]);
    is_state(&w, 30, NULL);
    is_state(&w, 60, w.state[1]);
    assert_int_equal(w.r->by_flat_count, 1);
    assert_int_equal(w.r->by_flat[0], 1);
    assert_non_null(strstr(w.r->reason, "flat"));

    /* The way to flat is folding, frame by frame, backwards. */
    const rg_settings half = with_frames(31);
    rg_motion *alone = NULL;
    rg_diag why;
    assert_int_equal(rg_motion_create(w.state[0], &half, NULL, NULL, &alone, &why), RG_OK);
    for (int32_t k = 0; k <= 30; k++) same_pose(w.m, k, alone, 30 - k);
    rg_motion_destroy(alone);
    walk_free(&w);
}

/* Two frames hold no flat paper between the states; the states are there all the same. */
static void few_frames(void **state)
{
    (void)state;
    const rg_settings two = with_frames(2), three = with_frames(3);
    walk w = walk_through(&two, "waterbomb-base", "open-sink");
    is_folded(&w, 2);
    is_state(&w, 0, w.state[0]);
    is_state(&w, 1, w.state[1]);
    walk_free(&w);
    w = walk_through(&three, "bird", "bird");
    is_folded(&w, 3);
    for (int32_t k = 0; k < 3; k++) is_state(&w, k, w.state[0]);
    walk_free(&w);
}

static rg_pattern *box(double x0, double y0, double x1, double y1)
{
    rg_lines l = drawing();
    draw_box(&l, x0, y0, x1, y1);
    return pattern_of(&l);
}

static void flat_paper_is_a_state(void **state)
{
    (void)state;
    const rg_settings s = with_frames(21);
    rg_pattern *const both[] = {read_pattern("fish"), box(-200, -200, 200, 200)}, *const other[] = {box(-200, -200, 200, 200), read_pattern("fish")};
    walk w = walk_of(both, 2, &s), v = walk_of(other, 2, &s);
    is_folded(&w, 21);
    is_folded(&v, 21);
    is_state(&w, 0, both[0]);
    is_state(&w, 20, NULL);
    assert_int_equal(w.r->by_flat_count, 0);
    for (int32_t k = 0; k < 21; k++) same_pose(w.m, k, v.m, 20 - k); /* unfolding is folding backwards */
    walk_free(&w);
    walk_free(&v);
}

static void mountain_and_valley_exchanged(void **state)
{
    (void)state;
    rg_settings s = with_frames(7);
    walk w = walk_through(&s, "preliminary", "bird");
    s.to = -1;
    walk v = walk_through(&s, "preliminary", "bird");
    is_folded(&v, 7);
    assert_int_equal(w.m->mesh.N, v.m->mesh.N);
    for (int32_t k = 0; k < 7; k++)
        for (int32_t i = 0; i < w.m->mesh.N; i++) near(rg_motion_angles(w.m, k)[i], -rg_motion_angles(v.m, k)[i], 1e-6);
    walk_free(&w);
    walk_free(&v);
}

/* Without added creases and without moving any, the sink's closed vertices leave no way at all. Where they are is told as the drawing has it,
 * whichever way its y runs. */
static void out_of_reach(int y_down)
{
    static const char *const name[] = {"preliminary", "bird", "open-sink"};
    rg_settings s = with_frames(30);
    rg_pattern *drawn[3];
    s.adjust = 0;
    s.triangulate = RG_TRIANGULATE_NONE;
    for (int k = 0; k < 3; k++) {
        drawn[k] = read_pattern(name[k]);
        drawn[k]->lines.y_down = y_down;
        for (int32_t v = 0; v < drawn[k]->nv; v++) { /* askew, so that no vertex lies on an axis */
            const rg_vec2 x = drawn[k]->X[v];
            drawn[k]->X[v] = (rg_vec2){0.8 * x.x - 0.6 * x.y, 0.6 * x.x + 0.8 * x.y};
        }
    }
    walk w = walk_of(drawn, 3, &s);
    is_sound(&w, w.r->frame_count);
    assert_int_equal(w.r->outcome, RG_STOPPED);
    assert_int_equal(w.r->states_reached, 2);
    is_state(&w, w.r->state_frame[1], w.state[1]);
    assert_non_null(strstr(w.r->reason, "from state 2 to state 3"));
    assert_true(w.r->blocking_vertex_count > 0);
    for (int32_t k = 0; k < w.r->blocking_vertex_count; k++) {
        const rg_vec2 at = w.m->mesh.X[w.r->blocking_vertices[k]];
        near(w.r->blocking_at[k][0], at.x, 1e-6);
        near(w.r->blocking_at[k][1], y_down ? -at.y : at.y, 1e-6);
        assert_true(fabs(at.y) > 1e-3 * w.m->mesh.size);
    }
    below(w.r->folded_percent, 99);
    below(50 - 1e-9, w.r->folded_percent);
    walk_free(&w);
}

static void a_state_out_of_reach(void **state)
{
    (void)state;
    out_of_reach(0);
    out_of_reach(1);
}

/* ------------------------------------------------------------------------------------------------- drawings ---- */

/* The preliminary fold or the bird base of a sheet of side 2, every line's ends off by up to `off`. */
static rg_pattern *rough(const char *name, double off, unsigned *seed)
{
    rg_pattern *p = read_pattern(name);
    rg_lines l = drawing();
    for (int32_t e = 0; e < p->ne; e++) {
        const rg_vec2 a = p->X[p->E[e].v[0]], b = p->X[p->E[e].v[1]];
        const double dx = off * noise(seed), dy = off * noise(seed);
        draw(&l, p->E[e].assignment, a.x / 200 + dx, a.y / 200 + dy, b.x / 200 + off * noise(seed), b.y / 200 + off * noise(seed));
    }
    rg_pattern_destroy(p);
    return pattern_of(&l);
}

/* Drawn by two hands, so that neither state is quite flat-foldable: they end as near to it as they close, and every frame
 * closes exactly, on a pattern that may have to give way. */
static void drawings_off_by_rounding(void **state)
{
    (void)state;
    const double off[] = {1e-9, 1e-7, 1e-6};
    for (int n = 0; n < 3; n++) {
        unsigned seed = 20;
        const rg_settings s = with_frames(12);
        rg_pattern *const both[] = {rough("preliminary", off[n], &seed), rough("bird", off[n], &seed)};
        walk w = walk_of(both, 2, &s);
        is_sound(&w, 12);
        assert_int_equal(w.r->outcome, RG_FOLDED);
        below(99, w.r->least_folded_percent);
        below(w.r->max_adjustment, 0.01);
        walk_free(&w);
    }
}

static void refused(const rg_pattern *first, const rg_pattern *other, const char *words)
{
    const rg_settings s = rg_settings_default();
    const rg_pattern *const both[] = {first, other};
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    assert_int_equal(rg_pattern_same_sheet(first, other, &why), RG_ESHEET);
    if (!strstr(why.text, words)) fail_msg("%s", why.text);
    assert_int_equal(rg_motion_create_states(both, 2, &s, NULL, NULL, &m, &why), RG_ESHEET);
    if (strncmp(why.text, "state 2: ", 9) || !strstr(why.text, words)) fail_msg("%s", why.text);
    assert_null(m);
}

static void other_sheets_are_refused(void **state)
{
    (void)state;
    rg_pattern *first = read_pattern("preliminary"), *larger = box(-200, -200, 200, 210), *moved = box(-190, -200, 210, 200);
    refused(first, larger, "400 x 410, and the first is 400 x 400");
    refused(first, moved, "lies (10, 0) away");
    rg_lines l = drawing();
    const rg_vec2 notched[] = {{-200, -200}, {200, -200}, {200, 200}, {30, 200}, {25, 170}, {20, 200}, {-200, 200}};
    draw_polygon(&l, RG_BORDER, notched, 7);
    rg_pattern *notch = pattern_of(&l);
    refused(first, notch, "borders differ at (25, 170)");
    l = drawing();
    draw_box(&l, -200, -200, 200, 200);
    draw_box(&l, -20, -20, 30, 20);
    rg_pattern *hole = pattern_of(&l);
    refused(first, hole, "not one sheet without holes");
    rg_pattern *const all[] = {first, larger, moved, notch, hole};
    for (int k = 0; k < 5; k++) rg_pattern_destroy(all[k]);
}

static void settings_that_make_no_sense(void **state)
{
    (void)state;
    rg_pattern *p[] = {read_pattern("preliminary"), read_pattern("bird"), read_pattern("preliminary")};
    rg_settings s = with_frames(2);
    rg_motion *m = NULL;
    rg_diag why;
    assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 3, &s, NULL, NULL, &m, &why), RG_EARG);
    s.frames = 5;
    s.to = 0.5;
    assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 3, &s, NULL, NULL, &m, &why), RG_EARG);
    s.to = 1;
    assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 0, &s, NULL, NULL, &m, &why), RG_EARG);
    s.fixed_facet = 4711;
    assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 3, &s, NULL, NULL, &m, &why), RG_EARG);
    assert_null(m);
    for (int k = 0; k < 3; k++) rg_pattern_destroy(p[k]);
}

/* One state is folded as ever. */
static void one_state(void **state)
{
    (void)state;
    const rg_settings s = with_frames(9);
    rg_diag why;
    rg_motion *m = NULL;
    rg_pattern *const bird[] = {read_pattern("bird")};
    walk w = walk_of(bird, 1, &s);
    assert_int_equal(rg_motion_create(bird[0], &s, NULL, NULL, &m, &why), RG_OK);
    assert_int_equal(w.r->states, 0);
    for (int32_t k = 0; k < 9; k++) assert_memory_equal(rg_motion_angles(m, k), rg_motion_angles(w.m, k), (size_t)m->mesh.N * sizeof(double));
    rg_motion_destroy(m);
    walk_free(&w);
}

/* ------------------------------------------------------------------------------------------ watching, memory ---- */

typedef struct watcher { double most, stop_at; } watcher;

static int watch(void *ctx, double progress)
{
    watcher *w = ctx;
    assert_true(progress >= 0 && progress <= 1);
    w->most = fmax(w->most, progress);
    return progress >= w->stop_at;
}

static void stopped_on_the_way(void **state)
{
    (void)state;
    rg_settings s = with_frames(41);
    s.threads = 1; /* with two, the try that folds may be the other thread's, which tells nothing */
    rg_pattern *p[] = {read_pattern("preliminary"), read_pattern("bird"), read_pattern("preliminary")};
    watcher to_the_end = {0, 2}, half = {0, 0.7};
    rg_motion *m = NULL;
    rg_diag why;
    assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 3, &s, watch, &to_the_end, &m, &why), RG_OK);
    below(0.99, to_the_end.most);
    rg_motion_destroy(m);
    assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 3, &s, watch, &half, &m, &why), RG_OK);
    const rg_report *r = rg_motion_report(m);
    assert_int_equal(r->outcome, RG_STOPPED);
    assert_non_null(strstr(r->reason, "interrupted"));
    assert_int_equal(r->states_reached, 2);
    below(70, r->folded_percent);
    below(r->folded_percent, 80);
    rg_motion_destroy(m);
    for (int k = 0; k < 3; k++) rg_pattern_destroy(p[k]);
}

/* Through flat, with creases added and frames thrown away: every place that asks for memory, or some of them. */
static void memory_refused(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {{"preliminary", "bird"}, {"waterbomb-base", "fish"}};
    for (int n = 0; n < 2; n++) {
        rg_pattern *p[] = {read_pattern(pairs[n][0]), read_pattern(pairs[n][1])};
        rg_settings s = with_frames(3);
        counted c = {1000000000, 0, 0};
        rg_memory mem = {counted_resize, &c};
        rg_motion *m = NULL;
        rg_diag why;
        s.memory = &mem;
        s.effort = RG_EFFORT_FAST;
        assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 2, &s, NULL, NULL, &m, &why), RG_OK);
        rg_motion_destroy(m);
        assert_int_equal(c.out, 0);
        const long asked = c.asked, stride = asked / 150 + 1;
        for (long k = 0; k < asked; k += k < 60 || k > asked - 60 ? 1 : stride) {
            c = (counted){k, 0, 0};
            m = NULL;
            assert_int_equal(rg_motion_create_states((const rg_pattern *const *)p, 2, &s, NULL, NULL, &m, &why), RG_ENOMEM);
            assert_null(m);
            assert_int_equal(c.out, 0);
        }
        for (int k = 0; k < 2; k++) rg_pattern_destroy(p[k]);
    }
}

/* ------------------------------------------------------------------------------------------------- overlays ---- */

/* Any affine map of the coarse mesh is the same map of the fine one, and a crease is that of its parts, no other. */
static void overlays(void **state)
{
    (void)state;
    rg_pattern *a = read_pattern("preliminary"), *b = read_pattern("fish");
    rg_mesh coarse[2] = {mesh_of(a), mesh_of(b)}, fine;
    rg_lines l = drawing();
    rg_diag why;
    for (int k = 0; k < 2; k++) assert_int_equal(rg_overlay_draw(&l, &coarse[k], 0, NULL), RG_OK);
    assert_int_equal(rg_overlay_mesh(&l, RG_MERGE_DEFAULT, &fine, &why), RG_OK);
    for (int k = 0; k < 2; k++) {
        rg_overlay o;
        assert_int_equal(rg_overlay_init(&o, &fine, &coarse[k], 1e-6 * fine.size), RG_OK);
        rg_vec2 *X = calloc((size_t)coarse[k].nv, sizeof *X), *Y = calloc((size_t)fine.nv, sizeof *Y);
        double *length = calloc((size_t)coarse[k].N, sizeof *length);
        assert_true(X && Y && length);
        for (int32_t v = 0; v < coarse[k].nv; v++)
            X[v] = (rg_vec2){1.25 * coarse[k].X[v].x - 0.4 * coarse[k].X[v].y + 3, 0.3 * coarse[k].X[v].x + 2.385 * coarse[k].X[v].y - 7};
        rg_overlay_points(&o, X, Y);
        for (int32_t v = 0; v < fine.nv; v++) {
            near(Y[v].x, 1.25 * fine.X[v].x - 0.4 * fine.X[v].y + 3, 1e-10);
            near(Y[v].y, 0.3 * fine.X[v].x + 2.385 * fine.X[v].y - 7, 1e-10);
        }
        for (int32_t i = 0; i < fine.N; i++) {
            const int32_t *e = fine.edge[fine.crease_edge[i]];
            if (o.crease[i] >= 0) length[o.crease[i]] += rg_vec2_length(rg_vec2_sub(fine.X[e[1]], fine.X[e[0]]));
        }
        for (int32_t i = 0; i < coarse[k].N; i++) {
            const int32_t *e = coarse[k].edge[coarse[k].crease_edge[i]];
            near(length[i], rg_vec2_length(rg_vec2_sub(coarse[k].X[e[1]], coarse[k].X[e[0]])), 1e-9);
        }
        free(X);
        free(Y);
        free(length);
        rg_overlay_free(&o);
    }
    rg_mesh_free(&fine);
    for (int k = 0; k < 2; k++) rg_mesh_free(&coarse[k]);
    rg_pattern_destroy(a);
    rg_pattern_destroy(b);
}

/* One crease is to open nearly all the way, whichever it is: others go past where they should be for it, which counts as
 * all of their way and no more. It was told as up to 107 percent. */
static void no_more_than_all_of_it(void **state)
{
    (void)state;
    rg_settings s = with_frames(12);
    s.effort = RG_EFFORT_FAST;
    s.contact = RG_CONTACT_IGNORE;
    rg_pattern *p = read_pattern("preliminary");
    const int32_t edges = rg_pattern_get_plane(p)->edges;
    int walks = 0;
    rg_pattern_destroy(p);
    for (int32_t e = 0; e < edges; e++) {
        rg_pattern *pattern[] = {read_pattern("preliminary"), read_pattern("preliminary"), read_pattern("preliminary")};
        if (rg_pattern_set_target(pattern[2], e, 0.09) != RG_OK) {
            for (int k = 0; k < 3; k++) rg_pattern_destroy(pattern[k]);
            continue;
        }
        walk w = walk_of(pattern, 3, &s);
        for (int32_t k = 0; k < w.r->frame_count; k++) assert_true(w.r->frames[k].percent <= 100);
        assert_true(w.r->folded_percent <= 100 && w.r->least_folded_percent <= w.r->folded_percent + 1e-9);
        walk_free(&w);
        walks++;
    }
    assert_int_equal(walks, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(petal_fold), cmocka_unit_test(back_again), cmocka_unit_test(states_of_little_in_common),
        cmocka_unit_test(open_sink_through_flat), cmocka_unit_test(few_frames), cmocka_unit_test(flat_paper_is_a_state),
        cmocka_unit_test(mountain_and_valley_exchanged), cmocka_unit_test(a_state_out_of_reach),
        cmocka_unit_test(drawings_off_by_rounding), cmocka_unit_test(other_sheets_are_refused),
        cmocka_unit_test(settings_that_make_no_sense), cmocka_unit_test(one_state), cmocka_unit_test(stopped_on_the_way),
        cmocka_unit_test(memory_refused), cmocka_unit_test(overlays), cmocka_unit_test(no_more_than_all_of_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
