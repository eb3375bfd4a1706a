#include "read/locate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct cursor { const char *s, *end; } cursor;

static void skip_blanks(cursor *c)
{
    while (c->s < c->end && (*c->s == ' ' || *c->s == '\t' || *c->s == '\n' || *c->s == '\r')) c->s++;
}

static int take(cursor *c, char one)
{
    skip_blanks(c);
    if (c->s == c->end || *c->s != one) return 0;
    c->s++;
    return 1;
}

static void skip_text(cursor *c)
{
    for (c->s++; c->s < c->end && *c->s != '"'; c->s++)
        if (*c->s == '\\' && c->s + 1 < c->end) c->s++;
    if (c->s < c->end) c->s++;
}

static void skip_value(cursor *c)
{
    skip_blanks(c);
    if (c->s < c->end && *c->s != '"' && *c->s != '[' && *c->s != '{') {
        while (c->s < c->end && !strchr(",]} \t\r\n", *c->s)) c->s++;
        return;
    }
    for (long depth = 0; c->s < c->end;) {
        if (*c->s == '"') {
            skip_text(c);
        } else {
            depth += *c->s == '[' || *c->s == '{';
            depth -= *c->s == ']' || *c->s == '}';
            c->s++;
        }
        if (depth == 0) return;
    }
}

static int enter_key(cursor *c, const char *key, size_t n)
{
    if (!take(c, '{')) return 0;
    do {
        skip_blanks(c);
        if (c->s == c->end || *c->s != '"') return 0;
        const char *name = c->s + 1;
        skip_text(c);
        const int found = (size_t)(c->s - name) == n + 1 && memcmp(name, key, n) == 0;
        if (!take(c, ':')) return 0;
        skip_blanks(c);
        if (found) return 1;
        skip_value(c);
    } while (take(c, ','));
    return 0;
}

static int enter_element(cursor *c, long i)
{
    if (!take(c, '[')) return 0;
    for (; i > 0; i--) {
        skip_value(c);
        if (!take(c, ',')) return 0;
    }
    skip_blanks(c);
    return c->s < c->end && *c->s != ']';
}

/* To the value at the path, or as far as there is one on the way. 0: not all the way. */
static int go(cursor *c, const char *path)
{
    skip_blanks(c);
    while (*path) {
        cursor next = *c;
        const size_t n = *path == '[' ? strcspn(path, "]") + 1 : strcspn(path, ".[");
        if (!(*path == '[' ? enter_element(&next, strtol(path + 1, NULL, 10)) : enter_key(&next, path, n))) return 0;
        *c = next;
        path += n;
        if (*path == '.') path++;
    }
    return 1;
}

static int32_t count(const char *s, const char *end)
{
    int32_t lines = 0;
    while (s < end && (s = memchr(s, '\n', (size_t)(end - s)))) s++, lines++;
    return lines;
}

int32_t rg_locate_line(const char *text, size_t size, const char *path)
{
    cursor c = {text, text + size};
    go(&c, path);
    return 1 + count(text, c.s);
}

int32_t rg_locate_told(const char *text, size_t size, const char *message)
{
    char path[160];
    const char *end = strstr(message, ": ");
    snprintf(path, sizeof path, "%.*s", end ? (int)(end - message) : (int)sizeof path, message);
    return rg_locate_line(text, size, path);
}

void rg_locate_lines(const char *text, size_t size, const char *path, int32_t *line, int32_t n)
{
    cursor c = {text, text + size};
    if (!go(&c, path) || !enter_element(&c, 0)) return;
    int32_t here = 1 + count(text, c.s);
    for (int32_t i = 0; i < n; i++) {
        line[i] = here;
        const char *from = c.s;
        skip_value(&c);
        if (!take(&c, ',')) return;
        skip_blanks(&c);
        here += count(from, c.s);
    }
}
