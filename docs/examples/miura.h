/* A Miura-ori of n x n parallelograms with an angle of 60 degrees, as arrays: what a program of one's own has instead
 * of a file. */
#ifndef MIURA_H
#define MIURA_H

#include <rigami.h>
#include <stdlib.h>

enum { MIURA_MOST = 64 };
typedef struct miura {
    double at[(MIURA_MOST + 1) * (MIURA_MOST + 1)][2];
    int32_t ends[2 * MIURA_MOST * (MIURA_MOST + 1)][2];
    char assignment[2 * MIURA_MOST * (MIURA_MOST + 1)];
} miura;

/* Zigzag i runs along x, and zigzags are mountain and valley by turns. The straight lines at j run along y, and their
 * pieces are by turns too: at each vertex the piece between the acute angles is other than the zigzag, which is
 * Maekawa's theorem. */
static rg_drawing miura_draw(miura *m, int n)
{
    rg_drawing d = rg_drawing_default();
    int e = 0;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++) {
            const int v = i * (n + 1) + j;
            m->at[v][0] = j * 0.8660254037844386;
            m->at[v][1] = i + (j % 2 ? 0.5 : 0);
            if (j < n) {
                m->ends[e][0] = v, m->ends[e][1] = v + 1;
                m->assignment[e++] = i == 0 || i == n ? 'B' : i % 2 ? 'M' : 'V';
            }
            if (i < n) {
                m->ends[e][0] = v, m->ends[e][1] = v + n + 1;
                m->assignment[e++] = j == 0 || j == n ? 'B' : (i + j) % 2 ? 'V' : 'M';
            }
        }
    d.vertices = (n + 1) * (n + 1), d.at = (const double(*)[2])m->at;
    d.edges = e, d.ends = (const int32_t(*)[2])m->ends, d.assignment = m->assignment;
    return d;
}

#endif
