/* Spacings that change within one body: a block that stretches to twice its length, turns and shrinks to half of it,
 * against the exact solution. The largest spacing over the smallest is driven up to where the answer is none, since the
 * spacings at the coarse end are as long as the body; and up to where stencils refuse it. */
#include "verify/extremes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double right = 0.1;  /* largest relative error of the stress that still counts as an answer */
static const double asked = 10.0; /* the ratio that has to have one */

struct block {
    const struct verify_extremes *in;
    const char *settings;
    bool along_both;
    double error; /* of the last run that was an answer */
};

static bool open_block(const struct block *block, double ratio, struct verify_trial *trial, struct solver_error *error)
{
    return verify_trial_open(block->in, "manufactured", trial, error,
                             "n=12 levels={12} threads=1 cfl=1 grading.X=%.17g grading.Y=%.17g %s", ratio,
                             block->along_both ? ratio : 1.0, block->settings);
}

static void say_why(const struct solver_error *error, char *note, size_t size)
{
    const char *text = strstr(error->text, ".lua: ");
    (void)snprintf(note, size, "beyond: %.180s", text != NULL ? text + 6 : error->text);
}

static bool right_at(void *with, double ratio, char *note, size_t size)
{
    struct block *block = with;
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    double found = NAN;
    bool ran = open_block(block, ratio, &trial, &error) && verify_trial_judge(&trial, "P_all", &found, &error);
    bool holds = ran && found <= right;
    if (!ran) {
        say_why(&error, note, size);
    } else if (!holds) {
        (void)snprintf(note, size, "beyond, the relative error of the stress is %.2g", found);
    }
    block->error = holds ? found : block->error;
    verify_trial_close(&trial);
    return holds;
}

/* Whether a run is set up, or refused as what is asked for cannot be. */
static bool taken_at(void *with, double ratio, char *note, size_t size)
{
    const struct block *block = with;
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    bool taken = open_block(block, ratio, &trial, &error);
    if (!taken) {
        say_why(&error, note, size);
    }
    verify_trial_close(&trial);
    return taken || error.code != SOLVER_BAD_INPUT; /* what breaks down is no refusal */
}

struct row {
    const char *what, *settings;
    bool along_both;
};

static void drive(const struct verify_extremes *in, const struct row *of, bool refusals, double far)
{
    struct block block = {in, of->settings, of->along_both, NAN};
    struct verify_extreme_row row = {.unit = "-", .least = asked, .most = INFINITY};
    (void)snprintf(row.what, sizeof row.what, "%s", of->what);
    (void)snprintf(row.quantity, sizeof row.quantity, "largest spacing / smallest%s", refusals ? ", taken" : "");
    if (!verify_extreme_asked(in, row.what)) {
        return;
    }
    verify_extreme_bisect(refusals ? taken_at : right_at, &block, asked, far, 0.3, &row.value, &row.fails, row.note,
                          sizeof row.note);
    if (isnan(row.fails) && refusals) {
        (void)snprintf(row.note, sizeof row.note, "as far as keys go");
    } else if (isnan(row.fails)) {
        (void)snprintf(row.note, sizeof row.note, "as far as it was driven: there the relative error is %.2g",
                       block.error);
    }
    verify_extreme_told(in, &row);
}

bool verify_extreme_graded(const struct verify_extremes *in, struct solver_error *error)
{
    static const struct row answers[] = {
        {"upwind sbp4 {p,F,H,J}", "scheme=upwind stencil=sbp4 evolved=pFHJ", false},
        {"upwind sbp2 {p,F}", "scheme=upwind stencil=sbp2 evolved=pF", false},
        {"jst sbp4 {p,F,H,J}", "scheme=jst stencil=sbp4 evolved=pFHJ", false},
        {"upwind sbp4 {p,F,H,J}, X and Y", "scheme=upwind stencil=sbp4 evolved=pFHJ", true},
    };
    static const struct row refusals[] = {
        {"sbp2, 12 spacings", "scheme=upwind stencil=sbp2 evolved=pF", false},
        {"sbp4, 12 spacings", "scheme=upwind stencil=sbp4 evolved=pF", false},
    };
    (void)error;
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++) {
        drive(in, &answers[i], false, 600.0);
    }
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
        drive(in, &refusals[i], true, 1e6);
    }
    return true;
}
