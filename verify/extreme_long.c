/* Long runs: a body that turns a thousand times, and a million steps of a free vibration. */
#include "verify/extremes.h"

#include "solver/material.h"

#include <math.h>
#include <stdio.h>

/* --- a thousand turns --- */

enum { TURNS = 1000 };
static const double turning = 0.2; /* angular velocity, over c / length */

static double energy(const struct solver_totals *totals)
{
    return totals->kinetic + totals->strain;
}

static void tell(const struct verify_extremes *in, const char *what, const char *quantity, double value, double least,
                 double most, const char *note)
{
    struct verify_extreme_row row = {.value = value, .fails = NAN, .least = least, .most = most, .unit = "-"};
    (void)snprintf(row.what, sizeof row.what, "%s", what);
    (void)snprintf(row.quantity, sizeof row.quantity, "%s", quantity);
    (void)snprintf(row.note, sizeof row.note, "%s", note);
    verify_extreme_told(in, &row);
}

static bool turn(const struct verify_extremes *in, const char *what, const char *settings, struct solver_error *error)
{
    struct verify_trial trial;
    double periods = TURNS * 2.0 * M_PI / turning;
    if (!verify_extreme_asked(in, what)) {
        return true;
    }
    if (!verify_trial_open(in, "free-block", &trial, error,
                           "d=2 n=2 speed=0 turn=%.17g periods=%.17g angular_momentum=projected integrator=rk4 "
                           "cfl=0.45 threads=1 %s",
                           turning, periods, settings)) {
        return false;
    }
    bool ok = verify_trial_finish(&trial, error);
    if (ok) {
        const struct solver_history *history = solver_run_history(trial.run);
        const struct solver_totals *first = &history->totals[0];
        const struct solver_totals *last = &history->totals[history->count - 1];
        char note[80];
        (void)snprintf(note, sizeof note, "%zu steps, strain about %.1g", solver_run_facts(trial.run).steps,
                       turning * turning / 8.0);
        tell(in, what, "angular momentum, relative change", fabs(last->angular[2] / first->angular[2] - 1.0), -INFINITY,
             1e-10, note);
        tell(in, what, "energy kept", energy(last) / energy(first), 0.9, 1.0 + 1e-10,
             "the rest goes while the body settles to its spin");
    }
    verify_trial_close(&trial);
    return ok;
}

bool verify_extreme_spin(const struct verify_extremes *in, struct solver_error *error)
{
    return turn(in, "upwind {p,F}", "evolved=pF", error) && turn(in, "upwind {p,F,H,J}", "evolved=pFHJ", error) &&
           turn(in, "jst {p,F}", "scheme=jst evolved=pF", error);
}

/* --- a million steps --- */

enum { STEPS = 1000000, FIRST = 2000, SAMPLE = 4 };

/* The first mode of a free bar: its velocity and strain as a complex number, which turns at the mode's frequency. */
static bool mode(struct verify_trial *trial, double c, double *velocity, double *strain, double *time,
                 struct solver_error *error)
{
    struct solver_output out;
    if (!solver_run_output(trial->run, &out, error)) {
        return false;
    }
    *velocity = *strain = 0.0;
    *time = out.time;
    for (size_t a = 0; a < out.cloud->count; a++) {
        double X = out.cloud->X[a];
        *velocity += 2.0 * out.V[a] * out.v[a] * cos(M_PI * X);
        *strain += 2.0 * out.V[a] * c * (out.F[a] - 1.0) * sin(M_PI * X);
    }
    return true;
}

/* Angular frequency [rad/s] over the first steps, by the phase that they turn through. */
static bool frequency(struct verify_trial *trial, double c, double *omega, struct solver_error *error)
{
    double v, s, t, begun;
    if (!mode(trial, c, &v, &s, &begun, error)) {
        return false;
    }
    double before = atan2(s, v), turned = 0.0;
    for (int i = 0; i < FIRST / SAMPLE; i++) {
        if (!solver_run_steps(trial->run, SAMPLE, error) || !mode(trial, c, &v, &s, &t, error)) {
            return false;
        }
        double phase = atan2(s, v);
        turned += fabs(remainder(phase - before, 2.0 * M_PI));
        before = phase;
    }
    *omega = turned / (t - begun);
    return true;
}

static bool vibrate(const struct verify_extremes *in, const char *what, const char *settings,
                    struct solver_error *error)
{
    struct verify_trial trial;
    if (!verify_extreme_asked(in, what)) {
        return true;
    }
    if (!verify_trial_open(in, "free-block", &trial, error,
                           "d=1 n=16 material.model=linear-elastic evolved=pF integrator=rk4 cfl=0.45 threads=1 %s",
                           settings)) {
        return false;
    }
    double c = solver_material_constants(trial.scene->E, trial.scene->nu, trial.scene->rho).cp;
    double v = 0.0, s = 0.0, t = 0.0, omega = 0.0, first = 0.0;
    bool ok = mode(&trial, c, &v, &s, &t, error);
    first = hypot(v, s);
    ok = ok && frequency(&trial, c, &omega, error);
    double early = 0.0, since = 0.0;
    if (ok) {
        ok = mode(&trial, c, &v, &s, &t, error);
        early = hypot(v, s) / first;
        since = t * c / 2.0; /* periods */
        ok = ok && verify_trial_steps(&trial, STEPS - FIRST, error) && mode(&trial, c, &v, &s, &t, error);
    }
    if (ok) {
        char note[120];
        (void)snprintf(note, sizeof note, "%.0f periods; as much phase drifts per cycle", since);
        tell(in, what, "frequency error, 2000 steps", omega / (M_PI * c) - 1.0, -0.01, 0.01, note);
        tell(in, what, "amplitude kept, 2000 steps", early, -INFINITY, 1.0 + 1e-10, "never more than there was");
        (void)snprintf(note, sizeof note, "%.0f periods", t * c / 2.0);
        tell(in, what, "amplitude kept, 1e6 steps", hypot(v, s) / first, -INFINITY, 1.0 + 1e-10, note);
    }
    verify_trial_close(&trial);
    return ok;
}

bool verify_extreme_vibration(const struct verify_extremes *in, struct solver_error *error)
{
    return vibrate(in, "upwind sbp2", "scheme=upwind stencil=sbp2", error) &&
           vibrate(in, "upwind sbp4", "scheme=upwind stencil=sbp4", error) &&
           vibrate(in, "jst sbp2, 1/64", "scheme=jst stencil=sbp2", error) &&
           vibrate(in, "jst sbp2, no dissipation", "scheme=jst stencil=sbp2 jst.kappa4=0", error);
}
