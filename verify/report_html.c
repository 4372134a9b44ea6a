#include "verify/report.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

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
    "circle.published{fill:#fff;stroke:#b35900;stroke-width:2}";

static void escape(FILE *file, const char *text)
{
    for (const char *c = text; *c != '\0'; c++) {
        switch (*c) {
        case '&':
            (void)fputs("&amp;", file);
            break;
        case '<':
            (void)fputs("&lt;", file);
            break;
        case '>':
            (void)fputs("&gt;", file);
            break;
        case '"':
            (void)fputs("&quot;", file);
            break;
        default:
            (void)fputc(*c, file);
        }
    }
}

static void base64(FILE *file, const unsigned char *bytes, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t rest = size - i;
        uint32_t three = (uint32_t)bytes[i] << 16;
        three |= rest > 1 ? (uint32_t)bytes[i + 1] << 8 : 0;
        three |= rest > 2 ? (uint32_t)bytes[i + 2] : 0;
        (void)fputc(digit[three >> 18], file);
        (void)fputc(digit[three >> 12 & 63], file);
        (void)fputc(rest > 1 ? digit[three >> 6 & 63] : '=', file);
        (void)fputc(rest > 2 ? digit[three & 63] : '=', file);
    }
}

static bool picture(FILE *file, const char *path, const char *caption, struct solver_error *error)
{
    char *bytes = NULL;
    size_t size = 0;
    if (path[0] == '\0') {
        return true;
    }
    if (!verify_file_read(path, &bytes, &size, error)) {
        return false;
    }
    (void)fprintf(file, "<figure><img alt=\"%s\" src=\"data:image/png;base64,", caption);
    base64(file, (const unsigned char *)bytes, size);
    (void)fprintf(file, "\"><figcaption class=\"note\">%s</figcaption></figure>\n", caption);
    free(bytes);
    return true;
}

static void head(FILE *file, const struct verify_study *study)
{
    const struct solver_scene *scene = study->scene;
    (void)fprintf(file, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                        "<meta name=\"viewport\" content=\"width=device-width\"><title>");
    escape(file, scene->title);
    (void)fprintf(file, "</title><style>%s</style></head><body>\n<h1>", style);
    escape(file, scene->title);
    (void)fprintf(file, "</h1>\n<p class=\"note\">");
    escape(file, scene->source);
    (void)fprintf(file, "</p>\n");
    if (!study->truth->proven) {
        (void)fprintf(file, "<p class=\"verdict fail\">FAIL: the oracle does not prove itself.</p>\n");
    } else {
        const char *class = study->gates.count == 0 || (study->gates.pass && study->gates.general) ? ""
                            : study->gates.pass                                                    ? "pass"
                                                                                                   : "fail";
        (void)fprintf(file, "<p class=\"verdict %s\">%s.</p>\n", class, verify_verdict(study));
    }
}

static void setting(FILE *file, const struct solver_scene *scene, const char *key)
{
    char value[SOLVER_TEXT];
    if (solver_scene_text(scene, key, value, sizeof value)) {
        (void)fprintf(file, "<tr><td>%s</td><td>", key);
        escape(file, value);
        (void)fprintf(file, "</td></tr>\n");
    }
}

static void configuration(FILE *file, const struct solver_scene *scene)
{
    static const char *const key[] = {"material.model", "material.E", "material.nu", "material.rho", "scheme",
                                      "support",        "perturb",    "integrator",  "cfl",          "t_end",
                                      "precision"};
    static const char *const of_stencil[] = {"evolved", "stencil", "reconstruction"};
    (void)fprintf(file, "<h2>Configuration</h2><table><tr><th>key</th><th>value</th></tr>\n");
    for (size_t i = 0; i < sizeof key / sizeof *key; i++) {
        setting(file, scene, key[i]);
    }
    for (size_t i = 0; verify_has_stencil(scene) && i < sizeof of_stencil / sizeof *of_stencil; i++) {
        setting(file, scene, of_stencil[i]);
    }
    (void)fprintf(file, "</table>\n<p class=\"note\">In SI units. Overrides given: ");
    escape(file, scene->overrides[0] != '\0' ? scene->overrides : "none");
    (void)fprintf(file, "</p>\n");
}

static void cell(FILE *file, const char *format, double value)
{
    (void)fputs("<td>", file);
    if (isnan(value)) {
        (void)fputs("&ndash;", file);
    } else {
        (void)fprintf(file, format[0] == 'e' ? "%.3e" : "%.2f", value);
    }
    (void)fputs("</td>", file);
}

static void levels(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    (void)fprintf(file,
                  "<h2>Errors at t = %.6g s</h2><table><tr><th>n</th><th>h [m]</th><th>particles</th><th>steps</th>"
                  "<th>time [s]</th><th>ns per<br>particle-step</th>",
                  study->scene->t_end);
    for (size_t i = 0; i < shown_count; i++) {
        (void)fprintf(file, "<th>%s [%s]</th><th>order</th><th>published</th>", verify_error_name(shown[i]),
                      verify_error_unit(shown[i]));
    }
    (void)fprintf(file, "</tr>\n");
    for (size_t i = 0; i < study->level_count; i++) {
        const struct verify_level *level = &study->level[i];
        (void)fprintf(file, "<tr><td>%d</td><td>%.4g</td><td>%zu</td><td>%zu</td><td>%.3f</td><td>%.1f</td>", level->n,
                      level->facts.spacing, level->facts.particles, level->facts.steps, level->facts.seconds,
                      level->ns_per_particle_step);
        for (size_t j = 0; j < shown_count; j++) {
            cell(file, "e", level->error[shown[j]]);
            cell(file, "f", level->rate[shown[j]]);
            cell(file, "e", verify_published(study->scene, level->n, verify_error_name(shown[j])));
        }
        (void)fprintf(file, "</tr>\n");
    }
    (void)fprintf(file, "</table>\n<p class=\"note\">");
    for (size_t i = 0; i < shown_count; i++) {
        (void)fprintf(file, "%s: %s. ", verify_error_name(shown[i]), verify_error_meaning(shown[i]));
    }
    (void)fprintf(file, "Relative L2: &radic;(&Sigma;V|e|&sup2; / &Sigma;V|exact|&sup2;). Order: "
                        "log(e1/e2)/log(h1/h2) from the level before.</p>\n");
    if (study->scene->published_count > 0) {
        (void)fprintf(file, "<p class=\"note\">Published: ");
        escape(file, study->scene->published_source);
        (void)fprintf(file,
                      ". The source does not define its error norm: its figures stand beside ours for orientation "
                      "and decide no gate.</p>\n");
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
            cell(file, "e", level->snapshot[i].error[of_state[j]]);
        }
        (void)fprintf(file, "</tr>\n");
    }
    (void)fprintf(file, "</table>\n");
}

static void number(FILE *file, double value)
{
    if (isnan(value)) {
        (void)fputs("<td>&ndash;</td>", file);
    } else {
        (void)fprintf(file, "<td>%.9g</td>", value);
    }
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
        escape(file, study->scene->figure[i].name);
        (void)fprintf(file, "</td><td>%s</td>", figure->unit);
        number(file, figure->exact);
        number(file, figure->measured);
        for (size_t j = 0; j < study->level_count; j++) {
            cell(file, "e", study->level[j].figure[i].error);
        }
        cell(file, "f", figure->rate);
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
            cell(file, "e", study->level[j].indicator[i]);
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
        escape(file, gate->name);
        (void)fprintf(file, "</td><td>%.4g</td><td>%s</td><td>%.4g</td><td>%s</td><td class=\"%s</td></tr>\n",
                      gate->value, gate->op[0] == '<' ? "&le;" : "&ge;", gate->bound, gate->unit,
                      gate->pass ? "pass\">PASS" : "fail\">FAIL");
    }
    (void)fprintf(file, "</table>\n");
}

static void oracle(FILE *file, const struct verify_truth *truth)
{
    (void)fprintf(file, "<h2>The oracle proves itself</h2><p>");
    escape(file, truth->kind->summary);
    (void)fprintf(file, " <span class=\"note\">(");
    escape(file, truth->kind->source);
    (void)fprintf(file, ")</span></p><table><tr><th>parameter</th><th>value</th><th>unit</th><th></th></tr>\n");
    for (size_t i = 0; i < truth->parameter_count; i++) {
        const struct oracle_parameter *parameter = &truth->kind->parameter[i];
        (void)fprintf(file, "<tr><td>%s</td><td>%.10g</td><td>%s</td><td>%s</td></tr>\n", parameter->name,
                      truth->value[i], parameter->unit,
                      truth->told[i] ? "<span class=\"fail\">told in place of the scene's</span>" : "");
    }
    struct oracle_figure figure[ORACLE_FIGURES];
    size_t figures = truth->kind->figures != NULL ? truth->kind->figures(truth->oracle, figure) : 0;
    for (size_t i = 0; i < figures; i++) {
        (void)fprintf(file, "<tr><td>");
        escape(file, figure[i].name);
        (void)fprintf(file, "</td><td>%.10g</td><td>%s</td><td>", figure[i].value, figure[i].unit);
        escape(file, figure[i].help);
        (void)fprintf(file, "</td></tr>\n");
    }
    (void)fprintf(file, "</table><table><tr><th>law</th><th>residual [-]</th><th>bound [-]</th><th></th></tr>\n");
    for (size_t i = 0; i < truth->check_count; i++) {
        const struct oracle_check *line = &truth->check[i];
        (void)fprintf(file, "<tr><td>");
        escape(file, line->law);
        (void)fprintf(file, "</td><td>%.2e</td><td>%.1e</td><td class=\"%s</td></tr>\n", line->residual, line->bound,
                      oracle_law_holds(line) ? "pass\">holds" : "fail\">FAILS");
    }
    (void)fprintf(file, "</table>\n");
}

static void quantities(FILE *file, const struct verify_study *study)
{
    const struct solver_totals *a = &study->first, *b = &study->last;
    double kinetic = NAN, strain = NAN;
    study->truth->kind->energy(study->truth->oracle, b->time, &kinetic, &strain);
    (void)fprintf(file,
                  "<h2>Conserved quantities at the finest level</h2><table><tr><th></th><th>t = %.6g s</th>"
                  "<th>t = %.6g s</th><th>exact</th><th>unit</th></tr>\n",
                  a->time, b->time);
    (void)fprintf(file, "<tr><td>kinetic energy</td><td>%.6e</td><td>%.6e</td><td>%.6e</td><td>J</td></tr>\n",
                  a->kinetic, b->kinetic, kinetic);
    (void)fprintf(file, "<tr><td>strain energy</td><td>%.6e</td><td>%.6e</td><td>%.6e</td><td>J</td></tr>\n", a->strain,
                  b->strain, strain);
    (void)fprintf(file, "<tr><td>external work</td><td>%.6e</td><td>%.6e</td><td></td><td>J</td></tr>\n", a->external,
                  b->external);
    for (int i = 0; i < 3; i++) {
        (void)fprintf(file, "<tr><td>linear momentum %c</td><td>%.6e</td><td>%.6e</td><td></td><td>kg m/s</td></tr>\n",
                      "xyz"[i], a -> linear[i], b -> linear[i]);
    }
    for (int i = 0; i < 3; i++) {
        (void)fprintf(file,
                      "<tr><td>angular momentum %c</td><td>%.6e</td><td>%.6e</td><td></td><td>kg m&sup2;/s</td></tr>\n",
                      "xyz"[i], a -> angular[i], b -> angular[i]);
    }
    const struct solver_facts *facts = &study->level[study->level_count - 1].facts;
    char residual[VERIFY_RESIDUAL];
    (void)fprintf(file,
                  "</table>\n<p class=\"note\">%zu pairs, %.0f bytes per particle (%.0f of them fields of the scheme), "
                  "set up in %.2f s, %d threads%s.</p>\n",
                  facts->pairs, facts->bytes_per_particle, facts->state_bytes, facts->setup_seconds, facts->threads,
                  verify_residual(residual, facts));
}

static void traces(FILE *file, const struct verify_study *study)
{
    if (study->trace_count == 0) {
        return;
    }
    (void)fprintf(file, "<h2>Displacement at the probes, finest level</h2><div class=\"row\">\n");
    for (size_t i = 0; i < study->trace_count; i++) {
        verify_plot_trace(file, study, &study->trace[i]);
    }
    (void)fprintf(file, "</div>\n");
}

bool verify_html(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count,
                 struct solver_error *error)
{
    head(file, study);
    if (study->level_count > 0) {
        levels(file, study, shown, shown_count);
        snapshots(file, study, shown, shown_count);
        figures(file, study);
        (void)fprintf(file, "<h2>Convergence</h2><div class=\"row\">\n");
        for (size_t i = 0; i < shown_count; i++) {
            verify_plot(file, study, shown[i]);
        }
        (void)fprintf(file, "</div>\n");
        gates(file, &study->gates);
        indicators(file, study);
        traces(file, study);
        (void)fprintf(file, "<h2>Pictures</h2><div class=\"row\">\n");
        if (!picture(file, study->picture, "computed, finest level", error) ||
            !picture(file, study->exact_picture, "exact", error)) {
            return false;
        }
        (void)fprintf(file, "</div>\n");
    }
    oracle(file, study->truth);
    if (study->level_count > 0) {
        quantities(file, study);
    }
    configuration(file, study->scene);
    (void)fprintf(file, "<h2>Scene</h2><pre>");
    escape(file, study->scene->text);
    (void)fprintf(file, "</pre></body></html>\n");
    return true;
}
