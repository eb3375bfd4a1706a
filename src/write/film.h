/* film.h -- a motion as pictures: single, numbered, animated.
 * Paper    section 4        Uses  frames.h png.h gif.h apng.h video.h        Used by  output.c
 *
 *   dir/ or a folder that exists   dir/0000.png ... ; the folder is made where there is none, its parents are not
 *   name-%04d.png, name-%d.png     name-0000.png ...
 *   x.png                          the last frame
 *   x.gif x.apng                   the animation: its end is held, then it goes back, for ever, or as the picture says
 *   x.mp4 x.webm                   the same through the program ffmpeg
 *
 * Each file is written to a temporary name and renamed. Numbered frames replace those of an earlier run: where that was
 * longer, the frames that follow on the last one in number are removed, as far as they are PNG files that say that they
 * were made by rigami. Nothing else is. Each says of which run it is: picture.resume keeps those of this one. */
#ifndef RG_FILM_H
#define RG_FILM_H

#include "base/file.h"
#include "motion/motion.h"

/* Whether a path asks for one of these. */
int rg_film_is_form(const char *path);
/* And for an animation, all frames in one file. */
int rg_film_is_animation(const char *path);
/* RG_OK, or RG_EABSENT: there is no ffmpeg; RG_EARG: a number in the name of what is one
 * file, two numbers. why->text says so. */
rg_status rg_film_check(const char *path, rg_diag *why);
/* Also RG_EARG for a picture's size, camera or rate that is out of range; RG_EWRITE, RG_ENOMEM. */
rg_status rg_film_write(const rg_motion *m, const char *path, const rg_picture *p, rg_diag *why);
/* The same by so many threads; 0: as many as there are processors. The bytes do not depend on it. */
rg_status rg_film_write_by(const rg_motion *m, const char *path, const rg_picture *p, int32_t threads, rg_diag *why);

/* One that is a single file, to any destination: `form` is a name that ends as it does. frame: of a single picture. */
rg_status rg_film_write_to(const rg_motion *m, const char *form, int32_t frame, const rg_dest *to, const rg_picture *p,
                           int32_t threads, rg_diag *why);

#endif
