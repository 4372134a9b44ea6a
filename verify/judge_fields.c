#include "verify/judge.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Other names that fields of a state go by, whatever the case. */
static const struct {
    enum verify_field field;
    const char *name;
} aliases[] = {
    {VERIFY_u, "displacement"},
    {VERIFY_v, "velocity"},
    {VERIFY_p, "momentum"},
    {VERIFY_p, "linear_momentum"},
    {VERIFY_F, "deformation_gradient"},
    {VERIFY_H, "cofactor"},
    {VERIFY_J, "jacobian"},
    {VERIFY_P, "first_piola_kirchhoff"},
    {VERIFY_P, "pk1"},
    {VERIFY_SIGMA, "cauchy"},
    {VERIFY_SIGMA, "cauchy_stress"},
    {VERIFY_SIGMA, "stress"},
    {VERIFY_PRESSURE, "mean_stress"},
};

size_t verify_judged_count(const struct oracle_kind *kind)
{
    size_t count = VERIFY_STATE_FIELDS;
    for (size_t i = 0; kind->extra != NULL && i < ORACLE_EXTRAS && kind->extra[i].name != NULL; i++) {
        count++;
    }
    return count;
}

struct verify_judged_field verify_judged_field(const struct oracle_kind *kind, size_t field)
{
    if (field >= VERIFY_STATE_FIELDS) {
        const struct oracle_extra *extra = &kind->extra[field - VERIFY_STATE_FIELDS];
        return (struct verify_judged_field){extra->name, extra->unit, VERIFY_SCALAR, true};
    }
    enum verify_field of = (enum verify_field)field;
    return (struct verify_judged_field){verify_field_name(of), verify_field_unit(of), verify_field_shape(of), false};
}

/* The normal components of a tensor and all of them are two errors of one field. */
static enum verify_field whole(enum verify_field field)
{
    return field == VERIFY_P_ALL ? VERIFY_P : field == VERIFY_SIGMA_ALL ? VERIFY_SIGMA : field;
}

int verify_judged_component(const struct oracle_kind *kind, size_t field, const char *name)
{
    const char *whole_name = verify_judged_field(kind, field).name;
    size_t length = strlen(name);
    bool begins = field >= VERIFY_STATE_FIELDS && strncmp(whole_name, name, length) == 0 && whole_name[length] == '_';
    int axis = begins && strlen(whole_name) == length + 2 ? whole_name[length + 1] - 'x' : -1;
    return axis >= 0 && axis <= 2 ? axis : -1;
}

bool verify_judged_is(const struct oracle_kind *kind, size_t field, const char *name)
{
    if (field >= VERIFY_STATE_FIELDS) {
        return strcmp(verify_judged_field(kind, field).name, name) == 0 ||
               verify_judged_component(kind, field, name) >= 0;
    }
    enum verify_field of = whole((enum verify_field)field);
    if (strcmp(verify_field_name(of), name) == 0) {
        return true;
    }
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++) {
        if (aliases[i].field == of && strcasecmp(aliases[i].name, name) == 0) {
            return true;
        }
    }
    return false;
}

const char *verify_judged_name(const struct oracle_kind *kind, size_t error, char text[VERIFY_JUDGED_NAME])
{
    (void)snprintf(text, VERIFY_JUDGED_NAME, "%.80s%s", verify_judged_field(kind, error / VERIFY_NORMS).name,
                   verify_norm_suffix(error % VERIFY_NORMS));
    return text;
}

const char *verify_judged_meaning(const struct oracle_kind *kind, size_t error, char text[VERIFY_JUDGED_MEANING])
{
    size_t field = error / VERIFY_NORMS;
    if (field < VERIFY_STATE_FIELDS) {
        (void)snprintf(text, VERIFY_JUDGED_MEANING, "%s", verify_error_meaning(error));
    } else {
        (void)snprintf(text, VERIFY_JUDGED_MEANING, "%s%s", verify_norm_meaning(error % VERIFY_NORMS),
                       kind->extra[field - VERIFY_STATE_FIELDS].help);
    }
    return text;
}

const char *verify_judged_unit(const struct oracle_kind *kind, size_t error)
{
    return verify_norm_is_absolute(error % VERIFY_NORMS) ? verify_judged_field(kind, error / VERIFY_NORMS).unit : "-";
}

size_t verify_judged_find(const struct oracle_kind *kind, const char *name)
{
    size_t count = VERIFY_NORMS * verify_judged_count(kind);
    for (size_t i = 0; i < count; i++) {
        char text[VERIFY_JUDGED_NAME];
        if (strcmp(verify_judged_name(kind, i, text), name) == 0) {
            return i;
        }
    }
    return VERIFY_JUDGED_ERRORS;
}

size_t verify_judged_exact(const struct verify_truth *truth, size_t field, const struct oracle_state *state,
                           const double extra[ORACLE_EXTRAS], double value[9])
{
    if (field >= VERIFY_STATE_FIELDS) {
        value[0] = extra[field - VERIFY_STATE_FIELDS];
        return 1;
    }
    return verify_field_whole((enum verify_field)field, truth->kind, state, value);
}
