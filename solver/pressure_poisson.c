/* The equation of the pressure's increment, and its solution by conjugate gradients with a diagonal preconditioner. */
#include "solver/pieces.h"
#include "solver/pressure_solvers.h"

#include <math.h>

double solver_pressure_dot(const struct solver_pressure *of, const double *x, const double *y)
{
    size_t count = of->stencil->count;
    size_t pieces = solver_pieces(count);
    double sum = 0.0;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < pieces; piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        double partial = 0.0;
        for (size_t a = at.begin; a < at.end; a++) {
            partial += y != NULL ? x[a] * y[a] : x[a];
        }
        of->partial[piece] = partial;
    }
    for (size_t piece = 0; piece < pieces; piece++) {
        sum += of->partial[piece];
    }
    return sum;
}

double solver_pressure_left(const struct solver_pressure *of)
{
    size_t count = of->stencil->count;
    double largest = 0.0;
    bool finite = true;
#pragma omp parallel for schedule(static) reduction(max : largest) reduction(&& : finite)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        for (size_t a = at.begin; a < at.end; a++) {
            largest = fmax(largest, fabs(of->residual[a]) / of->stencil->V[a]);
            finite = finite && isfinite(of->residual[a]);
        }
    }
    return finite ? of->tau * largest : NAN;
}

bool solver_pressure_give_up(const struct solver_pressure *of, double left, struct solver_error *error)
{
    const struct solver_incompressible *asked = &of->body->scene->incompressible;
    return solver_fail(error, SOLVER_BROKE_DOWN,
                       "the pressure has not converged in incompressible.iterations = %d: it leaves %.3g of a "
                       "particle's volume unbalanced, and incompressible.tolerance is %g. More iterations, a larger "
                       "tolerance or incompressible.solver = \"poisson\" may do",
                       asked->iterations, left, asked->tolerance);
}

/* What of a residual no pressure balances: its mean per volume, where a constant pressure moves nothing. */
static void balance_mean(const struct solver_pressure *of, double *residual)
{
    if (!of->sealed) {
        return;
    }
    double mean = solver_pressure_dot(of, residual, NULL) / of->volume;
    for (size_t a = 0; a < of->stencil->count; a++) {
        residual[a] -= mean * of->stencil->V[a];
    }
}

/* The same of a pressure: it has no mean. */
static void take_mean(const struct solver_pressure *of, double *q)
{
    if (!of->sealed) {
        return;
    }
    double mean = solver_pressure_dot(of, q, of->stencil->V) / of->volume;
    for (size_t a = 0; a < of->stencil->count; a++) {
        q[a] -= mean;
    }
}

void solver_pressure_apply(const struct solver_pressure *of, const double *q, double *out)
{
    const struct solver_pressure_loops *loops = of->loops;
    size_t count = of->stencil->count;
    bool reconstruct = of->work->reconstruct;
    double storage = of->compliance / of->tau;
#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            loops->accelerate(of, q, at.begin, at.end);
            if (reconstruct) {
                loops->slopes(of, q, at.begin, at.end);
            }
        }
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            loops->balance(of, of->acceleration, of->tau, q, out, at.begin, at.end);
        }
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            if (reconstruct) {
                loops->give_back(of, out, at.begin, at.end);
            }
            for (size_t a = at.begin; a < at.end; a++) {
                out[a] = storage * of->stencil->V[a] * q[a] - out[a];
            }
        }
    }
    balance_mean(of, out);
}

void solver_pressure_velocity(const struct solver_pressure *of, const double *increment)
{
    size_t count = of->stencil->count;
    size_t lanes = of->loops->lanes;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        of->loops->accelerate(of, increment, at.begin, at.end);
        for (size_t i = at.begin * lanes; i < at.end * lanes; i++) {
            of->work->v[i] = of->predicted[i] + of->tau * of->acceleration[i];
        }
    }
}

void solver_pressure_residual(const struct solver_pressure *of, const double *increment, double eta)
{
    const struct solver_pressure_loops *loops = of->loops;
    size_t count = of->stencil->count;
    bool reconstruct = of->work->reconstruct;
    double storage = of->compliance / of->tau;
    double *p = of->total;
    double *out = of->residual;
#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (size_t a = 0; a < count; a++) {
            p[a] = of->p[a] + increment[a];
        }
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            if (reconstruct) {
                loops->slopes(of, p, at.begin, at.end);
            }
        }
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            loops->balance(of, of->work->v, 1.0, p, out, at.begin, at.end);
            if (eta > 0.0) {
                loops->spread(of, p, eta, out, at.begin, at.end);
            }
        }
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            if (reconstruct) {
                loops->give_back(of, out, at.begin, at.end);
            }
            for (size_t a = at.begin; of->stray != NULL && a < at.end; a++) {
                out[a] += of->stray[a] / of->step;
            }
            for (size_t a = at.begin; of->compliance > 0.0 && a < at.end; a++) {
                out[a] -= storage * of->stencil->V[a] * (p[a] - of->reference[a]);
            }
        }
    }
    balance_mean(of, out);
}

/* out = residual / diagonal */
static void precondition(const struct solver_pressure *of, double *out)
{
    size_t count = of->stencil->count;
#pragma omp parallel for schedule(static)
    for (size_t a = 0; a < count; a++) {
        out[a] = of->residual[a] / of->diagonal[a];
    }
    take_mean(of, out);
}

bool solver_pressure_poisson(struct solver_pressure *of, double *increment, struct solver_error *error)
{
    const struct solver_incompressible *asked = &of->body->scene->incompressible;
    size_t count = of->stencil->count;
    double *direction = of->direction;
    double *image = of->image;
    double *z = of->total; /* free once the residual is there */
    solver_pressure_velocity(of, increment);
    solver_pressure_residual(of, increment, 0.0);
    double left = solver_pressure_left(of);
    double square = 0.0;
    for (int i = 0; !(left <= asked->tolerance); i++) {
        if (i == asked->iterations || isnan(left)) {
            return solver_pressure_give_up(of, left, error);
        }
        precondition(of, z);
        double before = square;
        square = solver_pressure_dot(of, of->residual, z);
        double keep = i > 0 ? square / before : 0.0;
#pragma omp parallel for schedule(static)
        for (size_t a = 0; a < count; a++) {
            direction[a] = z[a] + keep * direction[a];
        }
        solver_pressure_apply(of, direction, image);
        double length = square / solver_pressure_dot(of, direction, image);
#pragma omp parallel for schedule(static)
        for (size_t a = 0; a < count; a++) {
            increment[a] += length * direction[a];
            of->residual[a] -= length * image[a];
        }
        of->iterations++;
        left = solver_pressure_left(of);
    }
    solver_pressure_velocity(of, increment);
    return true;
}
