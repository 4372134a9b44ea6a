/* Fields stored in single precision: an integrator's stage, and the way to double precision and back for whatever is
 * not worth loops of its own. Compiled per dimension. */
#ifndef SOLVER_SINGLE_H
#define SOLVER_SINGLE_H

#include "solver/integrator.h"
#include "solver/path.h"

#include <stddef.h>

struct solver_single_loops {
    /* U of `count` numbers after a stage (integrator.h), each rounded once, and S, unless `sum` is NULL. */
    void (*update)(float *U, const float *start, const float *rate, float *sum, size_t count,
                   const struct solver_stage *stage, double dt);
    void (*widen)(const float *from, double *to, size_t count);
    void (*narrow)(const double *from, float *to, size_t count);
    /* The same of `count` tensors of padded columns; the single ones lack the identity. */
    void (*widen_measures)(const float *from, double *to, size_t count);
    void (*narrow_measures)(const double *from, float *to, size_t count);
};

SOLVER_DECLARE_LOOPS(struct solver_single_loops, solver_single);

#endif
