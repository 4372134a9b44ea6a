/* Private to the self-check of the bimaterial wave, which stands in three files: the ends and the weld; integrals over
 * time; modes. */
#ifndef ORACLES_BIMATERIAL_WAVE_CHECK_H
#define ORACLES_BIMATERIAL_WAVE_CHECK_H

#include "oracles/bimaterial_wave.h"
#include "oracles/self_check_parts.h"

/* What goes in at the left end while it is moved. */
enum { QUARTERS = 4 };
struct bimaterial_drive {
    double work[QUARTERS]; /* by each quarter of that time [J/m^2] */
    double most_work;      /* the largest of them */
    double gross;          /* what goes in and what comes out again, added up [J/m^2] */
    double most_impulse;   /* by any quarter [Pa s] */
};

/* The problem, from what the scene gives alone, and what drives it. */
struct bimaterial_problem {
    struct self_check *check;
    const struct bimaterial_wave_given *given;
    double c1, Z1, T1, c2, Z2, T2;
    struct bimaterial_drive drive;
};

void bimaterial_state(const struct bimaterial_problem *of, double X, double t, struct oracle_state *state);
double bimaterial_bound(const struct bimaterial_problem *of);

/* Fills in of->drive. */
void bimaterial_drive(struct bimaterial_problem *of);
/* These add their lines. The work wants the drive, the modes its most_work. */
void bimaterial_check_laplace(const struct bimaterial_problem *of);
void bimaterial_check_work(const struct bimaterial_problem *of);
void bimaterial_check_modes(const struct bimaterial_problem *of);

#endif
