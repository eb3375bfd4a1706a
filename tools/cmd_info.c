/* rigami info -- what a crease pattern is, and whether and why it may not fold. */
#include "commands.h"
#include "input.h"
#include "say.h"

int cmd_info(const options *o)
{
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    int status = input_read(o, 0, &p);
    if (status != ENDS_WELL) return status;
    rg_status s = o->json ? rg_info_write(p, "-", &why) : rg_info_text(p, o->verbose, "-", &why);
    if (s != RG_OK) status = say_status(s, NULL, &why);
    rg_pattern_destroy(p);
    return status;
}
