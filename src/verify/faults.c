#include "verify/faults.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>

void rg_faults_add(rg_faults *all, int32_t frame, int32_t f, int32_t g, const char *format, ...)
{
    const int32_t k = all->count++;
    if (k >= RG_FAULTS_KEPT) return;
    va_list args;
    va_start(args, format);
    all->list[k] = (rg_fault){.frame = frame, .facet = {f, g}};
    rg_text_with(all->list[k].text, sizeof all->list[k].text, format, args);
    va_end(args);
}
