/* O_TMPFILE, flock; fopencookie() is GNU's, funopen() that of BSD and macOS: streams that end in a function. */
#define _GNU_SOURCE
#include "base/file.h"
#include "base/status.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { TEMPORARY_NAMES = 1000 };
/* Bytes of a name that its temporary one begins with: most file systems take 255, and what is added is less than 40. */
enum { MOST_OF_NAME = 215 };

static rg_status fail(rg_diag *why, const char *path)
{
    return rg_fail(RG_EWRITE, why, 0, "%s: %s", path, strerror(errno));
}

/* The folder of a path, with the slash behind it; its length, 0: the one that we are in. */
static size_t folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* 0: the name is too long. */
static int folder_name(const char *path, char folder[PATH_MAX])
{
    const size_t n = folder_of(path);
    if (n + 3 > PATH_MAX) return 0;
    memcpy(folder, path, n);
    strcpy(folder + n, n ? "." : "./");
    return 1;
}

/* ------------------------------------------------------------------------------------------------ begin ---- */

/* Tries names until `make` gets one that nobody has; errno says why it does not. */
static int find_name(rg_file *f, int (*make)(rg_file *f, int fd), int fd)
{
    const size_t whole = strlen(f->path), folder = folder_of(f->path);
    const size_t used = whole - folder > MOST_OF_NAME ? folder + MOST_OF_NAME : whole;
    int made = -1;
    for (int n = 0; made < 0 && n < TEMPORARY_NAMES; n++) {
        snprintf(f->temporary, whole + 40, "%.*s.%ld-%d.part", (int)used, f->path, (long)getpid(), n);
        made = make(f, fd);
        if (made < 0 && errno != EEXIST) break;
    }
    return made;
}

static int create(rg_file *f, int fd)
{
    (void)fd;
    return open(f->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

/* A file without a name is given one by its place among the open ones. */
static int give_name(rg_file *f, int fd)
{
    char open_file[RG_FILE_REACH];
    snprintf(open_file, sizeof open_file, "/proc/self/fd/%d", fd);
    return linkat(AT_FDCWD, open_file, AT_FDCWD, f->temporary, AT_SYMLINK_FOLLOW);
}

static int open_nameless(const rg_file *f)
{
#ifdef O_TMPFILE
    char folder[PATH_MAX];
    if (access("/proc/self/fd", X_OK) != 0 || !folder_name(f->path, folder)) return -1;
    return open(folder, O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
#else
    return (void)f, -1;
#endif
}

/* On the target's file system, so that putting it in its place is one step; open() applies the user's mask. The lock
 * says that somebody is at it: rg_file_sweep. */
static rg_status open_temporary(rg_file *f, int named, rg_diag *why)
{
    rg_status s = RG_OK;
    f->temporary = rg_mem_array(&f->mem, strlen(f->path) + 40, 1);
    if (!f->temporary) return RG_ENOMEM;
    int fd = named ? -1 : open_nameless(f);
    f->nameless = fd >= 0;
    if (fd < 0) fd = find_name(f, create, -1);
    if (fd < 0) {
        s = fail(why, f->path);
    } else {
        flock(fd, LOCK_EX | LOCK_NB);
        f->stream = fdopen(fd, "wb");
        if (!f->stream) {
            s = fail(why, f->path);
            close(fd);
            if (!f->nameless) unlink(f->temporary);
        }
    }
    if (s != RG_OK || f->nameless) {
        rg_mem_free(&f->mem, f->temporary);
        f->temporary = NULL;
    }
    return s;
}

static rg_status begin(rg_file *f, const rg_memory *mem, const char *path, int named, rg_diag *why)
{
    memset(f, 0, sizeof *f);
    f->mem = *mem;
    if (strcmp(path, "-") == 0) {
        f->stream = stdout;
        return RG_OK;
    }
    struct stat is;
    const int there = stat(path, &is) == 0;
    char *target = there ? realpath(path, NULL) : NULL;
    f->path = rg_mem_string(mem, target ? target : path);
    free(target);
    rg_status s = f->path ? RG_OK : RG_ENOMEM;
    if (s == RG_OK && there && !S_ISREG(is.st_mode)) {
        f->stream = fopen(path, "wb");
        if (!f->stream) s = fail(why, path);
    } else if (s == RG_OK) {
        s = open_temporary(f, named, why);
    }
    if (s == RG_ENOMEM) rg_fail(s, why, 0, "out of memory");
    if (s != RG_OK) rg_file_abandon(f);
    return s;
}

rg_status rg_file_begin(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why)
{
    rg_file_sweep(path, "", 0);
    return begin(f, mem, path, 0, why);
}

rg_status rg_file_begin_swept(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why)
{
    return begin(f, mem, path, 0, why);
}

rg_status rg_file_begin_named(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why)
{
    return begin(f, mem, path, 1, why);
}

const char *rg_file_reach(const rg_file *f, char room[RG_FILE_REACH])
{
    if (!f->nameless) return f->temporary ? f->temporary : f->path;
    snprintf(room, RG_FILE_REACH, "/proc/%ld/fd/%d", (long)getpid(), fileno(f->stream));
    return room;
}

/* ------------------------------------------------------------------------------------------------ to a sink ---- */

static int collect(rg_pile_of_bytes *p, const char *bytes, size_t n)
{
    if (!p->failed && rg_mem_grow(&p->mem, (void **)&p->byte, &p->room, p->count + n, 1) != RG_OK) p->failed = 1;
    if (p->failed) return 0;
    memcpy(p->byte + p->count, bytes, n);
    p->count += n;
    return 1;
}

#if defined(__GLIBC__)
static ssize_t take(void *pile, const char *bytes, size_t n) { return collect(pile, bytes, n) ? (ssize_t)n : 0; }

static FILE *open_pile(rg_pile_of_bytes *p) { return fopencookie(p, "wb", (cookie_io_functions_t){.write = take}); }
#else
static int take(void *pile, const char *bytes, int n) { return collect(pile, bytes, (size_t)n) ? n : -1; }

static FILE *open_pile(rg_pile_of_bytes *p) { return funopen(p, NULL, take, NULL, NULL); }
#endif

static rg_status begin_sink(rg_file *f, const rg_memory *mem, const rg_sink *sink, rg_diag *why)
{
    memset(f, 0, sizeof *f);
    f->mem = *mem;
    if (!sink || !sink->write) return rg_fail(RG_EARG, why, 0, "a sink without a function to write");
    f->sink = *sink;
    f->pile = rg_mem_array(mem, 1, sizeof *f->pile);
    if (f->pile) {
        f->pile->mem = *mem;
        f->stream = open_pile(f->pile);
    }
    if (f->stream) return RG_OK;
    rg_file_abandon(f);
    return rg_fail(RG_ENOMEM, why, 0, "out of memory");
}

/* All bytes are there, or some are missing. */
static rg_status commit_sink(rg_file *f, rg_diag *why)
{
    const int bad = fclose(f->stream) != 0 || f->pile->failed;
    rg_status s = RG_OK;
    f->stream = NULL;
    if (bad) s = rg_fail(RG_ENOMEM, why, 0, "out of memory");
    else if (f->sink.write(f->sink.ctx, f->pile->byte, f->pile->count) != 0)
        s = rg_fail(RG_EWRITE, why, 0, "the output is not taken");
    rg_file_abandon(f);
    return s;
}

rg_status rg_file_begin_to(rg_file *f, const rg_memory *mem, const rg_dest *to, rg_diag *why)
{
    return to->path ? rg_file_begin(f, mem, to->path, why) : begin_sink(f, mem, to->sink, why);
}

rg_status rg_file_begin_to_swept(rg_file *f, const rg_memory *mem, const rg_dest *to, rg_diag *why)
{
    return to->path ? rg_file_begin_swept(f, mem, to->path, why) : begin_sink(f, mem, to->sink, why);
}

/* ----------------------------------------------------------------------------------------------- commit ---- */

/* Where an earlier write failed, its reason is lost by now; one byte more fails for the same. The file is spoilt
 * anyway. */
static rg_status fail_again(rg_file *f, rg_diag *why, const char *path)
{
    if (errno == 0 && fputc('\n', f->stream) != EOF) fflush(f->stream);
    if (errno != 0) return fail(why, path);
    return rg_fail(RG_EWRITE, why, 0, "%s: not all of it could be written", path);
}

/* On the disk before it takes the place of anything. Non-zero: it is not, and errno says why; a file system that has no
 * such thing is none the worse. */
static int bring_to_disk(int fd)
{
    if (fsync(fd) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS) return 0;
    return -1;
}

/* That the folder has the new name is of less account than what the file has: no error. */
static void bring_folder_to_disk(const rg_file *f)
{
    char folder[PATH_MAX];
    const int fd = folder_name(f->path, folder) ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (fd < 0) return;
    fsync(fd);
    close(fd);
}

/* Gives a nameless file the target's name where that is free, else one beside it. */
static rg_status name_it(rg_file *f, rg_diag *why)
{
    const int fd = fileno(f->stream);
    f->temporary = rg_mem_array(&f->mem, strlen(f->path) + 40, 1);
    if (!f->temporary) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    strcpy(f->temporary, f->path);
    rg_status s = RG_OK;
    const int is_there = give_name(f, fd) != 0;
    const int beside = is_there && errno == EEXIST && find_name(f, give_name, fd) == 0;
    if (is_there && !beside) s = fail(why, f->path);
    f->nameless = 0;
    if (!beside) {
        rg_mem_free(&f->mem, f->temporary);
        f->temporary = NULL;
    }
    return s;
}

rg_status rg_file_commit(rg_file *f, rg_diag *why)
{
    if (f->pile) return commit_sink(f, why);
    const char *path = f->path ? f->path : "standard output";
    const int is_regular = f->path && (f->nameless || f->temporary);
    rg_status s = RG_OK;
    errno = 0;
    if (fflush(f->stream) != 0 || ferror(f->stream)) s = fail_again(f, why, path);
    if (s == RG_OK && is_regular && bring_to_disk(fileno(f->stream)) != 0) s = fail(why, path);
    if (s == RG_OK && is_regular && f->nameless) s = name_it(f, why);
    const int lock = f->temporary ? dup(fileno(f->stream)) : -1; /* kept until it has its place */
    if (f->stream != stdout && fclose(f->stream) != 0 && s == RG_OK) s = fail(why, path);
    f->stream = NULL;
    if (s == RG_OK && f->temporary) {
        if (rename(f->temporary, f->path) == 0) {
            rg_mem_free(&f->mem, f->temporary);
            f->temporary = NULL;
        } else {
            s = fail(why, path);
        }
    }
    if (lock >= 0) close(lock);
    if (s == RG_OK && is_regular) bring_folder_to_disk(f);
    rg_file_abandon(f);
    return s;
}

void rg_file_abandon(rg_file *f)
{
    if (f->stream && f->stream != stdout) fclose(f->stream);
    if (f->temporary) unlink(f->temporary);
    if (f->mem.resize) {
        rg_mem_free(&f->mem, f->temporary);
        rg_mem_free(&f->mem, f->path);
        if (f->pile) rg_mem_free(&f->mem, f->pile->byte);
        rg_mem_free(&f->mem, f->pile);
    }
    memset(f, 0, sizeof *f);
}

/* ------------------------------------------------------------------------------------------------ sweep ---- */

static size_t digits(const char *s) { return strspn(s, "0123456789"); }

/* name[used] is START NUMBER END, or the beginning of that if it is as long as that can be. */
static int is_of(const char *name, size_t used, const char *start, const char *end)
{
    const int cut = used == MOST_OF_NAME;
    const size_t n = strlen(start);
    if (n > used) return cut && memcmp(name, start, used) == 0;
    if (memcmp(name, start, n) != 0) return 0;
    size_t number = digits(name + n);
    if (number > used - n) number = used - n; /* what follows is a number too */
    const size_t rest = used - n - number;
    return (cut ? rest <= strlen(end) : rest == strlen(end)) && memcmp(name + n + number, end, rest) == 0;
}

/* START NUMBER END.PID-N.part: the PID, 0: it is no such name. */
static long whose(const char *name, const char *start, const char *end)
{
    static const char last[] = ".part";
    size_t at = strlen(name), from;
    if (at < sizeof last || strcmp(name + at - (sizeof last - 1), last) != 0) return 0;
    at -= sizeof last - 1;
    for (from = at; from > 0 && name[from - 1] >= '0' && name[from - 1] <= '9';) from--;
    if (from == at || from == 0 || name[from - 1] != '-') return 0;
    at = --from;
    while (from > 0 && name[from - 1] >= '0' && name[from - 1] <= '9') from--;
    if (from == at || at - from >= 19 || from == 0 || name[from - 1] != '.') return 0;
    return is_of(name, from - 1, start, end) ? strtol(name + from, NULL, 10) : 0;
}

/* Who writes it holds a lock on it, and has none on it any more when it is dead. */
static int is_left(int folder, const char *name)
{
    const int fd = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    struct stat is;
    const int left = fd >= 0 && fstat(fd, &is) == 0 && S_ISREG(is.st_mode) && is.st_uid == geteuid() &&
        flock(fd, LOCK_EX | LOCK_NB) == 0;
    if (fd >= 0) close(fd);
    return left;
}

void rg_file_sweep(const char *start, const char *end, int mine)
{
    char folder[PATH_MAX];
    const size_t n = folder_of(start);
    if (n + 2 > sizeof folder) return;
    memcpy(folder, start, n);
    strcpy(folder + n, n ? "" : "./");
    DIR *d = opendir(folder);
    if (!d) return;
    for (const struct dirent *e; (e = readdir(d));) {
        const long pid = whose(e->d_name, start + n, end);
        if (pid > 0 && (mine ? pid == (long)getpid() : is_left(dirfd(d), e->d_name))) unlinkat(dirfd(d), e->d_name, 0);
    }
    closedir(d);
}
