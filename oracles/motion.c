#include "oracles/motion.h"

#include <string.h>

/* Logarithm of the stretch of the motion "stretch" at amplitude 1, without its ripple. */
static const double STRETCH = 0.55;

/* k X + phase, with half a wave over the length L */
static struct jet half_waves(const struct oracle_motion_shape *shape, struct jet X, double count, double phase)
{
    return jet_scale(count * M_PI / shape->L, X, phase);
}

/* sin or cos of 2 pi t / period + phase */
static struct jet swing(const struct oracle_motion_shape *shape, struct jet t, double phase)
{
    return jet_sin(jet_scale(2.0 * M_PI / shape->period, t, phase));
}

/* u_i = A L sin(pi X_i / L + phase_i) prod_{j != i} cos(pi X_j / L + phase_j) sin(2 pi t / T + phase): no symmetry to
 * hide behind, nothing vanishes on a face, and no component is another one's image. */
static void displace_waves(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                           struct jet u[3])
{
    static const double phase[3] = {0.3, 0.7, 1.1};
    static const double size[3] = {1.0, 0.8, 0.6};
    for (int i = 0; i < dim && i < 3; i++) {
        struct jet wave = swing(shape, t, 0.4 + 0.3 * i);
        for (int j = 0; j < dim && j < 3; j++) {
            struct jet angle = half_waves(shape, X[j], 1.0, phase[j]);
            wave = jet_multiply(wave, i == j ? jet_sin(angle) : jet_cos(angle));
        }
        u[i] = jet_scale(size[i] * shape->amplitude * shape->L, wave, 0.0);
    }
}

/* Turns (x, y) by an angle. */
static void turn(struct jet angle, struct jet *x, struct jet *y)
{
    struct jet c = jet_cos(angle);
    struct jet s = jet_sin(angle);
    struct jet across = *x;
    *x = jet_combine(1.0, jet_multiply(c, across), -1.0, jet_multiply(s, *y));
    *y = jet_add(jet_multiply(s, across), jet_multiply(c, *y));
}

/* Along the last axis the body is stretched to and fro, more at one place than at another along every axis; across it,
 * it narrows by the root of that, and it turns about the axis through (L/2, L/2), by an angle that grows along it in 3D
 * and while it bends in 2D. */
static void displace_stretch(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                             struct jet u[3])
{
    int axis = dim - 1;
    double L = shape->L;
    struct jet x[3] = {X[0], X[1], X[2]};
    struct jet s = swing(shape, t, 0.0);
    struct jet angle = jet_scale(0.5 * shape->amplitude, swing(shape, t, 0.6), 0.0);
    struct jet stretch = jet_exp(jet_scale(STRETCH * shape->amplitude, s, 0.0));
    struct jet narrow = jet_exp(jet_scale(-0.5 * STRETCH * shape->amplitude, s, 0.0));
    struct jet ripple = jet_multiply(s, jet_sin(half_waves(shape, X[axis], 1.0, 0.3)));
    for (int i = 0; i < axis; i++) {
        ripple = jet_multiply(ripple, jet_cos(half_waves(shape, X[i], 1.0, 0.5 + 0.4 * i)));
    }
    x[axis] = jet_multiply(stretch, jet_combine(1.0, X[axis], 0.05 * shape->amplitude * L, ripple));
    for (int i = 0; i < axis; i++) {
        x[i] = jet_multiply(narrow, jet_scale(1.0, X[i], -0.5 * L));
    }
    if (dim == 2) {
        struct jet bend = jet_multiply(angle, jet_sin(half_waves(shape, X[1], 1.0, 0.2)));
        x[0] = jet_combine(1.0, x[0], 0.2 * L, bend);
    } else if (dim == 3) {
        angle = jet_multiply(angle, jet_scale(1.0 / L, X[2], 0.5));
    }
    if (dim > 1) {
        turn(angle, &x[0], &x[1]);
    }
    for (int i = 0; i < dim; i++) {
        u[i] = jet_combine(1.0, jet_scale(1.0, x[i], i < axis ? 0.5 * L : 0.0), -1.0, X[i]);
    }
}

/* Shears one after another, each by a function of where the others are by then: each keeps volumes, so all do. */
static void displace_isochoric(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                               struct jet u[3])
{
    for (int i = 0; i < dim; i++) {
        u[i] = jet_constant(0.0);
    }
    for (int i = 0; i < dim; i++) {
        int next = (i + 1) % dim;
        struct jet angle = half_waves(shape, jet_add(X[next], u[next]), 1.0, 0.3 + 0.4 * i);
        struct jet shear = jet_multiply(swing(shape, t, 0.3 + 0.5 * i), jet_sin(angle));
        u[i] = jet_scale(shape->amplitude * shape->L * (1.0 - 0.2 * i), shear, 0.0);
    }
}

/* Along each axis by its own power of where a particle is, lambda_i = (3/2 + X_i / L)^(a_i f), f growing in time: so
 * ln lambda = a_i f ln(3/2 + X_i / L), whose ratios stay what they are. And it turns about (L/2, L/2). */
static void displace_drawn(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                           struct jet u[3])
{
    static const double share[3] = {1.0, -0.8, -0.3};
    double L = shape->L;
    struct jet f = jet_scale(shape->amplitude / shape->period, t, 0.25 * shape->amplitude);
    struct jet x[3] = {X[0], X[1], X[2]};
    for (int i = 0; i < dim && i < 3; i++) {
        struct jet power = jet_scale(share[i], f, 1.0);
        struct jet of_place = jet_exp(jet_multiply(power, jet_log(jet_scale(1.0 / L, X[i], 1.5))));
        struct jet of_end = jet_exp(jet_scale(log(1.5), power, 0.0));
        x[i] = jet_scale(L, jet_multiply(jet_combine(1.0, of_place, -1.0, of_end), jet_reciprocal(power)), -0.5 * L);
    }
    if (dim > 1) {
        turn(jet_scale(0.3 * shape->amplitude, swing(shape, t, 0.4), 0.0), &x[0], &x[1]);
    }
    for (int i = 0; i < dim; i++) {
        u[i] = jet_combine(1.0, jet_scale(1.0, x[i], 0.5 * L), -1.0, X[i]);
    }
}

static const struct oracle_motion motions[] = {
    {.name = "waves",
     .summary = "standing waves along all axes",
     .amplitude = "largest displacement over L",
     .most = 0.1,
     .typical = 1e-2,
     .least_dim = 1,
     .displace = displace_waves},
    {.name = "stretch",
     .summary = "stretched to and fro along one axis, twisted about it",
     .amplitude = "1 stretches from 0.48 to 2.02 of the length",
     .most = 1.1,
     .typical = 1.0,
     .least_dim = 1,
     .displace = displace_stretch},
    {.name = "isochoric",
     .summary = "shears that keep every volume",
     .amplitude = "largest displacement over L",
     .most = 0.3,
     .typical = 0.1,
     .least_dim = 2,
     .isochoric = true,
     .displace = displace_isochoric},
    {.name = "drawn",
     .summary = "drawn out and pressed flat ever further, more at one place than at another, while it turns",
     .amplitude = "logarithmic strains along the first axis grow from 0.1 and 0.23 by 0.4 and 0.92 in a period",
     .most = 1.0,
     .typical = 1.0,
     .least_dim = 1,
     .proportional = true,
     .displace = displace_drawn},
    {.name = NULL},
};

const struct oracle_motion *oracle_motions(void)
{
    return motions;
}

void oracle_motion_at(const struct oracle_motion *motion, const struct oracle_motion_shape *shape, int dim,
                      const double X[3], double t, struct oracle_kinematics *at)
{
    enum { TIME = 3 };
    struct jet place[3], u[3];
    memset(at, 0, sizeof *at);
    for (int i = 0; i < 3; i++) {
        place[i] = i < dim ? jet_variable(X[i], i) : jet_constant(X[i]);
        at->F[4 * i] = 1.0;
    }
    motion->displace(shape, dim, place, jet_variable(t, TIME), u);
    for (int i = 0; i < dim; i++) {
        at->u[i] = u[i].value;
        at->v[i] = u[i].first[TIME];
        at->a[i] = jet_second(u[i], TIME, TIME);
        for (int I = 0; I < dim; I++) {
            at->F[3 * i + I] += u[i].first[I];
            for (int J = 0; J < dim; J++) {
                at->dF[i][I][J] = jet_second(u[i], I, J);
            }
        }
    }
}
