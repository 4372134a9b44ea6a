/* What the tests of runs share: a block of any dimension, written to a scene file with what a test adds to it. */
#ifndef TESTS_RUNS_H
#define TESTS_RUNS_H

#include "solver/material.h"
#include "solver/run.h"
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* dim is the first key, so that an override of it shapes the rest; first(a, b, c) cuts to dim numbers. */
static const char block[] =
    "title = 'block'\n"
    "dim = 3\n"
    "local d = dim\n"
    "local function each(v) local c = {} for i = 1, d do c[i] = v end return c end\n"
    "local function first(a, b, c) if d == 1 then return a elseif d == 2 then return a, b end return a, b, c end\n"
    "local sin, cos = math.sin, math.cos\n"
    "n = 4\n"
    "t_end = 1\n"
    "stencil, integrator, cfl, evolved = 'sbp2', 'tvd-rk2', 0.3, 'pFHJ'\n"
    "threads = 1\n";

/* Unless what a test adds has one of its own. */
static const char plain_domain[] = "domain = { lower = each(0), upper = each(1) }\n";
static const char plain_material[] = "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2 }\n";

/* A free body that deforms smoothly and drifts. */
static const char smooth_motion[] = "initial = { velocity = function(X, Y, Z)\n"
                                    "    return first(0.03 + 0.05 * sin(2 * X + Y + 0.3), 0.02 + 0.04 * cos(3 * Y - X "
                                    "+ Z), 0.05 * sin(2 * Z + X + 0.2))\n"
                                    "end }\n";

struct sample {
    struct solver_scene *scene;
    struct solver_run *run;
    struct solver_error error;
};

/* The block with `more` appended and overrides KEY=VALUE, separated by blanks; scene is NULL if it is refused. */
static inline struct sample try_scene(const char *more, const char *format, va_list arguments)
{
    struct sample sample = {.run = NULL};
    char path[SCRATCH];
    char words[512];
    const char *overrides[32];
    size_t count = 0;
    int length = vsnprintf(words, sizeof words, format, arguments);
    CU_ASSERT_FATAL(length >= 0 && (size_t)length < sizeof words);
    char *rest = words;
    for (char *word = strtok_r(rest, " ", &rest); word != NULL && count < 32; word = strtok_r(rest, " ", &rest)) {
        overrides[count++] = word;
    }
    scratch_text(path, "%s%s%s%s", block, strstr(more, "domain = ") ? "" : plain_domain,
                 strstr(more, "material = ") ? "" : plain_material, more);
    (void)solver_scene_load(path, overrides, count, &sample.scene, &sample.error);
    unlink(path);
    return sample;
}

/* The scene alone. */
static inline struct sample load_scene(const char *more, const char *format, va_list arguments)
{
    struct sample sample = try_scene(more, format, arguments);
    if (sample.scene == NULL) {
        printf("\n    %s: %s", format, sample.error.text);
        CU_FAIL_FATAL("the scene is refused");
    }
    return sample;
}

/* A scene that must not load, and why not. */
static inline void expect_refused(const char *more, const char *expected, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static inline void expect_refused(const char *more, const char *expected, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    struct sample sample = try_scene(more, format, arguments);
    va_end(arguments);
    bool says_so = sample.scene == NULL && strstr(sample.error.text, expected) != NULL;
    if (!says_so) {
        printf("\n    expected \"%s\", got \"%s\"", expected, sample.scene == NULL ? sample.error.text : "a scene");
    }
    CU_ASSERT(says_so);
    solver_scene_free(sample.scene);
}

/* On failure run is NULL. */
static inline struct sample try_start(const char *more, const char *format, va_list arguments)
{
    struct sample sample = load_scene(more, format, arguments);
    (void)solver_run_create(sample.scene, &sample.run, &sample.error);
    return sample;
}

static inline struct sample start(const char *more, const char *format, ...) __attribute__((format(printf, 2, 3)));
static inline struct sample start(const char *more, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    struct sample sample = try_start(more, format, arguments);
    va_end(arguments);
    if (sample.run == NULL) {
        printf("\n    %s: %s", format, sample.error.text);
        CU_FAIL_FATAL("the run does not start");
    }
    return sample;
}

/* A run that must not start: its error. */
static inline struct solver_error refusal(const char *more, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static inline struct solver_error refusal(const char *more, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    struct sample sample = try_start(more, format, arguments);
    va_end(arguments);
    if (sample.run != NULL) {
        CU_FAIL("the run starts");
        sample.error = (struct solver_error){.code = SOLVER_OK};
    }
    solver_run_free(sample.run);
    solver_scene_free(sample.scene);
    return sample.error;
}

static inline void finish(struct sample *sample)
{
    solver_run_free(sample->run);
    solver_scene_free(sample->scene);
    *sample = (struct sample){.run = NULL};
}

static inline void advance(struct sample *sample, size_t steps)
{
    bool ok = solver_run_steps(sample->run, steps, &sample->error);
    if (!ok) {
        printf("\n    %s", sample->error.text);
    }
    CU_ASSERT_FATAL(ok);
}

static inline void advance_to(struct sample *sample, double t_end)
{
    bool ok = solver_run_to(sample->run, t_end, NULL, NULL, &sample->error);
    if (!ok) {
        printf("\n    %s", sample->error.text);
    }
    CU_ASSERT_FATAL(ok);
}

static inline struct solver_output output_of(struct sample *sample)
{
    struct solver_output output;
    CU_ASSERT_FATAL(solver_run_output(sample->run, &output, &sample->error));
    return output;
}

/* Whether two runs have the same bits. */
static inline bool are_same(struct sample *one, struct sample *other)
{
    struct solver_output a = output_of(one);
    struct solver_output b = output_of(other);
    size_t vector = a.cloud->count * (size_t)a.cloud->dim * sizeof(double);
    size_t tensor = vector * (size_t)a.cloud->dim;
    return memcmp(a.v, b.v, vector) == 0 && memcmp(a.u, b.u, vector) == 0 && memcmp(a.F, b.F, tensor) == 0 &&
           memcmp(a.H, b.H, tensor) == 0 && memcmp(a.P, b.P, tensor) == 0 &&
           memcmp(a.J, b.J, a.cloud->count * sizeof(double)) == 0;
}

/* The p-wave speed of the block's material as overridden. */
static inline double wave_speed(const struct sample *sample)
{
    const struct solver_scene *scene = sample->scene;
    return solver_material_constants(scene->E, scene->nu, scene->rho).cp;
}

/* Counts an assertion and says what broke it. */
static inline void expect_below(const char *what, double value, double bound)
{
    bool holds = value <= bound;
    if (!holds) {
        printf("\n    %s: %.3e > %.1e", what, value, bound);
    }
    CU_ASSERT(holds);
}

/* The words of a list, separated by blanks, but for one; false if there is no such word. */
static inline bool without_word(const char *words, size_t left_out, char *out, size_t room)
{
    bool found = false;
    size_t used = 0;
    out[0] = '\0';
    for (size_t i = 0; *words != '\0'; i++) {
        size_t length = strcspn(words, " ");
        found = found || i == left_out;
        if (i != left_out) {
            used += (size_t)snprintf(out + used, room - used, "%s%.*s", used > 0 ? " " : "", (int)length, words);
        }
        CU_ASSERT_FATAL(used < room);
        words += length + strspn(words + length, " ");
    }
    return found;
}

#endif
