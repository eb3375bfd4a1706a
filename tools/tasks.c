#include "tasks.h"
#include "say.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Fowler's, Noll's and Vo's: no secret, only another number for another text. */
static uint64_t hash(uint64_t h, const void *bytes, size_t n)
{
    for (const unsigned char *c = bytes; n > 0; n--) h = (h ^ *c++) * UINT64_C(0x100000001b3);
    return h;
}

/* Bytes that tell one file from another: as many as are read of one, as some have no end. */
enum { MOST_HASHED = 1 << 30 };

static uint64_t hash_file(uint64_t h, const char *path)
{
    char bytes[65536];
    size_t n, all = 0;
    FILE *f = fopen(path, "rb");
    for (; f && all < MOST_HASHED && (n = fread(bytes, 1, sizeof bytes, f)) > 0; all += n) h = hash(h, bytes, n);
    if (f) fclose(f);
    return h;
}

/* ----------------------------------------------------------------------------------------------------- names ---- */

enum { NAME = 200, OF_LONG = 170 }; /* bytes; of a name that is too long, those that are kept */

/* What names a file: what is no part of one, or counts frames, or ends a line, is a dash. Non-zero: it has room. */
static int put_name(const char *from, size_t n, char name[NAME])
{
    snprintf(name, NAME, "%.*s", (int)n, from);
    for (char *c = name; *c; c++)
        if (*c == '/' || *c == '%' || (unsigned char)*c < 32 || *c == 127) *c = '-';
    return n < NAME;
}

/* The file's own name, without folder and ending. */
static int short_name(const char *file, char name[NAME])
{
    const char *slash = strrchr(file, '/'), *from = slash ? slash + 1 : file, *dot = strrchr(from, '.');
    return put_name(from, dot && dot > from ? (size_t)(dot - from) : strlen(from), name);
}

static int long_name(const char *file, char name[NAME]) { return put_name(file, strlen(file), name); }

static uint64_t hash_text(const char *text) { return hash(UINT64_C(0xcbf29ce484222325), text, strlen(text)); }

/* All names that files may go by, hashed and sorted: two that are alike by chance only get longer names. */
struct names {
    uint64_t *shorter, *longer;
    unsigned char *again; /* [operands] non-zero: that very file was named before */
    int count;
};

typedef struct path { const char *text; int number; } path;

static int by_path(const void *a, const void *b)
{
    const path *p = a, *q = b;
    const int order = strcmp(p->text, q->text);
    return order ? order : (p->number > q->number) - (p->number < q->number);
}

static int by_value(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void names_free(struct names *n)
{
    free(n->shorter);
    free(n->longer);
    free(n->again);
}

static int names_init(struct names *n, const options *o)
{
    const size_t room = (size_t)o->operands + 1;
    path *sorted = calloc(room, sizeof *sorted);
    char name[NAME];
    *n = (struct names){.shorter = calloc(room, sizeof *n->shorter),
                        .longer = calloc(room, sizeof *n->longer),
                        .again = calloc(room, 1)};
    if (!sorted || !n->shorter || !n->longer || !n->again) {
        free(sorted);
        return say_status(RG_ENOMEM, NULL, &(rg_diag){0, ""});
    }
    for (int i = 0; i < o->operands; i++) sorted[i] = (path){o->operand[i], i};
    qsort(sorted, (size_t)o->operands, sizeof *sorted, by_path);
    for (int i = 0; i < o->operands; i++) {
        if (i > 0 && strcmp(sorted[i].text, sorted[i - 1].text) == 0) {
            n->again[sorted[i].number] = 1;
            continue;
        }
        short_name(sorted[i].text, name);
        n->shorter[n->count] = hash_text(name);
        long_name(sorted[i].text, name);
        n->longer[n->count++] = hash_text(name);
    }
    qsort(n->shorter, (size_t)n->count, sizeof *n->shorter, by_value);
    qsort(n->longer, (size_t)n->count, sizeof *n->longer, by_value);
    free(sorted);
    return ENDS_WELL;
}

/* How often a name is in a list: 0, 1, 2 for more. */
static int times(const uint64_t *list, int count, const char *name)
{
    const uint64_t key = hash_text(name), *at = bsearch(&key, list, (size_t)count, sizeof *list, by_value);
    if (!at) return 0;
    return 1 + ((at > list && at[-1] == key) || (at + 1 < list + count && at[1] == key));
}

/* What the batch itself writes beside the files. */
static int is_of_batch(const char *name)
{
    return strcmp(name, "table") == 0 || strcmp(name, "rows") == 0 || strncmp(name, "part-", 5) == 0;
}

/* Whether sheet 1, 2, ... of a file goes by what another file is called. */
static int has_sheet_of(const struct names *n, const char *name, int32_t sheets)
{
    char one[NAME + 20];
    int found = 0;
    for (int32_t k = 1; k <= sheets && !found; k++) {
        snprintf(one, sizeof one, "%s-%d", name, (int)k);
        found = times(n->shorter, n->count, one) || times(n->longer, n->count, one);
    }
    return found;
}

/* No two files have the same one: the short one where it is the only one, else the long one, else one with a number of
 * the path's own. */
static void name_of(const struct names *n, const char *file, int32_t sheets, char name[NAME])
{
    if (short_name(file, name) && !is_of_batch(name) && times(n->shorter, n->count, name) == 1 &&
        !has_sheet_of(n, name, sheets))
        return;
    if (long_name(file, name) && !is_of_batch(name) && times(n->longer, n->count, name) == 1 &&
        !times(n->shorter, n->count, name) && !has_sheet_of(n, name, sheets))
        return;
    short_name(file, name);
    snprintf(name + strnlen(name, OF_LONG), NAME - OF_LONG, "-%016" PRIx64, hash_text(file));
}

/* ----------------------------------------------------------------------------------------------------- tasks ---- */

/* How many sheets to fold one by one; 0: the file is taken as it is. *creases: out, of the file as it is. */
static int32_t sheets_of(const options *o, const char *file, int32_t *creases)
{
    rg_pattern *p = NULL;
    rg_pattern_info i = {.sheets = 0};
    rg_diag why;
    if (rg_pattern_read(file, &o->reading, &p, &why) == RG_OK) i = *rg_pattern_get_info(p);
    rg_pattern_destroy(p);
    *creases = i.creases;
    return o->reading.sheet == 0 && i.sheets > 1 ? i.sheets : 0;
}

static int add(const options *o, int i, const struct names *names, tasks *q)
{
    const char *file = o->operand[i];
    int32_t creases;
    const int32_t sheets = sheets_of(o, file, &creases);
    uint64_t h = hash_file(hash(UINT64_C(0xcbf29ce484222325), rg_version(), strlen(rg_version())), file);
    h = hash(h, o->said, strlen(o->said));
    if (o->picture.image) h = hash_file(h, o->picture.image);
    task *more = realloc(q->task, (size_t)(q->count + (sheets ? sheets : 1)) * sizeof *more);
    if (!more) return say_status(RG_ENOMEM, NULL, &(rg_diag){0, ""});
    q->task = more;
    for (int32_t k = sheets ? 1 : 0; k <= sheets; k++) {
        char name[NAME];
        task *t = &q->task[q->count++];
        *t = (task){.file = file, .sheet = sheets ? k : o->reading.sheet, .creases = creases};
        name_of(names, file, sheets, name);
        snprintf(t->name, sizeof t->name, sheets ? "%s-%d" : "%s", name, (int)k);
        snprintf(t->key, sizeof t->key, "%016" PRIx64, h + (uint64_t)k);
    }
    return ENDS_WELL;
}

int tasks_find(const options *o, tasks *q)
{
    struct names names;
    int status = names_init(&names, o);
    *q = (tasks){.count = 0};
    for (int i = 0; status == ENDS_WELL && i < o->operands; i++)
        if (!names.again[i] && (o->merge || o->parts < 2 || i % o->parts == o->part - 1))
            status = add(o, i, &names, q);
    names_free(&names);
    return status;
}

void tasks_free(tasks *q)
{
    free(q->task);
    *q = (tasks){.count = 0};
}
