/* VTK's XML files: every way in which they store numbers gives the same ones, and what is wrong with a file is said. */
#include "tests/unit/sample_files.h"
#include "verify/vtu_data.h"

#include <stdint.h>
#include <zlib.h>

enum { POINTS = 7, BLOCK = 32 };

/* How a file is written. */
struct way {
    enum { ASCII, BINARY, RAW, BASE64 } mode;
    bool packed, wide, big, single;
};

/* Text that grows. */
struct text {
    char bytes[1 << 16];
    size_t size;
};

static void put(struct text *text, const void *bytes, size_t size)
{
    CU_ASSERT_TRUE_FATAL(size <= sizeof text->bytes - text->size);
    memcpy(text->bytes + text->size, bytes, size);
    text->size += size;
}

static void put_text(struct text *text, const char *words)
{
    put(text, words, strlen(words));
}

static void put_base64(struct text *text, const unsigned char *bytes, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t rest = size - i;
        uint32_t three = (uint32_t)bytes[i] << 16 | (rest > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) |
                         (rest > 2 ? (uint32_t)bytes[i + 2] : 0);
        char four[4] = {digit[three >> 18], digit[three >> 12 & 63], rest > 1 ? digit[three >> 6 & 63] : '=',
                        rest > 2 ? digit[three & 63] : '='};
        put(text, four, 4);
    }
}

static void put_integer(struct text *text, uint64_t value, size_t size, bool big)
{
    for (size_t i = 0; i < size; i++) {
        unsigned char byte = (unsigned char)(value >> 8 * (big ? size - 1 - i : i));
        put(text, &byte, 1);
    }
}

/* The numbers as bytes, without a header. */
static void put_numbers(struct text *text, const struct way *way, const double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        float single = (float)value[i];
        uint64_t bits = 0;
        uint32_t narrow;
        memcpy(&narrow, &single, sizeof narrow);
        memcpy(&bits, &value[i], sizeof bits);
        put_integer(text, way->single ? narrow : bits, way->single ? 4 : 8, way->big);
    }
}

/* Header and bytes, either as they are or as letters. */
static void put_array(struct text *text, const struct way *way, const double *value, size_t count)
{
    static struct text plain, header, body;
    size_t word = way->wide ? 8 : 4;
    bool letters = way->mode != RAW;
    plain.size = header.size = body.size = 0;
    put_numbers(&plain, way, value, count);
    if (!way->packed) {
        put_integer(&body, plain.size, word, way->big);
        put(&body, plain.bytes, plain.size);
    } else {
        size_t full = plain.size / BLOCK, last = plain.size % BLOCK, blocks = full + (last > 0);
        put_integer(&header, blocks, word, way->big);
        put_integer(&header, BLOCK, word, way->big);
        put_integer(&header, last, word, way->big);
        for (size_t i = 0; i < blocks; i++) {
            unsigned char packed[256];
            uLongf size = sizeof packed;
            CU_ASSERT_EQUAL_FATAL(
                compress(packed, &size, (const unsigned char *)plain.bytes + i * BLOCK, i < full ? BLOCK : last), Z_OK);
            put_integer(&header, size, word, way->big);
            put(&body, packed, size);
        }
    }
    if (letters) {
        put_base64(text, (const unsigned char *)header.bytes, header.size);
        put_base64(text, (const unsigned char *)body.bytes, body.size);
    } else {
        put(text, header.bytes, header.size);
        put(text, body.bytes, body.size);
    }
}

static struct text file, appended;

static void put_data_array(const struct way *way, const char *name, size_t components, const double *value,
                           size_t points, const char *more)
{
    static const char *const format[] = {"ascii", "binary", "appended", "appended"};
    char tag[320];
    (void)snprintf(tag, sizeof tag,
                   "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%zu\" format=\"%s\" offset=\"%zu\" %s>",
                   way->single ? "Float32" : "Float64", name, components, format[way->mode], appended.size, more);
    put_text(&file, tag);
    if (way->mode == ASCII) {
        for (size_t i = 0; i < points * components; i++) {
            char number[40];
            (void)snprintf(number, sizeof number, "%s%.17g", i % 5 == 0 ? "\n " : " ", value[i]);
            put_text(&file, number);
        }
    } else {
        put_text(way->mode == BINARY ? &file : &appended, way->mode == BINARY ? "\n" : "");
        put_array(way->mode == BINARY ? &file : &appended, way, value, points * components);
    }
    put_text(&file, "<InformationKey name=\"L2_NORM_RANGE\"><Value index=\"0\">5 6 7</Value></InformationKey>\n");
    put_text(&file, "</DataArray>\n");
}

static double X_of(size_t i)
{
    return 0.125 * (double)i;
}

static double u_of(size_t i)
{
    return -1.5 + 0.25 * (double)(i * i);
}

static void build(const struct way *way)
{
    double X[3 * POINTS], u[3 * POINTS], P[9 * POINTS], time = 0.5, n = 16;
    for (size_t i = 0; i < 9 * POINTS; i++) {
        P[i] = u_of(i) * 2;
        if (i < 3 * POINTS) {
            X[i] = X_of(i);
            u[i] = u_of(i);
        }
    }
    file.size = appended.size = 0;
    put_text(&file, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"");
    put_text(&file, way->big ? " byte_order=\"BigEndian\"" : " byte_order=\"LittleEndian\"");
    put_text(&file, way->wide ? " header_type=\"UInt64\"" : " header_type=\"UInt32\"");
    put_text(&file, way->packed ? " compressor=\"vtkZLibDataCompressor\"" : "");
    put_text(&file, ">\n<UnstructuredGrid>\n<FieldData>\n");
    put_data_array(way, "TimeValue", 1, &time, 1, "NumberOfTuples=\"1\"");
    put_data_array(way, "n", 1, &n, 1, "NumberOfTuples=\"1\"");
    put_text(&file, "</FieldData>\n<Piece NumberOfPoints=\"7\" NumberOfCells=\"0\">\n<PointData>\n");
    put_data_array(way, "displacement [mm]", 3, u, POINTS, "");
    put_data_array(way, "P", 9, P, POINTS, "unit=\"MPa\"");
    put_text(&file, "</PointData>\n<CellData/>\n<Points>\n");
    put_data_array(way, "Points", 3, X, POINTS, "");
    put_text(&file, "</Points>\n<Cells/>\n</Piece>\n</UnstructuredGrid>\n");
    if (appended.size > 0) {
        put_text(&file, way->mode == RAW ? "<AppendedData encoding=\"raw\">\n   _"
                                         : "<AppendedData encoding=\"base64\">\n   _");
        put(&file, appended.bytes, appended.size);
        put_text(&file, "\n</AppendedData>\n");
    }
    put_text(&file, "</VTKFile>\n");
}

static void every_way_gives_the_same(void)
{
    for (int i = 0; i < 64; i++) {
        struct way way = {.mode = i & 3, .packed = i & 4, .wide = i & 8, .big = i & 16, .single = i & 32};
        build(&way);
        const struct verify_sample *sample = sample_of(file.bytes, file.size);
        const struct verify_sample_field *u = sample_field(sample, "displacement"), *P = sample_field(sample, "P");
        CU_ASSERT_TRUE_FATAL(sample->count == POINTS && u->width == 3 && P->width == 9);
        CU_ASSERT_TRUE(sample->time.value == 0.5 && sample->n == 16 && sample->single == way.single);
        CU_ASSERT_TRUE(u->has_unit && P->has_unit && !sample->has_unit && !sample->needs_units);
        CU_ASSERT_STRING_EQUAL(u->unit, "mm");
        CU_ASSERT_STRING_EQUAL(P->unit, "MPa");
        for (size_t j = 0; j < 3 * POINTS; j++) {
            CU_ASSERT_TRUE(sample->X[j] == X_of(j) && u->value[j] == u_of(j)); /* all exact in single precision */
        }
        for (size_t j = 0; j < 9 * POINTS; j++) {
            CU_ASSERT_EQUAL(P->value[j], 2 * u_of(j));
        }
    }
}

/* The file with the first `from` replaced by `to`. */
static void refused_with(const char *from, const char *to, const char *words)
{
    static struct text changed;
    char *at = NULL;
    for (size_t i = 0; i + strlen(from) <= file.size && at == NULL; i++) {
        at = memcmp(file.bytes + i, from, strlen(from)) == 0 ? file.bytes + i : NULL;
    }
    CU_ASSERT_PTR_NOT_NULL_FATAL(at);
    changed.size = 0;
    put(&changed, file.bytes, (size_t)(at - file.bytes));
    put_text(&changed, to);
    put(&changed, at + strlen(from), file.size - (size_t)(at - file.bytes) - strlen(from));
    sample_refused(changed.bytes, changed.size, words);
}

static void refuses_what_is_wrong_in_xml(void)
{
    static const struct {
        const char *from, *to, *words;
    } wrong[] = {
        {"VTKFile type", "VTUFile type", "expected a VTKFile"},
        {"\"UnstructuredGrid\"", "\"PolyData\"", "expected \"UnstructuredGrid\""},
        {"UInt32", "Int32", "header_type"},
        {"LittleEndian", "MiddleEndian", "byte_order"},
        {"version=\"1.0\" b", "compressor=\"vtkLZ4DataCompressor\" b", "compressor \"vtkLZ4DataCompressor\""},
        {"NumberOfPoints=\"7\"", "NumberOfPoints=\"8\"", "expected 24"},
        {"NumberOfPoints=\"7\"", "NumberOfPoints=\"6\"", "more than the 18 numbers"},
        {"NumberOfPoints=\"7\"", "NumberOfPoints=\"0\"", "more than the 0 numbers"},
        {"NumberOfPoints=\"7\"", "NumberOfPoints=\"-7\"", "expected a whole number"},
        {"NumberOfPoints=\"7\"", "NumberOfPoints=\"4000000000000\"", "can"},
        {"NumberOfPoints=\"7\"", "NumberOfPoints=\"99999999999999999999999\"", "expected a whole number"},
        {"NumberOfPoints=\"7\"", "", "more than the 0 numbers"},
        {"</Piece>", "</Piece><Piece/>", "a second Piece"},
        {"<UnstructuredGrid>", "<UnstructuredGrid><Points><DataArray type=\"Float64\" format=\"ascii\"/></Points>",
         "stands in no Piece"},
        {"NumberOfComponents=\"3\"", "NumberOfComponents=\"5\"", "numbers"},
        {"NumberOfComponents=\"9\"", "NumberOfComponents=\"10\"", "must be 1 to 9"},
        {"Float64", "Float16", "has the type \"Float16\""},
        {"format=\"ascii\"", "format=\"morse\"", "must be ascii, binary or appended"},
        {"format=\"ascii\"", "format=\"appended\"", "beyond the appended data"},
        {"-1.5", "-1,5", "is no number"},
        {"-1.5", "nan", "field displacement: component 0 of point 0 is nan"},
        {"Name=\"P\"", "Name=\"displacement\"", "given twice"},
        {"Name=\"P\"", "", "empty or too long"},
        {"Name=\"n\"", "Name=\"h\" unit=\"a unit that is much too long to be one\"", "too long"},
        {"</Points>", "", "no well-formed XML"},
        {"<?xml version=\"1.0\"?>", "<!DOCTYPE VTKFile [<!ENTITY a \"b\">]>", "a document type"},
        {"</Piece>", "&lol;</Piece>", "no well-formed XML"},
    };
    build(&(struct way){.mode = ASCII});
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        refused_with(wrong[i].from, wrong[i].to, wrong[i].words);
    }
    sample_refused(file.bytes, file.size / 2, "no well-formed XML");
    sample_refused_text("<a/>", "expected a VTKFile");
    sample_refused_text("<VTKFile type=\"UnstructuredGrid\"/>", "no UnstructuredGrid with a Piece");
    sample_refused_text("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"1\"/>"
                        "</UnstructuredGrid></VTKFile>",
                        "has no points");
}

/* Headers that lie, and letters that are none. */
static void refuses_what_is_wrong_in_bytes(void)
{
    static const uint64_t lies[] = {0, 1, 3, 5, 0x7fffffff, 0xffffffff, UINT64_MAX};
    double value[6] = {1, 2, 3, 4, 5, 6}, *read = NULL;
    char why[VTU_WHY] = "";
    for (int i = 0; i < 16; i++) {
        struct way way = {.mode = i & 1 ? RAW : BASE64, .packed = i & 2, .wide = i & 4, .big = i & 8};
        struct vtu_storage storage = {.big_endian = way.big, .wide_headers = way.wide, .zlib = way.packed};
        struct vtu_source source = {.encoding = way.mode == RAW ? VTU_RAW : VTU_BASE64, .bytes = appended.bytes};
        appended.size = 0;
        put_array(&appended, &way, value, 6);
        source.size = appended.size;
        CU_ASSERT_TRUE(vtu_numbers(&storage, &source, "Float64", 6, &read, why));
        CU_ASSERT_TRUE(read != NULL && same_numbers(read, value, 6));
        free(read);
        CU_ASSERT_FALSE(vtu_numbers(&storage, &source, "Float64", 5, &read, why));
        CU_ASSERT_FALSE(vtu_numbers(&storage, &source, "Float64", SIZE_MAX / 8, &read, why));
        for (source.size = 0; source.size + 2 < appended.size; source.size++) { /* padding may lack at the end */
            bool cut = vtu_numbers(&storage, &source, "Float64", 6, &read, why);
            CU_ASSERT_FALSE(cut);
            CU_ASSERT_PTR_NULL(read);
        }
        source.size = appended.size;
        size_t word = way.wide ? 8 : 4;
        for (size_t at = 0; way.mode == RAW && at < (way.packed ? 4 * word : word); at += word) {
            struct text before = appended;
            for (size_t j = 0; j < sizeof lies / sizeof *lies; j++) {
                appended.size = at;
                put_integer(&appended, lies[j], word, way.big);
                bool same = memcmp(before.bytes, appended.bytes, before.size) == 0;
                CU_ASSERT_TRUE(same || !vtu_numbers(&storage, &source, "Float64", 6, &read, why));
            }
            appended = before;
        }
        appended.bytes[2] = way.mode == RAW ? appended.bytes[2] : '*';
        CU_ASSERT_TRUE(way.mode == RAW || !vtu_numbers(&storage, &source, "Float64", 6, &read, why));
    }
}

static void every_type_of_number(void)
{
    static const struct {
        const char *type;
        size_t size;
        unsigned char bytes[8];
        double value;
    } numbers[] = {
        {"Int8", 1, {0x80}, -128},
        {"UInt8", 1, {0xff}, 255},
        {"Int16", 2, {0xfe, 0xff}, -2},
        {"UInt16", 2, {0x01, 0x02}, 513},
        {"Int32", 4, {0xff, 0xff, 0xff, 0xff}, -1},
        {"UInt32", 4, {0, 0, 0, 0x80}, 2147483648.0},
        {"Int64", 8, {0, 0, 0, 0, 0, 0, 0, 0x80}, -9223372036854775808.0},
        {"UInt64", 8, {0, 0, 0, 0, 0, 0, 0, 0x80}, 9223372036854775808.0},
        {"Float32", 4, {0, 0, 0xc0, 0x3f}, 1.5},
        {"Float64", 8, {0, 0, 0, 0, 0, 0, 0xf8, 0xbf}, -1.5},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        static struct text bytes;
        double *value = NULL;
        char why[VTU_WHY] = "";
        struct vtu_storage storage = {.big_endian = false};
        bytes.size = 0;
        put_integer(&bytes, numbers[i].size, 4, false);
        put(&bytes, numbers[i].bytes, numbers[i].size);
        struct vtu_source source = {.encoding = VTU_RAW, .bytes = bytes.bytes, .size = bytes.size};
        CU_ASSERT_TRUE_FATAL(vtu_numbers(&storage, &source, numbers[i].type, 1, &value, why));
        CU_ASSERT_EQUAL(value[0], numbers[i].value);
        free(value);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"every way gives the same", every_way_gives_the_same},
        {"refuses what is wrong in XML", refuses_what_is_wrong_in_xml},
        {"refuses what is wrong in bytes", refuses_what_is_wrong_in_bytes},
        {"every type of number", every_type_of_number},
    };
    return sample_files_end(unit_main("verify: samples from VTU", tests, sizeof tests / sizeof *tests));
}
