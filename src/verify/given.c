#include "verify/given.h"

/* Of the sheet's size: two readings of one drawing join ends that are so near. */
static const double SAME = 1e-4;

/* A line with two ends and a letter. */
typedef struct line { rg_vec2 a, b; char letter; } line;

/* Flat and undecided lines are told apart by few formats. */
static char kind_of(char letter) { return letter == 'M' || letter == 'V' || letter == 'B' ? letter : 'F'; }

static line of_record(const rg_record *r, int32_t e)
{
    return (line){r->X[r->edge[e][0]], r->X[r->edge[e][1]], kind_of(r->assignment[e])};
}

static line of_pattern(const rg_pattern *p, int32_t e)
{
    return (line){p->X[p->E[e].v[0]], p->X[p->E[e].v[1]], kind_of(p->E[e].assignment)};
}

static double off_line(const line *l, rg_vec2 x)
{
    const rg_vec2 e = rg_vec2_sub(l->b, l->a);
    const double n = rg_vec2_dot(e, e), t = n > 0 ? fmin(1, fmax(0, rg_vec2_dot(e, rg_vec2_sub(x, l->a)) / n)) : 0;
    return rg_vec2_length(rg_vec2_sub(x, (rg_vec2){l->a.x + t * e.x, l->a.y + t * e.y}));
}

/* How much of a line lies on another one of its kind. */
static double on_line(const line *l, const line *of, double by)
{
    const rg_vec2 e = rg_vec2_sub(l->b, l->a);
    const double n = rg_vec2_length(e);
    if (l->letter != of->letter || !(n > 0)) return 0;
    const double s = rg_vec2_dot(e, rg_vec2_sub(of->a, l->a)) / n, t = rg_vec2_dot(e, rg_vec2_sub(of->b, l->a)) / n;
    const double from = fmax(0, fmin(s, t)), to = fmin(n, fmax(s, t));
    const rg_vec2 p = {l->a.x + from * e.x / n, l->a.y + from * e.y / n},
        q = {l->a.x + to * e.x / n, l->a.y + to * e.y / n};
    return to > from && off_line(of, p) <= by && off_line(of, q) <= by ? to - from : 0;
}

void rg_given_check(const rg_record *r, const rg_pattern *given, rg_faults *all)
{
    const double by = SAME * r->size;
    for (int32_t e = 0; e < r->ne; e++) {
        const line l = of_record(r, e);
        double on = 0;
        for (int32_t g = 0; g < given->ne && !r->added[e]; g++) {
            const line of = of_pattern(given, g);
            on += on_line(&l, &of, by);
        }
        if (!r->added[e] && !(on >= rg_vec2_length(rg_vec2_sub(l.b, l.a)) - 2 * by))
            rg_faults_add(all, -1, -1, -1,
                          "edge %d from (%.6g, %.6g) to (%.6g, %.6g) is no such line of the pattern given", (int)e,
                          l.a.x, l.a.y, l.b.x, l.b.y);
    }
    for (int32_t g = 0; g < given->ne; g++) {
        const line l = of_pattern(given, g);
        double on = 0;
        for (int32_t e = 0; e < r->ne; e++) {
            const line of = of_record(r, e);
            if (!r->added[e]) on += on_line(&l, &of, by);
        }
        if (!(on >= rg_vec2_length(rg_vec2_sub(l.b, l.a)) - 2 * by))
            rg_faults_add(all, -1, -1, -1,
                          "the line from (%.6g, %.6g) to (%.6g, %.6g) of the pattern given is not in it", l.a.x, l.a.y,
                l.b.x, l.b.y);
    }
}
