/* Two pictures on disk, held against one another. */
#ifndef VERIFY_COMPARE_H
#define VERIFY_COMPARE_H

#include "render/render.h"
#include "solver/error.h"

/* Reads both, compares them and prints a line: *same says whether they differ by no more than the tolerance. The caller
 * frees *stored and difference->picture, which may be NULL. False on pictures that cannot be compared. */
bool verify_compare(const char *stored_path, const char *fresh_path, struct render_tolerance tolerance,
                    struct render_image **stored, struct render_difference *difference, bool *same,
                    struct solver_error *error);

#endif
