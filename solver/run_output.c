/* What a run shows: fields without padding, conserved quantities, time history. */
#include "solver/keep.h"
#include "solver/memory.h"
#include "solver/run_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The arrays of solver_output within the run's output block; NULL: there is none. */
struct arrays {
    double *u, *v, *p, *F, *H, *J, *P, *P_normal, *sigma, *sigma_normal, *pressure, *von_mises, *plastic_strain;
};

/* Returns the doubles that the block takes. */
static size_t lay_out(const struct solver_run *run, struct arrays *at)
{
    size_t dim = (size_t)run->cloud->dim;
    size_t normal = dim < 3 ? 1 : 0;
    bool deformation = run->scheme->deformation;
    const struct {
        double **array;
        size_t width;
    } rows[] = {
        {&at->u, dim},
        {&at->v, dim},
        {&at->p, dim},
        {&at->F, deformation ? dim * dim : 0},
        {&at->H, deformation ? dim * dim : 0},
        {&at->P, deformation ? dim * dim : 0},
        {&at->P_normal, deformation ? normal : 0},
        {&at->sigma, dim * dim},
        {&at->sigma_normal, normal},
        {&at->J, 1},
        {&at->pressure, 1},
        {&at->von_mises, 1},
        {&at->plastic_strain, solver_scene_flows(run->scene) ? 1 : 0},
    };
    size_t size = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        *rows[i].array = run->output != NULL && rows[i].width > 0 ? run->output + size : NULL;
        size += run->shown.count * rows[i].width;
    }
    return size;
}

/* Mean and von Mises equivalent of a Cauchy stress [3][3]. */
static void invariants(const double *sigma, double *mean, double *von_mises)
{
    double square = 0.0;
    *mean = (sigma[0] + sigma[4] + sigma[8]) / 3.0;
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            double deviator = 0.5 * (sigma[3 * i + j] + sigma[3 * j + i]) - (i == j ? *mean : 0.0);
            square += deviator * deviator;
        }
    }
    *von_mises = sqrt(1.5 * square);
}

static void write_motion(const struct solver_run *run, const struct arrays *at, size_t a)
{
    const struct solver_state *state = &run->state;
    struct solver_vectors v = solver_state_v(state);
    size_t dim = (size_t)run->cloud->dim;
    for (size_t i = 0; i < dim; i++) {
        double velocity = solver_vectors_get(&v, a, i);
        at->u[a * dim + i] = solver_state_u(state, a, i, run->cloud->X[a * dim + i]);
        at->v[a * dim + i] = velocity;
        at->p[a * dim + i] = solver_run_density(run, a) * velocity;
    }
}

static void write_point(const struct solver_run *run, const struct arrays *at, size_t a)
{
    size_t dim = (size_t)run->cloud->dim;
    struct solver_point point;
    run->scheme->look(run->system, a, &point);
    at->J[a] = point.J;
    invariants(point.sigma, &at->pressure[a], &at->von_mises[a]);
    for (size_t i = 0; i < dim; i++) {
        memcpy(at->sigma + (a * dim + i) * dim, point.sigma + 3 * i, dim * sizeof(double));
    }
    if (at->sigma_normal != NULL) {
        at->sigma_normal[a] = point.sigma[8];
    }
    if (at->F != NULL) {
        memcpy(at->F + a * dim * dim, point.F, dim * dim * sizeof(double));
        memcpy(at->H + a * dim * dim, point.H, dim * dim * sizeof(double));
        memcpy(at->P + a * dim * dim, point.P, dim * dim * sizeof(double));
    }
    if (at->P_normal != NULL) {
        at->P_normal[a] = point.P_normal;
    }
    if (at->plastic_strain != NULL) {
        at->plastic_strain[a] = point.plastic_strain;
    }
}

bool solver_run_output(struct solver_run *run, struct solver_output *output, struct solver_error *error)
{
    struct arrays at;
    size_t size = lay_out(run, &at);
    if (run->output == NULL) {
        if (!solver_alloc((void **)&run->output, size, sizeof(double), "output fields", error)) {
            return false;
        }
        (void)lay_out(run, &at);
    }
    for (size_t a = 0; a < run->shown.count; a++) {
        write_motion(run, &at, a);
        write_point(run, &at, a);
    }
    *output = (struct solver_output){.cloud = &run->shown,
                                     .time = run->time,
                                     .step = run->step,
                                     .V = run->scheme->geometry(run->system).V,
                                     .u = at.u,
                                     .v = at.v,
                                     .p = at.p,
                                     .F = at.F,
                                     .H = at.H,
                                     .J = at.J,
                                     .P = at.P,
                                     .P_normal = at.P_normal,
                                     .sigma = at.sigma,
                                     .sigma_normal = at.sigma_normal,
                                     .pressure = at.pressure,
                                     .von_mises = at.von_mises,
                                     .plastic_strain = at.plastic_strain};
    return true;
}

/* What the solution of the pressure has taken, and what it leaves. */
static void note_volumes(const struct solver_run *run, struct solver_totals *totals)
{
    totals->iterations = run->scheme->iterations(run->system);
    for (size_t a = 0; a < run->shown.count; a++) {
        struct solver_point point;
        run->scheme->look(run->system, a, &point);
        totals->volume_change = fmax(totals->volume_change, fabs(point.J - 1.0));
    }
}

static void add_particle(const struct solver_run *run, size_t a, double V, struct solver_totals *totals)
{
    const struct solver_state *state = &run->state;
    struct solver_vectors v = solver_state_v(state);
    size_t dim = (size_t)run->cloud->dim;
    double rho = solver_run_density(run, a);
    double p[3] = {0};
    double x[3] = {0};
    for (size_t i = 0; i < dim; i++) {
        p[i] = rho * solver_vectors_get(&v, a, i);
        x[i] = solver_state_x(state, a, i, run->cloud->X[a * dim + i]);
    }
    for (size_t i = 0; i < 3; i++) {
        size_t j = (i + 1) % 3;
        size_t k = (i + 2) % 3;
        totals->linear[i] += V * p[i];
        totals->angular[i] += V * (x[j] * p[k] - x[k] * p[j]);
        totals->kinetic += 0.5 * V * p[i] * p[i] / rho;
    }
    totals->strain += V * run->scheme->energy(run->system, a);
    if (solver_scene_flows(run->scene)) {
        totals->plastic += V * run->scheme->dissipated(run->system, a);
    }
}

/* Velocities of the bodies' centres of mass. */
static void note_bodies(const struct solver_run *run, const double *V, struct solver_history *history)
{
    size_t dim = (size_t)run->cloud->dim;
    struct solver_vectors v = solver_state_v(&run->state);
    double mass[SOLVER_BODIES] = {0};
    double momentum[SOLVER_BODIES][3] = {{0}};
    for (size_t a = 0; a < run->shown.count; a++) {
        size_t body = run->cloud->body != NULL ? run->cloud->body[a] : 0;
        double m = V[a] * solver_run_density(run, a);
        mass[body] += m;
        for (size_t i = 0; i < dim; i++) {
            momentum[body][i] += m * solver_vectors_get(&v, a, i);
        }
    }
    for (size_t body = 0; body < history->body_count; body++) {
        for (size_t i = 0; i < 3; i++) {
            history->body_velocity[body][i] = momentum[body][i] / mass[body];
        }
    }
    history->contact_begin = run->contact.begin;
    history->contact_end = run->contact.end;
}

/* Room for that many rows. */
static bool make_room(struct solver_run *run, size_t rows, struct solver_error *error)
{
    struct solver_history *history = &run->history;
    size_t room = run->history_room == 0 ? 256 : run->history_room;
    if (rows <= run->history_room) {
        return true;
    }
    while (room < rows) {
        room *= 2;
    }
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
    history->flows = solver_scene_flows(run->scene);
    history->incompressible = run->scheme->iterations != NULL && !isnan(run->scheme->iterations(run->system));
    history->walled = run->wall.count > 0;
    history->body_count = run->cloud->body != NULL ? run->scene->shape_count : 1;
    history->balanced = run->scene->balance;
    for (int axis = 0; axis < 3; axis++) {
        const enum solver_face_kind *face = run->scene->face + 2 * axis;
        history->mirrored[axis] = face[0] == SOLVER_SYMMETRIC || face[1] == SOLVER_SYMMETRIC;
    }
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
    if ((history->probe_name == NULL && !start_history(run, error)) || !make_room(run, history->count + 1, error)) {
        return false;
    }
    size_t dim = (size_t)run->cloud->dim;
    const double *V = run->scheme->geometry(run->system).V;
    struct solver_totals totals = {.time = run->time, .external = run->external, .numerical = run->numerical};
    totals.impact = run->scene->balance ? run->wall.taken : 0.0;
    memcpy(totals.wall, run->wall.impulse, sizeof totals.wall);
    for (size_t a = 0; a < run->shown.count; a++) { /* one order of summation, whatever the threads */
        add_particle(run, a, V[a], &totals);
    }
    if (history->incompressible) {
        note_volumes(run, &totals);
    }
    for (size_t i = 0; i < history->probe_count; i++) {
        size_t a = run->probe[i];
        double *u = history->probe_u + (history->count * history->probe_count + i) * 3;
        double *v = history->probe_v + (history->count * history->probe_count + i) * 3;
        struct solver_vectors velocity = solver_state_v(&run->state);
        for (size_t axis = 0; axis < 3; axis++) {
            u[axis] = axis < dim ? solver_state_u(&run->state, a, axis, run->cloud->X[a * dim + axis]) : 0.0;
            v[axis] = axis < dim ? solver_vectors_get(&velocity, a, axis) : 0.0;
        }
    }
    note_bodies(run, V, history);
    history->totals[history->count++] = totals;
    return true;
}

/* Rows of history are kept as they lie in memory, and another build may lay them out otherwise. */
#define MEMBER(name) SOLVER_KEEP_MEMBER(struct solver_totals, name)
static const struct solver_keep_member row_members[] = {
    MEMBER(time),     MEMBER(linear),     MEMBER(angular),       MEMBER(kinetic),   MEMBER(strain), MEMBER(plastic),
    MEMBER(external), MEMBER(iterations), MEMBER(volume_change), MEMBER(numerical), MEMBER(impact), MEMBER(wall)};
_Static_assert(sizeof(struct solver_totals) == 18 * sizeof(double), "every member stands in the table");

/* Makes the history what a checkpoint's rows go into. */
static bool receive_rows(struct solver_run *run, uint64_t rows, struct solver_keeper *keeper,
                         struct solver_error *error)
{
    if (rows > keeper->size / sizeof(struct solver_totals)) {
        return solver_keep_refuse(keeper, error, "its %llu rows of history are more than it can hold",
                                  (unsigned long long)rows);
    }
    if ((run->history.probe_name == NULL && !start_history(run, error)) || !make_room(run, rows, error)) {
        return false;
    }
    run->history.count = rows;
    return true;
}

bool solver_run_keep_history(struct solver_run *run, struct solver_keeper *keeper, struct solver_error *error)
{
    struct solver_history *history = &run->history;
    if (!solver_keep(keeper, "rows of history", &history->count, sizeof history->count, 1, error) ||
        (keeper->reads && !receive_rows(run, history->count, keeper, error))) {
        return false;
    }
    size_t rows = history->count;
    size_t probed = rows * history->probe_count, vector = 3 * sizeof(double);
    return solver_keep_same(keeper, "members of a row", row_members, sizeof *row_members,
                            sizeof row_members / sizeof *row_members, error) &&
           solver_keep(keeper, "history", history->totals, sizeof *history->totals, rows, error) &&
           solver_keep(keeper, "displacements of probes", history->probe_u, vector, probed, error) &&
           solver_keep(keeper, "velocities of probes", history->probe_v, vector, probed, error) &&
           solver_keep(keeper, "velocities of bodies", history->body_velocity, sizeof history->body_velocity, 1,
                       error) &&
           solver_keep(keeper, "contact noted from", &history->contact_begin, sizeof history->contact_begin, 1,
                       error) &&
           solver_keep(keeper, "contact noted until", &history->contact_end, sizeof history->contact_end, 1, error);
}

const struct solver_history *solver_run_history(const struct solver_run *run)
{
    return &run->history;
}

void solver_run_output_arrays(const struct solver_run *run, struct solver_cost_arrays *arrays)
{
    static const char group[] = "history";
    const struct solver_history *history = &run->history;
    size_t probes = 3 * history->probe_count;
    struct arrays at;
    solver_cost_array(arrays, "output", "fields as shown", run->output, lay_out(run, &at), sizeof *run->output);
    solver_cost_array(arrays, group, "names of probes", history->probe_name, history->probe_count,
                      sizeof *history->probe_name);
    solver_cost_array(arrays, group, "places of probes", history->probe_X, history->probe_count,
                      sizeof *history->probe_X);
    if (run->history_room > 0) { /* make_room */
        solver_cost_bytes(arrays, group, "conserved quantities", run->history_room * sizeof *history->totals);
        solver_cost_bytes(arrays, group, "probes", 2 * (run->history_room * probes + 1) * sizeof(double));
    }
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
