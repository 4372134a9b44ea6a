/* The swinging cube of 000_e9ec29e1bde7947d.txt section 7.1.1 (there for A = B = C, after eq. 52 of its reference [1]),
 * for any A, B, C. Unit cube, small strains, symmetric faces at 0, skew-symmetric faces at 1, k = pi/2:
 *
 *     u = (a1 s1 c2 c3, a2 c1 s2 c3, a3 c1 c2 s3),   si = sin(k Xi),   ci = cos(k Xi),
 *     div u = k (a1 + a2 + a3) c1 c2 c3
 *
 * where every component has Laplacian -3 k^2. With m = (A + B + C)/3 the part (m, m, m) is the gradient of
 * -(m/k) c1 c2 c3, a pure p-wave; the rest sums to zero and has no divergence, a pure s-wave. So
 *
 *     ai(t) = U0 (m cos(wp t) + (Ai - m) cos(ws t)),   wp = sqrt(3) k cp,   ws = sqrt(3) k cs.
 *
 * At nu = 1/2 the s-wave alone is left, which needs no pressure.
 *
 * On Xi = 0 si = 0: no normal displacement, no shear traction (it goes with si sj). On Xi = 1 ci = 0: no tangential
 * displacement, no normal traction (it goes with c1 c2 c3). */
#include "oracles/kind.h"
#include "oracles/self_check_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const double SIDE = 1; /* [m] */

/* What the scene gives; the self-check reads nothing else. */
struct given {
    double A[3], U0;   /* amplitudes, all times U0 [m] */
    double E, nu, rho; /* [Pa], [-], [kg/m^3] */
};

struct oracle {
    struct given given;
    double lambda, mu;               /* [Pa] */
    double p_part, s_part[3];        /* amplitudes of the two waves [m] */
    double p_frequency, s_frequency; /* [rad/s] */
    double k;                        /* [rad/m] */
};

static const struct oracle_parameter parameters[] = {
    {"A", "-", "relative amplitude of u_x", -INFINITY, INFINITY, false, false, 1},
    {"B", "-", "relative amplitude of u_y", -INFINITY, INFINITY, false, false, 1},
    {"C", "-", "relative amplitude of u_z", -INFINITY, INFINITY, false, false, 1},
    {"U0", "m", "amplitude", -INFINITY, INFINITY, false, false, 5e-4},
    {"material.E", "Pa", "Young's modulus", 0, INFINITY, true, false, 17e6},
    {"material.nu", "-", "Poisson's ratio; 0.5, where the p-wave is infinitely fast, if A + B + C = 0", -1, 0.5, true,
     false, 0.3},
    {"material.rho", "kg/m^3", "density", 0, INFINITY, true, false, 1100},
    {0},
};

/* Amplitudes of the displacement and of its rate at time t. */
static void amplitudes(const struct oracle *o, double t, double a[3], double rate[3])
{
    double p = o->p_frequency * t, s = o->s_frequency * t;
    for (int i = 0; i < 3; i++) {
        a[i] = o->p_part * cos(p) + o->s_part[i] * cos(s);
        rate[i] = -o->p_part * o->p_frequency * sin(p) - o->s_part[i] * o->s_frequency * sin(s);
    }
}

/* Only the p-wave changes volume: its share is exact where the sum of all three amplitudes would leave round-off,
 * which lambda magnifies without limit as nu goes to 1/2. */
static double dilatation(const struct oracle *o, double t)
{
    return 3 * o->k * o->p_part * cos(o->p_frequency * t);
}

static void state(const struct oracle *o, const double X[3], double t, struct oracle_state *at)
{
    double s[3], c[3], a[3], rate[3], G[9];
    amplitudes(o, t, a, rate);
    for (int i = 0; i < 3; i++) {
        s[i] = sin(o->k * X[i]);
        c[i] = cos(o->k * X[i]);
    }
    double ccc = c[0] * c[1] * c[2];
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, l = (i + 2) % 3;
        double shape = s[i] * c[j] * c[l];
        at->u[i] = a[i] * shape;
        at->v[i] = rate[i] * shape;
        at->p[i] = o->given.rho * at->v[i];
        G[4 * i] = o->k * a[i] * ccc;
        G[3 * i + j] = -o->k * a[i] * s[i] * s[j] * c[l];
        G[3 * i + l] = -o->k * a[i] * s[i] * c[j] * s[l];
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            at->F[3 * i + j] = (i == j ? 1 : 0) + G[3 * i + j];
            at->P[3 * i + j] =
                o->mu * (G[3 * i + j] + G[3 * j + i]) + (i == j ? o->lambda * dilatation(o, t) * ccc : 0);
        }
    }
}

static double outside(const struct oracle *o, const double X[3])
{
    (void)o;
    return oracle_outside_box(3, (const double[]){0, 0, 0}, (const double[]){SIDE, SIDE, SIDE}, X);
}

/* Every product of squared sines and cosines integrates to 1/8 over the cube. With S the sum of the amplitudes and Q
 * the sum of their squares, |e|^2 integrates to k^2 (Q + (Q + S^2)/2) / 8 and (tr e)^2 to k^2 S^2 / 8. */
static void energy(const struct oracle *o, double t, double *kinetic, double *strain)
{
    double a[3], rate[3], S = dilatation(o, t) / o->k;
    amplitudes(o, t, a, rate);
    double Q = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    *kinetic = o->given.rho * (rate[0] * rate[0] + rate[1] * rate[1] + rate[2] * rate[2]) / 16;
    *strain = o->k * o->k * ((o->lambda + o->mu) * S * S + 3 * o->mu * Q) / 16;
}

static bool fits(const struct oracle *o)
{
    double a = 0, kinetic, strain;
    for (int i = 0; i < 3; i++) {
        a = fmax(a, fabs(o->p_part) + fabs(o->s_part[i]));
    }
    energy(o, 0, &kinetic, &strain);
    bool at_rest = o->given.U0 == 0 || (o->given.A[0] == 0 && o->given.A[1] == 0 && o->given.A[2] == 0);
    const double always[] = {o->mu, fabs(o->lambda) + 2 * o->mu, o->p_frequency, o->s_frequency};
    const double moving[] = {a,
                             strain,
                             a * o->p_frequency,
                             o->given.rho * a * o->p_frequency,
                             o->given.rho * a * o->s_frequency,
                             a * o->s_frequency,
                             a * o->p_frequency * o->p_frequency * o->given.rho};
    return oracle_representable(always, sizeof always / sizeof *always, false) &&
           oracle_representable(moving, sizeof moving / sizeof *moving, at_rest);
}

static bool create(const double *value, struct oracle **oracle, char why[ORACLE_WHY])
{
    struct oracle o = {
        .given = {.A = {value[0], value[1], value[2]}, .U0 = value[3], .E = value[4], .nu = value[5], .rho = value[6]}};
    const struct given *g = &o.given;
    o.k = PI / (2 * SIDE);
    o.mu = g->E / (2 * (1 + g->nu));
    o.lambda = g->nu < 0.5 ? g->E * g->nu / ((1 + g->nu) * (1 - 2 * g->nu)) : 2 * o.mu;
    o.p_frequency = sqrt(3 * (o.lambda + 2 * o.mu) / g->rho) * o.k;
    o.s_frequency = sqrt(3 * o.mu / g->rho) * o.k;
    double m = (g->A[0] + g->A[1] + g->A[2]) / 3;
    if (g->nu == 0.5 && m != 0) {
        (void)snprintf(why, ORACLE_WHY,
                       "material.nu: an incompressible cube has no p-wave; expected A + B + C = 0, got %g", 3 * m);
        return false;
    }
    o.p_part = g->U0 * m;
    for (int i = 0; i < 3; i++) {
        o.s_part[i] = g->U0 * (g->A[i] - m);
    }
    return fits(&o) ? oracle_keep(&o, sizeof o, oracle, why) : oracle_out_of_range(parameters, value, why);
}

/* By way of the bulk modulus, so that a slip in the oracle's own constants is seen; 1 - 2 nu and 1 + nu are exact near
 * their zeros. Without a p-wave nothing depends on it, and an incompressible cube has that of nu = 1/3. */
struct moduli {
    double bulk, mu; /* [Pa] */
};

static struct moduli moduli(const struct given *g)
{
    double mu = g->E / (2 * (1 + g->nu));
    return (struct moduli){.bulk = g->nu < 0.5 ? g->E / (3 * (1 - 2 * g->nu)) : 8 * mu / 3, .mu = mu};
}

static double p_modulus(const struct moduli *of)
{
    return of->bulk + 4 * of->mu / 3;
}

static double plane_wave_number(void)
{
    return sqrt(3.0) * PI / (2 * SIDE);
}

/* The second evaluation, d'Alembert's: s1 c2 c3 is the mean of d1 sin(k d.X) over the eight d = (+-1, +-1, +-1), so the
 * initial shape is a sum of plane waves along n = d / sqrt(3) with polarisation (d1 A, d2 B, d3 C) U0. What of it lies
 * along n runs with cp, what lies across with cs, one half forwards and one half backwards. */
struct plane_wave {
    double n[3], polarisation[3], along; /* unit normal; [m]; polarisation . n [m] */
    double speed;                        /* signed [m/s] */
};

static void add_plane_wave(const struct plane_wave *w, const struct moduli *of, double rho, const double X[3], double t,
                           struct oracle_state *sum)
{
    double kappa = plane_wave_number();
    double phase = kappa * (w->n[0] * X[0] + w->n[1] * X[1] + w->n[2] * X[2] - w->speed * t);
    double slope = kappa * cos(phase);
    for (int i = 0; i < 3; i++) {
        sum->u[i] += w->polarisation[i] * sin(phase);
        sum->v[i] -= w->polarisation[i] * w->speed * slope;
        sum->p[i] -= rho * w->polarisation[i] * w->speed * slope;
        sum->P[4 * i] += (of->bulk - 2 * of->mu / 3) * w->along * slope;
        for (int j = 0; j < 3; j++) {
            sum->F[3 * i + j] += w->polarisation[i] * w->n[j] * slope;
            sum->P[3 * i + j] += of->mu * (w->polarisation[i] * w->n[j] + w->polarisation[j] * w->n[i]) * slope;
        }
    }
}

static void plane_waves(const struct self_check *check, const double X[3], double t, struct oracle_state *sum)
{
    const struct given *g = &check->oracle->given;
    struct moduli of = moduli(g);
    memset(sum, 0, sizeof *sum);
    for (int wave = 0; wave < 32; wave++) {
        bool backwards = wave & 1, transverse = wave & 2;
        double d[3] = {wave & 4 ? -1 : 1, wave & 8 ? -1 : 1, wave & 16 ? -1 : 1};
        struct plane_wave w = {0};
        double along = 0;
        for (int i = 0; i < 3; i++) {
            w.n[i] = d[i] / sqrt(3.0);
            w.polarisation[i] = d[i] * g->A[i] * g->U0 / 16;
            along += w.polarisation[i] * w.n[i];
        }
        for (int i = 0; i < 3; i++) {
            w.polarisation[i] = transverse ? w.polarisation[i] - along * w.n[i] : along * w.n[i];
        }
        w.along = transverse ? 0 : along;
        w.speed = sqrt((transverse ? of.mu : p_modulus(&of)) / g->rho) * (backwards ? -1 : 1);
        add_plane_wave(&w, &of, g->rho, X, t, sum);
    }
    for (int i = 0; i < 3; i++) {
        sum->F[4 * i] += 1;
    }
}

static void initial(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    const struct given *g = &oracle->given;
    double x = PI * X[0] / 2, y = PI * X[1] / 2, z = PI * X[2] / 2;
    u[0] = g->U0 * g->A[0] * sin(x) * cos(y) * cos(z);
    u[1] = g->U0 * g->A[1] * cos(x) * sin(y) * cos(z);
    u[2] = g->U0 * g->A[2] * cos(x) * cos(y) * sin(z);
    v[0] = v[1] = v[2] = 0;
}

static size_t check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line, size_t size)
{
    const struct given *g = &oracle->given;
    struct moduli of = moduli(g);
    double kappa = plane_wave_number();
    struct self_check laws = {.kind = kind,
                              .oracle = oracle,
                              .upper = {SIDE, SIDE, SIDE},
                              .wave_number = PI / (2 * SIDE),
                              .frequency = kappa * sqrt(p_modulus(&of) / g->rho),
                              .t_end = 4 * PI / (kappa * sqrt(of.mu / g->rho)), /* two periods of the slower wave */
                              .bulk = of.bulk,
                              .mu = of.mu,
                              .rho = g->rho,
                              .line = line,
                              .size = size};
    self_check_differentials(&laws);
    self_check_starts(&laws, initial);
    for (int axis = 0; axis < 3; axis++) {
        bool normal[3] = {axis == 0, axis == 1, axis == 2}, tangential[3] = {axis != 0, axis != 1, axis != 2};
        self_check_face(&laws, axis, false, normal);
        self_check_face(&laws, axis, true, tangential);
    }
    self_check_compare(&laws, plane_waves, 16 * self_check_round_off(&laws));
    self_check_energies(&laws);
    return laws.count;
}

const struct oracle_kind oracle_swinging_cube = {
    .name = "swinging-cube",
    .summary = "standing p- and s-waves in a unit cube with symmetric and skew-symmetric faces",
    .source = "000_e9ec29e1bde7947d.txt, section 7.1.1, generalised to any A, B, C",
    .dim = 3,
    .smoothness = ORACLE_SMOOTH,
    .parameter = parameters,
    .create = create,
    .destroy = oracle_release,
    .state = state,
    .outside = outside,
    .energy = energy,
    .check = check,
};
