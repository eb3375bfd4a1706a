/* options.h -- what may stand on the command line: one table that parsing and help are made from.
 * Uses  say.h        Used by  every command */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "rigami.h"
#include <stdio.h>

/* Which commands an option is for. */
enum {
    FOR_FOLD = 1,
    FOR_INFO = 2,
    FOR_CONVERT = 4,
    FOR_GEN = 8,
    FOR_CHART = 16,
    FOR_VERIFY = 32,
    FOR_DRAW = 64,
    FOR_BATCH = 128
};

typedef struct frame_range { int32_t first, last; } frame_range; /* of a FOLD file; last below first: to its last one */

typedef struct aim {
    enum { AIM_DRIVE, AIM_PIN, AIM_FREE } what;
    const char *text;
} aim; /* of one crease, as it was said */

typedef struct options {
    rg_settings settings;
    rg_reading reading;
    rg_picture picture;
    rg_example example; /* of gen */
    double side_unit, cell_unit; /* the units that its lengths were said in, metres; 0: none */
    const char **operand, **output, **kind, **form; /* kind: of --line; form: of --write */
    int operands, outputs;
    frame_range *range; /* of --frame: states in one file; one frame alone is in `settings` too */
    int ranges;
    aim *aim;                                             /* of --drive, --pin, --free */
    int aims;
    int forms, merge, fresh, verify;                      /* of batch */
    int32_t jobs, part, parts;                            /* 0: as many as processors; all of them */
    double limit;                                         /* seconds a file, 0: none */
    double seconds, megabytes;                            /* that the command may take, 0: any */
    double max_roll; /* the farthest that creases may roll, over the sheet's size */
    char *said;                                           /* options that say how to fold and what to write, as given */
    const char *report;                                   /* NULL: none */
    int verbose, quiet, json, progress;                            /* progress: 1 yes, 0 no, -1 on a terminal */
    int help, version;                                    /* asked for: nothing after it was looked at */
    /* places in the lists of names; in `settings` at the end */
    int format, method, solver, triangulate, symmetry, pace, effort, contact;
    int colour, loop;                                     /* the same, of pictures */
    int unit;                                             /* place in a list of names too; in `settings` at the end */
    int as;                                               /* of convert: the output's format, the same */
} options;

/* A command as its user sees it. */
typedef struct command {
    const char *name;
    int bit;              /* FOR_... */
    const char *operands; /* of the usage line */
    int least, most;      /* how many operands */
    const char *summary;
    const char *notes;    /* what the help says after the options */
    int (*run)(const options *o);
} command;

/* Parses argv[1] ... argv[argc - 1] after the command's name argv[0]. Returns an exit status; what is wrong has been
 * said. Strings are borrowed from argv. Call options_free in any case. */
int options_parse(options *o, const command *c, int argc, char **argv);
void options_free(options *o);
/* A line each: the options of a command, or the values that one of them takes; returns how many. For completion in
 * shells. */
int options_words(int bit, const char *option, FILE *out);
void options_help(const command *c, FILE *out);

#endif
