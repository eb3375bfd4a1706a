#include "input.h"
#include "say.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rg_status slurp(FILE *f, char **bytes, size_t *size, rg_diag *why)
{
    size_t room = 0, got = 0;
    *bytes = NULL;
    *size = 0;
    do {
        if (room - *size < 65536) {
            char *more = realloc(*bytes, room = 2 * room + 131072);
            if (!more) return RG_ENOMEM;
            *bytes = more;
        }
        got = fread(*bytes + *size, 1, room - *size, f);
        *size += got;
    } while (got > 0);
    if (!ferror(f)) return RG_OK;
    snprintf(why->text, sizeof why->text, "%s", strerror(errno));
    return RG_EREAD;
}

int input_read(const options *o, int i, rg_pattern **pattern)
{
    const char *name = o->operand[i];
    rg_diag why = {0, ""};
    rg_status s;
    if (strcmp(name, "-") == 0) {
        char *bytes;
        size_t size;
        s = slurp(stdin, &bytes, &size, &why);
        if (s == RG_OK) s = rg_pattern_parse(bytes, size, &o->settings, pattern, &why);
        free(bytes);
    } else {
        s = rg_pattern_read(name, &o->settings, pattern, &why);
    }
    if (s != RG_OK) return say_status(s, name, &why);
    const rg_diag *warning;
    const int32_t warnings = rg_pattern_warnings(*pattern, &warning);
    for (int32_t w = 0; !o->quiet && w < warnings; w++) say_warning(name, &warning[w]);
    return ENDS_WELL;
}
