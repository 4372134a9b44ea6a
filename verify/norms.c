#include "verify/norms.h"

#include "solver/scheme.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In the order of enum verify_field: name, unit, meaning. */
#define OF_STATE(ROW)                                                                                                  \
    ROW("p", "kg/(m^2 s)", "linear momentum, all components")                                                          \
    ROW("P", "Pa", "first Piola-Kirchhoff stress, normal components")                                                  \
    ROW("P_all", "Pa", "first Piola-Kirchhoff stress, all components")                                                 \
    ROW("u", "m", "displacement, all components")                                                                      \
    ROW("F", "-", "deformation gradient less the identity, all components")                                            \
    ROW("H", "-", "cofactor of F less the identity, all components")                                                   \
    ROW("J", "-", "Jacobian less 1")                                                                                   \
    ROW("sigma", "Pa", "Cauchy stress, normal components")                                                             \
    ROW("sigma_all", "Pa", "Cauchy stress, all components")                                                            \
    ROW("v", "m/s", "velocity, all components")                                                                        \
    ROW("pressure", "Pa", "mean Cauchy stress")
#define OF_PROBES(ROW)                                                                                                 \
    ROW("probes", "m", "displacement at the probes over time, all components")                                         \
    ROW("probes_y", "m", "displacement along y at the probes over time")

/* Norm by norm, in the order of keep() below. */
#define NAMES(field, unit, meaning) field, field "_abs", field "_max", field "_abs_max", field "_l1",
#define UNITS(field, unit, meaning) "-", unit, "-", unit, "-",
#define MEANINGS(field, unit, meaning)                                                                                 \
    "relative L2 error of the " meaning, "absolute L2 error of the " meaning, "relative max error of the " meaning,    \
        "absolute max error of the " meaning, "relative L1 error of the " meaning,
#define SNAPSHOT_NAMES(field, unit, meaning)    NAMES("snapshots_" field, unit, meaning)
#define SNAPSHOT_MEANINGS(field, unit, meaning) MEANINGS(field, unit, meaning ", largest over the snapshots")

static const char *const name_table[] = {OF_STATE(NAMES) OF_PROBES(NAMES) OF_STATE(SNAPSHOT_NAMES) "probes_nrmse",
                                         "probes_y_nrmse", "beside", "beside_abs"};
static const char *const unit_table[] = {OF_STATE(UNITS) OF_PROBES(UNITS) OF_STATE(UNITS) "-", "-", "-", "m"};
static const char *const meaning_table[] = {
    OF_STATE(MEANINGS) OF_PROBES(MEANINGS)
        OF_STATE(SNAPSHOT_MEANINGS) "root mean square error at the probes over the scene's probe_scale",
    "root mean square error along y at the probes over the scene's probe_scale",
    "relative L2 difference of the displacement at the probes over time from the configuration beside",
    "absolute L2 difference of the displacement at the probes over time from the configuration beside"};
static const char *const suffix_table[] = {NAMES("", , )};
static const char *const norm_meaning_table[] = {MEANINGS(, , "")};
static const char *const norm_unit_table[] = {UNITS(, "of the field", )};
_Static_assert(sizeof suffix_table == VERIFY_NORMS * sizeof *suffix_table, "one suffix per norm");
_Static_assert(sizeof name_table == VERIFY_ERRORS * sizeof *name_table, "one name per error");
_Static_assert(sizeof unit_table == VERIFY_ERRORS * sizeof *unit_table, "one unit per error");
_Static_assert(sizeof meaning_table == VERIFY_ERRORS * sizeof *meaning_table, "one meaning per error");

const char verify_error_names[] =
    "p, P, P_all, u, F, H, J, sigma, sigma_all, v, pressure, probes, probes_y, each also with _abs, _max, _abs_max or "
    "_l1, all but those of probes also with snapshots_ before "
    "it, probes_nrmse, probes_y_nrmse, beside and beside_abs";

__attribute__((noinline)) double verify_larger(double a, double b)
{
    if (isnan(a) || isnan(b)) {
        return isnan(a) ? a : b;
    }
    return a > b ? a : b;
}

struct verify_norms verify_norms_field(size_t count, size_t width, const double *V, const double *computed,
                                       const double *exact)
{
    double volume = 0, error_sum = 0, exact_sum = 0, error_max = 0, exact_max = 0, error_l1 = 0, exact_l1 = 0;
    for (size_t a = 0; a < count; a++) {
        double error = 0, size = 0;
        for (size_t i = a * width; i < (a + 1) * width; i++) {
            double e = computed[i] - exact[i];
            error += e * e;
            size += exact[i] * exact[i];
        }
        volume += V[a];
        error_sum += V[a] * error;
        exact_sum += V[a] * size;
        error_l1 += V[a] * sqrt(error);
        exact_l1 += V[a] * sqrt(size);
        error_max = verify_larger(error_max, error);
        exact_max = verify_larger(exact_max, size);
    }
    return (struct verify_norms){
        .relative_l2 = isgreater(exact_sum, 0) ? sqrt(error_sum / exact_sum) : NAN,
        .absolute_l2 = sqrt(error_sum / volume),
        .relative_max = isgreater(exact_max, 0) ? sqrt(error_max / exact_max) : NAN,
        .absolute_max = sqrt(error_max),
        .relative_l1 = isgreater(exact_l1, 0) ? error_l1 / exact_l1 : NAN,
    };
}

const char *verify_error_name(size_t error)
{
    return name_table[error];
}

const char *verify_norm_suffix(size_t norm)
{
    return suffix_table[norm];
}

const char *verify_norm_meaning(size_t norm)
{
    return norm_meaning_table[norm];
}

bool verify_norm_is_absolute(size_t norm)
{
    return norm_unit_table[norm][0] != '-';
}

const char *verify_error_unit(size_t error)
{
    return unit_table[error];
}

const char *verify_error_meaning(size_t error)
{
    return meaning_table[error];
}

bool verify_error_has_order(size_t error)
{
    return error < VERIFY_BESIDE;
}

size_t verify_error_find(const char *name)
{
    size_t error = 0;
    while (error < VERIFY_ERRORS && strcmp(name_table[error], name) != 0) {
        error++;
    }
    return error;
}

/* The field that an error is of. */
static enum verify_field field_of(size_t error)
{
    return (enum verify_field)((error < VERIFY_SNAPSHOT_ERRORS ? error : error - VERIFY_SNAPSHOT_ERRORS) /
                               VERIFY_NORMS);
}

static bool is_of_deformation(enum verify_field field)
{
    return field == VERIFY_P || field == VERIFY_P_ALL || field == VERIFY_F || field == VERIFY_H;
}

bool verify_error_known(const struct solver_scene *scene, size_t error)
{
    const struct solver_scheme *scheme = solver_scheme_find(scene->scheme);
    return scheme == NULL || scheme->deformation || !is_of_deformation(field_of(error));
}

bool verify_error_applies(const struct solver_scene *scene, size_t error, const char **lacks)
{
    bool of_snapshots = error >= VERIFY_SNAPSHOT_ERRORS && error < VERIFY_PROBES_NRMSE;
    bool of_probes = !of_snapshots && error >= VERIFY_STATE_ERRORS;
    bool along_y = error == VERIFY_PROBES_Y_NRMSE || field_of(error) == VERIFY_PROBES_Y;
    if (!verify_error_has_order(error)) {
        *lacks = scene->beside.count == 0 ? "beside" : NULL;
        return *lacks == NULL;
    }
    *lacks = scene->oracle[0] == '\0'                                    ? "oracle, to compare with"
             : of_snapshots && scene->snapshot_count == 0                ? "snapshots"
             : of_probes && scene->probe_count == 0                      ? "probes"
             : field_of(error) == VERIFY_H && scene->dim < 2             ? "dim = 2 or 3: in 1D the cofactor is 1"
             : along_y && scene->dim < 2                                 ? "dim = 2 or 3, so that there is a y"
             : error >= VERIFY_PROBES_NRMSE && !(scene->probe_scale > 0) ? "probe_scale"
             : !verify_error_known(scene, error)                         ? "scheme set to one that knows F and P"
                                                                         : NULL;
    return *lacks == NULL;
}

enum verify_shape verify_field_shape(enum verify_field field)
{
    bool vector = field == VERIFY_p || field == VERIFY_u || field == VERIFY_v;
    bool scalar = field == VERIFY_PRESSURE || field == VERIFY_J;
    return vector ? VERIFY_VECTOR : scalar ? VERIFY_SCALAR : VERIFY_TENSOR;
}

const char *verify_field_name(enum verify_field field)
{
    return name_table[(size_t)VERIFY_NORMS * (size_t)field];
}

const char *verify_field_unit(enum verify_field field)
{
    return unit_table[(size_t)VERIFY_NORMS * (size_t)field + 1];
}

size_t verify_field_take(enum verify_field field, const double *value, size_t row, size_t dim, double out[9])
{
    enum verify_shape shape = verify_field_shape(field);
    bool normal_only = field == VERIFY_P || field == VERIFY_SIGMA;
    double shift = field == VERIFY_F || field == VERIFY_H || field == VERIFY_J ? 1.0 : 0.0;
    size_t width = 0, rows = shape == VERIFY_SCALAR ? 1 : dim, columns = shape == VERIFY_TENSOR ? dim : 1;
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            if (shape != VERIFY_TENSOR) {
                out[width++] = value[i] - shift;
            } else if (!normal_only || i == j) {
                out[width++] = value[i * row + j] - (i == j ? shift : 0.0);
            }
        }
    }
    return width;
}

size_t verify_field_whole(enum verify_field field, const struct oracle_kind *kind, const struct oracle_state *state,
                          double value[9])
{
    static const size_t width[] = {[VERIFY_SCALAR] = 1, [VERIFY_VECTOR] = 3, [VERIFY_TENSOR] = 9};
    size_t count = width[verify_field_shape(field)];
    double sigma[9], H[9], J, pressure;
    const double *of = field == VERIFY_p   ? state->p
                       : field == VERIFY_u ? state->u
                       : field == VERIFY_v ? state->v
                       : field == VERIFY_F ? state->F
                                           : state->P;
    if (field == VERIFY_SIGMA || field == VERIFY_SIGMA_ALL || field == VERIFY_PRESSURE) {
        oracle_cauchy(kind, state, sigma);
        pressure = (sigma[0] + sigma[4] + sigma[8]) / 3;
        of = field == VERIFY_PRESSURE ? &pressure : sigma;
    } else if (field == VERIFY_H || field == VERIFY_J) {
        J = oracle_measures(kind->finite_strain, state->F, H);
        of = field == VERIFY_J ? &J : H;
    }
    memcpy(value, of, count * sizeof *value);
    return count;
}

size_t verify_field_exact(enum verify_field field, const struct oracle_kind *kind, const struct oracle_state *state,
                          size_t dim, double out[9])
{
    double value[9];
    (void)verify_field_whole(field, kind, state, value);
    return verify_field_take(field, value, 3, dim, out);
}

/* Particle a's value in a run; NULL if the scheme does not know the field. */
static const double *computed_at(enum verify_field field, const struct solver_output *output, size_t a)
{
    size_t dim = (size_t)output->cloud->dim;
    const double *of = field == VERIFY_p                                    ? output->p
                       : field == VERIFY_u                                  ? output->u
                       : field == VERIFY_v                                  ? output->v
                       : field == VERIFY_PRESSURE                           ? output->pressure
                       : field == VERIFY_F                                  ? output->F
                       : field == VERIFY_H                                  ? output->H
                       : field == VERIFY_J                                  ? output->J
                       : field == VERIFY_SIGMA || field == VERIFY_SIGMA_ALL ? output->sigma
                                                                            : output->P;
    enum verify_shape shape = verify_field_shape(field);
    return of == NULL ? NULL : of + a * (shape == VERIFY_SCALAR ? 1 : shape == VERIFY_VECTOR ? dim : dim * dim);
}

static struct verify_norms measure(enum verify_field field, const struct solver_output *output,
                                   const struct oracle_kind *kind, const struct oracle_state *state, double *computed,
                                   double *exact)
{
    size_t dim = (size_t)output->cloud->dim, width = 0;
    if (computed_at(field, output, 0) == NULL) {
        return (struct verify_norms){NAN, NAN, NAN, NAN, NAN}; /* the scheme does not know it */
    }
    for (size_t a = 0; a < output->cloud->count; a++) {
        double of_run[9], of_oracle[9];
        width = verify_field_take(field, computed_at(field, output, a), dim, dim, of_run);
        (void)verify_field_exact(field, kind, &state[a], dim, of_oracle);
        memcpy(computed + a * width, of_run, width * sizeof *computed);
        memcpy(exact + a * width, of_oracle, width * sizeof *exact);
    }
    return verify_norms_field(output->cloud->count, width, output->V, computed, exact);
}

void verify_norms_keep(double error[VERIFY_NORMS], struct verify_norms norms)
{
    error[0] = norms.relative_l2;
    error[1] = norms.absolute_l2;
    error[2] = norms.relative_max;
    error[3] = norms.absolute_max;
    error[4] = norms.relative_l1;
}

static void keep(double *error, enum verify_field field, struct verify_norms norms)
{
    verify_norms_keep(error + (size_t)VERIFY_NORMS * (size_t)field, norms);
}

/* Of `count` displacements [3] those along y, in place. */
static void keep_y(size_t count, double *u)
{
    for (size_t i = 0; i < count; i++) {
        u[i] = u[3 * i + 1];
    }
}

/* Rows of the history times probes, each a point in time and place. */
bool verify_norms_probes(const struct solver_history *history, const struct oracle_kind *kind,
                         const struct oracle *oracle, double scale, double error[VERIFY_ERRORS],
                         struct solver_error *why)
{
    const struct verify_norms unmeasured = {NAN, NAN, NAN, NAN, NAN};
    size_t count = history->count * history->probe_count;
    struct verify_norms all = unmeasured, along_y = unmeasured;
    double *exact = calloc(count + 1, 7 * sizeof *exact); /* one more, so that none is no failure */
    if (exact == NULL) {
        return solver_fail(why, SOLVER_NO_MEMORY, "no memory to compare %zu rows of history with the oracle",
                           history->count);
    }
    double *weight = exact + 3 * count, *computed = exact + 4 * count;
    for (size_t i = 0; i < count; i++) {
        struct oracle_state state;
        kind->state(oracle, history->probe_X[i % history->probe_count], history->totals[i / history->probe_count].time,
                    &state);
        memcpy(exact + 3 * i, state.u, sizeof state.u);
        weight[i] = 1.0;
    }
    if (count > 0) {
        memcpy(computed, history->probe_u, 3 * count * sizeof *computed);
        all = verify_norms_field(count, 3, weight, computed, exact);
        keep_y(count, computed);
        keep_y(count, exact);
        along_y = verify_norms_field(count, 1, weight, computed, exact);
    }
    keep(error, VERIFY_PROBES, all);
    keep(error, VERIFY_PROBES_Y, along_y);
    error[VERIFY_PROBES_NRMSE] = scale > 0 ? all.absolute_l2 / scale : NAN;
    error[VERIFY_PROBES_Y_NRMSE] = scale > 0 ? along_y.absolute_l2 / scale : NAN;
    free(exact);
    return true;
}

bool verify_norms_state(const struct solver_output *output, const struct oracle_kind *kind, const struct oracle *oracle,
                        double error[VERIFY_STATE_ERRORS], struct solver_error *why)
{
    size_t count = output->cloud->count, dim = (size_t)output->cloud->dim;
    struct oracle_state *state = calloc(count, sizeof *state);
    double *computed = calloc(count, 9 * sizeof *computed);
    double *exact = calloc(count, 9 * sizeof *exact);
    bool done = state != NULL && computed != NULL && exact != NULL;
    for (size_t a = 0; done && a < count; a++) {
        double X[3] = {0, 0, 0};
        memcpy(X, output->cloud->X + a * dim, dim * sizeof *X);
        kind->state(oracle, X, output->time, &state[a]);
    }
    for (size_t field = 0; done && field < VERIFY_STATE_FIELDS; field++) {
        keep(error, (enum verify_field)field, measure((enum verify_field)field, output, kind, state, computed, exact));
    }
    free(state);
    free(computed);
    free(exact);
    return done || solver_fail(why, SOLVER_NO_MEMORY, "no memory to compare %zu particles with the oracle", count);
}

void verify_norms_worst(size_t snapshots_before, const double of_snapshot[VERIFY_STATE_ERRORS],
                        double error[VERIFY_ERRORS])
{
    double *worst = error + VERIFY_SNAPSHOT_ERRORS;
    for (size_t i = 0; i < VERIFY_STATE_ERRORS; i++) {
        worst[i] = snapshots_before == 0 ? of_snapshot[i] : verify_larger(worst[i], of_snapshot[i]);
    }
}
