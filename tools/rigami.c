/* rigami -- the command line: which commands there are. */
#include "commands.h"
#include "guess.h"
#include "interrupt.h"
#include "say.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#define STATUSES                                                                              \
    "Exit status: 0 every driven crease is within 1 % of its target, and no facets passed\n"  \
    "through each other; 1 stopped short, or only by passing through itself, all\n"          \
    "outputs are written, the report and standard error say where and why; 2 wrong usage,\n" \
    "or an input that cannot be read; 3 an output that cannot be written, or no memory.\n"

static const char fold_notes[] =
    "IN is a crease pattern, - standard input. OUT, by its shape and extension:\n"
    "  dir/  name-%04d.png          one PNG a frame\n"
    "  x.png                        the last frame\n"
    "  x.gif x.apng x.mp4 x.webm    the animation (video by the program ffmpeg)\n"
    "  x.obj x.stl                  the last frame; with %04d one a frame\n"
    "  x.glb x.gltf                 one animated model\n"
    "  x.fold                       FOLD 1.2, the motion in file_frames\n"
    "  x.csv                        fold angles in degrees, a row a frame, a column a crease\n"
    "  x.svg x.dxf                  the crease pattern as folded; dxf: a layer a kind, for cutters\n"
    "  x.html                       a page to turn, fold and unfold it, all in one file\n"
    "Without -o it folds and says how it went. Several IN are states of one sheet: the motion goes from\n"
    "the first, folded, through all of them.\n\n" STATUSES;

static const command commands[] = {
    {"fold", FOR_FOLD, "IN [IN]... [-o OUT]...", 1, 1000, "Folds a crease pattern and writes the motion.", fold_notes,
     cmd_fold},
    {"info", FOR_INFO, "IN", 1, 1, "Says what a crease pattern is, and whether and why it may not fold.",
     "IN is a crease pattern, - standard input. Exit status: 0 when it was read, whatever is\n"
     "said of it; 2 when not.\n",
     cmd_info},
    {"convert", FOR_CONVERT, "IN -o OUT", 1, 1, "Converts a crease pattern from one format to another.",
     "IN is .opx, .cp, .fold, .svg, .dxf or .ori, - standard input; OUT is any of these but .ori. What\n"
     "OUT cannot hold is told. Lines stay where they are to 1e-9 of the sheet, unless --merge asks\n"
     "for joining ends. Exit status: 0 when it was written; 2 when IN cannot be read; 3 when OUT\n"
     "cannot be written.\n",
     cmd_convert},
    {"gen", FOR_GEN, "KIND [N [M]] -o OUT", 1, 3,
     "Writes an example crease pattern of N by M parts, as .opx, .cp, .fold, .svg or .dxf.",
     "What N, M, --angle and --cell are, with their usual values:\n"
     "  miura      N columns, M rows of rhombs (8); their acute angle, 10 to 85 degrees (60); a side of one\n"
     "  waterbomb  N by M units (6); between a diagonal and the rows, 30 to 80 degrees (45); a unit's width\n"
     "  yoshimura  N triangles in each of M rows (6); at their bases, 5 to 60 degrees (30); a base\n"
     "  kresling   N sides (6), M storeys; between base and diagonal, 5 to 90 degrees; a side\n"
     "  hypar      N squares in each other (8); from one to the next\n"
     "  boxpleat   a grid of N by N (16); its step\n"
     "  resch      N by M (3) large triangles; a side of a small one\n"
     "  random     N by N rhombs (8), M the seed\n"
     "Without --size and --cell the sheet's longer side is 400. A unit is said in .fold, .svg and .dxf.\n",
     cmd_gen},
    {"draw", FOR_DRAW, "MOTION.fold -o OUT [-o OUT]...", 1, 1,
     "Draws a motion that was written before, without folding.",
     "MOTION is a FOLD file with a flat crease pattern and frames that have vertices_coords: what rigami fold\n"
     "writes as .fold, or another program; - is standard input. OUT is as for rigami fold. Exit status: 0 when\n"
     "all was written; 2 when MOTION cannot be read; 3 when an output cannot be written.\n",
     cmd_draw},
    {"batch", FOR_FOLD | FOR_BATCH, "IN [IN]... -o DIR/", 1, 1000000,
     "Folds many crease patterns, each by itself, to one table.",
     "Each IN has DIR/NAME.json, its report, and DIR/NAME.log, what was said of it; all together have DIR/table.csv "
     "and\n"
     "DIR/table.txt. A drawing of several sheets is folded sheet by sheet. What DIR has already, of the same files, "
     "options\n"
     "and program, is kept: an interrupted batch goes on when it is called again. On several machines that share DIR:\n"
     "--part 1/8 on the first, ... --part 8/8 on the last, then once --merge with all files. Exit status: 0 when all\n"
     "fold; 1 when some do not, or are not done yet; 2 for wrong usage; 3 when outputs could not be written, of some\n"
     "files, or at all.\n",
     cmd_batch},
    {"chart", FOR_CHART, "IN [-o DIR]", 1, 1, "Charts speed against accuracy of every method, and where each stops.",
     "IN is a crease pattern, - standard input. Says what each method and solver costs and how far off\n"
     "it is; with -o also writes DIR/IN.csv, every run, DIR/IN.svg, the diagram, and DIR/IN.md.\n"
     "Exit status: 0 when it was made, whatever it says; 1 when it was ended before; 2 when IN cannot be\n"
     "read or holds nothing to solve; 3 when an output cannot be written.\n",
     cmd_chart},
    {"verify", FOR_VERIFY, "MOTION.fold [IN]", 1, 2,
     "Says whether a motion that was written is one that paper can make.",
     "MOTION.fold is judged by itself, by code that shares nothing with what folds: one and the same\n"
     "sheet, rigid facets, closed vertices, angles as the places have them, mountains and valleys, a\n"
     "steady path, no facets through each other in frames or on rigid ways between them, possible\n"
     "layers where it ends flat. IN: the pattern that it is to be a motion of. Exit status: 0 it is\n"
     "one; 1 it is not, and what is wrong in which frame with which facets is said, a line each; 2 a\n"
     "file that cannot be read.\n",
     cmd_verify},
};
enum { COMMANDS = sizeof commands / sizeof *commands };

static void help(FILE *out)
{
    fputs("Usage: rigami COMMAND ...\nFolds origami crease patterns as rigid plates.\n\n", out);
    for (int i = 0; i < COMMANDS; i++)
        fprintf(out, "  rigami %s %s\n        %s\n", commands[i].name, commands[i].operands, commands[i].summary);
    fputs("\nrigami help COMMAND lists the command's options; rigami --version prints the version.\n\n" STATUSES, out);
}

/* Descriptors 0, 1, 2 that the caller closed are made such that using them fails; else the first file that is opened
 * would take their place. Standard error may fail unseen. */
static void fill_descriptors(void)
{
    static const int modes[] = {O_WRONLY, O_RDONLY, O_RDWR};
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) < 0 && errno == EBADF) (void)!open("/dev/null", modes[fd]);
}

static void list_kinds(void)
{
    enum { WIDTH = 79 };
    int at = printf("\nKIND is one of:") - 1;
    for (const char *const *kind = rg_generate_kinds(); *kind; kind++) {
        if (at + 1 + (int)strlen(*kind) > WIDTH) at = printf("\n ") - 1;
        at += printf(" %s", *kind);
    }
    fputs("\n", stdout);
}

static void tell_command(const command *c)
{
    options_help(c, stdout);
    if (c->bit == FOR_GEN) list_kinds();
}

/* What the command may take of time and of address space. */
static int limit(const options *o)
{
    struct rlimit r;
    if (o->seconds > 0) interrupt_after(o->seconds);
    if (!(o->megabytes > 0) || getrlimit(RLIMIT_AS, &r) != 0) return ENDS_WELL;
    const double bytes = o->megabytes * 1e6;
    if (r.rlim_max != RLIM_INFINITY && bytes > (double)r.rlim_max) return ENDS_WELL; /* it is no more as it is */
    r.rlim_cur = (rlim_t)bytes;
    if (setrlimit(RLIMIT_AS, &r) == 0) return ENDS_WELL;
    say("--max-memory: %s", strerror(errno));
    return ENDS_USAGE;
}

static int run(const command *c, int argc, char **argv)
{
    options o;
    int status = options_parse(&o, c, argc, argv);
    if (status == ENDS_WELL && o.help) {
        tell_command(c);
    } else if (status == ENDS_WELL && o.version) {
        printf("rigami %s\n", rg_version());
    } else if (status == ENDS_WELL) {
        status = limit(&o);
        interrupt_outputs(&o);
        if (status == ENDS_WELL) status = c->run(&o);
        interrupt_outputs(NULL);
    }
    options_free(&o);
    return status;
}

static const command *find(const char *word)
{
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(word, commands[i].name) == 0) return &commands[i];
    return NULL;
}

static int refuse_command(const char *word)
{
    const command *best = NULL;
    for (int i = 0, least = 99; i < COMMANDS; i++) {
        const int d = guess_distance(word, commands[i].name);
        if (d >= least || !guess_is_near(word, commands[i].name, d)) continue;
        least = d;
        best = &commands[i];
    }
    if (best) say("\"%s\" is no command: did you mean rigami %s?", word, best->name);
    else if (guess_is_near(word, "help", guess_distance(word, "help")))
        say("\"%s\" is no command: did you mean rigami help?", word);
    else if (access(word, R_OK) == 0)
        say("\"%s\" is a file and no command: did you mean rigami fold %s? rigami --help lists what else there is",
            word, word);
    else say("\"%s\" is no command; try rigami --help", word);
    return ENDS_USAGE;
}

/* help [VERB]; help --words [VERB [--OPTION]]: what a shell completes. */
static int help_command(int argc, char **argv)
{
    const int words = argc > 0 && strcmp(argv[0], "--words") == 0;
    argc -= words, argv += words;
    const command *c = argc > 0 ? find(argv[0]) : NULL;
    if (argc > 0 && !c && strcmp(argv[0], "help") != 0) return refuse_command(argv[0]);
    if (words && c)
        return options_words(c->bit, argc > 1 ? argv[1] + strspn(argv[1], "-") : NULL, stdout) ? ENDS_WELL : ENDS_USAGE;
    if (words)
        for (int i = 0; i < COMMANDS; i++) puts(commands[i].name);
    if (words) puts("help");
    else if (c) tell_command(c);
    else help(stdout);
    return ENDS_WELL;
}

static int dispatch(int argc, char **argv)
{
    const char *word = argc > 1 ? argv[1] : "";
    const command *c = find(word);
    if (c) return run(c, argc - 1, argv + 1);
    if (strcmp(word, "help") == 0) return help_command(argc - 2, argv + 2);
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) help(stdout);
    else if (strcmp(word, "--version") == 0) printf("rigami %s\n", rg_version());
    else {
        if (argc < 2) help(stderr);
        else return refuse_command(word);
        return ENDS_USAGE;
    }
    return ENDS_WELL;
}

/* Help and verdicts fit in, so that the one write of them at the end knows why it failed. */
enum { OUTPUT_BUFFER = 1 << 16 };

int main(int argc, char **argv)
{
    static char buffer[OUTPUT_BUFFER];
    setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
    fill_descriptors();
    interrupt_init();
    const int status = dispatch(argc, argv);
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) return status;
    /* A long text failed before its end, and why is forgotten: one byte more fails for the same reason. */
    if (errno == 0 && write(STDOUT_FILENO, "\n", 1) == 1) errno = 0;
    if (status != ENDS_UNWRITTEN) say("standard output: %s", errno ? strerror(errno) : "not written");
    return ENDS_UNWRITTEN;
}
