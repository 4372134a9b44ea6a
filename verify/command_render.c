#include "verify/commands.h"
#include "verify/files.h"
#include "verify/picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Splits "KEY=value\n" lines in place; the command line's overrides follow, and so win. */
static bool gather_overrides(char *lines, const struct verify_options *options,
                             const char *override[2 * VERIFY_OVERRIDES], size_t *count, struct solver_error *error)
{
    *count = 0;
    char *rest = NULL;
    for (char *line = strtok_r(lines, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        if (*count == VERIFY_OVERRIDES) {
            return solver_fail(error, SOLVER_BAD_INPUT, "the record holds more than %d overrides", VERIFY_OVERRIDES);
        }
        override[(*count)++] = line;
    }
    memcpy(override + *count, options->override, options->override_count * sizeof *override);
    *count += options->override_count;
    return true;
}

/* Loads the scene whose text the record holds. */
static bool scene_of_record(const struct solver_record *record, const struct verify_options *options,
                            struct solver_scene **scene, struct solver_error *error)
{
    const char *override[2 * VERIFY_OVERRIDES];
    char path[VERIFY_PATH];
    size_t count = 0;
    (void)snprintf(path, sizeof path, "%.*s.lua", SOLVER_NAME - 1, record->scene_name);
    return gather_overrides(record->overrides, options, override, &count, error) &&
           solver_scene_load_text(path, record->scene_text, override, count, scene, error);
}

/* --output, or the record's name with .png in place of its ending. */
static bool picture_path(const struct verify_options *options, char path[VERIFY_PATH], struct solver_error *error)
{
    const char *record = options->operand[0];
    const char *slash = strrchr(record, '/'), *dot = strrchr(record, '.');
    size_t stem =
        dot != NULL && dot > record && (slash == NULL || dot > slash + 1) ? (size_t)(dot - record) : strlen(record);
    int length = options->picture != NULL ? snprintf(path, VERIFY_PATH, "%s", options->picture)
                                          : snprintf(path, VERIFY_PATH, "%.*s.png", (int)stem, record);
    if (length >= VERIFY_PATH) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--output: the path is too long");
    }
    if (verify_file_same(record, path)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: is the record itself; choose another -o for its picture",
                           path);
    }
    return true;
}

static bool render(const struct solver_record *record, const struct verify_options *options, struct solver_error *error)
{
    char path[VERIFY_PATH];
    struct solver_scene *scene = NULL;
    if (!picture_path(options, path, error)) {
        return false;
    }
    bool has_scene = record->scene_text[0] != '\0';
    if (!has_scene && options->override_count > 0) {
        return solver_fail(error, SOLVER_BAD_INPUT, "%s: --set has nothing to set: the record holds no scene",
                           options->operand[0]);
    }
    if (has_scene && !scene_of_record(record, options, &scene, error)) {
        return false;
    }
    const struct solver_view *view = scene != NULL && scene->has_view ? &scene->view : NULL;
    bool done =
        verify_picture_write(path, record, view, scene != NULL ? scene->title : record->scene_name, NULL, error);
    solver_scene_free(scene);
    if (done) {
        (void)printf("picture    %s\n", path);
    }
    return done;
}

int verify_command_render(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_record *record = NULL;
    if (!solver_record_read(options->operand[0], &record, &error)) {
        return verify_complain(&error);
    }
    bool done = render(record, options, &error);
    solver_record_free(record);
    return done ? VERIFY_PASSED : verify_complain(&error);
}
