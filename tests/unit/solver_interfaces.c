/* Planes of a lattice where materials meet: which are found, and what the stencil along lines is then. */
#include "solver/interfaces.h"
#include "solver/run_internal.h"
#include "solver/scheme_upwind.h"
#include "tests/unit/ulsph_states.h"

/* A composite body whose modulus is what `formula` says of X and Y. */
static struct sample body(const char *formula, const char *settings)
{
    char text[1024];
    CU_ASSERT_FATAL(snprintf(text, sizeof text,
                             "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
                             "    at = function(X, Y) Y = Y or 0 return %s, 0.3, 2 end }\n",
                             formula) < (int)sizeof text);
    return start(text, "stencil=sbp4 %s", settings);
}

/* Planes found, over all axes; the place of the last along its axis. */
static size_t planes(const struct sample *sample, size_t *place)
{
    const struct solver_cloud *cloud = sample->run->cloud;
    size_t found = 0;
    size_t from = 0;
    CU_ASSERT_PTR_NOT_NULL_FATAL(cloud->interface);
    for (int axis = 0; axis < cloud->dim; axis++) {
        for (size_t i = 0; i < cloud->points[axis]; i++) {
            if (cloud->interface[from + i] != 0) {
                found++;
                *place = i;
            }
        }
        from += cloud->points[axis];
    }
    return found;
}

#define HALF "X < 0.49 and 3 or X > 0.51 and 40 or 5"

static void test_found(void)
{
    static const struct {
        const char *formula, *settings;
        size_t planes, place;
    } rows[] = {
        {HALF, "dim=1 n=16", 1, 8},
        {HALF, "dim=2 n=16", 1, 8},
        {HALF, "dim=3 n=14", 1, 7},
        {"Y < 0.49 and 3 or Y > 0.51 and 40 or 5", "dim=2 n=16", 1, 8},
        {"X < 0.49 and 3 or 40", "dim=2 n=16", 0, 0},        /* between particles */
        {"3 + X", "dim=2 n=16", 0, 0},                       /* everywhere */
        {"Y < 0.5 and 3 or (" HALF ")", "dim=2 n=16", 0, 0}, /* a part of the lattice */
        {HALF, "dim=1 n=12", 0, 0},                          /* as near to the faces as that */
        {"X < 0.32 and 3 or X < 0.34 and 4 or X < 0.49 and 5 or X < 0.51 and 6 or 7", "dim=1 n=24", 1, 8},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct sample sample = body(rows[i].formula, rows[i].settings);
        size_t place = 0;
        CU_ASSERT_EQUAL(planes(&sample, &place), rows[i].planes);
        CU_ASSERT_EQUAL(place, rows[i].place);
        finish(&sample);
    }
}

/* Lines end at the plane, no pair joins the two sides, and the stencil is exact for constant and linear fields. */
static void test_stencil_ends(void)
{
    static const char *const settings[] = {"dim=1 n=16", "dim=2 n=16", "dim=3 n=14", "dim=1 n=40"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample sample = body(HALF, settings[i]);
        const struct solver_upwind_system *system = sample.run->system;
        const struct solver_graph *graph = &system->stencil->graph;
        const double *X = sample.run->cloud->X;
        size_t dim = (size_t)sample.run->cloud->dim;
        size_t across = 0;
        for (size_t a = 0; a < graph->count; a++) {
            for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
                across += X[a * dim] < 0.499 && X[graph->neighbour[ab] * dim] > 0.501;
            }
        }
        CU_ASSERT_EQUAL(across, 0);
        CU_ASSERT(system->residuals.closure < 1e-13);
        CU_ASSERT(system->residuals.linear < 1e-13);
        finish(&sample);
    }
}

/* Nor do kernels reach across: however the stiff side moves, the soft one is not strained, but by the plane itself. */
static void test_kernels_end(void)
{
    static const char *const settings[] = {"dim=1 n=16", "dim=2 n=16", "dim=3 n=14"};
    static const char halves[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2,\n"
                                 "    at = function(X) return " HALF ", 0.3, 2 end }\n"
                                 "scheme, support = 'ulsph', 2.4\n";
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        struct sample sample = start(halves, "ulsph.xsph=0 %s", settings[i]);
        const double *X = sample.run->cloud->X;
        size_t dim = ulsph_dim(&sample);
        struct ulsph_field v = ulsph_field(&sample, "v");
        struct ulsph_field rho = ulsph_field(&sample, "rho");
        double strained[3] = {0}; /* the soft side, the plane, the stiff side */
        ulsph_move_randomly(&sample, 1.0);
        for (size_t a = 0; a < sample.run->cloud->count; a++) {
            for (size_t k = 0; k < v.width && X[a * dim] < 0.51; k++) {
                v.value[a * v.width + k] = 0.0;
            }
        }
        ulsph_evaluate(&sample);
        for (size_t a = 0; a < sample.run->cloud->count; a++) {
            size_t where = X[a * dim] < 0.49 ? 0 : X[a * dim] < 0.51 ? 1 : 2;
            strained[where] = fmax(strained[where], fabs(rho.rate[a]));
        }
        CU_ASSERT_EQUAL(strained[0], 0.0);
        CU_ASSERT(strained[1] > 1.0 && strained[2] > 1.0);
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"planes of particles that stand for both sides are found", test_found},
        {"stencils along lines end there", test_stencil_ends},
        {"kernels end there", test_kernels_end},
    };
    return unit_main("interfaces", tests, sizeof tests / sizeof *tests);
}
