/* A record as the bytes of an HDF5 file.
 *
 * The file is built in memory (HDF5's core driver) and written to disk by file.c: a full disk then meets plain writes
 * that say so, not a library half-way through closing a file. The 1.8 file format takes attributes of more than
 * 64 KiB (long scenes); VTK 9.1 reads it. */
#include "solver/record_format.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct sink {
    hid_t file;
    struct solver_error *error;
};

static bool refuse(struct sink *sink, const char *name)
{
    char reason[256];
    record_hdf5_reason(reason, sizeof reason);
    return solver_fail(sink->error, SOLVER_IO, "cannot build record: HDF5 refuses %s: %s", name, reason);
}

/* HDF5 refuses a negative handle and says so in its result: chains of calls need one check at their end. */

static bool put_attribute(struct sink *sink, hid_t where, const char *name, hid_t type, const void *value)
{
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(where, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool ok = H5Awrite(attribute, type, value) >= 0 || refuse(sink, name);
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
    return ok;
}

static hid_t text_type(size_t size, H5T_cset_t letters)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    if (H5Tset_size(type, size) < 0 || H5Tset_cset(type, letters) < 0) {
        (void)H5Tclose(type);
        return H5I_INVALID_HID;
    }
    return type;
}

static bool put_text(struct sink *sink, hid_t where, const char *name, const char *text)
{
    hid_t type = text_type(strlen(text) + 1, H5T_CSET_UTF8);
    bool ok = put_attribute(sink, where, name, type, text);
    (void)H5Tclose(type);
    return ok;
}

struct block {
    const char *name, *unit;
    hid_t type; /* in the file; memory holds the same */
    int rank;
    hsize_t dims[2];
    const void *data;
};

static bool put_block(struct sink *sink, hid_t where, const struct block *block)
{
    hid_t space = H5Screate_simple(block->rank, block->dims, NULL);
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    (void)H5Pset_obj_track_times(properties, false);
    hid_t data = H5Dcreate2(where, block->name, block->type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    bool ok = H5Dwrite(data, block->type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block->data) >= 0 || refuse(sink, block->name);
    ok = ok && put_text(sink, data, "unit", block->unit);
    if (data >= 0) {
        (void)H5Dclose(data);
    }
    (void)H5Pclose(properties);
    (void)H5Sclose(space);
    return ok;
}

static bool put_numbers(struct sink *sink, hid_t where, const char *name, const char *unit, const double *value,
                        size_t rows, size_t columns)
{
    struct block block = {name, unit, H5T_IEEE_F64LE, columns == 1 ? 1 : 2, {rows, columns}, value};
    return put_block(sink, where, &block);
}

static bool put_integer(struct sink *sink, hid_t where, const char *name, size_t value)
{
    int64_t number = (int64_t)value;
    struct block block = {name, "-", H5T_STD_I64LE, 1, {1, 1}, &number};
    return put_block(sink, where, &block);
}

/* No time stamps; links and attributes within the group's own header, where they are few. */
static hid_t group_properties(hid_t class)
{
    enum { MANY = 2 * RECORD_MAX_FIELDS };
    hid_t properties = H5Pcreate(class);
    (void)H5Pset_obj_track_times(properties, false);
    (void)H5Pset_link_phase_change(properties, MANY, 0);
    (void)H5Pset_attr_phase_change(properties, MANY, 0);
    return properties;
}

static hid_t create_group(struct sink *sink, hid_t where, const char *name)
{
    hid_t properties = group_properties(H5P_GROUP_CREATE);
    hid_t group = H5Gcreate2(where, name, H5P_DEFAULT, properties, H5P_DEFAULT);
    if (group < 0) {
        (void)refuse(sink, name);
    }
    (void)H5Pclose(properties);
    return group;
}

static bool put_cells(struct sink *sink, hid_t grid, const struct solver_record *record)
{
    const size_t width = (size_t)record->cell_width, cells = record->cell_count, corners = cells * width;
    int64_t *corner = malloc((corners + 1) * sizeof *corner);
    int64_t *offset = malloc((cells + 1) * sizeof *offset);
    uint8_t *type = malloc(cells + 1);
    bool ok = corner != NULL && offset != NULL && type != NULL;
    if (!ok) {
        (void)solver_fail(sink->error, SOLVER_NO_MEMORY, "record's cells: no memory for %zu corners", corners);
    } else {
        for (size_t i = 0; i < corners; i++) {
            corner[i] = record->cell[i];
        }
        for (size_t c = 0; c <= cells; c++) {
            offset[c] = (int64_t)(c * width);
        }
        memset(type, record_vtk_type(record->cell_width), cells);
        ok = put_block(sink, grid, &(struct block){"Connectivity", "-", H5T_STD_I64LE, 1, {corners, 1}, corner}) &&
             put_block(sink, grid, &(struct block){"Offsets", "-", H5T_STD_I64LE, 1, {cells + 1, 1}, offset}) &&
             put_block(sink, grid, &(struct block){"Types", "-", H5T_STD_U8LE, 1, {cells, 1}, type});
    }
    free(corner);
    free(offset);
    free(type);
    return ok;
}

/* Tags are bit sets: whole numbers in the file, as a viewer's filters expect. */
static bool put_tags(struct sink *sink, hid_t where, const struct solver_record_field *field, size_t count)
{
    uint32_t *tags = malloc((count + 1) * sizeof *tags);
    if (tags == NULL) {
        return solver_fail(sink->error, SOLVER_NO_MEMORY, "record's tags: no memory for %zu", count);
    }
    bool ok = true;
    for (size_t a = 0; ok && a < count; a++) {
        const double tag = field->value[a];
        ok = (tag >= 0.0 && tag <= (double)UINT32_MAX && tag == trunc(tag)) ||
             solver_fail(sink->error, SOLVER_BAD_INPUT,
                         "record's tags: particle %zu has %g, expected a whole number from 0 to 2^32 - 1", a, tag);
        tags[a] = ok ? (uint32_t)tag : 0;
    }
    ok = ok && put_block(sink, where, &(struct block){field->name, field->unit, H5T_STD_U32LE, 1, {count, 1}, tags});
    free(tags);
    return ok;
}

static bool put_fields(struct sink *sink, hid_t grid, const struct solver_record *record)
{
    hid_t group = create_group(sink, grid, "PointData");
    bool ok = group >= 0;
    for (size_t i = 0; ok && i < record->field_count; i++) {
        const struct solver_record_field *field = &record->field[i];
        ok = strcmp(field->name, "tags") == 0 ? put_tags(sink, group, field, record->count)
                                              : put_numbers(sink, group, field->name, field->unit, field->value,
                                                            record->count, (size_t)field->width);
    }
    if (group >= 0) {
        (void)H5Gclose(group);
    }
    return ok;
}

static bool put_grid(struct sink *sink, const struct solver_record *record)
{
    static const int64_t version[2] = {1, 0};
    static const char type[] = "UnstructuredGrid";
    hid_t grid = create_group(sink, sink->file, "VTKHDF");
    if (grid < 0) {
        return false;
    }
    hsize_t two = 2;
    hid_t space = H5Screate_simple(1, &two, NULL);
    hid_t attribute = H5Acreate2(grid, "Version", H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    bool ok = H5Awrite(attribute, H5T_STD_I64LE, version) >= 0 || refuse(sink, "Version");
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
    hid_t data = -1, letters = text_type(sizeof type - 1, H5T_CSET_ASCII); /* VTK 9.2 insists on ASCII */
    ok = ok && put_attribute(sink, grid, "Type", letters, type) &&
         put_integer(sink, grid, "NumberOfPoints", record->count) &&
         put_integer(sink, grid, "NumberOfCells", record->cell_count) &&
         put_integer(sink, grid, "NumberOfConnectivityIds", record->cell_count * (size_t)record->cell_width) &&
         put_numbers(sink, grid, "Points", "m", record->X, record->count, 3) && put_cells(sink, grid, record) &&
         put_fields(sink, grid, record);
    if (ok) {
        data = create_group(sink, grid, "FieldData");
        ok = data >= 0 && put_numbers(sink, data, "TimeValue", "s", &record->time, 1, 1);
    }
    if (data >= 0) {
        (void)H5Gclose(data);
    }
    (void)H5Tclose(letters);
    (void)H5Gclose(grid);
    return ok;
}

static bool put_history(struct sink *sink, const struct solver_record *record)
{
    hid_t group = create_group(sink, sink->file, "history");
    if (group < 0) {
        return false;
    }
    const hsize_t columns = record->history_columns;
    hid_t name = text_type(SOLVER_NAME, H5T_CSET_UTF8), unit = text_type(RECORD_UNIT, H5T_CSET_UTF8);
    struct block values = {"values", "see units", H5T_IEEE_F64LE, 2, {record->history_count, columns}, record->history};
    bool ok = put_block(sink, group, &values) &&
              put_block(sink, group, &(struct block){"columns", "-", name, 1, {columns, 1}, record->history_name}) &&
              put_block(sink, group, &(struct block){"units", "-", unit, 1, {columns, 1}, record->history_unit});
    (void)H5Tclose(name);
    (void)H5Tclose(unit);
    (void)H5Gclose(group);
    return ok;
}

static bool put_attributes(struct sink *sink, const struct solver_record *record)
{
    const hid_t root = sink->file;
    const int64_t dim = record->dim, step = (int64_t)record->step;
    return put_text(sink, root, "format", RECORD_FORMAT) && put_attribute(sink, root, "dim", H5T_STD_I64LE, &dim) &&
           put_attribute(sink, root, "step", H5T_STD_I64LE, &step) &&
           put_attribute(sink, root, "time", H5T_IEEE_F64LE, &record->time) &&
           put_text(sink, root, "scene_name", record->scene_name) &&
           put_text(sink, root, "scene_text", record->scene_text) &&
           put_text(sink, root, "overrides", record->overrides) && put_text(sink, root, "command", record->command) &&
           put_text(sink, root, "version", record->version);
}

/* Memory of HDF5's core driver. H5Fget_file_image would be shorter, but HDF5 1.10 gives an image whose superblock does
 * not match its own checksum: it clears a flag and keeps the sum. What the driver holds at the end is right. */
struct image {
    unsigned char *bytes; /* what the file held when it was closed */
};

static void *image_malloc(size_t size, H5FD_file_image_op_t when, void *context)
{
    (void)when, (void)context;
    return malloc(size);
}

static void *image_memcpy(void *to, const void *from, size_t size, H5FD_file_image_op_t when, void *context)
{
    (void)when, (void)context;
    return memcpy(to, from, size);
}

static void *image_realloc(void *bytes, size_t size, H5FD_file_image_op_t when, void *context)
{
    (void)when, (void)context;
    return realloc(bytes, size);
}

static herr_t image_free(void *bytes, H5FD_file_image_op_t when, void *context)
{
    if (when == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
        ((struct image *)context)->bytes = bytes;
    } else {
        free(bytes);
    }
    return 0;
}

static void *image_context(void *context)
{
    return context;
}

static herr_t image_context_free(void *context)
{
    (void)context;
    return 0;
}

static hid_t create_in_memory(struct image *image)
{
    enum { GROW = 1 << 20 };
    hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = group_properties(H5P_FILE_CREATE);
    hid_t file = H5I_INVALID_HID;
    H5FD_file_image_callbacks_t calls = {image_malloc,  image_memcpy,       image_realloc, image_free,
                                         image_context, image_context_free, image};
    if (H5Pset_fapl_core(access, GROW, false) >= 0 && H5Pset_file_image_callbacks(access, &calls) >= 0 &&
        H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18) >= 0 &&
        H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0) {
        file = H5Fcreate("record in memory", H5F_ACC_TRUNC, creation, access);
    }
    (void)H5Pclose(access);
    (void)H5Pclose(creation);
    return file;
}

/* The end-of-file address in the superblock, version 2 (HDF5 File Format Specification, II.A). The driver's memory is
 * that long or longer. */
static size_t image_size(const struct image *image)
{
    enum { END_OF_FILE = 28 };
    uint64_t size;
    memcpy(&size, image->bytes + END_OF_FILE, sizeof size);
    return (size_t)size;
}

static bool seal(struct image *image, void **bytes, size_t *size, struct solver_error *error)
{
    const size_t length = image_size(image);
    unsigned char *sealed = realloc(image->bytes, length + SOLVER_SEAL_SIZE);
    if (sealed == NULL) {
        free(image->bytes);
        return solver_fail(error, SOLVER_NO_MEMORY, "record: no memory for %zu bytes", length);
    }
    const uint64_t sum = solver_seal_sum(SOLVER_SEAL_SEED, sealed, length);
    memcpy(sealed + length, SOLVER_SEAL, 8);
    memcpy(sealed + length + 8, &sum, sizeof sum);
    *bytes = sealed;
    *size = length + SOLVER_SEAL_SIZE;
    return true;
}

bool record_to_hdf5(const struct solver_record *record, void **bytes, size_t *size, struct solver_error *error)
{
    struct record_quiet before = record_quiet_begin();
    struct image image = {0};
    struct sink sink = {.file = create_in_memory(&image), .error = error};
    bool ok = sink.file >= 0 || refuse(&sink, "a new file");
    ok = ok && put_attributes(&sink, record) && put_grid(&sink, record) && put_history(&sink, record);
    if (sink.file >= 0 && H5Fclose(sink.file) < 0 && ok) {
        ok = refuse(&sink, "the finished file");
    }
    record_quiet_end(before);
    if (!ok || image.bytes == NULL) {
        free(image.bytes);
        return ok ? solver_fail(error, SOLVER_IO, "cannot build record: HDF5 kept no bytes") : false;
    }
    return seal(&image, bytes, size, error);
}
