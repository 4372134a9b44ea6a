/* Materials: strain energy per unit reference volume W(F, H, J), convex in its arguments, with what follows from it.
 *
 * Functions exist per dimension. F, H and P are the in-plane [dim][dim] blocks, row by row; below 3D the body is in
 * plane (2D) or uniaxial (1D) strain: F is the identity out of the plane. A material with `linear` kinematics uses the
 * linearised cofactor and Jacobian, J = 1 + tr(F - I), so that it is the linearisation of every evolved set. */
#ifndef SOLVER_MATERIAL_H
#define SOLVER_MATERIAL_H

#include "solver/hardening.h"

#include <stdbool.h>
#include <stddef.h>

struct solver_material_constants {
    double rho;               /* [kg/m^3] */
    double mu, lambda, kappa; /* shear, Lame's first and bulk modulus [Pa] */
    double cp, cs;            /* p- and s-wave speed at rest [m/s] */
    double zp, zs;            /* impedances rho cp, rho cs [kg/(m^2 s)] */
};

/* Young's moduli [Pa] and densities [kg/m^3] are within this of one: scene_range.c says why. */
static const double solver_material_most = 1e50;

/* Where constants are an array over particles, `stride` is 1, and 0 where one entry serves all. */

/* From Young's modulus [Pa], Poisson's ratio in (-1, 0.5) and density [kg/m^3]. */
struct solver_material_constants solver_material_constants(double E, double nu, double rho);

static inline bool solver_material_same(const struct solver_material_constants *a,
                                        const struct solver_material_constants *b)
{
    return a->rho == b->rho && a->mu == b->mu && a->kappa == b->kappa;
}

/* Plastic flow. What a particle remembers are `width` numbers, all zero in the virgin material: the equivalent plastic
 * strain, then the components of the inverse plastic right Cauchy-Green tensor less the identity, Cp^-1 - 1: xx, zz in
 * 1D (yy is zz); xx, yy, xy, zz in 2D; xx, yy, zz, xy, yz, zx in 3D. With none of it, stresses and energies are those
 * of the elastic material. */
struct solver_flow {
    size_t width;
    /* The hot loop: stress of particles begin to end - 1 (as stress_range), and what they then remember, `now`, from
     * what they remembered `before`, by one return map from there to F. Both are [count][width]. */
    void (*stress_range)(const struct solver_material_constants *material, size_t stride,
                         const struct solver_hardening *hardening, size_t begin, size_t end, const double *F,
                         const double *H, const double *J, const double *before, double *now, double *P);
    /* Operations of one particle's (cost.h), with H and J of its own or those of F. */
    int (*stress_flops)(bool H, bool J);
    int fastest_flops, energy_flops;
    /* Elastic energy [J/m^3]. */
    double (*energy)(const struct solver_material_constants *material, const double *F, double J, const double *now);
    /* The component of P normal to the plane [Pa]; below 3D only. */
    double (*stress_normal)(const struct solver_material_constants *material, const double *F, double J,
                            const double *now);
    /* An upper bound of the speeds [m/s] of elastic waves; plastic ones are slower. */
    double (*fastest)(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                      const double *F, const double *now);
};

struct solver_material {
    bool linear;
    const struct solver_flow *flow; /* NULL: it knows no plastic flow */
    /* W [J/m^3] */
    double (*energy)(const struct solver_material_constants *material, const double *F, const double *H, double J);
    /* P = dW/dF + dW/dH x F + dW/dJ H [Pa] */
    void (*stress)(const struct solver_material_constants *material, const double *F, const double *H, double J,
                   double *P);
    /* The component of P normal to the plane [Pa]; below 3D only. */
    double (*stress_normal)(const struct solver_material_constants *material, const double *F, double J);
    /* A_iIjJ = dP_iI/dF_jJ with H = cof F, J = det F: [dim]^4 [Pa] */
    void (*tangent)(const struct solver_material_constants *material, const double *F, double *A);
    /* Speeds [m/s] of the dim plane waves along the reference direction N, increasing; 0 for one that does not run
     * because the material has lost its ellipticity. */
    void (*wave_speeds)(const struct solver_material_constants *material, const double *F, const double *N,
                        double *speeds);
    /* The hot loop: P of particles begin to end - 1, padded columns (dim.h). H, J NULL: those of F. */
    void (*stress_range)(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                         const double *F, const double *H, const double *J, double *P);
    /* Volumetric stress U'(J) [Pa] of particles begin to end - 1. */
    void (*volumetric_range)(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                             const double *J, double *pressure);
    /* U''(J) / kappa of particles begin to end - 1, 0 where it is below that. NULL: it is 1 throughout. */
    void (*stiffness_range)(size_t begin, size_t end, const double *J, double *stiffness);
    /* Operations of one particle's (cost.h), with H and J of its own or those of F. */
    int (*stress_flops)(bool H, bool J);
    int volumetric_flops, stiffness_flops, fastest_flops, energy_flops;
    int composite_flops; /* what `fastest` takes besides in a composite body */
    /* An upper bound, above zero, of the wave speeds [m/s] in all directions over particles begin to end - 1; exact at
     * rest. */
    double (*fastest)(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                      const double *F);
};

struct solver_material_model {
    const char *name, *summary;
    const struct solver_material *in[3]; /* for 1, 2, 3 dimensions */
};

/* The table for the path in use (path.h), ends with a NULL name. */
const struct solver_material_model *solver_material_models(void);
const struct solver_material_model *solver_material_find(const char *name);

#endif
