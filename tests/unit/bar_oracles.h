/* What the tests of the one-dimensional oracles share: a bar on a grid of characteristics to march beside them. */
#ifndef TESTS_UNIT_BAR_ORACLES_H
#define TESTS_UNIT_BAR_ORACLES_H

#include "tests/unit/one_oracle.h"

/* The waves of a bar, v - P/Z to the right and v + P/Z to the left, one of either per cell; a step of time shifts them
 * by a cell, which is Godunov's scheme at a Courant number of one, and exact. */
enum { CELLS = 200 };
struct grid_bar {
    int cells;
    double Z, right[CELLS], left[CELLS];
};

/* At rest but for a velocity. */
static inline void fill(struct grid_bar *bar, double v)
{
    for (int i = 0; i < bar->cells; i++) {
        bar->right[i] = bar->left[i] = v;
    }
}

static inline void shift(struct grid_bar *bar, double into_right, double into_left)
{
    memmove(bar->right + 1, bar->right, (size_t)(bar->cells - 1) * sizeof *bar->right);
    memmove(bar->left, bar->left + 1, (size_t)(bar->cells - 1) * sizeof *bar->left);
    bar->right[0] = into_right;
    bar->left[bar->cells - 1] = into_left;
}

/* Middles of cells against the oracle: the largest difference of v and of P/Z [m/s], or infinity if it says none. */
static inline double compare_grid(const struct oracle_kind *kind, const struct oracle *oracle,
                                  const struct grid_bar *bar, double lower, double length, double t)
{
    double worst = 0;
    bool whole = true;
    for (int i = 0; i < bar->cells; i++) {
        struct oracle_state state = state_of(kind, oracle, lower + (i + 0.5) / bar->cells * length, t);
        double v = (bar->right[i] + bar->left[i]) / 2, P = bar->Z * (bar->left[i] - bar->right[i]) / 2;
        worst = fmax(worst, fmax(fabs(state.v[0] - v), fabs(state.P[0] - P) / bar->Z));
        whole = whole && isfinite(state.v[0]) && isfinite(state.P[0]);
    }
    return whole ? worst : INFINITY;
}

#endif
