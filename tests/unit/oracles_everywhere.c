/* Whatever parameters an oracle admits, it proves itself with them: sets of them drawn over many powers of ten, with
 * ends of intervals and zeros among them. What it cannot prove it must refuse. */
#include "oracles/oracle.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { PROVEN = 24, TRIES = 4000 };

static uint64_t drawn;

/* In [0, 1): xorshift64. */
static double draw(void)
{
    drawn ^= drawn << 13;
    drawn ^= drawn >> 7;
    drawn ^= drawn << 17;
    return (double)(drawn >> 11) / 9007199254740992.0;
}

/* Within an interval of two ends: near either, at zero, or anywhere. */
static double within(const struct oracle_parameter *p)
{
    double width = p->upper - p->lower, near = width * pow(10, -12 * draw()), kind = draw();
    return kind < 0.2   ? p->lower + near
           : kind < 0.4 ? p->upper - near
           : kind < 0.5 ? fmin(fmax(0, p->lower), p->upper)
                        : p->lower + width * draw();
}

/* The typical value, or one of another size. */
static double pick(const struct oracle_parameter *p)
{
    bool whole = strcmp(p->name, "mode") == 0 || strcmp(p->name, "cycles") == 0;
    if (draw() < 0.35) {
        return p->typical;
    }
    if (whole) {
        return floor(p->lower * pow(p->upper / p->lower, draw()));
    }
    if (isfinite(p->lower) && isfinite(p->upper)) {
        return within(p);
    }
    double value = (p->typical != 0 ? p->typical : 1) * pow(10, 5 * draw() - 2.5), sign = draw();
    return sign < 0.08 ? 0 : sign < 0.4 && p->lower < 0 ? -value : value;
}

static bool proves_itself(const struct oracle_kind *kind, const struct oracle *oracle, const double *value)
{
    struct oracle_check line[ORACLE_LAWS];
    size_t count = 0;
    bool proven = oracle_self_check(kind, oracle, line, &count);
    for (size_t i = 0; !proven && kind->parameter[i].name != NULL; i++) {
        printf("%s%s=%.17g", i == 0 ? "\n    " : " ", kind->parameter[i].name, value[i]);
    }
    for (size_t i = 0; i < count; i++) {
        if (!oracle_law_holds(&line[i])) {
            printf("\n    %s: %g > %g", line[i].law, line[i].residual, line[i].bound);
        }
    }
    return proven;
}

/* Cantilevers take most of a second each, and have tests of their own. */
static bool takes_long(const struct oracle_kind *kind)
{
    return strncmp(kind->name, "cantilever", 10) == 0;
}

static void proves_itself_everywhere(void)
{
    unit_untrapped();
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        size_t proven = 0;
        drawn = 0x9E3779B97F4A7C15;
        for (size_t tries = 0; !takes_long(*k) && tries < TRIES && proven < PROVEN; tries++) {
            double value[ORACLE_PARAMETERS];
            struct oracle *oracle = NULL;
            char why[ORACLE_WHY] = "";
            for (size_t i = 0; (*k)->parameter[i].name != NULL; i++) {
                value[i] = pick(&(*k)->parameter[i]);
            }
            if (!oracle_create(*k, value, &oracle, why)) {
                CU_ASSERT_TRUE(strlen(why) > 0);
                continue;
            }
            CU_ASSERT_TRUE(proves_itself(*k, oracle, value));
            (*k)->destroy(oracle);
            proven++;
        }
        CU_ASSERT_TRUE(takes_long(*k) || proven == PROVEN);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"proves itself wherever it answers", proves_itself_everywhere},
    };
    return unit_main("oracles: everywhere", tests, sizeof tests / sizeof *tests);
}
