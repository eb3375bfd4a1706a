#include "save/dxf.h"
#include "base/file.h"
#include "base/number.h"
#include "base/unit.h"

#include <string.h>

/* Of the drawing's size: a dash. */
static const double DASH = 0.01;

typedef struct kind { char assignment; const char *layer, *dashes; int colour; } kind;
static const kind KINDS[] = {{RG_BORDER, "cut", "CONTINUOUS", 3},
                             {RG_MOUNTAIN, "score-mountain", "DASHDOT", 1},
                             {RG_VALLEY, "score-valley", "DASHED", 5},
                             {RG_UNASSIGNED, "score-unassigned", "DOT", 6},
                             {RG_FLAT, "aux", "HIDDEN", 8}};
enum { MOST_KINDS = sizeof KINDS / sizeof *KINDS };

/* Lengths of dashes, in DASH; negative: not drawn, 0: a dot. */
typedef struct dashes { const char *name, *looks; int count; double length[4]; } dashes;
static const dashes DASHES[] = {{"CONTINUOUS", "Solid line", 0, {0}},       {"DASHED", "__ __ __", 2, {2, -1}},
                                {"DASHDOT", "__ . __ . ", 4, {2, -1, 0, -1}}, {"DOT", ". . . .", 2, {0, -1}},
                                {"HIDDEN", "_ _ _ _", 2, {1, -1}}};
enum { MOST_DASHES = sizeof DASHES / sizeof *DASHES };

static const kind *kind_of(char assignment)
{
    for (int i = 0; i < MOST_KINDS; i++)
        if (KINDS[i].assignment == assignment) return &KINDS[i];
    return &KINDS[MOST_KINDS - 1];
}

static void pair(FILE *out, int code, double x)
{
    char text[RG_NUMBER_ROOM];
    fprintf(out, "%3d\n%s\n", code, rg_number_print(text, x));
}

/* $INSUNITS; 0: none. */
static int unit_code(double metres)
{
    static const struct { const char *name; int code; } codes[] = {{"in", 1}, {"mm", 4}, {"cm", 5},
                                                                   {"m", 6}, {"um", 13}, {"nm", 12}};
    const char *name = rg_unit_name(metres);
    for (size_t i = 0; name && i < sizeof codes / sizeof *codes; i++)
        if (strcmp(name, codes[i].name) == 0) return codes[i].code;
    return 0;
}

static void tables(FILE *out, double dash)
{
    fprintf(out, "  0\nSECTION\n  2\nTABLES\n  0\nTABLE\n  2\nLTYPE\n 70\n%d\n", MOST_DASHES);
    for (int i = 0; i < MOST_DASHES; i++) {
        const dashes *d = &DASHES[i];
        double sum = 0;
        for (int k = 0; k < d->count; k++) sum += fabs(d->length[k]) * dash;
        fprintf(out, "  0\nLTYPE\n  2\n%s\n 70\n0\n  3\n%s\n 72\n65\n 73\n%d\n", d->name, d->looks, d->count);
        pair(out, 40, sum);
        for (int k = 0; k < d->count; k++) pair(out, 49, d->length[k] * dash);
    }
    fprintf(out, "  0\nENDTAB\n  0\nTABLE\n  2\nLAYER\n 70\n%d\n", MOST_KINDS);
    for (const kind *k = KINDS; k < KINDS + MOST_KINDS; k++)
        fprintf(out, "  0\nLAYER\n  2\n%s\n 70\n0\n 62\n%d\n  6\n%s\n", k->layer, k->colour, k->dashes);
    fputs("  0\nENDTAB\n  0\nENDSEC\n", out);
}

void rg_dxf_put(FILE *out, const rg_line *line, int32_t n, double metres)
{
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t i = 0; i < 2 * n; i++) {
        const rg_vec2 x = i % 2 ? line[i / 2].b : line[i / 2].a;
        low = (rg_vec2){fmin(low.x, x.x), fmin(low.y, x.y)};
        high = (rg_vec2){fmax(high.x, x.x), fmax(high.y, x.y)};
    }
    const double size = n ? fmax(high.x - low.x, high.y - low.y) : 1;
    fprintf(out, "999\nrigami %s\n  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1009\n", RG_VERSION);
    if (unit_code(metres)) fprintf(out, "  9\n$INSUNITS\n 70\n%d\n", unit_code(metres));
    fputs("  0\nENDSEC\n", out);
    tables(out, DASH * size);
    fputs("  0\nSECTION\n  2\nENTITIES\n", out);
    for (int32_t i = 0; i < n; i++) {
        fprintf(out, "  0\nLINE\n  8\n%s\n", kind_of(line[i].assignment)->layer);
        pair(out, 10, line[i].a.x);
        pair(out, 20, line[i].a.y);
        pair(out, 11, line[i].b.x);
        pair(out, 21, line[i].b.y);
    }
    fputs("  0\nENDSEC\n  0\nEOF\n", out);
}

rg_status rg_dxf_write(const rg_lines *l, const rg_dest *to, rg_diag *why)
{
    rg_file f;
    const rg_status s = rg_file_begin_to(&f, &l->mem, to, why);
    if (s != RG_OK) return s;
    rg_dxf_put(f.stream, l->line, l->count, l->metres);
    return rg_file_commit(&f, why);
}
