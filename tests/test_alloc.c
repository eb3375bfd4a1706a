/* The library with memory that runs short at every place where it asks: nothing lost, nothing half made, the right status.
 * And steps that ask for none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "counted.h"
#include "fold/straight.h"
#include "near.h"
#include "rigami.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

/* Where a call asks more often than this, only so many places are tried, spread over all: fewer where each takes several times as long. */
enum { MOST_PLACES = WITH_ASAN ? 60 : 300 };

/* A crease pattern as text: a Miura-ori of n x n, or one that no vertex of can fold (n x n squares, all mountains). */
static char *opx(int n, int locked)
{
    const size_t room = 4096 + 400 * (size_t)(2 * n * (n + 1));
    char *s = malloc(room);
    assert_non_null(s);
    int at = snprintf(s, room, "<java><object class=\"oripa.DataSet\"><void property=\"title\"><string>A title</string></void>"
                               "<void property=\"lines\"><array class=\"oripa.OriLineProxy\">\n");
    int index = 0;
    for (int r = 0; r <= n; r++)
        for (int c = 0; c <= n; c++)
            for (int up = 0; up < 2; up++) {
                if (up ? r == n : c == n) continue;
                const double lean = locked ? 0 : 0.4, x = 1.25 * c + lean * (r % 2), to = up ? 1.25 * c + lean * !(r % 2) : x + 1.25;
                const int zigzag = c % 2 ? 2 : 3, right = (c + r) % 2 ? 3 : 2, rim = up ? c == 0 || c == n : r == 0 || r == n;
                at += snprintf(s + at, room - (size_t)at,
                               "<void index=\"%d\"><object class=\"oripa.OriLineProxy\"><void property=\"type\"><int>%d</int></void>"
                               "<void property=\"x0\"><double>%.17g</double></void><void property=\"x1\"><double>%.17g</double></void>"
                               "<void property=\"y0\"><double>%d.0</double></void><void property=\"y1\"><double>%d.0</double></void></object></void>\n",
                               index++, rim ? 1 : locked ? 2 : up ? zigzag : right, x, to, r, up ? r + 1 : r);
            }
    snprintf(s + at, room - (size_t)at, "</array></void></object></java>\n");
    return s;
}

/* ------------------------------------------------------------------------------------- one place after the other ---- */

/* Something that asks `c` for memory: a status, and RG_OK leaves nothing behind but what `check` then finds and undoes. */
typedef rg_status (*call)(void *ctx, counted *c, rg_diag *why);

/* Refuses at the k-th request and at all after it, for every k until the call comes through. */
static void refuse_everywhere(call f, void *ctx)
{
    counted all = {1000000000, 0, 0};
    rg_diag why = {-1, ""};
    const rg_status plain = f(ctx, &all, &why);
    if (plain != RG_OK) print_error("with all memory: %s\n", why.text);
    assert_int_equal(plain, RG_OK);
    const long requests = all.asked, stride = requests > MOST_PLACES ? requests / MOST_PLACES : 1;
    assert_int_equal(all.out, 0);
    assert_true(requests > 0);
    for (long k = 0; k < requests; k += stride) {
        counted c = {k, 0, 0};
        why = (rg_diag){-1, ""};
        const rg_status s = f(ctx, &c, &why);
        if (s != RG_ENOMEM || c.out != 0) {
            print_error("request %ld of %ld refused: status %d \"%s\", %ld blocks left\n", k, requests, s, why.text, (long)c.out);
            fail();
        }
    }
    counted enough = {requests, 0, 0};
    assert_int_equal(f(ctx, &enough, &why), RG_OK);
    assert_int_equal(enough.out, 0);
}

typedef struct job {
    char *text;
    rg_settings settings;
    const char *path, *folder;
    const rg_picture *picture;
    double folded;
} job;

static rg_settings with(const job *j, rg_memory *mem)
{
    rg_settings s = j->settings;
    s.memory = mem;
    return s;
}

static rg_reading reading_with(rg_memory *mem)
{
    rg_reading r = rg_reading_default();
    r.memory = mem;
    return r;
}

static rg_status parse(void *ctx, counted *c, rg_diag *why)
{
    const job *j = ctx;
    rg_memory mem = {counted_resize, c};
    const rg_reading s = reading_with(&mem);
    rg_pattern *p = NULL;
    rg_status status = rg_pattern_parse(j->text, strlen(j->text), &s, &p, why);
    assert_int_equal(p != NULL, status == RG_OK);
    rg_pattern_destroy(p);
    return status;
}

static rg_status read_file(void *ctx, counted *c, rg_diag *why)
{
    const job *j = ctx;
    rg_memory mem = {counted_resize, c};
    const rg_reading s = reading_with(&mem);
    rg_pattern *p = NULL;
    rg_status status = rg_pattern_read(j->path, &s, &p, why);
    assert_int_equal(p != NULL, status == RG_OK);
    rg_pattern_destroy(p);
    return status;
}

/* With memory of its own, so that what is refused later is not the reading. */
static rg_pattern *pattern_of(const job *j)
{
    rg_pattern *p = NULL;
    rg_diag why;
    if (rg_pattern_parse(j->text, strlen(j->text), NULL, &p, &why) != RG_OK) fail_msg("%s", why.text);
    return p;
}

static rg_status create_fold(void *ctx, counted *c, rg_diag *why)
{
    const job *j = ctx;
    rg_memory mem = {counted_resize, c};
    rg_settings s = with(j, &mem);
    rg_pattern *p = pattern_of(j);
    rg_straight *f = NULL;
    rg_status status = rg_straight_create(p, &s, &f, why);
    assert_int_equal(f != NULL, status == RG_OK);
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
    return status;
}

static rg_status create_motion(void *ctx, counted *c, rg_diag *why)
{
    job *j = ctx;
    rg_memory mem = {counted_resize, c};
    rg_settings s = with(j, &mem);
    rg_pattern *p = pattern_of(j);
    rg_motion *m = NULL;
    rg_status status = rg_motion_create(p, &s, NULL, NULL, &m, why);
    assert_int_equal(m != NULL, status == RG_OK);
    rg_pattern_destroy(p);
    if (m) {
        double xyz[200][3];
        rg_sheet sheet;
        sheet = *rg_motion_get_sheet(m);
        assert_true(sheet.vertices <= 200);
        j->folded = rg_motion_report(m)->folded_percent;
        const long asked = c->asked;
        c->left = 0;
        assert_int_equal(rg_motion_pose(m, 0, xyz), RG_ENOMEM);
        c->left = 1000000;
        assert_int_equal(rg_motion_pose(m, 0, xyz), RG_OK);
        c->asked = asked;
    }
    rg_motion_destroy(m);
    return status;
}

static rg_status find_layers(void *ctx, counted *c, rg_diag *why)
{
    job *j = ctx;
    rg_memory mem = {counted_resize, c};
    rg_pattern *p = NULL;
    rg_layers *l = NULL;
    if (rg_pattern_read(j->path, NULL, &p, why) != RG_OK) fail_msg("%s", why->text);
    rg_status status = rg_layers_create(p, &mem, &l, why);
    assert_int_equal(l != NULL, status == RG_OK);
    if (l) {
        rg_layers_info info;
        info = *rg_layers_get_info(l);
        uint64_t *which = calloc((size_t)info.parts + 1, sizeof *which);
        rg_layers_pair *pair = calloc((size_t)info.pairs, sizeof *pair);
        assert_int_equal(info.state, RG_LAYERS_VALID);
        assert_int_equal(rg_layers_which(l, 40, which), RG_OK);
        status = rg_layers_order(l, which, pair);
        free(which);
        free(pair);
    }
    rg_layers_destroy(l);
    rg_pattern_destroy(p);
    return status;
}

static void layers(void **state)
{
    (void)state;
    job j = {.path = "patterns/four-crane.opx", .settings = rg_settings_default()};
    refuse_everywhere(find_layers, &j);
}

/* ------------------------------------------------------------------------------------------------------- reading ---- */

static void reading(void **state)
{
    (void)state;
    job j = {.text = opx(4, 0), .settings = rg_settings_default()};
    refuse_everywhere(parse, &j);
    free(j.text);
    j.path = "patterns/miura.opx";
    refuse_everywhere(read_file, &j);
}

static void folds(void **state)
{
    (void)state;
    static const rg_solver solvers[] = {RG_SOLVER_AUTO, RG_SOLVER_CG, RG_SOLVER_CHOLESKY, RG_SOLVER_SVD};
    job j = {.text = opx(4, 0), .settings = rg_settings_default()};
    for (int i = 0; i < 4; i++) {
        j.settings.solver = solvers[i];
        rg_pattern *p = pattern_of(&j);
        rg_straight *f = NULL;
        rg_diag why;
        const rg_status s = rg_straight_create(p, &j.settings, &f, &why);
        rg_straight_destroy(f);
        rg_pattern_destroy(p);
        if (s == RG_EABSENT) {
            print_message("SKIPPED: built with GPL=0, without one of the solvers\n");
            continue;
        }
        refuse_everywhere(create_fold, &j);
    }
    free(j.text);
}

static void motions(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        job j = {.text = opx(3, 0), .settings = rg_settings_default()};
        j.settings.frames = 4;
        j.settings.effort = kind == 3 ? RG_EFFORT_NORMAL : RG_EFFORT_FAST;
        j.settings.triangulate = kind == 1 ? RG_TRIANGULATE_ALL : RG_TRIANGULATE_AUTO;
        if (kind == 2) j.settings.adjust = 0.1;
        refuse_everywhere(create_motion, &j);
        if (kind == 0) near(j.folded, 100, 1);
        free(j.text);
    }
}

/* A sheet that does not simply fold is tried in several ways: each of them may run out of memory. */
static void motions_that_stop_short(void **state)
{
    (void)state;
    job j = {.text = opx(3, 1), .settings = rg_settings_default()};
    j.settings.frames = 3;
    j.settings.effort = RG_EFFORT_FAST;
    refuse_everywhere(create_motion, &j);
    j.settings.triangulate = RG_TRIANGULATE_NONE;
    j.settings.adjust = 0;
    refuse_everywhere(create_motion, &j);
    assert_true(j.folded < 99);
    free(j.text);
}

/* ---------------------------------------------------------------------------------------------------------- steps ---- */

static void stepping_asks_for_nothing(void **state)
{
    (void)state;
    static const rg_method methods[] = {RG_METHOD_AUTO, RG_METHOD_EULER, RG_METHOD_NEWTON, RG_METHOD_HEUN, RG_METHOD_RK4, RG_METHOD_ADAPTIVE};
    static const rg_solver solvers[] = {RG_SOLVER_CG, RG_SOLVER_CHOLESKY, RG_SOLVER_SVD};
    int folded = 0;
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 3; k++)
            for (int locked = 0; locked < 2; locked++) {
                job j = {.text = opx(3, locked), .settings = rg_settings_default()};
                counted c = {1000000000, 0, 0};
                rg_memory mem = {counted_resize, &c};
                rg_settings s = with(&j, &mem);
                rg_straight *f = NULL;
                rg_step_info info = {0};
                rg_diag why = {0, ""};
                s.method = methods[i];
                s.solver = solvers[k];
                s.frames = 6;
                s.triangulate = locked ? RG_TRIANGULATE_ALL : RG_TRIANGULATE_NONE;
                rg_pattern *p = pattern_of(&j);
                const rg_status status = rg_straight_create(p, &s, &f, &why);
                rg_pattern_destroy(p); /* the fold has taken what it needs */
                free(j.text);
                if (status == RG_EABSENT) {
                    print_message("SKIPPED: built with GPL=0, without one of the solvers\n");
                    continue;
                }
                assert_int_equal(status, RG_OK);
                const long asked = c.asked, out = c.out;
                c.left = 0;
                int steps = 0;
                for (; info.outcome == RG_RUNNING && steps < 3000; steps++) {
                    assert_int_equal(rg_straight_step(f, &info), RG_OK);
                    assert_int_equal(c.asked, asked);
                }
                assert_int_equal(c.out, out);
                assert_true(steps > 1);
                assert_true(info.outcome != RG_RUNNING);
                folded += info.outcome == RG_FOLDED;
                rg_straight_destroy(f);
                assert_int_equal(c.out, 0);
            }
    assert_true(folded > 0);
}

/* ------------------------------------------------------------------------------------------------------- writing ---- */

/* Files there, and in folders there; one half written has the name of a temporary one. */
static int files_in(const char *folder)
{
    DIR *d = opendir(folder);
    int n = 0;
    assert_non_null(d);
    for (struct dirent *e = readdir(d); e; e = readdir(d)) {
        char path[600];
        struct stat is;
        if (e->d_name[0] == '.') continue;
        if (strstr(e->d_name, ".part")) fail_msg("%s is left behind", e->d_name);
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        assert_int_equal(stat(path, &is), 0);
        n += S_ISDIR(is.st_mode) ? files_in(path) : 1;
    }
    closedir(d);
    return n;
}

static void empty(const char *folder)
{
    DIR *d = opendir(folder);
    char path[600];
    assert_non_null(d);
    for (struct dirent *e = readdir(d); e; e = readdir(d)) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        if (unlink(path) != 0) empty(path), rmdir(path);
    }
    closedir(d);
}

/* A motion whose memory is refused from the writing on. */
typedef struct written { rg_motion *m; counted *shared; const char *folder, *name; int report, many; } written;

static rg_status write_one(void *ctx, counted *c, rg_diag *why)
{
    const written *w = ctx;
    rg_picture picture = rg_picture_default();
    char path[300];
    picture.width = 96, picture.height = 72;
    snprintf(path, sizeof path, "%s/%s", w->folder, w->name);
    const long before = w->shared->out, asked = w->shared->asked;
    w->shared->left = c->left;
    rg_status s = w->report ? rg_report_write(w->m, 0.25, 1e6, path, why) : rg_motion_write(w->m, path, &picture, why);
    w->shared->left = 1000000000;
    c->asked = w->shared->asked - asked;
    c->out = w->shared->out - before;
    const int files = files_in(w->folder);
    if (s == RG_OK) assert_true(files > 0);
    else if (files > 0 && !w->many) fail_msg("%s: something is left behind", w->name); /* of many, those that are whole may stay */
    empty(w->folder);
    return s;
}

static void writing(void **state)
{
    (void)state;
    static const char *const names[] = {"x.csv", "x.obj", "x-%04d.obj", "x.stl", "x.glb", "x.gltf", "x.fold", "x.svg", "x.html"};
    char folder[] = "/tmp/rigami-alloc-XXXXXX";
    assert_non_null(mkdtemp(folder));
    job j = {.text = opx(3, 0), .settings = rg_settings_default()};
    counted c = {1000000000, 0, 0};
    rg_memory mem = {counted_resize, &c};
    rg_settings s = with(&j, &mem);
    rg_diag why = {0, ""};
    s.frames = 3;
    rg_pattern *p = pattern_of(&j);
    written w = {.shared = &c, .folder = folder};
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &w.m, &why), RG_OK);
    for (size_t i = 0; i <= sizeof names / sizeof *names; i++) {
        w.report = i == sizeof names / sizeof *names;
        w.name = w.report ? "x.json" : names[i];
        w.many = strchr(w.name, '%') || strchr(w.name, '/');
        print_message("%s\n", w.name);
        refuse_everywhere(write_one, &w);
    }
    rg_motion_destroy(w.m);
    rg_pattern_destroy(p);
    assert_int_equal(c.out, 0);
    free(j.text);
    assert_int_equal(rmdir(folder), 0);
}

static void pictures(void **state)
{
    (void)state;
    static const char *const names[] = {"x.png", "x.gif", "x.apng", "x-%02d.png", "pictures/"};
    char folder[] = "/tmp/rigami-alloc-XXXXXX";
    rg_diag why = {0, ""};
    assert_non_null(mkdtemp(folder));
    job j = {.text = opx(2, 0), .settings = rg_settings_default()};
    counted c = {1000000000, 0, 0};
    rg_memory mem = {counted_resize, &c};
    rg_settings s = with(&j, &mem);
    s.frames = 2;
    rg_pattern *p = pattern_of(&j);
    written w = {.shared = &c, .folder = folder};
    assert_int_equal(rg_motion_create(p, &s, NULL, NULL, &w.m, &why), RG_OK);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        w.name = names[i];
        w.many = strchr(w.name, '%') || strchr(w.name, '/');
        print_message("%s\n", w.name);
        refuse_everywhere(write_one, &w);
    }
    rg_motion_destroy(w.m);
    rg_pattern_destroy(p);
    assert_int_equal(c.out, 0);
    free(j.text);
    assert_int_equal(rmdir(folder), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading),
        cmocka_unit_test(layers),
        cmocka_unit_test(folds),
        cmocka_unit_test(stepping_asks_for_nothing),
        cmocka_unit_test(motions),
        cmocka_unit_test(motions_that_stop_short),
        cmocka_unit_test(writing),
        cmocka_unit_test(pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
