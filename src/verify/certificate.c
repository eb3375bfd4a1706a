#include "verify/certificate.h"
#include "base/file.h"
#include "base/json.h"
#include "base/status.h"
#include "base/text.h"
#include "read/read.h"
#include "verify/given.h"

#include <stdio.h>
#include <string.h>

void rg_certificate_destroy(rg_certificate *c)
{
    if (!c) return;
    const rg_memory mem = c->mem;
    RG_MEM_FREE(&mem, c->percent, c);
}

const rg_certificate_info *rg_certificate_get_info(const rg_certificate *c) { return &c->info; }

int32_t rg_certificate_faults(const rg_certificate *c, const rg_fault **list)
{
    *list = c->faults.list;
    return c->faults.count < RG_FAULTS_KEPT ? c->faults.count : RG_FAULTS_KEPT;
}

/* Places first; what they are not good for is not asked of them. */
static rg_status look(rg_certificate *c, rg_record *r, const rg_pattern *given)
{
    rg_pieces p = {0};
    int whole = 0;
    rg_status s = rg_isometry_pattern(r, &c->faults, &whole);
    if (s == RG_OK && given) rg_given_check(r, given, &c->faults);
    if (s != RG_OK || !whole) return s;
    s = rg_isometry_frames(r, &c->faults, &c->isometry);
    if (s == RG_OK && !(c->isometry.rigid <= RG_THROUGH_LEAST)) return s; /* facets that are none cross nothing */
    if (s == RG_OK) s = rg_pieces_init(r, &p);
    if (s == RG_OK) s = rg_pieces_check(r, &p, &c->faults);
    if (s == RG_OK) s = rg_through_frames(r, &p, &c->faults, &c->through);
    if (s == RG_OK) s = rg_pile_check(r, &p, &c->through.sides, &c->faults, &c->pile);
    rg_aparts_free(&c->through.sides);
    rg_pieces_free(&p);
    return s;
}

/* From states to the file's frames. */
static void number_faults(rg_certificate *c, const rg_record *r)
{
    for (int32_t i = 0; i < c->faults.count && i < RG_FAULTS_KEPT; i++) {
        rg_fault *f = &c->faults.list[i];
        if (f->frame < 0) continue;
        const int32_t k = f->frame;
        f->frame = r->number[k];
        const size_t used = strlen(f->text);
        if (k + 1 < r->frames && r->number[k + 1] == r->number[k])
            rg_text(f->text + used, sizeof f->text - used, " (in a state before that frame)");
    }
}

rg_status rg_certificate_parse(const void *bytes, size_t size, const rg_pattern *given, const rg_memory *memory,
                               rg_certificate **certificate, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(memory);
    rg_record r = {0};
    rg_certificate *c = rg_mem_array(&mem, 1, sizeof *c);
    if (!c) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    c->mem = mem;
    rg_status s = rg_record_parse(bytes, size, &mem, &r, why);
    if (s == RG_OK) {
        s = look(c, &r, given);
        if (s == RG_ENOMEM) rg_fail(s, why, 0, "out of memory");
        const int32_t frames = r.number[r.frames - 1] + 1;
        number_faults(c, &r);
        c->info = (rg_certificate_info){.valid = c->faults.count == 0, .facets = r.nf, .frames = frames,
                                        .between = r.frames - frames, .faults = c->faults.count,
            .max_sheet = c->isometry.sheet, .max_rigid = c->isometry.rigid, .max_closure = c->isometry.closed,
                .max_angle = c->isometry.angle,
            .max_leap_deg = c->isometry.leap / RG_DEG, .max_wrong_side_deg = c->isometry.wrong / RG_DEG,
                .contact_depth = c->through.depth,
            .between_depth = c->through.allowed, .ends_flat = c->pile.is_flat, .layer_pairs = c->pile.pairs,
                .layers_shown = c->pile.seen};
        /* A frame comes after what lies before it. */
        for (int32_t k = 0; k < r.frames; k++) r.percent[r.number[k]] = r.percent[k];
        c->percent = r.percent; /* kept, to say where */
        r.percent = NULL;
    }
    rg_record_free(&r);
    if (s != RG_OK) {
        rg_certificate_destroy(c);
        return s;
    }
    *certificate = c;
    return RG_OK;
}

rg_status rg_certificate_create(const char *path, const rg_pattern *given, const rg_memory *memory,
                                rg_certificate **certificate,
                                rg_diag *why)
{
    const rg_memory mem = rg_mem_default(memory);
    char *bytes = NULL;
    size_t size = 0;
    rg_status s = rg_read_motion(path, &mem, &bytes, &size, why);
    if (s == RG_OK) s = rg_certificate_parse(bytes, size, given, &mem, certificate, why);
    rg_mem_free(&mem, bytes);
    return s;
}

/* --------------------------------------------------------------------------------------- said ---- */

static void where(const rg_certificate *c, const rg_fault *f, char *text, size_t room)
{
    int n = f->frame < 0 ? rg_text(text, room, "pattern: ") : rg_text(text, room, "frame %d", (int)f->frame);
    if (f->frame >= 0 && !isnan(c->percent[f->frame]))
        n += rg_text(text + n, room - (size_t)n, " (%.4g %%)", c->percent[f->frame]);
    if (f->frame >= 0) n += rg_text(text + n, room - (size_t)n, ": ");
    if (f->facet[0] >= 0 && f->facet[1] >= 0)
        rg_text(text + n, room - (size_t)n, "facets %d and %d ", (int)f->facet[0], (int)f->facet[1]);
    else if (f->facet[0] >= 0 || f->facet[1] >= 0)
        rg_text(text + n, room - (size_t)n, "facet %d ", (int)(f->facet[0] >= 0 ? f->facet[0] : f->facet[1]));
}

static void write_text(const rg_certificate *c, FILE *out)
{
    enum { SHOWN = 12 };
    const rg_certificate_info *i = &c->info;
    for (int32_t k = 0; k < i->faults && k < SHOWN; k++) {
        char place[120] = "";
        where(c, &c->faults.list[k], place, sizeof place);
        rg_text_to(out, "%s%s\n", place, c->faults.list[k].text);
    }
    if (i->faults > SHOWN) rg_text_to(out, "and %d more\n", (int)(i->faults - SHOWN));
    if (!i->valid) return;
    char between[60] = "";
    if (i->between) rg_text(between, sizeof between, " and %d states between them", (int)i->between);
    rg_text_to(out,
               "valid: one sheet, %d rigid facets, closed in all of %d frames%s; nothing crosses in them deeper than "
               "%g of the sheet, or on rigid ways between them deeper than %.2g\n",
               (int)i->facets, (int)i->frames, between, RG_THROUGH_LEAST, i->between_depth);
    if (c->isometry.open)
        rg_text_to(out, "%d of the creases whose angles the pattern leaves open end as mountains, drawn as valleys, or "
                        "the other way\n", (int)c->isometry.open);
    if (i->ends_flat)
        rg_text_to(out,
                   "the last frame lies flat and rests on the order of its layers alone: %d pairs of facets, valid; %d "
                   "of them are seen to come in it\n",
                   (int)i->layer_pairs, (int)i->layers_shown);
}

static void write_json(const rg_certificate *c, FILE *out)
{
    const rg_certificate_info *i = &c->info;
    rg_json j;
    rg_json_begin(&j, out);
    rg_json_open(&j, NULL, '{');
    rg_json_string(&j, "rigami", RG_VERSION);
    rg_json_bool(&j, "valid", i->valid);
    rg_json_integer(&j, "frames", i->frames);
    rg_json_integer(&j, "states_between", i->between);
    rg_json_integer(&j, "facets", i->facets);
    rg_json_number(&j, "max_sheet", i->max_sheet);
    rg_json_number(&j, "max_rigid", i->max_rigid);
    rg_json_number(&j, "max_closure", i->max_closure);
    rg_json_number(&j, "max_angle", i->max_angle);
    rg_json_number(&j, "max_leap_deg", i->max_leap_deg);
    rg_json_number(&j, "max_wrong_side_deg", i->max_wrong_side_deg);
    rg_json_integer(&j, "open_creases_turned", c->isometry.open);
    rg_json_number(&j, "contact_depth", i->contact_depth);
    rg_json_number(&j, "between_depth", i->between_depth);
    rg_json_bool(&j, "ends_flat", i->ends_flat);
    rg_json_integer(&j, "layer_pairs", i->layer_pairs);
    rg_json_integer(&j, "layers_shown", i->layers_shown);
    rg_json_integer(&j, "fault_count", i->faults);
    rg_json_open(&j, "faults", '[');
    const rg_fault *list;
    const int32_t n = rg_certificate_faults(c, &list);
    for (int32_t k = 0; k < n; k++) {
        rg_json_open_line(&j, NULL, '{');
        if (list[k].frame >= 0) rg_json_integer(&j, "frame", list[k].frame);
        else rg_json_number(&j, "frame", NAN);
        rg_json_number(&j, "percent", list[k].frame >= 0 ? c->percent[list[k].frame] : NAN);
        rg_json_open_line(&j, "facets", '[');
        for (int f = 0; f < 2; f++)
            if (list[k].facet[f] >= 0) rg_json_integer(&j, NULL, list[k].facet[f]);
        rg_json_close(&j);
        rg_json_string(&j, "what", list[k].text);
        rg_json_close(&j);
    }
    rg_json_close(&j);
    rg_json_close(&j);
}

static rg_status write(const rg_certificate *c, int json, const rg_dest *to, rg_diag *why)
{
    rg_file out;
    const rg_status s = rg_file_begin_to(&out, &c->mem, to, why);
    if (s != RG_OK) return s;
    if (json) write_json(c, out.stream);
    else write_text(c, out.stream);
    return rg_file_commit(&out, why);
}

rg_status rg_certificate_write(const rg_certificate *c, int json, const char *file, rg_diag *why)
{
    return write(c, json, &(rg_dest){file, NULL}, why);
}

rg_status rg_certificate_write_to(const rg_certificate *c, int json, const rg_sink *sink, rg_diag *why)
{
    return write(c, json, &(rg_dest){NULL, sink}, why);
}
