/* Records that are well-formed HDF5 with a valid seal, and yet not what this program writes: links out of the file,
 * data elsewhere or packed, other types and shapes, sizes beyond the file, things missing. */
#include "solver/file.h"
#include "solver/record_format.h"
#include "tests/unit/body.h"
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"

#include <sys/stat.h>
#include <unistd.h>

static char folder[SCRATCH], path[SCRATCH_BELOW];

/* Ends the file with the checksum of what it holds, as a forger would. */
static void seal(void)
{
    struct stat about;
    FILE *file = fopen(path, "rb");
    CU_ASSERT_FATAL(file != NULL && stat(path, &about) == 0);
    const size_t size = (size_t)about.st_size;
    unsigned char *bytes = malloc(size + SOLVER_SEAL_SIZE);
    CU_ASSERT_FATAL(bytes != NULL && fread(bytes, 1, size, file) == size);
    (void)fclose(file);
    const uint64_t sum = solver_seal_sum(SOLVER_SEAL_SEED, bytes, size);
    memcpy(bytes + size, SOLVER_SEAL, 8);
    memcpy(bytes + size + 8, &sum, sizeof sum);
    struct solver_error error;
    CU_ASSERT(solver_file_replace(path, bytes, size + SOLVER_SEAL_SIZE, &error));
    free(bytes);
}

/* Writes a good record, lets `change` work on it, and expects it to be refused with `word`. */
static void forged(void (*change)(hid_t file), const char *word)
{
    struct solver_error error = {.text = ""};
    struct solver_record *record = NULL;
    struct body *body = body_make(2);
    CU_ASSERT(solver_record_write(path, &body->scene, &body->output, &body->history, "", "", &error));
    free(body);
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    CU_ASSERT_FATAL(file >= 0);
    change(file);
    CU_ASSERT(H5Fclose(file) >= 0);
    seal();
    CU_ASSERT_FALSE(solver_record_read(path, &record, &error));
    CU_ASSERT(record == NULL && error.code == SOLVER_BAD_INPUT);
    bool said = strstr(error.text, word) != NULL && strstr(error.text, path) != NULL;
    CU_ASSERT(said);
    if (!said) {
        (void)printf("expected \"%s\" in: %s\n", word, error.text);
    }
}

/* Puts another dataset in the place of `name`. */
static void replace(hid_t file, const char *name, hid_t type, int rank, hsize_t rows, hsize_t columns, hid_t properties)
{
    const hsize_t dims[2] = {rows, columns};
    CU_ASSERT(H5Ldelete(file, name, H5P_DEFAULT) >= 0);
    hid_t space = H5Screate_simple(rank, dims, NULL);
    hid_t data = H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    CU_ASSERT(data >= 0);
    (void)H5Dclose(data);
    (void)H5Sclose(space);
}

static const char J[] = "/VTKHDF/PointData/J", points[] = "/VTKHDF/Points", values[] = "/history/values";

static void soft_link(hid_t file)
{
    (void)H5Ldelete(file, J, H5P_DEFAULT);
    CU_ASSERT(H5Lcreate_soft("/VTKHDF/PointData/pressure", file, J, H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void external_link(hid_t file)
{
    (void)H5Ldelete(file, J, H5P_DEFAULT);
    CU_ASSERT(H5Lcreate_external("/etc/passwd", "/J", file, J, H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void external_group(hid_t file)
{
    (void)H5Ldelete(file, "/VTKHDF", H5P_DEFAULT);
    CU_ASSERT(H5Lcreate_external("/etc/passwd", "/", file, "/VTKHDF", H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void external_storage(hid_t file)
{
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    (void)H5Pset_external(properties, "/etc/passwd", 0, 96);
    replace(file, J, H5T_IEEE_F64LE, 1, 12, 1, properties);
    (void)H5Pclose(properties);
}

static void packed(hid_t file)
{
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk = 4;
    (void)H5Pset_chunk(properties, 1, &chunk);
    (void)H5Pset_shuffle(properties);
    replace(file, J, H5T_IEEE_F64LE, 1, 12, 1, properties);
    (void)H5Pclose(properties);
}

static void virtual_data(hid_t file)
{
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t rows = 12;
    hid_t space = H5Screate_simple(1, &rows, NULL);
    CU_ASSERT(H5Pset_virtual(properties, space, "/etc/passwd", "/J", space) >= 0);
    replace(file, J, H5T_IEEE_F64LE, 1, 12, 1, properties);
    (void)H5Sclose(space);
    (void)H5Pclose(properties);
}

static void never_written(hid_t file)
{
    replace(file, J, H5T_IEEE_F64LE, 1, 12, 1, H5P_DEFAULT);
}

static void single_precision(hid_t file)
{
    replace(file, J, H5T_IEEE_F32LE, 1, 12, 1, H5P_DEFAULT);
}

static void texts_for_numbers(hid_t file)
{
    replace(file, points, H5T_C_S1, 2, 12, 3, H5P_DEFAULT);
}

static void three_dimensions(hid_t file)
{
    const hsize_t dims[3] = {12, 1, 1};
    (void)H5Ldelete(file, J, H5P_DEFAULT);
    hid_t space = H5Screate_simple(3, dims, NULL);
    hid_t data = H5Dcreate2(file, J, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    CU_ASSERT(data >= 0);
    (void)H5Dclose(data);
    (void)H5Sclose(space);
}

static void huge(hid_t file)
{
    replace(file, values, H5T_IEEE_F64LE, 2, (hsize_t)1 << 40, 16, H5P_DEFAULT);
}

static void overflowing(hid_t file)
{
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    (void)H5Pset_alloc_time(properties, H5D_ALLOC_TIME_LATE);
    replace(file, points, H5T_IEEE_F64LE, 2, (hsize_t)1 << 59, 3, properties);
    (void)H5Pclose(properties);
}

static void no_unit(hid_t file)
{
    CU_ASSERT(H5Adelete_by_name(file, J, "unit", H5P_DEFAULT) >= 0);
}

static void no_field(hid_t file)
{
    CU_ASSERT(H5Ldelete(file, J, H5P_DEFAULT) >= 0);
}

static void no_history(hid_t file)
{
    CU_ASSERT(H5Ldelete(file, "/history", H5P_DEFAULT) >= 0);
}

static void no_version(hid_t file)
{
    CU_ASSERT(H5Adelete(file, "version") >= 0);
}

static void group_for_data(hid_t file)
{
    (void)H5Ldelete(file, J, H5P_DEFAULT);
    hid_t group = H5Gcreate2(file, J, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    CU_ASSERT(group >= 0);
    (void)H5Gclose(group);
}

static void put(hid_t file, const char *name, int64_t index, int64_t value)
{
    hid_t data = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(data);
    const hsize_t at = (hsize_t)index, one = 1;
    hid_t memory = H5Screate_simple(1, &one, NULL);
    (void)H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, NULL, &one, NULL);
    CU_ASSERT(H5Dwrite(data, H5T_NATIVE_INT64, memory, space, H5P_DEFAULT, &value) >= 0);
    (void)H5Sclose(memory);
    (void)H5Sclose(space);
    (void)H5Dclose(data);
}

static void cell_outside(hid_t file)
{
    put(file, "/VTKHDF/Connectivity", 5, 12);
}

static void cell_negative(hid_t file)
{
    put(file, "/VTKHDF/Connectivity", 5, -1);
}

static void offset_wrong(hid_t file)
{
    put(file, "/VTKHDF/Offsets", 6, 25);
}

static void type_wrong(hid_t file)
{
    put(file, "/VTKHDF/Types", 5, 12);
}

static void count_negative(hid_t file)
{
    put(file, "/VTKHDF/NumberOfPoints", 0, -5);
}

static void count_wrong(hid_t file)
{
    put(file, "/VTKHDF/NumberOfCells", 0, 7);
}

static void dimension_wrong(hid_t file)
{
    const int64_t four = 4;
    hid_t attribute = H5Aopen(file, "dim", H5P_DEFAULT);
    CU_ASSERT(H5Awrite(attribute, H5T_NATIVE_INT64, &four) >= 0);
    (void)H5Aclose(attribute);
}

static void tensor_too_narrow(hid_t file)
{
    static const char F[] = "/VTKHDF/PointData/F";
    CU_ASSERT(H5Ldelete(file, F, H5P_DEFAULT) >= 0);
    CU_ASSERT(H5Lcreate_hard(file, "/VTKHDF/PointData/displacement", file, F, H5P_DEFAULT, H5P_DEFAULT) >= 0);
}

static void forgeries(void)
{
    static const struct {
        void (*change)(hid_t file);
        const char *word;
    } list[] = {
        {soft_link, "J: is a link"},
        {external_link, "J: is a link"},
        {external_group, "VTKHDF: is a link"},
        {external_storage, "J: is stored elsewhere"},
        {packed, "J: is stored elsewhere"},
        {virtual_data, "J: is stored elsewhere"},
        {never_written, "J: its 96 bytes are not in the file"},
        {single_precision, "J: holds another type"},
        {texts_for_numbers, "Points: holds another type"},
        {three_dimensions, "J: has 3 dimensions"},
        {huge, "values: claims"},
        {overflowing, "Points: claims"},
        {no_unit, "unit: attribute missing"},
        {no_field, "J: field is missing"},
        {tensor_too_narrow, "F: field has another width"},
        {no_history, "history: missing"},
        {no_version, "version: attribute missing"},
        {group_for_data, "J: "},
        {cell_outside, "Connectivity: entry 5 is particle 12"},
        {cell_negative, "Connectivity: entry 5 is particle -1"},
        {offset_wrong, "Types and Offsets"},
        {type_wrong, "Types and Offsets"},
        {count_negative, "NumberOfPoints: is -5"},
        {count_wrong, "NumberOfConnectivityIds: is 24"},
        {dimension_wrong, "dim: is 4"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        forged(list[i].change, list[i].word);
    }
}

/* The forger's way itself is sound: a record that is opened, closed and sealed again is read. */
static void untouched(void)
{
    struct solver_error error = {.text = ""};
    struct solver_record *record = NULL;
    struct body *body = body_make(2);
    CU_ASSERT(solver_record_write(path, &body->scene, &body->output, &body->history, "", "", &error));
    free(body);
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    CU_ASSERT(H5Fclose(file) >= 0);
    seal();
    CU_ASSERT(solver_record_read(path, &record, &error));
    solver_record_free(record);
}

static void refuse_path(const char *name, const char *word)
{
    struct solver_error error = {.text = ""};
    struct solver_record *record = NULL;
    CU_ASSERT_FALSE(solver_record_read(name, &record, &error));
    bool said = record == NULL && strstr(error.text, name) != NULL && strstr(error.text, word) != NULL;
    CU_ASSERT(said);
    if (!said) {
        (void)printf("expected \"%s\" in: %s\n", word, error.text);
    }
}

static void no_records(void)
{
    refuse_path("/no/such/record.h5", "No such file");
    refuse_path(folder, "is a folder");
    refuse_path("/dev/null", "not a plain file");
    refuse_path(TEST_SOURCE_DIR "/CMakeLists.txt", "is not HDF5");
    (void)remove(path);
    CU_ASSERT(mkfifo(path, 0600) == 0);
    refuse_path(path, "not a plain file"); /* and does not wait for a writer */
    (void)remove(path);
    CU_ASSERT(symlink(path, path) == 0);
    refuse_path(path, "Too many levels"); /* cannot be opened, whoever asks */
    (void)remove(path);
    FILE *empty = fopen(path, "wb");
    CU_ASSERT_FATAL(empty != NULL);
    (void)fclose(empty);
    refuse_path(path, "is not HDF5 (0 bytes)");
    (void)remove(path);
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    (void)H5Fclose(file);
    refuse_path(path, "not a record that assay wrote");
    seal();
    refuse_path(path, "format: attribute missing");
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a record opened and sealed again", untouched},
        {"forged records are refused", forgeries},
        {"what is no record is refused", no_records},
    };
    scratch_folder(folder);
    (void)snprintf(path, sizeof path, "%s/body.h5", folder);
    int result = unit_main("hostile records", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    return result;
}
