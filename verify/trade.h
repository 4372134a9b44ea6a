/* What accuracy costs: a scene run in many configurations and at several spacings, the error of each against the
 * oracle over its cost. Values that do not depend on the machine are the same to the bit in every study. */
#ifndef VERIFY_TRADE_H
#define VERIFY_TRADE_H

#include "solver/scene.h"
#include "verify/options.h"

#include <stddef.h>
#include <stdint.h>

enum {
    VERIFY_TRADE_AXES = 16,
    VERIFY_TRADE_VALUES = 16,
    VERIFY_TRADE_ERRORS = 32,
    VERIFY_TRADE_WORDS = 512,
    VERIFY_TRADE_NAME = SOLVER_NAME + 8, /* "figure NAME" */
    VERIFY_TRADE_STORE = VERIFY_TRADE_WORDS + SOLVER_NAMED * 2 * SOLVER_NAME,
    VERIFY_TRADE_RUNS = 20000
};

/* What a run costs. */
enum verify_cost {
    VERIFY_PAIRS,   /* right-hand sides evaluated, times pairs */
    VERIFY_BYTES,   /* moved in the time loop, if every array streams once per sweep (run.h) [B] */
    VERIFY_SECONDS, /* wall time of set-up and time loop [s] */
    VERIFY_COSTS
};
/* "seconds"; and "wall time [s], set-up and time loop". */
const char *verify_cost_name(enum verify_cost cost);
const char *verify_cost_meaning(enum verify_cost cost);

enum verify_trade_end { VERIFY_MEASURED, VERIFY_REFUSED, VERIFY_BROKE, VERIFY_LEFT_OUT };

struct verify_trade_run {
    char words[VERIFY_TRADE_WORDS]; /* "scheme=upwind stencil=sbp4 ...": the keys that matter to it */
    char variant[SOLVER_NAME];      /* of the scene's key trade; "": none */
    int n;
    bool own;        /* the scene's own configuration */
    size_t distance; /* values in which it differs from that */
    size_t order;    /* place in the list of all */
    size_t rank;     /* how many runs of the level before beat it there */
    enum verify_trade_end end;
    char why[SOLVER_TEXT];       /* it was refused, broke down or was left out */
    char by[VERIFY_TRADE_WORDS]; /* what beat it at the level before, if that is why */
    size_t particles, pairs, steps;
    double evaluations; /* of the right-hand side */
    double cost[VERIFY_COSTS];
    int threads, repeats; /* of the best time */
    double noise;         /* second fastest over fastest repeat, less 1; NaN: timed once */
    bool repeated;        /* timed again, with more threads as well */
    double error[VERIFY_TRADE_ERRORS];
    bool front[VERIFY_COSTS];
};

struct verify_trade_axis {
    char key[SOLVER_NAME];
    size_t count;
    char value[VERIFY_TRADE_VALUES][SOLVER_NAME];
};

struct verify_trade {
    char scene[SOLVER_NAME];
    char title[SOLVER_TEXT];
    char oracle[SOLVER_NAME];
    char *overrides; /* those of the command line, "KEY=value\n" lines */
    uint64_t hash;   /* of the scene's text and of these */
    size_t axis_count;
    struct verify_trade_axis axis[VERIFY_TRADE_AXES];
    size_t level_count;
    int level[SOLVER_LEVELS];
    size_t error_count, chosen; /* chosen: that of the fronts */
    bool relative;              /* it is: where it is 1 or more, nothing at all would be as good */
    char error_name[VERIFY_TRADE_ERRORS][VERIFY_TRADE_NAME];
    double budget, spent; /* [s] */
    char stopped[16];     /* the signal that ended the study before its end: "SIGINT"; "": none did */
    size_t run_count, run_room;
    struct verify_trade_run *run; /* [run_room] */
};

/* Name, overrides and hash of the scene. */
bool verify_trade_begin(const struct solver_scene *scene, struct verify_trade *trade, struct solver_error *error);
void verify_trade_free(struct verify_trade *trade);
/* Room for so many runs more; those there are may move. At most VERIFY_TRADE_RUNS in all. */
bool verify_trade_reserve(struct verify_trade *trade, size_t more, struct solver_error *error);
/* Of a scene as loaded: changes with its text, and with what the command line overrides. */
uint64_t verify_trade_hash(const struct solver_scene *scene);
uint64_t verify_trade_hash_bytes(uint64_t hash, const void *bytes, size_t size);
extern const uint64_t verify_trade_hash_start;

/* Whether the key says how a problem is solved, so that its values can be traded against one another. */
bool verify_trade_key(const char *key, size_t length);
/* The value of a key among a run's words; false if it is not there. */
bool verify_trade_word(const char *words, const char *key, char value[SOLVER_NAME]);
/* The words that a reader needs: those that all runs share are left out, and keys whose values say it all. */
void verify_trade_short(const struct verify_trade *trade, const struct verify_trade_run *run,
                        char text[VERIFY_TRADE_WORDS]);

/* Which of `count` points no other beats: none has an error and a cost both at most as large, one of them smaller. Of
 * several that are equal the first. What is not finite beats nothing and is beaten. */
void verify_pareto(size_t count, const double *error, const double *cost, bool *front);
/* Marks the fronts of all costs by the chosen error. A relative error of 1 or more stands on none. */
bool verify_trade_fronts(struct verify_trade *trade, struct solver_error *error);
/* The run of least cost whose error is at most the bound, and with `own` the scene's own configuration; of several the
 * first. trade->run_count if there is none. */
size_t verify_trade_cheapest(const struct verify_trade *trade, size_t error, double bound, enum verify_cost cost,
                             bool own);
/* The run of least error; trade->run_count if nothing was measured. */
size_t verify_trade_best(const struct verify_trade *trade, size_t error);
/* trade->error_count if there is none of that name. */
size_t verify_trade_error(const struct verify_trade *trade, const char *name);

/* The axes: those of the table and of --vary, without what --set fixes. */
bool verify_trade_axes(const struct verify_options *options, const struct solver_scene *scene,
                       struct verify_trade *trade, struct solver_error *error);
/* All configurations at the first level, nearest to the scene's own first. */
bool verify_trade_plan(const struct solver_scene *scene, struct verify_trade *trade, struct solver_error *error);
/* Adds the runs of the next level: those that no other of their kind (scheme, stencil, precision, integrator, variant)
 * beats at the level before, and the scene's own; the others are added as left out. The scene's own comes first, then
 * those that the fewest of any kind beat. */
bool verify_trade_promote(struct verify_trade *trade, size_t level, struct solver_error *error);

/* Adds what a run overrides to the options, whose text goes to `store`. */
bool verify_trade_configure(const struct solver_scene *scene, const struct verify_trade_run *run,
                            char store[VERIFY_TRADE_STORE], struct verify_options *options, struct solver_error *error);

/* "stopped by SIGINT: 12 of 40 runs were measured; not begun: n = 32", of a study that was stopped. */
void verify_trade_stopped(const struct verify_trade *trade, char *text, size_t size);

/* The study as a table that assay run reads again. */
bool verify_trade_write(const struct verify_trade *trade, const char *path, struct solver_error *error);
/* Errors (SOLVER_BAD_INPUT) say what is wrong with a file that is no study, cut short, damaged, or of another version.
 * A study that was read has its measured runs alone, without axes. */
bool verify_trade_read(const char *path, struct verify_trade *trade, struct solver_error *error);

#endif
