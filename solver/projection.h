/* Discrete angular momentum kept exactly (000_e9ec29e1bde7947d.txt, Appendix B): the forces that a scheme finds within
 * the body are corrected by the least change, in the norm sum_a V_a |.|^2, after which they have no resultant and no
 * moment about the positions that count.
 *
 * Which positions count. Velocity and position take the same Runge-Kutta step with weights b and matrix A, x' = v,
 * v' = a, so that the angular momentum changes over it by exactly
 *
 *     dt sum_j b_j sum_a m_a X_j x a_j,   X_j = x + dt (1 - d_j / b_j) v + dt^2 sum_{k<j} (d_k - d_j b_k / b_j) a_k,
 *
 * x and v at its start, d_k = sum_i b_i A_ik; those of the last stage are the positions at the end of the step. For
 * tvd-rk2 these are the printed ones (B.1), x^n and x^{n+1}. With others they are not near those of the stage (ssp-rk3:
 * X_1 = x - dt v), and moments set to zero about them would cost the integrator its order. So all stages but the last
 * are corrected about the positions they have, where forces of an exact solution have no moment, and the last, which
 * knows x^{n+1}, takes what remains to the angular momentum that the step must end with: that at its start, and
 * dt sum_j b_j times the moment that loads have at stage j. For tvd-rk2 and euler that is (B.1); what the last stage
 * is left is of the integrator's order.
 *
 * The printed method corrects internal force and dissipation one by one. The projection is linear and has one norm, so
 * that the two corrections add up to that of their sum, which is what is done here.
 *
 * Where faces hold or move particles, their reactions change the angular momentum, and there is none to end with. What
 * remains true is that internal forces have no moment, those on held particles included, which reactions then cancel:
 * there every stage is corrected about the positions it has. */
#ifndef SOLVER_PROJECTION_H
#define SOLVER_PROJECTION_H

#include "solver/faces.h"
#include "solver/integrator.h"
#include "solver/scheme.h"
#include "solver/state.h"

enum { SOLVER_PROJECTION_SUMS = 22 };

struct solver_projection {
    bool on;                        /* the scene asks for it; nothing below is set, and nothing done, unless it does */
    bool held, loaded;              /* faces hold or move particles; tractions or body forces act */
    const struct solver_body *body; /* the run's, as everything it points to */
    const double *V;                /* [count] */
    double *partial;                /* sums of each piece of work (pieces.h), added in order */
    double centre[3];               /* [m] near that of the body: sums are taken about it */
    double target[3];               /* [kg m^2/s] about the origin, what the step must end with */
    double noted[SOLVER_PROJECTION_SUMS]; /* of the state that the stage found, before loads */
};

/* Refuses (SOLVER_BAD_INPUT) where it means nothing: in 1D, for a scheme that does not claim it, for linear
 * kinematics, which tell no moment about where particles are, for several bodies, which have one each, and for walls.
 */
bool solver_projection_create(const struct solver_body *body, const struct solver_faces *faces, const double *V,
                              struct solver_projection *projection, struct solver_error *error);
void solver_projection_free(struct solver_projection *projection);

void solver_projection_arrays(const struct solver_projection *projection, struct solver_cost_arrays *arrays);
void solver_projection_terms(const struct solver_projection *projection, int stages, struct solver_cost_terms *terms);

/* Before loads are added to the rates of a stage. */
void solver_projection_note(struct solver_projection *projection, const struct solver_state *state,
                            const struct solver_stage *stage);
/* After that: corrects v_rate. Fails (SOLVER_BROKE_DOWN) if all particles lie on one line. */
bool solver_projection_act(struct solver_projection *projection, const struct solver_state *state,
                           const struct solver_stage *stage, bool last, double dt, struct solver_error *error);

/* For checkpoints (keep.h): the centre, which follows the body from step to step. */
bool solver_projection_keep(struct solver_projection *projection, struct solver_keeper *keeper,
                            struct solver_error *error);

#endif
