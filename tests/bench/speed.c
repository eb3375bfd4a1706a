/* speed -- whole runs, measured against one CHOLMOD factorisation and one product with C of the same run of the program.
 *
 * One row a run: the best of a few, seconds of the processor (one thread, but for CHOLMOD's factorisation, which is timed by
 * the clock on the wall so that its threads do not count against it). "factorization" is the numeric one of C C^T + beta I of the
 * Miura-ori 64 x 64, triangulated, by METIS, supernodal; a "pass" is one product with its C. */
#include "fold/straight.h"
#include "pattern/build.h"
#include "generate/generate.h"
#include "motion/motion.h"
#include "pattern/pattern.h"
#include "pose/pose.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#ifdef RG_GPL
#include <cholmod.h>
#endif

static double by(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
static double cpu(void) { return by(CLOCK_PROCESS_CPUTIME_ID); }

static void give_up(const char *what, const char *why)
{
    fprintf(stderr, "bench: %s: %s\n", what, why);
    exit(1);
}

static rg_pattern *generated(const char *kind, int32_t n)
{
    const rg_memory mem = rg_mem_default(NULL);
    const rg_reading s = rg_reading_default();
    rg_lines l;
    rg_pattern *p = NULL;
    rg_diag why = {0, ""};
    if (rg_generate_lines(kind, n, 0, 0, &mem, &l, &why) != RG_OK || rg_pattern_from_lines(&l, &s, &p, &why) != RG_OK)
        give_up(kind, why.text);
    return p;
}

#ifdef RG_GPL
static double factorization(const rg_sparse *C)
{
    cholmod_common cc;
    cholmod_start(&cc);
    cc.nmethods = 1;
    cc.method[0].ordering = CHOLMOD_METIS;
    cc.supernodal = CHOLMOD_SUPERNODAL;
    size_t blocks = (size_t)C->start[C->M];
    cholmod_triplet *T = cholmod_allocate_triplet(3 * (size_t)C->M, (size_t)C->N, 3 * blocks, 0, CHOLMOD_REAL, &cc);
    int *i = T->i, *j = T->j;
    double *x = T->x;
    for (size_t b = 0; b < blocks; b++) {
        const double v[3] = {C->x[b].x, C->x[b].y, C->x[b].z};
        for (size_t a = 0; a < 3; a++) i[3 * b + a] = 3 * C->row[b] + (int)a, j[3 * b + a] = C->col[b], x[3 * b + a] = v[a];
    }
    T->nnz = 3 * blocks;
    cholmod_sparse *A = cholmod_triplet_to_sparse(T, 0, &cc), *CCt = cholmod_aat(A, NULL, 0, 1, &cc);
    CCt->stype = -1;
    cholmod_factor *L = cholmod_analyze(CCt, &cc);
    double beta[2] = {1e-9, 0}, best = INFINITY;
    for (int k = 0; k < 7; k++) {
        double from = by(CLOCK_MONOTONIC);
        cholmod_factorize_p(CCt, beta, NULL, 0, L, &cc);
        best = fmin(best, by(CLOCK_MONOTONIC) - from);
    }
    cholmod_free_triplet(&T, &cc);
    cholmod_free_sparse(&A, &cc);
    cholmod_free_sparse(&CCt, &cc);
    cholmod_free_factor(&L, &cc);
    cholmod_finish(&cc);
    return best;
}
#else
static double factorization(const rg_sparse *C)
{
    (void)C;
    return NAN;
}
#endif

#define BEST(seconds, times, code)                            \
    do {                                                      \
        (seconds) = INFINITY;                                 \
        for (int best_k = 0; best_k < (times); best_k++) {    \
            double best_from = cpu();                         \
            code;                                             \
            (seconds) = fmin((seconds), cpu() - best_from);   \
        }                                                     \
    } while (0)

typedef struct units { double factorization, pass; } units;

/* The parts of a step, on the sheet that the units are taken from. */
static units parts(void)
{
    units u;
    rg_pattern *p = generated("miura", 64);
    rg_settings s = rg_settings_default();
    s.triangulate = RG_TRIANGULATE_ALL;
    rg_straight *f = NULL;
    rg_diag why = {0, ""};
    if (rg_straight_create(p, &s, &f, &why) != RG_OK) give_up("miura 64", why.text);
    const rg_mesh *m = &f->mesh;
    rg_tree tree;
    double *y = calloc(3 * (size_t)m->M, sizeof *y), assembly, closure, pose, factor, solve;
    rg_place *place = calloc((size_t)m->nf, sizeof *place);
    rg_vec3 *x = calloc((size_t)m->nv, sizeof *x);
    if (!y || !place || !x || rg_tree_init(m, -1, &tree) != RG_OK) give_up("miura 64", "out of memory");
    for (int32_t i = 0; i < m->N; i++) f->rho[i] = 0.4 * f->end[i] + 0.1 * sin(7.3 * i);
    BEST(assembly, 50, rg_constraint_assemble(&f->K, f->rho));
    BEST(closure, 50, rg_constraint_closure(&f->K, f->rho, NULL));
    BEST(u.pass, 50, rg_sparse_mul(&f->K.C, f->rho, y));
    BEST(pose, 50, (rg_pose_facets(m, m->X, &tree, f->rho, place), rg_pose_vertices(m, m->X, &tree, place, x)));
    rg_scale_update(&f->P.scale, &f->K.C);
    BEST(factor, 10, rg_cholesky_update(&f->P.cholesky, &f->P.scale.B));
    BEST(solve, 20, rg_cholesky_apply(&f->P.cholesky, y, y));
    u.factorization = factorization(&f->K.C);
    printf("part,seconds,passes,factorizations\n");
    const struct { const char *name; double seconds; } row[] = {
        {"CHOLMOD's factorization of C C^T", u.factorization}, {"product with C", u.pass}, {"assembly of C and r", assembly},
        {"closure", closure}, {"pose", pose}, {"factorization", factor}, {"preconditioner", solve}};
    for (int k = 0; k < 7; k++)
        printf("%s,%.3g,%.3g,%.3g\n", row[k].name, row[k].seconds, row[k].seconds / u.pass, row[k].seconds / u.factorization);
    free(y), free(place), free(x);
    rg_tree_free(&tree);
    rg_straight_destroy(f);
    rg_pattern_destroy(p);
    return u;
}

static double run(const char *kind, int32_t n, rg_triangulation triangulate, double to, int32_t frames, int times, units u,
                  double *creases)
{
    rg_settings s = rg_settings_default();
    s.triangulate = triangulate;
    s.to = to;
    s.frames = frames;
    s.adjust = 0;
    s.effort = RG_EFFORT_FAST;
    s.contact = RG_CONTACT_IGNORE; /* rows are of folding alone, */
    s.threads = 1;                 /* and of one try at a time */
    rg_pattern *p = generated(kind, n);
    double best = INFINITY, solving = INFINITY;
    rg_report r = {0};
    for (int k = 0; k < times; k++) {
        rg_motion *m = NULL;
        rg_diag why = {0, ""};
        double from = cpu();
        if (rg_motion_create(p, &s, NULL, NULL, &m, &why) != RG_OK) give_up(kind, why.text);
        best = fmin(best, cpu() - from);
        r = *rg_motion_report(m);
        solving = fmin(solving, r.seconds_solving);
        rg_motion_destroy(m);
    }
    struct rusage use;
    getrusage(RUSAGE_SELF, &use);
    printf("%s,%d,%s,%d,%.4g,%d,%s,%.4g,%.3g,%.3g,%.3g,%d,%d,%.2g,%.2g,%.0f\n", kind, (int)n,
           triangulate == RG_TRIANGULATE_ALL ? "all" : "none", (int)r.unknowns, 100 * to, (int)frames, r.method, best,
           best / u.factorization, best / u.pass, frames / solving, (int)r.steps, (int)r.factorizations, r.max_closure_residual, r.max_edge_strain,
           (double)use.ru_maxrss / 1024);
    fflush(stdout);
    rg_pattern_destroy(p);
    *creases = r.unknowns;
    return best;
}

/* Sheets of growing size, and the exponent that fits their times best. */
static void growth(const char *kind, int32_t first, int32_t last, double to, units u)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, creases;
    for (int32_t size = first; size <= last; size *= 2) {
        const double seconds = run(kind, size, RG_TRIANGULATE_NONE, to, 60, size <= 16 ? 9 : size <= 64 ? 3 : 1, u, &creases);
        if (size < 16) continue; /* what does not grow would count */
        n++, x += log(creases), y += log(seconds), xx += log(creases) * log(creases), xy += log(creases) * log(seconds);
    }
    printf("# %s from n = 16 to %d grows as N^%.2f\n", kind, (int)last, (n * xy - x * y) / (n * xx - x * x));
    fflush(stdout);
}

/* small: a minute less; largest: a quarter of an hour more. */
int main(int argc, char **argv)
{
    const char *how = argc < 2 ? "" : argv[1];
    const int large = strcmp(how, "small") != 0, largest = strcmp(how, "largest") == 0;
    double creases;
    units u = parts();
    printf("\npattern,n,triangulation,creases,to_percent,frames,method,seconds,factorizations_worth,passes_worth,"
           "frames_per_second_of_solving,steps,factorizations,closure_rad,strain,peak_mib\n");
    run("miura", 64, RG_TRIANGULATE_ALL, 0.95, 60, 5, u, &creases);
    run("miura", 64, RG_TRIANGULATE_NONE, 170.0 / 180, 60, 5, u, &creases);
    run("waterbomb", 8, RG_TRIANGULATE_NONE, 1, 60, 9, u, &creases);
    run("waterbomb", 8, RG_TRIANGULATE_NONE, 1, 600, 3, u, &creases);
    growth("miura", 8, large ? 256 : 128, 0.9, u);
    growth("waterbomb", 8, largest ? 256 : large ? 128 : 32, 0.9, u);
    if (large) run("miura", 256, RG_TRIANGULATE_ALL, 0.9, 60, 1, u, &creases);
    return 0;
}
