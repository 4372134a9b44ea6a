#include "oracles/plate_check.h"

#include <float.h>
#include <math.h>

static const double PI = 3.14159265358979323846;

enum { SAMPLES = 64, TIMES = 8 };

void plate_check_starts(struct self_check *check, const struct plate *plate)
{
    double moved = 0, tip[3] = {plate->length, 0, 0};
    struct oracle_state state;
    for (size_t i = 0; i < SAMPLES; i++) {
        struct self_check_spot spot = self_check_sample_at(check, i, 0);
        check->kind->state(check->oracle, spot.X, 0, &state);
        self_check_largest(&moved, state.u, 3);
    }
    check->kind->state(check->oracle, tip, 0, &state);
    self_check_line(check, "initial displacement", self_check_relative(moved, check->of.u), 16 * DBL_EPSILON);
    self_check_line(check, "initial velocity of the tip",
                    self_check_relative(fabs(state.v[1] - plate->tip_velocity), check->of.v), 16 * DBL_EPSILON);
}

void plate_check_energies(struct self_check *check, plate_quadrature *quadrature, double bound)
{
    double eighth = PI / (4 * check->frequency);
    struct self_check_distance total = {0};
    struct plate_energies first, given, summed = quadrature(check, eighth);
    check->kind->energy(check->oracle, 0, &first.kinetic, &first.strain);
    double whole = first.kinetic + first.strain;
    for (size_t i = 0; i < TIMES; i++) {
        check->kind->energy(check->oracle, self_check_sequence(i, 3) * check->t_end, &given.kinetic, &given.strain);
        double sum = given.kinetic + given.strain;
        self_check_measure(&total, &sum, &whole, 1);
    }
    check->kind->energy(check->oracle, eighth, &given.kinetic, &given.strain);
    self_check_line(check, "total energy constant", self_check_relative(total.error, whole), 64 * DBL_EPSILON);
    self_check_line(check, "kinetic energy = quadrature",
                    self_check_relative(fabs(given.kinetic - summed.kinetic), whole), bound);
    self_check_line(check, "strain energy = quadrature", self_check_relative(fabs(given.strain - summed.strain), whole),
                    2 * bound);
    self_check_line(check, "Rayleigh quotient = frequency^2",
                    self_check_relative(fabs(summed.strain - summed.kinetic), summed.kinetic), 4 * bound);
}
