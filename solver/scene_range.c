/* Units in which what is computed leaves the range of double precision are refused. With E and rho within 1e50 of one,
 * moduli within 1e66 (kappa is E / 1e-16 at most), and lengths within 1e30, all products do not: those of the largest
 * exponents are that of mass and energy, rho M L^6 <= 1e296, and sums over squares of stresses, M^2 L^3 <= 1e222; of
 * the smallest, h^6 >= 1e-180 of areas and volumes, and rho M h^6 >= 1e-280. */
#include "solver/material.h"
#include "solver/scene_internal.h"

static const double longest = 1e30;

/* A box has 2000000 spacings along an edge at most, and the reference length is one or what the scene calls so. */
static const double spacings = 2e6;

static void check(lua_State *L, const char *key, const char *unit, double value, double most)
{
    if (!(value >= 1.0 / most && value <= most))
        scene_refuse(
            L,
            "%s: products of moduli, densities and lengths would leave the range of double precision; expected "
            "number in [%g, %g] [%s], got %g; choose other units",
            key, 1.0 / most, most, unit, value);
}

void scene_check_range(lua_State *L, const struct solver_scene *scene)
{
    check(L, "material.E", "Pa", scene->E, solver_material_most);
    check(L, "material.rho", "kg/m^3", scene->rho, solver_material_most);
    check(L, "reference_length", "m", scene->reference_length, longest / spacings);
}
