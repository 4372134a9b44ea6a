/* Pictures on disk: PNG, 8 bits red, green and blue, with the body rectangle in a text chunk. */
#include "render/fail.h"
#include "render/image.h"

#include <errno.h>
#include <fcntl.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char body_key[] = "assay body rectangle";

/* What libpng said last; its messages are kept because it leaves by longjmp. */
struct complaint {
    char text[200];
};

static void note_error(png_structp png, png_const_charp message)
{
    struct complaint *complaint = png_get_error_ptr(png);
    snprintf(complaint->text, sizeof complaint->text, "%s", message);
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* Between setjmp and longjmp no local variable changes: libpng's state lives in these two pointers only. */
static bool write_stream(FILE *file, const struct render_image *image, struct complaint *complaint)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, complaint, note_error, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_write_struct(&png, NULL);
        snprintf(complaint->text, sizeof complaint->text, "no memory");
        return false;
    }
    char key[sizeof body_key], rectangle[64];
    memcpy(key, body_key, sizeof key);
    const int *b = image->body;
    snprintf(rectangle, sizeof rectangle, "%d %d %d %d", b[0], b[1], b[2], b[3]);
    png_text text = {.compression = PNG_TEXT_COMPRESSION_NONE, .key = key, .text = rectangle};
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(png, info, &text, 1);
    png_write_info(png, info);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, image->rgb + (size_t)y * (size_t)image->width * 3);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return true;
}

bool render_png_write(const char *path, const struct render_image *image, char why[RENDER_WHY])
{
    char beside[4096];
    const int length = snprintf(beside, sizeof beside, "%s.%ld.partial", path, (long)getpid());
    if (length < 0 || (size_t)length >= sizeof beside)
        return render_fail(why, "picture: the path of %d characters is too long", length);
    const int descriptor = open(beside, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "wb");
    if (!file) {
        render_fail(why, "%s: cannot be written: %s", path, strerror(errno));
        if (descriptor >= 0)
            close(descriptor);
        return false;
    }
    struct complaint complaint = {""};
    errno = 0;
    bool fine = write_stream(file, image, &complaint) && fflush(file) == 0 && fsync(descriptor) == 0;
    const int cause = errno;
    if (!fine)
        render_fail(why, "%s: cannot be written: %s%s%s", path, complaint.text, *complaint.text && cause ? ", " : "",
                    cause ? strerror(cause) : "");
    if (fclose(file) != 0 && fine)
        fine = render_fail(why, "%s: cannot be written: %s", path, strerror(errno));
    if (fine && rename(beside, path) != 0)
        fine = render_fail(why, "%s: cannot be put in place: %s", path, strerror(errno));
    if (!fine)
        unlink(beside);
    return fine;
}

static bool parse_rectangle(const char *text, int width, int height, int body[4])
{
    for (int i = 0; i < 4; i++) {
        char *end;
        const long number = strtol(text, &end, 10);
        if (end == text || *end != (i < 3 ? ' ' : '\0') || number < 0 || number > RENDER_MOST)
            return false;
        body[i] = (int)number;
        text = end;
    }
    return body[0] < body[2] && body[1] < body[3] && body[2] <= width && body[3] <= height;
}

static void find_rectangle(png_structp png, png_infop info, struct render_image *image)
{
    png_textp text = NULL;
    const int count = png_get_text(png, info, &text, NULL);
    for (int i = 0; i < count; i++)
        if (strcmp(text[i].key, body_key) == 0)
            if (parse_rectangle(text[i].text, image->width, image->height, image->body))
                return;
    png_error(png, "it holds no body rectangle; it was not drawn by this program");
}

/* Everything that libpng may leave by longjmp. *image is the caller's, who frees it. */
static void read_stream(png_structp png, png_infop info, FILE *file, struct render_image **image)
{
    png_init_io(png, file);
    png_set_user_limits(png, RENDER_MOST, RENDER_MOST);
    png_set_chunk_malloc_max(png, 1 << 16);
    png_set_chunk_cache_max(png, 16);
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(png, info);
    const int width = (int)png_get_image_width(png, info), height = (int)png_get_image_height(png, info);
    if (png_get_bit_depth(png, info) != 8 || png_get_color_type(png, info) != PNG_COLOR_TYPE_RGB ||
        png_get_interlace_type(png, info) != PNG_INTERLACE_NONE)
        png_error(png, "expected 8 bits each of red, green and blue, not interlaced, as this program writes them");
    *image = render_image_create(width, height);
    if (!*image)
        png_error(png, "no memory for its pixels");
    find_rectangle(png, info, *image);
    for (int y = 0; y < height; y++)
        png_read_row(png, (*image)->rgb + (size_t)y * (size_t)width * 3, NULL);
    png_read_end(png, NULL);
}

static bool read_guarded(FILE *file, struct render_image **image, struct complaint *complaint)
{
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, complaint, note_error, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_read_struct(&png, NULL, NULL);
        snprintf(complaint->text, sizeof complaint->text, "no memory");
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, NULL);
        return false;
    }
    read_stream(png, info, file, image);
    png_destroy_read_struct(&png, &info, NULL);
    return true;
}

static FILE *open_picture(const char *path, char why[RENDER_WHY])
{
    FILE *file = fopen(path, "rb");
    struct stat status;
    if (!file) {
        render_fail(why, "%s: cannot be read: %s", path, strerror(errno));
    } else if (fstat(fileno(file), &status) != 0 || !S_ISREG(status.st_mode)) {
        render_fail(why, "%s: not a regular file; expected a PNG picture", path);
        (void)fclose(file);
        file = NULL;
    }
    return file;
}

bool render_png_read(const char *path, struct render_image **image, char why[RENDER_WHY])
{
    *image = NULL;
    FILE *file = open_picture(path, why);
    if (!file)
        return false;
    struct complaint complaint = {""};
    const bool fine = read_guarded(file, image, &complaint);
    (void)fclose(file);
    if (fine)
        return true;
    render_image_free(*image);
    *image = NULL;
    return render_fail(why, "%s: not a whole PNG picture of this program: %s", path, complaint.text);
}

/* libpng's own conversion; it frees what it holds on every failure. */
static bool read_foreign(FILE *file, png_imagep png, struct render_image **image)
{
    if (!png_image_begin_read_from_stdio(png, file))
        return false;
    if (png->width <= RENDER_MOST && png->height <= RENDER_MOST)
        *image = render_image_create((int)png->width, (int)png->height);
    if (!*image) {
        png_image_free(png);
        snprintf(png->message, sizeof png->message, "expected at most %d pixels a side, and memory for them",
                 RENDER_MOST);
        return false;
    }
    (*image)->body[2] = (*image)->width;
    (*image)->body[3] = (*image)->height;
    const png_color white = {255, 255, 255};
    png->format = PNG_FORMAT_RGB;
    return png_image_finish_read(png, &white, (*image)->rgb, 0, NULL) && PNG_IMAGE_FAILED(*png) == 0;
}

bool render_png_read_any(const char *path, struct render_image **image, char why[RENDER_WHY])
{
    if (render_png_read(path, image, why))
        return true;
    FILE *file = open_picture(path, why);
    if (!file)
        return false;
    png_image png = {.version = PNG_IMAGE_VERSION};
    const bool fine = read_foreign(file, &png, image);
    (void)fclose(file);
    if (fine)
        return true;
    render_image_free(*image);
    *image = NULL;
    return render_fail(why, "%s: not a whole PNG picture: %s", path, png.message);
}
