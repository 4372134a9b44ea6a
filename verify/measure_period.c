/* The period of a probe's motion. */
#include "verify/measures.h"
#include "verify/trace.h"

#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

/* u(t) = a + exp(-d s) (b cos w s + c sin w s), s = (t - t0) / unit: the parameters in the fit's order. */
enum { OFFSET, COSINE, SINE, FREQUENCY, DAMPING, PARAMETERS };

struct motion {
    size_t count;
    const double *time, *displacement;
    double begin, unit, middle, size; /* [s], [s], [m], [m] */
};

static int residuals(const gsl_vector *x, void *data, gsl_vector *out)
{
    const struct motion *motion = data;
    for (size_t i = 0; i < motion->count; i++) {
        double s = (motion->time[i] - motion->begin) / motion->unit, phase = gsl_vector_get(x, FREQUENCY) * s;
        double fitted = gsl_vector_get(x, OFFSET) +
                        exp(-gsl_vector_get(x, DAMPING) * s) *
                            (gsl_vector_get(x, COSINE) * cos(phase) + gsl_vector_get(x, SINE) * sin(phase));
        gsl_vector_set(out, i, fitted - (motion->displacement[i] - motion->middle) / motion->size);
    }
    return GSL_SUCCESS;
}

static int derivatives(const gsl_vector *x, void *data, gsl_matrix *out)
{
    const struct motion *motion = data;
    double b = gsl_vector_get(x, COSINE), c = gsl_vector_get(x, SINE);
    for (size_t i = 0; i < motion->count; i++) {
        double s = (motion->time[i] - motion->begin) / motion->unit, phase = gsl_vector_get(x, FREQUENCY) * s;
        double decay = exp(-gsl_vector_get(x, DAMPING) * s), cosine = decay * cos(phase), sine = decay * sin(phase);
        gsl_matrix_set(out, i, OFFSET, 1);
        gsl_matrix_set(out, i, COSINE, cosine);
        gsl_matrix_set(out, i, SINE, sine);
        gsl_matrix_set(out, i, FREQUENCY, s * (c * cosine - b * sine));
        gsl_matrix_set(out, i, DAMPING, -s * (b * cosine + c * sine));
    }
    return GSL_SUCCESS;
}

/* Times between the first and the last crossing of the middle, and how many half periods they span. */
static size_t crossings(const struct motion *motion, double *first, double *last)
{
    size_t found = 0;
    for (size_t i = 1; i < motion->count; i++) {
        double before = motion->displacement[i - 1] - motion->middle, now = motion->displacement[i] - motion->middle;
        if ((before < 0) == (now < 0)) {
            continue;
        }
        *last = motion->time[i - 1] + (motion->time[i] - motion->time[i - 1]) * before / (before - now);
        *first = found++ == 0 ? *last : *first;
    }
    return found;
}

/* How much of the motion about its middle the fit leaves: sum of squares over sum of squares. */
static double left_over(const struct motion *motion, const gsl_vector *residual)
{
    double left = 0, mean = 0, all = 0;
    for (size_t i = 0; i < motion->count; i++) {
        mean += (motion->displacement[i] - motion->middle) / motion->size / (double)motion->count;
    }
    for (size_t i = 0; i < motion->count; i++) {
        double u = (motion->displacement[i] - motion->middle) / motion->size - mean;
        left += gsl_vector_get(residual, i) * gsl_vector_get(residual, i);
        all += u * u;
    }
    return left / all;
}

static double fit(const struct motion *motion)
{
    const gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    double guess[PARAMETERS] = {0, 0.5, 0.5, M_PI, 0}; /* the unit of time is half a period */
    gsl_vector_view start = gsl_vector_view_array(guess, PARAMETERS);
    gsl_multifit_nlinear_fdf problem = {
        .f = residuals, .df = derivatives, .n = motion->count, .p = PARAMETERS, .params = (void *)motion};
    gsl_multifit_nlinear_workspace *work =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, motion->count, PARAMETERS);
    int why = 0;
    bool fits = work != NULL && gsl_multifit_nlinear_init(&start.vector, &problem, work) == GSL_SUCCESS &&
                gsl_multifit_nlinear_driver(200, 1e-14, 1e-14, 0, NULL, NULL, &why, work) == GSL_SUCCESS &&
                left_over(motion, gsl_multifit_nlinear_residual(work)) < 0.5;
    double frequency = fits ? fabs(gsl_vector_get(gsl_multifit_nlinear_position(work), FREQUENCY)) : NAN;
    gsl_multifit_nlinear_free(work);
    return 2 * M_PI / frequency * motion->unit;
}

/* The motion about the middle between its ends; false, and why, if it is none. */
static bool find_motion(size_t count, const double *time, const double *displacement, struct motion *motion,
                        const char **why)
{
    if (count < 2 * PARAMETERS) {
        *why = "the history has fewer than 10 rows; set history or t_end higher, or cfl lower";
        return false;
    }
    double low = displacement[0], high = displacement[0];
    for (size_t i = 1; i < count; i++) {
        low = fmin(low, displacement[i]);
        high = fmax(high, displacement[i]);
    }
    *motion = (struct motion){.count = count,
                              .time = time,
                              .displacement = displacement,
                              .begin = time[0],
                              .middle = (low + high) / 2,
                              .size = (high - low) / 2};
    *why = !isfinite(motion->size) ? "the probe's motion is no number"
           : !(motion->size > 0)   ? "the probe does not move"
                                   : NULL;
    return *why == NULL;
}

double verify_period_fit(size_t count, const double *time, const double *displacement, const char **why)
{
    struct motion motion;
    const char *unasked = NULL, **said = why != NULL ? why : &unasked;
    double first = NAN, last = NAN;
    if (!find_motion(count, time, displacement, &motion, said)) {
        return NAN;
    }
    size_t found = crossings(&motion, &first, &last);
    if (found < 3) {
        *said = "the probe crosses the middle of its motion fewer than three times, so that one and a half periods are "
                "not there; set t_end higher";
        return NAN;
    }
    motion.unit = (last - first) / (double)(found - 1);
    double period = fit(&motion);
    *said = isfinite(period) ? NULL : "no damped oscillation explains half of the probe's motion; is it one vibration?";
    return period;
}

static bool period_of(const struct verify_measuring *in, size_t probe, double *value, struct solver_error *error)
{
    struct verify_trace trace;
    if (!verify_trace_take(in->history, probe, &trace, error)) {
        return false;
    }
    *value = verify_period_fit(trace.count, trace.time, trace.displacement, in->why);
    verify_trace_free(&trace);
    return true;
}

bool verify_period(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                   struct solver_error *error)
{
    return period_of(in, argument[0].probe, value, error);
}

bool verify_fundamental_period(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                               struct solver_error *error)
{
    return period_of(in, argument[1].probe, value, error);
}
