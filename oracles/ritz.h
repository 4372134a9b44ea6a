/* Bending modes of a clamped rectangle in plane elasticity, by the method of Ritz on products of piecewise polynomials.
 *
 * The body is 0 <= x <= length, -1 <= y <= 1, clamped at x = 0 and free elsewhere, with mu = rho = 1: lengths are in
 * half heights, frequencies in units of sqrt(mu / rho) per half height. In a bending mode u_x is odd and u_y even in y,
 * so half the body is enough: u_x = 0 on y = 0.
 *
 * Stress is singular where the clamp meets a free face. Elements shrink geometrically towards that corner while their
 * degree falls, which makes the error fall exponentially with the number of layers (I. Babuska, B. Guo, "The h-p
 * version of the finite element method", Comput. Mech. 1 (1986) 21). Frequencies fall monotonically, because the spaces
 * of more layers hold those of fewer. */
#ifndef ORACLES_RITZ_H
#define ORACLES_RITZ_H

#include "oracles/axis.h"
#include "oracles/oracle.h"

struct ritz_problem {
    double length; /* in half heights */
    double lambda; /* Lame's first parameter in the plane, in units of mu: 2 nu / (1 - 2 nu) in plane strain,
                      2 nu / (1 - nu) in plane stress */
    int mode;      /* 1, 2, ... */
};

/* How the body is cut up. */
struct ritz_mesh {
    int layers;     /* of elements towards the corner */
    int tip_layers; /* as many towards the free end, where stress is smooth but not its derivatives */
    double grading; /* size of an element to that of the next one away from the corner */
    double growth;  /* of the elements along the beam, from one half height at its ends towards the middle,
                       up to half a wave of the mode */
    int corner;     /* degree at the corner; one more with every element away from it ... */
    int middle;     /* ... and the degree of all others, along the beam */
};

struct ritz_mode {
    struct axis x, y;
    double *shape;    /* [x.functions][2][y.functions]: components of u, scaled to u_y = 1 at (length, 0) */
    double frequency; /* in units of sqrt(mu / rho) per half height */
    double mass;      /* integral of |u|^2 over the whole body, in half heights squared */
    size_t unknowns;
};

/* False, with `why` filled, if there is no memory or no convergence. */
bool ritz_solve(const struct ritz_problem *problem, const struct ritz_mesh *mesh, struct ritz_mode *mode,
                char why[ORACLE_WHY]);
/* A mode with all that is known of its frequency. The error falls by one factor with every layer, so four numbers of
 * layers, the last that of `mesh`, give two extrapolations to the limit, each from three. */
struct ritz_limit {
    struct ritz_mode mode; /* with the most layers */
    double frequency;      /* the later extrapolation, in the units of mode.frequency */
    double uncertainty;    /* relative: distance of the two extrapolations, a tenth of what the later one corrects, and
                              round-off */
};
/* False, with `why` filled, as ritz_solve; then result->mode holds nothing. */
bool ritz_converge(const struct ritz_problem *problem, const struct ritz_mesh *mesh, struct ritz_limit *result,
                   char why[ORACLE_WHY]);

void ritz_free(struct ritz_mode *mode);

/* Displacement and its gradient [2][2], row by row, at 0 <= x <= length, -1 <= y <= 1. */
void ritz_evaluate(const struct ritz_mode *mode, double x, double y, double u[2], double gradient[4]);

#endif
