/* paths.h -- what the way from flat to folded is like, of the program as it comes: not its ends alone.  Include after scenarios.h.
 *
 * Every check is of frames that were written out. A path fails a check when it
 *   leaps      a crease turns from one frame to the next, at an even pace, by more than 3 times the mean of the largest turns; or
 *              601 frames have leaps that are not ten times smaller than those of 61, half as much again allowed for
 *   goes back  its percents fall from a frame to the next
 *   conceals   a crease is on its wrong side by another angle than the report says
 *   depends    a frame of 61 is not, bit for bit, the frame of 601 that has its percent; or its outcome is another one with
 *              half the step, or with ten times the tolerance
 *   is askew   frames have fewer symmetries of the drawing than the report says, or by more than 0.01 degrees
 * Whether facets cross is not asked for: that is another matter. */
#ifndef PATHS_H
#define PATHS_H

#include "asymmetry.h"
#include "scenarios.h"

#include <stdlib.h>

enum { FEW = 61, MANY = 601 };
static const double MOST_LEAP = 3, IN_PROPORTION = 1.5;
/* Rounding of percents, and of angles in degrees. */
static const double SAME_PERCENT = 1e-9, SAME_ANGLE = 1e-9;
static const double EVEN_ENOUGH = 0.01; /* degrees */

typedef struct path_seen {
    int there;                 /* zero: the pattern is missing, or nothing could be folded */
    const char *rung;          /* of the ladder */
    rg_outcome outcome;
    double percent, leap[2], even[2]; /* degrees, of FEW and MANY frames */
    double back;               /* the most that percents fall */
    double wrong, wrong_told;  /* degrees */
    double apart;              /* radians: the most that frames of the same percent differ */
    int same_bits, same_outcome_by_step, same_outcome_by_tol;
    double percent_by_step, percent_by_tol;
    int elements, kept, told;  /* symmetries of the drawing, of the frames, as the report says */
    double askew, seconds;     /* degrees; of the fold of FEW frames */
} path_seen;

typedef struct path_of {
    const char *name, *what;
    rg_pattern *(*draw)(void);
    const char *file; /* of the corpus, where draw is NULL */
} path_of;

static inline rg_pattern *draw_preliminary(void) { return of_kind("preliminary", 0); }
static inline rg_pattern *draw_boxpleat(void) { return of_kind("boxpleat", 8); }
static inline rg_pattern *draw_open_sink(void) { return of_kind("open-sink", 0); }
static inline rg_pattern *draw_tatou(void) { return of_kind("tatou", 0); }
static inline rg_pattern *draw_rough(void) { return bent_miura(3, 1.25, 1.25, 1e-3, -1); }

static const path_of paths[] = {
    {"bird base", "straight on", draw_bird, NULL},
    {"preliminary fold", "straight on; all at one vertex", draw_preliminary, NULL},
    {"waterbomb base", "a bifurcation at flat", draw_waterbomb, NULL},
    {"closed vertex", "right angles, valley valley valley mountain", draw_closed, NULL},
    {"open sink", "of a waterbomb base", draw_open_sink, NULL},
    {"tatou", "a twist that closes", draw_tatou, NULL},
    {"box pleat", "8 x 8, closed vertices", draw_boxpleat, NULL},
    {"Miura, noise 1e-5", "8 x 8, creases roll by a little", draw_noisy, NULL},
    {"Miura, noise 1e-3", "3 x 3, creases roll", draw_rough, NULL},
    {"crane", "the whole model", draw_crane, NULL},
    {"brown 3x3 d2", "of the corpus, creases roll", NULL, "foldability/019-brown-3x3-d2.fold"},
    {"rafflesia", "of the corpus, creases roll", NULL, "foldability/121-komatsuoripa-rafflesia.fold"},
    {"kirby", "of the corpus, creases roll", NULL, "foldability/114-kei-kirby.fold"},
    {"turkey", "of the corpus, chords do not close", NULL, "foldability/101-ku-turkey-2-1.fold"},
    {"Miura-ori, drawn by hand", "of the corpus, straight on, stops and cuts", NULL, "svg/miura-ori.svg"},
    {"pinwheel", "of the corpus, with freedoms", NULL, "foldability/058-ku-color-change-pinwheel-1.fold"},
};
enum { PATHS = sizeof paths / sizeof *paths };

/* NULL: said aloud that it is missing. */
static inline rg_pattern *path_pattern(const path_of *of)
{
    char name[1024];
    const char *folder = getenv("RIGAMI_CORPUS");
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    if (of->draw) return of->draw();
    snprintf(name, sizeof name, "%s/%s", folder && *folder ? folder : "../shared/corpus", of->file);
    if (access(name, R_OK) != 0) {
        printf("SKIPPED: no %s (RIGAMI_CORPUS names another place)\n", name);
        return NULL;
    }
    if (rg_pattern_read(name, NULL, &p, &why) != RG_OK) fprintf(stderr, "%s: %s\n", name, why.text), exit(1);
    return p;
}

static inline rg_motion *path_fold(const rg_pattern *p, int32_t frames, rg_pace pace, double step, double tol)
{
    rg_settings s = rg_settings_default();
    rg_motion *m = NULL;
    rg_diag why = {0, ""};
    s.contact = RG_CONTACT_IGNORE;
    s.frames = frames, s.pace = pace, s.step = step * RG_DEG, s.tol = tol;
    if (rg_motion_create(p, &s, NULL, NULL, &m, &why) != RG_OK) fprintf(stderr, "%s\n", why.text), exit(1);
    return m;
}

/* Between frames: the largest turn of any crease, and the mean over frames of the largest, degrees. */
static inline void path_leaps(const rg_motion *m, double *leap, double *even)
{
    const rg_report *r = rg_motion_report(m);
    double sum = 0;
    *leap = 0;
    for (int32_t k = 1; k < r->frame_count; k++) {
        const double *a = rg_motion_angles(m, k - 1), *b = rg_motion_angles(m, k);
        double far = 0;
        for (int32_t i = 0; i < m->mesh.N; i++)
            if (!(fabs(a[i] - b[i]) <= far)) far = fabs(a[i] - b[i]);
        sum += far;
        if (!(far <= *leap)) *leap = far;
    }
    *leap /= RG_DEG;
    *even = r->frame_count > 1 ? sum / (r->frame_count - 1) / RG_DEG : 0;
}

static inline double path_falls(const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    double most = 0;
    for (int32_t k = 1; k < r->frame_count; k++)
        if (!(r->frames[k - 1].percent - r->frames[k].percent <= most)) most = r->frames[k - 1].percent - r->frames[k].percent;
    return most;
}

static inline double path_wrong(const rg_motion *m)
{
    double most = 0;
    for (int32_t i = 0; i < m->mesh.N; i++) {
        rg_crease c;
        if (rg_motion_crease(m, i, &c) != RG_OK || c.added || isnan(c.target) || c.target == 0) continue;
        for (int32_t k = 0; k < rg_motion_report(m)->frame_count; k++)
            most = fmax(most, -copysign(1, c.target) * rg_motion_angles(m, k)[i]);
    }
    return most / RG_DEG;
}

/* Every tenth frame of `many` against those of `few`, and the last state, which may come before a frame is reached. */
static inline void path_compare(const rg_motion *few, const rg_motion *many, path_seen *x)
{
    const int32_t a = rg_motion_report(few)->frame_count, b = rg_motion_report(many)->frame_count, N = few->mesh.N;
    x->same_bits = rg_motion_report(few)->outcome == rg_motion_report(many)->outcome && N == many->mesh.N;
    for (int32_t k = 0; x->same_bits && k < a; k++) {
        const int32_t j = k + 1 == a ? b - 1 : k * (MANY - 1) / (FEW - 1);
        if (j >= b) {
            x->same_bits = 0;
            break;
        }
        const double *p = rg_motion_angles(few, k), *q = rg_motion_angles(many, j);
        for (int32_t i = 0; i < N; i++) x->apart = fmax(x->apart, fabs(p[i] - q[i]));
    }
    x->same_bits &= x->apart == 0;
}

static inline path_seen path_look(const path_of *of)
{
    path_seen x = {0};
    rg_pattern *p = path_pattern(of);
    if (!p) return x;
    const double step = rg_settings_default().step / RG_DEG, tol = STABLE_TOL;
    x.there = 1;
    for (int n = 0; n < 2; n++) {
        rg_motion *m = path_fold(p, n ? MANY : FEW, RG_PACE_STEADY, step, tol);
        path_leaps(m, &x.leap[n], &x.even[n]);
        x.back = fmax(x.back, path_falls(m));
        x.wrong = path_wrong(m);
        x.wrong_told = rg_motion_report(m)->max_wrong_side_deg;
        rg_motion_destroy(m);
    }
    rg_motion *few = path_fold(p, FEW, RG_PACE_PERCENT, step, tol), *many = path_fold(p, MANY, RG_PACE_PERCENT, step, tol);
    const rg_report *r = rg_motion_report(few);
    x.rung = r->rung;
    x.outcome = r->outcome;
    x.percent = r->folded_percent;
    x.seconds = r->seconds_total;
    x.back = fmax(x.back, fmax(path_falls(few), path_falls(many)));
    path_compare(few, many, &x);
    const asymmetry a = asymmetry_measured(few, EVEN_ENOUGH);
    x.elements = a.elements, x.kept = a.kept, x.told = r->symmetry, x.askew = a.most;
    rg_motion *half = path_fold(p, FEW, RG_PACE_PERCENT, step / 2, tol), *loose = path_fold(p, FEW, RG_PACE_PERCENT, step, 10 * tol);
    x.percent_by_step = rg_motion_report(half)->folded_percent, x.percent_by_tol = rg_motion_report(loose)->folded_percent;
    x.same_outcome_by_step = rg_motion_report(half)->outcome == x.outcome;
    x.same_outcome_by_tol = rg_motion_report(loose)->outcome == x.outcome;
    rg_motion_destroy(few);
    rg_motion_destroy(many);
    rg_motion_destroy(half);
    rg_motion_destroy(loose);
    rg_pattern_destroy(p);
    return x;
}

enum { LEAPS, GOES_BACK, CONCEALS, DEPENDS_ON_FRAMES, DEPENDS_ON_STEP, DEPENDS_ON_TOL, ASKEW, PATH_CHECKS };

/* Non-zero: it fails that check. */
static inline int path_fails(const path_seen *x, int check)
{
    switch (check) {
    case LEAPS:
        return !(x->leap[0] <= MOST_LEAP * x->even[0] && x->leap[1] <= MOST_LEAP * x->even[1] &&
                 x->leap[1] * (MANY - 1) <= IN_PROPORTION * x->leap[0] * (FEW - 1));
    case GOES_BACK: return !(x->back <= SAME_PERCENT);
    case CONCEALS: return !(fabs(x->wrong - x->wrong_told) <= SAME_ANGLE);
    case DEPENDS_ON_FRAMES: return !x->same_bits;
    case DEPENDS_ON_STEP: return !x->same_outcome_by_step;
    case DEPENDS_ON_TOL: return !x->same_outcome_by_tol;
    default: return x->kept < x->told;
    }
}

#endif
