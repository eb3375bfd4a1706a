/* rigami convert -- one crease pattern format to another. */
#include "commands.h"
#include "places.h"
#include "say.h"

typedef struct reader { const char *file; int quiet; } reader;

static void pass_on(void *ctx, const rg_diag *warning)
{
    const reader *r = ctx;
    if (!r->quiet) say_warning(r->file, warning);
}

int cmd_convert(const options *o)
{
    reader r = {o->operand[0], o->quiet};
    rg_diag why = {0, ""};
    if (o->outputs != 1) {
        say(o->outputs ? "convert: one -o OUT is enough" : "convert: -o OUT is missing; - is standard output");
        return ENDS_USAGE;
    }
    if (places_check_alone(o, o->output[0]) != ENDS_WELL) return ENDS_USAGE;
    const rg_status s = rg_convert(r.file, o->output[0], (rg_format)o->as, &o->reading, pass_on, &r, &why);
    if (s == RG_OK) return ENDS_WELL;
    return say_status(s, s == RG_EARG ? "convert" : s == RG_EWRITE ? NULL : r.file, &why);
}
