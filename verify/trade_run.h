/* One run of a study of costs: what it costs and how far it is from the truth. */
#ifndef VERIFY_TRADE_RUN_H
#define VERIFY_TRADE_RUN_H

#include "verify/trade.h"
#include "verify/truth.h"

/* What the runs of a study share. */
struct verify_trader {
    const struct verify_options *options;
    const struct solver_scene *scene; /* its own configuration */
    struct verify_trade *trade;
    struct verify_truth truth[SOLVER_VARIANTS + 1]; /* of the scene and of its variants, as they are needed */
    bool opened[SOLVER_VARIANTS + 1];
    double deadline; /* [s] on verify_now(): a run is given up then, or when the program is asked to end (signals.h) */
};

/* Runs it and fills in its end, and what was measured; all that goes wrong with the configuration itself is no error of
 * the study. False if the study cannot go on. */
bool verify_trade_measure(struct verify_trader *trader, struct verify_trade_run *run, struct solver_error *error);
/* Times it again, `repeats` times with that many threads (0: as many as there are cores): the best time and the noise
 * are kept, if that many threads are faster than what was measured. */
bool verify_trade_time(struct verify_trader *trader, struct verify_trade_run *run, int threads, int repeats,
                       struct solver_error *error);
void verify_trader_free(struct verify_trader *trader);

#endif
