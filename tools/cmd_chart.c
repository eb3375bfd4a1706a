/* rigami chart -- speed against accuracy of every method, and where each stops, for one pattern. */
#include "commands.h"
#include "input.h"
#include "interrupt.h"
#include "places.h"
#include "progress.h"
#include "say.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { ROOM = 4096 };

/* The pattern's file name without folders and ending. */
static void name_of(const char *path, char *name, size_t room)
{
    const char *slash = strrchr(path, '/'), *from = slash ? slash + 1 : path, *dot = strrchr(from, '.');
    const size_t n = dot && dot > from ? (size_t)(dot - from) : strlen(from);
    snprintf(name, room, "%.*s", (int)(n < room ? n : room - 1), strcmp(path, "-") == 0 ? "stdin" : from);
}

static const char *const endings[] = {"csv", "svg", "md"};
enum { ENDINGS = sizeof endings / sizeof *endings };

/* Non-zero: there is room for it. */
static int path_of(const char *folder, const char *name, int i, char path[ROOM])
{
    return snprintf(path, ROOM, "%s/%s.%s", folder, name, endings[i]) < ROOM;
}

/* A chart of a drawing in the present folder would have its name. */
static int check_all(const options *o, const char *name)
{
    char path[ROOM];
    for (int i = 0; o->outputs && i < ENDINGS; i++)
        if (path_of(o->output[0], name, i, path) && places_check_alone(o, path) != ENDS_WELL) return ENDS_USAGE;
    return ENDS_WELL;
}

static int write_all(const rg_chart *c, const char *name, const char *folder)
{
    char path[ROOM];
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        say("%s: %s", folder, strerror(errno));
        return ENDS_UNWRITTEN;
    }
    for (int i = 0; i < ENDINGS; i++) {
        rg_diag why = {0, ""};
        if (!path_of(folder, name, i, path)) {
            say("%s: the name is too long", folder);
            return ENDS_UNWRITTEN;
        }
        const rg_status s = rg_chart_write(c, name, path, &why);
        if (s != RG_OK) return say_status(s, path, &why);
    }
    return ENDS_WELL;
}

int cmd_chart(const options *o)
{
    rg_pattern *p = NULL;
    rg_chart *c = NULL;
    rg_diag why = {0, ""};
    progress bar;
    char name[256];
    if (o->outputs > 1) {
        say("chart: one -o DIR is enough");
        return ENDS_USAGE;
    }
    progress_init(&bar, o->quiet && o->progress < 0 ? 0 : o->progress);
    name_of(o->operand[0], name, sizeof name);
    int status = check_all(o, name);
    if (status == ENDS_WELL) status = input_read(o, 0, &p);
    if (status != ENDS_WELL) return status;
    interrupt_hold(INTERRUPT_GRACE);
    const rg_status s = rg_chart_create(p, &o->settings, progress_show, &bar, &c, &why);
    interrupt_release();
    progress_erase(&bar);
    if (s != RG_OK) status = say_status(s, o->operand[0], &why);
    if (status == ENDS_WELL && o->outputs) status = write_all(c, name, o->output[0]);
    if (status == ENDS_WELL && !o->quiet) {
        const rg_status t = rg_chart_write(c, name, "-", &why);
        if (t != RG_OK) status = say_status(t, NULL, &why);
    }
    if (s == RG_OK && interrupt_time_is_up())
        say("%s: the %g seconds that it may take are over: the chart is of what was run until then", o->operand[0],
            o->seconds);
    else if (s == RG_OK && interrupt_came())
        say("%s: interrupted: the chart is of what was run until then", o->operand[0]);
    if (status == ENDS_WELL && interrupt_came()) status = ENDS_SHORT;
    rg_chart_destroy(c);
    rg_pattern_destroy(p);
    return status;
}
