/* contacts.h -- sheets whose facets are in each other's way, folded by the program as it comes.  Include after paths.h.
 *
 * Each is folded with three numbers of frames, and its file judged by verify, which shares no code with what folds. It fails when
 *   it is not as expected: free, or not free, and told so
 *   it is told to be free, and its file is not valid
 *   another number of frames has another verdict */
#ifndef CONTACTS_H
#define CONTACTS_H

#include "by_hand.h"
#include "scenarios.h"

enum { CONTACT_FRAMES = 3 };
static const int32_t contact_frames[CONTACT_FRAMES] = {2, 60, 301};

typedef struct contact_of {
    const char *name, *what;
    rg_pattern *(*draw)(void);
    int is_free; /* as it has to come out; negative: either will do, if it is true */
} contact_of;

typedef struct contact_seen {
    rg_outcome outcome;
    int is_free, is_valid, same; /* with any number of frames */
    double percent, from, depth; /* folded, crosses from, how deep */
    double depth_plain, seconds, seconds_plain; /* with facets left as they are */
    int32_t states;              /* of 60 frames and what lies between them */
    char how[160], order[16];
} contact_seen;

/* A strip of n + 1 panels with these widths, and creases of these kinds. */
static inline rg_pattern *strip_of(int n, const double *width, const char *kinds)
{
    rg_lines l = drawing();
    double x = 0, all = 0;
    for (int i = 0; i <= n; i++) all += width[i];
    draw_box(&l, 0, 0, all, 1);
    for (int i = 0; i < n; i++) {
        x += width[i];
        draw(&l, kinds[i], x, 0, x, 1);
    }
    return pattern_of(&l);
}

static inline rg_pattern *draw_pleats(void)
{
    return strip_of(11, (const double[]){1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, "MVMVMVMVMVM");
}
static inline rg_pattern *draw_letter(void) { return strip_of(2, (const double[]){1, 1, 1}, "VV"); }
static inline rg_pattern *draw_roll(void) { return strip_of(4, (const double[]){1, 1.1, 1.2, 1.3, 1.4}, "VVVV"); }
static inline rg_pattern *draw_locked(void) { return strip_of(2, (const double[]){3, 1, 3}, "VV"); }
static inline rg_pattern *draw_by_hand(void)
{
    unsigned seed = 3;
    by_hand h;
    by_hand_any(&h, 3, &seed);
    return pattern_of(&h.lines);
}
static inline rg_pattern *draw_corner_over(void) { return base_and_corner(RG_VALLEY); }
static inline rg_pattern *draw_corner_under(void) { return base_and_corner(RG_MOUNTAIN); }
static inline rg_pattern *draw_waterbombs(void) { return of_kind("waterbomb", 6); }

static const contact_of contacts[] = {
    {"pleats", "a stack of twelve layers", draw_pleats, 1},
    {"letter", "two flaps over one panel: one has to be first", draw_letter, 1},
    {"roll", "five panels, each round those before", draw_roll, 1},
    {"by hand", "three folds, each over all layers", draw_by_hand, 1},
    {"corner over", "of a preliminary base, over its layers", draw_corner_over, 1},
    {"corner under", "the same corner, in between layers", draw_corner_under, -1},
    {"bird base", "flaps of one plane on each other", draw_bird, 1},
    {"box pleat", "closed vertices, layers that lie on each other", draw_boxpleat, 1},
    {"waterbombs", "6 x 6, comes into its own way", draw_waterbombs, 1},
    {"locked", "two flaps, each over the other's crease: no order of layers", draw_locked, 0},
};
enum { CONTACTS = sizeof contacts / sizeof *contacts };

typedef struct contact_bytes { char *at; size_t size, room; } contact_bytes;

static inline int contact_keep(void *ctx, const void *bytes, size_t size)
{
    contact_bytes *b = ctx;
    if (b->size + size > b->room) {
        b->room = 2 * (b->size + size);
        b->at = realloc(b->at, b->room);
        if (!b->at) fprintf(stderr, "out of memory\n"), exit(1);
    }
    memcpy(b->at + b->size, bytes, size);
    b->size += size;
    return 0;
}

static inline int contact_is_valid(const rg_motion *m)
{
    contact_bytes b = {NULL, 0, 0};
    const rg_sink sink = {contact_keep, &b};
    rg_certificate *c = NULL;
    rg_diag why = {0, ""};
    if (rg_motion_write_to(m, ".fold", 0, &sink, NULL, &why) != RG_OK ||
        rg_certificate_parse(b.at, b.size, NULL, NULL, &c, &why) != RG_OK)
        fprintf(stderr, "%s\n", why.text), exit(1);
    const int valid = rg_certificate_get_info(c)->valid;
    rg_certificate_destroy(c);
    free(b.at);
    return valid;
}

static inline contact_seen contact_look(const contact_of *of)
{
    contact_seen x = {.is_valid = 1, .same = 1};
    rg_pattern *p = of->draw();
    for (int n = 0; n <= CONTACT_FRAMES; n++) {
        rg_settings s = rg_settings_default();
        rg_motion *m = NULL;
        rg_diag why = {0, ""};
        const int plain = n == CONTACT_FRAMES;
        s.contact = plain ? RG_CONTACT_REPORT : RG_CONTACT_AVOID;
        if (!plain) s.frames = contact_frames[n];
        const double begun = rg_seconds();
        if (rg_motion_create(p, &s, NULL, NULL, &m, &why) != RG_OK) fprintf(stderr, "%s\n", why.text), exit(1);
        const double took = rg_seconds() - begun;
        const rg_report *r = rg_motion_report(m);
        const int is_free = r->outcome == RG_FOLDED && r->contact == RG_CONTACT_FREE;
        if (plain) {
            x.depth_plain = r->contact_depth, x.seconds_plain = took;
        } else {
            if (n == 0) x.is_free = is_free, x.outcome = r->outcome;
            x.same &= is_free == x.is_free && r->outcome == x.outcome;
            if (is_free) x.is_valid &= contact_is_valid(m);
            if (contact_frames[n] == 60) {
                x.percent = r->folded_percent, x.from = r->first_contact_percent, x.depth = r->contact_depth, x.seconds = took;
                x.states = rg_motion_states(m);
                snprintf(x.how, sizeof x.how, "%.150s", r->strategy);
                snprintf(x.order, sizeof x.order, "%.15s", r->layers ? r->layers : "");
            }
        }
        rg_motion_destroy(m);
    }
    rg_pattern_destroy(p);
    return x;
}

enum { UNEXPECTED, NOT_VALID, OTHER_VERDICT, CONTACT_CHECKS };

/* Non-zero: it fails that check. */
static inline int contact_fails(const contact_of *of, const contact_seen *x, int check)
{
    return check == UNEXPECTED ? of->is_free >= 0 && x->is_free != of->is_free : check == NOT_VALID ? !x->is_valid : !x->same;
}

#endif
