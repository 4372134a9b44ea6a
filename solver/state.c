#include "solver/state.h"

#include "solver/memory.h"

#include <stdlib.h>

/* Appends the table's fields of one kind to the state's, and returns the doubles they take. */
static size_t take(struct solver_state *state, const struct solver_field *table, size_t rows, bool evolved)
{
    size_t padded = (state->count + 7) / 8 * 8; /* every field starts on a cache line */
    size_t size = 0;
    for (size_t i = 0; i < rows; i++) {
        if (table[i].evolved != evolved || table[i].width == 0) {
            continue;
        }
        struct solver_field *field = &state->field[state->field_count++];
        *field = table[i];
        field->offset = size;
        size += padded * field->width;
    }
    return size;
}

bool solver_state_create(struct solver_state *state, size_t count, int dim, const struct solver_integrator *integrator,
                         const struct solver_field *table, size_t rows, struct solver_error *error)
{
    *state = (struct solver_state){.count = count, .lanes = solver_state_lanes(dim)};
    for (size_t i = 0; i < rows; i++) {
        *table[i].value = NULL;
        if (table[i].evolved) {
            *table[i].rate = NULL;
        }
    }
    state->evolved = take(state, table, rows, true);
    size_t fixed = take(state, table, rows, false);
    if (!solver_alloc((void **)&state->U, state->evolved, sizeof(double), "state", error) ||
        !solver_alloc((void **)&state->start, state->evolved, sizeof(double), "state", error) ||
        !solver_alloc((void **)&state->rate, state->evolved, sizeof(double), "rates", error) ||
        !solver_alloc((void **)&state->fixed, fixed, sizeof(double), "stresses", error) ||
        (integrator->needs_sum &&
         !solver_alloc((void **)&state->sum, state->evolved, sizeof(double), "stage sums", error))) {
        return false;
    }
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        *field->value = (field->evolved ? state->U : state->fixed) + field->offset;
        if (field->evolved) {
            *field->rate = state->rate + field->offset;
        }
    }
    state->v = *table[0].value;
    state->x = *table[1].value;
    state->v_rate = *table[0].rate;
    return true;
}

void solver_state_free(struct solver_state *state)
{
    free(state->U);
    free(state->start);
    free(state->rate);
    free(state->sum);
    free(state->fixed);
    *state = (struct solver_state){.U = NULL};
}

double solver_state_bytes_per_particle(const struct solver_state *state, bool with_integrator)
{
    size_t doubles = 0;
    for (size_t i = 0; i < state->field_count; i++) {
        size_t copies = state->field[i].evolved && with_integrator ? (state->sum != NULL ? 4 : 3) : 1;
        doubles += copies * state->field[i].width;
    }
    return (double)(doubles * sizeof(double));
}

void solver_state_arrays(const struct solver_state *state, struct solver_cost_arrays *arrays)
{
    size_t copies = state->sum != NULL ? 4 : 3; /* now, at the start, rate and sum */
    size_t named = 0;
    size_t fixed = 0;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        size_t bytes = state->count * field->width * sizeof(double) * (field->evolved ? copies : 1);
        solver_cost_bytes(arrays, field->evolved ? "evolved" : "fields", field->name, bytes);
        named += bytes;
        fixed += field->evolved ? 0 : (state->count + 7) / 8 * 8 * field->width;
    }
    size_t blocks =
        copies * solver_alloc_bytes(state->evolved, sizeof(double)) + solver_alloc_bytes(fixed, sizeof(double));
    solver_cost_bytes(arrays, "fields", "alignment", blocks - named);
}

void solver_state_terms(const struct solver_state *state, const struct solver_integrator *integrator,
                        struct solver_cost_terms *terms)
{
    /* run_step.c, update_slice: of an entry in the first stage and in later ones */
    double first = integrator->needs_sum ? 4 : 3;
    double later = integrator->needs_sum ? 10 : 6;
    double entries = 0.0;
    for (size_t i = 0; i < state->field_count && state->field[i].evolved; i++) {
        entries += (double)(state->count * state->field[i].width);
    }
    solver_cost_once(terms, "stages of the integrator", entries * (first + later * (double)(integrator->stages - 1)));
}
