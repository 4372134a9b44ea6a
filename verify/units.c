#include "verify/units.h"

#include <ctype.h>
#include <stddef.h>
#include <string.h>

/* Other spellings of the units that oracles have. */
static const struct {
    const char *wanted, *spelling;
} spellings[] = {
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

static const struct {
    const char *prefix;
    double factor;
} prefixes[] = {{"n", 1e-9}, {"u", 1e-6}, {"\xc2\xb5", 1e-6}, {"m", 1e-3}, {"c", 1e-2},
                {"d", 1e-1}, {"k", 1e3},  {"M", 1e6},         {"G", 1e9},  {"T", 1e12}};

static bool is_spelling(const char *given, const char *wanted)
{
    bool same = strcmp(given, wanted) == 0;
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings && !same; i++) {
        same = strcmp(wanted, spellings[i].wanted) == 0 && strcmp(given, spellings[i].spelling) == 0;
    }
    return same;
}

/* A prefix multiplies its symbol: none goes before a power of one, nor before a kilogram, nor before no unit. */
static bool takes_prefix(const char *wanted)
{
    size_t length = 0;
    while (isalpha((unsigned char)wanted[length])) {
        length++;
    }
    return length > 0 && wanted[length] != '^' && strncmp(wanted, "kg", 2) != 0;
}

bool verify_unit_factor(const char *given, const char *wanted, double *factor)
{
    *factor = 1;
    if (is_spelling(given, wanted)) {
        return true;
    }
    for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes && takes_prefix(wanted); i++) {
        size_t length = strlen(prefixes[i].prefix);
        if (strncmp(given, prefixes[i].prefix, length) == 0 && is_spelling(given + length, wanted)) {
            *factor = prefixes[i].factor;
            return true;
        }
    }
    return false;
}

static void trim(char *text)
{
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1])) {
        text[--length] = '\0';
    }
}

char *verify_unit_split(char *text)
{
    trim(text);
    size_t length = strlen(text);
    char *open = strchr(text, '['), *space = strrchr(text, ' ');
    if (open != NULL && length > 0 && text[length - 1] == ']') {
        text[length - 1] = '\0';
        *open = '\0';
        trim(text);
        return open + 1;
    }
    if (open == NULL && space != NULL && (isdigit((unsigned char)text[0]) || strchr("+-.", text[0]) != NULL)) {
        *space = '\0';
        trim(text);
        return space + 1;
    }
    return NULL;
}
