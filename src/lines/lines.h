/* lines.h -- what a reader hands on: line segments with assignments, as drawn.
 * Used by  every reader, save, generate, pattern */
#ifndef RG_LINES_H
#define RG_LINES_H

#include "base/stop.h"
#include "base/vec.h"
#include "rigami.h"

/* Assignments are FOLD's letters. */
#define RG_BORDER 'B'
#define RG_MOUNTAIN 'M'
#define RG_VALLEY 'V'
#define RG_FLAT 'F' /* auxiliary line, or a crease added by triangulation: no wish of its own */
#define RG_UNASSIGNED 'U'
#define RG_CUT 'C' /* where the folded model is cut, no part of the pattern; a cut in the paper is a border inside it */

/* Coordinates are no larger than this, whatever the format: areas and volumes of them still are finite. */
#define RG_LARGEST_COORDINATE 1e100
/* Bytes of a title, a memo and the like, which are cut there: libxml2 takes ten times as many, and no more. */
enum { RG_MOST_TEXT = 1000000 };

typedef struct rg_line {
    rg_vec2 a, b;      /* y up */
    double target;     /* wished final fold angle, radians; NAN: by assignment; infinite: none, the crease is free */
    char assignment;
    int32_t where;     /* line of the file, 0: none */
} rg_line;

/* What drawing programs tell lines apart by, and how often it was found: so that its user can say what it stands
 * for. */
typedef enum rg_trait_sort { RG_BY_COLOUR, RG_BY_LAYER, RG_BY_DASH, RG_TRAIT_SORTS } rg_trait_sort;
enum { RG_TRAIT_ROOM = 48, RG_MOST_TRAITS = 200, RG_MOST_KINDS = 64 };
typedef struct rg_trait {
    rg_trait_sort sort;
    char name[RG_TRAIT_ROOM];
    char assignment; /* what its lines were taken for; 0: for several kinds */
    int32_t count;
} rg_trait;

/* All that a FOLD file says, as a tree that read/value.h knows how to read. Here it is only held, handed on and let go,
 * through its reader's own functions: what folds need not know what a file is. */
typedef struct json_t rg_value;
typedef struct rg_keeper {
    rg_value *(*share)(rg_value *);
    void (*free)(rg_value *);
} rg_keeper;

typedef struct rg_lines {
    rg_memory mem;
    rg_line *line;
    int32_t count;
    size_t room;
    char *title, *author, *editor, *reference, *memo; /* NULL: none */
    rg_diag *warning;
    int32_t warnings;
    size_t warning_room;
    rg_trait *trait;
    int32_t traits;
    size_t trait_room;
    uint64_t kinds_used; /* of rg_reading.kind, a bit each: those that some line was of */
    int32_t frames;  /* FOLD: how many there are besides the key frame */
    int y_down;      /* the file's y points down: it was turned round */
    double metres;   /* in a unit of the coordinates; 0: the file does not say */
    double merge;    /* tolerance that the format is usually drawn to, a part of the size; 0: the general one */
    rg_value *frame; /* FOLD, where asked for: the frame read, with what it inherits; NULL otherwise */
    const rg_keeper *keeper; /* of that */
    const rg_stop *stop; /* asked now and then while lines are read; NULL: nobody */
    int32_t unasked; /* lines since */
    size_t bytes;    /* of what is no line, since */
    int32_t *vertex; /* ... and the numbers of each line's two ends there, [2 count] */
    int32_t faces, *face_start, *face_vertex; /* ... and the faces listed there: face_vertex[face_start[f]] and on */
} rg_lines;

void rg_lines_init(rg_lines *l, const rg_memory *mem);
void rg_lines_free(rg_lines *l);
enum { RG_MOST_WARNINGS = 1000 }; /* one more says that there are more */

/* A coordinate as the file has it, for messages: its own y, and no rounding where 0 is meant (`size`: of the sheet). */
rg_vec2 rg_lines_own(const rg_lines *l, rg_vec2 x, double size);

/* All: RG_ENOMEM leaves *l as it was. rg_lines_add: RG_ECANCELLED where its stop says so. */
rg_status rg_lines_add(rg_lines *l, rg_vec2 a, rg_vec2 b, char assignment, int32_t where);
/* So much of the file was passed over. RG_ECANCELLED as above. */
rg_status rg_lines_go_on(rg_lines *l, size_t bytes);
rg_status rg_lines_warn(rg_lines *l, int32_t where, const char *format, ...);
/* Counts a line of that trait; of more than RG_MOST_TRAITS the rest is forgotten. Longer names are cut. */
rg_status rg_lines_trait(rg_lines *l, rg_trait_sort sort, const char *name, size_t n, char assignment);

#endif
