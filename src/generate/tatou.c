/* A tatou, the folded purse: a square twist with pleats to the edges.
 *
 * On a grid of four: a square stands on its point in the middle, and from each of its corners two lines run to the
 * edges at right angles, each of them one side of a pleat. Sectors 90, 45, 90 and 135 degrees; sides of the square and
 * the pleats' near lines are valleys, the pleats' far lines mountains: both theorems hold at all four vertices. It does
 * not fold rigidly at all: around the square each vertex would have to be ahead of the next. */
#include "generate/kinds.h"

static rg_vec2 turned(rg_vec2 p, int quarters)
{
    while (quarters-- > 0) p = (rg_vec2){-p.y, p.x};
    return p;
}

void rg_tatou_draw(rg_sketch *d)
{
    for (int q = 0; q < 4; q++) {
        const rg_vec2 corner = turned((rg_vec2){1, 0}, q);
        const rg_vec2 far = turned((rg_vec2){1, 2}, q), near = turned((rg_vec2){2, 0}, q);
        const rg_vec2 sheet = turned((rg_vec2){2, 2}, q);
        rg_drawing_line(d, corner, turned((rg_vec2){0, 1}, q), RG_VALLEY);
        rg_drawing_line(d, corner, far, RG_MOUNTAIN);
        rg_drawing_line(d, corner, near, RG_VALLEY);
        rg_drawing_path(d, (rg_vec2[]){near, sheet, far, turned((rg_vec2){0, 2}, q)}, 4, RG_BORDER);
    }
}
