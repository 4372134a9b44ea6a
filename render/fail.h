/* Errors are values: a call that can fail returns false and says why. */
#ifndef RENDER_FAIL_H
#define RENDER_FAIL_H

#include "render/render.h"

/* Fills why and returns false, so that a caller can write `return render_fail(...)`. */
bool render_fail(char why[RENDER_WHY], const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
