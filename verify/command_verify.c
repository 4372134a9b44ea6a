#include "verify/commands.h"
#include "verify/figures.h"
#include "verify/find.h"
#include "verify/picture.h"
#include "verify/report.h"
#include "verify/simulate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All that a study needs while it runs. */
struct work {
    const struct verify_options *options;
    struct solver_scene *scene; /* of the level at hand */
    struct verify_truth truth;
    struct verify_beside beside;
    struct verify_study study;
    char folder[VERIFY_PATH];
    size_t level_count;
    int level[SOLVER_LEVELS];
    struct verify_level level_now; /* the one that is run */
    size_t shown_count;
    size_t shown[VERIFY_ERRORS];
};

static bool choose_levels(struct work *work, struct solver_error *error)
{
    bool given = work->options->level_count > 0;
    work->level_count = given ? work->options->level_count : work->scene->level_count;
    memcpy(work->level, given ? work->options->level : work->scene->levels, work->level_count * sizeof *work->level);
    return work->level_count > 0 ||
           solver_fail(error, SOLVER_BAD_INPUT, "%s: the scene has no levels; give --levels 4,8,16", work->scene->path);
}

/* Renders the record's picture and, where there is an oracle, the exact one beside it. */
static bool draw(struct work *work, struct solver_error *error)
{
    const struct solver_scene *scene = work->scene;
    struct solver_view view; /* of both pictures */
    struct verify_study *study = &work->study;
    struct solver_record *record = NULL;
    char title[SOLVER_TEXT + 16];
    (void)snprintf(title, sizeof title, "%s, exact", scene->title);
    if (!solver_record_read(study->record, &record, error)) {
        return false;
    }
    bool done = verify_picture_view(record, scene->has_view ? &scene->view : NULL, &view, error) &&
                verify_path_join(study->picture, work->folder, scene->name, ".png", error) &&
                verify_picture_write(study->picture, record, &view, scene->title, study->record, error);
    if (done && !work->truth.none) {
        verify_picture_exact(record, work->truth.kind, work->truth.oracle);
        done = verify_path_join(study->exact_picture, work->folder, scene->name, ".exact.png", error) &&
               verify_picture_write(study->exact_picture, record, &view, title, study->record, error);
    }
    solver_record_free(record);
    return done;
}

/* A verify_take. */
static bool take(void *context, struct solver_run *run, struct solver_error *error)
{
    struct work *work = context;
    return verify_level_snapshot(&work->level_now, run, work->truth.kind, work->truth.oracle, error);
}

/* Errors, figures and indicators of a finished run. */
static bool measure(struct work *work, struct solver_run *run, struct solver_error *error)
{
    const struct solver_history *history = solver_run_history(run);
    struct verify_level *level = &work->level_now;
    struct solver_output output;
    return solver_run_output(run, &output, error) &&
           verify_level_measure(level, work->scene, run, &output, &work->truth, error) &&
           verify_beside_measure(&work->beside, history, level->error, error) &&
           verify_indicators_measure(work->scene, &output, history, &level->facts, level->indicator, error);
}

/* What is kept of the finest level alone. */
static bool keep_finest(struct work *work, struct solver_run *run, struct solver_error *error)
{
    const struct solver_scene *scene = work->scene;
    return verify_study_history(&work->study, solver_run_history(run), error) &&
           (work->beside.scene == NULL || verify_motion_take(solver_run_history(run), &work->study.motion, error)) &&
           verify_record(scene, run, work->folder, scene->name, work->options->line, work->study.record, error) &&
           draw(work, error);
}

/* Runs one level and adds it to the study; keeps record and pictures of the finest. */
static bool run_level(struct work *work, size_t index, struct solver_error *error)
{
    struct solver_run *run = NULL;
    work->level_now = (struct verify_level){.n = work->level[index]};
    bool done = verify_simulate(work->scene, work->folder, work->options->line, work->truth.none ? NULL : take, work,
                                &run, error) &&
                measure(work, run, error);
    if (done) {
        verify_study_add(&work->study, &work->level_now);
        verify_terminal_level(stdout, &work->study, work->shown, work->shown_count);
        done = index + 1 < work->level_count || keep_finest(work, run, error);
    } else {
        verify_level_free(&work->level_now);
    }
    solver_run_free(run);
    return done;
}

static bool open_level(struct work *work, int n, struct solver_error *error)
{
    solver_scene_free(work->scene);
    work->scene = NULL;
    bool opened = verify_scene_open(work->options, n, &work->scene, error);
    work->study.scene = work->scene;
    return opened;
}

/* The other configuration first, so that every level can be compared with it. */
static bool run_beside(struct work *work, struct solver_error *error)
{
    return work->beside.scene == NULL || verify_beside_run(&work->beside, work->folder, work->options->line, error);
}

static bool run_levels(struct work *work, struct solver_error *error)
{
    if (!run_beside(work, error)) {
        return false;
    }
    for (size_t i = 0; i < work->level_count; i++) {
        if (!open_level(work, work->level[i], error) || !run_level(work, i, error)) {
            return false;
        }
    }
    return verify_study_judge(&work->study, error);
}

/* Two verify_writers. */
static bool write_json(FILE *file, const void *context, struct solver_error *error)
{
    const struct work *work = context;
    (void)error;
    verify_json(file, &work->study);
    return true;
}

static bool write_html(FILE *file, const void *context, struct solver_error *error)
{
    const struct work *work = context;
    return verify_html(file, &work->study, work->shown, work->shown_count, error);
}

static bool write_reports(const struct work *work, struct solver_error *error)
{
    char html[VERIFY_PATH], json[VERIFY_PATH];
    if (!verify_path_join(html, work->folder, "report", ".html", error) ||
        !verify_path_join(json, work->folder, "report", ".json", error) ||
        !verify_report_write(html, write_html, work, error) || !verify_report_write(json, write_json, work, error) ||
        (work->options->json != NULL && !verify_report_write(work->options->json, write_json, work, error))) {
        return false;
    }
    (void)printf("\nreport     %s\n           %s\n", html, json);
    if (work->options->json != NULL) {
        (void)printf("           %s\n", work->options->json);
    }
    if (work->study.record[0] != '\0') {
        (void)printf("record     %s\npicture    %s\n", work->study.record, work->study.picture);
    }
    if (work->study.exact_picture[0] != '\0') {
        (void)printf("exact      %s\n", work->study.exact_picture);
    }
    return true;
}

/* A level that cannot be had, because it asks for too much memory for instance, is refused before the first is run. */
static bool open_all_levels(struct work *work, struct solver_error *error)
{
    for (size_t i = 0; i < work->level_count; i++) {
        if (!open_level(work, work->level[i], error)) {
            return false;
        }
    }
    return true;
}

static bool choose_shown(struct work *work, struct solver_error *error)
{
    bool chosen = verify_shown(work->scene, work->shown, &work->shown_count, error);
    while (chosen && work->beside.scene == NULL && work->shown_count > 0 &&
           !verify_error_has_order(work->shown[work->shown_count - 1])) {
        work->shown_count--; /* nothing is run beside */
    }
    return chosen;
}

/* The whole study; *passed says whether nothing it judged failed. */
static bool study(struct work *work, bool *passed, struct solver_error *error)
{
    if (!verify_refuse_n(work->options, verify_by_levels, error) || !open_level(work, 0, error) ||
        !choose_levels(work, error) || !open_all_levels(work, error) || !verify_picture_check(work->scene, error) ||
        !verify_truth_open(work->scene, &work->truth, error) ||
        !verify_beside_open(work->options, work->scene, &work->beside, error)) {
        return false;
    }
    work->study.truth = &work->truth;
    work->study.beside = &work->beside;
    /* the gates by what is measured so far, nothing: one that names what there is not is refused before the first run
     */
    if (!choose_shown(work, error) || !verify_figures_check(work->scene, &work->truth, error) ||
        !verify_gates_judge(work->scene, &work->level_now, &work->study.gates, error) ||
        !verify_out_folder(work->options, work->scene->name, work->folder, error) ||
        (work->options->json != NULL && !verify_file_check(work->options->json, error))) {
        return false;
    }
    work->study.gates = (struct verify_gates){.count = 0};
    verify_terminal_begin(stdout, &work->study, work->shown, work->shown_count);
    if (work->truth.proven) {
        if (!run_levels(work, error)) {
            return false;
        }
        verify_terminal_end(stdout, &work->study, work->shown, work->shown_count);
    }
    *passed = work->truth.proven && (work->study.gates.count == 0 || work->study.gates.pass);
    return write_reports(work, error);
}

int verify_command_verify(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    if (options->mutations) {
        return verify_command_mutations(options);
    }
    if (strcmp(options->operand[0], "mms") == 0) {
        return verify_command_mms(options);
    }
    if (options->operand_count > 1) {
        struct solver_error many;
        (void)solver_fail(&many, SOLVER_BAD_INPUT, "verify: one scene at a time; \"%.64s\" is one word too many",
                          options->operand[1]);
        return verify_complain(&many);
    }
    struct work *work = calloc(1, sizeof *work);
    if (work == NULL) {
        (void)solver_fail(&error, SOLVER_NO_MEMORY, "no memory for a study");
        return verify_complain(&error);
    }
    work->options = options;
    bool passed = false;
    bool done = study(work, &passed, &error);
    verify_study_free(&work->study);
    verify_truth_free(&work->truth);
    verify_beside_free(&work->beside);
    solver_scene_free(work->scene);
    free(work);
    if (!done) {
        return verify_complain(&error);
    }
    return passed ? VERIFY_PASSED : VERIFY_FAILED;
}
