#include "write/csv.h"
#include "base/number.h"

rg_status rg_csv_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame, (void)p;
    const int32_t N = m->mesh.N;
    for (int32_t i = 0; i < N; i++)
        fprintf(out, "%sc%d_%c", i ? "," : "", (int)i, m->mesh.assignment[m->mesh.crease_edge[i]]);
    fputc('\n', out);
    for (int32_t k = 0; k < m->report.frame_count; k++) {
        const double *rho = rg_motion_angles(m, k);
        for (int32_t i = 0; i < N; i++) {
            char text[RG_NUMBER_ROOM];
            if (i) fputc(',', out);
            fputs(rg_number_print(text, rg_number_degrees(rho[i])), out);
        }
        fputc('\n', out);
    }
    return RG_OK;
}
