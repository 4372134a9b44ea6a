/* golden_spoil FILE.vtkhdf NAME: adds one to the tenth digit of the largest number of a field or of a column of the
 * history. golden_spoil FILE.png mirrored: left and right change places. The files stay whole and sealed, so that only
 * the comparison can notice. Exit code 0 only if the file was changed. */
#include "render/render.h"
#include "solver/record.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Every stride-th of the values; false if all are zero. */
static bool spoil_largest(double *value, size_t count, size_t stride)
{
    double *most = value;
    for (size_t i = 0; i < count; i++) {
        most = fabs(value[i * stride]) > fabs(*most) ? &value[i * stride] : most;
    }
    if (count == 0 || !(fabs(*most) > 0.0)) {
        return false;
    }
    double before = *most;
    *most += pow(10.0, floor(log10(fabs(before))) - 9.0);
    (void)printf("%.17g -> %.17g\n", before, *most);
    return *most != before;
}

static bool spoil_record(const char *path, const char *name)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct solver_record *record = NULL;
    bool spoilt = false;
    if (solver_record_read(path, &record, &error)) {
        for (size_t i = 0; i < record->field_count; i++) {
            const struct solver_record_field *field = &record->field[i];
            if (strcmp(field->name, name) == 0) {
                spoilt = spoil_largest(field->value, record->count * (size_t)field->width, 1);
            }
        }
        for (size_t c = 0; c < record->history_columns; c++) {
            if (strcmp(record->history_name[c], name) == 0) {
                spoilt = spoil_largest(record->history + c, record->history_count, record->history_columns);
            }
        }
        spoilt = spoilt && solver_record_save(path, record, &error);
    }
    if (!spoilt) {
        (void)fprintf(stderr, "%s: %s is not there, or zero: nothing to spoil. %s\n", path, name, error.text);
    }
    solver_record_free(record);
    return spoilt;
}

/* Only the body's rectangle, which is what is compared: the lettering must not give it away. */
static bool mirror_picture(const char *path)
{
    char why[RENDER_WHY] = "";
    struct render_image *image = NULL;
    bool done = render_png_read(path, &image, why);
    for (int y = done ? image->body[1] : 0; done && y < image->body[3]; y++) {
        for (int left = image->body[0], right = image->body[2] - 1; left < right; left++, right--) {
            uint8_t kept[3];
            uint8_t *a = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)left);
            uint8_t *b = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)right);
            memcpy(kept, a, sizeof kept);
            memcpy(a, b, sizeof kept);
            memcpy(b, kept, sizeof kept);
        }
    }
    done = done && render_png_write(path, image, why);
    if (!done) {
        (void)fprintf(stderr, "%s: %s\n", path, why);
    }
    render_image_free(image);
    return done;
}

int main(int count, char **word)
{
    if (count != 3) {
        (void)fprintf(stderr, "usage: golden_spoil FILE.vtkhdf NAME | FILE.png mirrored\n");
        return 2;
    }
    bool picture = strcmp(word[2], "mirrored") == 0;
    return (picture ? mirror_picture(word[1]) : spoil_record(word[1], word[2])) ? 0 : 1;
}
