#include "solver/run.h"

#include "solver/memory.h"
#include "solver/run_internal.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* What the scene says, else as many threads as there are cores, each with so much work that it outlasts the wait for
 * the others: a particle's share grows fourfold with each dimension, as its neighbours do. */
static int choose_threads(int wanted, int dim, size_t particles)
{
    size_t work_per_thread = (size_t)131072 >> (2 * dim);
    size_t worth = particles / work_per_thread;
    int cores = omp_get_num_procs();
    if (wanted > 0) {
        return wanted;
    }
    return worth < 1 ? 1 : worth < (size_t)cores ? (int)worth : cores;
}

static void choose_terms(struct solver_run *run)
{
    const struct solver_scene *scene = run->scene;
    struct solver_upwind *work = &run->work;
    const struct solver_upwind_loops *loops[] = {&solver_upwind_1d, &solver_upwind_2d, &solver_upwind_3d};
    run->loops = loops[scene->dim - 1];
    work->material = solver_material_find(scene->material_model)->in[scene->dim - 1];
    work->evolves_J = scene->evolved != SOLVER_PF;
    work->evolves_H = scene->evolved == SOLVER_PFHJ;
    work->frozen = work->material->linear;
    work->whole_jump = strcmp(scene->volume_flux, "stress") == 0;
    work->reconstruct = strcmp(scene->reconstruction, "none") != 0;
}

/* Constants of one particle of a composite body. */
static bool constants_at(const struct solver_run *run, size_t a, struct solver_material_constants *constants,
                         struct solver_error *error)
{
    size_t dim = (size_t)run->cloud->dim;
    double X[3] = {0};
    double value[3];
    memcpy(X, run->cloud->X + a * dim, dim * sizeof *X);
    if (!solver_scene_eval(run->scene, SOLVER_MATERIAL_AT, X, 0.0, value, 3, error)) {
        return false;
    }
    if (!(value[0] > 0.0 && value[1] > -1.0 && value[1] < 0.5 && value[2] > 0.0)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: material.at at X = (%g, %g, %g) m: expected E > 0 Pa, nu in (-1, 0.5), rho > 0 kg/m^3, "
                           "got %g, %g, %g",
                           run->scene->path, X[0], X[1], X[2], value[0], value[1], value[2]);
    }
    *constants = solver_material_constants(value[0], value[1], value[2]);
    return true;
}

static bool set_constants(struct solver_run *run, struct solver_error *error)
{
    const struct solver_scene *scene = run->scene;
    bool composite = solver_scene_has(scene, SOLVER_MATERIAL_AT);
    size_t count = composite ? run->cloud->count : 1;
    if (!solver_alloc((void **)&run->constants, count, sizeof *run->constants, "material constants", error)) {
        return false;
    }
    run->constants[0] = solver_material_constants(scene->E, scene->nu, scene->rho);
    for (size_t a = 0; composite && a < count; a++) {
        if (!constants_at(run, a, &run->constants[a], error)) {
            return false;
        }
    }
    run->work.constants = run->constants;
    run->work.stride = composite ? 1 : 0;
    return true;
}

static void bind_stencil(struct solver_run *run)
{
    const struct solver_stencil *stencil = run->stencil;
    run->work.row = stencil->graph.row;
    run->work.neighbour = stencil->graph.neighbour;
    run->work.pair = stencil->pair;
    run->work.transposed = stencil->transposed;
    run->work.row_sum = stencil->row_sum;
    run->work.least_squares = stencil->least_squares;
    run->work.V = stencil->V;
}

/* F = sum_b (x_b - x_a) (x) C_ab / 2V_a, row by row. */
static void discrete_F(const struct solver_run *run, size_t a, double *F)
{
    const struct solver_stencil *stencil = run->stencil;
    size_t dim = (size_t)stencil->dim;
    size_t lanes = run->loops->lanes;
    memset(F, 0, dim * dim * sizeof *F);
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        const double *C = solver_stencil_C(stencil, ab);
        size_t b = stencil->graph.neighbour[ab];
        for (size_t i = 0; i < dim; i++) {
            double d = run->work.x[b * lanes + i] - run->work.x[a * lanes + i];
            for (size_t I = 0; I < dim; I++) {
                F[i * dim + I] += 0.5 * d * C[I] / stencil->V[a];
            }
        }
    }
}

static bool initial_state(struct solver_run *run, struct solver_error *error)
{
    const struct solver_scene *scene = run->scene;
    struct solver_upwind *work = &run->work;
    size_t dim = (size_t)scene->dim;
    size_t lanes = run->loops->lanes;
    size_t count = run->cloud->count;
    for (size_t a = 0; a < count; a++) {
        double X[3] = {0};
        double value[3] = {0};
        memcpy(X, run->cloud->X + a * dim, dim * sizeof *X);
        memcpy(run->state.X + a * lanes, X, dim * sizeof *X);
        if (solver_scene_has(scene, SOLVER_INITIAL_DISPLACEMENT) &&
            !solver_scene_eval(scene, SOLVER_INITIAL_DISPLACEMENT, X, 0.0, value, dim, error)) {
            return false;
        }
        for (size_t i = 0; i < dim; i++) {
            work->x[a * lanes + i] = X[i] + value[i];
            value[i] = 0.0;
        }
        if (solver_scene_has(scene, SOLVER_INITIAL_VELOCITY) &&
            !solver_scene_eval(scene, SOLVER_INITIAL_VELOCITY, X, 0.0, value, dim, error)) {
            return false;
        }
        for (size_t i = 0; i < dim; i++) {
            work->v[a * lanes + i] = value[i];
        }
    }
    for (size_t a = 0; a < count; a++) {
        double F[9];
        if (!solver_scene_has(scene, SOLVER_INITIAL_F)) {
            discrete_F(run, a, F);
        } else {
            double X[3] = {0};
            memcpy(X, run->cloud->X + a * dim, dim * sizeof *X);
            if (!solver_scene_eval(scene, SOLVER_INITIAL_F, X, 0.0, F, dim * dim, error)) {
                return false;
            }
        }
        for (size_t i = 0; i < dim; i++) {
            for (size_t I = 0; I < dim; I++) {
                work->F[(a * dim + I) * lanes + i] = F[i * dim + I];
            }
        }
    }
    run->loops->measures(work->frozen, 0, count, work->F, work->H, work->J);
    return solver_faces_constrain(&run->faces, scene, run->cloud, 0.0, lanes, work->v, error);
}

static void find_probes(struct solver_run *run)
{
    size_t dim = (size_t)run->cloud->dim;
    for (size_t i = 0; i < run->scene->probe_count; i++) {
        double nearest = INFINITY;
        for (size_t a = 0; a < run->cloud->count; a++) {
            double square = 0.0;
            for (size_t axis = 0; axis < dim; axis++) {
                double d = run->cloud->X[a * dim + axis] - run->scene->probe[i].X[axis];
                square += d * d;
            }
            if (square < nearest) {
                nearest = square;
                run->probe[i] = (uint32_t)a;
            }
        }
    }
}

static bool build(struct solver_run *run, struct solver_error *error)
{
    const struct solver_scene *scene = run->scene;
    bool least_squares = strcmp(scene->reconstruction, "least-squares") == 0;
    struct solver_box box = {.dim = scene->dim,
                             .spacing = scene->reference_length / scene->n,
                             .perturb = scene->perturb,
                             .seed = scene->seed};
    memcpy(box.lower, scene->lower, sizeof box.lower);
    memcpy(box.upper, scene->upper, sizeof box.upper);
    run->integrator = solver_integrator_find(scene->integrator);
    const struct solver_stencil_builder *builder = solver_stencil_find(scene->stencil);
    if (run->integrator == NULL || builder == NULL || solver_material_find(scene->material_model) == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: no integrator \"%s\", stencil \"%s\" or material \"%s\"",
                           scene->path, scene->integrator, scene->stencil, scene->material_model);
    }
    choose_terms(run);
    if (!solver_cloud_box(&box, &run->cloud, error) || !set_constants(run, error)) {
        return false;
    }
    run->threads = choose_threads(scene->threads, scene->dim, run->cloud->count);
    omp_set_num_threads(run->threads);
    if (!solver_stencil_create(builder, run->cloud, scene->support, &run->stencil, error) ||
        (least_squares && !solver_stencil_add_least_squares(run->stencil, run->cloud, error)) ||
        !solver_faces_create(scene, run->stencil, run->cloud, &run->faces, error) ||
        !solver_state_create(&run->state, run->cloud->count, scene->dim, run->integrator, least_squares, &run->work,
                             error)) {
        return false;
    }
    bind_stencil(run);
    run->residuals = solver_stencil_check(run->stencil, run->cloud);
    find_probes(run);
    if (!initial_state(run, error)) {
        return false;
    }
    solver_run_stresses(run);
    return solver_run_check(run, error);
}

bool solver_run_create(const struct solver_scene *scene, struct solver_run **out, struct solver_error *error)
{
    double begun = solver_run_clock();
    struct solver_run *run = NULL;
    *out = NULL;
    if (!solver_alloc((void **)&run, 1, sizeof *run, "run", error)) {
        return false;
    }
    if (strcmp(scene->initial_from, "oracle") == 0 && scene->start == NULL) {
        solver_run_free(run);
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: initial.from: the scene starts from its oracle, and none was given", scene->path);
    }
    run->scene = scene;
    if (!build(run, error)) {
        solver_run_free(run);
        return false;
    }
    run->setup_seconds = solver_run_clock() - begun;
    *out = run;
    return true;
}

void solver_run_free(struct solver_run *run)
{
    if (run == NULL) {
        return;
    }
    solver_run_output_free(run);
    free(run->constants);
    solver_state_free(&run->state);
    solver_faces_free(&run->faces);
    solver_stencil_free(run->stencil);
    solver_cloud_free(run->cloud);
    free(run);
}

struct solver_facts solver_run_facts(const struct solver_run *run)
{
    double count = (double)run->cloud->count;
    double state = solver_state_bytes_per_particle(&run->state, true);
    double fields = solver_state_bytes_per_particle(&run->state, false);
    double evolved = 8.0 * (double)run->state.evolved / count;
    double composite = (double)(run->work.stride * sizeof *run->constants);
    double stencil = (double)solver_stencil_bytes(run->stencil) / count;
    /* per stage: the stencil twice (gradients, rates); fields read by both, rates written; in the update state, start
     * and rate read, state and derived fields written. The first stage writes the start instead of reading it. */
    double stage = 2.0 * stencil + 3.0 * fields + 4.0 * evolved;
    double closure = fmax(run->residuals.closure, run->residuals.linear);
    return (struct solver_facts){
        .particles = run->cloud->count,
        .pairs = run->stencil->pairs,
        .steps = run->step,
        .spacing = run->cloud->spacing,
        .setup_seconds = run->setup_seconds,
        .seconds = run->seconds,
        .bytes_per_particle = state + stencil + composite,
        .state_bytes = fields,
        .step_traffic = run->integrator->stages * stage,
        .stencil_residual = closure,
        .threads = run->threads,
    };
}
