/* Extremes: how far a quantity can be driven until a run no longer holds. Each is measured, most by bisection, and said
 * beside the nearest value that fails. A new extreme is one function and one line of the table in extremes.c. */
#ifndef VERIFY_EXTREMES_H
#define VERIFY_EXTREMES_H

#include "solver/error.h"
#include "solver/run.h"
#include "verify/options.h"

#include <stdbool.h>
#include <stddef.h>

/* One line of the map. */
struct verify_extreme_row {
    char what[80];      /* "upwind sbp2 rk4, 2D" */
    char quantity[40];  /* what the value is of: "largest CFL number" */
    double value;       /* [unit] measured: the largest, or smallest, that holds */
    double fails;       /* [unit] the nearest seen that fails; NaN: none does, or nothing was driven */
    double least, most; /* [unit] where the value has to lie; infinite: no such bound. Both infinite: told only */
    const char *unit;
    char note[200]; /* how it fails, or where the bounds come from */
};

struct verify_extremes {
    const struct verify_options *options; /* overrides go to every run */
    void (*take)(void *context, const char *extreme, const struct verify_extreme_row *row);
    void *context;
    const char *extreme; /* that which runs */
    const char *rows;    /* measured are those with this in what they are of; NULL: all */
};

struct verify_extreme {
    const char *name, *summary;
    bool (*run)(const struct verify_extremes *in, struct solver_error *error);
    const char *scene, *drives; /* what it runs, and the keys that it sets itself, with blanks between */
    const char *in_double;      /* why it measures nothing in single precision; NULL: it does */
};

/* The table, ends with a NULL name. */
const struct verify_extreme *verify_extremes_table(void);
const struct verify_extreme *verify_extreme_find(const char *name);
/* Refuses overrides of the command line that the extreme's scene does not take, and those of keys that it drives: what
 * it says of its rows would not be true. SOLVER_BAD_INPUT. */
bool verify_extreme_check(const struct verify_extreme *extreme, const struct verify_options *options,
                          struct solver_error *error);

/* Whether the value lies within its bounds; what is only told passes unless it is NaN. */
bool verify_extreme_holds(const struct verify_extreme_row *row);
/* Whether a row of this is to be measured. */
bool verify_extreme_asked(const struct verify_extremes *in, const char *what);
/* Hands a row to whoever takes it, unless the program was asked to end (signals.h) while it was measured. */
void verify_extreme_told(const struct verify_extremes *in, const struct verify_extreme_row *row);

/* A run of a scene of the program with overrides, "key=value" separated by blanks, then those of the command line. */
struct verify_trial {
    struct solver_scene *scene;
    struct solver_run *run;
};
bool verify_trial_open(const struct verify_extremes *in, const char *scene, struct verify_trial *trial,
                       struct solver_error *error, const char *format, ...) __attribute__((format(printf, 5, 6)));
void verify_trial_close(struct verify_trial *trial);
/* To the scene's end time, or many steps. Both, and opening, fail (SOLVER_STOPPED) once the program was asked to end.
 */
bool verify_trial_finish(struct verify_trial *trial, struct solver_error *error);
bool verify_trial_steps(struct verify_trial *trial, size_t steps, struct solver_error *error);
/* To the scene's end time, and the error of this name there (norms.h) beside the scene's oracle. */
bool verify_trial_judge(struct verify_trial *trial, const char *name, double *found, struct solver_error *error);
/* Root mean square of the velocities [m/s] and largest of them; NaN if there is no output. */
double verify_trial_speed(struct verify_trial *trial, double *largest);

/* Whether a value holds; what is wrong with one that does not goes to note [size], which is else left alone. */
typedef bool verify_extreme_try(void *with, double value, char *note, size_t size);
/* Closes in on where holding ends, by geometric bisection between a value that should hold and one that should fail,
 * until their ratio is below 1 + width. *fails is NaN if the far end holds, and *holds if the near end fails. */
void verify_extreme_bisect(verify_extreme_try *holds_at, void *with, double near, double far, double width,
                           double *holds, double *fails, char *note, size_t size);

/* The functions of the table. */
bool verify_extreme_cfl(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_scale(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_place(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_alternating(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_spin(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_vibration(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_poisson(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_stretch(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_perturbed(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_impact(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_contrast(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_slanted(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_graded(const struct verify_extremes *in, struct solver_error *error);
bool verify_extreme_small(const struct verify_extremes *in, struct solver_error *error);

#endif
