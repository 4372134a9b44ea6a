/* What every scheme of the table promises, whatever it is made of. */
#include "solver/scheme.h"
#include "tests/unit/runs.h"

static const char hooke[] = "material = { model = 'linear-elastic', E = 3, nu = 0.3, rho = 2 }\n";

/* A run of one scheme; `more` stands after the material. */
static struct sample of_scheme(const struct solver_scheme *scheme, size_t dim, const char *more)
{
    char text[1024];
    (void)snprintf(text, sizeof text, "%s%s", hooke, more);
    return start(text, "dim=%zu n=5 scheme=%s", dim, scheme->name);
}

static void test_table(void)
{
    size_t count = 0;
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        const struct solver_scheme *scheme = *entry;
        CU_ASSERT_PTR_EQUAL(solver_scheme_find(scheme->name), scheme);
        CU_ASSERT(scheme->summary != NULL && scheme->advice != NULL);
        CU_ASSERT(scheme->create != NULL && scheme->destroy != NULL && scheme->geometry != NULL);
        CU_ASSERT(scheme->fields != NULL && scheme->start != NULL &&
                  (scheme->evaluate != NULL ||
                   (scheme->gradients != NULL && scheme->rates != NULL && scheme->graph != NULL)));
        CU_ASSERT(scheme->refresh != NULL && scheme->fastest != NULL && scheme->largest_step != NULL &&
                  scheme->first_broken != NULL);
        CU_ASSERT(scheme->complaint != NULL && scheme->look != NULL && scheme->energy != NULL);
        count++;
    }
    CU_ASSERT(count >= 2);
    CU_ASSERT_PTR_NULL(solver_scheme_find("upwin"));
    CU_ASSERT_PTR_NULL(solver_scheme_find(""));
}

static void check_fields(const struct solver_field *table, size_t rows, size_t lanes)
{
    CU_ASSERT_FATAL(rows >= 2 && rows <= SOLVER_STATE_FIELDS);
    CU_ASSERT(strcmp(table[0].name, "v") == 0 && table[0].evolved && table[0].width == lanes);
    CU_ASSERT(strcmp(table[1].name, "x") == 0 && table[1].evolved && table[1].width == lanes);
    for (size_t i = 0; i < rows; i++) {
        CU_ASSERT_PTR_NOT_NULL(table[i].value);
        CU_ASSERT(table[i].rate == NULL ? !table[i].evolved || i == 1 : table[i].evolved);
        for (size_t j = 0; j < i; j++) {
            CU_ASSERT(strcmp(table[i].name, table[j].name) != 0 && table[i].value != table[j].value);
        }
    }
}

/* v and x stand first; every field has a name and an address of its own; evolved ones, and no others, have a rate,
 * unless that of x is v. */
static void test_fields(void)
{
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            struct sample sample = of_scheme(*entry, dim, "");
            struct solver_material_constants constants = solver_material_constants(3, 0.3, 2);
            struct solver_body body = {
                .scene = sample.scene, .cloud = output_of(&sample).cloud, .constants = &constants};
            struct solver_field table[SOLVER_STATE_FIELDS];
            void *system = NULL;
            CU_ASSERT_FATAL((*entry)->create(&body, &system, &sample.error));
            check_fields(table, (*entry)->fields(system, table), solver_state_lanes((int)dim));
            (*entry)->destroy(system);
            finish(&sample);
        }
    }
}

/* What the flags of a scheme say is what its runs show. */
static void test_flags(void)
{
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            struct sample sample = of_scheme(*entry, dim, "");
            struct solver_output output = output_of(&sample);
            struct solver_facts facts = solver_run_facts(sample.run);
            bool deformation = (*entry)->deformation;
            double volume = 0.0;
            for (size_t a = 0; a < output.cloud->count; a++) {
                volume += output.V[a];
                CU_ASSERT_DOUBLE_EQUAL(output.J[a], 1.0, 1e-14);
            }
            CU_ASSERT_DOUBLE_EQUAL(volume, 1.0, 1e-13);
            CU_ASSERT((output.F != NULL) == deformation && (output.H != NULL) == deformation);
            CU_ASSERT((output.P != NULL) == deformation && (output.P_normal != NULL) == (deformation && dim < 3));
            CU_ASSERT(output.sigma != NULL && (output.sigma_normal != NULL) == (dim < 3));
            CU_ASSERT_EQUAL(isnan(facts.stencil_residual) == 0, (*entry)->stencil);
            CU_ASSERT(facts.pairs > facts.particles && facts.step_traffic > facts.bytes_per_particle);
            CU_ASSERT(facts.bytes_per_particle > facts.state_bytes);
            finish(&sample);
        }
    }
}

/* Without relative motion there is no stress, however far the body has flown. */
static void test_rigid_translation(void)
{
    static const double velocity[] = {0.7, -0.3, 0.5};
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            struct sample sample =
                of_scheme(*entry, dim, "initial = { velocity = function() return first(0.7, -0.3, 0.5) end }\n");
            advance(&sample, 50);
            struct solver_output output = output_of(&sample);
            double worst = 0.0;
            for (size_t k = 0; k < output.cloud->count * dim; k++) {
                worst = fmax(worst, fabs(output.v[k] - velocity[k % dim]));
                worst = fmax(worst, fabs(output.u[k] - velocity[k % dim] * output.time));
            }
            for (size_t k = 0; k < output.cloud->count * dim * dim; k++) {
                worst = fmax(worst, fabs(output.sigma[k]));
            }
            expect_below((*entry)->name, worst, 1e-12);
            finish(&sample);
        }
    }
}

/* A small homogeneous strain: stress and energy are Hooke's, out of the plane as well. */
static void test_small_strain(void)
{
    static const char motion[] =
        "local e = 1e-6\n"
        "initial = { displacement = function(X, Y, Z)\n"
        "                return first(e * (2 * X + Y - Z), e * (Y + 3 * Z), e * (X - 2 * Z)) end,\n"
        "            F = function() if d == 1 then return 1 + 2 * e\n"
        "                elseif d == 2 then return 1 + 2 * e, e, 0, 1 + e end\n"
        "                return 1 + 2 * e, e, -e, 0, 1 + e, 3 * e, e, 0, 1 - 2 * e end }\n";
    static const double gradient[3][3] = {{2, 1, -1}, {0, 1, 3}, {1, 0, -2}};
    const double size = 1e-6, mu = 3 / 2.6, lambda = 3 * 0.3 / (1.3 * 0.4);
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        for (size_t dim = 1; dim <= 3; dim++) {
            struct sample sample = of_scheme(*entry, dim, motion);
            advance_to(&sample, 1e-9); /* long enough to be noted */
            struct solver_output output = output_of(&sample);
            double trace = 0.0, worst = 0.0, energy = 0.0;
            for (size_t i = 0; i < dim; i++) {
                trace += gradient[i][i];
            }
            for (size_t k = 0; k < dim * dim; k++) {
                double strain = 0.5 * (gradient[k / dim][k % dim] + gradient[k % dim][k / dim]);
                double sigma = 2 * mu * strain + (k / dim == k % dim ? lambda * trace : 0.0);
                energy += 0.5 * sigma * strain;
                for (size_t a = 0; a < output.cloud->count; a++) {
                    worst = fmax(worst, fabs(output.sigma[a * dim * dim + k] / size - sigma));
                }
            }
            for (size_t a = 0; dim < 3 && a < output.cloud->count; a++) {
                worst = fmax(worst, fabs(output.sigma_normal[a] / size - lambda * trace));
            }
            expect_below((*entry)->name, worst, 1e-4); /* of second order in the strain */
            double strain_energy = solver_run_history(sample.run)->totals[0].strain;
            CU_ASSERT_DOUBLE_EQUAL(strain_energy / (size * size), energy, 1e-4 * energy);
            finish(&sample);
        }
    }
}

/* Turning without strain leaves no stress but what spinning itself makes, of second order in the rate of turning; a
 * spin that is taken for strain makes one of first order. So does a smoothed velocity near the surface (ulsph.xsph),
 * which is left out. */
static void test_rigid_rotation(void)
{
    static const char motion[] = "initial = { velocity = function(X, Y, Z)\n"
                                 "    local w = 1e-4\n"
                                 "    if d == 2 then return -w * Y, w * X end\n"
                                 "    return w * (2 * Z - Y), w * (X - Z), w * (Y - 2 * X) end }\n";
    char text[1024];
    (void)snprintf(text, sizeof text, "%s%s", hooke, motion);
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        for (size_t dim = 2; dim <= 3; dim++) {
            struct sample sample = start(text, "dim=%zu n=5 scheme=%s ulsph.xsph=0", dim, (*entry)->name);
            advance(&sample, 20);
            struct solver_output output = output_of(&sample);
            double worst = 0.0;
            for (size_t k = 0; k < output.cloud->count * dim * dim; k++) {
                worst = fmax(worst, fabs(output.sigma[k]));
            }
            CU_ASSERT(output.time > 0.5);
            expect_below((*entry)->name, worst / 3.0, 1e-7); /* of E; first order: 5e-5 */
            finish(&sample);
        }
    }
}

/* Patch test: a velocity linear in X makes the stress that Hooke's law says, at every particle, on faces and within,
 * on a regular lattice and on one that is not. One step, before faces answer; smoothed velocities would not be linear
 * near faces. */
static void test_patch(void)
{
    static const char motion[] = "initial = { velocity = function(X, Y, Z)\n"
                                 "    local e = 1e-6\n"
                                 "    return first(e * (2 * X + (Y or 0) - (Z or 0)), e * ((Y or 0) + 3 * (Z or 0)), e "
                                 "* (X - 2 * (Z or 0))) end }\n";
    static const double gradient[3][3] = {{2, 1, -1}, {0, 1, 3}, {1, 0, -2}};
    const double size = 1e-6, mu = 3 / 2.6, lambda = 3 * 0.3 / (1.3 * 0.4);
    char text[1024];
    (void)snprintf(text, sizeof text, "%s%s", hooke, motion);
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        for (size_t i = 0; i < 6; i++) {
            size_t dim = i / 2 + 1;
            struct sample sample = start(text, "dim=%zu n=5 scheme=%s support=2.4 integrator=euler ulsph.xsph=0 %s",
                                         dim, (*entry)->name, i % 2 == 0 ? "" : "perturb=0.15 stencil=closed");
            advance(&sample, 1);
            struct solver_output output = output_of(&sample);
            double trace = 0.0, worst = 0.0;
            for (size_t k = 0; k < dim; k++) {
                trace += gradient[k][k];
            }
            for (size_t k = 0; k < output.cloud->count * dim * dim; k++) {
                size_t row = k / dim % dim, column = k % dim;
                double sigma = mu * (gradient[row][column] + gradient[column][row]);
                sigma += row == column ? lambda * trace : 0.0;
                worst = fmax(worst, fabs(output.sigma[k] / (size * output.time) - sigma));
            }
            expect_below((*entry)->name, worst, 1e-5); /* of second order in the gradient */
            finish(&sample);
        }
    }
}

/* Far beyond the stable step a run ends with an error that says what to try, and shows its last good state. */
static void test_breakdown(void)
{
    for (const struct solver_scheme *const *entry = solver_schemes(); *entry != NULL; entry++) {
        char text[1024];
        (void)snprintf(text, sizeof text, "%s%s", hooke, smooth_motion);
        struct sample sample = start(text, "dim=2 n=6 cfl=10 t_end=100 scheme=%s", (*entry)->name);
        CU_ASSERT_FALSE(solver_run_to(sample.run, 100.0, NULL, NULL, &sample.error));
        CU_ASSERT_EQUAL(sample.error.code, SOLVER_BROKE_DOWN);
        CU_ASSERT_PTR_NOT_NULL(strstr(sample.error.text, "smaller cfl"));
        struct solver_output output = output_of(&sample);
        for (size_t k = 0; k < 2 * output.cloud->count; k++) {
            CU_ASSERT(isfinite(output.v[k]) && isfinite(output.u[k]) && isfinite(output.sigma[2 * k]));
        }
        finish(&sample);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"table", test_table},
        {"fields", test_fields},
        {"flags and outputs", test_flags},
        {"rigid translation", test_rigid_translation},
        {"rigid rotation", test_rigid_rotation},
        {"small strain", test_small_strain},
        {"patch of a constant velocity gradient", test_patch},
        {"breakdown", test_breakdown},
    };
    return unit_main("schemes", tests, sizeof tests / sizeof *tests);
}
