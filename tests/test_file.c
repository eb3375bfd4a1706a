/* base/file.c: what happens to a file where the system refuses: the disk does not take it, the place cannot be had, the folder is not ours. The
 * reason is told as the system gave it, what was there stays, and nothing is left beside it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"

#include "base/file.h"
#include "folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>

/* In place of the system's, which the library calls: they fail with this number; 0: they do what they are to. */
static int fsync_fails, rename_fails;

int fsync(int fd)
{
    if (!fsync_fails) return fdatasync(fd);
    errno = fsync_fails;
    return -1;
}

int rename(const char *from, const char *to)
{
    if (!rename_fails) return renameat(AT_FDCWD, from, AT_FDCWD, to);
    errno = rename_fails;
    return -1;
}

static char folder[] = "/tmp/rigami-file-XXXXXX";

static void put(const char *path, const char *text)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

static int says(const char *path, const char *text)
{
    char found[100] = "";
    FILE *f = fopen(path, "rb");
    if (!f) return text == NULL;
    const size_t n = fread(found, 1, sizeof found - 1, f);
    fclose(f);
    return text && n == strlen(text) && strcmp(found, text) == 0;
}

static int files_here(void)
{
    int n = 0;
    DIR *d = opendir(".");
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) n += e->d_name[0] != '.';
    closedir(d);
    return n;
}

/* Writes "new" to `path`; `named`: with a name from the beginning. */
static rg_status write_new(const char *path, int named, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_file f;
    const rg_status s = named ? rg_file_begin_named(&f, &mem, path, why) : rg_file_begin(&f, &mem, path, why);
    if (s != RG_OK) return s;
    fputs("new", f.stream);
    return rg_file_commit(&f, why);
}

/* Refused with the reason, in place of a file and of none, with a name from the beginning and without. */
static void is_refused(int *call, int number)
{
    for (int named = 0; named < 2; named++)
        for (int there = 0; there < 2; there++) {
            rg_diag why = {7, ""};
            unlink("x.csv");
            if (there) put("x.csv", "old");
            *call = number;
            const rg_status s = write_new("x.csv", named, &why);
            *call = 0;
            if (call == &rename_fails && !named && !there && s == RG_OK) continue; /* it got its name without */
            assert_int_equal(s, RG_EWRITE);
            assert_non_null(strstr(why.text, "x.csv: "));
            assert_non_null(strstr(why.text, strerror(number)));
            assert_int_equal(why.line, 0);
            assert_true(says("x.csv", there ? "old" : NULL));
            assert_int_equal(files_here(), there);
        }
    unlink("x.csv");
}

static void a_disk_that_does_not_take_it(void **state)
{
    (void)state;
    static const int numbers[] = {EIO, ENOSPC, EDQUOT, EROFS};
    for (int k = 0; k < 4; k++) is_refused(&fsync_fails, numbers[k]);
}

/* File systems that have no such thing, as some that go over a net, are none the worse. */
static void a_disk_that_cannot_be_asked(void **state)
{
    (void)state;
    static const int numbers[] = {EINVAL, ENOTSUP, ENOSYS};
    for (int k = 0; k < 6; k++) {
        rg_diag why = {0, ""};
        put("x.csv", "old");
        fsync_fails = numbers[k / 2];
        const rg_status s = write_new("x.csv", k % 2, &why);
        fsync_fails = 0;
        assert_int_equal(s, RG_OK);
        assert_true(says("x.csv", "new"));
        assert_int_equal(files_here(), 1);
    }
    unlink("x.csv");
}

static void a_place_that_cannot_be_had(void **state)
{
    (void)state;
    static const int numbers[] = {EACCES, EROFS, EISDIR};
    for (int k = 0; k < 3; k++) is_refused(&rename_fails, numbers[k]);
}

/* ------------------------------------------------------------------------------------------------- read-only ---- */

/* Somebody whom a folder's mode keeps out: root is not. Its exit status says what is wrong, 0: nothing. */
static int as_somebody(int (*what)(void))
{
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        enum { NOBODY = 65534 };
        if (geteuid() == 0 && (setgid(NOBODY) != 0 || setuid(NOBODY) != 0)) _exit(100);
        _exit(what());
    }
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 101;
}

static int reasons(void)
{
    static const struct { const char *path; int number; } places[] = {
        {"locked/x.csv", EACCES}, {"locked/old.csv", EACCES}, {"locked/d/x.csv", ENOENT}, {"nowhere/x.csv", ENOENT}, {"locked/old.csv/x.csv", ENOTDIR}};
    for (int k = 0; k < 10; k++) {
        rg_diag why = {7, ""};
        const char *path = places[k / 2].path;
        errno = 0;
        if (write_new(path, k % 2, &why) != RG_EWRITE) return 1 + k;
        if (!strstr(why.text, strerror(places[k / 2].number)) || !strstr(why.text, path)) return 20 + k;
        if (!says("locked/old.csv", "old")) return 40 + k;
    }
    return 0;
}

static void a_folder_that_is_not_ours(void **state)
{
    (void)state;
    assert_int_equal(mkdir("locked", 0755), 0);
    put("locked/old.csv", "old");
    assert_int_equal(chmod("locked/old.csv", 0644), 0);
    assert_int_equal(chmod("locked", 0555), 0);
    assert_int_equal(as_somebody(reasons), 0);
    assert_int_equal(chmod("locked", 0755), 0);
    assert_true(says("locked/old.csv", "old"));
    unlink("locked/old.csv");
    assert_int_equal(rmdir("locked"), 0);
    assert_int_equal(files_here(), 0);
}

static char program[PATH_MAX];

/* The program: a file there, a folder of frames there, a folder to be made there. */
static int program_says(void)
{
    static const char *const outputs[] = {"locked/x.csv", "locked/f%03d.obj", "locked/d/"};
    for (int k = 0; k < 3; k++) {
        char command[PATH_MAX + 200], text[500] = "";
        snprintf(command, sizeof command, "'%s' fold in.opx -q --frames 2 -o '%s' 2>&1", program, outputs[k]);
        FILE *f = popen(command, "r");
        if (!f) return 90;
        text[fread(text, 1, sizeof text - 1, f)] = 0;
        const int status = pclose(f);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 3) return 1 + k;
        if (!strstr(text, strerror(EACCES))) return 10 + k;
    }
    return 0;
}

static int can_run(void) { return access(program, X_OK) != 0 || access("in.opx", R_OK) != 0; }

static void a_folder_that_is_not_the_users(void **state)
{
    (void)state;
    char command[PATH_MAX + 60];
    snprintf(command, sizeof command, "'%s' gen miura 2 -q -o in.opx", program);
    assert_int_equal(system(command), 0);
    assert_int_equal(mkdir("locked", 0555), 0);
    const int can = as_somebody(can_run) == 0, wrong = can ? as_somebody(program_says) : 0;
    unlink("in.opx");
    assert_int_equal(rmdir("locked"), 0);
    assert_int_equal(wrong, 0);
    if (can) return;
    print_message("SKIPPED: nobody but its owner may run %s\n", program);
    skip();
}

/* --------------------------------------------------------------------------------------------------------- all ---- */

static int begin_all(void **state)
{
    (void)state;
    const char *given = getenv("RIGAMI");
    if (!realpath(given && *given ? given : "./rigami", program)) {
        print_error("no program at %s; RIGAMI names it\n", given ? given : "./rigami");
        return -1;
    }
    return mkdtemp(folder) && chmod(folder, 0755) == 0 ? chdir(folder) : -1;
}

static int end_all(void **state)
{
    (void)state;
    return folder_remove(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_disk_that_does_not_take_it), cmocka_unit_test(a_disk_that_cannot_be_asked),
                                       cmocka_unit_test(a_place_that_cannot_be_had), cmocka_unit_test(a_folder_that_is_not_ours),
                                       cmocka_unit_test(a_folder_that_is_not_the_users)};
    return cmocka_run_group_tests(tests, begin_all, end_all);
}
