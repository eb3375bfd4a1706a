/* input.h -- a crease pattern by the name the user gave.
 * Uses  options.h say.h        Used by  the commands that read */
#ifndef INPUT_H
#define INPUT_H

#include "options.h"

/* Reads operand `i`, "-" being standard input, and passes the reader's warnings on unless -q. Returns an exit status;
 * what went wrong has been said. Owner: the caller, rg_pattern_destroy. */
int input_read(const options *o, int i, rg_pattern **pattern);

#endif
