#include "verify/report.h"

#include "verify/html.h"

#include <math.h>

static void head(FILE *file, const struct verify_study *study)
{
    const struct solver_scene *scene = study->scene;
    const char *class = study->gates.count == 0 || (study->gates.pass && study->gates.general) ? ""
                        : study->gates.pass                                                    ? "pass"
                                                                                               : "fail";
    verify_html_begin(file, scene->title, scene->source, study->truth, class, verify_verdict(study));
    if (study->truth->none) {
        (void)fprintf(file, "<p>There is %s.</p>\n", verify_no_oracle);
    }
}

/* Columns of the errors shown at a level. */
static void level_errors(FILE *file, const struct verify_study *study, const struct verify_level *level,
                         const size_t *shown, size_t shown_count)
{
    for (size_t i = 0; i < shown_count; i++) {
        verify_html_cell(file, "e", level->error[shown[i]]);
        if (verify_error_has_order(shown[i])) {
            verify_html_cell(file, "f", level->rate[shown[i]]);
            verify_html_cell(file, "e", verify_published(study->scene, level->n, verify_error_name(shown[i])));
        }
    }
}

/* What the columns of errors mean. */
static void levels_note(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    (void)fprintf(file, "<p class=\"note\">");
    for (size_t i = 0; i < shown_count; i++) {
        (void)fprintf(file, "%s: %s. ", verify_error_name(shown[i]), verify_error_meaning(shown[i]));
    }
    if (study->truth->none) {
        (void)fprintf(file, "</p>\n");
        return;
    }
    (void)fprintf(file, "Relative L2: &radic;(&Sigma;V|e|&sup2; / &Sigma;V|exact|&sup2;). Order: "
                        "log(e1/e2)/log(h1/h2) from the level before.</p>\n");
    if (study->scene->published_count > 0) {
        (void)fprintf(file, "<p class=\"note\">Published: ");
        verify_html_text(file, study->scene->published_source);
        (void)fprintf(file,
                      ". The source does not define its error norm: its figures stand beside ours for orientation "
                      "and decide no gate.</p>\n");
    }
}

static void levels(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    (void)fprintf(file,
                  "<h2>%s t = %.6g s</h2><table><tr><th>n</th><th>h [m]</th><th>particles</th><th>steps</th>"
                  "<th>time [s]</th><th>ns per<br>particle-step</th>",
                  study->truth->none ? "Levels, run to" : "Errors at", study->scene->t_end);
    for (size_t i = 0; i < shown_count; i++) {
        (void)fprintf(file, "<th>%s [%s]</th>%s", verify_error_name(shown[i]), verify_error_unit(shown[i]),
                      verify_error_has_order(shown[i]) ? "<th>order</th><th>published</th>" : "");
    }
    (void)fprintf(file, "</tr>\n");
    for (size_t i = 0; i < study->level_count; i++) {
        const struct verify_level *level = &study->level[i];
        (void)fprintf(file, "<tr><td>%d</td><td>%.4g</td><td>%zu</td><td>%zu</td><td>%.3f</td><td>%.1f</td>", level->n,
                      level->facts.spacing, level->facts.particles, level->facts.steps, level->facts.seconds,
                      level->ns_per_particle_step);
        level_errors(file, study, level, shown, shown_count);
        (void)fprintf(file, "</tr>\n");
    }
    (void)fprintf(file, "</table>\n");
    if (shown_count > 0) {
        levels_note(file, study, shown, shown_count);
    }
}

/* The errors that have a column of their largest over the snapshots, snapshot by snapshot. */
static void snapshots(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    const struct verify_level *level = &study->level[study->level_count - 1];
    size_t of_state[VERIFY_STATE_ERRORS], count = verify_shown_snapshots(shown, shown_count, of_state);
    if (count == 0) {
        return;
    }
    (void)fprintf(file, "<h2>Errors at the snapshots, finest level</h2><table><tr><th>t [s]</th>");
    for (size_t i = 0; i < count; i++) {
        (void)fprintf(file, "<th>%s [%s]</th>", verify_error_name(of_state[i]), verify_error_unit(of_state[i]));
    }
    (void)fprintf(file, "</tr>\n");
    for (size_t i = 0; i < level->snapshot_count; i++) {
        (void)fprintf(file, "<tr><td>%.6g</td>", level->snapshot[i].time);
        for (size_t j = 0; j < count; j++) {
            verify_html_cell(file, "e", level->snapshot[i].error[of_state[j]]);
        }
        (void)fprintf(file, "</tr>\n");
    }
    (void)fprintf(file, "</table>\n");
}

static void figures(FILE *file, const struct verify_study *study)
{
    const struct verify_level *finest = &study->level[study->level_count - 1];
    if (study->scene->figure_count == 0) {
        return;
    }
    (void)fprintf(file,
                  "<h2>Figures measured</h2><table><tr><th>figure</th><th>unit</th><th>expected</th><th>measured, "
                  "finest level</th>");
    for (size_t i = 0; i < study->level_count; i++) {
        (void)fprintf(file, "<th>error<br>n = %d</th>", study->level[i].n);
    }
    (void)fprintf(file, "<th>order</th></tr>\n");
    for (size_t i = 0; i < study->scene->figure_count; i++) {
        const struct verify_figure *figure = &finest->figure[i];
        (void)fprintf(file, "<tr><td>");
        verify_html_text(file, study->scene->figure[i].name);
        (void)fprintf(file, "</td><td>%s</td>", figure->unit);
        verify_html_number(file, figure->exact);
        verify_html_number(file, figure->measured);
        for (size_t j = 0; j < study->level_count; j++) {
            verify_html_cell(file, "e", study->level[j].figure[i].error);
        }
        verify_html_cell(file, "f", figure->rate);
        (void)fprintf(file, "</tr>\n");
    }
    (void)fprintf(file,
                  "</table>\n<p class=\"note\">Error: |measured / expected &minus; 1|, or |measured|, in its unit, "
                  "where 0 is expected: of the oracle, printed, or of a finer level, as the scene says. How each is "
                  "measured stands in the scene under figures.</p>\n");
}

static void indicators(FILE *file, const struct verify_study *study)
{
    (void)fprintf(file, "<h2>Physical indicators</h2><table><tr><th>indicator [-]</th>");
    for (size_t i = 0; i < study->level_count; i++) {
        (void)fprintf(file, "<th>n = %d</th>", study->level[i].n);
    }
    (void)fprintf(file, "<th></th></tr>\n");
    for (size_t i = 0; i < VERIFY_INDICATORS; i++) {
        (void)fprintf(file, "<tr><td>%s</td>", verify_indicator_name(i));
        for (size_t j = 0; j < study->level_count; j++) {
            verify_html_cell(file, "e", study->level[j].indicator[i]);
        }
        (void)fprintf(file, "<td class=\"help\">%s</td></tr>\n", verify_indicator_meaning(i));
    }
    (void)fprintf(file, "</table>\n<p class=\"note\">Momentum is conserved, and shown, where all faces are free; the "
                        "energy gain is known where no face is moved.</p>\n");
}

static void key(FILE *file, const char *class, const char *label)
{
    (void)fprintf(file, "<svg viewBox=\"0 0 30 10\"><polyline class=\"%s\" points=\"0,5 30,5\"/></svg>", class);
    verify_html_text(file, label);
}

/* The probes in this configuration and in the one beside it. */
static void beside(FILE *file, const struct verify_study *study)
{
    if (study->beside->scene == NULL) {
        return;
    }
    (void)fprintf(file, "<h2>Displacement of the probes, beside another configuration</h2><p class=\"key\">");
    key(file, "finest", study->beside->label_of_study);
    key(file, "beside", study->beside->label);
    (void)fprintf(file, "</p>\n<div class=\"row\">\n");
    for (size_t probe = 0; probe < study->motion.probe_count; probe++) {
        for (size_t axis = 0; axis < (size_t)study->scene->dim; axis++) {
            verify_plot_beside(file, study, probe, axis);
        }
    }
    (void)fprintf(file, "</div>\n<p class=\"note\">The configuration beside is no exact solution: what differs may be "
                        "the fault of either.</p>\n");
}

/* A probe that is drawn beside another configuration is not drawn again where there is no exact curve to show. */
static bool over_time(FILE *file, const struct verify_study *study, struct solver_error *error)
{
    (void)fprintf(file, "<h2>Over time, finest level</h2><div class=\"row\">\n");
    bool drawn_already = study->truth->none && study->beside->scene != NULL;
    for (size_t i = 0; i < study->trace_count && !drawn_already; i++) {
        verify_plot_trace(file, study, &study->trace[i]);
    }
    bool drawn = verify_plot_energy(file, study, error);
    (void)fprintf(file, "</div>\n");
    return drawn;
}

static void convergence(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    (void)fprintf(file, "<h2>Convergence</h2><div class=\"row\">\n");
    for (size_t i = 0; i < shown_count && verify_error_has_order(shown[i]); i++) {
        verify_plot(file, study, shown[i]);
    }
    (void)fprintf(file, "</div>\n");
}

static bool pictures(FILE *file, const struct verify_study *study, struct solver_error *error)
{
    (void)fprintf(file, "<h2>Pictures</h2><div class=\"row\">\n");
    bool drawn = verify_html_picture(file, study->picture, "computed, finest level", error) &&
                 verify_html_picture(file, study->exact_picture, "exact", error);
    (void)fprintf(file, "</div>\n");
    return drawn;
}

/* All that was measured. */
static bool results(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count,
                    struct solver_error *error)
{
    levels(file, study, shown, shown_count);
    verify_html_convergence(file, study, shown, shown_count);
    verify_html_gates(file, &study->gates);
    figures(file, study);
    verify_html_extrapolation(file, study);
    if (!verify_plot_profiles(file, study, error)) {
        return false;
    }
    snapshots(file, study, shown, shown_count);
    if (!study->truth->none) {
        convergence(file, study, shown, shown_count);
    }
    beside(file, study);
    if (!over_time(file, study, error) || !pictures(file, study, error)) {
        return false;
    }
    indicators(file, study);
    return true;
}

bool verify_html(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count,
                 struct solver_error *error)
{
    head(file, study);
    if (study->level_count > 0 && !results(file, study, shown, shown_count, error)) {
        return false;
    }
    if (!study->truth->none) {
        verify_html_oracle(file, study->truth);
    }
    if (study->level_count > 0) {
        verify_html_quantities(file, study);
    }
    verify_html_configuration(file, study->scene);
    (void)fprintf(file, "<h2>Scene</h2><pre>");
    verify_html_text(file, study->scene->text);
    (void)fprintf(file, "</pre></body></html>\n");
    return true;
}
