#include "read/fold.h"
#include "base/memory.h"
#include "base/status.h"
#include "base/text.h"
#include "base/unit.h"
#include "read/locate.h"
#include "read/plane.h"
#include "read/value.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ELEMENTS = INT32_MAX / 16, MOST_INHERITED = 100, MOST_FRAMES_TRIED = 1000, PATH_ROOM = 40 };
/* Keys, vertices, edges and sides of faces that are looked at, after the first frame, for one that is flat: each may
 * inherit what is long. Half a second. */
enum { MOST_TRIED = 1 << 23 };
/* Rows that are read before it is asked again whether to go on: a few milliseconds. */
enum { ROWS_UNASKED = 1 << 14 };
/* Coordinates in space lie in a plane if they are off it by less than this part of their size: single precision does
 * so. */
static const double FLATNESS = 1e-6;
/* Of a product of two lengths of a face, in its area. */
static const double ROUNDED = 1e-15;
/* Fold angles of which the largest is that near to pi are in radians, as old files of Origami Simulator have them. */
static const double RADIANS = 1e-4;
/* Degrees that a fold angle of half a turn may be off after arithmetic in single precision. */
static const double ROUNDING = 1e-3;

typedef struct side { int32_t low, high, face; signed char along, turn; } side; /* of a face; turn: sign of its area */

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    const rg_reading *s;
    const char *text;
    size_t size;
    const rg_value *root;
    rg_value *frame; /* with what it inherits */
    int32_t part[MOST_INHERITED], parts; /* the frames that it is made of, itself first; 0: the key frame */
    int32_t nv, ne, nf, sides;
    rg_vec3 *space;
    rg_vec2 *X;
    int32_t *E; /* [2 ne] */
    char *letter;
    double *angle; /* degrees, NAN: none */
    int32_t *face_start, *face_vertex;
    side *side;
    int64_t tried; /* in the frames before */
    int of_faces;  /* the edges are made of the faces, and nothing of the file is of them */
    int is_state;  /* a frame that says how the sheet of another is folded */
    int is_folded; /* not flat, or turned over: why says which */
} reader;

/* A frame, 0 being the key frame. */
static const rg_value *frame_at(const reader *r, int64_t number)
{
    return number == 0 ? r->root : rg_value_at(rg_value_get(r->root, "file_frames"), (size_t)number - 1);
}

/* What stands before the path that `text` begins with: the frame that has its key, among those that the frame is made
 * of. */
static void begin_path(const reader *r, const char *text, char path[PATH_ROOM])
{
    char key[40];
    int32_t owner = r->parts > 0 ? r->part[0] : 0;
    snprintf(key, sizeof key, "%.*s", (int)strcspn(text, "[:"), text);
    for (int32_t i = r->parts - 1; i >= 0; i--)
        if (rg_value_get(frame_at(r, r->part[i]), key)) owner = r->part[i];
    path[0] = 0;
    if (owner > 0) snprintf(path, PATH_ROOM, "file_frames[%d].", (int)owner - 1);
}

/* Both: text that begins with a path in the frame. Lines are looked up at the end, for what is told after all. */
static rg_status bad(const reader *r, const char *format, ...)
{
    char text[200], path[PATH_ROOM];
    va_list args;
    va_start(args, format);
    rg_text_with(text, sizeof text, format, args);
    va_end(args);
    begin_path(r, text, path);
    return rg_fail(RG_EFORMAT, r->why, 0, "%s%s", path, text);
}

static rg_status warn(const reader *r, const char *format, ...)
{
    char text[200], path[PATH_ROOM];
    va_list args;
    va_start(args, format);
    rg_text_with(text, sizeof text, format, args);
    va_end(args);
    begin_path(r, text, path);
    return rg_lines_warn(r->out, 0, "%s%s", path, text);
}

static void find_line(const reader *r, rg_diag *d)
{
    if (!d->line) d->line = rg_locate_told(r->text, r->size, d->text);
}

static void forget(reader *r)
{
    RG_MEM_FREE(&r->out->mem, r->space, r->X, r->E, r->letter, r->angle, r->face_start, r->face_vertex, r->side);
    rg_value_free(r->frame);
    *r = (reader){.out = r->out, .why = r->why, .s = r->s, .text = r->text, .size = r->size, .root = r->root,
                  .tried = r->tried};
}

/* In each row of what is long. */
static int is_ended(const reader *r, int32_t row) { return row % ROWS_UNASKED == 0 && rg_stop_asked(r->out->stop); }

/* -------------------------------------------------------------------------------------------------- arrays ---- */

/* A list of the frame; *list NULL where there is none. */
static rg_status list(const reader *r, const char *key, const rg_value **out, int32_t *n)
{
    const rg_value *v = rg_value_get(r->frame, key);
    *out = NULL;
    *n = 0;
    if (rg_value_kind(v) == RG_KIND_NONE || rg_value_kind(v) == RG_KIND_NULL) return RG_OK;
    if (rg_value_kind(v) != RG_KIND_LIST) return bad(r, "%s: no list", key);
    if (rg_value_count(v) > MOST_ELEMENTS) return bad(r, "%s: too many", key);
    *out = v;
    *n = (int32_t)rg_value_count(v);
    return RG_OK;
}

static rg_status coordinates(reader *r)
{
    const rg_value *v;
    rg_status s = list(r, "vertices_coords", &v, &r->nv);
    if (s == RG_OK && !v) return bad(r, "vertices_coords: there are none");
    if (s == RG_OK && !(r->space = rg_mem_array(&r->out->mem, (size_t)r->nv, sizeof *r->space))) return RG_ENOMEM;
    for (int32_t i = 0; s == RG_OK && i < r->nv; i++) {
        if (is_ended(r, i)) return RG_ECANCELLED;
        const rg_value *row = rg_value_at(v, (size_t)i);
        double x[3] = {0, 0, 0};
        const size_t n = rg_value_count(row);
        int good = rg_value_kind(row) == RG_KIND_LIST && (n == 2 || n == 3);
        for (size_t k = 0; good && k < n; k++) good = rg_value_number(rg_value_at(row, k), &x[k]);
        if (!good) return bad(r, "vertices_coords[%d]: not two or three numbers", (int)i);
        for (int k = 0; k < 3; k++)
            if (!(fabs(x[k]) <= RG_LARGEST_COORDINATE))
                return bad(r, "vertices_coords[%d]: %g is too large to compute with", (int)i, x[k]);
        r->space[i] = (rg_vec3){x[0], x[1], x[2]};
    }
    return s;
}

/* A vertex number of an edge or a face. */
static int vertex(const reader *r, const rg_value *v, int32_t *out)
{
    int64_t n;
    if (!rg_value_integer(v, &n) || n < 0 || n >= r->nv) return 0;
    *out = (int32_t)n;
    return 1;
}

static rg_status no_vertex(const reader *r, const char *key, int32_t i, size_t k, const rg_value *v)
{
    int64_t n;
    if (!rg_value_integer(v, &n)) return bad(r, "%s[%d][%d]: no vertex number", key, (int)i, (int)k);
    return bad(r, "%s[%d][%d]: there is no vertex %lld, they end at %d", key, (int)i, (int)k, (long long)n,
               (int)r->nv - 1);
}

static rg_status edges(reader *r)
{
    const rg_value *v;
    rg_status s = list(r, "edges_vertices", &v, &r->ne);
    if (s != RG_OK || !v) return s;
    r->E = rg_mem_array(&r->out->mem, (size_t)r->ne, 2 * sizeof *r->E);
    if (!r->E) return RG_ENOMEM;
    for (int32_t i = 0; i < r->ne; i++) {
        if (is_ended(r, i)) return RG_ECANCELLED;
        const rg_value *row = rg_value_at(v, (size_t)i);
        if (rg_value_count(row) != 2) return bad(r, "edges_vertices[%d]: not two vertices", (int)i);
        for (size_t k = 0; k < 2; k++)
            if (!vertex(r, rg_value_at(row, k), &r->E[2 * (size_t)i + k]))
                return no_vertex(r, "edges_vertices", i, k, rg_value_at(row, k));
    }
    return RG_OK;
}

static rg_status faces(reader *r)
{
    const rg_value *v;
    rg_status s = list(r, "faces_vertices", &v, &r->nf);
    size_t sides = 0;
    for (int32_t f = 0; f < r->nf; f++) sides += rg_value_count(rg_value_at(v, (size_t)f));
    if (s != RG_OK || !v) return s;
    if (sides > MOST_ELEMENTS) return bad(r, "faces_vertices: too many");
    r->sides = (int32_t)sides;
    if (RG_MEM_ARRAYS(&r->out->mem, RG_ARRAY(r->face_start, (size_t)r->nf + 1), RG_ARRAY(r->face_vertex, sides),
                      RG_ARRAY(r->side, sides)) != RG_OK) return RG_ENOMEM;
    for (int32_t f = 0; f < r->nf; f++) {
        if (is_ended(r, f)) return RG_ECANCELLED;
        const rg_value *row = rg_value_at(v, (size_t)f);
        const size_t n = rg_value_count(row);
        if (n < 3) return bad(r, "faces_vertices[%d]: fewer than three vertices", (int)f);
        for (size_t k = 0; k < n; k++)
            if (!vertex(r, rg_value_at(row, k), &r->face_vertex[(size_t)r->face_start[f] + k]))
                return no_vertex(r, "faces_vertices", f, k, rg_value_at(row, k));
        r->face_start[f + 1] = r->face_start[f] + (int32_t)n;
    }
    return RG_OK;
}

/* Which edge is meant by a number, only edges_vertices says. */
static rg_status edges_unknown(const reader *r, const char *key)
{
    return bad(r, "%s: there are no edges_vertices to say which edges these are", key);
}

static rg_status assignments(reader *r)
{
    const rg_value *v;
    int32_t n;
    rg_status s = list(r, "edges_assignment", &v, &n);
    if (s != RG_OK || !v || (r->of_faces && n == 0)) return s;
    if (r->of_faces) return edges_unknown(r, "edges_assignment");
    if (n != r->ne) return bad(r, "edges_assignment: %d of them for %d edges", (int)n, (int)r->ne);
    if (!(r->letter = rg_mem_array(&r->out->mem, (size_t)n, 1))) return RG_ENOMEM;
    for (int32_t i = 0; i < n; i++) {
        const rg_value *one = rg_value_at(v, (size_t)i);
        const char *text = rg_value_kind(one) == RG_KIND_NULL ? "U" : rg_value_text(one);
        const char *known = text && text[0] && !text[1] ? strchr("BbMmVvFfUuCcJj", text[0]) : NULL;
        if (!known) return bad(r, "edges_assignment[%d]: not one of B M V F U C J", (int)i);
        r->letter[i] = *known >= 'a' ? (char)(*known - 'a' + 'A') : *known;
    }
    return RG_OK;
}

static int contains(const char *text, const char *word)
{
    const size_t n = strlen(word);
    for (; text && *text; text++) {
        size_t i = 0;
        while (i < n && (text[i] | 32) == word[i]) i++;
        if (i == n) return 1;
    }
    return 0;
}

static const char *creator(const reader *r) { return rg_value_text(rg_value_get(r->root, "file_creator")); }

/* What was written here is as the format has it: nothing is guessed of it. */
static int is_ours(const reader *r) { return contains(creator(r), "rigami"); }

static rg_status angles(reader *r)
{
    const char *key = "edges_foldAngle";
    const rg_value *v;
    int32_t n;
    rg_status s = list(r, key, &v, &n);
    if (s == RG_OK && !v) s = list(r, key = "edges_foldAngles", &v, &n);
    if (s != RG_OK || !v || (r->of_faces && n == 0)) return s;
    if (r->of_faces) return edges_unknown(r, key);
    if (n != r->ne) return bad(r, "%s: %d of them for %d edges", key, (int)n, (int)r->ne);
    if (!(r->angle = rg_mem_array(&r->out->mem, (size_t)n, sizeof *r->angle))) return RG_ENOMEM;
    double most = 0;
    for (int32_t i = 0; i < n; i++) {
        const rg_value *one = rg_value_at(v, (size_t)i);
        if (rg_value_kind(one) == RG_KIND_NULL) {
            r->angle[i] = NAN;
            continue;
        }
        if (!rg_value_number(one, &r->angle[i])) return bad(r, "%s[%d]: no number", key, (int)i);
        if (!(fabs(r->angle[i]) <= 180 + ROUNDING))
            return bad(r, "%s[%d]: %g is not within 180 degrees", key, (int)i, r->angle[i]);
        r->angle[i] = fmax(-180, fmin(r->angle[i], 180));
        most = fmax(most, fabs(r->angle[i]));
    }
    if (!(most > 0 && most <= RG_PI + RADIANS) || is_ours(r)) return RG_OK;
    const int radians = most >= RG_PI - RADIANS;
    for (int32_t i = 0; radians && i < n; i++) r->angle[i] /= RG_DEG;
    return warn(r, "%s: %s", key, radians ? "the largest is pi: taken for radians"
                                                           : "none is above pi: are these radians? read as degrees");
}

/* --------------------------------------------------------------------------------------------------- plane ---- */

/* The lines that show whether the vertices lie in a plane: edges, or the sides of faces. *pair: out, the caller's. */
static rg_status ends(const reader *r, int32_t **pair, int32_t *pairs)
{
    *pairs = r->ne ? r->ne : r->sides;
    *pair = rg_mem_array(&r->out->mem, (size_t)*pairs, 2 * sizeof **pair);
    if (!*pair) return RG_ENOMEM;
    if (r->ne) memcpy(*pair, r->E, 2 * (size_t)r->ne * sizeof **pair);
    for (int32_t f = 0; !r->ne && f < r->nf; f++)
        for (int32_t k = r->face_start[f], end = r->face_start[f + 1]; k < end; k++) {
            (*pair)[2 * k] = r->face_vertex[k];
            (*pair)[2 * k + 1] = r->face_vertex[k + 1 < end ? k + 1 : r->face_start[f]];
        }
    return RG_OK;
}

static rg_status flatten(reader *r)
{
    rg_level p;
    int32_t *pair = NULL, pairs;
    rg_status s = ends(r, &pair, &pairs);
    if (s != RG_OK) return s;
    const int flat = rg_plane_find(r->space, r->nv, pair, pairs, FLATNESS, r->s->merge, &p);
    if (!flat) {
        const int32_t v = pairs ? pair[2 * p.at] : 0, w = pairs ? pair[2 * p.at + 1] : 0;
        rg_mem_free(&r->out->mem, pair);
        r->is_folded = 1;
        return bad(r, "vertices_coords: a folded form, its vertices do not lie in one plane: flat, the line from "
                      "vertex %d to %d would be %.3g shorter; a crease pattern is needed", (int)v, (int)w, p.change);
    }
    rg_mem_free(&r->out->mem, pair);
    if (!(r->X = rg_mem_array(&r->out->mem, (size_t)r->nv, sizeof *r->X))) return RG_ENOMEM;
    for (int32_t i = 0; i < r->nv; i++) {
        const double y = rg_vec3_dot(p.e2, r->space[i]);
        r->X[i] = (rg_vec2){rg_vec3_dot(p.e1, r->space[i]), r->out->y_down ? -y : y};
    }
    if (flat == 2) return RG_OK;
    return warn(r, "vertices_coords: they are off a plane by up to %.3g, and taken for flat: no line is changed by "
                   "more than %.3g", p.off, p.change);
}

/* --------------------------------------------------------------------------------------------------- faces ---- */

static int by_ends(const void *a, const void *b)
{
    const side *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    if (p->high != q->high) return p->high < q->high ? -1 : 1;
    return p->face < q->face ? -1 : p->face > q->face;
}

/* 0 where it is no more than rounding: a face that narrow is no way round. */
static double area(const reader *r, int32_t f)
{
    const int32_t *v = r->face_vertex + r->face_start[f], n = r->face_start[f + 1] - r->face_start[f];
    double twice = 0, far = 0;
    for (int32_t k = 1; k + 1 < n; k++) twice += rg_vec2_turn(r->X[v[0]], r->X[v[k]], r->X[v[k + 1]]);
    for (int32_t k = 1; k < n; k++) {
        const rg_vec2 d = rg_vec2_sub(r->X[v[k]], r->X[v[0]]);
        far = fmax(far, rg_vec2_dot(d, d));
    }
    return fabs(twice) <= ROUNDED * far * n ? 0 : twice / 2;
}

/* The sides of all faces, sorted by their ends, and which way the faces run. *turn: out, +1 or -1; 0: there are
 * none. */
static rg_status turn_faces(reader *r, int *turn)
{
    double sum = 0, all = 0;
    int32_t left = 0, right = 0;
    for (int32_t f = 0; f < r->nf; f++) all += fabs(area(r, f));
    for (int32_t f = 0; f < r->nf; f++) {
        const double a = area(r, f);
        const int which = fabs(a) <= FLATNESS * all / r->nf ? 0 : a > 0 ? 1 : -1;
        const int32_t *v = r->face_vertex + r->face_start[f], n = r->face_start[f + 1] - r->face_start[f];
        for (int32_t k = 0; k < n; k++) {
            const int32_t p = v[k], q = v[(k + 1) % n];
            r->side[r->face_start[f] + k] = (side){p < q ? p : q, p < q ? q : p, f, p < q ? 1 : -1, (signed char)which};
        }
        sum += a;
        left += which > 0;
        right += which < 0;
    }
    if (r->sides > 0) qsort(r->side, (size_t)r->sides, sizeof *r->side, by_ends);
    *turn = left + right == 0 ? 0 : sum < 0 ? -1 : 1;
    /* Faces that run the same way round the sheet, and yet one is turned over: they are folded on each other. */
    for (int32_t i = 1; i < r->sides; i++) {
        const side *p = &r->side[i - 1], *q = &r->side[i];
        if (p->low != q->low || p->high != q->high || p->along == q->along || p->turn * q->turn >= 0) continue;
        r->is_folded = 1;
        return bad(r, "faces_vertices[%d]: a folded form, this face is turned over; a crease pattern is needed",
                   (int)(p->turn == *turn ? q->face : p->face));
    }
    if (!left || !right) return RG_OK;
    return warn(r, "faces_vertices: %d faces run counter-clockwise and %d clockwise", (int)left, (int)right);
}

/* Edges from the sides of faces. */
static rg_status edges_of_faces(reader *r)
{
    rg_mem_free(&r->out->mem, r->E);
    if (!(r->E = rg_mem_array(&r->out->mem, (size_t)r->sides, 2 * sizeof *r->E))) return RG_ENOMEM;
    for (int32_t i = 0; i < r->sides; i++) {
        const side *q = &r->side[i];
        if (i > 0 && q[-1].low == q->low && q[-1].high == q->high) continue;
        r->E[2 * r->ne] = q->low;
        r->E[2 * r->ne++ + 1] = q->high;
    }
    r->of_faces = 1;
    return RG_OK;
}

/* How many faces an edge belongs to: 0, 1, or 2 for all that is more. */
static int faces_at(const reader *r, int32_t e)
{
    const int32_t a = r->E[2 * e], b = r->E[2 * e + 1];
    const side key = {a < b ? a : b, a < b ? b : a, -1, 0, 0};
    int32_t low = 0, high = r->sides, n = 0;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (by_ends(&r->side[middle], &key) < 0) low = middle + 1;
        else high = middle;
    }
    while (n < 2 && low < r->sides && r->side[low].low == key.low && r->side[low].high == key.high) low++, n++;
    return n;
}

/* --------------------------------------------------------------------------------------------------- lines ---- */

/* The letter of an edge for which the file has none. */
static char guess(const reader *r, int32_t e)
{
    if (r->nf > 0 && faces_at(r, e) == 1) return RG_BORDER;
    const double angle = r->angle ? r->angle[e] : NAN;
    if (angle > 0) return RG_VALLEY;
    if (angle < 0) return RG_MOUNTAIN;
    return angle == 0 && r->nf > 0 ? RG_FLAT : RG_UNASSIGNED;
}

static int can_fold(char letter) { return letter == RG_MOUNTAIN || letter == RG_VALLEY || letter == RG_UNASSIGNED; }

/* Angles that are all 0 are those of the flat sheet and no wish, unless a state of the sheet was asked for. */
static int has_targets(const reader *r)
{
    if (r->is_state && r->angle) return r->s->targets;
    for (int32_t e = 0; r->s->targets && r->angle && e < r->ne; e++)
        if (fabs(r->angle[e]) > 0 && can_fold(r->letter[e])) return 1;
    return 0;
}

/* The line of the file for each line that was read. */
static rg_status locate(reader *r)
{
    char path[PATH_ROOM + 20];
    int32_t *line = rg_mem_array(&r->out->mem, (size_t)r->ne, sizeof *line);
    if (!line) return RG_ENOMEM;
    begin_path(r, "edges_vertices", path);
    strcat(path, "edges_vertices");
    rg_locate_lines(r->text, r->size, path, line, r->ne);
    for (int32_t e = 0; e < r->ne; e++) r->out->line[e].where = line[e];
    rg_mem_free(&r->out->mem, line);
    return RG_OK;
}

static rg_status add_lines(reader *r, int turn)
{
    const int targets = has_targets(r);
    int32_t contrary = 0, first = 0;
    for (int32_t e = 0; e < r->ne; e++) {
        char letter = r->letter[e];
        double angle = targets && can_fold(letter) ? r->angle[e] : NAN;
        if (letter == 'J') letter = RG_FLAT;
        if (letter == 'C') letter = RG_BORDER;
        if (letter == RG_UNASSIGNED && angle == 0 && !r->is_state) angle = NAN;
        if ((letter == RG_MOUNTAIN && angle > 0) || (letter == RG_VALLEY && angle < 0)) {
            if (!contrary++) first = e;
            angle = -angle;
        }
        if (turn < 0) {
            letter = letter == RG_MOUNTAIN ? RG_VALLEY : letter == RG_VALLEY ? RG_MOUNTAIN : letter;
            angle = -angle;
        }
        const double full = letter == RG_MOUNTAIN ? -180 : letter == RG_VALLEY ? 180 : NAN;
        const int is_free = targets && isnan(angle) && !isnan(full); /* null, beside others that are given */
        rg_status s = rg_lines_add(r->out, r->X[r->E[2 * e]], r->X[r->E[2 * e + 1]], letter, 0);
        if (s != RG_OK) return s;
        if (is_free) r->out->line[r->out->count - 1].target = RG_FREE;
        else if (!(angle == full)) r->out->line[r->out->count - 1].target = angle * RG_DEG;
    }
    if (!contrary) return RG_OK;
    return warn(r, "edges_foldAngle[%d]: the sign is not that of its assignment, which is kept (%d such)",
                         (int)first, (int)contrary);
}

/* ------------------------------------------------------------------------------------------------ metadata ---- */

/* Programs that draw with y downwards, and write their coordinates as they are. */
static int draws_down(const reader *r)
{
    return contains(creator(r), "oriedita") || contains(creator(r), "oripa") || contains(creator(r), "orihime");
}

/* With no faces, nothing but the program's own habit says which side of the paper is seen. */
static rg_status warn_of_side(reader *r)
{
    if (r->nf > 0 || r->s->flip || draws_down(r) || is_ours(r)) return RG_OK;
    return warn(r, "faces_vertices: there are none, so that nothing says which side is seen: y is taken to point up; "
                   "--flip if the model comes out as in a mirror");
}

static rg_status say(rg_lines *l, const rg_value *v, char **to)
{
    const char *text = rg_value_text(v);
    if (!text || !*text || *to) return RG_OK;
    return (*to = rg_mem_string(&l->mem, text)) ? RG_OK : RG_ENOMEM;
}

static rg_status metadata(reader *r)
{
    rg_lines *l = r->out;
    struct { const char *key; char **to; } keys[] = {
        {"file_title", &l->title}, {"frame_title", &l->title}, {"file_author", &l->author},
        {"frame_author", &l->author}, {"file_description", &l->memo}, {"frame_description", &l->memo},
        {"rigami:editor", &l->editor}, {"rigami:reference", &l->reference}};
    rg_status s = RG_OK;
    for (size_t i = 0; s == RG_OK && i < sizeof keys / sizeof *keys; i++) {
        s = say(l, rg_value_get(r->frame, keys[i].key), keys[i].to);
        if (s == RG_OK) s = say(l, rg_value_get(r->root, keys[i].key), keys[i].to);
    }
    double spec;
    l->metres = rg_unit_metres(rg_value_text(rg_value_get(r->frame, "frame_unit")));
    if (s == RG_OK) s = warn_of_side(r);
    if (s == RG_OK && rg_value_number(rg_value_get(r->root, "file_spec"), &spec) && spec >= 2)
        s = rg_lines_warn(l, 0, "file_spec: %g is newer than what is known here, parts may be missed", spec);
    return s;
}

/* Frames that say how this sheet is folded, and no more: states of it. */
static rg_status warn_of_states(reader *r)
{
    const rg_value *frames = rg_value_get(r->root, "file_frames");
    const size_t n = rg_value_count(frames);
    int32_t states = 0, first = 0, last = 0;
    r->out->frames = n < MOST_ELEMENTS ? (int32_t)n : MOST_ELEMENTS;
    for (size_t i = 0; r->s->file_frame < 0 && i < n && i < MOST_FRAMES_TRIED; i++) {
        const rg_value *one = rg_value_at(frames, i);
        const int says = rg_value_get(one, "edges_foldAngle") || rg_value_get(one, "edges_assignment");
        const int inherits = rg_value_is_true(rg_value_get(one, "frame_inherit"));
        if (!says || !inherits || rg_value_get(one, "vertices_coords")) continue;
        if (!states++) first = (int32_t)i + 1;
        last = (int32_t)i + 1;
    }
    if (states == 0) return RG_OK;
    return warn(r, "file_frames: %d frames are states of the sheet that are not looked at; --frame %d-%d goes through "
                   "them",
                (int)states, (int)first, (int)last);
}

static rg_status warn_folded(reader *r)
{
    const rg_value *classes = rg_value_get(r->frame, "frame_classes");
    for (size_t i = 0; r->nf == 0 && i < rg_value_count(classes); i++) {
        const char *one = rg_value_text(rg_value_at(classes, i));
        if (one && strcmp(one, "foldedForm") == 0)
            return warn(r, "frame_classes: a folded form, and no faces to tell: taken for a crease pattern");
    }
    return RG_OK;
}

/* -------------------------------------------------------------------------------------------------- frames ---- */

/* The frame that was looked at last, for what is wrong with it alone. */
static reader *last_part(reader *r)
{
    r->part[0] = r->part[r->parts - 1];
    r->parts = 1;
    return r;
}

/* What of a frame says how the sheet is folded, whatever else it says of where that brings it; NULL: no memory. */
static rg_value *state_of(const rg_value *frame)
{
    static const char *const keys[] = {"edges_foldAngle", "edges_foldAngles", "edges_assignment", "frame_title",
                                       "frame_description"};
    rg_value *one = rg_value_overlay(NULL, frame);
    for (const void *k = NULL; one && (k = rg_value_next(frame, k));) {
        size_t i = 0;
        while (i < sizeof keys / sizeof *keys && strcmp(keys[i], rg_value_key(k)) != 0) i++;
        if (i == sizeof keys / sizeof *keys) rg_value_drop(one, rg_value_key(k));
    }
    return one;
}

/* The frames that a frame inherits from, itself first. */
static rg_status trace(reader *r, int64_t number)
{
    const size_t frames = rg_value_count(rg_value_get(r->root, "file_frames"));
    for (int64_t at = number;;) {
        if (at < 0 || at > (int64_t)frames)
            return bad(last_part(r), "frame_parent: there is no frame %lld", (long long)at);
        if (r->parts == MOST_INHERITED)
            return bad(last_part(r), "frame_parent: frames inherit from each other without end");
        const rg_value *one = frame_at(r, at);
        r->part[r->parts++] = (int32_t)at;
        if (rg_value_kind(one) != RG_KIND_OBJECT) return bad(last_part(r), "the frame is no object");
        if (at == 0 || !rg_value_is_true(rg_value_get(one, "frame_inherit"))) return RG_OK;
        const rg_value *parent = rg_value_get(one, "frame_parent");
        at = 0;
        if (parent && !rg_value_integer(parent, &at)) return bad(last_part(r), "frame_parent: no frame number");
    }
}

/* A frame that was traced with what it inherits, in r->frame; as_state: on the drawing of the one that it inherits from
 * in the end. */
static rg_status resolve(reader *r, int as_state)
{
    for (int32_t i = r->parts - 1; i >= 0; i--) {
        const rg_value *one = frame_at(r, r->part[i]);
        rg_value *state = as_state && i < r->parts - 1 ? state_of(one) : NULL;
        if (as_state && i < r->parts - 1 && !state) return RG_ENOMEM;
        const rg_value *over = state ? state : one;
        r->tried += (int64_t)rg_value_keys(over);
        const int is_short = r->frame ? !rg_value_add(r->frame, over) : !(r->frame = rg_value_overlay(NULL, over));
        rg_value_free(state);
        if (is_short) return RG_ENOMEM;
    }
    return RG_OK;
}

/* What a key is in a frame that was traced. */
static const rg_value *inherited(const reader *r, const char *key)
{
    const rg_value *v = NULL;
    for (int32_t i = 0; !v && i < r->parts; i++) v = rg_value_get(frame_at(r, r->part[i]), key);
    return v;
}

static int has_drawing(const reader *r)
{
    return rg_value_count(inherited(r, "vertices_coords")) > 0 &&
           rg_value_count(inherited(r, "edges_vertices")) + rg_value_count(inherited(r, "faces_vertices")) > 0;
}

/* Whether the frame that was asked for says by itself how far each crease is folded. */
static int is_state(const reader *r, int32_t asked)
{
    const rg_value *one = asked > 0 ? frame_at(r, asked) : NULL;
    return rg_value_get(one, "edges_foldAngle") || rg_value_get(one, "edges_foldAngles");
}

static rg_status read_frame(reader *r)
{
    int turn = 0;
    rg_status s = coordinates(r);
    if (s == RG_OK) s = edges(r);
    if (s == RG_OK) s = faces(r);
    if (s == RG_OK && !r->ne && !r->nf) return bad(r, "edges_vertices: there are none, nor faces");
    if (s == RG_OK) s = flatten(r);
    if (s == RG_OK && r->nf > 0) s = turn_faces(r, &turn);
    if (s == RG_OK && !r->ne) s = edges_of_faces(r);
    if (s == RG_OK) s = assignments(r);
    if (s == RG_OK) s = angles(r);
    if (s == RG_OK && !r->letter) {
        if (!(r->letter = rg_mem_array(&r->out->mem, (size_t)r->ne, 1))) return RG_ENOMEM;
        for (int32_t e = 0; e < r->ne; e++) r->letter[e] = guess(r, e);
        s = warn(r, "edges_assignment: there are none, they are taken from %s",
                          r->angle ? "the fold angles" : "the faces");
    }
    if (s == RG_OK && turn < 0)
        s = warn(r, "faces_vertices: they run clockwise, so this is the back: mountain and valley are exchanged");
    if (s == RG_OK) s = warn_folded(r);
    if (s == RG_OK) s = warn_of_states(r);
    if (s == RG_OK) s = add_lines(r, turn);
    if (s == RG_OK) s = locate(r);
    return s == RG_OK ? metadata(r) : s;
}

/* The frame asked for, or the first one that is a drawing and flat, the key frame first. */
static rg_status choose(reader *r)
{
    const size_t frames = rg_value_count(rg_value_get(r->root, "file_frames"));
    const int32_t asked = r->s->file_frame;
    if (asked > 0 && (size_t)asked > frames)
        return rg_fail(RG_EFORMAT, r->why, 0, "file_frames: there is no frame %d, the last one is %zu", (int)asked,
                       frames);
    const int64_t last = frames < MOST_FRAMES_TRIED ? (int64_t)frames : MOST_FRAMES_TRIED;
    const int64_t from = asked >= 0 ? asked : 0, to = asked >= 0 ? asked : last;
    rg_diag first = {0, ""};
    rg_status s = RG_OK, failed = RG_OK;
    for (int64_t i = from; i <= to; i++) {
        if (r->tried > MOST_TRIED) break;
        if (rg_stop_asked(r->out->stop)) return RG_ECANCELLED;
        forget(r);
        s = trace(r, i);
        const int is_one = s == RG_OK && (asked >= 0 || has_drawing(r) || from == to);
        r->is_state = is_state(r, asked);
        if (is_one) s = resolve(r, 0);
        if (is_one && s == RG_OK) s = read_frame(r);
        else if (s == RG_OK) s = bad(r, "no vertices_coords, or no edges_vertices and no faces_vertices");
        if (s == RG_EFORMAT && r->is_folded && r->is_state && r->parts > 1) { /* it says where it is folded to, too */
            forget(r);
            s = trace(r, i);
            if (s == RG_OK) s = resolve(r, 1);
            r->is_state = 1;
            if (s == RG_OK) s = read_frame(r);
        }
        const int is_spoilt = !r->is_folded && r->frame && has_drawing(r);
        if (s == RG_OK || s == RG_ENOMEM || s == RG_ECANCELLED || is_spoilt) return s;
        r->tried += (int64_t)r->nv + r->ne + r->sides;
        if (failed == RG_OK) r->tried = 0; /* the first one may be as large as it is */
        if (failed == RG_OK && r->why) first = *r->why;
        failed = s;
    }
    if (r->why) *r->why = first;
    return failed;
}

rg_status rg_fold_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop,
                       const rg_reading *settings, int keep, rg_lines *out, rg_diag *why)
{
    rg_value *root = NULL;
    rg_lines_init(out, mem);
    out->stop = stop;
    rg_status s = size ? rg_value_parse(bytes, size, stop, &root, why)
                       : rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    if (s == RG_OK && rg_value_kind(root) != RG_KIND_OBJECT)
        s = rg_fail(RG_EFORMAT, why, 1, "JSON, but no FOLD: it is no object");
    reader r = {.out = out, .why = why, .s = settings, .text = bytes, .size = size, .root = root};
    if (s == RG_OK) out->y_down = draws_down(&r) != (settings->flip != 0);
    if (s == RG_OK) s = choose(&r);
    if (s == RG_EFORMAT && root && why) find_line(&r, why);
    for (int32_t i = 0; s == RG_OK && i < out->warnings; i++) find_line(&r, &out->warning[i]);
    if (s == RG_OK && keep) {
        static const char *const own[] = {"file_frames", "frame_parent", "frame_inherit"}; /* of one of several */
        for (int i = 0; r.part[0] > 0 && i < 3; i++) rg_value_drop(r.frame, own[i]);
        out->vertex = r.E;
        out->frame = r.frame;
        out->keeper = &RG_VALUE_KEEPER;
        out->face_start = r.face_start;
        out->face_vertex = r.face_vertex;
        out->faces = r.nf;
        r.E = NULL;
        r.frame = NULL;
        r.face_start = r.face_vertex = NULL;
    }
    forget(&r);
    rg_value_free(root);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
