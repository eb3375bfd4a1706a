/* stability -- every hard place by every method: a table, a heat map.   stability FOLDER [SCENARIO]
 * Ends with status 1 if the program as it comes drifts or diverges anywhere, or folds what cannot fold; or if a path, or a sheet whose facets
 * are in each other's way, fails a check. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
#include "paths.h"
#include "contacts.h"
#include "scenarios.h"

#include <unistd.h>

static const char *method_name(int m) { return m == RG_METHOD_AUTO ? "default" : rg_run_method_name((rg_method)m); }

static FILE *out_file(const char *folder, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    if (!f) perror(path), exit(1);
    return f;
}

static void write_csv(FILE *f, cell (*c)[METHODS])
{
    fprintf(f, "scenario,method,verdict,least_folded_percent,closure_rad,edge_strain,beyond_deg,off_rad,seconds,note\n");
    for (int i = 0; i < SCENARIOS; i++)
        for (int m = 0; m < METHODS; m++) {
            const cell *x = &c[i][m];
            fprintf(f, "\"%s\",%s,%s,%.4g,%.2g,%.2g,%.3g,", scenarios[i].name, method_name(m), verdict_name(x->verdict), x->percent,
                    x->closure, x->strain, x->beyond);
            if (!isnan(x->off)) fprintf(f, "%.2g", x->off);
            fprintf(f, ",%.3g,\"%s\"\n", x->seconds, x->note);
        }
}

/* What a cell says under its verdict. */
static void numbers(const cell *x, char *text, size_t room)
{
    const double percent = fabs(x->percent) < 0.01 ? 0 : x->percent;
    if (x->verdict == STOPPED) snprintf(text, room, "at %.3g %%, closes to %.0e", percent, x->closure);
    else if (x->verdict == NONE) snprintf(text, room, "-");
    else if (x->verdict == REACHED) snprintf(text, room, "closes to %.0e", x->closure);
    else if (x->beyond > 5) snprintf(text, room, "%.3g %%, %.2g deg too far", percent, x->beyond);
    else snprintf(text, room, "%.3g %%, open by %.0e", percent, x->closure);
}

static void write_md(FILE *f, cell (*c)[METHODS])
{
    fprintf(f, "| scenario |");
    for (int m = 0; m < METHODS; m++) fprintf(f, " %s |", method_name(m));
    fprintf(f, "\n|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < SCENARIOS; i++) {
        fprintf(f, "| **%s**: %s |", scenarios[i].name, scenarios[i].what);
        for (int m = 0; m < METHODS; m++) {
            char text[80];
            numbers(&c[i][m], text, sizeof text);
            fprintf(f, " %s, %s |", verdict_name(c[i][m].verdict), text);
        }
        fprintf(f, "\n");
    }
    fprintf(f, "\nThe default, scenario by scenario:\n\n");
    for (int i = 0; i < SCENARIOS; i++) {
        const cell *x = &c[i][RG_METHOD_AUTO];
        fprintf(f, "- %s: %s", scenarios[i].name, x->note);
        if (x->strain > 0) fprintf(f, "; edge strain %.0e", x->strain);
        if (x->beyond > 1e-9) fprintf(f, "; up to %.2g degrees beyond half a turn", x->beyond);
        fprintf(f, "\n");
    }
}

static void write_svg(FILE *f, cell (*c)[METHODS])
{
    /* Light enough for black letters, apart for colour-blind eyes by lightness too. */
    static const char *const colour[] = {"#8fd0b4", "#f3e3a1", "#eda56b", "#c0605e", "#eeeeee"};
    const int left = 230, top = 60, w = 176, h = 44;
    fprintf(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" font-family=\"sans-serif\" font-size=\"13\">\n",
            left + METHODS * w + 20, top + SCENARIOS * h + 60);
    fprintf(f, "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n");
    for (int m = 0; m < METHODS; m++)
        fprintf(f, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\" font-size=\"16\" font-weight=\"bold\">%s</text>\n", left + m * w + w / 2,
                top - 14, method_name(m));
    for (int i = 0; i < SCENARIOS; i++) {
        const int y = top + i * h;
        fprintf(f, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\" font-size=\"15\">%s%s</text>\n", left - 12, y + h / 2 + 5, scenarios[i].name,
                scenarios[i].must_not_fold ? " *" : "");
        for (int m = 0; m < METHODS; m++) {
            char text[80];
            const int x = left + m * w;
            numbers(&c[i][m], text, sizeof text);
            fprintf(f, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" rx=\"4\" fill=\"%s\"/>\n", x + 2, y + 2, w - 4, h - 4,
                    colour[c[i][m].verdict]);
            fprintf(f, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\" font-size=\"14\">%s</text>\n", x + w / 2, y + 19,
                    verdict_name(c[i][m].verdict));
            fprintf(f, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\" font-size=\"11\" fill=\"#333333\">%s</text>\n", x + w / 2, y + 35, text);
        }
    }
    fprintf(f, "<text x=\"%d\" y=\"%d\" font-size=\"13\">* cannot fold as asked: stopped is the right answer</text>\n</svg>\n", left,
            top + SCENARIOS * h + 30);
}

/* ------------------------------------------------------------------------------------------------- paths ---- */

static const char *outcome_name(rg_outcome o) { return o == RG_FOLDED ? "folded" : o == RG_RESTS ? "rests" : "stopped"; }

static void write_paths_csv(FILE *f, const path_seen *x)
{
    fprintf(f, "pattern,rung,outcome,percent,leap_61_deg,even_61_deg,leap_601_deg,even_601_deg,falls_percent,wrong_side_deg,wrong_side_told_deg,"
               "same_bits,apart_rad,percent_half_step,percent_loose_tol,symmetries,kept,kept_told,askew_deg,seconds\n");
    for (int i = 0; i < PATHS; i++, x++) {
        if (!x->there) continue;
        fprintf(f, "\"%s\",\"%s\",%s,%.4g,%.4g,%.4g,%.4g,%.4g,%.2g,%.4g,%.4g,%d,%.2g,%.4g,%.4g,%d,%d,%d,%.2g,%.3g\n", paths[i].name,
                x->rung ? x->rung : "", outcome_name(x->outcome), x->percent, x->leap[0], x->even[0], x->leap[1], x->even[1], x->back, x->wrong,
                x->wrong_told, x->same_bits, x->apart, x->percent_by_step, x->percent_by_tol, x->elements, x->kept, x->told, x->askew, x->seconds);
    }
}

static void write_paths_md(FILE *f, const path_seen *x)
{
    static const char *const bad = "**", *const good = "";
    fprintf(f, "\nThe paths of the default; what fails is in bold:\n\n| pattern | folds by | largest turn over the even one: 61, 601 frames | percents fall | "
               "wrong side, deg: seen, told | 61 frames are of the 601 | half the step | ten times the tolerance | symmetries: drawn, told, kept |\n"
               "|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < PATHS; i++, x++) {
        if (!x->there) continue;
        const char *mark[PATH_CHECKS];
        char apart[40] = "same bits";
        for (int k = 0; k < PATH_CHECKS; k++) mark[k] = path_fails(x, k) ? bad : good;
        if (!x->same_bits) snprintf(apart, sizeof apart, "apart by %.0e rad", x->apart);
        fprintf(f, "| **%s**: %s | %s, %s | %s%.2f, %.2f%s | %s%.0e%s | %s%.3g, %.3g%s | %s%s%s | %s%s, %.3g %%%s | %s%s, %.3g %%%s | %s%d, %d, %d%s |\n",
                paths[i].name, paths[i].what, x->rung ? x->rung : "-", outcome_name(x->outcome), mark[LEAPS], x->leap[0] / x->even[0],
                x->leap[1] / x->even[1], mark[LEAPS], mark[GOES_BACK], x->back, mark[GOES_BACK], mark[CONCEALS], x->wrong, x->wrong_told,
                mark[CONCEALS], mark[DEPENDS_ON_FRAMES], apart, mark[DEPENDS_ON_FRAMES], mark[DEPENDS_ON_STEP],
                x->same_outcome_by_step ? "the same" : "another outcome", x->percent_by_step, mark[DEPENDS_ON_STEP], mark[DEPENDS_ON_TOL],
                x->same_outcome_by_tol ? "the same" : "another outcome", x->percent_by_tol, mark[DEPENDS_ON_TOL], mark[ASKEW], x->elements,
                x->told, x->kept, mark[ASKEW]);
    }
}

/* How many checks fail. */
static int look_at_path(int i, path_seen *x)
{
    static const char *const names[] = {"leaps", "goes back", "conceals", "depends on frames", "depends on the step", "depends on the tolerance", "askew"};
    int failed = 0;
    const double begun = rg_seconds();
    *x = path_look(&paths[i]);
    if (!x->there) return 0;
    printf("path %-25s %-9s %6.1f %%  leaps %.2f %.2f, falls %.0e, wrong %.3g deg, %s, symmetries %d of %d  %.2f s ", paths[i].name,
           outcome_name(x->outcome), x->percent, x->leap[0] / x->even[0], x->leap[1] / x->even[1], x->back, x->wrong,
           x->same_bits ? "same bits" : "OTHER BITS", x->kept, x->elements, rg_seconds() - begun);
    for (int k = 0; k < PATH_CHECKS; k++)
        if (path_fails(x, k)) printf(failed++ ? ", %s" : " FAILS: %s", names[k]);
    printf("\n");
    fflush(stdout);
    return failed;
}

/* ---------------------------------------------------------------------------------------------- contact ---- */

static void verdict_of(const contact_seen *x, char *text, size_t room)
{
    if (x->is_free) snprintf(text, room, "free");
    else if (x->outcome != RG_FOLDED) snprintf(text, room, "stopped at %.3g %%", x->percent);
    else snprintf(text, room, "crosses from %.3g %%, %.2g deep", x->from, x->depth);
}

static void write_contacts(FILE *md, FILE *csv, const contact_seen *x)
{
    fprintf(md, "\nFacets in each other's way, the program as it comes; what fails is in bold. Depths are over the sheet's size:\n\n"
                "| sheet | left as it is, depth | as it comes | by | verify | 2, 60, 301 frames | states of 60 frames | seconds: left, avoided |\n"
                "|---|---|---|---|---|---|---|---|\n");
    fprintf(csv, "sheet,outcome,free,valid,same_verdict,percent,crosses_from_percent,depth,depth_left,layers,states,seconds_left,seconds,how\n");
    for (int i = 0; i < CONTACTS; i++, x++) {
        const char *mark[CONTACT_CHECKS];
        char said[80];
        for (int k = 0; k < CONTACT_CHECKS; k++) mark[k] = contact_fails(&contacts[i], x, k) ? "**" : "";
        verdict_of(x, said, sizeof said);
        fprintf(md, "| **%s**: %s | %.2g | %s%s%s | %s; layers %s | %s%s%s | %s%s%s | %d | %.2g, %.2g |\n", contacts[i].name, contacts[i].what,
                x->depth_plain, mark[UNEXPECTED], said, mark[UNEXPECTED], x->how, x->order, mark[NOT_VALID],
                x->is_free ? x->is_valid ? "valid" : "not valid" : "-", mark[NOT_VALID], mark[OTHER_VERDICT], x->same ? "the same" : "another verdict",
                mark[OTHER_VERDICT], (int)x->states, x->seconds_plain, x->seconds);
        fprintf(csv, "\"%s\",%s,%d,%d,%d,%.4g,%.4g,%.3g,%.3g,%s,%d,%.3g,%.3g,\"%s\"\n", contacts[i].name, outcome_name(x->outcome), x->is_free,
                x->is_valid, x->same, x->percent, x->from, x->depth, x->depth_plain, x->order, (int)x->states, x->seconds_plain, x->seconds, x->how);
    }
}

/* How many checks fail. */
static int look_at_contact(int i, contact_seen *x)
{
    static const char *const names[] = {"not as it has to be", "told to be free, and not valid", "depends on frames"};
    int failed = 0;
    char said[80];
    *x = contact_look(&contacts[i]);
    verdict_of(x, said, sizeof said);
    printf("contact %-14s %-28s left %.2g deep, %.2f s; %.2f s  %s", contacts[i].name, said, x->depth_plain, x->seconds_plain, x->seconds, x->how);
    for (int k = 0; k < CONTACT_CHECKS; k++)
        if (contact_fails(&contacts[i], x, k)) printf(failed++ ? ", %s" : " FAILS: %s", names[k]);
    printf("\n");
    fflush(stdout);
    return failed;
}

int main(int argc, char **argv)
{
    static cell c[SCENARIOS][METHODS];
    static path_seen way[PATHS];
    static contact_seen touch[CONTACTS];
    int failed = 0;
    if (argc < 2) return fprintf(stderr, "usage: stability FOLDER [SCENARIO]\n"), 2;
    for (int i = 0; i < SCENARIOS; i++) {
        if (argc > 2 && strcmp(argv[2], scenarios[i].name) != 0) continue;
        for (int m = 0; m < METHODS; m++) {
            const double begun = rg_seconds();
            cell *x = &c[i][m];
            *x = try_cell(&scenarios[i], (rg_method)m);
            printf("%-30s %-9s %-9s %6.1f %%  closure %.1e strain %.1e beyond %.2g  %.2f s  %s\n", scenarios[i].name, method_name(m),
                   verdict_name(x->verdict), x->percent, x->closure, x->strain, x->beyond, rg_seconds() - begun, x->note);
            fflush(stdout);
            const int lies = scenarios[i].must_not_fold && x->verdict == REACHED;
            if (m == RG_METHOD_AUTO && (x->verdict > STOPPED || lies)) failed = 1;
        }
    }
    for (int i = 0; i < PATHS; i++)
        if (argc <= 2 || strcmp(argv[2], paths[i].name) == 0) failed |= look_at_path(i, &way[i]) > 0;
    for (int i = 0; i < CONTACTS; i++)
        if (argc <= 2 || strcmp(argv[2], contacts[i].name) == 0) failed |= look_at_contact(i, &touch[i]) > 0;
    if (argc > 2) return failed;
    FILE *f = out_file(argv[1], "stability.csv");
    write_csv(f, c);
    fclose(f);
    f = out_file(argv[1], "stability.svg");
    write_svg(f, c);
    fclose(f);
    f = out_file(argv[1], "table.md");
    write_md(f, c);
    write_paths_md(f, way);
    FILE *csv = out_file(argv[1], "contact.csv");
    write_contacts(f, csv, touch);
    fclose(csv);
    fclose(f);
    f = out_file(argv[1], "paths.csv");
    write_paths_csv(f, way);
    fclose(f);
    return failed;
}
