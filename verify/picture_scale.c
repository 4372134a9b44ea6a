/* The colour scale of a picture where the scene leaves it open. */
#include "verify/picture.h"

#include <math.h>

enum { USUAL = 12, FEWEST = 8, MOST = 16 };

/* A field that varies by less than this share of its size is constant: what is left is round-off. */
static const double NOISE = 1e-6;

/* Off a whole number by no more than round-off leaves. */
static bool whole(double x)
{
    return fabs(x - nearbyint(x)) < 1e-6;
}

/* The smallest of 1, 2, 2.5 and 5 times a power of ten that is not below x. */
static double round_up(double x)
{
    static const double steps[] = {1, 2, 2.5, 5, 10};
    const double ten = pow(10, floor(log10(x)));
    int i = 0;
    while (i < 4 && steps[i] * ten < x * (1 - 1e-9)) {
        i++;
    }
    return steps[i] * ten;
}

/* As many bands that their boundaries are round numbers, near the usual number of them. */
static int bands_of(const double range[2])
{
    for (int off = 0; off <= MOST - USUAL; off++) {
        for (int side = -1; side <= 1; side += 2) {
            const double step = (range[1] - range[0]) / (USUAL + side * off);
            if (whole(round_up(step) / step) && round_up(step) < 1.5 * step && whole(range[0] / step)) {
                return USUAL + side * off;
            }
        }
    }
    return USUAL;
}

/* Whether so many steps from a whole one reach from one number to the other. */
static bool covers(double lower, double upper, double step, int most)
{
    return ceil(upper / step - NOISE) - floor(lower / step + NOISE) <= most;
}

void verify_picture_scale(const double seen[2], double range[2], int *bands)
{
    if (range[0] < range[1]) {
        *bands = *bands > 0 ? *bands : bands_of(range);
        return;
    }
    double lower = seen[0], upper = seen[1];
    const double size = fmax(fabs(lower), fabs(upper));
    if (!(size < 1e307)) { /* more than a picture takes */
        range[0] = lower;
        range[1] = upper;
        *bands = *bands > 0 ? *bands : USUAL;
        return;
    }
    if (!(upper - lower > NOISE * size)) {
        const double half = size > 0 ? 0.5 * size : 0.5;
        lower -= half;
        upper += half;
    }
    const int most = *bands > 0 ? *bands : MOST;
    double step = round_up((upper - lower) / most);
    while (!covers(lower, upper, step, most)) {
        step = round_up(1.01 * step);
    }
    const double from = floor(lower / step + NOISE);
    *bands = *bands > 0 ? *bands : (int)(ceil(upper / step - NOISE) - from);
    range[0] = from * step;
    range[1] = (from + *bands) * step;
}
