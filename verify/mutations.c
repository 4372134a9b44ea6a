#include "verify/mutations.h"

#include "verify/manufactured.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- drives of manufactured bodies: caught by the errors and orders of a study --- */

/* What the study without a fault holds, by some margin, and every study with one must break: see verify_mutations. */
static const struct {
    const char *gate;
    enum verify_mms_variable variable;
    bool rate;
    double bound;
} drive_gates[] = {
    {"rate p", VERIFY_MMS_OF_p, true, 2.8},
    {"rate P", VERIFY_MMS_OF_P, true, 2.8},
    {"p", VERIFY_MMS_OF_p, false, 1e-4},
    {"P", VERIFY_MMS_OF_P, false, 5e-4},
};
enum { DRIVE_GATES = sizeof drive_gates / sizeof *drive_gates, COARSE = 16, FINE = 32, BOUNDARIES = 3 };

static void add_setting(struct verify_mms_case *which, const char *text)
{
    (void)snprintf(which->setting[which->setting_count++], VERIFY_MMS_TEXT, "%s", text);
}

/* The study that faults are put into: the most accurate stencil, so that small ones show. */
static struct verify_mms_case drive_case(const char *path, const char *faces)
{
    struct verify_mms_case which = {.scene = "manufactured", .path = path, .level = {COARSE, FINE}};
    static const char *const settings[] = {"dim=2", "stencil=sbp4", "evolved=pFHJ", "material.model=neo-hookean",
                                           "amplitude=0.3"};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        add_setting(&which, settings[i]);
    }
    for (int face = 0; face < 4; face++) {
        char text[VERIFY_MMS_TEXT];
        (void)snprintf(text, sizeof text, "faces.%c%d=%s", "XY"[face / 2], face % 2, faces);
        add_setting(&which, text);
    }
    return which;
}

/* A study without (`spoiled` NULL) or with a fault. */
static void try_drive(const char *path, const char *faces, const struct verify_spoiled_drive *spoiled,
                      struct verify_mutation *mutation)
{
    struct verify_mms_case which = drive_case(path, faces);
    struct verify_mms_result result;
    verify_mms_run(&which, spoiled, &result);
    *mutation = (struct verify_mutation){.control = spoiled == NULL, .value = NAN, .bound = NAN};
    (void)snprintf(mutation->what, sizeof mutation->what, "%s", spoiled != NULL ? spoiled->what : "nothing");
    (void)snprintf(mutation->where, sizeof mutation->where, "manufactured, faces %s", faces);
    if (!result.ran) {
        bool broke = result.error.code == SOLVER_BROKE_DOWN;
        mutation->failed = !broke || spoiled == NULL; /* a run that breaks down is noticed, by the user first */
        (void)snprintf(mutation->caught, sizeof mutation->caught, "%.150s",
                       broke ? "run broke down" : result.error.text);
        return;
    }
    for (size_t i = 0; i < DRIVE_GATES && mutation->caught[0] == '\0'; i++) {
        const double *measured = drive_gates[i].rate ? result.order : result.finest;
        double value = measured[drive_gates[i].variable], bound = drive_gates[i].bound;
        if (!(drive_gates[i].rate ? value >= bound : value <= bound)) {
            (void)snprintf(mutation->caught, sizeof mutation->caught, "gate \"%s\"", drive_gates[i].gate);
            mutation->value = value;
            mutation->bound = bound;
        }
    }
}

/* --- oracles: caught by their own self-check --- */

static const double FAULT = 1e-3; /* relative */

/* The kind whose check is tried, and what is wrong with its answers. One at a time per thread. */
struct spoiling {
    const struct oracle_kind *right;
    enum fault { DISPLACEMENT, VELOCITY, GRADIENT, STRESS, CLOCK, KINETIC, STRAIN, EXTRAS, FAULTS } fault;
};
static _Thread_local struct spoiling spoiling;

static const char *const fault_names[FAULTS] = {"displacement",  "velocity",     "deformation gradient",
                                                "stress",        "clock",        "kinetic energy",
                                                "strain energy", "extra scalars"};

/* A stress or a strain energy that is off. Of a rigid kind, which says 0, the flux of momentum p v and the kinetic
 * energy are off `instead`. */
static double off(double right, double instead)
{
    return right + FAULT * (right != 0.0 || !spoiling.right->rigid ? right : instead);
}

static void spoiled_state(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state)
{
    double factor = 1 + FAULT;
    spoiling.right->state(oracle, X, spoiling.fault == CLOCK ? t * factor : t, state);
    for (int i = 0; i < 9; i++) {
        double unit = i % 4 == 0 ? 1 : 0;
        if (i < 3) {
            state->u[i] *= spoiling.fault == DISPLACEMENT ? factor : 1;
            state->v[i] *= spoiling.fault == VELOCITY ? factor : 1;
        }
        state->F[i] = spoiling.fault == GRADIENT ? unit + factor * (state->F[i] - unit) : state->F[i];
        state->P[i] = spoiling.fault == STRESS ? off(state->P[i], state->p[i / 3] * state->v[i % 3]) : state->P[i];
    }
}

static void spoiled_energy(const struct oracle *oracle, double t, double *kinetic, double *strain)
{
    spoiling.right->energy(oracle, t, kinetic, strain);
    *kinetic *= spoiling.fault == KINETIC ? 1 + FAULT : 1;
    *strain = spoiling.fault == STRAIN ? off(*strain, *kinetic) : *strain;
}

static void spoiled_extras(const struct oracle *oracle, const double X[3], double t, double value[ORACLE_EXTRAS])
{
    spoiling.right->extras(oracle, X, t, value);
    for (size_t i = 0; spoiling.right->extra[i].name != NULL; i++) {
        value[i] *= 1 + FAULT;
    }
}

/* Asks the true kind's check about a kind with the fault; FAULTS: without one. */
static void try_oracle(const struct oracle_kind *kind, enum fault fault, struct verify_mutation *mutation)
{
    double value[ORACLE_PARAMETERS];
    char why[ORACLE_WHY] = "";
    struct oracle *oracle = NULL;
    struct oracle_check line[ORACLE_LAWS];
    *mutation = (struct verify_mutation){.control = fault == FAULTS, .value = NAN, .bound = NAN};
    (void)snprintf(mutation->what, sizeof mutation->what, fault == FAULTS ? "nothing" : "%s 0.1 %% off",
                   fault == FAULTS ? "" : fault_names[fault]);
    (void)snprintf(mutation->where, sizeof mutation->where, "oracle %s", kind->name);
    for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
        value[i] = kind->parameter[i].typical;
    }
    if (!oracle_create(kind, value, &oracle, why)) {
        mutation->failed = true;
        (void)snprintf(mutation->caught, sizeof mutation->caught, "%.100s", why);
        return;
    }
    struct oracle_kind spoiled = *kind;
    spoiling = (struct spoiling){kind, fault};
    spoiled.state = spoiled_state;
    spoiled.energy = spoiled_energy;
    spoiled.extras = kind->extras != NULL && fault == EXTRAS ? spoiled_extras : kind->extras;
    size_t count = kind->check(&spoiled, oracle, line, ORACLE_LAWS);
    for (size_t i = 0; i < count && i < ORACLE_LAWS && mutation->caught[0] == '\0'; i++) {
        if (!oracle_law_holds(&line[i])) {
            (void)snprintf(mutation->caught, sizeof mutation->caught, "self-check \"%.100s\"", line[i].law);
            mutation->value = line[i].residual;
            mutation->bound = line[i].bound;
        }
    }
    kind->destroy(oracle);
}

/* --- all of them --- */

/* What is to be tried: a drive, or an oracle. */
struct trial {
    const char *faces;
    const struct verify_spoiled_drive *drive;
    const struct oracle_kind *kind;
    enum fault fault;
};

static size_t list_drives(struct trial *trial)
{
    static const char *const faces[BOUNDARIES] = {"motion", "traction", "roller"};
    size_t count = 0;
    for (int i = 0; i < BOUNDARIES; i++, count++) {
        trial[count] = (struct trial){.faces = faces[i]};
    }
    for (const struct verify_spoiled_drive *d = verify_spoiled_drives(); d->what != NULL; d++, count++) {
        trial[count] = (struct trial){.faces = d->faces, .drive = d};
    }
    return count;
}

static size_t list_kind(const struct oracle_kind *kind, struct trial *trial)
{
    size_t count = 0;
    trial[count++] = (struct trial){.kind = kind, .fault = FAULTS};
    for (int fault = 0; fault < FAULTS; fault++) {
        if (fault != EXTRAS || kind->extras != NULL) {
            trial[count++] = (struct trial){.kind = kind, .fault = (enum fault)fault};
        }
    }
    return count;
}

/* Every oracle of the oracles' room, and the manufactured ones in the plane. */
static size_t list_oracles(struct trial *trial)
{
    size_t count = 0;
    for (const struct oracle_kind *const *kind = oracle_kinds(); *kind != NULL; kind++) {
        count += list_kind(*kind, trial + count);
    }
    for (const struct oracle_motion *motion = oracle_motions(); motion->name != NULL; motion++) {
        for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++) {
            char name[VERIFY_MUTATION_TEXT];
            (void)snprintf(name, sizeof name, "manufactured-%s-%s-2d", motion->name, model->name);
            count += list_kind(verify_manufactured_find(name, NULL, 0), trial + count);
        }
    }
    return count;
}

/* How many trials there can be. */
static size_t room(void)
{
    size_t kinds = 0, drives = BOUNDARIES;
    for (const struct oracle_kind *const *kind = oracle_kinds(); *kind != NULL; kind++) {
        kinds++;
    }
    for (const struct oracle_motion *motion = oracle_motions(); motion->name != NULL; motion++) {
        for (const struct solver_material_model *model = solver_material_models(); model->name != NULL; model++) {
            kinds++;
        }
    }
    for (const struct verify_spoiled_drive *d = verify_spoiled_drives(); d->what != NULL; d++) {
        drives++;
    }
    return drives + kinds * (FAULTS + 1);
}

bool verify_mutation_missed(const struct verify_mutation *mutation)
{
    bool noticed = mutation->caught[0] != '\0';
    return mutation->failed || noticed == mutation->control;
}

bool verify_mutations(const char *path, verify_mutation_told *told, void *context, size_t *count, size_t *missed,
                      struct solver_error *error)
{
    struct trial *trial = calloc(room(), sizeof *trial);
    struct verify_mutation *mutation = calloc(room(), sizeof *mutation);
    *count = *missed = 0;
    if (trial == NULL || mutation == NULL) {
        free(trial);
        free(mutation);
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the list of mutations");
    }
    size_t trials = list_drives(trial);
    trials += list_oracles(trial + trials);
    size_t next = 0;
#pragma omp parallel for schedule(dynamic)
    for (size_t i = 0; i < trials; i++) {
        struct verify_mutation mine;
        if (trial[i].kind != NULL) {
            try_oracle(trial[i].kind, trial[i].fault, &mine);
        } else {
            try_drive(path, trial[i].faces, trial[i].drive, &mine);
        }
#pragma omp critical(verify_mutations)
        {
            mutation[i] = mine;
            mutation[i].done = true;
            for (; next < trials && mutation[next].done; next++) { /* in order, as soon as they are there */
                told(context, &mutation[next]);
            }
        }
    }
    for (size_t i = 0; i < trials; i++) {
        *count += mutation[i].control ? 0 : 1;
        *missed += verify_mutation_missed(&mutation[i]) ? 1 : 0;
    }
    free(trial);
    free(mutation);
    return true;
}
