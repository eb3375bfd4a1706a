/* A motion that is given by positions: written before, by this program or another one. Fold angles are those between
 * facets as they lie; where they and the flat pattern say all that the positions say, these are forgotten and the
 * motion is one of plates as any other. Else (sheets that stretch or bend) the positions are kept. */
#include "base/clock.h"
#include "base/settings.h"
#include "base/status.h"
#include "base/text.h"
#include "motion/ending.h"
#include "motion/motion.h"
#include "pattern/source.h"
#include "pose/lie.h"
#include "read/locate.h"
#include "read/read.h"
#include "read/value.h"

#include <stdio.h>
#include <string.h>

/* Positions that plates do not reach by this part of the size are kept: single precision is that good. */
static const double RIGID = 1e-6;
/* Sheets that stretch do so by less: what is so many times as long, or as large, is no sheet any more. */
static const double MOST_STRETCHED = 10;
/* A facet that moves less than this part of the size all the way stays where it is. */
static const double AT_REST = 1e-9;

/* ------------------------------------------------------------------------------------------------------ frames ---- */

typedef struct given {
    rg_motion *m;
    const rg_value *root;
    int32_t nv;      /* of the file */
    int32_t *frame;  /* [count] those of file_frames that have positions, -1: the flat sheet */
    int32_t count;
    rg_diag *why;
} given;

static const rg_value *frame_of(const given *g, int32_t k)
{
    return g->frame[k] < 0 ? NULL : rg_value_at(rg_value_get(g->root, "file_frames"), (size_t)g->frame[k]);
}

/* A frame without coordinates of its own is none of the motion. */
static rg_status find_frames(given *g)
{
    const rg_value *frames = rg_value_get(g->root, "file_frames");
    const size_t n = rg_value_count(frames);
    if (n > INT32_MAX / 2) return rg_fail(RG_EFORMAT, g->why, 0, "file_frames: too many");
    g->frame = rg_mem_array(&g->m->mem, n + 1, sizeof *g->frame);
    if (!g->frame) return RG_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        const size_t there = rg_value_count(rg_value_get(rg_value_at(frames, i), "vertices_coords"));
        if (there > 0 && there != (size_t)g->nv) /* before there is room for all of them */
            return rg_fail(RG_EFORMAT, g->why, 0,
                           "file_frames[%d].vertices_coords: %zu of them, and %d in the crease pattern", (int)i, there,
                           (int)g->nv);
        if (there > 0) g->frame[g->count++] = (int32_t)i;
    }
    if (g->count == 0)
        return rg_fail(RG_EFORMAT, g->why, 0,
                       "file_frames: no frame has vertices_coords: this is no motion, but rigami fold makes one of a "
                       "crease pattern");
    if (g->count == 1) { /* from flat to there */
        g->frame[1] = g->frame[0];
        g->frame[0] = -1;
        g->count = 2;
    }
    return RG_OK;
}

static rg_status positions(const given *g, int32_t k, rg_vec3 *x)
{
    const rg_motion *m = g->m;
    const rg_value *frame = frame_of(g, k), *list = rg_value_get(frame, "vertices_coords");
    if (!frame)
        for (int32_t v = 0; v < m->mesh.nv; v++) x[v] = (rg_vec3){m->mesh.X[v].x, m->mesh.X[v].y, 0};
    for (int32_t v = 0; frame && v < m->mesh.nv; v++) {
        const rg_value *row = rg_value_at(list, (size_t)m->source.vertex[v]);
        double q[3] = {0, 0, 0};
        const size_t n = rg_value_count(row);
        int good = n == 2 || n == 3;
        for (size_t i = 0; good && i < n; i++) good = rg_value_number(rg_value_at(row, i), &q[i]);
        if (!good)
            return rg_fail(RG_EFORMAT, g->why, 0, "file_frames[%d].vertices_coords[%d]: not two or three numbers",
                           (int)g->frame[k], (int)m->source.vertex[v]);
        if (!(fmax(fabs(q[0]), fmax(fabs(q[1]), fabs(q[2]))) <= RG_LARGEST_COORDINATE))
            return rg_fail(RG_EFORMAT, g->why, 0,
                           "file_frames[%d].vertices_coords[%d]: a coordinate is too large to compute with",
                           (int)g->frame[k], (int)m->source.vertex[v]);
        /* A file that draws downwards is turned over, as its pattern was: half a turn about x. */
        x[v] = m->source.y_down ? (rg_vec3){q[0], -q[1], -q[2]} : (rg_vec3){q[0], q[1], q[2]};
    }
    return RG_OK;
}

static double area_of(const rg_mesh *m, int32_t f, const rg_vec3 *x)
{
    const int32_t *v = m->facet_vertex + m->facet_start[f], n = m->facet_start[f + 1] - m->facet_start[f];
    double area = 0;
    for (int32_t k = 1; k + 1 < n; k++)
        area += rg_vec3_length(rg_vec3_cross(rg_vec3_sub(x[v[k]], x[v[0]]), rg_vec3_sub(x[v[k + 1]], x[v[0]]))) / 2;
    return area;
}

static rg_status check_size(const given *g, int32_t k, const rg_vec3 *x)
{
    const rg_mesh *m = &g->m->mesh;
    double far = 0, area = 0, flat = 0;
    for (int32_t v = 1; v < m->nv; v++) far = fmax(far, rg_vec3_length(rg_vec3_sub(x[v], x[0])));
    for (int32_t f = 0; f < m->nf; f++) area += area_of(m, f, x), flat += rg_mesh_twice_area(m, f, m->X) / 2;
    const double times = fmax(far / m->size, area / flat);
    if (times <= MOST_STRETCHED || g->frame[k] < 0) return RG_OK;
    return rg_fail(RG_EFORMAT, g->why, 0,
                   "file_frames[%d].vertices_coords: %.3g times as large as the crease pattern: no motion of that "
                   "sheet", (int)g->frame[k], times);
}

/* Where creases were adjusted, the pattern of the frame. */
static rg_status pattern_of(given *g, int32_t k)
{
    rg_motion *m = g->m;
    const rg_value *list = rg_value_get(frame_of(g, k), "rigami:vertices_flatCoords");
    if (!list || rg_value_count(list) != (size_t)g->nv) return RG_OK;
    const size_t nv = (size_t)m->mesh.nv;
    if (!m->flat) {
        m->flat = rg_mem_array(&m->mem, (size_t)g->count * nv, sizeof *m->flat);
        if (!m->flat) return RG_ENOMEM;
        for (int32_t i = 0; i < g->count; i++) memcpy(m->flat + (size_t)i * nv, m->mesh.X, nv * sizeof *m->flat);
    }
    for (int32_t v = 0; v < m->mesh.nv; v++) {
        const rg_value *row = rg_value_at(list, (size_t)m->source.vertex[v]);
        rg_vec2 q;
        if (!rg_value_number(rg_value_at(row, 0), &q.x) || !rg_value_number(rg_value_at(row, 1), &q.y) ||
            !(fmax(fabs(q.x), fabs(q.y)) <= RG_LARGEST_COORDINATE))
            return rg_fail(RG_EFORMAT, g->why, 0,
                           "file_frames[%d].rigami:vertices_flatCoords: not two numbers to compute with",
                           (int)g->frame[k]);
        m->flat[(size_t)k * nv + (size_t)v] = q;
    }
    return RG_OK;
}

static rg_status read_frames(given *g)
{
    rg_motion *m = g->m;
    const size_t nv = (size_t)m->mesh.nv, N = (size_t)m->mesh.N;
    rg_vec3 *normal;
    const size_t nf = (size_t)m->mesh.nf, frames = (size_t)g->count;
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(normal, nf), RG_ARRAY(m->space, frames * nv),
                                RG_ARRAY(m->rho, frames * N), RG_ARRAY(m->frame, frames));
    for (int32_t k = 0; s == RG_OK && k < g->count; k++) {
        rg_vec3 *x = m->space + (size_t)k * nv;
        double *rho = m->rho + (size_t)k * N;
        s = positions(g, k, x);
        if (s == RG_OK) s = check_size(g, k, x);
        if (s == RG_OK) s = pattern_of(g, k);
        if (s != RG_OK) break;
        rg_lie_angles(&m->mesh, x, k ? rho - N : NULL, normal, rho);
        m->frame[k].percent = 100.0 * k / (g->count - 1);
        rg_value_number(rg_value_get(frame_of(g, k), "rigami:percent"), &m->frame[k].percent);
        rg_value_number(rg_value_get(frame_of(g, k), "rigami:closure_residual"), &m->frame[k].closure_residual);
        m->report.max_edge_strain =
            fmax(m->report.max_edge_strain, rg_pose_strain(&m->mesh, rg_motion_pattern(m, k), x));
    }
    rg_mem_free(&m->mem, normal);
    m->report.frame_count = g->count;
    m->report.frames = m->frame;
    return s;
}

/* ---------------------------------------------------------------------------------------------------- plates ---- */

/* The facet that rests, which is the one that was fixed; -1: they all move. */
static int32_t at_rest(const rg_motion *m)
{
    const size_t nv = (size_t)m->mesh.nv;
    for (int32_t f = 0; f < m->mesh.nf; f++) {
        double most = 0;
        for (int32_t k = 0; k < m->report.frame_count; k++)
            for (int32_t j = m->mesh.facet_start[f]; j < m->mesh.facet_start[f + 1]; j++) {
                const int32_t v = m->mesh.facet_vertex[j];
                const rg_vec2 X = rg_motion_pattern(m, k)[v];
                const rg_vec3 x = m->space[(size_t)k * nv + (size_t)v];
                most = fmax(most, fmax(hypot(x.x - X.x, x.y - X.y), fabs(x.z)));
            }
        if (most <= AT_REST * m->mesh.size) return f;
    }
    return -1;
}

/* Forgets the positions if plates at those angles lie there too. */
static rg_status as_plates(rg_motion *m)
{
    const size_t nv = (size_t)m->mesh.nv;
    const int32_t fixed = at_rest(m);
    rg_status s = rg_tree_init(&m->mesh, fixed, &m->tree);
    rg_vec3 *x = rg_mem_array(&m->mem, nv, sizeof *x), *told = m->space;
    double most = 0;
    if (!x) s = RG_ENOMEM;
    m->space = NULL;
    for (int32_t k = 0; s == RG_OK && fixed >= 0 && k < m->report.frame_count; k++) {
        s = rg_motion_place(m, k, x);
        for (int32_t v = 0; v < m->mesh.nv; v++)
            most = fmax(most, rg_vec3_length(rg_vec3_sub(x[v], told[(size_t)k * nv + (size_t)v])));
    }
    rg_mem_free(&m->mem, x);
    if (fixed >= 0 && most <= RIGID * m->mesh.size) rg_mem_free(&m->mem, told);
    else m->space = told;
    return s;
}

/* Lines that were read as creases so that they may bend are flat ones again; the last of them are those that were
 * added. */
static void name_flat_lines(rg_motion *m)
{
    const rg_value *letters = rg_value_get(m->source.frame, "edges_assignment");
    int tail = 1;
    for (int32_t i = m->mesh.N - 1; i >= 0; i--) {
        const int32_t e = m->mesh.crease_edge[i];
        const char *letter = rg_value_text(rg_value_at(letters, (size_t)m->source.edge[e]));
        const int flat = letter && (strcmp(letter, "F") == 0 || strcmp(letter, "J") == 0);
        if (flat) m->mesh.assignment[e] = RG_FLAT;
        tail = tail && flat;
        m->mesh.added += tail;
    }
}

static rg_status build(rg_motion *m, const rg_value *root, const rg_pattern *p, rg_diag *why)
{
    rg_report *r = &m->report;
    given g = {.m = m, .root = root, .why = why};
    rg_status s = rg_motion_name(m, rg_pattern_get_info(p));
    if (s == RG_OK) s = rg_source_copy(&p->source, &m->mem, &m->source);
    if (s == RG_OK) s = rg_mesh_from_pattern(p, &m->mem, &m->mesh, why);
    if (s == RG_OK && !m->source.frame) s = rg_fail(RG_EFORMAT, why, 0, "no FOLD file: only those hold motions");
    for (int32_t v = 0; s == RG_OK && v < m->mesh.nv; v++)
        if (m->source.vertex[v] < 0)
            s = rg_fail(RG_EFORMAT, why, 0, "lines of the pattern cross at (%.6g, %.6g) where the file has no vertex",
                        m->mesh.X[v].x, m->mesh.X[v].y);
    if (s != RG_OK) return s;
    name_flat_lines(m);
    if (s == RG_OK) s = rg_motion_lend(m);
    g.nv = (int32_t)rg_value_count(rg_value_get(m->source.frame, "vertices_coords"));
    if (RG_MEM_ARRAYS(&m->mem, RG_ARRAY(m->target, (size_t)m->mesh.N),
                      RG_ARRAY(m->from, (size_t)m->mesh.N)) != RG_OK) return RG_ENOMEM;
    for (int32_t i = 0; i < m->mesh.N; i++) m->target[i] = m->mesh.target[m->mesh.crease_edge[i]];
    if (s == RG_OK) s = find_frames(&g);
    if (s == RG_OK) s = read_frames(&g);
    if (s == RG_OK) s = as_plates(m);
    rg_mem_free(&m->mem, g.frame);
    if (s == RG_OK) s = rg_ending_find(m, NULL, why);
    r->outcome = RG_FOLDED;
    r->method = r->solver = r->triangulation = r->why_triangulated = "";
    r->folded_percent = r->least_folded_percent = s == RG_OK ? m->frame[g.count - 1].percent : 0;
    r->added_creases = m->mesh.added;
    r->unknowns = m->mesh.N;
    r->constraints = 3 * m->mesh.M;
    rg_text(r->reason, sizeof r->reason, "read from a file%s", m->space ? "; its facets bend or stretch" : "");
    return s;
}

rg_status rg_motion_read(const char *path, const rg_reading *reading, rg_motion **motion, rg_diag *why)
{
    const double begun = rg_seconds();
    rg_reading with;
    rg_status s = rg_reading_take(reading, &with, why);
    if (s != RG_OK) return s;
    const rg_memory mem = rg_mem_default(with.memory);
    rg_pattern *p = NULL;
    rg_motion *m = NULL;
    rg_value *root = NULL;
    char *bytes = NULL;
    size_t size = 0;
    with.aux_creases = 1; /* what was added to bend is drawn flat */
    with.format = RG_FORMAT_FOLD;
    s = rg_read_motion(path, &mem, &bytes, &size, why);
    if (s == RG_OK) s = rg_pattern_parse(bytes, size, &with, &p, why);
    if (s == RG_OK) s = rg_value_parse(bytes, size, NULL, &root, why);
    if (s == RG_OK && !(m = rg_mem_array(&mem, 1, sizeof *m))) s = RG_ENOMEM;
    if (s == RG_OK) {
        m->mem = mem;
        m->settings = rg_settings_default();
        m->settings.memory = with.memory;
        s = build(m, root, p, why);
        static const char frames[] = "file_frames";
        if (s == RG_EFORMAT && why && strncmp(why->text, frames, strlen(frames)) == 0)
            why->line = rg_locate_told(bytes, size, why->text);
    }
    rg_value_free(root);
    rg_pattern_destroy(p);
    rg_mem_free(&mem, bytes);
    if (s != RG_OK) {
        rg_motion_destroy(m);
        return s == RG_ENOMEM ? rg_fail(s, why, 0, "out of memory") : s;
    }
    m->report.seconds_total = rg_seconds() - begun;
    *motion = m;
    return RG_OK;
}
