#include "oracles/motion.h"

#include <string.h>

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
static void place_waves(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                        struct jet x[3])
{
    static const double phase[3] = {0.3, 0.7, 1.1};
    static const double size[3] = {1.0, 0.8, 0.6};
    for (int i = 0; i < dim; i++) {
        struct jet wave = swing(shape, t, 0.4 + 0.3 * i);
        for (int j = 0; j < dim; j++) {
            struct jet angle = half_waves(shape, X[j], 1.0, phase[j]);
            wave = jet_multiply(wave, i == j ? jet_sin(angle) : jet_cos(angle));
        }
        x[i] = jet_combine(1.0, X[i], size[i] * shape->amplitude * shape->L, wave);
    }
}

/* Along the last axis z the body is stretched by 2^(A s(t)) and back, more at one place than at another; across it, it
 * narrows by the root of that and turns about the axis through (L/2, L/2) by an angle that grows with Z (3D), or is
 * sheared and turned as a whole (2D). */
static void place_stretch(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                          struct jet x[3])
{
    int axis = dim - 1;
    double L = shape->L;
    struct jet s = swing(shape, t, 0.0);
    struct jet stretch = jet_exp(jet_scale(0.8 * log(2.0) * shape->amplitude, s, 0.0));
    struct jet ripple = jet_multiply(s, jet_sin(half_waves(shape, X[axis], 1.0, 0.3)));
    x[axis] = jet_multiply(stretch, jet_combine(1.0, X[axis], 0.05 * shape->amplitude * L, ripple));
    if (dim == 1) {
        return;
    }
    struct jet narrow = jet_exp(jet_scale(-0.4 * log(2.0) * shape->amplitude, s, 0.0));
    struct jet across = jet_multiply(narrow, jet_scale(1.0, X[0], -0.5 * L));
    struct jet turn = jet_scale(0.5 * shape->amplitude, swing(shape, t, 0.6), 0.0);
    if (dim == 2) {
        struct jet bend = jet_multiply(turn, jet_sin(half_waves(shape, X[1], 1.0, 0.2)));
        struct jet y = x[1];
        across = jet_combine(1.0, across, 0.3 * L, bend);
        x[0] = jet_combine(1.0, jet_multiply(jet_cos(turn), across), -1.0, jet_multiply(jet_sin(turn), y));
        x[1] = jet_add(jet_multiply(jet_sin(turn), across), jet_multiply(jet_cos(turn), y));
        return;
    }
    struct jet other = jet_multiply(narrow, jet_scale(1.0, X[1], -0.5 * L));
    struct jet angle = jet_multiply(turn, jet_scale(1.0 / L, X[2], 0.5));
    x[0] = jet_combine(1.0, jet_multiply(jet_cos(angle), across), -1.0, jet_multiply(jet_sin(angle), other));
    x[1] = jet_add(jet_multiply(jet_sin(angle), across), jet_multiply(jet_cos(angle), other));
}

/* Shears one after another, each by a function of the others' places now: every one keeps volumes, so all do. */
static void place_isochoric(const struct oracle_motion_shape *shape, int dim, const struct jet X[3], struct jet t,
                            struct jet x[3])
{
    double size = shape->amplitude * shape->L;
    for (int i = 0; i < dim; i++) {
        int next = (i + 1) % dim;
        struct jet angle = half_waves(shape, x[next], 1.0, 0.3 + 0.4 * i);
        struct jet shear = jet_multiply(swing(shape, t, 0.3 + 0.5 * i), jet_sin(angle));
        x[i] = jet_combine(1.0, x[i], size * (1.0 - 0.2 * i), shear);
    }
    (void)X;
}

static const struct oracle_motion motions[] = {
    {.name = "waves",
     .summary = "standing waves along all axes",
     .amplitude = "displacement over L",
     .most = 0.1,
     .typical = 1e-6,
     .least_dim = 1,
     .place = place_waves},
    {.name = "stretch",
     .summary = "stretched to and fro along one axis, twisted about it",
     .amplitude = "1: stretches from 0.5 to 2",
     .most = 1.1,
     .typical = 1.0,
     .least_dim = 1,
     .place = place_stretch},
    {.name = "isochoric",
     .summary = "shears that keep every volume",
     .amplitude = "displacement over L",
     .most = 0.5,
     .typical = 0.1,
     .least_dim = 2,
     .isochoric = true,
     .place = place_isochoric},
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
    struct jet place[3], x[3];
    memset(at, 0, sizeof *at);
    for (int i = 0; i < 3; i++) {
        place[i] = i < dim ? jet_variable(X[i], i) : jet_constant(X[i]);
        x[i] = place[i];
        at->F[4 * i] = 1.0;
    }
    motion->place(shape, dim, place, jet_variable(t, TIME), x);
    for (int i = 0; i < 3; i++) {
        at->x[i] = x[i].value;
        at->v[i] = x[i].first[TIME];
        at->a[i] = jet_second(x[i], TIME, TIME);
        for (int I = 0; I < dim && i < dim; I++) {
            at->F[3 * i + I] = x[i].first[I];
            for (int J = 0; J < dim; J++) {
                at->dF[i][I][J] = jet_second(x[i], I, J);
            }
        }
    }
}
