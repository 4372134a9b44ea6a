/* Runs of several bodies: each moves as if the others were not there, until a contact law says otherwise. */
#include "solver/record.h"
#include "tests/unit/runs.h"
#include "tests/unit/scratch.h"

/* A box and a ring that touch and drive at one another. */
static const char scene[] = "title, dim, n, t_end = 'bodies', 2, 5, 1\n"
                            "lattice, reference_length = 'centres', 0.5\n"
                            "bodies = { { shape = 'box', lower = {-1, 0}, upper = {0, 0.5} },\n"
                            "           { shape = 'ring', centre = {1, 0.25}, inner = 0.5, outer = 1 } }\n"
                            "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                            "scheme, support, integrator, cfl = 'ulsph', 2.4, 'tvd-rk2', 0.5\n"
                            "stencil, contact = 'sph', { law = 'none' }\n"
                            "initial = { velocity = function(X) return X < 0 and 0.1 or -0.1, 0 end }\n";

static struct sample begin(const char *const *overrides, size_t count)
{
    struct sample sample = {.run = NULL};
    char path[SCRATCH];
    scratch_text(path, "%s", scene);
    bool loaded = solver_scene_load(path, overrides, count, &sample.scene, &sample.error);
    unlink(path);
    if (!loaded || !solver_run_create(sample.scene, &sample.run, &sample.error)) {
        printf("\n    %s", sample.error.text);
        CU_FAIL_FATAL("the run does not start");
    }
    return sample;
}

/* Without a law bodies pass through one another, each without strain: no pair of neighbours joins them. */
static void strangers(void)
{
    static const char *const schemes[] = {"scheme=ulsph", "scheme=upwind"};
    for (int s = 0; s < 2; s++) {
        struct sample sample = begin(&schemes[s], 1);
        advance_to(&sample, 1.0);
        struct solver_output output = output_of(&sample);
        double strayed = 0.0, stress = 0.0;
        CU_ASSERT_PTR_NOT_NULL_FATAL(output.cloud->body);
        for (size_t a = 0; a < output.cloud->count; a++) {
            double way = output.cloud->body[a] == 0 ? 0.1 : -0.1;
            strayed = fmax(strayed, hypot(output.u[2 * a] - way, output.u[2 * a + 1]));
            stress = fmax(stress, output.von_mises[a] / 3.0);
        }
        expect_below("way of bodies that drift", strayed, 1e-13);
        expect_below("their stress / E", stress, 1e-12);
        finish(&sample);
    }
}

/* The record says which body a particle is of. */
static void recorded(void)
{
    struct sample sample = begin(NULL, 0);
    struct solver_output output = output_of(&sample);
    struct solver_record *record = NULL;
    CU_ASSERT_FATAL(solver_record_make(sample.scene, &output, NULL, "", "", &record, &sample.error));
    const struct solver_record_field *body = solver_record_find(record, "body");
    CU_ASSERT_PTR_NOT_NULL_FATAL(body);
    size_t wrong = 0;
    for (size_t a = 0; a < record->count; a++) {
        wrong += body->value[a] != (record->X[3 * a] < 0.0 ? 0.0 : 1.0);
    }
    CU_ASSERT_EQUAL(wrong, 0);
    solver_record_free(record);
    finish(&sample);
}

/* Bodies that meet keep their momentum, and are the same bytes for any number of threads. */
static void meeting(void)
{
    /* without the control of tension, whose forces between a particle inside and one at the surface differ (eq. 51) */
    static const char *const overrides[2][3] = {{"contact.law=predicted", "ulsph.tension=none", "threads=1"},
                                                {"contact.law=predicted", "ulsph.tension=none", "threads=3"}};
    struct sample sample = begin(overrides[0], 3), again = begin(overrides[1], 3);
    advance(&sample, 200);
    advance(&again, 200);
    struct solver_output output = output_of(&sample), other = output_of(&again);
    size_t numbers = output.cloud->count * 2;
    CU_ASSERT_EQUAL_FATAL(other.cloud->count, output.cloud->count);
    CU_ASSERT_EQUAL(memcmp(output.u, other.u, numbers * sizeof *output.u), 0);
    CU_ASSERT_EQUAL(memcmp(output.sigma, other.sigma, 2 * numbers * sizeof *output.sigma), 0);
    double momentum[2] = {0}, size = 0.0, stress = 0.0;
    for (size_t a = 0; a < output.cloud->count; a++) {
        for (size_t i = 0; i < 2; i++) {
            double start = i == 0 ? 2.0 * (output.cloud->body[a] == 0 ? 0.1 : -0.1) : 0.0;
            momentum[i] += output.V[a] * (output.p[2 * a + i] - start);
            size += output.V[a] * fabs(output.p[2 * a + i]);
        }
        stress = fmax(stress, output.von_mises[a]);
    }
    expect_below("momentum gained", hypot(momentum[0], momentum[1]) / size, 1e-13);
    CU_ASSERT(stress > 1e-3); /* they did meet */
    finish(&sample);
    finish(&again);
}

/* A body's velocity is that of its centre of mass: of two halves of which one is three times as dense, and moves. */
static void centre_of_mass(void)
{
    static const char composite[] = "title, dim, n, t_end = 'halves', 1, 4, 1\n"
                                    "lattice, domain = 'centres', { lower = {-1}, upper = {1} }\n"
                                    "material = { model = 'linear-elastic', E = 1, nu = 0, rho = 1,\n"
                                    "    at = function(X) return 1, 0, X < 0 and 3 or 1 end }\n"
                                    "scheme, support, integrator, cfl, stencil = 'ulsph', 2.4, 'tvd-rk2', 0.5, 'sph'\n"
                                    "initial = { velocity = function(X) return X < 0 and 1 or 0 end }\n";
    struct sample sample = {.run = NULL};
    char path[SCRATCH];
    scratch_text(path, "%s", composite);
    bool ready = solver_scene_load(path, NULL, 0, &sample.scene, &sample.error) &&
                 solver_run_create(sample.scene, &sample.run, &sample.error);
    unlink(path);
    if (!ready) {
        printf("\n    %s", sample.error.text);
    }
    CU_ASSERT_FATAL(ready);
    advance_to(&sample, 1e-3);
    CU_ASSERT_DOUBLE_EQUAL(solver_run_history(sample.run)->body_velocity[0][0], 0.75, 1e-12);
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"strangers", strangers},
        {"recorded", recorded},
        {"bodies that meet", meeting},
        {"centre of mass", centre_of_mass},
    };
    return unit_main("solver run of bodies", tests, sizeof tests / sizeof *tests);
}
