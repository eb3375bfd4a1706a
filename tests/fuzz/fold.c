/* The whole of it: a small pattern is read, folded with contact and layers on a small budget, its motion written, and what was written
 * judged from the file alone. What the report promises must be so. */
#include "fuzz.h"
#include "base/memory.h"
#include "motion/motion.h"
#include "read/read.h"

#include <math.h>
#include <string.h>

/* Stopped by its own budget well before; the rest is reading, measuring, writing. */
static const double SECONDS = 20;
enum { EDGES = 70, CALLS = 400 };

static int count_down(void *left, double progress)
{
    promise(progress >= 0 && progress <= 1 + 1e-9);
    return --*(int *)left < 0;
}

static rg_settings settings_of(dice *d)
{
    rg_settings s = rg_settings_default();
    s.frames = 12;
    s.threads = 1;
    s.effort = dice_below(d, 4) ? RG_EFFORT_FAST : RG_EFFORT_NORMAL;
    s.contact = dice_below(d, 4) ? RG_CONTACT_AVOID : dice_below(d, 2) ? RG_CONTACT_REPORT : RG_CONTACT_IGNORE;
    s.method = dice_below(d, 2) ? RG_METHOD_AUTO : (rg_method)dice_below(d, 6);
    s.solver = dice_below(d, 2) ? RG_SOLVER_AUTO : (rg_solver)dice_below(d, 4);
    s.triangulate = dice_below(d, 2) ? RG_TRIANGULATE_AUTO : (rg_triangulation)dice_below(d, 3);
    s.adjust = dice_below(d, 2) ? RG_ADJUST_AUTO : 0;
    s.symmetry = dice_below(d, 4) ? RG_SYMMETRY_AUTO : RG_SYMMETRY_OFF;
    s.pace = dice_below(d, 2) ? RG_PACE_PERCENT : RG_PACE_STEADY;
    s.to = dice_below(d, 4) ? 1 : (const double[]){-1, 0.5, -0.3, 0.01}[dice_below(d, 4)];
    return s;
}

static void check_report(const rg_motion *m, const rg_settings *s)
{
    const rg_report *r = rg_motion_report(m);
    promise(r->outcome == RG_FOLDED || r->outcome == RG_STOPPED || r->outcome == RG_RESTS);
    promise(r->outcome == RG_FOLDED || r->reason[0]);
    promise(r->outcome != RG_FOLDED || r->folded_percent >= 100 * fabs(s->to) - 1 - 1e-6);
    promise(r->outcome != RG_FOLDED || fabs(s->to) < 1 || r->least_folded_percent >= 99 - 1e-6);
    promise(s->contact != RG_CONTACT_IGNORE || r->contact == RG_CONTACT_UNCHECKED);
    promise((r->contact == RG_CONTACT_FREE) <= (r->contact_frames == 0 && r->first_contact_frame < 0));
    promise(r->frame_count >= 1 && r->frame_count <= s->frames);
    promise(isfinite(r->folded_percent) && r->folded_percent <= 100 + 1e-6);
    promise(r->least_folded_percent <= r->folded_percent + 1e-6);
    promise(isfinite(r->max_closure_residual) && isfinite(r->max_edge_strain) && isfinite(r->max_facet_gap) && isfinite(r->max_adjustment));
    for (int32_t k = 0; k < r->frame_count; k++) {
        const double *rho = rg_motion_angles(m, k);
        for (int32_t i = 0; i < r->unknowns; i++) promise(fabs(rho[i]) <= RG_PI + RG_DEG * (r->max_overfold_deg + 1e-9));
        promise(r->frames[k].closure_residual <= r->max_closure_residual * (1 + 1e-9));
    }
}

/* The judge shares no code with the fold: where all is said to be well, it must find nothing. */
static void check_verdict(const rg_motion *m, const rg_pattern *p, const char *path)
{
    const rg_report *r = rg_motion_report(m);
    rg_certificate *c = NULL;
    rg_diag why = {0, ""};
    rg_status status = rg_motion_write(m, path, NULL, &why);
    sound(status, &why);
    if (status != RG_OK) return;
    status = rg_certificate_create(path, p, NULL, &c, &why);
    promise(status == RG_OK);
    const rg_certificate_info info = *rg_certificate_get_info(c);
    if (r->outcome == RG_FOLDED && r->contact == RG_CONTACT_FREE && strcmp(r->layers, "unsolved") != 0 &&
        r->moved_at_end < 1e-6 && r->isometric && r->contact_unproved == 0 && r->max_wrong_side_deg == 0) {
        if (!info.valid) {
            const rg_settings *s = &m->settings;
            fprintf(stderr, "effort %d contact %d method %d solver %d triangulate %d adjust %g symmetry %d to %g\n", (int)s->effort,
                    (int)s->contact, (int)s->method, (int)s->solver, (int)s->triangulate, s->adjust, (int)s->symmetry, s->to);
            rg_certificate_write(c, 0, "-", &why);
        }
        promise(info.contact_depth < 1e-4);
        promise(info.valid);
        promise(info.max_rigid < 1e-6 && info.max_sheet < 1e-6 && info.max_closure < 1e-6);
    }
    rg_certificate_destroy(c);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    dice d = dice_of(data, size);
    const rg_settings s = settings_of(&d);
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    rg_lines l;
    const rg_reading r = rg_reading_default();
    rg_status status = rg_read_bytes(data, size, NULL, &r, 0, &l, &why);
    if (status != RG_OK) return 0;
    const int32_t count = l.count;
    rg_lines_free(&l);
    if (count > EDGES) return -1; /* not kept: too much to fold */
    watch_begin();
    status = rg_pattern_parse(data, size, &r, &p, &why);
    rg_pattern_info info = {0};
    if (status == RG_OK) info = *rg_pattern_get_info(p);
    if (status == RG_OK && info.edges <= EDGES) {
        int left = CALLS;
        status = rg_motion_create(p, &s, count_down, &left, &m, &why);
        sound(status, &why);
        promise((status == RG_OK) == (m != NULL));
        promise(status != RG_OK || info.is_disk);
        if (status == RG_OK) {
            check_report(m, &s);
            check_verdict(m, p, scratch("motion.fold"));
            if (dice_below(&d, 16) == 0) sound(rg_info_text(p, 1, "/dev/null", &why), &why);
        }
    }
    rg_motion_destroy(m);
    rg_pattern_destroy(p);
    watch_end(SECONDS);
    return info.edges <= EDGES ? 0 : -1;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    dice d = {seed};
    size_t n = 0;
    if (dice_below(&d, 16)) n = mutate_lines(data, size, most, &d);
    return n > 0 ? n : mutate_text(data, size, most, &d);
}
