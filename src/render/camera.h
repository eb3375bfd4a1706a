/* camera.h -- one steady move of the camera for a whole motion: the sheet stays in the middle and fills the picture.
 * Paper    section 4        Uses  picture.h stage.h caption.h        Used by  render, write
 *
 * The camera never turns. It comes nearer as the sheet grows small, goes farther as it unfolds, and moves sideways so
 * that the sheet is in the middle; all of it smoothed over a part of the motion. Nothing of the sheet is cut off unless
 * one zooms in. */
#ifndef RG_CAMERA_H
#define RG_CAMERA_H

#include "render/picture.h"
#include "render/stage.h"

typedef struct rg_camera {
    rg_vec3 right, up, back;  /* orthonormal; `back` points from the sheet to the camera */
    rg_vec3 eye;              /* on the stage */
    double scale;             /* pixels per unit of x / distance */
    double near, far;         /* distances from the eye along -back, with room to spare */
    /* pixels from the upper left to the middle; what is below both halves is the caption's */
    double half_width, half_height;
    double ground;            /* height of the floor under the sheet */
} rg_camera;

/* camera[frame_count]: out, for each frame of the motion on the stage. RG_EARG: as above, or no such place to look at;
 * RG_ENOMEM. */
rg_status rg_camera_follow(const rg_stage *s, const rg_picture *p, rg_camera *camera, rg_diag *why);
/* Pixels right, pixels down, depth 0 (near) ... 1 (far). Planes stay planes. */
rg_vec3 rg_camera_project(const rg_camera *c, rg_vec3 x);

#endif
