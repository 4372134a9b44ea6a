/* What of a build decides the bits of its results, beside the source text. */
#ifndef SOLVER_BUILD_H
#define SOLVER_BUILD_H

/* The compiler and how it was told to compile: "GNU 12.2.0 -O3". */
const char *solver_build(void);
/* How the loops of the path in use (path.h) multiply and add: "fused", with one rounding, or "separate", with two. All
 * paths of one build that do it the same way give the same bits. */
const char *solver_build_loops(void);

#endif
