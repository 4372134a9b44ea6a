/* A study of costs, for people (terminal, HTML with charts) and for programs (JSON). */
#ifndef VERIFY_REPORT_TRADE_H
#define VERIFY_REPORT_TRADE_H

#include "verify/trade.h"
#include "verify/truth.h"

#include <stdio.h>

/* What is about to be done. */
void verify_trade_print_begin(FILE *file, const struct verify_trade *trade, const struct solver_scene *scene,
                              const struct verify_truth *truth);
/* A line on level n that is done, its runs being [from, to): none, where nothing was measured at the level before. */
void verify_trade_print_level(FILE *file, const struct verify_trade *trade, int n, size_t from, size_t to);
/* The fronts, what was not measured and why, and recommendations. */
void verify_trade_print_end(FILE *file, const struct verify_trade *trade);

/* The members of the fronts, largest error first; returns how many. */
size_t verify_trade_members(const struct verify_trade *trade, size_t *member, size_t room);

/* "for an error p of 1e-3 choose ... at n = 8: 0.01 s, 0.3 of the scene's own (n = 16)". `bound` is an error that is
 * asked for; what nothing reaches is said. */
enum { VERIFY_ADVICE = 1536 };
void verify_trade_advise(const struct verify_trade *trade, size_t error, double bound, char text[VERIFY_ADVICE]);
/* Powers of ten within the errors measured, from the largest to the first that nothing reaches; returns how many. */
size_t verify_trade_decades(const struct verify_trade *trade, size_t error, double decade[], size_t room);

/* {"scene", "oracle", "error", "stopped_by", "overrides": [...], "budget", "spent", "axes": {KEY: [value, ...]},
 * "levels": [n, ...], "runs": [{"configuration": {KEY: value}, "variant", "n", "own", "particles", "pairs", "steps",
 * "evaluations", "cost": {"pair_evaluations", "bytes", "seconds"}, "threads", "repeats", "noise", "errors": {NAME:
 * value}, "fronts": [name of cost, ...]}, ...], "refused", "broke_down", "left_out": [{"configuration", "variant", "n",
 * "why", "by"}, ...], "advice": [{"error", "run", "own"}, ...]}; a run is its place in "runs", null where there is
 * none. */
void verify_trade_json(FILE *file, const struct verify_trade *trade);

/* Error over cost, both axes logarithmic, as a group of a width and height that the caller has room for. */
enum { VERIFY_TRADE_CHART_WIDTH = 470, VERIFY_TRADE_CHART_HEIGHT = 420, VERIFY_TRADE_KEY_WIDTH = 140 };
void verify_plot_trade(FILE *file, const struct verify_trade *trade, enum verify_cost cost);
/* What the colours of all charts mean. */
void verify_plot_trade_key(FILE *file, const struct verify_trade *trade);
/* The charts of all costs as one picture that stands alone. */
void verify_trade_svg(FILE *file, const struct verify_trade *trade);
void verify_trade_html(FILE *file, const struct verify_trade *trade, const struct solver_scene *scene,
                       const struct verify_truth *truth);

#endif
