#include "verify/json.h"
#include "verify/report.h"

/* NAME: value over the first `count` errors, of which only those that the scene and its scheme can have. Returns what
 * stands before a further member. */
static const char *errors(FILE *file, const struct solver_scene *scene, size_t count, const double *value)
{
    const char *lacks = NULL;
    const char *between = "";
    for (size_t i = 0; i < count; i++) {
        if (verify_error_applies(scene, i, &lacks)) {
            (void)fputs(between, file);
            verify_json_number_member(file, verify_error_name(i), value[i]);
            between = ", ";
        }
    }
    return between;
}

/* {NAME: order} over errors and figures; one level has none. */
static void rates(FILE *file, const struct verify_study *study)
{
    const struct solver_scene *scene = study->scene;
    const struct verify_level *finest = &study->level[study->level_count - 1];
    (void)fputs("],\n  \"rates\": {", file);
    if (study->level_count > 1) {
        const char *between = errors(file, scene, VERIFY_BESIDE, finest->rate);
        for (size_t i = 0; i < scene->figure_count; i++) {
            char name[SOLVER_NAME + 8];
            (void)snprintf(name, sizeof name, "figure %s", scene->figure[i].name);
            (void)fputs(between, file);
            verify_json_string(file, name);
            (void)fputs(": ", file);
            verify_json_number(file, finest->figure[i].rate);
            between = ", ";
        }
    }
    (void)fputc('}', file);
}

static void snapshots(FILE *file, const struct solver_scene *scene, const struct verify_level *level)
{
    (void)fputs(", \"snapshots\": [", file);
    for (size_t i = 0; i < level->snapshot_count; i++) {
        (void)fputs(i == 0 ? "{" : ", {", file);
        verify_json_number_member(file, "t", level->snapshot[i].time);
        (void)fputs(", \"errors\": {", file);
        (void)errors(file, scene, VERIFY_STATE_ERRORS, level->snapshot[i].error);
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
        verify_json_number_member(file, "measured", level->figure[i].measured);
        (void)fputs(", ", file);
        verify_json_number_member(file, "exact", level->figure[i].exact);
        (void)fputs(", ", file);
        verify_json_number_member(file, "error", level->figure[i].error);
        if (level->figure[i].why[0] != '\0') {
            (void)fputs(", ", file);
            verify_json_text_member(file, "why", level->figure[i].why);
        }
        (void)fputc('}', file);
    }
    (void)fputc('}', file);
}

static void indicators(FILE *file, const struct verify_level *level)
{
    (void)fputs(", \"indicators\": {", file);
    for (size_t i = 0; i < VERIFY_INDICATORS; i++) {
        (void)fputs(i == 0 ? "" : ", ", file);
        verify_json_number_member(file, verify_indicator_name(i), level->indicator[i]);
    }
    (void)fputc('}', file);
}

static void level_object(FILE *file, const struct solver_scene *scene, const struct verify_level *level)
{
    (void)fprintf(file, "{\"n\": %d, ", level->n);
    verify_json_number_member(file, "h", level->facts.spacing);
    (void)fprintf(file, ", \"particles\": %zu, \"steps\": %zu, ", level->facts.particles, level->facts.steps);
    verify_json_number_member(file, "seconds", level->facts.seconds);
    (void)fputs(", ", file);
    verify_json_number_member(file, "ns_per_particle_step", level->ns_per_particle_step);
    (void)fputs(", \"errors\": {", file);
    (void)errors(file, scene, VERIFY_ERRORS, level->error);
    (void)fputc('}', file);
    snapshots(file, scene, level);
    figures(file, scene, level);
    indicators(file, level);
    (void)fputc('}', file);
}

void verify_json(FILE *file, const struct verify_study *study)
{
    (void)fputs("{\n  ", file);
    verify_json_text_member(file, "scene", study->scene->name);
    (void)fputs(",\n  ", file);
    verify_json_text_member(file, "oracle", study->scene->oracle);
    (void)fputs(",\n  ", file);
    verify_json_text_member(file, "scheme", study->scene->scheme);
    (void)fputs(",\n  ", file);
    verify_json_text_member(file, "stencil", verify_has_stencil(study->scene) ? study->scene->stencil : "none");
    (void)fputs(",\n  \"levels\": [", file);
    for (size_t i = 0; i < study->level_count; i++) {
        (void)fputs(i == 0 ? "\n    " : ",\n    ", file);
        level_object(file, study->scene, &study->level[i]);
    }
    rates(file, study);
    verify_json_convergence(file, study);
    verify_json_verdict(file, study->truth, &study->gates);
}
