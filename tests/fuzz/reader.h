/* reader.h -- a target that reads one format; the file that includes this says which.   #define FORMAT RG_FORMAT_OPX */
#include "fuzz.h"
#include "base/memory.h"
#include "read/read.h"

#include <math.h>
#include <string.h>

/* Reading, and finding out what it is: two seconds are a hang, and sanitizers make at least five of each. */
static const double SECONDS = 10;
/* What planarising costs is asked of it in its own tests: here, few lines. */
enum { LINES_PLANARISED = 80 };

static void check_lines(const rg_lines *l)
{
    for (int32_t i = 0; i < l->count; i++) {
        const rg_line *q = &l->line[i];
        promise(isfinite(q->a.x) && isfinite(q->a.y) && isfinite(q->b.x) && isfinite(q->b.y));
        promise(isnan(q->target) || q->target == RG_FREE || fabs(q->target) <= RG_PI * (1 + 1e-9));
        promise(q->assignment && strchr("BMVFUC", q->assignment));
    }
    for (int32_t i = 0; i < l->warnings; i++) promise(l->warning[i].text[0] && !strchr(l->warning[i].text, '\n'));
}

static void check_pattern(const rg_pattern *p)
{
    const rg_pattern_info info = *rg_pattern_get_info(p);
    promise(info.vertices >= 0 && info.edges >= 0 && info.creases + info.boundary_edges <= info.edges + info.vertices);
    promise(isfinite(info.size) && info.size >= 0);
    promise(info.is_disk || info.not_disk[0]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    dice d = dice_of(data, size);
    rg_reading s = rg_reading_default();
    s.format = FORMAT;
    s.flip = dice_below(&d, 4) == 0;
    s.targets = dice_below(&d, 4) != 0;
    s.aux_creases = dice_below(&d, 4) == 0;
    s.file_frame = (int32_t)dice_below(&d, 4) - 1;
    s.sheet = (int32_t)dice_below(&d, 3);
    rg_lines l;
    rg_diag why = {0, ""};
    watch_begin();
    rg_status status = rg_read_bytes(data, size, NULL, &s, (int)dice_below(&d, 2), &l, &why);
    sound(status, &why);
    const int32_t count = status == RG_OK ? l.count : -1;
    if (status == RG_OK) {
        check_lines(&l);
        rg_lines_free(&l);
    }
    rg_pattern *p = NULL;
    if (count >= 0 && count <= LINES_PLANARISED) {
        status = rg_pattern_parse(data, size, &s, &p, &why);
        sound(status, &why);
        if (status == RG_OK) {
            check_pattern(p);
            sound(rg_info_write(p, "/dev/null", &why), &why);
            /* The text for people moves the sheet a little, which is dear, and what the target `fold` is for: seldom. */
            if (dice_below(&d, 2048) == 0) sound(rg_info_text(p, 1, "/dev/null", &why), &why);
        }
        rg_pattern_destroy(p);
    }
    watch_end(SECONDS);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    dice d = {seed};
    return dice_below(&d, 4) ? mutate_text(data, size, most, &d) : LLVMFuzzerMutate(data, size, most);
}
