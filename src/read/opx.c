#include "read/opx.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/status.h"
#include "read/xml.h"

#include <stdlib.h>
#include <string.h>

/* The newest ORIPA that is known; later ones may say more than is read here. */
static const int KNOWN_VERSION = 2;
/* ORIPA's largest real patterns have some 10^4 lines; this ends a file made to exhaust memory. */
static const long MOST_LINES = 4000000;

static int is(const rg_xml_node *n, const char *name) { return rg_xml_is(n, name); }
static int line_of(const rg_xml_node *n) { return rg_xml_line(n); }
static const rg_xml_node *child(const rg_xml_node *n) { return rg_xml_child(n); }
static const rg_xml_node *next(const rg_xml_node *n) { return rg_xml_next(n); }
static const char *attribute(const rg_xml_node *n, const char *name) { return rg_xml_attribute(n, name); }
static const char *text(const rg_xml_node *n) { return rg_xml_text(n); }

/* A <string>: text, with control characters as <char code="#1"/>. */
static char *string_value(const rg_memory *mem, const rg_xml_node *n)
{
    size_t length = 0, at = 0;
    for (const rg_xml_node *c = rg_xml_child_piece(n); c; c = rg_xml_next_piece(c))
        length += rg_xml_piece(c) ? strlen(rg_xml_piece(c)) : 1;
    char *s = rg_mem_array(mem, length + 1, 1);
    if (!s) return NULL;
    for (const rg_xml_node *c = rg_xml_child_piece(n); c; c = rg_xml_next_piece(c)) {
        if (is(c, "char")) {
            const char *code = attribute(c, "code");
            long value = code[0] == '#' ? strtol(code + 1, NULL, 16) : ' ';
            s[at++] = value > 0 && value < 128 ? (char)value : ' ';
        } else if (rg_xml_piece(c)) {
            size_t n_bytes = strlen(rg_xml_piece(c));
            memcpy(s + at, rg_xml_piece(c), n_bytes);
            at += n_bytes;
        }
    }
    s[at] = 0;
    return s;
}

static int whole(const char *s, long *value) { return rg_number_whole(s, strlen(s), value); }
static int number(const char *s, double *value) { return rg_number_parse(s, strlen(s), value); }

typedef struct reader {
    rg_lines *out;
    rg_diag *why;
    const rg_xml_node *array;
} reader;

static rg_status line_value(reader *r, const rg_xml_node *entry, const rg_xml_node *object)
{
    static const char *const names[] = {"x0", "y0", "x1", "y1"};
    static const char letters[] = "FBMVU....C"; /* by type code */
    double x[4] = {0, 0, 0, 0};
    long type = 0;
    const char *bad = NULL;
    for (const rg_xml_node *v = child(object); v; v = next(v)) {
        const char *property = attribute(v, "property");
        const rg_xml_node *value = child(v);
        if (!is(v, "void") || !value) continue;
        if (strcmp(property, "type") == 0) {
            if (!is(value, "int") || !whole(text(value), &type))
                return rg_fail(RG_EFORMAT, r->why, line_of(value), "line type \"%.40s\" is no whole number",
                               text(value));
            if (type < 0 || type > 9 || letters[type] == '.')
                return rg_fail(RG_EFORMAT, r->why, line_of(value), "line type %ld is not one of 0 1 2 3 4 9", type);
        }
        for (int i = 0; i < 4; i++) {
            if (strcmp(property, names[i]) != 0) continue;
            if (!number(text(value), &x[i]))
                return rg_fail(RG_EFORMAT, r->why, line_of(value), "%s is \"%.40s\", which is no number", names[i],
                               text(value));
            if (!isfinite(x[i])) bad = names[i];
        }
    }
    int where = line_of(entry);
    if (bad)
        return rg_lines_warn(r->out, where, "line %s dropped: its %s is not a finite number", attribute(entry, "index"),
                             bad);
    return rg_lines_add(r->out, (rg_vec2){x[0], -x[1]}, (rg_vec2){x[2], -x[3]}, letters[type], where);
}

static rg_status array_value(reader *r, const rg_xml_node *array)
{
    if (r->array) return rg_fail(RG_EFORMAT, r->why, line_of(array), "a second list of lines");
    r->array = array;
    for (const rg_xml_node *e = child(array); e; e = next(e)) {
        long index;
        if (!is(e, "void") || !whole(attribute(e, "index"), &index) || index < 0 || index > MOST_LINES)
            return rg_fail(RG_EFORMAT, r->why, line_of(e), "an entry of the lines without a proper index");
        const rg_xml_node *object = child(e);
        if (!object || is(object, "null")) continue;
        if (!is(object, "object"))
            return rg_fail(RG_EFORMAT, r->why, line_of(object), "entry %ld of the lines is a <%.40s>, not an object",
                           index, rg_xml_name(object));
        rg_status s = line_value(r, e, object);
        if (s != RG_OK) return s;
    }
    return RG_OK;
}

/* One property of the data set, by either dialect: its name and the element with its value. */
static rg_status property(reader *r, const char *name, const rg_xml_node *value)
{
    rg_lines *l = r->out;
    struct { const char *name; char **to; } strings[] = {{"title", &l->title}, {"editorName", &l->editor},
        {"originalAuthorName", &l->author}, {"reference", &l->reference}, {"memo", &l->memo}};
    if (strcmp(name, "lines") == 0 && is(value, "array")) return array_value(r, value);
    if (strcmp(name, "mainVersion") == 0) {
        long version;
        if (whole(text(value), &version) && version > KNOWN_VERSION)
            return rg_lines_warn(l, line_of(value), "written by a newer ORIPA (main version %ld): parts may be missed",
                                 version);
    }
    for (int i = 0; i < 5; i++) {
        if (strcmp(name, strings[i].name) != 0 || !is(value, "string")) continue;
        rg_mem_free(&l->mem, *strings[i].to);
        *strings[i].to = string_value(&l->mem, value);
        if (!*strings[i].to) return RG_ENOMEM;
    }
    return RG_OK;
}

static rg_status data_set(reader *r, const rg_xml_node *object)
{
    rg_status s = RG_OK;
    for (const rg_xml_node *v = child(object); v && s == RG_OK; v = next(v)) {
        const rg_xml_node *value = child(v);
        if (!is(v, "void") || !value) continue;
        const char *name = attribute(v, "property");
        if (*name) {
            s = property(r, name, value);
        } else if (strcmp(attribute(v, "method"), "getField") == 0 && is(value, "string")) {
            name = text(value);
            for (const rg_xml_node *set = next(value); set && s == RG_OK; set = next(set)) {
                if (strcmp(attribute(set, "method"), "set") != 0) continue;
                for (const rg_xml_node *given = child(set); given && s == RG_OK; given = next(given))
                    if (*attribute(given, "idref") == 0) s = property(r, name, given);
            }
        }
    }
    return s;
}

static rg_status document(reader *r, const rg_xml *doc)
{
    const rg_xml_node *root = rg_xml_root(doc);
    if (!is(root, "java"))
        return rg_fail(RG_EFORMAT, r->why, line_of(root), "the root is <%.40s>, not ORIPA's <java>", rg_xml_name(root));
    for (const rg_xml_node *o = child(root); o; o = next(o)) {
        if (!is(o, "object") || strcmp(attribute(o, "class"), "oripa.DataSet") != 0) continue;
        rg_status s = data_set(r, o);
        if (s != RG_OK) return s;
        if (!r->array) return rg_fail(RG_EFORMAT, r->why, line_of(o), "the data set has no list of lines");
        return RG_OK;
    }
    return rg_fail(RG_EFORMAT, r->why, line_of(root), "no object of class oripa.DataSet");
}

rg_status rg_opx_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop, rg_lines *out,
                      rg_diag *why)
{
    rg_xml *doc = NULL;
    rg_lines_init(out, mem);
    out->stop = stop;
    out->y_down = 1;
    rg_status s = rg_xml_parse(bytes, size, RG_XML_NO_TYPE, stop, &doc, why);
    if (s == RG_OK) {
        reader r = {out, why, NULL};
        s = document(&r, doc);
        rg_xml_free(doc);
    }
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
