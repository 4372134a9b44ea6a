/* The pair loops of updated-Lagrangian SPH (001_363f711843f01da4.txt section 2 and 3), compiled per dimension. Fields
 * are padded columns (dim.h).
 *
 * Notation of the paper: r_ij = r_j - r_i, f_ij = f_j - f_i, V = m / rho the volume now, w the Wendland C2 kernel,
 * L the corrective matrix that makes gradients of linear fields exact. */
#ifndef SOLVER_ULSPH_H
#define SOLVER_ULSPH_H

#include "solver/cost.h"
#include "solver/material.h"
#include "solver/path.h"
#include "solver/scene.h"

#include <stddef.h>
#include <stdint.h>

struct solver_ulsph {
    /* Neighbours now, or a little farther apart than the kernel reaches: those beyond it count for nothing. */
    const size_t *row;
    const uint32_t *neighbour;
    double *pair; /* [pairs][DIM + 2]: r_ij, then s with grad_i w_ij = s r_ij, then w_ij */

    /* What the scene asks for. */
    const struct solver_material_constants *constants; /* [1], or [count] in a composite body */
    size_t stride;                                     /* 0, or 1 in a composite body */
    const double *mass;                                /* [count] [kg], per unit thickness in 2D */
    const double *full_mass;                           /* [count] of a whole cell: more than the mass where the particle
                                                          lies on a face of the body */
    const uint8_t *interface;                          /* planes where materials meet, as in the cloud; NULL: none */
    const uint32_t *site, *points;                     /* of the cloud, where there are such planes */
    double h, spacing;                                 /* smoothing length, particle spacing d0 [m] */
    struct solver_ulsph_terms terms;

    /* State; NULL where the scene does not ask for it. */
    double *v, *x, *rho, *S; /* evolved; S the deviatoric stress in the plane, or along the line */
    double *v_rate, *x_rate, *rho_rate, *S_rate;
    double *volume, *cell; /* [count] now: mass / rho, full_mass / rho; one array where no cell is cut */
    double *root_rho, *z;  /* [count] sqrt(rho), c0 rho^(3/2) (eq. 41) */
    double *L;             /* tensor; NULL: I */
    double *transport;     /* vector: transport velocity; v itself where xsph = 0 */
    double *sigma_L;       /* tensor: sigma L */
    double *tensile_L;     /* tensor: sigma+ L, sigma+ the tensile part (-R of the paper, turned back; its eq. 18 prints
                              R_xy with a plus where a rotation has a minus) */
    double *inner;         /* [count] colour C (eq. 52), then 1 within the body and 0 at and next to its surface */
    double *colour;
    double *v_gradient;   /* tensor (eq. 45) */
    double *rho_gradient; /* vector (eq. 35) */
};

/* p [Pa], positive in compression, at density rho: c0^2 (rho - rho0) with c0^2 = K / rho0 (eq. 5). */
static inline double solver_ulsph_pressure(const struct solver_material_constants *constants, double rho)
{
    return constants->kappa * (rho / constants->rho - 1.0);
}

struct solver_ulsph_loops {
    size_t lanes;
    /* What a particle has of its own: volumes, impedance. Before anything else. */
    void (*volumes)(const struct solver_ulsph *work, size_t begin, size_t end);
    /* Pair records, L, transport velocity, colour, and sigma L. Reads volumes of neighbours. */
    void (*geometry)(const struct solver_ulsph *work, size_t begin, size_t end);
    /* x_rate, rho_rate (eq. 27), S_rate (eq. 6), and what eq. 33, 44 and 51 need. Reads transport velocities and
     * colours of neighbours. */
    void (*gradients)(const struct solver_ulsph *work, size_t begin, size_t end);
    /* v_rate without loads (eq. 51), density diffusion. Reads gradients and stresses of neighbours. */
    void (*rates)(const struct solver_ulsph *work, size_t begin, size_t end);
    /* Operations (cost.h), of all particles. */
    void (*terms)(const struct solver_ulsph *work, size_t count, struct solver_cost_terms *terms);
    /* First particle in [begin, end) whose state is broken (NaN, or rho <= 0), else end. */
    size_t (*first_broken)(const struct solver_ulsph *work, size_t begin, size_t end);
};

SOLVER_DECLARE_LOOPS(struct solver_ulsph_loops, solver_ulsph);

#endif
