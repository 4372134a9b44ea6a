#include "tests/image/body.h"

#include <math.h>

/* Neither field nor shape has a symmetry, so that no mirrored picture looks like the true one. */
static double field(const double X[3])
{
    return 1.1e6 * cos(M_PI * X[0]) * cos(0.8 * M_PI * X[1]) * cos(M_PI * (X[2] - 0.1)) + 2.5e5 * (X[0] - X[2]) +
           1.5e5 * X[1];
}

static void deform(const double X[3], double x[3])
{
    x[0] = X[0] + 0.10 * sin(0.5 * M_PI * X[0]) * cos(0.5 * M_PI * X[1]);
    x[1] = X[1] + 0.06 * X[1] - 0.05 * X[2] * X[0];
    x[2] = X[2] - 0.08 * cos(0.5 * M_PI * X[0]) * sin(0.5 * M_PI * X[2]);
}

void body_fill(struct body *body)
{
    uint32_t vertex = 0, quad = 0;
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, one = (axis + 1) % 3, other = (axis + 2) % 3;
        for (uint32_t j = 0; j <= BODY_N; j++)
            for (uint32_t i = 0; i <= BODY_N; i++, vertex++) {
                double X[3];
                X[axis] = face % 2;
                X[one] = (double)i / BODY_N;
                X[other] = (double)j / BODY_N;
                deform(X, body->position[vertex]);
                body->scalar[vertex] = field(X);
                if (i == BODY_N || j == BODY_N)
                    continue;
                const uint32_t corner[4] = {vertex, vertex + 1, vertex + BODY_N + 2, vertex + BODY_N + 1};
                for (int c = 0; c < 4; c++)
                    body->quad[quad][c] = corner[face % 2 ? c : 3 - c];
                quad++;
            }
    }
    body->surface = (struct render_surface){BODY_VERTICES, body->position[0], body->scalar, BODY_QUADS, body->quad[0]};
}

struct render_view body_view(void)
{
    return (struct render_view){
        .direction = {1.0, -1.35, 0.85},
        .up = {0, 0, 1},
        .range = {-1.2e6, 1.2e6},
        .bands = 12,
        .width = 800,
        .height = 640,
        .frame = {0, 1.1, -0.05, 1.06, -0.05, 1},
        .title = "Deformed cube, t = 0.002 s",
        .label = "mean stress",
        .unit = "Pa",
    };
}
