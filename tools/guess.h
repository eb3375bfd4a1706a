/* guess.h -- which of the words that there are somebody meant.
 * Used by  rigami.c options.c */
#ifndef GUESS_H
#define GUESS_H

/* How many letters have to be put in, taken out, changed or exchanged with the next one, to make b of a; at most 99. */
int guess_distance(const char *a, const char *b);
/* Whether somebody who writes `word` may well mean `other`, at that distance: a slip in three letters, or its
 * beginning. */
int guess_is_near(const char *word, const char *other, int distance);

#endif
