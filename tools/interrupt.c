#include "interrupt.h"
#include "say.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t held, came;

static void on_signal(int number)
{
    (void)number;
    if (!held || came) _exit(ENDS_SHORT);
    came = 1;
}

void interrupt_init(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction act, was;
    memset(&act, 0, sizeof act);
    act.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &act, NULL);
    sigaction(SIGXFSZ, &act, NULL);
    act.sa_handler = on_signal;
    act.sa_flags = SA_RESTART; /* so that what is being written is written */
    for (int i = 0; i < 3; i++)
        if (sigaction(numbers[i], NULL, &was) == 0 && was.sa_handler != SIG_IGN) sigaction(numbers[i], &act, NULL);
}

void interrupt_hold(void) { held = 1; }

int interrupt_came(void) { return came; }
