#include "solver/grading.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* How far the i-th of `count` spacings is from the smallest to the largest, before the ends are made 0 and 1. */
static double way(enum solver_fine fine, size_t i, size_t count)
{
    double share = (double)i / (double)(count - 1);
    double wave = sin(pi * share);
    switch (fine) {
    case SOLVER_FINE_LOWER:
        break;
    case SOLVER_FINE_UPPER:
        return 1.0 - share;
    case SOLVER_FINE_BOTH:
        return wave * wave;
    case SOLVER_FINE_MIDDLE:
        return 1.0 - wave * wave;
    }
    return share;
}

bool solver_grading_places(const struct solver_grading *grading, int axis, double lower, double upper, size_t points,
                           double *X, struct solver_error *error)
{
    enum solver_fine fine = (enum solver_fine)grading->fine;
    size_t count = points - 1;
    size_t fewest = fine == SOLVER_FINE_LOWER || fine == SOLVER_FINE_UPPER ? 2 : 3;
    if (!(grading->ratio >= 1.0) || !isfinite(grading->ratio)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "grading.%c: expected a number >= 1, the largest spacing over the smallest, got %g",
                           "XYZ"[axis], grading -> ratio);
    }
    if (points < fewest + 1) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "grading.%c: an edge of %zu of the spacings is too short for them to differ; expected %zu or "
            "more: choose a larger n",
            "XYZ"[axis], count, fewest);
    }
    double least = 1.0;
    double most = 0.0;
    for (size_t i = 0; i < count; i++) {
        least = fmin(least, way(fine, i, count));
        most = fmax(most, way(fine, i, count));
    }
    X[0] = 0.0;
    for (size_t i = 0; i < count; i++) {
        X[i + 1] = X[i] + pow(grading->ratio, (way(fine, i, count) - least) / (most - least));
    }
    double all = X[count];
    for (size_t i = 0; i < count; i++) {
        X[i] = lower + (upper - lower) * (X[i] / all);
    }
    X[count] = upper;
    return true;
}
