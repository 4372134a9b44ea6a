#include "solver/stencil_ranks.h"

#include "solver/cloud.h"
#include "solver/memory.h"
#include "solver/stencil.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

/* A particle that may be in a rank: neighbours at most on either side along each axis, along one of them with the
 * numbers beside its own. */
struct member {
    int axis;
    size_t away[3][2]; /* how far those along each axis are, in particles, back and ahead; 0: there are none */
    double weight[3];  /* |C_ab|; 0: there are none */
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
    size_t lanes = stencil->dim == 3 ? 4 : (size_t)stencil->dim;
    size_t end = stencil->graph.row[a];
    *of = (struct member){.axis = stencil->dim - 1};
    for (int I = 0; I < stencil->dim; I++) {
        size_t first = end;
        end += stencil->along[lanes * a + (size_t)I];
        if (!look(stencil, a, I, first, end, of->away[I], &of->weight[I])) {
            return false;
        }
        of->axis = of->away[I][0] == 1 || of->away[I][1] == 1 ? I : of->axis;
    }
    return of->away[of->axis][0] <= 1 && of->away[of->axis][1] <= 1;
}

static bool lists(const struct solver_stencil *stencil, size_t b, size_t a)
{
    for (size_t k = stencil->graph.row[b]; k < stencil->graph.row[b + 1]; k++) {
        if (stencil->graph.neighbour[k] == a) {
            return true;
        }
    }
    return false;
}

/* Whether particles that are neighbours across agree on that. */
static bool agrees(const struct solver_stencil *stencil, size_t a, const struct member *of)
{
    for (int I = 0; I < stencil->dim; I++) {
        size_t back = of->away[I][0];
        size_t ahead = of->away[I][1];
        if (I != of->axis &&
            ((back > 0 && !lists(stencil, a - back, a)) || (ahead > 0 && !lists(stencil, a + ahead, a)))) {
            return false;
        }
    }
    return true;
}

/* Whether particle a + 1 follows a in its rank. Only the ends of a row have a volume and weights across of their own.
 */
static bool follows(const struct solver_stencil *stencil, size_t a, const struct member *of, const struct member *next)
{
    bool inside = of->away[of->axis][0] == 1 && next->away[next->axis][1] == 1;
    bool same = of->axis == next->axis && of->away[of->axis][1] == 1 && next->away[next->axis][0] == 1 &&
                of->weight[of->axis] == next->weight[of->axis] && (!inside || stencil->V[a] == stencil->V[a + 1]);
    for (int I = 0; same && I < stencil->dim; I++) {
        same = I == of->axis || (of->away[I][0] == next->away[I][0] && of->away[I][1] == next->away[I][1] &&
                                 (!inside || of->weight[I] == next->weight[I]));
    }
    return same;
}

/* What a rank's second particle is, which has neighbours on either side, and the weights of those at its ends. */
static void settle(const struct solver_stencil *stencil, struct solver_rank *rank)
{
    size_t at[SOLVER_RANK_KINDS] = {rank->begin, rank->begin + 1, rank->end - 1};
    for (int kind = 0; kind < SOLVER_RANK_KINDS; kind++) {
        struct member of;
        (void)describe(stencil, at[kind], &of);
        for (int I = 0; I < stencil->dim; I++) {
            rank->weight[I][kind] = of.weight[I] / (2.0 * stencil->V[at[kind]]);
            rank->back[I] = kind == SOLVER_RANK_INSIDE ? of.away[I][0] : rank->back[I];
            rank->ahead[I] = kind == SOLVER_RANK_INSIDE ? of.away[I][1] : rank->ahead[I];
        }
        rank->axis = of.axis;
    }
}

/* Half the distances along axis I of the neighbours of a. */
static void measure(const struct solver_cloud *cloud, const struct solver_rank *rank, size_t a, int I, double half[2])
{
    size_t dim = (size_t)cloud->dim;
    const double *X = cloud->X + (size_t)I;
    half[0] = 0.5 * (X[a * dim] - X[(a - rank->back[I]) * dim]);
    half[1] = 0.5 * (X[(a + rank->ahead[I]) * dim] - X[a * dim]);
}

/* What positions are rounded by, and differences of two distances of them, at most. */
static double round_off(const struct solver_cloud *cloud)
{
    double most = 0.0;
    for (size_t i = 0; i < cloud->count * (size_t)cloud->dim; i++) {
        most = fmax(most, fabs(cloud->X[i]));
    }
    return 4.0 * DBL_EPSILON * most;
}

/* Sets distances of a rank; false if they differ by more than round-off. */
static bool is_even(const struct solver_cloud *cloud, double tolerance, struct solver_rank *rank)
{
    for (int I = 0; I < cloud->dim; I++) {
        size_t end = I == rank->axis; /* particles of an end that lack a neighbour */
        measure(cloud, rank, rank->begin + 1, I, rank->half[I]);
        for (size_t a = rank->begin + end; a < rank->end - end; a++) {
            double half[2];
            measure(cloud, rank, a, I, half);
            if (fabs(half[0] - rank->half[I][0]) > tolerance || fabs(half[1] - rank->half[I][1]) > tolerance) {
                return false;
            }
        }
    }
    return true;
}

/* All ranks: how many, and into `rank` unless it is NULL. */
static size_t find_all(const struct solver_stencil *stencil, const struct solver_cloud *cloud, struct solver_rank *rank)
{
    double tolerance = round_off(cloud);
    size_t most = stencil->dim == 2 ? SOLVER_RANK_MOST : SIZE_MAX;
    size_t found = 0;
    size_t end;
    for (size_t a = 0; a < stencil->count; a = end) {
        struct member first;
        struct member last;
        struct member next;
        end = a + 1;
        if (!describe(stencil, a, &first) || !agrees(stencil, a, &first)) {
            continue;
        }
        last = first;
        while (end < stencil->count && describe(stencil, end, &next) && agrees(stencil, end, &next) &&
               follows(stencil, end - 1, &last, &next)) {
            last = next;
            end++;
        }
        if (end - a < SOLVER_RANK_KINDS || end - a > most) {
            continue;
        }
        struct solver_rank of = {.begin = a, .end = end};
        settle(stencil, &of);
        if (!is_even(cloud, tolerance, &of)) {
            continue;
        }
        if (rank != NULL) {
            rank[found] = of;
        }
        found++;
    }
    return found;
}

bool solver_stencil_find_ranks(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                               struct solver_error *error)
{
    if (stencil->dim < 2 || stencil->along == NULL) {
        return true;
    }
    size_t count = find_all(stencil, cloud, NULL);
    if (count == 0) {
        return true;
    }
    if (!solver_alloc((void **)&stencil->rank, count, sizeof *stencil->rank, "ranks", error)) {
        return false;
    }
    stencil->rank_count = find_all(stencil, cloud, stencil->rank);
    return true;
}
