#include "base/number.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 400, POINT_ROOM = 16 };

static size_t digits(const char *s, size_t n)
{
    size_t i = 0;
    while (i < n && s[i] >= '0' && s[i] <= '9') i++;
    return i;
}

size_t rg_number_scan(const char *s, size_t n, double *value)
{
    size_t at = n > 0 && (*s == '-' || *s == '+'), point;
    const size_t before = digits(s + at, n - at);
    at += before;
    point = at;
    if (at < n && s[at] == '.') {
        const size_t after = digits(s + at + 1, n - at - 1);
        if (before + after > 0) at += 1 + after;
    }
    if (at == 0 || (before == 0 && at == point)) return 0;
    const int has_point = at > point;
    if (at < n && (s[at] == 'e' || s[at] == 'E')) {
        size_t e = at + 1;
        if (e < n && (s[e] == '-' || s[e] == '+')) e++;
        const size_t exponent = digits(s + e, n - e);
        if (exponent > 0) at = e + exponent;
    }
    if (at > LONGEST) return 0;
    char copy[LONGEST + POINT_ROOM + 1];
    const char *sign = localeconv()->decimal_point;
    const size_t width = has_point ? strlen(sign) : 0;
    if (width > POINT_ROOM) return 0;
    memcpy(copy, s, point);
    if (has_point) {
        memcpy(copy + point, sign, width);
        memcpy(copy + point + width, s + point + 1, at - point - 1);
        copy[at - 1 + width] = 0;
    } else {
        memcpy(copy + point, s + point, at - point);
        copy[at] = 0;
    }
    *value = strtod(copy, NULL);
    return at;
}

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* s without the blanks around it. */
static const char *trim(const char *s, size_t *n)
{
    while (*n > 0 && is_blank(*s)) s++, (*n)--;
    while (*n > 0 && is_blank(s[*n - 1])) (*n)--;
    return s;
}

int rg_number_parse(const char *s, size_t n, double *value)
{
    s = trim(s, &n);
    if (n == 3 && memcmp(s, "NaN", 3) == 0) return *value = NAN, 1;
    const size_t sign = n > 0 && (*s == '-' || *s == '+');
    if (n == sign + 8 && memcmp(s + sign, "Infinity", 8) == 0) return *value = *s == '-' ? -INFINITY : INFINITY, 1;
    double v;
    if (n == 0 || rg_number_scan(s, n, &v) != n) return 0;
    *value = v;
    return 1;
}

int rg_number_whole(const char *s, size_t n, long *value)
{
    char copy[RG_NUMBER_ROOM], *end;
    s = trim(s, &n);
    if (n == 0 || n >= sizeof copy) return 0;
    memcpy(copy, s, n);
    copy[n] = 0;
    errno = 0;
    const long v = strtol(copy, &end, 10);
    if (errno != 0 || end != copy + n || is_blank(copy[0])) return 0;
    *value = v;
    return 1;
}

const char *rg_number_print(char text[RG_NUMBER_ROOM], double value)
{
    value += 0.0; /* -0 becomes 0 */
    const char *sign = localeconv()->decimal_point;
    for (int precision = 15; precision <= 17; precision++) {
        snprintf(text, RG_NUMBER_ROOM, "%.*g", precision, value);
        if (strtod(text, NULL) == value) break;
    }
    char *point = strstr(text, sign);
    if (point && strcmp(sign, ".") != 0) {
        const size_t width = strlen(sign);
        *point = '.';
        memmove(point + 1, point + width, strlen(point + width) + 1);
    }
    return text;
}
