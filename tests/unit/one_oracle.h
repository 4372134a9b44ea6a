/* What the tests of single oracles share: making one from its typical values but for some, and asking it. */
#ifndef TESTS_UNIT_ONE_ORACLE_H
#define TESTS_UNIT_ONE_ORACLE_H

#include "oracles/oracle.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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

/* On the axis of X. */
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

/* Passes its own self-check with each of the settings; of many, the environment's UNIT_FEW takes the first and the
 * last. */
static inline void holds_with_each(const struct oracle_kind *kind, const struct setting setting[][SETTINGS],
                                   size_t count)
{
    size_t step = getenv("UNIT_FEW") != NULL && count > 2 ? count - 1 : 1;
    for (size_t i = 0; i < count; i += step) {
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

#endif
