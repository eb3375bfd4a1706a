/* text.c -- changes a text by its own pieces: numbers, values of JSON, elements of XML, lines of the rest. What comes out mostly gets
 * past the parser, so that what stands behind it is reached. */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

typedef struct piece { size_t at, n; } piece;

typedef struct text {
    uint8_t *s;
    size_t n, most;
    dice *d;
} text;

/* n bytes at `at` become `with`, if there is room. `with` lies elsewhere. */
static int splice(text *t, piece p, const char *with, size_t n)
{
    if (t->n - p.n + n > t->most) return 0;
    memmove(t->s + p.at + n, t->s + p.at + p.n, t->n - p.at - p.n);
    if (n) memcpy(t->s + p.at, with, n);
    t->n = t->n - p.n + n;
    return 1;
}

static int digit(uint8_t c) { return c >= '0' && c <= '9'; }

/* The first number at or after a place drawn by lot, from the start again where there is none. */
static int a_number(const text *t, piece *p)
{
    if (t->n == 0) return 0;
    const size_t from = dice_below(t->d, t->n);
    for (size_t k = 0; k < t->n; k++) {
        size_t i = (from + k) % t->n;
        if (!digit(t->s[i])) continue;
        while (i > 0 && (digit(t->s[i - 1]) || strchr(".-+eE", t->s[i - 1]))) i--;
        size_t end = i;
        while (end < t->n && t->s[end] && (digit(t->s[end]) || strchr(".-+eE", t->s[end]))) end++;
        *p = (piece){i, end - i};
        return end > i;
    }
    return 0;
}

static int change_number(text *t)
{
    static const char *const known[] = {"0", "-0", "1", "-1", "2", "3", "4", "9", "0.5", "90", "-90", "180", "-180", "180.0000001", "1e-9",
        "2e-5", "1e-300", "4.9e-324", "1e16", "9007199254740993", "1e150", "1e154", "1.7976931348623157e308", "1e309", "NaN", "-Infinity",
        "2147483647", "-2147483648", "4294967296", "9223372036854775807", "-9223372036854775808", "4294967298", "18446744073709551616", "0.1e", "1.", ".5", "+7", "0x10", "00012", "null"};
    piece p, other;
    char with[64], old[64];
    if (!a_number(t, &p)) return 0;
    snprintf(old, sizeof old, "%.*s", (int)(p.n < 60 ? p.n : 60), (const char *)t->s + p.at);
    const double x = strtod(old, NULL);
    switch (dice_below(t->d, 7)) {
    case 0: snprintf(with, sizeof with, "%s", known[dice_below(t->d, sizeof known / sizeof *known)]); break;
    case 1: snprintf(with, sizeof with, "%.17g", -x); break;
    case 2: snprintf(with, sizeof with, "%.17g", x + (double)dice_below(t->d, 3) - 1); break;
    case 3: snprintf(with, sizeof with, "%.17g", x * (1 + 1e-9 * ((double)dice_below(t->d, 200001) - 100000))); break;
    case 4: snprintf(with, sizeof with, "%.17g", x + 1e-3 * ((double)dice_below(t->d, 2001) - 1000)); break;
    case 5: snprintf(with, sizeof with, "%zu", dice_below(t->d, 40)); break;
    default:
        if (!a_number(t, &other)) return 0;
        snprintf(with, sizeof with, "%.*s", (int)(other.n < 60 ? other.n : 60), (const char *)t->s + other.at);
    }
    return splice(t, p, with, strlen(with));
}

/* From an opening bracket, or what else begins a value of JSON, to its end. */
static size_t value_end(const text *t, size_t i)
{
    int depth = 0, quoted = 0;
    for (; i < t->n; i++) {
        const uint8_t c = t->s[i];
        if (quoted) {
            if (c == '\\') i++;
            else if (c == '"') quoted = 0;
        } else if (c == '"') quoted = 1;
        else if (c == '[' || c == '{') depth++;
        else if (c == ']' || c == '}') {
            if (depth == 0) return i;
            if (--depth == 0) return i + 1;
        } else if (c == ',' && depth == 0) return i;
    }
    return t->n;
}

/* Past the end tag of the element that begins at i. */
static size_t element_end(const text *t, size_t i)
{
    int depth = 0;
    while (i < t->n) {
        while (i < t->n && t->s[i] != '<') i++;
        const size_t open = i;
        while (i < t->n && t->s[i] != '>') i++;
        if (i >= t->n) break;
        i++;
        if (t->s[open + 1] == '/') depth--;
        else if (t->s[open + 1] != '?' && t->s[open + 1] != '!' && t->s[i - 2] != '/') depth++;
        if (depth <= 0) return i;
    }
    return t->n;
}

static uint8_t first(const text *t)
{
    size_t i = 0;
    while (i < t->n && (t->s[i] <= ' ' || t->s[i] >= 0x80)) i++;
    return i < t->n ? t->s[i] : 0;
}

/* A piece drawn by lot. Small ones are as likely as large ones, as there are more of them. */
static int a_piece(const text *t, piece *p)
{
    if (t->n < 2) return 0;
    const uint8_t kind = first(t);
    const size_t from = dice_below(t->d, t->n);
    for (size_t k = 0; k < t->n; k++) {
        size_t i = (from + k) % t->n;
        if (kind == '{') {
            if (!strchr("[,:{", t->s[i]) || !t->s[i]) continue;
            p->at = i + 1;
            p->n = value_end(t, i + 1) - p->at;
        } else if (kind == '<') {
            if (t->s[i] != '<' || i + 1 >= t->n || t->s[i + 1] == '/') continue;
            p->at = i;
            p->n = element_end(t, i) - i;
        } else {
            if (t->s[i] != '\n') continue;
            p->at = i + 1;
            for (i++; i < t->n && t->s[i] != '\n'; i++) {}
            p->n = (i < t->n ? i + 1 : i) - p->at;
        }
        if (p->n > 0 && p->at + p->n <= t->n) return 1;
    }
    return 0;
}

static int change_piece(text *t)
{
    piece p, q;
    if (!a_piece(t, &p)) return 0;
    const int json = first(t) == '{';
    if (dice_below(t->d, 3) == 0) { /* without it, and its comma */
        if (json && p.at + p.n < t->n && t->s[p.at + p.n] == ',') p.n++;
        return splice(t, p, "", 0);
    }
    if (!a_piece(t, &q)) return 0;
    char *copy = malloc(q.n + 1);
    if (!copy) abort();
    memcpy(copy, t->s + q.at, q.n);
    copy[q.n] = ',';
    if (dice_below(t->d, 2)) p.n = 0; /* before it, else in its place */
    const int done = splice(t, p, copy, q.n + (json && p.n == 0));
    free(copy);
    return done;
}

size_t mutate_text(uint8_t *data, size_t size, size_t most, dice *d)
{
    text t = {data, size, most, d};
    for (size_t k = 1 + dice_below(d, 4); k > 0; k--) {
        const int done = dice_below(d, 3) ? change_number(&t) : change_piece(&t);
        if (!done) break;
    }
    return t.n;
}
