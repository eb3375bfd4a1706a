/* rigami gen -- writes an example crease pattern. */
#include "commands.h"
#include "say.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const int LARGEST = 1000000; /* the library knows what each kind takes */

static int size_of(const char *text, int32_t *n)
{
    const size_t digits = strspn(text, "0123456789");
    *n = digits > 0 && digits < 8 && text[digits] == 0 ? (int32_t)atol(text) : 0;
    if (*n >= 1 && *n <= LARGEST) return ENDS_WELL;
    say("gen: \"%s\" is not a size, a whole number from 1 to %d", text, LARGEST);
    return ENDS_USAGE;
}

static int says_units(const char *name)
{
    static const char *const those[] = {".fold", ".svg", ".dxf"};
    const char *dot = strrchr(name, '.');
    for (int i = 0; dot && i < 3; i++)
        if (strcasecmp(dot, those[i]) == 0) return 1;
    return 0;
}

int cmd_gen(const options *o)
{
    rg_example e = o->example;
    rg_diag why = {0, ""};
    if (o->operands > 1 && size_of(o->operand[1], &e.n) != ENDS_WELL) return ENDS_USAGE;
    if (o->operands > 2 && size_of(o->operand[2], &e.m) != ENDS_WELL) return ENDS_USAGE;
    if (o->outputs != 1) {
        say(o->outputs ? "gen: one -o OUT is enough" : "gen: -o OUT is missing; - is standard output");
        return ENDS_USAGE;
    }
    e.unit = e.side > 0 ? o->side_unit : o->cell_unit;
    if (e.side > 0 && e.cell > 0) {
        say("gen: --size and --cell say the same thing twice: one of the two");
        return ENDS_USAGE;
    }
    const rg_status s = rg_example_write(o->operand[0], &e, o->output[0], &why);
    if (s == RG_OK && e.unit > 0 && !says_units(o->output[0]) && !o->quiet)
        say("%s: warning: the file has no place for the unit; .fold, .svg and .dxf do, or rigami fold --unit says it",
            o->output[0]);
    return s == RG_OK ? ENDS_WELL : say_status(s, s == RG_EARG ? "gen" : NULL, &why);
}
