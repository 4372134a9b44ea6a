/* A unit cube of J2 plasticity with linear isotropic hardening, strained all alike and back again: u = x(t) X along X,
 * or x(t) Y along X, where x goes from 0 to the amplitude A, to -A, and so on with constant speed 4 A/period. Between
 * the turning points no force acts on what is within; at them the velocity changes sign, for which an impulse of
 * 2 rho |v| per volume is due.
 *
 * The deviator of the strain keeps its direction, so that all follows from two signed numbers, the equivalent strain
 * y and the equivalent stress q, which elastically is 3 mu y:
 *
 *     stretch   y = 2/3 x,   P11 = K x + 2/3 q,  P22 = P33 = K x - q/3
 *     shear     y = x/sqrt(3),   P12 = P21 = q/sqrt(3)
 *
 * From a turning point on, d the direction, q goes with 3 mu until d q is the yield stress that is left, Y + H a, and
 * then with 3 mu H/(3 mu + H), while the accumulated plastic strain a grows with 3 mu/(3 mu + H) of what y does.
 *
 * At finite strain, with the strain of Hencky in a stretch of fixed axes (000_e9ec29e1bde7947d.txt, Algorithm 2), the
 * same holds of the stress of Kirchhoff with y = 2/3 ln(1 + x) and K ln(1 + x); P11 = tau11/(1 + x), P22 = tau22. */
#include "oracles/j2_cycle.h"
#include "oracles/j2.h"
#include "oracles/kind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double MOST_YIELDED = 1e4; /* amplitude over the strain that yields */
enum { MOST_LEGS = 2 * J2_CYCLES + 1 };

/* The material at one strain. */
struct material {
    double strain, stress, plastic; /* y [-], q [Pa], a [-] */
};

struct oracle {
    struct j2_cycle_given given;
    struct j2_cycle_path path;
    double bulk, mu;                 /* [Pa] */
    struct material turn[MOST_LEGS]; /* where each leg begins */
};

static double reach(const struct oracle *o)
{
    return o->given.cycles * o->given.period;
}

/* Leg 0 ends after a quarter of a period, the others take half a period each. */
static int leg_at(const struct oracle *o, double t)
{
    return (int)fmin(2 * o->given.cycles, fmax(0, floor(2 * t / o->given.period + 0.5)));
}

static double strain_at(const struct oracle *o, double t)
{
    int leg = leg_at(o, t);
    return (leg % 2 == 0 ? 4 : -4) * o->given.amplitude * (t / o->given.period - leg / 2.0);
}

static double rate_at(const struct oracle *o, double t)
{
    return (leg_at(o, t) % 2 == 0 ? 4 : -4) * o->given.amplitude / o->given.period;
}

static double equivalent_strain(const struct oracle *o, double x)
{
    return o->path.component == 1 ? x / sqrt(3) : 2 * (o->path.logarithmic ? log1p(x) : x) / 3;
}

static double yield_stress(const struct oracle *o, double plastic)
{
    return o->given.yield_stress + o->given.hardening * plastic;
}

/* At strain x on a leg. What yields has the yield stress, however much of the strain has flowed. */
static struct material material_at(const struct oracle *o, int leg, double x)
{
    const struct material *from = &o->turn[leg];
    double d = leg % 2 == 0 ? 1 : -1, y = equivalent_strain(o, x), q = from->stress + 3 * o->mu * (y - from->strain);
    double excess = d * q - yield_stress(o, from->plastic);
    if (!(excess > 0)) {
        return (struct material){y, q, from->plastic};
    }
    double plastic = from->plastic + excess / (3 * o->mu + o->given.hardening);
    return (struct material){y, d * yield_stress(o, plastic), plastic};
}

static struct material material_now(const struct oracle *o, double t)
{
    return material_at(o, leg_at(o, t), strain_at(o, t));
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    if (!(t <= reach(o))) {
        oracle_silence(at);
        return;
    }
    double x = strain_at(o, t), rate = rate_at(o, t), q = material_now(o, t).stress, place = X[o->path.component];
    memset(at, 0, sizeof *at);
    at->u[0] = x * place;
    at->v[0] = rate * place;
    at->p[0] = o->given.rho * rate * place;
    at->F[0] = at->F[4] = at->F[8] = 1;
    at->F[o->path.component] += x;
    if (o->path.component == 1) {
        at->P[1] = at->P[3] = q / sqrt(3);
        return;
    }
    double mean = o->bulk * (o->path.logarithmic ? log1p(x) : x);
    at->P[0] = (mean + 2 * q / 3) / (o->path.logarithmic ? 1 + x : 1);
    at->P[4] = at->P[8] = mean - q / 3;
}

static void extras(const struct oracle *o, const double X[3], double t, double value[ORACLE_EXTRAS])
{
    (void)X; /* all alike */
    value[J2_PLASTIC_STRAIN] = t <= reach(o) ? material_now(o, t).plastic : NAN;
    value[J2_YIELD_STRESS] = yield_stress(o, value[J2_PLASTIC_STRAIN]);
}

static double outside(const struct oracle *o, const double X[3])
{
    static const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
    (void)o;
    return oracle_outside_box(3, lower, upper, X);
}

static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    if (!(t <= reach(o))) {
        *kinetic = *strain = NAN;
        return;
    }
    double x = strain_at(o, t), rate = rate_at(o, t), q = material_now(o, t).stress;
    double volumetric = o->path.component == 1 ? 0 : (o->path.logarithmic ? log1p(x) : x);
    *kinetic = o->given.rho * rate * rate / 6;
    *strain = o->bulk / 2 * volumetric * volumetric + q / (6 * o->mu) * q;
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    double quarter = o->given.period / 4, end = reach(o);
    const struct oracle_figure all[] = {
        {"strain rate", "1/s", "magnitude, between the turning points", rate_at(o, 0)},
        {"first peak", "Pa", "equivalent stress at the first turning point", material_now(o, quarter).stress},
        {"last peak", "Pa", "magnitude of the equivalent stress at the last turning point",
         -material_now(o, end - quarter).stress},
        {"plastic strain", "-", "accumulated when all is over", material_now(o, end).plastic},
    };
    memcpy(figure, all, sizeof all);
    return sizeof all / sizeof *all;
}

const struct j2_cycle_given *j2_cycle_given(const struct oracle *oracle)
{
    return &oracle->given;
}

const struct j2_cycle_path *j2_cycle_path(const struct oracle *oracle)
{
    return &oracle->path;
}

static bool fits(const struct oracle_kind *kind, const struct oracle *o, const double *value, char why[ORACLE_WHY])
{
    const struct j2_cycle_given *g = &o->given;
    double kinetic, strain, yields = g->yield_stress / (3 * o->mu), rate = rate_at(o, 0);
    energy(o, g->period / 4, &kinetic, &strain);
    const double size[] = {o->mu,
                           o->bulk,
                           g->amplitude,
                           rate,
                           reach(o),
                           g->rho * rate,
                           kinetic,
                           strain,
                           yields,
                           (o->bulk + o->mu) * g->amplitude,
                           (o->bulk + o->mu) * g->amplitude * g->amplitude};
    if (!oracle_representable(size, sizeof size / sizeof *size, false)) {
        return oracle_out_of_range(kind->parameter, value, why);
    }
    if (g->amplitude > MOST_YIELDED * yields) {
        (void)snprintf(why, ORACLE_WHY,
                       "amplitude = %.15g is %g times the equivalent strain at which the material yields, %g, but it "
                       "must be at most %g times; amplitude = %g would do",
                       g->amplitude, g->amplitude / yields, yields, MOST_YIELDED, 4 * yields);
        return false;
    }
    return true;
}

static bool create(const struct oracle_kind *kind, const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o = {.given = {.amplitude = value[0],
                                 .period = value[1],
                                 .cycles = (int)value[2],
                                 .E = value[3],
                                 .nu = value[4],
                                 .rho = value[5],
                                 .yield_stress = value[6],
                                 .hardening = value[7]},
                       .path = *(const struct j2_cycle_path *)kind->about};
    const struct j2_cycle_given *g = &o.given;
    if (value[2] != floor(value[2])) {
        (void)snprintf(why, ORACLE_WHY, "cycles = %.15g, but it must be a whole number; cycles = %g would do", value[2],
                       ceil(value[2]));
        return false;
    }
    o.mu = g->E / (2 * (1 + g->nu));
    o.bulk = g->E / (3 * (1 - 2 * g->nu));
    for (int leg = 0; leg < 2 * g->cycles; leg++) {
        o.turn[leg + 1] = material_at(&o, leg, leg % 2 == 0 ? g->amplitude : -g->amplitude);
    }
    return fits(kind, &o, value, why) && oracle_keep(&o, sizeof o, oracle, why);
}

static const struct oracle_parameter parameters[] = {
    {"amplitude", "-", "largest strain: change of length per length, or angle of shear", 0, 0.5, true, false, 0.02},
    {"period", "s", "of the strain", 0, INFINITY, true, false, 1e-3},
    {"cycles", "-", "how many there are", 1, J2_CYCLES, false, false, 2},
    {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, false, 117e9},
    {"material.nu", "-", "Poisson's ratio", 0, 0.5, false, true, 0.35},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 8930},
    {"material.yield_stress", "Pa", "yield stress of the virgin material", 0, INFINITY, true, false, 0.4e9},
    {"material.hardening", "Pa", "rise of the yield stress per plastic strain; 0: perfectly plastic", 0, INFINITY,
     false, false, 0.1e9},
    {0},
};

static const struct j2_cycle_path stretch = {.component = 0}, shear = {.component = 1},
                                  hencky = {.component = 0, .logarithmic = true};

#define J2_CYCLE                                                                                                       \
    .dim = 3, .smoothness = ORACLE_SMOOTH, .parameter = parameters, .extra = j2_extra, .create_as = create,            \
    .destroy = oracle_release, .reach = reach, .state = state, .extras = extras, .outside = outside, .energy = energy, \
    .figures = figures, .check = j2_cycle_check

const struct oracle_kind oracle_j2_uniaxial = {
    .name = "j2-uniaxial",
    .summary = "cycles of uniaxial strain in an elastic-plastic cube, small strains",
    .source = "J2 plasticity with linear isotropic hardening in closed form; copper of 004_0c0448173ed5e9bd.txt, "
              "section 4.1",
    .about = &stretch,
    J2_CYCLE,
};

const struct oracle_kind oracle_j2_simple_shear = {
    .name = "j2-simple-shear",
    .summary = "cycles of simple shear in an elastic-plastic cube, small strains",
    .source = "J2 plasticity with linear isotropic hardening in closed form; copper of 004_0c0448173ed5e9bd.txt, "
              "section 4.1",
    .about = &shear,
    J2_CYCLE,
};

const struct oracle_kind oracle_j2_hencky_uniaxial = {
    .name = "j2-hencky-uniaxial",
    .summary = "cycles of uniaxial strain in an elastic-plastic cube, finite strains by Hencky's measure",
    .source = "closed form of 000_e9ec29e1bde7947d.txt, Algorithm 2; copper of 004_0c0448173ed5e9bd.txt, section 4.1",
    .finite_strain = true,
    .about = &hencky,
    J2_CYCLE,
};
