#include "solver/state.h"

#include "solver/memory.h"

#include <stdlib.h>

/* Particles that a field has room for: every field starts on a cache line. */
static size_t padded_count(const struct solver_state *state)
{
    size_t line = 64 / solver_state_bytes(state);
    return (state->count + line - 1) / line * line;
}

/* Appends the table's fields of one kind to the state's, to lie behind `size` numbers, and returns the numbers then. */
static size_t take(struct solver_state *state, const struct solver_field *table, size_t rows, bool evolved, bool rate,
                   size_t size)
{
    size_t padded = padded_count(state);
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
        const struct solver_field *field = &state->field[i];
        if (state->in_single) {
            *field->single = state->single.U + field->offset;
        } else {
            *field->value = state->U + field->offset;
        }
    }
}

/* The same of what is not evolved, and of rates. */
static void bind_others(struct solver_state *state)
{
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        if (!field->evolved && state->in_single) {
            *field->single = state->single.fixed + field->offset;
        } else if (!field->evolved) {
            *field->value = state->fixed + field->offset;
        } else if (field->rate != NULL && state->in_single) {
            *field->single_rate = state->single.rate + field->offset;
        } else if (field->rate != NULL) {
            *field->rate = state->rate + field->offset;
        }
    }
}

static bool reserve(const struct solver_state *state, double **wide, float **single, size_t count, const char *what,
                    struct solver_error *error)
{
    return state->in_single ? solver_alloc((void **)single, count, sizeof **single, what, error)
                            : solver_alloc((void **)wide, count, sizeof **wide, what, error);
}

static bool reserve_blocks(struct solver_state *state, size_t fixed, bool sum, struct solver_error *error)
{
    return reserve(state, &state->U, &state->single.U, state->evolved, "state", error) &&
           reserve(state, &state->start, &state->single.start, state->evolved, "state", error) &&
           reserve(state, &state->rate, &state->single.rate, state->rates, "rates", error) &&
           reserve(state, &state->fixed, &state->single.fixed, fixed, "stresses", error) &&
           (!sum || reserve(state, &state->sum, &state->single.sum, state->evolved, "stage sums", error));
}

/* NULL, where a table of fields wants addresses. */
static void clear(const struct solver_field *field, bool single)
{
    if (single) {
        *field->single = NULL;
    } else {
        *field->value = NULL;
    }
    if (field->rate != NULL && single) {
        *field->single_rate = NULL;
    } else if (field->rate != NULL) {
        *field->rate = NULL;
    }
}

bool solver_state_create(struct solver_state *state, size_t count, int dim, bool single,
                         const struct solver_integrator *integrator, const struct solver_field *table, size_t rows,
                         struct solver_error *error)
{
    static const struct solver_single_loops *const loops[][3] = SOLVER_LOOPS(solver_single);
    *state = (struct solver_state){.count = count, .lanes = solver_state_lanes(dim), .in_single = single};
    state->single.loops = loops[solver_path()][dim - 1];
    for (size_t i = 0; i < rows; i++) {
        clear(&table[i], single);
    }
    state->rates = take(state, table, rows, true, true, 0);
    state->evolved = take(state, table, rows, true, false, state->rates);
    size_t fixed = take(state, table, rows, false, false, 0);
    if (!reserve_blocks(state, fixed, integrator->needs_sum, error)) {
        return false;
    }
    bind(state);
    bind_others(state);
    if (single) {
        state->single.v = *table[0].single;
        state->single.u = *table[1].single;
        state->single.v_rate = *table[0].single_rate;
    } else {
        state->v = *table[0].value;
        state->x = *table[1].value;
        state->v_rate = *table[0].rate;
    }
    return true;
}

void solver_state_turn(struct solver_state *state)
{
    if (state->in_single) {
        float *start = state->single.start;
        state->single.v = start + (state->single.v - state->single.U);
        state->single.u = start + (state->single.u - state->single.U);
        state->single.start = state->single.U;
        state->single.U = start;
    } else {
        double *start = state->start;
        state->v = start + (state->v - state->U);
        state->x = start + (state->x - state->U);
        state->start = state->U;
        state->U = start;
    }
    bind(state);
}

void solver_state_free(struct solver_state *state)
{
    double *const wide[] = {state->U, state->start, state->rate, state->sum, state->fixed};
    float *const single[] = {state->single.U, state->single.start, state->single.rate, state->single.sum,
                             state->single.fixed};
    for (size_t i = 0; i < sizeof wide / sizeof *wide; i++) {
        free(wide[i]);
        free(single[i]);
    }
    *state = (struct solver_state){.count = 0};
}

/* A field as often as it is stored: now, and if it is evolved at the start, as a rate of its own, and as a sum. */
static size_t copies_of(const struct solver_state *state, const struct solver_field *field)
{
    bool sum = state->sum != NULL || state->single.sum != NULL;
    return field->evolved ? 2U + (field->rate != NULL) + sum : 1;
}

double solver_state_bytes_per_particle(const struct solver_state *state, bool with_integrator)
{
    size_t numbers = 0;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        numbers += (with_integrator ? copies_of(state, field) : 1) * field->width;
    }
    return (double)(numbers * solver_state_bytes(state));
}

void solver_state_arrays(const struct solver_state *state, struct solver_cost_arrays *arrays)
{
    size_t number = solver_state_bytes(state);
    size_t blocks = state->sum != NULL || state->single.sum != NULL ? 3 : 2; /* now, at the start, and sum */
    size_t named = 0;
    size_t fixed = 0;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        size_t bytes = state->count * field->width * number * copies_of(state, field);
        solver_cost_bytes(arrays, field->evolved ? "evolved" : "fields", field->name, bytes);
        named += bytes;
        fixed += field->evolved ? 0 : padded_count(state) * field->width;
    }
    size_t taken = blocks * solver_alloc_bytes(state->evolved, number) + solver_alloc_bytes(state->rates, number) +
                   solver_alloc_bytes(fixed, number);
    solver_cost_bytes(arrays, "fields", "alignment", taken - named);
}

void solver_state_terms(const struct solver_state *state, const struct solver_integrator *integrator,
                        struct solver_cost_terms *terms)
{
    /* run_stages.c, update_entries: of an entry in the first stage and in later ones */
    double first = integrator->needs_sum ? 4 : 3;
    double later = integrator->needs_sum ? 10 : 6;
    double entries = 0.0;
    for (size_t i = 0; i < state->field_count && state->field[i].evolved; i++) {
        entries += (double)(state->count * state->field[i].width);
    }
    solver_cost_once(terms, "stages of the integrator", entries * (first + later * (double)(integrator->stages - 1)));
}
