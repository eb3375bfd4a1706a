#include "contact/contact.h"

#include <string.h>

rg_status rg_contact_work_init(const rg_plates *p, rg_contact_work *w)
{
    memset(w, 0, sizeof *w);
    w->mem = p->mem;
    rg_status s = RG_MEM_ARRAYS(&p->mem, RG_ARRAY(w->box, (size_t)p->nodes), RG_ARRAY(w->normal, (size_t)p->parts),
                                RG_ARRAY(w->corner, (size_t)p->start[p->parts]));
    if (s == RG_OK) s = rg_front_work_init(p, &w->front);
    if (s != RG_OK) rg_contact_work_free(w);
    return s;
}

void rg_contact_work_free(rg_contact_work *w)
{
    if (!w->mem.resize) return;
    RG_MEM_FREE(&w->mem, w->box, w->normal, w->corner);
    rg_front_work_free(&w->front);
    memset(w, 0, sizeof *w);
}

/* One look at one state. */
typedef struct look {
    const rg_plates *p;
    const rg_vec3 *x;
    const rg_box *box;
    const rg_vec3 *corner, *normal;
    double least;          /* file units; what is not deeper is left out */
    int rising;            /* non-zero: `least` rises to the deepest so far */
    rg_contact_hit *hit;   /* [room] */
    int32_t room, pairs;
    rg_contact_hit deepest; /* depth in file units */
} look;

static rg_plate plate(const look *l, int32_t a)
{
    return (rg_plate){l->p->start[a + 1] - l->p->start[a], l->corner + l->p->start[a], l->normal[a]};
}

/* The depth of parts of two facets, 0 where it is not more than `least` or where they only touch. */
static double plates_cross(const rg_plates *p, const rg_plate *a, const rg_plate *b, int32_t f, int32_t g, double least,
                           rg_vec3 *axis)
{
    int32_t corner;
    const double depth = rg_depth_of(a, b, least, axis);
    if (!(depth > 0)) return 0;
    return rg_plates_shared(p->mesh, f, g, &corner) > 0 && !(rg_depth_stretch(a, b) > RG_CONTACT_STRETCH * p->size) ? 0
        : depth;
}

static double parts_cross(const look *l, int32_t a, int32_t b, double least, rg_vec3 *axis)
{
    const rg_plate A = plate(l, a), B = plate(l, b);
    return plates_cross(l->p, &A, &B, l->p->facet[a], l->p->facet[b], least, axis);
}

/* Non-zero: parts before these two, of the same facets, cross as well, so that the pair was counted with them. */
static int counted(const look *l, int32_t a, int32_t b)
{
    const rg_plates *p = l->p;
    const int32_t f = p->facet[a], g = p->facet[b];
    for (int32_t i = p->first[f]; i <= a; i++)
        for (int32_t k = p->first[g]; k < (i < a ? p->first[g + 1] : b); k++)
            if (parts_cross(l, i, k, l->least, NULL) > 0) return 1;
    return 0;
}

/* The deepest parts of two facets. */
static void deepen(const look *l, rg_contact_hit *h)
{
    const rg_plates *p = l->p;
    for (int32_t i = p->first[h->facet[0]]; i < p->first[h->facet[0] + 1]; i++)
        for (int32_t k = p->first[h->facet[1]]; k < p->first[h->facet[1] + 1]; k++) {
            rg_vec3 axis;
            const double depth = parts_cross(l, i, k, h->depth, &axis);
            if (depth > h->depth) h->depth = depth, h->axis = axis;
        }
}

static void meet(look *l, int32_t a, int32_t b)
{
    const rg_plates *p = l->p;
    rg_contact_hit h;
    if (p->facet[a] == p->facet[b]) return;
    if (p->facet[a] > p->facet[b]) {
        const int32_t swap = a;
        a = b, b = swap;
    }
    h.depth = parts_cross(l, a, b, l->least, &h.axis);
    if (!(h.depth > 0)) return;
    h.facet[0] = p->facet[a], h.facet[1] = p->facet[b];
    if (h.depth > l->deepest.depth) l->deepest = h;
    if (l->rising) {
        l->least = h.depth;
        return;
    }
    const int whole = p->first[h.facet[0] + 1] - p->first[h.facet[0]] == 1 &&
        p->first[h.facet[1] + 1] - p->first[h.facet[1]] == 1;
    if (!whole && counted(l, a, b)) return;
    if (!whole) deepen(l, &h);
    h.depth /= p->size;
    if (l->pairs < l->room) l->hit[l->pairs] = h;
    l->pairs++;
}

/* How far one box must be moved along an axis to part what is in them: no pair in them is deeper. */
static int may_cross(const look *l, int32_t i, int32_t k)
{
    const rg_box *a = &l->box[i], *b = &l->box[k];
    /* All six are compared: which one decides cannot be foretold, and a branch foretold wrongly costs more. */
    const double t = l->least;
    return (a->high.x - b->low.x > t) & (b->high.x - a->low.x > t) & (a->high.y - b->low.y > t) & (b->high.y -
            a->low.y > t) &
           (a->high.z - b->low.z > t) & (b->high.z - a->low.z > t);
}

static double extent(const rg_box *b)
{
    return b->high.x - b->low.x + (b->high.y - b->low.y) + (b->high.z - b->low.z);
}

static void visit_two(look *l, int32_t i, int32_t k)
{
    if (!may_cross(l, i, k)) return;
    const rg_plates_node *a = &l->p->node[i], *b = &l->p->node[k];
    if (a->part >= 0 && b->part >= 0) {
        meet(l, a->part, b->part);
    } else if (b->part >= 0 || (a->part < 0 && extent(&l->box[i]) >= extent(&l->box[k]))) {
        visit_two(l, i + 1, k);
        visit_two(l, a->right, k);
    } else {
        visit_two(l, i, k + 1);
        visit_two(l, i, b->right);
    }
}

/* A box that is nowhere thicker than what counts, as that of a sheet folded flat is, holds no crossing. */
static void visit(look *l, int32_t i)
{
    const rg_plates_node *n = &l->p->node[i];
    if (n->part >= 0 || !may_cross(l, i, i)) return;
    visit(l, i + 1);
    visit(l, n->right);
    visit_two(l, i + 1, n->right);
}

static look begin(const rg_plates *p, const rg_vec3 *x, double least, rg_contact_work *w)
{
    look l = {.p = p, .x = x, .box = w->box, .corner = w->corner, .normal = w->normal, .least = least * p->size};
    l.deepest.facet[0] = l.deepest.facet[1] = -1;
    for (int32_t j = 0; j < p->start[p->parts]; j++) w->corner[j] = x[p->vertex[j]];
    for (int32_t a = 0; a < p->parts; a++)
        w->normal[a] = rg_depth_normal(w->corner + p->start[a], p->start[a + 1] - p->start[a]);
    return l;
}

static void run(look *l, rg_contact_work *w)
{
    if (l->p->parts < 2 || rg_front_shows(l->p, l->x, w->normal, l->p->parts, &w->front)) return;
    rg_plates_boxes(l->p, l->x, w->box);
    visit(l, 0);
}

int32_t rg_contact_pairs(const rg_plates *p, const rg_vec3 *x, double least, rg_contact_work *w, rg_contact_hit *hit,
                         int32_t room,
                         rg_contact_hit *deepest)
{
    look l = begin(p, x, least, w);
    l.hit = hit;
    l.room = room;
    run(&l, w);
    if (deepest) {
        *deepest = l.deepest;
        deepest->depth /= p->size;
    }
    return l.pairs;
}

int rg_contact_deepest(const rg_plates *p, const rg_vec3 *x, double least, rg_contact_work *w, rg_contact_hit *deepest)
{
    look l = begin(p, x, least, w);
    l.rising = 1;
    run(&l, w);
    if (!(l.deepest.depth > 0)) return 0;
    *deepest = l.deepest;
    deepest->depth /= p->size;
    return 1;
}

static rg_plate one_plate(const rg_plates *p, const rg_vec3 *x, int32_t a, rg_vec3 corner[RG_PLATE_CORNERS])
{
    const int32_t n = p->start[a + 1] - p->start[a];
    for (int32_t k = 0; k < n; k++) corner[k] = x[p->vertex[p->start[a] + k]];
    return (rg_plate){n, corner, rg_depth_normal(corner, n)};
}

double rg_contact_depth(const rg_plates *p, const rg_vec3 *x, int32_t f, int32_t g, double least)
{
    rg_vec3 corner[2][RG_PLATE_CORNERS];
    double deepest = 0;
    for (int32_t a = p->first[f]; a < p->first[f + 1]; a++)
        for (int32_t b = p->first[g]; b < p->first[g + 1]; b++) {
            const rg_plate A = one_plate(p, x, a, corner[0]), B = one_plate(p, x, b, corner[1]);
            deepest = fmax(deepest, plates_cross(p, &A, &B, f, g, fmax(least * p->size, deepest), NULL));
        }
    return deepest / p->size;
}
