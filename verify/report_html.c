#include "verify/report.h"

#include "verify/html.h"

#include <math.h>

static const char style[] =
    "body{font:16px/1.5 system-ui,sans-serif;color:#1b1f24;max-width:70rem;margin:2rem auto;padding:0 1rem}"
    "h1{font-size:1.6rem;margin-bottom:0}h2{font-size:1.15rem;margin-top:2.2rem}"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.9rem}"
    "th,td{padding:.25rem .7rem;text-align:right;border-bottom:1px solid #d8dee4}"
    "th{font-weight:600}th:first-child,td:first-child,td.help{text-align:left}"
    ".pass{color:#11632f}.fail{color:#a40e26;font-weight:600}"
    ".verdict{font-size:1.15rem;padding:.5rem 1rem;border-left:6px solid;margin:1.2rem 0;background:#f6f8fa}"
    ".row{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(26rem,100%),1fr));gap:1rem}.row>*{margin:0}"
    "img{width:100%;height:auto}svg{font:12px system-ui,sans-serif}.note{color:#57606a;font-size:.9rem}"
    "pre{background:#f6f8fa;padding:1rem;overflow:auto;font-size:.85rem}"
    "svg .grid{stroke:#e3e7eb}svg .frame{fill:none;stroke:#57606a}"
    "svg line.order{stroke:#8c959f;stroke-dasharray:5 4}svg "
    "text.order{fill:#6e7781;font-size:11px;paint-order:stroke;stroke:#fff;stroke-width:4px}"
    "svg polyline{fill:none;stroke-width:2}svg polyline.measured{stroke:#0b5394}svg circle.measured{fill:#0b5394}"
    "svg polyline.published{stroke:#b35900;stroke-width:1}svg "
    "circle.published{fill:#fff;stroke:#b35900;stroke-width:2}"
    "svg .title{font-weight:600}svg line.front{stroke:#8c959f;stroke-dasharray:2 3}svg line.interface{stroke:#8c959f}"
    "svg polyline.exact{stroke:#f7b267;stroke-width:4.5;stroke-linejoin:round}"
    "svg polyline.finest,svg polyline.kinetic{stroke:#0b3d91;stroke-width:1.4}"
    "svg polyline.beside{stroke:#e08214;stroke-width:3;stroke-dasharray:7 4}"
    "svg circle.finest{fill:#0b3d91}svg polyline.finer{stroke:#2f8f5b;stroke-width:1.2}svg "
    "polyline.fine{stroke:#b03a8c;stroke-width:1.2}"
    "svg polyline.strain{stroke:#2f8f5b;stroke-width:1.4}svg polyline.total{stroke:#1b1f24;stroke-width:1.4}"
    ".panels{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(20rem,100%),1fr));gap:.5rem 1rem}"
    ".key{font-size:.9rem;margin:.3rem 0}.key svg{width:30px;height:10px;margin-right:.4rem}"
    "td{white-space:nowrap}td.help{white-space:normal}.key span{white-space:nowrap;margin-right:1.4rem}"
    "@media print{body{font-size:9pt;max-width:none;margin:0;padding:0}table{font-size:8pt}th,td{padding:.15rem "
    ".4rem}h2{break-after:avoid}svg,figure,tr{break-inside:avoid}"
    ".panels{grid-template-columns:repeat(3,1fr)}.row{grid-template-columns:repeat(2,1fr)}pre{white-space:pre-wrap}}";

static void head(FILE *file, const struct verify_study *study)
{
    const struct solver_scene *scene = study->scene;
    (void)fprintf(file, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                        "<meta name=\"viewport\" content=\"width=device-width\"><title>");
    verify_html_text(file, scene->title);
    (void)fprintf(file, "</title><style>%s</style></head><body>\n<h1>", style);
    verify_html_text(file, scene->title);
    (void)fprintf(file, "</h1>\n<p class=\"note\">");
    verify_html_text(file, scene->source);
    (void)fprintf(file, "</p>\n");
    if (!study->truth->proven) {
        (void)fprintf(file, "<p class=\"verdict fail\">FAIL: the oracle does not prove itself.</p>\n");
    } else {
        const char *class = study->gates.count == 0 || (study->gates.pass && study->gates.general) ? ""
                            : study->gates.pass                                                    ? "pass"
                                                                                                   : "fail";
        (void)fprintf(file, "<p class=\"verdict %s\">%s.</p>\n", class, verify_verdict(study));
    }
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
    (void)fprintf(file, "<h2>Figures measured</h2><table><tr><th>figure</th><th>unit</th><th>exact</th><th>measured, "
                        "finest level</th>");
    for (size_t i = 0; i < study->level_count; i++) {
        (void)fprintf(file, "<th>error [-]<br>n = %d</th>", study->level[i].n);
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
                  "</table>\n<p class=\"note\">Error: |measured / exact &minus; 1|, or |measured| where the exact "
                  "value is 0. How each is measured stands in the scene under figures.</p>\n");
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

static void gates(FILE *file, const struct verify_gates *judged)
{
    (void)fprintf(file, "<h2>Gates</h2>\n");
    if (judged->count == 0) {
        (void)fprintf(file, "<p>None holds for this configuration: nothing was tested against a bound.</p>\n");
        return;
    }
    (void)fprintf(file,
                  "<table><tr><th>gate</th><th>measured</th><th></th><th>bound</th><th>unit</th><th></th></tr>\n");
    for (size_t i = 0; i < judged->count; i++) {
        const struct verify_gate *gate = &judged->gate[i];
        (void)fprintf(file, "<tr><td>");
        verify_html_text(file, gate->name);
        (void)fprintf(file, isnan(gate->value) ? "</td><td>&ndash;</td>" : "</td><td>%.4g</td>", gate->value);
        (void)fprintf(file, "<td>%s</td><td>%.4g</td><td>%s</td><td class=\"%s</td></tr>\n",
                      gate->op[0] == '<' ? "&le;" : "&ge;", gate->bound, gate->unit,
                      gate->pass ? "pass\">PASS" : "fail\">FAIL");
    }
    (void)fprintf(file, "</table>\n");
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
    gates(file, &study->gates);
    figures(file, study);
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
