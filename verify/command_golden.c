#include "golden/golden.h"
#include "verify/commands.h"
#include "verify/compare.h"
#include "verify/find.h"
#include "verify/picture.h"
#include "verify/simulate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Runs the scene at its coarsest level and writes STEM.vtkhdf and STEM.png to a folder. */
static bool make(const struct verify_options *options, struct solver_scene *scene, const char *folder, const char *stem,
                 struct solver_error *error)
{
    char record_path[VERIFY_PATH], picture[VERIFY_PATH];
    struct solver_run *run = NULL;
    struct solver_record *record = NULL;
    if (!verify_path_join(picture, folder, stem, ".png", error) || !verify_picture_check(scene, error) ||
        !verify_simulate(scene, folder, options->line, NULL, NULL, &run, error)) {
        return false;
    }
    bool done = verify_record(scene, run, folder, stem, options->line, record_path, error) &&
                solver_record_read(record_path, &record, error) &&
                verify_picture_write(picture, record, scene->has_view ? &scene->view : NULL, scene->title, NULL, error);
    solver_record_free(record);
    solver_run_free(run);
    return done;
}

static bool update(const struct verify_options *options, struct solver_scene *scene, const char *golden,
                   struct solver_error *error)
{
    char beside[VERIFY_PATH];
    if (!verify_folder_make(golden, error) || !make(options, scene, golden, scene->name, error) ||
        !verify_path_join(beside, golden, scene->name, ".xdmf", error)) {
        return false;
    }
    (void)unlink(beside); /* nobody looks at a golden record through it */
    (void)printf("golden     %s/%s.vtkhdf\n           %s/%s.png\n", golden, scene->name, golden, scene->name);
    return true;
}

static void print_lines(const struct golden_report *report)
{
    (void)printf("  %-28s %12s    %-12s\n", "field", "difference", "bound");
    for (size_t i = 0; i < report->count; i++) {
        struct golden_line line = report->line[i];
        solver_plain(line.field, false); /* columns are named by the file */
        solver_plain(line.place, false);
        (void)printf("  %-28s %12.4e <= %-12.4e %s%s%s\n", line.field, line.difference, line.bound,
                     line.pass ? "PASS" : "FAIL", line.pass ? "" : ": ", line.pass ? "" : line.place);
    }
}

static bool compare_records(const char *stored_path, const char *fresh_path, bool *same, struct solver_error *error)
{
    struct solver_record *stored = NULL, *fresh = NULL;
    struct golden_report report = {.count = 0};
    bool done = solver_record_read(stored_path, &stored, error) && solver_record_read(fresh_path, &fresh, error) &&
                golden_compare(stored, fresh, &report, error);
    if (done) {
        print_lines(&report);
        *same = report.pass && report.count > 0;
        golden_report_free(&report);
    }
    solver_record_free(stored);
    solver_record_free(fresh);
    return done;
}

/* Puts the stored and the difference picture beside the fresh one, so that all three can be looked at together. */
static bool show_difference(const char *folder, const char *name, const struct render_image *stored,
                            const struct render_difference *difference, struct solver_error *error)
{
    char stored_path[VERIFY_PATH], difference_path[VERIFY_PATH], why[RENDER_WHY] = "";
    if (!verify_path_join(stored_path, folder, name, ".stored.png", error) ||
        !verify_path_join(difference_path, folder, name, ".diff.png", error)) {
        return false;
    }
    if (!render_png_write(stored_path, stored, why) || !render_png_write(difference_path, difference->picture, why)) {
        return solver_fail(error, SOLVER_IO, "%s: %s", difference_path, why);
    }
    (void)printf("difference %s\n           beside %s/%s.stored.png and %s/%s.fresh.png\n", difference_path, folder,
                 name, folder, name);
    return true;
}

static bool compare_pictures(const char *stored_path, const char *fresh_path, const char *folder, const char *name,
                             bool *same, struct solver_error *error)
{
    struct render_image *stored = NULL;
    struct render_difference difference = {.same = false};
    bool done = verify_compare(stored_path, fresh_path, render_tolerance_default, &stored, &difference, same, error) &&
                (*same || show_difference(folder, name, stored, &difference, error));
    render_image_free(difference.picture);
    render_image_free(stored);
    return done;
}

static bool check(const struct verify_options *options, struct solver_scene *scene, const char *golden, bool *same,
                  struct solver_error *error)
{
    char folder[VERIFY_PATH], stored[VERIFY_PATH], fresh[VERIFY_PATH], stem[SOLVER_NAME + 8];
    (void)snprintf(stem, sizeof stem, "%s.fresh", scene->name);
    if (!verify_out_folder(options, scene->name, folder, error) ||
        !verify_path_join(stored, golden, scene->name, ".vtkhdf", error)) {
        return false;
    }
    if (access(stored, R_OK) != 0) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: there is no such golden record; assay golden update %s makes it", stored,
                           options->operand[1]);
    }
    bool same_record = false, same_picture = false;
    bool done = make(options, scene, folder, stem, error) && verify_path_join(fresh, folder, stem, ".vtkhdf", error) &&
                compare_records(stored, fresh, &same_record, error) &&
                verify_path_join(stored, golden, scene->name, ".png", error) &&
                verify_path_join(fresh, folder, stem, ".png", error) &&
                compare_pictures(stored, fresh, folder, scene->name, &same_picture, error);
    *same = same_record && same_picture;
    if (done) {
        (void)printf("%s\n", *same ? "PASS: record and picture are as stored" : "FAIL: the result is not as stored");
    }
    return done;
}

/* Opens the scene at its coarsest level, to end where its golden record does. */
static bool open_coarsest(const struct verify_options *options, struct solver_scene **scene, struct solver_error *error)
{
    struct verify_options named = *options;
    named.operand[0] = options->operand[1];
    if (!verify_scene_open(&named, 0, scene, error)) {
        return false;
    }
    int n = (*scene)->level_count > 0 ? (*scene)->levels[0] : (*scene)->n;
    solver_scene_free(*scene);
    *scene = NULL;
    if (!verify_scene_open(&named, n, scene, error)) {
        return false;
    }
    (*scene)->t_end = (*scene)->golden_t_end > 0 ? (*scene)->golden_t_end : (*scene)->t_end;
    return true;
}

int verify_command_golden(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    bool renew = strcmp(options->operand[0], "update") == 0;
    if (!renew && strcmp(options->operand[0], "check") != 0) {
        (void)solver_fail(&error, SOLVER_BAD_INPUT,
                          "golden %s: check or update is expected, as in assay golden check SCENE",
                          options->operand[0]);
        return verify_complain(&error);
    }
    struct solver_scene *scene = NULL;
    if (!open_coarsest(options, &scene, &error)) {
        return verify_complain(&error);
    }
    char golden[VERIFY_PATH];
    verify_folder_find(VERIFY_FOLDER_GOLDEN, golden);
    const char *folder = options->dir != NULL ? options->dir : golden;
    bool same = true;
    bool done = renew ? update(options, scene, folder, &error) : check(options, scene, folder, &same, &error);
    solver_scene_free(scene);
    if (!done) {
        return verify_complain(&error);
    }
    return same ? VERIFY_PASSED : VERIFY_FAILED;
}
