#include "solver/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { ALIGNMENT = 64, LARGE_PAGE = 1 << 21 };

size_t solver_alloc_bytes(size_t count, size_t size)
{
    return count > (SIZE_MAX - ALIGNMENT) / size ? SIZE_MAX : (count * size + ALIGNMENT) / ALIGNMENT * ALIGNMENT;
}

bool solver_alloc(void **out, size_t count, size_t size, const char *what, struct solver_error *error)
{
    size_t bytes = solver_alloc_bytes(count, size);
    *out = NULL;
    if (bytes == SIZE_MAX) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: %zu x %zu bytes is more than can be addressed", what, count,
                           size);
    }
    /* Loops gather from all over a large array: on small pages they wait for the tables of pages. */
    bool large = bytes >= 4 * (size_t)LARGE_PAGE;
    *out = aligned_alloc(large ? LARGE_PAGE : ALIGNMENT, bytes);
    if (*out == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for %.1f MiB; choose a smaller n", what,
                           (double)bytes / 1048576.0);
    }
    if (large) {
        (void)madvise(*out, bytes, MADV_HUGEPAGE); /* where it is refused, all works as well */
    }
    memset(*out, 0, bytes);
    return true;
}
