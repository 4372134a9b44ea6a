/* Operations of the loops of upwind_dim.c, term by term, as cost.h counts them. Whoever changes a loop changes its row.
 * Idle pairs of a group (dim_pairs.h) compute nothing that is wanted and do not count. */
#ifndef SOLVER_DIM_UPWIND_TERMS_H
#define SOLVER_DIM_UPWIND_TERMS_H

#include "solver/dim_flops.h"
#include "solver/dim_inverse_root.h"
#include "solver/upwind.h"

enum { OVER_TURNS = TURNS - 1 };

/* Whether loops of dim_aligned.h take the gradients. */
static inline bool aligns_gradients(const struct solver_upwind *work)
{
    return work->along != NULL && !(work->pressure_gradient != NULL && work->stride != 0);
}

/* How many times one or two pairs of a line take turns (dim_group.h). */
static inline double turns_of_lines(const struct solver_upwind *work, size_t count)
{
    size_t turns = 0;
    for (size_t i = 0; i < count * LANES; i++) {
        turns += ((size_t)work->along[i] + TURNS - 1) / TURNS;
    }
    return (double)turns;
}

/* Those of dim_aligned.h. */
static inline void aligned_gradient_terms(const struct solver_upwind *work, size_t count,
                                          struct solver_cost_terms *terms)
{
    double particles = (double)count;
    double vector = LANES;
    solver_cost_term(terms, "gradient of v, rate of F", 1,
                     (double)work->row[count] * 3.0 * vector + particles * (2.0 + FLOPS_TENSOR));
    if (work->pressure_gradient != NULL) {
        solver_cost_term(terms, "gradient of U'(J)", 1,
                         turns_of_lines(work, count) * 3.0 * vector + particles * (DIM * OVER_TURNS + 1.0) * vector);
    }
}

static inline void gradient_terms(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms)
{
    double pairs = (double)work->row[count];
    double particles = (double)count;
    double sums = pairs * FLOPS_ADD_SCALED + particles * FLOPS_TENSOR; /* with those over every other neighbour */
    bool own = work->least_squares != NULL;
    bool aligned = aligns_gradients(work);
    if (aligned) {
        aligned_gradient_terms(work, count, terms);
    } else {
        solver_cost_term(terms, "gradient of v, rate of F", 1,
                         pairs * LANES + sums + particles * (2.0 * LANES + FLOPS_TENSOR));
    }
    if (work->v_gradient != NULL) {
        solver_cost_term(terms, "gradient of v by least squares", 1, sums);
    }
    if (work->pressure_gradient != NULL && !aligned) {
        solver_cost_term(terms, own ? "gradient of U'(J) by least squares" : "gradient of U'(J)", 1,
                         pairs * 3.0 * LANES + particles * (own ? 1.0 : 2.0) * LANES);
    }
    if (work->P_gradient != NULL) {
        solver_cost_term(terms, own ? "gradient of P by least squares" : "gradient of P", 1,
                         pairs * DIM * (LANES + FLOPS_ADD_SCALED) +
                             particles * (DIM * FLOPS_TENSOR + (own ? 0.0 : 1.0)));
    }
}

/* Whether rates are those on a stencil that is antisymmetric, of one material, with the volumetric stress's jump. */
static inline bool is_plain(const struct solver_upwind *work)
{
    return work->transposed == NULL && work->stride == 0 && !(work->evolves_J && work->whole_jump);
}

/* Whether loops of dim_aligned.h take the rates. */
static inline bool aligns_rates(const struct solver_upwind *work)
{
    return work->along != NULL && is_plain(work);
}

/* Whether pairs have a turned area: else n = N. */
static inline bool turns(const struct solver_upwind *work)
{
    return work->evolves_J && (!work->frozen || work->whole_jump);
}

/* How many pairs there are of two materials. */
static inline double pairs_that_meet(const struct solver_upwind *work, size_t count)
{
    size_t meet = 0;
    for (size_t a = 0; a < count && work->stride != 0; a++) {
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            meet += !solver_material_same(work->constants + a, work->constants + work->neighbour[ab]);
        }
    }
    return (double)meet;
}

static inline void volume_terms(const struct solver_upwind *work, double pairs, double particles,
                                struct solver_cost_terms *terms)
{
    double present = work->frozen ? 0.0 : LANES + 6.0 + (work->stiffness != NULL ? 1.0 : 0.0); /* impedance */
    double area = (work->frozen ? 0.0 : 3.0 * FLOPS_TENSOR + LANES) + FLOPS_SPREAD_DOTS;
    double share = (work->whole_jump ? 4.0 : 5.0) * LANES;
    double jump = (work->whole_jump ? 3.0 * FLOPS_TENSOR + LANES : 0.0) + 3.0 * LANES;
    double slope = work->whole_jump ? DIM * 3.0 * FLOPS_TENSOR : 4.0 * LANES;
    double sum = DIM + (work->whole_jump ? 0.0 : LANES);
    solver_cost_term(terms, "dissipation of J", 2,
                     particles * sum + pairs * ((turns(work) ? area + share + present : 0.0) + jump) +
                         (work->frozen ? 0.0 : 4.0 * particles));
    solver_cost_term(terms, "reconstruction for J", 2, work->reconstruct ? pairs * slope : 0.0);
}

/* Those of dim_aligned.h. */
static inline void aligned_rate_terms(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms)
{
    double pairs = (double)work->row[count];
    double particles = (double)count;
    double vector = LANES;
    double of_axes = particles * DIM * vector; /* a vector for each axis */
    double turns = turns_of_lines(work, count);
    bool turned = !work->frozen;
    double along = turned ? (IN_SINGLE ? 4.0 : 3.0) * vector : 0.0;
    double normal = turned ? 2.0 * FLOPS_DOTS_IN_TURN + 2.0 * vector : 0.0;
    solver_cost_term(terms, "internal force", 2, pairs * 2.0 * vector + of_axes);
    solver_cost_term(terms, "dissipation of p", 2,
                     pairs * (3.0 * vector + along) + turns * normal + of_axes * (turned ? 2.0 : 1.0) +
                         particles * 4.0 * vector);
    solver_cost_term(terms, "reconstruction for p", 2, work->reconstruct ? pairs * 5.0 * vector + of_axes : 0.0);
    if (work->evolves_J) {
        double area = turned ? (IN_SINGLE ? 2.0 : 1.0) * vector : 0.0;
        double each = 10.0 + FLOPS_INVERSE_ROOT + (work->stiffness != NULL ? 1.0 : 0.0);
        double present = turned ? FLOPS_DOTS_IN_TURN + each * vector : 0.0; /* n^2, and impedance */
        solver_cost_term(terms, "dissipation of J", 2,
                         pairs * area + turns * (3.0 * vector + present) + of_axes + particles * OVER_TURNS);
        solver_cost_term(terms, "reconstruction for J", 2, work->reconstruct ? turns * 3.0 * vector : 0.0);
    }
}

static inline void rate_terms(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms)
{
    if (aligns_rates(work)) {
        aligned_rate_terms(work, count, terms);
        return;
    }
    double pairs = (double)work->row[count];
    double particles = (double)count;
    double meet = pairs_that_meet(work, count);
    double vectors = 2.0 + (work->X != NULL ? 1.0 : 0.0) + (work->frozen ? 0.0 : 1.0); /* jump, back, distance, along */
    double flux = FLOPS_SPREAD_DOTS + (turns(work) ? 5.0 : 6.0) * LANES;
    double sum = (work->stride != 0 ? 1.0 : 4.0) * LANES;
    solver_cost_term(terms, "internal force", 2, pairs * FLOPS_ADD_SCALED + particles * (DIM - 1) * LANES);
    solver_cost_term(terms, "dissipation of p", 2, pairs * (vectors * LANES + flux) + particles * sum);
    solver_cost_term(terms, "reconstruction for p", 2, work->reconstruct ? pairs * 3.0 * FLOPS_TENSOR : 0.0);
    solver_cost_term(terms, "reconstruction where materials meet", 2,
                     work->reconstruct ? meet * (4.0 * FLOPS_TENSOR + 2.0 * FLOPS_DOT + 3.0 * LANES + 3.0) : 0.0);
    solver_cost_term(terms, "impedances where materials meet", 2, work->stride != 0 ? pairs * 11.0 * LANES : 0.0);
    if (work->evolves_J) {
        volume_terms(work, pairs, particles, terms);
    }
}

/* What a particle's dissipation takes, and dW/dJ, a difference of two energies, for that of J. */
static double flops_of_lost(const struct solver_upwind *work)
{
    const struct solver_material *material = work->material;
    double energy = work->flown != NULL ? material->flow->energy_flops : material->energy_flops;
    double linear = work->frozen ? 2.0 * FLOPS_TENSOR + FLOPS_TENSOR_CROSS + FLOPS_TRACE + 1.0 : 0.0;
    double by_J = FLOPS_COFACTOR + FLOPS_DETERMINANT + linear + 2.0 * energy + 6.0;
    return FLOPS_DOT + 3.0 + (work->evolves_J ? by_J + 2.0 : 0.0);
}

static inline void particle_terms(const struct solver_upwind *work, size_t count, struct solver_cost_terms *terms)
{
    double particles = (double)count;
    const struct solver_material *material = work->material;
    bool cofactor = work->cofactor != NULL;
    bool flows = work->flown != NULL;
    int stress = flows ? material->flow->stress_flops(cofactor, work->J != NULL)
                       : material->stress_flops(cofactor, work->J != NULL);
    int fastest = flows ? material->flow->fastest_flops
                        : material->fastest_flops + (work->stride != 0 ? material->composite_flops : 0);
    solver_cost_term(terms, "rate of v", 0, particles * (3.0 + FLOPS_ADD_SCALED + 2.0 * LANES));
    if (work->evolves_J) {
        solver_cost_term(terms, "rate of J", 0, particles * (4.0 + (work->frozen ? FLOPS_TRACE : FLOPS_CONTRACT)));
    }
    if (work->evolves_H) {
        solver_cost_term(terms, "rate of H", 0, particles * FLOPS_TENSOR_CROSS);
    } else if (cofactor) {
        solver_cost_term(terms, "cofactor of F", 0, particles * FLOPS_COFACTOR);
    }
    if (work->pressure != NULL) {
        solver_cost_term(terms, "U'(J)", 0, particles * material->volumetric_flops);
    }
    if (work->stiffness != NULL) {
        solver_cost_term(terms, "U''(J)", 0, particles * material->stiffness_flops);
    }
    if (work->lost != NULL) {
        solver_cost_term(terms, "power lost", 0, particles * flops_of_lost(work));
    }
    solver_cost_term(terms, flows ? "stress and plastic flow" : "stress", 0, particles * stress);
    solver_cost_once(terms, "length of the step", particles * fastest);
    double squares = 2.0 * (LANES + FLOPS_TENSOR);
    double J = work->J != NULL && !work->constrained ? 2.0 : work->frozen ? 0.0 : LOT_DETERMINANT;
    solver_cost_once(terms, "whether the state is whole", particles * (squares + J)); /* dim_whole.h */
}

#endif
