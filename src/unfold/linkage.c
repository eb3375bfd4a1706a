#include "unfold/linkage.h"

#include <string.h>

static void hang(rg_linkage *P)
{
    const rg_mesh *m = P->mesh;
    for (int32_t f = 0; f < m->nf; f++) {
        const int32_t via = P->tree.via[f];
        if (via < 0) {
            P->parent[f] = P->crease[f] = -1;
            continue;
        }
        const int left = m->edge_facet[via][0] == f; /* as rg_pose_facets turns it */
        P->parent[f] = m->edge_facet[via][left];
        P->crease[f] = m->edge_crease[via];
        P->ends[f][0] = m->edge[via][!left];
        P->ends[f][1] = m->edge[via][left];
    }
    for (int32_t v = 0; v < m->nv; v++) P->own[v] = P->tree.corner_facet[P->tree.corner_start[v]];
}

rg_status rg_linkage_init(rg_linkage *P, const rg_memory *mem, const rg_mesh *m)
{
    memset(P, 0, sizeof *P);
    P->mem = *mem;
    P->mesh = m;
    const size_t nf = (size_t)m->nf, nv = (size_t)m->nv;
    rg_status s = RG_MEM_ARRAYS(mem, RG_ARRAY(P->parent, nf), RG_ARRAY(P->crease, nf), RG_ARRAY(P->ends, nf),
                                RG_ARRAY(P->own, nv), RG_ARRAY(P->X, nv), RG_ARRAY(P->place, nf), RG_ARRAY(P->p, nv),
                                RG_ARRAY(P->axis, nf), RG_ARRAY(P->hinge, nf), RG_ARRAY(P->trial_X, nv),
                                RG_ARRAY(P->trial_place, nf), RG_ARRAY(P->turn, nf), RG_ARRAY(P->slip, nf));
    if (s == RG_OK) s = rg_freedom_init(&P->freedom, mem, m, 1);
    if (s == RG_OK) s = rg_constraint_init_moving(&P->K, mem, m, &P->freedom, 0);
    if (s == RG_OK) s = rg_coupled_init(&P->J, mem, &P->K, NULL);
    if (s == RG_OK) s = rg_tree_init(m, -1, &P->tree);
    if (s == RG_OK) {
        P->N = m->N;
        P->U = P->freedom.U;
        P->n = P->N + P->U;
        hang(P);
    } else {
        rg_linkage_free(P);
    }
    return s;
}

void rg_linkage_free(rg_linkage *P)
{
    if (!P->mem.resize) return;
    rg_tree_free(&P->tree);
    rg_coupled_free(&P->J);
    rg_constraint_free(&P->K);
    rg_freedom_free(&P->freedom);
    RG_MEM_FREE(&P->mem, P->parent, P->crease, P->ends, P->own, P->X, P->place, P->p, P->axis, P->hinge, P->trial_X,
                P->trial_place, P->turn, P->slip);
    memset(P, 0, sizeof *P);
}

static rg_vec3 across(const rg_mat3 *R, rg_vec2 x) { return rg_vec3_axpy(x.x, R->c[0], rg_vec3_scale(x.y, R->c[1])); }

static rg_vec3 put(const rg_place *g, rg_vec2 x) { return rg_vec3_add(across(&g->R, x), g->t); }

/* A state's pattern, facets and vertices. */
static void pose(rg_linkage *P, const double *z, rg_vec2 *X, rg_place *place, rg_vec3 *p)
{
    rg_freedom_move(&P->freedom, z + P->N, X);
    rg_pose_facets(P->mesh, X, &P->tree, z, place);
    for (int32_t v = 0; v < P->mesh->nv; v++) p[v] = put(&place[P->own[v]], X[v]);
}

void rg_linkage_positions(rg_linkage *P, const double *z, rg_vec3 *x) { pose(P, z, P->trial_X, P->trial_place, x); }

void rg_linkage_put(rg_linkage *P, const double *z)
{
    pose(P, z, P->X, P->place, P->p);
    for (int32_t f = 0; f < P->mesh->nf; f++) {
        if (P->parent[f] < 0) continue;
        const rg_vec2 a = P->X[P->ends[f][0]], d = rg_vec2_sub(P->X[P->ends[f][1]], a);
        const rg_place *under = &P->place[P->parent[f]];
        P->axis[f] = rg_vec3_scale(1 / rg_vec2_length(d), across(&under->R, d));
        P->hinge[f] = put(under, a);
    }
}

/* dphi = g . (dX_b - dX_a) */
static rg_vec2 turning(const rg_linkage *P, int32_t f)
{
    const rg_vec2 d = rg_vec2_sub(P->X[P->ends[f][1]], P->X[P->ends[f][0]]);
    const double squared = rg_vec2_dot(d, d);
    return (rg_vec2){-d.y / squared, d.x / squared};
}

static rg_vec2 pattern_step(const rg_linkage *P, const double *du, int32_t v)
{
    rg_vec2 d = {0, 0};
    for (int i = 0; i < 2; i++) {
        const int32_t way = P->freedom.way[v][i];
        if (way < 0) continue;
        d.x += du[way] * P->freedom.direction[way].x;
        d.y += du[way] * P->freedom.direction[way].y;
    }
    return d;
}

void rg_linkage_velocity(rg_linkage *P, const double *dz, rg_vec3 *dp)
{
    const double *du = dz + P->N;
    for (int32_t at = 0; at < P->mesh->nf; at++) {
        const int32_t f = P->tree.order[at], under = P->parent[f];
        if (under < 0) {
            P->turn[f] = P->slip[f] = (rg_vec3){0, 0, 0};
            continue;
        }
        const rg_mat3 *R = &P->place[f].R, *below = &P->place[under].R;
        const rg_vec2 a = pattern_step(P, du, P->ends[f][0]), b = pattern_step(P, du, P->ends[f][1]);
        const double dphi = rg_vec2_dot(turning(P, f), rg_vec2_sub(b, a));
        const rg_vec3 Q = P->hinge[f];
        rg_vec3 turn = rg_vec3_axpy(dz[P->crease[f]], P->axis[f], P->turn[under]);
        turn = rg_vec3_axpy(dphi, rg_vec3_sub(below->c[2], R->c[2]), turn);
        rg_vec3 slip = rg_vec3_add(P->slip[under], rg_vec3_cross(P->turn[under], Q));
        slip = rg_vec3_add(slip, rg_vec3_sub(across(below, a), across(R, a)));
        P->turn[f] = turn;
        P->slip[f] = rg_vec3_sub(slip, rg_vec3_cross(turn, Q));
    }
    for (int32_t v = 0; v < P->mesh->nv; v++) {
        const int32_t f = P->own[v];
        const rg_vec3 mine = across(&P->place[f].R, pattern_step(P, du, v));
        dp[v] = rg_vec3_add(rg_vec3_add(P->slip[f], rg_vec3_cross(P->turn[f], P->p[v])), mine);
    }
}

double rg_linkage_past_half_turn(const rg_linkage *P, const double *z)
{
    double most = 0;
    for (int32_t i = 0; i < P->N; i++) most = fmax(most, fabs(z[i]) - RG_PI);
    return most;
}

double rg_linkage_area(const rg_linkage *P, int32_t f, const rg_vec2 *X)
{
    const rg_vec2 *given = P->mesh->X;
    const int32_t *v = P->mesh->facet_vertex + P->mesh->facet_start[f];
    return rg_vec2_turn(X[v[0]], X[v[1]], X[v[2]]) / rg_vec2_turn(given[v[0]], given[v[1]], given[v[2]]);
}

double rg_linkage_least_area(rg_linkage *P, const double *u)
{
    const rg_mesh *m = P->mesh;
    double least = 1;
    rg_freedom_move(&P->freedom, u, P->trial_X);
    for (int32_t f = 0; f < m->nf; f++) {
        const double part = rg_linkage_area(P, f, P->trial_X);
        if (!(part >= least)) least = part;
    }
    return least;
}
