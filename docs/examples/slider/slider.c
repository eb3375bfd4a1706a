/* A slider that drives one crease to and fro, at sixty pictures a second: each tick the crease is sent to where the
 * slider is, from wherever the sheet is. What was passed is forgotten, so that it may go on for hours. Prints what a
 * tick takes. Needs the core alone. */
#include "../miura.h"
#include <math.h>
#include <stdio.h>
#include <time.h>

static double milliseconds(void) { return 1000.0 * (double)clock() / CLOCKS_PER_SEC; }

int main(void)
{
    enum { TICKS = 240 }; /* four seconds */
    static miura arrays;
    const double degree = acos(-1) / 180;
    rg_pattern *pattern = NULL;
    rg_fold *fold = NULL;
    rg_diag why = {0};
    rg_settings settings = rg_settings_default();
    settings.frames = 2; /* where it is and where it is to be: nothing between */
    const rg_drawing drawing = miura_draw(&arrays, 8);
    rg_status s = rg_pattern_create(&drawing, NULL, &pattern, &why);
    if (s == RG_OK) s = rg_fold_create_flat(pattern, &settings, &fold, &why);
    double longest = 0, off = 0;
    for (int tick = 0; s == RG_OK && tick < TICKS; tick++) {
        const int32_t crease = 0;
        const double slider = (40 + 35 * sin(0.05 * tick)) * degree, from = milliseconds();
        s = rg_fold_drive(fold, 1, &crease, &slider);
        while (s == RG_OK && rg_fold_step(fold)->outcome == RG_RUNNING) continue;
        const rg_step_info *i = rg_fold_get_info(fold);
        /* where it cannot follow it stays: i->reason */
        off = fmax(off, fabs(rg_fold_angles(fold, NULL)[crease] - slider));
        if (s == RG_OK && tick % 40 == 0)
            printf("tick %3d  slider %5.1f  %s, closed to %.0e rad\n", tick, slider / degree,
                   i->outcome == RG_FOLDED ? "there" : i->reason, i->closure);
        /* here the viewer takes rg_fold_positions(fold, NULL) */
        if (s == RG_OK) s = rg_fold_forget(fold);
        longest = fmax(longest, milliseconds() - from);
    }
    if (s == RG_OK)
        printf("%d ticks, off by %.0e degrees at most; the longest took %.2f ms of 16.67\n", (int)TICKS, off / degree,
               longest);
    else fprintf(stderr, "%s\n", why.text[0] ? why.text : rg_status_text(s));
    rg_fold_destroy(fold);
    rg_pattern_destroy(pattern);
    return s != RG_OK;
}
