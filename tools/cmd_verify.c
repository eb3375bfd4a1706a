/* rigami verify -- is a written motion one that paper can make? */
#include "commands.h"
#include "input.h"
#include "say.h"

int cmd_verify(const options *o)
{
    rg_pattern *given = NULL;
    rg_certificate *c = NULL;
    rg_certificate_info info;
    rg_diag why = {0, ""};
    int status = o->operands > 1 ? input_read(o, 1, &given) : ENDS_WELL;
    if (status == ENDS_WELL) {
        rg_status s = rg_certificate_create(o->operand[0], given, NULL, &c, &why);
        if (s != RG_OK) status = say_no_motion(s, o->operand[0], &why);
    }
    if (status == ENDS_WELL) {
        info = *rg_certificate_get_info(c);
        const rg_status s = o->quiet && !o->json ? RG_OK : rg_certificate_write(c, o->json, "-", &why);
        status = s != RG_OK ? say_status(s, NULL, &why) : info.valid ? ENDS_WELL : ENDS_SHORT;
    }
    rg_certificate_destroy(c);
    rg_pattern_destroy(given);
    return status;
}
