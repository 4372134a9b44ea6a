/* Thousands of damaged files of each format: whatever is done to the bytes of a right one, reading it ends, with a
 * sample in which everything is as it must be or with an error that says something. */
#include "tests/unit/sample_files.h"
#include "verify/sample_write.h"

#include <stdint.h>

enum { MOST = 1 << 16, TEXTS = 3000, HDF5S = 80 };

static uint64_t seed = 1;
static unsigned char bytes[2 * MOST];

static size_t below(size_t limit)
{
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (size_t)(seed >> 33) % limit;
}

/* What trips readers: signs of the format, ends of texts, signs of numbers. */
static unsigned char interesting(void)
{
    static const unsigned char letters[] = {0,   0xff, 0x7f, 0x80, '<',  '>', '"', '&',
                                            ',', '-',  '=',  '[',  '\n', '#', '9', 'e'};
    return letters[below(sizeof letters)];
}

static size_t damage_once(size_t size)
{
    size_t at = below(size), length = (size_t)1 << below(7);
    length = length < size - at ? length : size - at;
    switch (below(6)) {
    case 0:
        bytes[at] = (unsigned char)below(256);
        return size;
    case 1:
        memset(bytes + at, interesting(), length);
        return size;
    case 2:
        memmove(bytes + at, bytes + at + length, size - at - length);
        return size - length;
    case 3:
        length = size + length <= 2 * MOST ? length : 0;
        memmove(bytes + at + length, bytes + at, size - at);
        return size + length;
    case 4:
        memmove(bytes + at, bytes + below(size - length + 1), length);
        return size;
    default:
        return at;
    }
}

static void check_sample(const struct verify_sample *sample)
{
    CU_ASSERT_TRUE(sample->count > 0 && sample->dim >= 1 && sample->dim <= 3 && sample->X != NULL);
    CU_ASSERT_TRUE(memchr(sample->place, '\0', sizeof sample->place) != NULL);
    for (size_t i = 0; i < sample->field_count; i++) {
        const struct verify_sample_field *field = &sample->field[i];
        double sum = 0;
        for (size_t j = 0; j < sample->count * (size_t)field->width; j++) {
            sum += isfinite(field->value[j]) ? 0 : 1;
        }
        CU_ASSERT_TRUE(sum == 0 && field->width >= 1 && field->width <= 9 && strlen(field->name) > 0);
    }
}

static void damage_all(const void *whole, size_t size, size_t times)
{
    size_t refused = 0;
    for (size_t i = 0; i < times; i++) {
        size_t now = size;
        memcpy(bytes, whole, size);
        for (size_t changes = 1 + below(4); changes > 0 && now > 1; changes--) {
            now = damage_once(now);
        }
        CU_ASSERT_TRUE_FATAL(sample_file_write(bytes, now));
        if (sample_file_read()) {
            for (size_t j = 0; j < samples.count; j++) {
                check_sample(samples.sample[j]);
            }
        } else {
            refused++;
            CU_ASSERT_TRUE(strstr(sample_error.text, sample_path) != NULL && strlen(sample_error.text) > 30);
            CU_ASSERT_TRUE(sample_error.code == SOLVER_BAD_INPUT || sample_error.code == SOLVER_NO_MEMORY);
        }
    }
    CU_ASSERT_TRUE(refused > times / 3);
}

static void tables(void)
{
    static const char table[] =
        "# time = 2 ms\n# h = 0.25 m\nX[m],Y[m],u_x[mm],u_y[mm],P_xx[MPa],P_yy[MPa],weight,s[-]\n"
        "0,0,1,2,3,4,0.5,7\n0.5,1,1.5,2.5,3.5,-4e-1,0.25,7\n1,1,-1,2.5,3,4,0.25,8\n";
    (void)sample_of_text(table);
    damage_all(table, sizeof table - 1, TEXTS);
}

static void vtu(void)
{
    static const char text[] =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt32\">\n<UnstructuredGrid>\n<FieldData><DataArray type=\"Float64\" Name=\"TimeValue\" "
        "NumberOfTuples=\"1\" format=\"ascii\">0.5</DataArray></FieldData>\n<Piece NumberOfPoints=\"2\" "
        "NumberOfCells=\"0\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
        "0 0 0\n1 0.5 0.25\n</DataArray></Points>\n<PointData>\n<DataArray type=\"Float32\" Name=\"u [mm]\" "
        "NumberOfComponents=\"3\" format=\"binary\">GAAAAAAAgD8AAABAAABAQAAAgEAAAKBAAADAQA==</DataArray>\n"
        "<DataArray type=\"Int16\" Name=\"s\" format=\"appended\" offset=\"0\"/>\n</PointData>\n</Piece>\n"
        "</UnstructuredGrid>\n<AppendedData encoding=\"base64\">\n_BAAAAAEA//8=\n</AppendedData>\n</VTKFile>\n";
    const struct verify_sample *sample = sample_of_text(text);
    CU_ASSERT_TRUE(sample_field(sample, "u")->value[5] == 6 && sample_field(sample, "s")->value[1] == -1);
    damage_all(text, sizeof text - 1, TEXTS);
}

static void hdf5(void)
{
    static unsigned char whole[MOST];
    struct verify_samples written = {.count = 0};
    struct verify_sample *sample = verify_samples_add(&written, "made", &sample_error);
    CU_ASSERT_TRUE_FATAL(sample != NULL && verify_sample_points(sample, 4, 2, &sample_error));
    struct verify_sample_field *field = verify_sample_add(sample, "u", 2, &sample_error);
    CU_ASSERT_PTR_NOT_NULL_FATAL(field);
    (void)snprintf(field->unit, sizeof field->unit, "m");
    sample->time.value = sample->h.value = 0.5;
    CU_ASSERT_TRUE_FATAL(sample_file_write("", 0) && verify_sample_write_hdf5(sample_path, &written, &sample_error) &&
                         sample_file_read());
    FILE *stream = fopen(sample_path, "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    size_t size = fread(whole, 1, sizeof whole, stream);
    (void)fclose(stream);
    CU_ASSERT_TRUE_FATAL(size > 1000 && size < sizeof whole);
    damage_all(whole, size, HDF5S);
    verify_samples_free(&written);
}

int main(void)
{
    static const struct unit_test tests[] = {{"tables", tables}, {"VTU", vtu}, {"HDF5", hdf5}};
    return sample_files_end(unit_main("verify: damaged samples", tests, sizeof tests / sizeof *tests));
}
