#define _GNU_SOURCE /* pipe2 */
#include "write/video.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

enum { PROGRAM_ROOM = 4096 };

struct rg_video {
    rg_memory mem;
    pid_t child;  /* 0: none runs */
    int pipe;     /* -1: closed */
    FILE *said;   /* what the program says of errors */
    size_t bytes; /* of a picture */
};

static int find_program(char program[PROGRAM_ROOM])
{
    const char *path = getenv("PATH");
    for (const char *at = path, *end; at; at = *end ? end + 1 : NULL) {
        end = at + strcspn(at, ":");
        const int n = snprintf(program, PROGRAM_ROOM, "%.*s%sffmpeg", (int)(end - at), at, end > at ? "/" : "./");
        struct stat is;
        if (n < PROGRAM_ROOM && stat(program, &is) == 0 && S_ISREG(is.st_mode) && access(program, X_OK) == 0) return 1;
    }
    return 0;
}

static rg_status absent(rg_diag *why)
{
    return rg_fail(RG_EABSENT, why, 0, "videos are made by the program ffmpeg, and there is none in PATH "
                   "(apt-get install ffmpeg); a .gif or an .apng needs none");
}

rg_status rg_video_check(rg_diag *why)
{
    char program[PROGRAM_ROOM];
    return find_program(program) ? RG_OK : absent(why);
}

static int wait_for(rg_video *v)
{
    int status = -1;
    while (waitpid(v->child, &status, 0) < 0)
        if (errno != EINTR) return -1;
    v->child = 0;
    return status;
}

/* In the child, between fork and exec: pictures come in, complaints go to a file, the rest goes nowhere. It ends with
 * its parent, whatever ends that and whatever it hangs in. Does not come back. */
static void become(pid_t parent, const char *program, char *const argv[], int pictures, int complaints, int failure)
{
    const int null = open("/dev/null", O_WRONLY);
    sigset_t none;
    sigemptyset(&none);
    (void)parent;
#if defined(__linux__)
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(126); /* it was quicker */
#endif
    signal(SIGPIPE, SIG_DFL);
    pthread_sigmask(SIG_SETMASK, &none, NULL);
    if (null >= 0 && dup2(pictures, STDIN_FILENO) >= 0 && dup2(null, STDOUT_FILENO) >= 0 &&
        dup2(complaints, STDERR_FILENO) >= 0)
        execve(program, argv, environ);
    const int error = errno;
    if (write(failure, &error, sizeof error) < 0) _exit(126);
    _exit(127);
}

/* 0, or an error number. */
static int start(rg_video *v, const char *program, char *const argv[])
{
    int ends[2], failure[2], error = 0;
    if (pipe2(ends, O_CLOEXEC) != 0) return errno;
    if (pipe2(failure, O_CLOEXEC) != 0) {
        error = errno;
        close(ends[0]);
        close(ends[1]);
        return error;
    }
    /* No signal reaches the child before it is another program. */
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t parent = getpid();
    v->child = fork();
    if (v->child == 0) become(parent, program, argv, ends[0], fileno(v->said), failure[1]);
    if (v->child < 0) error = errno, v->child = 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    close(ends[0]);
    close(failure[1]);
    if (error == 0 && read(failure[0], &error, sizeof error) <= 0) error = 0; /* nothing is said where all went well */
    close(failure[0]);
    v->pipe = ends[1];
    if (error == 0) return 0;
    close(v->pipe);
    v->pipe = -1;
    if (v->child > 0) wait_for(v);
    return error;
}

/* x264 and VP9 at a quality where one sees no loss in flat colours, in the colours of BT.709, playable while it loads.
 * The same pictures give the same file: no date, no random numbers in it, threads that do not go by the processors.
 * Without -xerror, a disk that is full goes unnoticed by webm. */
static int run(rg_video *v, const char *program, const char *output, const char *container, int32_t width,
               int32_t height, double fps, const unsigned char background[3])
{
    char size[32], rate[32], filter[160];
    snprintf(size, sizeof size, "%dx%d", (int)width, (int)height);
    snprintf(rate, sizeof rate, "%ld/1000", (long)(1000 * fps + 0.5));
    snprintf(filter, sizeof filter, "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=0x%02x%02x%02x,"
             "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", background[0], background[1], background[2]);
    static const char *const for_mp4[] = {"-crf", "18", "-preset", "medium", "-movflags", "+faststart"},
                      *const for_webm[] = {"-crf", "24", "-b:v", "0", "-cpu-used", "4"};
    const char *const *own = strcmp(container, "mp4") == 0 ? for_mp4 : for_webm;
    const char *const words[] = {"ffmpeg",    "-nostdin",   "-hide_banner", "-loglevel", "error",
                                 "-xerror",   "-y",         "-f",           "rawvideo",  "-pix_fmt",
                                 "rgb24",     "-s",         size,           "-r",        rate,
                                 "-i",        "pipe:0",     "-an",          "-threads",  "4",
                                 "-vf",       filter,       "-colorspace",  "bt709",     "-color_primaries",
                                 "bt709",     "-color_trc", "bt709",        own[0],      own[1],
                                 own[2],      own[3],       own[4],         own[5],      "-fflags",
                                 "+bitexact", "-flags:v",   "+bitexact",    "-f",        container,
                                 output,      NULL};
    char *argv[sizeof words / sizeof *words];
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) argv[i] = (char *)(uintptr_t)words[i];
    return start(v, program, argv);
}

rg_status rg_video_create(const rg_memory *mem, const char *path, const char *container, int32_t width, int32_t height,
                          double fps, const unsigned char background[3], rg_video **video, rg_diag *why)
{
    char program[PROGRAM_ROOM];
    if (!find_program(program)) return absent(why);
    const size_t room = strlen(path) + 6;
    rg_video *v = rg_mem_array(mem, 1, sizeof *v);
    if (v) *v = (rg_video){.mem = *mem, .pipe = -1, .bytes = 3 * (size_t)width * (size_t)height};
    char *output = rg_mem_array(mem, room, 1);
    rg_status s = v && output ? RG_OK : rg_fail(RG_ENOMEM, why, 0, "out of memory for the video");
    if (s == RG_OK) {
        v->said = tmpfile();
        snprintf(output, room, "file:%s", path); /* whatever the name looks like, it is a file's */
        int error = v->said ? 0 : errno;
        if (error == 0) error = run(v, program, output, container, width, height, fps, background);
        if (error != 0) s = rg_fail(RG_EWRITE, why, 0, "%.150s: %s", program, strerror(error));
    }
    rg_mem_free(mem, output);
    if (s == RG_OK) *video = v;
    else rg_video_destroy(v);
    return s;
}

/* Where the program is gone, a write raises SIGPIPE, which would end ours: it is held off, and taken away if it came.
 */
static int write_all(int fd, const unsigned char *bytes, size_t n)
{
    sigset_t pipe, before, pending;
    int error = 0;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    sigpending(&pending);
    const int was_pending = sigismember(&pending, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe, &before);
    while (n > 0 && error == 0) {
        const ssize_t done = write(fd, bytes, n);
        if (done >= 0) bytes += done, n -= (size_t)done;
        else if (errno != EINTR) error = errno;
    }
    if (error == EPIPE && !was_pending) {
        const struct timespec now = {0, 0};
        while (sigtimedwait(&pipe, NULL, &now) < 0 && errno == EINTR) continue;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return error;
}

/* The first line that the program had to say. */
static rg_status failed(rg_video *v, rg_diag *why)
{
    char line[200] = "";
    rewind(v->said);
    if (!fgets(line, sizeof line, v->said)) line[0] = 0;
    line[strcspn(line, "\r\n")] = 0;
    return rg_fail(RG_EWRITE, why, 0, "ffmpeg fails%s%s", line[0] ? ": " : "", line);
}

rg_status rg_video_add(rg_video *v, const unsigned char *rgb, rg_diag *why)
{
    const int error = write_all(v->pipe, rgb, v->bytes);
    if (error == 0) return RG_OK;
    if (error != EPIPE) return rg_fail(RG_EWRITE, why, 0, "ffmpeg: %s", strerror(error));
    wait_for(v);
    return failed(v, why);
}

rg_status rg_video_finish(rg_video *v, rg_diag *why)
{
    close(v->pipe);
    v->pipe = -1;
    const int status = wait_for(v);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? RG_OK : failed(v, why);
}

void rg_video_destroy(rg_video *v)
{
    if (!v) return;
    if (v->pipe >= 0) close(v->pipe);
    if (v->child > 0) {
        kill(v->child, SIGKILL);
        wait_for(v);
    }
    if (v->said) fclose(v->said);
    rg_mem_free(&v->mem, v);
}
