/* Writes made-up bodies of 1, 2 and 3 dimensions as records into a folder, for vtk_reader.py to read. */
#include "tests/unit/body.h"

int main(int count, char **argument)
{
    if (count != 2) {
        (void)fprintf(stderr, "usage: record_sample FOLDER\n");
        return 2;
    }
    for (int dim = 1; dim <= 3; dim++) {
        char path[4096];
        struct solver_error error;
        struct body *body = body_make(dim);
        (void)snprintf(path, sizeof path, "%s/made-up-%dd.vtkhdf", argument[1], dim);
        if (!solver_record_write(path, &body->scene, &body->output, &body->history, "record_sample", "0", &error)) {
            (void)fprintf(stderr, "record_sample: %s\n", error.text);
            free(body);
            return 1;
        }
        free(body);
    }
    return 0;
}
