/* scene.h -- the numbers of a glTF file: a motion as its buffer holds it.
 * Uses  motion.h pose/turn.h mesh/triangles.h png.h        Used by  gltf.c */
#ifndef RG_SCENE_H
#define RG_SCENE_H

#include "mesh/triangles.h"
#include "motion/motion.h"
#include "pose/turn.h"
#include "render/picture.h"

enum { RG_FRONT, RG_BACK };
/* Kinds of lines. */
enum { RG_MOUNTAINS, RG_VALLEYS, RG_OTHERS, RG_LINE_KINDS };

/* Parts of the buffer. What moves is turns and shifts of facets, or displacements of vertices and their weights. The
 * last two are there where a picture is printed on the front: where it is on the paper, and its file. */
typedef enum rg_part {
    RG_PART_POSITIONS,
    RG_PART_NORMALS,
    RG_PART_TRIANGLES,
    RG_PART_CREASES,
    RG_PART_TIMES,
    RG_PART_TURNS,
    RG_PART_SHIFTS,
    RG_PART_PRINT,
    RG_PART_IMAGE,
    RG_PARTS,
    RG_PART_DISPLACEMENTS = RG_PART_TURNS,
    RG_PART_WEIGHTS = RG_PART_SHIFTS
} rg_part;

typedef struct rg_scene {
    const rg_motion *m;
    const rg_mesh *mesh;
    const rg_picture *p;
    int32_t frames;
    int morphs;
    rg_triangles t;
    unsigned char *bytes;
    size_t start[RG_PARTS + 1]; /* of each part, and the end */
    rg_vec2 *centre;         /* [nf] */
    rg_place *place;         /* [nf] of the frame at work */
    rg_vec3 *x, *last;       /* [nv] of the frame at work, and of the last one */
    rg_turn *last_turn;      /* [nf] */
    rg_vec3 *last_shift;     /* [nf] */
    int32_t *normals_of;     /* [most + 1] accessor of that many normals to the front, to the back: the next; 0: none */
    int32_t most;            /* corners of a facet */
    int32_t accessors;
    unsigned char *image;    /* the picture's file; NULL: none */
    size_t image_bytes;
    int32_t print;           /* accessor of places in the picture: of the first facet, or of all vertices */
    int32_t creases;         /* that are drawn: all or none; the first `of_kind[k]` ... of kind k in the buffer */
    int32_t of_kind[RG_LINE_KINDS + 1];
    int32_t lines;           /* accessor of the first crease's ends, or of those of the first kind that is there */
} rg_scene;

/* The picture on the paper is read here. RG_EARG: too large for the format; RG_ENOMEM, RG_EREAD, RG_ECANCELLED. In any
 * case it is to be freed. Borrows m and p. */
rg_status rg_scene_init(rg_scene *g, const rg_motion *m, const rg_picture *p);
void rg_scene_free(rg_scene *g);
/* Of a facet. */
int32_t rg_scene_corners(const rg_mesh *mesh, int32_t f);
/* RG_MOUNTAINS ... RG_OTHERS. */
int rg_scene_kind(const rg_mesh *mesh, int32_t crease);

#endif
