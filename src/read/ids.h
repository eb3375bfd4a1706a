/* ids.h -- the elements of an XML file by their id.
 * Uses  xml.h        Used by  paint.h svg.c */
#ifndef RG_IDS_H
#define RG_IDS_H

#include "read/xml.h"

typedef struct rg_id { const char *name; const rg_xml_node *n; int32_t order; } rg_id; /* lent by the document */

typedef struct rg_ids {
    rg_memory mem;
    rg_id *id; /* sorted by name, then as they come in the file */
    int32_t count;
    size_t room;
} rg_ids;

/* All below `root` and itself. RG_ENOMEM leaves what rg_ids_free takes. */
rg_status rg_ids_init(rg_ids *ids, const rg_memory *mem, const rg_xml_node *root);
void rg_ids_free(rg_ids *ids);
/* The first element of that id; NULL: none. */
const rg_xml_node *rg_ids_find(const rg_ids *ids, const char *name);

#endif
