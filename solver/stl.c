/* Reading of STL files. Nothing in them is trusted: sizes, numbers and the surface itself are looked at. */
#include "solver/stl.h"

#include "solver/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { HEADER = 84, RECORD = 50, LARGEST_FILE = 1 << 28 }; /* bytes */

/* A corner of a triangle of the file. */
struct corner {
    double X[3];
    uint32_t at; /* corner number */
};

/* The whole file, with a zero after it. */
static bool read_bytes(const char *path, int file, unsigned char **bytes, size_t *size, struct solver_error *error)
{
    struct stat about;
    if (fstat(file, &about) != 0) {
        return solver_fail(error, SOLVER_IO, "%.400s: cannot be examined: %s", path, strerror(errno));
    }
    if (!S_ISREG(about.st_mode)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: is no regular file; expected an STL file", path);
    }
    if (about.st_size > LARGEST_FILE) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: has %lld bytes; an STL file has at most %d", path,
                           (long long)about.st_size, LARGEST_FILE);
    }
    *size = (size_t)about.st_size;
    if (!solver_alloc((void **)bytes, *size + 1, 1, "the STL file", error)) {
        return false;
    }
    for (size_t got = 0; got < *size;) {
        ssize_t step = read(file, *bytes + got, *size - got);
        if (step < 0 && errno == EINTR) {
            continue;
        }
        if (step <= 0) {
            return solver_fail(error, SOLVER_IO, "%.400s: reading stopped after %zu of %zu bytes: %s", path, got, *size,
                               step < 0 ? strerror(errno) : "the file was cut short");
        }
        got += (size_t)step;
    }
    return true;
}

static bool read_file(const char *path, unsigned char **bytes, size_t *size, struct solver_error *error)
{
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* a pipe must not make the program wait */
    if (file < 0) {
        return solver_fail(error, SOLVER_BAD_INPUT, "domain.file: %.400s: cannot be opened: %s", path, strerror(errno));
    }
    bool good = read_bytes(path, file, bytes, size, error);
    close(file);
    return good;
}

static uint32_t little_endian(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* Whether the length is that of a binary file with the number of triangles it names. */
static bool is_binary(const unsigned char *bytes, size_t size)
{
    return size >= HEADER && (size - HEADER) % RECORD == 0 && (size - HEADER) / RECORD == little_endian(bytes + 80);
}

static bool keep(struct corner *corner, size_t at, const double X[3], double scale, const char *path,
                 struct solver_error *error)
{
    for (int i = 0; i < 3; i++) {
        corner[at].X[i] = scale * X[i] + 0.0; /* -0 and 0 are one place */
        if (!isfinite(corner[at].X[i])) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "%.400s: triangle %zu: a coordinate is %g; expected a finite "
                               "number",
                               path, at / 3 + 1, X[i]);
        }
    }
    corner[at].at = (uint32_t)at;
    return true;
}

static bool read_binary(const unsigned char *bytes, size_t count, double scale, const char *path, struct corner *corner,
                        struct solver_error *error)
{
    for (size_t at = 0; at < 3 * count; at++) {
        const unsigned char *place = bytes + HEADER + at / 3 * RECORD + 12 + at % 3 * 12; /* after the normal */
        double X[3];
        for (int i = 0; i < 3; i++) {
            uint32_t bits = little_endian(place + 4 * i);
            float number;
            memcpy(&number, &bits, sizeof number);
            X[i] = (double)number;
        }
        if (!keep(corner, at, X, scale, path, error)) {
            return false;
        }
    }
    return true;
}

/* Moves past blanks and the word, if it comes next. */
static bool take_word(const char **text, const char *word)
{
    size_t length = strlen(word);
    const char *at = *text + strspn(*text, " \t\r\n");
    if (strncmp(at, word, length) != 0 || (at[length] != '\0' && strchr(" \t\r\n", at[length]) == NULL)) {
        return false;
    }
    *text = at + length;
    return true;
}

static bool take_numbers(const char **text, double X[3])
{
    for (int i = 0; i < 3; i++) {
        char *end;
        X[i] = strtod(*text, &end);
        if (end == *text) {
            return false;
        }
        *text = end;
    }
    return true;
}

/* One facet; false where the text is none. */
static bool take_facet(const char **text, double X[3][3])
{
    double normal[3];
    bool good = take_word(text, "facet") && take_word(text, "normal") && take_numbers(text, normal) &&
                take_word(text, "outer") && take_word(text, "loop");
    for (int c = 0; good && c < 3; c++) {
        good = take_word(text, "vertex") && take_numbers(text, X[c]);
    }
    return good && take_word(text, "endloop") && take_word(text, "endfacet");
}

/* Counts the facets of an ASCII file, and keeps their corners where `corner` is not NULL. */
static bool read_ascii(const char *text, double scale, const char *path, struct corner *corner, size_t *count,
                       struct solver_error *error)
{
    *count = 0;
    if (!take_word(&text, "solid")) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "%.400s: is no STL file: it neither has the length of a binary one, 84 bytes and 50 for each "
            "triangle, nor begins with the word solid",
            path);
    }
    text += strcspn(text, "\n"); /* its name */
    while (!take_word(&text, "endsolid")) {
        double X[3][3];
        if (!take_facet(&text, X)) {
            return solver_fail(
                error, SOLVER_BAD_INPUT,
                "%.400s: triangle %zu: expected \"facet normal x y z outer loop vertex x y z (three times) "
                "endloop endfacet\" or \"endsolid\"",
                path, *count + 1);
        }
        for (size_t c = 0; corner != NULL && c < 3; c++) {
            if (!keep(corner, 3 * *count + c, X[c], scale, path, error)) {
                return false;
            }
        }
        (*count)++;
    }
    return true;
}

static int by_place(const void *left, const void *right)
{
    const struct corner *a = left;
    const struct corner *b = right;
    for (int i = 0; i < 3; i++) {
        if (a->X[i] != b->X[i]) {
            return a->X[i] < b->X[i] ? -1 : 1;
        }
    }
    return 0;
}

/* Vertices and triangles out of corners; triangles with a vertex twice are left out, as they have no area. */
static bool weld(struct solver_stl *surface, struct corner *corner, size_t count, struct solver_error *error)
{
    if (!solver_alloc((void **)&surface->vertex, 3 * count, sizeof *surface->vertex, "vertices", error) ||
        !solver_alloc((void **)&surface->triangle, count, sizeof *surface->triangle, "triangles", error)) {
        return false;
    }
    qsort(corner, 3 * count, sizeof *corner, by_place);
    for (size_t i = 0; i < 3 * count; i++) {
        if (i == 0 || by_place(&corner[i], &corner[i - 1]) != 0) {
            memcpy(surface->vertex[surface->vertex_count++], corner[i].X, sizeof corner[i].X);
        }
        surface->triangle[corner[i].at / 3][corner[i].at % 3] = (uint32_t)(surface->vertex_count - 1);
    }
    for (size_t t = 0; t < count; t++) {
        const uint32_t *of = surface->triangle[t];
        if (of[0] != of[1] && of[1] != of[2] && of[2] != of[0]) {
            memmove(surface->triangle[surface->count++], of, sizeof surface->triangle[0]);
        }
    }
    return true;
}

static bool read_surface(const char *path, double scale, const unsigned char *bytes, size_t size,
                         struct solver_stl *surface, struct solver_error *error)
{
    struct corner *corner = NULL;
    bool binary = is_binary(bytes, size);
    size_t count = binary ? (size - HEADER) / RECORD : 0;
    if (!binary && !read_ascii((const char *)bytes, scale, path, NULL, &count, error)) {
        return false;
    }
    if (count == 0) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%.400s: has no triangles", path);
    }
    bool good = solver_alloc((void **)&corner, 3 * count, sizeof *corner, "corners of triangles", error) &&
                (binary ? read_binary(bytes, count, scale, path, corner, error)
                        : read_ascii((const char *)bytes, scale, path, corner, &count, error)) &&
                weld(surface, corner, count, error);
    free(corner);
    return good && stl_close(surface, path, error) && stl_plant(surface, error);
}

bool solver_stl_read(const char *path, double scale, struct solver_stl **out, struct solver_error *error)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    *out = NULL;
    bool good = read_file(path, &bytes, &size, error) && bytes != NULL &&
                solver_alloc((void **)out, 1, sizeof **out, "surface of triangles", error) &&
                read_surface(path, scale, bytes, size, *out, error);
    free(bytes);
    if (!good) {
        solver_stl_free(*out);
        *out = NULL;
    }
    return good;
}

void solver_stl_free(struct solver_stl *surface)
{
    if (surface == NULL) {
        return;
    }
    free(surface->vertex);
    free(surface->triangle);
    free(surface->normal);
    free(surface->at_edge);
    free(surface->at_vertex);
    free(surface->box);
    free(surface->order);
    free(surface);
}
