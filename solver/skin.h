/* Neighbours of moving particles. The list reaches a skin farther than asked, and is made anew only when particles have
 * moved so far that a pair outside it may have come within the radius. Since what lies beyond the radius counts for
 * nothing, results do not depend on when that is. */
#ifndef SOLVER_SKIN_H
#define SOLVER_SKIN_H

#include "solver/cloud.h"
#include "solver/graph.h"

struct solver_keeper;

struct solver_skin {
    const struct solver_cloud *cloud;
    double radius, margin; /* [m] */
    enum solver_pairs which;
    struct solver_graph graph; /* pairs nearer than radius + margin when it was made */
    double *built;             /* [count][dim] where the particles then were [m] */
    size_t updates;            /* how often it was made; 0: there is none */
};

bool solver_skin_create(const struct solver_cloud *cloud, double radius, enum solver_pairs which,
                        struct solver_skin *skin, struct solver_error *error);
void solver_skin_free(struct solver_skin *skin);
/* Makes the list fit the positions x, padded vectors of `lanes` [m]. SOLVER_BROKE_DOWN, the particle named, where one
 * is not finite. After a failure there may be no list; the next call makes it. */
bool solver_skin_update(struct solver_skin *skin, const double *x, size_t lanes, struct solver_error *error);
/* For checkpoints (keep.h): the same list again, so that a run tells of as many pairs as if it had never stopped. */
bool solver_skin_keep(struct solver_skin *skin, const char *name, struct solver_keeper *keeper,
                      struct solver_error *error);
/* Pairs of the list, both ways. */
size_t solver_skin_pairs(const struct solver_skin *skin);
void solver_skin_arrays(const struct solver_skin *skin, const char *group, struct solver_cost_arrays *arrays);
size_t solver_skin_bytes(const struct solver_skin *skin);

#endif
