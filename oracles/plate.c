#include "oracles/plate.h"
#include "oracles/kind.h"

#include <math.h>
#include <stdio.h>

enum { HIGHEST_MODE = 4 };
static const double SHORTEST = 4, LONGEST = 50; /* length / height */

const struct oracle_parameter plate_parameters[] = {
    {"L", "m", "length, 4 to 50 heights", 0, INFINITY, true, false, 0.2},
    {"H", "m", "height", 0, INFINITY, true, false, 0.02},
    {"mode", "-", "number of the bending mode, a whole number", 1, HIGHEST_MODE, false, false, 1},
    {"v_tip", "m/s", "velocity of the free end at t = 0; the source has 0.01 sqrt(K/rho)", -INFINITY, INFINITY, false,
     false, 0.57008771254957},
    {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, false, 1998447.2049689441},
    {"material.nu", "-", "Poisson's ratio", -0.9, 0.49, false, false, 0.39751552795031056},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 1000},
    {0},
};

bool plate_read(const double *value, struct plate *plate, char why[ORACLE_WHY])
{
    double slenderness = value[0] / value[1];
    if (!(slenderness >= SHORTEST && slenderness <= LONGEST)) {
        (void)snprintf(why, ORACLE_WHY,
                       "L = %.15g m is %g times H = %.15g m, but it must be %g to %g times; L = %g would do", value[0],
                       slenderness, value[1], SHORTEST, LONGEST, 10 * value[1]);
        return false;
    }
    if (value[2] != floor(value[2])) {
        (void)snprintf(why, ORACLE_WHY, "mode = %.15g, but it must be a whole number, 1 to %d; mode = 1 would do",
                       value[2], HIGHEST_MODE);
        return false;
    }
    *plate = (struct plate){.length = value[0],
                            .height = value[1],
                            .mode = (int)value[2],
                            .tip_velocity = value[3],
                            .E = value[4],
                            .nu = value[5],
                            .rho = value[6]};
    return true;
}

double plate_outside(const struct plate *plate, const double X[3])
{
    double half = plate->height / 2;
    return oracle_outside_box(2, (const double[]){0, -half}, (const double[]){plate->length, half}, X);
}

struct oracle_beam plate_beam(const struct plate *plate, bool plane_stress)
{
    return (struct oracle_beam){.length = plate->length,
                                .height = plate->height,
                                .E = plate->E,
                                .nu = plate->nu,
                                .rho = plate->rho,
                                .plane_stress = plane_stress};
}

struct ritz_problem plate_problem(const struct plate *plate, bool plane_stress)
{
    double nu = plate->nu;
    return (struct ritz_problem){.length = 2 * (plate->length / plate->height),
                                 .lambda = 2 * nu / (plane_stress ? 1 - nu : 1 - 2 * nu),
                                 .mode = plate->mode};
}

double plate_frequency(const struct plate *plate)
{
    double mu = plate->E / (2 * (1 + plate->nu));
    return sqrt(mu / plate->rho) / (plate->height / 2);
}

bool plate_solve(const struct plate *plate, bool plane_stress, struct ritz_limit *result, char why[ORACLE_WHY])
{
    static const struct ritz_mesh mesh = {
        .layers = 4, .tip_layers = 2, .grading = 0.12, .growth = 2, .corner = 6, .middle = 13};
    struct ritz_problem problem = plate_problem(plate, plane_stress);
    return ritz_converge(&problem, &mesh, result, why);
}
