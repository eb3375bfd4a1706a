#include "write/stl.h"
#include "base/bytes.h"
#include "mesh/triangles.h"
#include "write/solid.h"

/* STL has no units; whoever prints it takes them for millimetres. */
static const double METRE = 1000;

static unsigned char *vector(unsigned char *to, rg_vec3 v)
{
    return rg_bytes_f32(rg_bytes_f32(rg_bytes_f32(to, v.x), v.y), v.z);
}

static void triangle(rg_vec3 a, rg_vec3 b, rg_vec3 c, FILE *out)
{
    unsigned char bytes[50];
    const rg_vec3 n = rg_vec3_cross(rg_vec3_sub(b, a), rg_vec3_sub(c, a));
    const double length = rg_vec3_length(n);
    unsigned char *at = vector(bytes, length > 0 ? rg_vec3_scale(1 / length, n) : n);
    at = vector(vector(vector(at, a), b), c);
    rg_bytes_u16(at, 0);
    fwrite(bytes, 1, sizeof bytes, out);
}

static void count(void *ctx, const rg_vec3 corner[3])
{
    (void)corner;
    ++*(uint32_t *)ctx;
}

static void write_triangle(void *ctx, const rg_vec3 corner[3]) { triangle(corner[0], corner[1], corner[2], ctx); }

/* Never "solid": that is how the text form of STL begins. */
static void head(uint32_t triangles, FILE *out)
{
    unsigned char bytes[84] = "rigami " RG_VERSION;
    rg_bytes_u32(bytes + 80, triangles);
    fwrite(bytes, 1, sizeof bytes, out);
}

static rg_status thick(const rg_motion *m, const rg_triangles *t, const rg_vec3 *x, double thickness, FILE *out)
{
    uint32_t n = 0;
    rg_status s = rg_solid_make(&m->mem, &m->mesh, t, x, thickness, count, &n);
    if (s != RG_OK) return s;
    head(n, out);
    return rg_solid_make(&m->mem, &m->mesh, t, x, thickness, write_triangle, out);
}

static void thin(const rg_motion *m, const rg_triangles *t, const rg_vec3 *x, FILE *out)
{
    const int32_t n = t->start[m->mesh.nf];
    head((uint32_t)n, out);
    for (int32_t i = 0; i < n; i++) triangle(x[t->v[i][0]], x[t->v[i][1]], x[t->v[i][2]], out);
}

rg_status rg_stl_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    rg_triangles t;
    rg_status s = rg_triangles_init(&m->mem, &m->mesh, &t);
    if (s != RG_OK) return s;
    const double scale = m->report.pattern->unit > 0 ? METRE * m->report.pattern->unit : 1;
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    s = x ? rg_motion_place_centred(m, frame, x) : RG_ENOMEM;
    for (int32_t v = 0; s == RG_OK && v < m->mesh.nv; v++) x[v] = rg_vec3_scale(scale, x[v]);
    if (s == RG_OK && p->thickness > 0) s = thick(m, &t, x, scale * p->thickness, out);
    else if (s == RG_OK) thin(m, &t, x, out);
    rg_mem_free(&m->mem, x);
    rg_triangles_free(&t);
    return s;
}
