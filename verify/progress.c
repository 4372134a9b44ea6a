#include "verify/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double verify_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void verify_progress_begin(struct verify_progress *progress, const char *label, double t_end)
{
    double begun = verify_now();
    *progress = (struct verify_progress){
        .label = label, .t_end = t_end, .on = isatty(STDERR_FILENO) == 1, .begun = begun, .shown = begun};
    if (progress->on) {
        (void)fprintf(stderr, "\r\033[K%s: setting up", label);
    }
}

void verify_progress_go(struct verify_progress *progress)
{
    progress->begun = verify_now();
}

bool verify_progress_show(void *context, double time, double stop, size_t step)
{
    (void)stop;
    static const char full[] = "##############################", empty[] = "..............................";
    struct verify_progress *progress = context;
    double at = verify_now();
    if (!progress->on || at - progress->shown < 0.1 || !(progress->t_end > 0)) {
        return true;
    }
    progress->shown = at;
    double fraction = time / progress->t_end;
    fraction = fraction < 0 ? 0 : fraction > 1 ? 1 : fraction;
    int width = (int)(sizeof full - 1), filled = (int)(fraction * width);
    (void)fprintf(stderr, "\r\033[K%s: [%.*s%.*s] %3.0f %%, step %zu, t = %.3g s", progress->label, filled, full,
                  width - filled, empty, 100 * fraction, step, time);
    double here = fraction - progress->from / progress->t_end;
    if (here > 0.01) {
        (void)fprintf(stderr, ", %.0f s to go", (at - progress->begun) * (1 - fraction) / here);
    }
    return true;
}

void verify_progress_end(struct verify_progress *progress)
{
    if (progress->on) {
        (void)fprintf(stderr, "\r\033[K");
    }
}
