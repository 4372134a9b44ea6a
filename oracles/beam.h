/* Cantilevers as beam theory has them: clamped at x = 0, free at x = L, rectangular, in plane strain or plane stress.
 *
 * Thin plate (Bernoulli-Euler): 1 + cos kL cosh kL = 0, omega^2 = E' H^2 k^4 / (12 rho), with E' = E / (1 - nu^2) in
 * plane strain (001_363f711843f01da4.txt, section 4.1, the curve it calls analytical) and E' = E in plane stress.
 *
 * Timoshenko: rotary inertia and shear besides, with the shear factor 5 / (6 - nu) in plane strain and
 * 5 (1 + nu) / (6 + 5 nu) in plane stress: the one that follows from the equations of elasticity for long waves
 * (S. P. Timoshenko, Phil. Mag. 43 (1922) 125; J. R. Hutchinson, J. Appl. Mech. 68 (2001) 87). */
#ifndef ORACLES_BEAM_H
#define ORACLES_BEAM_H

#include "oracles/oracle.h"

struct oracle_beam {
    double length, height; /* [m] */
    double E, nu, rho;     /* [Pa], [-], [kg/m^3] */
    bool plane_stress;     /* else plane strain */
};

/* One mode. Only the first two are meant to be read; the rest describes the shape along xi = x / L:
 * w = grow exp(growth (xi - 1)) + decay exp(-growth xi) + cosine cos(wave xi) + sine sin(wave xi). */
struct oracle_beam_mode {
    double frequency; /* [rad/s] */
    double period;    /* [s] */
    double length;    /* [m] */
    double growth, wave;
    double grow, decay, cosine, sine;
    double growth_slope,
        wave_slope; /* rotation of the cross section per deflection, as factors of exp and of sin, cos */
};

/* Mode 1, 2, ... False, with `why` filled, for values that are no beam, a mode below 1, or, with Timoshenko, one above
 * the cut-off frequency sqrt(shear factor G A / (rho I)), where a second kind of wave begins. */
bool oracle_beam_thin_plate(const struct oracle_beam *beam, int mode, struct oracle_beam_mode *result,
                            char why[ORACLE_WHY]);
bool oracle_beam_timoshenko(const struct oracle_beam *beam, int mode, struct oracle_beam_mode *result,
                            char why[ORACLE_WHY]);

/* At x [m] from the clamp: the deflection, 1 at the free end, and the rotation of the cross section [1/m], which is the
 * slope of the deflection only in a thin plate. */
double oracle_beam_deflection(const struct oracle_beam_mode *mode, double x);
double oracle_beam_rotation(const struct oracle_beam_mode *mode, double x);
/* The curvature, by which the bending moment goes: first derivative of the rotation [1/m^2]; and the second [1/m^3]. */
double oracle_beam_curvature(const struct oracle_beam_mode *mode, double x);
double oracle_beam_curvature_slope(const struct oracle_beam_mode *mode, double x);

#endif
