#include "verify/chart.h"

#include <math.h>
#include <string.h>

/* Ticks that an axis has about, and how far from a line a point may lie that is left out [pixels]. */
enum { TICKS_X = 5, TICKS_Y = 5 };
static const double tolerance = 0.04;

struct verify_axis verify_axis(const char *name, const char *unit)
{
    return (struct verify_axis){.name = name, .unit = unit, .low = INFINITY, .high = -INFINITY, .per = 1};
}

void verify_axis_hold(struct verify_axis *axis, double value)
{
    if (isfinite(value)) {
        axis->low = fmin(axis->low, value);
        axis->high = fmax(axis->high, value);
    }
}

bool verify_axis_close(struct verify_axis *axis, double margin)
{
    static const char *const prefix[] = {"p", "n", "&micro;", "m", "", "k", "M", "G", "T"};
    double extent = axis->high - axis->low, largest = fmax(fabs(axis->low), fabs(axis->high));
    if (!(extent > 0) || !isfinite(extent)) {
        return false;
    }
    int power = (int)floor(log10(largest) / 3 + 1e-9);
    power = power < -4 ? -4 : power > 4 ? 4 : power;
    axis->per = pow(1000, power);
    (void)snprintf(axis->prefix, sizeof axis->prefix, "%s", prefix[power + 4]);
    axis->low -= margin * extent;
    axis->high += margin * extent;
    return true;
}

static double x_of(const struct verify_chart *chart, double x)
{
    return chart->left + (chart->right - chart->left) * (x - chart->x.low) / (chart->x.high - chart->x.low);
}

static double y_of(const struct verify_chart *chart, double y)
{
    return chart->bottom - (chart->bottom - chart->top) * (y - chart->y.low) / (chart->y.high - chart->y.low);
}

/* Ticks at whole multiples of 1, 2 or 5 times a power of ten of the unit shown, about as many. */
static double tick_step(const struct verify_axis *axis, int ticks)
{
    double rough = (axis->high - axis->low) / axis->per / ticks;
    double power = pow(10, floor(log10(rough)));
    double lead = rough / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

static void draw_x_ticks(FILE *file, const struct verify_chart *chart)
{
    double step = tick_step(&chart->x, TICKS_X);
    for (long i = (long)ceil(chart->x.low / chart->x.per / step - 1e-9);
         (double)i * step * chart->x.per <= chart->x.high * (1 + 1e-12); i++) {
        double x = x_of(chart, (double)i * step * chart->x.per);
        (void)fprintf(file, "<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>", x, chart->top, x,
                      chart->bottom);
        (void)fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%.6g</text>\n", x, chart->bottom + 16,
                      (double)i * step);
    }
}

static void draw_y_ticks(FILE *file, const struct verify_chart *chart)
{
    double step = tick_step(&chart->y, TICKS_Y);
    for (long i = (long)ceil(chart->y.low / chart->y.per / step); (double)i * step * chart->y.per <= chart->y.high;
         i++) {
        double y = y_of(chart, (double)i * step * chart->y.per);
        (void)fprintf(file, "<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>", chart->left, y,
                      chart->right, y);
        (void)fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%.6g</text>\n", chart->left - 6, y + 4,
                      (double)i * step);
    }
}

void verify_chart_frame(FILE *file, const struct verify_chart *chart, bool x_labels)
{
    if (x_labels) {
        draw_x_ticks(file, chart);
        (void)fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s [%s%s]</text>\n",
                      (chart->left + chart->right) / 2, chart->bottom + 34, chart->x.name, chart->x.prefix,
                      chart->x.unit);
    }
    draw_y_ticks(file, chart);
    (void)fprintf(file, "<rect class=\"frame\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n", chart->left,
                  chart->top, chart->right - chart->left, chart->bottom - chart->top);
    (void)fprintf(file,
                  "<text transform=\"translate(%.1f %.1f) rotate(-90)\" text-anchor=\"middle\">%s [%s%s]</text>\n",
                  chart->left - 48, (chart->top + chart->bottom) / 2, chart->y.name, chart->y.prefix, chart->y.unit);
}

/* Slopes from the last point written that pass within the tolerance of all points left out since. */
struct fan {
    double from[2], low, high;
};

static void open_fan(struct fan *fan, const double at[2])
{
    *fan = (struct fan){.from = {at[0], at[1]}, .low = -INFINITY, .high = INFINITY};
}

/* Whether a line to `at` is within the fan, which it then narrows. Points go to the right. */
static bool fold_fan(struct fan *fan, const double at[2])
{
    double run = at[0] - fan->from[0], rise = at[1] - fan->from[1];
    bool within = run > 0 && rise >= fan->low * run && rise <= fan->high * run;
    if (within) {
        fan->low = fmax(fan->low, (rise - tolerance) / run);
        fan->high = fmin(fan->high, (rise + tolerance) / run);
    }
    return within;
}

void verify_chart_line(FILE *file, const struct verify_chart *chart, const char *class, size_t count, size_t stride,
                       const double *x, const double *y)
{
    struct fan fan = {.low = 0};
    double last[2] = {NAN, NAN};
    bool open = false; /* a line is begun, and `last` belongs to it */
    for (size_t i = 0; i <= count; i++) {
        bool there = i < count && isfinite(x[i * stride]) && isfinite(y[i * stride]);
        double now[2] = {there ? x_of(chart, x[i * stride]) : NAN, there ? y_of(chart, y[i * stride]) : NAN};
        if (there && !open) {
            (void)fprintf(file, "<polyline class=\"%s\" points=\"%.2f,%.2f ", class, now[0], now[1]);
            open_fan(&fan, now);
        } else if (open && !there) {
            (void)fprintf(file, "%.2f,%.2f\"/>\n", last[0], last[1]);
        } else if (there && !fold_fan(&fan, now)) {
            (void)fprintf(file, "%.2f,%.2f ", last[0], last[1]);
            open_fan(&fan, last);
            (void)fold_fan(&fan, now);
        }
        open = there;
        memcpy(last, now, sizeof last);
    }
}

void verify_chart_dots(FILE *file, const struct verify_chart *chart, const char *class, size_t count, const double *x,
                       const double *y)
{
    for (size_t i = 0; i < count; i++) {
        if (isfinite(x[i]) && isfinite(y[i])) {
            (void)fprintf(file, "<circle class=\"%s\" cx=\"%.2f\" cy=\"%.2f\" r=\"2.5\"/>\n", class, x_of(chart, x[i]),
                          y_of(chart, y[i]));
        }
    }
}

void verify_chart_mark(FILE *file, const struct verify_chart *chart, const char *class, double x)
{
    if (isgreater(x, chart->x.low) && isless(x, chart->x.high)) {
        (void)fprintf(file, "<line class=\"%s\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", class,
                      x_of(chart, x), chart->top, x_of(chart, x), chart->bottom);
    }
}
