#include "base/status.h"
#include "pattern/pattern.h"

/* Two drawings of one point are each within the tolerance of where it ought to be. */
static const double TWO_DRAWINGS = 2;

typedef struct box { rg_vec2 low, high; } box;

static box box_of(const rg_pattern *p)
{
    box b = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int32_t v = 0; v < p->nv; v++) {
        b.low = (rg_vec2){fmin(b.low.x, p->X[v].x), fmin(b.low.y, p->X[v].y)};
        b.high = (rg_vec2){fmax(b.high.x, p->X[v].x), fmax(b.high.y, p->X[v].y)};
    }
    return b;
}

/* The vertex on p's border that is farthest off q's. */
static int32_t farthest(const rg_pattern *p, const rg_pattern *q, double *off)
{
    int32_t worst = -1;
    *off = 0;
    for (int32_t v = 0; v < p->nv; v++) {
        if (!p->rim[v]) continue;
        double nearest = INFINITY;
        for (int32_t e = 0; e < q->ne; e++) {
            if (q->E[e].assignment != RG_BORDER) continue;
            nearest = fmin(nearest, rg_vec2_off_segment(q->X[q->E[e].v[0]], q->X[q->E[e].v[1]], p->X[v]));
        }
        if (nearest <= *off) continue;
        *off = nearest;
        worst = v;
    }
    return worst;
}

/* What its lines were drawn to, a part of the size. */
static double drawn_to(const rg_pattern *p)
{
    return p->merge == RG_MERGE_DEFAULT ? fmax(p->lines.merge, p->merge) : p->merge;
}

rg_status rg_pattern_same_sheet(const rg_pattern *first, const rg_pattern *other, rg_diag *why)
{
    if (!other->info.is_disk)
        return rg_fail(RG_ESHEET, why, 0, "not one sheet without holes: %s", other->info.not_disk);
    if (!first->info.is_disk) return rg_fail(RG_ESHEET, why, 0, "the first state is not one sheet without holes");
    const double tol = TWO_DRAWINGS * fmax(drawn_to(first), drawn_to(other)) * first->info.size;
    double of_other, of_first;
    const int32_t v = farthest(other, first, &of_other), w = farthest(first, other, &of_first);
    if (of_other <= tol && of_first <= tol) return RG_OK;

    const box a = box_of(first), b = box_of(other);
    const rg_vec2 of_a = rg_vec2_sub(a.high, a.low), of_b = rg_vec2_sub(b.high, b.low);
    const rg_vec2 moved = rg_vec2_sub(b.low, a.low);
    if (!(fabs(of_a.x - of_b.x) <= tol && fabs(of_a.y - of_b.y) <= tol))
        return rg_fail(RG_ESHEET, why, 0,
                       "not the sheet of the first state: %.6g x %.6g, and the first is %.6g x %.6g", of_b.x, of_b.y,
                       of_a.x, of_a.y);
    if (!(rg_vec2_length(moved) <= tol))
        return rg_fail(RG_ESHEET, why, 0, "not the sheet of the first state: it lies (%.6g, %.6g) away", moved.x,
                       moved.y);
    const rg_vec2 at = of_other >= of_first ? other->X[v] : first->X[w];
    return rg_fail(RG_ESHEET, why, 0, "not the sheet of the first state: their borders differ at (%.6g, %.6g)", at.x,
                   at.y);
}
