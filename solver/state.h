/* State: the fields that a scheme declares for its scene's terms, and no others. Evolved fields are one block, and
 * there are two of it: the state now, and that at the start of the step, which a step's first stage leaves where it is.
 * Where the rate of x is v none is stored, and x is the last in its block. */
#ifndef SOLVER_STATE_H
#define SOLVER_STATE_H

#include "solver/cost.h"
#include "solver/error.h"
#include "solver/integrator.h"

#include <stdbool.h>
#include <stddef.h>

/* A field of the state, and where the scheme wants its address put. */
struct solver_field {
    const char *name;
    size_t width;   /* doubles per particle, padding included; 0: the scene's terms need no such field */
    bool evolved;   /* it has a rate, and the integrator's copies */
    double **value; /* becomes [count][width] */
    double **rate;  /* the same of an evolved field's rate; NULL: it is v, for x alone, or the field is not evolved */
    size_t offset;  /* start within its block, in doubles; set by solver_state_create */
};

enum { SOLVER_STATE_FIELDS = 24 };

struct solver_state {
    size_t count, lanes;
    size_t field_count;
    struct solver_field field[SOLVER_STATE_FIELDS]; /* evolved ones first, as they lie in their block */
    size_t evolved;                                 /* doubles of the evolved block */
    size_t rates;                                   /* doubles of it that have a rate, which come first */
    double *U, *start;                              /* [evolved] state now and at the start of the step */
    double *rate;                                   /* [rates] */
    double *sum;                                    /* [evolved]; NULL where the integrator does not need it */
    double *fixed;                                  /* all fields that are not evolved */
    double *v, *x, *v_rate;                         /* [count][lanes], within the blocks */
};

/* Doubles that a vector takes, padded. */
static inline size_t solver_state_lanes(int dim)
{
    return dim == 3 ? 4 : (size_t)dim;
}

/* The rate of entry i of the evolved block: what has none stored is x, and v lies where the block begins. */
static inline double solver_state_rate(const struct solver_state *state, size_t i)
{
    return i < state->rates ? state->rate[i] : state->U[i - state->rates];
}

/* Reserves the fields of a table of at most SOLVER_STATE_FIELDS rows and writes their addresses where the rows say,
 * NULL for those of width 0. The table's first two rows are the velocity v [m/s] and the position x [m] of the
 * particles, evolved padded vectors. */
bool solver_state_create(struct solver_state *state, size_t count, int dim, const struct solver_integrator *integrator,
                         const struct solver_field *table, size_t rows, struct solver_error *error);
void solver_state_free(struct solver_state *state);
/* The two blocks change places: addresses of evolved fields are written anew. */
void solver_state_turn(struct solver_state *state);
/* Of the scheme's fields alone, and with the integrator's copies. */
double solver_state_bytes_per_particle(const struct solver_state *state, bool with_integrator);
/* By field, with all the integrator's copies, and what aligns them. */
void solver_state_arrays(const struct solver_state *state, struct solver_cost_arrays *arrays);
/* Of the integrator's stages. */
void solver_state_terms(const struct solver_state *state, const struct solver_integrator *integrator,
                        struct solver_cost_terms *terms);

#endif
