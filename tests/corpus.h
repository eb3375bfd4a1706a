/* corpus.h -- real crease patterns of many authors, which are read where they lie and are not part of this project. */
#ifndef CORPUS_H
#define CORPUS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Writes the path of a file of the corpus, "" for its folder; skips the test, aloud, where there is none. */
static inline const char *corpus(const char *name, char *path, size_t room)
{
    const char *folder = getenv("RIGAMI_CORPUS");
    if (!folder || !*folder) folder = "../shared/corpus";
    snprintf(path, room, "%s/stats.tsv", folder);
    FILE *f = fopen(path, "r");
    if (!f) {
        printf("SKIPPED: no corpus of real patterns at %s (RIGAMI_CORPUS names another place)\n", folder);
        skip();
    }
    fclose(f);
    snprintf(path, room, "%s/%s", folder, name);
    return path;
}

#endif
