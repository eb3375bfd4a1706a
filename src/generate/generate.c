#include "generate/generate.h"
#include "base/memory.h"
#include "base/status.h"
#include "generate/kinds.h"
#include "save/opx.h"

#include <stdio.h>
#include <string.h>

enum { LARGEST = 512, SEEDS = 1000000 };

/* A number that a kind takes: from ... to in steps, or none at all (to = 0). */
typedef struct range { int32_t from, to, step, usual; } range;

typedef struct kind {
    const char *name, *title;
    void (*draw)(rg_sketch *d);
    range n, m;               /* m.usual = 0: as n */
    double from, to, usual;   /* angle, degrees; to = 0: it takes none; usual = 0: the kind's own choice */
    double part;              /* how long the side of a part is drawn; 0: its parts are of many sizes */
} kind;

static const kind kinds[] = {
    {"miura", "Miura-ori", rg_miura_draw, {2, LARGEST, 1, 8}, {2, LARGEST, 1, 0}, 10, 85, 60, 1},
    {"waterbomb", "Waterbomb tessellation", rg_waterbomb_draw, {1, LARGEST, 1, 6}, {1, LARGEST, 1, 0}, 30, 80, 45, 2},
    {"hypar", "Pleated hypar", rg_hypar_draw, {2, LARGEST, 1, 8}, {0}, 0, 0, 0, 1},
    {"boxpleat", "Box pleats", rg_boxpleat_draw, {4, LARGEST, 2, 16}, {0}, 0, 0, 0, 1},
    {"yoshimura", "Yoshimura pattern", rg_yoshimura_draw, {1, LARGEST, 1, 6}, {2, LARGEST, 1, 0}, 5, 60, 30, 1},
    {"resch", "Resch's triangles", rg_resch_draw, {1, LARGEST, 1, 3}, {1, LARGEST, 1, 0}, 0, 0, 0, 1},
    {"kresling", "Kresling pattern", rg_kresling_draw, {4, LARGEST, 1, 6}, {1, LARGEST, 1, 0}, 5, 90, 0, 1},
    {"random", "Random Miura-ori", rg_random_draw, {2, LARGEST, 1, 8}, {1, SEEDS, 1, 0}, 0, 0, 0, 0},
    {"preliminary", "Preliminary fold", rg_preliminary_draw, {0}, {0}, 0, 0, 0, 0},
    {"waterbomb-base", "Waterbomb base", rg_waterbomb_base_draw, {0}, {0}, 0, 0, 0, 0},
    {"fish", "Fish base", rg_fish_draw, {0}, {0}, 0, 0, 0, 0},
    {"bird", "Bird base", rg_bird_draw, {0}, {0}, 0, 0, 0, 0},
    {"frog", "Frog base", rg_frog_draw, {0}, {0}, 0, 0, 0, 0},
    {"four-crane", "Four-crane base", rg_four_crane_draw, {0}, {0}, 0, 0, 0, 0},
    {"open-sink", "Waterbomb base, open sink", rg_open_sink_draw, {0}, {0}, 0, 0, 0, 0},
    {"crane", "Crane", rg_crane_draw, {0}, {0}, 0, 0, 0, 0},
    {"tatou", "Tatou", rg_tatou_draw, {0}, {0}, 0, 0, 0, 0},
    {"closed-split", "Closed vertices that splitting frees", rg_closed_split_draw, {0}, {0}, 0, 0, 0, 0},
    {"closed-adjust", "Closed vertices that adjusting frees", rg_closed_adjust_draw, {0}, {0}, 0, 0, 0, 0},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

const char *const *rg_generate_kinds(void)
{
    static const char *const names[] = {"miura", "waterbomb", "hypar", "boxpleat", "yoshimura", "resch", "kresling",
                                        "random", "preliminary", "waterbomb-base", "fish", "bird", "frog",
                                        "four-crane", "open-sink", "crane", "tatou", "closed-split", "closed-adjust",
                                        NULL};
    return names;
}

static const kind *find(const char *name)
{
    for (int i = 0; i < KINDS; i++)
        if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
    return NULL;
}

static rg_status check_number(const char *name, char letter, const range *r, int32_t *value, rg_diag *why)
{
    if (r->to == 0 && *value != 0) return rg_fail(RG_EARG, why, 0, "%s takes no %c", name, letter);
    if (r->to == 0) return RG_OK;
    if (*value == 0) *value = r->usual;
    if (*value < r->from || *value > r->to || *value % r->step != 0)
        return rg_fail(RG_EARG, why, 0, "%s takes an %c of %d to %d%s, not %d", name, letter, (int)r->from, (int)r->to,
                       r->step == 2 ? ", even" : "", (int)*value);
    return RG_OK;
}

static rg_status check_angle(const kind *k, double *angle, rg_diag *why)
{
    if (*angle == 0) *angle = k->usual * RG_DEG;
    if (*angle == 0) return RG_OK;
    if (k->to == 0) return rg_fail(RG_EARG, why, 0, "%s takes no angle", k->name);
    if (!(*angle >= (k->from - 1e-9) * RG_DEG && *angle <= (k->to + 1e-9) * RG_DEG)) /* degrees of a caller, rounded */
        return rg_fail(RG_EARG, why, 0, "%s takes an angle of %g to %g degrees, not %g", k->name, k->from, k->to,
                       *angle / RG_DEG);
    return RG_OK;
}

static rg_status set_title(rg_lines *l, const kind *k, int32_t n, int32_t m)
{
    char title[80];
    if (m > 0) snprintf(title, sizeof title, "%s, %d x %d", k->title, (int)n, (int)m);
    else if (n > 0) snprintf(title, sizeof title, "%s, %d", k->title, (int)n);
    else snprintf(title, sizeof title, "%s", k->title);
    l->title = rg_mem_string(&l->mem, title);
    return l->title ? RG_OK : RG_ENOMEM;
}

rg_status rg_generate_example(const char *name, const rg_example *e, const rg_memory *mem, rg_lines *out, rg_diag *why)
{
    int32_t n = e->n, m = e->m;
    double angle = e->angle;
    rg_lines_init(out, mem);
    const kind *k = find(name);
    if (!k) return rg_fail(RG_EARG, why, 0, "there is no kind \"%.40s\"", name);
    rg_status s = check_number(name, 'N', &k->n, &n, why);
    if (s == RG_OK && m == 0 && k->m.to > 0) m = n;
    if (s == RG_OK) s = check_number(name, 'M', &k->m, &m, why);
    if (s == RG_OK) s = check_angle(k, &angle, why);
    if (s != RG_OK) return s;
    if (e->cell > 0 && k->part == 0)
        return rg_fail(RG_EARG, why, 0, "%s has no parts of one size: say how large the sheet is", name);
    rg_sketch d = {.lines = out, .n = n, .m = m, .angle = angle};
    k->draw(&d);
    rg_drawing_fit(&d, e->side, k->part > 0 ? e->cell / k->part : 0);
    out->metres = e->unit;
    s = d.status == RG_OK ? set_title(out, k, n, m) : d.status;
    if (s == RG_OK) return RG_OK;
    rg_lines_free(out);
    return rg_fail(s, why, 0, "out of memory");
}

rg_status rg_generate_lines(const char *name, int32_t n, int32_t m, double angle, const rg_memory *mem, rg_lines *out,
                            rg_diag *why)
{
    return rg_generate_example(name, &(rg_example){.n = n, .m = m, .angle = angle}, mem, out, why);
}

static rg_status generate(const char *name, int32_t n, int32_t m, double angle, const rg_dest *to, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(NULL);
    rg_lines lines;
    rg_status s = rg_generate_lines(name, n, m, angle, &mem, &lines, why);
    if (s == RG_OK) s = rg_opx_write(&lines, to, why);
    rg_lines_free(&lines);
    return s;
}

rg_status rg_generate(const char *kind_name, int32_t n, int32_t m, double angle, const char *path, rg_diag *why)
{
    return generate(kind_name, n, m, angle, &(rg_dest){path, NULL}, why);
}

rg_status rg_generate_to(const char *kind_name, int32_t n, int32_t m, double angle, const rg_sink *sink, rg_diag *why)
{
    return generate(kind_name, n, m, angle, &(rg_dest){NULL, sink}, why);
}
