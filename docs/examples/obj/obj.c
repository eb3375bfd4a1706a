/* Folds a crease pattern and writes the folded sheet as a model: ./obj pattern.opx model.obj */
#include <rigami.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc != 3) return fprintf(stderr, "usage: %s pattern model.obj\n", argv[0]), 2;
    rg_pattern *pattern = NULL;
    rg_motion *motion = NULL;
    rg_diag why = {0};
    rg_status s = rg_pattern_read(argv[1], NULL, &pattern, &why); /* NULL: everything at its default */
    if (s == RG_OK) s = rg_motion_create(pattern, NULL, NULL, NULL, &motion, &why);
    if (s == RG_OK) s = rg_motion_write(motion, argv[2], NULL, &why); /* .stl, .glb, .gif, ... by the extension */
    if (s == RG_OK) {
        const rg_report *r = rg_motion_report(motion);
        printf("%.1f %% folded in %d frames, closed to %.0e rad\n", r->folded_percent, (int)r->frame_count,
               r->max_closure_residual);
        /* no error: the model is what was reached */
        if (r->outcome == RG_STOPPED) printf("short of its end: %s\n", r->reason);
    } else
        fprintf(stderr, "%s:%d: %s\n", argv[1], why.line, why.text);
    rg_motion_destroy(motion);
    rg_pattern_destroy(pattern);
    return s != RG_OK;
}
