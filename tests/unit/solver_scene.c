/* Good scenes are read as written, with overrides, defaults and formulas. */
#include "solver/scene.h"
#include "tests/unit/scene_files.h"

static const char swinging_cube[] = TEST_SOURCE_DIR "/verify/scenes/swinging-cube.lua";

/* Loads the file just written, with up to one override; prints the error when a good scene is refused. */
static struct solver_scene *load_good(const char *override)
{
    struct solver_scene *scene;
    struct solver_error error = {0};
    if (!solver_scene_load(path, &override, override ? 1 : 0, &scene, &error))
        printf("\nrefused: %s\n", error.text);
    CU_ASSERT_PTR_NOT_NULL_FATAL(scene);
    return scene;
}

static void plain_scene_and_defaults(void)
{
    write_scene(plain, strlen(plain));
    struct solver_scene *scene = load_good(NULL);
    CU_ASSERT_STRING_EQUAL(scene->name, "scene");
    CU_ASSERT_STRING_EQUAL(scene->title, "plain");
    CU_ASSERT_STRING_EQUAL(scene->text, plain);
    CU_ASSERT_STRING_EQUAL(scene->overrides, "");
    CU_ASSERT_EQUAL(scene->dim, 2);
    CU_ASSERT_EQUAL(scene->upper[0], 2);
    CU_ASSERT_EQUAL(scene->reference_length, 2);
    CU_ASSERT_EQUAL(scene->n, 4);
    CU_ASSERT_EQUAL(scene->level_count, 1);
    CU_ASSERT_EQUAL(scene->levels[0], 4);
    CU_ASSERT_STRING_EQUAL(scene->scheme, "upwind");
    CU_ASSERT_EQUAL(scene->evolved, SOLVER_PFHJ);
    CU_ASSERT_STRING_EQUAL(scene->stencil, "sbp4");
    CU_ASSERT_STRING_EQUAL(scene->integrator, "rk4");
    CU_ASSERT_STRING_EQUAL(scene->reconstruction, "stencil");
    CU_ASSERT_STRING_EQUAL(scene->precision, "double");
    CU_ASSERT_EQUAL(scene->support, 2.0);
    CU_ASSERT_EQUAL(scene->cfl, 0.8);
    CU_ASSERT_EQUAL(scene->perturb, 0);
    CU_ASSERT_EQUAL(scene->seed, 1);
    CU_ASSERT_EQUAL(scene->threads, 0);
    CU_ASSERT_FALSE(scene->has_view);
    CU_ASSERT_FALSE(solver_scene_has(scene, SOLVER_INITIAL_DISPLACEMENT));
    CU_ASSERT_TRUE(solver_scene_has(scene, SOLVER_INITIAL_VELOCITY));
    for (int f = 0; f < SOLVER_FACES; f++)
        CU_ASSERT_EQUAL(scene->face[f], SOLVER_FREE);

    double value[3], X[3] = {0.5, 0.25, 0};
    struct solver_error error;
    CU_ASSERT_TRUE(solver_scene_eval(scene, SOLVER_INITIAL_VELOCITY, X, 0, value, 2, &error));
    CU_ASSERT_EQUAL(value[0], 0.5);
    CU_ASSERT_EQUAL(value[1], 0.25);
    CU_ASSERT_FALSE(solver_scene_eval(scene, SOLVER_INITIAL_VELOCITY, X, 0, value, 10, &error));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "scene.lua: initial.velocity: no formula returns 10 numbers"));
    CU_ASSERT_FALSE(solver_scene_eval(scene, SOLVER_BODY_FORCE, X, 0, value, 2, &error));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "scene.lua: body_force: the scene gives no such formula"));
    solver_scene_free(scene);
    solver_scene_free(NULL);
}

/* A formula that fails late names place and time, and the scene stays usable. */
static void formula_fails_late(void)
{
    write_changed("return X, Y", "if X > 1 then while true do end end if t > 1 then return 1 end return X, material.E");
    struct solver_scene *scene = load_good("material.E=12");
    struct solver_error error;
    double value[2];
    CU_ASSERT_FALSE(
        solver_scene_eval(scene, SOLVER_INITIAL_VELOCITY, (double[3]){1.5, 0.5, 0}, 0.25, value, 2, &error));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, ".lua:7: initial.velocity at X = (1.5, 0.5, 0), t = 0.25: did not end"));
    CU_ASSERT_FALSE(solver_scene_eval(scene, SOLVER_INITIAL_VELOCITY, (double[3]){0}, 2, value, 2, &error));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "expected 2 numbers, got 1"));
    CU_ASSERT_TRUE(solver_scene_eval(scene, SOLVER_INITIAL_VELOCITY, (double[3]){1}, 0, value, 2, &error));
    CU_ASSERT_EQUAL(value[1], 12);
    solver_scene_free(scene);
}

/* A view without directions looks from a corner in space, and face on at a plane. */
static void default_views(void)
{
    static const char view[] = "n = 4\nview = { field = 'pressure', range = {0, 1} }";
    write_changed("n = 4", view);
    struct solver_scene *flat = load_good(NULL);
    CU_ASSERT(flat->view.direction[0] == 0 && flat->view.direction[1] == 0 && flat->view.direction[2] == 1);
    CU_ASSERT(flat->view.up[0] == 0 && flat->view.up[1] == 1 && flat->view.up[2] == 0);
    solver_scene_free(flat);
    const char *const set[] = {"view.direction={1,2,3}"};
    struct solver_scene *cube = NULL;
    struct solver_error error = {0};
    CU_ASSERT_FATAL(solver_scene_load(swinging_cube, set, 1, &cube, &error));
    CU_ASSERT(cube->view.direction[0] == 1 && cube->view.up[2] == 1);
    solver_scene_free(cube);
}

static void overrides(void)
{
    double number;
    char text[SOLVER_TEXT];
    write_changed("n = 4", "n = 4\nparameters = { A = 1, B = 2 }\nlevels = {n, 2 * n}\n"
                           "cfl = 0.1 * A + B / 10\nview = { field = 'x', range = {0, n}, bands = #levels }");
    const char *set[] = {"n=8",
                         "A=3",
                         "material.nu=0.4999",
                         "stencil=closed",
                         "threads=2",
                         "seed=7",
                         "evolved=pF",
                         "material.model=linear-elastic",
                         "perturb=0.1",
                         "perturb=0.15",
                         "view.size={640,480}",
                         "faces.X0=clamped",
                         "oracle.name=c",
                         "oracle.nu=0.31",
                         "oracle.A=5",
                         "oracle.material.rho=3",
                         "title=A good title"};
    struct solver_scene *scene;
    struct solver_error error = {0};
    CU_ASSERT_TRUE(solver_scene_load(path, set, sizeof set / sizeof *set, &scene, &error));
    CU_ASSERT_STRING_EQUAL(error.text, "");
    if (!scene)
        return;
    CU_ASSERT_EQUAL(strncmp(scene->overrides, "n=8\nA=3\nmaterial.nu=0.4999\n", 27), 0);
    CU_ASSERT_STRING_EQUAL(scene->title, "A good title");
    CU_ASSERT_EQUAL(scene->n, 8); /* and what the file computed from n followed */
    CU_ASSERT_EQUAL(scene->level_count, 2);
    CU_ASSERT_EQUAL(scene->levels[1], 16);
    CU_ASSERT_EQUAL(scene->view.range[1], 8);
    CU_ASSERT_EQUAL(scene->view.bands, 2);
    CU_ASSERT_EQUAL(scene->view.size[1], 480);
    CU_ASSERT_DOUBLE_EQUAL(scene->cfl, 0.5, 1e-15);
    CU_ASSERT_EQUAL(scene->nu, 0.4999);
    CU_ASSERT_EQUAL(scene->evolved, SOLVER_PF);
    CU_ASSERT_EQUAL(scene->perturb, 0.15);
    CU_ASSERT_EQUAL(scene->face[0], SOLVER_CLAMPED);
    CU_ASSERT_EQUAL(scene->oracle_told_count, 3);
    CU_ASSERT_STRING_EQUAL(scene->oracle_told[0].name, "A");
    CU_ASSERT_STRING_EQUAL(scene->oracle_told[1].name, "material.nu");
    CU_ASSERT_EQUAL(scene->oracle_told[1].value, 0.31);
    CU_ASSERT_STRING_EQUAL(scene->oracle_told[2].name, "material.rho");

    CU_ASSERT_TRUE(solver_scene_number(scene, "A", &number) && number == 3);
    CU_ASSERT_TRUE(solver_scene_number(scene, "B", &number) && number == 2);
    CU_ASSERT_TRUE(solver_scene_number(scene, "n", &number) && number == 8);
    CU_ASSERT_TRUE(solver_scene_number(scene, "material.nu", &number) && number == 0.4999);
    CU_ASSERT_TRUE(solver_scene_number(scene, "seed", &number) && number == 7);
    CU_ASSERT_FALSE(solver_scene_number(scene, "D", &number));
    CU_ASSERT_FALSE(solver_scene_number(scene, "stencil", &number));
    CU_ASSERT_TRUE(solver_scene_text(scene, "stencil", text, sizeof text) && !strcmp(text, "closed"));
    CU_ASSERT_TRUE(solver_scene_text(scene, "evolved", text, sizeof text) && !strcmp(text, "pF"));
    CU_ASSERT_TRUE(solver_scene_text(scene, "perturb", text, sizeof text) && !strcmp(text, "0.15"));
    CU_ASSERT_TRUE(solver_scene_text(scene, "n", text, sizeof text) && !strcmp(text, "8"));
    CU_ASSERT_TRUE(solver_scene_text(scene, "oracle", text, sizeof text) && !strcmp(text, "c"));
    CU_ASSERT_FALSE(solver_scene_text(scene, "stencil", text, 4));
    CU_ASSERT_FALSE(solver_scene_text(scene, "levels", text, sizeof text));
    solver_scene_free(scene);
}

/* The order of a scene's tables does not leak into what is read: two loads agree. */
static void gates_and_published(void)
{
    write_changed(NULL, "published = { source = 's', { n = 4, p = 1, P = 2 }, { n = 8, p = 3 } }\n"
                        "gates = { { when = { cfl = 0.3, stencil = 'sbp2', ['material.nu'] = 0.3 }, p = 1,"
                        "            ['rate p'] = 2 }, { p = 9 } }");
    for (int round = 0; round < 8; round++) {
        struct solver_scene *scene = load_good(NULL);
        CU_ASSERT_EQUAL(scene->published_count, 2);
        CU_ASSERT_EQUAL(scene->published[0].count, 2);
        CU_ASSERT_STRING_EQUAL(scene->published[0].value[0].name, "P");
        CU_ASSERT_EQUAL(scene->published[0].value[0].value, 2);
        CU_ASSERT_EQUAL(scene->published[1].n, 8);
        CU_ASSERT_EQUAL(scene->gate_count, 2);
        CU_ASSERT_EQUAL(scene->gate[0].conditions, 3);
        CU_ASSERT_STRING_EQUAL(scene->gate[0].key[0], "cfl");
        CU_ASSERT_STRING_EQUAL(scene->gate[0].text[0], "0.3");
        CU_ASSERT_STRING_EQUAL(scene->gate[0].key[1], "material.nu");
        CU_ASSERT_STRING_EQUAL(scene->gate[0].text[2], "sbp2");
        CU_ASSERT_EQUAL(scene->gate[0].bounds, 2);
        CU_ASSERT_STRING_EQUAL(scene->gate[0].bound[1].name, "rate p");
        CU_ASSERT_EQUAL(scene->gate[1].conditions, 0);
        solver_scene_free(scene);
    }
}

/* The scene that users copy: what it says, and that its F is the gradient of its displacement. */
static void swinging_cube_scene(void)
{
    struct solver_scene *scene;
    struct solver_error error = {0};
    const char *set[] = {"A=2", "B=-1.5"};
    CU_ASSERT_TRUE_FATAL(solver_scene_load(swinging_cube, set, 2, &scene, &error));
    CU_ASSERT_STRING_EQUAL(scene->name, "swinging-cube");
    CU_ASSERT_EQUAL(scene->E, 17e6);
    CU_ASSERT_EQUAL(scene->level_count, 3);
    CU_ASSERT_EQUAL(scene->face[0], SOLVER_SYMMETRIC);
    CU_ASSERT_EQUAL(scene->face[5], SOLVER_SKEW);
    CU_ASSERT_EQUAL(scene->published[3].n, 24);
    CU_ASSERT_STRING_EQUAL(scene->oracle, "swinging-cube");
    const double X[3] = {0.3, 0.8, 0.55}, step = 1e-4;
    double F[9], plus[3], minus[3];
    CU_ASSERT_TRUE(solver_scene_eval(scene, SOLVER_INITIAL_F, X, 0, F, 9, &error));
    for (int j = 0; j < 3; j++) {
        double up[3] = {X[0], X[1], X[2]}, down[3] = {X[0], X[1], X[2]};
        up[j] += step;
        down[j] -= step;
        CU_ASSERT_TRUE(solver_scene_eval(scene, SOLVER_INITIAL_DISPLACEMENT, up, 0, plus, 3, &error));
        CU_ASSERT_TRUE(solver_scene_eval(scene, SOLVER_INITIAL_DISPLACEMENT, down, 0, minus, 3, &error));
        for (int i = 0; i < 3; i++)
            CU_ASSERT_DOUBLE_EQUAL(F[3 * i + j], (i == j) + (plus[i] - minus[i]) / (2 * step), 1e-10);
    }
    CU_ASSERT_TRUE(solver_scene_eval(scene, SOLVER_INITIAL_DISPLACEMENT, (double[3]){1, 0, 0}, 0, plus, 3, &error));
    CU_ASSERT_DOUBLE_EQUAL(plus[0], 2 * 5e-4, 1e-18);
    solver_scene_free(scene);
}

/* Every key has something to say, and every default passes its own check (the plain scene leaves all at default). */
static void table_of_keys(void)
{
    size_t count = 0;
    for (const struct solver_scene_key *key = solver_scene_keys(); key->key; key++, count++) {
        CU_ASSERT(strlen(key->key) > 0 && strlen(key->expects) > 0 && strlen(key->meaning) > 0);
        for (const struct solver_scene_key *other = solver_scene_keys(); other != key; other++)
            CU_ASSERT_STRING_NOT_EQUAL(other->key, key->key);
    }
    CU_ASSERT(count > 40);
}

/* What the table says that a key has unless it is given, a scene without it has. */
static void presets(void)
{
    size_t compared = 0;
    char has[SOLVER_TEXT];
    write_changed(NULL, "view = {}");
    struct solver_scene *scene = load_good(NULL);
    for (const struct solver_scene_key *key = solver_scene_keys(); key->key && scene; key++) {
        if (key->preset && key->preset[0] && solver_scene_text(scene, key->key, has, sizeof has)) {
            char *end;
            double number = strtod(key->preset, &end);
            CU_ASSERT(*end ? !strcmp(has, key->preset) : strtod(has, NULL) == number);
            compared++;
        }
    }
    CU_ASSERT(compared > 40);
    CU_ASSERT_STRING_EQUAL(scene->view.field, "pressure");
    CU_ASSERT(scene->view.range[0] == 0 && scene->view.range[1] == 0 && scene->view.bands == 0);
    solver_scene_free(scene);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"plain scene and defaults", plain_scene_and_defaults},
        {"swinging cube", swinging_cube_scene},
        {"default views", default_views},
        {"overrides", overrides},
        {"gates and published", gates_and_published},
        {"formula fails late", formula_fails_late},
        {"table of keys", table_of_keys},
        {"presets", presets},
    };
    return scene_files_main("scene", tests, sizeof tests / sizeof *tests);
}
