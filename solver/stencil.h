/* A stencil: neighbour graph, pair vectors C_ab, volumes and boundary areas. Schemes do not know who built it.
 *
 *   gradient:    V_a grad f_a  = 1/2 sum_b (f_b - f_a) C_ab
 *   divergence:  V_a (Div P)_a = 1/2 (sum_b P_b D_ab + P_a sum_b C_ab) + traction terms,   D_ab = -C_ba
 *
 * The divergence is the negative adjoint of the gradient whatever C is (000_e9ec29e1bde7947d.txt eq. 18, 20, 21), so
 * forces between two particles are always equal and opposite. With antisymmetric C, D = C; with closed C
 * (sum_b C_ab = -B_a, the particle's boundary area vector) a constant stress gives no force; with
 * 1/2 sum_b (X_b - X_a) (x) C_ab = V_a I a linear field is differentiated exactly. */
#ifndef SOLVER_STENCIL_H
#define SOLVER_STENCIL_H

#include "solver/cloud.h"
#include "solver/cost.h"
#include "solver/graph.h"
#include "solver/material.h"
#include "solver/stencil_ranks.h"

struct solver_stencil {
    int dim;
    size_t count, pairs;
    double spacing; /* [m] */
    double finest;  /* [m] of a step by a CFL number: the spacing where it is smallest */
    double *fine; /* [count] [m] the same of each particle; NULL but on a graded lattice of a composite body, until the
                     scheme has taken it */
    struct solver_graph graph;
    double *pair;     /* [records][dim + 1]: C_ab, then the face measure A_ab of the upwind dissipation,
                             max(0, (C_ab - C_ba)/2 . N_ab) unless the builder knows better; one record, so that a
                             pair is one place in memory */
    size_t records;   /* pairs, unless rows are shared */
    uint32_t *shared; /* [count] record of the first pair of each row, where rows that are equal bit for bit are
                         kept once; NULL: the pair's own number */
    float *narrow;    /* [records][dim + 1] the same in units of `unit`, once the stencil is narrowed; then pair, and
                         row_sum / unit, are those of the rounded numbers */
    double unit;      /* [m^(dim-1)]; 1 until then, and row_sum is in its units */
    uint8_t *along;   /* [count][1, 2 or 4] how many pairs of each row lie along each axis, where all do, C_ab as well,
                         and rows are sorted by axis; NULL: some lie along none, or nobody asked */
    uint8_t *abreast; /* [count] how many particles from each on, 255 at most, are abreast: consecutive, their k-th
                         neighbours too, with one row of pair vectors and one volume; NULL unless rows are shared and
                         sorted by axis */
    size_t rank_count;
    struct solver_rank *rank; /* in order of particles (stencil_ranks.h); NULL: there are none, or nobody asked */
    double *transposed;       /* [pairs][dim] D_ab = -C_ba; NULL where C is antisymmetric */
    double *row_sum;          /* [count][dim] sum_b C_ab */
    double *least_squares;    /* [pairs][dim] weights g with grad f_a = sum_b (f_b - f_a) g_ab
                                 (000_e9ec29e1bde7947d.txt eq. 37); NULL unless asked for */
    double *V;                /* [count] [m^dim] */
    double *own;              /* [count] what of V the part of a symmetric body has; NULL: all (symmetry.h) */
    size_t face_point_count;
    struct solver_face_point *face_point;
};

struct solver_stencil_builder {
    const char *name, *summary;
    bool antisymmetric, lattice_only;
    bool closed;  /* sum_b C_ab = -B_a: needs particles on the faces, which carry their areas */
    bool faces;   /* sets the face measures itself */
    int degree;   /* polynomials differentiated exactly away from the boundary */
    int boundary; /* the same at the boundary */
    bool (*build)(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                  struct solver_error *error);
};

/* Whether a constant stress with its tractions is equilibrium and a linear velocity has its gradient, at every
 * particle: what the patch test asks. */
static inline bool solver_stencil_keeps_constant_stress(const struct solver_stencil_builder *builder)
{
    return builder->antisymmetric && builder->closed && builder->boundary >= 1;
}

/* The table, ends with a NULL name. */
const struct solver_stencil_builder *solver_stencil_builders(void);
const struct solver_stencil_builder *solver_stencil_find(const char *name);

/* `support`: radius over spacing, for builders that have one. */
bool solver_stencil_create(const struct solver_stencil_builder *builder, const struct solver_cloud *cloud,
                           double support, struct solver_stencil **stencil, struct solver_error *error);
void solver_stencil_free(struct solver_stencil *stencil);
/* Adds the weights of the least-squares gradient. */
bool solver_stencil_add_least_squares(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      struct solver_error *error);
/* In their place those of slopes on a lattice in its own coordinate, whose steps are all cloud->spacing, and within one
 * material; `constants` of all particles, NULL where there is one material. */
bool solver_stencil_add_lattice_slopes(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                       const struct solver_material_constants *constants, struct solver_error *error);
/* The same of a graded one. */
bool solver_stencil_add_graded_slopes(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                                      const struct solver_material_constants *constants, struct solver_error *error);
void solver_stencil_arrays(const struct solver_stencil *stencil, struct solver_cost_arrays *arrays);
/* Sorts rows by axis if every pair lies along one, as on lattices of sbp2 and sbp4; else it leaves all as it is, and so
 * where there are transposed pair vectors or least-squares weights. Neighbours are then ascending along each axis only:
 * solver_graph_find does not find them. Before rows are shared and pairs narrowed; `cloud` is the stencil's. */
bool solver_stencil_align(struct solver_stencil *stencil, const struct solver_cloud *cloud, struct solver_error *error);
/* Keeps rows of pair vectors that are equal bit for bit once, where that saves three quarters of them, as on lattices
 * of sbp2 from a few hundred particles on; else it leaves all as it is. Before pairs are narrowed. */
bool solver_stencil_share(struct solver_stencil *stencil, struct solver_error *error);
/* Finds particles that are abreast, as in the rows of a lattice: loops take several of them at a time. After rows are
 * sorted and shared, if they are. */
bool solver_stencil_find_runs(struct solver_stencil *stencil, struct solver_error *error);
/* Finds particles in ranks, in the plane and in space, where rows are sorted. Before pairs are narrowed. */
bool solver_stencil_find_ranks(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                               struct solver_error *error);
/* Rounds pairs to single precision. Those that are opposite stay so, and sums of them are taken in double precision, so
 * that forces are equal and opposite to round-off of a double, and divergence and gradient each other's adjoint. Pairs
 * of sbp2, and of sbp4 away from the boundary, are whole multiples of the unit and stay as they are; elsewhere closure
 * and linear exactness hold to single precision only. SOLVER_BAD_INPUT if the builder is not antisymmetric. */
bool solver_stencil_narrow(struct solver_stencil *stencil, struct solver_error *error);
/* Lets the pairs in double precision of a narrowed stencil go. */
void solver_stencil_narrow_only(struct solver_stencil *stencil);
size_t solver_stencil_bytes(const struct solver_stencil *stencil);

/* How well a stencil keeps its promises: largest violations over all particles, each relative to the size of what it
 * should be. */
struct solver_stencil_residuals {
    double antisymmetry; /* |C_ab + C_ba| / max |C| */
    double closure;      /* |sum_b C_ab + B_a| / max |C| */
    double linear;       /* |1/2 sum_b (X_b - X_a) (x) C_ab / V_a - I| */
};
struct solver_stencil_residuals solver_stencil_check(const struct solver_stencil *stencil,
                                                     const struct solver_cloud *cloud);

/* For builders: reserves everything but the graph, which must be there; copies volumes and face points of the cloud. */
bool solver_stencil_reserve(struct solver_stencil *stencil, const struct solver_cloud *cloud,
                            struct solver_error *error);
/* Less the number of a pair of particle a's row, its record. */
static inline size_t solver_stencil_shift(const struct solver_stencil *stencil, size_t a)
{
    return stencil->shared != NULL ? stencil->shared[a] - stencil->graph.row[a] : 0;
}
/* C_ab and then the face measure of a record: of a pair, for builders and wherever no rows are shared. */
static inline double *solver_stencil_C(const struct solver_stencil *stencil, size_t pair)
{
    return stencil->pair + pair * (size_t)(stencil->dim + 1);
}

bool solver_stencil_sph(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                        struct solver_error *error);
bool solver_stencil_closed(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                           struct solver_error *error);
bool solver_stencil_sbp2(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                         struct solver_error *error);
bool solver_stencil_sbp4(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                         struct solver_error *error);

#endif
