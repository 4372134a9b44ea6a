/* What the cantilever's fields and its self-check share. */
#ifndef ORACLES_CANTILEVER_H
#define ORACLES_CANTILEVER_H

#include "oracles/plate.h"

struct oracle {
    struct plate given;
    bool plane_stress; /* else plane strain */
    struct ritz_limit solution;
    double lambda, mu;       /* Lame's parameters in the plane [Pa] */
    double frequency;        /* [rad/s] */
    struct ritz_mode second; /* the same by other elements, for the self-check */
    double second_frequency; /* [rad/s] */
};

size_t cantilever_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                        size_t size);

#endif
