/* rigami gen -- writes an example crease pattern. */
#include "commands.h"
#include "say.h"

#include <stdlib.h>
#include <string.h>

static const int LARGEST = 1000000; /* the library knows what each kind takes */

static int size_of(const char *text, int32_t *n)
{
    const size_t digits = strspn(text, "0123456789");
    *n = digits > 0 && digits < 8 && text[digits] == 0 ? (int32_t)atol(text) : 0;
    if (*n >= 1 && *n <= LARGEST) return ENDS_WELL;
    say("gen: \"%s\" is not a size, a whole number from 1 to %d", text, LARGEST);
    return ENDS_USAGE;
}

/* The name of another format would promise what is not in the file. */
static int is_other_format(const char *name)
{
    static const char *const others[] = {".cp", ".fold", ".svg", ".dxf"};
    const char *dot = strrchr(name, '.');
    for (int i = 0; dot && i < 4; i++)
        if (strcmp(dot, others[i]) == 0) return 1;
    return 0;
}

int cmd_gen(const options *o)
{
    int32_t n = 0, m = 0;
    rg_diag why = {0, ""};
    if (o->operands > 1 && size_of(o->operand[1], &n) != ENDS_WELL) return ENDS_USAGE;
    if (o->operands > 2 && size_of(o->operand[2], &m) != ENDS_WELL) return ENDS_USAGE;
    if (o->outputs != 1) {
        say(o->outputs ? "gen: one -o OUT is enough" : "gen: -o OUT is missing; - is standard output");
        return ENDS_USAGE;
    }
    if (is_other_format(o->output[0])) {
        say("gen: %s: examples are written as .opx; rigami convert makes others of them", o->output[0]);
        return ENDS_USAGE;
    }
    const rg_status s = rg_generate(o->operand[0], n, m, o->angle, o->output[0], &why);
    return s == RG_OK ? ENDS_WELL : say_status(s, s == RG_EARG ? "gen" : NULL, &why);
}
