/* The mixed total-Lagrangian Upwind scheme (000_e9ec29e1bde7947d.txt) as a scheme of the table: its stencil, its terms
 * and its fields. The loops are in upwind_dim.c. */
#include "solver/scheme_upwind.h"

#include "solver/memory.h"
#include "solver/pieces.h"
#include "solver/pressure.h"
#include "solver/symmetry.h"
#include "solver/upwind_step.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void choose_terms(struct solver_upwind_system *system, const struct solver_material *material)
{
    const struct solver_scene *scene = system->body->scene;
    struct solver_upwind *work = &system->work;
    static const struct solver_upwind_loops *const loops[][3] = SOLVER_LOOPS(solver_upwind);
    system->loops = loops[solver_path()][scene->dim - 1];
    work->material = material;
    work->evolves_J = scene->evolved != SOLVER_PF;
    work->evolves_H = scene->evolved == SOLVER_PFHJ;
    work->frozen = material->linear;
    work->hardening = solver_scene_flows(scene) ? &scene->hardening : NULL;
    work->whole_jump = strcmp(scene->volume_flux, "stress") == 0;
    work->reconstruct = strcmp(scene->reconstruction, "none") != 0;
    work->constants = system->body->constants;
    work->stride = system->body->stride;
}

static void bind_stencil(struct solver_upwind_system *system)
{
    const struct solver_stencil *stencil = system->stencil;
    system->work.row = stencil->graph.row;
    system->work.neighbour = stencil->graph.neighbour;
    system->work.pair = stencil->pair;
    system->work.shared = stencil->shared;
    system->work.along = stencil->along;
    system->work.abreast = stencil->abreast;
    system->work.rank = stencil->rank;
    system->work.rank_count = stencil->rank_count;
    system->work.narrow = stencil->narrow;
    system->work.unit = stencil->unit;
    system->work.transposed = stencil->transposed;
    system->work.row_sum = stencil->row_sum;
    system->work.least_squares = stencil->least_squares;
    system->work.V = stencil->V;
}

void solver_upwind_destroy(void *of)
{
    struct solver_upwind_system *system = of;
    solver_pressure_free(system->pressure);
    solver_stencil_free(system->stencil);
    free(system->paced);
    free(system);
}

static bool by_lattice(const struct solver_scene *scene)
{
    return strcmp(scene->reconstruction, "lattice") == 0;
}

/* The stencil of the body's cloud; of a part of a symmetric body that of the whole is made, and reduced. */
static bool make_stencil(struct solver_upwind_system *system, const struct solver_stencil_builder *builder, bool align,
                         struct solver_error *error)
{
    const struct solver_scene *scene = system->body->scene;
    const struct solver_cloud *part = system->body->cloud;
    const struct solver_cloud *cloud = part->symmetry != NULL ? part->symmetry->whole : part;
    bool least_squares = strcmp(scene->reconstruction, "least-squares") == 0;
    bool in_single = strcmp(scene->precision, "single") == 0;
    bool runs = align && (scene->dim < 3 || in_single); /* else loops take none: upwind_abreast_dim.c */
    bool ranks = align && system->body->stride == 0;    /* else loops take none: upwind_ranks_dim.c */
    struct solver_stencil **stencil = &system->stencil;
    if (!solver_stencil_create(builder, cloud, scene->support, stencil, error) ||
        (least_squares && !solver_stencil_add_least_squares(*stencil, cloud, error)) ||
        (by_lattice(scene) &&
         !solver_stencil_add_lattice_slopes(*stencil, cloud, system->body->stride != 0 ? system->body->constants : NULL,
                                            error))) {
        return false;
    }
    system->residuals = solver_stencil_check(*stencil, cloud);
    return (part->symmetry == NULL || solver_symmetry_keep(*stencil, part, stencil, error)) &&
           (!align || solver_stencil_align(*stencil, part, error)) && solver_stencil_share(*stencil, error) &&
           (!runs || solver_stencil_find_runs(*stencil, error)) &&
           (!ranks || solver_stencil_find_ranks(*stencil, part, error)) &&
           (strcmp(scene->precision, "double") == 0 || solver_stencil_narrow(*stencil, error));
}

bool solver_upwind_create(const struct solver_body *body, size_t size, bool align, void **out,
                          struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_stencil_builder *builder = solver_stencil_find(scene->stencil);
    const struct solver_material_model *model = solver_material_find(scene->material_model);
    struct solver_upwind_system *system = NULL;
    if (builder == NULL || model == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: no stencil \"%s\" or material \"%s\"", scene->path,
                           scene->stencil, scene->material_model);
    }
    if (!solver_alloc((void **)&system, 1, size, "scheme", error)) {
        return false;
    }
    system->body = body;
    system->size = size;
    choose_terms(system, model->in[scene->dim - 1]);
    if (!make_stencil(system, builder, align, error) ||
        !solver_upwind_pace(system->stencil, body, &system->paced, error)) {
        solver_upwind_destroy(system);
        return false;
    }
    bind_stencil(system);
    struct solver_body counted = *body;
    counted.constants = system->paced != NULL ? system->paced : body->constants;
    system->meeting = solver_upwind_step_share(system->stencil, &counted);
    *out = system;
    return true;
}

static bool create(const struct solver_body *body, void **out, struct solver_error *error)
{
    void *made = NULL;
    if (!solver_upwind_create(body, sizeof(struct solver_upwind_system), true, &made, error) || made == NULL) {
        return false;
    }
    struct solver_upwind_system *system = made;
    if (!solver_pressure_create(body, system->stencil, &system->work, &system->pressure, error)) {
        solver_upwind_destroy(system);
        return false;
    }
    if (system->pressure != NULL) {
        system->work.constants = &system->pressure->constants;
        system->work.constrained = true;
    }
    *out = system;
    return true;
}

struct solver_geometry solver_upwind_geometry(const void *of)
{
    const struct solver_upwind_system *system = of;
    const struct solver_stencil *stencil = system->stencil;
    return (struct solver_geometry){
        .V = stencil->own != NULL ? stencil->own : stencil->V,
        .face_point = stencil->face_point,
        .face_point_count = stencil->face_point_count,
        .pairs = stencil->pairs,
        .bytes = (double)(solver_stencil_bytes(stencil) +
                          (system->pressure != NULL ? system->pressure->doubles * sizeof(double) : 0)),
        .passes = 2, /* gradients, rates */
        .residual = fmax(system->residuals.closure, system->residuals.linear),
        .shorter = system->meeting,
    };
}

void solver_upwind_arrays(const void *of, struct solver_cost_arrays *arrays)
{
    const struct solver_upwind_system *system = of;
    solver_stencil_arrays(system->stencil, arrays);
    solver_cost_array(arrays, "scheme", "itself", system, 1, system->size);
    solver_cost_array(arrays, "scheme", "constants that steps go by", system->paced, system->body->cloud->count,
                      sizeof *system->paced);
    solver_pressure_arrays(system->pressure, arrays);
}

void solver_upwind_terms(const void *of, struct solver_cost_terms *terms)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = &system->work;
    size_t count = system->body->cloud->count;
    system->loops->gradient_terms(work, count, terms);
    if (system->terms != NULL) {
        system->terms(system, terms);
    } else {
        system->loops->rate_terms(work, count, terms);
    }
    system->loops->particle_terms(work, count, terms);
    if (work->lost != NULL) { /* of a symmetric part, shares of particles */
        solver_cost_term(terms, "power lost: its sum", 0, (double)count * (system->stencil->own != NULL ? 3.0 : 1.0));
    }
    solver_pressure_terms(system->pressure, terms);
}

size_t solver_upwind_fields(void *of, struct solver_field table[SOLVER_STATE_FIELDS])
{
    struct solver_upwind_system *system = of;
    struct solver_upwind *work = &system->work;
    size_t dim = (size_t)system->body->cloud->dim;
    size_t vector = system->loops->lanes;
    size_t tensor = dim * vector;
    bool pressure = work->evolves_J && !work->whole_jump && system->rates == NULL;
    bool stiffens = work->evolves_J && system->rates == NULL && work->material->stiffness_range != NULL;
    bool slopes = work->reconstruct && system->rates == NULL;
    /* loops over rows along axes (dim_aligned.h) ask for places only to reconstruct */
    bool by_axes = work->along != NULL && work->stride == 0 && !(work->evolves_J && work->whole_jump);
    bool elsewhere = work->constrained || (!by_axes && (work->frozen || work->evolves_J));
    bool placed = system->rates == NULL && (work->reconstruct || elsewhere);
    size_t remembered = work->hardening != NULL ? work->material->flow->width : 0;
    const struct solver_field rows[] = {
        {"v", vector, true, {&work->v}, {&work->v_rate}, 0},
        {"x", vector, true, {&work->x}, {NULL}, 0},
        {"F", tensor, true, {&work->F}, {&work->F_rate}, 0},
        {"H", work->evolves_H ? tensor : 0, true, {&work->H}, {&work->H_rate}, 0},
        {"J", work->evolves_J ? 1 : 0, true, {&work->J}, {&work->J_rate}, 0},
        {"X", placed ? vector : 0, false, {&work->X}, {NULL}, 0},
        {"P", tensor, false, {&work->P}, {NULL}, 0},
        {"cof F",
         work->evolves_J && !work->evolves_H && !work->frozen ? tensor : 0,
         false,
         {&work->cofactor},
         {NULL},
         0},
        {"U'(J)", pressure ? 1 : 0, false, {&work->pressure}, {NULL}, 0},
        {"U''(J) / kappa", stiffens ? 1 : 0, false, {&work->stiffness}, {NULL}, 0},
        {"grad U'(J)", pressure && slopes ? vector : 0, false, {&work->pressure_gradient}, {NULL}, 0},
        {"grad P",
         work->evolves_J && work->whole_jump && slopes ? dim * tensor : 0,
         false,
         {&work->P_gradient},
         {NULL},
         0},
        {"grad v", slopes && work->least_squares != NULL ? tensor : 0, false, {&work->v_gradient}, {NULL}, 0},
        {"power lost", system->body->scene->balance ? 2 : 0, false, {&work->lost}, {NULL}, 0},
        {"plastic flow", remembered, false, {&work->flown}, {NULL}, 0},
        {"plastic flow at the start", remembered, false, {&work->flown_before}, {NULL}, 0},
    };
    memcpy(table, rows, sizeof rows);
    return sizeof rows / sizeof *rows;
}

void solver_upwind_gradient(const struct solver_stencil *stencil, const struct solver_vectors *x, const double *X,
                            size_t a, double *G)
{
    size_t dim = (size_t)stencil->dim;
    size_t shift = solver_stencil_shift(stencil, a);
    memset(G, 0, dim * dim * sizeof *G);
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        const double *C = solver_stencil_C(stencil, ab + shift);
        size_t b = stencil->graph.neighbour[ab];
        for (size_t i = 0; i < dim; i++) {
            double d = solver_vectors_get(x, b, i) - solver_vectors_get(x, a, i);
            d -= X != NULL ? X[b * dim + i] - X[a * dim + i] : 0.0;
            for (size_t I = 0; I < dim; I++) {
                G[i * dim + I] += 0.5 * d * C[I] / stencil->V[a];
            }
        }
    }
}

/* F of the places where particles are, from their displacements: the gradient of X itself is the identity, but for what
 * a builder's solution, or rounding, has left of pair vectors (1e-14 of closed, ten times that at corners). That is
 * left out: a body at rest has no strain. */
static void discrete_F(const struct solver_upwind_system *system, size_t a, double *F)
{
    const struct solver_vectors x = {.wide = system->work.x, .lanes = system->loops->lanes};
    size_t dim = (size_t)system->body->cloud->dim;
    solver_upwind_gradient(system->stencil, &x, system->body->cloud->X, a, F);
    for (size_t i = 0; i < dim; i++) {
        F[i * dim + i] += 1.0;
    }
}

/* H, where it is evolved and stands in the equation of J, is its cofactor. */
static void bind_cofactor(struct solver_upwind *work)
{
    if (work->evolves_H && !work->frozen) {
        work->cofactor = work->H;
    }
}

void solver_upwind_turn(void *of, struct solver_state *state)
{
    struct solver_upwind_system *system = of;
    system->at_start = system->work;
    solver_state_turn(state);
    bind_cofactor(&system->work);
}

/* Of particle a, at X, as differences of it stand beside slopes: along a lattice that is graded, in its own coordinate.
 * Else only its direction is asked for. */
static void place(const struct solver_upwind_system *system, size_t a, const double *X, double *out)
{
    const struct solver_cloud *cloud = system->body->cloud;
    size_t dim = (size_t)cloud->dim;
    bool own = by_lattice(system->body->scene) && solver_cloud_graded(cloud);
    for (size_t i = 0; i < dim; i++) {
        out[i] = own ? (double)cloud->site[a * dim + i] * cloud->spacing : X[i];
    }
}

bool solver_upwind_start(void *of, struct solver_error *error)
{
    struct solver_upwind_system *system = of;
    struct solver_upwind *work = &system->work;
    const struct solver_scene *scene = system->body->scene;
    const struct solver_cloud *cloud = system->body->cloud;
    size_t dim = (size_t)cloud->dim;
    size_t lanes = system->loops->lanes;
    bind_cofactor(work);
    for (size_t a = 0; a < cloud->count; a++) {
        double X[3] = {0};
        double F[9];
        memcpy(X, cloud->X + a * dim, dim * sizeof *X);
        if (work->X != NULL) {
            place(system, a, X, work->X + a * lanes);
        }
        if (!solver_scene_has(scene, SOLVER_INITIAL_F)) {
            discrete_F(system, a, F);
        } else if (!solver_scene_eval(scene, SOLVER_INITIAL_F, X, 0.0, F, dim * dim, error)) {
            return false;
        }
        for (size_t i = 0; i < dim; i++) {
            for (size_t I = 0; I < dim; I++) {
                work->F[(a * dim + I) * lanes + i] = F[i * dim + I];
            }
        }
    }
    size_t of_pairs = (2 * dim + 2) * lanes * sizeof(double); /* P, slope of v, v and X */
    work->far = cloud->count * of_pairs > (size_t)1 << 20;
    system->loops->measures(work->frozen, 0, cloud->count, work->F, work->H, work->J);
    if (system->pressure != NULL) {
        solver_pressure_start(system->pressure);
    }
    solver_stencil_narrow_only(system->stencil); /* the loops take the narrow ones */
    return true;
}

/* Plastic flow becomes final once per step: every stage's return map sets out from what was remembered at its start,
 * so that a stage which overshoots, or a step that is taken back, leaves nothing behind. */
bool solver_upwind_prepare(void *of, double dt, struct solver_error *error)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = &system->work;
    size_t count = system->body->cloud->count;
    (void)dt;
    (void)error;
    if (system->pressure != NULL) {
        solver_pressure_begin(system->pressure);
    }
    if (work->flown == NULL) {
        return true;
    }
    size_t width = work->material->flow->width;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        memcpy(work->flown_before + at.begin * width, work->flown + at.begin * width,
               (at.end - at.begin) * width * sizeof(double));
    }
    return true;
}

static const struct solver_upwind *work_of(const struct solver_upwind_system *system, bool start)
{
    return start ? &system->at_start : &system->work;
}

void solver_upwind_gradients(const void *of, bool start, size_t begin, size_t end)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = work_of(system, start);
    system->loops->gradients(work, begin, end);
    if (system->gather != NULL) {
        system->gather(system, work, begin, end);
    }
}

void solver_upwind_rates(const void *of, bool start, size_t begin, size_t end)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = work_of(system, start);
    if (system->rates != NULL) {
        system->rates(system, work, begin, end);
    } else {
        system->loops->rates(work, begin, end);
    }
}

const struct solver_graph *solver_upwind_graph(const void *of)
{
    const struct solver_upwind_system *system = of;
    return &system->stencil->graph;
}

static bool correct(void *of, const struct solver_state *state, const struct solver_integrator *integrator, int stage,
                    double t, double dt, struct solver_error *error)
{
    struct solver_upwind_system *system = of;
    size_t count = system->body->cloud->count;
    if (system->pressure == NULL) {
        return true;
    }
    if (!solver_pressure_correct(system->pressure, state, integrator, stage, t, dt, error)) {
        return false;
    }
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        system->loops->stresses(&system->work, at.begin, at.end);
    }
    return true;
}

static bool keep(void *of, struct solver_keeper *keeper, struct solver_error *error)
{
    struct solver_upwind_system *system = of;
    return system->pressure == NULL || solver_pressure_keep(system->pressure, keeper, error);
}

/* Iterations of the pressure since the start; NaN where there is none. */
static double iterations(const void *of)
{
    const struct solver_upwind_system *system = of;
    return system->pressure != NULL ? (double)system->pressure->iterations : NAN;
}

void solver_upwind_refresh(void *of, size_t begin, size_t end)
{
    const struct solver_upwind_system *system = of;
    system->loops->stresses(&system->work, begin, end);
}

double solver_upwind_fastest(const void *of, size_t begin, size_t end)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = &system->work;
    const struct solver_material_constants *constants = system->paced != NULL ? system->paced : work->constants;
    return work->flown != NULL
               ? work->material->flow->fastest(constants, work->stride, begin, end, work->F, work->flown)
               : work->material->fastest(constants, work->stride, begin, end, work->F);
}

/* The step that the CFL number allows (eq. 41), by the smallest spacing, less where materials meet or particles crowd.
 */
double solver_upwind_largest_step(const void *of, double fastest)
{
    const struct solver_upwind_system *system = of;
    return system->body->scene->cfl * system->stencil->finest / (fastest * system->meeting);
}

size_t solver_upwind_first_broken(const void *of, size_t begin, size_t end)
{
    const struct solver_upwind_system *system = of;
    return system->loops->first_broken(&system->work, begin, end);
}

const char *solver_upwind_complaint(const void *of, size_t a)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = &system->work;
    size_t tensor = (size_t)system->body->cloud->dim * system->loops->lanes;
    double J;
    if (work->J != NULL && system->pressure == NULL) {
        J = work->J[a];
    } else {
        system->loops->measures(false, 0, 1, work->F + a * tensor, NULL, &J);
    }
    return !isfinite(J)                ? "deformation gradient F or Jacobian J is not finite"
           : !work->frozen && J <= 0.0 ? "the particle is turned inside out, Jacobian J <= 0"
                                       : "deformation gradient F is not finite";
}

static const struct solver_scheme_choice choices[] = {
    SOLVER_UPWIND_EVOLVED,
    {"incompressible.solver = \"poisson\"",
     "the pressure in place of J, up to material.nu = 0.5, by conjugate gradients"},
    {"incompressible.solver = \"pseudo-time\"", "the same by the printed iteration"},
    {NULL, NULL},
};

const struct solver_scheme solver_scheme_upwind = {
    .name = "upwind",
    .summary = "total-Lagrangian mixed method with Riemann dissipation (000_e9ec29e1bde7947d.txt)",
    .advice = "a smaller cfl, a finer n or reconstruction = \"least-squares\"",
    .choice = choices,
    .claims = {.affine = "", .turning = "", .momentum = "", .angular = "angular_momentum=projected"},
    .create = create,
    .destroy = solver_upwind_destroy,
    .geometry = solver_upwind_geometry,
    .fields = solver_upwind_fields,
    .correct = correct,
    .keep = keep,
    .iterations = iterations,
    .single = &solver_scheme_upwind_single,
    .arrays = solver_upwind_arrays,
    .terms = solver_upwind_terms,
    SOLVER_UPWIND_SHARED,
};
