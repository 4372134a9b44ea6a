/* Fields allocated are fields used. Each is poisoned in turn, between any two phases of two right-hand sides: one whose
 * poison never reaches the rates is read by nobody, and fails. And with poison in all that is not state, rates are what
 * they were: nothing else is read. Stencils' arrays are held to the same. */
#include "solver/run_internal.h"
#include "solver/scheme_upwind.h"
#include "solver/ulsph.h"
#include "tests/unit/runs.h"

#include <stdint.h>

/* A run taken apart. */
struct machine {
    struct sample sample;
    struct solver_run *run;
    struct solver_state *state;
    const struct solver_ulsph *ulsph; /* NULL: one of the schemes on the system of scheme_upwind.h */
    const struct solver_upwind_system *system;
    size_t count;
    double dt;
};

static struct machine take_apart(const char *more, const char *words)
{
    struct machine machine = {.sample = start(more, "%s", words)};
    advance(&machine.sample, 2); /* so that nothing is at rest */
    struct solver_run *run = machine.sample.run;
    machine.run = run;
    machine.state = &run->state;
    machine.count = run->state.count;
    machine.dt = 0.5 * solver_scheme_largest_step(run->scheme, run->system, run->cloud->count);
    if (strcmp(machine.sample.scene->scheme, "ulsph") == 0) {
        /* its table of fields starts with where its work keeps v */
        machine.ulsph = (const void *)((const char *)run->state.field[0].value - offsetof(struct solver_ulsph, v));
        CU_ASSERT_PTR_EQUAL_FATAL(machine.ulsph->x, run->state.x);
    } else {
        machine.system = run->system;
    }
    return machine;
}

/* Two right-hand sides and the step between them, cut where one loop ends and the next begins. */
enum { PREPARE, REFRESH, GATHER, GRADIENTS, RATES, UPDATE, ROUND, PHASES = 2 * ROUND - 1 };

static void upwind_phase(const struct machine *machine, int phase)
{
    const struct solver_upwind_system *system = machine->system;
    if (phase == GRADIENTS) {
        system->loops->gradients(&system->work, 0, machine->count);
        if (system->gather != NULL) {
            system->gather(system, &system->work, 0, machine->count);
        }
    } else if (phase == RATES && system->rates != NULL) {
        system->rates(system, &system->work, 0, machine->count);
    } else if (phase == RATES) {
        system->loops->rates(&system->work, 0, machine->count);
    }
}

static void ulsph_phase(const struct machine *machine, int phase)
{
    static const struct solver_ulsph_loops *const loops[][3] = SOLVER_LOOPS(solver_ulsph);
    const struct solver_ulsph_loops *of = loops[solver_path()][machine->sample.scene->dim - 1];
    if (phase == GATHER) {
        of->geometry(machine->ulsph, 0, machine->count);
    } else if (phase == GRADIENTS) {
        of->gradients(machine->ulsph, 0, machine->count);
    } else if (phase == RATES) {
        of->rates(machine->ulsph, 0, machine->count);
    }
}

static void run_phase(struct machine *machine, int phase)
{
    const struct solver_scheme *scheme = machine->run->scheme;
    struct solver_error error;
    if (phase == PREPARE && scheme->prepare != NULL) {
        CU_ASSERT_FATAL(scheme->prepare(machine->run->system, machine->dt, &error));
    } else if (phase == REFRESH) {
        scheme->refresh(machine->run->system, 0, machine->count);
    } else if (phase == UPDATE) {
        for (size_t i = machine->state->evolved;
             i-- > 0;) { /* backwards: v, where the block begins, is the rate of x */
            machine->state->U[i] += machine->dt * solver_state_rate(machine->state, i);
        }
    } else if (machine->ulsph != NULL) {
        ulsph_phase(machine, phase);
    } else {
        upwind_phase(machine, phase);
    }
}

/* A signalling NaN of a pattern of its own. */
static void poison(double *at, size_t count)
{
    const uint64_t pattern = 0x7ff4dead0badf00d;
    for (size_t i = 0; i < count; i++) {
        memcpy(at + i, &pattern, sizeof pattern);
    }
}

/* What there is to spoil: numbers `stride` apart, `width` of them at a time. */
struct victim {
    const char *name;
    double *at;
    size_t records, stride, width;
};

enum { VICTIMS = 40 };

static size_t list_victims(const struct machine *machine, struct victim victim[VICTIMS])
{
    size_t found = 0;
    size_t dim = (size_t)machine->sample.scene->dim;
    for (size_t i = 0; i < machine->state->field_count; i++) {
        const struct solver_field *field = &machine->state->field[i];
        victim[found++] = (struct victim){field->name, *field->value, machine->count, field->width, field->width};
    }
    if (machine->system != NULL) {
        const struct solver_stencil *stencil = machine->system->stencil;
        victim[found++] = (struct victim){"pair vectors", stencil->pair, stencil->records, dim + 1, dim};
        victim[found++] = (struct victim){"face measures", stencil->pair + dim, stencil->records, dim + 1, 1};
        victim[found++] = (struct victim){"row sums", stencil->row_sum, machine->count, dim, dim};
        victim[found++] = (struct victim){"volumes", stencil->V, machine->count, 1, 1};
        if (stencil->own != NULL) {
            victim[found++] = (struct victim){"volumes of the part", stencil->own, machine->count, 1, 1};
        }
        if (stencil->transposed != NULL) {
            victim[found++] = (struct victim){"transposed", stencil->transposed, stencil->pairs, dim, dim};
        }
        if (stencil->least_squares != NULL) {
            victim[found++] = (struct victim){"least squares", stencil->least_squares, stencil->pairs, dim, dim};
        }
    }
    return found;
}

static void spoil(const struct victim *victim, char *name)
{
    for (size_t i = 0; i < victim->records; i++) {
        poison(victim->at + i * victim->stride, victim->width);
    }
    (void)snprintf(name, SOLVER_NAME, "%s", victim->name);
}

/* Rates of all phases, and the power lost where it is asked for, with one of the victims poisoned just before one of
 * them (PHASES: before the power is summed; -1: never), and its name. */
static double *rates_of(const char *more, const char *words, size_t which, int before, size_t *size, char *name,
                        size_t *victims)
{
    struct victim victim[VICTIMS];
    struct machine machine = take_apart(more, words);
    *victims = list_victims(&machine, victim);
    for (int phase = 0; phase < PHASES; phase++) {
        if (phase == before) {
            spoil(&victim[which], name);
        }
        run_phase(&machine, phase % ROUND);
    }
    if (before == PHASES) {
        spoil(&victim[which], name);
    }
    size_t count = machine.state->rates;
    *size = (count + 1) * sizeof(double);
    double *rates = malloc(*size);
    CU_ASSERT_PTR_NOT_NULL_FATAL(rates);
    memcpy(rates, machine.state->rate, count * sizeof(double));
    rates[count] = machine.sample.scene->balance ? machine.run->scheme->lost(machine.run->system) : 0.0;
    finish(&machine.sample);
    return rates;
}

/* What a scene asks for and nothing reads, and why. */
static const struct {
    const char *name, *scheme, *words, *reason;
} idle[] = {
    {"x", "scheme=upwind", "linear-elastic", "linear kinematics know no place but X; it is for the record"},
    {"x", "scheme=jst", "", "its forces depend on F alone; it is for the record, for walls and contact"},
    {"H", "", "linear-elastic", "linear kinematics have no H in any equation; the scene asks for its record"},
    {"face measures", "scheme=jst", "", "a Laplacian's weights are made of them, once"},
};

static bool may_idle(const char *name, const char *words)
{
    bool may = false;
    for (size_t i = 0; i < sizeof idle / sizeof *idle; i++) {
        may = may || (strcmp(idle[i].name, name) == 0 && strstr(words, idle[i].scheme) != NULL &&
                      strstr(words, idle[i].words) != NULL);
    }
    return may;
}

/* Whether poison in one field reaches the rates from any place in time. */
static bool is_read(const char *more, const char *words, size_t which, const double *good, char *name)
{
    bool read = false;
    size_t size;
    size_t victims;
    int last = strstr(words, "balance") != NULL ? PHASES : PHASES - 1;
    for (int before = 0; !read && before <= last; before++) {
        double *spoilt = rates_of(more, words, which, before, &size, name, &victims);
        read = memcmp(good, spoilt, size) != 0;
        free(spoilt);
    }
    return read;
}

static void expect_all_read(const char *more, const char *words)
{
    size_t size;
    size_t victims;
    char name[SOLVER_NAME];
    double *good = rates_of(more, words, 0, -1, &size, name, &victims);
    for (size_t which = 0; which < victims; which++) {
        bool read = is_read(more, words, which, good, name);
        if (read == may_idle(name, words)) {
            printf("\n    %s: %s is %s", words, name, read ? "read, and was not to be" : "read by nobody");
        }
        CU_ASSERT(read != may_idle(name, words));
    }
    free(good);
}

/* Where nothing should look: what is not state, rates of the last time, copies of the integrator, what pads fields. */
static void poison_all_else(struct machine *machine)
{
    struct solver_state *state = machine->state;
    size_t padded = (machine->count + 7) / 8 * 8;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        bool kept = field->evolved || strcmp(field->name, "X") == 0 || strcmp(field->name, "plastic flow") == 0;
        size_t used = machine->count * field->width;
        size_t from = kept ? used : 0;
        poison(*field->value + from, padded * field->width - from);
    }
    poison(state->rate, state->rates);
    poison(state->start, state->evolved);
    if (state->sum != NULL) {
        poison(state->sum, state->evolved);
    }
}

static void expect_nothing_else_read(const char *more, const char *words)
{
    size_t size;
    size_t victims;
    char name[SOLVER_NAME];
    double *good = rates_of(more, words, 0, -1, &size, name, &victims);
    struct machine machine = take_apart(more, words);
    poison_all_else(&machine);
    for (int phase = 0; phase < PHASES; phase++) {
        run_phase(&machine, phase % ROUND);
    }
    for (size_t i = 0; i < machine.state->field_count && machine.state->field[i].rate != NULL; i++) {
        const struct solver_field *field = &machine.state->field[i];
        bool same = memcmp(*field->rate, good + field->offset, machine.count * field->width * sizeof(double)) == 0;
        if (!same) {
            printf("\n    %s: the rate of %s comes from what is no state", words, field->name);
        }
        CU_ASSERT(same);
    }
    free(good);
    finish(&machine.sample);
}

typedef void expectation(const char *more, const char *words);

static const char metal[] =
    "initial = { velocity = function(X, Y, Z)\n"
    "    return first(0.3 * sin(2 * X + Y), 0.2 * cos(3 * Y - X), 0.1 * sin(X + Z)) end }\n"
    "material = { model = 'hencky', E = 3, nu = 0.3, rho = 2, yield_stress = 0.01, hardening = 0.1 }\n";

static const char composite[] =
    "initial = { velocity = function(X, Y, Z) return first(0.05 * sin(2 * X), 0.04 * cos(3 * Y), 0.1 * Z) end }\n"
    "material = { model = 'neo-hookean', E = 3, nu = 0.3, rho = 2,\n"
    "             at = function(X) return 3, 0.3, X < 0.5 and 2 or 3 end }\n";

static const char quarter[] = "domain = { shape = 'disc', centre = {0, 0}, radius = 1, symmetry = { X = 0, Y = 0 } }\n"
                              "initial = { velocity = function(X, Y) return 0.1 * sin(X) * cos(Y), 0.1 * Y end }\n";

static void over_lagrangian(expectation *expect, const char *scheme)
{
    static const char *const sets[] = {"pF", "pFJ", "pFHJ"};
    static const char *const options[] = {
        "material.model=linear-elastic",
        "material.model=neo-hookean",
        "material.model=neo-hookean-polyconvex integrator=rk4",
        "stencil=sph reconstruction=least-squares",
        "reconstruction=none",
        "volume_flux=stress",
    };
    char words[160];
    for (size_t e = 0; e < sizeof sets / sizeof *sets; e++) {
        for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
            (void)snprintf(words, sizeof words, "dim=2 scheme=%s evolved=%s %s", scheme, sets[e], options[i]);
            expect(smooth_motion, words);
        }
        for (int dim = 1; dim <= 3; dim++) {
            (void)snprintf(words, sizeof words, "dim=%d n=2 scheme=%s evolved=%s", dim, scheme, sets[e]);
            expect(metal, words);
            expect(composite, words);
        }
        (void)snprintf(words, sizeof words, "dim=2 scheme=%s evolved=%s balance=true", scheme, sets[e]);
        expect(smooth_motion, words);
        (void)snprintf(words, sizeof words, "dim=2 stencil=closed scheme=%s evolved=%s balance=true", scheme, sets[e]);
        expect(quarter, words);
    }
}

static void over_ulsph(expectation *expect)
{
    static const char *const options[] = {
        "",
        "lattice=centres",
        "ulsph.tension=none",
        "ulsph.tension=stress",
        "ulsph.dissipation=none",
        "ulsph.dissipation=viscosity",
        "ulsph.xsph=0.5",
        "ulsph.delta=0",
        "ulsph.gradient=plain",
        "ulsph.cells=cut",
    };
    char words[160];
    for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
        (void)snprintf(words, sizeof words, "dim=2 n=8 scheme=ulsph material.model=linear-elastic %s", options[i]);
        expect(smooth_motion, words);
    }
}

static void fields_are_read(void)
{
    unit_untrapped();
    over_lagrangian(expect_all_read, "upwind");
    over_lagrangian(expect_all_read, "jst");
    expect_all_read(metal, "dim=2 n=2 scheme=jst evolved=pF jst.kappa4_plastic=0 jst.plastic_at=0.1");
    over_ulsph(expect_all_read);
}

static void nothing_else_is_read(void)
{
    unit_untrapped();
    over_lagrangian(expect_nothing_else_read, "upwind");
    over_lagrangian(expect_nothing_else_read, "jst");
    over_ulsph(expect_nothing_else_read);
}

static const struct unit_test tests[] = {
    {"every field is read", fields_are_read},
    {"nothing but fields is read", nothing_else_is_read},
};

int main(void)
{
    return unit_main("solver fields", tests, sizeof tests / sizeof *tests);
}
