#include "oracles/oracle.h"
#include "solver/integrator.h"
#include "solver/material.h"
#include "solver/scheme.h"
#include "solver/stencil.h"
#include "solver/suggest.h"
#include "verify/commands.h"
#include "verify/find.h"
#include "verify/manufactured.h"
#include "verify/measures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool list_scenes(struct solver_error *error)
{
    struct verify_scenes *scenes = calloc(1, sizeof *scenes);
    if (scenes == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the list of scenes");
    }
    bool done = verify_scenes_list(scenes, error);
    (void)printf("%s", done ? "scenes\n" : "");
    for (size_t i = 0; done && i < scenes->count; i++) {
        char path[VERIFY_PATH];
        struct solver_scene *scene = NULL;
        struct solver_error why = {.code = SOLVER_OK};
        bool loaded = verify_path_join(path, scenes->folder, scenes->name[i], ".lua", &why) &&
                      solver_scene_load(path, NULL, 0, &scene, &why);
        (void)printf("  %-24s %s%s\n", scenes->name[i],
                     loaded ? "" : "cannot be loaded: ", loaded ? scene->title : why.text);
        solver_scene_free(scene);
    }
    free(scenes);
    return done;
}

static void list_parameters(const struct oracle_kind *kind)
{
    for (const struct oracle_parameter *parameter = kind->parameter; parameter->name != NULL; parameter++) {
        (void)printf("  %-24s %s [%s]: %s\n", "", parameter->name, parameter->unit, parameter->help);
    }
    for (const struct oracle_extra *extra = kind->extra; extra != NULL && extra->name != NULL; extra++) {
        (void)printf("  %-24s also knows %s [%s]: %s\n", "", extra->name, extra->unit, extra->help);
    }
}

/* One entry per motion, which any material can follow. */
static void list_manufactured(void)
{
    const struct solver_material_model *model = solver_material_models();
    for (const struct oracle_motion *motion = oracle_motions(); motion->name != NULL; motion++) {
        char name[2 * SOLVER_NAME];
        (void)snprintf(name, sizeof name, "manufactured-%s-%s-3d", motion->name, model->name);
        (void)printf("  manufactured-%-11s %dD to 3D: %s; of the scene's material\n", motion->name, motion->least_dim,
                     motion->summary);
        (void)printf("  %-24s manufactured-%s-MATERIAL-%dd: by its whole name, without a scene\n", "", motion->name,
                     motion->least_dim);
        list_parameters(verify_kind_find(name));
    }
}

static bool list_oracles(struct solver_error *error)
{
    (void)error;
    (void)printf("oracles\n");
    for (const struct oracle_kind *const *kind = oracle_kinds(); *kind != NULL; kind++) {
        (void)printf("  %-24s %dD: %s\n", (*kind)->name, (*kind)->dim, (*kind)->summary);
        (void)printf("  %-24s source: %s\n", "", (*kind)->source);
        if ((*kind)->awaits != NULL) {
            (void)printf("  %-24s the solver lacks %s: nothing is verified by it yet\n", "", (*kind)->awaits);
        }
        list_parameters(*kind);
    }
    list_manufactured();
    return true;
}

static void list_line(const char *name, const char *summary)
{
    (void)printf("  %-24s %s\n", name, summary);
}

/* What a scheme promises, with the overrides that the promise needs. */
static void list_claim(const char *what, const char *needs)
{
    if (needs != NULL) {
        (void)printf("  %-24s   %s%s%s\n", "", what, needs[0] != '\0' ? " with " : "", needs);
    }
}

static bool list_schemes(struct solver_error *error)
{
    (void)error;
    (void)printf("schemes\n");
    for (const struct solver_scheme *const *scheme = solver_schemes(); *scheme != NULL; scheme++) {
        list_line((*scheme)->name, (*scheme)->summary);
        for (const struct solver_scheme_choice *choice = (*scheme)->choice; choice != NULL && choice->text != NULL;
             choice++) {
            char indented[SOLVER_NAME];
            (void)snprintf(indented, sizeof indented, "  %s", choice->text);
            list_line(indented, choice->meaning);
        }
        const struct solver_scheme_claims *claims = &(*scheme)->claims;
        list_line("  claims", "");
        list_claim("affine motions exact to round-off, on a stencil that keeps constant stress", claims->affine);
        list_claim("no stress by turning but of the integrator's order", claims->turning);
        list_claim("linear momentum to round-off", claims->momentum);
        list_claim("angular momentum to round-off", claims->angular);
    }
    return true;
}

static bool list_materials(struct solver_error *error)
{
    (void)error;
    (void)printf("materials\n");
    for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++) {
        list_line(model->name, model->summary);
    }
    return true;
}

static bool list_stencils(struct solver_error *error)
{
    (void)error;
    (void)printf("stencils\n");
    for (const struct solver_stencil_builder *builder = solver_stencil_builders(); builder->name != NULL; builder++) {
        list_line(builder->name, builder->summary);
        (void)printf(
            "  %-24s   claims gradients of polynomials to degree %d, %d at the boundary; %s constant stress in "
            "equilibrium; %s\n",
            "", builder->degree, builder->boundary,
            solver_stencil_keeps_constant_stress(builder) ? "keeps" : "does not keep",
            builder->lattice_only ? "lattices only" : "any cloud");
    }
    return true;
}

static bool list_integrators(struct solver_error *error)
{
    (void)error;
    (void)printf("integrators\n");
    for (const struct solver_integrator *method = solver_integrators(); method->name != NULL; method++) {
        list_line(method->name, method->summary);
    }
    return true;
}

static bool list_measures(struct solver_error *error)
{
    (void)error;
    (void)printf("measures of figures\n");
    for (const struct verify_measure *measure = verify_measures(); measure->name != NULL; measure++) {
        list_line(measure->name, measure->help);
        for (size_t i = 0; i < VERIFY_ARGUMENTS && measure->option[i].kind != VERIFY_NO_OPTION; i++) {
            (void)printf("  %-24s   %s = %s\n", "", measure->option[i].name,
                         verify_option_spelling(measure->option[i].kind));
        }
    }
    return true;
}

/* After what a key expects: what it has unless given, if its meaning does not say so already. */
static void print_preset(const struct solver_scene_key *key)
{
    if (key->preset == NULL) {
        (void)printf("; must be given");
    } else if (key->preset[0] != '\0' && strstr(key->meaning, "default") == NULL) {
        (void)printf("; default: %s", key->preset);
    }
}

static bool list_keys(struct solver_error *error)
{
    (void)error;
    (void)printf("keys of a scene; any of them can be set on the command line by --set KEY=VALUE\n");
    for (const struct solver_scene_key *key = solver_scene_keys(); key->key != NULL; key++) {
        (void)printf("  %-24s %s\n  %-24s   %s", key->key, key->meaning, "", key->expects);
        print_preset(key);
        (void)printf("\n");
    }
    return true;
}

static const struct {
    const char *name;
    bool (*list)(struct solver_error *error);
    bool by_default;
} subjects[] = {
    {"scenes", list_scenes, true},       {"oracles", list_oracles, true},   {"schemes", list_schemes, true},
    {"materials", list_materials, true}, {"stencils", list_stencils, true}, {"integrators", list_integrators, true},
    {"measures", list_measures, false},  {"keys", list_keys, false},
};
enum { SUBJECTS = sizeof subjects / sizeof *subjects };

int verify_command_list(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    const char *wanted = options->operand_count > 0 ? options->operand[0] : NULL;
    const char *names[SUBJECTS];
    bool found = false;
    for (size_t i = 0; i < SUBJECTS; i++) {
        names[i] = subjects[i].name;
        if (wanted != NULL ? strcmp(wanted, names[i]) == 0 : subjects[i].by_default) {
            found = true;
            if (!subjects[i].list(&error)) {
                return verify_complain(&error);
            }
        }
    }
    if (!found) {
        const char *meant = solver_suggest(wanted, names, SUBJECTS);
        (void)solver_fail(
            &error, SOLVER_BAD_INPUT,
            "list %s: there are scenes, oracles, schemes, materials, stencils, integrators, measures and keys%s%s%s",
            wanted, meant != NULL ? "; did you mean " : "", meant != NULL ? meant : "", meant != NULL ? "?" : "");
        return verify_complain(&error);
    }
    return VERIFY_PASSED;
}
