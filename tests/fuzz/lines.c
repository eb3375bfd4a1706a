/* lines.c -- changes a crease pattern as what it is: lines that meet, on a sheet. What comes out is again a pattern, most often of one
 * sheet, so that what folds it is reached; it is written as .opx or, where angles are given, as .fold. */
#include "fuzz.h"
#include "base/memory.h"
#include "read/read.h"

#include <math.h>
#include <string.h>

enum { MOST_LINES = 200 };

static int same(rg_vec2 a, rg_vec2 b) { return a.x == b.x && a.y == b.y; }

static rg_vec2 *end_of(rg_lines *l, dice *d)
{
    rg_line *q = &l->line[dice_below(d, (size_t)l->count)];
    return dice_below(d, 2) ? &q->a : &q->b;
}

/* In -1 ... 1. */
static double fraction(dice *d) { return ((double)dice_below(d, 2000001) - 1000000) * 1e-6; }

static double size_of(const rg_lines *l)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int32_t i = 0; i < l->count; i++)
        for (int k = 0; k < 2; k++) {
            const rg_vec2 p = k ? l->line[i].b : l->line[i].a;
            low[0] = fmin(low[0], p.x), low[1] = fmin(low[1], p.y);
            high[0] = fmax(high[0], p.x), high[1] = fmax(high[1], p.y);
        }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

/* Every line that ends there goes along. */
static void move(rg_lines *l, dice *d)
{
    static const double how_far[] = {1e-12, 1e-6, 1e-4, 1e-2, 0.1, 1};
    const double by = size_of(l) * how_far[dice_below(d, 6)];
    const rg_vec2 old = *end_of(l, d);
    const rg_vec2 to = dice_below(d, 4) ? (rg_vec2){old.x + by * fraction(d), old.y + by * fraction(d)} : *end_of(l, d);
    for (int32_t i = 0; i < l->count; i++) {
        if (same(l->line[i].a, old)) l->line[i].a = to;
        if (same(l->line[i].b, old)) l->line[i].b = to;
    }
}

/* The same linear map for all: turned, mirrored, stretched, sheared. */
static void map(rg_lines *l, dice *d)
{
    double A[4] = {1, 0, 0, 1};
    const double t = 3.14159265358979 * fraction(d);
    switch (dice_below(d, 4)) {
    case 0: A[0] = cos(t), A[1] = -sin(t), A[2] = sin(t), A[3] = cos(t); break;
    case 1: A[0] = -1; break;
    case 2: A[0] = pow(10, 3 * fraction(d)), A[3] = dice_below(d, 2) ? A[0] : 1; break;
    default: A[1] = fraction(d);
    }
    for (int32_t i = 0; i < l->count; i++)
        for (int k = 0; k < 2; k++) {
            rg_vec2 *p = k ? &l->line[i].b : &l->line[i].a;
            *p = (rg_vec2){A[0] * p->x + A[1] * p->y, A[2] * p->x + A[3] * p->y};
        }
}

static rg_vec2 between(const rg_line *q, double t) { return (rg_vec2){q->a.x + t * (q->b.x - q->a.x), q->a.y + t * (q->b.y - q->a.y)}; }

static void draw(rg_lines *l, dice *d)
{
    static const double parts[] = {0, 1, 0.5, 1.0 / 3, 0.25, 0.41421356237309503};
    const rg_line *q = &l->line[dice_below(d, (size_t)l->count)], *r = &l->line[dice_below(d, (size_t)l->count)];
    const rg_vec2 a = between(q, parts[dice_below(d, 6)]), b = between(r, parts[dice_below(d, 6)]);
    if (l->count < MOST_LINES) rg_lines_add(l, a, b, "MVMVUF"[dice_below(d, 6)], 0);
}

static void change(rg_lines *l, dice *d)
{
    const size_t k = dice_below(d, (size_t)l->count);
    rg_line *q = &l->line[k];
    switch (dice_below(d, 8)) {
    case 0: q->assignment = "MVFUBC"[dice_below(d, 6)]; break;
    case 1: if (q->assignment != 'B') q->assignment = q->assignment == 'M' ? 'V' : 'M'; break;
    case 2: if (q->assignment != 'B') q->target = RG_PI / 180 * ((double)dice_below(d, 9) * 45 - 180); break;
    case 3: if (q->assignment != 'B') q->target = RG_PI * fraction(d); break;
    case 4: if (l->count > 1 && q->assignment != 'B') *q = l->line[--l->count]; break;
    case 5: draw(l, d); break;
    case 6: map(l, d); break;
    default: move(l, d);
    }
}

static size_t put_opx(const rg_lines *l, char *out, size_t room)
{
    size_t n = (size_t)snprintf(out, room, "<java class=\"java.beans.XMLDecoder\"><object class=\"oripa.DataSet\"><void property=\"lines\">"
                                           "<array class=\"oripa.OriLineProxy\" length=\"%d\">\n", (int)l->count);
    for (int32_t i = 0; i < l->count && n < room; i++) {
        const rg_line *q = &l->line[i];
        const char *const codes = "FBMVU....C", *code = strchr(codes, q->assignment);
        const double x[4] = {q->a.x, -q->a.y, q->b.x, -q->b.y};
        n += (size_t)snprintf(out + n, room - n, "<void index=\"%d\"><object class=\"oripa.OriLineProxy\"><void property=\"type\"><int>%d</int></void>",
                              (int)i, code ? (int)(code - codes) : 0);
        for (int k = 0; k < 4 && n < room; k++)
            n += (size_t)snprintf(out + n, room - n, "<void property=\"%s\"><double>%.17g</double></void>", (const char *[]){"x0", "y0", "x1", "y1"}[k], x[k]);
        if (n < room) n += (size_t)snprintf(out + n, room - n, "</object></void>\n");
    }
    if (n < room) n += (size_t)snprintf(out + n, room - n, "</array></void></object></java>\n");
    return n < room ? n : 0;
}

static size_t put_fold(const rg_lines *l, char *out, size_t room)
{
    rg_vec2 X[2 * MOST_LINES];
    int32_t end[2 * MOST_LINES], nv = 0;
    for (int32_t k = 0; k < 2 * l->count; k++) {
        const rg_vec2 p = k % 2 ? l->line[k / 2].b : l->line[k / 2].a;
        for (end[k] = 0; end[k] < nv && !same(X[end[k]], p);) end[k]++;
        if (end[k] == nv) X[nv++] = p;
    }
    size_t n = (size_t)snprintf(out, room, "{\"file_spec\":1.1,\"vertices_coords\":[");
    for (int32_t v = 0; v < nv && n < room; v++) n += (size_t)snprintf(out + n, room - n, "%s[%.17g,%.17g]", v ? "," : "", X[v].x, X[v].y);
    if (n < room) n += (size_t)snprintf(out + n, room - n, "],\n\"edges_vertices\":[");
    for (int32_t i = 0; i < l->count && n < room; i++)
        n += (size_t)snprintf(out + n, room - n, "%s[%d,%d]", i ? "," : "", (int)end[2 * i], (int)end[2 * i + 1]);
    if (n < room) n += (size_t)snprintf(out + n, room - n, "],\n\"edges_assignment\":[");
    for (int32_t i = 0; i < l->count && n < room; i++) n += (size_t)snprintf(out + n, room - n, "%s\"%c\"", i ? "," : "", l->line[i].assignment);
    if (n < room) n += (size_t)snprintf(out + n, room - n, "],\n\"edges_foldAngle\":[");
    for (int32_t i = 0; i < l->count && n < room; i++) {
        if (isfinite(l->line[i].target)) n += (size_t)snprintf(out + n, room - n, "%s%.17g", i ? "," : "", l->line[i].target * 180 / RG_PI);
        else n += (size_t)snprintf(out + n, room - n, "%snull", i ? "," : "");
    }
    if (n < room) n += (size_t)snprintf(out + n, room - n, "]}\n");
    return n < room ? n : 0;
}

size_t mutate_lines(uint8_t *data, size_t size, size_t most, dice *d)
{
    enum { ROOM = 1 << 17 };
    static char out[ROOM];
    const rg_reading s = rg_reading_default();
    rg_lines l;
    rg_diag why;
    if (rg_read_bytes(data, size, NULL, &s, 0, &l, &why) != RG_OK) return 0;
    size_t n = 0;
    if (l.count > 0 && l.count <= MOST_LINES) {
        for (size_t k = 1 + dice_below(d, 5); k > 0; k--) change(&l, d);
        n = dice_below(d, 2) ? put_opx(&l, out, ROOM) : put_fold(&l, out, ROOM);
        if (n > most) n = put_fold(&l, out, ROOM); /* the shorter of them */
    }
    rg_lines_free(&l);
    if (n == 0 || n > most) return 0;
    memcpy(data, out, n);
    return n;
}
