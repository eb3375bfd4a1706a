/* Read, convert, read: every line is where it was, of the kind that the format can say; and what was converted once converts to itself. */
#include "fuzz.h"
#include "base/memory.h"
#include "read/read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double SECONDS = 4; /* three conversions */
enum { LINES = 200 };

/* What becomes of an assignment in each format, as rg_convert warns of it. */
static char letter_in(rg_format f, char c) { return (c == 'C' && f != RG_FORMAT_OPX) || (c == 'U' && f == RG_FORMAT_CP) ? 'F' : c; }

static void keeps(const rg_lines *l, const rg_lines *k, rg_format f)
{
    promise(k->count == l->count);
    for (int32_t i = 0; i < l->count; i++) {
        const rg_line *p = &l->line[i], *q = &k->line[i];
        promise(p->a.x == q->a.x && p->a.y == q->a.y && p->b.x == q->b.x && p->b.y == q->b.y);
        promise(q->assignment == letter_in(f, p->assignment));
    }
}

/* Lines that cut the folded model are drawn so that people see them, and are read as auxiliary ones; creases that are free are so beside
 * others that have an angle, and those may be left out. */
static int changes_once(const rg_lines *l)
{
    for (int32_t i = 0; i < l->count; i++)
        if (l->line[i].assignment == RG_CUT || l->line[i].target == RG_FREE) return 1;
    return 0;
}

static char *whole(const char *path, size_t *n)
{
    const rg_memory mem = rg_mem_default(NULL);
    char *bytes = NULL;
    rg_diag why;
    *n = 0;
    promise(rg_read_whole(path, &mem, &bytes, n, &why) == RG_OK);
    return bytes;
}

static void same_bytes(const char *a, const char *b)
{
    size_t n, m;
    char *x = whole(a, &n), *y = whole(b, &m);
    promise(n == m && memcmp(x, y, n) == 0);
    free(x);
    free(y);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const rg_format formats[] = {RG_FORMAT_OPX, RG_FORMAT_CP, RG_FORMAT_FOLD, RG_FORMAT_SVG, RG_FORMAT_DXF};
    static const char *const names[] = {"x.opx", "x.cp", "x.fold", "x.svg", "x.dxf"};
    static const char *const again[] = {"y.opx", "y.cp", "y.fold", "y.svg", "y.dxf"};
    const rg_reading s = rg_reading_default();
    rg_lines l, k;
    rg_diag why = {0, ""};
    rg_status status = rg_read_bytes(data, size, NULL, &s, 0, &l, &why);
    sound(status, &why);
    if (status != RG_OK) return 0;
    const size_t which = dice_of(data, size).state % 5;
    const rg_format to = formats[which];
    if (l.count > 0 && l.count <= LINES) {
        const char *in = scratch("in"), *out = scratch(names[which]), *twice = scratch(again[which]);
        scratch_write(in, data, size);
        remove(out);
        watch_begin();
        status = rg_convert(in, out, to, &s, NULL, NULL, &why);
        sound(status, &why);
        if (status == RG_OK) {
            promise(rg_read_file(out, &s, 0, &k, &why) == RG_OK);
            if (to != RG_FORMAT_FOLD) keeps(&l, &k, to);
            rg_lines_free(&k);
            promise(rg_convert(out, twice, to, &s, NULL, NULL, &why) == RG_OK);
            /* A .fold file also maps what changed to what was read, which is nothing any more the second time. */
            if (to == RG_FORMAT_FOLD) promise(rg_convert(twice, out, to, &s, NULL, NULL, &why) == RG_OK);
            if (!changes_once(&l)) same_bytes(out, twice);
        }
        watch_end(SECONDS);
    }
    rg_lines_free(&l);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    dice d = {seed};
    size_t n = 0;
    if (dice_below(&d, 3)) n = mutate_lines(data, size, most, &d);
    if (n == 0) n = dice_below(&d, 4) ? mutate_text(data, size, most, &d) : LLVMFuzzerMutate(data, size, most);
    return n;
}
