/* rigami draw -- pictures, films, pages and models of a motion that was written before, without folding. */
#include "commands.h"
#include "places.h"
#include "progress.h"
#include "say.h"
#include "verdict.h"

#include <stdio.h>

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
    status = places_write(o, m, &bar);
    if (status == ENDS_WELL && !o->quiet) {
        verdict_files(o, "  written   ", files, sizeof files);
        printf("%s: %d frames, to %.1f %%\n%s\n", o->operand[0], (int)rg_motion_report(m)->frame_count,
               rg_motion_report(m)->folded_percent, files);
    }
    rg_motion_destroy(m);
    return status;
}
