/* The nearest of some names, for "did you mean". */
#ifndef SOLVER_SUGGEST_H
#define SOLVER_SUGGEST_H

#include <stdbool.h>
#include <stddef.h>

/* The name closest to `word` by edit distance (insert, delete, replace, swap of neighbours), or NULL if none is close
 * enough to be what was meant. */
const char *solver_suggest(const char *word, const char *const *names, size_t count);

/* The same, name by name: begin, then try each. */
struct solver_suggestion {
    const char *word;
    size_t nearest; /* distance of the best name so far, or the least that is too far */
};
struct solver_suggestion solver_suggest_begin(const char *word);
/* Whether the name, so many bytes long, is nearer than all before it. */
bool solver_suggest_try(struct solver_suggestion *suggestion, const char *name, size_t length);

#endif
