#include "verify/suggest.h"

#include <stdbool.h>
#include <string.h>

enum { LONGEST = 63 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Optimal string alignment distance; both words at most LONGEST long. */
static size_t distance(const char *a, size_t na, const char *b, size_t nb)
{
    size_t row[LONGEST + 1][LONGEST + 1];
    for (size_t i = 0; i <= na; i++) {
        row[i][0] = i;
    }
    for (size_t j = 0; j <= nb; j++) {
        row[0][j] = j;
    }
    for (size_t i = 1; i <= na; i++) {
        for (size_t j = 1; j <= nb; j++) {
            size_t replaced = row[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            row[i][j] = least(replaced, least(row[i - 1][j], row[i][j - 1]) + 1);
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) {
                row[i][j] = least(row[i][j], row[i - 2][j - 2] + 1);
            }
        }
    }
    return row[na][nb];
}

const char *verify_suggest(const char *word, const char *const *names, size_t count)
{
    size_t length = strlen(word);
    const char *best = NULL;
    size_t nearest = length / 3 + 2; /* a third of the letters may be wrong, one at least */
    for (size_t i = 0; i < count && length <= LONGEST; i++) {
        size_t n = strlen(names[i]);
        if (n > LONGEST) {
            continue;
        }
        /* What was typed is often the beginning of what was meant. */
        size_t d = length >= 3 && strncmp(word, names[i], length) == 0 ? 1 : distance(word, length, names[i], n);
        if (d < nearest && d < n) {
            nearest = d;
            best = names[i];
        }
    }
    return best;
}
