/* Cell lists: points sorted into square cells, so that what lies near a point is found without asking all others. */
#ifndef SOLVER_CELLS_H
#define SOLVER_CELLS_H

#include "solver/error.h"

#include <stddef.h>
#include <stdint.h>

/* Where particles are, at rest or now. Nothing is owned. */
struct solver_points {
    int dim;
    size_t count, stride;
    const double *x;      /* [count][stride], of which dim are read [m] */
    const uint32_t *body; /* [count] which body; NULL: there is one */
};

/* Cells a little wider than the radius, so that neighbours lie in the 3^dim cells around. There are no more
 * than points (or 27): where the box around the points would have more, as between bodies that fly apart, the grid is
 * folded, and cells a whole number of grids apart share their list. Zeroed before the first use. */
struct solver_cells {
    int64_t size[3]; /* of the grid; 1 beyond dim */
    int folded[3];   /* whether the first cell along an axis is also next to the last */
    double lower[3], width;
    uint32_t *start;    /* [cells + 1] first point of each cell */
    uint32_t *particle; /* [count] sorted by cell, ascending within */
    uint32_t *cell;     /* [count] of each point */
    size_t cell_room, point_room;
};

/* Sorts points into cells for neighbours nearer than `radius` > 0; allocates only where the last time had fewer. Fails
 * with SOLVER_BROKE_DOWN where a position is not finite. */
bool solver_cells_sort(struct solver_cells *cells, const struct solver_points *points, double radius,
                       struct solver_error *error);
void solver_cells_free(struct solver_cells *cells);
/* Indices of the cells around a point's cell, and its own, into near[27]; returns how many. Each once. */
size_t solver_cells_near(const struct solver_cells *cells, size_t a, uint32_t near[27]);

#endif
