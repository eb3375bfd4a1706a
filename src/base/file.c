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

/* Where an earlier write failed, its reason is lost by now; one byte more fails for the same. The file is spoilt anyway. */
static rg_status fail_again(rg_file *f, rg_diag *why, const char *path)
{
    if (errno == 0 && fputc('\n', f->stream) != EOF) fflush(f->stream);
    if (errno != 0) return fail(why, path);
    return rg_fail(RG_EWRITE, why, 0, "%s: not all of it could be written", path);
}

rg_status rg_file_commit(rg_file *f, rg_diag *why)
{
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
    }
    memset(f, 0, sizeof *f);
}
