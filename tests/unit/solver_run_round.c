/* Runs of round bodies: constant states stay as they are up to the curved surface, momentum is kept, and the surface
 * takes the conditions that a face takes. */
#include "solver/cloud.h"
#include "tests/unit/runs.h"

/* Bodies around (0.2, -0.1, 0.3), N(X, Y, Z) their normal on the curved face. */
static const struct body {
    const char *name, *domain;
    int dim;
    bool exact; /* area vectors are along N */
} bodies[] = {
    {"disc",
     "domain = { shape = 'disc', centre = {0.2, -0.1}, radius = 0.5 }\n"
     "local function N(X, Y) return 2 * (X - 0.2), 2 * (Y + 0.1), 0 end\n",
     2, true},
    {"ball",
     "domain = { shape = 'ball', centre = {0.2, -0.1, 0.3}, radius = 0.5 }\n"
     "local function N(X, Y, Z) return 2 * (X - 0.2), 2 * (Y + 0.1), 2 * (Z - 0.3) end\n",
     3, true},
    {"cylinder",
     "domain = { shape = 'cylinder', centre = {0.2, -0.1, 0.3}, radius = 0.5, length = 0.75 }\n"
     "local function N(X, Y) return 2 * (X - 0.2), 2 * (Y + 0.1), 0 end\n",
     3, true},
    {"disc, cut",
     "domain = { shape = 'solid', lower = {-0.425, -0.725}, upper = {0.825, 0.525},\n"
     "    distance = function(X, Y) return math.sqrt((X - 0.2) ^ 2 + (Y + 0.1) ^ 2) - 0.5 end }\n"
     "reference_length, support = 0.5, 2.2\n",
     2, false},
    {"ball, cut",
     "domain = { shape = 'solid', lower = {-0.425, -0.725, -0.325}, upper = {0.825, 0.525, 0.925},\n"
     "    distance = function(X, Y, Z)\n"
     "        return math.sqrt((X - 0.2) ^ 2 + (Y + 0.1) ^ 2 + (Z - 0.3) ^ 2) - 0.5 end }\n"
     "reference_length, support = 0.5, 2.2\n",
     3, false},
    {"cylinder, cut",
     "domain = { shape = 'solid', lower = {-0.425, -0.725, -0.075}, upper = {0.825, 0.525, 0.675},\n"
     "    distance = function(X, Y) return math.sqrt((X - 0.2) ^ 2 + (Y + 0.1) ^ 2) - 0.5 end }\n"
     "reference_length, support = 0.5, 2.2\n",
     3, false},
};
enum { BODIES = sizeof bodies / sizeof *bodies };

static const char hooke[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n";

static struct sample of_body(const struct body *body, const char *more, const char *words)
{
    char text[4096];
    int length = snprintf(text, sizeof text, "%s%s%s", body->domain, hooke, more);
    CU_ASSERT_FATAL(length > 0 && (size_t)length < sizeof text);
    return start(text, "dim=%d n=4 stencil=closed evolved=pF %s", body->dim, words);
}

/* Hooke's stress of the displacement gradient that the scenes below have, over its size. */
static double stress_of(int dim, size_t row, size_t column)
{
    static const double gradient[3][3] = {{2, 1, -1}, {0, 1, 3}, {1, 0, -2}};
    const double mu = 3 / 2.6, lambda = 3 * 0.3 / (1.3 * 0.4);
    double trace = 0.0;
    for (int k = 0; k < dim; k++) {
        trace += gradient[k][k];
    }
    return mu * (gradient[row][column] + gradient[column][row]) + (row == column ? lambda * trace : 0.0);
}

/* Patch test: a velocity linear in X makes the stress that Hooke's law says at every particle, on the surface too. */
static void patch(void)
{
    static const char motion[] = "initial = { velocity = function(X, Y, Z)\n"
                                 "    return first(2 * X + Y - Z, Y + 3 * Z, X - 2 * Z) end }\n";
    for (int b = 0; b < BODIES; b++) {
        struct sample sample = of_body(&bodies[b], motion, "integrator=euler");
        advance(&sample, 1);
        struct solver_output output = output_of(&sample);
        size_t dim = (size_t)bodies[b].dim;
        double worst = 0.0;
        for (size_t k = 0; k < output.cloud->count * dim * dim; k++) {
            double stress = stress_of(bodies[b].dim, k / dim % dim, k % dim);
            worst = fmax(worst, fabs(output.P[k] / output.time - stress));
        }
        CU_ASSERT(output.cloud->count > 0 && output.time > 0.0);
        expect_below(bodies[b].name, worst, 1e-11);
        finish(&sample);
    }
}

/* The same displacement, held by the tractions of its stress on curved and plane faces. */
static const char stretched[] =
    "local mu, lambda = 3 / 2.6, 3 * 0.3 / (1.3 * 0.4)\n"
    "local trace = d == 2 and 3 or 1\n"
    "local Pxx, Pyy, Pzz = 4 * mu + lambda * trace, 2 * mu + lambda * trace, -4 * mu + lambda * trace\n"
    "local Pxy, Pxz, Pyz = mu, 0, 3 * mu\n"
    "local function pull(x, y, z)\n"
    "    return first(Pxx * x + Pxy * y + Pxz * z, Pxy * x + Pyy * y + Pyz * z, Pxz * x + Pyz * y + Pzz * z) end\n"
    "initial = {\n"
    "    displacement = function(X, Y, Z) return first(2 * X + Y - Z, Y + 3 * Z, X - 2 * Z) end,\n"
    "    F = function() if d == 2 then return 3, 1, 0, 2 end return 3, 1, -1, 0, 2, 3, 1, 0, -1 end }\n";
static const char held_around[] =
    "faces = { surface = { kind = 'traction', value = function(X, Y, Z) return pull(N(X, Y, Z)) end } }\n";
static const char held_everywhere[] =
    "faces = { surface = { kind = 'traction', value = function(X, Y, Z) return pull(N(X, Y, Z)) end },\n"
    "          Z0 = { kind = 'traction', value = function() return pull(0, 0, -1) end },\n"
    "          Z1 = { kind = 'traction', value = function() return pull(0, 0, 1) end } }\n";

/* Largest speed after some steps. */
static double speed(const struct body *body, const char *faces)
{
    char text[2048];
    int length = snprintf(text, sizeof text, "%s%s", stretched, faces);
    CU_ASSERT_FATAL(length > 0 && (size_t)length < sizeof text);
    struct sample sample = of_body(body, text, "");
    advance(&sample, 20);
    struct solver_output output = output_of(&sample);
    double worst = 0.0;
    for (size_t k = 0; k < output.cloud->count * (size_t)body->dim; k++) {
        worst = fmax(worst, fabs(output.v[k]));
    }
    finish(&sample);
    return worst;
}

/* A constant stress is at rest under its own tractions, and not without them. */
static void equilibrium(void)
{
    for (int b = 0; b < BODIES && bodies[b].exact; b++) {
        bool cylinder = strcmp(bodies[b].name, "cylinder") == 0;
        expect_below(bodies[b].name, speed(&bodies[b], cylinder ? held_everywhere : held_around), 1e-10);
        CU_ASSERT(speed(&bodies[b], "") > 0.1);
    }
}

/* A free body keeps its momenta: the linear one to round-off. */
static void momentum(void)
{
    for (int b = 0; b < BODIES; b++) {
        struct sample sample = of_body(&bodies[b], smooth_motion, "");
        advance_to(&sample, 0.5);
        const struct solver_history *history = solver_run_history(sample.run);
        const struct solver_totals *begin = &history->totals[0], *end = &history->totals[history->count - 1];
        CU_ASSERT(end->strain > 1e-4 * begin->kinetic && end->kinetic + end->strain <= begin->kinetic);
        for (int i = 0; i < 3; i++) {
            expect_below(bodies[b].name, fabs(end->linear[i] - begin->linear[i]) / fabs(begin->linear[0]), 1e-13);
        }
        finish(&sample);
    }
}

/* A clamped surface does not move, and a moved one moves as its formula says; the inside follows. */
static void held_and_moved(void)
{
    for (int b = 0; b < BODIES; b++) {
        size_t dim = (size_t)bodies[b].dim;
        struct sample clamped = of_body(&bodies[b],
                                        "faces = { surface = 'clamped' }\n"
                                        "body_force = function() return first(1, 2, 3) end\n",
                                        "");
        struct sample moved = of_body(&bodies[b],
                                      "faces = { surface = { kind = 'motion', value = function(X, Y, Z, t)\n"
                                      "    return first(X + t, Y * Y, t) end } }\n",
                                      "");
        advance(&clamped, 10);
        advance(&moved, 10);
        struct solver_output still = output_of(&clamped), driven = output_of(&moved);
        size_t on_surface = 0, inside = 0;
        for (size_t a = 0; a < still.cloud->count; a++) {
            const double *X = driven.cloud->X + a * dim, *v = driven.v + a * dim;
            bool on = still.cloud->tags[a] >> SOLVER_SURFACE & 1U;
            on_surface += on;
            inside += !on && fabs(still.v[a * dim]) > 1e-6 && fabs(v[0]) > 1e-6;
            CU_ASSERT(!on || (still.v[a * dim] == 0.0 && still.u[a * dim + 1] == 0.0));
            CU_ASSERT(!on || (fabs(v[0] - X[0] - driven.time) < 1e-14 && fabs(v[1] - X[1] * X[1]) < 1e-14));
        }
        CU_ASSERT(on_surface > 20 && inside + 40 > still.cloud->count - on_surface && inside > 0);
        finish(&clamped);
        finish(&moved);
    }
}

/* Stencils along lattice lines are refused when the run is made, by name. */
static void lattice_stencils(void)
{
    for (int b = 0; b < BODIES; b++) {
        struct solver_error error = refusal(bodies[b].domain, "dim=%d stencil=sbp4", bodies[b].dim);
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "stencil: sbp4 works along the lines of a box's lattice"));
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"patch of a constant velocity gradient", patch},
        {"equilibrium under tractions", equilibrium},
        {"linear momentum", momentum},
        {"held and moved surfaces", held_and_moved},
        {"lattice stencils", lattice_stencils},
    };
    return unit_main("runs of round bodies", tests, sizeof tests / sizeof *tests);
}
