/* The dissipation of upwind.h: fluxes across the pairs of a group, and what becomes of their sums. */
#ifndef SOLVER_DIM_FLUXES_H
#define SOLVER_DIM_FLUXES_H

#include "solver/dim_pairs.h"
#include "solver/dim_sums.h"
#include "solver/dim_terms.h"

#include <math.h>

/* The shares are of `a`. */
static inline __attribute__((always_inline)) struct impedances meet(struct impedances a, struct impedances b)
{
    struct impedances z = a;
    z.p = 2.0 * a.p * b.p / (a.p + b.p);
    z.s = 2.0 * a.s * b.s / (a.s + b.s);
    return z;
}

/* z_p at rest over that of the present state, in which the volume has U''(J) t^2 of rho c_p^2; t^2 = (n . H^Ave N)^2 is
 * the square of `turned` over `lengths`. The flux of J grows with U'' t^2 too: over the impedance at rest it would
 * outrun the waves of a body that is stretched or compressed, and with them the step of eq. 41. Of two particles the
 * stiffer one counts. Where U' falls with J, as beyond J = e with Hencky's model, no wave carries its jump. */
static inline __attribute__((always_inline)) wide softening(const struct solver_upwind *work, const struct group *group,
                                                            const struct pairs *pairs, const struct impedances *z,
                                                            wide turned, wide lengths)
{
    real each[GROUP];
    for (int g = 0; g < GROUP; g++) {
        real t = turned[g * LANES];
        real of_lengths = lengths[g * LANES];
        real bulk = z->bulk[g];
        bool carried = true;
        if (work->stiffness != NULL) {
            real of_a = work->stiffness[group->at[g]];
            real of_b = work->stiffness[pairs->b[g]];
            carried = of_a > 0 && of_b > 0;
            bulk *= of_a > of_b ? of_a : of_b;
        }
        real softened = (real)sqrt((double)(of_lengths / (z->shear[g] * of_lengths + bulk * (t * t))));
        each[g] = carried ? softened : 0;
    }
    return join_each(each);
}

/* Of the particles of a group whose neighbour is of the same material; where materials meet the volumetric stress has a
 * jump of its own. */
static inline wide where_alike(const struct solver_upwind *work, const struct group *group, const struct pairs *pairs,
                               wide flux)
{
    vec part[GROUP];
    take_apart(flux, part);
    for (int g = 0; g < GROUP; g++) {
        bool alike = solver_material_same(work->constants + group->at[g], work->constants + pairs->b[g]);
        part[g] = alike ? part[g] : (vec){0};
    }
    return join(part);
}

/* Reconstructed jump of the stress times the pair's distance, (P+ - P-) d (eq. 27, 34). */
static inline wide traction_jump(const struct solver_upwind *work, const size_t a[GROUP], const size_t b[GROUP],
                                 wide distance, bool reconstruct)
{
    wide traction = {0};
    wide half = 0.5 * distance;
    for (int I = 0; I < DIM; I++) {
        const real *P = work->P + I * LANES;
        wide jump = gather(P, TENSOR, b) - gather(P, TENSOR, a);
        for (int K = 0; reconstruct && K < DIM; K++) {
            const real *slopes = work->P_gradient + K * TENSOR + I * LANES;
            wide slope = gather(slopes, (size_t)DIM * TENSOR, a) + gather(slopes, (size_t)DIM * TENSOR, b);
            jump -= spread(half, K) * slope;
        }
        traction += jump * spread(distance, I);
    }
    return traction;
}

/* n (n . H^Ave N): what becomes of the unit vector N, not normalised, as the pair's area. */
static inline __attribute__((always_inline)) wide pair_area(const struct solver_upwind *work, const size_t a[GROUP],
                                                            const size_t b[GROUP], wide distance)
{
    wide area = IN_SINGLE ? distance : (wide){0}; /* of the identities */
    wide half = 0.5 * distance;
    for (int I = 0; I < DIM; I++) {
        const real *cofactor = work->cofactor + I * LANES;
        area += (gather(cofactor, TENSOR, a) + gather(cofactor, TENSOR, b)) * spread(half, I);
    }
    return area;
}

/* Sums over the neighbours, before what is the same for all of them is multiplied in. Components are summed apart as
 * long as they may be: that is fewer shuffles, and no sum waits long for its last term. */
struct pair_sums {
    wide force[DIM]; /* sum_b P_b e_I D_I */
    wide jumps;      /* sum_b A [v] */
    wide normals;    /* sum_b A n (n . [v]) */
    wide slopes;     /* sum_b A n^2 (slope of U' times N d), by components; n = n . H^Ave N here and below */
    wide volume;     /* sum_b A n^2 [U'], not reconstructed, in every lane */
    wide tractions;  /* sum_b A n (n . [P N]), by components */
};

static inline __attribute__((always_inline)) void add_volume_flux(const struct solver_upwind *work,
                                                                  const struct group *group, const struct pairs *pairs,
                                                                  struct terms terms, wide distance, wide along,
                                                                  wide by_volume, struct pair_sums *sums)
{
    if (terms.whole) {
        sums->tractions += by_volume * (along * traction_jump(work, group->at, pairs->b, distance, terms.reconstruct));
        return;
    }
    sums->volume += by_volume * (gather_scalars(work->pressure, pairs->b) - gather_scalars(work->pressure, group->at));
    if (terms.reconstruct) {
        const real *slopes = work->pressure_gradient;
        wide slope = gather(slopes, LANES, group->at) + gather(slopes, LANES, pairs->b);
        sums->slopes += by_volume * (slope * distance);
    }
}

/* Upwind fluxes across a pair, twice: of momentum, A S (p+ - p-) (eq. 27, 28), from the jump of velocity with the
 * states reconstructed at mid-distance; n is the unit of `along`, x_b - x_a, which is not normalised: n (n . jump) =
 * along (along . jump) / |along|^2. And of J (eq. 27, 28, 30, 33), times 2 z_p: A (n . (P+ - P-) N) (n . H^Ave N).
 * Eq. 33 as printed has the sign that would feed energy in; this is that of eq. 30. A N stands for C_ab, as in the flux
 * of p. By default only the volumetric part U'(J) H of the stress jumps: J is conjugate to it alone, so that without
 * reconstruction the flux cannot feed energy in, and its gradient is a vector instead of a third-order tensor. */
static inline __attribute__((always_inline)) void add_fluxes(const struct solver_upwind *work,
                                                             const struct group *group, const struct pairs *pairs,
                                                             struct terms terms, wide jump, wide distance, wide along,
                                                             wide face, struct impedances z, struct pair_sums *sums)
{
    wide normal;
    wide square;
    wide by_normal; /* A / |along|^2 */
    wide by_volume; /* A n^2, times the softening; frozen: n = N, H = 1 */
    spread_dots(along, jump, along, along, &normal, &square);
    if (terms.volume && (!terms.frozen || terms.whole)) {
        wide area = terms.frozen ? distance : pair_area(work, group->at, pairs->b, distance);
        wide turned;
        wide reference;
        spread_dots(along, area, distance, distance, &turned, &reference);
        wide lengths = square * reference;
        wide share = face / lengths;
        by_normal = share * reference;
        by_volume = terms.whole ? share * turned : share * turned * turned;
        if (!terms.frozen) {
            by_volume *= softening(work, group, pairs, &z, turned, lengths);
        }
    } else {
        by_normal = face / square;
        by_volume = face;
    }
    sums->jumps += (terms.composite ? z.s * face : face) * jump;
    sums->normals += (terms.composite ? (z.p - z.s) * normal * by_normal : normal * by_normal) * along;
    if (terms.volume) {
        by_volume = terms.composite ? where_alike(work, group, pairs, by_volume) : by_volume;
        add_volume_flux(work, group, pairs, terms, distance, along, by_volume, sums);
    }
}

static inline __attribute__((always_inline)) struct sums combine(const struct pair_sums *sums, struct terms terms,
                                                                 struct impedances z)
{
    wide force = sums->force[0];
    for (int I = 1; I < DIM; I++) {
        force += sums->force[I];
    }
    wide dissipation = terms.composite ? sums->jumps + sums->normals : z.s * sums->jumps + (z.p - z.s) * sums->normals;
    many volume = component_of(sums->volume, 0);
    if (terms.volume) {
        wide by_component = terms.whole ? sums->tractions : (real)-0.5 * sums->slopes;
        for (int i = 0; i < DIM; i++) {
            volume += component_of(by_component, i);
        }
    }
    return (struct sums){.force = force, .dissipation = dissipation, .volume = volume};
}

#endif
