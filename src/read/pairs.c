#include "read/pairs.h"
#include "base/number.h"
#include "base/status.h"

#include <math.h>
#include <string.h>

/* What a pair costs beside its bytes. */
enum { OF_PAIR = 16 };

/* Without the blanks around it. */
static rg_slice next_line(rg_pairs *p)
{
    const char *from = p->s;
    while (p->s < p->end && *p->s != '\n' && *p->s != '\r') p->s++;
    rg_slice l = {from, (size_t)(p->s - from)};
    if (p->s < p->end) p->s += *p->s == '\r' && p->s + 1 < p->end && p->s[1] == '\n' ? 2 : 1;
    if (p->line < INT32_MAX) p->line++;
    while (l.n > 0 && (*l.s == ' ' || *l.s == '\t')) l.s++, l.n--;
    while (l.n > 0 && (l.s[l.n - 1] == ' ' || l.s[l.n - 1] == '\t')) l.n--;
    return l;
}

static rg_status cut_short(const rg_pairs *p)
{
    return rg_fail(RG_EFORMAT, p->why, p->line, "the file ends here, without EOF: it is cut short");
}

rg_status rg_pairs_next(rg_pairs *p)
{
    if (p->pending) return p->pending = 0, RG_OK;
    if (p->s >= p->end) return cut_short(p);
    const rg_slice code = next_line(p);
    if (!rg_number_whole(code.s, code.n, &p->code))
        return rg_fail(RG_EFORMAT, p->why, p->line, "group code \"%.*s\" is no whole number", RG_SHOWN(code));
    if (p->s >= p->end) return cut_short(p);
    p->value = next_line(p);
    return rg_lines_go_on(p->out, code.n + p->value.n + OF_PAIR);
}

rg_status rg_pairs_whole(const rg_pairs *p, long *x)
{
    if (rg_number_whole(p->value.s, p->value.n, x)) return RG_OK;
    return rg_fail(RG_EFORMAT, p->why, p->line, "group %ld is \"%.*s\", which is no whole number", p->code,
                   RG_SHOWN(p->value));
}

rg_status rg_pairs_number(const rg_pairs *p, double *x)
{
    if (rg_number_parse(p->value.s, p->value.n, x) && isfinite(*x)) return RG_OK;
    return rg_fail(RG_EFORMAT, p->why, p->line, "group %ld is \"%.*s\", which is no finite number", p->code,
                   RG_SHOWN(p->value));
}

int rg_slice_is(rg_slice s, const char *word) { return s.n == strlen(word) && memcmp(s.s, word, s.n) == 0; }

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

int rg_slice_compare(rg_slice a, rg_slice b)
{
    for (size_t i = 0; i < a.n && i < b.n; i++)
        if (lower(a.s[i]) != lower(b.s[i])) return (unsigned char)lower(a.s[i]) < (unsigned char)lower(b.s[i]) ? -1 : 1;
    return (a.n > b.n) - (a.n < b.n);
}
