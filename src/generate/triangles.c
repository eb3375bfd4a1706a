/* Yoshimura and Kresling patterns: sheets of equal triangles in rows, which cylinders buckle to.
 *
 * Every inner vertex has degree 6 and the same sectors opposite to each other, so that Kawasaki's theorem holds; four
 * creases of one kind and two of the other make Maekawa's hold. */
#include "generate/kinds.h"

/* n isosceles triangles side by side, m rows; `angle` is that at the base. Bases valley, legs mountain. A row of them
 * folded flat is a strip that turns round and round: vertices fold flat, but paper with a thickness of layers would
 * meet itself. Above 60 degrees the angle at the top would be the smallest, between two mountains. */
void rg_yoshimura_draw(rg_sketch *d)
{
    const double h = tan(d->angle) / 2;
    for (int32_t j = 0; j <= d->m; j++) {
        const double y = j * h, shift = j % 2 ? 0.5 : 0;
        const char base = j == 0 || j == d->m ? RG_BORDER : RG_VALLEY;
        const int32_t points = j % 2 ? d->n + 2 : d->n + 1; /* odd rows have a half base at either end */
        for (int32_t i = 0; i < points; i++) {
            const double x = fmax(0, fmin(i - shift, d->n)), right = fmin(i + 1 - shift, d->n);
            if (i + 1 < points) rg_drawing_line(d, (rg_vec2){x, y}, (rg_vec2){right, y}, base);
            if (j == d->m) continue;
            const double up = (j + 1) * h;
            if (x == 0) rg_drawing_line(d, (rg_vec2){0, y}, (rg_vec2){0, up}, RG_BORDER);
            if (x == d->n) rg_drawing_line(d, (rg_vec2){x, y}, (rg_vec2){x, up}, RG_BORDER);
            for (int side = -1; side <= 1; side += 2) {
                const double top = x + side * 0.5;
                const int whole = j % 2 == 0 || (x > 0 && x < d->n); /* not the corner of a half triangle */
                if (whole && top >= 0 && top <= d->n)
                    rg_drawing_line(d, (rg_vec2){x, y}, (rg_vec2){top, up}, RG_MOUNTAIN);
            }
        }
    }
}

/* A tube of n sides, cut open, m storeys. Parallelograms with bases 1 and a long diagonal: bases and sides mountain,
 * diagonals valley. `angle` is that between base and diagonal, 3/4 of its usual largest, pi/2 - pi/n, if not given.
 * Between diagonal and side it is pi/n: a row folded flat then turns by 2 pi/n at each side and closes to the n-gon
 * that the tube collapses to. As a sheet that is not glued together it folds rigidly all the way, as a tube it would
 * have to bend. */
void rg_kresling_draw(rg_sketch *d)
{
    const double apex = RG_PI / d->n, base = d->angle > 0 ? d->angle : 0.75 * (RG_PI / 2 - apex);
    const double side = sin(base) / sin(apex); /* of the triangle with base 1: law of sines */
    const rg_vec2 up = {side * cos(base + apex), side * sin(base + apex)};
    for (int32_t j = 0; j <= d->m; j++) {
        for (int32_t i = 0; i <= d->n; i++) {
            const rg_vec2 p = {i + j * up.x, j * up.y}, above = {p.x + up.x, p.y + up.y};
            if (i < d->n)
                rg_drawing_line(d, p, (rg_vec2){p.x + 1, p.y}, j == 0 || j == d->m ? RG_BORDER : RG_MOUNTAIN);
            if (j == d->m) continue;
            rg_drawing_line(d, p, above, i == 0 || i == d->n ? RG_BORDER : RG_MOUNTAIN);
            if (i < d->n) rg_drawing_line(d, p, (rg_vec2){above.x + 1, above.y}, RG_VALLEY);
        }
    }
}
