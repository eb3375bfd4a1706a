#include "read/tables.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------- layers ---- */

/* Names are the same in small and capital letters; where both are there all the same, each is its own, and of two that
 * are the same to the byte the later one counts: it comes first. */
static int by_layer_name(const void *a, const void *b)
{
    const rg_layer_name *p = a, *q = b;
    int order = rg_slice_compare(p->name, q->name);
    if (!order && p->name.n) order = memcmp(p->name.s, q->name.s, p->name.n);
    return order ? order : (p->layer < q->layer) - (p->layer > q->layer);
}

static rg_status sort_layers(rg_tables *t, const rg_memory *mem)
{
    if (t->layers == 0) return RG_OK;
    const rg_status s = RG_MEM_GROW(mem, t->by_name, t->by_name_room, (size_t)t->layers);
    if (s != RG_OK) return s;
    for (int32_t i = 0; i < t->layers; i++) t->by_name[i] = (rg_layer_name){t->layer[i].name, i};
    qsort(t->by_name, (size_t)t->layers, sizeof *t->by_name, by_layer_name);
    return RG_OK;
}

static rg_status read_layers(rg_tables *t, rg_pairs *p, const rg_memory *mem)
{
    rg_layer *l = NULL;
    for (rg_status s;;) {
        if ((s = rg_pairs_next(p)) != RG_OK) return s;
        if (p->code == 0) l = NULL;
        if (p->code == 0 && rg_slice_is(p->value, "ENDSEC")) return RG_OK;
        if (p->code == 0 && rg_slice_is(p->value, "EOF")) return p->pending = 1, RG_OK;
        if (p->code == 0 && rg_slice_is(p->value, "LAYER")) {
            if (t->layers == INT32_MAX) return RG_ENOMEM;
            s = RG_MEM_GROW(mem, t->layer, t->layer_room, (size_t)t->layers + 1);
            if (s != RG_OK) return s;
            l = &t->layer[t->layers++];
            *l = (rg_layer){.name = {"", 0}, .dash = {"", 0}, .colour = RG_DXF_WHITE};
        }
        if (l && p->code == 2) l->name = p->value;
        if (l && p->code == 6) l->dash = p->value;
        if (l && p->code == 70) {
            long flags;
            if ((s = rg_pairs_whole(p, &flags)) != RG_OK) return s;
            if (flags & 1) l->hidden = RG_LAYER_FROZEN;
        }
        if (l && p->code == 62) {
            long colour;
            if ((s = rg_pairs_whole(p, &colour)) != RG_OK) return s;
            l->colour = colour > -256 && colour < 0 ? (int)-colour : (int)(colour & 255);
            if (colour < 0 && !l->hidden) l->hidden = RG_LAYER_OFF;
        }
    }
}

rg_status rg_tables_read_layers(rg_tables *t, rg_pairs *p, const rg_memory *mem)
{
    const rg_status s = read_layers(t, p, mem);
    return s == RG_OK ? sort_layers(t, mem) : s;
}

rg_layer *rg_tables_layer(const rg_tables *t, rg_slice name)
{
    const rg_layer_name key = {name, INT32_MAX};
    int32_t low = 0, high = t->layers;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (by_layer_name(&t->by_name[middle], &key) < 0) low = middle + 1;
        else high = middle;
    }
    /* there, or else beside it, spelt in another way */
    for (int32_t i = low; i >= 0 && i >= low - 1; i--)
        if (i < t->layers && rg_slice_compare(t->by_name[i].name, name) == 0) return &t->layer[t->by_name[i].layer];
    return NULL;
}

/* ------------------------------------------------------------------------------------------------- blocks ---- */

static int by_block_name(const void *a, const void *b)
{
    const rg_block *p = a, *q = b;
    const int order = rg_slice_compare(p->name, q->name);
    return order ? order : (p->order > q->order) - (p->order < q->order);
}

const rg_block *rg_tables_block(const rg_tables *t, rg_slice name)
{
    int32_t low = 0, high = t->blocks;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (rg_slice_compare(t->block[middle].name, name) < 0) low = middle + 1;
        else high = middle;
    }
    return low < t->blocks && rg_slice_compare(t->block[low].name, name) == 0 ? &t->block[low] : NULL;
}

rg_status rg_tables_read_blocks(rg_tables *t, rg_pairs *p, const rg_memory *mem)
{
    rg_block *open = NULL;
    for (rg_status s;;) {
        const char *here = p->s;
        const int32_t line = p->line;
        if ((s = rg_pairs_next(p)) != RG_OK) return s;
        if (p->code == 0 && open) {
            open->s = here;
            open->line = line;
            open = NULL;
        }
        if (p->code == 0 && rg_slice_is(p->value, "EOF")) p->pending = 1;
        if (p->code == 0 && (rg_slice_is(p->value, "ENDSEC") || p->pending)) break;
        if (p->code == 0 && rg_slice_is(p->value, "BLOCK")) {
            if (t->blocks == INT32_MAX) return RG_ENOMEM;
            s = RG_MEM_GROW(mem, t->block, t->block_room, (size_t)t->blocks + 1);
            if (s != RG_OK) return s;
            open = &t->block[t->blocks];
            *open = (rg_block){.name = {"", 0}, .order = t->blocks++};
        }
        if (open && p->code == 2) open->name = p->value;
        if (open && p->code == 10) s = rg_pairs_number(p, &open->base.x);
        if (open && p->code == 20) s = rg_pairs_number(p, &open->base.y);
        if (open && p->code == 30) s = rg_pairs_number(p, &open->base.z);
        if (s != RG_OK) return s;
    }
    if (t->blocks > 0) qsort(t->block, (size_t)t->blocks, sizeof *t->block, by_block_name);
    return RG_OK;
}

void rg_tables_free(rg_tables *t, const rg_memory *mem)
{
    RG_MEM_FREE(mem, t->layer, t->by_name, t->block);
}
