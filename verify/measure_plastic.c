/* Measures of plastic flow, none of which needs an oracle. */
#include "verify/measures.h"

#include <math.h>

enum { PLACES = 10 }; /* across a section, as in 004_0c0448173ed5e9bd.txt, Fig. 15 */

/* The quintic spline of eq. 3.4, up to its height. */
static double kernel(double r)
{
    return r >= 2 ? 0 : pow(2 - r, 5) - (r < 1 ? 16 * pow(1 - r, 5) : 0);
}

static double strain_at(const struct solver_output *output, const double place[3])
{
    const struct solver_cloud *cloud = output->cloud;
    size_t dim = (size_t)cloud->dim;
    double sum = 0, weights = 0;
    for (size_t a = 0; a < cloud->count; a++) {
        double square = 0;
        for (size_t i = 0; i < dim && i < 3; i++) {
            double d = cloud->X[a * dim + i] + output->u[a * dim + i] - place[i];
            square += d * d;
        }
        double weight = output->V[a] * output->J[a] * kernel(sqrt(square) / cloud->spacing);
        sum += weight * output->plastic_strain[a];
        weights += weight;
    }
    return weights > 0 ? sum / weights : NAN;
}

bool verify_plastic_section(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                            struct solver_error *error)
{
    (void)error;
    *value = 0;
    for (int k = 0; k < PLACES; k++) {
        double place[3], share = (k + 0.5) / PLACES;
        for (size_t i = 0; i < 3; i++) {
            place[i] = argument[1].place[i] + share * (argument[2].place[i] - argument[1].place[i]);
        }
        *value += strain_at(in->output, place) / PLACES;
    }
    return true;
}

bool verify_plastic_most(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error)
{
    (void)argument;
    (void)error;
    *value = 0;
    for (size_t a = 0; a < in->output->cloud->count; a++) {
        double strain = in->output->plastic_strain[a];
        *value = islessequal(strain, *value) || isnan(*value) ? *value : strain; /* a NaN stays */
    }
    return true;
}

bool verify_plastic_work(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error)
{
    (void)argument;
    (void)error;
    *value = in->history->count > 0 ? in->history->totals[in->history->count - 1].plastic : NAN;
    return true;
}

bool verify_ram_loss(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                     struct solver_error *error)
{
    const struct solver_history *history = in->history;
    size_t axis = argument[0].axis;
    (void)error;
    *value = NAN;
    if (history->count > 0) {
        const struct solver_totals *first = &history->totals[0], *last = &history->totals[history->count - 1];
        double impulse = last->linear[axis] + last->wall[axis] - first->linear[axis] - first->wall[axis];
        double put_in = argument[1].number * impulse + first->kinetic + first->strain + last->external;
        *value = (put_in - last->kinetic - last->strain - last->plastic) / last->plastic;
    }
    return true;
}
