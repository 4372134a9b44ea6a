/* Pictures on disk: they return as they were, and damaged or foreign files are refused. */
#include "render/image.h"
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"

#include <dirent.h>
#include <png.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[SCRATCH];

static const char *in_folder(const char *name)
{
    static char path[2][SCRATCH_BELOW];
    static int turn;
    turn = !turn;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static struct render_image *sample(void)
{
    struct render_image *image = render_image_create(40, 30);
    if (!image)
        abort();
    const int body[4] = {2, 3, 37, 28};
    memcpy(image->body, body, sizeof body);
    uint32_t state = 1; /* a linear congruential generator: what does not compress makes a long file */
    for (int i = 0; i < 40 * 30 * 3; i++) {
        state = 1664525 * state + 1013904223;
        image->rgb[i] = (uint8_t)(state >> 24);
    }
    return image;
}

static int files_in_folder(void)
{
    DIR *directory = opendir(folder);
    int count = 0;
    while (directory && readdir(directory))
        count++;
    if (directory)
        closedir(directory);
    return count - 2; /* . and .. */
}

static void returns_as_it_was(void)
{
    struct render_image *image = sample(), *back = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_TRUE_FATAL(render_png_write(in_folder("a.png"), image, why));
    CU_ASSERT_EQUAL(files_in_folder(), 1); /* nothing left beside it */
    CU_ASSERT_TRUE_FATAL(render_png_read(in_folder("a.png"), &back, why));
    CU_ASSERT_EQUAL(back->width, 40);
    CU_ASSERT_EQUAL(back->height, 30);
    CU_ASSERT_EQUAL(memcmp(back->body, image->body, sizeof image->body), 0);
    CU_ASSERT_EQUAL(memcmp(back->rgb, image->rgb, 40 * 30 * 3), 0);
    render_image_free(back);
    render_image_free(image);
}

static void refuses(const char *name, const char *expected)
{
    struct render_image *image = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_FALSE(render_png_read(in_folder(name), &image, why));
    CU_ASSERT_PTR_NULL(image);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, name));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, expected));
    if (!strstr(why, expected))
        fprintf(stderr, "%s: %s\n", name, why);
}

static void put(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(in_folder(name), "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0)
        abort();
}

static size_t take(const char *name, uint8_t *bytes, size_t most)
{
    FILE *file = fopen(in_folder(name), "rb");
    if (!file)
        abort();
    const size_t size = fread(bytes, 1, most, file);
    fclose(file);
    return size;
}

/* Cut short anywhere, or a bit turned anywhere: refused. Both ends byte by byte, the pixels between at a stride. */
static void damage_is_refused(void)
{
    static uint8_t bytes[1 << 16];
    struct render_image *truth = sample();
    char why[RENDER_WHY];
    CU_ASSERT_TRUE_FATAL(render_png_write(in_folder("b.png"), truth, why));
    const size_t size = take("b.png", bytes, sizeof bytes);
    CU_ASSERT_TRUE_FATAL(size > 1000 && size < sizeof bytes);
    for (size_t cut = 0; cut < size; cut += cut < 200 || cut + 40 > size ? 1 : 37) {
        put("cut.png", bytes, cut);
        refuses("cut.png", "not a whole PNG");
    }
    for (size_t at = 0; at < size; at += at < 200 || at + 40 > size ? 1 : 37) {
        bytes[at] ^= 0x40;
        put("spoilt.png", bytes, size);
        refuses("spoilt.png", "not a whole PNG");
        bytes[at] ^= 0x40;
    }
    render_image_free(truth);
}

/* A valid PNG of another kind, written with libpng directly. */
static void foreign(const char *name, int width, int height, int type, int depth, const char *rectangle)
{
    FILE *file = fopen(in_folder(name), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    if (!file || !info || setjmp(png_jmpbuf(png)))
        abort();
    png_init_io(png, file);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, depth, type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    char key[] = "assay body rectangle", value[128];
    snprintf(value, sizeof value, "%s", rectangle ? rectangle : "");
    png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = key, .text = value};
    if (rectangle)
        png_set_text(png, info, &text, 1);
    png_write_info(png, info);
    uint8_t *row = calloc((size_t)width, 8);
    if (!row)
        abort();
    for (int y = 0; y < height; y++)
        png_write_row(png, row);
    free(row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

static void foreign_pictures_are_refused(void)
{
    foreign("plain.png", 20, 20, PNG_COLOR_TYPE_RGB, 8, NULL);
    refuses("plain.png", "no body rectangle");
    foreign("grey.png", 20, 20, PNG_COLOR_TYPE_GRAY, 8, "0 0 5 5");
    refuses("grey.png", "8 bits each");
    foreign("deep.png", 20, 20, PNG_COLOR_TYPE_RGB, 16, "0 0 5 5");
    refuses("deep.png", "8 bits each");
    foreign("alpha.png", 20, 20, PNG_COLOR_TYPE_RGB_ALPHA, 8, "0 0 5 5");
    refuses("alpha.png", "8 bits each");
    foreign("wide.png", RENDER_MOST + 1, 2, PNG_COLOR_TYPE_RGB, 8, "0 0 2 2");
    refuses("wide.png", "not a whole PNG");
    static const char *const wrong[] = {"0 0 21 5", "0 0 5 21", "-1 0 5 5", "5 0 5 5",       "0 6 5 5",
                                        "0 0 5",    "0 0 5 5x", "",         "9999999 0 5 5", "a b c d"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        foreign("rectangle.png", 20, 20, PNG_COLOR_TYPE_RGB, 8, wrong[i]);
        refuses("rectangle.png", "no body rectangle");
    }
    put("text.png", "not a picture", 13);
    refuses("text.png", "not a whole PNG");
    mkdir(in_folder("folder.png"), 0777);
    refuses("folder.png", "not a regular file");
    refuses("absent.png", "No such file");
}

/* Reads any PNG, of which every byte of every pixel and the rectangle are then checked. */
static void taken(const char *name, uint8_t level)
{
    struct render_image *image = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_TRUE_FATAL(render_png_read_any(in_folder(name), &image, why));
    const int whole[4] = {0, 0, 20, 12};
    CU_ASSERT_TRUE_FATAL(image->width == 20 && image->height == 12);
    CU_ASSERT_EQUAL(memcmp(image->body, whole, sizeof whole), 0);
    int wrong = 0;
    for (int i = 0; i < 3 * 20 * 12; i++)
        wrong += image->rgb[i] != level;
    CU_ASSERT_EQUAL(wrong, 0);
    render_image_free(image);
}

static void any_picture_can_be_taken(void)
{
    foreign("plain.png", 20, 12, PNG_COLOR_TYPE_RGB, 8, NULL);
    taken("plain.png", 0);
    foreign("grey.png", 20, 12, PNG_COLOR_TYPE_GRAY, 8, NULL);
    taken("grey.png", 0);
    foreign("deep.png", 20, 12, PNG_COLOR_TYPE_RGB, 16, NULL);
    taken("deep.png", 0);
    foreign("clear.png", 20, 12, PNG_COLOR_TYPE_RGB_ALPHA, 8, NULL);
    taken("clear.png", 255); /* nothing but transparent pixels: the white behind them */
    struct render_image *own = sample(), *back = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_TRUE_FATAL(render_png_write(in_folder("own.png"), own, why));
    CU_ASSERT_TRUE_FATAL(render_png_read_any(in_folder("own.png"), &back, why));
    CU_ASSERT_EQUAL(memcmp(back->body, own->body, sizeof own->body), 0);
    CU_ASSERT_EQUAL(memcmp(back->rgb, own->rgb, 40 * 30 * 3), 0);
    render_image_free(own);
    render_image_free(back);
}

static void not_any_picture(const char *name, const char *expected)
{
    struct render_image *image = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_FALSE(render_png_read_any(in_folder(name), &image, why));
    CU_ASSERT_PTR_NULL(image);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, name));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, expected));
}

static void what_is_no_picture_is_refused(void)
{
    static uint8_t bytes[1 << 16];
    put("text.png", "not a picture", 13);
    not_any_picture("text.png", "not a whole PNG");
    put("empty.png", "", 0);
    not_any_picture("empty.png", "not a whole PNG");
    foreign("wide.png", RENDER_MOST + 1, 2, PNG_COLOR_TYPE_RGB, 8, NULL);
    not_any_picture("wide.png", "4096 pixels a side");
    foreign("whole.png", 20, 12, PNG_COLOR_TYPE_GRAY, 16, NULL);
    const size_t size = take("whole.png", bytes, sizeof bytes);
    for (size_t cut = 0; cut + 12 < size; cut++) { /* the last 12 bytes say no more than that it ends */
        put("cut.png", bytes, cut);
        not_any_picture("cut.png", "not a whole PNG");
    }
    not_any_picture("absent.png", "No such file");
}

static void failed_writing_leaves_nothing_behind(void)
{
    struct render_image *image = sample();
    char why[RENDER_WHY] = "";
    CU_ASSERT_FALSE(render_png_write(in_folder("no/such/folder.png"), image, why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, "No such file"));
    mkdir(in_folder("taken.png"), 0777);
    const int before = files_in_folder();
    CU_ASSERT_FALSE(render_png_write(in_folder("taken.png"), image, why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, "taken.png"));
    CU_ASSERT_EQUAL(files_in_folder(), before);
    char endless[8192];
    memset(endless, 'x', sizeof endless - 1);
    endless[sizeof endless - 1] = '\0';
    CU_ASSERT_FALSE(render_png_write(endless, image, why));
    CU_ASSERT_PTR_NOT_NULL(strstr(why, "too long"));
    render_image_free(image);
}

/* As on a full disk: no file may grow beyond 500 bytes. */
static void a_full_disk_leaves_the_old_file(void)
{
    struct render_image *image = sample(), *back = NULL;
    char why[RENDER_WHY] = "";
    CU_ASSERT_TRUE_FATAL(render_png_write(in_folder("old.png"), image, why));
    const int before = files_in_folder();
    struct rlimit limit, small;
    getrlimit(RLIMIT_FSIZE, &limit);
    small = limit;
    small.rlim_cur = 500;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    image->rgb[0] ^= 1;
    const bool written = render_png_write(in_folder("old.png"), image, why);
    setrlimit(RLIMIT_FSIZE, &limit);
    CU_ASSERT_FALSE(written);
    CU_ASSERT_PTR_NOT_NULL(strstr(why, "too large"));
    CU_ASSERT_EQUAL(files_in_folder(), before);
    CU_ASSERT_TRUE_FATAL(render_png_read(in_folder("old.png"), &back, why));
    image->rgb[0] ^= 1;
    CU_ASSERT_EQUAL(memcmp(back->rgb, image->rgb, 40 * 30 * 3), 0);
    render_image_free(back);
    render_image_free(image);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a picture returns as it was", returns_as_it_was},
        {"damage is refused", damage_is_refused},
        {"foreign pictures are refused", foreign_pictures_are_refused},
        {"any picture can be taken", any_picture_can_be_taken},
        {"what is no picture is refused", what_is_no_picture_is_refused},
        {"failed writing leaves nothing behind", failed_writing_leaves_nothing_behind},
        {"a full disk leaves the old file", a_full_disk_leaves_the_old_file},
    };
    scratch_folder(folder);
    const int result = unit_main("render png", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    return result;
}
