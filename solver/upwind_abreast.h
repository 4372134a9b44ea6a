/* The loops of upwind.h over particles that are abreast (stencil.h), a register's width of them at a time. */
#ifndef SOLVER_UPWIND_ABREAST_H
#define SOLVER_UPWIND_ABREAST_H

#include "solver/upwind.h"

/* For no fewer particles than `least`: SIZE_MAX, and no loops, where registers are too narrow. */
struct solver_abreast_loops {
    size_t least;
    void (*gradients)(const struct solver_upwind *work, size_t begin, size_t end);
    void (*rates)(const struct solver_upwind *work, size_t begin, size_t end);
};
struct solver_abreast_single_loops {
    size_t least;
    void (*gradients)(const struct solver_upwind_single *work, size_t begin, size_t end);
    void (*rates)(const struct solver_upwind_single *work, size_t begin, size_t end);
};

#endif
