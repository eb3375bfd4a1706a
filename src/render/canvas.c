#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "render/canvas.h"
#include "base/status.h"
#include "render/raster.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* A tile takes a hundredth of a second, the first one some tenths: what has not answered by then hangs. */
enum { PATIENCE = 20000 }; /* milliseconds */
/* What else is open in this process is none of the child's. */
enum { MOST_OPEN = 1024 };

typedef struct job { int32_t corners, x, y, width, height; } job;

static int receive(int fd, void *to, size_t n)
{
    ssize_t got;
    do got = recv(fd, to, n, MSG_WAITALL);
    while (got < 0 && errno == EINTR);
    return got == (ssize_t)n;
}

/* No signal where the other one is gone. */
static int tell(int fd, const void *from, size_t n)
{
    ssize_t done;
    do done = send(fd, from, n, MSG_NOSIGNAL);
    while (done < 0 && errno == EINTR);
    return done == (ssize_t)n;
}

/* ---- the child */

/* Alone with its socket, silent, and not stopped by what the terminal sends: its parent ends it. */
static int settle_in(int socket)
{
    const struct rlimit none = {0, 0};
    enum { OURS = 3 }; /* after the standard ones */
    if (socket != OURS && dup2(socket, OURS) < 0) return -1;
    const int null = open("/dev/null", O_RDWR);
    for (int fd = 0; fd < OURS; fd++)
        if (dup2(null, fd) < 0) return -1;
    for (int fd = OURS + 1; fd < MOST_OPEN; fd++) close(fd);
    static const int usual[] = {SIGTERM, SIGHUP, SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM,
                                SIGPIPE, SIGXCPU, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGURG};
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++) signal(usual[i], SIG_DFL);
    signal(SIGINT, SIG_IGN);
    signal(SIGTSTP, SIG_IGN);
    sigset_t nothing;
    sigemptyset(&nothing);
    setrlimit(RLIMIT_CORE, &none);
    pthread_sigmask(SIG_SETMASK, &nothing, NULL);
    return OURS;
}

/* Draws what it is asked for until there is no one to ask. Leaves without what is done at an exit: that is the
 * parent's. */
static void serve(const rg_canvas *c, int socket)
{
    rg_gl *gl = NULL;
    int32_t width = 0, height = 0;
    socket = settle_in(socket);
    if (socket < 0 || rg_gl_create(NULL, c->width, c->height, &gl, NULL) != RG_OK) _exit(1);
    rg_gl_size(gl, &width, &height);
    if (width < c->width || height < c->height) _exit(1);
    for (job j; receive(socket, &j, sizeof j);) {
        const rg_gl_scene scene = {c->vertex, c->corner, j.corners};
        uint32_t *mark;
        int32_t pitch;
        const char done = rg_gl_draw(gl, &scene, j.x, j.y, j.width, j.height, &mark, &pitch, NULL) == RG_OK;
        for (int32_t row = 0; done && row < j.height; row++)
            memcpy(c->mark + (size_t)row * (size_t)c->width, mark + (size_t)row * (size_t)pitch,
                   (size_t)j.width * sizeof *mark);
        if (!tell(socket, &done, 1) || !done) break;
    }
    _exit(0);
}

/* ---- the parent */

static void end_child(rg_canvas *c)
{
    if (c->socket >= 0) close(c->socket);
    c->socket = -1;
    if (c->child <= 0) return;
    kill((pid_t)c->child, SIGKILL);
    while (waitpid((pid_t)c->child, NULL, 0) < 0 && errno == EINTR) continue;
    c->child = 0;
}

static int begin_child(rg_canvas *c)
{
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, pair) != 0) return 0;
    fcntl(pair[0], F_SETFD, FD_CLOEXEC);
    fcntl(pair[1], F_SETFD, FD_CLOEXEC);
    /* No signal reaches the child before it has forgotten what its parent does with them. */
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t child = fork();
    if (child == 0) {
        close(pair[0]);
        serve(c, pair[1]);
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    close(pair[1]);
    if (child < 0) close(pair[0]);
    else c->socket = pair[0], c->child = child;
    return child > 0;
}

/* Non-zero: the samples are there. */
static int ask_child(rg_canvas *c, const job *j)
{
    char done = 0;
    struct pollfd answer = {.fd = c->socket, .events = POLLIN};
    int ready = 0;
    if (tell(c->socket, j, sizeof *j))
        while ((ready = poll(&answer, 1, PATIENCE)) < 0 && errno == EINTR) continue;
    if (ready > 0 && receive(c->socket, &done, 1) && done) return 1;
    end_child(c);
    return 0;
}

rg_status rg_canvas_init(const rg_memory *mem, int32_t width, int32_t height, size_t vertices, size_t corners,
                         int by_gl, rg_canvas *c)
{
    const size_t samples = (size_t)width * (size_t)height;
    *c = (rg_canvas){.mem = *mem, .width = width, .height = height, .socket = -1};
    c->depth = rg_mem_array(mem, samples, sizeof *c->depth);
    if (!c->depth) return RG_ENOMEM;
    if (by_gl && rg_gl_check(NULL) == RG_OK && vertices < SIZE_MAX / 64 && corners < SIZE_MAX / 64) {
        const size_t bytes = vertices * sizeof *c->vertex + corners * sizeof *c->corner + samples * sizeof *c->mark;
        void *both = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (both != MAP_FAILED) {
            c->shared = bytes;
            c->vertex = both;
            c->corner = (uint32_t *)(void *)(c->vertex + vertices);
            c->mark = c->corner + corners;
            if (begin_child(c)) return RG_OK;
            munmap(both, bytes);
            c->shared = 0;
        }
    }
    return RG_MEM_ARRAYS(mem, RG_ARRAY(c->vertex, vertices), RG_ARRAY(c->corner, corners), RG_ARRAY(c->mark, samples));
}

void rg_canvas_free(rg_canvas *c)
{
    if (!c->mem.resize) return;
    end_child(c);
    rg_mem_free(&c->mem, c->depth);
    if (c->shared) {
        munmap(c->vertex, c->shared);
    } else {
        RG_MEM_FREE(&c->mem, c->vertex, c->corner, c->mark);
    }
    memset(c, 0, sizeof *c);
    c->socket = -1;
}

void rg_canvas_draw(rg_canvas *c, int32_t corners, int32_t x, int32_t y, int32_t width, int32_t height)
{
    const job j = {corners, x, y, width, height};
    const rg_gl_scene scene = {c->vertex, c->corner, corners};
    if (c->socket >= 0 && ask_child(c, &j)) return;
    rg_raster_draw(&scene, x, y, width, height, c->mark, c->depth, c->width);
}
