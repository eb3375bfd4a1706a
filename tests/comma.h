/* comma.h -- a locale with a decimal comma: one of the machine's, else one made for the test where it can be. */
#ifndef COMMA_H
#define COMMA_H

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline int has_comma(void) { return strcmp(localeconv()->decimal_point, ".") != 0; }

/* Its name, which is in force then, and in a child's environment as LC_ALL would be; NULL: there is none. What is made is put into
 * `folder`, the caller's. */
static inline const char *comma_set(const char *folder)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE", "fr_FR"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (setlocale(LC_ALL, names[i]) && has_comma()) return names[i];
    char command[300];
    snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 >/dev/null 2>&1", folder);
    if (system(command) != 0) return NULL;
    setenv("LOCPATH", folder, 1);
    return setlocale(LC_ALL, names[0]) && has_comma() ? names[0] : NULL;
}

#endif
