#include "write/dxffile.h"
#include "save/dxf.h"

rg_status rg_dxffile_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame, (void)p;
    const rg_mesh *mesh = &m->mesh;
    const rg_vec2 *X = rg_motion_pattern(m, m->report.frame_count - 1);
    rg_line *line = rg_mem_array(&m->mem, (size_t)mesh->ne, sizeof *line);
    if (!line) return RG_ENOMEM;
    for (int32_t e = 0; e < mesh->ne; e++)
        line[e] = (rg_line){X[mesh->edge[e][0]], X[mesh->edge[e][1]], NAN,
                            mesh->assignment[e] == RG_CUT ? RG_BORDER : mesh->assignment[e], 0};
    rg_dxf_put(out, line, mesh->ne, m->report.pattern->unit);
    rg_mem_free(&m->mem, line);
    return RG_OK;
}
