/* rigami.h -- folds origami crease patterns as rigid plates, after T. Tachi, "Simulation of Rigid Origami".
 *
 * Two layers, one header. The core makes patterns from arrays, folds, drives and measures, and needs little more than
 * libm. The whole library adds file formats, pictures, certificates and charts: what stands between `#ifndef
 * RIGAMI_CORE` and its `#endif`, so that whoever links the core alone and defines RIGAMI_CORE sees what there is.
 *
 * Signs and units, here and everywhere: fold angle rho in radians, valley positive, mountain negative, 0 flat, +-pi
 * folded flat. The sheet lies in z = 0 with y up; facets run counter-clockwise seen from +z; a valley turns its facets
 * towards +z. Lengths are those of the input file.
 *
 * Errors: functions return a status, 0 is RG_OK; results go through the last pointers and are untouched on failure,
 * unless said otherwise. No pointer is NULL, unless said otherwise, but for `why`, which always may be. Whatever asks
 * for memory may return RG_ENOMEM. The library never prints, never exits and keeps no global state.
 *
 * Ownership: what a call makes is its caller's, who destroys it; every destroy function takes NULL. A handle needs
 * none of those that it was made of, so that they may be destroyed in any order.
 *
 * Threads: distinct handles may be used by distinct threads at the same time. One and the same rg_pattern, rg_motion
 * or rg_certificate may be used by several as long as nobody changes it; an rg_fold, rg_layers or rg_tangent by one at
 * a time.
 *
 * Surroundings: floating point as a program begins with it, rounding to nearest, no exception trapped: infinities and
 * NaN are part of the work, and a thread that traps them (feenableexcept) is to let go of that for a call. Half a
 * megabyte of stack is enough for any call, whatever it reads.
 *
 * Growth: structs that a caller fills begin with `size` and are made by rg_..._default(), which sets it to what the
 * caller was compiled with; members that it does not know yet are taken at their defaults. Structs that the library
 * fills are lent by pointer and only grow at their ends. Elements of lists, and small structs passed by value
 * (rg_diag, rg_frame, rg_crease, ...), stay as they are.
 *
 * Borrowed: what is lent lives as long as the handle that lends it and, of an rg_fold, until it is next moved. */
#ifndef RIGAMI_H
#define RIGAMI_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Marks what the library shows. */
#if defined(__GNUC__)
#define RG_API __attribute__((visibility("default")))
#else
#define RG_API
#endif

/* Members of one major version link with each other; minor ones add, patches mend. */
#define RG_VERSION_MAJOR 0
#define RG_VERSION_MINOR 1
#define RG_VERSION_PATCH 0
#define RG_VERSION_NUMBER (RG_VERSION_MAJOR * 10000 + RG_VERSION_MINOR * 100 + RG_VERSION_PATCH)
#define RG_VERSION "0.1.0"

/* ---------------------------------------------------------------------------------------------- base ---- */

/* What functions return, as name and words: enum and texts are made of it. */
#define RG_STATUS_LIST(X)                                     \
    X(RG_OK, "success")                                       \
    X(RG_EARG, "an argument is out of range")                 \
    X(RG_ENOMEM, "out of memory")                             \
    X(RG_EREAD, "the input cannot be read")                   \
    X(RG_EFORMAT, "the input is not what its format asks for") \
    X(RG_ESHEET, "not one sheet without holes")               \
    X(RG_EWRITE, "the output cannot be written")              \
    X(RG_EABSENT, "this build has no such part")              \
    X(RG_ECANCELLED, "the caller's progress function ended it")

/* What became of a call; 0 is success. */
typedef enum rg_status {
#define X(name, words) name,
    RG_STATUS_LIST(X)
#undef X
} rg_status;

/* The words of the list above; for other numbers, words that say so. */
RG_API const char *rg_status_text(rg_status s);
/* Of the library that is linked: RG_VERSION and RG_VERSION_NUMBER are those it was compiled against. */
RG_API const char *rg_version(void);
RG_API int rg_version_number(void);

/* What is wrong and where: a line of the input file (1 is the first, 0: no line) and a sentence without full stop. */
typedef struct rg_diag {
    int line;       /* of the input file, from 1; 0: no line */
    char text[240]; /* a sentence without full stop; "" where nothing was said */
} rg_diag;

/* An allocator. resize(ctx, NULL, n) allocates, resize(ctx, p, n) moves, resize(ctx, p, 0) frees and returns NULL.
 * Blocks are aligned as malloc's. It need not be safe for threads as long as the handles that it is given to are not
 * used by several at a time: a search with it keeps to the calling thread; films ask in threads of theirs, one at a
 * time. */
typedef struct rg_memory {
    void *(*resize)(void *ctx, void *block, size_t bytes); /* NULL: there is none; the old block is then as it was */
    void *ctx;                                             /* handed on to it */
} rg_memory;

/* Called as something goes on with 0 ... 1, never less than before; a non-zero return ends it. In the thread of the
 * caller. */
typedef int (*rg_progress)(void *ctx, double progress);

/* The target of a crease that is nobody's: it follows the others. */
#define RG_FREE ((double)INFINITY)

/* How steps are made. */
typedef enum rg_method {
    RG_METHOD_AUTO,    /* adaptive straight on, and whatever else the pattern asks for */
    RG_METHOD_EULER,   /* the paper's eq. (14), one solve a step */
    RG_METHOD_NEWTON,  /* Euler steps, each closed to tolerance */
    RG_METHOD_HEUN,    /* order 2, each step closed */
    RG_METHOD_RK4,     /* order 4, each step closed */
    RG_METHOD_ADAPTIVE /* steps by an error estimate, frames from a dense output, each closed */
} rg_method;
/* How the linear system of a step is solved. */
typedef enum rg_solver {
    RG_SOLVER_AUTO,     /* by size */
    RG_SOLVER_CG,       /* conjugate gradients, as in the paper */
    RG_SOLVER_CHOLESKY, /* a sparse factor of C C^T */
    RG_SOLVER_SVD       /* the pseudo-inverse by singular values, for some hundred creases; RG_EABSENT without GSL,
                         * so in the core */
} rg_solver;
/* Which facets are cut into triangles by added creases. */
typedef enum rg_triangulation {
    RG_TRIANGULATE_AUTO, /* none, and where that stops short those that have to be, or all */
    RG_TRIANGULATE_NONE, /* as drawn */
    RG_TRIANGULATE_ALL   /* every facet with more than three corners */
} rg_triangulation;

/* What is done about facets that pass through each other. */
typedef enum rg_contact_mode {
    RG_CONTACT_AVOID,  /* look for a motion in which no facets pass through each other; as report, where none is
                        * found */
    RG_CONTACT_REPORT, /* take the plain motion, and say */
    RG_CONTACT_IGNORE  /* do not look */
} rg_contact_mode;
/* How much is tried when the plain way stops short. */
typedef enum rg_effort {
    RG_EFFORT_FAST,    /* little: a drawing at hand, many files */
    RG_EFFORT_NORMAL,  /* what ends within seconds for most patterns of a hundred creases */
    RG_EFFORT_THOROUGH /* all there is, for minutes */
} rg_effort;
/* What is kept of a pattern's symmetry. */
typedef enum rg_symmetry_kept {
    RG_SYMMETRY_AUTO, /* the pattern's own, or as much of it as folds */
    RG_SYMMETRY_OFF   /* none is looked for */
} rg_symmetry_kept;
/* Formats of crease pattern files. */
typedef enum rg_format {
    RG_FORMAT_AUTO, /* by content, then by extension */
    RG_FORMAT_OPX,  /* ORIPA's */
    RG_FORMAT_CP,   /* ORIHIME's */
    RG_FORMAT_FOLD, /* FOLD 1.2 */
    RG_FORMAT_SVG,  /* lines of drawings, by colour and dash */
    RG_FORMAT_DXF,  /* lines of drawings, by layer */
    RG_FORMAT_ORI   /* Oriedita's own */
} rg_format;

/* What frames are even in. */
typedef enum rg_pace {
    RG_PACE_PERCENT, /* frames even in folded percent */
    RG_PACE_STEADY   /* frames even in the largest angle that a crease turns */
} rg_pace;

/* What the input's format is usually drawn to: 1e-3 for .svg, else 2e-5. A hair above 2e-5, so that 2e-5 can be
 * asked for. */
#define RG_MERGE_DEFAULT 2.0000000000000005e-5

/* How a pattern is read, from a file, from memory or from arrays. Start from rg_reading_default(); NULL where one is
 * asked for is the same. What is out of range or NaN is refused, RG_EARG. Members end with what they are by default. */
typedef struct rg_reading {
    size_t size;             /* of this struct, as the caller has it */
    const rg_memory *memory; /* NULL: malloc; it must outlive what is made with it; NULL */
    double merge;            /* ends nearer than this part of the sheet's size are one vertex, 0 ... 0.1;
                              * RG_MERGE_DEFAULT */
    int aux_creases;         /* non-zero: auxiliary lines are creases that may fold; 0 */
    int targets;             /* non-zero: take the file's own fold angles where it has them; 1 */
    rg_format format;        /* of the input; auto */
    int32_t file_frame;      /* FOLD: the frame to read, from 0, the key frame; -1: the first that is a crease
                              * pattern; -1 */
    int flip;                /* non-zero: the file's y runs the other way than is usual for its format; 0 */
    const char *const *kind; /* [kinds] what lines of a drawing are, "KEY=KIND" each: KEY a colour, layer, name or
                              * dash, KIND border, cut, mountain, valley, unassigned, aux or none; the last that fits
                              * counts; borrowed; NULL */
    int32_t kinds;           /* at least 0; 0 */
    int32_t sheet;           /* of a drawing with several sheets, the one to take, from 1, in the order of the file;
                              * 0: there is one; 0 */
    double unit;             /* metres in a unit of the file, where that does not say it or says it wrongly, above 0,
                              * at most 1e9; 0: as it says; 0 */
    rg_progress progress;    /* asked while it reads, RG_ECANCELLED where it ends it; NULL: nobody; NULL */
    void *progress_ctx;      /* handed on to it */
} rg_reading;

/* size: sizeof(rg_reading) of the caller. */
RG_API void rg_reading_init(rg_reading *r, size_t size);
static inline rg_reading rg_reading_default(void)
{
    rg_reading r;
    rg_reading_init(&r, sizeof r);
    return r;
}

/* rg_settings.adjust: creases are moved where nothing else folds. */
#define RG_ADJUST_AUTO (-1.0)

/* How a pattern is folded. Start from rg_settings_default(); NULL where they are asked for is the same. What is out
 * of range or NaN is refused, RG_EARG. Members end with what they are by default. */
typedef struct rg_settings {
    size_t size;                  /* of this struct, as the caller has it */
    const rg_memory *memory;      /* NULL: malloc; it must outlive what is made with it; NULL */
    rg_triangulation triangulate; /* which facets are cut by added creases; auto */
    double adjust;                /* gain of crease adjustment (3.3), 0 ... 1; 0: off, RG_ADJUST_AUTO: where nothing
                                   * else folds; RG_ADJUST_AUTO */
    rg_contact_mode contact;      /* facets that pass through each other; avoid */
    rg_effort effort;             /* how much is tried when the plain way stops short; normal */
    int32_t layer_order;          /* which order of the flat end's layers a motion without contact has, from 0; -1:
                                   * one that folds; -1 */
    rg_symmetry_kept symmetry;    /* of the pattern with its mountains and valleys, in every state of the motion;
                                   * auto */
    rg_method method;             /* how steps are made; the report says which; auto */
    rg_solver solver;             /* how the linear system of a step is solved; auto */
    double step;                  /* largest change of any crease in one step, radians, 1e-7 ... pi; 5
                                   * degrees */
    double tol;                   /* closure tolerance: rotation angle of F at any vertex, radians, 1e-13 ... 0.1;
                                   * 1e-10 */
    double to;                    /* how far to fold, -1 ... 1 of every target; negative: mountain and valley
                                   * exchanged; 1 */
    int rest;                     /* non-zero: what undriven creases leave open ends where it rests, if that comes
                                   * before; 1 */
    int32_t frames;               /* frames of the motion, both ends included, at least 2; 60 */
    rg_pace pace;                 /* what frames are even in; percent */
    int32_t threads;              /* that the search may use, at least 1, of which it uses two at the most, and one with
                                   * a `memory`; 0: as many as there are processors. What comes of it does not depend
                                   * on them; 0 */
    int32_t fixed_facet;          /* number of the facet that stays where it is, from 0; -1: the one nearest the
                                   * centre; -1 */
} rg_settings;

/* size: sizeof(rg_settings) of the caller. */
RG_API void rg_settings_init(rg_settings *s, size_t size);
static inline rg_settings rg_settings_default(void)
{
    rg_settings s;
    rg_settings_init(&s, sizeof s);
    return s;
}

/* --------------------------------------------------------------------------------------------- pattern ---- */

/* A crease pattern as a plane graph. */
typedef struct rg_pattern rg_pattern;

/* A drawing in the caller's arrays. Start from rg_drawing_default(), which has none. */
typedef struct rg_drawing {
    size_t size;                /* of this struct, as the caller has it */
    int32_t vertices;           /* at least 1 */
    const double (*at)[2];      /* [vertices] where they are, y up, finite */
    int32_t edges;              /* at least 1 */
    const int32_t (*ends)[2];   /* [edges] numbers of vertices, from 0 */
    const char *assignment;     /* [edges] B border, M mountain, V valley, U unassigned, F auxiliary line, C cut in
                                 * the folded model */
    const double *target;       /* [edges] fold angle to aim at, radians, -pi ... pi; NAN: by assignment, RG_FREE:
                                 * none; NULL: all NAN */
    double unit;                /* metres in a unit of the coordinates, above 0, at most 1e9; 0: not known; 0 */
    const char *title, *author; /* NULL: none */
} rg_drawing;

/* size: sizeof(rg_drawing) of the caller. */
RG_API void rg_drawing_init(rg_drawing *d, size_t size);
static inline rg_drawing rg_drawing_default(void)
{
    rg_drawing d;
    rg_drawing_init(&d, sizeof d);
    return d;
}

/* A pattern from arrays, which are not needed afterwards. Lines may cross, and vertices lie in one place: it is a
 * drawing. Of `r` count memory, merge, aux_creases, targets, sheet and progress; NULL: the default. RG_EARG:
 * why->text says which number is out of range. Owner: the caller, rg_pattern_destroy. */
RG_API rg_status rg_pattern_create(const rg_drawing *d, const rg_reading *r, rg_pattern **pattern, rg_diag *why);
RG_API void rg_pattern_destroy(rg_pattern *pattern);

/* What is known of a pattern before it folds. */
typedef struct rg_pattern_info {
    int32_t vertices, edges, facets; /* of the plane graph, before straight-through vertices are dissolved */
    int32_t creases;                 /* N, after that */
    int32_t interior_vertices;       /* M, after that */
    int32_t boundary_edges;          /* N0, after that */
    int32_t degrees_of_freedom;      /* N - 3M */
    int32_t mountains, valleys, unassigned, flat; /* creases of each kind; flat: auxiliary lines that may fold */
    int32_t closed_vertices;         /* section 3.1 */
    int32_t maekawa_violations;      /* interior vertices where | M - V | is not 2 */
    double kawasaki_max_deg;         /* largest | every other angle - 180 | over interior vertices of even degree,
                                      * degrees */
    int32_t cuts;                    /* slits: border lines inside, counted with the creases */
    int32_t lost_creases;            /* drawn, but left out (loose ends) or taken for border; each is told in a
                                      * warning */
    int32_t sheets;                  /* pieces of paper in the drawing; rg_settings.sheet takes one */
    int32_t file_frames;             /* FOLD: frames of the file besides the key frame */
    double unit;                     /* metres in a unit of the file; 0: it does not say */
    double size;                     /* longer side of the bounding box, file units */
    double merged_max, kept_min;     /* largest distance merged, smallest kept, file units */
    int is_disk;                     /* one sheet without holes, slits or loose ends */
    char not_disk[240];              /* if not: what and where, in the file's coordinates */
    const char *title, *author;      /* "" where there is none; borrowed from the pattern */
} rg_pattern_info;

/* Borrowed from the pattern. */
RG_API const rg_pattern_info *rg_pattern_get_info(const rg_pattern *p);

/* The graph that is folded: what was merged, split and left out is behind it. Arrays are borrowed from the pattern. */
typedef struct rg_plane {
    int32_t vertices, edges, facets; /* facets: 0 where it is not one sheet */
    const double (*at)[2];           /* [vertices], y up */
    const int32_t (*ends)[2];        /* [edges] vertices */
    const char *assignment;          /* [edges] B exactly on the outer border, M V U, C for a slit */
    const double *target;            /* [edges] radians; NAN: none */
    const int32_t *line;             /* [edges] of the file, or edge of the drawing from 1; 0: none */
    const int32_t *facet_start;      /* [facets + 1] into facet_vertex */
    const int32_t *facet_vertex;     /* counter-clockwise */
} rg_plane;
RG_API const rg_plane *rg_pattern_get_plane(const rg_pattern *p);
/* The edge between two vertices, or nearest to a point (as the file has it, within 1 % of the sheet's size); -1:
 * there is none. */
RG_API int32_t rg_pattern_edge_between(const rg_pattern *p, int32_t v, int32_t w);
RG_API int32_t rg_pattern_edge_at(const rg_pattern *p, const double x[2]);
/* What the crease on an edge is to do when it is folded next: aim at an angle, radians, -pi ... pi; follow the
 * others, RG_FREE; or stay flat, so that the facets on both sides are one plate. Crease i of a fold is edge
 * rg_crease.edge. RG_EARG: no such edge or angle, or it is on the border. */
RG_API rg_status rg_pattern_set_target(rg_pattern *p, int32_t edge, double radians);
RG_API rg_status rg_pattern_pin(rg_pattern *p, int32_t edge);

/* A closed vertex (section 3.1): creases a, c, b are adjacent around the vertex, angle(a,c) = angle(c,b), a and b have
 * opposite assignments; creases are given by their far ends. */
typedef struct rg_closed {
    int32_t vertex;          /* of the pattern */
    double x, y;             /* where it is, y up; rg_pattern_own says where its file has it */
    double a[2], c[2], b[2]; /* far ends of the creases, the same */
    double inside_angle;     /* radians, 0 ... pi: between c and whichever of a, b has the assignment opposite to c's */
} rg_closed;

/* What a vertex that cannot fold flat breaks. */
typedef enum rg_theorem {
    RG_KAWASAKI,       /* every other angle adds up to 180 degrees */
    RG_MAEKAWA,        /* mountains and valleys differ by two */
    RG_DEGREE,         /* creases are even in number */
    RG_BIG_LITTLE_BIG, /* the smallest angle lies between a mountain and a valley */
    RG_TARGETS         /* at the file's own fold angles the paper closes */
} rg_theorem;

/* An interior vertex that cannot fold flat; it may be listed once for each theorem. */
typedef struct rg_unfoldable {
    int32_t vertex;     /* of the pattern */
    double x, y;        /* where it is, y up; rg_pattern_own says where its file has it */
    rg_theorem theorem; /* RG_DEGREE: an odd number of creases */
    double by;          /* degrees for Kawasaki, |M - V| for Maekawa, the number of creases for the degree;
                         * big-little-big: degrees by which a sector between two creases folded the same way is
                         * smaller than both others; targets: degrees by which the paper round the vertex misses
                         * itself at the file's own fold angles */
} rg_unfoldable;

/* Lists are borrowed from the pattern; how long one is, is returned. */
RG_API int32_t rg_pattern_closed(const rg_pattern *p, const rg_closed **list);
RG_API int32_t rg_pattern_unfoldable(const rg_pattern *p, const rg_unfoldable **list);
/* One of several sheets in a drawing: the box around it, in the file's coordinates, and how many lines it has. */
typedef struct rg_piece {
    double low[2], high[2]; /* corners of the box */
    int32_t lines;          /* at least 1 */
} rg_piece;
RG_API int32_t rg_pattern_pieces(const rg_pattern *p, const rg_piece **list);
/* A point of the pattern as its file has it: files that draw y downwards were turned round. */
RG_API void rg_pattern_own(const rg_pattern *p, const double x[2], double own[2]);
/* What was left out, merged or taken for something else; borrowed from the pattern. */
RG_API int32_t rg_pattern_warnings(const rg_pattern *p, const rg_diag **list);

/* ---------------------------------------------------------------------------------------------- layers ---- */

/* The orders in which the facets of a flat-folded pattern can lie on each other. Facets: those drawn, as rg_motion's
 * without added creases. One thread at a time for one handle. */
typedef struct rg_layers rg_layers;

/* What is known of the orders. */
typedef enum rg_layers_state {
    RG_LAYERS_VALID,   /* there is at least one order */
    RG_LAYERS_NONE,    /* there is none: no flat folding without paper passing through paper */
    RG_LAYERS_UNSOLVED, /* found out neither way within the work that is allowed */
    RG_LAYERS_NOT_FLAT /* the creases do not end flat, or do not close there */
} rg_layers_state;

/* The orders, counted; or why there is none. */
typedef struct rg_layers_info {
    rg_layers_state state;       /* whether there are any */
    int32_t facets, pairs;       /* of facets that overlap */
    int32_t settled;             /* pairs whose order is the same in all */
    int32_t parts;               /* groups of the other pairs, each ordered without regard to the others */
    const char *count;           /* how many orders, as decimal digits; "at least ..." where counting was given up;
                                  * borrowed */
    const char *rule;            /* NONE: what cannot be held: "taco-taco", "taco-tortilla", "tortilla-tortilla",
                                  * "transitivity", "mountain and valley", "all together", or "closing"; else "" */
    int32_t where_count;         /* NONE: a few facets, 16 at most, that have no order, whatever the others do */
    const int32_t *where;        /* their numbers */
    const double (*where_at)[2]; /* their centroids in the pattern, file coordinates */
    char reason[240];            /* in words, for every state but VALID */
} rg_layers_info;

/* One pair of a layer order, as FOLD's faceOrders: facet f lies above (+1) or below (-1) facet g, seen from the side
 * to which g's front faces. */
typedef struct rg_layers_pair {
    int32_t f, g; /* facets, from 0 */
    int32_t side; /* +1 or -1 */
} rg_layers_pair;

/* memory NULL: malloc. RG_OK whatever is found, read rg_layers_get_info; RG_ESHEET: not one sheet without holes.
 * Owner: the caller. */
RG_API rg_status rg_layers_create(const rg_pattern *p, const rg_memory *memory, rg_layers **layers, rg_diag *why);
RG_API void rg_layers_destroy(rg_layers *l);
/* Borrowed from the layers. */
RG_API const rg_layers_info *rg_layers_get_info(const rg_layers *l);
/* How many orders part i has, 0 <= i < info.parts; of orders too many to count, how many can be asked for. */
RG_API uint64_t rg_layers_part(const rg_layers *l, int32_t i);
/* pair[info.pairs]: out, the order that has the number which[i] within part i, each less than rg_layers_part; NULL:
 * all 0, the first order. RG_EARG: there is no such order; RG_ENOMEM. */
RG_API rg_status rg_layers_order(rg_layers *l, const uint64_t *which, rg_layers_pair *pair);
/* which[info.parts]: out, for order `index` of all, 0 the first; those of one part follow each other. RG_EARG: no
 * such order. */
RG_API rg_status rg_layers_which(const rg_layers *l, uint64_t index, uint64_t *which);

/* ---------------------------------------------------------------------------------------------- motion ---- */

/* A whole motion, flat to folded, frame by frame, with its measurements. Never changes, so that threads may share
 * one. */
typedef struct rg_motion rg_motion;

/* How it ended. */
typedef enum rg_outcome {
    RG_RUNNING, /* there is more to come */
    RG_FOLDED,  /* every driven crease is where it should be */
    RG_STOPPED, /* short of that: the reason says why */
    RG_RESTS    /* undriven creases leave its end open, and it has come to rest */
} rg_outcome;

/* One frame, in numbers. */
typedef struct rg_frame {
    double percent;          /* mean over driven creases of 100 rho / target, signed, each at most 100 */
    double closure_residual; /* radians, recomputed from the fold angles */
} rg_frame;

/* Do facets pass through each other? */
typedef enum rg_contact_verdict {
    RG_CONTACT_UNCHECKED, /* not looked for */
    RG_CONTACT_FREE,      /* not in any frame, nor surely between two */
    RG_CONTACT_CROSSES    /* they do */
} rg_contact_verdict;

/* One thing that the search for a motion tried. */
typedef struct rg_try {
    const char *rung, *direction; /* its name on the ladder of what is tried; "forward" or "backward" */
    double compliance;            /* how readily the pattern gave way, 0: not at all */
    int32_t symmetry;             /* order of the group that was kept, 1: none */
    int32_t added;                /* creases that cut facets */
    rg_outcome outcome;           /* how it ended */
    double percent;               /* how far it came, -100 ... 100 */
    double seconds;               /* that it took */
    char reason[200];             /* why it ended */
} rg_try;

/* A simple fold: layers on one side of a line, turned over it by half a turn. */
typedef struct rg_simple_turn {
    int32_t creases;       /* how many it makes, */
    const int32_t *crease; /* and which, by their numbers; of a crease that added ones cut, its parts */
    int over;              /* seen with the front of the facet nearest the sheet's middle up: +1 over the others, a
                            * valley fold; -1 behind */
    double line[2][2];     /* where that line is on the folded sheet, as that facet lies in the pattern; file
                            * coordinates */
} rg_simple_turn;

/* A part of a motion that goes in stages: simple folds that go together, or all of its creases at once. Borrowed, as
 * all it points to. */
typedef struct rg_folding_stage {
    int32_t first_frame, last_frame; /* it is folded flat in both, or not folded at all; with fewer frames than
                                      * stages, the nearest ones */
    int32_t creases;            /* how many it makes, */
    const int32_t *crease;      /* and which */
    int32_t folds;              /* how many simple folds; 0: all its creases at once */
    const rg_simple_turn *fold; /* these */
} rg_folding_stage;

/* A motion, measured. Degrees where the name ends in _deg, 0 ... 360; seconds of the wall clock; lengths are over
 * the sheet's size, the longer side of its bounding box. Counts are at least 0. All that it points to is borrowed
 * from the motion. */
typedef struct rg_report {
    const rg_pattern_info *pattern;  /* what is folded */
    int32_t added_creases;           /* by triangulation */
    int32_t unknowns;                /* creases, N */
    int32_t constraints;             /* 3 M */
    int32_t components;              /* groups of creases that no vertex joins, each folded apart */
    const char *triangulation;       /* "none", "some" or "all" facets are cut, */
    const char *why_triangulated;    /* and why */
    char strategy[160];              /* what got it there: triangulation, adjustment, drive */
    double adjust_gain;              /* of crease adjustment (3.3), 0 ... 1; 0: no crease was adjusted */
    double compliance;               /* how readily the pattern gave way; 0: not at all */
    const char *rung, *direction;    /* the try that is kept, as in rg_try */
    double seconds_of_winning_try;   /* that this try took */
    int32_t tries;                   /* until this motion, the first that folds, or the best */
    const char *method, *solver;     /* that were used, as words */
    int64_t steps, solves, cg_iterations, factorizations, assemblies; /* counted over all tries */
    double seconds_total;            /* until the motion was there, */
    double seconds_solving;          /* of them in steps */
    rg_outcome outcome;              /* how it ended, */
    char reason[360];                /* and why, in words */
    double folded_percent;           /* at the end: mean over driven creases of 100 rho / target, -100 ... 100, */
    double least_folded_percent;     /* and the least of any */
    double max_closure_residual;     /* over frames and vertices: rotation angle of F, radians, recomputed from the
                                      * fold angles */
    double max_edge_strain;          /* over frames and edges: | 3D length / pattern length - 1 | */
    double max_facet_gap;            /* over frames: distance of two placements of one vertex */
    double max_overfold_deg;         /* the most that a crease went beyond half a turn */
    double max_adjustment;           /* largest displacement of a vertex from the pattern given */
    double max_strain_from_original; /* over frames and edges: | 3D length / length in the pattern given - 1 | */
    int32_t symmetry;                /* order of the largest group of turns and mirrors that every frame has; 1: none */
    double max_asymmetry_deg;        /* over frames: largest difference of a crease to its image in that group */
    rg_contact_verdict contact;      /* do facets pass through each other, in frames, or surely between them? */
    int32_t first_contact_frame;     /* the first that crosses, or that the way to does; -1: none */
    double first_contact_percent;    /* of it, -100 ... 100; NAN: none */
    int32_t contact_facets[2];       /* which cross first; -1: none */
    double contact_at[2][2];         /* their middles in the pattern, file coordinates */
    int32_t contact_frames;          /* frames in which facets cross */
    int32_t deepest_contact_frame;   /* of these; -1: none */
    int32_t contact_pairs;           /* of facets that cross in that frame, */
    double contact_depth;            /* and how far the deepest would have to move to part, the shortest way; counts
                                      * from 1e-4 on */
    int32_t contact_unproved;        /* ways from frame to frame, before the first contact, that could not be proved
                                      * free; 0: all are */
    int isometric;                   /* non-zero: in every frame the border of the flat pattern is the border given,
                                      * and every facet congruent to its own */
    double moved_at_end;             /* largest displacement of a vertex in the last frame */
    double max_leap_deg;             /* the most that a driven crease turns from one frame to the next */
    double max_wrong_side_deg;       /* the most that a driven crease is on its wrong side in any frame */
    int32_t wrong_side_frames;       /* in so many frames by more than a tenth of a degree */
    int32_t wrong_side_creases;      /* driven creases that ended on the other side of flat than they should */
    int32_t blocking_vertex_count, blocking_crease_count; /* of what holds a motion that stopped short */
    const int32_t *blocking_vertices, *blocking_creases; /* their numbers in rg_sheet */
    const double (*blocking_at)[2];  /* where those vertices are, file coordinates */
    const char *layers;              /* of the flat end: "valid", "none", "unsolved" or "not flat" */
    const char *layer_orders;        /* how many, as rg_layers_info.count; "" unless valid */
    const char *layers_reason;       /* in words, unless valid */
    int32_t frame_count;             /* at least 1 */
    const rg_frame *frames;          /* [frame_count] */
    int32_t states, states_reached;  /* of a sequence of states; 0: the motion is of one pattern */
    const int32_t *state_frame;      /* [states_reached] the frame that is that state */
    int32_t by_flat_count;           /* ways from one state to the next that went through flat paper, */
    const int32_t *by_flat;          /* and the states, from 1, that they begin at */
    int32_t tried_count;             /* what was tried on the ladder, in its order, 64 of it at most, */
    const rg_try *tried;             /* [tried_count]; of a sequence of states: none */
    const rg_unfoldable *theorem;    /* a vertex that cannot be as it should, where that holds the motion; NULL:
                                      * there is none */
    int32_t stages;                  /* it is folded in so many, one after the other, as nothing is free all at once;
                                      * 0: at once */
    const rg_folding_stage *stage;   /* [stages] */
} rg_report;

/* Folds the pattern through all frames. RG_OK also when it stopped short: read rg_motion_report. progress: NULL, or
 * asked while it searches; ended by it, it is RG_OK as well, with what was found by then, "interrupted". RG_ESHEET:
 * not one sheet without holes, why->text says where; RG_EARG: settings, or no such facet. Owner: the caller,
 * rg_motion_destroy. */
RG_API rg_status rg_motion_create(const rg_pattern *p, const rg_settings *s, rg_progress progress, void *ctx,
                                  rg_motion **motion, rg_diag *why);
/* A crease that is driven. */
typedef struct rg_driven {
    int32_t edge;   /* of the pattern */
    double radians; /* where it is to end, -pi ... pi */
} rg_driven;
/* The same, but only driven[count] are driven, each from flat to its angle, frames even in them; all others follow
 * by the least motion that the facets allow, eq. (9), or stay flat where they are pinned. Near flat there are
 * several ways: the assignments decide. Facets are cut where that helps, unless s->triangulate is none. s: `to`,
 * `adjust`, `effort` do not count. RG_EARG: no such crease or angle. */
RG_API rg_status rg_motion_create_driven(const rg_pattern *p, int32_t count, const rg_driven *driven,
                                         const rg_settings *s, rg_progress progress, void *ctx, rg_motion **motion,
                                         rg_diag *why);
/* Walks through states of one sheet, each folded as its pattern says: from the first, folded, to the last. Creases
 * are matched by where they lie. Where the direct way to the next state is blocked, the sheet is unfolded to flat
 * and folded anew. All states are frames of the motion, whose percent is of the whole way; settings->to is 1 or -1.
 * One state: rg_motion_create. RG_ESHEET: not states of one sheet, why->text says what differs. RG_OK also when it
 * stopped short. */
RG_API rg_status rg_motion_create_states(const rg_pattern *const *states, int32_t count, const rg_settings *s,
                                         rg_progress progress, void *ctx, rg_motion **motion, rg_diag *why);
/* Are both of them one sheet each, and the same one? RG_ESHEET: why->text says what is wrong with `other`. */
RG_API rg_status rg_pattern_same_sheet(const rg_pattern *first, const rg_pattern *other, rg_diag *why);
RG_API void rg_motion_destroy(rg_motion *m);
RG_API const rg_report *rg_motion_report(const rg_motion *m); /* borrowed */

/* The sheet that is folded, for callers that draw it themselves: sizes, facets, creases. Its first edges are those
 * of the pattern, its first creases those that were drawn, in the same order; added ones come last. Arrays are
 * borrowed. */
typedef struct rg_sheet {
    int32_t vertices, creases, facets; /* how many there are */
    const int32_t *facet_start;        /* [facets + 1] into facet_vertex */
    const int32_t *facet_vertex;       /* counter-clockwise */
    const double (*flat)[2];           /* [vertices] in the pattern */
    int32_t edges;                     /* how many there are */
    int32_t added;                     /* creases added by triangulation: the last ones */
    const int32_t (*ends)[2];          /* [edges] vertices */
    const char *assignment;            /* [edges] B M V U F, C for a slit; F: added */
    const int32_t *edge_crease;        /* [edges] its crease, -1: border */
    const int32_t *crease_edge;        /* [creases] its edge */
    const int32_t (*edge_facet)[2];    /* [edges] the facet left of the way from its first end to its second, and
                                        * right of it; -1: none */
    int32_t triangles;                 /* that facets are drawn as, which need not be convex */
    const int32_t (*triangle)[3];      /* [triangles] vertices, counter-clockwise in the pattern */
    const int32_t *facet_triangle;     /* [facets + 1] into triangle */
} rg_sheet;
RG_API const rg_sheet *rg_motion_get_sheet(const rg_motion *m);
/* xyz[vertices]: out, positions of that frame, lengths as in the pattern; the fixed facet lies where it lies there, in
 * z = 0. RG_EARG: no such frame. */
RG_API rg_status rg_motion_pose(const rg_motion *m, int32_t frame, double (*xyz)[3]);
/* Fold angles of a frame, [creases], radians; those of the next frame follow them; borrowed; NULL: no such frame. */
RG_API const double *rg_motion_angles(const rg_motion *m, int32_t frame);
/* Whose fold angle is which: a crease of the sheet, as everything that is written numbers it. */
typedef struct rg_crease {
    int32_t vertices[2]; /* of rg_sheet */
    double at[2][2];     /* where they are, as the file has it: files that draw y downwards were turned round */
    char assignment;     /* M V U F, C for a slit */
    double target;       /* what was aimed at, radians; NAN: nothing */
    int added;           /* by triangulation */
    int32_t line;        /* of the file, 0: none */
    int32_t edge;        /* of rg_sheet and, unless it is added, of rg_plane */
} rg_crease;
/* RG_EARG: there is no such crease. */
RG_API rg_status rg_motion_crease(const rg_motion *m, int32_t crease, rg_crease *out);
/* The crease between two vertices, or nearest to a point (as the file has it, within 1 % of the sheet's size; drawn
 * ones only); -1: there is none. */
RG_API int32_t rg_motion_crease_between(const rg_motion *m, int32_t v, int32_t w);
RG_API int32_t rg_motion_crease_at(const rg_motion *m, const double x[2]);
/* How many ways the sheet could go from a frame to first order: creases less the rank of C, where N - 3M is only a
 * guess (3.2). In flat and flat-folded frames more than it really can. RG_EARG: no such frame; RG_ENOMEM. */
RG_API rg_status rg_motion_mobility(const rg_motion *m, int32_t frame, int32_t *ways);
/* The pattern of a frame, [vertices]: rg_sheet.flat unless creases were adjusted (3.3); borrowed; NULL: no such
 * frame. */
RG_API const double (*rg_motion_flat(const rg_motion *m, int32_t frame))[2];

/* ------------------------------------------------------------------------------------------------ fold ---- */

/* A fold that the caller moves: it has a present state, and a track of states that it has been in or will be. It is
 * found whole by rg_fold_create, so that stepping is quick and goes both ways; from any state on it may be given new
 * aims, and then finds its way step by step. One thread at a time for one handle. */
typedef struct rg_fold rg_fold;

/* What there is to say of the present state of a fold, and of the move that led there. */
typedef struct rg_step_info {
    rg_outcome outcome; /* of the track, once its last state is reached; RG_RUNNING while there is more to come */
    double progress;    /* 0 ... 1: mean over the driven creases of the part of its way that each is, none for more
                         * than all of it */
    int32_t frame;      /* the state of the track that it stands on, from 0; -1: between two of them */
    double closure;     /* largest rotation angle of F over the vertices, radians */
    int32_t solves;     /* linear solves of the call that led here, */
    int32_t iterations; /* and iterations of conjugate gradients in them */
    int32_t frames;     /* states of the track that are known */
    const char *reason; /* why it ended; "" while there is more to come */
    int32_t blocking_vertex_count, blocking_crease_count; /* 0 where nothing holds it */
    const int32_t *blocking_vertices, *blocking_creases; /* numbers in rg_sheet; of a track that stopped: what
                                                          * resists most, and what is held short */
} rg_step_info;

/* Looks for a motion, as rg_motion_create does and with what it says of `progress` and errors, and stands at its first
 * frame: the search happens here, as what folds a pattern is known only when it has come to its end. A motion that
 * stops short is no error: the last step says so. Owner: the caller, rg_fold_destroy. */
RG_API rg_status rg_fold_create(const rg_pattern *p, const rg_settings *s, rg_progress progress, void *ctx,
                                rg_fold **fold, rg_diag *why);
/* Stands on flat paper and looks for nothing: to be driven; steps go to what the pattern aims at as long as nothing
 * else was set. Facets as drawn, or all cut where s->triangulate is all. Errors and owner as above. */
RG_API rg_status rg_fold_create_flat(const rg_pattern *p, const rg_settings *s, rg_fold **fold, rg_diag *why);
RG_API void rg_fold_destroy(rg_fold *f);
/* The motion that was found, with its report; of a flat one, its sheet alone. Borrowed until rg_fold_destroy. */
RG_API const rg_motion *rg_fold_motion(const rg_fold *f);

/* ---- moving. What there is to say of the state that was reached is lent until the next move: by steps themselves, and
 * by rg_fold_get_info. */

/* Of the present state, without a move. */
RG_API const rg_step_info *rg_fold_get_info(const rg_fold *f);
/* On to the next state of the track, back to the one before; allocates nothing. Frames and their bits are those of
 * rg_motion_create with the same settings. After the last one, and before the first, it stays where it is. */
RG_API const rg_step_info *rg_fold_step(rg_fold *f);
RG_API const rg_step_info *rg_fold_step_back(rg_fold *f);
/* To the state where progress is so much, 0 ... 100, or as far as the track goes. A state of the track is met to the
 * bit; between two it is read off the path that the frames were read off, where that is kept, or off a polynomial
 * through the states about it, and closed. The first call allocates. RG_EARG: no such percent; RG_ENOMEM. */
RG_API rg_status rg_fold_go_to(rg_fold *f, double percent);
/* To the nearest state of the track where that crease has that angle, radians, looked for forwards first. RG_EARG:
 * there is none. */
RG_API rg_status rg_fold_go_to_angle(rg_fold *f, int32_t crease, double radians);

/* ---- steering. What is set here changes what comes after the present state, and forgets the rest of the track.
 * Steps then go on, even in the driven angles or, if none is driven, in progress, settings.frames from the present
 * state to the end. The pattern stays as it is in the present state. RG_EARG: no such crease or angle, fold and track
 * are as before; RG_ENOMEM. */

/* Creases are driven: each turns evenly from its present angle to that one, radians, -pi ... pi, whatever the others
 * do, which follow by the least motion that the facets allow, eq. (9). What cannot follow stops it. creases, radians:
 * [count]; of a crease that is there twice the last angle counts. */
RG_API rg_status rg_fold_drive(rg_fold *f, int32_t count, const int32_t *creases, const double *radians);
/* From now on this crease aims at an angle, radians, -pi ... pi, as far as the others let it; RG_FREE: at nothing. */
RG_API rg_status rg_fold_set_target(rg_fold *f, int32_t crease, double radians);
/* From now on it stays as it is, until it is driven or has a target again. */
RG_API rg_status rg_fold_pin(rg_fold *f, int32_t crease);
/* The present state becomes the first of the track, from which it goes on to what it aims at: what is steered for hours
 * keeps no more than it needs. */
RG_API rg_status rg_fold_forget(rg_fold *f);

/* ---- the present state; all borrowed until the fold is moved next */

/* Fold angles, radians, one per crease of rg_motion_get_sheet(rg_fold_motion(f)); creases may be NULL. */
RG_API const double *rg_fold_angles(const rg_fold *f, int32_t *creases);
/* Positions of the vertices, as rg_motion_pose has them; the pattern that the state is folded from, which is that of
 * the sheet unless creases were moved. */
RG_API const double (*rg_fold_positions(const rg_fold *f, int32_t *vertices))[3];
RG_API const double (*rg_fold_flat(const rg_fold *f, int32_t *vertices))[2];
/* Where each facet goes: x -> R x + t with R = (column[0] column[1] column[2]) and t = column[3], for x in the flat
 * pattern, z = 0. */
typedef struct rg_transform {
    double column[4][3]; /* of R, then t; lengths as in the pattern */
} rg_transform;
RG_API const rg_transform *rg_fold_transforms(const rg_fold *f, int32_t *facets);

/* ---- keeping states */

/* A state with its track and its aims. Restoring allocates nothing where the track fits, and leads to the same bits
 * from there on; it may be done many times. A snapshot belongs to the fold that it was taken of, or to its clones.
 * RG_EARG: another fold's. Owner: the caller, rg_snapshot_destroy. */
typedef struct rg_snapshot rg_snapshot;
RG_API rg_status rg_fold_snapshot(const rg_fold *f, rg_snapshot **snapshot);
RG_API rg_status rg_fold_restore(rg_fold *f, const rg_snapshot *snapshot);
RG_API void rg_snapshot_destroy(rg_snapshot *s);
/* Another fold in the same state, which moves by itself and may live longer; also in another thread, if the
 * allocator allows that. Owner: the caller, rg_fold_destroy. */
RG_API rg_status rg_fold_clone(const rg_fold *f, rg_fold **clone);
/* The track so far as a motion of its own, measured, with what lies between its states, to be written or drawn. Of a
 * fold that was steered several times, rg_frame.percent is of the whole way, each leg of it as long as any other, and
 * nothing is aimed at by all of it. Owner: the caller, rg_motion_destroy. */
RG_API rg_status rg_fold_record(const rg_fold *f, rg_motion **motion, rg_diag *why);

/* --------------------------------------------------------------------------------------------- tangent ---- */

/* The linear algebra of one state: C and what it leaves free, eqs. (5)-(9), (11)-(13). The state is copied. */
typedef struct rg_tangent rg_tangent;

/* Borrowed until rg_tangent_destroy. */
typedef struct rg_tangent_info {
    int32_t rows;              /* 3 M, three for each interior vertex in the order b, c, a */
    int32_t columns;           /* N, the creases */
    const int32_t *row_start;  /* [rows + 1] into column and value: C by compressed rows, eq. (8) */
    const int32_t *column;     /* [row_start[rows]] creases, rising in each row */
    const double *value;       /* [row_start[rows]] dimensionless: radians a radian */
    const double *residual;    /* [rows] r, eqs. (12), (13) */
    const int32_t *vertex;     /* [rows / 3] which vertex of the sheet */
    const double *angle;       /* [rows / 3] rotation angle of F there, radians, 0 ... pi */
} rg_tangent_info;

/* Of the present state; or of a frame of a motion. RG_EARG: no such frame; RG_ENOMEM. Owner: the caller,
 * rg_tangent_destroy. */
RG_API rg_status rg_fold_tangent(const rg_fold *f, rg_tangent **tangent);
RG_API rg_status rg_motion_tangent(const rg_motion *m, int32_t frame, rg_tangent **tangent);
RG_API void rg_tangent_destroy(rg_tangent *t);
RG_API const rg_tangent_info *rg_tangent_get_info(const rg_tangent *t);
/* step[columns]: out, wish - C^+ C wish, the nearest velocity that the facets allow, eq. (9); may be the same array.
 * reaction[rows]: out, y with step = wish - C^T y: how hard each vertex resists; NULL: not asked for. RG_EARG: a wish
 * is infinite or NaN. Allocates nothing. */
RG_API rg_status rg_tangent_project(rg_tangent *t, const double *wish, double *step, double *reaction);
/* An orthonormal basis of the infinitesimal motions, one after the other, [*freedoms][columns]; the degrees of
 * freedom are how many they are, and the rank of C is columns less that. Flat and flat-folded states have more than
 * they can go. basis may be NULL. Borrowed. The first call computes it. RG_ENOMEM. */
RG_API rg_status rg_tangent_basis(rg_tangent *t, int32_t *freedoms, const double **basis);

/* ================================================================================== the whole library ==== */
#ifndef RIGAMI_CORE

/* Where output goes that is not to be a file: called once or more with the bytes, in order, when all of them are
 * there; a non-zero return is RG_EWRITE. */
typedef struct rg_sink {
    int (*write)(void *ctx, const void *bytes, size_t size); /* size above 0 */
    void *ctx;                                               /* handed on to it */
} rg_sink;

/* ------------------------------------------------------------------------------------------------ read ---- */

/* Reads a crease pattern file: ORIPA's .opx, .cp, .fold, .svg or .dxf; "-" is standard input. RG_EREAD: no such
 * file; RG_EFORMAT: why->line and why->text say what is wrong. A pattern that is not one sheet without holes is read
 * all the same: rg_pattern_get_info says so, and folding it is refused. r NULL: the default. Owner: the caller,
 * rg_pattern_destroy. */
RG_API rg_status rg_pattern_read(const char *path, const rg_reading *r, rg_pattern **pattern, rg_diag *why);
/* The same from memory. */
RG_API rg_status rg_pattern_parse(const void *bytes, size_t size, const rg_reading *r, rg_pattern **pattern,
                                  rg_diag *why);
/* A motion that was written before, by this program or another one: a FOLD file with a flat crease pattern and
 * frames that have vertices_coords; nothing is folded. Facets may bend or stretch there: then angles are those
 * between facets as they lie. The report has the pattern, frames, strain and layers. RG_EREAD, RG_EFORMAT: why->text
 * says what is missing. */
RG_API rg_status rg_motion_read(const char *path, const rg_reading *r, rg_motion **motion, rg_diag *why);

/* Called with each warning: what was left out, what a format cannot hold. Lent for the call. */
typedef void (*rg_warning)(void *ctx, const rg_diag *warning);

/* One crease pattern file to another: every line and its assignment, titles, fold angles, as far as the format holds
 * them; what it does not hold is told to `warn` (may be NULL). "-" is standard input and output. `to`: the format of
 * `out`, AUTO: by its extension; .opx, .cp, .fold, .svg and .dxf are written. Lines stay where they are to 1e-9 of
 * the size, unless r->merge is other than the default. r: also memory, format, file_frame, flip, targets; NULL: the
 * default. RG_EREAD, RG_EFORMAT: of `in`; RG_EARG: no format that is written; RG_EWRITE: of `out`, which is written
 * whole or not at all. */
RG_API rg_status rg_convert(const char *in, const char *out, rg_format to, const rg_reading *r, rg_warning warn,
                            void *ctx, rg_diag *why);
/* The same from memory to a sink; `to` is not AUTO. */
RG_API rg_status rg_convert_to(const void *bytes, size_t size, rg_format to, const rg_sink *sink, const rg_reading *r,
                               rg_warning warn, void *ctx, rg_diag *why);

/* -------------------------------------------------------------------------------------------- generate ---- */

/* Writes an example crease pattern as .opx. `kind`: one of rg_generate_kinds(), a NULL-ended list of names. n, m: its
 * size (0: the kind's default; m = 0: the same as n; `random`: m is the seed). angle: radians, 0 for the kind's
 * default. path "-": standard output. RG_EARG: no such kind or size, why->text says so. Memory is malloc's here and in
 * rg_generate_to; those of rg_example, which do the same and more, and rg_generate_pattern take an allocator. */
RG_API const char *const *rg_generate_kinds(void);
RG_API rg_status rg_generate(const char *kind, int32_t n, int32_t m, double angle, const char *path, rg_diag *why);
/* The same to a sink; or as a pattern at once. r: as in rg_pattern_create. */
RG_API rg_status rg_generate_to(const char *kind, int32_t n, int32_t m, double angle, const rg_sink *sink,
                                rg_diag *why);
RG_API rg_status rg_generate_pattern(const char *kind, int32_t n, int32_t m, double angle, const rg_reading *r,
                                     rg_pattern **pattern, rg_diag *why);

/* An example in a size, a unit and a format. Start from rg_example_default(); NULL where one is asked for is the
 * same. */
typedef struct rg_example {
    size_t size;      /* of this struct, as the caller has it */
    int32_t n, m;     /* as for rg_generate */
    double angle;     /* the same */
    double side;      /* the sheet's longer side, in units of the file, 1e-9 ... 1e9; 0: 400 */
    double cell;      /* instead of it the side of a part, which is what rigami gen --help says for each kind, 1e-9 ...
                       * 1e9; 0: by `side` */
    double unit;      /* metres in a unit of the file, 1e-9 ... 1e9; 0: it says none */
    rg_format format; /* of what is written; AUTO: by the path's extension, .opx where it has none */
    const rg_memory *memory; /* NULL: malloc; NULL */
} rg_example;
/* size: sizeof(rg_example) of the caller. */
RG_API void rg_example_init(rg_example *e, size_t size);
static inline rg_example rg_example_default(void)
{
    rg_example e;
    rg_example_init(&e, sizeof e);
    return e;
}
/* Writes it whole or not at all. RG_EARG: no such kind, size or format; RG_EWRITE, RG_ENOMEM. */
RG_API rg_status rg_example_write(const char *kind, const rg_example *e, const char *path, rg_diag *why);
/* The same to a sink; format AUTO: .opx. */
RG_API rg_status rg_example_write_to(const char *kind, const rg_example *e, const rg_sink *sink, rg_diag *why);

/* ------------------------------------------------------------------------------------- write, render ---- */

/* Lines of pictures. */
typedef enum rg_lines_shown {
    RG_LINES_NONE,    /* facets alone */
    RG_LINES_CREASES, /* mountains red, valleys blue */
    RG_LINES_EDGES    /* all alike */
} rg_lines_shown;
/* What the colours of facets tell. */
typedef enum rg_colouring {
    RG_COLOUR_PAPER,  /* which side of the paper it is */
    RG_COLOUR_STRAIN, /* of a facet: largest | length of an edge in this frame / in the pattern given - 1 | */
    RG_COLOUR_ROLL,   /* how far its corners moved through the sheet */
    RG_COLOUR_SPEED,  /* the fastest of its creases, from the frame before */
    RG_COLOUR_LAYER   /* how high it lies among those that lie in its plane */
} rg_colouring;
/* How animations go on. */
typedef enum rg_loop {
    RG_LOOP_BACK,    /* there and back for ever */
    RG_LOOP_FORWARD, /* forward for ever */
    RG_LOOP_ONCE     /* to the end, and stay there */
} rg_loop;

/* What pictures and films look like, and models where they have it: paper colours, pace. Start from
 * rg_picture_default(); NULL where one is asked for is the same. What is out of range or NaN is refused, RG_EARG.
 * Members end with what they are by default. */
typedef struct rg_picture {
    size_t size;                     /* of this struct, as the caller has it */
    int32_t width, height;           /* pixels, 1 ... 16384; 960 x 720 */
    int aimed;                       /* 0: azimuth and elevation are chosen from the motion; non-zero: as they are
                                      * here; 0 */
    double azimuth, elevation;       /* of the camera about the sheet, radians, finite; -60 and 35 degrees */
    double zoom;                     /* above 0, at most 1000; 1: the sheet just fits in every frame; 1 */
    int targeted;                    /* non-zero: look at `target`; 0: at the sheet's middle as it is seen; 0 */
    double target[2];                /* a point of the sheet, as in the pattern, finite; (0, 0) */
    unsigned char front[3], back[3]; /* paper colours: red, green, blue, 0 ... 255; amber and cream */
    unsigned char background[3];     /* another such colour; dark grey */
    rg_lines_shown lines;            /* creases in their colours, all edges alike, or none; creases */
    double line_width;               /* over the usual one, 0.1 ... 10; 1 */
    double see_through;              /* part of the light that passes a facet, 0 ... 0.9; 0 */
    int shadow;                      /* non-zero: a soft one on the floor; 1 */
    int caption;                     /* non-zero: title and percent below; 0 */
    const char *title;               /* of what has none of its own, for captions and pages; borrowed; NULL: none;
                                      * NULL */
    const char *image;               /* path of a PNG file, printed on the paper's front, its upper side towards +y;
                                      * borrowed; NULL: none; NULL */
    rg_colouring colour;             /* what the colours of facets tell; paper */
    double fps;                      /* of animations: frames a second, 0.01 ... 1000; 30 */
    double hold;                     /* seconds for which an animation stands still at its end, 0 ... 60; 1 */
    double thickness;                /* of the paper in models to print (.stl), in units of the file, 0 ... 1e9; 0:
                                      * none, a surface; 0 */
    rg_loop loop;                    /* of animations: there and back for ever, forwards for ever, or once; back */
    rg_progress progress;            /* asked while it is written or drawn, RG_ECANCELLED where it ends it; NULL:
                                      * nobody; NULL */
    void *progress_ctx;              /* handed on to it; NULL */
    int resume;                      /* non-zero: numbered pictures that are there, of the same motion drawn the same
                                      * way, are kept; 0 */
    int steady;                      /* non-zero: films and pages have frames of their own, even in the largest angle
                                      * that a crease turns, whatever those of the motion are even in; 0 */
} rg_picture;

/* size: sizeof(rg_picture) of the caller. */
RG_API void rg_picture_init(rg_picture *p, size_t size);
static inline rg_picture rg_picture_default(void)
{
    rg_picture p;
    rg_picture_init(&p, sizeof p);
    return p;
}

/* One state as a picture of its own, with a camera that is framed on it alone: p->width x p->height pixels of red,
 * green, blue, the upper row first. rgb: out, 3 * width * height bytes. Of p, what animations need does not count.
 * RG_EARG: no such frame; RG_EABSENT: a build, or a machine, that cannot draw; RG_ENOMEM. */
RG_API rg_status rg_motion_draw(const rg_motion *m, int32_t frame, const rg_picture *p, unsigned char *rgb,
                                rg_diag *why);
RG_API rg_status rg_fold_draw(const rg_fold *f, const rg_picture *p, unsigned char *rgb, rg_diag *why);

/* RG_OK if a motion can be written to this path (by its shape and extension) in this build, else why->text says why
 * not: RG_EARG for an unknown form, RG_EABSENT for films where the program ffmpeg is missing. The forms are those of
 * docs/outputs.md; "-" is none of them, as nothing says what to write there. */
RG_API rg_status rg_output_check(const char *path, rg_diag *why);
/* Removes the temporary files that programs which were killed have left of outputs to this path, as every writer
 * does before it begins: of this user's only, and only what no living process is at. `mine` non-zero: those of this
 * process instead, for one that ends itself. */
RG_API void rg_output_sweep(const char *path, int mine);
/* Writes the motion in the form that the path's shape and extension ask for; each file is written to a temporary name
 * and renamed. `picture` NULL: the default. RG_EWRITE: why->text says what and why. */
RG_API rg_status rg_motion_write(const rg_motion *m, const char *path, const rg_picture *picture, rg_diag *why);
/* The same to a sink. form: an extension such as ".glb" or ".png". frame: which one, of forms that hold one; -1: the
 * last. RG_EARG: no such form or frame. */
RG_API rg_status rg_motion_write_to(const rg_motion *m, const char *form, int32_t frame, const rg_sink *sink,
                                    const rg_picture *picture, rg_diag *why);

/* JSON texts of a report and of what is known of a pattern. `file` "-": standard output; else written whole or not
 * at all. `seconds_writing` and `peak_bytes` are the caller's own measurements. */
RG_API rg_status rg_report_write(const rg_motion *m, double seconds_writing, double peak_bytes, const char *file,
                                 rg_diag *why);
RG_API rg_status rg_report_write_to(const rg_motion *m, double seconds_writing, double peak_bytes, const rg_sink *sink,
                                    rg_diag *why);
RG_API rg_status rg_info_write(const rg_pattern *p, const char *file, rg_diag *why);
RG_API rg_status rg_info_write_to(const rg_pattern *p, const rg_sink *sink, rg_diag *why);
/* The same for people: the verdict in a sentence and what to do next, what speaks against it, counts. `lists`
 * non-zero: also every vertex that is named in a count, creases, what the lines are drawn in, warnings. */
RG_API rg_status rg_info_text(const rg_pattern *p, int lists, const char *file, rg_diag *why);
RG_API rg_status rg_info_text_to(const rg_pattern *p, int lists, const rg_sink *sink, rg_diag *why);
/* What is wrong with a vertex, where and by how much, as part of a sentence: "at (0.5, 2) five creases meet ...". */
RG_API void rg_unfoldable_text(const rg_pattern *p, const rg_unfoldable *u, char text[240]);

/* ---------------------------------------------------------------------------------------------- verify ---- */

/* Is a motion that was written to a .fold file one that paper can make? Found again from the file alone, by code
 * that shares nothing with what folds: one and the same sheet, rigid facets, closed vertices, angles that are those
 * of the places, mountains and valleys, a steady path; no facets that pass through each other, in frames or, by
 * bounds that hold all the way, on rigid ways between them; and layers that are possible where it ends flat, which
 * rests on their order alone. */
typedef struct rg_certificate rg_certificate;

/* One thing that is wrong with a motion. */
typedef struct rg_fault {
    int32_t frame;    /* from 0, that or the way to it; -1: of the pattern */
    int32_t facet[2]; /* which, by their numbers in the file; -1: none */
    char text[200];   /* what, without full stop; with facets, it begins after them */
} rg_fault;

/* What was found of a motion, in numbers. */
typedef struct rg_certificate_info {
    int valid;                         /* non-zero: no fault */
    int32_t frames, facets, faults;    /* how many there are */
    double max_sheet;                  /* the farthest that the border of a frame's pattern is off the border given,
                                        * over the sheet's size */
    double max_rigid;                  /* the farthest that a corner is off its facet, over the sheet's size */
    double max_closure;                /* radians, over frames and inner vertices */
    double max_angle;                  /* the largest difference of an angle to the places, radians */
    double max_leap_deg;               /* the largest change of a mountain or valley from frame to frame, degrees */
    double max_wrong_side_deg;         /* the most that a crease is on the wrong side of flat on the way, degrees */
    double contact_depth;              /* the deepest crossing in a frame, over the sheet's size; 0: none above 1e-4 */
    double between_depth;              /* no crossing between frames is deeper than this */
    int ends_flat;                     /* non-zero: the last frame lies in a plane */
    int32_t layer_pairs, layers_shown; /* facets over each other at a flat end; of these, that were seen to
                                        * come in their order */
    int32_t between;                   /* states that the file has between frames; all above is of them, too */
} rg_certificate_info;

/* motion: a .fold file, "-" standard input. given: the pattern that it is to be a motion of, NULL: any. memory NULL:
 * malloc. RG_OK whatever is found: read the info; RG_EREAD, RG_EFORMAT: the file cannot be read as a motion. Owner:
 * the caller, rg_certificate_destroy. */
RG_API rg_status rg_certificate_create(const char *motion, const rg_pattern *given, const rg_memory *memory,
                                       rg_certificate **certificate, rg_diag *why);
/* The same of a file's bytes. */
RG_API rg_status rg_certificate_parse(const void *bytes, size_t size, const rg_pattern *given, const rg_memory *memory,
                                      rg_certificate **certificate, rg_diag *why);
RG_API void rg_certificate_destroy(rg_certificate *c);
/* Borrowed from the certificate. */
RG_API const rg_certificate_info *rg_certificate_get_info(const rg_certificate *c);
/* The first of the faults, at most 200; borrowed. */
RG_API int32_t rg_certificate_faults(const rg_certificate *c, const rg_fault **list);
/* For people, a line each; or as one JSON object. `file` "-": standard output; else written whole or not at all. */
RG_API rg_status rg_certificate_write(const rg_certificate *c, int json, const char *file, rg_diag *why);
RG_API rg_status rg_certificate_write_to(const rg_certificate *c, int json, const rg_sink *sink, rg_diag *why);

/* ----------------------------------------------------------------------------------------------- chart ---- */

/* Speed against accuracy for one pattern: every method with every solver over a range of steps, against the path in
 * closed form where there is one, else against one refined until it stands still. */
typedef struct rg_chart rg_chart;

/* Takes seconds to a minute. s: triangulate (auto: as drawn if that folds), frames, to, tol, memory; method and
 * solver are those of the chart. Stopped by `progress`, it holds what was done so far. RG_ESHEET; RG_EARG: no vertex
 * inside the sheet. Owner: the caller, rg_chart_destroy. */
RG_API rg_status rg_chart_create(const rg_pattern *p, const rg_settings *s, rg_progress progress, void *ctx,
                                 rg_chart **chart, rg_diag *why);
RG_API void rg_chart_destroy(rg_chart *c);
/* .csv: every run; .svg: the diagram; .md and "-": what it says, in words and tables. `title`: the pattern's name. */
RG_API rg_status rg_chart_write(const rg_chart *c, const char *title, const char *path, rg_diag *why);
/* form: ".csv", ".svg" or ".md". */
RG_API rg_status rg_chart_write_to(const rg_chart *c, const char *title, const char *form, const rg_sink *sink,
                                   rg_diag *why);

#endif /* RIGAMI_CORE */

#ifdef __cplusplus
}
#endif
#endif
