#include "generate/drawing.h"

static const double SHEET = 400;

void rg_drawing_line(rg_sketch *d, rg_vec2 a, rg_vec2 b, char assignment)
{
    if (d->status == RG_OK) d->status = rg_lines_add(d->lines, a, b, assignment, 0);
}

void rg_drawing_path(rg_sketch *d, const rg_vec2 *b, int32_t count, char assignment)
{
    for (int32_t i = 0; i + 1 < count; i++) rg_drawing_line(d, b[i], b[i + 1], assignment);
}

/* y is subtracted the way round that makes zero the file's plain 0, where y points down. */
static rg_vec2 fitted(rg_vec2 p, rg_vec2 centre, double scale)
{
    return (rg_vec2){(p.x - centre.x) * scale, -((centre.y - p.y) * scale)};
}

void rg_drawing_fit(rg_sketch *d, double side, double cell)
{
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t i = 0; i < d->lines->count; i++) {
        const rg_line *l = &d->lines->line[i];
        low = (rg_vec2){fmin(low.x, fmin(l->a.x, l->b.x)), fmin(low.y, fmin(l->a.y, l->b.y))};
        high = (rg_vec2){fmax(high.x, fmax(l->a.x, l->b.x)), fmax(high.y, fmax(l->a.y, l->b.y))};
    }
    const rg_vec2 centre = {(low.x + high.x) / 2, (low.y + high.y) / 2};
    const double scale = cell > 0 ? cell : (side > 0 ? side : SHEET) / fmax(high.x - low.x, high.y - low.y);
    for (int32_t i = 0; i < d->lines->count; i++) {
        rg_line *l = &d->lines->line[i];
        l->a = fitted(l->a, centre, scale);
        l->b = fitted(l->b, centre, scale);
    }
}
