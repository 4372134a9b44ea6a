/* The smallest clouds and the thinnest bodies: a right answer or a clear refusal, never a NaN. The right answer is
 * known of a motion without strain: a body that flies keeps its velocity. */
#include "verify/extremes.h"

#include "solver/scheme.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STEPS = 20 };
static const double speed = 0.5; /* over c; of the flight */

enum fate { FLIES, REFUSED, BREAKS };

/* What becomes of a cloud; a refusal's or a failure's text goes to note. */
static enum fate fate_of(const struct verify_extremes *in, const char *settings, double *difference, char *note,
                         size_t size)
{
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_output out;
    *difference = NAN;
    bool made = verify_trial_open(in, "free-block", &trial, &error, "%s speed=0 flight=%g threads=1", settings, speed);
    bool ran = made && solver_run_steps(trial.run, STEPS, &error) && solver_run_output(trial.run, &out, &error);
    if (ran) {
        double c = sqrt(trial.scene->E / trial.scene->rho);
        *difference = 0.0;
        for (size_t i = 0; i < out.cloud->count * (size_t)out.cloud->dim; i++) {
            double d = fabs(out.v[i] / c - speed);
            *difference = isnan(d) ? INFINITY : fmax(*difference, d);
        }
    } else {
        const char *text = strstr(error.text, ".lua: ");
        (void)snprintf(note, size, "%.190s", text != NULL ? text + 6 : error.text);
    }
    verify_trial_close(&trial);
    return ran ? FLIES : error.code == SOLVER_BAD_INPUT ? REFUSED : BREAKS;
}

/* The fewest cells along the edges at which the body flies, with the refusal of one fewer. */
static void fewest(const struct verify_extremes *in, const char *what, const char *settings, const char *key)
{
    struct verify_extreme_row row = {.value = NAN, .fails = NAN, .unit = "cells", .least = 1.0, .most = 20.0};
    (void)snprintf(row.quantity, sizeof row.quantity, "fewest cells %s", key);
    (void)snprintf(row.what, sizeof row.what, "%s", what);
    if (!verify_extreme_asked(in, what)) {
        return;
    }
    double worst = 0.0;
    for (int cells = 1; cells <= 12; cells++) {
        char all[512];
        double difference;
        bool thin = strcmp(key, "across") == 0;
        (void)snprintf(all, sizeof all, "%s n=%d levels={%d} thickness=%.17g", settings, thin ? 12 : cells,
                       thin ? 12 : cells, thin ? cells / 12.0 : 1.0);
        enum fate fate = fate_of(in, all, &difference, row.note, sizeof row.note);
        if (fate == FLIES) {
            worst = fmax(worst, difference);
            row.value = isnan(row.value) ? cells : row.value;
        } else if (fate == BREAKS || !isnan(row.value)) { /* never a breakdown, nor a hole in what works */
            row.value = NAN;
            verify_extreme_told(in, &row);
            return;
        } else {
            row.fails = cells;
        }
    }
    if (!(worst <= 1e-12)) {
        (void)snprintf(row.note, sizeof row.note, "the velocity of flight changes by %.2g c", worst);
        row.value = NAN;
    } else if (isnan(row.fails)) {
        (void)snprintf(row.note, sizeof row.note, "velocity of flight kept to %.1g c", worst);
    }
    verify_extreme_told(in, &row);
}

bool verify_extreme_small(const struct verify_extremes *in, struct solver_error *error)
{
    (void)error;
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        for (int dim = 1; dim <= 3; dim++) {
            char what[80], settings[160];
            (void)snprintf(what, sizeof what, "upwind %s, %dD", builder->name, dim);
            (void)snprintf(settings, sizeof settings, "d=%d evolved=pFHJ stencil=%s", dim, builder->name);
            fewest(in, what, settings, "along an edge");
            if (dim > 1) {
                fewest(in, what, settings, "across");
            }
        }
    }
    for (int dim = 1; dim <= 3; dim++) {
        char what[80], settings[160];
        (void)snprintf(what, sizeof what, "ulsph, %dD", dim);
        (void)snprintf(settings, sizeof settings, "d=%d scheme=ulsph integrator=tvd-rk2 material.model=linear-elastic",
                       dim);
        fewest(in, what, settings, "along an edge");
        if (dim > 1) {
            fewest(in, what, settings, "across");
        }
    }
    return true;
}
