/* What the values of several levels say about the limit, without knowing it: Richardson extrapolation and the grid
 * convergence index.
 *
 * Sources: P. J. Roache, Perspective: a method for uniform reporting of grid refinement studies, J. Fluids Eng. 116
 * (1994) 405-413; I. B. Celik et al., Procedure for estimation and reporting of uncertainty due to discretization in
 * CFD applications, J. Fluids Eng. 130 (2008) 078001. Of three levels, f1 the finest, with e21 = f2 - f1,
 * e32 = f3 - f2, r21 = h2/h1, r32 = h3/h2:
 *
 *   order p       e32 / e21 = r21^p (r32^p - 1) / (r21^p - 1)
 *   limit         f1 + (f1 - f2) / (r21^p - 1)
 *   uncertainty   1.25 |f1 - f2| / (r21^p - 1); over |f1| it is the index
 *   ratio         index of (3, 2) / (r21^p index of (2, 1)), near 1 in the asymptotic range */
#ifndef VERIFY_GRID_CONVERGENCE_H
#define VERIFY_GRID_CONVERGENCE_H

#include <stdbool.h>
#include <stddef.h>

enum verify_convergence {
    VERIFY_TOO_FEW,     /* fewer than three levels */
    VERIFY_UNMEASURED,  /* one of the values is no number */
    VERIFY_EQUAL,       /* the two finest differ by round-off alone */
    VERIFY_OSCILLATING, /* up and down from level to level */
    VERIFY_DIVERGING,   /* they move apart */
    VERIFY_UNSETTLED,   /* they close in, and their order still changes, or neighbouring indices do not fit */
    VERIFY_ONE_ORDER,   /* they close in; there are too few levels for a second order to hold the first against */
    VERIFY_ASYMPTOTIC,  /* they close in with an order that no longer changes by more than a tenth */
    VERIFY_CONVERGENCES
};
/* "asymptotic: the order has settled" */
const char *verify_convergence_meaning(enum verify_convergence state);
/* The same in one word, for programs: "asymptotic". */
const char *verify_convergence_word(enum verify_convergence state);

struct verify_extrapolation {
    enum verify_convergence state;
    /* All NaN unless the three finest values close in. */
    double order, limit, uncertainty, index, ratio;
};

/* Values of a number at `count` levels, the finest last, with their spacings. What oscillates or moves apart is not
 * extrapolated. */
struct verify_extrapolation verify_extrapolate(size_t count, const double *h, const double *value);

/* What the orders of the last two pairs of levels say of an error, whose limit is known to be zero; the finer pair's is
 * order[1]. Both NaN with fewer than three levels. */
enum verify_convergence verify_error_convergence(size_t count, const double *h, const double *error, double order[2]);

#endif
