/* write/: what is written is read back by other means and held against the motion; files appear whole or not at all. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/number.h"
#include "near.h"
#include "counted.h"
#include "motions.h"
#include "write/png.h"
#include "written.h"

#include <jansson.h>
#include <signal.h>
#include <sys/resource.h>

enum { FRAMES = 7 };
static const double ALPHA = 1.125;
static const double TIDY = 1e-11; /* what tables round percents and degrees to */

/* A Miura-ori whose angles follow from a formula; adjusted: its pattern grows and shrinks on the way, which keeps angles. */
static rg_motion *sample(int adjusted)
{
    double alpha = ALPHA;
    rg_lines l = miura(3, 4, 1.25, 2.385, ALPHA);
    rg_motion *m = motion_by(&l, FRAMES, miura_folds, &alpha);
    m->title = rg_mem_string(&m->mem, "\xe6\x8a\x98\xe3\x82\x8a <b>\"Miura\"</b>\n\xff & </script>");
    m->frame[2].closure_residual = 1.5e-11;
    m->report.folded_percent = 100;
    if (!adjusted) return m;
    const size_t nv = (size_t)m->mesh.nv;
    m->flat = rg_mem_array(&m->mem, FRAMES * nv, sizeof *m->flat);
    assert_non_null(m->flat);
    for (size_t k = 0; k < FRAMES; k++)
        for (size_t v = 0; v < nv; v++) {
            const double grown = k == 0 || k == FRAMES - 1 ? 1 : 1 + 0.05 * sin(k * RG_PI / (FRAMES - 1));
            m->flat[k * nv + v] = (rg_vec2){grown * m->mesh.X[v].x, grown * m->mesh.X[v].y};
        }
    return m;
}

static void write_as(const rg_motion *m, const char *name)
{
    char path[300];
    rg_diag why = {0, ""};
    const rg_status s = rg_motion_write(m, written_path(name, path), NULL, &why);
    if (s != RG_OK) fail_msg("%s: %d, %s", name, s, why.text);
}

static rg_vec3 *positions(const rg_motion *m, int32_t frame)
{
    rg_vec3 *x = calloc((size_t)m->mesh.nv, sizeof *x);
    assert_non_null(x);
    assert_int_equal(rg_motion_pose(m, frame, (double(*)[3])x), RG_OK);
    return x;
}

/* About the middle of the sheet, as files of single precision have them. */
static rg_vec3 *centred(const rg_motion *m, int32_t frame)
{
    rg_vec3 *x = positions(m, frame);
    rg_vec2 low = m->mesh.X[0], high = low;
    for (int32_t v = 0; v < m->mesh.nv; v++) {
        low = (rg_vec2){fmin(low.x, m->mesh.X[v].x), fmin(low.y, m->mesh.X[v].y)};
        high = (rg_vec2){fmax(high.x, m->mesh.X[v].x), fmax(high.y, m->mesh.X[v].y)};
    }
    for (int32_t v = 0; v < m->mesh.nv; v++) x[v].x -= (low.x + high.x) / 2, x[v].y -= (low.y + high.y) / 2;
    return x;
}

static double distance(rg_vec3 a, rg_vec3 b) { return rg_vec3_length(rg_vec3_sub(a, b)); }

/* -------------------------------------------------------------------------------------------------- FOLD ---- */

static json_t *get(const json_t *object, const char *key)
{
    json_t *value = json_object_get(object, key);
    if (!value) fail_msg("there is no %s", key);
    return value;
}

static double at(const json_t *list, size_t i) { return json_number_value(json_array_get(list, i)); }
static double at2(const json_t *list, size_t i, size_t k) { return at(json_array_get(list, i), k); }

static json_t *parse(const char *text, size_t n)
{
    json_error_t error;
    json_t *j = json_loadb(text, n, JSON_REJECT_DUPLICATES, &error);
    if (!j) fail_msg("line %d: %s", error.line, error.text);
    return j;
}

static json_t *read_json(const char *name)
{
    size_t n;
    char *text = written_read(name, &n);
    json_t *j = parse(text, n);
    free(text);
    return j;
}

/* Angle at an edge from the normals of its two facets, by coordinates alone; valley positive. */
static double dihedral(const rg_mesh *m, const rg_vec3 *x, int32_t e)
{
    rg_vec3 n[2] = {{0, 0, 0}, {0, 0, 0}};
    for (int side = 0; side < 2; side++) {
        const int32_t f = m->edge_facet[e][side], first = m->facet_start[f];
        for (int32_t j = first + 2; j < m->facet_start[f + 1]; j++) {
            const rg_vec3 a = x[m->facet_vertex[first]], b = x[m->facet_vertex[j - 1]], c = x[m->facet_vertex[j]];
            n[side] = rg_vec3_add(n[side], rg_vec3_cross(rg_vec3_sub(b, a), rg_vec3_sub(c, a)));
        }
    }
    rg_vec3 along = rg_vec3_sub(x[m->edge[e][1]], x[m->edge[e][0]]);
    along = rg_vec3_scale(1 / rg_vec3_length(along), along);
    return atan2(rg_vec3_dot(rg_vec3_cross(n[1], n[0]), along), rg_vec3_dot(n[0], n[1])) / RG_DEG;
}

static void check_key_frame(const json_t *j, const rg_mesh *m)
{
    near(json_number_value(get(j, "file_spec")), 1.2, 0);
    assert_string_equal(json_string_value(json_array_get(get(j, "frame_classes"), 0)), "creasePattern");
    assert_int_equal(json_array_size(get(j, "vertices_coords")), m->nv);
    assert_int_equal(json_array_size(get(j, "edges_vertices")), m->ne);
    assert_int_equal(json_array_size(get(j, "edges_assignment")), m->ne);
    assert_int_equal(json_array_size(get(j, "edges_foldAngle")), m->ne);
    assert_int_equal(json_array_size(get(j, "faces_vertices")), m->nf);
    for (int32_t e = 0; e < m->ne; e++) {
        const char *letter = json_string_value(json_array_get(get(j, "edges_assignment"), (size_t)e));
        assert_int_equal(letter[0], m->assignment[e]);
        near(at(get(j, "edges_foldAngle"), (size_t)e), letter[0] == 'M' ? -180 : letter[0] == 'V' ? 180 : 0, 0);
        for (size_t k = 0; k < 2; k++) near(at2(get(j, "edges_vertices"), (size_t)e, k), m->edge[e][k], 0);
    }
    for (int32_t f = 0; f < m->nf; f++) {
        const json_t *face = json_array_get(get(j, "faces_vertices"), (size_t)f), *edge = json_array_get(get(j, "faces_edges"), (size_t)f);
        const size_t n = json_array_size(face);
        assert_int_equal(json_array_size(edge), n);
        double area = 0;
        for (size_t i = 0; i < n; i++) {
            const int32_t a = (int32_t)at(face, i), b = (int32_t)at(face, (i + 1) % n), *v = m->edge[(int32_t)at(edge, i)];
            assert_true((v[0] == a && v[1] == b) || (v[0] == b && v[1] == a));
            area += rg_vec2_cross(m->X[a], m->X[b]) / 2;
        }
        assert_true(area > 0);
    }
}

static void check_frame(const json_t *frame, const rg_motion *m, int32_t k, int adjusted)
{
    const rg_mesh *mesh = &m->mesh;
    rg_vec3 *x = calloc((size_t)mesh->nv, sizeof *x), *wanted = positions(m, k);
    assert_true(json_is_true(get(frame, "frame_inherit")));
    near(json_number_value(get(frame, "frame_parent")), 0, 0);
    assert_string_equal(json_string_value(json_array_get(get(frame, "frame_classes"), 0)), "foldedForm");
    near(json_number_value(get(frame, "rigami:percent")), m->frame[k].percent, TIDY);
    near(json_number_value(get(frame, "rigami:closure_residual")), m->frame[k].closure_residual, 0);
    const json_t *flat = json_object_get(frame, "rigami:vertices_flatCoords");
    assert_int_equal(flat != NULL, adjusted && k > 0 && k < FRAMES - 1);
    for (int32_t v = 0; v < mesh->nv; v++) {
        const json_t *c = json_array_get(get(frame, "vertices_coords"), (size_t)v);
        assert_int_equal(json_array_size(c), 3);
        x[v] = (rg_vec3){at(c, 0), at(c, 1), at(c, 2)};
        near(distance(x[v], wanted[v]), 0, 0);
    }
    for (int32_t e = 0; e < mesh->ne; e++) {
        const size_t a = (size_t)mesh->edge[e][0], b = (size_t)mesh->edge[e][1];
        const rg_vec2 p = flat ? (rg_vec2){at2(flat, a, 0), at2(flat, a, 1)} : mesh->X[a];
        const rg_vec2 q = flat ? (rg_vec2){at2(flat, b, 0), at2(flat, b, 1)} : mesh->X[b];
        near(distance(x[a], x[b]) / hypot(q.x - p.x, q.y - p.y), 1, 1e-9);
        const double said = at(get(frame, "edges_foldAngle"), (size_t)e);
        if (mesh->edge_crease[e] < 0) near(said, 0, 0);
        else near(remainder(said - dihedral(mesh, x, e), 360), 0, 1e-7);
    }
    free(x);
    free(wanted);
}

static void check_fold(int adjusted)
{
    rg_motion *m = sample(adjusted);
    write_as(m, "x.fold");
    json_t *j = read_json("x.fold"), *frames = get(j, "file_frames");
    check_key_frame(j, &m->mesh);
    assert_string_equal(json_string_value(get(j, "file_title")), "\xe6\x8a\x98\xe3\x82\x8a <b>\"Miura\"</b>\n\xef\xbf\xbd & </script>");
    assert_int_equal(json_array_size(frames), FRAMES);
    for (int32_t k = 0; k < FRAMES; k++) check_frame(json_array_get(frames, (size_t)k), m, k, adjusted);
    json_decref(j);
    rg_motion_destroy(m);
}

static void fold_keeps_lengths_and_angles(void **state)
{
    (void)state;
    check_fold(0);
}

static void fold_shows_the_adjusted_pattern(void **state)
{
    (void)state;
    check_fold(1);
}

/* A quad that was cut in two: the diagonal is 'F', is listed, and bends. */
static void bend(const rg_mesh *m, double t, double *rho, void *ctx)
{
    (void)ctx;
    for (int32_t i = 0; i < m->N; i++) rho[i] = t * 2.385 * (i + 1) / (i + 2);
}

static rg_motion *cut_in_two(void)
{
    const double width[] = {1.25, 2.385, 1.75};
    rg_lines l = strip(3, width, "MV", 1.1);
    rg_motion *m = motion_by(&l, FRAMES, bend, NULL);
    rg_mesh cut;
    assert_int_equal(rg_triangulate_all(&m->mesh, &cut), RG_OK);
    assert_int_equal(cut.added, 3);
    rg_mesh_free(&m->mesh);
    m->mesh = cut;
    rg_tree_free(&m->tree);
    assert_int_equal(rg_tree_init(&m->mesh, 0, &m->tree), RG_OK);
    rg_mem_free(&m->mem, m->rho);
    m->rho = rg_mem_array(&m->mem, FRAMES * (size_t)cut.N, sizeof *m->rho);
    assert_non_null(m->rho);
    for (int k = 0; k < FRAMES; k++) bend(&m->mesh, k / (FRAMES - 1.0), m->rho + k * cut.N, NULL);
    m->report.added_creases = 3;
    return m;
}

static void fold_has_added_creases(void **state)
{
    (void)state;
    rg_motion *m = cut_in_two();
    write_as(m, "x.fold");
    json_t *j = read_json("x.fold"), *added = get(j, "rigami:edges_added");
    check_key_frame(j, &m->mesh);
    assert_int_equal(json_array_size(added), m->mesh.ne);
    for (int32_t e = 0; e < m->mesh.ne; e++)
        assert_int_equal(json_is_true(json_array_get(added, (size_t)e)), m->mesh.assignment[e] == 'F');
    for (int32_t k = 0; k < FRAMES; k++) check_frame(json_array_get(get(j, "file_frames"), (size_t)k), m, k, 0);
    json_decref(j);
    rg_motion_destroy(m);
}

/* ---------------------------------------------------------------------------------------------- CSV, OBJ ---- */

static int32_t lines_in(const char *text)
{
    int32_t n = 0;
    for (; *text; text++) n += *text == '\n';
    return n;
}

static void csv_is_a_table(void **state)
{
    (void)state;
    rg_motion *m = sample(0);
    write_as(m, "x.csv");
    char *text = written_read("x.csv", NULL), *at_ = text;
    assert_int_equal(lines_in(text), 1 + FRAMES);
    for (int32_t k = -1; k < FRAMES; k++)
        for (int32_t i = -2; i < m->mesh.N; i++) {
            char *end = at_ + strcspn(at_, ",\n"), letter;
            int number, v[2];
            double x[4], target;
            assert_int_equal(*end, i + 1 < m->mesh.N ? ',' : '\n');
            *end = 0;
            if (k < 0 && i < 0) assert_string_equal(at_, i == -2 ? "frame" : "percent");
            else if (i == -2) assert_int_equal(atoi(at_), k);
            else if (i == -1) near(strtod(at_, NULL), m->frame[k].percent, TIDY);
            else if (k < 0) {
                const int32_t e = m->mesh.crease_edge[i];
                const int n = sscanf(at_, "c%d_%c %d-%d (%lf %lf)-(%lf %lf) target %lf", &number, &letter, &v[0], &v[1], &x[0], &x[1], &x[2], &x[3], &target);
                assert_int_equal(number, i);
                assert_int_equal(letter, m->mesh.assignment[e]);
                const double wish = m->target ? m->target[i] : m->mesh.target[e];
                assert_int_equal(n, isnan(wish) ? 8 : 9);
                if (n == 9) near(target * RG_DEG, wish, 1e-12);
                for (int j = 0; j < 2; j++) {
                    assert_int_equal(v[j], m->mesh.edge[e][j]);
                    near(x[2 * j], m->mesh.X[v[j]].x, 0);
                    near(fabs(x[2 * j + 1]), fabs(m->mesh.X[v[j]].y), 0);
                    if (m->source.y_down) near(x[2 * j + 1], -m->mesh.X[v[j]].y, 0);
                }
            } else near(strtod(at_, NULL), rg_number_degrees(rg_motion_angles(m, k)[i]), TIDY);
            at_ = end + 1;
        }
    assert_int_equal(*at_, 0);
    free(text);
    rg_motion_destroy(m);
}

static void check_obj(const char *name, const rg_motion *m, int32_t frame)
{
    char *text = written_read(name, NULL);
    rg_vec3 *wanted = positions(m, frame);
    const int32_t nf = m->mesh.nf;
    int32_t v = 0, f = 0, e = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        double x, y, z, angle;
        int i, j, type;
        if (sscanf(line, "v %lf %lf %lf", &x, &y, &z) == 3) {
            near(distance((rg_vec3){x, y, z}, wanted[v++]), 0, 0);
        } else if (line[0] == 'f') {
            char *at_ = line + 1; /* the front, then the back, the other way round */
            const int32_t from = m->mesh.facet_start[f % nf], n = m->mesh.facet_start[f % nf + 1] - from;
            for (int32_t k = 0; k < n; k++)
                assert_int_equal(strtol(at_, &at_, 10) - 1, m->mesh.facet_vertex[from + (f < nf ? k : n - 1 - k)]);
            assert_int_equal(*at_, 0);
            f++;
        } else if (sscanf(line, "#e %d %d %d %lf", &i, &j, &type, &angle) == 4) {
            const int32_t crease = m->mesh.edge_crease[e];
            assert_int_equal(i - 1, m->mesh.edge[e][0]);
            assert_int_equal(j - 1, m->mesh.edge[e][1]);
            assert_int_equal(m->mesh.assignment[e], "BFVM"[type]);
            near(angle, crease < 0 ? 0 : rg_motion_angles(m, frame)[crease] / RG_DEG, 0);
            e++;
        } else if (line[0] == 'g') {
            char side[8];
            int32_t facet;
            assert_int_equal(sscanf(line, "g %7s facet%d", side, &facet), 2);
            assert_string_equal(side, f < nf ? "front" : "back");
            assert_int_equal(facet, f % nf);
        } else {
            assert_true(line[0] == '#' || strcmp(line, "o sheet") == 0);
        }
    }
    assert_int_equal(v, m->mesh.nv);
    assert_int_equal(f, 2 * nf);
    assert_int_equal(e, m->mesh.ne);
    free(text);
    free(wanted);
}

static void obj_is_one_frame_or_each(void **state)
{
    (void)state;
    rg_motion *m = cut_in_two();
    char name[32];
    written_files(1);
    write_as(m, "x.obj");
    check_obj("x.obj", m, FRAMES - 1);
    written_files(1);
    write_as(m, "y-%03d.obj");
    assert_int_equal(written_files(0), FRAMES);
    for (int32_t k = 0; k < FRAMES; k++) {
        snprintf(name, sizeof name, "y-%03d.obj", (int)k);
        check_obj(name, m, k);
    }
    rg_motion_destroy(m);
}

/* --------------------------------------------------------------------------------------------------- STL ---- */

static uint32_t u32(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double f32(const char *bytes)
{
    const uint32_t bits = u32(bytes);
    float x;
    memcpy(&x, &bits, 4);
    return x;
}

static rg_vec3 f32_vector(const char *bytes) { return (rg_vec3){f32(bytes), f32(bytes + 4), f32(bytes + 8)}; }

/* Every side of a triangle is that of one other, the other way round, told by the bits of its ends. Returns the volume. */
static double volume_of_closed(const char *name)
{
    size_t n;
    char *bytes = written_read(name, &n);
    const uint32_t triangles = u32(bytes + 80);
    double volume = 0;
    assert_int_equal(n, 84 + 50 * (size_t)triangles);
    for (uint32_t i = 0; i < triangles; i++) {
        const rg_vec3 a = f32_vector(bytes + 84 + 50 * i + 12), b = f32_vector(bytes + 84 + 50 * i + 24), c = f32_vector(bytes + 84 + 50 * i + 36);
        volume += rg_vec3_dot(a, rg_vec3_cross(b, c)) / 6;
        for (int k = 0; k < 3; k++) {
            const char *from = bytes + 84 + 50 * i + 12 + 12 * k, *to = bytes + 84 + 50 * i + 12 + 12 * ((k + 1) % 3);
            int there = 0, back = 0;
            for (uint32_t j = 0; j < triangles; j++)
                for (int q = 0; q < 3; q++) {
                    const char *u = bytes + 84 + 50 * j + 12 + 12 * q, *v = bytes + 84 + 50 * j + 12 + 12 * ((q + 1) % 3);
                    there += memcmp(u, from, 12) == 0 && memcmp(v, to, 12) == 0;
                    back += memcmp(u, to, 12) == 0 && memcmp(v, from, 12) == 0;
                }
            if (there != 1 || back != 1) fail_msg("%s: a side of triangle %d is there %d times, and %d times the other way", name, (int)i, there, back);
        }
    }
    free(bytes);
    return volume;
}

/* With a thickness, the surface is closed, in every frame: flat as a sheet, half folded, and flat at the end, where plates lie in one
 * place; a crane at the end once had sides of four triangles. It holds the sheet's area times the thickness, but for what is inside
 * and outside of folds, which cancels. */
static void stl_with_a_thickness_is_a_solid(void **state)
{
    (void)state;
    rg_motion *m = sample(0);
    rg_picture p = rg_picture_default();
    char path[300], name[40];
    rg_diag why;
    double area = 0;
    p.thickness = 0.01 * m->mesh.size;
    assert_int_equal(rg_motion_write(m, written_path("x-%d.stl", path), &p, &why), RG_OK);
    for (int32_t f = 0; f < m->mesh.nf; f++)
        for (int32_t j = m->mesh.facet_start[f] + 1; j + 1 < m->mesh.facet_start[f + 1]; j++)
            area += rg_vec2_turn(m->mesh.X[m->mesh.facet_vertex[m->mesh.facet_start[f]]], m->mesh.X[m->mesh.facet_vertex[j]],
                                 m->mesh.X[m->mesh.facet_vertex[j + 1]]) / 2;
    for (int k = 0; k < FRAMES; k++) {
        snprintf(name, sizeof name, "x-%d.stl", k);
        near(volume_of_closed(name), area * p.thickness, 0.02 * area * p.thickness);
    }
    rg_motion_destroy(m);
}

/* An L-shaped facet, so that cutting it at a wrong corner would show in the area. */
static void stl_has_the_area_of_the_sheet(void **state)
{
    (void)state;
    const rg_vec2 corner[] = {{0, 0}, {3.1, 0}, {3.1, 1.2}, {1.3, 1.2}, {1.3, 2.9}, {0, 2.9}};
    rg_lines l = drawing();
    draw_polygon(&l, RG_BORDER, corner, 6);
    draw(&l, RG_VALLEY, 0, 2.1, 1.3, 2.1);
    rg_motion *m = motion_by(&l, FRAMES, bend, NULL);
    size_t n;
    written_files(1);
    write_as(m, "x%d.stl");
    assert_int_equal(written_files(0), FRAMES);
    char *bytes = written_read("x6.stl", &n);
    const uint32_t triangles = u32(bytes + 80);
    rg_vec3 *x = centred(m, 6);
    double area = 0;
    assert_int_equal(n, 84 + 50 * (size_t)triangles);
    assert_int_equal(triangles, 4 + 2);
    assert_memory_not_equal(bytes, "solid", 5);
    for (uint32_t i = 0; i < triangles; i++) {
        const char *t = bytes + 84 + 50 * i;
        const rg_vec3 normal = f32_vector(t), a = f32_vector(t + 12), b = f32_vector(t + 24), c = f32_vector(t + 36);
        const rg_vec3 cross = rg_vec3_cross(rg_vec3_sub(b, a), rg_vec3_sub(c, a));
        area += rg_vec3_length(cross) / 2;
        near(rg_vec3_dot(normal, cross), rg_vec3_length(cross), 1e-6);
        for (int k = 0; k < 3; k++) {
            double least = INFINITY;
            for (int32_t v = 0; v < m->mesh.nv; v++) least = fmin(least, distance(f32_vector(t + 12 + 12 * k), x[v]));
            below(least, 1e-6);
        }
    }
    near(area, 3.1 * 1.2 + 1.3 * 1.7, 1e-6);
    free(x);
    free(bytes);
    rg_motion_destroy(m);
}

/* -------------------------------------------------------------------------------------------------- glTF ---- */

typedef struct model { json_t *json; char *bytes; } model; /* bytes: the buffer */

static const char *element(const model *g, int32_t accessor, size_t i)
{
    const json_t *a = json_array_get(get(g->json, "accessors"), (size_t)accessor);
    const json_t *view = json_array_get(get(g->json, "bufferViews"), (size_t)json_integer_value(get(a, "bufferView")));
    const char *type = json_string_value(get(a, "type"));
    const size_t width = strcmp(type, "SCALAR") == 0 ? 1 : (size_t)(type[3] - '0');
    assert_true((json_int_t)i < json_integer_value(get(a, "count")));
    return g->bytes + json_integer_value(get(view, "byteOffset")) + json_integer_value(get(a, "byteOffset")) + 4 * width * i;
}

static int32_t integer(const json_t *object, const char *key) { return (int32_t)json_integer_value(get(object, key)); }

/* What an animation does to one node: the accessor of its values, -1 where it does nothing. */
static int32_t animated(const model *g, int32_t node, const char *path)
{
    const json_t *a = json_array_get(get(g->json, "animations"), 0), *channel;
    size_t i;
    json_array_foreach(get(a, "channels"), i, channel) {
        const json_t *target = get(channel, "target");
        if (integer(target, "node") != node || strcmp(json_string_value(get(target, "path")), path) != 0) continue;
        const json_t *s = json_array_get(get(a, "samplers"), (size_t)integer(channel, "sampler"));
        assert_string_equal(json_string_value(get(s, "interpolation")), "LINEAR");
        return integer(s, "output");
    }
    return -1;
}

static rg_vec3 turned(const double q[4], rg_vec3 v)
{
    const rg_vec3 u = {q[0], q[1], q[2]}, t = rg_vec3_axpy(q[3], v, rg_vec3_cross(u, v));
    return rg_vec3_axpy(2, rg_vec3_cross(u, t), v);
}

static json_t *primitive(const model *g, size_t mesh, size_t side)
{
    return json_array_get(get(json_array_get(get(g->json, "meshes"), mesh), "primitives"), side);
}

static void check_turning_facets(const model *g, const rg_motion *m)
{
    const rg_mesh *mesh = &m->mesh;
    assert_int_equal(json_array_size(get(g->json, "nodes")), mesh->nf + 1 + mesh->N);
    for (int32_t k = 0; k < FRAMES; k++) {
        rg_vec3 *x = centred(m, k);
        for (int32_t f = 0; f < mesh->nf; f++) {
            const int32_t turns = animated(g, f + 1, "rotation"), shifts = animated(g, f + 1, "translation");
            const int32_t position = integer(get(primitive(g, (size_t)f, 0), "attributes"), "POSITION");
            double q[4], before[4];
            for (int i = 0; i < 4; i++) {
                q[i] = f32(element(g, turns, (size_t)k) + 4 * i);
                before[i] = f32(element(g, turns, (size_t)(k ? k - 1 : 0)) + 4 * i);
            }
            assert_true(q[0] * before[0] + q[1] * before[1] + q[2] * before[2] + q[3] * before[3] >= 0);
            for (int32_t j = mesh->facet_start[f]; j < mesh->facet_start[f + 1]; j++) {
                const rg_vec3 local = f32_vector(element(g, position, (size_t)(j - mesh->facet_start[f])));
                const rg_vec3 there = rg_vec3_add(turned(q, local), f32_vector(element(g, shifts, (size_t)k)));
                below(distance(there, x[mesh->facet_vertex[j]]), 1e-6 * mesh->size);
            }
        }
        free(x);
    }
}

/* Both ends of a line are the crease's, told by the corners of the node's facet, or vertices of the whole sheet. */
static void check_line(const model *g, const rg_motion *m, const json_t *lines, size_t place, int32_t crease, int32_t facet)
{
    const rg_mesh *mesh = &m->mesh;
    const int32_t indices = integer(lines, "indices");
    static const char *const kind[] = {"mountain", "valley", "crease"};
    const char a = mesh->assignment[mesh->crease_edge[crease]];
    const json_t *material = json_array_get(get(g->json, "materials"), (size_t)integer(lines, "material"));
    assert_string_equal(json_string_value(get(material, "name")), kind[a == 'M' ? 0 : a == 'V' ? 1 : 2]);
    assert_int_equal(integer(lines, "mode"), 1);
    for (size_t end = 0; end < 2; end++) {
        const uint32_t i = u32(element(g, indices, 2 * place + end));
        assert_int_equal(facet < 0 ? (int32_t)i : mesh->facet_vertex[mesh->facet_start[facet] + (int32_t)i], mesh->edge[mesh->crease_edge[crease]][end]);
    }
}

/* Each crease once, by its name: below a facet that it belongs to, or in the one mesh. */
static void check_creases(const model *g, const rg_motion *m, int morphs)
{
    const rg_mesh *mesh = &m->mesh;
    char name[24];
    int32_t seen = 0;
    for (int32_t f = 0; f < (morphs ? 0 : mesh->nf); f++) {
        const json_t *children = json_object_get(json_array_get(get(g->json, "nodes"), (size_t)f + 1), "children"), *child;
        size_t c;
        json_array_foreach(children, c, child) {
            const json_t *node = json_array_get(get(g->json, "nodes"), (size_t)json_integer_value(child));
            const int32_t i = atoi(json_string_value(get(node, "name")) + 1), *side = mesh->edge_facet[mesh->crease_edge[i]];
            snprintf(name, sizeof name, "c%d_%c", (int)i, mesh->assignment[mesh->crease_edge[i]]);
            assert_string_equal(json_string_value(get(node, "name")), name);
            assert_true(side[0] == f || side[1] == f);
            const json_t *lines = primitive(g, (size_t)integer(node, "mesh"), 0), *facet = primitive(g, (size_t)f, 0);
            assert_int_equal(integer(get(lines, "attributes"), "POSITION"), integer(get(facet, "attributes"), "POSITION"));
            check_line(g, m, lines, 0, i, f);
            seen++;
        }
    }
    for (size_t k = 2; morphs && k < json_array_size(get(json_array_get(get(g->json, "meshes"), 0), "primitives")); k++) {
        const json_t *lines = primitive(g, 0, k), *text;
        size_t place;
        assert_true(json_equal(get(lines, "targets"), get(primitive(g, 0, 0), "targets")));
        json_array_foreach(get(get(lines, "extras"), "creases"), place, text) {
            check_line(g, m, lines, place, atoi(json_string_value(text) + 1), -1);
            seen++;
        }
    }
    assert_int_equal(seen, mesh->N);
}

static void check_morphs(const model *g, const rg_motion *m)
{
    const json_t *targets = get(primitive(g, 0, 0), "targets");
    const int32_t base = integer(get(primitive(g, 0, 0), "attributes"), "POSITION"), weights = animated(g, 0, "weights");
    const size_t n = json_array_size(targets);
    assert_int_equal(animated(g, 0, "rotation"), -1);
    for (int32_t k = 0; k < FRAMES; k++) {
        rg_vec3 *x = centred(m, k);
        for (int32_t v = 0; v < m->mesh.nv; v++) {
            rg_vec3 there = f32_vector(element(g, base, (size_t)v));
            for (size_t i = 0; i < n; i++) {
                const int32_t by = integer(json_array_get(targets, i), "POSITION");
                there = rg_vec3_axpy(f32(element(g, weights, (size_t)k * n + i)), f32_vector(element(g, by, (size_t)v)), there);
            }
            below(distance(there, x[v]), 1e-6 * m->mesh.size);
        }
        free(x);
    }
}

/* Both sides: as many triangles to the front as corners ask for, and the same ones turned over. */
static void check_sides(const model *g, const rg_motion *m, int morphs)
{
    int32_t triangles = 0;
    for (size_t f = 0; f < (morphs ? 1 : (size_t)m->mesh.nf); f++) {
        const json_t *front = primitive(g, f, 0), *back = primitive(g, f, 1);
        const int32_t n = integer(json_array_get(get(g->json, "accessors"), (size_t)integer(front, "indices")), "count");
        const int32_t position = integer(get(front, "attributes"), "POSITION");
        assert_int_not_equal(integer(front, "material"), integer(back, "material"));
        for (int32_t i = 0; i < n; i += 3) {
            uint32_t a[3], b[3];
            for (int k = 0; k < 3; k++) {
                a[k] = u32(element(g, integer(front, "indices"), (size_t)(i + k)));
                b[k] = u32(element(g, integer(back, "indices"), (size_t)(i + k)));
            }
            assert_true(a[0] == b[2] && a[1] == b[1] && a[2] == b[0]);
            if (morphs) continue;
            rg_vec3 x[3];
            for (int k = 0; k < 3; k++) x[k] = f32_vector(element(g, position, a[k]));
            assert_true(rg_vec3_cross(rg_vec3_sub(x[1], x[0]), rg_vec3_sub(x[2], x[0])).z > 0);
            near(f32_vector(element(g, integer(get(front, "attributes"), "NORMAL"), a[0])).z, 1, 0);
            near(f32_vector(element(g, integer(get(back, "attributes"), "NORMAL"), a[0])).z, -1, 0);
        }
        triangles += n / 3;
    }
    assert_int_equal(triangles, m->mesh.facet_start[m->mesh.nf] - 2 * m->mesh.nf);
}

static model read_glb(const char *name)
{
    size_t n;
    char *file = written_read(name, &n);
    assert_memory_equal(file, "glTF", 4);
    assert_int_equal(u32(file + 4), 2);
    assert_int_equal(u32(file + 8), n);
    const size_t json = u32(file + 12), buffer = u32(file + 20 + json);
    assert_memory_equal(file + 16, "JSON", 4);
    assert_memory_equal(file + 24 + json, "BIN", 4);
    assert_int_equal(json % 4, 0);
    assert_int_equal(buffer % 4, 0);
    assert_int_equal(n, 28 + json + buffer);
    model g = {parse(file + 20, json), calloc(buffer, 1)};
    assert_non_null(g.bytes);
    memcpy(g.bytes, file + 28 + json, buffer);
    assert_int_equal(integer(json_array_get(get(g.json, "buffers"), 0), "byteLength"), buffer);
    free(file);
    return g;
}

static size_t decode(const char *text, char *bytes)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t n = 0;
    unsigned bits = 0, held = 0;
    for (; *text && *text != '='; text++) {
        bits = bits << 6 | (unsigned)(strchr(digit, *text) - digit);
        held += 6;
        if (held >= 8) bytes[n++] = (char)(bits >> (held -= 8) & 255);
    }
    return n;
}

static void check_gltf(int adjusted)
{
    rg_motion *m = sample(adjusted);
    rg_picture picture = rg_picture_default();
    char path[300];
    picture.fps = 12.5;
    assert_int_equal(rg_motion_write(m, written_path("x.glb", path), &picture, NULL), RG_OK);
    assert_int_equal(rg_motion_write(m, written_path("x.gltf", path), &picture, NULL), RG_OK);
    model g = read_glb("x.glb");
    const json_t *fold = json_array_get(get(g.json, "animations"), 0);
    const int32_t times = integer(json_array_get(get(fold, "samplers"), 0), "input");
    for (size_t k = 0; k < FRAMES; k++) near(f32(element(&g, times, k)), (double)k / 12.5, 1e-7);
    if (adjusted) check_morphs(&g, m);
    else check_turning_facets(&g, m);
    check_sides(&g, m, adjusted);
    check_creases(&g, m, adjusted);
    const int32_t size = integer(json_array_get(get(g.json, "buffers"), 0), "byteLength");
    json_t *text = read_json("x.gltf");
    const char *uri = json_string_value(get(json_array_get(get(text, "buffers"), 0), "uri")), *comma = strchr(uri, ',');
    char *bytes = calloc(strlen(uri), 1);
    assert_true(comma && bytes && strncmp(uri, "data:", 5) == 0);
    assert_int_equal(decode(comma + 1, bytes), size);
    assert_memory_equal(bytes, g.bytes, (size_t)size);
    free(bytes);
    json_decref(text);
    json_decref(g.json);
    free(g.bytes);
    rg_motion_destroy(m);
}

static void gltf_turns_facets(void **state)
{
    (void)state;
    check_gltf(0);
}

/* The front has the picture's file for a texture, each corner its place in the pattern's box, the picture's top at +y; the back has none.
 * What is no picture is named, and nothing is written. */
static void check_print(int adjusted)
{
    rg_motion *m = sample(adjusted);
    const rg_mesh *mesh = &m->mesh;
    static const unsigned char rgb[12] = {200, 10, 10, 10, 200, 10, 10, 10, 200, 90, 90, 90};
    char path[300], image[300];
    rg_picture p = rg_picture_default();
    rg_diag why = {0, ""};
    FILE *f = fopen(written_path("print.png", image), "wb");
    assert_non_null(f);
    assert_int_equal(rg_png_write(f, 2, 2, rgb, NULL, NULL), RG_OK);
    fclose(f);
    p.image = image;
    if (rg_motion_write(m, written_path("x.glb", path), &p, &why) != RG_OK) fail_msg("%s", why.text);
    model g = read_glb("x.glb");
    size_t size;
    char *file = written_read("print.png", &size);
    const json_t *view = json_array_get(get(g.json, "bufferViews"), (size_t)integer(json_array_get(get(g.json, "images"), 0), "bufferView"));
    assert_int_equal(integer(view, "byteLength"), size);
    assert_memory_equal(g.bytes + integer(view, "byteOffset"), file, size);
    rg_vec2 low = mesh->X[0], high = mesh->X[0];
    for (int32_t v = 1; v < mesh->nv; v++) {
        low = (rg_vec2){fmin(low.x, mesh->X[v].x), fmin(low.y, mesh->X[v].y)};
        high = (rg_vec2){fmax(high.x, mesh->X[v].x), fmax(high.y, mesh->X[v].y)};
    }
    for (int32_t i = 0; i < (adjusted ? 1 : mesh->nf); i++) {
        const json_t *both = get(json_array_get(get(g.json, "meshes"), (size_t)i), "primitives");
        const int32_t print = integer(get(json_array_get(both, 0), "attributes"), "TEXCOORD_0");
        assert_null(json_object_get(get(json_array_get(both, 1), "attributes"), "TEXCOORD_0"));
        const int32_t from = adjusted ? 0 : mesh->facet_start[i], n = adjusted ? mesh->nv : mesh->facet_start[i + 1] - from;
        for (int32_t k = 0; k < n; k++) {
            const rg_vec2 x = mesh->X[adjusted ? k : mesh->facet_vertex[from + k]];
            const char *at = element(&g, print, (size_t)k);
            near(low.x + f32(at) * (high.x - low.x), x.x, 1e-6 * mesh->size);
            near(high.y - f32(at + 4) * (high.y - low.y), x.y, 1e-6 * mesh->size);
        }
    }
    p.image = "patterns/bird.opx";
    assert_int_equal(rg_motion_write(m, written_path("none.glb", path), &p, &why), RG_EREAD);
    assert_non_null(strstr(why.text, "patterns/bird.opx"));
    assert_int_not_equal(access(path, F_OK), 0);
    free(file);
    json_decref(g.json);
    free(g.bytes);
    rg_motion_destroy(m);
}

static void gltf_has_what_is_printed(void **state)
{
    (void)state;
    check_print(0);
    check_print(1);
}

static void gltf_morphs_an_adjusted_sheet(void **state)
{
    (void)state;
    check_gltf(1);
}

/* -------------------------------------------------------------------------------------------- SVG, page ---- */

static int32_t occurrences(const char *text, const char *end, const char *what)
{
    int32_t n = 0;
    for (const char *s = text; (s = strstr(s, what)) && s < end; s++) n++;
    return n;
}

/* In the group of that id. */
static int32_t in_group(const char *text, const char *id, const char *what)
{
    char open[40];
    snprintf(open, sizeof open, "<g id=\"%s\"", id);
    const char *from = strstr(text, open), *end = from ? strstr(from, "</g>") : NULL;
    if (!end) fail_msg("there is no group %s", id);
    return occurrences(from, end, what);
}

/* Two creases that cross at right angles, three of them mountains: the simplest closed vertex. */
static void svg_marks_what_locks(void **state)
{
    (void)state;
    rg_lines l = drawing();
    draw_box(&l, 0, 0, 2.5, 2.385);
    draw(&l, RG_MOUNTAIN, 0, 1.1, 1.2, 1.1);
    draw(&l, RG_MOUNTAIN, 1.2, 1.1, 2.5, 1.1);
    draw(&l, RG_MOUNTAIN, 1.2, 0, 1.2, 1.1);
    draw(&l, RG_VALLEY, 1.2, 1.1, 1.2, 2.385);
    rg_motion *m = motion_by(&l, 2, all_alike, NULL);
    int32_t centre = 0;
    while (hypot(m->mesh.X[centre].x - 1.2, m->mesh.X[centre].y - 1.1) > 1e-9) centre++;
    assert_int_equal(m->report.pattern->closed_vertices, 1);
    m->report.blocking_vertices = &centre;
    m->report.blocking_vertex_count = 1;
    m->title = rg_mem_string(&m->mem, "a < b & c");
    snprintf(m->report.reason, sizeof m->report.reason, "locked <here>");
    write_as(m, "x.svg");
    char *text = written_read("x.svg", NULL);
    assert_int_equal(in_group(text, "mountain", "<line"), 3);
    assert_int_equal(in_group(text, "valley", "<line"), 1);
    assert_int_equal(in_group(text, "border", "<line"), 8);
    assert_int_equal(in_group(text, "flat", "<line"), 0);
    assert_int_equal(in_group(text, "closed", "cx=\"1.2\" cy=\"-1.1\""), 1);
    assert_int_equal(in_group(text, "closed", "<circle"), 1);
    assert_int_equal(in_group(text, "blocking", "cx=\"1.2\" cy=\"-1.1\""), 1);
    assert_int_equal(in_group(text, "valley", "y2=\"-2.385\"") + in_group(text, "valley", "y1=\"-2.385\""), 1);
    assert_non_null(strstr(text, "<title>a &lt; b &amp; c</title>"));
    assert_non_null(strstr(text, "locked &lt;here&gt;"));
    free(text);
    rg_motion_destroy(m);
}

static void svg_draws_what_was_added_and_moved(void **state)
{
    (void)state;
    rg_motion *m = cut_in_two();
    write_as(m, "x.svg");
    char *text = written_read("x.svg", NULL);
    assert_int_equal(in_group(text, "flat", "<line"), 3);
    free(text);
    rg_motion_destroy(m);
    m = sample(1);
    write_as(m, "x.svg");
    text = written_read("x.svg", NULL);
    double most = 0, x;
    for (const char *s = text; (s = strstr(s, " x2=\"")); s++) {
        assert_int_equal(sscanf(s, " x2=\"%lf", &x), 1);
        most = fmax(most, x);
    }
    near(most, 1.05 * (3 * 1.25 + 2.385 * cos(ALPHA)), 1e-9); /* frame 3 of 7 is the largest */
    free(text);
    rg_motion_destroy(m);
}

static json_t *page_data(const char *text)
{
    const char *from = strstr(text, "id=\"data\">"), *end = from ? strstr(from, "</script>") : NULL;
    assert_non_null(end);
    from += strlen("id=\"data\">");
    return parse(from, (size_t)(end - from));
}

/* Points as the page has them are the frame's, turned and moved as one: distances are the same, and so is the sense of three of them as
 * seen from a fourth. */
static void check_congruent(const char *points, const rg_vec3 *x, int32_t nv, double size)
{
    for (int32_t v = 0; v < nv; v++)
        for (int32_t u = 0; u < v; u++)
            near(distance(f32_vector(points + 12 * u), f32_vector(points + 12 * v)), rg_vec3_length(rg_vec3_sub(x[u], x[v])), 2e-6 * size);
    for (int32_t v = 3; v < nv; v++) {
        const rg_vec3 o = f32_vector(points), a = rg_vec3_sub(f32_vector(points + 12 * (v - 2)), o),
                      b = rg_vec3_sub(f32_vector(points + 12 * (v - 1)), o), c = rg_vec3_sub(f32_vector(points + 12 * v), o);
        const rg_vec3 A = rg_vec3_sub(x[v - 2], x[0]), B = rg_vec3_sub(x[v - 1], x[0]), C = rg_vec3_sub(x[v], x[0]);
        near(rg_vec3_dot(a, rg_vec3_cross(b, c)), rg_vec3_dot(A, rg_vec3_cross(B, C)), 1e-5 * size * size * size);
    }
}

static void check_page(int adjusted)
{
    rg_motion *m = sample(adjusted);
    const rg_mesh *mesh = &m->mesh;
    m->report.outcome = RG_STOPPED;
    m->report.folded_percent = 71.25;
    strcpy(m->report.reason, "the wing holds </script>; and more");
    m->report.contact = adjusted ? RG_CONTACT_CROSSES : RG_CONTACT_FREE;
    m->report.first_contact_percent = adjusted ? 33.5 : NAN;
    write_as(m, "x.html");
    char *text = written_read("x.html", NULL), *end = text + strlen(text);
    /* Nothing is fetched, and no text can end the script that it stands in. */
    assert_int_equal(occurrences(text, end, "http:") + occurrences(text, end, "https:") + occurrences(text, end, "src="), 0);
    assert_int_equal(occurrences(text, end, "</script"), 2);
    assert_int_equal(occurrences(text, end, "@DATA@"), 0);
    json_t *j = page_data(text), *frames = get(j, "frames");
    char *points = calloc(1, 12 * (size_t)mesh->nv), *flat = calloc(1, 8 * (size_t)mesh->nv);
    assert_int_equal(json_array_size(frames), FRAMES);
    assert_int_equal(json_array_size(get(j, "corners")), mesh->nf);
    assert_int_equal(json_array_size(get(j, "edge")), mesh->facet_start[mesh->nf]);
    assert_int_equal(json_array_size(get(j, "ends")), 2 * mesh->ne);
    assert_int_equal(strlen(json_string_value(get(j, "assignment"))), mesh->ne);
    assert_memory_equal(json_string_value(get(j, "assignment")), mesh->assignment, (size_t)mesh->ne);
    assert_int_equal(json_array_size(get(j, "triangles")), 3 * (mesh->facet_start[mesh->nf] - 2 * mesh->nf));
    assert_int_equal(json_is_true(get(j, "rigid")), !adjusted);
    assert_string_equal(json_string_value(get(j, "told")),
                        adjusted ? "Stopped short at 71.2 %: the wing holds </script>. It passes through itself from 33.5 % on. "
                                 : "Stopped short at 71.2 %: the wing holds </script>. ");
    if (adjusted) near(json_number_value(get(j, "crosses")), 33.5, 0);
    else assert_true(json_is_null(get(j, "crosses")));
    assert_int_equal(decode(json_string_value(get(j, "pattern")), flat), 8 * mesh->nv);
    for (int32_t v = 0; v < mesh->nv; v++) {
        near(f32(flat + 8 * v) - f32(flat), mesh->X[v].x - mesh->X[0].x, 1e-6 * mesh->size); /* about some middle */
        near(f32(flat + 8 * v + 4) - f32(flat + 4), mesh->X[v].y - mesh->X[0].y, 1e-6 * mesh->size);
    }
    for (int32_t i = 0; i < mesh->facet_start[mesh->nf]; i++) {
        assert_int_equal(json_integer_value(json_array_get(get(j, "vertex"), (size_t)i)), mesh->facet_vertex[i]);
        assert_int_equal(json_integer_value(json_array_get(get(j, "edge"), (size_t)i)), mesh->facet_edge[i]);
    }
    rg_vec3 *x = calloc((size_t)mesh->nv, sizeof *x);
    assert_true(points && flat && x);
    for (int32_t k = 0; k < FRAMES; k++) {
        const json_t *frame = json_array_get(frames, (size_t)k);
        near(json_number_value(get(frame, "percent")), m->frame[k].percent, 0);
        assert_int_equal(decode(json_string_value(get(frame, "points")), points), 12 * mesh->nv);
        assert_int_equal(rg_motion_place(m, k, x), RG_OK);
        check_congruent(points, x, mesh->nv, mesh->size);
        if (!adjusted) continue; /* else the pattern of the moment is there too */
        assert_int_equal(decode(json_string_value(get(frame, "flat")), flat), 8 * mesh->nv);
        for (int32_t v = 0; v < mesh->nv; v++) near(f32(flat + 8 * v) - f32(flat), rg_motion_pattern(m, k)[v].x - rg_motion_pattern(m, k)[0].x, 1e-6 * mesh->size);
    }
    free(x);
    free(points);
    free(flat);
    json_decref(j);
    free(text);
    rg_motion_destroy(m);
}

static void page_poses_facets(void **state)
{
    (void)state;
    check_page(0);
    check_page(1);
}

/* ------------------------------------------------------------------------------------- paths and failures ---- */

static const char *const FORMS[] = {"x.csv", "x.fold", "x.obj", "x.stl", "x.svg", "x.glb", "x.gltf", "x.html", "x.dxf"};
enum { FORM_COUNT = sizeof FORMS / sizeof *FORMS };

static void paths_are_checked(void **state)
{
    (void)state;
    static const char *const good[] = {"x.OBJ", "a.b/x.fold", "x%.csv", "x-%d.obj", "x-%04d.stl", "a%d/x.html"};
    static const char *const bad[] = {"x.foo", "x", "-", ".obj", "x.obj.bak", "x-%d.csv", "x-%d-%d.obj", "a.obj/x", ""};
    rg_motion *m = cut_in_two();
    char path[300];
    rg_diag why;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) assert_int_equal(rg_output_check(good[i], NULL), RG_OK);
    for (int i = 0; i < FORM_COUNT; i++) assert_int_equal(rg_output_check(FORMS[i], NULL), RG_OK);
    written_files(1);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        why.text[0] = 0;
        assert_int_equal(rg_output_check(bad[i], &why), RG_EARG);
        assert_true(strlen(why.text) > 10);
        if (*bad[i]) assert_int_equal(rg_motion_write(m, written_path(bad[i], path), NULL, NULL), RG_EARG);
    }
    assert_int_equal(written_files(0), 0);
    assert_int_equal(rg_output_check("x.foo", &why), RG_EARG);
    for (int i = 0; i < FORM_COUNT; i++) assert_non_null(strstr(why.text, FORMS[i] + 1));
    assert_non_null(strstr(why.text, "x.foo"));
    rg_picture picture = rg_picture_default();
    picture.fps = NAN;
    assert_int_equal(rg_motion_write(m, written_path("x.glb", path), &picture, NULL), RG_EARG);
    assert_int_equal(written_files(0), 0);
    assert_int_equal(rg_motion_write(m, written_path("none/x.fold", path), NULL, &why), RG_EWRITE);
    assert_non_null(strstr(why.text, "none/x.fold"));
    rg_motion_destroy(m);
}

/* The disk is full after some bytes: what was there stays, and nothing else is left. */
static void good_files_survive(void **state)
{
    (void)state;
    struct rlimit was, limit;
    char path[300];
    rg_motion *m = sample(0);
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &was), 0);
    for (int i = 0; i < FORM_COUNT; i++) {
        rg_diag why = {0, ""};
        written_files(1);
        FILE *f = fopen(written_path(FORMS[i], path), "w");
        assert_non_null(f);
        fputs("as before", f);
        fclose(f);
        limit = was;
        limit.rlim_cur = 200;
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        const rg_status s = rg_motion_write(m, path, NULL, &why);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &was), 0);
        assert_int_equal(s, RG_EWRITE);
        assert_non_null(strstr(why.text, FORMS[i]));
        char *text = written_read(FORMS[i], NULL);
        assert_string_equal(text, "as before");
        assert_int_equal(written_files(0), 1);
        free(text);
    }
    signal(SIGXFSZ, SIG_DFL);
    rg_motion_destroy(m);
}

static void memory_may_fail_anywhere(void **state)
{
    (void)state;
    rg_motion *m = sample(0);
    const rg_memory usual = m->mem;
    char path[300];
    for (int i = 0; i < FORM_COUNT; i++) {
        rg_status s = RG_ENOMEM;
        counted c = {0, 0, 0};
        const rg_memory mem = {counted_resize, &c};
        for (long k = 0; s != RG_OK; k++) {
            rg_diag why = {0, ""};
            written_files(1);
            c = (counted){k, 0, 0};
            m->mem = m->mesh.mem = mem;
            s = rg_motion_write(m, written_path(FORMS[i], path), NULL, &why);
            m->mem = m->mesh.mem = usual;
            assert_int_equal(c.out, 0);
            assert_true(s == RG_OK || s == RG_ENOMEM);
            assert_int_equal(written_files(0), s == RG_OK);
            if (s != RG_OK) assert_non_null(strstr(why.text, "memory"));
        }
        assert_true(c.asked > 0);
    }
    rg_motion_destroy(m);
}

/* The same motion gives the same bytes. */
static void bytes_are_repeated(void **state)
{
    (void)state;
    rg_motion *m = sample(1);
    for (int i = 0; i < FORM_COUNT; i++) {
        size_t n, again;
        write_as(m, FORMS[i]);
        char *first = written_read(FORMS[i], &n);
        write_as(m, FORMS[i]);
        char *second = written_read(FORMS[i], &again);
        assert_int_equal(n, again);
        assert_memory_equal(first, second, n);
        free(first);
        free(second);
    }
    rg_motion_destroy(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fold_keeps_lengths_and_angles), cmocka_unit_test(fold_shows_the_adjusted_pattern),
        cmocka_unit_test(fold_has_added_creases),        cmocka_unit_test(csv_is_a_table),
        cmocka_unit_test(obj_is_one_frame_or_each),      cmocka_unit_test(stl_with_a_thickness_is_a_solid), cmocka_unit_test(stl_has_the_area_of_the_sheet),
        cmocka_unit_test(gltf_turns_facets),             cmocka_unit_test(gltf_morphs_an_adjusted_sheet),
        cmocka_unit_test(svg_marks_what_locks),          cmocka_unit_test(svg_draws_what_was_added_and_moved),
        cmocka_unit_test(gltf_has_what_is_printed),
        cmocka_unit_test(page_poses_facets),             cmocka_unit_test(paths_are_checked),
        cmocka_unit_test(good_files_survive),            cmocka_unit_test(memory_may_fail_anywhere),
        cmocka_unit_test(bytes_are_repeated)};
    return cmocka_run_group_tests(tests, written_begin, written_end);
}
