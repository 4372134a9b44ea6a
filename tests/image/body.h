/* A deformed cube with a smooth field on its faces: the picture that the comparison of pictures is calibrated on. */
#ifndef TESTS_IMAGE_BODY_H
#define TESTS_IMAGE_BODY_H

#include "render/render.h"

enum { BODY_N = 24, BODY_VERTICES = 6 * (BODY_N + 1) * (BODY_N + 1), BODY_QUADS = 6 * BODY_N * BODY_N };

struct body {
    double position[BODY_VERTICES][3];
    double scalar[BODY_VERTICES];
    uint32_t quad[BODY_QUADS][4];
    struct render_surface surface; /* points at the arrays above */
};

void body_fill(struct body *body);
/* The view that all pictures of the body share, 800 x 640. */
struct render_view body_view(void);

#endif
