#include "solver/meeting.h"

#include <math.h>

/* A particle held by its neighbours alone swings with omega^2 = k / m, k a sum of their moduli lambda + 2 mu. On a line
 * of one material omega h is c / sqrt(2), where the fastest mode has c: so what counts is half the neighbours' mean
 * modulus over a particle's own density. Returns the square root of the largest over c^2 of the fastest wave, or 1,
 * which it is where a particle on the interface, of both sides' mean density and compliance, hides them from each
 * other. */
double solver_meeting_share(const struct solver_body *body, const size_t *row, const uint32_t *neighbour,
                            solver_meeting_weight *weight, const void *context)
{
    const struct solver_material_constants *constants = body->constants;
    double fastest = 0.0;
    double meeting = 0.0;
    for (size_t a = 0; a < body->cloud->count; a++) {
        double sum = 0.0;
        double weights = 0.0;
        for (size_t ab = row[a]; ab < row[a + 1]; ab++) {
            const struct solver_material_constants *of_b = constants + neighbour[ab] * body->stride;
            double of_pair = weight(context, a, ab);
            sum += of_pair * of_b->zp * of_b->cp;
            weights += of_pair;
        }
        const struct solver_material_constants *of_a = constants + a * body->stride;
        fastest = fmax(fastest, of_a->cp * of_a->cp);
        meeting = weights > 0.0 ? fmax(meeting, sum / (weights * of_a->rho)) : meeting;
    }
    return fmax(1.0, sqrt(0.5 * meeting / fastest));
}
