#include "places.h"
#include "interrupt.h"
#include "say.h"
#include "seconds.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* ------------------------------------------------------------------------------------ before it starts ---- */

/* What comes after the last slash but one at its end; its length without that. */
static const char *last_part(const char *path, size_t *length)
{
    size_t n = strlen(path), from;
    while (n > 1 && path[n - 1] == '/') n--;
    for (from = n; from > 0 && path[from - 1] != '/';) from--;
    *length = n - from;
    return path + from;
}

/* Of files that are not there yet: one name in one folder, however that is called. */
static int same_place(const char *a, const char *b)
{
    struct stat is, other;
    size_t n, m;
    const char *name = last_part(a, &n), *its = last_part(b, &m);
    char folder[2][4096];
    if (n != m || memcmp(name, its, n) != 0 || strcmp(a, "-") == 0 || strcmp(b, "-") == 0) return 0;
    snprintf(folder[0], sizeof folder[0], "%.*s%s", (int)(name - a), a, name == a ? "." : "");
    snprintf(folder[1], sizeof folder[1], "%.*s%s", (int)(its - b), b, its == b ? "." : "");
    return stat(folder[0], &is) == 0 && stat(folder[1], &other) == 0 && is.st_dev == other.st_dev &&
           is.st_ino == other.st_ino;
}

/* Where the number of a frame stands in a name of many: the length before it, its least digits, and what comes after. */
typedef struct many { size_t before, digits; const char *after; } many;

/* 0: it is one file. */
static int find_number(const char *each, many *m)
{
    enum { IN_FOLDERS = 4 };
    size_t n;
    const char *name = last_part(each, &n);
    *m = (many){strlen(each), IN_FOLDERS, ".png"};
    if (m->before > 0 && each[m->before - 1] == '/') return 1;
    for (const char *c = strchr(name, '%'); c; c = strchr(c + 1, '%')) {
        const int padded = c[1] == '0' && c[2] >= '1' && c[2] <= '9';
        const char *d = c + (padded ? 3 : 1);
        if (*d != 'd') continue;
        *m = (many){(size_t)(c - each), padded ? (size_t)(c[2] - '0') : 1, d + 1};
        return 1;
    }
    return 0;
}

/* Is it, by its name, one of many files that are written under numbers, or are both the same many? */
static int is_one_of(const char *each, const char *file)
{
    enum { LONGEST = 4096 };
    char first[LONGEST], own[LONGEST];
    many m, of;
    size_t n;
    if (!find_number(each, &m)) return 0;
    /* So many frames have no padding in either name. */
    if (find_number(file, &of)) snprintf(own, sizeof own, "%.*s1000000000%s", (int)of.before, file, of.after);
    else snprintf(own, sizeof own, "%s", file);
    const char *name = each + m.before, *its = last_part(own, &n);
    while (name > each && name[-1] != '/') name--;
    const size_t lead = m.before - (size_t)(name - each);
    if (strncmp(its, name, lead) != 0) return 0;
    const size_t digits = strspn(its + lead, "0123456789");
    if (digits < m.digits || (digits > m.digits && its[lead] == '0') || strcmp(its + lead + digits, m.after) != 0)
        return 0;
    snprintf(first, sizeof first, "%.*s%s", (int)(name - each), each, its);
    return same_place(first, own);
}

static int same_file(const char *a, const char *b)
{
    struct stat is, other;
    if (strcmp(a, b) == 0 || same_place(a, b) || is_one_of(a, b) || is_one_of(b, a)) return 1;
    return stat(a, &is) == 0 && stat(b, &other) == 0 && is.st_dev == other.st_dev && is.st_ino == other.st_ino &&
           S_ISREG(is.st_mode);
}

/* `name` is written for its own: no input, no output before it. */
static int check_alone(const options *o, const char *name, int outputs)
{
    for (int i = 0; i < o->operands; i++) {
        if (strcmp(name, "-") == 0 || !same_file(name, o->operand[i])) continue;
        say("%s: is the input, and would be written over", name);
        return ENDS_USAGE;
    }
    if (o->picture.image && strcmp(name, "-") != 0 && same_file(name, o->picture.image)) {
        say("%s: is the picture to be printed, and would be written over", name);
        return ENDS_USAGE;
    }
    for (int i = 0; i < outputs; i++) {
        if (!same_file(name, o->output[i])) continue;
        say("%s: is to be written twice", name);
        return ENDS_USAGE;
    }
    return ENDS_WELL;
}

int places_check_alone(const options *o, const char *output) { return check_alone(o, output, 0); }

/* What can be known now of a file that is to be written; folders, dir/, are their writer's. */
static int check_place(const char *name)
{
    const char *slash = strrchr(name, '/');
    char folder[4096] = ".";
    struct stat is;
    if (slash && !slash[1]) return ENDS_WELL;
    if (slash) snprintf(folder, sizeof folder, "%.*s", slash == name ? 1 : (int)(slash - name), name);
    const int there = strcmp(name, "-") == 0 || stat(name, &is) == 0, too_long = !there && errno == ENAMETOOLONG;
    if (there && strcmp(name, "-") != 0 && S_ISDIR(is.st_mode)) errno = EISDIR;
    else if (!too_long && (there || access(folder, W_OK | X_OK) == 0)) return ENDS_WELL;
    say("%s: %s", name, strerror(errno));
    return ENDS_UNWRITTEN;
}

int places_check(const options *o)
{
    int status = ENDS_WELL;
    if (o->picture.image && access(o->picture.image, R_OK) != 0) {
        say("%s: %s", o->picture.image, strerror(errno));
        return ENDS_USAGE;
    }
    for (int i = 0; i < o->outputs && status == ENDS_WELL; i++) {
        rg_diag why = {0, ""};
        rg_status s = rg_output_check(o->output[i], &why);
        status = s == RG_OK ? check_alone(o, o->output[i], i) : say_status(s, o->output[i], &why);
        if (status == ENDS_WELL) status = check_place(o->output[i]);
    }
    if (status == ENDS_WELL && o->report) status = check_alone(o, o->report, o->outputs);
    if (status == ENDS_WELL && o->report) status = check_place(o->report);
    return status;
}

/* --------------------------------------------------------------------------------------------- afterwards ---- */

/* The most memory that this process had resident. What Linux keeps in /proc is of this program alone; getrusage also
 * counts what the caller had when it started us. */
static double peak_bytes(void)
{
    char line[200];
    double kilobytes = 0;
    FILE *f = fopen("/proc/self/status", "r");
    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, "VmHWM: %lf kB", &kilobytes) == 1) break;
    if (f) fclose(f);
    struct rusage used;
    if (!(kilobytes > 0) && getrusage(RUSAGE_SELF, &used) == 0) kilobytes = (double)used.ru_maxrss;
    return 1024 * kilobytes;
}

/* A pattern without a title goes by its file's name. */
static const char *name_of(const char *operand)
{
    const char *slash = strrchr(operand, '/');
    return strcmp(operand, "-") == 0 ? NULL : slash ? slash + 1 : operand;
}

/* The worse of two exit statuses; a picture or a place to look at that cannot be is the user's, not the disk's. */
static int worse(int status, int other) { return other > status ? other : status; }

int places_write(const options *o, const rg_motion *m, progress *bar, options *written)
{
    const double from = seconds_now();
    rg_diag why = {0, ""};
    rg_status s;
    int status = ENDS_WELL;
    rg_picture picture = o->picture;
    picture.title = name_of(o->operand[o->operands - 1]);
    written->outputs = 0;
    written->report = NULL;
    for (int i = 0; i < o->outputs; i++) {
        why = (rg_diag){0, ""};
        progress_say(bar, "writing", o->output[i]);
        interrupt_doing(o->output[i]);
        s = rg_motion_write(m, o->output[i], &picture, &why);
        progress_erase(bar);
        if (s != RG_OK) status = worse(status, say_status(s, o->output[i], &why));
        else written->output[written->outputs++] = o->output[i];
    }
    interrupt_doing(o->report);
    if (!o->report) return status;
    why = (rg_diag){0, ""};
    s = rg_report_write(m, seconds_now() - from, peak_bytes(), o->report, &why);
    if (s != RG_OK) status = worse(status, say_status(s, NULL, &why));
    else written->report = o->report;
    interrupt_doing(NULL);
    return status;
}

