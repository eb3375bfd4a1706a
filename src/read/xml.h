/* xml.h -- an XML file as a tree of elements.
 * Uses  libxml2        Used by  css.c ids.c opx.c select.c
 *
 * Loads nothing from anywhere. Of entities only plain text that the file itself declares is opened, and in sum no more
 * than 16 MB; other ones are refused where what they stand for would matter. Depth and length of names are bounded by
 * the parser, attributes of an element to 1000, the rest by the size of the input. */
#ifndef RG_XML_H
#define RG_XML_H

#include "base/memory.h"
#include "base/stop.h"

typedef struct _xmlDoc rg_xml;       /* known by name only: the library's header stays in xml.c */
typedef struct _xmlNode rg_xml_node; /* lent by its document */

/* Whether a document type may be declared: drawing programs do so, and some of them name an entity or two there. */
typedef enum rg_xml_type { RG_XML_NO_TYPE, RG_XML_ANY_TYPE } rg_xml_type;

/* RG_EFORMAT: not well-formed, a document type where there may be none; why->line, why->text. RG_ENOMEM.
 * RG_ECANCELLED: by `stop`, which may be NULL. Owner: the caller, rg_xml_free. */
rg_status rg_xml_parse(const void *bytes, size_t size, rg_xml_type type, const rg_stop *stop, rg_xml **doc,
                       rg_diag *why);
void rg_xml_free(rg_xml *doc);
const rg_xml_node *rg_xml_root(const rg_xml *doc);

/* The first element inside, the next element beside; NULL: none. */
const rg_xml_node *rg_xml_child(const rg_xml_node *n);
const rg_xml_node *rg_xml_next(const rg_xml_node *n);
/* The element around, the element before; NULL: none. */
const rg_xml_node *rg_xml_parent(const rg_xml_node *n);
const rg_xml_node *rg_xml_previous(const rg_xml_node *n);
/* The same for every piece, text too. */
const rg_xml_node *rg_xml_child_piece(const rg_xml_node *n);
const rg_xml_node *rg_xml_next_piece(const rg_xml_node *n);

/* An element of that name, without prefix. */
int rg_xml_is(const rg_xml_node *n, const char *name);
const char *rg_xml_name(const rg_xml_node *n);
int rg_xml_line(const rg_xml_node *n);
/* The value of an attribute, or "". */
const char *rg_xml_attribute(const rg_xml_node *n, const char *name);
/* The same; NULL: it is not there. */
const char *rg_xml_given(const rg_xml_node *n, const char *name);
/* Bytes of the values of all attributes. */
size_t rg_xml_attributes_size(const rg_xml_node *n);
/* The text of a piece, or NULL. */
const char *rg_xml_piece(const rg_xml_node *n);
/* The first text inside an element, or "". */
const char *rg_xml_text(const rg_xml_node *n);
/* All the text directly inside, joined. NULL: no memory. Owner: the caller. */
char *rg_xml_string(const rg_memory *mem, const rg_xml_node *n);

#endif
