#include "verify/json.h"

#include <math.h>
#include <stddef.h>

void verify_json_string(FILE *file, const char *text)
{
    (void)fputc('"', file);
    for (const char *c = text; *c != '\0';) {
        size_t length = solver_utf8(c);
        if (*c == '"' || *c == '\\') {
            (void)fprintf(file, "\\%c", *c);
        } else if (length == 1 && (*c < ' ' || *c == 0x7F)) {
            (void)fprintf(file, "\\u%04x", (unsigned)*c);
        } else if (length == 0) {
            (void)fputs("\\ufffd", file);
        } else {
            (void)fwrite(c, 1, length, file);
        }
        c += length == 0 ? 1 : length;
    }
    (void)fputc('"', file);
}

void verify_json_number(FILE *file, double value)
{
    if (isfinite(value)) {
        (void)fprintf(file, "%.17g", value);
    } else {
        (void)fputs("null", file);
    }
}

void verify_json_text_member(FILE *file, const char *key, const char *text)
{
    (void)fprintf(file, "\"%s\": ", key);
    verify_json_string(file, text);
}

void verify_json_number_member(FILE *file, const char *key, double value)
{
    (void)fprintf(file, "\"%s\": ", key);
    verify_json_number(file, value);
}

/* `why`: the value is no number; "": it is one. */
static void gate_object(FILE *file, const char *name, double value, double bound, const char *op, bool pass,
                        const char *why)
{
    (void)fputc('{', file);
    verify_json_text_member(file, "name", name);
    (void)fputs(", ", file);
    verify_json_number_member(file, "value", value);
    (void)fputs(", ", file);
    verify_json_number_member(file, "bound", bound);
    (void)fprintf(file, ", \"op\": \"%s\", \"pass\": %s", op, pass ? "true" : "false");
    if (why[0] != '\0') {
        (void)fputs(", ", file);
        verify_json_text_member(file, "why", why);
    }
    (void)fputc('}', file);
}

/* Lines of the oracle's self-check that fail stand among the gates: they decide too. */
void verify_json_verdict(FILE *file, const struct verify_truth *truth, const struct verify_gates *gates)
{
    const char *between = "\n    ";
    (void)fputs(",\n  \"gates\": [", file);
    for (size_t i = 0; i < truth->check_count; i++) {
        const struct oracle_check *line = &truth->check[i];
        if (!oracle_law_holds(line)) {
            char name[256];
            (void)snprintf(name, sizeof name, "oracle self-check: %s", line->law);
            (void)fputs(between, file);
            gate_object(file, name, line->residual, line->bound, "<=", false,
                        isfinite(line->residual) ? "" : "the residual is no number");
            between = ",\n    ";
        }
    }
    for (size_t i = 0; i < gates->count; i++) {
        const struct verify_gate *gate = &gates->gate[i];
        (void)fputs(between, file);
        gate_object(file, gate->name, gate->value, gate->bound, gate->op, gate->pass, gate->why);
        between = ",\n    ";
    }
    const char *verdict = !truth->proven || (gates->count > 0 && !gates->pass) ? "false"
                          : gates->count > 0                                   ? "true"
                                                                               : "null";
    (void)fprintf(file, "],\n  \"pass\": %s\n}\n", verdict);
}
