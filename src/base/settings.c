#include "base/settings.h"
#include "base/status.h"
#include "base/vec.h"

#include <stdint.h>
#include <string.h>

/* Radians; half a turn takes some thirty million such steps, and one that rounding takes back would never come to an
 * end. */
static const double LEAST_STEP = 1e-7;
/* Rounding leaves some 1e-15 at a vertex, and its sums a hundred times that. */
static const double LEAST_TOLERANCE = 1e-13, MOST_TOLERANCE = 0.1;
/* More of the sheet than that is no gap. */
static const double MOST_MERGED = 0.1;

/* ------------------------------------------------------------------------------------------ structs that grow ---- */

void rg_give(void *out, size_t size, const void *usual, size_t own)
{
    memset(out, 0, size);
    memcpy(out, usual, size < own ? size : own);
    if (size >= sizeof size) memcpy(out, &size, sizeof size);
}

rg_status rg_take(void *out, size_t own, const void *given, size_t its, size_t least, rg_diag *why)
{
    if (its > own)
        return rg_fail(RG_EARG, why, 0,
                       "settings of a newer rigami than the library that is linked (%zu bytes, known are %zu)", its,
                       own);
    if (its < least)
        return rg_fail(RG_EARG, why, 0,
                       "settings without their size (%zu bytes, at least %zu): start from the default", its, least);
    memcpy(out, given, its);
    memcpy(out, &own, sizeof own);
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------------------- folding ---- */

static rg_settings usual_settings(void)
{
    return (rg_settings){.size = sizeof(rg_settings), .step = 5 * RG_DEG, .tol = 1e-10, .to = 1, .rest = 1,
                         .frames = 60, .fixed_facet = -1, .adjust = RG_ADJUST_AUTO,
                         .effort = RG_EFFORT_NORMAL, .layer_order = -1};
}

void rg_settings_init(rg_settings *s, size_t size)
{
    const rg_settings usual = usual_settings();
    rg_give(s, size, &usual, sizeof usual);
}

static int is_among(int value, int last) { return value >= 0 && value <= last; }

static rg_status check_settings(const rg_settings *s, rg_diag *why)
{
    if (s->frames < 2) return rg_fail(RG_EARG, why, 0, "there must be at least 2 frames");
    if (!(s->step >= LEAST_STEP && s->step <= RG_PI))
        return rg_fail(RG_EARG, why, 0, "the step must be at least %.2g and at most 180 degrees", LEAST_STEP / RG_DEG);
    if (!(s->tol >= LEAST_TOLERANCE && s->tol <= MOST_TOLERANCE))
        return rg_fail(RG_EARG, why, 0, "the tolerance must be within %g, which rounding leaves, and %g",
                       LEAST_TOLERANCE, MOST_TOLERANCE);
    if (!(fabs(s->to) <= 1)) return rg_fail(RG_EARG, why, 0, "the end must be within -100 and 100 percent");
    if (!(s->adjust == RG_ADJUST_AUTO || (s->adjust >= 0 && s->adjust <= 1)))
        return rg_fail(RG_EARG, why, 0, "the gain of crease adjustment must be within 0 and 1");
    if (!is_among(s->triangulate, RG_TRIANGULATE_ALL) || !is_among(s->contact, RG_CONTACT_IGNORE) ||
        !is_among(s->effort, RG_EFFORT_THOROUGH) || !is_among(s->symmetry, RG_SYMMETRY_OFF) ||
        !is_among(s->method, RG_METHOD_ADAPTIVE) || !is_among(s->solver, RG_SOLVER_SVD) ||
        !is_among(s->pace, RG_PACE_STEADY))
        return rg_fail(RG_EARG, why, 0, "a setting is none of its kind");
    if (s->threads < 0) return rg_fail(RG_EARG, why, 0, "there cannot be less than no threads");
    if (s->layer_order < -1) return rg_fail(RG_EARG, why, 0, "orders of layers are counted from 0");
    if (s->fixed_facet < -1) return rg_fail(RG_EARG, why, 0, "facets are counted from 0");
    return RG_OK;
}

rg_status rg_settings_take(const rg_settings *given, rg_settings *out, rg_diag *why)
{
    rg_settings mine = usual_settings();
    rg_status s = given ? rg_take(&mine, sizeof mine, given, given->size, sizeof mine, why) : RG_OK;
    if (s == RG_OK) s = check_settings(&mine, why);
    if (s == RG_OK) *out = mine;
    return s;
}

/* ---------------------------------------------------------------------------------------------------- reading ---- */

static rg_reading usual_reading(void)
{
    return (rg_reading){.size = sizeof(rg_reading), .merge = RG_MERGE_DEFAULT, .file_frame = -1, .targets = 1};
}

void rg_reading_init(rg_reading *r, size_t size)
{
    const rg_reading usual = usual_reading();
    rg_give(r, size, &usual, sizeof usual);
}

rg_status rg_reading_take(const rg_reading *given, rg_reading *out, rg_diag *why)
{
    rg_reading mine = usual_reading();
    const rg_status s = given ? rg_take(&mine, sizeof mine, given, given->size, sizeof mine, why) : RG_OK;
    if (s != RG_OK) return s;
    if (!(mine.merge >= 0 && mine.merge <= MOST_MERGED))
        return rg_fail(RG_EARG, why, 0, "the merge tolerance is not between 0 and %g of the sheet", MOST_MERGED);
    if (!is_among(mine.format, RG_FORMAT_ORI)) return rg_fail(RG_EARG, why, 0, "there is no such format");
    if (mine.kinds < 0 || (mine.kinds > 0 && !mine.kind))
        return rg_fail(RG_EARG, why, 0, "kinds of lines that are not there");
    if (mine.file_frame < -1) return rg_fail(RG_EARG, why, 0, "frames of a file are counted from 0");
    if (mine.sheet < 0) return rg_fail(RG_EARG, why, 0, "sheets are counted from 1");
    if (!(mine.unit >= 0 && mine.unit <= 1e9))
        return rg_fail(RG_EARG, why, 0, "a unit is a length in metres, 0 where it is not known");
    *out = mine;
    return RG_OK;
}

/* ---------------------------------------------------------------------------------------------------- drawing ---- */

void rg_drawing_init(rg_drawing *d, size_t size)
{
    const rg_drawing usual = {.size = sizeof usual};
    rg_give(d, size, &usual, sizeof usual);
}

static rg_status check_line(const rg_drawing *d, int32_t e, rg_diag *why)
{
    static const char letters[] = "BMVUFC";
    const double angle = d->target ? d->target[e] : NAN;
    for (int i = 0; i < 2; i++)
        if (d->ends[e][i] < 0 || d->ends[e][i] >= d->vertices)
            return rg_fail(RG_EARG, why, e + 1, "edge %d ends at vertex %d, and they are 0 to %d", (int)e,
                           (int)d->ends[e][i], (int)d->vertices - 1);
    if (!d->assignment[e] || !strchr(letters, d->assignment[e]))
        return rg_fail(RG_EARG, why, e + 1, "edge %d: an assignment is one of B M V U F C", (int)e);
    if (!isnan(angle) && angle != RG_FREE && !(fabs(angle) <= RG_PI))
        return rg_fail(RG_EARG, why, e + 1, "edge %d: a target of %g is not within -pi and pi", (int)e, angle);
    return RG_OK;
}

rg_status rg_drawing_take(const rg_drawing *given, rg_drawing *out, rg_diag *why)
{
    rg_drawing d = {.size = sizeof d};
    if (!given) return rg_fail(RG_EARG, why, 0, "there is no drawing");
    rg_status s = rg_take(&d, sizeof d, given, given->size, sizeof d, why);
    if (s == RG_OK && (d.vertices < 1 || d.edges < 1 || !d.at || !d.ends || !d.assignment))
        s = rg_fail(RG_EARG, why, 0, "a drawing has vertices, edges and assignments");
    for (int32_t v = 0; s == RG_OK && v < d.vertices; v++)
        if (!isfinite(d.at[v][0]) || !isfinite(d.at[v][1]))
            s = rg_fail(RG_EARG, why, 0, "vertex %d is nowhere", (int)v);
    for (int32_t e = 0; s == RG_OK && e < d.edges; e++) s = check_line(&d, e, why);
    if (s == RG_OK && !(d.unit >= 0 && d.unit <= 1e9))
        s = rg_fail(RG_EARG, why, 0, "a unit is a length in metres, 0 where it is not known");
    if (s == RG_OK) *out = d;
    return s;
}
