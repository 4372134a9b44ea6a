#include "oracles/j2.h"
#include "oracles/root.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <string.h>

enum { NUMBERS = sizeof(struct j2_state) / sizeof(double), STRESSES = 10 }; /* the first of them are stresses */
static const double TOLERANCE = 1e-13;

const struct oracle_extra j2_extra[] = {
    {"plastic_strain", "-", "accumulated equivalent plastic strain"},
    {"yield_stress", "Pa", "equivalent stress at which the material now yields"},
    {0},
};

static void deviator(const double a[9], double dev[9])
{
    double mean = (a[0] + a[4] + a[8]) / 3;
    for (int i = 0; i < 9; i++) {
        dev[i] = a[i] - (i % 4 == 0 ? mean : 0);
    }
}

static double contract(const double a[9], const double b[9])
{
    double sum = 0;
    for (int i = 0; i < 9; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

double j2_equivalent(const double stress[9])
{
    double dev[9];
    deviator(stress, dev);
    return sqrt(1.5 * contract(dev, dev));
}

void j2_stress(const struct j2_state *state, double stress[9])
{
    for (int i = 0; i < 9; i++) {
        stress[i] = state->deviator[i] + (i % 4 == 0 ? state->mean : 0);
    }
}

double j2_return(const struct j2 *material, const double strain[9], struct j2_state *state)
{
    double step[9], dev[9];
    for (int i = 0; i < 9; i++) {
        step[i] = strain[i] - state->strain[i];
        state->strain[i] = strain[i];
    }
    deviator(step, dev);
    for (int i = 0; i < 9; i++) {
        state->deviator[i] += 2 * material->mu * dev[i];
    }
    state->mean = material->bulk * (strain[0] + strain[4] + strain[8]);
    double q = sqrt(1.5 * contract(state->deviator, state->deviator));
    double excess = q - material->yield - material->hardening * state->plastic;
    double flow = excess > 0 ? excess / (3 * material->mu + material->hardening) : 0;
    for (int i = 0; flow > 0 && i < 9; i++) {
        state->deviator[i] *= 1 - 3 * material->mu * flow / q;
    }
    state->plastic += flow;
    return flow;
}

/* Plastic flow keeps the stress on the yield surface: with q the equivalent stress, s its deviator and D the rate of
 * strain, dq/dt = 3 mu (s:D/q - d(plastic)/dt) = H d(plastic)/dt. */
void j2_rates(const struct j2 *material, const struct j2_state *at, bool plastic, const double rate[9],
              struct j2_state *derivative)
{
    const double *s = at->deviator;
    double D[9], q = sqrt(1.5 * contract(s, s)), flow = 0;
    deviator(rate, D);
    if (plastic) {
        flow = 3 * material->mu * contract(s, D) / q / (3 * material->mu + material->hardening);
    }
    for (int i = 0; i < 9; i++) {
        derivative->deviator[i] = 2 * material->mu * (D[i] - (plastic ? 1.5 * flow * s[i] / q : 0));
        derivative->strain[i] = rate[i];
    }
    derivative->mean = material->bulk * (rate[0] + rate[4] + rate[8]);
    derivative->plastic = flow;
}

/* One leg of a path, in numbers near one: stresses over mu, and all over the size of the strain. */
struct leg {
    const struct j2 *material;
    j2_path *path;
    const void *with;
    bool plastic;
    double size;
    struct j2_state start;
    double from;
};

static void to_numbers(const struct leg *leg, const struct j2_state *state, double y[NUMBERS])
{
    memcpy(y, state, sizeof *state);
    for (int i = 0; i < NUMBERS; i++) {
        y[i] /= leg->size * (i < STRESSES ? leg->material->mu : 1);
    }
}

static void from_numbers(const struct leg *leg, const double y[NUMBERS], struct j2_state *state)
{
    double scaled[NUMBERS];
    for (int i = 0; i < NUMBERS; i++) {
        scaled[i] = y[i] * leg->size * (i < STRESSES ? leg->material->mu : 1);
    }
    memcpy(state, scaled, sizeof *state);
}

static int leg_rates(double s, const double y[], double dydt[], void *with)
{
    const struct leg *leg = with;
    struct j2_state at, derivative;
    double rate[9];
    from_numbers(leg, y, &at);
    leg->path(leg->material, leg->with, s, &at, leg->plastic, rate);
    j2_rates(leg->material, &at, leg->plastic, rate, &derivative);
    to_numbers(leg, &derivative, dydt);
    return GSL_SUCCESS;
}

static bool follow_leg(struct leg *leg, double to, struct j2_state *end)
{
    gsl_odeiv2_system system = {leg_rates, NULL, NUMBERS, leg};
    double y[NUMBERS], s = leg->from;
    *end = leg->start;
    if (to == s) {
        return true;
    }
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, (to - s) / 4, TOLERANCE, TOLERANCE);
    if (driver == NULL) {
        return false;
    }
    to_numbers(leg, &leg->start, y);
    bool done = gsl_odeiv2_driver_apply(driver, &s, to, y) == GSL_SUCCESS;
    gsl_odeiv2_driver_free(driver);
    from_numbers(leg, y, end);
    return done;
}

static double excess(const struct j2 *material, const struct j2_state *at)
{
    return sqrt(1.5 * contract(at->deviator, at->deviator)) - (material->yield + material->hardening * at->plastic);
}

static double excess_at(double s, void *with)
{
    struct leg *leg = with;
    struct j2_state at;
    return follow_leg(leg, s, &at) ? excess(leg->material, &at) : NAN;
}

/* Where an elastic leg that ends beyond the yield surface meets it. It may begin on it and go inwards first. */
static bool meet_yield(struct leg *leg, double to, double *yielded)
{
    double inside = leg->from, part = 1;
    while (excess_at(inside, leg) >= 0) {
        part /= 2;
        inside = leg->from + part * (to - leg->from);
        if (part < 1e-9) {
            return false;
        }
    }
    return root_between(excess_at, leg, inside, to, yielded);
}

/* Whether the leg leaves the yield surface outwards at once: on it, but for round-off, and pushed on. */
static bool starts_plastic(const struct leg *leg)
{
    double rate[9], bound = 1e-12 * (leg->material->yield + leg->material->hardening * leg->start.plastic);
    leg->path(leg->material, leg->with, leg->from, &leg->start, false, rate);
    return excess(leg->material, &leg->start) >= -bound && contract(leg->start.deviator, rate) > 0;
}

bool j2_follow(const struct j2 *material, j2_path *path, const void *with, double from, double to,
               struct j2_state *state, double *yielded)
{
    double rate[9];
    struct leg leg = {.material = material, .path = path, .with = with, .from = from, .start = *state};
    path(material, with, from, state, false, rate);
    leg.size =
        sqrt(contract(rate, rate)) * fabs(to - from) + sqrt(contract(state->deviator, state->deviator)) / material->mu;
    *yielded = to;
    if (leg.size == 0 || to == from) {
        return true;
    }
    if (starts_plastic(&leg)) {
        *yielded = from;
        leg.plastic = true;
        return follow_leg(&leg, to, state);
    }
    if (!follow_leg(&leg, to, state)) {
        return false;
    }
    if (excess(material, state) <= 0) {
        return true;
    }
    if (!meet_yield(&leg, to, yielded) || !follow_leg(&leg, *yielded, &leg.start)) {
        return false;
    }
    leg.from = *yielded;
    leg.plastic = true;
    return follow_leg(&leg, to, state);
}
