#include "oracles/shell.h"
#include "oracles/kind.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

double shell_place(const struct shell *shell, const double part[3], double margin, double X[3])
{
    double lower = shell->inner > 0 ? shell->inner + margin : 0, r = lower + (shell->outer - margin - lower) * part[0];
    double height = shell->dim == 3 ? 2 * part[2] - 1 : 0, across = r * sqrt((1 - height) * (1 + height));
    X[0] = across * cos(2 * PI * part[1]);
    X[1] = across * sin(2 * PI * part[1]);
    X[2] = r * height;
    return (shell->outer - shell->inner) * (shell->dim == 3 ? 4 * PI * r * r : 2 * PI * r);
}

double shell_radius(const struct shell *shell, const double X[3])
{
    double across = hypot(X[0], X[1]);
    return shell->dim == 3 ? hypot(across, X[2]) : across;
}

double shell_outside(const struct shell *shell, const double X[3])
{
    double r = shell_radius(shell, X);
    return oracle_outside_box(1, &shell->inner, &shell->outer, &r);
}
