/* Finding oracles, and refusing to create one from values that are not admissible. */
#include "oracles/oracle.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <string.h>

static const struct oracle_kind *the_kind(void)
{
    const struct oracle_kind *kind = oracle_find("swinging-cube");
    CU_ASSERT_PTR_NOT_NULL_FATAL(kind);
    return kind;
}

static void typical(const struct oracle_kind *kind, double value[ORACLE_PARAMETERS])
{
    for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
        value[i] = kind->parameter[i].typical;
    }
}

static size_t index_of(const struct oracle_kind *kind, const char *name)
{
    size_t i = 0;
    while (kind->parameter[i].name != NULL && strcmp(kind->parameter[i].name, name) != 0) {
        i++;
    }
    CU_ASSERT_PTR_NOT_NULL_FATAL(kind->parameter[i].name);
    return i;
}

static void refused(const char *name, double value, const char *says)
{
    const struct oracle_kind *kind = the_kind();
    double values[ORACLE_PARAMETERS];
    char why[ORACLE_WHY] = "";
    struct oracle *oracle = (struct oracle *)1;
    typical(kind, values);
    values[index_of(kind, name)] = value;
    CU_ASSERT_FALSE_FATAL(oracle_create(kind, values, &oracle, why));
    CU_ASSERT_PTR_NULL(oracle);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, name));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, says));
}

static void finds_by_name(void)
{
    CU_ASSERT_STRING_EQUAL(the_kind()->name, "swinging-cube");
    CU_ASSERT_PTR_NULL(oracle_find("swinging"));
    CU_ASSERT_PTR_NULL(oracle_find(""));
    CU_ASSERT_PTR_NULL(oracle_find(NULL));
}

static void refuses_what_is_not_a_number(void)
{
    static const char *const names[] = {"A", "B", "C", "U0", "material.E", "material.nu", "material.rho"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        refused(names[i], NAN, "a finite number");
        refused(names[i], INFINITY, "a finite number");
        refused(names[i], -INFINITY, "a finite number");
    }
}

static void refuses_impossible_materials(void)
{
    refused("material.E", 0, "material.E = 0 [Pa], but it must be a finite number, > 0");
    refused("material.E", -17e6, "-17000000 [Pa]");
    refused("material.rho", 0, "> 0 (density); material.rho = 1100 would do");
    refused("material.rho", -1, "> 0");
    refused("material.nu", 0.5, "expected A + B + C = 0, got 3");
    refused("material.nu", -1, "> -1 and <= 0.5");
    refused("material.nu", 0.7, "> -1 and <= 0.5");
}

static void refuses_what_overflows(void)
{
    unit_untrapped();
    refused("U0", 1e200, "range of double precision");
    refused("U0", 1e-200, "range of double precision");
    refused("A", 1.7e308, "range of double precision");
    refused("material.E", 1e307, "range of double precision");
    refused("material.rho", 5e-324, "range of double precision");
}

/* The fields of infinite amplitudes at rest are not a number, although nothing moves. */
static void refuses_infinity_times_zero(void)
{
    unit_untrapped();
    const struct oracle_kind *kind = the_kind();
    double values[ORACLE_PARAMETERS];
    char why[ORACLE_WHY] = "";
    struct oracle *oracle = NULL;
    typical(kind, values);
    values[index_of(kind, "A")] = values[index_of(kind, "B")] = 1.7e308;
    values[index_of(kind, "U0")] = 0;
    CU_ASSERT_FALSE(oracle_create(kind, values, &oracle, why));
    CU_ASSERT_PTR_NULL(oracle);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, "range of double precision"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"finds by name", finds_by_name},
        {"refuses what is not a number", refuses_what_is_not_a_number},
        {"refuses impossible materials", refuses_impossible_materials},
        {"refuses what overflows", refuses_what_overflows},
        {"refuses infinity times zero", refuses_infinity_times_zero},
    };
    return unit_main("oracles: registry", tests, sizeof tests / sizeof *tests);
}
