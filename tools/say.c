#include "say.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *say_plain(const char *text, char *plain, size_t room)
{
    if (text != plain) snprintf(plain, room, "%s", text);
    for (char *c = plain; *c; c++)
        if ((unsigned char)*c < 32 || *c == 127) *c = '?';
    return plain;
}

void say(const char *format, ...)
{
    char line[8192]; /* two paths of the longest kind */
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    for (char *c = line; *c; c++)
        if ((unsigned char)*c < 32 || *c == 127) *c = '?';
    fprintf(stderr, "rigami: %s\n", line);
}

static int exit_of(rg_status s)
{
    switch (s) {
    case RG_OK: return ENDS_WELL;
    case RG_ENOMEM:
    case RG_EWRITE:
    case RG_EABSENT: return ENDS_UNWRITTEN;
    default: return ENDS_USAGE;
    }
}

static void say_at(const char *file, int line, const char *kind, const char *words)
{
    if (line > 0 && file) say("%s:%d: %s%s", file, line, kind, words);
    else if (file && strncmp(words, file, strlen(file)) != 0) say("%s: %s%s", file, kind, words);
    else say("%s%s", kind, words);
}

int say_status(rg_status s, const char *file, const rg_diag *why)
{
    say_at(file, why->line, "", why->text[0] ? why->text : rg_status_text(s));
    return exit_of(s);
}

int say_no_motion(rg_status s, const char *file, const rg_diag *why)
{
    char text[sizeof why->text + 100];
    if (s != RG_EFORMAT) return say_status(s, file, why);
    snprintf(text, sizeof text, "no motion in FOLD, as rigami fold IN -o motion.fold writes it: %s", why->text);
    say_at(file, why->line, "", text);
    return exit_of(s);
}

void say_warning(const char *file, const rg_diag *what) { say_at(file, what->line, "warning: ", what->text); }
