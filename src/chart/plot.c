/* plot.c -- the work-precision diagram: error down, cost to the right, both by powers of ten; one curve a method and
 * solver. Whole numbers of tenths of a pixel, so that no locale can spoil the file. */
#include "base/utf8.h"
#include "chart/chart.h"

enum { WIDTH = 11900, HEIGHT = 5400, TOP = 700, BOTTOM = 4650, PANEL = 4000, LEFT = 900, GAP = 700 };

/* Colour-blind safe (Okabe and Ito), by method. */
static const char *const COLOUR[] = {"#000000", "#d55e00", "#e69f00", "#009e73", "#0072b2", "#cc79a7", "#56b4e9"};
/* What is less off than this is drawn here: rounding. */
static const double LEAST_ERROR = 1e-15;

/* One panel: a range of powers of ten either way. */
typedef struct axes {
    int left;
    double x0, x1, y0, y1; /* log10 */
} axes;

static int across(const axes *a, double cost)
{
    return a->left + (int)lround(PANEL * (log10(cost) - a->x0) / (a->x1 - a->x0));
}

static int down(const axes *a, double error)
{
    return BOTTOM - (int)lround((BOTTOM - TOP) * (log10(fmax(error, LEAST_ERROR)) - a->y0) / (a->y1 - a->y0));
}

static double cost(const rg_run *r, int in_passes) { return in_passes ? r->passes : r->seconds; }

/* It has a place in the diagram. */
static int is_drawn(const rg_chart *c, const rg_run *r) { return rg_chart_reached(c, r) && !isnan(r->error); }

static void fit(const rg_chart *c, int in_passes, axes *a)
{
    double low = INFINITY, high = 0, least = 1, most = LEAST_ERROR;
    for (int32_t i = 0; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (!is_drawn(c, r)) continue;
        low = fmin(low, cost(r, in_passes)), high = fmax(high, cost(r, in_passes));
        least = fmin(least, fmax(r->error, LEAST_ERROR)), most = fmax(most, r->error);
        if (r->pattern_error > 0)
            least = fmin(least, fmax(r->pattern_error, LEAST_ERROR)), most = fmax(most, r->pattern_error);
    }
    if (!(high > 0)) low = 1e-3, high = 1;
    a->left = LEFT + in_passes * (PANEL + GAP);
    a->x0 = log10(low) - 0.15, a->x1 = log10(high) + 0.15;
    a->y0 = floor(log10(least) - 0.2), a->y1 = ceil(log10(most) + 0.2);
}

static void text(int x, int y, const char *anchor, int size, FILE *out)
{
    fprintf(out, "<text x=\"%d\" y=\"%d\" text-anchor=\"%s\" font-size=\"%d\">", x, y, anchor, size);
}

/* 10 to a power */
static void power(int x, int y, const char *anchor, int n, FILE *out)
{
    text(x, y, anchor, 135, out);
    fprintf(out, "10<tspan dy=\"-55\" font-size=\"100\">%d</tspan></text>\n", n);
}

static void grid(const axes *a, const char *label, int names, FILE *out)
{
    fprintf(out, "<g stroke=\"#dddddd\" stroke-width=\"8\">\n");
    for (int n = (int)ceil(a->x0); n <= (int)floor(a->x1); n++) {
        const int x = across(a, pow(10, n));
        fprintf(out, "<path d=\"M%d %dV%d\"/>\n", x, TOP, BOTTOM);
    }
    for (int n = (int)a->y0; n <= (int)a->y1; n += 2)
        fprintf(out, "<path d=\"M%d %dh%d\"/>\n", a->left, down(a, pow(10, n)), PANEL);
    fprintf(out, "</g>\n<g stroke=\"#999999\" stroke-width=\"8\">\n");
    for (int n = (int)floor(a->x0); n <= (int)floor(a->x1); n++)
        for (int k = 2; k < 10; k++) {
            const double at = k * pow(10, n);
            if (log10(at) > a->x0 && log10(at) < a->x1)
                fprintf(out, "<path d=\"M%d %dv-50\"/>\n", across(a, at), BOTTOM);
        }
    fprintf(out, "</g>\n<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" ", a->left, TOP, PANEL, BOTTOM - TOP);
    fprintf(out, "fill=\"none\" stroke=\"#444444\" stroke-width=\"10\"/>\n");
    for (int n = (int)ceil(a->x0); n <= (int)floor(a->x1); n++)
        power(across(a, pow(10, n)), BOTTOM + 220, "middle", n, out);
    for (int n = (int)a->y0; names && n <= (int)a->y1; n += 2)
        power(a->left - 60, down(a, pow(10, n)) + 60, "end", n, out);
    text(a->left + PANEL / 2, BOTTOM + 480, "middle", 150, out);
    fprintf(out, "%s</text>\n", label);
}

static void mark(int x, int y, rg_solver solver, const char *colour, FILE *out)
{
    const char *style = "stroke=\"white\" stroke-width=\"12\"";
    if (solver == RG_SOLVER_CG)
        fprintf(out, "<circle cx=\"%d\" cy=\"%d\" r=\"62\" fill=\"%s\" %s/>\n", x, y, colour, style);
    else if (solver == RG_SOLVER_CHOLESKY)
        fprintf(out, "<rect x=\"%d\" y=\"%d\" width=\"112\" height=\"112\" fill=\"%s\" %s/>\n", x - 56, y - 56, colour,
                style);
    else fprintf(out, "<path d=\"M%d %dl70 126h-140z\" fill=\"%s\" %s/>\n", x, y - 78, colour, style);
}

/* The default: a ring and a cross hair, so that what lies under it stays to be seen. */
static void mark_default(int x, int y, FILE *out)
{
    fprintf(out, "<path d=\"M%d %dh-110m330 0h110M%d %dv-110m0 330v110\" stroke=\"black\" stroke-width=\"22\"/>\n",
            x - 110, y, x, y - 110);
    fprintf(out, "<circle cx=\"%d\" cy=\"%d\" r=\"110\" fill=\"none\" stroke=\"black\" stroke-width=\"22\"/>\n", x, y);
}

static const char *dashes(rg_solver s)
{
    if (s == RG_SOLVER_CG) return "";
    return s == RG_SOLVER_CHOLESKY ? " stroke-dasharray=\"90 50\"" : " stroke-dasharray=\"25 45\"";
}

static void curves(const rg_chart *c, const axes *a, int in_passes, FILE *out)
{
    int open = 0;
    for (int32_t i = 1; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (!rg_chart_same_curve(c, i) && open) fputs("\"/>\n", out), open = 0;
        if (!is_drawn(c, r)) continue;
        if (!open)
            fprintf(out, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"20\"%s points=\"", COLOUR[r->method],
                    dashes(r->solver));
        open = 1;
        fprintf(out, "%d,%d ", across(a, cost(r, in_passes)), down(a, r->error));
    }
    if (open) fputs("\"/>\n", out);
    for (int32_t i = 1; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        if (is_drawn(c, r)) mark(across(a, cost(r, in_passes)), down(a, r->error), r->solver, COLOUR[r->method], out);
    }
    if (is_drawn(c, &c->run[0])) mark_default(across(a, cost(&c->run[0], in_passes)), down(a, c->run[0].error), out);
}

/* How far off the rolled pattern is: the relaxed stepper's second curve, open marks. */
static void pattern_curve(const rg_chart *c, const axes *a, int in_passes, FILE *out)
{
    for (int marks = 0; marks < 2; marks++) {
        if (!marks)
            fprintf(out, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"20\"%s points=\"",
                    COLOUR[RG_METHOD_RELAXED], dashes(RG_SOLVER_SVD));
        for (int32_t i = 1; i <= c->relaxed.points; i++) {
            const rg_run *r = &c->run[i];
            if (!is_drawn(c, r) || !(r->pattern_error > 0)) continue;
            const int x = across(a, cost(r, in_passes)), y = down(a, r->pattern_error);
            if (!marks) fprintf(out, "%d,%d ", x, y);
            else
                fprintf(out, "<circle cx=\"%d\" cy=\"%d\" r=\"62\" fill=\"white\" stroke=\"%s\" "
                             "stroke-width=\"20\"/>\n", x, y, COLOUR[RG_METHOD_RELAXED]);
        }
        if (!marks) fputs("\"/>\n", out);
    }
}

static void tolerance(const rg_chart *c, const axes *a, FILE *out)
{
    if (!(log10(c->settings.tol) > a->y0 && log10(c->settings.tol) < a->y1)) return;
    const int y = down(a, c->settings.tol);
    fprintf(out, "<path d=\"M%d %dh%d\" stroke=\"#666666\" stroke-width=\"10\" stroke-dasharray=\"20 30\"/>\n", a->left,
            y, PANEL);
    fprintf(out, "<g fill=\"#666666\">");
    text(a->left + PANEL - 40, y - 40, "end", 115, out);
    fprintf(out, "closure tolerance</text></g>\n");
}

static void legend(const rg_chart *c, FILE *out)
{
    const int x = LEFT + 2 * PANEL + GAP + 200;
    int y = TOP + 120, stopped = 0;
    for (int32_t i = 1; i < c->runs; i++) {
        const rg_run *r = &c->run[i];
        stopped += !rg_chart_reached(c, r);
        if (rg_chart_same_curve(c, i) || (c->relaxed.folds && r->method != RG_METHOD_RELAXED)) continue;
        fprintf(out, "<path d=\"M%d %dh360\" stroke=\"%s\" stroke-width=\"20\"%s/>\n", x, y, COLOUR[r->method],
                dashes(r->solver));
        mark(x + 180, y, r->solver, COLOUR[r->method], out);
        text(x + 440, y + 45, "start", 130, out);
        fprintf(out, "%s, %s</text>\n", rg_run_method_name(r->method), rg_run_solver_name(r->solver));
        y += 210;
    }
    if (c->relaxed.folds) {
        fprintf(out, "<path d=\"M%d %dh360\" stroke=\"%s\" stroke-width=\"20\" stroke-dasharray=\"25 45\"/>\n", x, y,
                COLOUR[RG_METHOD_RELAXED]);
        text(x + 440, y + 45, "start", 130, out);
        fprintf(out, "pattern, of the sheet</text>\n");
        y += 210;
    }
    y += 110;
    mark_default(x + 180, y, out);
    text(x + 440, y - 15, "start", 130, out);
    fprintf(out, "default:</text>\n");
    text(x + 440, y + 145, "start", 130, out);
    fprintf(out, "%s, %s</text>\n", rg_run_method_name(c->run[0].method), rg_run_solver_name(c->run[0].solver));
    if (stopped == 0) return;
    text(x, y + 420, "start", 120, out);
    fprintf(out, "not drawn: %d that stopped</text>\n", stopped);
}

/* The name of a file may hold anything. */
static void escaped(const char *s, FILE *out)
{
    while (*s) {
        const unsigned char first = (unsigned char)*s;
        const size_t n = rg_utf8_character((const unsigned char *)s);
        if (first == '&') fputs("&amp;", out);
        else if (first == '<') fputs("&lt;", out);
        else if (first < 0x20 || !rg_utf8_in_xml((const unsigned char *)s, n)) fputc('?', out);
        else fwrite(s, 1, n, out);
        s += n ? n : 1;
    }
}

void rg_chart_svg(const rg_chart *c, const char *title, FILE *out)
{
    fprintf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
                 "font-family=\"sans-serif\" fill=\"#222222\">\n<rect width=\"%d\" height=\"%d\" fill=\"white\"/>\n",
            WIDTH / 10, HEIGHT / 10, WIDTH, HEIGHT, WIDTH, HEIGHT);
    text(LEFT, 420, "start", 210, out);
    escaped(title, out);
    fprintf(out, ": %d creases, %d frames</text>\n", (int)c->N, (int)c->settings.frames);
    fprintf(out, "<g transform=\"rotate(-90 230 %d)\">", (TOP + BOTTOM) / 2);
    text(230, (TOP + BOTTOM) / 2, "middle", 150, out);
    fprintf(out, "largest error of a fold angle in any frame, rad</text></g>\n");
    for (int in_passes = 0; in_passes < 2; in_passes++) {
        axes a;
        fit(c, in_passes, &a);
        grid(&a, in_passes ? "passes over C" : "seconds", !in_passes, out);
        tolerance(c, &a, out);
        curves(c, &a, in_passes, out);
        if (c->relaxed.folds) pattern_curve(c, &a, in_passes, out);
    }
    legend(c, out);
    fputs("</svg>\n", out);
}
