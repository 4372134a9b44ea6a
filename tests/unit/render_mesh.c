/* Which edges of a surface are drawn. */
#include "render/mesh.h"
#include "tests/unit/unit.h"

#include <math.h>

enum { MOST = 16 };

/* Two columns of quads, folded along their middle by ever more: z = |x| y / 20. From the eighth row on the fold is one
 * of more than 40 degrees. */
static size_t edges_of_a_fold(uint32_t rows, bool *crease_is_there)
{
    double position[3 * 3 * (MOST + 1)], scalar[3 * (MOST + 1)] = {0};
    uint32_t quad[2 * MOST][4];
    for (uint32_t j = 0; j <= rows; j++) {
        for (uint32_t i = 0; i < 3; i++) {
            double *X = position + (size_t)3 * (3 * j + i);
            X[0] = (double)i - 1.0;
            X[1] = j;
            X[2] = fabs(X[0]) * 0.05 * X[1];
        }
    }
    for (uint32_t q = 0; q < 2 * rows; q++) {
        const uint32_t v = 3 * (q / 2) + q % 2;
        quad[q][0] = v;
        quad[q][1] = v + 1;
        quad[q][2] = v + 4;
        quad[q][3] = v + 3;
    }
    const struct render_surface surface = {3 * (rows + 1), position, scalar, 2 * rows, &quad[0][0]};
    struct render_mesh mesh;
    char why[RENDER_WHY];
    CU_ASSERT_TRUE_FATAL(render_mesh_build(&surface, (double[]){0, 0, 1}, &mesh, why));
    size_t count = mesh.edge_count;
    *crease_is_there = false;
    for (size_t e = 0; e < count; e++) {
        *crease_is_there = *crease_is_there || (mesh.edge[e][0] % 3 == 1 && mesh.edge[e][1] % 3 == 1);
    }
    render_mesh_free(&mesh);
    return count;
}

/* A crease that ends in the open is drawn if it has three edges or more. */
static void whiskers(void)
{
    for (uint32_t rows = 4; rows <= MOST; rows++) {
        bool there = false;
        size_t folded = rows > 7 ? rows - 7 : 0, rim = 2 * rows + 4;
        CU_ASSERT_EQUAL(edges_of_a_fold(rows, &there), rim + (folded > 2 ? folded : 0));
        CU_ASSERT_EQUAL(there, folded > 2);
    }
}

/* All twelve edges of a cube, seen from a corner or face on. */
static void cube(void)
{
    static const uint32_t quad[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    double position[24], scalar[8] = {0};
    for (int v = 0; v < 8; v++) {
        for (int i = 0; i < 3; i++) {
            position[3 * v + i] = v >> i & 1;
        }
    }
    const struct render_surface surface = {8, position, scalar, 6, &quad[0][0]};
    const double eyes[][3] = {{0, 0, 1}, {0.6, 0, 0.8}};
    for (size_t k = 0; k < sizeof eyes / sizeof *eyes; k++) {
        struct render_mesh mesh;
        char why[RENDER_WHY];
        CU_ASSERT_TRUE_FATAL(render_mesh_build(&surface, eyes[k], &mesh, why));
        CU_ASSERT_EQUAL(mesh.edge_count, 12);
        render_mesh_free(&mesh);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"creases that end in the open", whiskers},
        {"a cube", cube},
    };
    return unit_main("mesh", tests, sizeof tests / sizeof *tests);
}
