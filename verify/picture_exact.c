#include "verify/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double mean_stress(const double s[9])
{
    return (s[0] + s[4] + s[8]) / 3;
}

static double von_mises(const double s[9])
{
    double normal = (s[0] - s[4]) * (s[0] - s[4]) + (s[4] - s[8]) * (s[4] - s[8]) + (s[8] - s[0]) * (s[8] - s[0]);
    return sqrt(0.5 * normal + 3 * (s[1] * s[1] + s[5] * s[5] + s[6] * s[6]));
}

/* The exact values of a field by name into out; false for fields an oracle does not know. */
static bool exact_value(const char *name, const struct oracle_kind *kind, const struct oracle_state *state,
                        double out[9])
{
    double sigma[9];
    oracle_cauchy(kind, state, sigma);
    if (strcmp(name, "displacement") == 0) {
        memcpy(out, state->u, sizeof state->u);
    } else if (strcmp(name, "velocity") == 0) {
        memcpy(out, state->v, sizeof state->v);
    } else if (strcmp(name, "F") == 0) {
        memcpy(out, state->F, sizeof state->F);
    } else if (strcmp(name, "P") == 0) {
        memcpy(out, state->P, sizeof state->P);
    } else if (strcmp(name, "sigma") == 0) {
        memcpy(out, sigma, sizeof sigma);
    } else if (strcmp(name, "J") == 0) {
        out[0] = oracle_jacobian(state);
    } else if (strcmp(name, "pressure") == 0) {
        out[0] = mean_stress(sigma);
    } else if (strcmp(name, "von_mises") == 0) {
        out[0] = von_mises(sigma);
    } else {
        return false;
    }
    return true;
}

/* The same of the scalars that only some oracles know. */
static bool exact_extra(const char *name, const struct oracle_kind *kind, const struct oracle *oracle,
                        const double X[3], double t, double *out)
{
    for (size_t i = 0; kind->extra != NULL && kind->extra[i].name != NULL; i++) {
        if (strcmp(name, kind->extra[i].name) == 0) {
            double value[ORACLE_EXTRAS];
            kind->extras(oracle, X, t, value);
            *out = value[i];
            return true;
        }
    }
    return false;
}

static bool make_exact(const struct solver_record *record, struct solver_record_field *field,
                       const struct oracle_kind *kind, const struct oracle *oracle)
{
    for (size_t a = 0; a < record->count; a++) {
        struct oracle_state state;
        double value[9] = {0};
        const double *X = record->X + 3 * a;
        kind->state(oracle, X, record->time, &state);
        if (!exact_value(field->name, kind, &state, value) &&
            !exact_extra(field->name, kind, oracle, X, record->time, value)) {
            return false;
        }
        memcpy(field->value + a * (size_t)field->width, value, (size_t)field->width * sizeof *value);
    }
    return true;
}

void verify_picture_exact(struct solver_record *record, const struct oracle_kind *kind, const struct oracle *oracle)
{
    size_t kept = 0;
    for (size_t i = 0; i < record->field_count; i++) {
        if (make_exact(record, &record->field[i], kind, oracle)) {
            record->field[kept++] = record->field[i];
        } else {
            free(record->field[i].value);
        }
    }
    record->field_count = kept;
}
