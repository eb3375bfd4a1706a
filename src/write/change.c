#include "write/change.h"

#include <string.h>

rg_change rg_change_find(const unsigned char *now, const unsigned char *before, int32_t width, int32_t height,
                         int bytes)
{
    const size_t row = (size_t)width * (size_t)bytes;
    int32_t top = height, bottom = -1;
    size_t left = row, right = 0; /* bytes */
    if (!before) return (rg_change){0, 0, width, height};
    for (int32_t y = 0; y < height; y++, now += row, before += row) {
        if (memcmp(now, before, row) == 0) continue;
        size_t first = 0, last = row;
        while (now[first] == before[first]) first++;
        while (now[last - 1] == before[last - 1]) last--;
        if (top == height) top = y;
        bottom = y;
        if (first < left) left = first;
        if (last > right) right = last;
    }
    if (bottom < 0) return (rg_change){0, 0, 1, 1};
    const int32_t from = (int32_t)(left / (size_t)bytes), to = (int32_t)((right - 1) / (size_t)bytes);
    return (rg_change){from, top, to - from + 1, bottom - top + 1};
}
