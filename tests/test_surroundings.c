/* What is odd round the program rather than in its files: signals of every kind, pipes that nobody reads, streams that
 * do not wait, folders that go away, others at the same work. It ends as it promises all the same. $RIGAMI is the
 * program. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "folder.h"
#include "near.h"

enum { MOST_ARGS = 40, ROOM = 1 << 16 };

static char program[PATH_MAX], folder[] = "/tmp/rigami-surroundings-XXXXXX";

/* ----------------------------------------------------------------------------------------------- running ---- */

/* How a run begins. */
typedef struct around {
    int in;              /* standard input, if above 0 */
    int ignored;         /* a signal that is ignored; 0: none */
    rlim_t seconds;      /* of a processor, after which it is told that they are over; 0: any */
    const char *err;     /* NULL: "stderr" */
} around;

static pid_t start(const around *a, const char *const *args)
{
    char *argv[MOST_ARGS + 2] = {program};
    for (int i = 0; args[i]; i++) {
        assert_true(i < MOST_ARGS);
        argv[i + 1] = (char *)args[i];
    }
    fflush(NULL);
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid > 0) return pid;
    const int in = a->in > 0 ? a->in : open("/dev/null", O_RDONLY), out = open("/dev/null", O_WRONLY);
    const int err = open(a->err ? a->err : "stderr", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) _exit(99);
    for (int n = 1; n < 32; n++) signal(n, n == a->ignored ? SIG_IGN : SIG_DFL);
    if (a->seconds) setrlimit(RLIMIT_CPU, &(struct rlimit){a->seconds, a->seconds + 20});
    execv(program, argv);
    _exit(98);
}

/* The exit status; 1000 and more: a signal. */
static int finish(pid_t pid)
{
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

#define ARGS(...) (const char *const[]){__VA_ARGS__, NULL}
#define run(around_, ...) finish(start(around_, ARGS(__VA_ARGS__)))

static const char *slurp(const char *path)
{
    static char text[ROOM];
    FILE *f = fopen(path, "rb");
    const size_t n = f ? fread(text, 1, ROOM - 1, f) : 0;
    if (f) fclose(f);
    text[n] = 0;
    return text;
}

static int is_there(const char *path)
{
    struct stat is;
    return stat(path, &is) == 0 && is.st_size > 0;
}

static void write_file(const char *path, const char *text)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

static void pause_a_moment(void) { nanosleep(&(struct timespec){0, 2000000}, NULL); }

/* Exactly one line, that has `part` in it. */
static void says(const char *part, const char *err)
{
    const char *text = slurp(err), *end = strchr(text, '\n');
    if (strncmp(text, "rigami: ", 8) == 0 && end && !end[1] && strstr(text, part)) return;
    print_error("not one line with \"%s\" in it, but: %s\n", part, text);
    fail();
}

static int parts_left(void)
{
    int n = 0;
    DIR *d = opendir(".");
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) n += strstr(e->d_name, ".part") != NULL;
    closedir(d);
    return n;
}

/* ----------------------------------------------------------------------------------------------- signals ---- */

/* A fold that takes long, once it folds. */
static pid_t start_long(const around *a)
{
    unlink("stderr");
    unlink("long.csv");
    return start(a, ARGS("fold", "long.opx", "--progress", "--method", "newton", "--step", "0.001", "-o", "long.csv"));
}

static void whatever_asks_it_to_end(void **state)
{
    (void)state;
    static const int numbers[] = {SIGHUP, SIGXCPU, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        const pid_t pid = start_long(&(around){0});
        while (!is_there("stderr") && waitpid(pid, NULL, WNOHANG) == 0) pause_a_moment();
        assert_int_equal(kill(pid, numbers[k]), 0);
        assert_int_equal(finish(pid), 1);
        assert_non_null(strstr(slurp("stderr"), "interrupted"));
        assert_true(is_there("long.csv"));
        assert_int_equal(parts_left(), 0);
    }
}

/* What the caller has ignored stays so: nohup and its like. */
static void what_is_ignored_stays_ignored(void **state)
{
    (void)state;
    const pid_t pid = start_long(&(around){.ignored = SIGHUP});
    while (!is_there("stderr") && waitpid(pid, NULL, WNOHANG) == 0) pause_a_moment();
    assert_int_equal(kill(pid, SIGHUP), 0);
    pause_a_moment();
    assert_int_equal(kill(pid, SIGTERM), 0);
    assert_int_equal(finish(pid), 1);
    /* Where nobody is told of children that end, pictures are drawn by one all the same. */
    assert_int_equal(run(&(around){.ignored = SIGCHLD}, "fold", "in.opx", "-q", "--frames", "2", "-o", "alone.png"), 0);
    assert_true(is_there("alone.png"));
}

static void seconds_of_the_processor_are_over(void **state)
{
    (void)state;
    assert_int_equal(finish(start_long(&(around){.seconds = 1})), 1);
    assert_non_null(strstr(slurp("stderr"), "interrupted"));
    assert_true(is_there("long.csv"));
}

/* ----------------------------------------------------------------------------------------------- streams ---- */

/* Standard input that gives what it has, and does not wait for more. */
static void input_that_does_not_wait(void **state)
{
    (void)state;
    int ends[2];
    const char *text = slurp("in.opx");
    const size_t n = strlen(text);
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(fcntl(ends[0], F_SETFL, O_NONBLOCK), 0);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    const pid_t pid = start(&(around){.in = ends[0]}, ARGS("info", "-"));
    for (size_t at = 0; at < n; at += 500) {
        const size_t piece = n - at < 500 ? n - at : 500;
        assert_int_equal(write(ends[1], text + at, piece), (ssize_t)piece);
        pause_a_moment();
    }
    close(ends[1]);
    close(ends[0]);
    assert_int_equal(finish(pid), 0);
}

/* A file that never ends is no motion and no pattern, whoever reads it. */
static void input_without_end(void **state)
{
    (void)state;
    if (access("/dev/zero", R_OK) != 0) {
        print_message("SKIPPED: no file without an end here\n");
        skip();
    }
    assert_int_equal(run(&(around){0}, "verify", "/dev/zero"), 2);
    says("more than 1024 MB", "stderr");
    assert_int_equal(run(&(around){0}, "draw", "/dev/zero", "-o", "zero.png"), 2);
    says("more than 1024 MB", "stderr");
    assert_int_equal(run(&(around){0}, "batch", "/dev/zero", "-q", "-o", "zeros/"), 1);
    assert_non_null(strstr(slurp("zeros/table.csv"), ",/dev/zero,0,2,refused,"));
}

/* A pipe that nobody reads holds it up for as long as nobody ends it. */
static pid_t unread;

static void begin_unread(void)
{
    assert_int_equal(mkfifo("unread.fold", 0600), 0);
    unread = start(&(around){.err = "unread"}, ARGS("fold", "in.opx", "-q", "--max-seconds", "1", "-o", "unread.fold"));
}

static void output_that_nobody_reads(void **state)
{
    (void)state;
    assert_int_equal(mkfifo("other.fold", 0600), 0);
    const pid_t pid = start(&(around){0}, ARGS("fold", "in.opx", "-q", "-o", "first.csv", "-o", "other.fold"));
    while (!is_there("first.csv") && waitpid(pid, NULL, WNOHANG) == 0) pause_a_moment();
    assert_int_equal(kill(pid, SIGTERM), 0);
    assert_int_equal(finish(pid), 1);
    says("interrupted", "stderr");
    /* That one began long ago. */
    assert_int_equal(finish(unread), 1);
    says("not done within 1 seconds: unread.fold is not written", "unread");
}

/* ----------------------------------------------------------------------------------------------- folders ---- */

static void a_folder_that_goes_away(void **state)
{
    (void)state;
    const pid_t pid =
        start(&(around){0}, ARGS("fold", "in.opx", "-q", "--frames", "500", "--size", "200x150", "-o", "away/"));
    while (access("away/0003.png", F_OK) != 0 && waitpid(pid, NULL, WNOHANG) == 0) pause_a_moment();
    assert_int_equal(rename("away", "gone"), 0);
    assert_int_equal(finish(pid), 3);
    says("No such file or directory", "stderr");
    assert_int_not_equal(access("away", F_OK), 0);
}

/* Several at the same work: each ends well, and each file is one of theirs. */
static void others_at_the_same_work(void **state)
{
    (void)state;
    enum { OTHERS = 6 };
    pid_t pid[OTHERS];
    for (int k = 0; k < OTHERS; k++)
        pid[k] = start(&(around){0}, ARGS("fold", "in.opx", "-q", "--frames", k % 2 ? "3" : "4", "-o", "same.fold",
                                          "-o", "same.stl", "--report", "same.json"));
    for (int k = 0; k < OTHERS; k++) assert_int_equal(finish(pid[k]), 0);
    assert_int_equal(run(&(around){0}, "verify", "same.fold"), 0);
    const char *text = slurp("same.json");
    assert_int_equal(text[0], '{');
    assert_string_equal(text + strlen(text) - 2, "}\n");
    assert_int_equal(parts_left(), 0);
}

/* --------------------------------------------------------------------------------------------------- all ---- */

static int is_in_folder;

static int begin_all(void **state)
{
    (void)state;
    const char *given = getenv("RIGAMI");
    if (!realpath(given && *given ? given : "./rigami", program)) {
        print_error("no program at %s; RIGAMI names it\n", given ? given : "./rigami");
        return -1;
    }
    if (!mkdtemp(folder) || chdir(folder) != 0) return -1;
    is_in_folder = 1;
    write_file("stderr", "");
    if (run(&(around){0}, "gen", "miura", "4", "-o", "in.opx") != 0) return -1;
    if (run(&(around){0}, "gen", "miura", "12", "-o", "long.opx") != 0) return -1;
    begin_unread();
    return 0;
}

static int end_all(void **state)
{
    (void)state;
    return is_in_folder ? folder_remove(folder) : 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whatever_asks_it_to_end),
        cmocka_unit_test(what_is_ignored_stays_ignored),
        cmocka_unit_test(seconds_of_the_processor_are_over),
        cmocka_unit_test(input_that_does_not_wait),
        cmocka_unit_test(input_without_end),
        cmocka_unit_test(a_folder_that_goes_away),
        cmocka_unit_test(others_at_the_same_work),
        cmocka_unit_test(output_that_nobody_reads),
    };
    return cmocka_run_group_tests(tests, begin_all, end_all);
}
