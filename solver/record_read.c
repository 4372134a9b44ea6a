#include "solver/record_source.h"

#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_attributes(struct record_source *source, struct solver_record *record)
{
    char *format;
    if (!record_attribute_text(source, source->file, "format", &format)) {
        return false;
    }
    bool ours = strcmp(format, RECORD_FORMAT) == 0;
    if (!ours) {
        (void)record_refuse(source, "format", "is \"%.40s\", expected \"%s\"", format, RECORD_FORMAT);
    }
    free(format);
    int64_t dim, step;
    const hid_t root = source->file;
    if (!ours || !record_attribute(source, root, "dim", H5T_STD_I64LE, &dim) ||
        !record_attribute(source, root, "step", H5T_STD_I64LE, &step) ||
        !record_attribute(source, root, "time", H5T_IEEE_F64LE, &record->time) ||
        !record_attribute_text(source, root, "scene_name", &record->scene_name) ||
        !record_attribute_text(source, root, "scene_text", &record->scene_text) ||
        !record_attribute_text(source, root, "overrides", &record->overrides) ||
        !record_attribute_text(source, root, "command", &record->command) ||
        !record_attribute_text(source, root, "version", &record->version)) {
        return false;
    }
    if (dim < 1 || dim > 3) {
        return record_refuse(source, "dim", "is %lld, expected 1, 2 or 3", (long long)dim);
    }
    if (step < 0 || !isfinite(record->time)) {
        return record_refuse(source, "time", "is %g at step %lld, expected a finite number and a step from 0",
                             record->time, (long long)step);
    }
    record->dim = (int)dim;
    record->step = (size_t)step;
    return true;
}

static bool read_count(struct record_source *source, hid_t grid, const char *name, size_t *count)
{
    struct record_block block;
    if (!record_block_read_shaped(source, grid, name, H5T_STD_I64LE, 1, 1, &block)) {
        return false;
    }
    int64_t value;
    memcpy(&value, block.data, sizeof value);
    free(block.data);
    *count = (size_t)value;
    return (value >= 0 && value <= (int64_t)UINT32_MAX) ||
           record_refuse(source, name, "is %lld, expected 0 to 2^32 - 1", (long long)value);
}

/* Every cell must be of the body's kind; types and offsets, needed by VTK, say nothing more. */
static bool check_types(struct record_source *source, hid_t grid, const struct solver_record *record)
{
    struct record_block types, offsets;
    const size_t cells = record->cell_count;
    if (!record_block_read_shaped(source, grid, "Types", H5T_STD_U8LE, cells, 1, &types)) {
        return false;
    }
    if (!record_block_read_shaped(source, grid, "Offsets", H5T_STD_I64LE, cells + 1, 1, &offsets)) {
        free(types.data);
        return false;
    }
    const uint8_t *type = types.data, wanted = record_vtk_type(record->cell_width);
    const int64_t *offset = offsets.data;
    size_t c = 0;
    while (c < cells && type[c] == wanted && offset[c] == (int64_t)c * record->cell_width) {
        c++;
    }
    bool ok = offset[c] == (int64_t)c * record->cell_width && c == cells;
    free(types.data);
    free(offsets.data);
    return ok ||
           record_refuse(source, "Types and Offsets", "cell %zu is not as in a record of dimension %d", c, record->dim);
}

static bool read_cells(struct record_source *source, hid_t grid, struct solver_record *record)
{
    struct record_block block;
    const size_t corners = record->cell_count * (size_t)record->cell_width;
    if (!record_block_read_shaped(source, grid, "Connectivity", H5T_STD_I64LE, corners, 1, &block)) {
        return false;
    }
    void *cell;
    if (!solver_alloc(&cell, corners, sizeof(uint32_t), "record's cells", source->error)) {
        free(block.data);
        return false;
    }
    record->cell = cell;
    const int64_t *corner = block.data;
    bool ok = true;
    for (size_t i = 0; ok && i < corners; i++) {
        ok = corner[i] >= 0 && (uint64_t)corner[i] < record->count;
        record->cell[i] = ok ? (uint32_t)corner[i] : 0;
        if (!ok) {
            (void)record_refuse(source, "Connectivity", "entry %zu is particle %lld of %zu", i, (long long)corner[i],
                                record->count);
        }
    }
    free(block.data);
    return ok;
}

static bool read_body(struct record_source *source, hid_t grid, struct solver_record *record)
{
    struct record_block points;
    size_t ids;
    record->cell_width = 1 << record->dim;
    if (!read_count(source, grid, "NumberOfPoints", &record->count) ||
        !read_count(source, grid, "NumberOfCells", &record->cell_count) ||
        !read_count(source, grid, "NumberOfConnectivityIds", &ids)) {
        return false;
    }
    if (ids != record->cell_count * (size_t)record->cell_width) {
        return record_refuse(source, "NumberOfConnectivityIds", "is %zu, expected %d for each of %zu cells", ids,
                             record->cell_width, record->cell_count);
    }
    if (!record_block_read_shaped(source, grid, "Points", H5T_IEEE_F64LE, record->count, 3, &points)) {
        return false;
    }
    record->X = points.data;
    return read_cells(source, grid, record) && check_types(source, grid, record);
}

static bool read_field(struct record_source *source, hid_t group, struct solver_record *record,
                       struct solver_record_field *field)
{
    struct record_block block;
    const bool tags = strcmp(field->name, "tags") == 0;
    if (!record_block_read(source, group, field->name, tags ? H5T_STD_U32LE : H5T_IEEE_F64LE, &block)) {
        return false;
    }
    memcpy(field->unit, block.unit, sizeof field->unit);
    const size_t width = block.dims[1];
    bool ok = block.dims[0] == record->count && (width == 1 || width == 3 || width == 9) && (!tags || width == 1);
    if (!ok) {
        free(block.data);
        return record_refuse(source, field->name, "has %zu x %zu values, expected 1, 3 or 9 for each of %zu particles",
                             block.dims[0], width, record->count);
    }
    field->width = (int)width;
    field->value = block.data;
    if (tags) {
        void *value;
        ok = solver_alloc(&value, record->count, sizeof(double), "record's tags", source->error);
        for (size_t a = 0; ok && a < record->count; a++) {
            ((double *)value)[a] = ((const uint32_t *)block.data)[a];
        }
        free(block.data);
        field->value = value;
    }
    return ok;
}

static bool has_known(struct record_source *source, const struct solver_record *record)
{
    for (const struct record_known *known = record_known; known->name != NULL; known++) {
        const struct solver_record_field *field = solver_record_find(record, known->name);
        if (field == NULL ? known->required : field->width != known->width) {
            return record_refuse(source, known->name, "%s; expected %d number%s a particle",
                                 field == NULL ? "field is missing" : "field has another width", known->width,
                                 known->width == 1 ? "" : "s");
        }
    }
    return true;
}

static bool read_fields(struct record_source *source, hid_t grid, struct solver_record *record)
{
    hid_t group;
    if (!record_group(source, grid, "PointData", &group)) {
        return false;
    }
    H5G_info_t about;
    void *fields;
    bool ok = (H5Gget_info(group, &about) >= 0 && about.nlinks <= RECORD_MAX_FIELDS) ||
              record_refuse(source, "PointData", "expected at most %d fields", RECORD_MAX_FIELDS);
    ok = ok && solver_alloc(&fields, RECORD_MAX_FIELDS, sizeof *record->field, "record's fields", source->error);
    record->field = ok ? fields : NULL;
    for (hsize_t i = 0; ok && i < about.nlinks; i++) {
        struct solver_record_field *field = &record->field[i];
        ssize_t length =
            H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, field->name, SOLVER_NAME, H5P_DEFAULT);
        ok = (length > 0 && length < SOLVER_NAME) ||
             record_refuse(source, "PointData", "field %llu has no name of 1 to %d bytes", (unsigned long long)i,
                           SOLVER_NAME - 1);
        ok = ok && read_field(source, group, record, field);
        record->field_count = (size_t)i + (field->value != NULL);
    }
    (void)H5Gclose(group);
    return ok && has_known(source, record);
}

/* Reads [columns] texts of `size` bytes, each ending with a zero byte. */
static bool read_names(struct record_source *source, hid_t group, const char *name, size_t columns, size_t size,
                       void **out)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    (void)H5Tset_size(type, size);
    (void)H5Tset_cset(type, H5T_CSET_UTF8);
    struct record_block block;
    bool ok = record_block_read_shaped(source, group, name, type, columns, 1, &block);
    (void)H5Tclose(type);
    *out = ok ? block.data : NULL;
    for (size_t i = 0; ok && i < columns; i++) {
        const char *text = (const char *)*out + i * size;
        ok = memchr(text, '\0', size) != NULL || record_refuse(source, name, "entry %zu does not end", i);
    }
    return ok;
}

static bool read_history(struct record_source *source, struct solver_record *record)
{
    hid_t group;
    struct record_block block;
    if (!record_group(source, source->file, "history", &group)) {
        return false;
    }
    bool ok = record_block_read(source, group, "values", H5T_IEEE_F64LE, &block);
    if (ok) {
        record->history = block.data;
        record->history_count = block.dims[0];
        record->history_columns = block.dims[1];
        ok = (block.rank == 2 && block.dims[1] >= 1 && block.dims[1] <= RECORD_MAX_COLUMNS) ||
             record_refuse(source, "history/values", "has %zu columns, expected 1 to %d", block.dims[1],
                           RECORD_MAX_COLUMNS);
    }
    void *name = NULL, *unit = NULL;
    ok = ok && read_names(source, group, "columns", record->history_columns, SOLVER_NAME, &name) &&
         read_names(source, group, "units", record->history_columns, RECORD_UNIT, &unit);
    record->history_name = name;
    record->history_unit = unit;
    (void)H5Gclose(group);
    return ok;
}

bool solver_record_read(const char *path, struct solver_record **out, struct solver_error *error)
{
    *out = NULL;
    void *memory;
    if (!solver_alloc(&memory, 1, sizeof(struct solver_record), "record", error)) {
        return false;
    }
    struct solver_record *record = memory;
    struct record_source source;
    struct record_quiet before = record_quiet_begin();
    hid_t grid = H5I_INVALID_HID;
    bool ok = record_open(&source, path, error) && read_attributes(&source, record) &&
              record_group(&source, source.file, "VTKHDF", &grid) && read_body(&source, grid, record) &&
              read_fields(&source, grid, record) && read_history(&source, record);
    if (grid >= 0) {
        (void)H5Gclose(grid);
    }
    record_close(&source);
    record_quiet_end(before);
    if (ok) {
        *out = record;
    } else {
        solver_record_free(record);
    }
    return ok;
}
