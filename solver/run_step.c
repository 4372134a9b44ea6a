/* A run in time: rates, stages, steps, and the checks that stop it. */
#include "solver/pieces.h"
#include "solver/run_internal.h"
#include "solver/symmetry.h"

#include <float.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

double solver_run_clock(void)
{
    struct timespec at;
    (void)clock_gettime(CLOCK_MONOTONIC, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

/* Squared speed [m^2/s^2] of particle a. */
static double square_of_speed(const struct solver_run *run, size_t a)
{
    struct solver_vectors v = solver_state_v(&run->state);
    double square = 0.0;
    for (size_t i = 0; i < (size_t)run->cloud->dim; i++) {
        square += solver_vectors_get(&v, a, i) * solver_vectors_get(&v, a, i);
    }
    return square;
}

/* As the loops do: what overflows when squared has grown beyond all bounds. */
static bool is_finite(const struct solver_run *run, size_t a)
{
    return isfinite(square_of_speed(run, a));
}

static size_t fastest_particle(const struct solver_run *run)
{
    size_t fastest = 0;
    for (size_t a = 1; a < run->cloud->count; a++) {
        fastest = square_of_speed(run, a) > square_of_speed(run, fastest) ? a : fastest;
    }
    return fastest;
}

enum { ADVICE = 160, PLACE = 120 };

static const char *place_of(const struct solver_run *run, size_t a, char text[PLACE])
{
    size_t dim = (size_t)run->cloud->dim;
    const double *X = run->cloud->X + a * dim;
    (void)snprintf(text, PLACE, "particle %zu at X = (%g, %g, %g) m", a, X[0], dim > 1 ? X[1] : 0.0,
                   dim > 2 ? X[2] : 0.0);
    return text;
}

/* What to try when a run breaks down; to evolve more only where a scene does not. */
static const char *advice(const struct solver_run *run, char text[ADVICE])
{
    bool more = run->scheme->stencil && run->scene->evolved != SOLVER_PFHJ;
    (void)snprintf(text, ADVICE, "%s%s", run->scheme->advice, more ? ", or evolved = \"pFHJ\"" : "");
    return text;
}

bool solver_run_check(struct solver_run *run, struct solver_error *error)
{
    size_t count = run->cloud->count;
    size_t broken = count;
    char text[ADVICE];
    char place[PLACE];
#pragma omp parallel for schedule(static) reduction(min : broken)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        size_t found = run->scheme->first_broken(run->system, at.begin, at.end);
        broken = found < at.end && found < broken ? found : broken;
    }
    if (broken == count) {
        return true;
    }
    return solver_fail(error, SOLVER_BROKE_DOWN, "step %zu, t = %.6g s: %s: %s. Try %s", run->step, run->time,
                       place_of(run, broken, place),
                       is_finite(run, broken) ? run->scheme->complaint(run->system, broken)
                                              : "linear momentum p is not finite",
                       advice(run, text));
}

static double largest_step(const struct solver_run *run)
{
    return run->fastest > 0.0 ? run->scheme->largest_step(run->system, run->fastest)
                              : solver_scheme_largest_step(run->scheme, run->system, run->cloud->count);
}

/* Puts the step before what broke down within it, and what to try behind. */
static void say_when(const struct solver_run *run, double dt, struct solver_error *error)
{
    if (error->code == SOLVER_BROKE_DOWN) {
        struct solver_error found = *error;
        char text[ADVICE];
        (void)solver_fail(error, SOLVER_BROKE_DOWN, "step %zu, t = %.6g s: %s. Try %s", run->step + 1, run->time + dt,
                          found.text, advice(run, text));
    }
}

/* By how much, at most, the root of the energy E grew within a step by faces that are moved [sqrt J]. Moved particles
 * of masses m feel forces f, whose power at their velocities v is at most sqrt(sum f^2 / m) sqrt(sum m v^2). With the
 * largest frequency w of the body sum f^2 / m is at most w^2 2 E, so that d sqrt(E) / dt <= w sqrt(K), K the kinetic
 * energy of moved particles; and w dt is below 4 where any of the integrators is stable. */
static double driven_within(const struct solver_run *run)
{
    return run->faces.moved
               ? 4.0 * sqrt(solver_faces_driven(&run->faces, &run->body, run->time, solver_state_v(&run->state)))
               : 0.0;
}

static bool step(struct solver_run *run, double dt, struct solver_error *error)
{
    double before = run->time;
    struct solver_work work;
    bool whole = false;
    if (run->scheme->prepare != NULL && !run->scheme->prepare(run->system, dt, error)) {
        return false;
    }
    solver_wall_begin(&run->wall, &run->state, dt);
    if (run->wall.count > 0 && run->cloud->symmetry != NULL) {
        solver_symmetry_reflect(run->cloud, &run->state);
    }
    if (!solver_run_stages(run, dt, &work, &whole, error)) {
        say_when(run, dt, error);
        return false;
    }
    run->time += dt;
    run->step++;
    if (whole || solver_run_check(run, error)) {
        run->external += work.external;
        run->numerical += work.numerical;
        run->driven += driven_within(run);
        solver_wall_end(&run->wall, &run->state);
        return true;
    }
    solver_run_take_back(run);
    run->time = before;
    run->step--;
    return false;
}

/* What there was at first and what loads put in at most [J]; of moved faces what they can have put in at most. */
static double supply_of(const struct solver_run *run)
{
    const struct solver_totals *first = &run->history.totals[0];
    double supply = first->kinetic + first->strain;
    for (size_t i = 0; i < run->history.count; i++) {
        supply = fmax(supply, first->kinetic + first->strain + fabs(run->history.totals[i].external));
    }
    double root = sqrt(fmax(supply, 0.0)) + run->driven;
    return run->faces.moved ? root * root : supply;
}

/* Round-off of the strain energy [J], which is a difference of terms as large as moduli: at rest it may be less than
 * none. Some dozens of operations. */
static double round_off_of_energy(const struct solver_run *run)
{
    double moduli = 0.0;
    for (size_t a = 0; a < run->cloud->count; a++) {
        const struct solver_material_constants *constants = &run->constants[a * run->body.stride];
        moduli += constants->rho * constants->cp * constants->cp * run->cloud->V[a];
    }
    return 64.0 * DBL_EPSILON * moduli;
}

/* A stable scheme never gains energy. Ten times what was there and what loads and moved faces have put in cannot come
 * from physics, nor from the mismatch between evolved F, H and J: the step is unstable. A material with linear
 * kinematics has no J <= 0 that would show it. The pressure of an incompressible body does any work at once. */
static bool check_energy(const struct solver_run *run, struct solver_error *error)
{
    const struct solver_history *history = &run->history;
    const struct solver_totals *last = &history->totals[history->count - 1];
    if (run->faces.moved && run->scene->incompressible.solver != SOLVER_PRESSURE_NONE) {
        return true;
    }
    /* over the first steps of a load that starts from nothing, the quadrature of its work is poor */
    bool loaded = run->faces.load_count > 0 || run->faces.force != NULL;
    if (loaded && run->step < 20) {
        return true;
    }
    double supply = supply_of(run);
    double energy = last->kinetic + last->strain;
    if (energy <= 10.0 * supply || energy <= 0.0) {
        return true;
    }
    if (energy <= round_off_of_energy(run)) {
        return true;
    }
    char text[ADVICE];
    char place[PLACE];
    size_t fastest = fastest_particle(run);
    return solver_fail(
        error, SOLVER_BROKE_DOWN,
        "step %zu, t = %.6g s: kinetic and strain energy are %.3g J, and %s %.3g J were ever put in: the "
        "run is unstable. Linear momentum p is that of %.3g m/s at %s. Try %s (cfl is %g)",
        run->step, run->time, energy, run->faces.moved ? "at most" : "only", supply,
        sqrt(square_of_speed(run, fastest)), place_of(run, fastest, place), advice(run, text), run->scene->cfl);
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
    if (!isgreaterequal(t_end, run->time)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "t_end: expected a time from now on, %.17g s, got %g s", run->time,
                           t_end);
    }
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
