/* Euler's top without torque: a rigid box that tumbles freely about its centre (L. D. Landau, E. M. Lifshitz,
 * Mechanics, section 37), x = R(t) X. An elastic body moves so to within strains of rho spin^2 side^2 / E.
 *
 * Among the axes i, j, k let j have the middle moment of inertia and k be the one that the angular velocity circles
 * about in the body: the one of the largest moment if L^2 > 2 T I_j, else that of the smallest. With tau = tau_0 + s t,
 *
 *     w_i = a_i cn tau,   w_j = a_j sn tau,   w_k = a_k dn tau,
 *     m = |I_j - I_i| |2 T I_k - L^2| / (|I_k - I_j| |L^2 - 2 T I_i|)
 *
 * The angular momentum L stands still in space. The plane that holds it and e_i turns about it by
 *
 *     phi = L t / I_i + L (2 T I_i - L^2) / I_i  int_0^t dt / (L^2 - I_i^2 w_i^2),
 *
 * an elliptic integral of the third kind without a singularity. Both together are R. All moments are per mass. */
#include "oracles/free_top.h"
#include "oracles/kind.h"

#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <stdio.h>

static const double LONGER = 1.2;   /* a side over the next: moments of inertia as near one another lose digits */
static const double NEAREST = 1e-3; /* to the separatrix */
/* The longest side over the middle and the shortest: of a needle the spin about its own axis is so fast in a period of
 * the others that there are no digits left, and less to prove; of a sheet F has those of a place on its edge. */
static const double NEEDLE = 30, SHEET = 3000;

struct oracle {
    struct free_top_given given;
    double I[3];          /* moments of inertia over mass [m^2] */
    int i, j, k;          /* axes, as above */
    double L, twice_T;    /* over mass [m^2/s], [m^2/s^2] */
    double a[3];          /* amplitudes of the angular velocity [rad/s]; that of k with its sign */
    double m, rest;       /* and 1 - m */
    double rate;          /* d tau/dt [1/s] */
    double quarter, tau0; /* K(m), and tau at t = 0 */
    double n, lead;       /* parameter of the integral Pi(n), and its factor [-] */
    double whole, turn;   /* Pi(n) of a quarter, and at t = 0 */
    double start[3][3];   /* the frame at t = 0: see frame_at */
};

static const struct oracle_parameter parameters[] = {
    {"A", "m", "longest side, along X, at most 30 B and 3000 C", 0, INFINITY, true, false, 3},
    {"B", "m", "middle side, along Y, at most A / 1.2", 0, INFINITY, true, false, 2},
    {"C", "m", "shortest side, along Z, at most B / 1.2", 0, INFINITY, true, false, 1},
    {"spin_x", "rad/s", "angular velocity at t = 0", -INFINITY, INFINITY, false, false, 0.1},
    {"spin_y", "rad/s", "angular velocity at t = 0", -INFINITY, INFINITY, false, false, 1},
    {"spin_z", "rad/s", "angular velocity at t = 0", -INFINITY, INFINITY, false, false, 0.2},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 1000},
    {0},
};

const struct free_top_given *free_top_given(const struct oracle *oracle)
{
    return &oracle->given;
}

double free_top_period(const struct oracle *oracle)
{
    return 4 * oracle->quarter / fabs(oracle->rate);
}

double free_top_distance(const struct oracle *oracle)
{
    return oracle->rest;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++) {
        int next = (i + 1) % 3, last = (i + 2) % 3;
        c[i] = a[next] * b[last] - a[last] * b[next];
    }
}

static void normalise(double a[3])
{
    double size = hypot(hypot(a[0], a[1]), a[2]);
    for (int i = 0; i < 3; i++) {
        a[i] /= size;
    }
}

/* F and Pi of an amplitude within a quarter of a turn, given by sine and cosine: Carlson's forms, which lose nothing
 * near its end, as Legendre's do that take the amplitude itself. */
static double first(const struct oracle *o, double sn, double cn)
{
    return sn * gsl_sf_ellint_RF(cn * cn, cn * cn + o->rest * sn * sn, 1, GSL_PREC_DOUBLE);
}

static double third(const struct oracle *o, double sn, double cn)
{
    double square = sn * sn, x = cn * cn, y = x + o->rest * square;
    return first(o, sn, cn) - o->n / 3 * square * sn * gsl_sf_ellint_RJ(x, y, 1, 1 + o->n * square, GSL_PREC_DOUBLE);
}

/* At tau: elliptic functions, and Pi(n) of its amplitude, of whole half periods and what is left. */
struct angle {
    double sn, cn, dn, third;
};

static struct angle angle_at(const struct oracle *o, double tau)
{
    struct angle at;
    double halves = round(tau / (2 * o->quarter)), sign = fmod(halves, 2) == 0 ? 1 : -1;
    (void)gsl_sf_elljac_e(tau - 2 * o->quarter * halves, o->m, &at.sn, &at.cn, &at.dn);
    at.third = 2 * halves * o->whole + third(o, at.sn, at.cn);
    double size = sign * hypot(at.sn, at.cn); /* so that energy and angular momentum stay what they are */
    at.sn /= size;
    at.cn /= size;
    at.dn = sqrt(at.cn * at.cn + o->rest * at.sn * at.sn);
    return at;
}

/* Unit vectors along L, normal to it and e_i, and normal to both, as the body sees them. */
static void frame_at(const struct oracle *o, const double w[3], double frame[3][3])
{
    double axis[3] = {0, 0, 0};
    axis[o->i] = 1;
    for (int i = 0; i < 3; i++) {
        frame[0][i] = o->I[i] * w[i];
    }
    normalise(frame[0]);
    cross(axis, frame[0], frame[1]);
    normalise(frame[1]);
    cross(frame[0], frame[1], frame[2]);
}

/* Angular velocity as the body sees it [rad/s], and R, row by row. */
static void motion(const struct oracle *o, double t, double w[3], double R[9])
{
    struct angle at = angle_at(o, o->tau0 + o->rate * t);
    double frame[3][3], turned[3][3], phi = o->L * t / o->I[o->i] + o->lead * (at.third - o->turn);
    w[o->i] = o->a[o->i] * at.cn;
    w[o->j] = o->a[o->j] * at.sn;
    w[o->k] = o->a[o->k] * at.dn;
    frame_at(o, w, frame);
    for (int i = 0; i < 3; i++) {
        turned[0][i] = o->start[0][i];
        turned[1][i] = cos(phi) * o->start[1][i] + sin(phi) * o->start[2][i];
        turned[2][i] = cos(phi) * o->start[2][i] - sin(phi) * o->start[1][i];
    }
    for (int i = 0; i < 9; i++) {
        R[i] = 0;
        for (int n = 0; n < 3; n++) {
            R[i] += turned[n][i / 3] * frame[n][i % 3];
        }
    }
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    double w[3], R[9], moved[3];
    motion(o, t, w, R);
    cross(w, X, moved);
    *at = (struct oracle_state){.u = {-X[0], -X[1], -X[2]}};
    for (int i = 0; i < 9; i++) {
        at->F[i] = R[i];
        at->u[i / 3] += R[i] * X[i % 3];
        at->v[i / 3] += R[i] * moved[i % 3];
    }
    for (int i = 0; i < 3; i++) {
        at->p[i] = o->given.rho * at->v[i];
    }
}

static double mass(const struct free_top_given *g)
{
    return g->rho * g->side[0] * g->side[1] * g->side[2];
}

static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    *kinetic = mass(&o->given) * o->twice_T / 2;
    *strain = 0 * t;
}

static double outside(const struct oracle *o, const double X[3])
{
    double lower[3], upper[3];
    for (int i = 0; i < 3; i++) {
        upper[i] = o->given.side[i] / 2;
        lower[i] = -upper[i];
    }
    return oracle_outside_box(3, lower, upper, X);
}

/* I_a - I_b, by the sides: moments of inertia that are near one another cancel. */
static double apart(const struct oracle *o, int a, int b)
{
    const double *side = o->given.side;
    return (side[b] - side[a]) * (side[b] + side[a]) / 12;
}

/* L^2 - 2 T I of an axis, term by term: nothing cancels where the angular velocity is near that axis. */
static double excess(const struct oracle *o, int axis)
{
    double sum = 0;
    for (int n = 0; n < 3; n++) {
        sum += o->I[n] * o->given.spin[n] * (apart(o, n, axis) * o->given.spin[n]);
    }
    return sum;
}

static void moments(struct oracle *o)
{
    const double *side = o->given.side, *spin = o->given.spin;
    for (int n = 0; n < 3; n++) {
        double next = side[(n + 1) % 3], last = side[(n + 2) % 3];
        o->I[n] = (next * next + last * last) / 12;
        o->twice_T += o->I[n] * spin[n] * spin[n];
        o->L = hypot(o->L, o->I[n] * spin[n]);
    }
}

/* The constants of the motion. False on the separatrix, or next to it. */
static bool solve(struct oracle *o)
{
    o->j = 1;
    o->k = excess(o, 1) > 0 ? 2 : 0;
    o->i = 2 - o->k;
    const double *spin = o->given.spin, *I = o->I;
    double ki = fabs(apart(o, o->k, o->i)), kj = fabs(apart(o, o->k, o->j)), ij = fabs(apart(o, o->i, o->j));
    double of_i = fabs(excess(o, o->i)), of_j = fabs(excess(o, o->j)), of_k = fabs(excess(o, o->k));
    o->m = ij * of_k / (kj * of_i);
    o->rest = ki * of_j / (kj * of_i);
    if (!(o->rest >= NEAREST)) {
        return false;
    }
    o->a[o->i] = sqrt(of_k / (I[o->i] * ki));
    o->a[o->j] = sqrt(of_k / (I[o->j] * kj));
    o->a[o->k] = copysign(sqrt(of_i / (I[o->k] * ki)), spin[o->k]);
    o->rate = o->a[o->k] * sqrt(ki / I[o->i] * (kj / I[o->j]));
    double sn = spin[o->j] * sqrt(I[o->j] * kj), cn = spin[o->i] * sqrt(I[o->i] * ki), size = hypot(sn, cn);
    double along = I[o->i] * o->a[o->i], across = (o->L - along) * (o->L + along);
    o->quarter = first(o, 1, 0);
    o->tau0 = size > 0 ? first(o, sn / size, fabs(cn) / size) : 0;
    o->tau0 = cn < 0 ? 2 * o->quarter - o->tau0 : o->tau0;
    o->n = along * along / across;
    o->lead = -o->L * excess(o, o->i) / (I[o->i] * across * o->rate);
    o->whole = third(o, 1, 0);
    o->turn = angle_at(o, o->tau0).third;
    frame_at(o, spin, o->start);
    return true;
}

static bool is_box(const double *value, char why[ORACLE_WHY])
{
    for (int n = 0; n < 2; n++) {
        if (!(value[n] >= LONGER * value[n + 1])) {
            (void)snprintf(why, ORACLE_WHY,
                           "%s = %.15g m and %s = %.15g m, but each side must be at least %g times the next; %s = %g "
                           "would do",
                           parameters[n].name, value[n], parameters[n + 1].name, value[n + 1], LONGER,
                           parameters[n].name, 1.5 * value[n + 1]);
            return false;
        }
    }
    bool needle = value[0] > NEEDLE * value[1];
    if (needle || value[0] > SHEET * value[2]) {
        int other = needle ? 1 : 2;
        (void)snprintf(why, ORACLE_WHY,
                       "A = %.15g m and %s = %.15g m, but A must be at most %g times as long; %s = %g would do",
                       value[0], parameters[other].name, value[other], needle ? NEEDLE : SHEET, needle ? "A" : "C",
                       needle ? 1.5 * value[1] : value[1] / 1.5);
        return false;
    }
    return true;
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o = {
        .given = {.side = {value[0], value[1], value[2]}, .spin = {value[3], value[4], value[5]}, .rho = value[6]}};
    double spin = hypot(hypot(value[3], value[4]), value[5]), A = value[0], C = value[2];
    const double size[] = {
        spin,           A * A * A * A * spin * spin,         C * C * C * C * spin * spin, value[6] * A * spin,
        mass(&o.given), mass(&o.given) * A * A * spin * spin};
    if (!is_box(value, why)) {
        return false;
    }
    if (spin == 0) {
        (void)snprintf(why, ORACLE_WHY,
                       "spin_x, spin_y and spin_z are all 0, but the body must spin; spin_z = 1 would "
                       "do");
        return false;
    }
    if (!oracle_representable(size, sizeof size / sizeof *size, false)) {
        return oracle_out_of_range(parameters, value, why);
    }
    moments(&o);
    if (!solve(&o)) {
        (void)snprintf(why, ORACLE_WHY,
                       "spin_x = %.15g, spin_y = %.15g, spin_z = %.15g rad/s is a spin about the middle axis, or comes "
                       "as near to it as makes no difference: how long it lasts depends on round-off; spin_z = %g "
                       "would do",
                       value[3], value[4], value[5], spin);
        return false;
    }
    return oracle_keep(&o, sizeof o, oracle, why);
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    figure[0] =
        (struct oracle_figure){"period", "s", "of the angular velocity as the body sees it", free_top_period(o)};
    figure[1] = (struct oracle_figure){"distance from the separatrix", "-", "1 - m of its elliptic functions", o->rest};
    return 2;
}

const struct oracle_kind oracle_free_top = {
    .name = "free-top",
    .summary = "a rigid box that tumbles freely: Euler's top; of stresses it says nothing, its own are 0",
    .source = "L. D. Landau, E. M. Lifshitz, Mechanics, section 37",
    .dim = 3,
    .smoothness = ORACLE_SMOOTH,
    .finite_strain = true,
    .rigid = true,
    .parameter = parameters,
    .create = create,
    .destroy = oracle_release,
    .state = state,
    .outside = outside,
    .energy = energy,
    .figures = figures,
    .check = free_top_check,
};
