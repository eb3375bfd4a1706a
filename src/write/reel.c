#include "write/reel.h"

#include <string.h>

enum { LONGEST = 255, RUN = 4 }; /* pixels; bytes */

rg_status rg_reel_keep(rg_reel *r, const rg_memory *mem, const unsigned char *rgb)
{
    size_t runs = 0;
    for (size_t i = 0, n; i < r->pixels; i += n, runs++)
        for (n = 1; n < LONGEST && i + n < r->pixels && memcmp(rgb + 3 * (i + n), rgb + 3 * i, 3) == 0;) n++;
    rg_status s = RG_MEM_GROW(mem, r->bytes, r->room, r->used + RUN * runs);
    if (s == RG_OK) s = RG_MEM_GROW(mem, r->start, r->start_room, (size_t)r->count + 1);
    if (s != RG_OK) return s;
    r->start[r->count++] = r->used;
    for (size_t i = 0, n; i < r->pixels; i += n) {
        for (n = 1; n < LONGEST && i + n < r->pixels && memcmp(rgb + 3 * (i + n), rgb + 3 * i, 3) == 0;) n++;
        r->bytes[r->used] = (unsigned char)n;
        memcpy(r->bytes + r->used + 1, rgb + 3 * i, 3);
        r->used += RUN;
    }
    return RG_OK;
}

void rg_reel_show(const rg_reel *r, int32_t i, unsigned char *rgb)
{
    const unsigned char *run = r->bytes + r->start[i];
    for (size_t done = 0; done < r->pixels; run += RUN)
        for (int k = 0; k < run[0]; k++, done++) memcpy(rgb + 3 * done, run + 1, 3);
}

void rg_reel_free(rg_reel *r, const rg_memory *mem)
{
    RG_MEM_FREE(mem, r->bytes, r->start);
    memset(r, 0, sizeof *r);
}
