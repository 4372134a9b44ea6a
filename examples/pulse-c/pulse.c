/* A C program that asks an oracle: the pulse that runs through the left of two welded bars, before it meets the weld.
 * There d'Alembert's solution is a line, u(X, t) = f(t - X/c), and both must agree.
 *
 *     cc pulse.c $(pkg-config --cflags --libs assay-oracles) -o pulse */
#include "oracles/oracle.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The typical values, as far as they are not named here. */
static double value_of(const struct oracle_parameter *parameter)
{
    return strcmp(parameter->name, "A1") == 0 ? 2e-5 : parameter->typical;
}

int main(void)
{
    const struct oracle_kind *kind = oracle_find("bimaterial-wave");
    struct oracle *oracle = NULL;
    double value[ORACLE_PARAMETERS], E = NAN, rho = NAN, A = NAN, omega = NAN;
    char why[ORACLE_WHY] = "there is no such oracle";
    for (int i = 0; kind != NULL && kind->parameter[i].name != NULL; i++) {
        const char *name = kind->parameter[i].name;
        value[i] = value_of(&kind->parameter[i]);
        E = strcmp(name, "E1") == 0 ? value[i] : E;
        rho = strcmp(name, "rho1") == 0 ? value[i] : rho;
        A = strcmp(name, "A1") == 0 ? value[i] : A;
        omega = strcmp(name, "omega") == 0 ? value[i] : omega;
    }
    if (kind == NULL || !oracle_create(kind, value, &oracle, why)) {
        (void)fprintf(stderr, "pulse: %s\n", why);
        return 2;
    }
    const double c = sqrt(E / rho), t = 8e-5; /* [m/s], [s] */
    double worst = 0;
    (void)printf("X[m],u_x[m],v_x[m/s],P_xx[Pa]\n");
    for (int i = 0; i <= 10; i++) {
        const double X[3] = {0.05 * i, 0, 0}, late = fmax(0, t - X[0] / c);
        struct oracle_state state;
        kind->state(oracle, X, t, &state);
        (void)printf("%.2f,%.9e,%.9e,%.9e\n", X[0], state.u[0], state.v[0], state.P[0]);
        const double v = A * omega * sin(omega * late);
        worst = fmax(worst, fabs(state.u[0] - A * (1 - cos(omega * late))) / A);
        worst = fmax(worst, fabs(state.v[0] - v) / (A * omega));
        worst = fmax(worst, fabs(state.P[0] + rho * c * v) / (rho * c * A * omega));
    }
    kind->destroy(oracle);
    (void)printf("# largest relative difference from d'Alembert's solution: %.1e\n", worst);
    return worst < 1e-12 ? 0 : 1;
}
