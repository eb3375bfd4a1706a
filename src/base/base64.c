#include "base/base64.h"

#include <string.h>

char *rg_base64_text(const rg_memory *mem, const char *prefix, const unsigned char *bytes, size_t n)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t before = strlen(prefix), groups = n / 3 + (n % 3 != 0);
    char *text = groups < (size_t)-1 / 8 ? rg_mem_array(mem, before + 4 * groups + 1, 1) : NULL, *to = text;
    if (!text) return NULL;
    memcpy(to, prefix, before);
    to += before;
    for (size_t i = 0; i < n; i += 3) {
        const unsigned b = i + 1 < n ? bytes[i + 1] : 0, c = i + 2 < n ? bytes[i + 2] : 0;
        const unsigned group = (unsigned)bytes[i] << 16 | b << 8 | c;
        *to++ = digit[group >> 18];
        *to++ = digit[group >> 12 & 63];
        *to++ = i + 1 < n ? digit[group >> 6 & 63] : '=';
        *to++ = i + 2 < n ? digit[group & 63] : '=';
    }
    *to = 0;
    return text;
}
