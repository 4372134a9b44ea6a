#include "verify/report.h"

#include <stdlib.h>

bool verify_report_write(const char *path, verify_writer *write, const void *context, struct solver_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (memory == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for the report", path);
    }
    bool done = write(memory, context, error);
    bool whole = ferror(memory) == 0;
    whole = fclose(memory) == 0 && whole;
    if (done && !whole) {
        done = solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for the report", path);
    }
    done = done && verify_file_write(path, text, size, error);
    free(text);
    return done;
}
