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
                struct sample sample = start(BAR, "dim=%d n=%d integrator=%s gap=%g evolved=pF cfl=0.2 history=1000", dim,
                                             dim == 3 ? 6 : 12, by->name, gaps[g]);
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

static struct rebound rebound_of(const char *scheme, int n, double gap)
{
    struct sample sample = start(BAR, "dim=1 n=%d gap=%g scheme=%s stencil=sbp4 evolved=pF integrator=rk4 cfl=0.4 "
                                      "history=100000 t_end=4",
                                 n, gap, scheme);
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
 * with rho c v0, and part as they came. */
static void rebound(void)
{
    static const char *const schemes[] = {"upwind", "jst"};
    for (int s = 0; s < 2; s++) {
        for (int g = 0; g < 2; g++) {
            double gap = g == 0 ? 0 : 0.5 * v0; /* met at t = 0.5 */
            struct rebound coarse = rebound_of(schemes[s], 50, gap), fine = rebound_of(schemes[s], 200, gap);
            printf("\n    %s: begin %.4f end %.4f impulse/v0 %.6f velocity/v0 %.6f rise %.1e lost %.2e -> %.2e", schemes[s],
                   fine.begin, fine.end, fine.impulse / v0, fine.velocity / v0, fine.rise, coarse.lost, fine.lost);
            expect_below("first contact", fabs(fine.begin - gap / v0), 0.01);
            expect_below("contact time / (2 L / c) - 1", fabs((fine.end - fine.begin) / 2 - 1), 0.02);
            expect_below("impulse / (2 m v0) - 1", fabs(fine.impulse / (2 * v0) - 1), 0.005);
            expect_below("exit velocity / v0 - 1", fabs(fine.velocity / v0 - 1), 0.01);
            expect_below("energy gained", fmax(coarse.rise, fine.rise), 1e-9);
            expect_below("energy lost", fine.lost, 0.02);
            expect_below("what is lost as n is multiplied by 4", fine.lost / coarse.lost, 0.5);
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"momentum of body and wall", momentum_and_place},
        {"rebound of a bar", rebound},
    };
    return unit_main("solver wall", tests, sizeof tests / sizeof *tests);
}
