#include "fuzz.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

void broken(const char *what, const char *file, int line)
{
    fprintf(stderr, "%s:%d: a promise is broken: %s\n", file, line, what);
    abort();
}

static double spent(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double begun;

void watch_begin(void) { begun = spent(); }

void watch_end(double seconds)
{
    const double took = spent() - begun;
    if (took <= seconds) return;
    fprintf(stderr, "a hang: %.2f s of processor time, %.2f s are allowed\n", took, seconds);
    abort();
}

void sound(rg_status s, const rg_diag *why)
{
    if (s == RG_OK) return;
    promise(s == RG_EFORMAT || s == RG_ESHEET || s == RG_EARG || s == RG_EREAD || s == RG_EABSENT);
    promise(why->text[0] != 0);
    promise(memchr(why->text, 0, sizeof why->text) != NULL);
    promise(strchr(why->text, '\n') == NULL);
    promise(why->line >= 0);
}

/* splitmix64, by S. Vigna, public domain. */
uint64_t dice_next(dice *d)
{
    uint64_t z = d->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

dice dice_of(const uint8_t *data, size_t size)
{
    uint64_t h = 0xCBF29CE484222325u; /* FNV-1a */
    for (size_t i = 0; i < size; i++) h = (h ^ data[i]) * 0x100000001B3u;
    return (dice){h};
}

enum { MOST_SCRATCH = 16 };
static char folder[200];
static char file[MOST_SCRATCH][256];
static int files;

static void clear(void)
{
    for (int i = 0; i < files; i++) remove(file[i]);
    if (folder[0]) rmdir(folder);
}

const char *scratch(const char *name)
{
    if (!folder[0]) {
        const char *place = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : getenv("TMPDIR");
        snprintf(folder, sizeof folder, "%s/rigami-fuzz-XXXXXX", place ? place : "/tmp");
        if (!mkdtemp(folder)) abort();
        atexit(clear);
    }
    for (int i = 0; i < files; i++)
        if (strcmp(strrchr(file[i], '/') + 1, name) == 0) return file[i];
    if (files == MOST_SCRATCH) abort();
    snprintf(file[files], sizeof file[files], "%s/%s", folder, name);
    return file[files++];
}

void scratch_write(const char *path, const uint8_t *data, size_t size)
{
    FILE *f = fopen(path, "wb");
    if (!f || fwrite(data, 1, size, f) != size || fclose(f) != 0) abort();
}
