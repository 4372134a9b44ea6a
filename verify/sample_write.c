#include "verify/sample_write.h"

#include "solver/record_format.h"
#include "verify/files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where an HDF5 file is built, in memory. */
struct sink {
    hid_t file;
    bool ok; /* false from the first call on that failed */
};

static void put_text(struct sink *sink, hid_t where, const char *name, const char *text)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    bool sized = H5Tset_size(type, strlen(text) + 1) >= 0;
    hid_t attribute = H5Acreate2(where, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    sink->ok = sink->ok && sized && attribute >= 0 && H5Awrite(attribute, type, text) >= 0;
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
    (void)H5Tclose(type);
}

static void put_number(struct sink *sink, hid_t where, const char *name, double value)
{
    if (isnan(value)) {
        return;
    }
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(where, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
    sink->ok = sink->ok && attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0;
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
}

/* [rows][width], or [rows] where width is 1 and `flat`. */
static void put_values(struct sink *sink, hid_t where, const char *name, const char *unit, const double *value,
                       size_t rows, size_t width, bool flat)
{
    hsize_t dims[2] = {rows, width};
    hid_t space = H5Screate_simple(flat && width == 1 ? 1 : 2, dims, NULL), how = H5Pcreate(H5P_DATASET_CREATE);
    (void)H5Pset_obj_track_times(how, false); /* the time of writing is none of the file's business */
    hid_t data = H5Dcreate2(where, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
    sink->ok = sink->ok && data >= 0 && H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0;
    if (sink->ok) {
        put_text(sink, data, "unit", unit);
    }
    (void)H5Dclose(data);
    (void)H5Pclose(how);
    (void)H5Sclose(space);
}

static bool put_points(struct sink *sink, hid_t where, const struct verify_sample *sample)
{
    size_t dim = (size_t)sample->dim;
    double *X = calloc(sample->count, dim * sizeof *X);
    for (size_t a = 0; X != NULL && a < sample->count; a++) {
        memcpy(X + a * dim, sample->X + 3 * a, dim * sizeof *X);
    }
    if (X != NULL) {
        put_values(sink, where, "points", "m", X, sample->count, dim, false);
    }
    free(X);
    return X != NULL;
}

static bool put_level(struct sink *sink, hid_t where, const struct verify_sample *sample)
{
    bool done = put_points(sink, where, sample);
    put_number(sink, where, "time", sample->time.value);
    put_number(sink, where, "h", sample->h.value);
    if (sample->weight != NULL) {
        static const char *const volume[] = {"m", "m^2", "m^3"};
        put_values(sink, where, "weights", volume[sample->dim - 1], sample->weight, sample->count, 1, true);
    }
    for (size_t i = 0; i < sample->field_count; i++) {
        const struct verify_sample_field *field = &sample->field[i];
        put_values(sink, where, field->name, field->unit, field->value, sample->count, (size_t)field->width, true);
    }
    return done;
}

static bool put_levels(struct sink *sink, const struct verify_samples *samples)
{
    bool done = true;
    for (size_t i = 0; done && i < samples->count; i++) {
        char name[32];
        hid_t group = sink->file;
        if (samples->count > 1) {
            (void)snprintf(name, sizeof name, "level%zu", i + 1);
            group = H5Gcreate2(sink->file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        }
        done = put_level(sink, group, samples->sample[i]);
        if (samples->count > 1) {
            (void)H5Gclose(group);
        }
    }
    return done;
}

/* The bytes of the file, as the library would have written them. */
static bool take_image(struct sink *sink, void **bytes, size_t *size)
{
    bool flushed = H5Fflush(sink->file, H5F_SCOPE_GLOBAL) >= 0;
    ssize_t length = flushed ? H5Fget_file_image(sink->file, NULL, 0) : -1;
    *bytes = length > 0 ? malloc((size_t)length) : NULL;
    *size = length > 0 ? (size_t)length : 0;
    return *bytes != NULL && H5Fget_file_image(sink->file, *bytes, *size) == length;
}

bool verify_sample_write_hdf5(const char *path, const struct verify_samples *samples, struct solver_error *error)
{
    struct record_quiet before = record_quiet_begin();
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    (void)H5Pset_fapl_core(access, 1 << 20, false); /* in memory alone */
    struct sink sink = {.file = H5Fcreate("samples", H5F_ACC_TRUNC, H5P_DEFAULT, access), .ok = true};
    void *bytes = NULL;
    size_t size = 0;
    bool built = sink.file >= 0 && put_levels(&sink, samples) && sink.ok && take_image(&sink, &bytes, &size);
    if (sink.file >= 0) {
        (void)H5Fclose(sink.file);
    }
    (void)H5Pclose(access);
    record_quiet_end(before);
    bool done = built ? verify_file_write(path, bytes, size, error)
                      : solver_fail(error, SOLVER_NO_MEMORY, "%.400s: no memory to build an HDF5 file", path);
    free(bytes);
    return done;
}

static void put_name(FILE *file, const struct verify_sample_field *field, enum verify_columns columns, int i)
{
    int rows = columns == VERIFY_BY_PAIR ? (field->width == 9 ? 3 : field->width == 4 ? 2 : 1) : field->width;
    (void)fprintf(file, ",%s", field->name);
    if (columns == VERIFY_BY_AXIS) {
        (void)fprintf(file, "_%c", "xyz"[i]);
    } else if (columns == VERIFY_BY_PAIR) {
        (void)fprintf(file, "_%c%c", "xyz"[i / rows], "xyz"[i % rows]);
    }
    (void)fprintf(file, "[%s]", field->unit);
}

void verify_sample_write_csv(FILE *file, const struct verify_sample *sample,
                             const enum verify_columns columns[VERIFY_SAMPLE_FIELDS])
{
    (void)fprintf(file, "# time = %.17g s\n", sample->time.value);
    if (!isnan(sample->h.value)) {
        (void)fprintf(file, "# h = %.17g m\n", sample->h.value);
    }
    for (int i = 0; i < sample->dim; i++) {
        (void)fprintf(file, "%s%c[m]", i > 0 ? "," : "", "XYZ"[i]);
    }
    for (size_t i = 0; i < sample->field_count; i++) {
        for (int j = 0; j < sample->field[i].width; j++) {
            put_name(file, &sample->field[i], columns[i], j);
        }
    }
    (void)fprintf(file, sample->weight != NULL ? ",weight\n" : "\n");
    for (size_t a = 0; a < sample->count; a++) {
        for (int i = 0; i < sample->dim; i++) {
            (void)fprintf(file, "%s%.17g", i > 0 ? "," : "", sample->X[3 * a + (size_t)i]);
        }
        for (size_t i = 0; i < sample->field_count; i++) {
            size_t width = (size_t)sample->field[i].width;
            for (size_t j = 0; j < width; j++) {
                (void)fprintf(file, ",%.17g", sample->field[i].value[a * width + j]);
            }
        }
        if (sample->weight != NULL) {
            (void)fprintf(file, ",%.17g", sample->weight[a]);
        }
        (void)fputc('\n', file);
    }
}
