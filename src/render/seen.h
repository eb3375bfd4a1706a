/* seen.h -- the facets of a frame as the camera sees them: where, which side, how bright.
 * Uses  camera.h gl.h        Used by  ink.c piled.c print.c render.c */
#ifndef RG_SEEN_H
#define RG_SEEN_H

#include "layers/layers.h"
#include "render/camera.h"
#include "render/gl.h"

typedef struct rg_box { float left, top, right, bottom; } rg_box; /* samples */

typedef struct rg_shot {
    const rg_vec3 *x;       /* [nv] positions on the stage */
    const rg_vec3 *lift;    /* [nf] how far to move each facet, NULL: nowhere */
    const rg_camera *camera;
    const unsigned char (*tint)[3]; /* [nf] the facets' own colours, NULL: those of the paper */
    const rg_layers *layers; /* in what order they lie, where they lie flat and it is known; else NULL */
} rg_shot;

typedef struct rg_seen {
    rg_memory mem;
    const rg_mesh *mesh;
    rg_gl_vertex *corner; /* [facet_start[nf]] borrowed; a facet's mark is 1 + its number */
    rg_box *box;          /* [nf] */
    rg_box all;
    unsigned char *front; /* [nf] non-zero: its front is seen */
    float *wide;          /* [nf] twice the area over the perimeter as seen, samples: of a square half its side */
    double (*light)[3];   /* [nf] 0 ... 1 of red, green, blue */
    uint64_t *paper;      /* [1 + nf] colour by mark */
} rg_seen;

/* corner: kept by reference. RG_ENOMEM. Owner: the caller, rg_seen_free, also after a failure. */
rg_status rg_seen_init(const rg_memory *mem, const rg_mesh *m, rg_gl_vertex *corner, rg_seen *s);
void rg_seen_free(rg_seen *s);
/* fine: samples a pixel. Allocates nothing. */
void rg_seen_look(rg_seen *s, const rg_shot *shot, const rg_picture *p, int fine);
/* Towards the lamp that throws the shadow. */
rg_vec3 rg_seen_lamp(const rg_camera *c);

static inline int rg_box_meet(rg_box a, rg_box b)
{
    return a.left <= b.right && a.right >= b.left && a.top <= b.bottom && a.bottom >= b.top;
}

#endif
