#include "solver/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { ALIGNMENT = 64, LARGE_PAGE = 1 << 21 };

/* Loops gather from all over a large array: on small pages they wait for the tables of pages. One that fills less than
 * half a page is not worth the rest of it. */
static bool is_large(size_t bytes)
{
    return bytes >= (size_t)LARGE_PAGE / 2;
}

size_t solver_cache_bytes(int level)
{
    long bytes = 0;
#ifdef _SC_LEVEL3_CACHE_SIZE /* of glibc */
    bytes = sysconf(level == 2 ? _SC_LEVEL2_CACHE_SIZE : _SC_LEVEL3_CACHE_SIZE);
#else
    (void)level;
#endif
    return bytes > 0 ? (size_t)bytes : 0;
}

size_t solver_memory_bytes(void)
{
    long pages = sysconf(_SC_PHYS_PAGES);
    long page = sysconf(_SC_PAGE_SIZE);
    return pages > 0 && page > 0 ? (size_t)pages * (size_t)page : SIZE_MAX;
}

size_t solver_alloc_bytes(size_t count, size_t size)
{
    if (count > (SIZE_MAX - 2 * (size_t)LARGE_PAGE) / size) {
        return SIZE_MAX;
    }
    size_t bytes = (count * size + ALIGNMENT) / ALIGNMENT * ALIGNMENT;
    return is_large(bytes) ? (bytes + LARGE_PAGE - 1) / LARGE_PAGE * LARGE_PAGE : bytes;
}

bool solver_alloc_untouched(void **out, size_t count, size_t size, const char *what, struct solver_error *error)
{
    size_t bytes = solver_alloc_bytes(count, size);
    *out = NULL;
    if (bytes == SIZE_MAX) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: %zu x %zu bytes is more than can be addressed", what, count,
                           size);
    }
    *out = aligned_alloc(is_large(bytes) ? LARGE_PAGE : ALIGNMENT, bytes);
    if (*out == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for %.1f MiB; choose a smaller n", what,
                           (double)bytes / 1048576.0);
    }
    if (is_large(bytes)) {
        (void)madvise(*out, bytes, MADV_HUGEPAGE); /* where it is refused, all works as well */
    }
    return true;
}

bool solver_alloc(void **out, size_t count, size_t size, const char *what, struct solver_error *error)
{
    bool ok = solver_alloc_untouched(out, count, size, what, error);
    if (*out != NULL) {
        memset(*out, 0, solver_alloc_bytes(count, size));
    }
    return ok;
}
