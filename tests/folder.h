/* folder.h -- a folder that a test made, with all that is in it, taken away. */
#ifndef FOLDER_H
#define FOLDER_H

#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700
#endif
#include <ftw.h>
#include <stdio.h>
#include <unistd.h>

static inline int folder_remove_one(const char *path, const struct stat *is, int kind, struct FTW *at)
{
    (void)is, (void)kind, (void)at;
    return remove(path);
}

/* From within it, too. Zero: it is gone. */
static inline int folder_remove(const char *folder)
{
    return chdir("/") || nftw(folder, folder_remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

#endif
