/* Clouds of one to four particles, on a line, in a plane, on top of one another or far from all others: every builder
 * of stencils gives pair vectors that are numbers, and where it claims to differentiate linear fields does so, or
 * refuses with a text. Never a NaN. */
#include "unit.h"

#include "solver/cloud.h"
#include "solver/stencil.h"

#include <math.h>
#include <string.h>

enum { MOST = 5 };

struct handful {
    const char *what;
    int dim;
    size_t count;
    double X[MOST][3];
};

static const struct handful handfuls[] = {
    {"one, 1D", 1, 1, {{0}}},
    {"one, 2D", 2, 1, {{0}}},
    {"one, 3D", 3, 1, {{0}}},
    {"two, 1D", 1, 2, {{0}, {1}}},
    {"two, 2D", 2, 2, {{0}, {1}}},
    {"two, 3D", 3, 2, {{0}, {1}}},
    {"three on a line, 2D", 2, 3, {{0}, {1}, {2}}},
    {"three on a line, 3D", 3, 3, {{0}, {1}, {2}}},
    {"three, 2D", 2, 3, {{0}, {1}, {0, 1}}},
    {"three, 3D", 3, 3, {{0}, {1}, {0, 1}}},
    {"four in a plane, 3D", 3, 4, {{0}, {1}, {0, 1}, {1, 1}}},
    {"four, 3D", 3, 4, {{0}, {1}, {0, 1}, {0, 0, 1}}},
    {"two that coincide, 1D", 1, 2, {{0}, {0}}},
    {"two that coincide, 2D", 2, 4, {{0}, {0}, {1}, {0, 1}}},
    {"two that coincide, 3D", 3, 5, {{0}, {0}, {1}, {0, 1}, {0, 0, 1}}},
    {"nearly coincide, 2D", 2, 4, {{0}, {1e-300}, {1}, {0, 1}}},
    {"one far away, 1D", 1, 3, {{0}, {1}, {1e6}}},
    {"one far away, 2D", 2, 4, {{0}, {1}, {0, 1}, {1e6, 1e6}}},
    {"one far away, 3D", 3, 5, {{0}, {1}, {0, 1}, {0, 0, 1}, {1e6}}},
    {"a NaN, 2D", 2, 3, {{0}, {1}, {NAN, 1}}},
};

/* A cloud over the arrays given: no lattice, no faces. */
static struct solver_cloud cloud_of(const struct handful *handful, double *X, double *V, uint32_t *tags)
{
    size_t dim = (size_t)handful->dim;
    for (size_t a = 0; a < handful->count; a++) {
        memcpy(X + a * dim, handful->X[a], dim * sizeof *X);
        V[a] = 1.0;
        tags[a] = 0;
    }
    return (struct solver_cloud){
        .dim = handful->dim, .count = handful->count, .spacing = 1.0, .X = X, .V = V, .tags = tags};
}

static bool numbers(const struct solver_stencil *stencil)
{
    for (size_t i = 0; i < stencil->pairs * (size_t)(stencil->dim + 1); i++) {
        if (!isfinite(stencil->pair[i])) {
            return false;
        }
    }
    return true;
}

static void handfuls_are_right_or_refused(void)
{
    for (size_t i = 0; i < sizeof handfuls / sizeof *handfuls; i++) {
        if (strncmp(handfuls[i].what, "a NaN", 5) == 0) {
            unit_untrapped();
        }
        double X[3 * MOST], V[MOST];
        uint32_t tags[MOST];
        struct solver_cloud cloud = cloud_of(&handfuls[i], X, V, tags);
        for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL;
             builder++) {
            struct solver_stencil *stencil = NULL;
            struct solver_error error = {.code = SOLVER_OK};
            bool built = solver_stencil_create(builder, &cloud, 2.0, &stencil, &error);
            bool good = built ? numbers(stencil) : error.code != SOLVER_OK && error.text[0] != '\0';
            if (good && built && solver_stencil_keeps_constant_stress(builder)) {
                good = solver_stencil_check(stencil, &cloud).linear < 1e-9;
            }
            CU_ASSERT(good);
            if (!good) {
                (void)printf("\n%s, %s: %s\n", builder->name, handfuls[i].what, built ? "no numbers" : error.text);
            }
            solver_stencil_free(stencil);
        }
    }
}

/* Lines of a grid whose spacings grow from 1 to RATIO. */
enum { LINES = 13, RATIO = 10 };

static void graded(int dim, double *X, double *V, uint32_t *tags, size_t *count)
{
    double line[LINES] = {0.0};
    for (int i = 1; i < LINES; i++) {
        line[i] = line[i - 1] + pow(RATIO, (i - 1.0) / (LINES - 2.0));
    }
    *count = 1;
    for (int i = 0; i < dim; i++) {
        *count *= LINES;
    }
    for (size_t a = 0; a < *count; a++) {
        size_t rest = a;
        V[a] = 1.0;
        tags[a] = 0;
        for (int i = 0; i < dim; i++, rest /= LINES) {
            size_t at = rest % LINES;
            X[a * (size_t)dim + (size_t)i] = line[at];
            V[a] *= 0.5 * (line[at + 1 < LINES ? at + 1 : at] - line[at > 0 ? at - 1 : 0]);
        }
    }
}

/* Spacings that differ ten times within one body: with a radius that reaches neighbours at the coarse end linear fields
 * are differentiated there too, but for 3D, where more neighbours are then at the fine end than a particle may have;
 * with a smaller one, and by stencils that close over faces, they are refused. */
static void spacings_that_differ(void)
{
    static double X[LINES * LINES * LINES * 3], V[LINES * LINES * LINES];
    static uint32_t tags[LINES * LINES * LINES];
    static const double radius[] = {1.5, 0.5 * RATIO, 2.0 * RATIO};
    for (int dim = 1; dim <= 3; dim++) {
        size_t count = 0;
        graded(dim, X, V, tags, &count);
        struct solver_cloud cloud = {.dim = dim, .count = count, .spacing = 1.0, .X = X, .V = V, .tags = tags};
        for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL;
             builder++) {
            bool whole = strcmp(builder->name, "sph") == 0;
            for (size_t r = 0; r < sizeof radius / sizeof *radius; r++) {
                struct solver_stencil *stencil = NULL;
                struct solver_error error = {.code = SOLVER_OK};
                bool built = solver_stencil_create(builder, &cloud, radius[r], &stencil, &error);
                CU_ASSERT_EQUAL(built, whole && r == 2 && dim < 3);
                CU_ASSERT(built ? numbers(stencil) && solver_stencil_check(stencil, &cloud).linear < 1e-12
                                : error.code != SOLVER_OK && error.text[0] != '\0');
                CU_ASSERT(!whole || r == 2 || strstr(error.text, "choose a larger support") != NULL);
                solver_stencil_free(stencil);
            }
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"handfuls are right or refused", handfuls_are_right_or_refused},
        {"spacings that differ", spacings_that_differ},
    };
    return unit_main("smallest clouds", tests, sizeof tests / sizeof *tests);
}
