#include "save/opx.h"
#include "base/file.h"
#include "base/number.h"
#include "base/status.h"
#include "base/utf8.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include <libxml/xmlwriter.h>

/* The first thing that went wrong is kept; what comes after it does nothing. */
typedef struct writer {
    xmlTextWriter *xml;
    int failed;
} writer;

static void check(writer *w, int written) { w->failed |= written < 0; }

static void open_element(writer *w, const char *name) { check(w, xmlTextWriterStartElement(w->xml, BAD_CAST name)); }
static void close_element(writer *w) { check(w, xmlTextWriterEndElement(w->xml)); }

static void attribute(writer *w, const char *name, const char *value)
{
    check(w, xmlTextWriterWriteAttribute(w->xml, BAD_CAST name, BAD_CAST value));
}

static void element(writer *w, const char *name, const char *value)
{
    check(w, xmlTextWriterWriteElement(w->xml, BAD_CAST name, BAD_CAST value));
}

/* As Java writes it, with a point or an exponent. */
static void number(double x, char text[RG_NUMBER_ROOM])
{
    if (x == 0) {
        strcpy(text, signbit(x) ? "-0.0" : "0.0");
        return;
    }
    rg_number_print(text, x);
    if (!strpbrk(text, ".e")) strcat(text, ".0"); /* a whole number has 17 digits at most: there is room */
}

static void property(writer *w, const char *name, const char *type, const char *value)
{
    open_element(w, "void");
    attribute(w, "property", name);
    element(w, type, value);
    close_element(w);
}

/* One line of the pattern. Lines are nearly all of a file and are nothing but numbers: put together here, they take a
 * fraction of the time that element by element they would. */
typedef struct entry {
    char text[1024];
    size_t n;
} entry;

static void add(entry *e, const char *s)
{
    const size_t n = strlen(s);
    assert(e->n + n < sizeof e->text);
    memcpy(e->text + e->n, s, n + 1);
    e->n += n;
}

static void add_property(entry *e, const char *name, const char *opening, const char *value, const char *closing)
{
    const char *part[] = {"       <void property=\"", name, "\">\n        ", opening, value, closing,
                          "\n       </void>\n"};
    for (int i = 0; i < 7; i++) add(e, part[i]);
}

/* Java leaves out what has its default, +0.0; -0.0 is another value to it. */
static void add_coordinate(entry *e, const char *name, double x)
{
    if (x == 0 && !signbit(x)) return;
    char text[RG_NUMBER_ROOM];
    number(x, text);
    add_property(e, name, "<double>", text, "</double>");
}

static void line(writer *w, int32_t index, const rg_line *l)
{
    static const char letters[] = "FBMVU....C"; /* by type code */
    const char *type = strchr(letters, l->assignment);
    entry e;
    e.n = (size_t)snprintf(e.text, sizeof e.text,
                           "     <void index=\"%d\">\n      <object class=\"oripa.OriLineProxy\">\n", (int)index);
    const char digit[] = {type ? (char)('0' + (type - letters)) : 0, 0};
    if (type && type != letters) add_property(&e, "type", "<int>", digit, "</int>");
    add_coordinate(&e, "x0", l->a.x);
    add_coordinate(&e, "x1", l->b.x);
    add_coordinate(&e, "y0", -l->a.y);
    add_coordinate(&e, "y1", -l->b.y);
    add(&e, "      </object>\n     </void>\n");
    check(w, xmlTextWriterWriteRawLen(w->xml, BAD_CAST e.text, (int)e.n));
}

static void open_field(writer *w, const char *name)
{
    open_element(w, "void");
    attribute(w, "class", "oripa.DataSet");
    attribute(w, "method", "getField");
    element(w, "string", name);
    open_element(w, "void");
    attribute(w, "method", "set");
    open_element(w, "object");
    attribute(w, "idref", "DataSet0");
    close_element(w);
}

static void close_field(writer *w)
{
    close_element(w);
    close_element(w);
}

static void lines(writer *w, const rg_lines *l)
{
    char text[16];
    open_field(w, "lines");
    open_element(w, "array");
    attribute(w, "class", "oripa.OriLineProxy");
    snprintf(text, sizeof text, "%d", (int)l->count);
    attribute(w, "length", text);
    check(w, xmlTextWriterWriteRaw(w->xml, BAD_CAST "\n"));
    for (int32_t i = 0; i < l->count; i++) line(w, i, &l->line[i]);
    check(w, xmlTextWriterWriteRaw(w->xml, BAD_CAST "    "));
    close_element(w);
    close_field(w);
}

static int is_control(char c) { return (unsigned char)c < 0x20 && !strchr("\t\n\r", c); }

/* Part of a string without control characters. Bytes that are not UTF-8 would spoil the whole file. */
static void text(writer *w, const rg_memory *mem, const char *s, size_t n)
{
    char *copy = rg_mem_array(mem, n + 1, 1);
    w->failed |= !copy;
    if (!copy) return;
    memcpy(copy, s, n);
    for (char *c = copy; *c;) {
        const size_t bytes = rg_utf8_character((unsigned char *)c);
        if (bytes == 0) *c = '?';
        else if (!rg_utf8_in_xml((unsigned char *)c, bytes)) memcpy(c, "\xEF\xBF\xBD", bytes); /* all here have three */
        c += bytes ? bytes : 1;
    }
    check(w, xmlTextWriterWriteString(w->xml, BAD_CAST copy));
    rg_mem_free(mem, copy);
}

/* Characters that XML cannot hold are elements of their own: there must be no blanks around those. */
static void string(writer *w, const rg_memory *mem, const char *name, const char *s)
{
    if (!s) return;
    open_field(w, name);
    open_element(w, "string");
    xmlTextWriterSetIndent(w->xml, 0);
    for (;;) {
        size_t n = 0;
        while (s[n] && !is_control(s[n])) n++;
        text(w, mem, s, n);
        if (!s[n]) break;
        char code[8];
        snprintf(code, sizeof code, "#%x", (unsigned)(unsigned char)s[n]);
        open_element(w, "char");
        attribute(w, "code", code);
        close_element(w);
        s += n + 1;
    }
    close_element(w);
    check(w, xmlTextWriterWriteRaw(w->xml, BAD_CAST "\n"));
    xmlTextWriterSetIndent(w->xml, 1);
    close_field(w);
}

static void document(writer *w, const rg_lines *l)
{
    const char *version = "1";
    for (int32_t i = 0; i < l->count; i++)
        if (l->line[i].assignment == RG_UNASSIGNED) version = "2";
    check(w, xmlTextWriterStartDocument(w->xml, "1.0", "UTF-8", NULL));
    open_element(w, "java");
    attribute(w, "version", "1.8.0");
    attribute(w, "class", "java.beans.XMLDecoder");
    open_element(w, "object");
    attribute(w, "class", "oripa.DataSet");
    attribute(w, "id", "DataSet0");
    string(w, &l->mem, "editorName", l->editor);
    lines(w, l);
    property(w, "mainVersion", "int", version);
    string(w, &l->mem, "memo", l->memo);
    string(w, &l->mem, "originalAuthorName", l->author);
    property(w, "paperSize", "double", "400.0");
    string(w, &l->mem, "reference", l->reference);
    property(w, "subVersion", "int", "1");
    string(w, &l->mem, "title", l->title);
    close_element(w);
    close_element(w);
    check(w, xmlTextWriterEndDocument(w->xml));
}

/* Whether the bytes arrived is asked once, of the stream, when the file is committed. */
static int pass_on(void *stream, const char *bytes, int n)
{
    fwrite(bytes, 1, (size_t)n, stream);
    return n;
}

static rg_status write_document(const rg_lines *l, FILE *stream)
{
    xmlOutputBuffer *buffer = xmlOutputBufferCreateIO(pass_on, NULL, stream, NULL);
    if (!buffer) return RG_ENOMEM;
    writer w = {xmlNewTextWriter(buffer), 0};
    if (!w.xml) {
        xmlOutputBufferClose(buffer);
        return RG_ENOMEM;
    }
    xmlTextWriterSetIndent(w.xml, 1);
    xmlTextWriterSetIndentString(w.xml, BAD_CAST " ");
    document(&w, l);
    check(&w, xmlTextWriterFlush(w.xml));
    xmlFreeTextWriter(w.xml);
    return w.failed ? RG_ENOMEM : RG_OK; /* the stream takes everything: memory is all that can be short */
}

rg_status rg_opx_write(const rg_lines *l, const rg_dest *to, rg_diag *why)
{
    for (int32_t i = 0; i < l->count; i++) {
        const rg_line *e = &l->line[i];
        if (!isfinite(e->a.x + e->a.y + e->b.x + e->b.y))
            return rg_fail(RG_EARG, why, 0, "line %d has a coordinate that is not a finite number", (int)i);
    }
    rg_file f;
    rg_status s = rg_file_begin_to(&f, &l->mem, to, why);
    if (s != RG_OK) return s;
    s = write_document(l, f.stream);
    if (s != RG_OK) {
        rg_file_abandon(&f);
        return rg_fail(s, why, 0, "out of memory");
    }
    return rg_file_commit(&f, why);
}
