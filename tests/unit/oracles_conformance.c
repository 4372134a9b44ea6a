/* What every oracle must do, asked of every oracle there is: describe itself, refuse bad values, pass its own check,
 * and have a check that sees every single component of every field, every extra scalar, a NaN, every fault of a list of
 * fronts, and the energies being off. */
#include "oracles/oracle.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NUMBERS = sizeof(struct oracle_state) / sizeof(double) };

/* What may be wrong with the list of fronts. */
enum front_fault {
    FRONTS_RIGHT,
    FRONT_LEFT_OUT,
    FRONT_MISPLACED,
    FRONT_TOO_FAST,
    JUMP_OFF,
    MISNAMED,
    TOO_MANY,
    FAULTS
};

/* One component of the state spoiled, everywhere: x (1 + factor) + shift + tilt X; -1 for none. */
static struct {
    const struct oracle_kind *kind;
    int component;
    double factor, shift, tilt, step; /* step: for X > 1 alone, where the joint of a typical body of two parts is */
    enum front_fault fault;
    double kinetic_factor, strain_factor;
    double clock;            /* the state is that of t (1 + clock) */
    int extra;               /* one extra scalar spoiled likewise; -1 for none */
    double largest[NUMBERS]; /* magnitudes seen, without the unit matrix of F */
} spoil;

static const int UNIT_MATRIX = 9; /* F starts after u, v, p */

static void spoiled_state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state)
{
    double n[NUMBERS];
    spoil.kind->state(oracle, X, t * (1 + spoil.clock), state);
    memcpy(n, state, sizeof n);
    for (int i = 0; i < NUMBERS; i++) {
        double unit = i >= UNIT_MATRIX && i < UNIT_MATRIX + 9 && (i - UNIT_MATRIX) % 4 == 0 ? 1 : 0;
        spoil.largest[i] = fmax(spoil.largest[i], fabs(n[i] - unit));
        if (i == spoil.component) {
            n[i] = unit + (n[i] - unit) * (1 + spoil.factor) + spoil.shift + spoil.tilt * X[0] +
                   (X[0] > 1 ? spoil.step : 0);
        }
    }
    memcpy(state, n, sizeof n);
}

static void spoiled_energy(const struct oracle *oracle, double t, double *kinetic, double *strain)
{
    spoil.kind->energy(oracle, t, kinetic, strain);
    *kinetic *= 1 + spoil.kinetic_factor;
    *strain *= 1 + spoil.strain_factor;
}

static void spoiled_extras(const struct oracle *oracle, const double X[3], double t, double value[ORACLE_EXTRAS])
{
    spoil.kind->extras(oracle, X, t, value);
    if (spoil.extra >= 0) {
        value[spoil.extra] *= 1 + spoil.factor;
    }
}

/* The first front that moves, with its fault. */
static size_t spoiled_fronts(const struct oracle *oracle, double t, struct oracle_front front[ORACLE_FRONTS])
{
    size_t count = spoil.kind->fronts(oracle, t, front), i = 0;
    while (i < count && front[i].speed == 0) {
        i++;
    }
    if (count == ORACLE_TOO_MANY_FRONTS || i == count) {
        return count;
    }
    if (spoil.fault == FRONT_LEFT_OUT) {
        memmove(front + i, front + i + 1, (count - i - 1) * sizeof *front);
        return count - 1;
    }
    front[i].X *= spoil.fault == FRONT_MISPLACED ? 1 + 1e-6 : 1;
    front[i].speed *= spoil.fault == FRONT_TOO_FAST ? 1 + 1e-6 : 1;
    front[i].jump += spoil.fault == JUMP_OFF ? 1e-6 * fabs(front[i].speed) : 0;
    if (spoil.fault == MISNAMED) {
        front[i].smoothness = front[i].smoothness == ORACLE_JUMPS ? ORACLE_KINKS : ORACLE_JUMPS;
    }
    return spoil.fault == TOO_MANY ? ORACLE_TOO_MANY_FRONTS : count;
}

static struct oracle *create_typical(const struct oracle_kind *kind)
{
    double value[ORACLE_PARAMETERS];
    char why[ORACLE_WHY] = "";
    struct oracle *oracle = NULL;
    for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
        value[i] = kind->parameter[i].typical;
    }
    bool created = oracle_create(kind, value, &oracle, why);
    if (!created) {
        printf("%s: %s\n", kind->name, why);
    }
    CU_ASSERT_TRUE_FATAL(created);
    return oracle;
}

/* Starts an unspoiled copy of a kind that goes through the spoiling functions. */
static struct oracle_kind copy_of(const struct oracle_kind *kind)
{
    memset(&spoil, 0, sizeof spoil);
    spoil.kind = kind;
    spoil.component = spoil.extra = -1;
    struct oracle_kind copy = *kind;
    copy.state = spoiled_state;
    copy.energy = spoiled_energy;
    copy.extras = kind->extras != NULL ? spoiled_extras : NULL;
    copy.fronts = kind->fronts != NULL ? spoiled_fronts : NULL;
    return copy;
}

/* The time, or one near the end of the kind's reach where that is sooner. */
static double within_reach(const struct oracle_kind *kind, const struct oracle *oracle, double t)
{
    return kind->reach != NULL ? fmin(t, 0.9 * kind->reach(oracle)) : t;
}

static size_t extras_of(const struct oracle_kind *kind)
{
    size_t count = 0;
    while (kind->extra != NULL && kind->extra[count].name != NULL) {
        count++;
    }
    return count;
}

static bool all_finite(const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(value[i])) {
            return false;
        }
    }
    return true;
}

static bool any_finite(const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (isfinite(value[i])) {
            return true;
        }
    }
    return false;
}

static void describes_itself(void)
{
    size_t count = 0;
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++, count++) {
        const struct oracle_kind *kind = *k;
        CU_ASSERT_TRUE(strlen(kind->name) > 0 && strlen(kind->summary) > 0 && strlen(kind->source) > 0);
        CU_ASSERT_PTR_EQUAL(oracle_find(kind->name), kind); /* so that no two have one name */
        CU_ASSERT_TRUE(kind->dim >= 1 && kind->dim <= 3);
        size_t parameters = 0;
        for (const struct oracle_parameter *p = kind->parameter; p->name != NULL; p++, parameters++) {
            CU_ASSERT_TRUE(strlen(p->name) > 0 && strlen(p->unit) > 0 && strlen(p->help) > 0);
            CU_ASSERT_TRUE(p->lower < p->upper && isfinite(p->typical));
            for (const struct oracle_parameter *q = kind->parameter; q != p; q++) {
                CU_ASSERT_STRING_NOT_EQUAL(p->name, q->name);
            }
        }
        CU_ASSERT_TRUE(parameters <= ORACLE_PARAMETERS);
        size_t extras = extras_of(kind);
        CU_ASSERT_TRUE_FATAL(extras <= ORACLE_EXTRAS);
        CU_ASSERT_EQUAL(kind->extras == NULL, extras == 0);
        for (size_t i = 0; i < extras; i++) {
            const struct oracle_extra *e = &kind->extra[i];
            CU_ASSERT_TRUE(strlen(e->name) > 0 && strlen(e->unit) > 0 && strlen(e->help) > 0);
            for (size_t j = 0; j < i; j++) {
                CU_ASSERT_STRING_NOT_EQUAL(e->name, kind->extra[j].name);
            }
        }
        CU_ASSERT_TRUE(kind->awaits == NULL || strlen(kind->awaits) > 0);
        CU_ASSERT_EQUAL(kind->fronts == NULL, kind->smoothness == ORACLE_SMOOTH);
        CU_ASSERT_TRUE(kind->fronts == NULL || kind->dim == 1);
    }
    CU_ASSERT_TRUE(count > 0);
}

static void refuses_each_bad_value(void)
{
    unit_untrapped();
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        const struct oracle_parameter *parameter = (*k)->parameter;
        for (size_t bad = 0; parameter[bad].name != NULL; bad++) {
            double wrong[] = {NAN, INFINITY, -INFINITY, nextafter(parameter[bad].lower, -INFINITY),
                              nextafter(parameter[bad].upper, INFINITY)};
            for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
                double value[ORACLE_PARAMETERS];
                char why[ORACLE_WHY] = "";
                struct oracle *oracle = (struct oracle *)1;
                if (fabs(wrong[w]) > 1e308 && isfinite(wrong[w])) {
                    continue; /* there is nothing beyond an end that is infinite */
                }
                for (size_t i = 0; parameter[i].name != NULL; i++) {
                    value[i] = i == bad ? wrong[w] : parameter[i].typical;
                }
                CU_ASSERT_FALSE_FATAL(oracle_create(*k, value, &oracle, why));
                CU_ASSERT_PTR_NULL(oracle);
                CU_ASSERT_TRUE(strncmp(why, parameter[bad].name, strlen(parameter[bad].name)) == 0);
                CU_ASSERT_TRUE(strlen(why) < ORACLE_WHY - 1); /* not cut short */
            }
        }
    }
}

static void answers_repeatably_with_finite_numbers(void)
{
    static const double place[][3] = {{0, 0, 0}, {0.3, 0.4, 0.5}, {1, 1, 1}};
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_typical(*k), *again = create_typical(*k);
        double t = within_reach(*k, oracle, 1e-3);
        for (size_t i = 0; i < sizeof place / sizeof *place; i++) {
            struct oracle_state a, b;
            double n[2][NUMBERS], energy[4], extra[2][ORACLE_EXTRAS];
            memset(&a, 0x55, sizeof a);
            memset(&b, 0xaa, sizeof b); /* what a kind leaves unset differs */
            (*k)->state(oracle, place[i], t, &a);
            (*k)->state(again, place[i], t, &b);
            memcpy(n[0], &a, sizeof a);
            memcpy(n[1], &b, sizeof b);
            CU_ASSERT_TRUE(all_finite(n[0], NUMBERS));
            for (int j = 0; j < NUMBERS; j++) {
                CU_ASSERT_TRUE(n[0][j] == n[1][j]);
            }
            (*k)->energy(oracle, t, &energy[0], &energy[1]);
            (*k)->energy(again, t, &energy[2], &energy[3]);
            CU_ASSERT_TRUE(all_finite(energy, 4) && energy[0] >= 0 && energy[1] >= 0);
            CU_ASSERT_TRUE(energy[0] == energy[2] && energy[1] == energy[3]);
            for (size_t j = 0; (*k)->extras != NULL && j < extras_of(*k); j++) {
                (*k)->extras(oracle, place[i], t, extra[0]);
                (*k)->extras(again, place[i], t, extra[1]);
                CU_ASSERT_TRUE(isfinite(extra[0][j]) && extra[0][j] == extra[1][j]);
            }
        }
        (*k)->destroy(oracle);
        (*k)->destroy(again);
    }
}

/* Just before the end of its reach a kind knows all, and just after it nothing. */
static void says_nothing_beyond_its_reach(void)
{
    static const double place[3] = {0.3, 0.4, 0.5};
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_typical(*k);
        for (int late = 0; (*k)->reach != NULL && late < 2; late++) {
            double t = (*k)->reach(oracle) * (late ? 1 + 1e-9 : 1 - 1e-9), energy[2], extra[ORACLE_EXTRAS] = {0};
            double n[NUMBERS];
            struct oracle_front front[ORACLE_FRONTS];
            struct oracle_state state;
            (*k)->state(oracle, place, t, &state);
            (*k)->energy(oracle, t, &energy[0], &energy[1]);
            memcpy(n, &state, sizeof state);
            bool all = all_finite(n, NUMBERS) && all_finite(energy, 2),
                 some = any_finite(n, NUMBERS) || any_finite(energy, 2);
            for (size_t i = 0; i < extras_of(*k); i++) {
                (*k)->extras(oracle, place, t, extra);
                some = some || isfinite(extra[i]);
                all = all && isfinite(extra[i]);
            }
            CU_ASSERT_TRUE(late ? !some : all);
            CU_ASSERT_TRUE((*k)->fronts == NULL || ((*k)->fronts(oracle, t, front) == ORACLE_TOO_MANY_FRONTS) == late);
        }
        (*k)->destroy(oracle);
    }
}

static void figures_describe_themselves(void)
{
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_typical(*k);
        struct oracle_figure figure[ORACLE_FIGURES];
        size_t count = (*k)->figures != NULL ? (*k)->figures(oracle, figure) : 0;
        CU_ASSERT_TRUE_FATAL(count <= ORACLE_FIGURES);
        for (size_t i = 0; i < count; i++) {
            CU_ASSERT_TRUE(strlen(figure[i].name) > 0 && strlen(figure[i].unit) > 0 && strlen(figure[i].help) > 0);
            CU_ASSERT_TRUE(isfinite(figure[i].value));
            for (size_t j = 0; j < i; j++) {
                CU_ASSERT_STRING_NOT_EQUAL(figure[i].name, figure[j].name);
            }
        }
        (*k)->destroy(oracle);
    }
}

static void lists_fronts_in_order_and_repeatably(void)
{
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_typical(*k);
        for (size_t i = 0; (*k)->fronts != NULL && i < 20; i++) {
            struct oracle_front front[ORACLE_FRONTS], again[ORACLE_FRONTS];
            double t = within_reach(*k, oracle, 20e-4) * (double)i / 20;
            size_t count = (*k)->fronts(oracle, t, front);
            CU_ASSERT_TRUE_FATAL(count <= ORACLE_FRONTS);
            CU_ASSERT_EQUAL_FATAL((*k)->fronts(oracle, t, again), count);
            for (size_t j = 0; j < count; j++) {
                CU_ASSERT_TRUE(isfinite(front[j].X) && isfinite(front[j].speed) && isfinite(front[j].jump));
                CU_ASSERT_TRUE(front[j].smoothness == ORACLE_KINKS || front[j].smoothness == ORACLE_JUMPS);
                CU_ASSERT_TRUE(front[j].smoothness <= (*k)->smoothness);
                CU_ASSERT_TRUE(j == 0 || front[j].X >= front[j - 1].X);
                CU_ASSERT_TRUE(front[j].X == again[j].X && front[j].jump == again[j].jump);
            }
        }
        (*k)->destroy(oracle);
    }
}

static void passes_its_own_check(void)
{
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_typical(*k);
        struct oracle_check line[ORACLE_LAWS];
        size_t count = 0;
        CU_ASSERT_TRUE(oracle_self_check(*k, oracle, line, &count));
        CU_ASSERT_TRUE_FATAL(count > 0);
        for (size_t i = 0; i < count; i++) {
            CU_ASSERT_TRUE(strlen(line[i].law) > 0 && line[i].residual >= 0 && line[i].bound > 0);
            CU_ASSERT_TRUE(line[i].bound < 1e-6); /* a bound that nothing can miss proves nothing */
            for (size_t j = 0; j < i; j++) {
                CU_ASSERT_STRING_NOT_EQUAL(line[i].law, line[j].law);
            }
        }
        (*k)->destroy(oracle);
    }
}

static void fills_no_more_lines_than_there_is_room_for(void)
{
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_typical(*k);
        struct oracle_check line[3] = {{.law = "a"}, {.law = "b"}, {.law = "c"}};
        size_t count = (*k)->check(*k, oracle, NULL, 0);
        CU_ASSERT_EQUAL((*k)->check(*k, oracle, line, 1), count);
        CU_ASSERT_STRING_NOT_EQUAL(line[0].law, "a");
        CU_ASSERT_STRING_EQUAL(line[1].law, "b");
        (*k)->destroy(oracle);
    }
}

/* Notes which lines fail; returns whether any does. */
static bool caught(const struct oracle_kind *kind, const struct oracle *oracle, bool failed[ORACLE_LAWS])
{
    struct oracle_check line[ORACLE_LAWS];
    size_t count = 0;
    bool holds = oracle_self_check(kind, oracle, line, &count);
    for (size_t i = 0; i < count; i++) {
        failed[i] = failed[i] || !oracle_law_holds(&line[i]);
    }
    return !holds;
}

/* Largest magnitude of the field that a component belongs to: u, v, p, F - I, P. A rigid body's P is 0, and what is not
 * is seen beside p v [Pa]. */
static double field_size(const struct oracle_kind *kind, const double largest[NUMBERS], int component)
{
    int first = component < 9 ? component / 3 * 3 : component / 9 * 9, count = component < 9 ? 3 : 9;
    double size = 0;
    for (int i = first; i < first + count; i++) {
        size = fmax(size, largest[i]);
    }
    return kind->rigid && component >= 18 ? field_size(kind, largest, 6) * field_size(kind, largest, 3) : size;
}

static void spoil_each_component(const struct oracle_kind *kind, const struct oracle *oracle, bool failed[ORACLE_LAWS])
{
    struct oracle_kind copy = copy_of(kind);
    double largest[NUMBERS];
    bool none[ORACLE_LAWS] = {false};
    CU_ASSERT_FALSE(caught(&copy, oracle, none)); /* going through the copy is no fault */
    memcpy(largest, spoil.largest, sizeof largest);
    for (int i = 0; i < NUMBERS; i++) {
        spoil.component = i;
        spoil.factor = 0;
        spoil.shift = 1e-6 * field_size(kind, largest, i);
        CU_ASSERT_TRUE(caught(&copy, oracle, failed));
        spoil.shift = 0;
        spoil.tilt = 1e-6 * field_size(kind, largest, i); /* fields may be constant */
        CU_ASSERT_TRUE(caught(&copy, oracle, failed));
        spoil.tilt = 0;
        if (kind->fronts != NULL) { /* whose body may have joints */
            spoil.step = 1e-6 * field_size(kind, largest, i);
            CU_ASSERT_TRUE(caught(&copy, oracle, failed));
            spoil.step = 0;
        }
        spoil.factor = 1e-6;
        spoil.shift = 0;
        CU_ASSERT_TRUE(largest[i] < 1e-3 * field_size(kind, largest, i) || caught(&copy, oracle, failed));
        spoil.factor = NAN;
        CU_ASSERT_TRUE(caught(&copy, oracle, none));
    }
}

static void spoil_each_extra(const struct oracle_kind *kind, const struct oracle *oracle, bool failed[ORACLE_LAWS])
{
    struct oracle_kind copy = copy_of(kind);
    for (size_t i = 0; i < extras_of(kind); i++) {
        bool none[ORACLE_LAWS] = {false};
        spoil.extra = (int)i;
        spoil.factor = 1e-6;
        CU_ASSERT_TRUE(caught(&copy, oracle, failed));
        spoil.factor = NAN;
        CU_ASSERT_TRUE(caught(&copy, oracle, none));
    }
}

static void spoil_fronts(const struct oracle_kind *kind, const struct oracle *oracle, bool failed[ORACLE_LAWS])
{
    struct oracle_kind copy = copy_of(kind);
    for (int fault = FRONTS_RIGHT + 1; fault < FAULTS && kind->fronts != NULL; fault++) {
        spoil.fault = (enum front_fault)fault;
        bool seen = caught(&copy, oracle, failed);
        if (!seen) {
            printf("%s: a fault of kind %d in the list of fronts goes unseen\n", kind->name, fault);
        }
        CU_ASSERT_TRUE(seen);
    }
}

static void its_check_sees_every_component_and_every_line_can_fail(void)
{
    unit_untrapped();
    for (const struct oracle_kind *const *k = oracle_kinds(); *k != NULL; k++) {
        struct oracle *oracle = create_typical(*k);
        struct oracle_check line[ORACLE_LAWS];
        bool failed[ORACLE_LAWS] = {false};
        size_t count = 0;
        spoil_each_component(*k, oracle, failed);
        spoil_each_extra(*k, oracle, failed);
        spoil_fronts(*k, oracle, failed);
        struct oracle_kind copy = copy_of(*k);
        spoil.kinetic_factor = 1e-6;
        CU_ASSERT_TRUE(caught(&copy, oracle, failed));
        spoil.strain_factor = 1e-6; /* both: the total stays constant */
        CU_ASSERT_TRUE(caught(&copy, oracle, failed));
        spoil.strain_factor = NAN;
        CU_ASSERT_TRUE(caught(&copy, oracle, failed));
        copy = copy_of(*k);
        spoil.clock = 1e-6;
        CU_ASSERT_TRUE(caught(&copy, oracle, failed));
        (void)oracle_self_check(*k, oracle, line, &count);
        for (size_t i = 0; i < count; i++) {
            if (!failed[i]) {
                printf("%s: nothing makes \"%s\" fail\n", (*k)->name, line[i].law);
            }
            CU_ASSERT_TRUE(failed[i]);
        }
        (*k)->destroy(oracle);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"describes itself", describes_itself},
        {"refuses each bad value", refuses_each_bad_value},
        {"answers repeatably with finite numbers", answers_repeatably_with_finite_numbers},
        {"says nothing beyond its reach", says_nothing_beyond_its_reach},
        {"figures describe themselves", figures_describe_themselves},
        {"lists fronts in order and repeatably", lists_fronts_in_order_and_repeatably},
        {"passes its own check", passes_its_own_check},
        {"fills no more lines than there is room for", fills_no_more_lines_than_there_is_room_for},
        {"its check sees every component, and every line can fail",
         its_check_sees_every_component_and_every_line_can_fail},
    };
    return unit_main("oracles: conformance", tests, sizeof tests / sizeof *tests);
}
