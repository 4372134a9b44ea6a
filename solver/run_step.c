/* A run in time: rates, stages, steps, and the checks that stop it. */
#include "solver/path.h"
#include "solver/pieces.h"
#include "solver/run_internal.h"
#include "solver/symmetry.h"

#include <math.h>
#include <omp.h>
#include <string.h>
#include <time.h>

double solver_run_clock(void)
{
    struct timespec at;
    (void)clock_gettime(CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

static bool is_finite(const struct solver_run *run, size_t a)
{
    struct solver_vectors v = solver_state_v(&run->state);
    double square = 0.0; /* as the loops do: what overflows when squared has grown beyond all bounds */
    for (size_t i = 0; i < (size_t)run->cloud->dim; i++) {
        square += solver_vectors_get(&v, a, i) * solver_vectors_get(&v, a, i);
    }
    return isfinite(square);
}

bool solver_run_check(struct solver_run *run, struct solver_error *error)
{
    size_t count = run->cloud->count;
    size_t broken = count;
#pragma omp parallel for schedule(static) reduction(min : broken)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        size_t found = run->scheme->first_broken(run->system, at.begin, at.end);
        broken = found < at.end && found < broken ? found : broken;
    }
    if (broken == count) {
        return true;
    }
    const double *X = run->cloud->X + broken * (size_t)run->cloud->dim;
    return solver_fail(
        error, SOLVER_BROKE_DOWN, "step %zu, t = %.6g s: particle %zu at X = (%g, %g, %g) m: %s. Try %s", run->step,
        run->time, broken, X[0], run->cloud->dim > 1 ? X[1] : 0.0, run->cloud->dim > 2 ? X[2] : 0.0,
        is_finite(run, broken) ? run->scheme->complaint(run->system, broken) : "linear momentum p is not finite",
        run->scheme->advice);
}

/* Rates of the present state in a stage of a step, and the power of the loads. */
static bool evaluate(struct solver_run *run, int s, double dt, double *power, struct solver_error *error)
{
    struct solver_state *state = &run->state;
    const struct solver_stage *stage = &run->integrator->stage[s];
    double t = run->time + stage->time * dt;
    if (!run->scheme->evaluate(run->system, t, dt, error)) {
        return false;
    }
    if (run->projection.on) {
        solver_projection_note(&run->projection, state, stage);
    }
    struct solver_geometry geometry = run->scheme->geometry(run->system);
    return solver_faces_load(&run->faces, &run->body, &geometry, t, solver_state_v(state), solver_state_v_rate(state),
                             power, error) &&
           solver_contact_act(&run->contact, state->x, state->v, state->lanes, t, dt, state->v_rate, error) &&
           (!run->projection.on ||
            solver_projection_act(&run->projection, state, stage, s + 1 == run->integrator->stages, dt, error));
}

/* One stage's update of `count` numbers. The first stage of every integrator sets out from the start of the step
 * itself.
 */
static inline __attribute__((always_inline)) void update_entries(double *restrict U, const double *restrict start,
                                                                 const double *restrict rate, double *restrict sum,
                                                                 size_t count, const struct solver_stage *stage,
                                                                 double dt)
{
    bool begins = stage->time == 0.0;
    if (begins && sum == NULL) {
        for (size_t i = 0; i < count; i++) {
            U[i] = start[i] + dt * stage->rate * rate[i];
        }
    } else if (begins) {
        for (size_t i = 0; i < count; i++) {
            U[i] = start[i] + dt * stage->rate * rate[i];
            sum[i] = stage->accumulate * rate[i];
        }
    } else if (sum == NULL) {
        for (size_t i = 0; i < count; i++) {
            U[i] = start[i] + stage->keep * (U[i] - start[i]) + dt * stage->rate * rate[i];
        }
    } else {
        for (size_t i = 0; i < count; i++) {
            U[i] = start[i] + stage->keep * (U[i] - start[i]) + dt * (stage->rate * rate[i] + stage->sum * sum[i]);
            sum[i] += stage->accumulate * rate[i];
        }
    }
}

#ifdef SOLVER_WIDE_PATHS
/* The same bits in wider vectors: no multiplication is fused in this file. */
__attribute__((target("avx2"))) static void update_wide(double *U, const double *start, const double *rate, double *sum,
                                                        size_t count, const struct solver_stage *stage, double dt)
{
    update_entries(U, start, rate, sum, count, stage, dt);
}
#endif

static void update_numbers(double *U, const double *start, const double *rate, double *sum, size_t count,
                           const struct solver_stage *stage, double dt)
{
#ifdef SOLVER_WIDE_PATHS
    if (solver_path() > 0) {
        update_wide(U, start, rate, sum, count, stage, dt);
        return;
    }
#endif
    update_entries(U, start, rate, sum, count, stage, dt);
}

/* The same of a field, for a piece of the particles. What has no rate of its own has the v of the stage's beginning,
 * field 0: that at the start of the step, or the one that is about to be updated. */
static void update_field(const struct solver_state *state, const struct solver_field *field,
                         const struct solver_stage *stage, double dt, struct solver_piece at)
{
    bool begins = stage->time == 0.0;
    size_t first = field->offset + at.begin * field->width;
    size_t of_rate = field->rate != NULL ? first : at.begin * field->width;
    size_t count = (at.end - at.begin) * field->width;
    if (state->in_single) {
        float *v = begins ? state->single.start : state->single.U;
        state->single.loops->update(state->single.U + first, state->single.start + first,
                                    (field->rate != NULL ? state->single.rate : v) + of_rate,
                                    state->single.sum != NULL ? state->single.sum + first : NULL, count, stage, dt);
    } else {
        double *v = begins ? state->start : state->U;
        update_numbers(state->U + first, state->start + first, (field->rate != NULL ? state->rate : v) + of_rate,
                       state->sum != NULL ? state->sum + first : NULL, count, stage, dt);
    }
}

/* What follows from the state of particles from `first` on. */
static void refresh_from(struct solver_run *run, size_t first)
{
    size_t count = run->cloud->count - first;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        run->scheme->refresh(run->system, first + at.begin, first + at.end);
    }
}

void solver_run_refresh(struct solver_run *run)
{
    if (run->cloud->symmetry != NULL) {
        solver_symmetry_reflect(run->cloud, &run->state);
    }
    refresh_from(run, 0);
}

/* The state of images, of which nothing is evolved, and what follows from it. */
static void reflect(struct solver_run *run)
{
    if (run->cloud->symmetry != NULL) {
        solver_symmetry_reflect(run->cloud, &run->state);
        refresh_from(run, solver_cloud_driven(run->cloud));
    }
}

/* The state and that at the start of the step change places. */
static void turn(struct solver_run *run)
{
    solver_state_turn(&run->state);
    if (run->scheme->bind != NULL) {
        run->scheme->bind(run->system);
    }
}

/* Whether more may break a particle after a step's last stage: the pressure's correction, a wall, a moved face. */
static bool breaks_later(const struct solver_run *run)
{
    return run->scene->incompressible.solver != SOLVER_PRESSURE_NONE || run->wall.count > 0 || run->faces.moved;
}

/* State of the next stage and what follows from it, piece by piece, while the piece is in cache. *whole: this is a
 * step's end, and no particle is broken. */
static bool update(struct solver_run *run, int s, double t, double dt, bool *whole, struct solver_error *error)
{
    struct solver_state *state = &run->state;
    const struct solver_stage *stage = &run->integrator->stage[s];
    bool look = s + 1 == run->integrator->stages && !breaks_later(run);
    size_t count = solver_cloud_driven(run->cloud);
    bool good = true;
    if (s == 0) {
        turn(run);
    }
#pragma omp parallel for schedule(static) reduction(&& : good)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        for (size_t f = state->field_count; f-- > 0;) { /* v is the first, and the rate of the last */
            if (state->field[f].evolved) {
                update_field(state, &state->field[f], stage, dt, at);
            }
        }
        run->scheme->refresh(run->system, at.begin, at.end);
        good = good && (!look || run->scheme->first_broken(run->system, at.begin, at.end) == at.end);
    }
    *whole = look && good;
    return solver_faces_constrain(&run->faces, &run->body, t, solver_state_v(state), error);
}

/* What the scheme changes of a stage's state in the light of all of it. */
static bool correct(struct solver_run *run, int s, double t, double dt, struct solver_error *error)
{
    return run->scheme->correct == NULL ||
           run->scheme->correct(run->system, &run->state, run->integrator, s, t, dt, error);
}

static double largest_step(const struct solver_run *run)
{
    return run->scheme->largest_step(run->system);
}

/* The state at the start of the step again: after a stage that failed, or a step that broke a particle. */
static void take_back(struct solver_run *run)
{
    turn(run);
    solver_run_refresh(run);
}

/* Puts the step before what broke down within it, and what to try behind. */
static void say_when(const struct solver_run *run, double dt, struct solver_error *error)
{
    if (error->code == SOLVER_BROKE_DOWN) {
        struct solver_error found = *error;
        (void)solver_fail(error, SOLVER_BROKE_DOWN, "step %zu, t = %.6g s: %s. Try %s", run->step + 1, run->time + dt,
                          found.text, run->scheme->advice);
    }
}

/* Work over a step [J]. */
struct work {
    double external, numerical; /* of the loads; taken by the scheme's dissipation, where the scene's balance asks */
};

/* All stages of a step. After a failure the state is that of the start. *whole as in update. */
static bool stages(struct solver_run *run, double dt, struct work *work, bool *whole, struct solver_error *error)
{
    const struct solver_integrator *integrator = run->integrator;
    *work = (struct work){.external = 0.0};
    for (int s = 0; s < integrator->stages; s++) {
        const struct solver_stage *stage = &integrator->stage[s];
        double next = s + 1 < integrator->stages ? integrator->stage[s + 1].time : 1.0;
        double power;
        bool known = evaluate(run, s, dt, &power, error);
        if (known && run->scene->balance) {
            work->numerical += stage->weight * dt * run->scheme->lost(run->system);
        }
        if (!known || !update(run, s, run->time + next * dt, dt, whole, error) ||
            !correct(run, s, run->time + next * dt, dt, error)) {
            if (known || s > 0) { /* else there is nothing to take back */
                take_back(run);
            }
            return false;
        }
        solver_wall_stop(&run->wall, &run->state, integrator, s);
        reflect(run);
        work->external += stage->weight * dt * power;
    }
    return true;
}

static bool step(struct solver_run *run, double dt, struct solver_error *error)
{
    double before = run->time;
    struct work work;
    bool whole = false;
    if (run->scheme->prepare != NULL && !run->scheme->prepare(run->system, dt, error)) {
        return false;
    }
    solver_wall_begin(&run->wall, &run->state, dt);
    if (run->wall.count > 0 && run->cloud->symmetry != NULL) {
        solver_symmetry_reflect(run->cloud, &run->state);
    }
    if (!stages(run, dt, &work, &whole, error)) {
        say_when(run, dt, error);
        return false;
    }
    run->time += dt;
    run->step++;
    if (whole || solver_run_check(run, error)) {
        run->external += work.external;
        run->numerical += work.numerical;
        solver_wall_end(&run->wall, &run->state);
        return true;
    }
    take_back(run);
    run->time = before;
    run->step--;
    return false;
}

/* A stable scheme never gains energy. Where all supply is known (no face is moved), ten times what was there and what
 * loads have put in cannot come from physics, nor from the mismatch between evolved F, H and J: the step is unstable.
 * A material with linear kinematics has no J <= 0 that would show it. */
static bool check_energy(const struct solver_run *run, struct solver_error *error)
{
    const struct solver_history *history = &run->history;
    const struct solver_totals *first = &history->totals[0];
    const struct solver_totals *last = &history->totals[history->count - 1];
    if (run->faces.moved) {
        return true;
    }
    /* over the first steps of a load that starts from nothing, the quadrature of its work is poor */
    bool loaded = run->faces.load_count > 0 || run->faces.force != NULL;
    if (loaded && run->step < 20) {
        return true;
    }
    double supply = first->kinetic + first->strain;
    for (size_t i = 0; i < history->count; i++) {
        supply = fmax(supply, first->kinetic + first->strain + fabs(history->totals[i].external));
    }
    double energy = last->kinetic + last->strain;
    if (energy <= 10.0 * supply || energy <= 0.0) {
        return true;
    }
    return solver_fail(
        error, SOLVER_BROKE_DOWN,
        "step %zu, t = %.6g s: kinetic and strain energy are %.3g J, and only %.3g J were ever put in: the "
        "run is unstable. Try %s (cfl is %g)",
        run->step, run->time, energy, supply, run->scheme->advice, run->scene->cfl);
}

bool solver_run_steps(struct solver_run *run, size_t steps, struct solver_error *error)
{
    double begun = solver_run_clock();
    omp_set_num_threads(run->threads);
    for (size_t i = 0; i < steps; i++) {
        if (!step(run, largest_step(run), error)) {
            return false;
        }
    }
    run->seconds += solver_run_clock() - begun;
    return true;
}

/* The first time after now at which a moved face is let go, or t_end. */
static double next_stop(const struct solver_run *run, double t_end)
{
    double stop = t_end;
    for (int face = 0; face < SOLVER_FACES; face++) {
        double until = run->scene->face_until[face];
        stop = until > run->time && until < stop ? until : stop;
    }
    return stop;
}

/* The row that the present time belongs to. */
static size_t history_row(const struct solver_run *run)
{
    return (size_t)(run->time / run->scene->t_end * run->scene->history);
}

bool solver_run_to(struct solver_run *run, double t_end, solver_progress *progress, void *context,
                   struct solver_error *error)
{
    double begun = solver_run_clock();
    size_t noted = history_row(run);
    bool ok = true;
    omp_set_num_threads(run->threads);
    if (run->history.count == 0) {
        ok = solver_run_note(run, error);
    }
    while (ok && run->time < t_end) {
        /* equal steps that end where a face is let go or at t_end, rather than a last step of any size */
        double stop = next_stop(run, t_end);
        double remaining = stop - run->time;
        double steps = ceil(remaining / largest_step(run) - 1e-9);
        bool last = steps <= 1.0;
        if (!isfinite(steps) || steps > 1e12) {
            return solver_fail(error, SOLVER_BROKE_DOWN,
                               "step %zu, t = %.6g s: the time step %.3g s is too small to reach t_end = %g s, which "
                               "would take more than 1e12 of them; take a larger cfl, a coarser n, a softer material "
                               "or a smaller t_end",
                               run->step, run->time, largest_step(run), t_end);
        }
        ok = step(run, last ? remaining : remaining / steps, error);
        if (ok && last) {
            run->time = stop;
        }
        last = last && stop == t_end;
        size_t row = history_row(run);
        if (ok && (last || row > noted)) {
            noted = row;
            ok = solver_run_note(run, error) && check_energy(run, error);
        }
        if (ok && progress != NULL && !progress(context, run->time, t_end, run->step)) {
            break;
        }
    }
    run->seconds += solver_run_clock() - begun;
    return ok;
}
