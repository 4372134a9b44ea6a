/* What pictures, files and norms see of the mixed total-Lagrangian methods: a particle's strains, stresses and
 * energies. */
#include "solver/pressure.h"
#include "solver/scheme_upwind.h"
#include "solver/symmetry.h"

#include <math.h>
#include <string.h>

/* A padded tensor of particle a, row by row. */
static void rows_of(const struct solver_upwind_system *system, const double *field, size_t a, double *rows)
{
    size_t dim = (size_t)system->body->cloud->dim;
    size_t lanes = system->loops->lanes;
    for (size_t i = 0; i < dim; i++) {
        for (size_t I = 0; I < dim; I++) {
            rows[i * dim + I] = field[(a * dim + I) * lanes + i];
        }
    }
}

/* F, and H and J: evolved, or those of F. */
static void measures_of(const struct solver_upwind_system *system, size_t a, struct solver_point *point)
{
    const struct solver_upwind *work = &system->work;
    size_t tensor = (size_t)system->body->cloud->dim * system->loops->lanes;
    double H[12] __attribute__((aligned(64)));
    double F[12] __attribute__((aligned(64)));
    double J;
    memcpy(F, work->F + a * tensor, tensor * sizeof *F);
    system->loops->measures(work->frozen, 0, 1, F, H, &J);
    rows_of(system, F, 0, point->F);
    rows_of(system, work->H != NULL ? work->H : H, work->H != NULL ? a : 0, point->H);
    point->J = work->J != NULL && system->pressure == NULL ? work->J[a] : J;
}

/* The Jacobian that the material is asked with: where a pressure stands in its place, the one that goes with it. */
static double material_J(const struct solver_upwind_system *system, size_t a, const struct solver_point *point)
{
    return system->pressure != NULL ? system->work.J[a] : point->J;
}

/* sigma = P F^T / J; with linear kinematics sigma = P. */
static void cauchy(const struct solver_upwind_system *system, struct solver_point *point)
{
    size_t dim = (size_t)system->body->cloud->dim;
    bool linear = system->work.frozen;
    memset(point->sigma, 0, sizeof point->sigma);
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            double *sigma = &point->sigma[3 * i + j];
            *sigma = linear ? point->P[i * dim + j] : 0.0;
            for (size_t I = 0; !linear && I < dim; I++) {
                *sigma += point->P[i * dim + I] * point->F[j * dim + I] / point->J;
            }
        }
    }
    for (size_t i = dim; i < 3; i++) {
        point->sigma[4 * i] = point->P_normal / (linear ? 1.0 : point->J);
    }
}

void solver_upwind_look(const void *of, size_t a, struct solver_point *point)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = &system->work;
    measures_of(system, a, point);
    rows_of(system, work->P, a, point->P);
    const struct solver_material_constants *constants = work->constants + a * work->stride;
    const double *memory = solver_upwind_memory(work, a);
    point->P_normal = 0.0;
    if (system->body->cloud->dim < 3) {
        point->P_normal = memory != NULL
                              ? work->material->flow->stress_normal(constants, point->F, point->J, memory)
                              : work->material->stress_normal(constants, point->F, material_J(system, a, point));
    }
    point->plastic_strain = memory != NULL ? memory[0] : 0.0;
    cauchy(system, point);
}

double solver_upwind_energy(const void *of, size_t a)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = &system->work;
    struct solver_point point;
    const struct solver_material_constants *constants = work->constants + a * work->stride;
    const double *memory = solver_upwind_memory(work, a);
    measures_of(system, a, &point);
    if (system->pressure != NULL) {
        return work->material->energy(constants, point.F, point.H, 1.0) + solver_pressure_energy(system->pressure, a);
    }
    return memory != NULL ? work->material->flow->energy(constants, point.F, point.J, memory)
                          : work->material->energy(constants, point.F, point.H, point.J);
}

double solver_upwind_dissipated(const void *of, size_t a)
{
    const struct solver_upwind_system *system = of;
    const double *memory = solver_upwind_memory(&system->work, a);
    return memory != NULL ? solver_hardening_work(system->work.hardening, memory[0]) : 0.0;
}

/* dW/dJ of particle a, by a central difference: W is smooth, and its error below 1e-9 of it. */
static double energy_by_J(const struct solver_upwind_system *system, size_t a)
{
    const struct solver_upwind *work = &system->work;
    const struct solver_material_constants *constants = work->constants + a * work->stride;
    const double *memory = solver_upwind_memory(work, a);
    struct solver_point point;
    double energy[2];
    measures_of(system, a, &point);
    double step = 1e-5 * point.J;
    for (int side = 0; side < 2; side++) {
        double J = point.J + (side == 0 ? -step : step);
        energy[side] = memory != NULL ? work->material->flow->energy(constants, point.F, J, memory)
                                      : work->material->energy(constants, point.F, point.H, J);
    }
    return (energy[1] - energy[0]) / (2.0 * step);
}

double solver_upwind_lost(const void *of)
{
    const struct solver_upwind_system *system = of;
    const struct solver_upwind *work = &system->work;
    const struct solver_stencil *stencil = system->stencil;
    double sum = 0.0;
    for (size_t a = 0; a < solver_cloud_driven(system->body->cloud); a++) { /* in order, whatever the threads */
        double power = work->lost[2 * a];
        if (work->evolves_J && work->lost[2 * a + 1] != 0.0) {
            power -= work->lost[2 * a + 1] * energy_by_J(system, a);
        }
        sum += stencil->own != NULL ? power * stencil->own[a] / stencil->V[a] : power;
    }
    return sum;
}
