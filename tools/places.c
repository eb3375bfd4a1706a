#include "places.h"
#include "say.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* ------------------------------------------------------------------------------------ before it starts ---- */

static int same_file(const char *a, const char *b)
{
    struct stat is, other;
    if (strcmp(a, b) == 0) return 1;
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
    const double from = progress_seconds();
    rg_diag why = {0, ""};
    rg_status s;
    int status = ENDS_WELL;
    rg_picture picture = o->picture;
    picture.title = name_of(o->operand[o->operands - 1]);
    for (int i = 0; i < o->outputs; i++) {
        why = (rg_diag){0, ""};
        progress_say(bar, "writing", o->output[i]);
        s = rg_motion_write(m, o->output[i], &picture, &why);
        progress_erase(bar);
        if (s != RG_OK) say_status(s, o->output[i], &why), status = ENDS_UNWRITTEN;
    }
    if (!o->report) return status;
    why = (rg_diag){0, ""};
    s = rg_report_write(m, progress_seconds() - from, peak_bytes(), o->report, &why);
    if (s != RG_OK) say_status(s, NULL, &why), status = ENDS_UNWRITTEN;
    return status;
}

