/* Materials that meet: a pulse through a welded bar whose second half is heavier and stiffer, or lighter and softer, by
 * up to a million, against the exact solution. The contrast is bisected up to where the error is that of no contrast no
 * more, whether because the interface is resolved no longer or because a step is no longer stable. Across a plane that
 * is slanted against the lattice, where there is no exact solution, a free body is held to losing energy. */
#include "verify/extremes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double right = 0.1; /* largest relative L1 error of the stress that still counts as an answer */

struct bar {
    const struct verify_extremes *in;
    const char *settings;
    double error; /* of the last run that was an answer */
};

static bool right_at(void *with, double contrast, char *note, size_t size)
{
    struct bar *bar = with;
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    double found = NAN;
    bool ran = verify_trial_open(bar->in, "bimaterial-wave", &trial, &error, "n=416 threads=1 E2=%.17g rho2=%.17g %s",
                                 79.1e9 * contrast, 2785.0 * contrast, bar->settings) &&
               verify_trial_judge(&trial, "sigma_l1", &found, &error);
    bool holds = ran && found <= right;
    if (!ran) {
        const char *text = strstr(error.text, ".lua: ");
        (void)snprintf(note, size, "beyond: %.180s", text != NULL ? text + 6 : error.text);
    } else if (!holds) {
        (void)snprintf(note, size, "beyond, the relative L1 error of the stress is %.2g", found);
    }
    bar->error = holds ? found : bar->error;
    verify_trial_close(&trial);
    return holds;
}

bool verify_extreme_contrast(const struct verify_extremes *in, struct solver_error *error)
{
    static const struct {
        const char *what, *settings;
        double up, down; /* as far as it has to come */
    } schemes[] = {
        {"upwind sbp4 rk4", "scheme=upwind", 1e6, 1e-6},
        {"upwind sbp2 tvd-rk2", "scheme=upwind stencil=sbp2 integrator=tvd-rk2 cfl=0.3", 1e6, 1e-6},
        {"jst sbp2 tvd-rk2", "scheme=jst stencil=sbp2 integrator=tvd-rk2 cfl=0.3", 1e6, 1e-6},
        {"ulsph tvd-rk2", "scheme=ulsph", 1e6, 1e-6},
    };
    (void)error;
    for (size_t i = 0; i < sizeof schemes / sizeof *schemes; i++) {
        for (int down = 0; down < 2; down++) {
            struct bar bar = {in, schemes[i].settings, NAN};
            struct verify_extreme_row row = {
                .unit = "-", .least = down ? -INFINITY : schemes[i].up, .most = down ? schemes[i].down : INFINITY};
            (void)snprintf(row.what, sizeof row.what, "%s", schemes[i].what);
            if (!verify_extreme_asked(in, row.what)) {
                continue;
            }
            (void)snprintf(row.quantity, sizeof row.quantity, "%s of E and rho",
                           down ? "smallest jump" : "largest jump");
            verify_extreme_bisect(right_at, &bar, down ? 0.99 : 1.01, down ? 1e-6 : 1e6, 0.1, &row.value, &row.fails,
                                  row.note, sizeof row.note);
            if (isnan(row.fails)) {
                (void)snprintf(row.note, sizeof row.note,
                               "as far as it was driven: there the relative L1 error of the stress is %.2g", bar.error);
            }
            verify_extreme_told(in, &row);
        }
    }
    return true;
}

/* Most energy, kinetic and strain, that a body without loads has had over that of its start, less one; NaN: none known.
 */
static double energy_rise(const struct solver_run *run)
{
    const struct solver_history *history = solver_run_history(run);
    double most = 0.0;
    for (size_t row = 0; row < history->count; row++) {
        most = fmax(most, history->totals[row].kinetic + history->totals[row].strain);
    }
    return most / (history->totals[0].kinetic + history->totals[0].strain) - 1.0;
}

static bool loses_at(void *with, double jump, char *note, size_t size)
{
    const struct bar *body = with;
    struct verify_trial trial;
    struct solver_error error = {.code = SOLVER_OK};
    bool ran = verify_trial_open(body->in, "free-block", &trial, &error,
                                 "random=1 speed=1e-5 t_end=0.003 threads=1 jump=%.17g %s", jump, body->settings) &&
               verify_trial_finish(&trial, &error);
    double rise = ran ? energy_rise(trial.run) : NAN;
    if (!ran) {
        const char *text = strstr(error.text, ".lua: ");
        (void)snprintf(note, size, "beyond: %.180s", text != NULL ? text + 6 : error.text);
    } else if (!(rise <= 1e-10)) {
        (void)snprintf(note, size, "beyond, energy rises by %.2g of itself", rise);
    }
    verify_trial_close(&trial);
    return ran && rise <= 1e-10;
}

bool verify_extreme_slanted(const struct verify_extremes *in, struct solver_error *error)
{
    static const struct {
        const char *what, *settings;
    } bodies[] = {
        {"upwind sbp2 {p,F}, 2D", "d=2 n=6 evolved=pF"},
        {"upwind sbp2 {p,F,J}, 2D", "d=2 n=6 evolved=pFJ"},
        {"upwind sbp2 {p,F,H,J}, 2D", "d=2 n=6 evolved=pFHJ"},
        {"upwind sbp4 {p,F,H,J}, 2D", "d=2 n=8 evolved=pFHJ stencil=sbp4"},
        {"upwind closed {p,F,H,J}, 2D", "d=2 n=6 evolved=pFHJ stencil=closed support=2 reconstruction=least-squares"},
        {"jst sbp2 {p,F,H,J}, 2D", "d=2 n=6 evolved=pFHJ scheme=jst"},
        {"upwind sbp2 {p,F,H,J}, 3D", "d=3 n=4 evolved=pFHJ"},
    };
    (void)error;
    for (size_t i = 0; i < 2 * sizeof bodies / sizeof *bodies; i++) {
        bool down = i % 2 != 0;
        struct bar body = {in, bodies[i / 2].settings, NAN};
        struct verify_extreme_row row = {.unit = "-", .least = down ? -INFINITY : 1e6, .most = down ? 1e-6 : INFINITY};
        (void)snprintf(row.what, sizeof row.what, "%s", bodies[i / 2].what);
        if (!verify_extreme_asked(in, row.what)) {
            continue;
        }
        (void)snprintf(row.quantity, sizeof row.quantity, "%s of E and rho", down ? "smallest jump" : "largest jump");
        verify_extreme_bisect(loses_at, &body, down ? 0.99 : 1.01, down ? 1e-6 : 1e6, 0.1, &row.value, &row.fails,
                              row.note, sizeof row.note);
        if (isnan(row.fails)) {
            (void)snprintf(row.note, sizeof row.note, "as far as it was driven");
        }
        verify_extreme_told(in, &row);
    }
    return true;
}
