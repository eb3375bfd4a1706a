#include "base/text.h"
#include "base/utf8.h"

#include <locale.h>

/* The caller's locale may have a decimal comma: for the time of one call this thread has none. */
typedef struct plain { locale_t made, before; } plain;

static plain enter(void)
{
    plain p = {newlocale(LC_ALL_MASK, "C", (locale_t)0), (locale_t)0};
    if (p.made) p.before = uselocale(p.made);
    return p;
}

static void leave(plain p)
{
    if (!p.made) return;
    uselocale(p.before);
    freelocale(p.made);
}

int rg_text_with(char *text, size_t room, const char *format, va_list args)
{
    const plain p = enter();
    const int n = vsnprintf(text, room, format, args);
    leave(p);
    return n;
}

int rg_text(char *text, size_t room, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const int n = rg_text_with(text, room, format, args);
    va_end(args);
    return n;
}

void rg_text_shown(FILE *out, const char *text)
{
    for (size_t n; *text; text += n) {
        const unsigned char *s = (const unsigned char *)text;
        const size_t bytes = rg_utf8_character(s), shown = rg_utf8_shown(s);
        n = bytes ? bytes : 1;
        if (shown) fwrite(text, 1, n, out);
        else fputc(bytes ? ' ' : '?', out);
    }
}

int rg_text_to(FILE *out, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const plain p = enter();
    const int n = vfprintf(out, format, args);
    leave(p);
    va_end(args);
    return n;
}
