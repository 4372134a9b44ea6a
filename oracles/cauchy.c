#include "oracles/oracle.h"

#include <string.h>

double oracle_jacobian(const struct oracle_state *state)
{
    const double *F = state->F;
    return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

double oracle_measures(bool finite_strain, const double F[9], double H[9])
{
    double J = finite_strain ? 0.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int k = (i + 2) % 3;
        for (int I = 0; I < 3; I++) {
            int K = (I + 1) % 3;
            int L = (I + 2) % 3;
            H[3 * i + I] = F[3 * j + K] * F[3 * k + L] - F[3 * j + L] * F[3 * k + K];
        }
    }
    for (int i = 0; i < 3; i++) {
        J += finite_strain ? F[i] * H[i] : F[4 * i] - 1.0;
    }
    for (int i = 0; i < 9 && !finite_strain; i++) {
        double one = i % 4 == 0 ? 1.0 : 0.0;
        H[i] = one * J - (F[3 * (i % 3) + i / 3] - one);
    }
    return J;
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
