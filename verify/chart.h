/* Linear charts as SVG: a frame with ticks and units, and lines in it. */
#ifndef VERIFY_CHART_H
#define VERIFY_CHART_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What an axis shows; ends are in SI units. */
struct verify_axis {
    const char *name, *unit; /* "X", "m"; markup stands as it is */
    double low, high;
    double per;     /* how many SI units one of the unit shown is: 1e-6 */
    char prefix[8]; /* "&micro;" */
};

struct verify_chart {
    double left, right, top, bottom; /* [pixels] of the plotted area */
    struct verify_axis x, y;
};

struct verify_axis verify_axis(const char *name, const char *unit);
/* Grows the axis so that it holds the value; what is not finite is left out. */
void verify_axis_hold(struct verify_axis *axis, double value);
/* Adds a margin and chooses the prefix, such that numbers lie between 1 and 1000. False if the axis has no extent. */
bool verify_axis_close(struct verify_axis *axis, double margin);

/* Grid, ticks, frame and the name of the y axis; with `x_labels` ticks and name of the x axis too. */
void verify_chart_frame(FILE *file, const struct verify_chart *chart, bool x_labels);
/* A line through count points, x[0], x[stride], ...; those that a line between their neighbours shows as well are left
 * out, and those that are no numbers interrupt it. */
void verify_chart_line(FILE *file, const struct verify_chart *chart, const char *class, size_t count, size_t stride,
                       const double *x, const double *y);
/* A dot at each of count points. */
void verify_chart_dots(FILE *file, const struct verify_chart *chart, const char *class, size_t count, const double *x,
                       const double *y);
/* A line across the plotted area at x, if it lies within. */
void verify_chart_mark(FILE *file, const struct verify_chart *chart, const char *class, double x);

#endif
