/* A plane wave of uniaxial strain in an elastic-plastic plate (for instance Graff, Wave Motion in Elastic Solids, or
 * Davison, Fundamentals of Shock Wave Propagation in Solids): the face X = 0 of a plate at rest moves with v0 from
 * t = 0 on. J2 plasticity with linear isotropic hardening, small strains. The stress-strain curve of uniaxial strain is
 * bilinear, with the slopes
 *
 *     M = K + 4/3 mu,   Mp = K + 4/3 mu H/(3 mu + H),
 *
 * and bends where |P11| is the Hugoniot elastic limit Y (1 - nu)/(1 - 2 nu), which elastic waves reach with
 * vh = HEL/(rho c). A faster face sends out two waves, one behind the other, with
 *
 *     c = sqrt(M/rho):  v = vh, e = -vh/c, P11 = -HEL,     cp = sqrt(Mp/rho):  v = v0, e = -vh/c - (v0 - vh)/cp;
 *
 * a slower one has the first alone. Behind the second the plastic strain is 2 mu (v0 - vh)/cp/(3 mu + H). It reaches
 * until the first wave is at the other face, X = L. */
#include "oracles/plastic_wave.h"
#include "oracles/j2.h"
#include "oracles/kind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double LEAST_LAG = 1e-6;  /* of the second wave behind the first, as a part of the way */
static const double MOST_FLOWED = 2e3; /* plastic strain over the elastic: so stiff are the equations of its check */

/* What is the same everywhere between two fronts. */
struct zone {
    double v, strain, stress, lateral; /* [m/s], [-], P11 and P22 = P33 [Pa] */
    double plastic, yield_stress;      /* [-], [Pa] */
    double energy;                     /* elastic [J/m^3] */
};

struct oracle {
    struct plastic_wave_given given;
    double bulk, mu, limit; /* [Pa]; Hugoniot elastic limit [Pa] */
    double speed[2];        /* of the elastic and the plastic wave [m/s] */
    size_t waves;           /* 1 or 2 */
    struct zone zone[3];    /* ahead of all, behind the first, behind the second */
};

static const struct oracle_parameter parameters[] = {
    {"L", "m", "thickness of the plate", 0, INFINITY, true, false, 2},
    {"v0", "m/s", "velocity of the face at X = 0, into the plate", 0, INFINITY, true, false, 60},
    {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, false, 117e9},
    {"material.nu", "-", "Poisson's ratio", 0, 0.5, false, true, 0.35},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 8930},
    {"material.yield_stress", "Pa", "yield stress of the virgin material", 0, INFINITY, true, false, 0.4e9},
    {"material.hardening", "Pa", "rise of the yield stress per plastic strain; 0: perfectly plastic", 0, INFINITY,
     false, false, 0.1e9},
    {0},
};

static double reach(const struct oracle *o)
{
    return o->given.L / o->speed[0];
}

/* NULL where the oracle says nothing. */
static const struct zone *zone_at(const struct oracle *o, double X, double t)
{
    size_t passed = 0;
    if (!(t <= reach(o))) {
        return NULL;
    }
    while (passed < o->waves && X < o->speed[passed] * t) {
        passed++;
    }
    return &o->zone[passed];
}

static double displacement(const struct oracle *o, double X, double t)
{
    double u = 0;
    for (size_t i = 0; i < o->waves; i++) {
        u += (o->zone[i + 1].v - o->zone[i].v) * fmax(0, t - X / o->speed[i]);
    }
    return u;
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    const struct zone *zone = zone_at(o, X[0], t);
    if (zone == NULL) {
        oracle_silence(at);
        return;
    }
    memset(at, 0, sizeof *at);
    at->u[0] = displacement(o, X[0], t);
    at->v[0] = zone->v;
    at->p[0] = o->given.rho * zone->v;
    at->F[0] = 1 + zone->strain;
    at->F[4] = at->F[8] = 1;
    at->P[0] = zone->stress;
    at->P[4] = at->P[8] = zone->lateral;
}

static void extras(const struct oracle *o, const double X[3], double t, double value[ORACLE_EXTRAS])
{
    const struct zone *zone = zone_at(o, X[0], t);
    value[J2_PLASTIC_STRAIN] = zone != NULL ? zone->plastic : NAN;
    value[J2_YIELD_STRESS] = zone != NULL ? zone->yield_stress : NAN;
}

static double outside(const struct oracle *o, const double X[3])
{
    const double lower = 0;
    return oracle_outside_box(1, &lower, &o->given.L, X);
}

static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    *kinetic = *strain = t <= reach(o) ? 0 : NAN;
    for (size_t i = 0; i < o->waves && t > 0; i++) {
        double width = t * (o->speed[i] - (i + 1 < o->waves ? o->speed[i + 1] : 0));
        *kinetic += o->given.rho * o->zone[i + 1].v / 2 * o->zone[i + 1].v * width;
        *strain += o->zone[i + 1].energy * width;
    }
}

static size_t fronts(const struct oracle *o, double t, struct oracle_front front[ORACLE_FRONTS])
{
    if (!(t <= reach(o))) {
        return ORACLE_TOO_MANY_FRONTS;
    }
    for (size_t i = 0; i < o->waves && t >= 0; i++) {
        size_t which = o->waves - 1 - i; /* the slower one is behind */
        front[i] = (struct oracle_front){.X = o->speed[which] * t,
                                         .speed = o->speed[which],
                                         .jump = o->zone[which].v - o->zone[which + 1].v,
                                         .smoothness = ORACLE_JUMPS};
    }
    return t >= 0 ? o->waves : 0;
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    const struct zone *behind = &o->zone[o->waves];
    const struct oracle_figure all[] = {
        {"elastic wave speed", "m/s", "of the precursor", o->speed[0]},
        {"plastic wave speed", "m/s", "of the wave behind it", o->speed[1]},
        {"elastic limit", "Pa", "Hugoniot elastic limit: magnitude of P11 at which uniaxial strain yields", o->limit},
        {"yield velocity", "m/s", "of the face, above which there is a plastic wave",
         o->limit / (o->given.rho * o->speed[0])},
        {"stress", "Pa", "P11 behind all waves", behind->stress},
        {"plastic strain", "-", "behind all waves", behind->plastic},
        {"arrival", "s", "of the first wave at the other face", reach(o)},
    };
    memcpy(figure, all, sizeof all);
    return sizeof all / sizeof *all;
}

const struct plastic_wave_given *plastic_wave_given(const struct oracle *oracle)
{
    return &oracle->given;
}

static void fill_zones(struct oracle *o)
{
    const struct plastic_wave_given *g = &o->given;
    double yielding = o->limit / (g->rho * o->speed[0]), elastic = fmin(g->v0, yielding), more = g->v0 - elastic;
    struct zone *first = &o->zone[1], *second = &o->zone[2];
    o->waves = more > 0 ? 2 : 1;
    *first = (struct zone){.v = elastic, .strain = -elastic / o->speed[0], .stress = -g->rho * o->speed[0] * elastic};
    first->lateral = (o->bulk - 2 * o->mu / 3) * first->strain;
    *second = (struct zone){.v = g->v0,
                            .strain = first->strain - more / o->speed[1],
                            .stress = first->stress - g->rho * o->speed[1] * more,
                            .plastic = 2 * o->mu * more / o->speed[1] / (3 * o->mu + g->hardening)};
    second->lateral = second->stress + g->yield_stress + g->hardening * second->plastic;
    for (size_t i = 0; i <= o->waves; i++) {
        struct zone *zone = &o->zone[i];
        double equivalent = zone->lateral - zone->stress;
        zone->yield_stress = g->yield_stress + g->hardening * zone->plastic;
        zone->energy = o->bulk * zone->strain / 2 * zone->strain + equivalent / (6 * o->mu) * equivalent;
    }
}

static bool fits(const struct oracle *o, const double *value, char why[ORACLE_WHY])
{
    const struct plastic_wave_given *g = &o->given;
    const struct zone *behind = &o->zone[o->waves];
    double kinetic, strain;
    energy(o, reach(o), &kinetic, &strain);
    const double size[] = {
        o->mu,          o->bulk,        o->speed[0], o->speed[1],      o->limit, reach(o),         g->rho * g->v0,
        behind->stress, behind->strain, kinetic,     g->v0 * reach(o), strain,   o->zone[1].energy};
    if (!oracle_representable(size, sizeof size / sizeof *size, false)) {
        return oracle_out_of_range(parameters, value, why);
    }
    if (o->speed[0] - o->speed[1] < LEAST_LAG * o->speed[0]) {
        (void)snprintf(why, ORACLE_WHY,
                       "material.hardening = %g Pa: the plastic wave, with %.15g m/s, is too near to the elastic one "
                       "with %.15g m/s to tell the two apart; material.hardening = %g Pa would do",
                       g->hardening, o->speed[1], o->speed[0], o->mu);
        return false;
    }
    double elastic = behind->yield_stress / (3 * o->mu);
    if (!(behind->plastic <= MOST_FLOWED * elastic)) {
        (void)snprintf(
            why, ORACLE_WHY,
            "v0 = %.15g m/s: the plastic strain, %g, is more than %g times the elastic strain of the yielding "
            "material, %g; material.hardening = %g Pa would do",
            g->v0, behind->plastic, MOST_FLOWED, elastic, 6 * o->mu / MOST_FLOWED);
        return false;
    }
    return true;
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o = {.given = {.L = value[0],
                                 .v0 = value[1],
                                 .E = value[2],
                                 .nu = value[3],
                                 .rho = value[4],
                                 .yield_stress = value[5],
                                 .hardening = value[6]}};
    const struct plastic_wave_given *g = &o.given;
    o.mu = g->E / (2 * (1 + g->nu));
    o.bulk = g->E / (3 * (1 - 2 * g->nu));
    o.limit = g->yield_stress * (1 - g->nu) / (1 - 2 * g->nu);
    o.speed[0] = sqrt((o.bulk + 4 * o.mu / 3) / g->rho);
    o.speed[1] = sqrt((o.bulk + 4 * o.mu / 3 * (g->hardening / (3 * o.mu + g->hardening))) / g->rho);
    fill_zones(&o);
    return fits(&o, value, why) && oracle_keep(&o, sizeof o, oracle, why);
}

const struct oracle_kind oracle_plastic_wave = {
    .name = "plastic-wave",
    .summary = "elastic precursor and plastic wave of uniaxial strain in a plate whose face is moved at once",
    .source = "Davison, Fundamentals of Shock Wave Propagation in Solids (2008); copper of 004_0c0448173ed5e9bd.txt, "
              "section 4.1",
    .dim = 1,
    .smoothness = ORACLE_JUMPS,
    .parameter = parameters,
    .extra = j2_extra,
    .create = create,
    .destroy = oracle_release,
    .reach = reach,
    .state = state,
    .extras = extras,
    .outside = outside,
    .energy = energy,
    .fronts = fronts,
    .figures = figures,
    .check = plastic_wave_check,
};
