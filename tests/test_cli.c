/* The command line from outside: how it ends, what it says and where, what it leaves behind. $RIGAMI is the program. */
#include "corpus.h"
#include "folder.h"
#include "near.h"
#include "rigami.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <limits.h>
#include <dirent.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

enum { MOST_ARGS = 40, ROOM = 1 << 20, LINES = 20 };

static char program[PATH_MAX], folder[] = "/tmp/rigami-cli-XXXXXX";

/* ----------------------------------------------------------------------------------------------- running ---- */

typedef struct ran {
    int status;                 /* of exit; 1000 and more: a signal */
    char out[ROOM], err[ROOM];
} ran;

/* Where a run's standard streams are, if not at the usual places. */
typedef struct streams {
    const char *in, *out; /* files; NULL: /dev/null, "stdout" */
    int out_fd;           /* in place of `out`, if above 0 */
    int closed;           /* standard output is closed */
} streams;

static char *slurp(const char *path, char *text)
{
    FILE *f = fopen(path, "rb");
    size_t n = f ? fread(text, 1, ROOM - 1, f) : 0;
    if (f) fclose(f);
    text[n] = 0;
    return text;
}

static pid_t start(const char *const *args, const streams *s)
{
    char *argv[MOST_ARGS + 2] = {program};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t usual;
    pid_t pid = 0;
    for (int i = 0; args[i]; i++) {
        assert_true(i < MOST_ARGS);
        argv[i + 1] = (char *)args[i];
    }
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, s->in ? s->in : "/dev/null", O_RDONLY, 0);
    if (s->closed) posix_spawn_file_actions_addclose(&actions, 1);
    else if (s->out_fd > 0) posix_spawn_file_actions_adddup2(&actions, s->out_fd, 1);
    else posix_spawn_file_actions_addopen(&actions, 1, s->out ? s->out : "stdout", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&actions, 2, "stderr", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    /* Whoever runs the tests may ignore interrupts, and that is handed down. */
    sigemptyset(&usual);
    sigaddset(&usual, SIGINT);
    sigaddset(&usual, SIGTERM);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    assert_int_equal(posix_spawn(&pid, program, &actions, &attributes, argv, environ), 0);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return pid;
}

static const ran *finish(pid_t pid)
{
    static ran r;
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    r.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    slurp("stdout", r.out);
    slurp("stderr", r.err);
    return &r;
}

static const ran *run_with(const streams *s, const char *const *args)
{
    unlink("stdout");
    return finish(start(args, s));
}

#define ARGS(...) (const char *const[]){__VA_ARGS__, NULL}
#define run(...) run_with(&(streams){0}, ARGS(__VA_ARGS__))
#define ends(status_wanted, ran_) check_end(status_wanted, ran_, __LINE__)

static const ran *check_end(int status, const ran *r, int line)
{
    if (r->status != status) {
        print_error("%s:%d: ended with %d, not %d, saying: %s\n", __FILE__, line, r->status, status, r->err);
        fail();
    }
    return r;
}

static int lines_in(const char *text)
{
    int n = 0;
    for (; *text; text++) n += *text == '\n';
    return n;
}

/* Exactly one line on standard error, that begins with `start` and has `part` in it. */
static void says(const ran *r, const char *begin, const char *part)
{
    if (lines_in(r->err) == 1 && strncmp(r->err, begin, strlen(begin)) == 0 && strstr(r->err, part)) return;
    print_error("not one line that begins \"%s\" and has \"%s\" in it, but: %s\n", begin, part, r->err);
    fail();
}

static int there(const char *path)
{
    struct stat is;
    return stat(path, &is) == 0;
}

static int is_empty(const char *path)
{
    struct stat is;
    return stat(path, &is) != 0 || is.st_size == 0;
}

/* Names in the folder that begin so. */
static int names(const char *begin)
{
    int n = 0;
    DIR *d = opendir(".");
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) n += strncmp(e->d_name, begin, strlen(begin)) == 0;
    closedir(d);
    return n;
}

/* --------------------------------------------------------------------------------------------- patterns ---- */

typedef struct drawn { int type; double x0, y0, x1, y1; } drawn;

/* Writes ORIPA's form by hand, one drawn line on one line of text; returns the text's line of the first. */
static int draw(const char *path, const drawn *line, int n)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fprintf(f, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<java version=\"1.6.0_31\" class=\"java.beans.XMLDecoder\">\n"
               "<object class=\"oripa.DataSet\">\n<void property=\"lines\"><array class=\"oripa.OriLineProxy\" length=\"%d\">\n", n);
    for (int i = 0; i < n; i++) {
        const double v[] = {line[i].x0, line[i].x1, line[i].y0, line[i].y1};
        static const char *const name[] = {"x0", "x1", "y0", "y1"};
        fprintf(f, "<void index=\"%d\"><object class=\"oripa.OriLineProxy\"><void property=\"type\"><int>%d</int></void>", i,
                line[i].type);
        for (int k = 0; k < 4; k++)
            if (isnan(v[k])) fprintf(f, "<void property=\"%s\"><double>NaN</double></void>", name[k]);
            else fprintf(f, "<void property=\"%s\"><double>%.17g</double></void>", name[k], v[k]);
        fprintf(f, "</object></void>\n");
    }
    fprintf(f, "</array></void>\n</object>\n</java>\n");
    assert_int_equal(fclose(f), 0);
    return 5;
}

/* A square sheet with one vertex in its middle, creases at those angles (radians): 'M' or 'V'. */
static int draw_vertex(const char *path, int n, const double *angle, const char *assignment)
{
    const double half = 187.5;
    drawn line[LINES] = {{1, -half, -half, half, -half}, {1, half, -half, half, half}, {1, half, half, -half, half},
                         {1, -half, half, -half, -half}};
    for (int i = 0; i < n; i++) {
        const double c = cos(angle[i]), s = sin(angle[i]), reach = half / fmax(fabs(c), fabs(s));
        line[4 + i] = (drawn){assignment[i] == 'M' ? 2 : 3, 0, 0, reach * c, reach * s};
    }
    return draw(path, line, 4 + n);
}

/* good.opx folds: opposite sectors add up to pi, the least is between unlike creases. short.opx cannot fold flat: they
 * do not. stuck.opx cannot move: three creases. torn.opx is no sheet but two. */
static void draw_all(void)
{
    const double a = 1.25, b = 0.9375, pi = 3.14159265358979323846;
    const drawn torn[] = {{1, 0, 0, 100, 0},   {1, 100, 0, 40, 80},   {1, 40, 80, 0, 0},
                          {1, 150, 0, 250, 0}, {1, 250, 0, 190, 80}, {1, 190, 80, 150, 0}};
    draw_vertex("good.opx", 4, (const double[]){0.1, 0.1 + a, 0.1 + a + b, 0.1 + pi + b}, "MVMM");
    draw_vertex("short.opx", 4, (const double[]){0.1, 0.1 + a, 0.1 + a + b, 0.3 + pi + b}, "MVMM");
    draw_vertex("stuck.opx", 3, (const double[]){0.1, 2.2, 4.5}, "MMM");
    draw("torn.opx", torn, 6);
}

/* ---------------------------------------------------------------------------------------------- how it ends ---- */

static void a_pattern_folds(void **state)
{
    (void)state;
    const ran *r = ends(0, run("fold", "good.opx"));
    assert_string_equal(r->err, "");
    assert_non_null(strstr(r->out, "100.0 %"));
    r = ends(0, run("fold", "good.opx", "-q"));
    assert_string_equal(r->err, "");
    assert_string_equal(r->out, "");
}

static void a_fold_that_stops_short_is_written_and_explained(void **state)
{
    (void)state;
    const char *const files[] = {"short.opx", "stuck.opx"};
    for (int i = 0; i < 2; i++) {
        char begin[80];
        const ran *r = ends(1, run("fold", files[i], "-q", "--triangulate", "none", "--adjust", "off", "-o", "short.fold", "-o",
                                   "short.csv", "--report", "short.json"));
        snprintf(begin, sizeof begin, "rigami: %s: stopped at ", files[i]);
        assert_int_equal(strncmp(r->err, begin, strlen(begin)), 0);
        assert_non_null(strstr(r->err, "vert")); /* the vertex that blocks is the middle */
        json_t *report = json_load_file("short.json", 0, NULL);
        assert_non_null(report);
        const json_t *result = json_object_get(report, "result");
        assert_string_equal(json_string_value(json_object_get(result, "outcome")), "stopped");
        assert_true(json_string_length(json_object_get(result, "reason")) > 0);
        assert_true(json_array_size(json_object_get(result, "blocking_vertices")) > 0);
        below(json_number_value(json_object_get(result, "least_folded_percent")), 99);
        json_decref(report);
        assert_false(is_empty("short.fold"));
        assert_false(is_empty("short.csv"));
        unlink("short.fold");
        unlink("short.csv");
        unlink("short.json");
    }
}

static void write_file(const char *name, const char *text)
{
    FILE *f = fopen(name, "w");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

/* What, where in the file's own coordinates (y down), why and by how much, what next; then the file; no more. */
static void the_verdict_comes_first(void **state)
{
    (void)state;
    write_file("odd.cp", "1 0 0 8 0\n1 8 0 8 6\n1 8 6 0 6\n1 0 6 0 0\n2 3 2 0 0\n2 3 2 8 0\n3 3 2 3 6\n");
    const ran *r = ends(1, run("fold", "odd.cp", "-o", "odd.csv"));
    assert_int_equal(lines_in(r->err), 2);
    assert_true(strstr(r->err, "gets to its end only with creases moved by") && strstr(r->err, "at (3, 2) 3 creases meet, an odd number. Next: mend"));
    assert_non_null(strstr(r->err, "rigami: odd.cp: written up to there: odd.csv"));
    assert_string_equal(r->out, "");
    r = ends(0, run("info", "odd.cp"));
    assert_int_equal(strncmp(r->out, "It does not fold flat: at (3, 2) 3 creases meet", 47), 0);
    const int few = lines_in(r->out);
    assert_true(lines_in(ends(0, run("info", "odd.cp", "-v"))->out) > few);
    /* What crosses says what speaks against it, if anything does, and how far it may be folded. */
    write_file("over.cp", "1 0 0 10 0\n1 10 0 10 1\n1 10 1 0 1\n1 0 1 0 0\n3 4 0 4 1\n3 5 0 5 1\n");
    r = ends(1, run("fold", "over.cp"));
    int to = 0;
    assert_true(strstr(r->err, "cannot be put in order") && strstr(r->err, "Next: ") && sscanf(strstr(r->err, "--to "), "--to %d", &to) == 1);
    char part[20];
    snprintf(part, sizeof part, "%d", to);
    ends(0, run("fold", "over.cp", "--to", part, "--contact", "report"));
    assert_int_equal(strncmp(ends(0, run("info", "over.cp"))->out, "The sheet does not fold flat without passing through itself", 59), 0);
    /* All creases end short of the border: that is no success, whatever there was to fold. */
    write_file("short-of-it.cp", "1 0 0 8 0\n1 8 0 8 6\n1 8 6 0 6\n1 0 6 0 0\n2 4 0.01 4 5.99\n");
    r = ends(1, run("fold", "short-of-it.cp"));
    assert_true(strstr(r->err, "the next line is 0.01 away; --merge 0.0013 joins them") && strstr(r->err, "nothing is folded"));
    ends(0, run("fold", "short-of-it.cp", "--merge", "0.0013"));
    r = ends(0, run("fold", "good.opx", "-o", "good.csv"));
    assert_non_null(strstr(r->out, "written   good.csv"));
    unlink("odd.csv");
    unlink("good.csv");
}

/* States of a sheet in the frames of one file are gone through as those of several files are. */
static void states_in_frames(void **state)
{
    (void)state;
    write_file("door.fold", "{\"vertices_coords\":[[0,0],[3,0],[3,2],[0,2]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],"
               "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"V\"],\"file_frames\":["
               "{\"frame_parent\":0,\"frame_inherit\":true,\"edges_foldAngle\":[0,0,0,0,40]},"
               "{\"frame_parent\":0,\"frame_inherit\":true,\"edges_foldAngle\":[0,0,0,0,100]}]}");
    assert_non_null(strstr(ends(0, run("fold", "door.fold"))->err, "--frame 1-2 goes through them"));
    const char *const lists[] = {"1-2", "1,2", "all"};
    for (int i = 0; i < 3; i++) {
        ends(0, run("fold", "door.fold", "--frame", lists[i], "--frames", "3", "-q", "-o", "door.csv"));
        static char text[ROOM];
        double first, last;
        assert_int_equal(sscanf(strchr(slurp("door.csv", text), '\n'), "\n0,0,%lf\n%*d,%*f,%*f\n2,100,%lf", &first, &last), 2);
        near(first, 40, 1e-9);
        near(last, 100, 1e-9);
    }
    says(ends(2, run("fold", "door.fold", "--frame", "2-1")), "rigami: --frame: ", "2-1");
    /* What has none has no frame 1. */
    says(ends(2, run("fold", "good.opx", "--frame", "1-4")), "rigami: good.opx: ", "only FOLD files have frames");
    says(ends(2, run("info", "good.opx", "--frame", "7")), "rigami: good.opx: ", "no frame 7");
    ends(0, run("info", "good.opx", "--frame", "0"));
    /* So are those of a motion: frames that say where the sheet is folded to, too. A state that is flat is one. */
    ends(0, run("fold", "good.opx", "-q", "--frames", "4", "-o", "door.fold"));
    ends(0, run("fold", "door.fold", "--frame", "all", "--frames", "7", "-q", "-o", "door.csv", "-o", "again.fold"));
    static char text[ROOM];
    double first, last;
    assert_int_equal(sscanf(strchr(slurp("door.csv", text), '\n'), "\n0,0,%lf,%*[^\n]\n%*[^\n]\n%*[^\n]\n%*[^\n]\n%*[^\n]\n%*[^\n]\n6,100,%lf", &first, &last), 2);
    near(first, 0, 0);
    near(fabs(last), 180, 1e-9);
    unlink("door.csv");
    unlink("again.fold");
}

/* Numbers of a table are those that one means, without the rounding of what computed them. */
static void tables_are_tidy(void **state)
{
    (void)state;
    static const char *const angles[] = {"1", "30.1", "120.7", "179"};
    static const char *const halves[] = {"0.5", "15.05", "60.35", "89.5"};
    for (int i = 0; i < 4; i++) {
        static char text[ROOM];
        char file[400], row[40];
        snprintf(file, sizeof file, "{\"vertices_coords\":[[0,0],[3,0],[3,2],[0,2]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],"
                 "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"V\"],\"edges_foldAngle\":[0,0,0,0,%s]}", angles[i]);
        write_file("tidy.fold", file);
        ends(0, run("fold", "tidy.fold", "--frames", "3", "-q", "-o", "tidy.csv"));
        snprintf(row, sizeof row, "\n1,50,%s\n2,100,%s\n", halves[i], angles[i]);
        assert_non_null(strstr(slurp("tidy.csv", text), row));
    }
    unlink("tidy.csv");
}

/* What moves nothing is not told as folded; a drawing whose creases are all lost is no success. */
static void what_does_not_move_is_told(void **state)
{
    (void)state;
    const char *const border = "1 0 0 8 0\n1 8 0 8 6\n1 8 6 0 6\n1 0 6 0 0\n";
    char text[200];
    write_file("still.cp", border);
    assert_non_null(strstr(ends(0, run("fold", "still.cp"))->out, "nothing to fold, as there is no crease"));
    snprintf(text, sizeof text, "%s2 1 0 5 0\n", border); /* a crease on the border */
    write_file("still.cp", text);
    assert_non_null(strstr(ends(1, run("fold", "still.cp"))->err, "nothing is folded: no crease is left to fold"));
    write_file("still.svg", "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 8 6'><rect width='8' height='6' stroke='#000'/>"
               "<path d='M0 0 8 6' stroke='#f0f'/></svg>");
    assert_non_null(strstr(ends(0, run("fold", "still.svg", "--line", "#ff00ff=unassigned"))->out, "nothing moves, as no crease says"));
    write_file("still.svg", "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 8 6'><rect width='8' height='6' stroke='#000'/>"
               "<path d='M0 0 8 6' stroke='red' opacity='0'/></svg>");
    assert_non_null(strstr(ends(0, run("fold", "still.svg"))->out, "--no-targets"));
    assert_non_null(strstr(ends(0, run("info", "still.svg"))->out, "Nothing will move"));
    assert_non_null(strstr(ends(0, run("fold", "still.svg", "--no-targets"))->out, "folded, 100.0 %"));
    /* An end near a corner: the tolerance that is named joins it there, and leaves the paper's other corners. */
    write_file("still.svg", "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 8 8'><rect width='8' height='8' stroke='#000'/>"
               "<path d='M.03 .03 8 8' stroke='red'/></svg>");
    double line = NAN, corner = NAN, merge = NAN;
    const char *told = strstr(ends(1, run("fold", "still.svg"))->err, "the next line is");
    assert_true(told && sscanf(told, "the next line is %lf away, a corner %lf; --merge %lf joins", &line, &corner, &merge) == 3);
    near(corner, 0.03 * sqrt(2), 0.001);
    snprintf(text, sizeof text, "%g", merge);
    const ran *r = ends(0, run("fold", "still.svg", "--merge", text));
    assert_string_equal(r->err, "");
}

/* Frames of others may put a facet into a point, or the sheet a long way off: what there is is drawn, or it is refused,
 * in a time that does not go by how far that is. */
static void a_motion_of_any_size_is_drawn(void **state)
{
    (void)state;
    static const char head[] =
        "{\"vertices_coords\":[[0,0],[1,0],[2,0],[2,1],[1,1],[0,1]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,4],[4,5],[5,0],[1,4]],"
        "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"V\"],\"file_frames\":[";
    static const struct { const char *frame; int ends; } tried[] = {
        {"[[0,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[0,1,0]]", 0},
        {"[[0,0,1e99],[1,0,1e99],[2,0,1e99],[2,1,1e99],[1,1,1e99],[0,1,1e99]]", 0},
        {"[[0,0,0],[1e30,0,0],[2e30,0,0],[2e30,1e30,0],[1e30,1e30,0],[0,1e30,0]]", 2},
        {"[[0,0,0],[1e99,0,0],[-1e99,0,0],[2,1,0],[1,1,0],[0,1,0]]", 2},
        {"[[0,0,0],[1e101,0,0],[2,0,0],[2,1,0],[1,1,0],[0,1,0]]", 2}};
    static char text[2000], table[ROOM];
    for (size_t i = 0; i < sizeof tried / sizeof *tried; i++) {
        snprintf(text, sizeof text, "%s{\"vertices_coords\":%s},{\"vertices_coords\":%s}]}", head, tried[i].frame, tried[i].frame);
        write_file("far.fold", text);
        const ran *r = run("draw", "far.fold", "-q", "-o", "far.html", "-o", "far.glb", "--max-seconds", "30");
        ends(tried[i].ends, r);
        if (tried[i].ends) says(r, "rigami: far.fold:1: ", "large");
    }
    /* A percent of any size is a number. */
    snprintf(text, sizeof text, "%s{\"rigami:percent\":1e308,\"vertices_coords\":[[0,0,0],[1,0,0],[2,0,0],[2,1,0],[1,1,0],[0,1,0]]}]}", head);
    write_file("far.fold", text);
    ends(0, run("draw", "far.fold", "-q", "-o", "far.csv"));
    assert_null(strstr(slurp("far.csv", table), "inf"));
    const char *const made[] = {"far.html", "far.glb", "far.csv"};
    for (int i = 0; i < 3; i++) unlink(made[i]);
}

/* A motion is drawn again from its file: what is drawn is the same, and nothing is folded. */
static void a_motion_is_drawn_again(void **state)
{
    (void)state;
    static char first[ROOM], again[ROOM];
    ends(0, run("fold", "good.opx", "-q", "--frames", "7", "-o", "good.fold", "-o", "first.stl"));
    const ran *r = ends(0, run("draw", "good.fold", "-o", "again.stl", "-o", "again.csv", "-o", "again.html"));
    assert_non_null(strstr(r->out, "7 frames"));
    struct stat a, b;
    assert_true(stat("first.stl", &a) == 0 && stat("again.stl", &b) == 0 && a.st_size == b.st_size);
    FILE *f = fopen("first.stl", "rb"), *g = fopen("again.stl", "rb");
    assert_true(f && g && fread(first, 1, (size_t)a.st_size, f) == (size_t)a.st_size && fread(again, 1, (size_t)a.st_size, g) == (size_t)a.st_size);
    fclose(f);
    fclose(g);
    for (long at = 84; at + 4 <= a.st_size; at += at % 50 == 30 ? 6 : 4) {
        float x, y;
        memcpy(&x, first + at, 4);
        memcpy(&y, again + at, 4);
        near(x, y, 1e-5);
    }
    says(ends(2, run("draw", "good.opx", "-o", "again.png")), "rigami: good.opx", "");
    write_file("flat.fold", "{\"vertices_coords\":[[0,0],[3,0],[3,2],[0,2]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],"
               "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"V\"]}");
    says(ends(2, run("draw", "flat.fold", "-o", "again.csv")), "rigami: flat.fold:1: ", "no frame has vertices_coords");
    says(ends(2, run("draw", "good.fold")), "rigami: ", "-o");
    /* A sheet that stretches, as other programs' do: half of it turns by 30 degrees and gets longer; angles are those that it lies at. */
    write_file("soft.fold", "{\"vertices_coords\":[[0,0],[1,0],[2,0],[2,1],[1,1],[0,1]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,4],[4,5],[5,0],[1,4]],"
               "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"V\"],\"faces_vertices\":[[0,1,4,5],[1,2,3,4]],\"file_frames\":["
               "{\"frame_inherit\":true,\"frame_parent\":0,\"vertices_coords\":[[0,0,0],[1,0,0],[2,0,0],[2,1,0],[1,1,0],[0,1,0]]},"
               "{\"frame_inherit\":true,\"frame_parent\":0,\"vertices_coords\":[[-0.0392304845413264,0,0.6],[1,0,0],[2,0,0],[2,1,0],[1,1,0],"
               "[-0.0392304845413264,1,0.6]]}]}");
    ends(0, run("draw", "soft.fold", "-o", "again.csv", "-o", "again.stl", "-o", "first.stl"));
    double angle;
    assert_int_equal(sscanf(strstr(slurp("again.csv", first), "\n1,"), "\n1,100,%lf", &angle), 1);
    near(angle, 30, 1e-9);
    const char *const made[] = {"first.stl", "again.stl", "again.csv", "again.html", "good.fold"};
    for (int i = 0; i < 5; i++) unlink(made[i]);
}

/* A strip of five squares, rolled up: the last one finds its place taken, unless its creases move. */
static void creases_may_roll_so_far(void **state)
{
    (void)state;
    write_file("roll.cp", "1 0 0 5 0\n1 5 0 5 1\n1 5 1 0 1\n1 0 1 0 0\n3 1 0 1 1\n3 2 0 2 1\n3 3 0 3 1\n3 4 0 4 1\n");
    const char *const given[] = {"fold", "roll.cp", "-q", "--frames", "8", "--report", "roll.json", NULL};
    ends(0, run_with(&(streams){0}, given));
    json_t *report = json_load_file("roll.json", 0, NULL);
    assert_non_null(report);
    const double roll = 100 * json_number_value(json_object_get(json_object_get(report, "result"), "max_crease_roll"));
    json_decref(report);
    assert_true(roll > 0.1 && roll < 50);
    char less[40], more[40];
    snprintf(less, sizeof less, "%.9g", 0.99 * roll);
    snprintf(more, sizeof more, "%.9g", 1.01 * roll);
    says(ends(1, run("fold", "roll.cp", "-q", "--frames", "8", "--max-roll", less)), "rigami: roll.cp: ", "--max-roll");
    ends(0, run("fold", "roll.cp", "-q", "--frames", "8", "--max-roll", more));
    says(ends(2, run("fold", "roll.cp", "--max-roll", "101")), "rigami: --max-roll: ", "101");
    /* A crease by its number as tables have it. */
    ends(0, run("fold", "roll.cp", "-q", "--drive", "c2=60", "--report", "roll.json"));
    unlink("roll.cp");
    unlink("roll.json");
}

/* Each file by itself, one table, going on where it was; in parts that are joined; every sheet of a drawing. */
static void a_batch(void **state)
{
    (void)state;
    static char table[ROOM], again[ROOM];
    write_file("two.cp", "1 0 0 9 0\n1 9 0 9 9\n1 9 9 0 9\n1 0 9 0 0\n2 0 0 9 9\n1 20 0 29 0\n1 29 0 29 9\n1 29 9 20 9\n1 20 9 20 0\n3 20 0 29 9\n");
    const ran *r = ends(1, run("batch", "good.opx", "two.cp", "short.opx", "missing.opx", "-o", "batch/", "--frames", "4", "--effort", "fast",
                               "--adjust", "off", "--triangulate", "none", "--write", "csv"));
    assert_non_null(strstr(r->out, "5 files, 3 folded, 2 not"));
    slurp("batch/table.csv", table);
    assert_int_equal(lines_in(table), 6);
    const char *const rows[] = {",good.opx,0,0,folded,100", ",two.cp,1,0,folded,100", ",two.cp,2,0,folded,100", ",short.opx,0,1,stopped,", ",missing.opx,0,2,refused,"};
    const char *at = table;
    for (int i = 0; i < 5; i++) assert_non_null(at = strstr(at, rows[i])); /* in the order of the files */
    const char *const made[] = {"batch/good.json", "batch/good.csv", "batch/two-1.csv", "batch/two-2.csv", "batch/short.json", "batch/missing.log", "batch/table.txt"};
    for (int i = 0; i < 7; i++) assert_false(is_empty(made[i]));
    /* What is there is not made again, other options make it again. */
    const char *const same[] = {"batch", "good.opx", "-o", "batch", "--frames", "4", "--effort", "fast", "--adjust", "off", "--triangulate", "none", "--write", "csv", NULL};
    assert_non_null(strstr(ends(0, run_with(&(streams){0}, same))->out, "(kept)"));
    assert_null(strstr(ends(0, run("batch", "good.opx", "-o", "batch", "--frames", "5"))->out, "(kept)"));
    /* In parts, joined, it is one table. */
    ends(0, run("batch", "good.opx", "two.cp", "-o", "whole", "--frames", "4", "-q"));
    ends(0, run("batch", "good.opx", "two.cp", "-o", "parts", "--frames", "4", "-q", "--part", "2/2"));
    says(ends(1, run("batch", "good.opx", "two.cp", "-o", "parts", "--frames", "4", "-q", "--merge")), "rigami: batch: ", "1 of 3 files have no row");
    ends(0, run("batch", "good.opx", "two.cp", "-o", "parts", "--frames", "4", "-q", "--part", "1/2"));
    ends(0, run("batch", "good.opx", "two.cp", "-o", "parts", "--frames", "4", "-q", "--merge"));
    slurp("whole/table.csv", table);
    slurp("parts/table.csv", again);
    assert_int_equal(lines_in(table), 4);
    for (char *p = strtok(table, "\n"); p; p = strtok(NULL, "\n")) { /* but for the seconds */
        char head[200];
        snprintf(head, sizeof head, "%.60s", p);
        assert_non_null(strstr(again, head));
    }
    /* Another judge's word, from the file that is written for it. The table does not depend on how many are folded at a time. */
    ends(0, run("batch", "good.opx", "-o", "judged", "--frames", "4", "-q", "--verify", "--jobs", "1"));
    assert_false(is_empty("judged/good.fold"));
    slurp("judged/table.csv", table);
    assert_non_null(strstr(table, ",free,,0,0,0,0,valid,"));
    /* As many columns in each row, whatever became of the file. */
    ends(1, run("batch", "good.opx", "missing.opx", "-o", "judged", "--frames", "4", "-q", "--verify", "--jobs", "2"));
    slurp("judged/table.csv", table);
    int commas[3] = {0};
    for (int line = 0, i = 0; table[i] && line < 3; i++) commas[line] += table[i] == ',', line += table[i] == '\n';
    assert_true(commas[0] > 20 && commas[1] == commas[0] && commas[2] == commas[0]);
    /* What takes longer than it may is told as that. */
    ends(0, run("gen", "waterbomb", "64", "-o", "slow.opx"));
    ends(1, run("batch", "slow.opx", "-o", "late", "-q", "--limit", "1"));
    slurp("late/table.csv", table);
    assert_non_null(strstr(table, "timeout"));
    assert_non_null(strstr(table, "not done within 1 second"));
    says(ends(2, run("batch", "good.opx", "-o", "parts", "--part", "3/2")), "rigami: --part: ", "3/2");
    says(ends(2, run("batch", "good.opx", "-o", "parts", "--write", "xyz")), "rigami: ", "xyz");
    says(ends(2, run("batch", "good.opx", "-o", "parts", "--write", "gif", "--write", "gif")), "rigami: --write: ", "twice");
    says(ends(2, run("batch", "good.opx", "-o", "parts", "--write", "/../../x.gif")), "rigami: --write: ", "no ending");
    says(ends(2, run("batch", "good.opx")), "rigami: ", "-o DIR/");
}

static int rows_of(const char *path)
{
    static char table[ROOM];
    return lines_in(slurp(path, table)) - 1;
}

/* No two files of a batch share what is written of them, whatever they are called, nor with the batch's own. */
static void names_of_a_batch(void **state)
{
    (void)state;
    static char text[ROOM];
    char longer[2][230];
    ends(0, run("gen", "miura", "2", "-o", "a.opx"));
    ends(0, run("gen", "miura", "3", "2", "-o", "a.cp"));
    ends(0, run("gen", "miura", "2", "3", "-o", "a.opx.svg"));
    ends(0, run("batch", "a.opx", "a.cp", "a.opx.svg", "-o", "alike", "--frames", "2", "-q"));
    assert_int_equal(rows_of("alike/table.csv"), 3);
    mkdir("x", 0777), mkdir("x/y", 0777), mkdir("x-y", 0777);
    ends(0, run("gen", "miura", "2", "-o", "x/y/a.opx"));
    ends(0, run("gen", "miura", "3", "2", "-o", "x-y/a.opx"));
    ends(0, run("batch", "x/y/a.opx", "x-y/a.opx", "-o", "dashes", "--frames", "2", "-q"));
    assert_int_equal(rows_of("dashes/table.csv"), 2);
    for (int i = 0; i < 2; i++) {
        memset(longer[i], 'n', 210);
        snprintf(longer[i] + 210, 20, "-%d.opx", i);
        ends(0, run("gen", "miura", i ? "3" : "2", "-o", longer[i]));
    }
    ends(0, run("batch", longer[0], longer[1], longer[0], "-o", "longer", "--frames", "2", "-q"));
    assert_int_equal(rows_of("longer/table.csv"), 2);
    /* Sheets have numbers, which another file may have in its name. */
    write_file("s.cp", "1 0 0 9 0\n1 9 0 9 9\n1 9 9 0 9\n1 0 9 0 0\n2 0 0 9 9\n1 20 0 29 0\n1 29 0 29 9\n1 29 9 20 9\n1 20 9 20 0\n3 20 0 29 9\n");
    ends(0, run("gen", "miura", "2", "-o", "s-1.opx"));
    ends(0, run("batch", "s.cp", "s-1.opx", "-o", "sheets", "--frames", "2", "-q"));
    assert_int_equal(rows_of("sheets/table.csv"), 3);
    /* What is the batch's own, what counts frames, what is no line. */
    ends(0, run("gen", "miura", "2", "-o", "table.opx"));
    ends(0, run("gen", "miura", "2", "-o", "50%04d\n.opx"));
    ends(0, run("batch", "table.opx", "50%04d\n.opx", "-o", "odd", "--frames", "2", "-q", "--write", "csv"));
    assert_int_equal(rows_of("odd/table.csv"), 2);
    assert_int_equal(rows_of("odd/table.opx.csv"), 2);
    assert_int_equal(lines_in(slurp("odd/table.txt", text)), 3);
    says(ends(2, run("batch", "-", "-o", "stdin", "--frames", "2")), "rigami: batch: ", "standard input");
    assert_int_equal(names("stdin"), 0);
    /* A row is as long as it has to be. */
    char deep[3000] = "";
    for (int k = 0; k < 12; k++) {
        memset(deep + strlen(deep), 'd', 200);
        mkdir(deep, 0777);
        strcat(deep, "/");
    }
    strcat(deep, "q.opx");
    ends(0, run("gen", "miura", "2", "-o", deep));
    ends(0, run("batch", deep, "a.opx", "-o", "deep", "--frames", "2", "-q"));
    assert_int_equal(rows_of("deep/table.csv"), 2);
    assert_non_null(strstr(slurp("deep/table.csv", text), "/q.opx,0,0,folded,"));
}

/* A file that cannot be written does not end the batch, is told, and is made again; no table is lost. */
static void a_batch_goes_on(void **state)
{
    (void)state;
    static char text[ROOM], before[ROOM];
    mkdir("fails", 0777), mkdir("fails/short.json", 0777), mkdir("fails/stuck.log", 0777);
    const char *const args[] = {"batch", "short.opx", "stuck.opx", "good.opx", "-o", "fails", "--frames", "2", "--jobs", "1",
                                "--to", "1", NULL};
    const ran *r = ends(3, run_with(&(streams){0}, args));
    says(r, "rigami: batch: ", "2 of 3 files could not be written");
    slurp("fails/table.csv", text);
    assert_non_null(strstr(text, ",short.opx,0,3,failed,"));
    assert_non_null(strstr(text, ",stuck.opx,0,3,failed,"));
    assert_non_null(strstr(text, "stuck.log: "));
    assert_non_null(strstr(text, ",good.opx,0,0,folded,"));
    rmdir("fails/short.json"), rmdir("fails/stuck.log");
    r = run_with(&(streams){0}, args);
    assert_true(r->status < 3);
    assert_non_null(strstr(r->out, "good.opx: folded, 1.0 %, ")); /* is kept */
    assert_null(strstr(slurp("fails/table.csv", text), "failed"));
    /* So is what somebody took away. */
    assert_non_null(strstr(run_with(&(streams){0}, args)->out, "good.opx: folded, 1.0 %, "));
    assert_int_equal(unlink("fails/good.json"), 0);
    run_with(&(streams){0}, args);
    assert_false(is_empty("fails/good.json"));
    /* Options are told apart however many there are; one limit is not another one. */
    const char *many[MOST_ARGS] = {"batch", "good.opx", "-o", "many", "--frames", "2"};
    static char line[12][120];
    int n = 6;
    for (int i = 0; i < 12; i++) {
        snprintf(line[i], sizeof line[i], "%0100d=none", i);
        many[n++] = "--line", many[n++] = line[i];
    }
    many[n++] = "--to", many[n] = "50";
    ends(0, run_with(&(streams){0}, many));
    many[n] = "70";
    assert_non_null(strstr(ends(0, run_with(&(streams){0}, many))->out, "folded, 70.0 %"));
    ends(0, run("gen", "waterbomb", "64", "-o", "slow.opx"));
    ends(0, run("gen", "miura", "2", "-o", "late.opx"));
    write_file("limits.gif.1-0.part", "what a killed one left");
    ends(1, run("batch", "slow.opx", "-o", "limits", "-q", "--limit", "1.25"));
    assert_non_null(strstr(slurp("limits/table.csv", text), "not done within 1.25 seconds"));
    write_file("limits/slow.gif.1-0.part", "of one that was killed");
    const ran *late = ends(1, run("batch", "slow.opx", "-o", "limits", "--limit", "1", "--write", "gif"));
    assert_null(strstr(late->out, "kept"));
    assert_false(there("limits/slow.gif.1-0.part"));
    assert_non_null(strstr(slurp("limits/table.csv", text), "not done within 1 seconds"));
    assert_non_null(strstr(ends(1, run("batch", "slow.opx", "-o", "limits", "--limit", "1", "--write", "gif"))->out, "kept"));
    unlink("limits.gif.1-0.part");
    /* The table stays where a new one has no room. */
    struct rlimit was, small;
    slurp("fails/table.csv", before);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &was), 0);
    small = was;
    small.rlim_cur = 200;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    r = run("batch", "short.opx", "stuck.opx", "good.opx", "-o", "fails", "--frames", "2", "--to", "1", "--merge", "-q");
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &was), 0);
    ends(3, r);
    assert_non_null(strstr(r->err, strerror(EFBIG)));
    assert_string_equal(slurp("fails/table.csv", text), before);
}

static void what_was_meant(void **state)
{
    (void)state;
    says(ends(2, run("fodl", "good.opx")), "rigami: ", "did you mean rigami fold?");
    says(ends(2, run("fold", "good.opx", "--framse", "3")), "rigami: ", "did you mean --frames?");
    says(ends(2, run("help", "ifno")), "rigami: ", "did you mean rigami info?");
    static char help[ROOM];
    strcpy(help, ends(0, run("fold", "--help"))->out);
    assert_string_equal(ends(0, run("help", "fold"))->out, help);
    assert_non_null(strstr(ends(0, run("help"))->out, "rigami fold"));
    assert_non_null(strstr(ends(0, run("help", "--words", "fold"))->out, "--frames\n"));
    assert_string_equal(ends(0, run("help", "--words", "fold", "--solver"))->out, "auto\ncg\ncholesky\nsvd\n");
}

static void wrong_usage_is_refused(void **state)
{
    (void)state;
    says(ends(2, run("frob")), "rigami: ", "frob");
    says(ends(2, run("fold")), "rigami: ", "fold");
    says(ends(2, run("info")), "rigami: ", "info");
    says(ends(2, run("info", "good.opx", "short.opx")), "rigami: ", "short.opx");
    says(ends(2, run("fold", "good.opx", "--frobnicate")), "rigami: ", "--frobnicate");
    says(ends(2, run("fold", "good.opx", "-z")), "rigami: ", "-z");
    says(ends(2, run("fold", "good.opx", "--t", "50")), "rigami: ", "several");
    says(ends(2, run("fold", "good.opx", "--frames")), "rigami: ", "--frames");
    says(ends(2, run("fold", "good.opx", "--quiet=1")), "rigami: ", "--quiet");
    says(ends(2, run("fold", "good.opx", "-o")), "rigami: ", "-");
    says(ends(2, run("info", "-", "-")), "rigami: ", "");
    says(ends(2, run("gen", "miura")), "rigami: ", "-o");
    says(ends(2, run("gen", "nosuchkind", "-o", "gen.opx")), "rigami: ", "nosuchkind");
    says(ends(2, run("gen", "miura", "three", "-o", "gen.opx")), "rigami: ", "three");
    says(ends(2, run("gen", "miura", "0", "-o", "gen.opx")), "rigami: ", "0");
    assert_int_equal(names("gen."), 0);
    const char *none[] = {NULL};
    const ran *r = ends(2, run_with(&(streams){0}, none));
    assert_non_null(strstr(r->err, "Usage"));
    assert_string_equal(r->out, "");
}

static void unreadable_input_is_refused(void **state)
{
    (void)state;
    FILE *f = fopen("noise.opx", "wb");
    assert_non_null(f);
    fputs("Lorem ipsum\ndolor sit\n", f);
    fclose(f);
    f = fopen("cut.opx", "wb");
    assert_non_null(f);
    fputs("<?xml version=\"1.0\"?>\n<java>\n<object class=\"oripa.DataSet\">\n", f);
    fclose(f);
    f = fopen("empty.opx", "wb");
    assert_non_null(f);
    fclose(f);
    const char *const verbs[] = {"info", "fold"};
    for (int i = 0; i < 2; i++) {
        says(ends(2, run(verbs[i], "missing.opx")), "rigami: missing.opx: ", strerror(ENOENT));
        says(ends(2, run(verbs[i], ".")), "rigami: .: ", "");
        says(ends(2, run(verbs[i], "empty.opx")), "rigami: empty.opx: ", "empty");
        says(ends(2, run(verbs[i], "noise.opx")), "rigami: noise.opx:", "");
        says(ends(2, run(verbs[i], "cut.opx")), "rigami: cut.opx:", "");
        says(ends(2, run(verbs[i], "-")), "rigami: -: ", "empty");
    }
    says(ends(2, run("fold", "cut.opx", "-o", "cut.csv")), "rigami: cut.opx:", "");
    assert_false(there("cut.csv"));
}

static void a_bad_line_is_named(void **state)
{
    (void)state;
    const drawn line[] = {{1, 0, 0, 100, 0}, {7, 0, 0, 100, 80}};
    char begin[80];
    snprintf(begin, sizeof begin, "rigami: seven.opx:%d: ", draw("seven.opx", line, 2) + 1);
    says(ends(2, run("info", "seven.opx")), begin, "7");
}

static void what_is_no_sheet_is_described_but_not_folded(void **state)
{
    (void)state;
    ends(0, run("info", "torn.opx", "-q"));
    const ran *r = ends(2, run("fold", "torn.opx", "-q", "-o", "torn.csv"));
    says(r, "rigami: torn.opx: ", "");
    assert_false(there("torn.csv"));
}

static void lines_without_numbers_are_warned_of(void **state)
{
    (void)state;
    const drawn line[] = {{1, 0, 0, 100, 0},   {1, 100, 0, 100, 80}, {1, 100, 80, 0, 80},
                          {2, NAN, 3.5, 4, 5}, {1, 0, 80, 0, 0},     {2, 0, 0, 100, 80}};
    char begin[80];
    snprintf(begin, sizeof begin, "rigami: nan.opx:%d: warning: ", draw("nan.opx", line, 6) + 3);
    says(ends(0, run("fold", "nan.opx")), begin, "finite");
    says(ends(0, run("info", "nan.opx")), begin, "finite");
    assert_string_equal(ends(0, run("fold", "nan.opx", "-q"))->err, "");
    assert_string_equal(ends(0, run("info", "nan.opx", "-q"))->err, "");
}

static void messages_stay_on_one_line(void **state)
{
    (void)state;
    const ran *r = ends(2, run("info", "two\nlines\033[1m.opx"));
    says(r, "rigami: two?lines?[1m.opx: ", "");
    /* On standard output, and while it is at it, too. */
    ends(0, run("convert", "good.opx", "-o", "two\nlines\033[1m.opx"));
    r = ends(0, run("fold", "two\nlines\033[1m.opx", "--frames", "2", "-o", "two\nlines\033[1m.csv", "--progress"));
    assert_non_null(strstr(r->out, "two?lines?[1m.opx: folded, "));
    assert_non_null(strstr(r->out, "\n  written   two?lines?[1m.csv\n"));
    assert_non_null(strstr(r->err, "writing two?lines?[1m.csv"));
    r = ends(0, run("batch", "two\nlines\033[1m.opx", "-o", "two_lines", "--frames", "2"));
    assert_non_null(strstr(r->out, "] two?lines?[1m.opx: folded, "));
    unlink("two\nlines\033[1m.opx");
    unlink("two\nlines\033[1m.csv");
}

/* --------------------------------------------------------------------------------------------- outputs ---- */

/* What a file calls itself is told on one line, and no terminal is told to do anything. */
static void titles_stay_on_one_line(void **state)
{
    (void)state;
    write_file("titled.fold", "{\"file_title\":\"a\\nIt is likely to fold\\u001b[2J\",\"file_author\":\"b\\r\","
               "\"vertices_coords\":[[0,0],[3,0],[3,2],[0,2]],\"edges_vertices\":[[0,1],[1,2],[2,3],[3,0],[0,2]],"
               "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"V\"]}");
    const ran *r = ends(0, run("info", "titled.fold"));
    assert_non_null(strstr(r->out, "\na It is likely to fold [2J, by b \n"));
}

/* An order of layers that there is not is no reason to fold through oneself. */
static void an_order_of_layers_has_to_be_there(void **state)
{
    (void)state;
    ends(0, run("gen", "miura", "2", "-o", "ordered.opx"));
    ends(0, run("fold", "ordered.opx", "-q", "--layers", "0", "--frames", "2"));
    says(ends(2, run("fold", "ordered.opx", "--layers", "1", "-o", "ordered.csv")), "rigami: ordered.opx: ", "no layer order 1: it has 1 ");
    says(ends(2, run("fold", "ordered.opx", "--layers", "2147483647")), "rigami: ordered.opx: ", "no layer order 2147483647");
    assert_int_equal(names("ordered.csv"), 0);
}

static void outputs_that_cannot_be_are_refused_before_folding(void **state)
{
    (void)state;
    const ran *r = ends(2, run("fold", "good.opx", "-o", "x.csv", "-o", "x.frob"));
    says(r, "rigami: ", "x.frob");
    says(ends(2, run("fold", "good.opx", "-o", "x.csv", "-o", "noextension")), "rigami: ", "noextension");
    says(ends(2, run("fold", "good.opx", "-o", "x.csv", "-o", "x.csv")), "rigami: x.csv: ", "twice");
    says(ends(2, run("fold", "good.opx", "-o", "x.csv", "--report", "x.csv")), "rigami: x.csv: ", "twice");
    says(ends(2, run("fold", "good.opx", "--report", "./good.opx")), "rigami: ./good.opx: ", "input");
    says(ends(3, run("fold", "good.opx", "-o", "x.csv", "-o", "nowhere/x.csv")), "rigami: nowhere/x.csv: ", strerror(ENOENT));
    says(ends(3, run("fold", "good.opx", "-o", "x.csv", "--report", "nowhere/x")), "rigami: nowhere/x: ", strerror(ENOENT));
    says(ends(3, run("fold", "good.opx", "-o", "x.csv", "--report", ".")), "rigami: .: ", strerror(EISDIR));
    char longer[310];
    memset(longer, 'x', 300);
    strcpy(longer + 300, ".csv");
    says(ends(3, run("fold", "good.opx", "-o", "x.csv", "-o", longer)), "rigami: xxx", strerror(ENAMETOOLONG));
    says(ends(3, run("gen", "miura", "-o", "nowhere/x.opx")), "rigami: nowhere/x.opx", strerror(ENOENT));
    assert_int_equal(names("x."), 0);
    assert_int_equal(names("noext"), 0);
    ends(0, run("info", "good.opx")); /* it is as it was */
}

static void writing_that_fails_keeps_what_was_there(void **state)
{
    (void)state;
    static char before[ROOM], after[ROOM];
    struct rlimit was, small;
    ends(0, run("fold", "good.opx", "-q", "--frames", "40", "-o", "kept.fold"));
    slurp("kept.fold", before);
    assert_true(strlen(before) > 4096);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &was), 0);
    small = was;
    small.rlim_cur = 2048; /* no file may be longer, which is like a disk that is full */
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const ran *r = run("fold", "good.opx", "-q", "--frames", "50", "-o", "kept.fold", "-o", "kept.svg");
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &was), 0);
    ends(3, r);
    assert_non_null(strstr(r->err, strerror(EFBIG)));
    assert_non_null(strstr(r->err, "kept.fold"));
    /* What is said to be written is. */
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    r = run("fold", "good.opx", "--frames", "50", "-o", "kept.fold", "-o", "kept.obj");
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &was), 0);
    ends(3, r);
    assert_non_null(strstr(r->out, "kept.obj\n"));
    assert_null(strstr(r->out, "kept.fold"));
    unlink("kept.obj");
    assert_string_equal(slurp("kept.fold", after), before);
    for (int k = 0; k < 2; k++) unlink(k ? "kept.fold" : "kept.svg");
    assert_int_equal(names("kept."), 0); /* no temporary file either */
}

static void standard_output_that_fails_is_told(void **state)
{
    (void)state;
    const char *const *const args[] = {ARGS("fold", "good.opx"), ARGS("fold", "good.opx", "--report", "-"),
                                       ARGS("info", "good.opx"), ARGS("info", "good.opx", "--json"), ARGS("--help"),
                                       ARGS("fold", "--help"),   ARGS("--version"), ARGS("gen", "miura", "-o", "-")};
    int ends_of_pipe[2];
    assert_int_equal(pipe(ends_of_pipe), 0);
    close(ends_of_pipe[0]);
    for (size_t i = 0; i < sizeof args / sizeof *args; i++) {
        const ran *r = ends(3, run_with(&(streams){.closed = 1}, args[i]));
        says(r, "rigami: ", strerror(EBADF));
        says(ends(3, run_with(&(streams){.out_fd = ends_of_pipe[1]}, args[i])), "rigami: ", strerror(EPIPE));
        if (there("/dev/full"))
            says(ends(3, run_with(&(streams){.out = "/dev/full"}, args[i])), "rigami: ", strerror(ENOSPC));
    }
    close(ends_of_pipe[1]);
    /* Nothing to say: nothing to fail. A file does not take the place of the closed descriptor. */
    ends(0, run_with(&(streams){.closed = 1}, ARGS("fold", "good.opx", "-q", "-o", "closed.csv")));
    assert_false(is_empty("closed.csv"));
}

static void the_same_input_gives_the_same_bytes(void **state)
{
    (void)state;
    static char one[ROOM], two[ROOM];
    const char *const endings[] = {"fold", "csv", "svg", "obj"};
    for (int k = 0; k < 2; k++) {
        char name[4][20];
        for (int i = 0; i < 4; i++) snprintf(name[i], sizeof name[i], "same%d.%s", k, endings[i]);
        ends(0, run("fold", "good.opx", "-q", "-o", name[0], "-o", name[1], "-o", name[2], "-o", name[3]));
    }
    for (int i = 0; i < 4; i++) {
        char a[20], b[20];
        snprintf(a, sizeof a, "same0.%s", endings[i]);
        snprintf(b, sizeof b, "same1.%s", endings[i]);
        assert_true(strlen(slurp(a, one)) > 100);
        assert_string_equal(one, slurp(b, two));
    }
}

static void fold_angles_reach_their_end(void **state)
{
    (void)state;
    static char text[ROOM];
    ends(0, run("fold", "good.opx", "-q", "--frames", "7", "-o", "angles.csv"));
    slurp("angles.csv", text);
    int rows = 0, full = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        if (!strchr("0123456789-+.", *line)) continue; /* what the columns are */
        rows++;
        full = 0;
        for (const char *c = line; c; c = strchr(c, ',') ? strchr(c, ',') + 1 : NULL) full += fabs(fabs(atof(c)) - 180) < 1.8;
    }
    assert_int_equal(rows, 7);
    assert_int_equal(full, 4);
}

/* ----------------------------------------------------------------------------------- input, options ---- */

static void standard_input_is_read(void **state)
{
    (void)state;
    ends(0, run_with(&(streams){.in = "good.opx"}, ARGS("fold", "-", "-q", "-o", "piped.csv")));
    ends(0, run("fold", "good.opx", "-q", "-o", "named.csv"));
    static char one[ROOM], two[ROOM];
    assert_true(strlen(slurp("piped.csv", one)) > 100);
    assert_string_equal(one, slurp("named.csv", two));
    ends(0, run_with(&(streams){.in = "good.opx"}, ARGS("info", "-", "--from", "opx")));
}

static void names_are_bytes(void **state)
{
    (void)state;
    static char text[ROOM];
    const char *const files[] = {"-dash.opx", "a b%s\xff.opx"};
    slurp("good.opx", text);
    for (int i = 0; i < 2; i++) {
        FILE *f = fopen(files[i], "wb");
        assert_non_null(f);
        fputs(text, f);
        fclose(f);
        ends(0, run("fold", "-q", "-o", "bytes \xff.csv", "--", files[i]));
        assert_false(is_empty("bytes \xff.csv"));
        unlink("bytes \xff.csv");
    }
}

static void options_are_taken(void **state)
{
    (void)state;
    static const char *const good[][2] = {
        {"--frames", "2"}, {"--frames", "17"}, {"--to", "-100"}, {"--to", "62.5"}, {"--to", "0"}, {"--to", "+1e1"},
        {"--targets", NULL}, {"--no-targets", NULL}, {"--method", "auto"}, {"--method", "euler"}, {"--method", "newton"},
        {"--method", "heun"}, {"--method", "rk4"}, {"--method", "adaptive"}, {"--step", "2.5"}, {"--step", "180"},
        {"--tol", "1e-9"}, {"--solver", "auto"}, {"--solver", "cg"}, {"--solver", "cholesky"},
#if RG_GPL
        {"--solver", "svd"},
#endif
        {"--triangulate", "auto"}, {"--triangulate", "none"}, {"--triangulate", "all"}, {"--adjust", "auto"},
        {"--adjust", "off"}, {"--adjust", "0.125"}, {"--adjust", "0"}, {"--effort", "fast"}, {"--effort", "normal"},
        {"--effort", "thorough"}, {"--size", "640x480"}, {"--camera", "-45,30"}, {"--camera", "12.5,-10,1.5"},
        {"--fps", "25"}, {"--fps", "29.97"}, {"--merge", "1e-4"}, {"--merge", "0"}, {"--fixed", "0"}, {"--aux", NULL},
        {"--from", "opx"}, {"--from", "auto"}, {"--frame", "0"}, {"--flip", NULL}, {"--no-progress", NULL},
        {"--quiet", NULL}, {"--report", "options.json"}, {"--output", "options.csv"}, {"-ooptions.csv", NULL}};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        const ran *r = run("fold", "good.opx", "-q", "--frames=5", good[i][0], good[i][1]);
        if (r->status == 0 && r->err[0] == 0) continue;
        /* Other methods may end a little short of the end of this one; how far they get is not what is tested here. */
        if (r->status == 1 && strcmp(good[i][0], "--method") == 0) continue;
        print_error("fold %s %s ended with %d: %s\n", good[i][0], good[i][1] ? good[i][1] : "", r->status, r->err);
        fail();
    }
    const ran *r = ends(0, run("fold", "good.opx", "--progress"));
    assert_non_null(strstr(r->err, "%")); /* though it is no terminal */
    assert_string_equal(ends(0, run("fold", "good.opx"))->err, "");
}

static void bad_values_are_refused(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"--frames", "1"}, {"--frames", "x"}, {"--frames", "3.5"}, {"--frames", "1e1"}, {"--frames", ""},
        {"--frames", "99999999999"}, {"--frames", "-5"}, {"--frames", " 5"}, {"--to", "101"}, {"--to", "-100.5"},
        {"--to", "nan"}, {"--to", "inf"}, {"--to", "0x10"}, {"--to", "50%"}, {"--to", "1,5"}, {"--to", "1e999"},
        {"--method", "verlet"}, {"--method", ""}, {"--method", "Euler"}, {"--step", "0"}, {"--step", "-1"},
        {"--step", "181"}, {"--tol", "0"}, {"--tol", "1"}, {"--tol", "-1e-9"}, {"--solver", "lu"},
        {"--triangulate", "some"}, {"--adjust", "-0.5"}, {"--adjust", "on"}, {"--adjust", "nan"}, {"--effort", "lazy"},
        {"--size", "0x10"}, {"--size", "10"}, {"--size", "10x"}, {"--size", "10x20x"}, {"--size", "20000x10"},
        {"--size", "-1x5"}, {"--size", "x"}, {"--size", "99999999999x5"}, {"--camera", "1"}, {"--camera", "1,2,0"},
        {"--camera", "1,95"}, {"--camera", "a,b"}, {"--camera", "1,2,3,4"}, {"--camera", "1,2,"}, {"--camera", ""},
        {"--fps", "0"}, {"--fps", "-30"}, {"--fps", "fast"}, {"--merge", "-1"}, {"--merge", "0.5"}, {"--fixed", "-1"},
        {"--fixed", "one"}, {"--from", "pdf"}, {"--frame", "-1"}, {"--frame", "key"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char begin[80];
        snprintf(begin, sizeof begin, "rigami: %s: ", bad[i][0]);
        says(ends(2, run("fold", "good.opx", "-o", "bad.csv", bad[i][0], bad[i][1])), begin, bad[i][1]);
    }
    says(ends(2, run("fold", "good.opx", "-o", "bad.csv", "--fixed", "99")), "rigami: ", "99");
    says(ends(2, run("gen", "miura", "--angle", "200", "-o", "bad.opx")), "rigami: --angle: ", "200");
    assert_int_equal(names("bad."), 0);
}

static void help_names_every_option(void **state)
{
    (void)state;
    static const char *const reading[] = {"--from", "--frame", "--flip", "--merge", "--aux", "--quiet", "--help"};
    static const char *const folding[] = {
        "-o", "--frames", "--to", "--targets", "--no-targets", "--method", "euler", "newton", "heun", "rk4", "adaptive",
        "--step", "--tol", "--solver", "cg", "cholesky", "svd", "--triangulate", "none", "all", "--adjust", "--effort",
        "fast", "thorough", "--size", "--camera", "--fps", "--report", "-q", "--progress", "--no-progress", "--fixed",
        ".png", ".gif", ".apng", ".mp4", ".webm", ".obj", ".stl", ".glb", ".gltf", ".fold", ".csv", ".svg", ".html"};
    const ran *r = ends(0, run("fold", "--help"));
    assert_string_equal(r->err, "");
    for (size_t i = 0; i < sizeof folding / sizeof *folding; i++) assert_non_null(strstr(r->out, folding[i]));
    for (size_t i = 0; i < sizeof reading / sizeof *reading; i++) assert_non_null(strstr(r->out, reading[i]));
    r = ends(0, run("info", "--help"));
    for (size_t i = 0; i < sizeof reading / sizeof *reading; i++) assert_non_null(strstr(r->out, reading[i]));
    assert_non_null(strstr(r->out, "--json"));
    r = ends(0, run("gen", "-h"));
    assert_non_null(strstr(r->out, "-o"));
    assert_non_null(strstr(r->out, "--angle"));
    assert_non_null(strstr(r->out, "miura"));
    r = ends(0, run("convert", "--help"));
    for (size_t i = 0; i < sizeof reading / sizeof *reading; i++) assert_non_null(strstr(r->out, reading[i]));
    assert_non_null(strstr(r->out, "-o"));
    static const char *const verbs[] = {"fold", "info", "convert", "gen"};
    r = ends(0, run("--help"));
    for (int i = 0; i < 4; i++) assert_non_null(strstr(r->out, verbs[i]));
    assert_string_equal(ends(0, run("--version"))->out, "rigami " RG_VERSION "\n");
}

static void examples_are_made(void **state)
{
    (void)state;
    static char list[ROOM];
    strcpy(list, ends(0, run("gen", "--help"))->out);
    char *kind = strstr(list, "KIND is one of:");
    assert_non_null(kind);
    int kinds = 0;
    for (kind = strtok(kind + 15, " \n"); kind; kind = strtok(NULL, " \n"), kinds++) {
        ends(0, run("gen", kind, "-o", "kind.opx"));
        const ran *r = ends(0, run("info", "kind.opx"));
        assert_string_equal(r->err, "");
        ends(0, run("gen", kind, "-o", "-"));
        static char one[ROOM], two[ROOM];
        assert_string_equal(slurp("stdout", one), slurp("kind.opx", two));
    }
    assert_true(kinds >= 8);
    json_t *few, *many;
    ends(0, run("gen", "miura", "3", "5", "--angle", "70", "-o", "kind.opx"));
    assert_non_null(few = json_loads(ends(0, run("info", "--json", "kind.opx"))->out, 0, NULL));
    ends(0, run("gen", "miura", "6", "5", "--angle", "70", "-o", "kind.opx"));
    assert_non_null(many = json_loads(ends(0, run("info", "--json", "kind.opx"))->out, 0, NULL));
    assert_true(json_integer_value(json_object_get(many, "creases")) > json_integer_value(json_object_get(few, "creases")));
    json_decref(few);
    json_decref(many);
    /* In a size and a unit, in any format: the sheet's longer side, or that of a part. A Miura-ori's rhombs have the side asked for, a
     * waterbomb's units the width. */
    const struct { const char *kind, *option, *length, *file; double size, metres; } sized[] = {
        {"bird", "--size", "150mm", "sized.fold", 150, 1e-3}, {"hypar", "--size", "8.5in", "sized.svg", 8.5, 0.0254},
        {"crane", "--size", "0.25m", "sized.dxf", 0.25, 1}, {"miura", "--size", "37.5", "sized.cp", 37.5, 0},
        {"waterbomb", "--cell", "2.5cm", "sized.fold", 15, 0.01}, {"hypar", "--cell", "3", "sized.opx", 48, 0}};
    for (size_t i = 0; i < sizeof sized / sizeof *sized; i++) {
        ends(0, run("gen", sized[i].kind, sized[i].option, sized[i].length, "-o", sized[i].file));
        json_t *info = json_loads(ends(0, run("info", "--json", sized[i].file, "-q"))->out, 0, NULL);
        near(json_number_value(json_object_get(info, "size")), sized[i].size, 1e-6 * sized[i].size);
        near(json_number_value(json_object_get(info, "unit_metres")), sized[i].metres, 1e-9);
        json_decref(info);
        unlink(sized[i].file);
    }
    says(ends(0, run("gen", "miura", "--size", "3in", "-o", "sized.opx")), "rigami: sized.opx: warning: ", "unit");
    says(ends(2, run("gen", "bird", "--cell", "3", "-o", "sized.opx")), "rigami: gen: ", "parts");
    says(ends(2, run("gen", "miura", "--cell", "3", "--size", "4", "-o", "sized.opx")), "rigami: gen: ", "one of the two");
    says(ends(2, run("gen", "miura", "--size", "3furlong", "-o", "sized.opx")), "rigami: --size: ", "3furlong");
    says(ends(2, run("gen", "miura", "--size", "0", "-o", "sized.opx")), "rigami: --size: ", "0");
    says(ends(2, run("gen", "miura", "--size", "1e-320", "-o", "sized2.opx")), "rigami: gen: ", "1e-9");
    assert_int_equal(names("sized2"), 0); /* no drawing that this program itself cannot read */
    unlink("sized.opx");
}

static void patterns_are_converted(void **state)
{
    (void)state;
    static char one[ROOM], two[ROOM];
    const char *const chain[] = {"good.opx", "chain.cp", "chain.fold", "chain.svg", "chain.opx"};
    for (int i = 0; i < 4; i++) {
        ends(0, run("convert", chain[i], "-o", chain[i + 1], "-q"));
        json_t *info = json_loads(ends(0, run("info", "--json", chain[i + 1]))->out, 0, NULL);
        assert_non_null(info);
        assert_int_equal(json_integer_value(json_object_get(info, "creases")), 4);
        assert_int_equal(json_integer_value(json_object_get(info, "mountains")), 3);
        assert_int_equal(json_integer_value(json_object_get(info, "facets")), 4);
        json_decref(info);
        ends(0, run("fold", chain[i + 1], "-q"));
    }
    strcpy(one, ends(0, run_with(&(streams){.in = "chain.fold"}, ARGS("convert", "-", "-o", "-", "--as", "cp", "-q")))->out);
    ends(0, run("convert", "chain.fold", "-o", "straight.cp", "-q"));
    assert_string_equal(one, slurp("straight.cp", two));
    assert_int_equal(lines_in(one), 8 + 4); /* four sides, cut by four creases */
    says(ends(2, run("convert", "good.opx")), "rigami: ", "-o");
    ends(0, run("convert", "good.opx", "-o", "chain.dxf", "-q"));
    json_t *cut = json_loads(ends(0, run("info", "--json", "chain.dxf"))->out, 0, NULL);
    assert_int_equal(json_integer_value(json_object_get(cut, "mountains")), 3);
    assert_int_equal(json_integer_value(json_object_get(cut, "valleys")), 1);
    json_decref(cut);
    says(ends(2, run("convert", "good.opx", "-o", "lost.ori")), "rigami: ", "ori");
    says(ends(2, run("convert", "good.opx", "-o", "lost.pdf")), "rigami: ", "");
    says(ends(2, run("convert", "good.opx", "-o", "lost.cp", "--as", "pdf")), "rigami: --as: ", "pdf");
    says(ends(2, run("convert", "missing.opx", "-o", "lost.cp")), "rigami: missing.opx: ", strerror(ENOENT));
    says(ends(3, run("convert", "good.opx", "-o", "nowhere/lost.cp")), "rigami: nowhere/lost.cp", strerror(ENOENT));
    says(ends(2, run("gen", "miura", "-o", "lost.pdf")), "rigami: gen: lost.pdf: ", ".fold");
    assert_int_equal(names("lost."), 0);
}

/* ---------------------------------------------------------------------------------------------- reports ---- */

static const struct { const char *part; const char *keys[24]; } promised[] = {
    {"pattern", {"vertices", "edges", "creases", "facets", "interior_vertices", "boundary_edges", "degrees_of_freedom",
                 "closed_vertices", "kawasaki_max_deg", "maekawa_violations"}},
    {"model", {"added_creases", "unknowns", "constraints", "components"}},
    {"run", {"method", "solver", "steps", "solves", "cg_iterations", "factorizations", "assemblies", "seconds_total",
             "seconds_solving", "seconds_writing", "peak_bytes"}},
    {"result", {"outcome", "reason", "folded_percent", "least_folded_percent", "max_closure_residual", "max_edge_strain",
                "max_facet_gap", "max_overfold_deg", "max_adjustment", "max_strain_from_original", "blocking_vertices",
                "blocking_creases", "contact", "first_contact_frame", "first_contact_percent", "contact_pairs", "contact_depth", "layers", "layer_orders"}}};

static double value(const json_t *report, const char *part, const char *key)
{
    return json_number_value(json_object_get(json_object_get(report, part), key));
}

/* The waterbomb tessellation reaches its end through itself: it is folded, and said not to be what paper can do. */
static void passing_through_itself_is_told(void **state)
{
    (void)state;
    ends(0, run("gen", "waterbomb", "6", "-o", "through.opx"));
    const ran *r = ends(1, run("fold", "through.opx", "--contact", "report", "--report", "through.json", "-o", "through.csv"));
    says(r, "rigami: through.opx: reaches its end only by passing through itself, from 32 %: facets ", "at (");
    json_t *report = json_load_file("through.json", 0, NULL);
    const json_t *result = json_object_get(report, "result");
    assert_string_equal(json_string_value(json_object_get(result, "outcome")), "folded");
    assert_string_equal(json_string_value(json_object_get(result, "contact")), "crosses");
    near(value(report, "result", "first_contact_percent"), 32, 1);
    near(value(report, "result", "contact_depth"), 0.04, 0.002);
    assert_true(value(report, "result", "contact_pairs") > 10);
    json_decref(report);
    ends(0, run("fold", "through.opx", "--contact", "ignore", "--report", "through.json"));
    report = json_load_file("through.json", 0, NULL);
    assert_string_equal(json_string_value(json_object_get(json_object_get(report, "result"), "contact")), "unchecked");
    assert_true(json_is_null(json_object_get(json_object_get(report, "result"), "first_contact_frame")));
    json_decref(report);
    says(ends(2, run("fold", "through.opx", "--contact", "perhaps")), "rigami: --contact: ", "avoid, report or ignore");
}

/* Frames are even in the angle of the crease that is driven, by its number or a point on it, and all others follow; as does what a FOLD
 * file leaves open. Pinned, it stays flat. */
static void creases_are_driven_pinned_and_freed(void **state)
{
    (void)state;
    static char text[ROOM];
    ends(0, run("gen", "miura", "4", "-o", "one.opx"));
    ends(0, run("fold", "one.opx", "--drive", "0=30", "--frames", "4", "-o", "driven.csv", "--report", "driven.json"));
    json_t *report = json_load_file("driven.json", 0, NULL);
    const json_t *crease = json_array_get(json_object_get(report, "creases"), 0), *at = json_object_get(crease, "at");
    near(json_number_value(json_object_get(crease, "target_deg")), 30, 1e-12);
    assert_true(json_is_null(json_object_get(json_array_get(json_object_get(report, "creases"), 1), "target_deg")));
    char point[80];
    double middle[2];
    for (size_t i = 0; i < 2; i++)
        middle[i] = (json_number_value(json_array_get(json_array_get(at, 0), i)) + json_number_value(json_array_get(json_array_get(at, 1), i))) / 2;
    snprintf(point, sizeof point, "%.17g,%.17g=30", middle[0], middle[1]);
    json_decref(report);
    int frame = 0;
    slurp("driven.csv", text);
    for (char *line = strchr(text, '\n') + 1; line && *line; line = strchr(line, '\n') + 1, frame++) {
        double percent, rho[2];
        assert_int_equal(sscanf(line, "%*d,%lf,%lf,%lf", &percent, &rho[0], &rho[1]), 3);
        near(rho[0], 10 * frame, 1e-12);
        near(percent, 100.0 * frame / 3, 1e-9);
        if (frame) assert_true(fabs(rho[1]) > 1);
    }
    assert_int_equal(frame, 4);
    ends(0, run("fold", "one.opx", "--drive", point, "--frames", "4", "-o", "point.csv"));
    static char again[ROOM];
    assert_string_equal(slurp("point.csv", again), text);
    /* Written as FOLD, the driven crease has its angle and the others null: folded again, they follow again. */
    ends(0, run("fold", "one.opx", "--drive", "0=30", "--frames", "4", "-o", "driven.fold"));
    ends(0, run("fold", "driven.fold", "--frame", "0", "--frames", "4", "-o", "again.csv"));
    slurp("again.csv", again);
    double last[2][2];
    assert_int_equal(sscanf(strstr(text, "\n3,"), "\n3,%*f,%lf,%lf", &last[0][0], &last[0][1]), 2);
    assert_int_equal(sscanf(strstr(again, "\n3,"), "\n3,%*f,%lf,%lf", &last[1][0], &last[1][1]), 2);
    for (int i = 0; i < 2; i++) near(last[1][i], last[0][i], 1e-6);
    ends(0, run("fold", "one.opx", "--drive", "0=30", "--drive", "0=-30"));
    says(ends(2, run("fold", "one.opx", "--pin", "3", "--drive", "c3=60")), "rigami: one.opx: --drive c3=60: ", "otherwise");
    says(ends(2, run("fold", "one.opx", "--drive", "3=60", "--free", "3")), "rigami: one.opx: --free 3: ", "otherwise");
    const ran *still = ends(0, run("fold", "one.opx", "--drive", "3=0"));
    assert_non_null(strstr(still->out, "driven to 0 degrees"));
    ends(1, run("fold", "one.opx", "--pin", "0", "--effort", "fast", "--frames", "4", "-o", "pinned.csv"));
    slurp("pinned.csv", again);
    for (char *line = strchr(again, '\n') + 1; line && *line; line = strchr(line, '\n') + 1) {
        double rho;
        assert_int_equal(sscanf(line, "%*d,%*f,%lf", &rho), 1);
        near(rho, 0, 0);
    }
    ends(0, run("fold", "one.opx", "--free", "0"));
    says(ends(2, run("fold", "one.opx", "--drive", "0")), "rigami: --drive: \"0\" is not CREASE=DEG", "5=60");
    says(ends(2, run("fold", "one.opx", "--drive", "0=181")), "rigami: --drive: ", "-180 to 180");
    says(ends(2, run("fold", "one.opx", "--pin", "99")), "rigami: one.opx: --pin 99: there is no such crease", "0 to 23");
    says(ends(2, run("fold", "one.opx", "--free", "x")), "rigami: --free: ", "a crease");
}

/* A strip rolled up, on its creases as they are: panel after panel, which the summary says, -v and the report tell fold by fold. */
static void stages_are_listed(void **state)
{
    (void)state;
    const drawn strip[] = {{1, 0, 0, 4, 0}, {1, 4, 0, 4, 1}, {1, 4, 1, 0, 1}, {1, 0, 1, 0, 0}, {3, 1, 0, 1, 1}, {3, 2, 0, 2, 1}, {3, 3, 0, 3, 1}};
    draw("strip.opx", strip, 7);
    const ran *r = ends(0, run("fold", "strip.opx", "--adjust", "off", "-v", "--report", "strip.json", "-o", "strip.fold"));
    assert_non_null(strstr(r->out, "strip.opx: folded in "));
    assert_non_null(strstr(r->out, "  stages    1: "));
    assert_non_null(strstr(r->out, "  stage 1   frames 0 to "));
    assert_non_null(strstr(r->out, ": valley fold from ("));
    json_t *report = json_load_file("strip.json", 0, NULL);
    const json_t *stages = json_object_get(report, "stages"), *stage, *fold;
    size_t i, k;
    int creases[3] = {0, 0, 0}, frame = 0;
    assert_true(json_array_size(stages) >= 2);
    json_array_foreach(stages, i, stage) {
        assert_string_equal(json_string_value(json_object_get(stage, "kind")), "simple folds");
        assert_int_equal(json_integer_value(json_object_get(stage, "number")), i + 1);
        assert_int_equal(json_integer_value(json_object_get(stage, "first_frame")), frame);
        frame = (int)json_integer_value(json_object_get(stage, "last_frame"));
        json_array_foreach(json_object_get(stage, "folds"), k, fold) {
            const json_t *made = json_object_get(fold, "creases");
            const char *way = json_string_value(json_object_get(fold, "fold"));
            assert_true(strcmp(way, "valley") == 0 || strcmp(way, "mountain") == 0);
            assert_int_equal(json_array_size(json_object_get(fold, "line")), 2);
            for (size_t j = 0; j < json_array_size(made); j++) creases[json_integer_value(json_array_get(made, j))]++;
        }
    }
    assert_int_equal(frame, 59);
    for (int j = 0; j < 3; j++) assert_int_equal(creases[j], 1);
    json_decref(report);
    ends(0, run("verify", "strip.fold", "strip.opx"));
    /* What goes at once has no stages. */
    ends(0, run("fold", "good.opx", "-q", "--report", "strip.json"));
    report = json_load_file("strip.json", 0, NULL);
    assert_null(json_object_get(report, "stages"));
    json_decref(report);
    unlink("strip.fold");
}

/* What was folded freely is found to be a motion by its file alone; of what was not, frame and facets are said, a line each. */
static void motions_are_verified(void **state)
{
    (void)state;
    ends(0, run("fold", "good.opx", "-q", "-o", "good.fold"));
    const ran *r = ends(0, run("verify", "good.fold", "good.opx"));
    assert_int_equal(strncmp(r->out, "valid: one sheet, ", 18), 0);
    assert_non_null(strstr(r->out, "the last frame lies flat and rests on the order of its layers alone"));
    assert_string_equal(r->err, "");
    assert_string_equal(ends(0, run("verify", "good.fold", "-q"))->out, "");
    r = ends(0, run("verify", "good.fold", "--json"));
    json_t *found = json_loads(r->out, JSON_REJECT_DUPLICATES, NULL);
    assert_true(json_is_true(json_object_get(found, "valid")));
    assert_int_equal(json_array_size(json_object_get(found, "faults")), 0);
    json_decref(found);
    ends(0, run("gen", "waterbomb", "6", "-o", "through.opx"));
    ends(1, run("fold", "through.opx", "-q", "--contact", "report", "-o", "through.fold"));
    r = ends(1, run("verify", "through.fold"));
    assert_int_equal(strncmp(r->out, "frame ", 6), 0);
    assert_true(strstr(r->out, " %): facets ") && strstr(r->out, " cross, 0.0"));
    r = ends(1, run("verify", "good.fold", "through.opx"));
    assert_non_null(strstr(r->out, "pattern: edge "));
    r = ends(1, run("verify", "through.fold", "--json"));
    found = json_loads(r->out, JSON_REJECT_DUPLICATES, NULL);
    assert_true(json_is_false(json_object_get(found, "valid")));
    assert_true(json_array_size(json_object_get(found, "faults")) > 0);
    json_decref(found);
    says(ends(2, run("verify", "good.opx")), "rigami: good.opx:1: ", "JSON");
    says(ends(2, run("verify", "missing.fold")), "rigami: missing.fold: ", strerror(ENOENT));
    ends(2, run("verify"));
    unlink("good.fold");
    unlink("through.fold");
}

static void the_report_has_what_is_promised(void **state)
{
    (void)state;
    const ran *r = ends(0, run("fold", "good.opx", "--report", "-", "-o", "report.csv", "--frames", "9"));
    assert_string_equal(r->err, "");
    json_t *report = json_loads(r->out, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(report); /* nothing else is on standard output */
    assert_string_equal(json_string_value(json_object_get(report, "rigami")), RG_VERSION);
    for (size_t i = 0; i < sizeof promised / sizeof *promised; i++)
        for (int k = 0; promised[i].keys[k]; k++)
            if (!json_object_get(json_object_get(report, promised[i].part), promised[i].keys[k])) {
                print_error("the report has no %s.%s\n", promised[i].part, promised[i].keys[k]);
                fail();
            }
    near(value(report, "pattern", "creases"), 4, 0);
    near(value(report, "pattern", "degrees_of_freedom"), 1, 0);
    near(value(report, "result", "folded_percent"), 100, 1);
    below(value(report, "result", "max_closure_residual"), 1e-8);
    assert_true(value(report, "run", "peak_bytes") > 100000);
    assert_true(value(report, "run", "peak_bytes") < 4e9);
    assert_true(value(report, "run", "seconds_writing") >= 0);
    assert_true(value(report, "run", "seconds_total") >= value(report, "run", "seconds_solving"));
    const json_t *frames = json_object_get(report, "frames"), *frame;
    size_t i;
    assert_int_equal(json_array_size(frames), 9);
    json_array_foreach(frames, i, frame) near(json_number_value(json_object_get(frame, "percent")), 12.5 * (double)i, 1);
    json_decref(report);
}

static void info_as_json_has_what_is_promised(void **state)
{
    (void)state;
    json_t *info = json_loads(ends(0, run("info", "short.opx", "--json"))->out, JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(info);
    for (int k = 0; promised[0].keys[k]; k++) assert_non_null(json_object_get(info, promised[0].keys[k]));
    assert_true(json_is_array(json_object_get(info, "closed")));
    assert_true(json_is_array(json_object_get(info, "warnings")));
    assert_string_equal(json_string_value(json_object_get(info, "layers")), "none");
    assert_true(json_is_null(json_object_get(info, "layer_orders")));
    assert_true(json_array_size(json_object_get(info, "layers_where")) > 0);
    assert_int_equal(json_array_size(json_object_get(info, "unfoldable")), 1);
    near(json_number_value(json_object_get(info, "kawasaki_max_deg")), 0.2 / 3.14159265358979323846 * 180, 1e-9);
    json_decref(info);
    assert_true(strlen(ends(0, run("info", "short.opx"))->out) > 100);
}

/* ------------------------------------------------------------------------------------------- interrupted ---- */

static void an_interrupted_fold_is_written_up_to_there(void **state)
{
    (void)state;
    const int signals[] = {SIGINT, SIGTERM};
    ends(0, run("gen", "miura", "12", "-o", "long.opx"));
    for (int k = 0; k < 2; k++) {
        const struct timespec moment = {0, 2000000};
        unlink("stderr");
        unlink("broken.csv");
        const pid_t pid = start(ARGS("fold", "long.opx", "--progress", "--method", "newton", "--step", "0.001", "-o", "broken.csv", "--report",
                                     "broken.json"), &(streams){0});
        while (is_empty("stderr") && waitpid(pid, NULL, WNOHANG) == 0) nanosleep(&moment, NULL); /* until it folds */
        assert_int_equal(kill(pid, signals[k]), 0);
        const ran *r = ends(1, finish(pid));
        assert_non_null(strstr(r->err, "interrupted"));
        json_t *report = json_load_file("broken.json", 0, NULL);
        assert_non_null(report);
        const json_t *result = json_object_get(report, "result");
        assert_int_equal(strncmp(json_string_value(json_object_get(result, "reason")), "interrupted", 11), 0);
        assert_true(json_array_size(json_object_get(report, "frames")) < 60);
        json_decref(report);
        assert_false(is_empty("broken.csv"));
        assert_int_equal(names("broken."), 2);
        unlink("broken.json");
    }
}

/* Time that is over: what there is is written. A signal is obeyed within one solve, and a second one anywhere. */
static void time_is_limited(void **state)
{
    (void)state;
    ends(0, run("gen", "miura", "12", "-o", "long.opx"));
    const ran *r = ends(1, run("fold", "long.opx", "--method", "newton", "--step", "0.001", "--max-seconds", "1.5", "-o", "broken.csv"));
    assert_non_null(strstr(r->err, "1.5 seconds"));
    assert_false(is_empty("broken.csv"));
    if (!WITH_ASAN) {
        ends(0, run("fold", "good.opx", "--max-seconds", "1000", "--max-memory", "4000"));
        says(ends(3, run("fold", "good.opx", "--max-memory", "1")), "rigami: ", "memory");
    }
    says(ends(2, run("fold", "good.opx", "--max-seconds", "-1")), "rigami: --max-seconds: ", "-1");
    ends(0, run("gen", "miura", "24", "-o", "long.opx"));
    const pid_t pid = start(ARGS("fold", "long.opx", "--solver", "svd", "--frames", "2", "-o", "broken.fold"), &(streams){0});
    nanosleep(&(struct timespec){2, 0}, NULL); /* by then it is within a solve of many seconds */
    assert_int_equal(kill(pid, SIGTERM), 0);
    ends(1, finish(pid));
    unlink("broken.csv");
    unlink("broken.fold");
    assert_int_equal(names("broken."), 0);
}

/* Memory that is short is told as such, and not as a file that is bad: whatever reads it, and however little there is. */
static void memory_is_limited(void **state)
{
    (void)state;
    if (WITH_ASAN) {
        print_message(NO_LIMIT);
        skip();
    }
    ends(0, run("gen", "miura", "24", "-o", "large.opx"));
    ends(0, run("convert", "-q", "large.opx", "-o", "large.fold"));
    const char *const files[] = {"large.opx", "large.fold"};
    int short_of_it = 0;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 12; k++) {
            char megabytes[20];
            snprintf(megabytes, sizeof megabytes, "%d", 25 + 8 * k);
            const ran *r = run("info", "-q", files[i], "--max-memory", megabytes);
            if (r->status == 0) continue;
            ends(3, r);
            assert_non_null(strstr(r->err, "memory"));
            short_of_it++;
        }
    assert_true(short_of_it > 0);
}

/* What is too much is refused, without an end of reading or of memory. */
static void what_is_too_much_is_refused(void **state)
{
    (void)state;
    if (there("/dev/zero")) says(ends(2, run("info", "/dev/zero")), "rigami: /dev/zero: ", "more than 1024 MB");
    FILE *f = fopen("crowd.cp", "w");
    assert_non_null(f);
    fprintf(f, "1 -1 -1 1 -1\n1 1 -1 1 1\n1 1 1 -1 1\n1 -1 1 -1 -1\n");
    for (int i = 0; i < 1200; i++) {
        const double a = 2 * 3.14159265358979323846 * (i + 0.3) / 1200, c = cos(a), s = sin(a), r = 1 / fmax(fabs(c), fabs(s));
        fprintf(f, "%d 0 0 %.15g %.15g\n", 2 + i % 2, r * c, r * s);
    }
    fclose(f);
    says(ends(2, run("fold", "crowd.cp", "--merge", "1e-6")), "rigami: crowd.cp: 1200 creases meet at (0, 0)", "no more than 1000");
    assert_non_null(strstr(ends(0, run("info", "crowd.cp", "--merge", "1e-6"))->out, "It cannot be folded here: 1200 creases meet"));
}

/* A name may be as long as the file system takes, once and again, and what is left of it by others is swept. */
static void names_are_as_long_as_they_may_be(void **state)
{
    (void)state;
    char name[256], left[300];
    memset(name, 'x', 255);
    strcpy(name + 251, ".csv");
    for (int k = 0; k < 2; k++) {
        if (k == 1) {
            snprintf(left, sizeof left, "%.215s.1-0.part", name);
            write_file(left, "of one that was killed");
        }
        ends(0, run("fold", "good.opx", "-q", "--frames", k ? "3" : "2", "-o", name));
    }
    static char text[ROOM];
    assert_int_equal(lines_in(slurp(name, text)), 4);
    assert_false(there(left));
    unlink(name);
    assert_int_equal(names("xxx"), 0);
}

/* A chart that time or a signal ends says so, and is one all the same. */
static void a_chart_that_is_ended_says_so(void **state)
{
    (void)state;
    ends(0, run("gen", "miura", "6", "-o", "charted.opx"));
    says(ends(1, run("chart", "charted.opx", "-q", "-o", "charts", "--max-seconds", "0.7")), "rigami: charted.opx: ", "0.7 seconds");
    assert_false(is_empty("charts/charted.md"));
}

/* What has the name and the beginning of a frame is one only if it is whole. */
static void a_frame_that_is_cut_off_is_drawn_again(void **state)
{
    (void)state;
    static char whole[ROOM];
    struct stat is;
    for (int k = 0; k < 2; k++) {
        ends(0, run("fold", "good.opx", "-q", "--frames", "2", "--size", "60x40", "-o", "cut-%d.png", "--resume"));
        assert_int_equal(stat("cut-1.png", &is), 0);
        assert_true(is.st_size > 300);
        if (k == 1) break;
        FILE *f = fopen("cut-1.png", "rb");
        assert_true(f && fread(whole, 1, (size_t)is.st_size, f) == (size_t)is.st_size);
        fclose(f);
        assert_int_equal(truncate("cut-1.png", 280), 0);
    }
    FILE *f = fopen("cut-1.png", "rb");
    static char again[ROOM];
    assert_true(f && fread(again, 1, (size_t)is.st_size, f) == (size_t)is.st_size);
    fclose(f);
    assert_memory_equal(whole, again, (size_t)is.st_size);
}

/* One place under two names is one output, and an input is not written over. */
static void one_place_is_written_once(void **state)
{
    (void)state;
    says(ends(2, run("fold", "good.opx", "-o", "once.fold", "-o", "./once.fold")), "rigami: ./once.fold: ", "twice");
    says(ends(2, run("fold", "good.opx", "-o", "once/", "-o", ".//once/")), "rigami: .//once/: ", "twice");
    assert_int_equal(names("once"), 0);
    /* Frames, each in its file, are many places. */
    mkdir("many_frames", 0777);
    says(ends(2, run("fold", "good.opx", "-o", "many_frames/", "-o", "many_frames/0001.png")), "rigami: many_frames/0001.png: ", "twice");
    says(ends(2, run("fold", "good.opx", "-o", "once-0007.obj", "-o", "./once-%04d.obj")), "rigami: ./once-%04d.obj: ", "twice");
    says(ends(2, run("fold", "good.opx", "-o", "once-%d.obj", "-o", "once-%04d.obj")), "rigami: once-%04d.obj: ", "twice");
    ends(0, run("fold", "good.opx", "-q", "--frames", "2", "-o", "twice-%04d.obj", "-o", "twice-7.obj", "-o", "twice-a.obj", "-o", "twice-b%04d.obj"));
    /* A picture to be printed is an input, and so is what a chart is of. */
    ends(0, run("fold", "good.opx", "-q", "--frames", "2", "--size", "40x40", "-o", "print.png", "-o", "many_frames/"));
    says(ends(2, run("fold", "good.opx", "--image", "print.png", "-o", "./print.png")), "rigami: ./print.png: ", "written over");
    says(ends(2, run("fold", "good.opx", "--image", "many_frames/0001.png", "-o", "many_frames/")), "rigami: many_frames/: ", "written over");
    says(ends(2, run("fold", "good.opx", "--image", "nowhere.png", "-o", "print.gif")), "rigami: nowhere.png: ", strerror(ENOENT));
    ends(0, run("convert", "-q", "good.opx", "-o", "charted.svg"));
    static char before[ROOM], after[ROOM];
    slurp("charted.svg", before);
    says(ends(2, run("chart", "charted.svg", "-o", ".")), "rigami: ./charted.svg: ", "is the input");
    assert_string_equal(slurp("charted.svg", after), before);
    says(ends(2, run("convert", "good.opx", "-o", "./good.opx")), "rigami: ./good.opx: ", "is the input");
    ends(0, run("info", "good.opx"));
}

/* ------------------------------------------------------------------------------------- others' bad files ---- */

/* What the corpus says of them; facets 0: not said, or to be refused. */
static const struct { const char *name; int readable, vertices, edges, facets; } malformed[] = {
    {"bad-edges.fold", 0, 0, 0, 0},
    {"bowtie.fold", 1, 0, 0, 0},
    {"corrupted.ori", 0, 0, 0, 0},
    {"disjoint-cps.fold", 1, 0, 0, 0},
    {"faceless.cp", 1, 0, 0, 0},
    {"glitch.cp", 1, 50, 117, 68},
    {"heavy_test.opx", 0, 0, 0, 0},
    {"invalid-key-names.fold", 0, 0, 0, 0},
    {"invalid-mismatch-length.fold", 0, 0, 0, 0},
    {"invalid-mismatch-references.fold", 0, 0, 0, 0},
    {"isolated-line-in-face.fold", 1, 0, 0, 0},
    {"junk.cp", 0, 0, 0, 0},
    {"non-planar-bird-base.fold", 1, 35, 78, 44},
    {"overlapping-assignments.fold", 1, 0, 0, 0},
};

static void bad_files_of_others_are_read_or_refused(void **state)
{
    (void)state;
    int bad = 0;
    for (size_t i = 0; i < sizeof malformed / sizeof *malformed; i++) {
        char name[100], path[4096], begin[4200];
        snprintf(name, sizeof name, "malformed/%s", malformed[i].name);
        snprintf(begin, sizeof begin, "rigami: %s:", corpus(name, path, sizeof path));
        const ran *r = run("info", "--json", "-q", path);
        if (r->status == 2) {
            says(r, begin, "");
            assert_string_equal(r->out, "");
            if (malformed[i].facets) print_error("%s is refused: %s", name, r->err), bad++;
        } else {
            ends(0, r);
            json_t *info = json_loads(r->out, 0, NULL);
            assert_non_null(info);
            const int v = (int)json_integer_value(json_object_get(info, "vertices"));
            const int e = (int)json_integer_value(json_object_get(info, "edges"));
            const int f = (int)json_integer_value(json_object_get(info, "facets"));
            json_decref(info);
            if (!malformed[i].readable) print_error("%s is read\n", name), bad++;
            if (malformed[i].facets && (v != malformed[i].vertices || e != malformed[i].edges || f != malformed[i].facets))
                print_error("%s has V %d, E %d, F %d\n", name, v, e, f), bad++;
        }
        /* What says what it left out may fold the rest. */
        const int warned = strstr(run("info", path)->err, ": warning: ") != NULL;
        r = run("fold", "-q", "--effort", "fast", path);
        if (r->status == 2) says(r, begin, "");
        if (r->status > 2) print_error("fold %s ends with %d: %s\n", name, r->status, r->err), bad++;
        if (!malformed[i].facets && !warned && r->status != 2) print_error("%s is folded\n", name), bad++;
    }
    assert_int_equal(bad, 0);
}

/* ------------------------------------------------------------------------------------------------ all ---- */

static int is_in_folder; /* else what end_all finds is not ours to remove: it is called where begin_all failed, too */

static int begin_all(void **state)
{
    (void)state;
    const char *given = getenv("RIGAMI"), *others = getenv("RIGAMI_CORPUS");
    char path[PATH_MAX];
    if (!realpath(given && *given ? given : "./rigami", program)) {
        print_error("no program at %s; RIGAMI names it\n", given ? given : "./rigami");
        return -1;
    }
    if (realpath(others && *others ? others : "../shared/corpus", path)) setenv("RIGAMI_CORPUS", path, 1);
    unsetenv("POSIXLY_CORRECT");
    if (!mkdtemp(folder) || chdir(folder) != 0) return -1;
    is_in_folder = 1;
    draw_all();
    return 0;
}

static int end_all(void **state)
{
    (void)state;
    if (!is_in_folder) return 0;
    return folder_remove(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pattern_folds),
        cmocka_unit_test(a_fold_that_stops_short_is_written_and_explained),
        cmocka_unit_test(the_verdict_comes_first), cmocka_unit_test(states_in_frames), cmocka_unit_test(tables_are_tidy), cmocka_unit_test(what_does_not_move_is_told),
        cmocka_unit_test(what_was_meant), cmocka_unit_test(a_motion_is_drawn_again),
        cmocka_unit_test(a_motion_of_any_size_is_drawn),
        cmocka_unit_test(a_frame_that_is_cut_off_is_drawn_again),
        cmocka_unit_test(titles_stay_on_one_line),
        cmocka_unit_test(an_order_of_layers_has_to_be_there),
        cmocka_unit_test(a_batch),
        cmocka_unit_test(names_of_a_batch),
        cmocka_unit_test(a_batch_goes_on),
        cmocka_unit_test(names_are_as_long_as_they_may_be),
        cmocka_unit_test(a_chart_that_is_ended_says_so),
        cmocka_unit_test(creases_may_roll_so_far),
        cmocka_unit_test(wrong_usage_is_refused),
        cmocka_unit_test(unreadable_input_is_refused),
        cmocka_unit_test(a_bad_line_is_named),
        cmocka_unit_test(what_is_no_sheet_is_described_but_not_folded),
        cmocka_unit_test(lines_without_numbers_are_warned_of),
        cmocka_unit_test(messages_stay_on_one_line),
        cmocka_unit_test(outputs_that_cannot_be_are_refused_before_folding),
        cmocka_unit_test(writing_that_fails_keeps_what_was_there),
        cmocka_unit_test(standard_output_that_fails_is_told),
        cmocka_unit_test(the_same_input_gives_the_same_bytes),
        cmocka_unit_test(fold_angles_reach_their_end),
        cmocka_unit_test(standard_input_is_read),
        cmocka_unit_test(names_are_bytes),
        cmocka_unit_test(options_are_taken),
        cmocka_unit_test(bad_values_are_refused),
        cmocka_unit_test(help_names_every_option),
        cmocka_unit_test(examples_are_made),
        cmocka_unit_test(patterns_are_converted),
        cmocka_unit_test(passing_through_itself_is_told), cmocka_unit_test(creases_are_driven_pinned_and_freed), cmocka_unit_test(stages_are_listed),
        cmocka_unit_test(motions_are_verified),
        cmocka_unit_test(the_report_has_what_is_promised),
        cmocka_unit_test(info_as_json_has_what_is_promised),
        cmocka_unit_test(an_interrupted_fold_is_written_up_to_there),
        cmocka_unit_test(time_is_limited), cmocka_unit_test(memory_is_limited), cmocka_unit_test(what_is_too_much_is_refused), cmocka_unit_test(one_place_is_written_once),
        cmocka_unit_test(bad_files_of_others_are_read_or_refused),
    };
    return cmocka_run_group_tests(tests, begin_all, end_all);
}
