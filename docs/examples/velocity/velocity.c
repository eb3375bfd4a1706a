/* Half-folds a Miura-ori, wishes that a single crease turned, and projects that wish onto what the facets allow,
 * eq. (9): the other creases turn with it. Also says how many ways there are to go. Needs the core alone. */
#include "../miura.h"
#include <math.h>
#include <stdio.h>

int main(void)
{
    static miura arrays;
    rg_pattern *pattern = NULL;
    rg_fold *fold = NULL;
    rg_tangent *tangent = NULL;
    double *wish = NULL;
    rg_diag why = {0};
    const rg_drawing drawing = miura_draw(&arrays, 4);
    rg_status s = rg_pattern_create(&drawing, NULL, &pattern, &why);
    if (s == RG_OK) s = rg_fold_create(pattern, NULL, NULL, NULL, &fold, &why);
    if (s == RG_OK) s = rg_fold_go_to(fold, 50);
    if (s == RG_OK) s = rg_fold_tangent(fold, &tangent);
    if (s == RG_OK) {
        const rg_tangent_info *C = rg_tangent_get_info(tangent);
        int32_t freedoms;
        wish = calloc((size_t)C->columns, sizeof *wish);
        s = wish ? rg_tangent_basis(tangent, &freedoms, NULL) : RG_ENOMEM;
        if (s == RG_OK) {
            wish[0] = 1;
            s = rg_tangent_project(tangent, wish, wish, NULL);
        }
        double off = 0; /* C drho, which is to vanish */
        for (int32_t row = 0; s == RG_OK && row < C->rows; row++) {
            double sum = 0;
            for (int32_t k = C->row_start[row]; k < C->row_start[row + 1]; k++) sum += C->value[k] * wish[C->column[k]];
            off = fmax(off, fabs(sum));
        }
        if (s == RG_OK) printf("%d creases, %d ways to go; C drho is 0 to %.0e\n", (int)C->columns, (int)freedoms, off);
        for (int32_t i = 0; s == RG_OK && i < C->columns; i++) printf("crease %2d  %+.6f\n", (int)i, wish[i]);
    }
    if (s != RG_OK) fprintf(stderr, "%s\n", why.text[0] ? why.text : rg_status_text(s));
    free(wish);
    rg_tangent_destroy(tangent);
    rg_fold_destroy(fold);
    rg_pattern_destroy(pattern);
    return s != RG_OK;
}
