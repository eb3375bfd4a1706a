#include "verify/apart.h"

rg_status rg_aparts_add(rg_aparts *s, int32_t a, int32_t b, rg_vec3 axis)
{
    const rg_status status = RG_MEM_GROW(&s->mem, s->list, s->room, (size_t)s->n + 1);
    if (status == RG_OK) s->list[s->n++] = (rg_apart){a, b, axis};
    return status;
}

rg_vec3 rg_aparts_next(const rg_aparts *s, int32_t *at, int32_t a, int32_t b)
{
    while (*at < s->n && (s->list[*at].a < a || (s->list[*at].a == a && s->list[*at].b < b))) ++*at;
    return *at < s->n && s->list[*at].a == a && s->list[*at].b == b ? s->list[*at].axis : (rg_vec3){0, 0, 0};
}

void rg_aparts_free(rg_aparts *s)
{
    if (s->mem.resize) rg_mem_free(&s->mem, s->list);
    *s = (rg_aparts){.mem = s->mem};
}
