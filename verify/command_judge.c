#include "verify/commands.h"
#include "verify/files.h"
#include "verify/judge.h"
#include "verify/report.h"
#include "verify/told.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All that a judgement needs. */
struct work {
    const struct verify_options *options;
    struct verify_truth truth;
    struct verify_samples samples;
    struct verify_judgement judgement;
};

/* One value for each level, or one for all of them where `one_for_all`. */
static bool take_list(const struct work *work, const char *name, const char *text, bool one_for_all,
                      double value[VERIFY_SAMPLES], struct solver_error *error)
{
    size_t count = 0;
    for (size_t i = 0; i < VERIFY_SAMPLES; i++) {
        value[i] = NAN;
    }
    if (text == NULL) {
        return true;
    }
    if (!verify_told_numbers(name, text, value, VERIFY_SAMPLES, &count, error)) {
        return false;
    }
    if (count == 1 && one_for_all) {
        for (count = 1; count < work->samples.count; count++) {
            value[count] = value[0];
        }
    }
    return count == work->samples.count ||
           solver_fail(error, SOLVER_BAD_INPUT, "%s %.200s: %zu values, expected one for each of %zu levels", name,
                       text, count, work->samples.count);
}

static bool compare(struct work *work, struct solver_error *error)
{
    struct verify_judgement *judgement = &work->judgement;
    double time[VERIFY_SAMPLES], h[VERIFY_SAMPLES];
    if (!take_list(work, "--time", work->options->times, true, time, error) ||
        !take_list(work, "--spacing", work->options->spacings, false, h, error)) {
        return false;
    }
    for (size_t i = 0; i < work->samples.count; i++) {
        if (!isnan(h[i]) && !(h[i] > 0)) {
            return solver_fail(error, SOLVER_BAD_INPUT, "--spacing %.200s: expected spacings above 0",
                               work->options->spacings);
        }
        if (!verify_judge_level(&work->truth, work->samples.sample[i], time[i], h[i], &judgement->level[i], error)) {
            return false;
        }
        judgement->level_count++;
    }
    return verify_judge_order(judgement, error);
}

static bool judge(struct work *work, struct solver_error *error)
{
    const struct verify_options *options = work->options;
    struct verify_judgement *judgement = &work->judgement;
    return compare(work, error) &&
           verify_judge_gates(judgement, options->gate.text, options->gate.count, false, error) &&
           verify_judge_gates(judgement, options->order.text, options->order.count, true, error) &&
           verify_judge_shown(judgement, options->norm.text, options->norm.count, error);
}

/* Two verify_writers. */
static bool write_json(FILE *file, const void *context, struct solver_error *error)
{
    (void)error;
    verify_judge_json(file, context);
    return true;
}

static bool write_html(FILE *file, const void *context, struct solver_error *error)
{
    (void)error;
    verify_judge_html(file, context);
    return true;
}

static bool write_reports(const struct work *work, struct solver_error *error)
{
    const struct verify_judgement *judgement = &work->judgement;
    const struct verify_options *options = work->options;
    char html[VERIFY_PATH], json[VERIFY_PATH];
    if (options->json != NULL) {
        if (!verify_report_write(options->json, write_json, judgement, error)) {
            return false;
        }
        (void)printf("\nreport     %s\n", options->json);
    }
    if (options->out == NULL) {
        return true;
    }
    if (!verify_folder_make(options->out, error) || !verify_path_join(html, options->out, "report", ".html", error) ||
        !verify_path_join(json, options->out, "report", ".json", error) ||
        !verify_report_write(html, write_html, judgement, error) ||
        !verify_report_write(json, write_json, judgement, error)) {
        return false;
    }
    (void)printf("\nreport     %s\n           %s\n", html, json);
    return true;
}

/* *passed: the oracle proves itself and no gate fails. */
static bool run(struct work *work, bool *passed, struct solver_error *error)
{
    const struct verify_options *options = work->options;
    struct verify_judgement *judgement = &work->judgement;
    if (options->oracle == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "assay judge wants --oracle NAME; assay list oracles shows what can judge");
    }
    for (size_t i = 0; i < options->operand_count; i++) {
        if (!verify_sample_read(options->operand[i], &work->samples, error)) {
            return false;
        }
    }
    if (!verify_told_oracle(options->oracle, options, &work->truth, error)) {
        return false;
    }
    judgement->truth = &work->truth;
    judgement->command = options->line;
    if (work->truth.proven && !judge(work, error)) {
        return false;
    }
    verify_judge_terminal(stdout, judgement);
    *passed = work->truth.proven && (judgement->gates.count == 0 || judgement->gates.pass);
    return write_reports(work, error);
}

int verify_command_judge(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct work *work = calloc(1, sizeof *work);
    if (work == NULL) {
        (void)solver_fail(&error, SOLVER_NO_MEMORY, "no memory for a judgement");
        return verify_complain(&error);
    }
    work->options = options;
    bool passed = false;
    bool done = run(work, &passed, &error);
    verify_samples_free(&work->samples);
    verify_truth_free(&work->truth);
    free(work);
    if (!done) {
        return verify_complain(&error);
    }
    return passed ? VERIFY_PASSED : VERIFY_FAILED;
}
