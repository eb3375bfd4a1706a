/* A motion that was written before, read by both who read one: to draw it, and to judge it. It is written as a page and
 * as a model, for which facets are laid on each other as they are for pictures. */
#include "fuzz.h"

#include <math.h>

static const double SECONDS = 4; /* it is read twice, and looked at for facets that cross */

static int lose(void *ctx, const void *bytes, size_t n)
{
    (void)ctx, (void)bytes, (void)n;
    return 0;
}

static const rg_sink nowhere = {lose, NULL};

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
        sound(rg_motion_write_to(m, ".html", -1, &nowhere, NULL, &why), &why);
        sound(rg_motion_write_to(m, ".glb", -1, &nowhere, NULL, &why), &why);
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
