#include "solver/state.h"

#include "solver/memory.h"

#include <stdlib.h>

static struct solver_field *declare(struct solver_state *state, const char *name, size_t width, bool evolved)
{
    struct solver_field *field = &state->field[state->field_count++];
    *field = (struct solver_field){.name = name, .width = width, .evolved = evolved};
    return field;
}

/* Where a scene's pointers lie, beside the field they belong to. */
struct binding {
    double **value, **rate;
    struct solver_field *field;
};

bool solver_state_create(struct solver_state *state, size_t count, int dim, const struct solver_integrator *integrator,
                         bool least_squares, struct solver_upwind *work, struct solver_error *error)
{
    size_t d = (size_t)dim;
    size_t lanes = d == 3 ? 4 : d;
    size_t tensor = d * lanes;
    struct binding evolved[5];
    struct binding derived[5];
    size_t evolved_count = 0;
    size_t derived_count = 0;
    *state = (struct solver_state){.count = count, .lanes = lanes};

    evolved[evolved_count++] = (struct binding){&work->v, &work->v_rate, declare(state, "v", lanes, true)};
    evolved[evolved_count++] = (struct binding){&work->x, &work->x_rate, declare(state, "x", lanes, true)};
    evolved[evolved_count++] = (struct binding){&work->F, &work->F_rate, declare(state, "F", tensor, true)};
    if (work->evolves_H) {
        evolved[evolved_count++] = (struct binding){&work->H, &work->H_rate, declare(state, "H", tensor, true)};
    }
    if (work->evolves_J) {
        evolved[evolved_count++] = (struct binding){&work->J, &work->J_rate, declare(state, "J", 1, true)};
    }
    derived[derived_count++] = (struct binding){&work->P, NULL, declare(state, "P", tensor, false)};
    if (work->evolves_J && !work->evolves_H && !work->frozen) {
        derived[derived_count++] = (struct binding){&work->cofactor, NULL, declare(state, "cof F", tensor, false)};
    }
    if (work->evolves_J && !work->whole_jump) {
        derived[derived_count++] = (struct binding){&work->pressure, NULL, declare(state, "U'(J)", 1, false)};
        if (work->reconstruct) {
            derived[derived_count++] =
                (struct binding){&work->pressure_gradient, NULL, declare(state, "grad U'(J)", lanes, false)};
        }
    } else if (work->evolves_J && work->reconstruct) {
        derived[derived_count++] =
            (struct binding){&work->P_gradient, NULL, declare(state, "grad P", d * tensor, false)};
    }
    if (work->reconstruct && least_squares) {
        derived[derived_count++] = (struct binding){&work->v_gradient, NULL, declare(state, "grad v", tensor, false)};
    }

    size_t padded = (count + 7) / 8 * 8; /* every field starts on a cache line */
    size_t derived_size = 0;
    for (size_t i = 0; i < evolved_count; i++) {
        evolved[i].field->offset = state->evolved;
        state->evolved += padded * evolved[i].field->width;
    }
    for (size_t i = 0; i < derived_count; i++) {
        derived[i].field->offset = derived_size;
        derived_size += padded * derived[i].field->width;
    }
    if (!solver_alloc((void **)&state->U, state->evolved, sizeof(double), "state", error) ||
        !solver_alloc((void **)&state->start, state->evolved, sizeof(double), "state", error) ||
        !solver_alloc((void **)&state->rate, state->evolved, sizeof(double), "rates", error) ||
        !solver_alloc((void **)&state->X, padded * lanes, sizeof(double), "positions", error) ||
        !solver_alloc((void **)&state->derived, derived_size, sizeof(double), "stresses", error) ||
        (integrator->needs_sum &&
         !solver_alloc((void **)&state->sum, state->evolved, sizeof(double), "stage sums", error))) {
        return false;
    }
    for (size_t i = 0; i < evolved_count; i++) {
        *evolved[i].value = state->U + evolved[i].field->offset;
        *evolved[i].rate = state->rate + evolved[i].field->offset;
    }
    for (size_t i = 0; i < derived_count; i++) {
        *derived[i].value = state->derived + derived[i].field->offset;
    }
    if (work->evolves_H && !work->frozen) {
        work->cofactor = work->H;
    }
    work->X = state->X;
    return true;
}

void solver_state_free(struct solver_state *state)
{
    free(state->U);
    free(state->start);
    free(state->rate);
    free(state->sum);
    free(state->X);
    free(state->derived);
    *state = (struct solver_state){.U = NULL};
}

double solver_state_bytes_per_particle(const struct solver_state *state, bool with_integrator)
{
    size_t doubles = state->lanes; /* reference positions */
    for (size_t i = 0; i < state->field_count; i++) {
        size_t copies = state->field[i].evolved && with_integrator ? (state->sum != NULL ? 4 : 3) : 1;
        doubles += copies * state->field[i].width;
    }
    return (double)(doubles * sizeof(double));
}
