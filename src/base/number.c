#include "base/number.h"
#include "base/vec.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST = 400, POINT_ROOM = 16 };
/* Digits that every double keeps, and that tell any two doubles apart. */
enum { FEWEST = 15, MOST = 17 };
static const double WHOLE = 1e15; /* whole numbers below have no exponent and need no more than 15 digits */

static size_t digits(const char *s, size_t n)
{
    size_t i = 0;
    while (i < n && s[i] >= '0' && s[i] <= '9') i++;
    return i;
}

/* As many digits tell every double from every other and from what lies half-way between two: the rest only says whether
 * it is more. */
enum { TELLING = 770 };
static const long BEYOND = 1000000; /* exponents that are all the same to a double */

static long exponent_of(const char *s, size_t n)
{
    const int back = n > 0 && *s == '-';
    long e = 0;
    for (size_t i = n > 0 && (*s == '-' || *s == '+'); i < n && e < BEYOND; i++) e = 10 * e + (s[i] - '0');
    return back ? -e : e;
}

/* A number of any length, all of s[0 ... n-1]: its first digits and an exponent say the same. */
static size_t read_long(const char *s, size_t n, double *value)
{
    char copy[TELLING + RG_NUMBER_ROOM], *to = copy;
    size_t i = *s == '-' || *s == '+';
    int kept = 0, more = 0, behind = 0;
    double tens = 0; /* the kept digits are to be multiplied with so many */
    if (*s == '-') *to++ = '-';
    for (; i < n && s[i] != 'e' && s[i] != 'E'; i++) {
        if (s[i] == '.') {
            behind = 1;
        } else if (kept == 0 && s[i] == '0') {
            tens -= behind;
        } else if (kept < TELLING) {
            *to++ = s[i];
            kept++;
            tens -= behind;
        } else {
            more |= s[i] != '0';
            tens += !behind;
        }
    }
    if (kept == 0) *to++ = '0';
    if (more) *to++ = '1', tens--;
    if (i < n) tens += (double)exponent_of(s + i + 1, n - i - 1);
    const long shown = tens > (double)BEYOND ? BEYOND : tens < (double)-BEYOND ? -BEYOND : (long)tens;
    snprintf(to, RG_NUMBER_ROOM, "e%ld", shown);
    *value = strtod(copy, NULL);
    return n;
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
    if (at > LONGEST) return read_long(s, at, value);
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

/* ------------------------------------------------------------------------------------------------- print ---- */

/* As many of 15 to 17 digits as it takes, by the library's own means. */
static void print_any(char text[RG_NUMBER_ROOM], double value)
{
    const char *sign = localeconv()->decimal_point;
    for (int precision = FEWEST; precision <= MOST; precision++) {
        snprintf(text, RG_NUMBER_ROOM, "%.*g", precision, value);
        if (strtod(text, NULL) == value) break;
    }
    char *point = strstr(text, sign);
    if (point && strcmp(sign, ".") != 0) {
        const size_t width = strlen(sign);
        *point = '.';
        memmove(point + 1, point + width, strlen(point + width) + 1);
    }
}

/* Digits before the first of which a point belongs behind place `exponent`. */
typedef struct decimal { uint64_t digits; int exponent, precision; } decimal;

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;

static const uint64_t five[] = {
    1, 5, 25, 125, 625, 3125, 15625, 78125, 390625, 1953125, 9765625, 48828125, 244140625, 1220703125, 6103515625,
    30517578125, 152587890625, 762939453125, 3814697265625, 19073486328125, 95367431640625, 476837158203125,
    2384185791015625, 11920928955078125, 59604644775390625, 298023223876953125, 1490116119384765625,
    7450580596923828125};

/* v = m 2^e is scaled to 17 digits before the point: v 10^q = whole + part / 2^s, without rounding. */
typedef struct scaled { uint64_t m, whole; wide part, five; int q, s; } scaled;

enum { LAST_FIVE = 27, MOST_SCALE = 48 }; /* 5^27 < 2^63; 5^48 < 2^112 leaves room for what is computed with it */

/* 10^(17 - 1) <= whole < 10^17. 0: not with numbers of this width. */
static int scale(double v, scaled *x)
{
    static const uint64_t limit = 100000000000000000; /* 10^17 */
    int e;
    x->m = (uint64_t)ldexp(frexp(v, &e), 53);
    /* log10(2) = 0.30103 from below; one less than is wanted at times, never more */
    x->q = MOST - 1 - (int)floor((e - 1) * 0.30102999);
    for (e -= 53;; x->q--) {
        x->s = -(e + x->q);
        if (x->q < 1 || x->q > MOST_SCALE || x->s < 0) return 0;
        x->five = x->q <= LAST_FIVE ? five[x->q] : (wide)five[LAST_FIVE] * five[x->q - LAST_FIVE];
        const wide low = (wide)x->m * (uint64_t)x->five, high = (wide)x->m * (uint64_t)(x->five >> 64) + (low >> 64);
        const int beyond = x->s - 64;
        if (beyond >= 0) {
            x->whole = (uint64_t)(high >> beyond);
            x->part = (high & (((wide)1 << beyond) - 1)) << 64 | (uint64_t)low;
        } else {
            const wide all = high << 64 | (uint64_t)low;
            x->whole = (uint64_t)(all >> x->s);
            x->part = all & (((wide)1 << x->s) - 1);
        }
        if (x->whole < limit) return 1;
    }
}

/* The nearest number of so many digits less than 17; of two that are as near, the even one. */
static uint64_t round_off(const scaled *x, uint64_t unit)
{
    const uint64_t rest = x->whole % unit, digits = x->whole / unit;
    const wide twice = ((wide)rest << x->s | x->part) << 1, one = (wide)unit << x->s;
    return digits + (twice > one || (twice == one && digits % 2 == 1));
}

/* Whether v is the double nearest to a number of digits: no further off than half of the way to the next one. */
static int comes_back(const scaled *x, uint64_t digits)
{
    const uint64_t power_of_two = (uint64_t)1 << 52;
    const int above = digits > x->whole;
    const wide off = above ? ((wide)(digits - x->whole) << x->s) - x->part
        : ((wide)(x->whole - digits) << x->s) + x->part;
    if (x->m == power_of_two && !above) return off << 2 <= x->five; /* the next one down is half as far */
    return off << 1 < x->five || (off << 1 == x->five && x->m % 2 == 0);
}

/* The shortest digits of v > 0; 0: not by this way. */
static int shorten(double v, decimal *d)
{
    scaled x;
    uint64_t unit = 100;
    if (!scale(v, &x)) return 0;
    for (d->precision = FEWEST; d->precision <= MOST; d->precision++, unit /= 10) {
        d->digits = round_off(&x, unit);
        if (unit == 1 || comes_back(&x, d->digits * unit)) break;
    }
    d->exponent = MOST - 1 - x.q;
    return 1;
}
#else
static int shorten(double v, decimal *d) { return (void)v, (void)d, 0; }
#endif

/* Returns the end. */
static char *print_whole(char *to, uint64_t n)
{
    char digit[24], *at = digit + sizeof digit;
    do *--at = (char)('0' + n % 10), n /= 10;
    while (n);
    const size_t length = (size_t)(digit + sizeof digit - at);
    memcpy(to, at, length);
    return to + length;
}

/* As printf's %g has it: with an exponent below 10^-4 and from 10^precision on, and no zeros at the end. */
static void print_decimal(char *to, decimal d)
{
    char digit[24];
    int n = (int)(print_whole(digit, d.digits) - digit);
    const int exponent = d.exponent + n - d.precision; /* 99...9 may have been rounded to 100...0 */
    while (n > 1 && digit[n - 1] == '0') n--;
    const int is_small = exponent < -4, has_exponent = is_small || exponent >= d.precision;
    const int before = has_exponent ? 1 : exponent + 1; /* digits before the point */
    if (before <= 0) {
        memcpy(to, "0.000", 5);
        to += 2 - before;
        memcpy(to, digit, (size_t)n);
        to += n;
    } else {
        for (int i = 0; i < before || i < n; i++) {
            if (i == before) *to++ = '.';
            *to++ = i < n ? digit[i] : '0';
        }
    }
    if (has_exponent) {
        const int size = is_small ? -exponent : exponent;
        *to++ = 'e';
        *to++ = is_small ? '-' : '+';
        if (size < 10) *to++ = '0';
        to = print_whole(to, (uint64_t)size);
    }
    *to = 0;
}

const char *rg_number_print(char text[RG_NUMBER_ROOM], double value)
{
    decimal d;
    char *to = text;
    const double size = fabs(value);
    if (value < 0) *to++ = '-'; /* and not where it is -0 */
    if (size < WHOLE && size == floor(size)) *print_whole(to, (uint64_t)size) = 0;
    else if (isfinite(value) && shorten(size, &d)) print_decimal(to, d);
    else print_any(text, value);
    return text;
}

/* Decimals that people and programs write angles with; fewer than a double holds of 180. */
static const double DECIMALS = 1e10;

double rg_number_degrees(double radians)
{
    const double degree = RG_DEG, exact = radians / degree, rounded = round(exact * DECIMALS) / DECIMALS;
    return rounded * degree == radians ? rounded : exact;
}

/* A 1e-11 part of a degree is 2e-13 radians: far below what any frame is closed to, far above what sums are off by. */
double rg_number_tidy(double value)
{
    const double decimals = 1e11;
    const double tidy = round(value * decimals) / decimals;
    return isfinite(tidy) ? tidy : value; /* so large that it has no decimals */
}
