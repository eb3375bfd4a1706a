#include "write/svgfile.h"
#include "base/number.h"
#include "base/utf8.h"
#include "pattern/closed.h"
#include "pattern/faces.h"

#include <string.h>

/* Of the sheet's size. */
static const double MARGIN = 0.03, LINE = 0.0025, RING = 0.012, DISC = 0.007, DASH = 0.01;
static const double PIXELS = 800;

static void escaped(const char *text, FILE *out)
{
    for (const unsigned char *s = (const unsigned char *)text; *s;) {
        const size_t n = rg_utf8_character(s);
        if (*s == '&') fputs("&amp;", out);
        else if (*s == '<') fputs("&lt;", out);
        else if (*s == '>') fputs("&gt;", out);
        else if (!rg_utf8_in_xml(s, n) || *s == '\r') fputc('?', out);
        else fwrite(s, 1, n, out);
        s += n ? n : 1;
    }
}

static void attribute(const char *name, double x, FILE *out)
{
    char text[RG_NUMBER_ROOM];
    fprintf(out, " %s=\"%s\"", name, rg_number_print(text, x));
}

/* The frame whose pattern lies farthest from the one given. */
static const rg_vec2 *farthest_pattern(const rg_motion *m)
{
    const rg_vec2 *far = m->mesh.X;
    double most = 0;
    for (int32_t k = 0; m->flat && k < m->report.frame_count; k++) {
        const rg_vec2 *X = rg_motion_pattern(m, k);
        double distance = 0;
        for (int32_t v = 0; v < m->mesh.nv; v++)
            distance = fmax(distance, rg_vec2_length(rg_vec2_sub(X[v], m->mesh.X[v])));
        if (distance > most) most = distance, far = X;
    }
    return far;
}

/* The closed vertices of the pattern given: of the edges that were there before triangulation.
 * closed[nv]: out, non-zero at closed vertices. */
static rg_status find_closed(const rg_motion *m, unsigned char *closed)
{
    const rg_mesh *mesh = &m->mesh;
    rg_star star = {.mem = m->mem};
    struct rg_pattern p = {.mem = m->mem, .nv = mesh->nv, .X = mesh->X};
    rg_status s = RG_MEM_ARRAYS(&m->mem, RG_ARRAY(p.E, (size_t)mesh->ne), RG_ARRAY(p.rim, (size_t)mesh->nv));
    for (int32_t e = 0; s == RG_OK && e < mesh->ne; e++) {
        if (mesh->edge_crease[e] >= mesh->N - mesh->added) continue;
        rg_edge *E = &p.E[p.ne++];
        *E = (rg_edge){.v = {mesh->edge[e][0], mesh->edge[e][1]}, .assignment = mesh->assignment[e]};
        if (mesh->edge_crease[e] < 0) p.rim[E->v[0]] = p.rim[E->v[1]] = 1;
    }
    if (s == RG_OK) s = rg_star_init(&star, &m->mem, p.nv, p.ne, p.X, p.E);
    p.star_start = star.start;
    p.star = star.edge;
    if (s == RG_OK) s = rg_closed_find(&p);
    for (int32_t k = 0; s == RG_OK && k < p.closed_triples; k++) closed[p.closed[k].vertex] = 1;
    rg_star_free(&star);
    RG_MEM_FREE(&m->mem, p.E, p.rim, p.closed);
    return s;
}

static void head(const rg_motion *m, FILE *out)
{
    const rg_report *r = &m->report;
    rg_vec2 low = m->mesh.X[0], high = low;
    for (int32_t v = 1; v < m->mesh.nv; v++) {
        low = (rg_vec2){fmin(low.x, m->mesh.X[v].x), fmin(low.y, m->mesh.X[v].y)};
        high = (rg_vec2){fmax(high.x, m->mesh.X[v].x), fmax(high.y, m->mesh.X[v].y)};
    }
    const double margin = MARGIN * m->mesh.size, width = high.x - low.x + 2 * margin,
                 height = high.y - low.y + 2 * margin;
    const double scale = PIXELS / fmax(width, height);
    char a[RG_NUMBER_ROOM], b[RG_NUMBER_ROOM], c[RG_NUMBER_ROOM], d[RG_NUMBER_ROOM];
    fputs("<svg xmlns=\"http://www.w3.org/2000/svg\"", out);
    const double unit = r->pattern->unit; /* as large on paper as the file says, else as fits a screen */
    fprintf(out, " width=\"%s%s\"", rg_number_print(a, unit > 0 ? 1000 * unit * width : scale * width),
            unit > 0 ? "mm" : "");
    fprintf(out, " height=\"%s%s\"", rg_number_print(a, unit > 0 ? 1000 * unit * height : scale * height),
            unit > 0 ? "mm" : "");
    fprintf(out, " viewBox=\"%s %s %s %s\">\n<title>", rg_number_print(a, low.x - margin),
            rg_number_print(b, -high.y - margin), rg_number_print(c, width), rg_number_print(d, height));
    escaped(m->title && *m->title ? m->title : "crease pattern", out);
    fprintf(out, "</title>\n<desc>Folded by rigami %s to %s percent; %d closed vertices, %d creases added", RG_VERSION,
            rg_number_print(a, r->folded_percent), (int)r->pattern->closed_vertices, (int)r->added_creases);
    if (*r->reason) fputs(": ", out);
    escaped(r->reason, out);
    fputs("</desc>\n", out);
}

/* Mountains dash dot, valleys dashes, as folders draw them. */
static void dashes(char assignment, double size, FILE *out)
{
    char a[RG_NUMBER_ROOM], b[RG_NUMBER_ROOM], c[RG_NUMBER_ROOM];
    rg_number_print(a, 2 * DASH * size), rg_number_print(b, DASH * size), rg_number_print(c, DASH * size / 4);
    if (assignment == RG_MOUNTAIN) fprintf(out, " stroke-dasharray=\"%s %s %s %s\"", a, b, c, b);
    if (assignment == RG_VALLEY) fprintf(out, " stroke-dasharray=\"%s %s\"", a, b);
}

static void lines(const rg_motion *m, const rg_vec2 *X, FILE *out)
{
    /* In this order, so that what matters lies on top. */
    static const struct { char assignment; const char *id, *colour; } kind[] = {
        {RG_FLAT, "flat", "#999999"},   {RG_UNASSIGNED, "undecided", "#ff00ff"}, {RG_VALLEY, "valley", "#0000ff"},
        {RG_MOUNTAIN, "mountain", "#ff0000"}, {RG_BORDER, "border", "#000000"}};
    const rg_mesh *mesh = &m->mesh;
    fputs("<g fill=\"none\" stroke-linecap=\"round\"", out);
    attribute("stroke-width", LINE * mesh->size, out);
    fputs(">\n", out);
    for (size_t k = 0; k < sizeof kind / sizeof *kind; k++) {
        fprintf(out, "<g id=\"%s\" stroke=\"%s\"", kind[k].id, kind[k].colour);
        dashes(kind[k].assignment, mesh->size, out);
        fputs(">\n", out);
        for (int32_t e = 0; e < mesh->ne; e++) {
            if (mesh->assignment[e] != kind[k].assignment) continue;
            const rg_vec2 a = X[mesh->edge[e][0]], b = X[mesh->edge[e][1]];
            /* Creases by their number, as in .csv and the report; the border by that of its edge. */
            const int32_t crease = mesh->edge_crease[e];
            fprintf(out, "<line id=\"%s%d\"", crease < 0 ? "e" : "c", (int)(crease < 0 ? e : crease));
            attribute("x1", a.x, out);
            attribute("y1", -a.y, out);
            attribute("x2", b.x, out);
            attribute("y2", -b.y, out);
            fputs("/>\n", out);
        }
        fputs("</g>\n", out);
    }
    fputs("</g>\n", out);
}

static void circle(rg_vec2 at, double radius, FILE *out)
{
    fputs("<circle", out);
    attribute("cx", at.x, out);
    attribute("cy", -at.y, out);
    attribute("r", radius, out);
    fputs("/>\n", out);
}

static void marks(const rg_motion *m, const rg_vec2 *X, const unsigned char *closed, FILE *out)
{
    const double size = m->mesh.size;
    fputs("<g id=\"closed\" fill=\"none\" stroke=\"#008800\"", out);
    attribute("stroke-width", LINE * size, out);
    fputs("><title>closed vertices</title>\n", out);
    for (int32_t v = 0; v < m->mesh.nv; v++)
        if (closed[v]) circle(X[v], RING * size, out);
    fputs("</g>\n<g id=\"blocking\" fill=\"#ff8800\"><title>vertices that hold the fold</title>\n", out);
    for (int32_t k = 0; k < m->report.blocking_vertex_count; k++)
        circle(X[m->report.blocking_vertices[k]], DISC * size, out);
    fputs("</g>\n", out);
}

rg_status rg_svgfile_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out)
{
    (void)frame, (void)p;
    unsigned char *closed = rg_mem_array(&m->mem, (size_t)m->mesh.nv, 1);
    rg_status s = closed ? find_closed(m, closed) : RG_ENOMEM;
    if (s == RG_OK) {
        const rg_vec2 *X = farthest_pattern(m);
        head(m, out);
        lines(m, X, out);
        marks(m, X, closed, out);
        fputs("</svg>\n", out);
    }
    rg_mem_free(&m->mem, closed);
    return s;
}
