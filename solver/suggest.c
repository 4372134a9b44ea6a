#include "solver/suggest.h"

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

struct solver_suggestion solver_suggest_begin(const char *word)
{
    /* a third of the letters may be wrong, one at least */
    return (struct solver_suggestion){.word = word, .nearest = strlen(word) / 3 + 2};
}

bool solver_suggest_try(struct solver_suggestion *suggestion, const char *name, size_t length)
{
    const char *word = suggestion->word;
    size_t typed = strlen(word);
    if (typed > LONGEST || length > LONGEST) {
        return false;
    }
    /* What was typed is often the beginning of what was meant. */
    bool begins = typed >= 3 && typed <= length && memcmp(word, name, typed) == 0;
    size_t d = begins ? 1 : distance(word, typed, name, length);
    bool shared = d < (typed > length ? typed : length); /* a letter of it at least */
    bool nearer = d < suggestion->nearest && shared;
    suggestion->nearest = nearer ? d : suggestion->nearest;
    return nearer;
}

const char *solver_suggest(const char *word, const char *const *names, size_t count)
{
    struct solver_suggestion suggestion = solver_suggest_begin(word);
    const char *best = NULL;
    for (size_t i = 0; i < count; i++) {
        best = solver_suggest_try(&suggestion, names[i], strlen(names[i])) ? names[i] : best;
    }
    return best;
}
