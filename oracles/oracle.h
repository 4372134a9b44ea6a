/* Oracles: exact solutions. (X, t) -> fields, with units, jumps and a self-check. Knows no other room. */
#ifndef ORACLES_ORACLE_H
#define ORACLES_ORACLE_H

#include <stdbool.h>
#include <stddef.h>

enum { ORACLE_WHY = 512, ORACLE_PARAMETERS = 16 };

struct oracle_parameter {
    const char *name; /* as the scene spells it: "U0", "material.nu" */
    const char *unit; /* "m", "Pa", "-" */
    const char *help;
    double lower, upper;         /* admissible interval; values are finite even where an end is not */
    bool lower_open, upper_open; /* the end itself is not admissible */
    double typical;              /* an admissible value: the source's own */
};

/* The exact state at one place and time; tensors row by row, always 3D. Where a field jumps it has the value of one of
 * the sides; an oracle that does not reach so late a time says NaN. */
struct oracle_state {
    double u[3]; /* displacement [m] */
    double v[3]; /* velocity [m/s] */
    double p[3]; /* linear momentum per unit reference volume [kg/(m^2 s)] */
    double F[9]; /* deformation gradient */
    double P[9]; /* first Piola-Kirchhoff stress [Pa] */
};

/* Smooth: nothing to look out for. Kinks: velocity and stress are continuous, their derivatives are not. Jumps: at
 * least one of velocity, momentum, deformation gradient and stress is not. */
enum oracle_smoothness { ORACLE_SMOOTH, ORACLE_KINKS, ORACLE_JUMPS };

/* A place X [m] along the axis of a one-dimensional body that moves at `speed` [m/s, to the right positive; 0 for an
 * interface of materials] and is not smooth. `jump` is v just right of it less v just left of it [m/s]. */
struct oracle_front {
    double X, speed, jump;
    enum oracle_smoothness smoothness; /* ORACLE_KINKS or ORACLE_JUMPS */
};
enum { ORACLE_FRONTS = 2048 };
#define ORACLE_TOO_MANY_FRONTS ((size_t)-1)

/* A number the solution is known by, for gates and reports: "reflection", "contact time". */
struct oracle_figure {
    const char *name, *unit, *help;
    double value;
};
enum { ORACLE_FIGURES = 16 };

/* A scalar that the state has beside the fields all oracles have: "plastic_strain", "internal_energy". */
struct oracle_extra {
    const char *name, *unit, *help;
};
enum { ORACLE_EXTRAS = 8 };

/* Result of a self-check: one line per law, each a dimensionless residual and the bound it must stay under. */
struct oracle_check {
    const char *law; /* "dp/dt = Div P", "initial displacement", "traction on X1", "second evaluation: u", ... */
    double residual, bound;
};
enum { ORACLE_LAWS = 64 }; /* no kind has more lines than this */

struct oracle;

struct oracle_kind {
    const char *name;    /* "swinging-cube" */
    const char *summary; /* one line */
    const char *source;  /* paper file and equation */
    int dim;
    enum oracle_smoothness smoothness; /* of the worst front there may be */
    bool finite_strain;                /* no linear elasticity, whose stresses are all alike: see oracle_cauchy */
    bool rigid;                        /* its strains are 0; of stresses it knows nothing and says 0 */
    const char *awaits;                /* what the solver lacks to be judged by it: "plasticity"; NULL: nothing */
    const struct oracle_parameter *parameter; /* ends with a NULL name */
    const struct oracle_extra *extra;         /* ends with a NULL name; NULL: none */
    /* Values in the order of `parameter`, already within their intervals. */
    bool (*create)(const double *value, struct oracle **oracle, char why[ORACLE_WHY]);
    /* In place of `create`, for kinds that share one; `about` is theirs. */
    bool (*create_as)(const struct oracle_kind *kind, const double *value, struct oracle **oracle,
                      char why[ORACLE_WHY]);
    const void *about;
    void (*destroy)(struct oracle *oracle);
    /* The last time [s] that it reaches: later it says NaN. NULL: there is none. */
    double (*reach)(const struct oracle *oracle);
    void (*state)(const struct oracle *oracle, const double X[3], double t, struct oracle_state *state);
    /* The extra scalars at X and t, in the order of `extra`; NULL if there are none. */
    void (*extras)(const struct oracle *oracle, const double X[3], double t, double value[ORACLE_EXTRAS]);
    /* Distance [m] of X from the reference body: 0 within it and on its faces; axes from `dim` on do not count. */
    double (*outside)(const struct oracle *oracle, const double X[3]);
    /* Total energies of the body [J]; of a one-dimensional body per unit of its cross-section [J/m^2]. */
    void (*energy)(const struct oracle *oracle, double t, double *kinetic, double *strain);
    /* All fronts within the body at time t, ordered by X, and how many there are. ORACLE_TOO_MANY_FRONTS: more than
     * there is room for, or the oracle does not reach so late a time. NULL if, and only if, the kind is smooth. */
    size_t (*fronts)(const struct oracle *oracle, double t, struct oracle_front front[ORACLE_FRONTS]);
    /* Fills in the figures and returns how many there are; NULL: none. */
    size_t (*figures)(const struct oracle *oracle, struct oracle_figure figure[ORACLE_FIGURES]);
    /* Fills up to `size` lines; returns how many there are. Every line must be able to fail. Fields and energies are
     * taken from `kind`, so that a kind with a spoiled formula is caught by the check of the true one. */
    size_t (*check)(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                    size_t size);
};

/* All oracles, NULL-terminated. */
const struct oracle_kind *const *oracle_kinds(void);
/* NULL if there is none of that name. */
const struct oracle_kind *oracle_find(const char *name);
/* Checks that every value is finite and admissible, then creates. The kind's destroy frees. On failure *oracle is NULL
 * and `why` names the parameter, its value, what it must be and a value that would do. */
bool oracle_create(const struct oracle_kind *kind, const double *value, struct oracle **oracle, char why[ORACLE_WHY]);

/* det F of a state. */
double oracle_jacobian(const struct oracle_state *state);
/* The cofactor of F, row by row, and its determinant, which is returned: without finite strain the linearised ones, I +
 * tr(F - I) I - (F - I)^T and 1 + tr(F - I). */
double oracle_measures(bool finite_strain, const double F[9], double H[9]);
/* The Cauchy stress [Pa] of a state, row by row: P F^T / det F, or P where the kind is one of linear elasticity, in
 * which strains are too small to tell the two apart. */
void oracle_cauchy(const struct oracle_kind *kind, const struct oracle_state *state, double sigma[9]);

/* Whether a line of a self-check holds: a NaN holds nothing. */
bool oracle_law_holds(const struct oracle_check *line);
/* Runs the kind's self-check: fills `line`, sets *count to the number of lines, and returns whether there is at least
 * one and all of them hold. */
bool oracle_self_check(const struct oracle_kind *kind, const struct oracle *oracle,
                       struct oracle_check line[ORACLE_LAWS], size_t *count);

#endif
