#include "verify/judge.h"

#include "verify/units.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Relative: what places may lie outside a body by, where they are in double and in single precision, and what times and
 * spacings said twice may differ by. */
static const double ROUND_OFF = 1e-12, SINGLE = 4 * (double)FLT_EPSILON, SAME = 1e-6;

/* A sample beside the truth, while it is compared. */
struct comparison {
    const struct verify_truth *truth;
    const struct verify_sample *sample;
    struct verify_judged_level *level;
    struct solver_error *error;
    size_t dim;
    double *X;                  /* [count][3], [m] */
    double *weight;             /* [count] */
    struct oracle_state *state; /* [count] */
    double *extra;              /* [count][ORACLE_EXTRAS] */
    double *computed, *exact;   /* [count][9] */
};

/* The factor to SI units; a missing unit is one where the format has no place for it. */
static bool factor_of(struct comparison *c, const char *what, bool has_unit, const char *unit, const char *wanted,
                      double *factor)
{
    *factor = 1;
    bool none = strcmp(wanted, "-") == 0;
    if (!has_unit && (none || !c->sample->needs_units)) {
        c->level->assumed += none ? 0 : 1;
        return true;
    }
    if (!has_unit) {
        return verify_sample_refuse(c->sample, c->error,
                                    "the unit of %s is missing; expected [%s], or this with a prefix", what, wanted);
    }
    return verify_unit_factor(unit, wanted, factor) ||
           verify_sample_refuse(c->sample, c->error, "the unit of %s is [%s]; expected [%s]%s", what, unit, wanted,
                                none ? "" : ", or this with a prefix such as m, k or M before it");
}

static bool take_time(struct comparison *c, double given)
{
    const struct verify_sample_number *own = &c->sample->time;
    double factor, time = NAN;
    if (!isnan(own->value)) {
        if (!factor_of(c, "the time", own->has_unit, own->has_unit ? own->unit : "s", "s", &factor)) {
            return false;
        }
        time = own->value * factor;
    }
    if (isnan(time) && isnan(given)) {
        return verify_sample_refuse(c->sample, c->error, "does not say its time; give --time T [s]");
    }
    if (!isnan(time) && !isnan(given) && !(fabs(time - given) <= SAME * fmax(fabs(time), fabs(given)))) {
        return verify_sample_refuse(c->sample, c->error, "is of t = %.12g s, but --time says %.12g s", time, given);
    }
    c->level->time = isnan(time) ? given : time;
    return c->level->time >= 0 ||
           verify_sample_refuse(c->sample, c->error, "is of t = %.12g s; every oracle begins at t = 0", c->level->time);
}

static bool take_spacing(struct comparison *c, double given)
{
    const struct verify_sample_number *own = &c->sample->h;
    double factor;
    c->level->h = !isnan(given) ? given : c->sample->n > 0 ? 1.0 / c->sample->n : NAN;
    if (!isnan(own->value)) {
        if (!factor_of(c, "the spacing h", own->has_unit, own->unit, "m", &factor)) {
            return false;
        }
        c->level->h = own->value * factor;
        if (!isnan(given) && !(fabs(given - c->level->h) <= SAME * given)) {
            return verify_sample_refuse(c->sample, c->error, "has h = %.12g m, but --spacing says %.12g m", c->level->h,
                                        given);
        }
    }
    return true;
}

double verify_judged_slack(const struct verify_sample *sample, int dim, const double *X)
{
    double size = 0;
    for (size_t i = 0; i < 3 * sample->count; i++) {
        size = i % 3 < (size_t)dim ? fmax(size, fabs(X[i])) : size;
    }
    return (sample->single ? SINGLE : ROUND_OFF) * size;
}

/* Places in metres, each of them within the body but for round-off. */
static bool take_places(struct comparison *c)
{
    const struct verify_sample *sample = c->sample;
    double factor;
    if (sample->dim < (int)c->dim) {
        return verify_sample_refuse(sample, c->error, "points have %d coordinates; the oracle \"%s\" is %zuD",
                                    sample->dim, c->truth->kind->name, c->dim);
    }
    if (!factor_of(c, "the points", sample->has_unit, sample->unit, "m", &factor)) {
        return false;
    }
    for (size_t i = 0; i < 3 * sample->count; i++) {
        c->X[i] = sample->X[i] * factor;
    }
    double slack = verify_judged_slack(sample, (int)c->dim, c->X);
    for (size_t a = 0; a < sample->count; a++) {
        const double *X = c->X + 3 * a;
        double outside = c->truth->kind->outside(c->truth->oracle, X);
        if (!(outside <= slack)) {
            return verify_sample_refuse(
                sample, c->error,
                "point %zu, (%.9g, %.9g, %.9g) m, lies %.3g m outside the body of \"%s\"; points "
                "are places in the undeformed body, right to %.2g m",
                a, X[0], X[1], X[2], outside, c->truth->kind->name, slack);
        }
    }
    return true;
}

static bool is_known(const struct oracle_state *state)
{
    double number[sizeof *state / sizeof(double)];
    memcpy(number, state, sizeof number);
    bool known = true;
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        known = known && isfinite(number[i]);
    }
    return known;
}

static bool ask_oracle(struct comparison *c)
{
    const struct oracle_kind *kind = c->truth->kind;
    if (kind->reach != NULL && c->level->time > kind->reach(c->truth->oracle)) {
        return verify_sample_refuse(c->sample, c->error, "is of t = %.9g s; the oracle \"%s\" reaches to %.9g s",
                                    c->level->time, kind->name, kind->reach(c->truth->oracle));
    }
    for (size_t a = 0; a < c->sample->count; a++) {
        const double *X = c->X + 3 * a;
        kind->state(c->truth->oracle, X, c->level->time, &c->state[a]);
        if (kind->extras != NULL) {
            kind->extras(c->truth->oracle, X, c->level->time, c->extra + a * ORACLE_EXTRAS);
        }
        if (!is_known(&c->state[a])) {
            return verify_sample_refuse(
                c->sample, c->error,
                "the oracle \"%s\" does not know the fields at t = %.9g s, (%.9g, %.9g, %.9g) m: "
                "beyond its reach",
                kind->name, c->level->time, X[0], X[1], X[2]);
        }
    }
    return true;
}

/* How the numbers of a field lie: rows of a tensor, 0 where they do not have its shape. */
static size_t row_of(const struct comparison *c, enum verify_shape shape, bool symmetric, int width)
{
    if (shape == VERIFY_SCALAR) {
        return width == 1 ? 1 : 0;
    }
    if (shape == VERIFY_VECTOR) {
        return width == 3 || width == (int)c->dim ? (size_t)width : 0;
    }
    return width == 9 || (width == 6 && symmetric) ? 3 : width == (int)(c->dim * c->dim) ? c->dim : 0;
}

/* From xx, yy, zz, xy, yz, xz. */
static void expand(const double six[6], double nine[9])
{
    static const int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    for (int i = 0; i < 9; i++) {
        nine[i] = six[place[i]];
    }
}

/* Whether the components that count are all there: of tables some may be missing. */
static bool is_complete(const struct comparison *c, size_t field, const struct verify_sample_field *given, size_t row)
{
    enum verify_shape shape = verify_judged_field(c->truth->kind, field).shape;
    bool normal_only = field == VERIFY_P || field == VERIFY_SIGMA;
    size_t rows = shape == VERIFY_SCALAR ? 1 : c->dim, columns = shape == VERIFY_TENSOR ? c->dim : 1;
    if (given->width == 6) {
        return true;
    }
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            size_t at = shape == VERIFY_TENSOR ? i * row + j : i;
            if ((!normal_only || i == j) && (given->given >> at & 1U) == 0) {
                return false;
            }
        }
    }
    return true;
}

/* `first`: the number that counts of an extra scalar that is a component of the field. */
static void measure(struct comparison *c, size_t field, const struct verify_sample_field *given, size_t row,
                    size_t first, double factor)
{
    const struct oracle_kind *kind = c->truth->kind;
    bool extra = field >= VERIFY_STATE_FIELDS;
    enum verify_field of = extra ? VERIFY_PRESSURE : (enum verify_field)field; /* an extra is a scalar too */
    size_t width = 0;
    for (size_t a = 0; a < c->sample->count; a++) {
        double value[9], taken[9];
        const double *from = given->value + a * (size_t)given->width;
        size_t numbers = given->width == 6 ? 9 : (size_t)given->width;
        if (given->width == 6) {
            expand(from, value);
        } else {
            memcpy(value, from, numbers * sizeof *value);
        }
        for (size_t i = 0; i < numbers; i++) {
            value[i] *= factor;
        }
        width = verify_field_take(of, value + first, row, c->dim, taken);
        memcpy(c->computed + a * width, taken, width * sizeof *taken);
        if (extra) {
            taken[0] = c->extra[a * ORACLE_EXTRAS + field - VERIFY_STATE_FIELDS];
        } else {
            (void)verify_field_exact(of, kind, &c->state[a], c->dim, taken);
        }
        memcpy(c->exact + a * width, taken, width * sizeof *taken);
    }
    verify_norms_keep(c->level->error + VERIFY_NORMS * field,
                      verify_norms_field(c->sample->count, width, c->weight, c->computed, c->exact));
    c->level->known[field] = true;
}

/* The sample's field that is this one; NULL if there is none. Two of them are a mistake. */
static bool find(struct comparison *c, size_t field, const struct verify_sample_field **found)
{
    *found = NULL;
    for (size_t i = 0; i < c->sample->field_count; i++) {
        const struct verify_sample_field *here = &c->sample->field[i];
        if (!verify_judged_is(c->truth->kind, field, here->name)) {
            continue;
        }
        if (*found != NULL) {
            return verify_sample_refuse(c->sample, c->error, "fields %s and %s are two names of one field",
                                        (*found)->name, here->name);
        }
        *found = here;
    }
    return true;
}

static bool compare_field(struct comparison *c, size_t field)
{
    static const char *const shapes[] = {"1 (a scalar)", "one for each axis, or 3 (a vector)",
                                         "one for each pair of axes, or 9 (a tensor, row by row)"};
    struct verify_judged_field about = verify_judged_field(c->truth->kind, field);
    const struct verify_sample_field *given;
    double factor;
    char what[VERIFY_SAMPLE_NAME + 8];
    if (!find(c, field, &given)) {
        return false;
    }
    if (given == NULL) {
        return true;
    }
    bool symmetric = field == VERIFY_SIGMA || field == VERIFY_SIGMA_ALL;
    int component = verify_judged_component(c->truth->kind, field, given->name);
    enum verify_shape shape = component < 0 ? about.shape : VERIFY_VECTOR;
    size_t row = row_of(c, shape, symmetric, given->width);
    if (row == 0) {
        return verify_sample_refuse(c->sample, c->error, "field %s has %d numbers a point, expected %s", given->name,
                                    given->width, shapes[shape]);
    }
    (void)snprintf(what, sizeof what, "field %s", given->name);
    if (!factor_of(c, what, given->has_unit, given->unit, about.unit, &factor)) {
        return false;
    }
    if (component < 0 ? is_complete(c, field, given, row) : (given->given >> component & 1U) != 0) {
        measure(c, field, given, row, component < 0 ? 0 : (size_t)component, factor);
    }
    return true;
}

/* Names of what nobody asked for, and whether anything was compared at all. */
static bool finish(struct comparison *c)
{
    char *ignored = c->level->ignored;
    const size_t size = sizeof c->level->ignored;
    size_t used = 0, fields = verify_judged_count(c->truth->kind);
    bool any = false;
    for (size_t field = 0; field < fields; field++) {
        any = any || c->level->known[field];
    }
    for (size_t i = 0; i < c->sample->field_count && used < size; i++) {
        bool compared = false;
        for (size_t field = 0; field < fields && !compared; field++) {
            compared = c->level->known[field] && verify_judged_is(c->truth->kind, field, c->sample->field[i].name);
        }
        if (!compared) {
            int added = snprintf(ignored + used, size - used, "%s%s", used > 0 ? ", " : "", c->sample->field[i].name);
            used += added > 0 ? (size_t)added : 0;
        }
    }
    solver_plain(ignored, false);
    return any ||
           verify_sample_refuse(c->sample, c->error,
                                "holds no field that can be compared; expected u, v, p, F, H, J, P, sigma, pressure or "
                                "what else the oracle \"%s\" knows, with all components; it has %s",
                                c->truth->kind->name, used > 0 ? ignored : "none");
}

static bool reserve(struct comparison *c)
{
    size_t count = c->sample->count;
    c->X = calloc(count, 3 * sizeof *c->X);
    c->weight = calloc(count, sizeof *c->weight);
    c->state = calloc(count, sizeof *c->state);
    c->extra = calloc(count, ORACLE_EXTRAS * sizeof *c->extra);
    c->computed = calloc(count, 9 * sizeof *c->computed);
    c->exact = calloc(count, 9 * sizeof *c->exact);
    return (c->X != NULL && c->weight != NULL && c->state != NULL && c->extra != NULL && c->computed != NULL &&
            c->exact != NULL) ||
           solver_fail(c->error, SOLVER_NO_MEMORY, "%.360s: no memory to compare %zu points", c->sample->place, count);
}

static bool take_weights(struct comparison *c)
{
    double sum = 0;
    for (size_t a = 0; a < c->sample->count; a++) {
        c->weight[a] = c->sample->weight != NULL ? c->sample->weight[a] : 1.0;
        sum += c->weight[a];
    }
    return (sum > 0 && isfinite(sum)) ||
           verify_sample_refuse(c->sample, c->error, "its weights sum to %g, expected more than 0", sum);
}

bool verify_judge_level(const struct verify_truth *truth, const struct verify_sample *sample, double time, double h,
                        struct verify_judged_level *level, struct solver_error *error)
{
    *level = (struct verify_judged_level){.sample = sample};
    for (size_t i = 0; i < VERIFY_JUDGED_ERRORS; i++) {
        level->error[i] = level->rate[i] = NAN;
    }
    struct comparison c = {
        .truth = truth, .sample = sample, .level = level, .error = error, .dim = (size_t)truth->kind->dim};
    bool done = reserve(&c) && take_time(&c, time) && take_spacing(&c, h) && take_places(&c) && take_weights(&c) &&
                ask_oracle(&c);
    for (size_t field = 0; done && field < verify_judged_count(truth->kind); field++) {
        done = compare_field(&c, field);
    }
    done = done && finish(&c);
    free(c.X);
    free(c.weight);
    free(c.state);
    free(c.extra);
    free(c.computed);
    free(c.exact);
    return done;
}
