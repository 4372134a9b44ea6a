#include "render/paint.h"

#include "render/context.h"
#include "render/fail.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum { POINTS = 3 * 8192, CAP_EDGES = 8, PLACE = 0, INK = 1, VALUE = 2 };

struct render_paint {
    struct render_context *context;
    int width, height, samples; /* samples along each side of a pixel */
    GLuint program;
    size_t count;
    struct render_point point[POINTS]; /* waiting to be drawn */
};

static const char vertex_text[] =
    "#version 120\n"
    "attribute vec3 place, ink, value;\n"
    "varying vec3 plain, field;\n"
    "uniform vec2 size;\n"
    "void main() {\n"
    "    plain = ink;\n"
    "    field = value;\n"
    "    gl_Position = vec4(2.0 * place.x / size.x - 1.0, 1.0 - 2.0 * place.y / size.y, 2.0 * place.z - 1.0, 1.0);\n"
    "}\n";

/* The band is found for each sample, from the interpolated value: its edges are crisp and no mixed colours arise. */
static const char fragment_text[] = "#version 120\n"
                                    "varying vec3 plain, field;\n"
                                    "uniform vec3 colour[64];\n"
                                    "uniform float bands;\n"
                                    "void main() {\n"
                                    "    int band = int(clamp(floor(field.x * bands), 0.0, bands - 1.0));\n"
                                    "    gl_FragColor = vec4(field.z > 0.5 ? plain : field.y * colour[band], 1.0);\n"
                                    "}\n";

static bool attach(GLuint program, GLenum kind, const char *text, char why[RENDER_WHY])
{
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        char log[256] = "";
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        glDeleteShader(shader);
        return render_fail(why, "OpenGL does not compile the shader (version 2.1 is needed): %s", log);
    }
    glAttachShader(program, shader);
    glDeleteShader(shader); /* lives on as long as the program */
    return true;
}

static bool build_program(struct render_paint *paint, char why[RENDER_WHY])
{
    paint->program = glCreateProgram();
    if (!attach(paint->program, GL_VERTEX_SHADER, vertex_text, why) ||
        !attach(paint->program, GL_FRAGMENT_SHADER, fragment_text, why))
        return false;
    glBindAttribLocation(paint->program, PLACE, "place");
    glBindAttribLocation(paint->program, INK, "ink");
    glBindAttribLocation(paint->program, VALUE, "value");
    glLinkProgram(paint->program);
    GLint linked = 0;
    glGetProgramiv(paint->program, GL_LINK_STATUS, &linked);
    if (!linked)
        return render_fail(why, "OpenGL does not link the shaders (version 2.1 is needed)");
    glUseProgram(paint->program);
    return true;
}

static void point_at_arrays(const struct render_paint *paint)
{
    const GLsizei stride = sizeof *paint->point;
    glVertexAttribPointer(PLACE, 3, GL_FLOAT, GL_FALSE, stride, &paint->point->x);
    glVertexAttribPointer(INK, 3, GL_FLOAT, GL_FALSE, stride, &paint->point->red);
    glVertexAttribPointer(VALUE, 3, GL_FLOAT, GL_FALSE, stride, &paint->point->band);
    for (GLuint i = PLACE; i <= VALUE; i++)
        glEnableVertexAttribArray(i);
}

bool render_paint_open(int width, int height, const float *band_colour, int bands, struct render_paint **paint,
                       char why[RENDER_WHY])
{
    *paint = NULL;
    struct render_paint *made = calloc(1, sizeof *made);
    if (!made)
        return render_fail(why, "no memory for drawing");
    made->width = width;
    made->height = height;
    /* Sixteen samples a pixel; four where sixteen would take a gigabyte. */
    made->samples = (long)width * height <= 4000000 ? 4 : 2;
    if (!render_context_open(width * made->samples, height * made->samples, &made->context, why) ||
        !build_program(made, why)) {
        render_paint_close(made);
        return false;
    }
    glUniform2f(glGetUniformLocation(made->program, "size"), (float)width, (float)height);
    glUniform1f(glGetUniformLocation(made->program, "bands"), (float)bands);
    glUniform3fv(glGetUniformLocation(made->program, "colour"), bands, band_colour);
    point_at_arrays(made);
    glViewport(0, 0, width * made->samples, height * made->samples);
    glDisable(GL_DITHER);
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    *paint = made;
    return true;
}

void render_paint_close(struct render_paint *paint)
{
    if (!paint)
        return;
    if (paint->context && paint->program)
        glDeleteProgram(paint->program);
    render_context_close(paint->context);
    free(paint);
}

static void flush(struct render_paint *paint)
{
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)paint->count);
    paint->count = 0;
}

void render_paint_within(struct render_paint *paint, const int rectangle[4])
{
    flush(paint);
    const int s = paint->samples;
    glScissor(rectangle[0] * s, (paint->height - rectangle[3]) * s, (rectangle[2] - rectangle[0]) * s,
              (rectangle[3] - rectangle[1]) * s);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
}

void render_paint_on_top(struct render_paint *paint)
{
    flush(paint);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
}

void render_paint_triangle(struct render_paint *paint, const struct render_point corner[3])
{
    if (paint->count == POINTS)
        flush(paint);
    for (int i = 0; i < 3; i++)
        paint->point[paint->count++] = corner[i];
}

struct render_point render_inked(float x, float y, float depth, struct render_ink ink)
{
    return (struct render_point){x, y, depth, ink.red, ink.green, ink.blue, 0, 1, 1};
}

/* Half a disc around `at`, its flat side along (across_x, across_y), bulging to the left of it. */
static void cap(struct render_paint *paint, const float at[3], float across_x, float across_y, struct render_ink ink)
{
    struct render_point fan[3] = {render_inked(at[0], at[1], at[2], ink),
                                  render_inked(at[0] + across_x, at[1] + across_y, at[2], ink)};
    for (int i = 1; i <= CAP_EDGES; i++) {
        const float angle = (float)M_PI * (float)i / CAP_EDGES, c = cosf(angle), s = sinf(angle);
        fan[2] = render_inked(at[0] + c * across_x - s * across_y, at[1] + s * across_x + c * across_y, at[2], ink);
        render_paint_triangle(paint, fan);
        fan[1] = fan[2];
    }
}

void render_paint_stroke(struct render_paint *paint, const float from[3], const float to[3], float width,
                         struct render_ink ink)
{
    const float dx = to[0] - from[0], dy = to[1] - from[1], length = hypotf(dx, dy), half = width / 2;
    const float nx = length > 0 ? -dy / length * half : half, ny = length > 0 ? dx / length * half : 0;
    const struct render_point a = render_inked(from[0] + nx, from[1] + ny, from[2], ink);
    const struct render_point b = render_inked(from[0] - nx, from[1] - ny, from[2], ink);
    const struct render_point c = render_inked(to[0] + nx, to[1] + ny, to[2], ink);
    const struct render_point d = render_inked(to[0] - nx, to[1] - ny, to[2], ink);
    render_paint_triangle(paint, (struct render_point[]){a, b, c});
    render_paint_triangle(paint, (struct render_point[]){c, b, d});
    cap(paint, from, nx, ny, ink);
    cap(paint, to, -nx, -ny, ink);
}

void render_paint_rectangle(struct render_paint *paint, float x0, float y0, float x1, float y1, struct render_ink ink)
{
    const struct render_point a = render_inked(x0, y0, 0, ink), b = render_inked(x1, y0, 0, ink);
    const struct render_point c = render_inked(x0, y1, 0, ink), d = render_inked(x1, y1, 0, ink);
    render_paint_triangle(paint, (struct render_point[]){a, b, c});
    render_paint_triangle(paint, (struct render_point[]){c, b, d});
}

bool render_paint_finish(struct render_paint *paint, struct render_image *image, char why[RENDER_WHY])
{
    flush(paint);
    const uint8_t *sheet = render_context_pixels(paint->context);
    const GLenum state = glGetError();
    if (state != GL_NO_ERROR)
        return render_fail(why, "OpenGL reports error 0x%04x while drawing", state);
    const int s = paint->samples;
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            for (int c = 0; c < 3; c++) {
                int sum = s * s / 2;
                for (int j = 0; j < s; j++)
                    for (int i = 0; i < s; i++) {
                        const int row = (image->height - 1 - y) * s + j, column = x * s + i;
                        sum += sheet[((size_t)row * (size_t)(image->width * s) + (size_t)column) * 4 + (size_t)c];
                    }
                image->rgb[((size_t)y * (size_t)image->width + (size_t)x) * 3 + (size_t)c] = (uint8_t)(sum / (s * s));
            }
    return true;
}
