#include "verify/foreign_hdf5.h"

#include "solver/record_format.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINKS = 1024, MOST_TEXT = 65536, MOST_RANK = 3 };

bool foreign_refuse(struct foreign *foreign, const char *where, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return solver_fail(foreign->error, SOLVER_BAD_INPUT, "%.300s: %.100s: %s", foreign->path, where, what);
}

static bool refuse_hdf5(struct foreign *foreign, const char *where)
{
    char reason[256];
    record_hdf5_reason(reason, sizeof reason);
    return foreign_refuse(foreign, where, "cut short or damaged (HDF5: %s)", reason);
}

bool foreign_open(struct foreign *foreign, const char *path, size_t bytes, struct solver_error *error)
{
    *foreign = (struct foreign){.path = path, .bytes = bytes, .file = H5I_INVALID_HID, .error = error};
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* it would print */
    (void)H5PLset_loading_state(0);              /* a file must not choose code to load */
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    (void)H5Pset_fapl_sec2(access);
    (void)H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    (void)H5Pset_file_locking(access, false, true);
    foreign->file = H5Fopen(path, H5F_ACC_RDONLY, access);
    bool ok = foreign->file >= 0 || refuse_hdf5(foreign, "file");
    (void)H5Pclose(access);
    return ok;
}

void foreign_close(struct foreign *foreign)
{
    if (foreign->file >= 0) {
        (void)H5Fclose(foreign->file);
    }
    foreign->file = H5I_INVALID_HID;
}

bool foreign_has(hid_t group, const char *name)
{
    return H5Lexists(group, name, H5P_DEFAULT) > 0;
}

/* Soft and external links could lead out of the file. */
static bool is_hard(struct foreign *foreign, hid_t parent, const char *name)
{
    H5L_info_t link;
    if (!foreign_has(parent, name)) {
        return foreign_refuse(foreign, name, "missing");
    }
    if (H5Lget_info(parent, name, &link, H5P_DEFAULT) < 0) {
        return refuse_hdf5(foreign, name);
    }
    return link.type == H5L_TYPE_HARD || foreign_refuse(foreign, name, "is a link; expected the data themselves");
}

bool foreign_group(struct foreign *foreign, hid_t parent, const char *name, hid_t *group)
{
    *group = H5I_INVALID_HID;
    if (!is_hard(foreign, parent, name)) {
        return false;
    }
    *group = H5Gopen2(parent, name, H5P_DEFAULT);
    return *group >= 0 || refuse_hdf5(foreign, name);
}

bool foreign_each(struct foreign *foreign, hid_t group, foreign_visit *visit, void *context)
{
    H5G_info_t about;
    if (H5Gget_info(group, &about) < 0) {
        return refuse_hdf5(foreign, "group");
    }
    if (about.nlinks > MOST_LINKS) {
        return foreign_refuse(foreign, "group", "has %llu members, expected at most %d",
                              (unsigned long long)about.nlinks, MOST_LINKS);
    }
    for (hsize_t i = 0; i < about.nlinks; i++) {
        char name[VERIFY_SAMPLE_NAME + VERIFY_SAMPLE_UNIT];
        H5O_info_t object;
        ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT);
        if (length <= 0 || (size_t)length >= sizeof name) {
            return foreign_refuse(foreign, "group", "member %llu has no name of 1 to %zu bytes", (unsigned long long)i,
                                  sizeof name - 1);
        }
        if (!is_hard(foreign, group, name)) {
            return false;
        }
        if (H5Oget_info_by_name2(group, name, &object, H5O_INFO_BASIC, H5P_DEFAULT) < 0) {
            return refuse_hdf5(foreign, name);
        }
        if (!visit(foreign, group, name, object.type, context)) {
            return false;
        }
    }
    return true;
}

static bool shape_of(struct foreign *foreign, hid_t data, const char *name, struct foreign_block *block)
{
    hsize_t dims[MOST_RANK] = {1, 1, 1};
    hid_t space = H5Dget_space(data);
    H5S_class_t class = H5Sget_simple_extent_type(space);
    int rank = class == H5S_SIMPLE ? H5Sget_simple_extent_ndims(space) : class == H5S_SCALAR ? 0 : -1;
    if (rank >= 1 && rank <= MOST_RANK) {
        (void)H5Sget_simple_extent_dims(space, dims, NULL);
    }
    (void)H5Sclose(space);
    if (rank < 0 || rank > MOST_RANK) {
        return foreign_refuse(foreign, name,
                              "has %d dimensions, expected [points], [points][components] or "
                              "[points][rows][columns]",
                              rank);
    }
    block->rows = dims[0];
    block->width = 0;
    if (dims[1] > foreign->bytes * VERIFY_MOST_PACKED || __builtin_mul_overflow(dims[1], dims[2], &block->width) ||
        dims[2] > foreign->bytes * VERIFY_MOST_PACKED) {
        return foreign_refuse(foreign, name, "claims %llu x %llu x %llu values", (unsigned long long)dims[0],
                              (unsigned long long)dims[1], (unsigned long long)dims[2]);
    }
    return true;
}

static bool filters_are_known(hid_t properties)
{
    int count = H5Pget_nfilters(properties);
    for (int i = 0; i < count; i++) {
        unsigned flags, config;
        size_t elements = 0;
        H5Z_filter_t filter = H5Pget_filter2(properties, (unsigned)i, &flags, &elements, NULL, 0, NULL, &config);
        if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_FLETCHER32) {
            return false;
        }
    }
    return count >= 0;
}

/* Bytes of a chunk, which the library asks memory for; 0 where there are none. */
static bool chunk_bytes(hid_t properties, size_t size, uint64_t *bytes)
{
    hsize_t dims[H5S_MAX_RANK];
    int rank = H5Pget_layout(properties) == H5D_CHUNKED ? H5Pget_chunk(properties, H5S_MAX_RANK, dims) : 0;
    *bytes = rank > 0 ? size : 0;
    for (int i = 0; i < rank; i++) {
        if (__builtin_mul_overflow(*bytes, (uint64_t)dims[i], bytes)) {
            return false;
        }
    }
    return rank >= 0;
}

/* The dataset must lie in this file, and claim no more than what is there can hold. */
static bool is_stored_here(struct foreign *foreign, hid_t data, const char *name, const struct foreign_block *block,
                           size_t size)
{
    hid_t properties = H5Dget_create_plist(data);
    H5D_layout_t layout = H5Pget_layout(properties);
    bool plain = (layout == H5D_CONTIGUOUS || layout == H5D_CHUNKED || layout == H5D_COMPACT) &&
                 H5Pget_external_count(properties) == 0 && filters_are_known(properties);
    int filters = H5Pget_nfilters(properties);
    uint64_t chunk = 0, stored = H5Dget_storage_size(data), values, bytes;
    bool chunk_known = chunk_bytes(properties, size, &chunk);
    (void)H5Pclose(properties);
    if (!plain) {
        return foreign_refuse(foreign, name, "is stored elsewhere, or packed by other means than deflate");
    }
    uint64_t most = filters > 0 ? stored * VERIFY_MOST_PACKED : stored;
    if (stored > foreign->bytes || !chunk_known || chunk > (most > 65536 ? most : 65536) ||
        __builtin_mul_overflow((uint64_t)block->rows, (uint64_t)block->width, &values) ||
        __builtin_mul_overflow(values, (uint64_t)size, &bytes) || bytes > most) {
        return foreign_refuse(foreign, name,
                              "claims %zu x %zu values of %zu bytes, more than the %llu bytes that are stored can hold",
                              block->rows, block->width, size, (unsigned long long)stored);
    }
    return true;
}

static bool take_values(struct foreign *foreign, hid_t data, hid_t type, const char *name, struct foreign_block *block)
{
    H5T_class_t class = H5Tget_class(type);
    size_t size = H5Tget_size(type);
    if ((class != H5T_FLOAT && class != H5T_INTEGER) || size == 0 || size > 16) {
        return foreign_refuse(foreign, name, "does not hold numbers");
    }
    if (!shape_of(foreign, data, name, block) || !is_stored_here(foreign, data, name, block, size) ||
        !foreign_text(foreign, data, "unit", block->unit, sizeof block->unit, &block->has_unit) ||
        (!block->has_unit &&
         !foreign_text(foreign, data, "units", block->unit, sizeof block->unit, &block->has_unit))) {
        return false;
    }
    block->single = class == H5T_FLOAT && size < 8;
    block->value = calloc(block->rows * block->width + 1, sizeof *block->value);
    if (block->value == NULL) {
        return solver_fail(foreign->error, SOLVER_NO_MEMORY, "%.300s: %.100s: no memory for %zu x %zu values",
                           foreign->path, name, block->rows, block->width);
    }
    return H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, block->value) >= 0 ||
           refuse_hdf5(foreign, name);
}

bool foreign_block_read(struct foreign *foreign, hid_t group, const char *name, struct foreign_block *block)
{
    *block = (struct foreign_block){.rows = 0};
    if (!is_hard(foreign, group, name)) {
        return false;
    }
    hid_t data = H5Dopen2(group, name, H5P_DEFAULT);
    if (data < 0) {
        return refuse_hdf5(foreign, name);
    }
    hid_t type = H5Dget_type(data);
    bool ok = type >= 0 ? take_values(foreign, data, type, name, block) : refuse_hdf5(foreign, name);
    (void)H5Tclose(type);
    (void)H5Dclose(data);
    if (!ok) {
        free(block->value);
        block->value = NULL;
    }
    return ok;
}

/* Of one value, be it scalar or an array of one. */
static bool open_attribute(struct foreign *foreign, hid_t where, const char *name, hid_t *attribute, bool *found)
{
    *attribute = H5I_INVALID_HID;
    *found = H5Aexists(where, name) > 0;
    if (!*found) {
        return true;
    }
    *attribute = H5Aopen(where, name, H5P_DEFAULT);
    if (*attribute < 0) {
        return refuse_hdf5(foreign, name);
    }
    hid_t space = H5Aget_space(*attribute);
    bool one = H5Sget_simple_extent_npoints(space) == 1;
    (void)H5Sclose(space);
    if (!one) {
        (void)H5Aclose(*attribute);
        *attribute = H5I_INVALID_HID;
    }
    return one || foreign_refuse(foreign, name, "the attribute is an array, expected one value");
}

bool foreign_number(struct foreign *foreign, hid_t where, const char *name, double *value)
{
    hid_t attribute;
    bool found;
    *value = NAN;
    if (!open_attribute(foreign, where, name, &attribute, &found)) {
        return false;
    }
    if (!found) {
        return true;
    }
    hid_t type = H5Aget_type(attribute);
    H5T_class_t class = H5Tget_class(type);
    bool ok = class == H5T_FLOAT || class == H5T_INTEGER
                  ? H5Aread(attribute, H5T_NATIVE_DOUBLE, value) >= 0 || refuse_hdf5(foreign, name)
                  : foreign_refuse(foreign, name, "the attribute is no number");
    ok = ok && (isfinite(*value) || foreign_refuse(foreign, name, "is %g, expected a finite number", *value));
    (void)H5Tclose(type);
    (void)H5Aclose(attribute);
    return ok;
}

/* The text of an attribute whose length the file gives with every value. */
static bool read_variable(hid_t attribute, hid_t type, char *text, size_t size)
{
    char *value = NULL;
    hid_t memory = H5Tcopy(H5T_C_S1);
    (void)H5Tset_size(memory, H5T_VARIABLE);
    (void)H5Tset_cset(memory, H5Tget_cset(type));
    bool ok = H5Aread(attribute, memory, &value) >= 0;
    ok = ok && snprintf(text, size, "%s", value != NULL ? value : "") < (int)size;
    (void)H5free_memory(value);
    (void)H5Tclose(memory);
    return ok;
}

static bool read_fixed(hid_t attribute, hid_t type, char *text, size_t size)
{
    size_t length = H5Tget_size(type);
    char *value = length <= MOST_TEXT ? calloc(length + 1, 1) : NULL;
    hid_t memory = H5Tcopy(type);
    bool ok = value != NULL && H5Aread(attribute, memory, value) >= 0;
    for (size_t i = length; ok && i > 0 && value[i - 1] == ' ' && H5Tget_strpad(type) == H5T_STR_SPACEPAD; i--) {
        value[i - 1] = '\0';
    }
    ok = ok && snprintf(text, size, "%s", value) < (int)size;
    (void)H5Tclose(memory);
    free(value);
    return ok;
}

bool foreign_text(struct foreign *foreign, hid_t where, const char *name, char *text, size_t size, bool *found)
{
    hid_t attribute;
    text[0] = '\0';
    if (!open_attribute(foreign, where, name, &attribute, found)) {
        return false;
    }
    if (!*found) {
        return true;
    }
    hid_t type = H5Aget_type(attribute);
    bool ok = H5Tget_class(type) == H5T_STRING &&
              (H5Tis_variable_str(type) > 0 ? read_variable : read_fixed)(attribute, type, text, size);
    (void)H5Tclose(type);
    (void)H5Aclose(attribute);
    return ok || foreign_refuse(foreign, name, "the attribute is no text of at most %zu bytes", size - 1);
}
