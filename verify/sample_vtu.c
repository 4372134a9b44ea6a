/* VTK's XML files of unstructured grids (.vtu): points, point data, and the time among the field data. */
#include "verify/sample.h"
#include "verify/vtu_data.h"

#include <ctype.h>
#include <expat.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum section { ELSEWHERE, POINTS, POINT_DATA, FIELD_DATA };

struct array {
    char name[128], type[16], format[16], unit[VERIFY_SAMPLE_UNIT];
    bool has_unit;
    size_t components, tuples, offset;
    bool has_tuples, has_offset;
};

struct reader {
    XML_Parser parser;
    struct verify_sample *sample;
    struct solver_error *error;
    bool failed;
    struct vtu_storage storage;
    struct vtu_source appended; /* size 0: none */
    bool is_file, is_grid;
    size_t pieces, points;
    enum section section;
    size_t depth, array_depth; /* of elements; 0: in no array */
    struct array array;
    char *text; /* of the array at hand */
    size_t length, room;
};

static void fail(struct reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void fail(struct reader *reader, const char *format, ...)
{
    char what[600];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (!reader->failed) {
        (void)verify_sample_refuse(reader->sample, reader->error, "line %lu: %s",
                                   (unsigned long)XML_GetCurrentLineNumber(reader->parser), what);
    }
    reader->failed = true;
    (void)XML_StopParser(reader->parser, XML_FALSE);
}

/* The array in words: "DataArray displacement". */
static void fail_array(struct reader *reader, const char *why)
{
    fail(reader, "DataArray %.100s: %s", reader->array.name, why);
}

static const char *attribute(const XML_Char **attributes, const char *name)
{
    for (; attributes[0] != NULL; attributes += 2) {
        if (strcmp(attributes[0], name) == 0) {
            return attributes[1];
        }
    }
    return NULL;
}

static bool parse_count(const char *text, size_t *count)
{
    char *end = NULL;
    unsigned long value = isdigit((unsigned char)text[0]) ? strtoul(text, &end, 10) : 0;
    *count = value;
    return end != NULL && *end == '\0' && value < ULONG_MAX / 16;
}

/* A count among the attributes; `missing` where it is not there. */
static size_t count_of(struct reader *reader, const XML_Char **attributes, const char *name, size_t missing)
{
    const char *text = attribute(attributes, name);
    size_t count = missing;
    if (text != NULL && !parse_count(text, &count)) {
        fail(reader, "%s=\"%.40s\", expected a whole number", name, text);
        return 0;
    }
    return count;
}

static void take_file(struct reader *reader, const XML_Char **attributes)
{
    const char *type = attribute(attributes, "type"), *order = attribute(attributes, "byte_order");
    const char *header = attribute(attributes, "header_type"), *compressor = attribute(attributes, "compressor");
    reader->is_file = true;
    if (type == NULL || strcmp(type, "UnstructuredGrid") != 0) {
        fail(reader, "VTKFile of type \"%.40s\", expected \"UnstructuredGrid\"", type != NULL ? type : "");
    } else if (compressor != NULL && strcmp(compressor, "vtkZLibDataCompressor") != 0) {
        fail(reader, "compressor \"%.60s\" is not known; write with vtkZLibDataCompressor or without", compressor);
    } else if (header != NULL && strcmp(header, "UInt32") != 0 && strcmp(header, "UInt64") != 0) {
        fail(reader, "header_type \"%.40s\", expected UInt32 or UInt64", header);
    } else if (order != NULL && strcmp(order, "LittleEndian") != 0 && strcmp(order, "BigEndian") != 0) {
        fail(reader, "byte_order \"%.40s\", expected LittleEndian or BigEndian", order);
    }
    reader->storage = (struct vtu_storage){.big_endian = order != NULL && strcmp(order, "BigEndian") == 0,
                                           .wide_headers = header != NULL && strcmp(header, "UInt64") == 0,
                                           .zlib = compressor != NULL};
}

static void copy(struct reader *reader, char *to, size_t size, const char *text, const char *what)
{
    if (text != NULL && strlen(text) >= size) {
        fail(reader, "%s \"%.60s...\" is too long", what, text);
    }
    (void)snprintf(to, size, "%s", text != NULL ? text : "");
}

static void begin_array(struct reader *reader, const XML_Char **attributes)
{
    struct array *array = &reader->array;
    const char *unit = attribute(attributes, "unit");
    *array = (struct array){.has_unit = unit != NULL, .has_offset = attribute(attributes, "offset") != NULL};
    copy(reader, array->name, sizeof array->name, attribute(attributes, "Name"), "the array's name");
    copy(reader, array->type, sizeof array->type, attribute(attributes, "type"), "the array's type");
    copy(reader, array->format, sizeof array->format, attribute(attributes, "format"), "the array's format");
    copy(reader, array->unit, sizeof array->unit, unit, "the array's unit");
    array->components = count_of(reader, attributes, "NumberOfComponents", 1);
    array->has_tuples = attribute(attributes, "NumberOfTuples") != NULL;
    array->tuples = count_of(reader, attributes, "NumberOfTuples", 1);
    array->offset = count_of(reader, attributes, "offset", 0);
    reader->array_depth = reader->depth;
    reader->length = 0;
    if (reader->section != FIELD_DATA && reader->pieces == 0) {
        fail_array(reader, "stands in no Piece");
    }
    if (array->components < 1 || array->components > 9) {
        fail_array(reader, "NumberOfComponents must be 1 to 9");
    }
}

/* The bytes of the array at hand. */
static bool source_of(struct reader *reader, struct vtu_source *source)
{
    const struct array *array = &reader->array;
    if (strcmp(array->format, "ascii") == 0 || strcmp(array->format, "binary") == 0) {
        *source = (struct vtu_source){array->format[0] == 'a' ? VTU_ASCII : VTU_BASE64,
                                      reader->text != NULL ? reader->text : "", reader->length};
        return true;
    }
    if (strcmp(array->format, "appended") != 0) {
        fail_array(reader, "its format must be ascii, binary or appended");
        return false;
    }
    if (!array->has_offset || array->offset >= reader->appended.size) {
        fail_array(reader, "its offset lies beyond the appended data");
        return false;
    }
    *source = reader->appended;
    source->bytes += array->offset;
    source->size -= array->offset;
    return true;
}

static void take_points(struct reader *reader, const double *value)
{
    if (reader->array.components != 3) {
        fail_array(reader, "points must have 3 components");
        return;
    }
    reader->sample->single = strcmp(reader->array.type, "Float32") == 0;
    if (!verify_sample_points(reader->sample, reader->points, 3, reader->error)) {
        reader->failed = true;
        (void)XML_StopParser(reader->parser, XML_FALSE);
        return;
    }
    memcpy(reader->sample->X, value, 3 * reader->points * sizeof *value);
    reader->sample->has_unit = reader->array.has_unit;
    (void)snprintf(reader->sample->unit, sizeof reader->sample->unit, "%s", reader->array.unit);
}

static void take_field(struct reader *reader, const double *value)
{
    const struct array *array = &reader->array;
    struct verify_sample *sample = reader->sample;
    double *to = NULL;
    sample->count = reader->points; /* point data may stand before the points */
    if (verify_sample_is_weight(array->name) && array->components == 1) {
        to = verify_sample_weights(sample, reader->error) ? sample->weight : NULL;
    } else {
        struct verify_sample_field *field =
            verify_sample_add(sample, array->name, (int)array->components, reader->error);
        if (field != NULL && array->has_unit) {
            field->has_unit = true;
            (void)snprintf(field->unit, sizeof field->unit, "%s", array->unit);
        }
        to = field != NULL ? field->value : NULL;
    }
    if (to == NULL) {
        reader->failed = true;
        (void)XML_StopParser(reader->parser, XML_FALSE);
        return;
    }
    memcpy(to, value, reader->points * array->components * sizeof *value);
}

static void take_single(struct reader *reader, const double *value)
{
    const struct array *array = &reader->array;
    if (!verify_sample_number(reader->sample, array->name, value[0], array->has_unit ? array->unit : NULL,
                              reader->error)) {
        reader->failed = true;
        (void)XML_StopParser(reader->parser, XML_FALSE);
    }
}

static void end_array(struct reader *reader)
{
    struct array *array = &reader->array;
    struct vtu_source source;
    char why[VTU_WHY] = "";
    double *value = NULL;
    bool single = reader->section == FIELD_DATA;
    if (single && (!verify_sample_is_number(array->name) || array->tuples * array->components != 1)) {
        return;
    }
    size_t count = single ? 1 : reader->points * array->components;
    if (!source_of(reader, &source)) {
        return;
    }
    if (!vtu_numbers(&reader->storage, &source, array->type, count, &value, why)) {
        fail_array(reader, why);
        return;
    }
    (single ? take_single : reader->section == POINTS ? take_points : take_field)(reader, value);
    free(value);
}

static enum section section_called(const char *name)
{
    return strcmp(name, "Points") == 0      ? POINTS
           : strcmp(name, "PointData") == 0 ? POINT_DATA
           : strcmp(name, "FieldData") == 0 ? FIELD_DATA
                                            : ELSEWHERE;
}

static void XMLCALL begin(void *context, const XML_Char *name, const XML_Char **attributes)
{
    struct reader *reader = context;
    reader->depth++;
    if (reader->depth == 1 && strcmp(name, "VTKFile") != 0) {
        fail(reader, "<%.40s>, expected a VTKFile: the XML file of an unstructured grid", name);
    } else if (reader->depth == 1) {
        take_file(reader, attributes);
    } else if (strcmp(name, "UnstructuredGrid") == 0) {
        reader->is_grid = true;
    } else if (strcmp(name, "Piece") == 0) {
        reader->points = count_of(reader, attributes, "NumberOfPoints", 0);
        if (reader->pieces++ > 0) {
            fail(reader, "a second Piece; expected one that holds all points");
        }
    } else if (section_called(name) != ELSEWHERE) {
        reader->section = section_called(name);
    } else if (strcmp(name, "DataArray") == 0 && reader->section != ELSEWHERE && reader->array_depth == 0) {
        begin_array(reader, attributes);
    }
}

static void XMLCALL end(void *context, const XML_Char *name)
{
    struct reader *reader = context;
    if (reader->array_depth == reader->depth && reader->depth > 0 && !reader->failed) {
        end_array(reader);
    }
    if (reader->array_depth == reader->depth) {
        reader->array_depth = 0;
    }
    if (section_called(name) != ELSEWHERE) {
        reader->section = ELSEWHERE;
    }
    reader->depth--;
}

static void XMLCALL letters(void *context, const XML_Char *text, int length)
{
    struct reader *reader = context;
    if (reader->array_depth != reader->depth || reader->depth == 0) {
        return; /* not directly within an array */
    }
    size_t wanted = reader->length + (size_t)length;
    if (wanted > reader->room) {
        char *more = realloc(reader->text, 2 * wanted);
        if (more == NULL) {
            fail_array(reader, "no memory for its text");
            return;
        }
        reader->text = more;
        reader->room = 2 * wanted;
    }
    memcpy(reader->text + reader->length, text, (size_t)length);
    reader->length = wanted;
}

static void XMLCALL refuse_doctype(void *context, const XML_Char *name, const XML_Char *system, const XML_Char *public,
                                   int internal)
{
    (void)system;
    (void)public;
    (void)internal;
    fail(context, "a document type %.40s; VTK's files have none", name);
}

/* Where `word` begins in the bytes; NULL if nowhere. */
static char *find(char *bytes, size_t size, const char *word)
{
    size_t length = strlen(word);
    for (char *at = bytes; (at = memchr(at, word[0], size - (size_t)(at - bytes))) != NULL; at++) {
        if (size - (size_t)(at - bytes) < length) {
            return NULL;
        }
        if (memcmp(at, word, length) == 0) {
            return at;
        }
    }
    return NULL;
}

/* Appended data may be raw bytes, which are no XML: cuts them off, and returns how much is left to parse. */
static size_t cut_appended(struct reader *reader, char *bytes, size_t size)
{
    char *tag = find(bytes, size, "<AppendedData");
    char *close = tag != NULL ? find(tag, size - (size_t)(tag - bytes), ">") : NULL;
    char *mark = close != NULL ? find(close, size - (size_t)(close - bytes), "_") : NULL;
    if (mark == NULL) {
        return size;
    }
    size_t within = (size_t)(close - tag);
    bool raw = find(tag, within, "\"raw\"") != NULL || find(tag, within, "'raw'") != NULL;
    char *last = mark + 1;
    size_t rest = size - (size_t)(last - bytes);
    /* Raw bytes may hold anything: the end of the element is no bound for them, arrays have their own lengths. */
    char *stop = raw ? NULL : find(last, rest, "<");
    reader->appended =
        (struct vtu_source){raw ? VTU_RAW : VTU_BASE64, last, stop != NULL ? (size_t)(stop - last) : rest};
    return (size_t)(tag - bytes);
}

static bool parse_all(struct reader *reader, char *bytes, size_t size)
{
    static const char rest[] = "</VTKFile>";
    size_t length = cut_appended(reader, bytes, size);
    bool cut = length < size;
    if (length > INT_MAX) {
        return verify_sample_refuse(reader->sample, reader->error, "more than 2 GiB of XML");
    }
    bool done = XML_Parse(reader->parser, bytes, (int)length, cut ? XML_FALSE : XML_TRUE) == XML_STATUS_OK &&
                (!cut || XML_Parse(reader->parser, rest, (int)sizeof rest - 1, XML_TRUE) == XML_STATUS_OK);
    if (!done && !reader->failed) {
        return verify_sample_refuse(reader->sample, reader->error, "line %lu: no well-formed XML (%s)",
                                    (unsigned long)XML_GetCurrentLineNumber(reader->parser),
                                    XML_ErrorString(XML_GetErrorCode(reader->parser)));
    }
    return done && !reader->failed;
}

bool verify_sample_vtu(const char *path, char *bytes, size_t size, struct verify_samples *samples,
                       struct solver_error *error)
{
    struct reader reader = {.error = error, .sample = verify_samples_add(samples, path, error)};
    if (reader.sample == NULL) {
        return false;
    }
    reader.parser = XML_ParserCreate(NULL);
    if (reader.parser == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%.360s: no memory to read XML", path);
    }
    XML_SetUserData(reader.parser, &reader);
    XML_SetElementHandler(reader.parser, begin, end);
    XML_SetCharacterDataHandler(reader.parser, letters);
    XML_SetStartDoctypeDeclHandler(reader.parser, refuse_doctype);
    bool done = parse_all(&reader, bytes, size);
    if (done && (reader.pieces == 0 || !reader.is_grid)) {
        done = verify_sample_refuse(reader.sample, error, "no UnstructuredGrid with a Piece");
    }
    XML_ParserFree(reader.parser);
    free(reader.text);
    return done;
}
