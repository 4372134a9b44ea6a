/* An off-screen OpenGL 2.1 context with a depth buffer. One implementation today, OSMesa (context_osmesa.c); an
 * EGL-surfaceless one can stand beside it behind the same calls. */
#ifndef RENDER_CONTEXT_H
#define RENDER_CONTEXT_H

#include "render/render.h"

struct render_context;

/* Opens a context of width x height pixels and makes it current in this thread. */
bool render_context_open(int width, int height, struct render_context **context, char why[RENDER_WHY]);
/* Finishes all drawing. [height][width][4] RGBA, bottom row first; belongs to the context. */
const uint8_t *render_context_pixels(struct render_context *context);
void render_context_close(struct render_context *context);

#endif
