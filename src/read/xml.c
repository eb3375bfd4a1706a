#include "read/xml.h"
#include "base/status.h"

#include <limits.h>
#include <stdint.h>
#include <string.h>

#include <libxml/SAX2.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

/* Elements that are read before it is asked again whether to go on: a few milliseconds. */
enum { ELEMENTS_UNASKED = 2000 };

/* What the parser hands on to the functions below. */
typedef struct asked {
    int document_type; /* the line it is declared at */
    const rg_stop *stop;
    int unasked, is_stopped;
} asked;

/* libxml2's own number of a line ends at 65535. */
static void start_element(void *ctx, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri, int namespaces,
                          const xmlChar **namespace, int attributes, int defaulted, const xmlChar **values)
{
    xmlParserCtxt *parser = ctx;
    xmlSAX2StartElementNs(ctx, name, prefix, uri, namespaces, namespace, attributes, defaulted, values);
    if (parser->node && parser->input) parser->node->_private = (void *)(intptr_t)parser->input->line;
    asked *q = parser->_private;
    if (++q->unasked < ELEMENTS_UNASKED) return;
    q->unasked = 0;
    if ((q->is_stopped = rg_stop_asked(q->stop))) xmlStopParser(parser);
}

/* Entities that open into gigabytes, files from elsewhere: where no document type is usual, its line is enough. */
static void refuse_document_type(void *ctx, const xmlChar *name, const xmlChar *public_id, const xmlChar *system_id)
{
    xmlParserCtxt *parser = ctx;
    asked *q = parser->_private;
    (void)name, (void)public_id, (void)system_id;
    q->document_type = parser->input ? parser->input->line : 1;
    xmlStopParser(parser);
}

/* Want of memory is not always told to the parser that it happens to, but to the thread; with nobody there, it is
 * printed. */
#if LIBXML_VERSION >= 21200
static void note_memory(void *ctx, const xmlError *e)
#else
static void note_memory(void *ctx, xmlError *e)
#endif
{
    int *none_left = ctx;
    if (e->code == XML_ERR_NO_MEMORY) *none_left = 1;
}

static rg_status parse(const void *bytes, size_t size, rg_xml_type type, const rg_stop *stop, const int *none_left,
                       rg_xml **doc, rg_diag *why)
{
    xmlParserCtxt *parser = xmlNewParserCtxt();
    if (!parser) return RG_ENOMEM;
    asked q = {.stop = stop};
    parser->_private = &q;
    if (type == RG_XML_NO_TYPE) parser->sax->internalSubset = refuse_document_type;
    parser->sax->startElementNs = start_element;
    parser->sax->comment = NULL; /* so that a text is one node, whatever stands in it */
    parser->sax->processingInstruction = NULL;
    const int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOCDATA;
    xmlDoc *read = xmlCtxtReadMemory(parser, bytes, (int)size, NULL, NULL, options);
    rg_status s = RG_OK;
    if (*none_left) {
        s = RG_ENOMEM;
    } else if (q.is_stopped) {
        s = RG_ECANCELLED;
    } else if (q.document_type) {
        s = rg_fail(RG_EFORMAT, why, q.document_type, "a document type is declared: no ORIPA file has one");
    } else if (!read) {
        const xmlError *e = xmlCtxtGetLastError(parser);
        const int n = e && e->message ? (int)strcspn(e->message, "\n") : 0;
        s = rg_fail(RG_EFORMAT, why, e ? e->line : 0, "not well-formed XML: %.*s", n ? n : 7,
                    n ? e->message : "unknown");
    } else if (!xmlDocGetRootElement(read)) {
        s = rg_fail(RG_EFORMAT, why, 1, "XML without a root element");
    }
    xmlFreeParserCtxt(parser);
    if (s == RG_OK) *doc = read;
    else if (read) xmlFreeDoc(read);
    return s;
}

rg_status rg_xml_parse(const void *bytes, size_t size, rg_xml_type type, const rg_stop *stop, rg_xml **doc,
                       rg_diag *why)
{
    if (size == 0) return rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    if (size > INT_MAX) return rg_fail(RG_EFORMAT, why, 0, "the file is larger than 2 GB");
    int none_left = 0;
    const xmlStructuredErrorFunc listener = xmlStructuredError;
    void *his = xmlStructuredErrorContext;
    xmlSetStructuredErrorFunc(&none_left, note_memory);
    const rg_status s = parse(bytes, size, type, stop, &none_left, doc, why);
    xmlSetStructuredErrorFunc(his, listener);
    return s;
}

void rg_xml_free(rg_xml *doc)
{
    if (doc) xmlFreeDoc(doc);
}

const rg_xml_node *rg_xml_root(const rg_xml *doc) { return xmlDocGetRootElement(doc); }

static const xmlNode *element(const xmlNode *n)
{
    while (n && n->type != XML_ELEMENT_NODE) n = n->next;
    return n;
}

const rg_xml_node *rg_xml_child(const rg_xml_node *n) { return element(rg_xml_child_piece(n)); }
const rg_xml_node *rg_xml_next(const rg_xml_node *n) { return element(n->next); }
const rg_xml_node *rg_xml_parent(const rg_xml_node *n)
{
    return n->parent && n->parent->type == XML_ELEMENT_NODE ? n->parent : NULL;
}

const rg_xml_node *rg_xml_previous(const rg_xml_node *n)
{
    do n = n->prev;
    while (n && n->type != XML_ELEMENT_NODE);
    return n;
}

const rg_xml_node *rg_xml_next_piece(const rg_xml_node *n) { return n->next; }

/* What hangs below a reference to an entity is the declaration, shared by all references: it is not gone into. */
const rg_xml_node *rg_xml_child_piece(const rg_xml_node *n) { return n->type == XML_ELEMENT_NODE ? n->children : NULL; }

int rg_xml_is(const rg_xml_node *n, const char *name)
{
    return n->type == XML_ELEMENT_NODE && strcmp((const char *)n->name, name) == 0;
}

const char *rg_xml_name(const rg_xml_node *n) { return n->name ? (const char *)n->name : ""; }

int rg_xml_line(const rg_xml_node *n) { return (int)(intptr_t)n->_private; }

/* Entities are not expanded, so that a value is one text node in all that is read here. */
size_t rg_xml_attributes_size(const rg_xml_node *n)
{
    size_t size = 0;
    for (const xmlAttr *a = n->type == XML_ELEMENT_NODE ? n->properties : NULL; a; a = a->next)
        if (a->children && a->children->content) size += strlen((const char *)a->children->content);
    return size;
}

const char *rg_xml_given(const rg_xml_node *n, const char *name)
{
    for (const xmlAttr *a = n->type == XML_ELEMENT_NODE ? n->properties : NULL; a; a = a->next)
        if (strcmp((const char *)a->name, name) == 0 && a->children && a->children->content)
            return (const char *)a->children->content;
    return NULL;
}

const char *rg_xml_attribute(const rg_xml_node *n, const char *name)
{
    const char *value = rg_xml_given(n, name);
    return value ? value : "";
}

const char *rg_xml_piece(const rg_xml_node *n)
{
    return n->type == XML_TEXT_NODE || n->type == XML_CDATA_SECTION_NODE ? (const char *)n->content : NULL;
}

const char *rg_xml_text(const rg_xml_node *n)
{
    const xmlNode *first = rg_xml_child_piece(n);
    return first && rg_xml_piece(first) ? rg_xml_piece(first) : "";
}

char *rg_xml_string(const rg_memory *mem, const rg_xml_node *n)
{
    size_t length = 0, at = 0;
    for (const xmlNode *c = rg_xml_child_piece(n); c; c = c->next)
        length += rg_xml_piece(c) ? strlen(rg_xml_piece(c)) : 0;
    char *s = rg_mem_array(mem, length + 1, 1);
    for (const xmlNode *c = rg_xml_child_piece(n); s && c; c = c->next) {
        if (!rg_xml_piece(c)) continue;
        const size_t bytes = strlen(rg_xml_piece(c));
        memcpy(s + at, rg_xml_piece(c), bytes);
        at += bytes;
    }
    return s;
}
