#include "solver/jst.h"

#define GROUP 1 // particles go one by one
#include "solver/dim_flops.h"
#include "solver/dim_sums.h"

#include <math.h>

/* Where materials meet, the volumetric stress has a jump of its own, and so has J: nothing evens that out. */
static inline bool alike(const struct solver_upwind *work, size_t a, size_t b)
{
    return work->stride == 0 || work->constants[a].kappa == work->constants[b].kappa;
}

/* kappa4 of particle a (eq. 4.2), where it depends on plastic strain; else it is a factor of all, and not of one. */
static inline double fading(const struct solver_upwind *work, const struct solver_jst *jst, size_t a)
{
    if (!jst->fades) {
        return 1.0;
    }
    double share = work->flown[a * work->material->flow->width] / jst->plastic_at;
    return share < 1.0 ? jst->elastic + (jst->plastic - jst->elastic) * share : jst->plastic;
}

static void laplacians(const struct solver_upwind *work, const struct solver_jst *jst, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        const struct solver_material_constants *of_a = work->constants + a * work->stride;
        double per_V = fading(work, jst, a) / work->V[a];
        vec v_a = load(work->v + a * LANES);
        vec of_v = {0};
        double of_J = 0.0;
        double z = of_a->zp; /* where materials meet velocities have a kink: it is damped as in the softest of them */
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            size_t b = work->neighbour[ab];
            z = fmin(z, work->constants[b * work->stride].zp);
            of_v += (load(work->v + b * LANES) - v_a) * jst->laplacian[2 * ab];
            if (work->evolves_J && alike(work, a, b)) {
                of_J += (work->J[b] - work->J[a]) * jst->laplacian[2 * ab];
            }
        }
        store(jst->v_laplacian + a * LANES, (per_V * z) * of_v);
        if (work->evolves_J) {
            jst->J_laplacian[a] = per_V * of_a->cp * of_J;
        }
    }
}

/* The mean of a constant of two particles that exchange. */
static inline double mean(double of_a, double of_b)
{
    return 0.5 * (of_a + of_b);
}

/* Forces and fluxes of eq. 3.14, summed as finish takes them. */
static inline struct sums sum_pairs(const struct solver_upwind *work, const struct solver_jst *jst, size_t a)
{
    struct sums sums = {.volume = {0.0}};
    const struct solver_material_constants *of_a = work->constants + a * work->stride;
    const double *weights = work->transposed != NULL ? work->transposed : work->pair;
    size_t stride = work->transposed != NULL ? DIM : PAIR;
    size_t shift = work->transposed != NULL ? 0 : pair_shift(work, a);
    double outer = -jst->biharmonic; /* eq. 3.13b */
    vec v_a = load(work->v + a * LANES);
    vec L_a = load(jst->v_laplacian + a * LANES);
    vec momentum = {0};
    double volume = 0.0;
    for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
        size_t b = work->neighbour[ab];
        const struct solver_material_constants *of_b = work->constants + b * work->stride;
        double l_ab = outer * jst->laplacian[2 * ab];
        double l_ba = outer * jst->laplacian[2 * ab + 1];
        double k_ab = jst->exchange != NULL ? jst->harmonic * jst->exchange[ab] : 0.0;
        for (int I = 0; I < DIM; I++) {
            sums.force += load(work->P + b * TENSOR + I * LANES) * weights[(ab + shift) * stride + (size_t)I];
        }
        momentum += l_ba * load(jst->v_laplacian + b * LANES) - l_ab * L_a;
        momentum += (k_ab * mean(of_a->zp, of_b->zp)) * (load(work->v + b * LANES) - v_a);
        if (work->evolves_J && alike(work, a, b)) {
            volume += l_ba * jst->J_laplacian[b] - l_ab * jst->J_laplacian[a];
            volume += k_ab * mean(of_a->cp, of_b->cp) * (work->J[b] - work->J[a]);
        }
    }
    sums.dissipation = 2.0 * momentum;
    sums.volume = (many){2.0 * of_a->zp * volume};
    return sums;
}

static void rates(const struct solver_upwind *work, const struct solver_jst *jst, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        size_t at[] = {a};
        struct scales scales = scales_of(work, at);
        finish(work, at, &scales, sum_pairs(work, jst, a));
    }
}

/* Operations (cost.h). */
static void terms_of(const struct solver_upwind *work, const struct solver_jst *jst, size_t count,
                     struct solver_cost_terms *terms)
{
    double pairs = (double)work->row[count];
    double particles = (double)count;
    double means = jst->exchange != NULL ? 1.0 : 0.0;
    double harmonic = 3.0 + 3.0 * LANES + means;
    solver_cost_term(terms, "Laplacian of v", 1, pairs * 3.0 * LANES + particles * (2.0 + LANES));
    solver_cost_term(terms, "kappa4 by plastic strain", 1, jst->fades ? particles * 4.0 : 0.0);
    solver_cost_term(terms, "internal force", 2, pairs * FLOPS_ADD_SCALED);
    solver_cost_term(terms, "biharmonic dissipation of p", 2, pairs * (2.0 + 4.0 * LANES) + particles * (LANES + 2.0));
    solver_cost_term(terms, "harmonic dissipation of p", 2, pairs * harmonic);
    if (work->evolves_J) {
        solver_cost_term(terms, "Laplacian of J", 1, pairs * 3.0 + particles * 2.0);
        solver_cost_term(terms, "biharmonic dissipation of J", 2, pairs * 4.0);
        solver_cost_term(terms, "harmonic dissipation of J", 2, pairs * 6.0);
    }
}

const struct solver_jst_loops DIM_NAME(solver_jst) = {.gather = laplacians, .rates = rates, .terms = terms_of};
