/* The Cauchy stress of an oracle's state: the exact one of finite strain, and that of linear elasticity. */
#include "oracles/oracle.h"
#include "tests/unit/unit.h"

/* A body turned by a right angle about the third axis and stretched threefold along the first: the force on what was
 * the face across the first axis acts along the second, on an area that did not change while the volume tripled. */
static void test_finite_strain(void)
{
    const struct oracle_kind kind = {.name = "turned", .finite_strain = true};
    const struct oracle_state state = {.F = {0, -1, 0, 3, 0, 0, 0, 0, 1}, .P = {0, -2, 0, 7, 0, 0, 0, 0, 6}};
    const double expected[9] = {2.0 / 3.0, 0, 0, 0, 7, 0, 0, 0, 2};
    double sigma[9];
    CU_ASSERT_DOUBLE_EQUAL(oracle_jacobian(&state), 3.0, 1e-15);
    oracle_cauchy(&kind, &state, sigma);
    for (int k = 0; k < 9; k++) {
        CU_ASSERT_DOUBLE_EQUAL(sigma[k], expected[k], 1e-15);
    }
}

static void test_linear(void)
{
    const struct oracle_kind kind = {.name = "small"};
    const struct oracle_state state = {.F = {1.1, 0.2, 0, 0, 1, 0, 0, 0, 1}, .P = {1, 2, 3, 2, 4, 5, 3, 5, 6}};
    double sigma[9];
    oracle_cauchy(&kind, &state, sigma);
    for (int k = 0; k < 9; k++) {
        CU_ASSERT_EQUAL(sigma[k], state.P[k]);
    }
}

/* det F of a matrix whose every product counts. */
static void test_jacobian(void)
{
    const struct oracle_state state = {.F = {2, 3, 5, 7, 11, 13, 17, 19, 23}};
    CU_ASSERT_EQUAL(oracle_jacobian(&state), -78.0);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"finite strain", test_finite_strain},
        {"linear elasticity", test_linear},
        {"Jacobian", test_jacobian},
    };
    return unit_main("oracles_cauchy", tests, sizeof tests / sizeof *tests);
}
