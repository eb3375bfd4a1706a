/* A motion that was written before, read by both who read one: to draw it, and to judge it. */
#include "fuzz.h"

#include <math.h>

static const double SECONDS = 4; /* it is read twice, and looked at for facets that cross */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = scratch("motion.fold");
    const rg_reading s = rg_reading_default();
    rg_diag why = {0, ""};
    rg_motion *m = NULL;
    rg_certificate *c = NULL;
    scratch_write(path, data, size);
    watch_begin();
    rg_status status = rg_motion_read(path, &s, &m, &why);
    sound(status, &why);
    if (status == RG_OK) {
        const rg_report *r = rg_motion_report(m);
        promise(r->frame_count >= 1);
        promise(isfinite(r->frames[r->frame_count - 1].percent));
        sound(rg_report_write(m, 0, 0, "/dev/null", &why), &why);
    }
    rg_motion_destroy(m);
    status = rg_certificate_create(path, NULL, NULL, &c, &why);
    sound(status, &why);
    if (status == RG_OK) {
        const rg_certificate_info info = *rg_certificate_get_info(c);
        promise(info.valid == (info.faults == 0));
        sound(rg_certificate_write(c, 1, "/dev/null", &why), &why);
    }
    rg_certificate_destroy(c);
    watch_end(SECONDS);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    dice d = {seed};
    return dice_below(&d, 8) ? mutate_text(data, size, most, &d) : LLVMFuzzerMutate(data, size, most);
}
