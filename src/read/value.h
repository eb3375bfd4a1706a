/* value.h -- a JSON text as a tree of values.
 * Uses  jansson, lines.h        Used by  fold.c save/fold.c files write/foldfile.c */
#ifndef RG_VALUE_H
#define RG_VALUE_H

#include "lines/lines.h"

typedef enum rg_kind {
    RG_KIND_NONE,
    RG_KIND_NULL,
    RG_KIND_BOOL,
    RG_KIND_INTEGER,
    RG_KIND_REAL,
    RG_KIND_TEXT,
    RG_KIND_LIST,
    RG_KIND_OBJECT
} rg_kind;

/* RG_EFORMAT: why->line and why->text; also for a key that comes twice in one object. The depth is bounded, and numbers
 * are finite. RG_ENOMEM. RG_ECANCELLED: by `stop`, which may be NULL. Owner: the caller, rg_value_free. */
rg_status rg_value_parse(const void *bytes, size_t size, const rg_stop *stop, rg_value **root, rg_diag *why);
void rg_value_free(rg_value *v);
/* The same value for another owner, who frees it too. */
rg_value *rg_value_share(rg_value *v);
/* These two, for who holds a value without knowing it. */
extern const rg_keeper RG_VALUE_KEEPER;

/* All of these take NULL, which is of kind RG_KIND_NONE and has nothing in it. */
rg_kind rg_value_kind(const rg_value *v);
/* Of an object: NULL where there is no such key. */
const rg_value *rg_value_get(const rg_value *v, const char *key);
/* Of a list: how many, and which. */
size_t rg_value_count(const rg_value *v);
const rg_value *rg_value_at(const rg_value *v, size_t i);
int rg_value_number(const rg_value *v, double *number);
int rg_value_integer(const rg_value *v, int64_t *number);
int rg_value_is_true(const rg_value *v);
/* NULL: no text. */
const char *rg_value_text(const rg_value *v);
/* The keys of an object in the order of the file: const void *k = NULL; while ((k = rg_value_next(v, k))) ... */
const void *rg_value_next(const rg_value *v, const void *k);
const char *rg_value_key(const void *k);
const rg_value *rg_value_under(const void *k);

/* A new object with all of `parent` (an object or NULL) and over it all of `child`; values are shared. NULL: no
 * memory. */
rg_value *rg_value_overlay(const rg_value *parent, const rg_value *child);
/* All of another object is put into one, over what is there; values are shared. 0: no memory. */
int rg_value_add(rg_value *v, const rg_value *other);
/* How many an object has. */
size_t rg_value_keys(const rg_value *v);
/* Takes a key out of an object. */
void rg_value_drop(rg_value *v, const char *key);

#endif
