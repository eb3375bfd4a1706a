#include "read/css.h"
#include "base/status.h"

#include <string.h>

void rg_css_init(rg_css *css, const rg_memory *mem)
{
    memset(css, 0, sizeof *css);
    css->mem = *mem;
}

void rg_css_free(rg_css *css)
{
    if (!css->mem.resize) return;
    for (int32_t i = 0; i < css->sheets; i++) rg_mem_free(&css->mem, css->sheet[i]);
    rg_mem_free(&css->mem, css->sheet);
    rg_mem_free(&css->mem, css->rule);
    memset(css, 0, sizeof *css);
}

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static const char *trim(const char *s, size_t *n)
{
    while (*n > 0 && is_blank(*s)) s++, (*n)--;
    while (*n > 0 && is_blank(s[*n - 1])) (*n)--;
    return s;
}

static void blank_comments(char *s)
{
    for (char *from; (from = strstr(s, "/*"));) {
        char *to = strstr(from + 2, "*/");
        to = to ? to + 2 : from + strlen(from);
        memset(from, ' ', (size_t)(to - from));
        s = to;
    }
}

/* How much a selector weighs; -1: not one that is understood. */
static int weigh(const char *s, size_t n)
{
    int rank = n > 0 && *s != '.' && *s != '#' && *s != '*';
    for (size_t i = 0; i < n; i++) {
        if (is_blank(s[i]) || strchr(">+~[]:()\"'", s[i])) return -1;
        rank += s[i] == '.' ? 10 : s[i] == '#' ? 100 : 0;
    }
    return n > 0 ? rank : -1;
}

static rg_status add_rules(rg_css *css, const char *selectors, size_t n, const char *body, size_t body_n, int line,
                           rg_diag *why)
{
    for (size_t from = 0, to; from < n; from = to + 1) {
        for (to = from; to < n && selectors[to] != ',';) to++;
        size_t length = to - from;
        const char *selector = trim(selectors + from, &length);
        const int rank = weigh(selector, length);
        if (rank < 0) continue;
        if (css->rules == RG_CSS_MOST_RULES)
            return rg_fail(RG_EFORMAT, why, line, "more than %d rules of style", (int)RG_CSS_MOST_RULES);
        rg_status s = rg_mem_grow(&css->mem, (void **)&css->rule, &css->room, (size_t)css->rules + 1, sizeof *css->rule);
        if (s != RG_OK) return s;
        css->rule[css->rules++] = (rg_rule){selector, body, length, body_n, rank};
    }
    return RG_OK;
}

/* Past an @rule: to its ; or over its block. */
static const char *skip_at(const char *s)
{
    int depth = 0;
    for (; *s; s++) {
        if (*s == '{') depth++;
        if ((*s == '}' && --depth <= 0) || (*s == ';' && depth == 0)) return s + 1;
    }
    return s;
}

rg_status rg_css_add(rg_css *css, const rg_xml_node *style, rg_diag *why)
{
    rg_status status = rg_mem_grow(&css->mem, (void **)&css->sheet, &css->sheet_room, (size_t)css->sheets + 1,
                                   sizeof *css->sheet);
    char *s = status == RG_OK ? rg_xml_string(&css->mem, style) : NULL;
    if (!s) return RG_ENOMEM;
    css->sheet[css->sheets++] = s;
    blank_comments(s);
    for (const char *at = s; status == RG_OK;) {
        while (is_blank(*at)) at++;
        if (*at == '@') {
            at = skip_at(at);
            continue;
        }
        const char *body = strchr(at, '{');
        if (!body) break;
        const char *end = strchr(body, '}');
        if (!end) end = body + strlen(body);
        status = add_rules(css, at, (size_t)(body - at), body + 1, (size_t)(end - body - 1), rg_xml_line(style), why);
        at = *end ? end + 1 : end;
    }
    return status;
}

/* Whether a list of words, with blanks between them, has that one. */
static int listed(const char *list, const char *word, size_t n)
{
    while (*list) {
        while (is_blank(*list)) list++;
        size_t length = 0;
        while (list[length] && !is_blank(list[length])) length++;
        if (length == n && memcmp(list, word, n) == 0) return n > 0;
        list += length;
    }
    return 0;
}

static int same(const char *s, const char *word, size_t n) { return strlen(s) == n && memcmp(s, word, n) == 0; }

static int matches(const rg_rule *r, const rg_xml_node *n)
{
    const char *s = r->selector, *end = s + r->selector_n;
    while (s < end) {
        const char kind = *s == '.' || *s == '#' ? *s++ : 'e';
        size_t length = 0;
        while (s + length < end && s[length] != '.' && s[length] != '#') length++;
        if (kind == '.' && !listed(rg_xml_attribute(n, "class"), s, length)) return 0;
        if (kind == '#' && !same(rg_xml_attribute(n, "id"), s, length)) return 0;
        if (kind == 'e' && !same("*", s, length) && !same(rg_xml_name(n), s, length)) return 0;
        s += length;
    }
    return 1;
}

static void copy(char value[RG_CSS_VALUE], const char *s, size_t n)
{
    const char *important = memchr(s, '!', n);
    if (important) n = (size_t)(important - s);
    s = trim(s, &n);
    if (n >= RG_CSS_VALUE) n = RG_CSS_VALUE - 1;
    memcpy(value, s, n);
    value[n] = 0;
}

/* `name: value; name: value`; the last one counts. */
static int declared(const char *s, size_t n, const char *property, char value[RG_CSS_VALUE])
{
    int found = 0;
    for (size_t from = 0, to; from < n; from = to + 1) {
        for (to = from; to < n && s[to] != ';';) to++;
        const char *colon = memchr(s + from, ':', to - from);
        if (!colon) continue;
        size_t length = (size_t)(colon - (s + from));
        const char *name = trim(s + from, &length);
        if (!same(property, name, length)) continue;
        copy(value, colon + 1, (size_t)(s + to - colon - 1));
        found = value[0] != 0;
    }
    return found;
}

int rg_css_get(const rg_css *css, const rg_xml_node *n, const char *property, char value[RG_CSS_VALUE])
{
    const char *style = rg_xml_attribute(n, "style"), *attribute = rg_xml_attribute(n, property);
    if (declared(style, strlen(style), property, value)) return 1;
    int best = -1;
    for (int32_t i = 0; i < css->rules; i++) {
        const rg_rule *r = &css->rule[i];
        char found[RG_CSS_VALUE];
        if (r->rank < best || !matches(r, n) || !declared(r->body, r->body_n, property, found)) continue;
        best = r->rank;
        memcpy(value, found, sizeof found);
    }
    if (best >= 0) return 1;
    if (*attribute) copy(value, attribute, strlen(attribute));
    return *attribute != 0;
}
