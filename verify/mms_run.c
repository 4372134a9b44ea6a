/* One case of the suite of manufactured solutions, run and compared. */
#include "verify/find.h"
#include "verify/manufactured.h"
#include "verify/mms.h"
#include "verify/simulate.h"
#include "verify/study.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const verify_mms_variable_names[VERIFY_MMS_VARIABLES] = {"p", "x", "F", "H", "J", "P", "plastic"};

/* Names of the errors they are, and what they are where the scheme knows no deformation gradient. */
static const char *const errors[] = {"p", "u", "F", "H", "J", "P_all"};
static const char *const errors_without_F[] = {"p", "u", "F", "H", "J", "sigma_all"};

static bool open_scene(const struct verify_mms_case *which, int n, double cfl, const char *integrator,
                       struct solver_scene **scene, struct solver_error *error)
{
    char of_cfl[VERIFY_MMS_TEXT], of_integrator[VERIFY_MMS_TEXT];
    struct verify_options options = {.operand_count = 1, .operand = {which->path}};
    for (size_t i = 0; i < which->setting_count; i++) {
        options.override[options.override_count++] = which->setting[i];
    }
    options.override[options.override_count++] = "threads=1";
    if (cfl > 0) {
        (void)snprintf(of_cfl, sizeof of_cfl, "cfl=%.17g", cfl);
        options.override[options.override_count++] = of_cfl;
    }
    for (size_t i = 0; integrator != NULL && i < options.override_count; i++) {
        if (strncmp(options.override[i], "integrator=", 11) == 0) {
            (void)snprintf(of_integrator, sizeof of_integrator, "integrator=%s", integrator);
            options.override[i] = of_integrator;
        }
    }
    return verify_scene_open(&options, n, scene, error);
}

/* The scene run to its end. */
struct done {
    struct solver_scene *scene;
    struct solver_run *run;
    struct solver_output output;
    struct solver_facts facts;
};

static void free_done(struct done *done)
{
    solver_run_free(done->run);
    solver_scene_free(done->scene);
    *done = (struct done){.scene = NULL};
}

/* Stands between the run and what drives it. */
struct spoiler {
    const struct verify_spoiled_drive *spoiled;
    struct verify_driven right;
};

static void drive_wrongly(const void *context, enum solver_formula formula, const double X[3], double t,
                          double value[3])
{
    const struct spoiler *spoiler = context;
    spoiler->spoiled->spoil(&spoiler->right, formula, X, t, value);
}

/* To the end, with the fault in its place. */
static bool advance(struct done *done, const struct verify_spoiled_drive *spoiled, struct solver_error *error)
{
    struct solver_scene *scene = done->scene;
    if (spoiled == NULL) {
        return solver_run_to(done->run, scene->t_end, NULL, NULL, error);
    }
    struct spoiler spoiler = {spoiled, {scene, scene->drive, scene->drive_context, 0}};
    void *context = scene->drive_context;
    spoiler.right.step = scene->cfl * solver_run_facts(done->run).spacing;
    scene->drive = drive_wrongly;
    scene->drive_context = &spoiler;
    bool good = solver_run_to(done->run, scene->t_end, NULL, NULL, error);
    scene->drive = spoiler.right.drive;
    scene->drive_context = context;
    return good;
}

static bool run_once(const struct verify_mms_case *which, int n, double cfl, const char *integrator,
                     const struct verify_spoiled_drive *spoiled, struct done *done, struct solver_error *error)
{
    *done = (struct done){.scene = NULL};
    bool good = open_scene(which, n, cfl, integrator, &done->scene, error);
    good = good && verify_run_create(done->scene, &done->run, error);
    good = good && advance(done, spoiled, error) && solver_run_output(done->run, &done->output, error);
    if (good) {
        done->facts = solver_run_facts(done->run);
    }
    return good;
}

/* --- in space --- */

/* Relative L2 error of the plastic strain; NaN where nothing flows. */
static bool measure_flow(const struct done *done, const struct verify_truth *truth, double *of,
                         struct solver_error *error)
{
    const struct solver_output *output = &done->output;
    size_t count = output->cloud->count, dim = (size_t)output->cloud->dim;
    int extra = verify_plastic_strain_extra(truth->kind);
    *of = NAN;
    if (output->plastic_strain == NULL || extra < 0) {
        return true;
    }
    double *exact = calloc(count, sizeof *exact);
    if (exact == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the plastic strain of %zu particles", count);
    }
    for (size_t a = 0; a < count; a++) {
        double X[3] = {0}, value[ORACLE_EXTRAS] = {0};
        memcpy(X, output->cloud->X + a * dim, dim * sizeof *X);
        truth->kind->extras(truth->oracle, X, output->time, value);
        exact[a] = value[extra];
    }
    *of = verify_norms_field(count, 1, output->V, output->plastic_strain, exact).relative_l2;
    free(exact);
    return true;
}

static bool measure(const struct verify_mms_case *which, const struct verify_spoiled_drive *spoiled, int n,
                    double error_of[VERIFY_MMS_VARIABLES], double *h, struct solver_error *error)
{
    struct done done;
    struct verify_truth truth = {.kind = NULL};
    double all[VERIFY_STATE_ERRORS];
    bool good = run_once(which, n, 0, NULL, spoiled, &done, error) && verify_truth_create(done.scene, &truth, error) &&
                verify_norms_state(&done.output, truth.kind, truth.oracle, all, error);
    if (good && !truth.proven) {
        good = solver_fail(error, SOLVER_BROKE_DOWN, "the oracle %s does not pass its own check", truth.kind->name);
    }
    good = good && measure_flow(&done, &truth, &error_of[VERIFY_MMS_OF_PLASTIC_STRAIN], error);
    for (int i = 0; good && i < VERIFY_MMS_OF_PLASTIC_STRAIN; i++) {
        const char *name = done.output.P != NULL ? errors[i] : errors_without_F[i];
        error_of[i] = all[verify_error_find(name)];
        *h = done.facts.spacing;
    }
    verify_truth_free(&truth);
    free_done(&done);
    return good;
}

static bool run_in_space(const struct verify_mms_case *which, const struct verify_spoiled_drive *spoiled,
                         struct verify_mms_result *result)
{
    double coarse[VERIFY_MMS_VARIABLES], h[VERIFY_MMS_LEVELS];
    if (!measure(which, spoiled, which->level[0], coarse, &h[0], &result->error) ||
        !measure(which, spoiled, which->level[1], result->finest, &h[1], &result->error)) {
        return false;
    }
    for (int i = 0; i < VERIFY_MMS_VARIABLES; i++) {
        result->order[i] = verify_order(coarse[i], h[0], result->finest[i], h[1]);
    }
    return true;
}

/* --- in time: the same cloud with shorter and shorter steps, against the classical method of fourth order with steps
 * as short again by STEPS --- */

enum { IN_TIME_N = 16, STEPS = 4 };
static const double LARGEST_CFL = 0.4;

/* Relative L2 distance of a variable of two runs on one cloud. */
static double distance(const struct solver_output *a, const struct solver_output *b, enum verify_mms_variable variable)
{
    size_t dim = (size_t)a->cloud->dim;
    const double *of_a[] = {a->p, a->u, a->F, a->H, a->J, a->P, a->plastic_strain};
    const double *of_b[] = {b->p, b->u, b->F, b->H, b->J, b->P, b->plastic_strain};
    const size_t width[] = {dim, dim, dim * dim, dim * dim, 1, dim * dim, 1};
    if (of_a[variable] == NULL) {
        return NAN;
    }
    return verify_norms_field(a->cloud->count, width[variable], a->V, of_a[variable], of_b[variable]).relative_l2;
}

static bool run_in_time(const struct verify_mms_case *which, struct verify_mms_result *result)
{
    struct done reference, done;
    double coarse[VERIFY_MMS_VARIABLES], step[VERIFY_MMS_LEVELS] = {0};
    double finest_cfl = LARGEST_CFL / which->level[1];
    bool good = run_once(which, IN_TIME_N, finest_cfl / STEPS, "rk4", NULL, &reference, &result->error);
    for (int level = 0; good && level < VERIFY_MMS_LEVELS; level++) {
        good = run_once(which, IN_TIME_N, LARGEST_CFL / which->level[level], NULL, NULL, &done, &result->error);
        for (int i = 0; good && i < VERIFY_MMS_VARIABLES; i++) {
            double error = distance(&done.output, &reference.output, (enum verify_mms_variable)i);
            *(level == 0 ? &coarse[i] : &result->finest[i]) = error;
        }
        step[level] = good ? done.scene->t_end / (double)done.facts.steps : 0;
        free_done(&done);
    }
    for (int i = 0; good && i < VERIFY_MMS_VARIABLES; i++) {
        result->order[i] = verify_order(coarse[i], step[0], result->finest[i], step[1]);
    }
    free_done(&reference);
    return good;
}

bool verify_mms_claims(const struct verify_mms_case *which)
{
    bool any = false;
    for (int i = 0; i < VERIFY_MMS_VARIABLES; i++) {
        any = any || which->asked[i] > 0;
    }
    return any;
}

void verify_mms_run(const struct verify_mms_case *which, const struct verify_spoiled_drive *spoiled,
                    struct verify_mms_result *result)
{
    double begun = omp_get_wtime();
    *result = (struct verify_mms_result){.pass = true};
    for (int i = 0; i < VERIFY_MMS_VARIABLES; i++) {
        result->finest[i] = result->order[i] = NAN;
    }
    result->ran = which->in_time ? run_in_time(which, result) : run_in_space(which, spoiled, result);
    for (int i = 0; i < VERIFY_MMS_VARIABLES; i++) {
        double asked = which->asked[i];
        bool exact = isless(result->finest[i], VERIFY_MMS_ROUND_OFF); /* has no order; what is no number is not exact */
        result->asked[i] = asked > 0 && !exact;
        if (result->asked[i] && !isgreaterequal(result->order[i], asked)) {
            result->pass = false;
        }
    }
    result->seconds = omp_get_wtime() - begun;
}
