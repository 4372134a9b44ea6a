/* Whether the body that a scene moves is one that its oracle speaks of: outside of it an oracle's formulas may go on,
 * and say nothing that is true of anything. */
#ifndef VERIFY_INSIDE_H
#define VERIFY_INSIDE_H

#include "solver/cloud.h"
#include "verify/truth.h"

/* Before anything is run: the corners of a domain that is a box, and the time up to t_end. SOLVER_BAD_INPUT. */
bool verify_inside_domain(const struct solver_scene *scene, const struct verify_truth *truth,
                          struct solver_error *error);
/* All particles of the body, whatever its shape; those on a surface that is cut out of a lattice lie as near to it as
 * the cloud's quality says. SOLVER_BAD_INPUT. */
bool verify_inside_cloud(const struct solver_scene *scene, const struct verify_truth *truth,
                         const struct solver_cloud *cloud, struct solver_error *error);

#endif
