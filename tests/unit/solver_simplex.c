/* Simplices cut by linear functions: measures by independent formulas, and the divergence theorem piece by piece. */
#include "solver/simplex.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <string.h>

static double measure_of(const struct simplices *list)
{
    double sum = 0.0, centroid[3];
    for (size_t s = 0; s < list->count; s++) {
        sum += simplex_measure(list->size, list->corner[s], centroid);
    }
    return sum;
}

static void random_simplex(uint64_t *seed, size_t size, double corner[4][3], double value[4])
{
    for (size_t c = 0; c < 4; c++) {
        for (int i = 0; i < 3; i++) {
            bool flat = size < 4 && i == 2;
            corner[c][i] = flat ? 0.0 : clouds_random(seed);
        }
        value[c] = clouds_random(seed);
    }
}

/* Part of a simplex's measure where the function is negative: of one corner, the product of its edges' shares. */
static double share(size_t size, const double value[4])
{
    int negative = 0;
    for (size_t c = 0; c < size; c++) {
        negative += value[c] < 0.0;
    }
    for (size_t c = 0; c < size; c++) {
        double product = 1.0;
        for (size_t other = 0; other < size; other++) {
            product *= other == c ? 1.0 : value[c] / (value[c] - value[other]);
        }
        if (negative == 1 && value[c] < 0.0) {
            return product;
        }
        if (negative == (int)size - 1 && value[c] >= 0.0) {
            return 1.0 - product;
        }
    }
    return negative == 0 ? 0.0 : negative == (int)size ? 1.0 : NAN; /* two and two: no such formula */
}

/* Inside and outside are the whole; what a formula knows agrees with it; the centroid is that of the whole. */
static void measures(void)
{
    uint64_t seed = 1;
    size_t known = 0;
    for (size_t size = 2; size <= 4; size++) {
        for (int k = 0; k < 200; k++) {
            double corner[4][3], value[4], opposite[4], centroid[3];
            struct simplices inside, outside, cut, other;
            random_simplex(&seed, size, corner, value);
            for (int c = 0; c < 4; c++) {
                opposite[c] = -value[c];
            }
            simplex_cut(size, (const double(*)[3])corner, value, &inside, &cut);
            simplex_cut(size, (const double(*)[3])corner, opposite, &outside, &other);
            double whole = simplex_measure(size, (const double(*)[3])corner, centroid);
            double expected = share(size, value);
            CU_ASSERT_DOUBLE_EQUAL(measure_of(&inside) + measure_of(&outside), whole, 1e-14);
            known += isfinite(expected) ? 1 : 0;
            CU_ASSERT(isnan(expected) || fabs(measure_of(&inside) - expected * whole) < 1e-14);
            if (size > 2) {
                CU_ASSERT_DOUBLE_EQUAL(measure_of(&cut), measure_of(&other), 1e-14);
            }
        }
    }
    CU_ASSERT(known > 450);
}

/* The function is zero on the cut, and its area vector closes the open surface of the part inside. */
static void closure(void)
{
    static const int side[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
    uint64_t seed = 7;
    for (size_t size = 3; size <= 4; size++) {
        for (int k = 0; k < 200; k++) {
            double corner[4][3], value[4], sum[3] = {0}, middle[3];
            struct simplices inside, cut;
            random_simplex(&seed, size, corner, value);
            (void)simplex_measure(size, (const double(*)[3])corner, middle);
            simplex_cut(size, (const double(*)[3])corner, value, &inside, &cut);
            double out[3]; /* from inside to outside */
            size_t low = 0, high = 0;
            for (size_t c = 1; c < size; c++) {
                low = value[c] < value[low] ? c : low;
                high = value[c] > value[high] ? c : high;
            }
            for (int i = 0; i < 3; i++) {
                out[i] = corner[high][i] - corner[low][i];
            }
            for (size_t s = 0; s < cut.count; s++) {
                double area[3];
                simplex_area(cut.size, (const double(*)[3])cut.corner[s], out, area);
                CU_ASSERT(area[0] * out[0] + area[1] * out[1] + area[2] * out[2] >= 0.0);
                for (int i = 0; i < 3; i++) {
                    sum[i] += area[i];
                }
            }
            for (size_t f = 0; f < size; f++) { /* the open sides */
                double of_side[4][3] = {{0}}, side_value[4] = {0}, outward[3];
                struct simplices open, edge;
                for (size_t c = 0; c + 1 < size; c++) {
                    size_t from = size == 4 ? (size_t)side[f][c] : (f + 1 + c) % 3;
                    memcpy(of_side[c], corner[from], sizeof of_side[c]);
                    side_value[c] = value[from];
                }
                for (int i = 0; i < 3; i++) {
                    outward[i] = middle[i] - corner[f][i];
                }
                simplex_cut(size - 1, (const double(*)[3])of_side, side_value, &open, &edge);
                for (size_t s = 0; s < open.count; s++) {
                    double area[3];
                    simplex_area(open.size, (const double(*)[3])open.corner[s], outward, area);
                    for (int i = 0; i < 3; i++) {
                        sum[i] += area[i];
                    }
                }
            }
            CU_ASSERT(fabs(sum[0]) < 1e-14 && fabs(sum[1]) < 1e-14 && fabs(sum[2]) < 1e-14);
        }
    }
}

/* Corners on which the function is zero make no pieces that are not numbers. */
static void degenerate(void)
{
    static const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 81; k++) {
        const int sign[4] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 % 3 - 1, k / 27 - 1};
        const double value[4] = {sign[0], sign[1], sign[2], sign[3]};
        struct simplices inside, cut;
        simplex_cut(4, corner, value, &inside, &cut);
        CU_ASSERT(measure_of(&inside) >= 0.0 && measure_of(&inside) <= 1.0 / 6.0 + 1e-15);
        CU_ASSERT(inside.count <= 3 && cut.count <= 2 && isfinite(measure_of(&cut)));
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"measures", measures},
        {"closure", closure},
        {"corners on the cut", degenerate},
    };
    return unit_main("solver simplices", tests, sizeof tests / sizeof *tests);
}
