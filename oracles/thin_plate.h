/* What the thin plate's fields and its self-check share. */
#ifndef ORACLES_THIN_PLATE_H
#define ORACLES_THIN_PLATE_H

#include "oracles/plate.h"

struct oracle {
    struct plate given;
    struct oracle_beam_mode mode;
    double modulus; /* E / (1 - nu^2) [Pa] */
};

size_t thin_plate_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                        size_t size);

#endif
