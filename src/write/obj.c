#include "write/obj.h"
#include "base/number.h"

static int edge_type(char assignment)
{
    return assignment == RG_BORDER ? 0 : assignment == RG_VALLEY ? 2 : assignment == RG_MOUNTAIN ? 3 : 1;
}

static void vertices(const rg_vec3 *x, int32_t n, FILE *out)
{
    char a[RG_NUMBER_ROOM], b[RG_NUMBER_ROOM], c[RG_NUMBER_ROOM];
    for (int32_t v = 0; v < n; v++)
        fprintf(out, "v %s %s %s\n", rg_number_print(a, x[v].x), rg_number_print(b, x[v].y),
                rg_number_print(c, x[v].z));
}

/* Both sides of the paper, a group each, and each facet by its number. */
static void facets(const rg_mesh *m, FILE *out)
{
    for (int back = 0; back < 2; back++)
        for (int32_t f = 0; f < m->nf; f++) {
            const int32_t from = m->facet_start[f], n = m->facet_start[f + 1] - from;
            fprintf(out, "g %s facet%d\nf", back ? "back" : "front", (int)f);
            for (int32_t k = 0; k < n; k++)
                fprintf(out, " %d", (int)m->facet_vertex[from + (back ? n - 1 - k : k)] + 1);
            fputc('\n', out);
        }
}

static void edges(const rg_mesh *m, const double *rho, FILE *out)
{
    for (int32_t e = 0; e < m->ne; e++) {
        const int32_t i = m->edge_crease[e];
        char angle[RG_NUMBER_ROOM];
        fprintf(out, "#e %d %d %d %s\n", (int)m->edge[e][0] + 1, (int)m->edge[e][1] + 1, edge_type(m->assignment[e]),
                rg_number_print(angle, i < 0 ? 0 : rg_number_degrees(rho[i])));
    }
}

rg_status rg_obj_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)p;
    char percent[RG_NUMBER_ROOM];
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    rg_status s = x ? rg_motion_place(m, frame, x) : RG_ENOMEM;
    if (s == RG_OK) {
        fprintf(out, "# rigami %s: frame %d, folded %s percent\n", RG_VERSION, (int)frame,
                rg_number_print(percent, rg_number_tidy(m->frame[frame].percent)));
        fputs("o sheet\n", out);
        vertices(x, m->mesh.nv, out);
        facets(&m->mesh, out);
        edges(&m->mesh, rg_motion_angles(m, frame), out);
    }
    rg_mem_free(&m->mem, x);
    return s;
}
