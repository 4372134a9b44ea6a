/* Von Mises plasticity upon Hencky's model (dim_hencky.h). */
#include "solver/dim_hencky.h"

/* From trial strains to those on the yield surface, which are 1 - `part` of them, and what is remembered with them:
 * Cp^-1 grows by F^-1 (b_e - b_trial) F^-T = sum l_i^2 (exp(-2 part e'_i) - 1) (F^-1 n_i) (x) (F^-1 n_i). */
static inline void return_to_surface(struct tensor F, double part, struct strains *strains, double *memory)
{
    struct tensor own = cofactor(F);
    double per_volume = 1.0 / determinant(F);
    for (int i = 0; i < 3; i++) {
        double change = -part * (strains->log[i] - strains->mean);
        double grown = exp(2.0 * strains->log[i]) * expm1(2.0 * change);
        strains->log[i] += change;
        if (i >= DIM) {
            memory[NORMAL] += i == 2 ? grown : 0.0; /* in 1D both lateral directions are one */
            continue;
        }
        for (int I = 0; I < DIM; I++) {
            double along = grown * per_volume * per_volume * dot(own.column[I], strains->axis[i]);
            for (int K = 0; K <= I; K++) {
                memory[place[I][K]] += along * dot(own.column[K], strains->axis[i]);
            }
        }
    }
}

/* The return map of particle k of a lot. */
static inline void flow_one(const struct solver_material_constants *material, const struct solver_hardening *hardening,
                            const double *F, struct strains_of_lot *all, int k, double *memory)
{
    struct strains strains = strains_of_one(all, k);
    double q = equivalent(material, &strains);
    double flow = solver_hardening_flow(hardening, material->mu, q, memory[0]);
    if (flow > 0.0) {
        memory[0] += flow;
        return_to_surface(load_tensor(F), 3.0 * material->mu * flow / q, &strains, memory);
        for (int i = 0; i < 3; i++) {
            all->log[i][k] = strains.log[i];
        }
    }
}

static __attribute__((noinline)) void flow_of_whole(const struct solver_material_constants *material, size_t stride,
                                                    const struct solver_hardening *hardening, size_t count,
                                                    const double *F, const double *H, const double *J,
                                                    const double *before, double *now, double *P)
{
    for (size_t a = 0; a < count; a += LOT) {
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        struct tensors cof = H != NULL ? load_tensors(H + a * TENSOR_WIDTH) : cofactors(&at);
        lot jacobian = J != NULL ? load_lot(J + a) : determinants(&at);
        lot memory[WIDTH];
        load_memory(before + a * WIDTH, memory);
        struct strains_of_lot strains = strains_of_all(&at, memory);
        memcpy(now + a * WIDTH, before + a * WIDTH, LOT * WIDTH * sizeof *now);
        for (int k = 0; k < LOT; k++) {
            size_t b = a + (size_t)k;
            flow_one(material + b * stride, hardening, F + b * TENSOR_WIDTH, &strains, k, now + b * WIDTH);
        }
        struct tensors stresses = stress_of(constants_of(material + a * stride, stride), &at, &cof, jacobian, &strains);
        store_tensors(P + a * TENSOR_WIDTH, &stresses);
    }
}

static void flow_stress_range(const struct solver_material_constants *material, size_t stride,
                              const struct solver_hardening *hardening, size_t begin, size_t end, const double *F,
                              const double *H, const double *J, const double *before, double *now, double *P)
{
    size_t last = end - (end - begin) % LOT;
    size_t first = begin * TENSOR_WIDTH;
    flow_of_whole(material + begin * stride, stride, hardening, last - begin, F + first, H != NULL ? H + first : NULL,
                  J != NULL ? J + begin : NULL, before + begin * WIDTH, now + begin * WIDTH, P + first);
    if (last < end) {
        struct filled filled;
        double memory[2][LOT * WIDTH];
        fill(&filled, material, stride, last, end, F, H, J);
        fill_lot(before + last * WIDTH, end - last, WIDTH, memory[0]);
        flow_of_whole(filled.material, 1, hardening, LOT, filled.F, H != NULL ? filled.H : NULL,
                      J != NULL ? filled.J : NULL, memory[0], memory[1], filled.P);
        memcpy(now + last * WIDTH, memory[1], (end - last) * WIDTH * sizeof *now);
        memcpy(P + last * TENSOR_WIDTH, filled.P, (end - last) * TENSOR_WIDTH * sizeof *P);
    }
}

static __attribute__((noinline)) double flow_fastest_of_whole(const struct solver_material_constants *material,
                                                              size_t stride, size_t count, const double *F,
                                                              const double *now)
{
    double square = 0.0;
    for (size_t a = 0; a < count; a += LOT) {
        struct tensors at = load_tensors(F + a * TENSOR_WIDTH);
        lot memory[WIDTH];
        load_memory(now + a * WIDTH, memory);
        struct strains_of_lot whole = strains_of_all(&at, NULL);
        struct strains_of_lot elastic = strains_of_all(&at, memory);
        for (int k = 0; k < LOT; k++) {
            const struct solver_material_constants *here = material + (a + (size_t)k) * stride;
            struct strains of_F = strains_of_one(&whole, k);
            struct strains strains = strains_of_one(&elastic, k);
            square = fmax(square, modulus_bound(here, &strains) * slowness(&of_F) / here->rho);
        }
    }
    return sqrt(square);
}

static double flow_fastest(const struct solver_material_constants *material, size_t stride, size_t begin, size_t end,
                           const double *F, const double *now)
{
    size_t last = end - (end - begin) % LOT;
    double speed = flow_fastest_of_whole(material + begin * stride, stride, last - begin, F + begin * TENSOR_WIDTH,
                                         now + begin * WIDTH);
    if (last < end) {
        struct filled filled;
        double memory[LOT * WIDTH];
        fill(&filled, material, stride, last, end, F, NULL, NULL);
        fill_lot(now + last * WIDTH, end - last, WIDTH, memory);
        speed = fmax(speed, flow_fastest_of_whole(filled.material, 1, LOT, filled.F, memory));
    }
    return speed;
}

enum {
    YIELD = 12 + 4 + 3, /* equivalent stress and its excess */
    RETURN = FLOPS_COFACTOR + FLOPS_DETERMINANT + 1 + 3 * (2 * LOGARITHM + 4) +
             DIM * (DIM * (3 + FLOPS_DOT) + DIM * (DIM + 1) / 2 * (FLOPS_DOT + 2)) + 7
};

/* Where it flows, with linear hardening. */
static int flow_stress_flops(bool H, bool J)
{
    return stress_flops(H, J) + PLASTIC_STRAINS - STRAINS + YIELD + RETURN;
}

const struct solver_flow DIM_NAME(solver_hencky_flow) = {
    .width = WIDTH,
    .stress_range = flow_stress_range,
    .stress_flops = flow_stress_flops,
    .fastest_flops = STRAINS + PLASTIC_STRAINS + FASTEST,
    .energy_flops = LOT * PLASTIC_STRAINS + ENERGY, /* in every lane of a lot */
    .energy = energy_of,
    .stress_normal = normal_of,
    .fastest = flow_fastest,
};
