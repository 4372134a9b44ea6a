/* Ranges of what a body is made of and how it is deformed: Poisson's ratio to both its limits, stretch and compression
 * of a held body, and clouds moved at random. */
#include "verify/extremes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STEPS = 300 };

/* What is driven: a key, and how the value that is bisected becomes its own. */
struct driven {
    const struct verify_extremes *in;
    const char *settings; /* the rest of the configuration */
    const char *key;
    double offset, factor; /* key = offset + factor * value */
};

/* A run of a few hundred steps that starts with small velocities without order: it holds if it does not break down and
 * the velocities do not grow beyond what they were. */
static bool calm_at(void *with, double value, char *note, size_t size)
{
    const struct driven *driven = with;
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    if (!verify_trial_open(driven->in, "free-block", &trial, &error, "%s random=1 threads=1 %s=%.17g", driven->settings,
                           driven->key, driven->offset + driven->factor * value)) {
        const char *text = strstr(error.text, ".lua: ");
        (void)snprintf(note, size, "%.190s", text != NULL ? text + 6 : error.text);
        return false;
    }
    double before = verify_trial_speed(&trial, NULL);
    bool ran = solver_run_steps(trial.run, STEPS, &error);
    double ratio = verify_trial_speed(&trial, NULL) / before;
    bool holds = ran && ratio <= 1.5;
    if (!holds && ran) {
        (void)snprintf(note, size, "beyond, velocities grow %.2g times in %d steps", ratio, (int)STEPS);
    } else if (!holds) {
        (void)snprintf(note, size, "beyond: %.180s", error.text);
    }
    verify_trial_close(&trial);
    return holds;
}

struct range {
    const char *what, *quantity, *settings, *key;
    double offset, factor;
    double near, far; /* of the value that is bisected */
    double asked;     /* it has to come this far */
};

/* A value that is a distance from a limit cannot be bisected down to 0: the limit is tried by itself. */
static void try_limit(struct driven *driven, struct verify_extreme_row *row)
{
    if (calm_at(driven, 0.0, row->note, sizeof row->note)) {
        row->value = 0.0;
        (void)snprintf(row->note, sizeof row->note, "the limit itself");
    } else {
        row->fails = 0.0;
    }
}

static bool drive(const struct verify_extremes *in, const struct range *range)
{
    struct driven driven = {in, range->settings, range->key, range->offset, range->factor};
    struct verify_extreme_row row = {.unit = "-"};
    (void)snprintf(row.what, sizeof row.what, "%s", range->what);
    if (!verify_extreme_asked(in, row.what)) {
        return true;
    }
    (void)snprintf(row.quantity, sizeof row.quantity, "%s", range->quantity);
    verify_extreme_bisect(calm_at, &driven, range->near, range->far, 0.05, &row.value, &row.fails, row.note,
                          sizeof row.note);
    bool upward = range->far > range->near;
    row.least = upward ? range->asked : -INFINITY;
    row.most = upward ? INFINITY : range->asked;
    if (isnan(row.fails)) {
        (void)snprintf(row.note, sizeof row.note, "as far as it was driven");
        if (range->offset != 0.0) {
            try_limit(&driven, &row);
        }
    }
    verify_extreme_told(in, &row);
    return true;
}

static bool drive_all(const struct verify_extremes *in, const struct range *range, size_t count)
{
    bool done = true;
    for (size_t i = 0; i < count; i++) {
        done = drive(in, &range[i]) && done;
    }
    return done;
}

#define PRESSURE "incompressible.solver=poisson "

bool verify_extreme_poisson(const struct verify_extremes *in, struct solver_error *error)
{
    (void)error;
    static const struct range ranges[] = {
        {"upwind {p,F}, 2D", "smallest 0.5 - nu", "d=2 evolved=pF", "material.nu", 0.5, -1.0, 0.1, 1e-9, 1.01e-8},
        {"upwind {p,F,J}, 2D", "smallest 0.5 - nu", "d=2 evolved=pFJ", "material.nu", 0.5, -1.0, 0.1, 1e-9, 1.01e-8},
        {"upwind {p,F,H,J}, 2D", "smallest 0.5 - nu", "d=2 evolved=pFHJ", "material.nu", 0.5, -1.0, 0.1, 1e-9, 1.01e-8},
        {"upwind {p,F,H,J}, 3D", "smallest 0.5 - nu", "d=3 evolved=pFHJ", "material.nu", 0.5, -1.0, 0.1, 1e-9, 1.01e-8},
        {"jst {p,F,H,J}, 3D", "smallest 0.5 - nu", "d=3 evolved=pFHJ scheme=jst", "material.nu", 0.5, -1.0, 0.1, 1e-9,
         1.01e-8},
        {"upwind {p,F,J}, pressure, 2D", "smallest 0.5 - nu", PRESSURE "d=2 evolved=pFJ", "material.nu", 0.5, -1.0, 0.1,
         1e-9, 0.0},
        {"upwind {p,F,H,J}, pressure, 3D", "smallest 0.5 - nu", PRESSURE "d=3 evolved=pFHJ", "material.nu", 0.5, -1.0,
         0.1, 1e-9, 0.0},
        {"the same, all faces clamped", "smallest 0.5 - nu", PRESSURE "held=1 d=3 evolved=pFHJ", "material.nu", 0.5,
         -1.0, 0.1, 1e-9, 0.0},
        {"upwind {p,F}, 2D", "smallest 1 + nu", "d=2 evolved=pF", "material.nu", -1.0, 1.0, 0.5, 1e-6, 0.0101},
        {"upwind {p,F,H,J}, 3D", "smallest 1 + nu", "d=3 evolved=pFHJ", "material.nu", -1.0, 1.0, 0.5, 1e-6, 0.0101},
        {"jst {p,F,H,J}, 3D", "smallest 1 + nu", "d=3 evolved=pFHJ scheme=jst", "material.nu", -1.0, 1.0, 0.5, 1e-6,
         0.0101},
    };
    return drive_all(in, ranges, sizeof ranges / sizeof *ranges);
}

/* Bodies that yield everywhere from the start: what is left of their stress is pressure. */
#define YIELDS "material.model=hencky material.yield_stress=1e4 material.hardening=1e4 "
#define FLOWS  "held=1 n=6 material.model=hencky material.hardening=0 stretch=1.05 speed=1e-3 "
#define HELD   "held=1 speed=1e-6 n=6 "

bool verify_extreme_stretch(const struct verify_extremes *in, struct solver_error *error)
{
    (void)error;
    static const struct range ranges[] = {
        {"upwind {p,F}, 3D", "largest stretch, held", HELD "d=3 evolved=pF", "stretch", 0.0, 1.0, 1.1, 1000.0, 10.0},
        {"upwind {p,F,J}, 3D", "largest stretch, held", HELD "d=3 evolved=pFJ", "stretch", 0.0, 1.0, 1.1, 1000.0, 10.0},
        {"upwind {p,F,H,J}, 3D", "largest stretch, held", HELD "d=3 evolved=pFHJ", "stretch", 0.0, 1.0, 1.1, 1000.0,
         10.0},
        {"jst {p,F,H,J}, 3D", "largest stretch, held", HELD "d=3 evolved=pFHJ scheme=jst", "stretch", 0.0, 1.0, 1.1,
         1000.0, 10.0},
        {"upwind {p,F}, Hencky, 3D", "largest stretch, held", HELD "d=3 evolved=pF material.model=hencky", "stretch",
         0.0, 1.0, 1.1, 1000.0, 5.0},
        {"upwind {p,F,H,J}, Hencky, 3D", "largest stretch, held", HELD "d=3 evolved=pFHJ material.model=hencky",
         "stretch", 0.0, 1.0, 1.1, 1000.0, 5.0},
        {"upwind {p,F}, yielding, 2D", "largest stretch, held", HELD YIELDS "d=2 evolved=pF", "stretch", 0.0, 1.0, 1.1,
         1000.0, 1.2},
        {"jst {p,F}, yielding, 2D", "largest stretch, held", HELD YIELDS "d=2 evolved=pF scheme=jst", "stretch", 0.0,
         1.0, 1.1, 1000.0, 1.2},
        {"upwind {p,F}, yielding, 2D", "smallest yield stress / E", FLOWS "d=2 evolved=pF", "material.yield_stress",
         0.0, 1e7, 0.01, 1e-12, 1e-6},
        {"jst {p,F}, yielding, 2D", "smallest yield stress / E", FLOWS "d=2 evolved=pF scheme=jst",
         "material.yield_stress", 0.0, 1e7, 0.01, 1e-12, 1e-6},
        {"upwind {p,F,H,J}, yielding, 3D", "smallest yield stress / E", FLOWS "d=3 evolved=pFHJ",
         "material.yield_stress", 0.0, 1e7, 0.01, 1e-12, 1e-6},
        {"upwind {p,F}, 3D", "least J, held", HELD "d=3 evolved=pF", "stretch", 0.0, 1.0, 0.9, 0.001, 0.05},
        {"upwind {p,F,H,J}, 3D", "least J, held", HELD "d=3 evolved=pFHJ", "stretch", 0.0, 1.0, 0.9, 0.001, 0.05},
        {"jst {p,F,H,J}, 3D", "least J, held", HELD "d=3 evolved=pFHJ scheme=jst", "stretch", 0.0, 1.0, 0.9, 0.001,
         0.05},
        {"upwind {p,F,H,J}, Hencky, 3D", "least J, held", HELD "d=3 evolved=pFHJ material.model=hencky", "stretch", 0.0,
         1.0, 0.9, 0.001, 0.05},
        {"upwind {p,F}, Hencky, 3D", "least J, held", HELD "d=3 evolved=pF material.model=hencky", "stretch", 0.0, 1.0,
         0.9, 0.001, 0.05},
    };
    return drive_all(in, ranges, sizeof ranges / sizeof *ranges);
}

#define CLOSED "stencil=closed support=2 reconstruction=least-squares "

bool verify_extreme_perturbed(const struct verify_extremes *in, struct solver_error *error)
{
    (void)error;
    static const struct range ranges[] = {
        {"closed {p,F}, 2D", "largest perturb", "d=2 n=8 " CLOSED "evolved=pF", "perturb", 0.0, 1.0, 0.05, 0.45, 0.45},
        {"closed {p,F}, 2D, another cloud", "largest perturb", "d=2 n=8 seed=4 " CLOSED "evolved=pF", "perturb", 0.0,
         1.0, 0.05, 0.45, 0.45},
        {"closed {p,F,H,J}, 2D", "largest perturb", "d=2 n=8 " CLOSED "evolved=pFHJ", "perturb", 0.0, 1.0, 0.05, 0.45,
         0.45},
        {"closed {p,F,H,J}, 2D, another cloud", "largest perturb", "d=2 n=8 seed=4 " CLOSED "evolved=pFHJ", "perturb",
         0.0, 1.0, 0.05, 0.45, 0.45},
        {"closed {p,F}, 3D", "largest perturb", "d=3 n=5 " CLOSED "evolved=pF", "perturb", 0.0, 1.0, 0.05, 0.45, 0.45},
        {"jst closed {p,F}, 2D", "largest perturb", "d=2 n=8 seed=4 scheme=jst " CLOSED "evolved=pF", "perturb", 0.0,
         1.0, 0.05, 0.45, 0.45},
        {"sph {p,F}, 2D", "largest perturb", "d=2 n=8 stencil=sph support=2 evolved=pF", "perturb", 0.0, 1.0, 0.05,
         0.45, 0.45},
    };
    return drive_all(in, ranges, sizeof ranges / sizeof *ranges);
}

/* --- impact --- */

static bool survives_at(void *with, double speed, char *note, size_t size)
{
    const struct driven *driven = with;
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    bool holds = verify_trial_open(driven->in, "free-block", &trial, &error, "%s speed=0 threads=1 impact=%.17g",
                                   driven->settings, speed) &&
                 verify_trial_finish(&trial, &error);
    if (!holds) {
        const char *what = strstr(error.text, ".lua: ");
        (void)snprintf(note, size, "%.190s", what != NULL ? what + 6 : error.text);
    }
    verify_trial_close(&trial);
    return holds;
}

bool verify_extreme_impact(const struct verify_extremes *in, struct solver_error *error)
{
    static const struct {
        const char *what, *settings;
    } bodies[] = {
        {"upwind {p,F}, 1D", "d=1 n=16 evolved=pF cfl=0.3"},
        {"upwind {p,F}, 2D", "d=2 n=8 evolved=pF cfl=0.3"},
        {"upwind {p,F,H,J}, 2D", "d=2 n=8 evolved=pFHJ cfl=0.3"},
        {"jst {p,F}, 2D", "d=2 n=8 evolved=pF cfl=0.3 scheme=jst"},
        {"upwind {p,F}, Hencky, 2D", "d=2 n=8 evolved=pF cfl=0.3 material.model=hencky"},
        {"upwind {p,F}, yields, 2D",
         "d=2 n=8 evolved=pF cfl=0.3 material.model=hencky material.yield_stress=1e4 material.hardening=1e4"},
        {"jst {p,F}, yields, 2D", "d=2 n=8 evolved=pF cfl=0.3 scheme=jst material.model=hencky "
                                  "material.yield_stress=1e4 material.hardening=1e4"},
    };
    (void)error;
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        struct driven driven = {in, bodies[i].settings, "impact", 0.0, 1.0};
        struct verify_extreme_row row = {
            .quantity = "largest impact speed", .unit = "c", .least = 1.0, .most = INFINITY};
        (void)snprintf(row.what, sizeof row.what, "%s", bodies[i].what);
        if (!verify_extreme_asked(in, row.what)) {
            continue;
        }
        verify_extreme_bisect(survives_at, &driven, 0.01, 10.0, 0.05, &row.value, &row.fails, row.note,
                              sizeof row.note);
        if (isnan(row.fails)) {
            (void)snprintf(row.note, sizeof row.note, "as far as it was driven");
        }
        verify_extreme_told(in, &row);
    }
    return true;
}
