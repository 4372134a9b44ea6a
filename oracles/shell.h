/* Round bodies about the origin: a ball or a disc, or what is left of it around a hole. */
#ifndef ORACLES_SHELL_H
#define ORACLES_SHELL_H

struct shell {
    int dim;             /* 2: circles, 3: spheres */
    double inner, outer; /* radii [m]; inner = 0: no hole */
};

/* The place X [m] at the coordinates `part`, in [0, 1] each: part[0] runs outwards, the others around. `margin` [m]:
 * how far from the surface part[0] = 1, and from a hole part[0] = 0, it stays. Returns dV over the product of d part
 * [m^dim] where margin = 0. */
double shell_place(const struct shell *shell, const double part[3], double margin, double X[3]);

/* Distance of X from the origin along the first `dim` axes [m], and from the body, 0 within it. */
double shell_radius(const struct shell *shell, const double X[3]);
double shell_outside(const struct shell *shell, const double X[3]);

#endif
