/* What the tests of studies of costs share: one without a scene, of runs that are written down here. */
#ifndef TESTS_UNIT_TRADES_H
#define TESTS_UNIT_TRADES_H

#include "tests/unit/unit.h"
#include "verify/trade.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static struct solver_error error;
static struct verify_trade trade;

static inline struct verify_trade_run *add(const char *words, int n, double e, double u, double seconds, double pairs)
{
    struct verify_trade_run *run = &trade.run[trade.run_count];
    *run = (struct verify_trade_run){.n = n,
                                     .order = trade.run_count++,
                                     .end = VERIFY_MEASURED,
                                     .evaluations = 12,
                                     .cost = {pairs, 8 * pairs, seconds},
                                     .threads = 1,
                                     .repeats = 3,
                                     .noise = 0.25,
                                     .error = {e, u}};
    snprintf(run->words, sizeof run->words, "%s", words);
    return run;
}

static inline void begin(void)
{
    static struct solver_scene scene = {
        .name = "plain", .title = "plain", .oracle = "some", .text = "text", .overrides = "A=1\nB=2\n"};
    verify_trade_free(&trade);
    CU_ASSERT_TRUE_FATAL(verify_trade_begin(&scene, &trade, &error));
    CU_ASSERT_TRUE_FATAL(verify_trade_reserve(&trade, 32, &error));
    trade.error_count = 2;
    trade.relative = true;
    strcpy(trade.error_name[0], "p");
    strcpy(trade.error_name[1], "figure period");
    trade.level_count = 1;
    trade.level[0] = 8;
    add("scheme=upwind stencil=sbp4 cfl=0.8", 8, 1e-3, 1e-4, 4, 100)->own = true;
    add("scheme=upwind stencil=sbp2 cfl=0.8", 8, 5e-3, 2e-4, 1, 40);
    add("scheme=upwind stencil=sbp2 cfl=0.3", 8, 4e-3, NAN, 2, 120);
    add("scheme=jst stencil=sbp4 cfl=0.8", 8, 2, 1e-4, 0.1, 10); /* of no use, and cheap */
    add("scheme=upwind stencil=sbp4 cfl=0.8", 16, 1e-5, 1e-6, 64, 1600)->own = true;
}

#endif
