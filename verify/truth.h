/* The oracle a scene answers to, told the scene's parameters and made to prove itself. */
#ifndef VERIFY_TRUTH_H
#define VERIFY_TRUTH_H

#include "oracles/oracle.h"
#include "solver/scene.h"

#include <stdbool.h>
#include <stddef.h>

struct verify_truth {
    const struct oracle_kind *kind;
    struct oracle *oracle;
    size_t parameter_count;
    double value[ORACLE_PARAMETERS]; /* what the oracle was told, in the order of the kind's parameters */
    bool told[ORACLE_PARAMETERS];    /* told by oracle.KEY, in place of the scene's own value */
    size_t check_count;
    struct oracle_check check[ORACLE_LAWS]; /* the self-check, line by line */
    bool proven;                            /* at least one line, and each within its bound */
    bool none; /* the scene answers to no oracle: `kind` knows nothing, all it says is NaN, and is held to be proven */
};

/* Finds the scene's oracle, gives it its parameters (oracle.KEY before the scene's own value of that name) and runs its
 * self-check. A failing self-check is no error: see `proven`. Errors name the key that is missing or unknown, or say
 * that the scene's domain or end time is beyond what the oracle speaks of (inside.h). */
bool verify_truth_create(const struct solver_scene *scene, struct verify_truth *truth, struct solver_error *error);
/* The same for a study, which a scene without an oracle may have too: that of a run whose gates are on indicators. */
bool verify_truth_open(const struct solver_scene *scene, struct verify_truth *truth, struct solver_error *error);
/* The oracle called `name`, told its parameters without a scene: all of them, or with `typical` those that differ from
 * its typical values. Errors name what is missing or unknown. */
bool verify_truth_tell(const char *name, const struct solver_named *told, size_t count, bool typical,
                       struct verify_truth *truth, struct solver_error *error);
void verify_truth_free(struct verify_truth *truth);
/* Exact energies [J] at time t of what the scene models: of a round body cut by planes of symmetry a half for each. NaN
 * where another body is cut, of which the oracle's share is not known. */
void verify_truth_energy(const struct verify_truth *truth, const struct solver_scene *scene, double t, double *kinetic,
                         double *strain);

#endif
