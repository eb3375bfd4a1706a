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

/* Bytes that entities may open into, all together: a small file could stand for gigabytes. */
enum { MOST_OPENED = 1 << 24 };

/* What the parser hands on to the functions below. */
typedef struct asked {
    const char *refusal; /* NULL: the file is not refused */
    int refused_at;      /* line */
    size_t opened;
    const rg_stop *stop;
    int unasked, is_stopped, is_short; /* of memory */
} asked;

static void refuse(xmlParserCtxt *parser, const char *why)
{
    asked *q = parser->_private;
    if (!q->refusal) q->refusal = why, q->refused_at = parser->input ? parser->input->line : 1;
    xmlStopParser(parser);
}

/* ---------------------------------------------------------------------------------------------- attributes ---- */

/* The parser compares each attribute of an element with all others, and asks nobody meanwhile: a megabyte of them takes
 * it ten seconds. No drawing has a tenth of these. */
enum { MOST_ATTRIBUTES = 1000 };

/* Behind the word; the end: it is not there. */
static const char *behind(const char *s, const char *end, const char *word)
{
    const size_t n = strlen(word);
    while (s < end && (s = memchr(s, *word, (size_t)(end - s)))) {
        if ((size_t)(end - s) >= n && memcmp(s, word, n) == 0) return s + n;
        s++;
    }
    return end;
}

static int begins(const char *s, const char *end, const char *word)
{
    return (size_t)(end - s) >= strlen(word) && memcmp(s, word, strlen(word)) == 0;
}

/* From behind the < of an element to behind its >; *attributes: how many it has, as far as that. */
static const char *pass_tag(const char *s, const char *end, int *attributes)
{
    for (*attributes = 0; s < end && *s != '>' && *attributes <= MOST_ATTRIBUTES; s++) {
        *attributes += *s == '=';
        if (*s != '"' && *s != '\'') continue;
        s = memchr(s + 1, *s, (size_t)(end - s - 1));
        if (!s) return end;
    }
    return s;
}

/* The line of the first element with more attributes than may be; 0: there is none. */
static int crowded_line(const char *text, const char *end)
{
    int attributes = 0, line = 1;
    const char *s = text;
    while (attributes <= MOST_ATTRIBUTES) {
        s = s < end ? memchr(s, '<', (size_t)(end - s)) : NULL;
        if (!s) return 0;
        s++;
        if (begins(s, end, "!--")) s = behind(s, end, "-->");
        else if (begins(s, end, "![CDATA[")) s = behind(s, end, "]]>");
        else if (begins(s, end, "?")) s = behind(s, end, "?>");
        else if (!begins(s, end, "!")) s = pass_tag(s, end, &attributes);
    }
    for (const char *c = text; c < s; c++) line += *c == '\n';
    return line;
}

/* ------------------------------------------------------------------------------------------------ entities ---- */

/* The parser leaves references to entities where they stand, and opens none. Those that the file itself declares as
 * plain text are opened here: programs keep styles in them. With others, a value would not be what the file says. */

/* NULL: it is no plain text. */
static const xmlChar *text_of(const xmlDoc *doc, const xmlChar *name)
{
    const xmlEntity *e = xmlGetDocEntity(doc, name);
    const int is_text = e && e->etype == XML_INTERNAL_GENERAL_ENTITY && e->content;
    return is_text && !strpbrk((const char *)e->content, "&<") ? e->content : NULL;
}

/* 0: it is too much. */
static int count_opened(xmlParserCtxt *parser, size_t n)
{
    asked *q = parser->_private;
    q->opened += n;
    if (q->opened > MOST_OPENED) refuse(parser, "entities open into more text than any drawing has");
    return q->opened <= MOST_OPENED;
}

/* The value of an attribute becomes one text. */
static void open_value(xmlParserCtxt *parser, xmlAttr *a)
{
    size_t n = 0, at = 0;
    for (const xmlNode *c = a->children; c; c = c->next) {
        const xmlChar *text = c->type == XML_ENTITY_REF_NODE ? text_of(parser->myDoc, c->name) : c->content;
        if (!text && c->type == XML_ENTITY_REF_NODE) {
            refuse(parser, "an entity in a value that is no plain text declared in the file");
            return;
        }
        n += text ? strlen((const char *)text) : 0;
    }
    if (!count_opened(parser, n)) return;
    xmlChar *all = xmlMalloc(n + 1);
    for (const xmlNode *c = a->children; all && c; c = c->next) {
        const xmlChar *text = c->type == XML_ENTITY_REF_NODE ? text_of(parser->myDoc, c->name) : c->content;
        const size_t bytes = text ? strlen((const char *)text) : 0;
        if (bytes) memcpy(all + at, text, bytes);
        at += bytes;
    }
    xmlNode *one = all ? xmlNewDocTextLen(parser->myDoc, all, (int)n) : NULL;
    xmlFree(all);
    if (!one) {
        ((asked *)parser->_private)->is_short = 1;
        xmlStopParser(parser);
        return;
    }
    xmlFreeNodeList(a->children);
    a->children = a->last = one;
    one->parent = (xmlNode *)a;
}

/* Outside of values. In other texts than styles nothing is looked for but words for people. */
static void open_reference(void *ctx, const xmlChar *name)
{
    xmlParserCtxt *parser = ctx;
    const xmlChar *text = text_of(parser->myDoc, name);
    const xmlEntity *e = xmlGetDocEntity(parser->myDoc, name);
    const int is_style = parser->node && xmlStrcmp(parser->node->name, (const xmlChar *)"style") == 0;
    if (text) {
        const size_t n = strlen((const char *)text);
        if (count_opened(parser, n)) xmlSAX2Characters(ctx, text, (int)n);
    } else if (is_style || (e && e->content)) {
        refuse(parser, "an entity that is no plain text declared in the file");
    }
}

/* ------------------------------------------------------------------------------------------------ elements ---- */

/* libxml2's own number of a line ends at 65535. */
static void start_element(void *ctx, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri, int namespaces,
                          const xmlChar **namespace, int attributes, int defaulted, const xmlChar **values)
{
    xmlParserCtxt *parser = ctx;
    xmlSAX2StartElementNs(ctx, name, prefix, uri, namespaces, namespace, attributes, defaulted, values);
    if (parser->node && parser->input) parser->node->_private = (void *)(intptr_t)parser->input->line;
    for (xmlAttr *a = parser->node ? parser->node->properties : NULL; a; a = a->next)
        if (a->children && (a->children->next || a->children->type != XML_TEXT_NODE)) open_value(parser, a);
    asked *q = parser->_private;
    if (++q->unasked < ELEMENTS_UNASKED) return;
    q->unasked = 0;
    if ((q->is_stopped = rg_stop_asked(q->stop))) xmlStopParser(parser);
}

/* Entities that open into gigabytes, files from elsewhere: where no document type is usual, its line is enough. */
static void refuse_document_type(void *ctx, const xmlChar *name, const xmlChar *public_id, const xmlChar *system_id)
{
    (void)name, (void)public_id, (void)system_id;
    refuse(ctx, "a document type is declared: no ORIPA file has one");
}

/* Want of memory is not always told to the parser that it happens to, but to the thread; with nobody there, it is
 * printed. A text beyond the parser's limit of ten megabytes is told in the same way, though by other words. */
typedef struct heard { int none_left, long_text; } heard; /* long_text: its line */

#if LIBXML_VERSION >= 21200
static void note_memory(void *ctx, const xmlError *e)
#else
static void note_memory(void *ctx, xmlError *e)
#endif
{
    heard *h = ctx;
    if (e->code != XML_ERR_NO_MEMORY) return;
    if (e->message && strstr(e->message, "huge text")) h->long_text = e->line > 0 ? e->line : 1;
    else h->none_left = 1;
}

static rg_status parse(const void *bytes, size_t size, rg_xml_type type, const rg_stop *stop, const heard *h,
                       rg_xml **doc, rg_diag *why)
{
    xmlParserCtxt *parser = xmlNewParserCtxt();
    if (!parser) return RG_ENOMEM;
    asked q = {.stop = stop};
    parser->_private = &q;
    if (type == RG_XML_NO_TYPE) parser->sax->internalSubset = refuse_document_type;
    parser->sax->startElementNs = start_element;
    parser->sax->reference = open_reference;
    parser->sax->comment = NULL; /* so that a text is one node, whatever stands in it */
    parser->sax->processingInstruction = NULL;
    const int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOCDATA;
    xmlDoc *read = xmlCtxtReadMemory(parser, bytes, (int)size, NULL, NULL, options);
    rg_status s = RG_OK;
    if (h->none_left || q.is_short) {
        s = RG_ENOMEM;
    } else if (q.is_stopped) {
        s = RG_ECANCELLED;
    } else if (q.refusal) {
        s = rg_fail(RG_EFORMAT, why, q.refused_at, "%s", q.refusal);
    } else if (h->long_text) {
        s = rg_fail(RG_EFORMAT, why, h->long_text, "a text of more than ten megabytes");
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
    const int crowded = crowded_line(bytes, (const char *)bytes + size);
    if (crowded) return rg_fail(RG_EFORMAT, why, crowded, "an element has more than %d attributes", MOST_ATTRIBUTES);
    heard h = {0, 0};
    const xmlStructuredErrorFunc listener = xmlStructuredError;
    void *his = xmlStructuredErrorContext;
    xmlSetStructuredErrorFunc(&h, note_memory);
    const rg_status s = parse(bytes, size, type, stop, &h, doc, why);
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

/* A value is one text, with what entities in it stand for. */
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
