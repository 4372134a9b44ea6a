/* The judge: samples of any solver against an oracle, at the samples' own places and times. Nothing is interpolated. */
#ifndef VERIFY_JUDGE_H
#define VERIFY_JUDGE_H

#include "verify/gates.h"
#include "verify/norms.h"
#include "verify/sample.h"
#include "verify/truth.h"

#include <stdio.h>

/* Fields and errors are those of a state (norms.h), then the oracle's extras with the same norms. */
enum {
    VERIFY_JUDGED_FIELDS = VERIFY_STATE_FIELDS + ORACLE_EXTRAS,
    VERIFY_JUDGED_ERRORS = VERIFY_NORMS * VERIFY_JUDGED_FIELDS,
    VERIFY_JUDGED_NAME = 96,
    VERIFY_JUDGED_MEANING = 256
};

/* A field that an oracle knows. */
struct verify_judged_field {
    const char *name, *unit;
    enum verify_shape shape;
    bool is_extra;
};
/* Fields that an oracle of this kind knows are those from 0 to below this. */
size_t verify_judged_count(const struct oracle_kind *kind);
struct verify_judged_field verify_judged_field(const struct oracle_kind *kind, size_t field);
/* Whether a sample's field of this name is that field: its name, or one of the other names it goes by. */
bool verify_judged_is(const struct oracle_kind *kind, size_t field, const char *name);
/* The axis, where the field is an extra scalar "NAME_y" and a field of this name the vector whose component it is, as a
 * table's columns are read; else -1. */
int verify_judged_component(const struct oracle_kind *kind, size_t field, const char *name);
/* "sigma_all_max", "Pa". */
const char *verify_judged_name(const struct oracle_kind *kind, size_t error, char text[VERIFY_JUDGED_NAME]);
/* "relative L2 error of the velocity, all components" */
const char *verify_judged_meaning(const struct oracle_kind *kind, size_t error, char text[VERIFY_JUDGED_MEANING]);
const char *verify_judged_unit(const struct oracle_kind *kind, size_t error);
/* VERIFY_JUDGED_ERRORS if there is none of that name. */
size_t verify_judged_find(const struct oracle_kind *kind, const char *name);

struct verify_judged_level {
    const struct verify_sample *sample;
    double time; /* [s] */
    double h;    /* [m]; where only n is known 1/n; NaN where nothing is */
    bool known[VERIFY_JUDGED_FIELDS];
    double error[VERIFY_JUDGED_ERRORS]; /* NaN of fields not known */
    double rate[VERIFY_JUDGED_ERRORS];  /* observed order from the level before; NaN at the first */
    size_t assumed;                     /* fields without a unit, taken to be in SI units */
    char ignored[256];                  /* names of fields that were not compared, "" if none */
};

struct verify_judgement {
    const struct verify_truth *truth;
    const char *command;
    size_t level_count;
    struct verify_judged_level level[VERIFY_SAMPLES]; /* coarse to fine where spacings are known */
    size_t shown_count;
    size_t shown[VERIFY_JUDGED_ERRORS]; /* errors that get columns */
    struct verify_gates gates;
};

/* How far [m] the sample's places X [count][3] may lie outside a body: the round-off of its size. */
double verify_judged_slack(const struct verify_sample *sample, int dim, const double *X);

/* Compares one sample. `time` and `h` say what the file does not, NaN where nothing does; where both say it they must
 * agree. Errors name the file and the place in it. */
bool verify_judge_level(const struct verify_truth *truth, const struct verify_sample *sample, double time, double h,
                        struct verify_judged_level *level, struct solver_error *error);
/* Adds a level's sample to the judgement: all levels must have the same fields, times and kind of spacing. */
bool verify_judge_order(struct verify_judgement *judgement, struct solver_error *error);
/* Judges by gates such as "P=1e-2" and "rate P=1.8", on the finest level. */
bool verify_judge_gates(struct verify_judgement *judgement, const char *const *text, size_t count, bool rates,
                        struct solver_error *error);
/* Chooses the errors that get columns: those of the norms named (none: relative L2), and those that gates name. */
bool verify_judge_shown(struct verify_judgement *judgement, const char *const *norm, size_t count,
                        struct solver_error *error);
/* One line: what the gates say. */
const char *verify_judge_verdict(const struct verify_judgement *judgement);

/* Exact values of a whole field at one place, as [1], [3] or [9]; returns how many. */
size_t verify_judged_exact(const struct verify_truth *truth, size_t field, const struct oracle_state *state,
                           const double extra[ORACLE_EXTRAS], double value[9]);

/* Reports: as verify_terminal_*, verify_json and verify_html. */
void verify_judge_terminal(FILE *file, const struct verify_judgement *judgement);
void verify_judge_json(FILE *file, const struct verify_judgement *judgement);
void verify_judge_html(FILE *file, const struct verify_judgement *judgement);

#endif
