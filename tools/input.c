#include "input.h"
#include "say.h"

int input_read(const options *o, int i, rg_pattern **pattern)
{
    rg_diag why = {0, ""};
    const rg_status s = rg_pattern_read(o->operand[i], &o->reading, pattern, &why);
    if (s != RG_OK) return say_status(s, o->operand[i], &why);
    const rg_diag *warning;
    const int32_t warnings = rg_pattern_warnings(*pattern, &warning);
    for (int32_t w = 0; !o->quiet && w < warnings; w++) say_warning(o->operand[i], &warning[w]);
    return ENDS_WELL;
}
