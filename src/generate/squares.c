/* Concentric squares, crossed by the diagonals of the sheet: the pleated hypar, and a flap of box pleats.
 *
 * At a corner of a square the diagonal bisects: sectors pi/4 twice inside, 3 pi/4 twice outside. With its two sides
 * alike, the piece of diagonal inside must be opposite to them and the one outside like them, which makes squares and
 * pieces of diagonals alternate from the centre outwards. */
#include "generate/kinds.h"

/* The corners of the square of half side r, and back to the first. */
static void corners(double r, rg_vec2 q[5])
{
    for (int i = 0; i <= 4; i++) q[i] = (rg_vec2){i == 0 || i == 3 || i == 4 ? -r : r, i % 4 < 2 ? -r : r};
}

static void draw_diagonals(rg_sketch *d, double from, double to, char assignment)
{
    rg_vec2 inner[5], outer[5];
    corners(from, inner);
    corners(to, outer);
    for (int i = 0; i < 4; i++) rg_drawing_line(d, inner[i], outer[i], assignment);
}

/* A diagonal across each of the four trapezoids between squares k and k + 1. */
static void draw_leaning(rg_sketch *d, double k, int left)
{
    rg_vec2 inner[5], outer[5];
    corners(k, inner);
    corners(k + 1, outer);
    for (int i = 0; i < 4; i++) rg_drawing_line(d, inner[i + !left], outer[i + left], RG_UNASSIGNED);
}

/* Squares 1 ... n, the last of them the sheet's edge. The innermost one is crossed by one diagonal only: four alike
 * that meet at right angles break Maekawa's theorem and are rigid. So two corners of that square have degree 3;
 * everywhere else both theorems hold for the pleats. Plates alone cannot move here: the trapezoids bend, along
 * diagonals that lean one way in one ring and the other way in the next (E. D. Demaine et al., "(Non)existence of
 * pleated folds: how paper folds between creases"). They are drawn as creases without an assignment: which way they
 * lean decides whether it folds. */
void rg_hypar_draw(rg_sketch *d)
{
    rg_vec2 q[5];
    corners(1, q);
    rg_drawing_line(d, q[0], q[2], RG_VALLEY);
    for (int32_t k = 1; k <= d->n; k++) {
        const char square = k % 2 ? RG_MOUNTAIN : RG_VALLEY;
        corners(k, q);
        rg_drawing_path(d, q, 5, k == d->n ? RG_BORDER : square);
        if (k < d->n) draw_diagonals(d, k, k + 1, square);
        if (k < d->n) draw_leaning(d, k, k % 2);
    }
}

/* A waterbomb base on a grid of 2 half x 2 half, its point sunk at every grid line, which makes a flap one unit wide:
 * what box pleating begins with. The fold across the middle of the base changes at each square like the diagonals, but
 * opposite to them; it meets the squares at right angles, three creases of one kind and one of the other. Both theorems
 * hold everywhere. */
static void draw_sunk(rg_sketch *d, int32_t half)
{
    rg_vec2 q[5];
    for (int32_t k = 0; k < half; k++) {
        const char diagonal = (half - k) % 2 ? RG_VALLEY : RG_MOUNTAIN;
        draw_diagonals(d, k, k + 1, diagonal);
        for (int side = -1; side <= 1; side += 2)
            rg_drawing_line(d, (rg_vec2){side * k, 0}, (rg_vec2){side * (k + 1), 0}, rg_opposite(diagonal));
        corners(k + 1, q);
        const char square = k + 1 == half ? RG_BORDER : rg_opposite(diagonal);
        rg_drawing_path(d, q, 2, square);
        rg_drawing_path(d, (rg_vec2[]){q[1], {k + 1, 0}, q[2]}, 3, square);
        rg_drawing_path(d, q + 2, 2, square);
        rg_drawing_path(d, (rg_vec2[]){q[3], {-k - 1, 0}, q[4]}, 3, square);
    }
}

void rg_boxpleat_draw(rg_sketch *d) { draw_sunk(d, d->n / 2); }
void rg_open_sink_draw(rg_sketch *d) { draw_sunk(d, 2); }
void rg_waterbomb_base_draw(rg_sketch *d) { draw_sunk(d, 1); }
