#include "verify/record.h"
#include "base/status.h"
#include "read/value.h"

#include <string.h>

enum { MOST = INT32_MAX / 64 };

typedef struct reader {
    rg_record *r;
    const rg_value *root;
    rg_diag *why;
} reader;

static rg_status bad(const reader *q, const char *what, const char *where)
{
    return rg_fail(RG_EFORMAT, q->why, 0, "%s: %s", where, what);
}

/* A list of exactly n (any number, where n < 0) things. */
static rg_status list(const reader *q, const rg_value *of, const char *key, int32_t n, const rg_value **v)
{
    *v = rg_value_get(of, key);
    if (rg_value_kind(*v) != RG_KIND_LIST) return bad(q, "there is no such list, which a motion has", key);
    if (rg_value_count(*v) > MOST) return bad(q, "too many", key);
    if (n >= 0 && rg_value_count(*v) != (size_t)n) return bad(q, "not as many as the pattern has", key);
    return RG_OK;
}

/* Numbers of row i, as many as asked for; a third that is missing is 0. */
static int numbers(const rg_value *v, int32_t i, double *x, size_t n)
{
    const rg_value *row = rg_value_at(v, (size_t)i);
    const size_t there = rg_value_count(row);
    if (rg_value_kind(row) != RG_KIND_LIST || there < 2) return 0;
    for (size_t k = 0; k < n; k++) {
        x[k] = 0;
        if (k < there ? !rg_value_number(rg_value_at(row, k), &x[k]) : k < 2) return 0;
        if (!isfinite(x[k])) return 0;
    }
    return 1;
}

static int index_of(const rg_value *v, int32_t limit, int32_t *out)
{
    int64_t i;
    if (!rg_value_integer(v, &i) || i < 0 || i >= limit) return 0;
    *out = (int32_t)i;
    return 1;
}

static void *room(const reader *q, int64_t n, size_t size) { return rg_mem_array(&q->r->mem, (size_t)n, size); }

static rg_status coordinates(const reader *q, const rg_value *of, const char *key, rg_vec2 *X)
{
    const rg_value *v;
    rg_status s = list(q, of, key, q->r->nv, &v);
    for (int32_t i = 0; s == RG_OK && i < q->r->nv; i++) {
        double x[2];
        if (!numbers(v, i, x, 2)) return bad(q, "not two numbers", key);
        X[i] = (rg_vec2){x[0], x[1]};
    }
    return s;
}

static rg_status angles(const reader *q, const rg_value *of, double *rho)
{
    const rg_value *v;
    rg_status s = list(q, of, "edges_foldAngle", q->r->ne, &v);
    for (int32_t e = 0; s == RG_OK && e < q->r->ne; e++) {
        double degrees = 0;
        const rg_value *angle = rg_value_at(v, (size_t)e);
        if (rg_value_kind(angle) != RG_KIND_NULL && !rg_value_number(angle, &degrees))
            return bad(q, "not a number", "edges_foldAngle");
        rho[e] = degrees * RG_DEG;
    }
    return s;
}

static rg_status edges(const reader *q)
{
    rg_record *r = q->r;
    const rg_value *v, *a, *added = rg_value_get(q->root, "rigami:edges_added");
    rg_status s = list(q, q->root, "edges_vertices", -1, &v);
    if (s != RG_OK) return s;
    r->ne = (int32_t)rg_value_count(v);
    s = list(q, q->root, "edges_assignment", r->ne, &a);
    if (s != RG_OK) return s;
    r->edge = room(q, r->ne, sizeof *r->edge);
    r->assignment = room(q, r->ne, 1);
    r->target = room(q, r->ne, sizeof *r->target);
    r->added = room(q, r->ne, 1);
    r->open = room(q, r->ne, 1);
    r->side = room(q, r->ne, sizeof *r->side);
    if (!r->edge || !r->assignment || !r->target || !r->added || !r->open || !r->side) return RG_ENOMEM;
    for (int32_t e = 0; e < r->ne; e++) {
        const rg_value *row = rg_value_at(v, (size_t)e);
        const char *letter = rg_value_text(rg_value_at(a, (size_t)e));
        for (int k = 0; k < 2; k++)
            if (!index_of(rg_value_at(row, (size_t)k), r->nv, &r->edge[e][k]))
                return bad(q, "no such vertex", "edges_vertices");
        if (!letter || !strchr("BMVFUCJ", letter[0]) || !letter[0] || letter[1])
            return bad(q, "no such letter", "edges_assignment");
        r->assignment[e] = letter[0];
        /* What is a mountain or the border is of the pattern, whatever the file says. */
        r->added[e] = letter[0] == 'F' && rg_value_is_true(rg_value_at(added, (size_t)e)) != 0;
        r->side[e][0] = r->side[e][1] = -1;
    }
    s = angles(q, q->root, r->target);
    for (int32_t e = 0; s == RG_OK && e < r->ne; e++)
        r->open[e] = rg_value_kind(rg_value_at(rg_value_get(q->root, "edges_foldAngle"), (size_t)e)) == RG_KIND_NULL;
    return s;
}

static double area_of(const rg_record *r, int32_t f)
{
    double sum = 0;
    for (int32_t j = r->start[f] + 1; j + 1 < r->start[f + 1]; j++)
        sum += rg_vec2_turn(r->X[r->corner[r->start[f]]], r->X[r->corner[j]], r->X[r->corner[j + 1]]);
    return sum;
}

static rg_status faces(const reader *q)
{
    rg_record *r = q->r;
    const rg_value *v;
    rg_status s = list(q, q->root, "faces_vertices", -1, &v);
    if (s != RG_OK) return s;
    r->nf = (int32_t)rg_value_count(v);
    r->start = room(q, (int64_t)r->nf + 1, sizeof *r->start);
    r->turned = room(q, r->nf, 1);
    if (!r->start || !r->turned) return RG_ENOMEM;
    for (int32_t f = 0; f < r->nf; f++) {
        const size_t n = rg_value_count(rg_value_at(v, (size_t)f));
        if (n < 3 || n > MOST || r->start[f] > MOST) return bad(q, "not three vertices or more", "faces_vertices");
        r->start[f + 1] = r->start[f] + (int32_t)n;
    }
    r->corner = room(q, r->start[r->nf], sizeof *r->corner);
    if (!r->corner) return RG_ENOMEM;
    for (int32_t f = 0; f < r->nf; f++) {
        int32_t *c = r->corner + r->start[f];
        const int32_t n = r->start[f + 1] - r->start[f];
        for (int32_t k = 0; k < n; k++)
            if (!index_of(rg_value_at(rg_value_at(v, (size_t)f), (size_t)k), r->nv, &c[k]))
                return bad(q, "no such vertex", "faces_vertices");
        r->turned[f] = area_of(r, f) < 0;
        for (int32_t k = 0; r->turned[f] && k < n / 2; k++) {
            const int32_t swap = c[k];
            c[k] = c[n - 1 - k];
            c[n - 1 - k] = swap;
        }
    }
    return RG_OK;
}

static rg_status one_frame(const reader *q, const rg_value *frame, int32_t k)
{
    rg_record *r = q->r;
    const size_t at = (size_t)k * (size_t)r->nv;
    const rg_value *v;
    rg_status s = list(q, frame, "vertices_coords", r->nv, &v);
    for (int32_t i = 0; s == RG_OK && i < r->nv; i++)
        if (!numbers(v, i, &r->x[at + (size_t)i].x, 3)) return bad(q, "not three numbers", "vertices_coords");
    if (s == RG_OK) s = angles(q, frame, r->rho + (size_t)k * (size_t)r->ne);
    if (s != RG_OK) return s;
    if (!rg_value_number(rg_value_get(frame, "rigami:percent"), &r->percent[k])) r->percent[k] = NAN;
    if (rg_value_get(frame, "rigami:vertices_flatCoords"))
        return coordinates(q, frame, "rigami:vertices_flatCoords", r->flat + at);
    memcpy(r->flat + at, r->X, (size_t)r->nv * sizeof *r->X);
    return RG_OK;
}

static rg_status orders(const reader *q, const rg_value *frame)
{
    rg_record *r = q->r;
    const rg_value *v = rg_value_get(frame, "faceOrders");
    if (!v) return RG_OK;
    if (rg_value_kind(v) != RG_KIND_LIST || rg_value_count(v) > MOST) return bad(q, "no list", "faceOrders");
    r->orders = (int32_t)rg_value_count(v);
    r->order = room(q, r->orders, sizeof *r->order);
    if (!r->order) return RG_ENOMEM;
    for (int32_t i = 0; i < r->orders; i++) {
        const rg_value *row = rg_value_at(v, (size_t)i);
        int64_t sign;
        if (!index_of(rg_value_at(row, 0), r->nf, &r->order[i][0]) ||
            !index_of(rg_value_at(row, 1), r->nf, &r->order[i][1]) ||
            !rg_value_integer(rg_value_at(row, 2), &sign) || sign < -1 || sign > 1)
            return bad(q, "not two facets and 1, -1 or 0", "faceOrders");
        r->order[i][2] = (int32_t)(r->turned[r->order[i][1]] ? -sign : sign);
    }
    return RG_OK;
}

/* Has it as many places and angles as it should? Asked of all before there is room for any. */
static rg_status is_whole(const reader *q, const rg_value *state)
{
    const rg_value *v;
    const rg_status s = list(q, state, "vertices_coords", q->r->nv, &v);
    return s == RG_OK ? list(q, state, "edges_foldAngle", q->r->ne, &v) : s;
}

static int is_placed(const rg_value *frame) { return rg_value_get(frame, "vertices_coords") != NULL; }

/* Frames, and with each the states that its file has between it and the next one. */
static rg_status frames(const reader *q)
{
    rg_record *r = q->r;
    const rg_value *v;
    rg_status s = list(q, q->root, "file_frames", -1, &v);
    if (s != RG_OK) return s;
    const int32_t n = (int32_t)rg_value_count(v);
    int64_t states = 0;
    for (int32_t k = 0; k < n && s == RG_OK; k++) {
        const rg_value *frame = rg_value_at(v, (size_t)k), *between = rg_value_get(frame, "rigami:between");
        if (!is_placed(frame)) continue;
        s = is_whole(q, frame);
        for (size_t i = 0; i < rg_value_count(between) && s == RG_OK; i++) s = is_whole(q, rg_value_at(between, i));
        states += 1 + (int64_t)rg_value_count(between);
    }
    if (s != RG_OK) return s;
    if (states < 1) return bad(q, "none has vertices_coords", "file_frames");
    if (states > MOST) return bad(q, "too many", "file_frames");
    r->frames = (int32_t)states;
    r->number = room(q, r->frames, sizeof *r->number);
    r->percent = room(q, r->frames, sizeof *r->percent);
    r->x = room(q, (int64_t)r->frames * r->nv, sizeof *r->x);
    r->rho = room(q, (int64_t)r->frames * r->ne, sizeof *r->rho);
    r->flat = room(q, (int64_t)r->frames * r->nv, sizeof *r->flat);
    if (!r->number || !r->percent || !r->x || !r->rho || !r->flat) return RG_ENOMEM;
    int32_t at = 0, number = 0;
    for (int32_t k = 0; s == RG_OK && k < n; k++) {
        const rg_value *frame = rg_value_at(v, (size_t)k), *between = rg_value_get(frame, "rigami:between");
        if (!is_placed(frame)) continue;
        r->number[at] = number++;
        s = one_frame(q, frame, at++);
        if (s == RG_OK && at == r->frames) s = orders(q, frame);
        for (size_t i = 0; s == RG_OK && i < rg_value_count(between); i++) {
            r->number[at] = number;
            s = one_frame(q, rg_value_at(between, i), at++);
        }
    }
    for (int32_t k = r->frames - 1; s == RG_OK && r->number[k] == number; k--) r->number[k]--, r->after_all++;
    return s;
}

rg_status rg_record_parse(const char *bytes, size_t size, const rg_memory *mem, rg_record *r, rg_diag *why)
{
    rg_value *root = NULL;
    memset(r, 0, sizeof *r);
    r->mem = *mem;
    rg_status s = rg_value_parse(bytes, size, NULL, &root, why);
    const reader q = {r, root, why};
    const rg_value *v;
    if (s == RG_OK && rg_value_kind(root) != RG_KIND_OBJECT) s = rg_fail(RG_EFORMAT, why, 0, "no FOLD file");
    if (s == RG_OK) s = list(&q, root, "vertices_coords", -1, &v);
    if (s == RG_OK) {
        r->nv = (int32_t)rg_value_count(v);
        r->X = room(&q, r->nv, sizeof *r->X);
        s = r->X ? coordinates(&q, root, "vertices_coords", r->X) : RG_ENOMEM;
    }
    if (s == RG_OK) s = edges(&q);
    if (s == RG_OK) s = faces(&q);
    if (s == RG_OK) s = frames(&q);
    rg_vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (int32_t i = 0; s == RG_OK && i < r->nv; i++) {
        low = (rg_vec2){fmin(low.x, r->X[i].x), fmin(low.y, r->X[i].y)};
        high = (rg_vec2){fmax(high.x, r->X[i].x), fmax(high.y, r->X[i].y)};
    }
    r->size = hypot(high.x - low.x, high.y - low.y) / sqrt(2);
    if (s == RG_OK && !(r->nf > 0 && r->size > 0)) s = rg_fail(RG_EFORMAT, why, 0, "there is no sheet in it");
    rg_value_free(root);
    if (s != RG_OK) rg_record_free(r);
    return s == RG_ENOMEM ? rg_fail(s, why, 0, "out of memory") : s;
}

void rg_record_free(rg_record *r)
{
    if (!r->mem.resize) return;
    RG_MEM_FREE(&r->mem, r->X, r->edge, r->assignment, r->target, r->added, r->open, r->start, r->corner, r->turned,
                r->side, r->number, r->percent, r->x, r->rho, r->flat, r->order);
    memset(r, 0, sizeof *r);
}

rg_record_place rg_record_fit(const rg_record *r, int32_t frame, int32_t f, double *off)
{
    const int32_t *c = r->corner + r->start[f], n = r->start[f + 1] - r->start[f];
    const rg_vec3 *x = r->x + (size_t)frame * (size_t)r->nv;
    const rg_vec2 *X = r->flat + (size_t)frame * (size_t)r->nv;
    int32_t a = 0, b = 1;
    double far = -1;
    for (int32_t i = 0; i < n; i++)
        for (int32_t k = 0; k < i; k++)
            if (rg_vec2_length(rg_vec2_sub(X[c[i]], X[c[k]])) > far)
                far = rg_vec2_length(rg_vec2_sub(X[c[i]], X[c[k]])), a = k, b = i;
    rg_vec3 normal = {0, 0, 0};
    for (int32_t k = 1; k + 1 < n; k++)
        normal = rg_vec3_add(normal, rg_vec3_cross(rg_vec3_sub(x[c[k]], x[c[0]]), rg_vec3_sub(x[c[k + 1]], x[c[0]])));
    rg_vec3 e = rg_vec3_sub(x[c[b]], x[c[a]]);
    e = rg_vec3_scale(1 / rg_vec3_length(e), e);
    normal = rg_vec3_axpy(-rg_vec3_dot(normal, e), e, normal);
    normal = rg_vec3_scale(1 / rg_vec3_length(normal), normal);
    const rg_vec3 g = rg_vec3_cross(normal, e);
    rg_vec2 u = rg_vec2_sub(X[c[b]], X[c[a]]);
    u = (rg_vec2){u.x / far, u.y / far};
    /* R takes u to e, and u turned left to g. */
    rg_record_place p;
    p.R.c[0] = rg_vec3_axpy(u.x, e, rg_vec3_scale(-u.y, g));
    p.R.c[1] = rg_vec3_axpy(u.y, e, rg_vec3_scale(u.x, g));
    p.R.c[2] = normal;
    p.t = rg_vec3_sub(x[c[a]], rg_mat3_mul_vec(p.R, (rg_vec3){X[c[a]].x, X[c[a]].y, 0}));
    double most = 0;
    for (int32_t k = 0; k < n; k++) {
        const double d = rg_vec3_length(rg_vec3_sub(x[c[k]],
                                                    rg_vec3_add(rg_mat3_mul_vec(p.R,
                                                                                (rg_vec3){X[c[k]].x, X[c[k]].y, 0}),
            p.t)));
        if (!(d <= most)) most = d;
    }
    if (off) *off = most;
    return p;
}
