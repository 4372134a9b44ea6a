#include "oracles/oracle.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* One line per oracle: the name of its struct oracle_kind. */
#define ORACLE_TABLE(ENTRY)                                                                                            \
    ENTRY(oracle_bimaterial_wave)                                                                                      \
    ENTRY(oracle_breathing_cylinder)                                                                                   \
    ENTRY(oracle_breathing_sphere)                                                                                     \
    ENTRY(oracle_cable)                                                                                                \
    ENTRY(oracle_cantilever)                                                                                           \
    ENTRY(oracle_cantilever_plane_stress)                                                                              \
    ENTRY(oracle_free_top)                                                                                             \
    ENTRY(oracle_j2_hencky_uniaxial)                                                                                   \
    ENTRY(oracle_j2_simple_shear)                                                                                      \
    ENTRY(oracle_j2_uniaxial)                                                                                          \
    ENTRY(oracle_plastic_wave)                                                                                         \
    ENTRY(oracle_plate_impact_mie_grueneisen)                                                                          \
    ENTRY(oracle_plate_impact_stiffened)                                                                               \
    ENTRY(oracle_rod_impact)                                                                                           \
    ENTRY(oracle_swinging_cube)                                                                                        \
    ENTRY(oracle_thin_plate)                                                                                           \
    ENTRY(oracle_tube_oscillation)

#define DECLARE(kind) extern const struct oracle_kind kind;
#define ADDRESS(kind) &kind,

ORACLE_TABLE(DECLARE)

static const struct oracle_kind *const kinds[] = {ORACLE_TABLE(ADDRESS) NULL};

const struct oracle_kind *const *oracle_kinds(void)
{
    return kinds;
}

const struct oracle_kind *oracle_find(const char *name)
{
    for (const struct oracle_kind *const *kind = kinds; *kind != NULL; kind++) {
        if (name != NULL && strcmp((*kind)->name, name) == 0) {
            return *kind;
        }
    }
    return NULL;
}

static bool admissible(const struct oracle_parameter *parameter, double value)
{
    return isfinite(value) && (parameter->lower_open ? value > parameter->lower : value >= parameter->lower) &&
           (parameter->upper_open ? value < parameter->upper : value <= parameter->upper);
}

/* "a finite number, > -1 and < 0.5" */
static void describe_interval(const struct oracle_parameter *parameter, char *text, size_t size)
{
    char lower[64] = "", upper[64] = "";
    if (isfinite(parameter->lower)) {
        (void)snprintf(lower, sizeof lower, ", %s %.15g", parameter->lower_open ? ">" : ">=", parameter->lower);
    }
    if (isfinite(parameter->upper)) {
        (void)snprintf(upper, sizeof upper, "%s %s %.15g", lower[0] != '\0' ? " and" : ",",
                       parameter->upper_open ? "<" : "<=", parameter->upper);
    }
    (void)snprintf(text, size, "a finite number%s%s", lower, upper);
}

bool oracle_create(const struct oracle_kind *kind, const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    *oracle = NULL;
    why[0] = '\0';
    for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
        const struct oracle_parameter *parameter = &kind->parameter[i];
        if (!admissible(parameter, value[i])) {
            char interval[160];
            describe_interval(parameter, interval, sizeof interval);
            (void)snprintf(why, ORACLE_WHY, "%s = %.15g [%s], but it must be %s (%s); %s = %g would do",
                           parameter->name, value[i], parameter->unit, interval, parameter->help, parameter->name,
                           parameter->typical);
            return false;
        }
    }
    return kind->create != NULL ? kind->create(value, oracle, why) : kind->create_as(kind, value, oracle, why);
}

bool oracle_law_holds(const struct oracle_check *line)
{
    return islessequal(line->residual, line->bound); /* not so if it is no number */
}

bool oracle_self_check(const struct oracle_kind *kind, const struct oracle *oracle,
                       struct oracle_check line[ORACLE_LAWS], size_t *count)
{
    size_t filled = kind->check(kind, oracle, line, ORACLE_LAWS);
    bool hold = filled > 0 && filled <= ORACLE_LAWS;
    *count = filled <= ORACLE_LAWS ? filled : ORACLE_LAWS;
    for (size_t i = 0; i < *count; i++) {
        hold = hold && oracle_law_holds(&line[i]);
    }
    return hold;
}
