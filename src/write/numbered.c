#include "write/numbered.h"

#include <stdio.h>
#include <string.h>

int rg_numbered_find(const char *path, rg_numbered *n)
{
    const char *slash = strrchr(path, '/');
    int found = 0;
    for (const char *at = strchr(slash ? slash : path, '%'); at; at = strchr(at + 1, '%')) {
        const int padded = at[1] == '0' && at[2] >= '1' && at[2] <= '9';
        if (at[padded ? 3 : 1] != 'd') continue;
        *n = (rg_numbered){path, (int)(at - path), padded ? at[2] - '0' : 0, at + (padded ? 4 : 2)};
        found++;
    }
    return found;
}

size_t rg_numbered_room(const rg_numbered *n) { return (size_t)n->before + strlen(n->after) + 13; }

void rg_numbered_name(const rg_numbered *n, int32_t frame, char *name, size_t room)
{
    snprintf(name, room, "%.*s%0*d%s", n->before, n->path, n->digits, (int)frame, n->after);
}
