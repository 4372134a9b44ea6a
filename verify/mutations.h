/* Mutations: what is told wrongly on purpose, and the gate that must notice. Of the sources of manufactured solutions,
 * of boundary data, and of every oracle there is. */
#ifndef VERIFY_MUTATIONS_H
#define VERIFY_MUTATIONS_H

#include "verify/mms.h"
#include "verify/spoiled_drive.h"

enum { VERIFY_MUTATION_TEXT = 160 };

/* One mutation, and how it ended. */
struct verify_mutation {
    char what[VERIFY_MUTATION_TEXT];   /* "traction of the opposite sign" */
    char where[VERIFY_MUTATION_TEXT];  /* what it was told to */
    char caught[VERIFY_MUTATION_TEXT]; /* the gate that noticed first, "" if none did */
    double value, bound;               /* measured there */
    bool control;                      /* nothing is wrong: no gate may notice */
    bool failed;                       /* could not be tried: `caught` says why */
    bool done;
};

/* Called with each mutation as it ends. */
typedef void verify_mutation_told(void *context, const struct verify_mutation *mutation);

/* Whether a mutation was not noticed, or a control was. */
bool verify_mutation_missed(const struct verify_mutation *mutation);
/* Tries all of them, those of drives in the scene at `path`; *missed becomes how many of *count were not noticed, or
 * how many controls were. */
bool verify_mutations(const char *path, verify_mutation_told *told, void *context, size_t *count, size_t *missed,
                      struct solver_error *error);

#endif
