#include "read/opx.h"
#include "base/memory.h"
#include "base/status.h"

#include <limits.h>
#include <locale.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <libxml/SAX2.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

/* The newest ORIPA that is known; later ones may say more than is read here. */
static const int KNOWN_VERSION = 2;
/* ORIPA's largest real patterns have some 10^4 lines; this ends a file made to exhaust memory. */
static const long MOST_LINES = 4000000;

static int is(const xmlNode *n, const char *name)
{
    return n->type == XML_ELEMENT_NODE && strcmp((const char *)n->name, name) == 0;
}

/* Kept by start_element(): libxml2's own number ends at 65535. */
static int line_of(const xmlNode *n) { return (int)(intptr_t)n->_private; }

static const xmlNode *first(const xmlNode *n)
{
    while (n && n->type != XML_ELEMENT_NODE) n = n->next;
    return n;
}

static const xmlNode *child(const xmlNode *n) { return first(n->children); }
static const xmlNode *next(const xmlNode *n) { return first(n->next); }

/* The value of an attribute, or "". Entities were refused, so that a value is one text node at most. */
static const char *attribute(const xmlNode *n, const char *name)
{
    for (const xmlAttr *a = n->properties; a; a = a->next)
        if (strcmp((const char *)a->name, name) == 0 && a->children && a->children->content)
            return (const char *)a->children->content;
    return "";
}

/* A <string>: text, with control characters as <char code="#1"/>. */
static char *string_value(const rg_memory *mem, const xmlNode *n)
{
    size_t length = 0, at = 0;
    for (const xmlNode *c = n->children; c; c = c->next)
        length += c->content ? strlen((const char *)c->content) : 4;
    char *s = rg_mem_array(mem, length + 1, 1);
    if (!s) return NULL;
    for (const xmlNode *c = n->children; c; c = c->next) {
        if (is(c, "char")) {
            const char *code = attribute(c, "code");
            long value = code[0] == '#' ? strtol(code + 1, NULL, 16) : ' ';
            s[at++] = value > 0 && value < 128 ? (char)value : ' ';
        } else if (c->content) {
            size_t n_bytes = strlen((const char *)c->content);
            memcpy(s + at, c->content, n_bytes);
            at += n_bytes;
        }
    }
    s[at] = 0;
    return s;
}

static const char *text(const xmlNode *n)
{
    return n->children && n->children->content ? (const char *)n->children->content : "";
}

/* A whole number, blanks around it allowed. */
static int whole(const char *s, long *value)
{
    char *end;
    *value = strtol(s, &end, 10);
    if (end == s) return 0;
    return end[strspn(end, " \t\r\n")] == 0;
}

/* What Java's Double.toString writes, whatever the locale says of decimal points. */
static int number(const char *s, double *value)
{
    s += strspn(s, " \t\r\n");
    size_t n = strcspn(s, " \t\r\n");
    if (s[n + strspn(s + n, " \t\r\n")] != 0) return 0;
    if (n == 3 && strncmp(s, "NaN", 3) == 0) return *value = NAN, 1;
    const char *digits = s + (*s == '-' || *s == '+');
    if (strncmp(digits, "Infinity", 8) == 0 && (size_t)(digits - s) + 8 == n) return *value = *s == '-' ? -INFINITY : INFINITY, 1;
    if (n == 0 || n > 400 || strspn(s, "0123456789+-.eE") < n || !strpbrk(digits, "0123456789")) return 0;
    char *end;
    double v = strtod(s, &end);
    if (end != s + n) { /* a locale with another decimal point: read again with that one */
        char copy[401];
        memcpy(copy, s, n);
        copy[n] = 0;
        char *point = strchr(copy, '.');
        if (!point) return 0;
        *point = *localeconv()->decimal_point;
        v = strtod(copy, &end);
        if (end != copy + n) return 0;
    }
    *value = v;
    return 1;
}

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    const xmlNode *array;
} reader;

static rg_status line_value(reader *r, const xmlNode *entry, const xmlNode *object)
{
    static const char *const names[] = {"x0", "y0", "x1", "y1"};
    static const char letters[] = "FBMVU....C"; /* by type code */
    double x[4] = {0, 0, 0, 0};
    long type = 0;
    const char *bad = NULL;
    for (const xmlNode *v = child(object); v; v = next(v)) {
        const char *property = attribute(v, "property");
        const xmlNode *value = child(v);
        if (!is(v, "void") || !value) continue;
        if (strcmp(property, "type") == 0) {
            if (!is(value, "int") || !whole(text(value), &type))
                return rg_fail(RG_EFORMAT, r->why, line_of(value), "line type \"%.40s\" is no whole number", text(value));
            if (type < 0 || type > 9 || letters[type] == '.')
                return rg_fail(RG_EFORMAT, r->why, line_of(value), "line type %ld is not one of 0 1 2 3 4 9", type);
        }
        for (int i = 0; i < 4; i++) {
            if (strcmp(property, names[i]) != 0) continue;
            if (!number(text(value), &x[i]))
                return rg_fail(RG_EFORMAT, r->why, line_of(value), "%s is \"%.40s\", which is no number", names[i], text(value));
            if (!isfinite(x[i])) bad = names[i];
        }
    }
    int where = line_of(entry);
    if (bad) return rg_lines_warn(r->out, where, "line %s dropped: its %s is not a finite number", attribute(entry, "index"), bad);
    return rg_lines_add(r->out, (rg_vec2){x[0], -x[1]}, (rg_vec2){x[2], -x[3]}, letters[type], where);
}

static rg_status array_value(reader *r, const xmlNode *array)
{
    if (r->array) return rg_fail(RG_EFORMAT, r->why, line_of(array), "a second list of lines");
    r->array = array;
    for (const xmlNode *e = child(array); e; e = next(e)) {
        long index;
        if (!is(e, "void") || !whole(attribute(e, "index"), &index) || index < 0 || index > MOST_LINES)
            return rg_fail(RG_EFORMAT, r->why, line_of(e), "an entry of the lines without a proper index");
        const xmlNode *object = child(e);
        if (!object || is(object, "null")) continue;
        if (!is(object, "object"))
            return rg_fail(RG_EFORMAT, r->why, line_of(object), "entry %ld of the lines is a <%.40s>, not an object", index,
                           (const char *)object->name);
        rg_status s = line_value(r, e, object);
        if (s != RG_OK) return s;
    }
    return RG_OK;
}

/* One property of the data set, by either dialect: its name and the element with its value. */
static rg_status property(reader *r, const char *name, const xmlNode *value)
{
    rg_lines *l = r->out;
    struct { const char *name; char **to; } strings[] = {{"title", &l->title}, {"editorName", &l->editor},
        {"originalAuthorName", &l->author}, {"reference", &l->reference}, {"memo", &l->memo}};
    if (strcmp(name, "lines") == 0 && is(value, "array")) return array_value(r, value);
    if (strcmp(name, "mainVersion") == 0) {
        long version;
        if (whole(text(value), &version) && version > KNOWN_VERSION)
            return rg_lines_warn(l, line_of(value), "written by a newer ORIPA (main version %ld): parts may be missed", version);
    }
    for (int i = 0; i < 5; i++) {
        if (strcmp(name, strings[i].name) != 0 || !is(value, "string")) continue;
        rg_mem_free(&l->mem, *strings[i].to);
        *strings[i].to = string_value(&l->mem, value);
        if (!*strings[i].to) return RG_ENOMEM;
    }
    return RG_OK;
}

static rg_status data_set(reader *r, const xmlNode *object)
{
    rg_status s = RG_OK;
    for (const xmlNode *v = child(object); v && s == RG_OK; v = next(v)) {
        const xmlNode *value = child(v);
        if (!is(v, "void") || !value) continue;
        const char *name = attribute(v, "property");
        if (*name) {
            s = property(r, name, value);
        } else if (strcmp(attribute(v, "method"), "getField") == 0 && is(value, "string")) {
            name = text(value);
            for (const xmlNode *set = next(value); set && s == RG_OK; set = next(set)) {
                if (strcmp(attribute(set, "method"), "set") != 0) continue;
                for (const xmlNode *given = child(set); given; given = next(given))
                    if (*attribute(given, "idref") == 0) s = property(r, name, given);
            }
        }
    }
    return s;
}

static rg_status document(reader *r, xmlDoc *doc)
{
    const xmlNode *root = xmlDocGetRootElement(doc);
    if (!root || !is(root, "java"))
        return rg_fail(RG_EFORMAT, r->why, root ? line_of(root) : 1, "the root is <%.40s>, not ORIPA's <java>",
                       root ? (const char *)root->name : "");
    for (const xmlNode *o = child(root); o; o = next(o)) {
        if (!is(o, "object") || strcmp(attribute(o, "class"), "oripa.DataSet") != 0) continue;
        rg_status s = data_set(r, o);
        if (s != RG_OK) return s;
        if (!r->array) return rg_fail(RG_EFORMAT, r->why, line_of(o), "the data set has no list of lines");
        return RG_OK;
    }
    return rg_fail(RG_EFORMAT, r->why, line_of(root), "no object of class oripa.DataSet");
}

static void start_element(void *ctx, const xmlChar *name, const xmlChar *prefix, const xmlChar *uri, int namespaces,
                          const xmlChar **namespace, int attributes, int defaulted, const xmlChar **values)
{
    xmlParserCtxt *parser = ctx;
    xmlSAX2StartElementNs(ctx, name, prefix, uri, namespaces, namespace, attributes, defaulted, values);
    if (parser->node && parser->input) parser->node->_private = (void *)(intptr_t)parser->input->line;
}

/* Nothing good comes after a document type: entities that open into gigabytes, files from elsewhere. */
static void refuse_document_type(void *ctx, const xmlChar *name, const xmlChar *public_id, const xmlChar *system_id)
{
    xmlParserCtxt *parser = ctx;
    int *line = parser->_private;
    (void)name, (void)public_id, (void)system_id;
    *line = parser->input ? parser->input->line : 1;
    xmlStopParser(parser);
}

rg_status rg_opx_read(const void *bytes, size_t size, const rg_memory *mem, rg_lines *out, rg_diag *why)
{
    rg_lines_init(out, mem);
    if (size == 0) return rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    if (size > INT_MAX) return rg_fail(RG_EFORMAT, why, 0, "the file is larger than 2 GB");
    xmlParserCtxt *parser = xmlNewParserCtxt();
    if (!parser) return RG_ENOMEM;
    int document_type = 0; /* the line it is declared at */
    parser->_private = &document_type;
    parser->sax->internalSubset = refuse_document_type;
    parser->sax->startElementNs = start_element;
    parser->sax->comment = NULL; /* so that a text is one node, whatever stands in it */
    parser->sax->processingInstruction = NULL;
    const int options = XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING | XML_PARSE_NOCDATA;
    xmlDoc *doc = xmlCtxtReadMemory(parser, bytes, (int)size, NULL, NULL, options);
    rg_status s;
    if (document_type) {
        s = rg_fail(RG_EFORMAT, why, document_type, "a document type is declared: no ORIPA file has one");
        xmlFreeDoc(doc);
    } else if (doc) {
        reader r = {out, why, NULL};
        s = document(&r, doc);
        xmlFreeDoc(doc);
    } else {
        const xmlError *e = xmlCtxtGetLastError(parser);
        int n = e && e->message ? (int)strcspn(e->message, "\n") : 0;
        s = e && e->code == XML_ERR_NO_MEMORY ? RG_ENOMEM
            : rg_fail(RG_EFORMAT, why, e ? e->line : 0, "not well-formed XML: %.*s", n ? n : 7, n ? e->message : "unknown");
    }
    xmlFreeParserCtxt(parser);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
