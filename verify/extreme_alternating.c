/* Zero-energy modes: a velocity that alternates from particle to particle has no gradient that a central stencil sees,
 * and so no stress that would restore it. It must be damped by the scheme, in a body at rest, compressed or stretched.
 * Where the kernel moves with the particles, tension drives the mode: the tensile instability, which a scheme in the
 * reference frame does not know. */
#include "verify/extremes.h"

#include "solver/material.h"

#include <math.h>
#include <stdio.h>

/* Within these steps nothing comes from the boundary to where the pattern is looked at. */
enum { STEPS = 10, MARGIN = 4 };
static const double amplitude = 1e-6; /* over the sound speed */
static const double damped = 0.1;     /* c_p/h: to a third within ten crossings of a spacing, or faster */
static const double idle = 0.01;      /* c_p/h: neither damped nor driven in a hundred */

/* Share of the alternating pattern in the velocities along x, away from the boundary [m/s]. */
static double alternating(struct verify_trial *trial)
{
    struct solver_output out;
    struct solver_error error;
    if (!solver_run_output(trial->run, &out, &error) || out.cloud->site == NULL) {
        return NAN;
    }
    size_t dim = (size_t)out.cloud->dim;
    double sum = 0.0, weight = 0.0;
    for (size_t a = 0; a < out.cloud->count; a++) {
        size_t sign = 0;
        bool inside = true;
        for (size_t i = 0; i < dim; i++) {
            uint32_t site = out.cloud->site[a * dim + i];
            sign += site;
            inside = inside && site >= MARGIN && site + MARGIN < out.cloud->points[i];
        }
        if (inside) {
            sum += out.V[a] * (sign % 2 == 0 ? 1.0 : -1.0) * out.v[a * dim];
            weight += out.V[a];
        }
    }
    return sum / weight;
}

enum fate { DIES, STAYS, GROWS };

struct damper {
    const char *what, *settings;
    enum fate fate;
    double stretch[3]; /* 0: no more */
};

/* Where the decay has to lie. */
static void bound(struct verify_extreme_row *row, enum fate fate)
{
    double times = log(2.0) / fabs(row->value);
    if (fate == DIES) {
        row->least = damped;
        (void)snprintf(row->note, sizeof row->note, "%s in %.2g crossings of a spacing",
                       row->value > 0.0 ? "halved" : "doubled", times);
    } else if (fate == STAYS) {
        row->least = -idle;
        row->most = idle;
        (void)snprintf(row->note, sizeof row->note, "the control: nothing damps it, nothing drives it");
    } else {
        row->most = -idle;
        (void)snprintf(row->note, sizeof row->note, "tensile instability: doubled in %.2g crossings of a spacing",
                       times);
    }
}

static bool measure(const struct verify_extremes *in, const struct damper *damper, int dim, double stretch,
                    struct solver_error *error)
{
    struct verify_trial trial;
    struct verify_extreme_row row = {
        .quantity = "decay", .unit = "c_p/h", .fails = NAN, .least = -INFINITY, .most = INFINITY};
    (void)snprintf(row.what, sizeof row.what, "%s, stretch %g, %dD", damper->what, stretch, dim);
    if (!verify_extreme_asked(in, row.what)) {
        return true;
    }
    bool ok = verify_trial_open(in, "free-block", &trial, error,
                                "d=%d n=12 held=1 speed=%g alternate=1 stretch=%g stencil=sbp2 cfl=0.1 threads=1 %s",
                                dim, amplitude, stretch, damper->settings);
    if (!ok) {
        return false;
    }
    double before = alternating(&trial);
    ok = solver_run_steps(trial.run, STEPS, error);
    if (ok) {
        struct solver_output out;
        ok = solver_run_output(trial.run, &out, error);
        struct solver_material_constants material =
            solver_material_constants(trial.scene->E, trial.scene->nu, trial.scene->rho);
        double after = alternating(&trial);
        double crossings = ok ? out.time * material.cp / solver_run_facts(trial.run).spacing : NAN;
        row.value = -log(fabs(after / before)) / crossings;
        bound(&row, damper->fate);
        verify_extreme_told(in, &row);
    }
    verify_trial_close(&trial);
    return ok;
}

#define ULSPH "scheme=ulsph integrator=tvd-rk2 material.model=linear-elastic "
#define BARE  "ulsph.dissipation=none ulsph.delta=0 ulsph.xsph=0 "

bool verify_extreme_alternating(const struct verify_extremes *in, struct solver_error *error)
{
    static const struct damper dampers[] = {
        {"upwind {p,F}", "scheme=upwind evolved=pF", DIES, {1.0, 0.8, 1.25}},
        {"upwind {p,F,H,J}", "scheme=upwind evolved=pFHJ", DIES, {1.0, 0.8, 1.25}},
        {"upwind, first order", "scheme=upwind evolved=pF reconstruction=none", DIES, {1.0, 0.8, 1.25}},
        {"jst, 1/64", "scheme=jst evolved=pF", DIES, {1.0, 0.8, 1.25}},
        {"jst, no dissipation", "scheme=jst evolved=pF jst.kappa4=0", STAYS, {1.0, 0.8, 1.25}},
        {"jst sph, no dissipation",
         "scheme=jst evolved=pF jst.kappa4=0 stencil=sph support=2",
         STAYS,
         {1.0, 0.8, 1.25}},
        {"ulsph, R and TIC", ULSPH, DIES, {1.0, 0.91, 1.09}}, /* it starts from strains up to 0.1 */
        {"ulsph, TIC alone", ULSPH BARE "ulsph.tension=control", STAYS, {1.0, 1.09}},
        {"ulsph, neither", ULSPH BARE "ulsph.tension=none", GROWS, {1.09}},
    };
    for (size_t i = 0; i < sizeof dampers / sizeof *dampers; i++) {
        for (int dim = 1; dim <= 3; dim++) {
            for (size_t s = 0; s < 3 && dampers[i].stretch[s] > 0.0; s++) {
                if (!measure(in, &dampers[i], dim, dampers[i].stretch[s], error)) {
                    return false;
                }
            }
        }
    }
    return true;
}
