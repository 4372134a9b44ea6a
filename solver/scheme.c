#include "solver/scheme.h"

#include <string.h>

static const struct solver_scheme *const schemes[] = {
    &solver_scheme_upwind,
    &solver_scheme_jst,
    &solver_scheme_ulsph,
    NULL,
};

const struct solver_scheme *const *solver_schemes(void)
{
    return schemes;
}

const struct solver_scheme *solver_scheme_find(const char *name)
{
    for (const struct solver_scheme *const *scheme = schemes; *scheme != NULL; scheme++) {
        if (strcmp((*scheme)->name, name) == 0) {
            return *scheme;
        }
    }
    return NULL;
}
