/* Isotropic hardening: the yield stress as a function of the equivalent plastic strain e, and the flow that returns a
 * stress to the yield surface.
 *
 *     linear      Y + H e                                     (000_e9ec29e1bde7947d.txt, Algorithm 2)
 *     saturation  Y + H e + (Ys - Y) (1 - exp(-d e))          (003_253cac78b077eaad.txt section 6.5)
 *     power       Y (1 + e/e0)^n                              (004_0c0448173ed5e9bd.txt eq. 4.3, with A e0^n = Y) */
#ifndef SOLVER_HARDENING_H
#define SOLVER_HARDENING_H

enum solver_hardening_law { SOLVER_HARDENING_LINEAR, SOLVER_HARDENING_SATURATION, SOLVER_HARDENING_POWER };

struct solver_hardening {
    int law;                 /* enum solver_hardening_law */
    double yield;            /* Y of the virgin material [Pa]; 0: it never yields */
    double modulus;          /* H >= 0 [Pa] */
    double saturation, rate; /* Ys >= Y [Pa] and d > 0 */
    double strain, exponent; /* e0 > 0 and n in (0, 1] */
};

/* The yield stress [Pa]; *slope (may be NULL) becomes its derivative [Pa]. */
double solver_hardening_stress(const struct solver_hardening *hardening, double plastic, double *slope);
/* The plastic work [J/m^3] of all flow up to a plastic strain: the integral of the yield stress. */
double solver_hardening_work(const struct solver_hardening *hardening, double plastic);
/* The plastic strain by which flow brings an equivalent stress q [Pa] down to the yield surface, where
 * q - 3 mu flow = yield stress(plastic + flow); 0 within it. To round-off: linear hardening in closed form, the others
 * by Newton's method within a bracket. 0 for a q that is no number. */
double solver_hardening_flow(const struct solver_hardening *hardening, double mu, double q, double plastic);

#endif
