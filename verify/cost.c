#include "verify/cost.h"

#include "solver/integrator.h"
#include "verify/find.h"
#include "verify/overrides.h"
#include "verify/signals.h"
#include "verify/simulate.h"
#include "verify/study.h"
#include "verify/timing.h"

#include <math.h>
#include <string.h>

static bool is_incompressible(const struct solver_scene *scene)
{
    return scene->incompressible.solver != SOLVER_PRESSURE_NONE;
}

static bool evolves_H(const struct solver_scene *scene)
{
    return verify_has_stencil(scene) && scene->evolved == SOLVER_PFHJ;
}

static bool evolves_J(const struct solver_scene *scene)
{
    return verify_has_stencil(scene) && scene->evolved != SOLVER_PF && !is_incompressible(scene);
}

/* JST reconstructs nothing. */
static bool reconstructs(const struct solver_scene *scene)
{
    return strcmp(scene->scheme, "upwind") == 0 && strcmp(scene->reconstruction, "none") != 0;
}

static bool has_least_squares(const struct solver_scene *scene)
{
    return reconstructs(scene) && strcmp(scene->reconstruction, "least-squares") == 0;
}

static bool is_composite(const struct solver_scene *scene)
{
    return solver_scene_has(scene, SOLVER_MATERIAL_AT);
}

static bool projects(const struct solver_scene *scene)
{
    return strcmp(scene->angular_momentum, "projected") == 0;
}

static bool gives_volumes_back(const struct solver_scene *scene)
{
    return is_incompressible(scene) && scene->incompressible.restore > 0.0;
}

static bool balances(const struct solver_scene *scene)
{
    return scene->balance;
}

static bool has_contact(const struct solver_scene *scene)
{
    return scene->contact_law != SOLVER_CONTACT_NONE;
}

static bool has_second_difference(const struct solver_scene *scene)
{
    return strcmp(scene->scheme, "jst") == 0 && scene->jst.kappa2 > 0.0;
}

static bool is_ulsph(const struct solver_scene *scene)
{
    return strcmp(scene->scheme, "ulsph") == 0;
}

static bool corrects(const struct solver_scene *scene)
{
    return is_ulsph(scene) && scene->ulsph.gradient == SOLVER_ULSPH_CORRECTED;
}

static bool dissipates(const struct solver_scene *scene)
{
    return is_ulsph(scene) && scene->ulsph.dissipation != SOLVER_ULSPH_INVISCID;
}

static bool has_tension(const struct solver_scene *scene)
{
    return is_ulsph(scene) && scene->ulsph.tension != SOLVER_ULSPH_BARE;
}

static bool smooths(const struct solver_scene *scene)
{
    return is_ulsph(scene) && scene->ulsph.xsph > 0.0;
}

static bool diffuses(const struct solver_scene *scene)
{
    return is_ulsph(scene) && scene->ulsph.delta > 0.0;
}

/* Everything that a key of the scene can leave out. */
static const struct {
    const char *name, *words;
    bool (*there)(const struct solver_scene *scene);
} parts[] = {
    {"evolved H", "evolved=pFJ", evolves_H},
    {"evolved J, and H", "evolved=pF", evolves_J},
    {"reconstruction", "reconstruction=none", reconstructs},
    {"least-squares slopes", "reconstruction=stencil", has_least_squares},
    {"harmonic dissipation", "jst.kappa2=0", has_second_difference},
    {"plastic flow",
     "material.yield_stress=0 material.law=linear material.hardening=0 material.saturation=0 "
     "material.saturation_rate=0 material.hardening_strain=0 material.hardening_exponent=0",
     solver_scene_flows},
    {"composite constants", NULL, is_composite},
    {"angular momentum", "angular_momentum=free", projects},
    {"pressure in place of J", "incompressible.solver=none material.nu=0.499", is_incompressible},
    {"volumes given back", "incompressible.restore=0", gives_volumes_back},
    {"energy balance", "balance=false", balances},
    {"contact", "contact.law=none", has_contact},
    {"corrected gradients", "ulsph.gradient=plain", corrects},
    {"dissipation", "ulsph.dissipation=none", dissipates},
    {"tension control", "ulsph.tension=none", has_tension},
    {"transport velocity", "ulsph.xsph=0", smooths},
    {"density diffusion", "ulsph.delta=0", diffuses},
};
_Static_assert(sizeof parts / sizeof *parts <= VERIFY_COST_ITEMS, "room for every part");

/* The scene as the options and some words of --set, separated by blanks, have it. `room` holds them. */
static bool open_with(const struct verify_options *options, const char *words, char room[2 * SOLVER_TEXT],
                      struct solver_scene **scene, struct solver_error *error)
{
    char threads[SOLVER_NAME];
    struct verify_options with = *options;
    (void)snprintf(room, 2 * SOLVER_TEXT, "%s", words);
    char *rest = room;
    for (char *word = strtok_r(rest, " ", &rest); word != NULL; word = strtok_r(rest, " ", &rest)) {
        verify_say(&with, word);
    }
    verify_say_unless(&with, "threads", threads, "1");
    return verify_scene_open(&with, 0, scene, error);
}

static void declare_operations(const struct solver_run *run, struct verify_cost_case *of)
{
    struct solver_cost_arrays arrays;
    solver_run_cost(run, &arrays, &of->terms);
    of->flops = solver_cost_flops(&of->terms, of->stages) / (double)of->facts.particles;
}

/* Of a run as it is built. */
static void declare(const struct solver_run *run, const struct solver_scene *scene, struct verify_cost_case *of)
{
    of->facts = solver_run_facts(run);
    of->stages = solver_integrator_find(scene->integrator)->stages;
    solver_run_cost(run, &of->arrays, &of->terms);
    double particles = (double)of->facts.particles;
    of->flops = solver_cost_flops(&of->terms, of->stages) / particles;
    of->bytes = (double)solver_cost_total(&of->arrays) / particles;
}

/* Of a case whose scene was opened. The run is the caller's to free. */
static void measure(struct solver_scene *scene, struct verify_cost_case *of, struct solver_run **run)
{
    double seconds = NAN;
    of->seconds = NAN;
    of->runs = verify_run_create(scene, run, &of->why);
    if (of->runs) {
        declare(*run, scene, of);
        of->runs = verify_time_steps(*run, &seconds, &of->why);
        of->seconds = of->runs ? seconds / (double)of->facts.particles : NAN;
        declare_operations(*run, of); /* iterations are now known */
    }
}

/* Other programs may take the core for a while: the whole scene is timed again beside each variant. */
static void measure_without(const struct verify_options *options, struct solver_run *whole,
                            struct verify_cost_item *item)
{
    struct solver_run *run = NULL;
    double seconds;
    char room[2 * SOLVER_TEXT];
    struct solver_scene *scene = NULL;
    item->without = (struct verify_cost_case){.seconds = NAN};
    if (!open_with(options, item->words != NULL ? item->words : "", room, &scene, &item->without.why)) {
        return;
    }
    if (item->words == NULL) {
        solver_scene_forget(scene, SOLVER_MATERIAL_AT);
    }
    item->beside = verify_time_steps(whole, &seconds, &item->without.why)
                       ? seconds / (double)solver_run_facts(whole).particles
                       : NAN;
    measure(scene, &item->without, &run);
    solver_run_free(run);
    solver_scene_free(scene);
}

struct until {
    size_t steps, rows;
    const struct solver_run *run;
};

static bool stop_after(void *context, double time, double t_end, size_t step)
{
    const struct until *until = context;
    (void)time;
    (void)t_end;
    return step < until->steps;
}

/* Seconds of some steps with so many rows of history over t_end; also how many were noted. */
static bool time_history(const struct verify_options *options, const char *words, struct until *until, double *seconds)
{
    char room[2 * SOLVER_TEXT];
    struct solver_scene *scene = NULL;
    struct solver_run *run = NULL;
    struct solver_error error;
    bool done = open_with(options, words, room, &scene, &error) && verify_run_create(scene, &run, &error);
    int threads = done ? solver_run_facts(run).threads : 1;
    double begun = verify_clock(threads);
    done = done && solver_run_to(run, scene->t_end, stop_after, until, &error);
    if (done) {
        *seconds = verify_clock(threads) - begun;
        until->rows = solver_run_history(run)->count;
    }
    solver_run_free(run);
    solver_scene_free(scene);
    return done;
}

/* Rows are timed as the difference between the same steps with as many rows as can be, and with the first alone. */
static void measure_history(const struct verify_options *options, struct verify_cost *cost)
{
    enum { STEPS = 20 };
    struct until every = {.steps = STEPS};
    struct until first = {.steps = STEPS};
    double most = INFINITY;
    double least = INFINITY;
    size_t probes = cost->scene->probe_count;
    double step = cost->whole.facts.step;
    cost->steps = ceil(cost->scene->t_end / step);
    cost->rows = 1.0 + fmin(cost->scene->history, cost->steps);
    cost->row_bytes = (double)(sizeof(struct solver_totals) + 6 * probes * sizeof(double));
    cost->row_seconds = NAN;
    for (int sample = 0; sample < 3; sample++) {
        if (verify_signals_asked() != 0) {
            return;
        }
        double with = NAN;
        double without = NAN;
        if (!time_history(options, "history=100000", &every, &with) ||
            !time_history(options, "history=1", &first, &without) || every.rows <= first.rows) {
            return;
        }
        most = fmin(most, with);
        least = fmin(least, without);
    }
    cost->row_seconds = fmax(0.0, most - least) / (double)(every.rows - first.rows);
}

/* The whole, then it without each of its parts, then its history. A signal lets the item at hand be the last. */
static bool measure_all(const struct verify_options *options, struct verify_cost *cost, struct solver_error *error)
{
    struct solver_run *whole = NULL;
    measure(cost->scene, &cost->whole, &whole);
    if (!cost->whole.runs) {
        *error = cost->whole.why;
        solver_run_free(whole);
        return false;
    }
    for (size_t i = 0; i < sizeof parts / sizeof *parts && verify_signals_asked() == 0; i++) {
        if (parts[i].there(cost->scene)) {
            struct verify_cost_item *item = &cost->item[cost->item_count++];
            item->name = parts[i].name;
            item->words = parts[i].words;
            measure_without(options, whole, item);
        }
    }
    solver_run_free(whole);
    measure_history(options, cost);
    return true;
}

bool verify_cost_measure(const struct verify_options *options, struct verify_cost *cost, struct solver_error *error)
{
    char room[2 * SOLVER_TEXT];
    *cost = (struct verify_cost){.scene = NULL};
    if (!open_with(options, "", room, &cost->scene, error)) {
        return false;
    }
    verify_signals_watch();
    bool done = measure_all(options, cost, error);
    verify_signals_leave();
    cost->stopped = verify_signals_asked();
    return done;
}

void verify_cost_free(struct verify_cost *cost)
{
    solver_scene_free(cost->scene);
    *cost = (struct verify_cost){.scene = NULL};
}
