#include "render/piled.h"
#include "render/raster.h"

#include <math.h>
#include <string.h>

typedef struct pile {
    const rg_layers *layers;
    const rg_seen *seen;
    const rg_samples *tile;
    int from_above; /* the side that the order is told from is the one that is seen */
} pile;

/* Of a facet's plane at a sample: planes stay planes in pictures. */
static double depth(const rg_seen *s, int32_t f, double x, double y)
{
    const int32_t first = s->mesh->facet_start[f], last = s->mesh->facet_start[f + 1];
    const rg_gl_vertex *o = &s->corner[first];
    rg_vec3 n = {0, 0, 0};
    for (int32_t j = first + 1; j + 1 < last; j++) {
        const rg_gl_vertex *a = &s->corner[j], *b = &s->corner[j + 1];
        n = rg_vec3_add(n, rg_vec3_cross((rg_vec3){(double)a->x - o->x, (double)a->y - o->y, (double)a->z - o->z},
                                         (rg_vec3){(double)b->x - o->x, (double)b->y - o->y, (double)b->z - o->z}));
    }
    return n.z != 0 ? o->z - (n.x * (x - o->x) + n.y * (y - o->y)) / n.z : o->z;
}

static void take(void *ctx, uint32_t mark, int32_t row, int32_t first, int32_t last)
{
    const pile *p = ctx;
    uint32_t *at = p->tile->at + (size_t)row * (size_t)p->tile->pitch;
    uint32_t other = 0;
    int above = 0;
    for (int32_t i = first; i < last; i++) {
        if (!at[i]) at[i] = mark;
        if (at[i] == mark) continue;
        if (at[i] != other) {
            other = at[i];
            above = rg_layers_above_of_mesh(p->layers, (int32_t)other - 1, (int32_t)mark - 1);
            if (!p->from_above) above = -above;
        }
        const double x = p->tile->x + i + 0.5, y = p->tile->y + row + 0.5;
        if (above > 0 ||
            (above == 0 && depth(p->seen, (int32_t)mark - 1, x, y) < depth(p->seen, (int32_t)other - 1, x, y)))
            at[i] = mark;
    }
}

void rg_piled_draw(const rg_layers *l, const rg_seen *s, const rg_gl_scene *scene, const rg_samples *tile)
{
    pile p = {l, s, tile, s->front[l->flat.part[l->flat.part_start[l->flat.root]]]};
    for (int32_t row = 0; row < tile->height; row++)
        memset(tile->at + (size_t)row * (size_t)tile->pitch, 0, (size_t)tile->width * sizeof *tile->at);
    rg_raster_cover(scene, tile->x, tile->y, tile->width, tile->height, take, &p);
}
