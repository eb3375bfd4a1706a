/* written.h -- a folder for the files that a test writes, and reading them back.  Include after cmocka.h. */
#ifndef WRITTEN_H
#define WRITTEN_H

#include "rigami.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char written_folder[200];

/* For cmocka_run_group_tests. */
static inline int written_begin(void **state)
{
    (void)state;
    const char *where = getenv("TMPDIR");
    snprintf(written_folder, sizeof written_folder, "%.150s/rigami-test-XXXXXX", where && *where ? where : "/tmp");
    return mkdtemp(written_folder) ? 0 : -1;
}

static inline const char *written_path(const char *name, char path[300])
{
    snprintf(path, 300, "%s/%s", written_folder, name);
    return path;
}

/* How many files are there; removes them all if `clear`. */
static inline int written_files(int clear)
{
    DIR *d = opendir(written_folder);
    int n = 0;
    char path[600];
    assert_non_null(d);
    for (struct dirent *e; (e = readdir(d));) {
        if (e->d_name[0] == '.') continue;
        n++;
        snprintf(path, sizeof path, "%s/%s", written_folder, e->d_name);
        if (clear) remove(path);
    }
    closedir(d);
    return n;
}

static inline int written_end(void **state)
{
    (void)state;
    written_files(1);
    return rmdir(written_folder);
}

/* All bytes of a file of the folder and a 0; to be freed. */
static inline char *written_read(const char *name, size_t *size)
{
    char path[300];
    FILE *f = fopen(written_path(name, path), "rb");
    if (!f) fail_msg("%s is not there", name);
    assert_int_equal(fseek(f, 0, SEEK_END), 0);
    const long n = ftell(f);
    char *bytes = calloc((size_t)n + 1, 1);
    assert_non_null(bytes);
    rewind(f);
    assert_int_equal(fread(bytes, 1, (size_t)n, f), n);
    fclose(f);
    if (size) *size = (size_t)n;
    return bytes;
}

#endif
