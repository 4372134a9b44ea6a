/* Manufactured solutions: any motion (oracles/motion.h) of a body of any material, with the body force that it needs,
 *     f0 = rho d2x/dt2 - Div P,   Div P_i = A_iIjJ d2x_j/dX_J dX_I,   A = dP/dF the material's own tangent.
 * They are oracle kinds like any other. The body is the box [0, L]^dim. */
#ifndef VERIFY_MANUFACTURED_H
#define VERIFY_MANUFACTURED_H

#include "oracles/motion.h"
#include "oracles/oracle.h"
#include "solver/material.h"

/* The kind called "manufactured-MOTION" for a material and dimension, or, where `material` is NULL, the one of the
 * whole name "manufactured-MOTION-MATERIAL-3d". NULL if there is none. */
const struct oracle_kind *verify_manufactured_find(const char *name, const char *material, int dim);

/* An oracle of that name: of the oracles' room, or a manufactured one by its whole name. */
const struct oracle_kind *verify_kind_find(const char *name);

/* The extra scalars of a manufactured kind: the body force along each axis, and where it flows the plastic strain. */
enum { VERIFY_BODY_FORCE_EXTRA = 0 };
/* Index of the plastic strain among them, or -1: the kind knows no plastic flow. */
int verify_plastic_strain_extra(const struct oracle_kind *kind);
bool verify_is_manufactured(const struct oracle_kind *kind);
/* Body force [N/m^3] that the kind needs; 0 where it is not manufactured. */
void verify_body_force(const struct oracle_kind *kind, const struct oracle *oracle, const double X[3], double t,
                       double force[3]);

/* --- for its parts: manufactured*.c --- */

/* What a kind is about. */
struct verify_manufactured {
    const struct oracle_motion *motion;
    const struct solver_material_model *model;
    int dim;
};

struct verify_manufactured_body {
    struct verify_manufactured of;
    const struct solver_material *material;
    struct solver_material_constants constants;
    struct oracle_motion_shape shape;
    double yield, hardening; /* [Pa] linear; 0: elastic */
};

/* F [dim][dim] as materials want it, with its cofactor and Jacobian, linearised where the material is. */
struct verify_measures {
    double F[9], H[9], J;
};
void verify_manufactured_measures(const struct verify_manufactured_body *body, const double F[9],
                                  struct verify_measures *measures);
/* Stress [dim][dim] and its component out of the plane or line, strain energy and the work of plastic flow, and the
 * divergence of the stress, given dF_iI/dX_J: manufactured_flow.c. */
bool verify_manufactured_flows(const struct verify_manufactured_body *body);
void verify_manufactured_stress(const struct verify_manufactured_body *body, const struct verify_measures *of,
                                double *P, double *normal);
double verify_manufactured_energy(const struct verify_manufactured_body *body, const struct verify_measures *of,
                                  double *plastic);
/* Of the body: kinetic and strain energy, and the work that plastic flow has taken [J]. */
void verify_manufactured_energies(const struct oracle *oracle, double t, double *kinetic, double *strain,
                                  double *plastic);
void verify_manufactured_divergence(const struct verify_manufactured_body *body, const struct verify_measures *of,
                                    double dF[3][3][3], double divergence[3]);
/* Equivalent strain, and what of it has flown. */
double verify_manufactured_strain(const struct verify_manufactured_body *body, const struct verify_measures *of);
double verify_manufactured_plastic_strain(const struct verify_manufactured_body *body, double strain);
/* The kind's self-check. */
size_t verify_manufactured_check(const struct oracle_kind *kind, const struct oracle *oracle, struct oracle_check *line,
                                 size_t size);

#endif
