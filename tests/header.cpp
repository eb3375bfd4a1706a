// rigami.h must serve C++ as it stands: the names resolve and the structs can be made.
#include "rigami.h"

int main()
{
    rg_settings s = rg_settings_default();
    rg_picture look = rg_picture_default();
    rg_diag why;
    rg_pattern *pattern = 0;
    rg_motion *motion = 0;
    s.frames = look.width;
    rg_reading as = rg_reading_default();
    if (rg_pattern_read("x.opx", &as, &pattern, &why) == RG_OK) (void)rg_motion_create(pattern, &s, 0, 0, &motion, &why);
    rg_motion_destroy(motion);
    rg_pattern_destroy(pattern);
    return 0;
}
