/* Ways to measure a figure in a run. A new one is one function and one line of the table in measures.c. */
#ifndef VERIFY_MEASURES_H
#define VERIFY_MEASURES_H

#include "solver/run.h"
#include "verify/level.h"
#include "verify/truth.h"

/* What a figure is measured in: the level's snapshots are taken, the run is over. */
struct verify_measuring {
    const struct solver_scene *scene;
    const struct verify_truth *truth;
    const struct verify_level *level;
    const struct solver_history *history;
    const struct solver_output *output; /* at the end of the run */
    const char **why;                   /* a measure that finds nothing may say why; NULL: nobody asks */
};

/* Options of a measure, all of which it needs. */
enum verify_option {
    VERIFY_NO_OPTION,
    VERIFY_WINDOW, /* { t, X0, X1 }: part of a snapshot of a one-dimensional body */
    VERIFY_PROBE,  /* the name of a probe */
    VERIFY_BODY,   /* { k }: the k-th body */
    VERIFY_LENGTH, /* { d }: a length [m] */
    VERIFY_AXIS,   /* { k }: the k-th axis */
    VERIFY_NUMBER, /* { value }, in the measure's unit */
    VERIFY_PLACE   /* { x, y, ... }: a place that does not move with the body [m] */
};

struct verify_argument {
    size_t snapshot; /* which one a window looks at */
    double from, to; /* [m] */
    size_t probe;
    size_t body;
    double length; /* [m] */
    size_t axis;   /* 0, 1, 2 */
    double number;
    double place[3]; /* [m] */
};

enum { VERIFY_ARGUMENTS = 4 };

struct verify_measure {
    const char *name, *help;
    struct {
        const char *name;
        enum verify_option kind;
    } option[VERIFY_ARGUMENTS]; /* ends with VERIFY_NO_OPTION, unless full */
    bool in_1d_only;
    bool none_is_exact; /* the exact value is 0; otherwise the oracle has a figure of the same name */
    bool expected;      /* neither: the scene says by the first option, a length or a number, what is expected */
    bool flow;          /* of a material that flows plastically */
    const char *unit;   /* of one that needs no oracle; NULL: none */
    bool needs_fronts;
    const char *lacks; /* why there may be nothing to measure, and what to do, where the measure says no more */
    /* The figure; NaN where there is nothing to measure. Arguments in the order of `option`. */
    bool (*measure)(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                    struct solver_error *error);
};

/* All of them; ends with a NULL name. */
const struct verify_measure *verify_measures(void);
/* NULL if there is none of that name. */
const struct verify_measure *verify_measure_find(const char *name);
/* "of = { t [s], X0 [m], X1 [m] }" */
const char *verify_option_spelling(enum verify_option kind);

/* The functions of the table. */
bool verify_stress_ratio(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error);
bool verify_stress_ahead(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error);
bool verify_contact_time(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error);
bool verify_body_velocity(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                          struct solver_error *error);
bool verify_period(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                   struct solver_error *error);
bool verify_fundamental_period(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                               struct solver_error *error);

/* Largest distance [m] of a probe from the line along an axis on which it lay. */
bool verify_drift(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                  struct solver_error *error);

/* Distance [m] between two probes at the end. */
bool verify_distance(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                     struct solver_error *error);

/* What of the energy there was at first and of the work of loads neither is there at the end nor was taken by plastic
 * flow, over what there was: the dissipation of the scheme. */
bool verify_energy_lost(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                        struct solver_error *error);

/* Largest rise of kinetic and strain energy, less the work of loads, above what it was before, over the most there was.
 */
bool verify_energy_rise(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                        struct solver_error *error);

/* Largest |J - 1| of a particle over time; NaN where the pressure is not solved for. */
bool verify_volume_change(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                          struct solver_error *error);

/* Iterations per step that the pressure took; NaN where it is not solved for. */
bool verify_iterations(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                       struct solver_error *error);
/* Plastic strain across a section of the body as it is: the mean of ten places, evenly spread between two. At each it
 * is that of particles within two spacings, weighed by their volume and the kernel 004_0c0448173ed5e9bd.txt, eq. 3.4.
 * NaN where there is no particle near one. */
bool verify_plastic_section(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                            struct solver_error *error);
/* The largest of all particles at the end. */
bool verify_plastic_most(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error);
/* Plastic work [J] at the end. */
bool verify_plastic_work(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                         struct solver_error *error);
/* Of a body that one ram drives along an axis at a constant speed: the work of the ram, by the momentum of body and
 * walls along that axis, which has no other source, that is no energy of the body and was not taken by plastic flow,
 * over the plastic work. */
bool verify_ram_loss(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                     struct solver_error *error);
/* Largest gap, over time, of all energy that is there or was taken, less the work of loads, over the most there was;
 * and what the scheme's dissipation, and impacts on a rigid wall, have taken at the end, over that. SOLVER_BAD_INPUT
 * unless the scene's balance asks for it. */
bool verify_energy_balance(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                           struct solver_error *error);
bool verify_numerical_dissipation(const struct verify_measuring *in, const struct verify_argument *argument,
                                  double *value, struct solver_error *error);
bool verify_impact_loss(const struct verify_measuring *in, const struct verify_argument *argument, double *value,
                        struct solver_error *error);

/* Period [s] of u(t) = a + exp(-d t) (b cos w t + c sin w t), fitted by least squares to `count` rows; NaN where fewer
 * than one and a half periods are there, or such a motion explains less than half of what is there: *why (NULL: nobody
 * asks) then says so, and what to do. */
double verify_period_fit(size_t count, const double *time, const double *displacement, const char **why);
/* The peak of the stress within [from, to]: the value of largest magnitude, with its sign, of the parabola through the
 * particle that has it and its two neighbours. NaN if there is none within: the largest lies at an end. */
double verify_peak(size_t count, const struct verify_point *point, double from, double to);

#endif
