#include "render/image.h"

#include "render/fail.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

bool render_fail(char why[RENDER_WHY], const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why, RENDER_WHY, format, arguments);
    va_end(arguments);
    return false;
}

struct render_image *render_image_create(int width, int height)
{
    struct render_image *image = calloc(1, sizeof *image);
    if (!image)
        return NULL;
    image->width = width;
    image->height = height;
    image->rgb = calloc((size_t)width * (size_t)height, 3);
    if (!image->rgb) {
        free(image);
        return NULL;
    }
    return image;
}

void render_image_free(struct render_image *image)
{
    if (!image)
        return;
    free(image->rgb);
    free(image);
}
