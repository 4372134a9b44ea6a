/* What a run shows: fields without padding, conserved quantities, time history. */
#include "solver/memory.h"
#include "solver/run_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where each array of solver_output lies within the run's output block, in doubles per particle. */
struct layout {
    size_t u, v, p, F, H, J, P, P_normal, pressure, von_mises, width;
};

static struct layout lay_out(size_t dim)
{
    struct layout at = {.u = 0, .v = dim, .p = 2 * dim, .F = 3 * dim};
    at.H = at.F + dim * dim;
    at.P = at.H + dim * dim;
    at.J = at.P + dim * dim;
    at.P_normal = at.J + 1;
    at.pressure = at.P_normal + (dim < 3 ? 1 : 0);
    at.von_mises = at.pressure + 1;
    at.width = at.von_mises + 1;
    return at;
}

/* A padded tensor of particle a, row by row. */
static void rows_of(const struct solver_run *run, const double *field, size_t a, double *rows)
{
    size_t dim = (size_t)run->cloud->dim;
    size_t lanes = run->loops->lanes;
    for (size_t i = 0; i < dim; i++) {
        for (size_t I = 0; I < dim; I++) {
            rows[i * dim + I] = field[(a * dim + I) * lanes + i];
        }
    }
}

/* H and J of particle a: evolved, or those of F. */
static void measures_of(const struct solver_run *run, size_t a, double *H, double *J)
{
    const struct solver_upwind *work = &run->work;
    size_t tensor = (size_t)run->cloud->dim * run->loops->lanes;
    double padded[12] __attribute__((aligned(64)));
    double F[12] __attribute__((aligned(64)));
    double jacobian[1];
    memcpy(F, work->F + a * tensor, tensor * sizeof *F);
    run->loops->measures(work->frozen, 0, 1, F, padded, jacobian);
    *J = work->J != NULL ? work->J[a] : jacobian[0];
    if (work->H != NULL) {
        rows_of(run, work->H, a, H);
    } else {
        rows_of(run, padded, 0, H);
    }
}

/* Mean and von Mises equivalent of the Cauchy stress sigma = P F^T / J; with linear kinematics sigma = P. */
static void cauchy(const struct solver_run *run, const double *F, double J, const double *P, double P_normal,
                   double *mean, double *von_mises)
{
    size_t dim = (size_t)run->cloud->dim;
    double sigma[3][3] = {{0}};
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            for (size_t I = 0; I < dim; I++) {
                sigma[i][j] += run->work.frozen ? P[i * dim + j] / (double)dim : P[i * dim + I] * F[j * dim + I] / J;
            }
        }
    }
    for (size_t i = dim; i < 3; i++) {
        sigma[i][i] = P_normal / (run->work.frozen ? 1.0 : J);
    }
    *mean = (sigma[0][0] + sigma[1][1] + sigma[2][2]) / 3.0;
    double square = 0.0;
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            double deviator = 0.5 * (sigma[i][j] + sigma[j][i]) - (i == j ? *mean : 0.0);
            square += deviator * deviator;
        }
    }
    *von_mises = sqrt(1.5 * square);
}

bool solver_run_output(struct solver_run *run, struct solver_output *output, struct solver_error *error)
{
    size_t dim = (size_t)run->cloud->dim;
    size_t count = run->cloud->count;
    size_t lanes = run->loops->lanes;
    const struct solver_upwind *work = &run->work;
    struct layout at = lay_out(dim);
    if (run->output == NULL &&
        !solver_alloc((void **)&run->output, count * at.width, sizeof(double), "output fields", error)) {
        return false;
    }
    double *out = run->output;
    for (size_t a = 0; a < count; a++) {
        double *F = out + count * at.F + a * dim * dim;
        double *P = out + count * at.P + a * dim * dim;
        for (size_t i = 0; i < dim; i++) {
            double velocity = work->v[a * lanes + i];
            out[count * at.u + a * dim + i] = work->x[a * lanes + i] - run->cloud->X[a * dim + i];
            out[count * at.v + a * dim + i] = velocity;
            out[count * at.p + a * dim + i] = work->constants[a * work->stride].rho * velocity;
        }
        rows_of(run, work->F, a, F);
        rows_of(run, work->P, a, P);
        measures_of(run, a, out + count * at.H + a * dim * dim, out + count * at.J + a);
        double J = out[count * at.J + a];
        double P_normal = 0.0;
        if (dim < 3) {
            P_normal = work->material->stress_normal(work->constants + a * work->stride, F, J);
            out[count * at.P_normal + a] = P_normal;
        }
        cauchy(run, F, J, P, P_normal, out + count * at.pressure + a, out + count * at.von_mises + a);
    }
    *output = (struct solver_output){.cloud = run->cloud,
                                     .time = run->time,
                                     .step = run->step,
                                     .V = run->stencil->V,
                                     .u = out + count * at.u,
                                     .v = out + count * at.v,
                                     .p = out + count * at.p,
                                     .F = out + count * at.F,
                                     .H = out + count * at.H,
                                     .J = out + count * at.J,
                                     .P = out + count * at.P,
                                     .P_normal = dim < 3 ? out + count * at.P_normal : NULL,
                                     .pressure = out + count * at.pressure,
                                     .von_mises = out + count * at.von_mises};
    return true;
}

static void add_particle(const struct solver_run *run, size_t a, struct solver_totals *totals)
{
    const struct solver_upwind *work = &run->work;
    size_t dim = (size_t)run->cloud->dim;
    size_t lanes = run->loops->lanes;
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    double V = run->stencil->V[a];
    double p[3] = {0};
    double x[3] = {0};
    double F[9];
    double H[9];
    double J;
    for (size_t i = 0; i < dim; i++) {
        p[i] = of_a->rho * work->v[a * lanes + i];
    }
    memcpy(x, work->x + a * lanes, dim * sizeof *x);
    rows_of(run, work->F, a, F);
    measures_of(run, a, H, &J);
    for (size_t i = 0; i < 3; i++) {
        size_t j = (i + 1) % 3;
        size_t k = (i + 2) % 3;
        totals->linear[i] += V * p[i];
        totals->angular[i] += V * (x[j] * p[k] - x[k] * p[j]);
        totals->kinetic += 0.5 * V * p[i] * p[i] / of_a->rho;
    }
    totals->strain += V * work->material->energy(of_a, F, H, J);
}

static bool make_room(struct solver_run *run, struct solver_error *error)
{
    struct solver_history *history = &run->history;
    if (history->count < run->history_room) {
        return true;
    }
    size_t room = run->history_room == 0 ? 256 : 2 * run->history_room;
    size_t probes = history->probe_count * 3;
    void *totals = realloc(history->totals, room * sizeof *history->totals);
    history->totals = totals != NULL ? totals : history->totals;
    void *u = realloc(history->probe_u, (room * probes + 1) * sizeof(double));
    history->probe_u = u != NULL ? u : history->probe_u;
    void *v = realloc(history->probe_v, (room * probes + 1) * sizeof(double));
    history->probe_v = v != NULL ? v : history->probe_v;
    if (totals == NULL || u == NULL || v == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "time history: no memory for %zu rows", room);
    }
    run->history_room = room;
    return true;
}

static bool start_history(struct solver_run *run, struct solver_error *error)
{
    struct solver_history *history = &run->history;
    size_t dim = (size_t)run->cloud->dim;
    history->probe_count = run->scene->probe_count;
    if (!solver_alloc((void **)&history->probe_name, history->probe_count, sizeof *history->probe_name, "probes",
                      error) ||
        !solver_alloc((void **)&history->probe_X, history->probe_count, sizeof *history->probe_X, "probes", error)) {
        return false;
    }
    for (size_t i = 0; i < history->probe_count; i++) {
        memcpy(history->probe_name[i], run->scene->probe[i].name, sizeof history->probe_name[i]);
        memcpy(history->probe_X[i], run->cloud->X + run->probe[i] * dim, dim * sizeof(double));
    }
    return true;
}

bool solver_run_note(struct solver_run *run, struct solver_error *error)
{
    struct solver_history *history = &run->history;
    if ((history->probe_name == NULL && !start_history(run, error)) || !make_room(run, error)) {
        return false;
    }
    size_t dim = (size_t)run->cloud->dim;
    size_t lanes = run->loops->lanes;
    struct solver_totals totals = {.time = run->time, .external = run->external};
    for (size_t a = 0; a < run->cloud->count; a++) { /* one order of summation, whatever the threads */
        add_particle(run, a, &totals);
    }
    for (size_t i = 0; i < history->probe_count; i++) {
        size_t a = run->probe[i];
        double *u = history->probe_u + (history->count * history->probe_count + i) * 3;
        double *v = history->probe_v + (history->count * history->probe_count + i) * 3;
        for (size_t axis = 0; axis < 3; axis++) {
            u[axis] = axis < dim ? run->work.x[a * lanes + axis] - run->cloud->X[a * dim + axis] : 0.0;
            v[axis] = axis < dim ? run->work.v[a * lanes + axis] : 0.0;
        }
    }
    history->totals[history->count++] = totals;
    return true;
}

const struct solver_history *solver_run_history(const struct solver_run *run)
{
    return &run->history;
}

void solver_run_output_free(struct solver_run *run)
{
    free(run->output);
    free(run->history.totals);
    free(run->history.probe_name);
    free(run->history.probe_X);
    free(run->history.probe_u);
    free(run->history.probe_v);
}
