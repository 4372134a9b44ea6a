/* Surfaces of triangles: distances against a box's formula and a ring's, signs against winding numbers, both kinds of
 * file, clouds and runs of them, and files that are broken or no closed surface. */
#include "solver/solid.h"
#include "solver/stl.h"
#include "tests/unit/clouds.h"
#include "tests/unit/runs.h"
#include "tests/unit/scratch.h"

#include <limits.h>

static const double pi = 3.14159265358979323846;
static char folder[SCRATCH];
static char path[SCRATCH_BELOW];

/* --- what is written --- */

struct mesh {
    size_t count;
    double corner[4096][3][3];
};
static struct mesh mesh;

static void add_triangle(const double a[3], const double b[3], const double c[3])
{
    memcpy(mesh.corner[mesh.count][0], a, 3 * sizeof *a);
    memcpy(mesh.corner[mesh.count][1], b, 3 * sizeof *b);
    memcpy(mesh.corner[mesh.count++][2], c, 3 * sizeof *c);
}

/* A box about the origin, two triangles a side. */
static void make_box(const double half[3])
{
    mesh.count = 0;
    for (int axis = 0; axis < 3; axis++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            double at[4][3];
            for (int k = 0; k < 4; k++) {
                double u = k == 1 || k == 2 ? 1 : -1, v = k >= 2 ? 1 : -1;
                at[k][axis] = sign * half[axis];
                at[k][(axis + 1) % 3] = u * half[(axis + 1) % 3];
                at[k][(axis + 2) % 3] = sign * v * half[(axis + 2) % 3];
            }
            add_triangle(at[0], at[1], at[2]);
            add_triangle(at[0], at[2], at[3]);
        }
    }
}

static void ring_point(int i, int j, int around, int across, double X[3])
{
    double u = 2 * pi * (i % around) / around, v = 2 * pi * (j % across) / across;
    X[0] = (1 + 0.4 * cos(v)) * cos(u);
    X[1] = (1 + 0.4 * cos(v)) * sin(u);
    X[2] = 0.4 * sin(v);
}

static void make_ring(int around, int across)
{
    mesh.count = 0;
    for (int i = 0; i < around; i++) {
        for (int j = 0; j < across; j++) {
            double a[3], b[3], c[3], d[3];
            ring_point(i, j, around, across, a);
            ring_point(i + 1, j, around, across, b);
            ring_point(i + 1, j + 1, around, across, c);
            ring_point(i, j + 1, around, across, d);
            add_triangle(a, b, c);
            add_triangle(a, c, d);
        }
    }
}

static void write_bytes(const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT_EQUAL(fwrite(bytes, 1, size, file), size);
    CU_ASSERT_EQUAL(fclose(file), 0);
}

static void write_ascii(void)
{
    FILE *file = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    (void)fprintf(file, "solid a body of triangles\n");
    for (size_t t = 0; t < mesh.count; t++) {
        (void)fprintf(file, "facet normal 0 0 0\n outer loop\n");
        for (int c = 0; c < 3; c++) {
            const double *X = mesh.corner[t][c];
            (void)fprintf(file, "  vertex %.9g %.9g %.9g\n", X[0], X[1], X[2]);
        }
        (void)fprintf(file, " endloop\nendfacet\n");
    }
    (void)fprintf(file, "endsolid a body of triangles\n");
    CU_ASSERT_EQUAL(fclose(file), 0);
}

static unsigned char bytes[84 + 50 * 4096];

/* Returns the size; the numbers are those of the machine, which has the file's order wherever this is built. */
static size_t pack(void)
{
    memset(bytes, 0, sizeof bytes);
    for (int i = 0; i < 4; i++) {
        bytes[80 + i] = (unsigned char)(mesh.count >> (8 * i) & 0xff);
    }
    for (size_t t = 0; t < mesh.count; t++) {
        for (size_t k = 0; k < 9; k++) {
            float number = (float)mesh.corner[t][k / 3][k % 3];
            memcpy(bytes + 84 + 50 * t + 12 + 4 * k, &number, 4);
        }
    }
    return 84 + 50 * mesh.count;
}

static struct solver_stl *read_back(double scale)
{
    struct solver_stl *surface = NULL;
    struct solver_error error = {.text = ""};
    bool good = solver_stl_read(path, scale, &surface, &error);
    (void)printf("%s", error.text);
    CU_ASSERT_FATAL(good);
    return surface;
}

/* --- distances --- */

static double box_distance(const double half[3], const double X[3])
{
    double outside = 0.0, inside = -INFINITY;
    for (int i = 0; i < 3; i++) {
        double q = fabs(X[i]) - half[i];
        outside += q > 0.0 ? q * q : 0.0;
        inside = fmax(inside, q);
    }
    return outside > 0.0 ? sqrt(outside) : inside;
}

static void distance_from_a_box(void)
{
    static const double half[3] = {0.5, 1.25, 0.75}; /* as floats too */
    uint64_t seed = 3;
    make_box(half);
    for (int kind = 0; kind < 4; kind++) { /* ASCII and binary, each as it is and in mm */
        double scale = kind < 2 ? 1.0 : 0.001, worst = 0.0;
        if (kind % 2 == 0) {
            write_ascii();
        } else {
            write_bytes(bytes, pack());
        }
        struct solver_stl *surface = read_back(scale);
        CU_ASSERT(surface->count == 12 && surface->vertex_count == 8);
        for (int k = 0; k < 4000; k++) {
            double X[3], scaled[3];
            for (int i = 0; i < 3; i++) {
                X[i] = k < 8 ? (k >> i & 1 ? 1 : -1) * half[i] * 1.1 : 2.0 * clouds_random(&seed);
                scaled[i] = scale * X[i];
            }
            worst = fmax(worst, fabs(solver_stl_distance(surface, scaled) / scale - box_distance(half, X)));
        }
        (void)printf("%.1e ", worst);
        CU_ASSERT(worst < 1e-14);
        solver_stl_free(surface);
    }
}

/* Solid angle of all triangles over 4 pi: 1 inside, 0 outside (van Oosterom, Strackee 1983). */
static double winding(const double X[3])
{
    double sum = 0.0;
    for (size_t t = 0; t < mesh.count; t++) {
        double r[3][3], length[3], d[3];
        for (int c = 0; c < 3; c++) {
            length[c] = 0.0;
            for (int i = 0; i < 3; i++) {
                r[c][i] = mesh.corner[t][c][i] - X[i];
                length[c] += r[c][i] * r[c][i];
            }
            length[c] = sqrt(length[c]);
        }
        for (int c = 0; c < 3; c++) {
            d[c] = 0.0;
            for (int i = 0; i < 3; i++) {
                d[c] += r[c][i] * r[(c + 1) % 3][i];
            }
        }
        double triple = 0.0;
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            triple += r[0][i] * (r[1][j] * r[2][k] - r[1][k] * r[2][j]);
        }
        sum += 2 * atan2(triple,
                         length[0] * length[1] * length[2] + d[0] * length[2] + d[1] * length[0] + d[2] * length[1]);
    }
    return sum / (4 * pi);
}

static void distance_from_a_ring(void)
{
    uint64_t seed = 5;
    make_ring(48, 24);
    write_ascii();
    struct solver_stl *surface = read_back(1.0);
    size_t wrong = 0, inside = 0;
    double worst = 0.0;
    for (int k = 0; k < 1500; k++) {
        double X[3] = {1.5 * clouds_random(&seed), 1.5 * clouds_random(&seed), 0.5 * clouds_random(&seed)};
        double distance = solver_stl_distance(surface, X);
        double exact = sqrt(pow(sqrt(X[0] * X[0] + X[1] * X[1]) - 1, 2) + X[2] * X[2]) - 0.4;
        worst = fmax(worst, fabs(distance - exact));
        wrong += (distance < 0.0) != (winding(X) > 0.5);
        inside += distance < 0.0;
    }
    (void)printf("%zu of 1500 inside, off the round ring by %.1e ", inside, worst);
    CU_ASSERT(wrong == 0 && inside > 200);
    CU_ASSERT(worst < 0.01); /* the polyhedron's: 1.4 (1 - cos(pi / 48)) + 0.4 (1 - cos(pi / 24)) = 6.4e-3 */
    solver_stl_free(surface);
}

/* Between faces that meet at a sharp edge the sign is that of both: of one alone it would be wrong behind its plane. */
static void sharp_edges(void)
{
    static const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0.25, 1, 0}, {0.5, 0.375, 0.125}};
    uint64_t seed = 9;
    size_t wrong = 0, inside = 0;
    mesh.count = 0;
    add_triangle(corner[0], corner[2], corner[1]);
    for (int k = 0; k < 3; k++) {
        add_triangle(corner[k], corner[(k + 1) % 3], corner[3]);
    }
    write_ascii();
    struct solver_stl *surface = read_back(1.0);
    for (int k = 0; k < 4000; k++) {
        double X[3] = {0.5 + clouds_random(&seed), 0.5 + clouds_random(&seed), 0.2 * clouds_random(&seed)};
        double distance = solver_stl_distance(surface, X);
        wrong += (distance < 0.0) != (winding(X) > 0.5);
        inside += distance < 0.0;
    }
    CU_ASSERT(wrong == 0 && inside > 20);
    solver_stl_free(surface);
}

/* --- clouds and runs --- */

static bool from_surface(const void *context, const double X[3], double *distance, struct solver_error *error)
{
    (void)error;
    *distance = solver_stl_distance(context, X);
    return true;
}

/* The polyhedron's volume, by the divergence theorem. */
static double mesh_volume(void)
{
    double sum = 0.0;
    for (size_t t = 0; t < mesh.count; t++) {
        const double(*c)[3] = (const double(*)[3])mesh.corner[t];
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            sum += c[0][i] * (c[1][j] * c[2][k] - c[1][k] * c[2][j]) / 6.0;
        }
    }
    return sum;
}

static void cloud_of_a_ring(void)
{
    make_ring(48, 24);
    write_bytes(bytes, pack());
    struct solver_stl *surface = read_back(1.0);
    struct solver_solid solid = {.dim = 3,
                                 .lower = {-1.6, -1.6, -0.6},
                                 .upper = {1.6, 1.6, 0.6},
                                 .spacing = 0.2,
                                 .distance = from_surface,
                                 .context = surface};
    struct solver_cloud *cloud = NULL;
    struct solver_error error;
    CU_ASSERT_FATAL(solver_cloud_solid(&solid, &cloud, &error));
    (void)printf("volume off by %.1e ", cloud->quality->volume / mesh_volume() - 1.0);
    CU_ASSERT_DOUBLE_EQUAL(cloud->quality->volume / mesh_volume(), 1.0, 5e-3);
    CU_ASSERT(cloud->quality->off_surface < 1e-6 && cloud->quality->least_volume > 0.09);
    solver_cloud_free(cloud);
    solver_stl_free(surface);
}

/* A scene beside its file names it without the folder, and moves as a body should: momentum is kept. */
static void scene_beside_its_file(void)
{
    char scene_path[SCRATCH_BELOW];
    const char *overrides[] = {"stencil=closed", "evolved=pF"};
    struct sample sample = {.run = NULL};
    make_ring(48, 24);
    write_bytes(bytes, pack());
    (void)snprintf(scene_path, sizeof scene_path, "%s/scene.lua", folder);
    FILE *file = fopen(scene_path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    (void)fprintf(file,
                  "%s%s%sdomain = { shape = 'stl', file = 'body.stl', scale = 0.5,\n"
                  "    lower = {-0.8, -0.8, -0.3}, upper = {0.8, 0.8, 0.3} }\n"
                  "reference_length, support = 0.4, 2.2\n",
                  block, plain_material, smooth_motion);
    CU_ASSERT_EQUAL(fclose(file), 0);
    CU_ASSERT_FATAL(solver_scene_load(scene_path, overrides, 2, &sample.scene, &sample.error));
    bool made = solver_run_create(sample.scene, &sample.run, &sample.error);
    (void)printf("%s", made ? "" : sample.error.text);
    CU_ASSERT_FATAL(made);
    advance_to(&sample, 0.5);
    const struct solver_history *history = solver_run_history(sample.run);
    const struct solver_totals *begin = &history->totals[0], *end = &history->totals[history->count - 1];
    for (int i = 0; i < 3; i++) {
        CU_ASSERT(fabs(end->linear[i] - begin->linear[i]) < 1e-13 * fabs(begin->linear[0]));
    }
    finish(&sample);
    CU_ASSERT_EQUAL(unlink(path), 0);
    CU_ASSERT_FATAL(solver_scene_load(scene_path, overrides, 2, &sample.scene, &sample.error));
    CU_ASSERT_FALSE(solver_run_create(sample.scene, &sample.run, &sample.error));
    CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "body.stl: cannot be opened"));
    finish(&sample);
    CU_ASSERT_EQUAL(unlink(scene_path), 0);
}

/* --- files that are refused --- */

static void refuse(const char *expected)
{
    struct solver_stl *surface = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    CU_ASSERT_FALSE(solver_stl_read(path, 1.0, &surface, &error));
    CU_ASSERT_PTR_NULL(surface);
    if (strstr(error.text, expected) == NULL) {
        (void)printf("\"%s\" does not name \"%s\"\n", error.text, expected);
        CU_FAIL("the message does not say what is wrong");
    }
}

static void refusals(void)
{
    unit_untrapped();
    static const double half[3] = {0.5, 1.25, 0.75};
    static const char *const texts[] = {
        "",
        "no triangles here",
        "solid",
        "solid x\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0",
        "solid x\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 zero endloop endfacet\nendsolid",
        "solid x\nfacet normal 0 0\nendsolid"};
    (void)unlink(path);
    refuse("cannot be opened");
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        write_bytes(texts[i], strlen(texts[i]));
        refuse(i < 2 ? "is no STL file" : "triangle 1: expected");
    }
    write_bytes("solid x\nendsolid", 16);
    refuse("has no triangles");
    make_box(half);
    mesh.count--;
    write_ascii();
    refuse("belongs to 1 triangle; expected two");
    make_box(half);
    memcpy(mesh.corner[0], mesh.corner[5], sizeof mesh.corner[0]);
    write_ascii();
    refuse("is no closed surface");
    make_box(half);
    for (int i = 0; i < 3; i++) { /* one triangle turned round */
        double kept = mesh.corner[3][1][i];
        mesh.corner[3][1][i] = mesh.corner[3][2][i];
        mesh.corner[3][2][i] = kept;
    }
    write_ascii();
    refuse("in the same direction");
    make_box((const double[3]){-0.5, 1.25, 0.75});
    write_ascii();
    refuse("is inside out");
    make_box(half);
    mesh.corner[4][1][2] = NAN;
    write_bytes(bytes, pack());
    refuse("triangle 5: a coordinate is nan");
    make_box(half);
    mesh.corner[4][1][2] = 1e39; /* beyond a float: infinite */
    write_bytes(bytes, pack());
    refuse("triangle 5: a coordinate is inf");
    make_box(half);
    size_t size = pack();
    for (size_t cut = 0; cut < size; cut += 37) { /* cut short anywhere */
        write_bytes(bytes, cut);
        refuse("is no STL file");
    }
    bytes[83] = 0xff; /* four thousand million triangles */
    write_bytes(bytes, size);
    refuse("is no STL file");
}

/* Any change of a byte is either refused or leaves a closed surface. */
static void changed_bytes(void)
{
    unit_untrapped();
    static const double half[3] = {0.5, 1.25, 0.75};
    uint64_t seed = 11;
    size_t accepted = 0;
    make_box(half);
    size_t size = pack();
    for (int k = 0; k < 500; k++) {
        size_t at = (size_t)((clouds_random(&seed) + 1.0) / 2.0 * (double)size);
        unsigned char kept = bytes[at];
        bytes[at] ^= (unsigned char)(1U << (k % 8));
        write_bytes(bytes, size);
        struct solver_stl *surface = NULL;
        struct solver_error error = {.text = ""};
        if (solver_stl_read(path, 1.0, &surface, &error)) {
            accepted++;
            CU_ASSERT(isfinite(solver_stl_distance(surface, (const double[3]){0.1, 0.2, 0.3})));
        } else {
            CU_ASSERT(error.code == SOLVER_BAD_INPUT && error.text[0] != '\0');
        }
        solver_stl_free(surface);
        bytes[at] = kept;
    }
    CU_ASSERT(accepted > 50 && accepted < 450); /* headers and normals are not looked at */
    (void)unlink(path);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"distance from a box", distance_from_a_box},
        {"distance from a ring", distance_from_a_ring},
        {"sharp edges", sharp_edges},
        {"cloud of a ring", cloud_of_a_ring},
        {"scene beside its file", scene_beside_its_file},
        {"refusals", refusals},
        {"changed bytes", changed_bytes},
    };
    scratch_folder(folder);
    (void)snprintf(path, sizeof path, "%s/body.stl", folder);
    int result = unit_main("solver surfaces of triangles", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    return result;
}
