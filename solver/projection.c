#include "solver/projection.h"

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
    SUMS = (SPIN + 10) / 8 * 8
};

/* How the sums of a stage are taken. */
struct view {
    const struct solver_projection *projection;
    const struct solver_state *state;
    const struct solver_stage *stage;
    bool ends; /* positions and velocities are those of the end of the step, which this stage's rates complete */
    double dt;
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
                      : body->cloud->body != NULL ? "one body's would be kept by forces on the others"
                      : body->cloud->wall_count > 0
                          ? "particles of walls are not of the body; expected lattice = \"nodes\""
                          : NULL;
    if (why != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: angular_momentum: expected \"free\", got \"projected\", and %s", scene->path, why);
    }
    projection->body = body;
    projection->V = V;
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

/* Entry i of an evolved vector field at the end of the step, but for what this stage's rate `known` gives it. */
static double at_end(const struct view *view, const double *field, size_t i, double known)
{
    const struct solver_state *state = view->state;
    const struct solver_stage *stage = view->stage;
    size_t at = (size_t)(field - state->U) + i;
    double start = stage->time == 0.0 ? field[i] : state->start[at]; /* not there yet in the first stage */
    double sum = stage->sum != 0.0 ? stage->sum * state->sum[at] : 0.0;
    return start + stage->keep * (field[i] - start) + view->dt * (stage->rate * known + sum);
}

/* Arm of particle a from the centre, and w. */
static void look(const struct view *view, size_t a, double arm[3], double w[3])
{
    const struct solver_state *state = view->state;
    size_t dim = (size_t)view->projection->body->cloud->dim;
    arm[2] = w[2] = 0.0;
    for (size_t i = 0; i < dim; i++) {
        size_t at = a * state->lanes + i;
        w[i] = view->ends ? at_end(view, state->v, at, 0.0) : state->v[at];
        arm[i] = (view->ends ? at_end(view, state->x, at, state->v[at]) : state->x[at]) - view->projection->centre[i];
    }
}

static void add_particle(const struct view *view, size_t a, double sum[SUMS])
{
    const struct solver_state *state = view->state;
    double V = view->projection->V[a];
    double m = V * density(view->projection, a);
    double y[3];
    double w[3];
    double f[3] = {0};
    double moment[3];
    double spin[3];
    look(view, a, y, w);
    for (size_t i = 0; i < (size_t)view->projection->body->cloud->dim; i++) {
        f[i] = state->v_rate[a * state->lanes + i];
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

/* Sums in one order, whatever the threads: within pieces, then piece by piece. */
static void sum_up(const struct view *view, double sum[SUMS])
{
    double *partial = view->projection->partial;
    size_t count = view->state->count;
    memset(sum, 0, SUMS * sizeof *sum);
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        memset(partial + piece * SUMS, 0, SUMS * sizeof *partial);
        for (size_t a = at.begin; a < at.end; a++) {
            add_particle(view, a, partial + piece * SUMS);
        }
    }
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        for (int i = 0; i < SUMS; i++) {
            sum[i] += partial[piece * SUMS + (size_t)i];
        }
    }
}

/* Angular momentum about the origin of the present state, the step's first; the centre moves to where the body is. */
static void begin(struct solver_projection *projection, const struct view *view, double sum[SUMS])
{
    double shift[3];
    double carried[3];
    sum_up(view, sum);
    for (int i = 0; i < 3; i++) {
        shift[i] = sum[FIRST + i] / sum[VOLUME];
    }
    cross(projection->centre, sum + MOMENTUM, carried);
    for (int i = 0; i < 3; i++) {
        projection->target[i] = sum[SPIN + i] + carried[i];
        projection->centre[i] += shift[i];
    }
}

void solver_projection_note(struct solver_projection *projection, const struct solver_state *state,
                            const struct solver_stage *stage)
{
    struct view view = {.projection = projection, .state = state, .stage = stage};
    double sum[SUMS];
    if (stage->time == 0.0) {
        begin(projection, &view, sum);
    }
    if (projection->loaded) {
        sum_up(&view, sum);
        memcpy(projection->force, sum + FORCE, sizeof projection->force);
        memcpy(projection->moment, sum + MOMENT, sizeof projection->moment);
    }
}

/* What the loads have just added: their resultant and their moment about the centre. */
static void measure_loads(const struct solver_projection *projection, const struct view *view, double force[3],
                          double moment[3])
{
    double sum[SUMS];
    memset(force, 0, 3 * sizeof *force);
    memset(moment, 0, 3 * sizeof *moment);
    if (projection->loaded) {
        sum_up(view, sum);
        for (int i = 0; i < 3; i++) {
            force[i] = sum[FORCE + i] - projection->force[i];
            moment[i] = sum[MOMENT + i] - projection->moment[i];
        }
    }
}

/* The moment about the centre that the last stage's rates must have: with it sum m x^{n+1} x v^{n+1} is the target. */
static void remaining(const struct solver_projection *projection, const struct view *view, const double sum[SUMS],
                      const double force[3], double moment[3])
{
    double impulse = view->dt * view->stage->rate;
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

static void correct(const struct view *view, const double middle[3], const double linear[3], const double angular[3])
{
    const struct solver_state *state = view->state;
    size_t count = state->count;
    size_t dim = (size_t)view->projection->body->cloud->dim;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        for (size_t a = at.begin; a < at.end; a++) {
            double y[3];
            double w[3];
            double turn[3];
            double per_rho = 1.0 / density(view->projection, a);
            look(view, a, y, w);
            for (int i = 0; i < 3; i++) {
                y[i] -= middle[i];
            }
            cross(angular, y, turn);
            for (size_t i = 0; i < dim; i++) {
                state->v_rate[a * state->lanes + i] += per_rho * (linear[i] + turn[i]);
            }
        }
    }
}

bool solver_projection_act(struct solver_projection *projection, const struct solver_state *state,
                           const struct solver_stage *stage, bool last, double dt, struct solver_error *error)
{
    struct view view = {.projection = projection, .state = state, .stage = stage, .dt = dt};
    double sum[SUMS];
    double force[3];
    double moment[3];
    double carried[3];
    double middle[3];
    double linear[3];
    double angular[3];
    bool finite = true;
    measure_loads(projection, &view, force, moment);
    cross(projection->centre, force, carried);
    for (int i = 0; i < 3; i++) {
        projection->target[i] += stage->weight * dt * (moment[i] + carried[i]);
    }
    view.ends = last && !projection->held;
    sum_up(&view, sum);
    for (int i = 0; i < SUMS; i++) {
        finite = finite && isfinite(sum[i]);
    }
    if (!finite) {
        return true; /* a particle is broken: the check of the step says which */
    }
    if (view.ends) {
        remaining(projection, &view, sum, force, moment);
    }
    if (!multipliers((size_t)projection->body->cloud->dim, sum, force, moment, middle, linear, angular)) {
        return solver_fail(error, SOLVER_BROKE_DOWN, "angular_momentum: all particles lie on one line");
    }
    correct(&view, middle, linear, angular);
    return true;
}
