/* stability -- every hard place by every method: a table, a heat map.   stability FOLDER [SCENARIO]
 * Ends with status 1 if the program as it comes drifts or diverges anywhere, or folds what cannot fold. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "near.h"
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

int main(int argc, char **argv)
{
    static cell c[SCENARIOS][METHODS];
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
    if (argc > 2) return failed;
    FILE *f = out_file(argv[1], "stability.csv");
    write_csv(f, c);
    fclose(f);
    f = out_file(argv[1], "stability.svg");
    write_svg(f, c);
    fclose(f);
    f = out_file(argv[1], "table.md");
    write_md(f, c);
    fclose(f);
    return failed;
}
