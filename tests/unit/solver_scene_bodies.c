/* Scenes of several bodies, of a round one, and of particles in the centres of cells: what is read, and what is
 * refused.
 */
#include "solver/cloud.h"
#include "solver/scene.h"
#include "tests/unit/scene_files.h"

#define PLAIN_DOMAIN "domain = { lower = {0, 0}, upper = {2, 1} }"
#define RINGS                                                                                                          \
    "lattice, reference_length = 'centres', 1\n"                                                                       \
    "bodies = { { shape = 'ring', centre = {-3, 0}, inner = 1, outer = 2 }, { shape = 'box', lower = {0, -1}, upper "  \
    "= {2, 1} } }"

static struct solver_scene *load(const char *override)
{
    struct solver_scene *scene = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    if (!solver_scene_load(path, &override, override ? 1 : 0, &scene, &error)) {
        printf("%s\n", error.text);
        CU_FAIL("the scene is refused");
    }
    CU_ASSERT_PTR_NOT_NULL_FATAL(scene);
    return scene;
}

static void read_bodies(void)
{
    write_changed(PLAIN_DOMAIN, RINGS);
    struct solver_scene *scene = load(NULL);
    CU_ASSERT_EQUAL_FATAL(scene->shape_count, 2);
    const struct solver_shape *ring = &scene->shape[0], *box = &scene->shape[1];
    CU_ASSERT(ring->kind == SOLVER_SHAPE_RING && box->kind == SOLVER_SHAPE_BOX);
    CU_ASSERT(ring->centre[0] == -3 && ring->centre[1] == 0 && ring->inner == 1 && ring->outer == 2);
    CU_ASSERT(ring->lower[0] == -5 && ring->lower[1] == -2 && ring->upper[0] == -1 && ring->upper[1] == 2);
    CU_ASSERT(box->lower[0] == 0 && box->lower[1] == -1 && box->upper[0] == 2 && box->upper[1] == 1);
    CU_ASSERT(scene->lower[0] == -5 && scene->lower[1] == -2 && scene->upper[0] == 2 && scene->upper[1] == 2);
    CU_ASSERT_EQUAL(scene->lattice, SOLVER_CENTRES);
    solver_scene_free(scene);
}

static void read_lattice(void)
{
    char word[SOLVER_NAME];
    write_changed(NULL, "");
    struct solver_scene *scene = load(NULL);
    CU_ASSERT(scene->lattice == SOLVER_NODES && scene->wall == 3 && scene->shape_count == 0);
    CU_ASSERT(solver_scene_text(scene, "lattice", word, sizeof word) && strcmp(word, "nodes") == 0);
    solver_scene_free(scene);
    write_changed(NULL,
                  "wall = 5\nfaces = { X1 = 'clamped', Y0 = { kind = 'motion', value = function() return 0, 0 end } }");
    scene = load("lattice=centres");
    for (int face = 0; face < 4; face++) {
        CU_ASSERT_EQUAL(solver_scene_wall(scene, face), face == 1 || face == 2 ? 5 : 0);
    }
    CU_ASSERT(solver_scene_text(scene, "lattice", word, sizeof word) && strcmp(word, "centres") == 0);
    solver_scene_free(scene);
    scene = load("lattice=nodes");
    CU_ASSERT(solver_scene_wall(scene, 1) == 0 && solver_scene_wall(scene, 2) == 0);
    solver_scene_free(scene);
}

static void read_round(void)
{
    write_changed(PLAIN_DOMAIN, "domain = { shape = 'disc', centre = {3, -1}, radius = 2 }\n"
                                "faces = { surface = { kind = 'traction', value = function() return 0, 0 end } }");
    struct solver_scene *scene = load("domain.radius=1.5");
    char word[SOLVER_NAME];
    CU_ASSERT(scene->domain.kind == SOLVER_SHAPE_DISC && scene->shape_count == 0 && scene->domain.outer == 1.5);
    CU_ASSERT(scene->lower[0] == 1.5 && scene->lower[1] == -2.5 && scene->upper[0] == 4.5 && scene->upper[1] == 0.5);
    CU_ASSERT(scene->reference_length == 1.5 && scene->face[SOLVER_SURFACE] == SOLVER_TRACTION);
    CU_ASSERT(solver_scene_text(scene, "domain.shape", word, sizeof word) && strcmp(word, "disc") == 0);
    CU_ASSERT(solver_scene_has(scene, SOLVER_FACE_SURFACE) && !solver_scene_has(scene, SOLVER_FACE_Z1));
    solver_scene_free(scene);
    static const char rod[] = "title, dim, n, t_end = 'rod', 3, 4, 1\n"
                              "domain = { shape = 'cylinder', centre = {0, 0, 5}, radius = 2, length = 3 }\n"
                              "material = { model = 'neo-hookean', E = 10, nu = 0.3, rho = 2 }\n"
                              "body_force = function(X, Y) assert(X * X + Y * Y < 5, 'outside') return 0, 0, 0 end\n";
    write_scene(rod, strlen(rod));
    scene = load("faces.Z1.kind=clamped");
    CU_ASSERT(scene->domain.kind == SOLVER_SHAPE_CYLINDER && scene->lower[2] == 3.5 && scene->upper[2] == 6.5);
    CU_ASSERT(scene->face[5] == SOLVER_CLAMPED && scene->face[SOLVER_SURFACE] == SOLVER_FREE);
    solver_scene_free(scene);
}

/* Formulas are tried within a body, not in the corner of the box around all, which may be outside of every one. */
static void formulas(void)
{
    write_changed(PLAIN_DOMAIN, RINGS "\nbody_force = function(X, Y)\n"
                                      "    assert(math.sqrt((X + 3) ^ 2 + Y ^ 2) <= 2, 'outside')\n"
                                      "    return 0, 0\nend");
    solver_scene_free(load(NULL));
}

struct bad {
    const char *old, *new, *override, *expected;
};

static void check_refused(const struct bad *bad)
{
    struct solver_scene *scene = NULL;
    struct solver_error error = {.code = SOLVER_OK};
    write_changed(bad->old, bad->new);
    bool told = !solver_scene_load(path, &bad->override, bad->override ? 1 : 0, &scene, &error) &&
                error.code == SOLVER_BAD_INPUT && !strncmp(error.text, path, strlen(path)) &&
                strstr(error.text, bad->expected);
    if (!told)
        printf("\nexpected: ...%s...\n     got: %s\n", bad->expected, scene ? "no error" : error.text);
    CU_ASSERT_TRUE(told);
    solver_scene_free(scene);
}

static void bad_bodies(void)
{
    unit_untrapped();
#define WITH(bodies) PLAIN_DOMAIN, "lattice, reference_length = 'centres', 1\nbodies = " bodies
    static const struct bad bad[] = {
        {PLAIN_DOMAIN, "", 0,
         ": domain.lower: missing; expected list of dim numbers [m] (lower corner of the box, or of that around a "
         "solid), or "
         "bodies = { ... }"},
        {", upper = {2, 1}", "", 0, ": domain.upper: missing; expected list of dim numbers"},
        {0, RINGS, 0, ": bodies: the scene has a domain besides; expected one of the two"},
        {WITH("3"), 0, "bodies: expected a list of { shape = \"box\" or \"ring\", ... }, got 3"},
        {WITH("{}"), 0, "bodies: expected one body or more, got an empty list"},
        {WITH("{ shape = 'box' }"), 0, "bodies: expected a list without gaps and without names"},
        {WITH("{ 4 }"), 0, "bodies[1]: expected { shape = \"box\", lower"},
        {WITH("{ {} }"), 0, "bodies[1].shape: expected \"box\" or \"ring\", got nothing"},
        {WITH("{ { shape = 'disc' } }"), 0, "bodies[1].shape: expected \"box\" or \"ring\", got the text 'disc'"},
        {WITH("{ { shape = 'box', lower = {0, 0} } }"), 0,
         "bodies[1].upper: expected a list of 2 numbers, got nothing"},
        {WITH("{ { shape = 'box', lower = {0, 0}, upper = {1, 0/0} } }"), 0,
         "bodies[1].upper[2]: expected a number, got NaN"},
        {WITH("{ { shape = 'box', lower = {0, 0}, upper = {1, -1} } }"), 0,
         "bodies[1].upper[2]: expected a number above bodies[1].lower[2] = 0, got -1"},
        {WITH("{ { shape = 'box', lower = {0, 0}, upper = {1, 1}, outer = 1 } }"), 0,
         "bodies[1].outer: unknown key; expected shape lower upper"},
        {WITH("{ { shape = 'ring', centre = {0}, inner = 1, outer = 2 } }"), 0,
         "bodies[1].centre: expected a list of 2 numbers, got 1 entries"},
        {WITH("{ { shape = 'ring', centre = {0, 0}, inner = 0, outer = 2 } }"), 0,
         "bodies[1].inner: expected number > 0 [m], got 0"},
        {WITH("{ { shape = 'ring', centre = {0, 0}, inner = 2, outer = 2 } }"), 0,
         "bodies[1].outer: expected a number above bodies[1].inner = 2, got 2"},
        {WITH("{ { shape = 'ring', centre = {0, 0}, inner = 1, outer = 2.1 } }"), 0,
         "n = 4: bodies[1]: the ring's thickness, 1.1 m, is 4.4 spacings of 0.25 m; expected a whole number"},
        {WITH("{ { shape = 'ring', centre = {0, 0}, inner = 1, outer = 1.25 } }"), 0, "is one spacing; at least two"},
        {WITH("{ { shape = 'box', lower = {0, 0}, upper = {1, 1.1} } }"), 0,
         "n = 4: bodies[1]: the edge along Y, 1.1 m, is 4.4 spacings of 0.25 m; expected a whole number"},
        {PLAIN_DOMAIN, RINGS, "n=1000000", "of memory; this machine has"},
        {PLAIN_DOMAIN, RINGS, "lattice=nodes", "lattice: bodies have their particles in the centres of cells"},
        {PLAIN_DOMAIN, RINGS, "perturb=0.1", "perturb: expected 0 with bodies, got 0.1"},
        {PLAIN_DOMAIN, RINGS "\nfaces = { X0 = 'clamped' }", 0,
         "faces.X0: 'clamped' is a condition on a face of the domain"},
        {PLAIN_DOMAIN, "lattice = 'centres'\nbodies = { { shape = 'ring', centre = {0, 0}, inner = 1, outer = 2 } }", 0,
         "reference_length: missing; expected number > 0 [m]"},
    };
#undef WITH
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        check_refused(&bad[i]);
    static const struct bad flat = {"dim = 2\ndomain = { lower = {0, 0}, upper = {2, 1} }",
                                    "dim = 1\nlattice, reference_length = 'centres', 1\n"
                                    "bodies = { { shape = 'ring', centre = {0, 0}, inner = 1, outer = 2 } }",
                                    0, "bodies[1].shape: a ring lies in the plane; expected dim = 2, got 1"};
    check_refused(&flat);
}

static void bad_round(void)
{
    unit_untrapped();
#define DISC(more)  PLAIN_DOMAIN, "domain = { shape = 'disc', centre = {0, 0}, radius = 2" more
#define SOLID(more) "dim = 2\n" PLAIN_DOMAIN, "dim = 3\ndomain = { centre = {0, 0, 0}, radius = 2, " more
    static const struct bad bad[] = {
        {PLAIN_DOMAIN, "domain = { shape = 'egg' }", 0,
         "domain.shape: expected one of box, disc, ball, cylinder, solid, stl, got the text 'egg'"},
        {DISC(" } grading = { X = 2 }"), 0, "grading.X: expected 1 but in a domain that is a box"},
        {PLAIN_DOMAIN, "domain = { shape = 'disc', radius = 2 }", 0,
         "domain.centre: missing; expected list of dim numbers [m] (of a round domain)"},
        {PLAIN_DOMAIN, "domain = { shape = 'disc', centre = {0, 0} }", 0,
         "domain.radius: missing; expected number > 0"},
        {PLAIN_DOMAIN, "domain = { shape = 'disc', centre = {0}, radius = 2 }", 0,
         "domain.centre: expected a list of 2 numbers, got 1 entries"},
        {PLAIN_DOMAIN, "domain = { shape = 'disc', centre = {0, 0}, radius = 0 }", 0,
         "domain.radius: expected number > 0 [m], got 0"},
        {DISC(", upper = {2, 2} }"), 0, "domain.upper: a domain of domain.shape = \"disc\" has none"},
        {DISC(", length = 2 }"), 0, "domain.length: a domain of domain.shape = \"disc\" has none"},
        {PLAIN_DOMAIN, "domain = { lower = {0, 0}, upper = {2, 1}, radius = 1 }", 0,
         "domain.radius: a domain of domain.shape = \"box\" has none"},
        {PLAIN_DOMAIN, "domain = { shape = 'ball', centre = {0, 0}, radius = 2 }", 0,
         "domain.shape: a ball lies in 3D; expected dim = 3, got 2"},
        {SOLID("shape = 'disc' }"), 0, "domain.shape: a disc lies in 2D; expected dim = 2, got 3"},
        {SOLID("shape = 'cylinder' }"), 0, "domain.length: missing; expected number > 0 [m] (of a cylinder)"},
        {SOLID("shape = 'cylinder', length = 2.3 }"), 0,
         "n = 4: the domain's length, 2.3 m, is 4.6 spacings of 0.5 m; expected a whole number"},
        {DISC(" }\nreference_length = 3"), 0,
         "n = 4: the domain's radius, 2 m, is 2.66667 spacings of 0.75 m; expected a whole number"},
        {SOLID("shape = 'ball' }"), "n=100000", "of memory; this machine has"},
        {DISC(" }"), "lattice=centres", "lattice: a disc has particles on its surface; expected \"nodes\""},
        {DISC(" }"), "perturb=0.1", "perturb: expected 0 with a disc, got 0.1"},
        {DISC(" }\nfaces = { X0 = 'clamped' }"), 0, "faces.X0: a domain of domain.shape = \"disc\" has no such face"},
        {SOLID("shape = 'cylinder', length = 2 }\nfaces = { Y1 = 'clamped' }"), 0,
         "faces.Y1: a domain of domain.shape = \"cylinder\" has no such face"},
        {DISC(", symmetry = 3 }"), 0, "domain.symmetry: expected { X = place, ... }"},
        {DISC(", symmetry = { 0 } }"), 0, "domain.symmetry.: unknown key; expected { X = place, ... }"},
        {DISC(", symmetry = { x = 0 } }"), 0, "domain.symmetry.x: unknown key; expected { X = place, ... }"},
        {DISC(", symmetry = { Z = 0 } }"), 0, "domain.symmetry.Z: a body of dim = 2 has no such axis"},
        {DISC(", symmetry = { X = true } }"), 0, "domain.symmetry.X: expected a number [m], got true"},
        {DISC(", symmetry = { X = 0/0 } }"), 0, "domain.symmetry.X: expected a number [m], got NaN"},
        {DISC(", symmetry = { Y = 0.1 } }"), 0, "domain.symmetry.Y: expected the centre of the round body, 0, got 0.1"},
        {SOLID("shape = 'cylinder', length = 2, symmetry = { Z = 0 } }"), 0,
         "domain.symmetry.Z: expected a plane across a curved axis"},
        {DISC(", symmetry = { X = 0 } }\nfaces = { X0 = 'clamped' }"), 0,
         "faces.X0: domain.symmetry.X makes it symmetric"},
        {DISC(", symmetry = { X = 0 } }\nfaces = { Y0 = 'symmetric' }"), 0,
         "faces.Y0: a domain of domain.shape = \"disc\" has no such face"},
        {0, "faces = { surface = 'clamped' }", 0, "faces.surface: a domain of domain.shape = \"box\" has no such face"},
        {DISC(" }\nfaces = { surface = 'symmetric' }"), 0,
         "faces.surface: 'symmetric' is a condition on a plane; expected free, clamped, traction or motion"},
        {DISC(" }\nfaces = { surface = { kind = 'roller', value = function() return 0, 0 end } }"), 0,
         "faces.surface: 'roller' is a condition on a plane"},
        {DISC(" }\nfaces = { surface = { kind = 'traction', value = function(X) return X end } }"), 0,
         "faces.surface.value at X = (2, 0, 0), t = 0: expected 2 numbers, got 1"},
    };
#undef DISC
#undef SOLID
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        check_refused(&bad[i]);
}

static void bad_centres(void)
{
#define MOTION "{ kind = 'motion', value = function() return 0, 0 end"
    static const struct bad bad[] = {
        {0, "faces = { Y1 = 'symmetric' }", "lattice=centres",
         "faces.Y1: 'symmetric' acts on particles that lie on the face; expected lattice = \"nodes\""},
        {0, "faces = { X0 = 'skew-symmetric' }", "lattice=centres", "faces.X0: 'skew-symmetric' acts on particles"},
        {0, "faces = { X1 = { kind = 'traction', value = function() return 0, 0 end } }", "lattice=centres",
         "faces.X1: 'traction' acts on particles"},
        {0, "faces = { X1 = " MOTION ", free_after = 0.5 } }", "lattice=centres",
         "faces.X1.free_after: with lattice = \"centres\" a wall moves the face"},
        {0, "lattice, support = 'centres', 2.4\nfaces = { X1 = " MOTION " } }", "wall=2",
         "wall: 2 layers beyond faces.X1 are thinner than the support of 2.4 spacings; expected 3"},
        {0, "wall = 0", 0, "wall: expected whole number in [1, 16], got 0"},
        {0, "lattice = 'corners'", 0, "lattice: expected one of nodes, centres, got the text 'corners'"},
        {0, "lattice, reference_length = 'centres', 1", "n=1",
         "n = 1: the edge along Y is one spacing; with lattice = \"centres\" at least two are needed"},
    };
#undef MOTION
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        check_refused(&bad[i]);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"bodies", read_bodies},
        {"lattice", read_lattice},
        {"round domains", read_round},
        {"formulas are tried within a body", formulas},
        {"bad bodies", bad_bodies},
        {"bad round domains", bad_round},
        {"what centres cannot have", bad_centres},
    };
    return scene_files_main("solver scene of bodies", tests, sizeof tests / sizeof *tests);
}
