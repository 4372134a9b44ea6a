#include "verify/extremes.h"

#include "verify/find.h"
#include "verify/norms.h"
#include "verify/signals.h"
#include "verify/simulate.h"
#include "verify/truth.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define BLOCK "free-block"

static const struct verify_extreme table[] = {
    {"cfl", "largest stable CFL number, beside that of the eigenvalues of the same stencil", verify_extreme_cfl, BLOCK,
     "d n scheme stencil integrator evolved cfl", NULL},
    {"scale", "bodies of 1e-9 and 1e6 m, of 1 and 1e12 Pa: the same numbers without dimension", verify_extreme_scale,
     BLOCK, "d n evolved length modulus density", NULL},
    {"place", "bodies a million lengths away, and turned: the same motion", verify_extreme_place, BLOCK,
     "d n evolved origin angle", NULL},
    {"alternating", "velocities that alternate from particle to particle: at what rate each scheme damps them",
     verify_extreme_alternating, BLOCK, "d n alternate stretch", NULL},
    {"spin", "a body that turns a thousand times", verify_extreme_spin, BLOCK, "d n turn periods", NULL},
    {"vibration", "a million steps of a free vibration", verify_extreme_vibration, BLOCK, "d n", NULL},
    {"poisson", "Poisson's ratio towards 0.5 and -1", verify_extreme_poisson, BLOCK, "d material.nu", NULL},
    {"stretch", "held bodies stretched and compressed along one axis", verify_extreme_stretch, BLOCK,
     "d n held stretch",
     "the velocities it watches are 1e-6 of the wave speed, and what is rounded of a held stress, 1.2e-7 times the "
     "stretch, moves particles as fast"},
    {"perturbed", "clouds whose particles are moved at random, by a share of the spacing", verify_extreme_perturbed,
     BLOCK, "d n perturb", NULL},
    {"impact", "bodies that hit a rigid wall", verify_extreme_impact, BLOCK, "d n impact", NULL},
    {"contrast", "density and stiffness that jump a million times within a bar", verify_extreme_contrast,
     "bimaterial-wave", "n E2 rho2", NULL},
    {"slanted", "the same across a plane that is slanted against the lattice: a free body gains no energy",
     verify_extreme_slanted, BLOCK, "d n jump random speed t_end", NULL},
    {"graded", "spacings within one body whose largest is many times the smallest", verify_extreme_graded,
     "manufactured", "n levels grading.X grading.Y scheme stencil evolved", NULL},
    {"small", "the smallest clouds and the thinnest bodies: a right answer or a refusal", verify_extreme_small, BLOCK,
     "d n levels thickness flight", NULL},
    {.name = NULL},
};

const struct verify_extreme *verify_extremes_table(void)
{
    return table;
}

const struct verify_extreme *verify_extreme_find(const char *name)
{
    for (const struct verify_extreme *extreme = table; extreme->name != NULL; extreme++) {
        if (strcmp(extreme->name, name) == 0) {
            return extreme;
        }
    }
    return NULL;
}

/* Whether one of the words of a list, with blanks between, is the key that an override sets. */
static bool lists(const char *list, const char *override)
{
    size_t length = strcspn(override, "=");
    for (const char *word = list; *word != '\0'; word += strspn(word, " ")) {
        size_t whole = strcspn(word, " ");
        if (whole == length && strncmp(word, override, length) == 0) {
            return true;
        }
        word += whole;
    }
    return false;
}

bool verify_extreme_check(const struct verify_extreme *extreme, const struct verify_options *options,
                          struct solver_error *error)
{
    char path[VERIFY_PATH];
    struct solver_scene *scene = NULL;
    for (size_t i = 0; i < options->override_count; i++) {
        if (lists(extreme->drives, options->override[i])) {
            return solver_fail(error, SOLVER_BAD_INPUT,
                               "--set %.200s: assay extremes %s sets this key itself; leave it out, or name an extreme "
                               "that does not",
                               options->override[i], extreme->name);
        }
    }
    bool taken = verify_scene_find(extreme->scene, path, error) &&
                 solver_scene_load(path, options->override, options->override_count, &scene, error);
    if (taken && extreme->in_double != NULL && strcmp(scene->precision, "single") == 0) {
        taken = solver_fail(error, SOLVER_BAD_INPUT,
                            "--set precision=single: assay extremes %s: %s; expected double or "
                            "mixed",
                            extreme->name, extreme->in_double);
    }
    solver_scene_free(scene);
    return taken;
}

bool verify_extreme_holds(const struct verify_extreme_row *row)
{
    /* no number is neither; one beyond all numbers was not measured */
    return isfinite(row->value) && row->value >= row->least && row->value <= row->most;
}

bool verify_extreme_asked(const struct verify_extremes *in, const char *what)
{
    return in->rows == NULL || strstr(what, in->rows) != NULL;
}

/* A row that is told after the program was asked to end was cut short somewhere, and is none. */
void verify_extreme_told(const struct verify_extremes *in, const struct verify_extreme_row *row)
{
    if (verify_signals_asked() == 0) {
        in->take(in->context, in->extreme, row);
    }
}

/* False once the program was asked to end. */
static bool goes_on(struct solver_error *error)
{
    int number = verify_signals_asked();
    return number == 0 || solver_fail(error, SOLVER_STOPPED, "stopped by %s", verify_signals_name(number));
}

bool verify_trial_open(const struct verify_extremes *in, const char *scene, struct verify_trial *trial,
                       struct solver_error *error, const char *format, ...)
{
    char path[VERIFY_PATH], settings[1024];
    const char *override[VERIFY_OVERRIDES];
    size_t count = 0;
    va_list arguments;
    *trial = (struct verify_trial){NULL, NULL};
    if (!goes_on(error)) {
        return false;
    }
    va_start(arguments, format);
    int length = vsnprintf(settings, sizeof settings, format, arguments);
    va_end(arguments);
    char *rest = settings;
    for (char *word = strtok_r(settings, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        if (count + in->options->override_count >= VERIFY_OVERRIDES) {
            break;
        }
        override[count++] = word;
    }
    if (length < 0 || (size_t)length >= sizeof settings || count + in->options->override_count >= VERIFY_OVERRIDES) {
        return solver_fail(error, SOLVER_BAD_INPUT, "too many overrides for the scene %s", scene);
    }
    memcpy(override + count, in->options->override, in->options->override_count * sizeof *override);
    count += in->options->override_count;
    bool ok = verify_scene_find(scene, path, error) && solver_scene_load(path, override, count, &trial->scene, error) &&
              verify_run_create(trial->scene, &trial->run, error);
    if (!ok) {
        verify_trial_close(trial);
    }
    return ok;
}

void verify_trial_close(struct verify_trial *trial)
{
    solver_run_free(trial->run);
    solver_scene_free(trial->scene);
    *trial = (struct verify_trial){NULL, NULL};
}

/* A solver_progress. */
static bool watch(void *context, double time, double t_end, size_t step)
{
    (void)context;
    (void)time;
    (void)t_end;
    (void)step;
    return verify_signals_asked() == 0;
}

bool verify_trial_finish(struct verify_trial *trial, struct solver_error *error)
{
    return solver_run_to(trial->run, trial->scene->t_end, watch, NULL, error) && goes_on(error);
}

bool verify_trial_judge(struct verify_trial *trial, const char *name, double *found, struct solver_error *error)
{
    struct verify_truth truth = {.kind = NULL};
    struct solver_output out;
    double all[VERIFY_STATE_ERRORS];
    bool judged = verify_trial_finish(trial, error) && solver_run_output(trial->run, &out, error) &&
                  verify_truth_create(trial->scene, &truth, error) &&
                  verify_norms_state(&out, truth.kind, truth.oracle, all, error);
    *found = judged ? all[verify_error_find(name)] : NAN;
    verify_truth_free(&truth);
    return judged;
}

bool verify_trial_steps(struct verify_trial *trial, size_t steps, struct solver_error *error)
{
    enum { PIECE = 1000 }; /* milliseconds */
    bool done = true;
    for (size_t made = 0; done && made < steps; made += PIECE) {
        done = goes_on(error) && solver_run_steps(trial->run, made + PIECE < steps ? PIECE : steps - made, error);
    }
    return done && goes_on(error);
}

double verify_trial_speed(struct verify_trial *trial, double *largest)
{
    struct solver_output out;
    struct solver_error error;
    double sum = 0.0, volume = 0.0, most = 0.0;
    if (!solver_run_output(trial->run, &out, &error)) {
        return NAN;
    }
    size_t dim = (size_t)out.cloud->dim;
    for (size_t a = 0; a < out.cloud->count; a++) {
        double square = 0.0;
        for (size_t i = 0; i < dim; i++) {
            square += out.v[a * dim + i] * out.v[a * dim + i];
        }
        sum += out.V[a] * square;
        volume += out.V[a];
        most = fmax(most, square);
    }
    if (largest != NULL) {
        *largest = sqrt(most);
    }
    return sqrt(sum / volume);
}

void verify_extreme_bisect(verify_extreme_try *holds_at, void *with, double near, double far, double width,
                           double *holds, double *fails, char *note, size_t size)
{
    *holds = near;
    *fails = far;
    if (!holds_at(with, near, note, size)) {
        *holds = NAN;
        *fails = near;
        return;
    }
    if (holds_at(with, far, note, size)) {
        *holds = far;
        *fails = NAN;
        return;
    }
    while (fmax(*fails / *holds, *holds / *fails) > 1.0 + width) {
        double middle = sqrt(*holds * *fails);
        *(holds_at(with, middle, note, size) ? holds : fails) = middle;
    }
}
