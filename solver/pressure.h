/* Incompressible and nearly incompressible bodies by artificial compressibility (000_e9ec29e1bde7947d.txt section 5):
 * in place of J the pressure p is unknown, {p,F,p} and {p,F,H,p}.
 *
 * Predictor. The scheme itself, for a fictitious bulk modulus kappa~ (eq. 51): where a compressible body has J, this
 * one has 1 + p / kappa~, so that stresses, fluxes and time step are those of a body of that modulus.
 *
 * Corrector, after each Runge-Kutta stage, over the time tau in which the stage's rates act (eq. 45a, 49). With D v =
 * V H : grad v, and D^T q the force of a pressure q, both by the stencil and at the stage's end:
 *
 *     rho V (v - v_int) = -tau D^T (p - p_stage)           where v is free
 *     D v - S p = V (p - p_ref) / (kappa tau)
 *
 * p_stage is the pressure that the stage's forces had, p_ref what the integrator makes of the pressures before. To the
 * right is added what is not printed: the volume V (det F - 1 - p_stage / kappa) by which F has strayed from what the
 * pressure says, over -dt, times incompressible.restore: that share of it comes back within a step.
 *
 * S is incompressible.dissipation times the upwind dissipation of J by the jump of the pressure (eq. 30), at the new
 * pressure. Printed is that at the old one; where a pressure that alternates from particle to particle has no gradient,
 * the equations of a truly incompressible body then have no solution. S is the derivative of a sum of squares of
 * reconstructed jumps, and so symmetric, which the printed flux is only without reconstruction. The two balance where
 * V (det F - 1) = dt S p / restore: smooth pressures are paid for by volumes. Elimination of v gives the
 * equation of the increment, symmetric and positive:
 *
 *     (tau D M^-1 D^T + S + V / (kappa tau)) (p - p_stage) = D v_int - S p_stage - V (p_stage - p_ref) / (kappa tau)
 *
 * Solved by conjugate gradients ("poisson"), or by the printed iteration in pseudo-time (eq. 52, 53). Where the
 * velocity along the normal is prescribed all over the surface of an incompressible body, a constant pressure moves
 * nothing: its mean stays zero, and what the prescribed motion changes of the volume is spread evenly.
 *
 * The forces of the correction are equal and opposite in pairs. They have no moment where F is the gradient of x and H
 * its cofactor, as in {p,F,p}; an evolved H differs from it by the error of the integrator. */
#ifndef SOLVER_PRESSURE_H
#define SOLVER_PRESSURE_H

#include "solver/cost.h"
#include "solver/scheme.h"
#include "solver/stencil.h"
#include "solver/upwind.h"

/* Arrays belong to it. */
struct solver_pressure {
    const struct solver_body *body;
    const struct solver_stencil *stencil;
    const struct solver_upwind *work;
    const struct solver_pressure_loops *loops;
    struct solver_material_constants constants; /* of the predictor: kappa~ and the p-wave that goes with it */
    double dissipation;                         /* factor of S */
    double restore;                             /* share of a stray volume to be given back within a step */
    double compliance;                          /* 1 / kappa [1/Pa]; 0 in a truly incompressible body */
    double gamma, eta;                          /* of the pseudo-time: gamma [Pa], alpha / rho [m^3/kg] */

    double *p;                            /* [count] pressure [Pa] of the stresses that there are */
    double *increment;                    /* [SOLVER_STAGES][count] what each stage changed of it, last time */
    double *reference;                    /* [count] p_ref; NULL in a truly incompressible body */
    double *stray;                        /* [count] volume to be given back within a step [m^dim]; NULL: none */
    double *weight;                       /* [pairs] of the squared jump of the pressure, halved [m^(dim+2) s/kg] */
    double *mobility;                     /* [count][lanes] 1 / (2 rho V), 0 along an axis that is not free */
    double *acceleration;                 /* [count][lanes] of a pressure */
    double *slope;                        /* [count][lanes] its gradient, where the flux reconstructs */
    double *moment;                       /* [count][lanes] what the reconstructed fluxes give back to the gradient */
    double *residual;                     /* [count] */
    double *total;                        /* [count] pressure of a residual */
    double *direction, *image, *diagonal; /* [count] of conjugate gradients */
    double *predicted;                    /* [count][lanes] v_int */
    double *past_v, *past_p;              /* of the pseudo-time, else NULL */
    double *partial;                      /* sums of each piece of work (pieces.h), added in order */
    double volume;                        /* [m^dim] of the body */
    double laplacian;                     /* [1/m^2] largest diagonal of the Laplacian of the pseudo-time */
    double tau, step;                     /* [s] */
    bool sealed;                          /* a constant pressure moves nothing */
    size_t iterations, solved;            /* since the start, and in how many stages */
    size_t doubles;                       /* in all arrays */
};

struct solver_keeper;

struct solver_pressure_loops {
    size_t lanes;
    /* weight, of the present geometry. */
    void (*weights)(const struct solver_pressure *of, size_t begin, size_t end);
    /* Diagonal of the equation of the increment, less that of the reconstruction. */
    void (*diagonal)(const struct solver_pressure *of, size_t begin, size_t end);
    /* acceleration of the pressure q. */
    void (*accelerate)(const struct solver_pressure *of, const double *q, size_t begin, size_t end);
    /* slope of the pressure q. */
    void (*slopes)(const struct solver_pressure *of, const double *q, size_t begin, size_t end);
    /* out = factor D v - (S q without its last part), and moment. Reads the slopes of neighbours. */
    void (*balance)(const struct solver_pressure *of, const double *v, double factor, const double *q, double *out,
                    size_t begin, size_t end);
    /* out -= the last part of S q. Reads the moments of neighbours. */
    void (*give_back)(const struct solver_pressure *of, double *out, size_t begin, size_t end);
    /* stray, of the present F. */
    void (*strays)(const struct solver_pressure *of, size_t begin, size_t end);
    /* eta V times the Laplacian of q (eq. 58), added to out. */
    void (*spread)(const struct solver_pressure *of, const double *q, double eta, double *out, size_t begin,
                   size_t end);
    /* Operations (cost.h), where a stage takes so many iterations. */
    void (*terms)(const struct solver_pressure *of, double iterations, struct solver_cost_terms *terms);
};

SOLVER_DECLARE_LOOPS(struct solver_pressure_loops, solver_pressure);

/* Refuses (SOLVER_BAD_INPUT) what it cannot do, saying what to take instead. *pressure becomes NULL where the scene
 * does not ask for it. `work` needs its material and terms. */
bool solver_pressure_create(const struct solver_body *body, const struct solver_stencil *stencil,
                            const struct solver_upwind *work, struct solver_pressure **pressure,
                            struct solver_error *error);
void solver_pressure_free(struct solver_pressure *of);
/* Of NULL, nothing. Iterations are as many as stages have taken so far: none before the first step. */
void solver_pressure_arrays(const struct solver_pressure *of, struct solver_cost_arrays *arrays);
void solver_pressure_terms(const struct solver_pressure *of, struct solver_cost_terms *terms);

/* The initial pressures, from the Jacobians that the scheme has put in work->J. */
void solver_pressure_start(const struct solver_pressure *of);
/* Strain energy of particle a's change of volume [J/m^3]: p^2 / (2 kappa). */
double solver_pressure_energy(const struct solver_pressure *of, size_t a);
/* Before a step: the pressures are those of the state, whatever a step that failed has left. */
void solver_pressure_begin(const struct solver_pressure *of);
/* After a stage's update and the constraints of faces, at time t: corrects v and p, and what the integrator sums of
 * them. Fails (SOLVER_BROKE_DOWN) where the iteration does not reach its tolerance. */
bool solver_pressure_correct(struct solver_pressure *of, const struct solver_state *state,
                             const struct solver_integrator *integrator, int stage, double t, double dt,
                             struct solver_error *error);

/* For checkpoints (keep.h). */
bool solver_pressure_keep(struct solver_pressure *of, struct solver_keeper *keeper, struct solver_error *error);

#endif
