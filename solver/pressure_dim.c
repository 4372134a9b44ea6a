/* The pair loops of the pressure of an incompressible body (pressure.h), compiled per dimension. */
#include "solver/pressure.h"

#include "solver/dim_flops.h"
#include "solver/dim_work.h"

#include <math.h>

/* H e_I of particle a: evolved, or the cofactor of F; the identity with linear kinematics. */
static inline struct tensor area_map(const struct solver_upwind *work, size_t a)
{
    return work->frozen ? identity() : load_tensor(work->cofactor + a * TENSOR);
}

static inline vec times(struct tensor T, const double *C)
{
    vec sum = T.column[0] * C[0];
    for (int I = 1; I < DIM; I++) {
        sum += T.column[I] * C[I];
    }
    return sum;
}

static inline vec distance_of(const struct solver_upwind *work, size_t a, size_t b)
{
    return load(work->X + b * LANES) - load(work->X + a * LANES);
}

/* As volume_flux of upwind_dim.c has it: A (n . H^Ave N)^2 / (2 z_p), A N standing for C_ab. */
static void weights(const struct solver_pressure *of, size_t begin, size_t end)
{
    const struct solver_upwind *work = of->work;
    double scale = of->dissipation / (2.0 * of->constants.zp);
    for (size_t a = begin; a < end; a++) {
        struct tensor H_a = area_map(work, a);
        size_t shift = pair_shift(work, a);
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            size_t b = work->neighbour[ab];
            struct tensor H_b = area_map(work, b);
            vec distance = distance_of(work, a, b);
            vec along = work->frozen ? distance : load(work->x + b * LANES) - load(work->x + a * LANES);
            vec area = {0};
            for (int I = 0; I < DIM; I++) {
                double half = 0.5 * distance[I];
                area += (H_a.column[I] + H_b.column[I]) * half;
            }
            double normal = dot(along, area);
            of->weight[ab] = scale * work->pair[(ab + shift) * PAIR + DIM] * normal * normal /
                             (dot(along, along) * dot(distance, distance));
        }
    }
}

static void diagonal(const struct solver_pressure *of, size_t begin, size_t end)
{
    const struct solver_upwind *work = of->work;
    for (size_t a = begin; a < end; a++) {
        struct tensor H = area_map(work, a);
        vec own = times(H, work->row_sum + a * DIM);
        double sum = dot(load(of->mobility + a * LANES) * own, own);
        double flux = 0.0;
        size_t shift = pair_shift(work, a);
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            vec area = times(H, work->pair + (ab + shift) * PAIR);
            sum += dot(load(of->mobility + work->neighbour[ab] * LANES) * area, area);
            flux += of->weight[ab];
        }
        /* mobility is 1 / (2 rho V), and D v has half the pair's area */
        of->diagonal[a] = 0.5 * of->tau * sum + flux + of->compliance * work->V[a] / of->tau;
    }
}

static void accelerate(const struct solver_pressure *of, const double *q, size_t begin, size_t end)
{
    const struct solver_upwind *work = of->work;
    for (size_t a = begin; a < end; a++) {
        vec force = q[a] * times(area_map(work, a), work->row_sum + a * DIM);
        size_t shift = pair_shift(work, a);
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            size_t b = work->neighbour[ab];
            const double *D = work->transposed != NULL ? work->transposed + ab * DIM : work->pair + (ab + shift) * PAIR;
            force += q[b] * times(area_map(work, b), D);
        }
        store(of->acceleration + a * LANES, load(of->mobility + a * LANES) * force);
    }
}

static void slopes(const struct solver_pressure *of, const double *q, size_t begin, size_t end)
{
    const struct solver_upwind *work = of->work;
    for (size_t a = begin; a < end; a++) {
        vec slope = {0};
        double per_V = 0.5 / work->V[a];
        size_t shift = pair_shift(work, a);
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            double difference = q[work->neighbour[ab]] - q[a];
            for (int I = 0; I < DIM; I++) {
                slope[I] += difference * work->pair[(ab + shift) * PAIR + (size_t)I];
            }
        }
        store(of->slope + a * LANES, slope * per_V);
    }
}

static inline __attribute__((always_inline)) void balance_with(const struct solver_pressure *of, const double *v,
                                                               double factor, const double *q, double *out,
                                                               size_t begin, size_t end, bool reconstruct)
{
    const struct solver_upwind *work = of->work;
    for (size_t a = begin; a < end; a++) {
        struct tensor G = {{{0}}};
        vec v_a = load(v + a * LANES);
        vec moment = {0};
        double flux = 0.0;
        size_t shift = pair_shift(work, a);
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            size_t b = work->neighbour[ab];
            vec difference = load(v + b * LANES) - v_a;
            for (int I = 0; I < DIM; I++) {
                G.column[I] += difference * work->pair[(ab + shift) * PAIR + (size_t)I];
            }
            double jump = q[b] - q[a];
            if (reconstruct) {
                vec distance = distance_of(work, a, b);
                jump -= 0.5 * dot(load(of->slope + a * LANES) + load(of->slope + b * LANES), distance);
                moment += (of->weight[ab] * jump) * distance;
            }
            flux += of->weight[ab] * jump;
        }
        out[a] = 0.5 * factor * contract(area_map(work, a), G) + flux;
        if (reconstruct) {
            double per_V = 0.5 / work->V[a];
            store(of->moment + a * LANES, moment * per_V);
        }
    }
}

static void balance(const struct solver_pressure *of, const double *v, double factor, const double *q, double *out,
                    size_t begin, size_t end)
{
    if (of->work->reconstruct) {
        balance_with(of, v, factor, q, out, begin, end, true);
    } else {
        balance_with(of, v, factor, q, out, begin, end, false);
    }
}

/* The divergence of the moments: the adjoint of the gradient. */
static void give_back(const struct solver_pressure *of, double *out, size_t begin, size_t end)
{
    const struct solver_upwind *work = of->work;
    for (size_t a = begin; a < end; a++) {
        vec sum = {0};
        vec moment = load(of->moment + a * LANES);
        for (int I = 0; I < DIM; I++) {
            sum[I] = moment[I] * work->row_sum[a * DIM + (size_t)I];
        }
        size_t shift = pair_shift(work, a);
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            const double *D = work->transposed != NULL ? work->transposed + ab * DIM : work->pair + (ab + shift) * PAIR;
            const double *moment_b = of->moment + (size_t)work->neighbour[ab] * LANES;
            for (int I = 0; I < DIM; I++) {
                sum[I] += moment_b[I] * D[I];
            }
        }
        double divergence = 0.0;
        for (int I = 0; I < DIM; I++) {
            divergence += sum[I];
        }
        out[a] -= 0.5 * divergence;
    }
}

static void diffuse(const struct solver_pressure *of, const double *q, double eta, double *out, size_t begin,
                    size_t end)
{
    const struct solver_upwind *work = of->work;
    for (size_t a = begin; a < end; a++) {
        double sum = 0.0;
        size_t shift = pair_shift(work, a);
        for (size_t ab = work->row[a]; ab < work->row[a + 1]; ab++) {
            size_t b = work->neighbour[ab];
            vec distance = distance_of(work, a, b);
            sum += work->pair[(ab + shift) * PAIR + DIM] * (q[b] - q[a]) / sqrt(dot(distance, distance));
        }
        out[a] += eta * sum;
    }
}

static void strays(const struct solver_pressure *of, size_t begin, size_t end)
{
    const struct solver_upwind *work = of->work;
    for (size_t a = begin; a < end; a++) {
        struct tensor F = load_tensor(work->F + a * TENSOR);
        double change = work->frozen ? trace(F) - DIM : determinant(F) - 1.0;
        of->stray[a] = of->restore * work->V[a] * (change - of->compliance * of->p[a]);
    }
}

/* --- operations (cost.h) --- */

enum { FLOPS_TIMES = (2 * DIM - 1) * LANES }; /* of times */

/* One evaluation of `balance`, with what `reconstruct` adds to it. */
static double flops_of_balance(const struct solver_pressure *of, double particles, double pairs)
{
    double flops = pairs * (LANES + FLOPS_ADD_SCALED + 3.0) + particles * (FLOPS_CONTRACT + 3.0);
    if (of->work->reconstruct) {
        flops += pairs * (1.0 + 2.0 * DIM) + particles * (1.0 + LANES);               /* slopes */
        flops += pairs * (4.0 * LANES + FLOPS_DOT + 3.0) + particles * (1.0 + LANES); /* jumps, moments */
        flops += pairs * 2.0 * DIM + particles * (2.0 * DIM + 2.0);                   /* give_back */
    }
    return flops;
}

static double flops_of_stress(const struct solver_upwind *work)
{
    const struct solver_material *material = work->material;
    bool cofactor = work->cofactor != NULL;
    return material->stress_flops(cofactor, work->J != NULL) + (cofactor && !work->evolves_H ? FLOPS_COFACTOR : 0.0) +
           (work->pressure != NULL ? material->volumetric_flops : 0.0);
}

static void terms_of(const struct solver_pressure *of, double iterations, struct solver_cost_terms *terms)
{
    bool poisson = of->body->scene->incompressible.solver == SOLVER_PRESSURE_POISSON;
    bool stores = of->compliance > 0.0;
    double particles = (double)of->stencil->count;
    double pairs = (double)of->stencil->pairs;
    double sealed = of->sealed ? 3.0 : 0.0; /* a mean is taken away */
    double balance = flops_of_balance(of, particles, pairs);
    double accelerate = pairs * (FLOPS_TIMES + 2.0 * LANES) + particles * (FLOPS_TIMES + 2.0 * LANES);
    double residual = balance + particles * (2.0 + sealed + (of->stray != NULL ? 2.0 : 0.0) + (stores ? 4.0 : 0.0));
    double velocity = accelerate + particles * 2.0 * LANES;
    double weights =
        pairs * (LANES * (of->work->frozen ? 1.0 : 2.0) + DIM * (1.0 + 3.0 * LANES) + 3.0 * FLOPS_DOT + 5.0);
    double diagonal =
        pairs * (FLOPS_TIMES + LANES + FLOPS_DOT + 2.0) + particles * (FLOPS_TIMES + LANES + FLOPS_DOT + 5.0);
    double stray = 4.0 + (of->work->frozen ? FLOPS_TRACE + 1.0 : FLOPS_DETERMINANT + 1.0);
    double others = 2.0 * DIM + (of->stray != NULL ? stray : 0.0) + (stores ? 4.0 : 0.0); /* mobilities too */
    double taken = 4.0 + 3.0 * LANES + 3.0; /* with the integrator's sums */
    solver_cost_term(terms, "pressure: its equation", 0, weights + diagonal + particles * others);
    solver_cost_term(terms, "pressure: first residual", 0, velocity + residual);
    if (poisson) {
        double apply = accelerate + balance + particles * (3.0 + sealed);
        solver_cost_term(terms, "pressure: iterations", 0, iterations * (apply + particles * (12.0 + sealed)));
        solver_cost_term(terms, "pressure: last velocity", 0, velocity);
    } else {
        double spread = of->eta == 0.0 ? 0.0 : pairs * (LANES + FLOPS_DOT + 5.0) + particles * 2.0;
        double advance = residual + spread + accelerate + particles * (6.0 * LANES + 4.0);
        solver_cost_term(terms, "pressure: iterations", 0, (2.0 * iterations + 1.0) * advance - residual);
        solver_cost_term(terms, "pressure: pseudo-step", 0, pairs + particles * 2.0);
        solver_cost_term(terms, "pressure: means of steps", 0, iterations * particles * (2.0 * LANES + 2.0));
    }
    solver_cost_term(terms, "pressure: stresses that go with it", 0, particles * flops_of_stress(of->work));
    solver_cost_term(terms, "pressure: step of v and p", 0, particles * taken);
    solver_cost_once(terms, "pressure: of the state", particles * 2.0);
}

const struct solver_pressure_loops DIM_NAME(solver_pressure) = {
    .lanes = LANES,
    .weights = weights,
    .diagonal = diagonal,
    .accelerate = accelerate,
    .slopes = slopes,
    .balance = balance,
    .give_back = give_back,
    .spread = diffuse,
    .terms = terms_of,
    .strays = strays,
};
