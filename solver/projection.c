#include "solver/projection.h"

#include "solver/keep.h"
#include "solver/memory.h"
#include "solver/pieces.h"
#include "solver/small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sums over particles, with y the arm from the centre and f the force per unit volume. */
enum {
    VOLUME,                /* V */
    FIRST,                 /* V y */
    SECOND = FIRST + 3,    /* V y (x) y: xx, yy, zz, yz, zx, xy */
    FORCE = SECOND + 6,    /* V f */
    MOMENT = FORCE + 3,    /* V y x f */
    MOMENTUM = MOMENT + 3, /* m w, w the velocity at the end of the step but for the last stage's rate */
    SPIN = MOMENTUM + 3,   /* m y x w */
    SUMS = SPIN + 3
};

/* How the sums of a stage are taken: of the state now or, in a stage that `ends` the step, of that at its end but for
 * what this stage's rates add to the velocity: start + keep (now - start) + rate v + sum S, as integrator.h has it. */
struct view {
    const struct solver_projection *projection;
    const struct solver_state *state;
    bool ends;
    double keep, rate, sum; /* the last two times the step */
    const double *x, *v;    /* now */
    const double *x_start, *v_start;
    const double *x_sum, *v_sum;
};

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

bool solver_projection_create(const struct solver_body *body, const struct solver_faces *faces, const double *V,
                              struct solver_projection *projection, struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_scheme *scheme = solver_scheme_find(scene->scheme);
    const struct solver_material_model *model = solver_material_find(scene->material_model);
    *projection = (struct solver_projection){.on = strcmp(scene->angular_momentum, "projected") == 0};
    if (!projection->on) {
        return true;
    }
    const char *why = scene->dim == 1                                    ? "a line has none"
                      : scheme == NULL || scheme->claims.angular == NULL ? "the scheme does not know it"
                      : model == NULL || model->in[scene->dim - 1]->linear
                          ? "a material with linear kinematics has forces where particles were, not where they are"
                      : body->cloud->body != NULL     ? "one body's would be kept by forces on the others"
                      : body->cloud->symmetry != NULL ? "planes of symmetry hold the body"
                      : body->cloud->wall_count > 0
                          ? "particles of walls are not of the body; expected lattice = \"nodes\""
                          : NULL;
    if (why != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: angular_momentum: expected \"free\", got \"projected\", and %s", scene->path, why);
    }
    projection->body = body;
    projection->V = V;
    _Static_assert((int)SUMS == (int)SOLVER_PROJECTION_SUMS, "room for all sums");
    projection->held = faces->constraint_count > 0;
    projection->loaded = faces->load_count > 0 || faces->force != NULL;
    return solver_alloc((void **)&projection->partial, solver_pieces(body->cloud->count) * SUMS, sizeof(double),
                        "sums of moments", error);
}

void solver_projection_free(struct solver_projection *projection)
{
    free(projection->partial);
    *projection = (struct solver_projection){.on = false};
}

static double density(const struct solver_projection *projection, size_t a)
{
    return projection->body->constants[a * projection->body->stride].rho;
}

static struct view view_now(const struct solver_projection *projection, const struct solver_state *state)
{
    const double *x = state->x;
    const double *v = state->v;
    return (struct view){
        .projection = projection, .state = state, .x = x, .v = v, .x_start = x, .v_start = v, .x_sum = x, .v_sum = v};
}

static struct view view_of_end(const struct solver_projection *projection, const struct solver_state *state,
                               const struct solver_stage *stage, double dt)
{
    struct view view = view_now(projection, state);
    size_t x = (size_t)(state->x - state->U);
    size_t v = (size_t)(state->v - state->U);
    view.ends = true;
    view.keep = stage->keep;
    view.rate = stage->rate * dt;
    if (stage->time > 0.0) { /* else the start is not there yet: it is the state now */
        view.x_start = state->start + x;
        view.v_start = state->start + v;
    }
    if (state->sum != NULL) {
        view.sum = stage->sum * dt;
        view.x_sum = state->sum + x;
        view.v_sum = state->sum + v;
    }
    return view;
}

/* Arm of particle a from the centre, and w. */
static inline void look(const struct view *view, size_t dim, size_t a, double arm[3], double w[3])
{
    arm[2] = w[2] = 0.0;
    for (size_t i = 0; i < dim; i++) {
        size_t at = a * view->state->lanes + i;
        double x = view->x_start[at] + view->keep * (view->x[at] - view->x_start[at]);
        double v = view->v_start[at] + view->keep * (view->v[at] - view->v_start[at]);
        arm[i] = x + (view->rate * view->v[at] + view->sum * view->x_sum[at]) - view->projection->centre[i];
        w[i] = v + view->sum * view->v_sum[at];
    }
}

static inline __attribute__((always_inline)) void add_particles(const struct view *view, size_t dim,
                                                                struct solver_piece piece, double *partial)
{
    double sum[SUMS] = {0};
    for (size_t a = piece.begin; a < piece.end; a++) {
        double V = view->projection->V[a];
        double m = V * density(view->projection, a);
        double y[3];
        double w[3];
        double f[3] = {0};
        double moment[3];
        double spin[3];
        look(view, dim, a, y, w);
        for (size_t i = 0; i < dim; i++) {
            f[i] = view->state->v_rate[a * view->state->lanes + i];
        }
        cross(y, f, moment);
        cross(y, w, spin);
        sum[VOLUME] += V;
        for (int i = 0; i < 3; i++) {
            sum[FIRST + i] += V * y[i];
            sum[SECOND + i] += V * y[i] * y[i];
            sum[SECOND + 3 + i] += V * y[(i + 1) % 3] * y[(i + 2) % 3];
            sum[FORCE + i] += m * f[i];
            sum[MOMENT + i] += m * moment[i];
            sum[MOMENTUM + i] += m * w[i];
            sum[SPIN + i] += m * spin[i];
        }
    }
    memcpy(partial, sum, sizeof sum);
}

/* Sums in one order, whatever the threads: within pieces, then piece by piece. */
static void sum_up(const struct view *view, double sum[SUMS])
{
    double *partial = view->projection->partial;
    size_t count = view->state->count;
    memset(sum, 0, SUMS * sizeof *sum);
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        if (view->projection->body->cloud->dim == 2) {
            add_particles(view, 2, at, partial + piece * SUMS);
        } else {
            add_particles(view, 3, at, partial + piece * SUMS);
        }
    }
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        for (int i = 0; i < SUMS; i++) {
            sum[i] += partial[piece * SUMS + (size_t)i];
        }
    }
}

void solver_projection_note(struct solver_projection *projection, const struct solver_state *state,
                            const struct solver_stage *stage)
{
    struct view view = view_now(projection, state);
    double *sum = projection->noted;
    double carried[3];
    if (stage->time > 0.0 && !projection->loaded) {
        return;
    }
    sum_up(&view, sum);
    if (stage->time == 0.0) {
        cross(projection->centre, sum + MOMENTUM, carried);
        for (int i = 0; i < 3; i++) {
            projection->target[i] = sum[SPIN + i] + carried[i];
        }
    }
}

/* What the loads have just added: their resultant and their moment about the centre. */
static void measure_loads(const struct solver_projection *projection, const double sum[SUMS], double force[3],
                          double moment[3])
{
    for (int i = 0; i < 3; i++) {
        force[i] = projection->loaded ? sum[FORCE + i] - projection->noted[FORCE + i] : 0.0;
        moment[i] = projection->loaded ? sum[MOMENT + i] - projection->noted[MOMENT + i] : 0.0;
    }
}

/* The moment about the centre that the last stage's rates must have: with it sum m x^{n+1} x v^{n+1} is the target. */
static void remaining(const struct solver_projection *projection, const struct view *view, const double sum[SUMS],
                      const double force[3], double moment[3])
{
    double impulse = view->rate;
    double momentum[3];
    double carried[3];
    for (int i = 0; i < 3; i++) {
        momentum[i] = sum[MOMENTUM + i] + impulse * force[i];
    }
    cross(projection->centre, momentum, carried);
    for (int i = 0; i < 3; i++) {
        moment[i] = (projection->target[i] - carried[i] - sum[SPIN + i]) / impulse;
    }
}

/* lambda of (B.3), (B.4): f + linear + angular x (y - middle) has this force and moment. False if nothing turns it. */
static bool multipliers(size_t dim, const double sum[SUMS], const double force[3], const double moment[3],
                        double middle[3], double linear[3], double angular[3])
{
    double inertia[4][4] = {{0}};
    double missing[4] = {0};
    double carried[3];
    double spread[6];
    for (int i = 0; i < 3; i++) {
        middle[i] = sum[FIRST + i] / sum[VOLUME];
        linear[i] = (force[i] - sum[FORCE + i]) / sum[VOLUME];
    }
    for (int i = 0; i < 3; i++) {
        spread[i] = sum[SECOND + i] - sum[FIRST + i] * middle[i];
        spread[3 + i] = sum[SECOND + 3 + i] - sum[FIRST + (i + 1) % 3] * middle[(i + 2) % 3];
        carried[i] = force[i] - sum[FORCE + i];
    }
    cross(middle, carried, angular);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int k = (i + 2) % 3;
        missing[i] = moment[i] - sum[MOMENT + i] - angular[i];
        inertia[i][i] = spread[j] + spread[k];
        inertia[i][j] = inertia[j][i] = -spread[3 + k];
    }
    if (dim == 2) {
        angular[0] = angular[1] = 0.0;
        angular[2] = missing[2] / inertia[2][2];
        return inertia[2][2] > 0.0;
    }
    if (!solver_small_solve(3, inertia, missing)) {
        return false;
    }
    memcpy(angular, missing, 3 * sizeof *angular);
    return true;
}

static inline __attribute__((always_inline)) void correct_particles(const struct view *view, size_t dim,
                                                                    struct solver_piece piece, const double middle[3],
                                                                    const double linear[3], const double angular[3])
{
    double *v_rate = view->state->v_rate;
    for (size_t a = piece.begin; a < piece.end; a++) {
        double y[3];
        double w[3];
        double turn[3];
        double per_rho = 1.0 / density(view->projection, a);
        look(view, dim, a, y, w);
        for (int i = 0; i < 3; i++) {
            y[i] -= middle[i];
        }
        cross(angular, y, turn);
        for (size_t i = 0; i < dim; i++) {
            v_rate[a * view->state->lanes + i] += per_rho * (linear[i] + turn[i]);
        }
    }
}

static void correct(const struct view *view, const double middle[3], const double linear[3], const double angular[3])
{
    size_t count = view->state->count;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        if (view->projection->body->cloud->dim == 2) {
            correct_particles(view, 2, at, middle, linear, angular);
        } else {
            correct_particles(view, 3, at, middle, linear, angular);
        }
    }
}

/* The sums that the stage is corrected by, and those of the loads. */
static struct view look_at_stage(struct solver_projection *projection, const struct solver_state *state,
                                 const struct solver_stage *stage, bool ends, double dt, double sum[SUMS],
                                 double force[3], double moment[3])
{
    struct view view = view_now(projection, state);
    if (projection->loaded) {
        sum_up(&view, sum);
    } else {
        memcpy(sum, projection->noted, SUMS * sizeof *sum); /* of this stage if it is the first */
    }
    measure_loads(projection, sum, force, moment);
    if (ends) {
        view = view_of_end(projection, state, stage, dt);
    }
    if (ends || (!projection->loaded && stage->time > 0.0)) {
        sum_up(&view, sum);
    }
    return view;
}

bool solver_projection_act(struct solver_projection *projection, const struct solver_state *state,
                           const struct solver_stage *stage, bool last, double dt, struct solver_error *error)
{
    double sum[SUMS];
    double force[3];
    double moment[3];
    double carried[3];
    double middle[3];
    double linear[3];
    double angular[3];
    bool finite = true;
    bool ends = last && !projection->held;
    struct view view = look_at_stage(projection, state, stage, ends, dt, sum, force, moment);
    for (int i = 0; i < SUMS; i++) {
        finite = finite && isfinite(sum[i]);
    }
    if (!finite) {
        return true; /* a particle is broken: the check of the step says which */
    }
    cross(projection->centre, force, carried);
    for (int i = 0; i < 3; i++) {
        projection->target[i] += stage->weight * dt * (moment[i] + carried[i]);
    }
    if (ends) {
        remaining(projection, &view, sum, force, moment);
    }
    if (!multipliers((size_t)projection->body->cloud->dim, sum, force, moment, middle, linear, angular)) {
        return solver_fail(error, SOLVER_BROKE_DOWN, "angular_momentum: all particles lie on one line");
    }
    correct(&view, middle, linear, angular);
    for (int i = 0; last && i < 3; i++) {
        projection->centre[i] += middle[i];
    }
    return true;
}

bool solver_projection_keep(struct solver_projection *projection, struct solver_keeper *keeper,
                            struct solver_error *error)
{
    return !projection->on ||
           solver_keep(keeper, "centre of moments", projection->centre, sizeof projection->centre, 1, error);
}

void solver_projection_arrays(const struct solver_projection *projection, struct solver_cost_arrays *arrays)
{
    if (projection->on) {
        solver_cost_array(arrays, "projection", "sums of pieces", projection->partial,
                          solver_pieces(projection->body->cloud->count) * SUMS, sizeof(double));
    }
}

void solver_projection_terms(const struct solver_projection *projection, int stages, struct solver_cost_terms *terms)
{
    if (!projection->on) {
        return;
    }
    double dim = projection->body->cloud->dim;
    double look = 13.0 * dim;
    double sum = look + 1.0 + 2.0 * 9.0 + 16.0 * 3.0 + 1.0; /* mass, two crosses, three axes, volume */
    double correct = look + 1.0 + 3.0 + 9.0 + 3.0 * dim;
    double ends = projection->held ? 0.0 : 1.0;
    double sums = projection->loaded ? 2.0 * stages + ends : stages + (stages == 1 ? ends : 0.0);
    double particles = (double)projection->body->cloud->count;
    double pieces = (double)solver_pieces(projection->body->cloud->count) * SUMS;
    solver_cost_once(terms, "angular momentum", sums * (particles * sum + pieces) + stages * particles * correct);
}
