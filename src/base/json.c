#include "base/json.h"
#include "base/number.h"
#include "base/utf8.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

static void put(rg_json *j, const char *text, size_t n)
{
    if (j->out) fwrite(text, 1, n, j->out);
    j->bytes += n;
}

static void put_text(rg_json *j, const char *text) { put(j, text, strlen(text)); }

static void new_line(rg_json *j)
{
    static const char indent[] = "\n                ";
    put(j, indent, 1 + (size_t)j->depth);
}

static void quoted(rg_json *j, const char *text)
{
    const unsigned char *plain = (const unsigned char *)text, *s = plain; /* from `plain` on nothing is to be escaped */
    put(j, "\"", 1);
    while (*s) {
        const size_t n = rg_utf8_character(s);
        char escape[8] = "";
        if (n == 0) snprintf(escape, sizeof escape, "\\ufffd");
        else if (*s == '"' || *s == '\\') snprintf(escape, sizeof escape, "\\%c", *s);
        else if (*s < 0x20 || *s == '<') snprintf(escape, sizeof escape, "\\u%04x", *s);
        if (escape[0]) {
            put(j, (const char *)plain, (size_t)(s - plain));
            put_text(j, escape);
            plain = s + (n ? n : 1);
        }
        s += n ? n : 1;
    }
    put(j, (const char *)plain, (size_t)(s - plain));
    put(j, "\"", 1);
}

/* What stands before a value: comma, line, key. */
static void before(rg_json *j, const char *key)
{
    const int line = j->level[j->depth].line;
    if (j->level[j->depth].filled) put_text(j, line ? ", " : ",");
    j->level[j->depth].filled = 1;
    if (j->depth > 0 && !line) new_line(j);
    if (!key) return;
    quoted(j, key);
    put_text(j, ": ");
}

void rg_json_begin(rg_json *j, FILE *out)
{
    memset(j, 0, sizeof *j);
    j->out = out;
}

static void enter(rg_json *j, const char *key, char kind, int line)
{
    assert(j->depth < RG_JSON_DEPTH && (kind == '{' || kind == '['));
    before(j, key);
    put(j, &kind, 1);
    line |= j->level[j->depth].line;
    j->depth++;
    j->level[j->depth].end = kind == '{' ? '}' : ']';
    j->level[j->depth].line = line != 0;
    j->level[j->depth].filled = 0;
}

void rg_json_open(rg_json *j, const char *key, char kind) { enter(j, key, kind, 0); }
void rg_json_open_line(rg_json *j, const char *key, char kind) { enter(j, key, kind, 1); }

void rg_json_close(rg_json *j)
{
    assert(j->depth > 0);
    const char end = (char)j->level[j->depth].end;
    const int lines = j->level[j->depth].filled && !j->level[j->depth].line;
    j->depth--;
    if (lines) new_line(j);
    put(j, &end, 1);
    if (j->depth == 0) put(j, "\n", 1);
}

void rg_json_number(rg_json *j, const char *key, double x)
{
    char text[RG_NUMBER_ROOM];
    before(j, key);
    put_text(j, isfinite(x) ? rg_number_print(text, x) : "null");
}

void rg_json_numbers(rg_json *j, const char *key, const double *x, int32_t n)
{
    rg_json_open_line(j, key, '[');
    for (int32_t k = 0; k < n; k++) rg_json_number(j, NULL, x[k]);
    rg_json_close(j);
}

void rg_json_integer(rg_json *j, const char *key, int64_t i)
{
    char text[RG_NUMBER_ROOM];
    before(j, key);
    snprintf(text, sizeof text, "%" PRId64, i);
    put_text(j, text);
}

void rg_json_integers(rg_json *j, const char *key, const int32_t *i, int32_t n)
{
    rg_json_open_line(j, key, '[');
    for (int32_t k = 0; k < n; k++) rg_json_integer(j, NULL, i[k]);
    rg_json_close(j);
}

void rg_json_bool(rg_json *j, const char *key, int yes)
{
    before(j, key);
    put_text(j, yes ? "true" : "false");
}

void rg_json_string(rg_json *j, const char *key, const char *text)
{
    before(j, key);
    if (text) quoted(j, text);
    else put_text(j, "null");
}
