/* The scheme `upwind` with its state in single precision (state.h). Loops over pairs compute in it too
 * (upwind_single_dim.c): differences of neighbours, which lose nothing by it that was not lost when the neighbours were
 * stored. All else is done by the loops in double precision, for a few particles at a time whose fields are copied to
 * where they stay in cache: a window. */
#include "solver/pieces.h"
#include "solver/scheme_upwind.h"
#include "solver/single.h"

#include <math.h>
#include <string.h>

struct system {
    struct solver_upwind_system base; /* its work has no fields */
    const struct solver_upwind_single_loops *loops;
    const struct solver_single_loops *convert;
    struct solver_upwind_single work, at_start; /* as in the base */
    double centre[3];                           /* from which work.X is measured [m] */
};

static void place_centre(struct system *system)
{
    const struct solver_cloud *cloud = system->base.body->cloud;
    size_t dim = (size_t)cloud->dim;
    for (size_t i = 0; i < dim; i++) {
        double lower = INFINITY;
        double upper = -INFINITY;
        for (size_t a = 0; a < cloud->count; a++) {
            lower = fmin(lower, cloud->X[a * dim + i]);
            upper = fmax(upper, cloud->X[a * dim + i]);
        }
        system->centre[i] = 0.5 * (lower + upper);
    }
}

/* Products of four lengths between neighbours, and of two impedances, must be floats; with room for what deforms. */
static bool fits(const struct solver_body *body, struct solver_error *error)
{
    double h = body->cloud->spacing;
    return (h >= 1e-7 && h <= 1e7) ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "%s: precision: single computes with lengths in metres, whose fourth power must be a number of "
                       "single precision; expected a spacing in [1e-7, 1e7] m, got %g; take double, mixed or other "
                       "units",
                       body->scene->path, h);
}

static bool create(const struct solver_body *body, void **out, struct solver_error *error)
{
    static const struct solver_upwind_single_loops *const loops[][3] = SOLVER_LOOPS(solver_upwind_single);
    static const struct solver_single_loops *const convert[][3] = SOLVER_LOOPS(solver_single);
    void *made = NULL;
    if (!fits(body, error)) {
        return false;
    }
    if (!solver_upwind_create(body, sizeof(struct system), true, &made, error) || made == NULL) {
        return false;
    }
    struct system *system = made;
    const struct solver_upwind *base = &system->base.work;
    system->loops = loops[solver_path()][body->cloud->dim - 1];
    system->convert = convert[solver_path()][body->cloud->dim - 1];
    system->work = (struct solver_upwind_single){.row = base->row,
                                                 .neighbour = base->neighbour,
                                                 .shared = base->shared,
                                                 .along = base->along,
                                                 .abreast = base->abreast,
                                                 .rank_count = base->rank_count,
                                                 .rank = base->rank,
                                                 .narrow = base->narrow,
                                                 .unit = base->unit,
                                                 .row_sum = base->row_sum,
                                                 .V = base->V,
                                                 .least_squares = base->least_squares,
                                                 .material = base->material,
                                                 .constants = base->constants,
                                                 .stride = base->stride,
                                                 .evolves_J = base->evolves_J,
                                                 .evolves_H = base->evolves_H,
                                                 .frozen = base->frozen,
                                                 .reconstruct = base->reconstruct};
    place_centre(system);
    *out = system;
    return true;
}

static size_t fields(void *of, struct solver_field table[SOLVER_STATE_FIELDS])
{
    struct system *system = of;
    struct solver_upwind_single *work = &system->work;
    size_t vector = system->base.loops->lanes;
    size_t tensor = (size_t)system->base.body->cloud->dim * vector;
    bool J = work->evolves_J;
    bool H = work->evolves_H;
    bool own = work->least_squares == NULL;
    const struct solver_field rows[] = {
        {.name = "v", .width = vector, .evolved = true, .single = &work->v, .single_rate = &work->v_rate},
        {.name = "u", .width = vector, .evolved = true, .single = &work->x},
        {.name = "F", .width = tensor, .evolved = true, .single = &work->F, .single_rate = &work->F_rate},
        {.name = "H", .width = H ? tensor : 0, .evolved = true, .single = &work->H, .single_rate = &work->H_rate},
        {.name = "J", .width = J ? 1 : 0, .evolved = true, .single = &work->J, .single_rate = &work->J_rate},
        {.name = "X", .width = vector, .single = &work->X},
        {.name = "P", .width = tensor, .single = &work->P},
        {.name = "cof F", .width = J && !H && !work->frozen ? tensor : 0, .single = &work->cofactor},
        {.name = "U'(J)", .width = J ? 1 : 0, .single = &work->pressure},
        {.name = "U''(J) / kappa",
         .width = J && work->material->stiffness_range != NULL ? 1 : 0,
         .single = &work->stiffness},
        {.name = "grad U'(J)", .width = J && work->reconstruct ? vector : 0, .single = &work->pressure_gradient},
        {.name = "grad v", .width = work->reconstruct && !own ? tensor : 0, .single = &work->v_gradient},
    };
    memcpy(table, rows, sizeof rows);
    return sizeof rows / sizeof *rows;
}

static void bind_cofactor(struct system *system)
{
    if (system->work.evolves_H && !system->work.frozen) {
        system->work.cofactor = system->work.H;
    }
}

static void turn(void *of, struct solver_state *state)
{
    struct system *system = of;
    system->at_start = system->work;
    solver_state_turn(state);
    bind_cofactor(system);
}

/* --- windows --- */

enum { WINDOW = 64 };

struct window {
    size_t begin, count;
    struct solver_upwind work; /* of its particles alone */
    double v[WINDOW * 4] __attribute__((aligned(64)));
    double F[WINDOW * 12] __attribute__((aligned(64)));
    double H[WINDOW * 12] __attribute__((aligned(64)));
    double P[WINDOW * 12] __attribute__((aligned(64)));
    double J[WINDOW], pressure[WINDOW], stiffness[WINDOW];
};

static size_t tensor_width(const struct system *system)
{
    return (size_t)system->base.body->cloud->dim * system->base.loops->lanes;
}

/* Particles from `begin` on, before `end`, with their F, H and J. */
static void open_window(const struct system *system, size_t begin, size_t end, struct window *window)
{
    const struct solver_upwind_single *from = &system->work;
    size_t tensor = tensor_width(system);
    size_t count = end - begin < WINDOW ? end - begin : WINDOW;
    struct solver_upwind *work = &window->work;
    window->begin = begin;
    window->count = count;
    *work = system->base.work;
    work->constants += begin * work->stride;
    work->v = window->v;
    work->P = window->P;
    work->F = window->F;
    system->convert->widen_measures(from->F + begin * tensor, window->F, count);
    if (from->H != NULL) {
        work->H = window->H;
        system->convert->widen_measures(from->H + begin * tensor, window->H, count);
    }
    work->cofactor = from->cofactor != NULL ? window->H : NULL;
    work->pressure = from->pressure != NULL ? window->pressure : NULL;
    work->stiffness = from->stiffness != NULL ? window->stiffness : NULL;
    work->J = from->J != NULL ? window->J : NULL;
    for (size_t i = 0; from->J != NULL && i < count; i++) {
        window->J[i] = 1.0 + (double)from->J[begin + i];
    }
}

static void refresh(void *of, size_t begin, size_t end)
{
    const struct system *system = of;
    const struct solver_upwind_single *to = &system->work;
    size_t tensor = tensor_width(system);
    struct window window;
    memset(window.P, 0, sizeof window.P); /* what pads it stays zero */
    for (size_t first = begin; first < end; first += WINDOW) {
        open_window(system, first, end, &window);
        system->base.loops->stresses(&window.work, 0, window.count);
        system->convert->narrow(window.P, to->P + first * tensor, window.count * tensor);
        if (to->cofactor != NULL && !to->evolves_H) {
            system->convert->narrow_measures(window.H, to->cofactor + first * tensor, window.count);
        }
        if (to->pressure != NULL) {
            system->convert->narrow(window.pressure, to->pressure + first, window.count);
        }
        if (to->stiffness != NULL) {
            system->convert->narrow(window.stiffness, to->stiffness + first, window.count);
        }
    }
}

static void open_with_v(const struct system *system, size_t begin, size_t end, struct window *window)
{
    size_t lanes = system->base.loops->lanes;
    open_window(system, begin, end, window);
    system->convert->widen(system->work.v + begin * lanes, window->v, window->count * lanes);
}

static size_t first_broken(const void *of, size_t begin, size_t end)
{
    const struct system *system = of;
    for (size_t first = begin; first < end; first += WINDOW) {
        struct window window;
        open_with_v(system, first, end, &window);
        size_t found = system->base.loops->first_broken(&window.work, 0, window.count);
        if (found < window.count) {
            return first + found;
        }
    }
    return end;
}

static double fastest(const void *of, size_t begin, size_t end)
{
    const struct system *system = of;
    const struct solver_upwind_single *work = &system->work;
    const struct solver_material_constants *paced = system->base.paced;
    const struct solver_material_constants *constants = paced != NULL ? paced : work->constants;
    double speed = 0.0;
    if (work->frozen) { /* whatever F is */
        return work->material->fastest(constants, work->stride, begin, end, NULL);
    }
    for (size_t first = begin; first < end; first += WINDOW) {
        struct window window;
        open_window(system, first, end, &window);
        speed = fmax(
            speed, work->material->fastest(constants + first * work->stride, work->stride, 0, window.count, window.F));
    }
    return speed;
}

/* --- one particle, as a system of its own --- */

struct one {
    struct window window;
    struct solver_upwind_system system;
};

static void single_out(const struct system *system, size_t a, struct one *one)
{
    size_t tensor = tensor_width(system);
    open_with_v(system, a, a + 1, &one->window);
    system->convert->widen(system->work.P + a * tensor, one->window.P, tensor);
    one->system = system->base;
    one->system.work = one->window.work;
}

static const char *complaint(const void *of, size_t a)
{
    struct one one;
    single_out(of, a, &one);
    return solver_upwind_complaint(&one.system, 0);
}

static void look(const void *of, size_t a, struct solver_point *point)
{
    struct one one;
    single_out(of, a, &one);
    solver_upwind_look(&one.system, 0, point);
}

static double energy(const void *of, size_t a)
{
    struct one one;
    single_out(of, a, &one);
    return solver_upwind_energy(&one.system, 0);
}

/* --- start and rates --- */

/* Writes F less the identity, from the rows of either. */
static void put_F(const struct system *system, size_t a, const double *rows, double identity)
{
    size_t dim = (size_t)system->base.body->cloud->dim;
    size_t lanes = system->base.loops->lanes;
    for (size_t i = 0; i < dim; i++) {
        for (size_t I = 0; I < dim; I++) {
            system->work.F[(a * dim + I) * lanes + i] = (float)(rows[i * dim + I] - (i == I ? identity : 0.0));
        }
    }
}

/* H and J of F. */
static void start_measures(const struct system *system)
{
    const struct solver_upwind_single *to = &system->work;
    size_t count = system->base.body->cloud->count;
    for (size_t first = 0; first < count; first += WINDOW) {
        struct window window;
        open_window(system, first, count, &window);
        system->base.loops->measures(to->frozen, 0, window.count, window.F, window.H, window.J);
        if (to->H != NULL) {
            system->convert->narrow_measures(window.H, to->H + first * tensor_width(system), window.count);
        }
        for (size_t i = 0; to->J != NULL && i < window.count; i++) {
            to->J[first + i] = (float)(window.J[i] - 1.0);
        }
    }
}

static bool start(void *of, struct solver_error *error)
{
    struct system *system = of;
    const struct solver_scene *scene = system->base.body->scene;
    const struct solver_cloud *cloud = system->base.body->cloud;
    size_t dim = (size_t)cloud->dim;
    size_t lanes = system->base.loops->lanes;
    const struct solver_vectors u = {.single = system->work.x, .lanes = lanes};
    for (size_t a = 0; a < cloud->count; a++) {
        double X[3] = {0};
        double F[9];
        memcpy(X, cloud->X + a * dim, dim * sizeof *X);
        for (size_t i = 0; i < dim; i++) {
            system->work.X[a * lanes + i] = (float)(X[i] - system->centre[i]);
        }
        if (!solver_scene_has(scene, SOLVER_INITIAL_F)) {
            solver_upwind_gradient(system->base.stencil, &u, NULL, a, F); /* that of X is the identity */
            put_F(system, a, F, 0.0);
        } else if (solver_scene_eval(scene, SOLVER_INITIAL_F, X, 0.0, F, dim * dim, error)) {
            put_F(system, a, F, 1.0);
        } else {
            return false;
        }
    }
    size_t of_pairs =
        (2 * dim + 2 + (system->work.frozen ? 0 : 1)) * lanes * sizeof(float); /* P, slope of v, v, X, x */
    system->work.far = cloud->count * of_pairs > (size_t)1 << 20;
    bind_cofactor(system);
    start_measures(system);
    solver_stencil_narrow_only(system->base.stencil);
    return true;
}

static const struct solver_upwind_single *work_of(const struct system *system, bool start)
{
    return start ? &system->at_start : &system->work;
}

static void gradients(const void *of, bool start, size_t begin, size_t end)
{
    const struct system *system = of;
    system->loops->gradients(work_of(system, start), begin, end);
}

static void rates(const void *of, bool start, size_t begin, size_t end)
{
    const struct system *system = of;
    system->loops->rates(work_of(system, start), begin, end);
}

/* Identities that are added to what is stored without, and taken from it. */
static void identity_terms(const struct system *system, double count, struct solver_cost_terms *list)
{
    const struct solver_upwind_single *work = &system->work;
    double tensor = count * (double)tensor_width(system);
    double J = work->J != NULL ? count : 0.0;
    double opened = tensor + (work->H != NULL ? tensor : 0.0) + J; /* F, H and J in a window */
    bool turns = !work->frozen;
    double of_rates = (turns && work->evolves_J ? tensor : 0.0) + (turns && work->evolves_H ? tensor : 0.0);
    double of_pairs =
        turns ? (double)work->row[system->base.body->cloud->count] * (double)system->base.loops->lanes : 0.0;
    bool own = work->cofactor != NULL && !work->evolves_H;
    solver_cost_term(list, "identities left out in single precision", 0,
                     opened + of_rates + of_pairs + (own ? tensor : 0.0));
    solver_cost_once(list, "the same, once", opened * (turns ? 2.0 : 1.0)); /* whole, and how fast */
}

static void terms(const void *of, struct solver_cost_terms *list)
{
    const struct system *system = of;
    size_t count = system->base.body->cloud->count;
    identity_terms(system, (double)count, list);
    system->loops->gradient_terms(&system->work, count, list);
    system->loops->rate_terms(&system->work, count, list);
    system->loops->particle_terms(&system->work, count, list);
}

const struct solver_scheme solver_scheme_upwind_single = {
    .name = "upwind",
    .summary = "upwind with its state in single precision",
    .deformation = true,
    .stencil = true,
    .advice = "a smaller cfl, a finer n, reconstruction = \"least-squares\" or precision = \"double\"",
    .claims = {.affine = "", .turning = "", .momentum = ""},
    .create = create,
    .destroy = solver_upwind_destroy,
    .geometry = solver_upwind_geometry,
    .arrays = solver_upwind_arrays,
    .terms = terms,
    .fields = fields,
    .turn = turn,
    .start = start,
    .gradients = gradients,
    .rates = rates,
    .graph = solver_upwind_graph,
    .refresh = refresh,
    .fastest = fastest,
    .largest_step = solver_upwind_largest_step,
    .first_broken = first_broken,
    .complaint = complaint,
    .look = look,
    .energy = energy,
};
