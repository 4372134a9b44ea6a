/* Gates: what passes, what fails, and which rule holds. */
#include "tests/unit/unit.h"
#include "verify/gates.h"

#include <math.h>
#include <string.h>

static void operators(void)
{
    CU_ASSERT_TRUE(verify_gate_judge(0.9, "<=", 1));
    CU_ASSERT_TRUE(verify_gate_judge(1, "<=", 1));
    CU_ASSERT_FALSE(verify_gate_judge(nextafter(1, 2), "<=", 1));
    CU_ASSERT_TRUE(verify_gate_judge(1.1, ">=", 1));
    CU_ASSERT_TRUE(verify_gate_judge(1, ">=", 1));
    CU_ASSERT_FALSE(verify_gate_judge(nextafter(1, 0), ">=", 1));
    CU_ASSERT_FALSE(verify_gate_judge(1, "==", 1)); /* no such operator: nothing passes */
}

static void never_passes(void)
{
    static const double none[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < 3; i++) {
        CU_ASSERT_FALSE(verify_gate_judge(none[i], "<=", 1));
        CU_ASSERT_FALSE(verify_gate_judge(none[i], ">=", 1));
        CU_ASSERT_FALSE(verify_gate_judge(1, "<=", none[i]));
        CU_ASSERT_FALSE(verify_gate_judge(1, ">=", none[i]));
    }
}

static void says_why(void)
{
    CU_ASSERT_STRING_EQUAL(verify_why_no_error(1e-3), "");
    CU_ASSERT_PTR_NOT_NULL(strstr(verify_why_no_error(NAN), "no number, or the exact one is 0"));
    CU_ASSERT_PTR_NOT_NULL(strstr(verify_why_no_error(INFINITY), "beyond all numbers"));
    CU_ASSERT_STRING_EQUAL(verify_why_no_order(1.9, 1e-3, true), "");
    CU_ASSERT_PTR_NOT_NULL(strstr(verify_why_no_order(NAN, 1e-3, false), "one level has no order"));
    CU_ASSERT_PTR_NOT_NULL(strstr(verify_why_no_order(NAN, NAN, true), "it would be of is no number"));
    CU_ASSERT_PTR_NOT_NULL(strstr(verify_why_no_order(INFINITY, 0, true), "of a level is 0"));
}

static struct solver_scene *scene;
static struct verify_gates gates;
static struct solver_error why;
static struct verify_level level;

/* A scene of stencil closed and CFL 0.3 with three rules: closed, sbp2, and one without conditions. */
static void prepare(void)
{
    static const char *const override[] = {"stencil=closed", "cfl=0.3"};
    solver_scene_free(scene);
    CU_ASSERT_TRUE_FATAL(
        solver_scene_load(TEST_SOURCE_DIR "/verify/scenes/swinging-cube.lua", override, 2, &scene, &why));
    scene->gate_count = 3;
    scene->gate[0] = (struct solver_gate_rule){.conditions = 2,
                                               .key = {"stencil", "cfl"},
                                               .text = {"closed", "0.30"},
                                               .bounds = 2,
                                               .bound = {{"p", 1e-3}, {"rate p", 1.9}}};
    scene->gate[1] = (struct solver_gate_rule){
        .conditions = 1, .key = {"stencil"}, .text = {"sbp2"}, .bounds = 1, .bound = {{"p", 1e-9}}};
    scene->gate[2] = (struct solver_gate_rule){.bounds = 1, .bound = {{"P_abs", 7}}};
    for (size_t i = 0; i < VERIFY_ERRORS; i++) {
        level.error[i] = 5e-4;
        level.rate[i] = 2;
    }
}

static bool judge(void)
{
    return verify_gates_judge(scene, &level, &gates, &why);
}

static void the_rule_that_holds(void)
{
    prepare();
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_EQUAL_FATAL(gates.count, 2);
    CU_ASSERT_FALSE(gates.general);
    CU_ASSERT_TRUE(gates.pass);
    CU_ASSERT_STRING_EQUAL(gates.gate[0].name, "p");
    CU_ASSERT_STRING_EQUAL(gates.gate[0].op, "<=");
    CU_ASSERT_STRING_EQUAL(gates.gate[1].name, "rate p");
    CU_ASSERT_STRING_EQUAL(gates.gate[1].op, ">=");
    CU_ASSERT(gates.gate[0].value == 5e-4 && gates.gate[0].bound == 1e-3 && gates.gate[1].value == 2);
}

static void one_bound_decides(void)
{
    prepare();
    level.error[verify_error_find("p")] = 2e-3;
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_FALSE(gates.pass);
    CU_ASSERT_FALSE(gates.gate[0].pass);
    CU_ASSERT_TRUE(gates.gate[1].pass);
    prepare();
    level.rate[verify_error_find("p")] = 1.8;
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_FALSE(gates.pass);
    CU_ASSERT_FALSE(gates.gate[1].pass);
    prepare();
    level.rate[verify_error_find("p")] = NAN; /* one level only */
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_FALSE(gates.pass);
    prepare();
    level.error[verify_error_find("P")] = 1; /* nobody asked for this one */
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_TRUE(gates.pass);
}

static void without_conditions(void)
{
    prepare();
    strcpy(scene->stencil, "sph");
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_EQUAL_FATAL(gates.count, 1);
    CU_ASSERT_STRING_EQUAL(gates.gate[0].name, "P_abs");
    CU_ASSERT_STRING_EQUAL(gates.gate[0].unit, "Pa");
    CU_ASSERT_TRUE(gates.pass);
    CU_ASSERT_TRUE(gates.general);   /* and the verdict says that this is all */
    scene->gate[0] = scene->gate[2]; /* nothing is asked of other configurations either */
    scene->gate_count = 1;
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_FALSE(gates.general);
}

static void all_conditions_count(void)
{
    prepare();
    scene->cfl = 0.4; /* the stencil is right, the CFL number is not */
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_EQUAL_FATAL(gates.count, 1);
    CU_ASSERT_STRING_EQUAL(gates.gate[0].name, "P_abs");
}

/* Errors of figures and their orders, by name. */
static void figures(void)
{
    prepare();
    scene->figure_count = 2;
    strcpy(scene->figure[0].name, "period");
    strcpy(scene->figure[1].name, "contact time");
    level.figure[1] = (struct verify_figure){.error = 3e-4, .rate = 1.5, .why = ""};
    scene->gate[0].bounds = 2;
    scene->gate[0].bound[0] = (struct solver_named){"figure contact time", 1e-3};
    scene->gate[0].bound[1] = (struct solver_named){"rate figure contact time", 1.6};
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_EQUAL_FATAL(gates.count, 2);
    CU_ASSERT(gates.gate[0].value == 3e-4 && strcmp(gates.gate[0].op, "<=") == 0 && gates.gate[0].pass);
    CU_ASSERT(gates.gate[1].value == 1.5 && strcmp(gates.gate[1].op, ">=") == 0 && !gates.gate[1].pass);
    strcpy(scene->gate[0].bound[0].name, "figure contact");
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_EQUAL(why.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "\"figure contact\""));
}

/* Each indicator has the side that is good of its own, and no order. */
static void indicators(void)
{
    prepare();
    scene->gate[0].bounds = 2;
    scene->gate[0].bound[0] = (struct solver_named){"indicator checkerboard", 0.1};
    scene->gate[0].bound[1] = (struct solver_named){"indicator clumping", 0.7};
    level.indicator[VERIFY_CHECKERBOARD] = 0.05;
    level.indicator[VERIFY_CLUMPING] = 0.6;
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_EQUAL_FATAL(gates.count, 2);
    CU_ASSERT(gates.gate[0].pass && strcmp(gates.gate[0].op, "<=") == 0);
    CU_ASSERT(!gates.gate[1].pass && strcmp(gates.gate[1].op, ">=") == 0);
    level.indicator[VERIFY_CHECKERBOARD] = NAN;
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_FALSE(gates.gate[0].pass);
    strcpy(scene->gate[0].bound[0].name, "rate indicator checkerboard");
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "\"rate indicator checkerboard\""));
    strcpy(scene->gate[0].bound[0].name, "indicator checkers");
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "\"indicator checkers\": there are the indicators clumping"));
}

static void no_rule(void)
{
    prepare();
    scene->gate_count = 2;
    strcpy(scene->stencil, "sph");
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT_EQUAL(gates.count, 0);
    CU_ASSERT_FALSE(gates.pass); /* nothing was judged, so nothing passed */
}

/* A scheme without P: a rule for others may name it, one that holds may not. */
static void fields_that_a_scheme_has_not(void)
{
    prepare();
    strcpy(scene->scheme, "ulsph");
    strcpy(scene->gate[1].bound[0].name, "rate P");
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT(gates.count == 2 && gates.pass);
    strcpy(scene->gate[0].bound[1].name, "rate sigma");
    CU_ASSERT_TRUE_FATAL(judge());
    CU_ASSERT(gates.count == 2 && gates.pass);
    strcpy(scene->gate[0].bound[1].name, "rate P");
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_EQUAL(why.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "gates[1]: \"rate P\" needs the scene's key scheme set to one that knows"));
    prepare();
    strcpy(scene->scheme, "ulsph");
    strcpy(scene->stencil, "sph"); /* now the rule without conditions holds, and bounds P_abs */
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "gates[3]: \"P_abs\" needs"));
}

static void wrong_rules(void)
{
    prepare();
    strcpy(scene->gate[1].key[0], "stencl");
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_EQUAL(why.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "gates[2].when.stencl"));
    prepare();
    strcpy(scene->gate[1].bound[0].name, "rate q"); /* also where the rule does not hold */
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "\"rate q\""));
    prepare();
    strcpy(scene->gate[1].bound[0].name, "rate snapshots_p"); /* the scene takes none */
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_EQUAL(why.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "needs the scene's key snapshots"));
    prepare();
    scene->beside.count = 1;
    strcpy(scene->gate[1].bound[0].name, "beside");
    CU_ASSERT_TRUE(judge());
    strcpy(scene->gate[1].bound[0].name, "rate beside");
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "has no order"));
    prepare();
    scene->oracle[0] = '\0'; /* errors are of what no longer is there */
    CU_ASSERT_FALSE(judge());
    CU_ASSERT_PTR_NOT_NULL(strstr(why.text, "needs the scene's key oracle"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"both operators, both directions", operators},
        {"what is no number never passes", never_passes},
        {"and says why", says_why},
        {"the rule that holds", the_rule_that_holds},
        {"one bound decides", one_bound_decides},
        {"a rule without conditions", without_conditions},
        {"all conditions count", all_conditions_count},
        {"figures", figures},
        {"indicators", indicators},
        {"no rule", no_rule},
        {"fields that a scheme has not", fields_that_a_scheme_has_not},
        {"wrong rules", wrong_rules},
    };
    int code = unit_main("gates", tests, sizeof tests / sizeof *tests);
    solver_scene_free(scene);
    return code;
}
