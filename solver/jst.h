/* The dissipation of Jameson, Schmidt and Turkel on a stencil (004_0c0448173ed5e9bd.txt section 3.2), compiled per
 * dimension: of the linear momentum p and the Jacobian J, by a corrected Laplacian.
 *
 *   V_a Lap f_a = sum_b l_ab (f_b - f_a),   l_ab = s_a A_ab / |X_ab| - g_ab . m_a
 *
 * A_ab is the stencil's face measure (stencil.h), g_ab the weights of a gradient, grad f_a = sum_b (f_b - f_a) g_ab,
 * and m_a = s_a sum_b A_ab N_ab, so that a linear field has none at any particle, and s_a such that |X|^2 has 2 dim
 * where m_a vanishes. With the speed c and kinds of f as in eq. 3.13, and dx the spacing:
 *
 *   V_a D2_a = kappa2 c dx   sum_b k_ab (f_b - f_a),                  k_ab = (s_a + s_b) / 2 A_ab / |X_ab|
 *   V_a D4_a = -kappa4 c dx^3 sum_b (l_ba Lap f_b - l_ab Lap f_a)
 *
 * D4 is eq. 3.13b with the adjoint of the Laplacian for the outer one, which inside a lattice is the same. Pairs
 * exchange momentum, so sum V D4 = 0 (eq. 3.15) without a projection; sum V D4 (x) X = 0, so of the angular momentum a
 * body keeps what its motion has of an affine one, and no more is promised; and the energy falls, by kappa4 c dx^3 sum
 * V |Lap f|^2. The price: at a boundary D4 has its natural conditions there, whatever f does, and is O(dx) in a layer
 * of one or two particles. D2 exchanges momentum in pairs too, and its energy falls pair by pair; it lets nothing
 * through the boundary, so a linear field is not free of it there.
 *
 * On a graded lattice dx is the length |X_ab| of each pair: l_ab has A_ab / |X_ab| times (|X_ab| / dx)^(3/2), and so
 * has its adjoint, k_ab that times |X_ab| / dx. What is said above of momentum, energy and linear fields holds
 * unchanged.
 *
 * Where kappa4 depends on plastic strain (eq. 4.2) each particle has its own: it is a factor of the Laplacian that the
 * particle passes on, kappa4_b l_ba Lap f_b - kappa4_a l_ab Lap f_a. Pairs still exchange momentum, and the energy
 * falls, by c dx^3 sum kappa4 V |Lap f|^2; with one value per pair, a mean of both, only the former would be sure. */
#ifndef SOLVER_JST_H
#define SOLVER_JST_H

#include "solver/upwind.h"

struct solver_jst {
    double harmonic, biharmonic; /* kappa2 dx [m], kappa4 dx^3 [m^3]; dx^3 where kappa4 depends on plastic strain */
    bool fades;                  /* it does: from `elastic` to `plastic`, reached at the strain `plastic_at` */
    double elastic, plastic, plastic_at;
    const double *laplacian; /* [pairs][2] l_ab and l_ba [m^(dim - 2)] */
    const double *exchange;  /* [pairs] k_ab [m^(dim - 2)]; NULL where kappa2 is 0 */
    double *v_laplacian;     /* vector: rho c Lap v [kg/(m^3 s^2)], times kappa4 where that depends on strain */
    double *J_laplacian;     /* [count] c Lap J [1/(m s)], likewise; NULL where J is not evolved */
};

struct solver_jst_loops {
    /* The Laplacians of the present state. */
    void (*gather)(const struct solver_upwind *work, const struct solver_jst *jst, size_t begin, size_t end);
    void (*terms)(const struct solver_upwind *work, const struct solver_jst *jst, size_t count,
                  struct solver_cost_terms *terms);
    /* Those of upwind.h, with D2 + D4. Reads the Laplacians of neighbours: all of them must be there. */
    void (*rates)(const struct solver_upwind *work, const struct solver_jst *jst, size_t begin, size_t end);
};

SOLVER_DECLARE_LOOPS(struct solver_jst_loops, solver_jst);

#endif
