#include "render/picture.h"
#include "base/settings.h"
#include "base/status.h"
#include "base/vec.h"

/* Beyond this zoom one looks at less than a pixel's worth of a large sheet. */
static const double MAX_ZOOM = 1000;
/* Frames a second: what the formats of animations can say. */
static const double MIN_RATE = 0.01, MAX_RATE = 1000;
/* Beyond these a picture is no longer one of the sheet: lines cover it, or nothing of it is seen. */
static const double MIN_LINE = 0.1, MAX_LINE = 10, MOST_CLEAR = 0.9;
/* Seconds. */
static const double LONGEST_HOLD = 60;
/* Thicker than any sheet is wide. */
static const double MOST_THICKNESS = 1e9;

static rg_picture usual_picture(void)
{
    return (rg_picture){
        .size = sizeof(rg_picture),
        .width = 960,
        .height = 720,
        .azimuth = -60 * RG_DEG,
        .elevation = 35 * RG_DEG,
        .zoom = 1,
        .front = {246, 184, 80},
        .back = {252, 248, 240},
        .background = {50, 56, 68},
        .lines = RG_LINES_CREASES,
        .line_width = 1,
        .shadow = 1,
        .fps = 30,
        .hold = 1,
    };
}

void rg_picture_init(rg_picture *p, size_t size)
{
    const rg_picture usual = usual_picture();
    rg_give(p, size, &usual, sizeof usual);
}

static int is_among(int value, int last) { return value >= 0 && value <= last; }

rg_status rg_picture_check(const rg_picture *p, rg_diag *why)
{
    if (p->width < 1 || p->height < 1 || p->width > RG_MAX_PICTURE || p->height > RG_MAX_PICTURE)
        return rg_fail(RG_EARG, why, 0, "a picture of %d x %d pixels: each side may be 1 to %d", (int)p->width,
                       (int)p->height, RG_MAX_PICTURE);
    if (!isfinite(p->azimuth) || !isfinite(p->elevation))
        return rg_fail(RG_EARG, why, 0, "the camera's azimuth and elevation have to be finite");
    if (p->targeted && !(isfinite(p->target[0]) && isfinite(p->target[1])))
        return rg_fail(RG_EARG, why, 0, "the camera's target has to be finite");
    if (!(p->zoom > 0 && p->zoom <= MAX_ZOOM))
        return rg_fail(RG_EARG, why, 0, "a zoom of %g: it may be up to %g, and above 0", p->zoom, MAX_ZOOM);
    if (!(p->fps >= MIN_RATE && p->fps <= MAX_RATE))
        return rg_fail(RG_EARG, why, 0, "%g frames a second: it may be %g to %g", p->fps, MIN_RATE, MAX_RATE);
    if (!(p->line_width >= MIN_LINE && p->line_width <= MAX_LINE))
        return rg_fail(RG_EARG, why, 0, "lines %g times as wide as usual: it may be %g to %g", p->line_width, MIN_LINE,
                       MAX_LINE);
    if (!(p->see_through >= 0 && p->see_through <= MOST_CLEAR))
        return rg_fail(RG_EARG, why, 0, "facets that let %g of the light pass: it may be 0 to %g", p->see_through,
                       MOST_CLEAR);
    if (!(p->hold >= 0 && p->hold <= LONGEST_HOLD))
        return rg_fail(RG_EARG, why, 0, "an end that is held for %g seconds: it may be 0 to %g", p->hold, LONGEST_HOLD);
    if (!(p->thickness >= 0 && p->thickness <= MOST_THICKNESS))
        return rg_fail(RG_EARG, why, 0, "paper %g thick: it may be 0 to %g", p->thickness, MOST_THICKNESS);
    if (!is_among(p->lines, RG_LINES_EDGES) || !is_among(p->colour, RG_COLOUR_LAYER) ||
        !is_among(p->loop, RG_LOOP_ONCE))
        return rg_fail(RG_EARG, why, 0, "a setting of the picture is none of its kind");
    return RG_OK;
}

rg_status rg_picture_take(const rg_picture *given, rg_picture *out, rg_diag *why)
{
    rg_picture mine = usual_picture();
    rg_status s = given ? rg_take(&mine, sizeof mine, given, given->size, sizeof mine, why) : RG_OK;
    if (s == RG_OK) s = rg_picture_check(&mine, why);
    if (s == RG_OK) *out = mine;
    return s;
}
