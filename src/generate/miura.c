/* Miura-ori, and its relatives with straight rows.
 *
 * Pleat the sheet along parallel rows: what lay at height Y then lies at height y of a narrow strip. Fold the strip
 * along slanted lines x = c + k y and open everything: each line has become a zigzag, mirrored at every row. So at
 * every vertex the two sectors on the side to which the zigzag leans are alpha, with tan(alpha) = 1/k, the others pi -
 * alpha: Kawasaki's theorem holds. A zigzag has one assignment, and its neighbours the other; of the two pieces of a
 * row at a vertex the one between the acute sectors is opposite to the zigzag, the other is like it: Maekawa's theorem
 * holds. As each zigzag keeps its k in every row, the tangents of the half fold angles of two zigzags have the same
 * ratio everywhere, k/k', and the sheet folds rigidly with one degree of freedom, all creases arriving at pi
 * together. */
#include "generate/kinds.h"
#include "base/memory.h"

typedef struct strip {
    int32_t columns, rows; /* of facets */
    double *c, *k;         /* [columns + 1] */
    double *y, *Y;         /* [rows + 1] y goes up and down in turn, Y only up */
} strip;

static rg_vec2 vertex(const strip *s, int32_t i, int32_t j) { return (rg_vec2){s->c[i] + s->k[i] * s->y[j], s->Y[j]}; }

static void draw(rg_sketch *d, const strip *s)
{
    for (int32_t j = 0; j <= s->rows; j++) {
        for (int32_t i = 0; i <= s->columns; i++) {
            const char zigzag = i % 2 ? RG_VALLEY : RG_MOUNTAIN;
            const int edge_row = j == 0 || j == s->rows, edge_column = i == 0 || i == s->columns;
            if (i < s->columns)
                rg_drawing_line(d, vertex(s, i, j), vertex(s, i + 1, j),
                                edge_row ? RG_BORDER : j % 2 ? zigzag : rg_opposite(zigzag));
            if (j < s->rows)
                rg_drawing_line(d, vertex(s, i, j), vertex(s, i, j + 1), edge_column ? RG_BORDER : zigzag);
        }
    }
}

static void strip_free(strip *s, const rg_memory *mem)
{
    double *block[] = {s->c, s->k, s->y, s->Y};
    for (int i = 0; i < 4; i++) rg_mem_free(mem, block[i]);
}

static rg_status strip_init(strip *s, const rg_memory *mem, int32_t columns, int32_t rows)
{
    *s = (strip){columns, rows, NULL, NULL, NULL, NULL};
    return RG_MEM_ARRAYS(mem, RG_ARRAY(s->c, (size_t)columns + 1), RG_ARRAY(s->k, (size_t)columns + 1),
                         RG_ARRAY(s->y, (size_t)rows + 1), RG_ARRAY(s->Y, (size_t)rows + 1));
}

/* n columns and m rows of rhombs with the acute angle given. */
void rg_miura_draw(rg_sketch *d)
{
    strip s;
    d->status = strip_init(&s, &d->lines->mem, d->n, d->m);
    if (d->status == RG_OK) {
        for (int32_t i = 0; i <= d->n; i++) {
            s.c[i] = i;
            s.k[i] = 1 / tan(d->angle);
        }
        for (int32_t j = 0; j <= d->m; j++) {
            s.y[j] = j % 2 ? sin(d->angle) : 0;
            s.Y[j] = j * sin(d->angle);
        }
        draw(d, &s);
    }
    strip_free(&s, &d->lines->mem);
}

/* The next of a repeatable row of numbers, even in from ... to; the constants are Knuth's for 64 bits. */
static double next(uint64_t *state, double from, double to)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(*state >> 11) / 9007199254740992.0; /* 2^53 */
}

/* n columns and rows with heights, widths and slants by chance: m is the seed. Two lines of the strip, at least 0.7
 * apart at its foot and differing in k by at most 0.5, do not cross at heights up to 1. */
void rg_random_draw(rg_sketch *d)
{
    strip s;
    d->status = strip_init(&s, &d->lines->mem, d->n, d->n);
    if (d->status == RG_OK) {
        uint64_t state = (uint64_t)d->m;
        for (int i = 0; i < 8; i++) next(&state, 0, 1); /* small seeds begin alike */
        for (int32_t i = 0; i <= d->n; i++) {
            s.c[i] = i == 0 ? 0 : s.c[i - 1] + next(&state, 0.7, 1.3);
            s.k[i] = next(&state, 0.25, 0.75);
        }
        for (int32_t j = 0; j <= d->n; j++) {
            s.y[j] = j % 2 ? next(&state, 0.75, 1) : next(&state, 0, 0.25);
            s.Y[j] = j == 0 ? 0 : s.Y[j - 1] + fabs(s.y[j] - s.y[j - 1]);
        }
        draw(d, &s);
    }
    strip_free(&s, &d->lines->mem);
}
