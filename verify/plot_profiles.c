/* The stress along a one-dimensional body at the snapshots, level over level over the exact one, as small multiples: in
 * each what is computed and, below, by how much it departs. */
#include "verify/chart.h"
#include "verify/html.h"
#include "verify/report.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 380, HEIGHT = 330, LEFT = 66, RIGHT = 370, TOP = 24, MIDDLE = 196, BELOW = 212, BOTTOM = 290 };
/* Levels that are drawn, the finest ones. */
enum { DRAWN = 3 };
static const char *const style_of[DRAWN] = {"finest", "finer", "fine"};

/* The axes that all panels share. */
struct shared {
    struct verify_axis X, stress, error;
};

static size_t first_drawn(const struct verify_study *study)
{
    return study->level_count > DRAWN ? study->level_count - DRAWN : 0;
}

static bool share(const struct verify_study *study, struct shared *all)
{
    *all = (struct shared){verify_axis("X", "m"),
                           verify_axis("&sigma;<tspan baseline-shift=\"sub\" font-size=\"9\">xx</tspan>", "Pa"),
                           verify_axis("error", "Pa")};
    for (size_t i = first_drawn(study); i < study->level_count; i++) {
        for (size_t s = 0; s < study->level[i].snapshot_count; s++) {
            const struct verify_snapshot *snapshot = &study->level[i].snapshot[s];
            for (size_t a = 0; a < snapshot->count; a++) {
                verify_axis_hold(&all->X, snapshot->point[a].X);
                verify_axis_hold(&all->stress, snapshot->point[a].computed);
                verify_axis_hold(&all->stress, snapshot->point[a].exact);
                verify_axis_hold(&all->error, snapshot->point[a].computed - snapshot->point[a].exact);
            }
        }
    }
    return verify_axis_close(&all->X, 0) && verify_axis_close(&all->stress, 0.06) &&
           verify_axis_close(&all->error, 0.06);
}

/* Where something runs, and where materials meet. */
static void draw_fronts(FILE *file, const struct verify_study *study, const struct verify_chart *chart, double t,
                        struct oracle_front *front)
{
    const struct verify_truth *truth = study->truth;
    size_t count = truth->kind->fronts != NULL ? truth->kind->fronts(truth->oracle, t, front) : 0;
    for (size_t i = 0; count != ORACLE_TOO_MANY_FRONTS && i < count; i++) {
        verify_chart_mark(file, chart, front[i].speed != 0 ? "front" : "interface", front[i].X);
    }
}

/* Memory that every panel needs. */
struct room {
    double *x, *y;              /* [particles of the finest level] */
    struct oracle_front *front; /* [ORACLE_FRONTS] */
};

static void draw_stresses(FILE *file, const struct verify_study *study, const struct shared *all, size_t s,
                          const struct room *room)
{
    enum { STRIDE = sizeof(struct verify_point) / sizeof(double) };
    const struct verify_chart chart = {LEFT, RIGHT, TOP, MIDDLE, all->X, all->stress};
    const struct verify_snapshot *finest = &study->level[study->level_count - 1].snapshot[s];
    verify_chart_frame(file, &chart, false);
    draw_fronts(file, study, &chart, finest->time, room->front);
    verify_chart_line(file, &chart, "exact", finest->count, STRIDE, &finest->point[0].X, &finest->point[0].exact);
    for (size_t i = first_drawn(study); i < study->level_count; i++) {
        const struct verify_snapshot *snapshot = &study->level[i].snapshot[s];
        verify_chart_line(file, &chart, style_of[study->level_count - 1 - i], snapshot->count, STRIDE,
                          &snapshot->point[0].X, &snapshot->point[0].computed);
    }
}

static void draw_errors(FILE *file, const struct verify_study *study, const struct shared *all, size_t s,
                        const struct room *room)
{
    const struct verify_chart chart = {LEFT, RIGHT, BELOW, BOTTOM, all->X, all->error};
    verify_chart_frame(file, &chart, true);
    draw_fronts(file, study, &chart, study->level[study->level_count - 1].snapshot[s].time, room->front);
    for (size_t i = first_drawn(study); i < study->level_count; i++) {
        const struct verify_snapshot *snapshot = &study->level[i].snapshot[s];
        for (size_t a = 0; a < snapshot->count; a++) {
            room->x[a] = snapshot->point[a].X;
            room->y[a] = snapshot->point[a].computed - snapshot->point[a].exact;
        }
        verify_chart_line(file, &chart, style_of[study->level_count - 1 - i], snapshot->count, 1, room->x, room->y);
    }
}

static void draw_panel(FILE *file, const struct verify_study *study, const struct shared *all, size_t s,
                       const struct room *room)
{
    double t = study->level[study->level_count - 1].snapshot[s].time;
    struct verify_axis time = verify_axis("t", "s");
    verify_axis_hold(&time, 0);
    verify_axis_hold(&time, t);
    (void)verify_axis_close(&time, 0);
    (void)fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"stress along the body\">\n", WIDTH,
                  HEIGHT);
    (void)fprintf(file, "<text class=\"title\" x=\"%d\" y=\"%d\">t = %.6g %ss</text>\n", LEFT, TOP - 8, t / time.per,
                  time.prefix);
    draw_stresses(file, study, all, s, room);
    draw_errors(file, study, all, s, room);
    (void)fprintf(file, "</svg>\n");
}

/* Which line is which, once for all panels. */
static void draw_key(FILE *file, const struct verify_study *study)
{
    static const char mark[] = "<span><svg viewBox=\"0 0 30 10\"><line class=\"%s\" x1=\"15\" y1=\"0\" x2=\"15\" "
                               "y2=\"10\"/></svg>%s</span>\n";
    static const char line[] =
        "<span><svg viewBox=\"0 0 30 10\"><polyline class=\"key %s\" points=\"1,5 29,5\"/></svg>";
    (void)fprintf(file, "<p class=\"key\">");
    (void)fprintf(file, line, "exact");
    (void)fprintf(file, "exact</span>\n");
    for (size_t i = first_drawn(study); i < study->level_count; i++) {
        struct verify_axis spacing = verify_axis("h", "m");
        verify_axis_hold(&spacing, 0);
        verify_axis_hold(&spacing, study->level[i].facts.spacing);
        (void)verify_axis_close(&spacing, 0);
        (void)fprintf(file, line, style_of[study->level_count - 1 - i]);
        (void)fprintf(file, "h = %.4g %sm</span>\n", study->level[i].facts.spacing / spacing.per, spacing.prefix);
    }
    if (study->truth->kind->fronts != NULL) {
        (void)fprintf(file, mark, "front", "exact front");
        (void)fprintf(file, mark, "interface", "interface of materials");
    }
    (void)fprintf(file, "</p>\n");
}

bool verify_plot_profiles(FILE *file, const struct verify_study *study, struct solver_error *error)
{
    const struct verify_level *finest = &study->level[study->level_count - 1];
    struct shared all;
    if (finest->snapshot_count == 0 || finest->snapshot[0].count == 0 || !share(study, &all)) {
        return true;
    }
    size_t count = finest->snapshot[0].count;
    const struct room room = {calloc(count, sizeof(double)), calloc(count, sizeof(double)),
                              calloc(ORACLE_FRONTS, sizeof(struct oracle_front))};
    bool done = room.x != NULL && room.y != NULL && room.front != NULL;
    if (done) {
        (void)fprintf(file, "<h2>Stress along the body</h2>\n");
        draw_key(file, study);
        (void)fprintf(file, "<div class=\"panels\">\n");
        for (size_t s = 0; s < finest->snapshot_count; s++) {
            draw_panel(file, study, &all, s, &room);
        }
        (void)fprintf(file, "</div>\n<p class=\"note\">Error: computed less exact stress, particle by particle. All "
                            "panels share their axes.</p>\n");
    }
    free(room.x);
    free(room.y);
    free(room.front);
    return done || solver_fail(error, SOLVER_NO_MEMORY, "no memory to draw the profiles of %zu particles", count);
}
