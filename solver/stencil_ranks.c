#include "solver/stencil_ranks.h"

#include "solver/memory.h"
#include "solver/stencil.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* A particle that may be in a rank: neighbours at most on either side along each axis, along one of them with the
 * numbers beside its own. */
struct member {
    bool left, right;
    size_t below[2], above[2];
    int axis[3];      /* the one along and those across */
    double weight[3]; /* |C_ab| along them; 0: there are none */
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
        if (away[b > a] != 0 || along <= 0.0 || C[stencil->dim] != along || (ab > first && along != *weight)) {
            return false;
        }
        away[b > a] = b > a ? b - a : a - b;
        *weight = along;
    }
    return true;
}

static bool describe(const struct solver_stencil *stencil, size_t a, struct member *of)
{
    int dim = stencil->dim;
    size_t lanes = dim == 3 ? 4 : (size_t)dim;
    size_t away[3][2] = {{0}};
    double weight[3] = {0.0};
    size_t end = stencil->graph.row[a];
    int along = dim - 1;
    for (int I = 0; I < dim; I++) {
        size_t first = end;
        end += stencil->along[lanes * a + (size_t)I];
        if (!look(stencil, a, I, first, end, away[I], &weight[I])) {
            return false;
        }
        along = away[I][0] == 1 || away[I][1] == 1 ? I : along;
    }
    *of = (struct member){.left = away[along][0] == 1, .right = away[along][1] == 1, .axis = {along}};
    of->weight[0] = weight[along];
    for (int I = 0, across = 0; I < dim; I++) {
        if (I != along) {
            of->below[across] = away[I][0];
            of->above[across++] = away[I][1];
            of->axis[across] = I;
            of->weight[across] = weight[I];
        }
    }
    return away[along][0] <= 1 && away[along][1] <= 1;
}

/* Whether particles that are neighbours across agree on how far that is. */
static bool agrees(const struct solver_stencil *stencil, size_t a, const struct member *of)
{
    struct member other;
    for (int across = 0; across < 2; across++) {
        size_t below = of->below[across];
        size_t above = of->above[across];
        if ((below > 0 && !(describe(stencil, a - below, &other) && other.above[across] == below)) ||
            (above > 0 && !(describe(stencil, a + above, &other) && other.below[across] == above))) {
            return false;
        }
    }
    return true;
}

/* Whether particle a + 1 follows a in its rank. Only the ends of a row have a volume and weights across of their own.
 */
static bool follows(const struct solver_stencil *stencil, size_t a, const struct member *of, const struct member *next)
{
    bool inside = of->left && next->right;
    bool same = of->right && next->left && of->axis[0] == next->axis[0] && of->weight[0] == next->weight[0] &&
                (!inside || stencil->V[a] == stencil->V[a + 1]);
    for (int across = 0; same && across < 2; across++) {
        same = of->below[across] == next->below[across] && of->above[across] == next->above[across] &&
               (!inside || of->weight[1 + across] == next->weight[1 + across]);
    }
    return same;
}

static void weigh(const struct solver_stencil *stencil, struct solver_rank *rank)
{
    size_t at[SOLVER_RANK_KINDS] = {rank->begin, rank->begin + 1, rank->end - 1};
    for (int kind = 0; kind < SOLVER_RANK_KINDS; kind++) {
        struct member of = {.weight = {0}};
        (void)describe(stencil, at[kind], &of);
        for (int I = 0; I < stencil->dim; I++) {
            rank->weight[I][kind] = of.weight[I] / (2.0 * stencil->V[at[kind]]);
        }
    }
}

/* All ranks: how many, and into `rank` unless it is NULL. */
static size_t find_all(const struct solver_stencil *stencil, struct solver_rank *rank)
{
    size_t most = stencil->dim == 2 ? SOLVER_RANK_MOST : SIZE_MAX;
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
        if (end - a < SOLVER_RANK_KINDS || end - a > most) {
            continue;
        }
        if (rank != NULL) {
            rank[found] = (struct solver_rank){.begin = a, .end = end};
            memcpy(rank[found].below, first.below, sizeof first.below);
            memcpy(rank[found].above, first.above, sizeof first.above);
            memcpy(rank[found].axis, first.axis, sizeof first.axis);
            weigh(stencil, &rank[found]);
        }
        found++;
    }
    return found;
}

bool solver_stencil_find_ranks(struct solver_stencil *stencil, struct solver_error *error)
{
    if (stencil->dim < 2 || stencil->along == NULL) {
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
