/* What goes wrong while a motion is written: every form of output against every fault, by the program from outside. However it ends, the
 * exit status is one that is promised, what is there is what was there before or what an unbroken run writes, and nothing is left over.
 * $RIGAMI is the program. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <errno.h>
#include <string.h>

#include <cmocka.h>

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/file.h"
#include "folder.h"
#include "near.h"

enum { ROOM = 1 << 22, ALL = 20, FRAMES = 6 };

static char program[PATH_MAX], folder[] = "/tmp/rigami-faults-XXXXXX";
static int times = 2;    /* moments of a signal, sizes of memory; RIGAMI_FAULTS says how many, ALL in make check-long */

/* Forms; of a folder of frames, one of them is looked at. */
static const struct form { const char *output, *looked_at; int by_ffmpeg; const char *last; /* its last bytes; NULL: it is no picture of ours */ } forms[] = {
    {"x.fold", "x.fold", 0, NULL}, {"x.csv", "x.csv", 0, NULL},   {"x.svg", "x.svg", 0, NULL},   {"x.dxf", "x.dxf", 0, NULL},
    {"x.obj", "x.obj", 0, NULL},   {"x.stl", "x.stl", 0, NULL},   {"x.glb", "x.glb", 0, NULL},   {"x.gltf", "x.gltf", 0, NULL},
    {"x.html", "x.html", 0, NULL}, {"x.png", "x.png", 0, "IEND\xae\x42\x60\x82"}, {"x.gif", "x.gif", 0, ";"}, {"x.apng", "x.apng", 0, "IEND\xae\x42\x60\x82"},
    {"x%03d.png", "x002.png", 0, "IEND\xae\x42\x60\x82"}, {"x%03d.obj", "x002.obj", 0, NULL}, {"x.mp4", "x.mp4", 1, NULL}, {"x.webm", "x.webm", 1, NULL}};
enum { FORMS = sizeof forms / sizeof *forms };
static double whole_run[FORMS]; /* seconds that each takes, so that moments are drawn from all of its own run */

/* ----------------------------------------------------------------------------------------------- running ---- */

typedef struct limits { rlim_t memory, file; } limits; /* 0: none */

static pid_t start(const char *output, const char *out, limits l, int resume)
{
    fflush(NULL);
    const pid_t pid = fork();
    if (pid != 0) return pid;
    const int err = open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0644), to = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(to, 1);
    dup2(err, 2);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    if (l.file) setrlimit(RLIMIT_FSIZE, &(struct rlimit){l.file, l.file});
    if (l.memory) setrlimit(RLIMIT_AS, &(struct rlimit){l.memory, l.memory});
    execl(program, program, "fold", "in.opx", "-q", "--frames", "6", "--size", "200x150", "-o", output, resume ? "--resume" : NULL, NULL);
    _exit(99);
}

/* The exit status; 1000 and more: a signal. */
static int finish(pid_t pid)
{
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

static size_t slurp(const char *path, char *text)
{
    FILE *f = fopen(path, "rb");
    const size_t n = f ? fread(text, 1, ROOM - 1, f) : 0;
    if (f) fclose(f);
    text[n] = 0;
    return n;
}

static int is_same(const char *a, const char *b)
{
    static char one[ROOM], other[ROOM];
    const size_t n = slurp(a, one), m = slurp(b, other);
    return n == m && n > 0 && memcmp(one, other, n) == 0;
}

static void put(const char *path, const char *text)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void wait_until(double time)
{
    for (double left; (left = time - now()) > 0;) nanosleep(&(struct timespec){(time_t)left, (long)(1e9 * (left - floor(left)))}, NULL);
}

/* Names that are neither the outputs nor the test's own. */
static int left_over(void)
{
    int n = 0;
    DIR *d = opendir(".");
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) {
        if (!strstr(e->d_name, ".part") && !strstr(e->d_name, "rigami-")) continue;
        print_error("left over: %s\n", e->d_name);
        n++;
    }
    closedir(d);
    return n;
}

static void clear(void)
{
    DIR *d = opendir(".");
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));)
        if (e->d_name[0] == 'x') unlink(e->d_name);
    closedir(d);
}

/* What an unbroken run writes, whatever comes first. */
static void reference(const struct form *f, char path[80]) { snprintf(path, 80, "whole-%s", f->looked_at); }

static int has_ffmpeg(void) { return system("command -v ffmpeg >/dev/null 2>&1") == 0; }

static int is_skipped(const struct form *f) { return f->by_ffmpeg && !has_ffmpeg(); }

/* A picture whose last bytes are there. Where memory is short, OpenGL may have none and another part draws, to almost the same pixels. */
static int is_complete_picture(const struct form *f)
{
    static char text[ROOM];
    const size_t n = slurp(f->looked_at, text), m = f->last ? strlen(f->last) : 0;
    if (f->by_ffmpeg) return n > 100;
    return m > 0 && n > 100 && memcmp(text + n - m, f->last, m) == 0;
}

/* All of a file of its kind, by its last bytes: a motion that was ended before its own end is shorter, and otherwise as any. */
static int is_complete(const struct form *f)
{
    static const struct { const char *form, *last; } kinds[] = {{".fold", "}\n"}, {".csv", "\n"}, {".svg", "</svg>\n"}, {".dxf", "EOF\n"}, {".obj", "\n"},
                                                                {".gltf", "}\n"}, {".html", "</html>\n"}};
    static char text[ROOM];
    const size_t n = slurp(f->looked_at, text);
    if (f->last || f->by_ffmpeg) return is_complete_picture(f);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const size_t m = strlen(kinds[k].last);
        if (strcmp(strrchr(f->output, '.'), kinds[k].form) == 0) return n > 100 && memcmp(text + n - m, kinds[k].last, m) == 0;
    }
    uint32_t said = 0;
    const int is_glb = strcmp(f->output, "x.glb") == 0;
    if (n > 100) memcpy(&said, text + (is_glb ? 8 : 80), sizeof said);
    return n > 100 && n == (is_glb ? said : 84 + 50 * (size_t)said); /* of .glb its length, of .stl its triangles, little end first */
}

static int failures;

/* Is the place as it was before, or as an unbroken run leaves it? `may`: exit statuses that are promised, as digits. */
static void check(const struct form *f, const char *fault, int status, const char *may, const char *before, int drawn_anyhow)
{
    static char text[ROOM];
    char whole[80];
    reference(f, whole);
    const int promised = status < 10 && strchr(may, '0' + status) != NULL;
    const int there = access(f->looked_at, F_OK) == 0;
    const int is_old = before ? slurp(f->looked_at, text) == strlen(before) && strcmp(text, before) == 0 : !there;
    const int there_all = is_old || is_same(f->looked_at, whole) || (drawn_anyhow && is_complete_picture(f));
    const int is_shorter = status == 1 && is_complete(f); /* what there was when it was interrupted */
    slurp("stderr", text);
    const int good = promised && (there_all || (is_shorter && strstr(text, "interrupted") && !strstr(text, "is not written"))) && left_over() == 0;
    const int says = status == 0 || status >= 1000 || strncmp(text, "rigami: ", 8) == 0;
    if (good && says) return;
    print_error("%s, %s: ended with %d, %s, saying: %s\n", f->output, fault, status, is_old ? "as it was" : "neither old nor whole", text);
    failures++;
}

/* --------------------------------------------------------------------------------------------------- table ---- */

static void a_disk_that_is_full(const struct form *f)
{
    for (int k = 0; k < 2; k++) {
        clear();
        if (k) put(f->looked_at, "old");
        check(f, "a full disk", finish(start(f->output, "/dev/null", (limits){.file = 200}, 0)), "3", k ? "old" : NULL, 0);
    }
}

static void a_folder_that_is_not_there(const struct form *f)
{
    char path[80];
    snprintf(path, sizeof path, "nowhere/%s", f->output);
    clear();
    check(f, "no folder", finish(start(path, "/dev/null", (limits){0}, 0)), "3", NULL, 0);
    assert_int_not_equal(access("nowhere", F_OK), 0);
}

/* Whoever may write anywhere is not kept from it by a folder's mode. */
static void a_folder_that_is_read_only(const struct form *f)
{
    char path[80];
    if (geteuid() == 0) snprintf(path, sizeof path, "/proc/%s", f->output); /* where nobody can */
    else snprintf(path, sizeof path, "locked/%s", f->output);
    clear();
    check(f, "read-only", finish(start(path, "/dev/null", (limits){0}, 0)), "3", NULL, 0);
}

static void memory_that_is_short(const struct form *f)
{
    if (WITH_ASAN) {
        print_message(NO_LIMIT);
        return;
    }
    for (int k = 0; k < times; k++) {
        const int megabytes = 40 + 25 * (k * ALL / times);
        char fault[40];
        clear();
        put(f->looked_at, "old");
        snprintf(fault, sizeof fault, "%d MB", megabytes);
        const int status = finish(start(f->output, "/dev/null", (limits){.memory = (rlim_t)megabytes * 1000000}, 0));
        /* Below what the loader itself needs, there is no program yet that could promise anything. */
        if (status != 127) check(f, fault, status, "03", "old", 1);
    }
}

/* Whether the program has come so far that it is told of a signal; before, while it is loaded, there is nobody to promise anything. Where
 * the system does not say, it is taken to have. */
static int is_told(pid_t pid, int number)
{
    char path[40], line[200];
    unsigned long long caught = ~0ULL;
    snprintf(path, sizeof path, "/proc/%d/status", (int)pid);
    FILE *f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, "SigCgt: %llx", &caught) == 1) break;
    if (f) fclose(f);
    return (int)(caught >> (number - 1) & 1);
}

static void signals(const struct form *f)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGKILL};
    unsigned seed = 7;
    for (int s = 0; s < 3; s++)
        for (int k = 0; k < times; k++) {
            char fault[40];
            clear();
            put(f->looked_at, "old");
            snprintf(fault, sizeof fault, "signal %d", numbers[s]);
            const double begun = now();
            const pid_t pid = start(f->output, "/dev/null", (limits){0}, 0);
            wait_until(begun + whole_run[f - forms] * fabs(noise(&seed)));
            const int has_to_end = numbers[s] != SIGKILL && is_told(pid, numbers[s]);
            kill(pid, numbers[s]);
            const int status = finish(pid);
            check(f, fault, !has_to_end && status == 1000 + numbers[s] ? 0 : status, numbers[s] == SIGKILL ? "0" : "01", "old", 0);
        }
}

static void whole_runs(void)
{
    for (int i = 0; i < FORMS; i++) {
        char whole[80];
        if (is_skipped(&forms[i])) continue;
        const double begun = now();
        assert_int_equal(finish(start(forms[i].output, "/dev/null", (limits){0}, 0)), 0);
        whole_run[i] = now() - begun;
        reference(&forms[i], whole);
        assert_int_equal(rename(forms[i].looked_at, whole), 0);
        clear();
    }
}

static void every_form_and_every_fault(void **state)
{
    (void)state;
    void (*const faults[])(const struct form *) = {a_disk_that_is_full, a_folder_that_is_not_there, a_folder_that_is_read_only, memory_that_is_short,
                                                   signals};
    whole_runs();
    print_message("%d moments and sizes of each, of %d\n", times, ALL);
    failures = 0;
    for (int i = 0; i < FORMS; i++)
        for (size_t k = 0; k < sizeof faults / sizeof *faults; k++)
            if (!is_skipped(&forms[i])) faults[k](&forms[i]);
    if (!has_ffmpeg()) print_message("without films: no ffmpeg on this machine\n");
    assert_int_equal(failures, 0);
}

/* ----------------------------------------------------------------------------------------- what is gone on with ---- */

/* Killed again and again, gone on with every time: the frames are those of an unbroken run. */
static void a_dump_goes_on(void **state)
{
    (void)state;
    char name[40], whole[60];
    unsigned seed = 5;
    clear();
    assert_int_equal(finish(start("x%03d.png", "/dev/null", (limits){0}, 0)), 0);
    for (int k = 0; k < FRAMES; k++) {
        snprintf(name, sizeof name, "x%03d.png", k);
        snprintf(whole, sizeof whole, "dump-%03d.png", k);
        assert_int_equal(rename(name, whole), 0);
    }
    for (int k = 0; k < 10; k++) {
        const double begun = now();
        const pid_t pid = start("x%03d.png", "/dev/null", (limits){0}, 1);
        wait_until(begun + 0.5 * fabs(noise(&seed)));
        kill(pid, SIGKILL);
        finish(pid);
        assert_int_equal(left_over(), 0);
    }
    /* A frame of another run is none of this one. */
    put("x001.png", "not a frame of this run");
    assert_int_equal(finish(start("x%03d.png", "/dev/null", (limits){0}, 1)), 0);
    for (int k = 0; k < FRAMES; k++) {
        snprintf(name, sizeof name, "x%03d.png", k);
        snprintf(whole, sizeof whole, "dump-%03d.png", k);
        assert_true(is_same(name, whole));
    }
    /* What is there is not drawn again. */
    struct stat first, again;
    assert_int_equal(stat("x003.png", &first), 0);
    assert_int_equal(finish(start("x%03d.png", "/dev/null", (limits){0}, 1)), 0);
    assert_int_equal(stat("x003.png", &again), 0);
    assert_true(first.st_ino == again.st_ino);
}

/* --------------------------------------------------------------------------------------------- files alone ---- */

/* Where a file has a name from the beginning: nothing of it stays, and what a dead one left is swept away, but no living one's. */
static void files_with_names(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_file f, g;
    rg_diag why;
    char other[80];
    clear();
    snprintf(other, sizeof other, "x.csv.%ld-7.part", (long)getpid() + 1);
    put(other, "of a program that is dead");
    put("x.csv.12-0.party", "somebody else's");
    put("xx.csv.12-0.part", "of another file");
    assert_int_equal(rg_file_begin_named(&f, &mem, "x.csv", &why), RG_OK);
    fputs("new", f.stream);
    assert_int_equal(rg_file_begin(&g, &mem, "x.csv", &why), RG_OK); /* sweeps */
    assert_int_not_equal(access(other, F_OK), 0);
    assert_int_equal(access("x.csv.12-0.party", F_OK), 0);
    assert_int_equal(access("xx.csv.12-0.part", F_OK), 0);
    assert_int_equal(access(f.temporary, F_OK), 0); /* it lives */
    rg_file_abandon(&g);
    assert_int_equal(rg_file_commit(&f, &why), RG_OK);
    static char text[ROOM];
    slurp("x.csv", text);
    assert_string_equal(text, "new");
    assert_int_equal(rg_file_begin_named(&f, &mem, "x.csv", &why), RG_OK);
    snprintf(other, sizeof other, "%s", f.temporary);
    rg_file_sweep("x.csv", "", 1);
    assert_int_not_equal(access(other, F_OK), 0); /* its own, which is to end */
    rg_file_abandon(&f);
    slurp("x.csv", text);
    assert_string_equal(text, "new");
    unlink("x.csv.12-0.party");
    unlink("xx.csv.12-0.part");
}

/* A file of which there is nothing before all of it is there, in place of one that is there and of none. */
static void files_without_names(void **state)
{
    (void)state;
    const rg_memory mem = rg_mem_default(NULL);
    rg_diag why;
    static char text[ROOM];
    for (int k = 0; k < 2; k++) {
        rg_file f;
        clear();
        if (k) put("x.csv", "old");
        assert_int_equal(rg_file_begin(&f, &mem, "x.csv", &why), RG_OK);
        fputs("new", f.stream);
        fflush(f.stream);
        if (f.nameless) assert_int_equal(left_over(), 0);
        assert_int_equal(access("x.csv", F_OK) == 0, k);
        assert_int_equal(rg_file_commit(&f, &why), RG_OK);
        slurp("x.csv", text);
        assert_string_equal(text, "new");
        assert_int_equal(left_over(), 0);
    }
}

/* ------------------------------------------------------------------------------------------------ all ---- */

static int is_in_folder;

static int begin_all(void **state)
{
    (void)state;
    const char *given = getenv("RIGAMI"), *wanted = getenv("RIGAMI_FAULTS");
    if (wanted && atoi(wanted) > 0) times = atoi(wanted);
    char command[PATH_MAX + 60];
    if (!realpath(given && *given ? given : "./rigami", program)) {
        print_error("no program at %s; RIGAMI names it\n", given ? given : "./rigami");
        return -1;
    }
    if (!mkdtemp(folder) || chdir(folder) != 0) return -1;
    is_in_folder = 1;
    if (mkdir("locked", 0555) != 0) return -1;
    snprintf(command, sizeof command, "'%s' gen miura 4 -o in.opx", program);
    return system(command) == 0 ? 0 : -1;
}

static int end_all(void **state)
{
    (void)state;
    if (!is_in_folder) return 0;
    return folder_remove(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(files_with_names), cmocka_unit_test(files_without_names), cmocka_unit_test(a_dump_goes_on),
                                       cmocka_unit_test(every_form_and_every_fault)};
    return cmocka_run_group_tests(tests, begin_all, end_all);
}
