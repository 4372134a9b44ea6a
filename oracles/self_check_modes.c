#include "oracles/self_check_parts.h"

#include <math.h>

struct mode {
    double k, X0;
};

static void project(const struct self_check_body *body, const struct oracle_state *state, const double X[3],
                    const void *with, double weight, double sum[SELF_CHECK_SUMS])
{
    const struct mode *mode = with;
    double phase = mode->k * (X[0] - mode->X0), share = 2 * weight / (body->upper[0] - body->lower[0]);
    sum[0] += share * cos(phase) * state->u[0];
    sum[1] += share * cos(phase) * state->v[0];
    sum[2] -= share * sin(phase) * state->P[0] / (self_check_modulus(body) * mode->k);
}

void self_check_mode(const struct self_check *check, const struct self_check_body *body, double t, double k, double X0,
                     double amplitude[3])
{
    const struct mode mode = {k, X0};
    double longest = fmin(self_check_radian(check, body), 1 / k);
    self_check_integrate(check, body, t, longest, project, &mode, amplitude);
}

void self_check_mode_lines(struct self_check *check, const struct self_check_distance of[3], double frequency)
{
    double bound = 64 * self_check_round_off(check) * fmax(1, frequency / check->frequency);
    self_check_line(check, "modal series: u", self_check_relative(of[0].error, of[0].size), bound);
    self_check_line(check, "modal series: v", self_check_relative(of[1].error, of[1].size), bound);
    self_check_line(check, "modal series: P", self_check_relative(of[2].error, of[2].size), bound);
}
