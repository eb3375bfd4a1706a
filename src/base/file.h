/* file.h -- output that appears whole or not at all: in a file, or in a caller's hands.
 * Used by  save, generate, write */
#ifndef RG_FILE_H
#define RG_FILE_H

#include "base/memory.h"
#include <stdio.h>

/* Where output goes: to a file, "-" for standard output, or to a sink. */
typedef struct rg_dest {
    const char *path;    /* NULL: to the sink */
    const rg_sink *sink;
} rg_dest;

/* Bytes on their way to a sink, which gets them when all are there. */
typedef struct rg_pile_of_bytes {
    rg_memory mem;
    unsigned char *byte;
    size_t count, room;
    int failed;       /* non-zero: memory is short */
} rg_pile_of_bytes;

typedef struct rg_file {
    rg_memory mem;
    FILE *stream;     /* write here; buffered, binary */
    rg_sink sink;     /* write NULL: a file */
    rg_pile_of_bytes *pile; /* owned; for the sink */
    /* temporary NULL: it has no name yet, or it is written in place (standard output, a device, a pipe) */
    char *path, *temporary;
    int nameless;     /* non-zero: of a regular file that gets its name when all of it is there */
} rg_file;

/* Opens a file beside `path` to write into; "-" is standard output. What is no regular file is written in place, a
 * symbolic link is followed. Where the file system can, the file has no name before it is committed, so that nothing is
 * left of it whatever ends the program; elsewhere it is called PATH.PID-N.part, and those that were left are swept away
 * before. RG_EWRITE: why->text says what and why, why->line is 0; RG_ENOMEM. */
rg_status rg_file_begin(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why);
/* The same for any destination. What a sink gets is collected in the caller's memory. */
rg_status rg_file_begin_to(rg_file *f, const rg_memory *mem, const rg_dest *to, rg_diag *why);
/* The same of one file of many, where sweeping is the caller's. */
rg_status rg_file_begin_swept(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why);
rg_status rg_file_begin_to_swept(rg_file *f, const rg_memory *mem, const rg_dest *to, rg_diag *why);
/* The same, with a name from the beginning, as where the file system can do no better. */
rg_status rg_file_begin_named(rg_file *f, const rg_memory *mem, const char *path, rg_diag *why);
/* Brings it to the disk, and puts it in the place of `path`. RG_EWRITE: something could not be written, now or before;
 * `path` is as it was. */
rg_status rg_file_commit(rg_file *f, rg_diag *why);
/* Throws it away; harmless after commit and on a zeroed struct. */
void rg_file_abandon(rg_file *f);

/* A path by which another program may write into it while this one has it open. */
enum { RG_FILE_REACH = 64 };
const char *rg_file_reach(const rg_file *f, char room[RG_FILE_REACH]);

/* Removes the temporary files that a program which was killed has left: beside START NUMBER END, whatever the number,
 * or none. Only files of this user, and only what no living process holds. `mine` non-zero: those of this process
 * instead, which is to end. */
void rg_file_sweep(const char *start, const char *end, int mine);

#endif
