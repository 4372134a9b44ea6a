/* What the self-check is made of, shared by its files and by the checks that single oracles add: distances that keep a
 * NaN, sample points away from fronts, derivatives and integrals of the fields as they are given. */
#ifndef ORACLES_SELF_CHECK_PARTS_H
#define ORACLES_SELF_CHECK_PARTS_H

#include "oracles/self_check.h"

/* How far two evaluations are apart, and how large they are. */
struct self_check_distance {
    double error, size;
};

/* The larger of two, where NaN is larger than anything. */
double self_check_worse(double a, double b);
void self_check_measure(struct self_check_distance *d, const double *a, const double *b, size_t count);
/* Raises *size to the largest magnitude. */
void self_check_largest(double *size, const double *a, size_t count);
/* error / scale; nothing may be off where everything is zero. */
double self_check_relative(double error, double scale);
void self_check_line(struct self_check *check, const char *law, double residual, double bound);

/* Relative error of two evaluations of the same field at the same point: round-off times the phase, in radians, that
 * the fastest wave has run through, in a round body also from the origin to its surface. */
double self_check_round_off(const struct self_check *check);
/* F is stored with its unit matrix, whose round-off hides that much of a small gradient, in each of two evaluations:
 * what to measure an error of the gradient against that must stay below `bound`. */
double self_check_gradient_scale(const struct self_check *check, double bound);

/* The body that holds everything, or the one before (0) or behind (1) the interface. */
struct self_check_body self_check_body(const struct self_check *check, int which);
int self_check_bodies(const struct self_check *check);
/* Hooke's law: P = K tr(e) I + 2 mu dev(e) [Pa], e = (G + G^T)/2, from the displacement gradient G; and its
 * complementary energy, dev(P):dev(P)/(4 mu) + tr(P)^2/(18 K) [J/m^3]. All tensors row by row. */
void self_check_hooke(double bulk, double mu, const double G[9], double P[9]);
double self_check_complementary(double bulk, double mu, const double P[9]);
/* p-wave modulus [Pa] and speed [m/s]. */
double self_check_modulus(const struct self_check_body *body);
double self_check_speed(const struct self_check_body *body);
/* Longest piece to integrate over in one go [m]: of a kind with fronts a radian of the wave, of a round body two along
 * the radius, of a smooth box all. */
double self_check_radian(const struct self_check *check, const struct self_check_body *body);

/* Halton's sequence in [0, 1): the digits of i + 1 in a prime base of its own per axis (3: time), mirrored at the
 * point.
 */
double self_check_sequence(size_t i, int axis);

/* A sample point. */
struct self_check_spot {
    struct self_check_body body; /* the one it lies in */
    double X[3], t;
    double step; /* of differences, as a part of SELF_CHECK_STEP: 1, or less where a front is near */
};
/* Point i, at least `steps` steps of the differences from the ends of body and time. */
struct self_check_spot self_check_sample(const struct self_check *check, size_t i, int steps);
/* Time i of a sequence from the first to the last that are looked at. */
double self_check_time(const struct self_check *check, size_t i);
/* Point i of the body at a time that is given. */
struct self_check_spot self_check_sample_at(const struct self_check *check, size_t i, double t);

/* Of every field, along axis 0, 1, 2 (X, Y, Z) or 3 (t); reaches SELF_CHECK_REACH steps to either side. */
enum { SELF_CHECK_REACH = 4 };
void self_check_derivative(const struct self_check *check, const struct self_check_spot *spot, int axis,
                           struct oracle_state *along);

/* Ends of the pieces of a one-dimensional body in which nothing but waves goes on at time t: the ends of the body and
 * the fronts in it. Fills `place` in order and returns how many there are: 2 if there are no fronts; 0 if the kind
 * cannot say where they are, for then nothing can be integrated. */
enum { SELF_CHECK_PLACES = ORACLE_FRONTS + 2 };
size_t self_check_places(const struct self_check *check, const struct self_check_body *body, double t,
                         double place[SELF_CHECK_PLACES]);

/* Adds weight times whatever is integrated at X to sum. */
enum { SELF_CHECK_SUMS = 3 };
typedef void self_check_integrand(const struct self_check_body *body, const struct oracle_state *state,
                                  const double X[3], const void *with, double weight, double sum[SELF_CHECK_SUMS]);
/* Over one body at time t, by ten-point Gauss rules in the pieces between fronts, which are cut where they are longer
 * than `longest` [m]. Sums are NaN where the fronts are not known. A round body is integrated along some radii, each
 * for its share of the body: what is integrated must be alike in all directions. */
void self_check_integrate(const struct self_check *check, const struct self_check_body *body, double t, double longest,
                          self_check_integrand *integrand, const void *with, double sum[SELF_CHECK_SUMS]);
/* What the fields of a body in one dimension say of the amplitude q [m] of u = q(t) cos(k (X - X0)), a mode of it with
 * k > 0, each from its own field: q by u, dq/dt by v, and q by P. */
void self_check_mode(const struct self_check *check, const struct self_check_body *body, double t, double k, double X0,
                     double amplitude[3]);
/* Adds the lines that compare those with the modal solution, the fastest mode of which has `frequency` [rad/s]: the
 * round-off is that of its phase. */
void self_check_mode_lines(struct self_check *check, const struct self_check_distance of[3], double frequency);
/* Adds a line: in one dimension, v at X passes `level` [m/s] at `time` [s], and not before. */
void self_check_arrival(struct self_check *check, const char *law, double X, double level, double time);
/* Adds a line: from later than `time` on [s] the kind says NaN, and not before, to within a relative bound. */
void self_check_reach(struct self_check *check, const char *law, double time, double bound);
/* The rule itself, on [-1, 1]. */
enum { SELF_CHECK_NODES = 10 };
double self_check_node(int n, double *weight);

#endif
