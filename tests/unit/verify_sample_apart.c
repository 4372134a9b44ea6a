/* Reading in a process of its own: what it reads comes back whole, and whatever becomes of it is an error. */
#include "tests/unit/sample_files.h"
#include "verify/sample_apart.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

enum { BYTES = 100, POINTS = 5000 }; /* more than a pipe holds at once */

static bool ask(verify_sample_reader *read, unsigned seconds)
{
    verify_samples_free(&samples);
    sample_error = (struct solver_error){.code = SOLVER_OK};
    bool done = verify_sample_apart(read, seconds, "made.h5", BYTES, &samples, &sample_error);
    CU_ASSERT_TRUE(waitpid(-1, NULL, WNOHANG) < 0); /* no process is left */
    return done;
}

static void lost(verify_sample_reader *read)
{
    CU_ASSERT_FALSE(ask(read, 10));
    CU_ASSERT_EQUAL(sample_error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(sample_error.text, "made.h5: the library that reads such files did not survive it"));
}

static bool read_two(const char *path, size_t bytes, struct verify_samples *to, struct solver_error *error)
{
    CU_ASSERT_TRUE(strcmp(path, "made.h5") == 0 && bytes == BYTES);
    for (int i = 0; i < 2; i++) {
        struct verify_sample *sample = verify_samples_add(to, i == 0 ? "coarse" : "fine", error);
        if (sample == NULL || !verify_sample_points(sample, POINTS, 2 + i, error) ||
            (i == 1 && !verify_sample_weights(sample, error)) || verify_sample_add(sample, "P", 9, error) == NULL) {
            return false;
        }
        sample->time = (struct verify_sample_number){.value = 2, .unit = "ms", .has_unit = true};
        for (size_t j = 0; j < 9 * (size_t)POINTS; j++) {
            sample->field[0].value[j] = 0.5 * (double)j + i;
            sample->X[j % (3 * (size_t)POINTS)] = (double)j;
        }
        for (size_t j = 0; i == 1 && j < POINTS; j++) {
            sample->weight[j] = (double)j;
        }
    }
    return true;
}

static void what_is_read_comes_back(void)
{
    struct verify_samples here = {.count = 0};
    CU_ASSERT_TRUE_FATAL(read_two("made.h5", BYTES, &here, &sample_error));
    CU_ASSERT_TRUE_FATAL(ask(read_two, 10));
    CU_ASSERT_EQUAL_FATAL(samples.count, 2);
    for (size_t i = 0; i < 2; i++) {
        const struct verify_sample *a = here.sample[i], *b = samples.sample[i];
        CU_ASSERT_STRING_EQUAL(a->place, b->place);
        CU_ASSERT_STRING_EQUAL(a->time.unit, b->time.unit);
        CU_ASSERT_TRUE(a->count == b->count && a->dim == b->dim && a->time.value == b->time.value && isnan(b->h.value));
        CU_ASSERT_TRUE(b->field_count == 1 && same_numbers(a->X, b->X, 3 * (size_t)POINTS));
        CU_ASSERT_TRUE(same_numbers(a->field[0].value, b->field[0].value, 9 * (size_t)POINTS));
        CU_ASSERT_TRUE((a->weight == NULL) == (b->weight == NULL));
        CU_ASSERT_TRUE(a->weight == NULL || same_numbers(a->weight, b->weight, POINTS));
    }
    verify_samples_free(&here);
}

static bool say_no(const char *path, size_t bytes, struct verify_samples *to, struct solver_error *error)
{
    (void)bytes;
    (void)to;
    return solver_fail(error, SOLVER_BAD_INPUT, "%s: not like this", path);
}

static void errors_come_back(void)
{
    CU_ASSERT_FALSE(ask(say_no, 10));
    CU_ASSERT_STRING_EQUAL(sample_error.text, "made.h5: not like this");
    CU_ASSERT_EQUAL(sample_error.code, SOLVER_BAD_INPUT);
}

static bool die(const char *path, size_t bytes, struct verify_samples *to, struct solver_error *error)
{
    (void)path;
    (void)bytes;
    (void)to;
    (void)error;
    (void)signal(SIGSEGV, SIG_DFL); /* without a sanitizer's report */
    return raise(SIGSEGV) == 0;
}

static bool leave(const char *path, size_t bytes, struct verify_samples *to, struct solver_error *error)
{
    (void)path;
    (void)bytes;
    (void)to;
    (void)error;
    _exit(0);
}

static bool stay(const char *path, size_t bytes, struct verify_samples *to, struct solver_error *error)
{
    (void)path;
    (void)bytes;
    (void)to;
    (void)error;
    volatile bool waiting = true;
    while (waiting) {
    }
    return true;
}

/* Points with seven coordinates. */
static bool lie(const char *path, size_t bytes, struct verify_samples *to, struct solver_error *error)
{
    bool read = read_two(path, bytes, to, error);
    to->sample[1]->dim = 7;
    return read;
}

static void crashes_are_errors(void)
{
    lost(die);
    lost(leave);
    lost(lie);
}

static void it_does_not_run_for_ever(void)
{
    CU_ASSERT_FALSE(ask(stay, 1));
    CU_ASSERT_PTR_NOT_NULL(strstr(sample_error.text, "did not survive"));
}

/* Refuses unless time, memory and the memory's image after a crash are limited. */
static bool feel_limits(const char *path, size_t bytes, struct verify_samples *to, struct solver_error *error)
{
    struct rlimit time, memory, core;
    bool known =
        getrlimit(RLIMIT_CPU, &time) == 0 && getrlimit(RLIMIT_DATA, &memory) == 0 && getrlimit(RLIMIT_CORE, &core) == 0;
    bool limited = known && time.rlim_cur == 10 && core.rlim_cur == 0;
#ifndef __SANITIZE_ADDRESS__
    limited = limited && memory.rlim_cur < (rlim_t)1 << 32;
#endif
    return limited ? read_two(path, bytes, to, error) : solver_fail(error, SOLVER_BAD_INPUT, "no limits");
}

static void what_it_may_take_is_limited(void)
{
    CU_ASSERT_TRUE(ask(feel_limits, 10));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"what is read comes back", what_is_read_comes_back},
        {"errors come back", errors_come_back},
        {"crashes are errors", crashes_are_errors},
        {"it does not run for ever", it_does_not_run_for_ever},
        {"what it may take is limited", what_it_may_take_is_limited},
    };
    return sample_files_end(unit_main("verify: samples read apart", tests, sizeof tests / sizeof *tests));
}
