/* The oracle a scene answers to, told the scene's parameters and made to prove itself. */
#ifndef VERIFY_TRUTH_H
#define VERIFY_TRUTH_H

#include "oracles/oracle.h"
#include "solver/scene.h"

#include <stdbool.h>
#include <stddef.h>

struct verify_truth {
    const struct oracle_kind *kind; /* NULL: nothing is compared with an exact solution */
    struct oracle *oracle;
    size_t parameter_count;
    double value[ORACLE_PARAMETERS]; /* what the oracle was told, in the order of the kind's parameters */
    bool told[ORACLE_PARAMETERS];    /* told by oracle.KEY, in place of the scene's own value */
    size_t check_count;
    struct oracle_check check[ORACLE_LAWS]; /* the self-check, line by line */
    bool proven;                            /* at least one line, and each within its bound */
};

/* Whether the scene answers to an oracle; one that does not is studied by itself, and `kind` stays NULL. */
bool verify_truth_wanted(const struct solver_scene *scene);

/* Finds the scene's oracle, gives it its parameters (oracle.KEY before the scene's own value of that name) and runs its
 * self-check. A failing self-check is no error: see `proven`. Errors name the key that is missing or unknown. */
bool verify_truth_create(const struct solver_scene *scene, struct verify_truth *truth, struct solver_error *error);
void verify_truth_free(struct verify_truth *truth);

#endif
