/* Slopes on graded lattices: the dissipation with them is a form of the velocity that is symmetric and never negative,
 * and takes nothing from a linear field. */
#include "solver/stencil.h"
#include "tests/unit/clouds.h"
#include "tests/unit/unit.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

struct lattice {
    const char *stencil;
    int dim, edge;
    double ratio;
    int fine;
};

static const struct lattice lattices[] = {
    {"sbp4", 1, 24, 10, SOLVER_FINE_LOWER},  {"sbp4", 1, 24, 10, SOLVER_FINE_BOTH},
    {"sbp4", 1, 24, 10, SOLVER_FINE_MIDDLE}, {"sbp4", 1, 11, 10, SOLVER_FINE_UPPER},
    {"sbp4", 1, 17, 40, SOLVER_FINE_BOTH},   {"sbp4", 1, 8, 3, SOLVER_FINE_LOWER},
    {"sbp2", 1, 24, 10, SOLVER_FINE_LOWER},  {"sbp2", 1, 12, 100, SOLVER_FINE_UPPER},
    {"sbp2", 1, 1, 1, SOLVER_FINE_LOWER},    {"sbp2", 1, 2, 3, SOLVER_FINE_LOWER},
    {"sbp2", 1, 3, 3, SOLVER_FINE_LOWER},    {"sbp4", 2, 12, 4, SOLVER_FINE_BOTH},
    {"sbp2", 2, 9, 10, SOLVER_FINE_LOWER},
};
enum { LATTICES = sizeof lattices / sizeof *lattices };

struct made {
    struct solver_cloud *cloud;
    struct solver_stencil *stencil;
};

static struct made make(const struct lattice *lattice)
{
    struct solver_box box = clouds_box(lattice->dim, lattice->edge, 0.0, 0);
    struct made made;
    struct solver_error error = {.text = ""};
    for (int axis = 0; axis < lattice->dim; axis++) {
        box.grading[axis] = (struct solver_grading){.ratio = lattice->ratio, .fine = lattice->fine};
    }
    made.cloud = clouds_make(&box);
    CU_ASSERT_PTR_NOT_NULL_FATAL(made.cloud);
    CU_ASSERT_FATAL(
        solver_stencil_create(solver_stencil_find(lattice->stencil), made.cloud, 2.0, &made.stencil, &error) &&
        solver_stencil_add_graded_slopes(made.stencil, made.cloud, NULL, &error));
    return made;
}

/* The share of particle i's value in the slope of particle a along an axis, per step of the lattice. */
static double share(const struct made *made, size_t a, size_t i, size_t axis)
{
    const struct solver_stencil *stencil = made->stencil;
    size_t dim = (size_t)stencil->dim;
    double found = 0.0;
    for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
        double weight = stencil->least_squares[ab * dim + axis] * made->cloud->spacing;
        found += stencil->graph.neighbour[ab] == i ? weight : a == i ? -weight : 0.0;
    }
    return found;
}

/* form[i][j], [count][count]: half of sum A [v] (v_b - v_a) over pairs is v_i form_ij v_j. */
static void find_form(const struct made *made, double *form)
{
    const struct solver_stencil *stencil = made->stencil;
    size_t count = stencil->count;
    size_t dim = (size_t)stencil->dim;
    for (size_t a = 0; a < count; a++) {
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            size_t b = stencil->graph.neighbour[ab];
            double A = solver_stencil_C(stencil, ab)[dim];
            for (size_t axis = 0; axis < dim && A > 0.0; axis++) {
                double d = (double)made->cloud->site[b * dim + axis] - (double)made->cloud->site[a * dim + axis];
                for (size_t j = 0; j < count && d != 0.0; j++) {
                    double jump = (j == b ? 1.0 : 0.0) - (j == a ? 1.0 : 0.0) -
                                  0.5 * d * (share(made, a, j, axis) + share(made, b, j, axis));
                    form[b * count + j] += 0.5 * A * jump;
                    form[a * count + j] -= 0.5 * A * jump;
                }
            }
        }
    }
}

static void expect_within(const struct lattice *lattice, const char *what, double value, double bound)
{
    if (!(value <= bound)) {
        printf("\n    %s of %d, %gx, fine %d, %dD: %s %.3e > %.1e", lattice->stencil, lattice->edge, lattice->ratio,
               lattice->fine, lattice->dim, what, value, bound);
    }
    CU_ASSERT(value <= bound);
}

/* Entries are sums of a dozen numbers of the size of the largest. */
static void check_form(const struct lattice *lattice)
{
    struct made made = make(lattice);
    size_t count = made.stencil->count;
    double *form = calloc(count * count, sizeof *form);
    CU_ASSERT_PTR_NOT_NULL_FATAL(form);
    find_form(&made, form);
    double largest = 0.0;
    double skew = 0.0;
    double linear = 0.0;
    for (size_t i = 0; i < count; i++) {
        double of_linear = 0.0;
        for (size_t j = 0; j < count; j++) {
            largest = fmax(largest, fabs(form[i * count + j]));
            skew = fmax(skew, fabs(form[i * count + j] - form[j * count + i]));
            of_linear += form[i * count + j] * made.cloud->X[j * (size_t)made.stencil->dim];
        }
        linear = fmax(linear, fabs(of_linear));
    }
    gsl_matrix_view view = gsl_matrix_view_array(form, count, count);
    gsl_vector *value = gsl_vector_alloc(count);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(count);
    CU_ASSERT_FATAL(gsl_eigen_symm(&view.matrix, value, work) == 0);
    CU_ASSERT(largest > 0.0 || lattice->edge == 1); /* between two points no field is not linear */
    expect_within(lattice, "asymmetry", skew, 1e-13 * largest + 1e-15);
    expect_within(lattice, "least eigenvalue below 0 by", -gsl_vector_min(value), 1e-13 * largest + 1e-15);
    expect_within(lattice, "of a linear field", linear, 1e-12 * largest + 1e-15);
    gsl_eigen_symm_free(work);
    gsl_vector_free(value);
    free(form);
    solver_stencil_free(made.stencil);
    solver_cloud_free(made.cloud);
}

static void test_forms(void)
{
    for (size_t i = 0; i < LATTICES; i++) {
        check_form(&lattices[i]);
    }
}

/* Inside an even line slopes are (3/4, -1/8) of differences across one and two steps. */
static void test_even_line(void)
{
    static const struct lattice even = {"sbp4", 1, 24, 1.0 + 1e-9, SOLVER_FINE_LOWER};
    static const double expected[5] = {0.125, -0.75, 0.0, 0.75, -0.125};
    struct made made = make(&even);
    for (size_t k = 0; k < 5; k++) {
        CU_ASSERT_DOUBLE_EQUAL(share(&made, 12, 10 + k, 0), expected[k], 1e-7);
    }
    solver_stencil_free(made.stencil);
    solver_cloud_free(made.cloud);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"what the dissipation takes", test_forms},
        {"an even line", test_even_line},
    };
    return unit_main("slopes of graded lattices", tests, sizeof tests / sizeof *tests);
}
