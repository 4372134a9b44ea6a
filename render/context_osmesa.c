#include "render/context.h"

#include "render/fail.h"

#include <GL/osmesa.h>
#include <fenv.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

struct render_context {
    OSMesaContext mesa;
    uint8_t *pixels;
    fenv_t before; /* the floating-point environment of the program: OSMesa, which divides by zero as it likes, and the
                      threads that it makes have one without traps */
};

/* OSMesa 22.3 writes through null pointers where memory ends. It is asked for nothing that is not there: 12 bytes for a
 * sample (the pixels and its own colour and depth), 64 MiB for what it compiles, and of addresses alone, for each of
 * its threads, of which there are three more than cores, 8 MiB of stack and 64 MiB for malloc. A picture of 1200 x 900
 * pixels took 615 MB of addresses on two cores; 651 are asked for. */
static bool has_room(int width, int height, char why[RENDER_WHY])
{
    static const size_t MiB = 1048576;
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const size_t threads = (size_t)(cores < 1 ? 1 : cores > 16 ? 16 : cores) + 3;
    const size_t filled = 12 * (size_t)width * (size_t)height + 64 * MiB, spanned = 72 * MiB * threads;
    void *data = mmap(NULL, filled, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    void *span = mmap(NULL, spanned, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    const bool fits = data != MAP_FAILED && span != MAP_FAILED;
    if (data != MAP_FAILED)
        (void)munmap(data, filled);
    if (span != MAP_FAILED)
        (void)munmap(span, spanned);
    return fits ||
           render_fail(
               why,
               "no memory for a drawing of %d x %d samples: OSMesa wants %zu MiB and addresses for %zu MiB more; "
               "allow more (ulimit -v), or draw a smaller picture (view.size)",
               width, height, filled / MiB, spanned / MiB);
}

bool render_context_open(int width, int height, struct render_context **context, char why[RENDER_WHY])
{
    static const int wanted[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
    *context = NULL;
    if (!has_room(width, height, why))
        return false;
    struct render_context *made = calloc(1, sizeof *made);
    if (!made)
        return render_fail(why, "no memory for an OpenGL context");
    (void)feholdexcept(&made->before);
    made->pixels = malloc((size_t)width * (size_t)height * 4);
    if (!made->pixels) {
        render_context_close(made);
        return render_fail(why, "no memory for a drawing of %d x %d samples; draw a smaller picture", width, height);
    }
    made->mesa = OSMesaCreateContextAttribs(wanted, NULL);
    if (!made->mesa || !OSMesaMakeCurrent(made->mesa, made->pixels, GL_UNSIGNED_BYTE, width, height)) {
        render_context_close(made);
        return render_fail(why, "OSMesa gives no OpenGL context of %d x %d samples with depth", width, height);
    }
    *context = made;
    return true;
}

const uint8_t *render_context_pixels(struct render_context *context)
{
    glFinish();
    return context->pixels;
}

void render_context_close(struct render_context *context)
{
    if (!context)
        return;
    if (context->mesa)
        OSMesaDestroyContext(context->mesa);
    (void)fesetenv(&context->before);
    free(context->pixels);
    free(context);
}

#ifdef __SANITIZE_ADDRESS__
/* OSMesa 22.3 keeps some hundred bytes of each context it destroys. Only a sanitizing build asks. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa.so\n";
}
#endif
