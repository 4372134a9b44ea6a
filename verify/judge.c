#include "verify/judge.h"

#include "solver/suggest.h"
#include "verify/study.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double SAME_TIME = 1e-6; /* relative; times may have gone through single precision */

static bool match(const struct verify_judgement *judgement, size_t index, struct solver_error *error)
{
    const struct verify_judged_level *first = &judgement->level[0], *level = &judgement->level[index];
    const struct oracle_kind *kind = judgement->truth->kind;
    if (!(fabs(level->time - first->time) <= SAME_TIME * fmax(fabs(level->time), fabs(first->time)))) {
        return verify_sample_refuse(level->sample, error,
                                    "is of t = %.12g s, and %.200s of %.12g s; levels must be of one time", level->time,
                                    first->sample->place, first->time);
    }
    if (isnan(level->h) != isnan(first->h) || isnan(level->sample->h.value) != isnan(first->sample->h.value)) {
        return verify_sample_refuse(level->sample, error,
                                    "says of its spacing something else than %.200s does; expected h of all levels, or "
                                    "n of all, or --spacing",
                                    first->sample->place);
    }
    for (size_t field = 0; field < verify_judged_count(kind); field++) {
        if (level->known[field] != first->known[field]) {
            return verify_sample_refuse(level->known[field] ? first->sample : level->sample, error,
                                        "field %s is missing, or not all of its components are there; %.200s has it",
                                        verify_judged_field(kind, field).name,
                                        (level->known[field] ? level : first)->sample->place);
        }
    }
    return true;
}

static int coarse_first(const void *a, const void *b)
{
    const struct verify_judged_level *x = a, *y = b;
    return x->h > y->h ? -1 : x->h < y->h ? 1 : 0;
}

bool verify_judge_order(struct verify_judgement *judgement, struct solver_error *error)
{
    for (size_t i = 1; i < judgement->level_count; i++) {
        if (!match(judgement, i, error)) {
            return false;
        }
    }
    if (isnan(judgement->level[0].h)) {
        return true;
    }
    qsort(judgement->level, judgement->level_count, sizeof *judgement->level, coarse_first);
    for (size_t i = 1; i < judgement->level_count; i++) {
        struct verify_judged_level *level = &judgement->level[i], *before = level - 1;
        if (level->h == before->h) {
            return verify_sample_refuse(level->sample, error, "has the same spacing, %.9g m, as %.300s", level->h,
                                        before->sample->place);
        }
        for (size_t j = 0; j < VERIFY_JUDGED_ERRORS; j++) {
            level->rate[j] = verify_order(before->error[j], before->h, level->error[j], level->h);
        }
    }
    return true;
}

/* Fields of the judgement's files, or of the oracle, separated by commas. */
static void list_fields(const struct verify_judgement *judgement, bool known_only, char *text, size_t size)
{
    size_t used = 0;
    for (size_t field = 0; field < verify_judged_count(judgement->truth->kind) && used < size; field++) {
        if (!known_only || judgement->level[0].known[field]) {
            int added = snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "",
                                 verify_judged_field(judgement->truth->kind, field).name);
            used += added > 0 ? (size_t)added : 0;
        }
    }
}

static bool refuse_name(const struct verify_judgement *judgement, const char *name, struct solver_error *error)
{
    char fields[256] = "";
    list_fields(judgement, false, fields, sizeof fields);
    return solver_fail(
        error, SOLVER_BAD_INPUT,
        "--gate %.100s: there is no error of that name; there are %s, each also with _abs, _max, _abs_max "
        "or _l1, and \"rate \" before any of them",
        name, fields);
}

/* The error that a gate names must have been measured. */
static bool is_measured(const struct verify_judgement *judgement, const char *name, size_t which, bool is_rate,
                        struct solver_error *error)
{
    char fields[256] = "";
    if (!judgement->level[0].known[which / VERIFY_NORMS]) {
        list_fields(judgement, true, fields, sizeof fields);
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "%.300s: field %s is missing, or not all of its components are there, which --gate %.100s asks "
            "for; compared are %s",
            judgement->level[0].sample->place, verify_judged_field(judgement->truth->kind, which / VERIFY_NORMS).name,
            name, fields);
    }
    return !is_rate || judgement->level_count < 2 || !isnan(judgement->level[0].h) ||
           solver_fail(
               error, SOLVER_BAD_INPUT,
               "%.300s: does not say its spacing, without which there is no order; give h or n in the files, or "
               "--spacing",
               judgement->level[0].sample->place);
}

/* "rate P=1.8" */
static bool judge(struct verify_judgement *judgement, const char *text, bool rate, struct verify_gate *gate,
                  struct solver_error *error)
{
    const struct verify_judged_level *finest = &judgement->level[judgement->level_count - 1];
    const char *equals = strrchr(text, '=');
    char name[SOLVER_NAME];
    char *end = NULL;
    size_t length = equals != NULL ? (size_t)(equals - text) : 0;
    double bound = equals != NULL ? strtod(equals + 1, &end) : NAN;
    if (equals == NULL || end == equals + 1 || *end != '\0' || !isfinite(bound) || length + 6 > sizeof name) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--gate %.200s: expected NAME=number, as in P=1e-2", text);
    }
    (void)snprintf(name, sizeof name, "%s%.*s", rate ? "rate " : "", (int)length, text);
    bool is_rate = strncmp(name, "rate ", 5) == 0;
    size_t which = verify_judged_find(judgement->truth->kind, name + (is_rate ? 5 : 0));
    if (which == VERIFY_JUDGED_ERRORS) {
        return refuse_name(judgement, name, error);
    }
    if (!is_measured(judgement, name, which, is_rate, error)) {
        return false;
    }
    *gate = (struct verify_gate){.value = is_rate ? finest->rate[which] : finest->error[which],
                                 .bound = bound,
                                 .op = is_rate ? ">=" : "<=",
                                 .unit = is_rate ? "-" : verify_judged_unit(judgement->truth->kind, which)};
    gate->why = is_rate ? verify_why_no_order(finest->rate[which], finest->error[which], judgement->level_count > 1)
                        : verify_why_no_error(finest->error[which]);
    (void)snprintf(gate->name, sizeof gate->name, "%s", name);
    gate->pass = verify_gate_judge(gate->value, gate->op, gate->bound);
    return true;
}

bool verify_judge_gates(struct verify_judgement *judgement, const char *const *text, size_t count, bool rates,
                        struct solver_error *error)
{
    struct verify_gates *gates = &judgement->gates;
    for (size_t i = 0; i < count; i++) {
        if (gates->count == VERIFY_GATES) {
            return solver_fail(error, SOLVER_BAD_INPUT, "--gate: more than %d gates", (int)VERIFY_GATES);
        }
        struct verify_gate *gate = &gates->gate[gates->count];
        if (!judge(judgement, text[i], rates, gate, error)) {
            return false;
        }
        gates->pass = (gates->count == 0 || gates->pass) && gate->pass;
        gates->count++;
    }
    return true;
}

static bool norm_called(const char *name, bool wanted[VERIFY_NORMS], struct solver_error *error)
{
    for (size_t i = 0; i < VERIFY_NORMS; i++) {
        const char *suffix = verify_norm_suffix(i);
        if (strcmp(name, suffix[0] == '\0' ? "l2" : suffix + 1) == 0) {
            wanted[i] = true;
            return true;
        }
    }
    return solver_fail(error, SOLVER_BAD_INPUT, "--norm %.60s: expected l2, l1, max, abs or abs_max", name);
}

bool verify_judge_shown(struct verify_judgement *judgement, const char *const *norm, size_t count,
                        struct solver_error *error)
{
    const struct oracle_kind *kind = judgement->truth->kind;
    bool wanted[VERIFY_NORMS] = {count == 0};
    bool gated[VERIFY_JUDGED_ERRORS + 1] = {false};
    for (size_t i = 0; i < count; i++) {
        if (!norm_called(norm[i], wanted, error)) {
            return false;
        }
    }
    for (size_t i = 0; i < judgement->gates.count; i++) {
        const char *name = judgement->gates.gate[i].name;
        gated[verify_judged_find(kind, name + (strncmp(name, "rate ", 5) == 0 ? 5 : 0))] = true;
    }
    for (size_t i = 0; i < VERIFY_NORMS * verify_judged_count(kind); i++) {
        if (gated[i] || (wanted[i % VERIFY_NORMS] && judgement->level[0].known[i / VERIFY_NORMS])) {
            judgement->shown[judgement->shown_count++] = i;
        }
    }
    return true;
}

const char *verify_judge_verdict(const struct verify_judgement *judgement)
{
    return judgement->gates.count == 0 ? "NOT JUDGED: no gate was given, so nothing was asked"
           : judgement->gates.pass     ? "PASS: all gates hold"
                                       : "FAIL: a gate does not hold";
}
