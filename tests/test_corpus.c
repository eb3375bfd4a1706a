/* Counts of real patterns against those of another program, by other authors' drawings. */
#include "corpus.h"
#include "pattern/pattern.h"

enum { COLUMNS = 64 };

typedef struct row { char text[4096]; char *cell[COLUMNS]; int cells; } row;

static int next_row(FILE *f, row *r)
{
    if (!fgets(r->text, sizeof r->text, f)) return 0;
    r->cells = 0;
    for (char *c = r->text; c && r->cells < COLUMNS; r->cells++) {
        r->cell[r->cells] = c;
        c = strpbrk(c, "\t\n");
        if (c) *c++ = 0;
    }
    return 1;
}

static const char *cell(const row *head, const row *r, const char *name)
{
    for (int i = 0; i < head->cells && i < r->cells; i++)
        if (strcmp(head->cell[i], name) == 0) return r->cell[i];
    fail_msg("stats.tsv has no column %s", name);
    return "";
}

static int differ(const char *file, const char *what, double ours, double theirs, double tol)
{
    if (fabs(ours - theirs) <= tol) return 0;
    print_error("%s: %s is %.9g, not %.9g\n", file, what, ours, theirs);
    return 1;
}

static void counts_agree(void **state)
{
    (void)state;
    char path[4096];
    row head, r;
    FILE *f = fopen(corpus("stats.tsv", path, sizeof path), "r");
    int files = 0, bad = 0;
    assert_true(next_row(f, &head));
    while (next_row(f, &r)) {
        if (strncmp(r.cell[0], "malformed/", 10) == 0) continue;
        rg_reading s = rg_reading_default();
        rg_pattern *p = NULL;
        rg_pattern_info info;
        rg_diag why = {0, ""};
        files++;
        rg_status status = rg_pattern_read(corpus(r.cell[0], path, sizeof path), &s, &p, &why);
        if (status != RG_OK) {
            print_error("%s:%d: %s\n", r.cell[0], why.line, why.text);
            bad++;
            continue;
        }
        info = *rg_pattern_get_info(p);
        /* A line that ends in the middle of a facet is no crease of a rigid sheet and is left out, with its end; the other
         * program counts both. */
        const double loose = atof(cell(&head, &r, "dangling"));
        struct { const char *name; double ours, less; } counts[] = {
            {"V", info.vertices, loose}, {"E", info.edges, loose}, {"F", info.facets, 0}, {"M", info.interior_vertices, loose},
            {"N", info.creases, loose}, {"N0", info.boundary_edges, 0}, {"closed", info.closed_vertices, 0},
            {"triples", ((struct rg_pattern *)p)->closed_triples, 0}};
        for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
            bad += differ(r.cell[0], counts[i].name, counts[i].ours, atof(cell(&head, &r, counts[i].name)) - counts[i].less, 0);
        /* Where ends that do not meet are merged, the vertex may lie anywhere between them. */
        const double play = 2 * info.merged_max / info.kept_min / RG_DEG, kaw = atof(cell(&head, &r, "kaw"));
        bad += differ(r.cell[0], "kaw", info.kawasaki_max_deg, kaw, 1e-5 * kaw + 1e-10 + play);
        bad += differ(r.cell[0], "size", info.size, atof(cell(&head, &r, "size")), 1e-5 * info.size);
        bad += differ(r.cell[0], "nearest", info.kept_min, atof(cell(&head, &r, "nearest")), 1e-4 * info.kept_min);
        /* Creases that are not assigned may turn out either way, so that a vertex with one breaks no theorem here; the
         * other program goes by those that are assigned. */
        const double unassigned = atof(cell(&head, &r, "eU"));
        bad += differ(r.cell[0], "maebad", info.maekawa_violations, atof(cell(&head, &r, "maebad")) - loose, unassigned > 0 ? 2 : 0);
        if (loose == 0 && info.creases + info.boundary_edges == info.edges) { /* nothing was left out or dissolved */
            bad += differ(r.cell[0], "mountains", info.mountains, atof(cell(&head, &r, "eM")), 0);
            bad += differ(r.cell[0], "valleys", info.valleys, atof(cell(&head, &r, "eV")), 0);
            bad += differ(r.cell[0], "unassigned", info.unassigned, unassigned, 0);
        }
        if (loose == 0) bad += differ(r.cell[0], "disk", info.is_disk, atof(cell(&head, &r, "disk")), 0);
        if (!info.is_disk) print_message("%s: %s\n", r.cell[0], info.not_disk);
        rg_pattern_destroy(p);
    }
    fclose(f);
    assert_int_equal(files, 46);
    assert_int_equal(bad, 0);
}

/* The table of that folder's README.md: | file | path | M | N | N after triangulation |. */
static void foldability_agrees(void **state)
{
    (void)state;
    char path[4096], text[1024];
    FILE *f = fopen(corpus("foldability/README.md", path, sizeof path), "r");
    int files = 0, bad = 0;
    assert_non_null(f);
    while (fgets(text, sizeof text, f)) {
        char name[200], at[300];
        int M, N;
        if (sscanf(text, "| %199s | %*[^|]| %d | %d |", name, &M, &N) != 3) continue;
        rg_reading s = rg_reading_default();
        rg_pattern *p = NULL;
        rg_pattern_info info;
        rg_diag why = {0, ""};
        files++;
        snprintf(at, sizeof at, "foldability/%s", name);
        if (rg_pattern_read(corpus(at, path, sizeof path), &s, &p, &why) != RG_OK) {
            print_error("%s: %s\n", name, why.text);
            bad++;
            continue;
        }
        info = *rg_pattern_get_info(p);
        /* The table counts vertices that only break a straight line, which are dissolved here: as many of M as of N. */
        const int32_t dissolved = info.edges - info.creases - info.boundary_edges;
        bad += differ(name, "M", info.interior_vertices, M, dissolved) + differ(name, "N - M", info.creases - info.interior_vertices, N - M, 0);
        bad += differ(name, "disk", info.is_disk, 1, 0) + differ(name, "unassigned", info.unassigned + info.flat, 0, 0);
        bad += differ(name, "maekawa", info.maekawa_violations, 0, 0) + differ(name, "kawasaki", info.kawasaki_max_deg, 0, 0.6);
        rg_pattern_destroy(p);
    }
    fclose(f);
    assert_int_equal(files, 59);
    assert_int_equal(bad, 0);
}

/* Each is refused with its place, or read where its page says that a good reader can. */
static void malformed_files(void **state)
{
    (void)state;
    static const struct { const char *name; int line; const char *words; int V, E, F, disk; } files[] = {
        {"heavy_test.opx", 0, "empty", 0, 0, 0, 0},
        {"corrupted.ori", 1, "\"unknown\" is not known", 0, 0, 0, 0},
        {"junk.cp", 1, "Lorem", 0, 0, 0, 0},
        {"invalid-mismatch-length.fold", 5, "edges_assignment: 5 of them for 4 edges", 0, 0, 0, 0},
        {"invalid-mismatch-references.fold", 7, "faces_vertices[1][1]: there is no vertex 4", 0, 0, 0, 0},
        {"invalid-key-names.fold", 1, "vertices_coords", 0, 0, 0, 0},
        {"bad-edges.fold", 8, "edges_assignment: 9 of them for 10 edges", 0, 0, 0, 0},
        {"faceless.cp", 0, NULL, 0, 0, 0, 0}, /* all of it is loose ends, which are left out */
        {"glitch.cp", 0, NULL, 50, 117, 68, 1},
        {"bowtie.fold", 0, NULL, 5, 6, 2, 0},
        {"disjoint-cps.fold", 0, NULL, 0, 0, 0, 0}, /* the same */
        {"isolated-line-in-face.fold", 0, NULL, 4, 4, 1, 1}, /* and here two vertices and an edge are */
        {"overlapping-assignments.fold", 0, NULL, 18, 21, 4, 0}, /* and here too */
        {"non-planar-bird-base.fold", 0, NULL, 35, 78, 44, 1}};
    int bad = 0;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[4096], at[200];
        rg_reading s = rg_reading_default();
        rg_pattern *p = NULL;
        rg_pattern_info info = {0};
        rg_diag why = {0, ""};
        snprintf(at, sizeof at, "malformed/%s", files[i].name);
        const rg_status status = rg_pattern_read(corpus(at, path, sizeof path), &s, &p, &why);
        if (files[i].words) {
            if (status == RG_EFORMAT && why.line == files[i].line && strstr(why.text, files[i].words)) continue;
            print_error("%s: %d, line %d: %s\n", files[i].name, (int)status, why.line, why.text);
            bad++;
        } else if (status != RG_OK) {
            print_error("%s:%d: %s\n", files[i].name, why.line, why.text);
            bad++;
        } else {
            info = *rg_pattern_get_info(p);
            bad += differ(files[i].name, "V", info.vertices, files[i].V, 0) + differ(files[i].name, "E", info.edges, files[i].E, 0);
            bad += differ(files[i].name, "F", info.facets, files[i].F, 0) + differ(files[i].name, "disk", info.is_disk, files[i].disk, 0);
        }
        rg_pattern_destroy(p);
    }
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(counts_agree), cmocka_unit_test(foldability_agrees),
                                       cmocka_unit_test(malformed_files)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
