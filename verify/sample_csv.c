/* Tables: lines "# time = 2 ms" first, then names with units, then a row of numbers for each point. */
#include "verify/sample.h"
#include "verify/units.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 256 };

/* Where the numbers of a column go. */
struct column {
    char name[VERIFY_SAMPLE_NAME]; /* without component and unit */
    double *first;                 /* of point 0; NULL: a number of the whole table */
    size_t stride;                 /* doubles from point to point */
    double number;                 /* of the whole table */
    const char *unit;              /* NULL: none */
};

struct table {
    struct verify_sample *sample;
    size_t line;                  /* counted from 1 */
    size_t columns, rows, points; /* points: rows read so far */
    struct column column[COLUMNS];
    struct solver_error *error;
};

static char *trimmed(char *text)
{
    while (isspace((unsigned char)*text)) {
        text++;
    }
    size_t length = strlen(text);
    while (length > 0 && isspace((unsigned char)text[length - 1])) {
        text[--length] = '\0';
    }
    if (length >= 2 && text[0] == '"' && text[length - 1] == '"') {
        text[length - 1] = '\0';
        text++;
    }
    return text;
}

/* A number and nothing else. */
static bool parse(const char *text, double *value)
{
    char *end = NULL;
    *value = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*value);
}

/* "# time = 2 ms"; other comments are passed over. */
static bool take_comment(struct table *table, char *line)
{
    char *equals = strchr(line, '='), *name = trimmed(line + 1);
    if (equals == NULL || equals < name) {
        return true;
    }
    *equals = '\0';
    name = trimmed(name);
    char *text = trimmed(equals + 1);
    if (!verify_sample_is_number(name)) {
        return true;
    }
    const char *unit = verify_unit_split(text);
    double value;
    if (!parse(text, &value)) {
        return verify_sample_refuse(table->sample, table->error,
                                    "line %zu: %.40s = %.40s, expected a number and its unit, as in # time = 2e-3 s",
                                    table->line, name, text);
    }
    return verify_sample_number(table->sample, name, value, unit, table->error);
}

/* Index of the component that the name ends with, "_x" or "_yz", cut off; *width is that of the field. */
static int cut_component(char *name, int *width)
{
    size_t length = strlen(name);
    char *under = strrchr(name, '_');
    size_t letters = under != NULL && under != name ? length - (size_t)(under + 1 - name) : 0;
    *width = 1;
    if (letters < 1 || letters > 2) {
        return 0;
    }
    int index = 0;
    for (size_t i = 0; i < letters; i++) {
        int axis = tolower((unsigned char)under[1 + i]) - 'x';
        if (axis < 0 || axis > 2) {
            return 0;
        }
        index = 3 * index + axis;
    }
    *under = '\0';
    *width = letters == 1 ? 3 : 9;
    return index;
}

static struct verify_sample_field *find(struct verify_sample *sample, const char *name)
{
    for (size_t i = 0; i < sample->field_count; i++) {
        if (strcmp(sample->field[i].name, name) == 0) {
            return &sample->field[i];
        }
    }
    return NULL;
}

static bool same_unit(const struct verify_sample_field *field, const char *unit)
{
    return field->has_unit == (unit != NULL) && (unit == NULL || strcmp(field->unit, unit) == 0);
}

static bool add_component(struct table *table, struct column *column, char *name)
{
    struct verify_sample *sample = table->sample;
    int width, index = cut_component(name, &width);
    struct verify_sample_field *field = find(sample, name);
    if (field == NULL) {
        field = verify_sample_add(sample, name, width, table->error);
        if (field == NULL) {
            return false;
        }
        field->given = 0;
        field->has_unit = column->unit != NULL;
        (void)snprintf(field->unit, sizeof field->unit, "%.31s", column->unit != NULL ? column->unit : "");
    } else if (field->width != width || (field->given >> index & 1U) != 0) {
        return verify_sample_refuse(sample, table->error,
                                    "line %zu: columns of field %s are given twice, or as scalar, "
                                    "vector and tensor at once",
                                    table->line, name);
    } else if (!same_unit(field, column->unit)) {
        return verify_sample_refuse(sample, table->error, "line %zu: columns of field %s have different units",
                                    table->line, name);
    }
    field->given |= 1U << index;
    column->first = field->value + index;
    column->stride = (size_t)width;
    return true;
}

/* Axis of a coordinate's name, X, Y or Z; -1 if it is none. */
static int axis_of(const char *name)
{
    int axis = tolower((unsigned char)name[0]) - 'x';
    return axis >= 0 && axis <= 2 && name[1] == '\0' ? axis : -1;
}

static bool add_coordinate(struct table *table, struct column *column, int axis)
{
    struct verify_sample *sample = table->sample;
    bool first = !sample->has_unit && axis == 0;
    if (column->unit == NULL || strlen(column->unit) >= sizeof sample->unit) {
        return verify_sample_refuse(sample, table->error, "line %zu: column %c has no unit; expected %c[m]",
                                    table->line, "XYZ"[axis], "XYZ"[axis]);
    }
    if (!first && strcmp(sample->unit, column->unit) != 0) {
        return verify_sample_refuse(sample, table->error,
                                    "line %zu: coordinates must stand in the order X, Y, Z and have one unit",
                                    table->line);
    }
    (void)snprintf(sample->unit, sizeof sample->unit, "%s", column->unit);
    sample->has_unit = true;
    column->first = sample->X + axis;
    column->stride = 3;
    return true;
}

/* Splits a line at its commas, in place; NULL when there is none left. */
static char *next_cell(char **rest)
{
    char *cell = *rest;
    if (cell != NULL) {
        char *comma = strchr(cell, ',');
        if (comma != NULL) {
            *comma = '\0';
        }
        *rest = comma != NULL ? comma + 1 : NULL;
    }
    return cell;
}

/* Coordinates that the header names: how many, in the order X, Y, Z. */
static int count_coordinates(const char *header)
{
    int dim = 0;
    for (const char *cell = header; cell != NULL; cell = strchr(cell, ',')) {
        cell += *cell == ',' ? 1 : 0;
        cell += strspn(cell, " \t\"");
        int axis = tolower((unsigned char)cell[0]) - 'x';
        bool whole = cell[0] != '\0' && strchr("[, \t\"\r", cell[1]) != NULL;
        dim += axis == dim && whole ? 1 : 0;
    }
    return dim;
}

static bool add_column(struct table *table, char *cell)
{
    if (table->columns == COLUMNS) {
        return verify_sample_refuse(table->sample, table->error, "line %zu: more than %d columns", table->line,
                                    COLUMNS);
    }
    struct column *column = &table->column[table->columns++];
    char *name = trimmed(cell);
    *column = (struct column){.unit = verify_unit_split(name)};
    if (column->unit != NULL && strlen(column->unit) >= VERIFY_SAMPLE_UNIT) {
        return verify_sample_refuse(table->sample, table->error, "line %zu: the unit \"%.60s\" is too long",
                                    table->line, column->unit);
    }
    if (strlen(name) >= sizeof column->name || name[0] == '\0') {
        return verify_sample_refuse(table->sample, table->error,
                                    "line %zu: column %zu has no name of 1 to %d bytes; expected names with units, as "
                                    "in X[m],Y[m],u_x[m]",
                                    table->line, table->columns, VERIFY_SAMPLE_NAME - 1);
    }
    (void)snprintf(column->name, sizeof column->name, "%s", name);
    if (axis_of(name) >= 0) {
        return axis_of(name) < table->sample->dim
                   ? add_coordinate(table, column, axis_of(name))
                   : verify_sample_refuse(table->sample, table->error,
                                          "line %zu: coordinates must stand in the order X, Y, Z", table->line);
    }
    if (verify_sample_is_number(name)) {
        column->stride = 0;
        return true;
    }
    if (verify_sample_is_weight(name)) {
        column->stride = 1;
        bool added = verify_sample_weights(table->sample, table->error);
        column->first = table->sample->weight;
        return added;
    }
    return add_component(table, column, name);
}

static bool take_header(struct table *table, char *line)
{
    int dim = count_coordinates(line);
    if (dim == 0) {
        return verify_sample_refuse(table->sample, table->error,
                                    "line %zu: no column X; expected a header with names and units, as in "
                                    "X[m],Y[m],u_x[m],u_y[m]",
                                    table->line);
    }
    if (!verify_sample_points(table->sample, table->rows, dim, table->error)) {
        return false;
    }
    for (char *rest = line, *cell; (cell = next_cell(&rest)) != NULL;) {
        if (!add_column(table, cell)) {
            return false;
        }
    }
    return true;
}

static bool take_number(struct table *table, struct column *column, double value)
{
    if (column->first != NULL) {
        column->first[table->points * column->stride] = value;
        return true;
    }
    if (table->points > 0 && value != column->number) {
        return verify_sample_refuse(table->sample, table->error,
                                    "line %zu: column %s has %.17g, and %.17g above; expected one value in all rows",
                                    table->line, column->name, value, column->number);
    }
    column->number = value;
    return table->points > 0 || verify_sample_number(table->sample, column->name, value, column->unit, table->error);
}

static bool take_row(struct table *table, char *line)
{
    size_t at = 0;
    for (char *rest = line, *cell; (cell = next_cell(&rest)) != NULL; at++) {
        double value = NAN;
        if (at == table->columns) {
            return verify_sample_refuse(table->sample, table->error, "line %zu: more than the %zu values of the header",
                                        table->line, table->columns);
        }
        cell = trimmed(cell);
        if (!parse(cell, &value)) {
            return verify_sample_refuse(table->sample, table->error,
                                        "line %zu: column %s: \"%.40s\", expected a finite number", table->line,
                                        table->column[at].name, cell);
        }
        if (!take_number(table, &table->column[at], value)) {
            return false;
        }
    }
    table->points++;
    return at == table->columns ||
           verify_sample_refuse(table->sample, table->error, "line %zu: %zu values, expected %zu", table->line, at,
                                table->columns);
}

static bool take_line(struct table *table, char *line)
{
    if (line[strspn(line, " \t\r")] == '\0') {
        return true;
    }
    if (line[0] == '#') {
        return take_comment(table, line);
    }
    return table->columns == 0 ? take_header(table, line) : take_row(table, line);
}

/* Lines that are neither empty nor comments. */
static size_t count_lines(const char *text)
{
    size_t count = 0;
    for (const char *line = text; *line != '\0';) {
        size_t length = strcspn(line, "\n");
        size_t blank = strspn(line, " \t\r");
        count += blank < length && line[0] != '#';
        line += length + (line[length] == '\n' ? 1 : 0);
    }
    return count;
}

static bool read_lines(struct table *table, char *text)
{
    text += strncmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    size_t lines = count_lines(text);
    if (lines < 2) {
        return verify_sample_refuse(table->sample, table->error,
                                    "neither HDF5 nor XML, nor a table with a header such as X[m],u_x[m] and a row for "
                                    "each point");
    }
    table->rows = lines - 1;
    while (*text != '\0') {
        size_t length = strcspn(text, "\n");
        bool last = text[length] == '\0';
        text[length] = '\0';
        table->line++;
        if (!take_line(table, text)) {
            return false;
        }
        text += length + (last ? 0 : 1);
    }
    return true;
}

bool verify_sample_csv(const char *path, char *bytes, size_t size, struct verify_samples *samples,
                       struct solver_error *error)
{
    (void)size;
    struct table *table = calloc(1, sizeof *table);
    if (table == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%.360s: no memory to read a table", path);
    }
    *table = (struct table){.error = error, .sample = verify_samples_add(samples, path, error)};
    bool done = table->sample != NULL;
    if (done) {
        table->sample->needs_units = true;
        done = read_lines(table, bytes);
    }
    free(table);
    return done;
}
