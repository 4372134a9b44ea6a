/* Initial states that are given in place of formulas. */
#include "tests/unit/runs.h"

/* A twist: u = 0.1 (Y, -X, 0) X, v = (X, 2 Y, 3 Z). */
static void twist(const void *context, const double X[3], double u[3], double v[3], double F[9])
{
    double size = *(const double *)context;
    const double gradient[9] = {X[1], X[0], 0, -2 * X[0], 0, 0, 0, 0, 0};
    for (int i = 0; i < 3; i++) {
        v[i] = size * (i + 1) * X[i];
        u[i] = size * X[0] * (i == 0 ? X[1] : i == 1 ? -X[0] : 0.0);
        for (int j = 0; j < 3; j++) {
            F[3 * i + j] = (i == j) + size * gradient[3 * i + j];
        }
    }
}

static void test_given(void)
{
    double size = 0.1;
    for (int dim = 2; dim <= 3; dim++) {
        struct sample sample = start("", "dim=%d n=4", dim);
        struct solver_run *run = NULL;
        solver_scene_start_from(sample.scene, twist, &size);
        CU_ASSERT_FATAL(solver_run_create(sample.scene, &run, &sample.error));
        struct solver_output output;
        CU_ASSERT_FATAL(solver_run_output(run, &output, &sample.error));
        for (size_t a = 0; a < output.cloud->count; a++) {
            double X[3] = {0}, u[3], v[3], F[9];
            memcpy(X, output.cloud->X + a * (size_t)dim, (size_t)dim * sizeof *X);
            twist(&size, X, u, v, F);
            for (int i = 0; i < dim; i++) {
                CU_ASSERT_DOUBLE_EQUAL(output.u[a * (size_t)dim + (size_t)i], u[i], 1e-15);
                CU_ASSERT_EQUAL(output.v[a * (size_t)dim + (size_t)i], v[i]);
                for (int j = 0; j < dim; j++) {
                    CU_ASSERT_EQUAL(output.F[(a * (size_t)dim + (size_t)i) * (size_t)dim + (size_t)j], F[3 * i + j]);
                }
            }
        }
        solver_run_free(run);
        solver_scene_start_from(sample.scene, NULL, NULL); /* and back: the scene's formulas, of which it has none */
        CU_ASSERT_FATAL(solver_run_create(sample.scene, &run, &sample.error));
        CU_ASSERT_FATAL(solver_run_output(run, &output, &sample.error));
        CU_ASSERT_EQUAL(output.v[(size_t)dim + 1], 0.0);
        solver_run_free(run);
        finish(&sample);
    }
}

static void test_none_given(void)
{
    struct solver_error error = refusal("initial = { from = 'oracle' }\n", "dim=2");
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "initial.from: the scene starts from its oracle, and none was given"));
}

/* Whatever a stencil's solution leaves of the gradient of X: a body at rest has no strain and no stress. */
static void test_at_rest(void)
{
    static const char *const stencils[] = {"closed perturb=0.3", "closed", "sbp4 n=8", "sph"};
    for (size_t s = 0; s < sizeof stencils / sizeof *stencils; s++) {
        for (int dim = 2; dim <= 3; dim++) {
            struct sample sample = start("", "dim=%d stencil=%s", dim, stencils[s]);
            struct solver_output output = output_of(&sample);
            size_t entries = (size_t)dim * (size_t)dim;
            for (size_t i = 0; i < output.cloud->count * entries; i++) {
                CU_ASSERT_EQUAL(output.F[i], i % entries % (size_t)(dim + 1) == 0 ? 1.0 : 0.0);
                CU_ASSERT_EQUAL(output.P[i], 0.0);
            }
            finish(&sample);
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a state that is given", test_given},
        {"none is given", test_none_given},
        {"a body at rest", test_at_rest},
    };
    return unit_main("run_start", tests, sizeof tests / sizeof *tests);
}
