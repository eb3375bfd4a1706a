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

static void name_of(const char *file, char name[200])
{
    const char *slash = strrchr(file, '/'), *from = slash ? slash + 1 : file, *dot = strrchr(from, '.');
    const int n = dot && dot > from ? (int)(dot - from) : (int)strlen(from);
    snprintf(name, 200, "%.*s", n, from);
}

static int by_text(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

/* The names of all files, sorted, to see which of them are alike. */
static char **all_names(const options *o)
{
    char **list = calloc((size_t)o->operands, sizeof *list);
    for (int i = 0; list && i < o->operands; i++) {
        if (!(list[i] = malloc(200))) return NULL;
        name_of(o->operand[i], list[i]);
    }
    if (list) qsort(list, (size_t)o->operands, sizeof *list, by_text);
    return list;
}

static int is_alone(char *const *list, int n, const char *name)
{
    char *const *at = bsearch(&name, list, (size_t)n, sizeof *list, by_text);
    if (!at) return 1;
    return !(at > list && strcmp(at[-1], name) == 0) && !(at + 1 < list + n && strcmp(at[1], name) == 0);
}

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

static int add(const options *o, int i, char *const *names, tasks *q)
{
    const char *file = o->operand[i];
    int32_t creases;
    const int32_t sheets = sheets_of(o, file, &creases);
    uint64_t h = hash_file(hash(UINT64_C(0xcbf29ce484222325), rg_version(), strlen(rg_version())), file);
    h = hash(h, o->said, strlen(o->said));
    task *more = realloc(q->task, (size_t)(q->count + (sheets ? sheets : 1)) * sizeof *more);
    if (!more) return say_status(RG_ENOMEM, NULL, &(rg_diag){0, ""});
    q->task = more;
    for (int32_t k = sheets ? 1 : 0; k <= sheets; k++) {
        char name[200];
        task *t = &q->task[q->count++];
        *t = (task){.file = file, .sheet = sheets ? k : o->reading.sheet, .creases = creases};
        name_of(file, name);
        if (!is_alone(names, o->operands, name)) {
            snprintf(name, sizeof name, "%.199s", file);
            for (char *c = name; *c; c++)
                if (*c == '/') *c = '-';
        }
        snprintf(t->name, sizeof t->name, sheets ? "%s-%d" : "%s", name, (int)k);
        snprintf(t->key, sizeof t->key, "%016" PRIx64, h + (uint64_t)k);
    }
    return ENDS_WELL;
}

int tasks_find(const options *o, tasks *q)
{
    char **names = all_names(o);
    int status = names ? ENDS_WELL : say_status(RG_ENOMEM, NULL, &(rg_diag){0, ""});
    *q = (tasks){.count = 0};
    for (int i = 0; status == ENDS_WELL && i < o->operands; i++)
        if (o->merge || o->parts < 2 || i % o->parts == o->part - 1) status = add(o, i, names, q);
    for (int i = 0; names && i < o->operands; i++) free(names[i]);
    free(names);
    return status;
}

void tasks_free(tasks *q)
{
    free(q->task);
    *q = (tasks){.count = 0};
}
