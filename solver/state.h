/* State: the fields that the scene's terms declare, and no others. Evolved fields are one block, so that an
 * integrator's stage is one loop. */
#ifndef SOLVER_STATE_H
#define SOLVER_STATE_H

#include "solver/integrator.h"
#include "solver/scene.h"
#include "solver/upwind.h"

/* A field of the state. */
struct solver_field {
    const char *name;
    size_t width;  /* doubles per particle, padding included */
    size_t offset; /* evolved fields: start within the evolved block, in doubles */
    bool evolved;
};

enum { SOLVER_STATE_FIELDS = 12 };

struct solver_state {
    size_t count, lanes;
    size_t field_count;
    struct solver_field field[SOLVER_STATE_FIELDS];
    size_t evolved;    /* doubles of the evolved block */
    double *U, *start; /* [evolved] state now and at the start of the step */
    double *rate;      /* [evolved] */
    double *sum;       /* [evolved]; NULL where the integrator does not need it */
    double *X;         /* [count][lanes] reference positions [m] */
    double *derived;   /* all fields that are not evolved */
};

/* Reserves the fields and points `work` at them. `least_squares`: the reconstruction has a gradient of its own. */
bool solver_state_create(struct solver_state *state, size_t count, int dim, const struct solver_integrator *integrator,
                         bool least_squares, struct solver_upwind *work, struct solver_error *error);
void solver_state_free(struct solver_state *state);
/* Of the scheme's fields alone, and with the integrator's copies. */
double solver_state_bytes_per_particle(const struct solver_state *state, bool with_integrator);

#endif
