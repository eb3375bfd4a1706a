/* number.h -- decimal numbers as text, the same whatever the locale says of decimal points.
 * Used by  readers, writers.  Thread safety: as long as nobody changes the locale meanwhile. */
#ifndef RG_NUMBER_H
#define RG_NUMBER_H

#include <stddef.h>

/* Reads the longest number that s[0 ... n-1] begins with: sign, digits, point, exponent. Returns how many characters it
 * takes, 0 where there is none. Too large: +-INFINITY. Of any length, rounded to the nearest. */
size_t rg_number_scan(const char *s, size_t n, double *value);
/* All of s, but for blanks around, is a number; also Java's NaN, Infinity and -Infinity. */
int rg_number_parse(const char *s, size_t n, double *value);
/* All of s, but for blanks around, is a whole number that fits. */
int rg_number_whole(const char *s, size_t n, long *value);

/* Degrees of an angle in radians: the round number where that is the one that was read, such as 60 and not
 * 59.99999999999999. */
double rg_number_degrees(double radians);

/* Degrees or percent for people to read: without the rounding of whatever computed them. */
double rg_number_tidy(double value);

enum { RG_NUMBER_ROOM = 40 };
/* The shortest text that reads back as the same number; -0 is written as 0. Returns `text`. */
const char *rg_number_print(char text[RG_NUMBER_ROOM], double value);

#endif
