/* A C program with nothing but what is installed: folds a file and prints the last frame's angles, bit by bit. */
#include <rigami.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    rg_pattern *pattern = NULL;
    rg_motion *motion = NULL;
    rg_diag why = {0};
    if (argc != 2 || rg_version_number() != RG_VERSION_NUMBER) return 2;
    rg_status s = rg_pattern_read(argv[1], NULL, &pattern, &why);
    if (s == RG_OK) s = rg_motion_create(pattern, NULL, NULL, NULL, &motion, &why);
    if (s == RG_OK) {
        const int32_t last = rg_motion_report(motion)->frame_count - 1, n = rg_motion_get_sheet(motion)->creases;
        for (int32_t i = 0; i < n; i++) printf("%a\n", rg_motion_angles(motion, last)[i]);
    } else
        fprintf(stderr, "%s\n", why.text);
    rg_motion_destroy(motion);
    rg_pattern_destroy(pattern);
    return s != RG_OK;
}
