/* Figures: numbers that the scene says how to measure in the run, beside those of its oracle. */
#ifndef VERIFY_FIGURES_H
#define VERIFY_FIGURES_H

#include "verify/measures.h"

/* Refuses (SOLVER_BAD_INPUT) figures that cannot be measured: unknown measures, options or names, with what there is.
 */
bool verify_figures_check(const struct solver_scene *scene, const struct verify_truth *truth,
                          struct solver_error *error);
/* Measures all of the scene's figures into the level; they must have passed the check. */
bool verify_figures_measure(const struct solver_scene *scene, const struct verify_truth *truth,
                            const struct solver_history *history, const struct solver_output *output,
                            struct verify_level *level, struct solver_error *error);

#endif
