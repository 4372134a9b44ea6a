/* Loops over ranges of particles, of any length, by loops over whole lots (dim_lots.h): particles that are left are
 * fewer than a lot, and the last of them is repeated to fill one. The loops over whole lots are compiled once, so that
 * a particle gets the same bits in every range. */
#ifndef SOLVER_DIM_RANGES_H
#define SOLVER_DIM_RANGES_H

#include "solver/dim_lots.h"
#include "solver/material.h"

#include <string.h>

enum { TENSOR_WIDTH = DIM * LANES };

/* As solver_material's stress_range and fastest, of particles 0 to count - 1. */
typedef void stress_of_lots(const struct solver_material_constants *material, size_t stride, size_t count,
                            const double *F, const double *H, const double *J, double *P);
typedef double fastest_of_lots(const struct solver_material_constants *material, size_t stride, size_t count,
                               const double *F);

/* Constants of LOT particles. */
struct constants {
    lot mu, kappa, rho;
};

static inline struct constants constants_of(const struct solver_material_constants *material, size_t stride)
{
    struct constants of = {.mu = {0}};
    for (size_t k = 0; k < LOT; k++) {
        const struct solver_material_constants *here = material + k * stride;
        of.mu[k] = here->mu;
        of.kappa[k] = here->kappa;
        of.rho[k] = here->rho;
    }
    return of;
}

/* `width` numbers of each of `count` particles, to those of LOT. */
static inline void fill_lot(const double *from, size_t count, size_t width, double *to)
{
    for (size_t k = 0; k < LOT; k++) {
        memcpy(to + k * width, from + (k < count ? k : count - 1) * width, width * sizeof *to);
    }
}

struct filled {
    double F[LOT * TENSOR_WIDTH] __attribute__((aligned(64)));
    double H[LOT * TENSOR_WIDTH] __attribute__((aligned(64)));
    double P[LOT * TENSOR_WIDTH] __attribute__((aligned(64)));
    double J[LOT];
    struct solver_material_constants material[LOT];
};

/* H, J NULL: they are not filled. */
static inline void fill(struct filled *to, const struct solver_material_constants *material, size_t stride,
                        size_t begin, size_t end, const double *F, const double *H, const double *J)
{
    size_t count = end - begin;
    for (size_t k = 0; k < LOT; k++) {
        to->material[k] = material[(k < count ? begin + k : end - 1) * stride];
    }
    fill_lot(F + begin * TENSOR_WIDTH, count, TENSOR_WIDTH, to->F);
    if (H != NULL) {
        fill_lot(H + begin * TENSOR_WIDTH, count, TENSOR_WIDTH, to->H);
    }
    if (J != NULL) {
        fill_lot(J + begin, count, 1, to->J);
    }
}

static inline void stress_by_lots(stress_of_lots *whole, const struct solver_material_constants *material,
                                  size_t stride, size_t begin, size_t end, const double *F, const double *H,
                                  const double *J, double *P)
{
    size_t last = end - (end - begin) % LOT;
    size_t first = begin * TENSOR_WIDTH;
    whole(material + begin * stride, stride, last - begin, F + first, H != NULL ? H + first : NULL,
          J != NULL ? J + begin : NULL, P + first);
    if (last < end) {
        struct filled filled;
        fill(&filled, material, stride, last, end, F, H, J);
        whole(filled.material, 1, LOT, filled.F, H != NULL ? filled.H : NULL, J != NULL ? filled.J : NULL, filled.P);
        memcpy(P + last * TENSOR_WIDTH, filled.P, (end - last) * TENSOR_WIDTH * sizeof *P);
    }
}

static inline double fastest_by_lots(fastest_of_lots *whole, const struct solver_material_constants *material,
                                     size_t stride, size_t begin, size_t end, const double *F)
{
    size_t last = end - (end - begin) % LOT;
    double speed = whole(material + begin * stride, stride, last - begin, F + begin * TENSOR_WIDTH);
    if (last < end) {
        struct filled filled;
        fill(&filled, material, stride, last, end, F, NULL, NULL);
        double of_last = whole(filled.material, 1, LOT, filled.F);
        speed = of_last > speed ? of_last : speed;
    }
    return speed;
}

#endif
