/* Two equations of state, with e = 0 and p = 0 at rest:
 *
 *     stiffened gas        p = (gamma - 1) rho e + c0^2 (rho - rho0),   c0^2 = gamma p_inf/rho0
 *     Mie and Grueneisen   p = pH + Gamma0 rho0 (e - pH eta/(2 rho0)),  pH = rho0 c0^2 eta/(1 - s eta)^2
 *
 * (002_14d97b0eb8740b66.txt, eq. 17, for the first, which is p = (gamma - 1) rho e' - gamma p_inf with e' counted from
 * where p is -gamma p_inf). With the three laws of Rankine and Hugoniot the first gives
 * U^2 - (gamma + 1)/2 U v - c0^2 = 0, the second, by its making, U = c0 + s v. */
#include "oracles/plate_impact.h"

#include <math.h>

/* A compression is known to the last digit of one, as F = 1 - eta is: so many times that may the pressure err. */
static const double MOST_MAGNIFIED = 500;

enum { GAMMA, P_INF };      /* of the stiffened gas */
enum { C0, SLOPE, GAMMA0 }; /* of Mie and Grueneisen */

static double stiffened_shock(const struct plate_impact_given *g)
{
    double half = (g->material[GAMMA] + 1) / 4 * g->v0;
    return half + sqrt(half * half + g->material[GAMMA] * g->material[P_INF] / g->rho);
}

static double stiffened_sound(const struct plate_impact_given *g, double eta, double p)
{
    return sqrt(g->material[GAMMA] * (p + g->material[P_INF]) / g->rho * (1 - eta));
}

static double stiffened_limit(const struct plate_impact_given *g)
{
    (void)g;
    return 1 - 1 / MOST_MAGNIFIED;
}

static double complex stiffened_pressure(const struct plate_impact_given *g, double complex eta, double complex e)
{
    return ((g->material[GAMMA] - 1) * g->rho * e + g->material[GAMMA] * g->material[P_INF] * eta) / (1 - eta);
}

static double linear_shock(const struct plate_impact_given *g)
{
    return g->material[C0] + g->material[SLOPE] * g->v0;
}

/* -dp/dV at constant entropy, on the Hugoniot curve, is rho0 (pH' (1 - Gamma0 eta/2) + Gamma0 pH/2). */
static double linear_sound(const struct plate_impact_given *g, double eta, double p)
{
    double rest = 1 - g->material[SLOPE] * eta, half = g->material[GAMMA0] / 2;
    double slope = g->rho * g->material[C0] * g->material[C0] * (1 + g->material[SLOPE] * eta) / (rest * rest * rest);
    return (1 - eta) * sqrt((slope * (1 - half * eta) + half * p) / g->rho);
}

/* Beyond 2/Gamma0 the curve that the equation of state is made from is not its Hugoniot curve. */
static double linear_limit(const struct plate_impact_given *g)
{
    return fmin(1 / fmax(1, g->material[SLOPE]) - 1 / MOST_MAGNIFIED,
                2 / fmax(2, g->material[GAMMA0])); /* either may be 0 */
}

static double complex linear_pressure(const struct plate_impact_given *g, double complex eta, double complex e)
{
    double complex rest = 1 - g->material[SLOPE] * eta;
    double complex hugoniot = g->rho * g->material[C0] * g->material[C0] * eta / (rest * rest);
    return hugoniot + g->material[GAMMA0] * (g->rho * e - hugoniot * eta / 2);
}

const struct plate_impact_eos plate_impact_stiffened_gas = {
    .shock_speed = stiffened_shock,
    .sound_speed = stiffened_sound,
    .limit = stiffened_limit,
    .pressure = stiffened_pressure,
    .coefficients = 2,
};

const struct plate_impact_eos plate_impact_mie_grueneisen = {
    .shock_speed = linear_shock,
    .sound_speed = linear_sound,
    .limit = linear_limit,
    .pressure = linear_pressure,
    .coefficients = 3,
};
