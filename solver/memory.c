#include "solver/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

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
    *out = aligned_alloc(ALIGNMENT, bytes);
    if (*out == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for %.1f MiB; choose a smaller n", what,
                           (double)bytes / 1048576.0);
    }
    memset(*out, 0, bytes);
    return true;
}
