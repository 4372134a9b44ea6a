/* What the fields of a breathing ball or cylinder and their self-check share. */
#ifndef ORACLES_BREATHING_H
#define ORACLES_BREATHING_H

#include "oracles/oracle.h"
#include "oracles/shell.h"

/* What the scene gives; the self-check reads nothing else. */
struct breathing {
    struct shell body; /* without a hole */
    int mode;          /* 1, 2, ... */
    double amplitude;  /* displacement of the surface at t = 0, outwards [m] */
    double E, nu, rho; /* [Pa], [-], [kg/m^3] */
};

struct oracle {
    struct breathing given;
    double mu, bulk, lambda; /* bulk: lambda + 2 mu / dim, of the ball or in the plane of the disc [Pa] */
    double root;             /* k R */
    double k, frequency;     /* [rad/m], [rad/s] */
    double strain;           /* amplitude of div u at the centre */
};

size_t breathing_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                       size_t size);

#endif
