/* Every oracle says where its body is: `outside` is the distance from a set of points, the fields are finite wherever
 * it is zero, and nothing but numbers is within. */
#include "oracles/oracle.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { PLACES = 4000 };

static uint64_t seed;

/* In [-1, 1). */
static double random_number(void)
{
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(seed >> 11) / 4503599627370496.0 - 1;
}

/* Over all sizes that a body may have. */
static void random_place(double X[3])
{
    double size = pow(10, 2 * random_number());
    for (int i = 0; i < 3; i++) {
        X[i] = size * random_number();
    }
}

enum { KINDS = 64 };
static struct oracle *typical[KINDS]; /* in the order of oracle_kinds(); some take long to make */

static void make_typical(void)
{
    for (size_t k = 0; oracle_kinds()[k] != NULL; k++) {
        const struct oracle_kind *kind = oracle_kinds()[k];
        double value[ORACLE_PARAMETERS];
        char why[ORACLE_WHY] = "";
        for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
            value[i] = kind->parameter[i].typical;
        }
        CU_ASSERT_TRUE_FATAL(k < KINDS && oracle_create(kind, value, &typical[k], why));
        CU_ASSERT_PTR_NOT_NULL_FATAL(kind->outside);
    }
}

static void destroy_typical(void)
{
    for (size_t k = 0; k < KINDS && typical[k] != NULL; k++) {
        oracle_kinds()[k]->destroy(typical[k]);
    }
}

static void for_every_kind(void (*ask)(const struct oracle_kind *kind, const struct oracle *oracle))
{
    for (size_t k = 0; oracle_kinds()[k] != NULL; k++) {
        CU_ASSERT_PTR_NOT_NULL_FATAL(typical[k]);
        seed = 1;
        ask(oracle_kinds()[k], typical[k]);
    }
}

/* A distance grows by no more than the way gone, and other axes are none of its business. */
static void ask_changes(const struct oracle_kind *kind, const struct oracle *oracle)
{
    for (int place = 0; place < PLACES; place++) {
        double A[3], B[3], way = 0;
        random_place(A);
        random_place(B);
        for (int i = 0; i < kind->dim; i++) {
            way = hypot(way, B[i] - A[i]);
        }
        double a = kind->outside(oracle, A), b = kind->outside(oracle, B);
        CU_ASSERT_TRUE(a >= 0 && b >= 0 && fabs(a - b) <= way * (1 + 1e-12));
        for (int i = kind->dim; i < 3; i++) {
            A[i] += B[i];
        }
        CU_ASSERT_EQUAL(kind->outside(oracle, A), a);
    }
}

static void is_a_distance(void)
{
    for_every_kind(ask_changes);
}

/* Downhill by as much as the distance says: there is the body, and nowhere nearer. */
static void ask_way_back(const struct oracle_kind *kind, const struct oracle *oracle)
{
    size_t within = 0, without = 0;
    for (int place = 0; place < PLACES; place++) {
        double X[3];
        random_place(X);
        double d = kind->outside(oracle, X), step = 1e-5 * d;
        within += d == 0;
        without += d > 0;
        if (d == 0) {
            continue;
        }
        double slope[3] = {0, 0, 0}, size = 0, back[3];
        for (int i = 0; i < kind->dim; i++) {
            double there[3];
            memcpy(there, X, sizeof there);
            there[i] += step;
            double up = kind->outside(oracle, there);
            there[i] -= 2 * step;
            slope[i] = (up - kind->outside(oracle, there)) / (2 * step);
            size = hypot(size, slope[i]);
        }
        if (fabs(size - 1) > 1e-6) {
            continue; /* where two ways are equally long there is no slope */
        }
        for (int i = 0; i < 3; i++) {
            back[i] = X[i] - d * slope[i];
        }
        CU_ASSERT_TRUE(kind->outside(oracle, back) <= 1e-4 * d);
    }
    CU_ASSERT_TRUE(within > PLACES / 2000);
    CU_ASSERT_TRUE(without > PLACES / 10);
}

static void leads_to_the_body(void)
{
    for_every_kind(ask_way_back);
}

static void ask_fields(const struct oracle_kind *kind, const struct oracle *oracle)
{
    double t = kind->reach != NULL ? fmin(1e-3, 0.9 * kind->reach(oracle)) : 1e-3;
    for (int place = 0; place < PLACES; place++) {
        double X[3];
        struct oracle_state state;
        random_place(X);
        if (kind->outside(oracle, X) > 0) {
            continue;
        }
        kind->state(oracle, X, t, &state);
        double number[sizeof state / sizeof(double)];
        memcpy(number, &state, sizeof state);
        bool finite = true;
        for (size_t i = 0; i < sizeof number / sizeof *number; i++) {
            finite = finite && isfinite(number[i]);
        }
        CU_ASSERT_TRUE(finite);
    }
}

static void fields_are_known_within(void)
{
    for_every_kind(ask_fields);
}

static void ask_nonsense(const struct oracle_kind *kind, const struct oracle *oracle)
{
    for (int i = 0; i < kind->dim; i++) {
        double X[3] = {0, 0, 0};
        X[i] = NAN;
        CU_ASSERT_FALSE(kind->outside(oracle, X) <= 1);
        X[i] = INFINITY;
        CU_ASSERT_FALSE(kind->outside(oracle, X) <= 1e300);
    }
}

static void what_is_no_number_is_not_within(void)
{
    unit_untrapped();
    for_every_kind(ask_nonsense);
}

/* Corners of boxes, and the gap between two rods. */
static void knows_faces_and_gaps(void)
{
    static const struct {
        const char *name;
        double X[3], distance;
    } known[] = {
        {"swinging-cube", {1, 1, 1}, 0},
        {"swinging-cube", {4, 5, 1}, 5},
        {"swinging-cube", {-3, 0.5, 5}, 5},
        {"cantilever", {0.2, 0.01, 7}, 0},
        {"cantilever", {0.23, -0.05, 0}, 0.05},
        {"cantilever-plane-stress", {-0.1, 0, 0}, 0.1},
        {"thin-plate", {0.1, 0.02, 0}, 0.01},
        {"cable", {10.5, 1, 1}, 0.5},
        {"cable", {-0.25, 0, 0}, 0.25},
        {"bimaterial-wave", {-3, 0, 0}, 3},
        {"rod-impact", {1.00002, 0, 0}, 0.00002},
        {"rod-impact", {1.00008, 0, 0}, 0.00002},
        {"rod-impact", {1, 0, 0}, 0},
        {"rod-impact", {3, 0, 0}, 0.4999},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        size_t k = 0;
        while (oracle_kinds()[k] != NULL && strcmp(oracle_kinds()[k]->name, known[i].name) != 0) {
            k++;
        }
        CU_ASSERT_TRUE_FATAL(k < KINDS && typical[k] != NULL);
        double found = oracle_kinds()[k]->outside(typical[k], known[i].X);
        if (!(fabs(found - known[i].distance) <= 1e-12)) {
            printf("%s, case %zu: %.17g\n", known[i].name, i, found);
        }
        CU_ASSERT_TRUE(fabs(found - known[i].distance) <= 1e-12);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every kind has its body", make_typical},
        {"is a distance", is_a_distance},
        {"leads to the body", leads_to_the_body},
        {"fields are known within", fields_are_known_within},
        {"what is no number is not within", what_is_no_number_is_not_within},
        {"knows faces and gaps", knows_faces_and_gaps},
    };
    int code = unit_main("oracles: outside", tests, sizeof tests / sizeof *tests);
    destroy_typical();
    return code;
}
