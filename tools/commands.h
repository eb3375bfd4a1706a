/* commands.h -- the commands: one function each, in tools/cmd_<name>.c; rigami.c lists them.
 * Used by  rigami.c, every command */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "options.h"

/* Each returns an exit status and has said what went wrong. */
int cmd_fold(const options *o);
int cmd_info(const options *o);
int cmd_convert(const options *o);
int cmd_gen(const options *o);
int cmd_chart(const options *o);
int cmd_verify(const options *o);
int cmd_draw(const options *o);
int cmd_batch(const options *o);

/* What cmd_fold does; `seen` (may be NULL) is called at the end with the motion, if there is one, and the exit status.
 */
typedef void (*fold_seen)(void *ctx, const rg_motion *m, int status);
int fold_one(const options *o, fold_seen seen, void *ctx);

#endif
