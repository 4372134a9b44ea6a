/* Jets and the motions written in them: derivatives against differences of what they are derivatives of, and what
 * motions promise of volumes. */
#include "oracles/motion.h"
#include "tests/unit/unit.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { SAMPLES = 50, REACH = 4 };

/* Central differences of eighth order. */
static const double weight[REACH] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};

/* f(x0, x1, x2, x3), every operation of jets in it. */
static struct jet formula(const double at[4])
{
    struct jet x[4];
    for (int i = 0; i < 4; i++) {
        x[i] = jet_variable(at[i], i);
    }
    struct jet inner = jet_add(jet_multiply(x[0], x[1]), jet_sin(jet_scale(0.7, x[2], 0.1)));
    struct jet outer = jet_exp(jet_combine(0.3, x[3], -0.2, inner));
    struct jet over = jet_multiply(jet_log(outer), jet_reciprocal(jet_scale(1.0, outer, 2.0)));
    return jet_add(jet_multiply(jet_cos(inner), jet_add(outer, jet_constant(1.5))), over);
}

static void jets_hold_derivatives(void)
{
    static const double at[4] = {0.3, -0.8, 1.1, 0.4};
    const double step = 0.02;
    struct jet f = formula(at);
    for (int i = 0; i < 4; i++) {
        double slope = 0, slopes[4] = {0};
        for (int k = 1; k <= REACH; k++) {
            for (int side = -1; side <= 1; side += 2) {
                double there[4];
                memcpy(there, at, sizeof there);
                there[i] += side * k * step;
                struct jet g = formula(there);
                slope += side * weight[k - 1] / step * g.value;
                for (int j = 0; j < 4; j++) {
                    slopes[j] += side * weight[k - 1] / step * g.first[j];
                }
            }
        }
        CU_ASSERT_DOUBLE_EQUAL(f.first[i], slope, 1e-12);
        for (int j = 0; j < 4; j++) {
            CU_ASSERT_DOUBLE_EQUAL(jet_second(f, i, j), slopes[j], 1e-12);
            CU_ASSERT_EQUAL(jet_second(f, i, j), jet_second(f, j, i));
        }
    }
}

static double sequence(int i, int base)
{
    double value = 0, part = 1;
    for (int rest = i + 1; rest > 0; rest /= base) {
        part /= base;
        value += part * (rest % base);
    }
    return value;
}

static void sample(int i, int dim, const struct oracle_motion_shape *shape, double at[4])
{
    static const int base[4] = {2, 3, 5, 7};
    for (int axis = 0; axis < 4; axis++) {
        at[axis] = sequence(i, base[axis]) * (axis == 3 ? shape->period : axis < dim ? shape->L : 0);
    }
}

/* Relative to the largest of the kind at the sample. */
static void compare(double exact, double difference, double size)
{
    CU_ASSERT_DOUBLE_EQUAL(exact, difference, 2e-9 * size);
}

static void check_derivatives(const struct oracle_motion *motion, const struct oracle_motion_shape *shape, int dim,
                              const double at[4])
{
    struct oracle_kinematics here, there;
    oracle_motion_at(motion, shape, dim, at, at[3], &here);
    for (int axis = 0; axis < 4; axis++) {
        if (axis >= dim && axis < 3) {
            continue;
        }
        double scale = axis == 3 ? shape->period : shape->L, step = 0.005 * scale;
        double du[3] = {0}, dv[3] = {0}, dF[9] = {0};
        for (int k = 1; k <= REACH; k++) {
            for (int side = -1; side <= 1; side += 2) {
                double moved[4];
                memcpy(moved, at, sizeof moved);
                moved[axis] += side * k * step;
                oracle_motion_at(motion, shape, dim, moved, moved[3], &there);
                for (int i = 0; i < 9; i++) {
                    dF[i] += side * weight[k - 1] / step * there.F[i];
                    du[i % 3] += i < 3 ? side * weight[k - 1] / step * there.u[i] : 0;
                    dv[i % 3] += i < 3 ? side * weight[k - 1] / step * there.v[i] : 0;
                }
            }
        }
        for (int i = 0; i < 3; i++) {
            if (axis == 3) {
                compare(here.v[i], du[i], shape->L / scale);
                compare(here.a[i], dv[i], 10 * shape->L / (scale * scale));
            } else {
                compare(here.F[3 * i + axis] - (i == axis ? 1 : 0), du[i], 1);
                for (int I = 0; I < 3; I++) {
                    compare(here.dF[i][I][axis], dF[3 * i + I], 10 / scale);
                }
            }
        }
    }
}

static void motions_hold_derivatives(void)
{
    for (const struct oracle_motion *motion = oracle_motions(); motion->name != NULL; motion++) {
        for (int dim = motion->least_dim; dim <= 3; dim++) {
            struct oracle_motion_shape shape = {.L = 0.02, .period = 3e-4, .amplitude = motion->typical};
            for (int i = 0; i < SAMPLES; i++) {
                double at[4];
                sample(i, dim, &shape, at);
                check_derivatives(motion, &shape, dim, at);
            }
        }
    }
}

static double determinant(const double F[9])
{
    return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/* Up to the largest amplitude the body stays whole; axes that it does not have stay at rest. */
static void volumes_are_as_promised(void)
{
    for (const struct oracle_motion *motion = oracle_motions(); motion->name != NULL; motion++) {
        for (int dim = motion->least_dim; dim <= 3; dim++) {
            struct oracle_motion_shape shape = {.L = 1, .period = 1, .amplitude = motion->most};
            for (int i = 0; i < 100 * SAMPLES; i++) {
                double at[4];
                struct oracle_kinematics here;
                sample(i, dim, &shape, at);
                oracle_motion_at(motion, &shape, dim, at, at[3], &here);
                double J = determinant(here.F);
                CU_ASSERT(J > 0.3);
                CU_ASSERT(!motion->isochoric || fabs(J - 1) < 64 * DBL_EPSILON);
                for (int axis = dim; axis < 3; axis++) {
                    CU_ASSERT(here.u[axis] == 0 && here.v[axis] == 0 && here.F[4 * axis] == 1);
                }
            }
        }
    }
}

/* Each is what it is for: something varies along every axis, in every component. */
static void nothing_is_left_out(void)
{
    for (const struct oracle_motion *motion = oracle_motions(); motion->name != NULL; motion++) {
        for (int dim = motion->least_dim; dim <= 3; dim++) {
            struct oracle_motion_shape shape = {.L = 1, .period = 1, .amplitude = motion->typical};
            struct oracle_kinematics here;
            oracle_motion_at(motion, &shape, dim, (double[3]){0.3, 0.4, 0.6}, 0.17, &here);
            for (int axis = 0; axis < dim; axis++) {
                double curvature = 0;
                for (int i = 0; i < 9; i++) {
                    curvature += fabs(here.dF[i / 3][i % 3][axis]);
                }
                CU_ASSERT(curvature > 1e-3 * motion->typical);
                CU_ASSERT(fabs(here.a[axis]) > 1e-3 * motion->typical);
            }
        }
    }
}

/* The body turns where it is: the middle of its cross section stays. */
static void the_middle_stays(void)
{
    const struct oracle_motion *stretch = &oracle_motions()[1];
    struct oracle_motion_shape shape = {.L = 2, .period = 1, .amplitude = 1};
    struct oracle_kinematics here;
    CU_ASSERT_STRING_EQUAL_FATAL(stretch->name, "stretch");
    for (double t = 0; t < 1; t += 0.07) {
        oracle_motion_at(stretch, &shape, 3, (double[3]){1, 1, 2 * t}, t, &here);
        CU_ASSERT_DOUBLE_EQUAL(here.u[0], 0, 1e-15);
        CU_ASSERT_DOUBLE_EQUAL(here.u[1], 0, 1e-15);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"jets hold first and second derivatives", jets_hold_derivatives},
        {"motions hold their own derivatives", motions_hold_derivatives},
        {"volumes are as promised", volumes_are_as_promised},
        {"every axis and component is moved", nothing_is_left_out},
        {"what turns stays where it is", the_middle_stays},
    };
    return unit_main("motion", tests, sizeof tests / sizeof *tests);
}
