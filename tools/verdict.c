#include "verdict.h"
#include "interrupt.h"
#include "say.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT = 700 };
/* A place is the same though it was computed in another way: a part of the sheet's size. */
static const double SAME_PLACE = 1e-9;

static int is_same(const rg_pattern *p, const rg_unfoldable *u, const double at[2], double size)
{
    double own[2];
    rg_pattern_own(p, (const double[]){u->x, u->y}, own);
    return hypot(own[0] - at[0], own[1] - at[1]) <= SAME_PLACE * size;
}

/* Theorems are of folding flat; targets of what the file itself asks for. */
static int speaks_against(const options *o, const rg_unfoldable *u)
{
    return (u->theorem == RG_TARGETS) ? o->reading.targets : fabs(o->settings.to) == 1;
}

/* A vertex that cannot be as it should: one that holds the fold, else any. NULL: there is none. */
static const rg_unfoldable *culprit(const options *o, const rg_pattern *p, const rg_report *r)
{
    const rg_unfoldable *u, *any = NULL;
    const int32_t n = rg_pattern_unfoldable(p, &u);
    for (int32_t k = 0; k < r->blocking_vertex_count; k++)
        for (int32_t i = 0; i < n; i++)
            if (speaks_against(o, &u[i]) && is_same(p, &u[i], r->blocking_at[k], r->pattern->size)) return &u[i];
    for (int32_t i = 0; i < n; i++)
        if (speaks_against(o, &u[i]) && (!any || (u[i].theorem == RG_TARGETS && any->theorem != RG_TARGETS)))
            any = &u[i];
    return any;
}

static int is_closed(const rg_pattern *p, const double at[2], double size)
{
    const rg_closed *c;
    const int32_t n = rg_pattern_closed(p, &c);
    for (int32_t i = 0; i < n; i++) {
        double own[2];
        rg_pattern_own(p, (const double[]){c[i].x, c[i].y}, own);
        if (hypot(own[0] - at[0], own[1] - at[1]) <= SAME_PLACE * size) return 1;
    }
    return 0;
}

/* Whole percents that it gets to; what stops short gets nowhere near 100. */
static double way_there(double percent) { return fmin(99, floor(fabs(percent))); }

/* What has not been tried, or else the part of the way that there is. */
static void next_thing(const options *o, const rg_report *r, char *text, size_t room)
{
    const double there = way_there(r->folded_percent);
    if (o->settings.triangulate == RG_TRIANGULATE_NONE)
        snprintf(text, room, "let creases be added: --triangulate auto");
    else if (o->settings.adjust == 0) snprintf(text, room, "let creases be moved on the way: --adjust auto");
    else if (o->settings.effort == RG_EFFORT_FAST) snprintf(text, room, "try more: --effort normal");
    else if (o->settings.effort == RG_EFFORT_NORMAL)
        snprintf(text, room, "try more: --effort thorough%s", there >= 1 ? ", or fold as far as it goes" : "");
    else if (there >= 1) snprintf(text, room, "fold as far as it goes: --to %.0f", there);
    else snprintf(text, room, "see whether rigami info -v names a vertex to mend");
}

static void because(const options *o, const rg_pattern *p, const rg_report *r, char *why, char *next)
{
    const rg_unfoldable *u = culprit(o, p, r);
    if (interrupt_came()) {
        if (interrupt_time_is_up()) snprintf(why, TEXT, "the %g seconds that it may take are over", o->seconds);
        else snprintf(why, TEXT, "interrupted");
        next[0] = 0;
    } else if (r->pattern->creases == 0 && r->pattern->lost_creases > 0) {
        snprintf(why, TEXT, "%s", r->reason);
        snprintf(next, TEXT,
                 "draw them up to the lines that they should meet, or join them with the --merge that a warning names");
    } else if (u) {
        char text[240];
        rg_unfoldable_text(p, u, text);
        snprintf(why, TEXT, "%s", text);
        if (u->theorem == RG_TARGETS)
            snprintf(next, TEXT, "change an angle there or leave one open, or fold with --no-targets");
        else if (r->folded_percent >= 99) snprintf(next, TEXT, "mend the vertex");
        else
            snprintf(next, TEXT, "mend the vertex, or fold part of the way: --to %.0f",
                     fmax(1, way_there(r->folded_percent)));
    } else if (r->blocking_vertex_count > 0) {
        const double *at = r->blocking_at[0];
        const int closed = is_closed(p, at, r->pattern->size);
        snprintf(why, TEXT,
                 closed ? "the vertex at (%.6g, %.6g) holds the facets round it: a crease halves the angle of two that "
                          "fold opposite ways"
                        : "the facets round the vertex at (%.6g, %.6g) hold each other, each as stiff as a plate",
                 at[0], at[1]);
        next_thing(o, r, next, TEXT);
    } else if (strncmp(r->layers, "none", 4) == 0) {
        snprintf(why, TEXT, "folded flat, the sheet would pass through itself: %s", r->layers_reason);
        snprintf(next, TEXT, "fold part of the way: --to %.0f", fmax(1, way_there(r->folded_percent)));
    } else {
        snprintf(why, TEXT, "%s", r->reason);
        next_thing(o, r, next, TEXT);
    }
}

/* A percent as it is printed, with one decimal: no rounding makes a whole way of one that stopped. */
static double cut_off(double percent) { return percent < 100 ? floor(10 * percent) / 10 : percent; }

/* The crease that ends farthest on the other side of flat than it should; -1: none does. *far: out, radians. */
static int32_t wrong_way(const rg_motion *m, rg_crease *worst, double *far)
{
    const rg_report *r = rg_motion_report(m);
    const double *rho = rg_motion_angles(m, r->frame_count - 1);
    int32_t found = -1;
    rg_crease c;
    *far = 0;
    for (int32_t i = 0; rg_motion_crease(m, i, &c) == RG_OK; i++) {
        const double side = rho[i] * c.target * r->folded_percent;
        if (isnan(c.target) || !(side < 0) || !(fabs(rho[i]) > *far)) continue;
        found = i, *far = fabs(rho[i]), *worst = c;
    }
    return found;
}

/* As far as was asked for, and yet not as was asked for. */
static int say_wrong_way(const char *name, const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    const double degrees = 180 / 3.14159265358979323846;
    rg_crease c;
    double far;
    if (r->wrong_side_creases == 0 || wrong_way(m, &c, &far) < 0) return 0;
    say("%s: gets to %.1f %% only with %d crease%s folded the wrong way, the most the one from (%.6g, %.6g) to (%.6g, "
        "%.6g), a %s, by %.2g degrees. "
        "Next: change its direction or that of its neighbours, or try --effort thorough",
        name, r->folded_percent, (int)r->wrong_side_creases, r->wrong_side_creases == 1 ? "" : "s", c.at[0][0],
        c.at[0][1], c.at[1][0], c.at[1][1], c.target < 0 ? "mountain" : "valley", far * degrees);
    return 1;
}

void verdict_say(const options *o, const char *name, const rg_pattern *p, const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    char why[TEXT] = "", next[TEXT] = "";
    because(o, p, r, why, next);
    if (fabs(o->settings.to) < 1 && strncmp(r->reason, "as far as was asked for", 23) == 0 && say_wrong_way(name, m))
        return;
    if (r->pattern->creases == 0) say("%s: nothing is folded: %s%s%s", name, why, next[0] ? ". Next: " : "", next);
    else if (r->folded_percent >= 100)
        say("%s: gets to its end only with creases moved by %.2g %% of the sheet that do not come back: %s%s%s", name,
            100 * r->moved_at_end, why, next[0] ? ". Next: " : "", next);
    else
        say("%s: stopped at %.1f %% folded: %s%s%s", name, cut_off(r->folded_percent), why, next[0] ? ". Next: " : "",
            next);
}

void verdict_say_open(const char *name, const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    const double *rho = rg_motion_angles(m, r->frame_count - 1), seen = 0.5 * 3.14159265358979323846 / 180;
    double as = 0; /* negative: mountains and valleys are exchanged */
    int turned = 0;
    rg_crease c;
    for (int32_t i = 0; rg_motion_crease(m, i, &c) == RG_OK; i++) as += isnan(c.target) ? 0 : c.target * rho[i];
    for (int32_t i = 0; rg_motion_crease(m, i, &c) == RG_OK; i++) {
        const double angle = as < 0 ? -rho[i] : rho[i];
        turned += isnan(c.target) && ((c.assignment == 'M' && angle > seen) || (c.assignment == 'V' && angle < -seen));
    }
    if (turned)
        say("%s: of the creases that no angle is asked of, %d end%s the other way than drawn, mountains as valleys or "
            "valleys as mountains. Next: ask an angle of one, or draw it as it goes",
            name, turned, turned == 1 ? "s" : "");
}

double verdict_tidy(double x, double size) { return fabs(x) > SAME_PLACE * size ? x : 0; }

void verdict_say_contact(const options *o, const char *name, const rg_pattern *p, const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    const double size = r->pattern->size,
                 before =
                     way_there(fmax(0, r->first_contact_percent - 1)); /* where facets come near is known that well */
    const rg_unfoldable *u = culprit(o, p, r);
    char why[TEXT] = "", theorem[240], next[TEXT];
    if (u) rg_unfoldable_text(p, u, theorem), snprintf(why, sizeof why, "; %s", theorem);
    else if (strncmp(r->layers, "none", 4) == 0) snprintf(why, sizeof why, "; %s", r->layers_reason);
    snprintf(next, sizeof next,
             o->settings.contact == RG_CONTACT_REPORT ? "--contact avoid looks for a motion without"
             : u                                      ? "mend the vertex"
             : *why                                   ? "change a crease there"
             : r->states > 0                          ? "take the steps in another order, or put one between"
                                                      : "fold in steps, a file or a --frame each");
    if (before >= 1 && r->states == 0)
        snprintf(next + strlen(next), sizeof next - strlen(next), ", or fold part of the way: --to %.0f", before);
    say("%s: reaches its end only by passing through itself, from %.0f %%: facets %d at (%.6g, %.6g) and %d at (%.6g, "
        "%.6g)%s. Next: %s",
        name, r->first_contact_percent, (int)r->contact_facets[0], verdict_tidy(r->contact_at[0][0], size),
        verdict_tidy(r->contact_at[0][1], size), (int)r->contact_facets[1], verdict_tidy(r->contact_at[1][0], size),
        verdict_tidy(r->contact_at[1][1], size), why, next);
}

void verdict_files(const options *o, const char *lead, char *text, size_t room)
{
    size_t n = 0;
    text[0] = 0;
    for (int i = 0; i <= o->outputs && n < room; i++) {
        const char *file = i < o->outputs ? o->output[i] : o->report;
        if (!file || strcmp(file, "-") == 0) continue;
        n += (size_t)snprintf(text + n, room - n, "%s%s", n ? ", " : lead, file);
    }
    say_plain(text, text, room);
}
