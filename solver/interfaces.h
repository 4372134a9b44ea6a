/* Where materials meet on planes of a lattice: stencils that reach far end there, on either side (stencil_sbp.c). */
#ifndef SOLVER_INTERFACES_H
#define SOLVER_INTERFACES_H

#include "solver/cloud.h"
#include "solver/material.h"

enum { SOLVER_INTERFACES_APART = 8 }; /* particles from one plane to the next, both counted */

/* Sets cloud->interface from the constants of a composite body, [count]: a plane of particles is an interface where all
 * of them are of another material than their neighbours on either side, whose next ones are like them: they stand for
 * half of each. None are where a material changes from plane to plane, where an interface lies between particles, or
 * crosses a part of the lattice only, and no two that are nearer than SOLVER_INTERFACES_APART, or as near to a face.
 * Does nothing to a cloud that is no whole lattice. SOLVER_NO_MEMORY. */
bool solver_interfaces_find(struct solver_cloud *cloud, const struct solver_material_constants *constants,
                            struct solver_error *error);
/* Whether there is one. */
bool solver_interfaces_there(const struct solver_cloud *cloud);

#endif
