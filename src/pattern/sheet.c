#include "pattern/sheet.h"
#include "base/text.h"

#include <stdio.h>
#include <string.h>

/* A vertex that turns its line by more than this is a corner, however short the lines are. */
static const double STRAIGHT = 1 * RG_DEG;

static void refuse(rg_pattern_info *info, const rg_lines *lines, const char *what, rg_vec2 at)
{
    if (!info->is_disk) return; /* the first reason is the one to tell */
    info->is_disk = 0;
    at = rg_lines_own(lines, at, info->size);
    rg_text(info->not_disk, sizeof info->not_disk, "%s at (%.6g, %.6g)", what, at.x, at.y);
    const size_t n = strlen(info->not_disk);
    if (info->sheets > 1)
        rg_text(info->not_disk + n, sizeof info->not_disk - n,
                "; --sheet N takes one of the %d, in the order of the file", (int)info->sheets);
}

/* Is x within the outer border of a piece? It is when a ray from it crosses that border an odd number of times. */
static int encloses(const rg_graph *g, const rg_faces *f, int32_t piece, rg_vec2 x)
{
    int odd = 0;
    int32_t h = f->first[piece];
    do {
        const rg_vec2 a = g->X[rg_tail(g->E, h)], b = g->X[rg_head(g->E, h)];
        if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
        h = f->next[h];
    } while (h != f->first[piece]);
    return odd;
}

static int has_border(const rg_graph *g, const rg_faces *f, int32_t piece)
{
    int32_t h = f->first[piece];
    do {
        if (g->E[h >> 1].assignment == RG_BORDER) return 1;
        h = f->next[h];
    } while (h != f->first[piece]);
    return 0;
}

/* The outer border of each piece: its edges, its vertices. More than one piece, a vertex passed twice: not a disk. */
static void find_rim(const rg_graph *g, const rg_faces *f, unsigned char *rim, unsigned char *outer,
                     const rg_lines *lines, rg_pattern_info *info)
{
    int32_t sheet = -1, other = -1;
    for (int32_t k = 0; k < f->count; k++) {
        if (!(f->area[k] < 0)) continue;
        if (sheet < 0 || f->area[k] < f->area[sheet]) {
            other = sheet;
            sheet = k;
        } else if (other < 0) {
            other = k;
        }
    }
    for (int vertices = 0; vertices < 2; vertices++) /* what passes a line twice passes vertices so: first */
        for (int32_t k = 0; k < f->count; k++) {
            if (!(f->area[k] < 0)) continue;
            int32_t h = f->first[k];
            do {
                const int32_t v = rg_tail(g->E, h);
                unsigned char *passed = vertices ? &rim[v] : &outer[h >> 1];
                const char *what = vertices ? "the border touches itself" : "two parts hang together by one line only";
                if (*passed) refuse(info, lines, what, g->X[v]);
                *passed = 1;
                h = f->next[h];
            } while (h != f->first[k]);
        }
    if (other < 0) return;
    const rg_vec2 at = g->X[rg_tail(g->E, f->first[other])];
    refuse(info, lines, !encloses(g, f, sheet, at) ? "more than one piece of paper: another one"
                 : has_border(g, f, other) ? "a hole in the paper, with a corner"
                                           : "lines that hang together with nothing else, one of them", at);
}

/* Facets must be simple polygons, and nothing inside the sheet may be a border. */
static rg_status check_inside(const rg_graph *g, const rg_faces *f, const unsigned char *outer, const rg_lines *lines,
                              rg_pattern_info *info)
{
    if (!info->is_disk) return RG_OK; /* the reason is told already */
    int32_t *seen = rg_mem_array(&g->mem, (size_t)g->nv, sizeof *seen);
    if (!seen) return RG_ENOMEM;
    for (int32_t k = 0; k < f->count; k++) {
        if (f->area[k] < 0) continue;
        int cut_out = 1;
        int32_t h = f->first[k], twice = -1;
        do {
            const int32_t v = rg_tail(g->E, h);
            if (seen[v] == k + 1) twice = v;
            seen[v] = k + 1;
            if (g->E[h >> 1].assignment != RG_BORDER || outer[h >> 1]) cut_out = 0;
            h = f->next[h];
        } while (h != f->first[k]);
        if (cut_out) refuse(info, lines, "a hole in the paper, with a corner", g->X[rg_tail(g->E, h)]);
        if (twice >= 0) refuse(info, lines, "a facet touches itself", g->X[twice]);
    }
    for (int32_t e = 0; e < g->ne; e++)
        if (g->E[e].assignment == RG_BORDER && !outer[e])
            refuse(info, lines, "a slit in the paper (a border line inside)", g->X[g->E[e].v[0]]);
    rg_mem_free(&g->mem, seen);
    return RG_OK;
}

static int plain(char assignment) { return assignment == RG_UNASSIGNED; }

/* How far v is off the line from e's far end to f's. */
static double off_line(const rg_graph *g, int32_t v, const rg_edge *e, const rg_edge *f)
{
    const rg_vec2 a = g->X[e->v[e->v[0] == v]], b = g->X[f->v[f->v[0] == v]];
    return fabs(rg_vec2_turn(a, b, g->X[v])) / rg_vec2_length(rg_vec2_sub(b, a));
}

/* May edges e and f, which meet at v only with each other, become one? Writes what it is then to *joined. `tol`: how
 * far v may be off it. */
static int join(const rg_graph *g, int32_t v, const rg_edge *e, const rg_edge *f, double tol, rg_edge *joined)
{
    const rg_vec2 x = g->X[v], a = rg_vec2_sub(x, g->X[e->v[e->v[0] == v]]);
    const rg_vec2 b = rg_vec2_sub(g->X[f->v[f->v[0] == v]], x);
    const double turn = rg_vec2_cross(a, b);
    if (e->assignment != f->assignment && !plain(e->assignment) && !plain(f->assignment)) return 0;
    const int same = e->target == f->target || (isnan(e->target) && isnan(f->target));
    if (e->assignment == f->assignment && !plain(e->assignment) && !same && e->assignment != RG_BORDER) return 0;
    if (!(rg_vec2_dot(a, b) > 0) || !(off_line(g, v, e, f) <= tol)) return 0;
    if (!(fabs(turn) <= sin(STRAIGHT) * rg_vec2_length(a) * rg_vec2_length(b))) return 0;
    *joined = plain(e->assignment) ? *f : *e;
    joined->v[0] = e->v[e->v[0] == v];
    joined->v[1] = f->v[f->v[0] == v];
    return 1;
}

/* What is dissolved: number[e] < 0: edge e is a part of edge ~number[e] then; else its new number, once all are
 * dissolved. */
typedef struct melt {
    double *swell; /* [ne] at most how far what was dissolved before is off an edge */
    int32_t *number;
    unsigned char *drop, *joined, *changed; /* [ne] dropped, of several; [nv] its edges have changed */
} melt;

/* Every vertex with two edges only that can go. swell adds up, so that the many vertices of an arc, each hardly off its
 * neighbours' line, do not become one chord. */
static void dissolve_all(rg_graph *g, rg_star *star, double tol, melt *m)
{
    for (int32_t v = 0; v < g->nv; v++) {
        int32_t *at = star->edge + star->start[v];
        m->changed[v] = star->start[v + 1] - star->start[v] == 2;
        if (!m->changed[v] || at[0] < at[1]) continue;
        const int32_t first = at[1]; /* by number, not by angle */
        at[1] = at[0];
        at[0] = first;
    }
    for (int32_t v = 0; v < g->nv; v++) {
        const int32_t *at = star->edge + star->start[v];
        if (!m->changed[v] || at[0] == at[1]) continue;
        const int32_t e = at[0], f = at[1];
        rg_edge joined;
        const double before = fmax(m->swell[e], m->swell[f]);
        if (!join(g, v, &g->E[e], &g->E[f], tol - before, &joined) || joined.v[0] == joined.v[1]) continue;
        m->swell[e] = before + off_line(g, v, &g->E[e], &g->E[f]);
        g->E[e] = joined;
        m->drop[f] = m->joined[e] = 1;
        m->number[f] = ~e;
        const int32_t w = joined.v[1];
        int32_t *there = star->edge + star->start[w];
        for (int i = 0; m->changed[w] && i < 2; i++)
            if (there[i] == f) there[i] = e;
    }
}

/* The edge that e is a part of, with the way there made short. */
static int32_t stands_for(int32_t *number, int32_t e)
{
    int32_t last = e;
    while (number[last] < 0) last = ~number[last];
    while (number[e] < 0) {
        const int32_t next = ~number[e];
        number[e] = ~last;
        e = next;
    }
    return last;
}

/* The star follows, by the numbers that vertices and edges will have. A vertex is left out that no edge ends at any
 * more. */
static void follow(const rg_graph *g, rg_star *star, melt *m)
{
    const int32_t all = star->start[g->nv];
    int32_t n = 0, edges = 0, vertices = 0;
    for (int32_t e = 0; e < g->ne; e++) {
        if (!m->drop[e]) m->number[e] = edges++;
        for (int i = 0; m->joined[e] && !m->drop[e] && i < 2; i++) m->changed[g->E[e].v[i]] = 1;
    }
    for (int32_t v = 0, from = 0; v < g->nv; v++) {
        const int32_t to = star->start[v + 1], first = n;
        for (int32_t j = from; j < to; j++) {
            if (j + RG_SOON < all) rg_mem_soon(&m->number[star->edge[j + RG_SOON]]);
            const int32_t e = stands_for(m->number, star->edge[j]);
            if (m->changed[v] && g->E[e].v[0] != v && g->E[e].v[1] != v) continue; /* it was dissolved */
            star->edge[n++] = m->number[e];
        }
        from = to;
        if (n == first) continue;
        m->changed[vertices] = m->changed[v];
        star->start[++vertices] = n;
    }
}

static rg_status dissolve(rg_graph *g, rg_star *star, double tol)
{
    melt m;
    const size_t ne = (size_t)g->ne, nv = (size_t)g->nv;
    rg_status s = RG_MEM_ARRAYS(&g->mem, RG_ARRAY(m.swell, ne), RG_ARRAY(m.number, ne), RG_ARRAY(m.drop, ne),
                                RG_ARRAY(m.joined, ne), RG_ARRAY(m.changed, nv));
    if (s == RG_OK) {
        dissolve_all(g, star, tol, &m);
        follow(g, star, &m);
        s = rg_graph_compact(g, m.drop);
    }
    if (s == RG_OK) s = rg_star_sort(star, g->nv, g->X, g->E, m.changed);
    RG_MEM_FREE(&g->mem, m.swell, m.number, m.drop, m.joined, m.changed);
    return s;
}

/* Drawn as a crease but on the outside, drawn as a border but inside. */
static rg_status assign_border(rg_graph *g, const unsigned char *outer, rg_lines *lines, rg_pattern_info *info)
{
    int32_t mended = 0, first = 0;
    rg_vec2 at = {0, 0};
    for (int32_t e = 0; e < g->ne; e++) {
        rg_edge *edge = &g->E[e];
        if (!outer[e] && edge->assignment == RG_BORDER) edge->assignment = RG_CUT;
        if (!outer[e]) continue;
        if (edge->assignment != RG_BORDER && !mended++) {
            first = edge->where;
            at = g->X[edge->v[0]];
        }
        edge->assignment = RG_BORDER;
        edge->target = NAN;
    }
    info->lost_creases += mended;
    at = rg_lines_own(lines, at, g->size);
    if (!mended) return RG_OK;
    return rg_lines_warn(lines, first,
                         "%d creases on the outside of the sheet are taken for its border, the first from (%.6g, %.6g)",
                         (int)mended, at.x, at.y);
}

rg_status rg_sheet_from_graph(rg_graph *g, rg_walk *walk, double tol, rg_lines *lines, rg_pattern_info *info,
                              unsigned char **rim_out)
{
    const rg_faces *faces = &walk->faces;
    unsigned char *rim, *outer;
    rg_status s = RG_MEM_ARRAYS(&g->mem, RG_ARRAY(rim, (size_t)g->nv), RG_ARRAY(outer, (size_t)g->ne));
    info->is_disk = 1;
    info->not_disk[0] = 0;
    if (s == RG_OK) s = rg_walk_make(walk, &g->mem, g->nv, g->ne, g->X, g->E);
    if (s == RG_OK) {
        info->vertices = g->nv;
        info->edges = g->ne;
        for (int32_t k = 0; k < faces->count; k++) info->facets += !(faces->area[k] < 0);
        if (!g->ne) {
            info->is_disk = 0;
            rg_text(info->not_disk, sizeof info->not_disk, "no lines that enclose a sheet");
        }
        find_rim(g, faces, rim, outer, lines, info);
    }
    if (s == RG_OK) s = check_inside(g, faces, outer, lines, info);
    if (s == RG_OK) s = assign_border(g, outer, lines, info);
    if (s == RG_OK) s = dissolve(g, &walk->star, tol);
    RG_MEM_FREE(&g->mem, rim, outer);
    if (s != RG_OK) return s;
    *rim_out = rim = rg_mem_array(&g->mem, (size_t)g->nv, 1);
    if (!rim) return RG_ENOMEM;
    for (int32_t e = 0; e < g->ne; e++)
        if (g->E[e].assignment == RG_BORDER) rim[g->E[e].v[0]] = rim[g->E[e].v[1]] = 1;
    return RG_OK;
}
