#include "linalg/dense.h"
#include "base/lanes.h"

#include <math.h>

RG_WITHIN double sum_of(const rg_quad *s) { return ((*s)[0] + (*s)[1]) + ((*s)[2] + (*s)[3]); }

/* What `first` columns before take from the next n <= 4: u (columns of `room`, from row `first` on), written in full
 * fours. */
RG_WIDE static void updates(int32_t m, int32_t first, const double *A, size_t room, double *u)
{
    for (int32_t i = first; i < m; i += 8) {
        const double *p = A + i, *q = A + first;
        rg_quad c0 = {0}, c1 = {0}, c2 = {0}, c3 = {0}, d0 = {0}, d1 = {0}, d2 = {0}, d3 = {0};
        for (int32_t l = 0; l < first; l++, p += room, q += room) {
            const rg_quad v = *(const rg_quad_anywhere *)p, w = *(const rg_quad_anywhere *)(p + 4);
            c0 += v * q[0], d0 += w * q[0];
            c1 += v * q[1], d1 += w * q[1];
            c2 += v * q[2], d2 += w * q[2];
            c3 += v * q[3], d3 += w * q[3];
        }
        double *to = u + i;
        *(rg_quad_anywhere *)to = c0, *(rg_quad_anywhere *)(to + 4) = d0;
        *(rg_quad_anywhere *)(to + room) = c1, *(rg_quad_anywhere *)(to + room + 4) = d1;
        *(rg_quad_anywhere *)(to + 2 * room) = c2, *(rg_quad_anywhere *)(to + 2 * room + 4) = d2;
        *(rg_quad_anywhere *)(to + 3 * room) = c3, *(rg_quad_anywhere *)(to + 3 * room + 4) = d3;
    }
}

int rg_dense_factor(int32_t m, double *A, size_t room, double *update)
{
    for (int32_t first = 0; first < m; first += RG_DENSE_WIDE) {
        const int32_t last = first + RG_DENSE_WIDE < m ? first + RG_DENSE_WIDE : m;
        if (first > 0) {
            updates(m, first, A, room, update);
            for (int32_t j = first; j < last; j++)
                for (int32_t i = j; i < m; i++)
                    A[(size_t)j * room + (size_t)i] -= update[(size_t)(j - first) * room + (size_t)i];
        }
        for (int32_t j = first; j < last; j++) {
            double *col = A + (size_t)j * room;
            if (!(col[j] > 0)) return 0;
            const double root = sqrt(col[j]), inverse = 1 / root;
            col[j] = root;
            for (int32_t i = j + 1; i < m; i++) col[i] *= inverse;
            for (int32_t l = j + 1; l < last; l++) {
                double *next = A + (size_t)l * room;
                for (int32_t i = l; i < m; i++) next[i] -= col[i] * col[l];
            }
        }
    }
    return 1;
}

RG_WIDE void rg_dense_solve(int32_t m, const double *L, size_t room, double *b)
{
    for (int32_t j = 0; j < m; j++) {
        const double *col = L + (size_t)j * room;
        b[j] /= col[j];
        int32_t i = j + 1;
        for (; i + 4 <= m; i += 4) *(rg_quad_anywhere *)(b + i) -= *(const rg_quad_anywhere *)(col + i) * b[j];
        for (; i < m; i++) b[i] -= col[i] * b[j];
    }
    for (int32_t j = m - 1; j >= 0; j--) {
        const double *col = L + (size_t)j * room;
        rg_quad s = {0};
        double rest = 0;
        int32_t i = j + 1;
        for (; i + 4 <= m; i += 4) s += *(const rg_quad_anywhere *)(col + i) * *(const rg_quad_anywhere *)(b + i);
        for (; i < m; i++) rest += col[i] * b[i];
        b[j] = (b[j] - (sum_of(&s) + rest)) / col[j];
    }
}
