/* Oracles spoiled on purpose: fields, extra scalars and energies of one go through functions that change them, and the
 * self-check of the true kind must see it. Here stand the faults that any oracle could have, relative size d. */
#ifndef TESTS_SPOILT_STATES_H
#define TESTS_SPOILT_STATES_H

#include "oracles/oracle.h"

#include <math.h>
#include <string.h>

typedef void spoil_state(const double X[3], double t, double d, struct oracle_state *s);
struct energies {
    double kinetic, strain;
};
typedef void spoil_energy(double d, struct energies *e);
typedef void spoil_extras(const double X[3], double t, double d, double value[ORACLE_EXTRAS]);

/* The true kind, the oracle checked, another one of the kind, and what is spoiled by how much. */
static struct {
    const struct oracle_kind *kind;
    struct oracle *whole, *other;
    spoil_state *state;
    spoil_energy *energy;
    spoil_extras *extras;
    double d;
} now;

static inline void true_state(const double X[3], double t, struct oracle_state *s)
{
    now.kind->state(now.whole, X, t, s);
}

static inline void spoiled_state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *s)
{
    (void)oracle;
    now.state != NULL ? now.state(X, t, now.d, s) : true_state(X, t, s);
}

static inline void spoiled_energy(const struct oracle *oracle, double t, double *kinetic, double *strain)
{
    struct energies e;
    now.kind->energy(oracle, t, &e.kinetic, &e.strain);
    if (now.energy != NULL) {
        now.energy(now.d, &e);
    }
    *kinetic = e.kinetic;
    *strain = e.strain;
}

static inline void true_extras(const double X[3], double t, double value[ORACLE_EXTRAS])
{
    now.kind->extras(now.whole, X, t, value);
}

static inline void spoiled_extras(const struct oracle *oracle, const double X[3], double t, double value[ORACLE_EXTRAS])
{
    (void)oracle;
    now.extras != NULL ? now.extras(X, t, now.d, value) : true_extras(X, t, value);
}

/* Whether the self-check sees it; raises *loosest, unless NULL, to the largest of its bounds. */
static inline bool caught(double *loosest)
{
    struct oracle_kind spoiled = *now.kind;
    struct oracle_check line[ORACLE_LAWS];
    size_t count = 0;
    spoiled.state = spoiled_state;
    spoiled.energy = spoiled_energy;
    spoiled.extras = now.kind->extras != NULL ? spoiled_extras : NULL;
    bool holds = oracle_self_check(&spoiled, now.whole, line, &count);
    for (size_t i = 0; loosest != NULL && i < count; i++) {
        *loosest = fmax(*loosest, line[i].bound);
    }
    return !holds;
}

/* The smallest power of ten for d, from `first` down in steps to `last`, that is caught as all larger ones are;
 * infinity if there is none. */
static inline double smallest_caught(int first, int last, int step)
{
    double smallest = INFINITY;
    for (int exponent = first; exponent >= last; exponent -= step) {
        now.d = pow(10, exponent);
        if (!caught(NULL)) {
            break;
        }
        smallest = now.d;
    }
    return smallest;
}

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

/* Without a flaw, but of another problem. */
static inline void other_oracle(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    now.kind->state(now.other, X, t, s);
}

static inline void other_extras(const double X[3], double t, double d, double value[ORACLE_EXTRAS])
{
    (void)d;
    now.kind->extras(now.other, X, t, value);
}

static inline void sign_of_v(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    velocity(X, t, -2, s);
}

static inline void no_unit_matrix(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d;
    true_state(X, t, s);
    s->F[0] -= 1;
    s->F[4] -= 1;
    s->F[8] -= 1;
}

static inline void frozen(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d, (void)t;
    true_state(X, 0, s);
}

static inline void nothing(const double X[3], double t, double d, struct oracle_state *s)
{
    (void)d, (void)t, (void)X;
    memset(s, 0, sizeof *s);
    s->F[0] = s->F[4] = s->F[8] = 1;
}

static inline void all_extras(const double X[3], double t, double d, double value[ORACLE_EXTRAS])
{
    true_extras(X, t, value);
    for (size_t i = 0; now.kind->extra[i].name != NULL; i++) {
        value[i] *= 1 + d;
    }
}

static inline void kinetic_energy(double d, struct energies *e)
{
    e->kinetic *= 1 + d;
}

static inline void strain_energy(double d, struct energies *e)
{
    e->strain *= 1 + d;
}

static inline void both_energies(double d, struct energies *e)
{
    e->kinetic *= 1 + d;
    e->strain *= 1 + d;
}

static inline void exchanged_energy(double d, struct energies *e)
{
    double shift = d * e->kinetic; /* the total stays right */
    e->kinetic -= shift;
    e->strain += shift;
}

static inline void infinite_energy(double d, struct energies *e)
{
    (void)d;
    e->kinetic = INFINITY;
}

#endif
