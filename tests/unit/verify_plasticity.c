/* The elastic-plastic material against the oracles of J2 plasticity, which stand in another room: return maps along
 * their paths, and a body led along them. */
#include "oracles/oracle.h"
#include "solver/material.h"
#include "solver/run.h"
#include "tests/unit/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { E, NU, RHO, YIELD, HARDENING, CONSTANTS };
static const double copper[CONSTANTS] = {117e9, 0.35, 8930, 0.4e9, 0.1e9}; /* 004_0c0448173ed5e9bd.txt, section 4.1 */
static const double period = 1e-3;

/* An oracle and the material it speaks of. */
struct cycle {
    const struct oracle_kind *kind;
    struct oracle *oracle;
    struct solver_material_constants constants;
    struct solver_hardening hardening;
};

/* Two cycles; `scale` makes yield stress and amplitude smaller alike, so that all else stays. */
static struct cycle open_cycle(const char *name, double amplitude, double scale)
{
    struct cycle cycle = {.kind = oracle_find(name)};
    const double value[] = {amplitude * scale,     period,           2, copper[E], copper[NU], copper[RHO],
                            copper[YIELD] * scale, copper[HARDENING]};
    char why[ORACLE_WHY];
    CU_ASSERT_PTR_NOT_NULL_FATAL(cycle.kind);
    CU_ASSERT_PTR_NULL(cycle.kind->awaits);
    CU_ASSERT_FATAL(oracle_create(cycle.kind, value, &cycle.oracle, why));
    cycle.constants = solver_material_constants(copper[E], copper[NU], copper[RHO]);
    cycle.hardening = (struct solver_hardening){.yield = copper[YIELD] * scale, .modulus = copper[HARDENING]};
    return cycle;
}

static void expect(const char *what, double found, double bound)
{
    bool holds = found <= bound;
    if (!holds) {
        printf("\n    %s: %.3e > %.1e", what, found, bound);
    }
    CU_ASSERT(holds);
}

/* Along two cycles by return maps, `steps` a quarter of a period: the largest difference of the stress, over the
 * largest stress, and of the plastic strain, over that at the end. */
static void follow(const struct cycle *cycle, int steps, double *of_stress, double *of_plastic)
{
    const struct solver_flow *flow = solver_material_find("hencky")->in[2]->flow;
    double memory[7] = {0}, largest = 0;
    *of_stress = *of_plastic = 0;
    for (int i = 1; i < 8 * steps; i++) {
        double F[12] __attribute__((aligned(64))) = {0}, P[12] __attribute__((aligned(64)));
        double before[7], t = 2 * period * i / (8 * steps), extra[ORACLE_EXTRAS];
        const double X[3] = {0.3, 0.4, 0.5};
        struct oracle_state state;
        cycle->kind->state(cycle->oracle, X, t, &state);
        cycle->kind->extras(cycle->oracle, X, t, extra);
        for (int k = 0; k < 9; k++) {
            F[k % 3 * 4 + k / 3] = state.F[k];
        }
        memcpy(before, memory, sizeof before);
        flow->stress_range(&cycle->constants, 0, &cycle->hardening, 0, 1, F, NULL, NULL, before, memory, P);
        for (int k = 0; k < 9; k++) {
            largest = fmax(largest, fabs(state.P[k]));
            *of_stress = fmax(*of_stress, fabs(P[k % 3 * 4 + k / 3] - state.P[k]));
        }
        *of_plastic = fmax(*of_plastic, fabs(memory[0] - extra[0]));
        CU_ASSERT(extra[0] >= 0);
    }
    *of_stress /= largest;
    CU_ASSERT_FATAL(memory[0] > 0);
    *of_plastic /= memory[0];
}

/* Directions stay, so that return maps are exact, whatever the steps: up to half the length and half as much again. */
static void finite_uniaxial(void)
{
    static const double amplitude[] = {0.006, 0.02, 0.2, 0.5};
    for (int a = 0; a < 4; a++) {
        for (int steps = 1; steps <= 125; steps *= 5) {
            struct cycle cycle = open_cycle("j2-hencky-uniaxial", amplitude[a], 1);
            double stress, plastic;
            follow(&cycle, steps, &stress, &plastic);
            expect("stress of j2-hencky-uniaxial", stress, 1e-13);
            expect("plastic strain of j2-hencky-uniaxial", plastic, 1e-11 * fmin(1, 0.02 / amplitude[a]));
            cycle.kind->destroy(cycle.oracle);
        }
    }
}

/* The oracles of small strain are its limit: halve all strains, and the relative difference is halved. */
static void small_strains(void)
{
    static const char *const name[] = {"j2-uniaxial", "j2-simple-shear"};
    for (int n = 0; n < 2; n++) {
        double stress[3], plastic[3];
        for (int level = 0; level < 3; level++) {
            struct cycle cycle = open_cycle(name[n], 0.02, 1e-2 * pow(0.5, level));
            follow(&cycle, 40, &stress[level], &plastic[level]);
            cycle.kind->destroy(cycle.oracle);
        }
        expect(name[n], stress[0], 1e-3);
        expect(name[n], fabs(stress[1] / stress[0] - 0.5), 0.01);
        expect(name[n], fabs(stress[2] / stress[1] - 0.5), 0.01);
        expect(name[n], plastic[0], 1e-3);
        expect(name[n], plastic[1] / plastic[0], 0.51); /* in shear the error is of second order */
    }
}

/* --- a body --- */

static const double ahead = 1e-9; /* of a period: past a turning point that round-off may put on either side */

static void lead(const void *context, enum solver_formula formula, const double X[3], double t, double value[3])
{
    const struct cycle *cycle = context;
    struct oracle_state state;
    cycle->kind->state(cycle->oracle, X, t + ahead * period, &state);
    memset(value, 0, 3 * sizeof *value);
    if (formula >= SOLVER_FACE_X0) {
        memcpy(value, state.v, sizeof state.v);
    }
}

static void set_off(const void *context, const double X[3], double u[3], double v[3], double F[9])
{
    const struct cycle *cycle = context;
    struct oracle_state state;
    cycle->kind->state(cycle->oracle, X, 0, &state);
    memcpy(u, state.u, sizeof state.u);
    memcpy(v, state.v, sizeof state.v);
    memcpy(F, state.F, sizeof state.F);
}

static const char cube[] =
    "title = 'cube'\ndim, n, t_end = 3, 1, 2e-3\ndomain = { lower = {0, 0, 0}, upper = {1, 1, 1} }\n"
    "material = { model = 'hencky', E = 117e9, nu = 0.35, rho = 8930, yield_stress = 0.4e9, hardening = 0.1e9 }\n"
    "stencil, integrator, cfl, history = 'sbp2', 'euler', 0.1, 100\n"
    "initial, loads = { from = 'oracle' }, { from = 'oracle' }\n"
    "faces = { X0 = 'motion', X1 = 'motion', Y0 = 'motion', Y1 = 'motion', Z0 = 'motion', Z1 = 'motion' }\n";

static struct solver_scene *load_cube(const char *evolved)
{
    struct solver_scene *scene = NULL;
    struct solver_error error;
    const char *override[] = {evolved};
    FILE *file = fopen("plastic-cube-test.lua", "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT_FATAL(fputs(cube, file) >= 0 && fclose(file) == 0);
    bool loaded = solver_scene_load("plastic-cube-test.lua", override, 1, &scene, &error);
    if (!loaded) {
        printf("\n    %s", error.text);
    }
    CU_ASSERT_FATAL(loaded);
    (void)remove("plastic-cube-test.lua");
    return scene;
}

/* A cube of eight particles, all of them led, by Euler's method, which is exact while velocities stay and which never
 * asks for the velocity at a turning point from before it. */
static void led_cube(const char *evolved)
{
    struct cycle cycle = open_cycle("j2-hencky-uniaxial", 0.02, 1);
    struct solver_scene *scene = load_cube(evolved);
    struct solver_run *run = NULL;
    struct solver_error error;
    solver_scene_start_from(scene, set_off, &cycle);
    solver_scene_drive_from(scene, lead, &cycle, NULL);
    CU_ASSERT_FATAL(solver_run_create(scene, &run, &error));
    for (int eighth = 1; eighth < 16; eighth++) {
        double t = period * eighth / 8, extra[ORACLE_EXTRAS], kinetic, strain;
        const double X[3] = {0.5, 0.5, 0.5};
        struct oracle_state state;
        struct solver_output output;
        CU_ASSERT_FATAL(solver_run_to(run, t, NULL, NULL, &error));
        CU_ASSERT_FATAL(solver_run_output(run, &output, &error));
        cycle.kind->state(cycle.oracle, X, t, &state);
        cycle.kind->extras(cycle.oracle, X, t, extra);
        cycle.kind->energy(cycle.oracle, t, &kinetic, &strain);
        CU_ASSERT_PTR_NOT_NULL_FATAL(output.plastic_strain);
        for (size_t a = 0; a < output.cloud->count; a++) {
            for (int k = 0; k < 9; k++) {
                expect("P of the led cube / E", fabs(output.P[9 * a + (size_t)k] - state.P[k]) / copper[E], 1e-12);
            }
            expect("plastic strain of the led cube", fabs(output.plastic_strain[a] - extra[0]), 1e-12);
        }
        const struct solver_history *history = solver_run_history(run);
        const struct solver_totals *last = &history->totals[history->count - 1];
        double work = (copper[YIELD] + 0.5 * copper[HARDENING] * extra[0]) * extra[0];
        CU_ASSERT(last->time == t);
        expect("strain energy of the led cube", fabs(last->strain / strain - 1), 1e-9);
        expect("plastic work of the led cube", fabs(last->plastic / work - 1), 1e-10);
    }
    solver_run_free(run);
    solver_scene_free(scene);
    cycle.kind->destroy(cycle.oracle);
}

static void led_cubes(void)
{
    led_cube("evolved=pF");
    led_cube("evolved=pFJ");
    led_cube("evolved=pFHJ");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"return maps along finite uniaxial cycles are exact", finite_uniaxial},
        {"small strains: the difference goes with the strain", small_strains},
        {"a cube that is led through cycles", led_cubes},
    };
    return unit_main("plasticity against oracles", tests, sizeof tests / sizeof *tests);
}
