/* rigami batch -- many files, each folded by itself: on all processors, to one table, going on where it was
 * interrupted. */
#include "commands.h"
#include "input.h"
#include "interrupt.h"
#include "say.h"
#include "tasks.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { ROOM = 4096, FIELD = 512 };
/* Seconds that are left for the table when the files that are being folded have been interrupted. */
#define TO_BURY 0.2
/* What comes behind the folder in a path: rows/, a name, an ending. */
enum { ROOM_FOR_NAMES = 400 };

/* The columns; where the program reads them again, their places. */
enum {
    EXIT = 3,
    OUTCOME = 4,
    PERCENT = 5,
    MOVED = 18,
    SECONDS = 21,
    CONTACT = 23,
    CROSSES_FROM = 24,
    VERIFY = 29,
    REASON = 30
};
static const char COLUMNS[] =
    "key,file,sheet,exit,outcome,folded_percent,least_folded_percent,creases,interior_vertices,closed_vertices,added_"
    "creases,"
    "strategy,tries,adjust_gain,max_closure_residual,max_edge_strain,max_facet_gap,max_overfold_deg,max_adjustment,"
    "max_strain_from_original,layers,seconds,processor_seconds,contact,first_contact_percent,contact_frames,contact_"
    "pairs,"
    "contact_depth,contact_unproved,verify,reason";

/* ----------------------------------------------------------------------------------------------------- a row ---- */

/* A field of CSV: what would part it, or a line, is replaced. */
static void put_text(const char *text, FILE *out)
{
    for (; text && *text; text++)
        fputc(*text == ',' ? ';' : *text == '"' || (unsigned char)*text < 32 || *text == 127 ? ' ' : *text, out);
}

static void put_number(double x, FILE *out) { fprintf(out, ",%.9g", x); }

/* What is known of a file that was not folded to an end: how it ended and why. */
static void put_failure(const task *t, int exit, const char *outcome, const char *reason, FILE *out)
{
    fprintf(out, "%s,", t->key);
    put_text(t->file, out);
    fprintf(out, ",%d,%d,%s", (int)t->sheet, exit, outcome);
    for (int i = OUTCOME; i < REASON; i++) fputc(',', out);
    put_text(reason, out);
    fputc('\n', out);
}

/* `verify`: what another judge says of the motion, empty: it was not asked. */
static void put_report(const task *t, int exit, const rg_report *r, double processor_seconds, const char *verify,
                       FILE *out)
{
    static const char *const contact[] = {
        [RG_CONTACT_UNCHECKED] = "unchecked", [RG_CONTACT_FREE] = "free", [RG_CONTACT_CROSSES] = "crosses"};
    fprintf(out, "%s,", t->key);
    put_text(t->file, out);
    fprintf(out, ",%d,%d,%s", (int)t->sheet, exit,
            r->outcome == RG_FOLDED  ? "folded"
            : r->outcome == RG_RESTS ? "rests"
                                     : "stopped");
    put_number(r->folded_percent, out);
    put_number(r->least_folded_percent, out);
    fprintf(out, ",%d,%d,%d,%d,", (int)r->pattern->creases, (int)r->pattern->interior_vertices,
            (int)r->pattern->closed_vertices, (int)r->added_creases);
    put_text(r->strategy, out);
    fprintf(out, ",%d", (int)r->tries);
    const double numbers[] = {
        r->adjust_gain,      r->max_closure_residual, r->max_edge_strain,         r->max_facet_gap,
        r->max_overfold_deg, r->max_adjustment,       r->max_strain_from_original};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) put_number(numbers[i], out);
    fprintf(out, ",%s", r->layers);
    put_number(r->seconds_total, out);
    put_number(processor_seconds, out);
    fprintf(out, ",%s", contact[r->contact]);
    if (r->contact == RG_CONTACT_CROSSES) put_number(r->first_contact_percent, out);
    else fputc(',', out);
    fprintf(out, ",%d,%d", (int)r->contact_frames, (int)r->contact_pairs);
    put_number(r->contact_depth, out);
    fprintf(out, ",%d,", (int)r->contact_unproved);
    put_text(verify, out);
    fputc(',', out);
    put_text(r->reason, out);
    fputc('\n', out);
}

/* A file that is written whole or not at all, so that a row that is there is one that counts, and a table is not lost
 * for one that has no room. Temporary names are those that rg_output_sweep knows. */
typedef struct whole { FILE *out; char path[ROOM], temporary[ROOM + 40]; } whole;

static int whole_begin(whole *w, const char *path)
{
    snprintf(w->path, sizeof w->path, "%s", path);
    snprintf(w->temporary, sizeof w->temporary, "%s.%ld-0.part", path, (long)getpid());
    rg_output_sweep(path, 0);
    w->out = fopen(w->temporary, "w");
    if (w->out) flock(fileno(w->out), LOCK_EX | LOCK_NB); /* somebody is at it */
    else say("%s: %s", path, strerror(errno));
    return w->out ? ENDS_WELL : ENDS_UNWRITTEN;
}

static int whole_end(whole *w)
{
    errno = 0;
    const int written = fflush(w->out) == 0 && !ferror(w->out) && (fsync(fileno(w->out)) == 0 || errno == EINVAL);
    const int why = errno;
    if (fclose(w->out) == 0 && written && rename(w->temporary, w->path) == 0) return ENDS_WELL;
    say("%s: %s", w->path, why || errno ? strerror(why ? why : errno) : "not all of it could be written");
    unlink(w->temporary);
    return ENDS_UNWRITTEN;
}

static const char *row_path(const char *folder, const task *t, char path[ROOM])
{
    snprintf(path, ROOM, "%s/rows/%s.csv", folder, t->name);
    return path;
}

static int row_begin(whole *w, const char *folder, const task *t)
{
    char path[ROOM];
    return whole_begin(w, row_path(folder, t, path));
}

/* Writes the row of a file that was not folded to an end. */
static int row_of_failure(const char *folder, const task *t, int exit, const char *outcome, const char *reason)
{
    whole w;
    if (row_begin(&w, folder, t) != ENDS_WELL) return ENDS_UNWRITTEN;
    put_failure(t, exit, outcome, reason, w.out);
    return whole_end(&w);
}

/* The row that is kept of a task, of a run with the same file, options and program; NULL: there is none. Owner: the
 * caller, free. */
static char *kept(const char *folder, const task *t)
{
    char path[ROOM], *text = NULL;
    size_t room = 0;
    FILE *f = fopen(row_path(folder, t, path), "r");
    const ssize_t n = f ? getline(&text, &room, f) : -1;
    if (f) fclose(f);
    const size_t key = strlen(t->key);
    if (n > (ssize_t)key && text[n - 1] == '\n' && memcmp(text, t->key, key) == 0 && text[key] == ',') return text;
    free(text);
    return NULL;
}

/* Field k of a row, from 0. */
static const char *field(const char *text, int k, char out[FIELD])
{
    for (; k > 0 && (text = strchr(text, ',')); k--) text++;
    snprintf(out, FIELD, "%.*s", text ? (int)strcspn(text, ",\n") : 0, text ? text : "");
    return out;
}

static void say_late(const options *o, char why[FIELD])
{
    snprintf(why, FIELD, "not done within %.10g seconds", o->limit);
}

/* Report and outputs are there; of frames, each in its file, nothing is known. */
static int has_outputs(const options *o, const char *folder, const task *t)
{
    char path[ROOM];
    int all = 1;
    for (int i = -1; i < o->forms && all; i++) {
        if (i >= 0 && strchr(o->form[i], '%')) continue;
        snprintf(path, sizeof path, "%s/%s.%s", folder, t->name, i < 0 ? "json" : o->form[i]);
        all = access(path, F_OK) == 0;
    }
    return all;
}

/* Whether a row says all that there is to say: not what was cut off by another limit, killed, or for want of memory or
 * of room, and not what is no longer there. */
static int is_done(const options *o, const char *folder, const task *t, const char *text)
{
    char one[FIELD], late[FIELD];
    say_late(o, late);
    if (strcmp(field(text, OUTCOME, one), "timeout") == 0) return strcmp(field(text, REASON, one), late) == 0;
    const int status = atoi(field(text, EXIT, one));
    return status == ENDS_USAGE || (status < ENDS_USAGE && has_outputs(o, folder, t));
}

/* ---------------------------------------------------------------------------------------------------- a child ---- */

typedef struct outcome { const options *o; const task *t; const char *folder; int written; } outcome;

/* The motion just written, judged from its file alone as `rigami verify` does: "valid", or the first fault. */
static void verify(const outcome *c, char text[300])
{
    char path[ROOM];
    rg_pattern *given = NULL;
    rg_certificate *judged = NULL;
    const rg_fault *fault;
    rg_diag why = {0, ""};
    options quiet = *c->o;
    quiet.quiet = 1; /* folding has passed the reader's warnings on */
    snprintf(path, sizeof path, "%s/%s.fold", c->folder, c->t->name);
    if (input_read(&quiet, 0, &given) == ENDS_WELL &&
        rg_certificate_create(path, given, NULL, &judged, &why) == RG_OK) {
        if (rg_certificate_get_info(judged)->valid || rg_certificate_faults(judged, &fault) < 1)
            snprintf(text, 300, "valid");
        else if (fault->frame < 0) snprintf(text, 300, "%s", fault->text);
        else
            snprintf(text, 300, "frame %d: %s%s", (int)fault->frame, fault->facet[0] >= 0 ? "facets " : "",
                     fault->text);
    } else snprintf(text, 300, "cannot be read: %s", why.text);
    rg_certificate_destroy(judged);
    rg_pattern_destroy(given);
}

/* The signal that ends this process after so many seconds; 0: none. */
static void set_limit(double seconds)
{
    const double full = floor(seconds);
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)full, .tv_usec = (suseconds_t)(1e6 * (seconds - full))}};
    setitimer(ITIMER_REAL, &timer, NULL);
}

static void keep_report(void *ctx, const rg_motion *m, int status)
{
    outcome *c = ctx;
    whole row;
    const double seconds = (double)clock() / CLOCKS_PER_SEC;
    char judged[300] = "";
    set_limit(0); /* the limit is that of folding, which is done */
    if (c->o->verify && status != ENDS_UNWRITTEN) verify(c, judged);
    if (interrupt_came() || row_begin(&row, c->folder, c->t) != ENDS_WELL) return;
    put_report(c->t, status, rg_motion_report(m), seconds, judged, row.out);
    c->written = whole_end(&row) == ENDS_WELL;
}

/* Folds one file, in a process of its own; what it says goes to NAME.log. */
static int child(const options *o, const char *folder, const task *t, int threads)
{
    char log[ROOM], report[ROOM], why[300] = "";
    char (*form)[ROOM] = calloc((size_t)o->forms + 1, sizeof *form);
    const char **output = calloc((size_t)o->forms + 1, sizeof *output);
    if (!form || !output) return ENDS_UNWRITTEN;
    options one = *o;
    outcome c = {.o = &one, .t = t, .folder = folder};
    snprintf(log, sizeof log, "%s/%s.log", folder, t->name);
    snprintf(report, sizeof report, "%s/%s.json", folder, t->name);
    for (int i = 0; i < o->forms; i++) {
        snprintf(form[i], sizeof form[i], "%s/%s.%s", folder, t->name, o->form[i]);
        output[i] = form[i];
    }
    interrupt_init();
    signal(SIGALRM, SIG_DFL); /* its own limit of time ends it there and then, and is told as that */
#if defined(__linux__)
    prctl(PR_SET_PDEATHSIG, SIGTERM); /* whatever ends the batch ends its parts */
#endif
    interrupt_outputs(&one);
    if (!freopen(log, "w", stderr) || !freopen(log, "a", stdout)) {
        snprintf(why, sizeof why, "%.200s.log: %s", t->name, strerror(errno));
        row_of_failure(folder, t, ENDS_UNWRITTEN, "failed", why);
        return ENDS_UNWRITTEN;
    }
    setvbuf(stderr, NULL, _IOLBF, 0);
    one.operand = (const char *[]){t->file};
    one.operands = 1;
    one.output = output;
    one.outputs = o->forms;
    one.report = report;
    one.reading.sheet = t->sheet;
    one.settings.threads = threads;
    one.progress = 0;
    one.quiet = 0;
    set_limit(o->limit);
    const int status = fold_one(&one, keep_report, &c);
    fflush(stderr);
    if (c.written || interrupt_came()) return status;
    FILE *f = fopen(log, "r");
    if (f && fgets(why, sizeof why, f)) why[strcspn(why, "\n")] = 0;
    if (f) fclose(f);
    return row_of_failure(folder, t, status, status == ENDS_USAGE ? "refused" : "failed",
                          strncmp(why, "rigami: ", 8) == 0 ? why + 8 : why) == ENDS_WELL
               ? status
               : ENDS_UNWRITTEN;
}

/* ----------------------------------------------------------------------------------------------------- parent ---- */

static void tell(const options *o, const task *t, const char *text, int done, int count, int again)
{
    char end[FIELD], percent[FIELD], seconds[FIELD], file[FIELD];
    if (o->quiet) return;
    printf("[%d/%d] %s", done, count, say_plain(t->file, file, sizeof file));
    if (t->sheet) printf(", sheet %d", (int)t->sheet);
    printf(": %s", field(text, OUTCOME, end));
    if (*field(text, PERCENT, percent)) printf(", %.1f %%", atof(percent));
    if (*field(text, SECONDS, seconds)) printf(", %.2f s", atof(seconds));
    puts(again ? " (kept)" : "");
    fflush(stdout);
}

/* What a child has left that was killed while it wrote. */
static void sweep(const options *o, const char *folder, const task *t)
{
    char path[ROOM];
    for (int i = -1; i < o->forms; i++) {
        snprintf(path, sizeof path, "%s/%s.%s", folder, t->name, i < 0 ? "json" : o->form[i]);
        rg_output_sweep(path, 0);
    }
    rg_output_sweep(row_path(folder, t, path), 0);
}

/* A child that did not end by itself has written no row. ENDS_UNWRITTEN: there can be no rows. */
static int bury(const options *o, const char *folder, const task *t, int status)
{
    char why[FIELD], *text = WIFEXITED(status) ? kept(folder, t) : NULL;
    const int has_row = text != NULL;
    free(text);
    if (has_row || (WIFEXITED(status) && interrupt_came())) return ENDS_WELL;
    sweep(o, folder, t);
    if (WIFEXITED(status)) {
        snprintf(why, sizeof why, "the program ended with status %d and kept no row", WEXITSTATUS(status));
        return row_of_failure(folder, t, WEXITSTATUS(status), "failed", why);
    }
    if (WTERMSIG(status) == SIGALRM) {
        say_late(o, why);
        return row_of_failure(folder, t, 124, "timeout", why);
    }
    snprintf(why, sizeof why, "the program ended with signal %d", WTERMSIG(status));
    return row_of_failure(folder, t, 128 + WTERMSIG(status), "failed", why);
}

typedef struct turn { int32_t creases; int task; } turn;
typedef struct pool { pid_t *pid; int *task; turn *order; int jobs, running, threads, told; } pool;

/* Those with most creases first: a long one that begins last is waited for by idle processors. */
static int by_creases(const void *a, const void *b)
{
    const turn *p = a, *q = b;
    return p->creases != q->creases ? (p->creases < q->creases) - (p->creases > q->creases)
                                    : (p->task > q->task) - (p->task < q->task);
}

/* A file has a processor to itself; where there are fewer files than processors, more of them. */
static int pool_init(pool *p, const options *o, const tasks *q)
{
    *p = (pool){.jobs = o->jobs > 0 ? o->jobs : (int)sysconf(_SC_NPROCESSORS_ONLN)};
    if (p->jobs < 1) p->jobs = 1;
    p->threads = q->count > 0 && p->jobs > q->count ? p->jobs / q->count : 1;
    p->pid = calloc((size_t)p->jobs, sizeof *p->pid);
    p->task = calloc((size_t)p->jobs, sizeof *p->task);
    p->order = calloc((size_t)q->count + 1, sizeof *p->order);
    if (!p->pid || !p->task || !p->order) return say_status(RG_ENOMEM, NULL, &(rg_diag){0, ""});
    for (int i = 0; i < q->count; i++) p->order[i] = (turn){q->task[i].creases, i};
    qsort(p->order, (size_t)q->count, sizeof *p->order, by_creases);
    return ENDS_WELL;
}

static void pool_free(pool *p)
{
    free(p->pid);
    free(p->task);
    free(p->order);
}

static int start(const options *o, const char *folder, const tasks *q, int i, pool *p)
{
    fflush(NULL);
    const pid_t pid = fork();
    if (pid < 0) {
        say("batch: %s", strerror(errno));
        return ENDS_UNWRITTEN;
    }
    if (pid == 0) {
        const int status = child(o, folder, &q->task[i], p->threads);
        fflush(NULL);
        _exit(status);
    }
    p->pid[p->running] = pid;
    p->task[p->running++] = i;
    return ENDS_WELL;
}

/* Waits for one to end; its task, -1: none. An interrupt is passed on once. */
static int await(pool *p, int *status)
{
    static const struct timespec between = {0, 10000000};
    for (pid_t pid; p->running > 0;) {
        if (interrupt_came() && !p->told)
            for (int k = p->told = 1; k <= p->running; k++) kill(p->pid[k - 1], SIGTERM);
        pid = waitpid(-1, status, WNOHANG);
        if (pid == 0) nanosleep(&between, NULL);
        if (pid == 0 || (pid < 0 && errno == EINTR)) continue;
        if (pid < 0) return -1;
        for (int k = 0; k < p->running; k++) {
            if (p->pid[k] != pid) continue;
            const int ended = p->task[k];
            p->running--;
            p->pid[k] = p->pid[p->running];
            p->task[k] = p->task[p->running];
            return ended;
        }
    }
    return -1;
}

/* Tells of a task that has a row; non-zero: it has one, and of a run that need not be done again. */
static int tell_kept(const options *o, const char *folder, const tasks *q, int i, int *done, int again)
{
    char *text = kept(folder, &q->task[i]);
    const int counts = text && (!again || is_done(o, folder, &q->task[i], text));
    if (counts) tell(o, &q->task[i], text, ++*done, q->count, again);
    free(text);
    return counts;
}

static int run_all(const options *o, const char *folder, const tasks *q)
{
    pool p;
    int done = 0, next = 0, worst = pool_init(&p, o, q);
    interrupt_hold(INTERRUPT_GRACE + TO_BURY);
    while (worst != ENDS_UNWRITTEN && (next < q->count || p.running > 0)) {
        for (; next < q->count && p.running < p.jobs && !interrupt_came() && worst != ENDS_UNWRITTEN; next++) {
            const int i = p.order[next].task;
            if (o->fresh || !tell_kept(o, folder, q, i, &done, 1)) worst = start(o, folder, q, i, &p);
        }
        int status = 0;
        const int i = await(&p, &status);
        if (i < 0 && (interrupt_came() || next >= q->count)) break;
        if (i < 0) continue;
        if (bury(o, folder, &q->task[i], status) != ENDS_WELL) worst = ENDS_UNWRITTEN;
        tell_kept(o, folder, q, i, &done, 0);
    }
    for (int status; await(&p, &status) >= 0;) continue;
    pool_free(&p);
    return worst;
}

/* ------------------------------------------------------------------------------------------------------ table ---- */

/* What became of all: files without a row, those that do not fold, and of them those that could not be written. */
typedef struct count { int missing, bad, unwritten; } count;

static void put_line(const task *t, const char *text, FILE *people)
{
    char a[FIELD], b[FIELD], c[FIELD], d[FIELD], e[FIELD], file[ROOM];
    fprintf(people, "%-44s %-9s %9.1f %9.2g %9.2f  ", say_plain(t->file, file, sizeof file), field(text, OUTCOME, a),
            atof(field(text, PERCENT, b)), atof(field(text, MOVED, c)), atof(field(text, SECONDS, d)));
    if (*field(text, CROSSES_FROM, b)) snprintf(a, sizeof a, "from %.0f %%", atof(b));
    else field(text, CONTACT, a);
    field(text, VERIFY, b);
    fprintf(people, "%-12s %-8s %s\n", a, !*b || strcmp(b, "valid") == 0 ? b : "refused", field(text, REASON, e));
}

static void put_tables(const char *folder, const tasks *q, FILE *csv, FILE *people, count *n)
{
    char exit[FIELD];
    fprintf(csv, "%s\n", COLUMNS);
    fprintf(people, "%-44s %-9s %9s %9s %9s  %-12s %-8s %s\n", "file", "outcome", "percent", "moved", "seconds",
            "contact", "verify", "reason");
    for (int i = 0; i < q->count; i++) {
        char *text = kept(folder, &q->task[i]);
        if (text) {
            const int status = atoi(field(text, EXIT, exit));
            n->bad += status != ENDS_WELL;
            n->unwritten += status == ENDS_UNWRITTEN;
            fputs(text, csv);
            put_line(&q->task[i], text, people);
        } else n->missing++;
        free(text);
    }
}

/* The rows that there are, in the order of the files: as CSV, and for people. */
static int write_tables(const char *folder, const char *name, const tasks *q, count *n)
{
    char path[2][ROOM];
    whole csv, people;
    *n = (count){0, 0, 0};
    snprintf(path[0], ROOM, "%s/%s.csv", folder, name);
    snprintf(path[1], ROOM, "%s/%s.txt", folder, name);
    if (whole_begin(&csv, path[0]) != ENDS_WELL) return ENDS_UNWRITTEN;
    if (whole_begin(&people, path[1]) != ENDS_WELL) {
        fclose(csv.out);
        unlink(csv.temporary);
        return ENDS_UNWRITTEN;
    }
    put_tables(folder, q, csv.out, people.out, n);
    const int first = whole_end(&csv), second = whole_end(&people);
    return first == ENDS_WELL ? second : first;
}

static int prepare(const char *folder)
{
    char rows[ROOM];
    snprintf(rows, sizeof rows, "%s/rows", folder);
    if ((mkdir(folder, 0777) == 0 || errno == EEXIST) && (mkdir(rows, 0777) == 0 || errno == EEXIST)) return ENDS_WELL;
    say("%s: %s", folder, strerror(errno));
    return ENDS_UNWRITTEN;
}

static int finish(const options *o, const char *folder, const tasks *q)
{
    char name[60] = "table";
    count n;
    if (o->parts > 1 && !o->merge) snprintf(name, sizeof name, "part-%d-of-%d", (int)o->part, (int)o->parts);
    if (write_tables(folder, name, q, &n) != ENDS_WELL) return ENDS_UNWRITTEN;
    const int there = q->count - n.missing;
    if (n.missing && interrupt_came())
        say("batch: interrupted: %d of %d are done; the same command goes on", there, q->count);
    else if (n.missing) say("batch: %d of %d files have no row in %s yet", n.missing, q->count, folder);
    if (n.unwritten)
        say("batch: outputs of %d of %d files could not be written, and %s/%s.txt says why; the same command tries "
            "again",
            n.unwritten, q->count, folder, name);
    if (!o->quiet)
        printf("%d files, %d folded, %d not; %s/%s.csv, %s/%s.txt\n", there, there - n.bad, n.bad, folder, name, folder,
               name);
    return n.unwritten ? ENDS_UNWRITTEN : n.missing || n.bad ? ENDS_SHORT : ENDS_WELL;
}

int cmd_batch(const options *o)
{
    char folder[ROOM];
    tasks q;
    if (o->outputs != 1 || o->report) {
        say(o->report    ? "batch: every file has a report of its own in DIR: no --report"
            : o->outputs ? "batch: one -o DIR/ is enough"
                         : "batch: -o DIR/ is missing");
        return ENDS_USAGE;
    }
    for (int i = 0; i < o->operands; i++)
        if (strcmp(o->operand[i], "-") == 0) {
            say("batch: standard input has no name to go by: name files");
            return ENDS_USAGE;
        }
    if (snprintf(folder, sizeof folder, "%s", o->output[0]) + ROOM_FOR_NAMES >= ROOM) {
        say("%.100s...: %s", o->output[0], strerror(ENAMETOOLONG));
        return ENDS_UNWRITTEN;
    }
    while (strlen(folder) > 1 && folder[strlen(folder) - 1] == '/') folder[strlen(folder) - 1] = 0;
    for (int i = 0; i < o->forms; i++) {
        int twice = 0;
        for (int k = 0; k < i; k++) twice |= strcmp(o->form[i], o->form[k]) == 0;
        if (twice || strchr(o->form[i], '/')) {
            say("--write: \"%s\" %s", o->form[i], twice ? "is asked for twice" : "is no ending of a name");
            return ENDS_USAGE;
        }
        char file[300];
        rg_diag why = {0, ""};
        snprintf(file, sizeof file, "x.%.200s", o->form[i]);
        const rg_status s = rg_output_check(file, &why);
        if (s != RG_OK) return say_status(s, "batch", &why);
    }
    int status = prepare(folder);
    if (status == ENDS_WELL) status = tasks_find(o, &q);
    if (status != ENDS_WELL) return status;
    if (!o->merge) status = run_all(o, folder, &q);
    if (status != ENDS_UNWRITTEN) status = finish(o, folder, &q);
    tasks_free(&q);
    return status;
}
