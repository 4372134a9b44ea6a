/* Updated-Lagrangian SPH, delta-ULSPH-R-TIC with every ingredient switchable (001_363f711843f01da4.txt), as a scheme of
 * the table: its neighbours, its terms and its fields. The loops are in ulsph_dim.c.
 *
 * On a lattice with particles on the faces, whose volumes are cut there, kernel sums are weighted by whole cells all
 * the same: weighted by the cut volumes (ulsph.cells) they make the period of the cantilever 2.6 % too long at ten
 * particles across, by whole cells 0.4 %. */
#include "solver/faces.h"
#include "solver/interfaces.h"
#include "solver/memory.h"
#include "solver/pieces.h"
#include "solver/scheme.h"
#include "solver/skin.h"
#include "solver/ulsph.h"
#include "solver/ulsph_step.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct system {
    const struct solver_body *body;
    const struct solver_ulsph_loops *loops;
    struct solver_skin skin;
    double *pair; /* [skin's capacity][dim + 2] */
    size_t pair_room;
    double *mass, *full_mass; /* [count]; the same array where no cell is cut */
    double fastest;           /* p-wave speed [m/s] */
    double meeting;           /* what shortens the step where materials meet; 1: nothing */
    struct solver_ulsph work;
};

static const struct solver_material_constants *constants_of(const struct system *system, size_t a)
{
    return system->body->constants + a * system->body->stride;
}

static void choose_terms(struct system *system)
{
    const struct solver_scene *scene = system->body->scene;
    static const struct solver_ulsph_loops *const loops[][3] = SOLVER_LOOPS(solver_ulsph);
    system->loops = loops[solver_path()][scene->dim - 1];
    const struct solver_cloud *cloud = system->body->cloud;
    system->work = (struct solver_ulsph){
        .interface = solver_interfaces_there(cloud) ? cloud->interface : NULL,
        .site = cloud->site,
        .points = cloud->points,
        .constants = system->body->constants,
        .stride = system->body->stride,
        .mass = system->mass,
        .full_mass = system->full_mass,
        .h = 0.5 * scene->support * cloud->spacing,
        .spacing = cloud->spacing,
        .terms = scene->ulsph,
    };
}

/* Whether kernel sums are weighted by other than the particles' own volumes. */
static bool cuts_cells(const struct system *system)
{
    return system->body->scene->ulsph.cells == SOLVER_ULSPH_WHOLE && system->body->cloud->face_point_count > 0;
}

/* Masses, those of whole cells, and the fastest wave. A particle on k faces has its cell cut in half k times. */
static bool weigh(struct system *system, struct solver_error *error)
{
    const struct solver_cloud *cloud = system->body->cloud;
    if (!solver_alloc((void **)&system->mass, cloud->count, sizeof(double), "masses", error)) {
        return false;
    }
    system->full_mass = system->mass;
    if (cuts_cells(system) &&
        !solver_alloc((void **)&system->full_mass, cloud->count, sizeof(double), "masses", error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        const struct solver_material_constants *of_a = constants_of(system, a);
        system->mass[a] = of_a->rho * cloud->V[a];
        system->fastest = fmax(system->fastest, of_a->cp);
        if (system->full_mass != system->mass) {
            unsigned cuts = (unsigned)__builtin_popcount(cloud->tags[a] & SOLVER_FACE_BITS);
            system->full_mass[a] = system->mass[a] * (double)(1U << cuts);
        }
    }
    return true;
}

static void destroy(void *of)
{
    struct system *system = of;
    solver_skin_free(&system->skin);
    free(system->pair);
    if (system->full_mass != system->mass) {
        free(system->full_mass);
    }
    free(system->mass);
    free(system);
}

/* Of the spacing. Particles next to the surface are found among the neighbours nearer than this (ulsph_dim.c), and at
 * the spacing itself the kernel must not be zero: artificial stresses divide by it. */
static const double least_support = 1.2;

static bool refuse(const struct solver_scene *scene, struct solver_error *error)
{
    if (strcmp(scene->material_model, "linear-elastic") != 0) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "%s: material.model: scheme = \"ulsph\" has one material, Hooke's law in rates with the Jaumann "
            "rate; expected linear-elastic, got %s",
            scene->path, scene->material_model);
    }
    if (scene->support < least_support) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: support: with scheme = \"ulsph\" the nearest neighbours must be well within reach; "
                           "expected at least %g, got %g",
                           scene->path, least_support, scene->support);
    }
    if (solver_scene_has(scene, SOLVER_INITIAL_DISPLACEMENT) && !solver_scene_has(scene, SOLVER_INITIAL_F)) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "%s: initial.F: scheme = \"ulsph\" needs it beside initial.displacement: its initial density "
            "and stress follow from it",
            scene->path);
    }
    return true;
}

static bool create(const struct solver_body *body, void **out, struct solver_error *error)
{
    double reach = body->scene->support * body->cloud->spacing;
    struct system *system = NULL;
    if (!refuse(body->scene, error) || !solver_alloc((void **)&system, 1, sizeof *system, "scheme", error)) {
        return false;
    }
    system->body = body;
    if (!weigh(system, error) || !solver_skin_create(body->cloud, reach, SOLVER_PAIRS_WITHIN, &system->skin, error)) {
        destroy(system);
        return false;
    }
    choose_terms(system);
    *out = system;
    return true;
}

static struct solver_geometry geometry(const void *of)
{
    const struct system *system = of;
    const struct solver_cloud *cloud = system->body->cloud;
    size_t record = (size_t)cloud->dim + 2;
    size_t masses = (cuts_cells(system) ? 2 : 1) * cloud->count;
    return (struct solver_geometry){
        .V = cloud->V,
        .face_point = cloud->face_point,
        .face_point_count = cloud->face_point_count,
        .pairs = solver_skin_pairs(&system->skin),
        .bytes = (double)(solver_skin_bytes(&system->skin) + sizeof(double) * (system->pair_room * record + masses)),
        .passes = 3, /* geometry, gradients, rates */
        .residual = NAN,
        .shorter = system->meeting,
    };
}

static void arrays(const void *of, struct solver_cost_arrays *list)
{
    static const char group[] = "scheme";
    const struct system *system = of;
    const struct solver_cloud *cloud = system->body->cloud;
    size_t record = (size_t)cloud->dim + 2;
    solver_skin_arrays(&system->skin, "neighbours", list);
    solver_cost_array(list, group, "pair records", system->pair, system->pair_room * record, sizeof *system->pair);
    solver_cost_array(list, group, "masses", system->mass, cloud->count, sizeof *system->mass);
    solver_cost_array(list, group, "masses of whole cells",
                      system->full_mass != system->mass ? system->full_mass : NULL, cloud->count,
                      sizeof *system->full_mass);
    solver_cost_array(list, group, "itself", system, 1, sizeof *system);
}

static void terms(const void *of, struct solver_cost_terms *list)
{
    const struct system *system = of;
    double particles = (double)system->body->cloud->count;
    system->loops->terms(&system->work, system->body->cloud->count, list);
    solver_cost_term(list, "whether particles moved", 0, particles * 3.0 * system->body->cloud->dim);
    solver_cost_term(list, "whether the step is too long", 0, particles);
}

static size_t fields(void *of, struct solver_field table[SOLVER_STATE_FIELDS])
{
    struct system *system = of;
    struct solver_ulsph *work = &system->work;
    size_t vector = system->loops->lanes;
    size_t tensor = (size_t)system->body->cloud->dim * vector;
    bool control = work->terms.tension == SOLVER_ULSPH_CONTROL;
    bool riemann = work->terms.dissipation == SOLVER_ULSPH_RIEMANN;
    bool tensile = work->terms.tension != SOLVER_ULSPH_BARE;
    const struct solver_field rows[] = {
        {"v", vector, true, {&work->v}, {&work->v_rate}, 0},
        {"x", vector, true, {&work->x}, {&work->x_rate}, 0},
        {"rho", 1, true, {&work->rho}, {&work->rho_rate}, 0},
        {"S", tensor, true, {&work->S}, {&work->S_rate}, 0},
        {"m/rho", 1, false, {&work->volume}, {NULL}, 0},
        {"cell", cuts_cells(system) ? 1 : 0, false, {&work->cell}, {NULL}, 0},
        {"sqrt(rho)", riemann ? 1 : 0, false, {&work->root_rho}, {NULL}, 0},
        {"z", riemann ? 1 : 0, false, {&work->z}, {NULL}, 0},
        {"L", work->terms.gradient == SOLVER_ULSPH_CORRECTED ? tensor : 0, false, {&work->L}, {NULL}, 0},
        {"transport v", work->terms.xsph > 0.0 ? vector : 0, false, {&work->transport}, {NULL}, 0},
        {"sigma L", tensor, false, {&work->sigma_L}, {NULL}, 0},
        {"sigma+ L", tensile ? tensor : 0, false, {&work->tensile_L}, {NULL}, 0},
        {"colour", control ? 1 : 0, false, {&work->colour}, {NULL}, 0},
        {"inner", control ? 1 : 0, false, {&work->inner}, {NULL}, 0},
        {"grad v", riemann ? tensor : 0, false, {&work->v_gradient}, {NULL}, 0},
        {"grad rho", work->terms.delta > 0.0 ? vector : 0, false, {&work->rho_gradient}, {NULL}, 0},
    };
    memcpy(table, rows, sizeof rows);
    return sizeof rows / sizeof *rows;
}

/* Neighbours of the particles as they lie now, with room for their pair records. */
static bool find_neighbours(struct system *system, struct solver_error *error)
{
    const struct solver_cloud *cloud = system->body->cloud;
    struct solver_ulsph *work = &system->work;
    if (!solver_skin_update(&system->skin, work->x, system->loops->lanes, error)) {
        return false;
    }
    size_t pairs = solver_skin_pairs(&system->skin);
    if (pairs > system->pair_room) {
        size_t room = pairs + pairs / 4;
        free(system->pair);
        system->pair = NULL;
        system->pair_room = 0;
        if (!solver_alloc((void **)&system->pair, room * ((size_t)cloud->dim + 2), sizeof(double), "pairs", error)) {
            return false;
        }
        system->pair_room = room;
    }
    work->row = system->skin.graph.row;
    work->neighbour = system->skin.graph.neighbour;
    work->pair = system->pair;
    return true;
}

/* Of entries of F - I: above it strain is no longer small, and what stress a law in rates has then depends on the way
 * there. */
static const double largest_gradient = 0.1;

/* Density and deviatoric stress of a small initial strain: Hooke's law. */
static bool strain_initially(struct system *system, size_t a, struct solver_error *error)
{
    struct solver_ulsph *work = &system->work;
    const struct solver_scene *scene = system->body->scene;
    size_t dim = (size_t)system->body->cloud->dim;
    size_t lanes = system->loops->lanes;
    const struct solver_material_constants *of_a = constants_of(system, a);
    double volumetric = 0.0;
    double X[3] = {0};
    double F[9];
    memcpy(X, system->body->cloud->X + a * dim, dim * sizeof *X);
    if (!solver_scene_eval(scene, SOLVER_INITIAL_F, X, 0.0, F, dim * dim, error)) {
        return false;
    }
    for (size_t i = 0; i < dim; i++) {
        volumetric += F[i * dim + i] - 1.0;
    }
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            double unit = i == j ? 1.0 : 0.0;
            double strain = 0.5 * (F[i * dim + j] + F[j * dim + i]) - unit * (1.0 + volumetric / 3.0);
            work->S[(a * dim + j) * lanes + i] = 2.0 * of_a->mu * strain;
            if (fabs(F[i * dim + j] - unit) > largest_gradient) {
                return solver_fail(error, SOLVER_BAD_INPUT,
                                   "%s: initial.F at X = (%g, %g, %g) m: scheme = \"ulsph\" starts from small strains; "
                                   "expected row %zu, column %zu within %g of %g, got %g",
                                   scene->path, X[0], X[1], X[2], i + 1, j + 1, largest_gradient, unit, F[i * dim + j]);
            }
        }
    }
    work->rho[a] = of_a->rho * (1.0 - volumetric);
    return true;
}

static void bind(struct system *system)
{
    if (!(system->work.terms.xsph > 0.0)) {
        system->work.transport = system->work.v;
    }
}

static void turn(void *of, struct solver_state *state)
{
    solver_state_turn(state);
    bind(of);
}

static bool start(void *of, struct solver_error *error)
{
    struct system *system = of;
    struct solver_ulsph *work = &system->work;
    bind(system);
    if (work->cell == NULL) {
        work->cell = work->volume;
    }
    for (size_t a = 0; a < system->body->cloud->count; a++) {
        work->rho[a] = constants_of(system, a)->rho;
        if (solver_scene_has(system->body->scene, SOLVER_INITIAL_F) && !strain_initially(system, a, error)) {
            return false;
        }
    }
    if (!find_neighbours(system, error)) {
        return false;
    }
    system->meeting = 1.0;
    if (system->body->stride != 0) {
        system->loops->volumes(work, 0, system->body->cloud->count);
        system->loops->geometry(work, 0, system->body->cloud->count);
        system->meeting = solver_ulsph_step_share(work, system->body);
    }
    return true;
}

typedef void loop(const struct solver_ulsph *work, size_t begin, size_t end);

static void over_all(const struct system *system, loop *pass)
{
    size_t count = system->body->cloud->count;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        pass(&system->work, at.begin, at.end);
    }
}

/* A density that would change by more than itself within a step is beyond what the scheme follows: particles would
 * leave their neighbours, or go past them, before any of them felt it. */
static bool check_pace(const struct system *system, double dt, struct solver_error *error)
{
    const struct solver_cloud *cloud = system->body->cloud;
    size_t found = cloud->count;
#pragma omp parallel for schedule(static) reduction(min : found)
    for (size_t a = 0; a < cloud->count; a++) {
        bool hasty = dt * fabs(system->work.rho_rate[a]) > system->work.rho[a];
        found = hasty && a < found ? a : found;
    }
    if (found == cloud->count) {
        return true;
    }
    const double *X = cloud->X + found * (size_t)cloud->dim;
    return solver_fail(error, SOLVER_BROKE_DOWN,
                       "particle %zu at X = (%g, %g, %g) m: density rho would change by %g of itself within the step",
                       found, X[0], cloud->dim > 1 ? X[1] : 0.0, cloud->dim > 2 ? X[2] : 0.0,
                       dt * system->work.rho_rate[found] / system->work.rho[found]);
}

static bool evaluate(void *of, double t, double dt, struct solver_error *error)
{
    struct system *system = of;
    struct solver_ulsph *work = &system->work;
    if (!find_neighbours(system, error)) {
        return false;
    }
    over_all(system, system->loops->geometry);
    /* smoothing must not carry particles off the faces that hold them */
    if (work->transport != work->v &&
        !solver_faces_constrain(system->body->faces, system->body, t,
                                (struct solver_vectors){.wide = work->transport, .lanes = system->loops->lanes},
                                error)) {
        return false;
    }
    over_all(system, system->loops->gradients);
    over_all(system, system->loops->rates);
    return check_pace(system, dt, error);
}

static void refresh(void *of, size_t begin, size_t end)
{
    const struct system *system = of;
    system->loops->volumes(&system->work, begin, end);
}

/* The p-wave's speed, that of all particles. */
static double fastest(const void *of, size_t begin, size_t end)
{
    const struct system *system = of;
    (void)begin;
    (void)end;
    return system->fastest;
}

/* As eq. 26, with the p-wave's speed, the fastest there is, in place of sqrt(K / rho); where materials meet less. */
static double largest_step(const void *of, double speed)
{
    const struct system *system = of;
    return system->body->scene->cfl * system->work.h / (speed * system->meeting);
}

static size_t first_broken(const void *of, size_t begin, size_t end)
{
    const struct system *system = of;
    return system->loops->first_broken(&system->work, begin, end);
}

static const char *complaint(const void *of, size_t a)
{
    const struct system *system = of;
    double rho = system->work.rho[a];
    return !isfinite(rho) ? "density rho is not finite"
           : rho <= 0.0   ? "density rho is not positive"
                          : "deviatoric stress S is not finite";
}

static double pressure_of(const struct system *system, size_t a)
{
    return solver_ulsph_pressure(constants_of(system, a), system->work.rho[a]);
}

/* S with its components out of the plane or line: it has no trace. */
static void deviator_of(const struct system *system, size_t a, double S[9])
{
    size_t dim = (size_t)system->body->cloud->dim;
    double in_plane = 0.0;
    memset(S, 0, 9 * sizeof *S);
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            S[3 * i + j] = system->work.S[(a * dim + j) * system->loops->lanes + i];
        }
        in_plane += S[4 * i];
    }
    for (size_t i = dim; i < 3; i++) {
        S[4 * i] = -in_plane / (double)(3 - dim);
    }
}

static void look(const void *of, size_t a, struct solver_point *point)
{
    const struct system *system = of;
    deviator_of(system, a, point->sigma);
    for (size_t i = 0; i < 3; i++) {
        point->sigma[4 * i] -= pressure_of(system, a);
    }
    point->J = constants_of(system, a)->rho / system->work.rho[a];
}

static double energy(const void *of, size_t a)
{
    const struct system *system = of;
    const struct solver_material_constants *of_a = constants_of(system, a);
    double S[9];
    double square = 0.0;
    double p = pressure_of(system, a);
    deviator_of(system, a, S);
    for (size_t i = 0; i < 9; i++) {
        square += S[i] * S[i];
    }
    return (square / (4.0 * of_a->mu) + p * p / (2.0 * of_a->kappa)) * of_a->rho / system->work.rho[a];
}

/* Which pairs are listed; room and records of pairs come with the next evaluation. */
static bool keep(void *of, struct solver_keeper *keeper, struct solver_error *error)
{
    struct system *system = of;
    return solver_skin_keep(&system->skin, "neighbours", keeper, error);
}

static const struct solver_scheme_choice choices[] = {
    {"ulsph.gradient", "corrected by the matrix L, or plain"},
    {"ulsph.dissipation", "riemann (R), viscosity (AV) or none"},
    {"ulsph.tension", "control (TIC), stress (AS) or none"},
    {"ulsph.xsph", "of the velocity that carries particles; 0: none"},
    {"ulsph.delta", "density diffusion; 0: none"},
    {NULL, NULL},
};

const struct solver_scheme solver_scheme_ulsph = {
    .name = "ulsph",
    .summary = "updated-Lagrangian SPH, delta-ULSPH-R-TIC (001_363f711843f01da4.txt)",
    .choice = choices,
    .deformation = false,
    .advice = "a smaller cfl, a finer n, or another ulsph.tension",
    .claims = {.turning = "ulsph.xsph=0 ulsph.tension=none", .momentum = "ulsph.tension=stress"},
    .create = create,
    .destroy = destroy,
    .geometry = geometry,
    .fields = fields,
    .arrays = arrays,
    .terms = terms,
    .turn = turn,
    .start = start,
    .evaluate = evaluate,
    .refresh = refresh,
    .fastest = fastest,
    .largest_step = largest_step,
    .first_broken = first_broken,
    .complaint = complaint,
    .look = look,
    .energy = energy,
    .keep = keep,
};
