#include "read/ori.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/status.h"
#include "read/locate.h"
#include "read/value.h"

#include <stdio.h>
#include <string.h>

/* "x,y", {"x": x, "y": y} or [x, y]. 0: none of these. */
static int point(const rg_value *v, rg_vec2 *x)
{
    const char *text = rg_value_text(v), *comma = text ? strchr(text, ',') : NULL;
    if (comma)
        return rg_number_parse(text, (size_t)(comma - text), &x->x) &&
               rg_number_parse(comma + 1, strlen(comma + 1), &x->y);
    const int is_list = rg_value_kind(v) == RG_KIND_LIST;
    if (is_list && rg_value_count(v) != 2) return 0;
    return rg_value_number(is_list ? rg_value_at(v, 0) : rg_value_get(v, "x"), &x->x) &&
           rg_value_number(is_list ? rg_value_at(v, 1) : rg_value_get(v, "y"), &x->y);
}

/* By its number, whether that stands alone or behind a name. */
static char assignment(const rg_value *v)
{
    static const char letters[] = {RG_BORDER, RG_MOUNTAIN, RG_VALLEY};
    const char *name = rg_value_text(v);
    int64_t number = -1;
    static const char *const names[] = {"BLACK_0", "RED_1", "BLUE_2"};
    if (!name) rg_value_integer(v, &number);
    for (int i = 0; name && i < 3; i++)
        if (strcmp(name, names[i]) == 0) number = i;
    return number >= 0 && number < 3 ? letters[number] : RG_FLAT;
}

static rg_status bad(const char *text, size_t size, const char *path, const char *what, rg_diag *why)
{
    return rg_fail(RG_EFORMAT, why, rg_locate_line(text, size, path), "%s: %s", path, what);
}

static rg_status lines(const rg_value *list, const char *text, size_t size, rg_lines *out, rg_diag *why)
{
    const size_t n = rg_value_count(list);
    if (rg_value_kind(list) != RG_KIND_LIST) return bad(text, size, "lineSegments", "there are none", why);
    if (n > INT32_MAX / 16) return bad(text, size, "lineSegments", "too many", why);
    int32_t *where = rg_mem_array(&out->mem, n, sizeof *where);
    if (!where) return RG_ENOMEM;
    rg_locate_lines(text, size, "lineSegments", where, (int32_t)n);
    rg_status s = RG_OK;
    for (size_t i = 0; s == RG_OK && i < n; i++) {
        const rg_value *one = rg_value_at(list, i);
        rg_vec2 a, b;
        const char letter = assignment(rg_value_get(one, "color"));
        if (!point(rg_value_get(one, "a"), &a) || !point(rg_value_get(one, "b"), &b)) {
            char path[60];
            snprintf(path, sizeof path, "lineSegments[%zu]", i);
            s = bad(text, size, path, "no two points a and b", why);
        } else if (!isfinite(a.x) || !isfinite(a.y) || !isfinite(b.x) || !isfinite(b.y))
            s = rg_lines_warn(out, where[i], "a line is dropped: a coordinate is not a finite number");
        else
            s = rg_lines_add(out, (rg_vec2){a.x, -a.y}, (rg_vec2){b.x, -b.y}, letter, where[i]);
    }
    rg_mem_free(&out->mem, where);
    return s;
}

/* Versions "v1", "v1.1"; the first releases gave theirs under another key. */
static rg_status check_version(const rg_value *root, const char *text, size_t size, rg_diag *why)
{
    const char *version = rg_value_text(rg_value_get(root, "@version"));
    if (!version || strcmp(version, "v1") == 0 || strncmp(version, "v1.", 3) == 0) return RG_OK;
    return rg_fail(RG_EFORMAT, why, rg_locate_line(text, size, "@version"),
                   "@version: \"%.40s\" is not known, v1 is: save it again as .fold or .cp", version);
}

rg_status rg_ori_read(const void *bytes, size_t size, const rg_memory *mem, const rg_stop *stop, rg_lines *out,
                      rg_diag *why)
{
    rg_value *root = NULL;
    rg_lines_init(out, mem);
    out->stop = stop;
    out->y_down = 1;
    rg_status s = size ? rg_value_parse(bytes, size, stop, &root, why)
                       : rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    if (s == RG_OK) s = check_version(root, bytes, size, why);
    if (s == RG_OK) s = lines(rg_value_get(root, "lineSegments"), bytes, size, out, why);
    const char *title = rg_value_text(rg_value_get(root, "title"));
    if (s == RG_OK && title && *title && !(out->title = rg_mem_string(mem, title))) s = RG_ENOMEM;
    if (s == RG_OK && out->count == 0) s = bad(bytes, size, "lineSegments", "there are none", why);
    rg_value_free(root);
    if (s != RG_OK) rg_lines_free(out);
    return s;
}
