/* Units as other programs spell them. */
#include "tests/unit/unit.h"
#include "verify/units.h"

static void expect(const char *given, const char *wanted, double factor)
{
    double found = 0;
    CU_ASSERT_TRUE(verify_unit_factor(given, wanted, &found));
    CU_ASSERT_EQUAL(found, factor);
}

static void spellings(void)
{
    static const char *const same[][2] = {
        {"-", "1"},
        {"-", ""},
        {"Pa", "N/m^2"},
        {"Pa", "N/m2"},
        {"m/s", "m s^-1"},
        {"kg/(m^2 s)", "kg/m^2/s"},
        {"kg/(m^2 s)", "kg/(m^2*s)"},
        {"kg/(m^2 s)", "kg m^-2 s^-1"},
        {"kg/(m^2 s)", "N s/m^3"},
        {"kg/m^3", "kg/m3"},
        {"kg/m^3", "kg m^-3"},
        {"J/kg", "J kg^-1"},
        {"J/m^3", "J/m3"},
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        expect(same[i][1], same[i][0], 1);
        expect(same[i][0], same[i][0], 1);
    }
    expect("kN/m^2", "Pa", 1e3);
}

static void prefixes(void)
{
    static const struct {
        const char *prefix;
        double factor;
    } table[] = {{"n", 1e-9}, {"u", 1e-6}, {"\xc2\xb5", 1e-6}, {"m", 1e-3}, {"c", 1e-2},
                 {"d", 1e-1}, {"k", 1e3},  {"M", 1e6},         {"G", 1e9},  {"T", 1e12}};
    static const char *const units[] = {"m", "s", "Pa", "m/s", "J/m^3"};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        for (size_t u = 0; u < sizeof units / sizeof *units; u++) {
            char given[16];
            (void)snprintf(given, sizeof given, "%s%s", table[i].prefix, units[u]);
            expect(given, units[u], table[i].factor);
        }
    }
}

/* Of another kind, of a power (1 mm^2 is 1e-6 m^2), or of none. */
static void refused(void)
{
    static const char *const wrong[][2] = {{"inch", "m"},         {"s", "m"},      {"N s/m^2", "kg/(m^2 s)"},
                                           {"mm^2", "m^2"},       {"", "m"},       {"kkg/m^3", "kg/m^3"},
                                           {"mkg/m^3", "kg/m^3"}, {"m-", "-"},     {"pm", "m"},
                                           {"kg/m^2", "kg/m^3"},  {"MPa ", "MPa"}, {"pa", "Pa"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        double factor;
        CU_ASSERT_FALSE(verify_unit_factor(wrong[i][0], wrong[i][1], &factor));
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"spellings", spellings},
        {"prefixes", prefixes},
        {"refused", refused},
    };
    return unit_main("units", tests, sizeof tests / sizeof *tests);
}
