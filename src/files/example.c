#include "base/memory.h"
#include "base/settings.h"
#include "base/status.h"
#include "files/convert.h"
#include "generate/generate.h"
#include "read/read.h"

#include <stddef.h>
#include <string.h>

static rg_example usual_example(void) { return (rg_example){.size = sizeof(rg_example)}; }

void rg_example_init(rg_example *e, size_t size)
{
    const rg_example usual = usual_example();
    rg_give(e, size, &usual, sizeof usual);
}

/* 0: not asked for. Much less is too small to compute with. */
static int is_length(double x) { return x == 0 || (x >= 1e-9 && x <= 1e9); }

static rg_status take(const rg_example *given, rg_example *out, rg_diag *why)
{
    rg_example mine = usual_example();
    const size_t first = offsetof(rg_example, memory); /* as it was at first; nothing between is anybody's */
    const size_t least = given && given->size == first ? first : sizeof mine;
    const rg_status s = given ? rg_take(&mine, sizeof mine, given, given->size, least, why) : RG_OK;
    if (s != RG_OK) return s;
    if (!is_length(mine.side) || !is_length(mine.cell) || !is_length(mine.unit))
        return rg_fail(RG_EARG, why, 0, "a length is from 1e-9 to 1e9");
    if (mine.side > 0 && mine.cell > 0)
        return rg_fail(RG_EARG, why, 0, "either the sheet's side or that of a part can be asked for");
    *out = mine;
    return RG_OK;
}

/* Where to: to.path or to.sink. */
static rg_status put(const char *kind, const rg_example *e, const rg_dest *to, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(e->memory);
    rg_reading r = rg_reading_default();
    rg_lines lines;
    r.memory = e->memory;
    const rg_status s = rg_generate_example(kind, e, &mem, &lines, why);
    return s == RG_OK ? rg_convert_lines(&lines, e->format, &r, to, NULL, NULL, why) : s;
}

rg_status rg_example_write(const char *kind, const rg_example *given, const char *path, rg_diag *why)
{
    rg_example e = {0};
    rg_status s = take(given, &e, why);
    if (s != RG_OK) return s;
    if (e.format == RG_FORMAT_AUTO) e.format = rg_read_extension(path);
    const char *slash = strrchr(path, '/');
    if (e.format == RG_FORMAT_AUTO && !strchr(slash ? slash : path, '.')) e.format = RG_FORMAT_OPX;
    s = rg_convert_check(e.format, path, why);
    return s == RG_OK ? put(kind, &e, &(rg_dest){path, NULL}, why) : s;
}

rg_status rg_example_write_to(const char *kind, const rg_example *given, const rg_sink *sink, rg_diag *why)
{
    rg_example e = {0};
    rg_status s = take(given, &e, why);
    if (s != RG_OK) return s;
    if (e.format == RG_FORMAT_AUTO) e.format = RG_FORMAT_OPX;
    s = rg_convert_check(e.format, "a sink", why);
    return s == RG_OK ? put(kind, &e, &(rg_dest){NULL, sink}, why) : s;
}
