#include "write/report.h"
#include "base/file.h"
#include "base/number.h"
#include "base/status.h"
#include "motion/motion.h"

void rg_report_pattern(rg_json *j, const rg_pattern_info *info)
{
    rg_json_integer(j, "vertices", info->vertices);
    rg_json_integer(j, "edges", info->edges);
    rg_json_integer(j, "creases", info->creases);
    rg_json_integer(j, "facets", info->facets);
    rg_json_integer(j, "interior_vertices", info->interior_vertices);
    rg_json_integer(j, "boundary_edges", info->boundary_edges);
    rg_json_integer(j, "degrees_of_freedom", info->degrees_of_freedom);
    rg_json_integer(j, "closed_vertices", info->closed_vertices);
    rg_json_number(j, "kawasaki_max_deg", info->kawasaki_max_deg);
    rg_json_integer(j, "maekawa_violations", info->maekawa_violations);
    rg_json_integer(j, "mountains", info->mountains);
    rg_json_integer(j, "valleys", info->valleys);
    rg_json_integer(j, "unassigned", info->unassigned);
    rg_json_integer(j, "flat", info->flat);
    rg_json_integer(j, "cuts", info->cuts);
    rg_json_integer(j, "lost_creases", info->lost_creases);
    rg_json_integer(j, "sheets", info->sheets);
    rg_json_number(j, "unit_metres", info->unit > 0 ? info->unit : NAN);
    rg_json_number(j, "size", info->size);
    rg_json_number(j, "merged_max", info->merged_max);
    rg_json_number(j, "kept_min", info->kept_min);
    rg_json_bool(j, "is_disk", info->is_disk);
    rg_json_string(j, "not_disk", info->is_disk ? "" : info->not_disk);
    rg_json_string(j, "title", info->title);
    rg_json_string(j, "author", info->author);
}

static void model(rg_json *j, const rg_motion *m, int32_t ways)
{
    const rg_report *r = &m->report;
    rg_json_open(j, "model", '{');
    rg_json_integer(j, "added_creases", r->added_creases);
    rg_json_integer(j, "unknowns", r->unknowns);
    rg_json_integer(j, "constraints", r->constraints);
    rg_json_integer(j, "components", r->components);
    rg_json_integer(j, "mobility", ways);
    rg_json_string(j, "triangulation", r->triangulation);
    rg_json_string(j, "why_triangulated", r->why_triangulated);
    rg_json_close(j);
}

static void run(rg_json *j, const rg_report *r, double seconds_writing, double peak_bytes)
{
    rg_json_open(j, "run", '{');
    rg_json_string(j, "method", r->method);
    rg_json_string(j, "solver", r->solver);
    rg_json_string(j, "strategy", r->strategy);
    rg_json_integer(j, "tries", r->tries);
    rg_json_number(j, "adjust_gain", r->adjust_gain);
    rg_json_integer(j, "steps", r->steps);
    rg_json_integer(j, "solves", r->solves);
    rg_json_integer(j, "cg_iterations", r->cg_iterations);
    rg_json_integer(j, "factorizations", r->factorizations);
    rg_json_integer(j, "assemblies", r->assemblies);
    rg_json_number(j, "seconds_total", r->seconds_total);
    rg_json_number(j, "seconds_solving", r->seconds_solving);
    rg_json_number(j, "seconds_writing", seconds_writing);
    rg_json_number(j, "peak_bytes", peak_bytes);
    rg_json_close(j);
}

static void blocking(rg_json *j, const rg_report *r)
{
    rg_json_integers(j, "blocking_vertices", r->blocking_vertices, r->blocking_vertex_count);
    rg_json_open_line(j, "blocking_at", '[');
    for (int32_t k = 0; k < r->blocking_vertex_count; k++) rg_json_numbers(j, NULL, r->blocking_at[k], 2);
    rg_json_close(j);
    rg_json_integers(j, "blocking_creases", r->blocking_creases, r->blocking_crease_count);
}

/* null: there is none. */
static void frame_number(rg_json *j, const char *key, int32_t frame)
{
    if (frame >= 0) rg_json_integer(j, key, frame);
    else rg_json_number(j, key, NAN);
}

static void contact(rg_json *j, const rg_report *r)
{
    static const char *const verdict[] = {
        [RG_CONTACT_UNCHECKED] = "unchecked", [RG_CONTACT_FREE] = "free", [RG_CONTACT_CROSSES] = "crosses"};
    rg_json_string(j, "contact", verdict[r->contact]);
    frame_number(j, "first_contact_frame", r->first_contact_frame);
    rg_json_number(j, "first_contact_percent", r->first_contact_percent);
    rg_json_integers(j, "contact_facets", r->contact_facets, r->contact_facets[0] < 0 ? 0 : 2);
    rg_json_open_line(j, "contact_at", '[');
    for (int k = 0; k < 2 && r->contact_facets[0] >= 0; k++) rg_json_numbers(j, NULL, r->contact_at[k], 2);
    rg_json_close(j);
    rg_json_integer(j, "contact_frames", r->contact_frames);
    frame_number(j, "deepest_contact_frame", r->deepest_contact_frame);
    rg_json_integer(j, "contact_pairs", r->contact_pairs);
    rg_json_number(j, "contact_depth", r->contact_depth);
    rg_json_integer(j, "contact_unproved", r->contact_unproved);
}

static void result(rg_json *j, const rg_motion *m, int32_t ways)
{
    const rg_report *r = &m->report;
    rg_json_open(j, "result", '{');
    rg_json_string(j, "outcome", r->outcome == RG_FOLDED ? "folded" : r->outcome == RG_RESTS ? "rests" : "stopped");
    rg_json_string(j, "reason", r->reason);
    rg_json_number(j, "folded_percent", r->folded_percent);
    rg_json_number(j, "least_folded_percent", r->least_folded_percent);
    rg_json_number(j, "max_closure_residual", r->max_closure_residual);
    rg_json_number(j, "max_edge_strain", r->max_edge_strain);
    rg_json_number(j, "max_facet_gap", r->max_facet_gap);
    rg_json_number(j, "max_overfold_deg", r->max_overfold_deg);
    rg_json_number(j, "max_adjustment", r->max_adjustment);
    rg_json_number(j, "max_strain_from_original", r->max_strain_from_original);
    rg_json_integer(j, "symmetry", r->symmetry);
    rg_json_number(j, "max_asymmetry_deg", r->max_asymmetry_deg);
    rg_json_bool(j, "isometric", r->isometric);
    rg_json_number(j, "max_crease_roll", r->max_adjustment);
    rg_json_number(j, "moved_at_end", r->moved_at_end);
    rg_json_number(j, "max_leap_deg", r->max_leap_deg);
    rg_json_integer(j, "wrong_side_creases", r->wrong_side_creases);
    rg_json_number(j, "max_wrong_side_deg", r->max_wrong_side_deg);
    rg_json_integer(j, "wrong_side_frames", r->wrong_side_frames);
    rg_json_integer(j, "mobility_at_end", ways);
    blocking(j, r);
    rg_json_string(j, "layers", r->layers);
    rg_json_string(j, "layer_orders", r->layer_orders && *r->layer_orders ? r->layer_orders : NULL);
    rg_json_string(j, "layers_reason", r->layers_reason);
    contact(j, r);
    rg_json_close(j);
}

static void search(rg_json *j, const rg_report *r)
{
    rg_json_open(j, "search", '{');
    rg_json_string(j, "rung", r->rung ? r->rung : "");
    rg_json_number(j, "compliance", r->compliance);
    rg_json_string(j, "direction", r->direction ? r->direction : "");
    rg_json_integer(j, "tries", r->tries);
    rg_json_number(j, "seconds_of_winning_try", r->seconds_of_winning_try);
    rg_json_open(j, "tried", '[');
    for (int32_t k = 0; k < r->tried_count; k++) {
        const rg_try *t = &r->tried[k];
        rg_json_open_line(j, NULL, '{');
        rg_json_string(j, "rung", t->rung);
        rg_json_string(j, "direction", t->direction);
        rg_json_number(j, "compliance", t->compliance);
        rg_json_integer(j, "symmetry", t->symmetry);
        rg_json_integer(j, "added_creases", t->added);
        rg_json_string(j, "outcome", t->outcome == RG_FOLDED ? "folded" : t->outcome == RG_RESTS ? "rests" : "stopped");
        rg_json_number(j, "percent", t->percent);
        rg_json_number(j, "seconds", t->seconds);
        rg_json_string(j, "reason", t->reason);
        rg_json_close(j);
    }
    rg_json_close(j);
    rg_json_close(j);
}

static void states(rg_json *j, const rg_report *r)
{
    if (!r->states) return;
    rg_json_open(j, "states", '{');
    rg_json_integer(j, "count", r->states);
    rg_json_integer(j, "reached", r->states_reached);
    rg_json_integers(j, "frames", r->state_frame, r->states_reached);
    rg_json_integers(j, "through_flat_from", r->by_flat, r->by_flat_count);
    rg_json_close(j);
}

/* As a folder reads them: one after the other, each from flat to flat. */
static void stages(rg_json *j, const rg_report *r)
{
    if (!r->stages) return;
    rg_json_open(j, "stages", '[');
    for (int32_t k = 0; k < r->stages; k++) {
        const rg_folding_stage *s = &r->stage[k];
        rg_json_open(j, NULL, '{');
        rg_json_integer(j, "number", k + 1);
        rg_json_string(j, "kind", s->folds ? "simple folds" : "all at once");
        rg_json_integer(j, "first_frame", s->first_frame);
        rg_json_integer(j, "last_frame", s->last_frame);
        rg_json_number(j, "from_percent", r->frames[s->first_frame].percent);
        rg_json_number(j, "to_percent", r->frames[s->last_frame].percent);
        rg_json_integers(j, "creases", s->crease, s->creases);
        rg_json_open(j, "folds", '[');
        for (int32_t f = 0; f < s->folds; f++) {
            rg_json_open_line(j, NULL, '{');
            rg_json_string(j, "fold", s->fold[f].over > 0 ? "valley" : "mountain");
            rg_json_open_line(j, "line", '[');
            for (int i = 0; i < 2; i++) rg_json_numbers(j, NULL, s->fold[f].line[i], 2);
            rg_json_close(j);
            rg_json_integers(j, "creases", s->fold[f].crease, s->fold[f].creases);
            rg_json_close(j);
        }
        rg_json_close(j);
        rg_json_close(j);
    }
    rg_json_close(j);
}

/* Which crease is which: the numbers are those of the columns of .csv, of the ids in .svg. */
static void creases(rg_json *j, const rg_motion *m)
{
    rg_json_open(j, "creases", '[');
    for (int32_t i = 0; i < m->mesh.N; i++) {
        rg_crease c;
        rg_motion_crease(m, i, &c);
        rg_json_open_line(j, NULL, '{');
        rg_json_integer(j, "number", i);
        rg_json_integers(j, "vertices", c.vertices, 2);
        rg_json_open(j, "at", '[');
        for (int k = 0; k < 2; k++) rg_json_numbers(j, NULL, c.at[k], 2);
        rg_json_close(j);
        rg_json_string(j, "assignment", (const char[]){c.assignment, 0});
        rg_json_number(j, "target_deg", isnan(c.target) ? NAN : rg_number_degrees(c.target));
        rg_json_bool(j, "added", c.added);
        if (c.line) rg_json_integer(j, "line", c.line);
        rg_json_close(j);
    }
    rg_json_close(j);
}

static rg_status write(const rg_motion *m, double seconds_writing, double peak_bytes, const rg_dest *to, rg_diag *why)
{
    const rg_report *r = &m->report;
    int32_t half_way = -1, at_end = -1;
    rg_json j;
    rg_file out;
    rg_status s = rg_motion_mobility(m, r->frame_count / 2, &half_way);
    if (s == RG_OK) s = rg_motion_mobility(m, r->frame_count - 1, &at_end);
    if (s != RG_OK) return rg_fail(s, why, 0, "out of memory for the report");
    s = rg_file_begin_to(&out, &m->mem, to, why);
    if (s != RG_OK) return s;
    rg_json_begin(&j, out.stream);
    rg_json_open(&j, NULL, '{');
    rg_json_string(&j, "rigami", RG_VERSION);
    rg_json_open(&j, "pattern", '{');
    rg_report_pattern(&j, r->pattern);
    rg_json_close(&j);
    model(&j, m, half_way);
    run(&j, r, seconds_writing, peak_bytes);
    result(&j, m, at_end);
    search(&j, r);
    states(&j, r);
    stages(&j, r);
    creases(&j, m);
    rg_json_open(&j, "frames", '[');
    for (int32_t k = 0; k < r->frame_count; k++) {
        rg_json_open_line(&j, NULL, '{');
        rg_json_number(&j, "percent", r->frames[k].percent);
        rg_json_number(&j, "closure_residual", r->frames[k].closure_residual);
        rg_json_close(&j);
    }
    rg_json_close(&j);
    rg_json_close(&j);
    return rg_file_commit(&out, why);
}

rg_status rg_report_write(const rg_motion *m, double seconds_writing, double peak_bytes, const char *file, rg_diag *why)
{
    return write(m, seconds_writing, peak_bytes, &(rg_dest){file, NULL}, why);
}

rg_status rg_report_write_to(const rg_motion *m, double seconds_writing, double peak_bytes, const rg_sink *sink,
                             rg_diag *why)
{
    return write(m, seconds_writing, peak_bytes, &(rg_dest){NULL, sink}, why);
}
