#include "render/context.h"

#include "render/fail.h"

#include <GL/osmesa.h>
#include <fenv.h>
#include <stdlib.h>

struct render_context {
    OSMesaContext mesa;
    uint8_t *pixels;
    fenv_t before; /* the floating-point environment of the program: OSMesa, which divides by zero as it likes, and the
                      threads that it makes have one without traps */
};

bool render_context_open(int width, int height, struct render_context **context, char why[RENDER_WHY])
{
    static const int wanted[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
    *context = NULL;
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
