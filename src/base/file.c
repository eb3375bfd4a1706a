/* fopencookie() is GNU's, funopen() that of BSD and macOS: streams that end in a function. */
#define _GNU_SOURCE
#include "base/file.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { TEMPORARY_NAMES = 1000 };

static rg_status fail(rg_diag *why, const char *path)
{
    return rg_fail(RG_EWRITE, why, 0, "%s: %s", path, strerror(errno));
}

/* A new file beside the target, so that renaming stays within one file system; open() applies the user's mask. */
static rg_status open_temporary(rg_file *f, rg_diag *why)
{
    const size_t room = strlen(f->path) + 40;
    f->temporary = rg_mem_array(&f->mem, room, 1);
    if (!f->temporary) return RG_ENOMEM;
    int fd = -1;
    for (int n = 0; fd < 0 && n < TEMPORARY_NAMES; n++) {
        snprintf(f->temporary, room, "%s.%ld-%d.part", f->path, (long)getpid(), n);
        fd = open(f->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST) break;
    }
    rg_status s = RG_OK;
    if (fd < 0) s = fail(why, f->path);
    else if (!(f->stream = fdopen(fd, "wb"))) {
        s = fail(why, f->path);
        close(fd);
        unlink(f->temporary);
    }
    if (s != RG_OK) {
        rg_mem_free(&f->mem, f->temporary);
        f->temporary = NULL;
    }
    return s;
}

rg_status rg_file_begin(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why)
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
        s = open_temporary(f, why);
    }
    if (s == RG_ENOMEM) rg_fail(s, why, 0, "out of memory");
    if (s != RG_OK) rg_file_abandon(f);
    return s;
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
    else if (f->sink.write(f->sink.ctx, f->pile->byte, f->pile->count) != 0) s = rg_fail(RG_EWRITE, why, 0, "the output is not taken");
    rg_file_abandon(f);
    return s;
}

rg_status rg_file_begin_to(rg_file *f, const rg_memory *mem, const rg_dest *to, rg_diag *why)
{
    return to->path ? rg_file_begin(f, mem, to->path, why) : begin_sink(f, mem, to->sink, why);
}

/* Where an earlier write failed, its reason is lost by now; one byte more fails for the same. The file is spoilt anyway. */
static rg_status fail_again(rg_file *f, rg_diag *why, const char *path)
{
    if (errno == 0 && fputc('\n', f->stream) != EOF) fflush(f->stream);
    if (errno != 0) return fail(why, path);
    return rg_fail(RG_EWRITE, why, 0, "%s: not all of it could be written", path);
}

rg_status rg_file_commit(rg_file *f, rg_diag *why)
{
    if (f->pile) return commit_sink(f, why);
    const char *path = f->path ? f->path : "standard output";
    rg_status s = RG_OK;
    errno = 0;
    if (fflush(f->stream) != 0 || ferror(f->stream)) s = fail_again(f, why, path);
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
