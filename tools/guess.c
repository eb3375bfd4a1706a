#include "guess.h"

#include <string.h>

enum { LONGEST = 32, FAR = 99 };

/* Damerau's and Levenshtein's, of words that are not too long to be words. */
int guess_distance(const char *a, const char *b)
{
    int d[LONGEST + 1][LONGEST + 1];
    const int m = (int)strlen(a), n = (int)strlen(b);
    if (m > LONGEST || n > LONGEST) return FAR;
    for (int i = 0; i <= m; i++) d[i][0] = i;
    for (int j = 0; j <= n; j++) d[0][j] = j;
    for (int i = 1; i <= m; i++)
        for (int j = 1; j <= n; j++) {
            int least = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            if (d[i - 1][j] + 1 < least) least = d[i - 1][j] + 1;
            if (d[i][j - 1] + 1 < least) least = d[i][j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && d[i - 2][j - 2] + 1 < least)
                least = d[i - 2][j - 2] + 1;
            d[i][j] = least;
        }
    return d[m][n];
}

int guess_is_near(const char *word, const char *other, int distance)
{
    const size_t n = strlen(word);
    if (n == 0) return 0;
    return 3 * distance <= (int)n + 1 || (n > 2 && strncmp(word, other, n) == 0);
}
