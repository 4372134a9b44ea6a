/* Scenes of bodies of any shape: what they give a run, planes of symmetry, refusals. */
#include "solver/cloud.h"
#include "tests/unit/runs.h"
#include "tests/unit/scratch.h"

static const char disc[] =
    "domain = { shape = 'solid', lower = {-1.25, -1.25}, upper = {1.25, 1.25}, symmetry = SYMMETRY,\n"
    "    distance = function(X, Y) return math.sqrt(X * X + Y * Y) - 1 end }\n"
    "reference_length, support = 1, 2.2\n";

static struct sample disc_with(const char *symmetry, const char *more, const char *words)
{
    char text[2048];
    const char *place = strstr(disc, "SYMMETRY");
    int length = snprintf(text, sizeof text, "%.*s%s%s%s", (int)(place - disc), disc, symmetry,
                          place + strlen("SYMMETRY"), more);
    CU_ASSERT_FATAL(length > 0 && (size_t)length < sizeof text);
    return start(text, "dim=2 stencil=closed %s", words);
}

/* A quarter between planes of symmetry has a quarter of the volume and moves as the whole does: it is compared where
 * both have their particles, on the planes, for a motion that has this symmetry. */
static void symmetry(void)
{
    static const char stretch[] = "initial = { velocity = function(X, Y) return 0.1 * math.sin(X), -0.05 * Y end }\n";
    struct sample whole = disc_with("nil", stretch, "n=8 evolved=pF");
    struct sample quarter = disc_with("{ X = 0, Y = 0 }", stretch, "n=8 evolved=pF");
    double volume[2] = {0}, energy[2] = {0};
    advance_to(&whole, 0.5);
    advance_to(&quarter, 0.5);
    struct sample *both[2] = {&whole, &quarter};
    size_t on_planes = 0;
    for (int s = 0; s < 2; s++) {
        struct solver_output output = output_of(both[s]);
        const struct solver_history *history = solver_run_history(both[s]->run);
        energy[s] = history->totals[history->count - 1].strain;
        for (size_t a = 0; a < output.cloud->count; a++) {
            volume[s] += output.V[a];
            for (size_t i = 0; s == 1 && i < 2; i++) {
                bool on = (output.cloud->tags[a] >> (2 * i) & 1U) != 0;
                on_planes += on;
                CU_ASSERT_EQUAL(on, fabs(output.cloud->X[2 * a + i]) < 1e-12);
                CU_ASSERT(!on || (output.v[2 * a + i] == 0.0 && output.u[2 * a + i] == 0.0));
            }
        }
    }
    CU_ASSERT_EQUAL(on_planes, 18); /* 9 on each, the corner on both */
    CU_ASSERT_DOUBLE_EQUAL(volume[0] / volume[1], 4.0, 1e-3);
    CU_ASSERT_DOUBLE_EQUAL(energy[0] / energy[1], 4.0, 0.04);
    (void)printf("volume %.5f energy %.5f ", volume[0] / volume[1], energy[0] / energy[1]);
    finish(&whole);
    finish(&quarter);
}

/* The run tells how well its cloud fits; a box has nothing to tell. */
static void quality(void)
{
    struct sample solid = disc_with("nil", "", "n=8");
    struct sample box = start("", "dim=2");
    struct solver_output output = output_of(&solid), plain = output_of(&box);
    CU_ASSERT_PTR_NULL(plain.cloud->quality);
    CU_ASSERT_PTR_NOT_NULL_FATAL(output.cloud->quality);
    CU_ASSERT(output.cloud->quality->on_surface > 40 && output.cloud->quality->off_surface < 1e-9);
    finish(&solid);
    finish(&box);
}

/* Formulas are asked where the body is: what they say of a hole, or beyond the surface, does not matter. */
static void formulas(void)
{
    static const char tube[] =
        "domain = { shape = 'solid', lower = {0, 0}, upper = {2.5, 2.5}, symmetry = { X = 0, Y = 0 },\n"
        "    distance = function(X, Y) local R = math.sqrt(X * X + Y * Y) return math.max(1 - R, R - 2) end }\n"
        "reference_length, support = 1, 2.2\n"
        "local function radial(X, Y) local R = math.sqrt(X * X + Y * Y) return X / R, Y / R end\n"
        "faces = { surface = { kind = 'traction', value = radial } }\n"
        "initial = { velocity = radial }\n";
    struct sample sample = start(tube, "dim=2 stencil=closed n=4");
    advance_to(&sample, 0.01);
    finish(&sample);
}

/* The error of a scene that is refused when it is read, or when its run is made. */
static struct solver_error refused(const char *text, int dim)
{
    char path[SCRATCH], word[16];
    const char *overrides[2] = {word, "stencil=closed"};
    struct sample sample = {.run = NULL};
    scratch_text(path, "%s%s%s\n", block, plain_material, text);
    (void)snprintf(word, sizeof word, "dim=%d", dim);
    CU_ASSERT(!solver_scene_load(path, overrides, 2, &sample.scene, &sample.error) ||
              !solver_run_create(sample.scene, &sample.run, &sample.error));
    (void)unlink(path);
    struct solver_error error = sample.error;
    finish(&sample);
    return error;
}

static void refusals(void)
{
    unit_untrapped();
    static const struct {
        const char *text;
        int dim;
        const char *expected;
    } cases[] = {
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1} }", 2, "domain.distance: missing"},
        {"domain = { shape = 'solid', distance = function() return -1 end }", 2, "domain.lower: missing"},
        {"domain = { lower = {0, 0}, upper = {1, 1}, distance = function() return -1 end }", 2,
         "domain.distance: a domain of domain.shape = \"box\" has none"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = 1 }", 2,
         "domain.distance: expected function(X, Y, Z) returning one number"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = function() return 1, 2 end }", 2,
         "domain.distance at X = (0, 0, 0), t = 0: expected 1 number, got 2"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = function() return 0 / 0 end }", 2,
         "expected a number, got NaN"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = function(X) return 5 * X - 2 end }", 2,
         "domain.distance: changes by"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = function(X) return X + 1 end }", 2,
         "no node of the lattice lies in the body"},
        {"domain = { shape = 'solid', lower = {0}, upper = {1}, distance = function() return -1 end }", 1,
         "domain.shape: a solid lies in 2D or 3D"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = function() return -1 end }\n"
         "lattice = 'centres'",
         2, "lattice: a solid has particles on its surface"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = function() return -1 end }\n"
         "perturb = 0.1",
         2, "perturb: expected 0 with a solid"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1}, distance = function() return -1 end }\n"
         "oracle, loads = { name = 'breathing-cylinder' }, { from = 'oracle' }\n"
         "faces = { surface = { kind = 'traction' } }",
         2, "faces.surface: loads.from: the exact traction is that on a normal"},
        {"domain = { shape = 'solid', lower = {0, 0}, upper = {1, 1.1}, distance = function() return -1 end }", 2,
         "expected a whole number"},
        {"domain = { lower = {0, 0}, upper = {1, 1}, symmetry = { Z = 0 } }", 2,
         "domain.symmetry.Z: a body of dim = 2 has no such axis"},
        {"domain = { lower = {0, 0}, upper = {1, 1}, symmetry = { X = 1 } }", 2,
         "domain.symmetry.X: expected a plane that cuts the domain, from 0 to less than 1 m, got 1"},
        {"domain = { lower = {0, 0}, upper = {1, 1}, symmetry = { X = 'a' } }", 2,
         "domain.symmetry.X: expected a number [m]"},
        {"domain = { lower = {0, 0}, upper = {1, 1}, symmetry = 0 }", 2, "domain.symmetry: expected"},
        {"domain = { lower = {0, 0}, upper = {1, 1}, symmetry = { X = 0 } }\nfaces = { X0 = 'clamped' }", 2,
         "faces.X0: domain.symmetry.X makes it symmetric"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct solver_error error = refused(cases[i].text, cases[i].dim);
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
        if (strstr(error.text, cases[i].expected) == NULL) {
            (void)printf("\"%s\" does not name \"%s\"\n", error.text, cases[i].expected);
            CU_FAIL("the message does not say what is wrong");
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"planes of symmetry", symmetry},
        {"quality of the cloud", quality},
        {"formulas within the body", formulas},
        {"refusals", refusals},
    };
    return unit_main("scenes of bodies of any shape", tests, sizeof tests / sizeof *tests);
}
