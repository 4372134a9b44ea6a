/* Gates: what a study must show, judged. Each is one-sided, so that better never fails. */
#ifndef VERIFY_GATES_H
#define VERIFY_GATES_H

#include "solver/scene.h"
#include "verify/level.h"

#include <stdbool.h>
#include <stddef.h>

enum { VERIFY_GATES = SOLVER_GATES * SOLVER_NAMED };

struct verify_gate {
    char name[SOLVER_NAME]; /* "p": error at the finest level; "rate p": order between the two finest levels */
    double value;           /* measured; NaN if it could not be */
    double bound;
    const char *op; /* "<=" for errors, ">=" for orders */
    const char *unit;
    const char *why; /* the value is no finite number; "" if it is one */
    bool pass;
};

struct verify_gates {
    size_t count; /* 0: no rule of the scene holds for this configuration, so nothing was judged */
    struct verify_gate gate[VERIFY_GATES];
    bool general; /* only rules without conditions hold, and others are asked for more: nothing is of this one */
    bool pass;    /* at least one gate, and all of them pass */
};

/* Whether two values spelt as `--set` would are the same: numbers however they are spelt. */
bool verify_same_value(const char *a, const char *b);

/* Whether `value op bound` holds, op being "<=" or ">=". A value or bound that is not finite never passes: it is no
 * measurement. */
bool verify_gate_judge(double value, const char *op, double bound);

/* Judges the rules that hold for the scene's configuration by what was measured at the finest level: all whose
 * conditions it meets or, where none of those has conditions, the rules without.
 * Fails (SOLVER_BAD_INPUT) on a rule that names no key of the scene or nothing that is measured. */
bool verify_gates_judge(const struct solver_scene *scene, const struct verify_level *finest, struct verify_gates *gates,
                        struct solver_error *why);

#endif
