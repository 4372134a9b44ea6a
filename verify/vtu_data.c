#include "verify/vtu_data.h"
#include "verify/sample.h"

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static const struct {
    const char *name;
    size_t size;
    enum { SIGNED, UNSIGNED, FLOATING } kind;
} types[] = {{"Float32", 4, FLOATING}, {"Float64", 8, FLOATING}, {"Int8", 1, SIGNED},  {"UInt8", 1, UNSIGNED},
             {"Int16", 2, SIGNED},     {"UInt16", 2, UNSIGNED},  {"Int32", 4, SIGNED}, {"UInt32", 4, UNSIGNED},
             {"Int64", 8, SIGNED},     {"UInt64", 8, UNSIGNED}};
enum { TYPES = sizeof types / sizeof *types };

static size_t type_of(const char *name)
{
    size_t type = 0;
    while (type < TYPES && strcmp(types[type].name, name) != 0) {
        type++;
    }
    return type;
}

/* Reads bytes from a source one after the other. */
struct stream {
    const struct vtu_source *source;
    size_t at;
    unsigned char group[3]; /* what a group of four letters holds */
    size_t in_group, taken;
};

static int letter_value(char letter)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *found = letter != '\0' ? strchr(letters, letter) : NULL;
    return found != NULL ? (int)(found - letters) : -1;
}

/* The next four letters; the last one or two may be '='. Writers begin anew after a header, so that '=' is no end. */
static bool next_group(struct stream *stream)
{
    int value[4] = {0, 0, 0, 0};
    size_t letters = 0, padding = 0;
    while (letters + padding < 4) {
        if (stream->at == stream->source->size) {
            return false;
        }
        char letter = stream->source->bytes[stream->at++];
        if (isspace((unsigned char)letter)) {
            continue;
        }
        int digit = letter_value(letter);
        if (letter == '=' && letters >= 2) {
            padding++;
        } else if (digit >= 0 && padding == 0) {
            value[letters++] = digit;
        } else {
            return false;
        }
    }
    stream->group[0] = (unsigned char)(value[0] << 2 | value[1] >> 4);
    stream->group[1] = (unsigned char)((value[1] & 15) << 4 | value[2] >> 2);
    stream->group[2] = (unsigned char)((value[2] & 3) << 6 | value[3]);
    stream->in_group = letters - 1;
    stream->taken = 0;
    return true;
}

static bool take(struct stream *stream, void *out, size_t size)
{
    unsigned char *to = out;
    if (stream->source->encoding == VTU_RAW) {
        bool enough = size <= stream->source->size - stream->at;
        if (enough) {
            memcpy(to, stream->source->bytes + stream->at, size);
            stream->at += size;
        }
        return enough;
    }
    for (size_t i = 0; i < size; i++) {
        if (stream->taken == stream->in_group && !next_group(stream)) {
            return false;
        }
        to[i] = stream->group[stream->taken++];
    }
    return true;
}

/* Bytes that are left at most. */
static size_t left(const struct stream *stream)
{
    size_t bytes = stream->source->size - stream->at;
    return stream->source->encoding == VTU_RAW ? bytes : bytes / 4 * 3 + 3;
}

static uint64_t number_at(const unsigned char *bytes, size_t size, bool big_endian)
{
    uint64_t number = 0;
    for (size_t i = 0; i < size; i++) {
        number = number << 8 | bytes[big_endian ? i : size - 1 - i];
    }
    return number;
}

static bool take_header(const struct vtu_storage *storage, struct stream *stream, uint64_t *value, char why[VTU_WHY])
{
    unsigned char bytes[8];
    size_t size = storage->wide_headers ? 8 : 4;
    if (!take(stream, bytes, size)) {
        (void)snprintf(why, VTU_WHY, "its bytes end, or are no base64, within a header");
        return false;
    }
    *value = number_at(bytes, size, storage->big_endian);
    return true;
}

static double convert(const unsigned char *bytes, size_t type, bool big_endian)
{
    uint64_t bits = number_at(bytes, types[type].size, big_endian);
    uint64_t sign = UINT64_C(1) << (8 * types[type].size - 1);
    if (types[type].kind == UNSIGNED) {
        return (double)bits;
    }
    if (types[type].kind == SIGNED) {
        return (bits & sign) != 0 ? -(double)(sign - (bits & (sign - 1))) : (double)bits;
    }
    if (types[type].size == 4) {
        uint32_t narrow = (uint32_t)bits;
        float single;
        memcpy(&single, &narrow, sizeof single);
        return (double)single;
    }
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static bool no_memory(size_t bytes, char why[VTU_WHY])
{
    (void)snprintf(why, VTU_WHY, "no memory for %zu bytes", bytes);
    return false;
}

static bool take_plain(const struct vtu_storage *storage, struct stream *stream, size_t bytes, unsigned char **out,
                       char why[VTU_WHY])
{
    uint64_t said;
    if (!take_header(storage, stream, &said, why)) {
        return false;
    }
    if (said != bytes || bytes > left(stream)) {
        (void)snprintf(why, VTU_WHY, "its header says %llu bytes and at most %zu follow, expected %zu",
                       (unsigned long long)said, left(stream), bytes);
        return false;
    }
    *out = malloc(bytes + 1);
    if (*out == NULL) {
        return no_memory(bytes, why);
    }
    if (!take(stream, *out, bytes)) {
        (void)snprintf(why, VTU_WHY, "its bytes end early or are no base64");
        return false;
    }
    return true;
}

/* One block of a packed array: `packed` bytes that must give `bytes`. */
static bool unpack_block(struct stream *stream, uint64_t packed, unsigned char *out, size_t bytes, char why[VTU_WHY])
{
    if (packed > left(stream)) {
        (void)snprintf(why, VTU_WHY, "a packed block claims %llu bytes, more than the %zu that follow",
                       (unsigned long long)packed, left(stream));
        return false;
    }
    unsigned char *from = malloc((size_t)packed + 1);
    if (from == NULL) {
        return no_memory((size_t)packed, why);
    }
    uLongf size = (uLongf)bytes;
    bool done =
        take(stream, from, (size_t)packed) && uncompress(out, &size, from, (uLong)packed) == Z_OK && size == bytes;
    free(from);
    if (!done) {
        (void)snprintf(why, VTU_WHY, "a block packed by zlib is damaged or does not hold %zu bytes", bytes);
    }
    return done;
}

/* Headers: blocks, bytes of a block, bytes of the last one where it is shorter, packed bytes of each. */
static bool take_packed(const struct vtu_storage *storage, struct stream *stream, size_t bytes, unsigned char **out,
                        char why[VTU_WHY])
{
    uint64_t blocks, each, last;
    if (!take_header(storage, stream, &blocks, why)) {
        return false;
    }
    if (blocks == 0 && bytes == 0) {
        *out = calloc(1, 1);
        return *out != NULL || no_memory(1, why);
    }
    if (!take_header(storage, stream, &each, why) || !take_header(storage, stream, &last, why)) {
        return false;
    }
    uint64_t full = last == 0 ? blocks : blocks - 1;
    bool fits = blocks > 0 && blocks <= left(stream) && last <= each && (full == 0 || each <= bytes / full) &&
                full * each + last == bytes && bytes / VERIFY_MOST_PACKED <= left(stream);
    uint64_t *packed = fits ? calloc((size_t)blocks, sizeof *packed) : NULL;
    *out = packed != NULL ? malloc(bytes + 1) : NULL;
    if (!fits) {
        (void)snprintf(why, VTU_WHY,
                       "its header says %llu blocks of %llu bytes and a last one of %llu, expected %zu "
                       "bytes in all, and no more than the file can hold",
                       (unsigned long long)blocks, (unsigned long long)each, (unsigned long long)last, bytes);
    } else if (*out == NULL) {
        (void)no_memory(bytes, why);
    }
    bool done = *out != NULL;
    for (size_t i = 0; done && i < blocks; i++) {
        done = take_header(storage, stream, &packed[i], why);
    }
    stream->taken = stream->in_group; /* the blocks begin with a group of letters of their own */
    for (size_t i = 0, at = 0; done && i < blocks; i++) {
        size_t size = (size_t)(i < full ? each : last);
        done = unpack_block(stream, packed[i], *out + at, size, why);
        at += size;
    }
    free(packed);
    return done;
}

/* Numbers with white space between; nothing else, and no more of them. */
static bool take_text(const struct vtu_source *source, size_t count, double *value, char why[VTU_WHY])
{
    const char *text = source->bytes, *end = text + source->size;
    for (size_t i = 0; i <= count; i++) {
        while (text < end && isspace((unsigned char)*text)) {
            text++;
        }
        if (text == end) {
            (void)snprintf(why, VTU_WHY, "holds %zu numbers, expected %zu", i, count);
            return i == count;
        }
        char word[64];
        size_t length = 0;
        while (text + length < end && !isspace((unsigned char)text[length]) && length + 1 < sizeof word) {
            word[length] = text[length];
            length++;
        }
        word[length] = '\0';
        char *rest = NULL;
        double number = strtod(word, &rest);
        if (*rest != '\0' || length + 1 == sizeof word) {
            (void)snprintf(why, VTU_WHY, "\"%.40s\" is no number", word);
            return false;
        }
        if (i < count) {
            value[i] = number;
        }
        text += length;
    }
    (void)snprintf(why, VTU_WHY, "holds more than the %zu numbers expected", count);
    return false;
}

static bool take_bytes(const struct vtu_storage *storage, const struct vtu_source *source, size_t type, size_t count,
                       double *value, char why[VTU_WHY])
{
    struct stream stream = {.source = source};
    unsigned char *bytes = NULL;
    size_t size = types[type].size;
    bool done = (storage->zlib ? take_packed : take_plain)(storage, &stream, count * size, &bytes, why);
    for (size_t i = 0; done && i < count; i++) {
        value[i] = convert(bytes + i * size, type, storage->big_endian);
    }
    free(bytes);
    return done;
}

bool vtu_numbers(const struct vtu_storage *storage, const struct vtu_source *source, const char *type, size_t count,
                 double **value, char why[VTU_WHY])
{
    size_t known = type_of(type);
    *value = NULL;
    if (known == TYPES) {
        (void)snprintf(why, VTU_WHY, "has the type \"%.40s\", expected Float32, Float64 or one of VTK's integers",
                       type);
        return false;
    }
    bool text = source->encoding == VTU_ASCII;
    size_t most = text            ? source->size / 2 + 1
                  : storage->zlib ? source->size / types[known].size * VERIFY_MOST_PACKED + VERIFY_MOST_PACKED
                                  : source->size / types[known].size;
    if (count > most) {
        (void)snprintf(why, VTU_WHY, "should hold %zu numbers, more than its %zu bytes can", count, source->size);
        return false;
    }
    *value = malloc((count + 1) * sizeof **value);
    bool done = *value == NULL ? no_memory(count * sizeof **value, why)
                : text         ? take_text(source, count, *value, why)
                               : take_bytes(storage, source, known, count, *value, why);
    if (!done) {
        free(*value);
        *value = NULL;
    }
    return done;
}
