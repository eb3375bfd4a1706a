/* A pattern that is in no file: one vertex of a Miura-ori, from arrays; folded without reading or writing anything, and
 * printed half folded, as a model in the form .obj, with positions out of the fold's own memory. Needs the
 * core alone. */
#include <rigami.h>
#include <stdio.h>

int main(void)
{
    /* sectors of 60 and 120 degrees round the vertex in the middle, which has number 4 */
    const double w = 0.8660254037844386;
    const double at[9][2] = {{0, 0}, {w, 0.5}, {2 * w, 0}, {0, 1}, {w, 1.5}, {2 * w, 1}, {0, 2}, {w, 2.5}, {2 * w, 2}};
    const int32_t ends[12][2] = {{0, 1}, {1, 2}, {2, 5}, {5, 8}, {8, 7}, {7, 6}, {6, 3}, {3, 0}, {3, 4}, {4, 5}, {1, 4},
                                 {4, 7}};
    rg_drawing drawing = rg_drawing_default();
    drawing.vertices = 9, drawing.at = at;
    drawing.edges = 12, drawing.ends = ends;
    drawing.assignment = "BBBBBBBB" "MMVM"; /* border, mountain, valley; U and F there are too */
    rg_pattern *pattern = NULL;
    rg_fold *fold = NULL;
    rg_diag why = {0};
    rg_status s = rg_pattern_create(&drawing, NULL, &pattern, &why);
    if (s == RG_OK) s = rg_fold_create(pattern, NULL, NULL, NULL, &fold, &why);
    if (s == RG_OK) s = rg_fold_go_to(fold, 50);
    if (s == RG_OK) {
        int32_t n;
        const double(*x)[3] = rg_fold_positions(fold, &n);
        for (int32_t v = 0; v < n; v++) printf("v %.6f %.6f %.6f\n", x[v][0], x[v][1], x[v][2]);
        const rg_sheet *sheet = rg_motion_get_sheet(rg_fold_motion(fold));
        for (int32_t f = 0; f < sheet->facets; f++) {
            printf("f");
            for (int32_t k = sheet->facet_start[f]; k < sheet->facet_start[f + 1]; k++)
                printf(" %d", (int)sheet->facet_vertex[k] + 1);
            printf("\n");
        }
    }
    if (s != RG_OK) fprintf(stderr, "%s\n", why.text[0] ? why.text : rg_status_text(s));
    rg_fold_destroy(fold);
    rg_pattern_destroy(pattern);
    return s != RG_OK;
}
