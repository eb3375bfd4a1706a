#include "aims.h"
#include "say.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEG = 3.14159265358979323846 / 180;

/* A number and nothing else up to `end`, which is the first byte that is none. */
static int number(const char *text, double *value, const char **end)
{
    const size_t n = strspn(text, "0123456789+-.eE");
    char *stop;
    *value = strtod(text, &stop);
    *end = stop;
    return n > 0 && stop == text + n && isfinite(*value);
}

/* The edge of crease `text`: its number, as reports have it, also with the c of .csv and .svg, or a point on it, "x,y".
 * Ends at '=' or the end. -1: none. */
static int32_t find_edge(const rg_pattern *p, const char *text, const char **end)
{
    const rg_plane *plane = rg_pattern_get_plane(p);
    double x[2];
    if (*text == 'c') text++;
    if (!number(text, &x[0], end)) return -1;
    if (**end == ',') return number(*end + 1, &x[1], end) ? rg_pattern_edge_at(p, x) : -1;
    int32_t left = x[0] >= 0 && x[0] == floor(x[0]) && x[0] < plane->edges ? (int32_t)x[0] : -1;
    for (int32_t e = 0; left >= 0 && e < plane->edges; e++)
        if (plane->assignment[e] != 'B' && left-- == 0) return e;
    return -1;
}

/* What was asked of a crease. */
typedef struct aimed { int32_t edge; int what; } aimed;

/* The crease is to do something else already. */
static int is_taken(const aimed *list, int count, const aimed *now)
{
    for (int i = 0; i < count; i++)
        if (list[i].edge == now->edge && list[i].what != now->what) return 1;
    return 0;
}

/* Of two angles for one crease the second counts. */
static void drive(rg_driven *driven, int32_t *count, rg_driven one)
{
    int32_t i = 0;
    while (i < *count && driven[i].edge != one.edge) i++;
    driven[i] = one;
    *count += i == *count;
}

static int set_all(const options *o, const char *name, rg_pattern *p, rg_driven *driven, int32_t *count, aimed *list)
{
    *count = 0;
    for (int i = 0; i < o->aims; i++) {
        const aim *a = &o->aim[i];
        const char *end;
        double degrees = 0;
        const int32_t e = find_edge(p, a->text, &end);
        const int says = a->what != AIM_DRIVE
                             ? *end == 0
                             : *end == '=' && number(end + 1, &degrees, &end) && *end == 0 && fabs(degrees) <= 180;
        const char *option = a->what == AIM_DRIVE ? "drive" : a->what == AIM_PIN ? "pin" : "free";
        if (!says) {
            say("--%s: \"%s\" is not %s", option, a->text,
                a->what == AIM_DRIVE ? "CREASE=DEG with an angle from -180 to 180, such as 5=60 or 0.5,0.2=60"
                                     : "a crease: its number, or x,y of a point on it");
            return ENDS_USAGE;
        }
        if (e < 0 || rg_pattern_get_plane(p)->assignment[e] == 'B') {
            say("%s: --%s %s: there is no such crease; creases are 0 to %d, or x,y of a point on one", name, option,
                a->text, (int)rg_pattern_get_info(p)->creases - 1);
            return ENDS_USAGE;
        }
        list[i] = (aimed){e, (int)a->what};
        if (is_taken(list, i, &list[i])) {
            say("%s: --%s %s: another --drive, --pin or --free says otherwise of that crease", name, option, a->text);
            return ENDS_USAGE;
        }
        if (a->what == AIM_DRIVE) drive(driven, count, (rg_driven){e, degrees * DEG});
        else if (a->what == AIM_FREE) rg_pattern_set_target(p, e, RG_FREE);
        else if (rg_pattern_pin(p, e) != RG_OK) return say_status(RG_ENOMEM, name, &(rg_diag){0, ""});
    }
    return ENDS_WELL;
}

int aims_set(const options *o, const char *name, rg_pattern *p, rg_driven *driven, int32_t *count)
{
    aimed *list = calloc((size_t)o->aims + 1, sizeof *list);
    const int status = list ? set_all(o, name, p, driven, count, list)
                            : say_status(RG_ENOMEM, name, &(rg_diag){0, ""});
    free(list);
    return status;
}
