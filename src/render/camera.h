/* camera.h -- one still camera for a whole motion: nothing jumps, nothing is cut off.
 * Paper    section 4        Uses  motion.h        Used by  render.c frames.c */
#ifndef RG_CAMERA_H
#define RG_CAMERA_H

#include "motion/motion.h"

#define RG_MAX_PICTURE 16384 /* pixels; a picture's side, so that its bytes and its samples fit in 32 bits */

typedef struct rg_camera {
    rg_vec3 right, up, back;  /* orthonormal; `back` points from the sheet to the camera */
    rg_vec3 eye;
    double scale;             /* pixels per unit of x / distance */
    double u0, v0;            /* the middle of the picture, in units of x / distance */
    double near, far;         /* distances from the eye along -back, with room to spare */
    double half_width, half_height; /* pixels */
} rg_camera;

/* RG_EARG: a size, an angle, the zoom or the rate is out of range, why->text says which. */
rg_status rg_camera_check(const rg_picture *p, rg_diag *why);
/* Frames all frames of the motion. RG_EARG as above; RG_ENOMEM. */
rg_status rg_camera_fit(const rg_motion *m, const rg_picture *p, rg_camera *c, rg_diag *why);
/* Pixels right, pixels down, depth 0 (near) ... 1 (far). Planes stay planes. */
rg_vec3 rg_camera_project(const rg_camera *c, rg_vec3 x);

#endif
