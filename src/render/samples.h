/* samples.h -- from what is seen at each sample of a picture to its pixels: ink along edges, colours, means.
 * Paper    section 4        Used by  ink.c piled.c print.c seen.c */
#ifndef RG_SAMPLES_H
#define RG_SAMPLES_H

#include <stddef.h>
#include <stdint.h>

/* A sample tells what is seen there: in its lower bits the mark of a piece, 0: nothing; in its upper ones the ink that
 * lies on it, 0: none. Every pixel is the mean of RG_SAMPLES_FINE x RG_SAMPLES_FINE of them. */
enum { RG_SAMPLES_FINE = 3, RG_SAMPLES_MARK_BITS = 28, RG_SAMPLES_INKS = 1 << (32 - RG_SAMPLES_MARK_BITS) };

typedef struct rg_samples {
    uint32_t *at;   /* [height][pitch], the first `width` of each row */
    int32_t pitch, width, height;
    int32_t x, y;   /* where its first sample is in the whole picture */
    uint64_t *colour; /* [height][pitch] what is seen at each, where there is a piece; NULL: the colours of pieces */
} rg_samples;

typedef struct rg_samples_line {
    float x[2], y[2]; /* ends, in samples of the whole picture */
    float half;       /* half its width; it is longer than from end to end by half of that on each side */
    uint32_t mark, ink; /* mark RG_SAMPLES_ANY: whatever piece is seen there */
} rg_samples_line;
#define RG_SAMPLES_ANY 0

/* Puts ink on the samples that lie within a line and show the piece `mark`, in place of what ink is there. */
void rg_samples_draw(const rg_samples *s, const rg_samples_line *line);

/* A colour with room to add in: 20 bits for each of red, green and blue. */
uint64_t rg_samples_colour(const unsigned char rgb[3]);
/* paper[]: the colour of each mark; ink[RG_SAMPLES_INKS]: of each ink.
 * rgb: height / RG_SAMPLES_FINE rows of width / RG_SAMPLES_FINE pixels, `stride` bytes from row to row; in: what is
 * behind. */
void rg_samples_mean(const rg_samples *s, const uint64_t *paper, const uint64_t *ink, unsigned char *rgb,
                     size_t stride);

#endif
