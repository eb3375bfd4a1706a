#include "read/css.h"
#include "base/status.h"
#include "read/select.h"

#include <string.h>

void rg_css_init(rg_css *css, const rg_memory *mem)
{
    memset(css, 0, sizeof *css);
    css->mem = *mem;
    css->most = RG_CSS_MOST_WORK;
}

void rg_css_free(rg_css *css)
{
    if (!css->mem.resize) return;
    for (int32_t i = 0; i < css->sheets; i++) rg_mem_free(&css->mem, css->sheet[i]);
    RG_MEM_FREE(&css->mem, css->sheet, css->rule);
    memset(css, 0, sizeof *css);
}

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static const char *trim(const char *s, size_t *n)
{
    while (*n > 0 && is_blank(*s)) s++, (*n)--;
    while (*n > 0 && is_blank(s[*n - 1])) (*n)--;
    return s;
}

/* Lines stay lines, for what is told of them. */
static void blank_comments(char *s)
{
    for (char *from; (from = strstr(s, "/*"));) {
        char *to = strstr(from + 2, "*/");
        to = to ? to + 2 : from + strlen(from);
        for (s = from; s < to; s++)
            if (*s != '\n') *s = ' ';
    }
}

/* What is read: the text from where the last line was asked for, and that line. */
typedef struct source { const char *text; int32_t line; rg_lines *out; rg_diag *why; } source;

/* Asked for one place after the other. */
static int32_t line_of(source *q, const char *at)
{
    for (; q->text < at; q->text++) q->line += *q->text == '\n';
    return q->line;
}

static rg_status untold(source *q, const char *at, size_t n)
{
    char shown[81];
    at = trim(at, &n);
    if (n >= sizeof shown) n = sizeof shown - 1;
    memcpy(shown, at, n);
    shown[n] = 0;
    return rg_lines_warn(q->out, line_of(q, at), "style: \"%s\" is not understood and passed over", shown);
}

/* One of 64 for a property's name: others may have it as well. */
static uint64_t bit_of(const char *name, size_t n)
{
    uint32_t sum = 0;
    for (size_t i = 0; i < n; i++) sum = 31 * sum + (unsigned char)name[i];
    return (uint64_t)1 << (sum ^ sum >> 6) % 64;
}

/* Those of all properties in a body. */
static uint64_t names_in(const char *s, size_t n)
{
    uint64_t names = 0;
    for (size_t from = 0, to; from < n; from = to + 1) {
        for (to = from; to < n && s[to] != ';';) to++;
        const char *colon = memchr(s + from, ':', to - from);
        size_t length = colon ? (size_t)(colon - (s + from)) : 0;
        const char *name = trim(s + from, &length);
        if (colon) names |= bit_of(name, length);
    }
    return names;
}

static rg_status add_rules(rg_css *css, source *q, const char *selectors, size_t n, const char *body, size_t body_n)
{
    const uint64_t names = names_in(body, body_n);
    for (size_t from = 0; from <= n;) {
        size_t length = rg_select_comma(selectors + from, n - from);
        const size_t next = from + length + 1;
        const char *selector = trim(selectors + from, &length);
        const int32_t weight = rg_select_weigh(selector, length);
        rg_status s = RG_OK;
        from = next;
        if (weight < 0) {
            if ((s = untold(q, selector, length)) != RG_OK) return s;
            continue;
        }
        if (css->rules == RG_CSS_MOST_RULES)
            return rg_fail(RG_EFORMAT, q->why, line_of(q, selector), "more than %d rules of style",
                           (int)RG_CSS_MOST_RULES);
        s = RG_MEM_GROW(&css->mem, css->rule, css->room, (size_t)css->rules + 1);
        if (s != RG_OK) return s;
        css->rule[css->rules++] = (rg_rule){selector, body, length, body_n, weight, names};
    }
    return RG_OK;
}

/* The } of the { at s, or the end of the text. */
static const char *block_end(const char *s)
{
    int depth = 0;
    for (; *s; s++) {
        if (*s == '{') depth++;
        if (*s == '}' && --depth <= 0) break;
    }
    return s;
}

static int begins(const char *s, const char *word) { return strncmp(s, word, strlen(word)) == 0; }

/* @rules that say nothing of how a line is drawn. */
static int is_harmless(const char *s)
{
    static const char *const words[] = {"@font-face", "@keyframes", "@-webkit-keyframes", "@charset", "@namespace",
                                        "@page"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (begins(s, words[i])) return 1;
    return 0;
}

static int is_for_screens(const char *s)
{
    if (!begins(s, "@media")) return 0;
    size_t n = strcspn(s, "{") - 6;
    s = trim(s + 6, &n);
    return (n == 3 && memcmp(s, "all", 3) == 0) || (n == 6 && memcmp(s, "screen", 6) == 0);
}

/* From an @rule: behind it, or, where it holds here too, into its block. */
static const char *pass_at(source *q, const char *s, rg_status *status)
{
    const size_t head = strcspn(s, "{;");
    if (s[head] == '{' && is_for_screens(s)) return s + head + 1; /* its own } is passed over, as it closes nothing */
    if (!is_harmless(s)) *status = untold(q, s, head);
    if (s[head] == '{') s = block_end(s + head);
    else s += head;
    return *s ? s + 1 : s;
}

rg_status rg_css_add(rg_css *css, const rg_xml_node *style, rg_lines *l, rg_diag *why)
{
    rg_status status = RG_MEM_GROW(&css->mem, css->sheet, css->sheet_room, (size_t)css->sheets + 1);
    char *s = status == RG_OK ? rg_xml_string(&css->mem, style) : NULL;
    if (!s) return RG_ENOMEM;
    source q = {s, rg_xml_line(style), l, why};
    css->sheet[css->sheets++] = s;
    blank_comments(s);
    for (const char *at = s; status == RG_OK;) {
        while (is_blank(*at) || *at == '}') at++;
        if (*at == '@') {
            at = pass_at(&q, at, &status);
            continue;
        }
        const char *body = strchr(at, '{');
        if (!body) break;
        const char *end = block_end(body);
        const int is_nested = memchr(body + 1, '{', (size_t)(end - body - 1)) != NULL;
        if (is_nested) status = untold(&q, at, (size_t)(end - at));
        else status = add_rules(css, &q, at, (size_t)(body - at), body + 1, (size_t)(end - body - 1));
        at = *end ? end + 1 : end;
    }
    return status;
}

static int same(const char *s, const char *word, size_t n) { return strlen(s) == n && memcmp(s, word, n) == 0; }

static void copy(char value[RG_CSS_VALUE], const char *s, size_t n)
{
    const char *important = memchr(s, '!', n);
    if (important) n = (size_t)(important - s);
    s = trim(s, &n);
    if (n >= RG_CSS_VALUE) n = RG_CSS_VALUE - 1;
    memcpy(value, s, n);
    value[n] = 0;
}

/* `name: value; name: value`; the last one counts, of the important ones where there are some. 0: none, 2:
 * important. */
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
        const size_t value_n = (size_t)(s + to - colon - 1);
        const int important = memchr(colon + 1, '!', value_n) != NULL;
        if (found == 2 && !important) continue;
        copy(value, colon + 1, value_n);
        found = !value[0] ? 0 : important ? 2 : 1;
    }
    return found;
}

/* What looking at a rule or an element costs, beside its bytes. */
enum { OF_LOOKING = 16 };

/* A style of its own weighs more than any rule, and what is important more than what is not. */
enum { OF_STYLE = 1 << 29, OF_IMPORTANT = 1 << 30 };

int rg_css_said(rg_css *css, const rg_xml_node *n, const char *property, char value[RG_CSS_VALUE])
{
    const char *style = rg_xml_attribute(n, "style");
    css->work += OF_LOOKING + css->rules + (int64_t)strlen(style);
    const int own = declared(style, strlen(style), property, value);
    const uint64_t name = bit_of(property, strlen(property));
    int64_t best = own == 2 ? (int64_t)OF_IMPORTANT + OF_STYLE : own ? OF_STYLE : -1;
    for (int32_t i = 0; i < css->rules && css->work <= css->most; i++) {
        const rg_rule *r = &css->rule[i];
        if (!(r->names & name)) continue;
        css->work += OF_LOOKING + (int64_t)r->body_n;
        char found[RG_CSS_VALUE];
        const int how = declared(r->body, r->body_n, property, found);
        const int64_t weight = r->weight + (how == 2 ? (int64_t)OF_IMPORTANT : 0);
        if (!how || weight < best || !rg_select_matches(r->selector, r->selector_n, n, &css->work)) continue;
        best = weight;
        memcpy(value, found, sizeof found);
    }
    return best >= 0;
}

int rg_css_get(rg_css *css, const rg_xml_node *n, const char *property, char value[RG_CSS_VALUE])
{
    const char *attribute = rg_xml_attribute(n, property);
    if (rg_css_said(css, n, property, value)) return 1;
    if (*attribute) copy(value, attribute, strlen(attribute));
    return *attribute != 0;
}
