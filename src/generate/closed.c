/* Closed vertices (section 3.1) in a ring, each of which waits for the next: the two cures of Fig. 5, one pattern each.
 *
 * At vertex k of a triangle, the side to the next vertex goes straight on behind k, creased alike: these two are c. The
 * side to the vertex before it and its mirror image across c, creased opposite, are a and b: a line folded through both
 * layers. Such a vertex has c folded all the way before a and b can start; as each side is the c of one vertex and the
 * a of another, no vertex can begin. A crease that splits one of its two inside angles, which lie on either side of
 * whichever of a, b is opposite to c, frees a vertex; one anywhere else does not. Both theorems hold at all three. */
#include "generate/kinds.h"

typedef struct ring {
    rg_vec2 v[3];         /* counter-clockwise */
    rg_vec2 on[3], over[3]; /* directions of c behind the vertex, and of the image of a */
} ring;

static rg_vec2 towards(double angle) { return (rg_vec2){cos(angle), sin(angle)}; }

static rg_vec2 along(rg_vec2 a, rg_vec2 u, double t) { return (rg_vec2){a.x + t * u.x, a.y + t * u.y}; }

static ring ring_of(const rg_vec2 v[3])
{
    ring r;
    for (int k = 0; k < 3; k++) {
        const rg_vec2 c = rg_vec2_sub(v[(k + 1) % 3], v[k]), a = rg_vec2_sub(v[(k + 2) % 3], v[k]);
        const double ahead = atan2(c.y, c.x), before = atan2(a.y, a.x);
        r.v[k] = v[k];
        r.on[k] = towards(ahead + RG_PI);
        r.over[k] = towards(2 * ahead - before);
    }
    return r;
}

/* on[k], over[k]: where those creases of vertex k end; side[k]: the assignment of the side after it. */
static void draw_ring(rg_sketch *d, const ring *r, const rg_vec2 on[3], const rg_vec2 over[3], const char side[3])
{
    for (int k = 0; k < 3; k++) {
        rg_drawing_line(d, r->v[k], r->v[(k + 1) % 3], side[k]);
        rg_drawing_line(d, r->v[k], on[k], side[k]);
        rg_drawing_line(d, r->v[k], over[k], rg_opposite(side[(k + 2) % 3]));
    }
}

/* A triangle twist: all sides alike, sectors of 60 and 120 degrees, pleats to the edges at right angles. All six inside
 * angles are corners of facets of four corners, outside the triangle. */
void rg_closed_split_draw(rg_sketch *d)
{
    static const double far = 2; /* edges of the sheet from its centre; corners of the triangle: 1 */
    rg_vec2 v[3], on[3], over[3];
    for (int k = 0; k < 3; k++) v[k] = towards(RG_PI / 2 + 2 * RG_PI / 3 * k);
    const ring r = ring_of(v);
    for (int k = 0; k < 3; k++) {
        on[k] = along(v[k], r.on[k], far - rg_vec2_dot(v[k], r.on[k]));
        over[k] = along(v[k], r.over[k], far - rg_vec2_dot(v[k], r.over[k]));
    }
    draw_ring(d, &r, on, over, (const char[]){RG_MOUNTAIN, RG_MOUNTAIN, RG_MOUNTAIN});
    for (int k = 0; k < 3; k++) {
        const rg_vec2 a = r.on[k], b = r.over[k];
        const rg_vec2 corner = rg_meet(on[k], (rg_vec2){-a.y, a.x}, over[k], (rg_vec2){-b.y, b.x});
        rg_drawing_path(d, (rg_vec2[]){on[k], corner, over[k], on[(k + 1) % 3]}, 4, RG_BORDER);
    }
}

/* A triangle of 90, 30 and 60 degrees, its last side opposite to the others: now the inside angles are two corners of
 * the triangle itself, and corners of facets that are triangles too, because the creases that bound them meet at the
 * sheet's edge. None of them can be split. */
void rg_closed_adjust_draw(rg_sketch *d)
{
    const rg_vec2 v[3] = {{0, 0}, {1, 0}, {0, 1 / sqrt(3)}};
    const ring r = ring_of(v);
    const rg_vec2 left = rg_meet(v[2], r.over[2], v[0], r.on[0]), top = rg_meet(v[1], r.over[1], v[2], r.on[2]);
    const rg_vec2 below = along(v[0], r.over[0], 1), right = along(v[1], r.on[1], 1);
    const rg_vec2 corner = {0.75 * left.x, 0.75 * below.y};
    draw_ring(d, &r, (rg_vec2[]){left, right, top}, (rg_vec2[]){below, top, left},
              (const char[]){RG_MOUNTAIN, RG_MOUNTAIN, RG_VALLEY});
    rg_drawing_path(d, (rg_vec2[]){left, corner, below, right, top, left}, 6, RG_BORDER);
}
