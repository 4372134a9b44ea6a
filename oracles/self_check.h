/* What every oracle can be asked without knowing its formulas: do its fields satisfy the laws they stand for?
 *
 * Derivatives are taken of the fields as they are given, by central differences of eighth order with a step of
 * SELF_CHECK_STEP radians of the shortest wave: their truncation error, SELF_CHECK_STEP^8 / 630 = 6e-14, stays below
 * the round-off. From that the bounds are made: two evaluations of a field differ by epsilon times the phase that the
 * fastest wave has run through, and a difference divides this by the step. Samples are a fixed low-discrepancy sequence
 * in body and time.
 *
 * An oracle's `check` fills a struct self_check, calls self_check_differentials first, which sets the scales, and then
 * those of the others that apply to it. */
#ifndef ORACLES_SELF_CHECK_H
#define ORACLES_SELF_CHECK_H

#include "oracles/oracle.h"
#include "oracles/shell.h"

#define SELF_CHECK_STEP 0.05

/* Largest magnitudes over the samples: what residuals are measured against, so that a component that is zero by
 * symmetry is held to the size of the others. */
struct self_check_scale {
    double u, v, gradient; /* [m], [m/s], [-] */
    double stress;         /* p-wave modulus times gradient [Pa]: terms may cancel in P, their round-off does not */
};

/* A box of one material. */
struct self_check_body {
    double lower[3], upper[3]; /* axes from kind->dim on are not used [m] */
    double bulk, mu, rho;      /* [Pa], [Pa], [kg/m^3] */
};

struct self_check;

/* What a kind has in place of Hooke's law. */
struct self_check_material {
    const char *law; /* of the line */
    /* P [Pa] at X and t from the displacement gradient G and, where that is not enough, from the extra scalars. */
    void (*stress)(const struct self_check *check, const double X[3], double t, const double G[9], double P[9]);
    /* Energy density [J/m^3] at X and t; NULL: the complementary energy of P by Hooke's law. */
    double (*energy)(const struct self_check *check, const double X[3], double t, const struct oracle_state *state);
};

struct self_check {
    const struct oracle_kind *kind;
    const struct oracle *oracle;
    double lower[3], upper[3];            /* the body, a box; axes from kind->dim on are not used [m] */
    double t_end;                         /* samples lie in [0, t_end] [s] */
    double wave_number;                   /* largest along any axis [rad/m] */
    double frequency;                     /* highest [rad/s] */
    double bulk, mu, rho;                 /* [Pa], [Pa], [kg/m^3] */
    const struct self_check_body *behind; /* a second body further along X, in one dimension; NULL if there is none */
    const struct shell *shell;            /* the body where it is round, in place of lower and upper; else NULL */
    const void *with;                     /* whatever the second evaluation needs */
    const double *instant; /* [instants] the only times at which there is a second evaluation [s]; NULL: any time */
    size_t instants;
    /* Sizes the fields are known to have where samples may miss them, or where nothing moves and the law of motion is
     * an equilibrium, which needs that of the stress; else zero. */
    struct self_check_scale least;
    const struct self_check_material *material; /* NULL: Hooke's law */
    size_t pieces; /* [0, t_end] is so many equal pieces in each of which v is smooth; 0: one */
    /* Energy that the faces have fed in by t, what of it has been dissipated, and all that went in or out by then,
     * whose round-off either has [J, or J/m^2]; NULL: none. */
    void (*supplied)(const struct self_check *check, double t, double *fed, double *lost, double *passed);
    double t_first; /* samples of a kind with fronts begin here [s] */
    double drift;   /* velocity of the body as a whole over that of the waves in it: that much less precise is a wave */
    double t_free;  /* nothing feeds or drains the body from here on [s] */
    struct oracle_check *line;  /* [size] lines to fill */
    size_t size, count;         /* room for lines, and lines there are */
    struct self_check_scale of; /* set by self_check_differentials */
};

/* v = du/dt, p = rho v, F = I + du/dX, P = K tr(e) I + 2 mu dev(e) with e the symmetric du/dX, or what the material
 * says, dp/dt = Div P. Together they are rho u_tt = Div P(u); first derivatives alone keep the bound 1/SELF_CHECK_STEP
 * lower than u_tt would. */
void self_check_differentials(struct self_check *check);

/* Initial displacement [m] and velocity [m/s] at X, as the source states them. */
typedef void self_check_initial(const struct oracle *oracle, const double X[3], double u[3], double v[3]);
void self_check_starts(struct self_check *check, self_check_initial *initial);

/* One face of the box: `held` components of the displacement are zero, and of the traction those that are not. */
void self_check_face(struct self_check *check, int axis, bool upper, const bool held[3]);
/* The surface of a round body, and that of its hole: neither bears a traction, to within a bound relative to the
 * stress. */
void self_check_free_surfaces(struct self_check *check, double bound);

/* Every field against a second evaluation that shares no formula with the first, to within a relative bound. */
typedef void self_check_second(const struct self_check *check, const double X[3], double t, struct oracle_state *state);
void self_check_compare(struct self_check *check, self_check_second *second, double bound);

/* Kinetic and strain energy against Gauss quadrature of p.v/2 and of the complementary energy of P (e as P has it, with
 * no unit matrix to subtract), or that of the material, and their sum from t_free on against its first value and what
 * has been supplied. */
void self_check_energies(struct self_check *check);

/* Fronts of a one-dimensional kind, at sampled times. At each the other family of characteristics must be smooth:
 * [P] = -rho s [v] and [v] = -s [F], for the fields and for their slopes, s the speed of the front. The jump must be
 * the listed one, and the front must later be listed where its speed takes it. Between the places listed u must be the
 * integral of F - I, all the way from end to end: a front that is not listed spoils the quadrature. */
void self_check_fronts(struct self_check *check);

#endif
