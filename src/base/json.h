/* json.h -- JSON written as it comes, so that a motion of any length needs no room of its own.
 * Used by  save, write
 *
 * A value inside an object has a key, one inside an array has NULL. What cannot be written shows when the file is
 * committed (base/file.h). */
#ifndef RG_JSON_H
#define RG_JSON_H

#include "rigami.h"
#include <stdio.h>

enum { RG_JSON_DEPTH = 16 };

typedef struct rg_json {
    FILE *out;     /* NULL: nothing is written, only counted */
    size_t bytes;  /* written so far */
    int depth;
    struct { unsigned char end, line, filled; } level[RG_JSON_DEPTH + 1];
} rg_json;

void rg_json_begin(rg_json *j, FILE *out);
/* Opens what `kind` says: '{' or '[', with one value a line. */
void rg_json_open(rg_json *j, const char *key, char kind);
/* The same, and all of it on one line. */
void rg_json_open_line(rg_json *j, const char *key, char kind);
void rg_json_close(rg_json *j);

/* Reads back as the same double; what is no finite number is null, as JSON has none. */
void rg_json_number(rg_json *j, const char *key, double x);
void rg_json_numbers(rg_json *j, const char *key, const double *x, int32_t n);
void rg_json_integer(rg_json *j, const char *key, int64_t i);
void rg_json_integers(rg_json *j, const char *key, const int32_t *i, int32_t n);
void rg_json_bool(rg_json *j, const char *key, int yes);
/* UTF-8; a byte that is none becomes U+FFFD. '<' is escaped, so that the text may stand in a page. NULL: null. */
void rg_json_string(rg_json *j, const char *key, const char *text);

#endif
