#include "read/value.h"
#include "base/status.h"

#include <string.h>

#include <jansson.h>

rg_status rg_value_parse(const void *bytes, size_t size, rg_value **root, rg_diag *why)
{
    json_error_t e;
    json_t *v = json_loadb(bytes, size, JSON_REJECT_DUPLICATES, &e);
    if (!v && json_error_code(&e) == json_error_out_of_memory) return RG_ENOMEM;
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

void rg_value_drop(rg_value *v, const char *key) { json_object_del(v, key); }
