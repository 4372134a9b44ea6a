/* The patch test, over the tables: a body under constant stress that moves by x = F(t) X + t c, with loads and faces
 * that belong to it, stays on that motion to round-off, whatever the stretch, shear and turn (stretches from 1/2 to 2).
 * What claims it (scheme.h, stencil.h) is held to it on lattices and perturbed clouds in 1, 2 and 3 dimensions, for
 * every material, evolved set and kind of face; what does not claim it must be seen to fail by the same measure. */
#include "tests/unit/affine_motions.h"

#include "solver/integrator.h"
#include "solver/scheme.h"
#include "solver/stencil.h"

static const char *const evolved_name[] = {"pF", "pFJ", "pFHJ"};
static const double cfl = 0.3;
static const double quarter = 0.25; /* of that time for spacings of which the smallest is a quarter of the mean */
enum { STEPS = 4 };                 /* at rest; a stretched body is stiffer, or softer */

/* What stands in the scene beside motion and faces. */
struct setting {
    const char *scheme, *overrides, *stencil, *material, *integrator;
    size_t dim;
    int n, evolved;
    bool perturbed, graded;
};

/* How the sums of a stencil spread round-off. */
struct spread {
    double sum;      /* kappa: largest h sum_b |C_ab| / 2 V_a */
    double terms;    /* most neighbours of a particle */
    double residual; /* largest h |sum_b C_ab + B_a| / 2 V_a, and of linear exactness */
};

static struct spread measure_spread(const struct setting *setting, struct sample *sample)
{
    struct spread spread = {.residual = 0.0};
    struct solver_stencil *stencil = NULL;
    struct solver_output output = output_of(sample);
    const struct solver_scene *scene = sample->scene;
    CU_ASSERT_FATAL(solver_stencil_create(solver_stencil_find(setting->stencil), output.cloud, scene->support, &stencil,
                                          &sample->error));
    double largest = 0.0, smallest = INFINITY;
    for (size_t a = 0; a < stencil->count; a++) {
        double sum = 0.0;
        for (size_t ab = stencil->graph.row[a]; ab < stencil->graph.row[a + 1]; ab++) {
            double size = largest_entry(setting->dim, solver_stencil_C(stencil, ab));
            sum += size;
            largest = fmax(largest, size);
        }
        smallest = fmin(smallest, stencil->V[a]);
        spread.sum = fmax(spread.sum, 0.5 * sum * stencil->spacing / stencil->V[a]);
        spread.terms = fmax(spread.terms, (double)(stencil->graph.row[a + 1] - stencil->graph.row[a]));
    }
    struct solver_stencil_residuals found = solver_stencil_check(stencil, output.cloud);
    spread.residual = 0.5 * found.closure * largest * stencil->spacing / smallest + found.linear;
    solver_stencil_free(stencil);
    return spread;
}

/* How far round-off may have taken the run, in units of cp, 1 and rho cp^2 (1 + stiffness), epsilon = 2^-53:
 * - a force is a sum of m terms whose magnitudes add up to 2 kappa |P| / h, and a gradient of v and the upwind flux of
 * p the same with |v| in place of |P|: wrong by m epsilon kappa (|P| + |v|) at most, and by the residual of the
 * stencil;
 * - a stress is wrong by what a relative error of 16 epsilon, that many being the operations of a material law, in F, H
 *   and J makes of it: stiffness |F|, the stiffness being the largest sum of |A| over a row of the tangent;
 * - both act over the time t cp / h, with kappa;
 * - where loads press the body this grows like exp(omega t), (omega h)^2 = (2 kappa)^2 times the negative part of the
 *   tangent over rho, 2 kappa / h being the largest gradient of a field of size 1;
 * - every evaluation rounds x, v, F, H and J once more, and they are summed with weights. */
static double round_off(const struct sample *sample, const struct motion *motion, struct spread spread, bool loaded,
                        double *stiffness)
{
    const double epsilon = 0x1p-53;
    double F[9], A[81], P[9], H[9], J, worst = 0.0;
    size_t entries = motion->dim * motion->dim;
    double modulus = motion->constants.rho * motion->constants.cp * motion->constants.cp;
    struct solver_facts facts = solver_run_facts(sample->run);
    int stages = solver_integrator_find(sample->scene->integrator)->stages;
    double paces = sample->scene->t_end * motion->constants.cp / facts.spacing;
    double speed = (largest_entry(entries, motion->rate) + largest_entry(3, motion->drift)) / motion->constants.cp;
    double softness = fmax(0.0, -fmin(affine_firmness(motion, 0.0), affine_firmness(motion, sample->scene->t_end)));
    double growth = loaded ? exp(paces * 2.0 * spread.sum * sqrt(softness)) : 1.0;
    *stiffness = 0.0;
    for (int end = 0; end < 2; end++) {
        double t = end * sample->scene->t_end;
        motion->gradient(motion, t, 0, F);
        measures_of(motion->material->linear, motion->dim, F, H, &J);
        motion->material->tangent(&motion->constants, F, A);
        motion_stress(motion, t, P);
        for (size_t row = 0; row < entries; row++) {
            double sum = 0.0;
            for (size_t column = 0; column < entries; column++) {
                sum += fabs(A[row * entries + column]) / modulus;
            }
            *stiffness = fmax(*stiffness, sum);
        }
        double size = fmax(fmax(1.0, fabs(J)), fmax(largest_entry(entries, F), largest_entry(entries, H)));
        double pull = largest_entry(entries, P) / modulus + speed;
        double sums = spread.sum * epsilon * (spread.terms * pull + 16.0 * *stiffness * size) + spread.residual * pull;
        worst = fmax(worst, growth * (paces * sums + (double)facts.steps * stages * epsilon * (size + speed)));
    }
    return worst;
}

/* Whether the integrator follows the motion exactly: F is linear in t, H of degree 2 and J of degree dim in 3D and 2D.
 * Within a step the stages' J is not that of F, so that tractions of a formula do not fit it. */
static bool follows(const struct affine_case *of, const struct motion *motion, const struct setting *setting)
{
    bool still = of->pace == AFFINE_HELD || of->pace == AFFINE_DRIFTING;
    bool plain = setting->evolved == SOLVER_PF || motion->material->linear;
    int degree = plain ? 1 : (int)motion->dim;
    bool loaded = affine_has(of, motion->dim, "TR");
    return still || plain || (!loaded && solver_integrator_find(setting->integrator)->order >= degree);
}

struct finding {
    bool ran;
    double error, bound; /* of the largest component */
};

/* One body. `spoil` goes into the scene last. A spread of sum 0 becomes that of the cloud. */
static struct finding look(const struct affine_case *of, const struct setting *setting, const char *spoil,
                           struct spread *spread)
{
    struct finding finding = {.ran = false};
    struct motion motion = {.dim = setting->dim,
                            .faces = of->faces,
                            .material = solver_material_find(setting->material)->in[setting->dim - 1],
                            .constants = solver_material_constants(3.0, 0.3, 2.0)};
    double duration = (setting->graded ? quarter : 1.0) * STEPS * cfl / (setting->n * motion.constants.cp);
    affine_make(of, duration, &motion);
    struct sample sample =
        motion_try(&motion,
                   "dim=%zu material.model=%s scheme=%s stencil=%s support=%g perturb=%g evolved=%s integrator=%s n=%d "
                   "cfl=%g t_end=%.17g %s%s %s %s",
                   setting->dim, setting->material, setting->scheme, setting->stencil, setting->dim == 1 ? 3.0 : 2.1,
                   setting->perturbed ? 0.15 : 0.0, evolved_name[setting->evolved], setting->integrator, setting->n,
                   cfl, duration, setting->graded ? "grading.X=10 grading.fine_X=upper" : "",
                   setting->graded && setting->dim > 1 ? " grading.Y=3" : "", setting->overrides, spoil);
    CU_ASSERT_FATAL(sample.run != NULL || strstr(sample.error.text, "choose a larger n") != NULL);
    if (sample.run != NULL) {
        finding.ran = true;
        advance_to(&sample, duration);
        struct motion_errors errors = motion_judge(&sample, &motion);
        double stiffness;
        *spread = spread->sum > 0.0 ? *spread : measure_spread(setting, &sample);
        finding.bound = round_off(&sample, &motion, *spread, affine_has(of, setting->dim, "TFR"), &stiffness);
        errors.P /= 1.0 + stiffness;
        finding.error = motion_worse(&errors);
    }
    finish(&sample);
    return finding;
}

/* The next integrator of the table; those that do not follow the motion are passed over. */
static const char *next_integrator(size_t *turn, const struct affine_case *of, struct setting *setting)
{
    struct motion motion = {.dim = setting->dim,
                            .material = solver_material_find(setting->material)->in[setting->dim - 1]};
    size_t count = 0;
    while (solver_integrators()[count].name != NULL) {
        count++;
    }
    for (size_t tries = 0; tries < count; tries++) {
        setting->integrator = solver_integrators()[(*turn)++ % count].name;
        if (follows(of, &motion, setting)) {
            return setting->integrator;
        }
    }
    return NULL;
}

struct tally {
    struct spread spread; /* of the present cloud */
    size_t runs, turn;
    double error, nearest; /* largest error, and largest share of the bound */
};

static void hold_to_it(const struct affine_case *of, struct setting setting, struct tally *tally)
{
    setting.integrator = next_integrator(&tally->turn, of, &setting);
    if (setting.integrator == NULL) { /* loads do not fit an evolved J on the way */
        setting.evolved = SOLVER_PF;
        setting.integrator = next_integrator(&tally->turn, of, &setting);
    }
    struct finding found = look(of, &setting, "", &tally->spread);
    if (!found.ran) {
        return; /* too few particles for this stencil */
    }
    bool holds = found.error <= found.bound && found.bound < 1e-10;
    if (!holds) {
        printf("\n    %s, %s, %s, %s, %s, %zuD, n = %d%s: %s: off by %.2e, round-off %.2e", setting.scheme,
               setting.stencil, setting.material, evolved_name[setting.evolved], setting.integrator, setting.dim,
               setting.n,
               setting.perturbed ? ", perturbed"
               : setting.graded  ? ", graded"
                                 : "",
               of->name, found.error, found.bound);
    }
    CU_ASSERT(holds);
    tally->runs++;
    keep_larger(&tally->error, found.error);
    keep_larger(&tally->nearest, found.error / found.bound);
}

/* Every case with every material on one kind of cloud; over three materials a case meets each evolved set. */
static void every_case(struct setting setting, struct tally *tally)
{
    const struct solver_material_model *models = solver_material_models();
    tally->spread = (struct spread){.sum = 0.0};
    for (size_t m = 0; models[m].name != NULL; m++) {
        for (size_t i = 0; i < AFFINE_CASES; i++) {
            setting.material = models[m].name;
            setting.evolved = (int)((m + i) % 3);
            hold_to_it(&affine_cases[i], setting, tally);
        }
        tally->turn++; /* so that a case meets every integrator, whatever the length of both tables */
    }
}

/* Stencils for lattices on short lines and on long ones, which may have other closures; others, which take long to
 * make, on few particles, once regular and once not. */
static void every_cloud(const struct solver_stencil_builder *builder, const struct solver_scheme *scheme, size_t dim)
{
    struct tally tally = {.runs = 0};
    struct setting setting = {
        .scheme = scheme->name, .overrides = scheme->claims.affine, .stencil = builder->name, .dim = dim};
    for (int n = 4; n <= 11 && builder->lattice_only; n += n == 4 ? 3 : 4) {
        setting.n = n;
        every_case(setting, &tally);
    }
    if (builder->lattice_only) {
        struct setting graded = setting;
        graded.n = 7;
        graded.graded = true;
        every_case(graded, &tally);
    }
    for (int perturbed = 0; perturbed < 2 && !builder->lattice_only; perturbed++) {
        setting.n = dim == 3 ? 4 : 6;
        setting.perturbed = perturbed != 0;
        every_case(setting, &tally);
    }
    printf("\n    %s, %-7s %zuD: %3zu bodies, off by %.1e at most, %.2f of the round-off allowed", scheme->name,
           builder->name, dim, tally.runs, tally.error, tally.nearest);
    CU_ASSERT(tally.runs >= 6 * AFFINE_CASES);
}

static void claimed(size_t dim)
{
    size_t claims = 0;
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        const struct solver_stencil_builder *builder = solver_stencil_builders();
        for (; (*scheme)->claims.affine != NULL && builder->name != NULL; builder++) {
            if (solver_stencil_keeps_constant_stress(builder)) {
                every_cloud(builder, *scheme, dim);
                claims++;
            }
        }
    }
    CU_ASSERT(claims >= 3);
}

static void test_claimed_1d(void)
{
    claimed(1);
}

static void test_claimed_2d(void)
{
    claimed(2);
}

static void test_claimed_3d(void)
{
    claimed(3);
}

/* Least error over the dimensions, of a body at small strain under its tractions. */
static double least_error(struct setting setting)
{
    double least = INFINITY;
    for (setting.dim = 1; setting.dim <= 3; setting.dim++) {
        struct motion motion = {.dim = setting.dim,
                                .faces = "TTTTTT",
                                .material = solver_material_find(setting.material)->in[setting.dim - 1],
                                .gradient = affine_gradient};
        unit_tensor(setting.dim, motion.start);
        for (size_t k = 0; k < setting.dim * setting.dim; k++) {
            motion.start[k] += 0.01 * (double)(1 + k % 3);
        }
        struct sample sample = motion_try(&motion, "dim=%zu material.model=%s scheme=%s stencil=%s support=2.1 n=8",
                                          setting.dim, setting.material, setting.scheme, setting.stencil);
        CU_ASSERT_PTR_NOT_NULL_FATAL(sample.run);
        advance(&sample, STEPS);
        struct motion_errors errors = motion_judge(&sample, &motion);
        least = fmin(least, motion_worse(&errors));
        finish(&sample);
    }
    return least;
}

/* What does not claim it is not on the motion, by a part of the strain that is far from round-off. */
static void test_not_claimed(void)
{
    size_t found = 0;
    struct setting setting = {.material = "linear-elastic", .scheme = "upwind"};
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        if (!solver_stencil_keeps_constant_stress(builder)) {
            setting.stencil = builder->name;
            double error = least_error(setting);
            printf("\n    stencil %s: off by %.1e at least, of a strain of 0.01 to 0.03", builder->name, error);
            CU_ASSERT(error > 1e-5);
            found++;
        }
    }
    setting.stencil = "sbp2";
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        if ((*scheme)->claims.affine == NULL) {
            setting.scheme = (*scheme)->name;
            double error = least_error(setting);
            printf("\n    scheme %s: off by %.1e at least, of a strain of 0.01 to 0.03", (*scheme)->name, error);
            CU_ASSERT(error > 1e-5);
            found++;
        }
    }
    CU_ASSERT(found >= 2);
}

/* The measure is as sharp as the claim: a millionth of the stress, and an integrator of too low an order, are seen. */
static void test_sharp(void)
{
    struct setting setting = {.scheme = "upwind",
                              .overrides = "",
                              .stencil = "sbp2",
                              .material = "neo-hookean",
                              .integrator = "rk4",
                              .dim = 3,
                              .n = 4,
                              .evolved = SOLVER_PFHJ};
    struct spread spread = {.sum = 0.0};
    struct finding right = look(&affine_cases[0], &setting, "", &spread);
    CU_ASSERT(right.ran && right.error <= right.bound);
    for (size_t i = 0; i < AFFINE_CASES; i++) {
        bool held = affine_cases[i].pace == AFFINE_HELD;
        struct finding wrong = held ? look(&affine_cases[i], &setting, "material.nu=0.300001", &spread) : right;
        CU_ASSERT(!held || (wrong.ran && wrong.error > 100.0 * wrong.bound));
    }
    for (size_t dim = 1; dim <= 3; dim++) {
        spread.sum = 0.0;
        for (const struct solver_integrator *method = solver_integrators(); method->name != NULL; method++) {
            setting.dim = dim;
            setting.integrator = method->name;
            struct finding found = look(&affine_cases[3], &setting, "", &spread);
            bool enough = method->order >= (int)dim;
            CU_ASSERT(found.ran && (enough ? found.error <= found.bound : found.error > 1e6 * found.bound));
        }
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"what claims affine motions keeps them, 1D", test_claimed_1d},
        {"what claims affine motions keeps them, 2D", test_claimed_2d},
        {"what claims affine motions keeps them, 3D", test_claimed_3d},
        {"what does not claim them is found out", test_not_claimed},
        {"a small mistake is seen", test_sharp},
    };
    return unit_main("affine motions", tests, sizeof tests / sizeof *tests);
}
