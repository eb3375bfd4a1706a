#include "base/status.h"
#include "base/text.h"
#include "base/utf8.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *rg_status_text(rg_status s)
{
    static const char *const text[] = {
#define X(name, words) words,
        RG_STATUS_LIST(X)
#undef X
    };
    if ((unsigned)s >= sizeof text / sizeof text[0]) return "unknown status";
    return text[s];
}

const char *rg_version(void)
{
    return RG_VERSION;
}

int rg_version_number(void)
{
    return RG_VERSION_NUMBER;
}

void rg_status_one_line(char *text)
{
    for (size_t n; *text; text += n) {
        const unsigned char *s = (const unsigned char *)text;
        const size_t bytes = rg_utf8_character(s), shown = rg_utf8_shown(s);
        n = bytes ? bytes : 1;
        if (!shown) memset(text, bytes ? ' ' : '?', n);
    }
}

rg_status rg_fail(rg_status s, rg_diag *why, int line, const char *format, ...)
{
    if (why) {
        va_list args;
        va_start(args, format);
        rg_text_with(why->text, sizeof why->text, format, args);
        va_end(args);
        rg_status_one_line(why->text);
        why->line = line;
    }
    return s;
}
