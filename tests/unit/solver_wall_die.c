/* Bodies that meet walls by paths: momentum of both, places, and what faces lead. */
#include "solver/run_internal.h"
#include "tests/unit/runs.h"

static const char elastic[] = "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2 }\n"
                              "history = 1000\n";

/* How far the body reaches to the right of x = `at` along an axis, or to the left of it, by `side`. */
static double reach(const struct solver_output *output, size_t axis, double side, double at)
{
    double most = -INFINITY;
    for (size_t a = 0; a < output->cloud->count; a++) {
        most = fmax(most, side * (output->cloud->X[2 * a + axis] + output->u[2 * a + axis] - at));
    }
    return most;
}

/* Distance of the nearest particle from a place. */
static double nearest(const struct solver_output *output, double x, double y)
{
    double least = INFINITY;
    for (size_t a = 0; a < output->cloud->count; a++) {
        least = fmin(least, hypot(output->cloud->X[2 * a] + output->u[2 * a] - x,
                                  output->cloud->X[2 * a + 1] + output->u[2 * a + 1] - y));
    }
    return least;
}

static double off_momentum(const struct solver_history *history)
{
    double off = 0.0;
    for (size_t row = 0; row < history->count; row++) {
        const struct solver_totals *at = &history->totals[row], *first = &history->totals[0];
        for (size_t i = 0; i < 2; i++) {
            off = fmax(off, fabs(at->linear[i] + at->wall[i] - first->linear[i] - first->wall[i]));
        }
    }
    return off;
}

/* Thrown into a corner, sharp or rounded: no particle passes either side, both get their impulse, and momentum is kept;
 * whatever the number of threads, to the bit. */
static void into_a_corner(void)
{
    static const char more[] = "parameters = { r = 0 }\n"
                               "die = { { path = { {-0.01, 3}, {-0.01, -0.02}, {3, -0.02} }, fillets = { r } } }\n"
                               "domain = { lower = {0.1, 0.1}, upper = {1.1, 1.1} }\n"
                               "initial = { velocity = function() return -0.3, -0.2 end }\n";
    char scene[1024];
    (void)snprintf(scene, sizeof scene, "%s%s", elastic, more);
    for (int kind = 0; kind < 2; kind++) {
        struct solver_totals last[2];
        for (int threads = 1; threads <= 2; threads++) {
            struct sample sample =
                start(scene, "dim=2 n=6 r=%g threads=%d evolved=pF", kind == 0 ? 0.0 : 0.25, threads);
            double behind = 0.0;
            for (int part = 1; part <= 15; part++) {
                advance_to(&sample, 0.1 * part);
                struct solver_output output = output_of(&sample);
                behind = fmax(behind, reach(&output, 0, -1.0, -0.01));
                behind = fmax(behind, reach(&output, 1, -1.0, -0.02));
                if (kind == 1) { /* the fillet's centre is 0.25 away from both sides */
                    for (size_t a = 0; a < output.cloud->count; a++) {
                        double x = output.cloud->X[2 * a] + output.u[2 * a] - 0.24;
                        double y = output.cloud->X[2 * a + 1] + output.u[2 * a + 1] - 0.23;
                        behind = fmax(behind, x < 0.0 && y < 0.0 ? hypot(x, y) - 0.25 : 0.0);
                    }
                }
            }
            const struct solver_history *history = solver_run_history(sample.run);
            last[threads - 1] = history->totals[history->count - 1];
            expect_below("momentum of body and wall", off_momentum(history), 1e-13);
            /* what slides by d along the hollow ends d^2/2r behind it */
            double slide = 0.36 * 1.5 / (double)solver_run_facts(sample.run).steps;
            expect_below("way behind the wall", behind, kind == 0 ? 1e-14 : slide * slide / (2.0 * 0.25));
            CU_ASSERT(last[threads - 1].wall[0] < -0.1 && last[threads - 1].wall[1] < -0.1);
            finish(&sample);
        }
        for (size_t i = 0; i < 2; i++) {
            CU_ASSERT_EQUAL(last[0].linear[i], last[1].linear[i]);
            CU_ASSERT_EQUAL(last[0].wall[i], last[1].wall[i]);
        }
        CU_ASSERT_EQUAL(last[0].kinetic, last[1].kinetic);
        CU_ASSERT_EQUAL(last[0].strain, last[1].strain);
    }
}

/* A straight path is the plane. */
static void as_a_plane(void)
{
    static const char *const walls[] = {"rigid_wall = { point = {-0.05, 0}, normal = {1, 0} }\n",
                                        "die = { { path = { {-0.05, 5}, {-0.05, -5} } } }\n"};
    struct solver_totals last[2];
    for (int i = 0; i < 2; i++) {
        char scene[1024];
        (void)snprintf(scene, sizeof scene, "%s%sinitial = { velocity = function() return -0.3, 0.1 end }\n", elastic,
                       walls[i]);
        struct sample sample = start(scene, "dim=2 n=8");
        advance_to(&sample, 1.0);
        const struct solver_history *history = solver_run_history(sample.run);
        last[i] = history->totals[history->count - 1];
        finish(&sample);
    }
    CU_ASSERT_DOUBLE_EQUAL(last[0].kinetic, last[1].kinetic, 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(last[0].wall[0], last[1].wall[0], 1e-14);
    CU_ASSERT(last[1].wall[0] < -0.1 && fabs(last[1].wall[1]) < 1e-14);
}

/* Pushed onto a round corner finer than its spacing: no particle enters it, those within the body neither. */
static void onto_a_corner(void)
{
    static const char more[] = "die = { { path = { {-0.05, 0.45}, {1, 0.45}, {1, 0.3} }, fillets = { 0.1 } } }\n"
                               "domain = { lower = {0.8, 0.5}, upper = {2.8, 1.5} }\n"
                               "initial = { velocity = function(X, Y) return 0, -0.4 end }\n";
    char scene[1024];
    (void)snprintf(scene, sizeof scene, "%s%s", elastic, more);
    struct sample sample = start(scene, "dim=2 n=10 evolved=pF");
    double entered = 0.0;
    for (int part = 1; part <= 10; part++) {
        advance_to(&sample, 0.1 * part);
        struct solver_output output = output_of(&sample);
        entered = fmax(entered, 0.1 - nearest(&output, 0.9, 0.35));
    }
    const struct solver_history *history = solver_run_history(sample.run);
    const struct solver_totals *last = &history->totals[history->count - 1];
    expect_below("way into the corner", entered, 1e-12);
    expect_below("momentum of body and wall", off_momentum(history), 1e-13);
    CU_ASSERT(last->wall[1] < -0.02 && last->wall[0] != 0.0);
    finish(&sample);
}

/* Between two sides that it fills a body slides as if there were none; one that is pressed keeps between them. */
static void in_a_channel(void)
{
    static const char more[] = "parameters = { across = 0 }\n"
                               "die = { { path = { {-5, 0}, {9, 0} } }, { path = { {9, 1}, {-5, 1} } } }\n"
                               "initial = { velocity = function(X, Y) return 0.3, across * (Y - 0.5) end }\n";
    char scene[1024];
    (void)snprintf(scene, sizeof scene, "%s%s", elastic, more);
    struct sample sample = start(scene, "dim=2 n=6");
    advance_to(&sample, 1.0);
    struct solver_output output = output_of(&sample);
    const struct solver_totals *last =
        &solver_run_history(sample.run)->totals[solver_run_history(sample.run)->count - 1];
    CU_ASSERT(last->wall[0] == 0.0 && fabs(last->wall[1]) < 1e-14);
    CU_ASSERT_DOUBLE_EQUAL(last->linear[0], 2.0 * 0.3, 1e-13);
    finish(&sample);
    sample = start(scene, "dim=2 n=6 across=0.5");
    double behind = 0.0;
    for (int part = 1; part <= 10; part++) {
        advance_to(&sample, 0.1 * part);
        output = output_of(&sample);
        behind = fmax(behind, fmax(reach(&output, 1, 1.0, 1.0), reach(&output, 1, -1.0, 0.0)));
    }
    expect_below("way behind the sides", behind, 1e-14);
    expect_below("momentum of body and walls", off_momentum(solver_run_history(sample.run)), 1e-13);
    finish(&sample);
}

/* A ram leads the body along the channel, into which it just fits, and the wall keeps the ram's particles from
 * spreading; its faces may hold them across. */
static void led(void)
{
    static const char more[] = "die = { { path = { {9, 1}, {-5, 1} } } }\n"
                               "faces = { X1 = { kind = 'roller', value = function() return -0.2, 0 end },\n"
                               "    Y0 = 'symmetric', X0 = 'clamped' }\n";
    char scene[1024];
    (void)snprintf(scene, sizeof scene, "%s%s", elastic, more);
    struct sample sample = start(scene, "dim=2 n=6");
    advance_to(&sample, 0.5);
    struct solver_output output = output_of(&sample);
    const struct solver_history *history = solver_run_history(sample.run);
    expect_below("way behind the wall", reach(&output, 1, 1.0, 1.0), 1e-14);
    CU_ASSERT(history->totals[history->count - 1].wall[1] > 0.01);
    for (size_t a = 0; a < output.cloud->count; a++) {
        CU_ASSERT(output.cloud->X[2 * a] < 1.0 || output.v[2 * a] == -0.2);
        CU_ASSERT(output.cloud->X[2 * a] > 0.0 || output.v[2 * a] == 0.0);
    }
    finish(&sample);
}

/* Onto a slope along a plane of symmetry: a particle on both is stopped by the one way that is left to it. */
static void led_onto_a_slope(void)
{
    static const char more[] = "die = { { path = { {-3.9, -5}, {6.1, 5} } } }\n"
                               "faces = { Y0 = 'symmetric' }\n"
                               "initial = { velocity = function() return 0.4, 0 end }\n";
    char scene[1024];
    (void)snprintf(scene, sizeof scene, "%s%s", elastic, more);
    struct sample sample = start(scene, "dim=2 n=6 evolved=pF");
    double behind = 0.0, nearest_to_it = INFINITY;
    for (int part = 1; part <= 10; part++) {
        advance_to(&sample, 0.1 * part);
        struct solver_output output = output_of(&sample);
        for (size_t a = 0; a < output.cloud->count; a++) {
            double x = output.cloud->X[2 * a] + output.u[2 * a], y = output.cloud->X[2 * a + 1] + output.u[2 * a + 1];
            double gap = (1.1 - x + y) / sqrt(2.0);
            behind = fmax(behind, -gap);
            nearest_to_it = output.cloud->X[2 * a + 1] == 0.0 ? fmin(nearest_to_it, gap) : nearest_to_it;
            CU_ASSERT(output.cloud->X[2 * a + 1] > 0.0 || y == 0.0);
        }
    }
    expect_below("way behind the slope", behind, 1e-12);
    CU_ASSERT(nearest_to_it < 1e-3);
    finish(&sample);
}

static void refused(const char *more, const char *overrides, const char *expected)
{
    struct solver_error error = refusal(more, "dim=2 %s", overrides);
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, expected));
    if (strstr(error.text, expected) == NULL) {
        printf("\n    %s", error.text);
    }
}

static void refusals(void)
{
    refused("die = { { path = { {0.25, 5}, {0.25, -5} } } }\n", "", "die[1]: the body reaches 0.25 m behind the wall");
    refused("die = { { path = { {-1, -5}, {-1, 5} } } }\n", "", "die[1]: the body reaches 2 m behind the wall");
    refused("die = { { path = { {-1, 5}, {-1, -5} } } }\n", "scheme=ulsph material.model=linear-elastic",
            "die: the scheme moves particles by other velocities");
    refused("die = { { path = { {-1, 5}, {-1, -5} } } }\n"
            "faces = { X1 = { kind = 'motion', value = function() return 0, 0 end, free_after = 0.5 } }\n",
            "", "die: faces hold or move a particle of the surface along the wall's normal for a time");
}

/* What a scene without walls pays: nothing. */
static void nothing_asked(void)
{
    struct sample without = start(elastic, "dim=2"),
                  with = start("die = { { path = { {-1, 5}, {-1, -5} } } }\n", "dim=2");
    CU_ASSERT(without.run->wall.count == 0 && without.run->wall.die.piece == NULL && without.run->wall.site == NULL);
    CU_ASSERT_EQUAL(with.run->wall.count, 25);
    finish(&without);
    finish(&with);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"into a corner", into_a_corner},
        {"a straight path is a plane", as_a_plane},
        {"onto a round corner", onto_a_corner},
        {"between two sides", in_a_channel},
        {"led along a wall", led},
        {"led onto a slope", led_onto_a_slope},
        {"refusals", refusals},
        {"a scene without walls", nothing_asked},
    };
    return unit_main("walls by paths and bodies", tests, sizeof tests / sizeof *tests);
}
