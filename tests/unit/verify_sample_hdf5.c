/* HDF5 files: the judge's own schema as any program may write it, VTKHDF, records; and what is wrong with a file. */
#include "tests/unit/body.h"
#include "tests/unit/sample_files.h"
#include "verify/sample_write.h"

#include <hdf5.h>

enum { POINTS = 4 };

/* How a dataset is written. */
struct way {
    hid_t type;
    bool chunked, packed;
};

static hid_t file;

static void begin(void)
{
    CU_ASSERT_TRUE_FATAL(sample_file_write("", 0));
    file = H5Fcreate(sample_path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    CU_ASSERT_TRUE_FATAL(file >= 0);
}

static void put_unit(hid_t where, const char *name, const char *unit, bool variable)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    CU_ASSERT_TRUE(H5Tset_size(type, variable ? H5T_VARIABLE : strlen(unit)) >= 0);
    hid_t attribute = H5Acreate2(where, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    CU_ASSERT_TRUE(H5Awrite(attribute, type, variable ? (const void *)&unit : (const void *)unit) >= 0);
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
    (void)H5Tclose(type);
}

static void put_number(hid_t where, const char *name, double value)
{
    hid_t space = H5Screate(H5S_SCALAR);
    hid_t attribute = H5Acreate2(where, name, H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT);
    CU_ASSERT_TRUE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0);
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
}

/* Values 0, 1, 2, ... times `scale` in up to three dimensions. */
static void put_data(hid_t where, const char *name, const struct way *way, int rank, const hsize_t *dims, double scale,
                     const char *unit)
{
    static double value[4096];
    size_t count = 1;
    for (int i = 0; i < rank; i++) {
        count *= dims[i];
    }
    for (size_t i = 0; i < count; i++) {
        value[i] = scale * (double)i;
    }
    hid_t space = H5Screate_simple(rank, dims, NULL), how = H5Pcreate(H5P_DATASET_CREATE);
    if (way->chunked) {
        hsize_t chunk[3] = {2, 1, 1};
        CU_ASSERT_TRUE(H5Pset_chunk(how, rank, chunk) >= 0);
    }
    if (way->packed) {
        CU_ASSERT_TRUE(H5Pset_shuffle(how) >= 0 && H5Pset_deflate(how, 6) >= 0 && H5Pset_fletcher32(how) >= 0);
    }
    hid_t data = H5Dcreate2(where, name, way->type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    CU_ASSERT_TRUE(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    if (unit != NULL) {
        put_unit(data, "unit", unit, way->chunked);
    }
    (void)H5Dclose(data);
    (void)H5Pclose(how);
    (void)H5Sclose(space);
}

static const hsize_t scalar[] = {POINTS}, vector[] = {POINTS, 2}, tensor[] = {POINTS, 3, 3};

static struct way plain(void)
{
    return (struct way){.type = H5T_IEEE_F64LE};
}

static void put_level(hid_t where, const struct way *way)
{
    put_data(where, "points", way, 2, vector, 0.25, "m");
    put_data(where, "weights", way, 1, scalar, 0.5, "m^2");
    put_data(where, "u", way, 2, vector, 2, "mm");
    put_data(where, "P", way, 3, tensor, 1, "MPa");
}

static const struct verify_sample *finish(size_t expected)
{
    CU_ASSERT_TRUE(H5Fclose(file) >= 0);
    bool read = sample_file_read();
    if (!read) {
        printf("%s\n", sample_error.text);
    }
    CU_ASSERT_TRUE_FATAL(read);
    CU_ASSERT_EQUAL_FATAL(samples.count, expected);
    return samples.sample[0];
}

static void finish_refused(const char *words)
{
    CU_ASSERT_TRUE(H5Fclose(file) >= 0);
    bool said = !sample_file_read() && strstr(sample_error.text, words) != NULL;
    if (!said) {
        printf("expected \"%s\", got \"%s\"\n", words, sample_error.text);
    }
    CU_ASSERT_TRUE(said);
    CU_ASSERT_EQUAL(sample_error.code, SOLVER_BAD_INPUT);
}

static void every_way_gives_the_same(void)
{
    const struct way ways[] = {{H5T_IEEE_F64LE, false, false},
                               {H5T_IEEE_F64BE, true, false},
                               {H5T_IEEE_F32LE, true, true},
                               {H5T_IEEE_F32BE, false, false},
                               {H5T_IEEE_F64LE, true, true}};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        begin();
        put_level(file, &ways[i]);
        put_number(file, "time", 0.5);
        put_number(file, "n", 8);
        const struct verify_sample *sample = finish(1);
        const struct verify_sample_field *u = sample_field(sample, "u"), *P = sample_field(sample, "P");
        CU_ASSERT_TRUE_FATAL(sample->count == POINTS && sample->dim == 2 && u->width == 2 && P->width == 9);
        CU_ASSERT_TRUE(sample->time.value == 0.5 && sample->n == 8 && isnan(sample->h.value));
        CU_ASSERT_EQUAL(sample->single, H5Tget_size(ways[i].type) == 4);
        CU_ASSERT_TRUE(sample->needs_units);
        CU_ASSERT_STRING_EQUAL(sample->unit, "m");
        CU_ASSERT_STRING_EQUAL(u->unit, "mm");
        for (size_t a = 0; a < POINTS; a++) {
            CU_ASSERT_TRUE(sample->X[3 * a] == 0.5 * (double)a && sample->X[3 * a + 2] == 0);
            CU_ASSERT_TRUE(sample->weight[a] == 0.5 * (double)a && u->value[2 * a + 1] == 4 * (double)a + 2);
            CU_ASSERT_EQUAL(P->value[9 * a + 8], 9 * (double)a + 8);
        }
    }
}

static void several_levels_and_what_holds_for_all(void)
{
    static const char *const name[] = {"coarse", "fine"};
    struct way way = plain();
    begin();
    put_number(file, "time", 0.5);
    put_number(file, "h", 1);
    for (int i = 0; i < 2; i++) {
        hid_t group = H5Gcreate2(file, name[i], H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        put_level(group, &way);
        if (i == 1) {
            put_number(group, "h", 0.5);
        }
        (void)H5Gclose(group);
    }
    (void)H5Gclose(H5Gcreate2(file, "notes", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    (void)finish(2);
    CU_ASSERT_TRUE(samples.sample[0]->h.value == 1 && samples.sample[1]->h.value == 0.5);
    CU_ASSERT_EQUAL(samples.sample[1]->time.value, 0.5);
    CU_ASSERT_PTR_NOT_NULL(strstr(samples.sample[1]->place, ": /fine"));
}

static hid_t begin_grid(const char *type)
{
    struct way way = plain();
    const hsize_t three[] = {POINTS, 3}, one[] = {1};
    begin();
    hid_t grid = H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put_unit(grid, "Type", type, false);
    put_data(grid, "Points", &way, 2, three, 1, NULL);
    hid_t part = H5Gcreate2(grid, "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put_data(part, "displacement", &way, 2, three, 1, NULL);
    put_data(part, "volume", &way, 1, scalar, 1, NULL);
    (void)H5Gclose(part);
    part = H5Gcreate2(grid, "FieldData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put_data(part, "TimeValue", &way, 1, one, 1, NULL);
    (void)H5Gclose(part);
    return grid;
}

static void vtkhdf(void)
{
    (void)H5Gclose(begin_grid("UnstructuredGrid"));
    const struct verify_sample *sample = finish(1);
    CU_ASSERT_TRUE(sample->dim == 3 && sample->time.value == 0 && !sample->needs_units && sample->weight[3] == 3);
    CU_ASSERT_EQUAL(sample_field(sample, "displacement")->value[11], 11);
    (void)H5Gclose(begin_grid("ImageData"));
    finish_refused("its Type is \"ImageData\"");
    hid_t grid = begin_grid("UnstructuredGrid");
    (void)H5Gclose(H5Gcreate2(grid, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    (void)H5Gclose(grid);
    finish_refused("holds several times");
}

static void records_of_our_own_and_damaged_ones(void)
{
    struct body *body = body_make(3);
    char path[sizeof sample_path + 16];
    CU_ASSERT_TRUE(sample_file_write("", 0));
    (void)snprintf(path, sizeof path, "%s.vtkhdf", sample_path);
    CU_ASSERT_TRUE_FATAL(
        solver_record_write(path, &body->scene, &body->output, &body->history, "test", "0", &sample_error));
    CU_ASSERT_EQUAL(rename(path, sample_path), 0);
    (void)snprintf(path, sizeof path, "%s.xdmf", sample_path);
    (void)unlink(path);
    CU_ASSERT_TRUE_FATAL(sample_file_read());
    const struct verify_sample *sample = samples.sample[0];
    CU_ASSERT_EQUAL(sample->count, body->cloud.count);
    CU_ASSERT_EQUAL(sample->time.value, body->output.time);
    CU_ASSERT_PTR_NOT_NULL(sample->weight);
    CU_ASSERT_STRING_EQUAL(sample_field(sample, "P")->unit, "Pa");
    CU_ASSERT_EQUAL(sample_field(sample, "displacement")->value[5], body->u[5]);
    FILE *stream = fopen(sample_path, "r+b");
    CU_ASSERT_TRUE_FATAL(stream != NULL && fseek(stream, -40, SEEK_END) == 0 && fputc('?', stream) == '?');
    (void)fclose(stream);
    CU_ASSERT_FALSE(sample_file_read());
    CU_ASSERT_PTR_NOT_NULL(strstr(sample_error.text, "checksum"));
    free(body);
}

static void refuses_what_is_missing_or_has_another_shape(void)
{
    unit_untrapped();
    struct way way = plain();
    const hsize_t five[] = {POINTS + 1}, wide[] = {POINTS, 5}, none[] = {0, 2}, four[] = {2, 2, 2, 2};
    begin();
    finish_refused("neither a dataset \"points\"");
    begin();
    put_data(file, "points", &way, 2, wide, 1, "m");
    finish_refused("expected [points][1, 2 or 3]");
    begin();
    put_data(file, "points", &way, 2, none, 1, "m");
    finish_refused("has no points");
    begin();
    put_level(file, &way);
    put_data(file, "v", &way, 1, five, 1, "m/s");
    finish_refused("v: has 5 x 1 values, expected one row for each of 4 points");
    begin();
    put_level(file, &way);
    put_data(file, "v", &way, 2, wide, 1, "m/s");
    finish_refused("field v: 5 numbers a point");
    begin();
    put_level(file, &way);
    put_data(file, "v", &way, 4, four, 1, "m/s");
    finish_refused("v: has 4 dimensions");
    begin();
    put_level(file, &way);
    put_number(file, "time", NAN);
    finish_refused("time: is nan");
    begin();
    put_level(file, &way);
    put_unit(file, "time", "soon", true);
    finish_refused("time: the attribute is no number");
    begin();
    put_data(file, "points", &way, 2, vector, NAN, "m");
    finish_refused("point 0 is (nan, nan, 0)");
    begin();
    put_data(file, "points", &way, 2, vector, 1, "a unit that is much too long to be one of a length");
    finish_refused("unit: the attribute is no text");
}

/* Of what claims more than there is, or lies elsewhere. */
static void refuses_what_is_not_in_the_file(void)
{
    struct way way = plain();
    hsize_t huge[] = {HSIZE_UNDEF / 64, 2}, chunk[] = {1 << 20, 2};
    begin();
    hid_t space = H5Screate_simple(2, huge, NULL), how = H5Pcreate(H5P_DATASET_CREATE);
    CU_ASSERT_TRUE(H5Pset_chunk(how, 2, chunk) >= 0 && H5Pset_deflate(how, 1) >= 0);
    (void)H5Dclose(H5Dcreate2(file, "points", H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT));
    (void)H5Pclose(how);
    (void)H5Sclose(space);
    finish_refused("more than the 0 bytes that are stored can hold");
    begin();
    put_data(file, "hidden", &way, 2, vector, 1, "m");
    CU_ASSERT_TRUE(H5Lcreate_soft("hidden", file, "points", H5P_DEFAULT, H5P_DEFAULT) >= 0);
    finish_refused("is a link");
    begin();
    CU_ASSERT_TRUE(H5Lcreate_external("other.h5", "points", file, "points", H5P_DEFAULT, H5P_DEFAULT) >= 0);
    finish_refused("is a link");
    begin();
    space = H5Screate_simple(2, vector, NULL);
    how = H5Pcreate(H5P_DATASET_CREATE);
    CU_ASSERT_TRUE(H5Pset_external(how, "/etc/hostname", 0, 64) >= 0);
    (void)H5Dclose(H5Dcreate2(file, "points", H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT));
    (void)H5Pclose(how);
    (void)H5Sclose(space);
    finish_refused("stored elsewhere");
    begin();
    way.type = H5T_STD_I32LE;
    put_data(file, "points", &way, 2, vector, 1, "m");
    space = H5Screate_simple(1, scalar, NULL);
    (void)H5Dclose(H5Dcreate2(file, "u", H5T_STD_REF_OBJ, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    (void)H5Sclose(space);
    finish_refused("u: does not hold numbers");
}

static void what_is_written_is_read(void)
{
    struct verify_samples written = {.count = 0};
    for (int i = 0; i < 2; i++) {
        struct verify_sample *sample = verify_samples_add(&written, "test", &sample_error);
        CU_ASSERT_TRUE_FATAL(sample != NULL && verify_sample_points(sample, 3, 2, &sample_error));
        struct verify_sample_field *field = verify_sample_add(sample, "u", 2, &sample_error);
        CU_ASSERT_PTR_NOT_NULL_FATAL(field);
        (void)snprintf(field->unit, sizeof field->unit, "m");
        sample->time.value = 0.1;
        sample->h.value = 0.3 - 0.1 * i;
        for (size_t j = 0; j < 3; j++) {
            sample->X[3 * j] = 0.1 * (double)j;
            field->value[2 * j + 1] = 1.0 / 3 + i;
        }
    }
    CU_ASSERT_TRUE_FATAL(sample_file_write("", 0));
    CU_ASSERT_TRUE_FATAL(verify_sample_write_hdf5(sample_path, &written, &sample_error));
    CU_ASSERT_TRUE_FATAL(sample_file_read());
    CU_ASSERT_EQUAL_FATAL(samples.count, 2);
    for (size_t i = 0; i < 2; i++) {
        const struct verify_sample *a = written.sample[i], *b = samples.sample[i];
        CU_ASSERT_TRUE(a->count == b->count && b->dim == 2 && a->h.value == b->h.value && b->time.value == 0.1);
        CU_ASSERT_TRUE(same_numbers(a->X, b->X, 9));
        CU_ASSERT_TRUE(same_numbers(a->field[0].value, sample_field(b, "u")->value, 6));
    }
    verify_samples_free(&written);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every way gives the same", every_way_gives_the_same},
        {"several levels, and what holds for all", several_levels_and_what_holds_for_all},
        {"VTKHDF", vtkhdf},
        {"records of our own, and damaged ones", records_of_our_own_and_damaged_ones},
        {"refuses what is missing or has another shape", refuses_what_is_missing_or_has_another_shape},
        {"refuses what is not in the file", refuses_what_is_not_in_the_file},
        {"what is written is read", what_is_written_is_read},
    };
    return sample_files_end(unit_main("verify: samples from HDF5", tests, sizeof tests / sizeof *tests));
}
