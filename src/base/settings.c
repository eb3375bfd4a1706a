#include "base/vec.h"
#include "rigami.h"

rg_settings rg_settings_default(void)
{
    return (rg_settings){.merge = RG_MERGE_DEFAULT, .step = 5 * RG_DEG, .tol = 1e-10, .to = 1, .rest = 1, .frames = 60, .fixed_facet = -1,
                         .file_frame = -1, .targets = 1, .adjust = RG_ADJUST_AUTO, .effort = RG_EFFORT_NORMAL, .layer_order = -1};
}
