/* Whether particles are whole: v, F and J are finite, also when squared, and nothing is turned inside out. That nearly
 * always all of them are is found out fast, by sums of squares over all numbers of a range; which particle it is that
 * is not, one by one. */
#ifndef SOLVER_DIM_WHOLE_H
#define SOLVER_DIM_WHOLE_H

#include "solver/dim_lots.h"
#include "solver/upwind.h"

#include <float.h>

/* What overflows squares also overflows their sum. That of many numbers may overflow where no particle's own does, and
 * is asked again then. */
static inline bool finite_squares(const double *numbers, size_t count)
{
    lot sum[2] = {{0}};
    double rest = 0.0;
    size_t i = 0;
    for (; i + 2 * LOT <= count; i += 2 * LOT) {
        for (size_t k = 0; k < 2; k++) {
            lot a = load_lot(numbers + i + k * LOT);
            sum[k] += a * a;
        }
    }
    for (; i < count; i++) {
        rest += numbers[i] * numbers[i];
    }
    bool finite = isfinite(rest);
    for (size_t k = 0; k < LOT; k++) {
        finite = finite && isfinite(sum[0][k]) && isfinite(sum[1][k]);
    }
    return finite;
}

static inline bool all_positive(const double *J, size_t count)
{
    bool all = true;
    for (size_t a = 0; a < count; a++) {
        all = all && J[a] > 0.0;
    }
    return all;
}

/* Whether 0 < det F < infinity. */
static inline bool all_upright(const double *F, size_t count)
{
    lot_mask all = (lot){0} == 0.0;
    bool rest = true;
    size_t a = 0;
    for (; a + LOT <= count; a += LOT) {
        struct tensors at = load_tensors(F + a * DIM * LANES);
        lot J = determinants(&at);
        all &= (J > 0.0) & (J <= DBL_MAX);
    }
    for (; a < count; a++) {
        double J = determinant(load_tensor(F + a * DIM * LANES));
        rest = rest && J > 0.0 && J <= DBL_MAX;
    }
    for (size_t k = 0; k < LOT; k++) {
        rest = rest && all[k] != 0;
    }
    return rest;
}

static inline bool evolves_measured_J(const struct solver_upwind *work)
{
    return work->J != NULL && !work->constrained;
}

static inline bool all_whole(const struct solver_upwind *work, size_t begin, size_t end)
{
    size_t count = end - begin;
    const double *F = work->F + begin * DIM * LANES;
    bool whole = finite_squares(work->v + begin * LANES, count * LANES) && finite_squares(F, count * DIM * LANES);
    if (evolves_measured_J(work)) {
        const double *J = work->J + begin;
        return whole && finite_squares(J, count) && (work->frozen || all_positive(J, count));
    }
    return whole && (work->frozen || all_upright(F, count));
}

static inline bool is_whole(const struct solver_upwind *work, size_t a)
{
    vec v = load(work->v + a * LANES);
    struct tensor F = load_tensor(work->F + a * DIM * LANES);
    vec squares = v * v;
    for (int I = 0; I < DIM; I++) {
        squares += F.column[I] * F.column[I];
    }
    double J = evolves_measured_J(work) ? work->J[a] : work->frozen ? 1.0 : determinant(F);
    return (work->frozen || J > 0.0) && isfinite(J) && isfinite(sum_of(squares));
}

static size_t first_broken(const struct solver_upwind *work, size_t begin, size_t end)
{
    size_t a = all_whole(work, begin, end) ? end : begin;
    while (a < end && is_whole(work, a)) {
        a++;
    }
    return a;
}

#endif
