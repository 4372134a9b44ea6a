/* Another configuration of the same scene, beside which a study's finest level is looked at (scene key beside). It is
 * no exact solution: what differs between the two may be the fault of either. */
#ifndef VERIFY_BESIDE_H
#define VERIFY_BESIDE_H

#include "verify/motion.h"
#include "verify/norms.h"
#include "verify/options.h"

/* Words for a configuration: "scheme = upwind, n = 50". */
enum { VERIFY_LABEL = 512 };

struct verify_beside {
    struct solver_scene *scene; /* NULL: there is none, or it is what the study itself runs */
    struct verify_motion motion;
    char label[VERIFY_LABEL], label_of_study[VERIFY_LABEL]; /* the keys under beside, with the values of each */
};

/* Loads the scene `finest`, which the command line's words made, once more: with these words except those for keys
 * under beside, and with beside's. Leaves beside->scene NULL where `finest` has the same values already. Fails
 * (SOLVER_BAD_INPUT) also where the two do not have the same probes and end time. On success the caller frees. */
bool verify_beside_open(const struct verify_options *options, const struct solver_scene *finest,
                        struct verify_beside *beside, struct solver_error *error);
/* Runs it and keeps the motion of its probes. */
bool verify_beside_run(struct verify_beside *beside, const char *folder, const char *command,
                       struct solver_error *error);
void verify_beside_free(struct verify_beside *beside);

/* Errors VERIFY_BESIDE and VERIFY_BESIDE_ABS of a history; NaN where nothing was run beside it. */
bool verify_beside_measure(const struct verify_beside *beside, const struct solver_history *history,
                           double error[VERIFY_ERRORS], struct solver_error *why);

#endif
