/* The self-check of the bimaterial wave by integrals over time: what goes in at the left end, and Laplace's transform.
 */
#include "oracles/bimaterial_wave_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BREAKS = 16384 };

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Times, in order, between which no front comes by. */
struct breaks {
    size_t count;
    double at[BREAKS];
};

/* At X up to `end`: every path's, so some at which none does. */
static void find_breaks(const struct bimaterial_problem *of, double X, double end, struct breaks *breaks)
{
    const struct bimaterial_wave_given *g = of->given;
    double there, back;
    there = X <= g->L1 ? X / of->c1 : of->T1 + (X - g->L1) / of->c2;
    back = X <= g->L1 ? 2 * of->T1 - there : 2 * (of->T1 + of->T2) - there;
    breaks->count = 0;
    breaks->at[breaks->count++] = 0;
    breaks->at[breaks->count++] = end;
    for (int path = 0; path < 4; path++) {
        double first = (path % 2 == 0 ? 0 : g->t1) + (path / 2 == 0 ? there : back);
        for (int j = 0; first + 2 * j * of->T2 < end; j++) {
            for (int i = 0; first + 2 * i * of->T1 + 2 * j * of->T2 < end && breaks->count < BREAKS - 1; i++) {
                breaks->at[breaks->count++] = first + 2 * i * of->T1 + 2 * j * of->T2;
            }
        }
    }
    if (g->t1 < end) {
        breaks->at[breaks->count++] = g->t1;
    }
    qsort(breaks->at, breaks->count, sizeof *breaks->at, ascending);
}

/* Of u, v, P times exp(-s (t - origin)), of the power -P v, and of its magnitude. */
enum integral { OF_U, OF_V, OF_P, OF_POWER, OF_SIZE, INTEGRALS };

static void integrate_piece(const struct bimaterial_problem *of, double X, double from, double length, double s,
                            double origin, double sum[INTEGRALS])
{
    for (int n = 0; n < SELF_CHECK_NODES; n++) {
        double weight, t = from + length * (0.5 + self_check_node(n, &weight) / 2);
        struct oracle_state state;
        bimaterial_state(of, X, t, &state);
        weight *= length / 2;
        double decay = exp(-s * (t - origin)), power = -state.P[0] * state.v[0];
        sum[OF_U] += weight * decay * state.u[0];
        sum[OF_V] += weight * decay * state.v[0];
        sum[OF_P] += weight * decay * state.P[0];
        sum[OF_POWER] += weight * power;
        sum[OF_SIZE] += weight * fabs(power);
    }
}

/* At X from 0 to `end`. */
static void integrate(const struct bimaterial_problem *of, double X, double end, double s, double origin,
                      double sum[INTEGRALS])
{
    static _Thread_local struct breaks breaks; /* too large for the stack */
    double longest = 1 / fmax(of->check->frequency, s);
    memset(sum, 0, INTEGRALS * sizeof *sum);
    find_breaks(of, X, end, &breaks);
    for (size_t i = 0; i + 1 < breaks.count; i++) {
        double length = breaks.at[i + 1] - breaks.at[i];
        int cuts = (int)ceil(length / longest);
        for (int cut = 0; cut < cuts; cut++) {
            integrate_piece(of, X, breaks.at[i] + length / cuts * cut, length / cuts, s, origin, sum);
        }
    }
}

/* V and P at X for V = exp(-s there) at the left end: waves in a line whose load is the right bar's Z2 tanh(s T2). */
static void transfer(const struct bimaterial_problem *of, double X, double s, double *V, double *P)
{
    double load = of->Z2 * tanh(s * of->T2), echo = (of->Z1 - load) / (of->Z1 + load);
    double first = 1 / (1 + echo * exp(-2 * s * of->T1));
    double left = X <= of->given->L1 ? X / of->c1 : of->T1;
    /* relative to exp(-s left) */
    double mirrored = echo * exp(-2 * s * (of->T1 - left));
    *V = first * (X < of->given->L1 ? 1 + mirrored : 2 * of->Z1 / (of->Z1 + load)); /* no difference of near numbers */
    *P = -of->Z1 * first * (1 - mirrored);
    if (X > of->given->L1) {
        double depth = (X - of->given->L1) / of->c2, end = exp(-2 * s * of->T2), here = exp(-2 * s * (of->T2 - depth));
        *P = -of->Z2 * *V * (1 - here) / (1 + end);
        *V *= (1 + here) / (1 + end);
    }
}

void bimaterial_check_laplace(const struct bimaterial_problem *of)
{
    const struct bimaterial_wave_given *g = of->given;
    const double X[4] = {0.35 * g->L1, nextafter(g->L1, INFINITY), g->L1 + 0.35 * g->L2, g->L1 + g->L2};
    double worst[3] = {0}, end = of->check->t_end;
    for (int i = 0; i < 4; i++) {
        double there = X[i] <= g->L1 ? X[i] / of->c1 : of->T1 + (X[i] - g->L1) / of->c2;
        /* exp(-46) is below the round-off, even where u has grown with the fourth power of the time. */
        double s = 46 / (end - there), first[INTEGRALS], here[INTEGRALS], V, P;
        integrate(of, 0, end, s, 0, first);
        integrate(of, X[i], end, s, there, here);
        transfer(of, X[i], s, &V, &P);
        V *= first[OF_V];
        P *= first[OF_V];
        /* P is nothing at the free end, and v little where the right material is hard: what they are made of counts. */
        double size = X[i] <= g->L1 ? fabs(first[OF_V]) : fabs(here[OF_V]);
        double stress = fabs(first[OF_V]) * (X[i] <= g->L1 ? of->Z1 : of->Z2);
        worst[0] = self_check_worse(worst[0], self_check_relative(fabs(s * here[OF_U] - V), size));
        worst[1] = self_check_worse(worst[1], self_check_relative(fabs(here[OF_V] - V), size));
        worst[2] = self_check_worse(worst[2], self_check_relative(fabs(here[OF_P] - P), stress));
    }
    self_check_line(of->check, "Laplace transform: u", worst[0], bimaterial_bound(of));
    self_check_line(of->check, "Laplace transform: v", worst[1], bimaterial_bound(of));
    self_check_line(of->check, "Laplace transform: P", worst[2], bimaterial_bound(of));
}

void bimaterial_drive(struct bimaterial_problem *of)
{
    struct bimaterial_drive *drive = &of->drive;
    for (int i = 0; i < QUARTERS; i++) {
        double sum[INTEGRALS];
        integrate(of, 0, (i + 1) * of->given->t1 / QUARTERS, 0, 0, sum);
        drive->work[i] = sum[OF_POWER];
        drive->gross = sum[OF_SIZE];
        drive->most_work = self_check_worse(fabs(sum[OF_POWER]), drive->most_work);
        drive->most_impulse = self_check_worse(fabs(sum[OF_P]), drive->most_impulse);
    }
}

void bimaterial_check_work(const struct bimaterial_problem *of)
{
    struct self_check_distance work = {0};
    for (int i = 0; i < QUARTERS; i++) {
        double kinetic, strain;
        of->check->kind->energy(of->check->oracle, (i + 1) * of->given->t1 / QUARTERS, &kinetic, &strain);
        double total = kinetic + strain;
        self_check_measure(&work, &total, &of->drive.work[i], 1);
    }
    self_check_line(of->check, "energy = work of the left end", self_check_relative(work.error, of->drive.gross),
                    bimaterial_bound(of));
}
