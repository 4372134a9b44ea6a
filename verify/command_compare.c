#include "verify/commands.h"
#include "verify/compare.h"
#include "verify/files.h"

#include <stdio.h>

bool verify_compare(const char *stored_path, const char *fresh_path, struct render_tolerance tolerance,
                    struct render_image **stored, struct render_difference *difference, bool *same,
                    struct solver_error *error)
{
    struct render_image *fresh = NULL;
    char why[RENDER_WHY] = "";
    *stored = NULL;
    *difference = (struct render_difference){.same = false};
    bool read = render_png_read_any(stored_path, stored, why) && render_png_read_any(fresh_path, &fresh, why);
    if (!read) {
        return solver_fail(error, SOLVER_IO, "%s", why);
    }
    bool done = render_compare(*stored, fresh, true, difference, why) ||
                solver_fail(error, SOLVER_BAD_INPUT, "%.300s beside %.300s: %s", fresh_path, stored_path, why);
    render_image_free(fresh);
    if (done) {
        *same = render_within(difference, tolerance);
        (void)printf("  picture: %.3f %% of the pixels differ visibly, %.1f %% in the worst tile, at (%d, %d)  %s\n",
                     100 * difference->fraction, 100 * difference->worst_tile, difference->tile[0], difference->tile[1],
                     *same ? "PASS" : "FAIL");
    }
    return done;
}

/* Writes the picture of what differs, and never over one of those compared. */
static bool write_difference(const struct verify_options *options, const struct render_image *picture,
                             struct solver_error *error)
{
    char why[RENDER_WHY] = "";
    for (size_t i = 0; i < options->operand_count; i++) {
        if (verify_file_same(options->operand[i], options->picture)) {
            return solver_fail(error, SOLVER_BAD_INPUT, "%s: is one of the pictures compared; choose another -o",
                               options->picture);
        }
    }
    if (!render_png_write(options->picture, picture, why)) {
        return solver_fail(error, SOLVER_IO, "%s", why);
    }
    (void)printf("difference %s\n", options->picture);
    return true;
}

int verify_command_compare(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct render_tolerance tolerance = render_tolerance_default;
    if (options->has_tolerance) {
        tolerance = (struct render_tolerance){options->tolerance[0], options->tolerance[1]};
    }
    struct render_image *stored = NULL;
    struct render_difference difference = {.same = false};
    bool same = false;
    bool done =
        verify_compare(options->operand[1], options->operand[0], tolerance, &stored, &difference, &same, &error) &&
        (options->picture == NULL || write_difference(options, difference.picture, &error));
    render_image_free(difference.picture);
    render_image_free(stored);
    if (!done) {
        return verify_complain(&error);
    }
    return same ? VERIFY_PASSED : VERIFY_FAILED;
}
