#include "solver/record_format.h"

#include "solver/file.h"
#include "solver/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool copy_text(char **out, const char *text, struct solver_error *error)
{
    void *copy;
    if (text == NULL) {
        text = "";
    }
    if (!solver_alloc(&copy, strlen(text) + 1, 1, "record's texts", error)) {
        return false;
    }
    memcpy(copy, text, strlen(text) + 1);
    *out = copy;
    return true;
}

/* Adds a field of `rows` x `width` and gives its zeroed values to the caller, who fills them. */
static double *add_field(struct solver_record *record, const char *name, const char *unit, int width,
                         struct solver_error *error)
{
    struct solver_record_field *field = &record->field[record->field_count];
    void *value;
    if (!solver_alloc(&value, record->count * (size_t)width, sizeof(double), name, error)) {
        return NULL;
    }
    (void)snprintf(field->name, sizeof field->name, "%s", name);
    (void)snprintf(field->unit, sizeof field->unit, "%s", unit);
    field->width = width;
    field->value = value;
    record->field_count++;
    return value;
}

static bool add_scalar(struct solver_record *record, const char *name, const char *unit, const double *source,
                       struct solver_error *error)
{
    double *value = add_field(record, name, unit, 1, error);
    if (value != NULL) {
        memcpy(value, source, record->count * sizeof *value);
    }
    return value != NULL;
}

static void pad_vectors(double *value, const double *source, size_t count, int dim)
{
    for (size_t a = 0; a < count; a++) {
        for (int i = 0; i < dim; i++) {
            value[3 * a + (size_t)i] = source[a * (size_t)dim + (size_t)i];
        }
    }
}

static bool add_vector(struct solver_record *record, const char *name, const char *unit, const double *source,
                       struct solver_error *error)
{
    double *value = add_field(record, name, unit, 3, error);
    if (value != NULL) {
        pad_vectors(value, source, record->count, record->dim);
    }
    return value != NULL;
}

/* In-plane blocks; out of the plane the diagonal has `normal`, or 1 where it is NULL. No source, no field. */
static bool add_tensor(struct solver_record *record, const char *name, const char *unit, const double *source,
                       const double *normal, struct solver_error *error)
{
    double *value = source != NULL ? add_field(record, name, unit, 9, error) : NULL;
    if (value == NULL) {
        return source == NULL;
    }
    size_t dim = (size_t)record->dim;
    for (size_t a = 0; a < record->count; a++) {
        for (size_t i = 0; i < 3; i++) {
            if (i >= dim) {
                value[9 * a + 3 * i + i] = normal != NULL ? normal[a] : 1.0;
            }
            for (size_t j = 0; i < dim && j < dim; j++) {
                value[9 * a + 3 * i + j] = source[(a * dim + i) * dim + j];
            }
        }
    }
    return true;
}

/* No source, no field. */
static bool add_numbers(struct solver_record *record, const char *name, const uint32_t *source,
                        struct solver_error *error)
{
    double *value = source != NULL ? add_field(record, name, "-", 1, error) : NULL;
    for (size_t a = 0; value != NULL && a < record->count; a++) {
        value[a] = (double)source[a];
    }
    return value != NULL || source == NULL;
}

static bool add_fields(struct solver_record *record, const struct solver_scene *scene,
                       const struct solver_output *output, struct solver_error *error)
{
    static const char *const volume_unit[] = {"", "m", "m^2", "m^3"};
    void *field;
    if (!solver_alloc(&field, RECORD_MAX_FIELDS, sizeof *record->field, "record's fields", error)) {
        return false;
    }
    record->field = field;
    return add_tensor(record, "F", "-", output->F, NULL, error) &&
           add_tensor(record, "H", "-", scene->evolved == SOLVER_PFHJ ? output->H : NULL, output->J, error) &&
           add_scalar(record, "J", "-", output->J, error) &&
           add_tensor(record, "P", "Pa", output->P, output->P_normal, error) &&
           add_numbers(record, "body", output->cloud->body, error) &&
           add_vector(record, "displacement", "m", output->u, error) &&
           add_vector(record, "momentum", "kg/(m^2 s)", output->p, error) &&
           (output->plastic_strain == NULL ||
            add_scalar(record, "plastic_strain", "-", output->plastic_strain, error)) &&
           add_scalar(record, "pressure", "Pa", output->pressure, error) &&
           add_tensor(record, "sigma", "Pa", output->sigma, output->sigma_normal, error) &&
           add_numbers(record, "tags", output->cloud->tags, error) &&
           add_vector(record, "velocity", "m/s", output->v, error) &&
           add_scalar(record, "volume", volume_unit[record->dim], output->V, error) &&
           add_scalar(record, "von_mises", "Pa", output->von_mises, error);
}

static bool copy_body(struct solver_record *record, const struct solver_cloud *cloud, struct solver_error *error)
{
    void *X, *cell;
    record->count = cloud->count;
    record->cell_count = cloud->cell_count;
    record->cell_width = 1 << record->dim;
    if (!solver_alloc(&X, record->count * 3, sizeof(double), "record's positions", error)) {
        return false;
    }
    record->X = X;
    pad_vectors(record->X, cloud->X, record->count, record->dim);
    size_t corners = record->cell_count * (size_t)record->cell_width;
    if (!solver_alloc(&cell, corners, sizeof(uint32_t), "record's cells", error)) {
        return false;
    }
    record->cell = cell;
    if (corners > 0) {
        memcpy(record->cell, cloud->cell, corners * sizeof(uint32_t));
    }
    return true;
}

bool solver_record_make(const struct solver_scene *scene, const struct solver_output *output,
                        const struct solver_history *history, const char *command, const char *version,
                        struct solver_record **out, struct solver_error *error)
{
    *out = NULL;
    void *memory;
    if (!solver_alloc(&memory, 1, sizeof(struct solver_record), "record", error)) {
        return false;
    }
    struct solver_record *record = memory;
    record->dim = output->cloud->dim;
    record->step = output->step;
    record->time = output->time;
    if (copy_body(record, output->cloud, error) && add_fields(record, scene, output, error) &&
        record_take_history(record, history, error) && copy_text(&record->scene_name, scene->name, error) &&
        copy_text(&record->scene_text, scene->text, error) && copy_text(&record->overrides, scene->overrides, error) &&
        copy_text(&record->command, command, error) && copy_text(&record->version, version, error)) {
        *out = record;
        return true;
    }
    solver_record_free(record);
    return false;
}

/* The part of `path` before its ending; 0 if the ending is none of ours. */
static size_t stem_length(const char *path)
{
    static const char *const endings[] = {".h5", ".vtkhdf"};
    const char *slash = strrchr(path, '/');
    const char *name = slash == NULL ? path : slash + 1;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t length = strlen(name), ending = strlen(endings[i]);
        if (length > ending && strcmp(name + length - ending, endings[i]) == 0) {
            return strlen(path) - ending;
        }
    }
    return 0;
}

bool solver_record_save(const char *path, const struct solver_record *record, struct solver_error *error)
{
    size_t stem = stem_length(path);
    if (stem == 0 || stem + sizeof ".vtkhdf" > RECORD_PATH) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "cannot write record %.400s: expected a name of at most 4096 bytes that ends in .h5 or "
                           ".vtkhdf",
                           path);
    }
    char xdmf_path[RECORD_PATH], staged[SOLVER_FILE_PATH], xdmf_staged[SOLVER_FILE_PATH];
    (void)snprintf(xdmf_path, sizeof xdmf_path, "%.*s.xdmf", (int)stem, path);
    const char *slash = strrchr(path, '/');
    void *bytes = NULL;
    char *xdmf = NULL;
    size_t size = 0, xdmf_size = 0;
    /* Both are on disk before either gets its name, so that they stay a pair. */
    bool ok = record_to_xdmf(record, slash == NULL ? path : slash + 1, &xdmf, &xdmf_size, error) &&
              record_to_hdf5(record, &bytes, &size, error) && solver_file_stage(path, bytes, size, staged, error);
    if (ok && !solver_file_stage(xdmf_path, xdmf, xdmf_size, xdmf_staged, error)) {
        (void)remove(staged);
        ok = false;
    }
    if (ok && !solver_file_commit(staged, path, error)) {
        (void)remove(xdmf_staged);
        ok = false;
    }
    ok = ok && solver_file_commit(xdmf_staged, xdmf_path, error);
    free(bytes);
    free(xdmf);
    return ok;
}

bool solver_record_write(const char *path, const struct solver_scene *scene, const struct solver_output *output,
                         const struct solver_history *history, const char *command, const char *version,
                         struct solver_error *error)
{
    struct solver_record *record;
    if (!solver_record_make(scene, output, history, command, version, &record, error)) {
        return false;
    }
    bool ok = solver_record_save(path, record, error);
    solver_record_free(record);
    return ok;
}

void solver_record_free(struct solver_record *record)
{
    if (record == NULL) {
        return;
    }
    for (size_t i = 0; i < record->field_count; i++) {
        free(record->field[i].value);
    }
    free(record->field);
    free(record->X);
    free(record->cell);
    free(record->history_name);
    free(record->history_unit);
    free(record->history);
    free(record->scene_name);
    free(record->scene_text);
    free(record->overrides);
    free(record->command);
    free(record->version);
    free(record);
}

const struct solver_record_field *solver_record_find(const struct solver_record *record, const char *name)
{
    for (size_t i = 0; i < record->field_count; i++) {
        if (strcmp(record->field[i].name, name) == 0) {
            return &record->field[i];
        }
    }
    return NULL;
}
