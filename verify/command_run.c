#include "verify/commands.h"
#include "verify/find.h"
#include "verify/picture.h"
#include "verify/report.h"
#include "verify/simulate.h"

#include <math.h>
#include <stdio.h>

static void print_facts(const struct solver_scene *scene, const struct solver_facts *facts)
{
    char residual[VERIFY_RESIDUAL];
    double particle_steps = (double)facts->particles * (double)facts->steps;
    (void)printf("%s (%s)\n", scene->title, scene->path);
    (void)printf("  %zu particles, spacing %.6g m, %zu pairs, %zu steps to t = %.6g s on %d threads\n",
                 facts->particles, facts->spacing, facts->pairs, facts->steps, scene->t_end, facts->threads);
    (void)printf("  set up in %.3f s, ran for %.3f s: %.1f ns per particle-step\n", facts->setup_seconds,
                 facts->seconds, 1e9 * facts->seconds / particle_steps);
    (void)printf("  %.0f bytes per particle, %.0f of them fields of the scheme%s\n", facts->bytes_per_particle,
                 facts->state_bytes, verify_residual(residual, facts));
}

/* How well the cloud of a body of any shape fits it. */
static void print_quality(const struct solver_cloud *cloud)
{
    const struct solver_cloud_quality *quality = cloud->quality;
    if (quality == NULL) {
        return;
    }
    (void)printf(
        "  body of %.6g m^%d within %.6g m^%d; %zu particles on its surface, off it by %.1e spacings at most\n",
        quality->volume, cloud->dim, quality->area, cloud->dim - 1, quality->on_surface, quality->off_surface);
    (void)printf("  areas sum to %.1e of it; volumes from %.2f of a cell, changed by %.1e, areas by %.1e of a side\n",
                 quality->closure, quality->least_volume, quality->correction, quality->area_correction);
    (void)printf("  particles from %.2f spacings apart, the surface up to %.2f from its own\n", quality->nearest,
                 quality->widest);
}

/* Record and picture of a finished run. The picture is drawn from the record as read back, which proves that it can
 * be. */
static bool keep(const struct solver_scene *scene, struct solver_run *run, const char *folder, const char *line,
                 struct solver_error *error)
{
    char record_path[VERIFY_PATH], picture_path[VERIFY_PATH];
    struct solver_record *record = NULL;
    if (!verify_record(scene, run, folder, scene->name, line, record_path, error) ||
        !verify_path_join(picture_path, folder, scene->name, ".png", error) ||
        !solver_record_read(record_path, &record, error)) {
        return false;
    }
    bool drawn = verify_picture_write(picture_path, record, scene->has_view ? &scene->view : NULL, scene->title, error);
    solver_record_free(record);
    if (drawn) {
        (void)printf("record     %s\npicture    %s\n", record_path, picture_path);
    }
    return drawn;
}

static bool judge(const struct solver_scene *scene, struct solver_run *run, const struct solver_facts *facts,
                  struct solver_error *error)
{
    struct solver_output output;
    double value[VERIFY_INDICATORS];
    if (!solver_run_output(run, &output, error) ||
        !verify_indicators_measure(scene, &output, solver_run_history(run), facts, value, error)) {
        return false;
    }
    verify_terminal_indicators(stdout, value);
    print_quality(output.cloud);
    return true;
}

static bool run_scene(struct solver_scene *scene, const struct verify_options *options, struct solver_error *error)
{
    char folder[VERIFY_PATH];
    struct solver_run *run = NULL;
    if (!verify_out_folder(options, scene->name, folder, error) ||
        !verify_simulate(scene, folder, options->line, NULL, NULL, &run, error)) {
        return false;
    }
    const struct solver_facts facts = solver_run_facts(run);
    print_facts(scene, &facts);
    const struct solver_history *history = solver_run_history(run);
    if (history->count > 0) {
        verify_terminal_totals(stdout, scene, &history->totals[0], &history->totals[history->count - 1]);
    }
    bool kept = judge(scene, run, &facts, error) && keep(scene, run, folder, options->line, error);
    solver_run_free(run);
    return kept;
}

int verify_command_run(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_scene *scene = NULL;
    if (!verify_scene_open(options, 0, &scene, &error)) {
        return verify_complain(&error);
    }
    bool done = run_scene(scene, options, &error);
    solver_scene_free(scene);
    return done ? VERIFY_PASSED : verify_complain(&error);
}
