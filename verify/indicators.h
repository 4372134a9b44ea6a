/* Indicators: whether a run is physically sound, judged from itself alone. */
#ifndef VERIFY_INDICATORS_H
#define VERIFY_INDICATORS_H

#include "solver/cells.h"
#include "solver/run.h"

enum verify_indicator {
    VERIFY_CLUMPING,
    VERIFY_CHECKERBOARD,
    VERIFY_LINEAR_MOMENTUM,
    VERIFY_ANGULAR_MOMENTUM,
    VERIFY_ENERGY_GAIN,
    VERIFY_INDICATORS
};

/* "clumping": what gates and reports call it. All are dimensionless. */
const char *verify_indicator_name(size_t indicator);
const char *verify_indicator_meaning(size_t indicator);
/* The good side: ">=" or "<=". */
const char *verify_indicator_op(size_t indicator);
/* Why a run may have none, and what to do. */
const char *verify_indicator_lacks(size_t indicator);
/* VERIFY_INDICATORS if there is none of that name. */
size_t verify_indicator_find(const char *name);

/* Whether the history of a run of this scene holds all work from outside: what a moved face puts in it does not. */
bool verify_supply_is_known(const struct solver_scene *scene);

/* All indicators of a run that is over; NaN where one has nothing to say: momentum where faces or loads act on the
 * body, energy where a face is moved, pressure where there is none. */
bool verify_indicators_measure(const struct solver_scene *scene, const struct solver_output *output,
                               const struct solver_history *history, const struct solver_facts *facts,
                               double value[VERIFY_INDICATORS], struct solver_error *error);

/* Those of particles where they are now: V their weights, `pressure` any scalar, `spacing` [m]. Clumping is the
 * smallest distance within a body over the spacing, 1.5 where all are farther apart. Checkerboard: how far the pressure
 * at a particle departs from what its neighbours within 1.5 spacings say, their mean corrected for where they lie; RMS
 * over particles with neighbours on all sides, over the RMS of the pressure there. O(h^2) for a smooth field, O(1) for
 * one that alternates. */
bool verify_indicators_cloud(const struct solver_points *now, const double *V, const double *pressure, double spacing,
                             double value[VERIFY_INDICATORS], struct solver_error *error);

/* The same of a graded lattice, where neighbours are those along the axes and across the faces, and each distance is
 * taken over what it was at rest. */
bool verify_indicators_lattice(const struct solver_cloud *cloud, const struct solver_points *now, const double *V,
                               const double *pressure, double value[VERIFY_INDICATORS], struct solver_error *error);

/* Drifts of momenta over the run, relative to those of a body of this mass [kg] and size [m] that has all of the
 * largest kinetic energy in one direction; largest energy beyond what was there and put in, relative to that. */
void verify_indicators_history(const struct solver_history *history, double mass, double size,
                               double value[VERIFY_INDICATORS]);

#endif
