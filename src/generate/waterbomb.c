/* Waterbomb tessellation: n units side by side in a row, m rows, each row moved by half a unit against the next.
 *
 * A unit is 2 wide and 2 h high, h the tangent of the angle between a diagonal and the rows: diagonals valley, the line
 * down its middle mountain. Units and rows are divided by mountains. With sectors beta = angle and pi/2 - beta, a
 * centre has pi/2 - beta twice, 2 beta, and again; a corner beta, pi/2 - beta twice, beta and two right angles:
 * Kawasaki's theorem holds for any beta, Maekawa's with two mountains to four valleys and four to two. Below 30 degrees
 * 2 beta would be the smallest sector at a centre, between two valleys, which cannot fold flat. All facets are
 * triangles. */
#include "generate/kinds.h"

/* Lines below a row: unit pieces, because corners of both rows end there. */
static void draw_row_line(rg_sketch *d, double y, char assignment)
{
    for (int32_t x = 0; x < 2 * d->n; x++) rg_drawing_line(d, (rg_vec2){x, y}, (rg_vec2){x + 1, y}, assignment);
}

static void draw_unit(rg_sketch *d, double x, double y, double h, char middle)
{
    const rg_vec2 centre = {x, y + h};
    rg_drawing_path(d, (rg_vec2[]){{x, y}, centre, {x, y + 2 * h}}, 3, middle);
    for (int side = -1; side <= 1; side += 2) {
        if (x + side < 0 || x + side > 2 * d->n) continue;
        rg_drawing_line(d, centre, (rg_vec2){x + side, y}, RG_VALLEY);
        rg_drawing_line(d, centre, (rg_vec2){x + side, y + 2 * h}, RG_VALLEY);
    }
}

void rg_waterbomb_draw(rg_sketch *d)
{
    const double h = tan(d->angle);
    for (int32_t row = 0; row < d->m; row++) {
        const double y = 2 * h * row;
        draw_row_line(d, y, row == 0 ? RG_BORDER : RG_MOUNTAIN);
        for (int32_t x = 0; x <= 2 * d->n; x++) {
            const char upright = x == 0 || x == 2 * d->n ? RG_BORDER : RG_MOUNTAIN;
            if ((x + row) % 2) draw_unit(d, x, y, h, upright);
            else rg_drawing_line(d, (rg_vec2){x, y}, (rg_vec2){x, y + 2 * h}, upright);
        }
    }
    draw_row_line(d, 2 * h * d->m, RG_BORDER);
}
