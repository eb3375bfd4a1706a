/* tables.h -- what stands in a DXF file before its entities: layers, and blocks.
 * Uses  pairs.h        Used by  dxf.c */
#ifndef RG_TABLES_H
#define RG_TABLES_H

#include "base/vec.h"
#include "read/pairs.h"

/* The colour of what has none. */
enum { RG_DXF_WHITE = 7 };
typedef enum rg_unseen { RG_LAYER_SEEN, RG_LAYER_OFF, RG_LAYER_FROZEN } rg_unseen;

typedef struct rg_layer {
    rg_slice name, dash;
    int colour;
    rg_unseen hidden;
    int32_t lines, where; /* the reader's: how many were left out, the first at `where` */
} rg_layer;

typedef struct rg_layer_name { rg_slice name; int32_t layer; } rg_layer_name;

typedef struct rg_block {
    rg_slice name;
    rg_vec3 base;
    const char *s; /* its first entity */
    int32_t line, order;
} rg_block;

typedef struct rg_tables {
    rg_layer *layer;
    int32_t layers;
    size_t layer_room;
    rg_layer_name *by_name; /* sorted */
    size_t by_name_room;
    rg_block *block; /* sorted by name */
    int32_t blocks;
    size_t block_room;
} rg_tables;

/* The section of tables, of which that of layers is read; the section of blocks: what they are called, and where their
 * entities begin. Up to its end. RG_EFORMAT, RG_ENOMEM. */
rg_status rg_tables_read_layers(rg_tables *t, rg_pairs *p, const rg_memory *mem);
rg_status rg_tables_read_blocks(rg_tables *t, rg_pairs *p, const rg_memory *mem);
/* NULL: there is none of that name. Names are the same in small and capital letters. */
rg_layer *rg_tables_layer(const rg_tables *t, rg_slice name);
const rg_block *rg_tables_block(const rg_tables *t, rg_slice name);
void rg_tables_free(rg_tables *t, const rg_memory *mem);

#endif
