#include "linalg/supernodal.h"
#include "base/lanes.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* c (m x n, columns of `room`) = a b^T over k columns; a and b are rows of one panel with columns of `tall`. m and n
 * are rounded up to four. */
RG_WIDE static void multiply(int32_t m, int32_t n, int32_t k, const double *a, const double *b, int32_t tall, double *c,
                          int32_t room)
{
    for (int32_t j = 0; j < n; j += 4) {
        int32_t i = j & ~3;
        for (; i + 4 < m; i += 8) { /* twice as many sums at once as below: an addition takes longer than that */
            const double *p = a + i, *q = b + j;
            rg_quad c0 = {0}, c1 = {0}, c2 = {0}, c3 = {0}, d0 = {0}, d1 = {0}, d2 = {0}, d3 = {0};
            for (int32_t l = 0; l < k; l++, p += tall, q += tall) {
                rg_quad v = *(const rg_quad_anywhere *)p, w = *(const rg_quad_anywhere *)(p + 4);
                c0 += v * q[0], d0 += w * q[0];
                c1 += v * q[1], d1 += w * q[1];
                c2 += v * q[2], d2 += w * q[2];
                c3 += v * q[3], d3 += w * q[3];
            }
            double *to = c + (size_t)j * (size_t)room + i;
            *(rg_quad_anywhere *)to = c0, *(rg_quad_anywhere *)(to + 4) = d0;
            *(rg_quad_anywhere *)(to + room) = c1, *(rg_quad_anywhere *)(to + room + 4) = d1;
            *(rg_quad_anywhere *)(to + 2 * (size_t)room) = c2, *(rg_quad_anywhere *)(to + 2 * (size_t)room + 4) = d2;
            *(rg_quad_anywhere *)(to + 3 * (size_t)room) = c3, *(rg_quad_anywhere *)(to + 3 * (size_t)room + 4) = d3;
        }
        for (; i < m; i += 4) {
            const double *p = a + i, *q = b + j;
            rg_quad c0 = {0}, c1 = {0}, c2 = {0}, c3 = {0};
            for (int32_t l = 0; l < k; l++, p += tall, q += tall) {
                rg_quad v = *(const rg_quad_anywhere *)p;
                c0 += v * q[0];
                c1 += v * q[1];
                c2 += v * q[2];
                c3 += v * q[3];
            }
            double *to = c + (size_t)j * (size_t)room + i;
            *(rg_quad_anywhere *)to = c0;
            *(rg_quad_anywhere *)(to + room) = c1;
            *(rg_quad_anywhere *)(to + 2 * (size_t)room) = c2;
            *(rg_quad_anywhere *)(to + 3 * (size_t)room) = c3;
        }
    }
}

/* Columns of a panel from `first` on, four or fewer, their updates from before done: factored. tall: rows, and the
 * distance of columns, a multiple of four; rows that are only there to make it one are zero and stay it. */
RG_WIDE static int factor_columns(double *x, int32_t tall, int32_t first, int32_t last)
{
    for (int32_t j = first; j < last; j++) {
        double *col = x + (size_t)j * (size_t)tall;
        const double pivot = col[j];
        if (!(pivot > 0)) return 0;
        const double inverse = 1 / sqrt(pivot);
        for (int32_t i = first; i < tall; i += 4) *(rg_quad_anywhere *)(col + i) *= inverse;
        col[j] = inverse; /* which is all that the diagonal is asked for */
        for (int32_t l = j + 1; l < last; l++) {
            double *next = x + (size_t)l * (size_t)tall;
            const double f = col[l];
            for (int32_t i = first; i < tall; i += 4)
                *(rg_quad_anywhere *)(next + i) -= *(const rg_quad_anywhere *)(col + i) * f;
        }
    }
    return 1;
}

/* col[m] -= u[m], m a multiple of four */
RG_WIDE static void subtract(int32_t m, const double *u, double *col)
{
    for (int32_t i = 0; i < m; i += 4) *(rg_quad_anywhere *)(col + i) -= *(const rg_quad_anywhere *)(u + i);
}

static int factor_panel(double *x, int32_t tall, int32_t wide, double *update)
{
    for (int32_t first = 0; first < wide; first += 4) {
        int32_t last = first + 4 < wide ? first + 4 : wide, m = tall - first, room = m + 4;
        if (first > 0) {
            multiply(m, last - first, first, x + first, x + first, tall, update, room);
            for (int32_t j = first; j < last; j++)
                subtract(m, update + (size_t)(j - first) * (size_t)room, x + (size_t)j * (size_t)tall + first);
        }
        if (!factor_columns(x, tall, first, last)) return 0;
    }
    return 1;
}

static void hang(rg_supernodal *L, int32_t d)
{
    int32_t at = L->S.start[d] + L->done[d];
    if (at == L->S.start[d + 1]) return;
    int32_t s = L->S.of[L->S.row[at]];
    L->next[d] = L->head[s];
    L->head[s] = d;
}

/* Takes from panel s what d, finished, contributes: the products of its rows from `done` on with those among them that
 * are columns of s. */
static void take_from(rg_supernodal *L, int32_t s, int32_t d)
{
    const int32_t wide = L->S.column[d + 1] - L->S.column[d], from = L->done[d];
    const int32_t *row = L->S.row + L->S.start[d] + from, rows = L->S.start[d + 1] - L->S.start[d] - from;
    const int32_t stride = rg_symbolic_stride(&L->S, d), s_stride = rg_symbolic_stride(&L->S, s);
    const double *x = L->x + L->S.panel[d] + from;
    int32_t n = 0;
    while (n < rows && row[n] < L->S.column[s + 1]) n++;
    const int32_t room = rows + 4;
    multiply(rows, n, wide, x, x, stride, L->update, room);
    int32_t *place = L->place;
    for (int32_t i = 0; i < rows; i++) place[i] = L->map[row[i]];
    const int in_one_piece = place[rows - 1] - place[0] == rows - 1;
    for (int32_t j = 0; j < n; j++) {
        double *to = L->x + L->S.panel[s] + (size_t)(row[j] - L->S.column[s]) * (size_t)s_stride;
        const double *u = L->update + (size_t)j * (size_t)room;
        if (in_one_piece) rg_lanes_add(rows - j, -1, u + j, to + place[j]);
        else
            for (int32_t i = j; i < rows; i++) to[place[i]] -= u[i];
    }
    L->done[d] += n;
}

int rg_supernodal_factor(rg_supernodal *L, double beta)
{
    for (int32_t s = 0; s < L->S.count; s++) L->head[s] = -1;
    for (int32_t s = 0; s < L->S.count; s++) {
        const int32_t tall = L->S.start[s + 1] - L->S.start[s], wide = L->S.column[s + 1] - L->S.column[s];
        const int32_t *row = L->S.row + L->S.start[s], stride = rg_symbolic_stride(&L->S, s);
        double *x = L->x + L->S.panel[s];
        for (int32_t i = 0; i < tall; i++) L->map[row[i]] = i;
        for (int32_t j = 0; j < wide; j++) x[(size_t)j * (size_t)stride + (size_t)j] += beta;
        for (int32_t d = L->head[s], then; d >= 0; d = then) {
            then = L->next[d];
            take_from(L, s, d);
            hang(L, d);
        }
        if (!factor_panel(x, stride, wide, L->update)) return 0;
        L->done[s] = wide;
        hang(L, s);
    }
    return 1;
}

/* u[m] -= n columns of x, `tall` apart, each times its b; n <= 4, m a multiple of four */
RG_WITHIN void subtract_columns(const double *x, int32_t tall, int32_t m, int32_t n, const double *b, double *u)
{
    const double b0 = b[0];
    if (n == 4) {
        const double *x1 = x + tall, *x2 = x1 + tall, *x3 = x2 + tall, b1 = b[1], b2 = b[2], b3 = b[3];
        for (int32_t i = 0; i < m; i += 4)
            *(rg_quad_anywhere *)(u + i) -=
                (*(const rg_quad_anywhere *)(x + i) * b0 + *(const rg_quad_anywhere *)(x1 + i) * b1) +
                (*(const rg_quad_anywhere *)(x2 + i) * b2 + *(const rg_quad_anywhere *)(x3 + i) * b3);
    } else if (n == 3) {
        const double *x1 = x + tall, *x2 = x1 + tall, b1 = b[1], b2 = b[2];
        for (int32_t i = 0; i < m; i += 4)
            *(rg_quad_anywhere *)(u + i) -=
                (*(const rg_quad_anywhere *)(x + i) * b0 + *(const rg_quad_anywhere *)(x1 + i) * b1) +
                *(const rg_quad_anywhere *)(x2 + i) * b2;
    } else if (n == 2) {
        const double *x1 = x + tall, b1 = b[1];
        for (int32_t i = 0; i < m; i += 4)
            *(rg_quad_anywhere *)(u + i) -=
                *(const rg_quad_anywhere *)(x + i) * b0 + *(const rg_quad_anywhere *)(x1 + i) * b1;
    } else
        for (int32_t i = 0; i < m; i += 4) *(rg_quad_anywhere *)(u + i) -= *(const rg_quad_anywhere *)(x + i) * b0;
}

RG_WITHIN double sum_of(const rg_quad *s) { return ((*s)[0] + (*s)[1]) + ((*s)[2] + (*s)[3]); }

/* b[n] -= the n columns of x, `tall` apart, each times u[m]; n <= 4, m a multiple of four */
RG_WITHIN void subtract_products(const double *x, int32_t tall, int32_t m, int32_t n, const double *u, double *b)
{
    rg_quad s0 = {0}, s1 = {0}, s2 = {0}, s3 = {0};
    if (n == 4) {
        const double *x1 = x + tall, *x2 = x1 + tall, *x3 = x2 + tall;
        for (int32_t i = 0; i < m; i += 4) {
            const rg_quad v = *(const rg_quad_anywhere *)(u + i);
            s0 += *(const rg_quad_anywhere *)(x + i) * v;
            s1 += *(const rg_quad_anywhere *)(x1 + i) * v;
            s2 += *(const rg_quad_anywhere *)(x2 + i) * v;
            s3 += *(const rg_quad_anywhere *)(x3 + i) * v;
        }
        b[3] -= sum_of(&s3);
    } else if (n == 3) {
        const double *x1 = x + tall, *x2 = x1 + tall;
        for (int32_t i = 0; i < m; i += 4) {
            const rg_quad v = *(const rg_quad_anywhere *)(u + i);
            s0 += *(const rg_quad_anywhere *)(x + i) * v;
            s1 += *(const rg_quad_anywhere *)(x1 + i) * v;
            s2 += *(const rg_quad_anywhere *)(x2 + i) * v;
        }
    } else if (n == 2) {
        const double *x1 = x + tall;
        for (int32_t i = 0; i < m; i += 4) {
            const rg_quad v = *(const rg_quad_anywhere *)(u + i);
            s0 += *(const rg_quad_anywhere *)(x + i) * v;
            s1 += *(const rg_quad_anywhere *)(x1 + i) * v;
        }
    } else
        for (int32_t i = 0; i < m; i += 4)
            s0 += *(const rg_quad_anywhere *)(x + i) * *(const rg_quad_anywhere *)(u + i);
    b[0] -= sum_of(&s0);
    if (n > 1) b[1] -= sum_of(&s1);
    if (n > 2) b[2] -= sum_of(&s2);
}

/* L y = b within a panel: u[tall] is b at the panel's own rows, 0 below; out, y and what goes off the rows below. */
RG_WIDE static void solve_panel(const double *x, int32_t tall, int32_t wide, double *u)
{
    for (int32_t first = 0; first < wide; first += 4) {
        const int32_t n = wide - first < 4 ? wide - first : 4;
        const double *block = x + (size_t)first * (size_t)tall + first;
        double *own = u + first;
        for (int32_t j = 0; j < n; j++) {
            const double *col = block + (size_t)j * (size_t)tall;
            own[j] *= col[j];
            for (int32_t i = j + 1; i < 4; i++) own[i] -= col[i] * own[j]; /* with a rest of four, rows below too */
        }
        subtract_columns(block + 4, tall, tall - first - 4, n, own, own + 4);
    }
}

/* L^T y = b within a panel: u[tall] is b at its own rows and y below; out, y. */
RG_WIDE static void solve_panel_t(const double *x, int32_t tall, int32_t wide, double *u)
{
    for (int32_t first = (wide - 1) & ~3; first >= 0; first -= 4) {
        const int32_t n = wide - first < 4 ? wide - first : 4;
        const double *block = x + (size_t)first * (size_t)tall + first;
        double *own = u + first;
        subtract_products(block + 4, tall, tall - first - 4, n, own + 4, own);
        for (int32_t j = n - 1; j >= 0; j--) {
            const double *col = block + (size_t)j * (size_t)tall;
            for (int32_t i = j + 1; i < 4; i++) own[j] -= col[i] * own[i];
            own[j] *= col[j];
        }
    }
}

void rg_supernodal_solve(rg_supernodal *L, double *b)
{
    double *y = L->b, *u = L->update;
    for (int32_t i = 0; i < L->S.n; i++) y[L->S.place[i]] = b[i];
    for (int32_t s = 0; s < L->S.count; s++) {
        const int32_t tall = L->S.start[s + 1] - L->S.start[s], wide = L->S.column[s + 1] - L->S.column[s];
        const int32_t stride = rg_symbolic_stride(&L->S, s);
        const int32_t *row = L->S.row + L->S.start[s];
        double *own = y + L->S.column[s];
        memcpy(u, own, (size_t)wide * sizeof *u);
        memset(u + wide, 0, (size_t)(stride - wide) * sizeof *u);
        solve_panel(L->x + L->S.panel[s], stride, wide, u);
        memcpy(own, u, (size_t)wide * sizeof *u);
        for (int32_t i = wide; i < tall; i++) y[row[i]] += u[i];
    }
    for (int32_t s = L->S.count - 1; s >= 0; s--) {
        const int32_t tall = L->S.start[s + 1] - L->S.start[s], wide = L->S.column[s + 1] - L->S.column[s];
        const int32_t stride = rg_symbolic_stride(&L->S, s);
        const int32_t *row = L->S.row + L->S.start[s];
        double *own = y + L->S.column[s];
        memcpy(u, own, (size_t)wide * sizeof *u);
        for (int32_t i = wide; i < tall; i++) u[i] = y[row[i]];
        for (int32_t i = tall; i < stride; i++) u[i] = 0;
        solve_panel_t(L->x + L->S.panel[s], stride, wide, u);
        memcpy(own, u, (size_t)wide * sizeof *u);
    }
    for (int32_t i = 0; i < L->S.n; i++) b[i] = y[L->S.place[i]];
}

void rg_supernodal_clear(rg_supernodal *L)
{
    memset(L->x, 0, (size_t)L->S.panel[L->S.count] * sizeof *L->x);
}

/* Where row r stands in supernode s, from `low` on; -1: it does not. */
static int32_t stands(const rg_symbolic *S, int32_t s, int32_t low, int32_t r)
{
    int32_t high = S->start[s + 1];
    while (high - low > 1) {
        const int32_t middle = low + (high - low) / 2;
        if (S->row[middle] <= r) low = middle;
        else high = middle;
    }
    return S->row[low] == r ? low : -1;
}

/* Columns of one supernode have their rows in common: each row is looked for once in each. */
int rg_supernodal_find(const rg_supernodal *L, int32_t n, const int32_t *column, int32_t *order, int32_t *at,
                       int32_t *slot)
{
    const rg_symbolic *S = &L->S;
    for (int32_t i = 0; i < n; i++) {
        int32_t k = i;
        for (; k > 0 && S->place[column[order[k - 1]]] > S->place[column[i]]; k--) order[k] = order[k - 1];
        order[k] = i;
    }
    for (int32_t a = 0, last = -1; a < n; a++) {
        const int32_t c = S->place[column[order[a]]], s = S->of[c];
        for (int32_t b = a; s != last && b < n; b++) {
            at[b] = stands(S, s, b > a ? at[b - 1] : S->start[s], S->place[column[order[b]]]);
            if (at[b] < 0) return 0;
        }
        last = s;
        const int32_t base = S->panel[s] + (c - S->column[s]) * rg_symbolic_stride(S, s) - S->start[s];
        for (int32_t b = a; b < n; b++) {
            const int32_t i = order[a] > order[b] ? order[a] : order[b], j = order[a] > order[b] ? order[b] : order[a];
            slot[i * (i + 1) / 2 + j] = base + at[b];
        }
    }
    return 1;
}

int32_t rg_supernodal_slot(const rg_supernodal *L, int32_t i, int32_t j)
{
    const rg_symbolic *S = &L->S;
    const int32_t a = S->place[i], b = S->place[j], r = a > b ? a : b, c = a > b ? b : a;
    const int32_t s = S->of[c], at = stands(S, s, S->start[s], r);
    assert(at >= 0);
    return S->panel[s] + (c - S->column[s]) * rg_symbolic_stride(S, s) + at - S->start[s];
}

/* The room that `multiply` needs at the most. */
static size_t room_for_updates(const rg_symbolic *S)
{
    size_t most = 0;
    for (int32_t s = 0; s < S->count; s++) {
        int32_t tall = S->start[s + 1] - S->start[s];
        const int32_t *row = S->row + S->start[s];
        for (int32_t i = 0, j; i < tall; i = j) { /* runs of rows in one supernode */
            for (j = i; j < tall && S->of[row[j]] == S->of[row[i]]; j++) {}
            size_t room = (size_t)(tall - i + 4) * (size_t)(j - i + 4);
            if (room > most) most = room;
        }
    }
    return most;
}

rg_status rg_supernodal_init(rg_supernodal *L, const rg_memory *mem, int32_t n, const int32_t *start,
                             const int32_t *row)
{
    memset(L, 0, sizeof *L);
    rg_status s = rg_symbolic_init(&L->S, mem, n, start, row);
    if (s != RG_OK) return s;
    const size_t count = (size_t)L->S.count;
    s = RG_MEM_ARRAYS(mem, RG_ARRAY(L->x, (size_t)L->S.panel[count] + RG_SYMBOLIC_PAD),
                      RG_ARRAY(L->head, count), RG_ARRAY(L->next, count), RG_ARRAY(L->done, count),
                      RG_ARRAY(L->map, (size_t)n), RG_ARRAY(L->place, (size_t)n), RG_ARRAY(L->b, (size_t)n),
                      RG_ARRAY(L->update, room_for_updates(&L->S) + RG_SYMBOLIC_PAD));
    if (s != RG_OK) rg_supernodal_free(L);
    return s;
}

void rg_supernodal_free(rg_supernodal *L)
{
    if (!L->S.mem.resize) return;
    RG_MEM_FREE(&L->S.mem, L->x, L->head, L->next, L->done, L->map, L->place, L->update, L->b);
    rg_symbolic_free(&L->S);
    memset(L, 0, sizeof *L);
}
