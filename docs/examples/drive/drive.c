/* Drives one crease of a Miura-ori from 0 to 60 degrees; the others follow by the least motion that the facets allow.
 * At every vertex the half angles keep a ratio of tangents, cos(60 degrees), which is printed beside. Needs the core
 * alone. */
#include "../miura.h"
#include <math.h>
#include <stdio.h>

int main(void)
{
    static miura arrays;
    const int n = 8, v = 3 * (n + 1) + 3; /* a vertex inside, from which a straight piece and a piece of a zigzag go */
    const double degree = acos(-1) / 180;
    rg_pattern *pattern = NULL;
    rg_fold *fold = NULL;
    rg_diag why = {0};
    rg_settings settings = rg_settings_default();
    settings.frames = 13; /* every five degrees */
    const rg_drawing drawing = miura_draw(&arrays, n);
    rg_status s = rg_pattern_create(&drawing, NULL, &pattern, &why);
    if (s == RG_OK) s = rg_fold_create_flat(pattern, &settings, &fold, &why);
    if (s == RG_OK) {
        const rg_motion *sheet = rg_fold_motion(fold);
        const int32_t straight = rg_motion_crease_between(sheet, v, v + n + 1),
            zigzag = rg_motion_crease_between(sheet, v, v + 1);
        const double target = -60 * degree; /* zigzag 3 is a mountain */
        s = rg_fold_drive(fold, 1, &zigzag, &target);
        for (const rg_step_info *i = rg_fold_get_info(fold); s == RG_OK; i = rg_fold_step(fold)) {
            const double *rho = rg_fold_angles(fold, NULL);
            printf("driven %6.1f   straight %8.4f   ratio %.12f\n", rho[zigzag] / degree, rho[straight] / degree,
                   fabs(tan(rho[straight] / 2) / tan(rho[zigzag] / 2)));
            if (i->outcome != RG_RUNNING) break;
        }
    }
    if (s != RG_OK) fprintf(stderr, "%s\n", why.text[0] ? why.text : rg_status_text(s));
    rg_fold_destroy(fold);
    rg_pattern_destroy(pattern);
    return s != RG_OK;
}
