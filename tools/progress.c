#include "progress.h"
#include "interrupt.h"
#include "say.h"
#include "seconds.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BAR = 40 };
static const double BETWEEN_DRAWINGS = 0.1; /* seconds */
static const double BEFORE_GUESSING = 1;    /* seconds of a run before the rest is guessed from it */

void progress_init(progress *p, int wanted)
{
    const char *terminal = getenv("TERM");
    *p = (progress){.shown = wanted, .began = seconds_now()};
    if (wanted < 0) p->shown = isatty(STDERR_FILENO) && terminal && strcmp(terminal, "dumb") != 0;
}

static void draw(progress *p, double now)
{
    const int full = (int)(BAR * p->reached);
    const double gone = now - p->began;
    char bar[BAR + 1] = "", left[60] = "";
    memset(bar, '#', (size_t)full);
    memset(bar + full, '.', (size_t)(BAR - full));
    /* What comes after the end, of looking at it and for other ways, nobody knows. */
    if (p->reached >= 1) snprintf(left, sizeof left, ", looking at it, and for other ways");
    else if (gone >= BEFORE_GUESSING && p->reached > 0.01)
        snprintf(left, sizeof left, ", %.0f s left", gone * (1 - p->reached) / p->reached);
    fprintf(stderr, "\r%5.1f %% folded [%s]%s\033[K", 100 * p->reached, bar, left);
    fflush(stderr);
    p->on_screen = 1;
    p->drawn = now;
}

int progress_show(void *ctx, double part)
{
    progress *p = ctx;
    if (p->shown && part >= 0 && part <= 1) {
        const double now = seconds_now();
        if (part > p->reached) p->reached = part;
        if (now - p->drawn >= BETWEEN_DRAWINGS) draw(p, now);
    }
    return interrupt_came();
}

void progress_say(progress *p, const char *doing, const char *what)
{
    char plain[4096];
    if (!p->shown) return;
    fprintf(stderr, "\r%s %.60s\033[K", doing, say_plain(what, plain, sizeof plain));
    fflush(stderr);
    p->on_screen = 1;
}

void progress_erase(progress *p)
{
    if (!p->on_screen) return;
    fputs("\r\033[K", stderr);
    fflush(stderr);
    p->on_screen = 0;
}
