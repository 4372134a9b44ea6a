/* Sweeps over particles, each over all of them, which follow one another piece by piece, while what they share is in
 * cache: a step in one wave moves most fields through memory once, and not once per sweep.
 *
 * Sweep k of a piece may read what sweep k - 1 has left at neighbours, and may write over what sweep k - 1 has read at
 * neighbours. So it waits until all pieces with neighbours of its particles are through sweep k - 1. In which order
 * pieces then go does not change a bit of any result.
 *
 * The order is found once. Each chunk of the pieces has one thread: in its first round it does all that waits for no
 * other chunk, each piece as soon as it may go; the rest of sweep k is done in round k, when all chunks are through
 * round k - 1. */
#ifndef SOLVER_WAVE_H
#define SOLVER_WAVE_H

#include "solver/cost.h"
#include "solver/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct solver_wave {
    int sweeps, chunks;
    size_t count;    /* particles */
    size_t piece;    /* particles of a piece; of the last what is left */
    uint32_t *task;  /* [pieces * sweeps] piece * sweeps + sweep, in the order in which they go */
    size_t *first;   /* [chunks * sweeps + 1] of `task`, where each round of each chunk begins */
    size_t in_round; /* tasks of the first round, of all chunks */
};

/* A neighbour graph in compressed rows. */
struct solver_wave_graph {
    const size_t *row;         /* [count + 1]; NULL: sweeps read no neighbours */
    const uint32_t *neighbour; /* [row[count]] */
};

/* One sweep over particles [begin, end), in a thread. */
typedef void solver_wave_sweep(void *context, int sweep, size_t begin, size_t end);

/* In pieces of `piece` particles, for that many threads. Where a neighbour does not list the particle that lists it, as
 * images may not, sweeps go one after another. */
bool solver_wave_create(struct solver_wave *wave, size_t count, size_t piece, struct solver_wave_graph graph,
                        int sweeps, int threads, struct solver_error *error);
void solver_wave_free(struct solver_wave *wave);
void solver_wave_arrays(const struct solver_wave *wave, struct solver_cost_arrays *arrays);
void solver_wave_run(const struct solver_wave *wave, solver_wave_sweep *sweep, void *context);

#endif
