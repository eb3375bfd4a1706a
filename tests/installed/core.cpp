// A C++ program with the core alone: one vertex of a Miura-ori from arrays, its last frame's angles bit by bit.
#include <cstdio>
#include <memory>
#include <rigami.h>

int main()
{
    const double w = 0.8660254037844386;
    const double at[9][2] = {{0, 0}, {w, 0.5}, {2 * w, 0}, {0, 1}, {w, 1.5}, {2 * w, 1}, {0, 2}, {w, 2.5}, {2 * w, 2}};
    const int32_t ends[12][2] = {{0, 1}, {1, 2}, {2, 5}, {5, 8}, {8, 7}, {7, 6}, {6, 3}, {3, 0}, {3, 4}, {4, 5}, {1, 4}, {4, 7}};
    rg_drawing d = rg_drawing_default();
    d.vertices = 9, d.at = at, d.edges = 12, d.ends = ends, d.assignment = "BBBBBBBBMMVM";
    rg_pattern *p = nullptr;
    rg_motion *m = nullptr;
    rg_diag why = {};
    if (rg_pattern_create(&d, nullptr, &p, &why) != RG_OK) return std::fprintf(stderr, "%s\n", why.text), 1;
    const std::unique_ptr<rg_pattern, void (*)(rg_pattern *)> pattern(p, rg_pattern_destroy);
    if (rg_motion_create(p, nullptr, nullptr, nullptr, &m, &why) != RG_OK) return std::fprintf(stderr, "%s\n", why.text), 1;
    const std::unique_ptr<rg_motion, void (*)(rg_motion *)> motion(m, rg_motion_destroy);
    const int32_t last = rg_motion_report(m)->frame_count - 1;
    for (int32_t i = 0; i < rg_motion_get_sheet(m)->creases; i++) std::printf("%a\n", rg_motion_angles(m, last)[i]);
    return rg_motion_report(m)->outcome != RG_FOLDED;
}
