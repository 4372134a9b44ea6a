#include "oracles/self_check_parts.h"

#include <math.h>
#include <string.h>

/* Halves [before, after], at whose ends `passed` must differ, until nothing lies between; NaN if they do not. */
static double first_time(const struct self_check *check, double X, double before, double after, double level,
                         bool (*passed)(const struct oracle_state *state, double level))
{
    struct oracle_state state;
    double place[3] = {X, 0, 0};
    check->kind->state(check->oracle, place, before, &state);
    bool at_first = passed(&state, level);
    check->kind->state(check->oracle, place, after, &state);
    if (passed(&state, level) == at_first) {
        return NAN;
    }
    double middle = (before + after) / 2;
    while (middle > before && middle < after) {
        check->kind->state(check->oracle, place, middle, &state);
        *(passed(&state, level) == at_first ? &before : &after) = middle;
        middle = (before + after) / 2;
    }
    return after;
}

static bool faster(const struct oracle_state *state, double level)
{
    return state->v[0] > level;
}

/* Wholly. */
static bool silent(const struct oracle_state *state, double level)
{
    double number[sizeof *state / sizeof(double)];
    bool all = true;
    (void)level;
    memcpy(number, state, sizeof *state);
    for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
        all = all && isnan(number[i]);
    }
    return all;
}

void self_check_arrival(struct self_check *check, const char *law, double X, double level, double time)
{
    double found = first_time(check, X, 0, check->t_end, level, faster);
    self_check_line(check, law, fabs(found - time) / time, 64 * self_check_round_off(check));
}

void self_check_reach(struct self_check *check, const char *law, double time, double bound)
{
    double found = first_time(check, check->lower[0], time / 2, 2 * time, 0, silent);
    self_check_line(check, law, fabs(found - time) / time, bound);
}
