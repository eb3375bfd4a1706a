/* Folds a crease pattern step by step and prints how it goes: all of rigami that a program of one's own needs.
 *
 *     cc example.c $(pkg-config --cflags --libs rigami) -o example && ./example pattern.opx */
#include <rigami.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    rg_diag why = {0};
    rg_pattern *pattern = NULL;
    rg_fold *fold = NULL;
    int status = 1;
    if (argc != 2) {
        fprintf(stderr, "usage: %s pattern.opx\n", argv[0]);
        return 2;
    }
    if (rg_pattern_read(argv[1], NULL, &pattern, &why) != RG_OK) goto out;
    if (rg_fold_create(pattern, NULL, NULL, NULL, &fold, &why) != RG_OK) goto out;
    for (const rg_step_info *i = rg_fold_get_info(fold);; i = rg_fold_step(fold)) { /* the loop is yours: draw, steer or stop here */
        int32_t creases;
        const double *rho = rg_fold_angles(fold, &creases);
        if (creases > 0)
            printf("%3d %5.1f %%  first crease %+.4f rad  closed to %.1e rad\n", (int)i->frame, 100 * i->progress, rho[0],
                   i->closure);
        if (i->outcome != RG_RUNNING) break;
    }
    status = 0;
out:
    if (status) fprintf(stderr, "%s:%d: %s\n", argv[1], why.line, why.text);
    rg_fold_destroy(fold);
    rg_pattern_destroy(pattern);
    return status;
}
