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

static int same_file(const char *a, const char *b)
{
    struct stat is, other;
    if (strcmp(a, b) == 0 || same_place(a, b)) return 1;
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
    const int there = strcmp(name, "-") == 0 || stat(name, &is) == 0;
    if (there && strcmp(name, "-") != 0 && S_ISDIR(is.st_mode)) errno = EISDIR;
    else if (there || access(folder, W_OK | X_OK) == 0) return ENDS_WELL;
    say("%s: %s", name, strerror(errno));
    return ENDS_UNWRITTEN;
}

int places_check(const options *o)
{
    int status = ENDS_WELL;
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

/* All outputs are tried, whatever becomes of one; the report comes last, as it tells how long they took. */
int places_write(const options *o, const rg_motion *m, progress *bar)
{
    const double from = seconds_now();
    rg_diag why = {0, ""};
    rg_status s;
    int status = ENDS_WELL;
    rg_picture picture = o->picture;
    picture.title = name_of(o->operand[o->operands - 1]);
    for (int i = 0; i < o->outputs; i++) {
        why = (rg_diag){0, ""};
        progress_say(bar, "writing", o->output[i]);
        interrupt_doing(o->output[i]);
        s = rg_motion_write(m, o->output[i], &picture, &why);
        progress_erase(bar);
        if (s != RG_OK) say_status(s, o->output[i], &why), status = ENDS_UNWRITTEN;
    }
    interrupt_doing(o->report);
    if (!o->report) return status;
    why = (rg_diag){0, ""};
    s = rg_report_write(m, seconds_now() - from, peak_bytes(), o->report, &why);
    if (s != RG_OK) say_status(s, NULL, &why), status = ENDS_UNWRITTEN;
    interrupt_doing(NULL);
    return status;
}

