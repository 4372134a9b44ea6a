#include "verify/level.h"

#include <math.h>
#include <string.h>

size_t verify_level_error(const char *name, bool *is_rate)
{
    static const char prefix[] = "rate ";
    bool rate = strncmp(name, prefix, sizeof prefix - 1) == 0;
    if (is_rate != NULL) {
        *is_rate = rate;
    }
    return verify_error_find(name + (rate ? sizeof prefix - 1 : 0));
}

bool verify_level_value(const struct solver_scene *scene, const struct verify_level *level, const char *name,
                        const char *where, struct verify_value *value, struct solver_error *error)
{
    bool is_rate;
    size_t which = verify_level_error(name, &is_rate);
    const char *lacks = NULL;
    if (which == VERIFY_ERRORS) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: there is no error called \"%s\"; there are %s, and \"rate \" before any of them", where,
                           name, verify_error_names);
    }
    if (!verify_error_applies(scene, which, &lacks)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: \"%s\" needs the scene's key %s", where, name, lacks);
    }
    *value = (struct verify_value){
        .value = is_rate ? level->rate[which] : level->error[which],
        .op = is_rate ? ">=" : "<=",
        .unit = is_rate ? "-" : verify_error_unit(which),
    };
    return true;
}

bool verify_level_snapshot(struct verify_level *level, struct solver_run *run, const struct oracle_kind *kind,
                           const struct oracle *oracle, struct solver_error *error)
{
    struct verify_snapshot *taken = &level->snapshot[level->snapshot_count];
    level->snapshot_count++; /* also of what was begun and failed: it is freed with the level */
    if (!verify_snapshot_take(run, kind, oracle, taken, error)) {
        return false;
    }
    verify_norms_worst(level->snapshot_count - 1, taken->error, level->error);
    return true;
}

void verify_level_free(struct verify_level *level)
{
    for (size_t i = 0; i < level->snapshot_count; i++) {
        verify_snapshot_free(&level->snapshot[i]);
    }
    level->snapshot_count = 0;
}
