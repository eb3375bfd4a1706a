/* folded.h -- patterns with fold angles that are known to close, and rotations written out, for tests.  Include after draw.h. */
#ifndef FOLDED_H
#define FOLDED_H

#include "draw.h"
#include "mesh/mesh.h"

/* Plain arrays: nothing here uses the library's vectors. */
typedef struct turn3 { double a[3][3]; } turn3; /* a[row][column] */

static inline turn3 times(turn3 p, turn3 q)
{
    turn3 r = {{{0}}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) r.a[i][j] += p.a[i][k] * q.a[k][j];
    return r;
}

/* chi = R_x(rho) R_z(theta), written out. */
static inline turn3 chi(double rho, double theta)
{
    const turn3 X = {{{1, 0, 0}, {0, cos(rho), -sin(rho)}, {0, sin(rho), cos(rho)}}};
    const turn3 Z = {{{cos(theta), -sin(theta), 0}, {sin(theta), cos(theta), 0}, {0, 0, 1}}};
    return times(X, Z);
}

/* chi_1 ... chi_n */
static inline turn3 round_trip(int n, const double *rho, const double *theta)
{
    turn3 F = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int i = 0; i < n; i++) F = times(F, chi(rho[i], theta[i]));
    return F;
}

/* Largest difference from the identity. */
static inline double off_identity(turn3 F)
{
    double worst = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double d = fabs(F.a[i][j] - (i == j));
            if (!(d <= worst)) worst = d;
        }
    return worst;
}

/* The largest entry of chi_1 ... chi_n - I over the vertices, with the angles of the pattern X. */
static inline double unclosed(const rg_mesh *m, const rg_vec2 *X, const double *rho)
{
    double worst = 0;
    for (int32_t k = 0; k < m->M; k++) {
        const int32_t start = m->loop_start[k], n = m->loop_start[k + 1] - start, v = m->inner_vertex[k];
        turn3 F = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        double fold = 0, last = 0; /* of the crease before */
        for (int32_t i = 0; i <= n; i++) {
            const int32_t *e = m->edge[m->crease_edge[m->loop_crease[start + i % n]]];
            const rg_vec2 d = rg_vec2_sub(X[e[e[0] == v]], X[v]);
            const double angle = atan2(d.y, d.x);
            if (i) F = times(F, chi(fold, fmod(angle - last + 4 * RG_PI, 2 * RG_PI)));
            last = angle;
            fold = rho[m->loop_crease[start + i % n]];
        }
        const double off = off_identity(F);
        if (!(off <= worst)) worst = off;
    }
    return worst;
}

/* Fold angles of a flat-foldable vertex of degree 4 with sectors a, b, pi - a, pi - b, by t = tan of half the first one's:
 * opposite creases fold alike but for the sign of one, and the tangents of the half angles keep their ratio. mode 0: the
 * first and third have the same sign; mode 1: the second and fourth have. */
static inline void degree4(double a, double b, int mode, double t, double theta[4], double rho[4])
{
    const double sectors[4] = {a, b, RG_PI - a, RG_PI - b};
    const double ratio = mode == 0 ? -cos((a + b) / 2) / cos((a - b) / 2) : sin((a + b) / 2) / sin((a - b) / 2);
    for (int i = 0; i < 4; i++) theta[i] = sectors[i];
    rho[0] = 2 * atan(t);
    rho[2] = mode == 0 ? rho[0] : -rho[0];
    rho[1] = 2 * atan(ratio * t);
    rho[3] = mode == 0 ? -rho[1] : rho[1];
}

/* A Miura-ori of n x n parallelograms: zigzag columns, straight rows. An acute angle of alpha. */
static inline rg_pattern *draw_miura(int n, double alpha)
{
    rg_lines l = drawing();
    const double lean = 1 / tan(alpha);
    for (int r = 0; r <= n; r++)
        for (int c = 0; c <= n; c++) {
            const double x = 1.25 * c + (r % 2) * lean, up = 1.25 * c + !(r % 2) * lean;
            /* Even rows lean to the right: the acute angles lie beside the crease to the right there. */
            const int zigzag = c % 2 ? -1 : 1, right = r % 2 ? zigzag : -zigzag;
            if (c < n) draw(&l, r == 0 || r == n ? RG_BORDER : right > 0 ? RG_VALLEY : RG_MOUNTAIN, x, r, x + 1.25, r);
            if (r < n) draw(&l, c == 0 || c == n ? RG_BORDER : zigzag > 0 ? RG_VALLEY : RG_MOUNTAIN, x, r, up, r + 1);
        }
    return pattern_of(&l);
}

/* Its fold angles, zigzags at `zigzag`: tan(straight / 2) = cos(alpha) tan(zigzag / 2); at pi all are at pi. */
static inline void miura_angles(const rg_mesh *m, double alpha, double zigzag, double *rho)
{
    for (int32_t i = 0; i < m->N; i++) {
        const int32_t e = m->crease_edge[i];
        const int straight = fabs(m->X[m->edge[e][0]].y - m->X[m->edge[e][1]].y) < 0.5;
        const double angle = straight && zigzag < RG_PI ? 2 * atan(cos(alpha) * tan(zigzag / 2)) : zigzag;
        rho[i] = m->assignment[e] == RG_VALLEY ? angle : -angle;
    }
}

static inline rg_mesh mesh_of(const rg_pattern *p)
{
    rg_memory mem = rg_mem_default(NULL);
    rg_mesh m;
    rg_diag why = {0, ""};
    rg_status s = rg_mesh_from_pattern(p, &mem, &m, &why);
    if (s != RG_OK) print_error("%s\n", why.text);
    assert_int_equal(s, RG_OK);
    return m;
}

#endif
