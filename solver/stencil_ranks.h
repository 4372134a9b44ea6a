/* Ranks: particles of a row of a lattice, in the plane or in space, each the neighbour of the next, and the rows beside
 * it, which are neighbours as a whole. Gradients then are differences of rows; in the plane loops take every pair once
 * for both its particles. */
#ifndef SOLVER_STENCIL_RANKS_H
#define SOLVER_STENCIL_RANKS_H

#include <stdbool.h>
#include <stddef.h>

enum { SOLVER_RANK_FIRST, SOLVER_RANK_INSIDE, SOLVER_RANK_LAST, SOLVER_RANK_KINDS };

/* In the plane; of longer rows a piece of work has too few for what is kept from one row for the next. */
enum { SOLVER_RANK_MOST = 128 };

/* Particles [begin, end), three or more. Those of a pair have one weight, |C_ab|, which is its face measure as well,
 * and C_ab points as b lies. All are equally far apart, to round-off of their positions, and so are all from those
 * below, and from those above. */
struct solver_rank {
    size_t begin, end;
    int axis;                 /* along which they follow one another */
    size_t back[3], ahead[3]; /* how far neighbours along each axis are, in particles; 0: there are none; along
                                 `axis` 1, but for those at the ends */
    double weight[3][SOLVER_RANK_KINDS]; /* [1/m] |C_ab| / 2 V_a of pairs along each axis; 0: there are none */
    double half[3][2];                   /* [m] half the distance of the one back, and of the one ahead */
};

#endif
