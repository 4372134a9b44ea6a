/* What must not matter: units and size (scale), and where a body lies and how it is turned (place). The same block runs
 * twice; displacements over the length and velocities over the sound speed are compared. */
#include "verify/extremes.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double strain = 1e-3; /* of the block's motion: speed over sound speed */

/* How a run came out, without dimension and turned back. */
struct outcome {
    size_t count, dim;
    double *value; /* [count][2 dim]: u / length, v / c */
    double steps;  /* right-hand sides evaluated */
    bool single;   /* in single precision */
};

static void turn_back(double *vector, size_t dim, double angle)
{
    if (dim > 1) {
        double x = vector[0], y = vector[1];
        vector[0] = x * cos(angle) + y * sin(angle);
        vector[1] = y * cos(angle) - x * sin(angle);
    }
}

/* Where a particle is, in the frame of the body at rest: R^T (u + X - origin) - (X - origin). */
static bool outcome_of(struct verify_trial *trial, double angle, struct outcome *outcome, struct solver_error *error)
{
    struct solver_output out;
    double length, modulus, density, origin;
    if (!verify_trial_finish(trial, error) || !solver_run_output(trial->run, &out, error)) {
        return false;
    }
    size_t dim = (size_t)out.cloud->dim;
    outcome->count = out.cloud->count;
    outcome->dim = dim;
    outcome->steps = 4.0 * (double)out.step;
    outcome->single = strcmp(trial->scene->precision, "single") == 0;
    outcome->value = calloc(outcome->count * 2 * dim + 1, sizeof *outcome->value);
    if (outcome->value == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for %zu particles", outcome->count);
    }
    (void)solver_scene_number(trial->scene, "length", &length);
    (void)solver_scene_number(trial->scene, "modulus", &modulus);
    (void)solver_scene_number(trial->scene, "density", &density);
    (void)solver_scene_number(trial->scene, "origin", &origin);
    double c = sqrt(modulus / density);
    for (size_t a = 0; a < outcome->count; a++) {
        double *u = outcome->value + a * 2 * dim;
        double *v = u + dim;
        for (size_t i = 0; i < dim; i++) {
            u[i] = (out.u[a * dim + i] + (out.cloud->X[a * dim + i] - origin)) / length;
            v[i] = out.v[a * dim + i] / c;
        }
        turn_back(u, dim, angle);
        turn_back(v, dim, angle);
        for (size_t i = 0; i < dim; i++) {
            u[i] -= (out.cloud->X[a * dim + i] - origin) / length;
        }
    }
    return true;
}

/* Largest difference of any number, over the strain. */
static double difference(const struct outcome *a, const struct outcome *b)
{
    double most = 0.0;
    if (a->count != b->count) {
        return NAN;
    }
    for (size_t i = 0; i < a->count * 2 * a->dim; i++) {
        double d = fabs(a->value[i] - b->value[i]);
        most = isnan(d) ? INFINITY : fmax(most, d);
    }
    return most / strain;
}

/* A variant of the block, with what it adds to the tolerance: `lengths` away from the origin. */
struct variant {
    const char *what, *settings;
    double angle, lengths;
    bool exact; /* scaled by powers of two: not a bit differs */
};

/* Every right-hand side rounds F, of order one, at least once, in the scene's precision; over the strain, and summed
 * without any cancelling, that is steps eps / strain. A distance from the origin leaves X, which is in double precision
 * in either, with an error of eps times it, n times that in gradients. */
static double tolerance_of(const struct variant *variant, const struct outcome *plain, int n)
{
    double rounded = plain->steps * (plain->single ? (double)FLT_EPSILON : DBL_EPSILON);
    return variant->exact ? 0.0 : (rounded + 4.0 * n * variant->lengths * DBL_EPSILON) / strain;
}

static bool compare(const struct verify_extremes *in, int dim, const char *evolved, const struct variant *variant,
                    size_t count, struct solver_error *error)
{
    struct outcome plain = {0};
    struct verify_trial trial;
    const char *common = "n=4 threads=1 integrator=rk4 speed=1e-3";
    bool ok = verify_trial_open(in, "free-block", &trial, error, "d=%d evolved=%s %s", dim, evolved, common) &&
              outcome_of(&trial, 0.0, &plain, error);
    verify_trial_close(&trial);
    for (size_t i = 0; ok && i < count; i++) {
        struct outcome other = {0};
        struct verify_extreme_row row = {
            .quantity = "largest difference / strain", .fails = NAN, .unit = "-", .least = -INFINITY};
        (void)snprintf(row.what, sizeof row.what, "%s, %s, %dD", variant[i].what, evolved, dim);
        if (!verify_extreme_asked(in, row.what)) {
            continue;
        }
        ok = verify_trial_open(in, "free-block", &trial, error, "d=%d evolved=%s %s %s", dim, evolved, common,
                               variant[i].settings) &&
             outcome_of(&trial, variant[i].angle, &other, error);
        if (ok) {
            row.value = difference(&plain, &other);
            row.most = tolerance_of(&variant[i], &plain, 4);
            (void)snprintf(row.note, sizeof row.note, "at most %.2g: %s", row.most,
                           variant[i].exact ? "powers of two round nothing" : "round-off of every right-hand side");
            verify_extreme_told(in, &row);
        }
        verify_trial_close(&trial);
        free(other.value);
    }
    free(plain.value);
    return ok;
}

static bool in_each_dimension(const struct verify_extremes *in, const struct variant *variant, size_t count,
                              int least_dim, struct solver_error *error)
{
    for (int dim = least_dim; dim <= 3; dim++) {
        if (!compare(in, dim, "pF", variant, count, error) || !compare(in, dim, "pFHJ", variant, count, error)) {
            return false;
        }
    }
    return true;
}

bool verify_extreme_scale(const struct verify_extremes *in, struct solver_error *error)
{
    static const struct variant variants[] = {
        {"2^-30 m", "length=9.31322574615478515625e-10", 0.0, 0.0, true},
        {"2^20 m", "length=1048576", 0.0, 0.0, true},
        {"1e-9 m", "length=1e-9", 0.0, 0.0, false},
        {"1e6 m", "length=1e6", 0.0, 0.0, false},
        {"1 Pa", "modulus=1", 0.0, 0.0, false},
        {"1e12 Pa", "modulus=1e12", 0.0, 0.0, false},
        {"1e-3 kg/m^3", "density=1e-3", 0.0, 0.0, false},
        {"nanoseconds: 1e-6 m, 1e12 Pa", "length=1e-6 modulus=1e12", 0.0, 0.0, false},
        {"years: 1e9 m, 1 Pa", "length=1e9 modulus=1", 0.0, 0.0, false},
    };
    return in_each_dimension(in, variants, sizeof variants / sizeof *variants, 1, error);
}

bool verify_extreme_place(const struct verify_extremes *in, struct solver_error *error)
{
    static const struct variant shifted[] = {
        {"1e3 lengths away", "origin=1e3", 0.0, 1e3, false},
        {"1e6 lengths away", "origin=1e6", 0.0, 1e6, false},
    };
    static const struct variant turned[] = {
        {"turned by 0.3 rad", "angle=0.3", 0.3, 0.0, false},
        {"turned by 2 rad", "angle=2", 2.0, 0.0, false},
        {"turned by 100 rad", "angle=100", 100.0, 0.0, false},
    };
    return in_each_dimension(in, shifted, sizeof shifted / sizeof *shifted, 1, error) &&
           in_each_dimension(in, turned, sizeof turned / sizeof *turned, 2, error);
}
