/* gltf.h -- the motion as one animated glTF 2.0 model, in one file: binary .glb, or .gltf with its bytes in itself.
 * Uses  motion.h scene.h        Used by  output.c
 *
 * A facet is a node that turns and moves, with a key for every frame; its mesh lies about the facet's centre, so that
 * single precision costs little: positions are those of x.obj of the same frame to 1e-6 of the sheet. Where creases
 * were adjusted, facets change shape, by percents on real patterns, and no turn does that: then the whole sheet is one
 * mesh with a morph target for every frame but the last, as exact, and straight between frames.
 *
 * Both sides of the paper are there, each its own material, seen from its side only. Inside, coordinates are those of
 * all the other outputs about the sheet's middle: the flat sheet faces +z; the node `sheet` around it turns them to the
 * y up of glTF, and to metres where the file says what its unit is. Facets are named by their numbers. Creases are
 * lines, as `p->lines` says: each a node `c0_M` of the facet on its first side; in the one mesh a primitive for a kind,
 * whose extras.creases names its lines in their order. A viewer that plays no animations sees the last frame.
 */
#ifndef RG_GLTF_H
#define RG_GLTF_H

#include "motion/motion.h"
#include <stdio.h>

/* All frames, p->fps a second, in the paper colours of *p; `frame` is not looked at. RG_ENOMEM; RG_EARG: too large for
 * the format (4 GiB). */
rg_status rg_gltf_write(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);
rg_status rg_gltf_write_binary(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);

#endif
