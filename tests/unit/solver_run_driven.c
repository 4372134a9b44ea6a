/* Bodies that are driven by a function in place of formulas, and faces that slide on rollers. */
#include "solver/integrator.h"
#include "tests/unit/runs.h"

/* All that drives: constants by formula, counted. */
struct drive {
    double force[3], velocity[3], traction[3];
    int released;
};

static void answer(const void *context, enum solver_formula formula, const double X[3], double t, double value[3])
{
    const struct drive *drive = context;
    const double *of = formula == SOLVER_BODY_FORCE ? drive->force
                       : formula > SOLVER_FACE_Z1   ? drive->traction
                                                    : drive->velocity;
    for (int i = 0; i < 3; i++) {
        value[i] = of[i] * (1 + 0.1 * X[i]) * (1 + t);
    }
}

static void release(void *context)
{
    ((struct drive *)context)->released++;
}

static void run_to_end(struct sample *sample)
{
    solver_run_free(sample->run); /* from the start again, with what drives it now */
    CU_ASSERT_FATAL(solver_run_create(sample->scene, &sample->run, &sample->error));
    CU_ASSERT_FATAL(solver_run_to(sample->run, sample->scene->t_end, NULL, NULL, &sample->error));
}

/* The same drive by formula. */
static const char by_formula[] =
    "body_force = function(X, Y, Z, t) return first(0.3 * (1 + 0.1 * X) * (1 + t), -0.2 * (1 + 0.1 * Y) * (1 + t), "
    "0.1 * (1 + 0.1 * Z) * (1 + t)) end\n";

static void a_drive_is_as_its_formula(void)
{
    struct drive drive = {.force = {0.3, -0.2, 0.1}};
    for (int dim = 1; dim <= 3; dim++) {
        struct sample with_formula = start(by_formula, "dim=%d n=4 integrator=rk4", dim);
        run_to_end(&with_formula);
        struct solver_output expected, output;
        CU_ASSERT_FATAL(solver_run_output(with_formula.run, &expected, &with_formula.error));
        for (int threads = 1; threads <= 2; threads++) {
            struct sample sample = start("", "dim=%d n=4 integrator=rk4 threads=%d", dim, threads);
            drive.released = 0;
            solver_scene_drive_from(sample.scene, answer, &drive, release);
            run_to_end(&sample);
            CU_ASSERT_FATAL(solver_run_output(sample.run, &output, &sample.error));
            size_t bytes = output.cloud->count * (size_t)dim * sizeof(double);
            CU_ASSERT_EQUAL(memcmp(output.u, expected.u, bytes), 0);
            CU_ASSERT_EQUAL(memcmp(output.v, expected.v, bytes), 0);
            solver_run_free(sample.run);
            sample.run = NULL;
            CU_ASSERT_EQUAL(drive.released, 0);
            finish(&sample);
            CU_ASSERT_EQUAL(drive.released, 1);
        }
        solver_run_free(with_formula.run);
        with_formula.run = NULL;
        finish(&with_formula);
    }
}

static void nobody_drives(void)
{
    struct solver_error error = refusal("loads = { from = 'oracle' }\n", "dim=2");
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "loads.from: the scene is driven by its oracle, and none was given"));
}

/* A block on rollers all along X: the normal velocity is theirs, across nothing holds it, so that it slides as its own
 * velocity says; a traction across accelerates it as a whole. */
static void rollers_hold_the_normal_alone(void)
{
    struct sample sample = start("initial = { velocity = function() return 0.25, 0.5 end }\n"
                                 "local roller = { kind = 'roller', value = function() return 0.25, 7 end }\n"
                                 "local pulled = { kind = 'roller', value = function() return 0.25, 7 end,\n"
                                 "                 traction = function() return 100, 0.5 end }\n"
                                 "faces = { X0 = roller, X1 = pulled }\n",
                                 "dim=2 n=4 t_end=0.5 integrator=rk4");
    run_to_end(&sample);
    struct solver_output output;
    CU_ASSERT_FATAL(solver_run_output(sample.run, &output, &sample.error));
    struct solver_facts facts = solver_run_facts(sample.run);
    double momentum = 0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        double X = output.cloud->X[2 * a];
        if (X == 0.0 || X == 1.0) {
            CU_ASSERT_DOUBLE_EQUAL(output.v[2 * a], 0.25, 1e-15);
            CU_ASSERT_DOUBLE_EQUAL(output.u[2 * a], 0.125, 1e-14);
        }
        momentum += output.V[a] * output.p[2 * a + 1];
    }
    /* at the start 0.5 m/s; 0.5 Pa on an edge of 1 m over 0.5 s */
    CU_ASSERT_DOUBLE_EQUAL(momentum, facts.mass * 0.5 + 0.5 * 0.5, 1e-13);
    solver_run_free(sample.run);
    sample.run = NULL;
    finish(&sample);
}

/* Where rollers meet, each leads its own normal; where one meets a clamped face, that holds; after free_after it is let
 * go. */
static void rollers_meet(void)
{
    struct sample sample =
        start("local function roller(vx, vy, t) return { kind = 'roller', value = function() return vx, vy end,\n"
              "    free_after = t } end\n"
              "faces = { X0 = roller(0.1, 9), Y0 = roller(9, 0.2), X1 = 'clamped', Y1 = roller(9, -0.1, 0.01) }\n",
              "dim=2 n=4 t_end=0.1 integrator=rk4");
    run_to_end(&sample);
    struct solver_output output;
    CU_ASSERT_FATAL(solver_run_output(sample.run, &output, &sample.error));
    for (size_t a = 0; a < output.cloud->count; a++) {
        double X = output.cloud->X[2 * a], Y = output.cloud->X[2 * a + 1];
        const double *v = output.v + 2 * a;
        if (X == 1.0) {
            CU_ASSERT(v[0] == 0.0 && v[1] == 0.0);
        } else if (X == 0.0 && Y == 0.0) {
            CU_ASSERT(v[0] == 0.1 && v[1] == 0.2);
        } else if (Y == 1.0) {
            CU_ASSERT(v[1] != -0.1);
        }
    }
    solver_run_free(sample.run);
    sample.run = NULL;
    finish(&sample);
}

/* A face that is led until some time has gone as far by then as it was told, whatever steps there are. */
static void led_to_the_last(void)
{
    for (const struct solver_integrator *with = solver_integrators(); with->name != NULL; with++) {
        struct sample sample = start("faces = { X1 = { kind = 'motion', value = function() return 0.1, 0.2 end,\n"
                                     "    free_after = 0.3 } }\n",
                                     "dim=2 n=4 t_end=0.3 integrator=%s", with->name);
        run_to_end(&sample);
        struct solver_output output = output_of(&sample);
        for (size_t a = 0; a < output.cloud->count; a++) {
            if (output.cloud->X[2 * a] == 1.0) {
                CU_ASSERT_DOUBLE_EQUAL(output.u[2 * a], 0.03, 1e-14);
                CU_ASSERT_DOUBLE_EQUAL(output.u[2 * a + 1], 0.06, 1e-14);
            }
        }
        finish(&sample);
    }
}

/* A face moved in part: the rest of it is free, the ends of the part are not. */
static void moved_in_part(void)
{
    for (int roller = 0; roller < 2; roller++) {
        struct sample sample =
            start("parameters = { roller = 0 }\n"
                  "faces = { Y1 = { kind = roller == 1 and 'roller' or 'motion',\n"
                  "    value = function() return 0.3, -0.1 end, within = { {0.25, 0}, {0.5, 2} } },\n"
                  "    Y0 = 'symmetric' }\n",
                  "dim=2 n=4 t_end=0.2 roller=%d", roller);
        run_to_end(&sample);
        struct solver_output output = output_of(&sample);
        size_t led = 0;
        for (size_t a = 0; a < output.cloud->count; a++) {
            double X = output.cloud->X[2 * a], Y = output.cloud->X[2 * a + 1];
            bool moves = Y == 1.0 && (X == 0.25 || X == 0.5);
            CU_ASSERT_EQUAL(output.v[2 * a + 1] == -0.1, moves);
            CU_ASSERT_EQUAL(output.v[2 * a] == 0.3, moves && roller == 0);
            led += moves;
        }
        CU_ASSERT_EQUAL(led, 2);
        finish(&sample);
    }
}

/* Where moved faces meet and say different things: one that moves all axes leads rollers, the first of two leads the
 * other, and each is let go when the one that leads is. */
static void the_first_of_moved_faces_leads(void)
{
    struct sample sample = start(
        "local function moved(kind, vx, vy, t) return { kind = kind, value = function() return vx, vy end,\n"
        "    free_after = t } end\n"
        "faces = { X0 = moved('roller', 0.1, 9), Y0 = moved('motion', 0.3, 0.4), X1 = moved('motion', 0.5, 0.6),\n"
        "    Y1 = moved('motion', 0.7, 0.8, 0.01) }\n",
        "dim=2 n=4 t_end=0.05 integrator=rk4");
    run_to_end(&sample);
    struct solver_output output;
    CU_ASSERT_FATAL(solver_run_output(sample.run, &output, &sample.error));
    size_t corners = 0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        double X = output.cloud->X[2 * a], Y = output.cloud->X[2 * a + 1];
        const double *v = output.v + 2 * a;
        if (X == 0.0 && Y == 0.0) { /* the roller comes first by its number, and still does not lead */
            CU_ASSERT(v[0] == 0.3 && v[1] == 0.4);
            corners++;
        } else if (X == 1.0 && (Y == 0.0 || Y == 1.0)) { /* X1 before Y0 and Y1, and for as long as X1 lasts */
            CU_ASSERT(v[0] == 0.5 && v[1] == 0.6);
            corners++;
        }
    }
    CU_ASSERT_EQUAL(corners, 3);
    solver_run_free(sample.run);
    sample.run = NULL;
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a drive is as its formula, for any number of threads", a_drive_is_as_its_formula},
        {"nobody drives", nobody_drives},
        {"rollers hold the normal alone", rollers_hold_the_normal_alone},
        {"rollers meet others", rollers_meet},
        {"the first of moved faces leads", the_first_of_moved_faces_leads},
        {"led to the last", led_to_the_last},
        {"a face moved in part", moved_in_part},
    };
    return unit_main("driven runs", tests, sizeof tests / sizeof *tests);
}
