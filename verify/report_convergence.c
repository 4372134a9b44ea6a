/* What the levels of a study say together: orders of errors, and figures extrapolated to no spacing at all. */
#include "verify/grid_convergence.h"
#include "verify/html.h"
#include "verify/json.h"
#include "verify/report.h"
#include "verify/terminal.h"

#include <math.h>

static void spacings(const struct verify_study *study, double h[SOLVER_LEVELS])
{
    for (size_t i = 0; i < study->level_count; i++) {
        h[i] = study->level[i].facts.spacing;
    }
}

static enum verify_convergence of_error(const struct verify_study *study, size_t which, double order[2])
{
    double h[SOLVER_LEVELS] = {0}, e[SOLVER_LEVELS] = {0};
    spacings(study, h);
    for (size_t i = 0; i < study->level_count; i++) {
        e[i] = study->level[i].error[which];
    }
    return verify_error_convergence(study->level_count, h, e, order);
}

/* Three levels have one order alone to show, but where the exact value is known its error has two: if these have not
 * settled, neither has that. */
static struct verify_extrapolation of_figure(const struct verify_study *study, size_t which)
{
    double h[SOLVER_LEVELS] = {0}, f[SOLVER_LEVELS] = {0}, e[SOLVER_LEVELS] = {0}, order[2];
    spacings(study, h);
    for (size_t i = 0; i < study->level_count; i++) {
        f[i] = study->level[i].figure[which].measured;
        e[i] = study->level[i].figure[which].error;
    }
    struct verify_extrapolation found = verify_extrapolate(study->level_count, h, f);
    enum verify_convergence of_errors = verify_error_convergence(study->level_count, h, e, order);
    if (found.state == VERIFY_ONE_ORDER && of_errors != VERIFY_ASYMPTOTIC && of_errors != VERIFY_UNMEASURED) {
        found.state = VERIFY_UNSETTLED;
    }
    return found;
}

/* Whether the exact value is where the levels say that the limit is: "yes", "no", or "-" where one of them is not
 * known. */
static const char *holds(const struct verify_extrapolation *found, double exact)
{
    return !(isfinite(exact) && isfinite(found->uncertainty)) ? "-"
           : fabs(found->limit - exact) <= found->uncertainty ? "yes"
                                                              : "no";
}

void verify_terminal_convergence(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    if (study->truth->none || study->level_count < 3) {
        return;
    }
    (void)fprintf(file, "orders of the last two pairs of levels:\n");
    for (size_t i = 0; i < shown_count && verify_error_has_order(shown[i]); i++) {
        double order[2];
        enum verify_convergence state = of_error(study, shown[i], order);
        char first[32], second[32];
        (void)fprintf(file, "  %-24s %6s, then %6s  %s\n", verify_error_name(shown[i]),
                      verify_order_text(first, order[0]), verify_order_text(second, order[1]),
                      verify_convergence_meaning(state));
    }
}

void verify_terminal_extrapolation(FILE *file, const struct verify_study *study)
{
    for (size_t i = 0; i < study->scene->figure_count && study->level_count > 2; i++) {
        struct verify_extrapolation found = of_figure(study, i);
        const struct verify_figure *finest = &study->level[study->level_count - 1].figure[i];
        char uncertainty[32], order[32], limit[32] = "-";
        if (i == 0) {
            (void)fprintf(
                file,
                "\nextrapolated from the three finest levels (Richardson), and grid convergence index, safety "
                "factor 1.25\n  %-24s %16s %10s %-8s %6s %6s\n",
                "figure", "extrapolated", "+-", "unit", "order", "exact");
        }
        if (isfinite(found.limit)) {
            (void)snprintf(limit, sizeof limit, "%.9g", found.limit);
        }
        (void)fprintf(file, "  %-24s %16s %10s %-8s %6s %6s  %s\n", study->scene->figure[i].name, limit,
                      verify_scientific(uncertainty, found.uncertainty), finest->unit,
                      verify_order_text(order, found.order), holds(&found, finest->exact),
                      verify_convergence_meaning(found.state));
    }
    if (study->scene->figure_count > 0 && study->level_count > 2) {
        (void)fprintf(file, "  exact: whether the exact value lies within +- of the extrapolated one\n");
    }
}

void verify_html_convergence(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    if (study->truth->none || study->level_count < 3) {
        return;
    }
    (void)fprintf(file, "<h2>Orders of the last two pairs of levels</h2><table><tr><th>error</th><th>order</th>"
                        "<th>then</th><th></th></tr>\n");
    for (size_t i = 0; i < shown_count && verify_error_has_order(shown[i]); i++) {
        double order[2];
        enum verify_convergence state = of_error(study, shown[i], order);
        (void)fprintf(file, "<tr><td>%s</td>", verify_error_name(shown[i]));
        verify_html_cell(file, "f", order[0]);
        verify_html_cell(file, "f", order[1]);
        (void)fprintf(file, "<td class=\"help\">%s</td></tr>\n", verify_convergence_meaning(state));
    }
    (void)fprintf(file, "</table>\n");
}

void verify_html_extrapolation(FILE *file, const struct verify_study *study)
{
    if (study->scene->figure_count == 0 || study->level_count < 3) {
        return;
    }
    (void)fprintf(file, "<h2>Figures extrapolated</h2><table><tr><th>figure</th><th>unit</th><th>extrapolated</th>"
                        "<th>&plusmn;</th><th>index [-]</th><th>order</th><th>exact within</th><th></th></tr>\n");
    for (size_t i = 0; i < study->scene->figure_count; i++) {
        struct verify_extrapolation found = of_figure(study, i);
        const struct verify_figure *finest = &study->level[study->level_count - 1].figure[i];
        (void)fprintf(file, "<tr><td>");
        verify_html_text(file, study->scene->figure[i].name);
        (void)fprintf(file, "</td><td>%s</td>", finest->unit);
        verify_html_number(file, found.limit);
        verify_html_cell(file, "e", found.uncertainty);
        verify_html_cell(file, "e", found.index);
        verify_html_cell(file, "f", found.order);
        (void)fprintf(file, "<td>%s</td><td class=\"help\">%s</td></tr>\n", holds(&found, finest->exact),
                      verify_convergence_meaning(found.state));
    }
    (void)fprintf(file, "</table>\n<p class=\"note\">Richardson extrapolation of the three finest levels, and grid "
                        "convergence index with a safety factor of 1.25 (Roache 1994; Celik et al. 2008); neither "
                        "knows anything of the exact value.</p>\n");
}

static void json_error(FILE *file, const struct verify_study *study, size_t which)
{
    double order[2];
    enum verify_convergence state = of_error(study, which, order);
    (void)fprintf(file, "\"%s\": {\"orders\": [", verify_error_name(which));
    verify_json_number(file, order[0]);
    (void)fputs(", ", file);
    verify_json_number(file, order[1]);
    (void)fprintf(file, "], \"state\": \"%s\"}", verify_convergence_word(state));
}

static void json_figure(FILE *file, const struct verify_study *study, size_t which)
{
    struct verify_extrapolation found = of_figure(study, which);
    verify_json_string(file, study->scene->figure[which].name);
    (void)fputs(": {", file);
    verify_json_number_member(file, "extrapolated", found.limit);
    (void)fputs(", ", file);
    verify_json_number_member(file, "uncertainty", found.uncertainty);
    (void)fputs(", ", file);
    verify_json_number_member(file, "index", found.index);
    (void)fputs(", ", file);
    verify_json_number_member(file, "order", found.order);
    (void)fputs(", ", file);
    verify_json_number_member(file, "ratio", found.ratio);
    (void)fprintf(file, ", \"state\": \"%s\"}", verify_convergence_word(found.state));
}

void verify_json_convergence(FILE *file, const struct verify_study *study)
{
    const char *between = "", *lacks = NULL;
    (void)fputs(",\n  \"convergence\": {\"errors\": {", file);
    for (size_t i = 0; i < VERIFY_BESIDE && study->level_count > 2; i++) {
        if (verify_error_applies(study->scene, i, &lacks)) {
            (void)fputs(between, file);
            json_error(file, study, i);
            between = ", ";
        }
    }
    (void)fputs("}, \"figures\": {", file);
    for (size_t i = 0; i < study->scene->figure_count && study->level_count > 2; i++) {
        (void)fputs(i == 0 ? "" : ", ", file);
        json_figure(file, study, i);
    }
    (void)fputs("}}", file);
}
