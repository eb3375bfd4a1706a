#include "write/stl.h"
#include "base/bytes.h"
#include "render/triangles.h"

static unsigned char *vector(unsigned char *to, rg_vec3 v)
{
    return rg_bytes_f32(rg_bytes_f32(rg_bytes_f32(to, v.x), v.y), v.z);
}

static void triangle(rg_vec3 a, rg_vec3 b, rg_vec3 c, FILE *out)
{
    unsigned char bytes[50];
    const rg_vec3 n = rg_vec3_cross(rg_vec3_sub(b, a), rg_vec3_sub(c, a));
    unsigned char *at = vector(bytes, rg_vec3_scale(1 / rg_vec3_length(n), n));
    at = vector(vector(vector(at, a), b), c);
    rg_bytes_u16(at, 0);
    fwrite(bytes, 1, sizeof bytes, out);
}

rg_status rg_stl_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)p;
    rg_triangles t;
    rg_status s = rg_triangles_init(&m->mem, &m->mesh, &t);
    if (s != RG_OK) return s;
    rg_vec3 *x = rg_mem_array(&m->mem, (size_t)m->mesh.nv, sizeof *x);
    s = x ? rg_motion_place_centred(m, frame, x) : RG_ENOMEM;
    if (s == RG_OK) {
        /* Never "solid": that is how the text form of STL begins. */
        unsigned char head[84] = "rigami " RG_VERSION;
        const int32_t n = t.start[m->mesh.nf];
        rg_bytes_u32(head + 80, (uint32_t)n);
        fwrite(head, 1, sizeof head, out);
        for (int32_t i = 0; i < n; i++) triangle(x[t.v[i][0]], x[t.v[i][1]], x[t.v[i][2]], out);
    }
    rg_mem_free(&m->mem, x);
    rg_triangles_free(&t);
    return s;
}
