#include "oracles/oracle.h"

#include <string.h>

double oracle_jacobian(const struct oracle_state *state)
{
    const double *F = state->F;
    return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

void oracle_cauchy(const struct oracle_kind *kind, const struct oracle_state *state, double sigma[9])
{
    if (!kind->finite_strain) {
        memcpy(sigma, state->P, sizeof state->P);
        return;
    }
    double J = oracle_jacobian(state);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            double sum = 0.0;
            for (int k = 0; k < 3; k++) {
                sum += state->P[3 * i + k] * state->F[3 * j + k];
            }
            sigma[3 * i + j] = sum / J;
        }
    }
}
