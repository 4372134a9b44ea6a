#include "verify/report.h"

#include <math.h>
#include <string.h>

/* Bytes of the valid UTF-8 sequence at `c`; 0 if there is none (overlong, surrogate, cut short, out of range). */
static size_t sequence(const unsigned char *c)
{
    if (c[0] < 0x80) {
        return 1;
    }
    size_t length = c[0] >= 0xF0 ? 4 : c[0] >= 0xE0 ? 3 : 2;
    if (c[0] < 0xC2 || c[0] > 0xF4) {
        return 0;
    }
    for (size_t i = 1; i < length; i++) {
        if ((c[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    bool wrong = (c[0] == 0xE0 && c[1] < 0xA0) || (c[0] == 0xED && c[1] > 0x9F) || (c[0] == 0xF0 && c[1] < 0x90) ||
                 (c[0] == 0xF4 && c[1] > 0x8F);
    return wrong ? 0 : length;
}

void verify_json_string(FILE *file, const char *text)
{
    (void)fputc('"', file);
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0';) {
        size_t length = sequence(c);
        if (*c == '"' || *c == '\\') {
            (void)fprintf(file, "\\%c", *c);
        } else if (*c < 0x20 || *c == 0x7F) {
            (void)fprintf(file, "\\u%04x", *c);
        } else if (length == 0) {
            (void)fputs("\\ufffd", file);
        } else {
            (void)fwrite(c, 1, length, file);
        }
        c += length == 0 ? 1 : length;
    }
    (void)fputc('"', file);
}

static void number(FILE *file, double value)
{
    if (isfinite(value)) {
        (void)fprintf(file, "%.17g", value);
    } else {
        (void)fputs("null", file);
    }
}

static void text_member(FILE *file, const char *key, const char *text)
{
    (void)fprintf(file, "\"%s\": ", key);
    verify_json_string(file, text);
}

static void number_member(FILE *file, const char *key, double value)
{
    (void)fprintf(file, "\"%s\": ", key);
    number(file, value);
}

/* NAME: value over the first `count` errors, of which only those that the scene and its scheme can have. */
static void errors(FILE *file, const struct solver_scene *scene, size_t count, const double *value)
{
    const char *lacks = NULL;
    const char *between = "";
    for (size_t i = 0; i < count; i++) {
        if (verify_error_applies(scene, i, &lacks)) {
            (void)fputs(between, file);
            number_member(file, verify_error_name(i), value[i]);
            between = ", ";
        }
    }
}

/* {NAME: order} over errors and figures; one level has none. */
static void rates(FILE *file, const struct verify_study *study)
{
    const struct solver_scene *scene = study->scene;
    const struct verify_level *finest = &study->level[study->level_count - 1];
    (void)fputs("],\n  \"rates\": {", file);
    if (study->level_count > 1) {
        errors(file, scene, VERIFY_BESIDE, finest->rate);
        for (size_t i = 0; i < scene->figure_count; i++) {
            char name[SOLVER_NAME + 8];
            (void)snprintf(name, sizeof name, "figure %s", scene->figure[i].name);
            (void)fputs(", ", file);
            verify_json_string(file, name);
            (void)fputs(": ", file);
            number(file, finest->figure[i].rate);
        }
    }
    (void)fputc('}', file);
}

static void snapshots(FILE *file, const struct solver_scene *scene, const struct verify_level *level)
{
    (void)fputs(", \"snapshots\": [", file);
    for (size_t i = 0; i < level->snapshot_count; i++) {
        (void)fputs(i == 0 ? "{" : ", {", file);
        number_member(file, "t", level->snapshot[i].time);
        (void)fputs(", \"errors\": {", file);
        errors(file, scene, VERIFY_STATE_ERRORS, level->snapshot[i].error);
        (void)fputs("}}", file);
    }
    (void)fputc(']', file);
}

/* {NAME: {...}} over the scene's figures. */
static void figures(FILE *file, const struct solver_scene *scene, const struct verify_level *level)
{
    (void)fputs(", \"figures\": {", file);
    for (size_t i = 0; i < scene->figure_count; i++) {
        (void)fputs(i == 0 ? "" : ", ", file);
        verify_json_string(file, scene->figure[i].name);
        (void)fputs(": {", file);
        number_member(file, "measured", level->figure[i].measured);
        (void)fputs(", ", file);
        number_member(file, "exact", level->figure[i].exact);
        (void)fputs(", ", file);
        number_member(file, "error", level->figure[i].error);
        (void)fputc('}', file);
    }
    (void)fputc('}', file);
}

static void indicators(FILE *file, const struct verify_level *level)
{
    (void)fputs(", \"indicators\": {", file);
    for (size_t i = 0; i < VERIFY_INDICATORS; i++) {
        (void)fputs(i == 0 ? "" : ", ", file);
        number_member(file, verify_indicator_name(i), level->indicator[i]);
    }
    (void)fputc('}', file);
}

static void level_object(FILE *file, const struct solver_scene *scene, const struct verify_level *level)
{
    (void)fprintf(file, "{\"n\": %d, ", level->n);
    number_member(file, "h", level->facts.spacing);
    (void)fprintf(file, ", \"particles\": %zu, \"steps\": %zu, ", level->facts.particles, level->facts.steps);
    number_member(file, "seconds", level->facts.seconds);
    (void)fputs(", ", file);
    number_member(file, "ns_per_particle_step", level->ns_per_particle_step);
    (void)fputs(", \"errors\": {", file);
    errors(file, scene, VERIFY_ERRORS, level->error);
    (void)fputc('}', file);
    snapshots(file, scene, level);
    figures(file, scene, level);
    indicators(file, level);
    (void)fputc('}', file);
}

static void gate_object(FILE *file, const char *name, double value, double bound, const char *op, bool pass)
{
    (void)fputc('{', file);
    text_member(file, "name", name);
    (void)fputs(", ", file);
    number_member(file, "value", value);
    (void)fputs(", ", file);
    number_member(file, "bound", bound);
    (void)fprintf(file, ", \"op\": \"%s\", \"pass\": %s}", op, pass ? "true" : "false");
}

/* Lines of the oracle's self-check that fail stand among the gates: they decide too. */
static void gate_list(FILE *file, const struct verify_study *study)
{
    const char *between = "\n    ";
    for (size_t i = 0; i < study->truth->check_count; i++) {
        const struct oracle_check *line = &study->truth->check[i];
        if (!oracle_law_holds(line)) {
            char name[256];
            (void)snprintf(name, sizeof name, "oracle self-check: %s", line->law);
            (void)fputs(between, file);
            gate_object(file, name, line->residual, line->bound, "<=", false);
            between = ",\n    ";
        }
    }
    for (size_t i = 0; i < study->gates.count; i++) {
        const struct verify_gate *gate = &study->gates.gate[i];
        (void)fputs(between, file);
        gate_object(file, gate->name, gate->value, gate->bound, gate->op, gate->pass);
        between = ",\n    ";
    }
}

void verify_json(FILE *file, const struct verify_study *study)
{
    (void)fputs("{\n  ", file);
    text_member(file, "scene", study->scene->name);
    (void)fputs(",\n  ", file);
    text_member(file, "oracle", study->scene->oracle);
    (void)fputs(",\n  ", file);
    text_member(file, "scheme", study->scene->scheme);
    (void)fputs(",\n  ", file);
    text_member(file, "stencil", verify_has_stencil(study->scene) ? study->scene->stencil : "none");
    (void)fputs(",\n  \"levels\": [", file);
    for (size_t i = 0; i < study->level_count; i++) {
        (void)fputs(i == 0 ? "\n    " : ",\n    ", file);
        level_object(file, study->scene, &study->level[i]);
    }
    rates(file, study);
    (void)fputs(",\n  \"gates\": [", file);
    gate_list(file, study);
    const char *verdict = !study->truth->proven || (study->gates.count > 0 && !study->gates.pass) ? "false"
                          : study->gates.count > 0                                                ? "true"
                                                                                                  : "null";
    (void)fprintf(file, "],\n  \"pass\": %s\n}\n", verdict);
}
