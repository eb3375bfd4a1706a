/* The loop is the caller's: folds a pattern, draws every tenth state into pixels of its own, and goes back to flat.
 *     ./loop pattern.opx        writes loop-00.ppm, loop-10.ppm, ... */
#include <rigami.h>
#include <stdio.h>
#include <stdlib.h>

static rg_status draw(const rg_fold *fold, const rg_picture *picture, unsigned char *rgb, int frame, rg_diag *why)
{
    char name[32];
    const rg_status s = rg_fold_draw(fold, picture, rgb, why);
    if (s != RG_OK) return s;
    snprintf(name, sizeof name, "loop-%02d.ppm", frame);
    FILE *f = fopen(name, "wb");
    if (!f) return RG_EWRITE;
    fprintf(f, "P6 %d %d 255\n", (int)picture->width, (int)picture->height);
    const size_t n = 3 * (size_t)picture->width * (size_t)picture->height;
    const int whole = fwrite(rgb, 1, n, f) == n;
    return fclose(f) == 0 && whole ? RG_OK : RG_EWRITE;
}

int main(int argc, char **argv)
{
    if (argc != 2) return fprintf(stderr, "usage: %s pattern\n", argv[0]), 2;
    rg_pattern *pattern = NULL;
    rg_fold *fold = NULL;
    rg_diag why = {0};
    rg_picture picture = rg_picture_default();
    picture.width = 320, picture.height = 240;
    unsigned char *rgb = malloc(3 * 320 * 240);
    rg_status s = rgb ? rg_pattern_read(argv[1], NULL, &pattern, &why) : RG_ENOMEM;
    if (s == RG_OK) s = rg_fold_create(pattern, NULL, NULL, NULL, &fold, &why);
    if (s == RG_OK) {
        int draws = 1;
        for (const rg_step_info *i = rg_fold_get_info(fold); s == RG_OK; i = rg_fold_step(fold)) {
            printf("%3d  %5.1f %%\n", (int)i->frame, 100 * i->progress);
            if (draws && i->frame % 10 == 0) s = draw(fold, &picture, rgb, (int)i->frame, &why);
            if (s == RG_EABSENT) { /* a build without pictures: the angles are there all the same */
                printf("%s\n", why.text);
                draws = 0, s = RG_OK;
            }
            if (i->outcome != RG_RUNNING) break;
        }
        while (s == RG_OK && rg_fold_step_back(fold)->frame > 0) continue;
        printf("and back: %g\n", rg_fold_get_info(fold)->progress);
    }
    if (s != RG_OK) fprintf(stderr, "%s:%d: %s\n", argv[1], why.line, why.text);
    rg_fold_destroy(fold);
    rg_pattern_destroy(pattern);
    free(rgb);
    return s != RG_OK;
}
