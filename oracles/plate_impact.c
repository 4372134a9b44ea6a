/* Two equal plates, each of thickness L and without strength, meet face to face at t = 0, the left one, X < L, with v0,
 * the right one with -v0. By symmetry what has been shocked is at rest. With U the speed of the shocks in the material
 * ahead of them, which is that in X, the laws of Rankine and Hugoniot for mass, momentum and energy say
 *
 *     rho0/rho = 1 - v0/U,   p = rho0 U v0,   e = p (1/rho0 - 1/rho)/2 = v0^2/2
 *
 * behind them; U comes from the equation of state. It reaches until the shocks are at the back faces. Stresses are
 * those of a fluid in uniaxial strain, P = -p F^-T det F: P11 = -p, P22 = P33 = -p rho0/rho. */
#include "oracles/plate_impact.h"
#include "oracles/kind.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct oracle {
    struct plate_impact_given given;
    double U, eta, p; /* shock speed [m/s]; compression and pressure [Pa] behind */
    double sound[2];  /* ahead and behind [m/s] */
};

static const struct oracle_parameter stiffened_parameters[] = {
    {"L", "m", "thickness of each plate", 0, INFINITY, true, false, 1},
    {"v0", "m/s", "velocity of either plate towards the other", 0, INFINITY, true, false, 1000},
    {"material.rho", "kg/m^3", "density at rest", 0, INFINITY, true, false, 2785},
    {"material.gamma", "-", "ratio of specific heats", 1, INFINITY, true, false, 2},
    {"material.p_inf", "Pa", "stiffness; 0: an ideal gas", 0, INFINITY, false, false, 39.53e9},
    {0},
};

static const struct oracle_parameter linear_parameters[] = {
    {"L", "m", "thickness of each plate", 0, INFINITY, true, false, 1},
    {"v0", "m/s", "velocity of either plate towards the other", 0, INFINITY, true, false, 1000},
    {"material.rho", "kg/m^3", "density at rest", 0, INFINITY, true, false, 2785},
    {"material.c0", "m/s", "shock speed in the limit of weak shocks", 0, INFINITY, true, false, 5328},
    {"material.s", "-", "rise of the shock speed with the velocity behind the shock", 0, 100, false, false, 1.338},
    {"material.Gamma0", "-", "Grueneisen's coefficient at rest; it goes with 1/rho", 0, 100, false, false, 2},
    {0},
};

static const struct oracle_extra extra[] = {
    {"density", "kg/m^3", "mass per current volume"},
    {"internal_energy", "J/kg", "per mass, above that of the material at rest"},
    {"sound_speed", "m/s", "isentropic, in the current configuration"},
    {0},
};

static double reach(const struct oracle *o)
{
    return o->given.L / o->U;
}

static bool shocked(const struct oracle *o, double X, double t)
{
    return t > 0 && fabs(X - o->given.L) < o->U * t;
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    double v0 = (X[0] < o->given.L ? 1 : -1) * o->given.v0, way = fabs(X[0] - o->given.L);
    bool behind = shocked(o, X[0], t);
    double p = behind ? o->p : 0;
    if (!(t <= reach(o))) {
        oracle_silence(at);
        return;
    }
    memset(at, 0, sizeof *at);
    at->u[0] = v0 * (behind ? way / o->U : t);
    at->v[0] = behind ? 0 : v0;
    at->p[0] = o->given.rho * at->v[0];
    at->F[0] = 1 - (behind ? o->eta : 0);
    at->F[4] = at->F[8] = 1;
    at->P[0] = -p;
    at->P[4] = at->P[8] = -p * at->F[0];
}

static void extras(const struct oracle *o, const double X[3], double t, double value[ORACLE_EXTRAS])
{
    bool behind = shocked(o, X[0], t);
    double known = t <= reach(o) ? 1 : NAN;
    value[0] = known * o->given.rho / (1 - (behind ? o->eta : 0));
    value[1] = known * (behind ? o->given.v0 / 2 * o->given.v0 : 0);
    value[2] = known * o->sound[behind];
}

static double outside(const struct oracle *o, const double X[3])
{
    const double lower = 0, upper = 2 * o->given.L;
    return oracle_outside_box(1, &lower, &upper, X);
}

static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    double each = o->given.rho * o->given.v0 * o->given.v0, part = t <= reach(o) ? fmax(0, t) * o->U : NAN;
    *kinetic = each * (o->given.L - part);
    *strain = each * part;
}

static size_t fronts(const struct oracle *o, double t, struct oracle_front front[ORACLE_FRONTS])
{
    if (!(t <= reach(o))) {
        return ORACLE_TOO_MANY_FRONTS;
    }
    for (int side = 0; side < 2 && t >= 0; side++) {
        double speed = side == 0 ? -o->U : o->U;
        front[side] = (struct oracle_front){
            .X = o->given.L + speed * t, .speed = speed, .jump = -o->given.v0, .smoothness = ORACLE_JUMPS};
    }
    return t >= 0 ? 2 : 0;
}

static size_t figures(const struct oracle *o, struct oracle_figure figure[ORACLE_FIGURES])
{
    const struct oracle_figure all[] = {
        {"shock speed", "m/s", "in the material ahead of it", o->U},
        {"pressure", "Pa", "behind the shocks, positive in compression", o->p},
        {"density", "kg/m^3", "behind the shocks", o->given.rho / (1 - o->eta)},
        {"internal energy", "J/kg", "behind the shocks, above that at rest", o->given.v0 / 2 * o->given.v0},
        {"sound speed", "m/s", "behind the shocks", o->sound[1]},
        {"arrival", "s", "of the shocks at the back faces", reach(o)},
    };
    memcpy(figure, all, sizeof all);
    return sizeof all / sizeof *all;
}

const struct plate_impact_given *plate_impact_given(const struct oracle *oracle)
{
    return &oracle->given;
}

static bool fits(const struct oracle_kind *kind, const struct oracle *o, const double *value, char why[ORACLE_WHY])
{
    const struct plate_impact_eos *eos = kind->about;
    double p = o->p, E = p * o->given.L * o->eta;
    const double size[] = {o->U,
                           p,
                           o->eta,
                           o->sound[1],
                           reach(o),
                           E,
                           o->given.v0 * o->given.v0,
                           p / o->given.rho,
                           o->given.rho * o->U * o->U};
    if (!oracle_representable(size, sizeof size / sizeof *size, false)) {
        return oracle_out_of_range(kind->parameter, value, why);
    }
    double limit = eos->limit(&o->given);
    if (!(o->eta < limit)) {
        char remedy[48] = "material.gamma = 1.4"; /* an ideal gas is compressed alike at any speed */
        if (o->sound[0] > 0) {                    /* than which no shock is slower */
            (void)snprintf(remedy, sizeof remedy, "v0 = %g m/s", limit / 2 * o->sound[0]);
        }
        (void)snprintf(why, ORACLE_WHY,
                       "v0 = %.15g m/s compresses by %.15g, but it must be less than %.15g, near where the equation "
                       "of state ends; %s would do",
                       o->given.v0, o->eta, limit, remedy);
        return false;
    }
    return true;
}

static bool create(const struct oracle_kind *kind, const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    const struct plate_impact_eos *eos = kind->about;
    struct oracle o = {.given = {.L = value[0], .v0 = value[1], .rho = value[2]}};
    for (size_t i = 0; i < eos->coefficients; i++) {
        o.given.material[i] = value[3 + i];
    }
    o.U = eos->shock_speed(&o.given);
    o.eta = o.given.v0 / o.U;
    o.p = o.given.rho * o.U * o.given.v0;
    o.sound[0] = eos->sound_speed(&o.given, 0, 0);
    o.sound[1] = eos->sound_speed(&o.given, o.eta, o.p);
    return fits(kind, &o, value, why) && oracle_keep(&o, sizeof o, oracle, why);
}

#define PLATE_IMPACT                                                                                                   \
    .dim = 1, .smoothness = ORACLE_JUMPS, .finite_strain = true, .awaits = "equations of state", .extra = extra,       \
    .create_as = create, .destroy = oracle_release, .reach = reach, .state = state, .extras = extras,                  \
    .outside = outside, .energy = energy, .fronts = fronts, .figures = figures, .check = plate_impact_check

const struct oracle_kind oracle_plate_impact_stiffened = {
    .name = "plate-impact-stiffened",
    .summary = "plane shocks of two plates of stiffened or ideal gas that meet with equal speeds",
    .source = "Rankine's and Hugoniot's laws; 002_14d97b0eb8740b66.txt, eq. 17 and its aluminium",
    .parameter = stiffened_parameters,
    .about = &plate_impact_stiffened_gas,
    PLATE_IMPACT,
};

const struct oracle_kind oracle_plate_impact_mie_grueneisen = {
    .name = "plate-impact-mie-grueneisen",
    .summary =
        "plane shocks of two plates that meet with equal speeds, linear Hugoniot, Mie-Grueneisen equation of state",
    .source = "Rankine's and Hugoniot's laws; aluminium of 002_14d97b0eb8740b66.txt, section 3",
    .parameter = linear_parameters,
    .about = &plate_impact_mie_grueneisen,
    PLATE_IMPACT,
};
