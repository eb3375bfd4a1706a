/* rigami draw -- pictures, films, pages and models of a motion that was written before, without folding. */
#include "commands.h"
#include "places.h"
#include "progress.h"
#include "say.h"
#include "verdict.h"

#include <stdio.h>
#include <stdlib.h>

int cmd_draw(const options *o)
{
    rg_motion *m = NULL;
    progress bar;
    rg_diag why = {0, ""};
    char files[4096];
    if (!o->outputs) {
        say("draw: -o OUT is missing: what is to be drawn?");
        return ENDS_USAGE;
    }
    int status = places_check(o);
    if (status != ENDS_WELL) return status;
    const rg_status s = rg_motion_read(o->operand[0], &o->reading, &m, &why);
    if (s != RG_OK) return say_no_motion(s, o->operand[0], &why);
    progress_init(&bar, o->quiet && o->progress < 0 ? 0 : o->progress);
    options written = {.output = calloc((size_t)o->outputs + 1, sizeof *written.output)};
    status = written.output ? places_write(o, m, &bar, &written) : say_status(RG_ENOMEM, o->operand[0], &why);
    if (status == ENDS_WELL && !o->quiet) {
        char name[sizeof files];
        verdict_files(&written, "  written   ", files, sizeof files);
        printf("%s: %d frames, to %.1f %%\n%s\n", say_plain(o->operand[0], name, sizeof name),
               (int)rg_motion_report(m)->frame_count, rg_motion_report(m)->folded_percent, files);
    }
    free(written.output);
    rg_motion_destroy(m);
    return status;
}
