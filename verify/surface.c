#include "verify/picture.h"

#include <stdlib.h>
#include <string.h>

/* Faces of VTK's hexahedron, vertices in order around each, outward. */
static const unsigned hexahedron[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                          {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};

struct face {
    uint32_t key[4];    /* vertices, sorted, each once: the same for all cells that share the face */
    uint32_t vertex[4]; /* vertices, in order around the face */
};

static int by_vertex(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static int by_key(const void *a, const void *b)
{
    const struct face *x = a, *y = b;
    for (int i = 0; i < 4; i++) {
        if (x->key[i] != y->key[i]) {
            return x->key[i] < y->key[i] ? -1 : 1;
        }
    }
    return 0;
}

/* The key of a face; false where it has collapsed to a line. */
static bool set_key(struct face *face)
{
    uint32_t sorted[4];
    size_t distinct = 0;
    memcpy(sorted, face->vertex, sizeof sorted);
    qsort(sorted, 4, sizeof sorted[0], by_vertex);
    for (size_t i = 0; i < 4; i++) {
        face->key[i] = UINT32_MAX;
        if (i == 0 || sorted[i] != sorted[i - 1]) {
            face->key[distinct++] = sorted[i];
        }
    }
    return distinct > 2;
}

/* A face that an odd number of cells have is on the surface: one, or beside cells that have collapsed, both of whose
 * sides it is. */
static bool surface_of_hexahedra(const uint32_t *cell, size_t cell_count, uint32_t (**quad)[4], size_t *count)
{
    size_t faces = 6 * cell_count;
    struct face *face = calloc(faces, sizeof *face);
    *quad = calloc(faces, sizeof **quad);
    if (face == NULL || *quad == NULL) {
        free(face);
        free(*quad);
        *quad = NULL;
        return false;
    }
    size_t kept = 0;
    for (size_t i = 0; i < faces; i++) {
        for (int j = 0; j < 4; j++) {
            face[kept].vertex[j] = cell[i / 6 * 8 + hexahedron[i % 6][j]];
        }
        kept += set_key(&face[kept]);
    }
    faces = kept;
    qsort(face, faces, sizeof *face, by_key);
    *count = 0;
    for (size_t i = 0, end; i < faces; i = end) {
        for (end = i + 1; end < faces && by_key(&face[i], &face[end]) == 0;) {
            end++;
        }
        if ((end - i) % 2 == 1) {
            memcpy((*quad)[(*count)++], face[i].vertex, sizeof **quad);
        }
    }
    free(face);
    return true;
}

bool verify_surface(const uint32_t *cell, size_t cell_count, int cell_width, uint32_t (**quad)[4], size_t *count)
{
    if (cell_width == 8) {
        return surface_of_hexahedra(cell, cell_count, quad, count);
    }
    *quad = calloc(cell_count, sizeof **quad);
    *count = 0;
    for (size_t i = 0; *quad != NULL && i < cell_count; i++) {
        struct face face;
        for (size_t j = 0; j < 4; j++) {
            size_t last = (size_t)cell_width - 1;
            face.vertex[j] = cell[i * (size_t)cell_width + (j < last ? j : last)];
        }
        if (set_key(&face) || cell_width == 2) {
            memcpy((*quad)[(*count)++], face.vertex, sizeof **quad);
        }
    }
    return *quad != NULL;
}
