/* utf8.h -- where characters begin and end, in text that may be anything.
 * Used by  json.c status.c text.c plot.c opx.c svg.c svgfile.c */
#ifndef RG_UTF8_H
#define RG_UTF8_H

#include <stddef.h>

/* Bytes of the UTF-8 character that begins at s, which ends with 0; 0 if none does. */
static inline size_t rg_utf8_character(const unsigned char *s)
{
    const unsigned char a = s[0];
    const size_t n = a < 0x80 ? 1 : a >= 0xc2 && a < 0xe0 ? 2 : a >= 0xe0 && a < 0xf0 ? 3
                   : a >= 0xf0 && a < 0xf5             ? 4
                                                       : 0;
    for (size_t i = 1; i < n; i++)
        if ((s[i] & 0xc0) != 0x80) return 0;
    const int overlong = (a == 0xe0 && s[1] < 0xa0) || (a == 0xf0 && s[1] < 0x90);
    const int surrogate = a == 0xed && s[1] >= 0xa0, beyond = a == 0xf4 && s[1] >= 0x90;
    return overlong || surrogate || beyond ? 0 : n;
}

/* The same of a character that a terminal shows and does not obey: no control, whether of ASCII or of the 32 that
 * Latin-1 has besides, no end of a line or paragraph, and none that turns round the way in which others are read. */
static inline size_t rg_utf8_shown(const unsigned char *s)
{
    const size_t n = rg_utf8_character(s);
    const int is_control = (n == 1 && (s[0] < 0x20 || s[0] == 0x7f)) || (n == 2 && s[0] == 0xc2 && s[1] < 0xa0);
    /* U+2028 and U+2029, U+202A to U+202E, U+2066 to U+2069 */
    const int is_end = n == 3 && s[0] == 0xe2 && s[1] == 0x80 && s[2] >= 0xa8 && s[2] <= 0xae;
    const int is_way = n == 3 && s[0] == 0xe2 && s[1] == 0x81 && s[2] >= 0xa6 && s[2] <= 0xa9;
    return is_control || is_end || is_way ? 0 : n;
}

/* Whether XML 1.0 can hold that character, of so many bytes. */
static inline int rg_utf8_in_xml(const unsigned char *s, size_t n)
{
    const int is_control = n == 1 && s[0] < 0x20 && s[0] != '\t' && s[0] != '\n' && s[0] != '\r';
    const int is_none = n == 3 && s[0] == 0xef && s[1] == 0xbf && s[2] >= 0xbe; /* U+FFFE, U+FFFF */
    return n > 0 && !is_control && !is_none;
}

#endif
