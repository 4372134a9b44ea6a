/* What the tests of the one-dimensional oracles share: making one from its typical values but for some, asking it, and
 * a bar on a grid of characteristics to march beside it. */
#ifndef TESTS_UNIT_BAR_ORACLES_H
#define TESTS_UNIT_BAR_ORACLES_H

#include "oracles/oracle.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct setting {
    const char *name; /* NULL: none */
    double value;
};
enum { SETTINGS = 8 };

static inline const struct oracle_kind *kind_called(const char *name)
{
    const struct oracle_kind *kind = oracle_find(name);
    CU_ASSERT_PTR_NOT_NULL_FATAL(kind);
    return kind;
}

/* NULL, with why, if it is refused. */
static inline struct oracle *try_with(const struct oracle_kind *kind, const struct setting setting[SETTINGS],
                                      char why[ORACLE_WHY])
{
    double value[ORACLE_PARAMETERS];
    struct oracle *oracle = NULL;
    size_t used = 0, given = 0;
    for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
        value[i] = kind->parameter[i].typical;
        for (size_t j = 0; setting != NULL && j < SETTINGS && setting[j].name != NULL; j++) {
            bool meant = strcmp(setting[j].name, kind->parameter[i].name) == 0;
            value[i] = meant ? setting[j].value : value[i];
            used += meant;
        }
    }
    while (setting != NULL && given < SETTINGS && setting[given].name != NULL) {
        given++;
    }
    CU_ASSERT_EQUAL_FATAL(used, given);
    (void)oracle_create(kind, value, &oracle, why);
    return oracle;
}

static inline struct oracle *create_with(const struct oracle_kind *kind, const struct setting setting[SETTINGS])
{
    char why[ORACLE_WHY] = "";
    struct oracle *oracle = try_with(kind, setting, why);
    if (oracle == NULL) {
        printf("%s\n", why);
    }
    CU_ASSERT_PTR_NOT_NULL_FATAL(oracle);
    return oracle;
}

static inline void refuses(const struct oracle_kind *kind, const struct setting setting[SETTINGS], const char *says)
{
    char why[ORACLE_WHY] = "";
    CU_ASSERT_PTR_NULL(try_with(kind, setting, why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, says));
    CU_ASSERT_TRUE(strlen(why) < ORACLE_WHY - 1); /* not cut short */
}

static inline struct oracle_state state_of(const struct oracle_kind *kind, const struct oracle *oracle, double X,
                                           double t)
{
    struct oracle_state state;
    double place[3] = {X, 0, 0};
    kind->state(oracle, place, t, &state);
    return state;
}

/* NaN if there is none of that name. */
static inline double figure_of(const struct oracle_kind *kind, const struct oracle *oracle, const char *name)
{
    struct oracle_figure figure[ORACLE_FIGURES];
    size_t count = kind->figures(oracle, figure);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(figure[i].name, name) == 0) {
            return figure[i].value;
        }
    }
    return NAN;
}

static inline bool near(double value, double expected, double tolerance)
{
    bool close = fabs(value - expected) <= tolerance;
    if (!close) {
        printf("%.17g, but %.17g expected\n", value, expected);
    }
    return close;
}

/* Passes its own self-check with each of the settings. */
static inline void holds_with_each(const struct oracle_kind *kind, const struct setting setting[][SETTINGS],
                                   size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct oracle *oracle = create_with(kind, setting[i]);
        struct oracle_check line[ORACLE_LAWS];
        size_t lines = 0;
        CU_ASSERT_TRUE(oracle_self_check(kind, oracle, line, &lines));
        for (size_t j = 0; j < lines; j++) {
            if (!oracle_law_holds(&line[j])) {
                printf("set %zu, %s: %.3g > %.3g\n", i, line[j].law, line[j].residual, line[j].bound);
            }
        }
        kind->destroy(oracle);
    }
}

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
