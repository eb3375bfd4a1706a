/* Folds every crease pattern of a folder, as many at a time as there are processors, and prints a line for each.
 * Handles are not shared between threads, so nothing has to be locked but the list and the printing.  ./folder
 * patterns/ */
#include <dirent.h>
#include <pthread.h>
#include <rigami.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct work { const char *folder; DIR *list; pthread_mutex_t lock; int failed; } work;

/* The next file; 0: there is none. */
static int next(work *w, char *path, size_t room)
{
    struct dirent *d;
    pthread_mutex_lock(&w->lock);
    while ((d = readdir(w->list)) && (d->d_name[0] == '.' || !strrchr(d->d_name, '.') || strstr(d->d_name, ".md")))
        continue;
    if (d) snprintf(path, room, "%s/%s", w->folder, d->d_name);
    pthread_mutex_unlock(&w->lock);
    return d != NULL;
}

static void *fold(void *arg)
{
    work *w = arg;
    char path[4096];
    rg_settings settings = rg_settings_default();
    settings.threads = 1; /* each of ours is one */
    settings.effort = RG_EFFORT_FAST;
    while (next(w, path, sizeof path)) {
        rg_pattern *pattern = NULL;
        rg_motion *motion = NULL;
        rg_diag why = {0};
        rg_status s = rg_pattern_read(path, NULL, &pattern, &why);
        if (s == RG_OK) s = rg_motion_create(pattern, &settings, NULL, NULL, &motion, &why);
        pthread_mutex_lock(&w->lock);
        if (s == RG_OK) printf("%-40s %5.1f %%\n", path, rg_motion_report(motion)->folded_percent);
        else printf("%-40s %s\n", path, why.text);
        w->failed |= s == RG_ENOMEM;
        pthread_mutex_unlock(&w->lock);
        rg_motion_destroy(motion);
        rg_pattern_destroy(pattern);
    }
    return NULL;
}

int main(int argc, char **argv)
{
    enum { MOST = 64 };
    if (argc != 2) return fprintf(stderr, "usage: %s folder\n", argv[0]), 2;
    work w = {.folder = argv[1], .list = opendir(argv[1])};
    if (!w.list) return perror(argv[1]), 2;
    pthread_mutex_init(&w.lock, NULL);
    pthread_t thread[MOST];
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int threads = 0;
    while (threads < MOST && threads < processors && pthread_create(&thread[threads], NULL, fold, &w) == 0) threads++;
    if (!threads) fold(&w);
    for (int i = 0; i < threads; i++) pthread_join(thread[i], NULL);
    pthread_mutex_destroy(&w.lock);
    closedir(w.list);
    return w.failed;
}
