#include "verify/told.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool verify_told_oracle(const char *name, const struct verify_options *options, struct verify_truth *truth,
                        struct solver_error *error)
{
    struct solver_named told[VERIFY_OVERRIDES];
    for (size_t i = 0; i < options->param.count; i++) {
        const char *text = options->param.text[i], *equals = strchr(text, '=');
        size_t length = equals != NULL ? (size_t)(equals - text) : 0;
        char *end = NULL;
        told[i].value = equals != NULL ? strtod(equals + 1, &end) : NAN;
        if (equals == NULL || end == equals + 1 || *end != '\0' || length >= sizeof told[i].name) {
            return solver_fail(error, SOLVER_BAD_INPUT, "--param %.200s: expected KEY=number, as in material.E=17e6",
                               text);
        }
        memcpy(told[i].name, text, length);
        told[i].name[length] = '\0';
    }
    return verify_truth_tell(name, told, options->param.count, options->typical, truth, error);
}

bool verify_told_numbers(const char *name, const char *text, double *value, size_t most, size_t *count,
                         struct solver_error *error)
{
    *count = 0;
    for (const char *at = text; at != NULL;) {
        char *end = NULL;
        double number = strtod(at, &end);
        if (end == at || (*end != ',' && *end != '\0') || !isfinite(number) || *count == most) {
            return solver_fail(error, SOLVER_BAD_INPUT, "%s %.200s: expected at most %zu numbers with commas between",
                               name, text, most);
        }
        value[(*count)++] = number;
        at = *end == ',' ? end + 1 : NULL;
    }
    return true;
}
