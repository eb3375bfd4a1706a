#include "verify/isometry.h"
#include "base/classes.h"

#include <stdlib.h>
#include <string.h>

/* Over the sheet's size, or radians: places and patterns are written with all their digits. */
static const double EXACT = 1e-8;
/* Radians: a narrow facet's normal has fewer. */
static const double SAME_ANGLE = 1e-6;
/* Sine of a corner of the border; what bends less was drawn straight. */
static const double STRAIGHT = 1e-4;
/* Radians: beyond half a turn by rounding of whoever drew it, and on the wrong side of flat at the end. */
static const double BEYOND = 0.1 * RG_DEG, WRONG_SIDE = 0.5 * RG_DEG;
/* What shall end flat does within 1 % of half a turn. */
static const double FLAT_WITHIN = 0.01 * RG_PI;
/* Radians from one frame to the next: more is not a way, but two states. */
static const double LEAP = RG_PI / 2;
/* Percent: of a path that goes on, and of percent found again from the angles. */
static const double PERCENT = 1e-6;

static double larger(double most, double value) { return value <= most || isnan(most) ? most : value; }

static const rg_vec2 *flat_of(const rg_record *r, int32_t k) { return r->flat + (size_t)k * (size_t)r->nv; }
static const rg_vec3 *places_of(const rg_record *r, int32_t k) { return r->x + (size_t)k * (size_t)r->nv; }
static const double *angles_of(const rg_record *r, int32_t k) { return r->rho + (size_t)k * (size_t)r->ne; }

static double area_of(const rg_record *r, const rg_vec2 *X, int32_t f)
{
    double sum = 0;
    for (int32_t j = r->start[f] + 1; j + 1 < r->start[f + 1]; j++)
        sum += rg_vec2_turn(X[r->corner[r->start[f]]], X[r->corner[j]], X[r->corner[j + 1]]) / 2;
    return sum;
}

/* -------------------------------------------------------------------------------- pattern ---- */

typedef struct way { int32_t from, to, face, edge; } way;

static int by_ends(const void *a, const void *b)
{
    const way *p = a, *q = b;
    if (p->from != q->from) return p->from < q->from ? -1 : 1;
    if (p->to != q->to) return p->to < q->to ? -1 : 1;
    return p->face < q->face ? -1 : p->face > q->face;
}

static int32_t find(const way *list, int32_t n, int32_t from, int32_t to, int32_t *times)
{
    const way key = {from, to, -1, -1};
    int32_t low = 0, high = n;
    while (low < high) {
        const int32_t mid = low + (high - low) / 2;
        if (by_ends(&list[mid], &key) < 0) low = mid + 1;
        else high = mid;
    }
    *times = 0;
    for (int32_t i = low; i < n && list[i].from == from && list[i].to == to; i++) ++*times;
    return *times ? list[low].face : -1;
}

/* Every side of a facet is an edge of it, once; every edge has two facets, or one and is the border. */
static rg_status find_sides(rg_record *r, rg_faults *all)
{
    const int32_t n = r->start[r->nf];
    int32_t used = 0;
    way *list = rg_mem_array(&r->mem, (size_t)n, sizeof *list);
    if (!list) return RG_ENOMEM;
    for (int32_t f = 0; f < r->nf; f++)
        for (int32_t j = r->start[f]; j < r->start[f + 1]; j++)
            list[j] = (way){r->corner[j], r->corner[j + 1 < r->start[f + 1] ? j + 1 : r->start[f]], f, -1};
    qsort(list, (size_t)n, sizeof *list, by_ends);
    for (int32_t e = 0; e < r->ne; e++) {
        int32_t left, right;
        r->side[e][0] = find(list, n, r->edge[e][0], r->edge[e][1], &left);
        r->side[e][1] = find(list, n, r->edge[e][1], r->edge[e][0], &right);
        used += left + right;
        if (left > 1 || right > 1 || left + right != (r->assignment[e] == 'B' ? 1 : 2))
            rg_faults_add(all, -1, r->side[e][0], r->side[e][1], "edge %d has %d facets, %s", (int)e,
                          (int)(left + right),
                          r->assignment[e] == 'B' ? "and is border" : "and is a crease");
    }
    if (used != n) rg_faults_add(all, -1, -1, -1, "%d sides of facets are no edges", (int)(n - used));
    rg_mem_free(&r->mem, list);
    return RG_OK;
}

/* ring[borders]: the border's vertices in their order, counter-clockwise; 0: it is not one closed line. */
static int32_t find_ring(const rg_record *r, int32_t *next, int32_t *ring)
{
    int32_t borders = 0, first = -1, n = 0;
    for (int32_t v = 0; v < r->nv; v++) next[v] = -1;
    for (int32_t e = 0; e < r->ne; e++) {
        if (r->assignment[e] != 'B') continue;
        const int left = r->side[e][0] >= 0;
        const int32_t from = r->edge[e][!left], to = r->edge[e][left];
        if (next[from] >= 0) return 0;
        next[from] = to;
        first = from;
        borders++;
    }
    for (int32_t v = first; v >= 0 && n < borders; v = next[v]) {
        ring[n++] = v;
        if (next[v] == first) break;
    }
    return n == borders && n >= 3 ? n : 0;
}

/* One piece: facets reached over creases, and Euler's number of a disk. */
static rg_status check_piece(const rg_record *r, rg_faults *all)
{
    int32_t *part, vertices = 0, parts = r->nf;
    unsigned char *used;
    const rg_status s = RG_MEM_ARRAYS(&r->mem, RG_ARRAY(part, (size_t)r->nf), RG_ARRAY(used, (size_t)r->nv));
    if (s != RG_OK) return s;
    for (int32_t f = 0; f < r->nf; f++) part[f] = f;
    for (int32_t e = 0; e < r->ne; e++) {
        used[r->edge[e][0]] = used[r->edge[e][1]] = 1;
        int32_t a = r->side[e][0], b = r->side[e][1];
        if (a < 0 || b < 0) continue;
        a = rg_class_of(part, a), b = rg_class_of(part, b);
        if (a != b) part[a] = b, parts--;
    }
    for (int32_t v = 0; v < r->nv; v++) vertices += used[v];
    if (parts != 1 || vertices != r->nv || r->nv - r->ne + r->nf != 1)
        rg_faults_add(all, -1, -1, -1, "the pattern is not one sheet without holes");
    RG_MEM_FREE(&r->mem, part, used);
    return RG_OK;
}

rg_status rg_isometry_pattern(rg_record *r, rg_faults *all, int *whole)
{
    const int32_t before = all->count;
    rg_status s = find_sides(r, all);
    if (s == RG_OK) s = check_piece(r, all);
    for (int32_t f = 0; s == RG_OK && f < r->nf; f++)
        if (!(area_of(r, r->X, f) > 0)) rg_faults_add(all, -1, f, -1, "has no area");
    *whole = all->count == before;
    return s;
}

/* --------------------------------------------------------------------------- one frame ---- */

typedef struct border {
    int32_t n, *ring, *next;
    unsigned char *corner; /* [n] */
    double area;
} border;

static double ring_area(const border *b, const rg_vec2 *X)
{
    double sum = 0;
    for (int32_t i = 1; i + 1 < b->n; i++) sum += rg_vec2_turn(X[b->ring[0]], X[b->ring[i]], X[b->ring[i + 1]]) / 2;
    return sum;
}

static rg_status find_border(const rg_record *r, border *b)
{
    memset(b, 0, sizeof *b);
    if (RG_MEM_ARRAYS(&r->mem, RG_ARRAY(b->ring, (size_t)r->ne), RG_ARRAY(b->next, (size_t)r->nv),
                      RG_ARRAY(b->corner, (size_t)r->ne)) != RG_OK) return RG_ENOMEM;
    b->n = find_ring(r, b->next, b->ring);
    for (int32_t i = 0; i < b->n; i++) {
        const rg_vec2 p = r->X[b->ring[(i + b->n - 1) % b->n]], q = r->X[b->ring[i]], s = r->X[b->ring[(i + 1) % b->n]];
        const rg_vec2 u = rg_vec2_sub(q, p), v = rg_vec2_sub(s, q);
        b->corner[i] = !(fabs(rg_vec2_cross(u, v)) <= STRAIGHT * rg_vec2_length(u) * rg_vec2_length(v) &&
                         rg_vec2_dot(u, v) > 0);
    }
    b->area = b->n ? ring_area(b, r->X) : 0;
    return RG_OK;
}

/* How far x is from the border between the corners on both sides of place i. */
static double off_border(const rg_record *r, const border *b, int32_t i, rg_vec2 x)
{
    int32_t k = i;
    double least = INFINITY;
    do k = (k + b->n - 1) % b->n;
    while (!b->corner[k] && k != i);
    const int32_t first = k;
    do {
        const rg_vec2 p = r->X[b->ring[k]], e = rg_vec2_sub(r->X[b->ring[(k + 1) % b->n]], p);
        const double n = rg_vec2_length(e), t = fmin(1, fmax(0, rg_vec2_dot(e, rg_vec2_sub(x, p)) / (n * n)));
        const double d = rg_vec2_length(rg_vec2_sub(x, (rg_vec2){p.x + t * e.x, p.y + t * e.y}));
        least = fmin(least, d);
        k = (k + 1) % b->n;
    } while (!b->corner[k] && k != first);
    return least;
}

/* The border is the border given, with its corners where they were, and facets fill it: all have area, and together its
 * own. A map of a sheet that turns no facet over and keeps the border covers every point once. */
static void check_sheet(const rg_record *r, const border *b, int32_t k, rg_faults *all, rg_isometry *found)
{
    const rg_vec2 *X = flat_of(r, k);
    double most = 0, sum = 0;
    for (int32_t i = 0; i < b->n; i++) {
        const int32_t v = b->ring[i], w = b->ring[(i + 1) % b->n];
        double d = rg_vec2_length(rg_vec2_sub(X[v], r->X[v]));
        if (!b->corner[i] && d > 0) d = off_border(r, b, i, X[v]);
        most = larger(most, d / r->size);
        const rg_vec2 e = rg_vec2_sub(X[w], X[v]), was = rg_vec2_sub(r->X[w], r->X[v]);
        if (!(rg_vec2_dot(e, was) > 0))
            rg_faults_add(all, k, -1, -1, "vertices %d and %d of the border have changed places", (int)v, (int)w);
    }
    for (int32_t f = 0; f < r->nf; f++) {
        const double a = area_of(r, X, f);
        sum += a;
        if (!(a > 0)) rg_faults_add(all, k, f, -1, "has no area in the pattern of this frame");
    }
    found->sheet = larger(found->sheet, most);
    if (!(most <= EXACT))
        rg_faults_add(all, k, -1, -1, "the border of its pattern is off the border given by %.2g of the sheet", most);
    if (!(fabs(sum / b->area - 1) <= EXACT))
        rg_faults_add(all, k, -1, -1, "its facets do not fill the sheet, but %.9g of it", sum / b->area);
}

static void check_facets(const rg_record *r, int32_t k, rg_record_place *place, rg_faults *all, rg_isometry *found)
{
    for (int32_t f = 0; f < r->nf; f++) {
        double off;
        place[f] = rg_record_fit(r, k, f, &off);
        off /= r->size;
        found->rigid = larger(found->rigid, off);
        if (!(off <= EXACT)) rg_faults_add(all, k, f, -1, "is not rigid: a corner is off by %.2g of the sheet", off);
    }
}

/* The facets on the left and right turn towards each other's fronts in a valley. */
static void check_angles(const rg_record *r, int32_t k, const rg_record_place *place, rg_faults *all,
                         rg_isometry *found)
{
    const rg_vec3 *x = places_of(r, k);
    const double *rho = angles_of(r, k);
    for (int32_t e = 0; e < r->ne; e++) {
        const int32_t left = r->side[e][0], right = r->side[e][1];
        if (left < 0 || right < 0) continue;
        const rg_vec3 d = rg_vec3_sub(x[r->edge[e][1]], x[r->edge[e][0]]), n = place[right].R.c[2],
            m = place[left].R.c[2];
        const double is = atan2(rg_vec3_dot(rg_vec3_cross(n, m), d) / rg_vec3_length(d), rg_vec3_dot(n, m));
        const double off = fabs(remainder(is - rho[e], 2 * RG_PI));
        found->angle = larger(found->angle, off);
        if (!(off <= SAME_ANGLE))
            rg_faults_add(all, k, left, right, "are folded by %.6g degrees by their places, but by %.6g by the file",
                          is / RG_DEG, rho[e] / RG_DEG);
        if (!(fabs(rho[e]) <= RG_PI + BEYOND))
            rg_faults_add(all, k, left, right, "are folded by %.6g degrees, more than half a turn", rho[e] / RG_DEG);
    }
}

/* ---------------------------------------------------------------------------------- vertices ---- */

typedef struct spoke { double at; int32_t edge, to; } spoke;

static int by_angle(const void *a, const void *b)
{
    const spoke *p = a, *q = b;
    return p->at < q->at ? -1 : p->at > q->at;
}

typedef struct wheels { int32_t *start, *edge; spoke *spoke; unsigned char *rim; } wheels;

static rg_status find_wheels(const rg_record *r, wheels *w)
{
    memset(w, 0, sizeof *w);
    if (RG_MEM_ARRAYS(&r->mem, RG_ARRAY(w->start, (size_t)r->nv + 2), RG_ARRAY(w->edge, 2 * (size_t)r->ne),
                      RG_ARRAY(w->spoke, (size_t)r->ne), RG_ARRAY(w->rim, (size_t)r->nv)) != RG_OK) return RG_ENOMEM;
    for (int32_t e = 0; e < r->ne; e++)
        for (int end = 0; end < 2; end++) {
            w->start[r->edge[e][end] + 2]++;
            if (r->assignment[e] == 'B') w->rim[r->edge[e][end]] = 1;
        }
    for (int32_t v = 0; v < r->nv; v++) w->start[v + 2] += w->start[v + 1];
    for (int32_t e = 0; e < r->ne; e++)
        for (int end = 0; end < 2; end++) w->edge[w->start[r->edge[e][end] + 1]++] = e;
    return RG_OK;
}

/* Once round a vertex, over each of its creases by its angle, one comes back to where one was. */
static void check_closed(const rg_record *r, int32_t k, const wheels *w, rg_faults *all, rg_isometry *found)
{
    const rg_vec2 *X = flat_of(r, k);
    const double *rho = angles_of(r, k);
    for (int32_t v = 0; v < r->nv; v++) {
        const int32_t n = w->start[v + 1] - w->start[v];
        if (w->rim[v]) continue;
        for (int32_t i = 0; i < n; i++) {
            const int32_t e = w->edge[w->start[v] + i], to = r->edge[e][r->edge[e][0] == v];
            w->spoke[i] = (spoke){atan2(X[to].y - X[v].y, X[to].x - X[v].x), e, to};
        }
        qsort(w->spoke, (size_t)n, sizeof *w->spoke, by_angle);
        rg_mat3 M = rg_mat3_identity();
        for (int32_t i = 0; i < n; i++) {
            const double c = cos(rho[w->spoke[i].edge]), s = sin(rho[w->spoke[i].edge]), q = 1 - c;
            const double x = cos(w->spoke[i].at), y = sin(w->spoke[i].at);
            const rg_mat3 turn = {{{c + x * x * q, x * y * q, -y * s}, {x * y * q, c + y * y * q, x * s},
                                   {y * s, -x * s, c}}};
            M = rg_mat3_mul(M, turn);
        }
        const double a = M.c[1].z - M.c[2].y, b = M.c[2].x - M.c[0].z, d = M.c[0].y - M.c[1].x;
        const double off = atan2(sqrt(a * a + b * b + d * d) / 2, (M.c[0].x + M.c[1].y + M.c[2].z - 1) / 2);
        found->closed = larger(found->closed, off);
        if (!(off <= EXACT))
            rg_faults_add(all, k, -1, -1, "vertex %d does not close: %.2g radians are left", (int)v, off);
    }
}

/* -------------------------------------------------------------------------------------- path ---- */

static double side_of(char assignment) { return assignment == 'V' ? 1 : assignment == 'M' ? -1 : 0; }

/* Which way it goes: 1, or -1 with mountains and valleys exchanged, as for --to -100. */
static double way_of(const rg_record *r)
{
    double sum = 0;
    for (int32_t e = 0; e < r->ne; e++) sum += r->target[e] * angles_of(r, r->frames - 1)[e];
    return sum < 0 ? -1 : 1;
}

/* Mean over what is aimed at of 100 angle / aim, each at most 100. */
static double percent_of(const rg_record *r, int32_t k, double as)
{
    double sum = 0;
    int32_t n = 0;
    for (int32_t e = 0; e < r->ne; e++) {
        if (r->target[e] == 0) continue;
        sum += fmin(100, 100 * as * angles_of(r, k)[e] / r->target[e]);
        n++;
    }
    return n ? sum / n : NAN;
}

static int is_flat(const rg_record *r, int32_t k)
{
    for (int32_t e = 0; e < r->ne; e++)
        if (!(fabs(angles_of(r, k)[e]) <= SAME_ANGLE)) return 0;
    return 1;
}

/* The frames come in the order in which they are passed: percent never goes back, it is that of the angles where the
 * motion begins flat, and no crease turns by more than a quarter at once. */
static void check_path(const rg_record *r, rg_faults *all, rg_isometry *found)
{
    const int begins_flat = is_flat(r, 0);
    const double as = way_of(r);
    double before = NAN; /* percent of the frame before */
    if (r->after_all)
        rg_faults_add(all, r->frames - 1, -1, -1, "it is the last, and has states between it and another one");
    for (int32_t k = 0; k < r->frames; k++) {
        const double percent = percent_of(r, k, as);
        if (begins_flat && !isnan(r->percent[k]) && !isnan(percent) && !(fabs(percent - r->percent[k]) <= PERCENT))
            rg_faults_add(all, k, -1, -1, "is %.6g %% folded by its angles, not %.6g %%", percent, r->percent[k]);
        if (r->percent[k] < before - PERCENT)
            rg_faults_add(all, k, -1, -1, "the path goes back, from %.6g %% to %.6g %%", before, r->percent[k]);
        if (!isnan(r->percent[k])) before = r->percent[k];
        if (k == 0) continue;
        for (int32_t e = 0; e < r->ne; e++) {
            const double change = fabs(angles_of(r, k)[e] - angles_of(r, k - 1)[e]);
            if (side_of(r->assignment[e]) != 0 && change > found->leap) found->leap = change;
            if (!(change <= LEAP))
                rg_faults_add(all, k, r->side[e][0], r->side[e][1],
                              "leap: the crease between them turns by %.4g degrees from the frame before",
                              change / RG_DEG);
        }
    }
}

/* Mountains are mountains and valleys valleys at the end, or all exchanged; on the way it is told, and so it is of
 * those that nothing is asked of, which may end as they come. What is asked to be flat is so at the end, whatever its letter;
 * a file without any angle asks by its letters. */
static void check_assignments(const rg_record *r, rg_faults *all, rg_isometry *found)
{
    const double *end = angles_of(r, r->frames - 1), as = way_of(r), percent = percent_of(r, r->frames - 1, as);
    for (int32_t e = 0; e < r->ne; e++) {
        const int flat = r->target[e] == 0 && !r->open[e] && !isnan(percent);
        const double side = r->added[e] || flat ? 0 : as * side_of(r->assignment[e]);
        if (flat && side_of(r->assignment[e]) != 0 && percent >= 99 && !(fabs(end[e]) <= FLAT_WITHIN))
            rg_faults_add(all, r->frames - 1, r->side[e][0], r->side[e][1],
                          "the crease between them should end flat, and ends at %.4g degrees", end[e] / RG_DEG);
        for (int32_t k = 0; k < r->frames && side != 0; k++)
            found->wrong = larger(found->wrong, -side * angles_of(r, k)[e]);
        if (side == 0 || side * end[e] >= -WRONG_SIDE) continue;
        if (r->open[e] && isfinite(end[e])) found->open++;
        else
            rg_faults_add(all, r->frames - 1, r->side[e][0], r->side[e][1], "the %s between them ends at %.4g degrees",
                          r->assignment[e] == 'V' ? "valley" : "mountain", as * end[e] / RG_DEG);
    }
}

rg_status rg_isometry_frames(const rg_record *r, rg_faults *all, rg_isometry *found)
{
    border b;
    wheels w;
    rg_record_place *place = rg_mem_array(&r->mem, (size_t)r->nf, sizeof *place);
    *found = (rg_isometry){0};
    rg_status s = find_border(r, &b), t = find_wheels(r, &w);
    if (s == RG_OK) s = place ? t : RG_ENOMEM;
    if (s == RG_OK && b.n == 0) rg_faults_add(all, -1, -1, -1, "the border is not one closed line");
    for (int32_t k = 0; s == RG_OK && b.n > 0 && k < r->frames; k++) {
        check_sheet(r, &b, k, all, found);
        check_facets(r, k, place, all, found);
        check_angles(r, k, place, all, found);
        check_closed(r, k, &w, all, found);
    }
    if (s == RG_OK) {
        check_path(r, all, found);
        check_assignments(r, all, found);
    }
    RG_MEM_FREE(&r->mem, b.ring, b.next, b.corner, w.start, w.edge, w.spoke, w.rim, place);
    return s;
}
