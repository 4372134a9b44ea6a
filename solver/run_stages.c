/* The stages of a step, in waves of sweeps (wave.h). */
#include "solver/memory.h"
#include "solver/path.h"
#include "solver/pieces.h"
#include "solver/run_internal.h"
#include "solver/stencil_ranks.h"
#include "solver/symmetry.h"

#include <math.h>

/* --- where waves end --- */

/* Whether something acts on all rates at once before the update: loads, contact, a projection, a balance's sum. Of a
 * scheme without sweeps rates come all at once. */
static bool acts_on_rates(const struct solver_run *run)
{
    return run->faces.load_count > 0 || run->faces.force != NULL || run->contact.law != SOLVER_CONTACT_NONE ||
           run->projection.on || run->scene->balance || run->scheme->evaluate != NULL;
}

/* Whether more may change the state after a stage's update: the pressure's correction, a wall, a moved face, images. */
static bool acts_on_state(const struct solver_run *run)
{
    return run->scene->incompressible.solver != SOLVER_PRESSURE_NONE || run->wall.count > 0 || !run->faces.only_hold ||
           run->cloud->symmetry != NULL || run->scheme->evaluate != NULL;
}

int solver_run_wave(const struct solver_run *run, int first)
{
    int end = SOLVER_STAGE_SWEEPS * run->integrator->stages;
    bool ends = false;
    int last = first;
    for (; !ends && last < end; last++) {
        int sweep = last % SOLVER_STAGE_SWEEPS;
        ends = (sweep == SOLVER_SWEEP_RATES && run->acts_on_rates) ||
               (sweep == SOLVER_SWEEP_UPDATE && (run->acts_on_state || run->by_stages));
    }
    return last - first;
}

/* How far from a particle its farthest neighbour lies, in particles: on a lattice a plane. */
static size_t farthest(const struct solver_run *run)
{
    const struct solver_graph *graph = run->scheme->graph != NULL ? run->scheme->graph(run->system) : NULL;
    size_t most = 0;
    for (size_t a = 0; graph != NULL && a < run->cloud->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            most = b > a + most ? b - a : most;
        }
    }
    return most;
}

bool solver_run_parts(double body, double window, int stages)
{
    double last = fmin((double)solver_cache_bytes(3), SOLVER_WITHIN_REACH);
    double most = body <= last ? (double)solver_cache_bytes(2) : last * stages / 2.0;
    return last > 0.0 && window > most;
}

bool solver_run_parts_stages(const struct solver_run *run)
{
    double each = solver_state_bytes_per_particle(&run->state, true) +
                  run->scheme->geometry(run->system).bytes / (double)run->cloud->count;
    int planes = SOLVER_STAGE_SWEEPS * run->integrator->stages + 2; /* one for each sweep, and what is beside them */
    return solver_run_parts(each * (double)run->cloud->count, each * (double)farthest(run) * planes,
                            run->integrator->stages);
}

/* Particles of a piece of a wave. Where loops keep from one row what the next needs as well (stencil_ranks.h) they are
 * whole rows: with pieces of 256, {p,F,J} takes 1.2 times as long. Elsewhere more than 256 do, as waves then hold more.
 */
static size_t piece_of(const struct solver_run *run)
{
    size_t row = farthest(run);
    return run->cloud->dim == 2 && row > 0 && row <= SOLVER_RANK_MOST ? 512 / row * row : 256;
}

bool solver_run_make_waves(struct solver_run *run, bool by_stages, struct solver_error *error)
{
    struct solver_wave_graph neighbours = {NULL, NULL};
    if (run->scheme->graph != NULL) {
        const struct solver_graph *graph = run->scheme->graph(run->system);
        neighbours = (struct solver_wave_graph){graph->row, graph->neighbour};
    }
    run->acts_on_rates = acts_on_rates(run);
    run->acts_on_state = acts_on_state(run);
    run->by_stages = by_stages;
    size_t piece = piece_of(run);
    int sweeps;
    for (int at = 0; at < SOLVER_STAGE_SWEEPS * run->integrator->stages; at += sweeps) {
        sweeps = solver_run_wave(run, at);
        bool evaluated = run->scheme->evaluate != NULL && at % SOLVER_STAGE_SWEEPS == SOLVER_SWEEP_GRADIENTS;
        if (!evaluated && run->wave[sweeps].sweeps == 0 &&
            !solver_wave_create(&run->wave[sweeps], run->cloud->count, piece, neighbours, sweeps, run->threads,
                                error)) {
            return false;
        }
    }
    return true;
}

/* Whether more may break a particle after a step's last stage: the pressure's correction, a wall, a moved face. */
static bool breaks_later(const struct solver_run *run)
{
    return run->scene->incompressible.solver != SOLVER_PRESSURE_NONE || run->wall.count > 0 || run->faces.moved;
}

/* --- rates --- */

/* What acts on the rates of a stage, and the power of the loads. */
static bool act(struct solver_run *run, int s, double dt, double *power, struct solver_error *error)
{
    struct solver_state *state = &run->state;
    const struct solver_stage *stage = &run->integrator->stage[s];
    double t = run->time + stage->time * dt;
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

/* The same, and the work of a stage. */
static bool act_on_rates(struct solver_run *run, int s, double dt, struct solver_work *work, struct solver_error *error)
{
    double by = run->integrator->stage[s].weight * dt;
    double power;
    if (!act(run, s, dt, &power, error)) {
        return false;
    }
    work->external += by * power;
    work->numerical += run->scene->balance ? by * run->scheme->lost(run->system) : 0.0;
    return true;
}

/* --- update --- */

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

/* --- what follows from the state --- */

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
    run->fastest = 0.0;
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
    if (run->scheme->turn != NULL) {
        run->scheme->turn(run->system, &run->state);
    } else {
        solver_state_turn(&run->state);
    }
}

void solver_run_take_back(struct solver_run *run)
{
    turn(run);
    solver_run_refresh(run);
}

/* --- waves --- */

/* A wave on its way. */
struct sweeping {
    struct solver_run *run;
    int first; /* sweep of the step */
    double dt;
    bool turned; /* it has its first stage's update, and the state has been turned for that */
    bool look;   /* it ends the step, and nothing breaks a particle any more */
    bool good;   /* none was found broken */
    double fastest;
};

/* How the step leaves a piece. */
static void look_at(struct sweeping *wave, size_t begin, size_t end)
{
    const struct solver_run *run = wave->run;
    bool good = run->scheme->first_broken(run->system, begin, end) == end;
    double fastest = run->cloud->symmetry == NULL ? run->scheme->fastest(run->system, begin, end) : 0.0;
#pragma omp critical(solver_sweep)
    {
        wave->good = wave->good && good;
        wave->fastest = fmax(wave->fastest, fastest);
    }
}

/* That which a stage's update leads to. */
static double time_after(const struct solver_run *run, int s, double dt)
{
    const struct solver_integrator *integrator = run->integrator;
    return run->time + (s + 1 < integrator->stages ? integrator->stage[s + 1].time : 1.0) * dt;
}

/* State of the next stage and what follows from it. */
static void update(struct sweeping *wave, int s, size_t begin, size_t end)
{
    struct solver_run *run = wave->run;
    struct solver_state *state = &run->state;
    size_t driven = solver_cloud_driven(run->cloud);
    struct solver_piece at = {begin, end < driven ? end : driven};
    if (at.begin >= at.end) {
        return;
    }
    for (size_t f = state->field_count; f-- > 0;) { /* v is the first, and the rate of the last */
        if (state->field[f].evolved) {
            update_field(state, &state->field[f], &run->integrator->stage[s], wave->dt, at);
        }
    }
    if (!run->acts_on_state) {
        solver_faces_hold(&run->faces, solver_state_v(state), at.begin, at.end);
    }
    run->scheme->refresh(run->system, at.begin, at.end);
    if (wave->look && s + 1 == run->integrator->stages) {
        look_at(wave, at.begin, at.end);
    }
}

static void sweep(void *of, int at, size_t begin, size_t end)
{
    struct sweeping *wave = of;
    const struct solver_run *run = wave->run;
    int s = (wave->first + at) / SOLVER_STAGE_SWEEPS;
    switch ((wave->first + at) % SOLVER_STAGE_SWEEPS) {
    case SOLVER_SWEEP_GRADIENTS:
        run->scheme->gradients(run->system, wave->turned && s == 0, begin, end);
        break;
    case SOLVER_SWEEP_RATES:
        run->scheme->rates(run->system, wave->turned && s == 0, begin, end);
        break;
    default:
        update(wave, s, begin, end);
        break;
    }
}

/* That many sweeps of a step, from `first` on. *whole as in solver_run_stages. */
static bool go(struct solver_run *run, int first, int sweeps, double dt, bool *whole, struct solver_error *error)
{
    int updated =
        first + (SOLVER_STAGE_SWEEPS + SOLVER_SWEEP_UPDATE - first % SOLVER_STAGE_SWEEPS) % SOLVER_STAGE_SWEEPS;
    bool ends = first + sweeps == SOLVER_STAGE_SWEEPS * run->integrator->stages;
    struct sweeping wave = {.run = run,
                            .first = first,
                            .dt = dt,
                            .turned = updated == SOLVER_SWEEP_UPDATE && updated < first + sweeps,
                            .look = ends && !breaks_later(run),
                            .good = true};
    if (run->scheme->evaluate != NULL && first % SOLVER_STAGE_SWEEPS == SOLVER_SWEEP_GRADIENTS) {
        double t = run->time + run->integrator->stage[first / SOLVER_STAGE_SWEEPS].time * dt;
        return run->scheme->evaluate(run->system, t, dt, error);
    }
    if (wave.turned) {
        turn(run);
    }
    solver_wave_run(&run->wave[sweeps], sweep, &wave);
    *whole = wave.look && wave.good;
    run->fastest = *whole ? wave.fastest : 0.0;
    return true;
}

/* What acts on the state after a stage's update: faces, what the scheme changes in the light of all of it, a wall. */
static bool act_on_state(struct solver_run *run, int s, double dt, struct solver_error *error)
{
    double t = time_after(run, s, dt);
    if (!solver_faces_constrain(&run->faces, &run->body, t, solver_state_v(&run->state), error) ||
        (run->scheme->correct != NULL &&
         !run->scheme->correct(run->system, &run->state, run->integrator, s, t, dt, error))) {
        return false;
    }
    solver_wall_stop(&run->wall, &run->state, run->integrator, s);
    reflect(run);
    return true;
}

bool solver_run_stages(struct solver_run *run, double dt, struct solver_work *work, bool *whole,
                       struct solver_error *error)
{
    int sweeps;
    *work = (struct solver_work){.external = 0.0};
    for (int at = 0; at < SOLVER_STAGE_SWEEPS * run->integrator->stages; at += sweeps) {
        sweeps = solver_run_wave(run, at);
        int last = at + sweeps - 1;
        int s = last / SOLVER_STAGE_SWEEPS;
        bool rates = last % SOLVER_STAGE_SWEEPS == SOLVER_SWEEP_RATES;
        if (!go(run, at, sweeps, dt, whole, error) ||
            (rates && run->acts_on_rates && !act_on_rates(run, s, dt, work, error)) ||
            (!rates && run->acts_on_state && !act_on_state(run, s, dt, error))) {
            if (last >= SOLVER_SWEEP_UPDATE) { /* else there is nothing to take back */
                solver_run_take_back(run);
            }
            return false;
        }
    }
    return true;
}
