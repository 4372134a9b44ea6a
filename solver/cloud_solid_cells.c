/* Cells of a solid, for pictures and files: those of the lattice, with the particle that is nearest in the place of a
 * corner that has none. Some collapse, but they stay closed together. */
#include "solver/cloud_solid.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool kept_any(const struct solid_grid *grid, size_t node, uint32_t face)
{
    (void)face;
    return grid->kept[node];
}

static bool kept_on_surface(const struct solid_grid *grid, size_t node, uint32_t face)
{
    (void)face;
    return grid->kept[node] && grid->moved[node];
}

/* The particle that stands for each node: its own, or the nearest to where it would lie on the surface, of those on the
 * surface if it is outside: else the rim of a picture would have notches. */
static bool stand_for(const struct solid_grid *grid, size_t node, uint32_t *particle, struct solver_error *error)
{
    uint32_t at[3];
    double X[3];
    double square;
    bool found;
    *particle = grid->particle[node];
    if (*particle != SOLID_NONE || fabs(grid->distance[node]) > 2.0 * grid->solid->spacing) {
        return true;
    }
    solid_at(grid, node, at);
    solid_node_place(grid, node, X);
    if (grid->distance[node] > 0.0 && !solid_project(grid, 0, X, &found, error)) {
        return false;
    }
    size_t nearest = grid->distance[node] > 0.0 ? solid_nearest(grid, at, X, kept_on_surface, 0, &square) : SIZE_MAX;
    nearest = nearest != SIZE_MAX ? nearest : solid_nearest(grid, at, X, kept_any, 0, &square);
    *particle = nearest == SIZE_MAX ? SOLID_NONE : grid->particle[nearest];
    return true;
}

/* Cells of the lattice that reach into the body, with the particles that stand for their corners; some have collapsed.
 */
bool solid_list_cells(const struct solid_grid *grid, struct solver_cloud *cloud, struct solver_error *error)
{
    static const uint32_t corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    size_t corners = (size_t)1 << grid->dim;
    uint32_t *stands = NULL;
    uint32_t *listed = NULL; /* with room for all cells of the box */
    size_t cells = grid->cell_count;
    free(cloud->cell);
    cloud->cell = NULL;
    bool good = solver_alloc((void **)&stands, grid->nodes, sizeof *stands, "corners of cells", error) &&
                solver_alloc((void **)&listed, cells * corners, sizeof *listed, "lattice cells", error);
    for (size_t node = 0; good && node < grid->nodes; node++) {
        good = stand_for(grid, node, &stands[node], error);
    }
    for (size_t c = 0; good && c < cells; c++) {
        uint32_t at[3] = {(uint32_t)(c % grid->cells[0]), (uint32_t)(c / grid->cells[0] % grid->cells[1]),
                          (uint32_t)(c / grid->cells[0] / grid->cells[1])};
        uint32_t *cell = listed + cloud->cell_count * corners;
        bool whole = true;
        bool inner = false;
        for (size_t k = 0; k < corners; k++) {
            size_t node =
                solid_node(grid, (uint32_t[3]){at[0] + corner[k][0], at[1] + corner[k][1], at[2] + corner[k][2]});
            cell[k] = stands[node];
            whole = whole && cell[k] != SOLID_NONE;
            inner = inner || grid->distance[node] <= 0.0;
        }
        cloud->cell_count += whole && inner;
    }
    good = good && solver_alloc((void **)&cloud->cell, cloud->cell_count * corners, sizeof *cloud->cell,
                                "lattice cells", error);
    if (good) {
        memcpy(cloud->cell, listed, cloud->cell_count * corners * sizeof *listed);
    }
    free(listed);
    free(stands);
    return good;
}
