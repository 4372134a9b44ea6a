#include "verify/judge.h"
#include "verify/terminal.h"

#include <math.h>
#include <string.h>

static void print_parameters(FILE *file, const struct verify_truth *truth)
{
    (void)fprintf(file, "\n  %-24s %16s\n", "parameter", "value");
    for (size_t i = 0; i < truth->parameter_count; i++) {
        const struct oracle_parameter *parameter = &truth->kind->parameter[i];
        (void)fprintf(file, "  %-24s %16.10g %-10s %s\n", parameter->name, truth->value[i], parameter->unit,
                      parameter->help);
    }
}

static void print_head(FILE *file, const struct verify_judgement *judgement)
{
    const struct oracle_kind *kind = judgement->truth->kind;
    char name[VERIFY_JUDGED_NAME], meaning[VERIFY_JUDGED_MEANING];
    (void)fprintf(file, "\nerrors at t = %.6g s:\n", judgement->level[0].time);
    for (size_t i = 0; i < judgement->shown_count; i++) {
        (void)fprintf(file, "  %-16s %s [%s]\n", verify_judged_name(kind, judgement->shown[i], name),
                      verify_judged_meaning(kind, judgement->shown[i], meaning),
                      verify_judged_unit(kind, judgement->shown[i]));
    }
    (void)fprintf(file, "\n%5s %10s %9s", "n", "h", "points");
    for (size_t i = 0; i < judgement->shown_count; i++) {
        (void)verify_judged_name(kind, judgement->shown[i], name);
        (void)fprintf(file, " | %-*s %5s", verify_width_of(name), name, "order");
    }
    (void)fprintf(file, "   file\n%5s %10s %9s", "", "[m]", "");
    for (size_t i = 0; i < judgement->shown_count; i++) {
        const char *unit = verify_judged_unit(kind, judgement->shown[i]);
        int width = verify_width_of(verify_judged_name(kind, judgement->shown[i], name)) + 6;
        (void)fprintf(file, " | [%s]%*s", unit, width - 2 - (int)strlen(unit), "");
    }
    (void)fprintf(file, "\n");
}

static void print_level(FILE *file, const struct verify_judgement *judgement, const struct verify_judged_level *level)
{
    char name[VERIFY_JUDGED_NAME], text[32];
    char n[16] = "-", h[16] = "-";
    if (level->sample->n > 0) {
        (void)snprintf(n, sizeof n, "%d", level->sample->n);
    }
    if (!isnan(level->h)) {
        (void)snprintf(h, sizeof h, "%.4g", level->h);
    }
    (void)fprintf(file, "%5s %10s %9zu", n, h, level->sample->count);
    for (size_t i = 0; i < judgement->shown_count; i++) {
        size_t which = judgement->shown[i];
        (void)fprintf(file, " | %-*s", verify_width_of(verify_judged_name(judgement->truth->kind, which, name)),
                      verify_scientific(text, level->error[which]));
        (void)fprintf(file, " %5s", verify_order_text(text, level->rate[which]));
    }
    (void)fprintf(file, "   %s\n", level->sample->place);
}

static void print_notes(FILE *file, const struct verify_judgement *judgement)
{
    const struct verify_judged_level *finest = &judgement->level[judgement->level_count - 1];
    bool unweighted = false, assumed = false, counted = false;
    for (size_t i = 0; i < judgement->level_count; i++) {
        const struct verify_judged_level *level = &judgement->level[i];
        unweighted = unweighted || level->sample->weight == NULL;
        assumed = assumed || level->assumed > 0;
        counted = counted || (isnan(level->sample->h.value) && level->sample->n > 0);
    }
    (void)fprintf(file, "%s%s%s%s", unweighted ? "\nno weights are given: every point counts the same\n" : "",
                  assumed ? "\nunits are missing: SI units are assumed\n" : "",
                  counted ? "\nno spacings are given: orders are over 1/n\n" : "",
                  isnan(finest->h) ? "\nneither spacings nor n are given: no order was observed\n" : "");
    if (finest->ignored[0] != '\0') {
        (void)fprintf(file, "\nnot compared: %s\n", finest->ignored);
    }
}

void verify_judge_terminal(FILE *file, const struct verify_judgement *judgement)
{
    verify_print_truth(file, judgement->truth);
    print_parameters(file, judgement->truth);
    if (!judgement->truth->proven) {
        return;
    }
    print_head(file, judgement);
    for (size_t i = 0; i < judgement->level_count; i++) {
        print_level(file, judgement, &judgement->level[i]);
    }
    print_notes(file, judgement);
    if (judgement->gates.count > 0) {
        verify_print_gates(file, &judgement->gates);
    } else {
        (void)fprintf(file, "\n");
    }
    (void)fprintf(file, "%s\n", verify_judge_verdict(judgement));
}
