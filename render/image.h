/* Pictures in memory. */
#ifndef RENDER_IMAGE_H
#define RENDER_IMAGE_H

#include "render/render.h"

/* Sides of a picture, in pixels: below the least nothing can be read, above the most memory runs away. */
enum { RENDER_LEAST = 160, RENDER_MOST = 4096 };

/* A black picture without body rectangle. NULL if there is no memory. Sides are within 1..RENDER_MOST. */
struct render_image *render_image_create(int width, int height);

#endif
