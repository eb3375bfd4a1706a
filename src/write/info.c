/* What is known of a pattern before it is folded, as JSON and for people. */
#include "base/file.h"
#include "base/number.h"
#include "base/text.h"
#include "base/unit.h"
#include "layers/layers.h"
#include "motion/motion.h"
#include "pattern/alike.h"
#include "pattern/check.h"
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

static rg_vec2 own(const rg_pattern *p, double x, double y)
{
    return rg_lines_own(&p->lines, (rg_vec2){x, y}, p->info.size);
}

/* In the file's coordinates. */
static void point(rg_json *j, const char *key, const rg_pattern *p, double x, double y)
{
    const rg_vec2 at = own(p, x, y);
    rg_json_numbers(j, key, (const double[]){at.x, at.y}, 2);
}

static void closed(rg_json *j, const rg_pattern *p, const rg_closed *c)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "vertex", c->vertex);
    point(j, "coordinates", p, c->x, c->y);
    rg_json_open(j, "creases", '[');
    point(j, NULL, p, c->a[0], c->a[1]);
    point(j, NULL, p, c->c[0], c->c[1]);
    point(j, NULL, p, c->b[0], c->b[1]);
    rg_json_close(j);
    rg_json_number(j, "inside_angle_deg", c->inside_angle / RG_DEG);
    rg_json_close(j);
}

static void unfoldable(rg_json *j, const rg_pattern *p, const rg_unfoldable *u)
{
    rg_json_open_line(j, NULL, '{');
    rg_json_integer(j, "vertex", u->vertex);
    point(j, "coordinates", p, u->x, u->y);
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

/* NULL: no sheet that could be folded. */
static rg_status find_layers(const rg_pattern *p, rg_layers **l, rg_diag *why)
{
    *l = NULL;
    return p->info.is_disk && rg_check_crowded(p) < 0 ? rg_layers_create(p, &p->mem, l, why) : RG_OK;
}

static void layers(rg_json *j, const rg_layers *l)
{
    rg_layers_info i;
    if (!l) return;
    i = *rg_layers_get_info(l);
    rg_json_string(j, "layers", rg_layers_state_name(i.state));
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
        rg_json_numbers(j, "coordinates", i.where_at[k], 2);
        rg_json_close(j);
    }
    rg_json_close(j);
}

static void pieces(rg_json *j, const rg_pattern *p)
{
    rg_json_open(j, "sheet_list", '[');
    for (int32_t k = 0; k < p->info.sheets; k++) {
        rg_json_open_line(j, NULL, '{');
        rg_json_integer(j, "sheet", k + 1);
        rg_json_numbers(j, "low", p->piece[k].low, 2);
        rg_json_numbers(j, "high", p->piece[k].high, 2);
        rg_json_integer(j, "lines", p->piece[k].lines);
        rg_json_close(j);
    }
    rg_json_close(j);
}

/* What --line can name: null where lines of one kind of drawing were taken for several. */
static void drawn_in(rg_json *j, const rg_pattern *p)
{
    static const char *const sorts[RG_TRAIT_SORTS] = {"colour", "layer", "dash"};
    rg_json_open(j, "drawn_in", '[');
    for (int32_t k = 0; k < p->lines.traits; k++) {
        const rg_trait *t = &p->lines.trait[k];
        rg_json_open_line(j, NULL, '{');
        rg_json_string(j, "by", sorts[t->sort]);
        rg_json_string(j, "name", t->name);
        rg_json_integer(j, "lines", t->count);
        rg_json_string(j, "assignment", t->assignment ? (const char[]){t->assignment, 0} : NULL);
        rg_json_close(j);
    }
    rg_json_close(j);
}

static rg_status write_json(const rg_pattern *p, const rg_dest *to, rg_diag *why)
{
    rg_json j;
    rg_file out;
    rg_alike alike;
    rg_layers *l = NULL;
    rg_status s = rg_alike_find(p, &alike);
    if (s == RG_OK) s = find_layers(p, &l, why);
    if (s == RG_OK) s = rg_file_begin_to(&out, &p->mem, to, why);
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
    pieces(&j, p);
    drawn_in(&j, p);
    rg_json_open(&j, "closed", '[');
    for (int32_t k = 0; k < p->closed_triples; k++) closed(&j, p, &p->closed[k]);
    rg_json_close(&j);
    rg_json_open(&j, "unfoldable", '[');
    for (int32_t k = 0; k < p->unfoldables; k++) unfoldable(&j, p, &p->unfoldable[k]);
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
    rg_text_shown(out, i->title);
    if (*i->title && *i->author) rg_text_to(out, ", ");
    if (*i->author) rg_text_to(out, "by ");
    rg_text_shown(out, i->author);
    if (*i->title || *i->author) fputc('\n', out);
}

static void counts(const rg_pattern_info *i, int32_t ways, FILE *out)
{
    const char *unit = rg_unit_name(i->unit);
    rg_text_to(out, "graph       %d %s, %d %s, %d %s; size %.6g%s%s\n", (int)i->vertices,
               plural(i->vertices, "vertex", "vertices"), (int)i->edges, plural(i->edges, "edge", "edges"),
               (int)i->facets, plural(i->facets, "facet", "facets"), i->size, unit ? " " : "", unit ? unit : "");
    rg_text_to(out, "creases     %d: %d mountain, %d valley", (int)i->creases, (int)i->mountains, (int)i->valleys);
    if (i->unassigned) rg_text_to(out, ", %d unassigned", (int)i->unassigned);
    if (i->flat) rg_text_to(out, ", %d flat", (int)i->flat);
    if (i->cuts) rg_text_to(out, ", %d %s", (int)i->cuts, plural(i->cuts, "slit", "slits"));
    if (i->lost_creases)
        rg_text_to(out, "; %d more %s drawn, left out or taken for border", (int)i->lost_creases,
                   plural(i->lost_creases, "is", "are"));
    fputc('\n', out);
    if (ways >= 0)
        rg_text_to(out, "mobility    %d %s to move once it has left flat\n", (int)ways, plural(ways, "way", "ways"));
}

static void model(const rg_pattern_info *i, FILE *out)
{
    rg_text_to(out, "model       M = %d interior %s, N = %d, N0 = %d border %s; N - 3M = %d\n",
               (int)i->interior_vertices, plural(i->interior_vertices, "vertex", "vertices"), (int)i->creases,
               (int)i->boundary_edges, plural(i->boundary_edges, "edge", "edges"), (int)i->degrees_of_freedom);
    if (i->is_disk)
        rg_text_to(out, "            cut into triangles: %d more %s, N0 - 3 = %d degrees of freedom\n",
                   (int)triangulating_adds(i), plural(triangulating_adds(i), "crease", "creases"),
                   (int)i->boundary_edges - 3);
    rg_text_to(out, "drawing     largest gap closed %.3g, smallest distance kept %.3g\n", i->merged_max, i->kept_min);
}

/* "turns by 90 degrees, mirrors at 0, 45 degrees"; all: how many turns there are with the one by nothing. */
static void likeness(const rg_likeness *l, int32_t all, FILE *out)
{
    if (l->turns && all > 1) rg_text_to(out, "turns by %.6g degrees", 360.0 / all);
    if (l->turns && all > 1 && l->mirrors) rg_text_to(out, ", ");
    if (l->mirrors > listed(l)) rg_text_to(out, "%d ", (int)l->mirrors);
    for (int32_t i = 0; i < listed(l); i++)
        rg_text_to(out, "%s%.4g", i ? ", " : plural(l->mirrors, "mirror at ", "mirrors at "),
                   round(1e4 * l->mirror[i]) / 1e4);
    if (l->mirrors) rg_text_to(out, "%s degrees", l->mirrors > listed(l) ? " ..." : "");
}

static void symmetries(const rg_alike *a, FILE *out)
{
    const rg_likeness *same = &a->same, *other = &a->exchanged;
    const int is_same = same->turns > 1 || same->mirrors, is_other = other->turns || other->mirrors;
    rg_text_to(out, "symmetry    ");
    if (!is_same && !is_other) rg_text_to(out, "none");
    if (is_same) likeness(same, same->turns, out);
    if (is_same && is_other) rg_text_to(out, "\n            ");
    if (is_other) {
        rg_text_to(out, "mountain for valley: ");
        likeness(other, other->turns + same->turns, out);
    }
    fputc('\n', out);
}

void rg_unfoldable_text(const rg_pattern *p, const rg_unfoldable *u, char text[240])
{
    const rg_vec2 at = rg_lines_own(&p->lines, (rg_vec2){u->x, u->y}, p->info.size);
    const int n = rg_text(text, 240, "at (%.6g, %.6g) ", at.x, at.y);
    const size_t room = (size_t)(240 - n);
    switch (u->theorem) {
    case RG_KAWASAKI:
        rg_text(text + n, room,
                "every other angle should add up to 180 degrees, and is %.4g degrees off (Kawasaki's theorem)", u->by);
        break;
    case RG_MAEKAWA:
        rg_text(text + n, room, "mountains and valleys differ by %.0f, and should by 2 (Maekawa's theorem)", u->by);
        break;
    case RG_DEGREE: rg_text(text + n, room, "%.0f creases meet, an odd number", u->by); break;
    case RG_BIG_LITTLE_BIG:
        rg_text(text + n, room,
                "the smallest angle, by %.4g degrees, lies between two creases of one kind: one of them has to be the "
                "other (big-little-big)",
                u->by);
        break;
    case RG_TARGETS:
        rg_text(text + n, room,
                "the fold angles of the file contradict each other: with all of them the paper misses itself by %.4g "
                "degrees",
                u->by);
        break;
    }
}

/* The one to tell first: what the file itself contradicts, then what is worst of the first theorem that fails. */
static const rg_unfoldable *worst(const rg_pattern *p)
{
    static const rg_theorem order[] = {RG_TARGETS, RG_DEGREE, RG_KAWASAKI, RG_MAEKAWA, RG_BIG_LITTLE_BIG};
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        const rg_unfoldable *found = NULL;
        for (int32_t k = 0; k < p->unfoldables; k++)
            if (p->unfoldable[k].theorem == order[i] && (!found || p->unfoldable[k].by > found->by))
                found = &p->unfoldable[k];
        if (found) return found;
    }
    return NULL;
}

static void vertices(const rg_pattern *p, int32_t bad, int lists, FILE *out)
{
    char text[240];
    const int32_t M = p->info.interior_vertices;
    if (M == 0) rg_text_to(out, "vertices    none inside the sheet\n");
    else if (bad == 0) rg_text_to(out, "vertices    each of %d inside the sheet can fold flat by itself\n", (int)M);
    else
        rg_text_to(out, "vertices    %d of %d inside the sheet cannot fold flat%s\n", (int)bad, (int)M,
                   lists || bad < 2 ? "" : "; -v lists them");
    for (int32_t k = 0; lists && k < p->unfoldables; k++) {
        rg_unfoldable_text(p, &p->unfoldable[k], text);
        rg_text_to(out, "            %s\n", text);
    }
}

static void closed_vertices(const rg_pattern *p, int lists, FILE *out)
{
    const int32_t n = p->info.closed_vertices;
    if (n > 0)
        rg_text_to(out,
                   "closed      %d %s: a crease halves the angle of two that fold opposite ways, which locks them%s\n",
                   (int)n, plural(n, "vertex", "vertices"), lists ? "" : "; -v lists them");
    for (int32_t k = 0; lists && k < p->closed_triples; k++) {
        const rg_closed *c = &p->closed[k];
        const rg_vec2 at[] = {own(p, c->x, c->y), own(p, c->a[0], c->a[1]), own(p, c->c[0], c->c[1]),
                              own(p, c->b[0], c->b[1])};
        rg_text_to(out,
                   "            (%.6g, %.6g): creases to (%.6g, %.6g), (%.6g, %.6g), (%.6g, %.6g), inside angle %.4g "
                   "degrees\n",
                   at[0].x, at[0].y, at[1].x, at[1].y, at[2].x, at[2].y, at[3].x, at[3].y, c->inside_angle / RG_DEG);
    }
}

static void flat_folding(const rg_layers *l, FILE *out)
{
    rg_layers_info i;
    if (!l) return;
    i = *rg_layers_get_info(l);
    rg_text_to(out, "folded flat ");
    switch (i.state) {
    case RG_LAYERS_VALID:
        rg_text_to(out, "%s %s of its %d %s", i.count, strcmp(i.count, "1") == 0 ? "layer order" : "layer orders",
                   (int)i.facets, plural(i.facets, "facet", "facets"));
        for (int32_t k = 0; i.parts > 1 && k < i.parts; k++)
            rg_text_to(out, "%s%.0f", k ? " x " : ": ", (double)rg_layers_part(l, k));
        fputc('\n', out);
        break;
    case RG_LAYERS_NONE: rg_text_to(out, "no layer order: %s\n", i.reason); break;
    case RG_LAYERS_UNSOLVED: rg_text_to(out, "not solved: %s\n", i.reason); break;
    case RG_LAYERS_NOT_FLAT: rg_text_to(out, "not meant to be: %s\n", i.reason); break;
    }
}

static void warnings(const rg_pattern *p, int lists, FILE *out)
{
    if (p->lines.warnings) rg_text_to(out, "warnings    %d\n", (int)p->lines.warnings);
    for (int32_t k = 0; lists && k < p->lines.warnings; k++) {
        rg_text_to(out, "            ");
        if (p->lines.warning[k].line) rg_text_to(out, "line %d: ", p->lines.warning[k].line);
        rg_text_to(out, "%s\n", p->lines.warning[k].text);
    }
}

static const char *letter_name(char letter)
{
    switch (letter) {
    case RG_BORDER: return "border";
    case RG_MOUNTAIN: return "mountain";
    case RG_VALLEY: return "valley";
    case RG_UNASSIGNED: return "unassigned";
    case RG_FLAT: return "aux";
    case '-': return "left out";
    default: return "of several kinds";
    }
}

/* What the lines are drawn in: the KEY of --line, how many there are, what they were taken for. */
static void traits(const rg_pattern *p, FILE *out)
{
    static const char *const names[RG_TRAIT_SORTS] = {"colours     ", "layers      ", "dashes      "};
    for (int sort = 0; sort < RG_TRAIT_SORTS; sort++) {
        int n = 0;
        for (int32_t k = 0; k < p->lines.traits; k++) {
            const rg_trait *t = &p->lines.trait[k];
            if ((int)t->sort != sort) continue;
            rg_text_to(out, "%s", n++ ? ", " : names[sort]);
            rg_text_shown(out, t->name);
            rg_text_to(out, ": %d %s", (int)t->count, letter_name(t->assignment));
        }
        if (n) fputc('\n', out);
    }
}

static void sheets(const rg_pattern *p, FILE *out)
{
    if (p->info.sheets < 2) return;
    rg_text_to(out, "sheets      %d; --sheet N takes one\n", (int)p->info.sheets);
    for (int32_t k = 0; k < p->info.sheets; k++)
        rg_text_to(out, "            %d: %.6g x %.6g at (%.6g, %.6g), %d lines\n", (int)k + 1,
                   p->piece[k].high[0] - p->piece[k].low[0], p->piece[k].high[1] - p->piece[k].low[1],
                   p->piece[k].low[0], p->piece[k].low[1], (int)p->piece[k].lines);
}

/* Creases by the numbers that they have in every output, as long as none are added. */
static void crease_list(const rg_pattern *p, FILE *out)
{
    int32_t number = 0;
    for (int32_t e = 0; e < p->ne; e++) {
        const rg_edge *E = &p->E[e];
        if (E->assignment == RG_BORDER) continue;
        const rg_vec2 a = own(p, p->X[E->v[0]].x, p->X[E->v[0]].y), b = own(p, p->X[E->v[1]].x, p->X[E->v[1]].y);
        rg_text_to(out, "            c%d %c, vertices %d and %d: (%.6g, %.6g) to (%.6g, %.6g)", (int)number++,
                   E->assignment, (int)E->v[0], (int)E->v[1], a.x, a.y, b.x, b.y);
        if (isfinite(E->target)) rg_text_to(out, ", target %.6g", rg_number_degrees(E->target));
        if (E->where) rg_text_to(out, ", line %d", (int)E->where);
        fputc('\n', out);
    }
}

/* A sheet of more creases is not set in motion only to be counted. */
enum { MOST_MOVED = 600 };

/* Ways to move, by the rank of C a little off flat; -1: not known. Flat, to first order, there seem to be more (3.2).
 */
static rg_status mobility(const rg_pattern *p, int32_t *ways)
{
    rg_settings s = rg_settings_default();
    rg_motion *m = NULL;
    *ways = -1;
    if (!p->info.is_disk || rg_check_crowded(p) >= 0 || p->info.creases == 0 || p->info.creases > MOST_MOVED)
        return RG_OK;
    s.memory = &p->mem;
    s.frames = 2;
    s.to = 0.05;
    s.effort = RG_EFFORT_FAST;
    s.triangulate = RG_TRIANGULATE_NONE;
    s.adjust = 0;
    rg_status status = rg_motion_create(p, &s, NULL, NULL, &m, NULL);
    if (status != RG_OK) return status == RG_ENOMEM ? status : RG_OK;
    if (rg_motion_report(m)->outcome == RG_FOLDED) status = rg_motion_mobility(m, 1, ways);
    rg_motion_destroy(m);
    return status;
}

/* Whether the file asks of every crease that it stays flat. */
static int is_still(const rg_pattern *p)
{
    for (int32_t e = 0; e < p->ne; e++)
        if (p->E[e].assignment != RG_BORDER && p->E[e].target != 0) return 0;
    return p->info.creases > 0;
}

/* The verdict, and what to do next. */
static void verdict(const rg_pattern *p, const rg_layers *l, FILE *out)
{
    const rg_pattern_info *i = &p->info;
    const rg_unfoldable *u = worst(p);
    rg_layers_info layers = {.state = RG_LAYERS_UNSOLVED};
    char text[240];
    if (l) layers = *rg_layers_get_info(l);
    if (!i->is_disk) {
        rg_text_to(out, "It cannot be folded here, for it is not one sheet without holes: %s.\n", i->not_disk);
        if (i->cuts && p->lines.traits)
            rg_text_to(out, "Next: if such lines are creases, say with --line which way they fold.\n");
    } else if (rg_check_crowded(p) >= 0) {
        rg_check_crowded_text(p, rg_check_crowded(p), text);
        rg_text_to(out, "It cannot be folded here: %s.\n", text);
    } else if (i->creases == 0 && i->lost_creases > 0) {
        rg_text_to(out, "There is no crease to fold: all that are drawn (%d) are left out.\n", (int)i->lost_creases);
        rg_text_to(out, p->lines.warnings ? "Next: draw them up to the lines that they should meet, or join them with "
                                            "--merge; the warnings say by how much.\n"
                                          : "Next: draw them across the sheet: they lie on its border.\n");
    } else if (i->creases == 0) {
        rg_text_to(out, "There is no crease to fold.\n");
    } else if (u) {
        rg_unfoldable_text(p, u, text);
        if (u->theorem == RG_TARGETS) {
            rg_text_to(out, "It cannot get to where it should: %s.\n", text);
            rg_text_to(out,
                       "Next: change an angle there, or leave one open (unassigned), or fold with --no-targets.\n");
        } else {
            rg_text_to(out, "It does not fold flat: %s.\n", text);
            rg_text_to(out, "Next: mend the creases there, or fold part of the way: rigami fold --to 50.\n");
        }
    } else if (layers.state == RG_LAYERS_NONE) {
        rg_text_to(out,
                   i->interior_vertices
                       ? "Each vertex folds flat by itself, the sheet does not without passing through itself: %s.\n"
                       : "The sheet does not fold flat without passing through itself: %s.\n",
                   layers.reason);
        rg_text_to(out, "Next: fold part of the way: rigami fold --to 50.\n");
    } else if (i->mountains + i->valleys == 0) {
        rg_text_to(out, "No crease says which way it folds: nothing will move.\n");
        rg_text_to(out, "Next: draw mountains and valleys%s.\n",
                   p->lines.traits ? ", or say with --line which lines they are" : "");
    } else if (is_still(p)) {
        rg_text_to(out, "Nothing will move: every fold angle of the file is 0.\n");
        rg_text_to(out, "Next: fold with --no-targets, which folds it flat.\n");
    } else if (i->closed_vertices) {
        rg_text_to(out,
                   "Each vertex folds flat by itself, but %d closed %s lock rigid facets: it needs creases added, or "
                   "moved on the way.\n",
                   (int)i->closed_vertices, plural(i->closed_vertices, "vertex", "vertices"));
        rg_text_to(out, "Next: rigami fold does so by itself, and says by how much.\n");
    } else if (i->degrees_of_freedom <= 0) {
        rg_text_to(
            out,
            "It may fold: nothing here speaks against it, but its creases have to agree with each other on the way.\n");
    } else {
        rg_text_to(out, "It is likely to fold: nothing here speaks against it.\n");
    }
}

static void tell(const rg_pattern *p, const rg_alike *alike, const rg_layers *l, int32_t ways, int lists, FILE *out)
{
    const rg_pattern_info *i = &p->info;
    verdict(p, l, out);
    fputc('\n', out);
    title(i, out);
    sheets(p, out);
    vertices(p, unfoldable_vertices(p), lists, out);
    closed_vertices(p, lists, out);
    flat_folding(l, out);
    warnings(p, lists, out);
    counts(i, ways, out);
    traits(p, out);
    if (!lists) return;
    model(i, out);
    symmetries(alike, out);
    crease_list(p, out);
}

static rg_status write_text(const rg_pattern *p, int lists, const rg_dest *to, rg_diag *why)
{
    rg_file f;
    rg_alike alike;
    rg_layers *l = NULL;
    int32_t ways = -1;
    rg_status s = rg_alike_find(p, &alike);
    if (s == RG_OK) s = find_layers(p, &l, why);
    if (s == RG_OK) s = mobility(p, &ways);
    if (s == RG_OK) s = rg_file_begin_to(&f, &p->mem, to, why);
    if (s == RG_OK) {
        tell(p, &alike, l, ways, lists, f.stream);
        s = rg_file_commit(&f, why);
    }
    rg_layers_destroy(l);
    return s;
}

rg_status rg_info_write(const rg_pattern *p, const char *file, rg_diag *why)
{
    return write_json(p, &(rg_dest){file, NULL}, why);
}

rg_status rg_info_write_to(const rg_pattern *p, const rg_sink *sink, rg_diag *why)
{
    return write_json(p, &(rg_dest){NULL, sink}, why);
}

rg_status rg_info_text(const rg_pattern *p, int lists, const char *file, rg_diag *why)
{
    return write_text(p, lists, &(rg_dest){file, NULL}, why);
}

rg_status rg_info_text_to(const rg_pattern *p, int lists, const rg_sink *sink, rg_diag *why)
{
    return write_text(p, lists, &(rg_dest){NULL, sink}, why);
}
