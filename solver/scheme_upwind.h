/* The system of the mixed total-Lagrangian methods: stencil, fields {p,F}, {p,F,J} or {p,F,H,J}, internal forces and
 * the equations of the geometric measures. The scheme `upwind` is it with its Riemann dissipation; a scheme with
 * another one has a struct that starts with this, and gives its own create, destroy, geometry and fields. */
#ifndef SOLVER_SCHEME_UPWIND_H
#define SOLVER_SCHEME_UPWIND_H

#include "solver/scheme.h"
#include "solver/stencil.h"
#include "solver/upwind.h"

struct solver_pressure;

struct solver_upwind_system {
    const struct solver_body *body;
    const struct solver_upwind_loops *loops;
    struct solver_stencil *stencil;
    struct solver_stencil_residuals residuals;
    struct solver_upwind work;
    struct solver_upwind at_start;    /* the same with the state at the start of the step, once that has been turned */
    struct solver_pressure *pressure; /* NULL: J is evolved, or none */
    /* Of a scheme whose dissipation is not Riemann's, for particles [begin, end), in a thread; else NULL. The first
     * follows the gradients and may read the state of neighbours, the second stands for the rates of upwind.h and may
     * read what the first has left at neighbours. Of the state of `work`. */
    void (*gather)(const void *system, const struct solver_upwind *work, size_t begin, size_t end);
    void (*rates)(const void *system, const struct solver_upwind *work, size_t begin, size_t end);
    /* The operations of both, in place of those of Riemann's dissipation and of the rates. */
    void (*terms)(const void *system, struct solver_cost_terms *terms);
    struct solver_material_constants
        *paced;     /* [count] that the step goes by (upwind_step.h); NULL: those of the body */
    double meeting; /* by how much what couples where materials meet, or particles crowd, is faster, or 1 */
    size_t size;    /* of the struct */
};

/* `size`: of the struct that starts with the system. `align`: rows of the stencil may be sorted by axis. */
bool solver_upwind_create(const struct solver_body *body, size_t size, bool align, void **out,
                          struct solver_error *error);
void solver_upwind_destroy(void *of);
/* The others, as in the table of schemes. */
struct solver_geometry solver_upwind_geometry(const void *of);
size_t solver_upwind_fields(void *of, struct solver_field table[SOLVER_STATE_FIELDS]);
void solver_upwind_arrays(const void *of, struct solver_cost_arrays *arrays);
void solver_upwind_terms(const void *of, struct solver_cost_terms *terms);
void solver_upwind_turn(void *of, struct solver_state *state);
bool solver_upwind_start(void *of, struct solver_error *error);
bool solver_upwind_prepare(void *of, double dt, struct solver_error *error);
void solver_upwind_gradients(const void *of, bool start, size_t begin, size_t end);
void solver_upwind_rates(const void *of, bool start, size_t begin, size_t end);
const struct solver_graph *solver_upwind_graph(const void *of);
void solver_upwind_refresh(void *of, size_t begin, size_t end);
double solver_upwind_fastest(const void *of, size_t begin, size_t end);
double solver_upwind_largest_step(const void *of, double fastest);
size_t solver_upwind_first_broken(const void *of, size_t begin, size_t end);
const char *solver_upwind_complaint(const void *of, size_t a);
void solver_upwind_look(const void *of, size_t a, struct solver_point *point);
double solver_upwind_energy(const void *of, size_t a);
double solver_upwind_dissipated(const void *of, size_t a);
double solver_upwind_lost(const void *of);

/* The stencil's gradient at particle a, sum_b (x_b - x_a) (x) C_ab / 2V_a, row by row, of x, or of x - X where X,
 * [count][dim], is not NULL. */
void solver_upwind_gradient(const struct solver_stencil *stencil, const struct solver_vectors *x, const double *X,
                            size_t a, double *G);

/* What particle a remembers; NULL: nothing is plastic. */
static inline const double *solver_upwind_memory(const struct solver_upwind *work, size_t a)
{
    return work->flown != NULL ? work->flown + a * work->material->flow->width : NULL;
}

/* clang-format off */
/* Rows of a scheme's choices: the evolved sets. */
#define SOLVER_UPWIND_EVOLVED                                                                                          \
    {"evolved = \"pF\"", "linear momentum p and deformation gradient F"},                                              \
    {"evolved = \"pFJ\"", "p, F and Jacobian J"},                                                                      \
    {"evolved = \"pFHJ\"", "p, F, cofactor H and J"}
/* clang-format on */

/* What such schemes have in common, for their initializers. */
#define SOLVER_UPWIND_SHARED                                                                                           \
    .deformation = true, .stencil = true, .turn = solver_upwind_turn, .start = solver_upwind_start,                    \
    .prepare = solver_upwind_prepare, .gradients = solver_upwind_gradients, .rates = solver_upwind_rates,              \
    .graph = solver_upwind_graph, .refresh = solver_upwind_refresh, .fastest = solver_upwind_fastest,                  \
    .largest_step = solver_upwind_largest_step, .first_broken = solver_upwind_first_broken,                            \
    .complaint = solver_upwind_complaint, .look = solver_upwind_look, .energy = solver_upwind_energy,                  \
    .dissipated = solver_upwind_dissipated, .lost = solver_upwind_lost

#endif
