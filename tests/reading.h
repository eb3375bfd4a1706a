/* reading.h -- texts made up by a test, read by any reader. */
#ifndef READING_H
#define READING_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/memory.h"
#include "near.h"
#include "read/read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline rg_status read_text(const char *text, size_t n, rg_format format, const rg_reading *given, rg_lines *l, rg_diag *why)
{
    rg_reading s = given ? *given : rg_reading_default();
    if (format != RG_FORMAT_AUTO) s.format = format;
    *why = (rg_diag){-1, ""};
    return rg_read_bytes(text, n, NULL, &s, 0, l, why);
}

static inline rg_lines read_ok(const char *text, rg_format format, const rg_reading *s)
{
    rg_lines l;
    rg_diag why;
    const rg_status status = read_text(text, strlen(text), format, s, &l, &why);
    if (status != RG_OK) print_error("line %d: %s\n", why.line, why.text);
    assert_int_equal(status, RG_OK);
    return l;
}

/* Refused at that line (-1: any), with those words in one line of message. */
static inline void refused(const char *text, rg_format format, const rg_reading *s, int line, const char *words)
{
    rg_lines l;
    rg_diag why;
    const rg_status status = read_text(text, strlen(text), format, s, &l, &why);
    if (status == RG_OK) rg_lines_free(&l);
    if (status != RG_EFORMAT || !strstr(why.text, words) || (line >= 0 && why.line != line) || strchr(why.text, '\n')) {
        print_error("status %d, line %d: %s\nnot line %d: ... %s\n", (int)status, why.line, why.text, line, words);
        fail();
    }
}

static inline int warned(const rg_lines *l, const char *words)
{
    for (int32_t i = 0; i < l->warnings; i++)
        if (strstr(l->warning[i].text, words)) return 1;
    return 0;
}

/* Line i is drawn from (ax, ay) to (bx, by), to the last digits; target in degrees, NAN: none. */
static inline void is_line(const rg_lines *l, int32_t i, char assignment, double ax, double ay, double bx, double by, double target)
{
    assert_in_range(i, 0, l->count - 1);
    const rg_line *q = &l->line[i];
    const double tol = 1e-13 * (1 + fabs(ax) + fabs(ay) + fabs(bx) + fabs(by));
    if (q->assignment != assignment) print_error("line %d is %c\n", (int)i, q->assignment);
    assert_int_equal(q->assignment, assignment);
    near(q->a.x, ax, tol);
    near(q->a.y, ay, tol);
    near(q->b.x, bx, tol);
    near(q->b.y, by, tol);
    if (isnan(target)) assert_true(isnan(q->target));
    else near(q->target / RG_DEG, target, 1e-10);
}

#endif
