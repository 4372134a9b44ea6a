#include "solver/integrator.h"

#include <stddef.h>
#include <string.h>

static const struct solver_integrator integrators[] = {
    {"euler",
     "one-stage, first order, explicit (001_363f711843f01da4.txt eq. 22-25)",
     1,
     1,
     false,
     {{.time = 0.0, .rate = 1.0, .weight = 1.0}}},
    {"tvd-rk2",
     "two-stage, second order, total variation diminishing: the papers' (000_e9ec29e1bde7947d.txt eq. 40)",
     2,
     2,
     false,
     {{.time = 0.0, .rate = 1.0, .weight = 0.5}, {.time = 1.0, .keep = 0.5, .rate = 0.5, .weight = 0.5}}},
    {"ssp-rk3",
     "three-stage, third order, strong stability preserving (Shu, Osher 1988)",
     3,
     3,
     false,
     {{.time = 0.0, .rate = 1.0, .weight = 1.0 / 6.0},
      {.time = 1.0, .keep = 1.0 / 4.0, .rate = 1.0 / 4.0, .weight = 1.0 / 6.0},
      {.time = 0.5, .keep = 2.0 / 3.0, .rate = 2.0 / 3.0, .weight = 2.0 / 3.0}}},
    {"rk4",
     "four-stage, fourth order, classical",
     4,
     4,
     true,
     {{.time = 0.0, .rate = 0.5, .accumulate = 1.0 / 6.0, .weight = 1.0 / 6.0},
      {.time = 0.5, .rate = 0.5, .accumulate = 1.0 / 3.0, .weight = 1.0 / 3.0},
      {.time = 0.5, .rate = 1.0, .accumulate = 1.0 / 3.0, .weight = 1.0 / 3.0},
      {.time = 1.0, .rate = 1.0 / 6.0, .sum = 1.0, .weight = 1.0 / 6.0}}},
    {.name = NULL},
};

const struct solver_integrator *solver_integrators(void)
{
    return integrators;
}

const struct solver_integrator *solver_integrator_find(const char *name)
{
    for (const struct solver_integrator *integrator = integrators; integrator->name != NULL; integrator++) {
        if (strcmp(integrator->name, name) == 0) {
            return integrator;
        }
    }
    return NULL;
}
