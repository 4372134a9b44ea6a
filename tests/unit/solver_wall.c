/* Impact on a rigid wall: what is handed over, when it ends, and what is refused. */
#include "solver/integrator.h"
#include "solver/record.h"
#include "tests/unit/runs.h"

/* A bar of length 1 and wave speed 1 that flies along X at 1 towards a wall `gap` away from its end. */
#define BAR                                                                                                            \
    "parameters = { gap = 0, v0 = 1e-3 }\n"                                                                            \
    "material = { model = 'linear-elastic', E = 1, nu = 0, rho = 1 }\n"                                                \
    "initial = { velocity = function() return first(-v0, 0, 0) end }\n"                                                \
    "rigid_wall = { point = each(-gap), normal = { first(1, 0, 0) } }\n"

static const double v0 = 1e-3;

static double largest_behind(const struct solver_output *output, double wall)
{
    double most = 0;
    size_t dim = (size_t)output->cloud->dim;
    for (size_t a = 0; a < output->cloud->count; a++) {
        most = fmax(most, wall - output->cloud->X[a * dim] - output->u[a * dim]);
    }
    return most;
}

/* Momentum of body and wall is what it was, to round-off, and no particle is ever behind the wall: by every integrator,
 * with the bar at the wall or on its way to it. */
static void momentum_and_place(void)
{
    static const double gaps[] = {0, 1.7e-4};
    for (const struct solver_integrator *by = solver_integrators(); by->name != NULL; by++) {
        for (int g = 0; g < 2; g++) {
            for (int dim = 1; dim <= 3; dim++) {
                struct sample sample = start(BAR, "dim=%d n=%d integrator=%s gap=%g evolved=pF cfl=0.2 history=1000",
                                             dim, dim == 3 ? 6 : 12, by->name, gaps[g]);
                double off = 0, behind = 0;
                for (int part = 1; part <= 24; part++) {
                    advance_to(&sample, 0.1 * part);
                    struct solver_output output = output_of(&sample);
                    behind = fmax(behind, largest_behind(&output, -gaps[g]));
                }
                const struct solver_history *history = solver_run_history(sample.run);
                CU_ASSERT(history->walled);
                for (size_t row = 0; row < history->count; row++) {
                    const struct solver_totals *at = &history->totals[row];
                    off = fmax(off, fabs(at->linear[0] + at->wall[0] + v0) / v0);
                    CU_ASSERT(at->wall[0] <= 0 && at->wall[1] == 0 && at->wall[2] == 0);
                }
                expect_below("momentum of bar and wall", off, 1e-13);
                expect_below("way behind the wall / (v0 t)", behind / v0, 1e-14);
                CU_ASSERT(history->totals[history->count - 1].wall[0] < -1.5 * v0);
                finish(&sample);
            }
        }
    }
}

/* Times at which the wall is first and last pushed, and the rest, of a bar of n spacings. */
struct rebound {
    double begin, end, impulse, velocity, rise, lost;
};

static struct rebound rebound_of(const char *how, int n, double gap)
{
    struct sample sample = start(BAR, "dim=1 n=%d gap=%g evolved=pF cfl=0.4 history=100000 t_end=4 %s", n, gap, how);
    struct rebound found = {.begin = NAN, .end = NAN};
    advance_to(&sample, 4);
    const struct solver_history *history = solver_run_history(sample.run);
    const struct solver_totals *last = &history->totals[history->count - 1];
    double lowest = INFINITY;
    for (size_t row = 0; row < history->count; row++) {
        const struct solver_totals *at = &history->totals[row];
        double pushed = row > 0 ? at->wall[0] - at[-1].wall[0] : 0;
        double energy = (at->kinetic + at->strain) / (0.5 * v0 * v0);
        lowest = fmin(lowest, energy);
        found.rise = fmax(found.rise, energy - lowest);
        if (fabs(pushed) > 0.1 * v0 * (row > 0 ? at->time - at[-1].time : 0)) { /* full push: v0 per time */
            found.begin = isnan(found.begin) ? at[-1].time : found.begin;
            found.end = at->time;
        }
    }
    found.impulse = -last->wall[0];
    found.velocity = last->linear[0];
    found.lost = 1 - (last->kinetic + last->strain) / (0.5 * v0 * v0);
    finish(&sample);
    return found;
}

/* The exact answer is that of two equal bars that meet, each being the other's wall: they press each other for 2 L / c,
 * with rho c v0, and part as they came. The slopes of `sbp4` at an end that is stopped at once let Upwind's dissipation
 * feed in 1.2e-5 of the energy at n = 200, a first-order error that the wall has no part in: without reconstruction, or
 * with JST, there is none. */
static void rebound(void)
{
    static const struct {
        const char *how;
        double gained, lost, order; /* bounds at n = 200; the jumps alone leave orders of 2/3, first order 1/2 */
    } cases[] = {{"stencil=sbp2 integrator=tvd-rk2", 1e-12, 0.0135, 0.6},
                 {"stencil=closed integrator=tvd-rk2", 1e-12, 0.0135, 0.6},
                 {"stencil=sbp4 integrator=rk4", 1.5e-5, 0.0096, 0.75},
                 {"stencil=sbp4 integrator=rk4 reconstruction=none", 1e-12, 0.073, 0.48},
                 {"stencil=sbp4 integrator=rk4 scheme=jst", 1e-12, 0.0085, 0.75}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        for (int g = 0; g < 2; g++) {
            double gap = g == 0 ? 0 : 0.5 * v0; /* met at t = 0.5 */
            struct rebound coarse = rebound_of(cases[c].how, 50, gap), fine = rebound_of(cases[c].how, 200, gap);
            printf("\n    %s: %.4f to %.4f, impulse %.4f, velocity %.4f, gained %.1e, lost %.2e -> %.2e", cases[c].how,
                   fine.begin, fine.end, fine.impulse / v0, fine.velocity / v0, fine.rise, coarse.lost, fine.lost);
            expect_below("first contact", fabs(fine.begin - gap / v0), 0.005);
            expect_below("contact time / (2 L / c) - 1", fabs((fine.end - fine.begin) / 2 - 1), 0.005);
            expect_below("impulse / (2 m v0) - 1", fabs(fine.impulse / (2 * v0) - 1), 0.5 * cases[c].lost);
            expect_below("exit velocity / v0 - 1", fabs(fine.velocity / v0 - 1), cases[c].lost);
            expect_below("energy gained", fine.rise, cases[c].gained);
            expect_below("energy lost", fine.lost, cases[c].lost);
            expect_below("- order of what is lost", -log(coarse.lost / fine.lost) / log(4), -cases[c].order);
        }
    }
}

/* A block that falls upon an oblique wall, with a corner first, and turns: the wall pushes along its normal alone, the
 * momentum adds up, and threads change nothing, to the bit. */
static void oblique(void)
{
    static const char more[] = "initial = { velocity = function() return first(0.01, -0.2, 0) end }\n"
                               "rigid_wall = { point = each(-0.05), normal = { first(0.6, 0.8, 0) } }\n";
    for (int dim = 2; dim <= 3; dim++) {
        struct solver_totals last[2];
        for (int t = 0; t < 2; t++) {
            struct sample sample = start(more, "dim=%d n=6 stencil=closed threads=%d t_end=2", dim, t == 0 ? 1 : 3);
            advance_to(&sample, 2);
            struct solver_output output = output_of(&sample);
            const struct solver_history *history = solver_run_history(sample.run);
            last[t] = history->totals[history->count - 1];
            const double *first = history->totals[0].linear;
            double nearest = INFINITY;
            for (size_t a = 0; a < output.cloud->count; a++) {
                const double *X = output.cloud->X + a * (size_t)dim, *u = output.u + a * (size_t)dim;
                nearest = fmin(nearest, 0.6 * (X[0] + u[0] + 0.05) + 0.8 * (X[1] + u[1] + 0.05));
            }
            expect_below("way behind the wall", -nearest, 1e-14);
            for (size_t i = 0; i < 3; i++) {
                expect_below("momentum", fabs(last[t].linear[i] + last[t].wall[i] - first[i]), 1e-13);
            }
            CU_ASSERT(last[t].wall[1] < -0.1);
            CU_ASSERT_DOUBLE_EQUAL(last[t].wall[0], 0.75 * last[t].wall[1], 1e-14);
            finish(&sample);
        }
        for (size_t i = 0; i < 3; i++) {
            CU_ASSERT_EQUAL(last[0].linear[i], last[1].linear[i]);
            CU_ASSERT_EQUAL(last[0].wall[i], last[1].wall[i]);
        }
        CU_ASSERT_EQUAL(last[0].kinetic, last[1].kinetic);
        CU_ASSERT_EQUAL(last[0].strain, last[1].strain);
    }
}

/* A wall that a body leaves, or never meets, changes nothing. */
static void out_of_reach(void)
{
    static const char far[] = "rigid_wall = { point = each(-1), normal = { first(1, 0, 0) } }\n"
                              "initial = { velocity = function(X) return first(0.1 * X, 0.05, 0) end }\n";
    static const char none[] = "initial = { velocity = function(X) return first(0.1 * X, 0.05, 0) end }\n";
    for (int dim = 1; dim <= 3; dim++) {
        struct sample with = start(far, "dim=%d", dim), without = start(none, "dim=%d", dim);
        advance_to(&with, 1);
        advance_to(&without, 1);
        struct solver_output left = output_of(&with), right = output_of(&without);
        CU_ASSERT_EQUAL(memcmp(left.v, right.v, left.cloud->count * (size_t)dim * sizeof *left.v), 0);
        CU_ASSERT(solver_run_history(with.run)->walled && !solver_run_history(without.run)->walled);
        finish(&with);
        finish(&without);
    }
}

/* Faces that hold a particle across the normal leave it to the wall, those along it keep it. */
static void beside_faces(void)
{
    static const char more[] = "faces = { X0 = 'symmetric', Y1 = 'clamped' }\n"
                               "initial = { velocity = function(X, Y) return first(0, Y - 1, 0) end }\n"
                               "rigid_wall = { point = { 0, -0.02 }, normal = { 0, 3 } }\n";
    struct sample sample = start(more, "dim=2 t_end=1");
    double behind = 0;
    for (int part = 1; part <= 10; part++) {
        advance_to(&sample, 0.1 * part);
        struct solver_output output = output_of(&sample);
        for (size_t a = 0; a < output.cloud->count; a++) {
            behind = fmax(behind, -0.02 - output.cloud->X[2 * a + 1] - output.u[2 * a + 1]);
            CU_ASSERT(output.cloud->X[2 * a] > 0 || output.v[2 * a] == 0);
            CU_ASSERT(output.cloud->X[2 * a + 1] < 1 || output.v[2 * a + 1] == 0);
        }
    }
    const struct solver_history *history = solver_run_history(sample.run);
    expect_below("way behind the wall", behind, 1e-14);
    CU_ASSERT(history->totals[history->count - 1].wall[1] < 0);
    finish(&sample);
}

static void refused(const char *more, const char *overrides, const char *expected)
{
    struct solver_error error = refusal(more, "%s", overrides);
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, expected));
    if (strstr(error.text, expected) == NULL) {
        printf("\n    %s", error.text);
    }
}

#define WALL "rigid_wall = { point = each(0), normal = { first(1, 0, 0) } }\n"

static void refusals(void)
{
    refused(WALL, "dim=2 rigid_wall.point={0.25,0}",
            "the body reaches 0.25 m behind the wall; expected all of it on the");
    refused(WALL, "dim=2 rigid_wall.normal={-1,0}", "the body reaches 1 m behind the wall");
    refused(WALL "initial = { displacement = function() return first(-0.1, 0, 0) end }\n", "dim=3",
            "the body reaches 0.1 m behind the wall");
    refused(WALL, "dim=2 scheme=ulsph material.model=linear-elastic", "expected scheme = \"upwind\" or \"jst\"");
    refused(WALL, "dim=2 stencil=sph lattice=centres", "expected lattice = \"nodes\"");
    refused(WALL "faces = { Y0 = 'symmetric' }\n", "dim=2 rigid_wall.normal={3,4}", "along the wall's normal in part");
    refused(WALL
            "faces = { X0 = { kind = 'motion', value = function() return first(0, 0, 0) end, free_after = 0.5 } }\n",
            "dim=1", "along the wall's normal for a time");
    refused(WALL "faces = { X0 = 'clamped', X1 = 'clamped' }\n", "dim=1", "hold or move all of the surface");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"momentum of body and wall", momentum_and_place},
        {"rebound of a bar", rebound},
        {"oblique wall", oblique},
        {"wall out of reach", out_of_reach},
        {"wall beside faces", beside_faces},
        {"refusals", refusals},
    };
    return unit_main("solver wall", tests, sizeof tests / sizeof *tests);
}
