/* The nearest of some names, for "did you mean". */
#ifndef VERIFY_SUGGEST_H
#define VERIFY_SUGGEST_H

#include <stddef.h>

/* The name closest to `word` by edit distance (insert, delete, replace, swap of neighbours), or NULL if none is close
 * enough to be what was meant. */
const char *verify_suggest(const char *word, const char *const *names, size_t count);

#endif
