#include "options.h"
#include "guess.h"
#include "say.h"

#include <getopt.h>
#include <locale.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define DEG (3.14159265358979323846 / 180)

/* How the value of an option is read, and where to. */
typedef enum kind {
    SWITCH, WHOLE, REAL, ABOVE, CHOICE, TEXT, OUTPUT, KIND, FORM, PART,
    JOIN, FRAMES, SIZE, CAMERA, ADJUST, COLOURS, LINES, AIM, LENGTH
} kind;

typedef struct rule {
    int commands;            /* FOR_... */
    const char *name;
    char letter;             /* 0: none */
    const char *value;       /* what stands for it in the help; NULL: it takes none */
    kind kind;
    size_t at;               /* in options */
    double low, high;        /* ABOVE: low itself is refused; SWITCH: low is what it sets */
    double unit;             /* REAL, ABOVE: what the number is multiplied with */
    const char *const *list; /* CHOICE: names, by value */
    const char *help;
} rule;

static const char *const formats[] = {[RG_FORMAT_AUTO] = "auto", [RG_FORMAT_OPX] = "opx", [RG_FORMAT_CP] = "cp",
                                      [RG_FORMAT_FOLD] = "fold", [RG_FORMAT_SVG] = "svg", [RG_FORMAT_DXF] = "dxf",
                                      [RG_FORMAT_ORI] = "ori", NULL};
static const char *const methods[] = {[RG_METHOD_AUTO] = "auto", [RG_METHOD_EULER] = "euler",
                                      [RG_METHOD_NEWTON] = "newton", [RG_METHOD_HEUN] = "heun",
                                      [RG_METHOD_RK4] = "rk4", [RG_METHOD_ADAPTIVE] = "adaptive", NULL};
static const char *const solvers[] = {[RG_SOLVER_AUTO] = "auto", [RG_SOLVER_CG] = "cg",
                                      [RG_SOLVER_CHOLESKY] = "cholesky", [RG_SOLVER_SVD] = "svd", NULL};
static const char *const triangulations[] = {[RG_TRIANGULATE_AUTO] = "auto", [RG_TRIANGULATE_NONE] = "none",
                                             [RG_TRIANGULATE_ALL] = "all", NULL};
static const char *const symmetries[] = {[RG_SYMMETRY_AUTO] = "auto", [RG_SYMMETRY_OFF] = "off", NULL};
static const char *const paces[] = {[RG_PACE_PERCENT] = "percent", [RG_PACE_STEADY] = "steady", NULL};
static const char *const efforts[] = {[RG_EFFORT_FAST] = "fast", [RG_EFFORT_NORMAL] = "normal",
                                      [RG_EFFORT_THOROUGH] = "thorough", NULL};

static const char *const colourings[] = {
    [RG_COLOUR_PAPER] = "paper", [RG_COLOUR_STRAIN] = "strain", [RG_COLOUR_ROLL] = "roll",
    [RG_COLOUR_SPEED] = "speed", [RG_COLOUR_LAYER] = "layer",   NULL};
static const char *const loops[] = {
    [RG_LOOP_BACK] = "back", [RG_LOOP_FORWARD] = "forward", [RG_LOOP_ONCE] = "once", NULL};
static const char *const contacts[] = {[RG_CONTACT_AVOID] = "avoid", [RG_CONTACT_REPORT] = "report",
                                       [RG_CONTACT_IGNORE] = "ignore", NULL};

static const char *const units[] = {"file", "mm", "cm", "m", "in", "pt", NULL};
static const double metres[] = {0, 1e-3, 0.01, 1, 0.0254, 0.0254 / 72}; /* by place in `units` */

#define AT(field) offsetof(options, field)
#define READS (FOR_FOLD | FOR_INFO | FOR_CONVERT | FOR_CHART | FOR_VERIFY)
#define EVERY (READS | FOR_GEN | FOR_DRAW)
#define PICTURES (FOR_FOLD | FOR_DRAW)
#define NOTHING 0, 0, 1, NULL

static const rule rules[] = {
    {FOR_FOLD | FOR_DRAW, "output", 'o', "OUT", OUTPUT, 0, NOTHING,
     "write the motion to OUT, see below; may be given many times"},
    {FOR_CONVERT | FOR_GEN, "output", 'o', "OUT", OUTPUT, 0, NOTHING, "the file to write, - for standard output"},
    {FOR_CHART, "output", 'o', "DIR", OUTPUT, 0, NOTHING, "the folder to write to"},
    {FOR_FOLD | FOR_CHART, "frames", 0, "N", WHOLE, AT(settings.frames), 2, 1e6, 1, NULL,
     "frames from start to end, both included, evenly spaced in folded percent (60)"},
    {FOR_FOLD | FOR_CHART, "to", 0, "PCT", REAL, AT(settings.to), -100, 100, 0.01, NULL,
     "how far to fold, in percent; negative: mountain and valley exchanged (100)"},
    {FOR_FOLD | FOR_CHART, "targets", 0, NULL, SWITCH, AT(reading.targets), 1, 0, 1, NULL,
     "aim at the file's own fold angles where it has them (on)"},
    {FOR_FOLD | FOR_CHART, "no-targets", 0, NULL, SWITCH, AT(reading.targets), 0, 0, 1, NULL,
     "aim at 180 degrees everywhere"},
    {FOR_FOLD, "method", 0, "NAME", CHOICE, AT(method), 0, 0, 1, methods, "how steps are made (auto):"},
    {FOR_FOLD, "step", 0, "DEG", ABOVE, AT(settings.step), 0, 180, DEG, NULL,
     "largest step of any crease, degrees (5)"},
    {FOR_FOLD | FOR_CHART, "tol", 0, "T", REAL, AT(settings.tol), 1e-13, 0.1, 1, NULL,
     "closure tolerance, radians (1e-10)"},
    {FOR_FOLD, "solver", 0, "NAME", CHOICE, AT(solver), 0, 0, 1, solvers, "linear solver (auto):"},
    {FOR_FOLD | FOR_CHART, "triangulate", 0, "WHAT", CHOICE, AT(triangulate), 0, 0, 1, triangulations,
     "added creases; auto: only what the pattern needs (auto):"},
    {FOR_FOLD, "adjust", 0, "GAIN", ADJUST, 0, 0, 1, 1, NULL,
     "move vertices so that closed ones open: auto (where nothing else folds), off, or how strongly, such as 0.1 "
     "(auto)"},
    {FOR_FOLD, "symmetry", 0, "WHAT", CHOICE, AT(symmetry), 0, 0, 1, symmetries,
     "fold a symmetric pattern by its symmetry, or by as much of it as folds (auto):"},
    {FOR_FOLD, "pace", 0, "WHAT", CHOICE, AT(pace), 0, 0, 1, paces,
     "frames even in percent, or even in the largest angle that a crease turns (percent; films and pages steady):"},
    {FOR_FOLD, "effort", 0, "HOW", CHOICE, AT(effort), 0, 0, 1, efforts,
     "how much is tried when the plain way stops short (normal):"},
    {FOR_FOLD, "contact", 0, "WHAT", CHOICE, AT(contact), 0, 0, 1, contacts,
     "facets that pass through each other: look for a motion without, take the plain one and say, or do not look "
     "(avoid):"},
    {FOR_FOLD, "layers", 0, "N", WHOLE, AT(settings.layer_order), 0, INT32_MAX, 1, NULL,
     "which of the flat end's layer orders a motion without contact has, 0 the first (one that folds)"},
    {FOR_FOLD, "drive", 0, "CREASE=DEG", AIM, 0, AIM_DRIVE, 0, 1, NULL,
     "drive this crease, by its number or x,y of a point on it, to an angle; frames are even in it, the others follow; "
     "may be given many times"},
    {FOR_FOLD, "pin", 0, "CREASE", AIM, 0, AIM_PIN, 0, 1, NULL, "this crease stays flat; may be given many times"},
    {FOR_FOLD, "free", 0, "CREASE", AIM, 0, AIM_FREE, 0, 1, NULL,
     "nothing is wished of this crease, it follows the others; may be given many times"},
    {FOR_FOLD, "max-roll", 0, "PCT", REAL, AT(max_roll), 0, 100, 0.01, NULL,
     "the farthest that creases may move through the sheet on the way, in percent of its size; more ends with 1 (no "
     "limit)"},
    {FOR_FOLD, "fixed", 0, "FACET", WHOLE, AT(settings.fixed_facet), 0, INT32_MAX, 1, NULL,
     "the facet that stays where it is (the one nearest the middle)"},
    {READS, "from", 0, "FORMAT", CHOICE, AT(format), 0, 0, 1, formats,
     "the input's format; auto: by content, then by name (auto):"},
    {FOR_CONVERT, "as", 0, "FORMAT", CHOICE, AT(as), 0, 0, 1, formats,
     "the output's format; auto: by its name; ori is read only (auto):"},
    {FOR_FOLD, "frame", 0, "K[-L]", FRAMES, 0, NOTHING,
     "FOLD files: the frame to read, 0 is the key frame (the first crease pattern); several, such as 1-4, 1,3 or all, "
     "are states of one sheet"},
    {FOR_INFO | FOR_CONVERT | FOR_CHART, "frame", 0, "K", WHOLE, AT(reading.file_frame), 0, INT32_MAX, 1, NULL,
     "FOLD files: the frame to read, 0 is the key frame (the first crease pattern)"},
    {READS | FOR_DRAW, "flip", 0, NULL, SWITCH, AT(reading.flip), 1, 0, 1, NULL,
     "the file's y runs the other way than is usual for its format"},
    {FOR_BATCH, "merge", 0, "[=TOL]", JOIN, 0, 0, 0.1, 1, NULL,
     "fold nothing: join what the parts have in DIR to one table; with =TOL, as in rigami fold: ends nearer than this "
     "are one vertex"},
    {READS | FOR_DRAW, "merge", 0, "TOL", REAL, AT(reading.merge), 0, 0.1, 1, NULL,
     "ends nearer than this part of the sheet's size are one vertex (2e-5; .svg: 1e-3)"},
    {READS, "aux", 0, NULL, SWITCH, AT(reading.aux_creases), 1, 0, 1, NULL,
     "auxiliary lines are creases that may fold"},
    {READS, "line", 0, "KEY=KIND", KIND, 0, NOTHING,
     "drawings: what lines of a colour, layer, name or dash are: border, cut, mountain, valley, unassigned, aux or "
     "none; may be given many times"},
    {FOR_FOLD | FOR_INFO | FOR_CHART, "sheet", 0, "N", WHOLE, AT(reading.sheet), 1, INT32_MAX, 1, NULL,
     "of several sheets in a drawing the one to take, in the order of the file"},
    {PICTURES, "size", 0, "WxH", SIZE, 0, 1, 16384, 1, NULL, "pictures: width and height in pixels (960x720)"},
    {PICTURES, "camera", 0, "AZ,EL[,ZOOM[,X,Y]]", CAMERA, 0, NOTHING,
     "pictures: azimuth and elevation in degrees, zoom (1: the sheet just fits), and a point of the pattern to look at "
     "(chosen from the "
     "motion, 1, the sheet's middle)"},
    {PICTURES, "background", 0, "COLOUR", COLOURS, AT(picture.background), 1, 1, 1, NULL,
     "pictures: rrggbb or a name (323844)"},
    {PICTURES, "paper", 0, "FRONT,BACK", COLOURS, AT(picture.front), 2, 2, 1, NULL,
     "pictures: the two sides (f6b850,fcf8f0)"},
    {PICTURES, "lines", 0, "WHAT[,WIDTH]", LINES, 0, 0.1, 10, 1, NULL,
     "pictures: creases (mountains red, valleys blue), edges (all alike) or none, and how wide (creases,1)"},
    {PICTURES, "see-through", 0, "PCT", REAL, AT(picture.see_through), 0, 90, 0.01, NULL,
     "pictures: how much light passes a facet, in percent (0)"},
    {PICTURES, "no-shadow", 0, NULL, SWITCH, AT(picture.shadow), 0, 0, 1, NULL, "pictures: no shadow on the floor"},
    {PICTURES, "caption", 0, NULL, SWITCH, AT(picture.caption), 1, 0, 1, NULL,
     "pictures: title and percent at their lower edge"},
    {PICTURES, "image", 0, "FILE", TEXT, AT(picture.image), NOTHING,
     "pictures, .html, .glb, .gltf: a PNG printed on the paper's front"},
    {PICTURES, "colour", 0, "BY", CHOICE, AT(colour), 0, 0, 1, colourings,
     "pictures: what the colours of facets tell (paper):"},
    {PICTURES, "resume", 0, NULL, SWITCH, AT(picture.resume), 1, 0, 1, NULL,
     "DIR/, NAME-%04d.png: go on where the same command was interrupted; frames that are there are not drawn again"},
    {PICTURES, "thickness", 0, "T", REAL, AT(picture.thickness), 0, 1e9, 1, NULL,
     ".stl: plates so thick, in units of the file, joined at the creases: one closed solid to print (0: a surface)"},
    {READS | FOR_DRAW, "unit", 0, "UNIT", CHOICE, AT(unit), 0, 0, 1, units,
     "what a unit of the file is, where it does not say so or says it wrongly; models, drawings and cutters' files "
     "come out in that size (file):"},
    {PICTURES, "fps", 0, "N", REAL, AT(picture.fps), 0.01, 1000, 1, NULL, "animations: frames a second (30)"},
    {PICTURES, "loop", 0, "HOW", CHOICE, AT(loop), 0, 0, 1, loops,
     "animations: there and back, forward over and over, or once (back):"},
    {PICTURES, "hold", 0, "SEC", REAL, AT(picture.hold), 0, 60, 1, NULL, "animations: seconds to stay at the end (1)"},
    {FOR_FOLD, "report", 0, "FILE", TEXT, AT(report), NOTHING, "write a report as JSON, - for standard output"},
    {FOR_BATCH, "write", 0, "FORM", FORM, 0, NOTHING,
     "for each file also DIR/NAME.FORM: gif, fold, html, ...; may be given many times"},
    {FOR_BATCH, "jobs", 0, "N", WHOLE, AT(jobs), 1, 4096, 1, NULL,
     "files at a time, each on a processor of its own (as many as there are)"},
    {FOR_BATCH, "limit", 0, "SEC", REAL, AT(limit), 1, 1e6, 1, NULL,
     "seconds for one file, then it is told as a timeout (none)"},
    {FOR_BATCH, "part", 0, "K/N", PART, 0, NOTHING, "only every N-th file, from the K-th on: for several machines"},
    {FOR_BATCH, "verify", 0, NULL, SWITCH, AT(verify), 1, 0, 1, NULL,
     "judge each motion as rigami verify does, from DIR/NAME.fold, which is written"},
    {FOR_BATCH, "fresh", 0, NULL, SWITCH, AT(fresh), 1, 0, 1, NULL, "do not go on from what DIR has"},
    {FOR_INFO | FOR_VERIFY, "json", 0, NULL, SWITCH, AT(json), 1, 0, 1, NULL, "print one JSON object instead of text"},
    {FOR_GEN, "angle", 0, "DEG", ABOVE, AT(example.angle), 0, 180, DEG, NULL, "the kind's angle, degrees (its own)"},
    {FOR_GEN, "size", 0, "LENGTH", LENGTH, AT(example.side), 0, 1e9, 1, NULL,
     "the sheet's longer side, such as 150mm or 8.5in; without a unit the file says none (400)"},
    {FOR_GEN, "cell", 0, "LENGTH", LENGTH, AT(example.cell), 0, 1e9, 1, NULL,
     "instead: the side of one part, see below"},
    {EVERY, "max-seconds", 0, "SEC", REAL, AT(seconds), 0.001, 1e9, 1, NULL,
     "end after so long, as if interrupted: what there is then is written (any)"},
    {EVERY, "max-memory", 0, "MB", REAL, AT(megabytes), 1, 1e9, 1, NULL, "do with so much address space (any)"},
    {FOR_FOLD | FOR_INFO, "verbose", 'v', NULL, SWITCH, AT(verbose), 1, 0, 1, NULL,
     "everything that is known, with lists"},
    {EVERY, "quiet", 'q', NULL, SWITCH, AT(quiet), 1, 0, 1, NULL, "no warnings, no summary, no progress"},
    {FOR_FOLD | FOR_CHART | FOR_DRAW, "progress", 0, NULL, SWITCH, AT(progress), 1, 0, 1, NULL,
     "show progress on standard error (on a terminal)"},
    {FOR_FOLD | FOR_CHART | FOR_DRAW, "no-progress", 0, NULL, SWITCH, AT(progress), 0, 0, 1, NULL, "do not show it"},
    {EVERY, "help", 'h', NULL, SWITCH, AT(help), 1, 0, 1, NULL, "print this"},
    {EVERY, "version", 0, NULL, SWITCH, AT(version), 1, 0, 1, NULL, "print the version"},
};
enum { RULES = sizeof rules / sizeof *rules };

/* ------------------------------------------------------------------------------------------------ values ---- */

enum { LONGEST_NUMBER = 100 };

/* A decimal number and nothing else: no blanks, no hexadecimal, no infinity. Stops at the byte after it. */
static int number(const char *text, double *value, const char **end)
{
    const size_t n = strspn(text, "0123456789+-.eE");
    const char *point = memchr(text, '.', n), *sign = localeconv()->decimal_point; /* whoever may have set one */
    char copy[LONGEST_NUMBER + 20], *stop;
    *end = text;
    if (n == 0 || n > LONGEST_NUMBER || strlen(sign) > 16) return 0;
    const int before = (int)(point ? point - text : (ptrdiff_t)n);
    snprintf(copy, sizeof copy, "%.*s%s%.*s", before, text, point ? sign : "", point ? (int)n - before - 1 : 0,
             point ? point + 1 : "");
    *value = strtod(copy, &stop);
    *end = text + n;
    return *stop == 0 && isfinite(*value);
}

static int whole_text(const char *text, double *value)
{
    const char *end;
    return number(text, value, &end) && *end == 0;
}

static int refuse(const rule *r, const char *text, const char *what)
{
    say("--%s: \"%s\" is not %s", r->name, text, what);
    return ENDS_USAGE;
}

static int refuse_range(const rule *r, const char *text)
{
    char what[80];
    snprintf(what, sizeof what, "a %snumber %s %.10g %s %.10g", r->kind == WHOLE ? "whole " : "",
             r->kind == ABOVE ? "above" : "from", r->low, r->kind == ABOVE ? "and up to" : "to", r->high);
    return refuse(r, text, what);
}

static int set_number(const rule *r, const char *text, void *to)
{
    double v;
    if (!whole_text(text, &v) || !(v >= r->low && v <= r->high) || (r->kind == ABOVE && !(v > r->low)))
        return refuse_range(r, text);
    if (r->kind != WHOLE) *(double *)to = v * r->unit;
    else if (text[strspn(text, "0123456789")] != 0) return refuse_range(r, text);
    else *(int32_t *)to = (int32_t)v;
    return ENDS_WELL;
}

/* "auto, euler or newton" */
static void join(const char *const *list, char *out, size_t room)
{
    size_t n = 0;
    for (int i = 0; list[i] && n < room; i++)
        n += (size_t)snprintf(out + n, room - n, "%s%s", i == 0 ? "" : list[i + 1] ? ", " : " or ", list[i]);
}

static int set_choice(const rule *r, const char *text, int *to)
{
    char names[120] = "one of ";
    for (*to = 0; r->list[*to]; ++*to)
        if (strcmp(r->list[*to], text) == 0) return ENDS_WELL;
    join(r->list, names + 7, sizeof names - 7);
    return refuse(r, text, names);
}

static int set_size(const rule *r, const char *text, rg_picture *p)
{
    const size_t w = strspn(text, "0123456789"), h = text[w] ? strspn(text + w + 1, "0123456789") : 0;
    if (w > 0 && w < 9 && text[w] == 'x' && h > 0 && h < 9 && text[w + 1 + h] == 0) {
        p->width = (int32_t)atol(text);
        p->height = (int32_t)atol(text + w + 1);
        if (p->width >= r->low && p->width <= r->high && p->height >= r->low && p->height <= r->high) return ENDS_WELL;
    }
    return refuse(r, text, "a size such as 960x720, each from 1 to 16384");
}

static int set_camera(const rule *r, const char *text, rg_picture *p)
{
    double v[5] = {0, 0, p->zoom};
    const char *c = text;
    for (int i = 0; i < 5; i++) {
        const char *end;
        if (!number(c, &v[i], &end)) break;
        if (*end == 0 && i > 0 && i != 3 && fabs(v[0]) <= 360 && fabs(v[1]) <= 90 && v[2] >= 0.01 && v[2] <= 100) {
            p->aimed = 1;
            p->azimuth = v[0] * DEG;
            p->elevation = v[1] * DEG;
            p->zoom = v[2];
            p->targeted = i == 4;
            if (i == 4) p->target[0] = v[3], p->target[1] = v[4];
            return ENDS_WELL;
        }
        if (*end != ',') break;
        c = end + 1;
    }
    return refuse(r, text,
                  "AZ,EL or AZ,EL,ZOOM or AZ,EL,ZOOM,X,Y: -360 to 360 and -90 to 90 degrees, zoom 0.01 to 100");
}

/* A name or six hexadecimal digits, with or without a #. */
static int colour(const char *text, size_t n, unsigned char rgb[3])
{
    static const struct { const char *name; unsigned char rgb[3]; } names[] = {
        {"white", {255, 255, 255}}, {"black", {0, 0, 0}},     {"grey", {128, 128, 128}},  {"gray", {128, 128, 128}},
        {"red", {208, 64, 56}},     {"green", {80, 160, 88}}, {"blue", {72, 120, 208}},   {"yellow", {250, 214, 90}},
        {"orange", {246, 184, 80}}, {"pink", {242, 160, 176}}, {"purple", {150, 104, 184}}, {"brown", {150, 108, 72}}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strlen(names[i].name) == n && strncmp(names[i].name, text, n) == 0) {
            memcpy(rgb, names[i].rgb, 3);
            return 1;
        }
    if (n > 0 && *text == '#') text++, n--;
    if (n != 6 || strspn(text, "0123456789abcdefABCDEF") < 6) return 0;
    const long value = strtol((char[]){text[0], text[1], text[2], text[3], text[4], text[5], 0}, NULL, 16);
    for (int k = 0; k < 3; k++) rgb[k] = (unsigned char)(value >> (16 - 8 * k));
    return 1;
}

/* As many colours as r->low says, one behind the other. */
static int set_colours(const rule *r, const char *text, unsigned char *to)
{
    const char *c = text;
    for (int i = 0; i < (int)r->low; i++) {
        const size_t n = strcspn(c, ",");
        if (!colour(c, n, to + 3 * i) || (c[n] != 0) != (i + 1 < (int)r->low))
            return refuse(r, text,
                          r->low > 1 ? "two colours such as d04038,white" : "a colour such as 323844 or white");
        c += n + (c[n] != 0);
    }
    return ENDS_WELL;
}

static int set_lines(const rule *r, const char *text, rg_picture *p)
{
    static const char *const what[] = {
        [RG_LINES_NONE] = "none", [RG_LINES_CREASES] = "creases", [RG_LINES_EDGES] = "edges"};
    const size_t n = strcspn(text, ",");
    double wide = p->line_width;
    for (int i = 0; i < 3; i++) {
        if (strlen(what[i]) != n || strncmp(what[i], text, n) != 0) continue;
        if (text[n] && (!whole_text(text + n + 1, &wide) || !(wide >= r->low && wide <= r->high))) break;
        p->lines = (rg_lines_shown)i;
        p->line_width = wide;
        return ENDS_WELL;
    }
    return refuse(r, text, "creases, edges or none, and maybe a width from 0.1 to 10, such as edges,1.5");
}

/* A number and, if any, the name of a unit. */
static int set_length(const rule *r, const char *text, options *o, double *to)
{
    const char *end;
    double *unit = r->at == AT(example.side) ? &o->side_unit : &o->cell_unit;
    if (!number(text, to, &end) || !(*to > r->low && *to <= r->high))
        return refuse(r, text, "a length such as 150, 150mm or 8.5in");
    *unit = 0;
    for (int i = 1; *end && units[i]; i++)
        if (strcmp(units[i], end) == 0) *unit = metres[i];
    return *end && *unit == 0 ? refuse(r, text, "a length in mm, cm, m, in or pt, such as 150mm") : ENDS_WELL;
}

static int set_adjust(const rule *r, const char *text, rg_settings *s)
{
    double v = strcmp(text, "auto") == 0 ? RG_ADJUST_AUTO : 0;
    if (strcmp(text, "auto") != 0 && strcmp(text, "off") != 0 &&
        (!whole_text(text, &v) || !(v >= r->low && v <= r->high)))
        return refuse(r, text, "auto, off, or a number from 0 to 1");
    s->adjust = v;
    return ENDS_WELL;
}

/* Alone it is the batch's own; with a value, that of folding. */
static int set_join(const rule *r, const char *text, options *o)
{
    o->merge = text == NULL;
    return text ? set_number(&(rule){.name = r->name, .kind = REAL, .low = r->low, .high = r->high, .unit = 1}, text,
                             &o->reading.merge)
                : ENDS_WELL;
}

static int set_part(const rule *r, const char *text, options *o)
{
    const size_t a = strspn(text, "0123456789"), b = text[a] ? strspn(text + a + 1, "0123456789") : 0;
    const int is_part = a > 0 && a < 9 && text[a] == '/' && b > 0 && b < 9 && text[a + 1 + b] == 0;
    const int32_t k = is_part ? (int32_t)atol(text) : 0, n = is_part ? (int32_t)atol(text + a + 1) : 0;
    if (k >= 1 && k <= n) {
        o->part = k;
        o->parts = n;
        return ENDS_WELL;
    }
    return refuse(r, text, "K/N, such as 1/8: K from 1 to N");
}

/* K, K-L, lists of these with commas, or all: then there is one range from 1 to 0. */
static int set_frames(const rule *r, const char *text, options *o)
{
    free(o->range);
    o->ranges = 0;
    o->range = calloc(strlen(text) + 1, sizeof *o->range);
    if (!o->range) return refuse(r, text, "held: out of memory");
    if (strcmp(text, "all") == 0) {
        o->range[o->ranges++] = (frame_range){1, 0};
        return ENDS_WELL;
    }
    for (const char *c = text;; c++) {
        const size_t n = strspn(c, "0123456789");
        if (n == 0 || n > 9) break;
        frame_range *one = &o->range[o->ranges++];
        one->first = one->last = (int32_t)atol(c);
        c += n;
        const size_t m = *c == '-' ? strspn(c + 1, "0123456789") : 0;
        if (*c == '-' && (m == 0 || m > 9)) break;
        if (m) one->last = (int32_t)atol(c + 1), c += m + 1;
        if (one->last < one->first) break;
        if (*c == 0) {
            if (o->ranges == 1 && one->first == one->last) o->reading.file_frame = one->first;
            return ENDS_WELL;
        }
        if (*c != ',') break;
    }
    return refuse(r, text, "a frame, such as 2, or several, such as 1-4 or 1,3, or all");
}

static int set(options *o, const rule *r, const char *text)
{
    void *to = (char *)o + r->at;
    switch (r->kind) {
    case SWITCH: *(int *)to = (int)r->low; return ENDS_WELL;
    case CHOICE: return set_choice(r, text, to);
    case TEXT: *(const char **)to = text; return ENDS_WELL;
    case OUTPUT: o->output[o->outputs++] = text; return ENDS_WELL;
    case KIND: o->kind[o->reading.kinds++] = text; return ENDS_WELL;
    case AIM:
        o->aim[o->aims++] = (aim){r->low == AIM_DRIVE ? AIM_DRIVE : r->low == AIM_PIN ? AIM_PIN : AIM_FREE, text};
        return ENDS_WELL;
    case FORM: o->form[o->forms++] = text; return ENDS_WELL;
    case JOIN: return set_join(r, text, o);
    case PART: return set_part(r, text, o);
    case FRAMES: return set_frames(r, text, o);
    case SIZE: return set_size(r, text, &o->picture);
    case CAMERA: return set_camera(r, text, &o->picture);
    case ADJUST: return set_adjust(r, text, &o->settings);
    case COLOURS: return set_colours(r, text, to);
    case LENGTH: return set_length(r, text, o, to);
    case LINES: return set_lines(r, text, &o->picture);
    default: return set_number(r, text, to);
    }
}

/* ------------------------------------------------------------------------------------------------- parse ---- */

/* What getopt_long is to know of the command's options; its values are places in `rules`, above any letter. */
enum { FIRST = 256 };
enum { NAMED = 20 }; /* bytes of an option's whole name, with dashes and blanks; a word may be short for it */
/* Whether rule i is one of the command's: of two of one name it is the first. */
static int is_of(int bit, int i)
{
    if (!(rules[i].commands & bit)) return 0;
    for (int k = 0; k < i; k++)
        if ((rules[k].commands & bit) && strcmp(rules[k].name, rules[i].name) == 0) return 0;
    return 1;
}

static void tell_getopt(int bit, struct option *longs, char *shorts)
{
    int n = 0;
    shorts += sprintf(shorts, "-:"); /* operands in their order, whatever POSIXLY_CORRECT says; errors left to us */
    for (int i = 0; i < RULES; i++) {
        if (!is_of(bit, i)) continue;
        const int has_value = rules[i].kind == JOIN ? optional_argument
                              : rules[i].value      ? required_argument
                                                    : no_argument;
        longs[n++] = (struct option){rules[i].name, has_value, NULL, FIRST + i};
        if (rules[i].letter) shorts += sprintf(shorts, "%c%s", rules[i].letter, rules[i].value ? ":" : "");
    }
    memset(&longs[n], 0, sizeof *longs);
}

static const rule *rule_of(int bit, int code)
{
    if (code >= FIRST) return &rules[code - FIRST];
    for (int i = 0; code && i < RULES; i++)
        if ((rules[i].commands & bit) && rules[i].letter == code) return &rules[i];
    return NULL;
}

/* How many of the command's options begin with that word. */
static int beginning(int bit, const char *word)
{
    int n = 0;
    for (int i = 0; i < RULES && strncmp(word, "--", 2) == 0; i++)
        n += (rules[i].commands & bit) && strncmp(rules[i].name, word + 2, strcspn(word + 2, "=")) == 0;
    return n;
}

/* The option of the command that `word` is nearest to; NULL: it is near none. */
static const char *nearest(int bit, const char *word)
{
    const char *best = NULL;
    int least = 99;
    char name[40];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word + strspn(word, "-"), "="), word + strspn(word, "-"));
    for (int i = 0; i < RULES; i++) {
        const int d = guess_distance(name, rules[i].name);
        if (!(rules[i].commands & bit) || d >= least || !guess_is_near(name, rules[i].name, d)) continue;
        least = d;
        best = rules[i].name;
    }
    return best;
}

static int refuse_option(const command *c, int code, const char *word)
{
    const rule *r = rule_of(c->bit, optopt);
    if (code == ':' && r) say("--%s needs a value: %s", r->name, r->value);
    else if (r) say("--%s takes no value", r->name);
    else if (optopt && strncmp(word, "--", 2) != 0) say("unknown option -%c; try rigami %s --help", optopt, c->name);
    else if (beginning(c->bit, word) > 1) say("option %s could be several; try rigami %s --help", word, c->name);
    else if (nearest(c->bit, word))
        say("unknown option %s: did you mean --%s? rigami %s --help lists all", word, nearest(c->bit, word), c->name);
    else say("unknown option %s; try rigami %s --help", word, c->name);
    return ENDS_USAGE;
}

static int check_operands(const options *o, const command *c)
{
    int inputs = 0;
    for (int i = 0; i < o->operands; i++) inputs += strcmp(o->operand[i], "-") == 0;
    if (o->operands < c->least) say("%s: nothing is named; usage: rigami %s %s", c->name, c->name, c->operands);
    else if (o->operands > c->most) say("%s: \"%s\" is one too many", c->name, o->operand[c->most]);
    else if (inputs > 1) say("%s: standard input can be read only once", c->name);
    else return ENDS_WELL;
    return ENDS_USAGE;
}

/* What a fold depends on, word by word. */
static void note(options *o, const rule *r, const char *text)
{
    const int matters = (r->commands & FOR_FOLD) || r->kind == FORM || (r->kind == JOIN && text) || r->at == AT(verify);
    if (matters && r->kind != OUTPUT && strcmp(r->name, "quiet") != 0 && strcmp(r->name, "progress") != 0 &&
        strcmp(r->name, "no-progress") != 0)
        sprintf(o->said + strlen(o->said), "--%s %s ", r->name, text ? text : "");
}

/* Are all outputs films and pages, which run evenly in motion unless asked otherwise? */
static int only_animations(const options *o)
{
    static const char *const ends[] = {".gif", ".apng", ".mp4", ".webm", ".html"};
    int all = o->outputs > 0;
    for (int i = 0; i < o->outputs; i++) {
        const char *dot = strrchr(o->output[i], '.');
        int is = 0;
        for (int k = 0; dot && k < 5; k++) is |= strcasecmp(dot, ends[k]) == 0;
        all &= is;
    }
    return all;
}

static void settle(options *o)
{
    o->reading.format = (rg_format)o->format;
    o->reading.unit = metres[o->unit];
    o->settings.method = (rg_method)o->method;
    o->settings.solver = (rg_solver)o->solver;
    o->settings.triangulate = (rg_triangulation)o->triangulate;
    o->settings.symmetry = (rg_symmetry_kept)o->symmetry;
    o->settings.pace = o->pace >= 0 ? (rg_pace)o->pace : only_animations(o) ? RG_PACE_STEADY : RG_PACE_PERCENT;
    o->picture.steady = o->pace < 0;
    o->settings.effort = (rg_effort)o->effort;
    o->picture.colour = (rg_colouring)o->colour;
    o->picture.loop = (rg_loop)o->loop;
    o->settings.contact = (rg_contact_mode)o->contact;
    int has_fold = !o->verify;
    for (int i = 0; i < o->forms; i++) has_fold |= strcmp(o->form[i], "fold") == 0;
    if (!has_fold) o->form[o->forms++] = "fold"; /* what is judged; there is room, as --verify is a word too */
}

int options_parse(options *o, const command *c, int argc, char **argv)
{
    struct option longs[RULES + 1];
    char shorts[3 * RULES + 3];
    *o = (options){.settings = rg_settings_default(),
                   .reading = rg_reading_default(),
                   .picture = rg_picture_default(),
                   .example = rg_example_default(),
                   .progress = -1,
                   .pace = -1,
                   .max_roll = INFINITY,
                   .effort = RG_EFFORT_NORMAL};
    o->operand = calloc((size_t)argc + 1, sizeof *o->operand);
    o->output = calloc((size_t)argc + 1, sizeof *o->output);
    o->kind = calloc((size_t)argc + 1, sizeof *o->kind);
    o->form = calloc((size_t)argc + 1, sizeof *o->form);
    o->aim = calloc((size_t)argc + 1, sizeof *o->aim);
    o->reading.kind = o->kind;
    size_t words = 1;
    for (int i = 0; i < argc; i++) /* each letter of -qv is an option */
        words += strlen(argv[i]) + NAMED * (argv[i][0] == '-' && argv[i][1] != '-' ? strlen(argv[i]) : 1);
    o->said = calloc(words, 1);
    if (!o->operand || !o->output || !o->kind || !o->form || !o->aim || !o->said) {
        say("out of memory");
        return ENDS_UNWRITTEN;
    }
    tell_getopt(c->bit, longs, shorts);
    opterr = 0;
    optind = 1;
    for (int code; (code = getopt_long(argc, argv, shorts, longs, NULL)) != -1;) {
        const rule *r = code == 1 ? NULL : rule_of(c->bit, code);
        if (code == '?' || code == ':') return refuse_option(c, code, argv[optind - 1]);
        if (r && strcmp(r->name, "to") == 0) o->settings.rest = 0; /* who says how far gets that */
        if (code == 1) o->operand[o->operands++] = optarg;
        else if (r && set(o, r, optarg) != ENDS_WELL) return ENDS_USAGE;
        if (o->help || o->version) return ENDS_WELL;
        if (r) note(o, r, optarg);
    }
    while (optind < argc) o->operand[o->operands++] = argv[optind++];
    settle(o);
    return check_operands(o, c);
}

void options_free(options *o)
{
    free(o->operand);
    free(o->output);
    free(o->kind);
    free(o->form);
    free(o->aim);
    free(o->range);
    free(o->said);
    memset(o, 0, sizeof *o);
}

/* -------------------------------------------------------------------------------------------------- help ---- */

enum { COLUMN = 25, WIDTH = 79 };

static void wrap(const char *text, FILE *out)
{
    int at = COLUMN;
    while (*text) {
        const int n = (int)strcspn(text, " ");
        if (at + 1 + n > WIDTH) at = fprintf(out, "\n%*s", COLUMN, "") - 1;
        at += fprintf(out, "%s%.*s", at == COLUMN ? "" : " ", n, text);
        text += n + (text[n] == ' ');
    }
}

/* "  -o, --output OUT", then the help beside it or, where that is too long, below it. */
static void help_option(const rule *r, FILE *out)
{
    char text[400], names[120] = "";
    int at = r->letter ? fprintf(out, "  -%c, --%s", r->letter, r->name) : fprintf(out, "      --%s", r->name);
    if (r->value) at += fprintf(out, " %s", r->value);
    if (at >= COLUMN) fputc('\n', out), at = 0;
    fprintf(out, "%*s", COLUMN - at, "");
    if (r->list) join(r->list, names, sizeof names);
    snprintf(text, sizeof text, "%s%s%s", r->help, r->list ? " " : "", names);
    wrap(text, out);
    fputc('\n', out);
}

int options_words(int bit, const char *option, FILE *out)
{
    int n = 0;
    for (int i = 0; i < RULES; i++) {
        if (!(rules[i].commands & bit)) continue;
        if (!option) n += fprintf(out, "--%s\n", rules[i].name) > 0;
        for (int k = 0; option && strcmp(option, rules[i].name) == 0 && rules[i].list && rules[i].list[k]; k++)
            n += fprintf(out, "%s\n", rules[i].list[k]) > 0;
    }
    return n;
}

void options_help(const command *c, FILE *out)
{
    fprintf(out, "Usage: rigami %s %s\n%s\n\n", c->name, c->operands, c->summary);
    for (int i = 0; i < RULES; i++)
        if (is_of(c->bit, i)) help_option(&rules[i], out);
    if (c->notes[0]) fprintf(out, "\n%s", c->notes);
}
