/* A crease pattern out of a file, or out of its bytes. */
#include "pattern/build.h"
#include "read/read.h"

rg_status rg_pattern_parse(const void *bytes, size_t size, const rg_settings *s, rg_pattern **pattern, rg_diag *why)
{
    rg_lines lines;
    rg_status status = rg_read_bytes(bytes, size, NULL, s, 1, &lines, why);
    return status == RG_OK ? rg_pattern_from_lines(&lines, s, pattern, why) : status;
}

rg_status rg_pattern_read(const char *path, const rg_settings *s, rg_pattern **pattern, rg_diag *why)
{
    rg_lines lines;
    rg_status status = rg_read_file(path, s, 1, &lines, why);
    return status == RG_OK ? rg_pattern_from_lines(&lines, s, pattern, why) : status;
}
