/* rigami fold -- folds a crease pattern, writes the motion, says how it went. */
#include "aims.h"
#include "commands.h"
#include "input.h"
#include "interrupt.h"
#include "places.h"
#include "progress.h"
#include "say.h"
#include "states.h"
#include "verdict.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --------------------------------------------------------------------------------------------- afterwards ---- */

/* A drawing's own rounding, over the sheet's size: what ends this near to the pattern given ends on it. */
static const double ON_THE_PATTERN = 1e-4;
/* A pattern that was moved by less is the one given, for all that one sees. */
static const double SEEN = 1e-3;

/* One line, "1: 76 creases at once; 2: 4 simple folds"; what comes after the room for it is left to -v and the report.
 */
static void summarize_stages(const rg_report *r)
{
    char text[240] = "";
    size_t n = 0;
    for (int32_t k = 0; k < r->stages; k++) {
        const rg_folding_stage *s = &r->stage[k];
        const int32_t many = s->folds ? s->folds : s->creases;
        char one[60];
        const size_t used =
            (size_t)snprintf(one, sizeof one, "%s%d: %d %s%s%s", k ? "; " : "", (int)k + 1, (int)many,
                             s->folds ? "simple fold" : "crease", many == 1 ? "" : "s", s->folds ? "" : " at once");
        if (n + used + 8 > sizeof text) {
            snprintf(text + n, sizeof text - n, "; ...");
            break;
        }
        n += (size_t)snprintf(text + n, sizeof text - n, "%s", one);
    }
    if (r->stages > 0) printf("  stages    %s\n", text);
}

/* As instructions, fold by fold. */
static void tell_stages(const rg_report *r)
{
    const double size = r->pattern->size;
    for (int32_t k = 0; k < r->stages; k++) {
        const rg_folding_stage *s = &r->stage[k];
        printf("  stage %-3d frames %d to %d, to %.1f %%", (int)k + 1, (int)s->first_frame, (int)s->last_frame,
               r->frames[s->last_frame].percent);
        if (s->folds == 0) printf(": %d creases at once", (int)s->creases);
        for (int32_t f = 0; f < s->folds; f++) {
            const rg_simple_turn *t = &s->fold[f];
            printf("%s %s fold from (%.4g, %.4g) to (%.4g, %.4g), %d crease%s", f ? ";" : ":",
                   t->over > 0 ? "valley" : "mountain", verdict_tidy(t->line[0][0], size),
                   verdict_tidy(t->line[0][1], size), verdict_tidy(t->line[1][0], size),
                   verdict_tidy(t->line[1][1], size), (int)t->creases, t->creases == 1 ? "" : "s");
        }
        putchar('\n');
    }
}

/* Why no crease is to go anywhere; NULL: one is. */
static const char *unmoved(const options *o, const rg_motion *m)
{
    rg_crease c;
    int aimed = 0, count = 0;
    for (; rg_motion_crease(m, count, &c) == RG_OK; count++) {
        if (!isnan(c.target) && c.target != 0) return NULL;
        aimed |= !isnan(c.target) && !c.added;
    }
    if (count == 0) return "nothing to fold, as there is no crease in it";
    for (int i = 0; i < o->aims; i++)
        if (o->aim[i].what == AIM_DRIVE) return "nothing moves, as what is driven is driven to 0 degrees";
    return aimed ? "nothing moves, as every fold angle of the file is 0; --no-targets folds it flat"
                 : "nothing moves, as no crease says which way it folds";
}

/* The first line says what came of it, the second what was written. */
static void summarize(const options *o, const options *written, const char *operand, const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    char files[4096], name[4096], moved[120] = "";
    say_plain(operand, name, sizeof name);
    if (r->max_adjustment > SEEN)
        snprintf(moved, sizeof moved, ", with creases moved by up to %.2g %% of the sheet (--adjust off keeps them)",
                 100 * r->max_adjustment);
    char staged[40];
    snprintf(staged, sizeof staged, "folded in %d stages", (int)r->stages);
    const char *what = r->outcome == RG_RESTS             ? "rests, as undriven creases leave its end open"
                       : r->contact == RG_CONTACT_CROSSES ? "folded, passing through itself"
                       : r->stages > 0                    ? staged
                                                          : "folded";
    const char *still = r->states == 0 ? unmoved(o, m) : NULL;
    if (still) printf("%s: %s; %d frames\n", name, still, (int)r->frame_count);
    else
        printf("%s: %s, %.1f %%%s; %d frames in %.2f s\n", name, what, r->folded_percent, moved, (int)r->frame_count,
               r->seconds_total);
    verdict_files(written, "  written   ", files, sizeof files);
    if (files[0]) puts(files);
    summarize_stages(r);
}

static void summarize_contact(const rg_report *r)
{
    if (r->contact == RG_CONTACT_FREE && r->contact_unproved > 0)
        printf("  contact   no facets cross in any frame; %d of the ways between states could not be proved free\n",
               (int)r->contact_unproved);
    else if (r->contact == RG_CONTACT_FREE)
        printf("  contact   no facets cross, in frames or between them\n");
    else if (r->contact == RG_CONTACT_CROSSES)
        printf("  contact   facets cross from %.1f %%, in %d frames, up to %d pairs, %.2g of the sheet deep\n",
               r->first_contact_percent, (int)r->contact_frames, (int)r->contact_pairs, r->contact_depth);
}

/* All the rest that the report has. */
static void tell_details(const rg_motion *m)
{
    const rg_report *r = rg_motion_report(m);
    int32_t ways;
    printf("  reason    %s\n  least     %.1f %% of any crease\n", r->reason, r->least_folded_percent);
    tell_stages(r);
    if (r->states > 0)
        printf("  states    %d of %d, %d of the ways through flat\n", (int)r->states_reached, (int)r->states,
               (int)r->by_flat_count);
    printf("  closure   %.1e rad at the worst vertex, edge strain %.1e, facet gap %.1e\n", r->max_closure_residual,
           r->max_edge_strain, r->max_facet_gap);
    summarize_contact(r);
    printf("  model     %d creases (%d added: %s), %d constraints", (int)r->unknowns, (int)r->added_creases,
           r->why_triangulated, (int)r->constraints);
    if (rg_motion_mobility(m, r->frame_count / 2, &ways) == RG_OK) printf(", mobility %d", (int)ways);
    putchar('\n');
    printf("  method    %s, solver %s, %lld steps%s%s\n", r->method, r->solver, (long long)r->steps,
           r->strategy[0] ? ", " : "", r->strategy);
    if (r->adjust_gain > 0)
        printf("  adjusted  gain %g: moved by at most %.2g of the sheet, strain %.2g against the pattern given\n",
               r->adjust_gain, r->max_adjustment, r->max_strain_from_original);
}

/* That there is such an order of layers as is asked for; where there is none at all, folding says why. */
static int check_layers(const options *o, const states *q)
{
    rg_diag why = {0, ""};
    rg_layers *l = NULL;
    const char *name = o->operand[q->operand[0]];
    if (o->settings.layer_order < 1 || q->count > 1) return ENDS_WELL;
    rg_status s = rg_layers_create(q->pattern[0], NULL, &l, &why);
    int status = s == RG_ENOMEM ? say_status(s, name, &why) : ENDS_WELL;
    const rg_layers_info *i = s == RG_OK ? rg_layers_get_info(l) : NULL;
    if (i && i->state == RG_LAYERS_VALID) {
        uint64_t *which = calloc((size_t)i->parts + 1, sizeof *which);
        s = which ? rg_layers_which(l, (uint64_t)o->settings.layer_order, which) : RG_ENOMEM;
        if (s == RG_ENOMEM) status = say_status(s, name, &(rg_diag){0, ""});
        else if (s != RG_OK) {
            say("%s: there is no layer order %d: it has %s of them, counted from 0 (--layers)", name,
                (int)o->settings.layer_order, i->count);
            status = ENDS_USAGE;
        }
        free(which);
    }
    rg_layers_destroy(l);
    return status;
}

/* Several patterns: a sequence of states of one sheet. */
static int fold_states(const options *o, const states *q, progress *bar, rg_motion **m)
{
    rg_diag why = {0, ""};
    for (int i = 0; i < q->count && q->count > 1; i++) {
        const rg_status same = rg_pattern_same_sheet(q->pattern[0], q->pattern[i], &why);
        if (same != RG_OK) return say_status(same, o->operand[q->operand[i]], &why);
    }
    rg_driven *driven = calloc((size_t)o->aims + 1, sizeof *driven);
    int32_t count = 0;
    int aimed = driven ? ENDS_WELL : say_status(RG_ENOMEM, o->operand[0], &why);
    for (int i = 0; i < q->count && aimed == ENDS_WELL; i++)
        aimed = aims_set(o, o->operand[q->operand[i]], q->pattern[i], driven, &count);
    if (aimed == ENDS_WELL && count > 0 && q->count > 1) {
        say("fold: --drive is for one pattern, not for a sequence of states");
        aimed = ENDS_USAGE;
    }
    if (aimed != ENDS_WELL) {
        free(driven);
        return aimed;
    }
    interrupt_hold(INTERRUPT_GRACE);
    rg_status s = count > 0
                      ? rg_motion_create_driven(q->pattern[0], count, driven, &o->settings, progress_show, bar, m, &why)
                      : rg_motion_create_states((const rg_pattern *const *)q->pattern, q->count, &o->settings,
                                                progress_show, bar, m, &why);
    interrupt_release();
    progress_erase(bar);
    free(driven);
    if (s == RG_OK) return ENDS_WELL;
    const int status = say_status(s, o->operand[0], &why);
    return s == RG_EABSENT ? ENDS_USAGE : status; /* a solver that this build lacks is an option that it lacks */
}

int fold_one(const options *o, fold_seen seen, void *ctx)
{
    states q = {.count = 0};
    rg_motion *m = NULL;
    progress bar;
    progress_init(&bar, o->quiet && o->progress < 0 ? 0 : o->progress);
    int status = places_check(o);
    options written = {.output = calloc((size_t)o->outputs + 1, sizeof *written.output)};
    if (!written.output) status = say_status(RG_ENOMEM, o->operand[0], &(rg_diag){0, ""});
    if (status == ENDS_WELL) status = states_read(o, &q);
    if (status == ENDS_WELL) status = check_layers(o, &q);
    if (status == ENDS_WELL) status = fold_states(o, &q, &bar, &m);
    if (status == ENDS_WELL) {
        const rg_report *r = rg_motion_report(m);
        /* The state that was not reached is the one to name, else the last. */
        const char *name =
            o->operand[q.operand[r->states && r->states_reached < r->states ? r->states_reached : q.count - 1]];
        status = places_write(o, m, &bar, &written);
        const int on_output = o->report && strcmp(o->report, "-") == 0, stopped = r->outcome == RG_STOPPED;
        if (stopped) {
            char files[4096];
            verdict_say(o, name,
                        q.pattern[r->states && r->states_reached < r->states ? r->states_reached : q.count - 1], m);
            verdict_files(&written, "written up to there: ", files, sizeof files);
            if (files[0] && !o->quiet) say("%s: %s", name, files);
        }
        const int rolled = !(r->max_adjustment <= o->max_roll);
        if (rolled)
            say("%s: creases moved by up to %.3g %% of the sheet on the way, and should by no more than %.3g "
                "(--max-roll)",
                name, 100 * r->max_adjustment, 100 * o->max_roll);
        if (!stopped && !o->quiet && !on_output) summarize(o, &written, name, m);
        if (o->verbose && !on_output) tell_details(m);
        const int elsewhere = !stopped && !(r->moved_at_end <= ON_THE_PATTERN);
        if (elsewhere && fabs(o->settings.to) < 1)
            say("%s: at %.1f %% its creases are up to %.2g %% of the sheet away from where they were drawn, as they "
                "roll on the way to keep facets apart "
                "or free, and come back further on. Next: --adjust off keeps them, or take another --to",
                name, r->folded_percent, 100 * r->moved_at_end);
        else if (elsewhere)
            say("%s: it ends on a pattern moved by %.2g %% of the sheet, as it does not close as it was drawn; rigami "
                "info says where",
                name, 100 * r->moved_at_end);
        if (!stopped && !o->quiet) verdict_say_open(name, m);
        if (!stopped && r->contact == RG_CONTACT_CROSSES) verdict_say_contact(o, name, q.pattern[q.count - 1], m);
        if (!stopped && interrupt_time_is_up())
            say("%s: the %g seconds that it may take are over, with all of it written", name, o->seconds);
        else if (!stopped && interrupt_came()) say("%s: interrupted, with all of it written", name);
        if (status == ENDS_WELL &&
            (stopped || elsewhere || rolled || interrupt_came() || r->contact == RG_CONTACT_CROSSES))
            status = ENDS_SHORT;
        if (seen) seen(ctx, m, status);
    }
    rg_motion_destroy(m);
    free(written.output);
    states_free(&q);
    return status;
}

int cmd_fold(const options *o) { return fold_one(o, NULL, NULL); }
