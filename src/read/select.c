#include "read/select.h"

#include <stdlib.h>
#include <string.h>

/* Levels of :not(:is(...)), parts of one selector, brackets in brackets: more than anybody writes. */
enum { MOST_DEEP = 4, MOST_PARTS = 32, MOST_ENCLOSED = 32 };
/* Elements looked at for one selector and element: `a a a a x` in deep trees could be tried without end. */
enum { MOST_TRIED = 20000 };
enum { OF_TAG = 1, OF_CLASS = 1000, OF_ID = 1000000 }; /* no selector has a thousand of one kind */
enum { MOST_WEIGHT = 1 << 28 };
/* What looking at an element costs, beside the bytes of its attributes, and what counting it does. */
enum { OF_LOOKING = 16, OF_COUNTING = 4 };

/* One element's part of a selector, and how it hangs together with the part before it: ' ', '>', '+', '~'; 0: the
 * first. */
typedef struct part { const char *s; size_t n; char joint; } part;

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static const char *trim(const char *s, size_t *n)
{
    while (*n > 0 && is_blank(*s)) s++, (*n)--;
    while (*n > 0 && is_blank(s[*n - 1])) (*n)--;
    return s;
}

static int opens(char c) { return c == '[' || c == '(' || c == '"' || c == '\''; }

/* Past what brackets or quotes enclose, which s[i] opens: the place of their end, n: they have none, or are deeper than
 * that. */
static size_t enclosed(const char *s, size_t n, size_t i)
{
    char end[MOST_ENCLOSED];
    int depth = 0;
    for (; i < n; i++) {
        const char inside = depth > 0 ? end[depth - 1] : 0;
        if (inside && s[i] == inside) {
            if (--depth == 0) return i;
        } else if (inside != '"' && inside != '\'' && opens(s[i])) {
            if (depth == MOST_ENCLOSED) return n;
            end[depth++] = s[i] == '[' ? ']' : s[i] == '(' ? ')' : s[i];
        }
    }
    return n;
}

size_t rg_select_comma(const char *s, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (s[i] == ',') return i;
        if (opens(s[i])) i = enclosed(s, n, i);
    }
    return n;
}

/* 0: there are too many, or a joint with nothing at one side. */
static int split(const char *s, size_t n, part *parts)
{
    int count = 0;
    char joint = 0;
    s = trim(s, &n);
    for (size_t i = 0; i < n;) {
        const size_t from = i;
        while (i < n && !is_blank(s[i]) && !strchr(">+~", s[i])) {
            if (opens(s[i])) i = enclosed(s, n, i);
            if (i < n) i++;
        }
        if (i == from || count == MOST_PARTS) return 0;
        parts[count++] = (part){s + from, i - from, joint};
        joint = i < n ? ' ' : 0;
        for (; i < n && (is_blank(s[i]) || strchr(">+~", s[i])); i++) {
            if (is_blank(s[i])) continue;
            if (joint != ' ') return 0;
            joint = s[i];
        }
    }
    return joint == 0 ? count : 0;
}

/* -------------------------------------------------------------------------------------------- simple selectors ---- */

/* What follows a part's tag: its kind, '.', '#', '[' or ':', its name, and what stands in its brackets. */
typedef struct simple { char kind; const char *name, *in; size_t name_n, in_n; } simple;

static int is_name(char c)
{
    const int is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_letter || (c >= '0' && c <= '9') || c == '-' || c == '_' || (unsigned char)c >= 128;
}

/* The next one at s[*i]; 0: it is none. */
static int next(const char *s, size_t n, size_t *i, simple *q)
{
    *q = (simple){.kind = s[*i]};
    if (*i == 0 && (is_name(s[0]) || s[0] == '*')) q->kind = 'e';
    else if (strchr(".#:[", s[*i])) ++*i;
    else return 0;
    if (q->kind == ':' && *i < n && s[*i] == ':') ++*i, q->kind = '!'; /* what is drawn besides the element */
    if (q->kind == '[') {
        const size_t end = enclosed(s, n, *i - 1);
        if (end >= n) return 0;
        q->in = s + *i, q->in_n = end - *i;
        return *i = end + 1, 1;
    }
    q->name = s + *i;
    if (q->kind == 'e' && s[*i] == '*') ++*i;
    else
        while (*i < n && is_name(s[*i])) ++*i;
    q->name_n = (size_t)(s + *i - q->name);
    if (q->name_n == 0) return 0;
    if ((q->kind == ':' || q->kind == '!') && *i < n && s[*i] == '(') {
        const size_t end = enclosed(s, n, *i);
        if (end >= n) return 0;
        q->in = s + *i + 1, q->in_n = end - *i - 1;
        *i = end + 1;
    }
    return 1;
}

static int same(const char *s, size_t n, const char *word) { return strlen(word) == n && memcmp(s, word, n) == 0; }

static int among(const simple *q, const char *const *words)
{
    for (; *words; words++)
        if (same(q->name, q->name_n, *words)) return 1;
    return 0;
}

static const char *const NEVER[] = {"hover", "focus", "active", "visited", "target", "focus-within", "focus-visible",
                                    NULL};
static const char *const PLACES[] = {"root", "first-child", "last-child", "only-child", "first-of-type", "last-of-type",
                                     "only-of-type", NULL};
static const char *const NTHS[] = {"nth-child", "nth-last-child", "nth-of-type", "nth-last-of-type", NULL};
static const char *const LISTS[] = {"not", "is", "where", NULL};

/* a n + b; 0: it is not that, or has numbers that are longer than any count of elements. */
static int progression(const char *s, size_t n, long *a, long *b)
{
    char text[10] = "";
    size_t length = 0;
    for (size_t i = 0; i < n; i++) {
        if (is_blank(s[i])) continue;
        if (length + 1 == sizeof text) return 0;
        text[length++] = s[i];
    }
    if (strcmp(text, "odd") == 0) return *a = 2, *b = 1, 1;
    if (strcmp(text, "even") == 0) return *a = 2, *b = 0, 1;
    char *step = strchr(text, 'n'), *end;
    *a = 0;
    if (step) {
        *step = 0;
        *a = strtol(text, &end, 10);
        if (end == text || strcmp(text, "+") == 0 || strcmp(text, "-") == 0) {
            *a = text[0] == '-' ? -1 : 1;
            if (text[0] && text[1]) return 0;
        } else if (*end) return 0;
        *b = strtol(step + 1, &end, 10);
        return *end == 0;
    }
    *b = strtol(text, &end, 10);
    return length > 0 && *end == 0;
}

/* [name op value]; 0: it is not that. op 0: it only is to be there. */
typedef struct attribute { char name[64]; const char *value; size_t value_n; char op; } attribute;

static int read_attribute(const simple *q, attribute *a)
{
    size_t n = q->in_n, i = 0, from;
    const char *s = trim(q->in, &n), *bar;
    *a = (attribute){.op = 0};
    while (i < n && (is_name(s[i]) || s[i] == '|' || s[i] == ':')) i++;
    if (i > 0 && i < n && s[i - 1] == '|' && s[i] == '=') i--;
    bar = memchr(s, '|', i); /* a prefix: names are looked up without */
    from = bar ? (size_t)(bar - s) + 1 : 0;
    if (i - from == 0 || i - from >= sizeof a->name) return 0;
    memcpy(a->name, s + from, i - from);
    while (i < n && is_blank(s[i])) i++;
    if (i == n) return 1;
    a->op = s[i];
    if (a->op != '=' && (i + 1 >= n || s[i + 1] != '=' || !strchr("~|^$*", a->op))) return 0;
    i += a->op == '=' ? 1 : 2;
    a->value_n = n - i;
    a->value = trim(s + i, &a->value_n);
    if (a->value_n >= 2 && (*a->value == '"' || *a->value == '\'')) {
        if (a->value[a->value_n - 1] != *a->value) return 0;
        a->value++, a->value_n -= 2;
    }
    return 1;
}

static int32_t weigh(const char *s, size_t n, int deep);

static int32_t weigh_list(const char *s, size_t n, int deep)
{
    int32_t most = 0;
    for (size_t from = 0; from <= n;) {
        const size_t length = rg_select_comma(s + from, n - from);
        const int32_t w = weigh(s + from, length, deep);
        if (w < 0) return -1;
        most = w > most ? w : most;
        from += length + 1;
    }
    return most;
}

static int32_t weigh_simple(const simple *q, int deep)
{
    attribute a;
    long step, first;
    switch (q->kind) {
    case 'e': return *q->name == '*' ? 0 : OF_TAG;
    case '.': return OF_CLASS;
    case '#': return OF_ID;
    case '[': return read_attribute(q, &a) ? OF_CLASS : -1;
    case '!': return OF_TAG;
    default: break;
    }
    if (!q->in) return among(q, NEVER) || among(q, PLACES) ? OF_CLASS : -1;
    if (among(q, NTHS)) return progression(q->in, q->in_n, &step, &first) ? OF_CLASS : -1;
    if (!among(q, LISTS) || deep == MOST_DEEP) return -1;
    const int32_t inside = weigh_list(q->in, q->in_n, deep + 1);
    return inside > 0 && same(q->name, q->name_n, "where") ? 0 : inside;
}

static int32_t weigh(const char *s, size_t n, int deep)
{
    part parts[MOST_PARTS];
    const int count = split(s, n, parts);
    int32_t sum = 0;
    for (int k = 0; k < count; k++)
        for (size_t i = 0; i < parts[k].n;) {
            simple q;
            const int32_t w = next(parts[k].s, parts[k].n, &i, &q) ? weigh_simple(&q, deep) : -1;
            if (w < 0) return -1;
            sum = sum + w < MOST_WEIGHT ? sum + w : MOST_WEIGHT;
        }
    return count > 0 ? sum : -1;
}

int32_t rg_select_weigh(const char *s, size_t n) { return weigh(s, n, 0); }

/* ---------------------------------------------------------------------------------------------------- matching ---- */

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

static int matches_attribute(const simple *q, const rg_xml_node *node, int64_t *work)
{
    attribute a;
    if (!read_attribute(q, &a)) return 0;
    const char *has = rg_xml_given(node, a.name);
    if (!has || !a.op) return has != NULL;
    const size_t n = strlen(has);
    *work += (int64_t)n;
    switch (a.op) {
    case '=': return n == a.value_n && memcmp(has, a.value, n) == 0;
    case '~': return listed(has, a.value, a.value_n);
    case '|': {
        const int begins = n >= a.value_n && memcmp(has, a.value, a.value_n) == 0;
        return begins && (n == a.value_n || has[a.value_n] == '-');
    }
    case '^': return a.value_n > 0 && n >= a.value_n && memcmp(has, a.value, a.value_n) == 0;
    case '$': return a.value_n > 0 && n >= a.value_n && memcmp(has + n - a.value_n, a.value, a.value_n) == 0;
    default: break;
    }
    for (size_t i = 0; a.value_n > 0 && i + a.value_n <= n; i++) {
        size_t same = 0;
        while (same < a.value_n && has[i + same] == a.value[same]) same++;
        if (same == a.value_n) return 1;
        *work += (int64_t)same;
    }
    return 0;
}

/* Its place among those beside it, from 1; of its own tag only, from the end. */
static long place(const rg_xml_node *node, int of_type, int from_end, int64_t *work)
{
    long k = 1;
    for (const rg_xml_node *c = node; (c = from_end ? rg_xml_next(c) : rg_xml_previous(c));) {
        k += !of_type || strcmp(rg_xml_name(c), rg_xml_name(node)) == 0;
        *work += OF_COUNTING;
    }
    return k;
}

static int matches_place(const simple *q, const rg_xml_node *node, int64_t *work)
{
    if (same(q->name, q->name_n, "root")) return !rg_xml_parent(node);
    const int of_type = q->name_n > 4 && memcmp(q->name + q->name_n - 4, "type", 4) == 0;
    const int first = place(node, of_type, 0, work) == 1, last = place(node, of_type, 1, work) == 1;
    return q->name[0] == 'f' ? first : q->name[0] == 'l' ? last : first && last;
}

static int matches_nth(const simple *q, const rg_xml_node *node, int64_t *work)
{
    long a, b;
    const int of_type = q->name_n > 4 && memcmp(q->name + q->name_n - 4, "type", 4) == 0;
    if (!progression(q->in, q->in_n, &a, &b)) return 0;
    const long k = place(node, of_type, q->name_n > 8 && memcmp(q->name + 4, "last", 4) == 0, work) - b;
    return a == 0 ? k == 0 : k % a == 0 && k / a >= 0;
}

static int matches(const char *s, size_t n, const rg_xml_node *node, int64_t *work);

static int matches_list(const simple *q, const rg_xml_node *node, int64_t *work)
{
    int any = 0;
    for (size_t from = 0; from <= q->in_n && !any;) {
        const size_t length = rg_select_comma(q->in + from, q->in_n - from);
        any = matches(q->in + from, length, node, work);
        from += length + 1;
    }
    return same(q->name, q->name_n, "not") ? !any : any;
}

static int matches_simple(const simple *q, const rg_xml_node *node, int64_t *work)
{
    const char *name = q->kind == '.' ? "class" : q->kind == '#' ? "id" : "", *has = rg_xml_attribute(node, name);
    *work += 2 * (int64_t)strlen(has); /* for its length, and for its words */
    switch (q->kind) {
    case 'e': return *q->name == '*' || same(q->name, q->name_n, rg_xml_name(node));
    case '.': return listed(has, q->name, q->name_n);
    case '#': return same(q->name, q->name_n, has);
    case '[': return matches_attribute(q, node, work);
    case '!': return 0;
    default: break;
    }
    if (q->in) return among(q, NTHS) ? matches_nth(q, node, work) : matches_list(q, node, work);
    return among(q, PLACES) && matches_place(q, node, work);
}

static int matches_part(const part *p, const rg_xml_node *node, int64_t *work)
{
    *work += OF_LOOKING + (int64_t)p->n;
    for (size_t i = 0; i < p->n;) {
        simple q;
        if (!next(p->s, p->n, &i, &q) || !matches_simple(&q, node, work)) return 0;
    }
    return 1;
}

/* Whether parts 0 ... last hold, the last of them for that element: from there outwards and backwards. */
static int holds(const part *parts, int last, const rg_xml_node *node, int *tried, int64_t *work)
{
    if (++*tried > MOST_TRIED || !matches_part(&parts[last], node, work)) return 0;
    if (last == 0) return 1;
    const char joint = parts[last].joint;
    const int up = joint == ' ' || joint == '>';
    const rg_xml_node *c = up ? rg_xml_parent(node) : rg_xml_previous(node);
    for (; c; c = up ? rg_xml_parent(c) : rg_xml_previous(c)) {
        if (holds(parts, last - 1, c, tried, work)) return 1;
        if (joint == '>' || joint == '+') return 0;
    }
    return 0;
}

static int matches(const char *s, size_t n, const rg_xml_node *node, int64_t *work)
{
    part parts[MOST_PARTS];
    const int count = split(s, n, parts);
    int tried = 0;
    *work += OF_LOOKING + (int64_t)n;
    return count > 0 && holds(parts, count - 1, node, &tried, work);
}

int rg_select_matches(const char *s, size_t n, const rg_xml_node *node, int64_t *work)
{
    return matches(s, n, node, work);
}
