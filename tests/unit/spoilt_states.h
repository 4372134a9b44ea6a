/* Faults of a state that any oracle could have, relative size d. Who includes this defines true_state: the state of the
 * oracle that is spoiled. */
#ifndef TESTS_SPOILT_STATES_H
#define TESTS_SPOILT_STATES_H

#include "oracles/oracle.h"

static void true_state(const double X[3], double t, struct oracle_state *s);

static inline void scale(double *x, size_t count, double factor)
{
    for (size_t i = 0; i < count; i++) {
        x[i] *= factor;
    }
}

static inline void scale_gradient(double F[9], double factor)
{
    for (int i = 0; i < 9; i++) {
        double unit = i % 4 == 0 ? 1 : 0;
        F[i] = unit + (F[i] - unit) * factor;
    }
}

static inline void displacement(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    scale(s->u, 3, 1 + d);
}

static inline void velocity(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    scale(s->v, 3, 1 + d);
    scale(s->p, 3, 1 + d);
}

static inline void momentum(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    scale(s->p, 3, 1 + d);
}

static inline void gradient(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    scale_gradient(s->F, 1 + d);
}

static inline void stress(const double X[3], double t, double d, struct oracle_state *s)
{
    true_state(X, t, s);
    scale(s->P, 9, 1 + d);
}

static inline void amplitude(const double X[3], double t, double d, struct oracle_state *s)
{
    velocity(X, t, d, s);
    scale(s->u, 3, 1 + d);
    scale_gradient(s->F, 1 + d);
    scale(s->P, 9, 1 + d);
}

#endif
