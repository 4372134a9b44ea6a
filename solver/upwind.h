/* The pair loops of the mixed total-Lagrangian Upwind method (000_e9ec29e1bde7947d.txt section 3 and 4), compiled per
 * dimension. Fields are padded columns (dim.h). */
#ifndef SOLVER_UPWIND_H
#define SOLVER_UPWIND_H

#include "solver/cost.h"
#include "solver/material.h"
#include "solver/path.h"

#include <stddef.h>
#include <stdint.h>

/* In single precision x is the displacement, F, H, the cofactor and J lack the identity, and X is measured from
 * somewhere within the body (state.h). */
#define SOLVER_WORK   solver_upwind
#define SOLVER_STORED double
#include "solver/upwind_work.h"
#undef SOLVER_WORK
#undef SOLVER_STORED
#define SOLVER_WORK   solver_upwind_single
#define SOLVER_STORED float
#include "solver/upwind_work.h"
#undef SOLVER_WORK
#undef SOLVER_STORED

struct solver_upwind_loops {
    size_t lanes;
    /* F_rate = grad v (eq. 38b), and the gradients that the reconstruction needs. */
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

/* Those that read neighbours, in single precision; the others are done in double, a few particles at a time. */
struct solver_upwind_single_loops {
    void (*gradients)(const struct solver_upwind_single *work, size_t begin, size_t end);
    void (*rates)(const struct solver_upwind_single *work, size_t begin, size_t end);
    void (*gradient_terms)(const struct solver_upwind_single *work, size_t count, struct solver_cost_terms *terms);
    void (*rate_terms)(const struct solver_upwind_single *work, size_t count, struct solver_cost_terms *terms);
    void (*particle_terms)(const struct solver_upwind_single *work, size_t count, struct solver_cost_terms *terms);
};

SOLVER_DECLARE_LOOPS(struct solver_upwind_loops, solver_upwind);
SOLVER_DECLARE_LOOPS(struct solver_upwind_single_loops, solver_upwind_single);

#endif
