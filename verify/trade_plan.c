/* Which configurations a study of costs runs. */
#include "verify/gates.h"
#include "verify/trade.h"

#include "solver/scheme.h"
#include "solver/stencil.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Runs that differ in one of these are of different kinds: one that loses at a coarse level may win at a fine one. */
static const char *const kinds[] = {"scheme", "stencil", "precision", "integrator"};

/* A configuration as it grows: what each axis has, NULL where the scene's own value. */
struct choice {
    const struct solver_scene *scene;
    const struct verify_trade *trade;
    const char *value[VERIFY_TRADE_AXES];
};

/* The value of a key, chosen or the scene's own. */
static void value_of(const struct choice *choice, const char *key, char out[SOLVER_TEXT])
{
    out[0] = '\0';
    for (size_t i = 0; i < choice->trade->axis_count; i++) {
        if (strcmp(choice->trade->axis[i].key, key) == 0 && choice->value[i] != NULL) {
            (void)snprintf(out, SOLVER_TEXT, "%s", choice->value[i]);
            return;
        }
    }
    (void)solver_scene_text(choice->scene, key, out, SOLVER_TEXT);
}

/* Whether a key changes anything: those of a stencil do for schemes that stand on one, those named after a scheme for
 * that alone. Stencils along lattice lines have no support. */
static bool matters(const struct choice *choice, const char *key)
{
    static const char *const of_stencils[] = {"stencil", "evolved", "reconstruction", "volume_flux"};
    char name[SOLVER_TEXT], builder_name[SOLVER_TEXT];
    value_of(choice, "scheme", name);
    value_of(choice, "stencil", builder_name);
    const struct solver_scheme *scheme = solver_scheme_find(name);
    const struct solver_stencil_builder *builder = solver_stencil_find(builder_name);
    bool on_stencil = scheme == NULL || scheme->stencil;
    size_t prefix = strcspn(key, ".");
    for (size_t i = 0; i < sizeof of_stencils / sizeof *of_stencils; i++) {
        if (strcmp(of_stencils[i], key) == 0) {
            return on_stencil;
        }
    }
    if (strcmp(key, "support") == 0) {
        return !on_stencil || builder == NULL || !builder->lattice_only;
    }
    return key[prefix] == '\0' || (strlen(name) == prefix && strncmp(name, key, prefix) == 0);
}

/* The same of keys of incompressible bodies: all but the solver itself need one. */
static bool matters_to_pressure(const struct choice *choice, const char *key)
{
    char scheme[SOLVER_TEXT], solver[SOLVER_TEXT];
    value_of(choice, "scheme", scheme);
    value_of(choice, "incompressible.solver", solver);
    return strcmp(scheme, "upwind") == 0 && (strcmp(key, "incompressible.solver") == 0 || strcmp(solver, "none") != 0);
}

/* The words of a choice, and in how many it differs from the scene's own. */
static bool spell(const struct choice *choice, struct verify_trade_run *run)
{
    size_t used = 0;
    run->words[0] = '\0';
    for (size_t i = 0; i < choice->trade->axis_count && used < VERIFY_TRADE_WORDS; i++) {
        const char *key = choice->trade->axis[i].key;
        bool of_pressure = strncmp(key, "incompressible.", 15) == 0;
        if (of_pressure ? matters_to_pressure(choice, key) : matters(choice, key)) {
            char own[SOLVER_TEXT] = "", value[SOLVER_TEXT];
            (void)solver_scene_text(choice->scene, key, own, sizeof own);
            value_of(choice, key, value);
            run->distance += !verify_same_value(value, own);
            used += (size_t)snprintf(run->words + used, VERIFY_TRADE_WORDS - used, "%s%s=%s", used > 0 ? " " : "", key,
                                     value);
        }
    }
    return used < VERIFY_TRADE_WORDS;
}

static struct verify_trade_run *next_run(struct verify_trade *trade, struct solver_error *error)
{
    if (!verify_trade_reserve(trade, 1, error)) {
        return NULL;
    }
    struct verify_trade_run *run = &trade->run[trade->run_count];
    *run = (struct verify_trade_run){.order = trade->run_count, .end = VERIFY_LEFT_OUT, .noise = NAN};
    trade->run_count++;
    return run;
}

/* Adds a choice unless it is there already: another may differ from it in keys alone that do not matter. */
static bool add_choice(const struct choice *choice, const char *variant, struct verify_trade *trade,
                       struct solver_error *error)
{
    struct verify_trade_run *run = next_run(trade, error);
    if (run == NULL) {
        return false;
    }
    run->n = trade->level[0];
    run->distance = variant[0] != '\0';
    (void)snprintf(run->variant, sizeof run->variant, "%s", variant);
    if (!spell(choice, run)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "too many keys vary to spell a configuration");
    }
    run->own = run->distance == 0;
    for (size_t i = 0; i + 1 < trade->run_count; i++) {
        if (strcmp(trade->run[i].words, run->words) == 0 && strcmp(trade->run[i].variant, variant) == 0) {
            trade->run_count--;
            break;
        }
    }
    return true;
}

static int compare_distance(const void *a, const void *b)
{
    const struct verify_trade_run *one = a, *other = b;
    return one->distance != other->distance ? (one->distance > other->distance) - (one->distance < other->distance)
                                            : (one->order > other->order) - (one->order < other->order);
}

bool verify_trade_plan(const struct solver_scene *scene, struct verify_trade *trade, struct solver_error *error)
{
    struct choice choice = {.scene = scene, .trade = trade};
    double all = 1.0 + (double)scene->variant_count;
    size_t digit[VERIFY_TRADE_AXES] = {0}, axis = 0;
    for (size_t i = 0; i < trade->axis_count; i++) {
        all *= (double)trade->axis[i].count;
    }
    if (all > 1e6) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%.3g combinations: fix some keys by --set or --vary", all);
    }
    bool added = add_choice(&choice, "", trade, error); /* the scene's own, whatever --vary leaves out */
    while (added && axis < trade->axis_count) {
        for (size_t i = 0; i < trade->axis_count; i++) {
            choice.value[i] = trade->axis[i].value[digit[i]];
        }
        added = add_choice(&choice, "", trade, error);
        for (size_t i = 0; added && i < scene->variant_count; i++) {
            added = add_choice(&choice, scene->variant[i].name, trade, error);
        }
        for (axis = 0; axis < trade->axis_count && ++digit[axis] == trade->axis[axis].count; axis++) {
            digit[axis] = 0;
        }
    }
    qsort(trade->run, trade->run_count, sizeof *trade->run, compare_distance);
    return added;
}

static bool same_kind(const struct verify_trade_run *one, const struct verify_trade_run *other)
{
    bool same = strcmp(one->variant, other->variant) == 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        char a[SOLVER_NAME] = "", b[SOLVER_NAME] = "";
        (void)verify_trade_word(one->words, kinds[i], a);
        (void)verify_trade_word(other->words, kinds[i], b);
        same = same && strcmp(a, b) == 0;
    }
    return same;
}

/* Whether `other` is as good or better in error, pairs and bytes. */
static bool beats(const struct verify_trade *trade, const struct verify_trade_run *other,
                  const struct verify_trade_run *run)
{
    size_t e = trade->chosen;
    if (other == run || other->end != VERIFY_MEASURED) {
        return false;
    }
    bool as_good = other->error[e] <= run->error[e] && other->cost[VERIFY_PAIRS] <= run->cost[VERIFY_PAIRS] &&
                   other->cost[VERIFY_BYTES] <= run->cost[VERIFY_BYTES];
    bool less = other->error[e] < run->error[e] || other->cost[VERIFY_PAIRS] < run->cost[VERIFY_PAIRS] ||
                other->cost[VERIFY_BYTES] < run->cost[VERIFY_BYTES];
    return as_good && (less || other < run);
}

static int compare_rank(const void *a, const void *b)
{
    const struct verify_trade_run *one = a, *other = b;
    if (one->own != other->own) {
        return other->own - one->own;
    }
    return one->rank != other->rank ? (one->rank > other->rank) - (one->rank < other->rank) : compare_distance(a, b);
}

/* Of the run at the level before, what becomes of it at the next: how many beat it, and one of its kind that does. */
static void look_back(const struct verify_trade *trade, const struct verify_trade_run *before, size_t from, size_t to,
                      struct verify_trade_run *run)
{
    const struct verify_trade_run *best = NULL;
    run->rank = 0;
    for (size_t i = from; i < to; i++) {
        const struct verify_trade_run *other = &trade->run[i];
        if (before->end == VERIFY_MEASURED && beats(trade, other, before)) {
            run->rank++;
            best = best == NULL && same_kind(other, before) ? other : best;
        }
    }
    if (best != NULL && !run->own) {
        (void)snprintf(run->why, sizeof run->why, "beaten at n = %d by another of its kind", before->n);
        (void)snprintf(run->by, sizeof run->by, "%s", best->words);
    }
}

bool verify_trade_promote(struct verify_trade *trade, size_t level, struct solver_error *error)
{
    size_t to = trade->run_count, from = to;
    while (from > 0 && trade->run[from - 1].n == trade->level[level - 1]) {
        from--;
    }
    if (!verify_trade_reserve(trade, to - from, error)) { /* so that none moves below */
        return false;
    }
    for (size_t i = from; i < to; i++) {
        const struct verify_trade_run *before = &trade->run[i];
        bool refused = before->end == VERIFY_REFUSED; /* which may be for want of particles */
        if (before->end != VERIFY_MEASURED && !refused) {
            continue; /* what broke down or was left out has said so at its level */
        }
        struct verify_trade_run *run = next_run(trade, error);
        if (run == NULL) {
            return false;
        }
        size_t order = run->order;
        *run = *before;
        run->order = order;
        run->n = trade->level[level];
        run->end = VERIFY_LEFT_OUT;
        run->why[0] = '\0';
        run->by[0] = '\0';
        look_back(trade, before, from, to, run);
    }
    qsort(trade->run + to, trade->run_count - to, sizeof *trade->run, compare_rank);
    return true;
}

bool verify_trade_configure(const struct solver_scene *scene, const struct verify_trade_run *run,
                            char store[VERIFY_TRADE_STORE], struct verify_options *options, struct solver_error *error)
{
    const struct solver_settings *settings = NULL;
    size_t used = (size_t)snprintf(store, VERIFY_TRADE_WORDS, "%s", run->words) + 1;
    for (size_t i = 0; i < scene->variant_count; i++) {
        settings = strcmp(scene->variant[i].name, run->variant) == 0 ? &scene->variant[i].settings : settings;
    }
    if (run->variant[0] != '\0' && settings == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: the scene's key trade has no \"%s\"", scene->path,
                           run->variant);
    }
    size_t wanted = settings == NULL ? 0 : settings->count;
    for (const char *c = run->words; *c != '\0'; c++) {
        wanted += *c == '=';
    }
    if (options->override_count + wanted + 2 > VERIFY_OVERRIDES) { /* n and threads come too */
        return solver_fail(error, SOLVER_BAD_INPUT, "too many --set beside the keys that the study varies");
    }
    for (size_t i = 0; settings != NULL && i < settings->count; i++) {
        options->override[options->override_count++] = store + used;
        used += (size_t)snprintf(store + used, 2 * SOLVER_NAME, "%s=%s", settings->key[i], settings->text[i]) + 1;
    }
    char *rest = NULL;
    for (char *word = strtok_r(store, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        options->override[options->override_count++] = word;
    }
    return true;
}
