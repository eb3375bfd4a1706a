/* motion.h -- a fold from flat to its end, kept frame by frame, and measured.
 * Uses  gaps.h pose.h        Used by  the other files of this room; files, render, write */
#ifndef RG_MOTION_H
#define RG_MOTION_H

#include "mesh/mesh.h"
#include "mesh/triangles.h"
#include "motion/gaps.h"
#include "pose/pose.h"

/* The stages of a motion, and how its mesh is made of the pattern's. */
typedef struct rg_stages {
    rg_memory mem;
    rg_folding_stage *stage;      /* [count] as in the report; 0: not in stages */
    int32_t count;
    rg_simple_turn *fold;
    int32_t *crease;
    int32_t *vertex;      /* [mesh nv] which of the pattern's vertices each is, -1: none; NULL: the same ones */
    int32_t *edge;        /* [mesh ne] which of its edges it is a part of, -1: none */
} rg_stages;

/* The second facet comes to lie before the front of the first: 1, or behind its back: -1. */
typedef struct rg_motion_side { int32_t facet[2]; int before; } rg_motion_side;

struct rg_motion {
    rg_memory mem;
    rg_settings settings;
    rg_mesh mesh;
    rg_tree tree;
    char *title, *author;  /* of the pattern; NULL: none */
    rg_source source;      /* of the pattern's vertices and edges, the first of the mesh; of several states: empty */
    double *target;        /* [mesh.N] what was aimed at, radians; NAN: nothing */
    double *from;          /* [mesh.N] fold angles of the state that the motion starts from */
    double *rho;           /* [report.frame_count][mesh.N] radians */
    rg_vec2 *flat;         /* [report.frame_count][mesh.nv] the pattern of each frame; NULL: mesh.X in all of them */
    rg_gaps gaps;          /* states between frames */
    rg_vec3 *space;        /* [report.frame_count][mesh.nv] positions given that plates do not reach; NULL: they do */
    rg_frame *frame;       /* [report.frame_count] */
    rg_try *tried;         /* [report.tried_count] */
    rg_unfoldable theorem; /* what the report's points to */
    rg_sheet sheet;        /* what is lent of the mesh, */
    rg_triangles triangles; /* and how it is drawn */
    rg_pattern_info info;  /* of the pattern */
    int32_t *blocking_vertex, *blocking_crease;
    double (*blocking_at)[2];
    int32_t *state_frame, *by_flat; /* of a sequence of states, as in the report; NULL: of one pattern */
    rg_stages stages;      /* in which it goes; count 0: at once */
    int32_t sides;
    rg_motion_side *side;  /* [sides] pairs of facets that came near each other before the last frame */
    rg_layers *layers;     /* of its flat end, see ending.h; NULL: not looked for */
    int ends_flat;         /* non-zero: the last frame is folded flat */
    rg_report report;
};

void rg_motion_free_stages(rg_stages *q);

/* One of the states that a motion is known by: its frames, and those between them. */
typedef struct rg_motion_state {
    const double *rho;  /* [mesh.N] */
    const rg_vec2 *X;   /* [mesh.nv] */
    int32_t frame;      /* the frame that it is, or that it comes after */
    int is_between;
} rg_motion_state;

int32_t rg_motion_states(const rg_motion *m);
/* The k-th of them; k rises by one from call to call, from 0, as does *gaps: how many so far lay between frames. */
rg_motion_state rg_motion_state_at(const rg_motion *m, int32_t k, int32_t *gaps);
/* The pattern of a frame, [mesh.nv]. */
const rg_vec2 *rg_motion_pattern(const rg_motion *m, int32_t f);
/* x[mesh.nv]: out, positions in frame f, 0 <= f < report.frame_count. RG_ENOMEM. */
rg_status rg_motion_place(const rg_motion *m, int32_t f, rg_vec3 *x);

/* place[mesh.nf]: out, where each facet of frame f goes. */
void rg_motion_facets(const rg_motion *m, int32_t f, rg_place *place);
/* The same about the sheet's middle: in single precision much would be lost far from the origin. */
rg_status rg_motion_place_centred(const rg_motion *m, int32_t f, rg_vec3 *x);
/* A place of the sheet as its drawing has it: y as it runs there. What rounding leaves of 0 is 0 for people. */
void rg_motion_drawn(const rg_motion *m, rg_vec2 at, double drawn[2]);
/* The middle of the box around the pattern given. */
rg_vec3 rg_motion_middle(const rg_motion *m);

/* What m says of its pattern: counts, title and author. RG_ENOMEM. */
rg_status rg_motion_name(rg_motion *m, const rg_pattern_info *of);
/* Once m->mesh is there: m->tree, from settings.fixed_facet on. RG_EARG: there is no such facet. RG_ENOMEM. */
rg_status rg_motion_hang(rg_motion *m, rg_diag *why);
/* ... and m->sheet, which lends it. RG_ENOMEM. */
rg_status rg_motion_lend(rg_motion *m);

#endif
