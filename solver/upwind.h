/* The pair loops of the mixed total-Lagrangian Upwind method (000_e9ec29e1bde7947d.txt section 3 and 4), compiled per
 * dimension. Fields are padded columns (dim.h). */
#ifndef SOLVER_UPWIND_H
#define SOLVER_UPWIND_H

#include "solver/cost.h"
#include "solver/material.h"
#include "solver/path.h"

#include <stddef.h>
#include <stdint.h>

struct solver_upwind {
    /* stencil (stencil.h) */
    const size_t *row;
    const uint32_t *neighbour;
    const double *pair, *transposed, *row_sum, *V;
    const float *narrow;         /* in place of pair where the precision is mixed; NULL: it is double */
    double unit;                 /* of narrow, and then of row_sum; else 1 */
    const double *least_squares; /* NULL: reconstruct with the stencil's own gradient */

    /* What the scene asks for. */
    const struct solver_material *material;
    const struct solver_material_constants *constants; /* [1], or [count] in a composite body */
    size_t stride;                                     /* 0, or 1 in a composite body */
    bool evolves_J;                                    /* {p,F,J} and {p,F,H,J} */
    bool evolves_H;                                    /* {p,F,H,J} */
    bool frozen;      /* linear kinematics: H = I in the equation of J, normals n = N */
    bool whole_jump;  /* dissipation of J by the jump of the whole stress, as printed in eq. 27 */
    bool reconstruct; /* linear reconstruction (eq. 34); without it the dissipation is of first order */
    const struct solver_hardening *hardening; /* NULL: nothing is plastic */

    /* State; NULL where the scene does not ask for it. The linear momentum p = rho v is evolved as the velocity, which
     * is continuous where materials meet. */
    double *v, *x, *F, *H, *J; /* evolved */
    double *v_rate, *x_rate, *F_rate, *H_rate, *J_rate;
    double *X;                    /* reference positions [m]; NULL where only their pair vectors are needed */
    double *P;                    /* stress */
    double *cofactor;             /* H, or cof F where H is not evolved but the equation of J needs it */
    double *v_gradient;           /* tensor: least-squares gradient of v; NULL: F_rate serves */
    double *pressure;             /* [count] U'(J); for the dissipation of J by its jump */
    double *stiffness;            /* [count] U''(J) / kappa, not below 0; NULL: it is 1 */
    double *pressure_gradient;    /* vector */
    double *P_gradient;           /* [count][DIM (derivative)] tensors; for the dissipation of J by the jump of P */
    double *lost;                 /* [count][2] what dissipation takes, as a power over the linear momentum [W], and the
                                     rate of J times V by it [m^dim/s]; NULL unless asked for */
    double *flown, *flown_before; /* [count][width] what a plastic material remembers (material.h), at the present F,
                                     and at the start of the step */
};

struct solver_upwind_loops {
    size_t lanes;
    /* F_rate = grad v (eq. 38b), x_rate = v, and the gradients that the reconstruction needs. */
    void (*gradients)(const struct solver_upwind *work, size_t begin, size_t end);
    /* v_rate without tractions and body forces (eq. 38a), H_rate, J_rate (eq. 38c, 38d). Reads the gradients of
     * neighbours: all of them must be there. */
    void (*rates)(const struct solver_upwind *work, size_t begin, size_t end);
    /* Stress and, where needed, cofactor, and what is remembered, from the state. */
    void (*stresses)(const struct solver_upwind *work, size_t begin, size_t end);
    /* First particle in [begin, end) whose state is broken (NaN, or J <= 0), else end. */
    size_t (*first_broken)(const struct solver_upwind *work, size_t begin, size_t end);
    /* Operations: of the gradients; of the rates; of stresses, checks and the step. */
    void (*gradient_terms)(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms);
    void (*rate_terms)(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms);
    void (*particle_terms)(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms);
    /* H and J of F, linearised for a material with linear kinematics; either may be NULL. */
    void (*measures)(bool linear, size_t begin, size_t end, const double *F, double *H, double *J);
};

SOLVER_DECLARE_LOOPS(struct solver_upwind_loops, solver_upwind);

#endif
