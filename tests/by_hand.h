/* by_hand.h -- sheets folded as one folds them: all layers over a line, again and again; and the crease pattern that this leaves.
 * Include after cmocka.h, near.h and draw.h. */
#ifndef BY_HAND_H
#define BY_HAND_H

enum { BY_HAND_PIECES = 64, BY_HAND_CORNERS = 16 };

/* A part of the sheet that is flat, and where it lies: x -> (x.x c[0] + x.y c[1]) + t. */
typedef struct by_hand_piece { rg_vec2 corner[BY_HAND_CORNERS]; int n; rg_vec2 c[2], t; int back_up; } by_hand_piece;

typedef struct by_hand {
    by_hand_piece piece[BY_HAND_PIECES]; /* from the lowest to the topmost */
    int n;
    rg_lines lines; /* the border, and the creases made so far */
    int creases;
} by_hand;

static inline rg_vec2 by_hand_at(const by_hand_piece *p, rg_vec2 x)
{
    return (rg_vec2){x.x * p->c[0].x + x.y * p->c[1].x + p->t.x, x.x * p->c[0].y + x.y * p->c[1].y + p->t.y};
}

static inline void by_hand_begin(by_hand *h, double width, double height)
{
    *h = (by_hand){.n = 1, .lines = drawing()};
    h->piece[0] = (by_hand_piece){{{0, 0}, {width, 0}, {width, height}, {0, height}}, 4, {{1, 0}, {0, 1}}, {0, 0}, 0};
    draw_box(&h->lines, 0, 0, width, height);
}

/* The part of a piece on one side of the line through a along d (unit), side +1 the left one. cut[2]: the ends of its new side, in the
 * pattern; returns how many there are. */
static inline int by_hand_cut(const by_hand_piece *p, rg_vec2 a, rg_vec2 d, double side, by_hand_piece *part, rg_vec2 cut[2])
{
    int cuts = 0;
    *part = *p;
    part->n = 0;
    for (int i = 0; i < p->n; i++) {
        const rg_vec2 x = p->corner[i], y = p->corner[(i + 1) % p->n];
        const double s = side * rg_vec2_cross(d, rg_vec2_sub(by_hand_at(p, x), a)), t = side * rg_vec2_cross(d, rg_vec2_sub(by_hand_at(p, y), a));
        if (s > 0) part->corner[part->n++] = x;
        if ((s > 0) == (t > 0)) continue;
        const rg_vec2 z = {x.x + s / (s - t) * (y.x - x.x), x.y + s / (s - t) * (y.y - x.y)};
        part->corner[part->n++] = z;
        assert_true(cuts < 2);
        cut[cuts++] = z;
    }
    assert_true(part->n <= BY_HAND_CORNERS);
    return cuts;
}

/* Folds all that is left of the line over (+1) or under (-1) the rest. */
static inline void by_hand_fold(by_hand *h, rg_vec2 a, rg_vec2 d, int over)
{
    static by_hand_piece stay[BY_HAND_PIECES], go[BY_HAND_PIECES];
    int stays = 0, goes = 0;
    for (int i = 0; i < h->n; i++) {
        rg_vec2 cut[2];
        const int up = (h->piece[i].back_up ? -1 : 1) * over;
        by_hand_piece part;
        by_hand_cut(&h->piece[i], a, d, -1, &part, cut);
        if (part.n) stay[stays++] = part;
        if (by_hand_cut(&h->piece[i], a, d, 1, &part, cut) == 2) {
            draw(&h->lines, up > 0 ? RG_VALLEY : RG_MOUNTAIN, cut[0].x, cut[0].y, cut[1].x, cut[1].y);
            h->creases++;
        }
        if (!part.n) continue;
        const double c2 = d.x * d.x - d.y * d.y, s2 = 2 * d.x * d.y;
        for (int k = 0; k < 3; k++) {
            rg_vec2 *v = k < 2 ? &part.c[k] : &part.t, r = k < 2 ? *v : rg_vec2_sub(*v, a);
            *v = (rg_vec2){c2 * r.x + s2 * r.y, s2 * r.x - c2 * r.y};
            if (k == 2) *v = (rg_vec2){v->x + a.x, v->y + a.y};
        }
        part.back_up = !part.back_up;
        go[goes++] = part;
    }
    assert_true(stays + goes <= BY_HAND_PIECES);
    h->n = 0;
    for (int i = goes - 1; over < 0 && i >= 0; i--) h->piece[h->n++] = go[i];
    for (int i = 0; i < stays; i++) h->piece[h->n++] = stay[i];
    for (int i = goes - 1; over > 0 && i >= 0; i--) h->piece[h->n++] = go[i];
}

/* Some folds over lines that pass near the middle of what there is. */
static inline void by_hand_any(by_hand *h, int folds, unsigned *seed)
{
    by_hand_begin(h, 1, 0.875);
    for (int k = 0; k < folds; k++) {
        rg_vec2 middle = {0, 0};
        int n = 0;
        for (int i = 0; i < h->n; i++)
            for (int j = 0; j < h->piece[i].n; j++, n++) {
                const rg_vec2 x = by_hand_at(&h->piece[i], h->piece[i].corner[j]);
                middle = (rg_vec2){middle.x + x.x, middle.y + x.y};
            }
        const double angle = RG_PI * noise(seed);
        const rg_vec2 a = {middle.x / n + 0.05 * noise(seed), middle.y / n + 0.05 * noise(seed)};
        by_hand_fold(h, a, (rg_vec2){cos(angle), sin(angle)}, noise(seed) < 0 ? -1 : 1);
    }
}

/* A preliminary base, fronts outside, one corner of its outermost layer folded over: towards the front, which is outside, or in under
 * that layer. */
static inline rg_pattern *base_and_corner(char corner)
{
    rg_lines l = drawing();
    draw_box(&l, -1, -1, 1, 1);
    draw(&l, RG_MOUNTAIN, -1, 0, 1, 0);
    draw(&l, RG_MOUNTAIN, 0, -1, 0, 1);
    draw(&l, RG_VALLEY, -1, 1, 1, -1);
    draw(&l, corner, 1, 0.5, 0.5, 1);
    return pattern_of(&l);
}

#endif
