/* video.h -- an animation as MP4 or WebM, by the program ffmpeg.
 * Uses  base        Used by  film.c
 *
 * The program is the first ffmpeg in PATH. It is started without a shell, reads raw pictures from a pipe and writes
 * into the file given. Its standard output goes nowhere; what it complains of is told in why->text. On Linux it ends
 * with this process, whatever that ends by. */
#ifndef RG_VIDEO_H
#define RG_VIDEO_H

#include "base/memory.h"

typedef struct rg_video rg_video;

/* RG_OK if there is an ffmpeg, RG_EABSENT and a sentence if not. */
rg_status rg_video_check(rg_diag *why);
/* Starts it: `container` is mp4 or webm, `path` a file that may exist. Widths and heights that are odd get a row or a
 * column of the background colour, as the formats ask for.
 * RG_EABSENT, RG_EWRITE, RG_ENOMEM: why->text says why. Owner: the caller, rg_video_destroy (NULL is fine). */
rg_status rg_video_create(const rg_memory *mem, const char *path, const char *container, int32_t width, int32_t height,
                          double fps, const unsigned char background[3], rg_video **video, rg_diag *why);
/* rgb: rows of pixels of 3 bytes, top row first. */
rg_status rg_video_add(rg_video *v, const unsigned char *rgb, rg_diag *why);
/* Waits until the file is complete. RG_EWRITE: it is not. */
rg_status rg_video_finish(rg_video *v, rg_diag *why);
/* Stops the program if it still runs; NULL is fine. */
void rg_video_destroy(rg_video *v);

#endif
