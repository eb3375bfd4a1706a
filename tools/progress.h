/* progress.h -- one line on standard error that says how far it is; gone when it is done.
 * Uses  interrupt.h say.h        Used by  cmd_fold.c */
#ifndef PROGRESS_H
#define PROGRESS_H

typedef struct progress {
    int shown;           /* non-zero: draw it */
    double began, drawn; /* seconds; when this run began, when it was last drawn */
    double reached;      /* 0 ... 1, the farthest of all tries: a bar that runs backwards tells nobody anything */
    int on_screen;
} progress;

/* wanted: 1 yes, 0 no, -1 if standard error is a terminal that can erase a line. */
void progress_init(progress *p, int wanted);
/* An rg_progress; ctx is a progress. Non-zero when the user wants it to stop. */
int progress_show(void *ctx, double part);
/* What is going on instead of folding. */
void progress_say(progress *p, const char *doing, const char *what);
void progress_erase(progress *p);

#endif
