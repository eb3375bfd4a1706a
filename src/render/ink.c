#include "render/ink.h"

/* Half a line, in parts of the picture's shorter side: on a 720 pixel picture each facet shows 1 pixel of its crease.
 */
static const double HALF = 1.0 / 720;
/* No line takes more of a facet than that part of its width as seen, to each side: small facets keep more paper than
 * ink. */
static const double SHARE = 0.06;
/* Below half a sample lines fall apart into dots; then only outlines are drawn. */
static const double LEAST = 0.5;

enum { NO_INK, RIM, MOUNTAIN, VALLEY, UNASSIGNED, EDGE, BEHIND, INKS };
static const unsigned char INK[INKS][3] = {
    [RIM] = {58, 48, 44},  [MOUNTAIN] = {200, 44, 44},  [VALLEY] = {36, 84, 190}, [UNASSIGNED] = {120, 112, 108},
    [EDGE] = {84, 72, 66}, [BEHIND] = {150, 140, 132}};

void rg_ink_colours(uint64_t *colour)
{
    for (int i = 0; i < INKS; i++) colour[i] = rg_samples_colour(INK[i]);
}

/* What the edge at place j of facet f is drawn with. Where two facets turn different sides to the eye, the edge between
 * them is the sheet's outline there: also an added crease is then a line, which otherwise shows by its light alone. */
static uint32_t ink_of(const rg_seen *s, const rg_picture *p, int32_t f, int32_t j)
{
    const rg_mesh *m = s->mesh;
    const int32_t e = m->facet_edge[j], other = m->edge_facet[e][m->edge_facet[e][0] == f];
    const int creases = p->lines == RG_LINES_CREASES;
    switch (m->assignment[e]) {
    case 'M': return creases ? MOUNTAIN : EDGE;
    case 'V': return creases ? VALLEY : EDGE;
    case 'U': return creases ? UNASSIGNED : EDGE;
    case 'F': return other >= 0 && s->front[other] != s->front[f] ? RIM : NO_INK;
    default: return RIM;
    }
}

static void draw_facet(const rg_seen *s, const rg_picture *p, int32_t f, double most, int behind,
                       const rg_samples *tile)
{
    const rg_mesh *m = s->mesh;
    const int32_t first = m->facet_start[f], last = m->facet_start[f + 1];
    const double half = fmin(most, SHARE * s->wide[f]);
    for (int rim = 1; rim >= 0; rim--) /* the rim below the creases that end on it */
        for (int32_t j = first; j < last; j++) {
            const uint32_t ink = ink_of(s, p, f, j);
            if (ink == NO_INK || (ink == RIM) != rim || (!rim && !(half >= LEAST))) continue;
            const rg_gl_vertex *a = &s->corner[j], *b = &s->corner[j + 1 < last ? j + 1 : first];
            const rg_samples_line line = {{a->x, b->x},
                                          {a->y, b->y},
                                          (float)fmax(half, LEAST),
                                          behind ? RG_SAMPLES_ANY : a->mark,
                                          behind ? BEHIND : ink};
            rg_samples_draw(tile, &line);
        }
}

void rg_ink_draw(const rg_seen *s, const rg_picture *p, rg_box here, const rg_samples *tile)
{
    const int32_t shorter = p->width < p->height ? p->width : p->height;
    const double most = RG_SAMPLES_FINE * HALF * shorter * p->line_width;
    for (int behind = p->see_through > 0; behind >= 0; behind--)
        for (int32_t f = 0; f < s->mesh->nf; f++)
            if (rg_box_meet(s->box[f], here)) draw_facet(s, p, f, most, behind, tile);
}
