#include "verify/terminal.h"

#include "verify/report.h"

#include <math.h>
#include <string.h>

const char verify_no_oracle[] = "no oracle: nothing here is compared with an exact solution";

/* "%.3e", or a dash where there is no number to show. */
const char *verify_scientific(char text[32], double value)
{
    (void)snprintf(text, 32, isnan(value) ? "-" : "%.3e", value);
    return text;
}

const char *verify_order_text(char text[32], double value)
{
    (void)snprintf(text, 32, isnan(value) ? "-" : "%.2f", value);
    return text;
}

/* Characters of the column of what has this name. */
int verify_width_of(const char *name)
{
    int length = (int)strlen(name);
    return length > 10 ? length : 10;
}

void verify_print_truth(FILE *file, const struct verify_truth *truth)
{
    if (truth->none) {
        (void)fprintf(file, "\n%s\n", verify_no_oracle);
        return;
    }
    (void)fprintf(file, "\noracle     %s: %s\n           source: %s\n", truth->kind->name, truth->kind->summary,
                  truth->kind->source);
    for (size_t i = 0; i < truth->parameter_count; i++) {
        const struct oracle_parameter *parameter = &truth->kind->parameter[i];
        if (truth->told[i]) {
            (void)fprintf(file, "           TOLD %s = %.10g %s in place of the scene's own value\n", parameter->name,
                          truth->value[i], parameter->unit);
        }
    }
    (void)fprintf(file, "\n  %-44s %10s    %s\n", "self-check of the oracle", "residual", "bound [-]");
    for (size_t i = 0; i < truth->check_count; i++) {
        const struct oracle_check *line = &truth->check[i];
        (void)fprintf(file, "  %-44s %10.2e <= %-8.1e %s\n", line->law, line->residual, line->bound,
                      oracle_law_holds(line) ? "holds" : "FAILS");
    }
    struct oracle_figure figure[ORACLE_FIGURES];
    size_t figures = truth->kind->figures != NULL ? truth->kind->figures(truth->oracle, figure) : 0;
    for (size_t i = 0; i < figures; i++) {
        (void)fprintf(file, "%s  %-24s %16.10g %-6s %s\n", i == 0 ? "\n" : "", figure[i].name, figure[i].value,
                      figure[i].unit, figure[i].help);
    }
    if (!truth->proven) {
        (void)fprintf(file, "\nFAIL: the oracle does not prove itself, so nothing can be verified against it\n");
    }
}

void verify_print_gates(FILE *file, const struct verify_gates *gates)
{
    (void)fprintf(file, "\n  %-24s %12s    %-12s %s\n", "gate", "measured", "bound", "unit");
    for (size_t i = 0; i < gates->count; i++) {
        const struct verify_gate *gate = &gates->gate[i];
        bool none = !isfinite(gate->value);
        (void)fprintf(file, "  %-24s %12.4g %s %-12.4g [%s]  %s%s%s%s\n", gate->name, gate->value, gate->op,
                      gate->bound, gate->unit, gate->pass ? "PASS" : "FAIL", none ? " (nothing was measured: " : "",
                      none ? gate->why : "", none ? ")" : "");
    }
}
