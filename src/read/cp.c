#include "read/cp.h"
#include "base/number.h"
#include "base/status.h"

#include <string.h>

enum { FIELDS = 5 };

typedef struct field { const char *s; size_t n; } field;

static int is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
static int is_end(char c) { return c == '\n' || c == '\r'; }

/* The fields of the line at s, the first of them in f[]; *s moves on to the next line. */
static int fields(const char **s, const char *end, field f[FIELDS])
{
    int n = 0;
    const char *c = *s;
    while (c < end && !is_end(*c)) {
        const char *from = c;
        while (c < end && !is_end(*c) && !is_blank(*c)) c++;
        if (c > from && n++ < FIELDS) f[n - 1] = (field){from, (size_t)(c - from)};
        while (c < end && is_blank(*c)) c++;
    }
    if (c < end) c += *c == '\r' && c + 1 < end && c[1] == '\n' ? 2 : 1;
    *s = c;
    return n;
}

static int show(const field *f) { return f->n < 40 ? (int)f->n : 40; }

static rg_status add(rg_lines *out, const field *f, int n, int32_t where, rg_diag *why)
{
    static const char letters[] = "FBMVF"; /* by code */
    long code;
    double x[4];
    if (!rg_number_whole(f[0].s, f[0].n, &code) || code < 0)
        return rg_fail(RG_EFORMAT, why, where,
                       "line type \"%.*s\" is no whole number: 1 border, 2 mountain, 3 valley, 4 auxiliary", show(f),
                       f[0].s);
    if (n != FIELDS) return rg_fail(RG_EFORMAT, why, where, "%d fields, not the five of `type x1 y1 x2 y2`", n);
    for (int i = 0; i < 4; i++)
        if (!rg_number_parse(f[i + 1].s, f[i + 1].n, &x[i]))
            return rg_fail(RG_EFORMAT, why, where, "coordinate \"%.*s\" is no number", show(&f[i + 1]), f[i + 1].s);
    rg_status s = RG_OK;
    if (code > 4) s = rg_lines_warn(out, where, "line type %ld is not known: taken for an auxiliary line", code);
    if (s != RG_OK) return s;
    for (int i = 0; i < 4; i++)
        if (!isfinite(x[i])) return rg_lines_warn(out, where, "a line is dropped: a coordinate is not a finite number");
    return rg_lines_add(out, (rg_vec2){x[0], -x[1]}, (rg_vec2){x[2], -x[3]}, code > 4 ? RG_FLAT : letters[code], where);
}

rg_status rg_cp_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop, rg_lines *out,
                      rg_diag *why)
{
    const char *s = bytes, *end = s + size;
    int32_t where = 0, said = 0;
    rg_status status = RG_OK;
    rg_lines_init(out, mem);
    out->stop = stop;
    out->y_down = 1;
    while (status == RG_OK && s < end) {
        field f[FIELDS];
        const char *from = s;
        const int n = fields(&s, end, f);
        if (where < INT32_MAX) where++;
        if (n == 0) {
            status = rg_lines_go_on(out, (size_t)(s - from));
            continue;
        }
        said++;
        status = add(out, f, n, where, why);
    }
    if (status == RG_OK && !said)
        status = rg_fail(RG_EFORMAT, why, 0, size ? "no lines in the file" : "the file is empty");
    if (status != RG_OK) rg_lines_free(out);
    return status;
}
