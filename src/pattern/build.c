#include "pattern/build.h"
#include "base/status.h"
#include "pattern/check.h"
#include "pattern/closed.h"
#include "pattern/pieces.h"
#include "pattern/plane.h"
#include "pattern/planar.h"
#include "pattern/points.h"
#include "pattern/sheet.h"
#include "pattern/source.h"

#include <string.h>

void rg_pattern_destroy(rg_pattern *p)
{
    if (!p) return;
    rg_memory mem = p->mem;
    rg_lines_free(&p->lines);
    rg_source_free(&p->source);
    RG_MEM_FREE(&mem, p->X, p->E, p->star_start, p->star, p->rim, p->closed, p->unfoldable, p->piece, p->still);
    rg_plane_free(p);
    rg_mem_free(&mem, p);
}

const rg_pattern_info *rg_pattern_get_info(const rg_pattern *p) { return &p->info; }

int32_t rg_pattern_closed(const rg_pattern *p, const rg_closed **list)
{
    *list = p->closed;
    return p->closed_triples;
}

int32_t rg_pattern_unfoldable(const rg_pattern *p, const rg_unfoldable **list)
{
    *list = p->unfoldable;
    return p->unfoldables;
}

int32_t rg_pattern_pieces(const rg_pattern *p, const rg_piece **list)
{
    *list = p->piece;
    return p->info.sheets;
}

void rg_pattern_own(const rg_pattern *p, const double x[2], double own[2])
{
    const rg_vec2 q = rg_lines_own(&p->lines, (rg_vec2){x[0], x[1]}, p->info.size);
    own[0] = q.x, own[1] = q.y;
}

int32_t rg_pattern_warnings(const rg_pattern *p, const rg_diag **list)
{
    *list = p->lines.warning;
    return p->lines.warnings;
}

static void count(struct rg_pattern *p)
{
    rg_pattern_info *info = &p->info;
    int32_t unseen = 0;
    for (int32_t v = 0; v < p->nv; v++) info->interior_vertices += !p->rim[v];
    for (int32_t e = 0; e < p->ne; e++) {
        const char a = p->E[e].assignment;
        info->boundary_edges += a == RG_BORDER;
        info->creases += a != RG_BORDER;
        info->mountains += a == RG_MOUNTAIN;
        info->valleys += a == RG_VALLEY;
        info->unassigned += a == RG_UNASSIGNED;
        info->flat += a == RG_FLAT;
        info->cuts += a == RG_CUT;
    }
    /* Of a drawing whose every crease lies on the border, or has no length, none is loose. */
    for (int32_t i = 0; info->creases == 0 && info->lost_creases == 0 && info->sheets <= 1 && i < p->lines.count; i++)
        unseen += p->lines.line[i].assignment != RG_BORDER && p->lines.line[i].assignment != RG_FLAT;
    info->lost_creases += unseen;
    info->degrees_of_freedom = info->creases - 3 * info->interior_vertices;
    info->title = p->lines.title ? p->lines.title : "";
    info->author = p->lines.author ? p->lines.author : "";
}

/* Most of the time goes by before; the rest is asked for now and then. RG_ECANCELLED: it is to end. */
static const double GRAPH_MADE = 0.95, STEP = 0.01;

static rg_status go_on(const rg_reading *r, int step, rg_diag *why)
{
    if (!r->progress || !r->progress(r->progress_ctx, GRAPH_MADE + STEP * step)) return RG_OK;
    return rg_fail(RG_ECANCELLED, why, 0, "%s", rg_status_text(RG_ECANCELLED));
}

static rg_status build(struct rg_pattern *p, const rg_reading *settings, rg_diag *why)
{
    rg_graph g = {.mem = p->mem};
    rg_walk walk = {.there = 0};
    rg_status s = rg_planar_from_lines(&p->lines, settings, &g, why);
    if (s == RG_OK) s = go_on(settings, 0, why);
    if (s == RG_OK) s = rg_pieces_find(&g, &p->lines, settings->sheet, &walk, &p->piece, &p->info.sheets, why);
    p->info.size = g.size;
    p->info.merged_max = g.merged_max;
    p->info.lost_creases = g.loose;
    p->info.unit = p->lines.metres;
    p->info.file_frames = p->lines.frames;
    if (p->lines.vertex) rg_walk_free(&walk); /* vertices are numbered anew */
    if (s == RG_OK) s = rg_source_sort(&g, &p->lines);
    if (s == RG_OK) s = rg_points_nearest(&p->mem, g.X, g.nv, &p->info.kept_min, NULL);
    if (s == RG_OK) s = go_on(settings, 1, why);
    if (s == RG_OK) s = rg_sheet_from_graph(&g, &walk, settings->merge * g.size, &p->lines, &p->info, &p->rim);
    if (s == RG_OK) s = go_on(settings, 2, why);
    if (s == RG_OK) s = rg_source_init(&p->source, &g, &p->lines);
    if (s != RG_OK) {
        rg_graph_free(&g);
        rg_walk_free(&walk);
        return s;
    }
    p->nv = g.nv;
    p->ne = g.ne;
    p->X = g.X;
    p->E = g.E;
    p->star_start = walk.star.start;
    p->star = walk.star.edge;
    walk.star = (rg_star){.mem = p->mem};
    rg_walk_free(&walk);
    count(p);
    s = go_on(settings, 3, why);
    if (s == RG_OK) s = rg_check_vertices(p);
    if (s == RG_OK) s = rg_closed_find(p);
    return s == RG_OK ? rg_plane_lend(p) : s;
}

rg_status rg_pattern_from_lines(rg_lines *lines, const rg_reading *s, rg_pattern **pattern, rg_diag *why)
{
    const rg_memory mem = lines->mem;
    struct rg_pattern *p = rg_mem_array(&mem, 1, sizeof *p);
    if (!p) {
        rg_lines_free(lines);
        return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    }
    p->mem = mem;
    p->merge = s->merge;
    p->lines = *lines;
    memset(lines, 0, sizeof *lines);
    rg_reading with = *s;
    if (s->merge == RG_MERGE_DEFAULT && p->lines.merge > 0) with.merge = p->lines.merge;
    rg_status status = build(p, &with, why);
    if (status != RG_OK) {
        rg_pattern_destroy(p);
        return status == RG_ENOMEM ? rg_fail(status, why, 0, "out of memory") : status;
    }
    rg_mem_free(&mem, p->lines.line);
    p->lines.line = NULL;
    rg_mem_free(&mem, p->lines.vertex);
    p->lines.vertex = NULL;
    p->lines.count = 0;
    p->lines.room = 0;
    *pattern = p;
    return RG_OK;
}
