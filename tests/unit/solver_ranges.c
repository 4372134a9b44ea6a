/* What loops over ranges of particles do, of any length and from any particle on: faces that hold, whether all are
 * whole, cofactors. Each against the same for one particle, by its definition. */
#include "solver/run_internal.h"
#include "tests/unit/runs.h"

#include <float.h>

/* Ranges of every kind: within a lot, across lots, empty, all. */
static const size_t ends[][2] = {{0, 1}, {0, 3}, {1, 2}, {2, 11}, {3, 19}, {5, 5}, {7, 24}, {0, 25}, {9, 25}};
enum { RANGES = sizeof ends / sizeof *ends };

static const char held_on_line[] = "faces = { X0 = 'clamped', X1 = 'symmetric' }\n";
static const char held[] = "faces = { X0 = 'clamped', X1 = 'symmetric', Y0 = 'skew-symmetric' }\n";

/* Whether a face holds the particle along the axis, from where it lies. */
static bool is_held(const struct sample *sample, size_t a, size_t i)
{
    uint32_t on = sample->run->cloud->tags[a] >> SOLVER_ON_FACE;
    bool first = (on & 1U) != 0;
    bool second = (on >> 1 & 1U) != 0 && i == 0;
    bool third = sample->scene->dim > 1 && (on >> 2 & 1U) != 0 && i != 1;
    return first || second || third;
}

static void hold(const char *settings)
{
    struct sample sample = start(strstr(settings, "dim=1") ? held_on_line : held, "%s", settings);
    struct solver_vectors v = solver_state_v(&sample.run->state);
    size_t count = sample.run->cloud->count;
    size_t dim = (size_t)sample.scene->dim;
    size_t zeros = 0;
    CU_ASSERT(sample.run->faces.only_hold);
    for (size_t range = 0; range < RANGES; range++) {
        for (size_t a = 0; a < count; a++) {
            for (size_t i = 0; i < dim; i++) {
                solver_vectors_set(&v, a, i, -0.25 * (double)(1 + a + i));
            }
        }
        solver_faces_hold(&sample.run->faces, v, ends[range][0], ends[range][1]);
        for (size_t a = 0; a < count; a++) {
            bool within = a >= ends[range][0] && a < ends[range][1];
            for (size_t i = 0; i < dim; i++) {
                bool zero = within && is_held(&sample, a, i);
                CU_ASSERT(solver_vectors_get(&v, a, i) == (zero ? 0.0 : -0.25 * (double)(1 + a + i)));
                zeros += zero;
            }
        }
    }
    CU_ASSERT(zeros > 0);
    finish(&sample);
}

static void test_hold(void)
{
    static const char *const precisions[] = {"double", "single"};
    for (size_t i = 0; i < 2; i++) {
        char settings[128];
        for (int dim = 1; dim <= 3; dim++) {
            (void)snprintf(settings, sizeof settings, "dim=%d n=%d precision=%s", dim,
                           dim == 1   ? 24
                           : dim == 2 ? 4
                                      : 3,
                           precisions[i]);
            hold(settings);
        }
    }
}

/* A face that moves, or a particle of a wall, is no matter of holding alone. */
static void test_only_hold(void)
{
    struct sample sample =
        start("faces = { X0 = 'clamped', X1 = { kind = 'motion', value = function() return first(0, 0, 0) end } }\n",
              "dim=2");
    CU_ASSERT(!sample.run->faces.only_hold);
    CU_ASSERT_PTR_NULL(sample.run->faces.still);
    finish(&sample);
}

static double *field_of(struct sample *sample, const char *name, size_t *width)
{
    struct solver_state *state = &sample->run->state;
    for (size_t f = 0; f < state->field_count; f++) {
        if (strcmp(state->field[f].name, name) == 0) {
            *width = state->field[f].width;
            return *state->field[f].value;
        }
    }
    return NULL;
}

/* With that number in a field of particle `a`, the ranges that hold it name it, and others none. */
static void break_one(struct sample *sample, const char *name, size_t a, double number, bool breaks)
{
    size_t width = 0;
    double *field = field_of(sample, name, &width);
    if (field == NULL) {
        return;
    }
    double *at = field + a * width;
    double kept = *at;
    *at = number;
    for (size_t range = 0; range < RANGES; range++) {
        size_t begin = ends[range][0];
        size_t end = ends[range][1];
        size_t found = sample->run->scheme->first_broken(sample->run->system, begin, end);
        CU_ASSERT_EQUAL(found, breaks && a >= begin && a < end ? a : end);
    }
    *at = kept;
}

static void test_whole(void)
{
    static const char *const settings[] = {
        "dim=1 n=24 evolved=pF",
        "dim=1 n=24 evolved=pFJ",
        "dim=2 n=4 evolved=pF",
        "dim=2 n=4 evolved=pFJ",
        "dim=3 n=3 evolved=pF",
        "dim=3 n=3 evolved=pFHJ",
        "dim=2 n=4 evolved=pF material.model=linear-elastic",
    };
    unit_untrapped();
    for (size_t k = 0; k < sizeof settings / sizeof *settings; k++) {
        struct sample sample = start("", "%s", settings[k]);
        bool linear = strstr(settings[k], "linear") != NULL;
        bool evolved = strstr(settings[k], "J") != NULL;
        for (size_t a = 0; a < 25; a++) {
            break_one(&sample, "v", a, NAN, true);
            break_one(&sample, "v", a, -INFINITY, true);
            break_one(&sample, "v", a, 1e160, true);
            break_one(&sample, "F", a, NAN, true);
            break_one(&sample, "F", a, 1e155, true);
            break_one(&sample, "F", a, -0.5, !linear && !evolved);
            break_one(&sample, "F", a, 0.0, !linear && !evolved);
            break_one(&sample, "J", a, NAN, true);
            break_one(&sample, "J", a, INFINITY, true);
            break_one(&sample, "J", a, -1.0, true);
            break_one(&sample, "J", a, 0.0, true);
            break_one(&sample, "J", a, 1e200, false); /* its square is none of what is asked */
        }
        finish(&sample);
    }
}

/* Squares of many may overflow where none of a particle's does. */
static void test_whole_together(void)
{
    size_t width = 0;
    struct sample sample = start("", "dim=2 n=4 evolved=pFJ");
    double *v = field_of(&sample, "v", &width);
    unit_untrapped();
    for (size_t a = 0; a < 25; a++) {
        v[a * width] = 1.2e154;
    }
    CU_ASSERT_EQUAL(sample.run->scheme->first_broken(sample.run->system, 0, 25), 25);
    finish(&sample);
}

static void test_cofactors(void)
{
    struct sample sample = start("", "dim=2 n=4 evolved=pFJ");
    size_t width = 0;
    double *F = field_of(&sample, "F", &width);
    double *H = field_of(&sample, "cof F", &width);
    for (size_t i = 0; i < 25 * width; i++) {
        F[i] = 1.0 + 0.01 * (double)i + (i % 3 == 0 ? 0.5 : 0.0);
    }
    for (size_t range = 0; range < RANGES; range++) {
        memset(H, 0, 25 * width * sizeof *H);
        sample.run->scheme->refresh(sample.run->system, ends[range][0], ends[range][1]);
        for (size_t a = 0; a < 25; a++) {
            const double *f = F + a * width;
            const double expected[] = {f[3], -f[2], -f[1], f[0]};
            bool within = a >= ends[range][0] && a < ends[range][1];
            for (size_t k = 0; k < 4; k++) {
                CU_ASSERT(H[a * width + k] == (within ? expected[k] : 0.0));
            }
        }
    }
    finish(&sample);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"faces hold the particles of a range", test_hold},
        {"faces that move do not only hold", test_only_hold},
        {"which particle of a range is broken first", test_whole},
        {"squares that overflow together", test_whole_together},
        {"cofactors of a range", test_cofactors},
    };
    return unit_main("ranges", tests, sizeof tests / sizeof *tests);
}
