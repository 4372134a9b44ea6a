#include "solver/run.h"

#include "solver/interfaces.h"
#include "solver/memory.h"
#include "solver/path.h"
#include "solver/run_internal.h"
#include "solver/symmetry.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* Cores, or fewer where OMP_NUM_THREADS says so, as every program with OpenMP takes it. */
static int most_threads(void)
{
    const char *asked = getenv("OMP_NUM_THREADS");
    long wanted = asked != NULL ? strtol(asked, NULL, 10) : 0; /* of a list the first: nothing is nested here */
    int cores = omp_get_num_procs();
    return wanted > 0 && wanted < cores ? (int)wanted : cores;
}

/* What the scene says, else as many threads as there are cores, each with so much work that it outlasts the wait for
 * the others: a particle's share grows fourfold with each dimension, as its neighbours do. */
static int choose_threads(int wanted, int dim, size_t particles)
{
    size_t work_per_thread = (size_t)131072 >> (2 * dim);
    size_t worth = particles / work_per_thread;
    int cores = most_threads();
    if (wanted > 0) {
        return wanted;
    }
    return worth < 1 ? 1 : worth < (size_t)cores ? (int)worth : cores;
}

/* Constants of one particle of a composite body; a particle of a wall is of what it is beside. */
static bool constants_at(const struct solver_run *run, size_t a, struct solver_material_constants *constants,
                         struct solver_error *error)
{
    size_t dim = (size_t)run->cloud->dim;
    double X[3] = {0};
    double value[3];
    for (size_t i = 0; i < dim; i++) {
        X[i] = fmin(fmax(run->cloud->X[a * dim + i], run->scene->lower[i]), run->scene->upper[i]);
    }
    if (!solver_scene_eval(run->scene, SOLVER_MATERIAL_AT, X, 0.0, value, 3, error)) {
        return false;
    }
    if (!(value[0] > 0.0 && value[1] > -1.0 && value[1] < 0.5 && value[2] > 0.0)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: material.at at X = (%g, %g, %g) m: expected E > 0 Pa, nu in (-1, 0.5), rho > 0 kg/m^3, "
                           "got %g, %g, %g",
                           run->scene->path, X[0], X[1], X[2], value[0], value[1], value[2]);
    }
    for (int i = 0; i < 3; i += 2) {
        if (value[i] > solver_material_most || value[i] < 1.0 / solver_material_most) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "%s: material.at at X = (%g, %g, %g) m: products of %s would leave the range of double "
                               "precision; expected a number in [%g, %g], got %g; choose other units",
                               run->scene->path, X[0], X[1], X[2], i == 0 ? "moduli" : "densities",
                               1.0 / solver_material_most, solver_material_most, value[i]);
        }
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
        size_t driven = solver_cloud_driven(run->cloud);
        if (a >= driven) { /* an image */
            run->constants[a] = run->constants[run->cloud->image[a - driven]];
        } else if (!constants_at(run, a, &run->constants[a], error)) {
            return false;
        }
    }
    if (composite && !solver_interfaces_find(run->cloud, run->constants, error)) {
        return false;
    }
    run->body = (struct solver_body){.scene = scene,
                                     .cloud = run->cloud,
                                     .constants = run->constants,
                                     .stride = composite ? 1 : 0,
                                     .faces = &run->faces};
    return true;
}

/* Where the particles are and how they move at the start, as the scene says. */
static bool start_motion(struct solver_run *run, struct solver_error *error)
{
    const struct solver_scene *scene = run->scene;
    size_t dim = (size_t)scene->dim;
    struct solver_vectors v = solver_state_v(&run->state);
    for (size_t a = 0; a < solver_cloud_driven(run->cloud); a++) {
        double X[3] = {0};
        double value[3] = {0};
        memcpy(X, run->cloud->X + a * dim, dim * sizeof *X);
        if (solver_scene_has(scene, SOLVER_INITIAL_DISPLACEMENT) &&
            !solver_scene_eval(scene, SOLVER_INITIAL_DISPLACEMENT, X, 0.0, value, dim, error)) {
            return false;
        }
        for (size_t i = 0; i < dim; i++) {
            solver_state_place(&run->state, a, i, X[i], value[i]);
            value[i] = 0.0;
        }
        if (solver_scene_has(scene, SOLVER_INITIAL_VELOCITY) &&
            !solver_scene_eval(scene, SOLVER_INITIAL_VELOCITY, X, 0.0, value, dim, error)) {
            return false;
        }
        for (size_t i = 0; i < dim; i++) {
            solver_vectors_set(&v, a, i, value[i]);
        }
    }
    if (run->cloud->symmetry != NULL) {
        solver_symmetry_reflect(run->cloud, &run->state);
    }
    return true;
}

static bool initial_state(struct solver_run *run, struct solver_error *error)
{
    struct solver_state *state = &run->state;
    if (!start_motion(run, error) || !run->scheme->start(run->system, error) ||
        !solver_faces_constrain(&run->faces, &run->body, 0.0, solver_state_v(state), error)) {
        return false;
    }
    if (run->cloud->symmetry != NULL) {
        solver_symmetry_reflect(run->cloud, state);
    }
    if (!solver_run_check(run, error)) { /* first: what is turned inside out need not have a stress */
        return false;
    }
    solver_run_refresh(run);
    return solver_wall_check(&run->wall, &run->body, state, error);
}

static void find_probes(struct solver_run *run)
{
    size_t dim = (size_t)run->cloud->dim;
    for (size_t i = 0; i < run->scene->probe_count; i++) {
        double nearest = INFINITY;
        for (size_t a = 0; a < run->shown.count; a++) {
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
    struct solver_field table[SOLVER_STATE_FIELDS];
    bool single = strcmp(scene->precision, "single") == 0;
    run->integrator = solver_integrator_find(scene->integrator);
    run->scheme = solver_scheme_find(scene->scheme);
    if (single && run->scheme != NULL) {
        run->scheme = run->scheme->single;
    }
    if (run->integrator == NULL || run->scheme == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: no integrator \"%s\" or scheme \"%s\"", scene->path,
                           scene->integrator, scene->scheme);
    }
    if (solver_scene_flows(scene) && run->scheme->dissipated == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: material.yield_stress: the scheme %s knows no plastic flow",
                           scene->path, run->scheme->name);
    }
    if (scene->balance && run->scheme->lost == NULL) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "%s: balance: what the dissipation of the scheme %s takes is not measured; expected scheme = "
            "\"upwind\" or \"jst\"",
            scene->path, run->scheme->name);
    }
    if (!run->scheme->stencil && (scene->domain.cut[0] || scene->domain.cut[1] || scene->domain.cut[2])) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: domain.symmetry: images are neighbours in a stencil, and the scheme %s has none; "
                           "expected scheme = \"upwind\" or \"jst\"",
                           scene->path, run->scheme->name);
    }
    if (!solver_run_cloud(run, error) || !set_constants(run, error)) {
        return false;
    }
    run->threads = choose_threads(scene->threads, scene->dim, run->cloud->count);
    omp_set_num_threads(run->threads);
    if (!run->scheme->create(&run->body, &run->system, error)) {
        return false;
    }
    if (run->cloud->symmetry != NULL) {
        solver_cloud_free(run->cloud->symmetry->whole);
        run->cloud->symmetry->whole = NULL;
    }
    struct solver_geometry geometry = run->scheme->geometry(run->system);
    size_t rows = run->scheme->fields(run->system, table);
    if (!solver_faces_create(&run->body, &geometry, &run->faces, error) ||
        !solver_contact_create(&run->body, geometry.V, &run->contact, error) ||
        !solver_wall_create(&run->body, &geometry, &run->faces, &run->wall, error) ||
        !solver_projection_create(&run->body, &run->faces, geometry.V, &run->projection, error) ||
        !solver_state_create(&run->state, run->cloud->count, scene->dim, single, run->integrator, table, rows, error)) {
        return false;
    }
    run->projection.held = run->projection.held || run->wall.count > 0;
    find_probes(run);
    return solver_run_make_waves(run, solver_run_parts_stages(run), error) && initial_state(run, error);
}

bool solver_run_create(const struct solver_scene *scene, struct solver_run **out, struct solver_error *error)
{
    double begun = solver_run_clock();
    struct solver_run *run = NULL;
    *out = NULL;
    if (!solver_path_check(error)) {
        return false;
    }
    if (!solver_alloc((void **)&run, 1, sizeof *run, "run", error)) {
        return false;
    }
    if (strcmp(scene->initial_from, "oracle") == 0 && scene->start == NULL) {
        solver_run_free(run);
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: initial.from: the scene starts from its oracle, and none was given", scene->path);
    }
    if (strcmp(scene->loads_from, "oracle") == 0 && scene->drive == NULL) {
        solver_run_free(run);
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: loads.from: the scene is driven by its oracle, and none was given", scene->path);
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
    for (int sweeps = 0; sweeps <= SOLVER_STEP_SWEEPS; sweeps++) {
        solver_wave_free(&run->wave[sweeps]);
    }
    solver_state_free(&run->state);
    solver_faces_free(&run->faces);
    solver_contact_free(&run->contact);
    solver_wall_free(&run->wall);
    solver_projection_free(&run->projection);
    if (run->system != NULL) {
        run->scheme->destroy(run->system);
    }
    free(run->constants);
    solver_cloud_free(run->cloud);
    free(run);
}

struct solver_facts solver_run_facts(const struct solver_run *run)
{
    struct solver_geometry geometry = run->scheme->geometry(run->system);
    double count = (double)run->cloud->count; /* images take memory as particles do */
    double state = solver_state_bytes_per_particle(&run->state, true);
    double fields = solver_state_bytes_per_particle(&run->state, false);
    double composite = (double)(run->body.stride * sizeof *run->constants);
    double bytes = geometry.bytes / count;
    double number = (double)solver_state_bytes(&run->state);
    double evolved = number * (double)run->state.evolved / count;
    double rates = number * (double)run->state.rates / count;
    double passes = geometry.passes;
    /* per stage: the geometry in each pass; fields read by each, rates written; in the update state, start and rates
     * read, state and other fields written. The first stage reads no state but that at the start. */
    double stage = passes * bytes + (passes + 1.0) * fields + 2.0 * evolved + 2.0 * rates;
    double mass = 0.0;
    for (size_t a = 0; a < run->cloud->count; a++) {
        mass += geometry.V[a] * solver_run_density(run, a);
    }
    return (struct solver_facts){
        .particles = solver_cloud_driven(run->cloud),
        .pairs = geometry.pairs,
        .steps = run->step,
        .spacing = run->cloud->spacing,
        .finest = solver_cloud_finest(run->cloud),
        .step = solver_scheme_largest_step(run->scheme, run->system, run->cloud->count),
        .shorter = geometry.shorter,
        .mass = mass,
        .setup_seconds = run->setup_seconds,
        .seconds = run->seconds,
        .bytes_per_particle = state + bytes + composite,
        .state_bytes = fields,
        .step_traffic = run->integrator->stages * stage - evolved,
        .stencil_residual = geometry.residual,
        .threads = run->threads,
    };
}

void solver_run_cost(const struct solver_run *run, struct solver_cost_arrays *arrays, struct solver_cost_terms *terms)
{
    size_t constants = run->body.stride != 0 ? run->cloud->count : 1;
    int stages = run->integrator->stages;
    arrays->count = 0;
    solver_state_arrays(&run->state, arrays);
    run->scheme->arrays(run->system, arrays);
    solver_cost_array(arrays, "material", run->body.stride != 0 ? "composite constants" : "constants", run->constants,
                      constants, sizeof *run->constants);
    solver_faces_arrays(&run->faces, &run->body, arrays);
    solver_contact_arrays(&run->contact, arrays);
    solver_wall_arrays(&run->wall, run->cloud->count, arrays);
    solver_projection_arrays(&run->projection, arrays);
    solver_cloud_arrays(run->cloud, arrays);
    solver_symmetry_arrays(run->cloud, arrays);
    for (int sweeps = 0; sweeps <= SOLVER_STEP_SWEEPS; sweeps++) {
        solver_wave_arrays(&run->wave[sweeps], arrays);
    }
    solver_run_output_arrays(run, arrays);
    solver_cost_array(arrays, "run", "itself", run, 1, sizeof *run);
    terms->count = 0;
    run->scheme->terms(run->system, terms);
    solver_faces_terms(&run->faces, &run->body, terms);
    solver_contact_terms(&run->contact, terms);
    solver_wall_terms(&run->wall, stages, terms);
    solver_projection_terms(&run->projection, stages, terms);
    solver_symmetry_terms(run->cloud, terms);
    solver_state_terms(&run->state, run->integrator, terms);
}
