#include "verify/sample_schema.h"

#include "solver/record_format.h"
#include "verify/foreign_hdf5.h"
#include "verify/sample_apart.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Where the members of a group go. */
struct level {
    struct verify_sample *sample;
    bool vtk; /* point data beside points that stand elsewhere, and units that may be missing */
};

static bool take_points(struct foreign *foreign, hid_t group, const char *name, struct verify_sample *sample)
{
    struct foreign_block block;
    if (!foreign_block_read(foreign, group, name, &block)) {
        return false;
    }
    bool ok =
        (block.width >= 1 && block.width <= 3) ||
        foreign_refuse(foreign, name, "has %zu x %zu values, expected [points][1, 2 or 3]", block.rows, block.width);
    ok = ok && verify_sample_points(sample, block.rows, (int)block.width, foreign->error);
    for (size_t a = 0; ok && a < block.rows; a++) {
        memcpy(sample->X + 3 * a, block.value + a * block.width, block.width * sizeof *block.value);
    }
    sample->single = block.single;
    sample->has_unit = block.has_unit;
    (void)snprintf(sample->unit, sizeof sample->unit, "%s", block.unit);
    free(block.value);
    return ok;
}

static bool take_rows(struct foreign *foreign, const char *name, const struct foreign_block *block,
                      struct verify_sample *sample)
{
    if (block->rows != sample->count) {
        return foreign_refuse(foreign, name, "has %zu x %zu values, expected one row for each of %zu points",
                              block->rows, block->width, sample->count);
    }
    if (verify_sample_is_weight(name) && block->width == 1) {
        if (!verify_sample_weights(sample, foreign->error)) {
            return false;
        }
        memcpy(sample->weight, block->value, block->rows * sizeof *block->value);
        return true;
    }
    int width = block->width < INT_MAX ? (int)block->width : INT_MAX;
    struct verify_sample_field *field = verify_sample_add(sample, name, width, foreign->error);
    if (field == NULL) {
        return false;
    }
    if (block->has_unit) {
        field->has_unit = true;
        (void)snprintf(field->unit, sizeof field->unit, "%s", block->unit);
    }
    memcpy(field->value, block->value, block->rows * block->width * sizeof *block->value);
    return true;
}

/* A foreign_visit. */
static bool take_member(struct foreign *foreign, hid_t group, const char *name, H5O_type_t type, void *context)
{
    struct level *level = context;
    struct foreign_block block;
    if (type != H5O_TYPE_DATASET || (!level->vtk && strcmp(name, "points") == 0)) {
        return true;
    }
    if (!foreign_block_read(foreign, group, name, &block)) {
        return false;
    }
    bool ok = take_rows(foreign, name, &block, level->sample);
    free(block.value);
    return ok;
}

static bool take_numbers(struct foreign *foreign, hid_t group, struct verify_sample *sample)
{
    static const struct {
        const char *name, *unit;
    } numbers[] = {{"time", "s"}, {"h", "m"}, {"n", "-"}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        double value;
        if (!foreign_number(foreign, group, numbers[i].name, &value) ||
            (!isnan(value) && !verify_sample_number(sample, numbers[i].name, value, numbers[i].unit, foreign->error))) {
            return false;
        }
    }
    return true;
}

/* One level of the judge's own schema; what the level does not say itself holds as the file's root has it. */
static bool take_level(struct foreign *foreign, hid_t group, const char *name, struct verify_samples *samples)
{
    char place[VERIFY_SAMPLE_PLACE];
    (void)snprintf(place, sizeof place, "%.360s%s%.100s", foreign->path, name[0] != '\0' ? ": /" : "", name);
    struct verify_sample *sample = verify_samples_add(samples, place, foreign->error);
    struct level level = {.sample = sample};
    if (sample == NULL) {
        return false;
    }
    sample->needs_units = true;
    return take_numbers(foreign, foreign->file, sample) && take_numbers(foreign, group, sample) &&
           take_points(foreign, group, "points", sample) && foreign_each(foreign, group, take_member, &level);
}

/* A foreign_visit: a group that has points is a level. */
static bool take_group(struct foreign *foreign, hid_t parent, const char *name, H5O_type_t type, void *context)
{
    hid_t group;
    if (type != H5O_TYPE_GROUP) {
        return true;
    }
    if (!foreign_group(foreign, parent, name, &group)) {
        return false;
    }
    bool ok = !foreign_has(group, "points") || take_level(foreign, group, name, context);
    (void)H5Gclose(group);
    return ok;
}

/* A foreign_visit: the time, and what else is a single number. */
static bool take_field_data(struct foreign *foreign, hid_t group, const char *name, H5O_type_t type, void *context)
{
    struct verify_sample *sample = context;
    struct foreign_block block;
    if (type != H5O_TYPE_DATASET || !verify_sample_is_number(name)) {
        return true;
    }
    if (!foreign_block_read(foreign, group, name, &block)) {
        return false;
    }
    bool ok = (block.rows == 1 && block.width == 1) ||
              foreign_refuse(foreign, name, "has %zu x %zu values, expected one", block.rows, block.width);
    ok = ok && verify_sample_number(sample, name, block.value[0], block.has_unit ? block.unit : NULL, foreign->error);
    free(block.value);
    return ok;
}

static bool is_unstructured(struct foreign *foreign, hid_t grid)
{
    char type[32];
    bool found;
    if (!foreign_text(foreign, grid, "Type", type, sizeof type, &found)) {
        return false;
    }
    if (!found || strcmp(type, "UnstructuredGrid") != 0) {
        return foreign_refuse(foreign, "VTKHDF", "its Type is \"%s\", expected \"UnstructuredGrid\"", type);
    }
    return !foreign_has(grid, "Steps") ||
           foreign_refuse(foreign, "VTKHDF/Steps", "holds several times; expected a file of one");
}

static bool take_vtk_parts(struct foreign *foreign, hid_t grid, struct verify_sample *sample)
{
    struct level level = {.sample = sample, .vtk = true};
    hid_t part;
    bool ok = is_unstructured(foreign, grid) && take_points(foreign, grid, "Points", sample);
    if (ok && foreign_has(grid, "PointData")) {
        ok = foreign_group(foreign, grid, "PointData", &part) && foreign_each(foreign, part, take_member, &level);
        (void)H5Gclose(part);
    }
    if (ok && foreign_has(grid, "FieldData")) {
        ok = foreign_group(foreign, grid, "FieldData", &part) && foreign_each(foreign, part, take_field_data, sample);
        (void)H5Gclose(part);
    }
    return ok;
}

static bool take_vtk(struct foreign *foreign, struct verify_samples *samples)
{
    hid_t grid;
    struct verify_sample *sample = verify_samples_add(samples, foreign->path, foreign->error);
    if (sample == NULL || !foreign_group(foreign, foreign->file, "VTKHDF", &grid)) {
        return false;
    }
    bool ok = take_vtk_parts(foreign, grid, sample);
    (void)H5Gclose(grid);
    return ok;
}

/* A record of this program ends with a checksum, which is to hold. */
static bool is_whole_record(struct foreign *foreign)
{
    char format[64];
    bool found;
    struct solver_record *record = NULL;
    if (!foreign_text(foreign, foreign->file, "format", format, sizeof format, &found)) {
        return false;
    }
    bool whole =
        !found || strcmp(format, RECORD_FORMAT) != 0 || solver_record_read(foreign->path, &record, foreign->error);
    solver_record_free(record);
    return whole;
}

static bool take_file(struct foreign *foreign, struct verify_samples *samples)
{
    if (foreign_has(foreign->file, "VTKHDF")) {
        return is_whole_record(foreign) && take_vtk(foreign, samples);
    }
    if (foreign_has(foreign->file, "points")) {
        return take_level(foreign, foreign->file, "", samples);
    }
    size_t before = samples->count;
    return foreign_each(foreign, foreign->file, take_group, samples) &&
           (samples->count > before ||
            foreign_refuse(foreign, "file", "holds neither a dataset \"points\", nor a group with one, nor VTKHDF"));
}

/* The library's version 1.10 crashes on some damaged files. */
bool verify_sample_hdf5(const char *path, size_t size, struct verify_samples *samples, struct solver_error *error)
{
    enum { SECONDS = 60 };
    return verify_sample_apart(verify_schema_read, SECONDS, path, size, samples, error);
}

bool verify_schema_read(const char *path, size_t bytes, struct verify_samples *samples, struct solver_error *error)
{
    struct foreign foreign;
    bool ok = foreign_open(&foreign, path, bytes, error) && take_file(&foreign, samples);
    foreign_close(&foreign);
    return ok;
}
