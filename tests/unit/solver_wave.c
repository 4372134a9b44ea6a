/* Waves of sweeps: every sweep of every piece goes once, after its neighbours are through the one before, and before
 * any of them has written over what it reads. */
#include "solver/wave.h"
#include "tests/unit/unit.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

enum { PIECE = 200 };

/* Particles of a lattice in rows, or in disorder, and what sweeps have done to them. */
struct lattice {
    size_t count;
    size_t *row;
    uint32_t *neighbour;
    int *through;              /* [count] sweeps */
    size_t early, late, again; /* visits found wrong */
    int most;                  /* sweeps by which a particle was ahead of the last, at most */
};

static size_t pieces_of(const struct lattice *lattice)
{
    return (lattice->count + PIECE - 1) / PIECE;
}

static size_t site(size_t x, size_t y, size_t along, bool disorder)
{
    size_t a = y * along + x;
    return disorder ? a * 7919 % (along * along) : a; /* prime to along^2 */
}

static struct lattice make(size_t along, bool disorder)
{
    struct lattice lattice = {.count = along * along};
    size_t *where = calloc(lattice.count, sizeof *where);
    lattice.row = calloc(lattice.count + 1, sizeof *lattice.row);
    lattice.neighbour = calloc(4 * lattice.count, sizeof *lattice.neighbour);
    lattice.through = calloc(lattice.count, sizeof *lattice.through);
    CU_ASSERT_FATAL(where != NULL && lattice.row != NULL && lattice.neighbour != NULL && lattice.through != NULL);
    for (size_t y = 0; y < along; y++) {
        for (size_t x = 0; x < along; x++) {
            where[site(x, y, along, disorder)] = y * along + x;
        }
    }
    for (size_t a = 0; a < lattice.count; a++) {
        size_t x = where[a] % along;
        size_t y = where[a] / along;
        size_t ab = lattice.row[a];
        if (x > 0) {
            lattice.neighbour[ab++] = (uint32_t)site(x - 1, y, along, disorder);
        }
        if (x + 1 < along) {
            lattice.neighbour[ab++] = (uint32_t)site(x + 1, y, along, disorder);
        }
        if (y > 0) {
            lattice.neighbour[ab++] = (uint32_t)site(x, y - 1, along, disorder);
        }
        if (y + 1 < along) {
            lattice.neighbour[ab++] = (uint32_t)site(x, y + 1, along, disorder);
        }
        lattice.row[a + 1] = ab;
    }
    free(where);
    return lattice;
}

static void release(struct lattice *lattice)
{
    free(lattice->row);
    free(lattice->neighbour);
    free(lattice->through);
}

/* A sweep that asks whether it may. */
static void visit(void *of, int sweep, size_t begin, size_t end)
{
    struct lattice *lattice = of;
#pragma omp critical(visits)
    for (size_t a = begin; a < end; a++) {
        for (size_t ab = lattice->row[a]; ab < lattice->row[a + 1]; ab++) {
            int of_neighbour = lattice->through[lattice->neighbour[ab]];
            lattice->early += of_neighbour < sweep;
            lattice->late += of_neighbour > sweep + 1;
        }
        lattice->again += lattice->through[a] != sweep;
        lattice->through[a] = sweep + 1;
        int ahead = sweep + 1 - lattice->through[lattice->count - 1];
        lattice->most = ahead > lattice->most ? ahead : lattice->most;
    }
}

static struct solver_wave expect(struct lattice *lattice, int sweeps, int threads)
{
    struct solver_wave wave;
    struct solver_error error;
    struct solver_wave_graph graph = {lattice->row, lattice->neighbour};
    CU_ASSERT_FATAL(solver_wave_create(&wave, lattice->count, PIECE, graph, sweeps, threads, &error));
    omp_set_num_threads(threads);
    for (int time = 0; time < 2; time++) {
        memset(lattice->through, 0, lattice->count * sizeof *lattice->through);
        lattice->most = 0;
        solver_wave_run(&wave, visit, lattice);
        for (size_t a = 0; a < lattice->count; a++) {
            lattice->again += lattice->through[a] != sweeps;
        }
    }
    CU_ASSERT_EQUAL(lattice->early, 0);
    CU_ASSERT_EQUAL(lattice->late, 0);
    CU_ASSERT_EQUAL(lattice->again, 0);
    return wave;
}

static void test_order(void)
{
    static const size_t along[] = {1, 3, 8, 40, 120};
    for (size_t i = 0; i < sizeof along / sizeof *along; i++) {
        for (int disorder = 0; disorder < 2; disorder++) {
            for (int sweeps = 1; sweeps <= 12; sweeps += sweeps < 3 ? 1 : 3) {
                for (int threads = 1; threads <= 5; threads += 2) {
                    struct lattice lattice = make(along[i], disorder == 1);
                    struct solver_wave wave = expect(&lattice, sweeps, threads);
                    solver_wave_free(&wave);
                    release(&lattice);
                }
            }
        }
    }
    omp_set_num_threads(1);
}

/* On a lattice in rows the first particles are through all sweeps when the last have not begun. */
static void test_front(void)
{
    struct lattice lattice = make(200, false);
    struct solver_wave wave = expect(&lattice, 6, 1);
    CU_ASSERT_EQUAL(lattice.most, 6);
    CU_ASSERT_EQUAL(wave.in_round, pieces_of(&lattice) * 6);
    solver_wave_free(&wave);
    release(&lattice);
}

/* Where a neighbour does not list the particle that lists it, all of a sweep is done before the next begins. */
static void test_one_sided(void)
{
    struct lattice lattice = make(40, false);
    for (size_t a = 0; a <= PIECE; a++) { /* a piece lists nobody */
        lattice.row[a] = 0;
    }
    struct solver_wave wave = expect(&lattice, 3, 2);
    CU_ASSERT_EQUAL(wave.in_round, pieces_of(&lattice));
    solver_wave_free(&wave);
    release(&lattice);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"each sweep waits for neighbours", test_order},
        {"a front of sweeps", test_front},
        {"neighbours that do not list one another", test_one_sided},
    };
    return unit_main("solver wave", tests, sizeof tests / sizeof *tests);
}
