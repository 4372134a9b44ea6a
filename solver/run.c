#include "solver/run.h"

#include "solver/memory.h"
#include "solver/run_internal.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Particles per piece of work. A piece's result does not depend on who does it, and pieces are combined in order, so
 * results are the same for any number of threads. */
enum { PIECE = 256, HISTORY_ROWS = 200 };

static double now(void)
{
    struct timespec at;
    (void)clock_gettime(CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

static size_t pieces(const struct solver_run *run)
{
    return (run->cloud->count + PIECE - 1) / PIECE;
}

static void bounds(const struct solver_run *run, size_t piece, size_t *begin, size_t *end)
{
    *begin = piece * PIECE;
    *end = *begin + PIECE < run->cloud->count ? *begin + PIECE : run->cloud->count;
}

static void choose_terms(struct solver_run *run)
{
    const struct solver_scene *scene = run->scene;
    struct solver_upwind *work = &run->work;
    const struct solver_upwind_loops *loops[] = {&solver_upwind_1d, &solver_upwind_2d, &solver_upwind_3d};
    run->loops = loops[scene->dim - 1];
    work->material = solver_material_find(scene->material_model)->in[scene->dim - 1];
    work->constants = solver_material_constants(scene->E, scene->nu, scene->rho);
    work->rho = scene->rho;
    work->cp = work->constants.cp;
    work->cs = work->constants.cs;
    work->evolves_J = scene->evolved != SOLVER_PF;
    work->evolves_H = scene->evolved == SOLVER_PFHJ;
    work->frozen = work->material->linear;
    work->whole_jump = strcmp(scene->volume_flux, "stress") == 0;
    work->reconstruct = strcmp(scene->reconstruction, "none") != 0;
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
            work->p[a * lanes + i] = scene->rho * value[i];
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
    return solver_faces_constrain(&run->faces, scene, run->cloud, scene->rho, 0.0, lanes, work->p, error);
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

/* Fails with SOLVER_BROKE_DOWN if any particle's state is broken. */
static bool check_state(struct solver_run *run, struct solver_error *error)
{
    size_t count = run->cloud->count;
    size_t broken = count;
#pragma omp parallel for schedule(static) reduction(min : broken)
    for (size_t piece = 0; piece < pieces(run); piece++) {
        size_t begin;
        size_t end;
        bounds(run, piece, &begin, &end);
        size_t found = run->loops->first_broken(&run->work, begin, end);
        broken = found < end && found < broken ? found : broken;
    }
    if (broken == count) {
        return true;
    }
    const double *X = run->cloud->X + broken * (size_t)run->cloud->dim;
    size_t lanes = run->loops->lanes;
    bool momentum = !isfinite(run->work.p[broken * lanes]);
    double J;
    if (run->work.J != NULL) {
        J = run->work.J[broken];
    } else {
        size_t tensor = (size_t)run->cloud->dim * lanes;
        run->loops->measures(false, 0, 1, run->work.F + broken * tensor, NULL, &J);
    }
    return solver_fail(error, SOLVER_BROKE_DOWN,
                       "step %zu, t = %.6g s: particle %zu at X = (%g, %g, %g) m: %s. Try a smaller cfl, a finer n, or "
                       "evolved = \"pFHJ\"",
                       run->step, run->time, broken, X[0], run->cloud->dim > 1 ? X[1] : 0.0,
                       run->cloud->dim > 2 ? X[2] : 0.0,
                       momentum       ? "linear momentum p is not finite"
                       : !isfinite(J) ? "deformation gradient F or Jacobian J is not finite"
                       : J <= 0.0     ? "the particle is turned inside out, Jacobian J <= 0"
                                      : "deformation gradient F is not finite");
}

/* Rates of the present state at time t. */
static bool evaluate(struct solver_run *run, double t, double *power, struct solver_error *error)
{
    const struct solver_upwind *work = &run->work;
#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < pieces(run); piece++) {
            size_t begin;
            size_t end;
            bounds(run, piece, &begin, &end);
            run->loops->gradients(work, begin, end);
        }
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < pieces(run); piece++) {
            size_t begin;
            size_t end;
            bounds(run, piece, &begin, &end);
            run->loops->rates(work, begin, end);
        }
    }
    return solver_faces_load(&run->faces, run->scene, run->cloud, run->stencil, t, run->loops->lanes, work->p,
                             work->rho, work->p_rate, power, error);
}

/* One stage's update of one field over [first, last). */
static void update_slice(const struct solver_state *state, const struct solver_stage *stage, double dt, size_t first,
                         size_t last)
{
    double *restrict U = state->U;
    const double *restrict start = state->start;
    const double *restrict rate = state->rate;
    if (state->sum == NULL) {
        for (size_t i = first; i < last; i++) {
            U[i] = stage->old * start[i] + stage->keep * U[i] + dt * stage->rate * rate[i];
        }
        return;
    }
    double *restrict sum = state->sum;
    double keep_sum = stage->time > 0.0 ? 1.0 : 0.0; /* the first stage starts the sum */
    for (size_t i = first; i < last; i++) {
        U[i] = stage->old * start[i] + stage->keep * U[i] + dt * (stage->rate * rate[i] + stage->sum * sum[i]);
        sum[i] = keep_sum * sum[i] + stage->accumulate * rate[i];
    }
}

static void stresses(struct solver_run *run)
{
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < pieces(run); piece++) {
        size_t begin;
        size_t end;
        bounds(run, piece, &begin, &end);
        run->loops->stresses(&run->work, begin, end);
    }
}

/* State and stress of the next stage, piece by piece, while the piece is in cache. */
static bool update(struct solver_run *run, const struct solver_stage *stage, double t, double dt,
                   struct solver_error *error)
{
    const struct solver_state *state = &run->state;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < pieces(run); piece++) {
        size_t begin;
        size_t end;
        bounds(run, piece, &begin, &end);
        for (size_t f = 0; f < state->field_count && state->field[f].evolved; f++) {
            size_t width = state->field[f].width;
            size_t offset = state->field[f].offset;
            update_slice(state, stage, dt, offset + begin * width, offset + end * width);
        }
        run->loops->stresses(&run->work, begin, end);
    }
    return solver_faces_constrain(&run->faces, run->scene, run->cloud, run->work.rho, t, run->loops->lanes, run->work.p,
                                  error);
}

/* The step that the CFL number allows (000_e9ec29e1bde7947d.txt eq. 41). */
static double largest_step(const struct solver_run *run)
{
    double fastest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : fastest)
    for (size_t piece = 0; piece < pieces(run); piece++) {
        size_t begin;
        size_t end;
        bounds(run, piece, &begin, &end);
        fastest = fmax(fastest, run->work.material->fastest(&run->work.constants, begin, end, run->work.F));
    }
    return run->scene->cfl * run->cloud->spacing / fastest;
}

static bool step(struct solver_run *run, double dt, struct solver_error *error)
{
    const struct solver_integrator *integrator = run->integrator;
    double work = 0.0;
    memcpy(run->state.start, run->state.U, run->state.evolved * sizeof(double));
    for (int s = 0; s < integrator->stages; s++) {
        const struct solver_stage *stage = &integrator->stage[s];
        double next = s + 1 < integrator->stages ? integrator->stage[s + 1].time : 1.0;
        double power;
        if (!evaluate(run, run->time + stage->time * dt, &power, error) ||
            !update(run, stage, run->time + next * dt, dt, error)) {
            return false;
        }
        work += stage->weight * dt * power;
    }
    run->time += dt;
    run->external += work;
    run->step++;
    if (check_state(run, error)) {
        return true;
    }
    memcpy(run->state.U, run->state.start, run->state.evolved * sizeof(double));
    stresses(run);
    run->time -= dt;
    run->external -= work;
    run->step--;
    return false;
}

bool solver_run_steps(struct solver_run *run, size_t steps, struct solver_error *error)
{
    double begun = now();
    omp_set_num_threads(run->threads);
    for (size_t i = 0; i < steps; i++) {
        if (!step(run, largest_step(run), error)) {
            return false;
        }
    }
    run->seconds += now() - begun;
    return true;
}

bool solver_run_to(struct solver_run *run, double t_end, solver_progress *progress, void *context,
                   struct solver_error *error)
{
    double begun = now();
    double start = run->time;
    size_t noted = 0;
    bool ok = true;
    omp_set_num_threads(run->threads);
    if (run->history.count == 0) {
        ok = solver_run_note(run, error);
    }
    while (ok && run->time < t_end) {
        /* equal steps that end at t_end, rather than a last step of any size */
        double remaining = t_end - run->time;
        double steps = ceil(remaining / largest_step(run) - 1e-9);
        bool last = steps <= 1.0;
        if (!isfinite(steps) || steps > 1e12) {
            return solver_fail(error, SOLVER_BROKE_DOWN,
                               "step %zu, t = %.6g s: the time step %.3g s is too small to "
                               "reach t_end = %g s",
                               run->step, run->time, largest_step(run), t_end);
        }
        ok = step(run, last ? remaining : remaining / steps, error);
        if (ok && last) {
            run->time = t_end;
        }
        size_t row = (size_t)((run->time - start) / (t_end - start) * HISTORY_ROWS);
        if (ok && (last || row > noted)) {
            noted = row;
            ok = solver_run_note(run, error);
        }
        if (ok && progress != NULL && !progress(context, run->time, t_end, run->step)) {
            break;
        }
    }
    run->seconds += now() - begun;
    return ok;
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
    if (!solver_cloud_box(&box, &run->cloud, error) ||
        !solver_stencil_create(builder, run->cloud, scene->support, &run->stencil, error) ||
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
    stresses(run);
    return check_state(run, error);
}

bool solver_run_create(const struct solver_scene *scene, struct solver_run **out, struct solver_error *error)
{
    double begun = now();
    struct solver_run *run = NULL;
    *out = NULL;
    if (!solver_alloc((void **)&run, 1, sizeof *run, "run", error)) {
        return false;
    }
    run->scene = scene;
    run->threads = scene->threads > 0 ? scene->threads : omp_get_num_procs();
    omp_set_num_threads(run->threads);
    if (!build(run, error)) {
        solver_run_free(run);
        return false;
    }
    run->setup_seconds = now() - begun;
    *out = run;
    return true;
}

void solver_run_free(struct solver_run *run)
{
    if (run == NULL) {
        return;
    }
    solver_run_output_free(run);
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
    double closure = fmax(run->residuals.closure, run->residuals.linear);
    return (struct solver_facts){
        .particles = run->cloud->count,
        .pairs = run->stencil->pairs,
        .steps = run->step,
        .spacing = run->cloud->spacing,
        .setup_seconds = run->setup_seconds,
        .seconds = run->seconds,
        .bytes_per_particle = state + (double)solver_stencil_bytes(run->stencil) / count,
        .state_bytes = solver_state_bytes_per_particle(&run->state, false),
        .stencil_residual = closure,
        .threads = run->threads,
    };
}
