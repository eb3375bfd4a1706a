/* A crease pattern out of a file, or out of its bytes: rigami.h, rg_pattern_read. */
#include "base/settings.h"
#include "base/status.h"
#include "generate/generate.h"
#include "pattern/build.h"
#include "read/read.h"

/* Lines are there: half of the work. */
static const double LINES_READ = 0.5;

static rg_status build(rg_lines *lines, const rg_reading *r, rg_pattern **pattern, rg_diag *why)
{
    if (r->progress && r->progress(r->progress_ctx, LINES_READ)) {
        rg_lines_free(lines);
        return rg_fail(RG_ECANCELLED, why, 0, "%s", rg_status_text(RG_ECANCELLED));
    }
    const rg_status s = rg_pattern_from_lines(lines, r, pattern, why);
    if (s == RG_OK && r->progress) r->progress(r->progress_ctx, 1);
    return s;
}

rg_status rg_pattern_parse(const void *bytes, size_t size, const rg_reading *given, rg_pattern **pattern, rg_diag *why)
{
    rg_reading r;
    rg_lines lines;
    rg_status s = rg_reading_take(given, &r, why);
    if (s == RG_OK) s = rg_read_bytes(bytes, size, NULL, &r, 1, &lines, why);
    return s == RG_OK ? build(&lines, &r, pattern, why) : s;
}

rg_status rg_pattern_read(const char *path, const rg_reading *given, rg_pattern **pattern, rg_diag *why)
{
    rg_reading r;
    rg_lines lines;
    rg_status s = rg_reading_take(given, &r, why);
    if (s == RG_OK) s = rg_read_file(path, &r, 1, &lines, why);
    return s == RG_OK ? build(&lines, &r, pattern, why) : s;
}

rg_status rg_generate_pattern(const char *kind, int32_t n, int32_t m, double angle, const rg_reading *given,
                              rg_pattern **pattern, rg_diag *why)
{
    rg_reading r;
    rg_lines lines;
    rg_status s = rg_reading_take(given, &r, why);
    if (s != RG_OK) return s;
    const rg_memory mem = rg_mem_default(r.memory);
    s = rg_generate_lines(kind, n, m, angle, &mem, &lines, why);
    return s == RG_OK ? build(&lines, &r, pattern, why) : s;
}
