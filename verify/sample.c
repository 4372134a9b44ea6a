#include "verify/sample.h"

#include "verify/files.h"
#include "verify/units.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool verify_sample_refuse(const struct verify_sample *sample, struct solver_error *error, const char *format, ...)
{
    char what[640];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return solver_fail(error, SOLVER_BAD_INPUT, "%.360s: %s", sample->place, what);
}

struct verify_sample *verify_samples_add(struct verify_samples *samples, const char *place, struct solver_error *error)
{
    if (samples->count == VERIFY_SAMPLES) {
        (void)solver_fail(error, SOLVER_BAD_INPUT, "%.360s: one level too many; at most %d can be judged together",
                          place, VERIFY_SAMPLES);
        return NULL;
    }
    struct verify_sample *sample = calloc(1, sizeof *sample);
    if (sample == NULL) {
        (void)solver_fail(error, SOLVER_NO_MEMORY, "%.360s: no memory for a level", place);
        return NULL;
    }
    (void)snprintf(sample->place, sizeof sample->place, "%s", place);
    solver_plain(sample->place, false); /* groups are named by the file */
    sample->time.value = sample->h.value = NAN;
    samples->sample[samples->count++] = sample;
    return sample;
}

void verify_samples_free(struct verify_samples *samples)
{
    for (size_t i = 0; i < samples->count; i++) {
        struct verify_sample *sample = samples->sample[i];
        for (size_t j = 0; j < sample->field_count; j++) {
            free(sample->field[j].value);
        }
        free(sample->X);
        free(sample->weight);
        free(sample);
    }
    samples->count = 0;
}

static bool allocate(double **out, const struct verify_sample *sample, size_t width, const char *what,
                     struct solver_error *error)
{
    *out = calloc(sample->count + 1, width * sizeof **out);
    return *out != NULL || solver_fail(error, SOLVER_NO_MEMORY, "%.360s: no memory for %zu x %zu values of %s",
                                       sample->place, sample->count, width, what);
}

bool verify_sample_points(struct verify_sample *sample, size_t count, int dim, struct solver_error *error)
{
    if (count == 0) {
        return verify_sample_refuse(sample, error, "has no points");
    }
    if (dim < 1 || dim > 3) {
        return verify_sample_refuse(sample, error, "points have %d coordinates, expected 1, 2 or 3", dim);
    }
    if (sample->X != NULL) {
        return verify_sample_refuse(sample, error, "points are given twice");
    }
    sample->count = count;
    sample->dim = dim;
    return allocate(&sample->X, sample, 3, "points", error);
}

bool verify_sample_weights(struct verify_sample *sample, struct solver_error *error)
{
    return sample->weight != NULL ? verify_sample_refuse(sample, error, "weights are given twice")
                                  : allocate(&sample->weight, sample, 1, "weights", error);
}

static bool width_is_known(int width)
{
    return width == 1 || width == 2 || width == 3 || width == 4 || width == 6 || width == 9;
}

struct verify_sample_field *verify_sample_add(struct verify_sample *sample, const char *name, int width,
                                              struct solver_error *error)
{
    char text[VERIFY_SAMPLE_NAME + VERIFY_SAMPLE_UNIT];
    (void)snprintf(text, sizeof text, "%s", name);
    const char *unit = verify_unit_split(text);
    if (text[0] == '\0' || strlen(name) >= sizeof text || strlen(text) >= VERIFY_SAMPLE_NAME ||
        (unit != NULL && strlen(unit) >= VERIFY_SAMPLE_UNIT)) {
        (void)verify_sample_refuse(sample, error, "a field's name \"%.80s\" is empty or too long", name);
        return NULL;
    }
    if (!width_is_known(width)) {
        (void)verify_sample_refuse(sample, error,
                                   "field %s: %d numbers a point; expected 1 (scalar), 2 or 3 (vector), 4 or 9 "
                                   "(tensor, row by row) or 6 (symmetric tensor: xx, yy, zz, xy, yz, xz)",
                                   text, width);
        return NULL;
    }
    for (size_t i = 0; i < sample->field_count; i++) {
        if (strcmp(sample->field[i].name, text) == 0) {
            (void)verify_sample_refuse(sample, error, "field %s is given twice", text);
            return NULL;
        }
    }
    if (sample->field_count == VERIFY_SAMPLE_FIELDS) {
        (void)verify_sample_refuse(sample, error, "more than %d fields", VERIFY_SAMPLE_FIELDS);
        return NULL;
    }
    struct verify_sample_field *field = &sample->field[sample->field_count];
    *field = (struct verify_sample_field){.width = width, .has_unit = unit != NULL, .given = (1U << width) - 1};
    (void)snprintf(field->name, sizeof field->name, "%.63s", text);
    (void)snprintf(field->unit, sizeof field->unit, "%.31s", unit != NULL ? unit : "");
    if (!allocate(&field->value, sample, (size_t)width, field->name, error)) {
        return NULL;
    }
    sample->field_count++;
    return field;
}

enum number { NONE, TIME, SPACING, SPACINGS };

static enum number number_of(const char *name)
{
    static const struct {
        const char *name;
        enum number number;
    } names[] = {{"t", TIME},    {"time", TIME},       {"TimeValue", TIME},
                 {"h", SPACING}, {"spacing", SPACING}, {"n", SPACINGS}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcasecmp(name, names[i].name) == 0) {
            return names[i].number;
        }
    }
    return NONE;
}

bool verify_sample_is_number(const char *name)
{
    return number_of(name) != NONE;
}

bool verify_sample_is_weight(const char *name)
{
    return strcasecmp(name, "weight") == 0 || strcasecmp(name, "weights") == 0 || strcasecmp(name, "volume") == 0;
}

bool verify_sample_number(struct verify_sample *sample, const char *name, double value, const char *unit,
                          struct solver_error *error)
{
    enum number which = number_of(name);
    if (which == NONE) {
        return true;
    }
    if (!isfinite(value)) {
        return verify_sample_refuse(sample, error, "%.40s = %g, expected a finite number", name, value);
    }
    if (which == SPACINGS) {
        if (!(value >= 1 && value <= INT_MAX && value == floor(value))) {
            return verify_sample_refuse(sample, error, "%.40s = %g, expected a whole number above 0", name, value);
        }
        sample->n = (int)value;
        return true;
    }
    if (which == SPACING && !(value > 0)) {
        return verify_sample_refuse(sample, error, "%.40s = %g, expected a spacing above 0", name, value);
    }
    if (unit != NULL && strlen(unit) >= VERIFY_SAMPLE_UNIT) {
        return verify_sample_refuse(sample, error, "%.40s: its unit is too long: \"%.60s\"", name, unit);
    }
    struct verify_sample_number *number = which == TIME ? &sample->time : &sample->h;
    *number = (struct verify_sample_number){.value = value, .has_unit = unit != NULL};
    (void)snprintf(number->unit, sizeof number->unit, "%s", unit != NULL ? unit : "");
    return true;
}

/* What must hold of any sample, whoever read it. */
static bool check_numbers(const struct verify_sample *sample, struct solver_error *error)
{
    if (sample->X == NULL) {
        return verify_sample_refuse(sample, error, "has no points");
    }
    for (size_t a = 0; a < sample->count; a++) {
        const double *X = sample->X + 3 * a;
        if (!isfinite(X[0]) || !isfinite(X[1]) || !isfinite(X[2])) {
            return verify_sample_refuse(sample, error, "point %zu is (%g, %g, %g), expected finite numbers", a, X[0],
                                        X[1], X[2]);
        }
        if (sample->weight != NULL && !(sample->weight[a] >= 0 && isfinite(sample->weight[a]))) {
            return verify_sample_refuse(sample, error, "the weight of point %zu is %g, expected a finite number from 0",
                                        a, sample->weight[a]);
        }
    }
    for (size_t i = 0; i < sample->field_count; i++) {
        const struct verify_sample_field *field = &sample->field[i];
        for (size_t j = 0; j < sample->count * (size_t)field->width; j++) {
            if (!isfinite(field->value[j])) {
                return verify_sample_refuse(sample, error,
                                            "field %s: component %zu of point %zu is %g, expected a "
                                            "finite number",
                                            field->name, j % (size_t)field->width, j / (size_t)field->width,
                                            field->value[j]);
            }
        }
    }
    return true;
}

static bool is_hdf5(const char *bytes, size_t size)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    return size >= sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

/* XML begins with a tag, after white space and a mark of UTF-8 at most. */
static bool is_xml(const char *bytes)
{
    bytes += strncmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    return bytes[strspn(bytes, " \t\r\n")] == '<';
}

bool verify_sample_read(const char *path, struct verify_samples *samples, struct solver_error *error)
{
    char *bytes = NULL;
    size_t size = 0, before = samples->count;
    if (!verify_file_read(path, &bytes, &size, error)) {
        return false;
    }
    bool done;
    if (is_hdf5(bytes, size)) {
        done = verify_sample_hdf5(path, size, samples, error);
    } else if (memchr(bytes, '\0', size) == NULL && !is_xml(bytes)) {
        done = verify_sample_csv(path, bytes, size, samples, error);
    } else if (is_xml(bytes)) {
        done = verify_sample_vtu(path, bytes, size, samples, error);
    } else {
        done =
            solver_fail(error, SOLVER_BAD_INPUT,
                        "%.360s: neither HDF5 (with the judge's schema, or VTKHDF), nor VTU, nor a table (CSV)", path);
    }
    free(bytes);
    for (size_t i = before; done && i < samples->count; i++) {
        done = check_numbers(samples->sample[i], error);
    }
    return done;
}
