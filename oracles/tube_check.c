/* The second evaluation of the tube's motion solves no equation of motion. Energy is kept,
 *
 *     w^2 L(y) + y^2 E(y) = c,   L = ln(outer radius / inner), y^2 E the strain energy,
 *
 * so y sqrt(E) = sqrt(c) sin(phase), w sqrt(L) = sqrt(c) cos(phase) and dt = sqrt(L E) / (E + d(y E)/dy) d phase, which
 * is smooth where the tube turns and w has a square root. At the phases chosen y is a root, and the time a sum of Gauss
 * rules. The stress is integrated through the wall by Gauss rules from the outer face, the self-check's other end. */
#include "oracles/root.h"
#include "oracles/self_check_parts.h"
#include "oracles/tube.h"

#include <float.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
enum { INSTANTS = 16, POINTS = 32, PHASES = 64, LAYERS = 8, SAMPLES = 64 };

struct phased {
    double wall, root_energy; /* sqrt(c) */
    double phase;
    double y, w, acceleration;
};

static double kinetic_factor(double wall, double y)
{
    return log1p(wall / (1 + y)) / 2;
}

/* E, and the slope of y E. */
static double strain_factor(double wall, double y, double *slope)
{
    double part = wall / (1 + wall + y), x = part * y;
    *slope = part / (2 * (1 + y));
    return part / 2 * (x == 0 ? 1 : log1p(x) / x);
}

static double root_strain(double wall, double y)
{
    double slope;
    return y * sqrt(strain_factor(wall, y, &slope));
}

static double off_phase(double z, void *context)
{
    const struct phased *of = context;
    return root_strain(of->wall, expm1(z)) - of->root_energy * sin(of->phase);
}

/* False if there is no root: far outside the interval of the oracle, at an end of which the tube may turn. */
static bool set_phase(struct phased *at, double phase)
{
    const double most = 2 * log(2 * TUBE_STRETCH);
    double z = 0, slope;
    at->phase = phase;
    if (sin(phase) * at->root_energy != 0 && !root_between(off_phase, at, -most, most, &z)) {
        return false;
    }
    at->y = expm1(z);
    double L = kinetic_factor(at->wall, at->y), E = strain_factor(at->wall, at->y, &slope);
    at->w = at->root_energy * cos(phase) / sqrt(L);
    double drag = -at->wall / (2 * (1 + at->y) * (1 + at->wall + at->y)); /* dL/dy */
    at->acceleration = -(at->w * at->w * drag + at->y * (E + slope)) / L;
    return true;
}

static double time_over_phase(const struct phased *at)
{
    double slope, E = strain_factor(at->wall, at->y, &slope);
    return sqrt(kinetic_factor(at->wall, at->y) * E) / (E + slope);
}

/* The phase at t = 0. */
static struct phased start(const struct tube *g)
{
    double A = g->body.inner, y = (g->stretch - 1) * (g->stretch + 1),
           w = g->stretch * g->velocity / sqrt(g->mu / g->rho);
    struct phased at = {.wall = (g->body.outer - A) / A * ((g->body.outer + A) / A)};
    double kinetic = w * sqrt(kinetic_factor(at.wall, y)), strain = root_strain(at.wall, y);
    at.root_energy = hypot(kinetic, strain);
    at.phase = at.root_energy == 0 ? 0 : atan2(strain, kinetic);
    at.y = y;
    at.w = w;
    return at;
}

/* Two periods, at a number of times that are not alike in both. */
struct timetable {
    double time[INSTANTS]; /* [s] */
    struct phased at[INSTANTS];
    double period;         /* in A / speed */
    double fastest, least; /* largest rate of z, of all its derivatives; smallest inner radius */
    bool known;
};

static void tabulate(const struct tube *g, struct timetable *table)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(POINTS);
    struct phased first = start(g), at = first;
    double t = 0, stride = 4 * PI / (INSTANTS - 1);
    table->known = rule != NULL;
    for (int i = 0; i < INSTANTS && table->known; i++) {
        double phase = first.phase + i * stride;
        for (size_t n = 0; n < POINTS && i > 0; n++) {
            double here, weight;
            (void)gsl_integration_glfixed_point(phase - stride, phase, n, &here, &weight, rule);
            table->known = table->known && set_phase(&at, here);
            t += weight * time_over_phase(&at);
        }
        table->known = table->known && set_phase(&at, phase);
        table->at[i] = at;
        table->time[i] = t * (g->body.inner / sqrt(g->mu / g->rho));
    }
    table->period = t / 2;
    if (rule != NULL) {
        gsl_integration_glfixed_table_free(rule);
    }
}

/* What the differences must resolve. */
static void measure(struct timetable *table)
{
    struct phased at = table->at[0];
    table->fastest = 0;
    table->least = 1;
    for (int i = 0; i < PHASES && table->known; i++) {
        table->known = set_phase(&at, 2 * PI * i / PHASES);
        double fall = 2 / (1 + at.y), rate = fall * at.w;
        double all = fabs(rate) + sqrt(fabs(fall * at.acceleration - rate * rate));
        table->fastest = fmax(table->fastest, all);
        table->least = fmin(table->least, sqrt(1 + at.y));
    }
}

/* P = mu F - p F^-T, p by way of P_zz = mu - p, and F^-T the cofactors, without the unit matrix of either. */
static void neo_hooke(const struct self_check *check, const double X[3], double t, const double G[9], double P[9])
{
    struct oracle_state state;
    check->kind->state(check->oracle, X, t, &state);
    double less[9] = {G[4], -G[3], 0, -G[1], G[0], 0, 0, 0, 0}; /* F^-T - I */
    for (int i = 0; i < 9; i++) {
        double unit = i % 4 == 0 ? 1 : 0;
        P[i] = check->mu * (G[i] - less[i]) + state.P[8] * (unit + less[i]);
    }
}

/* mu/2 (l - 1/l)^2 of the stretch l, by way of mu (l^2 - 1/l^2), the difference of the stresses in the plane. */
static double neo_hooke_energy(const struct self_check *check, const double X[3], double t,
                               const struct oracle_state *state)
{
    (void)X, (void)t;
    double sigma[9];
    for (int i = 0; i < 9; i++) {
        const double *P = state->P + (ptrdiff_t)(i / 3) * 3, *F = state->F + (ptrdiff_t)(i % 3) * 3;
        sigma[i] = (P[0] * F[0] + P[1] * F[1] + P[2] * F[2]) / check->mu;
    }
    double difference = hypot(sigma[0] - sigma[4], sigma[1] + sigma[3]);
    return check->mu / 2 * difference * difference / (2 + hypot(2, difference));
}

/* The radial stress, in mu, from the outer face inwards, along the logarithm of r where the tube is narrower than in
 * the reference and of R where it is wider: the integrand is smooth over that. */
static double layered_stress(const struct phased *at, double wall_radius, double R)
{
    bool deformed = at->y < 0;
    double lower = deformed ? sqrt(R * R + at->y) : R, sum = 0, step;
    double upper = deformed ? sqrt(wall_radius * wall_radius + at->y) : wall_radius;
    step = log(upper / lower) / LAYERS;
    for (int i = 0; i < LAYERS * SELF_CHECK_NODES; i++) {
        int layer = i / SELF_CHECK_NODES;
        double weight, node = self_check_node(i % SELF_CHECK_NODES, &weight);
        double here = lower * exp(step * (layer + (1 + node) / 2));
        double R2 = deformed ? here * here - at->y : here * here, r2 = R2 + at->y;
        double inertia = at->acceleration - at->w * at->w / r2, hoop = at->y * (1 / R2 + 1 / r2);
        double slope = (inertia + hoop) * (deformed ? 1 : R2 / r2);
        sum -= weight * step / 2 * slope;
    }
    return sum;
}

static void second(const struct self_check *check, const double X[3], double t, struct oracle_state *state)
{
    const struct tube *g = &check->oracle->given;
    const struct timetable *table = check->with;
    int i = 0;
    while (i < INSTANTS - 1 && table->time[i] != t) {
        i++;
    }
    const struct phased *at = &table->at[i];
    double A = g->body.inner, R = sqrt(X[0] * X[0] + X[1] * X[1]), r = sqrt(R * R + A * A * at->y);
    double c = X[0] / R, s = X[1] / R, turn[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
    double moved = A * A * at->y / (r + R), v = A * at->w * sqrt(g->mu / g->rho) / r;
    double radial = layered_stress(at, g->body.outer / A, R / A);
    double stress[3] = {radial, radial + at->y * (A / R * (A / R) + A / r * (A / r)),
                        radial + at->y * (A / r * (A / r))};
    double stretch[3] = {R / r, r / R, 1}, strain[3] = {-moved / r, moved / R, 0};
    memset(state, 0, sizeof *state);
    for (int k = 0; k < 2; k++) {
        state->u[k] = moved * turn[3 * k];
        state->v[k] = v * turn[3 * k];
        state->p[k] = g->rho * state->v[k];
    }
    for (int k = 0; k < 9; k++) {
        double G = 0;
        for (int m = 0; m < 3; m++) {
            double pair = turn[3 * (k / 3) + m] * turn[3 * (k % 3) + m];
            G += strain[m] * pair;
            state->P[k] += g->mu * stress[m] / stretch[m] * pair;
        }
        state->F[k] = (k % 4 == 0 ? 1 : 0) + G;
    }
}

static void initial(const struct oracle *oracle, const double X[3], double u[3], double v[3])
{
    const struct tube *g = &oracle->given;
    double A = g->body.inner, R = hypot(X[0], X[1]), q = A * A * (g->stretch - 1) * (g->stretch + 1),
           r = sqrt(R * R + q);
    for (int i = 0; i < 3; i++) {
        double n = i < 2 ? X[i] / R : 0;
        u[i] = q / (r + R) * n;
        v[i] = g->stretch * A * g->velocity / r * n;
    }
}

/* Nothing is compressed, at any strain. */
static void volume(struct self_check *check)
{
    double changed = 0;
    for (size_t i = 0; i < SAMPLES; i++) {
        struct oracle_state state;
        struct self_check_spot spot = self_check_sample(check, i, 0);
        check->kind->state(check->oracle, spot.X, spot.t, &state);
        double size = 1;
        self_check_largest(&size, state.F, 9);
        changed = self_check_worse(changed, fabs(oracle_jacobian(&state) - 1) / (size * size));
    }
    self_check_line(check, "det F = 1", changed, 8 * DBL_EPSILON);
}

size_t tube_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line, size_t size)
{
    static const struct self_check_material material = {"P = mu F - p F^-T", neo_hooke, neo_hooke_energy};
    const struct tube *g = &oracle->given;
    double A = g->body.inner, rate = sqrt(g->mu / g->rho) / A;
    struct timetable table;
    tabulate(g, &table);
    measure(&table);
    /* Near a closed tube fields go as powers of the radius and of the time to its closing: steps are 1/100 of that. */
    double reach = fmin(1, table.least * table.least / 2);
    double own = 2 * PI / table.period;
    struct self_check laws = {.kind = kind,
                              .oracle = oracle,
                              .shell = &g->body,
                              .material = &material,
                              .with = &table,
                              .instant = table.time,
                              .instants = INSTANTS,
                              .wave_number = fmax(6 / (reach * A), 1 / (g->body.outer - A)),
                              .frequency = 2.5 * (own + table.fastest) * rate,
                              .t_end = 2 * table.period / rate,
                              .mu = g->mu,
                              .rho = g->rho,
                              .line = line,
                              .size = size};
    if (!table.known) {
        return 0;
    }
    double bound = 16 * self_check_round_off(&laws);
    self_check_differentials(&laws);
    volume(&laws);
    self_check_starts(&laws, initial);
    self_check_free_surfaces(&laws, bound);
    self_check_compare(&laws, second, bound);
    self_check_energies(&laws);
    return laws.count;
}
