/* The shape of rigid walls in the plane: paths of straight pieces with rounded corners, the two sides of a channel for
 * example (004_0c0448173ed5e9bd.txt, section 4.3). The body lies to the left of each path. */
#ifndef SOLVER_DIE_H
#define SOLVER_DIE_H

#include "solver/error.h"
#include "solver/scene.h"

/* A straight piece or an arc. */
struct solver_die_piece {
    enum {
        SOLVER_DIE_STRAIGHT,
        SOLVER_DIE_HOLLOW,
        SOLVER_DIE_ROUND
    } kind;          /* of an arc: where it faces its centre or not */
    double from[2];  /* where a straight piece begins; the centre of an arc [m] */
    double along[2]; /* unit: direction of a straight piece; of the one before an arc */
    double after[2]; /* of the one after an arc */
    double length;   /* of a straight piece; radius of an arc, 0: a sharp corner [m] */
    bool folds;      /* this straight piece and the next one meet in a sharp corner that the body can fill */
};

struct solver_die {
    size_t count, room;
    struct solver_die_piece *piece; /* [room], of which [count] wall by wall, along each path */
    size_t wall_count;
    size_t first[SOLVER_DIE_WALLS + 1]; /* piece at which a wall begins */
};

/* Of a wall near a point. */
struct solver_die_near {
    double gap;       /* [m] below 0 behind the wall */
    double normal[2]; /* unit, towards the body */
};

enum { SOLVER_DIE_NEAR = 2 };

/* The pieces of the scene's walls, which have been found sound by the reader. SOLVER_NO_MEMORY. */
bool solver_die_create(const struct solver_scene *scene, struct solver_die *die, struct solver_error *error);
void solver_die_free(struct solver_die *die);
/* What of a wall is nearest to x [m]: one place, or two planes where they meet in a corner that a body can fill.
 * Returns how many; 0 where x lies beyond the ends of the wall. */
size_t solver_die_look(const struct solver_die *die, size_t wall, const double x[2],
                       struct solver_die_near near[SOLVER_DIE_NEAR]);
/* What is wrong with a wall, into `why`; false: nothing. */
bool solver_die_is_wrong(const struct solver_die_wall *wall, char *why, size_t size);
/* Whether two walls cross or touch. */
bool solver_die_cross(const struct solver_die_wall *a, const struct solver_die_wall *b);

#endif
