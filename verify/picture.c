#include "verify/picture.h"

#include "solver/scheme.h"
#include "verify/files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct solver_view corner_view = {
    .field = "pressure", .direction = {1, 0.8, 0.6}, .up = {0, 0, 1}, .magnify = 1, .size = {900, 700}};

/* What the colour bar calls a field. */
static const char *label_of(const char *field)
{
    static const char *const table[][2] = {
        {"pressure", "mean stress"}, {"von_mises", "von Mises stress"}, {"plastic_strain", "plastic strain"}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (strcmp(field, table[i][0]) == 0) {
            return table[i][1];
        }
    }
    return field;
}

/* A scalar of a record: a field of one column, the size of a vector by its name, or a component as NAME_x or NAME_xy.
 * Gives the first column and how many count. */
static const struct solver_record_field *find_scalar(const struct solver_record *record, const char *name, int *first,
                                                     int *columns)
{
    const struct solver_record_field *field = solver_record_find(record, name);
    *first = 0;
    *columns = field != NULL ? field->width : 0;
    const char *underscore = strrchr(name, '_');
    if (field != NULL || underscore == NULL) {
        return field != NULL && field->width <= 3 ? field : NULL;
    }
    char stem[SOLVER_NAME];
    (void)snprintf(stem, sizeof stem, "%.*s", (int)(underscore - name), name);
    field = solver_record_find(record, stem);
    size_t letters = strlen(underscore + 1);
    if (field == NULL || strspn(underscore + 1, "xyz") != letters || (letters == 1 && field->width != 3) ||
        (letters == 2 && field->width != 9) || letters < 1 || letters > 2) {
        return NULL;
    }
    *columns = 1;
    *first = underscore[1] - 'x';
    if (letters == 2) {
        *first = 3 * *first + (underscore[2] - 'x');
    }
    return field;
}

/* Always false. */
static bool refuse_field(const struct solver_record *record, const char *name, struct solver_error *error)
{
    char has[SOLVER_TEXT] = "";
    for (size_t i = 0, used = 0; i < record->field_count && used < sizeof has; i++) {
        used += (size_t)snprintf(has + used, sizeof has - used, "%s%s", i > 0 ? ", " : "", record->field[i].name);
    }
    return solver_fail(error, SOLVER_BAD_INPUT,
                       "view.field: the record has no scalar \"%s\"; its fields are %s, and a vector's or tensor's "
                       "components are scalars, as in displacement_x, sigma_xy",
                       name, has);
}

static bool read_scalar(const struct solver_record *record, const char *name, double *scalar, const char **unit,
                        struct solver_error *error)
{
    int first = 0, columns = 0;
    const struct solver_record_field *field = find_scalar(record, name, &first, &columns);
    if (field == NULL) {
        return refuse_field(record, name, error);
    }
    *unit = field->unit;
    for (size_t a = 0; a < record->count; a++) {
        const double *value = field->value + a * (size_t)field->width + first;
        scalar[a] = columns == 1 ? value[0] : sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]);
    }
    return true;
}

bool verify_picture_check(const struct solver_scene *scene, struct solver_error *error)
{
    if (!scene->has_view) {
        return true;
    }
    static double any[1]; /* a record of no particles reads nothing of it */
    static uint32_t number[1];
    const struct solver_scheme *scheme = solver_scheme_find(scene->scheme);
    double *deformation = scheme != NULL && scheme->deformation ? any : NULL;
    const struct solver_cloud cloud = {
        .dim = scene->dim, .X = any, .tags = number, .body = scene->shape_count > 0 ? number : NULL};
    const struct solver_output output = {.cloud = &cloud,
                                         .V = any,
                                         .u = any,
                                         .v = any,
                                         .p = any,
                                         .F = deformation,
                                         .H = deformation,
                                         .J = any,
                                         .P = deformation,
                                         .sigma = any,
                                         .pressure = any,
                                         .von_mises = any,
                                         .plastic_strain = solver_scene_flows(scene) ? any : NULL};
    struct solver_record *record = NULL;
    int first = 0, columns = 0;
    if (!solver_record_make(scene, &output, NULL, "", "", &record, error)) {
        return false;
    }
    bool known = find_scalar(record, scene->view.field, &first, &columns) != NULL ||
                 refuse_field(record, scene->view.field, error);
    solver_record_free(record);
    return known;
}

static bool place(const struct solver_record *record, double magnify, double *position, struct solver_error *error)
{
    const struct solver_record_field *displacement = solver_record_find(record, "displacement");
    if (displacement == NULL || displacement->width != 3) {
        return solver_fail(error, SOLVER_BAD_INPUT, "the record has no field \"displacement\" of width 3");
    }
    for (size_t i = 0; i < 3 * record->count; i++) {
        position[i] = record->X[i] + magnify * displacement->value[i];
    }
    return true;
}

static void bounds(const double *point, size_t count, double lower[3], double upper[3])
{
    for (size_t i = 0; i < 3; i++) {
        lower[i] = INFINITY;
        upper[i] = -INFINITY;
    }
    for (size_t i = 0; i < 3 * count; i++) {
        lower[i % 3] = fmin(lower[i % 3], point[i]);
        upper[i % 3] = fmax(upper[i % 3], point[i]);
    }
}

/* The body's reference bounding box with room around it: a tenth of its largest edge, doubled until the deformed body
 * is inside. */
static void frame_of(const struct solver_record *record, const double *position, double frame[6])
{
    double lower[3], upper[3], seen_lower[3], seen_upper[3], edge = 0, room = 0;
    bounds(record->X, record->count, lower, upper);
    bounds(position, record->count, seen_lower, seen_upper);
    for (int i = 0; i < 3; i++) {
        edge = fmax(edge, upper[i] - lower[i]);
        room = fmax(room, fmax(lower[i] - seen_lower[i], seen_upper[i] - upper[i]));
    }
    double grown = 0.1 * edge;
    while (grown < room && isfinite(room)) {
        grown *= 2;
    }
    for (int i = 0; i < 3; i++) {
        double growth = i < record->dim ? grown : 0;
        frame[2 * i] = lower[i] - growth;
        frame[2 * i + 1] = upper[i] + growth;
    }
}

/* From the smallest to the largest value. */
static void full_range(const double *scalar, size_t count, double range[2])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (size_t a = 0; a < count; a++) {
        range[0] = fmin(range[0], scalar[a]);
        range[1] = fmax(range[1], scalar[a]);
    }
}

bool verify_picture_view(const struct solver_record *record, const struct solver_view *view, struct solver_view *whole,
                         struct solver_error *error)
{
    const char *unit;
    double *scalar = calloc(record->count + 1, sizeof *scalar);
    if (scalar == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the picture of %zu particles", record->count);
    }
    struct solver_view chosen = view != NULL ? *view : corner_view;
    if (view == NULL && record->dim < 3) { /* face on */
        memcpy(chosen.direction, (double[3]){0, 0, 1}, sizeof chosen.direction);
        memcpy(chosen.up, (double[3]){0, 1, 0}, sizeof chosen.up);
    }
    bool done = read_scalar(record, chosen.field, scalar, &unit, error);
    if (done) {
        double seen[2];
        full_range(scalar, record->count, seen);
        verify_picture_scale(seen, chosen.range, &chosen.bands);
        *whole = chosen;
    }
    free(scalar);
    return done;
}

static bool draw_surface(const struct solver_record *record, const struct solver_view *view, const char *title,
                         const double *position, const double *scalar, const char *unit, struct render_image **image,
                         struct solver_error *error)
{
    uint32_t(*quad)[4] = NULL;
    size_t quads = 0;
    if (!verify_surface(record->cell, record->cell_count, record->cell_width, &quad, &quads)) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the surface of %zu cells", record->cell_count);
    }
    const struct render_surface surface = {record->count, position, scalar, quads, (const uint32_t *)quad};
    struct render_view shown = {.bands = view->bands,
                                .width = view->size[0],
                                .height = view->size[1],
                                .title = title,
                                .label = label_of(view->field),
                                .unit = unit};
    memcpy(shown.direction, view->direction, sizeof shown.direction);
    memcpy(shown.up, view->up, sizeof shown.up);
    memcpy(shown.range, view->range, sizeof shown.range);
    frame_of(record, position, shown.frame);
    for (int i = 0; i < 6; i++) {
        if (view->frame[i] != 0) {
            memcpy(shown.frame, view->frame, sizeof shown.frame);
        }
    }
    char why[RENDER_WHY] = "";
    bool drawn = render_draw(&surface, &shown, image, why);
    free(quad);
    return drawn || solver_fail(error, SOLVER_BAD_INPUT, "the picture cannot be drawn: %s", why);
}

/* As a paper has it: 8e-05 as 8 x 10^-5. */
static void spell_time(double t, char out[48])
{
    char number[32];
    (void)snprintf(number, sizeof number, "%.6g", t);
    const char *power = strchr(number, 'e');
    if (power == NULL) {
        (void)snprintf(out, 48, "%s", number);
    } else {
        (void)snprintf(out, 48, "%.*s \u00d7 10^%ld", (int)(power - number), number, strtol(power + 1, NULL, 10));
    }
}

bool verify_picture_draw(const struct solver_record *record, const struct solver_view *view, const char *title,
                         struct render_image **image, struct solver_error *error)
{
    const char *unit = "";
    char full_title[SOLVER_TEXT + 128];
    char magnified[64] = "";
    char time[48];
    struct solver_view used = corner_view;
    if (!verify_picture_view(record, view, &used, error)) {
        return false;
    }
    if (used.magnify != 1.0) {
        (void)snprintf(magnified, sizeof magnified, ", displacement \u00d7 %g", used.magnify);
    }
    spell_time(record->time, time);
    (void)snprintf(full_title, sizeof full_title, "%s, t = %s s%s", title, time, magnified);
    double *position = calloc(record->count, 4 * sizeof *position);
    if (position == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the picture of %zu particles", record->count);
    }
    double *scalar = position + 3 * record->count;
    bool done = place(record, used.magnify, position, error) && read_scalar(record, used.field, scalar, &unit, error) &&
                draw_surface(record, &used, full_title, position, scalar, unit, image, error);
    free(position);
    return done;
}

bool verify_picture_write(const char *path, const struct solver_record *record, const struct solver_view *view,
                          const char *title, const char *kept, struct solver_error *error)
{
    struct render_image *image = NULL;
    char why[RENDER_WHY] = "";
    bool done = verify_picture_draw(record, view, title, &image, error) &&
                (render_png_write(path, image, why) || solver_fail(error, SOLVER_IO, "%s", why));
    render_image_free(image);
    if (!done && kept != NULL) {
        size_t used = strlen(error->text);
        (void)snprintf(error->text + used, sizeof error->text - used, "; the record is in %.400s, for assay render",
                       kept);
    }
    return done;
}
