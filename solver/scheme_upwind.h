/* The system of the mixed total-Lagrangian methods: stencil, fields {p,F}, {p,F,J} or {p,F,H,J}, internal forces and
 * the equations of the geometric measures. The scheme `upwind` is it with its Riemann dissipation; a scheme with
 * another one has a struct that starts with this, and gives its own create, destroy, geometry and fields. */
#ifndef SOLVER_SCHEME_UPWIND_H
#define SOLVER_SCHEME_UPWIND_H

#include "solver/scheme.h"
#include "solver/stencil.h"
#include "solver/upwind.h"

struct solver_upwind_system {
    const struct solver_body *body;
    const struct solver_upwind_loops *loops;
    struct solver_stencil *stencil;
    struct solver_stencil_residuals residuals;
    struct solver_upwind work;
    /* Of a scheme whose dissipation is not Riemann's, for particles [begin, end), in a thread; else NULL. The first
     * follows the gradients and may read the state of neighbours, the second stands for the rates of upwind.h and may
     * read what the first has left at neighbours. */
    void (*gather)(const void *system, size_t begin, size_t end);
    void (*rates)(const void *system, size_t begin, size_t end);
};

/* The evolved sets. */
extern const struct solver_scheme_choice solver_upwind_choices[];

/* `size`: of the struct that starts with the system. */
bool solver_upwind_create(const struct solver_body *body, size_t size, void **system, struct solver_error *error);
void solver_upwind_destroy(void *system);
/* The others, as in the table of schemes. */
struct solver_geometry solver_upwind_geometry(const void *system);
size_t solver_upwind_fields(void *system, struct solver_field table[SOLVER_STATE_FIELDS]);
bool solver_upwind_start(void *system, struct solver_error *error);
bool solver_upwind_evaluate(void *system, double t, double dt, struct solver_error *error);
void solver_upwind_refresh(void *system, size_t begin, size_t end);
double solver_upwind_largest_step(const void *system);
size_t solver_upwind_first_broken(const void *system, size_t begin, size_t end);
const char *solver_upwind_complaint(const void *system, size_t particle);
void solver_upwind_look(const void *system, size_t particle, struct solver_point *point);
double solver_upwind_energy(const void *system, size_t particle);

#endif
