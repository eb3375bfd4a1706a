/* states.h -- the states that are to be gone through: a pattern a file, or several frames of a FOLD file.
 * Uses  input.h        Used by  cmd_fold.c */
#ifndef STATES_H
#define STATES_H

#include "options.h"

typedef struct states {
    rg_pattern **pattern; /* [count] */
    int *operand;         /* [count] the file that each is of */
    int count;
} states;

/* Returns an exit status; what went wrong has been said. Owner: the caller, states_free, also after a failure. */
int states_read(const options *o, states *s);
void states_free(states *s);

#endif
