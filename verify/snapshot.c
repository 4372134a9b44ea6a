#include "verify/snapshot.h"

#include <stdlib.h>

static int by_place(const void *a, const void *b)
{
    double x = ((const struct verify_point *)a)->X, y = ((const struct verify_point *)b)->X;
    return (x > y) - (x < y);
}

static bool keep_profile(const struct solver_output *output, const struct oracle_kind *kind,
                         const struct oracle *oracle, struct verify_snapshot *snapshot, struct solver_error *error)
{
    snapshot->point = calloc(output->cloud->count, sizeof *snapshot->point);
    if (snapshot->point == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the profile of %zu particles", output->cloud->count);
    }
    snapshot->count = output->cloud->count;
    for (size_t a = 0; a < snapshot->count; a++) {
        const double X[3] = {output->cloud->X[a], 0, 0};
        struct oracle_state state;
        double sigma[9];
        kind->state(oracle, X, output->time, &state);
        oracle_cauchy(kind, &state, sigma);
        snapshot->point[a] = (struct verify_point){.X = X[0], .computed = output->sigma[a], .exact = sigma[0]};
    }
    qsort(snapshot->point, snapshot->count, sizeof *snapshot->point, by_place);
    return true;
}

bool verify_snapshot_take(struct solver_run *run, const struct oracle_kind *kind, const struct oracle *oracle,
                          struct verify_snapshot *snapshot, struct solver_error *error)
{
    struct solver_output output;
    if (!solver_run_output(run, &output, error)) {
        return false;
    }
    *snapshot = (struct verify_snapshot){.time = output.time};
    return verify_norms_state(&output, kind, oracle, snapshot->error, error) &&
           (output.cloud->dim != 1 || keep_profile(&output, kind, oracle, snapshot, error));
}

void verify_snapshot_free(struct verify_snapshot *snapshot)
{
    free(snapshot->point);
    *snapshot = (struct verify_snapshot){.count = 0};
}
