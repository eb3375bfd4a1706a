/* rigami batch -- many files, each folded by itself: on all processors, to one table, going on where it was
 * interrupted. */
#include "commands.h"
#include "input.h"
#include "interrupt.h"
#include "say.h"
#include "tasks.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { ROOM = 4096, ROW = 2048 };
/* Seconds that are left for the table when the files that are being folded have been interrupted. */
#define TO_BURY 0.2

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

/* A field of CSV: what would part it is replaced. */
static void put_text(const char *text, FILE *out)
{
    for (; text && *text; text++)
        fputc(*text == ',' ? ';' : *text == '"' || (unsigned char)*text < 32 ? ' ' : *text, out);
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

/* Written whole or not at all, so that a row that is there is one that counts. */
typedef struct row { FILE *out; char path[ROOM], temporary[ROOM + 16]; } row;

static int row_begin(row *r, const char *folder, const task *t)
{
    snprintf(r->path, sizeof r->path, "%s/rows/%s.csv", folder, t->name);
    snprintf(r->temporary, sizeof r->temporary, "%s.%ld", r->path, (long)getpid());
    r->out = fopen(r->temporary, "w");
    if (!r->out) say("%s: %s", r->temporary, strerror(errno));
    return r->out ? ENDS_WELL : ENDS_UNWRITTEN;
}

static int row_end(row *r)
{
    if (fclose(r->out) == 0 && rename(r->temporary, r->path) == 0) return ENDS_WELL;
    say("%s: %s", r->path, strerror(errno));
    unlink(r->temporary);
    return ENDS_UNWRITTEN;
}

/* The row that is kept of a task, of a run with the same file, options and program; 0: there is none. */
static int kept(const char *folder, const task *t, char text[ROW])
{
    char path[ROOM];
    snprintf(path, sizeof path, "%s/rows/%s.csv", folder, t->name);
    FILE *f = fopen(path, "r");
    const int there =
        f && fgets(text, ROW, f) && strncmp(text, t->key, strlen(t->key)) == 0 && text[strlen(t->key)] == ',';
    if (f) fclose(f);
    return there;
}

/* ---------------------------------------------------------------------------------------------------- a child ---- */

typedef struct outcome { const options *o; const task *t; const char *folder; int written; row row; } outcome;

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

static void keep_report(void *ctx, const rg_motion *m, int status)
{
    outcome *c = ctx;
    const double seconds = (double)clock() / CLOCKS_PER_SEC;
    char judged[300] = "";
    alarm(0); /* the limit is that of folding, which is done */
    if (c->o->verify && status != ENDS_UNWRITTEN) verify(c, judged);
    if (interrupt_came() || row_begin(&c->row, c->folder, c->t) != ENDS_WELL) return;
    put_report(c->t, status, rg_motion_report(m), seconds, judged, c->row.out);
    c->written = row_end(&c->row) == ENDS_WELL;
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
    if (!freopen(log, "w", stderr) || !freopen(log, "a", stdout)) return ENDS_UNWRITTEN;
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
    if (o->limit > 0) alarm((unsigned)o->limit);
    const int status = fold_one(&one, keep_report, &c);
    fflush(stderr);
    if (c.written || interrupt_came()) return status;
    FILE *f = fopen(log, "r");
    if (f && fgets(why, sizeof why, f)) why[strcspn(why, "\n")] = 0;
    if (f) fclose(f);
    if (row_begin(&c.row, folder, t) != ENDS_WELL) return ENDS_UNWRITTEN;
    put_failure(t, status, status == ENDS_USAGE ? "refused" : "failed",
                strncmp(why, "rigami: ", 8) == 0 ? why + 8 : why, c.row.out);
    return row_end(&c.row) == ENDS_WELL ? status : ENDS_UNWRITTEN;
}

/* ----------------------------------------------------------------------------------------------------- parent ---- */

/* Field k of a row, from 0. */
static const char *field(const char *text, int k, char out[ROW])
{
    for (; k > 0 && (text = strchr(text, ',')); k--) text++;
    snprintf(out, ROW, "%.*s", text ? (int)strcspn(text, ",\n") : 0, text ? text : "");
    return out;
}

static void tell(const options *o, const task *t, const char *text, int done, int count, int again)
{
    char end[ROW], percent[ROW], seconds[ROW];
    if (o->quiet) return;
    printf("[%d/%d] %s", done, count, t->file);
    if (t->sheet) printf(", sheet %d", (int)t->sheet);
    printf(": %s", field(text, OUTCOME, end));
    if (*field(text, PERCENT, percent)) printf(", %.1f %%", atof(percent));
    if (*field(text, SECONDS, seconds)) printf(", %.2f s", atof(seconds));
    puts(again ? " (kept)" : "");
    fflush(stdout);
}

/* A child that did not end by itself has written no row. */
static int bury(const options *o, const char *folder, const task *t, int status)
{
    char text[ROW];
    row r;
    if (WIFEXITED(status) && (kept(folder, t, text) || interrupt_came())) return WEXITSTATUS(status);
    const int late = WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM;
    char why[100];
    snprintf(why, sizeof why, late ? "not done within %.0f seconds" : "the program ended with signal %.0f",
             late ? o->limit : (double)WTERMSIG(status));
    if (row_begin(&r, folder, t) != ENDS_WELL) return ENDS_UNWRITTEN;
    put_failure(t,
                late                  ? 124
                : WIFSIGNALED(status) ? 128 + WTERMSIG(status)
                                      : WEXITSTATUS(status),
                late ? "timeout" : "failed", why, r.out);
    return row_end(&r) == ENDS_WELL ? ENDS_SHORT : ENDS_UNWRITTEN;
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

static int run_all(const options *o, const char *folder, const tasks *q)
{
    pool p;
    int done = 0, next = 0, worst = pool_init(&p, o, q);
    char text[ROW];
    interrupt_hold(INTERRUPT_GRACE + TO_BURY);
    while (worst != ENDS_UNWRITTEN && (next < q->count || p.running > 0)) {
        for (; next < q->count && p.running < p.jobs && !interrupt_came() && worst != ENDS_UNWRITTEN; next++) {
            const int i = p.order[next].task;
            if (!o->fresh && kept(folder, &q->task[i], text)) tell(o, &q->task[i], text, ++done, q->count, 1);
            else worst = start(o, folder, q, i, &p);
        }
        int status = 0;
        const int i = await(&p, &status);
        if (i < 0 && (interrupt_came() || next >= q->count)) break;
        if (i < 0) continue;
        if (bury(o, folder, &q->task[i], status) == ENDS_UNWRITTEN) worst = ENDS_UNWRITTEN;
        if (kept(folder, &q->task[i], text)) tell(o, &q->task[i], text, ++done, q->count, 0);
    }
    for (int status; await(&p, &status) >= 0;) continue;
    pool_free(&p);
    return worst;
}

/* ------------------------------------------------------------------------------------------------------ table ---- */

/* The rows that there are, in the order of the files: as CSV, and for people. Returns how many are not there; -1: not
 * written. */
static int write_tables(const char *folder, const char *name, const tasks *q, int *bad)
{
    char path[ROOM], text[ROW], a[ROW], b[ROW], c[ROW], d[ROW], e[ROW];
    int missing = 0;
    snprintf(path, sizeof path, "%s/%s.csv", folder, name);
    FILE *csv = fopen(path, "w");
    snprintf(path, sizeof path, "%s/%s.txt", folder, name);
    FILE *people = csv ? fopen(path, "w") : NULL;
    if (!people) say("%s: %s", path, strerror(errno));
    if (people) {
        fprintf(csv, "%s\n", COLUMNS);
        fprintf(people, "%-44s %-9s %9s %9s %9s  %-12s %-8s %s\n", "file", "outcome", "percent", "moved", "seconds",
                "contact", "verify", "reason");
    }
    *bad = 0;
    for (int i = 0; people && i < q->count; i++) {
        const task *t = &q->task[i];
        if (!kept(folder, t, text)) {
            missing++;
            continue;
        }
        fputs(text, csv);
        *bad += atoi(field(text, EXIT, a)) != ENDS_WELL;
        fprintf(people, "%-44s %-9s %9.1f %9.2g %9.2f  ", t->file, field(text, OUTCOME, a),
                atof(field(text, PERCENT, b)), atof(field(text, MOVED, c)), atof(field(text, SECONDS, d)));
        if (*field(text, CROSSES_FROM, b)) snprintf(a, sizeof a, "from %.0f %%", atof(b));
        else field(text, CONTACT, a);
        field(text, VERIFY, b);
        fprintf(people, "%-12s %-8s %s\n", a, !*b || strcmp(b, "valid") == 0 ? b : "refused", field(text, REASON, e));
    }
    const int written = people && fclose(people) == 0 && fclose(csv) == 0;
    if (!people && csv) fclose(csv);
    return written ? missing : -1;
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
    int bad;
    if (o->parts > 1 && !o->merge) snprintf(name, sizeof name, "part-%d-of-%d", (int)o->part, (int)o->parts);
    const int missing = write_tables(folder, name, q, &bad);
    if (missing < 0) return ENDS_UNWRITTEN;
    if (missing && interrupt_came())
        say("batch: interrupted: %d of %d are done; the same command goes on", q->count - missing, q->count);
    else if (missing) say("batch: %d of %d files have no row in %s yet", missing, q->count, folder);
    if (!o->quiet)
        printf("%d files, %d folded, %d not; %s/%s.csv, %s/%s.txt\n", q->count - missing, q->count - missing - bad, bad,
               folder, name, folder, name);
    return missing || bad ? ENDS_SHORT : ENDS_WELL;
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
    snprintf(folder, sizeof folder, "%s", o->output[0]);
    while (strlen(folder) > 1 && folder[strlen(folder) - 1] == '/') folder[strlen(folder) - 1] = 0;
    for (int i = 0; i < o->forms; i++) {
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
