/* The self-check of the bimaterial wave by Fourier's modes. */
#include "oracles/bimaterial_wave_check.h"

#include <math.h>
#include <string.h>

enum { MODES = 8 };

/* Zero at the frequencies of the free bars: both bars' modes, cos, meet at the weld with one stress. */
static double frequency_condition(const struct bimaterial_problem *of, double w)
{
    double a = w * of->T1, b = w * of->T2;
    return (of->Z1 * sin(a) * cos(b) + of->Z2 * cos(a) * sin(b)) / (of->Z1 + of->Z2);
}

/* To the last digit. */
static double bisect(const struct bimaterial_problem *of, double lower, double upper)
{
    bool rises = frequency_condition(of, lower) < 0;
    for (;;) {
        double middle = lower + (upper - lower) / 2;
        if (!(middle > lower && middle < upper)) {
            return middle;
        }
        *((frequency_condition(of, middle) < 0) == rises ? &lower : &upper) = middle;
    }
}

/* One mode: cos(w X / c1) on the left, `right` cos(w (X - end) / c2) on the right. */
struct mode {
    double w, left, right;
};

struct mode_piece {
    double amplitude, k, X0;
};

/* Of rho times the mode squared, and of rho u, rho v and P on it and on its slope. */
static void project(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                    const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    const struct mode_piece *piece = with;
    double phase = piece->k * (X[0] - piece->X0);
    double shape = piece->amplitude * cos(phase), slope = -piece->amplitude * piece->k * sin(phase);
    sum[0] += weight * body->rho * shape * state->u[0];
    sum[1] += weight * body->rho * shape * state->v[0];
    sum[2] += weight * slope * state->P[0];
}

static void amplitudes(const struct bimaterial_problem *of, const struct mode *mode, double t, double q[3])
{
    const struct bimaterial_wave_given *g = of->given;
    const struct mode_piece piece[2] = {{mode->left, mode->w / of->c1, 0},
                                        {mode->right, mode->w / of->c2, g->L1 + g->L2}};
    memset(q, 0, 3 * sizeof *q);
    for (int i = 0; i < 2; i++) {
        struct self_check_body body = self_check_body(of->check, i);
        double sum[SELF_CHECK_SUMS], longest = fmin(self_check_radian(of->check, &body), 1 / piece[i].k);
        self_check_integrate(of->check, &body, t, longest, project, &piece[i], sum);
        q[0] += sum[0];
        q[1] += sum[1];
        q[2] += sum[2] / (mode->w * mode->w); /* of P = E u', as the mode's own stress integrates to w^2 */
    }
}

/* What is left swinging may be little of what went in: round-off is that of a mode with all the energy. */
static void swing(const struct bimaterial_problem *of, const struct mode *mode, struct self_check_distance distance[3])
{
    const struct bimaterial_wave_given *g = of->given;
    double mass = (g->rho1 * g->L1 * mode->left * mode->left + g->rho2 * g->L2 * mode->right * mode->right) / 2;
    double momentum = sqrt(2 * of->drive.most_work * mass), start = g->t1, first[3];
    amplitudes(of, mode, start, first);
    for (int n = 0; n < 3; n++) {
        distance[n].size = self_check_worse(n == 1 ? momentum : momentum / mode->w, distance[n].size);
    }
    for (size_t i = 0; i < 6; i++) {
        double t = start + (of->check->t_end - start) * self_check_sequence(i, 3), phase = mode->w * (t - start), q[3];
        amplitudes(of, mode, t, q);
        double u = first[0] * cos(phase) + first[1] / mode->w * sin(phase);
        double expected[3] = {u, first[1] * cos(phase) - first[0] * mode->w * sin(phase), u};
        for (int n = 0; n < 3; n++) {
            self_check_measure(&distance[n], &q[n], &expected[n], 1);
        }
    }
}

/* The lowest modes, by sign changes of the condition; two that lie within one step are both passed over. */
void bimaterial_check_modes(const struct bimaterial_problem *of)
{
    struct self_check_distance distance[3] = {0};
    double step = asin(1.0) / (16 * (of->T1 + of->T2));
    double fastest = 0;
    int found = 0;
    for (int i = 0; i < 4096 && found < MODES; i++) {
        double w = (i + 0.5) * step, lower = frequency_condition(of, w);
        double upper = frequency_condition(of, w + step);
        if (lower * upper < 0) {
            struct mode mode = {.w = bisect(of, w, w + step), .left = 1};
            double a = mode.w * of->T1, b = mode.w * of->T2;
            /* one displacement at the weld, or, where both have a node there, one stress */
            bool node = fabs(cos(b)) < 0.5;
            mode.right = node ? -of->Z1 * sin(a) / (of->Z2 * sin(b)) : cos(a) / cos(b);
            double size = fmax(1, fabs(mode.right));
            mode.left /= size;
            mode.right /= size;
            swing(of, &mode, distance);
            fastest = mode.w;
            found++;
        }
    }
    self_check_mode_lines(of->check, distance, fastest);
}
