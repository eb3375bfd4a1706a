#include "read/ids.h"

#include <stdlib.h>
#include <string.h>

static int by_name(const void *a, const void *b)
{
    const rg_id *p = a, *q = b;
    const int order = strcmp(p->name, q->name);
    return order ? order : (p->order > q->order) - (p->order < q->order);
}

/* The parser bounds the depth. */
static rg_status add(rg_ids *ids, const rg_xml_node *n)
{
    const char *name = rg_xml_attribute(n, "id");
    if (*name) {
        if (ids->count == INT32_MAX) return RG_ENOMEM;
        const rg_status s = RG_MEM_GROW(&ids->mem, ids->id, ids->room, (size_t)ids->count + 1);
        if (s != RG_OK) return s;
        ids->id[ids->count] = (rg_id){name, n, ids->count};
        ids->count++;
    }
    rg_status s = RG_OK;
    for (const rg_xml_node *c = rg_xml_child(n); s == RG_OK && c; c = rg_xml_next(c)) s = add(ids, c);
    return s;
}

rg_status rg_ids_init(rg_ids *ids, const rg_memory *mem, const rg_xml_node *root)
{
    *ids = (rg_ids){.mem = *mem};
    const rg_status s = add(ids, root);
    if (s == RG_OK && ids->count > 0) qsort(ids->id, (size_t)ids->count, sizeof *ids->id, by_name);
    return s;
}

void rg_ids_free(rg_ids *ids)
{
    if (ids->mem.resize) rg_mem_free(&ids->mem, ids->id);
    *ids = (rg_ids){.id = NULL};
}

const rg_xml_node *rg_ids_find(const rg_ids *ids, const char *name)
{
    int32_t low = 0, high = ids->count;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (strcmp(ids->id[middle].name, name) < 0) low = middle + 1;
        else high = middle;
    }
    return low < ids->count && strcmp(ids->id[low].name, name) == 0 ? ids->id[low].n : NULL;
}
