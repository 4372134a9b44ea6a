/* State: the fields that a scheme declares for its scene's terms, and no others. Evolved fields are one block, and
 * there are two of it: the state now, and that at the start of the step, which a step's first stage leaves where it is.
 * Where the rate of x is v none is stored, and x is the last in its block.
 *
 * In single precision all of them are floats, and what is near one is stored as its difference from it, so that small
 * strains keep seven figures: displacements in place of x, F - 1, H - 1, J - 1. */
#ifndef SOLVER_STATE_H
#define SOLVER_STATE_H

#include "solver/cost.h"
#include "solver/error.h"
#include "solver/integrator.h"
#include "solver/single.h"
#include "solver/vectors.h"

#include <stdbool.h>
#include <stddef.h>

/* A field of the state, and where the scheme wants its address put. */
struct solver_field {
    const char *name;
    size_t width; /* numbers per particle, padding included; 0: the scene's terms need no such field */
    bool evolved; /* it has a rate, and the integrator's copies */
    union {
        double **value; /* becomes [count][width] */
        float **single; /* the same in single precision */
    };
    union {
        double *
            *rate; /* the same of an evolved field's rate; NULL: it is v, for x alone, or the field is not evolved */
        float **single_rate;
    };
    size_t offset; /* start within its block, in numbers; set by solver_state_create */
};

enum { SOLVER_STATE_FIELDS = 24 };

struct solver_state {
    size_t count, lanes;
    size_t field_count;
    struct solver_field field[SOLVER_STATE_FIELDS]; /* evolved ones first, as they lie in their block */
    size_t evolved;                                 /* numbers of the evolved block */
    size_t rates;                                   /* numbers of it that have a rate, which come first */
    double *U, *start;                              /* [evolved] state now and at the start of the step */
    double *rate;                                   /* [rates] */
    double *sum;                                    /* [evolved]; NULL where the integrator does not need it */
    double *fixed;                                  /* all fields that are not evolved */
    double *v, *x, *v_rate;                         /* [count][lanes], within the blocks */
    bool in_single;                                 /* precision; all of these are then NULL, and in their place: */
    struct {
        float *U, *start, *rate, *sum, *fixed;
        float *v, *u, *v_rate; /* u: displacement */
        const struct solver_single_loops *loops;
    } single;
};

/* Of a number. */
static inline size_t solver_state_bytes(const struct solver_state *state)
{
    size_t bytes = sizeof(double);
    if (state->in_single) {
        bytes = sizeof(float);
    }
    return bytes;
}

static inline struct solver_vectors solver_state_v(const struct solver_state *state)
{
    return (struct solver_vectors){state->v, state->single.v, state->lanes};
}

static inline struct solver_vectors solver_state_v_rate(const struct solver_state *state)
{
    return (struct solver_vectors){state->v_rate, state->single.v_rate, state->lanes};
}

/* Displacement, and the place that is it from X, of particle a along axis i, where it was at X. */
static inline double solver_state_u(const struct solver_state *state, size_t a, size_t i, double X)
{
    size_t at = a * state->lanes + i;
    return state->in_single ? (double)state->single.u[at] : state->x[at] - X;
}

static inline double solver_state_x(const struct solver_state *state, size_t a, size_t i, double X)
{
    size_t at = a * state->lanes + i;
    return state->in_single ? X + (double)state->single.u[at] : state->x[at];
}

/* Doubles that a vector takes, padded. */
static inline size_t solver_state_lanes(int dim)
{
    return dim == 3 ? 4 : (size_t)dim;
}

/* Puts the particle there. */
static inline void solver_state_place(const struct solver_state *state, size_t a, size_t i, double X, double u)
{
    size_t at = a * state->lanes + i;
    if (state->in_single) {
        state->single.u[at] = (float)u;
    } else {
        state->x[at] = X + u;
    }
}

/* The rate of entry i of the evolved block: what has none stored is x, and v lies where the block begins. */
static inline double solver_state_rate(const struct solver_state *state, size_t i)
{
    return i < state->rates ? state->rate[i] : state->U[i - state->rates];
}

/* Reserves the fields of a table of at most SOLVER_STATE_FIELDS rows and writes their addresses where the rows say,
 * NULL for those of width 0. The table's first two rows are the velocity v [m/s] and the position x [m] of the
 * particles, evolved padded vectors. `single`: in single precision; the second is then the displacement. */
bool solver_state_create(struct solver_state *state, size_t count, int dim, bool single,
                         const struct solver_integrator *integrator, const struct solver_field *table, size_t rows,
                         struct solver_error *error);
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
