#include "files/convert.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/settings.h"
#include "base/status.h"
#include "pattern/faces.h"
#include "pattern/planar.h"
#include "pattern/source.h"
#include "read/read.h"
#include "read/value.h"
#include "save/cp.h"
#include "save/dxf.h"
#include "save/fold.h"
#include "save/opx.h"
#include "save/svg.h"

#include <stdlib.h>
#include <string.h>

/* Ends nearer than this part of the size are one vertex of a FOLD file, unless asked otherwise: whoever converts a file
 * wants every line where it was, to the last digit that counts. */
static const double MERGE = 5e-10;
/* Faces that an other program listed are those found here if their areas add up to the same, but for rounding. */
static const double SAME_AREA = 1e-9;
/* Lines are there: half of the work. */
static const double LINES_READ = 0.5;

/* ----------------------------------------------------------------------------------- what a format can't hold ---- */

static rg_status lose(rg_lines *l, int32_t where, int32_t count, const char *format, const char *what)
{
    return count ? rg_lines_warn(l, where, "%s cannot hold %s (%d)", format, what, (int)count) : RG_OK;
}

static rg_status warn_of_losses(rg_lines *l, rg_format to, const char *name)
{
    int32_t unassigned = 0, cuts = 0, targets = 0, first[3] = {0, 0, 0};
    for (int32_t i = 0; i < l->count; i++) {
        const rg_line *q = &l->line[i];
        if (q->assignment == RG_UNASSIGNED && !unassigned++) first[0] = q->where;
        if (q->assignment == RG_CUT && !cuts++) first[1] = q->where;
        const int held = to == RG_FORMAT_SVG && q->assignment != RG_UNASSIGNED;
        if (isfinite(q->target) && !held && !targets++) first[2] = q->where;
    }
    rg_status s = RG_OK;
    if (to == RG_FORMAT_CP) s = lose(l, first[0], unassigned, name, "unassigned creases, they become auxiliary lines");
    if (s == RG_OK && to != RG_FORMAT_OPX)
        s = lose(l, first[1], cuts, name, "cuts of the folded model, they become auxiliary lines");
    if (s == RG_OK && to != RG_FORMAT_FOLD) s = lose(l, first[2], targets, name, "such fold angles");
    const int texts = (l->title != NULL) + (l->author != NULL) + (l->memo != NULL);
    const int more = (l->editor != NULL) + (l->reference != NULL);
    if (s == RG_OK && (to == RG_FORMAT_CP || to == RG_FORMAT_DXF))
        s = lose(l, 0, texts + more, name, "title, author and other texts");
    if (s == RG_OK && to == RG_FORMAT_SVG) s = lose(l, 0, more, name, "editor and reference");
    return s;
}

/* ------------------------------------------------------------------------------------------------------- faces ---- */

typedef struct plane {
    rg_graph g;
    rg_star star;
    rg_faces faces;
    rg_fold_sheet sheet;
    rg_vec2 *X;
    int32_t *E, *face_start, *face_vertex, *face_edge, *vertex_source, *edge_source;
    char *letter;
    double *angle, area;
} plane;

static void free_plane(plane *p, const rg_memory *mem)
{
    RG_MEM_FREE(mem, p->X, p->E, p->face_start, p->face_vertex, p->face_edge, p->letter, p->angle, p->vertex_source,
                p->edge_source);
    rg_graph_free(&p->g);
    rg_star_free(&p->star);
    rg_faces_free(&p->faces);
    memset(p, 0, sizeof *p);
}

/* The half-edges of a cycle without those that it runs there and back again. `half` has room for all of them. */
static int32_t without_spurs(const rg_faces *f, int32_t k, int32_t *half)
{
    int32_t n = 0, from = 0, h = f->first[k];
    do {
        if (n > 0 && half[n - 1] == (h ^ 1)) n--;
        else half[n++] = h;
        h = f->next[h];
    } while (h != f->first[k]);
    while (n - from >= 2 && half[from] == (half[n - 1] ^ 1)) from++, n--;
    memmove(half, half + from, (size_t)(n - from) * sizeof *half);
    return n - from;
}

static rg_status find_faces(plane *p, const rg_memory *mem)
{
    const int32_t ne = p->g.ne;
    const size_t faces = (size_t)p->faces.count, sides = 2 * (size_t)ne;
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(p->face_start, faces + 1), RG_ARRAY(p->face_vertex, sides),
                      RG_ARRAY(p->face_edge, sides)) != RG_OK) return RG_ENOMEM;
    for (int32_t k = 0, at = 0; k < p->faces.count; k++) {
        if (!(p->faces.area[k] > 0)) continue;
        const int32_t n = without_spurs(&p->faces, k, p->face_edge + at);
        if (n < 3) continue;
        for (int32_t i = at; i < at + n; i++) {
            p->face_vertex[i] = rg_tail(p->g.E, p->face_edge[i]);
            p->face_edge[i] /= 2;
        }
        p->area += p->faces.area[k];
        p->face_start[++p->sheet.nf] = at += n;
    }
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------- letters and angles ---- */

static rg_status letter_edges(plane *p, const rg_memory *mem)
{
    if (RG_MEM_ARRAYS(mem, RG_ARRAY(p->letter, (size_t)p->g.ne),
                      RG_ARRAY(p->angle, (size_t)p->g.ne)) != RG_OK) return RG_ENOMEM;
    for (int32_t e = 0; e < p->g.ne; e++) {
        const rg_edge *edge = &p->g.E[e];
        const char a = edge->assignment;
        const int inside = p->faces.area[p->faces.face[2 * e]] > 0 && p->faces.area[p->faces.face[2 * e + 1]] > 0;
        p->letter[e] = a == RG_CUT ? RG_FLAT : a == RG_BORDER && inside ? 'C' : a;
        if (isfinite(edge->target) && a != RG_BORDER && a != RG_FLAT && a != RG_CUT)
            p->angle[e] = rg_number_degrees(edge->target);
        else if (a == RG_MOUNTAIN || a == RG_VALLEY) p->angle[e] = NAN; /* free */
    }
    return RG_OK;
}

/* ----------------------------------------------------------------------------------------- numbers of the old frame
 * ---- */

/* Whether each line is an edge: where some are cut and as many lie on others, they are as many as they were, too. */
static int lines_are_edges(const plane *p, const rg_lines *l)
{
    int same = l->vertex && p->g.ne == l->count;
    for (int32_t e = 0; same && e < p->g.ne; e++) same = p->g.E[e].line == e;
    return same;
}

/* The number that each vertex had; 0: they were others. */
static int old_numbers(const plane *p, const rg_lines *l, int32_t *old)
{
    const size_t were = rg_value_count(rg_value_get(l->frame, "vertices_coords"));
    if (!lines_are_edges(p, l) || were != (size_t)p->g.nv) return 0;
    for (int32_t v = 0; v < p->g.nv; v++) old[v] = -1;
    for (int32_t e = 0; e < p->g.ne; e++)
        for (int i = 0; i < 2; i++) {
            int32_t *now = &old[p->g.E[e].v[i]];
            if (*now >= 0 && *now != l->vertex[2 * e + i]) return 0;
            *now = l->vertex[2 * e + i];
        }
    return 1;
}

/* Vertices in their old order where there is one. Lines that are all edges still are so in order. */
static rg_status number(plane *p, const rg_lines *l)
{
    const rg_memory *mem = &l->mem;
    int32_t *old;
    unsigned char *taken;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(p->X, (size_t)p->g.nv), RG_ARRAY(p->E, 2 * (size_t)p->g.ne),
                                RG_ARRAY(old, (size_t)p->g.nv), RG_ARRAY(taken, (size_t)p->g.nv));
    if (s == RG_OK) {
        int same = old_numbers(p, l, old);
        for (int32_t v = 0; same && v < p->g.nv; v++) same = old[v] >= 0 && !taken[old[v]]++;
        for (int32_t v = 0; !same && v < p->g.nv; v++) old[v] = v;
        for (int32_t v = 0; v < p->g.nv; v++) p->X[old[v]] = p->g.X[v];
        for (int32_t i = 0; i < 2 * p->g.ne; i++) p->E[i] = old[p->g.E[i / 2].v[i % 2]];
        for (int32_t i = 0; i < p->face_start[p->sheet.nf]; i++) p->face_vertex[i] = old[p->face_vertex[i]];
        p->sheet.same_vertices = same;
        p->sheet.same_edges = lines_are_edges(p, l) &&
                              rg_value_count(rg_value_get(l->frame, "edges_vertices")) == (size_t)p->g.ne;
    }
    RG_MEM_FREE(mem, old, taken);
    return s;
}

/* Where they have other numbers than in the file that was read: which those are. */
static rg_status find_sources(plane *p, const rg_lines *l)
{
    const rg_memory *mem = &l->mem;
    if (!l->vertex) return RG_OK;
    if (!p->sheet.same_vertices) {
        if (!(p->vertex_source = rg_mem_array(mem, (size_t)p->g.nv, sizeof *p->vertex_source))) return RG_ENOMEM;
        rg_source_vertices(&p->g, l, p->vertex_source);
    }
    if (!p->sheet.same_edges && rg_value_count(rg_value_get(l->frame, "edges_vertices")) > 0) {
        if (!(p->edge_source = rg_mem_array(mem, (size_t)p->g.ne, sizeof *p->edge_source))) return RG_ENOMEM;
        for (int32_t e = 0; e < p->g.ne; e++) p->edge_source[e] = p->g.E[e].line;
    }
    return RG_OK;
}

typedef struct named { int32_t low, high, e; } named;

static int by_ends(const void *a, const void *b)
{
    const named *p = a, *q = b;
    return p->low != q->low ? (p->low < q->low ? -1 : 1) : p->high != q->high ? (p->high < q->high ? -1 : 1) : 0;
}

/* The old frame's list of faces to vertex[] and edge[]; 0: it is not a list of the faces found here. */
static int old_faces(const plane *p, const rg_value *list, const named *name, int32_t *start, int32_t *vertex,
                     int32_t *edge)
{
    double sum = 0;
    for (int32_t f = 0, at = 0; f < p->sheet.nf; f++) {
        const rg_value *face = rg_value_at(list, (size_t)f);
        const size_t n = rg_value_count(face);
        double twice = 0;
        if (n < 3 || (size_t)at + n > 2 * (size_t)p->g.ne) return 0;
        for (size_t k = 0; k < n; k++) {
            int64_t v = -1;
            rg_value_integer(rg_value_at(face, k), &v);
            vertex[(size_t)at + k] = (int32_t)v;
        }
        for (size_t k = 0; k < n; k++) {
            const int32_t a = vertex[(size_t)at + k], b = vertex[(size_t)at + (k + 1) % n];
            const named key = {a < b ? a : b, a < b ? b : a, 0};
            const named *found = bsearch(&key, name, (size_t)p->g.ne, sizeof key, by_ends);
            if (!found) return 0;
            edge[(size_t)at + k] = found->e;
            twice += rg_vec2_turn(p->X[vertex[at]], p->X[a], p->X[b]);
        }
        if (!(twice > 0)) return 0;
        sum += twice / 2;
        start[f + 1] = at += (int32_t)n;
    }
    return fabs(sum - p->area) <= SAME_AREA * p->area;
}

/* Faces in their old order where they are the same. */
static rg_status number_faces(plane *p, const rg_lines *l)
{
    const rg_memory *mem = &l->mem;
    const rg_value *list = rg_value_get(l->frame, "faces_vertices");
    if (!p->sheet.same_vertices || rg_value_count(list) != (size_t)p->sheet.nf) return RG_OK;
    named *name;
    int32_t *start, *vertex, *edge;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(name, (size_t)p->g.ne), RG_ARRAY(start, (size_t)p->sheet.nf + 1),
                                RG_ARRAY(vertex, 2 * (size_t)p->g.ne), RG_ARRAY(edge, 2 * (size_t)p->g.ne));
    for (int32_t e = 0; s == RG_OK && e < p->g.ne; e++) {
        const int32_t a = p->E[2 * e], b = p->E[2 * e + 1];
        name[e] = (named){a < b ? a : b, a < b ? b : a, e};
    }
    if (s == RG_OK && p->g.ne > 0) qsort(name, (size_t)p->g.ne, sizeof *name, by_ends);
    if (s == RG_OK && old_faces(p, list, name, start, vertex, edge)) {
        memcpy(p->face_start, start, ((size_t)p->sheet.nf + 1) * sizeof *start);
        memcpy(p->face_vertex, vertex, (size_t)start[p->sheet.nf] * sizeof *vertex);
        memcpy(p->face_edge, edge, (size_t)start[p->sheet.nf] * sizeof *edge);
        p->sheet.same_faces = 1;
    }
    RG_MEM_FREE(mem, name, start, vertex, edge);
    return s;
}

/* -------------------------------------------------------------------------------------------------------- FOLD ---- */

/* A part of the work that asks whether to go on by itself, as if it were all that comes after reading. */
typedef struct part { const rg_reading *of; double from, to; } part;

static int ask(void *ctx, double progress)
{
    const part *p = ctx;
    return p->of->progress(p->of->progress_ctx,
                           p->from + (p->to - p->from) * (progress - LINES_READ) / (1 - LINES_READ));
}

/* The graph to write. Where nobody asked for a tolerance, lines stay where they are, unless the drawing's own format is
 * a rough one; *gaps: out, whether ends miss each other that a reader would join. */
static rg_status draw(rg_lines *l, const rg_reading *s, rg_graph *g, int *gaps, rg_diag *why)
{
    const int32_t warnings = l->warnings;
    *gaps = 0;
    if (s->merge != RG_MERGE_DEFAULT) return rg_planar_from_all_lines(l, s->merge, s, g, why);
    const double usual = l->merge > 0 ? l->merge : s->merge;
    rg_graph joined = {.mem = l->mem};
    part p = {s, LINES_READ, (1 + LINES_READ) / 2};
    rg_reading asking = {.progress = s->progress ? ask : NULL, .progress_ctx = &p};
    rg_status status = rg_planar_from_all_lines(l, usual, &asking, &joined, why);
    l->warnings = warnings; /* each is said once */
    p.from = p.to, p.to = 1;
    if (status == RG_OK) status = rg_planar_from_all_lines(l, MERGE, &asking, g, why);
    if (status == RG_OK && (joined.nv != g->nv || joined.ne != g->ne)) {
        const double far = joined.merged_max;
        *gaps = !(l->merge > 0);
        if (!*gaps) {
            rg_graph t = *g;
            *g = joined;
            joined = t;
        }
        status = *gaps ? rg_lines_warn(l, 0,
                                       "ends miss each other by up to %.3g and stay apart, so that no faces are"
                                       " written: --merge %g joins them",
                                       far, usual)
                       : rg_lines_warn(l, 0, "ends that miss each other by up to %.3g are joined (%g of the size)", far,
                                       usual);
    }
    rg_graph_free(&joined);
    return status;
}

static rg_status write_fold(rg_lines *l, const rg_reading *settings, const rg_dest *to, rg_diag *why)
{
    plane p;
    int gaps;
    int32_t lost = 0;
    memset(&p, 0, sizeof p);
    const int32_t lines = l->count;
    rg_status s = draw(l, settings, &p.g, &gaps, why);
    if (s == RG_OK) s = rg_source_sort(&p.g, l);
    if (s == RG_OK) s = rg_star_init(&p.star, &l->mem, p.g.nv, p.g.ne, p.g.X, p.g.E);
    if (s == RG_OK) s = rg_faces_init(&p.faces, &l->mem, p.g.nv, p.g.ne, p.g.X, p.g.E, p.star.start, p.star.edge);
    if (s == RG_OK) s = find_faces(&p, &l->mem);
    if (s == RG_OK) s = letter_edges(&p, &l->mem);
    if (s == RG_OK) s = number(&p, l);
    if (s == RG_OK) s = find_sources(&p, l);
    if (s == RG_OK) s = number_faces(&p, l);
    if (s == RG_OK && p.g.ne == 0) s = rg_fail(RG_EFORMAT, why, 0, "there is no line that has a length");
    if (s == RG_OK && p.g.ne < lines)
        s = rg_lines_warn(l, 0, "%d lines that lie on others, or have no length, are left out", (int)(lines - p.g.ne));
    rg_fold_sheet *f = &p.sheet;
    *f = (rg_fold_sheet){p.g.nv,          p.g.ne,        gaps ? 0 : f->nf, p.X,           p.E,
                         p.letter,        p.angle,       p.face_start,     p.face_vertex, p.face_edge,
                         p.vertex_source, p.edge_source, f->same_vertices, f->same_edges, f->same_faces && !gaps};
    if (s == RG_OK) s = rg_fold_write(l, f, to, &lost, why);
    if (s == RG_OK && lost) s = rg_lines_warn(l, 0, "%d keys of the file no longer hold and are left out", (int)lost);
    free_plane(&p, &l->mem);
    return s;
}

/* ----------------------------------------------------------------------------------------------------- convert ---- */

static rg_status write(rg_lines *l, rg_format format, const rg_reading *s, const rg_dest *to, rg_diag *why)
{
    static const char *const names[] = {"", ".opx", ".cp", ".fold", ".svg", ".dxf"};
    const rg_status status = warn_of_losses(l, format, names[format]);
    if (status != RG_OK) return status;
    switch (format) {
    case RG_FORMAT_OPX: return rg_opx_write(l, to, why);
    case RG_FORMAT_CP: return rg_cp_write(l, to, why);
    case RG_FORMAT_SVG: return rg_svg_write(l, to, why);
    case RG_FORMAT_DXF: return rg_dxf_write(l, to, why);
    default: return write_fold(l, s, to, why);
    }
}

static int is_written(rg_format f)
{
    return f == RG_FORMAT_OPX || f == RG_FORMAT_CP || f == RG_FORMAT_FOLD || f == RG_FORMAT_SVG || f == RG_FORMAT_DXF;
}

rg_status rg_convert_check(rg_format f, const char *out, rg_diag *why)
{
    if (is_written(f)) return RG_OK;
    return rg_fail(RG_EARG, why, 0,
                   strcmp(out, "-") == 0 ? "%s: standard output has no name to tell the format by"
                                         : "%s: crease patterns are written as .opx, .cp, .fold, .svg or .dxf",
                   out);
}

rg_status rg_convert_lines(rg_lines *l, rg_format format, const rg_reading *r, const rg_dest *to, rg_warning warn,
                           void *ctx, rg_diag *why)
{
    rg_status s = r->progress && r->progress(r->progress_ctx, LINES_READ)
                      ? rg_fail(RG_ECANCELLED, why, 0, "%s", rg_status_text(RG_ECANCELLED))
                  : l->count == 0
                      ? rg_fail(RG_EFORMAT, why, 0, "there are no lines") /* most formats have no such file */
                      : write(l, format, r, to, why);
    if (s == RG_ENOMEM) rg_fail(s, why, 0, "out of memory");
    for (int32_t i = 0; warn && s != RG_ECANCELLED && i < l->warnings; i++) warn(ctx, &l->warning[i]);
    rg_lines_free(l);
    return s;
}

rg_status rg_convert(const char *in, const char *out, rg_format to, const rg_reading *given, rg_warning warn, void *ctx,
                     rg_diag *why)
{
    rg_reading r;
    rg_lines l;
    rg_status s = rg_reading_take(given, &r, why);
    if (s != RG_OK) return s;
    if (to == RG_FORMAT_AUTO) to = rg_read_extension(out);
    if ((s = rg_convert_check(to, out, why)) != RG_OK) return s;
    s = rg_read_file(in, &r, to == RG_FORMAT_FOLD, &l, why);
    return s == RG_OK ? rg_convert_lines(&l, to, &r, &(rg_dest){out, NULL}, warn, ctx, why) : s;
}

rg_status rg_convert_to(const void *bytes, size_t size, rg_format to, const rg_sink *sink, const rg_reading *given,
                        rg_warning warn, void *ctx, rg_diag *why)
{
    rg_reading r;
    rg_lines l;
    rg_status s = rg_reading_take(given, &r, why);
    if (s == RG_OK && !is_written(to))
        s = rg_fail(RG_EARG, why, 0, "crease patterns are written as .opx, .cp, .fold, .svg or .dxf");
    if (s == RG_OK) s = rg_read_bytes(bytes, size, NULL, &r, to == RG_FORMAT_FOLD, &l, why);
    return s == RG_OK ? rg_convert_lines(&l, to, &r, &(rg_dest){NULL, sink}, warn, ctx, why) : s;
}
