/* Checkpoints: a run that goes on from one ends with the same bytes, by every scheme and with every part that hands
 * something from one step to the next; and what is written is whole or not there. */
#include "solver/checkpoint.h"
#include "solver/scheme.h"
#include "tests/unit/run_bytes.h"
#include "tests/unit/runs.h"
#include "tests/unit/scratch.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

static char folder[SCRATCH];
static char path[SCRATCH_BELOW];

static const struct solver_checkpoint_about about = {
    "scene.lua", "/there/scene.lua", "title = 'x'", "n=4\n", "assay run scene", "1.0", NULL, NULL, 30.0, 0.0, 7, 0};

/* A run of a case after so many steps, by way of a checkpoint after `before` of them if there is one. */
struct plan {
    const char *more, *settings;
    size_t before, after;
    bool unnoted; /* the steps before have no row of history, nor has the start */
};

static struct sample begin(const struct plan *plan, int threads)
{
    struct sample sample = start(plan->more, "%s", plan->settings);
    (void)strcpy(sample.scene->name, "block"); /* not that of a temporary file */
    sample.scene->threads = threads;
    sample.scene->history = 1 << 30; /* a row each step */
    solver_run_free(sample.run);
    CU_ASSERT_FATAL(solver_run_create(sample.scene, &sample.run, &sample.error));
    return sample;
}

static void reach(struct sample *sample, size_t step)
{
    bool there = run_to_step(sample->scene, sample->run, step, &sample->error);
    if (!there) {
        printf("\n    step %zu: %s", step, sample->error.text);
    }
    CU_ASSERT_FATAL(there);
}

static void restore(struct sample *sample)
{
    struct solver_checkpoint *checkpoint = NULL;
    bool good = solver_checkpoint_read(path, &checkpoint, &sample->error) &&
                solver_checkpoint_restore(checkpoint, sample->run, &sample->error);
    if (!good) {
        printf("\n    %s", sample->error.text);
    }
    CU_ASSERT_FATAL(good);
    solver_checkpoint_free(checkpoint);
}

/* The run goes on by one thread; the one that takes it up has two, or the other way round. */
static void compare(const struct plan *plan, int threads)
{
    struct sample straight = begin(plan, threads), resumed = begin(plan, 3 - threads);
    if (plan->unnoted) {
        CU_ASSERT_FATAL(solver_run_steps(straight.run, plan->before, &straight.error));
        CU_ASSERT_EQUAL(solver_run_history(straight.run)->count, 0);
    } else {
        reach(&straight, plan->before);
    }
    CU_ASSERT_FATAL(solver_checkpoint_write(path, straight.run, &about, &straight.error));
    size_t pairs = solver_run_facts(straight.run).pairs;
    reach(&straight, plan->after);
    restore(&resumed);
    CU_ASSERT_EQUAL(solver_run_facts(resumed.run).pairs, pairs);
    CU_ASSERT_EQUAL(solver_run_facts(resumed.run).steps, plan->before);
    reach(&resumed, plan->after);
    struct run_bytes left = run_bytes_of(straight.scene, straight.run);
    struct run_bytes right = run_bytes_of(resumed.scene, resumed.run);
    bool same = run_bytes_same(&left, &right);
    if (!same) {
        printf("\n    %s: other bytes from the checkpoint on", plan->settings);
    }
    CU_ASSERT(same);
    CU_ASSERT_EQUAL(solver_run_facts(straight.run).pairs, solver_run_facts(resumed.run).pairs);
    CU_ASSERT_EQUAL(solver_run_history(resumed.run)->count, plan->after + 1 - (plan->unnoted ? plan->before : 0));
    free(left.record);
    free(right.record);
    finish(&straight);
    finish(&resumed);
}

static const char driven[] =
    "probes = { { name = 'middle', X = each(0.5) } }\n"
    "body_force = function(X, Y, Z, t) return first(0.1 * X, 0.2 * t, -0.1) end\n"
    "faces = { X0 = 'symmetric', X1 = { kind = 'traction', value = function(X, Y, Z, t) return first(0.1, Y, Z) end } "
    "}\n"
    "initial = { velocity = function(X, Y, Z)\n"
    "    return first(0.05 * sin(2 * X + Y), 0.04 * cos(3 * Y - X + Z), 0.05 * sin(2 * Z + X)) end }\n";

static void every_scheme(void)
{
    static const char *const integrators[] = {"euler", "tvd-rk2", "rk4"};
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        for (int dim = 1; dim <= 3; dim++) {
            char settings[128];
            (void)snprintf(settings, sizeof settings, "dim=%d scheme=%s material.model=linear-elastic integrator=%s",
                           dim, (*scheme)->name, integrators[dim - 1]);
            compare(&(struct plan){driven, settings, 5, 11, false}, 1);
        }
    }
}

static void every_evolved_set(void)
{
    static const char *const settings[] = {"dim=2 evolved=pF",
                                           "dim=2 evolved=pFJ",
                                           "dim=3 evolved=pFHJ",
                                           "dim=2 evolved=pFHJ scheme=jst volume_flux=stress",
                                           "dim=2 evolved=pFJ reconstruction=least-squares",
                                           "dim=2 evolved=pF precision=single",
                                           "dim=3 evolved=pFHJ precision=single"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        compare(&(struct plan){driven, settings[i], 5, 11, false}, 1);
    }
}

/* Each hands something of its own from step to step, which is not a field that others have. */
static const char torn[] = "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.03, hardening = "
                           "0.3 }\n"
                           "initial = { velocity = function(X, Y, Z)\n"
                           "    return first(0.4 * X - 0.1 * Y, 0.2 * X + 0.1 * sin(3 * X), 0.3 * Z * X) end }\n";
static const char thrown[] = "initial = { velocity = function() return first(-0.3, 0, 0) end }\n"
                             "rigid_wall = { point = each(-0.01), normal = { first(1, 0, 0) } }\n";
static const char spinning[] = "initial = { velocity = function(X, Y, Z)\n"
                               "    return first(0.4 * X - 0.6 * Y, 0.6 * X - 0.2 * Y, 0) end }\n"
                               "angular_momentum = 'projected'\n";
static const char turning[] =
    "scheme, support = 'ulsph', 2.4\n"
    "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
    "initial = { velocity = function(X, Y) return first(-0.1 * X - 0.05 * Y, 0.05 * X - 0.02, 0) end }\n";
/* Without a domain = of its own. */
static const char colliding[] = "-- no domain = here\n"
                                "lattice, reference_length = 'centres', 1\n"
                                "bodies = { { shape = 'box', lower = {0, 0}, upper = {1, 1} },\n"
                                "           { shape = 'box', lower = {1.02, 0.1}, upper = {2.02, 1.1} } }\n"
                                "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                                "scheme, support, contact = 'ulsph', 2.4, { law = 'predicted' }\n"
                                "initial = { velocity = function(X) return X < 1.01 and 0.1 or -0.1, 0 end }\n";
static const char let_go[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n"
                             "faces = { X0 = 'clamped', X1 = { kind = 'motion', free_after = 0.9,\n"
                             "    value = function(X, Y, Z, t) return first(0.1 * sin(8 * t), 0, 0) end } }\n";

static void every_part(void)
{
    static const struct plan plans[] = {
        {torn, "dim=2 n=6 t_end=3", 30, 60, false},
        {torn, "dim=3 n=4 evolved=pF integrator=rk4 t_end=3", 12, 24, false},
        {thrown, "dim=2 n=6 evolved=pF t_end=3", 10, 30, false},
        {spinning, "dim=2 n=6 evolved=pF t_end=3", 40, 80, false},
        {turning, "dim=2 n=8 t_end=30 perturb=0.1 cfl=0.2", 45, 50, false},
        {turning, "dim=2 n=8 t_end=30 perturb=0.1 cfl=0.2", 48, 53, false},
        {colliding, "dim=2 n=6 t_end=30", 30, 60, false},
        {colliding, "dim=2 n=6 t_end=30", 200, 210, false}, /* they have parted */
        {let_go, "dim=2 n=4 t_end=3", 20, 40, false},
    };
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        compare(&plans[i], 2);
    }
}

static void before_the_first_row(void)
{
    compare(&(struct plan){driven, "dim=2 balance=true", 0, 6, true}, 1);
    compare(&(struct plan){driven, "dim=2 balance=true", 3, 6, true}, 1);
}

/* At the end of a run there is nothing to do but to show it. */
static void at_the_end(void)
{
    struct plan plan = {driven, "dim=2 t_end=0.3", 0, 0, false};
    struct sample straight = begin(&plan, 1), resumed = begin(&plan, 1);
    advance_to(&straight, 0.3);
    CU_ASSERT_FATAL(solver_checkpoint_write(path, straight.run, &about, &straight.error));
    restore(&resumed);
    advance_to(&resumed, 0.3);
    struct run_bytes left = run_bytes_of(straight.scene, straight.run);
    struct run_bytes right = run_bytes_of(resumed.scene, resumed.run);
    CU_ASSERT(run_bytes_same(&left, &right));
    free(left.record);
    free(right.record);
    finish(&straight);
    finish(&resumed);
}

/* What is said beside the state comes back as it was. */
static void notes(void)
{
    struct sample sample = begin(&(struct plan){driven, "dim=2", 3, 3, false}, 1);
    struct solver_checkpoint *checkpoint = NULL;
    reach(&sample, 3);
    CU_ASSERT_FATAL(solver_checkpoint_write(path, sample.run, &about, &sample.error));
    CU_ASSERT_FATAL(solver_checkpoint_read(path, &checkpoint, &sample.error));
    const struct solver_checkpoint_about *read = solver_checkpoint_about(checkpoint);
    CU_ASSERT_STRING_EQUAL(read->scene_path, about.scene_path);
    CU_ASSERT_STRING_EQUAL(read->scene_file, about.scene_file);
    CU_ASSERT_STRING_EQUAL(read->scene_text, about.scene_text);
    CU_ASSERT_STRING_EQUAL(read->overrides, about.overrides);
    CU_ASSERT_STRING_EQUAL(read->command, about.command);
    CU_ASSERT_STRING_EQUAL(read->version, about.version);
    CU_ASSERT_EQUAL(read->every_seconds, 30.0);
    CU_ASSERT_EQUAL(read->every_steps, 7);
    CU_ASSERT_EQUAL(read->step, 3);
    CU_ASSERT_EQUAL(read->time, output_of(&sample).time);
    solver_checkpoint_free(checkpoint);
    finish(&sample);
}

/* True if writing fails, with a clear error, where no file may have more than `limit` bytes. */
static bool write_on_small_disk(const struct sample *sample, rlim_t limit)
{
    struct solver_error error = {.text = ""};
    struct rlimit before;
    CU_ASSERT_FATAL(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const struct rlimit most = {limit, before.rlim_max};
    (void)signal(SIGXFSZ, SIG_IGN);
    CU_ASSERT_FATAL(setrlimit(RLIMIT_FSIZE, &most) == 0);
    bool refused = !solver_checkpoint_write(path, sample->run, &about, &error);
    CU_ASSERT_FATAL(setrlimit(RLIMIT_FSIZE, &before) == 0);
    (void)signal(SIGXFSZ, SIG_DFL);
    return refused && error.code == SOLVER_IO && strstr(error.text, path) != NULL;
}

static void full_disk(void)
{
    static const rlim_t limits[] = {0, 1, 31, 500, 3000};
    struct sample sample = begin(&(struct plan){driven, "dim=2", 3, 3, false}, 1);
    struct sample later = begin(&(struct plan){driven, "dim=2", 3, 3, false}, 1);
    struct stat before, after;
    reach(&sample, 3);
    CU_ASSERT_FATAL(solver_checkpoint_write(path, sample.run, &about, &sample.error));
    CU_ASSERT_FATAL(stat(path, &before) == 0 && before.st_size > 3000);
    reach(&sample, 5);
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        CU_ASSERT(write_on_small_disk(&sample, limits[i]));
    }
    CU_ASSERT_FATAL(stat(path, &after) == 0);
    CU_ASSERT(before.st_ino == after.st_ino && before.st_size == after.st_size);
    restore(&later); /* the one before */
    CU_ASSERT_EQUAL(solver_run_facts(later.run).steps, 3);
    CU_ASSERT_EQUAL(unlink(path), 0);
    CU_ASSERT_EQUAL(rmdir(folder), 0); /* nothing else was left */
    CU_ASSERT_EQUAL(mkdir(folder, 0700), 0);
    finish(&sample);
    finish(&later);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every scheme goes on as if nothing had happened", every_scheme},
        {"every evolved set", every_evolved_set},
        {"every part that has something to hand on", every_part},
        {"before the first row of history", before_the_first_row},
        {"a run at its end", at_the_end},
        {"what is said beside the state", notes},
        {"a full disk leaves the checkpoint before", full_disk},
    };
    scratch_folder(folder);
    (void)snprintf(path, sizeof path, "%s/run.checkpoint", folder);
    int result = unit_main("checkpoints", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    return result;
}
