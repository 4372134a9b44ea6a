/* Closed pair vectors: the antisymmetric part of the corrected kernel gradient, moved by the least weighted square
 * change onto
 *     sum_b C_ab = -B_a                          (closure: a constant stress gives no force)
 *     1/2 sum_b (X_b - X_a) (x) C_ab = V_a I     (a linear field is differentiated exactly)
 * once, in the reference configuration. Component k of C decouples from the others and sees the same matrix: with
 * multipliers (alpha, beta) per particle the change on a pair is
 *     w_ab [ alpha_a - alpha_b + (X_b - X_a)/2 . (beta_a + beta_b) ],
 * and the multipliers solve M (alpha, beta) = residuals, M sparse, symmetric and semi-definite: alpha quadratic with
 * beta = grad alpha gives no change. closure.h solves it, or closure_factor.h; what round-off leaves is the next
 * round's residual. */
#include "solver/closure.h"
#include "solver/kernel.h"
#include "solver/memory.h"
#include "solver/pieces.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdlib.h>

/* Rounds, iterations in each, rounds with a factor that may pass before the residual is halved, and how far a round
 * without one goes: multipliers of smooth changes are large, and their differences lose that many digits. */
enum { ROUNDS = 12, ITERATIONS = 1000, PATIENCE = 3 };
static const double per_round = 1e-8;
/* Residual, relative to a particle's face, that counts as round-off. */
static const double round_off = 2e-14;
/* What a factor's solution leaves at most of the last one's residuals, if another is to follow; and where less than
 * this is left, they are enough: what rounds would make of the rest is no better, it is where multipliers hardly change
 * pairs. */
static const double little = 0.25, spoilt = 1e-12;
/* Rounds with a factor end where they leave less than this and no longer halve it. */
static const double fair = 1e-10;
/* Multiply-adds of a factor for a particle. Measured: beyond, iterations take less time; and where these do not get
 * there, seconds are well spent. */
static const double cheap = 9e5, dear = 1e7;
/* Residual that is still accepted, with its size reported: NUMERICS.md found no effect on errors at 1e-6. A factor that
 * leaves more is given up, and iterations begin at the first guess. */
static const double acceptable = 1e-9;

/* The largest component of a pair vector that is accepted, in faces. On lattices it is 1, on clouds moved by up to 0.45
 * of the spacing up to 11 where the support is 2. It grows along slender ones: bars moved by 0.15, 8 spacings across
 * and 200 long, have 32, and hold; 400 long 48, and with {p,F} a wave in them grows. */
static const double long_pair = 40.0;

static double face_of(const struct solver_cloud *cloud)
{
    return pow(cloud->spacing, (double)cloud->dim - 1.0);
}

/* Residuals of both constraints into those of `work`; returns the largest. */
static double residuals(struct solver_closure *work, const struct solver_stencil *stencil, const double *area)
{
    size_t count = work->cloud->count;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        work->loops->residuals(work, area, stencil->V, 1.0 / face_of(work->cloud), stencil->pair, work->residual,
                               at.begin, at.end);
    }
    return solver_closure_largest(work, work->residual);
}

static void change(struct solver_closure *work, struct solver_stencil *stencil)
{
    size_t count = work->cloud->count;
#pragma omp parallel for schedule(static)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        work->loops->change(work, work->solution, face_of(work->cloud), stencil->pair, at.begin, at.end);
    }
}

/* By iterations over spline spaces. */
static void project_by_rounds(struct solver_closure *work, struct solver_stencil *stencil, const double *area,
                              double *worst)
{
    double before = INFINITY;
    for (int round = 0; *worst > round_off && round < ROUNDS && *worst < 0.5 * before; round++) {
        (void)solver_closure_solve(work, fmax(0.5 * round_off, per_round * *worst), ITERATIONS);
        change(work, stencil);
        before = *worst;
        *worst = residuals(work, stencil, area);
    }
}

/* The factor's solutions, one after the other, while each leaves little of the residuals. */
static void project_by_solutions(struct solver_closure *work, struct solver_stencil *stencil, const double *area,
                                 double *worst)
{
    for (double before = INFINITY; *worst > round_off && *worst < (*worst < spoilt ? 0.5 : little) * before;) {
        solver_closure_substitute(work, work->residual, work->solution);
        change(work, stencil);
        before = *worst;
        *worst = residuals(work, stencil, area);
    }
}

/* Conjugate residuals with the factor, where smooth multipliers, or on lattices that are hardly moved those along an
 * axis, have less energy than its shift. These multipliers are large, and a round leaves their round-off, which is
 * rough and may be more than the residuals that it began with: the next one takes it away. */
static void project_by_factor(struct solver_closure *work, struct solver_stencil *stencil, const double *area,
                              double *worst)
{
    double best = *worst;
    for (int round = 0, since = 0; *worst > round_off && round < ROUNDS && since < PATIENCE; round++, since++) {
        (void)solver_closure_solve(work, 0.5 * round_off, ITERATIONS);
        change(work, stencil);
        *worst = residuals(work, stencil, area);
        if (*worst < 0.5 * best) {
            best = *worst;
            since = -1;
        } else if (*worst < fair) {
            return;
        }
    }
}

/* Where the multipliers' equation has a factor, until what round-off has spoilt is all that is left. Nothing is done,
 * and false returned, where there is none: it would cost more than `most`, or there is no memory for it. */
static bool project_directly(struct solver_closure *work, struct solver_stencil *stencil, const double *area,
                             double most, double *worst)
{
    bool made = false;
    struct solver_error lacking;
    made = solver_closure_factor_make(work, most, &made, &lacking) && made;
    if (made) {
        project_by_solutions(work, stencil, area, worst);
        if (*worst >= spoilt) {
            project_by_factor(work, stencil, area, worst);
        }
    }
    solver_closure_factor_free(&work->factor);
    return made;
}

/* First guess: antisymmetric part of V_a g_ab, kernel sums with equal volumes. The particles' own volumes there (half
 * on faces) would pull the guess away from linear exactness at the boundary. */
static bool guess(struct solver_closure *work, struct solver_stencil *stencil, double radius,
                  struct solver_error *error)
{
    const struct solver_cloud *cloud = work->cloud;
    const struct solver_graph *graph = &stencil->graph;
    size_t dim = (size_t)cloud->dim;
    double *gradient = NULL;
    bool ok = solver_alloc((void **)&gradient, stencil->pairs * dim, sizeof(double), "kernel gradients", error) &&
              solver_kernel_gradients(cloud, graph, radius, NULL, gradient, error);
    if (ok) {
#pragma omp parallel for schedule(static)
        for (size_t a = 0; a < cloud->count; a++) {
            for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
                size_t b = graph->neighbour[ab];
                size_t ba = solver_graph_find(graph, b, a);
                double square = 0.0;
                for (size_t k = 0; k < dim; k++) {
                    double d = cloud->X[b * dim + k] - cloud->X[a * dim + k];
                    square += d * d;
                    solver_stencil_C(stencil, ab)[k] =
                        cloud->V[a] * gradient[ab * dim + k] - cloud->V[b] * gradient[ba * dim + k];
                }
                double slope;
                work->weight[ab] = solver_kernel(2.0 * sqrt(square) / radius, &slope);
            }
        }
    }
    free(gradient);
    return ok;
}

static bool project(struct solver_closure *work, struct solver_stencil *stencil, double radius,
                    struct solver_error *error)
{
    size_t dim = (size_t)work->cloud->dim;
    double *area = NULL;
    if (!solver_alloc((void **)&area, work->cloud->count * dim, sizeof *area, "boundary areas", error)) {
        return false;
    }
    for (size_t i = 0; i < stencil->face_point_count; i++) {
        const struct solver_face_point *point = &stencil->face_point[i];
        for (size_t k = 0; k < dim; k++) {
            area[point->particle * dim + k] += point->area[k];
        }
    }
    bool ok = true;
    double worst = residuals(work, stencil, area);
    bool tried = project_directly(work, stencil, area, cheap, &worst);
    if (!(worst < acceptable)) {
        ok = (!tried || guess(work, stencil, radius, error)) && solver_closure_ready(work, radius, error);
        worst = residuals(work, stencil, area);
        if (ok) {
            project_by_rounds(work, stencil, area, &worst);
        }
    }
    if (ok && !tried && !(worst < acceptable)) {
        ok = guess(work, stencil, radius, error);
        worst = residuals(work, stencil, area);
        if (ok) {
            (void)project_directly(work, stencil, area, dear, &worst);
        }
    }
    free(area);
    if (ok && !(worst < acceptable)) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "stencil closed: no solution of closure and linear exactness was found; after %d iterations "
            "for %zu particles a residual of %.1e of a face is left, and at most %.0e is accepted. Either "
            "there is none (few neighbours, particles moved far: choose a larger support or a smaller "
            "perturb), or iterations do not get there (a long lattice, or one whose particles are moved "
            "by next to nothing: choose a support of 2.2 or more, a smaller n, or perturb = 0.15)",
            work->iterations, work->cloud->count, worst, acceptable);
    }
    return ok;
}

/* Whether pair vectors are no longer than stress can be told apart with. Constraints that are all but contradictory, as
 * those of long bars of moved particles, are met by large vectors which nearly cancel. */
static bool are_short(const struct solver_cloud *cloud, const struct solver_stencil *stencil,
                      struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    double most = 0.0;
    for (size_t ab = 0; ab < stencil->pairs; ab++) {
        for (size_t k = 0; k < dim; k++) {
            most = fmax(most, fabs(solver_stencil_C(stencil, ab)[k]));
        }
    }
    most /= face_of(cloud);
    return most <= long_pair ||
           solver_fail(
               error, SOLVER_BAD_INPUT,
               "stencil closed: closure and linear exactness are met only by pair vectors of up to %.3g faces, "
               "which nearly cancel; expected %g at most. Choose a larger support, a smaller perturb, or a body "
               "that is less slender",
               most, long_pair);
}

bool solver_stencil_closed(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                           struct solver_error *error)
{
    double radius = support * cloud->spacing * (1.0 - solver_kernel_margin);
    struct solver_closure work = {.cloud = NULL};
    bool ok = solver_graph_build(cloud, radius, &stencil->graph, error) &&
              solver_stencil_reserve(stencil, cloud, error) &&
              solver_closure_open(&work, cloud, &stencil->graph, error) && guess(&work, stencil, radius, error) &&
              project(&work, stencil, radius, error) && are_short(cloud, stencil, error);
    solver_closure_close(&work);
    return ok;
}
