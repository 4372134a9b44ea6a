/* What the cantilever's fields and its self-check share. */
#ifndef ORACLES_CANTILEVER_H
#define ORACLES_CANTILEVER_H

#include "oracles/ritz.h"

/* What the scene gives. */
struct cantilever_given {
    double length, height; /* [m] */
    int mode;              /* 1, 2, ... */
    double tip_velocity;   /* [m/s] */
    double E, nu, rho;     /* [Pa], [-], [kg/m^3] */
};

struct oracle {
    struct cantilever_given given;
    struct ritz_limit solution;
    double lambda, mu;       /* [Pa] */
    double frequency;        /* [rad/s] */
    struct ritz_mode second; /* the same by other elements, for the self-check */
    double second_frequency; /* [rad/s] */
};

size_t cantilever_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                        size_t size);

#endif
