/* Rows of pair vectors that are equal bit for bit, kept once. On a lattice nearly all are, and what a pass over the
 * pairs reads of them then comes from cache. */
#include "solver/memory.h"
#include "solver/stencil.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_ROWS = 1 << 13, /* different ones; more would leave the cache as well */
    SLOTS = 2 * MOST_ROWS,
    WORTH = 4 /* pairs that one which is kept must stand for */
};

/* The different rows met so far, found by their bytes. */
struct rows {
    const struct solver_stencil *stencil;
    uint32_t *slot;   /* [SLOTS] one more than the number of a row; 0: free */
    uint32_t *first;  /* [MOST_ROWS] particle that was the first to have it */
    uint32_t *record; /* [MOST_ROWS] where it is to lie */
    size_t count, records;
};

static size_t length(const struct solver_stencil *stencil, size_t a)
{
    return stencil->graph.row[a + 1] - stencil->graph.row[a];
}

static const double *row_of(const struct solver_stencil *stencil, size_t a)
{
    return solver_stencil_C(stencil, stencil->graph.row[a]);
}

static size_t numbers(const struct solver_stencil *stencil, size_t a)
{
    return length(stencil, a) * ((size_t)stencil->dim + 1);
}

static size_t slot_of(const struct solver_stencil *stencil, size_t a)
{
    const double *row = row_of(stencil, a);
    size_t count = numbers(stencil, a);
    uint64_t hash = count;
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, row + i, sizeof bits);
        hash = (hash ^ bits) * 0x9e3779b97f4a7c15U; /* of the golden ratio (Knuth, vol. 3, 6.4) */
        hash ^= hash >> 32;
    }
    return hash % SLOTS;
}

static bool are_equal(const struct solver_stencil *stencil, size_t a, size_t b)
{
    return length(stencil, a) == length(stencil, b) &&
           memcmp(row_of(stencil, a), row_of(stencil, b), numbers(stencil, a) * sizeof(double)) == 0;
}

/* Where the row of particle a is to lie. */
static uint32_t find(struct rows *rows, size_t a)
{
    size_t at = slot_of(rows->stencil, a);
    while (rows->slot[at] != 0) {
        size_t row = rows->slot[at] - 1;
        if (are_equal(rows->stencil, a, rows->first[row])) {
            return rows->record[row];
        }
        at = (at + 1) % SLOTS;
    }
    size_t row = rows->count++;
    rows->slot[at] = (uint32_t)rows->count;
    rows->first[row] = (uint32_t)a;
    rows->record[row] = (uint32_t)rows->records;
    rows->records += length(rows->stencil, a);
    return rows->record[row];
}

/* Rows of all particles; false once there are too many different ones. */
static bool find_all(struct rows *rows, uint32_t *shared)
{
    const struct solver_stencil *stencil = rows->stencil;
    bool worth = true;
    for (size_t a = 0; worth && a < stencil->count; a++) {
        shared[a] = find(rows, a);
        worth = rows->count < MOST_ROWS && rows->records <= stencil->pairs / WORTH;
    }
    return worth;
}

/* The rows that are kept take the place of all. */
static bool gather(struct solver_stencil *stencil, const struct rows *rows, struct solver_error *error)
{
    size_t width = (size_t)stencil->dim + 1;
    double *pair = NULL;
    if (!solver_alloc((void **)&pair, rows->records * width, sizeof *pair, "pair vectors", error)) {
        return false;
    }
    for (size_t row = 0; row < rows->count; row++) {
        size_t a = rows->first[row];
        memcpy(pair + rows->record[row] * width, row_of(stencil, a), numbers(stencil, a) * sizeof *pair);
    }
    free(stencil->pair);
    stencil->pair = pair;
    stencil->records = rows->records;
    return true;
}

bool solver_stencil_share(struct solver_stencil *stencil, struct solver_error *error)
{
    struct rows rows = {.stencil = stencil};
    uint32_t *shared = NULL;
    bool done = solver_alloc((void **)&shared, stencil->count, sizeof *shared, "rows of pair vectors", error) &&
                solver_alloc((void **)&rows.slot, SLOTS, sizeof *rows.slot, "rows of pair vectors", error) &&
                solver_alloc((void **)&rows.first, MOST_ROWS, sizeof *rows.first, "rows of pair vectors", error) &&
                solver_alloc((void **)&rows.record, MOST_ROWS, sizeof *rows.record, "rows of pair vectors", error);
    if (done && find_all(&rows, shared)) {
        done = gather(stencil, &rows, error);
        stencil->shared = done ? shared : NULL;
    }
    if (stencil->shared == NULL) {
        free(shared);
    }
    free(rows.slot);
    free(rows.first);
    free(rows.record);
    return done;
}
