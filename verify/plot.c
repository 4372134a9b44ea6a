#include "verify/report.h"

#include <math.h>

/* Pixels of the picture and, within it, of the plotted area. */
enum { WIDTH = 520, HEIGHT = 400, LEFT = 70, RIGHT = 500, TOP = 20, BOTTOM = 340, ORDERS = 4 };

/* Points of one curve; only positive finite values are kept, since only they have a logarithm. */
struct curve {
    size_t count;
    double h[SOLVER_LEVELS + SOLVER_ROWS], e[SOLVER_LEVELS + SOLVER_ROWS];
};

/* Both axes as powers of ten. */
struct axes {
    double x0, x1, y0, y1;
};

static void add(struct curve *curve, double h, double e)
{
    if (isfinite(e) && e > 0 && isfinite(h) && h > 0) {
        curve->h[curve->count] = h;
        curve->e[curve->count++] = e;
    }
}

static void stretch(struct axes *axes, const struct curve *curve)
{
    for (size_t i = 0; i < curve->count; i++) {
        axes->x0 = fmin(axes->x0, log10(curve->h[i]));
        axes->x1 = fmax(axes->x1, log10(curve->h[i]));
        axes->y0 = fmin(axes->y0, log10(curve->e[i]));
        axes->y1 = fmax(axes->y1, log10(curve->e[i]));
    }
}

static double x_of(const struct axes *axes, double h)
{
    return LEFT + (RIGHT - LEFT) * (log10(h) - axes->x0) / (axes->x1 - axes->x0);
}

static double y_of(const struct axes *axes, double e)
{
    return BOTTOM - (BOTTOM - TOP) * (log10(e) - axes->y0) / (axes->y1 - axes->y0);
}

static void draw_axes(FILE *file, const struct axes *axes, const struct verify_errors *errors)
{
    for (int decade = (int)axes->y0; decade <= (int)axes->y1; decade++) {
        double y = y_of(axes, pow(10, decade));
        (void)fprintf(file, "<line class=\"grid\" x1=\"%d\" y1=\"%.1f\" x2=\"%d\" y2=\"%.1f\"/>", LEFT, y, RIGHT, y);
        (void)fprintf(file,
                      "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">10<tspan dy=\"-6\" font-size=\"10\">%d</tspan>"
                      "</text>\n",
                      LEFT - 8, y + 4, decade);
    }
    for (size_t i = 0; i < errors->count; i++) {
        double x = x_of(axes, errors->h[i]);
        (void)fprintf(file, "<line class=\"grid\" x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\"/>", x, TOP, x, BOTTOM);
        (void)fprintf(file, "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%.3g</text>\n", x, BOTTOM + 18,
                      errors->h[i]);
    }
    (void)fprintf(file, "<rect class=\"frame\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n", LEFT, TOP,
                  RIGHT - LEFT, BOTTOM - TOP);
    (void)fprintf(file, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">spacing h [m]</text>\n", (LEFT + RIGHT) / 2,
                  BOTTOM + 42);
    (void)fprintf(file,
                  "<text transform=\"translate(18 %d) rotate(-90)\" text-anchor=\"middle\">error %s [%s]</text>\n",
                  (TOP + BOTTOM) / 2, errors->name, errors->unit);
}

/* Lines of order 1, 2, 3, ... through the finest measured point, each up to where it leaves the plot. */
static void draw_orders(FILE *file, const struct axes *axes, double h, double e)
{
    for (int order = 1; order <= ORDERS; order++) {
        double h_end = fmin(pow(10, axes->x1), h * pow(pow(10, axes->y1) / e, 1.0 / order));
        double e_end = e * pow(h_end / h, order);
        double x = x_of(axes, h_end), y = y_of(axes, e_end);
        (void)fprintf(file, "<line class=\"order\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>", x_of(axes, h),
                      y_of(axes, e), x, y);
        (void)fprintf(file, "<text class=\"order\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">order %d</text>\n", x - 4,
                      y + 13, order);
    }
}

static void draw_curve(FILE *file, const struct axes *axes, const struct curve *curve, const char *class)
{
    (void)fprintf(file, "<polyline class=\"%s\" points=\"", class);
    for (size_t i = 0; i < curve->count; i++) {
        (void)fprintf(file, "%.1f,%.1f ", x_of(axes, curve->h[i]), y_of(axes, curve->e[i]));
    }
    (void)fprintf(file, "\"/>\n");
    for (size_t i = 0; i < curve->count; i++) {
        (void)fprintf(file, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\"/>\n", class,
                      x_of(axes, curve->h[i]), y_of(axes, curve->e[i]));
    }
}

static void draw_key(FILE *file, const char *class, int row, const char *text)
{
    int y = TOP + 18 + 20 * row;
    (void)fprintf(file, "<circle class=\"%s\" cx=\"%d\" cy=\"%d\" r=\"4.5\"/><text x=\"%d\" y=\"%d\">%s</text>\n",
                  class, LEFT + 16, y, LEFT + 28, y + 4, text);
}

void verify_plot_errors(FILE *file, const struct verify_errors *errors)
{
    struct curve measured = {.count = 0}, published = {.count = 0};
    for (size_t i = 0; i < errors->count; i++) {
        add(&measured, errors->h[i], errors->e[i]);
    }
    for (size_t i = 0; i < errors->published_count; i++) {
        add(&published, errors->published_h[i], errors->published_e[i]);
    }
    if (measured.count == 0) {
        (void)fprintf(file, "<p>Nothing to plot for %s: no level has an error above zero.</p>\n", errors->name);
        return;
    }
    struct axes axes = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    stretch(&axes, &measured);
    stretch(&axes, &published);
    axes.x0 -= 0.06;
    axes.x1 += 0.06;
    axes.y0 = floor(axes.y0);
    axes.y1 = fmax(ceil(axes.y1), axes.y0 + 1);
    (void)fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"convergence of %s\">\n", WIDTH, HEIGHT,
                  errors->name);
    draw_axes(file, &axes, errors);
    draw_orders(file, &axes, measured.h[measured.count - 1], measured.e[measured.count - 1]);
    if (published.count > 0) {
        draw_curve(file, &axes, &published, "published");
        draw_key(file, "published", 1, "published");
    }
    draw_curve(file, &axes, &measured, "measured");
    draw_key(file, "measured", 0, "measured");
    (void)fprintf(file, "</svg>\n");
}

void verify_plot(FILE *file, const struct verify_study *study, size_t error)
{
    struct verify_errors errors = {
        .name = verify_error_name(error), .unit = verify_error_unit(error), .count = study->level_count};
    for (size_t i = 0; i < study->level_count; i++) {
        errors.h[i] = study->level[i].facts.spacing;
        errors.e[i] = study->level[i].error[error];
    }
    for (size_t i = 0; i < study->scene->published_count; i++) {
        int n = study->scene->published[i].n;
        errors.published_h[errors.published_count] = study->scene->reference_length / n;
        errors.published_e[errors.published_count++] = verify_published(study->scene, n, errors.name);
    }
    verify_plot_errors(file, &errors);
}
