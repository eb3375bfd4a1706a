/* The traditional crane, wings up: a bird base with its two legs narrowed and folded up as neck and tail, and a head.
 *
 * Narrowing. A leg has four layers of 22.5 degrees; its front two are folded to the middle as one, and so are the two
 * behind. The fold runs from the tip A through both layers, W and Q, and on through the wing to the hinge, where both
 * meet, R. Opened up, it is a ring A W R Q around the bird base's vertex S. What it moves it moves whole, so that the
 * creases inside keep their assignments, and those of the ring alternate: they lie in layers facing up and down in
 * turn.
 *
 * Reverse folds. Now the leg is an accordion of eight sectors of 11.25 degrees, rays 0 (an edge) ... 4 (the diagonal)
 * ... 8. A fold straight across it is a zigzag that crosses even rays at one distance from A and odd ones at another.
 * The halves of the leg, 0 - 4 and 4 - 8, are folded in opposite directions, and the ray between them, 4, is turned
 * inside out beyond.
 *
 * Both theorems hold at every inner vertex. */
#include "generate/kinds.h"

enum { RAYS = 4, FOLDS = 2 };

/* An inside reverse fold at a distance from the tip, on even rays; between it and the tip the leg ends up turned by
 * 2 psi from where it would lie folded back on itself. */
typedef struct reverse { double distance, psi; const char *assignment; } reverse;

/* From the body outwards; the assignments are those of the sectors 0 ... 3. */
static const reverse neck[FOLDS] = {{0.9, 67.5, "VMVM"}, {0.4, 33.75, "MVMV"}};

/* The four legs' halves are one, mirrored at either diagonal or both. */
static rg_vec2 placed(int half, rg_vec2 p)
{
    if (half & 1) p = (rg_vec2){p.y, p.x};
    return half & 2 ? (rg_vec2){-p.y, -p.x} : p;
}

static void line(rg_sketch *d, int half, rg_vec2 a, rg_vec2 b, char assignment)
{
    rg_drawing_line(d, placed(half, a), placed(half, b), assignment);
}

static const rg_vec2 A = {-1, -1}, B = {1, -1}, O = {0, 0}, UP = {0, 1};

static rg_vec2 direction(double degrees) { return (rg_vec2){cos(degrees * RG_DEG), sin(degrees * RG_DEG)}; }

/* Where a fold crosses ray k: even rays at its distance, odd ones where the triangle with that side, the angle between
 * rays and psi ends. */
static rg_vec2 crossing(const reverse *f, int k)
{
    const double sector = 45.0 / RAYS, odd = sin(f->psi * RG_DEG) / sin((180 - sector - f->psi) * RG_DEG);
    const double r = k % 2 ? f->distance * odd : f->distance;
    const rg_vec2 u = direction(k * sector);
    return (rg_vec2){A.x + r * u.x, A.y + r * u.y};
}

/* A ray from its end in the body to the tip, in pieces. */
static void draw_ray(rg_sketch *d, int half, int k, int folds, rg_vec2 end, char assignment)
{
    for (int f = 0; f <= folds; f++) {
        const rg_vec2 next = f < folds ? crossing(&neck[f], k) : A;
        line(d, half, end, next, assignment);
        end = next;
        if (k == RAYS) assignment = rg_opposite(assignment);
    }
}

static void draw_half(rg_sketch *d, int half, int folds)
{
    const rg_vec2 S = rg_meet(A, direction(22.5), O, UP), E = {-S.y, 0}; /* the bird base's vertices beside B */
    const rg_vec2 W = rg_meet(A, direction(11.25), S, rg_vec2_sub(B, S));
    const rg_vec2 Q = rg_meet(A, direction(33.75), O, UP);
    /* The fold is mirrored at S - O: it heads for B. */
    const rg_vec2 R = rg_meet(Q, rg_vec2_sub(B, Q), S, rg_vec2_sub(E, S));
    draw_ray(d, half, 0, folds, B, RG_BORDER);
    draw_ray(d, half, 1, folds, W, RG_MOUNTAIN);
    draw_ray(d, half, 2, folds, S, RG_VALLEY);
    draw_ray(d, half, 3, folds, Q, RG_VALLEY);
    if (half % 2 == 0) draw_ray(d, half, RAYS, folds, O, RG_MOUNTAIN);
    for (int f = 0; f < folds; f++)
        for (int k = 0; k < RAYS; k++)
            line(d, half, crossing(&neck[f], k), crossing(&neck[f], k + 1), neck[f].assignment[k]);
    line(d, half, W, R, RG_VALLEY);
    line(d, half, R, Q, RG_MOUNTAIN);
    line(d, half, S, W, RG_VALLEY);
    line(d, half, W, B, RG_VALLEY);
    line(d, half, S, Q, RG_VALLEY);
    line(d, half, Q, O, RG_VALLEY);
    line(d, half, S, R, RG_MOUNTAIN);
    if (half < 2) line(d, half, R, placed(2, R), RG_MOUNTAIN);
}

void rg_crane_draw(rg_sketch *d)
{
    for (int half = 0; half < 4; half++) draw_half(d, half, half < 2 ? FOLDS : 1);
}
