#include "verify/report.h"

#include <math.h>

/* Pixels of the picture and, within it, of the plotted area; points of the exact curve. */
enum { WIDTH = 520, HEIGHT = 300, LEFT = 90, RIGHT = 500, TOP = 34, BOTTOM = 246, EXACT = 400, TICKS = 4 };

struct axes {
    double t0, t1, u0, u1;
};

static double x_of(const struct axes *axes, double t)
{
    return LEFT + (RIGHT - LEFT) * (t - axes->t0) / (axes->t1 - axes->t0);
}

static double y_of(const struct axes *axes, double u)
{
    return BOTTOM - (BOTTOM - TOP) * (u - axes->u0) / (axes->u1 - axes->u0);
}

static double exact_at(const struct verify_study *study, const struct verify_trace *trace, double t)
{
    struct oracle_state state;
    study->truth->kind->state(study->truth->oracle, trace->X, t, &state);
    return state.u[trace->axis];
}

static double exact_time(const struct axes *axes, int i)
{
    return axes->t0 + (axes->t1 - axes->t0) * i / (EXACT - 1);
}

/* Ticks at whole multiples of 1, 2 or 5 times a power of ten, at most TICKS + 1 of them. */
static double tick_step(double low, double high)
{
    double rough = (high - low) / TICKS;
    double power = pow(10, floor(log10(rough)));
    double lead = rough / power;
    return power * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

static void draw_axes(FILE *file, const struct axes *axes, const struct verify_trace *trace)
{
    double step = tick_step(axes->u0, axes->u1);
    for (long i = (long)ceil(axes->u0 / step); (double)i * step <= axes->u1; i++) {
        double u = (double)i * step;
        double y = y_of(axes, u);
        (void)fprintf(file, "<line class=\"grid\" x1=\"%d\" y1=\"%.1f\" x2=\"%d\" y2=\"%.1f\"/>", LEFT, y, RIGHT, y);
        (void)fprintf(file, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%.6g</text>\n", LEFT - 8, y + 4, u);
    }
    step = tick_step(axes->t0, axes->t1);
    for (long i = (long)ceil(axes->t0 / step); (double)i * step <= axes->t1; i++) {
        double t = (double)i * step;
        double x = x_of(axes, t);
        (void)fprintf(file, "<line class=\"grid\" x1=\"%.1f\" y1=\"%d\" x2=\"%.1f\" y2=\"%d\"/>", x, TOP, x, BOTTOM);
        (void)fprintf(file, "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">%.6g</text>\n", x, BOTTOM + 18, t);
    }
    (void)fprintf(file, "<rect class=\"frame\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n", LEFT, TOP,
                  RIGHT - LEFT, BOTTOM - TOP);
    (void)fprintf(file, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">time t [s]</text>\n", (LEFT + RIGHT) / 2,
                  BOTTOM + 42);
    (void)fprintf(file, "<text transform=\"translate(18 %d) rotate(-90)\" text-anchor=\"middle\">u%c [m]</text>\n",
                  (TOP + BOTTOM) / 2, "xyz"[trace->axis]);
    (void)fprintf(file, "<text x=\"%d\" y=\"%d\">X = (%.4g, %.4g, %.4g) m</text>\n", LEFT, TOP - 12, trace->X[0],
                  trace->X[1], trace->X[2]);
}

/* Largest displacement of any probe: what is round-off beside it is no movement. */
static double largest(const struct verify_study *study)
{
    double size = 0;
    for (size_t i = 0; i < study->trace_count; i++) {
        for (size_t row = 0; row < study->trace[i].count; row++) {
            size = fmax(size, fabs(study->trace[i].displacement[row]));
        }
    }
    return size;
}

void verify_plot_trace(FILE *file, const struct verify_study *study, const struct verify_trace *trace)
{
    struct axes axes = {trace->time[0], trace->time[trace->count - 1], INFINITY, -INFINITY};
    for (size_t i = 0; i < trace->count; i++) {
        axes.u0 = fmin(axes.u0, trace->displacement[i]);
        axes.u1 = fmax(axes.u1, trace->displacement[i]);
    }
    for (int i = 0; i < EXACT; i++) {
        double u = exact_at(study, trace, exact_time(&axes, i));
        axes.u0 = fmin(axes.u0, u);
        axes.u1 = fmax(axes.u1, u);
    }
    if (!(axes.t1 > axes.t0) || !(axes.u1 - axes.u0 > 1e-12 * largest(study))) {
        return; /* a probe that is held still has nothing to show */
    }
    double margin = 0.04 * (axes.u1 - axes.u0);
    axes.u0 -= margin;
    axes.u1 += margin;
    (void)fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"displacement over time\">\n", WIDTH,
                  HEIGHT);
    draw_axes(file, &axes, trace);
    (void)fprintf(file, "<polyline class=\"published\" points=\"");
    for (int i = 0; i < EXACT; i++) {
        double t = exact_time(&axes, i);
        (void)fprintf(file, "%.1f,%.1f ", x_of(&axes, t), y_of(&axes, exact_at(study, trace, t)));
    }
    (void)fprintf(file, "\"/>\n");
    for (size_t i = 0; i < trace->count; i++) {
        (void)fprintf(file, "<circle class=\"measured\" cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"/>\n",
                      x_of(&axes, trace->time[i]), y_of(&axes, trace->displacement[i]),
                      trace->count > 50 ? "1.5" : "3.5");
    }
    (void)fprintf(file,
                  "<text x=\"%d\" y=\"%d\" fill=\"#0b5394\">&#9679;</text><text x=\"%d\" y=\"%d\">computed</text>"
                  "<polyline class=\"published\" points=\"%d,%d %d,%d\"/><text x=\"%d\" y=\"%d\">exact</text></svg>\n",
                  RIGHT - 174, TOP - 12, RIGHT - 160, TOP - 12, RIGHT - 75, TOP - 16, RIGHT - 50, TOP - 16, RIGHT - 42,
                  TOP - 12);
}
