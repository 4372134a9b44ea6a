#include "verify/grid_convergence.h"

#include "verify/study.h"

#include <float.h>
#include <math.h>

static const double safety = 1.25;      /* of three levels and more (Roache 1994, section 3) */
static const double settled = 0.1;      /* share of itself by which an order that has settled may still change */
static const double largest_order = 32; /* beyond it nothing but round-off is left to see */

static const struct {
    const char *word, *meaning;
} texts[VERIFY_CONVERGENCES] = {
    [VERIFY_TOO_FEW] = {"too few", "fewer than three levels"},
    [VERIFY_UNMEASURED] = {"unmeasured", "a level has no value"},
    [VERIFY_EQUAL] = {"equal", "the finest two are the same to round-off: no order to be seen"},
    [VERIFY_OSCILLATING] = {"oscillating", "oscillating: not in the asymptotic range"},
    [VERIFY_DIVERGING] = {"diverging", "moving apart: not in the asymptotic range"},
    [VERIFY_UNSETTLED] = {"unsettled", "order or index still changes: not yet in the asymptotic range"},
    [VERIFY_ONE_ORDER] = {"one order", "closing in; with a fourth level one would see whether the order has settled"},
    [VERIFY_ASYMPTOTIC] = {"asymptotic", "the order has settled"},
};

const char *verify_convergence_meaning(enum verify_convergence state)
{
    return texts[state].meaning;
}

const char *verify_convergence_word(enum verify_convergence state)
{
    return texts[state].word;
}

/* ln of what e32 / e21 is for an order p; increases with p. */
static double ratio_of_order(double p, double r21, double r32)
{
    return p * log(r21) + log(expm1(p * log(r32)) / expm1(p * log(r21)));
}

/* The order of three values, finest last; NaN if they oscillate or do not close in. */
static double order_of(const double *h, const double *f)
{
    double e21 = f[1] - f[2], e32 = f[0] - f[1], r21 = h[1] / h[2], r32 = h[0] / h[1];
    if (e21 == 0 || !(r21 > 1 && r32 > 1) || !(e32 / e21 > log(r32) / log(r21))) {
        return NAN;
    }
    double wanted = log(e32 / e21), low = 0, high = largest_order;
    if (!(wanted < ratio_of_order(high, r21, r32))) {
        return NAN;
    }
    while (high - low > 1e-13 * high) {
        double middle = 0.5 * (low + high);
        if (ratio_of_order(middle, r21, r32) < wanted) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

/* What three values do, before their order is looked at. */
static enum verify_convergence way_of(const double *h, const double *f)
{
    double e21 = f[1] - f[2], e32 = f[0] - f[1];
    if (!isfinite(f[0]) || !isfinite(f[1]) || !isfinite(f[2])) {
        return VERIFY_UNMEASURED;
    }
    if (fabs(e21) <= 4 * DBL_EPSILON * fmax(fabs(f[1]), fabs(f[2]))) {
        return VERIFY_EQUAL;
    }
    return e32 / e21 < 0 ? VERIFY_OSCILLATING : isnan(order_of(h, f)) ? VERIFY_DIVERGING : VERIFY_ONE_ORDER;
}

/* No number is near to nothing. */
static bool near(double one, double other)
{
    return islessequal(fabs(one - other), settled * fabs(other));
}

struct verify_extrapolation verify_extrapolate(size_t count, const double *h, const double *value)
{
    struct verify_extrapolation out = {VERIFY_TOO_FEW, NAN, NAN, NAN, NAN, NAN};
    if (count < 3) {
        return out;
    }
    const double *f = value + count - 3, *s = h + count - 3;
    out.state = way_of(s, f);
    if (out.state != VERIFY_ONE_ORDER) {
        return out;
    }
    double grown = pow(s[1] / s[2], out.order = order_of(s, f)), before = pow(s[0] / s[1], out.order);
    out.limit = f[2] + (f[2] - f[1]) / (grown - 1);
    out.uncertainty = safety * fabs(f[2] - f[1]) / (grown - 1);
    out.index = f[2] != 0 ? out.uncertainty / fabs(f[2]) : NAN;
    out.ratio = f[1] != 0 ? safety * fabs((f[1] - f[0]) / f[1]) / (before - 1) / (grown * out.index) : NAN;
    bool fits = !isnan(out.ratio) && near(out.ratio, 1);
    bool second = count > 3 && way_of(s - 1, f - 1) != VERIFY_UNMEASURED;
    bool same = second && near(order_of(s - 1, f - 1), out.order);
    out.state = !fits || (second && !same) ? VERIFY_UNSETTLED : second ? VERIFY_ASYMPTOTIC : VERIFY_ONE_ORDER;
    return out;
}

enum verify_convergence verify_error_convergence(size_t count, const double *h, const double *error, double order[2])
{
    order[0] = order[1] = NAN;
    if (count < 3) {
        return VERIFY_TOO_FEW;
    }
    const double *e = error + count - 3, *s = h + count - 3;
    order[0] = verify_order(e[0], s[0], e[1], s[1]);
    order[1] = verify_order(e[1], s[1], e[2], s[2]);
    if (!isfinite(order[0]) || !isfinite(order[1])) {
        return VERIFY_UNMEASURED;
    }
    return order[1] <= 0              ? (order[0] > 0 ? VERIFY_OSCILLATING : VERIFY_DIVERGING)
           : order[0] <= 0            ? VERIFY_OSCILLATING
           : near(order[0], order[1]) ? VERIFY_ASYMPTOTIC
                                      : VERIFY_UNSETTLED;
}
