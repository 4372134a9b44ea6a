/* Walls by paths: how far a place is from them and where their normal points, beside closed forms; paths that are
 * refused. */
#include "solver/die.h"
#include "tests/unit/random_tensors.h"
#include "tests/unit/runs.h"

static const double pi = 3.14159265358979323846;

/* A corner at the origin between pieces of 2 m along angles `in` and `out`, turned to the left or to the right. */
static struct solver_die corner(double in, double out, double fillet)
{
    static struct solver_scene scene;
    struct solver_die die;
    struct solver_error error;
    scene.die_count = 1;
    scene.die[0] =
        (struct solver_die_wall){.count = 3,
                                 .point = {{-2.0 * cos(in), -2.0 * sin(in)}, {0}, {2.0 * cos(out), 2.0 * sin(out)}},
                                 .fillet = {0, fillet, 0}};
    CU_ASSERT_FATAL(solver_die_create(&scene, &die, &error));
    return die;
}

/* The distance to the rounded path by points strewn densely along it, signed by the angle's side. */
static double strewn(double in, double out, double r, const double x[2], double *normal)
{
    double turn = out - in, back = r * tan(0.5 * fabs(turn)), side = turn > 0.0 ? 1.0 : -1.0, least = INFINITY;
    double C[2] = {-back * cos(in) - side * r * sin(in), -back * sin(in) + side * r * cos(in)};
    for (int part = 0; part < 3; part++) {
        for (int i = 0; i <= 4000; i++) {
            double s = i / 4000.0, way = back + s * (2.0 - back), angle = in + s * turn - 0.5 * side * pi;
            double along = part == 0 ? in : part == 2 ? out : in + s * turn;
            double p[2] = {part == 0   ? -way * cos(in)
                           : part == 2 ? way * cos(out)
                                       : C[0] + r * cos(angle),
                           part == 0   ? -way * sin(in)
                           : part == 2 ? way * sin(out)
                                       : C[1] + r * sin(angle)};
            double d = hypot(x[0] - p[0], x[1] - p[1]);
            if (d < fabs(least)) {
                double left = -sin(along) * (x[0] - p[0]) + cos(along) * (x[1] - p[1]);
                least = left >= 0.0 ? d : -d;
                normal[0] = -sin(along);
                normal[1] = cos(along);
            }
        }
    }
    return least;
}

/* Places all around a corner, on both sides of the wall. */
static void test_distance(void)
{
    static const double turns[] = {-2.4, -0.5 * 3.14159265358979323846, -0.3, 0.3, 0.5 * 3.14159265358979323846, 2.4};
    for (size_t k = 0; k < sizeof turns / sizeof *turns; k++) {
        double in = uniform(-3.0, 3.0), out = in + turns[k], r = 0.4;
        struct solver_die die = corner(in, out, r);
        CU_ASSERT_EQUAL(die.count, 3);
        for (int i = 0; i < 60; i++) {
            struct solver_die_near near[SOLVER_DIE_NEAR];
            double x[2], normal[2] = {0};
            /* near the wall, so that the nearest place is on this side of the fillet's centre */
            double s = uniform(-1.2, 1.2), off = uniform(-0.2, 0.2), along = s < 0.0 ? in : out;
            x[0] = s * cos(along) - off * sin(along);
            x[1] = s * sin(along) + off * cos(along);
            double expected = strewn(in, out, r, x, normal);
            if (fabs(expected) > 0.2) {
                continue;
            }
            CU_ASSERT_EQUAL_FATAL(solver_die_look(&die, 0, x, near), 1);
            /* points are 5e-4 apart */
            expect_below("distance", fabs(near[0].gap - expected), fmin(3e-4, 3.2e-8 / fabs(expected)));
            expect_below("normal", hypot(near[0].normal[0] - normal[0], near[0].normal[1] - normal[1]), 2e-3);
            expect_below("its length", fabs(hypot(near[0].normal[0], near[0].normal[1]) - 1.0), 1e-14);
        }
        solver_die_free(&die);
    }
}

/* Where pieces meet the distance goes on as it was, and no place is lost between two of them. */
static void test_seams(void)
{
    for (int k = 0; k < 200; k++) {
        double in = uniform(-3.0, 3.0), turn = uniform(0.1, 2.5) * (k % 2 == 0 ? 1.0 : -1.0),
               r = k % 5 == 0 ? 0.0 : 0.3;
        struct solver_die die = corner(in, in + turn, r);
        for (size_t i = 0; i < die.count; i++) {
            const struct solver_die_piece *piece = &die.piece[i];
            if (piece->kind != SOLVER_DIE_STRAIGHT) {
                continue;
            }
            double end = i == 0 ? piece->length : 0.0, off = uniform(0.0, 0.1);
            double seam[2] = {piece->from[0] + end * piece->along[0] - off * piece->along[1],
                              piece->from[1] + end * piece->along[1] + off * piece->along[0]};
            struct solver_die_near near[SOLVER_DIE_NEAR];
            size_t found = solver_die_look(&die, 0, seam, near);
            CU_ASSERT(found >= 1);
            CU_ASSERT(found == 1 || (r == 0.0 && turn > 0.0));
            if (r > 0.0 || turn < 0.0) {
                expect_below("distance at a seam", fabs(near[0].gap - off), 1e-14);
            }
        }
        solver_die_free(&die);
    }
}

/* A sharp corner: round it the distance is that from its point, in it there are two planes. */
static void test_sharp(void)
{
    struct solver_die_near near[SOLVER_DIE_NEAR];
    struct solver_die round = corner(0.5 * pi, 0.0, 0.0); /* up, then to the right: the body is beyond */
    double beyond[2] = {-0.3, 0.4};
    CU_ASSERT_EQUAL(solver_die_look(&round, 0, beyond, near), 1);
    CU_ASSERT_DOUBLE_EQUAL(near[0].gap, 0.5, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(near[0].normal[0], -0.6, 1e-15);
    double on[2] = {0.0, 0.0};
    CU_ASSERT_EQUAL(solver_die_look(&round, 0, on, near), 1);
    CU_ASSERT_DOUBLE_EQUAL(hypot(near[0].normal[0], near[0].normal[1]), 1.0, 1e-15);
    solver_die_free(&round);
    struct solver_die folded = corner(-0.5 * pi, 0.0, 0.0); /* down, then to the right: the body is within */
    double within[2] = {0.2, 0.1};
    CU_ASSERT_EQUAL(folded.count, 2);
    CU_ASSERT_EQUAL(solver_die_look(&folded, 0, within, near), 2);
    CU_ASSERT_DOUBLE_EQUAL(near[0].gap, 0.1, 1e-15);
    CU_ASSERT_DOUBLE_EQUAL(near[1].gap, 0.2, 1e-15);
    CU_ASSERT(near[0].normal[1] == 1.0 && near[1].normal[0] == 1.0);
    double past[2] = {3.0, -0.1};
    CU_ASSERT_EQUAL(solver_die_look(&folded, 0, past, near), 0); /* the wall ends at 2 */
    double above[2] = {3.0, 0.1};
    CU_ASSERT_EQUAL(solver_die_look(&folded, 0, above, near), 1); /* so that there is but the other piece */
    solver_die_free(&folded);
}

#define DIE(wall) "die = { " wall " }\n"
#define HALF      "{ path = { {0, 9}, {0, 0}, {9, 0} }, fillets = { 1 } }"

static void test_refusals(void)
{
    unit_untrapped();
    static const struct {
        const char *die, *expected;
    } bad[] = {
        {"die = 3\n", "die: expected a list of { path"},
        {"die = { }\n", "die: expected a list of { path"},
        {DIE("{ path = { {0, 0} } }"), "die[1].path: expected a list of 2 to 16 places {x, y} [m], got 1 entries"},
        {DIE("{ fillets = { 1 } }"), "die[1].path: expected a list of 2 to 16 places"},
        {DIE("{ path = { {0, 0}, {1} } }"), "die[1].path[2]: expected a list of 2 numbers"},
        {DIE("{ path = { {0, 0}, {1, 0/0} } }"), "die[1].path[2][2]: expected a number, got NaN"},
        {DIE("{ path = { {0, 0}, {1, 1e999} } }"), "die[1].path[2][2]: expected a number, got an infinite number"},
        {DIE("{ path = { {0, 0}, {1, 0} }, radius = 1 }"), "die[1].radius: unknown key; expected path and fillets"},
        {DIE("{ path = { {0, 0}, {1, 0}, {1, 0} } }"), "die[1]: points 2 and 3 are the same"},
        {DIE("{ path = { {0, 0}, {1, 0}, {0.5, 0} } }"), "die[1]: the path turns back at point 2"},
        {DIE("{ path = { {0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, -1} } }"), "die[1]: the path crosses itself"},
        {DIE("{ path = { {0, 0}, {2, 0}, {2, 2}, {1, 0} } }"), "die[1]: the path crosses itself"},
        {DIE("{ path = { {0, 9}, {0, 0}, {9, 0} }, fillets = { 1, 1 } }"), "die[1].fillets: "},
        {DIE("{ path = { {0, 9}, {0, 0}, {9, 0} }, fillets = { } }"),
         "die[1].fillets: expected a list of 1 radii [m], one for each corner, got 0 entries"},
        {DIE("{ path = { {0, 9}, {0, 0}, {9, 0} }, fillets = { -1 } }"), "die[1].fillets[1]: expected number >= 0 [m]"},
        {DIE("{ path = { {0, 9}, {0, 0}, {9, 0} }, fillets = { 9.5 } }"),
         "die[1]: the fillets between points 1 and 2 take 9.5 m of 9 m; expected smaller ones"},
        {DIE("{ path = { {0, 9}, {0, 0}, {3, 0}, {3, -9} }, fillets = { 2, 1.5 } }"),
         "die[1]: the fillets between points 2 and 3 take 3.5 m of 3 m"},
        {DIE(HALF ", { path = { {5, -1}, {5, 1} } }"), "die[2]: the wall crosses or touches die[1]"},
        {DIE(HALF ", { path = { {5, 0}, {5, 1} } }"), "die[2]: the wall crosses or touches die[1]"},
        {DIE(HALF "," HALF "," HALF "," HALF "," HALF), "die: at most 4 entries are possible, got 5"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        expect_refused(bad[i].die, bad[i].expected, "dim=2");
    }
    expect_refused(DIE(HALF), "die: walls by paths are there in the plane; expected dim = 2, got 3", "dim=3");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"distance and normal", test_distance},
        {"where pieces meet", test_seams},
        {"sharp corners", test_sharp},
        {"refusals", test_refusals},
    };
    return unit_main("walls by paths", tests, sizeof tests / sizeof *tests);
}
