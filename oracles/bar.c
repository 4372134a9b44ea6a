#include "oracles/bar.h"
#include "oracles/kind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double MOST_TRAVEL = 100; /* times of travel must be as near as this to each other */
static const double MOST_WAVES = 1e6;  /* radians from the origin to the far end */

struct bar bar_make(double lower, double length, double E, double rho)
{
    double c = sqrt(E / rho);
    return (struct bar){.lower = lower,
                        .upper = lower + length,
                        .E = E,
                        .rho = rho,
                        .c = c,
                        .Z = rho * c,
                        .T = (lower + length - lower) / c};
}

double bar_outside(const struct bar *bar, const double X[3])
{
    return oracle_outside_box(1, &bar->lower, &bar->upper, X);
}

void bar_state(const struct bar *bar, double u, double v, double stress, struct oracle_state *state)
{
    memset(state, 0, sizeof *state);
    state->u[0] = u;
    state->v[0] = v;
    state->p[0] = bar->rho * v;
    state->F[0] = 1 + stress / bar->E;
    state->F[4] = state->F[8] = 1;
    state->P[0] = stress;
}

bool bar_pair_fits(const struct bar *first, const struct bar *second, char why[ORACLE_WHY])
{
    double T1 = first->T, T2 = second->T;
    if (fmax(T1, T2) > MOST_TRAVEL * fmin(T1, T2)) {
        (void)snprintf(why, ORACLE_WHY,
                       "L1 = %g m and L2 = %g m are crossed by waves in %g s and %g s, but neither may take more than "
                       "%g times as long as the other; L2 = %g would do",
                       first->upper - first->lower, second->upper - second->lower, T1, T2, MOST_TRAVEL, T1 * second->c);
        return false;
    }
    return true;
}

bool bar_is_resolved(const struct bar *second, double frequency, char why[ORACLE_WHY])
{
    double farthest = MOST_WAVES * second->c / frequency;
    if (second->upper > farthest) {
        (void)snprintf(why, ORACLE_WHY,
                       "L2 = %g m: the right bar ends at X = %g m, but waves in it run with %g m/s and have up to %g "
                       "rad/s, and for these places beyond X = %g m are too coarse in double precision; choose a "
                       "longer or stiffer right bar, nearer to the origin, or slower changes",
                       second->upper - second->lower, second->upper, second->c, frequency, farthest);
        return false;
    }
    return true;
}

size_t bar_add_front(struct oracle_front front[ORACLE_FRONTS], size_t count, struct oracle_front added, double near)
{
    size_t at = count;
    if (count == ORACLE_TOO_MANY_FRONTS) {
        return count;
    }
    for (size_t i = count; i-- > 0 && front[i].X > added.X - near;) {
        if (front[i].speed == added.speed && fabs(front[i].X - added.X) <= near) {
            front[i].jump += added.jump;
            front[i].smoothness = added.smoothness > front[i].smoothness ? added.smoothness : front[i].smoothness;
            return count;
        }
        at = front[i].X > added.X ? i : at;
    }
    if (count == ORACLE_FRONTS) {
        return ORACLE_TOO_MANY_FRONTS;
    }
    memmove(front + at + 1, front + at, (count - at) * sizeof *front);
    front[at] = added;
    return count + 1;
}

/* Six-point Gauss rule from a to b. */
static void piece_energy(const struct oracle_kind *kind, const struct oracle *oracle, const struct bar *bar, double a,
                         double b, double t, double *kinetic, double *strain)
{
    static const double node[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
    static const double weight[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    for (int n = 0; n < 6; n++) {
        struct oracle_state state;
        double X[3] = {(a + b) / 2 + (n % 2 == 0 ? -1 : 1) * (b - a) / 2 * node[n / 2], 0, 0};
        kind->state(oracle, X, t, &state);
        *kinetic += (b - a) / 4 * weight[n / 2] * bar->rho * state.v[0] * state.v[0];
        *strain += (b - a) / 4 * weight[n / 2] * state.P[0] / bar->E * state.P[0];
    }
}

void bar_energy(const struct oracle_kind *kind, const struct oracle *oracle, const struct bar *bar, double longest,
                double t, double *kinetic, double *strain)
{
    struct oracle_front front[ORACLE_FRONTS];
    size_t count = kind->fronts(oracle, t, front);
    if (count == ORACLE_TOO_MANY_FRONTS) {
        *kinetic = *strain = NAN;
        return;
    }
    double from = bar->lower;
    for (size_t i = 0; i <= count; i++) {
        double to = i < count ? fmin(fmax(front[i].X, bar->lower), bar->upper) : bar->upper;
        int cuts = (int)fmax(1, ceil((to - from) / longest));
        for (int cut = 0; cut < cuts; cut++) {
            double a = from + (to - from) * cut / cuts, b = from + (to - from) * (cut + 1) / cuts;
            piece_energy(kind, oracle, bar, a, b, t, kinetic, strain);
        }
        from = fmax(from, to);
    }
}
