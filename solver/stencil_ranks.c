#include "solver/stencil_ranks.h"

#include "solver/memory.h"
#include "solver/stencil.h"

#include <stdlib.h>

/* A particle that may be in a rank: neighbours at most on either side along each axis, along one of them with the
 * numbers beside its own. */
struct member {
    int axis;
    bool left, right;
    size_t below, above;
    double weight[2]; /* |C_ab| along the axis and across; 0: there are none */
};

/* Where neighbours along axis I are, those with smaller numbers and those with larger; 0: none. False if there is more
 * than one of a kind, or if weights differ, or are no face measures. */
static bool look(const struct solver_stencil *stencil, size_t a, int I, size_t first, size_t end, size_t away[2],
                 double *weight)
{
    *weight = 0.0;
    away[0] = away[1] = 0;
    for (size_t ab = first; ab < end; ab++) {
        size_t b = stencil->graph.neighbour[ab];
        const double *C = solver_stencil_C(stencil, ab + solver_stencil_shift(stencil, a));
        double along = b > a ? C[I] : -C[I];
        if (away[b > a] != 0 || along <= 0.0 || C[2] != along || (ab > first && along != *weight)) {
            return false;
        }
        away[b > a] = b > a ? b - a : a - b;
        *weight = along;
    }
    return true;
}

static bool describe(const struct solver_stencil *stencil, size_t a, struct member *of)
{
    const size_t *row = stencil->graph.row;
    size_t between = row[a] + stencil->along[2 * a];
    size_t away[2][2];
    double weight[2];
    if (!look(stencil, a, 0, row[a], between, away[0], &weight[0]) ||
        !look(stencil, a, 1, between, row[a + 1], away[1], &weight[1])) {
        return false;
    }
    int axis = away[0][0] == 1 || away[0][1] == 1 ? 0 : 1;
    *of = (struct member){.axis = axis,
                          .left = away[axis][0] == 1,
                          .right = away[axis][1] == 1,
                          .below = away[1 - axis][0],
                          .above = away[1 - axis][1],
                          .weight = {weight[axis], weight[1 - axis]}};
    return away[axis][0] <= 1 && away[axis][1] <= 1;
}

/* Whether particles that are neighbours across agree on how far that is. */
static bool agrees(const struct solver_stencil *stencil, size_t a, const struct member *of)
{
    struct member other;
    return (of->below == 0 || (describe(stencil, a - of->below, &other) && other.above == of->below)) &&
           (of->above == 0 || (describe(stencil, a + of->above, &other) && other.below == of->above));
}

/* Whether particle a + 1 follows a in its rank. Only the ends of a row have a volume and weights across of their own.
 */
static bool follows(const struct solver_stencil *stencil, size_t a, const struct member *of, const struct member *next)
{
    bool inside = of->left && next->right;
    return of->right && next->left && of->axis == next->axis && of->below == next->below && of->above == next->above &&
           of->weight[0] == next->weight[0] &&
           (!inside || (of->weight[1] == next->weight[1] && stencil->V[a] == stencil->V[a + 1]));
}

static void weigh(const struct solver_stencil *stencil, struct solver_rank *rank)
{
    size_t at[SOLVER_RANK_KINDS] = {rank->begin, rank->begin + 1, rank->end - 1};
    for (int kind = 0; kind < SOLVER_RANK_KINDS; kind++) {
        struct member of = {.weight = {0}};
        (void)describe(stencil, at[kind], &of);
        for (int across = 0; across < 2; across++) {
            rank->weight[across][kind] = of.weight[across] / (2.0 * stencil->V[at[kind]]);
        }
    }
}

/* All ranks: how many, and into `rank` unless it is NULL. */
static size_t find_all(const struct solver_stencil *stencil, struct solver_rank *rank)
{
    size_t found = 0;
    size_t end;
    for (size_t a = 0; a < stencil->count; a = end) {
        struct member first;
        struct member of;
        struct member next;
        end = a + 1;
        if (!describe(stencil, a, &first) || !agrees(stencil, a, &first)) {
            continue;
        }
        of = first;
        while (end < stencil->count && describe(stencil, end, &next) && agrees(stencil, end, &next) &&
               follows(stencil, end - 1, &of, &next)) {
            of = next;
            end++;
        }
        if (end - a < SOLVER_RANK_KINDS || end - a > SOLVER_RANK_MOST) {
            continue;
        }
        if (rank != NULL) {
            rank[found] = (struct solver_rank){
                .begin = a, .end = end, .below = first.below, .above = first.above, .axis = first.axis};
            weigh(stencil, &rank[found]);
        }
        found++;
    }
    return found;
}

bool solver_stencil_find_ranks(struct solver_stencil *stencil, struct solver_error *error)
{
    if (stencil->dim != 2 || stencil->along == NULL) {
        return true;
    }
    size_t count = find_all(stencil, NULL);
    if (count == 0) {
        return true;
    }
    if (!solver_alloc((void **)&stencil->rank, count, sizeof *stencil->rank, "ranks", error)) {
        return false;
    }
    stencil->rank_count = find_all(stencil, stencil->rank);
    return true;
}
