/* What the page says about where its numbers come from. */
#include "verify/html.h"
#include "verify/report.h"

#include <math.h>

static void setting(FILE *file, const struct solver_scene *scene, const char *key)
{
    char value[SOLVER_TEXT];
    if (solver_scene_text(scene, key, value, sizeof value)) {
        (void)fprintf(file, "<tr><td>%s</td><td>", key);
        verify_html_text(file, value);
        (void)fprintf(file, "</td></tr>\n");
    }
}

void verify_html_configuration(FILE *file, const struct solver_scene *scene)
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
    verify_html_text(file, scene->overrides[0] != '\0' ? scene->overrides : "none");
    (void)fprintf(file, "</p>\n");
}

void verify_html_oracle(FILE *file, const struct verify_truth *truth)
{
    (void)fprintf(file, "<h2>The oracle proves itself</h2><p>");
    verify_html_text(file, truth->kind->summary);
    (void)fprintf(file, " <span class=\"note\">(");
    verify_html_text(file, truth->kind->source);
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
        verify_html_text(file, figure[i].name);
        (void)fprintf(file, "</td><td>%.10g</td><td>%s</td><td class=\"help\">", figure[i].value, figure[i].unit);
        verify_html_text(file, figure[i].help);
        (void)fprintf(file, "</td></tr>\n");
    }
    (void)fprintf(file, "</table><table><tr><th>law</th><th>residual [-]</th><th>bound [-]</th><th></th></tr>\n");
    for (size_t i = 0; i < truth->check_count; i++) {
        const struct oracle_check *line = &truth->check[i];
        (void)fprintf(file, "<tr><td>");
        verify_html_text(file, line->law);
        (void)fprintf(file, "</td><td>%.2e</td><td>%.1e</td><td class=\"%s</td></tr>\n", line->residual, line->bound,
                      oracle_law_holds(line) ? "pass\">holds" : "fail\">FAILS");
    }
    (void)fprintf(file, "</table>\n");
}

void verify_html_quantities(FILE *file, const struct verify_study *study)
{
    const struct solver_totals *a = &study->first, *b = &study->last;
    double kinetic = NAN, strain = NAN;
    verify_truth_energy(study->truth, study->scene, b->time, &kinetic, &strain);
    (void)fprintf(file,
                  "<h2>Conserved quantities at the finest level</h2><table><tr><th></th><th>t = %.6g s</th>"
                  "<th>t = %.6g s</th><th>exact</th><th>unit</th></tr>\n",
                  a->time, b->time);
    const char *const name[] = {"kinetic", "strain"};
    const double first[] = {a->kinetic, a->strain}, last[] = {b->kinetic, b->strain}, exact[] = {kinetic, strain};
    for (int i = 0; i < 2; i++) {
        (void)fprintf(file, "<tr><td>%s energy</td><td>%.6e</td><td>%.6e</td>", name[i], first[i], last[i]);
        verify_html_number(file, exact[i]);
        (void)fprintf(file, "<td>J</td></tr>\n");
    }
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
                  "set up in %.2f s, %d thread%s%s.</p>\n",
                  facts->pairs, facts->bytes_per_particle, facts->state_bytes, facts->setup_seconds, facts->threads,
                  facts->threads == 1 ? "" : "s", verify_residual(residual, facts));
}
