/* The cheapest configuration that the last study of costs says reaches an error. */
#ifndef VERIFY_TRADE_PICK_H
#define VERIFY_TRADE_PICK_H

#include "solver/run.h"
#include "verify/gates.h"
#include "verify/trade.h"
#include "verify/truth.h"

struct verify_pick {
    struct verify_trade trade;
    struct verify_trade_run run; /* the one picked */
    size_t error;                /* which of the study's */
    double bound;                /* what was asked for */
    char store[VERIFY_TRADE_STORE], threads[32];
    struct verify_options options; /* those of the command line, and what the study says */
    struct verify_truth truth;
    struct verify_level level;
    struct verify_gates gates;
};

/* Reads the study of the scene as loaded and picks by --error; then pick->options open the scene anew, at pick->run.n.
 * Refused (SOLVER_BAD_INPUT): no study, one of another scene, of another text of it or of other overrides, damaged, or
 * nothing in it reaches the error; the text says what to do. */
bool verify_pick_open(const struct verify_options *options, const struct solver_scene *scene, struct verify_pick *pick,
                      struct solver_error *error);
/* A verify_take: context is the pick. */
bool verify_pick_take(void *context, struct solver_run *run, struct solver_error *error);
/* Two gates on a finished run: its error is at most what was asked for, and it is what the study says. */
bool verify_pick_judge(struct verify_pick *pick, const struct solver_scene *scene, struct solver_run *run,
                       struct solver_error *error);
void verify_pick_free(struct verify_pick *pick);

#endif
