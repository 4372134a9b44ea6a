#include "golden/golden.h"

#include <stdio.h>
#include <string.h>

enum { PATH = 4096 };

static bool fail(struct solver_error *error, const char *path, const char *why)
{
    return solver_fail(error, SOLVER_BAD_INPUT, "golden picture %.400s: %.500s", path, why);
}

/* NAME.png -> NAME.KIND.png */
static bool beside(const char *path, const char *kind, char out[PATH])
{
    const size_t length = strlen(path);
    if (length <= 4 || strcmp(path + length - 4, ".png") != 0) {
        return false;
    }
    const int written = snprintf(out, PATH, "%.*s.%s.png", (int)(length - 4), path, kind);
    return written > 0 && written < PATH;
}

bool golden_check_image(const char *stored_path, const struct render_image *fresh, struct render_difference *difference,
                        struct solver_error *error)
{
    char fresh_path[PATH], difference_path[PATH], why[RENDER_WHY] = "";
    struct render_image *stored;
    *difference = (struct render_difference){0};
    if (!beside(stored_path, "fresh", fresh_path) || !beside(stored_path, "difference", difference_path)) {
        return fail(error, stored_path, "expected a name of at most 4000 bytes that ends in .png");
    }
    if (!render_png_read(stored_path, &stored, why)) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "golden picture %.300s: %.400s; `assay golden update SCENE` writes it anew", stored_path,
                           why);
    }
    bool ok = render_compare(stored, fresh, true, difference, why) || fail(error, stored_path, why);
    render_image_free(stored);
    if (ok && difference->same) {
        (void)remove(fresh_path);
        (void)remove(difference_path);
    } else if (ok) {
        ok = (render_png_write(fresh_path, fresh, why) || fail(error, fresh_path, why)) &&
             (render_png_write(difference_path, difference->picture, why) || fail(error, difference_path, why));
    } else {
        (void)render_png_write(fresh_path, fresh, why); /* of another size: worth seeing all the same */
    }
    render_image_free(difference->picture);
    difference->picture = NULL;
    return ok;
}
