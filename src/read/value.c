#include "read/value.h"
#include "base/status.h"

#include <stdlib.h>
#include <string.h>

#include <jansson.h>

/* ------------------------------------------------------------------------------- well-formed or not ---- */

/* Where memory is short, the library may call a text ill-formed that is not. So what it refuses is looked at once more,
 * by the grammar alone (RFC 8259), which takes no memory: a text that is well-formed was refused for want of it. */

/* Open lists and objects, a bit each; deeper than any text that the library takes. */
enum { DEEPEST = 2048 };
typedef struct nest { unsigned char is_object[DEEPEST / 8]; int depth; } nest;

static int is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
static int is_digit(char c) { return c >= '0' && c <= '9'; }
static int is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

static const char *skip_blanks(const char *s, const char *end)
{
    while (s < end && is_blank(*s)) s++;
    return s;
}

/* The four hexadecimal digits behind s[0] as a number; -1: they are none. */
static long unit_at(const char *s, const char *end)
{
    char digit[5] = "";
    for (int k = 0; k < 4; k++)
        if (s + 1 + k < end && is_hex(s[1 + k])) digit[k] = s[1 + k];
        else return -1;
    return strtol(digit, NULL, 16);
}

/* From the u of an escape to its last digit: one character of UTF-16, in one unit or two. NULL: it is none. */
static const char *escape_at(const char *s, const char *end)
{
    const long unit = unit_at(s, end);
    if (unit < 0 || (unit >= 0xdc00 && unit < 0xe000)) return NULL;
    if (unit < 0xd800 || unit >= 0xe000) return s + 4;
    const long other = s + 6 < end && s[5] == '\\' && s[6] == 'u' ? unit_at(s + 6, end) : -1;
    return other >= 0xdc00 && other < 0xe000 ? s + 10 : NULL;
}

/* Each: the byte after it, NULL: there is none. */
static const char *string_at(const char *s, const char *end)
{
    if (s >= end || *s++ != '"') return NULL;
    for (; s < end && *s != '"'; s++) {
        if ((unsigned char)*s < ' ') return NULL;
        if (*s != '\\') continue;
        if (++s >= end || !strchr("\"\\/bfnrtu", *s) || !*s) return NULL;
        if (*s == 'u' && !(s = escape_at(s, end))) return NULL;
    }
    return s < end ? s + 1 : NULL;
}

static const char *digits_at(const char *s, const char *end)
{
    const char *from = s;
    while (s < end && is_digit(*s)) s++;
    return s > from ? s : NULL;
}

static const char *number_at(const char *s, const char *end)
{
    if (s < end && *s == '-') s++;
    if (s < end && *s == '0') s++;
    else s = digits_at(s, end);
    if (s && s < end && *s == '.') s = digits_at(s + 1, end);
    if (s && s < end && (*s == 'e' || *s == 'E')) {
        s++;
        if (s < end && (*s == '+' || *s == '-')) s++;
        s = digits_at(s, end);
    }
    return s;
}

static const char *word_at(const char *s, const char *end)
{
    static const char *const words[] = {"true", "false", "null"};
    for (int i = 0; i < 3; i++) {
        const size_t n = strlen(words[i]);
        if ((size_t)(end - s) >= n && memcmp(s, words[i], n) == 0) return s + n;
    }
    return NULL;
}

static const char *key_at(const char *s, const char *end)
{
    s = string_at(skip_blanks(s, end), end);
    if (s) s = skip_blanks(s, end);
    return s && s < end && *s == ':' ? s + 1 : NULL;
}

static int is_object(const nest *n) { return n->is_object[(n->depth - 1) / 8] >> (n->depth - 1) % 8 & 1; }

static int is_well_formed(const char *s, const char *end)
{
    nest n = {{0}, 0};
    s = skip_blanks(s, end);
    if (s >= end || (*s != '[' && *s != '{')) return 0; /* other values are not read: it is the text, not memory */
    for (;;) { /* a value begins here */
        s = skip_blanks(s, end);
        if (s < end && (*s == '[' || *s == '{')) {
            const char close = *s == '{' ? '}' : ']';
            if (n.depth == DEEPEST) return 0;
            const unsigned char bit = (unsigned char)(1 << n.depth % 8);
            if (*s == '{') n.is_object[n.depth / 8] |= bit;
            else n.is_object[n.depth / 8] &= (unsigned char)~bit;
            n.depth++;
            s = skip_blanks(s + 1, end);
            if (s >= end || *s != close) {
                if (is_object(&n) && !(s = key_at(s, end))) return 0;
                continue;
            }
            s++;
            n.depth--;
        } else if (s < end) {
            s = *s == '"' ? string_at(s, end) : *s == '-' || is_digit(*s) ? number_at(s, end) : word_at(s, end);
        } else s = NULL;
        for (; s && n.depth > 0; s++, n.depth--) { /* a value ended here */
            s = skip_blanks(s, end);
            if (s >= end) return 0;
            if (*s == ',') break;
            if (*s != (is_object(&n) ? '}' : ']')) return 0;
        }
        if (!s) return 0;
        if (n.depth == 0) return skip_blanks(s, end) == end;
        s++; /* the comma */
        if (is_object(&n) && !(s = key_at(s, end))) return 0;
    }
}

/* What it says of texts that are well-formed and refused all the same. */
static int is_of_the_text(const json_error_t *e)
{
    switch (json_error_code(e)) {
    case json_error_stack_overflow:
    case json_error_duplicate_key:
    case json_error_numeric_overflow:
    case json_error_invalid_utf8:
    case json_error_null_character:
    case json_error_null_byte_in_key: return 1;
    default: return 0;
    }
}

/* Bytes that are read before it is asked again whether to go on: a few milliseconds. */
enum { BYTES_UNASKED = 1 << 18 };

typedef struct feed {
    const char *s, *end;
    const rg_stop *stop;
    size_t unasked;
    int is_stopped;
} feed;

static size_t next_bytes(void *to, size_t room, void *ctx)
{
    feed *f = ctx;
    const size_t left = (size_t)(f->end - f->s), n = left < room ? left : room;
    if ((f->unasked += n) >= BYTES_UNASKED) {
        f->unasked = 0;
        if ((f->is_stopped = rg_stop_asked(f->stop))) return (size_t)-1;
    }
    memcpy(to, f->s, n);
    f->s += n;
    return n;
}

rg_status rg_value_parse(const void *bytes, size_t size, const rg_stop *stop, rg_value **root, rg_diag *why)
{
    json_error_t e;
    feed f = {bytes, (const char *)bytes + size, stop, 0, 0};
    json_t *v = json_load_callback(next_bytes, &f, JSON_REJECT_DUPLICATES, &e);
    if (f.is_stopped) {
        json_decref(v);
        return RG_ECANCELLED;
    }
    if (!v && (json_error_code(&e) == json_error_out_of_memory ||
               (!is_of_the_text(&e) && is_well_formed(bytes, (const char *)bytes + size)))) return RG_ENOMEM;
    if (!v) {
        for (char *c = e.text; *c; c++)
            if ((unsigned char)*c < ' ') *c = ' ';
        return rg_fail(RG_EFORMAT, why, e.line > 0 ? e.line : 0, "not well-formed JSON: %s", e.text);
    }
    *root = v;
    return RG_OK;
}

void rg_value_free(rg_value *v) { json_decref(v); }
rg_value *rg_value_share(rg_value *v) { return json_incref(v); }
const rg_keeper RG_VALUE_KEEPER = {rg_value_share, rg_value_free};

rg_kind rg_value_kind(const rg_value *v)
{
    if (!v) return RG_KIND_NONE;
    switch (json_typeof(v)) {
    case JSON_OBJECT: return RG_KIND_OBJECT;
    case JSON_ARRAY: return RG_KIND_LIST;
    case JSON_STRING: return RG_KIND_TEXT;
    case JSON_INTEGER: return RG_KIND_INTEGER;
    case JSON_REAL: return RG_KIND_REAL;
    case JSON_TRUE:
    case JSON_FALSE: return RG_KIND_BOOL;
    default: return RG_KIND_NULL;
    }
}

const rg_value *rg_value_get(const rg_value *v, const char *key) { return json_object_get(v, key); }
size_t rg_value_count(const rg_value *v) { return json_array_size(v); }
const rg_value *rg_value_at(const rg_value *v, size_t i) { return json_array_get(v, i); }

int rg_value_number(const rg_value *v, double *number)
{
    if (!json_is_number(v)) return 0;
    *number = json_number_value(v);
    return 1;
}

int rg_value_integer(const rg_value *v, int64_t *number)
{
    if (json_is_integer(v)) return *number = json_integer_value(v), 1;
    if (!json_is_real(v)) return 0;
    const double x = json_real_value(v); /* 3.0 is what some programs write for 3 */
    if (!(x >= -9e15 && x <= 9e15) || x != (double)(int64_t)x) return 0;
    *number = (int64_t)x;
    return 1;
}

int rg_value_is_true(const rg_value *v) { return json_is_true(v); }
const char *rg_value_text(const rg_value *v) { return json_string_value(v); }

/* jansson asks for what it may change even where it only looks. */
const void *rg_value_next(const rg_value *v, const void *k)
{
    return k ? json_object_iter_next((json_t *)v, (void *)k) : json_object_iter((json_t *)v);
}

const char *rg_value_key(const void *k) { return json_object_iter_key((void *)k); }
const rg_value *rg_value_under(const void *k) { return json_object_iter_value((void *)k); }

rg_value *rg_value_overlay(const rg_value *parent, const rg_value *child)
{
    json_t *v = json_object();
    const rg_value *layer[] = {parent, child};
    for (int i = 0; v && i < 2; i++)
        for (const void *k = NULL; v && (k = rg_value_next(layer[i], k));)
            if (json_object_set(v, rg_value_key(k), (json_t *)rg_value_under(k)) != 0) {
                json_decref(v);
                v = NULL;
            }
    return v;
}

int rg_value_add(rg_value *v, const rg_value *other) { return json_object_update(v, (json_t *)other) == 0; }
size_t rg_value_keys(const rg_value *v) { return json_object_size(v); }
void rg_value_drop(rg_value *v, const char *key) { json_object_del(v, key); }
