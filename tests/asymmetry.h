/* asymmetry.h -- how far the frames of a motion are from the symmetries of their pattern, by where creases lie and by fold angles
 * alone: nothing of the library finds the symmetries or applies them.  Include after cmocka.h, near.h and draw.h. */
#ifndef ASYMMETRY_H
#define ASYMMETRY_H

#include "motion/motion.h"

/* Parts of the sheet: a drawing by hand matches its image that well. */
static const double AS_DRAWN = 5e-3;

typedef struct asymmetry {
    int elements, mirrors; /* turns and mirrors that take the drawing to itself, the one by nothing among the turns */
    int kept;              /* of them those that all frames have */
    double most;           /* degrees, of those kept: the largest difference of a crease to its image in any frame */
    double all;            /* of all elements */
} asymmetry;

/* x -> (c -s; s c) x + (dx, dy), after y -> -y if it is a mirror. */
typedef struct isometry { double c, s, dx, dy; int mirror; } isometry;

static inline rg_vec2 isometry_by(const isometry *g, rg_vec2 x)
{
    const double y = g->mirror ? -x.y : x.y;
    return (rg_vec2){g->c * x.x - g->s * y + g->dx, g->s * x.x + g->c * y + g->dy};
}

/* Takes the segment a b onto p q, or near it. */
static inline isometry isometry_onto(rg_vec2 a, rg_vec2 b, rg_vec2 p, rg_vec2 q, int mirror)
{
    const double from = atan2(mirror ? a.y - b.y : b.y - a.y, b.x - a.x), turn = atan2(q.y - p.y, q.x - p.x) - from;
    isometry g = {cos(turn), sin(turn), 0, 0, mirror};
    const rg_vec2 middle = isometry_by(&g, (rg_vec2){(a.x + b.x) / 2, (a.y + b.y) / 2});
    g.dx = (p.x + q.x) / 2 - middle.x, g.dy = (p.y + q.y) / 2 - middle.y;
    return g;
}

/* The edge of that assignment whose ends are nearest to the image of edge e; -1: none is near. */
static inline int32_t edge_there(const rg_mesh *m, const isometry *g, int32_t e)
{
    const rg_vec2 a = isometry_by(g, m->X[m->edge[e][0]]), b = isometry_by(g, m->X[m->edge[e][1]]);
    double nearest = AS_DRAWN * m->size;
    int32_t found = -1;
    for (int32_t f = 0; f < m->ne; f++) {
        if (m->assignment[f] != m->assignment[e]) continue;
        const rg_vec2 p = m->X[m->edge[f][0]], q = m->X[m->edge[f][1]];
        const double one = fmax(hypot(p.x - a.x, p.y - a.y), hypot(q.x - b.x, q.y - b.y));
        const double other = fmax(hypot(p.x - b.x, p.y - b.y), hypot(q.x - a.x, q.y - a.y));
        if (fmin(one, other) < nearest) nearest = fmin(one, other), found = f;
    }
    return found;
}

/* Degrees; negative: the drawing has no such symmetry. An added crease that has no image is asymmetric by all it bends. */
static inline double asymmetry_of(const rg_motion *m, const isometry *g)
{
    const rg_mesh *mesh = &m->mesh;
    double most = 0;
    for (int32_t e = 0; e < mesh->ne; e++) {
        const int32_t to = edge_there(mesh, g, e), i = mesh->edge_crease[e];
        if (to < 0 && e < mesh->ne - mesh->added) return -1;
        for (int32_t k = 0; i >= 0 && k < rg_motion_report(m)->frame_count; k++) {
            const double *rho = rg_motion_angles(m, k), off = fabs(rho[i] - (to < 0 ? 0 : rho[mesh->edge_crease[to]]));
            if (!(off <= most)) most = off;
        }
    }
    return most / RG_DEG;
}

/* Every symmetry takes the longest edge to one as long. */
static inline asymmetry asymmetry_measured(const rg_motion *m, double limit)
{
    const rg_mesh *mesh = &m->mesh;
    asymmetry a = {0};
    int32_t longest = 0;
    double most = 0;
    for (int32_t e = 0; e < mesh->ne - mesh->added; e++) {
        const rg_vec2 p = mesh->X[mesh->edge[e][0]], q = mesh->X[mesh->edge[e][1]];
        if (hypot(p.x - q.x, p.y - q.y) > most * (1 + 1e-9)) most = hypot(p.x - q.x, p.y - q.y), longest = e;
    }
    const rg_vec2 p = mesh->X[mesh->edge[longest][0]], q = mesh->X[mesh->edge[longest][1]];
    for (int32_t e = 0; e < mesh->ne - mesh->added; e++) {
        const rg_vec2 end[2] = {mesh->X[mesh->edge[e][0]], mesh->X[mesh->edge[e][1]]};
        if (fabs(hypot(end[0].x - end[1].x, end[0].y - end[1].y) - most) > AS_DRAWN * mesh->size) continue;
        for (int how = 0; how < 4; how++) {
            const isometry g = isometry_onto(p, q, end[how % 2], end[1 - how % 2], how / 2);
            const double off = asymmetry_of(m, &g);
            if (off < 0) continue;
            a.elements++;
            a.mirrors += how / 2;
            a.all = fmax(a.all, off);
            if (!(off <= limit)) continue;
            a.kept++;
            a.most = fmax(a.most, off);
        }
    }
    return a;
}

#endif
