#include "solver/state.h"

#include "solver/memory.h"

#include <stdlib.h>

/* Appends the table's fields of one kind to the state's, to lie behind `size` doubles, and returns the doubles then. */
static size_t take(struct solver_state *state, const struct solver_field *table, size_t rows, bool evolved, bool rate,
                   size_t size)
{
    size_t padded = (state->count + 7) / 8 * 8; /* every field starts on a cache line */
    for (size_t i = 0; i < rows; i++) {
        if (table[i].evolved != evolved || (table[i].rate != NULL) != rate || table[i].width == 0) {
            continue;
        }
        struct solver_field *field = &state->field[state->field_count++];
        *field = table[i];
        field->offset = size;
        size += padded * field->width;
    }
    return size;
}

/* Writes the addresses of the evolved fields where they are wanted. */
static void bind(struct solver_state *state)
{
    for (size_t i = 0; i < state->field_count && state->field[i].evolved; i++) {
        *state->field[i].value = state->U + state->field[i].offset;
    }
}

bool solver_state_create(struct solver_state *state, size_t count, int dim, const struct solver_integrator *integrator,
                         const struct solver_field *table, size_t rows, struct solver_error *error)
{
    *state = (struct solver_state){.count = count, .lanes = solver_state_lanes(dim)};
    for (size_t i = 0; i < rows; i++) {
        *table[i].value = NULL;
        if (table[i].rate != NULL) {
            *table[i].rate = NULL;
        }
    }
    state->rates = take(state, table, rows, true, true, 0);
    state->evolved = take(state, table, rows, true, false, state->rates);
    size_t fixed = take(state, table, rows, false, false, 0);
    if (!solver_alloc((void **)&state->U, state->evolved, sizeof(double), "state", error) ||
        !solver_alloc((void **)&state->start, state->evolved, sizeof(double), "state", error) ||
        !solver_alloc((void **)&state->rate, state->rates, sizeof(double), "rates", error) ||
        !solver_alloc((void **)&state->fixed, fixed, sizeof(double), "stresses", error) ||
        (integrator->needs_sum &&
         !solver_alloc((void **)&state->sum, state->evolved, sizeof(double), "stage sums", error))) {
        return false;
    }
    bind(state);
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        if (!field->evolved) {
            *field->value = state->fixed + field->offset;
        } else if (field->rate != NULL) {
            *field->rate = state->rate + field->offset;
        }
    }
    state->v = *table[0].value;
    state->x = *table[1].value;
    state->v_rate = *table[0].rate;
    return true;
}

void solver_state_turn(struct solver_state *state)
{
    double *start = state->start;
    state->v = start + (state->v - state->U);
    state->x = start + (state->x - state->U);
    state->start = state->U;
    state->U = start;
    bind(state);
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

/* A field as often as it is stored: now, and if it is evolved at the start, as a rate of its own, and as a sum. */
static size_t copies_of(const struct solver_state *state, const struct solver_field *field)
{
    return field->evolved ? 2U + (field->rate != NULL) + (state->sum != NULL) : 1;
}

double solver_state_bytes_per_particle(const struct solver_state *state, bool with_integrator)
{
    size_t doubles = 0;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        doubles += (with_integrator ? copies_of(state, field) : 1) * field->width;
    }
    return (double)(doubles * sizeof(double));
}

void solver_state_arrays(const struct solver_state *state, struct solver_cost_arrays *arrays)
{
    size_t named = 0;
    size_t fixed = 0;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        size_t bytes = state->count * field->width * sizeof(double) * copies_of(state, field);
        solver_cost_bytes(arrays, field->evolved ? "evolved" : "fields", field->name, bytes);
        named += bytes;
        fixed += field->evolved ? 0 : (state->count + 7) / 8 * 8 * field->width;
    }
    size_t blocks = (state->sum != NULL ? 3 : 2) * solver_alloc_bytes(state->evolved, sizeof(double)) +
                    solver_alloc_bytes(state->rates, sizeof(double)) + solver_alloc_bytes(fixed, sizeof(double));
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
