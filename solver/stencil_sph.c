/* The paper's own pair vectors, C_ab = 2 V_a G_b(X_a) (000_e9ec29e1bde7947d.txt eq. 18), with the particles' own
 * volumes (half on faces, quarter on edges, eighth in corners) in the kernel sums. Neither antisymmetric nor closed. */
#include "solver/kernel.h"
#include "solver/memory.h"
#include "solver/stencil.h"

#include <stdlib.h>

bool solver_stencil_sph(const struct solver_cloud *cloud, double support, struct solver_stencil *stencil,
                        struct solver_error *error)
{
    size_t dim = (size_t)cloud->dim;
    double radius = support * cloud->spacing * (1.0 - solver_kernel_margin);
    double *gradient = NULL;
    bool ok = solver_graph_build(cloud, radius, &stencil->graph, error) &&
              solver_stencil_reserve(stencil, cloud, error) &&
              solver_alloc((void **)&gradient, stencil->pairs * dim, sizeof(double), "kernel gradients", error) &&
              solver_kernel_gradients(cloud, &stencil->graph, radius, cloud->V, gradient, error);
    for (size_t a = 0; ok && a < cloud->count; a++) {
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            for (size_t axis = 0; axis < dim; axis++) {
                solver_stencil_C(stencil, ab)[axis] = 2.0 * cloud->V[a] * gradient[ab * dim + axis];
            }
        }
    }
    free(gradient);
    return ok;
}
