/* The printed solution of the pressure's equation: velocity and pressure go to a steady state in a pseudo-time
 * (000_e9ec29e1bde7947d.txt eq. 48, 52 and, with the Laplacian, 53, 58), by the two-stage integrator of eq. 40:
 *
 *     dv/ds         = -M^-1 D^T (p - p_stage) - (v - v_int) / tau
 *     dp/ds / gamma = (D v - S p) / V - (p - p_ref) / (kappa tau) + eta Lap p,    eta = alpha dt / rho
 *
 * The Laplacian is of the pressure, not of its change: it stays in the steady state, where H : grad v = -eta Lap p. */
#include "solver/pieces.h"
#include "solver/pressure_solvers.h"

#include <math.h>
#include <string.h>

/* The longest stable pseudo-step: waves of speed sqrt(gamma / rho) cross as much of a spacing as those of the predictor
 * in a step; the velocity does not overshoot v_int; and twice the diagonal bounds what fluxes and Laplacian, sums of
 * differences, do at most (Gershgorin), doubled again for reconstruction. */
static double longest(const struct solver_pressure *of)
{
    const struct solver_upwind *work = of->work;
    double most = 0.0;
    for (size_t a = 0; a < of->stencil->count; a++) {
        double sum = 0.0;
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            sum += of->weight[ab];
        }
        most = fmax(most, (work->reconstruct ? 4.0 : 2.0) * sum / of->stencil->V[a]);
    }
    double spread = 2.0 * of->eta * of->step * of->laplacian;
    double wave = of->step * sqrt(of->constants.kappa / of->gamma);
    double damped = 1.5 / (of->gamma * (most + spread + of->compliance / of->tau));
    return fmin(fmin(wave, of->tau), damped);
}

/* One Euler step of size `by` of the pseudo-time. Returns what it found unbalanced, in the sense of the tolerance: the
 * volume of particles, and how far they would go astray within tau, as a share of the spacing. */
static double advance(const struct solver_pressure *of, double *increment, double by)
{
    size_t count = of->stencil->count;
    size_t lanes = of->loops->lanes;
    double *v = of->work->v;
    double astray = 0.0;
    solver_pressure_residual(of, increment, of->eta * of->step);
    double left = solver_pressure_left(of);
#pragma omp parallel for schedule(static) reduction(max : astray)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        of->loops->accelerate(of, increment, at.begin, at.end);
        for (size_t i = at.begin * lanes; i < at.end * lanes; i++) {
            double missing = of->predicted[i] + of->tau * of->acceleration[i] - v[i];
            astray = fmax(astray, fabs(missing));
            v[i] += by / of->tau * missing;
        }
    }
#pragma omp parallel for schedule(static)
    for (size_t a = 0; a < count; a++) {
        increment[a] += by * of->gamma * of->residual[a] / of->stencil->V[a];
    }
    return isnan(left) ? left : fmax(left, astray * of->tau / of->body->cloud->spacing);
}

bool solver_pressure_pseudo_time(struct solver_pressure *of, double *increment, struct solver_error *error)
{
    const struct solver_incompressible *asked = &of->body->scene->incompressible;
    size_t count = of->stencil->count;
    size_t entries = count * of->loops->lanes;
    double *v = of->work->v;
    double by = longest(of);
    solver_pressure_velocity(of, increment);
    for (int i = 0; i <= asked->iterations; i++) {
        memcpy(of->past_v, v, entries * sizeof *v);
        memcpy(of->past_p, increment, count * sizeof *increment);
        double left = advance(of, increment, by);
        if (left <= asked->tolerance) {
            memcpy(v, of->past_v, entries * sizeof *v); /* what was found to be steady */
            memcpy(increment, of->past_p, count * sizeof *increment);
            return true;
        }
        if (i == asked->iterations || isnan(left)) {
            return solver_pressure_give_up(of, left, error);
        }
        (void)advance(of, increment, by);
#pragma omp parallel for schedule(static)
        for (size_t k = 0; k < entries; k++) {
            v[k] = 0.5 * (v[k] + of->past_v[k]);
        }
#pragma omp parallel for schedule(static)
        for (size_t a = 0; a < count; a++) {
            increment[a] = 0.5 * (increment[a] + of->past_p[a]);
        }
        of->iterations++;
    }
    return false; /* not reached */
}
