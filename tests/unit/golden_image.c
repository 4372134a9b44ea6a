/* A picture that differs leaves the fresh one and the difference beside the stored one; one that agrees leaves
 * nothing. */
#include "golden/golden.h"
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 160, HEIGHT = 120 };

static char folder[SCRATCH];
static char stored[SCRATCH_BELOW], fresh[SCRATCH_BELOW], difference[SCRATCH_BELOW];

/* Two plain halves, with a square of another colour where `hole` says so. */
static struct render_image *picture(int width, bool hole)
{
    struct render_image *image = calloc(1, sizeof *image);
    CU_ASSERT_FATAL(image != NULL);
    *image = (struct render_image){.width = width, .height = HEIGHT, .body = {10, 10, 150, 110}};
    image->rgb = malloc((size_t)width * HEIGHT * 3);
    CU_ASSERT_FATAL(image->rgb != NULL);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < width; x++) {
            uint8_t *at = image->rgb + 3 * ((size_t)y * (size_t)width + (size_t)x);
            const bool in_hole = hole && x >= 60 && x < 84 && y >= 40 && y < 64;
            at[0] = in_hole ? 255 : 40;
            at[1] = in_hole ? 255 : x < width / 2 ? 80 : 160;
            at[2] = in_hole ? 255 : 120;
        }
    }
    return image;
}

static bool exists(const char *path)
{
    return access(path, F_OK) == 0;
}

static bool check(bool hole, int width, struct render_difference *found, struct solver_error *error)
{
    struct render_image *image = picture(width, hole);
    *error = (struct solver_error){.text = ""};
    bool ok = golden_check_image(stored, image, found, error);
    CU_ASSERT(found->picture == NULL);
    render_image_free(image);
    return ok;
}

static void agreement_and_difference(void)
{
    struct render_difference found;
    struct solver_error error;
    char why[RENDER_WHY];
    CU_ASSERT_FALSE(check(false, WIDTH, &found, &error));
    CU_ASSERT(strstr(error.text, stored) != NULL && strstr(error.text, "assay golden update") != NULL);
    struct render_image *image = picture(WIDTH, false);
    CU_ASSERT_FATAL(render_png_write(stored, image, why));
    render_image_free(image);
    CU_ASSERT(check(false, WIDTH, &found, &error) && found.same);
    CU_ASSERT(!exists(fresh) && !exists(difference));
    CU_ASSERT(check(true, WIDTH, &found, &error) && !found.same);
    struct render_image *written = NULL;
    CU_ASSERT(render_png_read(fresh, &written, why) && written->width == WIDTH);
    render_image_free(written);
    CU_ASSERT(render_png_read(difference, &written, why) && written->width == WIDTH && written->height == HEIGHT);
    render_image_free(written);
    CU_ASSERT(check(false, WIDTH, &found, &error) && found.same);
    CU_ASSERT(!exists(fresh) && !exists(difference));         /* the failure is mended: its pictures go */
    CU_ASSERT_FALSE(check(false, WIDTH + 1, &found, &error)); /* another size */
    CU_ASSERT(strstr(error.text, stored) != NULL);
}

static void names_refused(void)
{
    struct render_difference found;
    struct solver_error error = {.text = ""};
    struct render_image *image = picture(WIDTH, false);
    CU_ASSERT_FALSE(golden_check_image("picture", image, &found, &error));
    CU_ASSERT(strstr(error.text, ".png") != NULL);
    render_image_free(image);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"agreement and difference", agreement_and_difference},
        {"names refused", names_refused},
    };
    scratch_folder(folder);
    (void)snprintf(stored, sizeof stored, "%s/body.png", folder);
    (void)snprintf(fresh, sizeof fresh, "%s/body.fresh.png", folder);
    (void)snprintf(difference, sizeof difference, "%s/body.difference.png", folder);
    int result = unit_main("golden picture", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    return result;
}
