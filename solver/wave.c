#include "solver/wave.h"

#include "solver/memory.h"
#include "solver/pieces.h"

#include <stdlib.h>

static size_t pieces_of(const struct solver_wave *wave)
{
    return wave->count > 0 ? (wave->count - 1) / wave->piece + 1 : 0;
}

static struct solver_piece piece_at(const struct solver_wave *wave, size_t piece)
{
    size_t begin = piece * wave->piece;
    return (struct solver_piece){begin, begin + wave->piece < wave->count ? begin + wave->piece : wave->count};
}

/* What is needed to find the order. */
struct plan {
    size_t pieces;
    size_t *row;       /* [pieces + 1] */
    uint32_t *beside;  /* [row[pieces]] pieces with neighbours of a piece's particles */
    int *done;         /* [pieces] sweeps that it is through */
    size_t begin, end; /* of the chunk */
    uint32_t *list;    /* [pieces * sweeps] that have followed one that began, sweep after sweep */
    size_t listed;
    struct solver_wave *wave;
    size_t tasks;
};

static void free_plan(struct plan *plan)
{
    free(plan->row);
    free(plan->beside);
    free(plan->done);
    free(plan->list);
}

/* Other pieces with neighbours of the piece's particles, each once: how many, and into `beside` unless it is NULL.
 * mark[q] is the last piece, plus one, that has found q. */
static size_t find_beside(const struct solver_wave *wave, struct solver_wave_graph graph, size_t piece, size_t *mark,
                          uint32_t *beside)
{
    struct solver_piece at = piece_at(wave, piece);
    size_t found = 0;
    for (size_t ab = graph.row[at.begin]; ab < graph.row[at.end]; ab++) {
        size_t other = graph.neighbour[ab] / wave->piece;
        if (other == piece || mark[other] == piece + 1) {
            continue;
        }
        mark[other] = piece + 1;
        if (beside != NULL) {
            beside[found] = (uint32_t)other;
        }
        found++;
    }
    return found;
}

static bool list_beside(struct plan *plan, struct solver_wave_graph graph, struct solver_error *error)
{
    size_t *mark = NULL;
    size_t pieces = plan->pieces;
    bool ok = solver_alloc((void **)&plan->row, pieces + 1, sizeof *plan->row, "order of sweeps", error) &&
              solver_alloc((void **)&mark, 2 * pieces, sizeof *mark, "order of sweeps", error);
    for (size_t piece = 0; ok && piece < pieces && graph.row != NULL; piece++) {
        plan->row[piece + 1] = plan->row[piece] + find_beside(plan->wave, graph, piece, mark, NULL);
    }
    ok = ok && solver_alloc((void **)&plan->beside, plan->row[pieces], sizeof *plan->beside, "order of sweeps", error);
    for (size_t piece = 0; ok && piece < pieces && graph.row != NULL; piece++) {
        (void)find_beside(plan->wave, graph, piece, mark + pieces, plan->beside + plan->row[piece]);
    }
    free(mark);
    return ok;
}

static bool lists(const struct plan *plan, size_t piece, size_t other)
{
    for (size_t i = plan->row[piece]; i < plan->row[piece + 1]; i++) {
        if (plan->beside[i] == other) {
            return true;
        }
    }
    return false;
}

static bool symmetric(const struct plan *plan)
{
    for (size_t piece = 0; piece < plan->pieces; piece++) {
        for (size_t i = plan->row[piece]; i < plan->row[piece + 1]; i++) {
            if (!lists(plan, plan->beside[i], piece)) {
                return false;
            }
        }
    }
    return true;
}

/* Whether the piece, and all beside it, are of the chunk and through that many sweeps, itself no more. */
static bool may_go(const struct plan *plan, size_t piece, int sweeps)
{
    bool may = plan->done[piece] == sweeps && piece >= plan->begin && piece < plan->end;
    for (size_t i = plan->row[piece]; may && i < plan->row[piece + 1]; i++) {
        size_t other = plan->beside[i];
        may = other >= plan->begin && other < plan->end && plan->done[other] >= sweeps;
    }
    return may;
}

static void go(struct plan *plan, size_t piece, int sweep)
{
    plan->wave->task[plan->tasks++] = (uint32_t)piece * (uint32_t)plan->wave->sweeps + (uint32_t)sweep;
}

static int compare(const void *a, const void *b)
{
    uint32_t of_a = *(const uint32_t *)a;
    uint32_t of_b = *(const uint32_t *)b;
    return of_a < of_b ? -1 : of_a > of_b;
}

/* Lists the piece behind the others if its next sweep, that one, may go now. */
static void try(struct plan *plan, size_t piece, int sweep)
{
    if (may_go(plan, piece, sweep)) {
        plan->done[piece]++;
        plan->list[plan->listed++] = (uint32_t)piece;
    }
}

/* Sweeps of a piece, and of what has waited for it. Within a sweep pieces go in order, so that memory is read in long
 * runs. Pieces that began several at a time would leave the cache before the next sweep. */
static void begin_piece(struct plan *plan, size_t begins, int sweeps)
{
    size_t from = 0; /* of the list: those that the last sweep took */
    plan->listed = 0;
    go(plan, begins, plan->done[begins]++);
    plan->list[plan->listed++] = (uint32_t)begins;
    for (int sweep = 1; sweep < sweeps; sweep++) {
        size_t to = plan->listed;
        for (size_t i = from; i < to; i++) {
            size_t piece = plan->list[i];
            try(plan, piece, sweep);
            for (size_t j = plan->row[piece]; j < plan->row[piece + 1]; j++) {
                try(plan, plan->beside[j], sweep);
            }
        }
        qsort(plan->list + to, plan->listed - to, sizeof *plan->list, compare);
        for (size_t i = to; i < plan->listed; i++) {
            go(plan, plan->list[i], sweep);
        }
        from = to;
    }
}

/* The rounds of a chunk, which begins at `first`. `together`: sweeps may follow one another in the first. */
static void order_chunk(struct plan *plan, size_t *first, bool together)
{
    struct solver_wave *wave = plan->wave;
    first[0] = plan->tasks;
    for (size_t piece = plan->begin; piece < plan->end; piece++) {
        begin_piece(plan, piece, together ? wave->sweeps : 1);
    }
    wave->in_round += plan->tasks - first[0];
    for (int sweep = 1; sweep < wave->sweeps; sweep++) {
        first[sweep] = plan->tasks;
        for (size_t piece = plan->begin; piece < plan->end; piece++) {
            if (plan->done[piece] <= sweep) {
                go(plan, piece, sweep);
            }
        }
    }
}

bool solver_wave_create(struct solver_wave *wave, size_t count, size_t piece, struct solver_wave_graph graph,
                        int sweeps, int threads, struct solver_error *error)
{
    size_t of_sweeps = (size_t)sweeps;
    *wave = (struct solver_wave){.sweeps = sweeps, .chunks = threads, .count = count, .piece = piece};
    struct plan plan = {.pieces = pieces_of(wave), .wave = wave};
    bool ok =
        solver_alloc((void **)&wave->task, plan.pieces * of_sweeps, sizeof *wave->task, "order of sweeps", error) &&
        solver_alloc((void **)&wave->first, (size_t)threads * of_sweeps + 1, sizeof *wave->first, "order of sweeps",
                     error) &&
        solver_alloc((void **)&plan.list, plan.pieces * of_sweeps, sizeof *plan.list, "order of sweeps", error) &&
        solver_alloc((void **)&plan.done, plan.pieces, sizeof *plan.done, "order of sweeps", error) &&
        list_beside(&plan, graph, error);
    bool together = ok && symmetric(&plan);
    for (size_t chunk = 0; ok && chunk < (size_t)threads; chunk++) {
        plan.begin = plan.pieces * chunk / (size_t)threads;
        plan.end = plan.pieces * (chunk + 1) / (size_t)threads;
        order_chunk(&plan, wave->first + chunk * of_sweeps, together);
    }
    if (ok) {
        wave->first[(size_t)threads * of_sweeps] = plan.tasks;
    }
    free_plan(&plan);
    return ok;
}

void solver_wave_free(struct solver_wave *wave)
{
    free(wave->task);
    free(wave->first);
    *wave = (struct solver_wave){.sweeps = 0};
}

void solver_wave_arrays(const struct solver_wave *wave, struct solver_cost_arrays *arrays)
{
    size_t sweeps = (size_t)wave->sweeps;
    solver_cost_array(arrays, "run", "order of sweeps", wave->task, pieces_of(wave) * sweeps, sizeof *wave->task);
    solver_cost_array(arrays, "run", "rounds of sweeps", wave->first, (size_t)wave->chunks * sweeps + 1,
                      sizeof *wave->first);
}

void solver_wave_run(const struct solver_wave *wave, solver_wave_sweep *sweep, void *context)
{
    uint32_t sweeps = (uint32_t)wave->sweeps;
    size_t tasks = pieces_of(wave) * sweeps;
    int rounds = wave->in_round < tasks ? wave->sweeps : 1;
#pragma omp parallel
    for (int round = 0; round < rounds; round++) {
#pragma omp for schedule(static)
        for (size_t chunk = 0; chunk < (size_t)wave->chunks; chunk++) {
            const size_t *first = wave->first + chunk * sweeps + (size_t)round;
            for (size_t i = first[0]; i < first[1]; i++) {
                struct solver_piece at = piece_at(wave, wave->task[i] / sweeps);
                sweep(context, (int)(wave->task[i] % sweeps), at.begin, at.end);
            }
        }
    }
}
