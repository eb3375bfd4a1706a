/* The traditional bases, on the square -1 ... 1 with corners A, B, C, D counter-clockwise from the lower left.
 *
 * A base packs equal right triangles that are each folded along their three bisectors: four of them meet in the middle
 * of the bird base, eight in that of the frog base, two with their long sides in that of the fish base. So all points
 * are centres of inscribed circles. Both theorems hold at every inner vertex. */
#include "generate/kinds.h"

static const double S = 0.414213562373095049; /* sqrt 2 - 1, radius of the circle in a triangle with a long side of 2 */
static const double U = 0.292893218813452475; /* 1 - sqrt 1/2, the same with short sides of 1 */
static const double W = 0.707106781186547524; /* sqrt 1/2 */

/* Points by letter: O centre; A B C D corners; s e n w middles of the edges; S E N W centres of circles above them; p q
 * r t middles of the lines S-E, E-N, N-W, W-S; F G centres of the fish base's circles, f g where those touch; 1 ... 8
 * centres of the frog base's circles, counter-clockwise from the one next to A on AB; x y middles of 1-2, 5-6. */
static const char letters[] = "OABCDsenwSENWpqrtFGfg12345678xy";

static rg_vec2 point(char letter)
{
    const rg_vec2 points[] = {
        {0, 0}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0},
        {0, S - 1}, {1 - S, 0}, {0, 1 - S}, {S - 1, 0}, {U, -U}, {U, U}, {-U, U}, {-U, -U},
        {S, -S}, {-S, S}, {1, -S}, {-S, 1},
        {-U, -W}, {U, -W}, {W, -U}, {W, U}, {U, W}, {-U, W}, {-W, U}, {-W, -U}, {0, -W}, {0, W}};
    int i = 0;
    while (letters[i] && letters[i] != letter) i++;
    return points[i];
}

/* Where a base is put: mirrored at its middle line if `mirror` is -1, then moved. */
typedef struct place { double mirror; rg_vec2 to; } place;
static const place here = {1, {0, 0}};

/* Groups of an assignment and pairs of points: "B AB BC, M Op". */
static void draw(rg_sketch *d, place at, const char *lines)
{
    char assignment = 0;
    for (const char *c = lines; *c; c++) {
        if (*c == ' ' || *c == ',') continue;
        if (c[1] == ' ') {
            assignment = *c;
            continue;
        }
        const rg_vec2 a = point(c[0]), b = point(c[1]);
        rg_drawing_line(d, (rg_vec2){at.mirror * a.x + at.to.x, a.y + at.to.y},
                        (rg_vec2){at.mirror * b.x + at.to.x, b.y + at.to.y}, assignment);
        c++;
    }
}

/* Two corners stay whole; the sheet is halved along the others' diagonal and along both middle lines. */
void rg_preliminary_draw(rg_sketch *d)
{
    draw(d, here, "B As sB Be eC Cn nD Dw wA, V Os Oe On Ow, M OA OC");
}

/* Kite folds from A and C; the corners B and D between them become flaps that point to C. */
void rg_fish_draw(rg_sketch *d)
{
    draw(d, here, "B AB Bf fC Cg gD DA, V AF CF Ff AG CG Gg, M FB GD");
}

/* Both flaps lifted: the petal folds' hinges are mountains, and the edges lie in one piece along them. */
void rg_bird_draw(rg_sketch *d)
{
    draw(d, here, "B AB BC CD DA, V OS OE ON OW SA SB EB EC NC ND WD WA, M SE NW OA OC");
}

/* All four flaps squashed and petal-folded; those at s and n then folded in half, so that four lie on either side. */
void rg_frog_draw(rg_sketch *d)
{
    draw(d, here, "B As sB Be eC Cn nD Dw wA, M OA OB OC OD");
    draw(d, here, "V O1 O2 O3 O4 O5 O6 O7 O8 A1 s1 s2 B2 B3 e3 e4 C4 C5 n5 n6 D6 D7 w7 w8 A8");
    draw(d, here, "M 1x x2 34 5y y6 78 Ox Oy, V xs yn");
}

/* Four bird bases, their edges folded; the flaps in the middle and at the corners of the sheet are lifted. Two of the
 * bases have theirs folded in half: twelve creases of the bases and the four edges meet in the middle, less two
 * diagonals left whole, eight of them valleys. */
void rg_four_crane_draw(rg_sketch *d)
{
    static const char *const shared = "V OS OE ON OW SA SB EB EC NC ND WD WA, M OA OC";
    for (int i = 0; i < 4; i++) {
        const double x = i % 2 ? 1 : -1, y = i < 2 ? 1 : -1;
        const place at = {-x * y, {x, y}}; /* A and C are where two bases meet at the sheet's edge */
        draw(d, at, shared);
        draw(d, at, x == y ? "M SE NW" : "M Sp pE Nr rW");
        draw(d, at, x == y ? "" : y > 0 ? "V Op rD, M pB Or" : "M Op rD, V pB Or");
    }
    for (int side = -1; side <= 1; side += 2) {
        rg_drawing_line(d, (rg_vec2){0, 0}, (rg_vec2){2 * side, 0}, RG_MOUNTAIN);
        rg_drawing_line(d, (rg_vec2){0, 0}, (rg_vec2){0, 2 * side}, RG_MOUNTAIN);
    }
    rg_drawing_path(d, (rg_vec2[]){{-2, -2}, {0, -2}, {2, -2}, {2, 0}, {2, 2}, {0, 2}, {-2, 2}, {-2, 0}, {-2, -2}}, 9,
                    RG_BORDER);
}
