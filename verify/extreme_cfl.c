/* The largest stable CFL number, found by runs of a block with velocities without any order, beside what the
 * eigenvalues of the same stencil and the integrator's stability function say. */
#include "verify/extremes.h"

#include "solver/material.h"

#include "solver/scheme.h"
#include "solver/spectrum.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 1500 };
static const double grown = 3.0;      /* times the first speed: a stable body has at most once all its kinetic energy */
static const double slowest = 1e-6;   /* growth per step that eigenvalues tell from none */
static const double seen = 5e-3;      /* growth per step that runs tell from none: 1800 times in all */
static const double agreement = 0.02; /* of the bisection, which ends at 1 % */

struct configuration {
    const struct verify_extremes *in;
    const char *scheme, *stencil, *integrator, *evolved;
    int dim, n;
};

static bool open_at(const struct configuration *which, double cfl, struct verify_trial *trial,
                    struct solver_error *error)
{
    return verify_trial_open(which->in, "free-block", trial, error,
                             "d=%d n=%d material.model=linear-elastic scheme=%s stencil=%s integrator=%s evolved=%s "
                             "cfl=%.17g random=1 threads=1",
                             which->dim, which->n, which->scheme, which->stencil, which->integrator, which->evolved,
                             cfl);
}

static bool runs_at(void *with, double cfl, char *note, size_t size)
{
    const struct configuration *which = with;
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    if (!open_at(which, cfl, &trial, &error)) {
        (void)snprintf(note, size, "%s", error.text);
        return false;
    }
    double before = verify_trial_speed(&trial, NULL);
    bool ran = solver_run_steps(trial.run, STEPS, &error);
    double ratio = verify_trial_speed(&trial, NULL) / before;
    bool holds = ran && ratio <= grown;
    if (!holds && ran) {
        (void)snprintf(note, size, "beyond, the speed grows %.2g times in %d steps", ratio, (int)STEPS);
    } else if (!holds) {
        (void)snprintf(note, size, "beyond, a run of %d steps breaks down", (int)STEPS);
    }
    verify_trial_close(&trial);
    return holds;
}

/* The CFL numbers beyond which a step grows at all, and beyond which runs show it; NaN where there are too many
 * eigenvalues. */
static bool by_eigenvalues(const struct configuration *which, double *stable, double *shown, struct solver_error *error)
{
    struct verify_trial trial;
    double complex *eigenvalue = NULL;
    size_t count;
    *stable = *shown = NAN;
    if (!open_at(which, 0.1, &trial, error)) {
        return false;
    }
    const struct solver_integrator *integrator = solver_integrator_find(which->integrator);
    double c = solver_material_constants(trial.scene->E, trial.scene->nu, trial.scene->rho).cp;
    double per_second = c / solver_run_facts(trial.run).spacing;
    bool ok = solver_run_spectrum(trial.run, &eigenvalue, &count, error);
    if (ok) {
        *stable = per_second * solver_stable_step(integrator, eigenvalue, count, slowest);
        *shown = per_second * solver_stable_step(integrator, eigenvalue, count, seen);
    }
    free(eigenvalue);
    verify_trial_close(&trial);
    return ok || error->code == SOLVER_BAD_INPUT; /* too many: the runs stand alone */
}

static bool measure(struct configuration *which, struct solver_error *error)
{
    double stable, shown;
    struct verify_extreme_row row = {
        .quantity = "largest CFL number", .unit = "-", .least = -INFINITY, .most = INFINITY};
    (void)snprintf(row.what, sizeof row.what, "%s %s %s %s, %dD", which->scheme, which->stencil, which->evolved,
                   which->integrator, which->dim);
    if (!verify_extreme_asked(which->in, row.what)) {
        return true;
    }
    if (!by_eigenvalues(which, &stable, &shown, error)) {
        return false;
    }
    bool known = !isnan(stable);
    verify_extreme_bisect(runs_at, which, known ? fmax(0.5 * stable, 0.2 * shown) : 0.02, known ? 1.5 * shown : 3.0,
                          0.01, &row.value, &row.fails, row.note, sizeof row.note);
    if (known) {
        row.least = (1.0 - agreement) * stable;
        row.most = (1.0 + agreement) * shown;
        size_t used = strlen(row.note);
        (void)snprintf(row.note + used, sizeof row.note - used,
                       "; eigenvalues: grows beyond %.4g, by %.1g a step beyond %.4g", stable, seen, shown);
    }
    verify_extreme_told(which->in, &row);
    return true;
}

/* The cells along an edge: as few as show the boundary and the interior. The closure of sbp4 for short lines takes
 * eight points; that for others, which holds less, takes twelve, whose eigenvalues are too many but on a line. */
static int cells(const char *stencil, int dim)
{
    bool wide = strcmp(stencil, "sbp4") == 0;
    return dim == 1 ? 16 : dim == 2 ? (wide ? 8 : 5) : (wide ? 11 : 3);
}

bool verify_extreme_cfl(const struct verify_extremes *in, struct solver_error *error)
{
    static const char *const evolved[] = {"pF", "pFHJ"};
    static const char *const schemes[] = {"upwind", "jst"};
    for (size_t s = 0; s < sizeof schemes / sizeof *schemes; s++) {
        for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL;
             builder++) {
            for (int dim = 1; dim <= 3; dim++) {
                for (const struct solver_integrator *integrator = solver_integrators(); integrator->name != NULL;
                     integrator++) {
                    for (size_t e = 0; e < (dim == 2 ? 2u : 1u); e++) {
                        struct configuration which = {in,
                                                      schemes[s],
                                                      builder->name,
                                                      integrator->name,
                                                      evolved[e],
                                                      dim,
                                                      cells(builder->name, dim)};
                        if (!measure(&which, error)) {
                            return false;
                        }
                    }
                }
            }
        }
    }
    return true;
}
