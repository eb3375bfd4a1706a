#include "lines/lines.h"
#include "base/memory.h"
#include "base/status.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Lines that are read before it is asked again whether to go on, bytes in which there are none: a few milliseconds. */
enum { LINES_UNASKED = 2000, BYTES_UNASKED = 1 << 18 };

void rg_lines_init(rg_lines *l, const rg_memory *mem)
{
    memset(l, 0, sizeof *l);
    l->mem = *mem;
}

void rg_lines_free(rg_lines *l)
{
    if (!l->mem.resize) return;
    rg_memory mem = l->mem;
    RG_MEM_FREE(&mem, l->line, l->title, l->author, l->editor, l->reference, l->memo, l->warning, l->vertex, l->trait,
                l->face_start, l->face_vertex);
    if (l->frame) l->keeper->free(l->frame);
    memset(l, 0, sizeof *l);
}

rg_status rg_lines_go_on(rg_lines *l, size_t bytes)
{
    l->bytes += bytes;
    if (l->bytes < BYTES_UNASKED) return RG_OK;
    l->bytes = 0;
    return rg_stop_asked(l->stop) ? RG_ECANCELLED : RG_OK;
}

rg_status rg_lines_add(rg_lines *l, rg_vec2 a, rg_vec2 b, char assignment, int32_t where)
{
    if (++l->unasked >= LINES_UNASKED) {
        l->unasked = 0;
        l->bytes = 0;
        if (rg_stop_asked(l->stop)) return RG_ECANCELLED;
    }
    if (l->count >= INT32_MAX / 8) return RG_ENOMEM; /* indices of what is made of the lines stay in 32 bits */
    rg_status s = RG_MEM_GROW(&l->mem, l->line, l->room, (size_t)l->count + 1);
    if (s != RG_OK) return s;
    l->line[l->count++] = (rg_line){a, b, NAN, assignment, where};
    return RG_OK;
}

rg_status rg_lines_warn(rg_lines *l, int32_t where, const char *format, ...)
{
    if (l->warnings > RG_MOST_WARNINGS) return RG_OK;
    rg_status s = RG_MEM_GROW(&l->mem, l->warning, l->warning_room, (size_t)l->warnings + 1);
    if (s != RG_OK) return s;
    const int is_last = l->warnings == RG_MOST_WARNINGS;
    rg_diag *d = &l->warning[l->warnings++];
    va_list args;
    va_start(args, format);
    if (is_last) snprintf(d->text, sizeof d->text, "more warnings are left out");
    else rg_text_with(d->text, sizeof d->text, format, args);
    va_end(args);
    rg_status_one_line(d->text);
    d->line = where;
    return RG_OK;
}

rg_status rg_lines_trait(rg_lines *l, rg_trait_sort sort, const char *name, size_t n, char assignment)
{
    if (n >= RG_TRAIT_ROOM) n = RG_TRAIT_ROOM - 1;
    if (n == 0) return RG_OK;
    for (int32_t i = 0; i < l->traits; i++) {
        rg_trait *t = &l->trait[i];
        if (t->sort != sort || strncmp(t->name, name, n) != 0 || t->name[n]) continue;
        if (t->assignment != assignment) t->assignment = 0;
        t->count++;
        return RG_OK;
    }
    if (l->traits == RG_MOST_TRAITS) return RG_OK;
    const rg_status s = RG_MEM_GROW(&l->mem, l->trait, l->trait_room, (size_t)l->traits + 1);
    if (s != RG_OK) return s;
    rg_trait *t = &l->trait[l->traits++];
    *t = (rg_trait){.sort = sort, .assignment = assignment, .count = 1};
    memcpy(t->name, name, n);
    return RG_OK;
}

rg_vec2 rg_lines_own(const rg_lines *l, rg_vec2 x, double size)
{
    const double y = l->y_down ? -x.y : x.y;
    return (rg_vec2){fabs(x.x) > 1e-9 * size ? x.x : 0, fabs(y) > 1e-9 * size ? y : 0};
}
