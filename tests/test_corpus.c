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
        if (strncmp(r.cell[0], "opx/", 4) != 0) continue;
        rg_settings s = rg_settings_default();
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
        rg_pattern_get_info(p, &info);
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
        bad += differ(r.cell[0], "size", info.size, atof(cell(&head, &r, "size")), 1e-3);
        bad += differ(r.cell[0], "nearest", info.kept_min, atof(cell(&head, &r, "nearest")), 1e-4 * info.kept_min);
        bad += differ(r.cell[0], "maebad", info.maekawa_violations, atof(cell(&head, &r, "maebad")) - loose, 0);
        if (loose == 0) bad += differ(r.cell[0], "disk", info.is_disk, atof(cell(&head, &r, "disk")), 0);
        if (!info.is_disk) print_message("%s: %s\n", r.cell[0], info.not_disk);
        rg_pattern_destroy(p);
    }
    fclose(f);
    assert_int_equal(files, 23);
    assert_int_equal(bad, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(counts_agree)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
