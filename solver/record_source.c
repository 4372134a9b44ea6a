#include "solver/record_source.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool record_refuse(struct record_source *source, const char *where, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return solver_fail(source->error, SOLVER_BAD_INPUT, "cannot read record %.300s: %s: %s", source->path, where, what);
}

static bool refuse_hdf5(struct record_source *source, const char *where)
{
    char reason[256];
    record_hdf5_reason(reason, sizeof reason);
    return record_refuse(source, where, "cut short, damaged or not ours (HDF5: %s)", reason);
}

/* Whether the file ends with the checksum of what comes before. */
static bool seal_holds(int fd, uint64_t size)
{
    unsigned char part[8 * 4096], seal[SOLVER_SEAL_SIZE];
    uint64_t sum = SOLVER_SEAL_SEED, at = 0;
    const uint64_t end = size - SOLVER_SEAL_SIZE;
    while (at < end) {
        const size_t wanted = end - at < sizeof part ? (size_t)(end - at) : sizeof part;
        if (pread(fd, part, wanted, (off_t)at) != (ssize_t)wanted) {
            return false;
        }
        sum = solver_seal_sum(sum, part, wanted);
        at += wanted;
    }
    return pread(fd, seal, sizeof seal, (off_t)end) == (ssize_t)sizeof seal && memcmp(seal, SOLVER_SEAL, 8) == 0 &&
           memcmp(seal + 8, &sum, sizeof sum) == 0;
}

/* Whether `path` is a plain file that starts with HDF5's signature and ends with our seal; also its size. */
static bool looks_right(struct record_source *source)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    unsigned char start[8];
    struct stat about;
    /* O_NONBLOCK: a pipe without a writer must not hang us. */
    int fd = open(source->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0 || fstat(fd, &about) != 0) {
        int why = errno;
        if (fd >= 0) {
            (void)close(fd);
        }
        return solver_fail(source->error, SOLVER_IO, "cannot read record %.600s: %s", source->path, strerror(why));
    }
    bool ok = false;
    if (S_ISDIR(about.st_mode)) {
        (void)record_refuse(source, "file", "is a folder; expected a record file");
    } else if (!S_ISREG(about.st_mode)) {
        (void)record_refuse(source, "file", "is not a plain file; expected a record file");
    } else if (read(fd, start, sizeof start) != (ssize_t)sizeof start || memcmp(start, signature, sizeof start) != 0) {
        (void)record_refuse(source, "file", "is not HDF5 (%lld bytes); expected a record that assay wrote",
                            (long long)about.st_size);
    } else if (about.st_size < SOLVER_SEAL_SIZE || !seal_holds(fd, (uint64_t)about.st_size)) {
        (void)record_refuse(source, "file",
                            "is cut short, damaged, changed since it was written, or not a record that assay wrote: "
                            "its %lld bytes do not end with their checksum",
                            (long long)about.st_size);
    } else {
        source->bytes = (uint64_t)about.st_size;
        ok = true;
    }
    (void)close(fd);
    return ok;
}

bool record_open(struct record_source *source, const char *path, struct solver_error *error)
{
    *source = (struct record_source){.path = path, .file = H5I_INVALID_HID, .error = error};
    if (!looks_right(source)) {
        return false;
    }
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    (void)H5Pset_fapl_sec2(access);
    (void)H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    (void)H5Pset_file_locking(access, false, true); /* whole files need no locks, and some file systems know none */
    source->file = H5Fopen(path, H5F_ACC_RDONLY, access);
    /* The reason first: the next call of HDF5 forgets it. */
    bool ok = source->file >= 0 || refuse_hdf5(source, "file");
    (void)H5Pclose(access);
    return ok;
}

void record_close(struct record_source *source)
{
    if (source->file >= 0) {
        (void)H5Fclose(source->file);
    }
    source->file = H5I_INVALID_HID;
}

/* Soft and external links could lead out of the file. */
static bool is_hard(struct record_source *source, hid_t parent, const char *name)
{
    H5L_info_t link;
    if (H5Lexists(parent, name, H5P_DEFAULT) <= 0) {
        return record_refuse(source, name, "missing; the file is damaged or no record of this program");
    }
    if (H5Lget_info(parent, name, &link, H5P_DEFAULT) < 0) {
        return refuse_hdf5(source, name);
    }
    return link.type == H5L_TYPE_HARD || record_refuse(source, name, "is a link; a record holds its own data");
}

bool record_group(struct record_source *source, hid_t parent, const char *name, hid_t *group)
{
    *group = H5I_INVALID_HID;
    if (!is_hard(source, parent, name)) {
        return false;
    }
    *group = H5Gopen2(parent, name, H5P_DEFAULT);
    return *group >= 0 || refuse_hdf5(source, name);
}

static bool type_is(struct record_source *source, const char *name, hid_t found, hid_t wanted)
{
    if (found < 0) {
        return refuse_hdf5(source, name);
    }
    if (H5Tequal(found, wanted) > 0) {
        return true;
    }
    static const char *const classes[] = {"integers", "floating-point numbers", "times", "texts", "bit fields"};
    int class = (int)H5Tget_class(wanted);
    return record_refuse(source, name, "holds another type of values; expected %s of %zu bytes",
                         class >= 0 && class < 5 ? classes[class] : "values", H5Tget_size(wanted));
}

static bool shape_of(struct record_source *source, hid_t data, struct record_block *block)
{
    hsize_t dims[2] = {0, 1};
    hid_t space = H5Dget_space(data);
    block->rank = H5Sget_simple_extent_type(space) == H5S_SIMPLE ? H5Sget_simple_extent_ndims(space) : 0;
    if (block->rank == 1 || block->rank == 2) {
        (void)H5Sget_simple_extent_dims(space, dims, NULL);
    }
    (void)H5Sclose(space);
    if (block->rank != 1 && block->rank != 2) {
        return record_refuse(source, block->name, "has %d dimensions, expected 1 or 2", block->rank);
    }
    block->dims[0] = dims[0];
    block->dims[1] = dims[1];
    return true;
}

/* The dataset's bytes must lie, as they are, within this file. */
static bool stored_here(struct record_source *source, hid_t data, const struct record_block *block, size_t *bytes)
{
    hid_t properties = H5Dget_create_plist(data);
    bool plain = H5Pget_layout(properties) == H5D_CONTIGUOUS && H5Pget_external_count(properties) == 0 &&
                 H5Pget_nfilters(properties) == 0;
    (void)H5Pclose(properties);
    if (!plain) {
        return record_refuse(source, block->name, "is stored elsewhere, in pieces or packed; expected plain values");
    }
    const size_t size = H5Tget_size(block->type);
    size_t values;
    if (__builtin_mul_overflow(block->dims[0], block->dims[1], &values) ||
        __builtin_mul_overflow(values, size, bytes) || *bytes > source->bytes) {
        return record_refuse(source, block->name, "claims %zu x %zu values, more than the file's %llu bytes can hold",
                             block->dims[0], block->dims[1], (unsigned long long)source->bytes);
    }
    if (*bytes == 0) {
        return true;
    }
    haddr_t at = H5Dget_offset(data);
    if (at == HADDR_UNDEF || at > source->bytes - *bytes || H5Dget_storage_size(data) != *bytes) {
        return record_refuse(source, block->name, "its %zu bytes are not in the file", *bytes);
    }
    return true;
}

static bool take_unit(struct record_source *source, hid_t data, struct record_block *block)
{
    char *unit;
    if (!record_attribute_text(source, data, "unit", &unit)) {
        return false;
    }
    bool fits = strlen(unit) < sizeof block->unit;
    (void)snprintf(block->unit, sizeof block->unit, "%s", unit);
    free(unit);
    return fits || record_refuse(source, block->name, "its unit has more than %zu bytes", sizeof block->unit - 1);
}

static bool take_values(struct record_source *source, hid_t data, struct record_block *block)
{
    size_t bytes = 0;
    if (!shape_of(source, data, block) || !stored_here(source, data, block, &bytes) ||
        !take_unit(source, data, block)) {
        return false;
    }
    block->data = calloc(bytes + 1, 1);
    if (block->data == NULL) {
        return solver_fail(source->error, SOLVER_NO_MEMORY, "cannot read record %.300s: %s: no memory for %zu bytes",
                           source->path, block->name, bytes);
    }
    if (bytes > 0 && H5Dread(data, block->type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block->data) < 0) {
        return refuse_hdf5(source, block->name);
    }
    return true;
}

bool record_block_read(struct record_source *source, hid_t group, const char *name, hid_t type,
                       struct record_block *block)
{
    *block = (struct record_block){.name = name, .type = type};
    if (!is_hard(source, group, name)) {
        return false;
    }
    hid_t data = H5Dopen2(group, name, H5P_DEFAULT);
    if (data < 0) {
        return refuse_hdf5(source, name);
    }
    hid_t found = H5Dget_type(data);
    bool ok = type_is(source, name, found, type) && take_values(source, data, block);
    (void)H5Tclose(found);
    (void)H5Dclose(data);
    if (!ok) {
        free(block->data);
        block->data = NULL;
    }
    return ok;
}

bool record_block_read_shaped(struct record_source *source, hid_t group, const char *name, hid_t type, size_t rows,
                              size_t columns, struct record_block *block)
{
    if (!record_block_read(source, group, name, type, block)) {
        return false;
    }
    if (block->dims[0] == rows && block->dims[1] == columns) {
        return true;
    }
    free(block->data);
    block->data = NULL;
    return record_refuse(source, name, "has %zu x %zu values, expected %zu x %zu", block->dims[0], block->dims[1], rows,
                         columns);
}

static bool open_attribute(struct record_source *source, hid_t where, const char *name, hid_t *attribute)
{
    *attribute = H5I_INVALID_HID;
    if (H5Aexists(where, name) <= 0) {
        return record_refuse(source, name, "attribute missing; the file is damaged or no record of this program");
    }
    *attribute = H5Aopen(where, name, H5P_DEFAULT);
    if (*attribute < 0) {
        return refuse_hdf5(source, name);
    }
    hid_t space = H5Aget_space(*attribute);
    bool scalar = H5Sget_simple_extent_type(space) == H5S_SCALAR;
    (void)H5Sclose(space);
    if (!scalar) {
        (void)H5Aclose(*attribute);
        return record_refuse(source, name, "attribute is an array, expected a single value");
    }
    return true;
}

bool record_attribute(struct record_source *source, hid_t where, const char *name, hid_t type, void *value)
{
    hid_t attribute;
    if (!open_attribute(source, where, name, &attribute)) {
        return false;
    }
    hid_t found = H5Aget_type(attribute);
    bool ok = type_is(source, name, found, type) && (H5Aread(attribute, type, value) >= 0 || refuse_hdf5(source, name));
    (void)H5Tclose(found);
    (void)H5Aclose(attribute);
    return ok;
}

bool record_attribute_text(struct record_source *source, hid_t where, const char *name, char **text)
{
    hid_t attribute;
    *text = NULL;
    if (!open_attribute(source, where, name, &attribute)) {
        return false;
    }
    hid_t type = H5Aget_type(attribute);
    size_t size = H5Tget_size(type);
    bool ok = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 && size > 0 && size <= source->bytes;
    if (!ok) {
        (void)record_refuse(source, name, "attribute is no plain text");
    } else if ((*text = calloc(size + 1, 1)) == NULL) {
        ok = solver_fail(source->error, SOLVER_NO_MEMORY, "cannot read record %.300s: %s: no memory for %zu bytes",
                         source->path, name, size);
    } else if (H5Aread(attribute, type, *text) < 0) {
        ok = refuse_hdf5(source, name);
    }
    (void)H5Tclose(type);
    (void)H5Aclose(attribute);
    if (!ok) {
        free(*text);
        *text = NULL;
    }
    return ok;
}
