#include "save/cp.h"
#include "base/file.h"
#include "base/number.h"

static int code(char assignment)
{
    switch (assignment) {
    case RG_BORDER: return 1;
    case RG_MOUNTAIN: return 2;
    case RG_VALLEY: return 3;
    default: return 4;
    }
}

rg_status rg_cp_write(const rg_lines *l, const rg_dest *to, rg_diag *why)
{
    rg_file f;
    rg_status s = rg_file_begin_to(&f, &l->mem, to, why);
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < l->count; i++) {
        const rg_line *q = &l->line[i];
        char text[4][RG_NUMBER_ROOM];
        fprintf(f.stream, "%d %s %s %s %s\n", code(q->assignment), rg_number_print(text[0], q->a.x),
                rg_number_print(text[1], -q->a.y), rg_number_print(text[2], q->b.x), rg_number_print(text[3], -q->b.y));
    }
    return rg_file_commit(&f, why);
}
