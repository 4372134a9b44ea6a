#include "verify/report_trade.h"

#include "verify/norms.h"
#include "verify/terminal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MEMBERS = 512, SHOWN_BROKEN = 8, SHOWN_REASONS = 24 };

void verify_trade_print_begin(FILE *file, const struct verify_trade *trade, const struct solver_scene *scene,
                              const struct verify_truth *truth)
{
    (void)fprintf(file, "%s (%s)\n", scene->title, scene->path);
    verify_print_truth(file, truth);
    size_t error = verify_error_find(trade->error_name[trade->chosen]);
    (void)fprintf(file, "\nerror      %s%s%s at t = %.6g s\n", trade->error_name[trade->chosen],
                  error < VERIFY_ERRORS ? ", " : "", error < VERIFY_ERRORS ? verify_error_meaning(error) : "",
                  scene->t_end);
    for (size_t i = 0; i < trade->axis_count; i++) {
        (void)fprintf(file, "%s%s:", i == 0 ? "varied     " : "           ", trade->axis[i].key);
        for (size_t j = 0; j < trade->axis[i].count; j++) {
            (void)fprintf(file, " %s", trade->axis[i].value[j]);
        }
        (void)fputc('\n', file);
    }
    for (size_t i = 0; i < scene->variant_count; i++) {
        (void)fprintf(file, "           variant: %s\n", scene->variant[i].name);
    }
    (void)fprintf(file, "           n:");
    for (size_t i = 0; i < trade->level_count; i++) {
        (void)fprintf(file, " %d", trade->level[i]);
    }
    (void)fprintf(file, "\nown        %s\nbudget     %.4g s\n\n%6s %6s %9s %8s %11s %9s %9s\n", trade->run[0].words,
                  trade->budget, "n", "runs", "measured", "refused", "broke down", "left out", "time [s]");
    (void)fflush(file);
}

void verify_trade_print_level(FILE *file, const struct verify_trade *trade, int n, size_t from, size_t to)
{
    size_t ended[VERIFY_LEFT_OUT + 1] = {0};
    for (size_t i = from; i < to; i++) {
        ended[trade->run[i].end]++;
    }
    (void)fprintf(file, "%6d %6zu %9zu %8zu %11zu %9zu %9.1f\n", n, to - from, ended[VERIFY_MEASURED],
                  ended[VERIFY_REFUSED], ended[VERIFY_BROKE], ended[VERIFY_LEFT_OUT], trade->spent);
    (void)fflush(file);
}

static const struct verify_trade *sorted; /* what compare_error looks at: qsort takes no context */

static int compare_error(const void *a, const void *b)
{
    const struct verify_trade_run *one = &sorted->run[*(const size_t *)a], *other = &sorted->run[*(const size_t *)b];
    double x = one->error[sorted->chosen], y = other->error[sorted->chosen];
    return x != y ? (x < y) - (x > y) : (one->order > other->order) - (one->order < other->order);
}

size_t verify_trade_members(const struct verify_trade *trade, size_t *member, size_t room)
{
    size_t count = 0;
    for (size_t i = 0; i < trade->run_count && count < room; i++) {
        const bool *front = trade->run[i].front;
        if (front[VERIFY_PAIRS] || front[VERIFY_BYTES] || front[VERIFY_SECONDS]) {
            member[count++] = i;
        }
    }
    sorted = trade;
    qsort(member, count, sizeof *member, compare_error);
    return count;
}

static void print_fronts(FILE *file, const struct verify_trade *trade)
{
    size_t member[MEMBERS], count = verify_trade_members(trade, member, MEMBERS);
    (void)fprintf(file,
                  "\nwhat nothing else beats, in wall time (t), pair evaluations (p) or bytes moved (b)\n"
                  "%10s %6s %-3s %10s %6s %3s %10s %10s  %s\n",
                  trade->error_name[trade->chosen], "n", "of", "time [s]", "noise", "thr", "pairs x rhs", "bytes",
                  "configuration");
    for (size_t i = 0; i < count; i++) {
        const struct verify_trade_run *run = &trade->run[member[i]];
        char words[VERIFY_TRADE_WORDS], noise[16] = "-";
        verify_trade_short(trade, run, words);
        if (isfinite(run->noise)) {
            (void)snprintf(noise, sizeof noise, "%.0f %%", 100 * run->noise);
        }
        (void)fprintf(file, "%10.3e %6d %c%c%c %10.4g %6s %3d %10.3e %10.3e   %s\n", run->error[trade->chosen], run->n,
                      run->front[VERIFY_SECONDS] ? 't' : ' ', run->front[VERIFY_PAIRS] ? 'p' : ' ',
                      run->front[VERIFY_BYTES] ? 'b' : ' ', run->cost[VERIFY_SECONDS], noise, run->threads,
                      run->cost[VERIFY_PAIRS], run->cost[VERIFY_BYTES], words);
    }
    (void)fprintf(file,
                  "noise: second fastest over fastest of the repeats, less 1; -: timed once. thr: threads of the best "
                  "time.\n");
}

/* Runs that ended this way, grouped by the reason, each with the first that it is of. */
static void print_reasons(FILE *file, const struct verify_trade *trade, enum verify_trade_end end, const char *what,
                          size_t most)
{
    size_t shown = 0, reasons = 0, total = 0;
    for (size_t i = 0; i < trade->run_count; i++) {
        const struct verify_trade_run *run = &trade->run[i];
        size_t same = 0, before = 0;
        for (size_t j = 0; j < trade->run_count && run->end == end; j++) {
            bool alike = trade->run[j].end == end && strcmp(trade->run[j].why, run->why) == 0;
            same += alike;
            before += alike && j < i;
        }
        total += run->end == end;
        if (run->end != end || before > 0) {
            continue;
        }
        char words[VERIFY_TRADE_WORDS];
        verify_trade_short(trade, run, words);
        reasons++;
        if (shown++ < most) {
            (void)fprintf(file, "%s%zu as %s, n = %d: %s\n", shown == 1 ? what : "           ", same, words, run->n,
                          run->why);
        }
    }
    if (reasons > most) {
        (void)fprintf(file, "           and %zu reasons more; trade.json has all %zu runs\n", reasons - most, total);
    }
}

void verify_trade_advise(const struct verify_trade *trade, size_t error, double bound, char text[VERIFY_ADVICE])
{
    size_t chosen = verify_trade_cheapest(trade, error, bound, VERIFY_SECONDS, false);
    size_t own = verify_trade_cheapest(trade, error, bound, VERIFY_SECONDS, true);
    size_t best = verify_trade_best(trade, error);
    const char *name = trade->error_name[error];
    char words[VERIFY_TRADE_WORDS], beside[128];
    if (best == trade->run_count) {
        (void)snprintf(text, VERIFY_ADVICE, "nothing was measured");
        return;
    }
    const struct verify_trade_run *run = &trade->run[chosen == trade->run_count ? best : chosen];
    verify_trade_short(trade, run, words);
    if (chosen == trade->run_count) {
        (void)snprintf(text, VERIFY_ADVICE, "nothing measured reaches %s <= %.3g; the best was %.3e by %s at n = %d",
                       name, bound, run->error[error], words, run->n);
        return;
    }
    if (own == trade->run_count) {
        (void)snprintf(beside, sizeof beside, "the scene's own configuration does not reach it");
    } else {
        (void)snprintf(beside, sizeof beside, "%.3g of the scene's own (%.4g s at n = %d)",
                       run->cost[VERIFY_SECONDS] / trade->run[own].cost[VERIFY_SECONDS],
                       trade->run[own].cost[VERIFY_SECONDS], trade->run[own].n);
    }
    (void)snprintf(text, VERIFY_ADVICE,
                   "for %s <= %.3g choose %s at n = %d: %.4g s, %.3e pair evaluations, %.3e bytes; %s", name, bound,
                   words, run->n, run->cost[VERIFY_SECONDS], run->cost[VERIFY_PAIRS], run->cost[VERIFY_BYTES], beside);
}

size_t verify_trade_decades(const struct verify_trade *trade, size_t error, double decade[], size_t room)
{
    double least = INFINITY, most = 0;
    size_t count = 0;
    for (size_t i = 0; i < trade->run_count; i++) {
        const struct verify_trade_run *run = &trade->run[i];
        if (run->end == VERIFY_MEASURED && isgreater(run->error[error], 0)) {
            least = fmin(least, run->error[error]);
            most = fmax(most, run->error[error]);
        }
    }
    if (most == 0) {
        return 0;
    }
    for (int power = (int)floor(log10(trade->relative ? fmin(most, 0.99) : most)); count < room; power--) {
        decade[count++] = pow(10, power);
        if (decade[count - 1] < least) {
            break;
        }
    }
    return count;
}

void verify_trade_print_end(FILE *file, const struct verify_trade *trade)
{
    double decade[16];
    size_t count = verify_trade_decades(trade, trade->chosen, decade, 16);
    if (trade->stopped[0] != '\0') {
        char text[512];
        verify_trade_stopped(trade, text, sizeof text);
        (void)fprintf(file, "\n%s\n", text);
    }
    print_fronts(file, trade);
    (void)fputc('\n', file);
    print_reasons(file, trade, VERIFY_REFUSED, "refused    ", SHOWN_REASONS);
    print_reasons(file, trade, VERIFY_BROKE, "broke down ", SHOWN_BROKEN);
    print_reasons(file, trade, VERIFY_LEFT_OUT, "left out   ", SHOWN_REASONS);
    (void)fputc('\n', file);
    for (size_t i = 0; i < count; i++) {
        char text[VERIFY_ADVICE];
        verify_trade_advise(trade, trade->chosen, decade[i], text);
        (void)fprintf(file, "%s\n", text);
    }
}
