/* Allocation that says what it wanted the memory for. */
#ifndef SOLVER_MEMORY_H
#define SOLVER_MEMORY_H

#include "solver/error.h"

#include <stddef.h>

/* count * size zeroed bytes, aligned to 64 for vector loads and on large pages where they fill half of one, into *out;
 * free() releases. A count of 0 gives a valid pointer. On failure *out is NULL and the error says how much was asked
 * for and for what. */
bool solver_alloc(void **out, size_t count, size_t size, const char *what, struct solver_error *error);
/* The same, but holding anything: for what is written piece by piece, each by the thread that needs it. */
bool solver_alloc_untouched(void **out, size_t count, size_t size, const char *what, struct solver_error *error);
/* Bytes that such an array takes, rounded up for the alignment; at most SIZE_MAX. */
size_t solver_alloc_bytes(size_t count, size_t size);
/* Bytes of the cache of level 2 or 3; 0 where the system does not tell. */
size_t solver_cache_bytes(int level);
/* Bytes of the machine's memory; SIZE_MAX where the system does not tell. */
size_t solver_memory_bytes(void);

#endif
