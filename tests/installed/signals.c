/* A program that embeds the library has a handler of its own for SIGTERM. While a Miura-ori of 256 x 256 is made ready, which is where the
 * order of elimination is found, and begins to fold, another process sends SIGTERM again and again: the handler must run every time,
 * and must still be the program's. */
#include <fcntl.h>
#include <rigami.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { SIDE = 256, AT_LEAST = 50 };

static volatile sig_atomic_t ran, stolen;
static int answer[2];

static void handler(int number)
{
    struct sigaction now;
    if (sigaction(SIGTERM, NULL, &now) != 0 || now.sa_handler != handler) stolen = 1;
    ran++;
    if (write(answer[1], "", 1) != 1) stolen = 1;
    (void)number;
}

/* Sends, waits until it was handled, and again, until the program closes its end of `stop`. Returns how often. */
static int send_until(pid_t to, int stop)
{
    int sent = 0;
    char byte;
    fcntl(stop, F_SETFL, O_NONBLOCK);
    while (read(stop, &byte, 1) != 0) {
        const struct timespec pause = {0, 500000};
        if (kill(to, SIGTERM) != 0) break;
        sent++;
        if (read(answer[0], &byte, 1) != 1) break;
        nanosleep(&pause, NULL);
    }
    return sent;
}

int main(void)
{
    const int side = SIDE + 1;
    double(*at)[2] = malloc((size_t)side * (size_t)side * sizeof *at);
    int32_t(*ends)[2] = malloc(2 * (size_t)side * (size_t)side * sizeof *ends);
    char *letter = malloc(2 * (size_t)side * (size_t)side);
    int32_t e = 0;
    if (!at || !ends || !letter) return 3;
    for (int i = 0; i < side; i++)
        for (int j = 0; j < side; j++) {
            const int v = i * side + j;
            at[v][0] = j * 0.8660254037844386;
            at[v][1] = i + (j % 2 ? 0.5 : 0);
            if (j + 1 < side) ends[e][0] = v, ends[e][1] = v + 1, letter[e++] = i == 0 || i == SIDE ? 'B' : i % 2 ? 'M' : 'V';
            if (i + 1 < side) ends[e][0] = v, ends[e][1] = v + side, letter[e++] = j == 0 || j == SIDE ? 'B' : (i + j) % 2 ? 'V' : 'M';
        }
    rg_drawing drawing = rg_drawing_default();
    drawing.vertices = side * side, drawing.at = (const double(*)[2])at;
    drawing.edges = e, drawing.ends = (const int32_t(*)[2])ends, drawing.assignment = letter;
    rg_settings settings = rg_settings_default();
    settings.contact = RG_CONTACT_IGNORE; /* straight to the order of elimination, and then a first step */
    settings.effort = RG_EFFORT_FAST;
    settings.triangulate = RG_TRIANGULATE_NONE;
    settings.adjust = 0;
    settings.symmetry = RG_SYMMETRY_OFF;
    settings.method = RG_METHOD_EULER;
    settings.solver = RG_SOLVER_CHOLESKY;
    settings.to = 0.01;
    settings.frames = 2;
    rg_pattern *pattern = NULL;
    rg_motion *motion = NULL;
    rg_diag why = {0};
    struct sigaction own = {.sa_handler = handler, .sa_flags = SA_RESTART};
    int stop[2], told[2];
    if (pipe(answer) != 0 || pipe(stop) != 0 || pipe(told) != 0 || sigaction(SIGTERM, &own, NULL) != 0) return 3;
    if (rg_pattern_create(&drawing, NULL, &pattern, &why) != RG_OK) return fprintf(stderr, "%s\n", why.text), 1;
    const pid_t program = getpid(), child = fork();
    if (child < 0) return 3;
    if (child == 0) {
        close(stop[1]);
        close(answer[1]);
        const int sent = send_until(program, stop[0]);
        _exit(write(told[1], &sent, sizeof sent) != sizeof sent);
    }
    const rg_status s = rg_motion_create(pattern, &settings, NULL, NULL, &motion, &why);
    int32_t ways;
    if (s == RG_OK) rg_motion_mobility(motion, 1, &ways); /* which factorises once more */
    close(stop[1]);
    int sent = -1, status;
    if (read(told[0], &sent, sizeof sent) != sizeof sent || waitpid(child, &status, 0) != child) return 3;
    rg_motion_destroy(motion);
    rg_pattern_destroy(pattern);
    free(at), free(ends), free(letter);
    printf("SIGTERM was sent %d times and handled %d times; %s\n", sent, (int)ran, rg_status_text(s));
    if (s != RG_OK || sent < AT_LEAST || ran != sent || stolen) return fprintf(stderr, "the handler is not the program's own\n"), 1;
    return 0;
}
