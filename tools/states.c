#include "states.h"
#include "input.h"
#include "say.h"

#include <stdlib.h>
#include <string.h>

static int add(const options *o, int operand, states *s)
{
    rg_pattern **pattern = realloc(s->pattern, (size_t)(s->count + 1) * sizeof *pattern);
    if (pattern) s->pattern = pattern;
    int *of = realloc(s->operand, (size_t)(s->count + 1) * sizeof *of);
    if (of) s->operand = of;
    if (!pattern || !of) return say_status(RG_ENOMEM, NULL, &(rg_diag){0, ""});
    s->operand[s->count] = operand;
    const int status = input_read(o, operand, &s->pattern[s->count]);
    s->count += status == ENDS_WELL;
    return status;
}

/* Frames of one file, one after the other. */
static int add_frames(const options *o, int operand, states *s)
{
    if (o->ranges == 0 || (o->ranges == 1 && o->range[0].first == o->range[0].last)) return add(o, operand, s);
    if (strcmp(o->operand[operand], "-") == 0) {
        say("fold: standard input can be read only once: name a file for several --frame");
        return ENDS_USAGE;
    }
    options one = *o;
    int status = ENDS_WELL;
    for (int i = 0; i < o->ranges; i++) {
        const frame_range *r = &o->range[i];
        int32_t last = r->last;
        for (int32_t k = r->first; status == ENDS_WELL && (k <= last || (last < r->first && k == r->first)); k++) {
            rg_pattern_info info;
            one.reading.file_frame = k;
            status = add(&one, operand, s);
            if (status != ENDS_WELL || last >= r->first) continue;
            info = *rg_pattern_get_info(s->pattern[s->count - 1]);
            last = info.file_frames;
        }
    }
    return status;
}

int states_read(const options *o, states *s)
{
    int status = ENDS_WELL;
    *s = (states){.count = 0};
    for (int i = 0; i < o->operands && status == ENDS_WELL; i++) status = add_frames(o, i, s);
    return status;
}

void states_free(states *s)
{
    for (int i = 0; i < s->count; i++) rg_pattern_destroy(s->pattern[i]);
    free(s->pattern);
    free(s->operand);
    *s = (states){.count = 0};
}
