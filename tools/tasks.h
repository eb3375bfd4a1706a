/* tasks.h -- what a batch has to do: a file each, or a sheet of one that has several.
 * Uses  options.h        Used by  cmd_batch.c */
#ifndef TASKS_H
#define TASKS_H

#include "options.h"

typedef struct task {
    const char *file; /* borrowed */
    int32_t sheet;    /* 0: the file has one */
    int32_t creases;  /* by which one tells how long it may take; 0: it cannot be read */
    char name[220];   /* of what is written, without folder and ending; no two are alike */
    char key[20];     /* of the file's bytes, the options, the program: what was made by others is made again */
} task;

typedef struct tasks { task *task; int count; } tasks;

/* Those of o->part; all of them with o->merge. Returns an exit status; what went wrong has been said. Owner: the
 * caller, tasks_free. */
int tasks_find(const options *o, tasks *q);
void tasks_free(tasks *q);

#endif
