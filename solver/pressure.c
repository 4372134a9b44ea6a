/* The pressure of an incompressible body: what it needs, and the corrector of each stage. */
#include "solver/pressure.h"

#include "solver/faces.h"
#include "solver/keep.h"
#include "solver/memory.h"
#include "solver/pieces.h"
#include "solver/pressure_solvers.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const char *why_not(const struct solver_body *body)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_rigid_wall *wall = &scene->rigid_wall;
    return scene->evolved == SOLVER_PF ? "the pressure stands in place of J; take evolved = \"pFJ\" or \"pFHJ\""
           : strcmp(scene->material_model, "neo-hookean") != 0 && strcmp(scene->material_model, "linear-elastic") != 0
               ? "the material's energy is not one of shape and one of volume; take material.model = \"neo-hookean\" "
                 "or \"linear-elastic\""
           : body->stride != 0 ? "there is one bulk modulus in a body; take no material.at"
           : strcmp(scene->volume_flux, "pressure") != 0
               ? "only the jump of the pressure is symmetric; take volume_flux = \"pressure\""
           : strcmp(scene->reconstruction, "least-squares") == 0 || strcmp(scene->reconstruction, "lattice") == 0
               ? "the gradient must be the adjoint of the divergence; take reconstruction = \"stencil\" or \"none\""
           : body->cloud->symmetry != NULL
               ? "images of particles have no pressure of their own; take the whole body, without domain.symmetry"
           : body->cloud->wall_count > 0 ? "particles of walls have no pressure; take lattice = \"nodes\""
           : body->cloud->body != NULL || scene->contact_law != SOLVER_CONTACT_NONE
               ? "contact changes the velocities that the pressure has balanced; take one body, and no contact"
           : wall->normal[0] != 0.0 || wall->normal[1] != 0.0 || wall->normal[2] != 0.0
               ? "the wall changes the velocities that the pressure has balanced; take no rigid_wall"
               : NULL;
}

static void set_constants(struct solver_pressure *of)
{
    const struct solver_scene *scene = of->body->scene;
    const struct solver_incompressible *asked = &scene->incompressible;
    struct solver_material_constants *constants = &of->constants;
    *constants = of->body->constants[0];
    constants->kappa = asked->modulus * constants->mu;
    constants->lambda = constants->kappa - 2.0 / 3.0 * constants->mu;
    constants->cp = sqrt((constants->kappa + 4.0 / 3.0 * constants->mu) / constants->rho);
    constants->zp = constants->rho * constants->cp;
    of->compliance = 3.0 * (1.0 - 2.0 * scene->nu) / scene->E;
    of->dissipation = asked->dissipation;
    of->restore = asked->restore;
    of->gamma = asked->gamma * constants->kappa;
    of->eta = asked->alpha / constants->rho;
}

/* An array of doubles; of none where its size is 0. */
struct row {
    const char *name;
    size_t offset, size;
};
enum { ROWS = 18 };

static void list(const struct solver_pressure *of, struct row row[ROWS])
{
    size_t count = of->stencil->count;
    size_t vectors = count * of->loops->lanes;
    size_t of_slopes = of->work->reconstruct ? vectors : 0;
    bool pseudo = of->body->scene->incompressible.solver == SOLVER_PRESSURE_PSEUDO_TIME;
#define AT(member) offsetof(struct solver_pressure, member)
    const struct row rows[ROWS] = {
        {"of the stresses", AT(p), count},
        {"increments of stages", AT(increment), (size_t)SOLVER_STAGES * count},
        {"reference", AT(reference), of->compliance > 0.0 ? count : 0},
        {"stray volumes", AT(stray), of->restore > 0.0 ? count : 0},
        {"weights of jumps", AT(weight), of->stencil->pairs},
        {"mobilities", AT(mobility), vectors},
        {"accelerations", AT(acceleration), vectors},
        {"slopes", AT(slope), of_slopes},
        {"moments of jumps", AT(moment), of_slopes},
        {"residual", AT(residual), count},
        {"of the residual", AT(total), count},
        {"direction", AT(direction), count},
        {"image of the direction", AT(image), count},
        {"diagonal", AT(diagonal), count},
        {"predicted velocities", AT(predicted), vectors},
        {"velocities before", AT(past_v), pseudo ? vectors : 0},
        {"increments before", AT(past_p), pseudo ? count : 0},
        {"sums of pieces", AT(partial), solver_pieces(count)},
    };
#undef AT
    memcpy(row, rows, sizeof rows);
}

static double **array_at(struct solver_pressure *of, const struct row *row)
{
    return (double **)((char *)of + row->offset);
}

static bool reserve(struct solver_pressure *of, struct solver_error *error)
{
    struct row row[ROWS];
    list(of, row);
    for (size_t i = 0; i < ROWS; i++) {
        if (row[i].size > 0 &&
            !solver_alloc((void **)array_at(of, &row[i]), row[i].size, sizeof(double), "pressure", error)) {
            return false;
        }
        of->doubles += row[i].size;
    }
    return true;
}

void solver_pressure_arrays(const struct solver_pressure *of, struct solver_cost_arrays *arrays)
{
    static const char group[] = "pressure";
    struct row row[ROWS];
    if (of == NULL) {
        return;
    }
    list(of, row);
    for (size_t i = 0; i < ROWS; i++) {
        solver_cost_bytes(arrays, group, row[i].name,
                          row[i].size > 0 ? solver_alloc_bytes(row[i].size, sizeof(double)) : 0);
    }
    solver_cost_array(arrays, group, "itself", of, 1, sizeof *of);
}

void solver_pressure_terms(const struct solver_pressure *of, struct solver_cost_terms *terms)
{
    if (of != NULL) {
        of->loops->terms(of, of->solved > 0 ? (double)of->iterations / (double)of->solved : 0.0, terms);
    }
}

/* The body's volume, and the largest diagonal of the Laplacian. */
static void measure(struct solver_pressure *of)
{
    const struct solver_stencil *stencil = of->stencil;
    const double *X = of->body->cloud->X;
    size_t dim = (size_t)stencil->dim;
    for (size_t a = 0; a < stencil->count; a++) {
        double sum = 0.0;
        size_t shift = solver_stencil_shift(stencil, a);
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            double square = 0.0;
            for (size_t i = 0; i < dim; i++) {
                double d = X[stencil->graph.neighbour[ab] * dim + i] - X[a * dim + i];
                square += d * d;
            }
            sum += solver_stencil_C(stencil, ab + shift)[dim] / sqrt(square);
        }
        of->volume += stencil->V[a];
        of->laplacian = fmax(of->laplacian, sum / stencil->V[a]);
    }
}

bool solver_pressure_create(const struct solver_body *body, const struct solver_stencil *stencil,
                            const struct solver_upwind *work, struct solver_pressure **pressure,
                            struct solver_error *error)
{
    static const struct solver_pressure_loops *const loops[][3] = SOLVER_LOOPS(solver_pressure);
    struct solver_pressure *of = NULL;
    *pressure = NULL;
    if (body->scene->incompressible.solver == SOLVER_PRESSURE_NONE) {
        return true;
    }
    const char *why = why_not(body);
    if (why != NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: incompressible.solver: %s", body->scene->path, why);
    }
    if (!solver_alloc((void **)&of, 1, sizeof *of, "pressure", error)) {
        return false;
    }
    *pressure = of; /* the caller's to free, whatever follows */
    of->body = body;
    of->stencil = stencil;
    of->work = work;
    of->loops = loops[solver_path()][body->cloud->dim - 1];
    set_constants(of);
    measure(of);
    return reserve(of, error);
}

void solver_pressure_free(struct solver_pressure *of)
{
    if (of == NULL) {
        return;
    }
    struct row row[ROWS];
    list(of, row);
    for (size_t i = 0; i < ROWS; i++) {
        free(*array_at(of, &row[i]));
    }
    free(of);
}

void solver_pressure_start(const struct solver_pressure *of)
{
    double *J = of->work->J;
    for (size_t a = 0; a < of->stencil->count; a++) {
        double p = of->compliance > 0.0 ? (J[a] - 1.0) / of->compliance : 0.0;
        J[a] = 1.0 + p / of->constants.kappa;
    }
}

double solver_pressure_energy(const struct solver_pressure *of, size_t a)
{
    double p = of->constants.kappa * (of->work->J[a] - 1.0);
    return 0.5 * of->compliance * p * p;
}

void solver_pressure_begin(const struct solver_pressure *of)
{
    for (size_t a = 0; a < of->stencil->count; a++) {
        of->p[a] = of->constants.kappa * (of->work->J[a] - 1.0);
    }
}

/* Where the velocity is free at time t, and whether that along the normal is anywhere on the surface. */
static void free_axes(struct solver_pressure *of, double t)
{
    const struct solver_scene *scene = of->body->scene;
    const struct solver_faces *faces = of->body->faces;
    const struct solver_stencil *stencil = of->stencil;
    size_t dim = (size_t)stencil->dim;
    size_t lanes = of->loops->lanes;
    for (size_t a = 0; a < stencil->count; a++) {
        for (size_t i = 0; i < dim; i++) {
            of->mobility[a * lanes + i] = 0.5 / (of->constants.rho * stencil->V[a]);
        }
    }
    for (size_t c = 0; c < faces->constraint_count; c++) {
        const struct solver_constraint *constraint = &faces->constraint[c];
        for (size_t i = 0; i < dim; i++) {
            if (solver_held_at(&constraint->axis[i], t)) {
                of->mobility[constraint->particle * lanes + i] = 0.0;
            }
        }
    }
    of->sealed = of->compliance == 0.0;
    for (size_t i = 0; i < stencil->face_point_count; i++) {
        enum solver_face_kind kind = scene->face[stencil->face_point[i].face];
        bool moved = kind == SOLVER_MOTION || kind == SOLVER_ROLLER;
        bool let_go = moved && t > scene->face_until[stencil->face_point[i].face];
        of->sealed = of->sealed && !let_go && (moved || kind == SOLVER_SYMMETRIC || kind == SOLVER_CLAMPED);
    }
}

/* What the solvers need of the geometry at the stage's end, and of the predictor: v_int, p_ref, and as a first guess
 * that a stage changes the pressure as it did in the step before. */
static void set_out(struct solver_pressure *of, const double *J_rate)
{
    const struct solver_upwind *work = of->work;
    size_t count = of->stencil->count;
    size_t lanes = of->loops->lanes;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        of->loops->weights(of, at.begin, at.end);
        of->loops->diagonal(of, at.begin, at.end);
        if (of->stray != NULL) {
            of->loops->strays(of, at.begin, at.end);
        }
        memcpy(of->predicted + at.begin * lanes, work->v + at.begin * lanes,
               (at.end - at.begin) * lanes * sizeof(double));
        for (size_t a = at.begin; of->compliance > 0.0 && a < at.end; a++) {
            of->reference[a] = of->constants.kappa * (work->J[a] - 1.0 - of->tau * J_rate[a]);
        }
    }
}

/* Pressure and velocity become those of the stage; with what the integrator sums of their rates. */
static void take_over(struct solver_pressure *of, const struct solver_state *state, const struct solver_stage *stage,
                      const double *increment)
{
    const struct solver_upwind *work = of->work;
    size_t count = of->stencil->count;
    size_t lanes = of->loops->lanes;
    double share = stage->accumulate / of->tau;
    double *v_sum = state->sum != NULL ? state->sum + (work->v - state->U) : NULL;
    double *J_sum = state->sum != NULL ? state->sum + (work->J - state->U) : NULL;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        for (size_t a = at.begin; a < at.end; a++) {
            double J = 1.0 + (of->p[a] + increment[a]) / of->constants.kappa;
            for (size_t i = a * lanes; v_sum != NULL && i < (a + 1) * lanes; i++) {
                v_sum[i] += share * (work->v[i] - of->predicted[i]);
            }
            if (J_sum != NULL) {
                J_sum[a] += share * (J - work->J[a]);
            }
            work->J[a] = J;
            of->p[a] += increment[a];
        }
    }
}

bool solver_pressure_correct(struct solver_pressure *of, const struct solver_state *state,
                             const struct solver_integrator *integrator, int stage, double t, double dt,
                             struct solver_error *error)
{
    double *increment = of->increment + (size_t)stage * of->stencil->count;
    bool poisson = of->body->scene->incompressible.solver == SOLVER_PRESSURE_POISSON;
    of->tau = integrator->stage[stage].rate * dt;
    of->step = dt;
    free_axes(of, t);
    set_out(of, of->work->J_rate);
    bool solved =
        poisson ? solver_pressure_poisson(of, increment, error) : solver_pressure_pseudo_time(of, increment, error);
    if (!solved) {
        memset(of->increment, 0, (size_t)SOLVER_STAGES * of->stencil->count * sizeof *of->increment);
        return false;
    }
    take_over(of, state, &integrator->stage[stage], increment);
    of->solved++;
    return true;
}

bool solver_pressure_keep(struct solver_pressure *of, struct solver_keeper *keeper, struct solver_error *error)
{
    size_t entries = SOLVER_STAGES * of->body->cloud->count;
    return solver_keep(keeper, "increments of the pressure", of->increment, sizeof *of->increment, entries, error) &&
           solver_keep(keeper, "iterations of the pressure", &of->iterations, sizeof of->iterations, 1, error) &&
           solver_keep(keeper, "stages of the pressure", &of->solved, sizeof of->solved, 1, error);
}
