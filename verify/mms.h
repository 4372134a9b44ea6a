/* The suite of manufactured solutions: what order every combination achieves that claims one, in space and in time. */
#ifndef VERIFY_MMS_H
#define VERIFY_MMS_H

#include "solver/error.h"
#include "verify/norms.h"
#include "verify/spoiled_drive.h"

#include <stdbool.h>
#include <stddef.h>

/* Variables whose errors are looked at; x is where particles are, so its error is that of u. */
enum verify_mms_variable {
    VERIFY_MMS_OF_p,
    VERIFY_MMS_OF_x,
    VERIFY_MMS_OF_F,
    VERIFY_MMS_OF_H,
    VERIFY_MMS_OF_J,
    VERIFY_MMS_OF_P,              /* all components of P, or of the Cauchy stress where the scheme has no P */
    VERIFY_MMS_OF_PLASTIC_STRAIN, /* where the material flows */
    VERIFY_MMS_VARIABLES
};
extern const char *const verify_mms_variable_names[VERIFY_MMS_VARIABLES];

enum { VERIFY_MMS_SETTINGS = 20, VERIFY_MMS_TEXT = 64, VERIFY_MMS_LEVELS = 2 };

/* A combination, as keys of its scene. */
struct verify_mms_case {
    const char *family;             /* "large strain, 2D": a heading */
    const char *scene;              /* of verify/scenes */
    const char *path;               /* its file; the caller fills it in */
    char name[2 * VERIFY_MMS_TEXT]; /* what sets it apart within the family */
    size_t setting_count;
    char setting[VERIFY_MMS_SETTINGS][VERIFY_MMS_TEXT]; /* "KEY=value" */
    int level[VERIFY_MMS_LEVELS];                       /* n of the two levels */
    double asked[VERIFY_MMS_VARIABLES]; /* smallest order claimed; 0: none is, and what is found is told */
    bool in_time; /* cloud and spacing are fixed, levels are steps per CFL number: see verify_mms_time */
};

struct verify_mms_result {
    bool ran;
    struct solver_error error;           /* why not */
    double finest[VERIFY_MMS_VARIABLES]; /* relative L2 error at the finer level; NaN: it has none */
    double order[VERIFY_MMS_VARIABLES];  /* NaN: none was observed */
    bool asked[VERIFY_MMS_VARIABLES];    /* the order is gated */
    bool pass;                           /* all that is asked holds; true where nothing is */
    double seconds;
};

/* An error as small as this is round-off, of what is zero or exact: it has no order. */
#define VERIFY_MMS_ROUND_OFF 1e-12

/* Whether any order is claimed. */
bool verify_mms_claims(const struct verify_mms_case *which);
/* All cases: *cases is the caller's to free. False if there is no memory. */
bool verify_mms_cases(struct verify_mms_case **cases, size_t *count, struct solver_error *error);

/* Runs a case on one thread, with a fault in what drives the body if there is one. What goes wrong is in the result. */
void verify_mms_run(const struct verify_mms_case *which, const struct verify_spoiled_drive *spoiled,
                    struct verify_mms_result *result);

#endif
