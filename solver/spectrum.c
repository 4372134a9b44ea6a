#include "solver/spectrum.h"

#include "solver/memory.h"
#include "solver/run_internal.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Entries of the evolved block that are numbers rather than padding. *index is the caller's to free. */
static bool unknowns(const struct solver_state *state, size_t dim, size_t **index, size_t *count,
                     struct solver_error *error)
{
    *count = 0;
    if (!solver_alloc((void **)index, state->evolved, sizeof **index, "unknowns", error)) {
        return false;
    }
    for (size_t f = 0; f < state->field_count && state->field[f].evolved; f++) {
        bool padded = state->field[f].width % state->lanes == 0 && state->field[f].width > 1;
        for (size_t i = 0; i < state->field[f].width * state->count; i++) {
            if (!padded || i % state->lanes < dim) {
                (*index)[(*count)++] = state->field[f].offset + i;
            }
        }
    }
    if (*count > SOLVER_SPECTRUM_LARGEST) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "a spectrum of %zu unknowns: at most %d are taken, their number decides the work by its cube", *count,
            (int)SOLVER_SPECTRUM_LARGEST);
    }
    return true;
}

static bool rates(struct solver_run *run, struct solver_error *error)
{
    struct solver_geometry geometry = run->scheme->geometry(run->system);
    struct solver_state *state = &run->state;
    double power;
    solver_run_refresh(run);
    return solver_scheme_evaluate(run->scheme, run->system, run->cloud->count, run->time, 0.0, error) &&
           solver_faces_load(&run->faces, &run->body, &geometry, run->time, solver_state_v(state),
                             solver_state_v_rate(state), &power, error);
}

/* matrix[i][j] = d rate_i / d U_j by central differences, which have no error but round-off where rates are linear. A
 * velocity is changed by the sound speed's share that a change of F by one has. */
static bool jacobian(struct solver_run *run, const size_t *index, size_t count, double *matrix,
                     struct solver_error *error)
{
    struct solver_state *state = &run->state;
    double *forward = NULL;
    bool ok = solver_alloc((void **)&forward, count, sizeof *forward, "rates", error);
    for (size_t j = 0; ok && j < count; j++) {
        double *entry = &state->U[index[j]];
        double before = *entry;
        double change = index[j] < state->field[1].offset ? run->constants[0].cp : 1.0;
        *entry = before + change;
        ok = rates(run, error);
        for (size_t i = 0; i < count; i++) {
            forward[i] = solver_state_rate(state, index[i]);
        }
        *entry = before - change;
        ok = ok && rates(run, error);
        for (size_t i = 0; i < count; i++) {
            matrix[i * count + j] = (forward[i] - solver_state_rate(state, index[i])) / (2.0 * change);
        }
        *entry = before;
    }
    free(forward);
    solver_run_refresh(run);
    return ok;
}

/* Leaves out the unknowns whose columns are zero; returns how many stay. */
static size_t condense(double *matrix, size_t count)
{
    size_t kept = 0;
    size_t *keep = malloc((count + 1) * sizeof *keep);
    if (keep == NULL) {
        return count; /* only slower */
    }
    for (size_t j = 0; j < count; j++) {
        bool acts = false;
        for (size_t i = 0; i < count && !acts; i++) {
            acts = matrix[i * count + j] != 0.0;
        }
        if (acts) {
            keep[kept++] = j;
        }
    }
    for (size_t i = 0; i < kept; i++) {
        for (size_t j = 0; j < kept; j++) {
            matrix[i * kept + j] = matrix[keep[i] * count + keep[j]];
        }
    }
    free(keep);
    return kept;
}

static bool eigenvalues(double *matrix, size_t count, double complex *eigenvalue, struct solver_error *error)
{
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(count);
    gsl_vector_complex *values = gsl_vector_complex_alloc(count);
    bool ok = work != NULL && values != NULL;
    if (!ok) {
        (void)solver_fail(error, SOLVER_NO_MEMORY, "no memory for the eigenvalues of %zu unknowns", count);
    } else {
        gsl_matrix_view view = gsl_matrix_view_array(matrix, count, count);
        gsl_eigen_nonsymm_params(0, 1, work); /* balanced */
        ok = gsl_eigen_nonsymm(&view.matrix, values, work) == 0;
        if (!ok) {
            (void)solver_fail(error, SOLVER_BROKE_DOWN, "the eigenvalues of %zu unknowns do not converge", count);
        }
        for (size_t i = 0; ok && i < count; i++) {
            gsl_complex value = gsl_vector_complex_get(values, i);
            eigenvalue[i] = GSL_REAL(value) + GSL_IMAG(value) * _Complex_I;
        }
    }
    gsl_vector_complex_free(values);
    gsl_eigen_nonsymm_free(work);
    return ok;
}

bool solver_run_spectrum(struct solver_run *run, double complex **eigenvalue, size_t *count, struct solver_error *error)
{
    size_t *index = NULL;
    double *matrix = NULL;
    size_t all;
    *eigenvalue = NULL;
    if (run->faces.moved || run->faces.load_count > 0 || run->wall.count > 0 || run->projection.on) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "a spectrum is that of a free body: no loads, moved faces, walls or projection");
    }
    if (run->state.in_single) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "a spectrum is that of small changes, which single precision rounds away: expected "
                           "precision = \"double\" or \"mixed\"");
    }
    bool ok = unknowns(&run->state, (size_t)run->cloud->dim, &index, &all, error) &&
              solver_alloc((void **)&matrix, all * all, sizeof *matrix, "matrix of rates", error) &&
              jacobian(run, index, all, matrix, error);
    if (ok) {
        *count = condense(matrix, all);
        ok = solver_alloc((void **)eigenvalue, *count, sizeof **eigenvalue, "eigenvalues", error) &&
             eigenvalues(matrix, *count, *eigenvalue, error);
    }
    free(index);
    free(matrix);
    if (!ok) {
        free(*eigenvalue);
        *eigenvalue = NULL;
    }
    return ok;
}

double complex solver_stability_function(const struct solver_integrator *integrator, double complex z)
{
    double complex U = 1.0, sum = 0.0;
    for (int s = 0; s < integrator->stages; s++) {
        const struct solver_stage *stage = &integrator->stage[s];
        double complex rate = z * U;
        U = 1.0 + stage->keep * (U - 1.0) + stage->rate * rate + stage->sum * sum;
        sum += stage->accumulate * rate;
    }
    return U;
}

static bool stable(const struct solver_integrator *integrator, const double complex *eigenvalue, size_t count,
                   double dt, double growth)
{
    for (size_t i = 0; i < count; i++) {
        if (cabs(solver_stability_function(integrator, eigenvalue[i] * dt)) > 1.0 + growth) {
            return false;
        }
    }
    return true;
}

double solver_stable_step(const struct solver_integrator *integrator, const double complex *eigenvalue, size_t count,
                          double growth)
{
    double fastest = 0.0;
    for (size_t i = 0; i < count; i++) {
        fastest = fmax(fastest, cabs(eigenvalue[i]));
    }
    if (fastest == 0.0) {
        return INFINITY;
    }
    double holds = 0.0, fails = 0.0;
    while (fails * fastest < 100.0 && (fails == 0.0 || holds > 0.0)) { /* scan: stable regions need not be convex */
        double next = holds + 0.01 / fastest;
        fails = next;
        if (!stable(integrator, eigenvalue, count, next, growth)) {
            break;
        }
        holds = next;
    }
    while (fails - holds > 1e-6 * fails && fails > 1e-9 / fastest) {
        double middle = 0.5 * (holds + fails);
        if (stable(integrator, eigenvalue, count, middle, growth)) {
            holds = middle;
        } else {
            fails = middle;
        }
    }
    return holds;
}
