#include "write/csv.h"
#include "base/number.h"
#include "render/picture.h"

/* "c0_M 4-5 (0.5 0)-(0.5 1) target -180": which crease it is, without a comma. */
static void column(const rg_motion *m, int32_t i, FILE *out)
{
    char x[4][RG_NUMBER_ROOM];
    rg_crease c;
    rg_motion_crease(m, i, &c);
    fprintf(out, ",c%d_%c %d-%d (%s %s)-(%s %s)", (int)i, c.assignment, (int)c.vertices[0], (int)c.vertices[1],
            rg_number_print(x[0], c.at[0][0]), rg_number_print(x[1], c.at[0][1]), rg_number_print(x[2], c.at[1][0]),
            rg_number_print(x[3], c.at[1][1]));
    if (!isnan(c.target)) fprintf(out, " target %s", rg_number_print(x[0], rg_number_degrees(c.target)));
    if (c.added) fputs(" added", out);
}

rg_status rg_csv_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame;
    const int32_t N = m->mesh.N;
    fputs("frame,percent", out);
    for (int32_t i = 0; i < N; i++) column(m, i, out);
    fputc('\n', out);
    for (int32_t k = 0; k < m->report.frame_count; k++) {
        const double *rho = rg_motion_angles(m, k);
        if (rg_picture_ended(p, (double)k / m->report.frame_count)) return RG_ECANCELLED;
        char text[RG_NUMBER_ROOM];
        fprintf(out, "%d,%s", (int)k, rg_number_print(text, rg_number_tidy(m->frame[k].percent)));
        for (int32_t i = 0; i < N; i++)
            fprintf(out, ",%s", rg_number_print(text, rg_number_tidy(rg_number_degrees(rho[i]))));
        fputc('\n', out);
    }
    return RG_OK;
}
