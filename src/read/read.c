#include "read/read.h"
#include "base/memory.h"
#include "base/number.h"
#include "base/status.h"
#include "read/cp.h"
#include "read/dxf.h"
#include "read/fold.h"
#include "read/kinds.h"
#include "read/opx.h"
#include "read/ori.h"
#include "read/svg.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef struct text { const char *s, *end; } text;

static int begins(text t, const char *word)
{
    const size_t n = strlen(word);
    return (size_t)(t.end - t.s) >= n && memcmp(t.s, word, n) == 0;
}

static text skip_blanks(text t)
{
    while (t.s < t.end && (*t.s == ' ' || (*t.s >= '\t' && *t.s <= '\r'))) t.s++;
    return t;
}

static text skip_to(text t, const char *word)
{
    while (t.s < t.end && !begins(t, word)) {
        const char *next = memchr(t.s + 1, *word, (size_t)(t.end - t.s - 1));
        t.s = next ? next : t.end;
    }
    return t;
}

/* Past the declaration, comments and document type of XML, to the name of its root. */
static text find_root(text t)
{
    for (t = skip_blanks(t); t.s < t.end; t = skip_blanks(t)) {
        if (begins(t, "<?")) t = skip_to(t, "?>");
        else if (begins(t, "<!--")) t = skip_to(t, "-->");
        else if (begins(t, "<!")) {
            while (t.s < t.end && *t.s != '>' && *t.s != '[') t.s++;
            if (begins(t, "[")) t = skip_to(t, "]");
        } else if (*t.s == '<') {
            t.s++;
            break;
        } else t.s++;
    }
    return t;
}

/* The name of an element, without a prefix. */
static int named(text t, const char *name)
{
    text at = t;
    while (at.s < at.end && !strchr(" \t\r\n/>:", *at.s)) at.s++;
    if (at.s < at.end && *at.s == ':') t.s = at.s + 1;
    const size_t n = strlen(name);
    return begins(t, name) && ((size_t)(t.end - t.s) == n || strchr(" \t\r\n/>", t.s[n]));
}

/* The next line of t, blanks around it taken off; t->s moves behind it. */
static text next_line(text *t)
{
    text l = {t->s, t->s};
    while (l.end < t->end && *l.end != '\n' && *l.end != '\r') l.end++;
    t->s = l.end < t->end ? l.end + 1 + (*l.end == '\r' && l.end + 1 < t->end && l.end[1] == '\n') : l.end;
    l = skip_blanks(l);
    while (l.end > l.s && (l.end[-1] == ' ' || l.end[-1] == '\t')) l.end--;
    return l;
}

static int is(text t, const char *word) { return begins(t, word) && (size_t)(t.end - t.s) == strlen(word); }

static int is_dxf(text t)
{
    for (int pair = 0; pair < 100; pair++) { /* comments may come first */
        const text code = next_line(&t), value = next_line(&t);
        if (is(code, "999")) continue;
        return is(code, "0") && (is(value, "SECTION") || is(value, "EOF"));
    }
    return 0;
}

/* A line of five numbers. */
static int is_cp(text t)
{
    text l = next_line(&t);
    for (int i = 0; i < 5; i++, l = skip_blanks(l)) {
        text field = l;
        while (l.s < l.end && *l.s != ' ' && *l.s != '\t') l.s++;
        field.end = l.s;
        double x;
        if (!rg_number_parse(field.s, (size_t)(field.end - field.s), &x)) return 0;
    }
    return l.s == l.end;
}

/* Some object of JSON has this key, given with its quotes. */
static int has_key(text t, const char *key)
{
    for (t = skip_to(t, key); t.s < t.end; t = skip_to(t, key)) {
        t.s += strlen(key);
        if (begins(skip_blanks(t), ":")) return 1;
    }
    return 0;
}

/* What the first bytes say; RG_FORMAT_AUTO: nothing. */
static rg_format by_content(text t)
{
    t = skip_blanks(t);
    if (begins(t, "{")) {
        const int is_ori = has_key(t, "\"lineSegments\"") && !has_key(t, "\"vertices_coords\"");
        return is_ori ? RG_FORMAT_ORI : RG_FORMAT_FOLD;
    }
    if (begins(t, "<")) {
        const text root = find_root(t);
        return named(root, "java") ? RG_FORMAT_OPX : named(root, "svg") ? RG_FORMAT_SVG : RG_FORMAT_AUTO;
    }
    return is_dxf(t) ? RG_FORMAT_DXF : is_cp(t) ? RG_FORMAT_CP : RG_FORMAT_AUTO;
}

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

static int has_extension(const char *path, const char *extension)
{
    const char *dot = path ? strrchr(path, '.') : NULL;
    if (!dot) return 0;
    size_t i = 0;
    for (dot++; dot[i] && lower(dot[i]) == extension[i];) i++;
    return !dot[i] && !extension[i];
}

rg_format rg_read_extension(const char *path)
{
    static const struct { const char *extension; rg_format format; } known[] = {
        {"opx", RG_FORMAT_OPX}, {"xml", RG_FORMAT_OPX}, {"cp", RG_FORMAT_CP}, {"fold", RG_FORMAT_FOLD},
        {"json", RG_FORMAT_FOLD}, {"svg", RG_FORMAT_SVG}, {"dxf", RG_FORMAT_DXF},
        {"ori", RG_FORMAT_ORI}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (has_extension(path, known[i].extension)) return known[i].format;
    return RG_FORMAT_AUTO;
}

/* Files that people take for crease patterns, or that are saved in a way that cannot be read. */
static const char *refusal(text t, const char *path)
{
    if (has_extension(path, "orh")) return "an Orihime .orh file is not read: save it as .fold or .cp";
    if (begins(t, "AutoCAD Binary DXF")) return "a binary DXF file is not read: save it as text (ASCII)";
    const int is_wide = t.end - t.s > 1 && !t.s[0] != !t.s[1]; /* without a mark, but no text has a zero */
    if (begins(t, "\xFF\xFE") || begins(t, "\xFE\xFF") || is_wide) return "the text is UTF-16: save it as UTF-8";
    if (begins(t, "%PDF") || begins(t, "%!PS")) return "a PDF or PostScript file is not read: save it as .svg";
    if (begins(t, "PK\x03\x04") || begins(t, "\x1F\x8B")) return "a compressed file: unpack it first";
    if (begins(t, "\x89PNG") || begins(t, "\xFF\xD8\xFF") || begins(t, "GIF8"))
        return "a picture of pixels has no lines to read";
    return NULL;
}

rg_status rg_read_format(const void *bytes, size_t size, const char *path, const rg_reading *s, rg_format *format,
                         rg_diag *why)
{
    text t = {bytes, (const char *)bytes + size};
    *format = s->format;
    if (size == 0) return rg_fail(RG_EFORMAT, why, 0, "the file is empty");
    const char *no = refusal(t, path);
    if (no) return rg_fail(RG_EFORMAT, why, 0, "%s", no);
    if (*format == RG_FORMAT_AUTO) *format = by_content(t);
    if (*format == RG_FORMAT_AUTO) *format = rg_read_extension(path);
    if (*format != RG_FORMAT_AUTO) return RG_OK;
    return rg_fail(RG_EFORMAT, why, 1,
                   "not a crease pattern that is known: ORIPA's .opx, .cp, .fold, .svg, .dxf or .ori");
}

/* What can be computed with, and written in any format. */
static rg_status check_coordinates(const rg_lines *l, rg_diag *why)
{
    for (int32_t i = 0; i < l->count; i++) {
        const rg_line *q = &l->line[i];
        const double x[4] = {q->a.x, q->a.y, q->b.x, q->b.y};
        for (int k = 0; k < 4; k++)
            if (!(fabs(x[k]) <= RG_LARGEST_COORDINATE))
                return rg_fail(RG_EFORMAT, why, q->where, "a coordinate of %g is too large to compute with", x[k]);
    }
    return RG_OK;
}

/* Texts that could not be read again once they were written: cut, between two characters. */
static rg_status cut_texts(rg_lines *l)
{
    char *const said[] = {l->title, l->author, l->editor, l->reference, l->memo};
    for (int i = 0; i < 5; i++) {
        if (!said[i] || strlen(said[i]) <= RG_MOST_TEXT) continue;
        size_t end = RG_MOST_TEXT;
        while (end > 0 && ((unsigned char)said[i][end] & 0xc0) == 0x80) end--;
        said[i][end] = 0;
        const rg_status s = rg_lines_warn(l, 0, "a text is cut after %d bytes", (int)end);
        if (s != RG_OK) return s;
    }
    return RG_OK;
}

/* How far the whole is while the file is read cannot be told: nothing of it, until its lines are there. */
static int is_to_end(void *ctx)
{
    const rg_reading *s = ctx;
    return s->progress && s->progress(s->progress_ctx, 0);
}

rg_status rg_read_bytes(const void *bytes, size_t size, const char *path, const rg_reading *s, int keep, rg_lines *out,
                        rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    const rg_stop stop = {is_to_end, (void *)s};
    rg_format format;
    if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0) { /* a byte order mark says no more than UTF-8 */
        bytes = (const char *)bytes + 3;
        size -= 3;
    }
    rg_status status = rg_kinds_check(s, why);
    if (status == RG_OK) status = rg_read_format(bytes, size, path, s, &format, why);
    if (status == RG_OK && s->file_frame > 0 && format != RG_FORMAT_FOLD)
        status = rg_fail(RG_EFORMAT, why, 0, "there is no frame %d: only FOLD files have frames", (int)s->file_frame);
    if (status != RG_OK) return status;
    switch (format) {
    case RG_FORMAT_OPX: status = rg_opx_read(bytes, size, &mem, &stop, out, why); break;
    case RG_FORMAT_CP: status = rg_cp_read(bytes, size, &mem, &stop, out, why); break;
    case RG_FORMAT_SVG: status = rg_svg_read(bytes, size, &mem, &stop, s, out, why); break;
    case RG_FORMAT_DXF: status = rg_dxf_read(bytes, size, &mem, &stop, s, out, why); break;
    case RG_FORMAT_FOLD: status = rg_fold_read(bytes, size, &mem, &stop, s, keep, out, why); break;
    case RG_FORMAT_ORI: status = rg_ori_read(bytes, size, &mem, &stop, out, why); break;
    default: return rg_fail(RG_EARG, why, 0, "there is no such format");
    }
    if (status == RG_ECANCELLED) return rg_fail(status, why, 0, "%s", rg_status_text(status));
    if (status != RG_OK) return status == RG_ENOMEM ? rg_fail(status, why, 0, "out of memory") : status;
    out->stop = NULL;
    status = check_coordinates(out, why);
    if (status == RG_OK) status = cut_texts(out);
    if (status == RG_OK) status = rg_kinds_warn_unused(s, out);
    if (status == RG_OK && s->unit > 0) out->metres = s->unit;
    if (status == RG_OK && s->flip && format != RG_FORMAT_FOLD) out->y_down = !out->y_down;
    if (status == RG_ENOMEM) rg_fail(status, why, 0, "out of memory");
    if (status != RG_OK) rg_lines_free(out);
    for (int32_t i = 0; status == RG_OK && s->flip && format != RG_FORMAT_FOLD && i < out->count; i++) {
        out->line[i].a.y = -out->line[i].a.y;
        out->line[i].b.y = -out->line[i].b.y;
    }
    return status;
}

/* Whoever started us may have made standard input one that does not wait: then it is waited for here. */
static int wait_for_more(FILE *f)
{
    struct pollfd in = {.fd = fileno(f), .events = POLLIN};
    if (!ferror(f) || errno != EAGAIN) return 0;
    clearerr(f);
    return poll(&in, 1, -1) > 0 || errno == EINTR;
}

static rg_status slurp(FILE *f, size_t most, const rg_memory *mem, char **bytes, size_t *size, rg_diag *why)
{
    size_t room = 0, got;
    do {
        if (rg_mem_grow(mem, (void **)bytes, &room, *size + 65536, 1) != RG_OK)
            return rg_fail(RG_ENOMEM, why, 0, "out of memory");
        const size_t left = most - *size, free = room - *size;
        errno = 0;
        got = fread(*bytes + *size, 1, free <= left ? free : left + 1, f); /* the one more tells that there is more */
        *size += got;
        if (*size > most) return rg_fail(RG_EFORMAT, why, 0, "more than %zu MB: this is no crease pattern", most >> 20);
    } while (got > 0 || wait_for_more(f));
    return ferror(f) ? rg_fail(RG_EREAD, why, 0, "%s", errno ? strerror(errno) : "cannot be read") : RG_OK;
}

static rg_status read_file(const char *path, int is_bounded, const rg_memory *mem, char **bytes, size_t *size,
                           rg_diag *why)
{
    const int is_standard = strcmp(path, "-") == 0;
    FILE *f = is_standard ? stdin : fopen(path, "rb");
    struct stat is;
    if (!f) return rg_fail(RG_EREAD, why, 0, "%s", strerror(errno));
    const int has_end = fstat(fileno(f), &is) == 0 && S_ISREG(is.st_mode);
    const rg_status status = slurp(f, is_bounded || !has_end ? RG_MOST_BYTES : SIZE_MAX / 4, mem, bytes, size, why);
    if (!is_standard) fclose(f);
    return status;
}

rg_status rg_read_whole(const char *path, const rg_memory *mem, char **bytes, size_t *size, rg_diag *why)
{
    return read_file(path, 1, mem, bytes, size, why);
}

rg_status rg_read_motion(const char *path, const rg_memory *mem, char **bytes, size_t *size, rg_diag *why)
{
    return read_file(path, 0, mem, bytes, size, why);
}

rg_status rg_read_file(const char *path, const rg_reading *s, int keep, rg_lines *out, rg_diag *why)
{
    const rg_memory mem = rg_mem_default(s->memory);
    char *bytes = NULL;
    size_t size = 0;
    rg_status status = rg_read_whole(path, &mem, &bytes, &size, why);
    if (status == RG_OK) status = rg_read_bytes(bytes, size, path, s, keep, out, why);
    rg_mem_free(&mem, bytes);
    return status;
}
