#include "oracles/kind.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool oracle_representable(const double *size, size_t count, bool at_rest)
{
    for (size_t i = 0; i < count; i++) {
        double x = fabs(size[i]);
        if (!(x >= DBL_MIN / DBL_EPSILON && x <= DBL_MAX * DBL_EPSILON) && !(at_rest && x == 0)) {
            return false;
        }
    }
    return true;
}

bool oracle_out_of_range(const struct oracle_parameter *parameter, const double *value, char why[ORACLE_WHY])
{
    size_t used = 0;
    for (size_t i = 0; parameter[i].name != NULL && used < ORACLE_WHY; i++) {
        int added = snprintf(why + used, ORACLE_WHY - used, "%s%s = %.15g%s%s", i == 0 ? "" : ", ", parameter[i].name,
                             value[i], strcmp(parameter[i].unit, "-") == 0 ? "" : " ",
                             strcmp(parameter[i].unit, "-") == 0 ? "" : parameter[i].unit);
        used += added > 0 ? (size_t)added : 0;
    }
    if (used < ORACLE_WHY) {
        (void)snprintf(why + used, ORACLE_WHY - used,
                       " give fields or energies outside the range of double precision; choose values nearer to 1");
    }
    return false;
}

void oracle_silence(struct oracle_state *state)
{
    double nothing[sizeof *state / sizeof(double)];
    for (size_t i = 0; i < sizeof nothing / sizeof *nothing; i++) {
        nothing[i] = NAN;
    }
    memcpy(state, nothing, sizeof *state);
}

double oracle_outside_box(int dim, const double *lower, const double *upper, const double *X)
{
    double sum = 0;
    for (int i = 0; i < dim; i++) {
        double beyond = X[i] < lower[i] ? lower[i] - X[i] : X[i] > upper[i] ? X[i] - upper[i] : 0 * X[i];
        sum = hypot(sum, beyond);
    }
    return sum;
}

bool oracle_no_memory(size_t size, char why[ORACLE_WHY])
{
    (void)snprintf(why, ORACLE_WHY, "no memory for %zu bytes", size);
    return false;
}

bool oracle_keep(const void *oracle, size_t size, struct oracle **out, char why[ORACLE_WHY])
{
    void *copy = malloc(size);
    if (copy == NULL) {
        return oracle_no_memory(size, why);
    }
    memcpy(copy, oracle, size);
    *out = copy;
    return true;
}

void oracle_release(struct oracle *oracle)
{
    free(oracle);
}
