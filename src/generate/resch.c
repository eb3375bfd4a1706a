/* Resch's triangles: the sheet contracts to a smooth face of triangles, with three-finned tucks behind it.
 *
 * The plane is paved with two triangles of side 1 to each of side 2, so that at every vertex meet a corner of a large
 * one, the middle of a side of another and two small ones. Six creases from its centre cut a large triangle into halves
 * of equilateral ones: those to its corners are the fins' lower edges (valley), those to the middles of its sides the
 * seams where three fins meet (mountain). All other creases are where a fin leaves the face (mountain). Kawasaki's
 * theorem holds everywhere: sectors 60, 90, 90, 60, 30, 30 degrees at a corner and 60 six times at a centre. Maekawa's
 * holds nowhere, because the aim is not flat: fins stand at right angles to the face (90 degrees), are double (180) and
 * meet at 120 (60). A run that drives all creases to 180 stops when the face has closed. */
#include "generate/kinds.h"

static const double HEIGHT = 0.866025403784438647; /* of a triangle of side 1 */

/* Large triangle (i, j) has its lower left corner at i (a + b) + j (2 a - b) of the grid a = (1, 0), b = (1/2,
 * HEIGHT). */
static rg_vec2 at(int32_t i, int32_t j, double a, double b)
{
    a += i + 2.0 * j;
    b += (double)i - j;
    return (rg_vec2){a + b / 2, b * HEIGHT};
}

static int inside(const rg_sketch *d, int32_t i, int32_t j) { return i >= 0 && i < d->n && j >= 0 && j < d->m; }

/* A small triangle lies between three large ones; it belongs to the sheet if it holds two of them together. */
static int held(const rg_sketch *d, const int32_t large[3][2])
{
    int count = 0;
    for (int k = 0; k < 3; k++) count += inside(d, large[k][0], large[k][1]);
    return count >= 2;
}

static void draw_small(rg_sketch *d, const rg_vec2 corner[3], const int32_t large[3][2])
{
    if (!held(d, large)) return;
    for (int k = 0; k < 3; k++)
        if (!inside(d, large[k][0], large[k][1])) rg_drawing_line(d, corner[k], corner[(k + 1) % 3], RG_BORDER);
}

static void draw_large(rg_sketch *d, int32_t i, int32_t j)
{
    const double ring[7][2] = {{0, 0}, {1, 0}, {2, 0}, {1, 1}, {0, 2}, {0, 1}, {0, 0}};
    /* The small triangle beyond each piece of the outline, by the two other large ones around it. */
    const int32_t beyond[6][3][2] = {
        {{i, j}, {i - 1, j}, {i - 1, j + 1}}, {{i, j}, {i - 1, j + 1}, {i, j + 1}}, {{i, j}, {i, j + 1}, {i + 1, j}},
        {{i, j}, {i + 1, j}, {i + 1, j - 1}}, {{i, j}, {i + 1, j - 1}, {i, j - 1}}, {{i, j}, {i, j - 1}, {i - 1, j}}};
    const rg_vec2 centre = at(i, j, 2.0 / 3, 2.0 / 3);
    for (int k = 0; k < 6; k++) {
        const rg_vec2 p = at(i, j, ring[k][0], ring[k][1]), q = at(i, j, ring[k + 1][0], ring[k + 1][1]);
        rg_drawing_line(d, p, q, held(d, beyond[k]) ? RG_MOUNTAIN : RG_BORDER);
        rg_drawing_line(d, centre, p, k % 2 ? RG_MOUNTAIN : RG_VALLEY);
    }
}

void rg_resch_draw(rg_sketch *d)
{
    for (int32_t i = 0; i <= d->n; i++) {
        for (int32_t j = -1; j < d->m; j++) {
            const rg_vec2 left[3] = {at(i, j, 0, 0), at(i, j, 1, 0), at(i, j, 1, -1)};
            const rg_vec2 right[3] = {at(i, j, 1, 0), at(i, j, 2, 0), at(i, j, 2, -1)};
            draw_small(d, left, (const int32_t[3][2]){{i, j}, {i - 1, j + 1}, {i - 1, j}});
            draw_small(d, right, (const int32_t[3][2]){{i, j}, {i, j + 1}, {i - 1, j + 1}});
            if (inside(d, i, j)) draw_large(d, i, j);
        }
    }
}
