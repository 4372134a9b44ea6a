/* How far a run is and how long it will take, and when it is written to disk. */
#include "tests/unit/unit.h"
#include "verify/checkpoints.h"
#include "verify/progress.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool set_up_just_now;

/* What is said at `time` of a run to 100 s that came from `from`, and began `begun` s ago. */
static const char *said(double from, double time, double begun, double shown)
{
    static char text[512];
    FILE *file = tmpfile();
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    (void)fflush(stderr);
    int kept = dup(STDERR_FILENO);
    (void)dup2(fileno(file), STDERR_FILENO);
    double now = verify_now();
    struct verify_progress progress = {
        .label = "some", .t_end = 100, .from = from, .on = true, .begun = now - begun, .shown = now - shown};
    if (set_up_just_now) {
        verify_progress_go(&progress);
    }
    CU_ASSERT_TRUE(verify_progress_show(&progress, time, 7, 42));
    (void)fflush(stderr);
    (void)dup2(kept, STDERR_FILENO);
    (void)close(kept);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    (void)fclose(file);
    return text;
}

static void time_to_go(void)
{
    CU_ASSERT_PTR_NOT_NULL(
        strstr(said(0, 25, 1000, 1), "some: [#######.......................]  25 %, step 42, t = 25 s"));
    CU_ASSERT_PTR_NOT_NULL(strstr(said(0, 25, 1000, 1), ", 3000 s to go"));
    CU_ASSERT_PTR_NOT_NULL(strstr(said(0, 80, 1000, 1), ", 250 s to go"));
    /* of a run that went on from a checkpoint: only what it has done itself took that long */
    CU_ASSERT_PTR_NOT_NULL(strstr(said(60, 80, 1000, 1), "]  80 %,"));
    CU_ASSERT_PTR_NOT_NULL(strstr(said(60, 80, 1000, 1), ", 1000 s to go"));
    CU_ASSERT_PTR_NULL(strstr(said(60, 60.5, 1000, 1), "to go")); /* too early to tell */
    CU_ASSERT_STRING_EQUAL(said(0, 25, 1000, 0), "");             /* again so soon */
}

/* A set-up that took 1000 s is no measure of steps that take none. */
static void without_the_set_up(void)
{
    set_up_just_now = true;
    CU_ASSERT_PTR_NOT_NULL(strstr(said(0, 25, 1000, 1), ", 0 s to go"));
    set_up_just_now = false;
}

static bool due(struct verify_pace every, double since, size_t step)
{
    const struct verify_checkpoints checkpoints = {.every = every, .written = verify_now() - since};
    return verify_checkpoints_due(&checkpoints, step);
}

static void due_by_steps_or_by_time(void)
{
    const struct verify_pace steps = {.steps = 50}, seconds = {.seconds = 30}, never = {.steps = 0};
    CU_ASSERT_TRUE(due(steps, 0, 50));
    CU_ASSERT_TRUE(due(steps, 0, 150));
    CU_ASSERT_FALSE(due(steps, 1e6, 149));
    CU_ASSERT_FALSE(due(steps, 0, 75));
    CU_ASSERT_TRUE(due(seconds, 31, 1));
    CU_ASSERT_FALSE(due(seconds, 20, 30));
    CU_ASSERT_FALSE(due(never, 1e9, 50));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"time to go", time_to_go},
        {"without the set-up", without_the_set_up},
        {"due by steps or by time", due_by_steps_or_by_time},
    };
    return unit_main("progress", tests, sizeof tests / sizeof *tests);
}
