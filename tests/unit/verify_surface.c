/* The surface of a body: faces that belong to one cell alone. */
#include "tests/unit/unit.h"
#include "verify/picture.h"

#include <stdlib.h>

/* Cells of a lattice of n[0] x n[1] x n[2] hexahedra. */
static uint32_t *lattice(const uint32_t n[3], size_t *count)
{
    *count = (size_t)n[0] * n[1] * n[2];
    uint32_t *cell = calloc(*count, 8 * sizeof *cell);
    uint32_t row = n[0] + 1, layer = row * (n[1] + 1), c = 0;
    for (uint32_t z = 0; z < n[2]; z++) {
        for (uint32_t y = 0; y < n[1]; y++) {
            for (uint32_t x = 0; x < n[0]; x++, c++) {
                uint32_t v = x + row * y + layer * z;
                const uint32_t corner[8] = {v,         v + 1,         v + 1 + row,         v + row,
                                            v + layer, v + layer + 1, v + layer + 1 + row, v + layer + row};
                for (int i = 0; i < 8; i++) {
                    cell[8 * c + (uint32_t)i] = corner[i];
                }
            }
        }
    }
    return cell;
}

static size_t surface_of(const uint32_t n[3])
{
    size_t cells = 0, quads = 0;
    uint32_t *cell = lattice(n, &cells), (*quad)[4] = NULL;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cell);
    CU_ASSERT_TRUE_FATAL(verify_surface(cell, cells, 8, &quad, &quads));
    /* Closed without holes: every edge belongs to two quads, run through in opposite directions. */
    for (size_t i = 0; i < 4 * quads; i++) {
        uint32_t a = quad[i / 4][i % 4], b = quad[i / 4][(i + 1) % 4];
        size_t same = 0, opposite = 0;
        for (size_t j = 0; j < 4 * quads; j++) {
            uint32_t c = quad[j / 4][j % 4], d = quad[j / 4][(j + 1) % 4];
            same += a == c && b == d;
            opposite += a == d && b == c;
        }
        if (same != 1 || opposite != 1) {
            CU_FAIL("an edge of the surface does not belong to two quads of the same sense");
        }
    }
    free(cell);
    free(quad);
    return quads;
}

static void boxes(void)
{
    CU_ASSERT_EQUAL(surface_of((const uint32_t[]){1, 1, 1}), 6);
    CU_ASSERT_EQUAL(surface_of((const uint32_t[]){2, 1, 1}), 10);
    CU_ASSERT_EQUAL(surface_of((const uint32_t[]){3, 4, 5}), 2 * (12 + 15 + 20));
}

/* A cell that has collapsed adds nothing: onto a side of its neighbour, within a body or on its surface, or so that a
 * side is a triangle or a line. */
static void collapsed(void)
{
    size_t cells = 0, quads = 0;
    uint32_t *cell = lattice((const uint32_t[]){2, 1, 1}, &cells), (*quad)[4] = NULL;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cell);
    for (int end = 0; end < 2; end++) { /* the lower or the upper cell onto the side between the two */
        uint32_t flat[16];
        for (int i = 0; i < 16; i++) {
            uint32_t v = cell[i];
            flat[i] = end == 0 && v % 3 == 0 ? v + 1 : end == 1 && v % 3 == 2 ? v - 1 : v;
        }
        CU_ASSERT_TRUE_FATAL(verify_surface(flat, cells, 8, &quad, &quads));
        CU_ASSERT_EQUAL(quads, 6);
        free(quad);
    }
    uint32_t wedge[16]; /* one edge of the first cell onto another: a side is a line, two are triangles */
    for (int i = 0; i < 16; i++) {
        wedge[i] = cell[i] == 0 ? 3 : cell[i] == 6 ? 9 : cell[i];
    }
    CU_ASSERT_TRUE_FATAL(verify_surface(wedge, cells, 8, &quad, &quads));
    CU_ASSERT_EQUAL(quads, 9);
    free(quad);
    free(cell);
}

static void flat_and_thin(void)
{
    const uint32_t quad_cell[] = {0, 1, 3, 2}, beside_line[] = {0, 1, 1, 0, 0, 1, 3, 2}, line[] = {5, 6};
    uint32_t(*quad)[4] = NULL;
    size_t count = 0;
    CU_ASSERT_TRUE_FATAL(verify_surface(quad_cell, 1, 4, &quad, &count));
    CU_ASSERT(count == 1 && quad[0][0] == 0 && quad[0][1] == 1 && quad[0][2] == 3 && quad[0][3] == 2);
    free(quad);
    CU_ASSERT_TRUE_FATAL(verify_surface(beside_line, 2, 4, &quad, &count));
    CU_ASSERT(count == 1 && quad[0][0] == 0 && quad[0][1] == 1 && quad[0][2] == 3 && quad[0][3] == 2);
    free(quad);
    CU_ASSERT_TRUE_FATAL(verify_surface(line, 1, 2, &quad, &count));
    CU_ASSERT(count == 1 && quad[0][0] == 5 && quad[0][1] == 6 && quad[0][2] == 6 && quad[0][3] == 6);
    free(quad);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"boxes are closed", boxes}, {"collapsed cells", collapsed}, {"2D and 1D", flat_and_thin}};
    return unit_main("surface", tests, sizeof tests / sizeof *tests);
}
