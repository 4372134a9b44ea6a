#include "oracles/j2_check.h"

#include <math.h>
#include <string.h>

enum { PLACES = 64 };
static const double ON_SURFACE = 1e-12; /* relative to yield stress and stress, whose mean hides its deviator */

double j2_plastic_work(const struct j2 *material, double plastic)
{
    return (material->yield + material->hardening * plastic / 2) * plastic;
}

static double equivalent_stress(const struct self_check *check, const struct oracle_state *state)
{
    double sigma[9];
    oracle_cauchy(check->kind, state, sigma);
    return j2_equivalent(sigma) * (check->kind->finite_strain ? oracle_jacobian(state) : 1);
}

void j2_check(struct self_check *check, const struct j2 *material, j2_map *map)
{
    double plastic = 0, yield = 0, surface = 0, size = 0;
    for (size_t i = 0; i < PLACES; i++) {
        struct self_check_spot spot = self_check_sample(check, i, SELF_CHECK_REACH);
        struct oracle_state state, along;
        struct j2_state mapped;
        double value[ORACLE_EXTRAS], G[9] = {0};
        check->kind->state(check->oracle, spot.X, spot.t, &state);
        check->kind->extras(check->oracle, spot.X, spot.t, value);
        for (int j = 0; j < check->kind->dim; j++) {
            self_check_derivative(check, &spot, j, &along);
            for (int k = 0; k < 3; k++) {
                G[3 * k + j] = along.u[k];
            }
        }
        bool flows = map(check, spot.t, G, &mapped);
        double limit = material->yield + material->hardening * mapped.plastic, gradient = 0, stress = 0;
        self_check_largest(&gradient, G, 9);
        double rise = material->hardening * gradient, over = equivalent_stress(check, &state) - value[J2_YIELD_STRESS];
        size = self_check_worse(size, gradient);
        plastic = self_check_worse(plastic, spot.step * fabs(value[J2_PLASTIC_STRAIN] - mapped.plastic));
        yield = self_check_worse(yield, spot.step * fabs(value[J2_YIELD_STRESS] - limit) / (limit + rise));
        self_check_largest(&stress, state.P, 9);
        surface = self_check_worse(surface, (flows ? fabs(over) : fmax(0, over)) / (limit + stress));
    }
    double bound = 16 * self_check_round_off(check) / SELF_CHECK_STEP;
    self_check_line(check, "plastic strain = return map", self_check_relative(plastic, size), bound);
    self_check_line(check, "yield stress = hardening law", yield, bound);
    self_check_line(check, "equivalent stress on or within the yield surface", surface, ON_SURFACE);
}
