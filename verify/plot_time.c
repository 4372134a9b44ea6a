/* Curves over time, computed over exact. */
#include "verify/chart.h"
#include "verify/html.h"
#include "verify/report.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 560, HEIGHT = 300, LEFT = 74, RIGHT = 548, TOP = 30, BOTTOM = 256 };
/* Points of an exact curve, and rows up to which each is a dot besides. */
enum { EXACT = 400, DOTS = 60 };

static const struct verify_chart frame = {.left = LEFT, .right = RIGHT, .top = TOP, .bottom = BOTTOM};

static const char *const displacement_name[] = {"u<tspan baseline-shift=\"sub\" font-size=\"9\">x</tspan>",
                                                "u<tspan baseline-shift=\"sub\" font-size=\"9\">y</tspan>",
                                                "u<tspan baseline-shift=\"sub\" font-size=\"9\">z</tspan>"};

/* Times of the exact curve's points over the range of the computed one. */
static void exact_times(size_t count, const double *time, double out[EXACT])
{
    for (size_t i = 0; i < EXACT; i++) {
        out[i] = time[0] + (time[count - 1] - time[0]) * (double)i / (EXACT - 1);
    }
}

static void key(FILE *file, double x, const char *class, const char *text)
{
    (void)fprintf(file, "<polyline class=\"key %s\" points=\"%.1f,%d %.1f,%d\"/><text x=\"%.1f\" y=\"%d\">%s</text>",
                  class, x, TOP - 14, x + 24, TOP - 14, x + 30, TOP - 10, text);
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
    double time[EXACT], exact[EXACT];
    struct verify_chart chart = frame;
    chart.x = verify_axis("t", "s");
    chart.y = verify_axis(displacement_name[trace->axis], "m");
    exact_times(trace->count, trace->time, time);
    for (size_t i = 0; i < EXACT; i++) {
        struct oracle_state state;
        study->truth->kind->state(study->truth->oracle, trace->X, time[i], &state);
        exact[i] = state.u[trace->axis];
        verify_axis_hold(&chart.y, exact[i]);
    }
    for (size_t i = 0; i < trace->count; i++) {
        verify_axis_hold(&chart.x, trace->time[i]);
        verify_axis_hold(&chart.y, trace->displacement[i]);
    }
    if (!(chart.y.high - chart.y.low > 1e-12 * largest(study)) || !verify_axis_close(&chart.x, 0) ||
        !verify_axis_close(&chart.y, 0.05)) {
        return; /* a probe that is held still has nothing to show */
    }
    (void)fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"displacement over time\">\n", WIDTH,
                  HEIGHT);
    verify_chart_frame(file, &chart, true);
    (void)fprintf(file, "<text class=\"title\" x=\"%d\" y=\"%d\">", LEFT, TOP - 10);
    verify_html_text(file, trace->name);
    (void)fprintf(file, "</text>");
    verify_chart_line(file, &chart, "exact", EXACT, 1, time, exact);
    verify_chart_line(file, &chart, "finest", trace->count, 1, trace->time, trace->displacement);
    if (trace->count <= DOTS) {
        verify_chart_dots(file, &chart, "finest", trace->count, trace->time, trace->displacement);
    }
    if (!study->truth->none) {
        key(file, RIGHT - 170, "exact", "exact");
    }
    key(file, RIGHT - 86, "finest", "computed");
    (void)fprintf(file, "</svg>\n");
}

static void hold_motion(struct verify_chart *chart, const struct verify_motion *motion, const double *u)
{
    for (size_t i = 0; i < motion->count; i++) {
        verify_axis_hold(&chart->x, motion->time[i]);
        verify_axis_hold(&chart->y, u[i]);
    }
}

void verify_plot_beside(FILE *file, const struct verify_study *study, size_t probe, size_t axis)
{
    const struct verify_motion *run = &study->motion, *other = &study->beside->motion;
    const double *u = verify_motion_component(run, probe, axis), *u_other = verify_motion_component(other, probe, axis);
    struct verify_chart chart = frame;
    chart.x = verify_axis("t", "s");
    chart.y = verify_axis(displacement_name[axis], "m");
    hold_motion(&chart, run, u);
    hold_motion(&chart, other, u_other);
    if (!(chart.y.high - chart.y.low > 1e-12 * largest(study)) || !verify_axis_close(&chart.x, 0) ||
        !verify_axis_close(&chart.y, 0.05)) {
        return; /* nothing moves along this axis */
    }
    (void)fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"displacement over time\">\n", WIDTH,
                  HEIGHT);
    verify_chart_frame(file, &chart, true);
    (void)fprintf(file, "<text class=\"title\" x=\"%d\" y=\"%d\">", LEFT, TOP - 10);
    verify_html_text(file, study->scene->probe[probe].name);
    (void)fprintf(file, "</text>");
    verify_chart_line(file, &chart, "beside", other->count, 1, other->time, u_other);
    verify_chart_line(file, &chart, "finest", run->count, 1, run->time, u);
    (void)fprintf(file, "</svg>\n");
}

/* Kinetic, strain and total energy at one time. */
struct energies {
    double time, kinetic, strain, total;
};

static void collect(const struct verify_study *study, size_t count, struct energies *computed,
                    struct energies exact[EXACT])
{
    const struct solver_totals *row = study->totals;
    double first = row[0].time, last = row[count - 1].time;
    for (size_t i = 0; i < count; i++) {
        computed[i] = (struct energies){row[i].time, row[i].kinetic, row[i].strain, row[i].kinetic + row[i].strain};
    }
    for (size_t i = 0; i < EXACT; i++) {
        struct energies *at = &exact[i];
        at->time = first + (last - first) * (double)i / (EXACT - 1);
        verify_truth_energy(study->truth, study->scene, at->time, &at->kinetic, &at->strain);
        at->total = at->kinetic + at->strain;
    }
}

static void draw_energies(FILE *file, const struct verify_study *study, const struct energies *computed,
                          const struct energies *exact)
{
    enum { STRIDE = sizeof(struct energies) / sizeof(double) };
    static const char *const unit[] = {"J/m&sup2;", "J/m", "J"};
    struct verify_chart chart = frame;
    size_t count = study->total_count;
    chart.x = verify_axis("t", "s");
    chart.y = verify_axis("energy", unit[study->scene->dim - 1]);
    verify_axis_hold(&chart.y, 0);
    for (size_t i = 0; i < count; i++) {
        verify_axis_hold(&chart.x, computed[i].time);
        verify_axis_hold(&chart.y, computed[i].total);
    }
    for (size_t i = 0; i < EXACT; i++) {
        verify_axis_hold(&chart.y, exact[i].total);
    }
    if (!verify_axis_close(&chart.x, 0) || !verify_axis_close(&chart.y, 0.05)) {
        return;
    }
    (void)fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"energy over time\">\n", WIDTH, HEIGHT);
    verify_chart_frame(file, &chart, true);
    verify_chart_line(file, &chart, "exact", EXACT, STRIDE, &exact->time, &exact->kinetic);
    verify_chart_line(file, &chart, "exact", EXACT, STRIDE, &exact->time, &exact->strain);
    verify_chart_line(file, &chart, "exact", EXACT, STRIDE, &exact->time, &exact->total);
    verify_chart_line(file, &chart, "kinetic", count, STRIDE, &computed->time, &computed->kinetic);
    verify_chart_line(file, &chart, "strain", count, STRIDE, &computed->time, &computed->strain);
    verify_chart_line(file, &chart, "total", count, STRIDE, &computed->time, &computed->total);
    if (!study->truth->none) {
        key(file, LEFT, "exact", "exact");
    }
    key(file, RIGHT - 280, "kinetic", "kinetic");
    key(file, RIGHT - 180, "strain", "strain");
    key(file, RIGHT - 86, "total", "total");
    (void)fprintf(file, "</svg>\n");
}

bool verify_plot_energy(FILE *file, const struct verify_study *study, struct solver_error *error)
{
    struct energies *computed = calloc(study->total_count, sizeof *computed);
    struct energies *exact = calloc(EXACT, sizeof *exact);
    bool done = computed != NULL && exact != NULL;
    if (done) {
        collect(study, study->total_count, computed, exact);
        draw_energies(file, study, computed, exact);
    }
    free(computed);
    free(exact);
    return done || solver_fail(error, SOLVER_NO_MEMORY, "no memory to draw energies at %zu times", study->total_count);
}
