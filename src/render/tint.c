#include "render/tint.h"
#include "base/text.h"

#include <stdio.h>

/* From blue by green to yellow, ever brighter, so that also who does not tell red from green, and a printer, shows the
 * order. */
static const unsigned char COLOURS[][3] = {{104, 140, 224}, {64, 168, 208}, {72, 190, 160},
                                           {140, 210, 110}, {214, 222, 84}, {255, 240, 150}};
enum { COLOUR_COUNT = sizeof COLOURS / sizeof *COLOURS };
/* What is less than this is rounding: all of it has the first colour. */
static const double NOTHING = 1e-9;

static void colour_at(double part, unsigned char rgb[3])
{
    const double at = fmax(0, fmin(1, part)) * (COLOUR_COUNT - 1);
    const int i = at < COLOUR_COUNT - 1 ? (int)at : COLOUR_COUNT - 2;
    for (int k = 0; k < 3; k++)
        rgb[k] = (unsigned char)(COLOURS[i][k] + (at - i) * (COLOURS[i + 1][k] - COLOURS[i][k]) + 0.5);
}

/* An edge in frame k against the pattern given. */
static double strain(const rg_motion *m, int32_t k, int32_t e)
{
    const rg_vec2 *X = rg_motion_pattern(m, k), *X0 = m->mesh.X;
    const int32_t *v = m->mesh.edge[e];
    return fabs(rg_vec2_length(rg_vec2_sub(X[v[1]], X[v[0]])) / rg_vec2_length(rg_vec2_sub(X0[v[1]], X0[v[0]])) - 1);
}

static double roll(const rg_motion *m, int32_t k, int32_t v)
{
    return rg_vec2_length(rg_vec2_sub(rg_motion_pattern(m, k)[v], m->mesh.X[v])) / m->mesh.size;
}

static double speed(const rg_motion *m, int32_t k, int32_t crease)
{
    return k > 0 && crease >= 0 ? fabs(rg_motion_angles(m, k)[crease] - rg_motion_angles(m, k - 1)[crease]) : 0;
}

/* Of the edge or the corner at place j of a facet. */
static double value_at(const rg_tint_scale *t, const rg_motion *m, int32_t k, int32_t j)
{
    switch (t->by) {
    case RG_COLOUR_STRAIN: return strain(m, k, m->mesh.facet_edge[j]);
    case RG_COLOUR_ROLL: return roll(m, k, m->mesh.facet_vertex[j]);
    case RG_COLOUR_SPEED: return speed(m, k, m->mesh.edge_crease[m->mesh.facet_edge[j]]);
    default: return 0;
    }
}

rg_tint_scale rg_tint_of(const rg_motion *m, rg_colouring by)
{
    rg_tint_scale t = {by, 0};
    for (int32_t k = 0; by != RG_COLOUR_PAPER && by != RG_COLOUR_LAYER && k < m->report.frame_count; k++)
        for (int32_t j = 0; j < m->mesh.facet_start[m->mesh.nf]; j++) t.most = fmax(t.most, value_at(&t, m, k, j));
    return t;
}

/* How a facet is moved against those that lie in its plane, -1 ... 1, upwards on the stage. */
static double layer(const rg_vec3 *lift, int32_t f, double most)
{
    const double length = rg_vec3_length(lift[f]), up = lift[f].z != 0   ? lift[f].z
                                                        : lift[f].x != 0 ? lift[f].x
                                                                         : lift[f].y;
    return most > 0 ? (up < 0 ? -1 : 1) * length / most : 0;
}

void rg_tint_facets(const rg_tint_scale *t, const rg_motion *m, int32_t k, const rg_vec3 *lift, unsigned char (*rgb)[3])
{
    double most = 0;
    for (int32_t f = 0; t->by == RG_COLOUR_LAYER && f < m->mesh.nf; f++) most = fmax(most, rg_vec3_length(lift[f]));
    for (int32_t f = 0; f < m->mesh.nf; f++) {
        double value = 0;
        for (int32_t j = m->mesh.facet_start[f]; j < m->mesh.facet_start[f + 1]; j++)
            value = fmax(value, value_at(t, m, k, j));
        const double part = t->by == RG_COLOUR_LAYER ? 0.5 + 0.5 * layer(lift, f, most)
                            : t->most > NOTHING      ? value / t->most
                                                     : 0;
        colour_at(part, rgb[f]);
    }
}

void rg_tint_words(const rg_tint_scale *t, char *text, size_t room)
{
    switch (t->by) {
    case RG_COLOUR_STRAIN: rg_text(text, room, "strain up to %.2g %%", 100 * t->most); break;
    case RG_COLOUR_ROLL: rg_text(text, room, "roll up to %.2g %%", 100 * t->most); break;
    case RG_COLOUR_SPEED: rg_text(text, room, "up to %.3g degrees a frame", t->most / RG_DEG); break;
    case RG_COLOUR_LAYER: rg_text(text, room, "layers"); break;
    default: rg_text(text, room, "%s", "");
    }
}
