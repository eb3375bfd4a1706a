/* What is known of a pattern before it is folded, as JSON and for people. */
#include "base/file.h"
#include "layers/layers.h"
#include "pattern/alike.h"
#include "pattern/pattern.h"
#include "write/report.h"

#include <string.h>

static const char *theorem_name(rg_theorem t)
{
    switch (t) {
    case RG_KAWASAKI: return "Kawasaki";
    case RG_MAEKAWA: return "Maekawa";
    case RG_DEGREE: return "even degree";
    case RG_BIG_LITTLE_BIG: return "big-little-big";
    case RG_TARGETS: return "targets";
    }
    return "";
}

/* Creases that cutting every facet of a disk into triangles adds: N - 3M is N0 - 3 afterwards. */
static int32_t triangulating_adds(const rg_pattern_info *i)
{
    return 3 * i->interior_vertices + i->boundary_edges - 3 - i->creases;
}

/* Vertices, not entries: one may break more than one theorem. */
static int32_t unfoldable_vertices(const rg_pattern *p)
{
    int32_t n = 0;
    for (int32_t k = 0; k < p->unfoldables; k++) n += k == 0 || p->unfoldable[k].vertex != p->unfoldable[k - 1].vertex;
    return n;
}

/* ------------------------------------------------------------------------------------------------- JSON ---- */

static void point(rg_json *j, const char *key, double x, double y) { rg_json_numbers(j, key, (const double[]){x, y}, 2); }

static void closed(rg_json *j, const rg_closed *c)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "vertex", c->vertex);
    point(j, "coordinates", c->x, c->y);
    rg_json_open(j, "creases", '[');
    point(j, NULL, c->a[0], c->a[1]);
    point(j, NULL, c->c[0], c->c[1]);
    point(j, NULL, c->b[0], c->b[1]);
    rg_json_close(j);
    rg_json_number(j, "inside_angle_deg", c->inside_angle / RG_DEG);
    rg_json_close(j);
}

static void unfoldable(rg_json *j, const rg_unfoldable *u)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "vertex", u->vertex);
    point(j, "coordinates", u->x, u->y);
    rg_json_string(j, "theorem", theorem_name(u->theorem));
    rg_json_number(j, "by", u->by);
    rg_json_string(j, "unit", u->theorem == RG_MAEKAWA || u->theorem == RG_DEGREE ? "creases" : "degrees");
    rg_json_close(j);
}

static void warning(rg_json *j, const rg_diag *w)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "line", w->line);
    rg_json_string(j, "text", w->text);
    rg_json_close(j);
}

static int32_t listed(const rg_likeness *l) { return l->mirrors < RG_MOST_MIRRORS ? l->mirrors : RG_MOST_MIRRORS; }

static void symmetry(rg_json *j, const rg_alike *a)
{
    rg_json_open_line(j, "symmetry", '{');
    rg_json_integer(j, "turns", a->same.turns);
    rg_json_numbers(j, "mirrors_deg", a->same.mirror, listed(&a->same));
    rg_json_integer(j, "mirrors", a->same.mirrors);
    rg_json_integer(j, "exchanging_turns", a->exchanged.turns);
    rg_json_numbers(j, "exchanging_mirrors_deg", a->exchanged.mirror, listed(&a->exchanged));
    rg_json_integer(j, "exchanging_mirrors", a->exchanged.mirrors);
    rg_json_close(j);
}

static const char *state_name(rg_layers_state s)
{
    switch (s) {
    case RG_LAYERS_VALID: return "valid";
    case RG_LAYERS_NONE: return "none";
    case RG_LAYERS_UNSOLVED: return "unsolved";
    case RG_LAYERS_NOT_FLAT: return "not flat";
    }
    return "";
}

/* NULL: no sheet that could be folded. */
static rg_status find_layers(const rg_pattern *p, rg_layers **l, rg_diag *why)
{
    rg_settings s = rg_settings_default();
    s.memory = &p->mem;
    *l = NULL;
    return p->info.is_disk ? rg_layers_create(p, &s, l, why) : RG_OK;
}

static void layers(rg_json *j, const rg_layers *l)
{
    rg_layers_info i;
    if (!l) return;
    rg_layers_get_info(l, &i);
    rg_json_string(j, "layers", state_name(i.state));
    rg_json_string(j, "layer_orders", i.state == RG_LAYERS_VALID ? i.count : NULL);
    rg_json_open_line(j, "layer_orders_by_part", '[');
    for (int32_t k = 0; k < i.parts; k++) rg_json_number(j, NULL, (double)rg_layers_part(l, k));
    rg_json_close(j);
    rg_json_integer(j, "layer_pairs", i.pairs);
    rg_json_string(j, "layers_rule", i.state == RG_LAYERS_NONE ? i.rule : NULL);
    rg_json_string(j, "layers_reason", i.state == RG_LAYERS_VALID ? NULL : i.reason);
    rg_json_open(j, "layers_where", '[');
    for (int32_t k = 0; k < i.where_count; k++) {
        rg_json_open_line(j, NULL, '{');
        rg_json_integer(j, "facet", i.where[k]);
        point(j, "coordinates", i.where_at[k][0], i.where_at[k][1]);
        rg_json_close(j);
    }
    rg_json_close(j);
}

rg_status rg_info_write(const rg_pattern *p, const char *file, rg_diag *why)
{
    rg_json j;
    rg_file out;
    rg_alike alike;
    rg_layers *l = NULL;
    rg_status s = rg_alike_find(p, &alike);
    if (s == RG_OK) s = find_layers(p, &l, why);
    if (s == RG_OK) s = rg_file_begin(&out, &p->mem, file, why);
    if (s != RG_OK) {
        rg_layers_destroy(l);
        return s;
    }
    rg_json_begin(&j, out.stream);
    rg_json_open(&j, NULL, '{');
    rg_json_string(&j, "rigami", RG_VERSION);
    rg_report_pattern(&j, &p->info);
    if (p->info.is_disk) rg_json_integer(&j, "triangulating_adds", triangulating_adds(&p->info));
    symmetry(&j, &alike);
    layers(&j, l);
    rg_layers_destroy(l);
    rg_json_open(&j, "closed", '[');
    for (int32_t k = 0; k < p->closed_triples; k++) closed(&j, &p->closed[k]);
    rg_json_close(&j);
    rg_json_open(&j, "unfoldable", '[');
    for (int32_t k = 0; k < p->unfoldables; k++) unfoldable(&j, &p->unfoldable[k]);
    rg_json_close(&j);
    rg_json_open(&j, "warnings", '[');
    for (int32_t k = 0; k < p->lines.warnings; k++) warning(&j, &p->lines.warning[k]);
    rg_json_close(&j);
    rg_json_close(&j);
    return rg_file_commit(&out, why);
}

/* ------------------------------------------------------------------------------------------- for people ---- */

static const char *plural(int32_t n, const char *one, const char *more) { return n == 1 ? one : more; }

static void title(const rg_pattern_info *i, FILE *out)
{
    if (*i->title) fprintf(out, "%s", i->title);
    if (*i->title && *i->author) fprintf(out, ", ");
    if (*i->author) fprintf(out, "by %s", i->author);
    if (*i->title || *i->author) fputc('\n', out);
}

static void counts(const rg_pattern_info *i, FILE *out)
{
    fprintf(out, "graph       %d %s, %d %s, %d %s; size %.6g\n", (int)i->vertices, plural(i->vertices, "vertex", "vertices"),
            (int)i->edges, plural(i->edges, "edge", "edges"), (int)i->facets, plural(i->facets, "facet", "facets"), i->size);
    fprintf(out, "creases     %d: %d mountain, %d valley", (int)i->creases, (int)i->mountains, (int)i->valleys);
    if (i->unassigned) fprintf(out, ", %d unassigned", (int)i->unassigned);
    if (i->flat) fprintf(out, ", %d flat", (int)i->flat);
    fprintf(out, "\nmodel       M = %d interior %s, N = %d, N0 = %d border %s; degrees of freedom N - 3M = %d\n",
            (int)i->interior_vertices, plural(i->interior_vertices, "vertex", "vertices"), (int)i->creases,
            (int)i->boundary_edges, plural(i->boundary_edges, "edge", "edges"), (int)i->degrees_of_freedom);
    if (i->is_disk)
        fprintf(out, "            cut into triangles: %d more %s, %d degrees of freedom\n", (int)triangulating_adds(i),
                plural(triangulating_adds(i), "crease", "creases"), (int)i->boundary_edges - 3);
    fprintf(out, "drawing     largest gap closed %.3g, smallest distance kept %.3g\n", i->merged_max, i->kept_min);
}

/* "turns by 90 degrees, mirrors at 0, 45 degrees"; all: how many turns there are with the one by nothing. */
static void likeness(const rg_likeness *l, int32_t all, FILE *out)
{
    if (l->turns && all > 1) fprintf(out, "turns by %.6g degrees", 360.0 / all);
    if (l->turns && all > 1 && l->mirrors) fprintf(out, ", ");
    if (l->mirrors > listed(l)) fprintf(out, "%d ", (int)l->mirrors);
    for (int32_t i = 0; i < listed(l); i++)
        fprintf(out, "%s%.4g", i ? ", " : plural(l->mirrors, "mirror at ", "mirrors at "), round(1e4 * l->mirror[i]) / 1e4);
    if (l->mirrors) fprintf(out, "%s degrees", l->mirrors > listed(l) ? " ..." : "");
}

static void symmetries(const rg_alike *a, FILE *out)
{
    const rg_likeness *same = &a->same, *other = &a->exchanged;
    const int is_same = same->turns > 1 || same->mirrors, is_other = other->turns || other->mirrors;
    fprintf(out, "symmetry    ");
    if (!is_same && !is_other) fprintf(out, "none");
    if (is_same) likeness(same, same->turns, out);
    if (is_same && is_other) fprintf(out, "\n            ");
    if (is_other) {
        fprintf(out, "mountain for valley: ");
        likeness(other, other->turns + same->turns, out);
    }
    fputc('\n', out);
}

static void broken_theorem(const rg_unfoldable *u, FILE *out)
{
    fprintf(out, "            (%.6g, %.6g): ", u->x, u->y);
    switch (u->theorem) {
    case RG_KAWASAKI: fprintf(out, "Kawasaki: every other angle adds up to 180 degrees but for %.4g\n", u->by); break;
    case RG_MAEKAWA: fprintf(out, "Maekawa: mountains and valleys differ by %.0f, not by 2\n", u->by); break;
    case RG_DEGREE: fprintf(out, "%.0f creases meet, an odd number\n", u->by); break;
    case RG_BIG_LITTLE_BIG:
        fprintf(out, "big-little-big: a smallest angle, by %.4g degrees, lies between two creases of one kind\n", u->by);
        break;
    case RG_TARGETS: fprintf(out, "the fold angles of the file do not close: the paper misses itself by %.4g degrees\n", u->by); break;
    }
}

static void vertices(const rg_pattern *p, int32_t bad, FILE *out)
{
    const int32_t M = p->info.interior_vertices;
    if (M == 0) fprintf(out, "vertices    none inside the sheet\n");
    else if (bad == 0) fprintf(out, "vertices    each of %d inside the sheet can fold flat by itself\n", (int)M);
    else fprintf(out, "vertices    %d of %d inside the sheet cannot fold flat\n", (int)bad, (int)M);
    for (int32_t k = 0; k < p->unfoldables; k++) broken_theorem(&p->unfoldable[k], out);
}

static void closed_vertices(const rg_pattern *p, FILE *out)
{
    const int32_t n = p->info.closed_vertices;
    if (n == 0) fprintf(out, "closed      none\n");
    else
        fprintf(out, "closed      %d %s: a crease halves the angle of two that fold opposite ways\n", (int)n,
                plural(n, "vertex", "vertices"));
    for (int32_t k = 0; k < p->closed_triples; k++) {
        const rg_closed *c = &p->closed[k];
        fprintf(out, "            (%.6g, %.6g): creases to (%.6g, %.6g), (%.6g, %.6g), (%.6g, %.6g), inside angle %.4g degrees\n",
                c->x, c->y, c->a[0], c->a[1], c->c[0], c->c[1], c->b[0], c->b[1], c->inside_angle / RG_DEG);
    }
}

static void flat_folding(const rg_layers *l, FILE *out)
{
    rg_layers_info i;
    if (!l) return;
    rg_layers_get_info(l, &i);
    fprintf(out, "layers      ");
    switch (i.state) {
    case RG_LAYERS_VALID:
        fprintf(out, "folds flat in %s %s of %d facets", i.count, strcmp(i.count, "1") == 0 ? "order" : "orders", (int)i.facets);
        for (int32_t k = 0; i.parts > 1 && k < i.parts; k++)
            fprintf(out, "%s%.0f", k ? " x " : ": ", (double)rg_layers_part(l, k));
        fputc('\n', out);
        break;
    case RG_LAYERS_NONE: fprintf(out, "no flat folding: %s\n", i.reason); break;
    case RG_LAYERS_UNSOLVED: fprintf(out, "not solved: %s\n", i.reason); break;
    case RG_LAYERS_NOT_FLAT: fprintf(out, "its end is not flat: %s\n", i.reason); break;
    }
}

static void warnings(const rg_pattern *p, FILE *out)
{
    if (p->lines.warnings) fprintf(out, "warnings    %d\n", (int)p->lines.warnings);
    for (int32_t k = 0; k < p->lines.warnings; k++) {
        fprintf(out, "            ");
        if (p->lines.warning[k].line) fprintf(out, "line %d: ", p->lines.warning[k].line);
        fprintf(out, "%s\n", p->lines.warning[k].text);
    }
}

static const char *verdict(const rg_pattern_info *i, int32_t bad, const rg_layers *l)
{
    rg_layers_info layers = {.state = RG_LAYERS_UNSOLVED};
    if (l) rg_layers_get_info(l, &layers);
    if (!i->is_disk) return "It cannot be folded here: it is not one sheet without holes.";
    if (i->creases == 0) return "There is no crease to fold.";
    if (bad) return "It does not fold flat, for the vertices named cannot; it may fold part of the way.";
    if (layers.state == RG_LAYERS_NONE)
        return "Each vertex folds flat by itself, the sheet does not without passing through itself; it may fold part of the way.";
    if (i->mountains + i->valleys == 0) return "No crease says which way it folds: nothing will move.";
    if (i->closed_vertices)
        return "Each vertex folds flat by itself, but the closed ones lock rigid facets: it needs creases added or adjusted.";
    if (i->degrees_of_freedom <= 0)
        return "Nothing here speaks against it, but there are as many conditions as creases or more: they have to agree.";
    return "It is likely to fold: nothing here speaks against it.";
}

rg_status rg_info_text(const rg_pattern *p, const char *file, rg_diag *why)
{
    const rg_pattern_info *i = &p->info;
    const int32_t bad = unfoldable_vertices(p);
    rg_file f;
    rg_alike alike;
    rg_layers *l = NULL;
    rg_status s = rg_alike_find(p, &alike);
    if (s == RG_OK) s = find_layers(p, &l, why);
    if (s == RG_OK) s = rg_file_begin(&f, &p->mem, file, why);
    if (s != RG_OK) {
        rg_layers_destroy(l);
        return s;
    }
    FILE *out = f.stream;
    title(i, out);
    counts(i, out);
    if (i->is_disk) fprintf(out, "sheet       one, without holes\n");
    else fprintf(out, "sheet       not one without holes: %s\n", i->not_disk);
    symmetries(&alike, out);
    vertices(p, bad, out);
    closed_vertices(p, out);
    flat_folding(l, out);
    warnings(p, out);
    fprintf(out, "\n%s\n", verdict(i, bad, l));
    rg_layers_destroy(l);
    return rg_file_commit(&f, why);
}
